# SPDX-License-Identifier: BSD-3-Clause
"""Decks whose results are known, with steps that follow their error: from TOL 1e-3 to 1e-10 each run ends
well, and its error falls with TOL."""

import re
from pathlib import Path

import numpy as np
import pytest
from runs import Run, run

DECKS = Path(__file__).resolve().parents[2] / "decks"
DECADES = range(3, 11)


def controlled(deck: str, tolerance: str, words: str = "SCHEME RADAU", archive: str = "") -> str:
    """The deck with other steps, and without its checks."""
    text = (DECKS / f"{deck}.dat").read_text(encoding="utf-8")
    text = re.sub(r"(?m)^\.CHK.*\n(?:[ !].*\n)*", "", text)
    text = re.sub(r"(?m)^\.SAM TYPE DYNAMIC.*", f".SAM TYPE DYNAMIC SOLVER KLU {words}", text)
    return re.sub(r"(?m)^(\.SUB TF \S+ H \S+).*", rf"{archive}\1 {tolerance}", text)


def test_a_puck_is_torn_off_when_friction_gives_way(tmp_path: Path) -> None:
    """What the event is located by and what is decided at it are one number: a grip that is found to hold at
    its event would do so over the whole next step. Between the steps too it rests until it slides. It
    gives way at 1e-9 more than it holds, later by as much."""
    s, held = 0.5 * 2 * 9.81 / 20, 0.4 * 2 * 9.81
    for k in DECADES:
        found = run(controlled("elements/joints/stick_directions", f"TOL 1e-{k}"), tmp_path)
        t = found.t
        exact = np.where(t > s, 0.8 * (10 * (t**2 - s**2) - held * (t - s)) / 2, 0)
        assert np.abs(found["node/5/VX"] - exact).max() < 0.1 * 10.0**-k + s * 1e-9, f"TOL 1e-{k}"
        listing = (tmp_path / "deck.lst").read_text(encoding="utf-8")
        assert "POINT_PLANE 7: breaks away" in listing


def test_a_puck_is_torn_off_by_a_slow_force(tmp_path: Path) -> None:
    """Fixed steps of generalised-α: within the tolerance of the event the force grows by 2e-10 of itself."""
    text = controlled("elements/joints/stick_directions", "", "RHO 0.8")
    text = text.replace("V 20 NF 1", "V 0.2 NF 1").replace("TF 1 H 0.0053", "TI 45 TF 60 H 0.01")
    found = run(text, tmp_path)
    s, held = 50 * 2 * 9.81 / 20, 0.4 * 2 * 9.81
    exact = np.where(found.t > s, 0.8 * (0.1 * (found.t**2 - s**2) - held * (found.t - s)) / 2, 0)
    assert np.abs(found["node/5/VX"] - exact).max() < 1e-6 * exact.max()


def test_a_driven_shaft_without_mass(tmp_path: Path) -> None:
    """Its joint stays open by what iterations leave: the error of the next step must not be made of that,
    which no shorter step mends."""
    last = 1.0
    for k in DECADES:
        found = run(controlled("elements/springs/bushing_oscillator", f"TOL 1e-{k}"), tmp_path)
        w = np.sqrt(15.96)
        exact = 8 / w * np.exp(-0.2 * found.t) * np.sin(w * found.t)
        error = np.abs(found["2/ROTATION_1"] - exact).max()
        assert error < 10.0**-k + 1e-11, f"TOL 1e-{k}"
        assert error < max(2 * last, 1e-11)
        last = error


JUMP = """
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
.FCT
 I 1 EXPR "if(T < 0.37, 3, -1)"
 I 2 EXPR "if(T < 0.37, 2, 1)"
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0
 I 2 TORQUE N 1 AXIS 0 0 1 V 1 NF 1
 I 3 INERTIA N 1 J 0.5 0.5 0.5
 I 4 HINGE N 0 2 AXIS 0 0 1 AT 1 0 0 {drive}
 I 5 INERTIA N 2 J 0.5 0.5 0.5
.SAM TYPE DYNAMIC SOLVER KLU {words}
.SUB TF 1 H 0.01 TOL {tolerance}
"""


@pytest.mark.parametrize("words", ["SCHEME RADAU", "RHO 0.8"])
@pytest.mark.parametrize("tolerance", ["1e-3", "1e-9"])
def test_steps_end_where_a_formula_jumps(words: str, tolerance: str, tmp_path: Path) -> None:
    """A step that ends there knows nothing of what follows: speeds to the last digits, whatever TOL is."""
    text = JUMP.format(words=words, tolerance=tolerance, drive="DRIVE SPEED NF 2")
    found = run(text, tmp_path)
    t = found.t
    speed = np.where(t < 0.37, 6 * t, 6 * 0.37 - 2 * (t - 0.37))
    assert np.abs(found["1/SPEED"] - speed).max() < 1e-12
    driven = np.where(t < 0.37, 2 * t, 2 * 0.37 + t - 0.37)
    assert np.abs(found["4/ANGLE"] - driven).max() < 1e-12
    text = JUMP.format(words=words, tolerance=tolerance, drive="")
    free = run(text, tmp_path, "free")
    assert np.abs(free["run/ENERGY_ERROR"]).max() < 1e-9 * 0.25 * free["1/SPEED"][-1] ** 2


def test_a_run_resumed_at_a_jump_has_every_bit(tmp_path: Path) -> None:
    text = JUMP.format(words="SCHEME RADAU", tolerance="1e-6", drive="DRIVE SPEED NF 2")
    whole = run(text, tmp_path, "whole")
    run(text, tmp_path, "part", options=("--until", "0.37"), status=2)
    part = run(text, tmp_path, "part", options=("--restart", "part"))
    for channel in ("1/SPEED", "1/ANGLE", "4/ANGLE", "run/ENERGY_ERROR", "run/STEP"):
        assert np.array_equal(whole[channel], part[channel]), channel


@pytest.mark.parametrize("k", [4, 6, 8, 9, 11])
def test_a_hoist_is_left_alone_by_its_motor(k: int, tmp_path: Path) -> None:
    """The worm stops within a millisecond of the jump of the torque, behind steps of 30 ms: no stretch of the
    way to rest may be taken with constant accelerations, and no energy comes from nowhere."""
    found = run(controlled("gears/worm_hold", f"TOL 1e-{k}"), tmp_path)
    assert abs(found["3/TORQUE_B"][-1] + 20) < 1e-8
    assert np.abs(found["run/ENERGY_ERROR"]).max() < 30 * 10.0**-k + 1e-7
    listing = (tmp_path / "deck.lst").read_text(encoding="utf-8")
    assert re.search(r"1\.000755\d* +GEAR 3: comes to rest", listing)


def test_what_is_at_rest_has_energies_of_rounding(tmp_path: Path) -> None:
    """The pin of a Geneva wheel turns without mass for 10 ms before it meets the wheel."""
    text = controlled("mechanisms/geneva_index", "TOL 1e-9", archive=".SAI HISTORY 0\n")
    found = run(text, tmp_path, options=("--until", "0.0095"), status=2)
    listing = found.file.with_suffix(".lst").read_text(encoding="utf-8")
    assert "interrupted at t = 0.0" in listing
    assert np.abs(found["2/ANGLE"]).max() < 1e-11


def test_checks_at_any_time_are_of_the_motion_within_the_step(tmp_path: Path) -> None:
    """Not of the polynomial through samples 0.1 apart, between which a pendulum hits its stop."""
    text = (DECKS / "elements/joints/hinge_stop.dat").read_text(encoding="utf-8")
    text = re.sub(r"(?m)^\.SAM .*", ".SAM TYPE DYNAMIC SOLVER KLU SCHEME RADAU", text)
    text = re.sub(r"(?m)^\.SUB .*", ".SAI HISTORY DT 0.1 FIELDS DT 0.6\n.SUB TF 1.2 H 0.01 TOL 1e-7", text)
    found = run(text, tmp_path)  # its checks pass
    assert len(found.t) == 13


def test_a_channel_that_is_noise_beside_others_is_not_judged(tmp_path: Path) -> None:
    """The force along the wire of a bead is zero, 1e-15 of what the other wire bears."""
    text = controlled("elements/joints/point_line", "", "ACCURACY FINE")
    checks = ".CHK\n ELEMENT 2 FORCE_1 T 1 V 0 ATOL 1e-9\n ELEMENT 4 FORCE_2 T 1 V -12 RTOL 1e-6\n"
    run(text.replace(".FIN", f"{checks} ELEMENT 2 SLIDE T 1 V 1.5 ATOL 9\n.FIN"), tmp_path)
    listing = (tmp_path / "deck.lst").read_text(encoding="utf-8")
    assert re.search(r"estimated error +\S+, element/2/SLIDE;", listing)


def test_a_jump_at_an_instant_of_results_is_one_sample(tmp_path: Path) -> None:
    """That on its left."""
    text = JUMP.format(words="SCHEME RADAU", tolerance="1e-6", drive="").replace("0.37", "0.25")
    found: Run = run(text, tmp_path)
    assert np.allclose(found.t, np.arange(101) * 0.01, rtol=0, atol=1e-12)


def test_teeth_with_play_on_a_driven_wheel_without_mass(tmp_path: Path) -> None:
    """Generalised-alpha. Between contacts no force tells how far a joint is open that only drives a wheel
    without mass. What is left open there is closed by a later step, all at once, and must not be an error of
    that step."""
    deck = "gears/driven_play_tolerance"
    archive = ".SAI HISTORY DT 1e-4\n"
    until = ("--until", "0.01")  # each of the 124 events of the whole run doubles what is off
    truth = run(controlled(deck, "TOL 1e-10", archive=archive), tmp_path, "truth", options=until, status=2)
    early = truth.t < 0.01
    last = 1.0
    for k in range(3, 7):
        text = controlled(deck, f"TOL 1e-{k}", "SCHEME CHUNG", archive)
        found = run(text, tmp_path, options=until, status=2)
        error = np.abs(found["node/2/WZ"] - truth["node/2/WZ"])[early].max() / 107
        assert error < min(10 * 10.0**-k, 0.4 * last), f"TOL 1e-{k}"
        last = error


TEETH = """.NOE
 I 1
 I 2 X 0.09
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 2 HINGE N 0 2 AXIS 0 0 1 C 0.2
 I 3 GEAR N 1 2 Z 30 60 MN 0.002 HELIX 0 AXIS 0 0 1 KM 1D6 XI 0.05 WIDTH 0.02
 I 4 INERTIA N 1 J 1D-3
 I 5 INERTIA N 2 J 1D-2
.FCT
 I 1 EXPR "min(20, 2000*T)"
.SAM TYPE DYNAMIC ACCURACY {setting}
.SUB TF 0.05 H 1D-4
.FIN 1
"""


@pytest.mark.parametrize("setting", ["FAST", "FINE"])
def test_states_and_ratios_between_steps(setting: str, tmp_path: Path) -> None:
    """A wheel runs up and swings on its teeth, which change their flank without an event. Whether they touch
    is not a number of a polynomial, nor is a ratio of powers that pass through zero; neither is judged."""
    found = run(TEETH.format(setting=setting), tmp_path)
    assert set(np.unique(found["3/CONTACT"])) == {-1, 1}
    efficiency = found["3/EFFICIENCY"]
    assert efficiency.min() >= 0
    assert efficiency.max() <= 1
    listing = found.file.with_suffix(".lst").read_text(encoding="utf-8")
    estimate = re.search(r"estimated error +(\S+), (?:element|node)/", listing)
    assert float(estimate.group(1)) < {"FAST": 1e-2, "FINE": 1e-5}[setting]
    assert int(re.findall(r"\n  (\d+) steps,", listing)[0]) < {"FAST": 100, "FINE": 1000}[setting]


def test_rates_of_what_stands_still_are_not_judged(tmp_path: Path) -> None:
    """A worm that holds its wheel by friction: all speeds are rounding, with none to compare them with."""
    text = """.NOE
 I 1 X 0 0 0
 I 2 X 0 0.05 0
.MCE
 I 1 HINGE N 0 1 AXIS 1 0 0
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 KIND WORM STARTS 1 Z 40 MX 0.002 Q 10 AXIS 1 0 0 FRICTION CONST 0.12 STICK
 I 4 TORQUE N 2 AXIS 0 0 1 V -100
 I 5 TORQUE N 1 AXIS 1 0 0 V -6 NF 1
 I 11 INERTIA N 1 M 1 J 1D-3
 I 12 INERTIA N 2 M 1 J 0.05
.FCT
 I 1 TABLE 0 0 0.1 0 0.3 2 1 2
.SAM TYPE DYNAMIC ACCURACY NORMAL
.SUB TF 0.13 H 0.005
.FIN 1
"""
    found = run(text, tmp_path)
    assert abs(found["3/SLIDING_SPEED"]).max() < 1e-18
    listing = found.file.with_suffix(".lst").read_text()
    error = re.search(r"estimated error +(\S+), (\S+);", listing)
    assert float(error[1]) < 1e-9 and "SPEED" not in error[2]


def test_a_wheel_that_only_turns_has_no_error_of_its_place(tmp_path: Path) -> None:
    """Its node moves by rounding, and so do all others: there is no length beside it but the model's size."""
    text = TEETH.replace("3 GEAR N 1 2 Z 30 60 MN 0.002 HELIX 0 AXIS 0 0 1 KM 1D6 XI 0.05 WIDTH 0.02", BELT)
    found = run(text.format(setting="FINE"), tmp_path)
    listing = found.file.with_suffix(".lst").read_text(encoding="utf-8")
    error, channel = re.search(r"estimated error +(\S+), (\S+);", listing).groups()
    assert float(error) < 1e-5
    assert not re.match(r"node/\d/[UVA][XYZ]", channel)


STILL = [
    "bearings/bearing_film",
    "bodies/initial_spin",
    "joints/hinge_speed",
    "joints/planar",
    "joints/point_line",
    "joints/prismatic",
    "joints/screw",
    "joints/spherical",
]


@pytest.mark.parametrize("deck", STILL)
def test_accelerations_that_are_rounding_are_not_judged(deck: str, tmp_path: Path) -> None:
    """Of what has a constant speed, or hardly turns: those of short steps are larger than of long ones."""
    found = run(controlled(f"elements/{deck}", "", "ACCURACY FINE"), tmp_path)
    listing = found.file.with_suffix(".lst").read_text(encoding="utf-8")
    error, _ = re.search(r"estimated error +(\S+), (\S+);", listing).groups()
    assert float(error) < 1e-5
    assert "again, with TOL" not in listing


BELT = "3 BELT N 1 2 AXIS 0 0 1 R 0.02 0.04 K 2D4 PRELOAD 300 C 40"


@pytest.mark.parametrize(
    ("deck", "size", "parts"),
    [
        ("mechanisms/andrews_squeezer", "15/RADIAL_FORCE", ("15/FORCE_2", "15/FORCE_3")),
        ("mechanisms/slider_crank", "1/BENDING_MOMENT", ("1/MOMENT_2", "1/MOMENT_3")),
        ("mechanisms/slider_crank", "2/FORCE_SIZE", ("2/FORCE_X", "2/FORCE_Y", "2/FORCE_Z")),
    ],
)
def test_sizes_between_steps_are_those_of_their_parts(
    deck: str, size: str, parts: tuple[str, ...], tmp_path: Path
) -> None:
    """Where the vector passes near zero its size has a corner, over which no polynomial leads."""
    found = run(controlled(deck, "TOL 1e-6"), tmp_path)
    exact = np.sqrt(sum(found[part] ** 2 for part in parts))
    assert np.abs(found[size] - exact).max() < 1e-5 * exact.max()


@pytest.mark.parametrize(
    ("deck", "tolerance"),
    [
        ("elements/cables/bar", "1e-9"),
        ("elements/joints/hinge_drive", "1e-3"),
        ("elements/joints/universal", "1e-9"),
        ("mechanisms/double_wishbone", "1e-9"),
        ("paper/bevel_pair", "1e-9"),
    ],
)
def test_load_steps_are_closed_as_far_as_their_tolerance_needs(
    deck: str, tolerance: str, tmp_path: Path
) -> None:
    """The error of the next would be what one has left; and an angle of 100 turns is not known to 1e-13."""
    text = (DECKS / f"{deck}.dat").read_text(encoding="utf-8")
    text = re.sub(r"(?m)^\.CHK.*\n(?:[ !].*\n)*", "", text)
    text = text.replace(".SUB TF 1 H (1/3000)", ".SUB TF 0.2 H (1/3000)")  # 200 turns of 1000
    run(re.sub(r"(?m)^(\.SUB [^!\n]*)", rf"\1 TOL {tolerance}", text), tmp_path)


@pytest.mark.parametrize("tolerance", ["1e-4", "1e-5"])
def test_a_drift_leaves_constraints_open_and_the_next_step_begins(tolerance: str, tmp_path: Path) -> None:
    """Steps end where the flanks slide as slowly as VREG. What the drift behind leaves open, 5e-12 of a turn,
    looks like a speed in the next step, the larger the shorter that is: at 1e-5 none was short enough."""
    deck = """
.NOE
 I 1
 I 2 X (0.06/cos(10*PI/180))
 I 3 X 0.5 0.2
 I 4 X 0.5 0.24 0.1
 I 5 X 0.55 0.2 0.05
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 HINGE N 0 2 AXIS 0 0 1 FRICTION CONST 0.1 RADIUS 0.01 VREG 1E-2
 I 3 HINGE N 0 3 AXIS 0 0 1
 I 4 GEAR N 1 2 AXIS 0 0 1 Z 20 40 MN 0.002 HELIX 10 FRICTION CONST 0.05 VREG 0.01 SLIDING PROFILE
 I 5 BELT N 2 3 AXIS 0 0 1 R 0.05 0.08 PRELOAD 300 MU 0.4
 I 6 CAM N 3 4 AXIS 0 0 1 BASE 0.03 MOTION 90 0.012 60 0.012 90 0 120 0 LAW POLY4567 FOLLOWER ROLLER 0.01 $
    DIRECTION 0 1 0
 I 7 PRISMATIC N 0 4 AXIS 0 1 0 K 3E4 SLIDE0 -0.01 FRICTION CONST 0.1 VREG 1E-3 LENGTH 0.05
 I 8 RIGID N 3 5
 I 11 INERTIA N 1 M 1 J 1E-3
 I 12 INERTIA N 2 M 2 J 2E-3
 I 13 INERTIA N 3 M 2 J 5E-3
 I 14 INERTIA N 4 M 0.5 J 1E-4
 I 17 MOTOR JOINT 3 STALL -2 FREE 1000
.FCT I 1 EXPR "30*T+2*sin(20*T)"
.CLM STRU ACC VAL 0 -9.81 0
.SAM TYPE {}
.SUB TF 0.5 H 0.0005 {}
.FIN
"""
    found = run(deck.format("DYNAMIC SCHEME RADAU", f"TOL {tolerance}"), tmp_path)
    truth = run(deck.format("KINEMATIC", ""), tmp_path, "truth")
    assert found["1/DRIVE_TORQUE"][-1] == pytest.approx(truth["1/DRIVE_TORQUE"][-1], rel=1e-5)
