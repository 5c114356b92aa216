# SPDX-License-Identifier: BSD-3-Clause
"""Draws the paper's figures 6 and 7 (tooth force without and with backlash) from engrane's results, the
differential equation over them, and their spectra.

    python tests/verify/paper_figures.py --build build              results in build/paper or decks/paper
    python tests/verify/paper_figures.py --oracle-only -o out       without results: the differential equation
    alone
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import compare
from oracles import spur_transmission as oracle

ROOT = Path(__file__).resolve().parents[2]
SHOWN = 8  # tooth periods drawn
FIGURES = (("figure_6", "no backlash", "AB"), ("figure_7", "with backlash", "CD"))
SUPPORTS = {
    "A": "rigid supports (A)",
    "B": "flexible supports (B)",
    "C": "rigid supports (C)",
    "D": "flexible supports (D)",
}
BLUE, ORANGE = "#1f5fa8", "#d1571b"


def find_results(build: Path, given: Path | None) -> Path | None:
    """The first folder that holds all four results."""
    for folder in (
        [given] if given else [build / "paper", build / "decks" / "paper", build, ROOT / "decks" / "paper"]
    ):
        if folder and all(compare.result_path(folder, c).exists() for c in "ABCD"):
            return folder
    return None


def spectrum(t: np.ndarray, f: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Single-sided amplitudes, hann window; evenly sampled."""
    window = np.hanning(len(f) + 1)[:-1]
    a = np.abs(np.fft.rfft((f - f.mean()) * window, 4 * len(f))) * 2 / window.sum()
    return np.fft.rfftfreq(4 * len(f), (t[-1] - t[0]) / (len(t) - 1)), a


def even(t: np.ndarray, f: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Even samples at the mean step."""
    grid = np.linspace(t[0], t[-1], len(t))
    return grid, np.interp(grid, t, f)


def draw(name: str, title: str, cases: str, curves: dict[str, list[tuple]], output: Path) -> Path:
    """One figure: force against time above, spectra below, one column per case."""
    figure, axes = plt.subplots(2, 2, figsize=(11, 6.8), layout="constrained")
    for column, case in enumerate(cases):
        top, bottom = axes[0, column], axes[1, column]
        period = oracle.Transmission().period
        for label, t, f, color, dashes in curves[case]:
            shown = t >= t[-1] - SHOWN * period
            top.plot(
                (t[shown] - t[-1]) * 1e3,
                f[shown] / 1e3,
                color=color,
                linestyle=dashes,
                linewidth=1.2,
                label=label,
            )
            part = compare.tail(t, 40)
            hz, a = spectrum(*even(t[part], f[part]))
            low = hz <= 50e3
            bottom.plot(
                hz[low] / 1e3, a[low] / 1e3, color=color, linestyle=dashes, linewidth=1.2, label=label
            )
        for order in range(1, 11):
            bottom.axvline(5 * order, color="#bbbbbb", linewidth=0.7, zorder=0)
        top.set_title(SUPPORTS[case], fontsize=10)
        top.set_xlabel("time before the end [ms]")
        top.set_ylabel("normal tooth force [10³ lbf]")
        bottom.set_xlabel("frequency [kHz]; lines: tooth frequency 5 kHz and harmonics")
        bottom.set_ylabel("amplitude [10³ lbf]")
        bottom.set_ylim(bottom=0)
        for axis in (top, bottom):
            axis.grid(color="#e4e4e4", linewidth=0.6)
            axis.spines[["top", "right"]].set_visible(False)
        top.legend(fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1.06), ncols=2, frameon=False)
        top.margins(y=0.05)
    figure.suptitle(f"Spur gear transmission, {title}: Cardona (1995), {name.replace('_', ' ')}", fontsize=12)
    path = output / f"{name}.png"
    figure.savefig(path, dpi=130)
    plt.close(figure)
    return path


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="build folder (default build)")
    parser.add_argument("--results", type=Path, help="folder of spur_transmission_{a,b,c,d}.h5")
    parser.add_argument(
        "--damping", choices=["ALWAYS", "CONTACT"], help="law of the oracle (default: that of the result)"
    )
    parser.add_argument("--oracle-only", action="store_true", help="draw the differential equation alone")
    parser.add_argument("-o", "--output", type=Path, help="folder of the pictures (default: <build>/figures)")
    args = parser.parse_args(arguments)
    folder = None if args.oracle_only else find_results(args.build, args.results)
    if folder is None and not args.oracle_only:
        print(
            "engrane figures: no folder holds spur_transmission_a.h5 to _d.h5; "
            "run engrane on decks/paper/*.dat first (or --oracle-only).",
            file=sys.stderr,
        )
        return 2
    output = args.output or args.build / "figures"
    output.mkdir(parents=True, exist_ok=True)
    for name, title, cases in FIGURES:
        curves = {case: case_curves(case, folder, args.damping) for case in cases}
        print(f"wrote {draw(name, title, cases, curves, output)}")
    return 0


def case_curves(case: str, folder: Path | None, damping: str | None) -> list[tuple]:
    """(label, times, force, colour, dashes) of engrane's result with the oracle over it, or of the oracle's
    steady states."""
    if folder is None:
        out = []
        laws = ["ALWAYS", "CONTACT"] if oracle.CASES[case].b > 0 else ["ALWAYS"]
        for law, color in zip([damping] if damping else laws, (BLUE, ORANGE), strict=False):
            r = oracle.steady(case, law, rtol=1e-8)["record"]
            t, f = r["t"], r["normal"]
            # A short periodic record is repeated: the orbit is known exactly.
            count = max(1, round(40 * oracle.Transmission().period / t[-1]))
            step = t[1] - t[0]
            f = np.tile(f[:-1], count)
            out.append((f"differential equation, damping {law}", step * np.arange(len(f)), f, color, "-"))
        return out
    run = compare.load(compare.result_path(folder, case), case, damping)
    ref = compare.reference(run)
    return [
        ("engrane", run.t, run.normal, BLUE, "-"),
        (f"differential equation, damping {run.damping}", run.t, ref["normal"], ORANGE, (0, (4, 2))),
    ]


if __name__ == "__main__":
    sys.exit(main())
