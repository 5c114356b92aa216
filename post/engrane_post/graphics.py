# SPDX-License-Identifier: BSD-3-Clause
"""The one place that loads the 3D library, told beforehand whether there is a screen."""

from __future__ import annotations

import os
import sys

if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
    # Without a screen the library would try X first and complain; software rendering needs none.
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")

import pyvista as pv

__all__ = ["pv"]
