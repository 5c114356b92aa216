# SPDX-License-Identifier: BSD-3-Clause
"""Elastic teeth at the start: wheels follow drives and initial values; teeth left pressed in are told."""

from __future__ import annotations

from pathlib import Path

import pytest
from runs import run, said, solve

TOLD = "are pressed in by"


def pair(teeth: str, distance: float, more: str, analysis: str, drive: str = "") -> str:
    return f""".NOE
 I 1 X 0 0 0
 I 2 X {distance} 0 0
.MCE
 I 1 GEAR N 1 2 AXIS 0 0 1 Z {teeth} MN 2 ALPHA 20 KM 1.5D5
 I 2 HINGE N 0 1 AXIS 0 0 1 {drive}
 I 3 HINGE N 0 2 AXIS 0 0 1
{more}
.SAM TYPE {analysis}
.FIN 1
"""


@pytest.mark.parametrize("begin", [0.5, 1.5, 20, -45])
def test_statics_begin_far_away(begin: float, tmp_path: Path) -> None:
    """The pinion turns 4.3 times as far as the drive, and winds up a spring: −K ψ_B = k_m u r_B, and
    u = r_A ψ_A + r_B ψ_B. It was refused: "turned by 369 degrees in one step"."""
    K, stiffness, a, b = 1e3, 1.5e5, 86.0, 20.0
    more = f' I 4 TSPRING N 0 2 AXIS 0 0 1 K {K}\n.FCT\n I 1 EXPR "{begin}+T"\n.SUB TF 1 H 0.5'
    text = pair("86 20", 106, more, "STATIC", "DRIVE ANGLE NF 1")
    told, found = solve(text, tmp_path)
    for psi_a, psi_b in zip(found["1/PSI_A"], found["1/PSI_B"], strict=True):
        assert psi_b == pytest.approx(-stiffness * b * a * psi_a / (K + stiffness * b * b), rel=1e-9)
    assert found["1/PSI_A"][0] == pytest.approx(begin)
    assert TOLD not in told["said"]


BODIES = " I 4 INERTIA N 1 M 1 J 100\n I 5 INERTIA N 2 M 1 J 100\n.SUB TF 1D-4 H 1D-5\n.INI\n"


@pytest.mark.parametrize("given", [" DEP ELEMENT 2 V 60", " DEP NOEUD 1 C 6 V 60 IMPOSED"])
def test_one_wheel_given(given: str, tmp_path: Path) -> None:
    """The other follows; it stayed, with its teeth pressed in by ten modules."""
    text = pair("20 40", 60, BODIES + given, "DYNAMIC")
    found = run(text, tmp_path)
    assert found["1/PSI_B"][0] == pytest.approx(-found["1/PSI_A"][0] / 2, abs=1e-7)
    assert abs(found["1/U_M"]).max() < 1e-6
    assert TOLD not in said(text, tmp_path)


def test_both_wheels_given(tmp_path: Path) -> None:
    """u = (60 r_A + 10 r_B) degrees."""
    text = said(pair("20 40", 60, BODIES + " DEP ELEMENT 2 V 60\n DEP ELEMENT 3 V 10", "DYNAMIC"), tmp_path)
    assert text.count(TOLD) == 1
    assert "the teeth of GEAR 1 are pressed in by 27.93 [length] at the start, 14 times their module" in text


def test_small_deflections_are_kept(tmp_path: Path) -> None:
    """A free vibration of the teeth begins with the deflection that is given."""
    text = pair("20 40", 60, BODIES + " DEP ELEMENT 2 V 0.1", "DYNAMIC")
    assert run(text, tmp_path)["1/U_M"][0] == pytest.approx(20 * 0.1 * 3.141592653589793 / 180, rel=1e-6)
    assert TOLD not in said(text, tmp_path)
