# SPDX-License-Identifier: BSD-3-Clause
"""`.SEL`: records of one number, or of one name and kind, are one group; contradictions are refused. Boxes
choose cells too, and a face named twice counts once."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from runs import engrane, run
from small_decks import SQUARES

CARDS = """.MAT I 1 BEHA "ELASTIC" YT 1000. NT 0. M 1.
.HYP MEMB BIDIM
.PHP GROUP "plate" THICK VAL 1.
.AEL GROUP "plate" MAT 1
.CLM
 GROUP "wall" FIX C 1 2
"""
PLATE = ' GROUP 1 MAILLES NOM "plate" TOUT\n'
WALL = ' GROUP 2 NOEUDS NOM "wall" I 1 I 4\n'


def test_nodes_of_one_name_are_one_group(tmp_path: Path) -> None:
    tip = '.SEL\n GROUP 3 NOEUDS NOM "tip" I 3\n.SEL\n GROUP 4 NOEUDS NOM "tip" I 6\n'
    for name in ('"tip"', "3", "4"):
        result = run(
            f"{SQUARES}.SEL\n{PLATE}{WALL}{tip}{CARDS} GROUP {name} CHA C 1 V 10.\n.FIN 1\n", tmp_path
        )
        assert result["run/LOAD_FORCE_X"][-1] == pytest.approx(20, rel=1e-12)
        assert result["node/3/UX"][-1] == pytest.approx(result["node/6/UX"][-1], rel=1e-12)


def test_nodes_of_one_number_are_one_group(tmp_path: Path) -> None:
    """A support is lost if the first record is."""
    wall = ' GROUP 2 NOEUDS NOM "wall" I 1\n.SEL\n GROUP 2 NOEUDS I 4\n'
    deck = f"{SQUARES}.SEL\n{PLATE}{wall}{CARDS} NOEUD 3 CHA C 1 V 5.\n NOEUD 6 CHA C 1 V 5.\n.FIN 1\n"
    result = run(deck, tmp_path)
    assert result["node/3/UX"][-1] == pytest.approx(10 * 20 / (1000 * 10), rel=1e-9)
    assert result["run/GROUND_FORCE_X"][-1] == pytest.approx(-10, rel=1e-9)


def test_records_above_see_what_was_there(tmp_path: Path) -> None:
    tip = '.SEL\n GROUP 3 NOEUDS NOM "tip" I 3\n'
    more = '.SEL\n GROUP 3 NOEUDS NOM "tip" I 6\n.CLM ADD\n GROUP "tip" CHA C 1 V 100.\n'
    deck = f"{SQUARES}.SEL\n{PLATE}{WALL}{tip}{CARDS} GROUP 3 CHA C 1 V 1.\n{more}.FIN 1\n"
    assert run(deck, tmp_path)["run/LOAD_FORCE_X"][-1] == pytest.approx(201, rel=1e-12)


def test_elements_and_faces(tmp_path: Path) -> None:
    plate = ' GROUP 1 MAILLES NOM "plate" AT 1\n.SEL\n GROUP 7 MAILLES NOM "plate" I 2\n'
    lid = ' GROUP 8 FACES NOM "lid"\n  I 1 3\n.SEL\n GROUP 9 FACES NOM "lid"\n  I 2 3\n'
    for name in ("8", '"lid"'):
        deck = f"{SQUARES}.SEL\n{plate}{WALL}{lid}{CARDS} GROUP {name} PRE V 3.\n.FIN 1\n"
        result = run(deck, tmp_path)
        assert result["run/MASS"][-1] == pytest.approx(200, rel=1e-12)
        assert result["run/LOAD_FORCE_Y"][-1] == pytest.approx(-60, rel=1e-12)


@pytest.mark.parametrize("box", ["0 10 0 10 0 0", "-1 19.9 -5 10 -1 1"])
def test_a_box_takes_the_cells_that_lie_in_it(box: str, tmp_path: Path) -> None:
    heavy = (
        f'.MAT I 2 YT 1000. NT 0. M 4.\n.SEL GROUP 5 NOM "box" MAILLES BOITE {box}\n.AEL GROUP "box" MAT 2\n'
    )
    deck = f"{SQUARES}.SEL\n{PLATE}{WALL}{CARDS} NOEUD 3 CHA C 1 V 1.\n{heavy}.FIN 1\n"
    assert run(deck, tmp_path)["run/MASS"][-1] == pytest.approx(500, rel=1e-12)


def test_a_union_of_unknown_elements_is_refused(tmp_path: Path) -> None:
    both = ' GROUP 3 MAILLES NOM "both" UNION "plate" "plat"\n'
    said = refusal(f"{SQUARES}.SEL\n{PLATE}{both}{WALL}{CARDS}.FIN 1\n", tmp_path)
    assert 'there is no group of elements "plat"' in said and 'did you mean "plate"?' in said


@pytest.mark.parametrize("groups", ['"lid"', '"lid" "rim"', "8 9 8"])
def test_a_face_named_twice_carries_its_pressure_once(groups: str, tmp_path: Path) -> None:
    lids = ' GROUP 8 FACES NOM "lid"\n  I 1 3\n  I 1 3\n  I 2 3\n GROUP 9 FACES NOM "rim"\n  I 2 3\n'
    deck = f"{SQUARES}.SEL\n{PLATE}{WALL}{lids}{CARDS} GROUP {groups} PRE V 3.\n.FIN 1\n"
    assert run(deck, tmp_path)["run/LOAD_FORCE_Y"][-1] == pytest.approx(-60, rel=1e-12)


def test_one_name_of_nodes_and_of_elements_is_two_groups(tmp_path: Path) -> None:
    both = ' GROUP 3 NOEUDS NOM "plate" I 3\n'
    deck = f'{SQUARES}.SEL\n{PLATE}{WALL}{both}{CARDS} GROUP "plate" CHA C 1 V 10.\n.FIN 1\n'
    assert run(deck, tmp_path)["run/LOAD_FORCE_X"][-1] == pytest.approx(10, rel=1e-12)


def refusal(deck: str, folder: Path) -> str:
    done = engrane(deck, folder, "check", name="wrong")
    assert done.returncode == 1, done.stdout + done.stderr
    return done.stderr


@pytest.mark.parametrize(
    ("second", "words"),
    [
        ('GROUP 2 NOEUDS NOM "floor" I 3', 'named "wall" and "floor"'),
        ("GROUP 2 MAILLES I 2", "of nodes and of elements"),
        ('GROUP 3 NOEUDS NOM "wall" I 3', '"wall" is another group, in line 13'),
    ],
)
def test_contradictions_name_both_places(second: str, words: str, tmp_path: Path) -> None:
    third = " GROUP 3 NOEUDS I 6\n"
    said = refusal(f"{SQUARES}.SEL\n{PLATE}{WALL}{third}.SEL\n {second}\n{CARDS}.FIN 1\n", tmp_path)
    assert "is given twice" in said and words in said
    assert "wrong.dat:16:" in said and f"first in line {13 if 'GROUP 2' in second else 14}" in said
    assert said.count("error:") == 1


def part(path: Path, first: int, x: float, group: str) -> None:
    """A square whose left side is at x, and a group of it."""
    with h5py.File(path, "w") as file:
        file.attrs["engrane_mesh"] = 1
        file["nodes/numbers"] = np.arange(first, first + 4, dtype=np.int32)
        file["nodes/places"] = np.array([[x, 0, 0], [x + 10, 0, 0], [x + 10, 10, 0], [x, 10, 0]], float)
        file["cells/1/numbers"] = np.array([first], np.int32)
        file["cells/1/nodes"] = np.arange(first, first + 4, dtype=np.int32).reshape(1, 4)
        file["groups/1"] = np.array([first], np.int32)
        file["groups/1"].attrs.update({"name": group, "kind": "ELEMENTS"})


@pytest.mark.parametrize("names", [("plate", "plate"), ("left", "right")])
def test_groups_of_two_mesh_files(names: tuple[str, str], tmp_path: Path) -> None:
    """Both begin with group 1."""
    part(tmp_path / "a.mesh.h5", 1, 0, names[0])
    part(tmp_path / "b.mesh.h5", 11, 30, names[1])
    both = f'.SEL\n GROUP 5 MAILLES NOM "plate" UNION "{names[0]}" "{names[1]}"\n GROUP 6 NOEUDS NOM "wall"'
    deck = f'.MAI FILE "a.mesh.h5"\n.MAI FILE "b.mesh.h5"\n{both} TOUT\n{CARDS}.FIN 1\n'
    assert run(deck, tmp_path)["run/MASS"][-1] == pytest.approx(200, rel=1e-12)
