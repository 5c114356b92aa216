# SPDX-License-Identifier: BSD-3-Clause
"""Completion and manual page, made from the declared cards."""

import re
import shutil
import subprocess

import pytest


def complete(engrane, line: str) -> list[str]:
    """What bash offers behind the line."""
    script = engrane.folder / "completion.bash"
    script.write_text(engrane("completion").stdout)
    words = line.split(" ")
    ask = (
        f"source {script}; COMP_WORDS=({' '.join(repr(w) for w in words)}); COMP_CWORD={len(words) - 1}; "
        "_engrane; printf '%s\\n' \"${COMPREPLY[@]}\""
    )
    done = subprocess.run(["bash", "-c", ask], cwd=engrane.folder, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and done.stderr == "", done.stderr
    return done.stdout.split()


def test_bash_completes_tasks_cards_options_and_decks(engrane, pendulum):
    (engrane.folder / "other.txt").write_text("")
    assert complete(engrane, "engrane che") == ["check"]
    assert complete(engrane, "engrane sw") == ["sweep"]
    assert complete(engrane, "engrane stu") == ["study"]
    assert complete(engrane, "engrane help GE") == ["GEAR"]
    assert complete(engrane, "engrane help hin") == ["HINGE"]
    assert complete(engrane, "engrane template FI") == ["FIX"]
    assert complete(engrane, "engrane p") == ["plot", "picture", pendulum]
    assert complete(engrane, "engrane check pen") == [pendulum]
    assert complete(engrane, f"engrane {pendulum} --js") == ["--json"]
    assert complete(engrane, "engrane o") == ["orders"]


def test_completion_offers_the_commands_of_the_launcher(engrane):
    from pathlib import Path

    launcher = (Path(__file__).resolve().parents[2] / "engrane").read_text()
    own = re.findall(r"^  ([a-z| ]+)\)", launcher, re.MULTILINE)
    offered = complete(engrane, "engrane ")
    for word in {w.strip() for line in own for w in line.split("|")}:
        assert word in offered, word


def test_the_manual_page_is_good_roff(engrane):
    page = engrane("man").stdout
    for word in (".SS GEAR", ".SS \\&.CLM FIX", "\\-\\-json", "SH NAME"):
        assert word in page
    if not shutil.which("groff"):
        pytest.skip("no groff")
    (engrane.folder / "engrane.1").write_text(page)
    done = subprocess.run(
        ["groff", "-man", "-ww", "-Tutf8", "-K", "utf8", "engrane.1"],
        cwd=engrane.folder,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "normal pressure angle" in done.stdout
