# SPDX-License-Identifier: BSD-3-Clause
"""A motion that no tolerance makes certain: the dial says so, and does not promise an error."""

from pathlib import Path

from runs import solve

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
