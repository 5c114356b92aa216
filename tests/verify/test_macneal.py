# SPDX-License-Identifier: BSD-3-Clause
"""The patch tests and beams of R. H. MacNeal and R. L. Harder (1985), A proposed standard set of problems to
test finite element accuracy, Finite Elements in Analysis and Design 1, 3-20. `macneal.py` has the beams."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from macneal import LOADS, SHAPES, SOLIDS, orders_of_changes, plane_beam, solid_beam
from plane_meshes import CUTS, KINDS, PlaneMesh
from runs import run
from solid_meshes import Mesh, SolidMesh

# Shares of theory, as docs/verification.md has them: rectangles, trapezia, parallelograms with their loads
STRAIGHT_PLANE = {
    3: [(0.9906, 0.0327), (0.9899, 0.0151), (0.9899, 0.0158)],
    6: [(0.9974, 0.9830), (0.9972, 0.9618), (0.9972, 0.9626)],
    4: [(0.9957, 0.9929), (1.0106, 0.0516), (1.0116, 0.6324)],
    8: [(0.9994, 0.9868), (1.0002, 0.9665), (0.9990, 0.9968)],
}
STRAIGHT_SOLID = {
    "T10": [
        (0.9929, 0.9601, 0.9588, 0.9104),
        (0.9921, 0.9393, 0.9413, 0.9101),
        (0.9921, 0.9399, 0.9350, 0.9101),
    ],
    "W6": [
        (0.9803, 0.0325, 0.0256, 0.0144),
        (0.9792, 0.0145, 0.0104, 0.0205),
        (0.9789, 0.0147, 0.0141, 0.0246),
    ],
    "W15": [
        (0.9954, 0.9736, 0.9655, 0.9731),
        (0.9950, 0.9512, 0.9551, 0.9703),
        (0.9950, 0.9520, 0.9553, 0.9693),
    ],
    "H8": [
        (0.9876, 0.9782, 0.9729, 0.8921),
        (1.0096, 0.0474, 0.0302, 0.5634),
        (1.0116, 0.6238, 0.5287, 0.8196),
    ],
    "H20": [
        (0.9942, 0.9702, 0.9607, 0.9045),
        (0.9937, 0.8856, 0.9195, 0.9044),
        (0.9935, 0.9670, 0.9412, 0.9043),
    ],
}
CURVED_PLANE = {3: 0.0259, 6: 0.9542, 4: 0.8875, 8: 1.0076}
# in plane and out of plane, curved and twisted
BENT_SOLID = {
    "T10": (0.8911, 0.8951, 0.9875, 0.9910),
    "W6": (0.0258, 0.0180, 0.2098, 0.2635),
    "W15": (0.9510, 0.9406, 0.9904, 0.9960),
    "H8": (0.8796, 0.8195, 0.9926, 0.9870),
    "H20": (0.8746, 0.9427, 0.9905, 0.9956),
}
# HEX8 of OptiStruct, three digits: Altair HyperWorks 2022 help, OS-V:0720 (straight) and OS-V:0710 (curved)
HEX8 = [(0.988, 0.978, 0.973, 0.892), (1.010, 0.047, 0.030, 0.563), (1.012, 0.624, 0.529, 0.820)]
HEX8_CURVED = (0.880, 0.820)


@pytest.mark.parametrize("nodes", KINDS)
def test_plane_beams(nodes: int, tmp_path: Path) -> None:
    for shape, row in zip(SHAPES, STRAIGHT_PLANE[nodes], strict=True):
        found = [plane_beam("straight", nodes, load, tmp_path, shape) for load in LOADS[:2]]
        assert found == pytest.approx(row, abs=6e-5)
    assert plane_beam("curved", nodes, "in plane", tmp_path) == pytest.approx(CURVED_PLANE[nodes], abs=6e-5)


@pytest.mark.parametrize("kind", SOLIDS)
def test_straight_beams(kind: str, tmp_path: Path) -> None:
    for shape, row, published in zip(SHAPES, STRAIGHT_SOLID[kind], HEX8, strict=True):
        found = [solid_beam("straight", kind, load, tmp_path, shape) for load in LOADS]
        assert found == pytest.approx(row, abs=6e-5)
        if kind == "H8":
            assert found == pytest.approx(published, abs=5e-4)


@pytest.mark.parametrize("kind", SOLIDS)
def test_curved_and_twisted_beams(kind: str, tmp_path: Path) -> None:
    found = [solid_beam(name, kind, load, tmp_path) for name in ("curved", "twisted") for load in LOADS[1:3]]
    assert found == pytest.approx(BENT_SOLID[kind], abs=6e-5)
    if kind == "H8":
        assert found[:2] == pytest.approx(HEX8_CURVED, abs=6e-4)


# shares with 1, 2 and 4 times as many boxes along each side, and the order of their changes
FINER_PLANE = {6: (1.01269, 3.36), 4: (1.01062, 3.43), 8: (1.01365, 2.96)}
FINER_SOLID = {"T10": (1.01063, 3.29), "W15": (1.01171, 3.00), "H8": (1.00807, 3.20), "H20": (1.01142, 3.48)}


@pytest.mark.parametrize("cell", [*FINER_PLANE, *FINER_SOLID])
def test_curved_beam_converges(cell: int | str, tmp_path: Path) -> None:
    if cell in FINER_PLANE:
        shares = [plane_beam("curved", cell, "in plane", tmp_path, finer=k) for k in (1, 2, 4)]
    else:
        shares = [solid_beam("curved", cell, "in plane", tmp_path, finer=k) for k in (1, 2, 4)]
    last, order = {**FINER_PLANE, **FINER_SOLID}[cell]
    assert shares[-1] == pytest.approx(last, abs=6e-6)
    assert orders_of_changes(shares)[0] == pytest.approx(order, abs=6e-3)


def test_twisted_beam_converges_to_theory(tmp_path: Path) -> None:
    for load, lack in (("in plane", 2.1e-3), ("out of plane", 1.1e-3)):
        assert 0 < 1 - solid_beam("twisted", "H20", load, tmp_path, finer=2) < lack


# Nodes and cells of the patches
PLANE_PATCH = [
    (0, 0),
    (0.24, 0),
    (0.24, 0.12),
    (0, 0.12),
    (0.04, 0.02),
    (0.18, 0.03),
    (0.16, 0.08),
    (0.08, 0.08),
]
PLANE_CELLS = [(4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
SOLID_PATCH = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))] + [
    (0.249, 0.342, 0.192),
    (0.826, 0.288, 0.288),
    (0.850, 0.649, 0.263),
    (0.273, 0.750, 0.230),
    (0.320, 0.186, 0.643),
    (0.677, 0.305, 0.683),
    (0.788, 0.693, 0.644),
    (0.165, 0.745, 0.702),
]
SOLID_CELLS = [
    (8, 9, 10, 11, 12, 13, 14, 15),
    (0, 1, 2, 3, 8, 9, 10, 11),
    (12, 13, 14, 15, 4, 5, 6, 7),
    *((i, j, 8 + j, 8 + i, i + 4, j + 4, 12 + j, 12 + i) for i, j in ((0, 1), (1, 2), (2, 3), (3, 0))),
]


def held(mesh: Mesh, gradient: np.ndarray, sizes: np.ndarray) -> list[str]:
    """Displacements of nodes on the outside."""
    outside = mesh.nodes(lambda x: any(x == 0) or any(x == sizes))
    return [
        f" NOEUD {node + 1} DEP C {c + 1} V {value:.16g}"
        for node in outside
        for c, value in enumerate(gradient @ mesh.points[node])
    ]


def check_patch(mesh: Mesh, deck: list[str], gradient: np.ndarray, stress: list[float], folder: Path) -> None:
    """Displacements of all nodes are linear, stresses at all points the same."""
    result = run("\n".join([*deck, ".FIN 1\n"]), folder)
    with h5py.File(result.file) as file:
        frame = sorted(file["fields/displacement"])[-1]
        found = file[f"fields/displacement/{frame}"][:, : len(gradient)]
        where = "points" if f"points/STRESS/{frame}" in file else "fields"
        stresses = file[f"{where}/STRESS/{frame}"][:]
    expected = mesh.points @ gradient.T
    assert np.abs(found - expected).max() < 1e-12 * np.abs(expected).max()
    # strains of 1e-3 are differences of positions, which have 16 digits
    assert np.abs(stresses - stress).max() < 3e-12 * max(stress)


@pytest.mark.parametrize("nodes", KINDS)
def test_plane_patch(nodes: int, tmp_path: Path) -> None:
    """u = 1e-3 (x + y/2), v = 1e-3 (y + x/2): stresses of 1333, 1333 and 400. Five quadrilaterals, or
    triangles that halve them."""
    corners, second = KINDS[nodes]
    cells = [[PLANE_PATCH[cell[q]] for q in cut] for cell in PLANE_CELLS for cut in CUTS[corners]]
    mesh, gradient = PlaneMesh(cells, second, np.array), 1e-3 * np.array([[1, 0.5], [0.5, 1]])
    deck = [
        *mesh.model("stress", 1e6, 0.25, 0.001),
        ".CLM",
        *held(mesh, gradient, np.array([0.24, 0.12])),
    ]
    check_patch(mesh, deck, gradient, [4000 / 3, 4000 / 3, 0, 400], tmp_path)


@pytest.mark.parametrize("second", [False, True])
def test_solid_patch(second: bool, tmp_path: Path) -> None:
    """u = 1e-3 (2 x + y + z)/2 and so on: stresses of 2000 and 400."""
    mesh = SolidMesh([[SOLID_PATCH[i] for i in cell] for cell in SOLID_CELLS], second, np.array)
    gradient = 5e-4 * (np.ones((3, 3)) + np.eye(3))
    deck = [
        '.MAT\n I 1 BEHA "ELASTIC" YT 1E6 NT 0.25',
        *mesh.deck(),
        f".AEL\n I 1 J {len(mesh.cells)} K 1 MAT 1",
        ".CLM",
        *held(mesh, gradient, np.ones(3)),
    ]
    check_patch(mesh, deck, gradient, [2000] * 3 + [400] * 3, tmp_path)
