# SPDX-License-Identifier: BSD-3-Clause
"""Linear statics: results are proportional to the loads, whatever their size, and nothing is unstable."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import Run, engrane, run, said

YOUNG, RADIUS, LENGTH = 2.1e11, 0.05, 4.0
EI = YOUNG * np.pi * RADIUS**4 / 4

ROD = """.NOE
 1 0 0 0
 2 4 0 0
 3 4 1 2
.HYP BEAM
.MAI
 I 1 N 1 2
 I 2 N 2 3
.MAT
 I 1 YT 2.1E11 NT .3
.BPR
 I 1 CIRCLE .1
.SEL
 GROUP 1 NOM "a" MAILLES TOUT
.AEL
 GROUP "a" MAT 1 BPR 1
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
"""

PLATE = """.NOE
 I 1 X 0 0
 I 2 X 1 0
 I 3 X 2 0
 I 4 X 0 1
 I 5 X 1 1
 I 6 X 2 1
.MAI
 I 1 N 1 2 5 4
 I 2 N 2 3 6 5
.HYP CONT PLAN
.MAT
 I 1 YT 1000 NT .3
.SEL
 GROUP 1 NOM "a" MAILLES TOUT
.PHP GROUP "a" THICK 2
.AEL
 GROUP "a" MAT 1
"""


def motions(found: Run, node: int) -> np.ndarray:
    return np.array([found[f"node/{node}/{c}"][-1] for c in ("UX", "UY", "UZ", "RX", "RY", "RZ")])


@pytest.mark.parametrize("load", ["C 2 V {}", "C 4 5 6 V {0} {0} {0}", "C 1 6 V {0} {0}"])
def test_rod(load: str, tmp_path: Path) -> None:
    """A cranked rod, turned by loads up to 10 000 radians; a force across it against its closed form."""
    found = []
    for size in (1.0, 1e3, 1e9):
        text = ROD + f" CHA NOEUD 3 {load.format(size)}\n.SAI NOEUD 2 3\n.FIN 1\n"
        assert "unstable" not in said(text, tmp_path)
        found.append(np.array([motions(Run(tmp_path / "deck.h5"), node) for node in (2, 3)]) / size)
    assert np.abs(found[2]).max() * 1e9 > 100
    for one in found[:2]:
        assert one == pytest.approx(found[2], rel=1e-9, abs=1e-9 * np.abs(found[2]).max())
    if "C 2" in load:
        # the crank adds torsion, which bends nothing in this plane, and no arm along x
        assert found[0][0, 5] == pytest.approx(LENGTH**2 / 2 / EI, rel=1e-9)


def test_steps_reach_the_same(tmp_path: Path) -> None:
    """Rotation vectors add up from step to step, and over a restart; steps are chosen or not."""
    loads = " CHA NOEUD 3 C 2 4 6 V 1E7 2E7 3E7 NF 1\n.FCT\n I 1 RAMP 0 0 1 1\n"
    sub = ".SAM TYPE STATIC DISPLACEMENTS SMALL\n.SUB TF 1 H {}\n.SAI NOEUD 3\n.FIN 1\n"
    once = motions(run(ROD + loads + sub.format("1"), tmp_path, "once"), 3)
    assert np.abs(once[3:]).max() > 2 * np.pi
    for name, step in (("four", "0.25"), ("chosen", "0.1 TOL 1E-6")):
        assert motions(run(ROD + loads + sub.format(step), tmp_path, name), 3) == pytest.approx(
            once, rel=1e-9
        )


@pytest.mark.parametrize("link", ["RIGID_LINK", "MEAN_LINK"])
def test_links(link: str, tmp_path: Path) -> None:
    """The moment on a node linked to a plate turns it by more than half a turn."""
    found = []
    for size in (1e-3, 1e5):
        text = PLATE.replace(".MAI", " I 9 X 2 .5\n.MAI", 1)
        text += f".MCE\n I 100 {link} N 9 MEMBERS 3 6\n.CLM\n FIX NOEUD 1 4 C 1 2\n FIX NOEUD 9 C 3 4 5\n"
        text += f" CHA NOEUD 9 C 6 V {size}\n.SAI NOEUD 3 9\n.FIN 1\n"
        assert "unstable" not in said(text, tmp_path)
        found.append(motions(Run(tmp_path / "deck.h5"), 9) / size)
    assert found[1][5] * 1e5 > np.pi
    assert found[0] == pytest.approx(found[1], rel=1e-9, abs=1e-9 * found[1][5])


def test_mean_link_far_from_the_origin(tmp_path: Path) -> None:
    """A group of size 1 at 2^20 is as sound as one at 0; one at 1e15, where rounding has its size, is not."""
    text = """.NOE
 I 1 X {x:.17g} {x:.17g} 0
 I 2 X {y:.17g} {x:.17g} 0
 I 3 X {x:.17g} {y:.17g} 0
 I 4 X {x:.17g} {x:.17g} 1
.MCE
 I 1 SPRING N 0 1 K 1 1 1
 I 2 SPRING N 0 2 K 1 1 1
 I 3 SPRING N 0 3 K 1 1 1
 I 4 MEAN_LINK N 4 MEMBERS 1 2 3
.CLM
 CHA NOEUD 4 C 1 3 V 1E-3 1E-3
.SAM TYPE STATIC
.SUB TF 1 H 1
.SAI NOEUD 4
.FIN 1
"""
    near, far = (motions(run(text.format(x=x, y=x + 1), tmp_path, f"at{x:.0f}"), 4) for x in (0.0, 2.0**20))
    assert far == pytest.approx(near, rel=1e-6, abs=1e-9)
    lost = engrane(text.format(x=1e15, y=1e15 + 1), tmp_path)
    assert lost.returncode == 1
    assert "lie in one place" in lost.stderr or "lie on a line" in lost.stderr


def test_relation_of_plane_cells(tmp_path: Path) -> None:
    """A relation between components x of plane cells needs no z, which those do not have."""
    text = PLATE + ".CLM\n FIX NOEUD 1 C 1 2\n FIX NOEUD 4 C 1\n CHA NOEUD 6 C 1 V 1\n"
    found = run(text + ".LIA\n I 3 NOEUD 3 6 C 1 1 A 1 -1\n.SAI NOEUD 3 6\n.FIN 1\n", tmp_path)
    assert found["node/3/UX"][-1] == pytest.approx(found["node/6/UX"][-1], rel=1e-12)
    # ends that stay straight share the load: a bar in tension, E t h = 2000
    assert found["node/3/UX"][-1] == pytest.approx(2 / 2000, rel=1e-9)


@pytest.mark.parametrize("spring", ["SPRING N 3 0 AT 3 0 0 K 500", "SPRING N 0 3 K 500 0 0"])
def test_spring_on_plane_cells(spring: str, tmp_path: Path) -> None:
    """Springs in the plane of plane cells leave no motion along z: the elongation times K is the force."""
    load = 1e-3  # the line of the spring hardly turns
    loads = f".CLM\n FIX NOEUD 1 4 C 1 2\n CHA NOEUD 3 C 1 V {load}\n.SAI NOEUD 3\n.FIN 1\n"
    alone = run(PLATE + loads, tmp_path, "alone")["node/3/UX"][-1] / load
    both = run(PLATE + f".MCE\n I 10 {spring}\n" + loads, tmp_path)["node/3/UX"][-1] / load
    # the stiffnesses of plate and spring add up
    assert both == pytest.approx(1 / (1 / alone + 500), rel=1e-5)


STRING = """.NOE
 I 1 X 0 0 -3
.MCE
 I 1 CABLE N 0 1 EA 1D5 LENGTH 3
 I 2 INERTIA N 1 M 20
.CLM
 STRU ACC 0 0 -9.81
.SAM {}
.SUB TF 1 H 0.1
.SAI NOEUD 1
.FIN
"""


@pytest.mark.parametrize("sam", ["TYPE STATIC", "TYPE DYNAMIC ACCURACY NORMAL START STATIC"])
def test_string_that_its_load_makes_taut(sam: str, tmp_path: Path) -> None:
    """At its own length it has no tension, and nothing holds the load across it; with the load it does."""
    found = run(STRING.format(sam), tmp_path)
    assert found["node/1/UZ"] == pytest.approx(-3 * 20 * 9.81 / 1e5, rel=1e-6)
    assert found["node/1/UX"] == pytest.approx(0, abs=1e-9)


def test_static_start_without_equilibrium_blames_no_scheme(tmp_path: Path) -> None:
    text = STRING.format("TYPE DYNAMIC ACCURACY NORMAL START STATIC").replace(
        " I 1 CABLE N 0 1 EA 1D5 LENGTH 3\n", ""
    )
    done = engrane(text, tmp_path)
    assert done.returncode == 2
    assert "nothing resists" in done.stderr
    assert "RADAU" not in done.stderr


OFFSET = """ABRE '/g' '{size}'
.NOE
 1 0 0 0
 2 1 0 0
.MAI
 I 1 N 1 2
.MAT
 I 1 YT 2000. NT 0.3 M 2.
.BPR
 I 1 AREA 0.015 INERTIA 2D-4 2D-4 TORSION 2D-4 OFFSET 0. 0.05
.SEL GROUP 1 NOM "b" MAILLES 1
.HYP BEAM GROUP "b"
.AEL
 GROUP "b" MAT 1 BPR 1 AXIS2 0 1 0
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
 STRU ACC VAL 0. /g 0.
.FIN
"""


def test_weight_beside_the_nodes(tmp_path: Path) -> None:
    """It gives a constant moment about the beam, which turned with it: reactions were off by its square."""
    found = [run(OFFSET.format(size=g), tmp_path, f"g{g:.0f}") for g in (1.0, 1e6)]
    weight = 2 * 0.015
    for g, one in zip((1.0, 1e6), found, strict=True):
        assert one["run/GROUND_MOMENT_X"][-1] == pytest.approx(0.05 * weight * g, rel=1e-12)
        assert one["run/LOAD_MOMENT_X"][-1] == pytest.approx(-0.05 * weight * g, rel=1e-12)
        for still in ("node/2/RY", "run/GROUND_MOMENT_Y", "run/LOAD_MOMENT_Y", "1/NORMAL_FORCE_A"):
            assert abs(one[still][-1]) < 1e-9 * g
    assert found[1]["node/2/UY"][-1] == pytest.approx(1e6 * found[0]["node/2/UY"][-1], rel=1e-9)


def test_relation_of_rotations(tmp_path: Path) -> None:
    """It holds between components of rotation vectors, whatever their length: 3 m instead of 0.87 for 0.3."""
    for moment in (1e-3, 1e3):
        text = ROD + f" CHA NOEUD 3 C 4 5 6 V {moment} {2 * moment} {3 * moment}\n"
        text += ".LIA\n I 10 NOEUD 3 2 C 6 6 A 1. -1.5\n.SAI NOEUD 2 3\n.FIN 1\n"
        found = run(text, tmp_path, f"m{moment}")
        near, far = (motions(found, node) / moment for node in (2, 3))
        assert far[5] == pytest.approx(1.5 * near[5], rel=1e-9)
        if moment < 1:
            first = far
        else:
            assert far == pytest.approx(first, rel=1e-6, abs=1e-8 * np.abs(first).max())
