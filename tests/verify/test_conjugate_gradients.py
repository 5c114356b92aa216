# SPDX-License-Identifier: BSD-3-Clause
"""Conjugate gradients with multigrid (`.SAM SOLVER CG`) against MUMPS, and what is left to MUMPS."""

from __future__ import annotations

import h5py
import numpy as np
import pytest
from runs import run
from solid_meshes import gravity_beam


def displacements(deck: list[str], solver: str, folder, ranks: int = 1) -> tuple[np.ndarray, str]:
    analysis = [f"{line} SOLVER {solver}" for line in deck if line.startswith(".SAM")]
    rest = [line for line in deck[:-1] if not line.startswith(".SAM")]
    text = "\n".join([*rest, *(analysis or [f".SAM SOLVER {solver}"]), deck[-1], ""])
    file = run(text, folder, ranks=ranks).file
    with h5py.File(file) as h:
        last = sorted(h["fields/displacement"])[-1]
        return h[f"fields/displacement/{last}"][:], file.with_suffix(".lst").read_text()


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


def shaken_beam(weight: bool, small: bool = True) -> list[str]:
    """A long beam in motion, under its weight and a force at its end, or under that force alone."""
    _, deck, _ = gravity_beam((40, 2, 2), 8, False)
    if not weight:
        deck = [line.split("\n STRU")[0] if line.startswith(".CLM") else line for line in deck]
    kind = "DYNAMIC DISPLACEMENTS SMALL" if small else "DYNAMIC"
    return [*deck[:-1], f".SAM TYPE {kind}", ".SUB TF 1.5E-6 H 5E-7", deck[-1]]


@pytest.mark.parametrize(("weight", "small"), [(True, True), (False, True), (True, False)])
def test_motions_are_solved_without_factors(tmp_path, weight, small):
    # the first accelerations fade away from the load, below what is asked of the largest residual
    deck = shaken_beam(weight, small)
    exact, _ = displacements(deck, "MUMPS", tmp_path)
    for ranks in (1, 2):
        found, listing = displacements(deck, "CG", tmp_path, ranks)
        assert "MUMPS solved" not in listing
        assert np.max(np.abs(found - exact)) <= 1e-9 * np.max(np.abs(exact))


def test_the_diagonal_takes_the_place_of_a_multigrid_that_is_not_positive_definite(tmp_path, monkeypatch):
    deck = shaken_beam(True)
    exact, _ = displacements(deck, "MUMPS", tmp_path)
    levels = {"ksp_type": "richardson", "pc_type": "jacobi", "ksp_richardson_scale": "2"}
    monkeypatch.setenv("PETSC_OPTIONS", " ".join(f"-cg_mg_levels_{k} {v}" for k, v in levels.items()))
    found, listing = displacements(deck, "CG", tmp_path)
    assert "MUMPS solved" not in listing
    assert np.max(np.abs(found - exact)) <= 1e-9 * np.max(np.abs(exact))


def test_the_listing_says_how_many_matrices_were_left_to_mumps_and_why(tmp_path, monkeypatch):
    deck = shaken_beam(True)
    exact, _ = displacements(deck, "MUMPS", tmp_path)
    # enough for masses, too few for masses with stiffness
    monkeypatch.setenv("PETSC_OPTIONS", "-cg_ksp_max_it 17")
    found, listing = displacements(deck, "CG", tmp_path)
    words = " ".join(listing.split())
    assert "SOLVER CG: MUMPS solved instead, " in words
    assert "did not converge in 17 iterations" in words
    assert np.max(np.abs(found - exact)) <= 1e-9 * np.max(np.abs(exact))
