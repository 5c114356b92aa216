# SPDX-License-Identifier: BSD-3-Clause
"""Gas in membranes: a balloon filled past its largest pressure, against a closed form."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from runs import Run, run
from test_membranes import Mesh, displacement, octant

YOUNG, POISSON, THICK, AMBIENT = 3.0, 0.49, 0.01, 0.05
MU = YOUNG / (2 * (1 + POISSON))
LAMBDA = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))


def overpressure(stretch: np.ndarray) -> np.ndarray:
    """2 S h/(R l) of a neo-Hookean sphere of radius 1: S = μ − q/l², q = μ − λ ln J = μ C33."""
    pressures = []
    for size in np.atleast_1d(stretch):
        low, high = 1e-6, 2 * MU
        for _ in range(200):
            q = (low + high) / 2
            wrong = q - MU + LAMBDA / 2 * np.log(size**4 * q / MU)
            low, high = (low, q) if wrong > 0 else (q, high)
        pressures.append(2 * (MU - q / size**2) * THICK / size)
    return np.array(pressures)


def amount(stretch: np.ndarray) -> np.ndarray:
    """p V of the gas in the sphere."""
    return (AMBIENT + overpressure(stretch)) * 4 / 3 * np.pi * stretch**3


def balloon(rings: int, stretch: float, folder: Path) -> tuple[Run, Mesh]:
    """An octant of the sphere, filled from its own size to `stretch` times as large."""
    mesh = Mesh(rings, 1, octant)
    held = "\n".join(
        f" FIX NOEUD {n + 1} C {' '.join(str(c + 1) for c in range(3) if abs(p[c]) < 1e-12)}"
        for n, p in enumerate(mesh.points)
        if (abs(p) < 1e-12).any()
    )
    most = float(amount(np.array([stretch]))[0]) / 8
    least = AMBIENT * np.pi / 6 / most
    solved = run(
        f""".NOE
{mesh.text()}
.MAT
 I 1 BEHA "NEO-HOOKEAN" YT {YOUNG} NT {POISSON}
.MCE
{mesh.membranes(f"MAT 1 THICK {THICK}")}
 I 1000 GAS GROUP 1 MASS {most / 6!r} NF 1 R 2. TEMP 3. AMBIENT {AMBIENT} CUT 1 0 0 0 1 0 0 0 1
.SEL
 GROUP 1 MAILLES TOUT
.CLM
{held}
.FCT
 I 1 RAMP 0 {least!r} 1 1
.SAM TYPE STATIC
.SUB TF 1 H 0.1
.FIN 1
""",
        folder,
    )
    return solved, mesh


def test_past_the_largest_pressure(tmp_path: Path) -> None:
    stretches = np.linspace(1, 2.5, 3001)
    curve = overpressure(stretches)
    limit = curve.max()
    assert curve[-1] < 0.85 * limit
    assert (np.diff(amount(stretches)) > 0).all(), "the mass leads on past the limit"
    errors = []
    for rings in (2, 4):
        solved, mesh = balloon(rings, 2.5, tmp_path)
        pressure, volume = solved["1000/OVERPRESSURE"], solved["1000/VOLUME"]
        radius = np.linalg.norm(np.array(mesh.points) + displacement(solved.file), axis=1)
        errors.append([abs(radius.mean() / 2.5 - 1), abs(pressure[-1] / curve[-1] - 1)])
        assert pressure.argmax() < len(pressure) - 3
        on_the_way = np.interp((6 / np.pi * volume) ** (1 / 3), stretches, curve)
        assert pressure[1:] == pytest.approx(on_the_way[1:], abs=0.02 * limit)
        # what holds the cut x = 0 carries the overpressure on a quarter of a great circle
        with h5py.File(solved.file) as results:
            frames = results["fields/reaction_force"]
            force = np.asarray(frames[sorted(frames)[-1]]).sum(axis=0)
        cut = pressure[-1] * np.pi / 4 * radius.mean() ** 2
        assert -force == pytest.approx(np.full(3, cut), rel=3 * errors[-1][0] + 1e-6)
    assert (np.array(errors[1]) < np.array(errors[0]) / 4).all()
    assert max(errors[1]) < 2e-3


def test_work_of_filling(tmp_path: Path) -> None:
    """What is stored is the work of the compressor, ∫ ln(p/p0) d(p V) along the closed form."""
    solved, _ = balloon(4, 1.8, tmp_path)
    stretches = np.linspace(1, 1.8, 4001)
    moles, pressure = amount(stretches) / 8, AMBIENT + overpressure(stretches)
    power = np.log(pressure / AMBIENT)
    given = np.concatenate([[0], np.cumsum(np.diff(moles) * (power[1:] + power[:-1]) / 2)])
    stored = solved["run/potential_energy"]
    wanted = np.interp(6 * solved["1000/MASS"], moles, given)
    error = abs(stored - stored[0] - wanted).max() / wanted[-1]
    assert error < 1e-3
