# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms for tests/bench/scheme_candidates.py: M (constant), f(q, v), g(q) and their derivatives.

A place q is moved by increments y of n coordinates: translations are added, rotations are R exp(y). Speeds v
are those of y at y = 0, so angular velocities are those of the body:

    v = T(y) y',   M v' = f(q, v) - G(q)^T lambda,   g(q) = 0,   g' = G(q) v
"""

import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

sys.path[:0] = [str(Path(__file__).resolve().parents[1] / "verify" / "oracles")]
import andrews as data  # noqa: E402


def skew(a: np.ndarray) -> np.ndarray:
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def exponential(y: np.ndarray) -> np.ndarray:
    size = y @ y
    angle, k = np.sqrt(size), skew(y)
    if angle < 1e-4:
        return np.eye(3) + (1 - size / 6) * k + (0.5 - size / 24) * k @ k
    return np.eye(3) + np.sin(angle) / angle * k + (1 - np.cos(angle)) / size * k @ k


def logarithm(r: np.ndarray) -> np.ndarray:
    axis = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]]) / 2
    sin = np.sqrt(axis @ axis)
    angle = np.arctan2(sin, (np.trace(r) - 1) / 2)
    return axis * (1 + angle**2 / 6 if sin < 1e-8 else angle / sin)


def rotation_tangent(y: np.ndarray) -> np.ndarray:
    """T with Omega = T(y) y' for R exp(y)."""
    size = y @ y
    angle, k = np.sqrt(size), skew(y)
    if angle < 1e-3:
        return np.eye(3) - (0.5 - size / 24) * k + (1 / 6 - size / 120) * k @ k
    return np.eye(3) - (1 - np.cos(angle)) / size * k + (angle - np.sin(angle)) / (angle * size) * k @ k


class Model:
    name = ""
    n = m = 0
    end = 1.0
    mass: np.ndarray  #: n x n
    place: np.ndarray
    speed: np.ndarray
    rotation: slice | None = None  #: coordinates that form a rotation

    def move(self, q, y):
        return q + y

    def difference(self, q, p):
        """y with p = move(q, y)."""
        return p - q

    def tangent(self, y):
        return np.eye(self.n)

    def bent_force(self, _q, _v):
        """Derivatives of f by increments and by v."""
        return np.zeros((self.n, self.n)), np.zeros((self.n, self.n))

    def applied(self, q, v):
        """Forces without those of gyration."""
        return self.force(q, v)

    def seen(self, q, v, multipliers):
        """Positions, velocities and forces to be compared."""
        return q, v, multipliers

    def start(self):
        """Consistent accelerations and multipliers."""
        return self.balance(self.place, self.speed)

    def balance(self, q, v):
        g = self.jacobian(q)
        whole = np.block([[self.mass, g.T], [g, np.zeros((self.m, self.m))]])
        found = np.linalg.solve(whole, np.r_[self.force(q, v), -self.bending(q, v)])
        return found[: self.n], found[self.n :]

    def energy(self, q, v):
        return 0.5 * v @ self.mass @ v + self.potential(q)


class Top(Model):
    """The heavy top of Brüls and Cardona (2010): node at the centre of mass, three multipliers."""

    name, n, m, end = "top", 6, 3, 0.2
    rotation = slice(3, 6)
    weight = np.array([0, 0, -9.81 * 15.0])
    arm = np.array([0.0, 1.0, 0.0])
    inertia = np.array([0.234375, 0.46875, 0.234375])

    def __init__(self, spin: float = 150.0) -> None:
        self.mass = np.diag(np.r_[15.0, 15.0, 15.0, self.inertia])
        turn = np.array([0, spin, -4.61538])
        self.place = np.r_[self.arm, np.eye(3).ravel()]
        self.speed = np.r_[cross(turn, self.arm), turn]

    def move(self, q, y):
        return np.r_[q[:3] + y[:3], (q[3:].reshape(3, 3) @ exponential(y[3:])).ravel()]

    def difference(self, q, p):
        return np.r_[p[:3] - q[:3], logarithm(q[3:].reshape(3, 3).T @ p[3:].reshape(3, 3))]

    def tangent(self, y):
        t = np.eye(6)
        t[3:, 3:] = rotation_tangent(y[3:])
        return t

    def applied(self, _q, _v):
        return np.r_[self.weight, 0, 0, 0]

    def force(self, _q, v):
        return np.r_[self.weight, -cross(v[3:], self.inertia * v[3:])]

    def bent_force(self, _q, v):
        by_speed = np.zeros((6, 6))
        by_speed[3:, 3:] = skew(self.inertia * v[3:]) - skew(v[3:]) * self.inertia
        return np.zeros((6, 6)), by_speed

    def closure(self, q):
        return q[:3] - q[3:].reshape(3, 3) @ self.arm

    def jacobian(self, q):
        return np.hstack([np.eye(3), q[3:].reshape(3, 3) @ skew(self.arm)])

    def bent_jacobian(self, q, pull):
        """Derivative of G^T pull by increments."""
        out = np.zeros((6, 6))
        out[3:, 3:] = -skew(self.arm) @ skew(q[3:].reshape(3, 3).T @ pull)
        return out

    def bent_rate(self, q, v):
        """Derivative of G v by increments."""
        out = np.zeros((3, 6))
        out[:, 3:] = -q[3:].reshape(3, 3) @ skew(cross(self.arm, v[3:]))
        return out

    def bending(self, q, v):
        """g'' less G v'."""
        return q[3:].reshape(3, 3) @ cross(v[3:], cross(self.arm, v[3:]))

    def potential(self, q):
        return -self.weight @ q[:3]

    def seen(self, q, v, multipliers):
        return q[:3], v[:3], multipliers


class Plane(Model):
    """Bodies in a plane, x, y and an angle each; joints hold a point of one on one of another; -1: ground."""

    def __init__(self, masses, inertias, joints) -> None:
        self.bodies = len(masses)
        self.n, self.m = 3 * self.bodies, 2 * len(joints)
        self.mass = np.diag(np.column_stack([masses, masses, inertias]).ravel())
        table = [(i, si, 1.0) for i, si, _, _ in joints] + [(j, sj, -1.0) for _, _, j, sj in joints]
        kept = [(k % len(joints), *row) for k, row in enumerate(table) if row[0] >= 0]
        self.row = np.array([k for k, *_ in kept])
        self.body = np.array([i for _, i, _, _ in kept])
        self.arm = np.array([s for _, _, s, _ in kept], float)
        self.sign = np.array([w for *_, w in kept])
        self.ground = np.zeros((len(joints), 2))
        for k, (i, si, j, sj) in enumerate(joints):
            for b, s, w in ((i, si, 1.0), (j, sj, -1.0)):
                if b < 0:
                    self.ground[k] += w * np.asarray(s, float)
        self.constant = np.zeros((self.m, self.n))
        for axis in range(2):
            np.add.at(self.constant, (2 * self.row + axis, 3 * self.body + axis), self.sign)
        self.gravity = np.zeros(self.n)

    def arms(self, q):
        a = q[3 * self.body + 2]
        c, s = np.cos(a), np.sin(a)
        x, y = self.arm.T
        return np.column_stack([c * x - s * y, s * x + c * y])

    def by_joint(self, values):
        out = np.zeros_like(self.ground)
        np.add.at(out, self.row, values)
        return out

    def closure(self, q):
        point = self.arms(q) + q.reshape(-1, 3)[self.body, :2]
        return (self.ground + self.by_joint(self.sign[:, None] * point)).ravel()

    def jacobian(self, q):
        out, arm = self.constant.copy(), self.arms(q)
        np.add.at(out, (2 * self.row, 3 * self.body + 2), -self.sign * arm[:, 1])
        np.add.at(out, (2 * self.row + 1, 3 * self.body + 2), self.sign * arm[:, 0])
        return out

    def bent_jacobian(self, q, pull):
        out, along = np.zeros((self.n, self.n)), (self.arms(q) * pull.reshape(-1, 2)[self.row]).sum(1)
        np.add.at(out, (3 * self.body + 2, 3 * self.body + 2), -self.sign * along)
        return out

    def bent_rate(self, q, v):
        out, arm = np.zeros((2 * len(self.ground), self.n)), self.arms(q)
        turn = self.sign * v[3 * self.body + 2]
        np.add.at(out, (2 * self.row, 3 * self.body + 2), -turn * arm[:, 0])
        np.add.at(out, (2 * self.row + 1, 3 * self.body + 2), -turn * arm[:, 1])
        return out

    def bending(self, q, v):
        turn = self.sign * v[3 * self.body + 2] ** 2
        return self.by_joint(-turn[:, None] * self.arms(q)).ravel()

    def force(self, _q, _v):
        return self.gravity

    def potential(self, q):
        return -self.gravity @ q

    def assemble(self, q, fixed):
        """The place near q that closes the joints, with the coordinates in `fixed` as they are."""
        free = np.setdiff1d(np.arange(self.n), fixed)
        for _ in range(30):
            q = q.copy()
            q[free] -= np.linalg.lstsq(self.jacobian(q)[:, free], self.closure(q), rcond=None)[0]
        return q

    def fit(self, q, fixed, values):
        """Speeds that keep the joints closed, with some of them given."""
        free = np.setdiff1d(np.arange(self.n), fixed)
        g, v = self.jacobian(q), np.zeros(self.n)
        v[fixed] = values
        v[free] = np.linalg.lstsq(g[:, free], -g[:, fixed] @ v[fixed], rcond=None)[0]
        return v


class Andrews(Plane):
    """Andrews' mechanism, as decks/mechanisms/andrews_squeezer.dat: seven bodies, ten joints."""

    name, end = "andrews", 0.03

    def __init__(self) -> None:
        d = data
        # arms in the axes whose angles are TURN @ q, from the centre of mass of each body
        e_by_2, e_by_3 = (-d.D + d.DA, 0.0), (-d.SB, -d.SS + d.SA)
        joints = [
            (-1, (0, 0), 0, (-d.RA, 0.0)),
            (0, (d.RR - d.RA, 0.0), 1, (d.DA, 0.0)),
            (-1, d.B, 2, (-d.SB, d.SA)),
            (2, e_by_3, 1, e_by_2),
            (-1, d.A, 4, (-d.TA, -d.TB)),
            (4, (d.ZT - d.TA, -d.TB), 3, (0.0, d.E - d.EA)),
            (3, (0.0, -d.EA), 1, e_by_2),
            (-1, d.A, 6, (-d.UA, d.UB)),
            (6, (-d.UA, -d.U + d.UB), 5, (-(d.ZF - d.FA), 0.0)),
            (5, (d.FA, 0.0), 1, e_by_2),
        ]
        super().__init__(d.MASS, d.INERTIA, joints)
        angles = d.TURN @ d.assemble(d.START)
        origin = {2: d.B, 3: d.A, 4: d.A, 5: d.A, 6: d.A}
        q = np.zeros((7, 3))
        for k in range(7):
            q[k, :2] = d.point(str(k + 1), angles).sum(1) + origin.get(k, 0)
            q[k, 2] = angles[k]
        self.place, self.speed = q.ravel(), np.zeros(21)
        self.spring_arm = np.array([d.SD - d.SB, -d.SC + d.SA])

    def pull(self, q):
        c, s = np.cos(q[8]), np.sin(q[8])
        x, y = self.spring_arm
        arm = np.array([c * x - s * y, s * x + c * y])
        reach = q[6:8] + arm - data.C
        length = np.sqrt(reach @ reach)
        along = np.array([[1, 0, -arm[1]], [0, 1, arm[0]]])
        return arm, reach, length, along

    def force(self, q, _v):
        _, reach, length, along = self.pull(q)
        out = np.zeros(21)
        out[2] = data.TORQUE
        out[6:9] = -data.C0 * (1 - data.L0 / length) * reach @ along
        return out

    def bent_force(self, q, _v):
        arm, reach, length, along = self.pull(q)
        stiff = (1 - data.L0 / length) * np.eye(2) + data.L0 / length**3 * np.outer(reach, reach)
        out = np.zeros((21, 21))
        out[6:9, 6:9] = -data.C0 * along.T @ stiff @ along
        out[8, 8] += data.C0 * (1 - data.L0 / length) * reach @ arm
        return out, np.zeros((21, 21))

    def potential(self, q):
        return 0.5 * data.C0 * (self.pull(q)[2] - data.L0) ** 2 - data.TORQUE * q[2]

    def seen(self, q, v, multipliers):
        return q[[2, 8, 14]], v[[2, 8, 14]], multipliers[:2]


class Crank(Plane):
    """A crank with a flywheel, a rod and a slider; no drive."""

    name, end = "crank", 1.0

    def __init__(self) -> None:
        joints = [(-1, (0, 0), 0, (0, 0)), (0, (0.2, 0), 1, (-0.3, 0)), (1, (0.3, 0), 2, (0, 0))]
        super().__init__([1, 0.5, 3.0], [0.1, 0.015, 0.01], joints)
        # the slide: y of the third body 0.1, its angle 0
        self.m += 2
        self.place = self.assemble(np.array([0, 0, 0, 0.5, 0.05, 0.2, 0.8, 0.1, 0]), [2])
        self.speed = self.fit(self.place, [2], [10.0])

    def closure(self, q):
        return np.r_[super().closure(q), q[7] - 0.1, q[8]]

    def jacobian(self, q):
        rows = np.zeros((2, 9))
        rows[0, 7] = rows[1, 8] = 1
        return np.vstack([super().jacobian(q), rows])

    def bent_jacobian(self, q, pull):
        return super().bent_jacobian(q, pull[:6])

    def bent_rate(self, q, v):
        return np.vstack([super().bent_rate(q, v), np.zeros((2, 9))])

    def bending(self, q, v):
        return np.r_[super().bending(q, v), 0, 0]

    def seen(self, q, v, multipliers):
        return q[[2, 6]], v[[2, 6]], multipliers[:7]


class Gears(Plane):
    """Two wheels with masses off their axes. The path of the teeth s = r1 a1 + r2 a2 + e sin(a1) is 0 with
    rigid ones; elastic ones push with k (1 + 0.3 cos(20 a1)) s and a damper, under a load."""

    end = 1.0

    def __init__(self, elastic: bool, stiff: float = 2e6) -> None:
        self.elastic = elastic
        self.name = ("teeth" if stiff < 1e8 else "stiff") if elastic else "gears"
        joints = [(-1, (0, 0), 0, (-0.01, 0)), (-1, (0.15, 0), 1, (-0.02, 0))]
        super().__init__([2.0, 4.0], [0.0025, 0.02], joints)
        self.radii, self.wave = np.array([0.05, 0.1]), 0.01
        self.gravity = np.array([0, -2 * 9.81, 0, 0, -4 * 9.81, 0])
        self.stiff, self.damp = stiff, 40.0
        if elastic:
            self.end = 0.05
            self.gravity[2], self.gravity[5] = 1.0, 2.0
        else:
            self.m += 1
        self.place = np.array([0.01, 0, 0, 0.17, 0, 0])
        ratio = (self.radii[0] + self.wave) / self.radii[1]
        turn = 100.0 if elastic else 10.0
        self.speed = np.array([0, 0.01 * turn, turn, 0, -0.02 * ratio * turn, -ratio * turn])
        if elastic:  # teeth that carry the load
            self.place[5] = 20.0 / (self.stiff * 1.3) / self.radii[1]
            self.place = self.assemble(self.place, [2, 5])
            self.speed = self.fit(self.place, [2, 5], [turn, -ratio * turn])

    def path(self, q):
        """s, ds by the two angles, its second derivative by the first."""
        slope = np.array([self.radii[0] + self.wave * np.cos(q[2]), self.radii[1]])
        return self.radii @ q[[2, 5]] + self.wave * np.sin(q[2]), slope, -self.wave * np.sin(q[2])

    def mesh(self, q):
        return self.stiff * (1 + 0.3 * np.cos(20 * q[2])), -6 * self.stiff * np.sin(20 * q[2])

    def tooth(self, q, v):
        s, slope, _ = self.path(q)
        return self.mesh(q)[0] * s + self.damp * slope @ v[[2, 5]]

    def force(self, q, v):
        out = self.gravity.copy()
        if self.elastic:
            out[[2, 5]] -= self.tooth(q, v) * self.path(q)[1]
        return out

    def bent_force(self, q, v):
        by_place, by_speed = np.zeros((6, 6)), np.zeros((6, 6))
        if self.elastic:
            s, slope, bend = self.path(q)
            stiff, more = self.mesh(q)
            push = stiff * slope
            push[0] += more * s + self.damp * bend * v[2]
            by_place[np.ix_([2, 5], [2, 5])] = -np.outer(slope, push)
            by_place[2, 2] -= self.tooth(q, v) * bend
            by_speed[np.ix_([2, 5], [2, 5])] = -self.damp * np.outer(slope, slope)
        return by_place, by_speed

    def closure(self, q):
        return super().closure(q) if self.elastic else np.r_[super().closure(q), self.path(q)[0]]

    def jacobian(self, q):
        if self.elastic:
            return super().jacobian(q)
        row = np.zeros(6)
        row[[2, 5]] = self.path(q)[1]
        return np.vstack([super().jacobian(q), row])

    def bent_jacobian(self, q, pull):
        out = super().bent_jacobian(q, pull[:4])
        if not self.elastic:
            out[2, 2] += pull[4] * self.path(q)[2]
        return out

    def bent_rate(self, q, v):
        out = super().bent_rate(q, v)
        if self.elastic:
            return out
        row = np.zeros(6)
        row[2] = self.path(q)[2] * v[2]
        return np.vstack([out, row])

    def bending(self, q, v):
        out = super().bending(q, v)
        return out if self.elastic else np.r_[out, self.path(q)[2] * v[2] ** 2]

    def seen(self, q, v, multipliers):
        if self.name == "stiff":  # its tooth force is a vibration that no step resolves
            return q[[2, 5]], v[[2, 5]], multipliers[:4]
        return q[[2, 5]], v[[2, 5]], np.r_[self.tooth(q, v), multipliers[:4]] if self.elastic else multipliers


class Pendulum(Plane):
    """One or two bars, released from the horizontal."""

    def __init__(self, bars: int = 1) -> None:
        self.name, self.end = ("pendulum", 2.0) if bars == 1 else ("double pendulum", 2.0)
        joints = [(-1, (0, 0), 0, (-1, 0)), (0, (0, 0), 1, (-1, 0))][:bars]
        super().__init__([2.0] * bars, [0.1] * bars, joints)
        self.gravity = np.tile([0, -2 * 9.81, 0], bars).astype(float)
        self.place = np.array([1.0, 0, 0, 2.0, 0, 0][: 3 * bars])
        self.speed = np.zeros(3 * bars)


MODELS = {
    "top": Top,
    "andrews": Andrews,
    "crank": Crank,
    "gears": lambda: Gears(False),
    "teeth": lambda: Gears(True),
    "stiff": lambda: Gears(True, 2e9),
    "double": lambda: Pendulum(2),
}


def truth(model: Model, times: np.ndarray):
    """Index 1 with projections of y and v by Runge-Kutta of order 8; rotations in steps of their own."""
    q, v, rows = model.place, model.speed, []
    for begin, end in pairwise(times):
        pieces = 20 if model.rotation else 1
        for k in range(pieces):
            span = (begin + (end - begin) * k / pieces, begin + (end - begin) * (k + 1) / pieces)

            def slope(_t, z, q=q):
                y, v = z[: model.n], z[model.n :]
                rate = np.linalg.solve(model.tangent(y), v)
                return np.r_[rate, model.balance(model.move(q, y), v)[0]]

            z = solve_ivp(slope, span, np.r_[np.zeros(model.n), v], "DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
            q, v = model.move(q, z[: model.n]), z[model.n :]
            for _ in range(3):
                g = model.jacobian(q)
                fit = np.linalg.solve(
                    np.block([[model.mass, g.T], [g, np.zeros((model.m, model.m))]]),
                    np.c_[np.r_[np.zeros(model.n), -model.closure(q)], np.r_[np.zeros(model.n), -g @ v]],
                )
                q, v = model.move(q, fit[: model.n, 0]), v + fit[: model.n, 1]
        rows.append(model.seen(q, v, model.balance(q, v)[1]))
    return [np.array(part) for part in zip(*rows, strict=True)]


def truth_near(model: Model, time: float):
    """q and v a little before or after the start."""

    def slope(_t, z):
        y, v = z[: model.n], z[model.n :]
        q = model.move(model.place, y)
        return np.r_[np.linalg.solve(model.tangent(y), v), model.balance(q, v)[0]]

    z = np.r_[np.zeros(model.n), model.speed]
    z = solve_ivp(slope, (0, time), z, "DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    return model.move(model.place, z[: model.n]), z[model.n :]
