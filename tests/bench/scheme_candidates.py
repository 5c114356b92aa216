# SPDX-License-Identifier: BSD-3-Clause
"""Which further time integration schemes would pay: work and precision of prototypes.
docs/decisions/0029-further-schemes.md has the results.

    build/venv/bin/python tests/bench/scheme_candidates.py [--models top andrews crank gears teeth double]
        [--schemes ...] [--csv FILE] [--picture FILE] [--energy STEPS] [--check build/bin/engrane]

Models are in candidate_models.py, schemes in candidate_schemes.py, what their work costs this program in
candidate_costs.py: counts of residuals, tangents, factorisations and solutions are those of the prototype,
with new factors for each correction or with kept ones, whichever is cheaper; unit costs are those of chains
of 3 or 100 links with KLU and of 100 links with MUMPS. Errors are the largest of ten instants over the
largest value there, of positions (q), velocities (v) and forces (f); the truth is an integration of index 1
by Runge-Kutta of order 8, with projections. `ida` is SUNDIALS IDA, BDF of order 1 to 5 with steps of its
own, on the stabilised index 2, where scikit-sundae is installed (see ida.py). `radau@20` and `ida@20` start
anew 20 times, as after events. --energy follows a double pendulum, a pendulum and the top for so many
steps. --check compares errors of the prototype's generalised-alpha and Radau IIA with those of the program.
"""

import argparse
import csv
import math
import sys
import time
import warnings
from collections import Counter
from itertools import pairwise
from pathlib import Path

import numpy as np
from candidate_costs import cost
from candidate_models import MODELS, Pendulum, Top, truth
from candidate_schemes import make

SHIPPED = ("alpha:0.8", "radau")
CANDIDATES = ("alpha-ggl:0.8", "rattle", "bdf2", "bdf3", "bdf4", "bdf5", "bdf3-ggl", "bdf4-ggl", "bdf5-ggl")
#: fewest steps, in tens, and the most for schemes of order 2
STEPS = {
    "top": (2, 640),
    "andrews": (10, 640),
    "crank": (2, 320),
    "gears": (2, 320),
    "teeth": (10, 640),
    "stiff": (2, 80),
    "double": (2, 320),
}
SIZES = {"small, KLU": (3, "KLU"), "1100 unknowns, KLU": (100, "KLU"), "1100 unknowns, MUMPS": (100, "MUMPS")}
AIMS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
PRECISION = 1e-10
KINDS = ("q", "v", "f")


def errors(values, exact) -> list[float]:
    return [float(max(np.abs(a - b).max(0) / np.abs(b).max(0))) for a, b in zip(values, exact, strict=True)]


def run(name: str, model, steps: int, keep: bool, exact) -> dict | None:
    """`name` may end in @ and a number of restarts, as after events."""
    name, _, events = name.partition("@")
    apart = steps // int(events) if events else steps + 1
    if apart < 2:
        return None
    begin = time.process_time()
    try:
        with np.errstate(over="raise", invalid="raise", divide="raise"), warnings.catch_warnings():
            warnings.simplefilter("error")  # a singular matrix
            scheme = make(name, model, model.end / steps, keep, PRECISION)
            rows, left = [], 0.0
            for k in range(steps):
                scheme.step()
                scheme.newton.end_step()
                if (k + 1) % apart == 0:
                    scheme.forget()
                if (k + 1) % (steps // 10) == 0:
                    rows.append(scheme.result())
                    left = max(
                        left, np.abs(model.jacobian(scheme.q) @ scheme.v).max() / np.abs(scheme.v).max()
                    )
    except (ArithmeticError, ValueError, Warning, np.linalg.LinAlgError):
        return None
    found = errors([np.array(part) for part in zip(*rows, strict=True)], exact)
    if not np.isfinite(found).all() or max(found[:2]) > 0.5:
        return None
    return {"errors": found, "work": scheme.work, "left": left, "seconds": time.process_time() - begin}


def run_ida(model, tolerance: float, times, exact, events: int = 0) -> dict | None:
    """The stabilised index 2 of tests/bench/ida.py, in coordinates of bodies; work of systems without v."""
    from sksundae.ida import IDA

    n, m, mass = model.n, model.m, model.mass
    inverse = np.linalg.inv(mass)
    calls = Counter()

    def residual(_t, y, yp, out):
        q, v, push, more = y[:n], y[n : 2 * n], y[2 * n : 2 * n + m], y[2 * n + m :]
        g = model.jacobian(q)
        calls["residual"] += 1
        out[:n] = yp[:n] - v + inverse @ (g.T @ more)
        out[n : 2 * n] = mass @ yp[n : 2 * n] - model.force(q, v) + g.T @ push
        out[2 * n : 2 * n + m], out[2 * n + m :] = model.closure(q), g @ v

    def jacobian(_t, y, _yp, _r, cj, out):
        q, v, push, more = y[:n], y[n : 2 * n], y[2 * n : 2 * n + m], y[2 * n + m :]
        g, (f_q, f_v) = model.jacobian(q), model.bent_force(q, v)
        calls["tangent"] += 1
        calls["factor ggl"] += 1
        out[:] = 0
        out[:n, :n] = cj * np.eye(n) + inverse @ model.bent_jacobian(q, more)
        out[:n, n : 2 * n] = -np.eye(n)
        out[:n, 2 * n + m :] = inverse @ g.T
        out[n : 2 * n, :n] = model.bent_jacobian(q, push) - f_q
        out[n : 2 * n, n : 2 * n] = cj * mass - f_v
        out[n : 2 * n, 2 * n : 2 * n + m] = g.T
        out[2 * n : 2 * n + m, :n] = g
        out[2 * n + m :, :n], out[2 * n + m :, n : 2 * n] = model.bent_rate(q, v), g

    scale = np.abs(exact[1]).max() / np.ptp(exact[0], axis=0).max()  # speeds of a place of 1
    q, v, rows, pieces = model.place, model.speed, [], max(1, events // 10)
    grid = np.linspace(times[0], times[-1], 10 * pieces + 1)
    spans = list(pairwise(grid)) if events else [(times[0], times[-1])]
    for span in spans:
        a, push = model.balance(q, v)
        solver = IDA(
            residual,
            rtol=tolerance,
            atol=np.r_[np.full(n, tolerance), np.full(n, scale * tolerance), np.full(2 * m, 1e20)],
            jacfn=jacobian,
            linsolver="dense",
            max_num_steps=1000000,
            algebraic_idx=list(range(2 * n, 2 * n + 2 * m)),
            first_step=1e-5 * model.end if tolerance > 1e-5 else 1e-6 * model.end,
        )
        start = np.r_[q, v, push, np.zeros(m)]
        asked = np.linspace(*span, 3) if events else times  # of two, all steps would come back
        found = solver.solve(asked, start, np.r_[v, a, np.zeros(2 * m)])
        if not found.success:
            return None
        for row in np.asarray(found.y)[-1:] if events else np.asarray(found.y)[1:]:
            q, v = row[:n], row[n : 2 * n]
            rows.append(model.seen(q, v, row[2 * n : 2 * n + m]))
    rows = rows[pieces - 1 :: pieces]
    calls["solve ggl"] = calls["residual"]
    return {
        "errors": errors([np.array(part) for part in zip(*rows, strict=True)], exact),
        "work": calls,
        "left": 0.0,
        "seconds": 0.0,
    }


def measure(name: str, schemes) -> list[dict]:
    model = MODELS[name]()
    times = np.linspace(0, model.end, 11)
    exact = truth(model, times)
    rows = []
    for scheme in schemes:
        if scheme.startswith("ida"):
            events = int(scheme.partition("@")[2] or 0)
            for tolerance in [] if model.rotation else [10.0**-k for k in range(3, 11)]:
                row = run_ida(model, tolerance, times, exact, events)
                if row:
                    rows.append(
                        row | {"model": name, "scheme": scheme, "keep": True, "steps": f"{tolerance:g}"}
                    )
            continue
        for keep in (False, True):
            if scheme.startswith("radau") and not keep:
                continue
            tens, most = STEPS[name]
            while tens <= most:
                row = run(scheme, model, 10 * tens, keep, exact)
                if row:
                    rows.append(row | {"model": name, "scheme": scheme, "keep": keep, "steps": 10 * tens})
                    if max(row["errors"]) < 3e-8:
                        break
                tens *= 2
        print(f"{name}, {scheme}", file=sys.stderr, flush=True)
    return rows


def read(path: Path) -> list[dict]:
    rows = []
    with path.open(newline="", encoding="utf-8") as file:
        for r in csv.DictReader(file):
            work = {k: int(r[k] or 0) for k in list(r)[8:]}
            steps = r["steps"] if r["scheme"].startswith("ida") else int(r["steps"])
            rows.append(
                {"model": r["model"], "scheme": r["scheme"], "keep": r["kept"] == "True", "steps": steps}
                | {"errors": [float(r[k]) for k in KINDS], "left": float(r["left"]), "work": Counter(work)}
            )
    return rows


def cheapest(rows: list[dict], schemes, size, kinds, aim: float) -> float:
    """The least cost of one of the schemes with all errors of `kinds` below the aim, between measured steps
    by powers."""
    best = math.inf
    for scheme in schemes:
        for keep in (False, True):
            points = [
                (max(r["errors"][KINDS.index(k)] for k in kinds), cost(r["work"], *size))
                for r in rows
                if r["scheme"] == scheme and r["keep"] == keep
            ]
            points.sort(key=lambda p: p[1])
            for k, (error, price) in enumerate(points):
                if error > aim:
                    continue
                if k and points[k - 1][0] > aim:
                    far, low = points[k - 1]
                    part = math.log(far / aim) / math.log(far / max(error, 1e-16))
                    price = low * (price / low) ** part
                best = min(best, price)
                break
    return best


def orders(rows: list[dict], scheme: str) -> list[str]:
    """Of q, v and f, between the last two runs with errors above 2e-7."""
    out = []
    for k in range(3):
        points = [
            (r["steps"], r["errors"][k])
            for r in rows
            if r["scheme"] == scheme and r["errors"][k] > 2e-7 and r["keep"] == scheme.startswith("radau")
        ]
        if len(points) < 2:
            out.append("")
            continue
        (n0, e0), (n1, e1) = points[-2:]
        out.append(f"{math.log(e0 / e1) / math.log(n1 / n0):.1f}")
    return out


def report(rows: list[dict], models, schemes) -> None:
    print("\nOrders of q, v, f\n")
    print("| scheme | " + " | ".join(models) + " |\n|---" + "|---" * len(models) + "|")
    for scheme in schemes:
        if scheme.startswith("ida"):
            continue
        cells = [", ".join(orders([r for r in rows if r["model"] == m], scheme)) for m in models]
        print(f"| {scheme} | " + " | ".join(cells) + " |")
    others = [s for s in schemes if s not in SHIPPED]
    for title, size in SIZES.items():
        for kinds in ("qvf", "q"):
            print(f"\nCost of the cheaper of {', '.join(SHIPPED)} over the candidate's, {title}, {kinds}\n")
            print("| model | error | shipped, M | " + " | ".join(others) + " |")
            print("|---" * (3 + len(others)) + "|")
            for model in models:
                mine = [r for r in rows if r["model"] == model]
                for aim in AIMS:
                    shipped = [cheapest(mine, [s], size, kinds, aim) for s in SHIPPED]
                    which = SHIPPED[int(np.argmin(shipped))].partition(":")[0]
                    prices = [cheapest(mine, [s], size, kinds, aim) for s in others]
                    cells = [f"{min(shipped) / p:.2f}" if math.isfinite(p) else "" for p in prices]
                    price = f"{which} {min(shipped) / 1e6:.0f}"
                    print(f"| {model} | {aim:g} | {price} | " + " | ".join(cells) + " |")


COLOURS = {
    "alpha": ("#000000", "-"),
    "radau": ("#7a7a7a", "-"),
    "alpha-ggl": ("#d55e00", "--"),
    "rattle": ("#009e73", "--"),
    "bdf3": ("#56b4e9", "--"),
    "bdf5": ("#0072b2", "--"),
    "bdf5-ggl": ("#cc79a7", ":"),
    "ida": ("#e69f00", ":"),
}


def picture(rows: list[dict], models, path: Path) -> None:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    size = SIZES["1100 unknowns, KLU"]
    figure, axes = plt.subplots(len(models), 3, figsize=(9, 2.3 * len(models)), sharey=True, squeeze=False)
    for line, model in zip(axes, models, strict=True):
        for k, (axis, title) in enumerate(zip(line, ("positions", "velocities", "forces"), strict=True)):
            for label, (colour, style) in COLOURS.items():
                mine = [r for r in rows if r["model"] == model and r["scheme"].partition(":")[0] == label]
                best = {}
                for r in mine:  # kept factors or new ones, whichever are cheaper
                    point = (cost(r["work"], *size) / 1e9, r["errors"][k])
                    best[r["steps"]] = min(best.get(r["steps"], (math.inf, 0)), point)
                points = list(best.values())
                if points:
                    x, y = zip(*points, strict=True)
                    axis.loglog(x, y, style, color=colour, lw=1.4, marker="o", ms=2.5, label=label)
            axis.set_ylim(1e-8, 1)
            axis.set_yticks([1e-8, 1e-6, 1e-4, 1e-2, 1])
            axis.grid(alpha=0.3)
            axis.set_title(f"{model}: {title}", fontsize=9)
            axis.tick_params(labelsize=8)
        line[0].set_ylabel("error", fontsize=9)
    for axis in axes[-1]:
        axis.set_xlabel("thousand million instructions", fontsize=9)
    handles, labels = axes[min(1, len(models) - 1)][0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=len(labels), loc="upper center", fontsize=9, frameon=False)
    figure.tight_layout(rect=(0, 0, 1, 1 - 0.35 / (2.3 * len(models))))
    figure.savefig(path, dpi=110)


ENERGY_SCHEMES = {
    "alpha:1": 1,
    "alpha:0.9": 1,
    "alpha-ggl:1": 1,
    "rattle": 1,
    "radau": 4,
}  #: and steps' lengths


def energies(steps: int) -> None:
    """Energy over the largest kinetic energy, at steps that cost the same as those of generalised-alpha."""
    print("\n| model | scheme | steps | cost, G | drift | swing |\n" + "|---" * 6 + "|")
    for make_model, h in ((lambda: Pendulum(1), 0.01), (lambda: Pendulum(2), 0.01), (Top, 2e-4)):
        for name, ratio in ENERGY_SCHEMES.items():
            model = make_model()
            scheme = make(name, model, h * ratio, True, PRECISION)
            base, kinetic, seen = model.energy(scheme.q, scheme.v), 0.0, []
            try:
                for _ in range(steps // ratio):
                    scheme.step()
                    scheme.newton.end_step()
                    seen.append(model.energy(scheme.q, scheme.v) - base)
                    kinetic = max(kinetic, 0.5 * scheme.v @ model.mass @ scheme.v)
            except ArithmeticError as failure:
                print(f"| {model.name} | {name} | failed after {len(seen)} steps: {failure} |", flush=True)
                continue
            part = len(seen) // 10
            drift = (np.mean(seen[-part:]) - np.mean(seen[:part])) / kinetic
            price = cost(scheme.work, *SIZES["1100 unknowns, KLU"]) / 1e9
            swing = np.ptp(seen[-part:]) / kinetic
            print(
                f"| {model.name} | {name} | {len(seen)} | {price:.0f} | {drift:.1e} | {swing:.1e} |",
                flush=True,
            )


def check(binary: Path) -> None:
    """Errors and counts of Andrews' mechanism by the program and by the prototype."""
    import tempfile

    import schemes as program

    model = MODELS["andrews"]()
    exact = truth(model, np.linspace(0, model.end, 11))
    exact[0] = exact[0] - model.place[[2, 8, 14]]
    options = argparse.Namespace(runs=1, solver="KLU")
    print("\n| | steps | corrections | q | v | f |\n" + "|---" * 6 + "|")
    cases = [
        ("alpha:0.8", "SCHEME CHUNG RHO 0.8", keep, h)
        for keep in (False, True)
        for h in (1.5e-4, 7.5e-5, 3e-5)
    ]
    cases += [("radau", "SCHEME RADAU", True, h) for h in (3e-4, 1.5e-4, 7.5e-5)]
    with tempfile.TemporaryDirectory() as folder:
        for name, words, keep, h in cases:
            steps = round(model.end / h)
            text = words + (" TANGENT KEPT" if keep and name != "radau" else "")
            found = program.Run(binary.resolve(), Path(folder), "andrews", text, h, options)
            values = [np.column_stack(part) for part in found.values]
            mine = make(name, model, h, keep, 1e-9)
            rows = []
            for k in range(steps):
                mine.step()
                mine.newton.end_step()
                if (k + 1) % (steps // 10) == 0:
                    q, v, f = mine.result()
                    rows.append((q - model.place[[2, 8, 14]], v, f))
            theirs, ours = (
                errors(values, exact),
                errors([np.array(p) for p in zip(*rows, strict=True)], exact),
            )
            count = mine.work["solve base"] - (2 * steps if name == "radau" else 0)
            for title, counted, e in (("program", found.iterations, theirs), ("prototype", count, ours)):
                cells = " | ".join(f"{x:.2e}" for x in e)
                print(f"| {title}, {text} | {steps} | {counted} | {cells} |", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--models", nargs="*", choices=MODELS, default=list(MODELS))
    parser.add_argument("--schemes", nargs="+", default=[*SHIPPED, *CANDIDATES])
    parser.add_argument("--csv", type=Path, help="all errors and counts")
    parser.add_argument("--read", type=Path, nargs="*", default=[], help="such files, in place of runs")
    parser.add_argument("--picture", type=Path)
    parser.add_argument("--energy", type=int, default=0)
    parser.add_argument("--check", type=Path)
    options = parser.parse_args()
    if options.check:
        check(options.check)
    if options.energy:
        energies(options.energy)
    rows = [row for path in options.read for row in read(path)]
    if not options.read:
        rows = [row for model in options.models for row in measure(model, options.schemes)]
    if options.csv:
        names = sorted({what for row in rows for what in row["work"]})
        with options.csv.open("w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerow(["model", "scheme", "kept", "steps", *KINDS, "left", *names])
            for r in rows:
                numbers = [f"{x:.3e}" for x in (*r["errors"], r["left"])]
                table.writerow(
                    [r["model"], r["scheme"], r["keep"], r["steps"], *numbers, *(r["work"][w] for w in names)]
                )
    if rows:
        report(rows, options.models, options.schemes)
    if options.picture:
        picture(rows, options.models, options.picture)


if __name__ == "__main__":
    main()
