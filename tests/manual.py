# SPDX-License-Identifier: BSD-3-Clause
"""`manual.py engrane docs/reference.md`: is the reference manual the one that the program writes?"""

import difflib
import subprocess
import sys
from pathlib import Path

binary, page = sys.argv[1:]
fresh = subprocess.run([binary, "manual"], check=True, capture_output=True, text=True).stdout.splitlines()
kept = Path(page).read_text(encoding="utf-8").splitlines()
lines = list(difflib.unified_diff(kept, fresh, "docs/reference.md", "engrane manual", lineterm="", n=1))
if lines:
    print("\n".join(lines[:60]))
    sys.exit("docs/reference.md is out of date: ./engrane manual > docs/reference.md")
