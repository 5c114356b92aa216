# SPDX-License-Identifier: BSD-3-Clause
"""A gear wheel of hexahedra for tests and decks: hub, thin web, rim, and involute teeth where it meshes.

    python3 tests/gear_meshes.py > decks/mechanisms/meshed_gear.dat
    python3 tests/gear_meshes.py 2          twice as fine in all directions

The wheel stands at the origin with its axle along z, and its pinion on the x axis. The flank that carries the
load passes through the pitch point. Lengths in mm, forces in N."""

import sys
from itertools import pairwise

import numpy as np
from solid_meshes import SolidMesh

TEETH, PINION, MODULE, ALPHA = 40, 20, 2.0, np.radians(20)
PITCH = TEETH * MODULE / 2
BASE = PITCH * np.cos(ALPHA)
ROOT, TIP = PITCH - 1.25 * MODULE, PITCH + MODULE
BORE, HUB, RIM = 10.0, 16.0, 32.0  # radii: of the bore, where the web begins and where it ends
WEB, WIDTH = 8.0, 20.0
MESHED = 3  # teeth that the mesh has
YOUNG, POISSON, TORQUE = 2.1e5, 0.3, 2e4


def involute(angle: float) -> float:
    return np.tan(angle) - angle


def half_angle(radius: float) -> float:
    """Half of the angle that a tooth without profile shift fills; below the base circle flanks are radial."""
    at = max(radius, BASE)
    return np.pi / (2 * TEETH) + involute(ALPHA) - involute(np.arccos(BASE / at))


def subdivide(values, fine: int) -> np.ndarray:
    parts = [np.linspace(a, b, fine, endpoint=False) for a, b in pairwise(values)]
    return np.append(np.concatenate(parts), values[-1])


class Gear(SolidMesh):
    """`fine` times as many cells in each direction as the coarsest mesh has."""

    def __init__(self, fine: int = 1):
        pitch = 2 * np.pi / TEETH
        loaded = -np.pi / (2 * TEETH)  # middle of the tooth in mesh: its flank at +y passes the pitch point
        half = half_angle(ROOT)
        teeth = [loaded + k * pitch for k in range(-(MESHED // 2), MESHED // 2 + 1)]
        marks = [a for t in teeth for a in (t - half, t, t + half)]
        rest = 2 * np.pi - (marks[-1] - marks[0])
        marks += list(marks[-1] + rest * np.arange(1, TEETH - MESHED + 1) / (TEETH - MESHED + 1))
        angles = subdivide([*marks, marks[0] + 2 * np.pi], fine)
        heights = subdivide([-WIDTH / 2, -WEB / 2, 0, WEB / 2, WIDTH / 2], fine)
        radii = subdivide([BORE, 13.0, HUB, *np.linspace(HUB, RIM, 6)[1:], 34.75, ROOT], fine)
        cells = []

        def layers(inner, outer, inside):
            """Cells between four points of the plane, over the heights."""
            a, b = inner
            d, c = outer
            for low, high in pairwise(heights):
                if inside(0.5 * (low + high)):
                    cells.append([(*p, z) for z in (low, high) for p in (a, d, c, b)])

        def at(r, angle):
            return r * np.cos(angle), r * np.sin(angle)

        for r, s in pairwise(radii):
            web = r > HUB - 1e-9 and s < RIM + 1e-9
            for p, q in pairwise(angles):
                layers(
                    (at(r, p), at(r, q)),
                    (at(s, p), at(s, q)),
                    lambda z, web=web: not web or abs(z) < WEB / 2,
                )
        flank = subdivide([ROOT, 38.75, PITCH, 41.25, TIP], fine)
        across = np.linspace(-1, 1, 2 * fine + 1)
        for tooth in teeth:
            for r, s in pairwise(flank):
                for p, q in pairwise(across):
                    below = [at(r, tooth + half_angle(r) * u) for u in (p, q)]
                    above = [at(s, tooth + half_angle(s) * u) for u in (p, q)]
                    layers(below, above, lambda z: True)
        super().__init__(cells, False, lambda x: x)
        radius, angle = np.hypot(*self.points.T[:2]), np.arctan2(self.points[:, 1], self.points[:, 0])
        self.bore = np.flatnonzero(np.abs(radius - BORE) < 1e-6)
        on_flank = [
            38.75 - 1e-6 < r < 41.25 + 1e-6 and abs(a - loaded - half_angle(r)) < 1e-6
            for r, a in zip(radius, angle, strict=True)
        ]
        self.patch = np.flatnonzero(on_flank)
        # a pressure that is even over the width and along the flank: by the lengths next to each node
        self.weights = tributary(self.points[self.patch, 2]) * tributary(radius[self.patch])


def tributary(values: np.ndarray) -> np.ndarray:
    levels = np.unique(np.round(values, 6))
    step = np.diff(levels)
    share = np.append(step, 0) + np.insert(step, 0, 0)
    return share[np.searchsorted(levels, np.round(values, 6))] / 2


def deck(fine: int = 1) -> str:
    mesh = Gear(fine)
    wheel, centre, pinion, cell = (f"{k}00001" for k in (1, 2, 3, 9))
    rows = mesh.deck()
    places = [f" I {n} X {x} Y 0 Z 0" for n, x in ((wheel, 0), (centre, 0), (pinion, 60))]
    weights = [
        " ".join(f"{w:.6g}" for w in mesh.weights[k : k + 15]) for k in range(0, len(mesh.weights), 15)
    ]
    return "\n".join(
        [
            "! A gear wheel of solids: the bore follows a node on a hinge (RIGID_LINK); the node of the",
            "! GEAR follows a flank (MEAN_LINK), weighted as an even pressure over its middle, so that the",
            "! tooth force enters at its tooth. The teeth next to it are there too. The other member is a",
            f"! rigid pinion with a torque. Written by tests/gear_meshes.py; {len(mesh.points)} nodes.",
            "! tests/verify/test_meshed_gear.py compares twist and stresses of the web with closed forms.",
            '.TITRE "gear wheel of solids"',
            ".UNIT LENGTH 0.001 MASS 1000. TIME 1.",
            f"ABRE '/torque' '{TORQUE:g}'",
            "ABRE '/base' '(40*cos(PI/9))'",
            rows[0],
            *places,
            *rows[1:],
            ".SEL",
            mesh.group(1, "bore", mesh.bore),
            mesh.group(2, "flank", mesh.patch),
            f'.MAT\n I 1 BEHA "ELASTIC" YT {YOUNG:g} NT {POISSON} M 7.85E-9',
            f".AEL\n I 1 J {len(mesh.cells)} K 1 MAT 1",
            ".MCE",
            f" I {cell} HINGE N 0 {wheel} AXIS 0 0 1 DRIVE ANGLE NF 1",
            f' I {int(cell) + 1} RIGID_LINK N {wheel} GROUP "bore"',
            f' I {int(cell) + 2} MEAN_LINK N {centre} GROUP "flank"\n  W ' + "\n    ".join(weights),
            f" I {int(cell) + 3} HINGE N 0 {pinion} AXIS 0 0 1",
            f" I {int(cell) + 4} GEAR N {centre} {pinion} KIND SPUR Z {TEETH} {PINION} DISTANCE 60"
            " AXIS 0 0 1",
            f" I {int(cell) + 5} TORQUE N {pinion} AXIS 0 0 1 V (/torque/2)",
            ".FCT\n I 1 TABLE 0 0  1 0",
            ".SAM TYPE STATIC DISPLACEMENTS LARGE",
            ".SUB TF 1 H 1",
            ".CHK",
            f' ELEMENT {int(cell) + 4} NORMAL_FORCE V (/torque/(/base)) RTOL 1E-9 REF "F = T/r_b"',
            "! the centre of the teeth follows the flank, 5 um from the hinge, and the force has another arm",
            f' ELEMENT {cell} DRIVE_TORQUE V (/torque) RTOL 6E-5 REF "ratio of teeth"',
            f' ELEMENT {int(cell) + 2} FORCE_Y V (-/torque/40) RTOL 5E-5 REF "tangential force"',
            f' ELEMENT {int(cell) + 2} FORCE_X V (-/torque/40*tan(PI/9)) RTOL 3E-4 REF "radial force"',
            ".FIN 1\n",
        ]
    )


if __name__ == "__main__":
    sys.stdout.write(deck(int(sys.argv[1]) if len(sys.argv) > 1 else 1))
