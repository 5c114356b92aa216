# SPDX-License-Identifier: BSD-3-Clause
"""`.MAI FILE`: a mesh in a file of HDF5 is the same as its text, and what is wrong with one is told."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest
from engrane_post.__main__ import main
from ranks import on_ranks
from runs import engrane, program, run

# two hexahedra in a row, and a wedge behind them: sets of nodes, cells and of a face
MESH = """*NODE
1, 0., 0., 0.
2, 1.1, 0., 0.
3, 2., 0., 0.
4, 0., 1., 0.
5, 1., 1., 0.
6, 2., 1., 0.
11, 0., 0., 1.
12, 0.9, 0., 1.
13, 2., 0., 1.
14, 0., 1., 1.
15, 1., 1.1, 1.
16, 2., 1., 1.
7, 3., 0.5, 0.
17, 3., 0.5, 1.
*ELEMENT, TYPE=C3D8, ELSET=bricks
1, 1, 2, 5, 4, 11, 12, 15, 14
2, 2, 3, 6, 5, 12, 13, 16, 15
*ELEMENT, TYPE=C3D6, ELSET=tip
3, 3, 7, 6, 13, 17, 16
*NSET, NSET=wall
1, 4, 11, 14
*NSET, NSET=end
7, 17
*SURFACE, NAME=top
1, S2
2, S2
"""
CARDS = """.MAT
 I 1 YT 1000. NT 0.3 M 1E-3
.AEL
 GROUP "bricks" MAT 1
 GROUP "tip" MAT 1
.CLM
 GROUP "wall" FIX C 1 2 3
 GROUP "end" CHA C 3 V 2.
 STRU ACC VAL 0 0 -9.81
 GROUP "top" PRE V 3.
.SAM TYPE STATIC
.SUB TF 1. H 0.5
.FIN 1
"""


def imported(folder: Path, *words: str) -> str:
    (folder / "mesh.inp").write_text(MESH)
    before = Path.cwd()
    os.chdir(folder)
    try:
        assert main(["import", "mesh.inp", "--force", *words]) == 0
    finally:
        os.chdir(before)
    text = (folder / "mesh.dat").read_text()
    return "".join(line + "\n" for line in text.splitlines() if not line.startswith(("!", ".FIN"))) + CARDS


def fields(file: Path) -> dict[str, np.ndarray]:
    """All numbers of a result, but those that tell of the machine."""
    found = {}

    def take(name: str, item: object) -> None:
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "if" and "cost" not in name:
            found[name] = item[()]

    with h5py.File(file) as result:
        result.visititems(take)
    return found


def last_frame(of: dict[str, np.ndarray]) -> str:
    return max(name for name in of if name.startswith("fields/displacement/"))


@pytest.mark.parametrize("ranks", [1, 2, 3])
def test_results_are_those_of_the_text(ranks: int, tmp_path: Path) -> None:
    text, file = imported(tmp_path), imported(tmp_path, "--binary")
    assert 'FILE "mesh.mesh.h5"' in file and ".NOE" not in file
    a, b = (fields(run(deck, tmp_path, name, ranks=ranks).file) for deck, name in ((text, "a"), (file, "b")))
    assert a.keys() == b.keys() and len(a) > 10
    assert np.abs(a[last_frame(a)]).max() > 1e-3
    for name, values in a.items():
        np.testing.assert_array_equal(values, b[name], err_msg=name)


def test_a_deck_adds_to_its_mesh(tmp_path: Path) -> None:
    """Nodes, elements and groups of its own, and a second file; the mesh lies in another folder."""
    deck = imported(tmp_path, "--binary")
    (tmp_path / "meshes").mkdir()
    (tmp_path / "mesh.mesh.h5").rename(tmp_path / "meshes" / "one.mesh.h5")
    one, two = tmp_path / "meshes" / "one.mesh.h5", tmp_path / "two.mesh.h5"
    shutil.copy(one, two)
    with h5py.File(two, "r+") as file:
        del file["groups"]
        file["nodes/numbers"][...] += 100
        file["nodes/places"][:, 2] += 2.0
        for block in file["cells"].values():
            block["numbers"][...] += 100
            nodes = block["nodes"][...]
            block["nodes"][...] = nodes + 100 * np.sign(nodes)
    deck = deck.replace(
        '.MAI FILE "mesh.mesh.h5"',
        '.MAI FILE "meshes/one.mesh.h5"\n.MAI FILE "two.mesh.h5" I 200 N 103 113 106 0 300\n'
        ".NOE\n I 300 X 5. Y 0 Z 3.",
    ).replace(' GROUP "tip" MAT 1', ' GROUP "tip" MAT 1\n I 101 J 103 K 1 MAT 1\n I 200 MAT 1')
    deck = deck.replace(".CLM", '.SEL\n GROUP 9 NOM "upper" NOEUDS 101 104 107 110 300\n.CLM')
    deck = deck.replace('"wall" FIX C 1 2 3', '"wall" FIX C 1 2 3\n GROUP "upper" FIX C 1 2 3')
    with h5py.File(run(deck, tmp_path).file) as result:
        assert {1, 2, 3, 101, 102, 103, 200} <= set(result["mesh/cell_elements"][()].tolist())
        assert 300 in result["mesh/node_ids"][()]


def change(name: str, value) -> Callable[[h5py.File], None]:
    def apply(file: h5py.File) -> None:
        if name in file:
            del file[name]
        if value is not None:
            file[name] = value

    return apply


def set_place(file: h5py.File) -> None:
    file["nodes/places"][3, 1] = np.nan


def set_node(file: h5py.File) -> None:
    file["cells/1/nodes"][0, 0] = 99


def set_row(file: h5py.File) -> None:
    file["cells/1/nodes"][0, 4] = 3


def set_kind(file: h5py.File) -> None:
    file["groups/1"].attrs["kind"] = "EDGES"


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (change("nodes", None), "its `nodes/numbers` is not there"),
        (change("nodes/places", np.zeros((3, 3))), "no table of 14 rows x y z"),
        (change("nodes/numbers", np.arange(14, dtype=np.int32)), "holds 0: numbers are from 1"),
        (change("nodes/numbers", np.full(14, 7, np.int32)), ".NOE 7 is given twice"),
        (change("nodes/numbers", np.arange(1, 15) * 1.0), "does not hold whole numbers"),
        (change("cells", None), "it has no cells"),
        (change("cells/1/nodes", np.ones((1, 9), np.int32)), "does not have a row for each of 2 cells"),
        (change("cells/2/numbers", np.array([2], np.int32)), ".MAI 2 is given twice"),
        (set_place, "has no finite place for node 4"),
        (set_node, "node 99 of cell 1 does not exist"),
        (set_row, "is not in this version"),
        (set_kind, "has no `kind` NODES, ELEMENTS or FACES"),
        (lambda file: file.attrs.modify("engrane_mesh", 2), "its version is 2, this program reads 1"),
        (lambda file: file.attrs.pop("engrane_mesh"), "but no mesh of engrane"),
    ],
)
@pytest.mark.parametrize("ranks", [1, 2])
def test_faults(wrong: Callable[[h5py.File], None], words: str, ranks: int, tmp_path: Path) -> None:
    deck = imported(tmp_path, "--binary")
    with h5py.File(tmp_path / "mesh.mesh.h5", "r+") as file:
        wrong(file)
    assert words in refused(deck, tmp_path, ranks)


def refused(deck: str, folder: Path, ranks: int = 1, options: tuple[str, ...] = ()) -> str:
    """What is said of a deck that is wrong; it names the line of the file."""
    done = engrane(deck, folder, *options, name="wrong", ranks=ranks)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "HDF5-DIAG" not in done.stderr
    return done.stderr


def test_files_that_are_none(tmp_path: Path) -> None:
    deck = imported(tmp_path, "--binary")
    said = refused(deck.replace("mesh.mesh.h5", "mesh.inp"), tmp_path)
    assert "engrane import mesh.inp -o mesh.mesh.h5" in said
    assert "wrong.dat:2:11" in said
    assert "there is no file `other.mesh.h5`" in refused(
        deck.replace("mesh.mesh.h5", "other.mesh.h5"), tmp_path
    )
    whole = (tmp_path / "mesh.mesh.h5").read_bytes()
    (tmp_path / "mesh.mesh.h5").write_bytes(whole[: len(whole) // 2])
    assert "it cannot be read as HDF5: " in refused(deck, tmp_path)
    (tmp_path / "mesh.mesh.h5").write_text("no mesh")
    assert "it cannot be read as HDF5: " in refused(deck, tmp_path)


def test_numbers_of_the_deck_do_not_clash(tmp_path: Path) -> None:
    deck = imported(tmp_path, "--binary")
    said = refused(deck.replace(".MAT\n", ".NOE\n I 5 X 0\n.SEL\n GROUP 1 NOEUDS 5\n.MAT\n"), tmp_path)
    assert ".NOE 5 is given twice" in said and ".SEL 1 is given twice" in said and "first in line 2" in said


def test_the_mesh_is_not_written_over(tmp_path: Path) -> None:
    deck = imported(tmp_path, "--binary")
    before = (tmp_path / "mesh.mesh.h5").read_bytes()
    said = refused(deck, tmp_path, options=("-o", "mesh.mesh"))
    assert "would take the place of the mesh mesh.mesh.h5" in said
    assert (tmp_path / "mesh.mesh.h5").read_bytes() == before


def test_a_restart_knows_its_mesh(tmp_path: Path) -> None:
    deck = imported(tmp_path, "--binary")
    whole = run(deck, tmp_path, "whole")
    run(deck.replace("TF 1.", "TF 0.5"), tmp_path, "half")
    again = deck.replace("TYPE STATIC", 'TYPE STATIC RESTART "half"')
    a, b = fields(whole.file), fields(run(again, tmp_path, "rest").file)
    np.testing.assert_array_equal(a[last_frame(a)], b[last_frame(b)])
    with h5py.File(tmp_path / "mesh.mesh.h5", "r+") as file:
        file["nodes/places"][6, 0] += 0.1
    assert ".NOE 7: X was" in refused(again, tmp_path)


def test_ranks_that_read_different_meshes_do_not_run(tmp_path: Path) -> None:
    """The decks are the same, a node of the mesh of rank 1 is elsewhere."""
    for rank in range(2):
        (folder := tmp_path / f"node{rank}").mkdir()
        (folder / "bar.dat").write_text(imported(folder, "--binary"))
    script = tmp_path / "on_node.sh"
    script.write_text('cd "node$OMPI_COMM_WORLD_RANK" && exec "$@" bar.dat\n')

    def solved() -> subprocess.CompletedProcess[str]:
        command = on_ranks(2, ["sh", str(script), program()])
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60)

    assert solved().returncode == 0
    with h5py.File(tmp_path / "node1" / "mesh.mesh.h5", "r+") as file:
        file["nodes/places"][6, 0] += 1e-3
    done = solved()
    assert done.returncode == 1
    assert "rank 1 reads another deck bar.dat than rank 0, or other files that it names" in done.stderr
    (tmp_path / "node1" / "mesh.mesh.h5").unlink()
    done = solved()
    assert done.returncode == 1
    assert "rank 1 cannot read the deck: bar.dat:" in done.stderr and "there is no file" in done.stderr
