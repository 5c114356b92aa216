# SPDX-License-Identifier: BSD-3-Clause
"""Controlled mechanisms as ordinary differential equations in minimal coordinates (rtol 1e-11). SI
units.

The laws are written out here in their textbook form: e = r - m, u = KP e + I + D with dI/dt = KI e +
(limited(u) - u)/TT and the derivative D = (KD e - w)/TF, dw/dt = (KD e - w)/TF (Astrom and Hagglund,
Advanced PID Control, 2006, sections 3.4 and 3.5)."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp


@dataclasses.dataclass
class Pid:
    kp: float
    ki: float = 0.0
    kd: float = 0.0
    tf: float = 1.0
    low: float = -math.inf
    high: float = math.inf

    def steady(self, error: float, integral: float) -> list[float]:
        """States at rest with a constant error."""
        return [integral, self.kd * error]

    def rates(self, error: float, states: np.ndarray) -> tuple[float, list[float]]:
        """Limited command, rates of integral and filter."""
        integral, filtered = states
        command = self.kp * error + integral + (self.kd * error - filtered) / self.tf
        limited = min(max(command, self.low), self.high)
        tracking = (limited - command) * self.ki / self.kp if self.ki else 0.0
        return limited, [self.ki * error + tracking, (self.kd * error - filtered) / self.tf]


def quintic(t: float, t0: float, y0: float, t1: float, y1: float) -> float:
    """The STEP function: y0 to y1 by the polynomial of degree five with continuous curvature."""
    s = min(max((t - t0) / (t1 - t0), 0.0), 1.0)
    return y0 + (y1 - y0) * s**3 * (10 - 15 * s + 6 * s * s)


def solve(rhs: Callable, start: list[float], t: np.ndarray, longest: float = math.inf) -> np.ndarray:
    t = np.asarray(t, float)
    done = solve_ivp(rhs, (0.0, float(t[-1])), start, "DOP853", t, rtol=1e-11, atol=1e-12, max_step=longest)
    assert done.success
    return done.y


def pid_mass(
    t: np.ndarray, law: Pid, reference: Callable[[float], float], mass: float, force: float
) -> np.ndarray:
    """Position of a mass under a constant force, from rest at 0; the integral starts from 0."""

    def rhs(time: float, y: np.ndarray) -> list[float]:
        u, states = law.rates(reference(time) - y[0], y[2:])
        return [y[1], (u + force) / mass, *states]

    return solve(rhs, [0.0, 0.0, *law.steady(reference(0.0), 0.0)], t, 0.005)[0]


def lead_mass(t: np.ndarray, reference: Callable[[float], float], mass: float) -> np.ndarray:
    """Position of a mass under u = (800 s + 2000)/(s + 40) e, steady at the start: u = 800 e - x, dx/dt
    = 30000 e - 40 x."""

    def rhs(time: float, y: np.ndarray) -> list[float]:
        e = reference(time) - y[0]
        return [y[1], (800 * e - y[2]) / mass, 30000 * e - 40 * y[2]]

    return solve(rhs, [0.0, 0.0, 750 * reference(0.0)], t, 0.005)[0]


@dataclasses.dataclass
class Arm:
    """Three-axis arm: a turret that turns about the vertical, two axisymmetric links that rise from it
    in its plane, a point mass at the tip. Angles: of the turret, of the first link above the
    horizontal, of the second from the first."""

    turret: float = 2.0  # inertia about the vertical
    length: tuple[float, float] = (0.6, 0.5)
    mass: tuple[float, float] = (8.0, 5.0)
    axial: tuple[float, float] = (0.02, 0.01)  # inertia about a link's own line
    across: tuple[float, float] = (0.25, 0.11)  # about its centre, across
    load: float = 3.0
    gravity: float = 9.81

    def reduced(self) -> tuple[float, float, float, float, float]:
        """The second link with the load: mass, distance of its centre from the elbow, inertias; and l1."""
        m = self.mass[1] + self.load
        centre = (self.mass[1] * self.length[1] / 2 + self.load * self.length[1]) / m
        across = (
            self.across[1]
            + self.mass[1] * (self.length[1] / 2 - centre) ** 2
            + self.load * (self.length[1] - centre) ** 2
        )
        return m, centre, across, self.axial[1], self.length[0] / 2

    def weight(self, q: np.ndarray) -> np.ndarray:
        """Torques that hold the arm still."""
        m2, l2, _, _, l1 = self.reduced()
        outer = m2 * l2 * math.cos(q[1] + q[2])
        inner = (self.mass[0] * l1 + m2 * self.length[0]) * math.cos(q[1])
        return self.gravity * np.array([0.0, inner + outer, outer])

    def accelerations(self, q: np.ndarray, v: np.ndarray, torque: np.ndarray) -> np.ndarray:
        """Lagrange's equations; the turret's inertia M11 depends on the raised angles."""
        m2, l2, across2, axial2, l1 = self.reduced()
        m1, reach = self.mass[0], self.length[0]
        s1, c1, s12, c12 = math.sin(q[1]), math.cos(q[1]), math.sin(q[1] + q[2]), math.cos(q[1] + q[2])
        rho1, rho2 = l1 * c1, reach * c1 + l2 * c12
        about = (
            self.turret
            + m1 * rho1**2
            + m2 * rho2**2
            + self.across[0] * c1**2
            + self.axial[0] * s1**2
            + across2 * c12**2
            + axial2 * s12**2
        )
        by_elbow = -2 * m2 * rho2 * l2 * s12 + 2 * (axial2 - across2) * s12 * c12
        by_shoulder = (
            -2 * m1 * rho1 * l1 * s1
            - 2 * m2 * rho2 * (reach * s1 + l2 * s12)
            + 2 * (self.axial[0] - self.across[0]) * s1 * c1
            + 2 * (axial2 - across2) * s12 * c12
        )
        b = m2 * reach * l2
        d = across2 + m2 * l2**2
        a = self.across[0] + m1 * l1**2 + m2 * reach**2 + d
        mass = np.array([[a + 2 * b * math.cos(q[2]), d + b * math.cos(q[2])], [d + b * math.cos(q[2]), d]])
        whirl = b * math.sin(q[2]) * np.array([-2 * v[1] * v[2] - v[2] ** 2, v[1] ** 2])
        spin = 0.5 * v[0] ** 2 * np.array([by_shoulder, by_elbow])
        raised = np.linalg.solve(mass, torque[1:] - whirl - self.weight(q)[1:] + spin)
        turned = (torque[0] - (by_shoulder * v[1] + by_elbow * v[2]) * v[0]) / about
        return np.array([turned, *raised])


ARM_LAWS = (
    Pid(900.0, 1500.0, 150.0, 0.01, -50.0, 50.0),
    Pid(2500.0, 8000.0, 300.0, 0.01),
    Pid(1500.0, 5000.0, 120.0, 0.01),
)


def arm_reference(t: float) -> np.ndarray:
    """Radians: round, up, and the elbow bent down."""
    return np.array(
        [
            quintic(t, 0.1, 0.0, 1.1, 1.2),
            quintic(t, 0.1, 0.0, 0.7, 0.9),
            quintic(t, 0.3, 0.0, 1.0, -1.3),
        ]
    )


def robot_arm(t: np.ndarray, arm: Arm | None = None) -> dict[str, np.ndarray]:
    """Angles (3 x n) and torques (3 x n) of the arm under three PIDs, from the equilibrium at t = 0,
    where the integrals carry the weight."""
    arm = arm or Arm()

    def parts(time: float, y: np.ndarray) -> tuple[np.ndarray, list[float]]:
        torque, rates = [], []
        for i, law in enumerate(ARM_LAWS):
            u, rate = law.rates(arm_reference(time)[i] - y[i], y[6 + 2 * i : 8 + 2 * i])
            torque.append(u)
            rates += rate
        return np.array(torque), rates

    def rhs(time: float, y: np.ndarray) -> np.ndarray:
        torque, rates = parts(time, y)
        return np.array([*y[3:6], *arm.accelerations(y[:3], y[3:6], torque), *rates])

    weight = arm.weight(np.zeros(3))
    start = [0.0] * 6
    for i, law in enumerate(ARM_LAWS):
        start += law.steady(0.0, float(weight[i]))
    y = solve(rhs, start, t, 0.002)
    torque = np.array([parts(time, y[:, k])[0] for k, time in enumerate(np.asarray(t, float))]).T
    return {"angles": y[:3], "torques": torque}
