# SPDX-License-Identifier: BSD-3-Clause
"""Sizes of friction within steps, where the sliding turns back and below the speed at which friction is
regularised: a driven rotor with an eccentric mass, whose forces follow from its motion in closed form."""

from pathlib import Path

import numpy as np
import pytest
from runs import Run, solve

DECK = """
.NOE
 I 1
 I 2 X 0.1
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1 FRICTION CONST 0.1 RADIUS 0.01 VREG {width}
 I 2 RIGID N 1 2
 I 11 INERTIA N 2 M 5 J 1E-3
.FCT I 1 EXPR "30*T+2*sin(20*T)"
.CLM STRU ACC VAL 0 -9.81 0
.SAM TYPE DYNAMIC ACCURACY {setting}
.SUB TF 0.5 H 0.0005
.FIN
"""


def expected(t: np.ndarray, width: float) -> dict[str, np.ndarray]:
    angle, speed, acceleration = 30 * t + 2 * np.sin(20 * t), 30 + 40 * np.cos(20 * t), -800 * np.sin(20 * t)
    along = -0.1 * (acceleration * np.sin(angle) + speed**2 * np.cos(angle))
    up = 0.1 * (acceleration * np.cos(angle) - speed**2 * np.sin(angle))
    pressing = 5 * np.hypot(along, up + 9.81)
    part = np.clip(np.abs(0.01 * speed) / width, 0, 1)
    moment = 0.1 * 0.01 * pressing * part * (15 - 10 * part**2 + 3 * part**4) / 8
    torque = (1e-3 + 5 * 0.01) * acceleration + 5 * 9.81 * 0.1 * np.cos(angle) + np.sign(speed) * moment
    return {
        "PRESSING_FORCE": pressing,
        "FRICTION_MOMENT": moment,
        "FRICTION_POWER": moment * np.abs(speed),
        "DRIVE_TORQUE": torque,
    }


def off(found: Run, width: float, channel: str) -> float:
    """Root of the mean square over time, over the range."""
    exact = expected(found.t, width)[channel]
    return float(np.sqrt(np.mean((found[f"1/{channel}"] - exact) ** 2)) / np.ptp(exact))


@pytest.mark.parametrize(
    ("width", "setting", "asked"), [(1e-2, "NORMAL", 1e-3), (1e-2, "FINE", 1e-5), (1e-3, "FINE", 1e-5)]
)
def test_friction_follows_from_speed_and_pressing_force(
    width: float, setting: str, asked: float, tmp_path: Path
) -> None:
    """Interpolated, the moment was 1e-4 off at FINE, where 5e-6 was stated."""
    said, found = solve(DECK.format(width=width, setting=setting), tmp_path)
    assert said["accuracy"]["estimated_error"] < asked
    for channel in expected(found.t, width):
        assert off(found, width, channel) < asked
    assert off(found, width, "FRICTION_MOMENT") < 2 * off(found, width, "PRESSING_FORCE")
