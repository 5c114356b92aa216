# SPDX-License-Identifier: BSD-3-Clause
"""N four-bars in a row (A02 of the IFToMM library of multibody benchmarks): N + 1 arms on the ground and N
bars between their ends, slender links of 1 m and 1 kg. All arms turn alike and the bars keep their direction,
through the positions in which all links lie in one line too: a pendulum of one angle from the vertical,

    ((N + 1)/3 + N) a'' = g ((N + 1)/2 + N) sin a,   a' = 1 at the top.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY = 9.81


def first_bar(times: np.ndarray, n: int = 2) -> np.ndarray:
    """UX, UY, VX, VY of the bars' first end, which begins above its arm's pin: one row for each time."""
    pull = GRAVITY * ((n + 1) / 2 + n) / ((n + 1) / 3 + n)
    angle, speed = solve_ivp(
        lambda _, y: (y[1], pull * math.sin(y[0])),
        (0, times[-1]),
        (0, 1),
        "DOP853",
        times,
        rtol=1e-13,
        atol=1e-13,
    ).y
    return np.array([np.sin(angle), np.cos(angle) - 1, speed * np.cos(angle), -speed * np.sin(angle)]).T
