# SPDX-License-Identifier: BSD-3-Clause
"""Plane meshes for tests and benchmarks: a sheet of boxes of one kind of cell, loads on its edges, its deck.

Nodes of a cell: its corners in turn, then the middles of its sides."""

from collections.abc import Callable

import numpy as np
from solid_meshes import Mesh

SIDES = {3: [(0, 1), (1, 2), (2, 0)], 4: [(0, 1), (1, 2), (2, 3), (3, 0)]}
# by the number of nodes: corners, and whether there are middles of sides
KINDS = {3: (3, False), 6: (3, True), 4: (4, False), 8: (4, True)}
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
CUTS = {3: [(0, 1, 2), (0, 2, 3)], 4: [(0, 1, 2, 3)]}
HYPOTHESES = {
    "stress": '.HYP MEMB BIDIM GROUP "all"\n.PHP GROUP "all" THICK VAL {thickness}',
    "strain": '.HYP DEFO PLAN GROUP "all"',
    "axis": '.HYP AXIS GROUP "all"',
}
THIN = 0.002  # thickness of gravity_strip in plane stress


class PlaneMesh(Mesh):
    """Triangles or quadrilaterals."""

    sides = SIDES

    def faces(self, where: Callable) -> list[tuple[int, int]]:
        """Cell and edge, counted from 1, of the edges whose corners are so."""
        return [
            (e + 1, k + 1)
            for e, cell in enumerate(self.cells)
            for k, (a, b) in enumerate(SIDES[self.corners])
            if where(self.unit[cell[a]]) and where(self.unit[cell[b]])
        ]

    def connectivity(self, cell: list[int]) -> str:
        """As `.MAI` has it behind N."""
        if not self.second:
            return " ".join(str(v + 1) for v in cell)
        pairs = zip(cell[: self.corners], cell[self.corners :], strict=True)
        return " ".join(f"{v + 1} -{m + 1}" for v, m in pairs)

    def names(self, where: Callable) -> str:
        """Numbers of the nodes that are so, as a deck has them."""
        return " ".join(str(i + 1) for i in self.nodes(where))

    def text(self, hypothesis: str, material: str = "YT 1000. NT 0.3") -> str:
        """A deck of one material up to its loads; the group "all" has all cells."""
        return "\n".join(
            [
                *self.deck(),
                f'.SEL GROUP 1 NOM "all" MAILLE TOUT\n.HYP {hypothesis} GROUP "all"',
                f'.MAT I 1 BEHA "ELASTIC" {material}\n.AEL GROUP "all" MAT 1',
            ]
        )

    def edge(self, cell: int, side: int) -> list[int]:
        """Nodes of an edge, counted from 0: its corners, then its middle. Cell and side count from 1."""
        nodes = self.cells[cell - 1]
        middle = [nodes[self.corners + side - 1]] if self.second else []
        return [nodes[i] for i in SIDES[self.corners][side - 1]] + middle

    def forces(self, where: Callable, traction: Callable) -> np.ndarray:
        """Forces on the nodes from a traction on edges, by Gauss' rule of 5 points along each edge as its
        nodes have it: `traction(point, outward normal)` is a force per area, the thickness 1."""
        found = np.zeros((len(self.points), 2))
        for cell, side in self.faces(where):
            nodes = self.edge(cell, side)
            inside = self.points[self.cells[cell - 1][: self.corners]].mean(axis=0)
            for s, weight in zip(*np.polynomial.legendre.leggauss(5), strict=True):
                value, slope = line_shape(s, len(nodes))
                point, tangent = value @ self.points[nodes], slope @ self.points[nodes]
                length = np.hypot(*tangent)
                normal = np.array([tangent[1], -tangent[0]]) / length
                if normal @ (point - inside) < 0:
                    normal = -normal
                found[nodes] += weight * length * np.outer(value, traction(point, normal))
        return found

    def model(
        self, hypothesis: str, young: float, poisson: float, thickness: float = 1.0, density: float = 0.0
    ) -> list[str]:
        """A deck up to the groups of nodes and edges, which are to follow: group 1 has all cells."""
        return [
            f'.MAT\n I 1 BEHA "ELASTIC" YT {young!r} NT {poisson!r}' + (f" M {density!r}" if density else ""),
            *self.deck(),
            '.SEL\n GROUP 1 MAILLES NOM "all" TOUT',
            HYPOTHESES[hypothesis].format(thickness=thickness),
            '.AEL\n GROUP "all" MAT 1',
            ".SEL",
        ]


class Sheet(PlaneMesh):
    """`boxes`: how many along x and y; `nodes` of a cell: 3, 6, 4 or 8. Diagonals of triangles alternate, or
    run all one way."""

    def __init__(self, boxes, nodes: int, place: Callable, curved: bool = False, alternating: bool = True):
        corners, second = KINDS[nodes]
        cells = []
        for j, i in np.ndindex(boxes[1], boxes[0]):
            mirror = alternating and corners == 3 and (i + j) % 2
            box = [((i + (1 - a if mirror else a)) / boxes[0], (j + b) / boxes[1]) for a, b in SQUARE]
            cells += [[box[q] for q in cut] for cut in CUTS[corners]]
        super().__init__(cells, second, place, curved)


def line_shape(s: float, nodes: int) -> tuple[np.ndarray, np.ndarray]:
    """Shape functions of an edge of 2 or 3 nodes, the ends first, and their slopes; s from -1 to 1."""
    if nodes == 2:
        return np.array([1 - s, 1 + s]) / 2, np.array([-0.5, 0.5])
    return np.array([s * (s - 1) / 2, s * (s + 1) / 2, 1 - s * s]), np.array([s - 0.5, s + 0.5, -2 * s])


def nodal_forces(forces: np.ndarray) -> list[str]:
    """Records of `.CLM` for forces on nodes, a row of components for each node."""
    return [
        f" NOEUD {node + 1} CHA C {component + 1} V {forces[node, component]:.16g}"
        for node, component in np.argwhere(forces)
    ]


def gravity_strip(boxes, nodes: int, hypothesis: str) -> tuple[Sheet, list[str], np.ndarray, np.ndarray]:
    """A bent strip, or a bent ring, clamped at one end (within), under weight and forces at the nodes of the
    other: its mesh and deck, forces on nodes, the acceleration of gravity. tests/bench/calculix.py gives the
    same to CalculiX. In plane stress it is thin, see there."""

    def place(u):
        x, y = u
        return np.array(
            [
                1 + 10 * x + 0.3 * np.sin(3 * x) * np.sin(np.pi * y),
                1.5 * y + 0.3 * x * y + 0.2 * x * x + 0.06 * np.sin(np.pi * y) * np.cos(5 * x),
            ]
        )

    mesh, thickness = Sheet(boxes, nodes, place), THIN if hypothesis == "stress" else 1.0
    end = mesh.nodes(lambda u: u[0] == 1)
    forces = np.zeros_like(mesh.points)
    forces[end] = np.array([50, -100]) * thickness / len(end)
    gravity = np.array([0, -1e8] if hypothesis == "axis" else [0.6e8, -0.8e8])
    deck = [
        *mesh.model(hypothesis, 210000.0, 0.3, thickness, 7.8e-9),
        mesh.group(2, "wall", mesh.nodes(lambda u: u[0] == 0)),
        '.CLM\n GROUP "wall" FIX C 1 2',
        f" STRU ACC VAL {gravity[0]} {gravity[1]} 0.",
        *nodal_forces(forces),
        ".FIN 1",
    ]
    return mesh, deck, forces, gravity


def ring_means(mesh: Sheet, ring: bool) -> np.ndarray:
    """Factors of displacements, by nodes and components, for what CalculiX prints of axisymmetric cells. It
    has wedges of 2 degrees, at whose ends a radial displacement u is u cos 1° along x, and prints means over
    the nodes of an arc: two for a mid-side node; of the three for a corner the lack is a third, as found by
    comparing. What is left falls with the size of cells."""
    factors = np.ones((len(mesh.points), 3))
    if ring:
        less = 1 - np.cos(np.pi / 180)
        factors[:, 0] -= less
        for cell in mesh.cells:
            factors[cell[: mesh.corners], 0] = 1 - less / 3
    return factors
