# SPDX-License-Identifier: BSD-3-Clause
"""Joints and the links between them: what a mechanism looks like where it has no wheels.

A body is drawn as bars from its node to every joint on it; a joint by its kind: pins, rails with a block,
plates with a ball, balls, crosses of universal joints, rods."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from . import shapes
from .graphics import pv
from .results import Element, Frame, Results

KINDS = {
    "HINGE": "pin",
    "CYLINDRICAL": "pin",
    "SCREW": "pin",
    "BEARING": "pin",
    "BUSHING": "pin",
    "PRISMATIC": "rail",
    "POINT_LINE": "rail",
    "PLANAR": "plate",
    "POINT_PLANE": "plate",
    "SPHERICAL": "ball",
    "UNIVERSAL": "cross",
    "WELD": "weld",
    "DISTANCE": "rod",
}
LINK_COLORS = ("#5d7fa3", "#b98545", "#6f9763", "#9a6f99", "#a9655a", "#568f90", "#7d7a52", "#7b6ba0")


class Places(Protocol):
    """What joints need to know of the scene that they are drawn in."""

    result: Results
    row: dict[int, int]  # of nodes
    points: dict[int, np.ndarray]  # of nodes, in the reference configuration
    size: float

    def transform(self, node: int, frame: Frame) -> np.ndarray: ...

    def axle(
        self, node: int, element: Element, center: np.ndarray, axis: np.ndarray
    ) -> tuple[float, float]: ...


@dataclass
class Joint:
    """A joint between nodes a and b (0: the ground), and its places on both in the reference."""

    element: Element
    kind: str
    a: int
    b: int
    place_a: np.ndarray
    place_b: np.ndarray
    axis: np.ndarray

    def ends(self) -> list[tuple[int, np.ndarray]]:
        return [(self.a, self.place_a), (self.b, self.place_b)]


def joint(scene: Places, element: Element) -> Joint | None:
    """The joint that an element is, or None. Places not given are found as the program does."""
    kind = KINDS.get(element.type.upper())
    if kind is None or len(element.nodes) != 2:
        return None
    a, b = element.nodes
    if any(n and n not in scene.row for n in (a, b)):
        return None
    given = element.parameters
    drawn = next((d for d in element.drawing if d.get("shape") == "axis"), {})
    at = given.get("AT") or drawn.get("center") or scene.points.get(b or a)
    place_a = place_b = np.asarray(at, float)
    if kind == "rod":
        place_a = np.asarray(given.get("FROM") or scene.points.get(a, np.zeros(3)), float)
        place_b = np.asarray(given.get("TO") or scene.points.get(b, np.zeros(3)), float)
    axis = shapes.unit(np.asarray(given.get("AXIS") or drawn.get("axis") or [0, 0, 1], float).ravel()[:3])
    return Joint(element, kind, a, b, place_a, place_b, axis)


def path(scene: Places, j: Joint) -> np.ndarray:
    """Where b's joint point has been, seen from a (n x 3, in the reference configuration)."""
    out = [np.zeros(3)]
    count = len(scene.result.frame_times)
    for i in range(0, count, max(1, count // 100)):
        frame = scene.result.frame(i)
        now = scene.transform(j.b, frame) @ np.r_[j.place_b, 1.0]
        back = np.linalg.inv(scene.transform(j.a, frame)) @ now
        out.append(back[:3] - j.place_a)
    return np.array(out)


def links(scene: Places, joints: list[Joint]) -> list[tuple[int, pv.PolyData]]:
    """Bars from nodes to the joints on their bodies: flat arms across parallel pins, else round ones."""
    out, done = [], []
    for j in joints:
        for node, place in j.ends():
            if node == 0 or any(n == node and np.linalg.norm(p - place) < 1e-9 for n, p in done):
                continue
            done.append((node, place))
            start, parts = scene.points[node], []
            foot, radius = place, 0.007 * scene.size
            if j.kind == "pin":
                _, radius = scene.axle(node if node == j.b else j.b, j.element, place, j.axis)
                foot = place - j.axis * ((place - start) @ j.axis)
                if np.linalg.norm(foot - start) > radius:
                    parts.append(shapes.arm(start, foot, j.axis, 1.6 * radius))
            elif np.linalg.norm(place - start) > radius:
                parts.append(shapes.tube(np.stack([start, place]), radius))
            if np.linalg.norm(place - foot) > radius:
                parts.append(shapes.tube(np.stack([foot, place]), radius))
            if parts:
                out.append((node, pv.merge(parts).extract_surface(algorithm="dataset_surface")))
    return out


def rail(scene: Places, j: Joint) -> tuple[pv.PolyData, pv.PolyData]:
    """A bar along the axis, as long as the joint travels, and the block on it (a bead for a point)."""
    radius = 0.008 * scene.size
    travel = path(scene, j) @ j.axis
    ends = np.array([travel.min() - 4 * radius, travel.max() + 4 * radius])
    bar = shapes.tube(j.place_a + np.outer(ends, j.axis), 0.7 * radius)
    if j.element.type.upper() == "PRISMATIC":
        block = pv.Cylinder(
            center=j.place_b, direction=j.axis, radius=2.2 * radius, height=5 * radius, resolution=4
        )
        return bar, block
    return bar, shapes.ball(j.place_b, 1.6 * radius)


def plate(scene: Places, j: Joint) -> tuple[pv.PolyData, pv.PolyData]:
    """A thin plate as large as the joint's travel on it, and a ball where the joint is."""
    radius = 0.008 * scene.size
    u, v = shapes.square_to(j.axis)
    # sides along the path: a slot is narrow
    travel = path(scene, j)
    travel = travel - np.outer(travel @ j.axis, j.axis)
    _, spread, main = np.linalg.svd(travel - travel.mean(axis=0), full_matrices=False)
    if spread[0] > 1e-6 * scene.size:
        u = shapes.unit(main[0] - j.axis * (main[0] @ j.axis))
        v = np.cross(j.axis, u)
    low, high = [np.array([f(travel @ d) for d in (u, v)]) for f in (np.min, np.max)]
    low, high = low - 3 * radius, high + 3 * radius
    mesh = pv.Cube(
        center=(0, 0, 0), x_length=high[0] - low[0], y_length=high[1] - low[1], z_length=0.5 * radius
    )
    middle = j.place_a + u * (low[0] + high[0]) / 2 + v * (low[1] + high[1]) / 2
    frame = np.eye(4)
    frame[:3, :3], frame[:3, 3] = np.stack([u, v, np.cross(u, v)], axis=1), middle
    return mesh.transform(frame, inplace=False), shapes.ball(j.place_b, 1.6 * radius)


def cross(scene: Places, j: Joint) -> tuple[pv.PolyData, pv.PolyData]:
    """The two pins of a universal joint, one for each body."""
    second = shapes.unit(np.asarray(j.element.parameters.get("AXIS2", [1, 0, 0]), float))
    radius = 0.007 * scene.size
    pins = [shapes.axle(j.place_a, d, 0.06 * scene.size, radius) for d in (j.axis, second)]
    return pins[0], pins[1]


def foot(scene: Places, place: np.ndarray) -> pv.PolyData:
    """What holds a joint without an axis to the ground: a small block."""
    return shapes.box(place, 0.028 * scene.size)
