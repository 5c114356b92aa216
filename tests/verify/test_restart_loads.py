# SPDX-License-Identifier: BSD-3-Clause
"""Runs that continue another one under other loads: what the change does to the energies of the run."""

from __future__ import annotations

import numpy as np
import pytest
from runs import run

# an elastic bar: 1000 u² / 2 is its energy
BAR = """.NOE
 I 1 X 0
 I 2 X 1
.MCE
 I 1 SPRING N 1 2 K 1000. C 10
 I 2 PRISMATIC N 0 2 AXIS 1 0 0
 I 3 INERTIA N 2 M 2. J 1 1 1
.CLM
 NOEUD 1 FIX C 1 2 3 4 5 6
 {loads}
.FCT
 I 1 RAMP 0 0 1 1
.SAM TYPE {sam}
.SUB {steps}
.FIN
"""
PULLED = "NOEUD 2 CHA C 1 V 100. NF 1"


@pytest.mark.parametrize(
    ("loads", "slide"),
    [
        (PULLED, 0.1),
        (PULLED.replace("100", "200"), 0.2),
        (PULLED.replace("100", "0"), 0.0),
        (PULLED.replace("100", "-50"), -0.05),
        ("", 0.0),
        (PULLED + "\n STRU ACC VAL 50 0 0", 0.2),
    ],
)
@pytest.mark.parametrize("ranks", [1, 2])
def test_statics_go_from_the_loads_before_to_those_now(tmp_path, loads, slide, ranks):
    """The new loads counted as those of both equilibria of the first step: the work was wrong, and a linear
    spring "snapped to a distant equilibrium"."""
    run(BAR.format(loads=PULLED, sam="STATIC", steps="TF 1 H 0.5"), tmp_path, "before", ranks=ranks)
    text = BAR.format(loads=loads, sam='STATIC RESTART "before"', steps="TF 2 H 0.5")
    now = run(text, tmp_path, "now", ranks=ranks)
    assert "snapped" not in (tmp_path / "now.lst").read_text(encoding="utf-8")
    assert now["2/SLIDE"][-1] == pytest.approx(slide, abs=1e-12)
    of_weight = 100 * (slide - 0.1) if "STRU" in loads else 0
    assert now["run/EXTERNAL_WORK"][-1] == pytest.approx(500 * slide**2 - of_weight, abs=1e-9)
    assert np.max(np.abs(now["run/ENERGY_ERROR"])) < 1e-9


def test_a_weight_that_comes_is_no_error_of_the_energies(tmp_path):
    """The run ended: "the energy balance is off by -110", which was the energy of the weight."""
    run(BAR.format(loads=PULLED, sam="STATIC", steps="TF 1 H 0.5"), tmp_path, "before")
    loads = PULLED + "\n STRU ACC VAL 50 0 0"
    now = run(
        BAR.format(loads=loads, sam='DYNAMIC RESTART "before"', steps="TF 1.1 H 0.001"),
        tmp_path,
        "now",
    )
    assert np.max(np.abs(now["run/ENERGY_ERROR"])) < 0.002
    assert now["2/SLIDE"][-1] > 0.2


def test_a_hinge_turned_back_by_another_moment(tmp_path):
    deck = """.NOE
 I 1 X 1
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 K 20
.CLM
 NOEUD 1 CHA C 6 V {moment} NF 1
.FCT
 I 1 RAMP 0 0 1 1
.SAM TYPE STATIC {restart}
.SUB TF {end} H 0.5
.FIN
"""
    run(deck.format(moment=30, restart="", end=1), tmp_path, "before")
    now = run(deck.format(moment=-10, restart='RESTART "before"', end=1.5), tmp_path, "now")
    assert "snapped" not in (tmp_path / "now.lst").read_text(encoding="utf-8")
    assert now["1/ANGLE"][-2:] == pytest.approx([1.5, -0.5], abs=1e-9)
    assert now["run/EXTERNAL_WORK"][-2:] == pytest.approx([22.5, 2.5], abs=1e-8)


CELLS = """.NOE
{nodes}
.MAI
{cells}
.SEL
 GROUP 1 NOM "all" MAILLES TOUT
 GROUP 2 NOM "upper" FACES
  I 7 3
  I 8 3
.MAT
 I 1 YT 1000. NT 0.3 M 1E-3
.HYP MEMB BIDIM GROUP "all"
.PHP
 GROUP "all" THICK VAL 1.
.AEL
 GROUP "all" MAT 1
.MCE
 I 90 RIGID_LINK N 20 MEMBERS 5 10 15
 I 91 INERTIA N 20 M 1E-3 J 1E-3 1E-3 1E-3
 I 92 HINGE N 20 21 AXIS 0 0 1 K 1
 I 93 INERTIA N 21 M 1E-3 J 1E-3 1E-3 1E-3
.CLM
 NOEUD 1 6 11 FIX C 1 2
{loads}
.FCT
 I 1 RAMP 0 0 1 1
.SAM TYPE {sam} PLANE XY
.SUB {steps}
.SAI NOEUD 20 A 21
.FIN
"""
EDGES = " ARETE I 4 2 PRE V 5. NF 1\n ARETE I 1 1 PRE V 2. NF 1"
UPPER = ' GROUP "upper" PRE V 1.5 NF 1'
FORCE = " NOEUD 10 CHA C 2 V -0.5 NF 1"


def cells(loads: str, sam: str, steps: str) -> str:
    places = [(x, y) for y in (0, 0.5, 1) for x in range(5)]
    nodes = [f" I {i + 1} X {x} Y {y}" for i, (x, y) in enumerate(places)] + [
        " I 20 X 4 Y 0.5",
        " I 21 X 4 Y 0.5",
    ]
    corners = [(n, n + 1, n + 6, n + 5) for n in (1, 2, 3, 4, 6, 7, 8, 9)]
    rows = [f" I {i + 1} N {a} {b} {c} {d}" for i, (a, b, c, d) in enumerate(corners)]
    return CELLS.format(nodes="\n".join(nodes), cells="\n".join(rows), loads=loads, sam=sam, steps=steps)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize(
    ("before", "after"),
    [("", EDGES), (EDGES, ""), (EDGES + "\n" + FORCE, FORCE), (FORCE, UPPER + "\n" + EDGES), (UPPER, EDGES)],
)
def test_pressures_come_and_go(tmp_path, before, after, ranks):
    """The reference said that loads may differ, and a pressure that came or went was refused."""
    run(cells(before, "STATIC", "TF 1 H 0.5"), tmp_path, "before", ranks=ranks)
    fresh = run(cells(after, "STATIC", "TF 2 H 0.5"), tmp_path, "fresh", ranks=ranks)
    rest = run(cells(after, 'STATIC RESTART "before"', "TF 2 H 0.5"), tmp_path, "rest", ranks=ranks)
    for channel in ("node/20/UX", "node/20/UY", "node/21/RZ"):
        assert rest[channel][-1] == pytest.approx(fresh[channel][-1], rel=1e-7, abs=1e-9)
    assert np.max(np.abs(fresh["node/20/UY"])) > 0.01 or not after
