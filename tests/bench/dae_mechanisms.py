# SPDX-License-Identifier: BSD-3-Clause
"""Andrews' squeezing mechanism and a spatial slider-crank in as few coordinates as they allow, for codes that
solve differential-algebraic equations, and the same mechanisms as decks of this program; with their truth
and the errors of tests/bench/accuracy.py. Used by dae_codes.py.

Terms of M(q) v' = f(q, v) - G(q)^T lambda, 0 = g(q), in machine code (numba). Andrews' mechanism: its seven
angles, with the data of tests/verify/oracles/andrews.py. The slider-crank of tests/bench/accuracy.py, with a
flywheel: the angle and the slide, its massless rod is a distance.

Error: root of the mean square over the instants over the range, the worst of some coordinates and their
speeds. Truth: the ordinary differential equation in one coordinate by DOP853, 1e-12 or less.
"""

import math
import os
import re
import resource
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numba
import numpy as np
from scipy.integrate import solve_ivp

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / "verify" / "oracles"), str(ROOT / "post")]
import andrews as data  # noqa: E402
from accuracy import free_crank  # noqa: E402
from engrane_post import Results  # noqa: E402

MASS, INERTIA, TURN = data.MASS, data.INERTIA, data.TURN.astype(float)
NAMES = list(data.POINTS)
#: points of bodies: table of (c, s) by point and body
ARMS = np.zeros((len(NAMES), 7, 2))
for row, name in enumerate(NAMES):
    for body, c, s in data.POINTS[name]:
        ARMS[row, body] += c, s
MASSES = np.array([NAMES.index(str(i + 1)) for i in range(7)])
LOOPS = np.array([[NAMES.index(one), NAMES.index(other)] for one, other, _ in data.LOOPS])
GROUNDS = np.array([ground for _, _, ground in data.LOOPS])
SPRING = NAMES.index("D")
A_B, A_C, C0, L0, TORQUE = data.B, data.C, data.C0, data.L0, data.TORQUE


@numba.njit
def andrews_terms(q, v, mass, force, jacobian, closure, curvature):
    """M (7 x 7), f (7), G (6 x 7), g (6) and G' v (6) of the mechanism at q, v."""
    angle, turn = TURN @ q, TURN @ v
    cos, sin = np.cos(angle), np.sin(angle)
    mass[:], force[:] = 0.0, 0.0
    for i in range(7):
        for a in range(7):
            for b in range(7):
                mass[a, b] += INERTIA[i] * TURN[i, a] * TURN[i, b]
    velocity = np.zeros((2, 7))
    for i in range(7):
        velocity[:], bend = 0.0, np.zeros(2)
        for body in range(7):
            c, s = ARMS[MASSES[i], body]
            if c == 0.0 and s == 0.0:
                continue
            x, y = c * cos[body] - s * sin[body], c * sin[body] + s * cos[body]
            for a in range(7):
                velocity[0, a] -= y * TURN[body, a]
                velocity[1, a] += x * TURN[body, a]
            bend[0] -= x * turn[body] ** 2
            bend[1] -= y * turn[body] ** 2
        for a in range(7):
            force[a] -= MASS[i] * (velocity[0, a] * bend[0] + velocity[1, a] * bend[1])
            for b in range(7):
                mass[a, b] += MASS[i] * (velocity[0, a] * velocity[0, b] + velocity[1, a] * velocity[1, b])
    force[0] += TORQUE
    reach, along = A_B - A_C, np.zeros((2, 7))
    for body in range(7):
        c, s = ARMS[SPRING, body]
        x, y = c * cos[body] - s * sin[body], c * sin[body] + s * cos[body]
        reach = reach + np.array([x, y])
        for a in range(7):
            along[0, a] -= y * TURN[body, a]
            along[1, a] += x * TURN[body, a]
    length = np.sqrt(reach[0] ** 2 + reach[1] ** 2)
    pull = -C0 * (length - L0) / length
    for a in range(7):
        force[a] += pull * (reach[0] * along[0, a] + reach[1] * along[1, a])
    jacobian[:], curvature[:] = 0.0, 0.0
    for k in range(3):
        closure[2 * k], closure[2 * k + 1] = -GROUNDS[k, 0], -GROUNDS[k, 1]
        for body in range(7):
            c = ARMS[LOOPS[k, 0], body, 0] - ARMS[LOOPS[k, 1], body, 0]
            s = ARMS[LOOPS[k, 0], body, 1] - ARMS[LOOPS[k, 1], body, 1]
            x, y = c * cos[body] - s * sin[body], c * sin[body] + s * cos[body]
            closure[2 * k] += x
            closure[2 * k + 1] += y
            curvature[2 * k] -= x * turn[body] ** 2
            curvature[2 * k + 1] -= y * turn[body] ** 2
            for a in range(7):
                jacobian[2 * k, a] -= y * TURN[body, a]
                jacobian[2 * k + 1, a] += x * TURN[body, a]


CRANK, ROD, OFFSET, SLIDER, FLYWHEEL = 0.2, 0.6, 0.1, 3.0, 0.1


@numba.njit
def crank_terms(q, v, mass, force, jacobian, closure, curvature):
    """Angle a of the crank, place x of the slider: ((x - r cos a)^2 + r^2 sin^2 a + e^2 - l^2)/2 = 0."""
    cos, sin, x, w, u = np.cos(q[0]), np.sin(q[0]), q[1], v[0], v[1]
    mass[:], force[:] = 0.0, 0.0
    mass[0, 0], mass[1, 1] = FLYWHEEL, SLIDER
    closure[0] = ((x - CRANK * cos) ** 2 + (CRANK * sin) ** 2 + OFFSET**2 - ROD**2) / 2
    jacobian[0, 0], jacobian[0, 1] = x * CRANK * sin, x - CRANK * cos
    curvature[0] = x * CRANK * cos * w * w + 2 * CRANK * sin * w * u + u * u


def crank_truth(times: np.ndarray) -> np.ndarray:
    """One angle: (J + m x'^2) a'' + m x' x'' a'^2 = 0 with x(a) and its derivatives by a."""

    def slide(a: float) -> tuple[float, float, float]:
        root = math.sqrt(ROD**2 - OFFSET**2 - (CRANK * math.sin(a)) ** 2)
        bend = -(CRANK**2) * math.sin(a) * math.cos(a) / root
        return (
            CRANK * math.cos(a) + root,
            -CRANK * math.sin(a) + bend,
            -CRANK * math.cos(a) - (CRANK**2 * math.cos(2 * a) + bend**2) / root,
        )

    def rate(_t: float, y: np.ndarray) -> tuple[float, float]:
        _, first, second = slide(y[0])
        return y[1], -SLIDER * first * second * y[1] ** 2 / (FLYWHEEL + SLIDER * first**2)

    angle, speed = solve_ivp(rate, (0, times[-1]), (0, 10), "DOP853", t_eval=times, rtol=1e-13, atol=1e-13).y
    slides = [slide(a) for a in angle]
    return np.array([[a, x, w, first * w] for a, w, (x, first, _) in zip(angle, speed, slides, strict=True)])


def andrews_truth(times: np.ndarray) -> np.ndarray:
    """Seven angles and their rates by the oracle's equation in one coordinate."""
    known = [data.assemble(data.START)]

    def place(beta: float) -> np.ndarray:
        near = known[-1]
        known[-1] = data.assemble(near + data.coefficients(near)[0] * (beta - near[0]))
        return known[-1]

    y = solve_ivp(
        lambda _, y: [y[1], data.acceleration(place(y[0]), y[1])],
        (0, times[-1]),
        [data.START[0], 0.0],
        "DOP853",
        t_eval=times,
        rtol=1e-12,
        atol=1e-12,
    ).y
    known[-1] = data.assemble(data.START)
    out = np.empty((len(times), 14))
    for k, (beta, speed) in enumerate(y.T):
        out[k, :7] = place(beta)
        out[k, 7:] = data.coefficients(out[k, :7])[0] * speed
    return out


def deck_text(name: str) -> str:
    return (ROOT / "decks" / "mechanisms" / name).read_text(encoding="utf-8")


@dataclass
class Mechanism:
    deck: str
    terms: Callable
    place: np.ndarray  #: at the start, n
    speed: np.ndarray
    scale: (
        float  #: of speeds: an absolute tolerance of one unit of a coordinate is one of so much of its speed
    )
    constraints: int
    end: float
    step: float  #: H of the deck
    instants: int
    truth: Callable[[np.ndarray], np.ndarray]
    channels: dict[
        str, tuple[int, float]
    ]  #: column of (coordinates, speeds) and its value where the channel is zero


MECHANISMS = {
    "andrews": lambda: Mechanism(
        deck_text("andrews_squeezer.dat"),
        andrews_terms,
        data.assemble(data.START),
        np.zeros(7),
        1e3,
        6,
        0.03,
        2e-5,
        150,
        andrews_truth,
        {
            f"element/{e}/{c}": (i + k, (1 - k / 7) * data.START[i])
            for e, i in ((11, 0), (13, 2), (15, 4))
            for c, k in (("ANGLE", 0), ("SPEED", 7))
        },
    ),
    "crank": lambda: Mechanism(
        free_crank(deck_text("slider_crank.dat")),
        crank_terms,
        np.array([0.0, CRANK + math.sqrt(ROD**2 - OFFSET**2)]),
        np.array([10.0, 0.0]),
        10,
        1,
        1.0,
        2e-4,
        100,
        crank_truth,
        {
            "element/1/ANGLE": (0, 0.0),
            "element/1/SPEED": (2, 0.0),
            "element/4/SLIDE": (1, CRANK + math.sqrt(ROD**2 - OFFSET**2)),
            "element/4/SLIDE_SPEED": (3, 0.0),
        },
    ),
}


def run_engrane(
    binary: Path, folder: Path, mechanism: Mechanism, analysis: str, more: str = "", end: float = 0
) -> dict:
    """`analysis`: words of .SAM, none for those of the deck; `more`: of .SUB."""
    text = re.sub(r"^\.CHK\n(?: .*\n)*", "", mechanism.deck, flags=re.M)
    if analysis:
        text = re.sub(r"^\.SAM .*", f".SAM TYPE DYNAMIC {analysis} ENERGY 0", text, flags=re.M)
    asked = "\n".join(
        f" ELEMENT {n.split('/')[1]} {n.split('/')[2]} V 0 ATOL 1e30" for n in mechanism.channels
    )
    interval = mechanism.end / mechanism.instants
    card = f".SUB TF {end or mechanism.end!r} H {mechanism.step!r}{more}\n"
    card += f".SAI FIELDS DT {mechanism.end!r} HISTORY DT {interval!r}\n.CHK\n{asked}"
    text = re.sub(r"^\.SUB .*", card, text, flags=re.M)
    path = folder / "run.dat"
    path.write_text(text, encoding="utf-8")
    environment = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [binary, "-q", path, "-o", path.with_suffix("")], env=environment, capture_output=True, text=True
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if end:
        return {"seconds": seconds}
    values = np.full((mechanism.instants + 1, 2 * len(mechanism.place)), np.nan)
    with Results(path.with_suffix(".h5")) as results:
        for name, (column, zero) in mechanism.channels.items():
            times, history = results.history(name)
            places = times / interval
            values[:, column] = history[np.abs(places - np.round(places)) < 1e-3] + zero
    effort = re.search(r"(\d+) steps?, (\d+) Newton", path.with_suffix(".lst").read_text(encoding="utf-8"))
    return {"seconds": seconds, "values": values, "work": [effort[1], 3 * int(effort[2]), ""]}


def with_forces(state: np.ndarray, mechanism: Mechanism) -> np.ndarray:
    """(q, v) and the accelerations and multipliers that go with them."""
    n, m = len(mechanism.place), mechanism.constraints
    mass, jacobian = np.empty((n, n)), np.empty((m, n))
    force, closure, curvature = np.empty(n), np.empty(m), np.empty(m)
    mechanism.terms(state[:n], state[n:], mass, force, jacobian, closure, curvature)
    whole = np.block([[mass, jacobian.T], [jacobian, np.zeros((m, m))]])
    return np.r_[state, np.linalg.solve(whole, np.r_[force, -curvature])]


def digits(values: np.ndarray, true: np.ndarray, mechanism: Mechanism) -> float:
    """Mixed significant digits of the worst component at the end, as the Test Set for IVP Solvers counts them
    with rtol = atol: of coordinates, speeds, accelerations and multipliers, or of those of the first two that
    are known."""
    found, exact = values[-1], true[-1]
    if not np.isnan(found).any():
        found, exact = with_forces(found, mechanism), with_forces(exact, mechanism)
    return float(-np.log10(np.nanmax(np.abs(found - exact) / (1 + np.abs(exact)))))


def error(values: np.ndarray, true: np.ndarray, mechanism: Mechanism) -> float:
    columns = [column for column, _ in mechanism.channels.values()]
    off = np.sqrt(np.mean((values - true)[:, columns] ** 2, axis=0))
    return float((off / np.ptp(true[:, columns], axis=0)).max())
