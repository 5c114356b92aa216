# SPDX-License-Identifier: BSD-3-Clause
"""docs/guide.md does what it says: its deck in pieces, its commands in their order, its mistake."""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from engrane_post import Results
from ranks import on_ranks

ROOT = Path(__file__).resolve().parents[2]
GUIDE = (ROOT / "docs/guide.md").read_text(encoding="utf-8")
PICTURES = ("plot", "spectrum", "orders", "picture", "animate", "inertia", "sweep", "study")
SKIPPED = ("git clone", "./engrane demo")  # tests/launcher has them
RANKS = re.compile(r"^-np (\d+) ")


def deck_of_the_guide() -> str:
    """The pieces of section 2, put together."""
    pieces = re.findall(r"^```\n(.*?)^```$", GUIDE, re.MULTILINE | re.DOTALL)
    return "".join(piece for piece in pieces if piece.startswith("."))


def commands() -> list[str]:
    """All commands of the guide, without their comments."""
    outside = re.sub(r"^```\n.*?^```$", "", GUIDE, flags=re.MULTILINE | re.DOTALL)
    lines = [line.strip() for line in outside.splitlines() if line.startswith("    ")]
    return [re.sub(r"\s+#.*", "", line) for line in lines if not line.startswith(SKIPPED)]


def argv(command: str) -> list[str]:
    """The words that the launcher would run."""
    launcher, *words = shlex.split(command)
    assert launcher == "./engrane", command
    if words[0] in PICTURES:
        return [sys.executable, "-m", "engrane_post", *words]
    if words[0] == "-np":
        return on_ranks(int(words[1]), [os.environ["ENGRANE"], *words[2:]])
    return [os.environ["ENGRANE"], *words]


def made_by(command: str) -> list[str]:
    """The files that a command must leave."""
    prefix = re.search(r" -o (\S+)", command)
    words = shlex.split(command)
    if words[1] in ("sweep", "study"):
        return [f"my_{words[1]}.csv", f"my_{words[1]}.png"]
    if not prefix or "--until" in command:
        return []
    if words[1] in PICTURES:
        return [prefix.group(1)]
    if prefix.group(1).endswith("/"):
        return [f"{prefix.group(1)}{Path(word).stem}.h5" for word in words if word.endswith(".dat")]
    return [f"{prefix.group(1)}.{end}" for end in ("h5", "xdmf", "lst")]


@pytest.fixture
def place(tmp_path):
    """A folder with the decks and, as section 5 wants it, a copy of one with a name for the stiffness."""
    if not Path(os.environ.get("ENGRANE", "")).is_file():
        pytest.skip("the variable ENGRANE names no program")
    paper = tmp_path / "decks/paper"
    shutil.copytree(ROOT / "decks/paper", paper)
    for other in (ROOT / "decks").iterdir():
        if other.name != "paper":
            (tmp_path / "decks" / other.name).symlink_to(other)
    text = (paper / "spur_transmission_a.dat").read_text(encoding="utf-8")
    # 15 000 steps, three times: a fifth of them, as long as five, do for pictures
    assert ".SUB TF 0.03 H 2D-6" in text
    long_steps = text[: text.index(".CHK")].replace("H 2D-6", "H 1D-5") + ".FIN 1\n"
    # 15 frames of an animation in place of 120
    assert ".SAI FIELDS DT 1D-4" in long_steps
    long_steps = long_steps.replace(".SAI FIELDS DT 1D-4", ".SAI FIELDS DT 2D-3")
    (paper / "spur_transmission_a.dat").write_text(long_steps, encoding="utf-8")
    assert "`ABRE '/KM' '1.477E7'`" in GUIDE and "`KM /KM`" in GUIDE
    assert "Delete `.CHK` and the lines below it, up to `.FIN`" in GUIDE, "as is done below"
    mine = "ABRE '/KM' '1.477E7'\n" + text.replace("KM 1.477E7", "KM /KM")
    assert mine.count("/KM") == 2
    # the guide's run is long, and is made above from the deck itself
    mine = mine.replace(".SUB TF 0.03", ".SUB TF 0.001")
    (tmp_path / "my.dat").write_text(mine[: mine.index(".CHK")], encoding="utf-8")
    return tmp_path


def test_the_guide_has_what_this_looks_for():
    found = commands()
    assert len(found) >= 18
    for word in (
        "check",
        "plot",
        "picture",
        "spectrum",
        "animate",
        "sweep",
        "study",
        "help",
        "template",
        "-np",
        "--until",
    ):
        assert any(word in command.split() for command in found), word


def test_the_deck_in_pieces_is_the_deck(place):
    (place / "pieces.dat").write_text(deck_of_the_guide(), encoding="utf-8")
    shutil.copy(ROOT / "decks/paper/bevel_pair.dat", place / "whole.dat")
    forces = []
    for name in ("pieces", "whole"):
        done = subprocess.run(
            [os.environ["ENGRANE"], f"{name}.dat"], cwd=place, capture_output=True, text=True, timeout=120
        )
        assert done.returncode == 0, done.stdout + done.stderr
        with Results(place / f"{name}.h5") as results:
            forces.append(results.history("element/1/NORMAL_FORCE")[1])
    assert np.allclose(forces[0], forces[1], rtol=1e-12)


def test_the_mistake_of_the_guide(place):
    assert "Write `ALFA` for `ALPHA`" in GUIDE
    (place / "wrong.dat").write_text(deck_of_the_guide().replace("ALPHA", "ALFA"), encoding="utf-8")
    done = subprocess.run(
        [os.environ["ENGRANE"], "wrong.dat"], cwd=place, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 1
    assert "wrong.dat:" in done.stderr and "did you mean `ALPHA`?" in done.stderr
    assert sorted(p.name for p in place.iterdir()) == ["decks", "my.dat", "wrong.dat"], "nothing is written"


def test_all_commands(place):
    environment = os.environ | {"PYTHONPATH": str(ROOT / "post")}
    for command in commands():
        done = subprocess.run(
            argv(command), cwd=place, capture_output=True, text=True, timeout=600, env=environment
        )
        expected = 2 if "--until" in command else 0
        assert done.returncode == expected, f"{command}\n{done.stdout}{done.stderr}"
        for name in made_by(command):
            assert (place / name).stat().st_size > 0, command
    with Results(place / "long.h5") as results:
        assert results.times()[-1] == pytest.approx(0.03)
