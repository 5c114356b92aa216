# SPDX-License-Identifier: BSD-3-Clause
"""Writes result files as docs/format.md has them, with invented motion, for the tests of the
post-processor."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import h5py
import numpy as np

STEP = 1e-5
SPEED = 200.0  # rad/s of wheel A


def wheel(
    node: int, center, axis, toward, radius, teeth, module, width, cone=0.0, helix=0.0
) -> dict[str, Any]:
    return dict(
        shape="wheel",
        node=node,
        center=list(center),
        axis=list(axis),
        toward=list(toward),
        radius=radius,
        cone=cone,
        helix=helix,
        teeth=teeth,
        module=module,
        width=width,
    )


def write(
    path: Path,
    points: dict[int, tuple[float, float, float]],
    elements: list[dict[str, Any]],
    times: np.ndarray | None = None,
    displacement: np.ndarray | None = None,
    rotation: np.ndarray | None = None,
    velocity: np.ndarray | None = None,
    spin: np.ndarray | None = None,
    history: dict[str, tuple[np.ndarray, str, str]] | None = None,
    history_time: np.ndarray | None = None,
    title: str = "two wheels",
    status: str = "complete",
    units: bool = True,
    cells: list[tuple[int, list[int], int]] | None = None,
) -> Path:
    """One result file. `history` maps names below /history to values, unit and label; `cells` are (type code,
    0-based points, element)."""
    ids = list(points)
    with h5py.File(path, "w") as f:
        f.attrs.update(
            format="engrane",
            format_version=2,
            program="engrane test",
            title=title,
            status=status,
            analysis="DYNAMIC",
            libraries="none",
        )
        f["deck"] = "! none"
        f["model"] = json.dumps({"title": title, "elements": elements})
        f.create_group("units").attrs.update(given=int(units), length=1.0, mass=1.0, time=1.0)
        f["mesh/node_ids"] = np.array(ids)
        f["mesh/points"] = np.array([points[i] for i in ids], float)
        flat: list[int] = []
        owners: list[int] = []
        for code, nodes, owner in cells or []:
            flat += [code, *([len(nodes)] if code == 2 else []), *nodes]
            owners.append(owner)
        f["mesh/topology"] = np.array(flat, int)
        f["mesh/cell_elements"] = np.array(owners, int)
        if times is not None:
            f["fields/time"] = times
            f["fields/time"].attrs["unit"] = "s"
            for name, data, unit in (
                ("displacement", displacement, "m"),
                ("rotation", rotation, "rad"),
                ("velocity", velocity, "m/s"),
                ("angular_velocity", spin, "rad/s"),
            ):
                if data is not None:
                    f.create_group(f"fields/{name}").attrs["unit"] = unit
                    for i, frame in enumerate(data):
                        f[f"fields/{name}/{i:06d}"] = frame
        if history is not None and history_time is not None:
            f["history/time"] = history_time
            f["history/time"].attrs["unit"] = "s" if units else "[time]"
            types = {e["id"]: e["type"] for e in elements}
            tables: dict[tuple[str, tuple[str, ...]], dict[int, list[tuple[np.ndarray, str, str]]]] = {}
            owners_of: dict[str, list[str]] = {}
            for name in history:
                owner, _, channel = name.rpartition("/")
                owners_of.setdefault(owner, []).append(channel)
            for owner, channels in owners_of.items():
                kind, _, number = owner.partition("/")
                path_of = {"element": f"element/{types.get(int(number or 0))}", "node": "node/NODE"}.get(
                    kind, kind
                )
                columns = [history[f"{owner}/{c}"] for c in channels]
                tables.setdefault((path_of, tuple(channels)), {})[int(number or 0)] = columns
            for i, ((place, channels), members) in enumerate(tables.items()):
                group = f.create_group(f"history/{place}" + (f"_{i}" if f"history/{place}" in f else ""))
                group["values"] = np.stack([c[0] for columns in members.values() for c in columns], axis=1)
                group["channels"] = np.array(channels, "S")
                first = next(iter(members.values()))
                group["units"] = np.array([c[1].encode() for c in first], "S")
                group["labels"] = np.array([c[2].encode() for c in first], "S")
                if "/" in place:
                    group["ids"] = np.array(list(members), np.int32)
                if place.startswith("element/"):
                    group.attrs["type"] = place.split("/")[1]
    return path


def spin_vector(axis, angles: np.ndarray) -> np.ndarray:
    """Rotation vectors about one axis, of length at most pi."""
    wrapped = (np.asarray(angles) + np.pi) % (2 * np.pi) - np.pi
    return np.outer(wrapped, np.asarray(axis, float) / np.linalg.norm(axis))


def two_wheels(
    path: Path, status: str = "complete", samples: int = 4001, frames: int = 9, **changes: Any
) -> Path:
    """Spur pair 20 : 40 on two hinges, wheel A at 200 rad/s, with a force that oscillates at the tooth
    frequency."""
    points = {1: (0.0, 0.0, 0.0), 2: (0.15, 0.0, 0.0), 3: (0.0, 0.0, 0.2), 4: (0.15, 0.0, -0.15)}
    z = [20, 40]
    elements = [
        dict(
            id=1,
            type="HINGE",
            nodes=[0, 1],
            parameters={"AXIS": [0, 0, 1]},
            drawing=[dict(shape="axis", node=1, center=[0, 0, 0], axis=[0, 0, 1])],
        ),
        dict(
            id=2,
            type="HINGE",
            nodes=[0, 2],
            parameters={"AXIS": [0, 0, 1]},
            drawing=[dict(shape="axis", node=2, center=[0.15, 0, 0], axis=[0, 0, 1])],
        ),
        dict(
            id=5,
            type="TSPRING",
            nodes=[3, 1],
            parameters={"AXIS": [0, 0, 1]},
            drawing=[dict(shape="coil", points=[3, 1])],
        ),
        dict(id=6, type="RIGID", nodes=[2, 4], parameters={}, drawing=[dict(shape="body", nodes=[2, 4])]),
        dict(
            id=7,
            type="GEAR",
            nodes=[1, 2],
            name="pair",
            parameters={"Z": z, "MN": 0.005, "ALPHA": 20.0, "AXIS": [0, 0, 1]},
            drawing=[
                wheel(1, (0, 0, 0), (0, 0, 1), (1, 0, 0), 0.05, 20, 0.005, 0.03),
                wheel(2, (0.15, 0, 0), (0, 0, 1), (-1, 0, 0), 0.1, 40, 0.005, 0.03),
            ],
        ),
        dict(id=8, type="INERTIA", nodes=[4], parameters={}, drawing=[dict(shape="mass", node=4)]),
        dict(
            id=9,
            type="TORQUE",
            nodes=[4],
            parameters={},
            drawing=[dict(shape="arrow", node=4, center=[0.15, 0, -0.15], axis=[0, 0, 1])],
        ),
    ]
    t = STEP * np.arange(samples)
    tooth = SPEED * z[0] / (2 * np.pi)
    force = 500 + 80 * np.sin(2 * np.pi * tooth * t) + 20 * np.sin(4 * np.pi * tooth * t)
    history = {
        "element/7/NORMAL_FORCE": (force, "N", "normal force"),
        "element/7/U_M": (1e-6 * np.cos(2 * np.pi * tooth * t), "m", "tooth deflection"),
        "node/1/WZ": (np.full_like(t, SPEED), "rad/s", "angular velocity z"),
        "node/2/UX": (1e-5 * np.sin(300 * t), "m", "displacement x"),
        "run/KINETIC_ENERGY": (np.full_like(t, 3.0), "J", "kinetic energy"),
    }
    history.update(changes.pop("history", {}))
    times = np.linspace(0, t[-1] / 100, frames)
    n = len(points)
    rotation = np.zeros((frames, n, 3))
    rotation[:, 0] = rotation[:, 2] = spin_vector((0, 0, 1), SPEED * times)
    rotation[:, 1] = rotation[:, 3] = spin_vector((0, 0, 1), -SPEED / 2 * times)
    spin = np.zeros((frames, n, 3))
    spin[:, [0, 2], 2] = SPEED
    spin[:, [1, 3], 2] = -SPEED / 2
    zero = np.zeros((frames, n, 3))
    return write(
        path,
        points,
        elements,
        times,
        zero,
        rotation,
        zero,
        spin,
        history,
        t,
        **({"title": "two wheels", "status": status} | changes),
    )


def planetary(path: Path) -> Path:
    """Sun 24, three planets 18, ring 60 held; the carrier turns 2/7 as fast as the sun."""
    m = 0.004
    z_s, z_p, z_r = 24, 18, 60
    r_s, r_p, r_r = z_s * m / 2, z_p * m / 2, z_r * m / 2
    turn = np.array([0, 2 * np.pi / 3, 4 * np.pi / 3])
    out = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=-1)
    points = {1: (0, 0, 0), 2: (0, 0, 0), 3: (0, 0, 0.03)}
    points |= {10 + i: tuple((r_s + r_p) * d) for i, d in enumerate(out)}
    elements: list[dict[str, Any]] = []
    for i, d in enumerate(out):
        c = points[10 + i]
        sun = wheel(1, (0, 0, 0), (0, 0, 1), d, r_s, z_s, m, 0.02)
        planet = wheel(10 + i, c, (0, 0, 1), -d, r_p, z_p, m, 0.02)
        elements.append(
            dict(
                id=20 + i, type="GEAR", nodes=[1, 10 + i], parameters={"Z": [z_s, z_p]}, drawing=[sun, planet]
            )
        )
        outer = wheel(10 + i, c, (0, 0, 1), d, r_p, z_p, m, 0.02)
        ring = wheel(2, (0, 0, 0), (0, 0, 1), d, r_r, z_r, m, 0.02, cone=180)
        elements.append(
            dict(
                id=30 + i, type="GEAR", nodes=[10 + i, 2], parameters={"Z": [z_p, z_r]}, drawing=[outer, ring]
            )
        )
        elements.append(
            dict(
                id=40 + i,
                type="HINGE",
                nodes=[3, 10 + i],
                parameters={},
                drawing=[dict(shape="axis", node=3, center=c, axis=[0, 0, 1])],
            )
        )
    elements.append(
        dict(
            id=50,
            type="RIGID",
            nodes=[3, 10, 11, 12],
            parameters={},
            drawing=[dict(shape="body", nodes=[3, 10, 11, 12])],
        )
    )
    frames = 25
    sun_turn = np.linspace(0, 1.2, frames)
    carrier = sun_turn * 2 / 7
    planet = carrier - (sun_turn - carrier) * z_s / z_p
    ids = list(points)
    u, r = np.zeros((frames, len(ids), 3)), np.zeros((frames, len(ids), 3))
    v, w = np.zeros_like(u), np.zeros_like(u)
    r[:, 0], r[:, 2] = spin_vector((0, 0, 1), sun_turn), spin_vector((0, 0, 1), carrier)
    w[:, 0, 2], w[:, 2, 2] = 1.0, 2 / 7
    for k in range(3):
        start = np.array(points[10 + k])
        r[:, 3 + k] = spin_vector((0, 0, 1), planet)
        w[:, 3 + k, 2] = -2 / 3
        now = (r_s + r_p) * np.stack(
            [np.cos(turn[k] + carrier), np.sin(turn[k] + carrier), 0 * carrier], axis=-1
        )
        u[:, 3 + k] = now - start
        v[:, 3 + k] = 2 / 7 * np.stack([-now[:, 1], now[:, 0], 0 * carrier], axis=-1)
    return write(
        path, points, elements, np.linspace(0, 1.2, frames), u, r, v, w, title="planetary set 24-18-60"
    )


def bevel(path: Path) -> Path:
    """The straight bevel pair of the paper, bar turned by one radian."""
    points = {1: (0, 0, 0), 2: (0, 1, 5), 3: (0, 1, 5), 4: (0, 1, 0)}
    cone_a, cone_b = -np.degrees(np.arctan(5)), -np.degrees(np.arctan(0.2))
    elements = [
        dict(
            id=1,
            type="GEAR",
            nodes=[1, 2],
            parameters={"Z": [50, 10]},
            drawing=[
                wheel(1, (0, 0, 0), (0, 1, 0), (0, 0, 1), 5, 50, 0.2, 1.2, cone_a),
                wheel(2, (0, 1, 5), (0, 0, -1), (0, -1, 0), 1, 10, 0.2, 1.2, cone_b),
            ],
        ),
        dict(id=2, type="RIGID", nodes=[4, 3], drawing=[dict(shape="body", nodes=[4, 3])]),
        dict(
            id=3,
            type="HINGE",
            nodes=[3, 2],
            drawing=[dict(shape="axis", node=3, center=[0, 1, 5], axis=[0, 0, -1])],
        ),
        dict(
            id=4,
            type="HINGE",
            nodes=[0, 4],
            drawing=[dict(shape="axis", node=4, center=[0, 1, 0], axis=[0, 1, 0])],
        ),
        dict(
            id=5,
            type="TORQUE",
            nodes=[3, 2],
            drawing=[dict(shape="arrow", node=2, center=[0, 1, 5], axis=[0, 0, -1])],
        ),
    ]
    from scipy.spatial.transform import Rotation

    frames = 11
    turn = np.linspace(0, 1, frames)
    u, r = np.zeros((frames, 4, 3)), np.zeros((frames, 4, 3))
    for k, a in enumerate(turn):
        bar = Rotation.from_rotvec([0, a, 0])
        moved = bar.apply([0, 0, 5]) + np.array([0, 1, 0])
        u[k, 1] = u[k, 2] = moved - np.array([0, 1, 5])
        r[k, 2] = r[k, 3] = bar.as_rotvec()
        r[k, 1] = (bar * Rotation.from_rotvec([0, 0, 5 * a])).as_rotvec()
    return write(path, points, elements, turn, u, r, title="straight bevel pair", units=False)
