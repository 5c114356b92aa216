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


def keyword_help(engrane, card: str, keyword: str) -> str:
    """What `engrane help card` says about one keyword, on one line."""
    text = engrane("help", *card.split()).stdout
    found = re.search(rf"^  {keyword}\b.*\n(?:      .*\n)*", text, re.MULTILINE)
    assert found, f"{card} has no {keyword}"
    return " ".join(found[0].split())


def test_help_tells_ranges_of_numbers_that_are_given(engrane):
    """No range of a function, which would read as that of its values, and no default outside the range."""
    for card, keyword in (("HINGE", "NF"), ("HINGE", "CLAW"), ("GEAR", "PITCHA"), (".CLM CHA", "NF")):
        assert "at least" not in keyword_help(engrane, card, keyword)
    for card, keyword in (("HINGE", "KSTOP"), ("BEAM", "BPR_END"), ("BEAM", "MAT")):
        said = keyword_help(engrane, card, keyword)
        assert "default" not in said and ("greater than 0" in said or "at least 1" in said)
    assert "default 1" in keyword_help(engrane, "HINGE", "EXP")


def test_help_names_words_that_may_stand_before_a_value(engrane):
    assert "DT may stand before the value" in keyword_help(engrane, ".SAI", "FIELDS")
    assert "VAL or V may stand before the value" in keyword_help(engrane, ".CLM STRU", "ACC")


def test_help_of_rack_and_cam_offers_what_they_take(engrane):
    rack = engrane("help", "RACK").stdout
    assert "wheel B" not in rack and "ECCB" not in rack and "PITCHB" not in rack
    for keyword in ("X", "TIP", "TIPALTER"):
        assert " a number " in keyword_help(engrane, "RACK", keyword)
        assert "1 to 2 numbers" in keyword_help(engrane, "GEAR", keyword)
    friction = keyword_help(engrane, "CAM", "FRICTION")
    assert (
        "STICK" not in friction and "CONSTANT), 1 value: mu STRIBECK" in friction and "needs VREG" in friction
    )
    assert "STIFF ISO and SLICES need it" in keyword_help(engrane, "GEAR", "WIDTH")


def test_check_counts_the_expected_results(engrane, pendulum):
    text = (engrane.folder / pendulum).read_text()
    (engrane.folder / "one.dat").write_text(
        text.replace(".FIN", ".CHK\n RUN ENERGY_ERROR V 0 ATOL 1\n.FIN", 1)
    )
    assert "1 check (.CHK) will be made" in engrane("check", "one.dat").stdout
