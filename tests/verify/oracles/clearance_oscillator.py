# SPDX-License-Identifier: BSD-3-Clause
"""An oscillator with a clearance, the simplest gear pair with backlash, with its own location of contacts.

    x'' + 2 zeta x' + g(x) = F_m + F_a W^2 cos(phase),   phase' = W
    g = x - 1 (x > 1), 0, x + 1 (x < -1);   zeta = 0.05, F_m = 0.1, F_a = 0.05

Each stretch between contacts is integrated by itself (Dormand-Prince of order 8) and ends where x passes +-1.
The frequency is constant, W = W_0, or swept, W = W_0 + rate t, and then held. Below the loss of contact the
motion is that of the linear oscillator about 1 + F_m, with amplitude
F_a W^2/sqrt((1 - W^2)^2 + (2 zeta W)^2).

    python tests/verify/oracles/clearance_oscillator.py      steady states and where they start
"""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp

ZETA, F_M, F_A = 0.05, 0.1, 0.05


def linear_rms(frequency: float) -> float:
    """Of x less its mean while the flank is never left."""
    w = frequency
    return F_A * w**2 / math.hypot(1 - w**2, 2 * ZETA * w) / math.sqrt(2)


def linear_start(frequency: float) -> tuple[float, float]:
    """x and x' at phase 0 of the steady motion that never leaves the flank."""
    w = frequency
    z = F_A * w**2 / complex(1 - w**2, 2 * ZETA * w)
    return 1 + F_M + z.real, -w * z.imag


def simulate(
    start, frequency: float, times: np.ndarray, rate: float = 0.0, hold: float = math.inf, rtol: float = 1e-9
):
    """x, x' at `times` (the first is the start) and the instants at which x passed +-1. The sweep ends at the
    time `hold`."""
    x, v = start
    t, end = float(times[0]), float(times[-1])
    region = 1 if x > 1 else -1 if x < -1 else 0
    out = np.empty((2, len(times)))
    out[:, 0] = start
    contacts = []

    def wall(level: float):
        def event(_, y):
            return y[0] - level

        event.terminal = True
        return event

    walls = {1: [wall(1)], 0: [wall(1), wall(-1)], -1: [wall(-1)]}
    walls[1][0].direction, walls[-1][0].direction = -1, 1
    walls[0][0].direction, walls[0][1].direction = 1, -1
    while t < end:

        def slope(time, y, region=region):
            swept = min(time, hold)
            w = frequency + rate * swept
            force = F_M + F_A * w**2 * math.cos((frequency + 0.5 * rate * swept) * swept + w * (time - swept))
            return [y[1], force - 2 * ZETA * y[1] - (y[0] - region if region else 0.0)]

        wanted = times[(times > t) & (times <= end)]
        done = solve_ivp(
            slope,
            (t, end),
            [x, v],
            "DOP853",
            dense_output=True,
            events=walls[region],
            rtol=rtol,
            atol=1e-3 * rtol,
            max_step=1.0,
        )
        t = float(done.t[-1])
        wanted = wanted[wanted <= t]
        first = int(np.searchsorted(times, wanted[0])) if len(wanted) else 0
        if len(wanted):
            out[:, first : first + len(wanted)] = done.sol(wanted)
        x, v = done.y[:, -1]
        if done.status != 1:
            break
        contacts.append(t)
        x = round(x)
        region = (1 if x > 0 else -1) if region == 0 else 0
    return out[0], out[1], contacts


def steady(start, frequency: float, settle: int = 120, measure: int = 4):
    """Mean, rms of x less the mean, and the state at phase 0, after `settle` periods."""
    period = 2 * math.pi / frequency
    x, v, _ = simulate(start, frequency, np.linspace(0, settle * period, settle + 1))
    begin = (float(x[-1]), float(v[-1]))
    times = np.linspace(0, measure * period, 4000 * measure + 1)
    x, _, _ = simulate(begin, frequency, times)
    return float(x[:-1].mean()), float(x[:-1].std()), begin


def main() -> None:
    cases = [
        ("0.8, no impacts", linear_start(0.8), 0.8),
        ("0.8, impacts", (1.3, 0.3), 0.8),
        ("1.0", (1.1, 0.0), 1.0),
        ("1.6", linear_start(1.6), 1.6),
    ]
    for name, start, frequency in cases:
        mean, rms, begin = steady(start, frequency)
        print(
            f"W = {name}: mean {mean:.9f}, rms {rms:.9f}, rms of x - 1 {math.hypot(mean - 1, rms):.9f},",
            end=" ",
        )
        print(f"at phase 0: x - 1 = {begin[0] - 1:.12f}, x' = {begin[1]:.12f}")


if __name__ == "__main__":
    main()
