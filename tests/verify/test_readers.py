# SPDX-License-Identifier: BSD-3-Clause
"""Every reader that a user may have opens a result, and a killed run's file opens too.

The program is taken from the variable ENGRANE. With ENGRANE_RESULT a finished result (its prefix) is read
instead.
"""

import os
import random
import subprocess
import time
from pathlib import Path

import pytest

h5py = pytest.importorskip("h5py")
np = pytest.importorskip("numpy")

from runs import program  # noqa: E402

DECK = """! A double pendulum: enough for a mesh, fields and histories.
.TITRE "double pendulum"
.NOE
 I 1 X -1 0 0
 I 2 X -2 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0
 I 2 INERTIA N 1 M 1 J 0.01
 I 3 HINGE N 1 2 AXIS 0 0 1 AT -1 0 0
 I 4 INERTIA N 2 M 1 J 0.01
.CLM
 STRU ACC VAL 0 -9.81 0
.SAM TYPE DYNAMIC RHO 1
.SAI CHAMPS DT 0.01
.SUB TF {end} H 0.0005
.FIN 1
"""
VECTORS = {"displacement", "rotation", "velocity", "angular_velocity", "reaction_force", "reaction_torque"}


@pytest.fixture(scope="module")
def prefix(tmp_path_factory) -> Path:
    """A finished result: `prefix.h5` and `prefix.xdmf`."""
    if "ENGRANE_RESULT" in os.environ:
        return Path(os.environ["ENGRANE_RESULT"])
    folder = tmp_path_factory.mktemp("readers")
    (folder / "pendulum.dat").write_text(DECK.format(end=0.2))
    subprocess.run(
        [program(), "pendulum.dat", "-o", "pendulum"], cwd=folder, check=True, stdout=subprocess.DEVNULL
    )
    return folder / "pendulum"


@pytest.fixture(scope="module")
def frames(prefix):
    """Times and displacements as they stand in the HDF5 file."""
    with h5py.File(f"{prefix}.h5", "r") as file:
        assert file.attrs["format"] == "engrane"
        assert file.attrs["status"] == "complete"
        times = file["fields/time"][()]
        return times, [file[f"fields/displacement/{i:06d}"][()] for i in range(len(times))]


def tables(file):
    """Groups with histories, by path."""
    found = {}

    def keep(path, item):
        if "values" in (item if isinstance(item, h5py.Group) else ()):
            found[path] = item

    file["history"].visititems(keep)
    return found


def test_layout(prefix):
    with h5py.File(f"{prefix}.h5", "r") as file:
        samples = len(file["history/time"])
        assert samples > 0
        assert {"unit", "label"} <= set(file["history/time"].attrs)
        for path, table in tables(file).items():
            owners = len(table["ids"]) if "ids" in table else 1
            channels = len(table["channels"])
            assert table["values"].shape == (samples, owners * channels), path
            assert len(table["units"]) == len(table["labels"]) == channels, path
        count = len(file["mesh/node_ids"])
        assert file["mesh/points"].shape == (count, 3)
        for name, group in file["fields"].items():
            if name != "time":
                assert set(group.attrs) == {"unit", "label"}
                assert all(frame.shape == (count, 3) for frame in group.values())


def test_meshio(prefix, frames):
    xdmf = pytest.importorskip("meshio").xdmf
    times, displacements = frames
    with xdmf.TimeSeriesReader(f"{prefix}.xdmf") as reader:
        points, cells = reader.read_points_cells()
        assert len(points) == len(displacements[0])
        assert reader.num_steps == len(times)
        for k, wanted in enumerate(displacements):
            at, point_data, cell_data = reader.read_data(k)
            assert at == times[k]
            assert set(point_data) <= VECTORS
            np.testing.assert_array_equal(point_data["displacement"], wanted)
            assert [len(block) for block in cell_data["element"]] == [len(block.data) for block in cells]


def test_pyvista(prefix, frames):
    pyvista = pytest.importorskip("pyvista")
    times, displacements = frames
    reader = pyvista.XdmfReader(f"{prefix}.xdmf")
    assert reader.time_values == pytest.approx(list(times), abs=1e-12)
    for k in {0, len(times) // 2, len(times) - 1}:
        reader.set_active_time_point(k)
        mesh = reader.read()
        assert set(mesh.point_data.keys()) <= VECTORS
        np.testing.assert_array_equal(mesh.point_data["displacement"], displacements[k])
        assert mesh.n_cells == len(mesh.cell_data["element"])


@pytest.mark.parametrize("name", ["vtkXdmfReader", "vtkXdmf3Reader"])
def test_vtk(prefix, frames, name):
    vtk = pytest.importorskip("vtkmodules.all")
    if not hasattr(vtk, name):
        pytest.skip(f"this VTK has no {name}")
    times, _ = frames
    reader = getattr(vtk, name)()
    reader.SetFileName(f"{prefix}.xdmf")
    reader.UpdateInformation()
    steps = reader.GetOutputInformation(0).Get(vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    assert steps == pytest.approx(list(times), abs=1e-12)
    reader.UpdateTimeStep(steps[-1])
    assert reader.GetOutputDataObject(0).GetPointData().HasArray("displacement")


def test_killed_run_opens(tmp_path):
    """SIGKILL at ten moments: the file opens, histories are as long as the time, frames are there."""
    (tmp_path / "long.dat").write_text(DECK.format(end=100000))
    draw = random.Random(1)
    most = 0
    for attempt in range(10):
        with subprocess.Popen(
            [program(), "long.dat", "-o", f"long{attempt}"],
            cwd=tmp_path,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        ) as run:
            path = tmp_path / f"long{attempt}.h5"
            deadline = time.monotonic() + 60
            while not path.exists() and run.poll() is None and time.monotonic() < deadline:
                time.sleep(0.01)
            time.sleep(draw.uniform(0, 2.5))
            assert run.poll() is None, "the run ended by itself"
            run.kill()
        with h5py.File(path, "r") as file:
            assert file.attrs["status"] == "running"
            samples = len(file["history/time"])
            most = max(most, samples)
            times = file["history/time"][()]
            assert np.all(np.diff(times) > 0)
            assert {len(table["values"]) for table in tables(file).values()} == {samples}
            count = len(file["fields/time"])
            assert all(len(group) == count for name, group in file["fields"].items() if name != "time")
    assert most > 1
