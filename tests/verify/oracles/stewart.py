# SPDX-License-Identifier: BSD-3-Clause
"""A platform on six legs: their lengths for a stated path (inverse kinematics) and their forces by Newton's
and Euler's equations. SI units; the data of decks/mechanisms/stewart_platform.dat."""

from __future__ import annotations

import numpy as np

MASS, ROLL_INERTIA, GRAVITY = 200.0, 15.0, 9.81


#: ends of the legs on the ground, and on the platform from its centre
BASE = np.array([[0.98, 0.17], [-0.34, 0.94], [-0.64, 0.77], [-0.64, -0.77], [-0.34, -0.94], [0.98, -0.17]])
PLATFORM = np.array([[0.39, 0.46], [0.21, 0.56], [-0.59, 0.1], [-0.59, -0.1], [0.21, -0.56], [0.39, -0.46]])


def path(t: float) -> tuple[np.ndarray, np.ndarray, float, float]:
    """Centre, its acceleration, roll about x and its second derivative."""
    w = 2 * np.pi
    s, c, s2 = np.sin(w * t), np.cos(w * t), np.sin(2 * w * t)
    place = np.array([0.15 * s, 0.05 * s2, 1.25 - 0.05 * c])
    acceleration = np.array([-0.15 * w**2 * s, -0.05 * 4 * w**2 * s2, 0.05 * w**2 * c])
    return place, acceleration, 0.2 * s, -0.2 * w**2 * s


def legs(t: float) -> tuple[np.ndarray, np.ndarray]:
    """The legs from the ground to the platform (6 x 3), and their upper ends from the centre (6 x 3)."""
    place, _, roll, _ = path(t)
    turned = np.stack([PLATFORM[:, 0], PLATFORM[:, 1] * np.cos(roll), PLATFORM[:, 1] * np.sin(roll)], axis=-1)
    return place + turned - np.c_[BASE, np.zeros(6)], turned


def lengths(t: float) -> np.ndarray:
    return np.linalg.norm(legs(t)[0], axis=1)


def thrusts(t: float) -> np.ndarray:
    """Force in each leg, positive when it pushes: sum f n = m (a - g), sum r x f n = J roll''. The roll stays
    about one axis, so that no gyroscopic moment adds to it."""
    reach, arms = legs(t)
    n = reach / np.linalg.norm(reach, axis=1)[:, None]
    _, acceleration, _, spin_up = path(t)
    load = np.r_[MASS * (acceleration + np.array([0, 0, GRAVITY])), ROLL_INERTIA * spin_up, 0, 0]
    return np.linalg.solve(np.concatenate([n, np.cross(arms, n)], axis=1).T, load)
