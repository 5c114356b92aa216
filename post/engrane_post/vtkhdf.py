# SPDX-License-Identifier: BSD-3-Clause
"""Writes an unstructured grid whose points move as a VTKHDF file (docs.vtk.org, "VTKHDF File Format").

The cells are written once and every step refers to them. Readers that know no steps (VTK 9.2, ParaView 5.11)
take them from a series of small files (docs/decisions/0016-vtkhdf.md)."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

import h5py
import numpy as np

from . import options
from .h5_writing import new_file
from .mesh import Mesh, Step

VERSION = (2, 0)  # the first with steps
PACKED = {"compression": "gzip", "compression_opts": 4, "shuffle": True}
BLOCK = 65536  # rows of an array that are compressed together, at most


def write(path: Path, mesh: Mesh, times: np.ndarray, steps: Iterable[Step]) -> None:
    """Writes one step after the other, so that no more than one is held in memory."""
    count = len(times)
    with new_file(path) as file:
        root = _head(file, VERSION)
        _cells(root, mesh)
        for name, rows in mesh.point_data.items():
            root.create_dataset(f"PointData/{name}", data=rows)
        series: dict[str, h5py.Dataset] = {}
        size = 0
        for k, step in enumerate(steps):
            arrays = {"Points": step.points} | {f"PointData/{n}": a for n, a in step.point_data.items()}
            arrays |= {f"CellData/{n}": a for n, a in step.cell_data.items()}
            if k == 0:
                size = len(step.points)
                root["NumberOfPoints"] = np.array([size], np.int64)
                for name, rows in arrays.items():
                    series[name] = _growing(root, name, rows, count)
            for name, rows in arrays.items():
                series[name][k * len(rows) : (k + 1) * len(rows)] = rows
        _steps(root, times, size, len(mesh.types), set(series))


def _head(file: h5py.File, version: tuple[int, int]) -> h5py.Group:
    root = file.create_group("VTKHDF")
    root.attrs["Version"] = np.array(version, np.int64)
    # readers take this text only with a fixed length
    root.attrs.create("Type", b"UnstructuredGrid", dtype=h5py.string_dtype("ascii", len("UnstructuredGrid")))
    root.create_group("PointData")
    return root


def _cells(root: h5py.Group, mesh: Mesh) -> None:
    root["NumberOfCells"] = np.array([len(mesh.types)], np.int64)
    root["NumberOfConnectivityIds"] = np.array([len(mesh.connectivity)], np.int64)
    for name, values in (("Connectivity", mesh.connectivity), ("Offsets", mesh.offsets)):
        root.create_dataset(name, data=np.asarray(values, np.int64), **PACKED)
    root.create_dataset("Types", data=np.asarray(mesh.types, np.uint8), **PACKED)
    root.create_group("CellData")
    for name, values in mesh.cell_data.items():
        root.create_dataset(f"CellData/{name}", data=values, **PACKED)


def _growing(root: h5py.Group, name: str, rows: np.ndarray, count: int) -> h5py.Dataset:
    """An array with the rows of all steps, one step behind the other."""
    shape = (count * len(rows), *rows.shape[1:])
    if not len(rows):
        return root.create_dataset(name, shape, rows.dtype)
    chunk = (min(len(rows), BLOCK), *rows.shape[1:])
    return root.create_dataset(name, shape, rows.dtype, chunks=chunk, **PACKED)


def _steps(root: h5py.Group, times: np.ndarray, size: int, cells: int, moving: set[str]) -> None:
    """Where each step finds its rows: its own points and what changes with them, and everybody's cells."""
    count = len(times)
    own = np.arange(count, dtype=np.int64) * size
    of_cells = np.arange(count, dtype=np.int64) * cells
    shared = np.zeros(count, np.int64)
    steps = root.create_group("Steps")
    steps.attrs["NSteps"] = np.int64(count)
    steps["Values"] = np.asarray(times, float)
    steps["PartOffsets"] = shared
    steps["NumberOfParts"] = np.ones(count, np.int64)
    steps["PointOffsets"] = own
    steps["CellOffsets"] = shared[:, None]
    steps["ConnectivityIdOffsets"] = shared[:, None]
    for name in root["PointData"]:
        steps[f"PointDataOffsets/{name}"] = own if f"PointData/{name}" in moving else shared
    for name in root["CellData"]:
        steps[f"CellDataOffsets/{name}"] = of_cells if f"CellData/{name}" in moving else shared


def write_series(path: Path) -> Path:
    """For readers that know no steps: beside the file at `path` a folder with a small file for each step,
    whose arrays are views of those at `path`, and a list of them with their times."""
    folder = path.with_name(path.stem + "_steps")
    folder.mkdir(exist_ok=True)
    for old in folder.glob("[0-9]" * 6 + ".hdf"):
        old.unlink()
    entries = []
    with h5py.File(path, "r") as whole:
        source = whole["VTKHDF"]
        times = source["Steps/Values"][()]
        for k, time in enumerate(times):
            name = f"{k:06d}.hdf"
            _one_step(folder / name, source, f"../{path.name}", k)
            entries.append({"name": f"{folder.name}/{name}", "time": float(time)})
    series = path.with_suffix(".hdf.series")  # ParaView 5.11 knows no other ending
    with options.named(series):
        series.write_text(json.dumps({"file-series-version": "1.0", "files": entries}, indent=1) + "\n")
    return series


def _one_step(path: Path, source: h5py.Group, origin: str, k: int) -> None:
    """A file of version 1.0 with views of the k-th step's rows and links to what stays."""
    count = {kind: int(source[f"NumberOf{kind}"][0]) for kind in ("Points", "Cells")}
    steps = source["Steps"]
    views = {"Points": (int(steps["PointOffsets"][k]), count["Points"])}
    for data, size in (("PointData", count["Points"]), ("CellData", count["Cells"])):
        views |= {f"{data}/{n}": (int(steps[f"{data}Offsets/{n}"][k]), size) for n in source[data]}
    with new_file(path) as file:
        root = _head(file, (1, 0))
        for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"):
            root[name] = source[name][()]
        root.create_group("CellData")
        for name, (start, size) in views.items():
            item = source[name]
            if len(item) == size:  # the same at every step
                root[name] = h5py.ExternalLink(origin, item.name)
                continue
            layout = h5py.VirtualLayout((size, *item.shape[1:]), item.dtype)
            layout[...] = h5py.VirtualSource(origin, item.name, item.shape)[start : start + size]
            root.create_virtual_dataset(name, layout)
        for name in ("Connectivity", "Offsets", "Types"):
            root[name] = h5py.ExternalLink(origin, source[name].name)
