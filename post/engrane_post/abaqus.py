# SPDX-License-Identifier: BSD-3-Clause
"""Reads the mesh of an Abaqus input file: *NODE, *ELEMENT, *NSET, *ELSET, *SURFACE, *INCLUDE. Everything else
is passed over. Faces of a surface become cells of their own, as other programs write them, and a surface of
nodes a group of nodes. Numbers and names of an assembly are other ones than those of its part."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path

import numpy as np

from .errors import UserError
from .raw_mesh import RawCells, RawMesh, text_of

#: the node count that a type's number stands for, by the first letters of the types
PLANE = {3: "triangle", 4: "quad", 6: "triangle6", 8: "quad8", 9: "quad9"}
SOLID = {4: "tetra", 5: "pyramid", 6: "wedge", 8: "hexahedron", 10: "tetra10", 15: "wedge15"}
SOLID |= {13: "pyramid13", 20: "hexahedron20", 27: "hexahedron27"}
FAMILIES = (
    (re.compile(r"(?:DC3D|AC3D|C3D|SC|CSS)(\d+)"), SOLID),  # also shells with a thickness of their own
    (re.compile(r"(?:CPS|CPE|CPEG|CAX|CGAX|DC2D|DCAX|AC2D|ACAX|M3D|SFM3D|R3D|DS|S)(\d+)"), PLANE),
    (re.compile(r"STRI(3|6)"), PLANE),
)
LINES = {2: "line", 3: "line3"}
BARS = re.compile(r"(?:T2D|T3D|DC1D|R2D|RAX)(\d)")  # by the number of nodes
BEAMS = re.compile(r"(?:B2|B3|PIPE2|PIPE3|SAX|DSAX|MAX|SFMAX)(\d)")  # by the order: 3 is cubic, with 2 nodes
BEAM_NODES = {"1": 2, "2": 3, "3": 2}
#: corners of the faces S1, S2, … of solids, from 0 (Abaqus Elements Guide, Three-dimensional solid elements)
FACES = {
    "tetra": ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)),
    "wedge": ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    "hexahedron": ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)),
    "triangle": ((0, 1), (1, 2), (2, 0)),
    "quad": ((0, 1), (1, 2), (2, 3), (3, 0)),
}
#: keywords that make nodes or elements from others
GENERATED = dict.fromkeys(("NGEN", "NFILL", "NCOPY", "NMAP"), "makes nodes from others")
GENERATED |= dict.fromkeys(("ELGEN", "ELCOPY"), "makes elements from others")
BASIC = {"tetra10": "tetra", "wedge15": "wedge", "hexahedron20": "hexahedron", "triangle6": "triangle"}
BASIC |= {"quad8": "quad"}
#: what labels and keys of an assembly begin with
OF_ASSEMBLY, ASSEMBLY = 10**12, "*ASSEMBLY*"


@dataclass
class _Section:
    """A keyword line with its parameters, in capitals, and the data lines below it."""

    keyword: str
    parameters: dict[str, str]
    lines: list[str]

    def integers(self) -> np.ndarray:
        return np.array(",".join(self.lines).replace(",", " ").split(), np.int64)


@dataclass
class _Found:
    """What has been read so far. Sets hold labels; labels and keys of the assembly are marked as such."""

    labels: list[np.ndarray] = field(default_factory=list)
    points: list[np.ndarray] = field(default_factory=list)
    blocks: list[tuple[str, np.ndarray, np.ndarray]] = field(default_factory=list)  # kind, labels, nodes
    node_sets: dict[str, list[np.ndarray]] = field(default_factory=dict)
    cell_sets: dict[str, list[np.ndarray]] = field(default_factory=dict)
    surfaces: dict[str, list[tuple[np.ndarray, str]]] = field(default_factory=dict)
    node_surfaces: dict[str, list[np.ndarray]] = field(default_factory=dict)
    spelling: dict[str, str] = field(default_factory=dict)
    instance: str = ""  #: the name of the one instance
    in_assembly: bool = False  #: outside of its instance
    notes: list[str] = field(default_factory=list)

    def of_assembly(self, section: _Section) -> bool:
        """Whether numbers and names in a section of this place are those of the assembly."""
        return self.in_assembly and "INSTANCE" not in section.parameters

    def label(self, numbers: np.ndarray, section: _Section) -> np.ndarray:
        """Numbers as a section of this place has them."""
        return numbers + OF_ASSEMBLY if self.of_assembly(section) else numbers

    def key(self, name: str) -> str:
        """Of a name that is given here."""
        key = (ASSEMBLY if self.in_assembly else "") + name.upper()
        self.spelling.setdefault(key, name)
        return key

    def refer(
        self, word: str, sets: dict[str, list[np.ndarray]], section: _Section
    ) -> list[np.ndarray] | None:
        """Labels by a number or the name of a set, which may name its instance; None if there is none."""
        whole, dot, rest = word.upper().rpartition(".")
        if dot and whole == self.instance.upper():
            return [np.array([int(rest)])] if rest.isdigit() else sets.get(rest)
        if word.isdigit():
            return [self.label(np.array([int(word)]), section)]
        of_part = sets.get(word.upper())
        return sets.get(ASSEMBLY + word.upper(), of_part) if self.of_assembly(section) else of_part

    def names(self) -> dict[str, str]:
        """Of the groups, by key: a name of the part that the assembly has too begins with the instance."""
        twice = {key for key in self.spelling if ASSEMBLY + key in self.spelling}
        prefix = f"{self.instance}." if self.instance else "part."
        return {key: prefix * (key in twice) + name for key, name in self.spelling.items()}


def read(path: str | Path) -> RawMesh:
    """With its sets."""
    path, found = Path(path), _Found()
    sections = list(_sections(path, 0))
    parts = [s for s in sections if s.keyword in ("PART", "INSTANCE")]
    if sum(s.keyword == "PART" for s in parts) > 1 or sum(s.keyword == "INSTANCE" for s in parts) > 1:
        raise UserError(f"{path} has several parts; write it without parts and instances, as one mesh.")
    if any(s.keyword == "INSTANCE" and s.lines for s in parts):
        raise UserError(
            f"{path}: *INSTANCE moves its part; write the mesh where it belongs, without instances."
        )
    for section in sections:
        _take(section, found, path)
    found.spelling = found.names()
    if not found.points or not found.blocks:
        raise UserError(f"{path} has no *NODE and *ELEMENT.")
    given, places = np.concatenate(found.labels)[::-1], np.concatenate(found.points)[::-1]
    labels, last, same = np.unique(given, return_index=True, return_inverse=True)
    points = places[last]
    if (moved := (places != points[same]).any(axis=1)).any():
        found.notes.append(
            f"node {given[moved][-1] % OF_ASSEMBLY} is given at two places; the later one counts"
        )
    cells, times = np.unique(np.concatenate([b[1] for b in found.blocks]), return_counts=True)
    if (twice := cells[times > 1]).size:
        raise UserError(f"{path}: element {twice[0] % OF_ASSEMBLY} is given twice.")

    def rows(wanted: np.ndarray, who: str) -> np.ndarray:
        place = np.minimum(np.searchsorted(labels, wanted), len(labels) - 1)
        unknown = wanted[labels[place] != wanted]
        if unknown.size:
            number = unknown.flat[0] % OF_ASSEMBLY
            raise UserError(f"{path}: {who} names node {number}, which has no *NODE.")
        return place

    blocks = [(kind, rows(nodes, "*ELEMENT")) for kind, _, nodes in found.blocks]
    cell_sets = {
        found.spelling[name]: [_among(block[1], members) for block in found.blocks]
        for name, members in found.cell_sets.items()
    }
    for name, faces in found.surfaces.items():
        _add_surface(name, faces, found, blocks, cell_sets)
    point_sets = {
        found.spelling[name]: rows(np.concatenate(members), f"*NSET {found.spelling[name]}")
        for name, members in found.node_sets.items()
    }
    for name, members in found.node_surfaces.items():
        spelled = found.spelling[name]
        own = np.unique(rows(np.concatenate(members), f"*SURFACE {spelled}"))
        if not np.array_equal(own, np.unique(point_sets.get(spelled, own))):
            raise UserError(f"{path}: *SURFACE {spelled} has other nodes than *NSET {spelled}; rename one.")
        point_sets[spelled] = own
    return RawMesh(
        points,
        [RawCells(kind, nodes) for kind, nodes in blocks],
        point_sets=point_sets,
        cell_sets=cell_sets,
        notes=found.notes,
    )


#: element types that are written for kinds of cells: solids, and plane stress
NOT_IN_NAMES = re.compile(r'[",\n]')  # of sets
TYPES = {"triangle": "CPS3", "quad": "CPS4", "triangle6": "CPS6", "quad8": "CPS8", "tetra": "C3D4"}
TYPES |= {
    "wedge": "C3D6",
    "hexahedron": "C3D8",
    "tetra10": "C3D10",
    "wedge15": "C3D15",
    "hexahedron20": "C3D20",
}


def write(
    path: Path,
    points: np.ndarray,
    node_ids: np.ndarray,
    blocks: list[tuple[str, np.ndarray, np.ndarray]],
    node_sets: dict[str, np.ndarray],
    cell_sets: dict[str, np.ndarray],
) -> None:
    """Nodes, cells by kind (rows of points) with their numbers, sets; 16 numbers on a line at most."""
    with path.open("w", encoding="utf-8") as file:
        file.write("*HEADING\n engrane\n*NODE\n")
        columns = [points[:, k].tolist() for k in range(3)]
        rows = chain.from_iterable(zip(node_ids.tolist(), *columns, strict=True))
        file.write(("%d, %r, %r, %r\n" * len(points)) % tuple(rows))
        for kind, nodes, ids in blocks:
            file.write(f"*ELEMENT, TYPE={TYPES[kind]}\n")
            width = nodes.shape[1] + 1
            words = ["%d"] * width
            line = ", ".join(words[:16]) + (",\n" + ", ".join(words[16:]) if width > 16 else "") + "\n"
            table = np.column_stack([ids, node_ids[nodes]])
            file.write((line * len(table)) % tuple(table.ravel().tolist()))
        for word, sets in (("NSET", node_sets), ("ELSET", cell_sets)):
            for name, members in sets.items():
                file.write(f'*{word}, {word}="{re.sub(NOT_IN_NAMES, "_", name)}"\n')
                for at in range(0, len(members), 16):
                    file.write(", ".join(map(str, members[at : at + 16].tolist())) + "\n")


def _among(labels: np.ndarray, members: list[np.ndarray]) -> np.ndarray:
    return np.flatnonzero(np.isin(labels, np.concatenate(members)))


def _sections(path: Path, depth: int) -> Iterator[_Section]:
    if depth > 20:
        raise UserError(f"{path}: *INCLUDE goes round in a circle.")
    if not path.is_file():
        raise UserError(f"There is no file {path}.")
    lines = [line.lstrip() for line in text_of(path).splitlines()]
    marks = [i for i, line in enumerate(lines) if line.startswith("*") and not line.startswith("**")]
    for begin, end in zip(marks, [*marks[1:], len(lines)], strict=True):
        head = lines[begin]
        while head.rstrip().endswith(",") and begin + 1 < end:
            begin += 1
            head += lines[begin]
        words = [w.strip() for w in head[1:].split(",")]
        parameters = {}
        for word in words[1:]:
            key, _, value = word.partition("=")
            parameters[key.strip().upper()] = value.strip().strip('"')
        keyword = words[0].upper()
        if keyword == "INCLUDE":
            yield from _sections(path.parent / parameters.get("INPUT", ""), depth + 1)
            continue
        rows = lines[begin + 1 : end]
        if "INPUT" in parameters:
            source = path.parent / parameters["INPUT"]
            if not source.is_file():
                raise UserError(f"{path}: there is no file {source}, which *{keyword} reads.")
            rows = text_of(source).splitlines()
        data = [s for s in rows if s.strip() and not s.lstrip().startswith("**")]
        yield _Section(keyword, parameters, data)


def _take(section: _Section, found: _Found, path: Path) -> None:
    p = section.parameters
    if section.keyword in ("ASSEMBLY", "END INSTANCE"):
        found.in_assembly = True
    elif section.keyword in ("INSTANCE", "END ASSEMBLY"):
        found.in_assembly = False
        found.instance = p.get("NAME", found.instance)
    if section.keyword in GENERATED or (section.keyword == "SYSTEM" and section.lines):
        what = GENERATED.get(section.keyword, "moves or turns nodes")
        raise UserError(
            f"{path}: *{section.keyword} {what}, which is not read: write the whole mesh, in global "
            "coordinates."
        )
    if section.keyword == "NODE" and section.lines:
        labels, coordinates = _nodes(section.lines)
        coordinates = _cartesian(coordinates, p.get("SYSTEM", "R").upper())
        found.labels.append(found.label(labels, section))
        found.points.append(coordinates)
        _into(found, found.node_sets, p.get("NSET"), [found.labels[-1]])
    elif section.keyword == "ELEMENT" and section.lines:
        kind, nodes = _kind(p.get("TYPE", "").upper())
        if not nodes:  # not a mesh's: springs, masses, connectors
            nodes = section.lines[0].rstrip().rstrip(",").count(",")
        data = _integers(section, found)
        if nodes < 1 or len(data) % (nodes + 1):
            raise UserError(
                f"{path}: *ELEMENT, TYPE={p.get('TYPE', '')} has {len(data)} numbers, which are no rows of "
                f"a label and {nodes} nodes."
            )
        data = found.label(data.reshape(-1, nodes + 1), section)
        nodes = data[:, [1, 3, 2]] if kind == "line3" else data[:, 1:]  # the middle stands between the ends
        found.blocks.append((kind, data[:, 0], nodes))
        _into(found, found.cell_sets, p.get("ELSET"), [data[:, 0]])
    elif section.keyword in ("NSET", "ELSET") and section.keyword in p:
        sets = found.node_sets if section.keyword == "NSET" else found.cell_sets
        _into(found, sets, p[section.keyword], _members(section, sets, found, path))
    elif section.keyword == "SURFACE" and "COMBINE" in p:
        found.notes.append(f"*SURFACE {p.get('NAME', '')} combines others, which is not read")
    elif section.keyword == "SURFACE" and "NAME" in p and p.get("TYPE", "ELEMENT").upper() == "ELEMENT":
        rows = [[w.strip().strip('"') for w in [*s.split(","), ""][:2]] for s in section.lines]
        for who, face in rows:
            members = found.refer(who, found.cell_sets, section)
            labels = np.concatenate(members) if members else np.zeros(0, int)
            found.surfaces.setdefault(found.key(p["NAME"]), []).append((labels, face.upper()))
    elif section.keyword == "SURFACE" and "NAME" in p and p["TYPE"].upper() == "NODE":
        # nodes or sets of nodes, each with an area at most
        firsts = [line.partition(",")[0].strip().strip('"') for line in section.lines]
        for word in firsts:
            members = found.refer(word, found.node_sets, section)
            if members is None:
                raise UserError(f"{path}: *SURFACE names {word}, which is no set of nodes before it.")
            found.node_surfaces.setdefault(found.key(p["NAME"]), []).extend(members)


def _nodes(lines: list[str]) -> tuple[np.ndarray, np.ndarray]:
    """Labels and coordinates; those that a line lacks are zero. An exponent may begin with D."""
    lines = [line.upper().replace("D", "E") for line in lines]
    flat = ",".join(lines).replace(",", " ").split()
    if len(flat) == 4 * len(lines) and all(line.count(",") in (3, 4) for line in lines):
        table = np.array(flat, float).reshape(-1, 4)
    else:
        rows = [[w.strip() or "0" for w in line.split(",")] for line in lines]
        table = np.array([[*row, "0", "0", "0"][:4] for row in rows], float)
    return table[:, 0].astype(np.int64), table[:, 1:]


def _cartesian(table: np.ndarray, system: str) -> np.ndarray:
    """Of *NODE, SYSTEM=C (r, θ, z) or S (r, θ, φ above the plane), angles in degrees."""
    if system == "C":
        radius, angle = table[:, 0], np.radians(table[:, 1])
        return np.column_stack((radius * np.cos(angle), radius * np.sin(angle), table[:, 2]))
    if system == "S":
        radius, angle, height = table[:, 0], np.radians(table[:, 1]), np.radians(table[:, 2])
        flat = radius * np.cos(height)
        return np.column_stack((flat * np.cos(angle), flat * np.sin(angle), radius * np.sin(height)))
    return table


def _into(found: _Found, sets: dict[str, list[np.ndarray]], name: str | None, more: list[np.ndarray]) -> None:
    if name:
        sets.setdefault(found.key(name), []).extend(more)


def _integers(section: _Section, found: _Found) -> np.ndarray:
    """The numbers of an element's lines; nodes of the instance may be written as P-1.3."""
    try:
        return section.integers()
    except ValueError:
        words = ",".join(section.lines).replace(",", " ").split()
        of_part = [w.upper().startswith(f"{found.instance.upper()}.") for w in words]
        numbers = np.array(
            [w[len(found.instance) + 1 :] if o else w for w, o in zip(words, of_part, strict=True)]
        )
        # label() adds the same to all
        return numbers.astype(np.int64) - OF_ASSEMBLY * np.array(of_part)


def _members(
    section: _Section, sets: dict[str, list[np.ndarray]], found: _Found, path: Path
) -> list[np.ndarray]:
    """Labels of a set: numbers, ranges, names of other sets, the nodes of a set of elements."""
    if "GENERATE" in section.parameters:
        out = []
        for line in section.lines:
            low, high, *step = (int(w) for w in line.rstrip().rstrip(",").split(","))
            out.append(found.label(np.arange(low, high + 1, step[0] if step else 1), section))
        return out
    words = " ".join(section.lines).replace(",", " ").split()
    numbers = np.array([w for w in words if w.isdigit()], np.int64)
    out = [found.label(numbers, section)]
    for word in (w for w in words if not w.isdigit()):
        members = found.refer(word, sets, section)
        if members is None:
            raise UserError(f"{path}: *{section.keyword} names {word}, which is no set before it.")
        out += members
    if section.keyword == "NSET" and "ELSET" in section.parameters:
        word = section.parameters["ELSET"]
        cells = found.refer(word, found.cell_sets, section)
        if cells is None:
            raise UserError(f"{path}: *NSET names {word}, which is no set of elements before it.")
        wanted = np.concatenate(cells)
        out += [np.unique(nodes[np.isin(labels, wanted)]) for _, labels, nodes in found.blocks]
    return out


def _kind(word: str) -> tuple[str, int]:
    """Of an element type: meshio's name and the number of nodes; 0 when it is not known."""
    for pattern, kinds in FAMILIES:
        match = pattern.match(word)
        if match and int(match[1]) in kinds:
            return kinds[int(match[1])], int(match[1])
    if match := BARS.match(word):
        nodes = int(match[1])
    else:
        match = BEAMS.match(word)
        nodes = BEAM_NODES.get(match[1], 0) if match else 0
    if nodes in LINES:
        return LINES[nodes], nodes
    return word or "?", 0


def _add_surface(
    name: str,
    faces: list[tuple[np.ndarray, str]],
    found: _Found,
    blocks: list[tuple[str, np.ndarray]],
    cell_sets: dict[str, list[np.ndarray]],
) -> None:
    """The faces as cells of their corners, in a group with the name of the surface. Without a face: all faces
    of the solids that no other solid shares."""
    corners: dict[int, list[np.ndarray]] = {}
    spelled = found.spelling[name]
    own_blocks = blocks[: len(found.blocks)]
    for wanted, face in faces:
        k = int(face[1:]) if face[:1] == "S" and face[1:].isdigit() else 0
        if not face:
            exposed = _exposed(wanted, found, own_blocks)
            if not exposed:
                found.notes.append(
                    f"*SURFACE {spelled} has rows without a face, which are read of solids only"
                )
            for size, rows in exposed.items():
                corners.setdefault(size, []).append(rows)
        for (kind, labels, _), (_, nodes) in zip(found.blocks, own_blocks, strict=True):
            loops = FACES.get(BASIC.get(kind, kind), ())
            mine = np.isin(labels, wanted)
            if 1 <= k <= len(loops) and mine.any():
                loop = list(loops[k - 1])
                corners.setdefault(len(loop), []).append(nodes[mine][:, loop])
    if not corners:  # an empty group, to be told of
        cell_sets.setdefault(spelled, [np.zeros(0, int) for _ in blocks])
    for size, rows in corners.items():
        block = ({2: "line", 3: "triangle", 4: "quad"}[size], np.concatenate(rows))
        for members in cell_sets.values():
            members.append(np.zeros(0, int))
        own = cell_sets.setdefault(spelled, [])
        own += [np.zeros(0, int)] * (len(blocks) + 1 - len(own))
        own[-1] = np.arange(len(block[1]))
        blocks.append(block)


def _exposed(
    wanted: np.ndarray, found: _Found, blocks: list[tuple[str, np.ndarray]]
) -> dict[int, np.ndarray]:
    """By their number of corners, the faces of these solids that belong to no other solid."""
    faces: dict[int, list[np.ndarray]] = {}
    mine: dict[int, list[np.ndarray]] = {}
    for (kind, labels, _), (_, nodes) in zip(found.blocks, blocks, strict=True):
        for loop in FACES.get(BASIC.get(kind, kind), ()):
            if len(loop) < 3:
                break  # a plane cell
            faces.setdefault(len(loop), []).append(nodes[:, list(loop)])
            mine.setdefault(len(loop), []).append(np.isin(labels, wanted))
    exposed = {}
    for size, rows in faces.items():
        table, own = np.concatenate(rows), np.concatenate(mine[size])
        _, same, count = np.unique(np.sort(table, axis=1), axis=0, return_inverse=True, return_counts=True)
        if (free := own & (count[same.ravel()] == 1)).any():
            exposed[size] = table[free]
    return exposed
