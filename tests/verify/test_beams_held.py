# SPDX-License-Identifier: BSD-3-Clause
"""Beams that do not stretch or shear, against the elastica and the limit of stiff ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from beam_problems import Line, clamp, deck, orders, statics, straight, tip
from runs import run, solve
from test_beams import elastica

HELD = "BPR 1 INEXTENSIBLE UNSHEARABLE"


def cantilever(alpha: float, pieces: int, nodes: int, folder: Path, beam: str, stiff: float) -> np.ndarray:
    """Where the tip is."""
    line = Line(straight(1), pieces, nodes)
    loads = f" {clamp(1)}\n CHA NOEUD {line.last} C 2 V {alpha} NF 1"
    section = f"EA {stiff!r} GA {stiff!r} {stiff!r} GJ 1 EI 1 1"
    return tip(run(deck([line], section, statics(loads, 10), beam), folder), line)[:2]


@pytest.mark.parametrize(
    ("alpha", "nodes", "expected"),
    [(1, 3, [4.148e-6, 2.626e-7]), (10, 3, [3.864e-4, 2.620e-5]), (10, 2, [6.521e-3, 1.756e-3])],
)
def test_elastica(alpha: float, nodes: int, expected: list[float], tmp_path: Path) -> None:
    """Whatever EA and GA are: here as small as EI. Orders 4 and 2, as of beams that stretch."""
    errors = []
    for pieces in (4, 8):
        end = cantilever(alpha, pieces, nodes, tmp_path, HELD, 1)
        errors.append(np.hypot(*(end - elastica(alpha))))
    assert errors == pytest.approx(expected, rel=1e-3)
    assert orders(errors)[-1] == pytest.approx(2 * nodes - 2, abs=0.15)


def test_limit(tmp_path: Path) -> None:
    """What stiff beams differ by falls with 1/EA."""
    held = cantilever(10, 4, 3, tmp_path, HELD, 1)
    away = [np.hypot(*(cantilever(10, 4, 3, tmp_path, "BPR 1", stiff) - held)) for stiff in (1e4, 1e5, 1e6)]
    assert np.array(away[:-1]) / away[1:] == pytest.approx(10, rel=0.02)


def condition(beam: str, stiff: float, folder: Path) -> float:
    line = Line(straight(1), 8)
    loads = f" {clamp(1)}\n CHA NOEUD {line.last} C 2 V 1 NF 1"
    section = f"EA {stiff!r} GA {stiff!r} {stiff!r} GJ 1 EI 1 1"
    found, _ = solve(deck([line], section, statics(loads, 1), beam), folder, "c", "--condition")
    return found["linear_system"]["condition"]


def test_condition(tmp_path: Path) -> None:
    """Multipliers take the place of stiffness that drives up the condition of the matrix."""
    assert [condition(HELD, stiff, tmp_path) for stiff in (1e2, 1e12)] == pytest.approx(
        [1.353e3, 1.353e3], rel=0.01
    )
    assert condition("BPR 1", 1e12, tmp_path) > 1e13
