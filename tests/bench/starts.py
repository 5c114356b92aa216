# SPDX-License-Identifier: BSD-3-Clause
"""`starts.py [build/bin/engrane] [--count 200] [--rounds 1] [--shared]`: many plain starts at once.

Every run must end with status 0 and leave nothing behind. With `--shared` the user has set one folder for
all of them; programs before 0.6.0 shared it, and one run in ten failed. On demand: it keeps a machine busy.
"""

import argparse
import collections
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

DECK = """.UNIT SI
.NOE I 1 X 1 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 0 AT 0 0 0
 I 2 INERTIA N 1 M 1 J 0.1
.CLM STRU ACC VAL 0 0 -9.81
.SAM TYPE DYNAMIC
.SUB TF 0.1 H 0.01
"""

parser = argparse.ArgumentParser(description="starts many runs at the same moment")
parser.add_argument("engrane", type=Path, nargs="?", default=Path("build/bin/engrane"))
parser.add_argument("--count", type=int, default=200)
parser.add_argument("--rounds", type=int, default=1)
parser.add_argument("--shared", action="store_true", help="all runs share a folder that the user has set")
arguments = parser.parse_args()

program = arguments.engrane.resolve()
environment = {name: value for name, value in os.environ.items() if not name.startswith("OMPI_MCA_")}
if os.geteuid() == 0:
    environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
statuses = collections.Counter()
left = 0
for _ in range(arguments.rounds):
    with tempfile.TemporaryDirectory(prefix="starts") as folder:
        sessions = Path(folder, "tmp")
        sessions.mkdir()
        settings = environment | {"TMPDIR": str(sessions)}
        if arguments.shared:
            settings |= {"OMPI_MCA_orte_tmpdir_base": str(sessions), "OMPI_MCA_ess_singleton_isolated": "1"}
        Path(folder, "deck.dat").write_text(DECK)
        began = time.perf_counter()
        runs = [
            subprocess.Popen(
                [program, "-q", "deck.dat", "-o", f"run{i}"],
                cwd=folder,
                env=settings,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
            )
            for i in range(arguments.count)
        ]
        for run in runs:
            _, errors = run.communicate()
            statuses[run.returncode] += 1
            if run.returncode != 0 and statuses[run.returncode] == 1:
                print(errors.decode(errors="replace")[-600:])
        print(f"{arguments.count} runs in {time.perf_counter() - began:.1f} s")
        left += len(list(sessions.iterdir()))

print("statuses:", dict(statuses), "- folders left behind:", left)
sys.exit(0 if set(statuses) == {0} and left == 0 else 1)
