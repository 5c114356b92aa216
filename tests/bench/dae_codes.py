# SPDX-License-Identifier: BSD-3-Clause
"""Andrews' squeezing mechanism and a spatial slider-crank by SUNDIALS IDA and by Hairer and Wanner's RADAU5,
beside this program.

    apt install r-cran-desolve
    python -m venv /tmp/dae && /tmp/dae/bin/pip install scikit-sundae numba numpy scipy h5py matplotlib
    /tmp/dae/bin/python tests/bench/dae_codes.py build/bin/engrane [--models andrews crank] [--runs 3]
        [--picture beside_ida.png]

Both codes solve the equations of dae_mechanisms.py, in three forms: index 3,

    q' = v,   M(q) v' = f(q, v) - G(q)^T lambda,   0 = g(q)

(RADAU5 only, as in the Test Set for IVP Solvers of the University of Bari); stabilised after C. W. Gear,
B. Leimkuhler and G. K. Gupta, J. Comput. Appl. Math. 12 (1985) 77-90, index 2:

    q' = v - G(q)^T mu,   M(q) v' = f(q, v) - G(q)^T lambda,   0 = g(q),   0 = G(q) v;

and with accelerations determined, index 1 (0 = G v' + G' v in place of 0 = g, constraints drift). RADAU5
takes equations linear in the derivatives: v' = a, with a among the unknowns. Multipliers (and a) are left out
of the error test, as the index demands. Residuals and Jacobians are machine code, the Jacobian is exact but
for the curvature terms of q and v, which central differences give; linear algebra: dense. IDA has one call
from Python per residual, RADAU5 none: it is the Fortran code of deSolve (K. Soetaert, T. Petzoldt and
R. W. Setzer, J. Stat. Softw. 33 (2010) 9), called without R. This program solves the decks: bodies of six
coordinates each.

Processor time of the integration only, the least of --runs, in turn. The column of digits is that of the test
set: of the worst component at the end.
"""

import argparse
import ctypes
import tempfile
import time
from pathlib import Path

import numba
import numpy as np
from dae_mechanisms import MECHANISMS, Mechanism, digits, error, run_engrane, with_forces
from numba import types
from work_precision import Lines, draw

#: deSolve as Debian installs it
RADAU5 = Path("/usr/lib/R/site-library/deSolve/libs/deSolve.so")
FORMS = {3: "index 3", 2: "stabilised index 2", 1: "index 1"}
TITLES = {"andrews": "Andrews' mechanism", "crank": "slider-crank"}
DIAL = "this program, settings of the dial"
IN_SPACE, IN_PLANE = "this program, RADAU with TOL", "this program, RADAU with TOL, PLANE AUTO"
#: label, words of .SAM, TOL
SETTINGS = [
    ("this program", "", ""),
    *((DIAL, f"ACCURACY {rung}", "") for rung in ("FAST", "NORMAL", "FINE", "REFERENCE")),
    *(
        (label, "SCHEME RADAU SOLVER KLU" + plane, tol)
        for label, plane in ((IN_SPACE, ""), (IN_PLANE, " PLANE AUTO"))
        for tol in ("1e-3", "1e-4", "1e-5", "1e-6", "1e-7")
    ),
]
#: of Matplotlib, by label
MARKS = {
    DIAL: "kD",
    IN_SPACE: "b-o",
    IN_PLANE: "c-o",
    "IDA, stabilised index 2": "r-s",
    "IDA, index 1": "r:s",
    "RADAU5, stabilised index 2": "g-^",
    "RADAU5, index 1": "g:^",
}


class IdaPeer:
    """One mechanism in IDA's form, index 2 or 1."""

    def __init__(self, mechanism: Mechanism, index: int) -> None:
        self.title = f"IDA, {FORMS[index]}"
        self.mechanism, self.index = mechanism, index
        n, m, terms = len(mechanism.place), mechanism.constraints, mechanism.terms

        @numba.njit
        def residual(y, yp, out):
            mass, jacobian = np.empty((n, n)), np.empty((m, n))
            force, closure, curvature = np.empty(n), np.empty(m), np.empty(m)
            v = y[n : 2 * n]
            terms(y[:n], v, mass, force, jacobian, closure, curvature)
            out[:n] = yp[:n] - v
            out[n : 2 * n] = mass @ yp[n : 2 * n] - force + jacobian.T @ y[2 * n : 2 * n + m]
            if index == 2:
                out[:n] += jacobian.T @ y[2 * n + m :]
                out[2 * n : 2 * n + m] = closure
                out[2 * n + m :] = jacobian @ v
            else:
                out[2 * n :] = jacobian @ yp[n : 2 * n] + curvature

        @numba.njit
        def tangent(y, yp, out, cj):
            """d residual/dy + cj d residual/dy'; by differences in q and v, exact in the rest."""
            high, low = np.empty(y.size), np.empty(y.size)
            out[:] = 0.0
            for j in range(2 * n):
                size = 1e-6 if j < n else 1e-6 * (1.0 + abs(y[j]))
                moved = y.copy()
                moved[j] = y[j] + size
                residual(moved, yp, high)
                moved[j] = y[j] - size
                residual(moved, yp, low)
                out[:, j] = (high - low) / (2 * size)
            mass, jacobian = np.empty((n, n)), np.empty((m, n))
            force, closure, curvature = np.empty(n), np.empty(m), np.empty(m)
            terms(y[:n], y[n : 2 * n], mass, force, jacobian, closure, curvature)
            out[n : 2 * n, 2 * n : 2 * n + m] = jacobian.T
            for i in range(n):
                out[i, i] += cj
            out[n : 2 * n, n : 2 * n] += cj * mass
            if index == 2:
                out[:n, 2 * n + m :] = jacobian.T
            else:
                out[2 * n :, n : 2 * n] += cj * jacobian

        self.residual, self.tangent = residual, tangent
        state = with_forces(np.r_[mechanism.place, mechanism.speed], mechanism)
        more = np.zeros(m if index == 2 else 0)
        self.start = np.r_[state[: 2 * n], state[3 * n :], more]
        self.rates = np.r_[mechanism.speed, state[2 * n : 3 * n], np.zeros(m), more]

    def run(self, tolerance: float, times: np.ndarray) -> dict:
        from sksundae.ida import IDA

        calls = [0, 0]

        def res(_t, y, yp, out):
            calls[0] += 1
            self.residual(y, yp, out)

        def jac(_t, y, yp, _res, cj, out):
            calls[1] += 1
            self.tangent(y, yp, out, cj)

        n, size = len(self.mechanism.place), self.start.size
        # multipliers: no error test
        absolute = np.r_[
            np.full(n, tolerance), np.full(n, self.mechanism.scale * tolerance), np.full(size - 2 * n, 1e20)
        ]
        solver = IDA(
            res,
            rtol=tolerance,
            atol=absolute,
            jacfn=jac,
            linsolver="dense",
            max_num_steps=1000000,
            algebraic_idx=list(range(2 * n, size)),
            first_step=1e-7 if self.index == 2 else 0,
        )
        before = time.process_time()
        found = solver.solve(times, self.start, self.rates)
        seconds = time.process_time() - before
        if not found.success:
            raise RuntimeError(found.message)
        return {"seconds": seconds, "values": np.asarray(found.y)[:, : 2 * n], "work": ["", *calls]}


NUMBERS, INTEGERS = types.CPointer(types.float64), types.CPointer(types.int32)
FCN = types.void(INTEGERS, NUMBERS, NUMBERS, NUMBERS, NUMBERS, INTEGERS)
JAC = types.void(INTEGERS, NUMBERS, NUMBERS, INTEGERS, INTEGERS, NUMBERS, INTEGERS, NUMBERS, INTEGERS)
MAS = types.void(INTEGERS, NUMBERS, INTEGERS, NUMBERS, INTEGERS)
SOLOUT = types.void(
    INTEGERS,
    NUMBERS,
    NUMBERS,
    NUMBERS,
    NUMBERS,
    INTEGERS,
    INTEGERS,
    NUMBERS,
    INTEGERS,
    INTEGERS,
    NUMBERS,
)


class Radau5Peer:
    """One mechanism in the form of RADAU5, diag(1, ..., 1, 0, ..., 0) y' = f(y), index 3, 2 or 1. y is
    q, v, a = v', lambda and, index 2, mu."""

    def __init__(self, mechanism: Mechanism, index: int) -> None:
        self.title = f"RADAU5, {FORMS[index]}"
        self.mechanism, self.index = mechanism, index
        n, m, terms = len(mechanism.place), mechanism.constraints, mechanism.terms
        size = 3 * n + (2 * m if index == 2 else m)
        # index 3: the first 2 n equations say y(i)' = y(i + n), which RADAU5 eliminates (IWORK(9), IWORK(10))
        plain = 2 * n if index == 3 else 0

        @numba.njit
        def function(y, out):
            mass, jacobian = np.empty((n, n)), np.empty((m, n))
            force, closure, curvature = np.empty(n), np.empty(m), np.empty(m)
            v, a = y[n : 2 * n], y[2 * n : 3 * n]
            terms(y[:n], v, mass, force, jacobian, closure, curvature)
            out[: 2 * n] = y[n : 3 * n]
            out[2 * n : 3 * n] = mass @ a - force + jacobian.T @ y[3 * n : 3 * n + m]
            if index == 3:
                out[3 * n :] = closure
            elif index == 2:
                out[:n] -= jacobian.T @ y[3 * n + m :]
                out[3 * n : 3 * n + m] = closure
                out[3 * n + m :] = jacobian @ v
            else:
                out[3 * n :] = jacobian @ a + curvature

        @numba.njit
        def tangent(y, out):
            high, low = np.empty(y.size), np.empty(y.size)
            out[:] = 0.0
            for j in range(2 * n):
                step = 1e-6 if j < n else 1e-6 * (1.0 + abs(y[j]))
                moved = y.copy()
                moved[j] = y[j] + step
                function(moved, high)
                moved[j] = y[j] - step
                function(moved, low)
                out[:, j] = (high - low) / (2 * step)
            mass, jacobian = np.empty((n, n)), np.empty((m, n))
            force, closure, curvature = np.empty(n), np.empty(m), np.empty(m)
            terms(y[:n], y[n : 2 * n], mass, force, jacobian, closure, curvature)
            for i in range(n):
                out[n + i, 2 * n + i] = 1.0
            out[2 * n : 3 * n, 2 * n : 3 * n] = mass
            out[2 * n : 3 * n, 3 * n : 3 * n + m] = jacobian.T
            if index == 2:
                out[:n, 3 * n + m :] = -jacobian.T
            elif index == 1:
                out[3 * n :, 2 * n : 3 * n] = jacobian

        @numba.cfunc(FCN)
        def fcn(_size, _t, y, out, _rpar, _ipar):
            function(numba.carray(y, size), numba.carray(out, size))

        @numba.cfunc(JAC)
        def jac(_size, _t, y, _lower, _upper, out, _rows, _rpar, _ipar):
            whole = np.empty((size, size))
            tangent(numba.carray(y, size), whole)
            columns = numba.carray(out, (size, size - plain))  # Fortran's order
            columns[:] = whole[plain:].T

        @numba.cfunc(MAS)
        def mas(_size, diagonal, _rows, _rpar, _ipar):
            ones = numba.carray(diagonal, size - plain)
            ones[:] = 0.0
            ones[: 2 * n - plain] = 1.0

        contr5 = ctypes.CDLL(str(RADAU5)).contr5_
        contr5.argtypes, contr5.restype = [ctypes.c_void_p] * 5, None

        @numba.cfunc(SOLOUT)
        def solout(_number, _before, t, _y, dense, length, _size, rpar, ipar, _stop, _out):
            """rpar: instants, then q and v at each; ipar: how many instants, how many are done."""
            counts = numba.carray(ipar, 2)
            numbers = numba.carray(rpar, counts[0] * (1 + 2 * n))
            found, instant = np.empty(size), np.empty(1)
            sizes = np.array([size, length[0]], dtype=np.int32)
            polynomial = numba.carray(dense, length[0])
            while counts[1] < counts[0] and numbers[counts[1]] <= t[0]:
                instant[0] = numbers[counts[1]]
                contr5(sizes.ctypes, instant.ctypes, polynomial.ctypes, sizes[1:].ctypes, found.ctypes)
                row = counts[0] + counts[1] * 2 * n
                numbers[row : row + 2 * n] = found[: 2 * n]
                counts[1] += 1

        self.callbacks = fcn, jac, mas, solout
        self.plain, self.size, self.start = plain, size, np.zeros(size)
        self.start[: 2 * n] = np.r_[mechanism.place, mechanism.speed]
        self.start[: 3 * n + m] = with_forces(self.start[: 2 * n], mechanism)

    def run(self, tolerance: float, times: np.ndarray) -> dict:
        n, size = len(self.mechanism.place), self.size
        y, relative = self.start.copy(), np.full(size, tolerance)
        # a and multipliers: no error test
        absolute = np.r_[
            np.full(n, tolerance), np.full(n, self.mechanism.scale * tolerance), np.full(size - 2 * n, 1e20)
        ]
        results = np.r_[times, np.zeros(times.size * 2 * n)]
        results[times.size : times.size + 2 * n] = y[: 2 * n]
        counts = np.array([times.size, 1], dtype=np.int32)
        rest = size - self.plain
        work, numbers = np.zeros(size * (4 * size + 20) + 20), np.zeros(3 * size + 20, dtype=np.int32)
        numbers[1] = 1_000_000  # steps
        numbers[4:7] = {3: (n, n, size - 2 * n), 2: (2 * n, size - 2 * n, 0), 1: (size, 0, 0)}[self.index]
        numbers[8:10] = self.plain, n
        state = np.array([0.0, times[-1], 1e-6 * times[-1]])
        given = np.array([size, 1, 1, rest, 0, 1, 0, 0, 1, work.size, numbers.size, 0], dtype=np.int32)
        place = lambda array, k=0: ctypes.c_void_p(array.ctypes.data + k * array.itemsize)  # noqa: E731
        fcn, jac, mas, solout = (ctypes.c_void_p(callback.address) for callback in self.callbacks)
        before = time.process_time()
        ctypes.CDLL(str(RADAU5)).radau5_(
            place(given), fcn, place(state), place(y), place(state, 1), place(state, 2),
            place(relative), place(absolute), place(given, 1),
            jac, place(given, 2), place(given, 3), place(given, 4),
            mas, place(given, 5), place(given, 6), place(given, 7),
            solout, place(given, 8), place(work), place(given, 9), place(numbers), place(given, 10),
            place(results), place(counts), place(given, 11),
        )  # fmt: skip
        seconds = time.process_time() - before
        if given[11] != 1:
            raise RuntimeError(f"IDID {given[11]}")
        values = results[times.size :].reshape(times.size, 2 * n)
        return {"seconds": seconds, "values": values, "work": numbers[[15, 13, 14]].tolist()}


def measure(
    binary: Path, mechanism: Mechanism, peers: list, times: np.ndarray, runs: int
) -> dict[tuple[str, str], list[dict]]:
    """Runs of each code, by label and setting, in turn; seconds of this program without its start-up."""
    for peer in peers:
        peer.run(1e-3, times)  # compiles
    rows: dict[tuple[str, str], list[dict]] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        starts = [run_engrane(binary, folder, mechanism, "SOLVER KLU", "", mechanism.step) for _ in range(5)]
        begin = min(start["seconds"] for start in starts)
        for _ in range(runs):
            for label, analysis, tol in SETTINGS:
                found = run_engrane(binary, folder, mechanism, analysis, tol and f" TOL {tol}")
                found["seconds"] -= begin
                setting = tol or analysis.removeprefix("ACCURACY ") or "as it is"
                rows.setdefault((label, setting), []).append(found)
            for peer in peers:
                for tolerance in (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10):
                    row = rows.setdefault((peer.title, f"{tolerance:g}"), [])
                    try:
                        row.append(peer.run(tolerance, times))
                    except RuntimeError as failure:
                        row.append({"failure": str(failure)[:80]})
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("binary", type=Path)
    parser.add_argument("--models", nargs="+", choices=MECHANISMS, default=list(MECHANISMS))
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--picture", type=Path, help="PNG to draw, needs matplotlib")
    a = parser.parse_args()
    drawn: dict[str, Lines] = {}
    for model in a.models:
        mechanism = MECHANISMS[model]()
        times = np.linspace(0, mechanism.end, mechanism.instants + 1)
        true = mechanism.truth(times)
        peers = [IdaPeer(mechanism, index) for index in (2, 1)]
        if RADAU5.exists():
            peers += [Radau5Peer(mechanism, index) for index in (3, 2, 1)]
        else:
            print(f"without RADAU5: there is no {RADAU5} (apt install r-cran-desolve)")
        print(
            f"\n{model}\n\n| program | setting | s | error | digits | steps | residuals | tangents |\n"
            + "|---" * 8
            + "|"
        )
        lines = drawn.setdefault(TITLES[model], {})
        for (label, setting), runs in measure(a.binary.resolve(), mechanism, peers, times, a.runs).items():
            if "failure" in runs[0]:
                print(f"| {label} | {setting} | failed: {runs[0]['failure']} |")
                continue
            seconds = min(r["seconds"] for r in runs)
            off = error(runs[0]["values"], true, mechanism)
            exact = digits(runs[0]["values"], true, mechanism)
            work = " | ".join(map(str, runs[0]["work"]))
            print(f"| {label} | {setting} | {seconds:.4f} | {off:.1e} | {exact:.2f} | {work} |")
            lines.setdefault(label, []).append((setting, seconds, off))
    if a.picture:
        # without RADAU5 its lines are missing
        marks = {
            label: mark for label, mark in MARKS.items() if all(label in lines for lines in drawn.values())
        }
        draw(drawn, marks, DIAL, a.picture, one_scale=True)


if __name__ == "__main__":
    main()
