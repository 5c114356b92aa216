# SPDX-License-Identifier: BSD-3-Clause
"""Meshes on several processes: numbered at random, the elements must still be parted along few nodes, and the
results be those of one process."""

from __future__ import annotations

import re

import h5py
import numpy as np
import pytest
from plane_meshes import Sheet
from runs import run
from solid_meshes import Block


def shuffled(mesh):
    """The same mesh with nodes and cells numbered at random."""
    random = np.random.default_rng(1)
    number = random.permutation(len(mesh.points))  # new number of each node
    order = np.argsort(number)
    mesh.points, mesh.unit = mesh.points[order], mesh.unit[order]
    mesh.cells = [[int(number[v]) for v in mesh.cells[c]] for c in random.permutation(len(mesh.cells))]
    return mesh


def sheet() -> tuple[list[str], int]:
    mesh = shuffled(Sheet((40, 20), 8, lambda u: np.array([4 * u[0], 1.5 * u[1] + 0.2 * u[0] ** 2])))
    deck = [
        *mesh.model("strain", 1000.0, 0.3, 1.0, 1.0),
        mesh.group(2, "wall", mesh.nodes(lambda u: u[0] == 0)),
        '.CLM\n GROUP "wall" FIX C 1 2\n STRU ACC VAL 0. -1. 0.',
    ]
    return deck, 20  # boxes along the shortest cut


def block() -> tuple[list[str], int]:
    mesh = shuffled(Block((16, 6, 5), 8, True, lambda u: np.array([3 * u[0], u[1], u[2]])))
    deck = [
        *mesh.deck(),
        ".SEL",
        mesh.group(1, "wall", mesh.nodes(lambda u: u[0] == 0)),
        '.MAT\n I 1 BEHA "ELASTIC" YT 1000. NT 0.3 M 1.',
        f".AEL\n I 1 J {len(mesh.cells)} K 1 MAT 1",
        '.CLM\n GROUP "wall" FIX C 1 2 3\n STRU ACC VAL 0. 0. -1.',
    ]
    return deck, 30


@pytest.mark.parametrize("mesh", [sheet, block])
def test_meshes_numbered_at_random(tmp_path, mesh):
    deck, cut = mesh()
    text = "\n".join([*deck, ".FIN 1\n"])
    first: dict[str, np.ndarray] = {}
    for ranks in (1, 2, 3):
        file = run(text, tmp_path, ranks=ranks).file
        with h5py.File(file) as h:
            found = {name: h[f"fields/{name}/000000"][:] for name in ("displacement", "STRESS", "ERROR")}
        first = first or found
        for name, values in found.items():
            rows = ~np.isnan(values)
            assert np.array_equal(rows, ~np.isnan(first[name]))
            size = np.max(np.abs(first[name][rows]))
            assert size > 0
            assert np.max(np.abs(values[rows] - first[name][rows])) <= 1e-10 * size, (name, ranks)
        if ranks == 1:
            continue
        listing = file.with_suffix(".lst").read_text()
        shares = re.search(r"elements of a process +(\d+)(?: to (\d+))?", listing)
        least, most = int(shares[1]), int(shares[2] or shares[1])
        assert most <= 1.2 * least
        # cells on one side of each cut, and no more than those on both; at random nearly all would be
        assert int(re.search(r"evaluated by several +(\d+)", listing)[1]) <= 2 * (ranks - 1) * cut
