# SPDX-License-Identifier: BSD-3-Clause
"""Where the solver is."""

from __future__ import annotations

import os
from pathlib import Path

from .errors import UserError

ROOT = Path(__file__).resolve().parents[2]


def find_program() -> Path:
    """What the variable ENGRANE names, else the program of the source tree."""
    program = Path(os.environ.get("ENGRANE") or ROOT / "build" / "bin" / "engrane")
    if not program.is_file():
        raise UserError(
            f"There is no program {program}; ./engrane builds it, or the variable ENGRANE names it."
        )
    return program
