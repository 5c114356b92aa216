# SPDX-License-Identifier: BSD-3-Clause
"""`engrane import`: what mesh files of other programs say of places, how they order the nodes of cells of
second order, and how VTK writes meshes."""

from __future__ import annotations

import subprocess
from pathlib import Path

import meshes
import meshio
import numpy as np
import pytest
from test_import import check_cell, imported, program


def test_what_places_nodes_is_read_or_refused(command, tmp_path: Path) -> None:
    """Nothing that moves or makes nodes or cells is passed over."""
    file, nodes = tmp_path / "mesh.inp", "1, 2., 0., 0.\n2, 3., 0., 0.\n3, 3., 90., 0.\n4, 2., 90., 1.\n"
    quad = "*ELEMENT, TYPE=S4, ELSET=e\n1, 1, 2, 3, 4\n"
    file.write_text(f"*NODE, SYSTEM=C\n{nodes.replace('1.', '0.', 1)}".replace(", 1.\n", ", 0.\n") + quad)
    deck, _, _ = imported(command, tmp_path, file)
    assert np.allclose([deck.nodes[i] for i in (1, 2, 3, 4)], [[2, 0, 0], [3, 0, 0], [0, 3, 0], [0, 2, 0]])
    (tmp_path / "nodes.txt").write_text("1, 0., 0.\n2, 1., 0.\n3, 1., 1.\n4, 0., 1.\n")
    file.write_text(f"*NODE, INPUT=nodes.txt\n{quad}")
    assert np.allclose(imported(command, tmp_path, file)[0].nodes[3], [1, 1, 0])
    for text, said in (
        ("*SYSTEM\n1., 0., 0., 0., 1., 0.\n", "*SYSTEM moves or turns nodes"),
        ("*ELGEN, ELSET=e\n1, 2, 1, 1\n", "*ELGEN makes elements from others"),
        ("*NGEN\n1, 4, 1\n", "*NGEN makes nodes from others"),
        ("*NODE, INPUT=other.txt\n", "other.txt, which *NODE reads"),
    ):
        file.write_text(text + f"*NODE\n{nodes}{quad}")
        status, _, err = command("import", file, "-o", tmp_path / "d.dat")
        assert status == 1 and said in err
    bulk = tmp_path / "mesh.bdf"
    cells = "CTRIA3  1       1       1       2       3       \nENDDATA\n"
    for grid in ("GRID,{i},{cp},{x},{y},0.\n", "GRID    {i:<8}{cp:<8}{x:<8}{y:<8}0.      \n"):
        for cp, status in (("", 0), ("0", 0), ("3", 1)):
            rows = [
                grid.format(i=i, cp=cp, x=x, y=y)
                for i, x, y in ((1, "0.", "0."), (2, "1.D+1", "0."), (3, "0.", "1."))
            ]
            bulk.write_text("BEGIN BULK\n" + "".join(rows) + cells)
            found, _, err = command("import", bulk, "-o", tmp_path / "d.dat", "--force")
            assert found == status and ("field CP" in err) == (status == 1), err
    assert np.allclose(meshes.read_deck(tmp_path / "d.dat").nodes[2], [10, 0, 0])


@pytest.mark.parametrize("version", ["2.2", "4.1"])
@pytest.mark.parametrize("kind", ["tetra10", "wedge15", "hexahedron20"])
def test_files_of_gmsh(kind: str, version: str, command, tmp_path: Path) -> None:
    """One cell of second order in a file of Gmsh 4.15, whose mid-side nodes have their own order; coordinates
    rounded to nine digits. Physical groups of the cell, of the face z = 0 and of a corner."""
    deck, out, err = imported(command, tmp_path, Path(__file__).parent / "gmsh" / f"{kind}_{version}.msh")
    assert err == "" and 'group "base side": 1 face' in out
    check_cell(deck, deck.cells[1])
    places = [sorted(x.round(6).tolist() for x in of) for of in (deck.nodes.values(), meshes.points_of(kind))]
    assert places[0] == places[1]
    assert deck.groups["body"] == ("MAILLES", [(1,)])
    what, ((cell, face),) = deck.groups["base side"]
    assert what == "FACES" and cell == 1
    below = {n for n, x in deck.nodes.items() if x[2] == 0}
    assert meshes.face(deck.cells[1], face) < below
    assert {n for (n,) in deck.groups["base side nodes"][1]} == below
    ((pin,),) = deck.groups["pin"][1]
    assert deck.nodes[pin].tolist() == [2, 0, 0]


@pytest.mark.parametrize("suffix", [".vtk", ".med", ".inp", ".bdf"])
@pytest.mark.parametrize("kind", ["triangle6", "quad8", "tetra10", "hexahedron20"])
def test_cells_of_second_order(kind: str, suffix: str, command, tmp_path: Path) -> None:
    """As meshio writes them: every mid-side node is in the middle of its side, and none is lost."""
    points = meshes.points_of(kind)
    if suffix == ".med" and points[:, 2].any():
        points = points * [1, -1, 1]  # solids of MED run the other way round, which meshio does not know
    file = tmp_path / f"mesh{suffix}"
    meshio.Mesh(points, [(kind, np.arange(len(points))[None, :])]).write(file)
    deck, _, _ = imported(command, tmp_path, file)
    assert len(deck.cells) == 1 and len(deck.nodes) == len(points)
    check_cell(deck, deck.cells[1])
    places = [sorted(x.round(9).tolist() for x in of) for of in (deck.nodes.values(), points)]
    assert places[0] == places[1]


def test_vtk_as_vtk_writes_it(command, tmp_path: Path) -> None:
    import pyvista as pv

    x, y, z = np.meshgrid([0.0, 1.0, 2.0], [0.0, 1.0], [0.0, 1.0], indexing="ij")
    grid = pv.StructuredGrid(x, y, z).cast_to_unstructured_grid()
    grid.cell_data["material"] = np.array([1, 2])
    grid.point_data["six"] = np.ones((grid.n_points, 6))
    for binary in (True, False):
        grid.save(tmp_path / "mesh.vtk", binary=binary)
        _, out, _ = imported(command, tmp_path, tmp_path / "mesh.vtk")
        assert "2 hexahedra" in out or "2 cells" in out
        assert 'group "material 2": 1 cell' in out


@pytest.mark.parametrize("ending", [".vtk", ".vtu"])
def test_voxels_and_pixels(ending: str, command, tmp_path: Path) -> None:
    """Their nodes run in rows. Meshio left them out of a .vtu without a word, and could not read the .vtk."""
    import pyvista as pv

    x, y, z = (a.ravel(order="F") for a in np.meshgrid([0, 1, 2], [0, 1], [0, 1], indexing="ij"))
    points, file = np.column_stack([x, y, z]).astype(float), tmp_path / f"mesh{ending}"
    rows = np.array([[8, 0, 1, 3, 4, 6, 7, 9, 10], [8, 1, 2, 4, 5, 7, 8, 10, 11]])
    grid = pv.UnstructuredGrid(rows.ravel(), [11, 11], points)
    grid.cell_data["material"] = np.array([1, 2])
    grid.save(file)
    deck, out, err = imported(command, tmp_path, file)
    assert err == "" and len(deck.cells) == 2 and 'group "material 2": 1 cell' in out
    for cell in deck.cells.values():
        check_cell(deck, cell)
    pv.UnstructuredGrid([4, 0, 1, 2, 3], [8], points[[0, 1, 3, 4]]).save(file)
    deck, _, err = imported(command, tmp_path, file)
    assert err == ""
    assert len(deck.cells) == 1
    check_cell(deck, deck.cells[1])
    pv.UnstructuredGrid([*rows[0], 4, 0, 1, 2, 7], [11, 36], points).save(file)
    status, _, err = command("import", file, "-o", tmp_path / "d.dat", "--force")
    assert status == 1 and "cells of VTK's types" in err


def test_wedges_of_vtk_either_way_round(command, tmp_path: Path) -> None:
    """VTK's own writer has the base of a wedge as that of other solids, meshio's the other way round: neither
    is inside out."""
    import pyvista as pv

    points = meshes.points_of("wedge")
    for mirrored in (False, True):
        nodes = [0, 2, 1, 3, 5, 4] if mirrored else [0, 1, 2, 3, 4, 5]
        pv.UnstructuredGrid([6, *nodes], [pv.CellType.WEDGE], points).save(tmp_path / "mesh.vtu")
        deck, _, err = imported(command, tmp_path, tmp_path / "mesh.vtu")
        assert err == ""
        check_cell(deck, deck.cells[1])


GRIDS = "".join(
    f"GRID    {i:<8}        {x:<8}{y:<8}{z:<8}\n"
    for i, (x, y, z) in enumerate(meshes.CORNERS["hexahedron"], 1)
)


def test_cards_of_nastran(command, tmp_path: Path) -> None:
    """However a card goes on in the next line, and whatever stands behind its nodes."""
    file = tmp_path / "mesh.bdf"
    wide = [f"{n:>16}" for n in (1, 10, *range(1, 9))]
    plain = "CHEXA          1      10       1       2       3       4       5       6"
    for card in (
        f"{plain}\n               7       8\n",
        f"{plain}+A\n$ between\n+A             7       8\n",
        f"{plain}       \n*                      7               8\n",
        "CHEXA,1,10,1,2,3,4,5,6\n,7,8\n",
        "chexa,1,10,1,2,3,4,5,6,+\n+,7,8\n",
        f"CHEXA*  {''.join(wide[:4])}\n*       {''.join(wide[4:8])}\n*       {''.join(wide[8:])}\n",
    ):
        file.write_text(f"SOL 101\nBEGIN BULK\n{GRIDS}{card}CQUAD4,2,20,1,2,6,5,30.\nCBUSH,3,4,1\n")
        deck, _, _ = imported(command, tmp_path, file)
        assert deck.cells == {1: [1, 2, 3, 4, 0, 5, 6, 7, 8]}
        assert deck.groups["property 10"] == ("MAILLES", [(1,)])
        assert deck.groups["property 20"] == ("FACES", [(1, 2)])


def test_what_nastran_gives_twice_or_in_vain(command, tmp_path: Path) -> None:
    """The later of two grids or cells of one number counted, without a word; so were links left out."""
    file = tmp_path / "mesh.bdf"
    cell = "CHEXA,2,20,1,2,3,4,5,6\n,7,8\n"
    for more, said in (("GRID,1,,9.,9.,9.\n", "GRID 1 is given twice"), (cell, "cell 2 is given twice")):
        file.write_text(f"BEGIN BULK\n{GRIDS}{cell}{more}")
        status, _, err = command("import", file, "-o", tmp_path / "d.dat")
        assert status == 1 and said in err
    file.write_text(f"BEGIN BULK\n{GRIDS}{cell}RBE2,9,1,123,2,5\nCONM2,7,1,,5.\nCONM2,8,2,,5.\nPSOLID,20,1\n")
    _, out, err = imported(command, tmp_path, file)
    assert "RBE2 (1 of them) left out" in out + err and "CONM2 (2 of them) left out" in out + err
    assert "PSOLID" not in out + err


@pytest.mark.parametrize(
    ("card", "nodes"),
    [
        ("CQUADX", 4),
        ("CQUADX", 8),
        ("CQUAD", 4),
        ("CQUADX4", 4),
        ("CTRIAX", 3),
        ("CPLSTN4", 4),
        ("CTRAX3", 3),
    ],
)
def test_plane_and_axisymmetric_cells_of_nastran(card: str, nodes: int, command, tmp_path: Path) -> None:
    """CQUADX and CTRIAX with and without mid-side nodes, which stand behind the corners."""
    kind = {3: "triangle", 4: "quad", 8: "quad8"}[nodes]
    points, file = meshes.points_of(kind), tmp_path / "mesh.bdf"
    grids = "".join(f"GRID,{i},,{x!r},{y!r},{z!r}\n" for i, (x, y, z) in enumerate(points.tolist(), 1))
    fields = [str(n) for n in (1, 10, *range(1, nodes + 1))]
    lines = [",".join(fields[i : i + 8]) for i in range(0, len(fields), 8)]
    file.write_text(grids + f"{card}," + "\n,".join(lines))
    deck, _, err = imported(command, tmp_path, file)
    assert err == "" and len(deck.cells) == 1 and len(deck.nodes) == nodes
    check_cell(deck, deck.cells[1])
    assert deck.groups["property 10"] == ("MAILLES", [(1,)])


def test_cells_of_nastran_that_are_not_known(command, tmp_path: Path) -> None:
    """They were left out without a word."""
    file = tmp_path / "mesh.bdf"
    file.write_text(f"{GRIDS}CHEXA,1,1,1,2,3,4,5,6\n,7,8\nCHEXAFD,2,1,1,2,3,4,5,6\n,7,8\n")
    status, _, err = command("import", file, "-o", tmp_path / "d.dat")
    assert status == 1 and f"{file}: cells of the card CHEXAFD (the first is 2) are not read" in err


def test_files_that_nastran_includes(command, tmp_path: Path) -> None:
    """From the folder of the file or of the first one, with names over several lines; none is passed over."""
    main, folder = tmp_path / "mesh.bdf", tmp_path / "parts"
    folder.mkdir()
    (folder / "grids.bdf").write_text(GRIDS)
    (folder / "all.bdf").write_text("include 'grids.bdf'\nINCLUDE parts/cells.bdf\n")
    (folder / "cells.bdf").write_text("CHEXA,1,10,1,2,3,4,5,6\n,7,8\n")
    for text in ("INCLUDE 'parts/all.bdf'\nENDDATA\n", 'Include "parts/\n   all.bdf" $ all of it\n'):
        main.write_text(f"SOL 101\nBEGIN BULK\n{text}")
        deck, _, _ = imported(command, tmp_path, main)
        assert deck.cells == {1: [1, 2, 3, 4, 0, 5, 6, 7, 8]}
        assert deck.groups["property 10"] == ("MAILLES", [(1,)])
    for text, said in (
        ("INCLUDE 'none.bdf'\n", f"{main}: there is no file none.bdf, which INCLUDE reads"),
        ("INCLUDE 'mesh.bdf'\n", "INCLUDE goes round in a circle"),
    ):
        main.write_text(GRIDS + text)
        status, _, err = command("import", main, "-o", tmp_path / "d.dat")
        assert status == 1 and said in err


def test_cells_with_nodes_missing(command, tmp_path: Path) -> None:
    """The file and the cell are named, whatever the format."""
    bulk, unv, vtu = (tmp_path / f"mesh{ending}" for ending in (".bdf", ".unv", ".vtu"))
    for card, said in (
        ("CHEXA,7,1,1,2,3,4,5,6", "cell 7 (CHEXA) has 6 nodes instead of 8 or 20"),
        ("CHEXA,7,1,1,2,3,4,5,6\n,7,8,1,2", "cell 7 (CHEXA) has 10 nodes instead of 8 or 20"),
        ("CTRIA3,7,1,1,,3", "cell 7 (CTRIA3) has 2 nodes instead of 3"),
        ("CTRIA3,7,1,1,2,99", "cell 7 names node 99, which has no GRID"),
    ):
        bulk.write_text(f"{GRIDS}{card}\n")
        status, _, err = command("import", bulk, "-o", tmp_path / "d.dat")
        assert status == 1 and f"{bulk}: {said}" in err
    points, cells, _ = meshes.brick(1, 1, 1)
    meshes.write_unv(unv, meshio.Mesh(points, [("hexahedron", cells)]), {})
    unv.write_text(unv.read_text().replace("115         1", "112         1"))
    status, _, err = command("import", unv, "-o", tmp_path / "d.dat")
    assert status == 1 and f"{unv}: cell 1 has 8 nodes instead of 6" in err
    meshio.Mesh(points, [("tetra", cells[:, :4]), ("tetra", cells[:, :4] + 5)]).write(vtu)
    status, _, err = command("import", vtu, "-o", tmp_path / "d.dat")
    assert status == 1 and f"{vtu}: cell 2 (tetra) names node" in err


def test_names_in_utf_8_and_latin_1(command, tmp_path: Path) -> None:
    points, cells, _ = meshes.brick(1, 1, 1)
    inp, unv = tmp_path / "mesh.inp", tmp_path / "mesh.unv"
    lines = [f"{i}, {x}, {y}, {z}" for i, (x, y, z) in enumerate(points, 1)]
    row = ", ".join(str(n + 1) for n in cells[0])
    for coding in ("utf-8", "utf-8-sig", "latin-1"):
        text = "\n".join(
            ["*NODE", *lines, "*ELEMENT, TYPE=C3D8", f"1, {row}", '*NSET, NSET="bas côté"', "1, 2"]
        )
        inp.write_bytes(text.encode(coding))
        meshes.write_unv(unv, meshio.Mesh(points, [("hexahedron", cells)]), {"bas cote": [(7, 10), (7, 20)]})
        unv.write_bytes(unv.read_text().replace("bas cote", "bas côté").encode(coding))
        for file in (inp, unv):
            deck, _, _ = imported(command, tmp_path, file)
            assert deck.groups["bas côté"] == ("NOEUDS", [(1,), (2,)])


PLATE = """*NODE
1, 0, 0
2, 1, 0
3, 1, 1
4, 0, 1
5, .5, 0
6, 1, .5
7, .5, 1
8, 0, .5
9, 5, 5
*ELEMENT, TYPE=CPS8, ELSET=web
1, 1, 2, 3, 4, 5, 6, 7, 8
"""


def test_groups_of_which_nothing_remains(command, tmp_path: Path) -> None:
    """Nodes without cells, and cells that are not there."""
    inp, unv = tmp_path / "mesh.inp", tmp_path / "mesh.unv"
    inp.write_text(f"{PLATE}*NSET, NSET=far\n9\n*ELSET, ELSET=gone\n77\n*SURFACE, NAME=pressed\n77, S4\n")
    deck, _, err = imported(command, tmp_path, inp)
    assert '3 groups left out, of which nothing remains: "gone", "pressed", "far".' in err
    assert list(deck.groups) == ["web"]
    points, cells, _ = meshes.brick(1, 1, 1)
    meshes.write_unv(unv, meshio.Mesh(points, [("hexahedron", cells)]), {"one": [(8, 77)], "no": [(6, 1)]})
    _, _, err = imported(command, tmp_path, unv)
    assert '2 groups left out, of which nothing remains: "one", "no".' in err


def test_surfaces_of_nodes(command, tmp_path: Path) -> None:
    """*SURFACE, TYPE=NODE is a group of nodes; it was left out without a word."""
    file = tmp_path / "mesh.inp"
    file.write_text(f"{PLATE}*NSET, NSET=Rim\n1, 2\n*SURFACE, TYPE=NODE, NAME=Slave\nRIM, 1.\n3,\n")
    deck, _, _ = imported(command, tmp_path, file)
    assert deck.groups["Slave"] == ("NOEUDS", [(1,), (2,), (3,)])
    assert deck.groups["Rim"] == ("NOEUDS", [(1,), (2,)])
    named = f"{PLATE}*NSET, NSET=Rim\n1, 2\n*SURFACE, TYPE=NODE, NAME=Rim\n{{}}\n"
    file.write_text(named.format("Rim"))
    assert imported(command, tmp_path, file)[0].groups["Rim"] == ("NOEUDS", [(1,), (2,)])
    for rows, said in (
        ("3", "*SURFACE Rim has other nodes than *NSET Rim; rename one"),
        ("other, 1.", "*SURFACE names other, which is no set of nodes before it"),
    ):
        file.write_text(named.format(rows))
        status, _, err = command("import", file, "-o", tmp_path / "d.dat")
        assert status == 1 and f"{file}: {said}" in err


def test_what_abaqus_allows(command, tmp_path: Path) -> None:
    """Blanks before keywords, exponents with D, shells with the nodes of solids, lines of three nodes whose
    second is the middle."""
    file = tmp_path / "mesh.inp"
    plain = f"{PLATE}*ELEMENT, TYPE=SAX2, ELSET=rim\n2, 1, 5, 2\n*NSET, NSET=one\n1\n"
    for text in (
        plain,
        plain.replace("*", "  *"),
        plain.replace("1, 0", "1, 0.D+00").replace("5, 5", "5.0d0, 5"),
    ):
        file.write_text(f"** comment\n{text}")
        deck, _, _ = imported(command, tmp_path, file)
        assert deck.nodes[3].tolist() == [1, 1, 0] and len(deck.nodes) == 8
        assert deck.groups["rim"] == ("FACES", [(1, 1)])
        assert deck.groups["one"] == ("NOEUDS", [(1,)])
    for kind, name in (("hexahedron", "SC8R"), ("wedge", "SC6RT")):
        points = meshes.points_of(kind)
        lines = ["*NODE", *(f"{i}, {x}, {y}, {z}" for i, (x, y, z) in enumerate(points, 1))]
        row = ", ".join(str(n) for n in (1, *range(1, len(points) + 1)))
        file.write_text("\n".join([*lines, f"*ELEMENT, TYPE={name}", row]))
        deck, _, err = imported(command, tmp_path, file)
        assert err == "" and len(deck.cells[1]) == len(points) + 1
        check_cell(deck, deck.cells[1])


# two squares of different materials, one behind the other: results have two nodes where they meet
SEAM = """.NOE
 1 0 0 0
 2 1 0 0
 3 2 0 0
 4 0 1 0
 5 1 -1.2345678901234567 0
 6 2 1 0
.MAI
 I 1 N 1 5 2 4
 I 2 N 5 3 6 2
.MAT
 I 1 YT 1000. NT 0.3
 I 2 YT 2000. NT 0.3
.HYP MEMB BIDIM
.SEL
 GROUP 1 NOM "a" MAILLES 1
 GROUP 2 NOM "b" MAILLES 2
 GROUP 3 NOM "middle" NOEUDS 2 5
.PHP GROUP "a" "b" THICK VAL 0.1
.AEL
 GROUP "a" MAT 1
 GROUP "b" MAT 2
.CLM
 FIX NOEUD 1 4 3 6 C 1 2
 NOEUD 2 5 CHA C 1 V 1.
.FIN 1
"""


@pytest.mark.parametrize("ending", ["vtu", "vtk", "med", "msh", "bdf", "inp"])
def test_parts_that_meet_stay_joined(ending: str, command, tmp_path: Path) -> None:
    (tmp_path / "seam.dat").write_text(SEAM, encoding="utf-8")
    subprocess.run(
        [program(), tmp_path / "seam.dat", "-o", tmp_path / "run"], check=True, capture_output=True
    )
    file = tmp_path / f"mesh.{ending}"
    status, _, err = command("export", tmp_path / "run.h5", "--mesh", file)
    assert status == 0, err
    deck, _, err = imported(command, tmp_path, file)
    assert len(deck.nodes) == 6
    first, second = (set(map(abs, deck.cells[cell])) for cell in sorted(deck.cells))
    shared = [tuple(np.round(deck.nodes[n], 9)) for n in first & second]
    assert sorted(shared) == [(1, -1.23456789, 0), (1, 0, 0)]
    if "middle" in deck.groups:
        assert sum(len(row) for row in deck.groups["middle"][1]) == 2
