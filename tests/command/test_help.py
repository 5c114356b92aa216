# SPDX-License-Identifier: BSD-3-Clause
"""Help, pages, and what is said of decks that are hardly decks."""

import itertools
import re
from pathlib import Path


def test_help_takes_words(engrane):
    done = engrane("help", "gear", "friction")
    assert done.returncode == 0
    assert "\nGEAR: " in done.stdout and "FRICTION: sliding friction between the flanks" in done.stdout
    assert engrane("help", ".CLM", "FIX").stdout.startswith(".CLM FIX (also")
    done = engrane("help", "xyzzy")
    assert (done.returncode, done.stdout) == (1, "")
    assert "there is no card xyzzy" in done.stderr


def test_a_command_with_several_cards_is_listed(engrane):
    done = engrane("help", ".CLM")
    assert done.returncode == 0
    for card in (".CLM FIX", ".CLM DEP", ".CLM CHA", ".CLM STRU"):
        assert f"\n{card}: " in done.stdout


def test_a_deck_without_steps_says_what_it_does(engrane, pendulum):
    text = (engrane.folder / pendulum).read_text().replace(".SUB TF 0.2 H 0.01\n", "")
    (engrane.folder / "stepless.dat").write_text(text)
    said = "the deck has no .SUB: t = 0 to 1 in steps of 0.1"
    done = engrane("stepless.dat", "-q")
    first, second = done.stderr.splitlines()
    assert (done.returncode, first) == (4, f"engrane: {said}"), "the step is coarse"
    assert second.startswith("engrane: the energy balance was off by up to 1.18 N·m, 12 %")
    assert said in engrane("check", "stepless.dat").stdout
    assert said not in engrane("check", pendulum).stdout


def test_an_empty_deck_is_not_run(engrane):
    (engrane.folder / "empty.dat").write_text("\n! nothing\n")
    done = engrane("empty.dat")
    assert (done.returncode, "is empty" in done.stderr) == (1, True)
    assert not (engrane.folder / "empty.h5").exists()


def test_the_pages_name_files_that_exist():
    """Paths in the pages of docs/ may have * and {a,b}; adding.md names files that the reader is to make."""
    root = Path(__file__).parents[2]
    missing = []
    for page in [root / "README.md", *sorted((root / "docs").rglob("*.md"))]:
        if page.name == "adding.md" or page.parent.name in ("decisions", "changes"):
            continue
        for path in re.findall(r"\b(?:decks|tests|src)/[\w/*.{},-]*\w", page.read_text()):
            parts = re.split(r"\{(.*?)\}", path)
            choices = itertools.product(
                *([part] if i % 2 == 0 else part.split(",") for i, part in enumerate(parts))
            )
            missing += [f"{page.name}: {path}" for one in choices if not any(root.glob("".join(one)))]
    assert not missing
