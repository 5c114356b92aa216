# SPDX-License-Identifier: BSD-3-Clause
"""Small mechanisms whose motion is known in closed form or from a few ordinary differential equations (rtol
1e-12). SI units."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk


def run_up(
    t: np.ndarray,
    j1: float = 0.01,
    j2: float = 0.08,
    r1: float = 0.05,
    r2: float = 0.1,
    torque: float = 10.0,
    stiffness: float | None = None,
) -> dict[str, np.ndarray | float]:
    """Two wheels started by a torque on the first. Rigid teeth: constant acceleration and tangential force.
    With a mesh `stiffness` k along the circumference the force is F (1 - cos(w t)), w^2 = k (r1^2/j1 +
    r2^2/j2), started unloaded."""
    alpha1 = torque / (j1 + j2 * (r1 / r2) ** 2)
    force = (torque - j1 * alpha1) / r1
    out: dict[str, np.ndarray | float] = {"alpha1": alpha1, "alpha2": alpha1 * r1 / r2, "steady_force": force}
    t = np.asarray(t, float)
    if stiffness is None:
        return out | {
            "force": np.full_like(t, force),
            "angle1": alpha1 * t**2 / 2,
            "angle2": alpha1 * r1 / r2 * t**2 / 2,
        }
    w = math.sqrt(stiffness * (r1**2 / j1 + r2**2 / j2))
    wave = force * (1 - np.cos(w * t))
    # j theta'' = torque - r F integrated twice from rest
    twice = force * (t**2 / 2 - (1 - np.cos(w * t)) / w**2)
    angle1 = (torque * t**2 / 2 - r1 * twice) / j1
    return out | {"omega": w, "force": wave, "angle1": angle1, "angle2": r2 * twice / j2}


def pendulum(t: np.ndarray, length: float = 1.0, gravity: float = 9.81) -> np.ndarray:
    """IFToMM A01: point mass on a massless rod, released at rest from (-length, 0), gravity along -y.
    Positions (n x 2), exact: sin(theta/2) = k sn(K - w t, k) with k = sin(theta_0/2), theta from the lowest
    point."""
    w = math.sqrt(gravity / length)
    m = math.sin(math.pi / 4) ** 2
    sn, _, dn, _ = ellipj(ellipk(m) - w * np.asarray(t, float), m)
    half_sin, half_cos = math.sqrt(m) * sn, dn
    sine, cosine = 2 * half_sin * half_cos, 1 - 2 * half_sin**2
    return np.stack([-length * sine, -length * cosine], axis=-1)


def torque_free_body(t: np.ndarray, inertia=(1.0, 2.0, 3.0), omega=(0.01, 1.0, 0.01)) -> np.ndarray:
    """Body rates (n x 3) of a free rigid body: Euler's equations."""
    j = np.asarray(inertia, float)

    def rhs(_t: float, w: np.ndarray) -> np.ndarray:
        return -np.cross(w, j * w) / j

    return _solve(rhs, t, omega)


def heavy_top(
    t: np.ndarray,
    mass: float = 15.0,
    inertia=(0.234375, 0.46875, 0.234375),
    arm=(0.0, 1.0, 0.0),
    omega=(0.0, 150.0, -4.61538),
    gravity: float = 9.81,
) -> dict[str, np.ndarray]:
    """Top with a fixed point: `inertia` about the centre of mass, `arm` from the fixed point to it (body
    frame, at rest equal to the global one), gravity along -z. Returns the centre of mass (n x 3), body rates
    and the total energy."""
    x = np.asarray(arm, float)
    j0 = np.diag(np.asarray(inertia, float)) + mass * (x @ x * np.eye(3) - np.outer(x, x))

    def rhs(_t: float, y: np.ndarray) -> np.ndarray:
        q, w = y[:4] / np.linalg.norm(y[:4]), y[4:]
        down = _matrix(q).T @ np.array([0.0, 0.0, -mass * gravity])
        rate = np.linalg.solve(j0, np.cross(x, down) - np.cross(w, j0 @ w))
        qdot = 0.5 * np.r_[-q[1:] @ w, q[0] * w + np.cross(q[1:], w)]
        return np.r_[qdot, rate]

    y = _solve(rhs, t, np.r_[1.0, 0.0, 0.0, 0.0, omega])
    q = y[:, :4] / np.linalg.norm(y[:, :4], axis=1)[:, None]
    com = np.array([_matrix(qi) @ x for qi in q])
    energy = 0.5 * np.einsum("ni,ij,nj->n", y[:, 4:], j0, y[:, 4:]) + mass * gravity * com[:, 2]
    return {"com": com, "omega": y[:, 4:], "energy": energy}


def clearance_oscillator_force(x: np.ndarray) -> np.ndarray:
    """Restoring force of the oscillator with clearance 1 on both sides."""
    return np.where(x > 1, x - 1, np.where(x < -1, x + 1, 0.0))


def _matrix(q: np.ndarray) -> np.ndarray:
    """Rotation matrix of a unit quaternion (scalar first)."""
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def _solve(rhs, t: np.ndarray, y0) -> np.ndarray:
    t = np.atleast_1d(np.asarray(t, float))
    sol = solve_ivp(
        rhs, (0.0, max(t[-1], 1e-300)), np.asarray(y0, float), "DOP853", t_eval=t, rtol=1e-12, atol=1e-13
    )
    if not sol.success:
        raise RuntimeError(sol.message)
    return sol.y.T
