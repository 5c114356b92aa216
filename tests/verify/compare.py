# SPDX-License-Identifier: BSD-3-Clause
"""Compares engrane's spur transmission (cases A to D of Cardona 1995) with its differential equation.

    python tests/verify/compare.py build/paper                all results of a folder
    python tests/verify/compare.py build/paper --cases AB

The folder holds spur_transmission_{a,b,c,d}.h5; spur_transmission_{c,d}_contact.h5 are compared where they
exist.

Exit status 0 when every comparison passes, 1 when one fails, 2 when a result is missing. Force in lbf, time
in s.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from engrane_post import Results

sys.path.insert(0, str(Path(__file__).resolve().parent))
from oracles import spur_transmission as oracle

CHANNEL = "element/7/NORMAL_FORCE"
PERIODS = 100  # tooth periods at the end of the run that are compared
AMPLITUDE_TOLERANCE = 0.002
SMOOTH_STATISTICS_TOLERANCE = 0.002
RATIO, RATIO_TOLERANCE = 1.40, 0.01
# Impacts amplify differences of the integrators; C and D are compared by statistics and by their first
# contacts.
STATISTICS_TOLERANCE = 0.02
PHASE_TOLERANCE = 2e-6


@dataclass
class Run:
    """A result of engrane: times, signed normal force, u_m + x_err if recorded, the law of damping and the
    sense of the load."""

    case: str
    path: Path
    t: np.ndarray
    normal: np.ndarray
    approach: np.ndarray | None
    damping: str
    torque: float
    notes: list[str] = field(default_factory=list)


def result_path(folder: Path, case: str, variant: str = "") -> Path:
    """Case C of variant "contact" is spur_transmission_c_contact.h5."""
    return folder / f"spur_transmission_{case.lower()}{'_' if variant else ''}{variant}.h5"


def load(path: Path, case: str, damping: str | None = None) -> Run:
    """Reads one result. The load's sense is that of the mean force; the law is the card's (CONTACT with
    backlash by default)."""
    with Results(path) as result:
        t, normal = result.history(CHANNEL)
        name = "element/7/TRANSMISSION_ERROR"
        approach = result.history(name)[1] if name in result.channels else None
        parameters: dict = next((e.parameters for e in result.elements if e.id == 7), {})
    if not np.isfinite(normal).all():
        raise ValueError(f"{path}: the normal force is not a number at t = {t[~np.isfinite(normal)][0]:g}")
    model = oracle.CASES[case]
    law = str(damping or parameters.get("DAMP")).upper()
    if law not in ("ALWAYS", "CONTACT"):
        law = "CONTACT" if model.b > 0 else "ALWAYS"
    torque = abs(model.torque) * (1 if normal.mean() > 0 else -1)
    return Run(case, path, t, normal, approach, law, torque)


def reference(run: Run, rtol: float = 1e-8) -> dict[str, np.ndarray]:
    """The oracle from the same start, at the run's times. Against 1e-10 its statistics change by 1e-7, and no
    contact begins at another sample."""
    return oracle.simulate(run.case, run.damping, float(run.t[-1]), rtol, torque=run.torque, times=run.t)


def tail(t: np.ndarray, periods: int = PERIODS) -> slice:
    """The last whole tooth periods of a history, at most two thirds of it."""
    period = oracle.Transmission().period
    span = min(periods, int((t[-1] - t[0]) * 2 / 3 / period)) * period
    return slice(int(np.searchsorted(t, t[-1] - span - 1e-12)), len(t))


def swing(t: np.ndarray, f: np.ndarray) -> float:
    """Amplitude: half of maximum minus minimum within each tooth period of the tail, averaged, so that the
    slow modes of the shafts, which take seconds to die out, do not count."""
    part = tail(t)
    t, f = t[part], f[part]
    number = np.floor((t - t[0]) / oracle.Transmission().period * (1 + 1e-9)).astype(int)
    counts = np.bincount(number)
    values = [np.ptp(f[number == k]) / 2 for k in range(len(counts)) if counts[k] >= 0.9 * counts.max()]
    return float(np.mean(values))


def overall(t: np.ndarray, f: np.ndarray) -> float:
    """Half of maximum minus minimum over the whole tail: what one reads off a figure, and what the paper's
    1.4 compares."""
    return float(np.ptp(f[tail(t)]) / 2)


def contacts(t: np.ndarray, f: np.ndarray, level: float = 1.0) -> list[tuple[float, float, float]]:
    """Phases of contact (start, end, extreme force): stretches in which |f| exceeds `level`, split where f
    changes sign."""
    side = np.where(f > level, 1, np.where(f < -level, -1, 0))
    change = np.flatnonzero(np.diff(side)) + 1
    out = []
    for a, b in zip(np.r_[0, change], np.r_[change, len(f)], strict=True):
        if side[a]:
            part = f[a:b]
            out.append((float(t[a]), float(t[b - 1]), float(part[np.argmax(np.abs(part))])))
    return out


def report(name: str, value: float, expected: float, tolerance: float, relative: bool = True) -> bool:
    """One line with the verdict."""
    error = abs(value - expected) / (abs(expected) if relative else 1.0)
    good = bool(error <= tolerance)
    kind = "relative" if relative else "absolute"
    print(
        f"  {'pass' if good else 'FAIL'}  {name}: {value:.6g}, expected {expected:.6g} "
        f"({kind} error {error:.2e}, allowed {tolerance:g})"
    )
    return good


def compare_smooth(run: Run) -> bool:
    """A and B: amplitude within 0.2 % and the whole history."""
    ref = reference(run)
    a, b = swing(run.t, run.normal), swing(run.t, ref["normal"])
    good = report("amplitude", a, b, AMPLITUDE_TOLERANCE)
    part = tail(run.t)
    for name in ("mean", "rms"):
        x, y = (oracle.statistics(run.t[part], f[part])[name] for f in (run.normal, ref["normal"]))
        good &= report(name, x, y, SMOOTH_STATISTICS_TOLERANCE)
    worst = float(np.abs(run.normal - ref["normal"]).max()) / b
    print(f"        largest difference of the histories: {worst:.2e} of the amplitude")
    s = oracle.statistics(run.t[tail(run.t)], run.normal[tail(run.t)])
    return report("strongest frequency", s["peaks"][0][0], 5000.0, 0.03) and good


def compare_impacts(run: Run) -> bool:
    """C and D: times and peaks of the first contacts, then mean, amplitude and rms of the tail."""
    ref = reference(run)
    good = True
    mine, theirs = contacts(run.t, run.normal), contacts(run.t, ref["normal"])
    scale = swing(run.t, ref["normal"])
    for k, (x, y) in enumerate(list(zip(mine, theirs, strict=False))[:6]):
        good &= report(f"contact {k + 1} begins", x[0], y[0], PHASE_TOLERANCE, relative=False)
        # A small peak inherits the error of the large ones before it: the scale is the amplitude.
        good &= report(f"contact {k + 1} peak", x[2], y[2], STATISTICS_TOLERANCE * scale, relative=False)
    part = tail(run.t)
    a, b = (
        oracle.statistics(run.t[part], run.normal[part]),
        oracle.statistics(run.t[part], ref["normal"][part]),
    )
    for name in ("mean", "rms"):
        good &= report(name, a[name], b[name], STATISTICS_TOLERANCE)
    good &= report("amplitude", swing(run.t, run.normal), swing(run.t, ref["normal"]), STATISTICS_TOLERANCE)
    for name, r in (("engrane", a), ("oracle", b)):
        print(f"        {name}: lines (Hz: lbf)", " ".join(f"{hz:.0f}: {x:.0f}" for hz, x in r["peaks"][:4]))
    return good


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, help="folder of spur_transmission_{a,b,c,d}.h5")
    parser.add_argument("--cases", default="ABCD", help="letters (default ABCD)")
    parser.add_argument(
        "--damping", choices=["ALWAYS", "CONTACT"], help="the law the decks use, if not recorded"
    )
    args = parser.parse_args(arguments)
    good = True
    amplitude = {}
    for case, variant in ((c, v) for c in args.cases.upper() for v in ("", "contact")):
        path = result_path(args.folder, case, variant)
        if not path.exists():
            if variant:
                continue
            print(f"There is no result {path}; run engrane on the deck first.", file=sys.stderr)
            return 2
        run = load(path, case, args.damping)
        print(f"case {case}: {path}, damping {run.damping}, {len(run.t)} samples to t = {run.t[-1]:g}")
        good &= (compare_smooth if oracle.CASES[case].b == 0 else compare_impacts)(run)
        if not variant:
            amplitude[case] = overall(run.t, run.normal)
    if {"A", "B"} <= amplitude.keys():
        good &= report(
            "amplitude B / amplitude A (paper: 1.4)",
            amplitude["B"] / amplitude["A"],
            RATIO,
            RATIO_TOLERANCE,
            False,
        )
    print("all comparisons pass" if good else "a comparison FAILED")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
