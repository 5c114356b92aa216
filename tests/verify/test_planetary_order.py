# SPDX-License-Identifier: BSD-3-Clause
"""Order in time of a planetary set with a floating sun, running centre distances and stiffness that
varies with each mesh: geometry that were updated only at the end of a step would show as order 1."""

from __future__ import annotations

from math import cos, pi, sin
from pathlib import Path

import numpy as np
import pytest
from runs import Run, run

END = 2e-3
STEPS = (2e-5, 1e-5, 5e-6, 2.5e-6)
FINE = 6.25e-7


def deck(step: float) -> str:
    """24-18-60, module 3 mm; the sun floats on a soft bearing and is off its place at the start, the
    ring is held, the carrier drives a flywheel through a shaft."""
    nodes = joints = ""
    for i in range(3):
        x, y = 0.063 * cos(2 * pi * i / 3), 0.063 * sin(2 * pi * i / 3)
        nodes += f" I {11 + i} X {x!r} {y!r} 0\n"
        common = "AXIS 0 0 1 MN 0.003 KM 4D8 CM 1500 RUNNING STIFF FOURIER 0.15 0.05"
        joints += f""" I {11 + i} HINGE N 3 {11 + i} AXIS 0 0 1 AT {x!r} {y!r} 0
 I {21 + i} INERTIA N {11 + i} M 0.5 J 2D-4 2D-4 3D-4
 I {31 + i} GEAR N 1 {11 + i} Z 24 18 {common}
 I {41 + i} GEAR N {11 + i} 2 Z 18 60 {common} INTERNAL
"""
    return f""".NOE
 I 1 X 0 0 0
 I 2 X 0 0 0
 I 3 X 0 0 0
{nodes}.MCE
 I 1 SPRING N 0 1 K 1D7 1D7 0 C 300 300 0
 I 2 HINGE N 0 3 AXIS 0 0 1
 I 3 INERTIA N 1 M 0.9 J 1D-3 1D-3 6D-4
 I 4 INERTIA N 3 M 3 J 0.01 0.01 0.008
 I 5 TORQUE N 1 AXIS 0 0 1 V 200
 I 6 TSPRING N 0 3 AXIS 0 0 1 K 2D5 C 10
{joints}.CLM
 FIX NOEUD 1 C 3 4 5
 FIX NOEUD 2 C 1 2 3 4 5 6
.INI
 VIT NOEUD 1 C 1 2 V 0.002 -0.003
.SAM TYPE DYNAMIC RHO 0.8 START STATIC
.SUB TF {END!r} H {step!r}
.FIN 1
"""


QUANTITIES = {
    "sun, x": "node/1/UX",
    "sun, y": "node/1/UY",
    "turn of the sun": "31/PSI_A",
    "mesh force": "32/NORMAL_FORCE",
    "ring force": "43/NORMAL_FORCE",
    "pressure angle": "31/PRESSURE_ANGLE",
}


def test_second_order(tmp_path: Path) -> None:
    def at(step: float) -> Run:
        return run(deck(step), tmp_path, f"h{step:g}")

    fine = at(FINE)
    coarse = [at(step) for step in STEPS]
    for name, channel in QUANTITIES.items():
        true = fine[channel][:: round(STEPS[0] / FINE)]
        errors = np.array(
            [
                np.abs(r[channel][:: round(STEPS[0] / h)] - true).max()
                for r, h in zip(coarse, STEPS, strict=True)
            ]
        )
        slopes = np.log2(errors[:-1] / errors[1:])
        print(
            f"{name:16s}",
            " ".join(f"{e:.3e}" for e in errors),
            " slopes",
            " ".join(f"{s:.2f}" for s in slopes),
        )
        # the fine run has an error of its own, 1/16 of the last one compared
        assert slopes[1:] == pytest.approx([2, 2], abs=0.2), name
        assert np.ptp(true) > 200 * errors[-1], f"{name} hardly moves: the test would judge nothing"


@pytest.mark.parametrize("teeth", ["JEU 1D-4 RUNNING", "JEU 1D-4"])
def test_statics_finds_the_flanks(teeth: str, tmp_path: Path) -> None:
    """With play in all six meshes and the load in full from the start: which flanks carry is not where the
    wheels stand, and planets must cross their gaps to the ring."""
    text = deck(1e-5).replace("RUNNING", teeth).replace("TYPE DYNAMIC RHO 0.8 START STATIC", "TYPE STATIC")
    text = text.replace(f".SUB TF {END!r} H 1e-05", ".SUB TF 1 H 1")
    result = run(text, tmp_path)
    assert [result[f"{i}/CONTACT"][0] for i in (31, 32, 33, 41, 42, 43)] == [1, 1, 1, -1, -1, -1]
    for i in (31, 32, 33):
        # each planet takes a third of the torque at r_b, as the sun may float
        assert result[f"{i}/NORMAL_FORCE"][0] == pytest.approx(200 / 3 / (0.036 * cos(pi / 9)), rel=2e-3)
    assert sum(result[f"{i}/TORQUE_A"][0] for i in (31, 32, 33)) == pytest.approx(-200, rel=1e-9)
