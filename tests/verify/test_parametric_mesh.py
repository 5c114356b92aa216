# SPDX-License-Identifier: BSD-3-Clause
"""A gear pair whose tooth stiffness varies with the mesh, x'' + (1 + eps cos(rate t)) x = 0: the
boundaries of its first instability, found from runs of the program, against those of the differential
equation."""

from __future__ import annotations

from math import pi
from pathlib import Path

import pytest
from oracles import parametric_mesh
from runs import run
from scipy.optimize import brentq

EPSILON = 0.2


def deck(rate: float, steps: int) -> str:
    """Wheel A turns at constant speed, 20 teeth; wheel B, of inertia 1 at the lever 1, swings on the
    teeth."""
    period = 2 * pi / rate
    return f""".NOE
 I 1 X 0 0 0
 I 2 X 2 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 AXIS 0 0 1 Z 20 20 MN 0.1 ALPHA 20 KM 1 STIFF FOURIER {EPSILON} 0
 I 4 INERTIA N 2 M 1 J 1 1 1
.FCT
 I 1 EXPR "{rate / 20!r}"
.INI
 VIT NOEUD 2 C 6 V {-rate / 20 + 0.01!r}
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF {4 * period!r} H {period / steps!r}
.FIN 1
"""


def trace(rate: float, folder: Path, steps: int = 400) -> float:
    """Of the matrix that carries (x, x') over a period: from three samples a period apart, since its
    determinant is 1. Beyond 2 the motion grows."""
    x = run(deck(rate, steps), folder)["3/U_M"][::steps]
    return float((x[3] + x[1]) / x[2])


def test_boundaries_of_instability(tmp_path: Path) -> None:
    low, high = parametric_mesh.first_instability(EPSILON)
    assert (low, high) == (pytest.approx(1.8988481105, abs=1e-9), pytest.approx(2.0986875606, abs=1e-9))
    # at the first instability solutions repeat after two periods: the trace passes -2
    for expected, outside, inside in ((low, low - 0.05, low + 0.04), (high, high + 0.05, high - 0.04)):
        found = brentq(lambda rate: trace(rate, tmp_path) + 2, outside, inside, xtol=1e-5)
        print(f"boundary {found:.7f}, exact {expected:.7f}: {100 * abs(found / expected - 1):.4f} %")
        assert found == pytest.approx(expected, rel=5e-5)  # asked for: 0.5 %


def test_second_order(tmp_path: Path) -> None:
    # an even equation: both diagonal entries are equal
    exact = 2 * parametric_mesh.monodromy(EPSILON, 1.95)[0, 0]
    errors = [abs(trace(1.95, tmp_path, steps) - exact) for steps in (50, 100, 200)]
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.1)
