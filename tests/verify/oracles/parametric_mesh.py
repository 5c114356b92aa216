# SPDX-License-Identifier: BSD-3-Clause
"""A pair of gears whose tooth stiffness varies: x'' + 2 zeta x' + (1 + epsilon cos(Lambda t)) x = 0
(Mathieu's equation). Stable or not is told by the motion over one period (Floquet)."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq


def monodromy(epsilon: float, rate: float, damping: float = 0.0) -> np.ndarray:
    """2 x 2 matrix that carries (x, x') over one period 2 pi/rate."""

    def rhs(t: float, y: np.ndarray) -> list[float]:
        k = 1 + epsilon * np.cos(rate * t)
        return [y[1], -2 * damping * y[1] - k * y[0], y[3], -2 * damping * y[3] - k * y[2]]

    end = 2 * np.pi / rate
    y = solve_ivp(rhs, (0, end), [1.0, 0.0, 0.0, 1.0], "DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    return np.array([[y[0], y[2]], [y[1], y[3]]])


def growth(epsilon: float, rate: float, damping: float = 0.0) -> float:
    """Largest factor by which a motion grows in one period; above 1 it is unstable."""
    return float(np.abs(np.linalg.eigvals(monodromy(epsilon, rate, damping))).max())


def first_instability(epsilon: float) -> tuple[float, float]:
    """Bounds of the rates near 2, twice the natural frequency, at which the undamped pair is unstable:
    there a multiplier is -1, so the trace is -2."""

    def excess(rate: float) -> float:
        return float(np.trace(monodromy(epsilon, rate))) + 2

    return brentq(excess, 2 - epsilon, 2, xtol=1e-12), brentq(excess, 2, 2 + epsilon, xtol=1e-12)
