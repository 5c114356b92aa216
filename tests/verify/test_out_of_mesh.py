# SPDX-License-Identifier: BSD-3-Clause
"""Wheels that move apart by more than their teeth overlap: the element goes on, and a warning says so."""

from __future__ import annotations

from pathlib import Path

import pytest
from runs import said

MODULE = 0.004
PAIR = f"""
.NOE
 I 1 X 0 0 0
 I 2 X 0.1 0 0
.MCE
 I 1 GEAR N 1 2 AXIS 0 0 1 Z 20 30 MN {MODULE} ALPHA 20 WIDTH 0.02 KM 1E8 XI 0.1 {{options}}
 I 2 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 2
 I 5 INERTIA N 1 M 1 J 0.001
 I 6 INERTIA N 2 M 1 J 0.001
.CLM
 FIX NOEUD 2 C 3 4 5
 DEP NOEUD 2 C 1 V {{apart}} NF 1
 DEP NOEUD 2 C 2 V 0
.FCT
 I 1 EXPR "sin(3*T)"
 I 2 EXPR "10*T"
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.002
.FIN 1
"""
RACK = f"""
.NOE
 I 1 X 0 0 0
 I 2 X 0.04 0 0
.MCE
 I 1 RACK N 1 2 AXIS 0 0 1 DIR 0 1 0 Z 20 MN {MODULE} ALPHA 20 KM 1E8
 I 2 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 2
 I 5 INERTIA N 1 M 1 J 0.001
 I 6 INERTIA N 2 M 1 J 0.001
.CLM
 FIX NOEUD 2 C 3 4 5 6
 DEP NOEUD 2 C 1 V {{apart}} NF 1
.FCT
 I 1 EXPR "sin(3*T)"
 I 2 EXPR "1"
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.002
.FIN 1
"""


@pytest.mark.parametrize("options", ["", "RUNNING", "JEU 1E-4", "FRICTION CONST 0.1 SLIDING PROFILE"])
def test_pair(tmp_path: Path, options: str) -> None:
    """Teeth overlap by both addenda, two modules."""
    assert "apart" not in said(PAIR.format(options=options, apart=1.9 * MODULE), tmp_path)
    text = said(PAIR.format(options=options, apart=2.1 * MODULE), tmp_path)
    assert f"GEAR 1: the wheels moved apart by {2.1 * MODULE:.3g}, and their teeth overlap by only" in text
    assert "out of mesh" in (tmp_path / "deck.lst").read_text()


def test_tips_as_cut(tmp_path: Path) -> None:
    """Tips cut down by a fifth of a module each."""
    short = "ADDENDUM 0.8"
    assert "apart" not in said(PAIR.format(options=short, apart=1.5 * MODULE), tmp_path)
    assert "overlap by only 0.0064" in said(PAIR.format(options=short, apart=1.7 * MODULE), tmp_path)


def test_rack(tmp_path: Path) -> None:
    assert "apart" not in said(RACK.format(apart=1.9 * MODULE), tmp_path)
    assert "overlap by only 0.008" in said(RACK.format(apart=2.1 * MODULE), tmp_path)
