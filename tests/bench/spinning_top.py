# SPDX-License-Identifier: BSD-3-Clause
"""Why generalised-alpha follows a fast spinning body with a large error: the heavy top as one rotation about
its fixed point, angular velocities in components of the body and in those of space.

    python tests/bench/spinning_top.py

The scheme with rho 0.8 and fixed steps, as docs/theory.md has it, in 60 lines of Python; truth by Runge-Kutta
of order 4. Body: R exp(y), y = h v + h2 (..), v and a in components of the body. Space: exp(y) R with v and a
in components of space, and y less h2/12 v x dv, the commutator of Magnus's series. Error: root of the mean
square over 125 instants over the range, the worst of position and velocity of the centre of mass.
docs/accuracy.md has the derivation.
"""

import numpy as np

INERTIA = np.array(
    [15.234375, 0.46875, 15.234375]
)  # about the fixed point; the centre of mass is at (0, 1, 0)
MASS, CENTER, GRAVITY = 15.0, np.array([0, 1.0, 0]), np.array([0, 0, -9.81])
SPIN, SPAN, INSTANTS, RHO = np.array([0, 150, -4.61538]), 0.2, 125, 0.8


def turn(y: np.ndarray) -> np.ndarray:
    angle = np.linalg.norm(y)
    k = np.array([[0, -y[2], y[1]], [y[2], 0, -y[0]], [-y[1], y[0], 0]])
    return np.eye(3) + np.sin(angle) / angle * k + (1 - np.cos(angle)) / angle**2 * k @ k


def acceleration(r: np.ndarray, w: np.ndarray) -> np.ndarray:
    return (np.cross(CENTER, r.T @ (MASS * GRAVITY)) - np.cross(w, INERTIA * w)) / INERTIA


def seen(r: np.ndarray, w: np.ndarray) -> np.ndarray:
    return np.r_[r @ CENTER, r @ np.cross(w, CENTER)]


def alpha(steps: int, space: bool) -> np.ndarray:
    am, af = (2 * RHO - 1) / (RHO + 1), RHO / (RHO + 1)
    gamma = 0.5 + af - am
    beta, h = 0.25 * (gamma + 0.5) ** 2, SPAN / steps
    r, w = np.eye(3), SPIN
    rate, tiny = acceleration(r, w), 1e-6
    slope = (acceleration(r @ turn(tiny * w + tiny**2 / 2 * rate), w + tiny * rate) - rate) / tiny
    v, dv = w, rate  # R is 1 at the start
    a = rate + (am - af) * h * (slope + np.cross(w, rate) if space else slope)
    rows = []
    for k in range(steps):
        new = a
        for _ in range(60):
            y = h * v + h**2 * ((0.5 - beta) * a + beta * new)
            after = v + h * ((1 - gamma) * a + gamma * new)
            r1 = turn(y - h**2 / 12 * np.cross(v, after - v)) @ r if space else r @ turn(y)
            w = r1.T @ after if space else after
            rate = acceleration(r1, w)
            d_after = r1 @ rate if space else rate
            old, new = new, ((1 - af) * d_after + af * dv - am * a) / (1 - am)
            if np.abs(new - old).max() < 1e-13 * np.abs(new).max():
                break
        r, v, dv, a = r1, after, d_after, new
        if (k + 1) % (steps // INSTANTS) == 0:
            rows.append(seen(r, w))
    return np.array(rows)


def truth(steps: int) -> np.ndarray:
    def rates(r, w):
        k = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
        return r @ k, acceleration(r, w)

    h, r, w, rows = SPAN / steps, np.eye(3), SPIN.astype(float), []
    for k in range(steps):
        r1, w1 = rates(r, w)
        r2, w2 = rates(r + h / 2 * r1, w + h / 2 * w1)
        r3, w3 = rates(r + h / 2 * r2, w + h / 2 * w2)
        r4, w4 = rates(r + h * r3, w + h * w3)
        r, w = r + h / 6 * (r1 + 2 * r2 + 2 * r3 + r4), w + h / 6 * (w1 + 2 * w2 + 2 * w3 + w4)
        if (k + 1) % (steps // INSTANTS) == 0:
            rows.append(seen(r, w))
    return np.array(rows)


def main() -> None:
    exact = truth(32000)
    print("| steps | components of the body | of space |\n|---|---|---|")
    for steps in (1000, 2000, 4000):
        off = [alpha(steps, space) - exact for space in (False, True)]
        cells = [np.max(np.sqrt(np.mean(o**2, axis=0)) / np.ptp(exact, axis=0)) for o in off]
        print(f"| {steps} | {cells[0]:.2e} | {cells[1]:.2e} |", flush=True)


if __name__ == "__main__":
    main()
