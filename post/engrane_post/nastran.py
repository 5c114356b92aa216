# SPDX-License-Identifier: BSD-3-Clause
"""Reads the mesh of a Nastran file: GRID and the cards of cells, in small, large or free fields, with all
ways to continue a card on the next line, and INCLUDE (MSC Nastran, Quick Reference Guide, The Bulk Data
Section). The cells with one property are a group. Cards of cells that are not known are refused, links,
springs and masses are named in a note, and everything else is passed over."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

import numpy as np

from .cells import nodes_of
from .errors import UserError
from .raw_mesh import RawCells, RawMesh, text_of

#: kinds of cells, by the card and without and with mid-side nodes
KINDS = {
    **dict.fromkeys(("CROD", "CTUBE", "CBAR", "CBEAM", "CBUSH", "CBUSH1D", "CGAP"), ("line",)),
    **dict.fromkeys(("CTRIA3", "CTRIAR", "CPLSTN3", "CPLSTS3", "CTRAX3"), ("triangle",)),
    **dict.fromkeys(("CTRIA6", "CPLSTN6", "CPLSTS6", "CTRIAX6", "CTRAX6"), ("triangle6",)),
    "CTRIAX": ("triangle", "triangle6"),
    **dict.fromkeys(("CQUAD4", "CQUADR", "CSHEAR", "CPLSTN4", "CPLSTS4", "CQUADX4"), ("quad",)),
    **dict.fromkeys(("CQUAD8", "CPLSTN8", "CPLSTS8", "CQUADX8"), ("quad8",)),
    **dict.fromkeys(("CQUAD", "CQUADX"), ("quad", "quad8", "quad9")),
    "CTETRA": ("tetra", "tetra10"),
    **dict.fromkeys(("CPYRAM", "CPYRA"), ("pyramid", "pyramid13")),
    "CPENTA": ("wedge", "wedge15"),
    "CHEXA": ("hexahedron", "hexahedron20"),
}
#: where VTK's nodes stand: Nastran has the middles of the upright sides before those of the top
ORDERS = {
    "wedge15": [*range(9), 12, 13, 14, 9, 10, 11],
    "hexahedron20": [*range(12), 16, 17, 18, 19, 12, 13, 14, 15],
}
ROUND = ("CTRIAX6", "CTRAX6")  # corners and mid-side nodes in turn
#: names of links, springs and masses begin with these, which a mesh does not have
LINKS = re.compile(r"(RBE|RBAR|RROD|RTRPLT|RSPLINE|RJOINT|MPC$|CELAS|CDAMP|CONM|CMASS|PLOTEL|CWELD|CFAST)")
#: names of cards of cells begin with these: those that are not known here must not be missing without a word
CELLS = re.compile(r"C(TRI|TRA|QUAD|SHEAR|PLST|TETR|PENT|PYR|HEX|IFQ|IFH|IFP|RAC)")


def read(path: str | Path) -> RawMesh:
    """With a set of cells for each property."""
    row_of: dict[int, int] = {}
    points: list[list[float]] = []
    cells: list[tuple[str, int, str, list[int]]] = []  # kind, label, property, labels of nodes
    labels: set[int] = set()
    links: Counter[str] = Counter()
    for keyword, fields in _cards("\n".join(_lines(Path(path), []))):
        if keyword in ("GRID", "GRDSET") and fields[1] not in ("", "0"):
            card = f"{keyword} {fields[0]}".strip()
            raise UserError(
                f"{path}: {card} has its place in the coordinate system {fields[1]} (field CP), and only the "
                "basic one is read: write the mesh in that."
            )
        if keyword == "GRID":
            if int(fields[0]) in row_of:
                raise UserError(f"{path}: GRID {int(fields[0])} is given twice.")
            row_of[int(fields[0])] = len(points)
            points.append([_number(word, f"{path}: GRID {fields[0]}") for word in fields[2:5]])
        elif keyword in KINDS:
            kind, nodes = _cell(keyword, fields, path)
            if kind == "line" and len(nodes) < 2:  # a spring to the ground
                continue
            if int(fields[0]) in labels:
                raise UserError(f"{path}: cell {int(fields[0])} is given twice.")
            labels.add(int(fields[0]))
            cells.append((kind, int(fields[0]), fields[1], nodes))
        elif LINKS.match(keyword):
            links[keyword] += 1
        elif CELLS.match(keyword):
            raise UserError(f"{path}: cells of the card {keyword} (the first is {fields[0]}) are not read.")
    blocks: list[RawCells] = []
    properties: list[np.ndarray] = []
    for kind, run in groupby(cells, key=lambda cell: cell[0]):
        rows, own = [], []
        for _, label, number, nodes in run:
            unknown = next((n for n in nodes if n not in row_of), None)
            if unknown is not None:
                raise UserError(f"{path}: cell {label} names node {unknown}, which has no GRID.")
            rows.append([row_of[n] for n in nodes])
            own.append(number)
        blocks.append(RawCells(kind, np.array(rows)))
        properties.append(np.array(own))
    names = {n for own in properties for n in own.tolist() if n}
    return RawMesh(
        np.array(points).reshape(-1, 3),
        blocks,
        cell_sets={
            f"property {n}": [np.flatnonzero(own == n) for own in properties] for n in sorted(names, key=int)
        },
        notes=[
            f"{card} ({number} of them) left out: links, springs and masses are given in `.MCE`."
            for card, number in sorted(links.items())
        ],
    )


def _lines(path: Path, within: list[Path]) -> Iterator[str]:
    """Those of a file, with the files that INCLUDE names in its place. A name may go on on further lines."""
    if path.resolve() in within:
        raise UserError(f"{path}: INCLUDE goes round in a circle.")
    within = [*within, path.resolve()]
    lines = iter(text_of(path).splitlines())
    for line in lines:
        found = re.match(r"\s*INCLUDE\b[\s=]*(.*)", line, re.IGNORECASE)
        if not found:
            yield line
            continue
        name = found[1].strip()
        if (quote := name[:1]) in ("'", '"') and quote:
            while quote not in name[1:] and (more := next(lines, None)) is not None:
                name += more.strip()
            name = name[1:].partition(quote)[0]
        else:
            name = name.partition("$")[0].strip()
        spelled = [folder / name for folder in (path.parent, within[0].parent)]
        source = next((file for file in spelled if file.is_file()), None)
        if source is None:
            raise UserError(f"{path}: there is no file {name}, which INCLUDE reads.")
        yield from _lines(source, within)


def _cards(text: str) -> Iterator[tuple[str, list[str]]]:
    """Keywords and fields of the bulk data: those behind the keyword, at least eight."""
    begin = re.search(r"(?im)^\s*BEGIN\s+BULK.*$", text)
    keyword, fields, wide = "", [""] * 8, False
    for line in text[begin.end() if begin else 0 :].splitlines():
        line = line.partition("$")[0].rstrip().expandtabs(8)
        if not line:
            continue
        free = "," in line
        head = (line.partition(",")[0] if free else line[:8]).strip().upper()
        wide = "*" in head or (wide and not head)
        size, count = (16, 4) if wide else (8, 8)  # what stands behind only names the next line
        words = line.split(",")[1:] if free else [line[i : i + size] for i in range(8, len(line), size)]
        words = [word.strip() for word in words[:count]]
        words += [""] * (count - len(words))
        if head[:1] in ("", "+", "*"):  # goes on with the card above
            fields += words
            continue
        yield keyword, fields + [""] * (8 - len(fields))
        keyword, fields = head.rstrip("*_ "), words  # meshio 5.3 writes CHEXA_ for second order
        if keyword == "ENDDATA":
            return
    yield keyword, fields + [""] * (8 - len(fields))


def _cell(keyword: str, fields: list[str], path: str | Path) -> tuple[str, list[int]]:
    """Kind of a cell and labels of its nodes in VTK's order."""
    kinds = KINDS[keyword]
    sizes = [nodes_of(kind) for kind in kinds]
    given = fields[2 : 2 + max(sizes)]
    which = next((k for k, size in enumerate(sizes) if not any(given[size:])), 0)
    kind, size = kinds[which], sizes[which]
    for word in given[:size]:
        if word and not word.isdecimal():
            raise UserError(
                f"{path}: cell {fields[0]} ({keyword}) has `{word}` where the label of a node stands."
            )
    nodes = [int(word) for word in given[:size] if word]
    if len(nodes) != size and kind != "line":
        raise UserError(
            f"{path}: cell {fields[0]} ({keyword}) has {len(nodes)} nodes instead of "
            f"{' or '.join(str(n) for n in sizes)}."
        )
    order = (0, 2, 4, 1, 3, 5) if keyword in ROUND else ORDERS.get(kind)
    return kind, [nodes[k] for k in order] if order else nodes


def _number(word: str, where: str) -> float:
    """Of Nastran, which has no need of a letter before the exponent: 1.5-3; nothing is zero."""
    try:
        return float(word or "0")
    except ValueError:
        pass
    try:
        return float(re.sub(r"(?<=[\d.])E?(?=[+-]\d+$)", "E", word.upper().replace("D", "E")))
    except ValueError:
        raise UserError(f"{where} has `{word}` where a number stands; is the field cut short?") from None
