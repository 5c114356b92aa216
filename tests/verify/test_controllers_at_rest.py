# SPDX-License-Identifier: BSD-3-Clause
"""Controllers with a derivative hold elastic parts: what they compute at rest is rounding times their gain,
which is no reason for another iteration; and no vibration that steps lose."""

from pathlib import Path

import pytest
from runs import solve

ARM = """.NOE
{nodes}
.MAT
 I 1 YT 2.1E11 NT 0.33 M 2700
.BPR
 I 1 RECTANGLE 0.01 0.02
.MCE
 I 801 HINGE N 0 1 AXIS 0 0 1
 I 802 INERTIA N 1 M 1 J 1 1 2E-3
 I 1 BEAM N 1 A 11 MAT 1 SECTION 1 AXIS2 0 1 0
 I 809 CONTROLLER IN 801 REF {reference} KP 400 {law} OUT 801
.FCT
 I 1 EXPR "0.01*(1 - cos(200*max(T-0.005,0)))"
.CLM
 STRU ACC VAL 0 -9.81 0
.SAM TYPE DYNAMIC START STATIC {scheme}
.SUB TF 0.05 H 0.001
.FIN
"""


@pytest.mark.parametrize("law", ["KD 6 TF 1e-3", "KD 0.5 TF 1e-2", "KI 50 KD 6 TF 1e-3"])
@pytest.mark.parametrize("scheme", ["RHO 0.8", "RHO 0.8 SOLVER KLU", "SCHEME RADAU"])
def test_an_arm_at_rest(law: str, scheme: str, tmp_path: Path) -> None:
    """The run failed at its second step, or cut its steps to 2e-6."""
    nodes = "\n".join(f" I {i + 1} X {0.06 * i:.2f}" for i in range(11))
    said, found = solve(ARM.format(nodes=nodes, reference=0, law=law, scheme=scheme), tmp_path)
    assert said["steps"] == 50
    assert said["failed_attempts"] == 0
    sag = found["node/11/UY"]
    assert sag == pytest.approx(sag[0], rel=1e-9)


@pytest.mark.parametrize("scheme", ["RHO 0.8", "SCHEME RADAU"])
def test_an_arm_that_begins_to_move(scheme: str, tmp_path: Path) -> None:
    nodes = "\n".join(f" I {i + 1} X {0.06 * i:.2f}" for i in range(11))
    text = ARM.format(nodes=nodes, reference="30 NF 1", law="KD 6 TF 1e-3", scheme=scheme)
    said, found = solve(text, tmp_path)
    assert said["failed_attempts"] <= 2
    angle = found["element/801/ANGLE"]
    assert angle.max() - angle[0] > 1e-3


def cells_of_an_arm(along: int = 12, across: int = 2) -> str:
    """Cells of 8 nodes, 0.6 by 0.03; the last nodes are those of its end."""
    ids: dict[tuple[int, int], int] = {}
    for i in range(2 * along + 1):
        for j in range(2 * across + 1):
            if i % 2 == 0 or j % 2 == 0:
                ids[i, j] = len(ids) + 1
    ring = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    nodes = [f" I {n} X {0.3 * i / along:.9g} {0.015 * (j / across - 1):.9g}" for (i, j), n in ids.items()]
    cells = []
    for a in range(along):
        for b in range(across):
            names = [ids[2 * a + i, 2 * b + j] for i, j in ring]
            cells.append(" N " + " ".join(str(-n if k % 2 else n) for k, n in enumerate(names)))
    text = "\n".join(f" I {k + 1}{cell}" for k, cell in enumerate(cells))
    sides = [[ids[i, j] for j in range(2 * across + 1)] for i in (0, 2 * along)]
    bore, end = (" ".join(map(str, side)) for side in sides)
    return f""".NOE
{chr(10).join(nodes)}
 I 9001 X 0 0 0
 I 9002 X 0.6 0 0
.MAI
{text}
.HYP MEMB BIDIM
.SEL
 GROUP 1 NOM "all" MAILLES TOUT
.PHP GROUP "all" THICK VAL 0.02
.MAT
 I 1 YT 7E10 NT 0.33 M 2700
.AEL GROUP "all" MAT 1
.MCE
 I 8001 HINGE N 0 9001 AXIS 0 0 1
 I 8002 INERTIA N 9001 M 1 J 1 1 0.002
 I 8003 RIGID_LINK N 9001 MEMBERS {bore}
 I 8004 MEAN_LINK N 9002 MEMBERS {end}
 I 8009 CONTROLLER IN 8001 REF 0.1 NF 1 KP 400 KI 2000 KD 6 TF 0.001 OUT 8001
"""


def test_an_acceleration_that_is_rounding(tmp_path: Path) -> None:
    """The arm stays straight along x: 0.16 of the range of AX was stated, after three runs."""
    text = (
        cells_of_an_arm()
        + """.FCT
 I 1 STEP 0.005 0 0.03 1
.SAM TYPE DYNAMIC PLANE XY ACCURACY NORMAL DISPLACEMENTS SMALL
.SUB TF 0.05 H 0.001
.SAI ELEMENT 8001 8009 NOEUD 9002 CHANNEL "ANGLE" "EFFORT" "UX" "UY" "VX" "VY" "AX" "AY"
.FIN
"""
    )
    said, found = solve(text, tmp_path)
    assert found["node/9002/UX"].max() < 1e-14
    assert said["accuracy"]["estimated_error"] < 1e-3


@pytest.mark.parametrize(("accuracy", "error"), [("NORMAL", 1e-4), ("FINE", 1e-5), ("REFERENCE", 1e-7)])
def test_limits_leave_no_vibration(accuracy: str, error: float, tmp_path: Path) -> None:
    """A rigid pendulum. Two steps behind each event fit any vibration, and so do the residuals of iterations:
    0.0019 was stated where 2e-9 is true, and steps of 6e-7 advised."""
    text = f""".NOE
 I 2 X 0.5
.FCT
 I 1 SINUS 0.3 2
.MCE
 I 1 HINGE N 0 2 AXIS 0 0 1 AT 0 0 0
 I 2 INERTIA N 2 M 2 J 1 1 .1
 I 3 CONTROLLER IN 1 NF 1 KP 200 KI 100 KD 20 TF 1e-3 OUT 1 LIMITS -20 20
.CLM
 STRU ACC VAL 0 -9.81 0
.SAM TYPE DYNAMIC ACCURACY {accuracy}
.SUB TF 2 H 1e-3
.FIN
"""
    said, _ = solve(text, tmp_path)
    assert "vibration" not in said["said"]
    assert said["accuracy"]["estimated_error"] < error
