# SPDX-License-Identifier: BSD-3-Clause
"""The program as it is called: a folder to work in, and a small deck."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "post"))

PENDULUM = """! A pendulum of length /L and mass /M.
.UNIT SI
ABRE '/L' '0.5' '/M' '2.'
.NOE
 I 1 X /L 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 0 AT 0 0 0
 I 2 INERTIA N 1 M /M J (/M*0.01)
.CLM STRU ACC VAL 0 0 -9.81
.SAM TYPE DYNAMIC
.SUB TF 0.2 H 0.01
.CHK
 RUN ENERGY_ERROR V 0 ATOL 1E-2
"""


@pytest.fixture
def engrane(tmp_path):
    """Calls the program in an empty folder: engrane("check", "x.dat")."""
    program = os.environ.get("ENGRANE", "")
    if not Path(program).is_file():
        pytest.skip("the variable ENGRANE names no program")

    def call(*words, timeout=120, **options):
        return subprocess.run(
            [program, *words], cwd=tmp_path, capture_output=True, text=True, timeout=timeout, **options
        )

    call.folder = tmp_path
    return call


@pytest.fixture
def pendulum(tmp_path):
    (tmp_path / "pendulum.dat").write_text(PENDULUM)
    return "pendulum.dat"
