# SPDX-License-Identifier: BSD-3-Clause
"""Shafts, and beams whose sections change, against closed forms and equal decks of other cards."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from beam_problems import orders
from runs import run
from scipy.integrate import quad

YOUNG, SHEAR = 2.1e11, 2.1e11 / 2.6
MATERIAL = ".MAT\n I 1 YT 2.1D11 NT 0.3 M 7800."
STATICS = ".FCT\n I 1 RAMP 0 0 1 1\n.SAM TYPE STATIC\n.SUB TF 1 H 1"

STEPPED = """.NOE
 I 1 X 0 0 0
 I 3 X 0.3 0 0
 I 9 X 0.7 0 0
"""


def test_written_out(tmp_path: Path) -> None:
    """A shaft is what its BEAM, INERTIA and BEARING are, digit by digit, in motion too."""
    rest = f"""{MATERIAL}
.CLM
 CHA NOEUD 3 C 2 V 1000 NF 1
 CHA NOEUD 9 C 4 V 10 NF 1
.FCT
 I 1 STEP 0 0 2D-3 1
.SAM TYPE DYNAMIC
.SUB TF 5D-3 H 1D-4
.FIN 1
"""
    short = run(
        f"""{STEPPED}.MCE
 I 1 SHAFT N 1 3 9 MAT 1 D 0.04 0.06 AT 0.5 BORE 0 0.02 DAMPING 1D-5 PIECES 1 $
   DISC 3 M 10 JP 0.1 BEARING 1 9 KR 1D8 2D8 KA 1D8 0 CR 10
{rest}""",
        tmp_path,
        "short",
    )
    long = run(
        f"""{STEPPED} I 10 X 0.15 0 0
 I 11 X 0.4 0 0
 I 12 X 0.5 0 0
 I 13 X 0.6 0 0
.BPR
 I 1 CIRCLE 0.04
 I 2 TUBE 0.06 0.02
.MCE
 I 1 BEAM N 1 10 3 11 12 BPR 1 MAT 1 DAMPING 1D-5
 I 3 BEAM N 12 13 9 BPR 2 MAT 1 DAMPING 1D-5
 I 4 INERTIA N 3 M 10 J 0.1 0.05 0.05
 I 5 BEARING N 0 1 AXIS 1 0 0 K 1D8 1D8 1D8 0 0 0 C 0 10 10 0 0 0
 I 6 BEARING N 0 9 AXIS 1 0 0 K 0 2D8 2D8 0 0 0 C 0 10 10 0 0 0
{rest}""",
        tmp_path,
        "long",
    )
    for channel in ("node/3/UY", "node/9/RX", "node/12/UY", "2/BENDING_MOMENT_3_A", "6/FORCE_2"):
        size = abs(long[channel]).max()
        assert size > 0
        assert abs(short[channel] - long[channel]).max() <= 1e-12 * size


def cone(pieces: int, folder: Path) -> np.ndarray:
    """Errors of the deflection and the twist of a cantilever cone, as parts."""
    length, root, end = 0.5, 0.05, 0.03
    found = run(
        f""".NOE
 I 1 X 0 0 0
 I 2 X {length} 0 0
{MATERIAL}
.MCE
 I 1 SHAFT N 1 2 MAT 1 D {root} D_END {end} SHEAR 0.9 PIECES {pieces}
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
 CHA NOEUD 2 C 2 4 V 1D-3 1D-3 NF 1
{STATICS}
.FIN 1
""",
        folder,
    )
    bending = 64 * length**3 / (3 * np.pi * YOUNG * root**3 * end)
    shear = 4 * length / (0.9 * SHEAR * np.pi * root * end)
    twist = 32 * length * (root**2 + root * end + end**2) / (3 * np.pi * SHEAR * root**3 * end**3)
    ends = np.array([found["node/2/UY"][-1], found["node/2/RX"][-1]])
    return abs(ends / (1e-3 * np.array([bending + shear, twist])) - 1)


def test_cone(tmp_path: Path) -> None:
    errors = np.array([cone(pieces, tmp_path) for pieces in (2, 4, 8)])
    assert errors[-1] == pytest.approx([1.24e-5, 4.92e-6], rel=0.02)
    assert orders(list(errors[:, 0]))[-1] == pytest.approx(4, abs=0.3)
    assert orders(list(errors[:, 1]))[-1] == pytest.approx(4, abs=0.3)


def test_twisted_strip(tmp_path: Path) -> None:
    """MacNeal and Harder (1985, Finite Elem. Anal. Des. 1, 3): a strip twisted by a right angle.
    Deflections by the integral of the flexibility: their 5.424e-3 and 1.754e-3 to 3 parts in a thousand."""
    length, width, thick, young, poisson = 12.0, 1.1, 0.32, 29e6, 0.22
    stiff = young * np.array([width**3 * thick, width * thick**3]) / 12
    area = width * thick * young / (2 * (1 + poisson)) * 10 * (1 + poisson) / (12 + 11 * poisson)

    def bent(along: int, s: float) -> float:
        # a load along axis 2 of the root bends about its axis 3 with the large moment of the section
        turn = np.pi / 2 * s / length + (np.pi / 2 if along == 1 else 0)
        return (length - s) ** 2 * (np.cos(turn) ** 2 / stiff[0] + np.sin(turn) ** 2 / stiff[1])

    closed = [quad(lambda s, a=a: bent(a, s), 0, length)[0] + length / area for a in (0, 1)]
    assert closed == pytest.approx([5.424e-3, 1.754e-3][::-1], rel=3e-3)
    errors = []
    for pieces in (2, 4):
        nodes = "\n".join(f" I {i + 1} X {length * i / (2 * pieces)!r} 0 0" for i in range(2 * pieces + 1))
        last = 2 * pieces + 1
        names = " ".join(str(i + 1) for i in range(last))
        ends = []
        for axis in (2, 3):
            found = run(
                f""".NOE
{nodes}
.BPR
 I 1 RECTANGLE {width} {thick}
.MAT
 I 1 YT {young} NT {poisson}
.MCE
 I 1 BEAM N {names} BPR 1 MAT 1 AXIS2 0 1 0 AXIS2_END 0 0 1
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
 CHA NOEUD {last} C {axis} V 1D-4 NF 1
{STATICS}
.FIN 1
""",
                tmp_path,
            )
            ends.append(found[f"node/{last}/U{'XYZ'[axis - 1]}"][-1] / 1e-4)
        errors.append(np.abs(np.array(ends) / closed - 1).max())
    assert errors == pytest.approx([5.08e-3, 2.87e-4], rel=0.02)
    assert orders(errors)[-1] == pytest.approx(4, abs=0.2)


CELLS = """.NOE
 I 1 X 0 0 0
 I 2 X 0 3 0
 I 3 X 4 3 0
 I 4 X 4 0 0
 I 5 X 0 1.5 0
 I 6 X 2 3 0
 I 7 X 4 1.5 0
.MAI
 I 1 AT 1 0 N 1 -5 2
 I 2 AT 1 0 N 2 -6 3
 I 3 AT 1 0 N 3 -7 4
.SEL
 GROUP 1 MAILLE NOM "frame"
 I 1 J 3 K 1
.HYP POUTRE GROUP "frame"
.MAT
 I 1 BEHA "ELASTIC"
 YT 2.1D11
 NT 0.3
 M 7850.
.BPR
 I 1 RECTANGLE 0.2 0.1
.AEL
 I 1 J 3 K 1 MAT 1
 GROUP "frame" BPR 1 AXIS2 1 1 0
.CLM
 GROUP "feet" FIX C 1 2 3 4 5 6
"""


def frame(loads: str, rest: str, folder: Path) -> np.ndarray:
    text = CELLS.replace(".HYP", ' GROUP 2 NOEUDS NOM "feet"\n I 1\n I 4\n.HYP')
    found = run(f"{text}{loads}\n{rest}.FIN 1\n", folder)
    return np.array([found[f"node/{i}/{c}"][-1] for i in (2, 3) for c in ("UX", "UY", "RZ")])


def test_frame_of_cells(tmp_path: Path) -> None:
    """Without an analysis the frame is linear: ten times the load, ten times the displacement, and large
    displacements under a small load are the same."""
    one = frame(" NOEUD 2 CHA C 1 V 1D5", "", tmp_path)
    ten = frame(" NOEUD 2 CHA C 1 V 1D6", "", tmp_path)
    assert ten == pytest.approx(10 * one, rel=1e-11)
    little = frame(" NOEUD 2 CHA C 1 V 1.", ".SAM TYPE STATIC\n.SUB TF 1 H 1\n", tmp_path)
    assert 1e5 * little == pytest.approx(one, abs=1e-7 * abs(one).max())


@pytest.mark.parametrize("small", ["SMALL", "LARGE"])
def test_cells_as_beams(small: str, tmp_path: Path) -> None:
    """Cells with large displacements are BEAMs."""
    analysis = f".FCT\n I 1 RAMP 0 0 1 1\n.SAM TYPE STATIC DISPLACEMENTS {small}\n.SUB TF 1 H 0.25\n"
    cells = frame(" NOEUD 2 CHA C 1 V 1D6 NF 1", analysis, tmp_path)
    head, tail = CELLS.split(".MAI")[0], CELLS.split(".AEL")[0].split(".MAT")[1]
    beams = run(
        f"""{head}.MAT{tail}.MCE
 I 1 BEAM N 1 5 2 BPR 1 MAT 1 AXIS2 1 1 0
 I 2 BEAM N 2 6 3 BPR 1 MAT 1 AXIS2 1 1 0
 I 3 BEAM N 3 7 4 BPR 1 MAT 1 AXIS2 1 1 0
.CLM
 FIX NOEUD 1 4 C 1 2 3 4 5 6
 CHA NOEUD 2 C 1 V 1D6 NF 1
{analysis}.FIN 1
""",
        tmp_path,
        "beams",
    )
    same = np.array([beams[f"node/{i}/{c}"][-1] for i in (2, 3) for c in ("UX", "UY", "RZ")])
    if small == "LARGE":
        assert cells == pytest.approx(same, rel=1e-12)
    else:
        assert abs(cells / same - 1).max() > 1e-3
