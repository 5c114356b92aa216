# SPDX-License-Identifier: BSD-3-Clause
"""Amplitude spectra of histories."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy  # whose parts load where they are used: they take half a second, and most commands use none

WINDOWS = ("hann", "none", "blackman")


@dataclass(frozen=True)
class Spectrum:
    """Single-sided amplitude spectrum: a sine of amplitude 1 shows 1. `mean` was taken off first; `step` is
    the sampling interval, `resampled` tells that the history had uneven steps."""

    frequency: np.ndarray
    amplitude: np.ndarray
    mean: float
    step: float
    resampled: bool
    samples: np.ndarray
    window: np.ndarray

    def at(self, frequency: float) -> float:
        """Amplitude at any frequency (the transform evaluated there, not interpolated)."""
        n = len(self.samples)
        phase = np.exp(-2j * np.pi * frequency * self.step * np.arange(n))
        return float(2 * abs(np.dot(self.samples * self.window, phase)) / self.window.sum())

    def peaks(self, count: int, floor: float = 1e-4) -> list[tuple[float, float]]:
        """(frequency, amplitude) of the largest lines, largest first, none below `floor` times the largest.

        Lines are local maxima among the plain bins, where the side lobes of a window make none, and are then
        refined between the bins; without that a line halfway would show 15 % less (hann)."""
        n = len(self.samples)
        a = np.abs(np.fft.rfft(self.samples * self.window)) * 2 / self.window.sum()
        hz = np.fft.rfftfreq(n, self.step)
        inner = np.flatnonzero((a[1:-1] > a[:-2]) & (a[1:-1] >= a[2:])) + 1
        if len(inner) == 0:
            return []
        inner = inner[a[inner] >= floor * a[inner].max()]
        inner = inner[np.argsort(-a[inner])][:count]
        out = []
        for i in inner:
            best = scipy.optimize.minimize_scalar(
                lambda f: -self.at(f),
                bounds=(hz[i - 1], hz[i + 1]),
                method="bounded",
                options={"xatol": 1e-4 * hz[1]},
            )
            out.append((float(best.x), float(-best.fun)))
        return sorted(out, key=lambda p: -p[1])


def uniform(t: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, bool]:
    """Evenly spaced samples of a history. Uneven steps are resampled by a cubic spline at the median step;
    repeated times (a restart, an event) keep their last value."""
    keep = np.r_[np.diff(t) > 0, True]
    t, y = t[keep], y[keep]
    steps = np.diff(t)
    step = float(np.median(steps))
    if np.abs(steps - step).max() <= 1e-6 * step + 1e-12 * abs(t[-1]):
        return t, y, False
    count = int(np.floor((t[-1] - t[0]) / step + 1e-9)) + 1
    even = t[0] + step * np.arange(count)
    return even, scipy.interpolate.CubicSpline(t, y)(even), True


def spectrum(t: np.ndarray, y: np.ndarray, window: str = "hann", padding: int = 4) -> Spectrum:
    """Spectrum of a history (at least 8 samples). `padding` lengthens the transform with zeros, for a smooth
    curve."""
    even, values, resampled = uniform(np.asarray(t, float), np.asarray(y, float))
    n = len(values)
    step = float((even[-1] - even[0]) / (n - 1))
    w = np.ones(n) if window == "none" else scipy.signal.get_window(window, n, fftbins=True)
    mean = float(np.average(values, weights=w))
    samples = values - mean
    length = n * padding if n * padding < 2**24 else n
    a = np.abs(np.fft.rfft(samples * w, length)) * 2 / w.sum()
    return Spectrum(np.fft.rfftfreq(length, step), a, mean, step, resampled, samples, w)
