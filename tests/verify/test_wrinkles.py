# SPDX-License-Identifier: BSD-3-Clause
"""Membranes that wrinkle: a sheet under tension that is bent in its plane, against a closed form."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from runs import run

STRAIN, SLACK = 1e-4, 1e-5


def last(file: Path, field: str) -> np.ndarray:
    with h5py.File(file) as results:
        frames = results[field]
        return np.asarray(frames[sorted(f for f in frames if f.isdigit())[-1]])


def bent_sheet(rows: int, band: float, folder: Path) -> np.ndarray:
    """Force and moment on the end of a sheet of height 1 that wrinkles over `band` of it, free at its edges.
    Strains are so small that those of the closed form are those of the deck."""
    young, thick, largest = 1000.0, 0.01, STRAIN
    curvature = largest / (1 - band)
    places, ids = [], {}

    def node(i: int, j: int) -> int:
        """On a lattice of half cells: two cells along the sheet."""
        if (i, j) not in ids:
            places.append((i / 4, j / (2 * rows) - 0.5))
            ids[i, j] = len(places)
        return ids[i, j]

    round_it = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    cells = "\n".join(
        f" I {2 * j + i + 1} N "
        + " ".join(
            str(node(2 * i + a, 2 * j + b) * (-1 if k % 2 else 1)) for k, (a, b) in enumerate(round_it)
        )
        for j in range(rows)
        for i in range(2)
    )
    nodes = "\n".join(f" I {n + 1} X {x!r} {y!r} 0" for n, (x, y) in enumerate(places))
    ends = "\n".join(
        f" DEP NOEUD {n + 1} C 1 V {curvature * (y + 0.5 - band)!r}"
        for n, (x, y) in enumerate(places)
        if x == 1
    )
    origin = ids[0, rows]
    left = " ".join(str(n + 1) for n, (x, _) in enumerate(places) if x == 0)
    solved = run(
        f""".NOE
{nodes}
.MAI
{cells}
.SEL
 GROUP 1 NOM "sheet" MAILLES TOUT
 GROUP 2 NOM "nodes" NOEUDS TOUT
.MAT
 I 1 BEHA "ELASTIC" YT {young} NT 0.3
.HYP MEMBRANE GROUP "sheet" WRINKLING SLACK {SLACK}
.PHP
 GROUP "sheet" THICK VAL {thick}
.AEL
 GROUP "sheet" MAT 1
.CLM
 FIX NOEUD {left} C 1
 FIX NOEUD {origin} C 2
 FIX GROUP "nodes" C 3
{ends}
.SAM TYPE STATIC
.SUB TF 1 H 1
.FIN 1
""",
        folder,
    )
    places = np.array(places)
    end = places[:, 0] == 1
    force = last(solved.file, "fields/reaction_force")[end, 0]
    unit = young * thick * largest
    return np.array([force.sum(), force @ places[end, 1]]) / unit


@pytest.mark.parametrize(
    ("rows", "band", "most"), [(4, 0.25, 1e-3), (4, 0.5, 1e-3), (4, 0.3, 2e-2), (24, 0.3, 2e-3)]
)
def test_bent_sheet(rows: int, band: float, most: float, tmp_path: Path) -> None:
    """Stein and Hedgepeth (1961, NASA TN D-813): over the band b the sheet is wrinkled, and its stress
    rises from there in proportion to the distance, as of strips. P and M give the band,
    b/H = 3 M/(P H) − 1/2, and the curvature, 2 P/(E t (H − b)²). The pressure under which the sheet wrinkles
    and the stiffness that it keeps then, of SLACK, are part of the stress."""
    y = np.linspace(-0.5, 0.5, 100001)
    strain = (y + 0.5 - band) / (1 - band)
    pressure = 0.1 * SLACK / STRAIN
    stress = np.maximum(strain, SLACK * (strain + pressure) - pressure)
    wanted = np.array([np.trapezoid(stress, y), np.trapezoid(stress * y, y)])
    found = bent_sheet(rows, band, tmp_path)
    assert found == pytest.approx(wanted, rel=most)
    force, moment = found
    assert 3 * moment / force - 0.5 == pytest.approx(band, abs=most + 4 * pressure)
    assert 2 * force / (1 - band) == pytest.approx(1, abs=most + 4 * pressure)
