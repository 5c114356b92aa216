# SPDX-License-Identifier: BSD-3-Clause
"""User routines that fail in mid-run: what the user is told; and what missing derivatives cost."""

import math
import os
from pathlib import Path

import numpy as np
import pytest
from runs import Run, engrane, run
from user_law import deck

LIBRARIES = Path(os.environ.get("ENGRANE_USER_PATH", "."))

pytestmark = pytest.mark.skipif(
    not (LIBRARIES / "libwrong_laws.so").is_file(), reason="ENGRANE_USER_PATH has no libwrong_laws.so"
)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize(
    ("routine", "words"),
    [
        ("ends", "ends of libwrong_laws.so says that this is outside what it is good for (at elongation 0.5"),
        (
            "breaks",
            "breaks of libwrong_laws.so gives a result that is not a finite number (at elongation 0.5",
        ),
    ],
)
def test_failure_names_the_routine(tmp_path: Path, routine: str, words: str, ranks: int) -> None:
    done = engrane(deck("wrong_laws", routine, 0.5), tmp_path, ranks=ranks)
    assert done.returncode == 2, done.stderr
    assert "engrane: step " in done.stderr and ", t = 0.52" in done.stderr
    assert f"SPRING 1: the user routine {words}" in done.stderr
    assert done.stderr.count("finite") == words.count("finite"), done.stderr


@pytest.mark.parametrize("routine", ["crashes", "aborts"])
def test_crash_names_the_routine(tmp_path: Path, routine: str) -> None:
    done = engrane(deck("wrong_laws", routine, 0.5), tmp_path)
    assert done.returncode != 0
    assert f"the user routine {routine} of libwrong_laws.so crashed" in done.stderr


def test_derivatives_that_are_zero(tmp_path: Path) -> None:
    """Drag v|v| and a cubic spring were refused: at 0 the differences are all that there is."""
    done = engrane(deck("wrong_laws", "cubic", 0.5), tmp_path)
    assert done.returncode == 0, done.stderr
    done = engrane(deck("wrong_laws", "cubic_and_linear", 0.5), tmp_path)
    assert done.returncode == 1
    assert "is given as 0, and differences of its force make it 5" in done.stderr


@pytest.mark.parametrize(("energy", "status"), [(1, 2), (0, 0)])
def test_energy_that_depends_on_time(tmp_path: Path, energy: int, status: int) -> None:
    """The motion is right, and the run ended with the advice to take smaller steps."""
    text = deck("wrong_laws", "swings", energy).replace("C 1 V 1", "C 1 V 0")
    done = engrane(text, tmp_path)
    assert done.returncode == status, done.stderr
    cause = "the energy that its routine returns depends on the time"
    assert (cause in done.stderr) == (status == 2)


@pytest.mark.parametrize("end", [1, 2])
def test_a_drive_is_not_asked_beyond_its_range(tmp_path: Path, end: int) -> None:
    """A routine without derivatives, good from 0 to 1: the differences at 0 went below, and the message said
    that its result there "is not a finite number"."""
    text = f""".NOE
 I 1 X 0
.FCT
 I 1 USER "wrong_laws" "bounded" PARAM 1
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 INERTIA N 1 M 1. J 1 1 1
.SAM TYPE KINEMATIC
.SUB TF {end} H 0.02
.FIN
"""
    done = engrane(text, tmp_path)
    if end == 1:
        assert done.returncode == 0, done.stderr
        found = Run(tmp_path / "deck.h5")
        torque = -0.2 * math.pi**2 * np.sin(math.pi * found.t)
        assert found["1/DRIVE_TORQUE"] == pytest.approx(torque, abs=1e-6)
    else:
        assert done.returncode == 2, done.stderr
        assert "bounded of libwrong_laws.so says that this is outside what it is good for" in done.stderr
        assert "finite" not in done.stderr


LAWS = ("POLY 50 0 4D5 C 0.8", "USER 1", "USER 2")

SPRINGS = """.NOE
 I 1 X 3 0 0
.FCT
 I 1 USER "laws_fortran" "hardening" PARAM 50 4D5 0.8
 I 2 USER "laws_c" "hardening_plain" PARAM 50 4D5 0.8
.MCE
 I 1 SPRING N 0 1 LAW {law} AT 1 0 0
 I 2 INERTIA N 1 M 2
.CLM
 FIX NOEUD 1 C 2 3
.INI
 VIT NOEUD 1 C 1 V 30
.SAM TYPE DYNAMIC RHO 1 PREC 1e-12
.SUB TF 0.5 H 0.002
.FIN 1
"""


def test_differences_cost_iterations_not_accuracy(tmp_path: Path) -> None:
    """250 steps of a stiff oscillator: the law of the deck, the routine, and the routine without
    derivatives."""
    found = {law: run(SPRINGS.format(law=law), tmp_path, f"deck{i}") for i, law in enumerate(LAWS)}
    given, routine, plain = (found[law] for law in LAWS)
    iterations = {law: int(found[law]["run/ITERATIONS"].sum()) for law in LAWS}
    print(iterations)
    assert iterations[LAWS[0]] == iterations[LAWS[1]]
    assert abs(iterations[LAWS[2]] - iterations[LAWS[1]]) <= 0.02 * iterations[LAWS[1]]
    for other in (routine, plain):
        assert abs(other["1/FORCE"] - given["1/FORCE"]).max() < 1e-8 * abs(given["1/FORCE"]).max()
