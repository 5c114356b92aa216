# SPDX-License-Identifier: BSD-3-Clause
"""`run.py engrane folder [--update]`: does every wrong deck give exactly the message beside it?

Each `x.dat` of the folder that has an `x.err` is checked, in that folder, by `engrane check x.dat`.
The program must end with status 1 and write `x.err` to stderr. A deck that says `! test: run 2` is run
instead, in a folder of its own, and must end with that status: models that read well and cannot be
solved (2), or deserve a warning (0). Numbers of such a run may differ by 0.02 of them, or by as much as
`! test: within 0.5` says. `! test: check 0` is for warnings that come before any run. Decks
without an `.err` are parts that others read by INPUT. `--update` writes the messages afresh, for every
deck of the folder that is not such a part: read the difference before you commit it.
"""

import argparse
import difflib
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

parser = argparse.ArgumentParser(description="compares the messages about wrong decks with the expected ones")
parser.add_argument("engrane", type=Path)
parser.add_argument("folder", type=Path)
parser.add_argument("--update", action="store_true", help="write the expected messages afresh")
arguments = parser.parse_args()

binary = arguments.engrane.resolve()
decks = sorted(arguments.folder.glob("*.dat"))
parts = set()
for deck in decks:
    for name in re.findall(r'(?im)^\s*INPUT\s+"([^"]+)"', deck.read_bytes().decode("latin-1")):
        parts.add(name if name.endswith(".dat") else name + ".dat")

NUMBER = re.compile(r"(?<![\w.])-?\d+\.?\d*(?:e[+-]?\d+)?(?!\w)")


def same_but_for_rounding(one: str, other: str, within: float) -> bool:
    """Times and gaps of a solution that failed depend on the last digits of what the solver did."""
    if NUMBER.split(one) != NUMBER.split(other):
        return False
    pairs = zip(NUMBER.findall(one), NUMBER.findall(other), strict=True)
    return all(abs(float(a) - float(b)) <= within * abs(float(b)) for a, b in pairs)


checked = 0
failures = []
for deck in decks:
    expected_file = deck.with_suffix(".err")
    if not expected_file.exists() and (not arguments.update or deck.name in parts):
        if deck.name not in parts:
            failures.append(f"{deck}: no {expected_file.name} beside it")
        continue
    wish = re.search(r"(?m)^\s*!\s*test:\s*(check|run)\s+(\d)", deck.read_bytes().decode("latin-1"))
    wide = re.search(r"(?m)^\s*!\s*test:\s*within\s+(\S+)", deck.read_text(encoding="latin-1"))
    within = float(wide.group(1)) if wide else 0.02
    task, status = (wish.group(1), int(wish.group(2))) if wish else ("check", 1)
    with tempfile.TemporaryDirectory() as folder:
        place = deck.parent
        if task == "run":
            place = Path(shutil.copy(deck, folder)).parent
        command = [binary, *(["check"] if task == "check" else ["-q"]), deck.name]
        run = subprocess.run(command, cwd=place, capture_output=True, timeout=60, check=False)
    messages = run.stderr.decode("utf-8", errors="replace")
    checked += 1
    if run.returncode != status:
        failures.append(f"{deck}: exit status {run.returncode} instead of {status}\n{messages}")
        continue
    if arguments.update:
        expected_file.write_text(messages, encoding="utf-8", newline="\n")
        continue
    expected = expected_file.read_text(encoding="utf-8")
    if messages != expected and not (task == "run" and same_but_for_rounding(messages, expected, within)):
        lines = difflib.unified_diff(
            expected.splitlines(), messages.splitlines(), expected_file.name, "engrane check", lineterm=""
        )
        failures.append("\n".join([f"{deck}: other messages than expected", *lines]))

for failure in failures:
    print(failure)
print(f"{checked} wrong decks checked, {len(failures)} failures")
if failures or checked == 0:
    sys.exit(1)
