# SPDX-License-Identifier: BSD-3-Clause
"""Double-wishbone suspension: the wheel carrier on its five rods and arms, closed by distances only, and the
wheel's force by virtual work. SI units; the data of decks/mechanisms/double_wishbone.dat."""

from __future__ import annotations

import numpy as np
from scipy.optimize import root
from scipy.spatial.transform import Rotation

LOWER = np.array([[0.15, 0.35, 0.2], [-0.15, 0.35, 0.22]])  # bearings of the lower arm
UPPER = np.array([[0.12, 0.42, 0.5], [-0.13, 0.42, 0.48]])
LOWER_BALL, UPPER_BALL = np.array([0.01, 0.7, 0.18]), np.array([-0.02, 0.66, 0.48])
RACK, TIE = np.array([-0.14, 0.398, 0.263]), np.array([-0.13, 0.68, 0.24])
WHEEL, MARK = np.array([0.0, 0.78, 0.32]), np.array([0.0, 1.08, 0.32])
SEAT, TOWER = (
    np.array([0.0, 0.55, 0.19]),
    np.array([0.0, 0.45, 0.6]),
)  # of the spring, on the lower arm and the body
STIFFNESS, NATURAL = 6e4, 0.5


def carrier(travel: float) -> tuple[np.ndarray, Rotation]:
    """Displacement of the wheel's centre and turn of the carrier for a travel of the centre along z."""

    def moved(point: np.ndarray, x: np.ndarray) -> np.ndarray:
        return WHEEL + x[:3] + Rotation.from_rotvec(x[3:]).apply(point - WHEEL)

    rods = [(a, LOWER_BALL) for a in LOWER] + [(a, UPPER_BALL) for a in UPPER] + [(RACK, TIE)]

    def open_by(x: np.ndarray) -> np.ndarray:
        gaps = [np.sum((moved(p, x) - a) ** 2) - np.sum((p - a) ** 2) for a, p in rods]
        return np.r_[gaps, x[2] - travel]

    found = root(open_by, np.r_[0, 0, travel, 0, 0, 0], tol=1e-14)
    assert np.abs(open_by(found.x)).max() < 1e-13, found.message
    return found.x[:3], Rotation.from_rotvec(found.x[3:])


def spring_length(travel: float) -> float:
    """The spring's seat goes round the lower arm's axis as its ball joint does."""
    shift, turn = carrier(travel)
    ball = WHEEL + shift + turn.apply(LOWER_BALL - WHEEL)
    axis = (LOWER[0] - LOWER[1]) / np.linalg.norm(LOWER[0] - LOWER[1])
    foot = LOWER[1] + axis * ((ball - LOWER[1]) @ axis)
    before, after = LOWER_BALL - foot, ball - foot
    angle = np.arctan2(np.cross(before, after) @ axis, before @ after)
    seat = LOWER[1] + Rotation.from_rotvec(angle * axis).apply(SEAT - LOWER[1])
    return float(np.linalg.norm(seat - TOWER))


def state(travel: float) -> dict[str, float | np.ndarray]:
    """Camber (positive: the top leans out) and turn about z (positive: to the left) of the wheel in radians,
    displacements, the spring's force, and the vertical force on the wheel that holds it."""
    shift, turn = carrier(travel)
    spindle = turn.apply(MARK - WHEEL)
    along = spindle / np.linalg.norm(spindle)
    h = 1e-3  # differences of fourth order: error h4 l'''''/30
    slope = (
        spring_length(travel - 2 * h)
        - 8 * spring_length(travel - h)
        + 8 * spring_length(travel + h)
        - spring_length(travel + 2 * h)
    ) / (12 * h)
    pull = STIFFNESS * (spring_length(travel) - NATURAL)
    return {
        "shift": shift,
        "mark": shift + spindle - (MARK - WHEEL),
        "camber": -float(np.arcsin(along[2])),
        "steer": float(np.arctan2(-along[0], along[1])),
        "spring": pull,
        "wheel_force": pull * slope,
    }
