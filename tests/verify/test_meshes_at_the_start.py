# SPDX-License-Identifier: BSD-3-Clause
"""Meshes and beams follow joints and drives at the start as rigid bodies, unless the deck gives values for
their nodes."""

import re
from pathlib import Path

import numpy as np
import pytest
from runs import solve

DECK = (Path(__file__).resolve().parents[2] / "decks/mechanisms/meshed_pendulum.dat").read_text(
    encoding="utf-8"
)


def begun(initial: str, end: float = 0.02) -> str:
    text = re.sub(r"(?m)^\.CHK.*\n(?:[ !].*\n)*", "", DECK)
    text = re.sub(r"\bTF \S+", f"TF {end}", text)
    return re.sub(r"(?m)^\.SAM ", f"{initial}.SAM ", text)


def energy_of_the_rod(speed: float) -> float:
    mass, length, height = 7850 * 0.8 * 0.04 * 0.02, 0.8, 0.04
    return 0.5 * (mass * (length**2 / 3 + height**2 / 12) + 1.0 * length**2) * speed**2


def test_a_speed_of_the_hinge_carries_the_mesh(tmp_path: Path) -> None:
    """It took the bore along, and the rod swung as from rest."""
    said, found = solve(begun(".INI\n VIT ELEMENT 101 V 5.\n"), tmp_path)
    assert "impact" not in said["said"]
    assert found["run/KINETIC_ENERGY"][0] == pytest.approx(energy_of_the_rod(5), rel=1e-8)
    assert found["run/STRAIN_ENERGY"].max() < 1e-4
    listing = (tmp_path / "deck.lst").read_text(encoding="utf-8")
    assert (
        "elastic bodies that follow joints and drives, strained only as these demand: that of node 1"
        in listing
    )


def test_a_mesh_with_a_speed_of_its_own_stays_behind(tmp_path: Path) -> None:
    said, found = solve(begun(".INI\n VIT ELEMENT 101 V 5.\n VIT NOEUD 8 C 1 V 0.\n"), tmp_path)
    assert "the speed of joints and drives at the start moves node" in said["said"]
    assert "begins with an impact" in said["said"]
    assert found["run/KINETIC_ENERGY"][0] < 1e-3
    assert "begins with an impact" in (tmp_path / "deck.lst").read_text(encoding="utf-8")


def test_a_speed_of_the_whole_mesh(tmp_path: Path) -> None:
    nodes = ' GROUP 9 NOM "nn" NOEUDS TOUT\n'
    deck = begun('.INI\n VIT ELEMENT 101 V 5.\n VIT GROUP "nn" AXIS 0 0 1 V 5.\n')
    said, found = solve(deck.replace(".HYP ", nodes + ".HYP ", 1), tmp_path)
    assert "impact" not in said["said"]
    assert found["run/KINETIC_ENERGY"][0] == pytest.approx(energy_of_the_rod(5), rel=1e-3)


@pytest.mark.parametrize("angle", [0.01, 30, 120, -400])
def test_an_angle_of_the_hinge_carries_the_mesh(angle: float, tmp_path: Path) -> None:
    said, found = solve(begun(f".INI\n DEP ELEMENT 101 V {angle}\n VIT ELEMENT 101 V 3.\n"), tmp_path)
    assert "strained" not in said["said"]
    assert found["run/STRAIN_ENERGY"][0] < 1e-15
    assert found["element/101/ANGLE"][0] == pytest.approx(np.radians(angle), rel=1e-9)
    assert found["node/102/UX"][0] == pytest.approx(0.8 * (np.cos(np.radians(angle)) - 1), abs=1e-9)
    assert found["run/KINETIC_ENERGY"][0] == pytest.approx(energy_of_the_rod(3), rel=1e-8)


def test_a_mesh_with_places_of_its_own_begins_strained(tmp_path: Path) -> None:
    said, _ = solve(begun(".INI\n DEP ELEMENT 101 V 0.01\n DEP NOEUD 8 C 1 V 0.\n"), tmp_path)
    assert "what closes the joints or sets their values moves node" in said["said"]
    assert "begins strained" in said["said"]


ROD = """.NOE
 I 1
 I 2 X 0.15
 I 3 X 0.15
 I 4 X 0.2
 I 5 X 0.25
 I 8 X 0.35
 I 6 X 0.45
 I 7 X 0.45
.BPR
 I 1 RECTANGLE 0.008 0.008
.MAT
 I 1 YT 2D11 NT 0.3 M 7870
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 2 HINGE N 1 3 AXIS 0 0 1 AT 0.15 0 0
 I 3 HINGE N 6 7 AXIS 0 0 1
 I 4 PRISMATIC N 0 7 AXIS 1 0 0
 I 5 INERTIA N 7 M 0.08
 I 6 INERTIA N 1 M 0.1 J 1e-4 1e-4 1e-4
{rod}
.FCT
 I 1 EXPR "150"
.SAM TYPE DYNAMIC PLANE XY
.SUB TF 0.002 H 1e-5
.FIN
"""


def test_a_drive_that_begins_at_full_speed_carries_the_beams(tmp_path: Path) -> None:
    """Of the rod of a slider-crank only the first node had a speed: the rod was struck, and its vibrations
    held as much energy as its motion."""
    rod = " I 11 BEAM N 3 4 5 8 6 BPR 1 MAT 1 AXIS2 0 1 0"
    _, found = solve(ROD.format(rod=rod), tmp_path)
    mass = 7870 * 0.008**2 * 0.3
    spin = 150 * 0.15 / 0.3  # of the rod about its end on the slider, which stands still
    kinetic = 0.5 * 1e-4 * 150**2 + 0.5 * mass * (0.3**2 + 0.008**2 / 4) / 3 * spin**2
    assert found["run/KINETIC_ENERGY"][0] == pytest.approx(kinetic, rel=1e-3)
    assert found["node/8/VY"][0] == pytest.approx(0.1 * spin, rel=1e-9)
    assert found["run/POTENTIAL_ENERGY"].max() < 5e-3 * kinetic


SMALL = """.NOE
 I 1 X 0 Y 0
 I 2 X 1 Y 0
 I 3 X 1 Y 1
 I 4 X 0 Y 1
 I 9 X 0 Y 0
.MAI
 I 1 N 1 2 3 4
.HYP MEMB BIDIM
.PHP GROUP "plate" THICK VAL 0.1
.MAT
 I 1 YT 2E5 NT 0.3 M 1E-9
.AEL
 I 1 MAT 1
.SEL
 GROUP 1 NOM "base" NOEUDS 1 2
 GROUP 2 NOM "plate" MAILLES TOUT
.MCE
 I 11 RIGID_LINK N 9 GROUP "base"
 I 12 HINGE N 0 9 AXIS 0 0 1 DRIVE ANGLE NF 1
.FCT
 I 1 TABLE 0 0 1 {angle}
.SAM TYPE STATIC DISPLACEMENTS {kind}
.SUB TF 1 H 0.1
.FIN
"""


@pytest.mark.parametrize(
    ("angle", "kind", "told"), [(0.1, "SMALL", False), (0.5, "SMALL", True), (0.5, "LARGE", False)]
)
def test_links_of_small_displacements_that_turn_far(
    angle: float, kind: str, told: bool, tmp_path: Path
) -> None:
    said, found = solve(SMALL.format(angle=angle, kind=kind), tmp_path)
    assert ("node 9 of RIGID_LINK 11 turned by" in said["said"]) == told
    rise = angle if kind == "SMALL" else np.sin(angle)
    assert found["node/2/UY"][-1] == pytest.approx(rise, rel=1e-6)
