# SPDX-License-Identifier: BSD-3-Clause
"""A crank at constant speed, an elastic rod and a sliding block: the problem "Slider crank" of the Test Set
for IVP Solvers (B. Simeon 1998; Modelling a flexible slider crank mechanism by a mixed system of DAEs and
PDEs, Math. Modelling of Systems 2, 1996, 1-18). SI units, no gravity.

`Modes` has the unknowns of the Test Set: the angle of a frame on the rod, two half waves across it, two
parabolas along it, and a stiffness that the force along the rod does not change. Its equations are those of
Lagrange with integrals by quadrature, written anew; their end is PUBLISHED. There the masses of the parabolas
are 15 times those of their shapes (8, 1, 2 instead of 8, 1, 2 fifteenths); `Modes` can have either.

`Rod` is the same rod as a continuum of any displacements (Reissner 1972, J. Appl. Math. Phys. 23, 795):
position and turn of its sections as polynomials over the whole length, in axes that stand still.

    python tests/verify/oracles/flexible_crank.py      differences between them, and the convergence of Rod
"""

from __future__ import annotations

import math

import numpy as np
from numpy.polynomial import legendre
from scipy.integrate import solve_ivp

CRANK, LENGTH, SIDE, SPEED = 0.15, 0.30, 0.008, 150.0
YOUNG, POISSON, DENSITY, BLOCK = 0.20e12, 0.30, 7870.0, 0.075552
ROD_INERTIA = 0.0045339259  # about the pin
AREA, BENDING = SIDE**2, SIDE**4 / 12
SHEAR = 10 * (1 + POISSON) / (12 + 11 * POISSON)  # Cowper 1966, rectangle
TURN = 2 * math.pi / SPEED  # s

#: angle, half waves, parabolas (middle, end), and their rates: close to a smooth motion
START = np.array([0, 0, 0, 0.103339863e-4, 0.169327969e-4])
START_RATES = np.array([-0.749957670e2, 0.444896105, 0.463434311e-2, -0.178591076e-5, -0.268938672e-5])
#: at t = 0.1, the Test Set's reference solution
PUBLISHED = np.array(
    [
        -3.311734987910881e-01,
        1.893192460247178e-04,
        2.375751865617931e-05,
        -5.323907988763734e-06,
        -8.363283141616840e-06,
        6.025346682645789e01,
        -3.005536801092212e-02,
        -5.500488291932075e-03,
        4.978243404809343e-04,
        1.104933470696396e-03,
    ]
)

#: deflection of the middle after each twentieth of a turn, m: Rod(10), DOP853 with rtol 1e-9 (takes minutes)
DEFLECTIONS = np.array(
    [
        8.45412e-04,
        1.40035e-03,
        1.54976e-03,
        1.22865e-03,
        7.78969e-04,
        4.19936e-04,
        2.91739e-04,
        2.03756e-04,
        9.74818e-05,
        1.53154e-05,
        -1.24195e-04,
        -1.88494e-04,
        -2.90608e-04,
        -4.36966e-04,
        -7.51607e-04,
        -1.25916e-03,
        -1.52213e-03,
        -1.42057e-03,
        -8.34777e-04,
        -7.74195e-07,
    ]
)


def quadrature(points: int) -> tuple[np.ndarray, np.ndarray]:
    """Places from 0 to 1 and their weights."""
    x, w = legendre.leggauss(points)
    return (x + 1) / 2, w / 2


def pin(t: float) -> tuple[float, float]:
    return CRANK * math.cos(SPEED * t), CRANK * math.sin(SPEED * t)


def longitudinal(u: np.ndarray) -> np.ndarray:
    return np.array([4 * u * (1 - u), 2 * u**2 - u])


def start(u: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Displacements along the rod, velocities across it and spins of its sections."""
    waves = np.array([1, 2])[:, None] * math.pi
    moved = START[3:] @ longitudinal(u)
    speeds = CRANK * SPEED + START_RATES[0] * (LENGTH * u + moved) + START_RATES[1:3] @ np.sin(waves * u)
    spins = START_RATES[0] + START_RATES[1:3] @ (waves / LENGTH * np.cos(waves * u))
    return moved, speeds, spins


class Modes:
    """The Test Set's discretisation; `longitudinal_mass` times the inertia of the parabolas."""

    def __init__(self, longitudinal_mass: float = 15.0) -> None:
        u, weights = quadrature(16)
        self.x = LENGTH * u
        self.mass = DENSITY * AREA * LENGTH * weights
        self.more = (longitudinal_mass - 1) * self.mass
        waves = np.array([1, 2])[:, None] * math.pi
        self.across, self.along = np.sin(waves * u), longitudinal(u)
        curvatures = (waves / LENGTH) ** 2 * self.across
        slopes = np.array([4 - 8 * u, 4 * u - 1]) / LENGTH
        self.bending = YOUNG * BENDING * LENGTH * (curvatures * weights) @ curvatures.T
        self.stretching = YOUNG * AREA * LENGTH * (slopes * weights) @ slopes.T

    def rates(self, t: float, y: np.ndarray) -> np.ndarray:
        """Of angle, half waves, parabolas and their rates; the block on its line by a multiplier."""
        (angle, *q), (spin, *dq) = y[:5], y[5:]
        q, dq = np.array(q), np.array(dq)
        cos, sin = math.cos(angle), math.sin(angle)
        at = pin(t)
        ax, ay = -(SPEED**2) * at[0], -(SPEED**2) * at[1]
        w, dw, u, du = q[:2] @ self.across, dq[:2] @ self.across, q[2:] @ self.along, dq[2:] @ self.along
        zero_across, zero_along = np.zeros_like(self.across), np.zeros_like(self.along)
        # along and across the rod: what each unknown moves, and the acceleration that is left without them
        along = np.vstack([-w[None], zero_across, self.along])
        across = np.vstack([(self.x + u)[None], self.across, zero_along])
        rest_along = cos * ax + sin * ay - 2 * spin * dw - spin**2 * (self.x + u)
        rest_across = cos * ay - sin * ax + 2 * spin * du - spin**2 * w
        matrix = np.zeros((6, 6))
        right = np.zeros(6)
        matrix[:5, :5] = (along * self.mass) @ along.T + (across * self.mass) @ across.T
        right[:5] = -along @ (self.mass * rest_along) - across @ (self.mass * rest_across)
        matrix[0, 0] += ROD_INERTIA - DENSITY * AREA * LENGTH**3 / 3 + self.more @ u**2
        right[0] -= 2 * spin * self.more @ (u * du)
        matrix[3:5, 3:5] += (self.along * self.more) @ self.along.T
        right[3:5] += spin**2 * self.along @ (self.more * u)
        right[1:3] -= self.bending @ q[:2]
        right[3:5] -= self.stretching @ q[2:]
        arm = LENGTH + q[3]
        block = np.array([-arm * sin, 0, 0, 0, cos])
        matrix[:5, :5] += BLOCK * np.outer(block, block)
        right[:5] -= BLOCK * block * (ax - arm * cos * spin**2 - 2 * sin * spin * dq[3])
        matrix[5, :5] = matrix[:5, 5] = [arm * cos, 0, 0, 0, sin]
        right[5] = -(ay - arm * sin * spin**2 + 2 * cos * spin * dq[3])
        return np.concatenate([y[5:], np.linalg.solve(matrix, right)[:5]])

    def solve(self, times: np.ndarray, tolerance: float = 1e-9) -> np.ndarray:
        start = np.concatenate([START, START_RATES])
        scale = tolerance * np.array([1, *[1e-4] * 4, 100, *[1e-1] * 4])
        span = (0, times[-1])
        found = solve_ivp(self.rates, span, start, "DOP853", times, rtol=tolerance, atol=scale)
        assert found.success
        return found.y


class Rod:
    """Reissner's rod: x, y and turn of its sections as polynomials with `count` unknowns each."""

    def __init__(self, count: int = 9, shear: float = SHEAR * YOUNG / (2 * (1 + POISSON)) * AREA) -> None:
        self.count, self.shear = count, shear
        u, weights = quadrature(count + 6)
        self.u, self.weights = u, LENGTH * weights
        plain = np.eye(count + 1)
        polynomials = [np.polynomial.Legendre(row[: k + 1], [0, 1]) for k, row in enumerate(plain)][:count]
        ends = np.polynomial.Polynomial([0, 1]), np.polynomial.Polynomial([0, 1, -1])
        powers = [p.convert(kind=np.polynomial.Polynomial, domain=[-1, 1]) for p in polynomials]
        self.shapes = [[e * p for p in powers] for e in ends] + [powers]  # of x, y, turn
        self.values = [np.array([f(u) for f in shapes]) for shapes in self.shapes]
        self.slopes = [np.array([f.deriv()(u) for f in shapes]) / LENGTH for shapes in self.shapes]
        inertia = DENSITY * np.array([AREA, AREA, BENDING])
        masses = [i * (v * self.weights) @ v.T for i, v in zip(inertia, self.values, strict=True)]
        end = np.array([f(1.0) for f in self.shapes[0]])
        masses[0] = masses[0] + BLOCK * np.outer(end, end)
        self.inverse = [np.linalg.inv(m) for m in masses]
        # of the pin's accelerations
        self.carried_x = DENSITY * AREA * self.values[0] @ self.weights + BLOCK * end
        self.carried_y = DENSITY * AREA * self.values[1] @ (self.weights * (1 - u))

    def parts(self, y: np.ndarray) -> list[np.ndarray]:
        return np.split(y, [self.count, 2 * self.count])

    def slopes_of(self, t: float, q: np.ndarray) -> tuple[np.ndarray, ...]:
        x, y, turn = self.parts(q)
        dx, dy = x @ self.slopes[0], y @ self.slopes[1] - pin(t)[1] / LENGTH
        theta = turn @ self.values[2]
        return dx, dy, np.cos(theta), np.sin(theta), turn @ self.slopes[2]

    def rates(self, t: float, state: np.ndarray) -> np.ndarray:
        q, v = np.split(state, 2)
        dx, dy, cos, sin, curvature = self.slopes_of(t, q)
        stretch, shear = cos * dx + sin * dy - 1, cos * dy - sin * dx
        normal, across = YOUNG * AREA * stretch, self.shear * shear
        at = pin(t)
        w = self.weights
        forces = [
            -self.slopes[0] @ (w * (normal * cos - across * sin)) + SPEED**2 * at[0] * self.carried_x,
            -self.slopes[1] @ (w * (normal * sin + across * cos)) + SPEED**2 * at[1] * self.carried_y,
            -self.values[2] @ (w * (normal * shear - across * (1 + stretch)))
            - self.slopes[2] @ (w * YOUNG * BENDING * curvature),
        ]
        return np.concatenate([v, *(m @ f for m, f in zip(self.inverse, forces, strict=True))])

    def start(self) -> np.ndarray:
        moved, speeds, spins = start(self.u)
        fields = zip(
            self.values, (LENGTH * self.u + moved, speeds - CRANK * SPEED * (1 - self.u), spins), strict=True
        )
        fit = [np.linalg.lstsq(v.T, f, rcond=None)[0] for v, f in fields]
        none = np.zeros(self.count)
        return np.concatenate([fit[0], none, none, none, fit[1], fit[2]])

    def solve(self, times: np.ndarray, tolerance: float = 1e-9) -> np.ndarray:
        n = self.count
        scale = tolerance * np.repeat([1e-3, 1e-3, 1e-2, 1.0, 1.0, 10.0], n)
        span = (0, times[-1])
        found = solve_ivp(self.rates, span, self.start(), "DOP853", times, rtol=tolerance, atol=scale)
        assert found.success
        return found.y

    def place(self, u: float, times: np.ndarray, states: np.ndarray) -> np.ndarray:
        """x, y and turn of the section at u of the length, by instant."""
        x, y, turn = (np.array([f(u) for f in shapes]) for shapes in self.shapes)
        n = self.count
        at = np.array([pin(t) for t in times])
        return np.array(
            [
                at[:, 0] + x @ states[:n],
                (1 - u) * at[:, 1] + y @ states[n : 2 * n],
                turn @ states[2 * n : 3 * n],
            ]
        ).T

    def deflection(self, times: np.ndarray, states: np.ndarray) -> np.ndarray:
        """Of the middle, from the line between the ends."""
        return deflection(*(self.place(u, times, states)[:, :2] for u in (0.0, 0.5, 1.0)))


def deflection(pin: np.ndarray, middle: np.ndarray, block: np.ndarray) -> np.ndarray:
    """How far the middle stands to the left of the line from the pin to the block."""
    along = (block - pin) / np.linalg.norm(block - pin, axis=1)[:, None]
    arm = middle - pin
    return along[:, 0] * arm[:, 1] - along[:, 1] * arm[:, 0]


def main() -> None:
    end = Modes().solve(np.array([0.1]))[:, -1]
    print("Modes over what is published, less 1:", end / PUBLISHED - 1)
    times = np.linspace(0, TURN, 21)
    published, light = (Modes(m).solve(times)[1] for m in (15.0, 1.0))
    print(f"masses of the parabolas as they are: {np.abs(light - published).max():.1e} m")
    print(f"Modes from the table: {np.abs(published[1:] - DEFLECTIONS).max():.1e} m")
    rods = {f"Rod({count})": Rod(count) for count in (8, 9, 10)}
    rods["Rod(8) without shear"] = Rod(8, 1e3 * Rod(8).shear)
    for title, rod in rods.items():
        found = rod.deflection(times, rod.solve(times))[1:]
        print(f"{title} from the table: {np.abs(found - DEFLECTIONS).max():.1e} m", found, flush=True)


if __name__ == "__main__":
    main()
