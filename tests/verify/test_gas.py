# SPDX-License-Identifier: BSD-3-Clause
"""Gas in membranes: a balloon filled past its largest pressure, against a closed form."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from runs import Run, run
from test_membranes import Mesh, displacement, octant, planes_held

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
    held = planes_held(mesh)
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


def breathing(h: float, tmp_path: Path) -> tuple[float, float]:
    """A ball of elastic skin round a gas that gets no heat swings as its equation of motion says,
    rho h R0 l'' = (p - p0) l^2 - 2 S h l/R0, from the size at which it was sewn; R0 = 1. The largest error of
    its volume, over how far that swings, and of its energy."""
    young, poisson, thick, density, first, ambient, gamma, end = 4.0, 0.3, 0.02, 5.0, 0.6, 0.5, 1.4, 4.0
    mesh = Mesh(3, 1, octant)
    held = planes_held(mesh)
    solved = run(
        f""".NOE
{mesh.text()}
.MAT
 I 1 YT {young} NT {poisson} M {density}
.MCE
{mesh.membranes(f"MAT 1 THICK {thick}")}
 I 1000 GAS GROUP 1 P {first} AMBIENT {ambient} GAMMA {gamma} CUT 1 0 0 0 1 0 0 0 1
.SEL
 GROUP 1 MAILLES TOUT
.CLM
{held}
.SAM TYPE DYNAMIC SCHEME CHUNG RHO 1.
.SUB TF {end} H {h}
.FIN 1
""",
        tmp_path,
    )

    def rate(state: np.ndarray) -> np.ndarray:
        stretch, speed = state
        stress = young / (1 - poisson) * (stretch**2 - 1) / 2
        over = first * stretch ** (-3 * gamma) - ambient
        return np.array([speed, (over * stretch**2 - 2 * stress * thick * stretch) / (density * thick)])

    state, step, curve = np.array([1.0, 0.0]), 1e-3, [1.0]
    for _ in range(round(end / step)):  # the scheme of Runge and Kutta
        a = rate(state)
        b = rate(state + step / 2 * a)
        c = rate(state + step / 2 * b)
        state = state + step / 6 * (a + 2 * b + 2 * c + rate(state + step * c))
        curve.append(state[0])
    wanted = np.interp(solved.t, np.arange(len(curve)) * step, curve) ** 3
    found = solved["1000/VOLUME"] / solved["1000/VOLUME"][0]
    error = abs(found - wanted).max() / np.ptp(wanted)
    return error, abs(solved["run/energy_error"]).max()


def test_breathing(tmp_path: Path) -> None:
    errors = np.array([breathing(h, tmp_path) for h in (0.05, 0.025)])
    assert errors[0, 0] < 0.04
    assert errors[0, 0] / errors[1, 0] > 3, "an error of second order in h"
    assert errors[0, 1] < 5e-6, "energy"


BOX = """.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
 I 3 X 1 1 0
 I 4 X 0 1 0
 I 5 X 0 0 1
 I 6 X 1 0 1
 I 7 X 1 1 1
 I 8 X 0 1 1
.MAT
 I 1 YT 1D-9 NT 0. M 1.
.MCE
 I 1 MEMBRANE N 1 2 6 5 MAT 1 THICK 0.001
 I 2 MEMBRANE N 2 3 7 6 MAT 1 THICK 0.001
 I 3 MEMBRANE N 3 4 8 7 MAT 1 THICK 0.001
 I 4 MEMBRANE N 4 1 5 8 MAT 1 THICK 0.001
 I 5 MEMBRANE N 5 6 7 8 MAT 1 THICK 0.001
 I 9 GAS GROUP "box" MASS 1. NF 2 R 1. TEMP 3. AMBIENT 2. CUT 0 0 1
.SEL
 GROUP 1 NOM "box" MAILLES
 I 1 J 5 K 1
.CLM
 FIX NOEUD 1 2 3 4 5 6 7 8 C 1 2 3
.FCT
 I 2 TABLE 0 0.7 1 0.7 1.01 1.2 5 1.2
"""


@pytest.mark.parametrize(
    ("analysis", "steps"),
    [
        ("DYNAMIC RHO 0.9", "H 0.01"),
        ("DYNAMIC RHO 0.9", "H 0.07"),
        ("DYNAMIC RHO 0.9", "H 0.01 TOL 1E-5"),
        ("DYNAMIC SCHEME RADAU", "H 0.1"),
        ("DYNAMIC ACCURACY NORMAL", "H 0.005"),
        ("STATIC", "H 0.1"),
    ],
)
def test_filling_at_once(analysis: str, steps: str, tmp_path: Path) -> None:
    """A rigid box of volume 1 is filled within a hundredth of a second, wherever steps end: the work is the
    integral of 3 ln(1.5 f) df from 0.7 to 1.2."""
    solved = run(f"{BOX}.SAM TYPE {analysis}\n.SUB TF 2 {steps}\n.FIN 1\n", tmp_path)

    def stored(f: float) -> float:
        return float(3 * f * (np.log(1.5 * f) - 1))

    work = stored(1.2) - stored(0.7)
    assert solved["run/external_work"][-1] == pytest.approx(work, rel=1e-9)
    assert abs(solved["run/energy_error"]).max() < 1e-9 * work
