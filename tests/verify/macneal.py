# SPDX-License-Identifier: BSD-3-Clause
"""The beams of R. H. MacNeal and R. L. Harder (1985), A proposed standard set of problems to test finite
element accuracy, Finite Elements in Analysis and Design 1, 3-20: straight, curved and twisted, one row of
cells, clamped at one end, a unit force spread evenly over the other. What is given back is the displacement
of a corner there in the direction of the force, as a share of theory's: in trapezia, parallelograms and the
curved beam the end turns, and corners differ by some per cent."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
from cell_problems import solve
from plane_meshes import Sheet, nodal_forces
from solid_meshes import Block

SOLIDS = {"T10": (4, True), "W6": (6, False), "W15": (6, True), "H8": (8, False), "H20": (8, True)}
SHAPES = ("rectangles", "trapezia", "parallelograms")
# E, nu, and the theory of MacNeal and Harder for each load; along x, in the plane x y, across it, and torsion
STRAIGHT = (1e7, 0.3, {"extension": 3.0e-5, "in plane": 0.1081, "out of plane": 0.4321, "twist": 0.03208})
CURVED = (1e7, 0.25, {"in plane": 0.08734, "out of plane": 0.5022})
TWISTED = (29e6, 0.22, {"in plane": 0.005424, "out of plane": 0.001754})
AXES = {"extension": 0, "in plane": 1, "out of plane": 2}

LOADS = tuple(STRAIGHT[2])


def straight_place(shape: str):
    """6 long, 0.2 high, 0.1 thick; sides between cells lean by 45 degrees, in turn or all one way."""

    def place(u):
        line = round(6 * u[0])
        lean = 0.1 * (2 * u[1] - 1) if 0 < line < 6 else 0
        sign = {"rectangles": 0, "trapezia": (-1) ** (line + 1), "parallelograms": 1}[shape]
        return np.array([6 * u[0] + sign * lean, 0.2 * u[1], *(0.1 * c for c in u[2:])])

    return place


def curved_place(u):
    """A quarter of a ring between the radii 4.12 and 4.32, 0.1 thick; the free end is on the x axis."""
    radius, angle = 4.12 + 0.2 * u[1], np.pi / 2 * (1 - u[0])
    return np.array([radius * np.cos(angle), -radius * np.sin(angle), *(0.1 * c for c in u[2:])])


def twisted_place(u):
    """12 long, 1.1 by 0.32, turned by 90 degrees; at the free end the width lies along y."""
    angle = np.pi / 2 * (u[0] - 1)
    y, z = 1.1 * (u[1] - 0.5), 0.32 * (u[2] - 0.5)
    return np.array([12 * u[0], y * np.cos(angle) - z * np.sin(angle), y * np.sin(angle) + z * np.cos(angle)])


def tip(mesh, model: list[str], force: np.ndarray, folder: Path) -> np.ndarray:
    """Displacements of all nodes under nodal forces."""
    components = "1 2 3" if mesh.points.shape[1] == 3 else "1 2"
    deck = [
        *model,
        mesh.group(2, "wall", mesh.nodes(lambda u: u[0] == 0)),
        f'.CLM\n GROUP "wall" FIX C {components}',
        *nodal_forces(force),
    ]
    return solve(deck, folder)


def corner(mesh, *at: int) -> int:
    """The node there in the unit square or cube."""
    (node,) = mesh.nodes(lambda u: tuple(u) == at)
    return node


def solid_model(block: Block, young: float, poisson: float) -> list[str]:
    return [
        f'.MAT\n I 1 BEHA "ELASTIC" YT {young!r} NT {poisson!r}',
        *block.deck(),
        f".AEL\n I 1 J {len(block.cells)} K 1 MAT 1",
        ".SEL",
    ]


def twist(block: Block, model: list[str], folder: Path) -> float:
    """Angle of the straight beam's end under a couple of forces across it at its corners, from their way."""
    force = np.zeros_like(block.points)
    for y, z in np.ndindex(2, 2):
        force[corner(block, 1, y, z), 2] = (2 * y - 1) / 2 / 0.2
    found = tip(block, model, force, folder)
    return float(found[corner(block, 1, 1, 1), 2] - found[corner(block, 1, 0, 1), 2]) / 0.2


def plane_beam(
    name: str, nodes: int, load: str, folder: Path, shape: str = "rectangles", finer: int = 1
) -> float:
    """The straight or the curved beam of 6 plane cells, or of triangles that fill the same boxes, or with
    `finer` times as many boxes along each side."""
    young, poisson, theory = STRAIGHT if name == "straight" else CURVED
    place = straight_place(shape) if name == "straight" else curved_place
    mesh = Sheet((6 * finer, finer), nodes, place, curved=name == "curved")
    axis = AXES[load] if name == "straight" else 0
    force = mesh.forces(lambda u: u[0] == 1, lambda x, n: np.eye(2)[axis] / 0.2)
    found = tip(mesh, mesh.model("stress", young, poisson, 0.1), force, folder)
    return float(found[corner(mesh, 1, 1), axis] / theory[load])


def solid_beam(
    name: str, kind: str, load: str, folder: Path, shape: str = "rectangles", finer: int = 1
) -> float:
    """The straight and the curved beam of 6 boxes, the twisted one of 12 x 2 x 1, or `finer` times as many
    along each side."""
    place = {"straight": straight_place(shape), "curved": curved_place, "twisted": twisted_place}[name]
    young, poisson, theory = {"straight": STRAIGHT, "curved": CURVED, "twisted": TWISTED}[name]
    boxes = (12, 2, 1) if name == "twisted" else (6, 1, 1)
    block = Block([finer * n for n in boxes], *SOLIDS[kind], place, curved=name != "straight")
    model = solid_model(block, young, poisson)
    if load == "twist":
        return twist(block, model, folder) / theory[load]
    axis = 0 if name == "curved" and load == "in plane" else AXES[load]
    found = tip(block, model, block.spread(lambda u: u[0] == 1, np.eye(3)[axis]), folder)
    return float(found[corner(block, 1, 1, 1), axis] / theory[load])


def orders_of_changes(shares: list[float]) -> list[float]:
    """Of meshes each twice as fine as the one before; their limit is not that of the theory of beams."""
    changes = np.diff(shares)
    return [float(np.log2(a / b)) for a, b in pairwise(changes)]
