# SPDX-License-Identifier: BSD-3-Clause
"""The wheels of a model, each once, turned so that the teeth of every pair interlock."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .gear_mesh import WheelShape, frame_of
from .results import Element


@dataclass
class Wheel:
    """A wheel on a node: centre (reference position), frame (columns: axle, first contact direction, third),
    shape."""

    node: int
    center: np.ndarray
    frame: np.ndarray
    shape: WheelShape
    element: Element

    def angle_of(self, direction: np.ndarray) -> float:
        """Angle of a direction about the axle from the frame's second vector."""
        return float(np.arctan2(direction @ self.frame[:, 2], direction @ self.frame[:, 1]))


def _same(w: Wheel, node: int, center: np.ndarray, frame: np.ndarray, shape: WheelShape) -> bool:
    scale = max(shape.radius, 1e-300)
    # With profile shift a planet has a working pitch circle of its own in each mesh.
    cut = w.shape.thickness > 0 and shape.thickness > 0
    one, other = (w.shape.module, shape.module) if cut else (w.shape.radius, shape.radius)
    return (
        w.node == node
        and w.shape.teeth == shape.teeth
        and abs(one - other) < 1e-6 * max(other, 1e-300)
        and np.linalg.norm(w.center - center) < 1e-6 * scale
        and abs(w.frame[:, 0] @ frame[:, 0]) > 1 - 1e-6
        and w.shape.ring == shape.ring
    )


def collect(elements: list[Element]) -> list[Wheel]:
    """Wheels of all gear pairs. A sun wheel in three pairs appears once. The first wheel of a train keeps a
    tooth at its contact point; its partners are turned to show a gap there, and so on along the train. A
    closed train (planets between sun and ring) that does not come out even keeps the first choice."""
    wheels: list[Wheel] = []
    pairs: list[tuple[int, int, np.ndarray, np.ndarray]] = []
    for element in elements:
        drawn = [d for d in element.drawing if d.get("shape") == "wheel"]
        places = []
        for d in drawn:
            places.append((_add(wheels, d, element), np.asarray(d.get("toward", [1, 0, 0]), float)))
        if len(places) == 2:
            pairs.append((places[0][0], places[1][0], places[0][1], places[1][1]))
    placed: set[int] = set()
    while True:
        # Pairs that touch a wheel already placed come first: the train grows from its first wheel.
        ready = [p for p in pairs if (p[0] in placed) != (p[1] in placed)]
        if not ready:
            free = [p for p in pairs if p[0] not in placed and p[1] not in placed]
            if not free:
                return wheels
            placed.add(free[0][0])
            continue
        a, b, to_a, to_b = ready[0]
        if a in placed:
            _mate(wheels[a], wheels[b], to_a, to_b)
        else:
            _mate(wheels[b], wheels[a], to_b, to_a)
        placed.update((a, b))


def _add(wheels: list[Wheel], d: dict[str, Any], element: Element) -> int:
    shape = WheelShape.from_drawing(d)
    frame = frame_of(
        np.asarray(d.get("axis", [0, 0, 1]), float), np.asarray(d.get("toward", [1, 0, 0]), float)
    )
    center = np.asarray(d.get("center", [0, 0, 0]), float)
    node = int(d.get("node", 0))
    for i, w in enumerate(wheels):
        if _same(w, node, center, frame, shape):
            if shape.width > w.shape.width:
                w.shape = replace(w.shape, width=shape.width)
            return i
    wheels.append(Wheel(node, center, frame, shape, element))
    return len(wheels) - 1


def _mate(fixed: Wheel, free: Wheel, to_fixed: np.ndarray, to_free: np.ndarray) -> None:
    """Turns `free` so that it has a gap where `fixed` has a tooth, near their contact point."""
    contact = fixed.angle_of(to_fixed)
    offset = (fixed.shape.phase - contact + fixed.shape.pitch_angle / 2) % fixed.shape.pitch_angle
    offset -= fixed.shape.pitch_angle / 2
    tangent_fixed = np.cross(fixed.frame[:, 0], to_fixed)
    tangent_free = np.cross(free.frame[:, 0], to_free)
    sense = 1.0 if tangent_fixed @ tangent_free >= 0 else -1.0
    # One tooth pitch passes the contact point on both wheels together.
    share = sense * offset / fixed.shape.pitch_angle
    phase = free.angle_of(to_free) + (share + 0.5) * free.shape.pitch_angle
    free.shape = replace(free.shape, phase=float(phase))
