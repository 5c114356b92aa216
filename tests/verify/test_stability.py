# SPDX-License-Identifier: BSD-3-Clause
"""Paths of equilibria past their critical points, and linearised buckling, against closed forms."""

from __future__ import annotations

import json
import re
from pathlib import Path

import h5py
import numpy as np
import pytest
from beam_problems import Line, clamp, deck, orders, straight
from runs import Run, run
from scipy.special import ellipk

LENGTH = 10.0
EULER = np.pi**2 * 1e3 / (4 * LENGTH**2)  # of a column with EI 1e3, clamped and free


def path(loads: str, rest: str, end: float = 1.5, step: float = 0.1) -> str:
    return f'.CLM\n{loads}\n.FCT\n I 1 EXPR "T"\n.SAM TYPE STATIC\n.SUB TF {end!r} H {step!r}\n{rest}'


def critical_points(found: Run) -> list[tuple[str, float]]:
    """Kind and load time, from the listing."""
    text = found.file.with_suffix(".lst").read_text()
    return [(k, float(v)) for k, v in re.findall(r"(limit|bifurcation) point at load time (\S+),", text)]


def column(section: str, pieces: int, folder: Path, rest: str, end: float = 1.5) -> Run:
    """Pressed by the Euler load times the load time."""
    line = Line(straight(LENGTH, (0, 1, 0)), pieces)
    loads = f" {clamp(1)}\n CHA NOEUD {line.last} C 2 V {-EULER!r} NF 1"
    return run(deck([line], section, path(loads, rest, end), "BPR 1 AXIS2 1 0 0"), folder)


STIFFNESS = 1e5 / 17**1.5  #: EA/L^3 of the shallow truss


def truss(step: float = 0.1) -> str:
    """Two shallow bars that snap through: P = (EA/L^3) (2 h w - w^2) (h - w) with Green's strain, h = 1."""
    loads = " FIX NOEUD 1 3 C 1 2 3\n FIX NOEUD 2 C 1 3\n CHA NOEUD 2 C 2 V -1000 NF 1"
    return f""".NOE
 I 1 X -4 0 0
 I 2 X 0 1 0
 I 3 X 4 0 0
.MCE
 I 1 BAR N 1 2 EA 1D5
 I 2 BAR N 3 2 EA 1D5
{path(loads, ".PATH", step=step)}
.FIN 1
"""


@pytest.mark.parametrize("solver", ["MUMPS", "KLU"])
def test_truss(solver: str, tmp_path: Path) -> None:
    """Both limits, and the path between them."""
    text = truss().replace("TYPE STATIC", f"TYPE STATIC SOLVER {solver}")
    found = run(text, tmp_path, options=("--json",), output=tmp_path / "out.json")
    summary = json.loads((tmp_path / "out.json").read_text())["runs"][0]["critical_points"]
    w = -found["node/2/UY"]
    load = STIFFNESS * (2 * w - w**2) * (1 - w)
    assert 1000 * found["run/LOAD_TIME"] == pytest.approx(load, abs=1e-6)
    limit = STIFFNESS * 2 / (3 * np.sqrt(3)) / 1000
    points = critical_points(found)
    assert [kind for kind, _ in points] == ["limit", "limit"]
    assert [value for _, value in points] == pytest.approx([limit, -limit], rel=1e-8)
    assert [p["load_time"] for p in summary] == pytest.approx([limit, -limit], rel=1e-8)
    assert [(p["kind"], p["unstable_before"], p["unstable_behind"]) for p in summary] == [
        ("limit", 0, 1),
        ("limit", 1, 0),
    ]
    assert found["run/UNSTABLE"].max() == 1
    assert found["run/LOAD_TIME"][-1] == pytest.approx(1.5, rel=1e-8)


@pytest.mark.parametrize("step", [0.1, 0.09, 0.08, 0.07, 0.06, 0.05])
def test_step_behind_a_limit(step: float, tmp_path: Path) -> None:
    """Steps are as long as lets the path turn by 6 degrees, by its turn in the step before; from a limit too,
    whichever side of it the last trial came to. The path lies in the plane of deflection and load."""
    found = run(truss(step), tmp_path)
    w, sizes = -found["node/2/UY"], found["run/STEP"]
    slope = STIFFNESS * (2 - 6 * w + 3 * w**2)  # dP/dw
    direction = np.arctan(slope / slope[0])
    turn = np.abs(np.diff(direction))
    expected = sizes[1:-1] * np.clip(np.radians(6) / turn[:-1], 0.5, 2)
    for at in (1 - 1 / np.sqrt(3), 1 + 1 / np.sqrt(3)):
        limit = int(np.argmin(np.abs(w - at)))
        assert w[limit] == pytest.approx(at, rel=1e-6)
        assert sizes[limit + 2] == pytest.approx(expected[limit], rel=1e-5)


def test_goal_of_a_restart(tmp_path: Path) -> None:
    """A path that has come to its end stays there; one that is to go farther goes on."""
    text = """.NOE
 I 1
 I 2 X 10 0 0
.MCE
 I 1 BAR N 1 2 EA 1D3
""" + path(" FIX NOEUD 1 C 1 2 3\n FIX NOEUD 2 C 2 3\n CHA NOEUD 2 C 1 V 100 NF 1", ".PATH\n.FIN 1\n", 1.0)
    first = run(text, tmp_path, "first")
    again = run(text, tmp_path, "first", options=("--restart", "first"))
    assert again["run/LOAD_TIME"] == pytest.approx(first["run/LOAD_TIME"], abs=0)
    on = run(text.replace("TF 1.0", "TF 1.4"), tmp_path, "first", options=("--restart", "first"))
    assert on["run/LOAD_TIME"][-1] == pytest.approx(1.4, rel=1e-9)
    assert on["run/LOAD_TIME"][len(first.t) - 1] == pytest.approx(1.0, rel=1e-9)


def test_compressible_column(tmp_path: Path) -> None:
    """Reissner's column shortens and shears: P (1 + P/GA - P/EA) = pi^2 EI/(4 L^2). Order 4 of its load."""
    ea, ga = 1000.0, 400.0
    c = 1 / ga - 1 / ea
    exact = (np.sqrt(1 + 4 * c * EULER) - 1) / (2 * c) / EULER
    section = f"EA {ea!r} GA {ga!r} {ga!r} GJ 1D3 EI 1D3 1.5D3"
    errors = []
    for pieces in (2, 4, 8):
        points = critical_points(column(section, pieces, tmp_path, ".PATH", 1.3))
        assert [kind for kind, _ in points] == ["bifurcation", "bifurcation"][: len(points)]
        errors.append(abs(points[0][1] - exact))
    assert errors[-1] < 2e-5
    assert orders(errors)[-1] == pytest.approx(4, abs=0.3)


def test_redundant_constraints_are_no_directions(tmp_path: Path) -> None:
    """Two hinges clamp the column, with four constraints too many. Beside these only the parity of the number
    of directions was known: two of them counted as none."""
    line = Line(straight(LENGTH, (0, 1, 0)), 4)
    joints = " I 900 HINGE N 0 1 AXIS 1 0 0\n I 901 HINGE N 0 1 AXIS 0 1 0"
    loads = f" CHA NOEUD {line.last} C 2 V {-EULER!r} NF 1"
    section = "EA 1D7 GA 4D6 4D6 GJ 1D3 EI 1D3 1.5D3"
    text = deck([line], section, path(loads, ".PATH", 1.7), "BPR 1 AXIS2 1 0 0", joints)
    found = run(text, tmp_path)
    points = critical_points(found)
    assert [kind for kind, _ in points] == ["bifurcation", "bifurcation"]
    assert [load for _, load in points] == pytest.approx([1, 1.5], rel=1e-3)
    for load, unstable in zip(found["run/LOAD_TIME"], found["run/UNSTABLE"], strict=True):
        assert unstable == sum(load > at for _, at in points)


def test_branch(tmp_path: Path) -> None:
    """The bent column is Euler's elastica: with the end turned by 60 degrees, P = (2 K/pi)^2 of the critical
    load and the end 2 k L/K to the side. It is stable, and lies on the side that AMPLITUDE says."""
    k = np.sin(np.pi / 6)
    side = float(2 * k * LENGTH / ellipk(k * k))
    for sign in (1, -1):
        rest = f".PATH BRANCH 1 AMPLITUDE {0.05 * sign!r} NODE 33 C 3 V {sign * side!r}"
        found = column("EA 1D7 GA 4D6 4D6 GJ 1D3 EI 1D3 1.5D3", 16, tmp_path, rest)
        assert found["run/LOAD_TIME"][-1] == pytest.approx((2 * ellipk(k * k) / np.pi) ** 2, rel=2e-5)
        assert found["node/33/UZ"][-1] == pytest.approx(sign * side, rel=1e-7)
        assert found["run/UNSTABLE"][-1] == 0
        assert critical_points(found)[0][1] == pytest.approx(1, rel=2e-5)


def test_follower_force(tmp_path: Path) -> None:
    """Beck's column under a force that turns with its end has no second equilibrium: it flutters, and no
    static critical point is found up to four times the Euler load. The tangent is not symmetric."""
    line = Line(straight(LENGTH, (0, 1, 0)), 8)
    push = f" I 900 FORCE N {line.last} DIR 0 -1 0 V {EULER!r} NF 1 FOLLOW"
    section = "EA 1D7 GA 4D6 4D6 GJ 1D3 EI 1D3 1.5D3"
    text = deck([line], section, path(f" {clamp(1)}", ".PATH", 4.0), "BPR 1 AXIS2 1 0 0", push)
    found = run(text, tmp_path)
    assert critical_points(found) == []
    assert found["run/UNSTABLE"].max() == 0


@pytest.mark.parametrize("step", [0.3, 4.0])
@pytest.mark.parametrize("follower", ["", "FOLLOW"])
def test_a_strut_beside_a_follower_force(step: float, follower: str, tmp_path: Path) -> None:
    """A rigid strut of length 1 with a spring of 11 across its tip is pressed by 10 T. The force on
    another node makes the tangent unsymmetric, from behind the start on; the distance is a single constraint.
    Stability was told the wrong way round, and nothing was found in the first step."""
    loads = """ FIX NOEUD 1 C 1 2 3 4 5 6
 CHA NOEUD 2 C 2 V -10 NF 1
 CHA NOEUD 5 C 1 V 30 NF 1"""
    text = f""".NOE
 I 1 X 0 0 0
 I 2 X 0 1 0
 I 5 X 5 0 0
.MCE
 I 1 DISTANCE N 0 2 FROM 0 0 0
 I 2 SPRING N 0 2 K 11 1 9000
 I 4 BUSHING N 0 5 K 1D3 1D3 1D3 1D3 1D3 1D3
 I 6 FORCE N 5 DIR 0 1 0 V 1 {follower} NF 1
{path(loads, ".PATH STEPS 5", end=40, step=step)}
.FIN
"""
    found = run(text, tmp_path)
    assert critical_points(found)[0] == ("bifurcation", pytest.approx(1.1, rel=1e-6))
    assert (
        "bifurcation point at load time 1.1, stability is lost" in found.file.with_suffix(".lst").read_text()
    )
    behind = found["run/LOAD_TIME"] > 1.1
    assert behind.any()
    assert set(found["run/UNSTABLE"][~behind]) == {0}
    assert set(found["run/UNSTABLE"][behind]) == {1}


def test_lees_frame(tmp_path: Path) -> None:
    """Both limits of the force converge with order 4 to the published ones."""
    errors = []
    for pieces in (10, 20, 40):
        column = Line(straight(120, (0, 1, 0)), pieces)
        beam = Line(lambda u: np.array([120 * u, 120, 0]), pieces, first=column.last, element=101)
        nodes = "\n".join([column.text(), *beam.text().splitlines()[1:]])
        loaded = beam.ids[2 * pieces // 5]
        rest = path(f" CHA NOEUD {loaded} C 2 V -20000 NF 1", f".PATH NODE {loaded} C 2 V -80", 1.0)
        text = f""".NOE
{nodes}
.BPR
 I 1 EA 43.2D6 GA (43.2D6/2.6*5/6) (43.2D6/2.6*5/6) GJ 14.4D6 EI 14.4D6 14.4D6
.MCE
{column.beam()}
{beam.beam()}
 I 201 HINGE N 0 1 AXIS 0 0 1
 I 202 HINGE N 0 {beam.last} AXIS 0 0 1
{rest}
.FIN 1
""".replace("TYPE STATIC", "TYPE STATIC PLANE XY")
        points = critical_points(run(text, tmp_path))
        assert [kind for kind, _ in points] == ["limit", "limit"]
        errors.append(np.array([20000 * value for _, value in points]) - [18544.5271, -9392.4896])
    assert np.log2(errors[0] / errors[1]) == pytest.approx([4, 4], abs=0.1)
    assert (16 * errors[2] - errors[1]) / 15 == pytest.approx([0, 0], abs=3e-4)


def test_right_angle_frame(tmp_path: Path) -> None:
    """Two legs at a right angle, bent in their plane by moments at their ends, tip over (Argyris 1979;
    622.2080872 without what they bend before)."""
    length, depth, width, young, nu = 240.0, 30.0, 0.6, 71240.0, 0.31
    shear, s, pieces = young / 2 / (1 + nu), 0.5**0.5, 8
    area = depth * width
    left = Line(lambda u: np.array([(u - 1) * length * s, u * length * s, 0]), pieces)
    right = Line(lambda u: np.array([u * length * s, (1 - u) * length * s, 0]), pieces, first=100, element=51)
    apex = left.last
    right.ids[0] = apex
    loads = f""" FIX NOEUD 1 {right.last} C 2 3 4 5
 FIX NOEUD {apex} C 1
 CHA NOEUD 1 C 6 V 622.2080872 NF 1
 CHA NOEUD {right.last} C 6 V -622.2080872 NF 1"""
    nodes = "\n".join([left.text(), *right.text().splitlines()[1:]])
    text = f""".NOE
{nodes}
.BPR
 I 1 EA {young * area!r} GA {shear * area * 5 / 6!r} {shear * area * 5 / 6!r}
     GJ {shear * depth * width**3 / 3!r} EI {young * area * width**2 / 12!r} {young * area * depth**2 / 12!r}
.MCE
{left.beam(f"BPR 1 AXIS2 {-s!r} {s!r} 0")}
{right.beam(f"BPR 1 AXIS2 {s!r} {s!r} 0")}
{path(loads, ".PATH", 1.2)}
.BUCKLING MODES 2
.FIN 1
"""
    found = run(text, tmp_path)
    assert critical_points(found)[0] == ("bifurcation", pytest.approx(1, rel=6e-5))
    # the tangent changes linearly but for a thousandth
    assert found["run/BUCKLING_TIME_1"][-1] == pytest.approx(1, rel=1.2e-3)


def test_linearised(tmp_path: Path) -> None:
    """Euler loads of both planes, and the modes of a cantilever, 1 - cos(k x). Near a load the linearisation
    is the exact one."""
    section = "EA 1D5 GA 4D4 4D4 GJ 1D3 EI 1D3 1.5D3"
    found = column(section, 8, tmp_path, ".BUCKLING MODES 4", 0.5)
    times = [found[f"run/BUCKLING_TIME_{i}"][-1] for i in (1, 2, 3, 4)]
    assert times == pytest.approx([1, 1.5, 9, 13.5], rel=1e-2)
    with h5py.File(found.file) as file:
        assert file["modes/load_time"][()] == pytest.approx(times)
        shape = file["modes/mode_1"][()]
        turn = file["modes/rotation_1"][()]
    y = np.linspace(0, LENGTH, 17)
    k = np.pi / (2 * LENGTH)
    assert np.abs(shape[:, 2]) == pytest.approx(1 - np.cos(k * y), abs=1e-3)
    assert np.abs(turn[:, 0]) == pytest.approx(k * np.sin(k * y), abs=1e-3)
    assert np.abs(shape[:, :2]).max() < 1e-8
    exact = critical_points(column(section, 8, tmp_path, ".PATH", 1.2))[0][1]
    off = []
    for end in (0.5, 0.9):
        found = column(section, 8, tmp_path, ".BUCKLING MODES 1 BASE END", end)
        off.append(abs(found["run/BUCKLING_TIME_1"][-1] - exact))
    assert off[1] < 0.05 * off[0] + 1e-9


@pytest.mark.parametrize("load", [1, 100])
def test_only_modes_that_are(tmp_path: Path, load: float) -> None:
    """Two links on torsion springs buckle in two ways: k = [[k1 + k2, -k2], [-k2, k2]] against the lengths.
    Rounding made three more times, of 1e10 to 1e14."""
    lengths, stiff = (0.7, 0.6), (1000.0, 1130.0)
    x = [0.0, lengths[0], sum(lengths)]
    direction = (0.6, 0.8, 0.0)
    points = [" ".join(f"{v * s!r}" for v in direction) for s in x]
    force = "\n".join(f" CHA NOEUD 2 C {i + 1} V {-load * direction[i]!r} NF 1" for i in (0, 1))
    text = f""".NOE
 I 1 X {points[1]}
 I 2 X {points[2]}
.MCE
 I 1 HINGE N 0 1 AT {points[0]} AXIS 0 0 1 K {stiff[0]!r}
 I 2 HINGE N 1 2 AT {points[1]} AXIS 0 0 1 K {stiff[1]!r}
.CLM
{force}
.FCT
 I 1 TABLE 0 0 1 1
.SAM TYPE STATIC
.SUB TF 1 H 1
.BUCKLING MODES 5
.FIN 1
"""
    found = run(text, tmp_path)
    k = np.array([[stiff[0] + stiff[1], -stiff[1]], [-stiff[1], stiff[1]]])
    exact = np.sort(np.linalg.eigvals(k / np.array(lengths)[:, None]).real) / load
    with h5py.File(found.file) as file:
        assert file["modes/load_time"][()] == pytest.approx(exact, rel=1e-9)
    assert "5 were asked for; at no other load time" in found.file.with_suffix(".lst").read_text()


def test_lost_loads(tmp_path: Path) -> None:
    """Nothing that grows: an error that says so, not a path of nothing."""
    line = Line(straight(LENGTH, (0, 1, 0)), 2)
    loads = f" {clamp(1)}\n CHA NOEUD {line.last} C 2 V -1"
    for card in (".PATH", ".BUCKLING"):
        text = deck([line], "EA 1D5 GA 4D4 4D4 GJ 1D3 EI 1D3 1D3", path(loads, card), "BPR 1 AXIS2 1 0 0")
        found = run(text, tmp_path, status=2)
        partial = found.file.with_suffix(".lst").read_text()
        assert "nothing moves when time grows" in partial


def test_ranks(tmp_path: Path) -> None:
    """Critical points on 1 and 2 ranks."""
    text = (Path(__file__).parents[2] / "decks" / "mechanisms" / "portal_frame.dat").read_text()
    one = critical_points(run(text, tmp_path, "one"))
    two = critical_points(run(text, tmp_path, "two", ranks=2))
    assert [kind for kind, _ in one] == ["bifurcation", "limit"] == [kind for kind, _ in two]
    assert [v for _, v in two] == pytest.approx([v for _, v in one], rel=1e-7)


@pytest.mark.parametrize(
    ("formula", "end"), [("sqrt(T)", 4), ("sin(T)", 1.5), ("T+T**3", 2), ("1-exp(-3*T)", 1.5)]
)
def test_loads_that_are_not_linear_in_time(formula: str, end: float, tmp_path: Path) -> None:
    """A spring on one node stands in the plane of the path after one iteration, while its load does not fit
    yet: states were out of balance by up to 40 per cent."""
    text = f""".NOE
 I 1
.MCE
 I 1 SPRING N 0 1 K 1D3 1D3 1D3
.CLM
 FIX NOEUD 1 C 1 3
 CHA NOEUD 1 C 2 V 100. NF 1
.FCT
 I 1 EXPR "{formula}"
.SAM TYPE STATIC
.SUB TF {end} H 0.05
.PATH STEPS 12
.FIN 1
"""
    found = run(text, tmp_path)
    load = found["element/2/FORCE_Y"]
    assert np.abs(load + found["run/GROUND_FORCE_Y"]).max() < 1e-8 * np.abs(load).max()
    assert found["node/1/UY"] == pytest.approx(load / 1e3, abs=1e-9)
