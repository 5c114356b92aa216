# SPDX-License-Identifier: BSD-3-Clause
"""Stresses at nodes of a thick tube by averages, as the program has them, and by superconvergent patch
recovery (Zienkiewicz and Zhu 1992): what the estimate of the error would be over the true error, and the
largest error at a node over the pressure. docs/decisions/0034-averages-not-patches.md has the table.

    ENGRANE=$PWD/build/bin/engrane PYTHONPATH=post:tests:tests/verify build/venv/bin/python \\
        tests/bench/patch_recovery.py
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
from plane_meshes import SIDES, Sheet
from test_cells import Shape
from test_nodal_averages import (
    POINTS,
    PRESSURE,
    energy_of_difference,
    energy_of_lame,
    lame,
    solved,
    true_error,
    tube,
)


def monomials(place: np.ndarray, second: bool) -> np.ndarray:
    """Of degree 1 or 2, at places, one a row."""
    x, y = place.T
    return np.stack([np.ones_like(x), x, y, *([x * x, x * y, y * y] if second else [])], axis=1)


def patches(mesh: Sheet, kind: int, stress: np.ndarray, averages: np.ndarray) -> np.ndarray:
    """Stresses at nodes: each corner inside has a polynomial of the degree of the displacements, by least
    squares through the points of the cells round it. Corners without (of the boundary), and mid-side nodes,
    have the mean of what those near to them give, and the averages where there are none."""
    shape, second, corners = Shape(kind), kind in (6, 8), mesh.corners
    places = np.array([[shape.value(*p) @ mesh.points[cell] for p in POINTS[kind]] for cell in mesh.cells])
    round_ = [[] for _ in mesh.points]
    for e, cell in enumerate(mesh.cells):
        for node in cell[:corners]:
            round_[node].append(e)
    found = {}
    for node, cells in enumerate(round_):
        if len(cells) < (4 if corners == 4 else 6):
            continue
        arms = places[cells].reshape(-1, 2) - mesh.points[node]
        size = np.abs(arms).max()
        table = monomials(arms / size, second)
        found[node] = size, np.linalg.lstsq(table, stress[cells].reshape(len(table), -1), rcond=None)[0]

    def value(patch: int, node: int) -> np.ndarray:
        size, factors = found[patch]
        return (monomials((mesh.points[node] - mesh.points[patch])[None] / size, second) @ factors)[0]

    given: dict[int, list[np.ndarray]] = {}
    for cell in mesh.cells:
        near = [c for c in cell[:corners] if c in found]
        for node in cell[:corners]:
            given.setdefault(node, []).extend(value(c, node) for c in ([node] if node in found else near))
        for node, ends in zip(cell[corners:], SIDES[corners], strict=False):
            sides = [cell[i] for i in ends if cell[i] in found]
            given.setdefault(node, []).extend(value(c, node) for c in sides or near)
    return np.array([np.mean(given[i] or [averages[i]], axis=0) for i in range(len(mesh.points))])


def main() -> None:
    print("nodes, cells along the radius, true error; averages, then patches: estimate over truth, worst")
    for kind in (4, 8, 6):
        for boxes in (4, 8, 16, 32):
            with tempfile.TemporaryDirectory() as name:
                print(f"{kind} {boxes:2}", row(kind, boxes, Path(name)), flush=True)


def row(kind: int, boxes: int, folder: Path) -> str:
    mesh, deck = tube(boxes, kind)
    _, results = solved("MODE LECT 4096\n" + deck, folder)
    with results:
        truth = true_error(mesh, kind, results)
        at_points = results.dataset("points/STRESS/000000")[:, [0, 1, 3]].reshape(len(mesh.cells), -1, 3)
        averages = results.dataset("nodes/STRESS/000000")[:, [0, 1, 3]]
        text = f"{np.sqrt(truth / energy_of_lame()):.1e}"
        for nodal in (averages, patches(mesh, kind, at_points, averages)):
            found = energy_of_difference(mesh, kind, results, lambda shape, cell, at=nodal: shape @ at[cell])
            text += f"  {np.sqrt(found / truth):.2f} {np.abs(nodal - lame(mesh.points)).max() / PRESSURE:.4f}"
    return text


if __name__ == "__main__":
    main()
