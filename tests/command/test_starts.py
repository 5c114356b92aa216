# SPDX-License-Identifier: BSD-3-Clause
"""Many runs that start together; tests/bench/starts.py takes more of them."""

import os
import subprocess


def start_together(engrane, pendulum, environment) -> None:
    runs = [
        subprocess.Popen(
            [os.environ["ENGRANE"], "-q", pendulum, "-o", f"run{i}"],
            cwd=engrane.folder,
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        for i in range(20)
    ]
    for run in runs:
        _, errors = run.communicate(timeout=120)
        assert run.returncode == 0, errors


def test_runs_that_start_together_do_not_meet(engrane, pendulum, sessions):
    environment = {name: value for name, value in os.environ.items() if not name.startswith("OMPI_MCA_")}
    start_together(engrane, pendulum, environment | {"TMPDIR": str(sessions)})
    assert not list(sessions.iterdir()), "each run takes its folder away again"


def test_nor_do_they_in_a_folder_of_the_user(engrane, pendulum, sessions):
    own = sessions / "own"
    environment = os.environ | {"OMPI_MCA_orte_tmpdir_base": str(own), "TMPDIR": str(engrane.folder / "tmp")}
    start_together(engrane, pendulum, environment)
    assert own.is_dir() and not list(own.iterdir())
    assert not (engrane.folder / "tmp").exists()
