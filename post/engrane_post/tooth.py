# SPDX-License-Identifier: BSD-3-Clause
"""Tooth frequencies of the gear pairs in a result."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .results import Element, Results


@dataclass(frozen=True)
class ToothFrequency:
    """Mean tooth frequency (1/time) of one gear pair over a span, and what it was taken from."""

    title: str
    frequency: float
    source: str


def tooth_frequencies(result: Results, start: float, end: float) -> list[ToothFrequency]:
    """One entry for each GEAR whose wheels turn and whose speed the file holds: |mean speed relative to the
    line of centres| * Z / 2 pi."""
    out = []
    for element in result.elements:
        if element.type.upper() != "GEAR" or len(element.nodes) < 2:
            continue
        teeth = tooth_numbers(element)
        if not teeth:
            continue
        for source in (_from_turn, _from_frames, _from_nodes):
            speed = source(result, element, start, end)
            if speed is not None and speed[0] > 1e-9:
                out.append(ToothFrequency(element.title, speed[0] * teeth[0] / (2 * np.pi), speed[1]))
                break
    return out


def tooth_numbers(element: Element) -> list[float]:
    """Numbers of teeth of the pair, or nothing."""
    z = element.parameters.get("Z")
    if isinstance(z, (list, tuple)) and z and all(isinstance(v, (int, float)) for v in z):
        return [float(v) for v in z]
    wheels = [d for d in element.drawing if d.get("shape") == "wheel" and d.get("teeth")]
    return [float(d["teeth"]) for d in wheels]


def _window(result: Results, name: str, start: float, end: float) -> tuple[np.ndarray, np.ndarray] | None:
    if name not in result.channels:
        return None
    t, y = result.history(result.channels[name], start, end)
    good = np.isfinite(y)
    return (t[good], y[good]) if good.sum() >= 2 else None


def _from_turn(result: Results, element: Element, start: float, end: float) -> tuple[float, str] | None:
    """Slope of the wheel's turn relative to the pair, when the element records it."""
    for name in ("PSI_A", "ANGLE_A", "TURN_A"):
        data = _window(result, f"element/{element.id}/{name}", start, end)
        if data is not None and data[0][-1] > data[0][0]:
            t, psi = data
            return abs(psi[-1] - psi[0]) / (t[-1] - t[0]), name
    return None


def _wheel_a(element: Element) -> tuple[int, np.ndarray]:
    """Node and reference axis of the first wheel."""
    wheels = [d for d in element.drawing if d.get("shape") == "wheel"]
    node = int(wheels[0].get("node", element.nodes[0])) if wheels else element.nodes[0]
    axis = np.asarray(wheels[0]["axis"] if wheels else element.parameters.get("AXIS", [0, 0, 1]), float)
    return node, axis / np.linalg.norm(axis)


def _from_nodes(result: Results, element: Element, start: float, end: float) -> tuple[float, str] | None:
    """Mean angular velocity of the wheel's node along the reference axis; exact while the line of centres
    stands."""
    node, axis = _wheel_a(element)
    data = [_window(result, f"node/{node}/W{c}", start, end) for c in "XYZ"]
    if all(d is None for d in data):
        return None
    return abs(sum(a * d[1].mean() for a, d in zip(axis, data, strict=True) if d is not None)), f"node {node}"


def _from_frames(result: Results, element: Element, start: float, end: float) -> tuple[float, str] | None:
    """Speed of the wheel less that of the line of centres (which turns in planetary trains), averaged over
    the frames."""
    names = ("displacement", "rotation", "velocity", "angular_velocity")
    if not result.has_fields(*names):
        return None
    times = result.frame_times
    inside = np.flatnonzero((times >= start) & (times <= end))[:2000]
    _, axis = _wheel_a(element)
    ids = result.node_ids.tolist()
    if len(inside) == 0 or any(n not in ids for n in element.nodes[:2]):
        return None
    a, b = ids.index(element.nodes[0]), ids.index(element.nodes[1])
    from scipy.spatial.transform import Rotation

    speeds = []
    for i in inside:
        u, r, v, w = (result.field(n, int(i)) for n in names)
        if u is None or r is None or v is None or w is None:
            return None
        x = result.points + u
        turned = Rotation.from_rotvec(np.nan_to_num(r[a])).apply(axis)
        line = x[b] - x[a]
        line = line - turned * (line @ turned)
        frame = np.cross(line, v[b] - v[a]) @ turned / (line @ line) if line @ line > 0 else 0.0
        speeds.append(w[a] @ turned - frame)
    speed = float(np.nanmean(speeds))
    return (abs(speed), f"{len(inside)} frames") if np.isfinite(speed) else None
