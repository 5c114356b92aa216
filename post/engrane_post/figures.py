# SPDX-License-Identifier: BSD-3-Clause
"""`engrane figures`: hands over to tests/verify/paper_figures.py of the source tree."""

from __future__ import annotations

import argparse
import importlib.util
import sys
from collections.abc import Sequence
from pathlib import Path

from .errors import UserError

SCRIPT = Path(__file__).resolve().parents[2] / "tests" / "verify" / "paper_figures.py"


def add(commands: argparse._SubParsersAction) -> None:
    """Lists the command; its words are read by the script."""
    commands.add_parser("figures", help="the founding paper's figures from engrane's results", add_help=False)


def main(arguments: Sequence[str]) -> int:
    """Runs the script with these words."""
    if not SCRIPT.is_file():
        raise UserError(f"The figures need engrane's source tree; there is no {SCRIPT}.")
    spec = importlib.util.spec_from_file_location("paper_figures", SCRIPT)
    if spec is None or spec.loader is None:
        raise UserError(f"{SCRIPT} cannot be loaded.")
    module = importlib.util.module_from_spec(spec)
    sys.path.insert(0, str(SCRIPT.parent))
    spec.loader.exec_module(module)
    return int(module.main(list(arguments)))
