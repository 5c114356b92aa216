# SPDX-License-Identifier: BSD-3-Clause
"""Standard problems of solids, as functions of the cell and of how many boxes there are: a thick tube, and a
cantilever bent far against the elastica. `test_solids.py` asserts the errors, `tests/bench/cell_tables.py`
prints them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from cell_problems import solve
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from solid_meshes import Block


def tube_error(corners: int, second: bool, boxes: int, folder: Path) -> float:
    """A quarter of a thick tube of the radii 1 and 2 under inner pressure (Lamé), held along its axis: radial
    displacements, root of the mean square over nodes, of the largest one."""
    inner, outer, pressure, young, poisson = 1.0, 2.0, 100.0, 1000.0, 0.3

    def place(u):
        radius, angle = inner + (outer - inner) * u[0], np.pi / 2 * u[1]
        return np.array([radius * np.cos(angle), radius * np.sin(angle), 0.5 * u[2]])

    block = Block((boxes, boxes, 1 if boxes < 3 else boxes // 2), corners, second, place, curved=True)
    deck = [
        *block.deck(),
        ".SEL",
        block.group(1, "x", block.nodes(lambda u: u[1] == 1)),
        block.group(2, "y", block.nodes(lambda u: u[1] == 0)),
        block.group(3, "z", block.nodes(lambda u: u[2] in (0, 1))),
        *block.group_of_faces(4, "bore", lambda u: u[0] == 0),
        f'.MAT\n I 1 BEHA "ELASTIC" YT {young} NT {poisson}',
        f".AEL\n I 1 J {len(block.cells)} K 1 MAT 1",
        '.CLM\n GROUP "x" FIX C 1\n GROUP "y" FIX C 2\n GROUP "z" FIX C 3',
        f' GROUP "bore" PRE V {pressure}',
    ]
    found = solve(deck, folder)
    radius = np.hypot(block.points[:, 0], block.points[:, 1])
    constant = pressure * inner**2 / (outer**2 - inner**2) * (1 + poisson) / young
    expected = constant * ((1 - 2 * poisson) * radius + outer**2 / radius)
    radial = (found[:, :2] * block.points[:, :2]).sum(axis=1) / radius
    return float(np.sqrt(np.mean((radial - expected) ** 2)) / expected.max())


LENGTH, SIDE, YOUNG = 10.0, 0.1, 1.2e6  # of a square section
LOAD = 4 * YOUNG * SIDE**4 / 12 / LENGTH**2  # P L^2/(E I) = 4


def cantilever(corners: int, second: bool, boxes: int, folder: Path) -> np.ndarray:
    """Place of the tip over the length, of so many boxes of St Venant-Kirchhoff material without
    contraction across (nu = 0)."""
    block = Block((boxes, 1, 1), corners, second, lambda u: u * [LENGTH, SIDE, SIDE])
    end = block.nodes(lambda u: u[0] == 1)
    deck = [
        *block.deck(),
        ".SEL",
        block.group(1, "wall", block.nodes(lambda u: u[0] == 0)),
        block.group(2, "end", end),
        f'.MAT\n I 1 BEHA "ELASTIC" YT {YOUNG} NT 0.',
        f".AEL\n I 1 J {len(block.cells)} K 1 MAT 1",
        f'.CLM\n GROUP "wall" FIX C 1 2 3\n GROUP "end" CHA C 3 V {LOAD / len(end):.16g} NF 1',
        ".FCT\n I 1 RAMP 0 0 1 1",
        ".SAM TYPE STATIC\n.SUB TF 1 H 0.05",
    ]
    moved = solve(deck, folder)[end].mean(axis=0)[[0, 2]]
    return np.array([1.0, 0.0]) + moved / LENGTH


def rod_tip() -> np.ndarray:
    """Place of the tip over the length, of the elastica of that material: a rod whose plane sections stay
    plane, which stretches and shears (E. Reissner 1972, J. Appl. Math. Phys. 23, 795-804).

    With stretch a of the axis and curvature k the fibre at height y has the stretch u = a + k y and the
    nominal stress E (u^3 - u)/2; its integrals over the section are the force and the moment. Shear is
    linear, with the factor 5/6 of a rectangle (G. R. Cowper 1966, for nu = 0)."""
    area, second, fourth = SIDE**2, SIDE**4 / 12, SIDE**6 / 80

    def strains(force: float, moment: float) -> tuple[float, float]:
        found = np.array([1 + force / YOUNG / area, moment / YOUNG / second])
        for _ in range(8):
            a, k = found
            left = (
                YOUNG
                / 2
                * np.array(
                    [(a**3 - a) * area + 3 * a * k**2 * second, (3 * a**2 - 1) * k * second + k**3 * fourth]
                )
            )
            both = 6 * a * k * second
            slope = (
                YOUNG
                / 2
                * np.array(
                    [
                        [(3 * a**2 - 1) * area + 3 * k**2 * second, both],
                        [both, (3 * a**2 - 1) * second + 3 * k**2 * fourth],
                    ]
                )
            )
            found = found - np.linalg.solve(slope, left - [force, moment])
        return found[0], found[1]

    def rates(_: float, y: np.ndarray) -> list[float]:
        turn, moment = y[:2]
        a, k = strains(LOAD * np.sin(turn), moment)
        shear = LOAD * np.cos(turn) / (5 / 6 * YOUNG / 2 * area)
        forward = a * np.cos(turn) - shear * np.sin(turn)
        return [k, -LOAD * forward, forward, a * np.sin(turn) + shear * np.cos(turn)]

    def end(moment: float) -> np.ndarray:
        return solve_ivp(rates, (0, LENGTH), [0, moment, 0, 0], rtol=1e-10, atol=1e-12).y[:, -1]

    return end(brentq(lambda moment: end(moment)[1], 0.3 * LOAD * LENGTH, LOAD * LENGTH))[2:] / LENGTH
