# SPDX-License-Identifier: BSD-3-Clause
"""Channels that are functions of time and of other channels, at instants within controlled steps: gaps
between two stops, forces by functions of time, coordinates of drives."""

from pathlib import Path

import numpy as np
import pytest
from runs import solve

# x = 0.04 sin 10 t, and no stop is touched
OSCILLATOR = """
.NOE
 I 1 X 1 0 0
.MCE
 I 1 INERTIA N 1 M 1
 I 2 PRISMATIC N 0 1 AXIS 1 0 0 K 100 {joint}
 I 3 STOP N 0 1 MIN 0.95 MAX 1.05 K 1D4
.INI
 VIT NOEUD 1 C 1 V 0.4
.SAM TYPE DYNAMIC {sam}
.SUB TF 5 H 0.01 {sub}
{more}
.FIN
"""

# theta = 0.5 sin 10 t
PENDULUM = """
.NOE
 I 1 X 0 0 0
.MCE
 I 1 INERTIA N 1 M 1 J 1 1 1
 I 2 HINGE N 0 1 AXIS 0 0 1 K 100 MIN -40 MAX 35 KSTOP 2D4
 I 3 STOP N 0 1 AXIS 0 0 1 MIN -50 MAX 50 K 1D4
.INI
 VIT NOEUD 1 C 6 V 5
.SAM TYPE DYNAMIC {sam}
.SUB TF 2 H 0.01 TOL 1D-5
.FIN
"""

# a belt whose spans go slack by turns
BELT = """
.NOE
 I 2 X 0 0 0
 I 3 X 0.2 0 0
.MCE
 I 2 INERTIA N 2 M 0.4 J 6D-4
 I 3 INERTIA N 3 M 0.9 J 1.5D-3
 I 4 HINGE N 0 2 AXIS 0 0 1
 I 5 HINGE N 0 3 AXIS 0 0 1
 I 6 BELT N 2 3 AXIS 0 0 1 R 0.03 0.05 EA 2000 PRELOAD 20 C 1
.INI
 VIT ELEMENT 4 V 20
.SUB TF 0.5 H 0.0025
"""

# a force of 5 Hz, sampled at its zeros, beside a slow one
SAMPLED = """
.NOE
 I 1 X 0 0 0
.MCE
 I 1 INERTIA N 1 M 1
 I 2 PRISMATIC N 0 1 AXIS 1 0 0 K 4 C 0.4
 I 3 {load}
 I 4 FORCE N 1 DIR 1 0 0 V 4 NF 2
.FCT
 I 1 SINUS 1 5 0 0
 I 2 SINUS 1 0.3
.SAM TYPE DYNAMIC ACCURACY FAST
.SUB TF 10 H {h}
.FIN
"""


def two_stops(sam: str = "", sub: str = "", more: str = "") -> str:
    return OSCILLATOR.format(joint="MIN -0.05 MAX 0.06 KSTOP 2D4", sam=sam, sub=sub, more=more)


@pytest.mark.parametrize("sam", ["", "SCHEME RADAU"])
def test_a_gap_between_two_stops_has_a_corner_between_them(sam: str, tmp_path: Path) -> None:
    _, found = solve(two_stops(sam=sam, sub="TOL 1D-5"), tmp_path)
    slide, length = found["2/SLIDE"], found["3/LENGTH"]
    np.testing.assert_allclose(found["2/SLIDE_GAP"], np.minimum(slide + 0.05, 0.06 - slide), atol=1e-15)
    np.testing.assert_allclose(found["3/GAP"], np.minimum(length - 0.95, 1.05 - length), atol=1e-15)


@pytest.mark.parametrize("sam", ["", "SCHEME RADAU"])
def test_so_has_that_of_an_angle(sam: str, tmp_path: Path) -> None:
    _, found = solve(PENDULUM.format(sam=sam), tmp_path)
    for angle, gap, lower, upper in (("2/ANGLE", "2/STOP_GAP", -40, 35), ("3/ANGLE", "3/GAP", -50, 50)):
        exact = np.minimum(found[angle] - np.radians(lower), np.radians(upper) - found[angle])
        np.testing.assert_allclose(found[gap], exact, atol=1e-14)


def test_a_gap_does_not_depend_on_what_else_is_kept(tmp_path: Path) -> None:
    _, whole = solve(two_stops(sub="TOL 1D-5"), tmp_path, "whole")
    _, alone = solve(two_stops(sub="TOL 1D-5", more='.SAI CHANNEL "SLIDE_GAP" "GAP"'), tmp_path, "alone")
    for gap in ("2/SLIDE_GAP", "3/GAP"):
        np.testing.assert_array_equal(alone[gap], whole[gap])


def test_a_restart_goes_on_with_the_same_gaps(tmp_path: Path) -> None:
    deck = two_stops(sub="TOL 1D-5")
    _, whole = solve(deck, tmp_path, "whole")
    solve(deck, tmp_path, "first", "--until", "1.234", status=2)
    _, rest = solve(deck, tmp_path, "rest", "--restart", str(tmp_path / "first"))
    again = rest.t > 1.4
    at = np.searchsorted(whole.t, rest.t[again] - 1e-9)
    np.testing.assert_allclose(rest["2/SLIDE_GAP"][again], whole["2/SLIDE_GAP"][at], rtol=0, atol=1e-7)


def test_gaps_do_not_repeat_a_run(tmp_path: Path) -> None:
    """FINE repeated such a run three times and then warned, though a run with one stop needed no repeat."""
    found, result = solve(two_stops("ACCURACY FINE"), tmp_path)
    assert "again" not in found["said"] and found["accuracy"]["estimated_error"] < 1e-5
    x = 0.04 * np.sin(10 * result.t)
    exact = np.minimum(x + 0.05, 0.06 - x)
    off = np.sqrt(np.mean((result["2/SLIDE_GAP"] - exact) ** 2)) / np.ptp(exact)
    assert off < 1e-5


@pytest.mark.parametrize("load", ["FORCE N 1 DIR 1 0 0 V 100 NF 1", "FORCE N 0 1 AT -10 0 0 V 100 NF 1"])
def test_forces_sampled_at_their_zeros_do_not_repeat_a_run(load: str, tmp_path: Path) -> None:
    found, result = solve(SAMPLED.format(load=load, h=0.1), tmp_path)
    assert "again" not in found["said"]
    assert np.abs(result["3/FORCE"]).max() < 1e-11
    assert np.abs(result["3/POWER"]).max() < 1e-9


def test_forces_by_functions_are_those_of_their_functions(tmp_path: Path) -> None:
    _, result = solve(SAMPLED.format(load="FORCE N 1 DIR 1 0 0 V 100 NF 1", h=0.013), tmp_path)
    force = 100 * np.sin(2 * np.pi * 5 * result.t)
    np.testing.assert_allclose(result["3/FORCE"], force, atol=1e-10)
    np.testing.assert_allclose(result["3/POWER"], force * result["3/SPEED"], atol=1e-10)


@pytest.mark.parametrize("drive", ["ANGLE", "SPEED"])
def test_coordinates_of_drives_are_those_of_their_functions(drive: str, tmp_path: Path) -> None:
    deck = f"""
.NOE
 I 1 X 1 0 0
.MCE
 I 1 INERTIA N 1 M 1 J 1 1 1
 I 2 HINGE N 0 1 AXIS 0 0 1 DRIVE {drive} NF 1
 I 3 TORQUE N 1 AXIS 0 0 1 V 2 NF 1
.FCT
 I 1 SINUS 0.3 5 0 0
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.013 TOL 2D-3
.FIN
"""
    _, result = solve(deck, tmp_path)
    w = 2 * np.pi * 5
    angle = np.sin(w * result.t) if drive == "ANGLE" else (1 - np.cos(w * result.t)) / w
    np.testing.assert_allclose(result["2/ANGLE"], 0.3 * angle, atol=1e-12)
    np.testing.assert_allclose(result["3/TORQUE"], 0.6 * np.sin(w * result.t), atol=1e-12)


def test_the_tight_side_of_a_belt_is_the_larger_tension(tmp_path: Path) -> None:
    """It was 2 N off where the sides change, by 40 % of the difference."""
    _, result = solve(f"{BELT}.SAM TYPE DYNAMIC ACCURACY FAST\n.FIN\n", tmp_path)
    tensions = [result["6/TENSION_1"], result["6/TENSION_2"]]
    assert np.any(np.diff(np.sign(tensions[0] - tensions[1])) != 0)
    np.testing.assert_array_equal(result["6/TIGHT_SIDE"], np.maximum(*tensions))
    np.testing.assert_array_equal(result["6/SLACK_SIDE"], np.minimum(*tensions))


@pytest.mark.parametrize(
    ("driven", "support"),
    [("I 1 PRISMATIC N 0 1 AXIS 1 0 0 DRIVE SPEED NF 1", ""), ("", " DEP NOEUD 1 C 1 V 1 NF 2")],
)
def test_an_imposed_acceleration_that_jumps(driven: str, support: str, tmp_path: Path) -> None:
    """The step before the jump ends with the acceleration before it: with the one behind, that of instants
    within the step was off by a third, and the dial took a run of 500 steps for chaotic."""
    _, found = solve(
        f""".NOE
 I 1
 I 2 X 1
.MCE
 {driven}
 I 2 SPRING N 1 2 K 1D5 C 100
 I 3 INERTIA N 1 M 1 J 1
 I 4 INERTIA N 2 M 2
.FCT
 I 1 EXPR "min(2, 200*T)"
 I 2 EXPR "if(T < 0.01, 100*T**2, 2*T - 0.01)"
.CLM
{support}
 FIX NOEUD 1 2 C 2 3
 FIX NOEUD 1 C 4 5 6
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 0.05 H 1D-4 TOL 1D-5
.FIN
""",
        tmp_path,
    )
    aside = np.abs(found.t - 0.01) > 1e-9
    expected = np.where(found.t < 0.01, 200, 0)
    assert np.abs(found["node/1/AX"] - expected)[aside].max() < 1e-5


# a pendulum on a slider that shakes fast: the force in its hinge passes close to zero
SHAKEN = """.NOE
 I 1 X 0 0 0
 I 2 X 0.02 0 0.5
.MCE
 I 1 PRISMATIC N 0 1 AXIS 0 0 1 DRIVE SLIDE NF 1
 I 2 {joint} N 1 2 {axis} AT 0 0 0
 I 3 INERTIA N 2 M 1 J 0.001
 I 4 INERTIA N 1 M 0.1 J 0.001
.FCT
 I 1 EXPR "0.02*SIN(400*T)"
.CLM
 STRU ACC 0 0 -9.81
{more}
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 2 H 0.01 TOL 5E-4
.FIN
"""


@pytest.mark.parametrize(
    ("joint", "axis", "size"), [("HINGE", "AXIS 0 1 0", "RADIAL_FORCE"), ("SPHERICAL", "", "FORCE_SIZE")]
)
def test_sizes_of_forces_are_those_of_their_components(
    joint: str, axis: str, size: str, tmp_path: Path
) -> None:
    """Their squares were interpolated: close to zero the size was off by a hundredth of the largest force."""
    deck = SHAKEN.format(joint=joint, axis=axis, more="")
    _, whole = solve(deck, tmp_path, "whole")
    components = np.array([whole[f"2/FORCE_{c}"] for c in "XYZ"])
    np.testing.assert_allclose(whole[f"2/{size}"], np.linalg.norm(components, axis=0), atol=1e-3)
    assert whole[f"2/{size}"].min() < 0.03 * whole[f"2/{size}"].max()
    alone_deck = SHAKEN.format(joint=joint, axis=axis, more=f'.SAI CHANNEL "{size}"')
    _, alone = solve(alone_deck, tmp_path, "alone")
    np.testing.assert_array_equal(alone[f"2/{size}"], whole[f"2/{size}"])
