# SPDX-License-Identifier: BSD-3-Clause
"""Paths of models that are not lined up with the axes: rounding is in every component there."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from beam_problems import Line, clamp, deck, straight
from runs import Run, solve

LENGTH = 10.0
EULER = np.pi**2 * 1e3 / (4 * LENGTH**2)  # of a column with EI 1e3, clamped and free
SECTION = "EA 1D5 GA 4D4 4D4 GJ 1D3 EI 1D3 1.5D3"
END = 4
TURNS = [np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0] for seed in range(4)]


def column(turn: np.ndarray, folder: Path, card: str = ".PATH") -> tuple[list[dict], Run, np.ndarray]:
    """Pressed by END times its Euler load: its critical points, and how far its end moves in its own axes."""
    axis, side, _ = turn.T
    line = Line(straight(LENGTH, axis), 8)
    push = " ".join(repr(float(-EULER * a)) for a in axis)
    rest = f""".CLM
 {clamp(1)}
 CHA NOEUD {line.last} C 1 2 3 V {push} NF 1
.FCT
 I 1 EXPR "T"
.SAM TYPE STATIC
.SUB TF {END} H 0.4
{card}
"""
    axis2 = " ".join(repr(float(s)) for s in side)
    summary, found = solve(deck([line], SECTION, rest, f"BPR 1 AXIS2 {axis2}"), folder)
    moved = np.array([found[f"node/{line.last}/U{c}"] for c in "XYZ"])
    return summary["critical_points"], found, turn.T @ moved


@pytest.mark.parametrize("turn", TURNS)
def test_stays_on_its_path(turn: np.ndarray, tmp_path: Path) -> None:
    """A straight column goes on straight, past the loads at which it may bend: one in each of its planes.
    It went on bent, with both twice."""
    points, found, moved = column(turn, tmp_path)
    expected, _, along = column(np.eye(3), tmp_path)
    assert [(p["kind"], p["unstable_before"], p["unstable_behind"]) for p in points] == [
        ("bifurcation", 0, 1),
        ("bifurcation", 1, 2),
    ]
    assert [p["load_time"] for p in points] == pytest.approx([1, 1.5], rel=2e-2)
    assert [p["load_time"] for p in points] == pytest.approx([p["load_time"] for p in expected], rel=1e-7)
    assert np.abs(moved[1:]).max() < 1e-6 * LENGTH
    assert moved[0][-1] == pytest.approx(along[0][-1], rel=1e-9)
    assert found["run/LOAD_TIME"][-1] == pytest.approx(END, rel=1e-12)


@pytest.mark.parametrize("turn", TURNS)
def test_second_branch(turn: np.ndarray, tmp_path: Path) -> None:
    """Only the branch that is asked for is taken: the column bends in its stiffer plane."""
    points, _, moved = column(turn, tmp_path, ".PATH BRANCH 2 AMPLITUDE 0.05 STEPS 12")
    assert [p["load_time"] for p in points[:2]] == pytest.approx([1, 1.5], rel=2e-2)
    sides = np.abs(moved[1:, -1])
    assert sides.max() > 0.1 * LENGTH
    assert sides.min() < 1e-3 * sides.max()
