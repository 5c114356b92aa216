# SPDX-License-Identifier: BSD-3-Clause
"""The valve train of decks/mechanisms/valve_train.dat as two ordinary differential equations: the rocker's
angle and the valve's lift. The cam is known by the path of the roller's centre only, found from the rocker's
law and searched by scipy; contacts are k d + c d', never less than zero. SI units."""

from __future__ import annotations

import cmath
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

SPEED = 300.0
PIVOT = complex(0.03, 0.03)
BASE, ROLLER, PAD = 0.018, 0.009, 0.008
ROCKER_INERTIA, VALVE_MASS = 6e-5, 0.12
SPRING, PRELOAD = 3e4, 3e4 * 0.01
CONTACT, DAMPER = 5e7, 200.0
#: segments of the motion from a cam angle of 60 degrees on: width and lift at the end, degrees
PHASE, SEGMENTS = 60.0, ((70.0, 15.0), (20.0, 15.0), (70.0, 0.0), (200.0, 0.0))
ROLLER_REFERENCE, PAD_REFERENCE, VALVE_REFERENCE = complex(0, 0.027), complex(0.06, 0.03), 0.022


def modified_sine(x: float) -> tuple[float, float]:
    """Rise from 0 to 1 and its slope: quarter sines of the acceleration, written from their integrals."""
    k = 1 / (4 + math.pi)
    if 0.125 < x < 0.875:
        inner = (4 * math.pi * x + math.pi) / 3
        return k * (2 + math.pi * x - 9 / 4 * math.sin(inner)), k * math.pi * (1 - 3 * math.cos(inner))
    value = k * (math.pi * x - math.sin(4 * math.pi * x) / 4) + (4 * k if x > 0.5 else 0)
    return value, k * math.pi * (1 - math.cos(4 * math.pi * x))


def lift(turn: float) -> tuple[float, float]:
    """Angle of the rocker that the cam is made for, radians, and its derivative by the cam's turn."""
    angle, start = (math.degrees(turn) - PHASE) % 360, SEGMENTS[-1][1]
    for width, end in SEGMENTS:
        if angle <= width:
            value, slope = modified_sine(angle / width)
            return math.radians(start + (end - start) * value), (end - start) * slope / width
        angle, start = angle - width, end
    return math.radians(start), 0.0


def roller(angle: float) -> complex:
    """Centre of the roller when the rocker has turned by `angle`, which lifts it."""
    return PIVOT + (ROLLER_REFERENCE - PIVOT) * cmath.exp(-1j * angle)


def path(s: float) -> tuple[complex, complex]:
    """The roller's centre in the cam that has turned by s, and its derivative."""
    angle, slope = lift(s)
    turned = cmath.exp(-1j * s)
    centre = roller(angle)
    return centre * turned, (-1j * slope * (centre - PIVOT) - 1j * centre) * turned


def nearest(q: complex, guess: float) -> tuple[float, complex]:
    """Distance of q from the path, outwards positive, and the outward normal; near the parameter `guess`."""

    def along(s: float) -> float:
        place, tangent = path(s)
        return ((place - q) * tangent.conjugate()).real

    place, tangent = path(brentq(along, guess - 0.05, guess + 0.05, xtol=1e-15))
    normal = tangent / abs(tangent) * 1j
    if (normal * place.conjugate()).real < 0:
        normal = -normal
    return ((q - place) * normal.conjugate()).real, normal


def contact(gap: float, rate: float) -> float:
    return max(0.0, -CONTACT * gap - DAMPER * rate) if gap < 0 else 0.0


def forces(t: float, y: np.ndarray) -> dict[str, float]:
    angle, valve, angle_rate, valve_rate = y
    turn = SPEED * t
    centre = roller(angle)
    gap, normal = nearest(centre * cmath.exp(-1j * turn), turn)
    normal *= cmath.exp(1j * turn)
    velocity = -1j * (centre - PIVOT) * angle_rate - 1j * centre * SPEED
    cam = contact(gap, (velocity * normal.conjugate()).real)
    pad = PIVOT + (PAD_REFERENCE - PIVOT) * cmath.exp(-1j * angle)
    pad_velocity = -1j * (pad - PIVOT) * angle_rate
    # the valve moves down by `valve`; its end is a horizontal face below the pad
    clearance = (pad.imag - PAD) - (VALVE_REFERENCE - valve)
    push = contact(clearance, pad_velocity.imag + valve_rate)
    moment = (cam * normal * (-1j * (centre - PIVOT)).conjugate()).real
    moment += push * (-1j * (pad - PIVOT)).imag
    return {"cam": cam, "valve": push, "moment": moment}


def rates(t: float, y: np.ndarray) -> np.ndarray:
    f = forces(t, y)
    return np.array(
        [y[2], y[3], f["moment"] / ROCKER_INERTIA, (f["valve"] - PRELOAD - SPRING * y[1]) / VALVE_MASS]
    )


def start() -> np.ndarray:
    """At rest on the base circle, pressed together by the preload."""
    # moments of both contacts about the pivot balance
    y = np.zeros(4)
    for _ in range(60):
        pad = PIVOT + (PAD_REFERENCE - PIVOT) * cmath.exp(-1j * y[0])
        push = PRELOAD + SPRING * y[1]
        centre = roller(y[0])
        normal = centre / abs(centre)
        cam = -push * (-1j * (pad - PIVOT)).imag / (normal * (-1j * (centre - PIVOT)).conjugate()).real
        gap = abs(centre) - (BASE + ROLLER)
        # the gap must be −cam/k: move the rocker by the difference over its lever
        y[0] += (-cam / CONTACT - gap) / (normal * (-1j * (centre - PIVOT)).conjugate()).real
        pad = PIVOT + (PAD_REFERENCE - PIVOT) * cmath.exp(-1j * y[0])
        y[1] = VALVE_REFERENCE - (pad.imag - PAD) - push / CONTACT
    return y


def simulate(times: np.ndarray, rtol: float = 1e-9) -> dict[str, np.ndarray]:
    """Rocker angle, valve lift and both contact forces at the times, which begin after the cam has turned by
    PHASE - 1 degrees: before, nothing moves."""
    times = np.asarray(times, float)
    begin = math.radians(PHASE - 1) / SPEED
    done = solve_ivp(
        rates,
        (begin, times[-1]),
        start(),
        method="DOP853",
        t_eval=times,
        rtol=rtol,
        atol=1e-12,
        max_step=2e-5,
    )
    assert done.success
    both = [forces(t, y) for t, y in zip(done.t, done.y.T, strict=True)]
    return {
        "angle": done.y[0],
        "valve": done.y[1],
        "cam_force": np.array([f["cam"] for f in both]),
        "valve_force": np.array([f["valve"] for f in both]),
    }
