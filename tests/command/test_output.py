# SPDX-License-Identifier: BSD-3-Clause
"""Where output goes: standard output that takes nothing, places for results that do not serve, texts in
Latin-1."""

import json
import os
import resource
import signal
import subprocess
from pathlib import Path

import h5py
import pytest

FULL = Path("/dev/full")


def ran(engrane, words, stdout, **more):
    return subprocess.run(
        [os.environ["ENGRANE"], *words],
        cwd=engrane.folder,
        stdout=stdout,
        stderr=subprocess.PIPE,
        text=True,
        timeout=120,
        **more,
    )


@pytest.mark.skipif(not FULL.exists(), reason="no /dev/full")
@pytest.mark.parametrize(
    "words",
    [
        ("--json", "-q", "pendulum.dat"),
        ("check", "pendulum.dat"),
        ("pendulum.dat",),
        ("pendulum.dat", "-q", "--result", "NODE 1 UX"),
        ("manual",),
        ("schema",),
        ("help",),
        ("help", "GEAR"),
        ("--help",),
        ("--version",),
    ],
)
def test_standard_output_is_full(engrane, pendulum, words):
    with FULL.open("w") as full:
        done = ran(engrane, words, full)
    assert done.returncode == 1
    last = [line for line in done.stderr.replace("\r", "\n").splitlines() if line][-1]
    assert last == "engrane: cannot write standard output: No space left on device"
    assert "PETSC" not in done.stderr
    if words[0] not in ("pendulum.dat", "check"):  # those may show progress or warnings
        assert done.stderr.count("\n") == 1


def test_a_full_standard_output_does_not_hide_another_status(engrane, pendulum):
    text = (engrane.folder / pendulum).read_text().replace("V 0 ATOL 1E-2", "V 9 ATOL 1E-2")
    (engrane.folder / pendulum).write_text(text)
    with FULL.open("w") as full:
        done = subprocess.run([os.environ["ENGRANE"], pendulum], cwd=engrane.folder, stdout=full, timeout=60)
    assert done.returncode == 4


@pytest.mark.parametrize("words", [("manual",), ("check", "pendulum.dat"), ("--json", "-q", "pendulum.dat")])
@pytest.mark.parametrize("ignored", [False, True])
def test_a_closed_pipe_is_silent(engrane, pendulum, words, ignored):
    read, write = os.pipe()
    os.close(read)
    done = ran(
        engrane,
        words,
        write,
        preexec_fn=(lambda: signal.signal(signal.SIGPIPE, signal.SIG_IGN)) if ignored else None,
        restore_signals=not ignored,
    )
    os.close(write)
    assert done.stderr == ""
    # PETSc sets the signal back to its default, the tasks without PETSc leave it ignored
    assert done.returncode in ((0, -signal.SIGPIPE) if ignored else (-signal.SIGPIPE,))


def test_a_closed_standard_output_is_not_taken_by_the_results(engrane, pendulum):
    done = subprocess.run(
        ["sh", "-c", f'"$ENGRANE" {pendulum} -o quiet >&-; echo $?'],
        cwd=engrane.folder,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.stdout.split() == ["0"]
    assert "results in" not in (engrane.folder / "quiet.lst").read_text(encoding="utf-8")
    with h5py.File(engrane.folder / "quiet.h5") as file:
        assert file.attrs["status"] == "complete"


def refusal(engrane, deck: str, prefix: str) -> str:
    """The one sentence of a run that is refused before it begins, and leaves the folder as it is."""
    before = sorted(engrane.folder.rglob("*"))
    done = engrane(deck, "-o", prefix)
    assert done.returncode == 1, done.stderr
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1, done.stderr
    assert sorted(engrane.folder.rglob("*")) == before
    return done.stderr


@pytest.mark.parametrize("ending", ["h5", "xdmf", "lst", "h5~"])
def test_a_folder_in_the_way(engrane, pendulum, ending):
    (engrane.folder / f"a.{ending}").mkdir()
    assert refusal(engrane, pendulum, "a") == f"engrane: Cannot write a.{ending}: Is a directory.\n"


def test_folders_that_are_none(engrane, pendulum):
    assert refusal(engrane, pendulum, "no/a") == "engrane: Cannot write no/a.h5: there is no folder no.\n"
    (engrane.folder / "file").write_text("")
    assert "file is no folder" in refusal(engrane, pendulum, "file/a")
    assert "file is no folder" in refusal(engrane, pendulum, "file/")


def test_names_that_are_too_long(engrane, pendulum):
    """With a complete result of that name there are files called *.partial.xdmf~ as well."""
    assert "has 242 bytes, and 241 are possible" in refusal(engrane, pendulum, "a" * 242)
    for _ in range(2):
        assert engrane("-q", pendulum, "-o", "a" * 241).returncode == 0


@pytest.mark.skipif(os.geteuid() == 0 and not Path("/proc/self").exists(), reason="root may write anywhere")
def test_folders_that_take_no_files(engrane, pendulum):
    if os.geteuid() == 0:
        prefix = "/proc/a"
    else:
        (engrane.folder / "locked").mkdir(mode=0o500)
        prefix = "locked/a"
    assert f"Cannot write {prefix}.h5: " in refusal(engrane, pendulum, prefix)


def test_the_refusal_is_told_in_json(engrane, pendulum):
    done = engrane("--json", pendulum, "-o", "no/a")
    run = json.loads(done.stdout)["runs"][0]
    assert run["status"] == 1 and "there is no folder no" in run["failure"] and run["files"] == []


def test_the_last_lines_name_files_that_exist(engrane, pendulum):
    """The disk is full at the first batch: the file holds no samples, and there is no index."""
    text = (engrane.folder / pendulum).read_text().replace("TF 0.2 H 0.01", "TF 2 H 1E-3")
    (engrane.folder / pendulum).write_text(text)
    assert engrane("-q", pendulum, "-o", "whole").returncode == 0
    limit = (engrane.folder / "whole.h5").stat().st_size // 4
    for words, stem in ((("-o", "cut"), "cut"), (("-o", "whole"), "whole.partial")):
        done = engrane(
            pendulum, *words, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        )
        assert done.returncode == 2
        assert f"Cannot write {stem}.h5: File too large" in done.stderr
        assert "results up to there" not in done.stderr
        assert done.stdout.splitlines()[-1] == f"no results; written: {stem}.h5 and {stem}.lst"
        assert "plot" not in done.stdout and "picture" not in done.stdout
        assert not (engrane.folder / f"{stem}.xdmf").exists()
        with h5py.File(engrane.folder / f"{stem}.h5") as file:
            assert len(file["history/time"]) == 0
    done = engrane(
        *("--json", "-q", pendulum, "-o", "cut"),
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
    )
    assert json.loads(done.stdout)["runs"][0]["files"] == ["cut.h5", "cut.lst"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--until", "nan"), "--until: takes a finite number, not nan"),
        (("--until", "inf"), "--until: takes a finite number, not inf"),
        (("--until", "1e999"), "--until: takes a finite number, not 1e999"),
        (("--until", "-1"), "--until -1 lies before the start of the run, t = 0"),
        (("--restart", "part", "--until", "0.05"), "--until 0.05 lies before the start of the run, t = 0.1"),
        (("--restart", "part", "--restart-at", "nan"), "--restart-at: takes a finite number, not nan"),
        (("--restart", "part", "--restart-at", "-inf"), "--restart-at: takes a finite number, not -inf"),
        (("--restart", "part", "--restart-at", "-1"), "its restart points are at t = 0.1"),
    ],
)
def test_times_that_are_none(engrane, pendulum, words, said):
    assert engrane("-q", pendulum, "-o", "part", "--until", "0.1").returncode == 2
    done = engrane(pendulum, "-o", "next", *words)
    assert done.returncode == 1
    assert said in done.stderr
    assert not list(engrane.folder.glob("next*"))


# \x93 is a quotation mark of Windows, and a control character of Latin-1
LATIN = """.UNIT SI
.TITRE "péndulo é"
.NOE
 I 1 X 0.5 0 0
.SEL
 GROUP 1 NOEUDS NOM "A\x93ñillo" I 1
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 0 AT 0 0 0
 I 2 INERTIA N 1 M 2 J 0.02
.CLM STRU ACC VAL 0 0 -9.81
.SAM TYPE DYNAMIC
.SUB TF 0.2 H 0.01
.CHK
 ELEMENT 1 ANGLE V 0 ATOL 10 REF "según García"
"""


def test_texts_of_a_deck_in_latin_1(engrane):
    """The file holds UTF-8, and restarts compare characters, not bytes."""
    (engrane.folder / "latin.dat").write_bytes(LATIN.encode("latin-1"))
    assert engrane("-q", "latin.dat", "-o", "whole").returncode == 0
    with h5py.File(engrane.folder / "whole.h5") as file:
        title = file.attrs.get_id("title")
        assert file.attrs["title"].encode("utf-8", "surrogateescape").decode() == "péndulo é", title.dtype
        deck = file["deck"][0].decode("utf-8")
        assert '"péndulo é"' in deck and '"A\x93ñillo"' in deck and "según García" in deck
    assert engrane("-q", "latin.dat", "--until", "0.1").returncode == 2
    assert engrane("-q", "latin.dat", "-o", "rest", "--restart", "latin").returncode == 0
    (engrane.folder / "utf8.dat").write_text(LATIN, encoding="utf-8")
    assert engrane("-q", "utf8.dat", "-o", "rest", "--restart", "latin").returncode == 0
    other = LATIN.replace("ñillo", "nillo").encode("latin-1")
    (engrane.folder / "other.dat").write_bytes(other)
    done = engrane("-q", "other.dat", "-o", "rest", "--restart", "latin")
    assert done.returncode == 1
    assert "is the result of another model" in done.stderr
