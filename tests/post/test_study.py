# SPDX-License-Identifier: BSD-3-Clause
"""`engrane study`, with the program itself."""

from __future__ import annotations

import csv
import json
import math
import os
import re
import signal
import subprocess
import sys
import time
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from engrane_post import study_errors, study_report
from engrane_post.errors import UserError
from engrane_post.runs import Run
from engrane_post.study_deck import (
    Deck,
    Rung,
    read_card,
    sample_interval,
    schema_of,
    setting_of,
    steps_ladder,
    steps_of,
    tolerances_ladder,
    usual_steps,
)
from engrane_post.study_errors import Truth, Values
from engrane_post.study_report import Attempt, cheapest, find_slopes
from small_decks import PENDULUM

POST = Path(__file__).resolve().parents[2] / "post"
# a mass on a spring: x = 1 - cos t, with the cards in their French names and over several lines
OSCILLATOR = """.NOE
 I 1 X 0 0 0
ABRE '/h' '0.05'
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 K 1
 I 2 INERTIA N 1 M 1
.CLM CHA NOEUD 1 C 1 V 1
.ANALYSE $
 TYPE DYNAMIQUE SCHEMA CHUNG $ ! a comment
 RHO 0.9 SOLVEUR KLU PREC 1D-10
.STEPS TF (10*PI) $
 PAS /h
.CHK
 NODE 1 UX T 20 V (1-cos(20)) ATOL 1
 NODE 1 UX MAX V 2 ATOL 1
 NODE 1 AX T 0 V 1 ATOL 1
 NODE 1 UY V 0 ATOL 1
 RUN ENERGY_ERROR V 0 ATOL 1
"""


@pytest.fixture
def program() -> str:
    found = os.environ.get("ENGRANE", "")
    if not Path(found).is_file():
        pytest.skip("the variable ENGRANE names no program")
    return found


@pytest.fixture
def deck(tmp_path: Path, monkeypatch, program) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "oscillator.dat").write_text(OSCILLATOR)
    (tmp_path / "pendulum.dat").write_text(PENDULUM)
    return tmp_path / "oscillator.dat"


def table(name: str = "oscillator") -> list[dict[str, str]]:
    with open(f"{name}_study.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def of_setting(rows: list[dict[str, str]], setting: str) -> list[dict[str, str]]:
    return [row for row in rows if row["setting"] == setting]


# Cards

OF_SAM = ("TYPE", "SCHEME", "RHO", "TANGENT", "SOLVER", "START", "PREC", "EVENTS", "RESTART")
SCHEMA = {
    ".SAM": {w: {} for w in (*OF_SAM, "ACCURACY", "PLANE")},
    ".SUB": {"TF": {}, "H": {}, "TI": {}, "TOL": {}, "HMAX": {}},
    ".SAI": {"FIELDS": {}, "NOEUD": {}, "CHANNEL": {}, "NEWTON": {"type": "boolean"}, "RESTART": {}},
}


def a_deck(sam: str, sub: str = ".SUB TF 1 H 1e-03", sai: str = "") -> Deck:
    return Deck("\n".join((".NOE", " I 1 X 0", sam, sub, sai)), SCHEMA)


def test_cards_keep_what_a_setting_does_not_speak_of() -> None:
    sam = ".SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.7 START $\n   STATIC EVENTS YES 1e-05"
    sam += ' RESTART "a SCHEME b"\n  ! by default: X'
    deck = a_deck(sam, ".SUB TF 2 H 1e-03 TI 1\n  ! by default: NOTHING")
    assert (deck.analysis, deck.scheme, deck.solver) == ("DYNAMIC", "CHUNG", "MUMPS")
    assert (deck.step, deck.start, deck.span) == (1e-3, 1.0, 1.0)
    rest = 'START STATIC EVENTS YES 1e-05 RESTART "a SCHEME b"'
    kept = deck.sam_card({"SCHEME": "CHUNG", "TANGENT": "KEPT"}, "KLU")
    assert kept.text == f".SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.7 TANGENT KEPT SOLVER KLU {rest}"
    # the damping of a scheme is that scheme's own
    assert deck.sam_card({"SCHEME": "RADAU"}, "MUMPS").text == f".SAM TYPE DYNAMIC SCHEME RADAU {rest}"
    other = deck.sam_card({"SCHEME": "CHUNG", "RHO": "0.2", "TANGENT": "FULL", "START": "AS_GIVEN"}, "MUMPS")
    assert other.text.startswith(".SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.2 START AS_GIVEN EVENTS YES 1e-05")
    assert deck.sub_card(Rung({"H": "0.01"}, 0.01)).text == ".SUB TF 2 H 0.01 TI 1"
    assert deck.title == "CHUNG RHO 0.7"


def test_a_ladder_of_tolerances_stands_beside_one_of_steps() -> None:
    deck = a_deck(".SAM TYPE DYNAMIC")
    ladder = tolerances_ladder("CHUNG TOL", {"SCHEME": "CHUNG"}, 0.01, [1e-5, 1e-3])
    assert [deck.sub_card(r).text for r in ladder.rungs] == [
        ".SUB TF 1 H 0.01 TOL 0.001",
        ".SUB TF 1 H 0.01 TOL 1e-05",
    ]
    # and a deck with a tolerance loses it where steps are studied
    with_tolerance = Deck(".SUB TF 1 H 0.1 TOL 1e-03 HMAX 0.2 TI 0.5", SCHEMA)
    assert with_tolerance.sub_card(Rung({"H": "0.05"}, 0.05)).text == ".SUB TF 1 H 0.05 TI 0.5"
    other = with_tolerance.sub_card(Rung({"H": "0.05", "TOL": "1e-4"}, 1e-4))
    assert other.text == ".SUB TF 1 H 0.05 TOL 1e-4 HMAX 0.2 TI 0.5"
    assert with_tolerance.own().rungs[0].sub == {"H": "0.1", "TOL": "1e-03"}


# as the program writes it out
WITH_ACCURACY = """.SAM TYPE DYNAMIC ACCURACY NORMAL PREC 1e-10
  ! by default: SCHEME RADAU SOLVER AUTO START AS_GIVEN TANGENT FULL
  ! PLANE AUTO EVENTS YES"""


def test_accuracy_is_of_the_deck_as_it_is() -> None:
    deck = a_deck(WITH_ACCURACY, ".SUB TF 1 H 0.01 TOL 1e-04\n  ! by default: TI 0")
    assert (deck.scheme, deck.solver, deck.accuracy) == ("RADAU", "AUTO", "ACCURACY NORMAL")
    assert deck.own().title == "the deck: ACCURACY NORMAL" and deck.own().rungs[0].title == "TOL 1e-04"
    assert deck.own_sam_card("AUTO").text == ".SAM TYPE DYNAMIC ACCURACY NORMAL PREC 1e-10"
    assert deck.own_sam_card("KLU").text == ".SAM TYPE DYNAMIC ACCURACY NORMAL PREC 1e-10 SOLVER KLU"
    # with another setting H is the step
    chung = deck.sam_card({"SCHEME": "CHUNG"}, "KLU")
    assert chung.text == ".SAM TYPE DYNAMIC SCHEME CHUNG SOLVER KLU PLANE AUTO PREC 1e-10"
    assert deck.sam_card({"SCHEME": "RADAU", "PLANE": "NO"}, "MUMPS").get("PLANE") == "NO"
    assert deck.sub_card(Rung({"H": "0.01"}, 0.01)).text == ".SUB TF 1 H 0.01"
    damped = a_deck(".SAM TYPE DYNAMIC RHO 0.9 ACCURACY FINE\n  ! by default: SCHEME CHUNG SOLVER AUTO")
    assert (damped.setting, damped.title) == ("CHUNG RHO 0.9", "CHUNG RHO 0.9 ACCURACY FINE")
    assert damped.own().rungs[0].title == "chosen"
    assert damped.own_sam_card("AUTO").get("SCHEME") is None, "the deck leaves it to the program"
    assert damped.sam_card({"SCHEME": "CHUNG"}, "MUMPS").text == ".SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.9"
    # the defaults of another card are no defaults of .SAM
    other = a_deck(".SAM TYPE DYNAMIC", ".SUB TF 1 H 0.1\n  ! by default: SCHEME RADAU")
    assert other.scheme == "CHUNG"


def test_accuracy_judges_what_the_deck_keeps() -> None:
    deck = a_deck(WITH_ACCURACY, ".SUB TF 1 H 0.01", ".SAI FIELDS 0.1 NOEUD 1")
    assert deck.own_sai_card(1, "NONE").text == ".SAI FIELDS DT 1 NOEUD 1"
    assert deck.own_sai_card(0.08, None).text == ".SAI FIELDS DT 1 NOEUD 1", "0.08 is among its samples"
    assert deck.own_sai_card(0.015, None).text == ".SAI FIELDS DT 1 HISTORY DT 0.015 NOEUD 1"
    assert deck.own_sai_card(0.08, "ALL").text == ".SAI FIELDS DT 1 KEEP ALL"
    assert a_deck(".SAM TYPE DYNAMIC").own_sai_card(1, "NONE").text.endswith("HISTORY DT 1 KEEP NONE")


def test_samples_are_of_what_the_deck_selects() -> None:
    deck = a_deck(
        ".SAM TYPE DYNAMIC", sai='.SAI FIELDS 0.1 NOEUD 1 A 4 CHANNEL "UX" "NEWTON" NEWTON RESTART 3'
    )
    assert (
        deck.sai_card(0.25, None).text == '.SAI FIELDS DT 1 HISTORY DT 0.25 NOEUD 1 A 4 CHANNEL "UX" "NEWTON"'
    )
    assert deck.sai_card(0.25, "NONE").text == ".SAI FIELDS DT 1 HISTORY DT 0.25 KEEP NONE"
    assert read_card(".SUB TF 1 H 1", ".SAI", SCHEMA) is None


def test_the_program_s_own_schema_has_the_keywords(program) -> None:
    done = subprocess.run([program, "schema"], capture_output=True, text=True, check=True)
    schema = schema_of(done.stdout)
    assert {"SCHEME", "RHO", "ALPHA", "TANGENT", "SOLVER", "TYPE"} <= set(schema[".SAM"])
    assert {"TF", "H", "TI"} <= set(schema[".SUB"])
    assert schema[".SAI"]["NEWTON"]["type"] == "boolean"


def test_settings_and_steps() -> None:
    assert setting_of("scheme chung rho 0.5") == {"SCHEME": "CHUNG", "RHO": "0.5"}
    assert setting_of("RADAU") == {"SCHEME": "RADAU"}
    for wrong in ("", "SCHEME", "RADAU PREC", "CHUNG SOLVER KLU", "RADAU ACCURACY FINE"):
        with pytest.raises(UserError):
            setting_of(wrong)
    assert steps_of("1e-3, 5D-4", 1) == [1e-3, 5e-4]
    assert steps_of("H/4,4H,h,2*H", 0.5) == [2, 1, 0.5, 0.125]
    assert steps_of("8H:H/2", 1) == [8, 4, 2, 1, 0.5]
    for wrong in ("", "0", "-1", "3Q", "H/0", "1:2:3", "1e-3:1e-30", "H/x", "1e999"):
        with pytest.raises(UserError):
            steps_of(wrong, 1e-3)
    assert usual_steps("CHUNG", 1, 1e9) == [8, 4, 2, 1, 0.5, 0.25]
    assert usual_steps("RADAU", 1, 20) == [2, 1]
    assert usual_steps("RADAU", 1, 1.5) == [1]
    step = math.pi / 160
    assert [float(r.sub["H"]) for r in steps_ladder("", {}, [step, step / 4]).rungs] == [step, step / 4]
    assert sample_interval([4, 2, 1, 0.5], 100) == 4
    assert sample_interval([3, 2], 100) == 6
    for wrong in ([1, 0.7323], [4, 2]):
        with pytest.raises(UserError, match="same instants"):
            sample_interval(wrong, 5)


# Errors


def an_attempt(title: str, h: float, error: float, seconds: float, solved: bool = True) -> Attempt:
    ladder = steps_ladder(title, {"SCHEME": title}, [h])
    run = Run("", [], Path(), status=0 if solved else 2, message="" if solved else "engrane: broken\nmore")
    run.summary = {"steps": round(1 / h)}
    return Attempt(ladder, ladder.rungs[0], "KLU", (), run, seconds, {"x": error} if solved else {})


def test_errors_are_over_the_size_of_what_is_compared() -> None:
    t = np.array([0.0, 1.0, 2.0, 2.5])
    fine = Values(
        {"a": -2.0, "b": 0.0, "c": 5.0}, t, {"h": np.array([0, 4.0, 2, 1]), "still": np.full(4, 3.0)}
    )
    coarse = Values(
        {"a": -2.002, "b": 0.1, "c": 8.0}, t, {"h": np.array([0, 4.02, 2, 1]), "still": np.full(4, 3.0)}
    )
    truth = study_errors.truth_of_runs("a run", fine, coarse)
    assert truth.own == {"a": pytest.approx(1e-3), "h": pytest.approx(5e-3)}
    assert truth.floor == pytest.approx(1.5e-2)
    left = "; ".join(truth.left_out)
    assert (
        "b: it is 0" in left
        and "still: it does not change" in left
        and "c: the reference's own error is 0.6" in left
    )
    # an instant that only one of them has counts for nothing, and too few in common give no value
    other = Values({"a": -3.0}, np.array([0, 0.5, 1.0, 2.5]), {"h": np.array([0, 99, 4.4, 1])})
    assert truth.errors(other) == {"a": pytest.approx(0.5), "h": pytest.approx(0.1)}
    few = truth.errors(Values({}, np.array([0.0, 0.5]), {"h": np.zeros(2)}))
    assert all(math.isnan(e) for e in few.values())


def test_what_is_small_by_chance_is_not_recommended() -> None:
    chance = [an_attempt("A", 4, 1e-5, 1), an_attempt("A", 2, 5e-2, 2), an_attempt("A", 1, 8e-4, 4)]
    steady = [
        an_attempt("B", 4, 2e-2, 2),
        an_attempt("B", 2, 5e-4, 8, solved=False),
        an_attempt("B", 1, 4e-4, 5),
    ]
    assert cheapest(chance, 1e-3, 0) is chance[2]
    assert cheapest(steady, 1e-3, 0) is steady[2]
    assert cheapest(chance + steady, 1e-3, 0) is chance[2]
    assert cheapest(chance + steady, 1e-1, 0) is chance[0]
    assert cheapest(steady, 1e-4, 0) is None
    # of runs that cost the same the most accurate; nothing is met that the reference cannot tell
    same = [an_attempt("C", 2, 9e-4, 1.0), an_attempt("C", 1, 1e-7, 1.01)]
    assert cheapest(same, 1e-3, 0) is same[1]
    assert cheapest(same, 1e-5, 3e-5) is None
    why = study_report.why_none(same, Truth("", Values(), {}, {"x": 1e-5}), 1e-5)
    assert "the reference is good to 3e-5 only" in why


def test_slopes_are_of_the_steps_made() -> None:
    ladder = [
        an_attempt("A", 0.04, 1.6e-1, 1),
        an_attempt("A", 0.02, 4e-2, 1),
        an_attempt("A", 0.01, 1e-9, 1),
    ]
    ladder.insert(0, an_attempt("A", 0.08, 1.6e-1, 1))
    ladder[0].run.summary["steps"] = ladder[1].steps  # all of its steps were cut
    find_slopes(ladder, 1e-8)
    assert [a.slope for a in ladder] == [None, None, pytest.approx(2), None]


# The command


def test_errors_are_those_against_the_closed_form(deck: Path, command) -> None:
    words = ("study", "oscillator", "--solvers", "KLU", "--runs", "1")
    status, out, err = command(*words, "--reference", "check")
    assert (status, err) == (0, "")
    assert "left out: NODE 1 UY at the end: its V is 0" in out
    exact = table()
    names = list(exact[0])[list(exact[0]).index("SUB") + 1 :]
    assert names == ["NODE 1 UX at t = 20", "MAX of NODE 1 UX"], "neither of the start, nor of what is 0"
    assert {r["SAM"] for r in of_setting(exact, "RADAU")} == {
        ".SAM TYPE DYNAMIC SCHEME RADAU SOLVER KLU PREC 1e-10"
    }
    status, out, err = command(*words)
    assert (status, err) == (0, "")
    assert "reference: RADAU PREC 1e-12, H 0.0125; its own error is" in out
    name = "NODE 1 UX at t = 20"
    for one, other in zip(exact, table(), strict=True):
        assert one["steps"] == other["steps"]
        if not one["steps"]:
            continue  # RADAU with half of a period in a step
        assert float(one[name]) == pytest.approx(float(other[name]), rel=0.06, abs=1e-8)
    for setting, order in (("CHUNG TANGENT FULL", 2), ("CHUNG TANGENT KEPT", 2), ("RADAU", 5)):
        rows = [r for r in of_setting(exact, setting) if r["steps"] and float(r[name]) > 1e-8]
        powers = [
            math.log(float(a[name]) / float(b[name])) / math.log(int(b["steps"]) / int(a["steps"]))
            for a, b in pairwise(rows)
        ]
        assert powers[-1] == pytest.approx(order, abs=0.35), (setting, powers)


def test_the_recommended_cards_do_what_the_table_says(deck: Path, command, program) -> None:
    status, out, _ = command(
        "study", deck, "--error", "1e-4", "--channels", "1.UX", "--runs", "1", "--keep", "kept"
    )
    assert status == 0
    assert "For an error of 1e-4, in the place of the deck's own cards:" in out
    cards = [line for line in out.splitlines() if line.startswith((".SAM", ".SUB"))]
    assert len(cards) == 2 and "PREC 1e-10" in cards[0] and cards[1].startswith(".SUB TF 31.4159265358979")
    # pasted into the deck, after what they replace is gone
    own = OSCILLATOR[: OSCILLATOR.index(".ANALYSE")] + OSCILLATOR[OSCILLATOR.index(".CHK") :]
    Path("pasted.dat").write_text(own + "\n".join(cards) + "\n")
    assert subprocess.run([program, "pasted.dat", "-q"], capture_output=True).returncode == 0
    from engrane_post import Results

    with Results("pasted") as results:
        t, x = results.history("1.UX")
    assert np.abs(x - (1 - np.cos(t))).max() / 2 < 1e-4
    assert len(list(Path("kept").glob("*.h5"))) == len(table()) + 3, "the start and two for the reference"
    assert Path("oscillator_study.png").read_bytes()[:4] == b"\x89PNG"
    assert deck.read_text() == OSCILLATOR


def test_without_checks_all_histories_are_compared(deck: Path, command) -> None:
    status, out, err = command(
        "study", "pendulum", "--schemes", "CHUNG", "NEWMARK", "--steps", "2H:H/2", "-DL=0.4"
    )
    assert (status, err) == (0, "")
    assert "histories that vary" in out
    rows = table("pendulum")
    names = list(rows[0])[list(rows[0]).index("SUB") + 1 :]
    assert "node/1/UX" in names and "element/1/ANGLE" in names
    assert not [n for n in names if n.startswith("run/") or n == "node/1/UY"], "UY stands still"
    assert {r["solver"] for r in rows} == {"MUMPS", "KLU"}
    for row in rows:
        errors = [float(row[n]) for n in names]
        assert float(row["error"]) == max(errors) == float(row[row["worst of"]])
        assert float(row["median"]) == pytest.approx(np.median(errors), rel=0.06)


def test_runs_that_fail_are_told_and_passed_over(deck: Path, command) -> None:
    # Radau refuses a node that is turned about one axis and free about another
    turned = """.NOE
 I 2 X 0 0 0
.MCE
 I 3 INERTIA N 2 M 1 J 1 1 1
.FCT
 I 1 TABLE 0 0 1 0.1
.CLM ADD
 FIX NOEUD 2 C 1 2 3 5
 DEP NOEUD 2 C 6 V 1 NF 1
"""
    Path("pendulum.dat").write_text(PENDULUM + turned)
    status, out, err = command(
        "study", "pendulum", "--runs", "1", "--error", "2e-3", "--schemes", "CHUNG", "RADAU"
    )
    assert status == 0
    assert "note: no reference by RADAU PREC 1e-12, H 0.005: SCHEME RADAU cannot turn node 2" in err
    assert "reference: CHUNG PREC 1e-12, H 0.0003125; its own error is" in out
    rows = table("pendulum")
    bad = of_setting(rows, "RADAU")
    assert len(bad) == 2 and all((r["error"], r["seconds"], r["steps"]) == ("", "", "") for r in bad)
    for row in bad:
        assert "SCHEME RADAU cannot turn node 2" in row["outcome"]
        assert row["outcome"] in out
    good = of_setting(rows, "CHUNG")
    assert all(r["outcome"] == "complete" and float(r["error"]) > 0 for r in good)
    assert re.search(r"\.SAM TYPE DYNAMIC SCHEME CHUNG.*\n\.SUB TF 0\.2 H 0\.0025", out)


def test_a_deck_with_accuracy_runs_as_it_is_and_its_ladders_without(deck: Path, command, program) -> None:
    own = OSCILLATOR.replace("SCHEMA CHUNG $ ! a comment", "EXACTITUDE NORMAL $").replace(" RHO 0.9", "")
    Path("dial.dat").write_text(own)
    words = ("study", "dial", "--solvers", "KLU", "--runs", "1", "--steps", "H:H/4")
    status, out, err = command(*words)
    assert (status, err) == (0, "")
    rows = table("dial")
    done = subprocess.run([program, "dial.dat", "-q", "--json"], capture_output=True, text=True)
    plain = json.loads(done.stdout)["runs"][0]
    assert rows[0]["setting"] == "the deck: ACCURACY NORMAL"
    assert "ACCURACY NORMAL" in rows[0]["SAM"] and "SCHEME" not in rows[0]["SAM"]
    assert [int(rows[0][k]) for k in ("steps", "iterations")] == [plain[k] for k in ("steps", "iterations")]
    # steps are those of the ladders, and their errors fall with the order of the scheme
    assert all("ACCURACY" not in row["SAM"] for row in rows[1:])
    chung = of_setting(rows, "CHUNG TANGENT FULL")
    assert [int(row["steps"]) for row in chung] == [629, 1257, 2514]
    assert [float(row["slope"]) for row in chung[1:]] == pytest.approx([2, 2], abs=0.1)
    assert {row["believed"] for row in chung} == {"yes"}
    # the closed form is the judge of the deck's own error too
    told = float(rows[0]["NODE 1 UX at t = 20"])
    checks = {c["name"]: c["value"] for c in plain["checks"]}
    exact = 1 - math.cos(20)
    assert told == pytest.approx(abs(checks["NODE 1 UX at t = 20"] - exact) / exact, rel=0.06, abs=1e-8)
    cards = [line for line in out.splitlines() if line.startswith((".SAM", ".SUB"))]
    assert len(cards) == 2 and "ACCURACY" not in cards[0]
    assert "in the place of ACCURACY NORMAL" in out
    # pasted, they make the run of the table
    text = own[: own.index(".ANALYSE")] + own[own.index(".CHK") :]
    Path("pasted.dat").write_text(text + "\n".join(cards) + "\n")
    done = subprocess.run([program, "pasted.dat", "-q", "--json"], capture_output=True, text=True)
    pasted = [row for row in rows if [row["SAM"], row["SUB"]] == cards]
    assert int(pasted[0]["steps"]) == json.loads(done.stdout)["runs"][0]["steps"]


@pytest.mark.parametrize("words", [(), ("--channels", "1.UX"), ("--steps", "0.03,0.015")])
def test_histories_of_a_deck_with_accuracy(deck: Path, command, words) -> None:
    """Samples at instants common with the ladders, also where these are none of the deck's own."""
    text = PENDULUM.replace(".SAM TYPE DYNAMIC", ".SAM TYPE DYNAMIC ACCURACY NORMAL")
    Path("dial.dat").write_text(text.replace("TF 0.2", "TF 0.3"))
    status, _, err = command(
        "study", "dial", "--solvers", "AUTO", "--runs", "1", "--schemes", "RADAU", *words
    )
    assert (status, err) == (0, "")
    rows = table("dial")
    assert rows[0]["setting"] == "the deck: ACCURACY NORMAL" and rows[0]["outcome"] == "complete"
    assert 0 <= float(rows[0]["error"]) < 1e-2


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("nodeck",), "There is no deck nodeck"),
        (("bare",), "keeps no histories; name some by --result or"),
        (("static",), "static.dat is STATIC; only a DYNAMIC analysis"),
        (("wrong",), "wrong.dat:1:10: error: `Q` is not a keyword"),
        (("oscillator", "--channels", "1.UQ"), "has no channel 1.UQ. Did you mean node/1/U"),
        (("oscillator", "--result", "NODE 1 UQ"), "node 1 has no output UQ"),
        (("oscillator", "--schemes", "EULER"), "SCHEME has no EULER; it has CHUNG"),
        (("oscillator", "--schemes", "RADAU RHO 0.3"), "RHO belongs to SCHEME CHUNG"),
        (("oscillator", "--solvers", "KLU,LU"), "SOLVER has no LU"),
        (("oscillator", "--steps", "2H,H/0"), "`H/0` is not a step"),
        (("oscillator", "--steps", "H,0.0371113", "--channels", "1.UX"), "no samples at the same instants"),
        (
            ("oscillator", "--reference", "check", "--channels", "1.UX"),
            "--reference check compares the numbers",
        ),
        (("pendulum", "--reference", "check"), "--reference check compares the numbers"),
        (("oscillator", "--error", "2"), "--error 2"),
        (("oscillator", "--runs", "0"), "--runs 0"),
        (("oscillator", "-D", "w=3"), "has no abbreviation `/w`"),
        (("oscillator", "-o", "nowhere/x"), "there is no folder nowhere"),
    ],
)
def test_wrong_commands(deck: Path, command, words, sentence) -> None:
    Path("static.dat").write_text(PENDULUM.replace(".SAM TYPE DYNAMIC", ".SAM TYPE STATIC"))
    Path("bare.dat").write_text(PENDULUM + ".SAI KEEP NONE\n")
    Path("wrong.dat").write_text(".NOE I 1 Q 3\n" + PENDULUM)
    status, _, err = command("study", *words)
    assert status == 1
    assert sentence in err
    assert not list(Path().glob("*.csv"))


def test_stopped_by_a_signal(tmp_path: Path, monkeypatch) -> None:
    """The runs that are finished are in the table."""
    if not Path(os.environ.get("ENGRANE", "")).is_file():
        pytest.skip("the variable ENGRANE names no program")
    monkeypatch.chdir(tmp_path)
    Path("pendulum.dat").write_text(PENDULUM + "NODE 1 VZ V -1 ATOL 100\n")
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    words = ["study", "pendulum.dat", "--reference", "check", "--runs", "1", "--solvers", "KLU"]
    words += ["--schemes", "RADAU", "--steps", "0.01,0.005,1e-8"]
    process = subprocess.Popen(
        [sys.executable, "-m", "engrane_post", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"TMPDIR": str(temporary), "PYTHONPATH": str(POST)},
    )
    until = time.monotonic() + 60
    while time.monotonic() < until and not list(temporary.glob("engrane_runs*/*5.h5")):
        time.sleep(0.1)
    process.send_signal(signal.SIGTERM)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, err) == (143, "engrane study: stopped after 3 of 4 runs\n")
    assert out.endswith("wrote pendulum_study.csv\n")
    rows = table("pendulum")
    assert [bool(r["error"]) for r in rows] == [True, True, True, False]
    assert rows[-1]["outcome"] == "not run"
    assert not list(temporary.iterdir())
