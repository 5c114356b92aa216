# SPDX-License-Identifier: BSD-3-Clause
"""What a run says of a belt that is pulled harder than it can hold, and of results that are never judged."""

import json

import pytest
from small_decks import DISCS

ELASTIC = "K 20000 C 20 PRELOAD 100 MU 0.3"
RIGID = "PRELOAD 100 MU 0.3"


def deck(belt, torque, analysis, check=""):
    link = f"BELT N 1 2 AXIS 0 0 1 R 0.05 0.1 {belt}"
    rest = f".SAM TYPE {analysis}\n.SUB TF 0.5 H 0.005\n{check}"
    return DISCS.format(axis="0 0 1", link=link, torque=torque, rest=rest)


def run(engrane, belt, torque=20, sam="RHO 0.9", check=""):
    """Warnings of a run, and its listing."""
    (engrane.folder / "belt.dat").write_text(deck(belt, torque, f"DYNAMIC {sam}", check))
    done = engrane("belt.dat", "--json")
    summary = json.loads(done.stdout)["runs"][0]
    return [d["message"] for d in summary["diagnostics"]], (engrane.folder / "belt.lst").read_text()


@pytest.mark.parametrize(
    ("belt", "torque", "said"),
    [
        (ELASTIC, 20, ["GRIP_USED passed 1"]),
        (ELASTIC, 2, []),
        (RIGID, 22, ["GRIP_USED passed 1", "SLACK_SIDE fell below 0"]),
        (RIGID, 2, []),
        # J1 + J2/4 = 0.04: 20 N m turn wheel 2 by 10 N m, which pull by 200 N; MU holds 83
        (RIGID + " STICK", 20, []),
        ("PRELOAD 90", 20, ["SLACK_SIDE fell below 0 at t = 0 and was -10 at least"]),
        ("", 20, []),
    ],
)
def test_a_belt_pulled_beyond_what_it_holds(engrane, belt, torque, said):
    warnings, listing = run(engrane, belt, torque)
    assert len(warnings) == len(said), warnings
    for text in said:
        assert any("BELT 5: " + text in warning for warning in warnings), warnings
        assert "BELT 5: " + text[:20] in " ".join(listing.split())


def test_static_holds_with_stick(engrane):
    text = deck(RIGID + " STICK", 20, "STATIC")
    text = text.replace("I 2 HINGE", "I 7 TSPRING N 0 2 AXIS 0 0 1 K 200\n I 2 HINGE")
    (engrane.folder / "still.dat").write_text(text)
    assert "STICK holds in STATIC and KINEMATIC" in engrane("still.dat").stderr


def test_results_that_are_never_judged_are_named(engrane):
    grip = " ELEMENT 5 GRIP_USED MAX V 1.7 RTOL 1\n"
    never = "element/5/GRIP_USED is never judged"
    warnings, listing = run(engrane, ELASTIC, sam="ACCURACY NORMAL", check=".CHK\n" + grip)
    assert any(never in w and "ask for a motion or a force beside" in w for w in warnings), warnings
    assert "nothing that is asked for changes" not in listing
    still = " NODE 1 UX V 0 ATOL 1\n"
    warnings, _ = run(engrane, ELASTIC, sam="ACCURACY NORMAL", check=".CHK\n" + grip + still)
    assert any(never in w and "nothing else that is asked for changes" in w for w in warnings), warnings
    energy = " RUN ENERGY_ERROR V 0 ATOL 1\n NODE 1 UX V 0 ATOL 1\n"
    warnings, _ = run(engrane, ELASTIC, sam="ACCURACY NORMAL", check=".CHK\n" + energy)
    assert any("run/ENERGY_ERROR is never judged" in w for w in warnings), warnings
    tension = " ELEMENT 5 TIGHT_SIDE MAX V 300 RTOL 1\n"
    warnings, listing = run(engrane, ELASTIC, sam="ACCURACY NORMAL", check=".CHK\n" + grip + tension)
    assert not any("not estimated" in w for w in warnings), warnings
    assert "element/5/TIGHT_SIDE" in listing
