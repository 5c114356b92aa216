# SPDX-License-Identifier: BSD-3-Clause
"""Runs decks written by tests with the program that the variable ENGRANE names."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from engrane_post import Results
from ranks import on_ranks


class Run:
    """Histories of a run: run["3/NORMAL_FORCE"], run["node/2/UX"], run.t."""

    def __init__(self, file: Path) -> None:
        self.file = file
        with Results(file) as r:
            self.t = r.times()

    def __getitem__(self, channel: str) -> np.ndarray:
        path = channel if channel.split("/")[0] in ("node", "run", "element") else f"element/{channel}"
        with Results(self.file) as r:
            return r.history(path)[1]


def program() -> str:
    """The program; without it, the test is skipped."""
    path = os.environ.get("ENGRANE", "")
    if not Path(path).is_file():
        pytest.skip("the variable ENGRANE names no program")
    return path


def engrane(
    text: str, folder: Path, *words: str, name: str = "deck", ranks: int = 1, timeout: float = 300, **options
) -> subprocess.CompletedProcess[str]:
    """Writes a deck into the folder and runs it there, or what the words ask for; it may end with any status.
    `options` are those of subprocess.run."""
    (folder / f"{name}.dat").write_text(text, encoding="utf-8")
    command = on_ranks(ranks, [program(), *words, f"{name}.dat"])
    return subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=timeout, check=False, **options
    )


def run(
    text: str,
    folder: Path,
    name: str = "deck",
    timeout: float = 300,
    ranks: int = 1,
    options: tuple[str, ...] = (),
    status: int = 0,
    output: Path | None = None,
) -> Run:
    """The results of a deck; another status, as of failed checks, fails the test. What the program prints
    goes to `output`."""
    done = engrane(text, folder, *options, name=name, ranks=ranks, timeout=timeout)
    assert done.returncode == status, done.stdout + done.stderr
    if output:
        output.write_text(done.stdout)
    return Run(folder / f"{name}.h5")


def said(text: str, folder: Path) -> str:
    """What the terminal shows of a run that ends with status 0."""
    done = engrane(text, folder, "-q")
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stderr


def solve(deck: str, folder: Path, name: str = "deck", *words: str, status: int = 0) -> tuple[dict, Run]:
    """Runs a deck: what --json says of it, with what the terminal shows as "said", and its results."""
    done = engrane(deck, folder, "-q", "--json", *words, name=name)
    assert done.returncode == status, done.stderr
    return json.loads(done.stdout)["runs"][0] | {"said": done.stderr}, Run(folder / f"{name}.h5")
