# SPDX-License-Identifier: BSD-3-Clause
"""Planetary gear sets as written-out linear systems: free vibration (Lin and Parker 1999) and how planets
share a load when a pin stands wrong.

Both count displacements along lines of action. A sun tooth of planet n closes by

delta_sn = y_s cos(psi_n - a) - x_s sin(psi_n - a) - zeta_n sin a - eta_n cos a + u_s + u_n

and a ring tooth by

delta_rn = y_r cos(psi_n + a) - x_r sin(psi_n + a) + zeta_n sin a - eta_n cos a + u_r - u_n

with u = (base radius) x (turn), zeta and eta the planet's radial and tangential displacements and psi_n its
place (Lin and Parker, Analytical characterization of the unique properties of planetary gear free
vibration, Journal of Vibration and Acoustics 121, 1999)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh


@dataclass(frozen=True)
class Planetary:
    """Data of the paper's example, in SI: masses, I/r**2 and stiffnesses; carrier c, ring r, sun s, planet
    p."""

    planets: int = 3
    mass_c: float = 5.43
    mass_r: float = 2.35
    mass_s: float = 0.4
    mass_p: float = 0.66
    inertia_c: float = 6.29
    inertia_r: float = 3.00
    inertia_s: float = 0.39
    inertia_p: float = 0.61
    mesh_sun: float = 5e8
    mesh_ring: float = 5e8
    bearing: float = 1e8
    ring_torsion: float = 1e9
    alpha: float = np.radians(24.6)


def mesh_rows(p: Planetary, n: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Closing of the sun's and the ring's teeth of planet n per unknown. Unknowns: x, y, u of carrier, ring
    and sun, then zeta, eta, u of each planet."""
    psi, a = 2 * np.pi * n / p.planets, p.alpha
    sun, ring = np.zeros(count), np.zeros(count)
    sun[6:9] = -np.sin(psi - a), np.cos(psi - a), 1
    ring[3:6] = -np.sin(psi + a), np.cos(psi + a), 1
    first = 9 + 3 * n
    sun[first : first + 3] = -np.sin(a), -np.cos(a), 1
    ring[first : first + 3] = np.sin(a), -np.cos(a), -1
    return sun, ring


def matrices(p: Planetary) -> tuple[np.ndarray, np.ndarray]:
    """Mass and stiffness, (9 + 3 planets) square; 18 x 18 for three planets. The carrier does not turn."""
    count = 9 + 3 * p.planets
    mass = np.zeros(count)
    mass[0:9] = (
        *(p.mass_c, p.mass_c, p.inertia_c),
        *(p.mass_r, p.mass_r, p.inertia_r),
        *(p.mass_s, p.mass_s, p.inertia_s),
    )
    stiffness = np.diag([p.bearing, p.bearing, 0.0] * 3 + [0.0] * (3 * p.planets))
    stiffness[5, 5] = p.ring_torsion
    for n in range(p.planets):
        first, psi = 9 + 3 * n, 2 * np.pi * n / p.planets
        mass[first : first + 3] = p.mass_p, p.mass_p, p.inertia_p
        sun, ring = mesh_rows(p, n, count)
        radial, tangential = np.zeros(count), np.zeros(count)
        radial[[0, 1, first]] = np.cos(psi), np.sin(psi), -1
        tangential[[0, 1, 2, first + 1]] = -np.sin(psi), np.cos(psi), 1, -1
        for row, k in (
            (sun, p.mesh_sun),
            (ring, p.mesh_ring),
            (radial, p.bearing),
            (tangential, p.bearing),
        ):
            stiffness += k * np.outer(row, row)
    return np.diag(mass), stiffness


def frequencies(p: Planetary) -> np.ndarray:
    """Natural frequencies in Hz, rising."""
    mass, stiffness = matrices(p)
    return np.sqrt(np.maximum(eigh(stiffness, mass, eigvals_only=True), 0.0)) / (2 * np.pi)


def load_sharing(
    force: float,
    error: np.ndarray,
    places: np.ndarray,
    mesh_sun: float,
    mesh_ring: float,
    sun_support: float,
    alpha: float,
    radial_closes: bool = True,
) -> np.ndarray:
    """Normal forces of the sun's teeth (one for each planet): ring and carrier held, sun on springs
    `sun_support` in x and y, its torque over its base radius is `force`, pin n stands `error[n]` off along
    its circle, in the positive sense.

    Unknowns x_s, y_s, u_s and u_n of the planets. `radial_closes=False` leaves out of the closing of a
    tooth what the sun moves along the line of centres, as Cardona (1995) does: there the ratio does not
    follow a change of the centre distance, while the force keeps its radial part."""
    planets = len(places)
    n = 3 + planets
    matrix, right = np.zeros((n, n)), np.zeros(n)
    matrix[0, 0] = matrix[1, 1] = sun_support
    right[2] = force
    for i, (psi, e) in enumerate(zip(places, error, strict=True)):
        line = np.zeros(n)  # the direction of the force on sun and planet
        line[[0, 1, 2, 3 + i]] = -np.sin(psi - alpha), np.cos(psi - alpha), 1, 1
        closing = line.copy()
        if not radial_closes:
            closing[:2] = np.array([-np.sin(psi), np.cos(psi)]) * np.cos(alpha)
        ring = np.zeros(n)
        ring[3 + i] = -1
        opened = -e * np.cos(alpha)
        matrix += mesh_sun * np.outer(line, closing) + mesh_ring * np.outer(ring, ring)
        right -= (mesh_sun * line + mesh_ring * ring) * opened
    u = np.linalg.solve(matrix, right)
    forces = []
    for i, (psi, e) in enumerate(zip(places, error, strict=True)):
        direction = np.array([-np.sin(psi - alpha), np.cos(psi - alpha)])
        if not radial_closes:
            direction = np.array([-np.sin(psi), np.cos(psi)]) * np.cos(alpha)
        forces.append(mesh_sun * (direction @ u[:2] + u[2] + u[3 + i] - e * np.cos(alpha)))
    return np.array(forces)
