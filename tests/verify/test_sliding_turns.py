# SPDX-License-Identifier: BSD-3-Clause
"""Friction that is regularised below VREG, where sliding turns round: steps that pass over it leave no trace
in the difference between two runs."""

from pathlib import Path

import numpy as np
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
    "deck, setting, owner, told",
    [  # true and stated before: steps passed over the speeds below VREG
        (RUBBED.format(preload=""), "NORMAL", "1", True),  # 3.2e-3, 6.8e-5
        # three samples of a thousand lie below VREG, where 3e-6 of the range of speeds is 7e-3 of friction:
        # 2.5e-4 now, and 2e-5 is stated
        (RUBBED.format(preload="PRELOAD 10"), "NORMAL", "1", False),  # 2.1e-2, 4.2e-4
        (
            WORM.format(friction="FRICTION STRIBECK 0.1 0.04 0.1 VREG 0.01"),
            "FAST",
            "3",
            True,
        ),  # 2.9e-2, 3.4e-3
    ],
)
def test_steps_end_where_sliding_falls_below_its_regularisation(
    deck: str, setting: str, owner: str, told: bool, tmp_path: Path
) -> None:
    found, result = solve_by(deck, f"ACCURACY {setting}", tmp_path)
    folder = tmp_path / "truth"
    folder.mkdir()
    _, truth = solve_by(deck.replace("H ", "TOL 1D-8 H "), "SCHEME RADAU SOLVER KLU", folder)
    error = off(result, truth, f"{owner}/FRICTION_FORCE")
    assert error < 1e-3
    if told:
        assert error < 3 * found["accuracy"]["estimated_error"]


CRANK = """
.NOE
 I 1
 I 2 X 0.1
 I 3 X 0.4
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 HINGE N 1 2 AXIS 0 0 1 AT 0.1 0 0
 I 3 HINGE N 2 3 AXIS 0 0 1 AT 0.4 0 0
 I 4 PRISMATIC N 0 3 AXIS 1 0 0 FRICTION CONST 0.1 VREG 0.01
 I 5 INERTIA N 1 M 1 J 0.02
 I 6 INERTIA N 2 M 0.5 J 0.005
 I 7 INERTIA N 3 M 0.8 J 0.005
 I 8 MOTOR JOINT 1 CURVE 1
.FCT
 I 1 TABLE 0 8 10 9 20 6 30 0 40 -4
.INI
 VIT NOEUD 1 C 6 V 5
.SUB TF 0.6 H 5D-4 TOL 1D-3
"""


@pytest.mark.parametrize("scheme", ["CHUNG", "RADAU"])
def test_results_between_steps_that_grow_behind_events(scheme: str, tmp_path: Path) -> None:
    """Steps double behind each reversal, and a polynomial of degree five through their ends enlarged what
    bends a hundred times: accelerations of 9e5 for 1e2, kinetic energies below zero."""
    _, result = solve_by(CRANK, f"SCHEME {scheme}", tmp_path)
    folder = tmp_path / "truth"
    folder.mkdir()
    _, truth = solve_by(CRANK.replace("TOL 1D-3", "TOL 1D-8"), "SCHEME RADAU", folder)
    for channel in ("6/KINETIC_ENERGY", "4/FRICTION_FORCE", "node/2/AX"):
        span = np.ptp(truth[channel])
        assert result[channel].min() > truth[channel].min() - 0.6 * span
        assert result[channel].max() < truth[channel].max() + 0.6 * span
    assert result["6/KINETIC_ENERGY"].min() >= 0


def test_sliding_that_turns_round_within_a_step_is_met(tmp_path: Path) -> None:
    """At the reversal the acceleration jumps, and no polynomial through the speeds at the ends of the step
    comes below VREG."""
    deck = """
.NOE
 I 1
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 K 1000 SLIDE0 0.1 FRICTION STRIBECK 0.3 0.1 0.02 VREG 0.001
 I 2 INERTIA N 1 M 1 J 0.01
.CLM
 CHA NOEUD 1 C 2 V -10
.SUB TF 1 H 2D-4 TOL {tolerance}
"""
    events = []
    for tolerance in ("1D-3", "1D-5"):
        for scheme in ("CHUNG", "RADAU"):
            folder = tmp_path / f"{scheme}{tolerance}"
            folder.mkdir()
            _, result = solve_by(deck.format(tolerance=tolerance), f"SCHEME {scheme}", folder)
            events.append(result["run/EVENTS"][-1])
            assert result["1/FRICTION_FORCE"].max() < 3  # mu N
    assert events == 4 * [21]  # ten reversals, and the start
