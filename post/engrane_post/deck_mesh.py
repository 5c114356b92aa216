# SPDX-License-Identifier: BSD-3-Clause
"""Writes a mesh as a deck: `.NOE`, `.MAI`, `.SEL`, and below them, as comments, the cards that it lacks."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain
from typing import TextIO

import numpy as np

from .cell_mesh import Block, CellMesh, Group, count

ROWS = 50_000  # that are put into words at a time


def write(out: TextIO, mesh: CellMesh, title: str, source: str, file: str | None = None) -> None:
    """All of the deck. `source` says where the mesh is from, `file` which one has it for the deck to name."""
    out.write(f"! {source}\n")
    out.write(f'.TITRE "{title}"\n')
    if file is None:
        _write_mesh(out, mesh)
    else:
        out.write(f'.MAI FILE "{file}"\n')
        out.writelines(f"! {line}\n" for line in summary(mesh))
    out.write(template(mesh))
    out.write(".FIN 1\n")


def _write_mesh(out: TextIO, mesh: CellMesh) -> None:
    out.write(".NOE\n")
    out.writelines(_nodes(mesh))
    out.write(".MAI\n")
    for block in mesh.blocks:
        out.writelines(_cells(block))
    if mesh.groups:
        out.write(".SEL\n")
    for number, group in enumerate(mesh.groups, 1):
        out.write(f' GROUP {number} {group.what} NOM "{group.name}"\n')
        out.writelines(_members(group))


def _nodes(mesh: CellMesh) -> Iterator[str]:
    """`I 7 X 0.0 0.5`; numbers in the fewest digits that give them back."""
    width = 3 if mesh.points[:, 2].any() else 2
    line = " I %d X" + " %r" * width + "\n"
    for start in range(0, len(mesh.points), ROWS):
        part = mesh.points[start : start + ROWS]
        columns = [(part[:, k] + 0.0).tolist() for k in range(width)]  # no -0.0
        numbers = range(start + 1, start + 1 + len(part))
        yield (line * len(part)) % tuple(chain.from_iterable(zip(numbers, *columns, strict=True)))


def _cells(block: Block) -> Iterator[str]:
    row = np.array(block.kind.row)
    line = " I %d N" + " %d" * len(row) + "\n"
    sign = np.sign(row)
    for start in range(0, len(block.nodes), ROWS):
        part = block.nodes[start : start + ROWS]
        table = np.empty((len(part), len(row) + 1), int)
        table[:, 0] = np.arange(len(part)) + block.first + start
        table[:, 1:] = (part[:, np.abs(row) - 1] + 1) * sign  # 0 stays 0
        yield (line * len(part)) % tuple(table.ravel().tolist())


def _members(group: Group) -> Iterator[str]:
    if group.what == "FACES":
        for start in range(0, len(group.members), ROWS):
            part = group.members[start : start + ROWS]
            yield (" I %d %d\n" * len(part)) % tuple(part.ravel().tolist())
        return
    for first, last in ranges(group.members):
        if last - first > 1:
            yield f" I {first} J {last} K 1\n"
        else:
            yield "".join(f" I {n}\n" for n in range(first, last + 1))


def ranges(numbers: np.ndarray) -> list[tuple[int, int]]:
    """First and last of each run of consecutive numbers."""
    ends = np.flatnonzero(np.diff(numbers) != 1)
    firsts = numbers[np.r_[0, ends + 1]]
    lasts = numbers[np.r_[ends, len(numbers) - 1]]
    return list(zip(firsts.tolist(), lasts.tolist(), strict=True))


def summary(mesh: CellMesh) -> list[str]:
    """The cells and groups, for the terminal and for comments."""
    kinds: dict[str, int] = {}
    for block in mesh.blocks:
        kinds[block.kind.words] = kinds.get(block.kind.words, 0) + len(block.nodes)
    out = [count(len(mesh.points), "nodes")]
    out += [count(number, words) for words, number in kinds.items()]
    words = {"MAILLES": "cells", "FACES": "faces", "NOEUDS": "nodes"}
    out += [f'group "{g.name}": {count(len(g.members), words[g.what])}' for g in mesh.groups]
    return out


def template(mesh: CellMesh) -> str:
    """What a mesh does not say, each card as a comment: with the groups that there are."""
    solid = mesh.dimension == 3
    cells = [g.name for g in mesh.groups if g.what == "MAILLES"]
    faces = [g for g in mesh.groups if g.what == "FACES"]
    nodes = [g.name for g in mesh.groups if g.what == "NOEUDS"]
    of_cells = f'GROUP "{cells[0]}"' if cells else f"I 1 J {mesh.cells} K 1"
    last = mesh.cells
    lines = ["What the mesh does not say. Remove the ! before a card and the lines below it, and fill in."]
    lines += [
        ".MAT",
        ' I 1 NOM "steel" BEHA "ELASTIC" YT 2.1E+11 NT 0.3 M 7850.',
    ]
    if mesh.membranes:
        lines += [
            ".HYP MEMBRANE                ! TENSION and WRINKLING follow",
            ".PHP",
            *(f' GROUP "{name}" THICK VAL 0.001' for name in cells or ["name of a group of cells"]),
        ]
    elif not solid:
        lines += [
            ".HYP MEMB BIDIM              ! plane stress; DEFO PLAN plane strain, AXIS round the y axis",
            ".PHP",
            *(f' GROUP "{name}" THICK VAL 0.01' for name in cells or ["name of a group of cells"]),
        ]
    lines += [".AEL"]
    lines += [f' GROUP "{name}" MAT 1' for name in cells] or [f" {of_cells} MAT 1"]
    lines += [".CLM"]
    held = "1 2 3" if solid or mesh.membranes else "1 2"
    if nodes:
        lines += [f' GROUP "{nodes[0]}" FIX C {held}']
        lines += [f' GROUP "{name}" CHA C 1 V 100.' for name in nodes[1:2]]
    else:
        lines += [f" NOEUD 1 FIX C {held}"]
    if faces:
        lines += [f' GROUP "{faces[-1].name}" PRE V 1000.   ! positive presses on the cells']
    lines += [
        f"! Elements of .MCE take numbers from {last + 1} on, further nodes from {len(mesh.points) + 1} on"
        + (f", groups from {len(mesh.groups) + 1} on." if mesh.groups else "."),
        ".SAI FIELDS DT 0.01",
    ]
    return "".join(
        f"!{line}\n" if line.startswith((".", " ")) else f"! {line.lstrip('! ')}\n" for line in lines
    )
