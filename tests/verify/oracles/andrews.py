# SPDX-License-Identifier: BSD-3-Clause
"""Andrews' squeezing mechanism in one coordinate: E. Hairer and G. Wanner, Solving Ordinary Differential
Equations II (1996), section VI.9; data of the Test Set for IVP Solvers, problem "andrews". SI units."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

MASS = np.array([0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498])
INERTIA = np.array([2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5])
A, B, C = np.array([-0.06934, -0.00227]), np.array([-0.03635, 0.03273]), np.array([0.014, 0.072])
C0, L0, TORQUE = 4530.0, 0.07785, 0.033
D, DA, E, EA = 0.028, 0.0115, 0.02, 0.01421
RR, RA = 0.007, 0.00092
SS, SA, SB, SC, SD = 0.035, 0.01874, 0.01043, 0.018, 0.02
TA, TB, U, UA, UB = 0.02308, 0.00916, 0.04, 0.01228, 0.00449
ZF, ZT, FA = 0.02, 0.04, 0.01421

#: beta, Theta, gamma, Phi, delta, Omega, epsilon
START = np.array(
    [
        -0.0617138900142764496358948458001,
        0.0,
        0.455279819163070380255912382449,
        0.222668390165885884674473185609,
        0.487364979543842550225598953530,
        -0.222668390165885884674473185609,
        1.23054744454982119249735015568,
    ]
)
#: at t = 0.03, the Test Set's reference solution
PUBLISHED = np.array(
    [
        15.81077119629904,
        -15.75637105984298,
        0.04082224013073101,
        -0.5347301163226948,
        0.5244099658805304,
        0.5347301163226948,
        1.048080741042263,
    ]
)
#: absolute angle of each body = TURN @ q
TURN = np.array(
    [
        [1, 0, 0, 0, 0, 0, 0],
        [1, 1, 0, 0, 0, 0, 0],
        [0, 0, 1, 0, 0, 0, 0],
        [0, 0, 0, 1, 1, 0, 0],
        [0, 0, 0, 0, 1, 0, 0],
        [0, 0, 0, 0, 0, 1, 1],
        [0, 0, 0, 0, 0, 0, 1],
    ]
)


#: points from their ground point, as sums of c u + s v of bodies: (body, c, s), where u = (cos, sin) and
#: v = (-sin, cos) of the body's angle
POINTS = {
    "E by 2": [(0, RR, 0.0), (1, -D, 0.0)],
    "E by 3": [(2, 0.0, -SS)],
    "E by 4": [(4, ZT, 0.0), (3, 0.0, -E)],
    "E by 6": [(6, 0.0, -U), (5, ZF, 0.0)],
    "D": [(2, SD, -SC)],
    "1": [(0, RA, 0.0)],
    "2": [(0, RR, 0.0), (1, -DA, 0.0)],
    "3": [(2, SB, -SA)],
    "4": [(4, ZT, 0.0), (3, 0.0, -(E - EA))],
    "5": [(4, TA, TB)],
    "6": [(6, 0.0, -U), (5, ZF - FA, 0.0)],
    "7": [(6, UA, -UB)],
}


def point(name: str, angle: np.ndarray, order: int = 0) -> np.ndarray:
    """The two coordinates by body (2 x 7), or their `order`-th derivative by its angle."""
    out = np.zeros((2, 7))
    for body, c, s in POINTS[name]:
        turned = angle[body] + order * np.pi / 2
        u = np.array([np.cos(turned), np.sin(turned)])
        out[:, body] += c * u + s * np.array([-u[1], u[0]])
    return out


LOOPS = (("E by 2", "E by 3", B), ("E by 2", "E by 4", A), ("E by 2", "E by 6", A))


def closure(q: np.ndarray, order: int = 0) -> np.ndarray:
    """The six loop equations, or the derivative of their points by each angle (6 x 7)."""
    angle = TURN @ q
    rows = [point(one, angle, order) - point(other, angle, order) for one, other, _ in LOOPS]
    if order:
        return np.concatenate(rows)
    return np.concatenate([r.sum(axis=1) - ground for r, (_, _, ground) in zip(rows, LOOPS, strict=True)])


def assemble(q: np.ndarray) -> np.ndarray:
    """The other angles for beta = q[0], by Newton's method from those given."""
    q = q.copy()
    for _ in range(50):
        step = np.linalg.solve((closure(q, 1) @ TURN)[:, 1:], closure(q))
        q[1:] -= step
        if np.abs(step).max() < 1e-15:
            break
    return q


def coefficients(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """dq/dbeta and d2q/dbeta2 on the loops."""
    jacobian = closure(q, 1) @ TURN
    first = np.r_[1.0, -np.linalg.solve(jacobian[:, 1:], jacobian[:, 0])]
    bend = closure(q, 2) @ (TURN @ first) ** 2
    return first, np.r_[0.0, -np.linalg.solve(jacobian[:, 1:], bend)]


def acceleration(q: np.ndarray, speed: float) -> float:
    """beta'' from d'Alembert's principle along the one motion that the loops leave."""
    first, second = coefficients(q)
    angle, turn, bend = TURN @ q, TURN @ first, TURN @ second
    inertia, gyration = float(INERTIA @ turn**2), float(INERTIA @ (turn * bend))
    for i, m in enumerate(MASS):
        along = point(str(i + 1), angle, 1)
        velocity = along @ turn
        inertia += m * float(velocity @ velocity)
        gyration += m * float(velocity @ (along @ bend + point(str(i + 1), angle, 2) @ turn**2))
    reach = B + point("D", angle).sum(axis=1) - C
    length = np.linalg.norm(reach)
    pull = -C0 * (length - L0) / length * float(reach @ (point("D", angle, 1) @ turn))
    return (TORQUE + pull - gyration * speed**2) / inertia


def motion(times: np.ndarray, accuracy: float = 1e-9) -> np.ndarray:
    """The seven angles (n x 7) at the times, which must lie so close that the loops do not change branch."""
    known = [assemble(START)]

    def place(beta: float) -> np.ndarray:
        near = known[-1]
        known[-1] = assemble(near + coefficients(near)[0] * (beta - near[0]))
        return known[-1]

    def rhs(_t: float, y: np.ndarray) -> list[float]:
        return [y[1], acceleration(place(y[0]), y[1])]

    y = solve_ivp(
        rhs, (0, times[-1]), [START[0], 0.0], "DOP853", t_eval=times, rtol=accuracy, atol=0.1 * accuracy
    ).y[0]
    known[-1] = assemble(START)
    return np.array([place(beta) for beta in y])
