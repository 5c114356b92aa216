# SPDX-License-Identifier: BSD-3-Clause
"""Errors that `.SAM ACCURACY` states, against the truth: motion sampled at a multiple of its period,
friction whose load passes zero, a beam whose axial vibration follows its bending, belts that go slack,
cams and measured motions whose accelerations are not smooth, errors and stiffness of teeth with corners,
sizes of vectors that pass zero, nodes that turn about an oblique axis, loads that a joint does not carry."""

import functools
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from runs import Run, solve
from test_known_between import BELT

# two bodies on a guide, the first one driven with 50 Hz, a multiple of the rate of the samples
DRIVEN = """
.NOE
 I 1 X 1 0 0
 I 2 X 2 0 0
.MCE
 I 1 INERTIA N 1 M 1
 I 4 INERTIA N 2 M 1
 I 2 PRISMATIC N 0 1 AXIS 1 0 0 DRIVE SLIDE NF 1
 I 5 PRISMATIC N 0 2 AXIS 1 0 0
 I 3 SPRING N 1 2 K 1000 C 100
.FCT
 I 1 SINUS 0.001 50 0 0
.SUB TF 1 H 0.02
"""

# a free vibration of 50 Hz
FREE = """
.NOE
 I 1 X 1 0 0
.MCE
 I 1 INERTIA N 1 M 1
 I 2 PRISMATIC N 0 1 AXIS 1 0 0 K (10000*PI*PI)
.INI
 VIT NOEUD 1 C 1 V 1
.SUB TF 2 H 0.02
"""

# the force across the guide passes zero while the body slides
PRESSED = """
.NOE
 I 1 X 0 0 0
.MCE
 I 1 INERTIA N 1 M 1
 I 2 PRISMATIC N 0 1 AXIS 1 0 0 K 100 FRICTION CONST 0.2 {friction}
 I 3 FORCE N 1 DIR 0 0 1 V 50 NF 1
 I 4 FORCE N 1 DIR 1 0 0 V 30 NF 2
.FCT
 I 1 SINUS 1 1.3
 I 2 SINUS 1 0.7
.SUB TF 5 H 0.01
"""

BEAM = """
.NOE
 I 1 X 0 0 0
 I 2 X 0.25 0 0
 I 3 X 0.5 0 0
 I 4 X 0.75 0 0
 I 5 X 1 0 0
.BPR
 I 1 CIRCLE 0.02
.MAT
 I 1 YT 2.1D11 NT 0.3 M 7850
.MCE
 I 1 BEAM N 1 2 3 4 5 BPR 1 MAT 1 DAMPING 1E-4
 I 9 FORCE N 5 DIR 0 1 0 V 100 NF 1
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
.FCT
 I 1 TABLE 0 0 0.02 1 0.1 1 0.12 0 1 0
.SUB TF 0.4 H 0.002
"""


# a follower that is held to its cam, at 20 rad/s
CAM = """
.NOE
 I 1 X 0 0 0
 I 2 X 0 0.04 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 PRISMATIC N 0 2 AXIS 0 1 0
 I 3 CAM N 1 2 AXIS 0 0 1 BASE 0.03 MOTION 90 0.01 60 0.01 90 0 120 0 LAW {law} $
    FOLLOWER ROLLER 0.01 DIRECTION 0 1 0
 I 4 INERTIA N 2 M 0.5
 I 6 SPRING N 0 2 K 5000 L0 0.01
.FCT
 I 1 EXPR "20*T"
.SUB TF 0.7 H 0.005
"""


# an arm whose angle is a measured motion, with a second one on a spring
SPLINE = """
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
 I 3 X 1.6 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 RIGID N 1 2 M 1 J 0.1 CG 0.5 0 0
 I 3 HINGE N 2 3 AXIS 0 0 1 AT 1 0 0 K 40 C 0.5
 I 4 INERTIA N 3 M 1 J 0.05 0.05 0.05
.FCT
 I 1 TABLE 0 0 0.1 0.05 0.25 0.4 0.3 0.5 0.45 0.9 0.6 0.7 0.7 0.2 0.85 -0.3 1 -0.2 1.2 0.1 SPLINE
.CLM
 STRU ACC VAL 0 -9.81 0
.SUB TF 1.2 H 0.01
"""

# a hinge turns to and fro; a sensor watches
SENSOR = """
.NOE
 I 1 X 0 0 0
.MCE
 I 2 HINGE N 0 1 AXIS 0 0 1
 I 4 INERTIA N 1 M 1 J .1
 I 5 SENSOR N 1 ANGLE AXIS 0 0 1
 I 6 TORQUE N 1 AXIS 0 0 1 V 10 NF 1
.FCT
 I 1 EXPR "cos(7*T)"
.SUB TF 3 H .01
"""

# a joint of constant velocity bends to and fro
BENDS = """
.NOE
 I 1 X 0 0 0
 I 2 X 0 0 0
 I 3 X 0 0 0
.MCE
 I 1 CONSTANT_VELOCITY N 1 2 AXIS 1 0 0
 I 3 HINGE N 0 1 AXIS 1 0 0 DRIVE SPEED NF 2
 I 2 INERTIA N 2 M 1 J .1
 I 5 HINGE N 0 3 AXIS 0 0 1 K 5
 I 6 HINGE N 3 2 AXIS 1 0 0
 I 4 TORQUE N 3 AXIS 0 0 1 V 4 NF 1
 I 7 INERTIA N 3 M 1 J .1
.FCT
 I 1 EXPR "cos(9*T)"
 I 2 TABLE 0 0 1 0
.SUB TF 2 H .01
"""

# a cam swings below a face that rests on its base circle
SWINGS = """
.NOE
 I 1 X 0 0 0
 I 2 X 0 .03 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 K 20
 I 2 PRISMATIC N 0 2 AXIS 0 1 0 K 200 SLIDE0 -.1
 I 3 INERTIA N 1 M 1 J .01
 I 4 INERTIA N 2 M .3 J .01
 I 5 CAM N 1 2 AXIS 0 0 1 BASE .03 PHASE 60 MOTION 90 0.01 60 0.01 90 0 120 0 LAW CYCLOIDAL $
    FOLLOWER FLAT DIRECTION 0 1 0
.INI
 VIT ELEMENT 1 V 15
.SUB TF 1 H .005
"""

# a disc at a mean speed of 5 turns a second under an alternating torque
DISC = """
.NOE
 I 1 X 0 0 0
.MCE
 I 1 HINGE N 0 1 AXIS {axis}
 I 3 INERTIA N 1 M 1 J .1
 I 6 TORQUE N 1 AXIS {axis} V 10 NF 1
.FCT
 I 1 EXPR "cos(20*PI*T)"
.INI
 VIT ELEMENT 1 V (10*PI)
.SUB TF 2 H 0.05
"""

# a pair under a constant load; a rack whose load swings
PAIR = """
.NOE
 I 1
 I 2 X 0.06
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 AXIS 0 0 1 Z 20 40 MN 0.002 WIDTH 0.02 KM 1E8 {teeth}
 I 4 TORQUE N 2 AXIS 0 0 1 V 20
 I 5 INERTIA N 2 J 1E-3
 I 6 INERTIA N 1 J 1E-4
 I 7 TORQUE N 1 AXIS 0 0 1 V 10
.INI
 VIT NOEUD 1 C 6 V 100
 VIT NOEUD 2 C 6 V -50
.FCT
 I 5 TABLE {table}
.SUB TF 0.01 H 1E-5
"""
RACK = """
.NOE
 I 1
 I 2 Y -0.02
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 PRISMATIC N 0 2 AXIS 1 0 0
 I 3 RACK N 1 2 AXIS 0 0 1 DIR 1 0 0 Z 20 MN 0.002 WIDTH 0.02 KM 1E8 {teeth}
 I 4 INERTIA N 1 J 1E-4
 I 5 INERTIA N 2 M 1
 I 6 FORCE N 2 DIR 1 0 0 V 1 NF 2
.INI
 VIT NOEUD 1 C 6 V 5
 VIT NOEUD 2 C 1 V 0.1
.FCT
 I 2 EXPR "300*COS(800*T)+100"
 I 5 TABLE {table}
.SUB TF 0.02 H 2E-5
"""
ERROR = "0 0 6 5E-6 12 0 18 0 PERIOD 18"
CUMULATIVE = "0 0 18 2E-6 36 -1E-6 54 3E-6 72 5E-6 90 2E-6 108 0 126 -3E-6 144 1E-6 162 2E-6 PERIOD 180"

# a spring presses the follower on a profile through eight points
POLAR = """
.NOE
 I 1
 I 2 Y 0.04
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 2 PRISMATIC N 0 2 AXIS 0 1 0 K {spring} SLIDE0 -0.1 C 5
 I 3 CAM N 1 2 AXIS 0 0 1 ZERO 0 1 0 FOLLOWER {follower} DIRECTION 0 1 0 $
    POLAR 0 0.04 45 0.038 90 0.034 135 0.031 180 0.03 225 0.031 270 0.034 315 0.038
 I 5 INERTIA N 2 M 0.5 J 1E-3
.FCT
 I 1 EXPR "{speed}"
.SUB TF {time} H 1E-4
"""


def solve_by(deck: str, sam: str, folder: Path) -> tuple[dict, Run]:
    return solve(f"{deck}.SAM TYPE DYNAMIC {sam}\n.FIN\n", folder)


@pytest.fixture(scope="module")
def truth_of(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Run]:
    """A sharp run of a deck, made once."""

    @functools.cache
    def truth(deck: str, tolerance: str = "1D-9") -> Run:
        sharp = "\n".join(f"{n} TOL {tolerance}" if n.startswith(".SUB") else n for n in deck.splitlines())
        return solve_by(sharp + "\n", "SCHEME RADAU", tmp_path_factory.mktemp("truth"))[1]

    return truth


def expect_honest(
    found: dict, result: Run, truth: Run, channels: tuple[str, ...], least: float = 1 / 3
) -> None:
    """At least a third of the largest error of the channels is stated, and at most ten times it."""
    true = max(off(result, truth, c) for c in channels)
    assert least * true < found["accuracy"]["estimated_error"] < 10 * true


def off(found: Run, truth: Run, channel: str) -> float:
    """Root of the mean square over time, over the range, where both have samples."""
    at = np.searchsorted(truth.t, found.t - 1e-9)
    exact = truth[channel][at]
    return float(np.sqrt(np.mean((found[channel] - exact) ** 2)) / np.ptp(exact))


@pytest.mark.parametrize("setting, target", [("FAST", 1e-2), ("NORMAL", 1e-3)])
def test_a_motion_that_looks_still_does_not_repeat_a_run(
    setting: str, target: float, tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """Errors were compared with ranges of rounding: FAST took 4600 steps for 2 s, NORMAL 9600."""
    found, result = solve_by(DRIVEN, f"ACCURACY {setting}", tmp_path)
    assert "again" not in found["said"]
    assert found["steps"] < 625
    dense = truth_of(DRIVEN.replace("H 0.02", "H 0.0005"), "1D-6")
    at = np.searchsorted(dense.t, result.t - 1e-9)
    true = 0.0
    for channel in ("2/SLIDE_POWER", "3/DAMPER_POWER", "1/KINETIC_ENERGY", "4/KINETIC_ENERGY", "node/2/UX"):
        exact = dense[channel]
        rms = np.sqrt(np.mean((result[channel] - exact[at]) ** 2))
        true = max(true, float(rms / np.ptp(exact)))
    assert true / 3 < found["accuracy"]["estimated_error"] < min(10 * true, target)


def test_a_free_vibration_that_looks_still_has_the_error_stated(tmp_path: Path) -> None:
    """Stated was 30 times the range, and chaos."""
    found, result = solve_by(FREE, "ACCURACY NORMAL", tmp_path)
    assert found["steps"] < 3000 and not found["diagnostics"]
    wave = 100 * np.pi * result.t
    errors = [
        (result["node/1/UX"] * 100 * np.pi - np.sin(wave)) / 2,
        (result["node/1/VX"] - np.cos(wave)) / 2,
        result["element/1/KINETIC_ENERGY"] / 0.5 - np.cos(wave) ** 2,
    ]
    true = max(float(np.sqrt(np.mean(e**2))) for e in errors)
    assert true / 3 < found["accuracy"]["estimated_error"] < 10 * true


def test_friction_power_at_fine_meets_its_target(tmp_path: Path, truth_of: Callable[..., Run]) -> None:
    """It was 3e-5 off with a sticking phase."""
    deck = PRESSED.format(friction="0.25 STICK")
    _, result = solve_by(deck, "ACCURACY FINE", tmp_path)
    assert off(result, truth_of(deck), "2/FRICTION_POWER") < 1e-5


@pytest.mark.parametrize("friction", ["", "0.25 STICK"])
def test_friction_has_a_corner_where_its_load_passes_zero(
    friction: str, tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """FRICTION_FORCE was 2e-3 off where 6e-4 was stated; at one instant half of it was missing."""
    deck = PRESSED.format(friction=friction)
    found, result = solve_by(deck, "ACCURACY NORMAL", tmp_path)
    error = off(result, truth_of(deck), "2/FRICTION_FORCE")
    assert error < 1e-3
    assert error < 3 * found["accuracy"]["estimated_error"]
    exact = 0.2 * result["2/PRESSING_FORCE"]
    slides = np.abs(result["2/SLIDE_SPEED"]) > 0.05
    assert np.abs(result["2/FRICTION_FORCE"] - exact)[slides].max() < 1e-3


@pytest.mark.parametrize("setting", ["FAST", "NORMAL"])
def test_the_order_of_errors_is_that_of_the_runs(
    setting: str, tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """Axial vibrations of the beam fall with order 2 in the steps: 9e-4 was stated, and true were 6e-3.
    Neither run resolves them all: 0.3 to 0.8 of the error is stated, as rounding has it."""
    found, result = solve_by(BEAM, f"ACCURACY {setting}", tmp_path)
    channels = ("1/NORMAL_FORCE_B", "2/NORMAL_FORCE_A", "node/2/AX")
    expect_honest(found, result, truth_of(BEAM, "1D-8"), channels, least=0.2)


@pytest.mark.parametrize("setting", ["FAST", "NORMAL"])
def test_steps_end_where_a_belt_goes_slack(
    setting: str, tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """The force on the bearings was 4e-3 off, where 8e-4 was stated."""
    found, result = solve_by(BELT, f"ACCURACY {setting}", tmp_path)
    assert result["run/EVENTS"][-1] >= 8
    channels = ("6/FORCE_X", "6/SLACK_SIDE", "6/TIGHT_SIDE", "run/DISSIPATED_ENERGY")
    expect_honest(found, result, truth_of(BELT, "1D-7"), channels)


@pytest.mark.parametrize(
    "law, setting, steps", [("HARMONIC", "FAST", 90), ("HARMONIC", "FINE", 250), ("CYCLOIDAL", "FINE", 250)]
)
def test_steps_end_at_the_joints_of_a_cam(
    law: str, setting: str, steps: int, tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """The acceleration of a harmonic motion jumps: FAST stated 0.004 where 0.024 was true. The runs at FINE
    took 1235 and 1044 steps. Forces across the guide grow from zero: their square was interpolated, and they
    were a thousandth off."""
    deck = CAM.format(law=law)
    found, result = solve_by(deck, f"ACCURACY {setting}", tmp_path)
    assert found["steps"] < steps
    of_elements = ("3/NORMAL_FORCE", "3/PRESSURE_ANGLE", "2/RADIAL_FORCE", "4/KINETIC_ENERGY", "1/MOMENT_Z")
    channels = ("node/2/AY", *of_elements)
    expect_honest(found, result, truth_of(deck), channels)


@pytest.mark.parametrize("setting", ["FAST", "NORMAL"])
def test_a_follower_that_vibrates_after_each_jump(
    setting: str, tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """Pressed onto its cam it vibrates 220 times a turn. Both runs passed over that with long steps: 0.0045
    was stated, and true were 0.029."""
    pressed = CAM.format(law="HARMONIC").replace("L0 0.01", "L0 0.03")
    pressed = pressed.replace("DIRECTION 0 1 0", "DIRECTION 0 1 0 K 1E7 DAMP LINEAR 300")
    found, result = solve_by(pressed, f"ACCURACY {setting}", tmp_path)
    channels = ("node/2/AY", "3/NORMAL_FORCE", "2/RADIAL_FORCE", "4/KINETIC_ENERGY", "1/MOMENT_Z")
    expect_honest(found, result, truth_of(pressed), channels)


@pytest.mark.parametrize("damping", ["5D-6", "1D-5", "1D-4"])
def test_a_meshed_link_in_motion(damping: str, tmp_path: Path, truth_of: Callable[..., Run]) -> None:
    """Its motion excites waves in the link: NORMAL stated a tenth to a quarter of the error of forces."""
    text = (Path(__file__).parents[2] / "decks/mechanisms/meshed_slider_crank.dat").read_text(
        encoding="utf-8"
    )
    names = '"UX" "VY" "FORCE_X" "FORCE_Y" "DRIVE_TORQUE"'
    text = re.sub(r"^\.CHK\n(?:.*\n)*?\.FIN.*", "", text, flags=re.M)
    text = re.sub(r"^\.(SAM|SAI) .*\n", "", text, flags=re.M).replace(
        "M 7850.0", f"M 7850.0 DAMPING {damping}"
    )
    text += f".SAI NOEUD 26 ELEMENT 101 103 106 107 CHANNEL {names}\n"
    (tmp_path / "exact").mkdir()
    large = "DISPLACEMENTS LARGE PLANE XY"
    found, result = solve_by(text, f"ACCURACY NORMAL {large}", tmp_path)
    exact = solve_by(text, f"ACCURACY FINE {large}", tmp_path / "exact")[1]
    channels = ("103/FORCE_X", "103/FORCE_Y", "106/FORCE_X", "106/FORCE_Y", "101/DRIVE_TORQUE", "node/26/VY")
    expect_honest(found, result, exact, channels)


@pytest.mark.parametrize("setting, steps", [("NORMAL", 200), ("FINE", 300)])
def test_steps_end_at_the_knots_of_a_spline(
    setting: str, steps: int, tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """The third derivative jumps there. NORMAL stated a tenth of the error, FINE a quarter in 1153 steps."""
    found, result = solve_by(SPLINE, f"ACCURACY {setting}", tmp_path)
    assert found["steps"] < steps
    channels = ("node/2/AX", "node/3/AY", "1/DRIVE_TORQUE", "3/RADIAL_FORCE", "4/KINETIC_ENERGY")
    expect_honest(found, result, truth_of(SPLINE), channels)


@pytest.mark.parametrize("setting, target", [("FAST", 1e-2), ("NORMAL", 1e-3), ("FINE", 1e-5)])
@pytest.mark.parametrize(
    "deck, channel",
    [(SENSOR, "5/RELATIVE_SPEED"), (BENDS, "1/BEND"), (SWINGS, "5/SLIDING_SPEED")],
    ids=["sensor", "joint", "cam"],
)
def test_sizes_have_a_corner_where_they_vanish(
    deck: str, channel: str, setting: str, target: float, tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """They were interpolated across it: NORMAL was 1.5e-3 to 2.8e-3 off and stated a quarter of that, FINE
    took 750 to 2100 steps, and there were angles and speeds below zero."""
    found, result = solve_by(deck, f"ACCURACY {setting}", tmp_path)
    assert found["steps"] < 250
    assert off(result, truth_of(deck), channel) < min(target, 3 * found["accuracy"]["estimated_error"])
    assert result[channel].min() >= 0


@pytest.mark.parametrize("setting", ["FAST", "NORMAL"])
@pytest.mark.parametrize("axis", ["0 0 1", "1 1 0", "1 2 3"])
def test_a_disc_turns_about_any_axis(axis: str, setting: str, tmp_path: Path) -> None:
    """Its rotation vector jumps by a turn along the axis, and the hinge carries no moment: about oblique axes
    runs were repeated for both and the motion was said to be chaotic."""
    found, result = solve_by(DISC.format(axis=axis), f"ACCURACY {setting}", tmp_path)
    assert "again" not in found["said"] and not found["diagnostics"]
    assert found["accuracy"]["estimated_error"] < 1e-3
    angle = 10 * np.pi * result.t + (1 - np.cos(20 * np.pi * result.t)) * 100 / (20 * np.pi) ** 2
    assert np.abs(result["1/ANGLE"] - angle).max() < 1e-4 * np.ptp(angle)


def test_a_follower_that_is_held_has_no_gap(tmp_path: Path) -> None:
    """What its constraint was left open by was judged: a run was repeated for a gap of 1e-8."""
    found, result = solve_by(SWINGS.replace("PHASE 60 ", ""), "ACCURACY FAST", tmp_path)
    assert "again" not in found["said"]
    assert np.abs(result["5/GAP"]).max() < 1e-9


@pytest.mark.parametrize(
    "model, teeth, table, setting",
    [
        (PAIR, "CM 1000 ERR TABLE 5", ERROR, "FINE"),
        (PAIR, "CM 1000 PITCHA 5", CUMULATIVE, "NORMAL"),
        (PAIR, "CM 1000 STIFF TABLE 5", "0 0.8 0.3 1.2 0.5 1.2 0.6 0.8 1 0.8 PERIOD 1", "FAST"),
        (PAIR, "CM 300 TIPRELA 5E-6 2E-3 1 TIPRELB 5E-6 2E-3 1", ERROR, "FINE"),
        (RACK, "CM 200 ERR TABLE 5", ERROR, "FINE"),
    ],
)
def test_steps_end_at_corners_that_wheels_pass(
    model: str, teeth: str, table: str, setting: str, tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """The errors were three to ten times those stated."""
    deck = model.format(teeth=teeth, table=table)
    found, result = solve_by(deck, f"ACCURACY {setting}", tmp_path)
    expect_honest(found, result, truth_of(deck, "1D-8"), ("3/TORQUE_A", "5/KINETIC_ENERGY", "1/RADIAL_FORCE"))


@pytest.mark.parametrize("follower", ["FLAT", "KNIFE"])
def test_steps_end_at_the_points_of_a_profile(
    follower: str, tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """The acceleration was 1e-3 off."""
    deck = POLAR.format(follower=f"{follower} FRICTION CONST 0.1 VREG 1E-3", spring=500, speed=20, time=0.6)
    _, result = solve_by(deck, "ACCURACY FAST", tmp_path)
    truth = truth_of(deck)
    assert max(off(result, truth, c) for c in ("node/2/AY", "3/NORMAL_FORCE")) < 1e-4


def test_friction_of_a_held_follower_bends_where_its_load_passes_zero(
    tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """The force across the guide was 3e-3 off, where 5e-4 was stated; now 1e-6 to 2e-6."""
    deck = POLAR.format(follower="KNIFE FRICTION CONST 0.1 VREG 1E-2", spring=20, speed=120, time=0.15)
    _, result = solve_by(deck, "ACCURACY NORMAL", tmp_path)
    said = (tmp_path / "deck.lst").read_text(encoding="utf-8")
    assert said.count("cam pulls the follower") == said.count("cam pushes the follower") == 3
    assert off(result, truth_of(deck), "2/FORCE_3") < 1e-5


# the torque of the motor bends at each point of its curve
MOTOR = """
.NOE
 I 1
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 INERTIA N 1 J 1E-2
 I 3 MOTOR JOINT 1 CURVE 1
 I 4 TORQUE N 1 AXIS 0 0 1 V 1 NF 2
.FCT
 I 1 TABLE 0 8 50 10 80 9 100 0 110 -8
 I 2 EXPR "-3-4*SIN(30*T)"
.SUB TF 1 H 1E-3
"""

# the shaft speeds up across the speeds for which the film is given
FILM = """
.NOE
 I 1
.MCE
 I 1 BEARING N 0 1 AXIS 0 0 1 SPEED 100 200 300 K {stiffness} C {damping}
 I 2 INERTIA N 1 M 1 J 1E-3
 I 4 FORCE N 1 DIR 0 -1 0 V 500
 I 5 TORQUE N 1 AXIS 0 0 1 V 1 NF 2
.CLM
 NOEUD 1 FIX C 3 4 5
.INI
 VIT NOEUD 1 C 6 V 50
.FCT
 I 2 EXPR "1+SIN(20*T)"
.SUB TF 0.4 H 2E-4
""".format(
    stiffness="2E6 1E6 -1E6 2E6 3E6 2E6 -2E6 3E6 2E6 0 0 2E6",
    damping="2E3 0 0 2E3 1E3 0 0 1E3 2E3 0 0 2E3",
)

# a load that goes round, so that each ball or roller takes its turn
ROLLING = """
.MAT
 I 1 YT 2.1E11 NT 0.3 M 7850
.NOE
 I 1
.MCE
 I 1 BEARING N 0 1 AXIS 0 0 1 AXIS2 1 0 0 {elements} MAT 1 C 0 {damping} {damping} 0 0.1 0.1
 I 2 INERTIA N 1 M 1 J 1E-3
 I 4 FORCE N 1 DIR 0 -1 0 V 50
 I 5 FORCE N 1 DIR 1 0 0 V 2000 NF 2
 I 6 FORCE N 1 DIR 0 1 0 V 2000 NF 3
.CLM
 NOEUD 1 FIX C 3 4 5 6
.FCT
 I 2 EXPR "COS(600*T)"
 I 3 EXPR "SIN(600*T)"
.SUB TF 0.02 H 1E-5
"""
BALLS = ROLLING.format(elements="BALLS 9 D 12.7E-3 DM 65.E-3 CLEARANCE 15E-6", damping=100)
ROLLERS = ROLLING.format(elements="ROLLERS 14 D 10E-3 L 9.6E-3 DM 54E-3", damping=2000)


@pytest.mark.parametrize("setting", ["FAST", "NORMAL", "FINE"])
@pytest.mark.parametrize(
    "deck, channels, event",
    [
        (MOTOR, ("3/POWER", "3/TORQUE"), "CURVE passes its corner at 80 upwards"),
        (FILM, ("node/1/AX", "1/FORCE_3"), "SPEED passes its corner at 200 upwards"),
    ],
    ids=["motor", "film"],
)
def test_steps_end_where_a_speed_passes_a_corner(
    deck: str,
    channels: tuple[str, ...],
    event: str,
    setting: str,
    tmp_path: Path,
    truth_of: Callable[..., Run],
) -> None:
    """At NORMAL a fifth of the errors was stated, and films were 3.6e-3 off."""
    found, result = solve_by(deck, f"ACCURACY {setting}", tmp_path)
    assert event in result.file.with_suffix(".lst").read_text()
    assert max(off(result, truth_of(deck), c) for c in channels) < 2 * found["accuracy"]["estimated_error"]


@pytest.mark.parametrize("setting", ["FAST", "NORMAL"])
@pytest.mark.parametrize("deck, element", [(BALLS, "ball"), (ROLLERS, "roller")], ids=["balls", "rollers"])
def test_steps_end_where_a_rolling_element_takes_load(
    deck: str, element: str, setting: str, tmp_path: Path, truth_of: Callable[..., Run]
) -> None:
    """Balls at FAST were 0.027 off, where 0.0073 was stated; rollers at NORMAL 4.1e-3, where 6.6e-4 was."""
    found, result = solve_by(deck, f"ACCURACY {setting}", tmp_path)
    assert f"{element} 2 takes load" in result.file.with_suffix(".lst").read_text()
    channels = ("1/ELEMENT_LOAD", "node/1/VY", "node/1/AY", "6/POWER")
    error = max(off(result, truth_of(deck), c) for c in channels)
    assert error < 1e-3
    assert error < 2 * found["accuracy"]["estimated_error"]
