# SPDX-License-Identifier: BSD-3-Clause
"""Small meshes for tests, and a reader of the decks that `engrane import` writes."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import meshio
import numpy as np
from engrane_post.raw_mesh import meshio_library

meshio_library()  # knows wedges of 15 nodes now

TRIANGLE = np.array([[0, 0, 0], [2, 0, 0], [0, 1, 0]], float)
SQUARE = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]], float)
UP = np.array([0.25, 0, 3.0])
# VTK's figures (The VTK User's Guide, File formats): corners, then these sides
CORNERS = {
    "triangle": TRIANGLE,
    "quad": SQUARE,
    "tetra": np.array([*TRIANGLE, UP]),
    "wedge": np.concatenate([TRIANGLE, TRIANGLE + UP]),
    "hexahedron": np.concatenate([SQUARE, SQUARE + UP]),
}
SIDES = {
    "triangle6": ("triangle", "01 12 20"),
    "quad8": ("quad", "01 12 23 30"),
    "tetra10": ("tetra", "01 12 20 03 13 23"),
    "wedge15": ("wedge", "01 12 20 34 45 53 03 14 25"),
    "hexahedron20": ("hexahedron", "01 12 23 30 45 56 67 74 04 15 26 37"),
}
KINDS = (*CORNERS, *SIDES)


def points_of(kind: str) -> np.ndarray:
    """The nodes of one cell, mid-side nodes in the middle, in VTK's order."""
    if kind in CORNERS:
        return CORNERS[kind]
    linear, sides = SIDES[kind]
    x = CORNERS[linear]
    return np.concatenate([x, [(x[int(a)] + x[int(b)]) / 2 for a, b in sides.split()]])


def brick(n: int = 3, m: int = 2, k: int = 2) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A box of hexahedra, n x m x k of size 1: points, cells, and the quadrilaterals at x = 0."""
    x, y, z = np.meshgrid(*(np.arange(c + 1.0) for c in (n, m, k)), indexing="ij")
    i = np.arange(x.size).reshape(x.shape)
    low, high = slice(None, -1), slice(1, None)
    base = [(low, low), (high, low), (high, high), (low, high)]
    cells = np.stack([i[a, b, c] for c in (low, high) for a, b in base], axis=-1).reshape(-1, 8)
    side = np.stack([i[0, b, c] for b, c in base], axis=-1).reshape(-1, 4)
    return np.stack([x.ravel(), y.ravel(), z.ravel()], axis=-1), cells, side


@dataclass
class Deck:
    """What a deck has: nodes and cells by number, groups by name: their kind and rows."""

    nodes: dict[int, np.ndarray] = field(default_factory=dict)
    cells: dict[int, list[int]] = field(default_factory=dict)
    groups: dict[str, tuple[str, list[tuple[int, ...]]]] = field(default_factory=dict)


def read_deck(path: Path) -> Deck:
    """Of the cards that a mesh has; comments are left out."""
    deck, card, group = Deck(), "", ""
    for line in path.read_text(encoding="utf-8").splitlines():
        text = line.split("!")[0]
        words = text.split()
        if not words:
            continue
        if words[0].startswith("."):
            card = words[0]
        elif card == ".NOE":
            x = [float(w) for w in words[3:]]
            deck.nodes[int(words[1])] = np.array([*x, 0.0][:3])
        elif card == ".MAI":
            deck.cells[int(words[1])] = [int(w) for w in words[3:]]
        elif words[0] == "GROUP":
            group = text.split('"')[1]
            assert group not in deck.groups
            deck.groups[group] = (words[2], [])
        elif card == ".SEL":
            rows = deck.groups[group][1]
            if "J" in words:
                assert words[0] == "I" and words[4:] == ["K", "1"]
                rows += [(n,) for n in range(int(words[1]), int(words[3]) + 1)]
            else:
                rows.append(tuple(int(w) for w in words[1:]))
    return deck


def parts(row: list[int]) -> list[list[int]]:
    """A record of `.MAI`, cut at its zeros."""
    out: list[list[int]] = [[]]
    for n in row:
        if n:
            out[-1].append(n)
        else:
            out.append([])
    return out


def base_and_top(row: list[int]) -> tuple[list[int], list[int]]:
    """The corners of a solid."""
    found = parts(row)
    return [n for n in found[0] if n > 0], [n for n in found[-1] if n > 0]


def face(row: list[int], k: int) -> set[int]:
    """Corners of face k: 1 the base, then those on its sides, the top; of a plane cell edge k."""
    if 0 not in row:
        corners = [n for n in row if n > 0]
        return {corners[k - 1], corners[k % len(corners)]}
    base, top = base_and_top(row)
    n = len(base)
    if k == 1:
        return set(base)
    if k == n + 2:
        return set(top)
    side = [k - 2, (k - 1) % n]
    return {base[i] for i in side} | ({top[i] for i in side} if len(top) == n else set(top))


def write_unv(path: Path, mesh: meshio.Mesh, groups: dict[str, list[tuple[int, int]]]) -> None:
    """A universal file; groups by name, members of type (7 a node, 8 a cell) and label."""
    codes = {"hexahedron": 115, "quad": 94, "tetra10": 118, "line": 21, "hexahedron20": 116}
    # places of VTK's nodes round the base, up, round the top
    orders = {
        "tetra10": [0, 4, 1, 5, 2, 6, 7, 8, 9, 3],
        "hexahedron20": [0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15],
    }
    lines = ["    -1", "  2411"]
    for i, x in enumerate(mesh.points, 1):
        lines.append(f"{10 * i:10d}{1:10d}{1:10d}{11:10d}")
        lines.append("".join(f"{v:25.16E}".replace("E", "D") for v in x))
    lines += ["    -1", "    -1", "  2412"]
    label = 0
    for block in mesh.cells:
        for row in np.asarray(block.data):
            label += 1
            row = 10 * (row[orders.get(block.type, range(len(row)))] + 1)
            lines.append(f"{label:10d}{codes[block.type]:10d}{1:10d}{1:10d}{7:10d}{len(row):10d}")
            if block.type == "line":
                lines.append(f"{0:10d}{1:10d}{1:10d}")
            lines += ["".join(f"{n:10d}" for n in row[s : s + 8]) for s in range(0, len(row), 8)]
    lines += ["    -1", "    -1", "  2467"]
    for number, (name, members) in enumerate(groups.items(), 1):
        lines.append("".join(f"{n:10d}" for n in (number, 0, 0, 0, 0, 0, 0, len(members))))
        lines.append(name)
        for s in range(0, len(members), 2):
            lines.append("".join(f"{t:10d}{n:10d}{0:10d}{0:10d}" for t, n in members[s : s + 2]))
    lines.append("    -1")
    path.write_text("\n".join(lines) + "\n")
