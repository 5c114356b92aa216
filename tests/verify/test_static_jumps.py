# SPDX-License-Identifier: BSD-3-Clause
"""Load steps of statics at positions where equilibria jump, or where they may go on in two ways."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from runs import run, said
from scipy.optimize import brentq
from test_snapping import ARCH, RISE, load

ROOT = Path(__file__).resolve().parents[2]

GAP = """
.NOE
 I 1 X 0 0 0
.FCT
 I 1 EXPR "{force}"
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 1 0 MIN -0.01 MAX 0.02 KSTOP 1E5
 I 2 FORCE N 1 DIR 1 1 0 V 50 NF 1
.SAM TYPE STATIC
.SUB TF 1 H 0.1 {control}
.FIN
"""


def stop(force: np.ndarray) -> np.ndarray:
    """Position of the slider at one of its stops."""
    return np.where(force > 0, 0.02, -0.01) + force / 1e5


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-5])
def test_a_gap_is_crossed_at_no_load(tmp_path: Path, tolerance: float) -> None:
    done = run(GAP.format(force="T", control=f"TOL {tolerance}"), tmp_path)
    assert done.t == pytest.approx(0.1 * np.arange(11))
    assert done["1/SLIDE"][0] == pytest.approx(0, abs=1e-12)
    assert done["1/SLIDE"][1:] == pytest.approx(stop(50 * done.t[1:]), rel=1e-6)


def test_a_gap_is_crossed_from_stop_to_stop(tmp_path: Path) -> None:
    done = run(GAP.format(force="T-0.55", control="TOL 1E-3"), tmp_path)
    assert done["1/SLIDE"] == pytest.approx(stop(50 * (done.t - 0.55)), rel=1e-6)


TRUSS = """
.NOE
 I 1 X -1 0 0
 I 2 X 0 0.1 0
 I 3 X 1 0 0
.CLM
 FIX NOEUD 1 3 C 1 2 3
 FIX NOEUD 2 C 3
 CHA NOEUD 2 C 2 V -100 NF 1
.FCT
 I 1 EXPR "T"
.MCE
 I 1 BAR N 1 2 EA 1E5
 I 2 BAR N 2 3 EA 1E5
.SAM TYPE STATIC
.SUB TF 1 H 0.05 {control}
.FIN
"""


def test_a_limit_load_is_passed_with_a_warning(tmp_path: Path) -> None:
    controlled = TRUSS.format(control="TOL 1E-3")
    assert ".PATH" in said(controlled, tmp_path)
    done, fixed = run(controlled, tmp_path), run(TRUSS.format(control=""), tmp_path, "fixed")
    assert done.t == pytest.approx(0.05 * np.arange(21))
    for t, height in zip(done.t, done["node/2/UY"], strict=True):  # fixed steps that were cut add instants
        assert height == pytest.approx(fixed["node/2/UY"][np.abs(fixed.t - t).argmin()], abs=2e-4)


@pytest.mark.parametrize("step", ["0.02", "0.003", "0.05 TOL 3E-3", "0.05 TOL 1E-4", "0.05 TOL 1E-6"])
def test_snapping_does_not_depend_on_the_steps(step: str, tmp_path: Path) -> None:
    """Newton's iteration went astray beyond the limit load. Only some steps came upon the other side: 11 of
    24 tolerances, and neither of these fixed steps."""
    text = ARCH.format(load="100*T", step=step)
    assert "snapped" in said(text, tmp_path)
    done = run(text, tmp_path)
    limit = max(load(y) for y in np.linspace(0, RISE, 1001)) / 100
    assert done.t[np.flatnonzero(np.diff(done["node/2/UY"]) < -RISE)] == pytest.approx([limit], abs=0.05)
    end = brentq(lambda y: load(y) - 100, -3 * RISE, -RISE)
    assert done["node/2/UY"][-1] == pytest.approx(end - RISE, rel=1e-9)


def test_a_frame_snaps_to_the_equilibrium_at_the_end_of_its_path(tmp_path: Path) -> None:
    """Lee's frame, under its whole load: .PATH gets there past two limit points."""
    frame = (ROOT / "decks/mechanisms/lee_frame.dat").read_text(encoding="utf-8")
    frame = re.sub(r"^\.CHK\n(?: .*\n)*", "", frame, flags=re.M)
    path = run(frame.replace("V -80", "V -118"), tmp_path)
    assert path["run/LOAD_TIME"][-1] == pytest.approx(1)
    snapped = run(re.sub(r"^\.PATH.*\n", "", frame, flags=re.M), tmp_path, "snapped")
    for channel in ("node/21/UX", "node/21/UY", "node/13/RZ"):
        assert snapped[channel][-1] == pytest.approx(path[channel][-1], rel=1e-8)


HANGING = """
.NOE
 I 1 X 0 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 RIGID N 1 M 1 CG 0 -0.1 0
 I 4 TORQUE N 1 AXIS 0 0 1 V 2 NF 1
.FCT
 I 1 EXPR "T"
.CLM
 STRU ACC VAL 0 -10 0
.SAM TYPE STATIC
.SUB TF 1 H {step}
.FIN
"""


@pytest.mark.parametrize("step", ["0.19", "0.19 TOL 1E-3"])
def test_where_no_equilibrium_is_found_the_path_is_named(step: str, tmp_path: Path) -> None:
    """A pendulum under a moment that its weight cannot resist."""
    run(HANGING.format(step=step), tmp_path, status=2)
    assert ".PATH follows them beyond it" in (tmp_path / "deck.lst").read_text(encoding="utf-8")


BARS = """
.NOE
 I 1 X 0 0 0
 I 2 X {bx:.17g} {by:.17g} 0
 I 3 X {bx:.17g} {by:.17g} 0
 I 4 X {cx:.17g} {by:.17g} 0
 I 5 X {cx:.17g} {by:.17g} 0
 I 6 X 1 0 0
.FCT
 I 1 EXPR "{angle}"
.MCE
 I 1 RIGID N 1 2
 I 2 RIGID N 3 4
 I 3 RIGID N 5 6
 I 11 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 12 HINGE N 2 3 AXIS 0 0 1
 I 13 HINGE N 4 5 AXIS 0 0 1
 I 14 HINGE N 0 6 AXIS 0 0 1
.SAM TYPE STATIC SOLVER {solver}
.SUB TF 1.3 H 0.1
.FIN
"""


@pytest.mark.parametrize("solver", ["MUMPS", "KLU"])
@pytest.mark.parametrize("angle", ["(PI-0.5)*T/0.5", "-0.5*T/0.4", "(PI-0.5)*T/0.3"])
def test_a_parallelogram_in_line_stays_one(tmp_path: Path, solver: str, angle: str) -> None:
    """Steps land exactly on the position with all bars in line, at t = 0.5, 0.4 or 0.3."""
    bx, by = 0.5 * np.cos(0.5), 0.5 * np.sin(0.5)
    done = run(BARS.format(bx=bx, by=by, cx=1 + bx, angle=angle, solver=solver), tmp_path)
    assert done["14/ANGLE"] == pytest.approx(done["11/ANGLE"], abs=1e-9)
