# SPDX-License-Identifier: BSD-3-Clause
"""Statics that starts in the play of teeth, springs and belts, or crosses it, against closed form."""

from __future__ import annotations

from math import atan, cos, radians
from pathlib import Path

import numpy as np
import pytest
from runs import run

TEETH = """.NOE
 I 1
 I 2
.MCE
 I 1 GEAR N 1 2 KIND {kind} KM 1E5 JEU .1 {law}
 I 2 HINGE N 0 1 AXIS {axis} DRIVE ANGLE NF 1
 I 3 HINGE N 0 2 AXIS 0 0 1
 I 4 TORQUE N 2 AXIS 0 0 1 V 1000 NF 2
.FCT
 I 1 TABLE 0 0 1 .3
 I 2 TABLE 0 0 1 -1
"""
END = ".SAM TYPE STATIC\n.SUB TF 1 H 0.25\n.FIN 1\n"
ALPHA, BETA, LEAD = radians(20), radians(20), atan(0.2)
SPUR, HELICAL, WORM = (
    ("SPUR Z 20 40 MN 2 AXIS 0 0 1 PLACE 1 0 0", "0 0 1", 1000 / 40 / cos(ALPHA)),
    (
        "HELICAL Z 20 30 MN 2 HELIX 20 AXIS 0 0 1 PLACE 1 0 0",
        "0 0 1",
        1000 * cos(BETA) / 30 / cos(ALPHA) / cos(BETA),
    ),
    ("WORM STARTS 2 Z 30 MX 4 Q 10 AXIS 1 0 0 PLACE 0 1 0", "1 0 0", 1000 / 60 / cos(ALPHA) / cos(LEAD)),
)


@pytest.mark.parametrize(
    ("pair", "law"),
    [
        (SPUR, "STIFF FOURIER .1 0"),
        (HELICAL, "STIFF FOURIER .1 .05"),
        (HELICAL, "TIPRELA .01 1"),
        (WORM, "ERR COS .003"),
        (SPUR, "SMOOTH .01"),
        (HELICAL, "SMOOTH .0001"),
    ],
)
def test_teeth_from_rest(pair: tuple[str, str, float], law: str, tmp_path: Path) -> None:
    """A load that grows from 0 where the flanks just touch: what varies along a turn varies a force of 0."""
    kind, axis, force = pair
    result = run(TEETH.format(kind=kind, axis=axis, law=law) + END, tmp_path)
    assert result["1/NORMAL_FORCE"] == pytest.approx(-force * result.t, rel=1e-7, abs=1e-7 * force)


# a play of 0.03 on both sides; 1e4 behind it
LAW = " I 10 TABLE -1.03 -10000 -0.03 0 0.03 0 1.03 10000\n"
SLACK = " I 10 TABLE 0 0 1 10000\n"
SPRING = (
    ".NOE\n I 1\n I 2 X 1\n.MCE\n I 1 SPRING N 1 2 LAW TABLE 10\n I 2 FORCE N 2 DIR 1 0 0 V 100 NF 1\n"
    ".CLM\n FIX NOEUD 1 C 1 2 3\n FIX NOEUD 2 C 2 3\n"
)
TURNED = ".NOE\n I 1\n.MCE\n I 1 HINGE N 0 1 AXIS 0 0 1 {}\n I 2 TORQUE N 1 AXIS 0 0 1 V 100 NF 1\n"
CHANNELS = {
    "SPRING": (SPRING, "1/ELONGATION"),
    "TSPRING": (TURNED.format("\n I 3 TSPRING N 0 1 AXIS 0 0 1 LAW TABLE 10"), "3/ANGLE"),
    "HINGE": (TURNED.format("LAW TABLE 10"), "1/ANGLE"),
}


@pytest.mark.parametrize("kind", CHANNELS)
@pytest.mark.parametrize(
    "load", ["TABLE 0 0 .25 1 1 -1", "TABLE 0 1 1 -1", "TABLE 0 -1 1 -1", 'EXPR "1-2*T"']
)
def test_law_with_play(kind: str, load: str, tmp_path: Path) -> None:
    """Nothing else resists, whether the load acts from the start, grows from 0 or changes its sign."""
    deck, channel = CHANNELS[kind]
    result = run(f"{deck}.FCT\n I 1 {load}\n{LAW}{END}", tmp_path)
    part = {
        "TABLE 0 0 .25 1 1 -1": np.interp(result.t, [0, 0.25, 1], [0, 1, -1]),
        "TABLE 0 1 1 -1": 1 - 2 * result.t,
        "TABLE 0 -1 1 -1": -np.ones_like(result.t),
        'EXPR "1-2*T"': 1 - 2 * result.t,
    }[load]
    loaded = np.abs(part) > 1e-9
    expected = part * 0.01 + np.sign(part) * 0.03
    assert result[channel][loaded] == pytest.approx(expected[loaded], rel=1e-8)
    assert np.all(np.abs(result[channel][~loaded]) <= 0.03 + 1e-9)


@pytest.mark.parametrize("kind", CHANNELS)
def test_law_with_a_slack_side(kind: str, tmp_path: Path) -> None:
    deck, channel = CHANNELS[kind]
    result = run(f"{deck}.FCT\n I 1 TABLE 0 0 1 1\n{SLACK}{END}", tmp_path)
    assert result[channel] == pytest.approx(0.01 * result.t, rel=1e-8, abs=1e-12)


@pytest.mark.parametrize("load", ["1 1 -1", "-1 1 1", "0 1 1"])
def test_belt_without_preload(load: str, tmp_path: Path) -> None:
    """One span carries the torque, the other is slack."""
    deck = (
        ".NOE\n I 1\n I 2 X 0.5\n.MCE\n I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 2\n"
        " I 2 HINGE N 0 2 AXIS 0 0 1\n I 3 BELT N 1 2 AXIS 0 0 1 R 0.1 0.05 K 1E5\n"
        f' I 4 TORQUE N 2 AXIS 0 0 1 V 50 NF 1\n.FCT\n I 1 TABLE 0 {load}\n I 2 EXPR "0"\n'
    )
    result = run(deck + END, tmp_path)
    first, _, last = map(float, load.split())
    torque = 50 * (first + (last - first) * result.t)
    assert result["3/TIGHT_SIDE"] == pytest.approx(np.abs(torque) / 0.05, rel=1e-8, abs=1e-6)
    assert result["3/SLACK_SIDE"] == pytest.approx(0, abs=1e-6)


# play in the teeth and in the spring that holds them, both at rest where they just touch
TWO_PLAYS = """
.NOE
 I 1
 I 2 X 60
.MCE
 I 1 GEAR N 1 2 AXIS 0 0 1 Z 20 40 MN 2 KM 1.5E5 JEU 0.05
 I 2 HINGE N 0 1 AXIS 0 0 1 LAW TABLE 3
 I 3 HINGE N 0 2 AXIS 0 0 1
 I 4 TORQUE N 2 AXIS 0 0 1 V 60000 NF 2
.FCT
 I 2 TABLE {load}
 I 3 TABLE -2 -40000 -0.05 0 0.05 0 2 40000
.SAM TYPE STATIC
.SUB TF 1 H 0.05
.FIN
"""


@pytest.mark.parametrize("load", ["0 0 1 1", "0 0 0.07 0 1 1", "0 0.001 1 1"])
def test_two_plays_in_series_take_a_load_that_grows_from_zero(load: str, tmp_path: Path) -> None:
    """Nothing resists before the load begins, and nothing needs to. 30000 turn A by 0.05 + 1.95 · 3/4."""
    found = run(TWO_PLAYS.format(load=load), tmp_path)
    assert found["2/ANGLE"][-1] == pytest.approx(-(0.05 + 1.95 * 0.75), rel=1e-9)


def test_a_belt_and_a_spring_with_play_take_a_load_that_grows_from_zero(tmp_path: Path) -> None:
    """The bearings balance the preload of the belt, whose slack side goes slack: it gives by 0.065.
    Wheel B turns by 0.05 + 160/200 · 1.95."""
    found = run(
        """
.NOE
 I 1
 I 2 X 0.5
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 3 HINGE N 0 2 AXIS 0 0 1 LAW TABLE 3
 I 7 BELT N 1 2 AXIS 0 0 1 R 0.05 0.1 K 20000 PRELOAD 300
 I 8 TORQUE N 1 AXIS 0 0 1 V 80 NF 1
.FCT
 I 1 RAMP 0 0 1 1
 I 3 TABLE -2 -300 -0.05 0 0.05 0 2 200
.SAM TYPE STATIC
.SUB TF 1 H 0.1
.FIN
""",
        tmp_path,
    )
    assert found["3/ANGLE"][-1] == pytest.approx(1.61, rel=1e-9)
    assert found["1/ANGLE"][-1] == pytest.approx((0.065 + 0.1 * 1.61) / 0.05, rel=1e-9)
