# SPDX-License-Identifier: BSD-3-Clause
"""Result files for the tests, written by models.py, and a runner of the command line."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.path.insert(0, str(HERE.parent))
sys.path.insert(0, str(HERE.parents[1] / "post"))

import models  # noqa: E402


@pytest.fixture
def two(tmp_path: Path) -> Path:
    return models.two_wheels(tmp_path / "two.h5")


@pytest.fixture
def planetary(tmp_path: Path) -> Path:
    return models.planetary(tmp_path / "planetary.h5")


@pytest.fixture
def bevel(tmp_path: Path) -> Path:
    return models.bevel(tmp_path / "bevel.h5")


@pytest.fixture
def command(capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str, str]]:
    """Runs `engrane ...` in this process: exit status, output, errors."""
    from engrane_post.__main__ import main

    def call(*words: str | Path) -> tuple[int, str, str]:
        status = main([str(w) for w in words])
        out = capsys.readouterr()
        return status, out.out, out.err

    return call
