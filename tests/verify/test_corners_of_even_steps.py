# SPDX-License-Identifier: BSD-3-Clause
"""Fixed steps of RADAU end at the corners of functions of time, wherever these lie."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import Run, run, said

LINK = """.NOE
 I 1 X 0 0 0
 I 2 X 0.5 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE {drive} NF 1
 I 2 INERTIA N 1 M 1 J 1
 I 3 INERTIA N 2 M 1 J 0.1
 I 4 HINGE N 1 2 AXIS 0 0 1 AT 0.3 0 0
.CLM STRU ACC VAL 0 -9.81 0
.FCT
 I 1 TABLE 0 0 {corner!r} 3 0.7 1 2 1
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF {end!r} H {step} {rest}
.FIN 1
"""


def link(drive: str, corner: float, rest: str = "", end: float = 1, step: str = "0.01") -> str:
    """A driven crank with a pendulum at its end."""
    return LINK.format(drive=drive, corner=corner, rest=rest, end=end, step=step)


@pytest.mark.parametrize("corner", [0.5, 0.47, 0.41])
@pytest.mark.parametrize("step", [0.1, 0.05])
def test_work_of_a_drive_to_a_corner_within_a_step(corner: float, step: float, tmp_path: Path) -> None:
    """A wheel of inertia 1 comes to 10 rad/s: the work was off by up to a fifth, with a warning."""
    deck = f""".NOE
 I 1 X 0 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 2 INERTIA N 1 M 1 J 1
.FCT
 I 1 TABLE 0 0 {corner} 10 10 10
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 1 H {step}
.FIN 1
"""
    whole = run(deck, tmp_path)
    assert whole["run/external_work"][-1] == pytest.approx(50, rel=1e-9)
    assert abs(whole["run/energy_error"]).max() < 1e-9 * 50
    assert whole.t == pytest.approx(np.arange(round(1 / step) + 1) * step, rel=1e-14)
    assert "warning" not in said(deck, tmp_path)


# a mass of 1 on a slider, pushed by 10
PUSHED = """.NOE
 I 1 X 0 0 0
.MCE
 I 1 SLIDER N 0 1 AXIS 1 0 0
 I 2 INERTIA N 1 M 1 J 1
.CLM
 CHARGE NOEUD 1 C 1 V 10 NF 1
.FCT
 I 1 {function}
.SAM TYPE DYNAMIC SCHEME {scheme}
.SUB TF 1 H 0.1
.FIN 1
"""


@pytest.mark.parametrize("function", ['EXPR "IF(T>={corner},1,0)"', "TABLE 0 0 {corner} 0 1.41 1"])
@pytest.mark.parametrize("corner", [0.5, 0.47])
def test_force_that_begins_within_a_step(function: str, corner: float, tmp_path: Path) -> None:
    """At once or by and by, the scheme integrates it exactly; speeds were off by 1e-4 to 1e-3."""
    deck = PUSHED.format(function=function.format(corner=corner), scheme="RADAU")
    left = 1 - corner
    speed = 10 * left if "EXPR" in function else 10 / (1.41 - corner) * left**2 / 2
    assert run(deck, tmp_path)["node/1/VX"][-1] == pytest.approx(speed, rel=1e-12)


def ends_alike(found: Run, exact: Run, off: float) -> None:
    for channel in ("node/2/UX", "node/2/UY", "4/FORCE_X", "4/FORCE_Y"):
        size = abs(exact[channel]).max()
        assert found[channel][-1] == pytest.approx(exact[channel][-1], abs=off * size), channel


@pytest.mark.parametrize("drive", ["SPEED", "ANGLE"])
@pytest.mark.parametrize("corner", [0.3, 0.3 + 1e-13, 0.3 - 1e-13, 0.3 + 1e-8, 0.3 - 1e-8, 0.307])
def test_corners_beside_ends_of_steps(drive: str, corner: float, tmp_path: Path) -> None:
    """One within the rounding of their sum is at the end of a step, others are not. An angle by a TABLE gives
    impulses, as with TOL; they were forces over a step, with a warning."""
    found = run(link(drive, corner), tmp_path)
    exact = run(link(drive, corner, "TOL 1E-8"), tmp_path, "exact")
    ends_alike(found, exact, 1e-6)
    assert len(found.t) == 101 and found.t == pytest.approx(0.01 * np.arange(101), abs=1e-12)
    assert "warning" not in said(link(drive, corner), tmp_path)


@pytest.mark.parametrize("drive", ["SPEED", "ANGLE"])
@pytest.mark.parametrize(("corner", "end"), [(0.3, 0.3), (0.307, 0.307), (0.307, 0.31), (0.307, 0.3)])
def test_restart_at_a_corner(drive: str, corner: float, end: float, tmp_path: Path) -> None:
    """A run that ends at it has not seen what follows; the one that goes on does."""
    exact = run(link(drive, corner, "TOL 1E-8"), tmp_path, "exact")
    run(link(drive, corner, end=end), tmp_path, "first")
    ends_alike(run(link(drive, corner), tmp_path, "then", options=("--restart", "first")), exact, 1e-6)


def test_pulse_shorter_than_a_step(tmp_path: Path) -> None:
    """It is not missed, and nothing is warned of."""
    even, blind = (PUSHED.format(function="TABLE 0.31 0 0.32 1 0.33 0", scheme=s) for s in ("RADAU", "CHUNG"))
    assert run(even, tmp_path)["node/1/VX"][-1] == pytest.approx(0.1, rel=1e-12)
    assert "warning" not in said(even, tmp_path)
    assert "passes over that" in said(blind, tmp_path)
