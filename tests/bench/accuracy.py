# SPDX-License-Identifier: BSD-3-Clause
"""The dial `.SAM ACCURACY` on nine models and on beams: what it estimates, what is true, and what it costs.

    python tests/bench/accuracy.py build/bin/engrane [--models bevel spur ...] [--runs 2]
        [--tolerances 1e-2 1e-3 1e-4 1e-5 1e-6 1e-7] [--slopes] [--picture docs/figures/dial.png]

Errors are measured as the program estimates them: the root of the mean square over time of what a channel
is off by, over its range; of some positions, velocities and forces of each model the worst channel
counts. The truth is a run of RADAU with TOL 1e-9 (planetary 1e-10), for transmission C of short fixed steps;
its own error is what it differs by from another of fixed steps, or of TOL 1e-8. Processor time is that of
the process with all it does, the estimate included, without that of a run of a single step; the least of
--runs, in turn.

Prints a Markdown table of the four settings; --tolerances: one of TOL, with the TOL that each setting would
have needed; --picture: only a diagram; --slopes: fixed steps of each scheme, with errors and their slopes.
"""

import argparse
import itertools
import json
import math
import os
import re
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from schemes import BEVEL
from schemes import MODELS as OTHERS
from work_precision import draw

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "post"), str(ROOT / "tests" / "verify")]
from engrane_post import Results  # noqa: E402
from oracles import four_bars  # noqa: E402

ENVIRONMENT = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
SETTINGS = {"FAST": 1e-2, "NORMAL": 1e-3, "FINE": 1e-5, "REFERENCE": 1e-8}
TURN = 2 * math.pi / 150  # of the flexible slider-crank, s
NO_RANGE, NO_SIZE = 1e-6, 1e-12  # as in src/app/companion.cpp

PLANETARY = """
.UNIT SI
.TITRE "planetary 24-18-60 with play under a torque that changes its sign"
ABRE '/rc' '0.063'
ABRE '/gear' 'AXIS 0 0 1 MN 0.003 ALPHA 25 KM 4D8 XI 0.07 JEU 2D-5'
ABRE '/back' 'AXIS 0 0 -1 MN 0.003 ALPHA 25 KM 4D8 XI 0.07 JEU 2D-5'
.NOE
 I 1 X 0 0 0
 I 2 X 0 0 0
 I 3 X 0 0 0
 I 11 X (/rc) 0 0
 I 12 X (/rc*cos(2*PI/3)) (/rc*sin(2*PI/3)) 0
 I 13 X (/rc*cos(4*PI/3)) (/rc*sin(4*PI/3)) 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 3 HINGE N 0 3 AXIS 0 0 1
 I 4 TORQUE N 1 AXIS 0 0 1 V 1 NF 1
 I 5 TSPRING N 0 2 AXIS 0 0 1 K 1D7 C 10          ! the ring in its housing
 I 6 TSPRING N 0 3 AXIS 0 0 1 K 5D4 C 10          ! the load
 I 11 HINGE N 3 11 AXIS 0 0 1 AT (/rc) 0 0
 I 12 HINGE N 3 12 AXIS 0 0 1 AT (/rc*cos(2*PI/3)) (/rc*sin(2*PI/3)) 0
 I 13 HINGE N 3 13 AXIS 0 0 1 AT (/rc*cos(4*PI/3)) (/rc*sin(4*PI/3)) 0
 I 21 GEAR N 1 11 Z 24 18 /gear
 I 22 GEAR N 1 12 Z 24 18 /gear
 I 23 GEAR N 1 13 Z 24 18 /gear
 I 31 GEAR N 11 2 Z 18 60 /back INTERNAL
 I 32 GEAR N 12 2 Z 18 60 /back INTERNAL
 I 33 GEAR N 13 2 Z 18 60 /back INTERNAL
 I 41 INERTIA N 1 J 0 0 6D-4
 I 42 INERTIA N 2 J 0 0 2D-2
 I 43 INERTIA N 3 J 0 0 2D-2
 I 51 INERTIA N 11 M 0.6 J 0 0 2D-4
 I 52 INERTIA N 12 M 0.6 J 0 0 2D-4
 I 53 INERTIA N 13 M 0.6 J 0 0 2D-4
.FCT
 I 1 EXPR "30 + 60*sin(2*PI*150*T)"
.CLM
 FIX NOEUD 2 C 1 2 3 4 5
.SAM TYPE DYNAMIC
.SUB TF 0.01 H 5D-6
.FIN 1
"""


def free_crank(text: str) -> str:
    """The slider-crank with a flywheel in place of the drive, which would leave nothing to integrate."""
    text = text.replace(" DRIVE SPEED NF 1", "").replace(
        "VIT NOEUD 1 C 6 V 10", "VIT NOEUD 1 C 6 V 10 IMPOSED"
    )
    return text.replace(" I 5 INERTIA N 3 M 3\n", " I 5 INERTIA N 3 M 3\n I 6 INERTIA N 1 J 0 0 0.1\n")


def deck_text(path: str) -> str:
    return (ROOT / path).read_text(encoding="utf-8")


@dataclass
class Model:
    """What is run: the deck, its end, a step that divides the time between instants, and what is compared."""

    title: str
    text: str
    end: float
    step: float
    interval: float
    channels: tuple[tuple[str, ...], ...]  #: positions, velocities, forces
    steps: tuple[float, ...]  #: fixed, for slopes: multiples or parts of `step` that divide `interval`
    truth: Callable[[np.ndarray], np.ndarray] | None = None  #: of an equation of its own: channels over times
    exact: tuple[str, str] = ("", "1e-9")  #: words of `.SAM`, and TOL, of the truth
    fixed: bool = False  #: the truth has fixed steps: forces at their ends, not between those about an event
    waves: bool = False  #: or events at once: the own error is what TOL 1e-8 differs by
    resolved: bool = True  #: fixed steps of ordinary length follow its waves; if not, REFERENCE is not drawn
    schemes: tuple[str, ...] = ("",)  #: words that the settings are tried with
    names: tuple[str, ...] = field(init=False)
    more: str = field(init=False)  #: words of `.SAM` that stay

    def __post_init__(self) -> None:
        self.names = tuple(name for kind in self.channels for name in kind)
        kept = re.findall(r"^\.SAM.*?( START STATIC| PLANE \w+)", self.text, re.M)
        self.more = "".join(kept)


def damped(path: str, time: float) -> str:
    """A deck whose beams are damped by this time, s."""
    return re.sub(r"(?m)^( I \d+ BEAM .*)$", rf"\1 DAMPING {time}", deck_text(path))


def elbow(text: str, more: str = "") -> Model:
    return Model(
        "elbow" + more,
        text,
        3.0,
        0.05,
        0.05,
        (
            ("node/17/UX", "node/17/UY", "node/17/UZ"),
            ("node/17/VX", "node/17/VY", "node/17/VZ"),
            ("element/1/TORQUE_A", "element/1/BENDING_MOMENT_2_A", "element/1/BENDING_MOMENT_3_A"),
        ),
        (0.05, 0.025, 0.0125, 0.00625),
        waves=True,
        resolved=False,
    )


def flexible_crank(text: str, more: str = "") -> Model:
    return Model(
        "flexible slider-crank" + more,
        text,
        TURN / 10,
        TURN / 500,
        TURN / 500,
        (
            ("node/6/UX", "node/6/UY", "node/11/UX"),
            ("node/6/VX", "node/6/VY", "node/11/VX"),
            ("element/2/BENDING_MOMENT_3_B", "element/11/DRIVE_TORQUE"),
        ),
        (TURN / 500, TURN / 1000, TURN / 2000, TURN / 4000),
        waves=True,
        resolved=False,
    )


def models() -> dict[str, Model]:
    def like(
        name: str, title: str, end: float, interval: float, steps, text: str | None = None, **more
    ) -> Model:
        text = text or deck_text(OTHERS[name][0])
        step = float(re.search(r"^\.SUB.* H (\S+)", text, re.M)[1].replace("D", "e"))
        return Model(title, text, end, step, interval, OTHERS[name][3:], steps, **more)

    return {
        "bevel": like(
            "bevel",
            "bevel pair",
            1.0,
            0.02,
            (0.01, 0.005, 0.0025, 0.00125),
            BEVEL.replace("H 0.1", "H 0.001"),
        ),
        "spur": like("spur", "transmission A", 0.004, 2e-5, (2e-5, 1e-5, 5e-6, 2.5e-6)),
        "backlash": like(
            "spur",
            "transmission C",
            0.002,
            2e-5,
            (1e-5, 5e-6, 2.5e-6, 1.25e-6),
            deck_text("decks/paper/spur_transmission_c.dat"),
            fixed=True,
        ),
        "bars": Model(
            "A02",
            deck_text("decks/mechanisms/four_bars_in_line.dat"),
            2.0,
            1e-3,
            0.01,
            (
                ("node/2/UX", "node/2/UY"),
                ("node/2/VX", "node/2/VY"),
                (),  # without bound where all bars lie in one line
            ),
            (1e-2, 5e-3, 2.5e-3, 1.25e-3),
            four_bars.first_bar,
            schemes=("", " SCHEME CHUNG"),
        ),
        "andrews": like("andrews", "Andrews", 0.03, 2e-4, (2e-4, 1e-4, 5e-5, 2.5e-5)),
        "top": like("top", "heavy top", 0.2, 2e-3, (1e-3, 5e-4, 2.5e-4, 1.25e-4)),
        "crank": Model(
            "slider-crank",
            free_crank(deck_text("decks/mechanisms/slider_crank.dat")),
            1.0,
            2e-4,
            0.01,
            (
                ("element/4/SLIDE", "element/1/ANGLE"),
                ("element/4/SLIDE_SPEED", "element/1/SPEED"),
                ("element/2/FORCE_X", "element/2/FORCE_Y"),
            ),
            (1e-2, 5e-3, 2.5e-3, 1.25e-3),
        ),
        "planetary": Model(
            "planetary",
            PLANETARY,
            0.01,
            5e-6,
            5e-5,
            (
                ("element/1/ANGLE", "element/11/ANGLE", "element/3/ANGLE"),
                ("element/1/SPEED", "element/11/SPEED", "element/3/SPEED"),
                ("element/21/NORMAL_FORCE", "element/31/NORMAL_FORCE"),
            ),
            (1e-5, 5e-6, 2.5e-6, 1.25e-6),
            exact=(" PREC 1e-13", "1e-10"),  # its contacts make rounding a hundred times as large
            waves=True,
        ),
        "elbow": elbow(deck_text("decks/elements/beams/beam_elbow.dat")),
        "damped_elbow": elbow(damped("decks/elements/beams/beam_elbow.dat", 1e-4), ", damped"),
        "flexible": flexible_crank(deck_text("decks/mechanisms/flexible_slider_crank.dat")),
        "damped_flexible": flexible_crank(
            damped("decks/mechanisms/flexible_slider_crank.dat", 1e-6), ", damped"
        ),
        "valve": like("valve", "valve train", 0.012, 1e-4, (2e-5, 1e-5, 5e-6, 2.5e-6)),
    }


def deck(model: Model, analysis: str | None, stepping: str) -> str:
    """`analysis`: words of `.SAM`, None for those of the deck; `stepping`: words of `.SUB` after TF."""
    text = re.sub(r"^\.(CHK|SAI)\b.*\n(?:[ !].*\n)*", "", model.text, flags=re.M)
    if analysis is not None:
        words = f".SAM TYPE DYNAMIC {analysis} ENERGY 0{model.more}"
        text = re.sub(r"^\.SAM .*", words, text, flags=re.M)
    checks = [
        f" {'ELEMENT' if kind == 'element' else 'NODE'} {number} {channel} V 0 ATOL 1e30"
        for kind, number, channel in (name.split("/") for name in model.names)
    ]
    archive = f".SAI FIELDS DT {model.end!r} HISTORY DT {model.interval!r}\n.CHK\n" + "\n".join(checks)
    return re.sub(r"^\.SUB .*", lambda _: f".SUB TF {stepping}\n{archive}", text, flags=re.M)


@dataclass
class Run:
    times: np.ndarray
    values: np.ndarray  #: instant by channel
    seconds: float
    steps: int
    report: dict

    by_channel: dict[str, float] = field(default_factory=dict)  #: as src/app/companion.cpp compares two runs

    def compare(self, truth: "Run", model: Model, units: dict[str, str]) -> "Run":
        assert np.allclose(self.times, truth.times, rtol=0, atol=1e-6 * model.interval)
        off = self.values - truth.values
        turns = [i for i, name in enumerate(model.names) if units[name] == "rad"]
        off[:, turns] = (off[:, turns] + math.pi) % (2 * math.pi) - math.pi
        ranges, sizes = np.ptp(self.values, axis=0), np.abs(self.values).max(axis=0)
        for i, name in enumerate(model.names):
            alike = [units[other] == units[name] for other in model.names]
            noise = max(NO_RANGE * max(ranges[alike].max(), sizes[i]), NO_SIZE * sizes[alike].max())
            if ranges[i] > noise:
                self.by_channel[name] = float(np.sqrt(np.mean(off[:, i] ** 2)) / ranges[i])
        return self

    @property
    def error(self) -> float:
        return max(self.by_channel.values())

    def of(self, names: Iterable[str]) -> float:
        return max((self.by_channel[name] for name in names if name in self.by_channel), default=math.nan)


class Bench:
    def __init__(self, binary: Path, folder: Path, model: Model, runs: int) -> None:
        self.binary, self.folder, self.model, self.runs = binary, folder, model, runs
        self.start = 0.0
        self.units: dict[str, str] = {}
        self.start = self._seconds(deck(model, "SOLVER KLU", f"{model.step!r} H {model.step!r}"), 5)[0]
        self.own_error = 0.0
        if model.truth:
            self.truth = self.run(None, f"H {model.step!r}", 1, compare=False)
            self.truth.values = model.truth(self.truth.times)
        else:
            controlled = (
                f"SCHEME RADAU SOLVER KLU{model.exact[0]}",
                f"H {model.step!r} TOL {model.exact[1]}",
            )
            fine = ("SCHEME RADAU SOLVER KLU PREC 1e-12", f"H {model.steps[-1] / 4!r}")
            longer = ("SCHEME RADAU SOLVER KLU PREC 1e-12", f"H {model.steps[-1] / 2!r}")
            looser = ("SCHEME RADAU SOLVER KLU", f"H {model.step!r} TOL 1e-8")
            truth, other = (fine, longer) if model.fixed else (controlled, looser if model.waves else fine)
            self.truth = self.run(*truth, 1, compare=False)
            self.own_error = self.run(*other, 1).error

    def _seconds(self, text: str, runs: int) -> tuple[float, dict]:
        path = self.folder / "run.dat"
        path.write_text(text, encoding="utf-8")
        least = math.inf
        for _ in range(runs):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            done = subprocess.run(
                [self.binary, "--json", path, "-o", path.with_suffix("")],
                env=ENVIRONMENT,
                capture_output=True,
                text=True,
            )
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            if done.returncode != 0:
                raise RuntimeError(" ".join((done.stderr or done.stdout[-400:]).split())[-400:])
            least = min(least, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        return least, json.loads(done.stdout)["runs"][0]

    def run(self, analysis: str | None, stepping: str, runs: int | None = None, compare: bool = True) -> Run:
        model = self.model
        seconds, report = self._seconds(deck(model, analysis, f"{model.end!r} {stepping}"), runs or self.runs)
        with Results((self.folder / "run.dat").with_suffix(".h5")) as results:
            if not self.units:
                channels = results.channels
                self.units = {name: channels[name].unit for name in model.names}
            histories = [results.history(name) for name in model.names]
        times = histories[0][0]
        places = times / model.interval
        even = np.abs(places - np.round(places)) < 1e-3
        values = np.array([values[even] for _, values in histories]).T
        run = Run(times[even], values, max(seconds - self.start, 0.001), report["steps"], report)
        return run.compare(self.truth, model, self.units) if compare else run


def cell(value: float) -> str:
    return f"{value:.1e}" if math.isfinite(value) else ""


def dial(bench: Bench) -> Iterable[str]:
    model = bench.model
    try:
        own = bench.run(None, f"H {model.step!r}")
        yield (
            f"| {model.title} | as it is, H {model.step:g} | {own.steps} | {own.seconds:.3f} "
            f"| | {own.error:.1e} | | |"
        )
    except RuntimeError as error:
        yield f"| {model.title} | as it is | failed: {error} |"
    for setting, target in ((s + scheme, t) for scheme in model.schemes for s, t in SETTINGS.items()):
        try:
            run = bench.run(f"ACCURACY {setting}", f"H {model.step!r}")
        except RuntimeError as error:
            when = re.findall(r"step \d+, (t = [0-9.e-]+[0-9])", str(error))
            yield f"| {model.title} | {setting} | fails at {when[-1] if when else error} | | | | | no |"
            continue
        found = run.report.get("accuracy") or {}
        estimate = found.get("estimated_error")
        told = f"{estimate:.1e}" if estimate else "none"
        ratio = f"{estimate / run.error:.2g}" if estimate else ""
        met = "yes" if run.error <= target else f"no, {run.error / target:.2g} times"
        yield (
            f"| {model.title} | {setting} | {run.steps} | {run.seconds:.3f} "
            f"| {told} | {run.error:.1e} | {ratio} | {met} |"
        )


def ladder(bench: Bench, tolerances: list[float]) -> list[str]:
    """Errors over TOL, the power they go with, and the TOL that each setting would have needed."""
    model, rows, points = bench.model, [], []
    for tolerance in tolerances:
        try:
            run = bench.run("SCHEME RADAU SOLVER KLU", f"H {model.step!r} TOL {tolerance!r}")
        except RuntimeError as error:
            rows.append(f"| {model.title} | {tolerance:g} | failed: {error} |")
            continue
        power = (
            math.log(run.error / points[-1][1]) / math.log(tolerance / points[-1][0]) if points else math.nan
        )
        points.append((tolerance, run.error, run.seconds))
        kinds = " | ".join(cell(run.of(kind)) for kind in model.channels)
        slope = f"{power:.2f}" if math.isfinite(power) else ""
        rows.append(
            f"| {model.title} | {tolerance:g} | {run.steps} | {run.seconds:.3f} | {kinds} | {slope} |"
        )
    needed = []
    for setting, target in SETTINGS.items():
        good = None
        for (loose, much, _), (tight, little, _) in itertools.pairwise(points):
            if much > target >= little:
                part = math.log(much / target) / math.log(much / little)
                good = math.exp((1 - part) * math.log(loose) + part * math.log(tight))
        if good is None and points and points[0][1] <= target:
            needed.append(f"{setting} > {points[0][0]:g}")
        elif good:
            needed.append(f"{setting} {good:.1e}")
    rows.append(f"| {model.title} | needed: | {', '.join(needed)} |")
    return rows


def companions(bench: Bench, tolerances: list[float]) -> list[str]:
    """What companions with looser TOL and longer steps tell: how far they are, and the powers of TOL and of
    the numbers of steps for which the estimate, distance / (ratio ** power - 1), is the error."""
    model, rows = bench.model, []
    for tolerance in tolerances:
        try:
            run = bench.run("SCHEME RADAU SOLVER KLU", f"H {model.step!r} TOL {tolerance!r}", 1)
        except RuntimeError:
            continue
        for looser, longer in ((27, 1), (27, 3), (27, 8), (10, 2), (100, 4)):
            loose = looser * tolerance
            if loose > 0.2:
                continue
            try:
                other = bench.run(
                    "SCHEME RADAU SOLVER KLU",
                    f"H {model.step!r} TOL {loose!r} HMAX {longer * model.end / 50!r}",
                    1,
                    compare=False,
                )
            except RuntimeError:
                continue
            distance = other.compare(run, model, bench.units).error
            growth = math.log1p(distance / run.error)
            fewer = max(run.steps / other.steps, 1.02)
            rows.append(
                f"| {model.title} | {tolerance:g} | {run.error:.1e} | {looser:g} | {longer} "
                f"| {other.steps}/{run.steps} | {distance:.1e} | {growth / math.log(looser):.2f} "
                f"| {growth / math.log(fewer):.1f} |"
            )
    return rows


SCHEMES = ("CHUNG RHO 0.8", "NEWMARK", "HHT", "BOSSAK", "RADAU")


def slopes(bench: Bench) -> list[str]:
    model, rows = bench.model, []
    for scheme in SCHEMES:
        before: tuple[float, list[float]] | None = None
        for step in model.steps:
            try:
                run = bench.run(f"SCHEME {scheme} SOLVER KLU", f"H {step!r}", 1)
            except RuntimeError as error:
                rows.append(f"| {model.title} | {scheme} | {step:g} | failed: {error} |")
                continue
            found = [run.of(kind) for kind in model.channels]
            powers = ["", "", ""]
            if before:
                powers = [
                    f"{math.log(b / a) / math.log(before[0] / step):.1f}"
                    for a, b in zip(found, before[1], strict=True)
                ]
            before = (step, found)
            rows.append(
                f"| {model.title} | {scheme} | {step:g} | {run.seconds:.3f} | "
                + " | ".join(map(cell, found))
                + " | "
                + " | ".join(powers)
                + " |"
            )
    return rows


LADDER = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
KEPT, RADAU = "generalised-α, kept factors, fixed steps", "Radau IIA, fixed steps"
CONTROLLED, DIAL, DECK = "Radau IIA, TOL", "ACCURACY, with its estimate", "the deck as it is"
MARKS = {KEPT: "o-", RADAU: "s-", CONTROLLED: "^-", DIAL: "D--", DECK: "k*"}


def points(bench: Bench) -> dict[str, list[tuple[str, float, float]]]:
    """What is drawn of a model: name, seconds and error of the runs of each line that come to their end."""
    model = bench.model
    settings, ladder = (list(SETTINGS), LADDER) if model.resolved else (list(SETTINGS)[:-1], LADDER[:-1])
    steps = [model.steps[0] * 2.0**-k for k in range(6)]
    lines = {
        KEPT: [("", "RHO 0.8 SOLVER KLU TANGENT KEPT", f"H {h!r}") for h in steps],
        RADAU: [("", "SCHEME RADAU SOLVER KLU", f"H {h!r}") for h in steps[:5]],
        CONTROLLED: [("", "SCHEME RADAU SOLVER KLU", f"H {model.step!r} TOL {t!r}") for t in ladder],
        DIAL: [(rung, f"ACCURACY {rung}", f"H {model.step!r}") for rung in settings],
        DECK: [("", None, f"H {model.step!r}")],
    }
    found: dict[str, list[tuple[str, float, float]]] = {}
    for label, tries in lines.items():
        found[label] = []
        for name, *words in tries:
            try:
                run = bench.run(*words)
            except RuntimeError:
                continue
            found[label].append((name, run.seconds, run.error))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    known = models()
    parser.add_argument("binary", type=Path)
    parser.add_argument("--models", nargs="+", choices=known)
    parser.add_argument("--runs", type=int, default=2)
    parser.add_argument("--no-dial", action="store_true")
    parser.add_argument("--tolerances", nargs="*", type=float, default=[])
    parser.add_argument("--companions", nargs="*", type=float, default=[], help="TOL of runs with companions")
    parser.add_argument("--picture", type=Path, help="draw the models and print nothing")
    parser.add_argument("--slopes", action="store_true")
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        if a.picture:
            drawn = [known[name] for name in a.models or known]
            benches = (Bench(a.binary.resolve(), Path(folder), model, a.runs) for model in drawn)
            lines = {bench.model.title: points(bench) for bench in benches}
            draw(lines, MARKS, DIAL, a.picture, left=("FINE",), one_scale=True)
            return
        for name in a.models or known:
            bench = Bench(a.binary.resolve(), Path(folder), known[name], a.runs)
            own = f"own error {bench.own_error:.1e}" if bench.own_error else "equation of its own"
            print(f"\n{known[name].title}: truth: {own}\n")
            if not a.no_dial:
                print(
                    "| model | setting | steps | s | estimate | error | estimate : error | met |\n"
                    + "|---" * 8
                    + "|"
                )
                for row in dial(bench):
                    print(row, flush=True)
            if a.tolerances:
                print("\n| model | TOL | steps | s | x | v | force | power of TOL |\n" + "|---" * 8 + "|")
                print("\n".join(ladder(bench, a.tolerances)), flush=True)
            if a.companions:
                print(
                    "\n| model | TOL | error | looser | HMAX times | steps | distance "
                    "| power of TOL | of steps |\n" + "|---" * 9 + "|"
                )
                print("\n".join(companions(bench, a.companions)), flush=True)
            if a.slopes:
                print(
                    "\n| model | scheme | H | s | x | v | force | slope x | v | force |\n" + "|---" * 10 + "|"
                )
                print("\n".join(slopes(bench)), flush=True)


if __name__ == "__main__":
    main()
