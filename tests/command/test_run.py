# SPDX-License-Identifier: BSD-3-Clause
"""Running decks: definitions, several decks, results asked for, the summary for programs."""

import json
from pathlib import Path

import pytest
from small_decks import SPRINGS


def acceleration(engrane, deck, *words):
    """Of the pendulum when it is let go: g L/(L² + i²), i² = 0.01."""
    done = engrane(deck, "--result", "NODE 1 EY T 0", "--json", *words)
    assert done.returncode == 0, done.stderr
    return abs(json.loads(done.stdout)["runs"][0]["results"][0]["value"])


def test_a_definition_overrules_the_deck(engrane, pendulum):
    assert acceleration(engrane, pendulum) == pytest.approx(9.81 * 0.5 / 0.26, rel=1e-9)
    assert acceleration(engrane, pendulum, "-D", "L=0.1") == pytest.approx(9.81 * 0.1 / 0.02, rel=1e-9)
    assert acceleration(engrane, pendulum, "-D/L=(1/10)", "-D", "M=7") == pytest.approx(49.05, rel=1e-9)
    assert "pendulum.dat -D L=(1/10) -D M=7" in (engrane.folder / "pendulum.lst").read_text()


def test_an_unknown_definition_lists_those_of_the_deck(engrane, pendulum):
    done = engrane(pendulum, "-D", "LL=3")
    assert done.returncode == 1
    assert "-D LL: pendulum.dat has no abbreviation `/LL`" in done.stderr
    assert "did you mean L? It has /L and /M" in done.stderr
    done = engrane("check", pendulum, "-D", "width=3")
    assert (done.returncode, "it has /L and /M" in done.stderr) == (1, True)
    assert engrane(pendulum, "-D", "L").returncode == 1
    assert not list(engrane.folder.glob("*.h5"))


def test_a_card_stands_in_the_place_of_the_deck_s(engrane, pendulum):
    card = ".STEPS TF (0.2*/L) H 0.02 TI 0.02"  # with an abbreviation of the deck
    done = engrane(pendulum, "--card", card, "--card", ".SAM TYPE DYNAMIC SCHEME RADAU", "--json")
    run = json.loads(done.stdout)["runs"][0]
    assert (run["outcome"], run["steps"], run["time"]["end"]) == ("complete", 4, pytest.approx(0.1))
    assert run["cards"] == [card, ".SAM TYPE DYNAMIC SCHEME RADAU"]
    assert f'pendulum.dat --card "{card}" --card' in (engrane.folder / "pendulum.lst").read_text()
    # also one that the deck does not have, behind a deck that is read in few columns
    text = "MODE LECT 40\n" + (engrane.folder / pendulum).read_text()
    (engrane.folder / pendulum).write_text(text)
    done = engrane(pendulum, "--card", '.TITRE "a title that stands far behind the fortieth column"')
    assert done.returncode == 0
    assert "behind the fortieth column" in (engrane.folder / "pendulum.lst").read_text()


@pytest.mark.parametrize(
    ("card", "sentence"),
    [
        (".SUB TF 1", "--card:1:1: error: .SUB lacks H"),
        (".SUB TF 1 HH 2", "--card:1:11: error: `HH` is not a keyword of .SUB"),
        (".SUB TF 1 H 0.1 .SAM TYPE STATIC", "a command must be the first word of its line"),
        (".NOE I 1 X 0 0 0", "--card takes one card that a deck has once"),
        (".CLM FIX NOEUD 1 C 1", "another of .UNIT, .TITRE, .SAM, .SUB, .SAI, .PATH and .BUCKLING"),
        (".NONSENSE", "--card takes one card"),
        ("TF 1 H 2", "--card takes one card"),
        (".SUB TF 1 H 0.1\n.CLM", "--card takes one card"),
    ],
)
def test_a_wrong_card_is_told_by_the_option(engrane, pendulum, card, sentence):
    for words in ((pendulum, "--card", card), ("check", pendulum, "--card", card)):
        done = engrane(*words)
        assert done.returncode == 1
        assert sentence in done.stderr
    assert not list(engrane.folder.glob("*.h5"))


def test_several_decks_have_results_of_their_own(engrane, pendulum):
    text = (engrane.folder / pendulum).read_text()
    (engrane.folder / "failing.dat").write_text(text.replace("V 0 ATOL 1E-2", "V 5 ATOL 1E-2"))
    (engrane.folder / "wrong.dat").write_text(".NOE\n I 1 Q 3\n")
    done = engrane(pendulum, "failing.dat", "-o", "out/")
    assert done.returncode == 4
    assert {f.name for f in (engrane.folder / "out").iterdir()} == {
        f"{name}.{end}" for name in ("pendulum", "failing") for end in ("h5", "xdmf", "lst")
    }
    rows = [line.split() for line in done.stdout.splitlines() if ".dat" in line]
    assert [row[0] for row in rows] == [pendulum, "failing.dat"]
    assert rows[0][1:3] == ["complete", "20"]
    assert rows[1][1:3] == ["check", "failed"]
    assert engrane("wrong.dat", "failing.dat", pendulum).returncode == 1, (
        "a wrong deck is worse than a failed check"
    )
    assert (engrane.folder / "pendulum.h5").is_file(), "the decks behind a wrong one are run"


def test_several_decks_never_write_the_same_files(engrane, pendulum):
    (engrane.folder / "other").mkdir()
    (engrane.folder / "other" / pendulum).write_text((engrane.folder / pendulum).read_text())
    done = engrane(pendulum, f"other/{pendulum}")
    assert done.returncode == 1
    assert "would both write pendulum.h5" in done.stderr
    done = engrane(pendulum, "third.dat", "-o", "name")
    assert done.returncode == 1
    assert "-o name/" in done.stderr


def test_a_folder_takes_the_name_of_the_deck(engrane, pendulum):
    assert engrane(pendulum, "-o", "new/folder/").returncode == 0
    assert (engrane.folder / "new/folder/pendulum.h5").is_file()
    assert not (engrane.folder / "new/folder/.h5").exists()
    assert engrane(pendulum, "-o", ".").returncode == 0
    assert (engrane.folder / "pendulum.h5").is_file()


def test_json_is_all_there_is(engrane, pendulum):
    done = engrane(pendulum, "--json", "--result", "NODE 1 UZ MIN", "--result", "NODE 1 UZ T 9")
    summary = json.loads(done.stdout)
    assert summary["status"] == 0
    run = summary["runs"][0]
    assert (run["deck"], run["outcome"], run["steps"]) == (pendulum, "complete", 20)
    assert run["iterations"] >= 20
    assert run["time"] == {"reached": pytest.approx(0.2), "end": 0.2}
    assert run["checks"][0]["passed"] is True
    energies = run["energies"]
    assert energies["kinetic"] + energies["potential"] == pytest.approx(energies["error"], abs=1e-12)
    assert run["results"][0]["value"] < -0.1
    assert run["results"][1]["value"] is None
    assert "0.2" in run["results"][1]["remark"]
    assert run["files"] == ["pendulum.h5", "pendulum.xdmf", "pendulum.lst"]


def test_json_tells_what_is_wrong(engrane, pendulum):
    (engrane.folder / "wrong.dat").write_bytes(b".NOE\n I 1 X 0 0 0\n I 2 Q\xe9 3\n")
    done = engrane("wrong.dat", pendulum, "--json")
    summary = json.loads(done.stdout)
    assert (done.returncode, summary["status"]) == (1, 1)
    assert [run["outcome"] for run in summary["runs"]] == ["wrong deck", "complete"]
    fault = summary["runs"][0]["diagnostics"][0]
    assert (fault["severity"], fault["file"], fault["line"]) == ("error", "wrong.dat", 3)


def test_json_has_the_warnings_of_the_run(engrane):
    """Each as often as the listing has it."""
    done = engrane.succeeds("stiff", SPRINGS.format(stiff=1e16, kind="STATIC", h=1), "--json")
    warnings = json.loads(done.stdout)["runs"][0]["diagnostics"]
    (stiff,) = [one for one in warnings if "SPRING 2 is so stiff" in one["message"]]
    assert (stiff["severity"], "file" in stiff) == ("warning", False)
    listing = (engrane.folder / "stiff.lst").read_text()
    assert listing.count("warning: " + stiff["message"]) == 1


def test_results_asked_for_are_printed(engrane, pendulum):
    done = engrane(pendulum, "--result", "NODE 1 VZ MIN WINDOW 0 0.1")
    assert done.returncode == 0
    assert "MIN of NODE 1 VZ" in done.stdout
    done = engrane(pendulum, "--result", "NODE 1 VQ")
    assert done.returncode == 1
    assert "node 1 has no output VQ" in done.stderr


def test_quiet_says_nothing(engrane, pendulum):
    text = (engrane.folder / pendulum).read_text()
    (engrane.folder / "plain.dat").write_text(text[: text.index(".CHK")])
    (engrane.folder / "plain2.dat").write_text(text[: text.index(".CHK")])
    done = engrane("plain.dat", "plain2.dat", "-q")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_a_failure_does_not_speak_of_the_deck_before(engrane):
    wrong = Path(__file__).resolve().parents[1] / "errors/run"
    done = engrane(wrong / "function_not_a_number.dat", wrong / "open_loop.dat", "-q")
    assert done.returncode == 2
    first, second = (block for block in done.stderr.split("engrane: ") if block.strip())
    assert first.startswith('function 3, EXPR "sqrt(T-1)", is not a number at T = 0; hence ')
    assert "function" not in second and "does not close" in second


def test_the_word_run_may_stand_before_the_deck(engrane, pendulum):
    """It was taken for another deck: \"several decks need a folder\"."""
    assert engrane("run", "-q", pendulum, "-o", "x").returncode == 0
    assert (engrane.folder / "x.h5").exists()
    (engrane.folder / "run").write_text((engrane.folder / pendulum).read_text())
    assert "several decks need a folder" in engrane("run", pendulum, "-o", "y").stderr
