# SPDX-License-Identifier: BSD-3-Clause
"""User routines that end the program by STOP or exit(0): no success without results."""

import shutil
import subprocess
from pathlib import Path

import h5py
import pytest
from runs import engrane
from user_law import deck

FORTRAN = """      SUBROUTINE ENDING(IVERS, KIND, X, P, NP, Y, ISTAT)
      INTEGER IVERS, KIND, NP, ISTAT
      DOUBLE PRECISION X(*), P(*), Y(*)
      Y(1) = X(1)
      IF (X(1) .LE. P(1)) RETURN
      PRINT *, 'the last words'
      {end}
      END
"""

C = """#include <stdio.h>
#include <stdlib.h>
void ending(const int* version, const int* kind, const double* x, const double* p, const int* n_p,
            double* y, int* status) {{
  y[0] = x[0];
  if (x[0] <= p[0]) return;
  printf("the last words\\n");
  {end}
}}
"""

LANGUAGES = {".f": ("gfortran", FORTRAN), ".c": ("gcc", C)}


def compile_routine(folder: Path, suffix: str, end: str) -> None:
    """A library libending.so in the folder."""
    compiler, source = LANGUAGES[suffix]
    if not shutil.which(compiler):
        pytest.skip(f"there is no {compiler}")
    (folder / f"ending{suffix}").write_text(source.format(end=end))
    command = [compiler, "-shared", "-fPIC", f"ending{suffix}", "-o", "libending.so"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=60)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize(
    ("suffix", "end"),
    [(".f", "STOP"), (".f", "ERROR STOP 5"), (".c", "exit(0);"), (".c", "quick_exit(0);")],
)
def test_ending_the_program_is_no_success(tmp_path: Path, suffix: str, end: str, ranks: int) -> None:
    compile_routine(tmp_path, suffix, end)
    done = engrane(deck("ending", "ending", 0.5), tmp_path, "-q", ranks=ranks)
    assert done.returncode == 139, done.stderr
    assert (
        "engrane: the user routine ending of libending.so ended the program (STOP or exit): " in done.stderr
    )
    assert "return an error status instead" in done.stderr
    assert "the last words" in done.stdout
    with h5py.File(tmp_path / "deck.h5") as results:
        assert results.attrs["status"] == "running"


@pytest.mark.parametrize("task", [["check"], []])
def test_ending_the_program_before_the_run(tmp_path: Path, task: list[str]) -> None:
    compile_routine(tmp_path, ".c", "exit(0);")
    done = engrane(deck("ending", "ending", -1), tmp_path, *task)
    assert done.returncode == 139, done.stderr
    assert "ending of libending.so ended the program" in done.stderr
