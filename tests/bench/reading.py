# SPDX-License-Identifier: BSD-3-Clause
"""What reading a deck and building its model costs: processor time, memory, and how they grow.

    python tests/bench/reading.py build/bin/engrane [another/engrane] [--sizes 100 1000 10000 100000]
                                  [--decks nodes fixed ...] [--runs 3] [--check]

Each deck ends with a `.CHK` of an element that does not exist, so that `engrane check` stops when the model
is built; with `--check` it goes on to its end. Every run is a process of its own, the programs take turns,
and what the empty deck costs is taken off. Prints a Markdown table: median processor time and MB/s at the
largest size, bytes of memory per record there, and the exponent of the time between the two largest sizes
that take long enough to be measured.
"""

import argparse
import math
import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

ENVIRONMENT = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
STOP = ".CHK ELEMENT 999999999 NOTHING V 0 ATOL 1\n"
SHORTEST = 0.01  # seconds that can be told from the noise


def nodes(count: int) -> str:
    return ".NOE\n" + "".join(
        f" I {i} X {0.013 * i:.6g} Y {0.021 * (i % 97):.6g} Z 0\n" for i in range(1, count + 1)
    )


def rows(count: int) -> str:
    return ".NOE\n" + "".join(
        f" {i} {0.013 * i:.6g} {0.021 * (i % 97):.6g} 0.\n" for i in range(1, count + 1)
    )


def fixed(count: int) -> str:
    return nodes(count) + ".CLM\n" + "".join(f" FIX NOEUD {i} C 1 2 3\n" for i in range(1, count + 1))


def loads(count: int) -> str:
    return nodes(count) + ".CLM\n" + "".join(f" CHA NOEUD {i} C 1 V 2\n" for i in range(1, count + 1))


def masses(count: int) -> str:
    return nodes(count) + ".MCE\n" + "".join(f" I {i} INERTIA N {i} M 1\n" for i in range(1, count + 1))


def springs(count: int) -> str:
    chain = "".join(f" I {i} SPRING N {i} {i + 1} K 1000 C 1\n" for i in range(1, count + 1))
    return nodes(count + 1) + ".MCE\n" + chain


def groups(count: int) -> str:
    nested = "".join(f" GROUP {i} UNION {i - 1} NOEUDS {i}\n" for i in range(2, count + 1))
    return nodes(count) + ".SEL\n GROUP 1 NOEUDS 1\n" + nested + f".CLM\n FIX GROUP {count} C 1 2 3\n"


def oscillators(count: int) -> str:
    """Masses in a row, joined by springs, the first held: what `check` goes through to its end."""
    joined = "".join(f" I {count + i} SPRING N {i} {i + 1} K 1000 C 1\n" for i in range(1, count))
    held = ".CLM\n FIX NOEUD 1 C 1 2 3\n.SAM TYPE DYNAMIC SOLVER KLU\n.SUB TF 0.1 H 0.02\n"
    return masses(count) + joined + held


DECKS: dict[str, Callable[[int], str]] = {
    f.__name__: f for f in (nodes, rows, fixed, loads, masses, springs, groups, oscillators)
}


def run(binary: Path, deck: Path) -> tuple[float, int]:
    """Processor seconds and peak memory in bytes."""
    with subprocess.Popen(
        [binary, "check", deck.name],
        cwd=deck.parent,
        env=ENVIRONMENT,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 1):
        sys.exit(f"{binary} check {deck}: status {process.returncode}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def measure(binaries: list[Path], deck: Path, runs: int) -> list[tuple[float, float]]:
    """Medians of time and memory of each program, which take turns."""
    results: list[list[tuple[float, int]]] = [[] for _ in binaries]
    for _ in range(runs):
        for i, binary in enumerate(binaries):
            results[i].append(run(binary, deck))
    return [(statistics.median(t for t, _ in r), statistics.median(m for _, m in r)) for r in results]


def exponent(sizes: list[int], times: list[float]) -> str:
    long_enough = [(n, t) for n, t in zip(sizes, times, strict=True) if t > SHORTEST]
    if len(long_enough) < 2:
        return "-"
    (n, t), (many, longer) = long_enough[-2:]
    return f"{math.log(longer / t) / math.log(many / n):.2f}"


def main() -> None:
    parser = argparse.ArgumentParser(description="measures how decks are read")
    parser.add_argument("engrane", type=Path, nargs="+", help="one program, or several to compare")
    parser.add_argument("--sizes", type=int, nargs="+", default=[100, 1000, 10_000, 100_000])
    parser.add_argument("--decks", nargs="+", choices=DECKS, default=list(DECKS))
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--check", action="store_true", help="the whole of `engrane check`")
    arguments = parser.parse_args()
    binaries = [binary.resolve() for binary in arguments.engrane]
    ending = "" if arguments.check else STOP

    print("| deck | records | program | s | MB/s | bytes per record | exponent |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        empty = Path(name) / "empty.dat"
        empty.write_text(nodes(1) + ending, encoding="utf-8")
        base = measure(binaries, empty, arguments.runs)
        for kind in arguments.decks:
            times: list[list[float]] = [[] for _ in binaries]
            last = base
            deck = empty
            for size in arguments.sizes:
                deck = Path(name) / f"{kind}_{size}.dat"
                deck.write_text(DECKS[kind](size) + ending, encoding="utf-8")
                last = measure(binaries, deck, arguments.runs)
                for i, (time, _) in enumerate(last):
                    times[i].append(time - base[i][0])
            size = arguments.sizes[-1]
            for i, (_, memory) in enumerate(last):
                speed = deck.stat().st_size / max(times[i][-1], 1e-3) / 1e6
                grown = (memory - base[i][1]) / size
                growth = exponent(arguments.sizes, times[i])
                seconds = times[i][-1]
                print(
                    f"| {kind} | {size} | {i + 1} | {seconds:.3f} | {speed:.1f} | {grown:.0f} | {growth} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
