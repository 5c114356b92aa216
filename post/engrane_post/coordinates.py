# SPDX-License-Identifier: BSD-3-Clause
"""Coordinates of joints and sensors: what one unit of effort along them is as a force and a moment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from . import linkage, shapes
from .results import Element, Frame

# The coordinate that is meant where a card names none.
FIRST = {
    "HINGE": "ANGLE",
    "PRISMATIC": "SLIDE",
    "CYLINDRICAL": "SLIDE",
    "SCREW": "SLIDE",
    "PLANAR": "SLIDE_2",
    "UNIVERSAL": "ANGLE_1",
    "DISTANCE": "LENGTH",
    "POINT_LINE": "SLIDE",
    "POINT_PLANE": "SLIDE_2",
    "POINT_CYLINDER": "SLIDE",
}


@dataclass
class Direction:
    """One unit of effort: force and moment on node b at its place (in the reference), a row a frame. The
    opposite acts on a at the same place."""

    a: int
    b: int
    place: np.ndarray
    force: np.ndarray
    moment: np.ndarray


def triad(axis: object, side: object = None) -> np.ndarray:
    """Columns: the axis, the side without its part along the axis, and their cross product. Without a side
    the program's choice: across the global axis on which the first has its least part."""
    first = shapes.unit(np.asarray(axis, float))
    if side is None:
        second = shapes.unit(np.cross(first, np.eye(3)[np.argmin(np.abs(first))]))
    else:
        given = shapes.unit(np.asarray(side, float))
        second = shapes.unit(given - (first @ given) * first)
    return np.stack([first, second, np.cross(first, second)], axis=1)


def turn(scene: linkage.Places, a: int, b: int, axis: object, frames: Sequence[Frame]) -> np.ndarray:
    """Moment on b per unit along its turn from a: along the axis where both hold it, between the two axes
    where they part, and longer."""
    e = shapes.unit(np.asarray(axis, float))
    on_a, on_b = (np.array([scene.transform(n, f)[:3, :3] @ e for f in frames]) for n in (a, b))
    return (on_a + on_b) / (1 + np.sum(on_a * on_b, axis=1))[:, None]


def direction(scene: linkage.Places, owner: Element, name: str, frames: Sequence[Frame]) -> Direction | None:
    """That of a coordinate of a joint or sensor, named as its channel is, or the first; None if unknown."""
    kind, given = owner.type.upper(), owner.parameters
    if len(owner.nodes) != 2:
        return None
    a, b = owner.nodes
    name = name or (given.get("KIND", "") if kind == "SENSOR" else FIRST.get(kind, ""))
    drawn = next((d for d in owner.drawing if d.get("shape") == "axis"), {})
    at_a, at_b = (scene.points.get(n, np.zeros(3)) for n in (a, b))
    place = np.asarray(drawn.get("center", at_b), float)
    zero = np.zeros((len(frames), 3))

    if name in ("LENGTH", "DISTANCE"):
        from_, to = at_a, at_b
        if kind == "DISTANCE":
            from_, to = (np.asarray(given.get(k) or at, float) for k, at in (("FROM", at_a), ("TO", at_b)))
        elif given.get("AT"):
            ground = np.asarray(given["AT"], float)
            from_, to = (ground if a == 0 else from_), (ground if b == 0 else to)
        line = _places(scene, b, to, frames) - _places(scene, a, from_, frames)
        # ends that meet have no direction
        line /= np.maximum(np.linalg.norm(line, axis=1), 1e-300)[:, None]
        return Direction(a, b, to, line, zero)

    axis = given.get("AXIS") or drawn.get("axis")
    if axis is None:
        return None
    if kind == "POINT_CYLINDER" and name == "ANGLE":
        e = shapes.unit(np.asarray(axis, float))
        on = np.asarray(given.get("ON") or at_a, float)
        gap = _places(scene, b, place, frames) - _places(scene, a, on, frames)
        along = _carried(scene, a, e, frames)
        across = gap - np.sum(gap * along, axis=1)[:, None] * along
        return Direction(a, b, place, np.cross(along, across) / np.sum(across**2, axis=1)[:, None], zero)
    if name == "ANGLE":
        return Direction(a, b, place, zero, turn(scene, a, b, axis, frames))
    if name in ("ANGLE_1", "ANGLE_2"):
        axes = triad(axis, given.get("AXIS2"))  # of the pins, which stay at right angles
        holder, pin = (a, axes[:, 0]) if name == "ANGLE_1" else (b, axes[:, 1])
        return Direction(a, b, place, zero, _carried(scene, holder, pin, frames))
    axes = triad(axis, given.get("DIR"))
    column = {"SLIDE": 0, "DISPLACEMENT": 0, "SLIDE_2": 1, "SLIDE_3": 2}.get(name)
    if column is None:
        return None
    return Direction(a, b, place, _carried(scene, a, axes[:, column], frames), zero)


def _places(scene: linkage.Places, node: int, point: np.ndarray, frames: Sequence[Frame]) -> np.ndarray:
    return np.array([(scene.transform(node, f) @ np.r_[point, 1.0])[:3] for f in frames])


def _carried(scene: linkage.Places, node: int, vector: np.ndarray, frames: Sequence[Frame]) -> np.ndarray:
    return np.array([scene.transform(node, f)[:3, :3] @ vector for f in frames])
