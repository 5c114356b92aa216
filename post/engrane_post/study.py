# SPDX-License-Identifier: BSD-3-Clause
"""`engrane study`: which scheme and step reach an error in the least time, measured with the user's deck."""

from __future__ import annotations

import argparse
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from . import options, runs, study_errors, study_report
from .errors import Terminated, UserError
from .program import find_program
from .reading import text
from .results import Results
from .runs import Pool, Run
from .study_deck import (
    Card,
    Deck,
    Ladder,
    Rung,
    Schema,
    number,
    sample_interval,
    schema_of,
    setting_of,
    steps_ladder,
    steps_of,
    tolerances_ladder,
    usual_steps,
)
from .study_errors import Truth, Values
from .study_report import Attempt

SCHEMES = ("CHUNG TANGENT FULL", "CHUNG TANGENT KEPT", "RADAU")
SOLVERS = ("MUMPS", "KLU")
TARGETS = (1e-2, 1e-3, 1e-5)
#: of the local error, for programs whose .SUB has TOL
TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
#: a reference takes steps so many times shorter than the shortest of its own scheme that is studied
FINER = {"RADAU": 4, "CHUNG": 8}
FINEST_PRECISION = 1e-12
SHORT_RUN, SHORT_RUNS = 1.0, 3  # seconds; runs shorter than that are timed so often
EXAMPLES = """  engrane study gear.dat
  engrane study gear.dat --error 1e-4 --channels element/7/NORMAL_FORCE
  engrane study gear.dat --result "ELEMENT 7 NORMAL_FORCE MAX" --schemes RADAU "CHUNG RHO 0.9 TANGENT KEPT"
  engrane study gear.dat --steps 4H:H/8 --runs 5
  engrane study gear.dat --reference check

The deck runs with each scheme and a ladder of steps; H in --steps is the deck's own step. Errors are those
of the numbers that the deck checks by .CHK, or of what --result and --channels name, or of all histories: the
largest difference from a reference, over the size of a number or the range of a history. The reference is a
run of Radau IIA with much shorter steps, whose own error a second run tells; --reference check takes the
values V of .CHK."""


def add(commands: argparse._SubParsersAction) -> None:
    """Declares the command."""
    p = options.subcommand(
        commands,
        "study",
        "which scheme and step reach an error in the least time",
        "Runs a deck with several schemes, steps and solvers, measures errors and processor time, "
        "and writes a table (.csv), a diagram (.png) and the cards .SAM and .SUB of the cheapest "
        "setting for an error.",
        EXAMPLES,
    )
    p.add_argument("deck", help="a deck of TYPE DYNAMIC; it is not changed")
    p.add_argument(
        "--error", type=float, default=1e-3, metavar="e", help="the error that is good enough (default: 1e-3)"
    )
    p.add_argument(
        "--schemes",
        nargs="+",
        metavar="SCHEME",
        help=f"schemes with keywords of .SAM (default: {', '.join(SCHEMES)})",
    )
    p.add_argument(
        "--steps", metavar="STEPS", help="1e-4,5e-5 or 4H,2H,H/2 or 8H:H/4 (default: for each scheme)"
    )
    p.add_argument("--solvers", metavar="A,B", help="to choose from (default: the deck's, MUMPS and KLU)")
    p.add_argument(
        "--channels", nargs="+", metavar="CHANNEL", help="histories, such as element/7/NORMAL_FORCE"
    )
    p.add_argument(
        "--reference", choices=("run", "check"), default="run", help="a run, or the values V of .CHK"
    )
    p.add_argument("--reference-step", type=float, metavar="h", help="step of the reference run")
    p.add_argument(
        "--runs",
        type=int,
        metavar="n",
        help="the time of a run is the least of n (default: 3 of short runs, else 1)",
    )
    p.add_argument(
        "-D", dest="define", action="append", default=[], metavar="NAME=VALUE", help="as of engrane itself"
    )
    runs.arguments(p, "_study", "1, so that runs do not slow each other")
    p.set_defaults(run=run)


class Study:
    """The runs of one deck."""

    def __init__(self, args: argparse.Namespace, program: Path, deck: str, folder: Path) -> None:
        self.args = args
        self.deck_file = deck
        self.folder = folder
        self.pool = Pool(program, deck, args.jobs or 1)
        self.schema = _schema(program)
        self.words = [f"-D{d}" for d in args.define] + [f"--result={r}" for r in args.result]
        self.count = 0
        self.channels: list[str] = []
        self.keep: str | None = None
        self.start_cpu = 0.0
        self.first = self._begin()
        if self.first.status == 1:
            print(self.first.message, file=sys.stderr)
            raise UserError(f"{deck} is wrong.")
        with Results(self.first.prefix) as results:
            self.deck = Deck(text(results.dataset("deck")), self.schema)
            self.known = results.channels
            if args.channels:
                self.channels = study_errors.resolve(args.channels, list(self.known), deck)
        if self.deck.analysis != "DYNAMIC":
            raise UserError(
                f"{deck} is {self.deck.analysis}; only a DYNAMIC analysis has a scheme and errors of steps."
            )
        self._refuse_what_does_not_start()
        self._choose_what_is_compared()

    def _begin(self) -> Run:
        """Reads the deck and starts it; what that costs is no cost of steps."""
        # all that can be asked for; the deck's own selection matters only where nothing is asked for
        words = ["--until=-1e300", *self.words, *(["--card", ".SAI KEEP ALL"] if self.args.channels else [])]
        begun = [Run("the start", words, self.folder / "start") for _ in range(2)]
        for one in begun:
            self.pool.run([one])
        self.start_cpu = min(one.cpu for one in begun)
        return begun[-1]

    def _refuse_what_does_not_start(self) -> None:
        failure = self.first.summary.get("failure", "")
        if self.first.solved or failure.startswith("interrupted"):
            return
        raise UserError(f"{self.deck_file} cannot be run as it is: {failure or self.first.reason}")

    def _choose_what_is_compared(self) -> None:
        """Numbers, histories, or all histories."""
        self.all_histories = False
        self.numbers: list[str] | None = None
        if self.args.result:
            self.numbers = [r["name"] for r in self.first.summary["results"]]
        elif not self.args.channels:
            self.numbers = study_errors.checks_that_tell(self.first, self.deck.start)
        if self.channels:
            self.keep = "ALL"
        elif self.numbers:
            self.keep = "NONE"
        else:
            self.all_histories = True
            self.channels = [n for n, c in self.known.items() if c.unique and not n.startswith("run/")]
            if not self.channels:
                raise UserError(
                    "The deck checks no number that tells of accuracy and keeps no histories; "
                    "name some by --result or --channels."
                )
        if self.args.reference == "check" and (self.args.result or self.args.channels or not self.numbers):
            raise UserError(
                "--reference check compares the numbers that the deck's .CHK gives, without --result and "
                "--channels; a V of 0 gives no size to compare with."
            )

    def ladders(self) -> list[Ladder]:
        """The settings and steps to try."""
        texts = list(self.args.schemes or SCHEMES)
        if not self.args.schemes and self.deck.scheme not in ("CHUNG", "RADAU"):
            texts.append(self.deck.setting)
        out = []
        for words in texts:
            setting = setting_of(words)
            self._check_choice("SCHEME", setting["SCHEME"], "--schemes")
            steps = (
                steps_of(self.args.steps, self.deck.step)
                if self.args.steps
                else usual_steps(setting["SCHEME"], self.deck.step, self.deck.span)
            )
            out.append(steps_ladder(" ".join(words.upper().split()).removeprefix("SCHEME "), setting, steps))
        if "TOL" in self.schema[".SUB"] and not self.args.schemes and not self.args.steps:
            out += [tolerances_ladder(f"{s} TOL", {"SCHEME": s}, self.deck.step, TOLERANCES) for s in FINER]
        if len({ladder.title for ladder in out}) < len(out):
            raise UserError("--schemes names the same setting twice.")
        return out

    def try_settings(self, ladders: Sequence[Ladder], solver: str) -> None:
        """Ends the study when keywords of --schemes are wrong, before long runs are made."""
        for ladder in ladders:
            a = self.attempt(ladder, ladder.rungs[0], solver, self.deck.span)
            a.run.words.append("--until=-1e300")
            self.pool.run([a.run])

    def solvers(self) -> list[str]:
        """The deck's first."""
        if self.args.solvers:
            named = [s.strip().upper() for s in self.args.solvers.split(",") if s.strip()]
            for solver in named:
                self._check_choice("SOLVER", solver, "--solvers")
            return list(dict.fromkeys(named))
        return list(dict.fromkeys((self.deck.solver, *SOLVERS)))

    def _check_choice(self, keyword: str, value: str, option: str) -> None:
        known = [one["const"] for one in self.schema[".SAM"][keyword]["oneOf"]]
        if value not in known:
            raise UserError(f"{option}: {keyword} has no {value}; it has {', '.join(known)}.")

    def attempt(self, ladder: Ladder, rung: Rung, solver: str, interval: float) -> Attempt:
        """A run to be made."""
        sam, sub = self.deck.sam_card(ladder.sam, solver), self.deck.sub_card(rung)
        return self._attempt(ladder, rung, solver, (sam, sub), self.deck.sai_card(interval, self.keep))

    def own_attempt(self, own: Ladder, solver: str, interval: float) -> Attempt:
        """A run of the deck as it is, with this solver."""
        cards = (self.deck.own_sam_card(solver), self.deck.sub)
        return self._attempt(own, own.rungs[0], solver, cards, self.deck.own_sai_card(interval, self.keep))

    def _attempt(
        self, ladder: Ladder, rung: Rung, solver: str, cards: tuple[Card, Card], samples: Card
    ) -> Attempt:
        self.count += 1
        words = [*self.words, *(w for card in (*cards, samples) for w in ("--card", card.text))]
        run = Run(f"{ladder.title}, {rung.title}, {solver}", words, self.folder / f"{self.count:03}")
        return Attempt(ladder, rung, solver, cards, run)

    def measure(self, attempts: Sequence[Attempt], what: str) -> None:
        """Makes the runs; short ones again, in turn, for the least time."""
        times: dict[int, list[float]] = {id(a): [] for a in attempts}
        try:
            self.pool.run([a.run for a in attempts], what)
            for _ in range((self.args.runs or SHORT_RUNS) - 1):
                again = [a for a in attempts if a.run.solved and (self.args.runs or a.run.cpu < SHORT_RUN)]
                if not again:
                    break
                repeats = [Run(a.run.title, a.run.words, a.run.prefix) for a in again]
                self.pool.run(repeats, what + "again ")
                for a, one in zip(again, repeats, strict=True):
                    times[id(a)].append(one.cpu)
        finally:  # also when Ctrl-C ends the runs
            for a in attempts:
                a.seconds = max(min([a.run.cpu, *times[id(a)]]) - self.start_cpu, study_report.SHORTEST)

    def values(self, a: Attempt, interval: float) -> Values:
        found = study_errors.read(a.run, self.channels, interval, self.deck.start, self.deck.end)
        if self.numbers is not None:
            found.numbers = {n: v for n, v in found.numbers.items() if n in self.numbers}
        else:
            found.numbers = {}
        return found

    def find_interval(self, ladders: Sequence[Ladder]) -> float:
        """The time between the samples that are compared; numbers need none."""
        if not self.channels:
            return self.deck.span
        fine = self.reference_ladders(ladders) if self.args.reference == "run" else []
        steps = [rung.sub["H"] for ladder in [*ladders, *fine] for rung in ladder.rungs]
        return sample_interval([float(h) for h in steps], self.deck.span)

    def find_truth(self, ladders: Sequence[Ladder], interval: float, solver: str, first: Run) -> Truth:
        """What errors are measured against, and of what they are told."""
        if self.args.reference == "check":
            truth = study_errors.truth_of_checks(first)
            wanted = [n for n in truth.sizes if n in self.numbers]
        else:
            truth = self.reference(ladders, interval, solver)
            wanted = study_errors.sensible(self.known, truth) if self.all_histories else list(truth.sizes)
        truth.keep(wanted)
        if not truth.sizes:
            raise UserError("nothing is left to compare. " + "; ".join(truth.left_out[:3]))
        return truth

    def reference(self, ladders: Sequence[Ladder], interval: float, solver: str) -> Truth:
        """A fine run whose error the next coarser one tells; by Radau IIA if it can, else by CHUNG."""
        refusals = []
        for ladder in self.reference_ladders(ladders):
            pair = [self.attempt(ladder, rung, solver, interval) for rung in ladder.rungs]
            self.pool.run([a.run for a in pair], "reference ")
            bad = [a for a in pair if not a.run.solved]
            if not bad:
                coarse, fine = (self.values(a, interval) for a in pair)
                return study_errors.truth_of_runs(f"{ladder.title}, {ladder.rungs[-1].title}", fine, coarse)
            refusals.append(f"{bad[0].title}: {bad[0].failure}")
            print(f"note: no reference by {refusals[-1]}", file=sys.stderr)
        raise UserError(f"no reference could be computed. {refusals[-1]}")

    def reference_ladders(self, ladders: Sequence[Ladder]) -> list[Ladder]:
        """In the order in which they are tried, each of two steps."""
        precision = min(FINEST_PRECISION, float(self.deck.sam.get("PREC") or 1))
        wishes = [
            ("RADAU", {"PREC": number(precision)}),
            ("RADAU", {}),
            ("CHUNG", {"PREC": number(precision)}),
        ]
        out = []
        for scheme, more in wishes:
            sizes = [
                float(r.sub["H"]) / (FINER[scheme] if scheme in (ladder.scheme, "CHUNG") else 1)
                for ladder in ladders
                for r in ladder.rungs
            ]
            step = self.args.reference_step or min(sizes)
            words = " ".join([scheme, *(w for pair in more.items() for w in pair)])
            out.append(steps_ladder(words, {"SCHEME": scheme, **more}, [2 * step, step]))
        return out


def _schema(program: Path) -> Schema:
    done = subprocess.run([str(program), "schema"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise UserError(f"{program} does not say what cards it has:\n{done.stderr.strip()}")
    return schema_of(done.stdout)


def check(args: argparse.Namespace) -> None:
    """Numbers that make no sense."""
    if not 0 < args.error < 1:
        raise UserError(
            f"--error {args.error:g}: an error is a part of the size of a result, between 0 and 1."
        )
    if args.reference_step is not None and not args.reference_step > 0:
        raise UserError(f"--reference-step {args.reference_step:g} is no step.")
    for name, value in (("--runs", args.runs), ("-j", args.jobs)):
        if value is not None and value < 1:
            raise UserError(f"{name} {value}: at least 1.")


def run(args: argparse.Namespace) -> int:
    """All runs, then table, diagram and recommendation."""
    check(args)
    deck_file = runs.find_deck(args.deck)
    output = runs.output_prefix(args.output, deck_file, "_study")
    with runs.result_folder(args.keep) as folder:
        study = Study(args, find_program(), deck_file, folder)
        ladders, solvers = study.ladders(), study.solvers()
        if args.schemes:
            study.try_settings(ladders, solvers[0])
        interval = study.find_interval(ladders)
        own = study.deck.own()
        attempts = [study.own_attempt(own, solver, interval) for solver in solvers]
        study.measure(attempts, "solvers ")
        good = [a for a in attempts if a.run.solved] or attempts[:1]
        solver = min(good, key=lambda a: a.seconds).solver
        truth = study.find_truth(ladders, interval, solver, attempts[0].run)
        climbed = [study.attempt(ladder, r, solver, interval) for ladder in ladders for r in ladder.rungs]
        attempts += climbed
        try:
            study.measure(climbed, "")
        except (KeyboardInterrupt, Terminated):
            report_finished(study, attempts, truth, interval, output + ".csv")
            raise
        find_errors(study, attempts, truth, interval)
        if not any(a.tells for a in climbed):
            raise UserError(f"no run has a result. {climbed[0].title}: {climbed[0].failure}")
        best = study_report.cheapest(climbed, args.error, truth.floor)
        if best and len(solvers) > 1:
            others = [study.attempt(best.ladder, best.rung, s, interval) for s in solvers if s != solver]
            study.measure(others, "solvers ")
            attempts += others
            find_errors(study, others, truth, interval)
            good = [a for a in others if a.tells and max(a.error, truth.floor) <= args.error]
            best = min([best, *good], key=lambda a: a.seconds)
    study_report.find_slopes(attempts, truth.floor)
    introduce(study, truth)
    study_report.print_table(attempts, truth)
    targets = sorted({*TARGETS, args.error}, reverse=True)
    study_report.print_recommendation(attempts, truth, targets, best, args.error, study.deck.accuracy)
    print()
    study_report.write_table(output + ".csv", attempts, truth)
    from . import study_plot  # matplotlib takes a while to load

    study_plot.draw(output + ".png", attempts, truth, study.deck.step, args.error, best, Path(deck_file).stem)
    return 0


def report_finished(
    study: Study, attempts: Sequence[Attempt], truth: Truth, interval: float, path: str
) -> None:
    """The table of a study that was stopped, without a recommendation."""
    done = [a for a in attempts if a.run.outcome != "not run"]
    find_errors(study, done, truth, interval)
    study_report.find_slopes(done, truth.floor)
    introduce(study, truth)
    study_report.print_table(done, truth)
    study_report.write_table(path, attempts, truth)
    print(f"engrane study: stopped after {len(done)} of {len(attempts)} runs", file=sys.stderr)


def find_errors(study: Study, attempts: Sequence[Attempt], truth: Truth, interval: float) -> None:
    """Of the runs that were solved."""
    for a in attempts:
        if a.run.solved:
            a.errors = truth.errors(study.values(a, interval))


def introduce(study: Study, truth: Truth) -> None:
    """What is compared with what."""
    count = len(truth.sizes)
    if study.all_histories:
        what = f"{count} histories that vary"
    else:
        names = list(truth.sizes)
        what = "; ".join(names[:3]) + (f" and {count - 3} more" if count > 3 else "")
    print(f"{Path(study.deck_file).name}: errors of {what}")
    own = f"own error is {study_report.short(truth.error)}" if truth.own else "own error is not known here"
    print(f"reference: {truth.name}; its {own}")
    if truth.left_out and not study.all_histories:
        for text in truth.left_out:
            print(f"left out: {text}")
    print(f"s: processor time without the start of the program, {study.start_cpu:.2f} s\n")
