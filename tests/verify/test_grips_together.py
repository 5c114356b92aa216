# SPDX-License-Identifier: BSD-3-Clause
"""STICK in several places at once, or where other constraints hold the same motion: what holds, and what
gives way first."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import run

PROPPED = """
.NOE
 I 1 X 0.2
 I 2 X 0.5
.MCE
 I 1 {contact} AXIS 0 0 1 AT 0.2 0 0 {shape} FRICTION CONST 0.1 STICK
 I 2 HINGE N 1 2 AXIS 0 0 1 AT 0.35 0 0
 I 3 WELD N 0 2
 I 4 INERTIA N 1 M {m} J (0.01*{m})
 I 5 INERTIA N 2 M {m} J (0.01*{m})
.CLM STRU ACC VAL 0.5 -3 -9.81
.SAM TYPE DYNAMIC {scheme}
.SUB TF 0.6 H 0.001 TOL 1E-3
.FIN 1
"""


@pytest.mark.parametrize("scheme", ["SCHEME RADAU", "RHO 0.8"])
@pytest.mark.parametrize(
    ("contact", "shape"), [("POINT_CYLINDER N 0 1", "ON 0.2 0.01 0"), ("POINT_LINE N 0 1", "")]
)
def test_rounding_is_no_sliding(contact: str, shape: str, scheme: str, tmp_path: Path) -> None:
    """A frame that cannot move leans on a contact whose friction is at its limit. Speeds and accelerations
    are rounding and decide nothing: forces are those at the start, and proportional to the masses."""
    forces = []
    for m in (1, 3, 5, 7):
        result = run(PROPPED.format(contact=contact, shape=shape, m=m, scheme=scheme), tmp_path, f"m{m}")
        assert result["run/EVENTS"].max() == 0
        pressing, friction, x = (
            result[f"1/{c}"] / m for c in ("PRESSING_FORCE", "FRICTION_FORCE", "FORCE_X")
        )
        assert np.ptp(x) < 1e-9
        assert friction == pytest.approx(0.1 * pressing, rel=1e-8)
        # with the hinge, it holds the body
        assert x - result["2/FORCE_X"] / m == pytest.approx(-0.5, abs=1e-9)
        forces.append([pressing[-1], x[-1]])
    assert forces == pytest.approx(forces[0] * np.ones((len(forces), 1)), abs=1e-9)


STACK = """
.NOE
 I 1
 I 2
.FCT
 I 1 RAMP 0 0 1E-3 6
 I 2 EXPR "6"
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 FRICTION CONST 0.15 0.25 STICK
 I 2 PRISMATIC N 1 2 AXIS 1 0 0 FRICTION CONST 0.4 STICK
 I 11 INERTIA N 1 M 1 J 1
 I 12 INERTIA N 2 M 1 J 1
 I 13 FORCE N 2 DIR 1 0 0 V 1 NF {load}
.CLM STRU ACC VAL 0 0 -10
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 1 H 0.01 TOL 1E-6
.FIN 1
"""


@pytest.mark.parametrize(("load", "end"), [(1, (1 / 3 + 999) * 1e-6 * 999 + 1 / 27e6), (2, 1.0)])
def test_what_carries_most_gives_way_first(load: int, end: float, tmp_path: Path) -> None:
    """A force of 6 pulls the upper one of two blocks, whose contact carries 4. The lower contact, which
    carries 3 once it slides, holds up to 5: the lower block stays, whether the force grows or not."""
    result = run(STACK.format(load=load), tmp_path)
    assert np.abs(result["1/SLIDE"]).max() < 1e-15
    assert np.abs(result["1/FRICTION_FORCE"]).max() <= 4 * (1 + 1e-9)
    assert result["2/SLIDE"][-1] == pytest.approx(end, rel=1e-6)


SLEDGE = """
.NOE
 I 1
 I 2
 I 3
.FCT
 I 1 EXPR "4*T**2"
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 DRIVE SLIDE NF 1
 I 2 PRISMATIC N 1 2 AXIS 1 0 0 FRICTION CONST 0.3 STICK
 I 3 PRISMATIC N 2 3 AXIS 1 0 0 FRICTION CONST 0.25 0.5 STICK
 I 11 INERTIA N 1 M 1 J 1
 I 12 INERTIA N 2 M 1 J 1
 I 13 INERTIA N 3 M 1 J 1
.CLM STRU ACC VAL 0 0 -10
.INI
 VIT ELEMENT 2 V 4
 VIT ELEMENT 3 V 0
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.01
.FIN 1
"""


def test_what_rests_on_a_sledge_stays(tmp_path: Path) -> None:
    """A block rests on a sledge that slides on a base until the base is as fast, at 4/11, and is slower from
    then on. The force between block and sledge is 3 throughout, and its limit 5."""
    result = run(SLEDGE, tmp_path)
    assert np.abs(result["3/SLIDE"]).max() < 1e-15
    after = result.t > 4 / 11
    fast = 4 + np.where(after, -3 * 4 / 11 + 3 * (result.t - 4 / 11), -3 * result.t)
    assert result["node/2/VX"] == pytest.approx(fast, abs=1e-6)
