# SPDX-License-Identifier: BSD-3-Clause
"""Centrifugal loads: a disc with a hole, of plane cells and of solids, and a rod that stretches far."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from cell_problems import Disc, orders
from plane_meshes import Sheet
from runs import run
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from solid_meshes import Block

YOUNG, DENSITY = 1000.0, 2.0


def last_displacement(file: Path) -> np.ndarray:
    with h5py.File(file) as results:
        frames = results["fields/displacement"]
        return frames[sorted(frames)[-1]][:]


@pytest.mark.parametrize(
    ("hypothesis", "nodes", "order", "most"),
    [
        ("stress", 3, 1.99, 3.3e-3),
        ("stress", 6, 3.02, 2.8e-6),
        ("stress", 4, 1.99, 1.6e-3),
        ("stress", 8, 4.02, 2.0e-7),
        ("strain", 3, 1.99, 3.4e-3),
        ("strain", 6, 3.01, 3.2e-6),
        ("strain", 4, 1.99, 1.6e-3),
        ("strain", 8, 4.02, 2.1e-7),
        ("axis", 3, 2.01, 2.0e-4),
        ("axis", 6, 2.99, 2.4e-6),
        ("axis", 4, 2.00, 1.4e-4),
        ("axis", 8, 4.01, 1.6e-8),
    ],
)
def test_disc_with_a_hole(hypothesis: str, nodes: int, order: float, most: float, tmp_path: Path) -> None:
    """All nodes, and the order as the mesh gets finer; docs/verification.md has the table."""
    errors = [Disc(hypothesis).solve(nodes, boxes, tmp_path) for boxes in (8, 16)]
    assert errors[1] < most
    assert orders(errors)[0] > order


@pytest.mark.parametrize(
    ("corners", "second", "most"), [(4, True, 5e-5), (6, True, 7e-5), (8, False, 1.3e-2), (8, True, 4e-5)]
)
def test_thin_disc_of_solids(corners: int, second: bool, most: float, tmp_path: Path) -> None:
    """A quarter of a thin disc, free on one side: plane stress but for its thinness, on three ranks too. The
    axis goes through a point away from the origin."""
    disc = Disc(young=YOUNG, density=DENSITY)
    shift, thin = np.array([3.0, -2.0, 1.0]), 0.02

    def place(u):
        x, y = disc.place(u)
        return np.array([x, y, thin * u[2]]) + shift

    block = Block((6, 6, 1), corners, second, place, curved=True)
    deck = [
        *block.deck(),
        '.SEL\n GROUP 5 NOM "all" MAILLES TOUT',
        block.group(1, "x", block.nodes(lambda u: u[1] == 1)),
        block.group(2, "y", block.nodes(lambda u: u[1] == 0)),
        block.group(3, "z", block.nodes(lambda u: u[2] == 0)),
        f'.MAT\n I 1 BEHA "ELASTIC" YT {YOUNG} NT {disc.poisson} M {DENSITY}',
        f".AEL\n I 1 J {len(block.cells)} K 1 MAT 1",
        '.CLM\n GROUP "x" FIX C 1\n GROUP "y" FIX C 2\n GROUP "z" FIX C 3',
        f' GROUP "all" ROT VAL {disc.speed} AXE 0 0 1 AT 3 -2 7',
        ".FIN 1",
    ]
    found = [last_displacement(run("\n".join(deck), tmp_path, ranks=ranks).file) for ranks in (1, 3)]
    assert np.abs(found[0] - found[1]).max() < 1e-12 * np.abs(found[0]).max()
    assert disc.error(block.points - shift, found[0]) < most


@pytest.mark.parametrize(("kind", "most"), [(6, 2e-6), (4, 7e-6), (8, 6e-9)])
def test_rod_that_stretches_far(kind: int, most: float, tmp_path: Path) -> None:
    """Large displacements: forces grow with the distance from the axis. (F S)' + density w² x = 0 with
    S = E (F² - 1)/2 along a rod without contraction, solved by shooting."""
    load = 0.3  # density w² L²/E

    def rates(_: float, y: np.ndarray) -> list[float]:
        stretch = brentq(lambda f: f * (f * f - 1) / 2 - y[1], 0.6, 3, xtol=1e-15)
        return [stretch, -load * y[0]]

    def end(force: float) -> np.ndarray:
        return solve_ivp(rates, (0, 1), [0.0, force], rtol=1e-11, atol=1e-12).y[:, -1]

    tip = end(brentq(lambda force: end(force)[1], 0.05, 0.6, xtol=1e-13))[0]
    mesh = Sheet((16, 1), kind, lambda u: u * [1, 0.05], alternating=False)
    speed = np.sqrt(load * YOUNG / DENSITY)
    deck = mesh.text("CONT PLAN", f"YT {YOUNG} NT 0. M {DENSITY}")
    deck += '\n.PHP GROUP "all" THICK VAL 0.3\n.FCT I 1 RAMP 0 0 1 1'
    deck += f"\n.CLM\n NOEUD {mesh.names(lambda x: x[0] == 0)} FIX C 1"
    deck += f"\n NOEUD {mesh.names(lambda x: x[1] == 0)} FIX C 2"
    deck += f'\n GROUP "all" ROT VAL {speed:.17g} AXE 0 0 1 NF 1'
    deck += "\n.SAM TYPE STATIC\n.SUB TF 1 H 0.25\n.FIN 1\n"
    result = run(deck, tmp_path)
    moved = last_displacement(result.file)[mesh.unit[:, 0] == 1, 0]
    assert 1 + moved == pytest.approx(np.full(len(moved), tip), abs=most)
    assert result["run/ITERATIONS"].max() <= 5  # the tangent is exact
