# SPDX-License-Identifier: BSD-3-Clause
"""What start and one step cost as models grow: processor time, peak memory, and the exponents of both.

    python tests/bench/scaling.py build/bin/engrane [other/engrane] [--models chain bars springs]
        [--sizes 100 1000 10000] [--steps 1] [--runs 3] [--check]

chain: n links and hinges, as in paired_models.py; bars: n four-bars side by side, each with three constraints
too many; springs: n masses in a row, each on springs to its neighbours. KLU, one thread, results at the
start and the end. The programs take turns; medians of the runs. `--check` measures `engrane check`
instead, which reads and finds the start. Prints a Markdown table; an exponent is that from the size in the
row before.
"""

import argparse
import math
import multiprocessing
import os
import statistics
import sys
import tempfile
from pathlib import Path

from paired_models import ENVIRONMENT, with_steps
from paired_models import chain_deck as links_deck

INERTIA = "M 1 J 0.001 0.084 0.084"
STEP = 0.001


def ending(steps: int, gravity: str) -> list[str]:
    end = steps * STEP
    return [
        f".CLM\n STRU ACC VAL {gravity}",
        ".SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.8 SOLVER KLU",
        f".SUB TF {end!r} H {STEP!r}",
        f".SAI FIELDS DT {end!r} HISTORY DT {end!r}",
        ".FIN 1\n",
    ]


def chain_deck(n: int, steps: int) -> str:
    return with_steps(links_deck(n), "SCHEME CHUNG RHO 0.8 SOLVER KLU", STEP, steps)


def bars_deck(n: int, steps: int) -> str:
    """Uprights of 1 m on the ground, 1 m apart, joined at their tops by bars; all hinges turn about z."""
    lines = [".NOE", *(f" I {i + 1} X {i} 0.5 0" for i in range(n + 1))]
    lines += [f" I {n + 2 + i} X {i + 0.5} 1 0" for i in range(n)]
    nodes = 2 * n + 1
    lines += [".MCE", *(f" I {i + 1} INERTIA N {i + 1} {INERTIA}" for i in range(nodes))]
    hinges = [(0, i + 1, i, 0) for i in range(n + 1)]
    for i in range(n):
        hinges += [(i + 1, n + 2 + i, i, 1), (n + 2 + i, i + 2, i + 1, 1)]
    for k, (a, b, x, y) in enumerate(hinges):
        lines.append(f" I {nodes + k + 1} HINGE N {a} {b} AXIS 0 0 1 AT {x} {y} 0")
    return "\n".join(lines + ending(steps, "3 -9.81 0"))


def springs_deck(n: int, steps: int) -> str:
    lines = [".NOE", *(f" I {i + 1} X {i + 1} 0 0" for i in range(n))]
    lines += [".MCE", *(f" I {i + 1} INERTIA N {i + 1} M 1" for i in range(n))]
    lines += [f" I {n + i + 1} SPRING N {i} {i + 1} K 1000" for i in range(n)]
    return "\n".join(lines + ending(steps, "9.81 0 0"))


DECKS = {"chain": chain_deck, "bars": bars_deck, "springs": springs_deck}


def write(deck: Path, model: str, n: int, steps: int) -> None:
    deck.write_text(DECKS[model](n, steps), encoding="utf-8")


def run(binary: Path, deck: Path, check: bool) -> tuple[float, float]:
    """Processor seconds and peak megabytes of one run."""
    task = [str(binary), *(["check"] if check else ["-q"]), str(deck)]
    if not check:
        task += ["-o", str(deck.with_suffix(""))]
    with (
        open(os.devnull, "w", encoding="utf-8") as nowhere,
        open(deck.with_suffix(".err"), "w+", encoding="utf-8") as errors,
    ):
        files = [(os.POSIX_SPAWN_DUP2, nowhere.fileno(), 1), (os.POSIX_SPAWN_DUP2, errors.fileno(), 2)]
        child = os.posix_spawn(task[0], task, ENVIRONMENT, file_actions=files)
        _, status, usage = os.wait4(child, 0)
        if status != 0:
            errors.seek(0)
            sys.exit(f"{' '.join(task)} failed:\n{errors.read()[-2000:]}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def exponent(now: float, before: float, n: int, n_before: int) -> float:
    return math.log(now / before) / math.log(n / n_before)


def main() -> None:
    parser = argparse.ArgumentParser(
        description="processor time and memory of start and step by size of model"
    )
    parser.add_argument("binaries", type=Path, nargs="+")
    parser.add_argument("--models", nargs="+", choices=DECKS, default=list(DECKS))
    parser.add_argument("--sizes", type=int, nargs="+", default=[100, 1000, 10000])
    parser.add_argument("--steps", type=int, default=1)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()

    binaries = [binary.resolve() for binary in arguments.binaries]
    print("| model | n | program | processor time, s | exponent | peak memory, MB | exponent |")
    print("|---|---|---|---|---|---|---|")
    for model in arguments.models:
        before: dict[Path, tuple[int, float, float]] = {}
        for n in sorted(arguments.sizes):
            samples: dict[Path, list[tuple[float, float]]] = {binary: [] for binary in binaries}
            with tempfile.TemporaryDirectory() as folder:
                deck = Path(folder, f"{model}.dat")
                # by another process: the peak memory of a child counts from its parent's
                writer = multiprocessing.Process(target=write, args=(deck, model, n, arguments.steps))
                writer.start()
                writer.join()
                for _ in range(arguments.runs):
                    for binary in binaries:
                        samples[binary].append(run(binary, deck, arguments.check))
            for number, binary in enumerate(binaries, 1):
                seconds, megabytes = (
                    statistics.median(column) for column in zip(*samples[binary], strict=True)
                )
                exponents = ["", ""]
                if binary in before:
                    n_before, *values = before[binary]
                    pairs = zip((seconds, megabytes), values, strict=True)
                    exponents = [f"{exponent(now, then, n, n_before):.2f}" for now, then in pairs]
                before[binary] = (n, seconds, megabytes)
                numbers = f"{seconds:.2f} | {exponents[0]} | {megabytes:.0f} | {exponents[1]}"
                print(f"| {model} | {n} | {number} | {numbers} |", flush=True)


if __name__ == "__main__":
    main()
