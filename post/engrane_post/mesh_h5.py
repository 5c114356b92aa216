# SPDX-License-Identifier: BSD-3-Clause
"""Writes a mesh as a file of HDF5 that a deck names in `.MAI FILE` (docs/format.md, Meshes)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .cell_mesh import CellMesh
from .h5_writing import new_file

SUFFIX = ".mesh.h5"
VERSION = 1
KINDS = {"NOEUDS": "NODES", "MAILLES": "ELEMENTS", "FACES": "FACES"}


def write(path: Path, mesh: CellMesh, source: str) -> None:
    """All of the mesh. `source` says where it is from."""
    with new_file(path) as file:
        file.attrs["engrane_mesh"] = VERSION
        file.attrs["source"] = source
        file["nodes/numbers"] = np.arange(1, len(mesh.points) + 1, dtype=np.int32)
        file["nodes/places"] = mesh.points + 0.0  # no -0.0
        for k, block in enumerate(mesh.blocks, 1):
            row = np.array(block.kind.row)
            numbers = np.arange(block.first, block.first + len(block.nodes), dtype=np.int32)
            file[f"cells/{k}/numbers"] = numbers
            nodes = (block.nodes[:, np.abs(row) - 1] + 1) * np.sign(row)  # 0 stays 0
            file[f"cells/{k}/nodes"] = nodes.astype(np.int32)
            file[f"cells/{k}"].attrs["kind"] = block.kind.words
        for k, group in enumerate(mesh.groups, 1):
            members = file.create_dataset(f"groups/{k}", data=group.members.astype(np.int32))
            members.attrs["name"] = group.name
            members.attrs["kind"] = KINDS[group.what]
