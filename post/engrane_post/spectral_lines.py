# SPDX-License-Identifier: BSD-3-Clause
"""Lines of a spectrum, told from the leakage of larger lines.

The window spreads every line over all bins: a weak line beside a strong one stands on the strong one's side
lobes, and neither its bin nor the local maxima around it show its frequency and amplitude. Lines are fitted
and removed one by one from the largest on, as CLEAN does (Högbom, Astron. Astrophys. Suppl. 15, 1974), with
the known transform of the window, and at each addition all of them are fitted again together (RELAX: Li and
Stoica, IEEE Trans. Signal Processing 44, 1996; here by damped Gauss-Newton in the bins of their main lobes).
Frequencies count bins in here.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

# Windows are sums of cosines: coefficients; resolution in bins (6 dB bandwidth of the main lobe, within which
# two equal lines show one maximum: Harris, Proc. IEEE 66, 1978, section IV); half width of the main lobe in
# bins, for no window with the first side lobe: in three bins two sines that cancel fit any changing line.
COSINES = {"none": (1.0,), "hann": (0.5, -0.5), "blackman": (0.42, -0.5, 0.08)}
RESOLUTION = {"none": 1.21, "hann": 2.0, "blackman": 2.3}
LOBE = {"none": 2, "hann": 2, "blackman": 3}
# A fitted frequency is a little off where the signal is no pure sine: lines just at the resolution stay two.
SAME = 0.9
# A line that waxes, wanes or drifts leaks otherwise than a sine does. What a sine leaves over of its main
# lobe measures that; for a slope over the record the side lobes change by about 6 times as much.
IMPURE = 10.0
# What a line near a larger one may leave over of its main lobe: in a continuum (a chirp) 0.4 and more of its
# amplitude, with real lines, by neighbours within the resolution, measured up to 0.2.
LEFT = 0.3
BESIDE = 6  # sines that take the leakage of one line away; more of them only describe its shape
REACH = {"none": 20000, "hann": 400, "blackman": 400}  # bins beyond which leakage is below 2e-5


class Kernel:
    """Transform of a window of n samples with the time counted from its middle."""

    def __init__(self, window: str, n: int) -> None:
        self.window, self.n = window, n
        # about the middle the cosines change their sign by turns
        self.cosines = [a * (-1) ** m for m, a in enumerate(COSINES[window])]
        self.sum = n * self.cosines[0] if n > 4 else 1.0

    def _plain(self, x: np.ndarray) -> np.ndarray:
        """Of ones: sum of exp(-2 pi i x (j - n/2)/n) over j = 0 ... n - 1."""
        n = self.n
        turn = np.round(x / n)
        r = x - n * turn
        low = np.sin(np.pi * r / n)
        small = np.abs(r) < 1e-9
        ratio = np.where(small, n, np.sin(np.pi * r) / np.where(small, 1.0, low))
        return np.exp(1j * np.pi * (r / n + turn * n)) * ratio

    def __call__(self, x: np.ndarray) -> np.ndarray:
        """Relative to its largest value, at x = 0."""
        out = self.cosines[0] * self._plain(x)
        for m, a in enumerate(self.cosines[1:], 1):
            out = out + 0.5 * a * (self._plain(x - m) + self._plain(x + m))
        return out / self.sum

    def bound(self, x: np.ndarray) -> np.ndarray:
        """Of its modulus, by the side lobes without their sine; 1 in the middle."""
        x = np.abs(x)
        a = COSINES[self.window]
        inside = x <= 1.0
        x = np.where(inside, 1.5, x)
        with np.errstate(divide="ignore"):
            total = sum(c * x / (x * x - m * m) for m, c in enumerate(a))
        return np.where(inside, 1.0, np.minimum(1.0, np.abs(total) / (np.pi * a[0])))


@dataclass
class Line:
    """`height` exp(2 pi i `place` (j - n/2)/n) and its conjugate. `beside` are sines within the resolution:
    they belong to this line, which is no pure sine, and are there to take its leakage away."""

    place: float
    height: complex
    beside: list[Line] = field(default_factory=list)

    @property
    def amplitude(self) -> float:
        return 2 * abs(self.height)


def leak(kernel: Kernel, lines: list[Line], at: np.ndarray) -> np.ndarray:
    """What lines show at these places of the transform."""
    out = np.zeros(len(at), complex)
    for line in lines:
        out += line.height * kernel(at - line.place) + np.conj(line.height) * kernel(at + line.place)
    return out


class Fit:
    """`bins` is the transform of windowed samples over the sum of the window, time counted from the
    middle; `peak` is the largest sample."""

    def __init__(self, bins: np.ndarray, window: str, n: int, peak: float) -> None:
        self.bins = bins
        self.peak = peak
        self.n = n
        self.kernel = Kernel(window, n)
        self.lobe = LOBE[window]
        self.apart = SAME * RESOLUTION[window]
        self.reach = REACH[window]
        self.lines: list[Line] = []
        self.mean = 0.0
        self.highest = n / 2 - 1  # a line with less than a period, or than a bin below the highest, is none
        self.aside = np.zeros_like(bins)  # of all sines beside lines

    def add_lines(self, count: int, floor: float) -> None:
        """Removes the largest lines one by one, until `count` are found or the rest is below `floor` times
        the largest bin."""
        rest = self.bins.copy()
        largest = np.abs(self.bins[1:-1]).max(initial=0.0)
        least = floor * largest
        for _ in range(3 * count + 16):
            clear = np.where(self._clear(rest), np.abs(rest), 0.0)
            k = 1 + int(np.argmax(clear[1:-1]))
            if len(self.lines) >= count or clear[k] <= max(least, 1e-300):
                return
            one = self._single(k, rest)
            near = self._owner(one, self.lines)
            # Two lines of like size first look like one between them: both are tried before the second counts
            # as a part of the first.
            if near is None or not near.beside:
                before = [(line, line.place, line.height) for line in self.lines], self.mean
                self.lines.append(one)
                self._refine()
                # sines that nearly cancel are the shape of one line; the largest line is always taken
                tame = len(self.lines) == 1 or max(s.amplitude for s in self.lines) < 4 * largest
                if tame and all(
                    self._owner(s, [o for o in self.lines if o is not s]) is None for s in self.lines
                ):
                    rest = self._rest()
                    continue
                self.lines.pop()
                for line, place, height in before[0]:
                    line.place, line.height = place, height
                self.mean = before[1]
                one = self._single(k, rest)
                near = self._owner(one, self.lines) or min(self.lines, key=lambda o: abs(o.place - one.place))
            near.beside.append(one)
            self._take(self.aside, one, 1.0)
            self._take(rest, one, -1.0)

    def listed(self) -> list[Line]:
        """Lines that stand clearly above what is not known of the leakage of larger ones; largest first."""
        lines = sorted(self.lines, key=lambda line: -line.amplitude)
        unsure = self._unsure(self._rest(), lines)
        # What dies within the record is no sine at all: its leakage is that of its largest deflection.
        leaks = [
            max(IMPURE * u, self.peak if u > 0.5 * line.amplitude else 0.0)
            for line, u in zip(lines, unsure, strict=True)
        ]
        out = []
        for j, line in enumerate(lines):
            shade = sum(
                u * (self.kernel.bound(line.place - o.place) + self.kernel.bound(line.place + o.place))
                for o, u in zip(lines[:j], leaks[:j], strict=True)
            )
            near = any(abs(line.place - o.place) < 2 * self.lobe for o in lines[:j])
            if line.amplitude > shade and not (near and unsure[j] > LEFT * line.amplitude):
                out.append(line)
        return out

    def _unsure(self, rest: np.ndarray, lines: list[Line]) -> list[float]:
        """Amplitude that lines leave over in their main lobes: none where they are pure sines."""
        pure = rest + self.aside
        return [2 * float(np.abs(pure[self._lobe_of(line.place)]).max()) for line in lines]

    def _clear(self, rest: np.ndarray) -> np.ndarray:
        """Bins where a further line may be sought: those that the lines so far need not explain. A line not
        yet found is part of what they leave over, and must not hide itself: hence at most 0.7 of that."""
        shade = np.zeros(len(rest))
        for line, unsure in zip(self.lines, self._unsure(rest, self.lines), strict=True):
            k = np.arange(max(0, int(line.place) - self.reach), min(len(rest), int(line.place) + self.reach))
            share = np.minimum(IMPURE * self.kernel.bound(k - line.place), 0.7)
            shade[k] = np.maximum(shade[k], 0.5 * share * unsure)
            if len(line.beside) >= BESIDE:
                for sine in (line, *line.beside):
                    shade[self._lobe_of(sine.place)] = np.inf
        return np.abs(rest) > shade

    def others(self, line: Line) -> list[Line]:
        """All sines but that of a line and those beside it."""
        return [s for o in self.lines if o is not line for s in (o, *o.beside)]

    def _lobe_of(self, place: float) -> np.ndarray:
        k = np.arange(int(np.ceil(place - self.lobe)), int(np.floor(place + self.lobe)) + 1)
        return k[(k >= 0) & (k < len(self.bins))]

    def _owner(self, one: Line, lines: list[Line]) -> Line | None:
        """The line that a sine cannot be told from, itself or through one beside it."""
        for line in lines:
            if any(abs(one.place - s.place) < self.apart for s in (line, *line.beside)):
                return line
        return None

    def _single(self, k: int, rest: np.ndarray) -> Line:
        """One sine that leaves the least of the main lobe around bin k."""
        rows = self._lobe_of(float(k))
        best, found = np.inf, Line(float(k), rest[k])
        low, high = k - 0.5, k + 0.5
        for _ in range(4):
            places = np.linspace(low, high, 5)
            for place in np.clip(places, 1.0, self.highest):
                a, b = self.kernel(rows - place), self.kernel(rows + place)
                m = np.concatenate(
                    [[(a + b).real, (1j * (a - b)).real], [(a + b).imag, (1j * (a - b)).imag]], 1
                )
                y = np.concatenate([rest[rows].real, rest[rows].imag])
                p = np.linalg.lstsq(m.T, y, rcond=1e-9)[0]
                left = float(np.sum((y - p @ m) ** 2))
                if left < best:
                    best, found = left, Line(float(place), complex(p[0], p[1]))
            step = places[1] - places[0]
            low, high = found.place - step, found.place + step
        return found

    def _refine(self) -> None:
        """All lines and the mean together (Levenberg and Marquardt) in the bins of their main lobes."""
        lines = self.lines
        rows = np.unique(np.concatenate([self._lobe_of(s.place) for s in lines] + [np.arange(self.lobe)]))
        rows = rows[rows < len(self.bins)]
        y = self.bins[rows] - self.aside[rows]
        flat = self.kernel(rows.astype(float))

        def parts(places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            x = rows[:, None]
            return self.kernel(x - places), self.kernel(x + places)

        def left(places: np.ndarray, c: np.ndarray, mean: float) -> np.ndarray:
            a, b = parts(places)
            return y - a @ c - b @ np.conj(c) - mean * flat

        places = np.array([s.place for s in lines])
        c = np.array([s.height for s in lines])
        mean, damping, h = self.mean, 1e-6, 1e-4
        r = left(places, c, mean)
        cost = float(np.sum(np.abs(r) ** 2))
        for _ in range(30):
            a, b = parts(places)
            (a1, b1), (a0, b0) = parts(places + h), parts(places - h)
            slope = ((a1 - a0) * c + (b1 - b0) * np.conj(c)) / (2 * h)
            m = np.hstack([a + b, 1j * (a - b), slope, flat[:, None]])
            m = np.vstack([m.real, m.imag])
            size = np.linalg.norm(m, axis=0)
            size[size == 0] = 1.0
            m /= size
            wide = np.concatenate([r.real, r.imag, np.zeros(m.shape[1])])
            p = (
                np.linalg.lstsq(np.vstack([m, np.sqrt(damping) * np.eye(m.shape[1])]), wide, rcond=None)[0]
                / size
            )
            n = len(lines)
            to = np.clip(places + np.clip(p[2 * n : 3 * n], -0.25, 0.25), 1.0, self.highest)
            trial = to, c + p[:n] + 1j * p[n : 2 * n], mean + p[-1]
            r1 = left(*trial)
            cost1 = float(np.sum(np.abs(r1) ** 2))
            if cost1 < cost:
                done = cost - cost1 <= 1e-10 * cost
                (places, c, mean), r, cost, damping = trial, r1, cost1, max(damping / 10, 1e-12)
                if done:
                    break
            else:
                damping = max(100 * damping, 1e-8)
                if damping > 1e3:
                    break
        for line, place, height in zip(lines, places, c, strict=True):
            line.place, line.height = float(place), complex(height)
        self.mean = mean

    def _take(self, bins: np.ndarray, line: Line, factor: float) -> None:
        k = np.arange(max(0, int(line.place) - self.reach), min(len(bins), int(line.place) + self.reach))
        bins[k] += factor * leak(self.kernel, [line], k.astype(float))

    def _rest(self) -> np.ndarray:
        rest = self.bins - self.aside
        for line in self.lines:
            self._take(rest, line, -1.0)
        k = np.arange(min(len(rest), self.reach))
        rest[k] -= self.mean * self.kernel(k.astype(float))
        return rest
