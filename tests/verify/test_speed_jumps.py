# SPDX-License-Identifier: BSD-3-Clause
"""Drives whose speed jumps, as that of an angle given by a TABLE does at its corners."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import Run, run, said, solve

CRANK, RADIUS, MASS, INERTIA, ARM = 3.0, 0.4, 2.0, 0.05, 0.15
CORNER, SPEED = 0.253, 1 / 0.747


def deck(analysis: str, stepping: str) -> str:
    """A crank and, in line with it, a free link: the drive starts both within an instant."""
    return f""".NOE
 I 1 X 0 0 0
 I 2 X {RADIUS + ARM!r} 0 0
.MCE
 I 1 INERTIA N 1 M 1 J {CRANK!r}
 I 2 INERTIA N 2 M {MASS!r} J {INERTIA!r}
 I 3 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 4 HINGE N 1 2 AXIS 0 0 1 AT {RADIUS!r} 0 0
.FCT
 I 1 TABLE 0 0 {CORNER} 0 1 1
.SAM TYPE DYNAMIC {analysis}
.SUB TF 1 H 0.01 {stepping}
.FIN 1
"""


@pytest.mark.parametrize(
    ("analysis", "stepping"),
    [("", "TOL 1E-6"), ("SCHEME RADAU", "TOL 1E-6"), ("ACCURACY NORMAL", ""), ("ACCURACY FINE", "")],
)
def test_impulse(analysis: str, stepping: str, tmp_path: Path) -> None:
    """What the link's hinge feels of it is m_e = 1/(1/m + a²/J): the work of the drive is half the sum of
    (J_c + m_e r²) ω². The energies close, and the run ends with the speed it had."""
    found = run(deck(analysis, stepping), tmp_path)
    work = 0.5 * (CRANK + RADIUS**2 / (1 / MASS + ARM**2 / INERTIA)) * SPEED**2
    times = found.t
    after = int((times <= CORNER).sum())
    assert found["run/KINETIC_ENERGY"][after - 1] == 0
    assert found["run/EXTERNAL_WORK"][after] == pytest.approx(work, rel=3e-3)  # the sample is a little later
    assert abs(found["run/ENERGY_ERROR"]).max() < 1e-4 * work
    assert found["element/3/SPEED"][-1] == pytest.approx(SPEED, rel=1e-6)


def test_said_of_fixed_steps(tmp_path: Path) -> None:
    """Such steps do not end at the corner, and the torque is what H makes it: one warning for the drive."""
    text = said(deck("", ""), tmp_path)
    assert text.count("warning") == 1
    assert f"the speed of the drive of HINGE 3 jumps by {SPEED:.4g} [rad/time] at t = {CORNER}" in text
    assert "warning" not in said(deck("", "TOL 1E-4"), tmp_path)


@pytest.mark.parametrize(
    ("analysis", "stepping"), [("", "TOL 1E-6"), ("SCHEME RADAU", "TOL 1E-6"), ("ACCURACY NORMAL", "")]
)
def test_restart_at_the_corner(analysis: str, stepping: str, tmp_path: Path) -> None:
    """A run that ends where the drive starts has not seen its impulse; the one that goes on does."""
    whole = run(deck(analysis, stepping), tmp_path)
    run(deck(analysis, stepping).replace("TF 1 ", f"TF {CORNER} "), tmp_path, "rest")
    found = run(deck(analysis, stepping), tmp_path, "rest_and_go", options=("--restart", "rest"))
    assert found["run/EXTERNAL_WORK"][-1] == pytest.approx(whole["run/EXTERNAL_WORK"][-1], rel=1e-6)
    assert found["element/3/SPEED"][-1] == pytest.approx(SPEED, rel=1e-6)


WHEEL = """.NOE
 I 1 X 0 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE {drive} NF 1
 I 2 INERTIA N 1 M 1 J {inertia}
.FCT
 I 1 {function}
.SAM TYPE {analysis}
.SUB TF {end!r} H {h} {stepping}
.FIN 1
"""


def wheel(
    function: str,
    end: float,
    analysis: str = "DYNAMIC",
    stepping: str = "",
    drive: str = "ANGLE",
    inertia: float = 0.01,
    h: float = 0.01,
) -> str:
    """A deck of a wheel whose drive follows the function."""
    return WHEEL.format(
        function=function,
        end=end,
        analysis=analysis,
        stepping=stepping,
        drive=drive,
        inertia=inertia,
        h=h,
    )


def turned(angle: str, end: float, **words: str) -> str:
    return wheel(f'EXPR "{angle}"', end, inertia=0.02, h=1e-3, **words)


def restarted(folder: Path, before: dict, after: dict, stepping: str = "") -> tuple[dict, Run]:
    """A wheel whose drive follows another function from t = 0.01 on."""
    run(turned(end=0.01, **{"stepping": stepping, **before}), folder, "first")
    then = turned(end=0.02, **{"stepping": stepping, **after})
    return solve(then, folder, "then", "--restart", str(folder / "first"))


AT_REST, AWAY = {"analysis": "STATIC", "angle": "0"}, "5*(T-0.01)"


@pytest.mark.parametrize("scheme", ["CHUNG", "RADAU"])
def test_motion_that_begins_at_once_behind_an_equilibrium(scheme: str, tmp_path: Path) -> None:
    """The drive's function has no corner: it is the restart point that is at rest."""
    after = {"angle": AWAY, "analysis": f"DYNAMIC SCHEME {scheme}", "stepping": "TOL 1E-5"}
    told, found = restarted(tmp_path, AT_REST, after)
    assert told["said"] == ""
    moving = found.t > 0.01
    assert found["element/1/SPEED"][moving] == pytest.approx(5, rel=1e-9)
    assert found["run/EXTERNAL_WORK"][moving] == pytest.approx(0.5 * 0.02 * 5**2, rel=1e-9)
    assert abs(found["run/ENERGY_ERROR"]).max() < 1e-9


def test_said_of_fixed_steps_behind_an_equilibrium(tmp_path: Path) -> None:
    told, _ = restarted(tmp_path, AT_REST, {"angle": AWAY})
    text = "the speed of the drive of HINGE 1 jumps by 5 [rad/time] at t = 0.01"
    assert told["said"].count("jumps by") == 1 and text in told["said"]
    assert [text in one["message"] for one in told["diagnostics"]] == [True]
    assert text in (tmp_path / "then.lst").read_text(encoding="utf-8")


@pytest.mark.parametrize("stepping", ["", "TOL 1E-5"])
def test_speeds_of_the_motion_before_count(stepping: str, tmp_path: Path) -> None:
    """Another formula of the same motion is no jump, although velocities between fixed steps are not quite
    what the drive imposes; one that begins where the motion is, but stands still there, is."""
    before = {"angle": "sin(30*T)"}
    told, found = restarted(tmp_path, before, {"angle": "3*sin(10*T)-4*sin(10*T)**3"}, stepping)
    assert told["said"] == ""
    whole = run(turned("sin(30*T)", 0.02, stepping=stepping), tmp_path)
    assert found["element/1/SPEED"][-1] == pytest.approx(whole["element/1/SPEED"][-1], rel=1e-4)
    told, found = restarted(tmp_path, before, {"angle": "sin(0.3)"}, stepping)
    assert ("jumps by -28.66" in told["said"]) == (not stepping)
    if stepping:
        assert abs(found["element/1/SPEED"][-1]) < 1e-9


def test_speeds_that_differ_by_rounding(tmp_path: Path) -> None:
    """Both have come to rest: a polynomial to within its rounding."""
    end = "10*(T/0.01)**3-15*(T/0.01)**4+6*(T/0.01)**5"
    for before, after in (("1", end), (end, "1")):
        told, _ = restarted(tmp_path, {"angle": before}, {"angle": after + "+0*T"})
        assert told["said"] == ""


@pytest.mark.parametrize(
    ("analysis", "stepping"), [("", "TOL 1E-5"), ("SCHEME RADAU", "TOL 1E-5"), ("ACCURACY NORMAL", "")]
)
def test_corners_of_later_periods(analysis: str, stepping: str, tmp_path: Path) -> None:
    """Rounding put 0.2 + 0.8 before itself: the corner was none, and no step was short enough for it."""
    table = "TABLE 0 0 0.2 0.5 0.4 0 PERIOD 0.8"
    found = run(wheel(table, 3.3, f"DYNAMIC {analysis}", stepping), tmp_path)
    place = found.t % 0.8
    speed = np.where(place < 0.2, 2.5, np.where(place < 0.4, -2.5, 0))
    beside = np.min(np.abs(np.subtract.outer(place, [0, 0.2, 0.4, 0.8])), axis=1) > 1e-6
    assert found["element/1/SPEED"][beside] == pytest.approx(speed[beside], abs=1e-6)
    assert found["node/1/EZ"][beside] == pytest.approx(0, abs=1e-6)


def test_a_corner_of_a_later_period_where_the_run_ends(tmp_path: Path) -> None:
    """It lies in the last place before TF: the speed at the end was that of what would follow."""
    text = wheel("TABLE 0.1 0 0.45 1 0.8 0 PERIOD 0.7", 5, stepping="TOL 1E-4")
    assert run(text, tmp_path)["element/1/SPEED"][-1] == pytest.approx(-1 / 0.35, rel=1e-9)


@pytest.mark.parametrize("stepping", ["", "TOL 1E-5"])
def test_radau_goes_on_from_fixed_steps_behind_a_jump(stepping: str, tmp_path: Path) -> None:
    """Their speeds swing about that of the drive long after. Taken as they were, no step was short enough."""
    table = "TABLE 0 0 0.2 0.5 0.37 0.1 0.55 0.9 0.8 0"
    first = run(wheel(table, 0.5), tmp_path, "first")
    assert abs(first["element/1/SPEED"][-1] - 0.8 / 0.18) > 0.01
    text = wheel(table, 0.54, "DYNAMIC SCHEME RADAU", stepping)
    found = run(text, tmp_path, "then", options=("--restart", "first"))
    behind = found.t > 0.5
    assert found["element/1/SPEED"][behind] == pytest.approx(0.8 / 0.18, rel=1e-9)
    assert found["node/1/EZ"][behind] == pytest.approx(0, abs=1e-6)


def test_work_of_a_drive_to_a_corner(tmp_path: Path) -> None:
    """A drive accelerates a wheel of inertia 1 to 10 rad/s within five steps of RADAU: its power,
    400 t, ends at the corner, where the wheel has an energy of 50."""
    text = wheel("TABLE 0 0 0.5 10 10 10", 1, "DYNAMIC SCHEME RADAU", drive="SPEED", inertia=1, h=0.1)
    whole = run(text, tmp_path)
    assert whole["run/external_work"][-1] == pytest.approx(50, rel=1e-9)
    assert abs(whole["run/energy_error"]).max() < 1e-9 * 50


RELATION = """.NOE
 I 1 X 1 0 0
 I 2 X 2 0 0
.FCT
 I 1 TABLE 0 0 .2 0 .201 .01 .5 .01
.MCE
 I 11 INERTIA N 1 M 1 J 1
 I 12 INERTIA N 2 M 2 J 1
 I 13 SPRING N 1 2 K 1000 C 2
 I 1 PRISMATIC N 0 2 AXIS 1 0 0
{imposed}
.SAM TYPE DYNAMIC {analysis}
.SUB TF .4 H .002 {stepping}
.FIN 1
"""
BY_RELATION = " I 2 PRISMATIC N 0 1 AXIS 1 0 0\n.LIA\n I 50 NOEUD 1 C 1 A 1. V 1 NF 1"
BY_SUPPORT = ".CLM\n FIX NOEUD 1 C 2 3 4 5 6\n DEP NOEUD 1 C 1 V 1 NF 1"


@pytest.mark.parametrize(("analysis", "stepping"), [("SCHEME RADAU", "TOL 1E-7"), ("ACCURACY NORMAL", "")])
def test_a_relation_imposes_the_motion_of_a_support(analysis: str, stepping: str, tmp_path: Path) -> None:
    """Its impulses were forces over a step: sound runs were ended for their energies."""
    by_relation, by_support = (
        run(RELATION.format(imposed=i, analysis=analysis, stepping=stepping), tmp_path, name)
        for name, i in (("relation", BY_RELATION), ("support", BY_SUPPORT))
    )
    least = 1e-6 if stepping else 1e-3
    for channel in ("node/2/UX", "run/EXTERNAL_WORK", "run/KINETIC_ENERGY"):
        size = np.abs(by_support[channel]).max()
        np.testing.assert_allclose(by_relation[channel], by_support[channel], rtol=0, atol=least * size)
    assert (
        np.abs(by_relation["run/ENERGY_ERROR"]).max()
        < least * np.abs(by_relation["run/KINETIC_ENERGY"]).max()
    )
