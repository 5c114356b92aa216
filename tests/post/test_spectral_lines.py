# SPDX-License-Identifier: BSD-3-Clause
"""Tables of lines against signals whose lines are known: weak ones beside strong ones, none from leakage."""

from __future__ import annotations

import numpy as np
import pytest
from engrane_post.order_spectra import order_spectrum, over_angle
from engrane_post.spectra import WINDOWS, spectrum
from engrane_post.spectral_lines import COSINES, RESOLUTION, Kernel

STEP = 1e-3


def wave(lines: list[tuple[float, float]], span: float) -> tuple[np.ndarray, np.ndarray]:
    t = STEP * np.arange(round(span / STEP))
    y = sum(a * np.sin(2 * np.pi * f * t + 0.7 * j) for j, (f, a) in enumerate(lines))
    return t, 3 + y


def compare(found: list[tuple[float, float]], expected: list[tuple[float, float]]) -> None:
    assert len(found) == len(expected)
    for (f, a), (f0, a0) in zip(sorted(found), sorted(expected), strict=True):
        assert f == pytest.approx(f0, abs=1e-3)
        assert a == pytest.approx(a0, rel=2e-3)


@pytest.mark.parametrize("span", [4.0, 4.31, 5.17, 6.4, 8.83])
@pytest.mark.parametrize("window", WINDOWS)
def test_side_bands_of_a_strong_line(window: str, span: float) -> None:
    """A side band of 0.3 % stands on side lobes of up to 2.4 % (hann)."""
    lines = [(90.0, 840.0), (89.3, 2.3), (90.7, 2.0), (120.13, 170.0), (119.4, 0.5), (30.0, 14.0)]
    compare(spectrum(*wave(lines, span), window).peaks(8), lines)


@pytest.mark.parametrize("window", WINDOWS)
@pytest.mark.parametrize("phase", [0.0, 1.0, 2.0, 3.0])
def test_two_equal_lines(window: str, phase: float) -> None:
    t = STEP * np.arange(4000)
    apart = 1.1 * RESOLUTION[window] / 4
    y = np.sin(2 * np.pi * 60.1 * t) + np.sin(2 * np.pi * (60.1 + apart) * t + phase)
    compare(spectrum(t, y, window).peaks(8), [(60.1, 1.0), (60.1 + apart, 1.0)])


@pytest.mark.parametrize("decay", [0.3, 1.0, 3.0, 10.0])
@pytest.mark.parametrize("window", WINDOWS)
def test_a_dying_oscillation_is_one_line(window: str, decay: float) -> None:
    """It is no sine: what one sine leaves over must not become lines; a line apart must stay."""
    t = STEP * np.arange(4000)
    y = np.exp(-decay * t / 4) * np.sin(2 * np.pi * 60.1 * t)
    (f, _), *more = spectrum(t, y, window).peaks(8)
    assert more == []
    assert f == pytest.approx(60.1, abs=0.1)
    both = spectrum(t, y + 0.1 * np.sin(2 * np.pi * 200.1 * t), window).peaks(8)
    other = [p for p in both if p[0] > 100]
    assert len(both) == 2
    assert other[0] == (pytest.approx(200.1, abs=0.01), pytest.approx(0.1, rel=0.02))


def test_a_drift_does_not_hide_a_small_line() -> None:
    t = STEP * np.arange(4000)
    found = spectrum(t, t**2 + 0.02 * np.sin(2 * np.pi * 30.1 * t)).peaks(8)
    assert found[1:] == [(pytest.approx(30.1, abs=0.01), pytest.approx(0.02, rel=0.01))]


@pytest.mark.parametrize("window", WINDOWS)
def test_transform_of_the_window(window: str) -> None:
    import scipy.signal

    n = 64
    w = np.ones(n) if window == "none" else scipy.signal.get_window(window, n)
    kernel = Kernel(window, n)
    for x in (0.0, 0.3, 1.0, 2.5, 31.7, 63.9, 64.0):
        exact = np.sum(w * np.exp(-2j * np.pi * x * (np.arange(n) - n / 2) / n)) / w.sum()
        assert kernel(np.array([x]))[0] == pytest.approx(exact, abs=1e-12)
    x = np.linspace(len(COSINES[window]) + 0.1, 20, 300)
    assert (np.abs(kernel(x)) <= 1.2 * kernel.bound(x)).all()


@pytest.mark.parametrize("window", WINDOWS)
def test_resolution(window: str) -> None:
    """Half the sum of two kernels in the middle between them: their maximum alone (6 dB bandwidth)."""
    kernel = Kernel(window, 4096)
    assert abs(kernel(np.array([RESOLUTION[window] / 2]))[0]) == pytest.approx(0.5, abs=5e-3)
    t, y = wave([(50.0, 1.0)], 4.0)
    assert spectrum(t, y, window).resolution == pytest.approx(RESOLUTION[window] / 4)


def test_orders_take_whole_turns() -> None:
    t = np.linspace(0, 1, 20001)
    angle = 2 * np.pi * 6.37 * t
    y = 100 * np.sin(60 * angle) + 0.3 * np.sin(178 / 3 * angle) + 0.2 * np.cos(61 * angle)
    s = order_spectrum(over_angle(t, y, angle, whole=True))
    assert s.step * len(s.samples) == pytest.approx(6, abs=1e-9)
    compare(s.peaks(8), [(60.0, 100.0), (178 / 3, 0.3), (61.0, 0.2)])
    half = order_spectrum(over_angle(t, y, 0.1 * angle, whole=True))
    assert half.step * len(half.samples) == pytest.approx(0.637, rel=1e-3)
