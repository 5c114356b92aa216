# SPDX-License-Identifier: BSD-3-Clause
"""`engrane import`: decks from meshes, judged by where their nodes are."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import meshes
import meshio
import numpy as np
import pytest
from engrane_post import Results


def imported(command, tmp_path: Path, mesh: meshio.Mesh | Path, *words: str) -> tuple[meshes.Deck, str, str]:
    """The deck made of a mesh, what was said, and what was warned of."""
    file = mesh
    if isinstance(mesh, meshio.Mesh):
        file = tmp_path / "mesh.vtu"
        mesh.write(file)
    status, out, err = command("import", file, "-o", tmp_path / "deck.dat", "--force", *words)
    assert status == 0, err
    return meshes.read_deck(tmp_path / "deck.dat"), out, err


def check_cell(deck: meshes.Deck, row: list[int]) -> None:
    """Mid-side nodes lie in the middle of their sides; the base runs anticlockwise seen from the top."""
    x = {n: p for i, p in deck.nodes.items() for n in (i, -i)}
    found = meshes.parts(row)
    loops = [found[0], found[-1]] if len(found[-1]) > 1 and len(found) > 1 else [found[0]]
    for loop in loops:
        if min(loop) < 0:
            assert [n > 0 for n in loop] == [True, False] * (len(loop) // 2)
            for k in range(1, len(loop), 2):
                ends = x[loop[k - 1]] + x[loop[(k + 1) % len(loop)]]
                assert x[loop[k]] == pytest.approx(ends / 2, abs=1e-12)
    base, top = meshes.base_and_top(row)
    if len(found) == 3:
        assert len(found[1]) == len(base)
        for i, n in enumerate(found[1]):
            up = top[i] if len(top) > 1 else top[0]
            assert n < 0 and x[n] == pytest.approx((x[base[i]] + x[up]) / 2, abs=1e-12)
    normal = np.cross(x[base[1]] - x[base[0]], x[base[-1]] - x[base[0]])
    assert normal @ (x[top[0]] - x[base[0]] if len(found) > 1 else [0, 0, 1]) > 0


@pytest.mark.parametrize("kind", meshes.KINDS)
@pytest.mark.parametrize("mirrored", [False, True])
def test_kinds(kind: str, mirrored: bool, command, tmp_path: Path) -> None:
    """Also where the mesh is another's reflection, so that its cells are inside out."""
    points = meshes.points_of(kind)
    if mirrored:
        points = points * [-1, 1, 1]
    mesh = meshio.Mesh(points, [(kind, np.arange(len(points))[None, :])])
    deck, _, err = imported(command, tmp_path, mesh)
    assert list(deck.cells) == [1] and len(deck.nodes) == len(points)
    assert sorted(abs(n) for n in deck.cells[1] if n) == list(range(1, len(points) + 1))
    for i, p in enumerate(points, 1):
        assert np.array_equal(deck.nodes[i], p)
    check_cell(deck, deck.cells[1])
    # wedges of VTK files are numbered either way round
    assert ("1 of 1 cells are numbered inside out" in err) == (mirrored and not kind.startswith("wedge"))


@pytest.mark.parametrize("kind", meshes.KINDS)
def test_faces_of_kinds(kind: str, command, tmp_path: Path) -> None:
    """Cells on the faces of a cell come back as its faces, whose corners are theirs."""
    points = meshes.points_of(kind)
    linear = meshes.SIDES[kind][0] if kind in meshes.SIDES else kind
    corners = len(meshes.CORNERS[linear])
    row = list(range(1, corners + 1))
    if linear in ("tetra", "wedge", "hexahedron"):
        row.insert({"tetra": 3, "wedge": 3, "hexahedron": 4}[linear], 0)
    count = {"triangle": 3, "quad": 4, "tetra": 4, "wedge": 5, "hexahedron": 6}[linear]
    blocks = [(kind, np.arange(len(points))[None, :])]
    sets = {}
    for k in range(1, count + 1):
        nodes = np.array(sorted(meshes.face(row, k))) - 1
        if len(nodes) == 4 and 1 < k < count:
            nodes = nodes[[0, 1, 3, 2]]
        blocks.append(({2: "line", 3: "triangle", 4: "quad"}[len(nodes)], nodes[None, :]))
    for k in range(1, count + 1):
        sets[f"face {k}"] = [np.array([0]) if b == k else np.zeros(0, int) for b in range(count + 1)]
    from engrane_post.cell_mesh import of_file
    from engrane_post.mesh_files import FileMesh

    mesh = of_file(FileMesh(Path("m"), points, blocks, sets))
    faces = {g.name: g.members.tolist() for g in mesh.groups if g.what == "FACES"}
    assert faces == {f"face {k}": [[1, k]] for k in range(1, count + 1)}
    nodes = {g.name: set(g.members.tolist()) for g in mesh.groups if g.what == "NOEUDS"}
    assert nodes == {f"face {k} nodes": meshes.face(row, k) for k in range(1, count + 1)}


def grouped(names: bool = True) -> meshio.Mesh:
    """A box of hexahedra with the groups "body", "left half" and "flank" in the manner of Gmsh."""
    points, cells, side = meshes.brick()
    half = points[cells].mean(axis=1)[:, 0] < 1.5
    blocks = [("hexahedron", cells[half]), ("hexahedron", cells[~half]), ("quad", side)]
    tags = [np.full(len(b), t) for t, (_, b) in zip((7, 8, 7), blocks, strict=True)]
    fields = {"left half": np.array([7, 3]), "right half": np.array([8, 3]), "flank": np.array([7, 2])}
    return meshio.Mesh(
        points,
        blocks,
        cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
        field_data=fields if names else {},
    )


def check_groups(deck: meshes.Deck, left: str = "left half", flank: str = "flank") -> None:
    what, rows = deck.groups[left]
    middle = {i: np.mean([deck.nodes[n] for n in row if n], axis=0) for i, row in deck.cells.items()}
    assert what == "MAILLES" and {n for (n,) in rows} == {i for i, x in middle.items() if x[0] < 1.5}
    what, rows = deck.groups[flank]
    assert what == "FACES" and len(rows) == 4
    for cell, k in rows:
        assert all(deck.nodes[n][0] == 0 for n in meshes.face(deck.cells[cell], k))
    what, rows = deck.groups[f"{flank} nodes"]
    assert what == "NOEUDS"
    assert {n for (n,) in rows} == {n for n, x in deck.nodes.items() if x[0] == 0}


def test_gmsh(command, tmp_path: Path) -> None:
    """A number belongs to a name and a dimension: 7 is cells here and faces there."""
    file = tmp_path / "mesh.msh"
    grouped().write(file, file_format="gmsh22")
    deck, out, err = imported(command, tmp_path, file)
    assert err == "" and 'group "flank": 4 faces' in out and "12 hexahedra" in out
    check_groups(deck)
    assert len(deck.groups) == 4


def test_numbers_without_names(command, tmp_path: Path) -> None:
    file = tmp_path / "mesh.msh"
    grouped(names=False).write(file, file_format="gmsh22")
    deck, _, _ = imported(command, tmp_path, file)
    found = {name: what for name, (what, _) in deck.groups.items()}
    assert found == {
        "physical 7": "MAILLES",
        "physical 7 faces": "FACES",
        "physical 7 nodes": "NOEUDS",
        "physical 8": "MAILLES",
    }


def test_gmsh_4_by_hand(command, tmp_path: Path) -> None:
    """As Gmsh writes it: a square of two triangles, a curve and a corner in physical groups, a node of no
    cell."""
    file = tmp_path / "mesh.msh"
    file.write_text(
        """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
0 1 "pin"
1 2 "left edge"
2 3 "plate"
$EndPhysicalNames
$Entities
1 1 1 0
1 0 0 0 1 1
1 0 0 0 0 1 0 1 2 0
1 0 0 0 1 1 0 1 3 1 1
$EndEntities
$Nodes
1 5 1 5
2 1 0 5
1
2
3
4
5
0 0 0
1 0 0
1 1 0
0 1 0
9 9 0
$EndNodes
$Elements
3 4 1 4
0 1 15 1
1 1
1 1 1 1
2 1 4
2 1 2 2
3 1 2 3
4 1 3 4
$EndElements
"""
    )
    deck, _, err = imported(command, tmp_path, file)
    assert deck.groups == {
        "plate": ("MAILLES", [(1,), (2,)]),
        "left edge": ("FACES", [(2, 3)]),
        "left edge nodes": ("NOEUDS", [(1,), (4,)]),
        "pin": ("NOEUDS", [(1,)]),
    }
    assert len(deck.nodes) == 4 and "1 node left out, which no cell has" in err


def test_med(command, tmp_path: Path) -> None:
    """Families are in several groups; solids run the other way round than in VTK."""
    mesh = grouped()
    cells = np.concatenate([mesh.cells[0].data, mesh.cells[1].data])[:, [0, 3, 2, 1, 4, 7, 6, 5]]
    half = np.arange(len(cells)) < len(mesh.cells[0].data)
    med = meshio.Mesh(mesh.points, [("hexahedron", cells), ("quad", mesh.cells[2].data)])
    med.cell_data = {"cell_tags": [np.where(half, -6, -7), np.full(4, -8)]}
    med.point_data = {"point_tags": np.where(mesh.points[:, 2] == 0, 3, 0)}
    med.cell_tags = {-6: ["left half", "all of it"], -7: ["all of it"], -8: ["flank"]}
    med.point_tags = {3: ["ground"]}
    file = tmp_path / "mesh.med"
    med.write(file)
    deck, _, err = imported(command, tmp_path, file)
    assert err == ""
    check_groups(deck)
    assert deck.groups["all of it"] == ("MAILLES", [(n,) for n in range(1, 13)])
    assert {n for (n,) in deck.groups["ground"][1]} == {n for n, x in deck.nodes.items() if x[2] == 0}
    for row in deck.cells.values():
        check_cell(deck, row)


def test_unv(command, tmp_path: Path) -> None:
    mesh = grouped()
    mesh.cells.append(meshio.CellBlock("line", np.array([[0, 1]])))
    left, count = len(mesh.cells[0].data), 12
    groups = {
        "left half": [(8, n + 1) for n in range(left)],
        "flank": [(8, count + 1 + n) for n in range(4)],
        "ground": [(7, 10 * (i + 1)) for i in np.flatnonzero(mesh.points[:, 2] == 0)],
        "axis": [(8, 17)],
    }
    file = tmp_path / "mesh.unv"
    meshes.write_unv(file, mesh, groups)
    deck, _, err = imported(command, tmp_path, file)
    assert err == ""
    check_groups(deck)
    assert {n for (n,) in deck.groups["ground"][1]} == {n for n, x in deck.nodes.items() if x[2] == 0}
    assert [deck.nodes[n].tolist() for (n,) in deck.groups["axis"][1]] == [[0, 0, 0], [0, 0, 1]]


@pytest.mark.parametrize("kind", ["tetra10", "hexahedron20"])
def test_unv_of_second_order(kind: str, command, tmp_path: Path) -> None:
    points = meshes.points_of(kind)
    file = tmp_path / "mesh.unv"
    meshes.write_unv(file, meshio.Mesh(points, [(kind, np.arange(len(points))[None, :])]), {})
    deck, _, err = imported(command, tmp_path, file)
    assert err == ""
    check_cell(deck, deck.cells[1])


ABAQUS = """*Heading
** by hand
*Part, name=Part-1
*Node
  10, 0., 0., 0.
  11, 1., 0., 0.
  12, 1., 1., 0.
  13, 0., 1., 0.
  20, 0., 0., 1.
  21, 1., 0., 1.
  22, 1., 1., 1.
*Node, nset=lid
  23, 0., 1., 1.
*Element, type=C3D8R, elset=Bricks
 5, 10, 11, 12, 13, 20, 21, 22,
 23
*Node
  30, 0., 0., 2.
  31, 1., 0., 2.
  33, 0., 1., 2.
*Element, type=C3D6, elset=Tops
 7, 20, 21, 23, 30, 31, 33
*Element, type=MASS, elset=lump
 9, 10
*Nset, nset=lid, generate
 30, 31, 1
*Nset, nset=Lid
 33,
*Elset, elset=both
 Bricks, TOPS
*Elset, elset=one, generate
 5, 5
*Surface, type=ELEMENT, name=press
 Bricks, S6
 7, S2
*End Part
"""


def test_abaqus(command, tmp_path: Path) -> None:
    """Labels with gaps, sets in pieces, by names and ranges, faces of a surface."""
    file = tmp_path / "mesh.inp"
    file.write_text(ABAQUS)
    deck, _, err = imported(command, tmp_path, file)
    assert "1 cell of the kind MASS left out" in err
    assert len(deck.cells) == 2 and len(deck.nodes) == 11
    for row in deck.cells.values():
        check_cell(deck, row)
    assert deck.groups["both"] == ("MAILLES", [(1,), (2,)])
    assert deck.groups["Bricks"] == deck.groups["one"] == ("MAILLES", [(1,)])
    assert deck.groups["Tops"] == ("MAILLES", [(2,)])
    what, rows = deck.groups["press"]
    found = [sorted(deck.nodes[n].tolist() for n in meshes.face(deck.cells[c], k)) for c, k in rows]
    assert what == "FACES" and found == [
        [[0, 0, 0], [0, 0, 1], [0, 1, 0], [0, 1, 1]],
        [[0, 0, 2], [0, 1, 2], [1, 0, 2]],
    ]
    lid = sorted(deck.nodes[n].tolist() for (n,) in deck.groups["lid"][1])
    assert lid == [[0, 0, 2], [0, 1, 1], [0, 1, 2], [1, 0, 2]]


@pytest.mark.parametrize("kind", ["tetra", "wedge", "hexahedron", "quad8"])
def test_surfaces_of_abaqus(kind: str, tmp_path: Path) -> None:
    """S1 is the base of a solid, S2 its top, the others stand on the sides of the base in turn (a
    tetrahedron has no top)."""
    from engrane_post.cell_mesh import of_file
    from engrane_post.mesh_files import read

    points = meshes.points_of(kind)
    types = {"tetra": "C3D4", "wedge": "C3D6", "hexahedron": "C3D8", "quad8": "CPE8R"}
    wanted = {"tetra": [1, 2, 3, 4], "wedge": [1, 5, 2, 3, 4], "hexahedron": [1, 6, 2, 3, 4, 5]}
    lines = ["*NODE", *(f"{i}, {x}, {y}, {z}" for i, (x, y, z) in enumerate(points, 1))]
    lines += [f"*ELEMENT, TYPE={types[kind]}", ",".join(str(n) for n in range(1, len(points) + 2))]
    lines[-1] = ",".join(["1", *(str(n) for n in range(1, len(points) + 1))])
    order = wanted.get(kind, [1, 2, 3, 4])
    for k in range(1, len(order) + 1):
        lines += [f"*SURFACE, NAME=S{k}", f"1, S{k}"]
    (tmp_path / "m.inp").write_text("\n".join(lines))
    mesh = of_file(read(tmp_path / "m.inp"))
    faces = {g.name: g.members.tolist() for g in mesh.groups if g.what == "FACES"}
    assert faces == {f"S{k}": [[1, own]] for k, own in enumerate(order, 1)}


def test_nodes_of_abaqus() -> None:
    """Coordinates that a line lacks are zero, also where the numbers happen to be as many."""
    from engrane_post.abaqus import _nodes

    for lines, wanted in (
        (["1, 2., 3.", "2, 4."], [[2, 3, 0], [4, 0, 0]]),
        (["1, 2., 3.,", "2, , 4.,"], [[2, 3, 0], [0, 4, 0]]),
        (["1, 2., 3., 4.", " 2,5.,6.,7.,"], [[2, 3, 4], [5, 6, 7]]),
        (["1, 2., 3.", "2, 4., 5., 6., 7."], [[2, 3, 0], [4, 5, 6]]),
    ):
        labels, points = _nodes(lines)
        assert labels.tolist() == [1, 2] and points.tolist() == wanted


def test_faults_of_abaqus(command, tmp_path: Path) -> None:
    file = tmp_path / "mesh.inp"
    for text, said in (
        (ABAQUS.replace("*Part", "*Part, name=a\n*End Part\n*Part", 1), "has several parts"),
        (ABAQUS.replace(" 7, 20,", " 7, 99,"), "names node 99"),
        (ABAQUS.replace("Bricks, TOPS", "nothing"), "names nothing, which is no set"),
        (ABAQUS.replace(" 23\n*Node", "*Node", 1), "are no rows of a label and 8 nodes"),
        ("*HEADING\n", "has no *NODE and *ELEMENT"),
        ("*INCLUDE, INPUT=mesh.inp\n", "goes round in a circle"),
    ):
        file.write_text(text)
        status, _, err = command("import", file, "-o", tmp_path / "d.dat")
        assert status == 1 and said in err and str(file) in err
    (tmp_path / "whole.inp").write_text("*INCLUDE, INPUT=mesh.inp\n")
    file.write_text(ABAQUS)
    assert command("import", tmp_path / "whole.inp", "-o", tmp_path / "d.dat")[0] == 0


def test_other_formats(command, tmp_path: Path) -> None:
    """The same nodes and cells, whatever the file."""
    plain = grouped()
    plain.cells, plain.cell_data, plain.field_data = plain.cells[:2], {}, {}
    wanted, _, _ = imported(command, tmp_path, plain)
    for name in ("mesh.vtk", "mesh.bdf", "mesh.mesh", "mesh.med"):
        one = meshio.Mesh(plain.points, [("hexahedron", np.concatenate([b.data for b in plain.cells]))])
        one.write(tmp_path / name)
        deck, _, _ = imported(command, tmp_path, tmp_path / name)
        middle = [
            sorted(
                np.mean([d.nodes[n] for n in row if n], axis=0).round(9).tolist() for row in d.cells.values()
            )
            for d in (wanted, deck)
        ]
        assert middle[0] == middle[1]
        for row in deck.cells.values():
            check_cell(deck, row)


def test_what_is_left_out(command, tmp_path: Path) -> None:
    points, cells, _ = meshes.brick(2, 1, 1)
    points = np.concatenate([points, [[0, 0, 5], [9, 9, 9]]])
    twice, flat = cells[0].copy(), cells[0].copy()
    twice[6] = twice[5]
    flat[4:] = flat[:4][::-1]
    folded = cells[1].copy()
    folded[[4, 5]] = folded[[5, 4]]
    mesh = meshio.Mesh(
        points,
        [
            ("hexahedron", np.array([cells[0], twice, folded])),
            ("pyramid", np.array([[*cells[0][:4], len(points) - 2]] * 3)),
            ("line", np.array([[0, 1]])),
            ("vertex", np.array([[0]])),
        ],
    )
    deck, out, err = imported(command, tmp_path, mesh)
    assert "3 pyramids left out: a deck has no such cells" in err
    assert "1 cell left out: without content, or with one node twice" in err
    assert "cells that fold over themselves: 1, the first is cell 2" in err
    assert "2 nodes left out, which no cell has" in err
    assert all(str(tmp_path / "mesh.vtu") in line for line in err.splitlines())
    assert len(deck.cells) == 2 and "2 hexahedra" in out


def test_nothing_left(command, tmp_path: Path) -> None:
    points, cells, _ = meshes.brick(1, 1, 1)
    for block, said in (
        (("pyramid", cells[:, :5]), "nothing that a deck can take: 1 pyramid."),
        (("line", cells[:, :2]), "nothing that a deck can take: 1 line."),
        (("quad9", np.array([[0, 1, 2, 3, 4, 5, 6, 7, 0]])), "Mesh.SecondOrderIncomplete = 1"),
        (("tetra", np.array([[0, 1, 2, 2]])), "no cells with any content; 1 cell left out"),
        (("quad", cells[:, [0, 1, 6, 4]]), "is a surface in space"),
    ):
        meshio.Mesh(points, [block]).write(tmp_path / "m.vtu")
        status, out, err = command("import", tmp_path / "m.vtu", "-o", tmp_path / "d.dat")
        assert (status, out) == (1, "") and said in err and "m.vtu" in err
    upright = np.array([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]], float)
    meshio.Mesh(upright, [("quad", np.array([[0, 1, 2, 3]]))]).write(tmp_path / "m.vtu")
    status, _, err = command("import", tmp_path / "m.vtu", "-o", tmp_path / "d.dat")
    assert status == 1 and "no cells in the x-y plane" in err and "--as membranes" in err
    assert not (tmp_path / "d.dat").exists()


def test_merge_and_scale(command, tmp_path: Path) -> None:
    """Two squares with edges of their own, at the height 7; the places are alike to a millionth."""
    points = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [1 + 1e-7, 0], [2, 0], [2, 1], [1, 1 - 1e-7]])
    points = np.column_stack([points, np.full(8, 7.0)])
    mesh = meshio.Mesh(points, [("quad", np.array([[0, 1, 2, 3], [4, 5, 6, 7]]))])
    deck, _, err = imported(command, tmp_path, mesh, "--scale", "0.001")
    assert len(deck.nodes) == 8 and err == ""
    assert deck.nodes[6] == pytest.approx([0.002, 0, 0.007], abs=1e-15)
    deck, _, err = imported(command, tmp_path, mesh, "--merge", "1e-6")
    assert len(deck.nodes) == 6 and "2 nodes of 8 joined" in err
    assert len(set(map(abs, deck.cells[1])) & set(map(abs, deck.cells[2]))) == 2


def test_inner_faces(command, tmp_path: Path) -> None:
    """A face between two cells is one of the first; a quadrilateral that bounds nothing keeps its nodes."""
    points, cells, _ = meshes.brick(2, 1, 1)
    inner, stray = cells[0][[1, 2, 6, 5]], cells[0][[0, 2, 6, 4]]
    mesh = meshio.Mesh(points, [("hexahedron", cells), ("quad", np.array([inner, stray]))])
    mesh.cell_data = {"material": [np.array([1, 1]), np.array([2, 3])]}
    deck, _, err = imported(command, tmp_path, mesh)
    assert deck.groups["material 2"] == ("FACES", [(1, 3)])
    assert deck.groups["material 3"][0] == "NOEUDS" and len(deck.groups["material 3"][1]) == 4
    assert "faces in groups that lie between two cells: 1;" in err
    assert "1 of 2 cells in groups bound no cell" in err


def test_files(command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is written over unless asked; `--list` writes nothing."""
    monkeypatch.chdir(tmp_path)
    grouped().write("wheel.msh", file_format="gmsh22")
    status, out, _ = command("import", "wheel.msh", "--list")
    assert status == 0 and 'group "flank": 4 faces' in out and not Path("wheel.dat").exists()
    assert command("import", "wheel.msh")[0] == 0
    Path("wheel.dat").write_text("mine")
    status, _, err = command("import", "wheel.msh")
    assert status == 1 and "wheel.dat exists; --force" in err and Path("wheel.dat").read_text() == "mine"
    assert command("import", "wheel.msh", "--force")[0] == 0
    assert Path("wheel.dat").read_text().startswith("! mesh of wheel.msh")
    for words, said in (
        (("none.msh",), "There is no file none.msh"),
        (("wheel.msh", "-o", "wheel.txt"), "ends in .dat"),
        (("wheel.msh", "--scale", "0"), "--scale must be above 0"),
        (("wheel.msh", "--merge", "2"), "--merge must lie between 0 and 1"),
    ):
        status, _, err = command("import", *words)
        assert status == 1 and said in err
    for name in ("bad.msh", "bad.unv", "bad.what", "bad.med"):
        Path(name).write_text("hello")
        status, _, err = command("import", name)
        assert status == 1 and name in err


def test_many_nodes(command, tmp_path: Path) -> None:
    """No loop over nodes or cells: 27 times as many take about as much more."""
    from time import process_time

    took = []
    for n in (20, 60):
        points, cells, side = meshes.brick(n, n, n)
        meshio.Mesh(points, [("hexahedron", cells), ("quad", side)]).write(tmp_path / "m.vtu")
        runs = []
        for _ in range(2):  # the shorter one: others may be at work on this machine
            start = process_time()
            assert command("import", tmp_path / "m.vtu", "-o", tmp_path / "d.dat", "--force")[0] == 0
            runs.append(process_time() - start)
        took.append(min(runs))
    assert took[1] < 3 * 27 * took[0]


def program() -> str:
    name = os.environ.get("ENGRANE", "")
    if not Path(name).is_file():
        pytest.skip("the variable ENGRANE names no program")
    return name


def with_cards(file: Path, cards: str) -> None:
    """The deck with these cards behind its mesh."""
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace(".FIN 1\n", cards + ".FIN 1\n"), encoding="utf-8")


def plate() -> meshio.Mesh:
    """3 x 2 quadrilaterals and as many pairs of triangles right of them, with groups for both ends and a
    corner."""
    points, cells, _ = meshes.brick(6, 2, 1)
    flat = points[:, 2] == 0
    rows = np.cumsum(flat) - 1
    quads = rows[cells[:, :4][flat[cells[:, :4]].all(axis=1)]]
    points = points[flat]
    right = quads[6:]
    triangles = np.concatenate([right[:, [0, 1, 2]], right[:, [0, 2, 3]]])
    ends = [np.flatnonzero(points[:, 0] == x) for x in (0, 6)]
    lines = [np.stack([e[:-1], e[1:]], axis=1) for e in ends]
    return meshio.Mesh(
        points,
        [("quad", quads[:6]), ("triangle", triangles), ("line", np.concatenate(lines)), ("vertex", [[0]])],
        cell_data={"gmsh:physical": [np.full(6, 1), np.full(12, 1), np.array([2, 2, 3, 3]), np.array([4])]},
        field_data={
            "plate": np.array([1, 2]),
            "left": np.array([2, 1]),
            "right": np.array([3, 1]),
            "corner": np.array([4, 0]),
        },
    )


def run_plate(command, tmp_path: Path) -> Path:
    """A plate pulled by p at its right edge: the stress is p everywhere, u = p x/E, v = -nu p y/E."""
    file = tmp_path / "mesh.msh"
    mesh = plate()
    mesh.cell_data["gmsh:geometrical"] = mesh.cell_data["gmsh:physical"]
    mesh.write(file, file_format="gmsh22")
    deck, _, err = imported(command, tmp_path, file)
    assert err == "" and deck.groups["right"][0] == "FACES"
    with_cards(
        tmp_path / "deck.dat",
        '.MAT\n I 1 BEHA "ELASTIC" YT 2E11 NT 0.25\n.HYP MEMB BIDIM\n.PHP\n GROUP "plate" THICK VAL 0.01\n'
        '.AEL\n GROUP "plate" MAT 1\n.CLM\n GROUP "left nodes" FIX C 1\n GROUP "corner" FIX C 2\n'
        ' GROUP "right" PRE V -1E6\n',
    )
    done = subprocess.run(
        [program(), tmp_path / "deck.dat", "-o", tmp_path / "run"], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return tmp_path / "run.h5"


def test_run(command, tmp_path: Path) -> None:
    """From a mesh to stresses: cells, groups of cells, nodes and edges are those of the mesh."""
    with Results(run_plate(command, tmp_path)) as result:
        frame = result.frame(-1)
        x = result.points
        assert frame.displacement[:, 0] == pytest.approx(1e6 * x[:, 0] / 2e11, abs=1e-15)
        assert frame.displacement[:, 1] == pytest.approx(-0.25e6 * x[:, 1] / 2e11, abs=1e-15)
        assert result.cell_field("VON_MISES", frame.index)[:18] == pytest.approx(np.full(18, 1e6))


def test_template(command, tmp_path: Path) -> None:
    """The cards that stand below the mesh as comments are right: without their marks the deck is solved."""
    file = tmp_path / "mesh.msh"
    mesh = plate()
    mesh.cell_data["gmsh:geometrical"] = mesh.cell_data["gmsh:physical"]
    mesh.write(file, file_format="gmsh22")
    points, cells, side = meshes.brick()
    solid = meshio.Mesh(points, [("hexahedron", cells), ("quad", side)])
    solid.cell_data = {"material": [np.full(12, 1), np.full(4, 2)]}
    for name, source in (("plate", file), ("solid", solid)):
        imported(command, tmp_path, source)
        deck = tmp_path / f"{name}.dat"
        text = (tmp_path / "deck.dat").read_text(encoding="utf-8")
        for mark in ("!.", "! I", "! GROUP", "! NOEUD"):
            text = text.replace(mark, mark[1:])
        deck.write_text(text, encoding="utf-8")
        done = subprocess.run([program(), "check", deck], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        assert "error" not in done.stderr
