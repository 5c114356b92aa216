# SPDX-License-Identifier: BSD-3-Clause
"""Machines with friction that nothing loads, or that it holds at rest."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import run, said

PAIRS = {
    "spur": "KIND SPUR Z 20 40 MN 2E-3 AXIS 0 0 1 PLACE 1 0 0 FRICTION CONST 0.06 SLIDING PROFILE",
    "spur vreg": "KIND SPUR Z 20 40 MN 2E-3 AXIS 0 0 1 PLACE 1 0 0 "
    "FRICTION CONST 0.06 SLIDING PROFILE VREG 1E-3",
    "worm": "KIND WORM STARTS 2 Z 40 MN 2E-3 LAMBDA 8 AXIS 0 0 1 AXISB 1 0 0 PLACE 0 1 0 FRICTION CONST 0.05",
}
RATIO = {"spur": 2, "spur vreg": 2, "worm": 20}


def pair(name: str, analysis: str, load: str, more: str = "", worm_axis: str = "1 0 0") -> str:
    second = worm_axis if name == "worm" else "0 0 1"
    return f""".UNIT SI
.NOE
 I 1
 I 2
.MCE
 I 1 GEAR N 1 2 {PAIRS[name]}
 I 11 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 12 HINGE N 0 2 AXIS {second}
 I 41 TORQUE N 2 AXIS {second} V 10 NF 2
{more}
.FCT
 I 1 EXPR "10"
 I 2 EXPR "{load}"
.SAM TYPE {analysis}
.SUB TF 1 H 0.01
"""


@pytest.mark.parametrize("analysis", ["KINEMATIC", "DYNAMIC"])
@pytest.mark.parametrize("load", ["0", "if(T < 0.5, 1, 0)"])
@pytest.mark.parametrize("name", list(PAIRS))
def test_no_load(name: str, load: str, analysis: str, tmp_path: Path) -> None:
    """Without masses all forces are zero, and rounding makes no jam of them."""
    found = run(pair(name, analysis, load), tmp_path)
    assert found.t[-1] == 1
    assert abs(found["12/SPEED"][-1]) == pytest.approx(10 / RATIO[name], rel=1e-6)
    rounding = 1e-20 if load == "0" else 1e-12  # of what was there before
    assert abs(found["1/NORMAL_FORCE"][-1]) < rounding
    assert abs(found["11/DRIVE_TORQUE"][-1]) < rounding


@pytest.mark.parametrize("solver", ["MUMPS", "KLU"])
def test_hinge_without_load(solver: str, tmp_path: Path) -> None:
    deck = f""".UNIT SI
.NOE
 I 1
.MCE
 I 11 HINGE N 0 1 AXIS 0 0 1 FRICTION CONST 0.1 RADIUS 0.01 THRUST 0.01 DRIVE SPEED NF 1
.FCT
 I 1 EXPR "10"
.SAM TYPE KINEMATIC SOLVER {solver}
.SUB TF 1 H 0.01
"""
    found = run(deck, tmp_path)
    assert found["11/ANGLE"][-1] == pytest.approx(10)
    assert abs(found["11/DRIVE_TORQUE"]).max() < 1e-20


@pytest.mark.parametrize("analysis", ["", "SCHEME RADAU"])
def test_held_by_friction(analysis: str, tmp_path: Path) -> None:
    """A worm that its wheel cannot drive stands still under a load: no rounding is warned of."""
    deck = f""".UNIT SI
.NOE
 I 1
 I 2
.MCE
 I 1 GEAR N 1 2 KIND WORM STARTS 2 Z 40 MN 2E-3 LAMBDA 8 AXIS 1 0 0 AXISB 0 0 1 PLACE 0 1 0 FRICTION CONST 0.2
 I 11 HINGE N 0 1 AXIS 1 0 0
 I 12 HINGE N 0 2 AXIS 0 0 1
 I 31 INERTIA N 1 M 1 J 1E-5
 I 32 INERTIA N 2 M 1 J 1E-4
 I 41 TORQUE N 2 AXIS 0 0 1 V 20
.SAM TYPE DYNAMIC {analysis}
.SUB TF 1 H 0.01
"""
    assert "warning" not in said(deck, tmp_path)
    found = run(deck, tmp_path)
    assert abs(found["12/ANGLE"]).max() < 1e-9
    assert found["1/NORMAL_FORCE"][-1] > 400


def test_nodes_on_one_axis(tmp_path: Path) -> None:
    """All but the planet stand on the axis: rounding of them is no scale for its distance."""
    deck = """.NOE
 I 1
 I 2
 I 5
 I 6
.MCE
 I 1 GEAR N 1 2 KIND SPUR Z 24 18 MN 2 AXIS 0 0 1 PLACE 1 0 0
 I 2 GEAR N 2 5 KIND INTERNAL Z 18 60 MN 2 AXIS 0 0 1 PLACE 1 0 0 WIDTH 20
 I 11 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 12 HINGE N 6 2 AXIS 0 0 1 AT 42 0 0
 I 13 HINGE N 0 6 AXIS 0 0 1
 I 14 WELD N 0 5
.FCT
 I 1 EXPR "1"
.SAM TYPE KINEMATIC
.SUB TF 1 H 0.1
"""
    assert "away from the others" not in said(deck, tmp_path)


@pytest.mark.parametrize("trial", range(6))
def test_flanks_at_the_pitch_point_in_any_direction(trial: int, tmp_path: Path) -> None:
    """There spur flanks do not slide, and the square of their sliding speed is rounding: below zero it made
    the matrix "not finite" in 9 of 12 directions in space."""
    random = np.random.default_rng(trial)
    axes, _ = np.linalg.qr(random.normal(size=(3, 3)))
    axis, place = ("{} {} {}".format(*axes[:, i]) for i in (0, 1))
    deck = f""".NOE
 I 1
 I 2
.MCE
 I 1 GEAR N 1 2 AXIS {axis} KIND SPUR Z 20 33 MN 2 PLACE {place} KM 1E5 CM 1 FRICTION CONST 0.1 VREG 1
 I 2 HINGE N 0 1 AXIS {axis}
 I 3 HINGE N 0 2 AXIS {axis} C 30
 I 6 INERTIA N 1 J 0.2
 I 7 INERTIA N 2 J 0.2
 I 10 TORQUE N 1 AXIS {axis} V 20000
.SAM TYPE DYNAMIC
.SUB TF 0.0002 H 2E-5
"""
    assert run(deck, tmp_path)["2/ANGLE"][-1] > 0
