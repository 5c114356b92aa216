# SPDX-License-Identifier: BSD-3-Clause
"""The start: assembly, branches, initial values as wishes and as musts, and loops that do not close."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from runs import Run, engrane, run

# Crank 0.3 at the origin, rocker 0.5 on (1, 0) that stands up, rod between their ends.
FOUR_BAR = """
.UNIT SI
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
.MCE
 I 1 INERTIA N 1 M 1 J 0.01
 I 2 INERTIA N 2 M 1 J 0.02
 I 11 HINGE N 0 1 AXIS 0 0 1 {crank}
 I 12 HINGE N 0 2 AXIS 0 0 1
 I 13 DISTANCE N 1 2 FROM 0.3 0 0 TO 1 0.5 0
.FCT
 I 1 EXPR "{angle}+T"
.INI
{initial}
.SAM TYPE {kind}
.SUB TF 0.01 H 0.01
"""
DRIVE = "DRIVE ANGLE NF 1"


def four_bar(crank: str = DRIVE, angle: float = 0, initial: str = "", kind: str = "KINEMATIC") -> str:
    return FOUR_BAR.format(crank=crank, angle=angle, initial=initial, kind=kind)


def rocker_angles(crank: float) -> tuple[float, float]:
    """Both turns of the rocker, degrees from upright, by the law of cosines."""
    rod, rocker = np.hypot(0.7, 0.5), 0.5
    end = np.array([0.3 * np.cos(crank), 0.3 * np.sin(crank)])
    away = end - [1, 0]
    distance = np.hypot(*away)
    middle = np.arctan2(away[1], away[0])
    half = np.arccos((distance**2 + rocker**2 - rod**2) / (2 * distance * rocker))
    # from the line to the crank's end the upright rocker lies clockwise
    turn = [(np.degrees(middle + s * half) - 90 + 180) % 360 - 180 for s in (-1, 1)]
    return turn[0], turn[1]


def first(folder: Path, channel: str) -> float:
    return Run(folder / "deck.h5")[channel][0]


def same_angle(a: float, b: float) -> bool:
    return abs((a - b + 180) % 360 - 180) < 1e-7


def test_rocker_stays_on_the_side_of_the_sketch(tmp_path):
    # the crank's drive begins 100 degrees from the sketch
    ended = engrane(four_bar(angle=np.radians(100)), tmp_path, "-q")
    assert ended.returncode == 0, ended.stderr
    assert same_angle(np.degrees(first(tmp_path, "element/12/ANGLE")), rocker_angles(np.radians(100))[0])
    listing = (tmp_path / "deck.lst").read_text(encoding="utf-8")
    assert re.search(r"1\. positions: closed in \d+ iterations", listing)
    assert re.search(r"HINGE 11 +was open by 100 deg", listing)
    assert re.search(r"node 1 +moved by +0 m, turned by 100 deg", listing)
    assert "2. velocities: changed by up to" in listing and "HINGE 11 (DRIVE_TORQUE)" in listing
    assert re.search(r"3\. accelerations and multipliers: \d iterations?", listing)
    assert "branch" not in listing


def test_drive_that_begins_beyond_half_a_turn(tmp_path):
    # 230 degrees and a whole turn from the sketch: turns are counted on the way
    start = np.radians(230) + 2 * np.pi
    ended = engrane(four_bar(angle=start), tmp_path, "-q")
    assert ended.returncode == 0, ended.stderr
    assert first(tmp_path, "element/11/ANGLE") == pytest.approx(start, rel=1e-12)
    assert same_angle(np.degrees(first(tmp_path, "element/12/ANGLE")), rocker_angles(start)[0])
    assert "little by little" in (tmp_path / "deck.lst").read_text(encoding="utf-8")


def test_wish_chooses_the_branch(tmp_path):
    up, down = rocker_angles(0.0)
    assert abs(up) < 1e-9
    ended = engrane(four_bar(initial=f" DEP NOEUD 2 C 6 V {down + 25}"), tmp_path, "-q")
    assert ended.returncode == 0, ended.stderr
    assert same_angle(np.degrees(first(tmp_path, "element/12/ANGLE")), down)


def test_imposed_position_holds_and_others_give_way(tmp_path):
    ended = engrane(
        four_bar(crank="", initial=" DEP NOEUD 1 C 6 V 40 IMPOSED", kind="DYNAMIC"), tmp_path, "-q"
    )
    assert ended.returncode == 0, ended.stderr
    assert same_angle(np.degrees(first(tmp_path, "element/11/ANGLE")), 40)
    assert same_angle(np.degrees(first(tmp_path, "element/12/ANGLE")), rocker_angles(np.radians(40))[0])


def test_wished_position_gives_way(tmp_path):
    ended = engrane(four_bar(crank="", initial=" DEP NOEUD 1 C 6 V 40", kind="DYNAMIC"), tmp_path, "-q")
    assert ended.returncode == 0, ended.stderr
    crank = np.degrees(first(tmp_path, "element/11/ANGLE"))
    assert 0.1 < abs(crank - 40) < 5, (
        "mostly the rocker moves: it stands across the rod, the crank nearly along it"
    )
    assert same_angle(np.degrees(first(tmp_path, "element/12/ANGLE")), rocker_angles(np.radians(crank))[0])


def test_imposed_rotation_against_a_drive(tmp_path):
    ended = engrane(four_bar(initial=" DEP NOEUD 1 C 6 V 40 IMPOSED"), tmp_path, "-q")
    assert ended.returncode == 2
    assert "imposed" in ended.stderr and "node 1 (rz)" in ended.stderr and "starting guess" in ended.stderr


@pytest.mark.parametrize(("word", "status"), [("", 0), ("IMPOSED", 2)])
def test_velocity_as_wish_and_as_must(tmp_path, word, status):
    deck = four_bar(initial=f" VIT NOEUD 1 C 6 V 7 {word}")
    ended = engrane(deck, tmp_path, "-q")
    assert ended.returncode == status, ended.stderr
    if status == 0:
        assert first(tmp_path, "element/11/SPEED") == pytest.approx(1, rel=1e-9), "the drive's"
    else:
        assert "initial velocity of node 1 (rz) is imposed" in ended.stderr


def test_imposed_velocity_moves_the_rest(tmp_path):
    ended = engrane(
        four_bar(crank="", initial=" VIT NOEUD 1 C 6 V 2 IMPOSED", kind="DYNAMIC"), tmp_path, "-q"
    )
    assert ended.returncode == 0, ended.stderr
    assert first(tmp_path, "element/11/SPEED") == pytest.approx(2, rel=1e-9)
    # the rod (0.7, 0.5) forbids relative speeds along it: 2*0.3*0.5 = -w*0.5*0.7
    assert first(tmp_path, "element/12/SPEED") == pytest.approx(-0.3 / 0.35, rel=1e-9)


@pytest.mark.parametrize("words", [("-q",), ("check",)])
def test_open_loop_is_named_with_its_gap(tmp_path, words):
    # crank 0.2, rocker 0.3 and ground 1 in line reach 1.5; the rod is to be 1.7
    deck = FOUR_BAR.format(crank="", angle=1.7, initial="", kind="DYNAMIC").replace(
        "FROM 0.3 0 0 TO 1 0.5 0", "FROM 0 0.2 0 TO 1 0.3 0 DRIVE LENGTH NF 1"
    )
    ended = engrane(deck, tmp_path, *words)
    said = ended.stdout + ended.stderr
    assert ended.returncode == 2
    assert "with all joints closed the drive of DISTANCE 13 is short by 0.2 m" in said
    assert "node 1 - HINGE 11 - ground - HINGE 12 - node 2 - DISTANCE 13 - node 1" in said


def test_gap_of_a_joint_in_a_loop(tmp_path):
    # two rods of sqrt(0.26) from nodes held 1.3 apart: 1.3 - 2 sqrt(0.26) = 0.2802 are missing
    deck = """
.UNIT SI
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
 I 3 X 0.5 0.1 0
.MCE
 I 1 DISTANCE N 1 3
 I 2 DISTANCE N 2 3
 I 3 INERTIA N 3 M 1
.CLM
 FIX NOEUD 1 C 1 2 3
 DEP NOEUD 2 C 1 V 0.3
 FIX NOEUD 2 C 2 3
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.1
"""
    ended = engrane(deck, tmp_path, "-q")
    assert ended.returncode == 2
    assert re.search(r"with all other joints closed DISTANCE [12] stays open by 0\.2802 m", ended.stderr)
    assert "support" in ended.stderr and "DISTANCE 1" in ended.stderr and "DISTANCE 2" in ended.stderr


def side_of_rod(crank: float, rocker: float) -> float:
    """Cross product of rod and rocker; turns in radians from the reference."""
    end = 0.3 * np.array([np.cos(crank), np.sin(crank)])
    arm = 0.5 * np.array([-np.sin(rocker), np.cos(rocker)])
    rod = np.array([1, 0]) + arm - end
    return rod[0] * arm[1] - rod[1] * arm[0]


def test_flip_is_said(tmp_path):
    wishes = " DEP NOEUD 1 C 6 V -110.1\n DEP NOEUD 2 C 6 V 99.8"
    ended = engrane(four_bar(angle=-3.07, initial=wishes), tmp_path, "-q")
    assert ended.returncode == 0
    turns = first(tmp_path, "element/11/ANGLE"), first(tmp_path, "element/12/ANGLE")
    assert side_of_rod(*turns) * side_of_rod(*np.radians([-110.1, 99.8])) < 0, "it did flip"
    assert "branch flip" in ended.stderr and ".INI DEP" in ended.stderr
    assert "branch flip" in (tmp_path / "deck.lst").read_text(encoding="utf-8")


def test_no_flip_is_said_of_a_long_way_on_one_side(tmp_path):
    for degrees in (-170, -120, -60, 60, 120, 170):
        ended = engrane(four_bar(angle=np.radians(degrees)), tmp_path, "-q")
        assert ended.returncode == 0
        turns = first(tmp_path, "element/11/ANGLE"), first(tmp_path, "element/12/ANGLE")
        assert side_of_rod(*turns) * side_of_rod(0, 0) > 0
        assert "branch" not in ended.stderr


@pytest.mark.parametrize("angle", [40, 200, -300, 400])
def test_crank_starts_where_it_is_asked_to(tmp_path, angle):
    initial = f" DEP ELEMENT 11 V {angle}\n VIT ELEMENT 11 V 3"
    assert engrane(four_bar(crank="", initial=initial, kind="DYNAMIC"), tmp_path, "-q").returncode == 0
    assert first(tmp_path, "element/11/ANGLE") == pytest.approx(np.radians(angle), abs=1e-11)
    assert first(tmp_path, "element/11/SPEED") == pytest.approx(3, abs=1e-11)
    # the crank can turn right round, and the rocker stays on the side of the sketch all the way
    side = int(abs(rocker_angles(0)[1]) < abs(rocker_angles(0)[0]))

    def rocker(crank: float) -> float:
        return rocker_angles(crank)[side]

    assert same_angle(np.degrees(first(tmp_path, "element/12/ANGLE")), rocker(np.radians(angle)))
    h = 1e-5
    ratio = np.radians(rocker(np.radians(angle) + h) - rocker(np.radians(angle) - h)) / (2 * h)
    assert first(tmp_path, "element/12/SPEED") == pytest.approx(3 * ratio, abs=1e-7)


def test_rocker_starts_where_it_is_asked_to(tmp_path):
    rocker = rocker_angles(np.radians(50))[int(abs(rocker_angles(0)[1]) < abs(rocker_angles(0)[0]))]
    done = engrane(four_bar(crank="", initial=f" DEP ELEMENT 12 V {rocker}", kind="DYNAMIC"), tmp_path, "-q")
    assert done.returncode == 0, done.stderr
    assert first(tmp_path, "element/12/ANGLE") == pytest.approx(np.radians(rocker), abs=1e-11)


def test_a_guess_that_is_not_kept_is_said(tmp_path):
    done = engrane(four_bar(crank="", initial=" DEP NOEUD 2 C 6 V 20", kind="DYNAMIC"), tmp_path, "-q")
    assert done.returncode == 0
    assert "the initial rotation of node 2 (rz) was given as 20 deg and is" in done.stderr


def driven(axles: str, drive: str, kind: str = "KINEMATIC") -> str:
    return f"""
.UNIT SI
{axles}
.FCT
 I 1 EXPR "{drive}+0.1*T"
.SAM TYPE {kind}
.SUB TF 0.1 H 0.1
"""


def pair(gear: str, place: str, axis: str = "0 0 1") -> str:
    """Wheel 2 with a spring, wheel 3 with a drive about an axis through it."""
    return f"""
.NOE
 I 2 X 0 0 0
 I 3 X {place}
.MCE
 I 2 HINGE N 0 2 AXIS 0 0 1 K 10
 I 3 HINGE N 0 3 AXIS {axis} DRIVE ANGLE NF 1
 I 4 GEAR N 2 3 AXIS 0 0 1 {gear}
 I 7 INERTIA N 2 M 1 J 1D-3
 I 8 INERTIA N 3 M 1 J 1D-3"""


def start_of(folder: Path, deck: str, *channels: str) -> list[float]:
    ended = engrane(deck, folder, "-q")
    assert ended.returncode == 0, ended.stderr
    assert "two ways" not in ended.stderr and "branch" not in ended.stderr
    return [first(folder, channel) for channel in channels]


@pytest.mark.parametrize("kind", ["STATIC", "KINEMATIC", "DYNAMIC"])
@pytest.mark.parametrize("drive", [1, 2, 2.5, 3, 3.1, 3.2, -2.5])
def test_wheel_turns_more_than_half_a_turn_from_a_drive_that_does_not(tmp_path, kind, drive):
    deck = driven(pair("KIND SPUR Z 20 40 MN 0.002", "0.06 0 0"), drive, kind)
    angle, torque = start_of(tmp_path, deck, "element/2/ANGLE", "element/3/DRIVE_TORQUE")
    assert angle == pytest.approx(-2 * drive, rel=1e-12)
    if kind == "STATIC":
        assert torque == pytest.approx(40 * drive, rel=1e-9)


@pytest.mark.parametrize("drive", [13.6, 24.8, 42, 56])
def test_the_moment_of_a_wound_spring_is_no_stiffness(tmp_path, drive):
    """What rounding left of it on the diagonal set the scale of constraints: a singular matrix."""
    deck = driven(pair("KIND SPUR Z 20 40 MN 0.002", "0.06 0 0"), drive, "STATIC")
    assert start_of(tmp_path, deck, "element/3/DRIVE_TORQUE") == pytest.approx([40 * drive], rel=1e-9)


@pytest.mark.parametrize("drive", [0.2, 0.4, 0.7, 1.5, 2.5, 4, 30])
def test_small_wheel_turns_many_turns_to_where_its_drive_begins(tmp_path, drive):
    deck = driven(pair("KIND SPUR Z 20 200 MN 0.002", "0.22 0 0"), drive)
    assert start_of(tmp_path, deck, "element/2/ANGLE") == pytest.approx([-10 * drive], rel=1e-12)


@pytest.mark.parametrize("drive", [0.1, 0.3, 1, 2.5])
def test_worm_turns_many_turns_to_where_its_wheel_begins(tmp_path, drive):
    worm = pair("KIND WORM STARTS 2 Z 30 MX 0.002 Q 10", "0.04 0 0", "0 1 0")
    # the sign as for a small drive: that way no turn is left out
    sense = np.sign(start_of(tmp_path, driven(worm, 0.01), "element/2/ANGLE")[0])
    assert start_of(tmp_path, driven(worm, drive), "element/2/ANGLE") == pytest.approx(
        [15 * sense * drive], rel=1e-9
    )


@pytest.mark.parametrize("travel", [0.02, 0.05, 0.08, 0.1, 0.15, 0.3, 3])
def test_pinion_turns_with_a_rack_that_begins_away(tmp_path, travel):
    rack = """
.NOE
 I 1 X 0 0 0
 I 2 X 0 -0.02 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 K 1
 I 2 PRISMATIC N 0 2 AXIS 1 0 0 DRIVE SLIDE NF 1
 I 3 RACK N 1 2 AXIS 0 0 1 Z 20 MN 0.002 DIR 1 0 0
 I 4 INERTIA N 1 M 1 J 1D-3
 I 5 INERTIA N 2 M 1 J 1D-3"""
    assert start_of(tmp_path, driven(rack, travel), "element/1/ANGLE") == pytest.approx(
        [travel / 0.02], rel=1e-12
    )


@pytest.mark.parametrize("carrier", [0.5, 1.2, 2, 3, 4, -2])
def test_sun_turns_with_a_carrier_that_begins_away(tmp_path, carrier):
    planetary = """
.NOE
 I 1 X 0 0 0
 I 2 X 0 0 0
 I 3 X 0.06 0 0
 I 4 X 0 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 HINGE N 0 2 AXIS 0 0 1 K 1
 I 3 HINGE N 1 3 AXIS 0 0 1 AT 0.06 0 0
 I 4 WELD N 0 4
 I 5 GEAR N 2 3 AXIS 0 0 1 KIND SPUR Z 24 36 MN 0.002
 I 6 GEAR N 3 4 AXIS 0 0 1 KIND INTERNAL Z 36 96 MN 0.002"""
    # Willis: the sun turns 1 + 96/24 times the carrier, the planet -96/36 times it relative to it
    channels = "element/2/ANGLE", "element/3/ANGLE", "element/1/DRIVE_TORQUE"
    found = start_of(tmp_path, driven(planetary, carrier), *channels)
    assert found == pytest.approx([5 * carrier, -96 / 36 * carrier, 25 * carrier], rel=1e-9)


@pytest.mark.parametrize("drive", [40, 45, 1000])
def test_hinge_begins_any_number_of_turns_away(tmp_path, drive):
    hinge = """
.NOE
 I 1 X 0 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 4 INERTIA N 1 M 1 J 1D-3"""
    assert start_of(tmp_path, driven(hinge, drive), "element/1/ANGLE") == pytest.approx([drive], rel=1e-14)


def test_initial_value_of_many_turns(tmp_path):
    free = driven(pair("KIND SPUR Z 20 200 MN 0.002", "0.22 0 0"), 0, "DYNAMIC")
    deck = free.replace(" DRIVE ANGLE NF 1", "").replace("K 10", "") + ".INI\n DEP ELEMENT 3 V 6000\n"
    asked = np.radians(6000)
    angles = start_of(tmp_path, deck, "element/3/ANGLE", "element/2/ANGLE")
    assert angles == pytest.approx([asked, -10 * asked], rel=1e-9)


def test_gap_of_a_loop_that_its_drive_stretches_after_a_turn(tmp_path):
    # crank of length 1, rod of 0.5 from its end to a slider on the x axis: |sin 10| - 0.5 = 0.044 is missing
    deck = """
.UNIT SI
.NOE
 I 1 X 0 0 0
 I 2 X 1.5 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 PRISMATIC N 0 2 AXIS 1 0 0
 I 3 DISTANCE N 1 2 FROM 1 0 0 TO 1.5 0 0
 I 4 INERTIA N 1 M 1 J 1D-3
 I 5 INERTIA N 2 M 1 J 1D-3
.FCT
 I 1 EXPR "10+T"
.SAM TYPE KINEMATIC
.SUB TF 0.1 H 0.1
"""
    ended = engrane(deck, tmp_path, "-q")
    assert ended.returncode == 2
    assert "DISTANCE 3 stays open by 0.04402 m" in ended.stderr


def test_initial_values_that_are_missed_by_rounding(tmp_path):
    """Rotations written back from results: those that the first hinge prevents are rounding errors there."""
    deck = """
.NOE
 I 1 X 0 0 0
 I 2 X 0 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 K 3
 I 2 HINGE N 1 2 AXIS 1 0 0 K 2
 I 3 INERTIA N 1 M 1 J 0.01 0.02 0.015
 I 4 INERTIA N 2 M 1 J 0.01 0.02 0.015
.INI
 DEP NOEUD 1 C 4 5 6 V -1.4e-23 {tilt} 38.197186342098867
 DEP NOEUD 2 C 4 5 6 V 27.570189221796433 9.5462758787165463 37.386245991668019
.SAM TYPE DYNAMIC
.SUB TF 0.01 H 1E-3
"""
    assert "was given as" not in engrane(deck.format(tilt=-9e-23), tmp_path, "-q").stderr
    assert "was given as 0.001 deg" in engrane(deck.format(tilt=1e-3), tmp_path, "-q").stderr


# a point mass on the arm of a turning hinge, which turns across it
POINT_MASS = """.NOE
 I 1 X 0 0 0
 I 2 X 0.2 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 HINGE N 1 2 AXIS 0 1 0 AT 0 0 0
 I 3 INERTIA N 1 M 1 J 0.01 0.01 0.02
 I 4 INERTIA N 2 M 0.5
.INI VIT ELEMENT 1 V 10
.SAM TYPE DYNAMIC SCHEME RADAU SOLVER {solver}
.SUB TF 0.01 H 0.001
.FIN 1
"""


@pytest.mark.parametrize("solver", ["KLU", "MUMPS", "UMFPACK"])
def test_speed_of_a_joint_with_a_point_mass(solver: str, tmp_path: Path) -> None:
    """No constraint is open at the start, and the masses span thirteen powers of ten."""
    ended = engrane(POINT_MASS.format(solver=solver), tmp_path, "-q")
    assert ended.returncode == 0, ended.stderr
    assert first(tmp_path, "node/2/WZ") == pytest.approx(10, rel=1e-9)
    assert first(tmp_path, "run/KINETIC_ENERGY") == pytest.approx((0.02 + 0.5 * 0.2**2) * 10**2 / 2, rel=1e-9)


@pytest.mark.parametrize("sam", ["KINEMATIC", "DYNAMIC", "DYNAMIC PLANE XY", "DYNAMIC SCHEME RADAU"])
@pytest.mark.parametrize("coefficient", [0.1, 0.001])
def test_friction_of_a_bearing_beside_teeth_does_not_jam(
    sam: str, coefficient: float, tmp_path: Path
) -> None:
    """The balance leads across |λ| of the separating force before it converges. W: pitch-line load."""
    found = run(
        f"""
.NOE
 I 1
 I 2 X 0.06
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 HINGE N 0 2 AXIS 0 0 1 FRICTION CONST {coefficient} RADIUS 0.01 VREG 1E-2
 I 4 GEAR N 1 2 AXIS 0 0 1 Z 20 40 MN 0.002
 I 11 INERTIA N 1 M 1 J 1E-3
 I 12 INERTIA N 2 M 2 J 2E-3
.CLM CHA NOEUD 2 C 2 V 5000
.FCT
 I 1 EXPR "30*T"
.SAM TYPE {sam}
.SUB TF 0.002 H 0.0005
.FIN
""",
        tmp_path,
    )

    def moment(w: float) -> float:
        return 0.04 * w - coefficient * 0.01 * math.hypot(w * math.tan(math.radians(20)), 5000 + w)

    low, high = 0.0, 1000.0
    for _ in range(100):
        low, high = ((low + high) / 2, high) if moment((low + high) / 2) < 0 else (low, (low + high) / 2)
    assert found["1/DRIVE_TORQUE"] == pytest.approx(0.02 * low, rel=1e-6)
