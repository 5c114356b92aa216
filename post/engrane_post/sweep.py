# SPDX-License-Identifier: BSD-3-Clause
"""`engrane sweep`: runs a deck for many values of its abbreviations; a table and a diagram of the results."""

from __future__ import annotations

import argparse
import csv
import itertools
import json
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from . import options, runs
from .errors import Terminated, UserError
from .program import find_program
from .runs import Run

MOST_VARIANTS = 100_000
MOST_LINES = 10
RECORD = "sweep.json"  # beside kept results: the sweep that they are of
KEPT = re.compile(r"\d+(\.partial)?\.(h5|lst|xdmf)")  # files of a variant
EXAMPLES = """  engrane sweep gear.dat -D KM=1E8:1E9:1E8 --result "ELEMENT 7 NORMAL_FORCE MAX"
  engrane sweep gear.dat -D JEU=0,1E-5,1E-4 -D SPEED=100:500:50 --result "ELEMENT 7 TE RMS WINDOW 0.1 0.2"
  engrane sweep gear.dat -D KM=1E8:1E9:1E8 -D J=0.3 -j 2 --keep runs
  engrane sweep gear.dat -D KM=1E8:1E9:1E8 --card ".SUB TF 0.1 H 1E-5"

-D NAME=from:to:step gives the deck's abbreviation /NAME each of these values, NAME=a,b,c those listed, NAME=a
one; every combination is run, in a process of its own. --result names a number as .CHK does, without what it
should be; without --result the values of the deck's own .CHK are taken."""


@dataclass
class Variant:
    """One combination of values and its run."""

    values: dict[str, str]
    run: Run | None = None

    @property
    def title(self) -> str:
        return ", ".join(f"{name} = {value}" for name, value in self.values.items())

    @property
    def file(self) -> str:
        """The result file that its run has written; an older one in the folder is not of this run."""
        return next((f for f in self.run.summary.get("files", []) if f.endswith(".h5")), "")


def add(commands: argparse._SubParsersAction) -> None:
    """Declares the command."""
    p = options.subcommand(
        commands,
        "sweep",
        "a deck for many values of its abbreviations",
        "Runs a deck for every combination of the values given by -D, several at a time, and writes a table "
        "(.csv) and a diagram (.png) of the numbers asked for.",
        EXAMPLES,
    )
    p.add_argument("deck", help="the deck; what varies must be an abbreviation, ABRE '/NAME' '...'")
    p.add_argument(
        "-D",
        dest="define",
        action="append",
        required=True,
        metavar="NAME=VALUES",
        help="from:to:step, a list a,b,c or one value; may be repeated",
    )
    p.add_argument(
        "--card",
        action="append",
        default=[],
        metavar="CARD",
        help='a card in the place of the deck\'s, in every run: ".SUB TF 1 H 1E-4"; may be repeated',
    )
    runs.arguments(p, "_sweep", "one per core")
    p.set_defaults(run=run)


def values_of(text: str) -> tuple[str, list[str]]:
    """NAME and its values from NAME=from:to:step, NAME=a,b,c or NAME=a."""
    name, sign, values = text.partition("=")
    name = name.strip().removeprefix("/")
    if not sign or not name or not values.strip():
        raise UserError(f"-D {text} is not NAME=from:to:step, NAME=a,b,c or NAME=a.")
    if ":" not in values:
        if "(" in values:  # commas between arguments
            return name, [values]
        listed = [v.strip() for v in values.split(",")]
        if "" in listed:
            raise UserError(f"-D {text}: value {listed.index('') + 1} of the list is empty.")
        return name, listed
    try:
        first, last, step = (float(re.sub("[dD]", "e", v)) for v in values.split(":"))
    except ValueError:
        raise UserError(f"-D {text}: a range is from:to:step, three numbers.") from None
    if step == 0 or (last - first) * step < 0:
        raise UserError(f"-D {text}: steps of {step:g} do not lead from {first:g} to {last:g}.")
    steps = (last - first) / step
    if not steps < MOST_VARIANTS:
        raise UserError(f"-D {text} stands for more than {MOST_VARIANTS} values.")
    return name, [f"{first + i * step:.12g}" for i in range(int(steps + 1e-9) + 1)]


def combinations(definitions: list[str]) -> list[Variant]:
    """Every combination; the last name varies fastest."""
    names: dict[str, list[str]] = {}
    for text in definitions:
        name, values = values_of(text)
        if name in names:
            raise UserError(f"-D {name} is given twice.")
        names[name] = values
    count = 1
    for values in names.values():
        count *= len(values)
    if count > MOST_VARIANTS:
        raise UserError(f"These are {count} combinations; {MOST_VARIANTS} are the most.")
    return [Variant(dict(zip(names, row, strict=True))) for row in itertools.product(*names.values())]


def run(args: argparse.Namespace) -> int:
    """Runs all, writes table and diagram; the worst status."""
    variants = combinations(args.define)
    deck = runs.find_deck(args.deck)
    output = runs.output_prefix(args.output, deck, "_sweep")
    wanted = [f"--result={result}" for result in args.result] + [f"--card={card}" for card in args.card]
    width = len(str(len(variants)))
    if args.keep:
        record_in(Path(args.keep), deck, variants, args.card)
    with runs.result_folder(args.keep) as folder:
        for i, variant in enumerate(variants):
            words = [f"-D{name}={value}" for name, value in variant.values.items()]
            variant.run = Run(variant.title, wanted + words, folder / f"{i + 1:0{width}}")
        pool = runs.Pool(find_program(), deck, args.jobs or runs.all_cores())
        try:
            pool.run([v.run for v in variants])
        except (KeyboardInterrupt, Terminated):
            write_finished(output + ".csv", variants, bool(args.keep))
            raise
    for variant in variants:
        demand_summary(variant.run)
    names = list(dict.fromkeys(name for v in variants for name in v.run.numbers))
    bad = [v for v in variants if not v.run.solved]
    if len(bad) == len(variants):
        raise UserError(f"no variant was solved. {bad[0].title}:\n{bad[0].run.message}")
    if not names:
        raise UserError("Name a number by --result; the deck has no .CHK.")
    write_table(output + ".csv", variants, names, bool(args.keep))
    print(f"wrote {output}.csv")
    draw(output + ".png", variants, names, Path(deck).stem)
    for variant in bad[:5]:
        print(f"{variant.title}: {variant.run.reason}", file=sys.stderr)
    if bad:
        print(f"{len(bad)} of {len(variants)} variants have no result", file=sys.stderr)
    return max((v.run.status for v in variants), key=runs.STATUSES.index)


def record_in(folder: Path, deck: str, variants: list[Variant], cards: list[str]) -> None:
    """Notes in the folder which sweep its results will be of. Those of another are not mixed with them; the
    same sweep may be repeated, as after it was stopped."""
    sweep = {"deck": str(Path(deck).resolve()), "variants": [v.values for v in variants], "cards": cards}
    record = folder / RECORD
    try:
        same = json.loads(record.read_text(encoding="utf-8")) == sweep
    except (OSError, ValueError):
        same = False
    there = [] if same or not folder.is_dir() else sorted(p.name for p in folder.iterdir())
    if old := next((name for name in there if KEPT.fullmatch(name)), None):
        raise UserError(
            f"--keep {folder}: the folder holds results of another sweep, {old} for one. Name another "
            "folder, or empty this one. Only a sweep of the same deck with the same values and cards may be "
            "repeated."
        )
    folder.mkdir(parents=True, exist_ok=True)
    record.write_text(json.dumps(sweep, indent=1) + "\n", encoding="utf-8")


def demand_summary(run: Run) -> None:
    """A run without a summary is none that was solved, whatever its exit status."""
    if run.solved and not run.summary:
        run.status = 3
        run.message = (
            run.message or "the program ended early and said nothing, as when a user routine ends it"
        )


def write_finished(path: str, variants: list[Variant], kept: bool) -> None:
    """The table of a sweep that was stopped; those that have not run have no numbers."""
    count = sum(v.run.outcome != "not run" for v in variants)
    if count:
        names = list(dict.fromkeys(name for v in variants for name in v.run.numbers))
        write_table(path, variants, names, kept)
    what = f"wrote {path}" if count else "nothing to write"
    print(f"engrane sweep: stopped after {count} of {len(variants)} variants; {what}", file=sys.stderr)


def write_table(path: str, variants: list[Variant], names: list[str], kept: bool) -> None:
    """A column for each name and result, what came of the run, and its file when that is kept."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*variants[0].values, *names, "outcome", "seconds", *["file"] * kept])
        for v in variants:
            numbers = ["" if v.run.numbers.get(n) is None else repr(v.run.numbers[n]) for n in names]
            seconds = v.run.summary.get("seconds", 0)
            table.writerow([*v.values.values(), *numbers, v.run.outcome, f"{seconds:.3f}", *[v.file] * kept])


def number(text: str) -> float | None:
    """The number that a value is, or None: `(2*PI)` and words are places on the axis by their order."""
    try:
        return float(re.sub("[dD]", "e", text))
    except ValueError:
        return None


def draw(path: str, variants: list[Variant], names: list[str], title: str) -> None:
    """A diagram of each result over the first name that varies; lines for combinations of the others."""
    from . import style

    values = {n: list(dict.fromkeys(v.values[n] for v in variants)) for n in variants[0].values}
    varying = [n for n in values if len(values[n]) > 1] or list(values)[:1]
    across, others = varying[0], varying[1:]
    numeric = all(number(x) is not None for x in values[across])
    place = {x: number(x) if numeric else i for i, x in enumerate(values[across])}
    lines: dict[str, list[Variant]] = {}
    for v in variants:
        lines.setdefault(", ".join(f"{n} = {v.values[n]}" for n in others), []).append(v)
    figure, axes = style.panels(len(names), height=3.0)
    for axis, name in zip(axes, names, strict=True):
        for i, (label, members) in enumerate(lines.items()):
            solved = [v for v in members if v.run.numbers.get(name) is not None]
            points = [(place[v.values[across]], v.run.numbers[name]) for v in solved]
            color = style.plt.get_cmap("viridis")(i / max(1, len(lines) - 1))
            if len(lines) <= len(style.COLORS):
                color = style.COLORS[i]
            if points:
                axis.plot(*zip(*points, strict=True), marker="o", markersize=3, color=color, label=label)
        axis.set_title(name, fontsize=9, loc="left", color="#444444")
        if not numeric:
            axis.set_xticks(list(place.values()), list(place))
    if 1 < len(lines) <= MOST_LINES:
        axes[0].legend(fontsize=8)
    elif len(lines) > MOST_LINES:
        first, *_, last = lines
        handles = axes[0].get_lines()
        if len(handles) > 1:
            axes[0].legend([handles[0], handles[-1]], [first, last], fontsize=8)
    axes[-1].set_xlabel(across)
    figure.suptitle(title, fontsize=11)
    style.save(figure, path)
