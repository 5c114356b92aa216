# SPDX-License-Identifier: BSD-3-Clause
"""What the user is told of degrees of freedom, of redundant constraints and of conflicting ones."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from engrane_post import Results
from runs import Run, engrane

DOOR = """
.NOE
 I 1 X 0.4 0 1
.MCE
 I 1 INERTIA N 1 M 20 J 8 4 4
 I 2 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0.2
 I 3 HINGE N 0 1 AXIS 0 0 1 AT 0 0 1.8
.SAM TYPE DYNAMIC
.SUB TF 0.1 H 0.01
"""

FLAT_LOOP = """
.NOE
 I 1 X 0 0 0
 I 2 X 0 1 0
 I 3 X 2 0 0
.MCE
 I 1 INERTIA N 1 M 1 J 1
 I 2 INERTIA N 2 M 1 J 1
 I 3 INERTIA N 3 M 1 J 1
 I 11 HINGE N 0 1 AXIS 0 0 1
 I 12 HINGE N 1 2 AXIS 0 0 1 AT 0 1 0
 I 13 HINGE N 0 3 AXIS 0 0 1
 I 14 HINGE N 2 3 AXIS 0 0 1 AT 2.5 1 0
.SAM TYPE DYNAMIC
.SUB TF 0.1 H 0.01
"""

# A joint that welds, and one that drives what is welded.
DRIVEN_AND_FIXED = """
.NOE
 I 1 X 0.4 0 1
.MCE
 I 1 INERTIA N 1 M 20 J 8 4 4
 I 2 RIGID N 0 1
 I 3 HINGE N 0 1 AXIS 0 0 1 AT 0 0 1.8 DRIVE ANGLE NF 1
.FCT
 I 1 EXPR "{function}"
.SAM TYPE {type}
.SUB TF 1 H 0.1
"""

TWO_DRIVES = """
.NOE
 I 1 X 0 0 0
 I 2 X 0.1 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 HINGE N 0 2 AXIS 0 0 1 DRIVE ANGLE NF 2
 I 3 GEAR N 1 2 Z 20 20 AXIS 0 0 1 MN 0.005 WIDTH 0.02
.FCT
 I 1 EXPR "T"
 I 2 EXPR "-{ratio}*T"
.SAM TYPE STATIC
.SUB TF 1 H 0.1
"""

LOOSE = """
.NOE
 I 7 X 0 0 0
 I 8 X 1 0 0
.MCE
 I 2 HINGE N 0 7 AXIS 0 0 1 K 1
 I 4 HINGE N 0 8 AXIS 0 0 1
 I 5 TORQUE N 8 AXIS 0 0 1 V 1
.SAM TYPE STATIC
.SUB TF 1 H 0.1
"""


def test_check_names_redundant_constraints(tmp_path):
    ended = engrane(DOOR, tmp_path, "check")
    assert ended.returncode == 0
    assert "1 degree of freedom (6 free motions, 5 independent constraints)" in ended.stdout
    assert "1 redundant constraint among HINGE 2 (force along z), HINGE 3 (force along z)" in ended.stdout
    assert sum(int(n) for n in re.findall(r"(\d) redundant constraint", ended.stdout)) == 5
    assert "not unique" in ended.stdout


def test_run_says_that_reactions_are_not_unique(tmp_path):
    ended = engrane(DOOR, tmp_path, "-q")
    assert ended.returncode == 0
    assert "5 redundant constraints" in ended.stderr and "not unique" in ended.stderr
    listing = (tmp_path / "deck.lst").read_text(encoding="utf-8")
    assert "HINGE 3 (force along z)" in listing and "not unique" in listing


def not_unique(folder: Path) -> dict[str, bool]:
    with Results(folder / "deck.h5") as result:
        return {name: not channel.unique for name, channel in result.channels.items()}


def test_reactions_that_are_not_unique_are_marked(tmp_path):
    assert engrane(DOOR, tmp_path, "-q").returncode == 0
    marked = not_unique(tmp_path)
    for hinge in (2, 3):
        for channel in ("FORCE_X", "FORCE_Y", "FORCE_Z", "MOMENT_X", "MOMENT_Y", "AXIAL_FORCE"):
            assert marked[f"element/{hinge}/{channel}"], channel
        for channel in ("ANGLE", "SPEED", "MOMENT_Z"):
            assert not marked[f"element/{hinge}/{channel}"], channel
    for name, mark in marked.items():
        assert not mark or name.startswith(("element/2/", "element/3/")), name
    listing = (tmp_path / "deck.lst").read_text(encoding="utf-8")
    assert re.search(r"Not unique\n=+\n(.*\n)+.*HINGE 2 .*FORCE_Z", listing)


def test_supports_that_share_a_load_are_marked(tmp_path):
    # a rod between two held nodes, loaded along itself
    deck = """
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
 I 3 X 2 0 0
.MCE
 I 1 DISTANCE N 1 2
 I 2 DISTANCE N 2 3
 I 3 FORCE N 2 DIR 1 0 0 V 10
.CLM
 FIX NOEUD 1 C 1 2 3
 FIX NOEUD 3 C 1 2 3
 FIX NOEUD 2 C 2 3
.SAM TYPE STATIC
.SUB TF 1 H 0.5
"""
    ended = engrane(deck, tmp_path, "-q")
    assert ended.returncode == 0, ended.stderr
    marked = not_unique(tmp_path)
    assert marked["node/1/FX"] and marked["node/3/FX"] and marked["element/1/THRUST"]
    assert not marked["node/1/FY"] and not marked["node/2/FY"] and not marked["node/2/UX"]


def test_plots_tell_what_is_not_unique(tmp_path):
    assert engrane(DOOR, tmp_path, "-q").returncode == 0
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[2] / "post")}
    listed = subprocess.run(
        [sys.executable, "-m", "engrane_post", "plot", "deck", "--list"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        env=environment,
        timeout=120,
        check=True,
    ).stdout
    lines = {line.split()[0]: line for line in listed.splitlines() if line.startswith("    ")}
    assert lines["element/2/FORCE_Z"].endswith("(not unique)")
    assert "unique" not in lines["element/2/ANGLE"]


def test_suggested_cure_leaves_nothing_redundant(tmp_path):
    for deck in (DOOR, FLAT_LOOP):
        before = engrane(deck, tmp_path, "check").stdout
        freedom = re.search(r"(\d+) degrees? of freedom", before).group(1)
        changes = re.findall(r"make HINGE (\d+) a ([A-Z_]+) \(releases", before)
        assert changes, before
        for hinge, kind in changes:
            axis = r"\2" if kind != "SPHERICAL" else " "  # a ball has none
            was = rf"I {hinge} HINGE N (\d+ \d+)( AXIS 0 0 1)?"
            deck = re.sub(was, rf"I {hinge} {kind} N \1{axis}", deck)
        after = engrane(deck, tmp_path, "check").stdout
        assert re.search(r"(\d+) degrees? of freedom", after).group(1) == freedom, changes
        assert "redundant" not in after, after


def test_one_hinge_is_not_redundant(tmp_path):
    deck = DOOR.replace(" I 3 HINGE N 0 1 AXIS 0 0 1 AT 0 0 1.8\n", "")
    ended = engrane(deck, tmp_path, "check")
    assert ended.returncode == 0
    assert "1 degree of freedom" in ended.stdout and "redundant" not in ended.stdout


def test_hinges_out_of_line_leave_no_freedom(tmp_path):
    ended = engrane(DOOR.replace("AT 0 0 1.8", "AT 0.001 0 1.8"), tmp_path, "check")
    assert ended.returncode == 0
    assert "0 degrees of freedom (6 free motions, 6 independent constraints)" in ended.stdout


@pytest.mark.parametrize("words", [("check",), ("-q",)])
@pytest.mark.parametrize("kind", ["STATIC", "KINEMATIC", "DYNAMIC"])
def test_driven_joint_against_a_fixed_one(tmp_path, kind, words):
    # open from the start by the angle that is asked for
    ended = engrane(DRIVEN_AND_FIXED.format(function="0.1", type=kind), tmp_path, *words)
    said = ended.stdout + ended.stderr
    assert ended.returncode == 2
    assert "conflicting constraints" in said and "open by 0.1 rad" in said
    assert "RIGID 2" in said and "HINGE 3" in said and "torque of the drive" in said


@pytest.mark.parametrize("kind", ["STATIC", "KINEMATIC", "DYNAMIC"])
def test_drive_that_runs_into_a_fixed_joint(tmp_path, kind):
    # closed at the start and at rest there; the drive moves on from t = 0.25
    deck = DRIVEN_AND_FIXED.format(function="max(0,T-0.25)**3", type=kind)
    assert engrane(deck, tmp_path, "check").returncode == 0
    ended = engrane(deck, tmp_path, "-q")
    assert ended.returncode == 2
    assert "conflicting constraints: HINGE 3 (DRIVE_TORQUE)" in ended.stderr or "RIGID 2 (" in ended.stderr
    time = float(re.search(r"t = ([0-9.e+-]+)", ended.stderr).group(1))
    assert 0.25 < time < 0.3
    assert "ramp" not in ended.stderr


def test_speeds_that_teeth_forbid(tmp_path):
    ended = engrane(TWO_DRIVES.format(ratio=2), tmp_path, "check")
    assert ended.returncode == 2
    assert "conflicting constraints" in ended.stdout and "speed" in ended.stdout
    for name in ("HINGE 1", "HINGE 2", "GEAR 3", "tooth force"):
        assert name in ended.stdout
    ended = engrane(TWO_DRIVES.format(ratio=2), tmp_path, "-q")
    assert ended.returncode == 2 and "conflicting constraints" in ended.stderr
    assert engrane(TWO_DRIVES.format(ratio=1), tmp_path, "-q").returncode == 0


def test_singular_start_does_not_advise_to_ramp_loads(tmp_path):
    ended = engrane(LOOSE, tmp_path, "-q")
    assert ended.returncode == 2
    assert "nothing resists a motion of node 8 (rz)" in ended.stderr
    assert "ramp" not in ended.stderr and "NF" not in ended.stderr


def test_supports_are_counted_once(tmp_path):
    deck = """
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
.MCE
 I 1 SPRING N 1 2 K 1
 I 2 INERTIA N 2 M 1
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
 FIX NOEUD 2 C 3 4 5
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.1
"""
    ended = engrane(deck, tmp_path, "check")
    rows = dict(re.findall(r"^  (\S.*?\S)  +(-?\d+)$", ended.stdout, re.MULTILINE))
    # neither node turns for a spring: of nine components held four take an unknown away
    assert rows["translations of nodes"] == "6" and rows["rotations of nodes"] == "0"
    assert rows["prescribed by supports"] == "-4"
    assert rows["to be solved for"] == "2" and rows["motions less constraints"] == "2"


JACK = """
.NOE
 I 1 X 0 0 0
 I 2 X -0.09 0 -0.03
 I 3 X -0.09 0 0.2
.MCE
 I 1 HINGE N 0 1 AXIS 1 0 0
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 KIND BEVEL AXIS 1 0 0 AXISB 0 0 1 Z 15 45 MN 0.004 PLACE 0 0 -1
 I 4 SCREW N 2 3 AXIS 0 0 1 PITCH -0.005 AT -0.09 0 0 FRICTION CONST 0.12 0.15 RADIUS 0.01 FLANK 15
 I 5 PRISMATIC N 0 3 AXIS 0 0 1
 I 6 INERTIA N 1 M 1 J 1E-4
 I 7 INERTIA N 2 M 1 J 1E-3
 I 8 INERTIA N 3 M 200
 I 9 TORQUE N 1 AXIS 1 0 0 V 1 NF 1
.CLM
 STRU ACC 0 0 -9.81
.FCT
 I 1 TABLE 0 0 1 4 2 -2
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.002
"""


def test_friction_on_reactions_that_are_not_unique(tmp_path):
    """A screw jack with four redundant constraints. Its friction takes the least reactions, whatever the
    steps; reactions of earlier steps stayed in them before, and the motion depended on the steps."""
    lifts, forces = [], []
    for k, card in enumerate((".SUB TF 1 H 0.002", ".SUB TF 1 H 0.001", ".SUB TF 1 H 0.01 TOL 1E-5")):
        done = engrane(JACK, tmp_path, "--card", card, name=f"jack{k}")
        assert done.returncode == 0, done.stderr
        assert "friction in SCREW 4 depends on these reactions" in done.stderr
        assert "Friction in SCREW 4 depends on them" in (tmp_path / f"jack{k}.lst").read_text()
        found = Run(tmp_path / f"jack{k}.h5")
        lifts.append(found["5/SLIDE"][-1])
        forces.append(found["4/RADIAL_FORCE"][-1])
    assert lifts == pytest.approx([lifts[1]] * 3, rel=2e-5)
    assert forces == pytest.approx([forces[1]] * 3, rel=1e-4)
