# SPDX-License-Identifier: BSD-3-Clause
"""Runs of the solver, a few at a time: what `engrane sweep` and `engrane study` share."""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from . import options
from .errors import Terminated, UserError

# from fine to worst: as the program ranks the statuses of several decks
STATUSES = (0, 4, 1, 2, 3)
SOLVED = (0, 4)
PATIENCE = 10.0  # seconds that a run may take to end after it was told to
# whose faults are those of the command, not of the deck
OPTIONS = ("--result", "--card")


@dataclass
class Run:
    """One run of a deck and what came of it."""

    title: str
    words: list[str]  # of the command line, behind the deck
    prefix: Path  # of its results
    status: int = 3
    outcome: str = "not run"
    message: str = ""
    summary: dict[str, Any] = field(default_factory=dict)  # what --json tells of it
    cpu: float = 0.0  # seconds of processor time of the whole process

    @property
    def short(self) -> bool:
        """The run is to stop before its end."""
        return any(w.startswith("--until") for w in self.words)

    @property
    def solved(self) -> bool:
        """The run came to its end; a .CHK may have failed."""
        return self.status in SOLVED

    @property
    def reason(self) -> str:
        """Why it was not solved, in one line; the messages of MPI begin with a line of dashes."""
        lines = (line for line in self.message.splitlines() if line.strip("- "))
        return next(lines, self.outcome)

    @property
    def numbers(self) -> dict[str, float | None]:
        """The numbers of --result, else those of the deck's .CHK."""
        wanted = self.summary.get("results") or self.summary.get("checks") or []
        return {r["name"]: r["value"] for r in wanted}


class Pool:
    """Runs of one deck."""

    def __init__(self, program: Path, deck: str, jobs: int) -> None:
        self.command = [str(program), deck, "--json", "-q"]
        self.jobs = jobs
        self.running: set[int] = set()
        self.lock = threading.Lock()
        self.stopped = False
        self.shown = False

    def run(self, runs: Sequence[Run], what: str = "") -> None:
        """Makes these runs and shows on a terminal which one has begun last."""
        self.what, self.count, self.begun = what, len(runs), 0
        self.shown = sys.stderr.isatty()
        with ThreadPoolExecutor(max(1, min(self.jobs, len(runs)))) as pool:
            tasks = [pool.submit(self._run, run) for run in runs]
            try:
                finished, _ = wait(tasks, return_when=FIRST_EXCEPTION)
                for task in finished:
                    task.result()
            except BaseException:
                self.stop(signal.SIGTERM)
                if wait(tasks, timeout=PATIENCE).not_done:
                    self.stop(signal.SIGKILL)
                raise
            finally:
                pool.shutdown(cancel_futures=True)
                if self.shown:
                    print("\r\033[K", end="", file=sys.stderr, flush=True)

    def stop(self, how: signal.Signals) -> None:
        """Ends the runs that are going on and lets no other begin."""
        with self.lock:
            self.stopped = True
            for process in self.running:
                with suppress(ProcessLookupError):  # just ended
                    os.kill(process, how)

    def _tell(self, run: Run) -> None:
        self.begun += 1
        line = f"{self.what}{self.begun} of {self.count}  {run.title}"
        print(f"\r\033[K{line[:78]}", end="", file=sys.stderr, flush=True)

    def _run(self, run: Run) -> None:
        # one thread each: the runs themselves share the cores
        environment = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"} | dict(os.environ)
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
            with self.lock:
                if self.stopped:
                    return
                if self.shown:
                    self._tell(run)
                process = subprocess.Popen(
                    [*self.command, *run.words, "-o", str(run.prefix)],
                    stdin=subprocess.DEVNULL,
                    stdout=out,
                    stderr=errors,
                    env=environment,
                )
                self.running.add(process.pid)
            # not Popen.wait(): only this tells the processor time of one process among several
            _, status, usage = os.wait4(process.pid, 0)
            with self.lock:
                self.running.discard(process.pid)
            process.returncode = os.waitstatus_to_exitcode(status)
            texts = []
            for file in (out, errors):
                file.seek(0)
                texts.append(file.read().decode("utf-8", "replace"))
        if self.stopped and process.returncode not in SOLVED:
            return
        run.cpu = usage.ru_utime + usage.ru_stime
        read_summary(run, process.returncode, *texts)


def read_summary(run: Run, status: int, out: str, errors: str) -> None:
    """What the program said of a run. What is wrong with the command itself ends all runs."""
    run.status = status if status in STATUSES else 3
    run.message = errors.strip()
    try:
        run.summary = json.loads(out)["runs"][0]
    except (ValueError, LookupError):
        if "interrupted at the start" not in errors:
            run.outcome = f"ended by signal {-status}" if status < 0 else "no summary"
        return
    if run.summary.get("failure", "").startswith("interrupted at ") and not run.short:
        run.summary = {}  # Ctrl-C reaches the runs, too
        return
    run.outcome = run.summary["outcome"]
    faults = [d for d in run.summary["diagnostics"] if d["severity"] == "error"]
    if any(d.get("file") in OPTIONS or d["message"].startswith(("-D ", *OPTIONS)) for d in faults):
        raise UserError("the command is wrong:\n" + run.message)


def arguments(p: argparse.ArgumentParser, suffix: str, jobs: str) -> None:
    """What every command that makes runs can be told."""
    p.add_argument(
        "--result", action="append", default=[], metavar="QUANTITY", help="as in .CHK; may be repeated"
    )
    p.add_argument("-j", dest="jobs", type=int, metavar="n", help=f"runs at a time (default: {jobs})")
    p.add_argument(
        "-o",
        "--output",
        metavar="prefix",
        help=f"of the .csv and .png (default: the deck's name and {suffix})",
    )
    p.add_argument("--keep", metavar="folder", help="keep the result files of all runs there")


def find_deck(given: str) -> str:
    """The deck, with `.dat` when that was left out."""
    deck = given if Path(given).is_file() else given + ".dat"
    if not Path(deck).is_file():
        raise UserError(f"There is no deck {given}.")
    return deck


def output_prefix(given: str | None, deck: str, suffix: str) -> str:
    """Where the table and the diagram go."""
    output = re.sub(r"\.(csv|png)$", "", given or Path(deck).stem + suffix)
    options.check_output(output + ".csv", (".csv",))
    return output


@contextmanager
def result_folder(kept: str | None) -> Iterator[Path]:
    """A folder for the results of runs; it goes away unless it was named, after SIGTERM too."""

    def terminate(*_: object) -> None:
        raise Terminated

    before = signal.signal(signal.SIGTERM, terminate)
    folder = Path(kept or tempfile.mkdtemp(prefix="engrane_runs"))
    folder.mkdir(parents=True, exist_ok=True)
    try:
        yield folder
    finally:
        signal.signal(signal.SIGTERM, before)
        if not kept:
            shutil.rmtree(folder, ignore_errors=True)


def all_cores() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0))
