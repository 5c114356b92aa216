# SPDX-License-Identifier: BSD-3-Clause
"""Motions that no tolerance makes certain, for which the dial promises no error; and a vibration that only
looks like one."""

from pathlib import Path

import numpy as np
from runs import solve
from small_decks import DISCS

TRIPLE_PENDULUM = """
.NOE
 I 1 X 0.5 0 0
 I 2 X 1 0.5 0
 I 3 X 1 1.5 0
.MCE
 I 1 RIGID N 1 M 1 J 0.01 0.0833 0.0833
 I 2 RIGID N 2 M 1 J 0.0833 0.01 0.0833
 I 3 RIGID N 3 M 1 J 0.0833 0.01 0.0833
 I 4 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0
 I 5 HINGE N 1 2 AXIS 0 0 1 AT 1 0 0
 I 6 HINGE N 2 3 AXIS 0 0 1 AT 1 1 0
.CLM
 STRU ACC 0 -9.81 0
.SAM TYPE DYNAMIC ACCURACY NORMAL
.SUB TF {end} H 0.05
.FIN 1
"""


def shaken(sam: str, tol: str = "") -> str:
    """A deck of two discs on a stiff shaft: its vibration is fast beside the torque."""
    rest = f"""\
.FCT
 I 1 EXPR "SIN(9*T)"
.SAM TYPE DYNAMIC {sam}
.SUB TF 1 H 0.005{tol}
"""
    return DISCS.format(axis="1 0 0", link="TSPRING N 1 2 AXIS 1 0 0 K 4000", torque="20 NF 1", rest=rest)


def swing(end: float, folder: Path) -> tuple[dict, str]:
    found, _ = solve(TRIPLE_PENDULUM.format(end=end), folder)
    return found, (folder / "deck.lst").read_text(encoding="utf-8")


def test_chaos_is_told(tmp_path: Path) -> None:
    """Four runs had estimated errors of 0.03 to 0.09, and the advice was to take TOL 3e-09."""
    found, listing = swing(15, tmp_path)
    assert "a smaller one will not make this motion certain" in found["said"]
    assert "it does not fall with TOL" in listing and "ACCURACY FINE" not in listing
    assert found["accuracy"]["estimated_error"] > 0.1


def test_the_same_motion_is_certain_for_a_while(tmp_path: Path) -> None:
    found, listing = swing(2, tmp_path)
    assert "certain" not in found["said"] and "ACCURACY FINE" in listing
    assert found["accuracy"]["estimated_error"] < 1e-3


def test_a_vibration_that_runs_begin_to_resolve_is_not_chaos(tmp_path: Path) -> None:
    """The first runs damp it, and the next differ from them more than they did from one another. The third of
    them was the last, 0.012 off, and said that no TOL would help; FINE took TOL 2e-8 and was right."""
    found, result = solve(shaken("ACCURACY NORMAL"), tmp_path)
    assert "certain" not in found["said"]
    (tmp_path / "truth").mkdir()
    _, truth = solve(shaken("SCHEME RADAU", " TOL 1D-9"), tmp_path / "truth")
    speed = truth["5/SPEED"]
    off = float(np.sqrt(np.mean((result["5/SPEED"] - speed) ** 2)) / np.ptp(speed))
    assert off < 1e-3
    assert off < found["accuracy"]["estimated_error"] < 20 * off  # with the order of three runs
