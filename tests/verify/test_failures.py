# SPDX-License-Identifier: BSD-3-Clause
"""A run that cannot go on: what the user is told, what is kept, and that all ranks end together."""

import signal
import subprocess
import time

import h5py
import pytest
from engrane_post import Results
from runs import engrane, program

# The torque is no number after t = 0.5.
BREAKS = """
.NOE
 I 1 X 0 0 0
.MCE
 I 1 INERTIA N 1 M 1 J 1
 I 2 HINGE N 0 1 AXIS 0 0 1
 I 3 TORQUE N 1 AXIS 0 0 1 V 1 NF 3
.FCT
 I 3 EXPR "sqrt(0.5-T)"
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.1
"""

FREE = """
.NOE
 I 7 X 0 0 0
 I 8 X 1 0 0
.MCE
 I 1 INERTIA N 7 M 1 J 1
 I 2 HINGE N 0 7 AXIS 0 0 1
 I 4 HINGE N 0 8 AXIS 0 0 1
 I 5 TORQUE N 8 AXIS 0 0 1 V 1
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.1
"""

OPEN_LOOP = """
.NOE
 I 1 X 1 0 0
.MCE
 I 1 INERTIA N 1 M 1 J 1
 I 2 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0 DRIVE NF 1
 I 3 SPRING N 0 1 K 1
.FCT
 I 1 TABLE 0 0.3 1 0.3
.INI
 DEP NOEUD 1 C 1 V 5 IMPOSED
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.1
"""


@pytest.mark.parametrize("ranks", [1, 3])
def test_failed_run_keeps_its_results_and_says_why(tmp_path, ranks):
    ended = engrane(BREAKS, tmp_path, "-q", ranks=ranks)
    assert ended.returncode == 2
    assert "t = 0.5" in ended.stderr and "TORQUE 3" in ended.stderr and "cut 10 times" in ended.stderr
    assert ended.stderr.count("the step was cut") == 1, "only one rank speaks"
    with Results(tmp_path / "deck.h5") as result:
        assert result.status == "failed"
        assert result.times()[-1] == pytest.approx(0.5, abs=1e-3)


def test_singular_model_names_the_free_motion(tmp_path):
    ended = engrane(FREE, tmp_path, "-q")
    assert ended.returncode == 2
    assert "node 8 (rz) has no inertia, and no joint, spring or damper holds it" in ended.stderr


def test_imposed_start_that_joints_forbid(tmp_path):
    ended = engrane(OPEN_LOOP, tmp_path, "-q")
    assert ended.returncode == 2
    assert "imposed" in ended.stderr and "node 1 (x)" in ended.stderr


def test_failed_run_does_not_replace_a_good_one(tmp_path):
    good = BREAKS.replace("sqrt(0.5-T)", "1")
    assert engrane(good, tmp_path, "-q").returncode == 0
    before = (tmp_path / "deck.h5").read_bytes()
    assert engrane(BREAKS, tmp_path, "-q").returncode == 2
    assert (tmp_path / "deck.h5").read_bytes() == before
    assert (tmp_path / "deck.partial.h5").exists()


def test_results_that_cannot_be_written_end_all_ranks(tmp_path):
    ended = engrane(FREE, tmp_path, "-q", "-o", "no/such/folder/x", ranks=3)
    assert ended.returncode == 1
    assert "no/such/folder/x" in ended.stderr


def test_terminated_run_closes_its_results(tmp_path):
    deck = BREAKS.replace("sqrt(0.5-T)", "1").replace("TF 1 H 0.1", "TF 1000 H 0.0001")
    (tmp_path / "deck.dat").write_text(deck, encoding="utf-8")
    process = subprocess.Popen([program(), "-q", "deck.dat"], cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 60
    while not (tmp_path / "deck.h5").exists() and time.monotonic() < deadline:
        time.sleep(0.1)
    time.sleep(1)
    process.send_signal(signal.SIGTERM)
    _, messages = process.communicate(timeout=60)
    assert process.returncode == 2 and "interrupted at t = " in messages
    with h5py.File(tmp_path / "deck.h5") as file:
        assert file.attrs["status"] in ("failed", b"failed")


def test_what_has_no_effect_is_said(tmp_path):
    idle = '.SAI STYP 163\n.MAT\n I 1 NOM "steel" BEHA "ELASTIC" YT 2.1e11\n'
    deck = BREAKS.replace("sqrt(0.5-T)", "1") + idle
    ended = engrane(deck, tmp_path, "-q")
    assert ended.returncode == 0
    assert "STYP selects nothing" in ended.stderr and "this material has no effect" in ended.stderr
