# SPDX-License-Identifier: BSD-3-Clause
"""Ranks on nodes that do not see the same files: they waited for each other, or solved the deck of rank 0."""

import json
import subprocess

import h5py
import pytest
from ranks import on_ranks
from small_decks import PENDULUM

ADVICE = "Every rank reads the deck: keep it on a file system that all nodes see"
SCRIPT = """#!/bin/sh
cd "node$OMPI_COMM_WORLD_RANK" || exit 9
exec "$ENGRANE" "$@"
"""


@pytest.fixture
def nodes(engrane):
    """Calls the program on ranks that each work in a folder of their own, node0, node1, …"""
    script = engrane.folder / "on_node.sh"
    script.write_text(SCRIPT)

    def call(*words, ranks=2):
        command = on_ranks(ranks, ["sh", str(script), *words])
        return subprocess.run(command, cwd=engrane.folder, capture_output=True, text=True, timeout=60)

    def folder(rank, **files):
        place = engrane.folder / f"node{rank}"
        place.mkdir(exist_ok=True)
        for name, text in files.items():
            (place / f"{name}.dat").write_text(text)
        return place

    call.folder = folder
    return call


@pytest.mark.parametrize("task", [["check"], []])
def test_one_rank_has_no_deck(task, nodes):
    nodes.folder(0, pendulum=PENDULUM)
    nodes.folder(1)
    nodes.folder(2)
    done = nodes(*task, "pendulum.dat")
    assert done.returncode == 1
    assert done.stderr.startswith("engrane: rank 1 cannot read the deck: ") and ADVICE in done.stderr
    assert "pendulum.dat" in done.stderr and done.stderr.count("engrane: ") == 1
    assert "rank 1 and 1 other cannot read the deck" in nodes(*task, "pendulum.dat", ranks=3).stderr


def test_the_first_rank_has_no_deck(nodes):
    nodes.folder(0)
    nodes.folder(1, pendulum=PENDULUM)
    done = nodes("pendulum.dat")
    assert done.returncode == 1 and done.stderr.startswith("error: ") and "rank" not in done.stderr


def test_no_rank_has_a_good_deck(nodes):
    for rank in range(2):
        nodes.folder(rank, pendulum=PENDULUM.replace("HINGE", "HINGES"))
    done = nodes("pendulum.dat")
    assert done.returncode == 1
    assert done.stderr.count("error: ") == 1 and "rank" not in done.stderr


@pytest.mark.parametrize("included", [False, True])
def test_ranks_read_different_decks(included, nodes):
    first, other = PENDULUM, PENDULUM.replace("'2.'", "'3.'")
    for rank, text in enumerate((first, other)):
        nodes.folder(
            rank, **({"pendulum": 'INPUT "part.dat"\n', "part": text} if included else {"pendulum": text})
        )
    for task in (["check"], []):
        done = nodes(*task, "pendulum.dat")
        assert done.returncode == 1
        assert "engrane: rank 1 reads another deck pendulum.dat than rank 0" in done.stderr
        assert ADVICE in done.stderr
    done = nodes("pendulum.dat", "--json")
    summary = json.loads(done.stdout)
    assert done.returncode == summary["status"] == summary["runs"][0]["status"] == 1
    assert "rank 1 reads another deck" in summary["runs"][0]["failure"]


def test_the_same_deck_in_several_folders_runs(nodes):
    """As copies on the disks of the nodes; only the first rank writes. A bad deck leaves the next alone."""
    for rank in range(2):
        nodes.folder(rank, good=PENDULUM, bad=PENDULUM + f'.TITRE "node {rank}"\n')
    done = nodes("bad.dat", "good.dat", "--json")
    summary = json.loads(done.stdout)
    assert [run["status"] for run in summary["runs"]] == [1, 0], done.stderr
    assert done.returncode == summary["status"] == 1
    with h5py.File(nodes.folder(0) / "good.h5") as file:
        assert len(file["history/time"]) > 10


def test_one_rank_has_no_restart_point(nodes):
    for rank in range(2):
        nodes.folder(rank, pendulum=PENDULUM)
    nodes("pendulum.dat", "-o", "part", "--until", "0.1")
    done = nodes("pendulum.dat", "--restart", "part")
    assert done.returncode == 1
    assert "engrane: rank 1 cannot read them: Cannot restart from part" in done.stderr
    assert "results to restart from" in done.stderr
