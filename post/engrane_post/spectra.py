# SPDX-License-Identifier: BSD-3-Clause
"""Amplitude spectra of histories."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy  # whose parts load where they are used: they take half a second, and most commands use none

from .spectral_lines import RESOLUTION, Fit, Line, leak

ROUNDING = 1e-12  # of its mean: a history all of whose lines are smaller is constant
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
    window_name: str

    def at(self, frequency: float) -> float:
        """Amplitude at any frequency (the transform evaluated there, not interpolated)."""
        n = len(self.samples)
        phase = np.exp(-2j * np.pi * frequency * self.step * np.arange(n))
        return float(2 * abs(np.dot(self.samples * self.window, phase)) / self.window.sum())

    @property
    def resolution(self) -> float:
        """Lines closer than this show as one; in units of `frequency`."""
        return RESOLUTION[self.window_name] / (self.step * len(self.samples))

    @property
    def constant(self) -> bool:
        """The history does not vary, but for rounding."""
        return not self.samples.any()

    def lines(self, count: int) -> tuple[list[tuple[float, float]], bool]:
        """The largest `peaks` above the resolution, and whether there is something below: about one period
        in the span cannot be told from a drift."""
        found = self.peaks(count + 2) if not self.constant else []
        clear = [p for p in found if p[0] >= self.resolution * (1 - 1e-9)]
        return clear[:count], len(clear) < len(found)

    def peaks(self, count: int, floor: float = 1e-4) -> list[tuple[float, float]]:
        """(frequency, amplitude) of the largest lines, largest first, none below `floor` times the largest.

        A line is listed only where it stands clear of the leakage of all larger ones (spectral_lines.py). Its
        amplitude is the largest value of the transform near it, between the bins, without the leakage of the
        other lines."""
        n = len(self.samples)
        total = self.window.sum()
        alternating = np.where(np.arange(n // 2 + 1) % 2, -1.0, 1.0)  # counts the time from the middle
        peak = float(np.abs(self.samples).max())
        fit = Fit(np.fft.rfft(self.samples * self.window) / total * alternating, self.window_name, n, peak)
        fit.add_lines(2 * count + 4, 0.5 * floor)
        tapered = self.samples * self.window / total
        phase = -2j * np.pi / n * (np.arange(n) - n / 2)
        out = []
        for line in fit.listed()[:count]:
            others = fit.others(line)
            mirror = Line(-line.place, np.conj(line.height))

            def shown(place: float, others=others, mirror=mirror) -> float:
                at = np.array([place])
                own = np.dot(tapered, np.exp(phase * place)) - leak(fit.kernel, others, at)[0]
                own -= mirror.height * fit.kernel(at - mirror.place)[0] + fit.mean * fit.kernel(at)[0]
                return 2 * float(abs(own))

            best = scipy.optimize.minimize_scalar(
                lambda p, shown=shown: -shown(p),
                bounds=(max(line.place - 0.5, 1.0), line.place + 0.5),
                method="bounded",
                options={"xatol": 1e-4},
            )
            out.append((float(best.x) / (n * self.step), float(-best.fun)))
        out.sort(key=lambda p: -p[1])
        return [p for p in out if p[1] >= floor * out[0][1]]


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


def no_lines(s: Spectrum, below: bool) -> str:
    """Why a table has no lines, or fewer than the diagram."""
    if s.constant:
        return "no lines: the history is constant to rounding"
    slow = f"left out: what has less than {RESOLUTION[s.window_name]:g} periods in this span, as a drift has"
    return slow if below else "no lines: the history has no oscillation in this span"


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
    if a.max() <= ROUNDING * abs(mean):
        samples, a = np.zeros(n), np.zeros(len(a))
    return Spectrum(np.fft.rfftfreq(length, step), a, mean, step, resampled, samples, w, window)
