# SPDX-License-Identifier: BSD-3-Clause
"""Reads the mesh files of other programs: points, cells, and the groups that each names in its own way."""

from __future__ import annotations

import logging
import os
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from importlib import import_module
from io import StringIO
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from .cells import BY_NAME, dimension_of, nodes_of
from .errors import UserError
from .raw_mesh import meshio_library

#: numbers of parts or groups that readers hand over with the cells, and what a group without a name is called
TAGS = {
    "gmsh:physical": "physical",
    "medit:ref": "ref",
    "avsucd:material": "material",
    "flac3d:group": "group",
    "tetgen:ref": "ref",
    "ugrid:ref": "ref",
    "su2:tag": "tag",
    "mdpa:property": "property",
    "cellentityids": "entity",
    "materialids": "material",
    "physicalids": "physical",
    "groupids": "group",
    "partids": "part",
    "material": "material",
    "group": "group",
    "region": "region",
    "part": "part",
}
HINTS = {
    "but len(point_data[": "it holds fields over some of its nodes only, which meshio cannot place: "
    "write the mesh alone",
    "Incompatible cell data. Cell block": "it holds fields over its cells, which meshio cannot sort: "
    "write the mesh alone",
    "Incompatible cell data 'gmsh:physical'": "some cells are in no physical group: save the mesh without "
    "'Save all elements', or with all of them in groups",
}


#: endings of files that have readers here, and the modules of these
OWN = {".unv": "unv", ".inp": "abaqus", ".bdf": "nastran", ".fem": "nastran", ".nas": "nastran"}
VTK = (".vtk", ".vtu")
#: what the name of an array of VTK begins with that is 1 for the members of a group
MARK = "group "


@dataclass
class FileMesh:
    """A mesh as its file has it: points (n x 3), cells by meshio's names of their kinds, and groups: which
    cells of each block, which points."""

    path: Path
    points: np.ndarray
    blocks: list[tuple[str, np.ndarray]]
    cell_groups: dict[str, list[np.ndarray]] = field(default_factory=dict)
    point_groups: dict[str, np.ndarray] = field(default_factory=dict)
    #: kinds of cells that are numbered either way round, none of which is inside out
    both_ways: tuple[str, ...] = ()
    #: of what is in the file and not here
    notes: list[str] = field(default_factory=list)


def open_mesh(path: str | Path) -> Any:
    """The mesh of a file as meshio has it."""
    meshio = meshio_library()
    if not Path(path).is_file():
        raise UserError(f"There is no file {path}.")
    try:
        suffix = Path(path).suffix.lower()
        if suffix in OWN:
            return import_module(f".{OWN[suffix]}", __package__).read(path)
        # its guess whether an STL is binary may overflow; it writes empty lines, and what it could not read
        with np.errstate(over="ignore"), redirect_stdout(StringIO()), redirect_stderr(StringIO()):
            return _read_vtk(path, meshio) if suffix in VTK else meshio.read(path)
    except UserError:
        raise
    except (Exception, SystemExit) as error:  # meshio ends the program on a format that it does not know
        hint = next((h for sign, h in HINTS.items() if sign in str(error)), "")
        if "deduce file format" in str(error):
            hint = f"files that end in {suffix} are not known" if suffix else "its name has no ending"
        elif not hint:
            hint = f"it is no {suffix} file, or a damaged one, or has what is not known here"
        raise UserError(f"{path} is no mesh that can be read: {hint}.") from None


def _read_vtk(path: str | Path, meshio: Any) -> Any:
    """A file of VTK by meshio, or by VTK itself, which writes kinds of files and cells that meshio does not
    know."""
    try:
        mesh, left_out = _read_all(path, meshio)
        if not left_out:
            return mesh
    except (Exception, SystemExit):
        with open(path, "rb") as file:
            head = file.read(64).lower().lstrip()
        if not head.startswith((b"# vtk datafile", b"<?xml", b"<vtkfile")):
            raise
    with TemporaryDirectory() as folder:
        copy = Path(folder) / "mesh.vtu"
        # VTK may crash on a damaged file, and takes others for whole ones
        child = get_context("spawn").Process(target=_copy_by_vtk, args=(str(path), str(copy)))
        child.start()
        child.join()
        if child.exitcode != 0:
            raise UserError(
                f"{path} is no mesh that can be read: it is damaged, such as cut short, or has what is not "
                "known here."
            )
        mesh, left_out = _read_all(copy, meshio)
    if left_out:
        from .graphics import pv

        names = ", ".join(pv.CellType(n).name if n in iter(pv.CellType) else str(n) for n in left_out)
        raise UserError(f"{path} has cells of VTK's types {names}, which are not known here.")
    return mesh


def _copy_by_vtk(path: str, copy: str) -> None:
    """Writes what VTK reads of a file as one that meshio knows. Runs in a process of its own, whose status
    tells whether VTK had no complaint."""
    from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

    from .graphics import pv

    warnings.simplefilter("ignore")

    said = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(said)
    try:
        with _silence():
            _order_boxes(pv.read(path).cast_to_unstructured_grid()).save(copy)
    except Exception:
        os._exit(1)
    os._exit(1 if "rror" in said.GetOutput() else 0)


def _read_all(path: str | Path, meshio: Any) -> tuple[Any, list[int]]:
    """The mesh, and the types of VTK whose cells meshio has left out."""
    said = StringIO()
    with redirect_stderr(said):
        mesh = meshio.read(path)
    return mesh, sorted({int(n) for n in re.findall(r"cannot\s+handle\s+\(type\s+(\d+)\)", said.getvalue())})


def _order_boxes(grid: Any) -> Any:
    """With quadrilaterals and hexahedra for pixels and voxels, whose nodes run in rows instead of around."""
    from .graphics import offsets_of, pv

    nodes, types, offsets = grid.cell_connectivity.copy(), grid.celltypes.copy(), offsets_of(grid)
    for box, other, order in ((8, 9, [0, 1, 3, 2]), (11, 12, [0, 1, 3, 2, 4, 5, 7, 6])):
        begins = offsets[:-1][grid.celltypes == box]
        own = begins[:, None] + np.arange(len(order))
        nodes[own] = nodes[own[:, order]]
        types[grid.celltypes == box] = other
    rows = np.insert(nodes, offsets[:-1], np.diff(offsets))
    ordered = pv.UnstructuredGrid(rows, types, grid.points)
    ordered.cell_data.update(grid.cell_data)
    ordered.point_data.update(grid.point_data)
    return ordered


@contextmanager
def _silence() -> Iterator[None]:
    """VTK and pyvista write no messages of their own."""
    from vtkmodules.vtkCommonCore import vtkLogger

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    logging.disable(logging.CRITICAL)
    try:
        yield
    finally:
        logging.disable(logging.NOTSET)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_INFO)


def read(path: str | Path) -> FileMesh:
    """Points, cells and groups of a file."""
    source = open_mesh(path)
    given = np.asarray(source.points, float)
    given = given if given.ndim == 2 else given.reshape(-1, 3)
    points = np.zeros((len(given), 3))
    points[:, : given.shape[1]] = given
    if not np.isfinite(points).all():
        bad = int(np.flatnonzero(~np.isfinite(points).all(axis=1))[0])
        raise UserError(f"{path}: the coordinates of node {bad + 1} are not numbers.")
    blocks = [(b.type, np.asarray(b.data)) for b in source.cells]
    _check_nodes(path, blocks, len(points))
    if Path(path).suffix.lower() == ".med":  # the base of a solid runs the other way round than in VTK
        blocks = [
            (n, t[:, BY_NAME[n].mirror] if dimension_of(n) == 3 and n in BY_NAME else t) for n, t in blocks
        ]
    mesh = FileMesh(Path(path), points, blocks, notes=list(getattr(source, "notes", [])))
    if Path(path).suffix.lower() in VTK:
        # VTK's pages long drew wedges upside down, and meshio and others write them so; VTK itself computes
        # with the base that other solids have
        mesh.both_ways = ("wedge", "wedge15")
    for name, members in source.cell_sets.items():
        if not name.startswith("gmsh:") and len(members) == len(blocks):
            mesh.cell_groups[name] = [_indices(m) for m in members]
    for name, rows in source.point_sets.items():
        mesh.point_groups[name] = _indices(rows)
    _tagged_cells(source, mesh)
    _families(source, mesh)
    _marked(source, mesh)
    _join(source, mesh)
    return mesh


def _join(source: Any, mesh: FileMesh) -> None:
    """Makes one of the nodes that `engrane export` writes for each of the parts that meet there."""
    numbers = np.asarray(source.point_data.get("node", []), float)
    if numbers.shape != (len(mesh.points),):
        return
    _, first, same = np.unique(numbers, return_index=True, return_inverse=True)
    if len(first) == len(numbers) or (mesh.points != mesh.points[first][same]).any():
        return
    kept = np.sort(first)
    new = np.searchsorted(kept, first[same])
    mesh.points = mesh.points[kept]
    mesh.blocks = [(name, new[nodes]) for name, nodes in mesh.blocks]
    mesh.point_groups = {name: np.unique(new[rows]) for name, rows in mesh.point_groups.items()}


def _check_nodes(path: str | Path, blocks: list[tuple[str, np.ndarray]], points: int) -> None:
    """Each cell has the nodes of its kind, and these exist."""
    first = 1
    for name, nodes in blocks:
        size = nodes_of(name)
        if len(nodes) and size and nodes.shape[1:] != (size,):
            row = nodes[0]
            raise UserError(f"{path}: cell {first} ({name}) has {np.size(row)} nodes instead of {size}.")
        if nodes.ndim == 2 and nodes.size and nodes.dtype.kind in "iu":
            bad = np.argwhere((nodes < 0) | (nodes >= points))
            if len(bad):
                row, column = bad[0]
                raise UserError(
                    f"{path}: cell {first + row} ({name}) names node {nodes[row, column] + 1}, and there are "
                    f"{points}."
                )
        first += len(nodes)


def _indices(members: Any) -> np.ndarray:
    """Of a set, which a file may leave empty."""
    return np.zeros(0, int) if members is None else np.asarray(members, int).ravel()


def _tagged_cells(source: Any, mesh: FileMesh) -> None:
    """Groups from numbers that every cell has. Names of Gmsh's numbers belong to one dimension."""
    data = {name.lower(): values for name, values in source.cell_data.items()}
    names = {
        (int(v[0]), int(v[1])): name
        for name, v in source.field_data.items()
        if len(v) == 2 and all(isinstance(n, int | np.integer) for n in v)
    }
    if mesh.path.suffix.lower() == ".msh":
        names |= _physical_names(mesh.path)
    said = {name for name, sets in source.cell_sets.items() if any(len(_indices(m)) for m in sets)}
    for key, word in TAGS.items():
        # in files of some kinds 0 says that a cell has no group
        others = any(np.any(np.asarray(tags) != 0) for tags in data.get(key, ()))
        counts_from_zero = word == "property" or (":" not in key and others)
        for b, tags in enumerate(data.get(key, ())):
            tags = np.asarray(tags)
            if tags.ndim == 2 and tags.shape[1] == 1:  # SCALARS of VTK
                tags = tags[:, 0]
            if tags.ndim != 1 or not np.issubdtype(tags.dtype, np.integer):
                continue
            dimension = dimension_of(mesh.blocks[b][0])
            for tag in np.unique(tags):
                # of a negative number the orientation is reversed (Gmsh)
                name = names.get((abs(int(tag)), dimension), f"{word} {tag}")
                # sets of the same name say it better: a cell may be in several
                if (tag == 0 and not counts_from_zero) or name in said:
                    continue
                found = mesh.cell_groups.setdefault(name, [np.zeros(0, int) for _ in mesh.blocks])
                found[b] = np.union1d(found[b], np.flatnonzero(tags == tag))


def _physical_names(path: Path) -> dict[tuple[int, int], str]:
    """Of Gmsh, by number and dimension. meshio keeps one of several dimensions that have the same name."""
    raw = path.read_bytes()
    begin, end = raw.find(b"$PhysicalNames"), raw.find(b"$EndPhysicalNames")
    if not 0 <= begin < end:
        return {}
    rows = re.findall(
        r'^\s*(\d)\s+(\d+)\s+"(.*)"\s*$', raw[begin:end].decode("utf-8", "replace"), re.MULTILINE
    )
    return {(int(number), int(dimension)): name for dimension, number, name in rows}


def _families(source: Any, mesh: FileMesh) -> None:
    """Groups of MED: each cell and point has the number of a family, which is in several groups."""
    families = getattr(source, "cell_tags", {})
    for b, tags in enumerate(source.cell_data.get("cell_tags", [])):
        for family, groups in families.items():
            rows = np.flatnonzero(np.asarray(tags) == family)
            for name in groups if len(rows) else ():
                found = mesh.cell_groups.setdefault(str(name), [np.zeros(0, int) for _ in mesh.blocks])
                found[b] = np.union1d(found[b], rows)
    tags = np.asarray(source.point_data.get("point_tags", []))
    for family, groups in getattr(source, "point_tags", {}).items():
        rows = np.flatnonzero(tags == family)
        for name in groups if len(rows) else ():
            old = mesh.point_groups.get(str(name), np.zeros(0, int))
            mesh.point_groups[str(name)] = np.union1d(old, rows)


def _marked(source: Any, mesh: FileMesh) -> None:
    """Groups as `engrane export` writes them to files of VTK: arrays that are 1 for their members."""
    for name, blocks in source.cell_data.items():
        if name.startswith(MARK):
            mesh.cell_groups[name.removeprefix(MARK)] = [np.flatnonzero(b) for b in blocks]
    for name, values in source.point_data.items():
        if name.startswith(MARK):
            mesh.point_groups[name.removeprefix(MARK)] = np.flatnonzero(values)
