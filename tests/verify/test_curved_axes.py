# SPDX-License-Identifier: BSD-3-Clause
"""Axes of a material that follow a cylindrical or a spherical frame: errors of every kind of cell against
closed forms, and the orders in which they fall."""

from __future__ import annotations

from pathlib import Path

import pytest
from cell_problems import orders
from curved_axes import Ring, sphere

#: cells: boxes of the middle or finer mesh; greatest errors of displacements and stresses on the finest;
#: least orders
PLANE = {
    3: (8, 2.5e-4, 1.1e-2, 1.9, 1.45),
    6: (4, 4e-5, 4e-3, 3.0, 1.85),
    4: (8, 8e-4, 9e-3, 1.9, 1.5),
    8: (4, 2e-5, 5.5e-3, 3.6, 1.85),
}
SOLID = {
    (4, False): (8, 9e-4, 2.2e-2, 1.75, 1.45),
    (4, True): (4, 2.5e-4, 1.2e-2, 2.8, 1.7),
    (6, False): (8, 1.5e-3, 3.1e-2, 1.9, 1.5),
    (6, True): (4, 3.3e-4, 1.5e-2, 2.5, 1.7),
    (8, False): (8, 3e-3, 2e-2, 1.9, 1.6),
    (8, True): (4, 1.1e-4, 1.8e-2, 4.0, 1.7),
}
SPHERE = {3: (8, 1.1e-2, 1.9), 6: (4, 2.3e-3, 2.7), 4: (8, 5e-3, 1.95), 8: (4, 2.7e-4, 3.5)}


def expect(found: list[float], most: float, order: float) -> None:
    """Of the finest mesh, and from the one before to it."""
    assert found[-1] < most
    assert orders(found)[-1] > order


@pytest.mark.parametrize("hypothesis", ["stress", "strain"])
@pytest.mark.parametrize("nodes", PLANE)
def test_plane(nodes: int, hypothesis: str, tmp_path: Path) -> None:
    boxes, displacement, stress, *least = PLANE[nodes]
    found = [Ring(hypothesis).plane(nodes, n, tmp_path) for n in (boxes // 2, boxes, 2 * boxes)]
    expect([u for u, _ in found], displacement, least[0])
    expect([s for _, s in found], stress, least[1])


@pytest.mark.parametrize(("corners", "second"), SOLID)
def test_solid(corners: int, second: bool, tmp_path: Path) -> None:
    boxes, displacement, stress, *least = SOLID[corners, second]
    found = [Ring("strain").solid(corners, second, n, tmp_path) for n in (boxes // 2, boxes)]
    expect([u for u, _ in found], displacement, least[0])
    expect([s for _, s in found], stress, least[1])


@pytest.mark.parametrize("nodes", SPHERE)
def test_sphere(nodes: int, tmp_path: Path) -> None:
    boxes, displacement, least = SPHERE[nodes]
    expect([sphere(nodes, n, tmp_path) for n in (boxes // 2, boxes, 2 * boxes)], displacement, least)
