# SPDX-License-Identifier: BSD-3-Clause
"""`engrane sweep`, with the program itself."""

from __future__ import annotations

import csv
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from engrane_post.errors import UserError
from engrane_post.sweep import combinations, values_of
from small_decks import PENDULUM

POST = Path(__file__).resolve().parents[2] / "post"


@pytest.fixture
def deck(tmp_path: Path, monkeypatch) -> Path:
    if not Path(os.environ.get("ENGRANE", "")).is_file():
        pytest.skip("the variable ENGRANE names no program")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pendulum.dat").write_text(PENDULUM.replace("TF 0.2", "TF 0.05"))
    return tmp_path / "pendulum.dat"


def table(path: Path) -> list[dict[str, str]]:
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_values() -> None:
    assert values_of("A=1:3:1") == ("A", ["1", "2", "3"])
    assert values_of("/A=0.1:0.5:0.1") == ("A", ["0.1", "0.2", "0.3", "0.4", "0.5"])
    assert values_of("A=1D3:0:-5e2") == ("A", ["1000", "500", "0"])
    assert values_of("A=1,2.5, 4") == ("A", ["1", "2.5", "4"])
    assert values_of("A=(max(1,2))") == ("A", ["(max(1,2))"])
    assert [v.title for v in combinations(["A=1,2", "B=x,y"])] == [
        "A = 1, B = x",
        "A = 1, B = y",
        "A = 2, B = x",
        "A = 2, B = y",
    ]
    for wrong in ("A", "=1", "A=", "A=1:2", "A=1:2:x", "A=1:2:-1", "A=1:2:0", "A=0:1:1e-9"):
        with pytest.raises(UserError):
            values_of(wrong)
    for wrong, place in (("A=0.1,,0.3", 2), ("A=1,2,", 3), ("A=,", 1)):
        with pytest.raises(UserError, match=f"value {place} of the list is empty"):
            values_of(wrong)
    with pytest.raises(UserError, match="twice"):
        combinations(["A=1", "A=2"])
    with pytest.raises(UserError, match="most"):
        combinations(["A=1:1000:1", "B=1:1000:1"])


def test_table_and_diagram(deck: Path, command) -> None:
    words = ("-D", "L=0.1:0.3:0.1", "-D", "M=1,2", "--result", "NODE 1 EY MAX WINDOW 0 0.01", "-j", "2")
    status, out, err = command("sweep", deck, *words)
    assert (status, err) == (0, "")
    assert out == "wrote pendulum_sweep.csv\nwrote pendulum_sweep.png\n"
    rows = table(Path("pendulum_sweep.csv"))
    assert [(r["L"], r["M"]) for r in rows] == [(x, m) for x in ("0.1", "0.2", "0.3") for m in ("1", "2")]
    for row in rows:
        length = float(row["L"])
        value = float(row["MAX of NODE 1 EY from t = 0 to 0.01"])
        assert value == pytest.approx(9.81 * length / (length**2 + 0.01), rel=1e-3)
        assert row["outcome"] == "complete"
    assert Path("pendulum_sweep.png").read_bytes()[:4] == b"\x89PNG"
    assert not list(deck.parent.glob("**/*.h5")), "runs leave nothing unless they are kept"


def test_cards_replace_those_of_the_deck(deck: Path, command) -> None:
    words = ("-D", "L=0.2,0.4", "--result", "RUN STEP", "--keep", "runs")
    card = ("--card", ".SUB TF 0.05 H 0.0025", "--card", ".SAM TYPE DYNAMIC SCHEME RADAU")
    assert command("sweep", deck, *words, *card)[0] == 0
    steps = [float(row["RUN STEP at the end"]) for row in table(Path("pendulum_sweep.csv"))]
    assert steps == pytest.approx([0.0025, 0.0025])
    assert "RADAU" in Path("runs/1.lst").read_text()
    status, _, err = command("sweep", deck, *words)
    assert status == 1 and "results of another sweep" in err, "other cards make another sweep"
    status, _, err = command("sweep", deck, *words[:4], "--card", ".SUB TF 1")
    assert status == 1 and ".SUB lacks H" in err


def test_checks_are_the_results_and_runs_are_kept(deck: Path, command) -> None:
    status, _, _ = command("sweep", "pendulum", "-D", "L=0.2,0.4", "--keep", "runs", "-o", "table.csv")
    assert status == 0
    assert sorted(p.name for p in Path("runs").glob("*.h5")) == ["1.h5", "2.h5"]
    assert (
        len([r for r in table(Path("table.csv")) if abs(float(r["RUN ENERGY_ERROR at the end"])) < 1e-3]) == 2
    )


def test_the_table_names_the_kept_files(deck: Path, command) -> None:
    words = ("-D", "M=1,-1,2", "--result", "NODE 1 VZ MIN", "--keep", "runs")
    command("sweep", deck, *words)
    rows = table(Path("pendulum_sweep.csv"))
    assert [r["file"] for r in rows] == ["runs/1.h5", "", "runs/3.h5"], "a wrong deck has no results"
    assert all(Path(r["file"]).is_file() for r in rows if r["file"])
    command("sweep", deck, *words[:-2])
    assert "file" not in table(Path("pendulum_sweep.csv"))[0]


def test_sweeps_are_not_mixed_in_a_folder(deck: Path, command) -> None:
    more = ("--result", "NODE 1 VZ MIN", "--keep", "runs")
    assert command("sweep", deck, "-D", "L=0.1,0.2", *more)[0] == 0
    kept = {p.name: p.read_bytes() for p in Path("runs").iterdir()}
    for values in ("L=0.1:1:0.1", "L=0.1,0.3"):
        status, _, err = command("sweep", deck, "-D", values, *more)
        assert status == 1
        assert "--keep runs: the folder holds results of another sweep, 1.h5 for one." in err
        assert {p.name: p.read_bytes() for p in Path("runs").iterdir()} == kept
    other = deck.with_name("other.dat")
    other.write_text(deck.read_text())
    assert command("sweep", other, "-D", "L=0.1,0.2", *more)[0] == 1
    # the same again, as after it was stopped
    assert command("sweep", deck, "-D", "L=0.1,0.2", *more)[0] == 0
    # results of earlier versions have no record of their sweep
    Path("runs/sweep.json").unlink()
    assert command("sweep", deck, "-D", "L=0.1,0.2", *more)[0] == 1


def test_a_folder_with_other_files_or_a_wrong_command_is_free(deck: Path, command) -> None:
    Path("runs").mkdir()
    Path("runs/notes.txt").write_text("mine")
    more = ("--result", "NODE 1 VZ MIN", "--keep", "runs")
    assert command("sweep", deck, "-D", "LENGTH=0.1,0.2", *more)[0] == 1
    status, _, err = command("sweep", deck, "-D", "L=0.1,0.2", *more)
    assert (status, err) == (0, "")
    assert Path("runs/notes.txt").read_text() == "mine"


def test_a_run_without_a_summary_has_failed(deck: Path, command, monkeypatch) -> None:
    """As when a user routine ends the program with status 0."""
    program = deck.parent / "engrane"
    program.write_text("#!/bin/sh\nexit 0\n")
    program.chmod(0o755)
    monkeypatch.setenv("ENGRANE", str(program))
    status, _, err = command("sweep", deck, "-D", "L=1,2", "--result", "NODE 1 VZ MIN")
    assert status == 1
    assert "no variant was solved. L = 1:\nthe program ended early and said nothing" in err
    assert "Name a number by --result" not in err
    assert not list(deck.parent.glob("*.csv"))


def test_a_variant_that_fails_leaves_a_gap(deck: Path, command) -> None:
    status, _, err = command("sweep", deck, "-D", "M=1,-1,x", "--result", "NODE 1 VZ MIN")
    assert status == 1, "two of the decks are wrong"
    assert "M = -1: " in err and "2 of 3 variants have no result" in err
    rows = table(Path("pendulum_sweep.csv"))
    assert [r["outcome"] for r in rows] == ["complete", "wrong deck", "wrong deck"]
    assert [bool(r["MIN of NODE 1 VZ"]) for r in rows] == [True, False, False]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("-D", "LENGTH=1,2"), "has no abbreviation `/LENGTH`"),
        (("-D", "L=1,2", "--result", "NODE 9 UX"), "there is no node 9"),
        (("-D", "M=-1,-2"), "no variant was solved. M = -1:"),
        (("-D", "L=1", "-o", "nowhere/x"), "there is no folder nowhere"),
    ],
)
def test_wrong_commands(deck: Path, command, words, sentence) -> None:
    status, _, err = command("sweep", deck, *words)
    assert status == 1
    assert sentence in err
    assert not list(deck.parent.glob("*.csv"))


def test_a_deck_that_is_not_there(deck: Path, command) -> None:
    status, _, err = command("sweep", "other", "-D", "A=1")
    assert (status, "There is no deck other" in err) == (1, True)


@pytest.mark.parametrize(("how", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_stopped_by_a_signal(deck: Path, how: signal.Signals, status: int, monkeypatch) -> None:
    """Variants that are finished are in the table; nothing is left running or lying about."""
    text = deck.read_text().replace("TF 0.05", "TF /TF").replace("ABRE", "ABRE '/TF' '0.05'\nABRE", 1)
    deck.write_text(text)
    temporary = deck.parent / "temporary"
    temporary.mkdir()
    words = ["sweep", str(deck), "-D", "TF=0.05,1E5,1E6", "--result", "NODE 1 VZ MIN", "-j", "2"]
    process = subprocess.Popen(
        [sys.executable, "-m", "engrane_post", *words],
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"TMPDIR": str(temporary), "PYTHONPATH": str(POST)},
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    until = time.monotonic() + 60
    while time.monotonic() < until and not list(temporary.glob("engrane_runs*/3.h5")):
        time.sleep(0.1)
    process.send_signal(how)
    _, err = process.communicate(timeout=60)
    assert process.returncode == status
    assert err == "engrane sweep: stopped after 1 of 3 variants; wrote pendulum_sweep.csv\n"
    rows = table(Path("pendulum_sweep.csv"))
    assert [r["outcome"] for r in rows] == ["complete", "not run", "not run"]
    assert [bool(r["MIN of NODE 1 VZ"]) for r in rows] == [True, False, False]
    assert not list(temporary.iterdir())
