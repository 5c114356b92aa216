# SPDX-License-Identifier: BSD-3-Clause
"""Membranes that wrinkle: a sheet under tension that is bent in its plane, against a closed form."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from runs import run


def last(file: Path, field: str) -> np.ndarray:
    with h5py.File(file) as results:
        frames = results[field]
        return np.asarray(frames[sorted(f for f in frames if f.isdigit())[-1]])


def bent_sheet(rows: int, band: float, folder: Path) -> np.ndarray:
    """Force and moment on the end of a sheet of height 1 that wrinkles over `band` of it. Cloth
    without lateral contraction does not move across. Strains are so small that those of the closed form are those of the deck."""
    young, thick, largest = 1000.0, 0.01, 1e-5
    columns = 2
    places = [
        (i / columns, j / rows - 0.5) for j in range(rows + 1) for i in range(columns + 1)
    ]
    nodes = "\n".join(f" I {n + 1} X {x!r} {y!r} 0" for n, (x, y) in enumerate(places))
    cells = "\n".join(
        f" I {j * columns + i + 1} N {' '.join(str(j * w + i + 1 + k) for k in (0, 1, w + 1, w))}"
        for w in [columns + 1]
        for j in range(rows)
        for i in range(columns)
    )
    ends = "\n".join(
        f" DEP NOEUD {n + 1} C 1 V {largest * (y + 0.5 - band) / (1 - band)!r}"
        for n, (x, y) in enumerate(places)
        if x == 1
    )
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
 I 1 BEHA "ELASTIC" YT {young} NT 0.
.HYP MEMBRANE GROUP "sheet" WRINKLING SLACK 1E-6
.PHP
 GROUP "sheet" THICK VAL {thick}
.AEL
 GROUP "sheet" MAT 1
.CLM
 FIX NOEUD {left} C 1
 FIX GROUP "nodes" C 2 3
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


@pytest.mark.parametrize("band", [0.25, 0.5])
def test_bent_sheet(band: float, tmp_path: Path) -> None:
    """Stein and Hedgepeth (1961, NASA TN D-813): over the band b the sheet is wrinkled, and its stress
    rises from there in proportion to the distance, as of strips. P and M give the band,
    b/H = 3 M/(P H) − 1/2, and the curvature, 2 P/(E t (H − b)²)."""
    errors = []
    for rows in (6, 12, 24):
        force, moment = bent_sheet(rows, band, tmp_path)
        assert force > 0
        found = 3 * moment / force - 0.5
        curvature = 2 * force / (1 - band) ** 2
        errors.append([abs(found - band), abs(curvature * (1 - band) - 1)])
    errors = np.array(errors)
    print(errors)
    assert (errors[-1] < 2e-3).all()
    assert (errors[-1] < errors[0] / 3).all()
