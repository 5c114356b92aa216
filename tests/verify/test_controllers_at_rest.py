# SPDX-License-Identifier: BSD-3-Clause
"""Controllers with a derivative hold elastic parts: what they compute at rest is rounding times their gain,
which is no reason for another iteration."""

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
