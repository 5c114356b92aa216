# SPDX-License-Identifier: BSD-3-Clause
"""Help, and what is said of decks that are hardly decks."""


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
    assert (done.returncode, done.stderr) == (4, f"engrane: {said}\n"), "the step is coarse"
    assert said in engrane("check", "stepless.dat").stdout
    assert said not in engrane("check", pendulum).stdout


def test_an_empty_deck_is_not_run(engrane):
    (engrane.folder / "empty.dat").write_text("\n! nothing\n")
    done = engrane("empty.dat")
    assert (done.returncode, "is empty" in done.stderr) == (1, True)
    assert not (engrane.folder / "empty.h5").exists()
