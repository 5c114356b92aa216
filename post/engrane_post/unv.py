# SPDX-License-Identifier: BSD-3-Clause
"""Reads universal files (.unv) of I-DEAS: nodes (dataset 2411), cells (2412), groups (2467, 2477 and older).

The layout is that of the Structural Dynamics Research Laboratory, University of Cincinnati, "Universal File
Datasets". Nodes of second-order cells stand there in the order of `.MAI`: round the base, the upright sides,
round the top."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .cells import BY_NAME, alike, nodes_of
from .errors import UserError
from .raw_mesh import RawCells, RawMesh, text_of

# finite element descriptors
NAMES = {
    **dict.fromkeys((41, 51, 61, 81, 91), "triangle"),
    **dict.fromkeys((42, 52, 62, 82, 92), "triangle6"),
    **dict.fromkeys((44, 54, 64, 84, 94), "quad"),
    **dict.fromkeys((45, 55, 65, 85, 95), "quad8"),
    111: "tetra",
    118: "tetra10",
    112: "wedge",
    113: "wedge15",
    115: "hexahedron",
    116: "hexahedron20",
    **dict.fromkeys((11, 21, 22), "line"),
    **dict.fromkeys((23, 24), "line3"),
}
BEAMS = (11, 21, 22, 23, 24)  # have a record more
GROUPS = ("2435", "2452", "2467", "2477")
NODE, ELEMENT = 7, 8


def read(path: str | Path) -> RawMesh:
    """With its groups as sets of cells and of points."""
    sets: dict[str, list[list[str]]] = {}
    for number, lines in _datasets(text_of(path), path):
        sets.setdefault(number, []).append(lines)
    if "2411" not in sets or "2412" not in sets:
        raise UserError(f"{path} is no universal file with nodes and cells (datasets 2411 and 2412).")
    labels, points = _nodes([line for lines in sets["2411"] for line in lines])
    row_of = _Rows(labels)
    blocks, names = _cells([line for lines in sets["2412"] for line in lines], row_of, path)
    groups = [g for number in GROUPS for lines in sets.get(number, []) for g in _groups(lines, path)]
    cell_sets: dict[str, list[np.ndarray]] = {}
    point_sets: dict[str, np.ndarray] = {}
    for name, members in groups:
        nodes = members[members[:, 0] == NODE, 1]
        if len(nodes):
            point_sets[name] = row_of(nodes, path, f'group "{name}"')
        wanted = members[members[:, 0] == ELEMENT, 1]
        if len(wanted) or not len(nodes):  # also what has no members, to be told of
            cell_sets[name] = [np.flatnonzero(np.isin(n, wanted)) for n in names]
    return RawMesh(points, blocks, point_sets=point_sets, cell_sets=cell_sets)


class _Rows:
    """Rows of the nodes by their labels."""

    def __init__(self, labels: np.ndarray) -> None:
        self.order = np.argsort(labels, kind="stable")
        self.labels = labels[self.order]

    def __call__(self, wanted: np.ndarray, path: str | Path, who: str) -> np.ndarray:
        if len(wanted) == 0 or len(self.labels) == 0:
            return np.zeros(wanted.shape, int)
        place = np.minimum(np.searchsorted(self.labels, wanted), len(self.labels) - 1)
        unknown = wanted[self.labels[place] != wanted]
        if len(unknown):
            raise UserError(f"{path}: {who} names node {unknown.flat[0]}, which the file does not have.")
        return self.order[place]


def _datasets(text: str, path: str | Path) -> list[tuple[str, list[str]]]:
    """Numbers and lines of what stands between two lines of -1."""
    out: list[tuple[str, list[str]]] = []
    lines = text.splitlines()
    marks = [i for i, line in enumerate(lines) if line[:6].strip() == "-1" and line.strip() == "-1"]
    if len(marks) % 2:
        number = "".join(lines[marks[-1] + 1 : marks[-1] + 2]).strip() or "without a number"
        raise UserError(
            f"{path}: dataset {number} in line {marks[-1] + 1} does not end with -1: the file is cut short."
        )
    for begin, end in zip(marks[::2], marks[1::2], strict=True):
        if begin + 1 < end:
            out.append((lines[begin + 1].split()[0], lines[begin + 2 : end]))
    return out


def _nodes(lines: list[str]) -> tuple[np.ndarray, np.ndarray]:
    labels = np.array([line[:10] for line in lines[::2]], int)
    numbers = " ".join(lines[1::2]).replace("D", "E").replace("d", "e").split()
    return labels, np.array(numbers, float).reshape(-1, 3)


def _cells(lines: list[str], row_of: _Rows, path: str | Path) -> tuple[list[RawCells], list[np.ndarray]]:
    """Blocks of cells and the labels of their cells."""
    data = np.array(" ".join(lines).split(), np.int64)
    blocks: list[RawCells] = []
    names: list[np.ndarray] = []
    at = 0
    while at + 6 <= len(data):
        code, count = int(data[at + 1]), int(data[at + 5])
        head = 9 if code in BEAMS else 6
        if count < 1 or at + head + count > len(data):
            raise UserError(f"{path}: cell {data[at]} is not written as dataset 2412 wants it.")
        name = NAMES.get(code, f"cell {code}")
        if count != (nodes_of(name) or count):
            raise UserError(f"{path}: cell {data[at]} has {count} nodes instead of {nodes_of(name)}.")
        # label, descriptor, properties, material, colour, number of nodes
        table = alike(data[at:], (1, 5), head + count)
        at += table.size
        nodes = row_of(table[:, head:], path, f"cell {table[0, 0]}")
        kind = BY_NAME.get(name)
        if kind is not None and kind.middles:
            place = np.argsort([abs(k) for k in kind.row if k])
            nodes = nodes[:, place]
        elif name == "line3":
            nodes = nodes[:, [0, 2, 1]]
        blocks.append(RawCells(name, nodes))
        names.append(table[:, 0])
    return blocks, names


def _groups(lines: list[str], path: str | Path) -> list[tuple[str, np.ndarray]]:
    """Names and members, a row of type and label each."""
    out: list[tuple[str, np.ndarray]] = []
    at = 0
    while at + 1 < len(lines):
        head = lines[at].split()
        count = int(head[-1])
        name = lines[at + 1].strip() or f"group {head[0]}"
        rows: list[str] = []
        at += 2
        while at < len(lines) and len(rows) < 4 * count:
            rows += lines[at].split()
            at += 1
        if len(rows) < 4 * count:
            raise UserError(f'{path}: group "{name}" has {len(rows) // 4} members instead of {count}.')
        members = np.array(rows[: 4 * count], np.int64).reshape(-1, 4)
        out.append((name, members[:, :2]))
    return out
