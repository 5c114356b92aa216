# SPDX-License-Identifier: BSD-3-Clause
"""What may happen to a run: a full disk, another run of the same name, signals, files that are no decks."""

import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import h5py
import pytest

HERE = Path(__file__).resolve().parent


def start(engrane, *words, **environment):
    """A run that the test does not wait for."""
    kept = {name: text for name, text in os.environ.items() if not name.startswith("OMPI_MCA_")}
    return subprocess.Popen(
        [os.environ["ENGRANE"], *words],
        cwd=engrane.folder,
        env=kept | environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def is_complete(path: Path, end: float) -> bool:
    with h5py.File(path, "r") as file:
        status = file.attrs["status"]
        status = status.decode() if isinstance(status, bytes) else status
        return status == "complete" and abs(file["history/time"][-1] - end) < 1e-12


@pytest.fixture
def full_disk(engrane):
    """Environment of a run whose disk is full after so many writes."""
    compiler = shutil.which("gcc") or shutil.which("cc")
    if not compiler:
        pytest.skip("no C compiler")
    if b"__asan_init" in Path(os.environ["ENGRANE"]).read_bytes():
        pytest.skip("the sanitizers do not stand a library before them")
    library = engrane.folder / "no_space.so"
    subprocess.run([compiler, "-shared", "-fPIC", HERE / "no_space.c", "-o", library, "-ldl"], check=True)
    place = engrane.folder / "full"
    place.mkdir()

    def environment(after: int) -> dict[str, str]:
        return os.environ | {
            "LD_PRELOAD": str(library),
            "NO_SPACE_IN": str(place),
            "NO_SPACE_AFTER": str(after),
            "NO_SPACE_COUNT": str(engrane.folder / "count"),
        }

    return environment


def test_the_disk_is_full_at_any_write(engrane, pendulum, full_disk):
    run = ("-q", pendulum, "-o", "full/run")
    assert engrane(*run, env=full_disk(10**9)).returncode == 0
    writes = int((engrane.folder / "count").read_text())
    assert writes > 20
    results = engrane.folder / "full" / "run.h5"
    good = results.read_bytes()
    # all of the first and last writes, and some between
    for after in sorted({*range(8), *range(8, writes - 6, max(1, writes // 16)), *range(writes - 6, writes)}):
        done = engrane(*run, env=full_disk(after))
        # 1: full before the files were there, and nothing was solved
        assert done.returncode in (1, 2), (
            f"after {after} of {writes} writes: {done.returncode}, {done.stderr}"
        )
        assert done.returncode == (1 if after == 0 else 2 if after > writes // 2 else done.returncode)
        assert "No space left on device" in done.stderr, f"after {after}: {done.stderr}"
        assert "HDF5" not in done.stderr and "rror" not in done.stderr, done.stderr
        if results.read_bytes() != good:  # the run was through: only its last words had no space
            assert is_complete(results, 0.2), after
            results.write_bytes(good)
        for other in results.parent.glob("run.partial*"):
            other.unlink()


def test_two_runs_of_one_name(engrane, pendulum):
    for pair in range(20):
        runs = [start(engrane, "-q", pendulum, "-o", "same") for _ in range(2)]
        said = [run.communicate(timeout=60)[1] for run in runs]
        status = sorted(run.returncode for run in runs)
        assert status in ([0, 0], [0, 1]), (pair, status, said)
        if status == [0, 1]:
            assert "another run is writing it" in "".join(said), said
        assert is_complete(engrane.folder / "same.h5", 0.2), pair
        assert "TF" not in "".join(said)
        if pair % 2 == 0:  # with and without good results before
            for file in engrane.folder.glob("same*"):
                file.unlink()


def lattice(side: int) -> str:
    """Bars in a plane grid, joined by spherical joints: constraints enough to look at for a while."""
    nodes, elements = [], []
    number = 0
    for i in range(side):
        for j in range(side):
            number += 1
            nodes.append(f" I {number} X {i} {j} 0")
            elements.append(f" I {number} INERTIA N {number} M 1 J 1")
    joint = number
    for i in range(side):
        for j in range(side):
            here = i * side + j + 1
            for there in ([here + side] if i + 1 < side else []) + ([here + 1] if j + 1 < side else []):
                joint += 1
                axis = f"AXIS 1 2 {joint % 7} AT {i} {j} 0.{joint % 9}"
                elements.append(f" I {joint} HINGE N {here} {there} {axis}")
    return "\n".join([".NOE", *nodes, ".MCE", *elements, ".SAM TYPE DYNAMIC", ".SUB TF 1 H 0.001", ""])


def test_a_start_that_takes_long_is_left_at_once(engrane):
    (engrane.folder / "lattice.dat").write_text(lattice(40))
    run = start(engrane, "-q", "lattice.dat")
    time.sleep(2)
    assert run.poll() is None, "it takes longer than this"
    asked = time.monotonic()
    run.send_signal(signal.SIGTERM)
    said = run.communicate(timeout=60)[1]
    assert time.monotonic() - asked < 1
    assert run.returncode == 2
    assert "interrupted at the start" in said


def test_what_killed_runs_leave_is_cleared_away(engrane, pendulum, sessions):
    text = (engrane.folder / pendulum).read_text()
    (engrane.folder / "long.dat").write_text(text.replace("TF 0.2", "TF 2000"))
    killed, living = (
        start(engrane, "-q", "long.dat", "-o", name, TMPDIR=str(sessions)) for name in ("killed", "living")
    )
    for _ in range(200):
        if len(list(sessions.iterdir())) == 2 and (engrane.folder / "living.lst").exists():
            break
        time.sleep(0.05)
    folders = set(sessions.iterdir())
    assert len(folders) == 2
    killed.kill()
    killed.communicate()
    for folder in folders:  # as old as they look, one of them has an owner
        os.utime(folder, (0, 0))
    assert start(engrane, "-q", pendulum, TMPDIR=str(sessions)).wait(60) == 0
    left = set(sessions.iterdir())
    assert len(left) == 1 and left < folders
    living.terminate()
    living.communicate(timeout=60)
    assert not list(sessions.iterdir())


PASSWORDS = "root:x:0:0:root:/root:/bin/bash\ndaemon:x:1:1:daemon:/usr/sbin:/usr/sbin/nologin\n"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (PASSWORDS, "is no part of a deck"),
        ("-----BEGIN OPENSSH PRIVATE KEY-----\nb3BlbnNzaC1rZXk\n", "is no part of a deck"),
        ("secret words of a shell\nexport TOKEN=abcdef\n", "`...` is not a keyword"),
    ],
)
def test_files_that_are_no_decks_are_not_shown(engrane, text, told):
    (engrane.folder / "mine").mkdir()
    (engrane.folder / "private").write_text(text)
    (engrane.folder / "mine" / "deck.dat").write_text('.NOE\n I 1 X 0 0 0\nINPUT "../private"\n')
    done = engrane("check", "mine/deck.dat")
    assert done.returncode == 1
    assert told in done.stderr
    for line in text.splitlines():
        assert line not in done.stderr
    said = done.stderr + engrane("check", "mine/deck.dat", "--json").stdout
    assert "TOKEN" not in said and "root" not in said


def test_parts_of_a_deck_are_shown(engrane):
    (engrane.folder / "mine").mkdir()
    (engrane.folder / "part.dat").write_text(" I 2 X 0 0 wrong\n")
    (engrane.folder / "mine" / "near").write_text(" I 3 X 0 0 bad\n")
    (engrane.folder / "mine" / "deck.dat").write_text('.NOE\n I 1 X 0 0 0\nINPUT "../part"\nINPUT "near"\n')
    said = engrane("check", "mine/deck.dat").stderr
    assert "I 2 X 0 0 wrong" in said and "I 3 X 0 0 bad" in said


def net(side: int) -> str:
    """Point masses on springs to their neighbours, held at the first."""
    lines = [".NOE"]
    lines += [f" I {1 + i + side * j} X {i} {j} 0" for j in range(side) for i in range(side)]
    lines.append(".MCE")
    number = 0
    for node in range(1, side * side + 1):
        beside = [node + 1] if node % side else []
        for other in [*beside, node + side, node + side + 1 if beside else 0]:
            if 0 < other <= side * side:
                number += 1
                lines.append(f" I {number} SPRING N {node} {other} K 100")
        number += 1
        lines.append(f" I {number} INERTIA N {node} M 1")
    return "\n".join(
        [
            *lines,
            ".CLM FIX NOEUD 1 C 1 2 3",
            ".CLM STRU ACC VAL 0 0 -9.81",
            ".SAM TYPE DYNAMIC SOLVER MUMPS",
            ".SUB TF 0.1 H 0.1\n",
        ]
    )


@pytest.mark.parametrize(("ranks", "side"), [(1, 25), (2, 25), (2, 40)])
def test_memory_that_is_not_there(ranks, side, engrane, monkeypatch):
    """Factors that do not fit are refused before they are made, by a run and by check: on one process, on one
    of two, on both."""
    monkeypatch.setenv("ENGRANE_MEMORY", "1e-4")
    (engrane.folder / "net.dat").write_text(net(side))
    done = engrane("net.dat", ranks=ranks)
    assert done.returncode == 2
    assert "equations would take" in done.stderr and "0.0001 GB are free" in done.stderr
    if ranks == 1:
        done = engrane("check", "net.dat")
        assert done.returncode == 2 and "equations would take" in done.stdout
