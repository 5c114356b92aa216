# SPDX-License-Identifier: BSD-3-Clause
"""Andrews' squeezing mechanism by SUNDIALS IDA, with the same error measure as tests/bench/accuracy.py.

    python -m venv /tmp/ida && /tmp/ida/bin/pip install scikit-sundae numba numpy scipy h5py
    /tmp/ida/bin/python tests/bench/ida.py build/bin/engrane [--runs 3]

IDA solves the mechanism in its seven angles with the data of tests/verify/oracles/andrews.py, stabilised after C. W. Gear,
B. Leimkuhler and G. K. Gupta, J. Comput. Appl. Math. 12 (1985) 77-90, eq. (5):

    q' = v - G(q)^T mu,   M(q) v' = f(q, v) - G(q)^T lambda,   0 = g(q),   0 = G(q) v

(index 2, 26 equations; lambda and mu are left out of IDA's error test, as index 2 demands) and with accelerations determined,
index 1 (20 equations: 0 = G v' + G' v in place of 0 = g, constraints drift). Residuals and Jacobians are machine code (numba), the
Jacobian is exact but for the curvature terms of q, which central differences give; linear solver: dense. What is left of Python is
one call per residual, which `calls` counts. This program solves the deck decks/mechanisms/andrews_squeezer.dat: seven bodies of six
coordinates each.

Error: root of the mean square over 150 instants over the range, the worst of three angles and their speeds. Truth: the ordinary
differential equation of the oracle by DOP853, 1e-12. Processor time of the integration only, the least of --runs, in turn.
"""

import argparse
import os
import re
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numba
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / "verify" / "oracles")]
import andrews as data  # noqa: E402
import h5py  # noqa: E402

END, INSTANTS = 0.03, 150
MASS, INERTIA, TURN = data.MASS, data.INERTIA, data.TURN.astype(float)
NAMES = list(data.POINTS)
#: points of bodies: table of (c, s) by point and body
ARMS = np.zeros((len(NAMES), 7, 2))
for row, name in enumerate(NAMES):
    for body, c, s in data.POINTS[name]:
        ARMS[row, body] += c, s
MASSES = np.array([NAMES.index(str(i + 1)) for i in range(7)])
LOOPS = np.array([[NAMES.index(one), NAMES.index(other)] for one, other, _ in data.LOOPS])
GROUNDS = np.array([ground for _, _, ground in data.LOOPS])
SPRING = NAMES.index("D")
A_B, A_C, C0, L0, TORQUE = data.B, data.C, data.C0, data.L0, data.TORQUE


@numba.njit(cache=True)
def terms(q, v, mass, force, jacobian, closure, curvature):
    """M (7 x 7), f (7), G (6 x 7), g (6) and G' v (6) of the mechanism at q, v."""
    angle, turn = TURN @ q, TURN @ v
    cos, sin = np.cos(angle), np.sin(angle)
    mass[:], force[:] = 0.0, 0.0
    for i in range(7):
        for a in range(7):
            for b in range(7):
                mass[a, b] += INERTIA[i] * TURN[i, a] * TURN[i, b]
    velocity = np.zeros((2, 7))
    for i in range(7):
        velocity[:], bend = 0.0, np.zeros(2)
        for body in range(7):
            c, s = ARMS[MASSES[i], body]
            if c == 0.0 and s == 0.0:
                continue
            x, y = c * cos[body] - s * sin[body], c * sin[body] + s * cos[body]
            for a in range(7):
                velocity[0, a] -= y * TURN[body, a]
                velocity[1, a] += x * TURN[body, a]
            bend[0] -= x * turn[body] ** 2
            bend[1] -= y * turn[body] ** 2
        for a in range(7):
            force[a] -= MASS[i] * (velocity[0, a] * bend[0] + velocity[1, a] * bend[1])
            for b in range(7):
                mass[a, b] += MASS[i] * (velocity[0, a] * velocity[0, b] + velocity[1, a] * velocity[1, b])
    force[0] += TORQUE
    reach, along = A_B - A_C, np.zeros((2, 7))
    for body in range(7):
        c, s = ARMS[SPRING, body]
        x, y = c * cos[body] - s * sin[body], c * sin[body] + s * cos[body]
        reach = reach + np.array([x, y])
        for a in range(7):
            along[0, a] -= y * TURN[body, a]
            along[1, a] += x * TURN[body, a]
    length = np.sqrt(reach[0] ** 2 + reach[1] ** 2)
    pull = -C0 * (length - L0) / length
    for a in range(7):
        force[a] += pull * (reach[0] * along[0, a] + reach[1] * along[1, a])
    jacobian[:], curvature[:] = 0.0, 0.0
    for k in range(3):
        closure[2 * k], closure[2 * k + 1] = -GROUNDS[k, 0], -GROUNDS[k, 1]
        for body in range(7):
            c = ARMS[LOOPS[k, 0], body, 0] - ARMS[LOOPS[k, 1], body, 0]
            s = ARMS[LOOPS[k, 0], body, 1] - ARMS[LOOPS[k, 1], body, 1]
            x, y = c * cos[body] - s * sin[body], c * sin[body] + s * cos[body]
            closure[2 * k] += x
            closure[2 * k + 1] += y
            curvature[2 * k] -= x * turn[body] ** 2
            curvature[2 * k + 1] -= y * turn[body] ** 2
            for a in range(7):
                jacobian[2 * k, a] -= y * TURN[body, a]
                jacobian[2 * k + 1, a] += x * TURN[body, a]


@numba.njit(cache=True)
def residual(y, yp, out, index):
    mass, jacobian = np.empty((7, 7)), np.empty((6, 7))
    force, closure, curvature = np.empty(7), np.empty(6), np.empty(6)
    q, v, load = y[:7], y[7:14], y[14:20]
    terms(q, v, mass, force, jacobian, closure, curvature)
    out[:7] = yp[:7] - v
    out[7:14] = mass @ yp[7:14] - force + jacobian.T @ load
    if index == 2:
        out[:7] += jacobian.T @ y[20:26]
        out[14:20] = closure
        out[20:26] = jacobian @ v
    else:
        out[14:20] = jacobian @ yp[7:14] + curvature


@numba.njit(cache=True)
def tangent(y, yp, out, cj, index):
    """d residual/dy + cj d residual/dy'; by differences in q and v, exact in the rest."""
    n = y.size
    high, low = np.empty(n), np.empty(n)
    out[:] = 0.0
    for j in range(14):
        size = 1e-6 if j < 7 else 1e-6 * (1.0 + abs(y[j]))
        moved = y.copy()
        moved[j] = y[j] + size
        residual(moved, yp, high, index)
        moved[j] = y[j] - size
        residual(moved, yp, low, index)
        out[:, j] = (high - low) / (2 * size)
    mass, jacobian = np.empty((7, 7)), np.empty((6, 7))
    force, closure, curvature = np.empty(7), np.empty(6), np.empty(6)
    terms(y[:7], y[7:14], mass, force, jacobian, closure, curvature)
    out[7:14, 14:20] = jacobian.T
    for i in range(7):
        out[i, i] += cj
    out[7:14, 7:14] += cj * mass
    if index == 2:
        out[:7, 20:26] = jacobian.T
    else:
        out[14:20, 7:14] += cj * jacobian


def start(index: int) -> tuple[np.ndarray, np.ndarray]:
    """Consistent values: at rest, accelerations and multipliers from the linear system."""
    q = data.assemble(data.START)
    mass, jacobian = np.empty((7, 7)), np.empty((6, 7))
    force, closure, curvature = np.empty(7), np.empty(6), np.empty(6)
    terms(q, np.zeros(7), mass, force, jacobian, closure, curvature)
    whole = np.block([[mass, jacobian.T], [jacobian, np.zeros((6, 6))]])
    solution = np.linalg.solve(whole, np.r_[force, -curvature])
    more = np.zeros(6 if index == 2 else 0)
    return np.r_[q, np.zeros(7), solution[7:], more], np.r_[np.zeros(7), solution[:7], np.zeros(6), more]


def run_ida(tolerance: float, index: int, times: np.ndarray) -> dict:
    from sksundae.ida import IDA

    calls = [0, 0]

    def res(_t, y, yp, out):
        calls[0] += 1
        residual(y, yp, out, index)

    def jac(_t, y, yp, _res, cj, out):
        calls[1] += 1
        tangent(y, yp, out, cj, index)

    y0, yp0 = start(index)
    # multipliers: no error test. Angles of order one, speeds of a thousand.
    absolute = np.r_[np.full(7, tolerance), np.full(7, 1e3 * tolerance), np.full(y0.size - 14, 1e20)]
    solver = IDA(
        res, rtol=tolerance, atol=absolute, jacfn=jac, linsolver="dense", max_num_steps=1000000,
        algebraic_idx=list(range(14, y0.size)), first_step=1e-7 if index == 2 else 0,
    )
    before = time.process_time()
    found = solver.solve(times, y0, yp0)
    seconds = time.process_time() - before
    if not found.success:
        raise RuntimeError(found.message)
    return {"seconds": seconds, "values": np.asarray(found.y)[:, :14], "calls": calls}


def run_engrane(binary: Path, folder: Path, words: str, times: np.ndarray, end: float = END) -> dict:
    text = (ROOT / "decks/mechanisms/andrews_squeezer.dat").read_text(encoding="utf-8")
    text = re.sub(r"^\.CHK\n(?: .*\n)*", "", text, flags=re.M)
    if words:
        text = re.sub(r"^\.SAM .*", f".SAM TYPE DYNAMIC {words.split('|')[0]} ENERGY 0", text, flags=re.M)
    more = words.split("|")[1] if "|" in words else ""
    asked = " ELEMENT 11 ANGLE V 0 ATOL 1e30\n ELEMENT 13 ANGLE V 0 ATOL 1e30\n ELEMENT 15 ANGLE V 0 ATOL 1e30\n"
    asked += " ELEMENT 11 SPEED V 0 ATOL 1e30\n ELEMENT 13 SPEED V 0 ATOL 1e30\n ELEMENT 15 SPEED V 0 ATOL 1e30"
    card = f".SUB TF {end!r} H 2e-5{more}\n.SAI FIELDS DT {END!r} HISTORY DT {END / INSTANTS!r}\n.CHK\n{asked}"
    text = re.sub(r"^\.SUB .*", card, text, flags=re.M)
    path = folder / "andrews.dat"
    path.write_text(text, encoding="utf-8")
    environment = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([binary, "-q", path, "-o", path.with_suffix("")], env=environment, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if end < END:
        return {"seconds": seconds}
    sys.path[:0] = [str(ROOT / "post")]
    from engrane_post import Results

    with Results(path.with_suffix(".h5")) as results:
        table = {}
        for i, element in ((0, 11), (2, 13), (4, 15)):
            t, angle = results.history(f"element/{element}/ANGLE")
            speed = results.history(f"element/{element}/SPEED")[1]
            places = t / (END / INSTANTS)
            even = np.abs(places - np.round(places)) < 1e-3
            table[i], table[7 + i] = angle[even] + data.START[i], speed[even]
    values = np.full((len(times), 14), np.nan)
    for column, history in table.items():
        values[:, column] = history
    return {"seconds": seconds, "values": values}


def truth(times: np.ndarray) -> np.ndarray:
    """Seven angles and their rates by the oracle's equation in one coordinate."""
    from scipy.integrate import solve_ivp

    known = [data.assemble(data.START)]

    def place(beta: float) -> np.ndarray:
        near = known[-1]
        known[-1] = data.assemble(near + data.coefficients(near)[0] * (beta - near[0]))
        return known[-1]

    y = solve_ivp(
        lambda _, y: [y[1], data.acceleration(place(y[0]), y[1])],
        (0, times[-1]), [data.START[0], 0.0], "DOP853", t_eval=times, rtol=1e-12, atol=1e-12,
    ).y
    known[-1] = data.assemble(data.START)
    out = np.empty((len(times), 14))
    for k, (beta, speed) in enumerate(y.T):
        out[k, :7] = place(beta)
        out[k, 7:] = data.coefficients(out[k, :7])[0] * speed
    return out


def error(values: np.ndarray, true: np.ndarray) -> float:
    columns = [0, 2, 4, 7, 9, 11]
    off = np.sqrt(np.mean((values - true)[:, columns] ** 2, axis=0))
    return float((off / np.ptp(true[:, columns], axis=0)).max())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=Path)
    parser.add_argument("--runs", type=int, default=3)
    a = parser.parse_args()
    times = np.linspace(0, END, INSTANTS + 1)
    true = truth(times)
    rows: dict[str, list[dict]] = {}
    run_ida(1e-3, 1, times), run_ida(1e-3, 2, times)  # compiles
    own = ["", "ACCURACY FAST", "ACCURACY NORMAL", "ACCURACY FINE", "ACCURACY REFERENCE"]
    own += [f"SCHEME RADAU SOLVER KLU| TOL {t}" for t in ("1e-3", "1e-4", "1e-5", "1e-6", "1e-7")]
    with tempfile.TemporaryDirectory() as name:
        for _ in range(a.runs):
            begin = run_engrane(a.binary.resolve(), Path(name), "SOLVER KLU", times, 2e-5)["seconds"]
            for words in own:
                found = run_engrane(a.binary.resolve(), Path(name), words, times)
                found["seconds"] -= begin
                rows.setdefault("this program, " + (words.replace("|", "") or "as it is"), []).append(found)
            for index in (2, 1):
                for tolerance in (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10):
                    title = f"IDA, {'stabilised index 2' if index == 2 else 'index 1'}, rtol {tolerance:g}"
                    try:
                        rows.setdefault(title, []).append(run_ida(tolerance, index, times))
                    except RuntimeError as failure:
                        rows.setdefault(title, []).append({"failure": str(failure)[:80]})
    print("| program | s | error | calls of residual | of tangent |\n" + "|---" * 5 + "|")
    for title, runs in rows.items():
        if "failure" in runs[0]:
            print(f"| {title} | failed: {runs[0]['failure']} |")
            continue
        calls = runs[0].get("calls", ("", ""))
        seconds = min(r["seconds"] for r in runs)
        print(f"| {title} | {seconds:.3f} | {error(runs[0]['values'], true):.1e} | {calls[0]} | {calls[1]} |")


if __name__ == "__main__":
    main()
