# SPDX-License-Identifier: BSD-3-Clause
"""Writes an unstructured grid whose points move as VTK's XML files: one for each step, and a list of them."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from . import options
from .graphics import pv
from .mesh import Mesh, Step


def save(grid: pv.UnstructuredGrid, path: Path) -> None:
    """As .vtu or .vtk. VTK writes into memory: on a full disk its own writers crash or say nothing."""
    legacy = path.suffix.lower() == ".vtk"
    writer = vtkUnstructuredGridWriter() if legacy else vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetWriteToOutputString(True)
    if legacy:
        writer.SetFileTypeToBinary()
    else:
        writer.SetDataModeToBinary()
    writer.Write()
    # numbers of a legacy file as they are in memory, which Python gets as bytes
    text = writer.GetOutputStdString() if legacy else writer.GetOutputString()
    with options.named(path):
        path.write_bytes(text.encode() if isinstance(text, str) else text)


def write_collection(prefix: Path, mesh: Mesh, steps: Iterable[Step]) -> tuple[Path, int]:
    """The list `prefix.pvd` and its size in bytes with all that it names, in the folder `prefix_vtu`."""
    folder = prefix.with_name(prefix.name + "_vtu")
    folder.mkdir(exist_ok=True)
    for old in folder.glob("[0-9]" * 6 + ".vtu"):
        old.unlink()
    counts = np.diff(mesh.offsets)
    rows = np.insert(mesh.connectivity, mesh.offsets[:-1], counts)
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1", byte_order="LittleEndian")
    collection = ElementTree.SubElement(root, "Collection")
    size = 0
    for k, step in enumerate(steps):
        grid = pv.UnstructuredGrid(rows, mesh.types, step.points)
        grid.cell_data.update(mesh.cell_data | step.cell_data)
        grid.point_data.update(mesh.point_data | step.point_data)
        path = folder / f"{k:06d}.vtu"
        save(grid, path)
        size += path.stat().st_size
        ElementTree.SubElement(
            collection,
            "DataSet",
            timestep=repr(float(step.time)),
            part="0",
            file=f"{folder.name}/{path.name}",
        )
    path = prefix.with_name(prefix.name + ".pvd")
    with options.named(path):
        path.write_bytes(ElementTree.tostring(root, xml_declaration=True, encoding="utf-8"))
    return path, size + path.stat().st_size
