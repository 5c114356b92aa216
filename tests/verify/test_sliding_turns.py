# SPDX-License-Identifier: BSD-3-Clause
"""Friction that is regularised below VREG, where sliding turns round: steps that pass over it leave no trace
in the difference between two runs."""

from pathlib import Path

import pytest
from test_stated_errors import off, solve_by

# a slider on its guide, and a worm, whose sliding turns round again and again
RUBBED = """
.NOE
 I 1
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 FRICTION CONST 0.2 VREG 0.01 {preload} K 200
 I 2 INERTIA N 1 M 1 J 1E-2
 I 3 FORCE N 1 DIR 1 0 0 V 1 NF 2
 I 4 FORCE N 1 DIR 0 1 0 V 1 NF 3
.INI
 VIT NOEUD 1 C 1 V 0.2
.FCT
 I 2 EXPR "30*SIN(17*T)"
 I 3 EXPR "20*SIN(40*T)+5"
.SUB TF 1 H 1E-3
"""
WORM = """
.NOE
 I 1
 I 2
.MCE
 I 3 GEAR N 1 2 KIND WORM STARTS 2 Z 30 MX 0.004 Q 10 AXIS 1 0 0 PLACE 0 1 0 {friction}
 I 1 HINGE N 0 1 AXIS 1 0 0
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 4 INERTIA N 1 J 1E-4
 I 5 INERTIA N 2 J 1E-2
 I 6 TORQUE N 2 AXIS 0 0 1 V 1 NF 2
 I 7 TORQUE N 1 AXIS 1 0 0 V 1 NF 3
.INI
 VIT NOEUD 1 C 4 V 50
.FCT
 I 2 EXPR "20*COS(100*T)+5"
 I 3 EXPR "0.5*SIN(60*T)"
.SUB TF 0.2 H 2E-4
"""


@pytest.mark.parametrize(
    "deck, setting, owner",
    [  # true and stated before: steps passed over the speeds below VREG
        (RUBBED.format(preload=""), "NORMAL", "1"),  # 3.2e-3, 6.8e-5
        (RUBBED.format(preload="PRELOAD 10"), "NORMAL", "1"),  # 2.1e-2, 4.2e-4
        (WORM.format(friction="FRICTION STRIBECK 0.1 0.04 0.1 VREG 0.01"), "FAST", "3"),  # 2.9e-2, 3.4e-3
    ],
)
def test_steps_end_where_sliding_falls_below_its_regularisation(
    deck: str, setting: str, owner: str, tmp_path: Path
) -> None:
    found, result = solve_by(deck, f"ACCURACY {setting}", tmp_path)
    folder = tmp_path / "truth"
    folder.mkdir()
    _, truth = solve_by(deck.replace("H ", "TOL 1D-8 H "), "SCHEME RADAU SOLVER KLU", folder)
    error = off(result, truth, f"{owner}/FRICTION_FORCE")
    assert error < 1e-3
    assert error < 3 * found["accuracy"]["estimated_error"]
