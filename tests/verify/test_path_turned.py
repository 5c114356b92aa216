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


def arch(end: float) -> str:
    """A flat arch of 20 by 2 cells of 4 nodes, hinged at both ends, with a force in its middle."""
    nodes, cells = [], []
    for i in range(21):
        x = i - 10.0
        nodes += [f" I {3 * i + j + 1} X {x} {1.2 * (1 - (x / 10) ** 2) + 0.25 * j}" for j in range(3)]
    for i in range(20):
        a = 3 * i + 1
        cells += [f" I {2 * i + j + 1} N {a + j} {a + 3 + j} {a + 4 + j} {a + 1 + j}" for j in range(2)]
    lines = "\n".join([".NOE", *nodes, ".MAI", *cells])
    return f"""{lines}
.MAT
 I 1 BEHA "ELASTIC" YT 1.2E6 NT 0.3
.HYP MEMB BIDIM
.SEL
 GROUP 1 MAILLES NOM "b" TOUT
.PHP
 GROUP "b" THICK VAL 1.
.AEL
 GROUP "b" MAT 1
.FCT
 I 1 EXPR "T"
.CLM
 NOEUD 2 62 FIX C 1 2
 NOEUD 32 CHA C 2 V -4000 NF 1
.SAM TYPE STATIC
.SUB TF {end} H 0.05
.PATH NODE 32 C 2 V -2.5 STEPS 200
.FIN 1
"""


@pytest.mark.parametrize("end", [0.2, 1, 2, 5])
def test_does_not_leave_for_another_path(end: float, tmp_path: Path) -> None:
    """The path winds between others close to it. TF allows longer steps, and no more."""
    summary, found = solve(arch(end), tmp_path)
    points = summary["critical_points"]
    expected = [0.0758570, 0.0829232, -0.1052880, -0.0715822, 0.0748779, 0.0841412, -0.0826652, -0.0364796]
    assert [p["kind"][0] for p in points] == list("bllbbllb")
    assert [p["load_time"] for p in points] == pytest.approx(expected, abs=1e-6)
    assert [p["unstable_behind"] for p in points] == [1, 2, 3, 4, 3, 2, 1, 0]
    assert found["run/LOAD_TIME"][-1] == pytest.approx(0.0528514, rel=1e-6)
    assert found["node/32/UY"][-1] == pytest.approx(-2.5, rel=1e-12)
