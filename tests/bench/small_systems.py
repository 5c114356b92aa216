# SPDX-License-Identifier: BSD-3-Clause
"""What a step costs on several ranks, milliseconds: chains of links, bent beams of hexahedra.

    python tests/bench/small_systems.py build/bin/engrane [other/engrane] [--ranks 1 2 3] [--solver MUMPS]
        [--links 3 10 30 100 300 1000] [--boxes 10x4x3 20x6x5] [--runs 3]

What the listing tells of elements, factorisation and solution, over the number of steps. The programs take
turns; medians of the runs. Prints a Markdown table.
"""

import argparse
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from paired_models import ENVIRONMENT, with_steps
from paired_models import chain_deck as links_deck
from ranks import on_ranks
from solid_meshes import gravity_beam

LINK_STEPS = 3000  # times links
BOX_STEPS = 6


def links(count: int, solver: str) -> tuple[str, int]:
    steps = max(10, LINK_STEPS // count)
    return with_steps(links_deck(count), f"SCHEME CHUNG RHO 0.8 SOLVER {solver}", 0.001, steps), steps


def boxes(count: tuple[int, ...], solver: str) -> tuple[str, int]:
    steps = BOX_STEPS
    deck = "\n".join(gravity_beam(count, 8, False)[1])
    # weight alone: the loads of statics would tear the end off within a step
    deck = re.sub(r"^ (STRU ACC|GROUP .* CHA) .*\n", "", deck, flags=re.MULTILINE)
    deck = deck.replace(".FIN", " STRU ACC VAL 0 0 -1E6\n.FIN")
    run = f".SAM TYPE DYNAMIC SOLVER {solver}\n.SUB TF {steps}E-6 H 1E-6\n.FIN"
    return deck.replace(".FIN", run), steps


def milliseconds(binary: Path, deck: Path, ranks: int, steps: int) -> float:
    command = on_ranks(ranks, [str(binary), "-q", str(deck), "-o", str(deck.with_suffix(""))])
    done = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{done.stderr[-2000:]}")
    listing = deck.with_suffix(".lst").read_text(encoding="utf-8")
    parts = dict(re.findall(r"^  (\S.*?)  +([\d.]+) +[\d.]+$", listing, re.MULTILINE))
    shares = [
        float(seconds)
        for name, seconds in parts.items()
        if name.startswith(("factor", "solution", "element"))
    ]
    return 1e3 * sum(shares) / steps


def main() -> None:
    parser = argparse.ArgumentParser(description="cost of a step on several ranks by size of model")
    parser.add_argument("binaries", type=Path, nargs="+")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--solver", default="MUMPS")
    parser.add_argument("--links", type=int, nargs="*", default=[3, 10, 30, 100, 300, 1000])
    parser.add_argument("--boxes", nargs="*", default=["10x4x3", "20x6x5"])
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()

    binaries = [binary.resolve() for binary in arguments.binaries]
    models = [(f"chain of {n} links", *links(n, arguments.solver)) for n in arguments.links]
    for size in arguments.boxes:
        models.append((f"beam of {size} boxes", *boxes(tuple(map(int, size.split("x"))), arguments.solver)))
    heads = [f"{ranks} ranks" if ranks > 1 else "1 rank" for ranks in arguments.ranks]
    print(f"| model | equations | program | {' | '.join(heads)} |\n|---|---:|---|{'---:|' * len(heads)}")
    for name, text, steps in models:
        samples: dict[tuple[Path, int], list[float]] = {}
        with tempfile.TemporaryDirectory() as folder:
            deck = Path(folder, "model.dat")
            deck.write_text(text, encoding="utf-8")
            for _ in range(arguments.runs):
                for binary in binaries:
                    for ranks in arguments.ranks:
                        found = milliseconds(binary, deck, ranks, steps)
                        samples.setdefault((binary, ranks), []).append(found)
            listing = deck.with_suffix(".lst").read_text(encoding="utf-8")
        equations = re.search(r"^  to be solved for +(\d+)", listing, re.MULTILINE)[1]
        for number, binary in enumerate(binaries, 1):
            medians = [statistics.median(samples[binary, ranks]) for ranks in arguments.ranks]
            cells = " | ".join(f"{found:.3f}" for found in medians)
            print(f"| {name} | {equations} | {number} | {cells} |", flush=True)


if __name__ == "__main__":
    main()
