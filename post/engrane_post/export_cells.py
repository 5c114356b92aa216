# SPDX-License-Identifier: BSD-3-Clause
"""The cells of a result, with the fields on them, as a mesh file of another program."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from dataclasses import field as with_default
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from . import abaqus
from .cells import BY_XDMF, Kind, runs
from .deck_groups import Groups
from .errors import UserError
from .mesh import Mesh, Step
from .mesh_files import MARK
from .raw_mesh import meshio_library
from .results import Field, Frame, Results

#: endings of files for one frame
FILES = (".vtu", ".vtk", ".med", ".msh", ".inp", ".bdf")
#: endings of files for many
SERIES = (".vtkhdf", ".pvd")
HELD = {".vtu": "all", ".vtk": "all", ".med": "all", ".msh": "some"}  # fields; the others hold none

#: groups that a file of an ending holds, where it does not hold all
HELD_GROUPS = {".msh": "one group of each cell and none of nodes", ".bdf": "no groups"}


@dataclass
class Cells:
    """Cells of a result by kind: rows of its nodes, and where each stands among the cells of the result."""

    result: Results
    kinds: list[tuple[Kind, np.ndarray, np.ndarray]]

    @classmethod
    def of(cls, result: Results) -> Cells:
        topology = result.dataset("mesh/topology")
        found = [] if topology is None else runs(topology)
        by_kind: dict[int, list[tuple[np.ndarray, np.ndarray]]] = {}
        for run in found:
            if run.code in BY_XDMF:
                places = run.first + np.arange(len(run.nodes))
                by_kind.setdefault(run.code, []).append((run.nodes, places))
        if not by_kind:
            raise UserError(
                f"{result.path} has no cells of a mesh; without --mesh all that is drawn is written."
            )
        return cls(
            result,
            [
                (BY_XDMF[code], np.concatenate([n for n, _ in parts]), np.concatenate([p for _, p in parts]))
                for code, parts in by_kind.items()
            ],
        )

    def __post_init__(self) -> None:
        # only nodes that cells have, in the order of the result
        self.used, inverse = np.unique(
            np.concatenate([nodes.ravel() for _, nodes, _ in self.kinds]), return_inverse=True
        )
        inverse = np.ravel(inverse)
        self.blocks: list[tuple[Kind, np.ndarray]] = []
        at = 0
        for kind, nodes, _ in self.kinds:
            self.blocks.append((kind, inverse[at : at + nodes.size].reshape(nodes.shape)))
            at += nodes.size
        self.order = np.concatenate([p for _, _, p in self.kinds])
        self.points = self.result.points[self.used]
        self.node_ids = self.result.node_ids[self.used]
        owner = self.result.dataset("mesh/cell_elements")
        self.cell_ids = (self.order + 1 if owner is None else np.asarray(owner, int)[self.order]).astype(int)
        self.groups = Groups(self.result, self.node_ids, self.points, self.cell_ids)

    def fields(self, frame: Frame) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
        """Of the nodes and of the cells, by name."""
        if frame.index is None:
            return {}, {}
        nodes, cells = {}, {}
        for name, field in self.result.fields.items():
            values = self.result.read(
                lambda f, n=name: (
                    f[f"fields/{n}/{frame.index:06d}"][()] if f"fields/{n}/{frame.index:06d}" in f else None
                )
            )
            if values is not None:
                rows = self.order if field.of_cells else self.used
                values = np.asarray(values, float).reshape(len(values), -1)[rows]
                (cells if field.of_cells else nodes)[name] = values if values.shape[1] > 1 else values[:, 0]
        for name in self.result.averages:
            values = self.result.dataset(f"nodes/{name}/{frame.index:06d}")
            if values is not None:
                values = np.asarray(values, float).reshape(len(values), -1)[self.used]
                nodes[name] = values if values.shape[1] > 1 else values[:, 0]
        return nodes, cells

    def by_block(self, values: np.ndarray) -> list[np.ndarray]:
        """Rows of all cells, for each kind apart."""
        return np.split(values, np.cumsum([len(n) for _, n in self.blocks])[:-1])

    def mesh(self) -> Mesh:
        """As VTK has it."""
        sizes = np.concatenate([np.full(len(n), n.shape[1]) for _, n in self.blocks])
        return Mesh(
            np.concatenate([np.full(len(n), k.vtk, np.uint8) for k, n in self.blocks]),
            np.concatenate([[0], np.cumsum(sizes)]),
            np.concatenate([n.ravel() for _, n in self.blocks]),
            {"element": self.cell_ids.astype(np.int32)} | _marks(self.groups.cells),
            {"node": self.node_ids.astype(np.int32)} | _marks(self.groups.nodes),
        )


def _marks(groups: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    return {MARK + name: members.astype(np.int32) for name, members in groups.items()}


@dataclass
class Left:
    """Names of what a format cannot hold."""

    fields: list[str] = with_default(default_factory=list)
    groups: list[str] = with_default(default_factory=list)


def write_series(cells: Cells, frames: list[Frame], path: Path) -> Path:
    """All frames, where the cells stand in the reference configuration, with displacement as a field."""
    from .vtkhdf import write
    from .vtkhdf import write_series as write_list
    from .vtu import write_collection

    def steps() -> Iterator[Step]:
        for frame in frames:
            assert frame.time is not None
            nodes, own = cells.fields(frame)
            yield Step(frame.time, cells.points, nodes, own)

    if path.suffix == ".pvd":
        return write_collection(path.with_suffix(""), cells.mesh(), steps())[0]
    write(path, cells.mesh(), np.array([f.time for f in frames], float), steps())
    write_list(path)
    return path


def write_frame(cells: Cells, frame: Frame, path: Path) -> Left:
    """One frame."""
    suffix = path.suffix.lower()
    nodes, own = cells.fields(frame)
    if suffix in (".vtu", ".vtk"):
        from .graphics import pv
        from .vtu import save

        mesh = cells.mesh()
        rows = np.insert(mesh.connectivity, mesh.offsets[:-1], np.diff(mesh.offsets))
        grid = pv.UnstructuredGrid(rows, mesh.types, cells.points)
        grid.point_data.update(mesh.point_data | nodes)
        grid.cell_data.update(mesh.cell_data | own)
        for data, found in ((grid.GetPointData(), nodes), (grid.GetCellData(), own)):
            for name in found:
                for k, component in enumerate(cells.result.fields[name].components):
                    data.GetArray(name).SetComponentName(k, component)
        save(grid, path)
        return Left()
    if suffix == ".inp":
        abaqus.write(
            path,
            cells.points,
            cells.node_ids,
            [
                (kind.name, table, ids)
                for (kind, table), ids in zip(cells.blocks, cells.by_block(cells.cell_ids), strict=True)
            ],
            {name: np.unique(cells.node_ids[members]) for name, members in cells.groups.nodes.items()},
            {name: np.unique(cells.cell_ids[members]) for name, members in cells.groups.cells.items()},
        )
        return Left(sorted({*nodes, *own}))
    return _by_meshio(cells, nodes, own, path)


def _by_meshio(cells: Cells, nodes: dict[str, np.ndarray], own: dict[str, np.ndarray], path: Path) -> Left:
    meshio = meshio_library()
    suffix, fields = path.suffix.lower(), cells.result.fields
    held = HELD.get(suffix)
    left = Left([] if held else sorted({*nodes, *own}))
    tables = [(k, t[:, k.mirror] if suffix == ".med" and k.dimension == 3 else t) for k, t in cells.blocks]
    # what rounding leaves of a zero has more characters than a field of Nastran
    points = np.where(np.abs(cells.points) < 1e-12 * np.abs(cells.points).max(initial=0), 0, cells.points)
    if suffix == ".bdf":
        points, tables = _joined(points, tables, cells.node_ids)
    mesh = meshio.Mesh(points, [(k.name, t) for k, t in tables])
    if held == "some":  # numbers, vectors and full tensors
        nodes, own = (_split(data, fields) for data in (nodes, own))
    if held:
        mesh.point_data = {"node": cells.node_ids.astype(float)} | nodes
        mesh.cell_data = {
            name: cells.by_block(values)
            for name, values in ({"element": cells.cell_ids.astype(float)} | own).items()
        }
    if suffix == ".msh":
        left.groups = _put_physical_groups(mesh, cells)
    if suffix == ".bdf":
        left.groups = [*cells.groups.cells, *cells.groups.nodes]
    if suffix == ".med":
        mesh.point_tags, mesh.point_data["point_tags"] = _families(cells.groups.nodes, len(points), 1)
        mesh.cell_tags, tags = _families(cells.groups.cells, len(cells.order), -1)
        mesh.cell_data["cell_tags"] = cells.by_block(tags)
        mesh.field_data["med:nom"] = [
            [c[:16] for c in fields[n].components] if n in fields and fields[n].components else [n[:16]]
            for n in [*mesh.point_data, *mesh.cell_data]
            if n not in ("point_tags", "cell_tags")
        ]
    try:
        if suffix == ".med":  # in memory first: see h5_writing.py
            memory = BytesIO()
            meshio.med.write(memory, mesh)
            path.write_bytes(memory.getbuffer())
        else:
            meshio.write(path, mesh, file_format="gmsh22" if suffix == ".msh" else None)
    except OSError:
        raise
    except (Exception, SystemExit) as error:
        raise UserError(
            f"The cells cannot be written as {suffix}: {str(error) or type(error).__name__}."
        ) from None
    if suffix == ".bdf":  # meshio 5.3 writes CHEXA_, which Nastran does not know, for second order
        text = path.read_text(encoding="ascii")
        path.write_text(re.sub(r"(?m)^(C[A-Z]+)_", r"\1 ", text), encoding="ascii")
    return left


def _joined(
    points: np.ndarray, tables: list[tuple[Kind, np.ndarray]], ids: np.ndarray
) -> tuple[np.ndarray, list[tuple[Kind, np.ndarray]]]:
    """One node for the parts that meet there, in a file without fields, and what a long field of Nastran has
    room for: ten digits."""
    _, first, same = np.unique(ids, return_index=True, return_inverse=True)
    rounded = [[float(f"{x:.10g}") for x in point] for point in points[first]]
    return np.array(rounded), [(kind, np.ravel(same)[table]) for kind, table in tables]


def _families(
    groups: dict[str, np.ndarray], count: int, sign: int
) -> tuple[dict[int, list[str]], np.ndarray]:
    """Families of MED, each of those that are in the same groups: their groups, and the family of each. Those
    of nodes have positive numbers, those of cells negative ones; 0 is in no group. Names are ASCII of 80
    characters without strokes."""
    tags = np.zeros(count, np.int64)
    families: dict[int, list[str]] = {0: []}
    for name, members in groups.items():
        for family in np.unique(tags[members]).tolist():
            mine = members & (tags == family)
            new = sign * len(families)
            families[new] = [*families[family], re.sub(r"[^ -.0-~]", "_", name)[:80]]
            tags[mine] = new
    present = set(np.unique(tags).tolist())
    return {n: names for n, names in families.items() if names and n in present}, tags


def _put_physical_groups(mesh: Any, cells: Cells) -> list[str]:
    """The groups as Gmsh's: a cell is in one at most, which has one dimension; smaller groups come first.
    Returns those that are left out."""
    left = list(cells.groups.nodes)
    physical = np.zeros(len(cells.order), int)
    dimension = np.concatenate([np.full(len(t), k.dimension) for k, t in cells.blocks])
    for name, members in sorted(cells.groups.cells.items(), key=lambda group: group[1].sum()):
        if physical[members].any() or len(np.unique(dimension[members])) > 1:
            left.append(name)
            continue
        number = len(mesh.field_data) + 1
        mesh.field_data[name] = np.array([number, dimension[members][0]])
        physical[members] = number
    # of every cell two numbers are wanted: of its group and of its part
    mesh.cell_data["gmsh:physical"] = cells.by_block(physical if mesh.field_data else physical + 1)
    mesh.cell_data["gmsh:geometrical"] = cells.by_block(np.ones(len(physical), int))
    return left


def _split(data: dict[str, np.ndarray], fields: dict[str, Field]) -> dict[str, np.ndarray]:
    """Each component by itself where they are no vector."""
    out: dict[str, np.ndarray] = {}
    for name, values in data.items():
        if values.ndim == 1 or values.shape[1] in (1, 3):
            out[name] = values
        else:
            names = fields[name].components or [str(k + 1) for k in range(values.shape[1])]
            out |= {f"{name}_{c}": values[:, k] for k, c in enumerate(names)}
    return out
