# SPDX-License-Identifier: BSD-3-Clause
"""Laws of springs and dampers with corners, against closed forms, and an error of gears over their angle:
dynamics ends steps there."""

from __future__ import annotations

import re

import numpy as np
import pytest
from runs import run
from scipy.integrate import solve_ivp

TABLE = "I 1 TABLE -1.1 -50  -0.1 0  0.1 0  1.1 50"
FORMULA = 'I 1 EXPR "50*(max(0, X - 0.1) + min(0, X + 0.1))"'
MODELS = {
    "spring": (
        ".NOE\n I 1 X 3 0 0",
        "SPRING N 0 1 LAW TABLE 1 AT 1 0 0",
        "M 2",
        "FIX NOEUD 1 C 2 3",
        1,
        "node/1/UX",
    ),
    "torsion spring": (
        ".NOE\n I 1 X 0 0 0",
        "TSPRING N 0 1 AXIS 0 0 1 LAW TABLE 1",
        "M 1 J 1 1 2",
        "FIX NOEUD 1 C 1 2 3 4 5",
        6,
        "element/1/ANGLE",
    ),
    "hinge": (
        ".NOE\n I 1 X 0 0 0",
        "HINGE N 0 1 AXIS 0 0 1 LAW TABLE 1",
        "M 1 J 1 1 2",
        "",
        6,
        "element/1/ANGLE",
    ),
}


def loose(t: np.ndarray) -> np.ndarray:
    """An oscillator of 2 on a spring of 50 that is loose over 0.1 either way, thrown from the middle at 1."""
    half = np.pi / 5
    t = np.mod(t, 2 * (0.2 + half))
    back = np.where(t > 0.1 + 0.1 + half, -1.0, 1.0)
    t = np.where(back < 0, t - 0.2 - half, t)
    swing = np.where(t < 0.1 + half, 0.1 + 0.2 * np.sin(5 * (t - 0.1)), 0.2 + half - t)
    return back * np.where(t < 0.1, t, swing)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(
    ("law", "says"),
    [
        (TABLE, ("LAW passes its corner at 0.1 upwards", "LAW passes its corner at -0.1 downwards")),
        (
            FORMULA,
            (
                "LAW passes the corner of max, first operand smaller",
                "LAW passes the corner of min, first operand larger",
            ),
        ),
        (FORMULA.replace("X ", "D "), ("LAW passes the corner of max, first operand smaller",)),
    ],
    ids=["table", "formula", "law"],
)
@pytest.mark.parametrize(
    ("sam", "sub", "most"),
    [
        ("SCHEME RADAU", "H 0.1 TOL 1E-6", 1e-6),  # 2.2e-4 with steps across the corners
        ("SCHEME CHUNG RHO 1", "H 0.1 TOL 1E-5", 1e-3),
        ("SCHEME CHUNG RHO 1", "H 0.0025", 5e-4),
    ],
)
def test_a_spring_with_play(tmp_path, model, law, says, sam, sub, most):
    nodes, spring, mass, support, component, channel = MODELS[model]
    if " D " in law:
        spring = spring.replace("TABLE", "EXPR")
    text = f"""{nodes}
.MCE
 I 1 {spring}
 I 2 INERTIA N 1 {mass}
.CLM
 {support}
.FCT
 {law}
.INI
 VIT NOEUD 1 C {component} V 1
.SAM TYPE DYNAMIC {sam}
.SUB TF 8 {sub}
.FIN 1
"""
    result = run(text, tmp_path)
    assert np.max(np.abs(result[channel] - loose(result.t))) <= most * 0.3
    listing = result.file.with_suffix(".lst").read_text()
    assert all(words in listing for words in says)


@pytest.mark.parametrize("element", ["SPRING N 0 1 CLAW 1", "PRISMATIC N 0 1 AXIS 1 0 0 CLAW 1"])
def test_a_damper_that_yields(tmp_path, element):
    """v' = -g(v), g = 10 v up to 1 and 10 + 2 (v - 1) beyond: from 3 it is 7 exp(-2 t) - 4 down to 1, then
    exp(-10 (t - t1))."""
    text = f""".NOE
 I 1 X 3 0 0
.MCE
 I 1 {element}
 I 2 INERTIA N 1 M 1 J 1 1 1
.CLM
 FIX NOEUD 1 C 2 3 4 5 6
.FCT
 I 1 TABLE -6 -20  -1 -10  1 10  6 20
.INI
 VIT NOEUD 1 C 1 V 3
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 1 H 0.05 TOL 1E-6
.FIN 1
"""
    if element.startswith("PRISMATIC"):
        text = text.replace(" FIX NOEUD 1 C 2 3 4 5 6\n", "")
    result = run(text, tmp_path)
    corner = np.log(7 / 5) / 2
    speed = np.where(result.t < corner, 7 * np.exp(-2 * result.t) - 4, np.exp(-10 * (result.t - corner)))
    assert np.max(np.abs(result["node/1/VX"] - speed)) <= 1e-5
    assert "CLAW passes its corner at 1 downwards" in result.file.with_suffix(".lst").read_text()


def by_phases(slope, corner, start, times: np.ndarray) -> np.ndarray:
    """y' = slope(y, side), where `side` of corner(y) changes at its zeros: one phase after another."""
    y, t, rows = np.array(start, dtype=float), 0.0, []
    ahead = corner(y + 1e-9 * slope(y, np.sign(corner(y))))
    side = np.sign(ahead)
    while True:
        stop = lambda _t, y: corner(y)  # noqa: E731
        stop.terminal, stop.direction = True, -side
        found = solve_ivp(
            lambda _t, y, side=side: slope(y, side), (t, times[-1]), y, "DOP853", dense_output=True,
            events=stop, rtol=1e-12, atol=1e-14,
        )  # fmt: skip
        here = times[(times >= t) & (times <= found.t[-1])]
        rows += [found.sol(here).T[: len(here) - (found.status == 1 and here[-1] == found.t[-1])]]
        if found.status == 0:
            return np.concatenate(rows)
        y, t, side = found.y[:, -1], found.t[-1], -side


def test_a_rotor_passes_the_teeth_of_a_table_that_repeats(tmp_path):
    """A torque from -5 to 5 and back in every 0.4 rad, and an inertia of 2."""
    text = """.NOE
 I 1 X 0 0 0
.MCE
 I 1 TSPRING N 0 1 AXIS 0 0 1 LAW TABLE 1
 I 2 INERTIA N 1 M 1 J 1 1 2
.CLM
 FIX NOEUD 1 C 1 2 3 4 5
.FCT
 I 1 TABLE 0 -5  0.2 5  0.4 -5 PERIOD 0.4
.INI
 VIT NOEUD 1 C 6 V 1
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 3 H 0.05 TOL 1E-6
.FIN 1
"""
    result = run(text, tmp_path)

    def slope(y, side):
        middle = 0.1 if side > 0 else 0.3  # of a line of the table
        return np.array([y[1], -side * 50 * (np.remainder(y[0] - middle + 0.2, 0.4) - 0.2) / 2])

    true = by_phases(slope, lambda y: np.sin(np.pi * y[0] / 0.2), [0.0, 1.0], result.t)
    assert np.max(np.abs(result["element/1/ANGLE"] - true[:, 0])) <= 1e-6 * np.ptp(true[:, 0])
    listing = result.file.with_suffix(".lst").read_text()
    assert "LAW passes its corner at 0.2 or periods of 0.4 from it" in listing


def test_a_damper_with_two_strokes(tmp_path):
    """A mass of 1 on a spring of 100, damped by 4 outwards and 1 inwards: sides change where it turns."""
    text = """.NOE
 I 1 X 3 0 0
.MCE
 I 1 SPRING N 0 1 LAW EXPR 1 AT 1 0 0
 I 2 INERTIA N 1 M 1
.CLM
 FIX NOEUD 1 C 2 3
.FCT
 I 1 EXPR "100*D + IF(V > 0, 4*V, V)"
.INI
 VIT NOEUD 1 C 1 V 1
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 3 H 0.05 TOL 1E-6
.FIN 1
"""
    result = run(text, tmp_path)
    true = by_phases(
        lambda y, side: np.array([y[1], -100 * y[0] - (4 if side > 0 else 1) * y[1]]),
        lambda y: y[1],
        [0.0, 1.0],
        result.t,
    )
    assert np.max(np.abs(result["node/1/UX"] - true[:, 0])) <= 1e-6 * np.ptp(true[:, 0])
    assert "LAW passes the corner of >, first operand smaller" in result.file.with_suffix(".lst").read_text()


def test_a_measured_curve_has_no_corners(tmp_path):
    """More than 20: a smooth curve in many pieces."""
    points = "\n ".join(f"{x:.2f} {50 * x**3:.6f}" for x in np.linspace(-1.1, 1.1, 30))
    for table in (f"I 1 TABLE {points}", f"I 1 TABLE {points} PERIOD 3"):
        text = f""".NOE
 I 1 X 3 0 0
.MCE
 I 1 SPRING N 0 1 LAW TABLE 1 AT 1 0 0
 I 2 INERTIA N 1 M 2
.CLM
 FIX NOEUD 1 C 2 3
.FCT
 {table}
.INI
 VIT NOEUD 1 C 1 V 1
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 1 H 0.1 TOL 1E-4
.FIN 1
"""
        assert "corner" not in run(text, tmp_path).file.with_suffix(".lst").read_text()


def test_wheels_pass_the_corners_of_a_table_in_each_turn(tmp_path):
    """Wheel A turns to 936 degrees and back to -100; the steps end at 0, 90 and 200 degrees of each turn."""
    text = """.NOE
 I 1
 I 2 X 0.06
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 AXIS 0 0 1 Z 21 39 MN 0.002 WIDTH 0.02 KM 1E8 CM 1000 PITCHA 2
 I 4 INERTIA N 2 J 1E-3
.FCT
 I 1 EXPR "(936*PI/180)*COS(T)"
 I 2 TABLE 0 0  90 5E-6  200 -2E-6 PERIOD 360
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 3.2486 H 0.01
.FIN
"""
    run(text, tmp_path)
    said = (tmp_path / "deck.lst").read_text(encoding="utf-8")
    found = [float(t) for t in re.findall(r"t = (\S+) +GEAR 3: PITCHA passes its corner", said)]
    up = [90, 200, 360, 450, 560, 720, 810, 920]
    there = np.arcsin(np.array(up) / 936)
    assert np.allclose(found, [*there, *(np.pi - there[::-1]), np.pi], rtol=0, atol=1e-4)  # H/100
