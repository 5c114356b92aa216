# SPDX-License-Identifier: BSD-3-Clause
"""A string that is reeled in with a speed that jumps: the work of the winch is what the load gains."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import Run, run, said

# the load hangs in its string and is lifted from 0.313 on; the jump of the speed makes it bounce
WINCH = """.NOE
 I 1 X 0 0 {place!r}
.MCE
 I 1 CABLE N 0 1 EA 2D4 LENGTH 2 NF 1
 I 2 INERTIA N 1 M 20
.FCT
 I 1 TABLE 0 1 0.313 1 1 0.6
.CLM
 STRU ACC 0 0 -9.81
 FIX NOEUD 1 C 1 2
.SAM {sam}
.SUB TF {end!r} H {steps}
.FIN 1
"""
PLACE = -2 * (1 + 20 * 9.81 / 2e4)


def winch(sam: str, steps: str, end: float = 0.6) -> str:
    return WINCH.format(place=PLACE, sam=sam, steps=steps, end=end)


def off(found: Run) -> float:
    return np.abs(found["run/ENERGY_ERROR"]).max() / np.abs(found["run/EXTERNAL_WORK"]).max()


@pytest.mark.parametrize("sam", ["TYPE DYNAMIC SCHEME RADAU", "TYPE DYNAMIC"])
def test_steps_that_follow_their_error(sam: str, tmp_path: Path) -> None:
    assert off(run(winch(sam, "0.02 TOL 1E-8"), tmp_path)) < (1e-10 if "RADAU" in sam else 1e-7)


@pytest.mark.parametrize("sam", ["TYPE DYNAMIC SCHEME RADAU", "TYPE DYNAMIC"])
def test_corner_within_a_step(sam: str, tmp_path: Path) -> None:
    """The work is of second order all the same, and nothing is warned of."""
    errors = [off(run(winch(sam, f"{h!r}"), tmp_path, f"h{h}")) for h in (4e-4, 2e-4, 1e-4)]
    assert errors[0] / errors[2] > 12
    assert errors[2] < 1e-6
    assert "balance" not in said(winch(sam, "2e-4"), tmp_path)


def test_reeled_slowly(tmp_path: Path) -> None:
    """Statics: the load gains its weight times the height, and the string nothing."""
    found = run(winch("TYPE STATIC", "0.05", 1.0), tmp_path)
    lifted = found["node/1/UZ"][-1]
    assert lifted == pytest.approx(0.4 * -PLACE, rel=1e-9)
    assert found["run/EXTERNAL_WORK"][-1] == pytest.approx(
        found["run/POTENTIAL_ENERGY"][-1] - found["run/POTENTIAL_ENERGY"][0], rel=2e-4
    )
