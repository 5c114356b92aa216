# SPDX-License-Identifier: BSD-3-Clause
"""Cells of results: drawn from outside, and written as mesh files of other programs."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import h5py
import meshes
import meshio
import models
import numpy as np
import pytest
from engrane_post import Results
from engrane_post.cells import BY_NAME, BY_XDMF, outer_faces, runs
from engrane_post.surfaces import KINDS
from small_decks import SQUARES

CODES = {"triangle": 4, "quad": 5, "tetra": 6, "wedge": 8, "hexahedron": 9, "triangle6": 36, "quad8": 37}
CODES |= {"tetra10": 38, "wedge15": 40, "hexahedron20": 48}
GAP = 5.0
STRESS = ["XX", "YY", "ZZ", "XY", "YZ", "ZX"]


def row_of_cells(path: Path, kinds: tuple[str, ...] = meshes.KINDS, frames: int = 3) -> Path:
    """One cell of each kind beside the other, a node without cells before them, with fields whose values
    tell node, cell and frame."""
    points, cells = {7: (-1.0, 0.0, 0.0)}, []
    for i, kind in enumerate(kinds):
        own = meshes.points_of(kind) + np.array([GAP * i, 0, 0])
        first = len(points)
        for x in own:
            points[11 + 2 * len(points)] = tuple(x)
        cells.append((CODES[kind], list(range(first, first + len(own))), 101 + i))
    cells.insert(1, (2, [0, 1], 300))  # a bar among them
    m = len(cells)
    times = 0.5 * np.arange(frames)
    x = np.array(list(points.values()))
    moved = times[:, None, None] * (0.1 * x + [0.0, 0.01, 0.2])
    models.write(
        path, points, [dict(id=300, type="BAR", nodes=[7, 13])], times, moved, cells=cells, title="row"
    )
    with h5py.File(path, "a") as f:
        for name, width, components in (("VON_MISES", 1, ""), ("STRESS", 6, " ".join(STRESS))):
            group = f.create_group(f"fields/{name}")
            group.attrs.update(center="Cell", unit="Pa", components=components)
            for k in range(frames):
                values = 100.0 * k + np.arange(m)[:, None] + 0.1 * np.arange(width)
                values[1] = np.nan  # the bar has none
                group[f"{k:06d}"] = values
    return path


def test_table_of_kinds() -> None:
    """Mirrored cells of a kind are of that kind: sides and faces stay sides and faces."""
    assert {k.name: k.xdmf for k in BY_XDMF.values()} == CODES
    for kind in BY_NAME.values():
        assert sorted(kind.mirror) == list(range(kind.nodes))
        for i, ends in enumerate(kind.middles):
            place = kind.mirror.index(kind.corners + i) - kind.corners
            was = {kind.mirror[c] for c in kind.middles[place]}
            assert was == set(ends)
        faces = {frozenset(f) for f in kind.faces}
        assert {frozenset(kind.mirror[c] for c in f) for f in kind.faces} == faces


@pytest.mark.parametrize("kind", meshes.KINDS)
def test_faces_look_outward(kind: str) -> None:
    """The faces of a solid close it: the integral of x . n over them is three times its volume, with
    corners in turn and mid-side nodes between them. A plane cell is its own outline."""
    x = meshes.points_of(kind)
    found = outer_faces(runs(np.array([CODES[kind], *range(len(x))])))
    volume = area = 0.0
    for table, owners in found:
        assert not owners.any()
        for polygon in table:
            p = x[polygon]
            cross = np.cross(p[1:-1] - p[0], p[2:] - p[0])
            area += np.linalg.norm(cross.sum(axis=0)) / 2
            volume += sum(c @ p[0] for c in cross) / 6
    linear = meshes.SIDES[kind][0] if kind in meshes.SIDES else kind
    wanted = {"triangle": 1, "quad": 2, "tetra": 1, "wedge": 3, "hexahedron": 6}[linear]
    if BY_NAME[kind].dimension == 3:
        assert volume == pytest.approx(wanted)
        assert sum(len(t) for t, _ in found) == len(BY_NAME[kind].faces)
    else:
        assert area == pytest.approx(wanted)


def test_outside_of_many() -> None:
    """Of a box of bricks, and of wedges that meet bricks."""
    _, cells, _ = meshes.brick(3, 2, 2)
    topology = np.insert(cells, 0, CODES["hexahedron"], axis=1).ravel()
    found = outer_faces(runs(topology))
    assert sum(len(t) for t, _ in found) == 2 * (3 * 2 + 3 * 2 + 2 * 2)
    assert set(np.concatenate([o for _, o in found]).tolist()) == set(range(12))  # two thick: each is seen
    wedges = np.concatenate([cells[:1][:, [0, 1, 2, 4, 5, 6]], cells[:1][:, [0, 2, 3, 4, 6, 7]]])
    topology = np.concatenate(
        [np.insert(cells[1:], 0, 9, axis=1).ravel(), np.insert(wedges, 0, 8, axis=1).ravel()]
    )
    found = outer_faces(runs(topology))
    # the wedges' ends at z = 0 are outside; those at z = 1 meet a brick, whose face is another: both are seen
    assert sum(len(t) for t, _ in found if t.shape[1] == 4) == 2 * (3 * 2 + 3 * 2 + 2 * 2) - 1 + 1
    assert sum(len(t) for t, _ in found if t.shape[1] == 3) == 4


def test_numbers_beyond_packing() -> None:
    """Faces are told apart also where node numbers need more bits than fit together."""
    far = 1 << 22
    cells = np.array([[0, 1, 2, 3], [0, 1, 2, 4]]) + far
    found = outer_faces(runs(np.insert(cells, 0, CODES["tetra"], axis=1).ravel()))
    assert sum(len(t) for t, _ in found) == 6


def two_sections(path: Path) -> Path:
    """Two bricks of different sections, with points of their own where they meet, and stresses at these."""
    points, cells, _ = meshes.brick(2, 1, 1)
    shared = sorted(set(cells[0]) & set(cells[1]))
    copies = {n: len(points) + i for i, n in enumerate(shared)}
    second = [copies.get(n, n) for n in cells[1].tolist()]
    every = np.concatenate([points, points[shared]])
    times = np.array([0.0, 1.0])
    models.write(
        path,
        {i + 1: tuple(x) for i, x in enumerate(every)},
        [],
        times=times,
        displacement=np.zeros((2, len(every), 3)),
        cells=[(CODES["hexahedron"], cells[0].tolist(), 1), (CODES["hexahedron"], second, 2)],
    )
    with h5py.File(path, "a") as file:
        ids = file["mesh/node_ids"]
        ids[len(points) :] = np.array(shared) + 1
        for name, values, center, folder in (
            ("VON_MISES", np.array([3.0, 5.0]), "Cell", "fields"),
            ("VON_MISES", np.where(np.isin(np.arange(len(every)), second), 7.0, 2.0), "Node", "nodes"),
        ):
            group = file.create_group(f"{folder}/{name}")
            group.attrs.update(unit="Pa", center=center)
            for i in range(2):
                group[f"{i:06d}"] = values[:, None] * i
    return path


def test_fields_at_nodes(command, tmp_path: Path) -> None:
    """Each section has its own value where two meet, faces between are not seen, colours are those of the
    nodes; files for other programs have both."""
    import pyvista as pv
    from engrane_post.scene import Scene, colours

    path = two_sections(tmp_path / "two.h5")
    with Results(path) as result:
        scene = Scene(result)
        (item,) = [i for i in scene.items if i.cells is not None]
        assert len(item.cells) == 10  # of 12 faces
        values, seen = colours(result, "VON_MISES", result.frame(1), item)
        assert len(values) == len(result.points) == 16 and sorted(set(seen)) == [2, 7]
        assert (colours(result, "VON_MISES", result.reference(), item)[1] == 0).all()
        assert result.average("STRESS:XX", 1) is None
    assert command("picture", path, "--field", "VON_MISES", "-o", tmp_path / "two.png")[0] == 0
    assert command("export", path, "--mesh", tmp_path / "two.vtu")[0] == 0
    grid = pv.read(tmp_path / "two.vtu")
    for number, (at_nodes, mean) in enumerate([(2, 3), (7, 5)]):
        assert set(grid.point_data["VON_MISES"][grid.get_cell(number).point_ids]) == {at_nodes}
        assert grid.cell_data["VON_MISES"][number] == mean


def test_picture_of_solids(command, tmp_path: Path) -> None:
    """Fields colour the outside: what is seen of each cell has its value."""
    from engrane_post.scene import Scene

    path = row_of_cells(tmp_path / "row.h5")
    out = tmp_path / "row.png"
    for words in (("--field", "VON_MISES"), ("--field", "STRESS:YZ", "--deformed", "3"), ("--both",)):
        status, _, err = command("picture", path, *words, "--size", "400x200", "-o", out)
        assert (status, err) == (0, "")
    with Results(path) as result:
        scene = Scene(result)
        (item,) = (i for i in scene.items if i.cells is not None)
        place = item.mesh.cell_centers().points[:, 0] // GAP  # which cell of the row
        wanted = np.where(place == 0, 0, place + 1)  # the bar is number 1
        assert item.cells.tolist() == wanted.tolist()
        assert item.mesh.n_cells == 4 + 2 * (4 + 5 + 6)


def test_colours_mean_the_same(tmp_path: Path) -> None:
    """Before and after share a bar: nothing before is not the least of after."""
    import pyvista as pv
    from engrane_post.scene import Scene, Stage, limits_of

    assert limits_of([np.array([3.0, np.nan, -2.0]), np.zeros(1)]) == (-2, 3)
    assert limits_of([np.array([np.nan])]) == (0, 0)
    assert limits_of([np.array([200.0, 200.0 + 1e-12])]) == pytest.approx(
        (0, 200)
    )  # not the colours of rounding
    assert limits_of([np.array([-5.0, -5.0])]) == (-5, 0)
    with Results(row_of_cells(tmp_path / "row.h5")) as result:
        plotter = pv.Plotter(off_screen=True)
        stage = Stage(Scene(result), plotter, field="VON_MISES", limits=(-5.0, 300.0))
        for frame in (result.reference(), result.frame(-1)):
            stage.show(frame)
            (actor,) = (a for item, _, a in stage.actors if item.cells is not None)
            assert actor.mapper.scalar_range == (-5, 300)
        plotter.close()


def test_colour_before(command, tmp_path: Path) -> None:
    """Stresses from -100 to 100: the zero of the undeformed cell is in the middle of the bar, green."""
    from PIL import Image

    path = models.write(
        tmp_path / "m.h5",
        {i + 1: tuple(x) for i, x in enumerate(2 * meshes.SQUARE)} | {5: (8, 0, 0), 6: (8, 2, 0)},
        [],
        np.array([0.0]),
        np.zeros((1, 6, 3)),
        cells=[(5, [0, 1, 2, 3], 1), (5, [1, 4, 5, 2], 2)],
    )
    with h5py.File(path, "a") as f:
        group = f.create_group("fields/S")
        group.attrs.update(center="Cell", unit="Pa")
        group["000000"] = np.array([[-100.0], [100.0]])
    words = ("--field", "S", "--both", "--title", "", "--size", "800x300", "-o", tmp_path / "m.png")
    assert command("picture", path, *words) == (0, f"wrote {tmp_path / 'm.png'}\n", "")
    image = np.asarray(Image.open(tmp_path / "m.png").convert("RGB")).astype(int)

    def share(view: slice, color: tuple[int, int, int]) -> float:
        return float((np.abs(image[:, view] - color).max(axis=2) < 12).mean())

    middle, least, most = (33, 145, 140), (68, 1, 84), (253, 231, 37)  # of viridis
    assert share(slice(90, 400), middle) > 0.1 > 0.01 > share(slice(90, 400), least)
    assert min(share(slice(490, 800), c) for c in (least, most)) > 0.05


def test_colours_of_an_animation(command, tmp_path: Path) -> None:
    """All pictures share a scale: the middle of the stresses of the second is green in the first."""
    from PIL import Image

    path = models.write(
        tmp_path / "m.h5",
        {i + 1: tuple(x) for i, x in enumerate(2 * meshes.SQUARE)} | {5: (8, 0, 0), 6: (8, 2, 0)},
        [],
        np.array([0.0, 1.0]),
        np.stack([np.zeros((6, 3)), np.tile([0, 0.3, 0], (6, 1))]),
        cells=[(5, [0, 1, 2, 3], 1), (5, [1, 4, 5, 2], 2)],
    )
    with h5py.File(path, "a") as f:
        group = f.create_group("fields/S")
        group.attrs.update(center="Cell", unit="Pa")
        group["000000"] = np.array([[0.0], [0.0]])
        group["000001"] = np.array([[-100.0], [100.0]])
    words = ("--field", "S", "--deformed", "10", "--title", "", "--size", "400x300")
    assert command("animate", path, *words, "-o", tmp_path / "m_%d.png")[0] == 0
    images = [np.asarray(Image.open(tmp_path / f"m_{k}.png").convert("RGB")).astype(int) for k in (0, 1)]

    def rows_of(image: np.ndarray, color: tuple[int, int, int]) -> np.ndarray:
        return np.flatnonzero((np.abs(image[:, 90:] - color).max(axis=2) < 12).sum(axis=1) > 20)

    middle, least, most = (33, 145, 140), (68, 1, 84), (253, 231, 37)  # of viridis
    assert len(rows_of(images[0], middle)) > 20 and len(rows_of(images[0], most)) == 0
    assert len(rows_of(images[1], middle)) == 0
    before = rows_of(images[0], middle)
    for color in (least, most):  # 3 upwards, of a height of 2
        assert len(rows_of(images[1], color)) > 20
        assert rows_of(images[1], color).max() < before.min()
    assert "has no field NONE over its cells" in command("animate", path, "--field", "NONE")[2]


def test_deformed(command, tmp_path: Path) -> None:
    from engrane_post.picture import enlarged
    from engrane_post.scene import Scene
    from engrane_post.view import caption

    with Results(row_of_cells(tmp_path / "row.h5")) as result:
        scene, frame = Scene(result), result.frame(-1)
        assert caption(result, frame) == "t = 1 s"
        assert caption(result, enlarged(frame, 50)) == "t = 1 s, displacements x 50"
        once, more = (scene.positions(f)[13] - result.points[1] for f in (frame, enlarged(frame, 50)))
    assert np.abs(once).max() > 0 and more == pytest.approx(50 * once)
    assert command("picture", tmp_path / "row.h5", "--deformed", "nan", "-o", tmp_path / "a.png")[0] == 1


def by_id(ids: np.ndarray, values: np.ndarray) -> dict[int, np.ndarray]:
    return dict(zip(np.asarray(ids).astype(int).tolist(), list(values), strict=True))


def check_fields(path: Path, nodes: dict, cells: dict, frame: int = 2) -> None:
    """By node: displacement; by element: VON_MISES and the components of STRESS."""
    with Results(path) as result:
        wanted = result.frame(frame).displacement
        row = {int(n): i for i, n in enumerate(result.node_ids)}
        count = len(row) - 1  # one node has no cell
    assert len(nodes) == count
    for n, u in nodes.items():
        assert u == pytest.approx(wanted[row[n]], abs=1e-12)
    assert set(cells) == set(range(101, 101 + len(meshes.KINDS)))
    for element, (mises, stress) in cells.items():
        number = element - 101 + (element > 101)
        assert mises == pytest.approx(100 * frame + number)
        assert stress == pytest.approx(100 * frame + number + 0.1 * np.arange(6))


@pytest.mark.parametrize("ending", [".vtu", ".vtk"])
def test_vtk(ending: str, command, tmp_path: Path) -> None:
    import pyvista as pv

    path = row_of_cells(tmp_path / "row.h5")
    status, out, err = command("export", path, "--mesh", tmp_path / f"out{ending}")
    assert (status, err) == (0, "") and "wrote 10 cells" in out
    grid = pv.read(tmp_path / f"out{ending}")
    data = grid.cell_data
    check_fields(
        path,
        by_id(grid.point_data["node"], grid.point_data["displacement"]),
        by_id(data["element"], list(zip(data["VON_MISES"], data["STRESS"], strict=True))),
    )
    sizes = grid.compute_cell_sizes(length=False)
    volume = by_id(data["element"], np.abs(sizes["Volume"]) + sizes["Area"])
    assert [volume[101 + i] for i in range(10)] == pytest.approx([1, 2, 1, 3, 6] * 2)
    if ending == ".vtu":
        array = grid.GetCellData().GetArray("STRESS")
        assert [array.GetComponentName(k) for k in range(6)] == STRESS


def test_med(command, tmp_path: Path) -> None:
    """Read back; solids run the other way round."""
    path, file = row_of_cells(tmp_path / "row.h5"), tmp_path / "out.med"
    status, out, err = command("export", path, "--mesh", file, "--time", "0.52")
    assert (status, err) == (0, "") and "left out" not in out
    mesh = meshio.read(file)
    cells = {}
    for b in range(len(mesh.cells)):
        data = {name: np.asarray(values[b]) for name, values in mesh.cell_data.items()}
        cells |= by_id(data["element"], list(zip(data["VON_MISES"], data["STRESS"], strict=True)))
    nodes = by_id(mesh.point_data["node"], mesh.point_data["displacement"])
    check_fields(path, nodes, cells, frame=1)
    with h5py.File(file) as f:
        assert f["CHA/STRESS"].attrs["NOM"].decode().split() == STRESS
    check_solids(file)


def test_what_is_there_is_not_lost(command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file that cannot be written to its end leaves the one of its name, and nothing beside it."""
    path, file = row_of_cells(tmp_path / "row.h5"), tmp_path / "out.msh"
    file.write_text("from before")

    def fails(name, *_, **__):
        Path(name).write_text("half")
        raise ValueError("the disk is full")

    monkeypatch.setattr(meshio, "write", fails)
    status, _, err = command("export", path, "--mesh", file)
    assert status != 0 and "cannot be written as .msh: the disk is full" in err
    assert file.read_text() == "from before"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["out.msh", "row.h5"]


def check_solids(file: Path) -> None:
    """The cells are as they were, none of them inside out."""
    from engrane_post.cell_mesh import of_file
    from engrane_post.mesh_files import read

    back = of_file(read(file))
    assert not [n for n in back.notes if "inside out" in n]
    assert len(back.blocks) == 6
    for block in back.blocks:
        kind = block.kind.name
        wanted = meshes.points_of(kind) + np.array([GAP * meshes.KINDS.index(kind), 0, 0])
        assert back.points[block.nodes[0]] == pytest.approx(wanted)


def gmsh_data(file: Path, section: str) -> dict[str, np.ndarray]:
    """Fields of a binary file of version 2.2, a row for each number. (meshio mixes them up.)"""
    out = {}
    for part in file.read_bytes().split(f"${section}\n".encode())[1:]:
        *lines, rest = part.split(b"\n", 8)
        name, width, count = lines[1].decode().strip('"'), int(lines[6]), int(lines[7])
        rows = np.frombuffer(rest, [("n", "<i4"), ("x", "<f8", (width,))], count)
        assert rows["n"].tolist() == list(range(1, count + 1))
        out[name] = rows["x"] if width > 1 else rows["x"][:, 0]
    return out


def test_msh(command, tmp_path: Path) -> None:
    """Gmsh knows numbers and vectors: other components are fields of their own."""
    path, file = row_of_cells(tmp_path / "row.h5"), tmp_path / "out.msh"
    status, out, err = command("export", path, "--mesh", file)
    assert (status, err) == (0, "") and "left out" not in out
    nodes, cells = gmsh_data(file, "NodeData"), gmsh_data(file, "ElementData")
    stress = np.stack([cells[f"STRESS_{c}"] for c in STRESS], axis=1)
    check_fields(
        path,
        by_id(nodes["node"], nodes["displacement"]),
        by_id(cells["element"], list(zip(cells["VON_MISES"], stress, strict=True))),
    )
    bare = tmp_path / "bare.msh"
    bare.write_bytes(file.read_bytes().split(b"$NodeData")[0])
    check_solids(bare)
    status, _, err = command("import", file, "-o", tmp_path / "deck.dat")
    assert status == 1 and "write the mesh alone" in err


def test_inp(command, tmp_path: Path) -> None:
    """Numbers are those of the deck; fields are said to be left out."""
    path = row_of_cells(tmp_path / "row.h5")
    status, out, _ = command("export", path, "--mesh", tmp_path / "out.inp")
    assert status == 0 and "left out: STRESS, VON_MISES, displacement" in out
    from engrane_post.abaqus import read

    mesh = read(tmp_path / "out.inp")
    assert sorted(c.type for c in mesh.cells) == sorted(meshes.KINDS)
    for block in mesh.cells:
        x = mesh.points[block.data[0]]
        shift = GAP * meshes.KINDS.index(block.type)
        assert x == pytest.approx(meshes.points_of(block.type) + np.array([shift, 0, 0]))
    lines = (tmp_path / "out.inp").read_text().splitlines()
    assert max(line.count(",") for line in lines) < 17
    with Results(path) as result:
        assert lines[3].startswith(f"{result.node_ids[1]}, ")
    assert any(line.startswith("101, 13, 15, 17") for line in lines)


def test_bdf(command, tmp_path: Path) -> None:
    path = row_of_cells(tmp_path / "row.h5")
    status, out, _ = command("export", path, "--mesh", tmp_path / "out.bdf")
    assert status == 0 and "left out: STRESS, VON_MISES, displacement" in out
    check_solids(tmp_path / "out.bdf")
    # of second order the same cards
    cards = [line[:8].strip() for line in (tmp_path / "out.bdf").read_text().splitlines()]
    assert [cards.count(card) for card in ("CTETRA", "CPENTA", "CHEXA")] == [2, 2, 2]


def test_surfaces(command, tmp_path: Path) -> None:
    """What is drawn of cells moves with them in the surfaces of `engrane export` without --mesh."""
    from test_export import grids

    path = row_of_cells(tmp_path / "row.h5")
    assert command("export", path, "-o", tmp_path / "out", "--no-forces")[0] == 0
    _, found = grids(tmp_path / "out.vtkhdf")
    with Results(path) as result:
        for k, grid in enumerate(found):
            places = result.points + result.frame(k).displacement
            part = grid.cell_data["part"]
            assert set(grid.cell_data["kind"]) == {KINDS.index("cell")}  # the bar, the cells
            cells = grid.extract_cells(np.flatnonzero(part == part.max()))
            assert cells.n_cells == 4 + 2 * (4 + 5 + 6)
            near = np.abs(places[None] - np.asarray(cells.points, float)[:, None]).max(axis=2).min(axis=1)
            assert near.max() < 1e-5


@pytest.mark.parametrize("name", ["out.vtkhdf", "out.pvd"])
def test_series(name: str, command, tmp_path: Path) -> None:
    """All frames, fields of nodes and of cells changing with them."""
    import pyvista as pv
    from test_export import grids

    path = row_of_cells(tmp_path / "row.h5")
    status, out, err = command("export", path, "--mesh", tmp_path / name)
    assert (status, err) == (0, "") and "at 3 frames" in out
    if name.endswith(".pvd"):
        reader = pv.PVDReader(str(tmp_path / name))
        times, found = reader.time_values, []
        for k in range(3):
            reader.set_active_time_point(k)
            found.append(reader.read()[0])
    else:
        times, found = grids(tmp_path / name)
        for k in range(3):  # for readers without steps
            _, (one,) = grids(tmp_path / f"out_steps/{k:06d}.hdf")
            assert np.array_equal(one.cell_data["VON_MISES"], found[k].cell_data["VON_MISES"])
            assert np.array_equal(one.cell_data["element"], found[k].cell_data["element"])
    assert list(times) == [0, 0.5, 1]
    for k, grid in enumerate(found):
        data = grid.cell_data
        check_fields(
            path,
            by_id(grid.point_data["node"], grid.point_data["displacement"]),
            by_id(data["element"], list(zip(data["VON_MISES"], data["STRESS"], strict=True))),
            frame=k,
        )


def test_faults(two: Path, command, tmp_path: Path) -> None:
    path = row_of_cells(tmp_path / "row.h5")
    for words, said in (
        ((two, "--mesh", tmp_path / "a.vtu"), "has no cells of a mesh"),
        ((path, "--mesh", tmp_path / "a.xdmf"), "ends in .vtu or"),
        ((path, "--mesh", tmp_path / "none" / "a.vtu"), "there is no folder"),
        ((path, "--mesh", tmp_path / "a.vtu", "--frame", "9"), "there is no frame 9"),
        ((path, "--frame", "1"), "--frame and --time go with --mesh"),
    ):
        status, _, err = command("export", *words)
        assert status == 1 and said in err


def test_round_trip(command, tmp_path: Path) -> None:
    """A mesh becomes a deck, the deck a result, the result a mesh again, with the stresses on it."""
    from test_import import run_plate

    path = run_plate(command, tmp_path)
    assert command("export", path, "--mesh", tmp_path / "back.med")[0] == 0
    start, back = meshio.read(tmp_path / "mesh.msh"), meshio.read(tmp_path / "back.med")
    assert np.array_equal(back.points, start.points)
    for kind in ("quad", "triangle"):
        assert np.array_equal(back.cells_dict[kind], start.cells_dict[kind])
        assert back.get_cell_data("VON_MISES", kind) == pytest.approx(
            np.full(len(back.cells_dict[kind]), 1e6)
        )
    assert back.point_data["displacement"][:, 0] == pytest.approx(start.points[:, 0] * 5e-6, abs=1e-15)


GROUPED = (
    SQUARES
    + """.SEL
 GROUP 1 MAILLES NOM "both of them" TOUT
 GROUP 2 MAILLES NOM "left (1)" I 1
 GROUP 3 MAILLES NOM "right" AT 2
 GROUP 4 NOEUDS NOM "foot, all" I 1 I 3
 GROUP 5 NOEUDS NOM "top" BOITE -1 30 9 11 -1 1
 GROUP 6 NOEUDS NOM "frame" UNION "foot, all" "top"
 GROUP 7 FACES NOM "end"
  I 2 2
.SEL
 GROUP 8 NOEUDS NOM "foot, all" I 2
 GROUP 9 MAILLES UNION "right" 2
.HYP MEMB BIDIM GROUP 1
.PHP GROUP 1 THICK VAL 1.
.AEL GROUP 1 MAT 1
.MAT I 1 BEHA "ELASTIC" YT 1000. NT 0.3
.CLM
 GROUP "foot, all" FIX C 1 2
 GROUP "end" PRE V 5.
.FIN
"""
)


@pytest.mark.parametrize("ending", [".vtu", ".vtk", ".med", ".inp", ".msh", ".bdf"])
def test_groups(ending: str, command, tmp_path: Path) -> None:
    """Groups of the deck, also those of several records, are there when the file is imported again."""
    from engrane_post.mesh_files import read

    program = os.environ.get("ENGRANE", "")
    if not Path(program).is_file():
        pytest.skip("the variable ENGRANE names no program")
    (tmp_path / "deck.dat").write_text(GROUPED)
    subprocess.run([program, "-q", "deck.dat"], cwd=tmp_path, check=True, capture_output=True)
    file = tmp_path / f"out{ending}"
    status, out, err = command("export", tmp_path / "deck.h5", "--mesh", file)
    assert (status, err) == (0, "")
    nodes = {"foot, all": [0, 1, 2], "top": [3, 4, 5], "frame": [0, 2, 3, 4, 5]}
    cells = {"both of them": [0, 1], "left (1)": [0], "right": [1], "group 9": [0, 1]}
    if ending == ".inp":
        nodes["foot_ all"] = nodes.pop("foot, all")
    if ending in (".msh", ".bdf"):
        kept = ("left (1)", "right") if ending == ".msh" else ()
        left = [*nodes, *(name for name in cells if name not in kept)]
        assert all(f'"{name}"' in out.split("left out: ")[-1] for name in left)
        nodes, cells = {}, {name: cells[name] for name in kept}
    else:
        assert '"' not in out
    if ending == ".msh":  # the importer reads no fields
        file.write_bytes(file.read_bytes().split(b"$NodeData")[0])
    mesh = read(file)
    assert {name: rows.tolist() for name, rows in mesh.point_groups.items()} == nodes
    found = {name: np.concatenate(rows).tolist() for name, rows in mesh.cell_groups.items()}
    assert {name: rows for name, rows in found.items() if not name.startswith("property")} == cells
