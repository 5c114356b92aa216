# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of solids for tests and benchmarks: a block of boxes, cut into cells of one shape, and its deck.

Nodes of a cell stand in the order of VTK: corners of the base, of the top, then the middles of the sides in
the order of SIDES."""

from collections.abc import Callable

import numpy as np

# by the number of corners
SIDES = {
    4: [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    6: [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    8: [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)],
}
FACES = {
    4: [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    6: [(0, 2, 1), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5), (3, 4, 5)],
    8: [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7)],
}
BOX = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
# right-handed cuts of a box, and of its mirror image in x: the cuts of neighbours meet
CUTS = {
    4: [(0, 1, 3, 4), (1, 2, 3, 6), (1, 3, 4, 6), (1, 4, 5, 6), (3, 4, 6, 7)],
    6: [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)],
    8: [tuple(range(8))],
}
MIRRORED = {4: (0, 2, 1, 3), 6: (0, 2, 1, 3, 5, 4), 8: (0, 3, 2, 1, 4, 7, 6, 5)}


class Mesh:
    """Cells of one shape, given by the places of their corners in the unit square or cube, and `place` from
    there to space. Middles of sides are put there too where `curved`, else between their corners."""

    sides: dict[int, list[tuple[int, int]]]  # by the number of corners

    def __init__(self, cells, second: bool, place: Callable, curved: bool = False):
        self.corners, self.second = len(cells[0]), second
        known: dict[tuple, int] = {}
        unit: list[np.ndarray] = []

        def node(x) -> int:
            key = tuple(np.round(x, 9))
            if key not in known:
                known[key] = len(unit)
                unit.append(np.asarray(x, dtype=float))
            return known[key]

        middles = self.sides[self.corners] if second else []
        self.cells = [[*map(node, at), *(node(np.add(at[a], at[b]) / 2) for a, b in middles)] for at in cells]
        self.unit = np.array(unit)
        self.points = np.array([place(x) for x in self.unit])
        for cell in self.cells if not curved else []:
            for (a, b), middle in zip(middles, cell[self.corners :], strict=True):
                self.points[middle] = (self.points[cell[a]] + self.points[cell[b]]) / 2

    def nodes(self, where: Callable) -> np.ndarray:
        """Indices of the nodes whose places in the unit square or cube are so."""
        return np.flatnonzero([where(x) for x in self.unit])

    def deck(self) -> list[str]:
        """`.NOE` and `.MAI`."""
        lines = [".NOE"]
        for i, point in enumerate(self.points, 1):
            lines.append(f" I {i} " + " ".join(f"{c} {x:.16g}" for c, x in zip("XYZ", point, strict=False)))
        lines += [".MAI"]
        return lines + [f" I {e} AT 1 0 N {self.connectivity(cell)}" for e, cell in enumerate(self.cells, 1)]

    def group(self, number: int, name: str, nodes) -> str:
        rows = [" ".join(str(i + 1) for i in nodes[k : k + 20]) for k in range(0, len(nodes), 20)]
        return f' GROUP {number} NOM "{name}" NOEUDS\n  ' + "\n  ".join(rows)

    def group_of_faces(self, number: int, name: str, where: Callable) -> list[str]:
        return [f' GROUP {number} NOM "{name}" FACES', *(f"  I {e} {f}" for e, f in self.faces(where))]


class SolidMesh(Mesh):
    """Tetrahedra, wedges or hexahedra."""

    sides = SIDES

    def faces(self, where: Callable) -> list[tuple[int, int]]:
        """Cell and face, counted from 1, of the faces whose corners are so."""
        return [
            (e + 1, f + 1)
            for e, cell in enumerate(self.cells)
            for f, face in enumerate(FACES[self.corners])
            if all(where(self.unit[cell[i]]) for i in face)
        ]

    def spread(self, where: Callable, force) -> np.ndarray:
        """Forces on the nodes from a force spread evenly over flat faces, triangles and parallelograms, with
        the shape functions of the cell."""
        found = np.zeros_like(self.points)
        total = 0.0
        for cell, face in self.faces(where):
            nodes, at = self.cells[cell - 1], FACES[self.corners][face - 1]
            a, b, c = (self.points[nodes[i]] for i in at[:3])
            area = np.linalg.norm(np.cross(b - a, c - a)) * (0.5 if len(at) == 3 else 1)
            corner = (0.0 if len(at) == 3 else -1 / 12) if self.second else 1 / len(at)
            found[[nodes[i] for i in at]] += corner * area * np.asarray(force)
            for k, (i, j) in enumerate(SIDES[self.corners] if self.second else []):
                if i in at and j in at:
                    found[nodes[self.corners + k]] += area / 3 * np.asarray(force)
            total += area
        return found / total

    def connectivity(self, cell: list[int]) -> str:
        """As `.MAI` has it behind N."""
        n = [v + 1 for v in cell]
        base = 4 if self.corners == 8 else 3
        top = self.corners - base
        first, last = n[:base], n[base : self.corners]
        if not self.second:
            return f"{' '.join(map(str, first))} 0 {' '.join(map(str, last))}"
        middles = n[self.corners :]
        upright = middles[base:] if top == 1 else middles[2 * base :]
        above = (
            [str(last[0])] if top == 1 else [f"{v} -{m}" for v, m in zip(last, middles[base:], strict=False)]
        )
        below = [f"{v} -{m}" for v, m in zip(first, middles, strict=False)]
        return f"{' '.join(below)} 0 {' '.join(f'-{v}' for v in upright)} 0 {' '.join(above)}"


class Block(SolidMesh):
    """`boxes`: how many along x, y, z; the rest as for any mesh."""

    def __init__(self, boxes, corners: int, second: bool, place: Callable, curved: bool = False):
        cells = []
        for k, j, i in np.ndindex(boxes[2], boxes[1], boxes[0]):
            mirror = (i + j + (k if corners == 4 else 0)) % 2
            box = [
                ((i + (1 - a if mirror else a)) / boxes[0], (j + b) / boxes[1], (k + c) / boxes[2])
                for a, b, c in BOX
            ]
            order = MIRRORED[corners] if mirror else range(corners)
            cells += [[box[cut[q]] for q in order] for cut in CUTS[corners]]
        super().__init__(cells, second, place, curved)


def gravity_beam(boxes, corners: int, second: bool) -> tuple[Block, list[str], np.ndarray]:
    """A bent and twisted beam, clamped at one end, under weight and forces at the nodes of the other, which
    are given back too; tests/bench/calculix.py gives the same to CalculiX."""

    def place(u):
        x, y, z = u
        return np.array(
            [
                10 * x + 0.18 * np.sin(3 * x) * np.sin(np.pi * y) * np.sin(np.pi * z),
                1.5 * y + 0.3 * x * y + 0.06 * np.sin(np.pi * y) * np.cos(5 * x),
                z + 0.2 * x * x,
            ]
        )

    block = Block(boxes, corners, second, place)
    loaded = block.nodes(lambda u: u[0] == 1)
    deck = [
        *block.deck(),
        ".SEL",
        block.group(1, "wall", block.nodes(lambda u: u[0] == 0)),
        block.group(2, "end", loaded),
        '.MAT\n I 1 BEHA "ELASTIC" YT 210000. NT 0.3 M 7.8E-9',
        f".AEL\n I 1 J {len(block.cells)} K 1 MAT 1",
        '.CLM\n GROUP "wall" FIX C 1 2 3\n STRU ACC VAL 0. 0.6E8 -0.8E8',
        f' GROUP "end" CHA C 1 3 V ({50}/{len(loaded)}) ({-100}/{len(loaded)})',
        ".FIN 1",
    ]
    return block, deck, loaded
