# SPDX-License-Identifier: BSD-3-Clause
"""The same machine in other units of length and mass: starts and steps are the same."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import run

PAIR = """
.NOE
 I 1
 I 2 X {distance!r}
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 Z 30 60 MN {module!r} AXIS 0 0 1 KM 1D8 WIDTH {width!r}
 I 14 INERTIA N 1 J {inertia!r}
 I 15 INERTIA N 2 J {inertia!r}
.INI
 DEP ELEMENT 1 V 30
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF 1D-3 H 1D-4
.FIN
"""


@pytest.mark.parametrize("length", [1, 10, 1e3, 1e6])
def test_a_wheel_follows_the_other_at_the_start(length: float, tmp_path: Path) -> None:
    """Metres, and parts of them. In metres a tooth deformation was easier than a turn of the wheel, which
    stayed behind with its teeth pressed in by eight modules."""
    text = PAIR.format(
        distance=0.09 * length, module=0.002 * length, width=0.02 * length, inertia=1e-3 * length**2
    )
    found = run(text, tmp_path)
    assert found["2/ANGLE"][0] == pytest.approx(-np.radians(15), rel=1e-9)


BESIDE = """
.NOE
 I 1
 I 3 X 2
.MCE
 I 1 PRISMATIC N 0 1 AXIS 0 0 1
 I 4 INERTIA N 1 M (2*{mass!r}) J (0.1*{mass!r})
 I 7 CONTROLLER IN 1 REF 0.3 NF 1 KP (400*{mass!r}) KI (200*{mass!r}) KD (30*{mass!r}) OUT 1 $
   LIMITS (-80*{mass!r}) (80*{mass!r})
 I 8 PRISMATIC N 0 3 AXIS 1 0 0 LAW POLY (500*{mass!r}) 0 (3000*{mass!r})
 I 9 INERTIA N 3 M (0.5*{mass!r}) J (0.1*{mass!r})
.FCT
 I 1 STEP 0 0 0.5 1
.INI VIT NOEUD 3 C 1 V 20
.CLM STRU ACC VAL 0 0 -1
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 1.5 H 0.002 TOL {tolerance}
.FIN
"""


@pytest.mark.parametrize("mass", [1.0, 1e6])
def test_an_oscillator_beside_a_controller(mass: float, tmp_path: Path) -> None:
    """The command, a force, was taken for a fast translation: with a large number of newtons no error of a
    position counted any more, and was a quarter of its range."""
    found = run(BESIDE.format(mass=mass, tolerance="1D-4"), tmp_path)
    exact = run(BESIDE.format(mass=mass, tolerance="1D-9"), tmp_path, "exact")
    off = np.interp(exact.t, found.t, found["node/3/UX"]) - exact["node/3/UX"]
    assert np.abs(off).max() < 1e-3 * np.ptp(exact["node/3/UX"])


LID = """
.NOE
 I 11 X 0 0 0
 I 12 X {size!r} 0 0
 I 13 X {size!r} {size!r} 0
 I 14 X 0 {size!r} 0
 I 15 X 0 0 {size!r}
 I 16 X {size!r} 0 {size!r}
 I 17 X {size!r} {size!r} {size!r}
 I 18 X 0 {size!r} {size!r}
.MAT
 I 1 YT (0.001/{size!r}) NT 0. M 0.
.MCE
 I 1 MEMBRANE N 11 12 16 15 MAT 1 THICK (0.001*{size!r})
 I 2 MEMBRANE N 12 13 17 16 MAT 1 THICK (0.001*{size!r})
 I 3 MEMBRANE N 13 14 18 17 MAT 1 THICK (0.001*{size!r})
 I 4 MEMBRANE N 14 11 15 18 MAT 1 THICK (0.001*{size!r})
 I 5 MEMBRANE N 15 16 17 18 MAT 1 THICK (0.001*{size!r})
 I 6 MEMBRANE N 11 14 13 12 MAT 1 THICK (0.001*{size!r})
 I 9 GAS GROUP "first" P (1D5/{size!r}) AMBIENT (1D5/{size!r})
 I 15 INERTIA N 15 M 100
 I 16 INERTIA N 16 M 100
 I 17 INERTIA N 17 M 100
 I 18 INERTIA N 18 M 100
.SEL
 GROUP 1 NOM "first" MAILLES I 1 J 6 K 1
.CLM
 FIX NOEUD 11 12 13 14 C 1 2 3
 FIX NOEUD 15 16 17 18 C 1 2 4 5 6
.INI
 DEP NOEUD 15 16 17 18 C 3 V (-0.3*{size!r})
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF 0.02 H 0.002
.FIN
"""


@pytest.mark.parametrize("size", [1.0, 1e6])
def test_gas_under_a_lid(size: float, tmp_path: Path) -> None:
    """The height of the gas follows the lid at the start, not the lid the gas."""
    found = run(LID.format(size=size), tmp_path)
    assert found["node/15/UZ"][0] / size == pytest.approx(-0.3, rel=1e-9)
