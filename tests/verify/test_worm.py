# SPDX-License-Identifier: BSD-3-Clause
"""Worm drives: efficiency over lead angle and friction in both directions, self-locking, and what
friction takes."""

from __future__ import annotations

from math import radians
from pathlib import Path

import numpy as np
import pytest
import worm
from scipy.optimize import brentq


@pytest.mark.parametrize("worm_drives", [True, False])
@pytest.mark.parametrize("mu", worm.FRICTIONS)
@pytest.mark.parametrize("lead", worm.LEADS)
def test_efficiency(lead: float, mu: float, worm_drives: bool, tmp_path: Path) -> None:
    result = worm.steady(radians(lead), mu, worm_drives, tmp_path)
    expected = worm.closed_form(radians(lead), mu, worm_drives)
    power_a, power_b, lost = (result[f"3/{name}"][-1] for name in ("POWER_A", "POWER_B", "FRICTION_POWER"))
    size = max(abs(power_a), abs(power_b))
    assert power_a + power_b + lost == pytest.approx(0, abs=1e-9 * size)
    if expected > 0:
        assert result["3/EFFICIENCY"][-1] == pytest.approx(expected, rel=1e-9)
    else:  # self-locking: both shafts must push, and all of it is lost
        assert power_a < 0 and power_b < 0
        assert result["3/EFFICIENCY"][-1] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("lead", [5.0, 15.0])
def test_self_locking(lead: float, tmp_path: Path) -> None:
    """On either side of mu = cos a_n tan L: a wheel that cannot and one that can turn its worm."""
    limit = worm.locking_friction(radians(lead))
    locked = worm.released(radians(lead), 1.1 * limit, tmp_path)
    # once the start is over all that is left is creep, below the speed at which friction is
    # regularised, VREG = 0.01:
    # v s = mu_needed/mu of (15 - 10 s^2 + 3 s^4) s/8
    sliding = locked["3/SLIDING_SPEED"][len(locked.t) // 2 :]
    s = brentq(lambda s: (15 - 10 * s**2 + 3 * s**4) * s / 8 - 1 / 1.1, 0, 1)
    assert sliding == pytest.approx(0.01 * s, rel=1e-6)
    free = worm.released(radians(lead), 0.9 * limit, tmp_path)
    speed, t = free["1/SPEED"], free.t
    assert np.all(np.diff(speed)[5:] > 0) or np.all(np.diff(speed)[5:] < 0)
    # uniform acceleration of both inertias by what friction leaves of the torque:
    # J_A a = eta T_in, with T_in = T - J_B a/15 at the wheel, over the ratio 15
    eta = worm.closed_form(radians(lead), 0.9 * limit, False)
    acceleration = 1000 / 15 * eta / (5 + 50 / 15**2 * eta)
    measured = abs(speed[-1] - speed[len(t) // 2]) / (t[-1] - t[len(t) // 2])
    assert measured == pytest.approx(acceleration, rel=1e-6)
