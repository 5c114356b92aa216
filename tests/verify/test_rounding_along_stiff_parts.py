# SPDX-License-Identifier: BSD-3-Clause
"""A string that vibrates across by 1e-5 of its length. Accelerations along it are 3e-6 of those across, and
part of them is rounding of places, which grows as steps become shorter: no run is made for them."""

import math
from pathlib import Path

import numpy as np
import pytest
from runs import solve

PARTS, TENSION, MASS, SPEED = 8, 1e3, 0.01, 1e-3


def string() -> str:
    def numbered(card: str, ids: range) -> str:
        return "\n".join(" " + card.format(i=i, j=i + 1) for i in ids)

    inner = range(2, PARTS + 1)
    speeds = "\n".join(
        f" VIT NOEUD {i} C 3 V {SPEED * math.sin(math.pi * (i - 1) / PARTS):.16g}" for i in inner
    )
    places = "\n".join(f" I {i + 1} X {i / PARTS} 0 0" for i in range(PARTS + 1))
    return f""".NOE
{places}
.MCE
{numbered(f"I {{i}} BAR N {{i}} {{j}} EA 1E7 TENSION {TENSION}", range(1, PARTS + 1))}
{numbered(f"I 2{{i}} INERTIA N {{i}} M {MASS}", inner)}
.INI
{speeds}
.CLM
 FIX NOEUD 1 {PARTS + 1} C 1 2 3
.SAM TYPE DYNAMIC START STATIC ACCURACY FINE
.SUB TF 0.05 H 0.0005
.FIN 1
"""


def test_rounding_along_stiff_parts(tmp_path: Path) -> None:
    account, string_run = solve(string(), tmp_path)
    assert account["accuracy"]["estimated_error"] < 1e-5
    assert account["accuracy"]["channel"].endswith("Z")
    assert account["said"].count("again, with") <= 2 and "TOL will reach" not in account["said"]
    # mode of a lumped string: w = 2 sqrt(T/(m l)) sin(pi/2n)
    w = 2 * math.sqrt(TENSION / (MASS / PARTS)) * math.sin(math.pi / (2 * PARTS))
    exact = SPEED / w * np.sin(w * string_run.t)
    middle = string_run[f"node/{PARTS // 2 + 1}/UZ"]
    assert np.sqrt(np.mean((middle - exact) ** 2)) < 3e-5 * np.ptp(exact)
    along = string_run["node/4/AX"]
    assert np.ptp(along) == pytest.approx(2e-6, rel=0.5)
