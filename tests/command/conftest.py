# SPDX-License-Identifier: BSD-3-Clause
"""The program as it is called: a folder to work in, and a small deck."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

TESTS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TESTS.parent / "post"))
sys.path.insert(0, str(TESTS))

from ranks import on_ranks  # noqa: E402
from small_decks import PENDULUM  # noqa: E402


@pytest.fixture
def engrane(tmp_path):
    """Calls the program in an empty folder: engrane("check", "x.dat"), or engrane.succeeds("x", text, "-q")
    with a deck."""
    program = os.environ.get("ENGRANE", "")
    if not Path(program).is_file():
        pytest.skip("the variable ENGRANE names no program")

    def call(*words, timeout=120, ranks=1, **options):
        command = on_ranks(ranks, [program, *words]) if ranks > 1 else [program, *words]
        return subprocess.run(
            command, cwd=tmp_path, capture_output=True, text=True, timeout=timeout, **options
        )

    def succeeds(name, text, *words):
        """Runs a deck of this name and text, with status 0."""
        (tmp_path / f"{name}.dat").write_text(text)
        done = call(f"{name}.dat", *words)
        assert done.returncode == 0, done.stderr
        return done

    call.folder = tmp_path
    call.succeeds = succeeds
    return call


@pytest.fixture
def pendulum(tmp_path):
    (tmp_path / "pendulum.dat").write_text(PENDULUM)
    return "pendulum.dat"


@pytest.fixture
def sessions():
    """A folder with a path short enough for the sockets of Open MPI, in place of /tmp."""
    with tempfile.TemporaryDirectory(prefix="e", dir="/tmp") as folder:
        yield Path(folder)
