# SPDX-License-Identifier: BSD-3-Clause
"""Work and precision against Exudyn (PyPI), in turn: ratios of time at equal error.

    python -m venv /tmp/exudyn && /tmp/exudyn/bin/pip install exudyn numpy h5py
    /tmp/exudyn/bin/python tests/bench/against_exudyn.py build/bin/engrane
        [--models crank chain3 chain20 chain100 valves top] [--runs 5] [--more] [--newton 1e-8]
        [--picture docs/figures/beside_exudyn.png]

Models (paired_models.py, exudyn_peer.py): spatial slider-crank, chains of 3, 20 and 100 links, a valve
train, the heavy top. Both programs have the same bodies, joints, start and span; the cam is in Exudyn a lift
over time. Error: root of the mean square over the instants over the range, the worst of position and velocity
of the measured bodies. Truth: RADAU with TOL 1e-9; the error of the finest run of Exudyn against it shows
that both solve the same model.

Generalised-alpha with rho 0.8 and fixed steps in both, one thread. Exudyn: with modified Newton (its default)
and full Newton, the module without checks of ranges, and of its linear solvers the fastest for the model and
the iteration. Its processor time is that of its solution alone; that of this program is of the process
without that of a run of one step. Each round runs every setting once. Times of tables: the least of the
rounds. Ratios at equal error: both curves are interpolated in logarithms, in each round by itself; median,
least and largest of the rounds.

--more: bodies of Exudyn in rotation vectors, its trapezoidal rule, and the dial of this program. --newton:
relative tolerance of Exudyn's iterations in place of its default. --picture: work-precision diagrams of the
models, the settings of the dial among them (needs matplotlib).
"""

import argparse
import json
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from paired_models import ENVIRONMENT, MODELS, RHO, ROOT, Model, deck
from work_precision import Lines, draw

sys.path[:0] = [str(ROOT / "post")]
from engrane_post import Results  # noqa: E402

CHANNELS = ("UX", "UY", "UZ", "VX", "VY", "VZ")
SOLVERS = ("EXUdense", "EigenDense", "EigenSparse")
KEPT, FULL = "Exudyn, modified Newton", "Exudyn, full Newton"
KLU, MUMPS = "CHUNG KEPT, KLU", "CHUNG KEPT, MUMPS"
RADAU, CONTROLLED = "RADAU TOL", "CHUNG TOL"
DIAL = "the dial, with its estimate"
MARKS = {KEPT: "o-", FULL: "o:", KLU: "s-", MUMPS: "s:", RADAU: "^-", DIAL: "D--"}
TARGETS = [d * 10.0**-p for p in range(1, 9) for d in (1, 0.3)]


class Own:
    """Runs of this program."""

    def __init__(self, binary: Path, folder: Path, name: str) -> None:
        self.binary, self.folder, self.model = binary, folder, MODELS[name]
        self.text = deck(name)

    def run(self, analysis: str, stepping: str, end: float | None = None) -> tuple[float, np.ndarray]:
        """Seconds of the process, and the channels of the measured nodes (instants x channels)."""
        model = self.model
        text = re.sub(r"^\.CHK\n(?: .*\n)*", "", self.text, flags=re.M)
        static = " START STATIC" if model.static else ""
        text = re.sub(r"^\.SAM .*", f".SAM TYPE DYNAMIC {analysis} ENERGY 0{static}", text, flags=re.M)
        asked = "\n".join(f" NODE {n} {name} V 0 ATOL 1e30" for n in model.nodes for name in CHANNELS)
        interval = model.span / model.intervals
        archive = f".SAI FIELDS DT {model.span!r} HISTORY DT {interval!r}\n.CHK\n{asked}"
        text = re.sub(r"^\.SUB .*", f".SUB TF {end or model.span!r} {stepping}\n{archive}", text, flags=re.M)
        path = self.folder / "own.dat"
        path.write_text(text, encoding="utf-8")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(
            [self.binary, "-q", path, "-o", path.with_suffix("")],
            env=ENVIRONMENT,
            capture_output=True,
            text=True,
        )
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            raise RuntimeError(" ".join(done.stderr.split())[:150])
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        with Results(path.with_suffix(".h5")) as results:
            histories = [results.history(f"node/{n}/{name}") for n in model.nodes for name in CHANNELS]
        places = histories[0][0] / interval
        even = np.abs(places - np.round(places)) < 1e-3
        return seconds, np.array([values[even] for _, values in histories]).T

    def start(self) -> float:
        """Seconds of a run of one step."""
        step = self.model.span / max(self.model.steps)
        return min(self.run("SOLVER KLU", f"H {step!r}", step)[0] for _ in range(3))


def run_exudyn(name: str, steps: int, **words) -> tuple[float, np.ndarray]:
    model = MODELS[name]
    job = {"model": name, "steps": steps, "span": model.span, "intervals": model.intervals}
    job |= {"scheme": "GeneralizedAlpha", "kept": True, "lie": False, "solver": "EigenSparse"} | words
    script = Path(__file__).with_name("exudyn_peer.py")
    done = subprocess.run(
        [sys.executable, script, json.dumps(job)], env=ENVIRONMENT, capture_output=True, text=True
    )
    found = re.search(r"^RESULT (.*)$", done.stdout, re.MULTILINE)
    if not found:
        raise RuntimeError(" ".join((done.stdout + done.stderr).split())[-150:])
    seconds, rows = json.loads(found[1])
    return seconds, np.array(rows)


def error(values: np.ndarray, truth: np.ndarray) -> float:
    ranges = np.ptp(truth, axis=0)
    kinds = np.arange(ranges.size) // 3 % 2  # what hardly moves tells of rounding
    for kind in (0, 1):
        largest = ranges[kinds == kind].max()
        ranges[(kinds == kind) & (ranges <= 1e-6 * largest)] = np.inf
    return float((np.sqrt(np.mean((values - truth) ** 2, axis=0)) / ranges).max())


@dataclass
class Curve:
    """A setting with several steps or tolerances: seconds of each in each round, and errors."""

    runs: list[tuple[str, Callable[[], tuple[float, np.ndarray]]]]
    own: bool  #: the start of the program is in its times
    seconds: list[list[float]] = field(default_factory=list)  #: rounds x runs
    errors: list[float] = field(default_factory=list)
    failures: dict[int, str] = field(default_factory=dict)

    def take_round(self, truth: np.ndarray, start: float) -> None:
        times, errors = [], []
        for i, (_, task) in enumerate(self.runs):
            seconds, off = np.nan, np.nan
            if i not in self.failures:
                try:
                    seconds, values = task()
                    off = error(values, truth)
                except (RuntimeError, ValueError) as failure:
                    self.failures[i] = str(failure)
            times.append(max(seconds - start, 1e-4) if self.own else seconds)
            errors.append(off)
        self.seconds.append(times)
        self.errors = errors

    def at(self, target: float, times: list[float]) -> float:
        """Seconds at an error, NaN outside of the curve: between neighbours on both sides of it, least."""
        found = []
        for i in range(len(times) - 1):
            (e0, e1), (t0, t1) = self.errors[i : i + 2], times[i : i + 2]
            if e0 >= target >= e1 and e0 > e1:
                part = np.log(e0 / target) / np.log(e0 / e1)
                found.append(float(np.exp(np.log(t0) + part * np.log(t1 / t0))))
        return min(found, default=np.nan)

    @property
    def least(self) -> list[float]:
        return list(np.min(self.seconds, axis=0))


def fastest_solver(name: str, model: Model, kept: bool) -> str:
    steps = model.steps[len(model.steps) // 2]
    times = {}
    for solver in SOLVERS:
        if solver.endswith("ense") and name == "chain100":
            continue  # 1300 unknowns
        try:
            times[solver] = min(run_exudyn(name, steps, kept=kept, solver=solver)[0] for _ in range(3))
        except RuntimeError as failure:
            print(f"{solver} fails: {failure}")
    told = ", ".join(f"{solver} {1e6 * seconds / steps:.0f}" for solver, seconds in times.items())
    print(f"Exudyn, {'modified' if kept else 'full'} Newton, us per step: {told}.")
    return min(times, key=lambda solver: times[solver])


def curves(name: str, own: Own, more: bool, dial: bool, newton: float | None) -> dict[str, Curve]:
    model = MODELS[name]

    def fixed(analysis: str) -> Curve:
        return Curve(
            [(f"{n} steps", lambda n=n: own.run(analysis, f"H {model.span / n!r}")) for n in model.steps],
            True,
        )

    def controlled(analysis: str, tolerances: str) -> Curve:
        step = model.span / max(model.intervals, 1000)
        return Curve(
            [(f"TOL {t}", lambda t=t: own.run(analysis, f"H {step!r} TOL {t}")) for t in tolerances.split()],
            True,
        )

    def peer(**words) -> Curve:
        words["tolerance"] = newton
        return Curve([(f"{n} steps", lambda n=n: run_exudyn(name, n, **words)) for n in model.steps], False)

    kept, full = (fastest_solver(name, model, kept) for kept in (True, False))
    found = {
        KEPT: peer(kept=True, solver=kept),
        FULL: peer(kept=False, solver=full),
        KLU: fixed(f"RHO {RHO} SOLVER KLU TANGENT KEPT"),
        MUMPS: fixed(f"RHO {RHO} SOLVER MUMPS TANGENT KEPT"),
        CONTROLLED: controlled(f"RHO {RHO} SOLVER AUTO", "1e-2 1e-3 1e-4 1e-5 1e-6"),
        RADAU: controlled("SCHEME RADAU SOLVER AUTO", "1e-2 1e-3 1e-4 1e-5 1e-6 1e-7"),
    }
    if dial:
        step = model.span / 1000
        words = ("FAST", "NORMAL", "FINE", "REFERENCE")
        runs = [(word, lambda word=word: own.run(f"ACCURACY {word}", f"H {step!r}")) for word in words]
        found[DIAL] = Curve(runs, True)
    if more:
        found["Exudyn, rotation vectors"] = peer(kept=True, lie=True, solver=kept)
        found["Exudyn, trapezoidal, index 2"] = peer(kept=True, scheme="TrapezoidalIndex2", solver=kept)
    return found


def points(found: dict[str, Curve]) -> Lines:
    """What is drawn of a model: name, seconds and error of the runs of each curve that have an error."""
    return {
        label: [
            (name, s, e)
            for s, e, (name, _) in zip(curve.least, curve.errors, curve.runs, strict=True)
            if np.isfinite(e)
        ]
        for label, curve in found.items()
    }


def ratio_rows(title: str, found: dict[str, Curve]) -> list[str]:
    """At up to three errors that the generalised-alpha of both programs reach."""

    def covered(target: float) -> bool:
        return all(np.isfinite(found[c].at(target, found[c].least)) for c in (KEPT, FULL, KLU, MUMPS))

    rows, targets = [], [t for t in TARGETS if covered(t)]
    if len(targets) > 3:
        targets = [targets[0], targets[len(targets) // 2], targets[-1]]
    for target in targets:

        def cell(peer: str, mine: str, target: float = target) -> str:
            a, b = found[peer], found[mine]
            ratios = [a.at(target, s) / b.at(target, t) for s, t in zip(a.seconds, b.seconds, strict=True)]
            ratios = [r for r in ratios if np.isfinite(r)]
            if not ratios:
                return ""
            return f"{statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})"

        best = found[KEPT].at(target, found[KEPT].least)
        pairs = ((KEPT, KLU), (FULL, KLU), (KEPT, MUMPS), (KEPT, RADAU))
        cells = " | ".join(cell(*pair) for pair in pairs)
        rows.append(f"| {title} | {target:.0e} | {best:.3f} | {cells} |")
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("binary", type=Path)
    parser.add_argument("--models", nargs="+", choices=MODELS, default=list(MODELS))
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--more", action="store_true")
    parser.add_argument("--newton", type=float)
    parser.add_argument("--picture", type=Path)
    a = parser.parse_args()
    drawn = {}
    with tempfile.TemporaryDirectory() as folder:
        for name in a.models:
            model = MODELS[name]
            print(f"\n### {model.title}\n", flush=True)
            own = Own(a.binary.resolve(), Path(folder), name)
            truth = own.run("SCHEME RADAU SOLVER KLU", f"H {model.span / model.intervals!r} TOL 1e-9")[1]
            found = drawn[model.title] = curves(name, own, a.more, a.more or bool(a.picture), a.newton)
            for _ in range(a.runs):
                start = own.start()
                for curve in found.values():
                    curve.take_round(truth, start)
            print("\n| program and setting | | s | error |\n|---|---|---:|---:|")
            for title, curve in found.items():
                for i, (label, _) in enumerate(curve.runs):
                    told = curve.failures.get(i) or f"{curve.errors[i]:.1e}"
                    print(f"| {title} | {label} | {curve.least[i]:.4f} | {told} |")
            print("\nTimes of Exudyn over those of this program at equal error:\n")
            pairs = "modified / KLU | full / KLU | modified / MUMPS | modified / RADAU"
            print(f"| model | error | Exudyn, s | {pairs} |")
            print("|---|---|---:|---|---|---|---|")
            print("\n".join(ratio_rows(model.title, found)), flush=True)
    if a.picture:
        lines = {title: points(found) for title, found in drawn.items()}
        draw(lines, MARKS, DIAL, a.picture)


if __name__ == "__main__":
    main()
