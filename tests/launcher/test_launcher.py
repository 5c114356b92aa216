# SPDX-License-Identifier: BSD-3-Clause
"""The launcher, as a user meets it; the program itself is tested elsewhere."""

import os
import shutil
import subprocess
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LAUNCHER = ROOT / "engrane"


def launch(*words, launcher=LAUNCHER, **options):
    return subprocess.run(
        [launcher, *words], capture_output=True, text=True, stdin=subprocess.DEVNULL, **options
    )


def test_words_are_listed_without_building():
    result = launch("--help")
    assert result.returncode == 0
    for word in ("check", "plot", "sweep", "study", "figures", "demo", "test", "-np"):
        assert word in result.stdout
    assert launch().stdout == result.stdout


def test_packages_are_names_of_debian_packages():
    names = launch("--packages").stdout.split()
    assert "petsc-dev" in names
    assert len(names) == len(set(names))


@pytest.fixture
def clone(tmp_path):
    """A folder with the launcher and a program that is up to date: a script that shows what it was given."""
    for name in ("CMakeLists.txt", "CMakePresets.json", "engrane"):
        shutil.copy2(ROOT / name, tmp_path)
    (tmp_path / "tests").mkdir()
    shutil.copy2(ROOT / "tests/CMakeLists.txt", tmp_path / "tests")
    shutil.copytree(ROOT / "src", tmp_path / "src")
    shutil.copytree(ROOT / ".cmake", tmp_path / ".cmake")
    program = tmp_path / "build/bin/engrane"
    program.parent.mkdir(parents=True)
    program.write_text('#!/bin/sh\nprintf "%s|" "$@"; echo; printenv OMP_NUM_THREADS; exit 4\n')
    program.chmod(0o755)
    (tmp_path / "build/.built").touch()
    return tmp_path


def test_words_streams_and_status_pass_through(clone):
    result = launch(
        "my deck.dat", "-o", "out put", launcher=clone / "engrane", env=os.environ | {"OMP_NUM_THREADS": "7"}
    )
    assert result.returncode == 4
    assert result.stdout.splitlines() == ["my deck.dat|-o|out put|", "7"]
    assert result.stderr == ""


def test_runs_through_a_link_from_another_folder(clone, tmp_path_factory):
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    (elsewhere / "engrane").symlink_to(clone / "engrane")
    assert launch("check", launcher=elsewhere / "engrane", cwd=elsewhere).stdout.startswith("check|")


def test_costs_little_when_nothing_changed(clone):
    best = float("inf")
    for _ in range(5):
        start = time.perf_counter()
        launch("x", launcher=clone / "engrane")
        best = min(best, time.perf_counter() - start)
    assert best < 0.2


def test_a_change_is_noticed_and_a_failed_build_shows_its_log(clone):
    (clone / "CMakeLists.txt").write_text('message(FATAL_ERROR "no luck today")\n')
    os.utime(clone / "build/.built", (1, 1))
    result = launch("x", launcher=clone / "engrane", env=os.environ | {"CI": "true"})
    assert result.returncode == 1
    assert "no luck today" in result.stderr
    assert "build.log" in result.stderr
    assert result.stdout == ""


def test_ranks_need_a_number_and_a_deck():
    result = launch("-np", "3")
    assert result.returncode == 1
    assert "-np 3 deck.dat" in result.stderr
