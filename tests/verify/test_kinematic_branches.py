# SPDX-License-Identifier: BSD-3-Clause
"""KINEMATIC runs stay on their branch of assembly however long their steps are, and pass singular positions
where speeds and forces have a limit there."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import engrane, run

A, B, C = 0.1, 0.25, 0.3
BEGIN = np.radians(70)


def rocker(crank: np.ndarray | float, frame: float) -> np.ndarray:
    """Angle of the rocker, from the triangle of the diagonal between crank pin and rocker's bearing."""
    diagonal = np.sqrt(A**2 + frame**2 - 2 * A * frame * np.cos(crank))
    return (
        np.pi
        - np.arctan2(A * np.sin(crank), frame - A * np.cos(crank))
        - np.arccos((C**2 + diagonal**2 - B**2) / (2 * C * diagonal))
    )


def four_bar(frame: float, turn: float, step: float, ground: str = "POINT_LINE") -> str:
    pin = A * np.array([np.cos(BEGIN), np.sin(BEGIN)])
    end = np.array([frame, 0]) + C * np.array([np.cos(rocker(BEGIN, frame)), np.sin(rocker(BEGIN, frame))])
    pin_at, end_at = (f"{float(x)!r} {float(y)!r} 0" for x, y in (pin, end))
    return f"""
.NOE
 I 1 X 0 0 0
 I 2 X {pin_at}
 I 3 X {frame} 0 0
.MCE
 I 11 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 12 HINGE N 1 2 AXIS 0 0 1 AT {pin_at}
 I 13 {ground} N 3 2 AXIS 0 0 1 AT {end_at}
 I 14 HINGE N 0 3 AXIS 0 0 1
.FCT
 I 1 EXPR "({turn}*PI/180)*T"
.SAM TYPE KINEMATIC
.SUB TF 1 H ({step}/{turn})
"""


@pytest.mark.parametrize("joint", ["POINT_LINE", "HINGE"])
@pytest.mark.parametrize(
    ("frame", "turn", "step"),
    [(0.35, 755, 151), (0.449, 720, 30), (0.449, 720, 40), (0.4499, 720, 15), (0.1501, 720, 15)],
)
def test_long_steps_stay_on_their_branch(
    frame: float, turn: float, step: float, joint: str, tmp_path: Path
) -> None:
    """At 0.449 crank, frame and rocker are nearly in line once a turn, at 0.1501 with coupler and rocker:
    the other branch is near. Long steps went on along it."""
    result = run(four_bar(frame, turn, step, joint), tmp_path)
    turned = rocker(BEGIN + np.radians(turn) * result.t, frame) - rocker(BEGIN, frame)
    assert np.unwrap(result["14/ANGLE"]) == pytest.approx(np.unwrap(turned), abs=1e-11)


def twice(deck: str) -> str:
    """The same loop once more on the same crank."""
    lines = deck.splitlines()
    nodes = [
        line.replace(f" I {n} X", f" I {n + 2} X", 1)
        for n in (2, 3)
        for line in lines
        if line.startswith(f" I {n} X")
    ]
    again = {"12": (" 1 2 ", " 1 4 "), "13": (" 3 2 ", " 5 4 "), "14": (" 0 3 ", " 0 5 ")}
    joints = []
    for number, (old, new) in again.items():
        (line,) = (line for line in lines if line.startswith(f" I {number} "))
        joints.append(line.replace(f" I {number} ", f" I 2{number[1]} ").replace(old, new))
    return deck.replace(".MCE\n", "\n".join([*nodes, ".MCE", *joints, ""]))


@pytest.mark.parametrize("frame", [0.35, 0.449, 0.4499, 0.1501])
@pytest.mark.parametrize("step", [15, 20, 40, 60, 90])
def test_two_loops_at_once(frame: float, step: float, tmp_path: Path) -> None:
    """The determinant of all constraints keeps its sign where both change their branch: from 15 degrees on
    results were wrong, with status 0."""
    result = run(twice(four_bar(frame, 720, step)), tmp_path)
    turned = rocker(BEGIN + np.radians(720) * result.t, frame) - rocker(BEGIN, frame)
    for joint in (14, 24):
        assert np.unwrap(result[f"{joint}/ANGLE"]) == pytest.approx(np.unwrap(turned), abs=1e-11)


@pytest.mark.parametrize("frame", [0.4501, 0.451])
@pytest.mark.parametrize("step", [20, 60, 120])
def test_gap_in_which_a_loop_does_not_close(frame: float, step: float, tmp_path: Path) -> None:
    """The crank cannot turn all round: steps of 120 degrees leapt over the gap, with status 0."""
    done = engrane(four_bar(frame, 720, step), tmp_path)
    assert done.returncode == 2
    assert "singular position at t = 0.1" in done.stderr


PARALLELOGRAM = """
.NOE
 I 1 X 0 0 0
 I 2 X 0 0.1 0
 I 3 X 0.3 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 HINGE N 1 2 AXIS 0 0 1 AT 0 0.1 0
 I 3 {joint} N 3 2 AXIS 0 0 1 AT 0.3 0.1 0
 I 4 HINGE N 0 3 AXIS 0 0 1
{more}
.FCT
 I 1 EXPR "2*PI*T"
.SAM TYPE KINEMATIC
.SUB TF 1 H {step}
"""


@pytest.mark.parametrize("joint", ["POINT_LINE", "HINGE"])
@pytest.mark.parametrize("step", [0.05, 0.0125, 0.002])
def test_a_parallelogram_stops_over_flat(step: float, joint: str, tmp_path: Path) -> None:
    """Steps land exactly on the flat position. Without loads that was refused, though nothing grows."""
    result = run(PARALLELOGRAM.format(joint=joint, more="", step=step), tmp_path)
    assert result["4/ANGLE"] == pytest.approx(result["1/ANGLE"], abs=1e-11)
    assert result["4/SPEED"] == pytest.approx(2 * np.pi, abs=1e-8)


@pytest.mark.parametrize("step", [0.25, 0.05, 0.0125, 0.002])
def test_a_turning_mass_that_loads_nothing(step: float, tmp_path: Path) -> None:
    """The forces of the coupler are rounding, which grows towards the flat position."""
    more = " I 5 INERTIA N 3 M 1 J 1"
    result = run(PARALLELOGRAM.format(joint="HINGE", more=more, step=step), tmp_path)
    assert result["4/ANGLE"] == pytest.approx(result["1/ANGLE"], abs=1e-11)
    assert result["4/SPEED"] == pytest.approx(2 * np.pi, abs=1e-8)


@pytest.mark.parametrize("step", [0.05, 0.0125])
def test_a_coupler_with_mass_over_flat(step: float, tmp_path: Path) -> None:
    """Both bars carry half of the centripetal force of the coupler, in the flat position, too."""
    more = " I 6 RIGID N 2 M 1 J 0.01 CG 0.15 0.1 0"
    result = run(PARALLELOGRAM.format(joint="POINT_LINE", more=more, step=step), tmp_path)
    assert result["2/RADIAL_FORCE"] == pytest.approx(0.1 * (2 * np.pi) ** 2 / 2, rel=1e-7)


@pytest.mark.parametrize("step", [0.05, 0.0125, 0.002])
def test_a_load_that_a_flat_parallelogram_cannot_bear(step: float, tmp_path: Path) -> None:
    """The coupler's force against the torque is the inverse of the distance; some runs gave one of 1e16."""
    text = PARALLELOGRAM.format(joint="POINT_LINE", more=" I 5 TORQUE N 3 AXIS 0 0 1 V -12", step=step)
    done = engrane(text, tmp_path, "-q")
    assert done.returncode == 2
    assert "singular position at t = 0.25" in done.stderr
