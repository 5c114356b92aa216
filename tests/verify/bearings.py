# SPDX-License-Identifier: BSD-3-Clause
"""Rolling bearings by themselves: contacts by the formulas of Harris and Kotzalas with elliptic integrals
of scipy, displacements of points on the rings as vectors, and equilibrium where the energy is least. Metres
and newtons."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, minimize, root
from scipy.spatial.transform import Rotation
from scipy.special import ellipe, ellipk

YOUNG, POISSON = 206e9, 0.3
MODULUS = YOUNG / (2 * (1 - POISSON**2))


def point_contact(along: float, across: float) -> float:
    """K of Q = K δ^1.5 for sums of curvatures (Harris and Kotzalas, ch. 6: F(ρ) and dimensionless δ*)."""
    total = along + across
    difference = (across - along) / total

    def excess(kappa: float) -> float:
        m = 1 - 1 / kappa**2
        return ((kappa**2 + 1) * ellipe(m) - 2 * ellipk(m)) / ((kappa**2 - 1) * ellipe(m)) - difference

    kappa = brentq(excess, 1.0001, 1e4, xtol=1e-14, rtol=1e-15)
    m = 1 - 1 / kappa**2
    star = 2 * ellipk(m) / np.pi * (np.pi / (2 * kappa**2 * ellipe(m))) ** (1 / 3)
    # δ = δ* (3 Q/(2 Σρ E*))^(2/3) Σρ/2 with E* of both bodies
    return (star * (3 / (2 * total * MODULUS)) ** (2 / 3) * total / 2) ** -1.5


@dataclass
class Bearing:
    """Along `axis` (+1 or -1, of x), its middle at x = `at`; azimuths from -z when `down`."""

    count: int
    diameter: float
    pitch: float
    length: float = 0.0
    conformity: tuple[float, float] = (0.52, 0.53)
    angle: float = 0.0
    clearance: float = 0.0
    preload: float = 0.0
    axis: int = 1
    at: float = 0.0
    slices: int = 30
    approach: float = 0.0

    def __post_init__(self) -> None:
        self.exponent = 10 / 9 if self.length else 1.5
        if self.length:
            self.stiffness = 35948e6 * self.length ** (8 / 9) / self.slices
        else:
            fi, fo = self.conformity
            d, self.open = self.diameter, (sum(self.conformity) - 1) * self.diameter
            cosine = 1 - self.clearance / (2 * self.open) if self.clearance > 0 else np.cos(self.angle)
            gamma = d * cosine / self.pitch
            inner = point_contact((2 - 1 / fi) / d, 2 / (d * (1 - gamma)))
            outer = point_contact((2 - 1 / fo) / d, 2 / (d * (1 + gamma)))
            self.stiffness = (inner ** (-2 / 3) + outer ** (-2 / 3)) ** -1.5
            self.groove = self.pitch / 2 + (fi - 0.5) * d * cosine
        if self.preload:
            thrust = lambda a: self.axis * self.force(np.array([a * self.axis, 0, 0, 0, 0, 0]))[0]  # noqa: E731
            self.approach = brentq(lambda a: thrust(a) - self.preload, 0, 0.01 * self.diameter, xtol=1e-18)

    def penetrations(self, q: np.ndarray) -> np.ndarray:
        """Of every ball, or slice of a roller, by displacements and rotation vector of the ring's node."""
        azimuth = 2 * np.pi * np.arange(self.count) / self.count
        e = np.array([self.axis, 0.0, 0.0])
        second = np.array([0.0, 0.0, -1.0])
        n = np.outer(np.cos(azimuth), second) + np.outer(np.sin(azimuth), np.cross(e, second))
        turn = Rotation.from_rotvec(q[3:]).as_matrix()
        move = q[:3] + self.approach * e + (turn - np.eye(3)) @ [self.at, 0, 0]
        tilt = np.cross(e, turn @ e)
        if not self.length:
            shift = move + np.cross(tilt, self.groove * n)
            start = self.open * (np.sin(self.angle) * e + np.cos(self.angle) * n) - self.clearance / 2 * n
            # only the axial part of a ring's tilt moves its grooves along the ball's plane
            a = start @ e + shift @ e
            r = np.einsum("ij,ij->i", start, n) + n @ move
            return np.hypot(a, r) - self.open
        x = self.length * ((np.arange(self.slices) + 0.5) / self.slices - 0.5)
        share = 0.00045 if self.angle else 0.00035
        drop = share * self.diameter * np.log(1 / (1 - (2 * x / self.length) ** 2))
        normal = np.sin(self.angle) * e + np.cos(self.angle) * n
        roller = np.cos(self.angle) * e - np.sin(self.angle) * n
        places = self.pitch / 2 * n[:, None] + x[None, :, None] * roller[:, None]
        shift = move + np.cross(tilt, places)
        gap = self.clearance / 2 * np.cos(self.angle) + 2 * drop
        return np.einsum("ijk,ik->ij", shift, normal) - gap

    def energy(self, q: np.ndarray) -> float:
        pressed = np.maximum(self.penetrations(q), 0)
        return float(self.stiffness * (pressed ** (self.exponent + 1)).sum() / (self.exponent + 1))

    def loads(self, q: np.ndarray) -> np.ndarray:
        """Of the elements."""
        each = self.stiffness * np.maximum(self.penetrations(q), 0) ** self.exponent
        return each.sum(axis=1) if self.length else each

    def force(self, q: np.ndarray) -> np.ndarray:
        """Forces and moments with which it resists, by differences of the penetrations."""
        total = np.zeros(6)
        each = self.stiffness * np.maximum(self.penetrations(q), 0) ** self.exponent
        for i in range(6):
            step = 1e-9 if i < 3 else 1e-7
            ahead, behind = q.copy(), q.copy()
            ahead[i] += step
            behind[i] -= step
            total[i] = (each * (self.penetrations(ahead) - self.penetrations(behind))).sum() / (2 * step)
        return total


def equilibrium(bearings: list[Bearing], load: np.ndarray, free: list[int]) -> np.ndarray:
    """Displacements and rotations about x, y, z under a load; those that are not free are 0."""
    scale = np.array([1e-5] * 3 + [1e-4] * 3)[free]

    def whole(x: np.ndarray) -> np.ndarray:
        q = np.zeros(6)
        q[free] = x * scale
        return q

    def energy(x: np.ndarray) -> float:
        q = whole(x)
        return sum(b.energy(q) for b in bearings) - float(load @ q)

    def rest(x: np.ndarray) -> np.ndarray:
        q = whole(x)
        return ((sum(b.force(q) for b in bearings) - load)[free] * scale) * 1e3

    start = minimize(energy, load[free] / np.abs(load).max(), method="Nelder-Mead", options={"maxiter": 4000})
    found = root(rest, start.x, tol=1e-14)
    return whole(found.x)


DEEP_GROOVE = Bearing(9, 12.7e-3, 65e-3, conformity=(0.52, 0.52), clearance=15e-6)
ANGULAR = Bearing(16, 22.23e-3, 125.26e-3, conformity=(0.5232, 0.5232), angle=np.radians(40))
CYLINDRICAL = Bearing(14, 10e-3, 54e-3, length=9.6e-3, clearance=10e-6)
TAPERED = [
    Bearing(18, 12e-3, 80e-3, 16e-3, angle=np.radians(15), preload=1500, axis=1, at=-0.02),
    Bearing(18, 12e-3, 80e-3, 16e-3, angle=np.radians(15), preload=1500, axis=-1, at=0.02),
]
