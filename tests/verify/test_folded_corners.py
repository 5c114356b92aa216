# SPDX-License-Identifier: BSD-3-Clause
"""Solids that are turned inside out at a corner, as middles of sides lie too near to it, are named."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import engrane

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
TRIANGLE = [(0, 0), (1, 0), (0, 1)]


def prism(base: list[tuple[int, int]]) -> tuple[list, list]:
    """Corners and sides of a solid with the same base and top."""
    n = len(base)
    around = [(i, (i + 1) % n) for i in range(n)]
    sides = around + [(a + n, b + n) for a, b in around] + [(i, i + n) for i in range(n)]
    return [(*p, z) for z in (0, 1) for p in base], sides


TETRAHEDRON = [(*p, 0) for p in TRIANGLE] + [(0, 0, 1)], [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
SHAPES = {"hexahedron": prism(SQUARE), "wedge": prism(TRIANGLE), "tetrahedron": TETRAHEDRON}


def deck(shape: str, mirrored: bool, moved: tuple[int, int] | None) -> str:
    """A cell with distorted corners; `moved` is a side and the corner to which its middle is too near."""
    corners, sides = SHAPES[shape]
    points = np.array(corners) + np.random.default_rng(1).uniform(-0.08, 0.08, (len(corners), 3))
    points[:, 0] *= -1 if mirrored else 1
    count, base = len(corners), 3 if shape != "hexahedron" else 4
    places = list(points)
    for k, (a, b) in enumerate(sides):
        part = 0.5 if not moved or moved[0] != k else 0.18 if moved[1] == a else 0.82
        places.append(points[a] * (1 - part) + points[b] * part)

    def middle(a: int, b: int) -> int:
        return -(count + 1 + next(k for k, s in enumerate(sides) if set(s) == {a, b}))

    def ring(first: int) -> list[int]:
        return [n for i in range(base) for n in (first + i + 1, middle(first + i, first + (i + 1) % base))]

    top = ring(base) if count > 4 else [4]
    upright = [middle(i, i + base if count > 4 else 3) for i in range(base)]
    nodes = "\n".join(f" I {i + 1} X {' '.join(map(repr, map(float, p)))}" for i, p in enumerate(places))
    return f""".NOE
{nodes}
.MAI
 I 1 N {" ".join(map(str, [*ring(0), 0, *upright, 0, *top]))}
.SEL
 GROUP 1 NOM "all" MAILLES TOUT
.MAT
 I 1 YT 1D9 NT 0.3
.AEL
 GROUP "all" MAT 1
.HYP VOLUME
.CLM
 FIX NOEUD 1 2 3 C 1 2 3
 CHA NOEUD 4 C 3 V 1.
.FIN 1
"""


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("mirrored", [False, True])
def test_folded_corners(shape: str, mirrored: bool, tmp_path: Path) -> None:
    def said(moved: tuple[int, int] | None) -> str:
        done = engrane(deck(shape, mirrored, moved), tmp_path, "check")
        assert done.returncode == 0, done.stderr
        return done.stdout + done.stderr

    assert "inside out" not in said(None)
    corners, sides = SHAPES[shape]
    for corner in range(len(corners)):
        side = next(k for k, ends in enumerate(sides) if corner in ends)
        expected = f"cell 1 is turned inside out at its corner {corner + 1}, node {corner + 1}:"
        assert expected in said((side, corner))
