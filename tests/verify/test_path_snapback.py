# SPDX-License-Identifier: BSD-3-Clause
"""Paths whose loaded end moves much farther than what snaps; loads that stay where a path comes back."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import Run, solve

EA, HEIGHT = 1e5, 0.2
FALL = EA / (1 + HEIGHT**2) ** 1.5  # force of the two bars with Green's strain: FALL z (HEIGHT^2 - z^2)
LIMIT = FALL * 2 / 3**1.5 * HEIGHT**3


def truss(spring: float, function: str, rest: str = "") -> str:
    """Two shallow bars, pressed by twice their limit load through a soft spring, in proportion to their
    stiffness: a spring that is long enough to give way."""
    soft = spring * 2 * EA * HEIGHT**2
    top = HEIGHT + 10 * LIMIT / soft
    return f""".NOE
 I 1 X 0 0 0
 I 2 X 2 0 0
 I 3 X 1 0 {HEIGHT!r}
 I 4 X 1 0 {top!r}
.MCE
 I 1 BAR N 1 3 EA {EA!r}
 I 2 BAR N 2 3 EA {EA!r}
 I 3 SPRING N 3 4 K {soft!r}
.CLM
 FIX NOEUD 1 2 C 1 2 3
 FIX NOEUD 3 4 C 1 2
 CHA NOEUD 4 C 3 V {-2 * LIMIT!r} NF 1
.FCT
 I 1 {function}
.SAM TYPE STATIC
.SUB TF 1 H 0.05
.PATH {rest}
.FIN 1
"""


def force(found: Run) -> np.ndarray:
    z = HEIGHT + found["node/3/UZ"]
    return FALL * z * (HEIGHT**2 - z**2)


@pytest.mark.parametrize("spring", [1.0, 0.03, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7])
def test_sharp_snap_back(spring: float, tmp_path: Path) -> None:
    """What the bars do is seen however far the end of the spring moves: it was passed in one step, with
    status 0 and no limit point."""
    summary, found = solve(truss(spring, 'EXPR "T"'), tmp_path)
    points = summary["critical_points"]
    assert [(p["kind"], p["unstable_behind"]) for p in points] == [("limit", 1), ("limit", 0)]
    assert [p["load_time"] for p in points] == pytest.approx([0.5, -0.5], rel=1e-6)
    assert 2 * LIMIT * found["run/LOAD_TIME"] == pytest.approx(force(found), abs=1e-7 * LIMIT)
    assert np.abs(np.diff(found["node/3/UZ"])).max() < 0.25 * HEIGHT
    assert found["run/LOAD_TIME"][-1] == pytest.approx(1, rel=1e-12)
    assert len(found.t) < 80


@pytest.mark.parametrize("spring", [1e-3, 1e-7])
def test_restart_behind_a_snap_back(spring: float, tmp_path: Path) -> None:
    """What has been travelled is known to a restart: it goes on in steps of the same size."""
    solve(truss(spring, 'EXPR "T"'), tmp_path)
    longer = truss(spring, 'EXPR "T"').replace("TF 1", "TF 2")
    _, found = solve(longer, tmp_path, "deck", "--restart", str(tmp_path / "deck"))
    assert 2 * LIMIT * found["run/LOAD_TIME"] == pytest.approx(force(found), abs=1e-7 * LIMIT)
    assert found["run/LOAD_TIME"][-1] == pytest.approx(2, rel=1e-12)
    assert len(found.t) < 80


@pytest.mark.parametrize("rest", ["", "STEPS 60"])
def test_loads_that_stay(rest: str, tmp_path: Path) -> None:
    """Below its first point a TABLE holds its value. The path went on with the load time alone, and nothing
    was said."""
    summary, found = solve(truss(1.0, "TABLE 0 0 1 1", rest), tmp_path, status=2)
    assert "the loads stay as they are from load time" in summary["said"]
    assert 'EXPR "T"' in summary["said"]
    assert found["run/LOAD_TIME"].min() > -0.01


def test_loads_that_stay_for_a_while(tmp_path: Path) -> None:
    """A path passes times at which the loads stand still where they go on changing before."""
    _, found = solve(truss(1.0, "TABLE -2 -2 -0.2 -0.2 -0.1 0 0 0 1 1"), tmp_path)
    assert found["run/LOAD_TIME"].min() < -0.3
    assert found["run/LOAD_TIME"][-1] == pytest.approx(1, rel=1e-12)
    assert found["node/3/UZ"][-1] < -2 * HEIGHT
