# SPDX-License-Identifier: BSD-3-Clause
"""10**6 tooth meshes of wheels that meet every tooth of their partner: no phase is lost."""

from __future__ import annotations

from math import cos, fmod, pi, radians, sin
from pathlib import Path

import pytest
from runs import run

Z_A, Z_B = 97, 101
TURNS = 10310
ANGLE = 2 * pi * TURNS + 0.777


def test_million_meshes(tmp_path: Path) -> None:
    """Quasi-static, with runout of both wheels, a tooth error and stiffness that varies with the mesh:
    at the end the approach of the teeth must be that of the angle within the turn, and the turns of
    B that of A's times the ratio."""
    deck = f""".NOE
 I 1 X 0 0 0
 I 2 X {(Z_A + Z_B) / 2!r} 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 AXIS 0 0 1 Z {Z_A} {Z_B} MN 1 KM 1D5 STIFF FOURIER 0.2 0.1 $
     ERR FOURIER 0.001 0.002 0 -0.0005 ECCA 0.01 30 ECCB 0.02 -50
 I 4 TORQUE N 2 AXIS 0 0 1 V 50000
.FCT
 I 1 TABLE 0 0  1 {ANGLE!r}
.SAM TYPE STATIC
.SUB TF 1 H {1 / 23000!r}
.SAI FIELDS DT 0.1 HISTORY DT 0.001
.FIN 1
"""
    result = run(deck, tmp_path)
    assert Z_A * TURNS > 1e6
    psi_a = fmod(ANGLE, 2 * pi)
    tau = Z_A * psi_a
    stiffness = 1e5 * (1 + 0.2 * cos(tau) + 0.1 * sin(tau))
    assert result["3/PSI_A"][-1] == pytest.approx(ANGLE, rel=1e-15)
    assert result["3/STIFFNESS"][-1] == pytest.approx(stiffness, rel=1e-9)
    # u_m follows from the errors of both wheels at their places; B lags by u_m
    x, u = result["3/TRANSMISSION_ERROR"][-1], result["3/U_M"][-1]
    psi_b = (-Z_A * psi_a / 2 + u) / (Z_B / 2) - 2 * pi * fmod(TURNS * Z_A / Z_B, 1)
    errors = (
        0.001 * cos(tau)
        + 0.002 * sin(tau)
        - 0.0005 * sin(2 * tau)
        + 0.01 * sin(psi_a + radians(30))
        + 0.02 * sin(psi_b + radians(-50))
    )
    assert u + errors == pytest.approx(x, abs=1e-11)
    lever = Z_B / 2 + 0.02 * cos(psi_b + radians(-50))  # the runout of B shifts where its teeth are pushed
    assert x == pytest.approx(50000 / lever / stiffness, rel=1e-9)
    assert result["3/PSI_B"][-1] == pytest.approx(-ANGLE * Z_A / Z_B + u / (Z_B / 2), rel=1e-14)
