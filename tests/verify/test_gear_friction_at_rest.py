# SPDX-License-Identifier: BSD-3-Clause
"""STICK of gears: self-locking worms, a hoist, and wheels that profile friction stops."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import run
from scipy.integrate import solve_ivp

WORM = """
.NOE
 I 1
 I 2 X 0 0.063100219993073609 0
.FCT
 I 1 {function}
.MCE
 I 1 HINGE N 0 1 AXIS 1 0 0 C {damper}
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 KIND WORM STARTS 2 Z 40 MN 0.002 LAMBDA 5 AXIS 1 0 0 AXISB 0 0 1 FRICTION CONST 0.12 STICK
 I 4 INERTIA N 1 J 1D-5
 I 5 INERTIA N 2 J 1D-3
 I 6 TORQUE N 2 AXIS 0 0 1 V 20
 I 7 TORQUE N 1 AXIS 1 0 0 V 1 NF 1
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF {end} H {h}
.FIN 1
"""


def test_a_self_locking_worm_holds(tmp_path: Path) -> None:
    result = run(WORM.format(function='EXPR "0"', damper=0, end=100, h=0.02), tmp_path)
    assert np.ptp(result["node/2/RZ"]) < 1e-15
    assert np.abs(result["node/2/WZ"]).max() < 1e-15


TEETH, MODULE, ALPHA = np.array([20, 40]), 0.002, np.radians(20)


def pairs_of_flanks(turn: float) -> list[tuple[float, float, float]]:
    """Places along the line of action from the pitch point, and shares of the load, of the pairs of flanks in
    contact: front flanks of wheels with addendum m, which share the load equally
    (docs/elements/gears/gear_pair.md); with the sense in which they slide."""
    radii = TEETH * MODULE / 2
    tips = np.sqrt((radii + MODULE) ** 2 - (radii * np.cos(ALPHA)) ** 2) - radii * np.sin(ALPHA)
    low, high, pitch = -tips[1], tips[0], np.pi * MODULE * np.cos(ALPHA)
    edge = min(0.05 * (high - low), 0.5 * (high - low - pitch))

    def inside(x: float) -> float:
        t = np.clip(x / edge + 0.5, 0, 1)
        return t**3 * (10 + t * (6 * t - 15))

    first = np.ceil((low - edge) / pitch - TEETH[0] * turn / (2 * np.pi) - 0.25)
    places = pitch * (TEETH[0] * turn / (2 * np.pi) + 0.25 + first + np.arange(4))
    there = [(place, inside(place - low) * inside(high - place)) for place in places]
    shared = []
    for i, (place, part) in enumerate(there):
        others = [other for j, (_, other) in enumerate(there) if j != i and other > 0]
        share = 0.0
        for present in np.ndindex(*[2] * len(others)):
            weight = np.prod([o if p else 1 - o for o, p in zip(others, present, strict=True)])
            share += weight / (1 + sum(present))
        shared.append((place, part * share))
    at_pitch_point = lambda x: 2 * inside(x) - 1  # noqa: E731
    return [(place, share, at_pitch_point(place)) for place, share in shared if share > 0]


def test_gears_stop_by_the_friction_of_their_flanks(tmp_path: Path) -> None:
    """Loaded wheels in balance but for friction, which stops them, against both equations of motion with the
    friction of each pair of flanks; then it holds them."""
    deck = """
.NOE
 I 1
 I 2 X 0.06 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 Z 20 40 MN 0.002 AXIS 0 0 1 FRICTION CONST 0.1 SLIDING PROFILE STICK
 I 4 INERTIA N 1 J 1D-4
 I 5 INERTIA N 2 J 1D-3
 I 6 TORQUE N 1 AXIS 0 0 1 V 10
 I 7 TORQUE N 2 AXIS 0 0 1 V 20.1
.INI
 VIT NOEUD 1 C 6 V 20
 VIT NOEUD 2 C 6 V -10
.SAM TYPE DYNAMIC RHO 0.9 PREC 1E-11
.SUB TF 0.08 H {h}
.FIN 1
"""
    radii = TEETH * MODULE / 2
    base, lever = radii * np.cos(ALPHA), radii * np.sin(ALPHA)

    def slows(_, s):
        on_a = on_b = 0.0
        for place, share, sense in pairs_of_flanks(s[0]):
            on_a += 0.1 * share * sense * (lever[0] + place)
            on_b += 0.1 * share * sense * (lever[1] - place)
        # J_A a = 10 - (r_bA + on_a) N,  J_B a/2 = -20.1 + (r_bB + on_b) N
        matrix = [[1e-4, base[0] + on_a], [0.5e-3, -(base[1] + on_b)]]
        return [s[1], np.linalg.solve(matrix, [10, -20.1])[0]]

    stops = lambda _, s: s[1]  # noqa: E731
    stops.terminal = True
    exact = solve_ivp(
        slows, (0, 1), [0, 20], events=stops, rtol=1e-11, atol=1e-13, dense_output=True, max_step=1e-4
    )
    stop = exact.t[-1]
    assert 0.02 < stop < 0.07
    assert exact.y[0, -1] > 2 * np.pi / TEETH[0]
    errors = []
    for h in (2e-4, 1e-4):
        result = run(deck.format(h=h), tmp_path)
        expected = np.array([exact.sol(min(t, stop))[0] for t in result.t])
        errors.append(np.abs(result["1/ANGLE"] - expected).max())
        rest = result.t > stop + h
        assert np.ptp(result["1/ANGLE"][rest]) < 1e-12  # what joints may leave open
    assert errors[1] < 1e-5
    assert np.log2(errors[0] / errors[1]) > 1.9


def test_a_hoist_stops_and_starts(tmp_path: Path) -> None:
    """A torque lifts the load, leaves it to the worm, and lifts it again."""
    deck = WORM.format(function='EXPR "if(T < 1, -2.5, if(T < 2, 0, -2.5))"', damper=0.02, end=3, h=0.01)
    result = run(deck, tmp_path)
    t, turned = result.t, result["node/2/RZ"]
    rest = (t > 1.5) & (t < 2)
    assert np.ptp(turned[rest]) < 1e-14
    lifted = turned[t <= 1][-1] - turned[0]
    assert abs(lifted) > 0.1
    again = turned[-1] - turned[rest][-1]
    assert again == pytest.approx(lifted, rel=1e-2)


DRIVEN = """.UNIT LENGTH 0.001 MASS 1000 TIME 1
.NOE
 I 1 X 0 0 0
 I 2 X 120 0 0
.MCE
 I 1 GEAR N 1 2 KIND SPUR Z 20 60 MN 3 AXIS 0 0 1 {teeth} FRICTION CONST 0.06 SLIDING PROFILE {friction}
 I 2 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 3 HINGE N 0 2 AXIS 0 0 1
 I 4 TORQUE N 2 AXIS 0 0 1 V {load}
 I 5 INERTIA N 2 M 0.003 J 5
 I 6 INERTIA N 1 M 0.001 J 0.2
.FCT
 I 1 {function}
.SAM TYPE DYNAMIC {start}
.SUB TF 0.1 H 2E-4
.FIN 1
"""
GENTLE, DWELL = "STEP 0 0 0.05 50", "TABLE 0 0 0.02 0 0.07 50"


@pytest.mark.parametrize(
    ("teeth", "start", "load", "function"),
    [
        ("", "START STATIC", "1E5", GENTLE),
        ("KM 4E5 CM 30", "", "1E5", GENTLE),
        ("KM 4E5 CM 30", "", "5E4", GENTLE),
        ("", "START STATIC", "1E5", DWELL),
    ],
)
def test_a_drive_that_begins_gently(tmp_path: Path, teeth: str, start: str, load: str, function: str) -> None:
    """At rest the teeth hold what the drive holds, too, and their shares of the load mean nothing. They slide
    as the drive turns them; afterwards friction is that of sliding speeds (VREG)."""
    words = {"teeth": teeth, "start": start, "load": load, "function": function}
    sticking = run(DRIVEN.format(friction="", **words), tmp_path)
    smooth = run(DRIVEN.format(friction="VREG 1E-3", **words), tmp_path, name="smooth")
    t = np.linspace(0.03, 0.1, 351)
    torques = [np.interp(t, r.t, r["2/DRIVE_TORQUE"]) for r in (sticking, smooth)]
    assert np.abs(torques[0] - torques[1]).max() < 1e-2 * np.abs(torques[1]).max()
    assert np.abs(sticking["2/DRIVE_TORQUE"]).max() < 1.2 * np.abs(smooth["2/DRIVE_TORQUE"]).max()


PAIR = """.NOE
 I 1
 I 2{place_b}
 I 8
.MCE
 I 1 GEAR N 1 2 {gear}
 I 2 HINGE N 8 1 AXIS {axis_a}
 I 8 BUSHING N 0 8 K 2E5 2E5 2E5 5E7 5E7 5E7 C {damping}
 I 9 INERTIA N 8 M 1E-4 J 0.2
 I 3 HINGE N 0 2 AXIS {axis_b} C 30
 I 6 INERTIA N 1 M 1E-3 J 0.2
 I 7 INERTIA N 2 M 2E-3 J 0.9
 I 10 TORQUE N 1 AXIS {axis_a} V 15000 NF 1
.FCT
 I 1 EXPR "{function}"
.SAM TYPE DYNAMIC
.SUB TF {end} H 2E-5
.FIN
"""
SPUR = {
    "gear": "AXIS 0 0 1 KIND SPUR Z 20 33 MN 2 SLIDING PROFILE FRICTION CONST 0.01",
    "place_b": " X 53 0 0",
    "axis_a": "0 0 1",
    "axis_b": "0 0 1",
    "damping": "5 5 5 500 500 500",
    "function": "cos(2*PI*60*T)",
    "end": 0.02,
}
HYPOID = {
    "gear": "AXIS 1 0 0 KIND HYPOID Z 11 43 HELIX 50 -31.5 DIAMETER 170 RINGCONE 70 PLACE 0 1 0 "
    "FRICTION CONST 0.05",
    "place_b": "",
    "axis_a": "1 0 0",
    "axis_b": "0 0.9940937655242903 0.10852458406157171",
    "damping": "0 0 0 0 0 0",
    "function": "cos(2*PI*60*T)",
    "end": 0.002,
}


UNLOADED = {
    **SPUR,
    "gear": "AXIS 0 0 1 Z 20 33 MN 2 HELIX 20 SLIDING PROFILE KM 1E5 CM 20 FRICTION CONST 0.01",
    "place_b": f" X {53 / np.cos(np.radians(20)):.16g} 0 0",
    "function": "sin(2*PI*60*T)",
    "end": 0.01,
}


@pytest.mark.parametrize(
    "pair", [SPUR, HYPOID, UNLOADED], ids=["spur", "hypoid", "helical, unloaded at first"]
)
def test_wheels_that_hardly_any_friction_holds(tmp_path: Path, pair: dict) -> None:
    """Flanks that begin to move, or turn back, slide at once. Held by profile friction, rigid or unloaded
    ones would push in a direction that no forces balance; those of a hypoid on a bearing slide with the force
    that would hold them."""
    sticking = run(PAIR.format(**pair), tmp_path)
    smooth = run(PAIR.format(**{**pair, "gear": pair["gear"] + " VREG 0.1"}), tmp_path, name="smooth")
    for channel in ("2/SPEED", "3/SPEED"):
        difference = np.interp(sticking.t, smooth.t, smooth[channel]) - sticking[channel]
        assert np.abs(difference).max() < 5e-4 * np.abs(sticking[channel]).max()
