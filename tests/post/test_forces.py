# SPDX-License-Identifier: BSD-3-Clause
"""What `engrane export` draws as forces and moments is what moves the bodies: in runs of the program the
sums on each body are its mass times its acceleration, and the rate of its angular momentum."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
from engrane_post import Results
from engrane_post.forces import Forces
from engrane_post.scene import Scene
from scipy.spatial.transform import Rotation

NODES = {1: (0.0, 0.0, 0.0), 2: (0.4, 0.1, -0.2), 3: (0.7, -0.3, 0.2)}
MASS = {1: 2.0, 2: 0.7, 3: 1.3}
INERTIA = {1: (0.02, 0.03, 0.04), 2: (0.01, 0.012, 0.015), 3: (0.02, 0.02, 0.03)}


def deck(elements: str, loads: str, rest: str = "", bodies: tuple[int, ...] = (1, 2, 3)) -> str:
    """Bodies without weight, their nodes in their centres, that are turning at the start."""
    places = "".join(f" I {n} X {' '.join(map(str, NODES[n]))}\n" for n in bodies)
    masses = "".join(
        f" I {100 + n} INERTIA N {n} M {MASS[n]} J {' '.join(map(str, INERTIA[n]))}\n" for n in bodies
    )
    return f""".NOE
{places}.MCE
{masses}{elements}
.FCT
 I 1 EXPR "1+SIN(20*T)"
{rest}
.CLM
{loads}
.SAM TYPE DYNAMIC
.SUB TF 0.2 H 0.001
"""


class Drawn:
    """The points with forces in the frames of a run, and the motion of the nodes there."""

    def __init__(self, text: str, folder: Path) -> None:
        program = os.environ.get("ENGRANE", "")
        if not Path(program).is_file():
            pytest.skip("the variable ENGRANE names no program")
        (folder / "deck.dat").write_text(text)
        done = subprocess.run([program, "deck.dat", "-o", "run"], cwd=folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
        self.result = Results(folder / "run.h5")
        self.frames = [self.result.frame(i) for i in range(len(self.result.frame_times))]
        self.forces = Forces(Scene(self.result), self.frames)
        self.samples = np.searchsorted(self.result.times(), self.result.frame_times)

    def history(self, *names: str) -> np.ndarray:
        return np.stack([self.result.history(n)[1][self.samples] for n in names], axis=1)

    def places(self, node: int) -> np.ndarray:
        return self.history(*(f"node/{node}/U{c}" for c in "XYZ")) + NODES[node]

    def sums(self, node: int) -> tuple[np.ndarray, np.ndarray]:
        """Force on a node, and moment about it."""
        force, moment = np.zeros((2, len(self.frames), 3))
        center = self.places(node)
        for p in self.forces.points:
            if p.node == node:
                place = np.array([p.place(f, k) for k, f in enumerate(self.frames)])
                force += p.force
                moment += p.moment + np.cross(place - center, p.force)
        return force, moment

    def rates(self, node: int) -> tuple[np.ndarray, np.ndarray]:
        """Of momentum and angular momentum."""
        a, e, w = (self.history(*(f"node/{node}/{q}{c}" for c in "XYZ")) for q in "AEW")
        row = list(self.forces.scene.ids).index(node)
        R = np.array([Rotation.from_rotvec(f.rotation[row]).as_matrix() for f in self.frames])
        J = R @ np.diag(INERTIA[node]) @ R.transpose(0, 2, 1)
        return MASS[node] * a, np.einsum("kij,kj->ki", J, e) + np.cross(w, np.einsum("kij,kj->ki", J, w))

    def largest(self, kind: str, element: int, node: int) -> float:
        """Force or moment of one point; an error where it is not drawn."""
        (point,) = (p for p in self.forces.points if (p.kind, p.element, p.node) == (kind, element, node))
        return max(np.abs(point.force).max(), np.abs(point.moment).max())

    def balance(self, nodes: tuple[int, ...] = (1, 2, 3)) -> None:
        """Newton's iteration stops at 1e-9 of the loads; they are up to 500."""
        for node in nodes:
            for drawn, wanted in zip(self.sums(node), self.rates(node), strict=True):
                size = max(np.abs(f).max() for f in (wanted, *self.sums(node)))
                assert drawn == pytest.approx(wanted, abs=1e-8 * size)


SPIN = ".INI\n VIT NOEUD 1 C 4 5 6 V 2 -3 1.5\n VIT NOEUD 2 C 1 2 3 V 0.3 0.5 -0.2"
LOADS = """ CHA NOEUD 1 C 1 3 V 5 -8 NF 1
 CHA NOEUD 2 C 2 4 5 V 3 0.2 -0.1
 CHA NOEUD 3 C 6 V 0.5 NF 1"""


def test_free_bodies(tmp_path: Path) -> None:
    """Loads of `.CLM`, a bush away from both nodes in skew axes, stops of all kinds."""
    elements = """ I 1 BUSHING N 1 2 K 3000 2000 1000 30 20 10 C 3 3 3 .1 .1 .1 AT .25 .1 0 AXIS 1 2 3
 I 2 STOP N 2 3 MIN 0.7 K 3000 DAMP LINEAR 2
 I 3 STOP N 1 3 NORMAL 1 0.2 0 MIN 0.72 AT 0.65 -0.2 0.1 K 4000
 I 4 STOP N 2 3 AXIS 0 1 1 MIN 3 K 20"""
    drawn = Drawn(deck(elements, LOADS, SPIN), tmp_path)
    drawn.balance()
    for kind, element, nodes in (
        ("spring", 1, (1, 2)),
        ("stop", 2, (2, 3)),
        ("stop", 3, (1, 3)),
        ("stop", 4, (2, 3)),
    ):
        assert all(drawn.largest(kind, element, n) > 1 for n in nodes)
    # the loads as they are in the deck
    t = np.array(drawn.result.frame_times)
    factor = (1 + np.sin(20 * t))[:, None]
    loads = {p.node: p for p in drawn.forces.points if p.kind == "load"}
    constant = np.ones_like(factor)
    for node, force, moment in (
        (1, factor * [5, 0, -8], 0 * factor * [1, 1, 1]),
        (2, constant * [0, 3, 0], constant * [0.2, -0.1, 0]),
        (3, 0 * factor * [1, 1, 1], factor * [0, 0, 0.5]),
    ):
        assert loads[node].force == pytest.approx(force, abs=1e-12)
        assert loads[node].moment == pytest.approx(moment, abs=1e-12)


def test_bars_and_cables(tmp_path: Path) -> None:
    """Between bodies and on the ground."""
    elements = """ I 1 BAR N 1 2 EA 3000 TENSION 20 DAMPING 0.01
 I 2 CABLE N 2 3 EA 3000 TENSION 30
 I 3 CABLE N 0 3 EA 500 TENSION 10"""
    drawn = Drawn(deck(elements, LOADS, SPIN), tmp_path)
    drawn.balance()
    for element, nodes in ((1, (1, 2)), (2, (2, 3)), (3, (3,))):
        assert all(drawn.largest("spring", element, n) > 1 for n in nodes)


def test_bush_with_a_second_axis(tmp_path: Path) -> None:
    """A bush or a bearing between the ground and a body, either way round: drawn on the body only."""
    for name, card, nodes, node in (
        ("ground_a", "BUSHING", "0 1 K 300 200 100 3 2 1", 1),
        ("ground_b", "BUSHING", "2 0 K 300 200 100 3 2 1", 2),
        ("shaft", "BEARING", "0 1 K 300 200 100 0 2 1 C 0 0 0 0.1 0 0", 1),
        ("housing", "BEARING", "2 0 K 300 200 100 0 2 1", 2),
    ):
        bush = f" I 1 {card} N {nodes} AXIS 1 1 0 AXIS2 0 1 1 AT 0.1 0.2 0.3"
        folder = tmp_path / name
        folder.mkdir()
        drawn = Drawn(deck(bush, LOADS, SPIN), folder)
        drawn.balance((node,))
        assert drawn.largest("spring", 1, node) > 1
        assert all(p.node for p in drawn.forces.points)


def test_efforts_between_bodies(tmp_path: Path) -> None:
    """Motors, controllers and couplings along joints and sensors, linear relations, stops of joints and of
    bodies on the ground, a torsion spring between bodies whose axes part."""
    elements = """ I 1 HINGE N 1 0 AXIS 0 0 1 AT 0.1 0.2 0.05 MIN -20 MAX 20 KSTOP 50
 I 2 PRISMATIC N 0 2 AXIS 1 1 0.5 MIN -0.01 MAX 0.01 KSTOP 5000
 I 3 SENSOR N 2 3 DISTANCE
 I 4 SENSOR N 2 3 ANGLE AXIS 0 1 1
 I 5 SENSOR N 1 3 DISPLACEMENT AXIS 1 0 2
 I 6 STOP N 0 3 MIN 0.4 MAX 0.45 AT 0.4 -0.5 0.4 K 3000
 I 7 TSPRING N 2 3 AXIS 0 0 1 K 3
 I 8 STOP N 3 0 NORMAL 1 0 0.2 AT 0.72 -0.2 0 ON 0.7 -0.3 0.2 MIN 0.05 K 2000
 I 11 MOTOR JOINT 1 STALL 3 FREE 40 RATIO 2 NF 1
 I 12 MOTOR JOINT 4 STALL 0.4 FREE 40
 I 13 CONTROLLER IN 5 REF 0.1 KP 40 KI 10 OUT 5
 I 14 CONTROLLER IN 2 REF 0.1 KP 40 KD 1 OUT 2
 I 15 COUPLING JOINTS 3 1 RATIO 2 OFFSET -60 K 3 C 0.02
 I 16 COUPLING JOINTS 2 3 RATIO 0.5 K 30
.LIA
 I 21 NOEUD 2 3 C 1 2 A 1 -2
 I 22 NOEUD 1 3 C 6 4 A 1 3"""
    drawn = Drawn(
        deck(elements, " CHA NOEUD 2 C 1 V 30 NF 1", ".INI\n VIT NOEUD 3 C 4 5 6 V 0 4 -3"), tmp_path
    )
    drawn.balance()
    for kind, element, nodes in (
        ("joint", 1, (1,)),
        ("joint", 2, (2,)),
        ("stop", 6, (3,)),
        ("spring", 7, (2, 3)),
        ("stop", 8, (3,)),
        ("effort", 11, (1,)),
        ("effort", 12, (2, 3)),
        ("effort", 13, (1, 3)),
        ("effort", 14, (2,)),
        ("effort", 21, (2, 3)),
        ("effort", 22, (1, 3)),
    ):
        assert all(drawn.largest(kind, element, n) > 0.1 for n in nodes)
    stop = drawn.history("element/2/SLIDE_STOP")
    assert np.abs(stop).max() > 1  # it is part of the joint's force


@pytest.mark.parametrize(
    ("joint", "coordinate"),
    [
        ("HINGE N 0 1 AXIS 1 2 0 AT 0.1 0.2 -0.1", "ANGLE"),
        ("CYLINDRICAL N 0 1 AXIS 1 2 0 AT 0.1 0.2 -0.1", "SLIDE"),
        ("CYLINDRICAL N 1 0 AXIS 1 2 0 AT 0.1 0.2 -0.1", "ANGLE"),
        ("SCREW N 0 1 AXIS 1 2 0 PITCH 0.1 AT 0.1 0.2 -0.1", "ANGLE"),
        ("PLANAR N 0 1 AXIS 1 2 0", "SLIDE_2"),
        ("PLANAR N 0 1 AXIS 1 2 0 DIR 0 1 1", "SLIDE_3"),
        ("PLANAR N 1 0 AXIS 1 2 0 DIR 0 1 1 AT 0.1 0.1 0", "SLIDE_2"),
        ("PLANAR N 0 1 AXIS 1 2 0 AT 0.1 0.1 0", "ANGLE"),
        ("UNIVERSAL N 0 1 AXIS 1 0 0 AXIS2 0 1 0 AT 0.1 0.1 0", "ANGLE_1"),
        ("UNIVERSAL N 0 1 AXIS 1 0 0 AXIS2 0 1 0 AT 0.1 0.1 0", "ANGLE_2"),
        ("UNIVERSAL N 1 0 AXIS 1 0 0 AXIS2 0 1 0 AT 0.1 0.1 0", "ANGLE_2"),
        ("DISTANCE N 0 1 FROM 0.3 0.1 0 TO 0.1 0 0.1 K 40", "LENGTH"),
        ("POINT_LINE N 0 1 AXIS 1 2 0 AT 0.1 0.1 0", "SLIDE"),
        ("POINT_LINE N 1 0 AXIS 1 2 0 AT 0.1 0.1 0", "SLIDE"),
        ("POINT_PLANE N 0 1 AXIS 1 2 0 AT 0.1 0.1 0", "SLIDE_3"),
        ("POINT_CYLINDER N 0 1 AXIS 1 2 0 ON 0.3 0 0 AT 0.1 0.1 0", "ANGLE"),
        ("POINT_CYLINDER N 0 1 AXIS 1 2 0 ON 0.3 0 0 AT 0.1 0.1 0", "SLIDE"),
        ("CONSTANT_VELOCITY N 0 1 AXIS 1 0 0 AXIS2 1 0.3 0 AT 0.1 0.1 0", None),
    ],
)
def test_motors_along_every_coordinate(joint: str, coordinate: str | None, tmp_path: Path) -> None:
    """One along the coordinate that it names, another along the joint's first."""
    elements = f" I 1 {joint}"
    if coordinate:
        elements += f"\n I 2 MOTOR JOINT 1 COORDINATE {coordinate} STALL 3 FREE 40 NF 1"
        elements += "\n I 3 MOTOR JOINT 1 STALL 2 FREE 40"
    drawn = Drawn(deck(elements, " CHA NOEUD 1 C 1 2 6 V 3 4 0.2", bodies=(1,)), tmp_path)
    drawn.balance((1,))
    assert drawn.largest("joint", 1, 1) > 0.1
    if coordinate:
        assert min(drawn.largest("effort", i, 1) for i in (2, 3)) > 0.1


@pytest.mark.parametrize("follower", ["KNIFE", "ROLLER 0.02"])
def test_cam_away_from_its_followers_node(follower: str, tmp_path: Path) -> None:
    """A body that rests with a knife edge or a roller on a round cam of the ground."""
    polar = " ".join(f"{a} {0.3}" for a in range(0, 360, 20))
    radius = 0.02 if follower.startswith("ROLLER") else 0.0
    cam = f""" I 1 CAM N 0 1 AXIS 0 0 1 ZERO 1 0 0 CENTER 0.1 -0.6 0 $
 POLAR {polar} $
 FOLLOWER {follower} AT 0.1 {-0.3 + radius} 0 K 2D4 DAMP LINEAR 3
 I 2 PLANAR N 0 1 AXIS 0 0 1"""
    drawn = Drawn(deck(cam, " CHA NOEUD 1 C 2 V -40", bodies=(1,)), tmp_path)
    drawn.balance((1,))
    assert drawn.largest("cam", 1, 1) > 20


def test_frames_between_samples(tmp_path: Path) -> None:
    """Fields kept more often than histories: what acts there lies between the samples, not at the nearest."""
    text = deck("", " CHA NOEUD 1 C 1 V 5 NF 1", bodies=(1,))
    text = text.replace("H 0.001", "H 0.001 TOL 1E-4") + ".SAI HISTORY 0.02 FIELDS 0.003\n"
    drawn = Drawn(text, tmp_path)
    t, samples = np.array(drawn.result.frame_times), drawn.result.times()
    away = np.abs(np.subtract.outer(t, samples)).min(axis=1)
    assert away.max() > 0.008 and np.isin([t[0], t[-1]], samples).all()
    (load,) = (p for p in drawn.forces.points if p.kind == "load")
    exact = 5 * (1 + np.sin(20 * t))
    # straight lines between points of a curve are off by no more than h² / 8 of its second derivative
    assert load.force[:, 0] == pytest.approx(exact, abs=5 * 20**2 * 0.02**2 / 8)
    rests = away < 1e-12
    assert load.force[rests, 0] == pytest.approx(exact[rests], abs=1e-9)
