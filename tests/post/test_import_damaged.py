# SPDX-License-Identifier: BSD-3-Clause
"""`engrane import` of files that are cut short, and of surfaces in space."""

from __future__ import annotations

from pathlib import Path

import meshes
import meshio
import numpy as np
import pytest
from test_import import imported

UNV = """    -1
  2411
         1         1         1        11
   0.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00
         2         1         1        11
   1.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00
         3         1         1        11
   0.0000000000000000D+00   1.0000000000000000D+00   0.0000000000000000D+00
    -1
    -1
  2412
         1        91         1         1         7         3
         1         2         3
    -1
    -1
  2467
         1         0         0         0         0         0         0         2
wall
         7         1         0         0         7         3         0         0
    -1
"""


def test_vtk_cut_anywhere_is_the_mesh_or_an_error(command, tmp_path: Path) -> None:
    """VTK crashed where the cells of a binary file were cut, and took others for whole."""
    points, cells, _ = meshes.brick(2, 2, 2)
    whole, cut = tmp_path / "whole.vtk", tmp_path / "cut.vtk"
    mesh = meshio.Mesh(points, [("hexahedron", cells)], cell_data={"group": [np.arange(len(cells)) + 1]})
    mesh.write(whole, binary=True)
    data = whole.read_bytes()
    types = data.index(b"CELL_TYPES")
    for size in (data.index(b"double") + 100, types - 200, types - 8, types + 16, len(data) - 40):
        cut.write_bytes(data[:size])
        status, _, err = command("import", cut, "-o", tmp_path / "cut.dat", "--force")
        assert status == 1 and f"{cut} is no mesh that can be read" in err, size
    assert command("import", whole, "-o", tmp_path / "whole.dat")[0] == 0


def test_a_universal_file_cut_anywhere_is_an_error(command, tmp_path: Path) -> None:
    """A dataset without its last -1 was left out: the file had no groups."""
    file = tmp_path / "mesh.unv"
    deck, _, _ = imported(command, tmp_path, _written(file, UNV))
    assert deck.groups["wall"] == ("NOEUDS", [(1,), (3,)])
    for gone in (6, 25, 90, 200):
        _written(file, UNV[:-gone])
        status, _, err = command("import", file, "-o", tmp_path / "d.dat", "--force")
        assert status == 1 and "does not end with -1: the file is cut short" in err, gone
    _written(file, UNV.replace("         0         2\nwall", "         0         3\nwall"))
    status, _, err = command("import", file, "-o", tmp_path / "d.dat", "--force")
    assert status == 1 and 'group "wall" has 2 members instead of 3' in err


def _written(file: Path, text: str) -> Path:
    file.write_text(text)
    return file


@pytest.mark.parametrize("kind", ["triangle", "quad"])
def test_surfaces_in_space_as_membranes(kind: str, command, tmp_path: Path) -> None:
    """Two cells that stand upright on each other, one either way round: both stay as they are, and a cell on
    a line is left out."""
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1], [0, 1, 0], [1, 1, 0], [2, 0, 0]], float)
    size = 3 if kind == "triangle" else 4
    cells = np.array([[0, 1, 2, 3][:size], [0, 4, 5, 1][:size], [0, 1, 6, 1][:size]])
    mesh = meshio.Mesh(points, [(kind, cells)], cell_data={"group": [np.array([1, 2, 2])]})
    deck, _, err = imported(command, tmp_path, mesh, "--as", "membranes")
    for number, cell in enumerate(cells[:2], 1):
        assert np.array_equal([deck.nodes[n] for n in deck.cells[number]], points[cell])
    assert "1 cell left out: without content" in err and "inside out" not in err
    assert ".HYP MEMBRANE" in (tmp_path / "deck.dat").read_text()
    solid = meshio.Mesh(*(lambda p, c: (p, [("hexahedron", c)]))(*meshes.brick(1, 1, 1)[:2]))
    solid.write(tmp_path / "solid.vtu")
    status, _, err = command("import", tmp_path / "solid.vtu", "--as", "membranes", "-o", tmp_path / "s.dat")
    assert status == 1 and "has solids: --as membranes is for a surface without solids" in err
