# SPDX-License-Identifier: BSD-3-Clause
"""The one place that loads the 3D library, told beforehand whether there is a screen."""

from __future__ import annotations

import os
import sys

if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
    # Without a screen the library would try X first and complain; software rendering needs none.
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")

import numpy as np
import pyvista as pv

__all__ = ["offsets_of", "pv"]


def offsets_of(grid: pv.UnstructuredGrid) -> np.ndarray:
    """Where each cell begins in the connectivity, and the end of the last; pyvista has renamed it."""
    return np.asarray(grid.cell_offsets if hasattr(grid, "cell_offsets") else grid.offset)
