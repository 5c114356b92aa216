# SPDX-License-Identifier: BSD-3-Clause
"""Draws the paper's figures 6 and 7 (tooth force without and with backlash) from engrane's results, the
differential equation over them, and their spectra.

    engrane figures                               runs the decks whose results are missing or old, then draws
    engrane figures --results folder              draws the results that are there
    engrane figures --oracle-only -o out          the steady states of the differential equation alone
"""

from __future__ import annotations

import argparse
import os
import subprocess
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
SHOWN = 6  # tooth periods drawn
HIGHEST = 50e3  # Hz, end of the spectra
FIGURES = (  # name, title, cases, variant of the deck
    ("figure_6", "no backlash: Cardona (1995), figure 6", "AB", ""),
    ("figure_7", "with backlash: Cardona (1995), figure 7", "CD", ""),
    ("figure_7_contact", "with backlash, damping in contact only", "CD", "contact"),
)
SUPPORTS = {
    "A": "rigid supports (A)",
    "B": "flexible supports (B)",
    "C": "rigid supports (C)",
    "D": "flexible supports (D)",
}
BLUE, ORANGE = "#1f5fa8", "#d1571b"


def deck_of(case: str, variant: str) -> Path:
    return compare.result_path(ROOT / "decks" / "paper", case, variant).with_suffix(".dat")


def missing(folder: Path) -> list[Path]:
    """Results that the figures need and the folder lacks."""
    paths = [compare.result_path(folder, c, v) for _, _, cases, v in FIGURES for c in cases]
    return [p for p in paths if not p.is_file()]


def results_of(build: Path) -> Path:
    """<build>/paper with all results: decks are run whose result is missing or older than the deck or the
    program (ENGRANE, or the build folder's)."""
    program = Path(os.environ.get("ENGRANE") or build / "bin" / "engrane")
    if not program.is_file():
        raise FileNotFoundError(f"there is no program {program} to run the decks; build it first")
    folder = build / "paper"
    folder.mkdir(parents=True, exist_ok=True)
    for _, _, cases, variant in FIGURES:
        for case in cases:
            deck, result = deck_of(case, variant), compare.result_path(folder, case, variant)
            if result.is_file() and result.stat().st_mtime > max(
                deck.stat().st_mtime, program.stat().st_mtime
            ):
                continue
            print(f"running {deck.relative_to(ROOT)}", flush=True)
            words = [program, deck, "-o", result.with_suffix("")]
            with result.with_suffix(".log").open("w") as log:
                status = subprocess.run(words, stdout=log, stderr=subprocess.STDOUT, check=False).returncode
            if status:
                result.unlink(missing_ok=True)
                raise RuntimeError(f"{deck.name} failed; what it said is in {log.name}")
    return folder


def spectrum(t: np.ndarray, f: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Single-sided amplitudes, hann window; evenly sampled."""
    window = np.hanning(len(f) + 1)[:-1]
    a = np.abs(np.fft.rfft((f - f.mean()) * window, 4 * len(f))) * 2 / window.sum()
    return np.fft.rfftfreq(4 * len(f), (t[-1] - t[0]) / (len(t) - 1)), a


def even(t: np.ndarray, f: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Even samples at the mean step."""
    grid = np.linspace(t[0], t[-1], len(t))
    return grid, np.interp(grid, t, f)


def draw(name: str, title: str, curves: dict[str, list[tuple]], output: Path) -> Path:
    """One figure: force against time above, spectra below, one column per case."""
    figure, axes = plt.subplots(2, 2, figsize=(10, 6.2), layout="constrained", sharey="row", sharex="row")
    period = oracle.Transmission().period
    for (top, bottom), (case, lines) in zip(axes.T, curves.items(), strict=True):
        for label, t, f, color, dashes in lines:
            look = dict(color=color, linestyle=dashes, linewidth=1.3, label=label)
            shown = t >= t[-1] - SHOWN * period
            top.plot((t[shown] - t[-1]) * 1e3, f[shown] / 1e3, **look)
            part = compare.tail(t, 40)
            hz, a = spectrum(*even(t[part], f[part]))
            low = hz <= HIGHEST
            bottom.plot(hz[low] / 1e3, a[low] / 1e3, **look)
        top.set_title(SUPPORTS[case], fontsize=11)
        top.set_xlabel("time before the end [ms]")
        top.set_xlim(-SHOWN * period * 1e3, 0)
        bottom.set_xlabel("frequency [kHz]; the teeth mesh at 5 kHz")
        bottom.set_xlim(0, HIGHEST / 1e3)
        bottom.set_xticks(np.arange(0, HIGHEST / 1e3 + 1, 5))
        for axis in (top, bottom):
            axis.grid(color="#e4e4e4", linewidth=0.6)
            axis.spines[["top", "right"]].set_visible(False)
            axis.set_axisbelow(True)
    axes[1, 0].set_ylim(bottom=0)  # both columns: they share it
    axes[0, 0].set_ylabel("normal tooth force [10³ lbf]")
    axes[1, 0].set_ylabel("amplitude [10³ lbf]")
    figure.suptitle(f"Spur gear transmission, {title}", fontsize=12)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=2, frameon=False)
    path = output / f"{name}.png"
    figure.savefig(path, dpi=110)
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
    folder = None if args.oracle_only else args.results
    if folder and missing(folder):
        print(
            f"engrane figures: {missing(folder)[0]} is missing; "
            "run engrane on decks/paper/*.dat first, or leave out --results.",
            file=sys.stderr,
        )
        return 2
    if folder is None and not args.oracle_only:
        try:
            folder = results_of(args.build)
        except (OSError, RuntimeError) as error:
            print(f"engrane figures: {error}.", file=sys.stderr)
            return 2
    output = args.output or args.build / "figures"
    output.mkdir(parents=True, exist_ok=True)
    for name, title, cases, variant in FIGURES:
        if variant and folder is None:
            continue  # the differential equation's curves are both in figure 7
        curves = {case: case_curves(case, variant, folder, args.damping) for case in cases}
        print(f"wrote {draw(name, title, curves, output)}", flush=True)
    return 0


def case_curves(case: str, variant: str, folder: Path | None, damping: str | None) -> list[tuple]:
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
    run = compare.load(compare.result_path(folder, case, variant), case, damping)
    ref = compare.reference(run)
    return [
        ("engrane", run.t, run.normal, BLUE, "-"),
        (f"differential equation, damping {run.damping}", run.t, ref["normal"], ORANGE, (0, (4, 2))),
    ]


if __name__ == "__main__":
    sys.exit(main())
