# SPDX-License-Identifier: BSD-3-Clause
"""What events bring and cost: the spur transmission with backlash, with and without, against its equation.

    python tests/bench/events.py build/bin/engrane

Error of u_m over the first millisecond (five tooth periods), rms, relative to its amplitude; and processor
time per H, of runs of 10000 steps in turn. KLU, one rank. Prints a Markdown table.
"""

import argparse
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "verify"))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "post"))
from engrane_post import Results
from oracles import spur_transmission as oracle

DECKS = Path(__file__).resolve().parents[2] / "decks/paper"
CASES = (("c", "C", "ALWAYS"), ("c_contact", "C", "CONTACT"), ("d_contact", "D", "CONTACT"))
STEPS = (2e-6, 1e-6, 5e-7)
END = 1e-3


def run(binary: Path, folder: Path, name: str, events: str, step: float, end: float) -> tuple[Path, float]:
    """The results, and the processor time in seconds."""
    text = (DECKS / f"spur_transmission_{name}.dat").read_text(encoding="utf-8")
    text = text[: re.search(r"^\.FIN", text, re.MULTILINE).start()]
    text = text.replace("START STATIC", f"START STATIC EVENTS {events}")
    deck = folder / "run.dat"
    deck.write_text(f"{text}.DEL.CHK\n.DEL.SUB\n.SUB TF {end:g} H {step:g}\n.FIN 1\n", encoding="utf-8")
    process = subprocess.Popen([binary, "-q", deck, "-o", folder / "run"])
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{name}, EVENTS {events}, H {step:g}: the run failed")
    return folder / "run.h5", usage.ru_utime + usage.ru_stime


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("binary", type=Path)
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    binary = arguments.binary.resolve()
    print("| case, damping | h | error without | with | time without, µs per H | with | ratio |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for deck, case, damping in CASES:
            times = np.linspace(0, END, round(END / STEPS[0]) + 1)
            right = oracle.simulate(case, damping, END, 1e-10, times=times)["u"]
            for step in STEPS:
                error, cost = {}, {"NO": [], "YES": []}
                for events in cost:
                    path, _ = run(binary, folder, deck, events, step, END)
                    with Results(path) as result:
                        t, u = result.history("element/7/U_M")  # with more instants where a step was cut
                    u = u[np.searchsorted(t, times - 1e-12)]
                    error[events] = float(np.sqrt(np.mean((u - right) ** 2)) / (np.ptp(right) / 2))
                for _ in range(arguments.runs):
                    for events, list_ in cost.items():
                        steps = 10000
                        list_.append(run(binary, folder, deck, events, step, steps * step)[1] / steps * 1e6)
                without, with_ = (statistics.median(cost[e]) for e in ("NO", "YES"))
                print(
                    f"| {case}, {damping} | {step:g} | {error['NO']:.1e} | {error['YES']:.1e} "
                    f"| {without:.0f} | {with_:.0f} | {with_ / without:.2f} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
