# SPDX-License-Identifier: BSD-3-Clause
"""decks/mechanisms/valve_train.dat against its equations by Runge-Kutta of order 8: second order in the
rocker's angle, the valve's lift and both contact forces."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from oracles import valve_train
from runs import run

DECK = Path(__file__).parents[2] / "decks" / "mechanisms" / "valve_train.dat"
TIMES = np.arange(0.0036, 0.0130, 0.0001)  # the whole lift
#: largest errors at H = 1e-5: twice the measured 2.2e-6 rad, 1.1e-7 m, 3.3 N, 2.5 N
ALLOWED = {"angle": 4.4e-6, "valve": 2.2e-7, "cam_force": 6.6, "valve_force": 5.0}
CHANNELS = {
    "angle": "2/ANGLE",
    "valve": "3/SLIDE",
    "cam_force": "4/NORMAL_FORCE",
    "valve_force": "5/NORMAL_FORCE",
}


def errors(step: str, exact: dict[str, np.ndarray], folder: Path) -> dict[str, float]:
    text = DECK.read_text().split(".CHK")[0].replace("H 1D-5", f"H {step}") + ".FIN 1\n"
    done = run(text, folder, f"h{step}")
    at = np.searchsorted(done.t, TIMES - 1e-9)
    assert np.allclose(done.t[at], TIMES, rtol=0, atol=1e-12)
    return {name: float(abs(done[channel][at] - exact[name]).max()) for name, channel in CHANNELS.items()}


def test_second_order(tmp_path: Path) -> None:
    exact = valve_train.simulate(TIMES, 1e-10)
    coarse, fine = errors("2D-5", exact, tmp_path), errors("1D-5", exact, tmp_path)
    for name, allowed in ALLOWED.items():
        assert fine[name] < allowed, name
        assert 1.9 < np.log2(coarse[name] / fine[name]) < 2.1, name
