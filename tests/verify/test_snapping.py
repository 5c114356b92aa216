# SPDX-License-Identifier: BSD-3-Clause
"""Load steps of statics that end at a distant equilibrium. Two springs make a shallow arch; a load on its top
pushes it through. Above its limit load only the position on the other side is an equilibrium, and a step that
is long enough finds it. The run ends with status 0, and a warning tells the energy that went astray."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from runs import run, said
from scipy.optimize import brentq

STIFFNESS, HALF, RISE = 1e5, 1.0, 0.1
LENGTH = np.hypot(HALF, RISE)
ARCH = f"""
.NOE
 I 1 X 0 0 0
 I 2 X {HALF} {RISE} 0
 I 3 X {2 * HALF} 0 0
.MCE
 I 1 SPRING N 1 2 K {STIFFNESS}
 I 2 SPRING N 2 3 K {STIFFNESS}
.CLM
 FIX NOEUD 1 C 1 2 3
 FIX NOEUD 3 C 1 2 3
 FIX NOEUD 2 C 1 3
 CHA NOEUD 2 C 2 V -1 NF 1
.FCT
 I 1 EXPR "{{load}}"
.SAM TYPE STATIC
.SUB TF 1 H {{step}}
.FIN 1
"""


def energy(y: float) -> float:
    """Of both springs, with the top at height y."""
    return STIFFNESS * (np.hypot(HALF, y) - LENGTH) ** 2


def load(y: float) -> float:
    """With which the top is in equilibrium at height y, downwards."""
    return -2 * STIFFNESS * (1 - LENGTH / np.hypot(HALF, y)) * y


@pytest.mark.parametrize("step", [0.13, 0.19, 0.25])
def test_a_step_through_the_limit_load(tmp_path: Path, step: float) -> None:
    text = said(ARCH.format(load="100*T", step=step), tmp_path)
    found = re.search(r"between t = (\S+) and (\S+) the structure snapped.*?: (\S+) ", text)
    assert found, text
    before, after, lost = map(float, found.groups())
    limit = max(load(y) for y in np.linspace(0, RISE, 1001))
    assert 100 * before < limit < 100 * after
    # the load of the first equilibrium, moved to the second, does so much more work than the springs take
    start = brentq(lambda y: load(y) - 100 * before, RISE / np.sqrt(3), RISE)
    end = brentq(lambda y: load(y) - 100 * after, -3 * RISE, -RISE)
    assert lost == pytest.approx(100 * before * (start - end) - energy(end) + energy(start), rel=1e-3)
    assert "snapped" in (tmp_path / "deck.lst").read_text()


@pytest.mark.parametrize(
    ("formula", "step"),
    [("30*T", 0.25), ("30*T", 1.0), ("30*sin(5*T)", 0.1), ("-1e4*T", 0.25), ("-1e4*sin(7*T)", 0.2)],
)
def test_long_steps_on_one_path(tmp_path: Path, formula: str, step: float) -> None:
    """Below the limit load, and where springs are pulled to half their length more, nothing snaps."""
    assert not said(ARCH.format(load=formula, step=step), tmp_path)


def test_the_path_is_not_a_jump(tmp_path: Path) -> None:
    """Equilibria of .PATH lead through the same arch, and lose nothing."""
    text = ARCH.format(load="100*T", step=0.05).replace(".SUB", ".PATH\n.SUB")
    done = run(text, tmp_path)
    assert abs(done["run/ENERGY_ERROR"][-1]) < 0.05 * done["run/POTENTIAL_ENERGY"].max()
    assert "snapped" not in (tmp_path / "deck.lst").read_text()
