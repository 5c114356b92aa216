# SPDX-License-Identifier: BSD-3-Clause
"""Links of groups with more than a thousand nodes: the rim of a disc in torsion, against its closed form;
and of a body that hardly changes its volume."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from engrane_post import Results
from plane_meshes import Sheet
from runs import run
from solid_meshes import Block

INNER, OUTER, YOUNG, POISSON, TORQUE = 9.0, 10.0, 2e5, 0.3, 100.0


def ring(u: np.ndarray) -> np.ndarray:
    radius, angle = INNER + (OUTER - INNER) * u[0], 2 * np.pi * u[1]
    # both ends of the sheet are one line of nodes
    return np.round(radius * np.array([np.cos(angle), np.sin(angle)]), 12)


class Ring(Sheet):
    """The sheet bent until its ends meet; their nodes become one."""

    def __init__(self, around: int):
        super().__init__((1, around), 8, ring, curved=True)
        seam = {tuple(self.points[i]): i for i in self.nodes(lambda u: u[1] == 0)}
        same = {i: seam[tuple(self.points[i])] for i in self.nodes(lambda u: u[1] == 1)}
        self.cells = [[same.get(i, i) for i in cell] for cell in self.cells]
        self.kept = [i for i in range(len(self.points)) if i not in same]


def rim(link: str, around: int, analysis: str, torque: float) -> str:
    """A deck of the ring, held inside and turned by node 90001 outside."""
    mesh = Ring(around)
    rows = mesh.text("MEMB BIDIM", f"YT {YOUNG} NT {POISSON}").split("\n")
    lost = {i + 1 for i in set(range(len(mesh.points))) - set(mesh.kept)}
    end = rows.index(".MAI")
    rows = [row for row in rows[:end] if row == ".NOE" or int(row.split()[1]) not in lost] + rows[end:]
    names = {name: [i for i in mesh.kept if mesh.unit[i][0] == u] for name, u in (("hub", 0.0), ("rim", 1.0))}
    assert len(names["rim"]) == 2 * around
    rows.insert(1, " I 90001 X 0 Y 0")
    deck = [
        *rows,
        '.PHP GROUP "all" THICK VAL 1.',
        ".SEL",
        *(mesh.group(k, name, nodes) for k, (name, nodes) in enumerate(names.items(), 2)),
        f'.MCE\n I 90001 {link} N 90001 GROUP "rim"',
        '.CLM\n GROUP "hub" FIX C 1 2\n NOEUD 90001 FIX C 3 4 5',
        f" NOEUD 90001 CHA C 6 V {torque}",
        f".SAM TYPE STATIC {analysis} SOLVER MUMPS",
        ".SUB TF 1 H 1",
        ".SAI NOEUD 90001",
        ".FIN 1",
    ]
    return "\n".join(deck)


def turn_of_rim(torque: float) -> float:
    shear = YOUNG / 2 / (1 + POISSON)
    return torque / (4 * np.pi * shear) * (1 / INNER**2 - 1 / OUTER**2)


@pytest.mark.parametrize("link", ["RIGID_LINK", "MEAN_LINK"])
@pytest.mark.parametrize("ranks", [1, 2, 3])
def test_rim_of_many_nodes(link: str, ranks: int, tmp_path: Path) -> None:
    """MUMPS needs more room than it foresees for the rigid link, and gets it."""
    results = Results(run(rim(link, 800, "DISPLACEMENTS LARGE", TORQUE), tmp_path, ranks=ranks).file)
    expected = turn_of_rim(TORQUE)
    found = results.history("node/90001/RZ")[-1][-1]
    # equal weights are not those of a uniform shear on edges of three nodes
    assert found == pytest.approx(expected, rel=1e-9 if link == "RIGID_LINK" else 5e-5)


@pytest.mark.parametrize("link", ["RIGID_LINK", "MEAN_LINK"])
def test_small_displacements(link: str, tmp_path: Path) -> None:
    """One linear system, also of a load that turns the rim by nearly a radian."""
    large = 4e6
    text = rim(link, 80, "DISPLACEMENTS SMALL", large * TORQUE)
    found = run(text, tmp_path, options=("--json",), output=tmp_path / "out.json")
    assert json.loads((tmp_path / "out.json").read_text())["runs"][0]["iterations"] <= 4
    expected = large * turn_of_rim(TORQUE)
    assert 0.9 < expected < 1.1
    assert found["node/90001/RZ"][-1] == pytest.approx(expected, rel=1e-5 if link == "RIGID_LINK" else 5e-3)
    small = run(rim(link, 80, "DISPLACEMENTS SMALL", TORQUE), tmp_path, "small")
    assert found["node/90001/RZ"][-1] == pytest.approx(large * small["node/90001/RZ"][-1], rel=1e-9)


def test_short_steps(tmp_path: Path) -> None:
    """The constraints of a mean link are closed by the change of all its shares: force and angle converge
    with the square of steps that are short beside every period."""
    text = (Path(__file__).parents[2] / "decks" / "mechanisms" / "meshed_pendulum.dat").read_text("utf-8")
    text = text[: text.index(".CHK")].replace("SCHEME RADAU", "RHO 0.8")
    found = []
    for step in ("2E-6", "1E-6", "5E-7"):
        deck = text.replace("TF 0.3 H 0.01", f"TF 2E-5 H {step}")
        assert deck != text
        results = Results(run(deck + ".FIN 1\n", tmp_path).file)
        found.append([results.history(f"element/{name}")[-1][-1] for name in ("103/FORCE_Y", "101/ANGLE")])
    coarse, middle, fine = np.array(found)
    assert (coarse - middle) / (middle - fine) == pytest.approx([4, 4], rel=0.05)


@pytest.mark.parametrize("sam", ["", "DISPLACEMENTS SMALL"])
def test_a_load_on_what_hardly_changes_its_volume(sam: str, tmp_path: Path) -> None:
    """A mean link spreads a force as its own ninths do. Rounding of the residual, 1e-6 of the load at this
    ratio of Poisson, was taken for forces out of balance: "no convergence in 20 iterations"."""
    beam = Block((8, 2, 2), 8, False, lambda u: np.array([200, 10, 10]) * np.array(u) + [0, -5, -5])
    end = beam.nodes(lambda u: u[0] == 1)
    head = [
        *beam.deck(),
        ".SEL",
        beam.group(1, "wall", beam.nodes(lambda u: u[0] == 0)),
        beam.group(2, "end", end),
        ".MAT\n I 1 YT 2E3 NT 0.49999",
        f".AEL\n I 1 J {len(beam.cells)} K 1 MAT 1",
    ]
    tail = f'.CLM\n GROUP "wall" FIX C 1 2 3\n{{load}}.SAM TYPE STATIC {sam}\n.SUB TF 1 H 1\n.FIN 1\n'
    linked = (
        ".NOE\n I 900 X 200 0 0\n.MCE\n"
        ' I 901 MEAN_LINK N 900 GROUP "end"\n I 902 FORCE N 900 DIR 0 -1 0.3 V 4\n'
    )
    size = 4 / np.hypot(1, 0.3) / len(end)
    shared = f' GROUP "end" CHA C 2 3 V {-size:.17g} {0.3 * size:.17g}\n'
    found = run("\n".join(head) + "\n" + linked + tail.format(load=""), tmp_path)
    expected = run("\n".join(head) + "\n" + tail.format(load=shared), tmp_path, "shared")
    for channel in ("UY", "UZ"):
        mean = np.mean([expected[f"node/{i + 1}/{channel}"][-1] for i in end])
        assert found[f"node/900/{channel}"][-1] == pytest.approx(mean, rel=1e-5)


# a plane cell, linked to node 10, which turns about y on a spring, out of the plane of the cell
TILTED = """
.NOE
 I 1 X 1 -0.5
 I 2 X 2 -0.5
 I 3 X 2 0.5
 I 4 X 1 0.5
 I 10
.MAI
 I 1 N 1 2 3 4
.HYP MEMB BIDIM
.SEL
 GROUP 1 NOM "all" MAILLES TOUT
 GROUP 2 NOM "left" NOEUDS 1 4
 GROUP 3 NOM "right" NOEUDS 2 3
.PHP GROUP "all" THICK 1
.MAT I 1 YT 1E6 NT 0 M 1
.AEL GROUP "all" MAT 1
.MCE
 I 11 {link} N 10 GROUP "left"
 I 12 HINGE N 0 10 AXIS 0 1 0
 I 13 TSPRING N 0 10 AXIS 0 1 0 K 100
.FCT I 1 TABLE 0 0 1 1
.CLM
 NOEUD 1 2 3 4 FIX C 2
 GROUP "right" CHA C 1 V 25 NF 1
 NOEUD 10 CHA C 5 V 10 NF 1
.SAM TYPE STATIC
.SUB TF 1 H 0.1
.FIN
"""


@pytest.mark.parametrize("link", ["RIGID_LINK", "MEAN_LINK"])
def test_a_link_of_plane_cells_turns_out_of_their_plane(link: str, tmp_path: Path) -> None:
    """The cells stay in their plane: the constraint is cos θ x = 1, with a force of 50/cos θ."""
    found = run(TILTED.format(link=link), tmp_path)
    low, high = 0.0, 0.5
    for _ in range(60):
        turn = (low + high) / 2
        low, high = (turn, high) if 100 * turn - 50 * np.sin(turn) / np.cos(turn) ** 2 < 10 else (low, turn)
    assert found["node/10/RY"][-1] == pytest.approx(low, rel=1e-9)
    assert found["node/1/UX"][-1] == pytest.approx(1 / np.cos(low) - 1, rel=1e-8)


@pytest.mark.parametrize("link", ["RIGID_LINK", "RIGID"])
def test_a_link_holds_a_sheet_in_all_directions(link: str, tmp_path: Path) -> None:
    """A membrane of `.MAI` in the x-z plane, linked along its upper edge and pulled along z: F/(EA/L + K)."""
    links = (
        'I 11 RIGID_LINK N 9 GROUP "top"' if link == "RIGID_LINK" else "I 11 RIGID N 9 3\n I 15 RIGID N 9 4"
    )
    found = run(
        f"""
.NOE
 I 1
 I 2 X 1 0 0
 I 3 X 1 0 1
 I 4 X 0 0 1
 I 9 X 0.5 0 1
.MAI
 I 1 N 1 2 3 4
.HYP MEMBRANE TENSION 1
.SEL
 GROUP 1 NOM "all" MAILLES TOUT
 GROUP 2 NOM "top" NOEUDS 3 4
.PHP GROUP "all" THICK 0.01
.MAT I 1 YT 1E6 NT 0
.AEL GROUP "all" MAT 1
.MCE
 {links}
 I 12 PRISMATIC N 0 9 AXIS 0 0 1
 I 13 SPRING N 0 9 K 1 1 1
.FCT I 1 TABLE 0 0 1 1
.CLM
 NOEUD 1 2 FIX C 1 2 3
 NOEUD 9 CHA C 3 V 10 NF 1
.SAM TYPE STATIC
.SUB TF 1 H 0.5
.FIN
""",
        tmp_path,
    )
    assert found["node/9/UZ"][-1] == pytest.approx(10 / (1e4 + 1), rel=4e-3)
    assert found["node/3/UZ"][-1] == pytest.approx(found["node/9/UZ"][-1], abs=1e-12)
