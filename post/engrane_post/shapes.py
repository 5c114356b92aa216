# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces of the things a mechanism is made of."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np

from . import gear_mesh
from .errors import UserError
from .graphics import pv
from .rack_mesh import rack_mesh
from .wheels import Wheel

FARTHEST = 1e5  # from the origin, in sizes of the model


def unit(v: np.ndarray) -> np.ndarray:
    """v with length one; the z direction for a null vector."""
    n = np.linalg.norm(v)
    return np.asarray(v, float) / n if n > 0 else np.array([0.0, 0.0, 1.0])


def square_to(axis: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two unit vectors that make a right-handed frame with the axis."""
    frame = gear_mesh.frame_of(unit(axis), np.array([0.0, 1.0, 0.1]))
    return frame[:, 1], frame[:, 2]


def refuse_far_places(path: Path, points: np.ndarray, size: float) -> None:
    """Shapes are drawn with seven digits, of which a model far from the origin would need all."""
    away = float(np.abs(points).max(initial=0.0))
    if away > FARTHEST * size:
        raise UserError(
            f"{path} cannot be drawn: the model is {away / size:.2g} times its size away from the origin. "
            "Write its coordinates from a place near it. ParaView opens the .xdmf, and engrane export --mesh "
            "writes the mesh with all digits."
        )


def quads(points: np.ndarray, corners: np.ndarray) -> pv.PolyData:
    faces = np.column_stack([np.full(len(corners), 4), corners]).ravel()
    return pv.PolyData(points, faces=faces)


def wheel(w: Wheel, color: str, mark: str, dark: str) -> list[tuple[pv.PolyData, str]]:
    """Rim with teeth, the marked tooth, web, hub and the dark discs on the web, in the reference position."""
    points, corners, marked = gear_mesh.teeth_mesh(w.shape)
    place = points @ w.frame.T + w.center
    out = [
        (quads(place, corners[marked == 0]), color),
        (quads(place, corners[marked == 1]), mark),
    ]
    for p, c in gear_mesh.web_mesh(w.shape):
        out.append((quads(p @ w.frame.T + w.center, c), color))
    discs = spots(w.shape, w.frame, w.center)
    if discs is not None:
        out.append((discs, dark))
    return [(m, c) for m, c in out if m.n_cells]


def disc(
    center: np.ndarray, axis: np.ndarray, radii: tuple[float, float], width: float
) -> tuple[pv.PolyData, pv.PolyData]:
    """A ring (radii of its hole and outside), and the dark spots on its faces that show its turn."""
    inner, outer = radii
    frame = gear_mesh.frame_of(axis, np.array([0.0, 1.0, 0.1]))
    points, corners = gear_mesh.tube_mesh(-width / 2, width / 2, inner, outer)
    turn = 2 * np.pi / 5 * np.arange(5)
    marks = [
        pv.Cylinder(
            center=center + frame[:, 1:] @ (0.5 * (inner + outer) * np.array([np.cos(a), np.sin(a)])),
            direction=frame[:, 0],
            radius=0.2 * (outer - inner),
            height=1.01 * width,
            resolution=32,
        )
        for a in turn
    ]
    return quads(points @ frame.T + center, corners), pv.merge(marks)


def spots(shape: gear_mesh.WheelShape, frame: np.ndarray, center: np.ndarray) -> pv.PolyData | None:
    """The discs on a wheel's web that show its turn."""
    holes = gear_mesh.holes(shape)
    if holes is None:
        return None
    axial, half, radius, centres = holes
    return pv.merge(
        [
            pv.Cylinder(
                center=frame @ np.array([axial, y, z]) + center,
                direction=frame[:, 0],
                radius=radius,
                height=2 * half,
                resolution=32,
            )
            for y, z in centres
        ]
    )


def rack(
    center: np.ndarray,
    travel: np.ndarray,
    normal: np.ndarray,
    module: float,
    width: float,
    span: tuple[float, float],
    shift: float,
    slant: float,
) -> pv.PolyData:
    """Toothed bar through `center`, a point of the pitch plane; `normal` points to the pinion."""
    points, corners = rack_mesh(module, width, *span, shift, slant)
    frame = np.stack([travel, normal, np.cross(travel, normal)], axis=1)
    return quads(points @ frame.T + center, corners)


def tube(ends: np.ndarray, radius: float) -> pv.PolyData:
    """Round bar between two points."""
    a, b = np.asarray(ends, float)
    length = float(np.linalg.norm(b - a))
    return pv.Cylinder(
        center=(a + b) / 2, direction=unit(b - a), radius=radius, height=max(length, 1e-12), resolution=24
    )


def arm(start: np.ndarray, end: np.ndarray, axis: np.ndarray, width: float) -> pv.PolyData:
    """Flat bar with round ends across an axis, such as one arm of a planet carrier."""
    along = unit(np.asarray(end, float) - start)
    across = np.cross(axis, along)
    turn = np.linspace(-np.pi / 2, np.pi / 2, 13)
    half = np.outer(np.cos(turn), along) + np.outer(np.sin(turn), across)
    outline = np.r_[end + width * half, start - width * half]
    n, thick = len(outline), 0.35 * width * np.asarray(axis, float)
    side = np.arange(n)
    following = (side + 1) % n
    faces = [[n, *range(n)], [n, *range(2 * n - 1, n - 1, -1)]]
    faces += [[4, a, b, b + n, a + n] for a, b in zip(side.tolist(), following.tolist(), strict=True)]
    return pv.PolyData(np.r_[outline - thick, outline + thick], faces=np.concatenate(faces))


def star(points: list[np.ndarray], radius: float) -> pv.PolyData:
    """Rigid body: bars from the first point to the others, balls at the joints."""
    parts = [pv.Sphere(radius=1.6 * radius, center=p, theta_resolution=20, phi_resolution=14) for p in points]
    for p in points[1:]:
        if np.linalg.norm(p - points[0]) > radius:
            parts.append(tube(np.stack([points[0], p]), radius))
    if len(parts) == 1:
        return parts[0]
    # bars that lie in line share the rims of their ends: joined there, one would be turned inside out
    return pv.merge(parts, merge_points=False).extract_surface(algorithm="dataset_surface")


def coil(ends: np.ndarray, radius: float, turns: int = 7) -> pv.PolyData:
    """Spring between two points."""
    a, b = np.asarray(ends, float)
    axis = unit(b - a)
    u, v = square_to(axis)
    length = np.linalg.norm(b - a)
    x = np.linspace(0, 1, turns * 24 + 1)
    inside = np.clip((x - 0.12) / 0.76, 0, 1)
    reach = np.minimum(np.minimum(x, 1 - x) / 0.12, 1.0)
    turn = 2 * np.pi * turns * inside
    r = min(radius, 0.25 * length or radius) * reach
    line = a + np.outer(x * length, axis) + (r * np.cos(turn))[:, None] * u + (r * np.sin(turn))[:, None] * v
    return pv.lines_from_points(line).tube(radius=0.16 * radius, n_sides=10)


def box(center: np.ndarray, side: float) -> pv.PolyData:
    return pv.Cube(center=center, x_length=side, y_length=side, z_length=side)


def ball(center: np.ndarray, radius: float) -> pv.PolyData:
    return pv.Sphere(radius=radius, center=center, theta_resolution=28, phi_resolution=20)


def axle(center: np.ndarray, axis: np.ndarray, length: float, radius: float) -> pv.PolyData:
    """Pin of a hinge, with a collar at each end."""
    a = unit(axis)
    parts = [pv.Cylinder(center=center, direction=a, radius=radius, height=length, resolution=32)]
    for side in (-1, 1):
        parts.append(
            pv.Cylinder(
                center=center + a * side * 0.46 * length,
                direction=a,
                radius=1.5 * radius,
                height=0.08 * length,
                resolution=32,
            )
        )
    return pv.merge(parts).extract_surface(algorithm="dataset_surface")


def bearing(center: np.ndarray, axis: np.ndarray, radius: float, thick: float) -> pv.PolyData:
    """Pedestal that ties an axle to the ground: a flange behind the axle's end."""
    a = unit(axis)
    parts = [
        pv.Cylinder(
            center=center - a * thick * 0.3, direction=a, radius=radius, height=thick * 0.6, resolution=32
        ),
        pv.Cylinder(
            center=center - a * thick * 0.75,
            direction=a,
            radius=1.7 * radius,
            height=thick * 0.3,
            resolution=6,
        ),
    ]
    return pv.merge(parts).extract_surface(algorithm="dataset_surface")


def plate(outline: np.ndarray, axis: np.ndarray, thick: float, hollow: bool) -> pv.PolyData:
    """A plate cut along a closed outline (k x 3), or, `hollow`, the wall along it."""
    lift = 0.5 * thick * unit(axis)
    low, high = outline - lift, outline + lift
    n = len(outline)
    i, j = np.arange(n), (np.arange(n) + 1) % n
    wall = quads(np.r_[low, high], np.column_stack([i, j, n + j, n + i]))
    if hollow:
        return wall
    caps = [pv.PolyData(p, faces=np.r_[n, i]).triangulate() for p in (low, high)]
    return pv.merge([wall, *caps])


def roller(center: np.ndarray, axis: np.ndarray, radius: float, thick: float) -> pv.PolyData:
    return pv.Cylinder(center=center, direction=unit(axis), radius=radius, height=thick, resolution=48)


def arrow(center: np.ndarray, axis: np.ndarray, length: float) -> pv.PolyData:
    """Force: an arrow whose tip is at the point."""
    a = unit(axis)
    return pv.Arrow(
        start=np.asarray(center) - a * length,
        direction=a,
        tip_length=0.3,
        tip_radius=0.11,
        shaft_radius=0.04,
        scale=length,
    )


def turn_arrow(
    center: np.ndarray, axis: np.ndarray, radius: float, gap: np.ndarray | None = None
) -> pv.PolyData:
    """Torque: two thirds of a circle about the axis, with a tip; `gap` points to the middle of what is left
    out."""
    a = unit(axis)
    u, v = square_to(a)
    start = 0.0 if gap is None else np.arctan2(gap @ v, gap @ u) + 0.28 * np.pi
    angle = start + np.linspace(0, 1.33 * np.pi, 60)
    line = np.asarray(center) + radius * (np.outer(np.cos(angle), u) + np.outer(np.sin(angle), v))
    end = angle[-1]
    tip = pv.Cone(
        center=line[-1] + 0.12 * radius * (-np.sin(end) * u + np.cos(end) * v),
        direction=-np.sin(end) * u + np.cos(end) * v,
        height=0.45 * radius,
        radius=0.17 * radius,
        resolution=24,
    )
    return pv.merge(
        [pv.lines_from_points(line).tube(radius=0.055 * radius, n_sides=12), tip]
    ).extract_surface(algorithm="dataset_surface")


def tubes(points: np.ndarray, lines: list[list[int]], radius: float) -> pv.PolyData:
    """Round bars along polylines."""
    table = np.concatenate([[len(line), *line] for line in lines])
    return pv.PolyData(points, lines=table).tube(radius=radius, n_sides=14)


def loft(rings: np.ndarray, lid: np.ndarray) -> pv.PolyData:
    """Surface through closed rings of points, (rings, points, 3), and at both ends these triangles."""
    count, size = rings.shape[:2]
    k = np.arange(size)
    sides = [np.stack([r * size + k, r * size + (k + 1) % size], 1) for r in range(count)]
    quads = np.concatenate([np.hstack([a, b[:, ::-1]]) for a, b in pairwise(sides)])
    return surface(rings.reshape(-1, 3), [quads, lid[:, ::-1], lid + (count - 1) * size])


def triangles(ring: np.ndarray) -> np.ndarray:
    """Triangles that fill a flat closed line of points, as indices."""
    filled = pv.PolyData(ring, faces=[len(ring), *range(len(ring))]).triangulate()
    return filled.faces.reshape(-1, 4)[:, 1:]


def surface(points: np.ndarray, faces: list[np.ndarray]) -> pv.PolyData:
    """Mesh of polygons, given as tables of those with as many points."""
    table = [np.insert(f, 0, f.shape[1], axis=1).ravel() for f in faces]
    return pv.PolyData(points, faces=np.concatenate(table))
