# SPDX-License-Identifier: BSD-3-Clause
"""Solids against CalculiX on the same mesh, and against closed forms: a thick tube, the elastica."""

from __future__ import annotations

import json
from pathlib import Path

import h5py
import numpy as np
import pytest
from runs import run
from solid_meshes import Block, gravity_beam

KINDS = {"C3D4": (4, False), "C3D10": (4, True), "C3D15": (6, True), "C3D20": (8, True)}
# written by tests/bench/calculix.py --write, CalculiX 2.20, which prints seven digits
REFERENCE = json.loads((Path(__file__).parent / "calculix.json").read_text(encoding="utf-8"))


def displacements(file: Path) -> np.ndarray:
    with h5py.File(file) as results:
        frames = results["fields/displacement"]
        return frames[sorted(frames)[-1]][:]


@pytest.mark.parametrize("kind", KINDS)
def test_calculix(kind: str, tmp_path: Path) -> None:
    expected = np.array(REFERENCE[kind]["displacement"])
    _, deck, _ = gravity_beam(REFERENCE[kind]["boxes"], *KINDS[kind])
    for ranks in (1, 3) if kind == "C3D10" else (1,):
        found = displacements(run("\n".join(deck), tmp_path, ranks=ranks).file)
        assert np.abs(found - expected).max() < 5e-7 * np.abs(expected).max()


INNER, OUTER, PRESSURE, YOUNG, POISSON = 1.0, 2.0, 100.0, 1000.0, 0.3


def tube(boxes: int, corners: int, second: bool) -> tuple[Block, str]:
    """A quarter of a thick tube under inner pressure, held along its axis."""

    def place(u):
        radius, angle = INNER + (OUTER - INNER) * u[0], np.pi / 2 * u[1]
        return np.array([radius * np.cos(angle), radius * np.sin(angle), 0.5 * u[2]])

    block = Block((boxes, boxes, 1 if boxes < 3 else boxes // 2), corners, second, place, curved=True)
    deck = [
        *block.deck(),
        ".SEL",
        block.group(1, "x", block.nodes(lambda u: u[1] == 1)),
        block.group(2, "y", block.nodes(lambda u: u[1] == 0)),
        block.group(3, "z", block.nodes(lambda u: u[2] in (0, 1))),
        *block.group_of_faces(4, "bore", lambda u: u[0] == 0),
        f'.MAT\n I 1 BEHA "ELASTIC" YT {YOUNG} NT {POISSON}',
        f".AEL\n I 1 J {len(block.cells)} K 1 MAT 1",
        '.CLM\n GROUP "x" FIX C 1\n GROUP "y" FIX C 2\n GROUP "z" FIX C 3',
        f' GROUP "bore" PRE V {PRESSURE}',
        ".FIN 1",
    ]
    return block, "\n".join(deck)


@pytest.mark.parametrize(
    ("corners", "second", "order"),
    [(4, False, 1.9), (4, True, 2.8), (6, False, 1.9), (6, True, 2.9), (8, False, 1.9), (8, True, 3.6)],
)
def test_tube_converges(corners: int, second: bool, order: float, tmp_path: Path) -> None:
    """Lamé, plane strain: radial displacement of all nodes, and its order as the mesh gets finer."""
    errors = []
    sizes = (2, 4) if second else (4, 8)
    for boxes in sizes:
        block, deck = tube(boxes, corners, second)
        found = displacements(run(deck, tmp_path).file)
        radius = np.hypot(block.points[:, 0], block.points[:, 1])
        constant = PRESSURE * INNER**2 / (OUTER**2 - INNER**2) * (1 + POISSON) / YOUNG
        expected = constant * ((1 - 2 * POISSON) * radius + OUTER**2 / radius)
        radial = (found[:, :2] * block.points[:, :2]).sum(axis=1) / radius
        errors.append(np.sqrt(np.mean((radial - expected) ** 2)) / expected.max())
    assert np.log2(errors[0] / errors[1]) > order, errors
    assert errors[1] < (3e-4 if second else 1e-2), errors


@pytest.mark.parametrize(("corners", "second"), [(4, True), (6, True), (8, False), (8, True)])
def test_elastica(corners: int, second: bool, tmp_path: Path) -> None:
    """A cantilever bent far by a force at its end, P L**2/(E I) = 4: Mattiasson (1981), Int. J. Numer.
    Methods Eng. 17."""
    length, height, width, young = 10.0, 0.1, 0.1, 1.2e6
    stiffness = young * width * height**3 / 12
    load = 4 * stiffness / length**2
    boxes = (60 if not second else 30, 1, 1)
    block = Block(boxes, corners, second, lambda u: u * [length, width, height])
    end = block.nodes(lambda u: u[0] == 1)
    deck = [
        *block.deck(),
        ".SEL",
        block.group(1, "wall", block.nodes(lambda u: u[0] == 0)),
        block.group(2, "end", end),
        f'.MAT\n I 1 BEHA "ELASTIC" YT {young} NT 0.',
        f".AEL\n I 1 J {len(block.cells)} K 1 MAT 1",
        f'.CLM\n GROUP "wall" FIX C 1 2 3\n GROUP "end" CHA C 3 V {load / len(end):.16g} NF 1',
        ".FCT\n I 1 RAMP 0 0 1 1",
        ".SAM TYPE STATIC\n.SUB TF 1 H 0.05",
        ".FIN 1",
    ]
    result = run("\n".join(deck), tmp_path)
    found = displacements(result.file)[end].mean(axis=0) / length
    # the beam of the elastica neither stretches nor shears, this one does by some (h/L)**2
    assert found[2] == pytest.approx(0.66996, abs=5e-4)
    assert found[0] == pytest.approx(-0.32894, abs=5e-4)
