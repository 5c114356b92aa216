# SPDX-License-Identifier: BSD-3-Clause
"""Conjugate gradients with multigrid (`.SAM SOLVER CG`) against MUMPS, and what is left to MUMPS."""

from __future__ import annotations

import h5py
import numpy as np
import pytest
from runs import run
from solid_meshes import gravity_beam


def displacements(deck: list[str], solver: str, folder, ranks: int = 1) -> tuple[np.ndarray, str]:
    text = "\n".join([*deck[:-1], f".SAM SOLVER {solver}", deck[-1], ""])
    file = run(text, folder, ranks=ranks).file
    with h5py.File(file) as h:
        return h["fields/displacement/000000"][:], file.with_suffix(".lst").read_text()


@pytest.mark.parametrize(("corners", "second"), [(8, False), (8, True), (4, True)])
def test_the_displacements_are_those_of_mumps(tmp_path, corners, second):
    _, deck, _ = gravity_beam((10, 4, 3), corners, second)
    assert deck[-1] == ".FIN 1"
    exact, _ = displacements(deck, "MUMPS", tmp_path)
    for ranks in (1, 2, 3):
        found, listing = displacements(deck, "CG", tmp_path, ranks)
        assert "solution (CG)" in listing
        assert "MUMPS solved" not in listing
        assert np.max(np.abs(found - exact)) <= 1e-10 * np.max(np.abs(exact))


def test_a_matrix_with_constraints_goes_to_mumps_and_the_listing_says_so(tmp_path):
    _, deck, _ = gravity_beam((4, 2, 2), 8, False)
    link = [".NOE\n I 1000 X 12 Y 2 Z 1", '.MCE\n I 5000 RIGID_LINK N 1000 GROUP "end"']
    exact, _ = displacements([*deck[:-1], *link, deck[-1]], "MUMPS", tmp_path)
    for ranks in (1, 2):
        found, listing = displacements([*deck[:-1], *link, deck[-1]], "CG", tmp_path, ranks)
        assert "MUMPS solved instead" in " ".join(listing.split())
        assert np.max(np.abs(found - exact)) <= 1e-10 * np.max(np.abs(exact))
