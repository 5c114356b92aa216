# SPDX-License-Identifier: BSD-3-Clause
"""What `engrane study` compares: numbers and histories of runs, their sizes, errors against a reference."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from . import channels
from .errors import UserError
from .results import Channel, Results
from .runs import Run

#: an error below so many times that of the reference is not believed
DOUBT = 3
#: of all histories those count that vary by this part of what the most varying one of the same kind does
SENSIBLE = 1e-3
#: a history that varies by less than this part of its size stands still
STILL = 1e-9


@dataclass
class Values:
    """Numbers of one run by name, and histories at common instants (s each) by the name of their channel."""

    numbers: dict[str, float] = field(default_factory=dict)
    times: np.ndarray = field(default_factory=lambda: np.empty(0))
    histories: dict[str, np.ndarray] = field(default_factory=dict)


def read(run: Run, wanted: Iterable[str], interval: float, start: float, end: float) -> Values:
    """What a run gave. Samples at other instants than multiples of the interval and the end are left out:
    they come from steps that were cut."""
    values = Values({n: v for n, v in run.numbers.items() if v is not None})
    names = list(wanted)
    if not names:
        return values
    with Results(run.prefix) as results:
        t = results.times()
        place = (t - start) / interval
        regular = (np.abs(place - np.round(place)) < 1e-6) | (t >= end - 1e-9 * interval)
        # of an instant that was seen twice, at a jump, the first
        regular &= np.diff(t, prepend=-np.inf) > 1e-9 * interval
        values.times = t[regular]
        found = results.channels
        values.histories = {n: results.history(found[n])[1][regular] for n in names if n in found}
    return values


@dataclass
class Truth:
    """What the errors are measured against."""

    name: str  # how it came about
    values: Values
    sizes: dict[str, float]  # by name: what errors are divided by
    own: dict[str, float] = field(default_factory=dict)  # its own errors, over the sizes
    left_out: list[str] = field(default_factory=list)  # names, each with the reason

    @property
    def error(self) -> float:
        """The largest of its own errors; 0: not known."""
        return max(self.own.values(), default=0.0)

    @property
    def floor(self) -> float:
        """Errors below this are not believed."""
        return DOUBT * self.error

    def errors(self, values: Values) -> dict[str, float]:
        """Of each number and history, over its size: of a history the largest. NaN: no value."""
        out = {}
        for name, size in self.sizes.items():
            if name in self.values.numbers:
                difference = abs(values.numbers.get(name, np.nan) - self.values.numbers[name])
            else:
                difference = _distance(values, self.values, name)
            out[name] = float(difference / size)
        return out

    def keep(self, names: Iterable[str]) -> None:
        """Errors are told of these only."""
        self.sizes = {n: self.sizes[n] for n in names}
        self.own = {n: e for n, e in self.own.items() if n in self.sizes}

    def leave_out(self, name: str, reason: str) -> None:
        """Errors are not told of it."""
        del self.sizes[name]
        self.own.pop(name, None)
        self.left_out.append(f"{name}: {reason}")


def _distance(mine: Values, theirs: Values, name: str) -> float:
    """The largest difference at the instants that both have; NaN when they have too few in common."""
    if name not in mine.histories:
        return np.nan
    gap = 1e-6 * np.min(np.diff(theirs.times), initial=np.inf)
    at = np.clip(np.searchsorted(theirs.times, mine.times - gap), 0, len(theirs.times) - 1)
    same = np.abs(theirs.times[at] - mine.times) <= gap
    if 2 * same.sum() < len(theirs.times):
        return np.nan
    return float(np.max(np.abs(mine.histories[name][same] - theirs.histories[name][at[same]])))


def range_of(history: np.ndarray) -> float:
    """Largest less least; 0 of one that stands still."""
    span = float(np.max(history) - np.min(history))
    return span if span > STILL * float(np.max(np.abs(history))) else 0.0


def truth_of_runs(name: str, fine: Values, coarse: Values) -> Truth:
    """The finer of two runs; how much they differ is taken for its own error."""
    sizes = {n: abs(v) for n, v in fine.numbers.items()} | {n: range_of(h) for n, h in fine.histories.items()}
    truth = Truth(name, fine, sizes)
    for n, size in list(sizes.items()):
        if not np.isfinite(size):
            truth.leave_out(n, "the reference is not finite")
        elif size == 0:
            truth.leave_out(n, "it is 0" if n in fine.numbers else "it does not change")
    truth.own = truth.errors(coarse)
    for n, own in list(truth.own.items()):
        if not own < 0.1:
            truth.leave_out(n, f"the reference's own error is {own:.1g} of its size")
    return truth


def truth_of_checks(run: Run) -> Truth:
    """The values V of the deck's .CHK."""
    expected = {c["name"]: c["expected"] for c in run.summary.get("checks", [])}
    truth = Truth("values of .CHK", Values(expected), {n: abs(v) for n, v in expected.items()})
    for n, value in expected.items():
        if value == 0:
            truth.leave_out(n, "its V is 0, no size to compare with")
    return truth


def checks_that_tell(run: Run, start: float) -> list[str]:
    """The deck's checks that tell of accuracy: of nodes and elements; not of the start, nor of a 0."""

    def tells(check: dict[str, Any]) -> bool:
        subject, _, time = check["name"].partition(" at t = ")
        of_start = bool(time) and float(time) <= start
        return check["expected"] != 0 and "RUN " not in subject and not of_start

    return [c["name"] for c in run.summary.get("checks", []) if tells(c)]


def sensible(known: dict[str, Channel], truth: Truth) -> list[str]:
    """Of all histories those that vary as much as others of nodes, or of elements, of their unit do."""
    most: dict[tuple[str, str], float] = {}
    names = [n for n in truth.sizes if n in known]
    for n in names:
        key = (n.split("/")[0], known[n].unit)
        most[key] = max(most.get(key, 0.0), truth.sizes[n])
    return [n for n in names if truth.sizes[n] >= SENSIBLE * most[n.split("/")[0], known[n].unit]]


def resolve(wanted: list[str], known: list[str], deck: str) -> list[str]:
    """Full names of the channels asked for; there may be commas between them."""
    names = [name for text in wanted for name in text.split(",") if channels.normalise(name)]
    if not names:
        raise UserError("--channels takes names such as element/7/NORMAL_FORCE.")
    found: dict[str, None] = {}
    for name in names:
        try:
            found |= dict.fromkeys(channels.resolve(name, known, deck))
        except UserError as error:
            hint = "Run it, and `engrane plot` shows all with --list."
            raise UserError(str(error).replace(channels.LISTING_HINT, hint)) from None
    return list(found)
