# SPDX-License-Identifier: BSD-3-Clause
"""Arrows of loads: fixed in space or held by a node, of the sign that the load has at the frame, straight for
forces and round for moments; and what joins bearings to their nodes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import models
import numpy as np
import pytest
from engrane_post import Results

FORCE, MOMENT = [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]
TIMES = np.array([0.0, 1.0, 2.0, 3.0])
FACTOR = np.array([1.0, 1.0, -2.0, 0.0])  # of the loads: forwards, forwards, backwards, none


def arrow(axis: list[float], **more: Any) -> dict[str, Any]:
    return dict(shape="arrow", node=2, center=[1, 0, 0], axis=axis, **more)


def arm(path: Path, frame_times: np.ndarray = TIMES, recorded: str = "element/") -> Path:
    """Nodes 1 and 2 turn about z by a quarter a second. FORCE 3 is fixed in space, FORCE 4 (V < 0) follows, 5
    is a .CLM load of a force and a moment, TORQUE 6 has an axis held by node 1."""
    elements = [
        dict(id=3, type="FORCE", nodes=[2], parameters={"V": 5}, drawing=[arrow(FORCE, holder=0)]),
        dict(id=4, type="FORCE", nodes=[2], parameters={"V": -5}, drawing=[arrow(FORCE, holder=2)]),
        dict(
            id=5,
            type="CHA",
            nodes=[2],
            parameters={"C": [2, 4], "V": [-4, 3]},
            drawing=[arrow(FORCE, couple=False, holder=0), arrow(MOMENT, couple=True, holder=0)],
        ),
        dict(
            id=6,
            type="TORQUE",
            nodes=[1, 2],
            parameters={"V": 2},
            drawing=[arrow(MOMENT, couple=True, holder=1)],
        ),
    ]
    angle = np.pi / 2 * frame_times
    turn, shift = np.zeros((len(angle), 2, 3)), np.zeros((len(angle), 2, 3))
    turn[:, :, 2] = angle[:, None]
    shift[:, 1] = np.stack([np.cos(angle) - 1, np.sin(angle), 0 * angle], axis=1)
    spin, velocity = np.zeros_like(turn), np.zeros_like(shift)
    spin[:, :, 2] = np.pi / 2
    velocity[:, 1] = np.pi / 2 * np.stack([-np.sin(angle), np.cos(angle), 0 * angle], axis=1)
    history = {
        "element/3/FORCE": 5 * FACTOR,
        "element/4/FORCE": -5 * FACTOR,
        "element/5/FORCE_X": 0 * FACTOR,
        "element/5/FORCE_Y": -4 * FACTOR,
        "element/5/FORCE_Z": 0 * FACTOR,
        "element/5/MOMENT_X": 3 * FACTOR,
        "element/5/MOMENT_Y": 0 * FACTOR,
        "element/5/MOMENT_Z": 0 * FACTOR,
        "element/6/TORQUE": 2 * FACTOR,
    }
    return models.write(
        path,
        {1: (0.0, 0.0, 0.0), 2: (1.0, 0.0, 0.0)},
        elements,
        frame_times,
        shift,
        turn,
        velocity,
        spin,
        history={name: (v, "N", "load") for name, v in history.items() if name.startswith(recorded)},
        history_time=TIMES,
    )


def sight(points: np.ndarray, couple: bool, tip: np.ndarray) -> np.ndarray:
    """The direction that an arrow's surface shows: from its middle to the tip, which is at the node; of an
    arc the axis about which it goes from its end without a head to the other."""
    if not couple:
        assert np.linalg.norm(points - tip, axis=1).min() < 1e-6
        return (tip - points.mean(axis=0)) / np.linalg.norm(tip - points.mean(axis=0))
    middles = points.reshape(-1, 12, 3).mean(axis=1) - tip  # of rings of points along the arc
    around = np.cross(middles[:-1], middles[1:]).sum(axis=0)
    return around / np.linalg.norm(around)


def shown(path: Path, k: int) -> dict[tuple[int, bool], np.ndarray]:
    """For each element's force (False) and moment (True): its direction in the k-th frame."""
    from engrane_post.scene import Scene

    with Results(path) as result:
        scene = Scene(result)
        frame = result.frame(k)
        out = {}
        for item in scene.items:
            if item.arrow is not None:
                pose = scene.pose(item, frame)
                points = item.mesh.points @ pose[:3, :3].T + pose[:3, 3]
                tip = scene.positions(frame)[2]
                couple = item.arrow.couple
                out[item.element, couple] = sight(points[: 60 * 12] if couple else points, couple, tip)
        return out


def test_loads_keep_their_direction_in_space(tmp_path: Path) -> None:
    seen = shown(arm(tmp_path / "arm.h5"), 1)  # after a quarter turn
    assert seen[3, False] == pytest.approx([0, -1, 0], abs=0.02)
    assert seen[4, False] == pytest.approx([1, 0, 0], abs=0.02)  # -y has turned to x
    assert seen[5, False] == pytest.approx([0, -1, 0], abs=0.02)
    assert seen[5, True] == pytest.approx([1, 0, 0], abs=0.02)
    assert seen[6, True] == pytest.approx([0, 1, 0], abs=0.02)


def test_a_negative_function_reverses_them(tmp_path: Path) -> None:
    seen = shown(arm(tmp_path / "arm.h5"), 2)  # after half a turn
    assert seen[3, False] == pytest.approx([0, 1, 0], abs=0.02)
    assert seen[4, False] == pytest.approx([0, -1, 0], abs=0.02)  # turned and reversed
    assert seen[5, False] == pytest.approx([0, 1, 0], abs=0.02)
    assert seen[5, True] == pytest.approx([-1, 0, 0], abs=0.02)
    assert seen[6, True] == pytest.approx([1, 0, 0], abs=0.02)


def test_without_histories_the_value_tells(tmp_path: Path) -> None:
    seen = shown(arm(tmp_path / "arm.h5", recorded="element/5/FORCE_Y"), 2)
    assert seen[3, False] == pytest.approx([0, -1, 0], abs=0.02)
    assert seen[5, False] == pytest.approx([0, 1, 0], abs=0.02)  # its one component is enough


def test_frames_between_the_samples(tmp_path: Path) -> None:
    """The loads pass zero at 1.33: just after it, nearest to the sample before, they are reversed."""
    path = arm(tmp_path / "arm.h5", np.array([1.3, 1.4]))
    assert shown(path, 0)[3, False][1] == pytest.approx(-1, abs=0.02)
    assert shown(path, 1)[3, False][1] == pytest.approx(1, abs=0.02)


def test_export(tmp_path: Path) -> None:
    """The same surfaces, with the velocity that they have; what does not act has no size."""
    from engrane_post.scene import Scene
    from engrane_post.surfaces import Surfaces

    with Results(arm(tmp_path / "arm.h5")) as result:
        surfaces = Surfaces(Scene(result))
        frame = result.frame(1)
        step = surfaces.step(frame)
        after = surfaces.mesh
        part = np.repeat(after.cell_data["part"], np.diff(after.offsets))
        for p in surfaces.parts:
            if p.item.arrow is None:
                continue
            own = np.unique(after.connectivity[part == surfaces.parts.index(p)])
            spin = np.pi / 2 * bool(p.item.arrow.holder)
            arms = step.points[own] - np.array([0, 1, 0])
            expected = np.cross([0, 0, spin], arms) + np.array([-np.pi / 2, 0, 0])
            assert step.point_data["velocity"][own] == pytest.approx(expected, abs=1e-5)
        last = surfaces.step(result.frame(3)).points
        idle = np.unique(after.connectivity[np.isin(part, [surfaces.parts.index(p) for p in surfaces.parts])])
        assert np.ptp(last[idle], axis=0) == pytest.approx([0, 0, 0], abs=1e-5)


def test_a_bearing_is_joined_to_its_node(tmp_path: Path) -> None:
    """Its place lies beside the node: a bar of the body reaches from one to the other."""
    from engrane_post.scene import Scene

    place = [-0.3, 0, 0]
    elements = [
        dict(
            id=2,
            type="BEARING",
            nodes=[0, 1],
            parameters={"AT": place, "AXIS": [1, 0, 0]},
            drawing=[dict(shape="axis", node=1, center=place, axis=[1, 0, 0])],
        )
    ]
    zero = np.zeros((1, 2, 3))
    points = {1: (0.0, 0.0, 0.0), 2: (1.0, 0.0, 0.0)}
    path = models.write(tmp_path / "bearing.h5", points, elements, np.zeros(1), zero, zero)
    with Results(path) as result:
        bars = [i.mesh.bounds for i in Scene(result).items if i.kind == "body" and i.node == 1]
    assert len(bars) == 1
    assert bars[0][:2] == pytest.approx([-0.3, 0], abs=1e-6)
