# SPDX-License-Identifier: BSD-3-Clause
"""Starts at which nodes are turned by a wish that joints keep, or by a static load: rates and accelerations
are those of the place, whatever turn led there."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import run

UNIVERSAL = """
.NOE
 I 1
.MCE
 I 1 UNIVERSAL N 0 1 AXIS 1 0 0 AXIS2 0 1 0 {joint}
 I 2 INERTIA N 1 M 1 J 0.01 0.02 0.015
 {load}
.FCT
 I 1 EXPR "5*T"
.INI
 {initial}
.SAM TYPE {kind}
.SUB TF 0.01 H 1E-3
.FIN
"""
COS, SIN = np.cos(np.radians(40)), np.sin(np.radians(40))


def test_a_joint_that_a_torque_has_turned(tmp_path: Path) -> None:
    """By 40 degrees; then the second pin is driven at 5 rad/s: 2.55 and 4.42 rad/s were found, and a moment
    that grew from step to step."""
    words = {"joint": "K1 2 DRIVE2 ANGLE NF2 1", "load": "I 3 TORQUE N 1 AXIS 1 0 0 V (2*40*PI/180)"}
    result = run(UNIVERSAL.format(**words, initial="", kind="DYNAMIC RHO 0.9 START STATIC"), tmp_path)
    assert result["node/1/WY"] == pytest.approx(np.full(11, 5 * COS), rel=1e-6)
    assert result["node/1/WZ"] == pytest.approx(np.full(11, 5 * SIN), rel=1e-6)
    assert result["run/KINETIC_ENERGY"] == pytest.approx(np.full(11, 0.25), rel=1e-6)
    assert np.abs(result["1/MOMENT_Z"]).max() < 1e-9


@pytest.mark.parametrize("kind", ["DYNAMIC RHO 0.9", "DYNAMIC SCHEME RADAU", "KINEMATIC"])
def test_a_joint_that_a_wish_has_turned(kind: str, tmp_path: Path) -> None:
    """Both pins turn; the moment across them, once 0.287, swung by 324."""
    joint = "DRIVE1 ANGLE NF1 2 DRIVE2 ANGLE NF2 1" if kind == "KINEMATIC" else ""
    initial = (
        "DEP NOEUD 1 C 4 V 40\n VIT ELEMENT 1 COORDINATE ANGLE_1 V 3\n VIT ELEMENT 1 COORDINATE ANGLE_2 V 5"
    )
    deck = UNIVERSAL.format(joint=joint, load="", initial=initial, kind=kind)
    deck = deck.replace('"5*T"', '"5*T"\n I 2 EXPR "40*PI/180+3*T"')
    result = run(deck, tmp_path)
    assert result["node/1/WY"][0] == pytest.approx(5 * COS, rel=1e-9)
    assert result["node/1/WZ"][0] == pytest.approx(5 * SIN, rel=1e-9)
    moment = result["1/MOMENT_Z"]
    assert np.abs(np.diff(moment)).max() < 5e-3 * np.abs(moment[0])


def test_wishes_of_nodes_and_of_joints_give_the_same_start(tmp_path: Path) -> None:
    """Three hinges, the second turned by 30 degrees."""
    deck = """
.NOE
 I 1
 I 2
 I 3
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 HINGE N 1 2 AXIS 1 0 0
 I 3 HINGE N 2 3 AXIS 0 0 1
 I 4 INERTIA N 1 M 1 J 0.01 0.02 0.015
 I 5 INERTIA N 2 M 1 J 0.01 0.02 0.015
 I 6 INERTIA N 3 M 1 J 0.01 0.01 0.015
.INI
 {wish}
 VIT ELEMENT 3 V 50
 VIT ELEMENT 1 V 2
 VIT ELEMENT 2 V 1
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF 0.01 H 1E-3
.FIN
"""
    runs = [
        run(deck.format(wish=wish), tmp_path, name=name)
        for wish, name in (("DEP NOEUD 2 3 C 4 V 30", "nodes"), ("DEP ELEMENT 2 V 30", "joint"))
    ]
    for result in runs:
        assert result["node/3/WY"][0] == pytest.approx(-25)
        energy = result["run/KINETIC_ENERGY"]
        assert np.ptp(energy) < 1e-6 * energy[0]
    for channel in ("node/3/EY", "node/1/EZ", "1/SPEED", "2/MOMENT_Y"):
        a, b = (r[channel] for r in runs)
        assert a == pytest.approx(b, rel=1e-6, abs=1e-6 * max(np.abs(b).max(), 1))
