# SPDX-License-Identifier: BSD-3-Clause
"""Structures that nothing holds, in statics: their matrices are singular up to rounding only, which factors
do not notice. They are refused with the motion by name; no displacement of 1e12 is given as a result."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import engrane, run

BEAM = """
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
 I 3 X 2 0 0
.BPR
 I 1 CIRCLE 0.05
.MAT
 I 1 YT 2.1D11 NT 0.3 M 7850.
.MCE
 I 1 BEAM N 1 2 3 BPR 1 MAT 1
.CLM
 {support}
 CHA NOEUD 3 C {component} V -100 {function}
.FCT
 I 1 EXPR "{formula}"
.SAM TYPE STATIC
{command}
.SUB TF 1 H {step}
.FIN 1
"""
CLAMPED, HINGED, SPINS = (
    "FIX NOEUD 1 C 1 2 3 4 5 6",
    "FIX NOEUD 1 C 1 2 3 4 5",
    "FIX NOEUD 1 C 1 2 3\n FIX NOEUD 3 C 2 3",
)


def beam(
    support: str,
    component: int = 2,
    function: str = "NF 1",
    formula: str = "T",
    command: str = "",
    step: float = 1,
) -> str:
    return BEAM.format(
        support=support, component=component, function=function, formula=formula, command=command, step=step
    )


PLATE = """
.MAI
 I 1 AT 1 0 N 1 2 5 4
 I 2 AT 1 0 N 2 3 6 5
.SEL
 GROUP 1 MAILLE NOM "plate"
 I 1 J 2 K 1
.MAT
 I 1 BEHA "ELASTIC" YT 2.1e5 NT 0.3 M 7.85e-9
.HYP MEMB BIDIM GROUP "plate"
.PHP
 GROUP "plate" THICK VAL 0.5
.AEL
 I 1 J 2 K 1 MAT 1
.CLM
 {support}
 NOEUD 6 CHA C 2 V -10.
 NOEUD 3 CHA C 1 V 5.
RETURN
"""


def plate(support: str) -> str:
    """Two cells of a plane under loads at one end."""
    nodes = "".join(f" I {1 + i + 3 * j} X {2 * i} Y {j} Z 0\n" for j in (0, 1) for i in (0, 1, 2))
    return f".NOE\n{nodes}" + PLATE.format(support=support).lstrip()


def refused(text: str, folder: Path, ranks: int = 1, options: tuple[str, ...] = ()) -> str:
    done = engrane(text, folder, *options, ranks=ranks)
    assert done.returncode == 2, done.stdout + done.stderr
    return done.stderr


@pytest.mark.parametrize("function", ["NF 1", ""])
@pytest.mark.parametrize("step", [1, 0.1, 0.37])
def test_a_beam_on_a_hinge(function: str, step: float, tmp_path: Path) -> None:
    """Loads of iterations that went astray were references for the next, which then "converged" at once: all
    displacements were 0."""
    said = refused(beam(HINGED, function=function, step=step), tmp_path)
    assert "nothing resists a motion of" in said and "(rz)" in said and "Statics needs" in said


@pytest.mark.parametrize("support", ["", "NOEUD 1 FIX C 1 2", "NOEUD 1 FIX C 1\n NOEUD 4 FIX C 1"])
@pytest.mark.parametrize("solver", ["MUMPS", "KLU"])
def test_a_mesh_without_supports(support: str, solver: str, tmp_path: Path) -> None:
    said = refused(plate(support), tmp_path, options=("--card", f".SAM SOLVER {solver}"))
    assert "singular up to rounding: nothing resists a motion of node" in said


def test_a_mesh_without_supports_on_several_ranks(tmp_path: Path) -> None:
    assert "nothing resists a motion of node" in refused(plate("NOEUD 1 FIX C 1 2"), tmp_path, ranks=3)


def halves(corner: int, middle: int, support: str = "NOEUD 1 4 FIX C 1 2", link: str = "") -> str:
    """Two cells side by side. Nodes 12 and 13 are in the places of 2 and 3; the right cell is on `corner` and
    `middle`."""
    return f"""
.NOE
 I 1 X 0 Y 0
 I 2 X 1 Y 0
 I 3 X 1 Y 1
 I 4 X 0 Y 1
 I 5 X 2 Y 0
 I 6 X 2 Y 1
 I 12 X 1 Y 0
 I 13 X 1 Y 1
 I 20 X 1 Y 0.5
.MAI
 I 1 N 1 2 3 4
 I 2 N {corner} 5 6 {middle}
.SEL
 GROUP 1 NOM "plate" MAILLES TOUT
.MAT
 I 1 YT 2.1E11 NT 0.3 M 7850.
.HYP DEFO PLAN
.AEL
 GROUP "plate" MAT 1
.CLM
 {support}
 NOEUD 5 6 CHA C 1 V 500.
{link}
.FIN 1
"""


LINK = ".MCE\n I 50 RIGID_LINK N 20 MEMBERS 2 3 12 13"


@pytest.mark.parametrize(
    ("corner", "middle", "pair", "more"),
    [
        (
            12,
            13,
            "Nodes 2 and 12 are in one place",
            "(the first of 2 such pairs)",
        ),  # nothing joins the halves
        (
            2,
            13,
            "Nodes 3 and 13 are in one place",
            "takes them apart: cells",
        ),  # the right one turns about node 2
    ],
)
def test_nodes_in_one_place_that_are_not_shared(
    corner: int, middle: int, pair: str, more: str, tmp_path: Path
) -> None:
    """Only a support was asked for, of a mesh that has enough of them."""
    said = refused(halves(corner, middle), tmp_path)
    assert pair in said and more in said and "engrane import --merge 1e-6" in said


@pytest.mark.parametrize(("corner", "middle", "link"), [(2, 3, ""), (12, 13, LINK)])
def test_nodes_in_one_place_that_move_together(corner: int, middle: int, link: str, tmp_path: Path) -> None:
    """What is missing is a support, whether or not there are nodes in one place."""
    said = refused(halves(corner, middle, "NOEUD 1 FIX C 1", link), tmp_path)
    assert "nothing resists a motion of" in said and "in one place" not in said


def test_a_mesh_with_supports(tmp_path: Path) -> None:
    run(plate("NOEUD 1 FIX C 1 2\n NOEUD 4 FIX C 1"), tmp_path)


def test_the_stiffest_and_softest_that_are_solved(tmp_path: Path) -> None:
    """A wire of 10 m and 1 mm in 100 pieces bends by its closed form: its softest motion has 1e-12 of the
    stiffness of the others."""
    text = beam(CLAMPED, function="").replace("CIRCLE 0.05", "CIRCLE 0.001").replace("V -100", "V -1D-7")
    text = text.replace("N 1 2 3", "N 1 A 201").replace("NOEUD 3", "NOEUD 201")
    nodes = "".join(f" I {i + 1} X {i * 0.05} 0 0\n" for i in range(201))
    deflection = -1e-7 * 1000 / (3 * 2.1e11 * np.pi / 64 * 0.001**4)
    check = f".CHK\n NODE 201 UY T 1 V {deflection!r} RTOL 1E-4\n.FIN"
    run(".NOE\n" + nodes + text[text.index(".BPR") :].replace(".FIN", check), tmp_path)


def test_buckling_of_what_spins_freely(tmp_path: Path) -> None:
    """It was "no buckling loads" with status 0."""
    said = refused(beam(SPINS, component=1, command=".BUCKLING MODES 1"), tmp_path)
    assert "no buckling loads" in said and "nothing resists a motion of" in said and "(rx)" in said


def test_a_path_does_not_pass_loads_that_stand_still(tmp_path: Path) -> None:
    """Behind the top of the function the same loads stand at another time: the path jumped there and ended,
    with status 0."""
    said = refused(beam(CLAMPED, formula="sin(2*PI*T)", command=".PATH", step=0.1), tmp_path)
    assert "the loads hardly change with time at load time" in said


@pytest.mark.parametrize("formula", ["T", "min(T,1)", "min(2*T,1)"])
def test_a_path_ends_at_its_end(formula: str, tmp_path: Path) -> None:
    """Also where loads cease to grow: there it goes on with the load time, in steps of H and no shorter."""
    done = run(beam(CLAMPED, formula=formula, command=".PATH", step=0.1), tmp_path)
    assert done["run/LOAD_TIME"][-1] == pytest.approx(1, abs=1e-12)
    assert done["run/GROUND_FORCE_Y"][-1] == pytest.approx(100, rel=1e-5)
    assert len(done.t) <= 13


@pytest.mark.parametrize("length", ["", "LENGTH 2.000001", "LENGTH 2.5"])
def test_a_string_that_loads_tighten(length: str, tmp_path: Path) -> None:
    """A weight that grows from zero on a string: where it is as long as its nodes are apart, nothing holds it
    sideways at first, and the run ended."""
    text = f""".NOE
 I 1
 I 2 X 0 0 -2
.MCE
 I 1 CABLE N 1 2 EA 1D5 {length}
.CLM
 FIX NOEUD 1 C 1 2 3
 FIX NOEUD 2 C 2
 CHA NOEUD 2 C 3 V -100 NF 1
.FCT
 I 1 RAMP 0 0 1 1
.SAM TYPE STATIC
.SUB TF 1 H 0.1
.FIN
"""
    found = run(text, tmp_path)
    natural = float(length.split()[-1]) if length else 2.0
    assert found["node/2/UZ"][-1] == pytest.approx(2 - natural * (1 + 100 / 1e5), rel=1e-6)
