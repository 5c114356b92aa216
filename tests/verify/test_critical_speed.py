# SPDX-License-Identifier: BSD-3-Clause
"""A wheel on a slender shaft runs through its critical speed: decks/mechanisms/turbine_shaft.dat against the
equations of Laval's rotor, with the turn of the wheel as an unknown."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from runs import run
from scipy.integrate import solve_ivp

DECK = Path(__file__).parents[2] / "decks" / "mechanisms" / "turbine_shaft.dat"
YOUNG, NU, DIAMETER, LENGTH, BEARING = 2.1e11, 0.3, 0.02, 0.8, 1e8
UNBALANCE, ARM, DAMPING, TORQUE = 0.02, 0.1, 20.0, 8.0
OUTER, WIDTH, DENSITY = 0.24, 0.03, 7850.0


def laval(t: np.ndarray) -> np.ndarray:
    """x, y, angle and their rates at times that begin at rest."""
    bending = YOUNG * np.pi * DIAMETER**4 / 64
    shear = 6 * (1 + NU) / (7 + 6 * NU) * YOUNG / 2 / (1 + NU) * np.pi * DIAMETER**2 / 4  # Cowper
    k = 1 / (LENGTH**3 / 48 / bending + LENGTH / 4 / shear + 1 / (2 * BEARING))
    disc = DENSITY * np.pi / 4 * (OUTER**2 - DIAMETER**2) * WIDTH
    inertia = disc / 8 * (OUTER**2 + DIAMETER**2) + UNBALANCE * ARM**2
    mass, u = disc + UNBALANCE, UNBALANCE * ARM

    def rates(_: float, state: np.ndarray) -> np.ndarray:
        x, y, angle, vx, vy, w = state
        s, c = np.sin(angle), np.cos(angle)
        matrix = np.array([[mass, 0, -u * s], [0, mass, u * c], [-u * s, u * c, inertia]])
        forces = [u * w * w * c - k * x - DAMPING * vx, u * w * w * s - k * y - DAMPING * vy, TORQUE]
        return np.concatenate([[vx, vy, w], np.linalg.solve(matrix, forces)])

    return solve_ivp(rates, (0, t[-1]), np.zeros(6), "DOP853", t, rtol=1e-8, atol=1e-11).y


def test_run_up(tmp_path: Path) -> None:
    """The whole motion, of second order in the step."""
    text = DECK.read_text()
    fine = run(text, tmp_path)
    x, y, _, _, _, w = laval(fine.t)
    reach = np.hypot(x, y)
    assert 140 < w[reach.argmax()] < 143  # the critical speed is 120.65
    errors = []
    for found, every in ((run(text.replace("H 5D-4", "H 1D-3"), tmp_path, "coarse", status=4), 2), (fine, 1)):
        off = np.hypot(found["node/2/UX"] - x[::every], found["node/2/UY"] - y[::every])
        errors.append(off.max() / reach.max())
    assert errors[1] < 0.02
    assert 3.8 < errors[0] / errors[1] < 4.2
