# SPDX-License-Identifier: BSD-3-Clause
"""Initial speeds of what vibrates many times in a step. Nothing accelerates at the start, so that only the
slope of the accelerations tells how fast it is."""

from pathlib import Path

import numpy as np
import pytest
from runs import solve

DECK = """
.NOE
 I 1
 I 2 X 1
.MCE
 I 1 INERTIA N 2 M 1 J 1
 I 2 PRISMATIC N 0 2 AXIS 1 0 0 K {stiffness!r}
.INI
 VIT ELEMENT 2 V 1
.SAM TYPE DYNAMIC {scheme} ENERGY 1E9
.SUB TF 0.5 H 0.01
.FIN
"""

SCHEMES = [
    "",
    "RHO 0",
    "RHO 0.99",
    "SCHEME HHT ALPHA 0.3",
    "SCHEME BOSSAK ALPHA 0.3",
    "SCHEME NEWMARK",
    "SCHEME RADAU",
]


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("vibration", [10, 32, 100, 1000, 1e5])
def test_it_never_gets_faster(vibration: float, scheme: str, tmp_path: Path) -> None:
    """`vibration`: ω H. At 1000, RHO 0.8 made 1780 times the speed of it, and RHO 0 2.5e7 times at 1e4."""
    _, found = solve(DECK.format(stiffness=(vibration / 0.01) ** 2, scheme=scheme), tmp_path)
    assert np.abs(found["2/SLIDE_SPEED"]).max() < 1.5
