# SPDX-License-Identifier: BSD-3-Clause
"""`changelog.py [--update]`: is docs/CHANGELOG.md made of the pages in docs/changes, the newest first?"""

import difflib
import re
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1] / "docs"
PAGE = DOCS / "CHANGELOG.md"


def version_of(path: Path) -> tuple[int, ...]:
    return tuple(int(n) for n in re.findall(r"\d+", path.stem))


pages = sorted((DOCS / "changes").glob("*.md"), key=lambda path: (version_of(path), path.stem), reverse=True)
text = "# Changes\n\nMade from the pages in [changes/](changes) by `tests/changelog.py --update`.\n"
for page in pages:
    body = page.read_text(encoding="utf-8").strip()
    body = re.sub(r"^#", "##", body, flags=re.MULTILINE)
    text += "\n" + body.replace("](../", "](") + "\n"

if "--update" in sys.argv[1:]:
    PAGE.write_text(text, encoding="utf-8", newline="\n")
kept = PAGE.read_text(encoding="utf-8") if PAGE.is_file() else ""
lines = list(
    difflib.unified_diff(
        kept.splitlines(), text.splitlines(), "docs/CHANGELOG.md", "docs/changes", lineterm="", n=1
    )
)
if not pages or lines:
    print("\n".join(lines[:60]))
    sys.exit("docs/CHANGELOG.md is out of date: python3 tests/changelog.py --update")
