# SPDX-License-Identifier: BSD-3-Clause
"""Surface of a rack: for the eye, not for contact."""

from __future__ import annotations

import numpy as np

from .gear_mesh import ADDENDUM, DEDENDUM, PRESSURE, SLIM

BACK = 2.0  # thickness behind the roots, in modules
MOST_TEETH = 600


def rack_mesh(
    module: float, width: float, low: float, high: float, shift: float, slant: float
) -> tuple[np.ndarray, np.ndarray]:
    """Points (n x 3) along the travel, towards the pinion and across; quads. The teeth fill `low` to `high`
    along the travel, one tooth's middle stands at `shift`, and tooth lines go `slant` along the travel per
    length across."""
    pitch = np.pi * module * np.hypot(1, slant)
    heights = np.array([-DEDENDUM, 0.0, ADDENDUM]) * module
    half = SLIM * pitch / 4 - heights * np.tan(PRESSURE) * np.hypot(1, slant)
    half = np.clip(half, 0.08 * pitch, 0.46 * pitch)
    first, last = np.floor((low - shift) / pitch), np.ceil((high - shift) / pitch)
    middles = shift + pitch * np.arange(first, min(last, first + MOST_TEETH) + 1)
    along = (middles[:, None] + np.r_[-half, half[::-1]]).ravel()
    up = np.tile(np.r_[heights, heights[::-1]], len(middles))
    bottom = -(DEDENDUM + BACK) * module
    along = np.r_[along[0], along, along[-1]]
    up = np.r_[bottom, up, bottom]
    n = len(along)
    sides = [np.column_stack([along + slant * a, up, np.full(n, a)]) for a in (-width / 2, width / 2)]
    # One cut of the bar is walls between neighbours of the outline, which is closed; the faces at its ends
    # are strips from the outline down to the back.
    i = np.arange(n)
    j = (i + 1) % n
    walls = np.column_stack([i, j, j + n, i + n])
    feet = [np.column_stack([s[1:-1, 0], np.full(n - 2, bottom), s[1:-1, 2]]) for s in sides]
    k = np.arange(n - 3)
    ends = []
    for side, start in enumerate((2 * n, 2 * n + n - 2)):
        ends.append(np.column_stack([k + 1 + side * n, k + 2 + side * n, start + k + 1, start + k]))
    return np.concatenate([*sides, *feet]), np.concatenate([walls, *ends])
