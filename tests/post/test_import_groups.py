# SPDX-License-Identifier: BSD-3-Clause
"""`engrane import`: groups that other programs give in ways of their own: names of an assembly and of its
part, nodes of a set of elements, free surfaces, scalars of VTK, physical names of Gmsh."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from engrane_post.errors import UserError
from engrane_post.mesh_files import read
from test_import import imported

CUBE = """*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
"""
BRICK = "*ELEMENT, TYPE=C3D8R\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
SETS = "*NSET, NSET=Set-1\n1, 2\n*ELSET, ELSET=Set-1\n1\n*ELSET, ELSET=all\n1\n"


def nodes_of(deck, name: str) -> set[int]:
    return {n for (n,) in deck.groups[name][1]}


def test_numbers_and_names_of_an_assembly(command, tmp_path: Path) -> None:
    """As Abaqus/CAE writes them: a reference point is numbered from 1 again, and so is its mass."""
    file = tmp_path / "mesh.inp"
    file.write_text(
        f"*HEADING\n*PART, NAME=P\n{CUBE}{BRICK}{SETS}*END PART\n*ASSEMBLY, NAME=A\n"
        "*INSTANCE, NAME=P-1, PART=P\n*END INSTANCE\n*NODE\n1, -9., -9., -9.\n*NSET, NSET=RP\n1,\n"
        "*NSET, NSET=Set-1, INSTANCE=P-1\n5, 6, 7, 8\n"
        "*NSET, NSET=more\nP-1.Set-1, P-1.3\n*NSET, NSET=row, INSTANCE=P-1, GENERATE\n1, 7, 2\n"
        "*ELSET, ELSET=_Top_S2, INTERNAL, INSTANCE=P-1\n1,\n*SURFACE, NAME=Top\n_Top_S2, S2\n"
        "*ELEMENT, TYPE=MASS, ELSET=m\n1, 1\n*END ASSEMBLY\n"
    )
    deck, _, err = imported(command, tmp_path, file)
    assert [deck.nodes[1].tolist(), len(deck.nodes)] == [[0, 0, 0], 8]
    assert '"RP"' in err and '"m"' in err and "kind MASS" in err
    assert nodes_of(deck, "Set-1") == {5, 6, 7, 8}
    assert nodes_of(deck, "P-1.Set-1 nodes") == {1, 2} and deck.groups["P-1.Set-1"] == ("MAILLES", [(1,)])
    assert deck.groups["all"] == ("MAILLES", [(1,)])
    assert nodes_of(deck, "more") == {1, 2, 3} and nodes_of(deck, "row") == {1, 3, 5, 7}
    assert deck.groups["Top"][0] == "FACES" and nodes_of(deck, "Top nodes") == {5, 6, 7, 8}


def test_nodes_of_elements_and_free_surfaces(command, tmp_path: Path) -> None:
    file = tmp_path / "mesh.inp"
    other = "9, 2., 0., 0.\n10, 2., 1., 0.\n11, 2., 0., 1.\n12, 2., 1., 1.\n"
    file.write_text(
        f"{CUBE}{other}*ELEMENT, TYPE=C3D8, ELSET=A\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
        "*ELEMENT, TYPE=C3D8, ELSET=B\n2, 2, 9, 10, 3, 6, 11, 12, 7\n*NSET, NSET=x, ELSET=B\n"
        "*SURFACE, NAME=free\nA,\n*SURFACE, NAME=both, COMBINE=UNION\nfree\n"
    )
    deck, _, err = imported(command, tmp_path, file)
    assert nodes_of(deck, "x") == {2, 9, 10, 3, 6, 11, 12, 7}
    faces = deck.groups["free"][1]
    assert len(faces) == 5 and {cell for cell, _ in faces} == {1}
    assert "*SURFACE both combines others" in err


def test_numbers_of_abaqus_given_twice(command, tmp_path: Path) -> None:
    file = tmp_path / "mesh.inp"
    file.write_text(f"{CUBE}{BRICK}*NODE\n7, 1., 1., 2.\n1, 0., 0., 0.\n")
    deck, _, err = imported(command, tmp_path, file)
    assert deck.nodes[7].tolist() == [1, 1, 2]
    assert "node 7 is given at two places" in err
    file.write_text(f"{CUBE}{BRICK}{BRICK}")
    status, _, err = command("import", file, "-o", tmp_path / "twice.dat")
    assert status == 1 and "element 1 is given twice" in err


def test_numbers_of_regions(command, tmp_path: Path) -> None:
    """SCALARS of VTK come as a table of one column; region 0 is one of several."""
    file = tmp_path / "mesh.vtk"
    file.write_text(
        "# vtk DataFile Version 2.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 0\nCELLS 2 10\n4 0 1 2 3\n4 1 4 5 2\nCELL_TYPES 2\n9\n9\n"
        "CELL_DATA 2\nSCALARS region int 1\nLOOKUP_TABLE default\n0\n1\n"
    )
    deck, _, _ = imported(command, tmp_path, file)
    assert deck.groups["region 0"] == ("MAILLES", [(1,)])
    assert deck.groups["region 1"] == ("MAILLES", [(2,)])


def test_names_of_gmsh(command, tmp_path: Path) -> None:
    """One name in two dimensions; a negative number reverses the orientation of a line."""
    file = tmp_path / "mesh.msh"
    file.write_text(
        '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 "wall"\n2 2 "wall"\n$EndPhysicalNames\n'
        "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
        "$Elements\n2\n1 1 2 -1 1 1 4\n2 3 2 2 1 1 2 3 4\n$EndElements\n"
    )
    deck, _, _ = imported(command, tmp_path, file)
    assert deck.groups["wall"] == ("MAILLES", [(1,)])
    assert deck.groups["wall faces"][0] == "FACES"
    assert nodes_of(deck, "wall nodes") == {1, 4}


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("1.0", ".5-", "GRID 2 has `.5-` where a number stands"),
        (
            "CTETRA,7,1,1,2,3,4",
            "CTETRA,7,1,1,2,3,x",
            "cell 7 (CTETRA) has `x` where the label of a node stands",
        ),
    ],
)
def test_a_damaged_field_of_a_bulk_data_file_is_named(old: str, new: str, told: str, tmp_path: Path) -> None:
    """`.5-` is left of .5-3 in a field cut short; the file was said to be damaged or of another kind."""
    path = tmp_path / "a.bdf"
    text = "BEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.0,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"
    path.write_text((text + "CTETRA,7,1,1,2,3,4\nENDDATA\n").replace(old, new, 1), encoding="utf-8")
    with pytest.raises(UserError, match=re.escape(told)):
        read(path)
