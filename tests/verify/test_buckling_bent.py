# SPDX-License-Identifier: BSD-3-Clause
"""Linearised buckling where several modes buckle at once, and where the loads also bend the structure."""

from pathlib import Path

import h5py
import numpy as np
import pytest
from beam_problems import Line, clamp, deck, straight
from runs import solve

E, SIDE, LENGTH = 2.1e11, 0.05, 3.0
EI = E * SIDE**4 / 12
PINNED = np.pi**2 * EI / LENGTH**2  #: Euler load


def buckling(text: str, folder: Path) -> tuple[dict, list[float]]:
    account, _ = solve(text, folder)
    with h5py.File(folder / "deck.h5") as file:
        return account, list(file["modes/load_time"][()]) if "modes" in file else []


def mast(section: str, conditions: str, modes: int, pieces: int = 10, plane: str = "") -> str:
    line = Line(straight(LENGTH), pieces)
    steel = f".MAT\n I 1 YT {E!r} NT 0.3 M 7850\n"
    rest = f"""{steel}.CLM
 {clamp(1)}
{conditions.format(tip=line.last)}
.FCT
 I 1 EXPR "T"
.SAM TYPE STATIC {plane}
.SUB TF 1 H 1
.BUCKLING MODES {modes}"""
    return deck([line], section, rest, "BPR 1 MAT 1 AXIS2 0 1 0")


@pytest.mark.parametrize("modes", [1, 2, 3])
@pytest.mark.parametrize("pieces", [2, 3, 10])
def test_a_round_mast_under_its_weight(modes: int, pieces: int, tmp_path: Path) -> None:
    """Two modes at once. Rounding made a complex pair of them, which was taken for no buckling: the lowest
    load was missed, or all of them."""
    text = mast(
        "TUBE 0.1 0.092",
        " STRU ACC VAL -9.81 0 0\n CHA NOEUD {tip} C 1 V -1000 NF 1",
        modes,
        pieces,
    )
    _, times = buckling(text, tmp_path)
    inertia, area = np.pi * (0.1**4 - 0.092**4) / 64, np.pi * (0.1**2 - 0.092**2) / 4
    euler = np.pi**2 * E * inertia / (4 * LENGTH**2)
    # own weight q L lowers the load at the top by 0.3 of itself (Timoshenko and Gere, Theory of Elastic
    # Stability, 2.12)
    single = (euler - 0.3 * 7850 * area * 9.81 * LENGTH) / 1000
    assert len(times) == modes
    assert times[: min(2, modes)] == pytest.approx([single] * min(2, modes), rel=2e-3)
    if modes > 1:
        assert times[1] == pytest.approx(times[0], rel=1e-6)
    if modes == 3:
        assert times[2] > 7 * single


def test_modes_of_equal_loads_differ(tmp_path: Path) -> None:
    text = mast(f"RECTANGLE {SIDE} {SIDE}", " CHA NOEUD {tip} C 1 V -1000 NF 1", 2)
    buckling(text, tmp_path)
    with h5py.File(tmp_path / "deck.h5") as file:
        first, second = (file[f"modes/mode_{i}"][()].ravel() for i in (1, 2))
    assert abs(first @ second) < 0.9 * np.linalg.norm(first) * np.linalg.norm(second)


@pytest.mark.parametrize("part", [0.01, 0.05])
def test_a_mast_with_a_side_force(part: float, tmp_path: Path) -> None:
    """Its bending turns the stiff axis, which counted as a loss of stiffness: 0.49 and 0.13 of the Euler
    load were given."""
    euler = PINNED / 4
    text = mast(
        f"RECTANGLE {SIDE} {SIDE}",
        f" CHA NOEUD {{tip}} C 1 2 V {-euler!r} {-part * euler!r} NF 1",
        1,
        plane="PLANE XY",
    )
    account, times = buckling(text, tmp_path)
    assert times == pytest.approx([1], rel=0.05)
    assert "the loads turn members" in account["said"]


def test_a_strip_that_only_bends(tmp_path: Path) -> None:
    """In its plane it never buckles; 0.05 was given. What is left has members turned by half a radian, and is
    warned of."""
    text = mast("RECTANGLE 0.01 0.1", " CHA NOEUD {tip} C 2 V -10 NF 1", 1, plane="PLANE XY")
    account, times = buckling(text, tmp_path)
    slope = 10 * LENGTH**2 / (2 * E * 0.1 * 0.01**3 / 12)
    assert all(abs(t) * slope > 0.5 for t in times)
    assert not times or "the loads turn members" in account["said"]


@pytest.mark.parametrize(("bow", "off"), [(1000, 1e-3), (250, 5e-3)])
def test_a_bowed_column(bow: float, off: float, tmp_path: Path) -> None:
    """0.70 of the Euler load was given for a bow of L/250."""

    def place(u: float) -> np.ndarray:
        return np.array([LENGTH * u, LENGTH / bow * np.sin(np.pi * u), 0])

    line = Line(place, 10)
    rest = f""".MAT
 I 1 YT {E!r} NT 0.3 M 7850
.CLM
 FIX NOEUD 1 C 1 2 3
 FIX NOEUD {line.last} C 2 3
 CHA NOEUD {line.last} C 1 V {-PINNED!r} NF 1
.FCT
 I 1 EXPR "T"
.SAM TYPE STATIC PLANE XY
.SUB TF 1 H 1
.BUCKLING MODES 1"""
    text = deck([line], f"RECTANGLE {SIDE} {SIDE}", rest, "BPR 1 MAT 1 AXIS2 0 1 0")
    account, times = buckling(text, tmp_path)
    assert times == pytest.approx([1], rel=off + 1e-3)
    assert bow < 1000 or "the loads turn members" not in account["said"]


def test_a_portal_with_wind(tmp_path: Path) -> None:
    """The limit point of the path is at 4.478; 1.92 was given."""
    height, span = 4.0, 6.0
    left = Line(lambda u: np.array([0, height * u, 0]), 6)
    beam = Line(lambda u: np.array([span * u, height, 0]), 8, first=left.last, element=11)
    right = Line(lambda u: np.array([span, height * (1 - u), 0]), 6, first=beam.last, element=31)
    nodes = {i: p for line in (left, beam, right) for i, p in zip(line.ids, line.points, strict=True)}
    text = ".NOE\n" + "\n".join(f" I {i} X {p[0]:.16g} {p[1]:.16g} {p[2]:.16g}" for i, p in nodes.items())
    down = 10e3 * span / 16

    def rest(analysis: str, end: float) -> str:
        loads = [f" CHA NOEUD {i} C 2 V {-down!r} NF 1" for i in beam.ids[1:-1]]
        loads += [f" CHA NOEUD {i} C 2 V {-down / 2!r} NF 1" for i in (beam.ids[0], beam.ids[-1])]
        wind = [f" CHA NOEUD {i} C 1 V {3e3 * height / 12!r} NF 1" for i in left.ids[1:]]
        beams = "\n".join(one.beam("BPR 1 MAT 1 AXIS2 0 0 1") for one in (left, beam, right))
        return f"""
.MAT
 I 1 YT {E!r} NT 0.3 M 7850
.BPR
 I 1 RECTANGLE 0.1 0.1
.MCE
{beams}
.CLM
 FIX NOEUD 1 {right.last} C 1 2 3
{chr(10).join(loads + wind)}
.FCT
 I 1 EXPR "T"
.SAM TYPE STATIC PLANE XY
.SUB TF {end} H 0.1
{analysis}
.FIN 1
"""

    _, times = buckling(text + rest(".BUCKLING MODES 1", 1), tmp_path)
    account, _ = solve(text + rest(".PATH STEPS 80", 1e3), tmp_path, "path")
    limit = account["critical_points"][0]["load_time"]
    assert times == pytest.approx([limit], rel=0.08)


def test_a_shallow_truss_is_warned_of(tmp_path: Path) -> None:
    """It snaps at 37.9, by its rotations, which linearised buckling leaves out."""
    text = """.NOE
 I 1 X -10 0 0
 I 2 X 0 1 0
 I 3 X 10 0 0
.MCE
 I 1 BAR N 1 2 EA 1D5
 I 2 BAR N 3 2 EA 1D5
.CLM
 FIX NOEUD 1 3 C 1 2 3
 FIX NOEUD 2 C 1 3
 CHA NOEUD 2 C 2 V -1 NF 1
.FCT
 I 1 EXPR "T"
.SAM TYPE STATIC
.SUB TF 1 H 0.1
.BUCKLING MODES 1
.FIN 1
"""
    account, times = buckling(text, tmp_path)
    length = np.hypot(10, 1)
    # where N of each bar is EA over the square of its length, at a strain of 1 per cent, which changes the
    # stiffness itself by 3 strains
    force = 1e5 / length**2
    assert times == pytest.approx([2 * force / length], rel=3 / length**2)
    assert "the loads turn members" in account["said"]
