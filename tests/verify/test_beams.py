# SPDX-License-Identifier: BSD-3-Clause
"""Beams at rest against closed forms and published numbers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from beam_problems import Line, clamp, deck, orders, statics, straight, tip
from runs import run
from scipy.integrate import solve_bvp
from scipy.special import ellipeinc, ellipk, ellipkinc

# Bathe and Bolourchi 1979, Int. J. Numer. Methods Eng. 14, 961: an eighth of a circle, pulled out of its
# plane. The tip under 600 is that of 2^7 pieces of three nodes, extrapolated.
BEND = "EA 1D7 GA (25D6/6) (25D6/6) GJ (5D6/6) EI (1D7/12) (1D7/12)"
BEND_TIP = np.array([47.150096240, 15.684689479, 53.475477998])


def bend(u: float) -> np.ndarray:
    a = np.pi / 4 * u
    return 100 * np.array([np.sin(a), 1 - np.cos(a), 0])


def bend_error(nodes: int, pieces: int, folder: Path) -> float:
    line = Line(bend, pieces, nodes)
    loads = f" {clamp(1)}\n CHA NOEUD {line.last} C 3 V 600 NF 1"
    return float(np.linalg.norm(tip(run(deck([line], BEND, statics(loads, 8)), folder), line) - BEND_TIP))


@pytest.mark.parametrize(
    ("nodes", "expected"), [(2, [0.2772, 0.0643, 0.01579]), (3, [0.138, 0.00981, 0.000624])]
)
def test_bend(nodes: int, expected: list[float], tmp_path: Path) -> None:
    """Errors of the tip with 5, 9 and 17 nodes."""
    errors = [bend_error(nodes, pieces, tmp_path) for pieces in np.array([4, 8, 16]) // (nodes - 1)]
    assert errors == pytest.approx(expected, rel=0.01)
    assert orders(errors)[-1] == pytest.approx(2 * nodes - 2, abs=0.05)


def elastica(alpha: float) -> tuple[float, float]:
    """Tip of a cantilever of length 1, bent by a force alpha EI across its root that keeps its direction
    (Bisshopp and Drucker 1945, Q. Appl. Math. 3, 272)."""
    low, high = np.sqrt(0.5), 1.0
    for _ in range(200):
        k = (low + high) / 2
        phi = np.arcsin(1 / (k * np.sqrt(2)))
        low, high = (k, high) if ellipk(k * k) - ellipkinc(phi, k * k) < np.sqrt(alpha) else (low, k)
    e = 2 / np.sqrt(alpha) * (ellipeinc(np.pi / 2, k * k) - ellipeinc(phi, k * k))
    return np.sqrt(2 * (2 * k * k - 1) / alpha), 1 - e


@pytest.mark.parametrize("slenderness", [1e3, 1e4, 1e6])
@pytest.mark.parametrize(("nodes", "expected"), [(2, [1.881e-3, 4.51e-4]), (3, [3.864e-4, 2.62e-5])])
def test_elastica(nodes: int, expected: list[float], slenderness: float, tmp_path: Path) -> None:
    """Of beams whose length is that many times their height the error is the same: nothing locks."""
    stiff = 12 * slenderness**2
    section = f"EA {stiff!r} GA {0.4 * stiff!r} {0.4 * stiff!r} GJ 1 EI 1 1"
    errors = []
    for pieces in np.array([8, 16]) // (nodes - 1):
        line = Line(straight(1), pieces, nodes)
        loads = f" {clamp(1)}\n CHA NOEUD {line.last} C 2 V 10 NF 1"
        found = tip(run(deck([line], section, statics(loads, 20)), tmp_path), line)
        errors.append(np.hypot(*(found[:2] - elastica(10))))
    assert errors == pytest.approx(expected, rel=0.04)
    assert orders(errors)[-1] == pytest.approx(2 * nodes - 2, abs=0.15)


def test_path_independence(tmp_path: Path) -> None:
    """Two loads and a moment in three orders, in turn and together, end in one place."""
    line = Line(bend, 4)
    ramps = {"a": "0 0 1 1", "b": "0 0 1 0 2 1", "c": "0 0 2 0 3 1", "all": "0 0 3 1"}

    def end(order: tuple[str, str, str]) -> np.ndarray:
        functions = "\n".join(f" I {i + 1} TABLE {ramps[name]} 9 1" for i, name in enumerate(order))
        loads = f""".CLM
 {clamp(1)}
 CHA NOEUD {line.last} C 3 V 500 NF 1
 CHA NOEUD {line.last} C 2 V 300 NF 2
 CHA NOEUD {line.last} C 4 V 8000 NF 3
.FCT
{functions}
.SAM TYPE STATIC PREC 1E-12
.SUB TF 3 H 0.1"""
        return tip(run(deck([line], BEND, loads), tmp_path), line)

    together = end(("all", "all", "all"))
    assert np.linalg.norm(together - line.points[-1]) > 50
    for order in [("a", "b", "c"), ("c", "a", "b"), ("b", "c", "a")]:
        assert end(order) == pytest.approx(together, abs=1e-8)


def test_turns(tmp_path: Path) -> None:
    """A curved beam that is turned 100 times about an axis across space stays without strain."""
    line = Line(bend, 2)
    turns = f""".FCT
 I 1 RAMP 0 0 1 {2 * np.pi * 100!r}
.SAM TYPE STATIC
.SUB TF 1 H {1 / 2500!r}
.SAI HISTORY 0.01"""
    hinge = " I 90 HINGE N 0 1 AXIS 1 2 3 DRIVE ANGLE NF 1"
    found = run(deck([line], BEND, turns, joints=hinge), tmp_path)
    moments = [
        abs(found[f"{1 + piece}/BENDING_MOMENT_{axis}_A"]).max() for piece in range(2) for axis in (2, 3)
    ]
    rounding = 1e7 / 12 / 100 * 1e-12  # of EI by the length
    assert max(moments) < 100 * rounding


def under_follower(load: float) -> np.ndarray:
    """Tip of a cantilever of length 1 and EI 1, without stretch and shear, under a load per length that stays
    across it: Kirchhoff's equations of equilibrium in its own axes, solved by collocation."""

    def slopes(_s: np.ndarray, y: np.ndarray) -> np.ndarray:
        _, _, turn, pull, shear, moment = y
        return np.array(
            [np.cos(turn), np.sin(turn), moment, moment * shear, -moment * pull - load, -shear + 0 * turn]
        )

    def ends(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.concatenate([a[:3], b[3:]])

    s = np.linspace(0, 1, 41)
    found = solve_bvp(
        slopes, ends, s, np.stack([s, 0 * s, 0 * s, 0 * s, 0 * s, 0 * s]), tol=1e-10, max_nodes=10**5
    )
    assert found.success
    return found.y[:2, -1]


def test_follower_load(tmp_path: Path) -> None:
    """A load along a cantilever that stays across it, until the tip has turned by more than a right angle."""
    load = 12.0
    section = "EA 1D8 GA 1D8 1D8 GJ 1 EI 1 1"
    closed = under_follower(load)
    errors = []
    for pieces in (4, 8):
        line = Line(straight(1), pieces)
        names = " ".join(map(str, line.ids))
        joints = f" I 90 LINE_LOAD N {names} V 0 {load} 0 FOLLOW NF 1"
        found = run(deck([line], section, statics(f" {clamp(1)}", 20), joints=joints), tmp_path)
        errors.append(np.hypot(*(tip(found, line)[:2] - closed)))
    assert found[f"node/{line.last}/RZ"][-1] > np.pi / 2
    assert errors == pytest.approx([4.29e-4, 2.39e-5], rel=0.02)
