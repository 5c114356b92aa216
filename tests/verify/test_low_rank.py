# SPDX-License-Identifier: BSD-3-Clause
"""MUMPS with low-rank blocks (`.SAM SOLVER BLR`) against full rank, and what it leaves to full rank."""

from __future__ import annotations

import re

import h5py
import numpy as np
import pytest
from runs import run
from solid_meshes import gravity_beam


def displacements(deck: list[str], solver: str, folder, ranks: int = 1) -> tuple[np.ndarray, str, str]:
    """With the listing, and what the terminal shows."""
    text = "\n".join([*deck[:-1], f".SAM SOLVER {solver}", deck[-1], ""])
    file = run(text, folder, ranks=ranks, output=folder / "shown").file
    with h5py.File(file) as h:
        last = sorted(h["fields/displacement"])[-1]
        found = h[f"fields/displacement/{last}"][:]
    return found, " ".join(file.with_suffix(".lst").read_text().split()), (folder / "shown").read_text()


@pytest.fixture(scope="module")
def beam(tmp_path_factory) -> tuple[list[str], np.ndarray]:
    """Large enough for fronts with blocks, and its displacements by factors of full rank."""
    _, deck, _ = gravity_beam((12, 10, 8), 8, True)
    assert not any(line.startswith(".SAM") for line in deck)
    return deck, displacements(deck, "MUMPS", tmp_path_factory.mktemp("full"))[0]


@pytest.mark.parametrize("ranks", [1, 2])
def test_the_displacements_are_those_of_full_rank(beam, tmp_path, monkeypatch, ranks):
    monkeypatch.setenv("PETSC_OPTIONS", "-mat_mumps_icntl_4 2")  # MUMPS tells what it did
    deck, exact = beam
    found, listing, shown = displacements(deck, "BLR", tmp_path, ranks)
    assert "solution (BLR)" in listing and "full rank" not in listing
    assert any(int(n) > 0 for n in re.findall(r"Number of BLR fronts += +(\d+)", shown))
    assert np.max(np.abs(found - exact)) <= 1e-10 * np.max(np.abs(exact))


def test_poor_blocks_are_given_up_and_the_listing_says_so(beam, tmp_path, monkeypatch):
    monkeypatch.setenv("PETSC_OPTIONS", "-mat_mumps_cntl_7 0.3")
    deck, exact = beam
    found, listing, _ = displacements(deck, "BLR", tmp_path)
    assert "the factors are of full rank" in listing
    assert np.max(np.abs(found - exact)) <= 1e-10 * np.max(np.abs(exact))


def test_constraints(tmp_path):
    _, deck, _ = gravity_beam((4, 2, 2), 8, False)
    link = [".NOE\n I 1000 X 12 Y 2 Z 1", '.MCE\n I 5000 RIGID_LINK N 1000 GROUP "end"']
    deck = [*deck[:-1], *link, deck[-1]]
    exact, _, _ = displacements(deck, "MUMPS", tmp_path)
    found, listing, _ = displacements(deck, "BLR", tmp_path)
    assert "full rank" not in listing
    assert np.max(np.abs(found - exact)) <= 1e-10 * np.max(np.abs(exact))
