# SPDX-License-Identifier: BSD-3-Clause
"""The tables Step length and Tolerance of docs/extremes.md.

    ENGRANE=build/bin/engrane python tests/bench/step_lengths.py [--no-tolerances]

A hundred steps from 1e-2 to 1e-9 of a period, of the models of tests/verify/test_small_steps.py; controlled
steps of those of tests/verify/test_every_tolerance.py. Errors and numbers of steps; no times.
"""

import argparse
import re
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.integrate import quad

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "post"), str(ROOT / "tests"), str(ROOT / "tests" / "verify")]
import test_every_tolerance as tolerances  # noqa: E402
import test_small_steps as small  # noqa: E402
from runs import Run, run  # noqa: E402

PARTS = [10.0**-k for k in range(2, 10)]


def period_of_pendulum() -> float:
    """Seconds of a turn: it starts level with 6 rad/s and passes its top."""
    return quad(lambda a: 1 / np.sqrt(36 + 4 * small.G / small.TURNING * np.sin(a)), 0, 2 * np.pi)[0]


def errors_of_crank(h: float, folder: Path) -> tuple[float, float]:
    """Of the rod's force on the slider and of the torque, over their largest."""
    r, rod, begin = 0.1, 0.3, np.radians(40)
    ax, ay = float(r * np.cos(begin)), float(r * np.sin(begin))
    bx = ax + float(np.sqrt(rod**2 - ay**2))
    result = run(small.CRANK.format(ax=ax, ay=ay, bx=bx, h=h, end=100 * h), folder)
    angle, rate = begin + 6 * result.t + 0.5 * result.t**2, 6 + result.t
    s, c = r * np.sin(angle), r * np.cos(angle)
    q = np.sqrt(rod**2 - s**2)
    slope, bend = -s - s * c / q, -c - (c * c - s * s) / q - (s * c) ** 2 / q**3
    force = slope + bend * rate**2
    torque = 0.01 + 0.5 * r * r + force * slope
    off = np.abs(np.abs(result["2/FORCE_X"]) - np.abs(force)).max() / np.abs(force).max()
    return off, np.abs(result["1/DRIVE_TORQUE"] - torque).max() / np.abs(torque).max()


def step_lengths(folder: Path) -> None:
    turn, turn_of_crank = period_of_pendulum(), 2 * np.pi / 6
    print(f"pendulum: a turn in {turn:.3f} s; crank: in {turn_of_crank:.3f} s\n")
    rows: dict[str, list[float]] = {}
    for part in PARTS:
        for rho in (0.8, 0.9, 0):
            found = small.errors_of_pendulum(small.pendulum(part * turn, folder, rho=rho), 6)
            for kind, error in zip(("angle", "speed", "reaction"), found, strict=True):
                rows.setdefault(f"pendulum, RHO {rho}: {kind}", []).append(error)
        for kind, error in zip(
            ("force", "torque"), errors_of_crank(part * turn_of_crank, folder), strict=True
        ):
            rows.setdefault(f"slider-crank: {kind}", []).append(error)
    print("| error of | " + " | ".join(f"{part:.0e}" for part in PARTS) + " |\n" + "|---" * 9 + "|")
    for title, errors in rows.items():
        print(f"| {title} | " + " | ".join(f"{error:.0e}" for error in errors) + " |")


def steps_of(folder: Path, name: str = "deck") -> int:
    listing = (folder / f"{name}.lst").read_text(encoding="utf-8")
    return int(re.findall(r"\n  (\d+) steps,", listing)[0])


def puck(folder: Path, tolerance: str) -> str:
    found = run(tolerances.controlled("elements/joints/stick_directions", tolerance), folder)
    t, begin, held = found.t, 0.5 * 2 * small.G / 20, 0.4 * 2 * small.G
    exact = np.where(t > begin, 0.8 * (10 * (t**2 - begin**2) - held * (t - begin)) / 2, 0)
    off = np.abs(found["node/5/VX"] - exact).max() / exact.max()
    return f"{steps_of(folder)} | {off:.1e}"


def bush(folder: Path, tolerance: str) -> str:
    found = run(tolerances.controlled("elements/springs/bushing_oscillator", tolerance), folder)
    w = np.sqrt(15.96)
    exact = 8 / w * np.exp(-0.2 * found.t) * np.sin(w * found.t)
    off = np.abs(found["2/ROTATION_1"] - exact).max() / np.ptp(exact)
    return f"{steps_of(folder)} | {off:.1e}"


def hoist(folder: Path, tolerance: str) -> str:
    found = run(tolerances.controlled("gears/worm_hold", tolerance), folder)
    listing = (folder / "deck.lst").read_text(encoding="utf-8")
    rest = re.search(r"(1\.000755\d*) +GEAR 3: comes to rest", listing)[1]
    off = np.abs(found["run/ENERGY_ERROR"]).max() / found["run/KINETIC_ENERGY"].max()
    return f"{steps_of(folder)} | {rest} | {off:.1e}"


def wheels(folder: Path) -> None:
    deck, archive = "gears/driven_play_tolerance", ".SAI HISTORY DT 1e-4\n"

    def early(found: Run) -> np.ndarray:
        return found["node/2/WZ"][found.t < 0.01]

    truth = early(
        run(
            tolerances.controlled(deck, "TOL 1e-10", archive=archive),
            folder,
            "truth",
            options=("--until", "0.01"),
            status=2,
        )
    )
    print("\n| TOL | CHUNG, steps | speed | RADAU, steps | speed |\n" + "|---" * 5 + "|")
    for k in range(3, 7):
        cells = []
        for scheme in ("SCHEME CHUNG", "SCHEME RADAU"):
            found = run(tolerances.controlled(deck, f"TOL 1e-{k}", scheme, archive), folder)
            off = np.abs(early(found) - truth).max() / 107
            cells.append(f"{steps_of(folder)} | {off:.1e}")
        print(f"| 1e-{k} | " + " | ".join(cells) + " |", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--no-tolerances", action="store_true")
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        step_lengths(folder)
        if a.no_tolerances:
            return
        print(
            "\n| TOL | puck | speed | bush | twist | hoist | at rest at t, s | energy |\n" + "|---" * 8 + "|"
        )
        for k in range(3, 12):
            cells = (task(folder, f"TOL 1e-{k}") for task in (puck, bush, hoist))
            print(f"| 1e-{k} | " + " | ".join(cells) + " |", flush=True)
        wheels(folder)


if __name__ == "__main__":
    main()
