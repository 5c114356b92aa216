# SPDX-License-Identifier: BSD-3-Clause
"""Cells with their data as VTK's unstructured grids have them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass
class Mesh:
    """Cells that stay while their points move: types (VTK's codes), offsets into `connectivity` (one more
    than cells), 0-based points, and by name what stays with every cell and point, a row each."""

    types: np.ndarray
    offsets: np.ndarray
    connectivity: np.ndarray
    cell_data: dict[str, np.ndarray] = field(default_factory=dict)
    point_data: dict[str, np.ndarray] = field(default_factory=dict)

    @classmethod
    def of_points(cls, count: int, **point_data: np.ndarray) -> Mesh:
        """A vertex for each point."""
        return cls(np.ones(count, np.uint8), np.arange(count + 1), np.arange(count), {}, point_data)


@dataclass
class Step:
    """What a frame adds: its time, the points (n x 3), and by name arrays with a row for each point, each
    cell."""

    time: float
    points: np.ndarray
    point_data: dict[str, np.ndarray] = field(default_factory=dict)
    cell_data: dict[str, np.ndarray] = field(default_factory=dict)
