# SPDX-License-Identifier: BSD-3-Clause
"""The kinds of cells: how VTK and meshio number their nodes, which faces they have, and how results (XDMF's
codes, docs/format.md) and decks (`.MAI`) write them.

Nodes are numbered as VTK does it: the corners of the base, those of the top, the middles of the sides of the
base, of the top, and of those between. Seen from the top the base runs anticlockwise, as a plane cell does
seen from +z."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np


@dataclass(frozen=True)
class Kind:
    """One kind: meshio's name, words for messages, codes of VTK and XDMF, corners, nodes and dimension."""

    name: str
    words: str
    vtk: int
    xdmf: int
    dimension: int
    corners: int
    #: the corners at both ends of each mid-side node, in their order; () for first order
    middles: tuple[tuple[int, int], ...]
    #: corners of each face: of a solid the base, those on the sides of the base in turn, the top; of a plane
    #: cell its edges in turn. Seen from outside faces of solids run anticlockwise.
    faces: tuple[tuple[int, ...], ...]
    #: the record of `.MAI`: node numbers from 1, mid-side nodes below zero, 0 between the parts of a solid
    row: tuple[int, ...]
    #: the nodes in the order of the mirrored cell
    mirror: tuple[int, ...]

    @property
    def nodes(self) -> int:
        return self.corners + len(self.middles)

    @cached_property
    def polygons(self) -> tuple[tuple[int, ...], ...]:
        """The outline of each face with its mid-side nodes; of a plane cell the only one is its own."""
        between = {frozenset(ends): self.corners + i for i, ends in enumerate(self.middles)}
        loops = self.faces if self.dimension == 3 else (tuple(range(self.corners)),)
        out = []
        for loop in loops:
            nodes: list[int] = []
            for a, b in zip(loop, loop[1:] + loop[:1], strict=True):
                nodes += [a, between[frozenset((a, b))]] if between else [a]
            out.append(tuple(nodes))
        return tuple(out)

    @cached_property
    def face_nodes(self) -> tuple[tuple[int, ...], ...]:
        """All nodes of each face or, of a plane cell, of each edge."""
        between = {frozenset(ends): self.corners + i for i, ends in enumerate(self.middles)}
        if self.dimension == 3:
            return self.polygons
        return tuple((*f, between[frozenset(f)]) if between else f for f in self.faces)


EDGES3 = ((0, 1), (1, 2), (2, 0))
EDGES4 = ((0, 1), (1, 2), (2, 3), (3, 0))
TETRA = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))
WEDGE = ((0, 2, 1), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5), (3, 4, 5))
BRICK = ((0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7))
SIDES_OF_TETRA = (*EDGES3, (0, 3), (1, 3), (2, 3))
SIDES_OF_WEDGE = (*EDGES3, (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))
SIDES_OF_BRICK = (*EDGES4, (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))

KINDS = (
    Kind("triangle", "triangles", 5, 4, 2, 3, (), EDGES3, (1, 2, 3), (0, 2, 1)),
    Kind("quad", "quadrilaterals", 9, 5, 2, 4, (), EDGES4, (1, 2, 3, 4), (0, 3, 2, 1)),
    Kind(
        "triangle6",
        "triangles of 6 nodes",
        22,
        36,
        2,
        3,
        EDGES3,
        EDGES3,
        (1, -4, 2, -5, 3, -6),
        (0, 2, 1, 5, 4, 3),
    ),
    Kind(
        "quad8",
        "quadrilaterals of 8 nodes",
        23,
        37,
        2,
        4,
        EDGES4,
        EDGES4,
        (1, -5, 2, -6, 3, -7, 4, -8),
        (0, 3, 2, 1, 7, 6, 5, 4),
    ),
    Kind("tetra", "tetrahedra", 10, 6, 3, 4, (), TETRA, (1, 2, 3, 0, 4), (0, 2, 1, 3)),
    Kind("wedge", "wedges", 13, 8, 3, 6, (), WEDGE, (1, 2, 3, 0, 4, 5, 6), (0, 2, 1, 3, 5, 4)),
    Kind(
        "hexahedron",
        "hexahedra",
        12,
        9,
        3,
        8,
        (),
        BRICK,
        (1, 2, 3, 4, 0, 5, 6, 7, 8),
        (0, 3, 2, 1, 4, 7, 6, 5),
    ),
    Kind(
        "tetra10",
        "tetrahedra of 10 nodes",
        24,
        38,
        3,
        4,
        SIDES_OF_TETRA,
        TETRA,
        (1, -5, 2, -6, 3, -7, 0, -8, -9, -10, 0, 4),
        (0, 2, 1, 3, 6, 5, 4, 7, 9, 8),
    ),
    Kind(
        "wedge15",
        "wedges of 15 nodes",
        26,
        40,
        3,
        6,
        SIDES_OF_WEDGE,
        WEDGE,
        (1, -7, 2, -8, 3, -9, 0, -13, -14, -15, 0, 4, -10, 5, -11, 6, -12),
        (0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13),
    ),
    Kind(
        "hexahedron20",
        "hexahedra of 20 nodes",
        25,
        48,
        3,
        8,
        SIDES_OF_BRICK,
        BRICK,
        (1, -9, 2, -10, 3, -11, 4, -12, 0, -17, -18, -19, -20, 0, 5, -13, 6, -14, 7, -15, 8, -16),
        (0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17),
    ),
)
BY_NAME = {kind.name: kind for kind in KINDS}
#: nodes of what else a file may hold
OTHERS = {"vertex": 1, "line": 2, "line3": 3, "quad9": 9, "pyramid": 5, "pyramid13": 13}
BY_XDMF = {kind.xdmf: kind for kind in KINDS}

#: XDMF's other codes with a fixed number of nodes: what a reader must be able to step over
OTHER_SIZES = {7: 5, 34: 3, 35: 9, 39: 13, 41: 18, 49: 24}
COUNTED = (1, 2, 3)


def dimension_of(name: str) -> int:
    """Of meshio's name of any kind; of an unknown one 3, so that nothing is lost in silence."""
    for start, dimension in (("vertex", 0), ("line", 1), ("triangle", 2), ("quad", 2), ("polygon", 2)):
        if name.lower().startswith(start):
            return dimension
    return 3


def nodes_of(name: str) -> int | None:
    """How many nodes a cell of meshio's name has; None when that is not known."""
    known = BY_NAME.get(name)
    return known.nodes if known else OTHERS.get(name)


def corners_of(name: str) -> int:
    """How many of the nodes of a line, triangle or quadrilateral of any order are corners: the first ones."""
    return {"line": 2, "tria": 3}.get(name[:4], 4)


@dataclass(frozen=True)
class Run:
    """Cells of one code that follow each other in a mixed topology: the number of the first, and their nodes,
    a row for each."""

    code: int
    first: int
    nodes: np.ndarray


def runs(topology: np.ndarray) -> list[Run]:
    """The cells of an XDMF mixed topology; stops where the array is cut or a code is unknown."""
    data = np.ravel(topology).astype(np.int64)
    sizes = {k.xdmf: k.nodes for k in KINDS} | OTHER_SIZES
    out: list[Run] = []
    at = first = 0
    while at < len(data):
        code = int(data[at])
        if code in COUNTED and at + 1 < len(data):
            head, size = (0, 1), int(data[at + 1])
        elif code in sizes:
            head, size = (0,), sizes[code]
        else:
            break
        if size < 0 or at + len(head) + size > len(data):
            break
        table = alike(data[at:], head, len(head) + size)
        out.append(Run(code, first, table[:, len(head) :]))
        at += table.size
        first += len(table)
    return out


def alike(data: np.ndarray, columns: tuple[int, ...], width: int) -> np.ndarray:
    """The records of this width at the beginning of `data` whose columns are those of the first, a row for
    each: when one is, the next begins behind it. Looks ahead twice as far each time, so that many short runs
    cost little."""
    count, most = 1, len(data) // width
    head = data[list(columns)]
    look = 8
    while count < most:
        table = data[: min(look, most) * width].reshape(-1, width)
        other = np.flatnonzero((table[count:, list(columns)] != head).any(axis=1))
        if len(other):
            count += int(other[0])
            break
        count = len(table)
        look *= 2
    return data[: count * width].reshape(-1, width)


def outer_faces(found: list[Run], place: np.ndarray | None = None) -> list[tuple[np.ndarray, np.ndarray]]:
    """What is seen of cells: plane cells, and the faces of solids that belong to one solid only; points with
    the same `place` are one. Tables of polygons with as many points each, and for each polygon the number of
    its cell."""
    out: list[tuple[np.ndarray, np.ndarray]] = []
    solids = [(r, BY_XDMF[r.code]) for r in found if r.code in BY_XDMF and BY_XDMF[r.code].dimension == 3]
    for run in found:
        kind = BY_XDMF.get(run.code)
        if kind is not None and kind.dimension == 2:
            out.append((run.nodes[:, list(kind.polygons[0])], run.first + np.arange(len(run.nodes))))
    for size in (3, 4):
        faces = [
            (run, corners, polygon)
            for run, kind in solids
            for corners, polygon in zip(kind.faces, kind.polygons, strict=True)
            if len(corners) == size
        ]
        if not faces:
            continue
        met = np.concatenate([run.nodes[:, list(corners)] for run, corners, _ in faces])
        single = _met_once(met if place is None else place[met])
        at = 0
        for run, _, polygon in faces:
            mine = np.flatnonzero(single[at : at + len(run.nodes)])
            at += len(run.nodes)
            if len(mine):
                out.append((run.nodes[mine][:, list(polygon)], run.first + mine))
    return out


def _met_once(corners: np.ndarray) -> np.ndarray:
    """Which of the faces with these corners have no other with the same ones. Three tell a face."""
    low = np.sort(corners, axis=1)[:, :3].astype(np.int64)
    bits = max(1, int(low.max(initial=0)).bit_length())
    if 3 * bits <= 63:
        key = (low[:, 0] << 2 * bits) | (low[:, 1] << bits) | low[:, 2]
    else:
        _, key = np.unique(low, axis=0, return_inverse=True)
        key = np.ravel(key)
    _, where, times = np.unique(key, return_inverse=True, return_counts=True)
    return times[np.ravel(where)] == 1
