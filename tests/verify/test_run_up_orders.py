# SPDX-License-Identifier: BSD-3-Clause
"""Order tracking of a real run-up (decks/trains/run_up_orders.dat) against the harmonic response of the
pair and against the pair as one ordinary differential equation."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "post"))
from engrane_post import Results  # noqa: E402
from engrane_post.order_spectra import OrderMap, order_map, over_angle  # noqa: E402
from runs import program  # noqa: E402

TEETH, RADIUS, INERTIA, LOAD = 25, 0.0625, 0.01, 200.0
NATURAL, DAMPING = 6000.0, 0.05
ERROR = {1: 6e-6, 2: 2e-6}  # amplitudes of the tooth harmonics
START, RATE, END = 10 * np.pi, 80 * np.pi / 1.2, 1.2


def chart(t: np.ndarray, y: np.ndarray) -> OrderMap:
    return order_map(over_angle(t, y, START * t + 0.5 * RATE * t**2), turns=1.0, highest=60.0)


def at(m: OrderMap, order: float) -> np.ndarray:
    """Amplitude near an order, at all speeds."""
    return m.amplitude[:, abs(m.order - order) < 1.5].max(axis=1)


@pytest.fixture(scope="module")
def measured(tmp_path_factory: pytest.TempPathFactory) -> OrderMap:
    prefix = tmp_path_factory.mktemp("orders") / "run_up"
    subprocess.run(
        [program(), ROOT / "decks/trains/run_up_orders.dat", "-o", prefix],
        check=True,
        capture_output=True,
    )
    with Results(prefix) as r:
        t, psi = r.history("3/PSI_A")
        assert psi == pytest.approx(START * t + 0.5 * RATE * t**2, abs=1e-9)
        return chart(*r.history("3/U_M"))


def test_harmonic_response(measured: OrderMap) -> None:
    """u_m follows the error as the base of an oscillator: X/|1 - s**2 + 2 i zeta s|, s = n z w/w_n. Where s
    is small the run-up is slow enough for it to settle."""
    for n, error in ERROR.items():
        s = n * TEETH * 2 * np.pi * measured.speed / NATURAL
        slow = s < 0.7
        expected = error / np.abs(1 - s**2 + 2j * DAMPING * s)
        assert at(measured, n * TEETH)[slow] == pytest.approx(expected[slow], rel=0.02)


def test_differential_equation(measured: OrderMap) -> None:
    """J_B psi_B'' = T - r (k (u + err) + c u'), u = r (psi_A + psi_B), through the resonances."""
    k = INERTIA * NATURAL**2 / RADIUS**2
    c = 2 * DAMPING * NATURAL * INERTIA / RADIUS**2

    def rhs(t: float, y: np.ndarray) -> list[float]:
        psi = START * t + 0.5 * RATE * t**2
        error = -sum(a * np.cos(n * TEETH * psi) for n, a in ERROR.items())
        tooth = k * (y[0] + error) + c * y[1]
        return [y[1], RADIUS * (RATE + (LOAD - RADIUS * tooth) / INERTIA)]

    t = np.arange(0, END + 1e-9, 5e-5)
    start = LOAD / RADIUS / k + sum(ERROR.values())
    u = solve_ivp(rhs, (0, t[-1]), [start, 0.0], "DOP853", t_eval=t, rtol=1e-9, atol=1e-15).y[0]
    expected = chart(t, u)
    # Twenty-one steps in a period of w_n make the period 1 % too long (Chung and Hulbert 1993): the crests
    # keep their height and stand a little lower in speed, and one stretch of the map is 1 % of the speed.
    for n in ERROR:
        found, right = at(measured, n * TEETH), at(expected, n * TEETH)
        assert found.max() == pytest.approx(right.max(), rel=0.01)
        assert measured.speed[found.argmax()] == pytest.approx(expected.speed[right.argmax()], rel=0.03)
        slow = n * TEETH * 2 * np.pi * expected.speed < 0.7 * NATURAL
        assert found[slow] == pytest.approx(right[slow], rel=0.01)
