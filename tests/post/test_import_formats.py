# SPDX-License-Identifier: BSD-3-Clause
"""`engrane import`: what mesh files of other programs say of places, and how VTK writes them."""

from __future__ import annotations

from pathlib import Path

import meshes
import numpy as np
from test_import import imported


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
