# SPDX-License-Identifier: BSD-3-Clause
"""Surface meshes of toothed wheels from their few numbers: for the eye, not for contact."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

ADDENDUM, DEDENDUM, RIM = 1.0, 1.25, 1.7  # in modules
PRESSURE = np.radians(20.0)
SLIM = 0.95  # teeth a little thinner than the gap, so that the gap of a pair shows
MOST_TEETH = 600
STEEP = np.radians(60.0)  # a helix beyond is a worm's
SMALL_TURN = np.radians(7.0)  # of one facet


@dataclass(frozen=True)
class WheelShape:
    """A wheel in its own frame: centre at the origin, axle along +x, the contact point along +y.

    radius (pitch, at the contact point), teeth, module, cone (radians; 0 cylinder, pi ring gear), helix
    (radians, right hand positive), width (along the teeth), phase (turn of the nearest tooth's middle from +y
    about +x, radians). Of teeth with profile shift: addendum and dedendum (heights from the pitch
    circle), thickness (of the tooth along it) and pressure angle (radians, there); zero without."""

    radius: float
    teeth: int
    module: float
    cone: float = 0.0
    helix: float = 0.0
    width: float = 0.0
    phase: float = 0.0
    addendum: float = 0.0
    dedendum: float = 0.0
    thickness: float = 0.0
    pressure: float = PRESSURE

    @classmethod
    def from_drawing(cls, d: dict[str, Any]) -> WheelShape:
        """From a `wheel` entry of /model; what is missing or odd is replaced by something that can be
        drawn."""
        radius = abs(float(d.get("radius") or 1.0))
        teeth = int(min(max(d.get("teeth") or 20, 3), MOST_TEETH))
        module = abs(float(d.get("module") or 0.0)) or 2 * radius / teeth
        # A drawn tooth follows the circle, or a wheel whose data do not close would look like a saw blade.
        module = min(module, 2.2 * radius / teeth)
        width = abs(float(d.get("width") or 0.0)) or min(10 * module, 0.6 * radius)
        cone = np.radians(float(d.get("cone") or 0.0))
        helix = np.radians(np.clip(float(d.get("helix") or 0.0), -85.0, 85.0))
        shape = cls(radius, teeth, module, float(cone), float(helix), width)
        heights = [abs(float(d.get(name) or 0.0)) for name in ("addendum", "dedendum", "thickness")]
        if not (0 < max(heights[:2]) < 4 * module and 0 < heights[2] < 2 * np.pi * radius / teeth):
            return shape
        angle = np.radians(np.clip(float(d.get("pressure_angle") or 20.0), 1.0, 60.0))
        return replace(
            shape, addendum=heights[0], dedendum=heights[1], thickness=heights[2], pressure=float(angle)
        )

    @property
    def ring(self) -> bool:
        """Teeth on the inside."""
        return np.cos(self.cone) < -1e-6

    @property
    def pitch_angle(self) -> float:
        return 2 * np.pi / self.teeth

    def span(self) -> tuple[float, float]:
        """Extent along the teeth from the contact point; a cone's teeth end well before the apex."""
        half = self.width / 2
        if abs(self.helix) > STEEP:
            # WIDTH is the wheel's; its worm reaches beyond.
            half = max(1.1 * self.width, 0.9 * self.radius)
        low, high = -half, half
        shrink = np.sin(self.cone)
        if shrink < -1e-9:
            # The large end is where the contact point is usually given: show the wheel from there inwards.
            low, high = -0.15 * self.width, 0.85 * self.width
            high = min(high, 0.75 * self.radius / -shrink)
        elif shrink > 1e-9:
            low, high = -0.85 * self.width, 0.15 * self.width
            low = max(low, -0.75 * self.radius / shrink)
        return low, high

    def place(self, s: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Axial and radial position of a point at s along the tooth and v above the pitch surface."""
        sg, cg = np.sin(self.cone), np.cos(self.cone)
        scale = 1 + s * sg / self.radius
        return s * cg - v * scale * sg, self.radius + s * sg + v * scale * cg

    def twist(self, s: np.ndarray) -> np.ndarray:
        """Turn of the tooth's middle about the axle along the tooth."""
        sg = np.sin(self.cone)
        hand = 1.0 if np.cos(self.cone) >= -1e-9 else -1.0
        arc = s / self.radius if abs(sg) < 1e-09 else np.log1p(s * sg / self.radius) / sg
        return hand * np.tan(self.helix) * arc

    def half_thickness(self, v: np.ndarray) -> np.ndarray:
        """Half the tooth's thickness (length) at height v, at the contact point's section."""
        m = 2 * self.radius / self.teeth
        cg = np.cos(self.cone)
        # Across the axle a tooth is wider than across itself, by 1/cos(helix).
        half = SLIM * (self.thickness or np.pi * m / 2) / 2
        straight = half - v * np.tan(PRESSURE) / np.cos(self.helix)
        if cg < 0.05 or abs(self.helix) > STEEP:
            return np.maximum(straight, 0.08 * m)
        r = self.radius / cg
        angle = np.arccos(np.clip(r * np.cos(self.pressure) / (r + v), 0, 1))
        involute = np.tan(angle) - angle
        at_pitch = np.tan(self.pressure) - self.pressure
        return np.maximum((r + v) * (half / r + at_pitch - involute), 0.08 * m)


def profile(shape: WheelShape) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """One turn of the tooth outline: angle about the axle, height above the pitch surface, tooth number;
    counterclockwise."""
    m = shape.module
    heights = np.array([-DEDENDUM, -0.7, 0.0, 0.55, ADDENDUM]) * m
    if shape.thickness > 0:
        heights = (
            np.array([-1, -0.56, 0, 0, 0]) * shape.dedendum + np.array([0, 0, 0, 0.55, 1]) * shape.addendum
        )
    _, radial = shape.place(np.zeros_like(heights), heights)
    half = shape.half_thickness(heights) / np.maximum(radial, 0.1 * shape.radius)
    # A root as wide as the pitch would close the gap between neighbours.
    half = np.minimum(half, 0.46 * shape.pitch_angle)
    # Flank up, tip, flank down, root: few teeth need more points, or their arcs would be cut short.
    flank = _refined(-half, heights)
    tip = _refined(np.array([-half[-1], half[-1]]), heights[[-1, -1]])
    root = _refined(np.array([half[0], shape.pitch_angle - half[0]]), heights[[0, 0]])
    angle = np.r_[flank[0], tip[0][1:-1], -flank[0][::-1], root[0][1:-1]]
    height = np.r_[flank[1], tip[1][1:-1], flank[1][::-1], root[1][1:-1]]
    turns = np.arange(shape.teeth) * shape.pitch_angle + shape.phase
    return (
        (turns[:, None] + angle).ravel(),
        np.tile(height, shape.teeth),
        np.repeat(np.arange(shape.teeth), len(angle)),
    )


def _refined(angle: np.ndarray, height: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The same line with no facet that turns by more than SMALL_TURN."""
    parts = np.maximum(1, np.ceil(np.abs(np.diff(angle)) / SMALL_TURN)).astype(int)
    at = np.concatenate([i + np.arange(n) / n for i, n in enumerate(parts)] + [[len(angle) - 1.0]])
    index = np.arange(len(angle))
    return np.interp(at, index, angle), np.interp(at, index, height)


def _sweep(axial: np.ndarray, radial: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points and quads of a closed section (p x a arrays) closed also around the axle."""
    p, a = axial.shape
    points = np.stack([axial, radial * np.cos(angle), radial * np.sin(angle)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(p), np.arange(a), indexing="ij")
    i2, j2 = (i + 1) % p, (j + 1) % a
    quads = np.stack([i * a + j, i2 * a + j, i2 * a + j2, i * a + j2], axis=-1).reshape(-1, 4)
    return points, quads


def teeth_mesh(shape: WheelShape) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Toothed rim: points (n x 3), quads (q x 4) and 1 for the quads of the marked tooth, which shows the
    wheel's turn."""
    low, high = shape.span()
    turn = float(np.ptp(shape.twist(np.array([low, high]))))
    sections = 2 if abs(shape.helix) < 1e-6 else int(np.clip(np.ceil(turn / SMALL_TURN), 9, 400))
    s = np.linspace(low, high, sections)
    angle, height, tooth = profile(shape)
    depth = -(DEDENDUM + RIM) * shape.module
    _, inner = shape.place(np.zeros(1), np.array([depth]))
    if not shape.ring and np.cos(shape.cone) > 0.3 and inner[0] < 0.15 * shape.radius:
        depth = -(DEDENDUM + 0.4) * shape.module
    ss = np.r_[s, s[::-1]][:, None] + 0 * angle
    vv = np.r_[np.tile(height, (sections, 1)), np.full((sections, len(angle)), depth)]
    axial, radial = shape.place(ss, vv)
    points, quads = _sweep(axial, np.maximum(radial, 0.02 * shape.radius), angle + shape.twist(ss))
    column = np.tile(np.arange(len(angle)), 2 * sections)
    row = np.repeat(np.arange(2 * sections), len(angle))
    # Colour the outside and the end faces of tooth 0, not its root nor the inside of the rim.
    following = np.roll(tooth, -1)[column]
    marked = (tooth[column] == 0) & (following == 0) & (row != 2 * sections - 1) & (row < sections - 1)
    return points, quads, marked.astype(np.uint8)


def web_mesh(shape: WheelShape, hub: float = 0.26, bore: float = 0.13) -> list[tuple[np.ndarray, np.ndarray]]:
    """Disc between the rim and the hub, and the hub; nothing for a ring gear."""
    if shape.ring:
        return []
    low, high = shape.span()
    depth = -(DEDENDUM + RIM * 0.8) * shape.module
    axial, radial = shape.place(np.array([low, (low + high) / 2, high]), np.full(3, depth))
    inner, outer = bore * shape.radius, max(float(radial[1]), 1.3 * bore * shape.radius)
    middle = float(axial[1])
    thick = max(0.30 * np.ptp(axial), 0.05 * shape.radius)
    if abs(np.sin(shape.cone)) > 0.7:
        thick = max(0.05 * shape.radius, 0.5 * shape.module)
    if abs(shape.helix) > STEEP:
        thick = np.ptp(axial)
    rings = [tube_mesh(middle - thick / 2, middle + thick / 2, inner, outer)]
    hub_length = max(1.08 * np.ptp(axial), 2.2 * thick)
    if hub * shape.radius < 0.9 * outer:
        rings.append(tube_mesh(middle - hub_length / 2, middle + hub_length / 2, inner, hub * shape.radius))
    return rings


def tube_mesh(x0: float, x1: float, r0: float, r1: float, n: int = 72) -> tuple[np.ndarray, np.ndarray]:
    """Hollow cylinder along x."""
    angle = np.linspace(0, 2 * np.pi, n, endpoint=False)
    one = np.ones_like(angle)
    axial = np.array([x0, x1, x1, x0])[:, None] * one
    radial = np.array([r1, r1, r0, r0])[:, None] * one
    return _sweep(axial, radial, np.tile(angle, (4, 1)))


def holes(shape: WheelShape, count: int = 5) -> tuple[float, float, float, np.ndarray] | None:
    """Dark discs on the web that show the turn: axial position of both faces, radius of a hole, centres
    (count x 2)."""
    if shape.ring or abs(np.sin(shape.cone)) > 0.7 or abs(shape.helix) > STEEP:
        return None
    low, high = shape.span()
    depth = -(DEDENDUM + RIM) * shape.module
    axial, radial = shape.place(np.array([low, (low + high) / 2, high]), np.full(3, depth))
    outer, hub = float(radial[1]), 0.26 * shape.radius
    if outer - hub < 0.25 * shape.radius:
        return None
    thick = max(0.30 * np.ptp(axial), 0.05 * shape.radius)
    middle = (outer + hub) / 2
    turn = shape.phase + np.arange(count) * 2 * np.pi / count
    centres = middle * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    return float(axial[1]), thick / 2 * 1.01, 0.3 * (outer - hub), centres


def frame_of(axis: np.ndarray, toward: np.ndarray) -> np.ndarray:
    """Rotation matrix whose columns are the axle, the direction to the contact point made square to it, and
    their product."""
    a = np.asarray(axis, float)
    a = a / (np.linalg.norm(a) or 1.0)
    b = np.asarray(toward, float) - a * (a @ np.asarray(toward, float))
    if np.linalg.norm(b) < 1e-9:
        b = np.cross(a, [1.0, 0, 0] if abs(a[0]) < 0.9 else [0, 1.0, 0])
    b = b / np.linalg.norm(b)
    return np.stack([a, b, np.cross(a, b)], axis=1)
