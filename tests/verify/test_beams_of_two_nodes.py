# SPDX-License-Identifier: BSD-3-Clause
"""Pieces of two nodes: exact for loads at their ends, as those of other programs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import run

YOUNG, SIZE, LENGTH, LOAD = 2.1e11, 0.02, 1.0, 10.0
SHEAR = YOUNG / 2.6 * SIZE**2 * 5 / 6
BENDING = YOUNG * SIZE**4 / 12


def nodes(count: int) -> str:
    """Along a direction in space, so that nothing is in line with the axes."""
    way = np.array([1.0, 2.0, -0.5]) / np.linalg.norm([1, 2, -0.5]) * LENGTH
    lines = [
        " I {} X {!r} {!r} {!r}".format(n + 1, *(float(c) for c in way * n / (count - 1)))
        for n in range(count)
    ]
    return ".NOE\n" + "\n".join(lines) + "\n"


def cantilever(count: int, section: str, load: str, more: str = "", step: float = 1) -> str:
    names = " ".join(str(n + 1) for n in range(count))
    return (
        f"{nodes(count)}.MAT\n I 1 YT {YOUNG!r} NT 0.3 M 7800\n.BPR\n I 1 {section}\n"
        f".MCE\n I 1 BEAM N {names} BPR 1 {more} AXIS2 0 0 1\n"
        f".CLM\n FIX NOEUD 1 C 1 2 3 4 5 6\n CHA NOEUD {count} {load}\n"
        f".SAM TYPE STATIC\n.SUB TF 1 H {step}\n.FIN 1\n"
    )


def motion(text: str, count: int, folder: Path, name: str) -> np.ndarray:
    found = run(text, folder, name)
    return np.array([found[f"node/{count}/{c}"][-1] for c in ("UX", "UY", "UZ", "RX", "RY", "RZ")])


@pytest.mark.parametrize("count", [2, 3])
def test_deflection_of_a_cantilever(count: int, tmp_path: Path) -> None:
    """A quarter was missing of the bending of one piece of two nodes."""
    text = cantilever(
        count, f"RECTANGLE {SIZE} {SIZE} SHEAR {5 / 6!r} {5 / 6!r}", f"C 3 V {LOAD * 1e-6}", "MAT 1"
    )
    sag = motion(text, count, tmp_path, "beam")[2] / 1e-6
    across = 1 - 0.5**2 / (1 + 2**2 + 0.5**2)  # of the load, squared
    pull = LOAD * LENGTH / (YOUNG * SIZE**2) * (1 - across)
    assert sag == pytest.approx(across * LOAD * (LENGTH**3 / 3 / BENDING + LENGTH / SHEAR) + pull, rel=1e-7)


@pytest.mark.parametrize("load", ["C 1 2 3 V {0} {0} {0}", "C 4 5 6 V {0} {0} {0}"])
def test_section_whose_forces_are_all_coupled(load: str, tmp_path: Path) -> None:
    """One piece of two nodes as 16 pieces of three."""
    spread = np.random.default_rng(7).normal(size=(6, 6))
    scale = np.diag([1e3, 3e2, 3e2, 1e2, 1e2, 1e2])
    stiffness = scale @ (spread @ spread.T + 3 * np.eye(6)) @ scale / 10
    section = "K\n " + "\n ".join(repr(float(stiffness[i, j])) for i in range(6) for j in range(i, 6))
    tips = [motion(cantilever(n, section, load.format(1e-3)), n, tmp_path, f"n{n}") for n in (2, 33)]
    assert tips[0] == pytest.approx(tips[1], abs=1e-7 * np.abs(tips[1]).max())


def test_large_turns(tmp_path: Path) -> None:
    """A bar bent to a quarter of a circle and more: 8 pieces of two nodes as 32 of three."""
    load = f"C 3 V {8 * BENDING / LENGTH**2!r} NF 1\n.FCT\n I 1 RAMP 0 0 1 1"
    section = f"RECTANGLE {SIZE} {SIZE}"
    pieces = motion(cantilever(9, section, load, "MAT 1 LINEAR", 0.1), 9, tmp_path, "two")
    truth = motion(cantilever(65, section, load, "MAT 1", 0.1), 65, tmp_path, "three")
    assert np.abs(truth[3:]).max() > 1
    assert pieces == pytest.approx(truth, abs=0.0025)  # 0.0022 as measured
