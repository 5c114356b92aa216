# SPDX-License-Identifier: BSD-3-Clause
"""Cook's membrane, a plate with a hole and a thick tube: errors of plane and axisymmetric cells and the
orders in which they fall; a strip and a ring by CalculiX. docs/verification.md has the tables; bounds are
what was measured, rounded."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from cell_problems import COOK, Hole, cook, even_tube, orders, solve, stiff_tube
from plane_meshes import gravity_strip, ring_means


@pytest.mark.parametrize(
    ("nodes", "order", "error"), [(3, 1.87, 9.7e-3), (6, 1.40, 3e-4), (4, 1.59, 1.2e-3), (8, 1.37, 4.8e-4)]
)
def test_cook(nodes: int, order: float, error: float, tmp_path: Path) -> None:
    """The corners of the wall, where stresses have no bound, hold the order of quadratic cells below 1.5."""
    errors = [1 - cook(nodes, boxes, tmp_path) / COOK for boxes in (16, 32)]
    assert 0 < errors[1] < error
    assert orders(errors)[0] == pytest.approx(order, abs=0.01)


def test_cook_converges_to_the_reference(tmp_path: Path) -> None:
    found = cook(8, 32, tmp_path, graded=True)
    assert found == pytest.approx(COOK, rel=7e-6)
    assert found == pytest.approx(23.96, rel=4e-4)  # the value in the literature
    for ranks in (2, 3):
        assert cook(8, 8, tmp_path, ranks=ranks) == pytest.approx(cook(8, 8, tmp_path), rel=1e-12)


@pytest.mark.parametrize("hypothesis", ["stress", "strain"])
@pytest.mark.parametrize(
    ("nodes", "order", "error", "stress_order", "stress_error"),
    [
        (3, 1.92, 3.4e-3, 1.85, 0.063),
        (6, 3.20, 1.1e-5, 2.56, 2.1e-3),
        (4, 1.99, 1.2e-3, 1.97, 0.027),
        (8, 4.00, 1.6e-6, 3.91, 2.1e-4),
    ],
)
def test_hole(
    nodes: int,
    order: float,
    error: float,
    stress_order: float,
    stress_error: float,
    hypothesis: str,
    tmp_path: Path,
) -> None:
    """Displacements of all nodes against Kirsch, and the stress concentration of 3."""
    errors, stresses = zip(
        *(Hole(hypothesis).solve(nodes, boxes, tmp_path) for boxes in (8, 16)), strict=True
    )
    assert errors[1] < error
    assert orders(errors)[0] > order
    lacking = [Hole.exact - stress for stress in stresses]
    assert 0 < lacking[1] < stress_error
    assert orders(lacking)[0] > stress_order


@pytest.mark.parametrize(
    ("hypothesis", "nodes", "order", "error"),
    [
        ("axis", 3, 2.00, 4.0e-4),
        ("axis", 6, 3.05, 1.8e-6),
        ("axis", 4, 2.00, 3.7e-4),
        ("strain", 3, 2.00, 2.4e-3),
        ("strain", 6, 3.01, 4.2e-6),
        ("strain", 4, 2.00, 3.7e-4),
        ("strain", 8, 4.06, 2.9e-7),
    ],
)
def test_tube(hypothesis: str, nodes: int, order: float, error: float, tmp_path: Path) -> None:
    """Lamé: radial displacements of all nodes."""
    errors = [
        even_tube(hypothesis, boxes).solve(nodes, boxes if hypothesis == "strain" else 1, tmp_path)[0]
        for boxes in (8, 16)
    ]
    assert errors[1] < error
    assert orders(errors)[0] > order


def test_tube_of_8_nodes_round_the_axis_is_exact_at_nodes(tmp_path: Path) -> None:
    assert even_tube("axis", 4).solve(8, 1, tmp_path)[0] < 1e-13
    assert stiff_tube("axis", 0.4999).solve(8, 1, tmp_path)[0] < 1e-12


# Displacement of the bore over Lamé's for nu = 0.3, 0.49, 0.499, 0.4999; diagonals of triangles alternating
STIFF = {
    ("axis", 3, True): (0.9890, 0.8774, 0.4492, 0.0773),
    ("axis", 6, True): (1.0000, 0.9998, 0.9997, 0.9997),
    ("axis", 4, True): (0.9904, 0.9863, 0.9861, 0.9861),
    ("axis", 8, True): (1.0000, 1.0000, 1.0000, 1.0000),
    ("strain", 3, True): (0.9701, 0.9560, 0.9545, 0.9544),
    ("strain", 3, False): (0.9597, 0.7753, 0.6420, 0.6176),
    ("strain", 6, True): (0.9999, 0.9999, 0.9999, 0.9999),
    ("strain", 6, False): (0.9999, 0.9990, 0.9976, 0.9971),
    ("strain", 4, True): (0.9903, 0.9862, 0.9860, 0.9859),
    ("strain", 8, True): (1.0000, 1.0000, 1.0000, 1.0000),
}


@pytest.mark.parametrize(("hypothesis", "nodes", "alternating"), STIFF)
def test_nearly_incompressible_tube(hypothesis: str, nodes: int, alternating: bool, tmp_path: Path) -> None:
    """Triangles of 3 nodes lock, and it shows: round the axis, and in the plane with diagonals one way."""
    for poisson, expected in zip(
        (0.3, 0.49, 0.499, 0.4999), STIFF[hypothesis, nodes, alternating], strict=True
    ):
        rows = 9 if hypothesis == "strain" else 1
        share = stiff_tube(hypothesis, poisson, alternating).solve(nodes, rows, tmp_path)[1]
        assert share == pytest.approx(expected, abs=6e-5)


# written by tests/bench/calculix.py --write, CalculiX 2.20, which prints seven digits
REFERENCE = json.loads((Path(__file__).parent / "calculix.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    ("kind", "nodes", "hypothesis", "difference"),
    [
        ("CPE3", 3, "strain", 2.5e-7),
        ("CPE6", 6, "strain", 1.5e-7),
        ("CPE8R", 8, "strain", 1.5e-7),
        # wedges of 2 degrees, not rings
        ("CAX6", 6, "axis", 2.1e-6),
        ("CAX8R", 8, "axis", 1.0e-6),
        # solids whose strain across has no jumps
        ("CPS6", 6, "stress", 2.4e-4),
        ("CPS8R", 8, "stress", 9.5e-5),
    ],
)
def test_calculix(kind: str, nodes: int, hypothesis: str, difference: float, tmp_path: Path) -> None:
    """A bent strip or ring under weight and forces, all displacements."""
    mesh, deck, _, _ = gravity_strip(REFERENCE[kind]["boxes"][:2], nodes, hypothesis)
    expected = np.array(REFERENCE[kind]["displacement"])
    found = solve(deck[:-1], tmp_path) * ring_means(mesh, hypothesis == "axis")
    assert np.abs(found - expected).max() < difference * np.abs(expected).max()
