# SPDX-License-Identifier: BSD-3-Clause
"""Whose histories a run keeps, what a result costs on the disk, and what a disk without space does."""

import os
import re
import resource
import shutil
import signal
import subprocess
import time
from pathlib import Path

import h5py
import numpy as np
import pytest
from engrane_post import Results
from runs import Run, engrane, program
from small_decks import SQUARE


def row(count: int, more: str = "", end: float = 0.05) -> str:
    """Masses in a row on springs, of which the first hangs on the ground."""
    lines = [".NOE", *(f" I {i} X {i} 0 0" for i in range(1, count + 1)), ".MCE"]
    lines += [f" I {i} INERTIA N {i} M 1" for i in range(1, count + 1)]
    lines += [f" I {count + i} SPRING N {i - 1} {i} K 1000 C 1" for i in range(1, count + 1)]
    lines += [".CLM STRU ACC VAL 0 0 -9.81", ".SAM TYPE DYNAMIC SOLVER KLU", f".SUB TF {end} H 0.01"]
    return "\n".join([*lines, more, ".FIN 1\n"])


def names(folder: Path) -> set[str]:
    with Results(folder / "deck.h5") as result:
        return {name for name in result.channels if not name.startswith("run/")}


def test_small_models_keep_all(tmp_path):
    ended = engrane(row(10), tmp_path)
    assert ended.returncode == 0 and "histories" not in ended.stderr
    kept = names(tmp_path)
    assert {"element/20/LENGTH", "node/1/UX", "node/10/EZ"} <= kept
    assert len({name.split("/")[1] for name in kept if name.startswith("node/")}) == 10


def test_large_models_say_what_they_leave_out(tmp_path):
    checks = ".CHK\n NODE 7 UZ V 0 ATOL 1\n ELEMENT 205 LENGTH V 1 ATOL 1"
    ended = engrane(row(200, checks), tmp_path)
    assert ended.returncode == 0
    assert ended.stderr.count("histories are kept of the run and of what .CHK compares only") == 1
    assert "600 elements and nodes" in ended.stderr
    assert "histories are kept of the run" in (tmp_path / "deck.lst").read_text(encoding="utf-8")
    assert names(tmp_path) == {"node/7/UZ", "element/205/LENGTH"}


def test_all_of_a_large_model_if_asked(tmp_path):
    ended = engrane(row(200, ".SAI KEEP ALL"), tmp_path)
    assert ended.returncode == 0 and "histories" not in ended.stderr
    kept = names(tmp_path)
    assert {"node/1/UX", "node/200/EZ", "element/400/LENGTH"} <= kept


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("ELEMENT 12 14 A 15 CHANNEL LENGTH", {f"element/{i}/LENGTH" for i in (12, 14, 15)}),
        ("TYPE SPRING CHANNEL LENGTH", {f"element/{i}/LENGTH" for i in range(11, 21)}),
        ('NOEUD 3 GROUP ends CHANNEL "UX" "UZ"', {f"node/{i}/{c}" for i in (1, 3, 10) for c in ("UX", "UZ")}),
        ("GROUP springs CHANNEL LENGTH", {"element/11/LENGTH", "element/20/LENGTH"}),
        ("CHANNEL WX", {f"node/{i}/WX" for i in range(1, 11)}),
        ("KEEP NONE", set()),
    ],
)
def test_selection(tmp_path, words, expected):
    groups = '.SEL GROUP 1 NOM "ends" NOEUDS 1 10\n GROUP 2 NOM "springs" ELEMENTS 11 20\n'
    ended = engrane(row(10, f"{groups}.SAI {words}"), tmp_path)
    assert ended.returncode == 0, ended.stderr
    assert names(tmp_path) == expected
    # a selection changes what is kept, not what it is
    chosen = {name: Run(tmp_path / "deck.h5")[name] for name in expected}
    assert engrane(row(10), tmp_path).returncode == 0
    for name, values in chosen.items():
        np.testing.assert_array_equal(values, Run(tmp_path / "deck.h5")[name])


def test_size_of_a_large_result(tmp_path):
    assert engrane(row(8000), tmp_path, "-q").returncode == 0
    assert (tmp_path / "deck.h5").stat().st_size < 5e6


@pytest.mark.parametrize("limit", [1000, 20_000, 60_000, 200_000, 1_000_000])
def test_a_limit_of_file_size_ends_with_a_message(tmp_path, limit):
    ended = engrane(
        row(10, ".SAI KEEP ALL FIELDS DT 0.01", end=40),
        tmp_path,
        "-q",
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
    )
    # 1: nothing was solved, as not even the start of the files had room
    assert ended.returncode == (1 if limit <= 20_000 else 2), (ended.returncode, ended.stderr)
    assert "Cannot write" in ended.stderr and "File too large" in ended.stderr
    assert not list(tmp_path.glob("*~"))


@pytest.mark.parametrize("size", [0, 16, 48, 64, 128, 512])
def test_a_full_disk_ends_with_a_message(tmp_path, size):
    """On a small disk of its own, where one may be made; kilobytes."""
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={max(size, 4)}k", "tmpfs", str(disk)]
    if (
        os.geteuid() != 0
        or shutil.which("mount") is None
        or subprocess.run(mount, capture_output=True).returncode
    ):
        pytest.skip("no disk can be made here")
    try:
        if size == 0:
            (disk / "filler").write_bytes(b"x" * 4096)
        ended = engrane(row(10, ".SAI KEEP ALL FIELDS DT 0.01", end=40), tmp_path, "-q", "-o", "disk/deck")
        assert ended.returncode == (1 if size <= 16 else 2), (ended.returncode, ended.stderr)
        assert "Cannot write" in ended.stderr and "No space left" in ended.stderr
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def test_reading_while_the_run_writes(tmp_path):
    (tmp_path / "deck.dat").write_text(row(10, ".SAI KEEP ALL", end=100000), encoding="utf-8")
    with subprocess.Popen([program(), "-q", "deck.dat"], cwd=tmp_path) as process:
        path = tmp_path / "deck.h5"
        deadline = time.monotonic() + 60
        while not path.exists() and time.monotonic() < deadline:
            time.sleep(0.01)
        lengths, stop = [], time.monotonic() + 60
        try:
            with Results(path) as result:
                while len(set(lengths)) < 3 and time.monotonic() < stop:
                    t = result.times()
                    if len(t) == 0:
                        continue
                    when, z = result.history("node/10/UZ")
                    assert len(when) == len(z) >= len(t)
                    assert np.all(np.diff(when) > 0) and np.all(z[1:] != 0), "a row that was not written yet"
                    lengths.append(len(when))
        finally:
            process.send_signal(signal.SIGTERM)
    assert len(set(lengths)) == 3, "the file grew while it was read"


def test_records_of_sai_add_up(tmp_path: Path) -> None:
    """Nodes of one, an element of another, channels and steps of a third."""
    deck = """.NOE
 I 1
 I 2 X 1
 I 3 X 2
.MCE
 I 1 SPRING N 1 2 K 10
 I 2 SPRING N 2 3 K 10
.CLM
 NOEUD 1 3 FIX C 1 2 3
 NOEUD 2 FIX C 2 3
 NOEUD 2 CHA C 1 V 1.
.SAM TYPE STATIC
.SUB TF 1 H 0.25
.SAI ARCHIVE STRUCTURE STYP 1411
.SAI NOEUD 1
.SAI NOEUD 2 FIELDS DT 0.5
.SAI ELEMENT 2
.SAI STYP -221 FIELDS DT 0.5
"""
    done = engrane(deck, tmp_path)
    assert done.returncode == 0, done.stderr
    with Results(tmp_path / "deck.h5") as results:
        owners = {name.rpartition("/")[0] for name in results.channels}
        assert {o for o in owners if o != "run"} == {"node/1", "node/2", "element/2"}
        assert list(results.frame_times) == [0, 0.5, 1]


CELLS = f"""{SQUARE}\
.SEL GROUP 1 MAILLES TOUT
.MAT
 I 1 BEHA "ELASTIC" YT 1000. NT 0.3
.HYP DEFO PLAN GROUP 1
.AEL I 1 MAT 1
.CLM
 NOEUD 1 FIX C 1 2
 NOEUD 4 FIX C 1
 NOEUD 2 CHA C 1 V 1.
.SAI ARCHIVE STRUCTURE STYP 163 223 1411 1421 1431 1445 3411 3421 3435 3446
.FIN 1
"""
BODY = """.NOE
 I 1
.MCE
 I 1 INERTIA N 1 M 1 J 1
.CLM
 NOEUD 1 FIX C 2 3 5 6
 NOEUD 1 CHA C 1 V 1.
.SAM TYPE DYNAMIC
.SUB TF 0.1 H 0.05
.SAI STYP 163 191 221 224 901 981 982 984 985
.FIN 1
"""


@pytest.mark.parametrize("deck", [CELLS, BODY], ids=["cells", "body"])
def test_results_hold_what_codes_stand_for(deck: str, tmp_path: Path) -> None:
    done = engrane(deck, tmp_path)
    assert done.returncode == 0, done.stderr
    (said,) = re.findall(r"all results are archived: (.*)", done.stderr)
    named = dict(re.findall(r"([\d ]+) (?:is|are) ([^,]*)", said))
    codes = {word for text in named for word in text.split()}
    assert codes == set(re.search(r"STYP ([\d ]+)", deck)[1].split())
    with h5py.File(tmp_path / "deck.h5") as file:
        run_channels = [name.decode() for name in file["history/run/channels"][:]]
        for meaning in named.values():
            what, _, where = meaning.partition(" ")
            if where == "of the run":
                assert what in run_channels
            elif meaning == "the times of the histories":
                assert len(file["history/time"])
            elif where:
                assert len(file[{"at nodes": "nodes", "of cells": "fields"}[where]][what]) > 0
            else:
                assert len(file[f"fields/{what}"]) > 0
