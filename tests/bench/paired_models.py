# SPDX-License-Identifier: BSD-3-Clause
"""Models that are run in two programs: their decks, and what exudyn_peer.py builds them from. SI units."""

import os
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
ENVIRONMENT = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
GRAVITY = 9.81
RHO = 0.8
LINK_INERTIA = (0.001, 0.084, 0.084)


@dataclass(frozen=True)
class Model:
    title: str
    span: float
    intervals: int  #: between the instants that are compared; divides all `steps`
    steps: tuple[int, ...]
    nodes: tuple[int, ...]  #: those measured
    static: bool = False


MODELS = {
    "crank": Model("spatial slider-crank", 2.0, 250, (500, 1000, 2000, 4000), (2, 3)),
    "chain3": Model("chain of 3 links", 2.0, 250, (500, 1000, 2000, 4000), (3,)),
    "chain20": Model("chain of 20 links", 1.0, 250, (250, 500, 1000, 2000), (20,)),
    "chain100": Model("chain of 100 links", 0.5, 125, (125, 250, 500, 1000), (100,)),
    "valves": Model("valve train", 0.012, 200, (600, 1200, 2400, 4800), (2, 4), static=True),
    "top": Model("heavy top", 0.2, 125, (125, 250, 500, 1000, 2000, 4000), (1,)),
}


def links(name: str) -> int:
    return int(name[5:]) if name.startswith("chain") else 0


def axis(link: int) -> tuple[float, float, float]:
    return (0, 1, 0) if link % 2 == 0 else (0, 0.6, 0.8)


def chain_deck(count: int) -> str:
    """Bars of 1 m and 1 kg fall from rest, joined by hinges about y and (0, 0.6, 0.8) in turn."""
    tensor = " ".join(map(str, LINK_INERTIA))
    axes = [" ".join(map(str, axis(i))) for i in range(count)]
    return "\n".join(
        [
            ".NOE",
            *(f" I {i + 1} X {i + 0.5}" for i in range(count)),
            ".MCE",
            *(f" I {i + 1} INERTIA N {i + 1} M 1 J {tensor}" for i in range(count)),
            *(f" I {count + i + 1} HINGE N {i} {i + 1} AXIS {axes[i]} AT {i} 0 0" for i in range(count)),
            f".CLM\n STRU ACC VAL 0 0 {-GRAVITY}",
            f".SAM TYPE DYNAMIC RHO {RHO}",
            ".SUB TF 1 H 0.001",
            ".FIN 1\n",
        ]
    )


#: The heavy top of decks/elements/bodies/rigid_body_top.dat as in Exudyn: the node at the centre of mass,
#: and a spherical joint. RIGID with its master at the fixed point has 13 times the error (docs/accuracy.md).
TOP = """.NOE
 I 1 X 0 1 0
.MCE
 I 1 INERTIA N 1 M 15 J 0.234375 0.46875 0.234375
 I 2 SPHERICAL N 0 1 AT 0 0 0
.CLM
 STRU ACC VAL 0 0 -9.81
.INI
 VIT NOEUD 1 C 4 5 6 V 0 150 -4.61538 IMPOSED
 VIT NOEUD 1 C 1 V 4.61538 IMPOSED
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF 0.2 H 0.0001
.FIN 1
"""


class Crank:
    """Spatial slider-crank that runs by itself under gravity: crank about z, rod with a spherical joint on
    the pin and a universal joint on the slider, which moves along x."""

    speed = 10.0  # of the crank at the start, rad/s
    masses = (2.0, 1.0, 3.0)  # crank, rod, slider
    inertias = (
        (0.1, 0.1, 0.1),
        (0.003, 0.03, 0.03),
        (0.01, 0.01, 0.01),
    )  # in axes that are those of space at the start
    pin = np.array([0.2, 0, 0])
    end = np.array([0.2 + np.sqrt(0.6**2 - 0.1**2), 0, 0.1])
    cross = np.array(
        [-0.1, 0, np.sqrt(0.6**2 - 0.1**2)]
    )  #: axis of the universal joint on the rod; y on the slider

    @classmethod
    def first_velocities(cls) -> tuple[np.ndarray, float]:
        """Angular velocity of the rod and velocity of the slider that fit the crank's."""
        pin_speed = np.cross([0, 0, cls.speed], cls.pin)
        to_pin = cls.pin - cls.end
        rows = np.zeros(
            (4, 4)
        )  # of (spin, speed): speed x + spin x to_pin = pin_speed; y . (spin x cross) = 0
        rows[:3, :3] = np.array([np.cross(unit, to_pin) for unit in np.eye(3)]).T
        rows[0, 3] = 1
        rows[3, :3] = np.cross(cls.cross, [0, 1, 0])
        found = np.linalg.solve(rows, [*pin_speed, 0])
        return found[:3], float(found[3])

    @classmethod
    def deck(cls) -> str:
        def words(values) -> str:
            return " ".join(repr(float(v)) for v in values)

        nodes = [np.zeros(3), (cls.pin + cls.end) / 2, cls.end]
        return "\n".join(
            [
                ".NOE",
                *(f" I {i + 1} X {words(x)}" for i, x in enumerate(nodes)),
                ".MCE",
                " I 1 HINGE N 0 1 AXIS 0 0 1",
                f" I 2 SPHERICAL N 1 2 AT {words(cls.pin)}",
                f" I 3 UNIVERSAL N 3 2 AXIS 0 1 0 AXIS2 {words(cls.cross)} AT {words(cls.end)}",
                " I 4 PRISMATIC N 0 3 AXIS 1 0 0",
                *(
                    f" I {11 + i} INERTIA N {i + 1} M {m} J {words(j)}"
                    for i, (m, j) in enumerate(zip(cls.masses, cls.inertias, strict=True))
                ),
                f".INI\n VIT NOEUD 1 C 6 V {cls.speed} IMPOSED",
                f".CLM\n STRU ACC VAL 0 {-GRAVITY} 0",
                f".SAM TYPE DYNAMIC RHO {RHO}",
                ".SUB TF 1 H 0.001",
                ".FIN 1\n",
            ]
        )


class Valves:
    """Cam, flat tappet, rocker with two round pads, valve with its spring, all in the plane of x and y. All
    three contacts only push, with the law of decks/mechanisms/valve_train.dat: k d + c d', never less than
    zero. The tappet leaves the cam and meets it again."""

    speed, phase, rise, dwell = 300.0, np.radians(5), np.radians(70), np.radians(20)
    lift, base, pad = 0.004, 0.018, 0.008
    pivot = np.array([0.03, 0.026, 0])
    valve = 0.075  # x
    tappet_mass, rocker_mass, rocker_inertia, valve_mass = 0.05, 0.1, 6e-5, 0.12
    small = (1e-5, 1e-5, 1e-5)
    spring, preload = 3e4, 200.0
    stiffness, damping = 5e7, 200.0

    @classmethod
    def first_displacements(cls) -> tuple[float, float, float]:
        """At rest on the base circle: the tappet downwards, the rocker's turn in the sense that opens the
        valve, the valve downwards. Pads are at the height of the pivot, so both arms have one cosine."""
        arms = cls.pivot[0], cls.valve - cls.pivot[0]
        ratio = arms[1] / arms[0]
        down = turn = valve_down = 0.0
        for _ in range(50):
            # of the spring on the valve, and of the valve on the rocker
            push = cls.preload + cls.spring * valve_down
            down = ratio * push / cls.stiffness
            turn = np.arcsin((-down - ratio * push / cls.stiffness) / arms[0])
            valve_down = arms[1] * np.sin(turn) - push / cls.stiffness
        return down, turn, valve_down

    @classmethod
    def deck(cls) -> str:
        contact = f"K {cls.stiffness} DAMP LINEAR {cls.damping}"
        rise, dwell = np.degrees(cls.rise), np.degrees(cls.dwell)
        motion = f"{rise} {cls.lift} {dwell} {cls.lift} {rise} 0 {360 - 2 * rise - dwell} 0"
        pads = " AXIS 0 0 1 CENTER {x} {y} 0 BASE {r} MOTION 360 0 FOLLOWER FLAT DIRECTION 0 -1 0 "
        x, y, _ = cls.pivot
        small = " ".join(map(str, cls.small))
        return "\n".join(
            [
                ".NOE",
                " I 1 X 0 0 0",
                f" I 2 X 0 {cls.base} 0",
                f" I 3 X {x} {y} 0",
                f" I 4 X {cls.valve} {cls.base} 0",
                ".MCE",
                " I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1",
                " I 2 PRISMATIC N 0 2 AXIS 0 1 0",
                " I 3 HINGE N 0 3 AXIS 0 0 -1",
                f" I 4 PRISMATIC N 0 4 AXIS 0 -1 0 K {cls.spring} SLIDE0 {-cls.preload / cls.spring}",
                f" I 5 CAM N 1 2 AXIS 0 0 1 BASE {cls.base} PHASE {np.degrees(cls.phase)} MOTION {motion} $",
                f"   LAW POLY345 FOLLOWER FLAT DIRECTION 0 1 0 {contact}",
                f" I 6 CAM N 3 2{pads.format(x=0, y=y, r=cls.pad)}{contact}",
                f" I 7 CAM N 3 4{pads.format(x=cls.valve, y=y, r=cls.pad)}{contact}",
                f" I 12 INERTIA N 2 M {cls.tappet_mass} J {small}",
                f" I 13 INERTIA N 3 M {cls.rocker_mass} J" + f" {cls.rocker_inertia}" * 3,
                f" I 14 INERTIA N 4 M {cls.valve_mass} J {small}",
                f'.FCT\n I 1 EXPR "{cls.speed}"',
                f".INI\n VIT NOEUD 1 C 6 V {cls.speed}",
                f".SAM TYPE DYNAMIC RHO {RHO} START STATIC",
                ".SUB TF 0.012 H 1D-5",
                ".FIN 1\n",
            ]
        )


def poly345(x):
    return x * x * x * (10.0 + x * (-15.0 + 6.0 * x))


def poly345_slope(x):
    return 30.0 * x * x * (1.0 + x * (x - 2.0))


def deck(name: str) -> str:
    if name == "top":
        return TOP
    if name.startswith("chain"):
        return chain_deck(links(name))
    return {"crank": Crank, "valves": Valves}[name].deck()


def with_steps(text: str, analysis: str, step: float, steps: int) -> str:
    """The deck without checks, with other words of `.SAM` and so many steps; the last one is archived."""
    text = re.sub(r"^\.CHK\n(?: .*\n)*", "", text, flags=re.M)
    end = steps * step
    text = re.sub(
        r"^\.SUB .*",
        f".SUB TF {end!r} H {step!r}\n.SAI FIELDS DT {end!r} HISTORY DT {end!r}",
        text,
        flags=re.M,
    )
    return re.sub(r"^\.SAM .*?( START STATIC)?$", rf".SAM TYPE DYNAMIC {analysis}\1", text, flags=re.M)
