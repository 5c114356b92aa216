# SPDX-License-Identifier: BSD-3-Clause
"""Histories over the angle of a wheel: order spectra, and order against speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from .errors import UserError
from .spectra import ROUNDING, Spectrum, spectrum

MOST_SAMPLES = 2**21
FEWEST = 8


@dataclass(frozen=True)
class OverAngle:
    """A history at even steps of a wheel's turn. `turns` counts from the beginning of the span, `time` is
    when; orders above `highest` have less than four samples in a period at the highest speed: too few to be
    interpolated within 1 %."""

    turns: np.ndarray
    time: np.ndarray
    values: np.ndarray
    highest: float


@dataclass(frozen=True)
class OrderMap:
    """Amplitude (blocks x orders) of stretches of `turns` turns each, and their mean speeds (turns per
    time, rising), weighted over the stretch as the amplitudes are."""

    order: np.ndarray
    speed: np.ndarray
    amplitude: np.ndarray
    turns: float


def turns_of(t: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Times and turns, rising from 0, of a wheel that turns one way; samples at rest are left out. The
    angle is in radians."""
    turns = (np.asarray(angle, float) - angle[0]) / (2 * np.pi)
    turns = turns if turns[-1] >= 0 else -turns
    step = np.diff(turns)
    back = np.flatnonzero(step < -1e-12 * max(1.0, np.abs(turns).max()))
    if len(back):
        raise UserError(
            f"The wheel turns back at t = {t[back[0]]:g}; orders need a wheel that turns one way. "
            "Choose a span with --from and --to."
        )
    reached = np.maximum.accumulate(turns)
    keep = np.r_[True, reached[1:] > reached[:-1]]
    if keep.sum() < FEWEST:
        raise UserError("The wheel does not turn in this span.")
    return np.asarray(t, float)[keep], turns[keep]


def over_angle(t: np.ndarray, y: np.ndarray, angle: np.ndarray, whole: bool = False) -> OverAngle:
    """Resamples a history over the turn of a wheel, finely enough for what its steps in time hold at the
    lowest speed, so that nothing folds back to a lower order (up to MOST_SAMPLES samples: a wheel that
    starts from rest would need any number). `whole` takes the last whole turns, where the span has one: the
    events of the wheel then fall on bins, where a window leaks least."""
    rising = np.r_[np.diff(t) > 0, True]  # a restart or an event repeats a time: the last value counts
    t, y, angle = (np.asarray(v, float)[rising] for v in (t, y, angle))
    when, turns = turns_of(t, angle)
    steps = np.diff(turns)
    most = min(MOST_SAMPLES, 16 * len(when))
    count = int(min(most, max(FEWEST, np.ceil(turns[-1] / steps.min()))))
    cut = turns[-1] - np.floor(turns[-1] + 1e-6) if whole and turns[-1] > 1 - 1e-6 else 0.0
    even = np.linspace(max(0.0, cut), turns[-1], count + 1)
    at = scipy.interpolate.PchipInterpolator(turns, when)(even)
    # The monotone interpolant is a start; where the wheel moves, the spline of its turn is nearer to the
    # motion.
    smooth = scipy.interpolate.CubicSpline(when, turns)
    for _ in range(2):
        speed = smooth(at, 1)
        moving = speed > 0.1 * turns[-1] / (when[-1] - when[0])
        at[moving] -= (smooth(at[moving]) - even[moving]) / speed[moving]
    at = np.clip(np.maximum.accumulate(at), when[0], when[-1])
    # a cubic one loses 1.5 % of a wave with four samples in a period
    values = scipy.interpolate.make_interp_spline(t, y, k=5)(at)
    return OverAngle(even, at, values, float(0.25 / steps.max()))


def order_spectrum(samples: OverAngle, window: str = "hann") -> Spectrum:
    """Amplitude against order: the `frequency` of this spectrum counts events per turn of the wheel."""
    turns = samples.turns[-1] - samples.turns[0]
    # of whole turns the last sample is the first of the next one
    last = -1 if turns > 0.5 and abs(turns - round(turns)) < 1e-9 * turns else None
    return spectrum(samples.turns[:last], samples.values[:last], window)


def order_map(
    samples: OverAngle, turns: float, highest: float, window: str = "hann", overlap: float = 0.75
) -> OrderMap:
    """Order spectra of stretches of equal turn, which overlap by a share; all of them are single-sided and
    show 1 for a sine of amplitude 1, as `spectrum` does."""
    step = samples.turns[1] - samples.turns[0]
    n = round(turns / step)
    if not FEWEST <= n <= len(samples.turns):
        raise UserError(
            f"A stretch of {turns:g} turns does not fit: the span has {samples.turns[-1]:g} turns, "
            f"and {FEWEST} samples are {FEWEST * step:.3g} turns."
        )
    starts = np.arange(0, len(samples.turns) - n + 1, max(1, round(n * (1 - overlap))))
    w = np.ones(n) if window == "none" else scipy.signal.get_window(window, n, fftbins=True)
    length = 4 * n
    order = np.fft.rfftfreq(length, step)
    shown = order <= highest
    pace = step / np.maximum(np.gradient(samples.time), 1e-300)
    speed, amplitude = [], []
    for start in starts:
        part = samples.values[start : start + n]
        mean = np.average(part, weights=w)
        row = np.abs(np.fft.rfft((part - mean) * w, length))[shown] * 2 / w.sum()
        amplitude.append(row if row.max() > ROUNDING * abs(mean) else 0 * row)
        speed.append(np.average(pace[start : start + n], weights=w))
    rank = np.argsort(speed, kind="stable")
    return OrderMap(order[shown], np.array(speed)[rank], np.array(amplitude)[rank], n * step)
