# SPDX-License-Identifier: BSD-3-Clause
"""Solids against CalculiX on the same mesh, and against closed forms: a thick tube, the elastica."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from cell_problems import orders, solve
from solid_meshes import gravity_beam
from solid_problems import cantilever, rod_tip, tube_error

KINDS = {"C3D4": (4, False), "C3D10": (4, True), "C3D15": (6, True), "C3D20": (8, True)}
# written by tests/bench/calculix.py --write, CalculiX 2.20, which prints seven digits
REFERENCE = json.loads((Path(__file__).parent / "calculix.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("kind", KINDS)
def test_calculix(kind: str, tmp_path: Path) -> None:
    expected = np.array(REFERENCE[kind]["displacement"])
    _, deck, _ = gravity_beam(REFERENCE[kind]["boxes"], *KINDS[kind])
    for ranks in (1, 3) if kind == "C3D10" else (1,):
        found = solve(deck[:-1], tmp_path, ranks)
        assert np.abs(found - expected).max() < 5e-7 * np.abs(expected).max()


@pytest.mark.parametrize(
    ("corners", "second", "order"),
    [(4, False, 1.9), (4, True, 2.8), (6, False, 1.9), (6, True, 2.9), (8, False, 1.9), (8, True, 3.6)],
)
def test_tube_converges(corners: int, second: bool, order: float, tmp_path: Path) -> None:
    """Lamé, plane strain: radial displacement of all nodes, and its order as the mesh gets finer."""
    sizes = (2, 4) if second else (4, 8)
    errors = [tube_error(corners, second, boxes, tmp_path) for boxes in sizes]
    assert orders(errors)[0] > order, errors
    assert errors[1] < (3e-4 if second else 1e-2), errors


@pytest.mark.parametrize(
    ("corners", "second", "boxes", "order", "error"),
    [
        (4, True, 32, 3.7, 3.5e-4),
        (6, True, 32, 4.4, 9e-5),
        (8, False, 64, 3.0, 4e-5),
        (8, True, 32, 3.8, 5e-4),
    ],
)
def test_elastica(corners: int, second: bool, boxes: int, order: float, error: float, tmp_path: Path) -> None:
    """A cantilever bent far by a force at its end; docs/verification.md has the table. The rod tends to the
    elastica, which neither stretches nor shears, with the square of its height: Mattiasson (1981), Int. J.
    Numer. Methods Eng. 17."""
    tip = rod_tip()
    assert tip == pytest.approx([1 - 0.32894, 0.66996], abs=8e-5)
    errors = [np.hypot(*(cantilever(corners, second, n, tmp_path) - tip)) for n in (boxes // 2, boxes)]
    assert errors[1] < error
    assert orders(errors)[0] > order
