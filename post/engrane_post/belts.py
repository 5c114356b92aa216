# SPDX-License-Identifier: BSD-3-Clause
"""A belt and its pulleys: for the eye, but the belt runs where the element's equations have it."""

from __future__ import annotations

import numpy as np

from . import gear_mesh, shapes
from .graphics import pv

ROUND, STRAIGHT = 49, 9  # stations along a wrap and along a free span
THICK, WIDE = 0.07, 0.5  # of the belt, as parts of the smaller pulley's radius


def stations(d: float, r1: float, r2: float, crossed: bool) -> np.ndarray:
    """Middle line of the belt and its normals (n x 2 x 2), the first pulley at the origin and the second
    at (d, 0). Open or crossed, a common tangent of both circles leaves the line of centres by
    asin((r1 - s r2)/d), s = -1 when crossed (docs/elements/control/belt.md)."""
    s = -1.0 if crossed else 1.0
    beta = np.arcsin(np.clip((r1 - s * r2) / d, -1.0, 1.0))
    leave = np.pi / 2 - beta  # where the first span touches the first pulley
    around = np.linspace(leave, 2 * np.pi - leave, ROUND)
    back = np.linspace(-leave, leave, ROUND)
    if crossed:  # round the far side of the second pulley, the other way
        back = np.linspace(np.pi - leave, leave - np.pi, ROUND)
    first = np.stack([np.cos(around), np.sin(around)], axis=-1)
    second = np.stack([np.cos(back), np.sin(back)], axis=-1)
    wraps = [r1 * first, np.array([d, 0.0]) + r2 * second]
    normals = [first, s * second]
    share = np.linspace(0, 1, STRAIGHT + 1)[1:-1, None]
    line, normal = [], []
    for i in range(2):
        j = 1 - i
        line += [wraps[i], wraps[i][-1] + share * (wraps[j][0] - wraps[i][-1])]
        normal += [normals[i], np.repeat(normals[i][-1:], len(share), axis=0)]
    return np.stack([np.concatenate(line), np.concatenate(normal)], axis=1)


def belt(
    a: np.ndarray, b: np.ndarray, axis: np.ndarray, radii: tuple[float, float], crossed: bool
) -> pv.PolyData:
    """The belt round pulleys at a and b: a closed band, always of the same number of points."""
    e = shapes.unit(axis)
    gap = b - a - e * (e @ (b - a))
    d = float(np.linalg.norm(gap))
    u = gap / d
    plane = np.stack([u, np.cross(e, u)])
    middle, normal = (part @ plane for part in stations(d, *radii, crossed).transpose(1, 0, 2))
    half_thick, half_wide = (0.5 * share * min(radii) for share in (THICK, WIDE))
    corners = [(1, 1), (1, -1), (-1, -1), (-1, 1)]
    points = np.concatenate([a + middle + o * half_thick * normal + w * half_wide * e for o, w in corners])
    n = len(middle)
    i = np.arange(n)
    j = (i + 1) % n
    sides = [
        np.column_stack([k * n + i, k * n + j, (k + 1) % 4 * n + j, (k + 1) % 4 * n + i]) for k in range(4)
    ]
    return shapes.quads(points, np.concatenate(sides))


def pulley(
    center: np.ndarray, axis: np.ndarray, toward: np.ndarray, radius: float, least: float
) -> tuple[list[pv.PolyData], pv.PolyData | None]:
    """Rim, web and hub, and the dark discs on the web that show its turn; `radius` reaches to the middle of
    the belt, `least` is the smaller one of the pair."""
    width = 1.15 * WIDE * least
    shape = gear_mesh.WheelShape(radius, 30, radius / 15, width=width)
    frame = gear_mesh.frame_of(axis, toward)
    outer = radius - 0.5 * THICK * least
    inner = radius - (gear_mesh.DEDENDUM + gear_mesh.RIM) * shape.module
    parts = [gear_mesh.tube_mesh(-width / 2, width / 2, inner, outer), *gear_mesh.web_mesh(shape)]
    solid = [shapes.quads(p @ frame.T + center, c) for p, c in parts]
    return solid, shapes.spots(shape, frame, center)
