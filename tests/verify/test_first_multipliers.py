# SPDX-License-Identifier: BSD-3-Clause
"""Reactions are of second order from the first step on, and from the first after an event: of a drive, of a
pendulum that swings at the start, of a spinning top (theory.md, Time, First velocities)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import run
from scipy.integrate import solve_ivp

G = 9.81

DRIVE = """
.NOE
 I 1
.FCT
 I 1 EXPR "0.1*sin(3*T)"
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 DRIVE SLIDE NF 1
 I 2 INERTIA N 1 M 2 J 0.1 0.1 0.1
.SAM TYPE DYNAMIC RHO {rho}
.SUB TF 1 H {h}
.FIN 1
"""

PENDULUM = """
.NOE
 I 1 X 1 0 0
 I 3 X 0 3 {height}
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 0 AT 0 0 0
 I 2 INERTIA N 1 M 2 J 0.1
 I 3 PRISMATIC N 0 3 AXIS 0 0 1 MIN -0.5 KSTOP 1D4
 I 4 INERTIA N 3 M 1 J 0.1
.CLM STRU ACC VAL 0 0 -9.81
.INI
 VIT NOEUD 1 C 3 5 V 6 -6
 VIT NOEUD 3 C 3 V {speed}
.SAM TYPE DYNAMIC RHO {rho}
.SUB TF 1 H {h}
.FIN 1
"""

TOP = """
.NOE
 I 1 X 0 1 0
.MCE
 I 1 SPHERICAL N 0 1 AT 0 0 0
 I 2 INERTIA N 1 M 15 J 0.234375 0.46875 0.234375
.CLM STRU ACC VAL 0 0 -9.81
.INI VIT NOEUD 1 C 1 5 6 V 4.61538 30 -4.61538
.SAM TYPE DYNAMIC RHO {rho}
.SUB TF 0.2 H {h}
.FIN 1
"""


def drive(t: np.ndarray) -> np.ndarray:
    return -2 * 0.9 * np.sin(3 * t)


def pendulum(t: np.ndarray) -> np.ndarray:
    """The hinge's force along x on 2 kg at a distance of 1; the angle counts from x downwards."""
    turning = 2 * 1 + 0.1  # about the hinge
    swings = solve_ivp(
        lambda _, s: [s[1], 2 * G * np.cos(s[0]) / turning], (0, 1), [0, -6], rtol=1e-12, atol=1e-12, t_eval=t
    )
    angle, speed = swings.y
    grows = 2 * G * np.cos(angle) / turning
    return 2 * (-np.cos(angle) * speed**2 - np.sin(angle) * grows)


def top(t: np.ndarray) -> np.ndarray:
    """The joint's force along x: Euler's equations about the fixed point, with the axes carried along."""
    inertia = np.array([0.234375 + 15, 0.46875, 0.234375 + 15])

    def rates(state: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        spin, axes = state[:3], state[3:].reshape(3, 3)
        weight = axes.T @ [0, 0, -15 * G]
        grows = (np.cross([0, 1, 0], weight) - np.cross(spin, inertia * spin)) / inertia
        return spin, axes, grows

    def turns(_, state: np.ndarray) -> np.ndarray:
        spin, axes, grows = rates(state)
        return np.r_[grows, np.ravel(np.cross(axes, spin))]

    begin = np.r_[0, 30, -4.61538, np.ravel(np.eye(3))]
    found = solve_ivp(turns, (0, 0.2), begin, rtol=1e-12, atol=1e-12, t_eval=t)
    forces = []
    for state in found.y.T:
        spin, axes, grows = rates(state)
        forces.append(
            15 * (axes @ (np.cross(grows, [0, 1, 0]) + np.cross(spin, np.cross(spin, [0, 1, 0]))))[0]
        )
    return np.array(forces)


@pytest.mark.parametrize("rho", [0.5, 0.9])
@pytest.mark.parametrize(
    ("deck", "channel", "exact", "step", "least"),
    [
        (DRIVE, "1/SLIDE_DRIVE", drive, 0.005, 1e-4),
        (PENDULUM.replace("{height}", "0").replace("{speed}", "0"), "1/FORCE_X", pendulum, 0.01, 1e-3),
        # a body that meets a stop twice, at t = 0.2 and some time later
        (PENDULUM.replace("{height}", "0").replace("{speed}", "-2"), "1/FORCE_X", pendulum, 0.01, 1e-3),
        (TOP, "1/FORCE_X", top, 0.001, 1e-4),
    ],
    ids=["drive", "pendulum", "beside an impact", "top"],
)
def test_reactions_are_of_second_order_at_once(
    deck, channel, exact, step, least, rho, tmp_path: Path
) -> None:
    errors = []
    for h in (step, step / 2):
        result = run(deck.format(h=h, rho=rho), tmp_path)
        force = exact(result.t)
        errors.append(np.abs(result[channel] - force).max() / np.abs(force).max())
    assert errors[1] < least
    assert np.log2(errors[0] / errors[1]) > 1.9


ARM = """
.NOE
 I 1
 I 2 X 1
.MCE
 I 1 PRISMATIC N 0 1 AXIS 0 1 0 MIN -0.02 KSTOP 1D5 DAMP HUNT 1 K 20 C 0.3
 I 2 INERTIA N 1 M 1
 I 4 INERTIA N 2 M 0.3 J 0.1
 I 5 HINGE N 1 2 AXIS 0 0 1 AT 0.2 0 0 K 3
.CLM
 STRU ACC 0 -9.81 0
.SAM TYPE DYNAMIC {scheme}
.SUB TF 0.3 H 1E-4 TOL {tolerance}
.FIN 1
"""


@pytest.mark.parametrize(("tolerance", "error"), [("1E-3", 0.05), ("1E-4", 0.015), ("1E-5", 1.5e-3)])
def test_forces_do_not_swing_where_steps_double_behind_an_impact(
    tolerance: str, error: float, tmp_path: Path
) -> None:
    """0.59, 0.24 and 3e-3 of their range while the memory was kept over steps that double."""
    truth = run(ARM.format(scheme="SCHEME RADAU", tolerance="1E-9"), tmp_path, "truth")["5/FORCE_X"]
    found = run(ARM.format(scheme="", tolerance=tolerance), tmp_path)["5/FORCE_X"]
    assert np.sqrt(np.mean((found - truth) ** 2)) < error * np.ptp(truth)
