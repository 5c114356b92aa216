# SPDX-License-Identifier: BSD-3-Clause
"""`mutate.py engrane [--count n] [--first seed]`: runs decks of the project with something wrong in them.

Every case follows from its seed: which deck, and what is changed in it. Whatever the change, the program
must end by itself with status 0, 1, 2 or 4 (a check that fails where the deck was changed), say why when
it is not 0, and in sentences: no crash, no internal error, nothing that PETSc, MPI or HDF5 print. A long
run is asked to stop by SIGTERM and must do so at once. Runs are cut to a few steps before. Decks of
failing seeds are kept.
"""

import argparse
import math
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TRACES = re.compile(
    r"internal error|PETSC ERROR|HDF5-DIAG|MPI_ABORT|MPI_Abort|Process received signal|terminate called"
    r"|Assertion|Sanitizer|\bORTE_|ORTE has|opal_|\bstd::|basic_string|vector::|map::at|bad_alloc"
)
# what stands in the place of a number or a word
NUMBERS = """0 -1 1 2 1e300 -1e300 1e-300 1e18 -1e-12 0.5 1E 99 2147483647 -2147483648 4294967296 1e400 .
3*0. (1/0) (0/0) ( sqrt(-1) 'x' "x" nan inf 1D5 1+3"""
WORDS = """I J K N NOEUD GROUP C V NF DRIVE SPEED AXIS AT .MCE .NOE .CLM ADD .FIN RETURN INPUT
! $ & , ; ( ) T"""
REPLACEMENTS = {"numbers": NUMBERS.split(), "all": WORDS.split() + NUMBERS.split()}
NUMBER = re.compile(r"(?<![\w./])[-+]?\d*\.?\d+(?:[eEdD][-+]?\d+)?(?![\w.])")
COMMENTS = re.compile(r"!.*")
COMMENTS_AND_NAMES = re.compile(r"!.*|\b(?:I|N|NOEUD|JOINTS?|NF|ELEMENT|LAW \w+|CLAW)\b[\d \t]+")
FOLLOWED = re.compile(r'INPUT\s+"([^"]+)"', re.IGNORECASE)


def decks(pattern: str) -> list[Path]:
    return [path for path in sorted(ROOT.glob(pattern)) if path.stat().st_size < 40_000]


def few_steps(text: str) -> str:
    """The deck's steps, but only three of them: what is wrong shows in those."""

    def shorter(match: re.Match) -> str:
        said = dict(re.findall(r"\b(TI|TF|H)\s+([-+.\dEeDd]+)", match.group()))
        try:
            start, step = float(said.get("TI", "0")), float(said["H"])
        except (KeyError, ValueError):
            return match.group()
        return re.sub(r"\bTF\s+\S+", f"TF {start + 3 * step!r}", match.group())

    return re.sub(r"(?m)^\.SUB.*$", shorter, text)


def retuned(text: str, dice: random.Random) -> str:
    """The deck with other numbers that may well be read: what is wrong is for the solver to find."""
    end = text.find(".CHK") if ".CHK" in text else len(text)
    for _ in range(dice.choice((1, 1, 2, 3, 6))):
        # numbers of nodes and elements only now and then: what does not exist ends the run before it begins
        aside = COMMENTS if dice.random() < 0.15 else COMMENTS_AND_NAMES
        places = [range(*m.span()) for m in aside.finditer(text)]
        spans = [m.span() for m in NUMBER.finditer(text[:end]) if not any(m.start() in p for p in places)]
        if not spans:
            return text
        a, b = dice.choice(spans)
        value = float(re.sub("[dD]", "e", text[a:b]))
        if not math.isfinite(value):
            continue
        if value == int(value) and "." not in text[a:b] and dice.random() < 0.7:
            new = str(int(value) + dice.choice((-1, 1, 2, -2, 10)))
        elif value == 0:
            new = dice.choice(("1", "-1", "0.1", "1e-9", "1000."))
        else:
            new = f"{value * dice.choice((-1, 0, 10, 0.1, 1e3, 1e-3, 1e9, 1e-9, 1.01, 0.5, 2)):.12g}"
        if dice.random() < 0.2:
            new = text[slice(*dice.choice(spans))]
        text = text[:a] + new + text[b:]
        end += len(new) - (b - a)
    return text


def mutated(text: str, other: str, dice: random.Random) -> str:
    if dice.random() < 0.6:
        return retuned(text, dice)
    for _ in range(dice.choice((1, 1, 1, 2, 3, 5))):
        lines = text.split("\n")
        at = dice.randrange(len(lines))
        spans = [m.span() for m in NUMBER.finditer(text)]
        match dice.randrange(13):
            case 0:
                del lines[at]
            case 1:
                lines.insert(dice.randrange(len(lines)), lines[at])
            case 2:
                lines.insert(at, dice.choice(other.split("\n")))
            case 3:
                to = dice.randrange(len(lines))
                lines[at], lines[to] = lines[to], lines[at]
            case 4:
                text = text[: dice.randrange(len(text) + 1)]
                lines = text.split("\n")
            case 5:
                place = dice.randrange(len(text) + 1)
                lines = (
                    text[:place]
                    + chr(dice.choice((0, 9, 34, 39, 127, 233, dice.randrange(256))))
                    + text[place:]
                ).split("\n")
            case 6 | 7:
                words = lines[at].split(" ")
                word = dice.randrange(len(words))
                change = dice.randrange(4)
                if change == 0:
                    del words[word]
                elif change == 1:
                    words.insert(word, dice.choice(REPLACEMENTS["all"]))
                elif change == 2:
                    words[word] = dice.choice(REPLACEMENTS["all"])
                else:
                    words.insert(word, words[dice.randrange(len(words))])
                lines[at] = " ".join(words)
            case 8:
                if lines[at]:
                    place = dice.randrange(len(lines[at]))
                    lines[at] = lines[at][:place] + dice.choice("AEIONRSTX109.") + lines[at][place + 1 :]
            case _:
                if spans:
                    a, b = dice.choice(spans)
                    new = dice.choice(REPLACEMENTS["numbers"])
                    if dice.random() < 0.6:
                        value = float(re.sub("[dD]", "e", text[a:b]))
                        new = f"{value * dice.choice((-1, 0, 10, 0.1, 1e6, 1e-6, 1e12, 1.001, 0.5, 2)):.12g}"
                    if dice.random() < 0.2:
                        new = text[slice(*dice.choice(spans))]
                    lines = (text[:a] + new + text[b:]).split("\n")
        text = "\n".join(lines)
    return text


def limits() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
    resource.setrlimit(resource.RLIMIT_FSIZE, (200 << 20, 200 << 20))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(program: str, folder: Path, patience: float) -> tuple[int, str, bool]:
    """Status, what was printed, and whether it had to be asked to stop. Status -9: it did not even then."""
    # runs at the same time need a folder of Open MPI each: the program makes its own where it is given none
    environment = {k: v for k, v in os.environ.items() if k != "OMPI_MCA_orte_tmpdir_base"}
    with open(folder / "printed", "w+b") as printed:
        process = subprocess.Popen(
            [program, "-q", "deck.dat", "-o", "out"],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=printed,
            stderr=subprocess.STDOUT,
            preexec_fn=limits,
            env=environment | {"TMPDIR": str(folder.parent)},
        )
        asked = False
        try:
            process.wait(patience)
        except subprocess.TimeoutExpired:
            asked = True
            process.send_signal(signal.SIGTERM)
            try:
                process.wait(patience)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        printed.seek(0)
        return process.returncode, printed.read(2_000_000).decode("utf-8", "replace"), asked


def case(program: str, seed: int, work: Path, patience: float) -> tuple[str, str]:
    """What is wrong, or nothing; and the kind of ending."""
    dice = random.Random(seed)
    all_decks = decks("decks/**/*.dat") if dice.random() < 0.85 else decks("tests/errors/**/*.dat")
    source = dice.choice(all_decks)
    text = source.read_text(encoding="latin-1")
    deck = mutated(few_steps(text), dice.choice(all_decks).read_text(encoding="latin-1"), dice)
    folder = Path(tempfile.mkdtemp(prefix="m", dir=work))
    try:
        (folder / "deck.dat").write_text(deck, encoding="latin-1")
        for name in FOLLOWED.findall(text):
            for part in (source.parent / name, source.parent / f"{name}.dat"):
                if part.is_file() and not (folder / part.name).exists():
                    shutil.copy(part, folder / part.name)
        status, printed, asked = run(program, folder, patience)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    wrong = ""
    if status == -9:
        wrong = f"does not stop, not even when it is asked to after {patience:g} s"
    elif status not in (0, 1, 2, 4):
        wrong = f"ended with status {status}"
    elif trace := TRACES.search(printed):
        wrong = f"printed `{trace.group()}`"
    elif status in (1, 2) and not printed.strip():
        wrong = f"status {status} without a word"
    ending = "stopped when asked" if asked else f"status {status}"
    if not wrong:
        return "", ending
    return f"seed {seed} ({source.relative_to(ROOT)}): {wrong}\n{printed[-1500:]}\n---\n{deck}", "wrong"


def main() -> int:
    parser = argparse.ArgumentParser(description="runs decks of the project with something wrong in them")
    parser.add_argument("engrane", type=Path)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--first", type=int, default=1, help="the first seed")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--patience", type=float, default=10, help="seconds before a run is asked to stop")
    parser.add_argument("--keep", type=Path, default=Path("mutants"), help="folder for what went wrong")
    arguments = parser.parse_args()
    program = str(arguments.engrane.resolve())
    endings: Counter[str] = Counter()
    failing = []
    with tempfile.TemporaryDirectory(prefix="engrane_m") as work, ThreadPoolExecutor(arguments.jobs) as pool:
        seeds = range(arguments.first, arguments.first + arguments.count)
        outcomes = pool.map(lambda seed: case(program, seed, Path(work), arguments.patience), seeds)
        for seed, (wrong, ending) in zip(seeds, outcomes, strict=True):
            endings[ending] += 1
            if not wrong:
                continue
            failing.append(seed)
            arguments.keep.mkdir(parents=True, exist_ok=True)
            report, deck = wrong.split("\n---\n", 1)
            (arguments.keep / f"{seed}.dat").write_text(deck, encoding="latin-1")
            (arguments.keep / f"{seed}.txt").write_text(report, encoding="utf-8")
            print(report, f"\n  kept as {arguments.keep / f'{seed}.dat'}", flush=True)
    print(f"{arguments.count} decks: " + ", ".join(f"{n} {ending}" for ending, n in sorted(endings.items())))
    if failing:
        print("failing seeds:", *failing)
    return 1 if failing else 0


if __name__ == "__main__":
    sys.exit(main())
