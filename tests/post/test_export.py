# SPDX-License-Identifier: BSD-3-Clause
"""What `engrane export` writes, opened by VTK's readers."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import h5py
import models
import numpy as np
import pytest
from engrane_post import Results
from engrane_post.belts import stations
from engrane_post.forces import KINDS as FORCE_KINDS
from engrane_post.surfaces import KINDS

T = models.STEP * np.arange(4001)
CONTACT = np.stack([0.05 + 0 * T, 1e-3 * np.sin(300 * T), 0 * T], axis=1)
TOOTH = np.stack([100 * np.sin(900 * T), 400 + 50 * np.cos(900 * T), 0 * T], axis=1)


@pytest.fixture
def gears(tmp_path: Path) -> Path:
    """The spur pair, with the vectors of its tooth force among the histories."""
    history = {}
    for i, c in enumerate("XYZ"):
        history[f"element/7/CONTACT_{c}"] = (CONTACT[:, i], "m", "")
        for side, sign in (("A", 1), ("B", -1)):
            history[f"element/7/FORCE_{side}{c}"] = (sign * TOOTH[:, i], "N", "")
            history[f"element/7/MOMENT_{side}{c}"] = (sign * 0.1 * TOOTH[:, i], "N.m", "")
    return models.two_wheels(tmp_path / "gears.h5", history=history)


def grids(path: Path) -> tuple[list[float], list]:
    """Times and grids of all steps of a VTKHDF file."""
    vtk = pytest.importorskip("vtkmodules.all")
    import pyvista as pv

    reader = vtk.vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    found = []
    for time in times or [0.0]:
        reader.UpdateTimeStep(time)
        found.append(pv.wrap(reader.GetOutputDataObject(0)).copy())
    return list(times or []), found


def wheel_points(grid, node: int) -> np.ndarray:
    """Points of a wheel's toothed surfaces."""
    mine = (grid.cell_data["kind"] == KINDS.index("wheel")) & (grid.cell_data["node"] == node)
    return np.asarray(grid.extract_cells(np.flatnonzero(mine)).points, float)


def test_wheels_turn(gears: Path, command, tmp_path: Path) -> None:
    status, out, err = command("export", gears, "-o", tmp_path / "out")
    assert (status, err) == (0, "") and "wrote 9 frames" in out
    with Results(gears) as r:
        wanted = r.frame_times
    times, found = grids(tmp_path / "out.vtkhdf")
    assert times == pytest.approx(list(wanted), abs=1e-15)
    assert all(np.array_equal(g.cells, found[0].cells) for g in found)
    for node, speed, center in ((1, models.SPEED, 0.0), (2, -models.SPEED / 2, 0.15)):
        start = wheel_points(found[0], node) - [center, 0, 0]
        for time, grid in zip(times, found, strict=True):
            a = speed * time
            turn = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
            now = wheel_points(grid, node) - [center, 0, 0]
            assert now == pytest.approx(start @ turn.T, abs=1e-7)
    # velocity is angular velocity times distance from the axle
    gear_a = found[0].extract_cells(np.flatnonzero(found[0].cell_data["node"] == 1))
    wanted = np.cross([0, 0, models.SPEED], gear_a.points)
    assert np.abs(wanted).max() > 0.05 * models.SPEED
    assert gear_a.point_data["velocity"] == pytest.approx(wanted, abs=1e-5 * models.SPEED)


def test_teeth_and_tip_circle(gears: Path, command, tmp_path: Path) -> None:
    command("export", gears, "--frames", "1", "-o", tmp_path / "out")
    _, (grid,) = grids(tmp_path / "out.vtkhdf")
    for node, teeth, radius, center in ((1, 20, 0.05, 0.0), (2, 40, 0.1, 0.15)):
        p = wheel_points(grid, node) - [center, 0, 0]
        r = np.hypot(p[:, 0], p[:, 1])
        assert r.max() == pytest.approx(radius + 0.005, rel=1e-6)
        # around the end face, teeth are runs of points outside the pitch circle
        face = p[:, 2] > p[r > radius, 2].max() - 1e-7
        outline = face & (r > radius - 1.26 * 0.005)
        order = np.argsort(np.arctan2(p[outline, 1], p[outline, 0]))
        outside = r[outline][order] > radius + 1e-6
        assert np.sum(outside & ~np.roll(outside, 1)) == teeth


def test_forces_are_the_channels(gears: Path, command, tmp_path: Path) -> None:
    command("export", gears, "-o", tmp_path / "out.vtkhdf")
    times, found = grids(tmp_path / "out_forces.vtkhdf")
    tooth = FORCE_KINDS.index("tooth")
    for time, grid in zip(times, found, strict=True):
        k = round(time / models.STEP)
        data = grid.point_data
        for node, sign, center in ((1, 1, 0.0), (2, -1, 0.15)):
            mine = (data["kind"] == tooth) & (data["node"] == node) & (data["element"] == 7)
            pulled = mine & (np.abs(data["FORCE"]).max(axis=1) > 0)
            assert data["FORCE"][pulled] == pytest.approx(sign * TOOTH[k : k + 1], rel=1e-12)
            assert grid.points[pulled] == pytest.approx(CONTACT[k : k + 1], abs=1e-12)
            turned = mine & ~pulled
            assert data["MOMENT"][turned] == pytest.approx(sign * 0.1 * TOOTH[k : k + 1], rel=1e-12)
            assert grid.points[turned] == pytest.approx(np.array([[center, 0, 0]]), abs=1e-12)


def test_wheels_are_in_equilibrium(command, tmp_path: Path) -> None:
    """Tooth force, joint and torque on each wheel of a static deck add up to nothing: forces have their sign,
    moments their points."""
    program = os.environ.get("ENGRANE", "")
    if not Path(program).is_file():
        pytest.skip("the variable ENGRANE names no program")
    deck = Path(__file__).resolve().parents[2] / "decks/gears/spur.dat"
    subprocess.run([program, deck, "-o", tmp_path / "spur"], check=True, stdout=subprocess.DEVNULL)
    assert command("export", tmp_path / "spur", "-o", tmp_path / "out")[0] == 0
    _, found = grids(tmp_path / "out_forces.vtkhdf")
    for grid in found:
        data = grid.point_data
        assert set(data["unique"]) == {1}
        for node, torque in ((1, 30000), (2, 60000)):
            mine = data["node"] == node
            assert {FORCE_KINDS[k] for k in data["kind"][mine]} >= {"tooth", "joint"}
            for name, size in (("FORCE", torque / 30 / node), ("MOMENT", torque)):
                assert np.abs(data[name][mine]).max() > 0.9 * size
                assert data[name][mine].sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-9 * size)


def test_series_for_readers_without_steps(gears: Path, command, tmp_path: Path) -> None:
    """Each file of the series is one step of the whole, without its data; the folder may be moved."""
    (tmp_path / "made").mkdir()
    command("export", gears, "--every", "4", "-o", tmp_path / "made" / "out")
    here = (tmp_path / "made").rename(tmp_path / "moved")
    for name in ("out", "out_forces"):
        times, found = grids(here / f"{name}.vtkhdf")
        listed = json.loads((here / f"{name}.hdf.series").read_text())
        assert [f["time"] for f in listed["files"]] == times and len(times) == 3
        for entry, whole in zip(listed["files"], found, strict=True):
            path = here / entry["name"]
            with h5py.File(path) as file:
                assert list(file["VTKHDF"].attrs["Version"]) == [1, 0]
            _, (one,) = grids(path)
            assert np.array_equal(one.points, whole.points) and np.array_equal(one.cells, whole.cells)
            for kind in ("point_data", "cell_data"):
                there, here_ = getattr(whole, kind), getattr(one, kind)
                assert set(there.keys()) == set(here_.keys())
                assert all(np.array_equal(there[n], here_[n]) for n in there)


def test_vtu(gears: Path, command, tmp_path: Path) -> None:
    import pyvista as pv

    command("export", gears, "--vtu", "--frames", "2", "-o", tmp_path / "out")
    assert not (tmp_path / "out.vtkhdf").exists()
    entries = ElementTree.parse(tmp_path / "out.pvd").getroot().findall("Collection/DataSet")
    assert len(entries) == 2
    reader = pv.PVDReader(str(tmp_path / "out.pvd"))
    reader.set_active_time_point(1)
    mesh = reader.read()[0]
    command("export", gears, "--frames", "2", "-o", tmp_path / "out")
    times, found = grids(tmp_path / "out.vtkhdf")
    assert reader.time_values == times
    assert np.array_equal(mesh.points, found[1].points) and np.array_equal(mesh.cells, found[1].cells)
    assert np.array_equal(mesh.cell_data["color"], found[1].cell_data["color"])
    assert np.array_equal(mesh.point_data["velocity"], found[1].point_data["velocity"])


@pytest.mark.parametrize("crossed", [False, True])
def test_belt(crossed: bool, command, tmp_path: Path) -> None:
    """As long as the equations of the element say, and round both pulleys wherever they go; what its forces
    are, is in the glyphs."""
    r1, r2, d = 0.05, 0.1, 0.5
    s = -1 if crossed else 1
    beta = np.arcsin((r1 - s * r2) / d)
    length = 2 * d * np.cos(beta) + r1 * (np.pi + 2 * beta) + r2 * (np.pi - 2 * s * beta)
    middle = stations(d, r1, r2, crossed)[:, 0]
    assert np.linalg.norm(middle - np.roll(middle, 1, axis=0), axis=1).sum() == pytest.approx(
        length, rel=1e-3
    )

    parameters = {"AXIS": [0, 0, 1], "R": [r1, r2], "CROSSED": crossed}
    drawing = [dict(shape="line", points=[1, 2])]
    elements = [dict(id=4, type="BELT", nodes=[1, 2], parameters=parameters, drawing=drawing)]
    zero = np.zeros((2, 2, 3))
    moved = zero.copy()
    moved[1, 1] = [0, 0.3, 0]
    names = ("FORCE_X", "FORCE_Y", "FORCE_Z", "TORQUE_1", "TORQUE_2")
    history = {f"element/4/{n}": (np.array([i, 10.0 * i]), "N", "") for i, n in enumerate(names)}
    t = np.array([0.0, 1.0])
    path = models.write(
        tmp_path / "belt.h5", {1: (0, 0, 0), 2: (d, 0, 0)}, elements, t, moved, zero, moved, zero, history, t
    )
    assert command("export", path, "-o", tmp_path / "belt")[0] == 0
    _, found = grids(tmp_path / "belt.vtkhdf")
    for grid, far in zip(found, ([d, 0, 0], [d, 0.3, 0]), strict=True):
        belt = grid.extract_cells(np.flatnonzero(grid.cell_data["kind"] == KINDS.index("belt")))
        for center, radius in (([0, 0, 0], r1), (far, r2)):
            nearest = np.linalg.norm((belt.points - center)[:, :2], axis=1).min()
            assert nearest == pytest.approx(radius - 0.5 * 0.07 * r1, rel=1e-5)
    # the point that is farthest out turns with the line of centres about the first pulley
    speed, line = np.array([0, 0.3, 0]), np.array(far) / np.linalg.norm(far)
    last = np.argmax(belt.points @ line)
    wanted = speed - (speed @ line) * line
    wanted = (speed @ line) * line + wanted * np.linalg.norm(belt.points[last, :2]) / np.linalg.norm(far)
    assert belt.point_data["velocity"][last] == pytest.approx(wanted, abs=1e-4)
    _, forces = grids(tmp_path / "belt_forces.vtkhdf")
    data = forces[1].point_data
    assert data["FORCE"][data["node"] == 2] == pytest.approx(np.array([[0, 10, 20]]))
    assert data["FORCE"][data["node"] == 1] == pytest.approx(np.array([[0, -10, -20]]))
    assert data["MOMENT"][:, 2] == pytest.approx(np.array([30, 40]))


def test_errors(gears: Path, bevel: Path, command, tmp_path: Path) -> None:
    assert "no folder" in command("export", gears, "-o", tmp_path / "no/such")[2]
    assert "--frames must be 1" in command("export", gears, "--frames", "0")[2]
    assert "no frames between" in command("export", gears, "--from", "7")[2]
    status, out, _ = command("export", bevel, "-o", tmp_path / "bevel")  # it has no histories
    assert status == 0 and "no glyphs" in out
    assert not (tmp_path / "bevel_forces.vtkhdf").exists()
