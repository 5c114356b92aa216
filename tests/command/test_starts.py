# SPDX-License-Identifier: BSD-3-Clause
"""Many runs that start together; tests/bench/starts.py takes more of them."""

import os
import subprocess


def test_runs_that_start_together_do_not_meet(engrane, pendulum, sessions):
    environment = {name: value for name, value in os.environ.items() if not name.startswith("OMPI_MCA_")}
    runs = [
        subprocess.Popen(
            [os.environ["ENGRANE"], "-q", pendulum, "-o", f"run{i}"],
            cwd=engrane.folder,
            env=environment | {"TMPDIR": str(sessions)},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        for i in range(20)
    ]
    for run in runs:
        _, errors = run.communicate(timeout=120)
        assert run.returncode == 0, errors
    assert not list(sessions.iterdir()), "each run takes its folder away again"


def test_the_users_own_folder_stays(engrane, pendulum):
    own = engrane.folder / "own"
    own.mkdir()
    environment = os.environ | {"OMPI_MCA_orte_tmpdir_base": str(own), "TMPDIR": str(engrane.folder / "tmp")}
    assert engrane(pendulum, "-q", env=environment).returncode == 0
    assert own.is_dir()
    assert not (engrane.folder / "tmp").exists()
