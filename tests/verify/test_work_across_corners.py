# SPDX-License-Identifier: BSD-3-Clause
"""Work of temperatures and winches whose functions of time have corners or jump: powers jump at a corner, and
a jump changes the stored energy while nothing moves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import Run, solve

# a bar of two cells, held at one end and across
BAR = """
.NOE
 I 1 X 0 0
 I 2 X 1 0
 I 3 X 2 0
 I 4 X 0 0.1
 I 5 X 1 0.1
 I 6 X 2 0.1
.MAI
 I 1 N 1 2 5 4
 I 2 N 2 3 6 5
.SEL
 GROUP 1 NOM "all" MAILLES TOUT
.HYP CONTRAINTE PLANE
.PHP
 GROUP "all" THICK VAL 0.1
.MAT
 I 1 YT 2.1E9 NT 0 M 1000. A 1E-5 DAMPING 2E-5
.AEL
 GROUP "all" MAT 1
.CLM
 FIX NOEUD 1 A 6 C 2
 FIX NOEUD 1 4 C 1
 NOEUD 1 A 6 TEMP V 100 NF 1
"""

# a mass on a rope that is hauled in
WINCH = """
.NOE
 I 1 X 0 0 0
 I 2 X 0 0 -10
.MCE
 I 1 CABLE N 0 2 EA 2D6 LENGTH 10. NF 1
 I 2 INERTIA N 2 M 500.
.CLM
 STRU ACC VAL 0 0 -9.81
 FIX NOEUD 2 C 1 2 4 5 6
"""

JUMP = "if(T < 0.001, 0, 1)"
CORNERS = "min(1, T/0.0002) - max(0, min(1, (T - 0.004)/0.001))"


def solved(deck: str, function: str, sam: str, sub: str, folder: Path) -> Run:
    """The deck at ACCURACY FINE, which must say nothing of its energy."""
    end = f".SAM TYPE DYNAMIC ACCURACY FINE {sam}\n.SUB {sub}\n.FIN 1\n"
    account, result = solve(f'{deck}.FCT\n I 1 EXPR "{function}"\n{end}', folder)
    assert "energy" not in account["said"]
    return result


@pytest.mark.parametrize("function", [JUMP, CORNERS])
def test_temperatures(function: str, tmp_path: Path) -> None:
    bar = solved(BAR, function, "", "TF 0.01 H 5E-5", tmp_path)
    work = bar["run/EXTERNAL_WORK"]
    assert np.abs(bar["run/ENERGY_ERROR"]).max() < 1e-5 * np.abs(work).max()
    if function == JUMP:  # before anything moves, E (a V)^2/2 of each direction in its plane
        after = np.argmax(bar.t > 0.001 + 1e-9)
        assert work[after] == pytest.approx(2.1e9 * 0.001**2 * 0.02, rel=1e-3)


@pytest.mark.parametrize("function", ["1 - 0.05*max(0, T - 0.2)", "if(T < 0.3, 1, 0.9999)"])
def test_winches(function: str, tmp_path: Path) -> None:
    winch = solved(WINCH, function, "START STATIC", "TF 0.6 H 0.01", tmp_path)
    assert np.abs(winch["run/ENERGY_ERROR"]).max() < 1e-5 * np.ptp(winch["run/EXTERNAL_WORK"])
