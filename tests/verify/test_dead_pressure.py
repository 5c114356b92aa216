# SPDX-License-Identifier: BSD-3-Clause
"""A slender cantilever of plane cells under a dead pressure along its side, which bends it until it nearly
stands along the load, against the elastica."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cell_problems import solve
from plane_meshes import Sheet
from scipy.integrate import solve_bvp

LENGTH, HEIGHT, YOUNG = 100.0, 1.0, 1200.0
LOAD = 20.0  # q L**3/(E I)
PRESSURE = LOAD * YOUNG * HEIGHT**3 / 12 / LENGTH**3  # the thickness is 1


def end_of_elastica() -> np.ndarray:
    """Place of the end over the length, of a rod that does not stretch, under the load q per length along y
    (Love 1927, A Treatise on the Mathematical Theory of Elasticity, art. 262). The section at s carries what
    acts beyond it: theta'' = -q (1 - s) cos(theta) - m, with the moment m = q h/2 sin(theta) of a load that
    acts half a height below the axis."""

    def rates(s, y):
        theta, bend = y[:2]
        moment = LOAD * HEIGHT / LENGTH / 2 * np.sin(theta)
        return np.array([bend, -LOAD * (1 - s) * np.cos(theta) - moment, np.cos(theta), np.sin(theta)])

    def ends(a, b):
        return np.array([a[0], b[1], a[2], a[3]])

    s = np.linspace(0, 1, 41)
    found = solve_bvp(rates, ends, s, np.array([s, 1 - s, s, 0 * s]), tol=1e-7, max_nodes=10**5)
    assert found.success
    return found.y[2:, -1]


def end_of_cantilever(dead: bool, folder: Path) -> np.ndarray:
    mesh = Sheet((32, 1), 8, lambda u: np.array([LENGTH * u[0], HEIGHT * (u[1] - 0.5)]))
    deck = [
        *mesh.model("stress", YOUNG, 0.0),
        mesh.group(2, "wall", mesh.nodes(lambda u: u[0] == 0)),
        *mesh.group_of_faces(3, "side", lambda u: u[1] == 0),
        ".FCT\n I 1 RAMP 0 0 1 1",
        '.CLM\n GROUP "wall" FIX C 1 2',
        f' GROUP "side" PRE V {PRESSURE!r} {"DEAD" if dead else ""} NF 1',
        ".SAM TYPE STATIC\n.SUB TF 1. H 0.1",
    ]
    (end,) = mesh.nodes(lambda u: u[0] == 1 and u[1] == 0.5)
    return (mesh.points[end] + solve(deck, folder)[end, :2]) / LENGTH


def test_cantilever(tmp_path: Path) -> None:
    """A pressure that follows the side curls it up instead."""
    assert end_of_cantilever(True, tmp_path) == pytest.approx(end_of_elastica(), abs=3e-4)
    assert end_of_cantilever(False, tmp_path)[0] < -0.2
