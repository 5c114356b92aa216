# SPDX-License-Identifier: BSD-3-Clause
"""Labels of diagrams, titles in Latin-1, full disks, histories without lines, files that are no meshes, and
what pictures show of loads and supports."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from pathlib import Path

import h5py
import models
import numpy as np
import pytest
from engrane_post import Results
from engrane_post.histories import legend_text, shared_label
from engrane_post.reading import text
from engrane_post.results import Channel
from engrane_post.spectra import no_lines, spectrum
from test_cells import row_of_cells

POST = Path(__file__).resolve().parents[2] / "post"

HELD = """.NOE
 I 1 X 0 0 0
.MCE
 I 1 INERTIA N 1 M 10 J 1 1 1
 I 2 BEARING N 0 1 AXIS 0 0 1 AXIS2 1 0 0 K 1E6 1E6 2E6 0 1E6 1E6
 I 3 BUSHING N 0 1 K 1 1 1 1 1 1
 I 4 SPRING N 0 1 AT 1 0 0 K 1
 I 5 STOP N 0 1 NORMAL 0 0 1 ON 0 0 -1 K 1E3
.SAM TYPE DYNAMIC
.SUB TF 1E-3 H 1E-4
"""


def node(component: str) -> Channel:
    return Channel(f"node/4/{component}", "displacement", "m", "node 4")


def test_labels_name_the_component(two: Path) -> None:
    axes = [node(c) for c in ("UX", "UY", "UZ")]
    with Results(two) as result:
        entries = [legend_text(result, c, False, True) for c in axes]
    assert entries == ["node 4 UX: displacement", "node 4 UY: displacement", "node 4 UZ: displacement"]
    assert shared_label(axes) == "UX, UY, UZ: displacement [m]"
    assert axes[1].axis_label() == "UY: displacement [m]"
    force = Channel("element/2/FORCE_2", "of the bearing on B, in its axes", "N", "BEARING 2")
    assert force.axis_label("amplitude of", 80) == "amplitude of FORCE_2 of the bearing on B, in its axes [N]"
    assert shared_label([force, Channel("element/1/FORCE_X", "global", "N")]) == "FORCE_2, FORCE_X [N]"
    spin = Channel("element/2/SPIN_X", "angular velocity in the axes of the body, which " + "x" * 60, "rad/s")
    assert spin.axis_label(width=99) == "SPIN_X: angular velocity in the axes of the body [rad/s]"
    assert Channel("element/7/NORMAL_FORCE", "normal force", "N").axis_label() == "NORMAL_FORCE [N]"


def test_labels_of_the_program(tmp_path: Path) -> None:
    """They make sense alone."""
    program = Path(os.environ.get("ENGRANE", ""))
    if not program.is_file():
        pytest.skip("the variable ENGRANE names no program")
    (tmp_path / "d.dat").write_text(HELD)
    subprocess.run([program, "d.dat", "-q"], cwd=tmp_path, check=True)
    with Results(tmp_path / "d.h5") as result:
        labels = {c.name: c.label for n, c in result.channels.items() if n.startswith("element/")}
    assert {n.split("/")[1] for n in labels} == {"1", "2", "3", "4", "5"}
    assert not [n for n, label in labels.items() if label.startswith(("of ", "about ", "to ", "its "))]
    assert labels["element/2/FORCE_2"] == "force of the bearing on B, in its axes"
    assert labels["element/5/SPEED"] == "rate of HEIGHT"


def test_diagrams_name_the_component(two: Path, command, tmp_path: Path) -> None:
    texts = []
    for words in (
        ("plot", two, "1/WZ", "--against", "2/UX"),
        ("spectrum", two, "7/U_M"),
        ("orders", two, "7/U_M", "--wheel", "1/WZ"),
    ):
        assert command(*words, "-o", tmp_path / "a.svg")[0] == 0
        texts.append((tmp_path / "a.svg").read_text())
    for diagram, said in zip(
        texts,
        ("node 2 UX: displacement x [m]", "amplitude of U_M: tooth", "amplitude of U_M: tooth"),
        strict=True,
    ):
        assert f"<!-- {said}" in diagram


def test_a_title_in_latin_1(command, tmp_path: Path) -> None:
    path = models.two_wheels(tmp_path / "old.h5")
    with h5py.File(path, "a") as file:
        file.attrs.create("title", np.bytes_(b"p\xe9ndulo"), dtype=h5py.string_dtype("utf-8", 7))
    assert text("p\udce9ndulo") == "péndulo", "as h5py reads strings of any length"
    with Results(path) as result:
        assert result.title == "péndulo"
    for words in (("plot", path, "7.u_m"), ("spectrum", path, "7.u_m"), ("picture", path)):
        assert command(*words, "-o", tmp_path / "a.png")[0] == 0


# Full disks


def limited(size: int, *words: str | Path, **options) -> subprocess.CompletedProcess[str]:
    """Runs a command whose files may have so many bytes: what a full disk does, but for the reason."""
    return subprocess.run(
        [sys.executable, "-m", "engrane_post", *map(str, words)],
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": str(POST)},
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)),
        check=False,
        **options,
    )


@pytest.mark.parametrize("size", [1000, 20000])
@pytest.mark.parametrize("words", [(), ("--vtu",)])
def test_export_on_a_full_disk(two: Path, tmp_path: Path, size: int, words: tuple[str, ...]) -> None:
    folder = tmp_path / "full"
    folder.mkdir()
    done = limited(size, "export", two, *words, "-o", folder / "run")
    assert done.returncode == 1
    assert done.stderr.startswith(f"engrane export: {folder}/run")
    assert done.stderr.count("\n") == 1 and "cannot be written" in done.stderr
    assert not [p for p in folder.rglob("*") if p.is_file()]


@pytest.mark.parametrize("ending", ["vtu", "vtk", "med", "msh", "inp"])
def test_mesh_on_a_full_disk(tmp_path: Path, ending: str) -> None:
    folder = tmp_path / "full"
    folder.mkdir()
    result = row_of_cells(tmp_path / "row.h5", ("hexahedron", "hexahedron"))
    done = limited(100, "export", result, "--mesh", folder / f"x.{ending}")
    assert done.returncode == 1
    assert done.stderr == f"engrane export: {folder}/x.{ending} cannot be written or read: File too large.\n"
    assert not list(folder.iterdir())


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
def test_list_to_a_full_disk(two: Path) -> None:
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = limited(1 << 30, "plot", two, "--list", stdout=full)
    assert done.returncode == 1
    assert done.stderr == "engrane plot: the output cannot be written: the disk is full.\n"


# Histories without lines


def test_rounding_is_no_line() -> None:
    t = 1e-3 * np.arange(500)
    noise = np.random.default_rng(1).standard_normal(500)
    s = spectrum(t, 612.0 * (1 + 2e-14 * noise))
    assert s.constant and s.lines(8) == ([], False) and not s.amplitude.any()
    assert no_lines(s, False) == "no lines: the history is constant to rounding"
    small = spectrum(t, 612.0 * (1 + 1e-10 * np.sin(2 * np.pi * 50 * t)))
    assert len(small.lines(1)[0]) == 1


def test_a_drift_is_no_line() -> None:
    t = 1e-3 * np.arange(11)
    assert spectrum(t, 3 * t).lines(8) == ([], True)
    t = 1e-3 * np.arange(4000)
    found, below = spectrum(t, 5 * t + 0.1 * np.sin(2 * np.pi * 50 * t)).lines(1)
    assert below and found[0] == (pytest.approx(50, abs=0.01), pytest.approx(0.1, rel=1e-2))


def test_remarks_of_tables(two: Path, command, tmp_path: Path) -> None:
    for words in (("spectrum", two, "kinetic_energy"), ("orders", two, "1/WZ", "--wheel", "1/WZ")):
        out = command(*words, "-o", tmp_path / "a.png")[1]
        assert "no lines: the history is constant to rounding" in out
    out = command("spectrum", two, "2/UX", "--to", "0.004", "-o", tmp_path / "a.png")[1]
    assert "left out: what has less than 2 periods in this span" in out


# Meshes


@pytest.mark.parametrize("ending", ["inp", "bdf"])
def test_each_field_is_left_out_once(command, tmp_path: Path, ending: str) -> None:
    result = row_of_cells(tmp_path / "row.h5", ("hexahedron",))
    with h5py.File(result, "a") as file:  # averaged at nodes, too
        cells = file["fields/STRESS"]
        group = file.create_group("nodes/STRESS")
        group.attrs.update(cells.attrs)
        for frame in cells:
            group[frame] = np.zeros((len(file["mesh/points"]), cells[frame].shape[1]))
    _, out, _ = command("export", result, "--mesh", tmp_path / f"x.{ending}")
    names = out.splitlines()[0].split("left out: ")[1].rstrip(".").split(", ")
    assert "STRESS" in names and len(names) == len(set(names))


@pytest.mark.parametrize(
    "ending", ["vtk", "vtu", "bdf", "inp", "msh", "med", "mesh", "stl", "ply", "obj", "xyz"]
)
@pytest.mark.parametrize(
    "content", [b"hello\n", b"\xb1\xb3\x00\xff" * 100, b"# vtk DataFile Version 3.0\nx\nASCII\n"]
)
def test_files_that_are_no_meshes(tmp_path: Path, ending: str, content: bytes) -> None:
    (tmp_path / f"mesh.{ending}").write_bytes(content)
    done = limited(1 << 30, "import", tmp_path / f"mesh.{ending}", "--list")
    assert done.returncode == 1
    assert done.stderr.startswith(f"engrane import: {tmp_path}/mesh.{ending} ")
    assert done.stderr.count("\n") == 1, done.stderr
    for leak in ("Error", "(1)", "codec", "argument", "Unable", "'"):
        assert leak not in done.stderr


# Pictures


def test_loads_that_are_switched_off_are_not_drawn(tmp_path: Path) -> None:
    from engrane_post.graphics import pv
    from engrane_post.scene import Scene, Stage

    arrow = dict(shape="arrow", node=1, center=[0, 0, 0], axis=[1, 0, 0])
    t = np.array([0.0, 1.0, 2.0])
    zero = np.zeros((3, 2, 3))
    path = models.write(
        tmp_path / "load.h5",
        {1: (0, 0, 0), 2: (1, 0, 0)},
        [dict(id=3, type="FORCE", nodes=[1], drawing=[arrow])],
        t,
        zero,
        zero,
        history={"element/3/FORCE": (np.array([50.0, 1e-12, 50.0]), "N", "along its direction")},
        history_time=t,
    )
    with Results(path) as result:
        stage = Stage(Scene(result), pv.Plotter(off_screen=True))
        load = next(actor for item, _, actor in stage.actors if item.kind == "load")
        shown = []
        for frame in (result.reference(), *(result.frame(i) for i in range(3))):
            stage.show(frame)
            shown.append(bool(load.visibility))
    assert shown == [True, True, False, True]


def test_supports_of_a_mesh_are_drawn(tmp_path: Path) -> None:
    from engrane_post import loads
    from engrane_post.scene import Scene

    path = row_of_cells(tmp_path / "row.h5", ("hexahedron",), frames=2)
    with h5py.File(path, "a") as file:
        force = np.zeros((len(file["mesh/points"]), 3))
        force[[0, 1, 2]] = [[1.0, 0, 0], [0, 5.0, 0], [0, 0, -2.0]]  # the first has no cells
        file.create_group("fields/reaction_force").attrs["unit"] = "N"
        for k in range(2):
            file[f"fields/reaction_force/{k:06d}"] = force
    with Results(path) as result:
        grounds = [i for i in Scene(result).items if i.kind == "support"]
        assert [i.node for i in grounds] == [int(n) for n in result.node_ids[1:3]]
        assert np.allclose([i.mesh.center for i in grounds], result.points[1:3])
        assert len(loads.supported(result, np.array([1, 2, 3]))) == 2


def test_supports_of_a_large_mesh(tmp_path: Path) -> None:
    from engrane_post import loads

    side = np.arange(20.0)
    points = {k + 1: (x, y, 0.0) for k, (x, y) in enumerate((x, y) for x in side for y in side)}
    zero = np.zeros((1, 400, 3))
    path = models.write(tmp_path / "plate.h5", points, [], np.zeros(1), zero, zero)
    with h5py.File(path, "a") as file:
        file["fields/reaction_force/000000"] = np.ones((400, 3))
    with Results(path) as result:
        held = loads.supported(result, np.arange(400))
        assert len(held) == len(set(held)) == loads.MOST_SUPPORTS
        away = np.linalg.norm(result.points[:, None] - result.points[held], axis=2)
        assert away.min(axis=1).max() < 4, "they are spread over all"
