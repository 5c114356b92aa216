# SPDX-License-Identifier: BSD-3-Clause
"""Linear statics of cells depends neither on where the mesh stands nor on how small its loads are: strains
come from displacements with what rounding leaves of them, the side of an edge from differences of places."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from plane_meshes import Sheet
from runs import run
from solid_meshes import Block


def solved(deck: list[str], folder: Path) -> list[np.ndarray]:
    """Displacements and stresses at the nodes, and the force on the wall."""
    result = run("\n".join([*deck, ".FIN 1\n"]), folder)
    with h5py.File(result.file) as file:
        found = [file[f"{name}/000000"][:] for name in ("fields/displacement", "nodes/STRESS")]
    return [*found, np.array([result[f"run/GROUND_FORCE_{axis}"][-1] for axis in "XYZ"])]


def sheet(nodes: int, away: float, load: float) -> list[str]:
    """A plate, clamped on the left, pulled by a pressure on the right and bent by its weight. All places are
    multiples of 1/16, so that they are not rounded far from the origin."""
    mesh = Sheet((6, 4), nodes, lambda u: np.array([1.5 * u[0] + away, u[1] - away]))
    return [
        *mesh.model("strain", 2.1e5, 0.3, 1.0, 1e-3),
        mesh.group(2, "wall", mesh.nodes(lambda u: u[0] == 0)),
        ' GROUP 3 NOM "end" FACES',
        *(f"  I {cell} {side}" for cell, side in mesh.faces(lambda u: u[0] == 1)),
        f'.CLM\n GROUP "wall" FIX C 1 2\n PRE GROUP "end" V {-2 * load!r}\n STRU ACC VAL 0 {-1e3 * load!r} 0',
    ]


def block(corners: int, second: bool, away: float, load: float) -> list[str]:
    """A block, clamped on the left, under its weight and a pressure on the right."""
    mesh = Block((4, 2, 2), corners, second, lambda u: np.array([u[0] + away, u[1] / 2, u[2] / 2 - away]))
    return [
        *mesh.deck(),
        '.SEL\n GROUP 1 NOM "all" MAILLES TOUT',
        mesh.group(2, "wall", mesh.nodes(lambda u: u[0] == 0)),
        ' GROUP 3 NOM "end" FACES',
        *(f"  I {cell} {side}" for cell, side in mesh.faces(lambda u: u[0] == 1)),
        '.MAT\n I 1 YT 2.1E5 NT 0.3 M 1E-3\n.AEL\n GROUP "all" MAT 1',
        '.CLM\n GROUP "wall" FIX C 1 2 3',
        f' PRE GROUP "end" V {-2 * load!r}\n STRU ACC VAL 0 0 {-1e3 * load!r}',
    ]


def agrees_everywhere(deck, folder: Path) -> None:
    here = solved(deck(0, 1), folder)
    for away, load in ((2**17, 1), (2**24, 1), (0, 1e-9), (2**24, 1e-9)):
        for found, expected in zip(solved(deck(away, load), folder), here, strict=True):
            assert np.abs(found / load - expected).max() < 3e-7 * np.abs(expected).max()


@pytest.mark.parametrize("nodes", [3, 6, 4, 8])
def test_sheets(nodes: int, tmp_path: Path) -> None:
    agrees_everywhere(lambda away, load: sheet(nodes, away, load), tmp_path)


@pytest.mark.parametrize(("corners", "second"), [(4, False), (4, True), (6, True), (8, False), (8, True)])
def test_blocks(corners: int, second: bool, tmp_path: Path) -> None:
    agrees_everywhere(lambda away, load: block(corners, second, away, load), tmp_path)
