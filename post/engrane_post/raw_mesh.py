# SPDX-License-Identifier: BSD-3-Clause
"""What readers of mesh files hand over, and the library that reads most of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np


class RawCells(NamedTuple):
    """Cells of one kind, by meshio's name or, of what it does not know, by that of the file."""

    type: str
    data: np.ndarray


@dataclass
class RawMesh:
    """As meshio.Mesh, with any kinds of cells."""

    points: np.ndarray
    cells: list[RawCells]
    point_sets: dict[str, np.ndarray] = field(default_factory=dict)
    cell_sets: dict[str, list[np.ndarray]] = field(default_factory=dict)
    point_data: dict[str, Any] = field(default_factory=dict)
    cell_data: dict[str, Any] = field(default_factory=dict)
    field_data: dict[str, Any] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)  #: of what is in the file and not here


def text_of(path: str | Path) -> str:
    """A text file in UTF-8, or in Latin-1 when it is not that."""
    raw = Path(path).read_bytes()
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("latin-1")


def meshio_library() -> ModuleType:
    """meshio, which reads and writes these kinds but (5.3) refuses them: it lacks their dimension."""
    import meshio

    known = getattr(meshio._mesh, "topological_dimension", {})
    for name in ("wedge15", "pyramid13"):
        known.setdefault(name, 3)
    return meshio
