# SPDX-License-Identifier: BSD-3-Clause
"""Small systems of several processes are solved by one of them, with any package; large ones by all."""

from __future__ import annotations

import re

import h5py
import numpy as np
import pytest
from runs import run


def chain(links: int, card: str = "", hang: str = "HINGE N 0 1 AXIS 0 0 1 AT 0 0 0") -> str:
    """Links of 1 m that fall from a level line, hinged to one another."""
    lines = [".NOE", *(f" I {i + 1} X {i + 0.5}" for i in range(links))]
    lines += [".MCE", *(f" I {i + 1} INERTIA N {i + 1} M 1 J 0.001 0.084 0.084" for i in range(links))]
    lines += [f" I {links + 1} {hang}"]
    lines += [f" I {links + i + 1} HINGE N {i} {i + 1} AXIS 0 0 1 AT {i} 0 0" for i in range(1, links)]
    end = [".CLM\n STRU ACC VAL 0 -9.81 0", card or ".SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.8"]
    return "\n".join([*lines, *end, ".SUB TF 0.05 H 0.005", ".FIN 1\n"])


CHANNELS = ("node/5/UX", "node/5/UY", "run/ENERGY_ERROR", "run/GROUND_FORCE_Y")


@pytest.mark.parametrize("solver", ["MUMPS", "KLU", "AUTO", "UMFPACK", "SUPERLU"])
@pytest.mark.parametrize("scheme", ["CHUNG", "RADAU", "CHUNG TANGENT KEPT"])
def test_any_package_solves_for_several_processes(tmp_path, solver, scheme):
    text = chain(5, f".SAM TYPE DYNAMIC SCHEME {scheme} SOLVER {solver}")
    alone = run(text, tmp_path)
    for ranks in (2, 3) if scheme == "CHUNG" else (2,):  # a third has what a second one has
        together = run(text, tmp_path, ranks=ranks, name="ranks")
        for channel in CHANNELS:
            size = max(np.max(np.abs(alone[channel])), 1e-3)
            assert np.max(np.abs(together[channel] - alone[channel])) <= 1e-10 * size, (channel, ranks)
        listing = together.file.with_suffix(".lst").read_text()
        assert re.search(rf"factorisation \({'KLU' if solver == 'AUTO' else solver}\)", listing)


def test_a_large_system_is_solved_by_all(tmp_path):
    text = chain(300, ".SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.8 SOLVER KLU")
    alone = run(text, tmp_path)
    together = run(text, tmp_path, ranks=2, name="ranks")
    assert "factorisation (MUMPS)" in together.file.with_suffix(".lst").read_text()
    ends = []
    for result in (alone, together):
        with h5py.File(result.file) as file:
            frames = file["fields/displacement"]
            ends.append(frames[max(frames)][:])
    assert np.max(np.abs(ends[0])) > 1e-3
    assert np.max(np.abs(ends[1] - ends[0])) <= 1e-10 * np.max(np.abs(ends[0]))


def test_all_processes_learn_of_a_singular_matrix(tmp_path):
    text = chain(5, ".SAM TYPE STATIC", hang="SPRING N 0 1 K 100 L0 0.5")
    said = []
    for ranks in (1, 2, 3):
        with pytest.raises(AssertionError) as failed:
            run(text, tmp_path, ranks=ranks, name="ranks", timeout=60)
        said.append(str(failed.value))
    reason = re.search(r"engrane: .*(?:cannot|singular|nothing).*", said[0])
    assert reason, said[0]
    assert all(reason[0] in other for other in said[1:])


def test_the_condition_is_that_of_one_process(tmp_path):
    conditions = []
    for ranks in (1, 2, 3):
        result = run(chain(5), tmp_path, ranks=ranks, name="ranks", options=("--condition",))
        listing = result.file.with_suffix(".lst").read_text()
        conditions.append(float(re.search(r"condition[^\n]*?([\d.]+e\+\d+)", listing)[1]))
    assert conditions[0] > 10
    # rows are numbered otherwise, and the estimate starts from another vector
    assert max(conditions) <= 3 * min(conditions)
