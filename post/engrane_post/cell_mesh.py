# SPDX-License-Identifier: BSD-3-Clause
"""Makes of a mesh file what a deck can say: cells of the kinds that there are, numbered, with groups of
cells, of their faces, and of nodes. What had to be left out or turned is told in `notes`."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .cells import BY_NAME, Kind, corners_of, dimension_of
from .errors import UserError
from .mesh_files import FileMesh

CHUNK = 100_000
NAMED = 10  # groups in a message at most
FLAT = 1e-10  # a cell whose content is this part of its longest side to the power of its dimension has none
NAMES_OF_OTHERS = {
    "vertex": "single points",
    "line": "lines",
    "line3": "lines of 3 nodes",
    "pyramid": "pyramids",
    "pyramid13": "pyramids of 13 nodes",
    "quad9": "quadrilaterals of 9 nodes",
    "triangle7": "triangles of 7 nodes",
    "wedge18": "wedges of 18 nodes",
    "hexahedron24": "hexahedra of 24 nodes",
    "hexahedron27": "hexahedra of 27 nodes",
}
FULL = ("quad9", "wedge18", "hexahedron27")


@dataclass
class Block:
    """Cells of one kind with consecutive numbers from `first` on; nodes are rows of the mesh's points."""

    kind: Kind
    first: int
    nodes: np.ndarray


@dataclass
class Group:
    """A name for cells (their numbers), faces (rows of cell and face) or nodes (their numbers)."""

    name: str
    what: str  # MAILLES, FACES, NOEUDS
    members: np.ndarray


@dataclass
class CellMesh:
    """Nodes, numbered from 1 as their rows, cells and groups of a deck."""

    points: np.ndarray
    blocks: list[Block]
    groups: list[Group] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    membranes: bool = False

    @property
    def dimension(self) -> int:
        return self.blocks[0].kind.dimension

    @property
    def cells(self) -> int:
        return sum(len(b.nodes) for b in self.blocks)


def count(number: int, words: str) -> str:
    """`1 triangle`, `3 triangles of 6 nodes`."""
    if number == 1:
        first, _, rest = words.partition(" ")
        plural = {"hexahedra": "hexahedron", "tetrahedra": "tetrahedron"}
        words = f"{plural.get(first, first.removesuffix('s'))} {rest}".strip()
    return f"{number} {words}"


def of_file(
    mesh: FileMesh, scale: float = 1.0, merge: float | None = None, membranes: bool = False
) -> CellMesh:
    """All that a deck can say of the mesh. `merge`: nodes nearer than this part of its size are one.
    `membranes`: its triangles and quadrilaterals, wherever they lie, are membranes."""
    path, notes = mesh.path, list(mesh.notes)
    points = mesh.points * scale
    one = np.arange(len(points))
    if merge is not None and len(points):
        one, joined = merged(points, merge)
        said = f"{count(joined, 'nodes')} of {len(points)}" if joined else "No nodes"
        notes.append(f"{said} joined with others at their place.")
    blocks = [(name, one[nodes]) for name, nodes in mesh.blocks]
    dimension = max(
        (dimension_of(name) for name, nodes in blocks if len(nodes) and name in BY_NAME), default=0
    )
    if membranes and dimension != 2:
        raise UserError(
            f"{path} has {'solids' if dimension == 3 else 'no surface'}: --as membranes is for a surface "
            "without solids."
        )
    if dimension == 0:
        every: dict[str, int] = {}
        for name, nodes in blocks:
            every[name] = every.get(name, 0) + len(nodes)
        found = ", ".join(_counted(name, k) for name, k in every.items() if k) or "no cells"
        raise UserError(
            f"{path} has nothing that a deck can take: {found}. Cells are triangles and quadrilaterals of "
            "a plane, tetrahedra, wedges and hexahedra, of first or second order."
            + _hint([n for n, _ in blocks])
        )
    out = CellMesh(points, [], [], notes, membranes)
    number_of: list[np.ndarray] = []  # for each block of the file the number of each cell in the deck, or 0
    number, lost = 1, {}
    flat = folded = turned = main = 0
    first_folded = 0
    for name, nodes in blocks:
        numbers = np.zeros(len(nodes), int)
        number_of.append(numbers)
        kind = BY_NAME.get(name)
        if not len(nodes) or kind is None or kind.dimension != dimension:
            if kind is None and len(nodes) and dimension_of(name) >= dimension:
                lost[name] = lost.get(name, 0) + len(nodes)
            continue
        main += len(nodes)
        shape = shapes(points, kind, nodes, membranes)
        good = shape != DEGENERATE
        flat += int(np.sum(~good))
        inside_out = shape == INVERTED
        if inside_out.any():
            nodes = nodes.copy()
            nodes[inside_out] = nodes[inside_out][:, kind.mirror]
            turned += 0 if name in mesh.both_ways else int(inside_out.sum())
        numbers[good] = np.arange(number, number + int(good.sum()))
        bad = shape == FOLDED
        if bad.any():
            first_folded = first_folded or int(numbers[bad][0])
            folded += int(bad.sum())
        if good.any():
            out.blocks.append(Block(kind, number, nodes[good]))
        number += int(good.sum())
    for name, k in lost.items():
        notes.append(f"{_counted(name, k)} left out: a deck has no such cells." + _hint([name]))
    if flat:
        notes.append(f"{count(flat, 'cells')} left out: without content, or with one node twice.")
    if not out.blocks:
        upright = dimension == 2 and not membranes and _stand_upright(points, blocks)
        raise UserError(
            f"{path} has no cells in the x-y plane, where plane cells lie: {count(main, 'cells')} left out. "
            "Turn the mesh, or import it with --as membranes."
            if upright
            else f"{path} has no cells with any content; {count(main, 'cells')} left out."
        )
    if turned:
        notes.append(f"{turned} of {main} cells are numbered inside out; they have been turned.")
    if folded:
        notes.append(
            f"cells that fold over themselves: {folded}, the first is cell {first_folded}; mend the mesh."
        )
    if dimension == 2 and not membranes:
        _stand_in_plane(out, path)
    _groups(mesh, out, blocks, one, number_of)
    _drop_unused(out)
    return out


def _counted(name: str, number: int) -> str:
    known = BY_NAME.get(name)
    words = known.words if known else NAMES_OF_OTHERS.get(name, f"cells of the kind {name}")
    return count(number, words)


def _hint(names: list[str]) -> str:
    if any(n in FULL for n in names):
        return " Make second order without nodes in the middle (in Gmsh Mesh.SecondOrderIncomplete = 1)."
    return ""


GOOD, INVERTED, FOLDED, DEGENERATE = 0, 1, 2, 3


def shapes(points: np.ndarray, kind: Kind, nodes: np.ndarray, in_space: bool = False) -> np.ndarray:
    """Of each cell whether it is good, inside out, folded over itself, or without content: by the signs of
    the Jacobian at its corners, with straight sides. `in_space`: of plane cells anywhere, seen from the side
    where they run anticlockwise."""
    out = np.zeros(len(nodes), np.int8)
    for start in range(0, len(nodes), CHUNK):
        part = nodes[start : start + CHUNK]
        x = points[part[:, : kind.corners]]
        sides = np.linalg.norm(x - np.roll(x, 1, axis=1), axis=2).max(axis=1)
        if kind.dimension == 3:  # across the cell
            sides = np.maximum(sides, np.linalg.norm(x - x[:, :1], axis=2).max(axis=1))
        if in_space:
            x = _in_own_plane(x)
        jacobian = np.stack([_jacobian(x, kind, c) for c in range(kind.corners)], axis=1)
        size = np.maximum(sides, np.finfo(float).tiny)[:, None] ** kind.dimension
        relative = jacobian / size
        back, ahead = (relative < -FLAT).any(axis=1), (relative > FLAT).any(axis=1)
        found = np.where(back, np.where(ahead, FOLDED, INVERTED), GOOD)
        ordered = np.sort(part, axis=1)
        twice = (ordered[:, 1:] == ordered[:, :-1]).any(axis=1)
        found[~(back | ahead) | twice] = DEGENERATE
        out[start : start + CHUNK] = found
    return out


def _stand_upright(points: np.ndarray, blocks: list[tuple[str, np.ndarray]]) -> bool:
    """Whether plane cells would have an area if they might lie in any plane."""
    return any(
        (shapes(points, kind, nodes, in_space=True) != DEGENERATE).any()
        for name, nodes in blocks
        if len(nodes) and (kind := BY_NAME.get(name)) and kind.dimension == 2
    )


def _in_own_plane(x: np.ndarray) -> np.ndarray:
    """Corners of cells (n x k x 3) along axes of their own: the last is the normal."""
    along = x[:, 2] - x[:, 0]
    normal = np.cross(along, x[:, -1] - x[:, 1]) if x.shape[1] == 4 else np.cross(x[:, 1] - x[:, 0], along)
    axes = np.stack([along, np.cross(normal, along), normal], axis=1)
    size = np.linalg.norm(axes, axis=2, keepdims=True)
    return np.einsum("nij,nkj->nki", axes / np.where(size > 0, size, 1), x)


def _jacobian(x: np.ndarray, kind: Kind, corner: int) -> np.ndarray:
    """At a corner of cells with these corners (n x k x 3)."""
    if kind.dimension == 2:
        n = kind.corners
        a, b = x[:, (corner + 1) % n] - x[:, corner], x[:, corner - 1] - x[:, corner]
        return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    if kind.corners == 4:
        a, b, c = (x[:, i] - x[:, 0] for i in (1, 2, 3))
        return np.einsum("ni,ni->n", np.cross(a, b), c)
    n = kind.corners // 2
    at, top = corner % n, corner >= n
    shift = n if top else 0
    a = x[:, (at + 1) % n + shift] - x[:, corner]
    b = x[:, (at - 1) % n + shift] - x[:, corner]
    c = x[:, at + n] - x[:, at]
    return np.einsum("ni,ni->n", np.cross(a, b), c)


def _stand_in_plane(mesh: CellMesh, path: object) -> None:
    used = np.unique(np.concatenate([b.nodes.ravel() for b in mesh.blocks]))
    x = mesh.points[used]
    if np.ptp(x[:, 2]) > 1e-9 * np.ptp(x, axis=0).max():
        raise UserError(
            f"{path} is a surface in space; plane cells need all nodes at the same z, and a deck takes "
            "no shells. --as membranes brings it as a skin that does not bend."
        )
    mesh.points[used, 2] = x[0, 2]


def merged(points: np.ndarray, tolerance: float) -> tuple[np.ndarray, int]:
    """For each node the one that stands for it, and how many have gone. Nodes in a chain of such near ones
    are one."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    reach = tolerance * float(np.linalg.norm(np.ptp(points, axis=0)))
    pairs = cKDTree(points).query_pairs(reach, output_type="ndarray")
    n = len(points)
    graph = coo_matrix((np.ones(len(pairs), bool), (pairs[:, 0], pairs[:, 1])), shape=(n, n))
    parts, part = connected_components(graph, directed=False)
    first = np.full(parts, n)
    np.minimum.at(first, part, np.arange(n))
    return first[part], n - parts


def _groups(
    mesh: FileMesh,
    out: CellMesh,
    blocks: list[tuple[str, np.ndarray]],
    one: np.ndarray,
    number_of: list[np.ndarray],
) -> None:
    """Groups of cells; of cells of one dimension less the faces that these are, and their nodes; of others
    their nodes."""
    faces = _Faces(out, blocks)
    used = np.zeros(len(out.points), bool)
    for b in out.blocks:
        used[b.nodes] = True
    bounding = unmatched = between = 0
    empty: list[str] = []
    for name, members in mesh.cell_groups.items():
        cells, rows, nodes = [], [], []
        for (kind, table), numbers, chosen in zip(blocks, number_of, members, strict=True):
            chosen = np.asarray(chosen, int)
            if not len(chosen):
                continue
            kind_dimension = dimension_of(kind)
            if kind_dimension == out.dimension:
                cells.append(numbers[chosen][numbers[chosen] > 0])
            else:
                nodes.append(table[chosen].ravel())
            if kind_dimension == out.dimension - 1:
                found, several = faces.of(kind, table[chosen])
                good = found[:, 0] > 0
                bounding, unmatched = bounding + len(chosen), unmatched + int(np.sum(~good))
                between += int(several.sum())
                rows.append(found[good])
        own = np.unique(np.concatenate(nodes)) if nodes else np.zeros(0, int)
        parts = [
            ("MAILLES", np.sort(np.concatenate(cells)) if cells else np.zeros(0, int)),
            ("FACES", np.unique(np.concatenate(rows), axis=0) if rows else np.zeros((0, 2), int)),
            ("NOEUDS", own[used[own]]),
        ]
        kept = [Group(name, what, found) for what, found in parts if len(found)]
        out.groups += kept
        if not kept:
            empty.append(name)
    for name, chosen in mesh.point_groups.items():
        nodes = np.unique(one[chosen])
        nodes = nodes[used[nodes]]
        if len(nodes):
            out.groups.append(Group(name, "NOEUDS", nodes))
        else:
            empty.append(name)
    _unique_names(out)
    if empty:
        named = ", ".join(f'"{name}"' for name in empty[:NAMED]) + (", …" if len(empty) > NAMED else "")
        out.notes.append(f"{count(len(empty), 'groups')} left out, of which nothing remains: {named}.")
    if unmatched:
        out.notes.append(
            f"{unmatched} of {bounding} cells in groups bound no cell; only their nodes are kept."
        )
    if between:
        out.notes.append(
            f"faces in groups that lie between two cells: {between}; each counts as a face of the cell "
            "with the lower number."
        )


def _unique_names(out: CellMesh) -> None:
    """Nodes beside cells or faces get a name of their own; a deck's names stand in quotes."""
    taken: set[str] = set()
    for group in sorted(out.groups, key=lambda g: ("MAILLES", "FACES", "NOEUDS").index(g.what)):
        name = " ".join(group.name.replace('"', "'").split()) or "group"
        if name in taken:
            name += {"MAILLES": " cells", "FACES": " faces", "NOEUDS": " nodes"}[group.what]
        stem, k = name, 2
        while name in taken:
            name, k = f"{stem} {k}", k + 1
        taken.add(name)
        group.name = name


class _Faces:
    """Finds the face of a cell that a cell of one dimension less is: by its corners. Only faces whose corners
    all belong to such cells are looked at."""

    def __init__(self, mesh: CellMesh, blocks: list[tuple[str, np.ndarray]]) -> None:
        marked = np.zeros(len(mesh.points), bool)
        for name, nodes in blocks:
            if dimension_of(name) == mesh.dimension - 1:
                marked[nodes[:, : corners_of(name)]] = True
        self.tables: dict[int, tuple[np.ndarray, np.ndarray]] = {}
        keys: dict[int, list[np.ndarray]] = {}
        owners: dict[int, list[np.ndarray]] = {}
        for block in mesh.blocks:
            for f, corners in enumerate(block.kind.faces, 1):
                table = block.nodes[:, list(corners)]
                mine = np.flatnonzero(marked[table].all(axis=1))
                if len(mine):
                    keys.setdefault(len(corners), []).append(np.sort(table[mine], axis=1))
                    owners.setdefault(len(corners), []).append(
                        np.stack([block.first + mine, np.full(len(mine), f)], axis=1)
                    )
        for size, parts in keys.items():
            self.tables[size] = (np.concatenate(parts), np.concatenate(owners[size]))

    def of(self, name: str, nodes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Cell and face of each, 0 0 where there is none; and where there are two."""
        size = corners_of(name)
        wanted = np.sort(nodes[:, :size], axis=1)
        found = np.zeros((len(nodes), 2), int)
        several = np.zeros(len(nodes), bool)
        if size not in self.tables:
            return found, several
        keys, owners = self.tables[size]
        every, code = np.unique(np.concatenate([keys, wanted]), axis=0, return_inverse=True)
        code = np.ravel(code)
        mine, asked = code[: len(keys)], code[len(keys) :]
        times = np.bincount(mine, minlength=len(every))
        order = np.lexsort((owners[:, 0], mine))[::-1]
        best = np.zeros((len(every), 2), int)
        best[mine[order]] = owners[order]  # the lowest number is written last
        found = best[asked]
        return found, (times[asked] > 1) & (found[:, 0] > 0)


def _drop_unused(out: CellMesh) -> None:
    """Nodes without cells go; numbers begin at 1."""
    used = np.zeros(len(out.points), bool)
    for block in out.blocks:
        used[block.nodes] = True
    gone = int(np.sum(~used))
    if gone:
        out.notes.append(f"{count(gone, 'nodes')} left out, which no cell has.")
    new = np.cumsum(used) - 1
    out.points = out.points[used]
    for block in out.blocks:
        block.nodes = new[block.nodes]
    for group in out.groups:
        if group.what == "NOEUDS":
            group.members = new[group.members] + 1
