# SPDX-License-Identifier: BSD-3-Clause
"""Time per step and peak memory of the paper's spur transmission with each solver, split by phase.

    python tests/bench/transmission.py build/bin/engrane [--runs 5] [--steps 5000]

Runs the solvers in turn, so that a machine that slows down slows all of them; prints a Markdown table of
medians and the ratio to MUMPS, run by run. One rank, one thread.
"""

import argparse
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

SOLVERS = ("MUMPS", "KLU", "UMFPACK", "SUPERLU")
STEP = 2e-6
DECK = Path(__file__).parents[2] / "decks/paper/spur_transmission_a.dat"


def deck_with(solver: str, steps: int) -> str:
    text = DECK.read_text(encoding="utf-8")
    text = text[: re.search(r"^\.FIN", text, re.MULTILINE).start()]
    text = re.sub(r"(\.SAM TYPE DYNAMIC)", rf"\1 SOLVER {solver}", text)
    return f"{text}.DEL.CHK\n.DEL.SUB\n.SUB TF {steps * STEP:.9g} H {STEP:g}\n.FIN 1\n"


def run(binary: Path, folder: Path, solver: str, steps: int) -> dict[str, float]:
    """Microseconds per step by phase, and megabytes at the peak."""
    prefix = folder / solver
    deck = prefix.with_suffix(".dat")
    deck.write_text(deck_with(solver, steps), encoding="utf-8")
    process = subprocess.Popen([binary, "-q", deck, "-o", prefix], env=os.environ | {"OMP_NUM_THREADS": "1"})
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{solver}: the run failed")
    found = {"memory": usage.ru_maxrss / 1024, "cpu": (usage.ru_utime + usage.ru_stime) / steps * 1e6}
    listing = prefix.with_suffix(".lst").read_text(encoding="utf-8")
    for name, seconds in re.findall(
        r"^  (\S.*?)\s{2,}(\d+\.\d+)", listing.split("time spent")[1], re.MULTILINE
    ):
        found[re.sub(r" \(.*", "", name)] = float(seconds) / steps * 1e6
    return found


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("binary", type=Path)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--steps", type=int, default=5000)
    arguments = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    results: dict[str, list[dict[str, float]]] = {solver: [] for solver in SOLVERS}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(arguments.runs):
            for solver in SOLVERS:
                results[solver].append(run(arguments.binary.resolve(), Path(folder), solver, arguments.steps))

    phases = [phase for phase in results["MUMPS"][0] if phase not in ("memory", "cpu", "total")]
    print(f"Medians of {arguments.runs} runs of {arguments.steps} steps; microseconds per step.\n")
    print("| | " + " | ".join(SOLVERS) + " |\n|---|" + "---|" * len(SOLVERS))
    for phase in [*phases, "total", "cpu", "memory"]:
        row = [statistics.median(one[phase] for one in results[solver]) for solver in SOLVERS]
        title = {"memory": "peak memory, MB", "total": "**total**", "cpu": "processor time"}.get(phase, phase)
        print(f"| {title} | " + " | ".join(f"{value:.1f}" for value in row) + " |")
    ratios = []
    for solver in SOLVERS:
        pairs = zip(results["MUMPS"], results[solver], strict=True)
        ratios.append(statistics.median(mumps["total"] / one["total"] for mumps, one in pairs))
    print("| times as fast as MUMPS | " + " | ".join(f"{ratio:.2f}" for ratio in ratios) + " |")


if __name__ == "__main__":
    main()
