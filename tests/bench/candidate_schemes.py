# SPDX-License-Identifier: BSD-3-Clause
"""Time integration schemes for tests/bench/scheme_candidates.py, with fixed steps and counts of their work.

alpha     generalised-alpha of index 3 on the Lie group, as docs/theory.md, Time, has it
alpha-ggl the same with velocities that fit (M. Arnold, O. Brüls, A. Cardona, Numer. Math. 129 (2015)
          149-179), the stabilised index 2 of C. W. Gear, B. Leimkuhler, G. K. Gupta, J. Comput. Appl. Math.
          12 (1985) 77-90: the increment is less h M^-1 G(q_n)^T eta, and G v = 0 at the end (M^-1 makes
          units fit)
bdf2..5   backward differences of the increments of the step and of v, index 3
bdf2-ggl..5 with v less M^-1 G^T eta in y'
rattle    RATTLE (H. C. Andersen, J. Comput. Phys. 52 (1983) 24-34); rotations by the variational
          Störmer-Verlet method on the group (E. Hairer, C. Lubich, G. Wanner, Geometric Numerical
          Integration, 2006, VII.5)
radau     Radau IIA of three stages as docs/theory.md has it: index 3, velocities, accelerations and
          multipliers fitted at the end of each step

Multistep schemes start with exact values of the past, at no cost.
"""

from collections import Counter

import numpy as np
from candidate_models import Model, skew, truth_near
from scipy.linalg import lu_factor, lu_solve


class Iteration:
    """Newton's method with new factors for each correction, or with kept ones. These serve until a step costs
    more than the average since they were made, that included (docs/decisions/0024-kept-factors.md)."""

    renewal = 8  #: corrections that cost as much as new factors, in a chain of 100 links (the same)
    slow = 0.5  #: shrinkage of a correction that asks for new factors within a step

    def __init__(self, work: Counter, kind: str, keep: bool, precision: float) -> None:
        self.work, self.kind, self.keep, self.precision = work, kind, keep, precision
        self.factors = None
        self.spent = self.age = self.corrections = 0

    def correct(self, right):
        self.corrections += 1
        for kind in self.kind.split("+"):
            self.work["solve " + kind] += 1
        return lu_solve(self.factors, right, check_finite=False)

    def renew(self, matrix, tangents: int = 1, of: str = "tangent"):
        self.factors = lu_factor(matrix, check_finite=False)
        self.spent, self.age = self.renewal, 0
        self.work[of] += tangents
        for kind in self.kind.split("+"):
            self.work["factor " + kind] += 1

    def end_step(self):
        self.spent, self.age = self.spent + self.corrections, self.age + 1
        if self.corrections > self.spent / self.age:
            self.factors = None
        self.corrections = 0

    def solve(self, z, residual, matrix, tangents: int = 1, of: str = "tangent"):
        """residual(z) returns the residual and its size over what the precision is compared with."""
        before = np.inf
        for k in range(40):
            r, size = residual(z)
            if not np.isfinite(size):
                raise ArithmeticError("left the range of numbers")
            slowly = k > 1 and size > self.slow * before
            if k and (
                size <= self.precision or (slowly and size < 1e3 * self.precision)
            ):  # the latter: rounding
                return z
            if not self.keep or self.factors is None or slowly:
                self.renew(matrix(z), tangents, of)
            before = size
            z = z - self.correct(r)
        raise ArithmeticError("no convergence")


def extrapolate(past: list, points: int):
    """The next of equidistant values, by the polynomial through the last `points`."""
    from math import comb

    k = min(points, len(past))
    return sum((-1) ** (j + 1) * comb(k, j) * past[-j] for j in range(1, k + 1))


class Scheme:
    def __init__(self, model: Model, h: float, keep: bool, precision: float, kind: str = "base") -> None:
        self.model, self.h, self.keep = model, h, keep
        self.work: Counter = Counter()
        self.q, self.v = model.place, model.speed
        self.a, self.multipliers = model.start()
        self.newton = Iteration(self.work, kind, keep, precision)
        self.extent = max(np.abs(model.place).max(), 1.0) if model.name != "andrews" else 0.05
        self.forces = np.zeros(model.n)
        self.scale = 1.0

    def forget(self):
        """What an event leaves of factors and of the past."""
        self.newton.factors = None

    def result(self):
        return self.model.seen(self.q, self.v, self.multipliers)

    def measure(self, r, terms, closure, rates=None, rate_size=1.0):
        """The largest of what is left of forces, over the largest of their kind so far, and of closures."""
        n, model = self.model.n, self.model
        self.forces = np.maximum(self.forces, np.max(np.abs(terms), axis=0))
        kinds = np.arange(n) % 3 == 2 if model.rotation is None else np.arange(n) >= 3
        parts = [np.abs(closure).max() / self.extent]
        for kind in (kinds, ~kinds):
            parts.append(np.abs(r[:n][kind]).max() / max(self.forces[kind].max(), 1e-30))
        if rates is not None:
            parts.append(np.abs(rates).max() / rate_size)
        return max(parts)


class OneEnd(Scheme):
    """Equations at the end of a step: unknown increment y', multipliers and, with GGL, eta."""

    ggl = False

    def kinematics(self, y, eta):
        """(increment, v, v'), then their derivatives by y' and by eta."""
        raise NotImplementedError

    def advance(self, y, multipliers):
        model, n, m = self.model, self.model.n, self.model.m
        k = self.scale

        def split(z):
            return z[:n], k * z[n : n + m], z[n + m :]

        def residual(z):
            y, push, eta = split(z)
            step, v, a = self.kinematics(y, eta)[0]
            q = model.move(self.q, step)
            g, closure = model.jacobian(q), model.closure(q)
            terms = np.array([model.mass @ a, model.force(q, v), g.T @ push])
            r = [terms[0] - terms[1] + terms[2], k * closure]
            rates = g @ v if self.ggl else None
            if self.ggl:
                r.append(k * self.h * rates)
            self.work["residual"] += 1
            r = np.concatenate(r)
            return r, self.measure(r, terms, closure, rates, max(np.abs(v).max(), self.extent / model.end))

        def matrix(z):
            y, push, eta = split(z)
            (step, v, _a), (v_y, a_y), (y_e, v_e, a_e) = self.kinematics(y, eta)
            q, t = model.move(self.q, step), model.tangent(step)
            g = model.jacobian(q)
            f_q, f_v = model.bent_force(q, v)
            stiff = (model.bent_jacobian(q, push) - f_q) @ t
            top = [model.mass @ a_y - f_v @ v_y + stiff, k * g.T]
            low = [k * g @ t, np.zeros((m, m))]
            if not self.ggl:
                return np.block([top, low])
            bent = model.bent_rate(q, v) @ t
            top.append(model.mass @ a_e - f_v @ v_e + stiff @ y_e)
            low.append(k * g @ t @ y_e)
            last = [g @ v_y + bent, np.zeros((m, m)), g @ v_e + bent @ y_e]
            return np.block([top, low, [k * self.h * part for part in last]])

        z = np.r_[y, multipliers / k, np.zeros(m if self.ggl else 0)]
        z = self.newton.solve(z, residual, matrix)
        y, push, eta = split(z)
        step, v, a = self.kinematics(y, eta)[0]
        return y, model.move(self.q, step), v, a, push


class Alpha(OneEnd):
    def __init__(self, model, h, keep, precision, rho=0.8, ggl=False) -> None:
        super().__init__(model, h, keep, precision, "ggl" if ggl else "base")
        self.ggl = ggl
        self.am, self.af = (2 * rho - 1) / (rho + 1), rho / (rho + 1)
        self.gamma = 0.5 + self.af - self.am
        self.beta = 0.25 * (self.gamma + 0.5) ** 2
        self.ca = (1 - self.am) / ((1 - self.af) * self.beta * h * h)
        self.scale = self.ca * np.median(np.diag(model.mass))
        # a_0 and v_0 as docs/theory.md, Time, First velocities
        d = min(h, 1e-4 * model.end)
        near = [model.balance(*truth_near(model, s * d))[0] for s in (-1, 1)]
        slope, shift = (near[1] - near[0]) / (2 * d), self.am - self.af
        self.memory = self.a + shift * h * slope
        if not ggl:
            off = h * h * (1 - 3 * shift - 6 * self.beta) / 6 * slope
            if model.rotation:
                off[model.rotation] += h * h / 12 * np.cross(self.v[model.rotation], self.a[model.rotation])
            g = model.jacobian(self.q)
            inverse = np.linalg.solve(model.mass, g.T)
            self.v = self.v + inverse @ np.linalg.solve(g @ inverse, g @ off)
        self.past = [[self.memory], [self.multipliers]]

    def kinematics(self, y, eta):
        n, h = self.model.n, self.h
        new = (y / h - self.v - h * (0.5 - self.beta) * self.memory) / (h * self.beta)
        v = self.v + h * ((1 - self.gamma) * self.memory + self.gamma * new)
        a = ((1 - self.am) * new + self.am * self.memory - self.af * self.a) / (1 - self.af)
        by_y = self.gamma / (self.beta * h) * np.eye(n), self.ca * np.eye(n)
        if not self.ggl:
            return (y, v, a), by_y, (None, None, None)
        zero = np.zeros_like(self.away)
        return (y + self.away @ eta, v, a), by_y, (self.away, zero, zero)

    def step(self):
        h = self.h
        points = 3 if self.keep else 1
        ahead = extrapolate(self.past[0], points)
        y = h * (self.v + h * ((0.5 - self.beta) * self.memory + self.beta * ahead))
        if self.ggl:
            self.away = -h * np.linalg.solve(self.model.mass, self.model.jacobian(self.q).T)
        y, q, v, a, push = self.advance(y, extrapolate(self.past[1], points))
        self.memory = (y / h - self.v - h * (0.5 - self.beta) * self.memory) / (h * self.beta)
        self.q, self.v, self.a, self.multipliers = q, v, a, push
        for past, new in zip(self.past, (self.memory, push), strict=True):
            past.append(new)
            del past[:-3]


BDF = {
    1: [1, -1],
    2: [3 / 2, -2, 1 / 2],
    3: [11 / 6, -3, 3 / 2, -1 / 3],
    4: [25 / 12, -4, 3, -4 / 3, 1 / 4],
    5: [137 / 60, -5, 5, -10 / 3, 5 / 4, -1 / 5],
}


class Backward(OneEnd):
    def __init__(self, model, h, keep, precision, order=2, ggl=False) -> None:
        super().__init__(model, h, keep, precision, "ggl" if ggl else "base")
        self.order, self.ggl, self.c = order, ggl, np.array(BDF[order]) / h
        self.scale = self.c[0] ** 2 * np.median(np.diag(model.mass))
        states = [truth_near(model, -j * h) for j in range(order, 0, -1)] + [(self.q, self.v)]
        self.places = [q for q, _ in states]
        self.speeds = [v for _, v in states]
        self.past = [model.balance(q, v)[1] for q, v in states][-3:]

    def kinematics(self, y, eta):
        model, c = self.model, self.c[0]
        rate = c * y + self.known_y
        t = model.tangent(y)
        v, by = t @ rate, c * t
        if model.rotation:
            by[model.rotation, model.rotation] += 0.5 * skew(rate[model.rotation])
        if not self.ggl:
            return (y, v, c * v + self.known_v), (by, c * by), (None, None, None)
        away = np.linalg.solve(model.mass, model.jacobian(model.move(self.q, y)).T)
        v = v + away @ eta
        return (y, v, c * v + self.known_v), (by, c * by), (np.zeros_like(away), away, c * away)

    def step(self):
        model, k = self.model, self.order
        past = [model.difference(self.q, q) for q in self.places]
        self.known_y = sum(self.c[j] * past[-j] for j in range(1, k + 1))
        self.known_v = sum(self.c[j] * self.speeds[-j] for j in range(1, k + 1))
        _, q, v, a, push = self.advance(extrapolate(past, k + 1), extrapolate(self.past, min(k, 3)))
        self.q, self.v, self.a, self.multipliers = q, v, a, push
        for past, new in ((self.places, q), (self.speeds, v), (self.past, push)):
            past.append(new)
            del past[0]


class Rattle(Scheme):
    """Unknown increment and multipliers of the first half; then velocities and multipliers of the second."""

    def __init__(self, model, h, keep, precision) -> None:
        super().__init__(model, h, keep, precision, "base")
        self.newton.keep = True  # within a step; `keep`: from step to step
        self.scale = np.median(np.diag(model.mass)) / h**2
        self.now = model.applied(self.q, self.v), model.jacobian(self.q)
        self.push = [self.multipliers]
        self.damped = np.abs(model.bent_force(self.q, self.v)[1]).max() > 0 and model.rotation is None

    def transport(self, y, momentum):
        """T(y)^-T momentum: a rotation's momentum at the end of its increment y, from that of y'."""
        r = self.model.rotation
        if r is None:
            return momentum
        out = momentum.copy()
        out[r] = np.linalg.solve(self.model.tangent(y)[r, r].T, momentum[r])
        return out

    def matrix(self, q):
        model, m = self.model, self.model.m
        g = model.jacobian(q) * (self.scale * self.h**2) ** 0.5
        return np.block([[model.mass, g.T], [g, np.zeros((m, m))]])

    def step(self):
        model, h, n = self.model, self.h, self.model.n
        weight = (self.scale * h**2) ** 0.5
        force, g0 = self.now
        if not self.keep:
            self.newton.factors = None
        p0 = model.mass @ self.v + 0.5 * h * force

        # unknowns: y/h, and (h/2) multipliers over `weight`
        def residual(z):
            y, push = h * z[:n], weight * z[n:]
            q = model.move(self.q, y)
            self.work["closure"] += 1
            closure = model.closure(q)
            terms = np.array([self.transport(-y, model.mass @ z[:n]), p0, g0.T @ push])
            r = np.r_[terms[0] - terms[1] + terms[2], weight * closure / h]
            return r, self.measure(r, terms, closure)

        ahead = extrapolate(self.push, 3)
        v = self.v + 0.5 * h * np.linalg.solve(model.mass, force - g0.T @ ahead)
        z = np.r_[v, 0.5 * h * ahead / weight]

        def matrix(z):
            y = h * z[:n]
            whole = self.matrix(model.move(self.q, y))
            if not self.keep:  # the exact one, to second order in h
                whole[:n, n:] = weight * g0.T
                whole[:n, :n] -= 0.5 * h * model.bent_force(self.q, z[:n])[1] if model.rotation else 0
            return whole

        z = self.newton.solve(z, residual, matrix, 1, "jacobian")
        y, first = h * z[:n], 2 / h * weight * z[n:]
        self.q = model.move(self.q, y)
        p = self.transport(y, model.mass @ z[:n])
        g = model.jacobian(self.q)
        # velocities that fit: linear; kept factors take a few corrections, counted as one residual each
        v, second, whole, before = z[:n], first, None, np.inf
        for k in range(40):
            if k == 0 or self.damped:
                force = model.applied(self.q, v)
                self.work["residual" if k == 0 else "closure"] += 1
            else:
                self.work["closure"] += 1
            terms = np.array([model.mass @ v, p + 0.5 * h * force, 0.5 * h * g.T @ second])
            r = np.r_[terms[0] - terms[1] + terms[2], weight * g @ v]
            speed = max(np.abs(v).max(), self.extent / model.end)
            size = max(self.measure(r, terms, np.zeros(1)), np.abs(g @ v).max() / speed)
            slowly = k > 1 and size > 0.5 * before
            if size <= self.newton.precision or (slowly and size < 1e3 * self.newton.precision):
                break
            if (whole is None and not self.keep) or self.newton.factors is None or slowly:
                whole = True
                self.newton.renew(self.matrix(self.q), 1, "jacobian")
            before = size
            change = self.newton.correct(r)
            v, second = v - change[:n], second - 2 / h * weight * change[n:]
        else:
            raise ArithmeticError("no convergence")
        self.v, self.now = v, (model.applied(self.q, v), g)
        self.push.append(second)
        del self.push[:-3]

    def result(self):
        """Multipliers of a balance at this place, at no cost: those of the halves are of first order."""
        return self.model.seen(self.q, self.v, self.model.balance(self.q, self.v)[1])


S6 = np.sqrt(6)
NODES = np.array([(4 - S6) / 10, (4 + S6) / 10, 1])
RADAU = np.array(
    [
        [(88 - 7 * S6) / 360, (296 - 169 * S6) / 1800, (-2 + 3 * S6) / 225],
        [(296 + 169 * S6) / 1800, (88 + 7 * S6) / 360, (-2 - 3 * S6) / 225],
        [(16 - S6) / 36, (16 + S6) / 36, 1 / 9],
    ]
)


class Radau(Scheme):
    def __init__(self, model, h, keep, precision) -> None:
        super().__init__(model, h, keep, precision, "base+double")
        self.newton.keep = True
        self.inverse = np.linalg.inv(RADAU)
        self.scale = (3.64 / h) ** 2 * np.median(np.diag(model.mass))
        self.past = [(self.a, self.multipliers)]

    def forget(self):
        super().forget()
        del self.past[:-1]

    def guess(self, c):
        """Accelerations and multipliers through up to four ends of steps."""
        k = len(self.past)
        weights = [np.prod([(c + i) / (i - j) for i in range(k) if i != j]) for j in range(k)]
        return [sum(w * self.past[-1 - j][p] for j, w in enumerate(weights)) for p in (0, 1)]

    def kinematics(self, ys):
        h, model = self.h, self.model
        vs = np.array([model.tangent(y) @ d for y, d in zip(ys, self.inverse @ ys / h, strict=True)])
        return vs, self.inverse @ (vs - self.v) / h

    def step(self):
        model, h, n, m, k = self.model, self.h, self.model.n, self.model.m, self.scale
        guesses = [self.guess(c) for c in NODES]
        v = self.v + h * RADAU @ np.array([a for a, _ in guesses])
        ys = h * RADAU @ v
        for _ in range(3 if model.rotation else 0):
            ys = (
                h
                * RADAU
                @ np.array([np.linalg.solve(model.tangent(y), w) for y, w in zip(ys, v, strict=True)])
            )

        def split(z):
            z = z.reshape(3, n + m)
            return z[:, :n], k * z[:, n:]

        def residual(z):
            ys, pushes = split(z)
            out, size = [], 0.0
            for y, v, a, push in zip(ys, *self.kinematics(ys), pushes, strict=True):
                q = model.move(self.q, y)
                self.work["residual"] += 1
                terms = np.array([model.mass @ a, model.force(q, v), model.jacobian(q).T @ push])
                closure = model.closure(q)
                r = np.r_[terms[0] - terms[1] + terms[2], k * closure]
                size = max(size, self.measure(r, terms, closure))
                out.append(r)
            return np.concatenate(out), size

        def matrix(z):
            ys, pushes = split(z)
            vs, _ = self.kinematics(ys)
            q = model.move(self.q, ys[1])
            f_q, f_v = model.bent_force(q, vs[1])
            g, w = k * model.jacobian(q), self.inverse / h
            zero = np.zeros((n + m, n + m))
            stiff, damp, mass = zero, zero.copy(), zero.copy()
            stiff[:n, :n] = model.bent_jacobian(q, pushes[1]) - f_q
            stiff[:n, n:], stiff[n:, :n] = g.T, g
            damp[:n, :n], mass[:n, :n] = -f_v, model.mass
            return np.kron(np.eye(3), stiff) + np.kron(w, damp) + np.kron(w @ w, mass)

        z = np.hstack([ys, np.array([push for _, push in guesses]) / k]).ravel()
        ys, _ = split(self.newton.solve(z, residual, matrix, 3))
        q, v = model.move(self.q, ys[2]), self.kinematics(ys)[0][2]
        # the end: [M G^T; G 0] for velocities, then for accelerations and multipliers
        g = model.jacobian(q)
        inverse = np.linalg.solve(model.mass, g.T)
        v = v - inverse @ np.linalg.solve(g @ inverse, g @ v)
        self.a, self.multipliers = model.balance(q, v)
        self.work.update({"tangent": 1, "factor base": 1, "solve base": 2, "residual": 2, "closure": 2})
        self.q, self.v = q, v
        self.past.append((self.a, self.multipliers))
        del self.past[:-4]


def make(name: str, model: Model, h: float, keep: bool, precision: float) -> Scheme:
    """alpha[-ggl][:rho], bdf2..bdf5[-ggl], rattle, radau."""
    base, _, rho = name.partition(":")
    kind, _, form = base.partition("-")
    if kind == "alpha":
        return Alpha(model, h, keep, precision, float(rho or 0.8), form == "ggl")
    if kind.startswith("bdf"):
        return Backward(model, h, keep, precision, int(kind[3:]), form == "ggl")
    return {"rattle": Rattle, "radau": Radau}[kind](model, h, keep, precision)
