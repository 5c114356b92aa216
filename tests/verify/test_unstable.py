# SPDX-License-Identifier: BSD-3-Clause
"""Load steps of statics stay on unstable equilibria of perfect structures, which nature leaves: the run says
so, and of stable ones it does not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from beam_problems import Line, clamp, deck, straight
from runs import run, said

LENGTH = 10.0
EULER = np.pi**2 * 1e3 / (4 * LENGTH**2)  # of a column with EI 1e3, clamped and free


def column(load: float, inertia: str = "1D3 1D3", across: float = 0) -> str:
    line = Line(straight(LENGTH, (0, 1, 0)), 4)
    loads = f" {clamp(1)}\n CHA NOEUD {line.last} C 2 3 V {-load * EULER!r} {across!r} NF 1"
    rest = f'.CLM\n{loads}\n.FCT\n I 1 EXPR "T"\n.SAM TYPE STATIC\n.SUB TF 1 H 0.1\n'
    return deck([line], f"EA 1D9 GA 1D9 1D9 GJ 1D3 EI {inertia}", rest, "BPR 1 AXIS2 1 0 0")


@pytest.mark.parametrize(
    ("load", "inertia", "found"),
    [
        (0.97, "1D3 1D3", ""),
        (1.2, "1D3 1D3", "t = 0.9 is unstable in 2 directions"),
        (1.2, "1D3 1D6", "t = 0.9 is unstable in 1 direction:"),
    ],
)
def test_a_straight_column(load: float, inertia: str, found: str, tmp_path: Path) -> None:
    words = said(column(load, inertia), tmp_path)
    assert (found in words) if found else ("unstable" not in words)


def test_a_load_across_leaves_the_straight_column(tmp_path: Path) -> None:
    text = column(1.2, across=0.02 * EULER)
    assert "unstable" not in said(text, tmp_path)
    assert np.abs(run(text, tmp_path)["node/9/UZ"][-1]) > 0.3 * LENGTH


@pytest.mark.parametrize("solver", ["MUMPS", "KLU"])
@pytest.mark.parametrize(("stiffness", "unstable"), [(9.9, False), (9.7, True)])
def test_an_inverted_pendulum(stiffness: float, unstable: bool, solver: str, tmp_path: Path) -> None:
    """A mass of 1 on a rod of length 1 above a hinge with a torsion spring: stable if this exceeds m g l."""
    text = f""".NOE
 I 1 X 0 1 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0 K {stiffness}
 I 2 INERTIA N 1 M 1
.CLM
 STRU ACC 0 -9.81 0
.SAM TYPE STATIC SOLVER {solver}
.SUB TF 1 H 1
.FIN 1
"""
    assert ("unstable in 1 direction" in said(text, tmp_path)) == unstable


def test_a_moment_about_an_axis_in_space_does_not_tell(tmp_path: Path) -> None:
    """Such a moment has no potential: energies say nothing of the stability of what it bends."""
    line = Line(straight(LENGTH, (0, 1, 0)), 4)
    loads = f" {clamp(1)}\n CHA NOEUD {line.last} C 6 V {2 * np.pi * 1e3 / LENGTH!r} NF 1"
    rest = f'.CLM\n{loads}\n.FCT\n I 1 EXPR "T"\n.SAM TYPE STATIC\n.SUB TF 1 H 0.05\n'
    text = deck([line], "EA 1D9 GA 1D9 1D9 GJ 1D3 EI 1D3 1D3", rest, "BPR 1 AXIS2 1 0 0")
    assert "unstable" not in said(text, tmp_path)


@pytest.mark.parametrize(("stiffness", "unstable"), [(19.8, False), (19.5, True)])
def test_redundant_constraints_count_too(stiffness: float, unstable: bool, tmp_path: Path) -> None:
    """An upright parallelogram of hinges in space: m g (l/2 + l/2 + l) cos q + K q^2/2."""
    text = f""".NOE
 I 1 X 0 0.5 0
 I 2 X 1 1 0
 I 3 X 2 0.5 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0 K {stiffness}
 I 2 HINGE N 1 2 AXIS 0 0 1 AT 0 1 0
 I 3 HINGE N 2 3 AXIS 0 0 1 AT 2 1 0
 I 4 HINGE N 3 0 AXIS 0 0 1 AT 2 0 0
 I 5 INERTIA N 1 M 1
 I 6 INERTIA N 2 M 1
 I 7 INERTIA N 3 M 1
.CLM
 STRU ACC 0 -9.81 0
.SAM TYPE STATIC
.SUB TF 1 H 1
.FIN 1
"""
    assert ("unstable in 1 direction" in said(text, tmp_path)) == unstable


@pytest.mark.parametrize("joint", ["HINGE", "SPHERICAL", "CYLINDRICAL"])
def test_friction_that_is_idle_is_no_direction(joint: str, tmp_path: Path) -> None:
    axis = "" if joint == "SPHERICAL" else "AXIS 0 0 1"
    text = f""".NOE
 I 1 X 1 0 0
.MCE
 I 1 {joint} N 0 1 {axis} FRICTION CONST 0.3 RADIUS 0.05 STICK
 I 2 BUSHING N 0 1 K 100 100 100 100 100 100
 I 3 FORCE N 1 DIR 0 1 0 V 1 NF 1
.FCT
 I 1 RAMP 0 0 1 1
.SAM TYPE STATIC
.SUB TF 1 H 0.1
.FIN 1
"""
    assert "unstable" not in said(text, tmp_path)


def test_a_spring_law_of_the_time_wins_no_energy(tmp_path: Path) -> None:
    """It has no potential, and what it does to other springs is no leap: 12 593 steps were cut in vain."""
    text = """.NOE
 I 1
 I 2 X 1
.MCE
 I 1 PRISMATIC N 0 1 AXIS 0 1 0 MIN -0.1 MAX 0.1 KSTOP 1D5 K 10
 I 2 PRISMATIC N 0 2 AXIS 1 0 0 LAW EXPR 2
 I 3 SPRING N 1 2 K 1D3
 I 4 PRISMATIC N 0 1 AXIS 0 0 1
.FCT
 I 2 EXPR "1000*(D-0.5*T)"
.SAM TYPE STATIC
.SUB TF 1 H 0.1
.FIN 1
"""
    assert "energy" not in said(text, tmp_path)
    done = run(text, tmp_path)
    assert len(done.t) == 11
    assert done["node/2/UX"][-1] == pytest.approx(0.25, abs=1e-9)
