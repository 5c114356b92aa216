# SPDX-License-Identifier: BSD-3-Clause
"""Table and recommendation of `engrane study`."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from .runs import Run
from .study_deck import Card, Ladder, Rung
from .study_errors import Truth

#: seconds of processor time within which two runs cost the same, and the part of the time
SAME_SECONDS, SAME_PART = 0.005, 0.05
SHORTEST = 0.001  # seconds; shorter ones drown in the start of the program


@dataclass
class Attempt:
    """One setting with one step and solver, and what came of it."""

    ladder: Ladder
    rung: Rung
    solver: str
    cards: tuple[Card, Card]  # .SAM and .SUB
    run: Run
    seconds: float = math.nan  # of processor time, without the start of the program
    errors: dict[str, float] = field(default_factory=dict)
    slope: float | None = None  # how much smaller errors get from the rung before, as a power of the step

    @property
    def title(self) -> str:
        return f"{self.ladder.title}, {self.rung.title}"

    @property
    def steps(self) -> int:
        return self.run.summary.get("steps", 0)

    @property
    def worst(self) -> str:
        """The number or history with the largest error; one without a value is the worst."""
        return max(
            self.errors, key=lambda n: math.inf if math.isnan(self.errors[n]) else self.errors[n], default=""
        )

    @property
    def error(self) -> float:
        return self.errors.get(self.worst, math.nan)

    @property
    def median(self) -> float:
        return float(np.median(list(self.errors.values()))) if self.errors else math.nan

    @property
    def tells(self) -> bool:
        """The run was solved and its error is known."""
        return self.run.solved and math.isfinite(self.error)

    @property
    def failure(self) -> str:
        """Why there is no error; empty where there is one."""
        if not self.run.solved:
            return " ".join(self.run.reason.removeprefix("engrane: ").split())
        return "" if self.tells else f"no value of {self.worst}"


def find_slopes(attempts: Sequence[Attempt], floor: float) -> None:
    """Of each run from the one before it on its ladder that made fewer steps; none where an error is below
    what the reference can tell. Steps are counted, since those that failed were cut."""
    before: dict[tuple[str, str], Attempt] = {}
    for a in attempts:
        if not a.tells or a.error <= 0:
            continue
        last = before.get((a.ladder.title, a.solver))
        if last and min(a.error, last.error) > floor and a.steps > 1.2 * last.steps > 0:
            a.slope = math.log(last.error / a.error) / math.log(a.steps / last.steps)
        before[a.ladder.title, a.solver] = a


def cheapest(attempts: Sequence[Attempt], target: float, floor: float) -> Attempt | None:
    """The run of the least time whose error is at most the target, and stays there with all shorter steps of
    its ladder: an error that is small by chance recommends nothing. Of runs of the same cost the most
    accurate one."""
    good = []
    for a in attempts:
        finer = [
            b for b in attempts if b.tells and b.ladder.title == a.ladder.title and b.rung.size <= a.rung.size
        ]
        if a.tells and all(max(b.error, floor) <= target for b in finer):
            good.append(a)
    if not good:
        return None
    least = min(a.seconds for a in good)
    same = [a for a in good if a.seconds <= max(least * (1 + SAME_PART), least + SAME_SECONDS)]
    return min(same, key=lambda a: (max(a.error, floor), a.seconds))


def short(value: float) -> str:
    """Two digits: `1.2e-3`; nothing for what is not known."""
    if math.isnan(value):
        return ""
    mantissa, _, power = f"{value:.1e}".partition("e")
    return f"{mantissa.removesuffix('.0')}e{int(power)}" if value != 0 else "0"


def error_text(error: float, floor: float) -> str:
    """An error, or what it is below."""
    return f"< {short(floor)}" if error < floor else short(error)


def print_table(attempts: Sequence[Attempt], truth: Truth) -> None:
    """All runs as a Markdown table."""
    several = len(truth.sizes) > 2
    head = ["setting", "solver", "steps of", "steps", "failed", "iterations", "s", "error"]
    rows = [[*head, *(["median"] if several else []), "slope"]]
    for a in attempts:
        row = [a.ladder.title, a.solver, a.rung.title]
        if a.tells:
            counts = [a.run.summary[key] for key in ("steps", "failed_attempts", "iterations")]
            effort = [*map(str, counts), f"{a.seconds:.3f}"]
            errors = [error_text(a.error, truth.floor), *([short(a.median)] if several else [])]
            row += [*effort, *errors, "" if a.slope is None else f"{a.slope:.1f}"]
        else:
            row += ["", "", "", "", "failed", *([""] if several else []), ""]
        rows.append(row)
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for i, row in enumerate(rows):
        cells = [
            cell.ljust(w) if k < 3 else cell.rjust(w)
            for k, (cell, w) in enumerate(zip(row, widths, strict=True))
        ]
        print("| " + " | ".join(cells) + " |")
        if i == 0:
            print("|" + "|".join("-" * (w + 1) + (":" if k > 2 else "-") for k, w in enumerate(widths)) + "|")
    bad = [a for a in attempts if not a.tells]
    if bad:
        print()
    for a in bad:
        print(f"{a.title}: {a.failure}")


def write_table(path: str, attempts: Sequence[Attempt], truth: Truth) -> None:
    """All runs with all their errors."""
    names = list(truth.sizes)
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        columns = [
            "setting",
            "solver",
            "size",
            "steps",
            "failed",
            "iterations",
            "seconds",
            "error",
            "median",
            "worst of",
        ]
        table.writerow([*columns, "slope", "believed", "outcome", "SAM", "SUB", *names])
        for a in attempts:
            known = a.run.summary if a.run.solved else {}
            table.writerow(
                [
                    a.ladder.title,
                    a.solver,
                    repr(a.rung.size),
                    known.get("steps", ""),
                    known.get("failed_attempts", ""),
                    known.get("iterations", ""),
                    f"{a.seconds:.4f}" if a.run.solved else "",
                    short(a.error),
                    short(a.median),
                    a.worst,
                    "" if a.slope is None else f"{a.slope:.2f}",
                    "" if not a.tells else "no" if a.error < truth.floor else "yes",
                    a.run.outcome if a.run.solved else a.failure,
                    *(card.text for card in a.cards),
                    *(short(a.errors.get(n, math.nan)) for n in names),
                ]
            )
    print(f"wrote {path}")


def print_recommendation(
    attempts: Sequence[Attempt],
    truth: Truth,
    targets: Sequence[float],
    chosen: Attempt | None,
    target: float,
    accuracy: str = "",
) -> None:
    """The cheapest setting for each error, and the two cards of the chosen one, which have no ACCURACY where
    the deck has."""
    print("\nThe cheapest setting for an error of at most\n")
    rows = []
    own = attempts[0]
    # a single run of the deck may be good by chance; its setting is among the ladders
    tried = [a for a in attempts if a.ladder is not own.ladder]
    for wanted in targets:
        best = chosen if wanted == target else cheapest(tried, wanted, truth.floor)
        if best:
            text = [
                f"{best.title}, {best.solver}",
                f"{best.seconds:.3f} s",
                error_text(best.error, truth.floor),
            ]
        else:
            text = [why_none(tried, truth, wanted), "", ""]
        rows.append([short(wanted), *text])
    widths = [
        max(len(row[i]) for row in rows if row[2] or i == 0) if any(r[2] for r in rows) else 0
        for i in range(4)
    ]
    for row in rows:
        print(("  " + "  ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True))).rstrip())
    if own.tells:
        print(f"\nThe deck as it is: {own.seconds:.3f} s, error {error_text(own.error, truth.floor)}.")
    if not chosen:
        return
    print(f"\nFor an error of {short(target)}, in the place of the deck's own cards:\n")
    for card in chosen.cards:
        print(card.text)
    if accuracy:
        print(f"\nThey set scheme and steps in the place of {accuracy}, and estimate no error.")
    if "TOL" in chosen.rung.sub:
        return
    print()
    if chosen.rung is chosen.ladder.rungs[0]:
        print("It is the longest step of its scheme that was tried; --steps tries others.")
    if chosen.rung.size > own.rung.size * (1 + 1e-9):
        print(f"Histories then have a sample every {chosen.rung.sub['H']}, the length of a step.")


def why_none(attempts: Sequence[Attempt], truth: Truth, target: float) -> str:
    """Why no run is known to meet a target."""
    if truth.floor > target:
        reach = short(truth.floor)
        return f"not known: the reference is good to {reach} only; --reference-step takes a shorter step"
    told = [a for a in attempts if a.tells]
    best = min(told, key=lambda a: a.error)
    if best.error <= target:
        return f"none surely: {best.title} had {short(best.error)}, but shorter steps have larger errors"
    return f"none of these; the best is {best.title} with {short(best.error)}"
