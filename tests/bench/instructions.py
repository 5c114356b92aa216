# SPDX-License-Identifier: BSD-3-Clause
"""Instructions of a time step with KLU, counted by valgrind, so that a busy machine does not change them.

    python tests/bench/instructions.py build/bin/engrane [other/engrane] [--models chain wind bars ...]

Each model runs to two lengths, and the difference is divided by the steps between: start, output of the ends
and closing fall out. chain: 20 links, steps 21 to 40; wind: the wind turbine, steps 101 to 200; bars: 40
four-bars in a row whose pins are points on lines, steps 21 to 40; kept-NAME: a model of paired_models.py with
TANGENT KEPT, steps 201 to 400. Prints a Markdown table.
"""

import argparse
import re
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path

from paired_models import ENVIRONMENT, chain_deck, with_steps
from paired_models import MODELS as PAIRED
from paired_models import deck as paired_deck

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/verify"), str(ROOT / "tests")]
from test_benchmarks import four_bars  # noqa: E402


def links_deck(steps: int) -> str:
    return with_steps(chain_deck(20), "SCHEME CHUNG RHO 0.8 SOLVER KLU", 0.001, steps)


def kept_deck(name: str, steps: int) -> str:
    model = PAIRED[name]
    step = model.span / model.steps[len(model.steps) // 2]
    return with_steps(paired_deck(name), "RHO 0.8 SOLVER KLU TANGENT KEPT ENERGY 0", step, steps)


def wind_deck(steps: int) -> str:
    """The deck as it stands with KLU and another end; it is without checks then, which need all of it."""
    text = next((ROOT / "decks").rglob("wind_turbine.dat")).read_text(encoding="utf-8")
    step = float(re.search(r"^\.SUB .*?\bH +(\S+)", text, re.M).group(1).replace("D", "e"))
    text = re.sub(r"^(\.SUB .*?\bTF +)\S+", rf"\g<1>{steps * step!r}", text, flags=re.M)
    text = re.sub(r"^\.CHK\n(?: .*\n|!.*\n)*", "", text, flags=re.M)
    return re.sub(r"^(\.SAM .*?)( SOLVER \w+)?$", r"\1 SOLVER KLU", text, flags=re.M)


def bars_deck(steps: int) -> str:
    return four_bars(40, 0.004, steps * 0.004, 0)[: -len(" NODE 101 UX V 0 ATOL 0.01\n.CHK\n")]


MODELS = {"chain": (links_deck, 20, 40), "wind": (wind_deck, 100, 200), "bars": (bars_deck, 20, 40)}
MODELS |= {f"kept-{name}": (partial(kept_deck, name), 200, 400) for name in PAIRED}


def instructions(binary: Path, deck: Path) -> int:
    task = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", binary, "-q", deck]
    task += ["-o", deck.with_suffix("")]
    done = subprocess.run(task, env=ENVIRONMENT, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{deck.read_text(encoding='utf-8')}\n{done.stderr[-2000:]}")
    return int(re.search(r"Collected : (\d+)", done.stderr).group(1))


def main() -> None:
    parser = argparse.ArgumentParser(description="instructions of a step by valgrind")
    parser.add_argument("binaries", type=Path, nargs="+")
    parser.add_argument("--models", nargs="+", choices=MODELS, default=list(MODELS))
    arguments = parser.parse_args()

    binaries = [binary.resolve() for binary in arguments.binaries]
    print("| model | steps |" + "".join(f" program {i + 1}, million |" for i in range(len(binaries))))
    print("|---|---|" + "---|" * len(binaries))
    for model in arguments.models:
        write, short, long = MODELS[model]
        counts = []
        with tempfile.TemporaryDirectory() as folder:
            deck = Path(folder, f"{model}.dat")
            for binary in binaries:
                totals = []
                for steps in (short, long):
                    deck.write_text(write(steps), encoding="utf-8")
                    totals.append(instructions(binary, deck))
                counts.append((totals[1] - totals[0]) / (long - short) / 1e6)
        print(f"| {model} | {short + 1} to {long} |" + "".join(f" {c:.3f} |" for c in counts), flush=True)


if __name__ == "__main__":
    main()
