# SPDX-License-Identifier: BSD-3-Clause
"""Gears that turn at constant speed without a load: every force is the rounding of positions, m ε L/h², and
has nothing but itself to be compared with (docs/theory.md, Newton). Runs with SCHEME RADAU failed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import Run, run, said

SPEED = 50.0
PAIR = """.UNIT {unit}
.NOE
 I 2
 I 3 X {distance}
.FCT
 I 1 EXPR "{speed}"
.MCE
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 HINGE N 0 3 AXIS 0 0 1 DRIVE SPEED NF 1
 I 4 GEAR N 2 3 AXIS 0 0 1 Z 20 40 MN {module} {teeth}
 I 7 INERTIA N 2 M {mass} J {inertia}
 I 8 INERTIA N 3 M {mass} J {inertia}
.SAM TYPE DYNAMIC {solver}
.SUB TF {end} H {h} {more}
.SAI HISTORY DT 0 NEWTON
.FIN 1
"""
SI = {"unit": "SI", "distance": 0.06, "module": 0.002, "mass": 1, "inertia": 1e-3}
MM = {
    "unit": "LENGTH 0.001 MASS 1000 TIME 1",
    "distance": 60,
    "module": 2,
    "mass": 1e-3,
    "inertia": 1,
}
HELICAL = {**SI, "distance": 0.06211657082}

PLANET = """.NOE
 I 2
 I 3
 I 4 X 0.06
 I 5 X 0.06
.FCT
 I 1 EXPR "50"
.MCE
 I 1 HINGE N 0 2 AXIS 0 0 1
 I 2 HINGE N 0 3 AXIS 0 0 1 DRIVE SPEED NF 1
 I 3 HINGE N 5 4 AXIS 0 0 1
 I 4 GEAR N 2 4 AXIS 0 0 1 Z 20 40 MN 0.002
 I 5 RIGID N 3 5
 I 7 INERTIA N 2 M 1 J 1E-3
 I 8 INERTIA N 3 M 1 J 1E-3
{more}.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 0.1 H 1E-3
.FIN 1
"""


def deck(
    units: dict,
    h: float = 1e-3,
    end: float = 0.2,
    speed: float = SPEED,
    more: str = "",
    teeth: str = "",
    solver: str = "SCHEME RADAU",
) -> str:
    return PAIR.format(**units, h=h, end=end, speed=speed, more=more, teeth=teeth, solver=solver)


def rejected_steps(folder: Path) -> int:
    line = next(x for x in (folder / "deck.lst").read_text().splitlines() if "failed attempts" in x)
    return int(line.split("step), ")[1].split()[0])


def check_idle(result: Run, speed: float, h: float, way: float) -> None:
    """Nothing acts; what is left is within the rounding of places, through the inertia of a step."""
    assert result["3/ANGLE"][-1] == pytest.approx(way, rel=1e-12)
    assert result["2/ANGLE"][-1] == pytest.approx(-2 * way, rel=1e-12)
    np.testing.assert_allclose(result["2/SPEED"], -2 * speed, rtol=1e-11)
    rounding = 1e3 * np.finfo(float).eps * max(1.0, way) * 1e-3 / h**2
    assert np.abs(result["3/DRIVE_TORQUE"]).max() <= rounding


@pytest.mark.parametrize(
    ("units", "teeth"),
    [(SI, ""), (MM, ""), (SI, "SEPARATION NO"), (HELICAL, "KIND HELICAL HELIX 15")],
    ids=["si", "mm", "no separation", "helical"],
)
def test_pair(units: dict, teeth: str, tmp_path: Path) -> None:
    result = run(deck(units, teeth=teeth), tmp_path)
    if units is not MM:
        check_idle(result, SPEED, 1e-3, SPEED * 0.2)
    assert rejected_steps(tmp_path) == 0


@pytest.mark.parametrize("teeth", ["", "SEPARATION NO"])
def test_fast_pair_with_many_turns(teeth: str, tmp_path: Path) -> None:
    """The angle that the drive prescribes is rounded by ε times 200 rad."""
    result = run(deck(SI, h=1e-4, speed=1000, teeth=teeth), tmp_path)
    check_idle(result, 1000, 1e-4, 200)
    assert rejected_steps(tmp_path) <= 10


@pytest.mark.parametrize(("tol", "first"), [("1E-6", 0), ("1E-9", 1)])
def test_controlled_steps(tol: str, first: int, tmp_path: Path) -> None:
    """The first attempt is H long, in which a wheel turns by a radian: more than 1E-9 allows."""
    run(deck(SI, h=0.01, more=f"TOL {tol}"), tmp_path)
    assert rejected_steps(tmp_path) == first


def test_accuracy_compares_no_rounding(tmp_path: Path) -> None:
    """The run was repeated until rounding failed its steps, whose forces were then to be accurate, too."""
    assert "estimated" not in said(deck(SI, solver="ACCURACY NORMAL"), tmp_path)
    assert "estimated error" in (tmp_path / "deck.lst").read_text()
    assert rejected_steps(tmp_path) == 0


def test_planet_on_a_carrier(tmp_path: Path) -> None:
    result = run(PLANET.format(more=" I 9 INERTIA N 4 M 1 J 1E-3\n"), tmp_path)
    assert result["2/ANGLE"][-1] == pytest.approx(SPEED * 0.1, rel=1e-12)


def test_load_is_balanced_to_precision(tmp_path: Path) -> None:
    """A load of a millionth of what the machine's inertia could make is resolved as before: the residual of
    every step ends below PREC of it."""
    text = deck(SI).replace(".SAM TYPE", " I 9 TORQUE N 2 AXIS 0 0 1 V 1E-6\n.SAM TYPE")
    result = run(text, tmp_path)
    np.testing.assert_allclose(result["3/DRIVE_TORQUE"], 2e-6, rtol=1e-4)
