# SPDX-License-Identifier: BSD-3-Clause
"""A slider with dry friction turns round at the dead centres of its crank, where it is at rest for an instant
and could hold the crank if friction were without limit. Against an integration from one dead centre to the
next by scipy."""

from __future__ import annotations

from math import cos, pi, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
from runs import run
from scipy.integrate import solve_ivp

R, ROD, INERTIA, MASS, MU, PRELOAD, SPEED, END = 0.3, 1.0, 1.0, 2.0, 0.1, 1.0, 5.0, 3.0
DECK = f"""
.NOE
 I 1
 I 2 Y {R}
 I 5 X {sqrt(ROD**2 - R**2)!r}
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 RIGID N 1 2 M 1 J {INERTIA}
 I 8 PRISMATIC N 0 5 AXIS 1 0 0 FRICTION CONST {MU} PRELOAD {PRELOAD}
 I 9 INERTIA N 5 M {MASS} J 0.1
 I 10 DISTANCE N 2 5
.INI
 VIT ELEMENT 1 V -{SPEED}
.SAM TYPE DYNAMIC {{scheme}}
.SUB TF {END} H 0.01 {{tol}}
.FIN 1
"""


def acceleration(a: float, speed: float, sense: float) -> float:
    """Of the crank at the angle a, while the slider moves in the given sense."""
    s, c = sin(a), cos(a)
    rod = sqrt(ROD**2 - (R * s) ** 2)
    slope = -R * s - R**2 * s * c / rod  # of the slider's place by the angle
    bend = -R * c - R**2 * ((c**2 - s**2) * rod + R**2 * (s * c) ** 2 / rod) / rod**2
    along, across = rod / ROD, abs(R * s / ROD)
    for sign in (1, -1):  # of the force in the rod
        push = (MASS * bend * speed**2 + MU * PRELOAD * sense) / (
            along - MU * across * sense * sign + MASS * slope**2 * along / INERTIA
        )
        if push * sign >= 0:
            break
    return -push * along * slope / INERTIA


def reference() -> tuple[float, float]:
    """Angle by which the crank has turned at the end, and its speed."""
    t, y = 0.0, np.array([pi / 2, -SPEED])
    while t < END:
        sense = np.sign(sin(y[0] - 1e-9))  # it turns backwards: outwards between 0 and pi

        def dead_centre(_: float, y: np.ndarray) -> float:
            return sin(y[0])

        dead_centre.terminal = True
        first = min(1e-3, END - t)  # leaves the last dead centre
        for end, events in ((t + first, None), (END, dead_centre)):
            found = solve_ivp(
                lambda _, y, sense=sense: [y[1], acceleration(y[0], y[1], sense)],
                (t, end),
                y,
                "DOP853",
                events=events,
                rtol=1e-11,
                atol=1e-12,
            )
            t, y = found.t[-1], found.y[:, -1]
    return y[0] - pi / 2, y[1]


@pytest.mark.parametrize(
    ("scheme", "tol", "accuracy"),
    [
        ("", "", 3e-4),
        ("", "TOL 1E-3", 3e-4),
        ("", "TOL 1E-5", 1e-5),
        ("SCHEME RADAU", "", 3e-6),
        ("SCHEME RADAU", "TOL 1E-3", 1e-4),
        ("SCHEME RADAU", "TOL 1E-5", 1e-5),
        ("SCHEME RADAU", "TOL 1E-7", 1e-7),
        ("ACCURACY NORMAL", "", 1e-4),
    ],
)
def test_a_slider_does_not_stop_its_crank(scheme: str, tol: str, accuracy: float, tmp_path: Path) -> None:
    result = run(DECK.format(scheme=scheme, tol=tol), tmp_path)
    angle, speed = reference()
    assert result["1/ANGLE"][-1] == pytest.approx(angle, rel=accuracy)
    assert result["1/SPEED"][-1] == pytest.approx(speed, rel=accuracy)
