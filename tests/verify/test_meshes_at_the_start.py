# SPDX-License-Identifier: BSD-3-Clause
"""Meshes on links: joint values of .INI move the nodes on links alone, which is told, and a speed for all
nodes of the mesh is one of a rigid body."""

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


def test_a_speed_of_the_hinge_leaves_the_mesh_behind(tmp_path: Path) -> None:
    """It took the bore along, and the rod swung as from rest, without a word."""
    said, found = solve(begun(".INI\n VIT ELEMENT 101 V 5.\n"), tmp_path)
    assert "the speed of joints and drives at the start moves node" in said["said"]
    assert "begins with an impact" in said["said"]
    assert found["run/KINETIC_ENERGY"][0] < 1e-3
    assert "begins with an impact" in (tmp_path / "deck.lst").read_text(encoding="utf-8")


def test_a_speed_of_the_whole_mesh(tmp_path: Path) -> None:
    nodes = ' GROUP 9 NOM "nn" NOEUDS TOUT\n'
    deck = begun('.INI\n VIT ELEMENT 101 V 5.\n VIT GROUP "nn" AXIS 0 0 1 V 5.\n')
    said, found = solve(deck.replace(".HYP ", nodes + ".HYP ", 1), tmp_path)
    assert "impact" not in said["said"]
    mass, length, height = 7850 * 0.8 * 0.04 * 0.02, 0.8, 0.04
    inertia = mass * (length**2 / 3 + height**2 / 12) + 1.0 * length**2
    assert found["run/KINETIC_ENERGY"][0] == pytest.approx(0.5 * inertia * 5**2, rel=1e-3)


def test_an_angle_of_the_hinge_strains_the_mesh(tmp_path: Path) -> None:
    said, _ = solve(begun(".INI\n DEP ELEMENT 101 V 0.01\n"), tmp_path)
    assert "what closes the joints or sets their values moves node" in said["said"]
    assert "begins strained" in said["said"]


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
