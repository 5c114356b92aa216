# SPDX-License-Identifier: BSD-3-Clause
"""Decks of strangers: what they say does not steer the terminal, and checking them runs no code of theirs."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
ESCAPES = ("\x1b]0;owned\x07", "\x1b[2J", "\x9b31m", "\xc2\x9b")


def is_plain(text: str) -> bool:
    return not any((c < " " and c not in "\n\t") or "\x7f" <= c <= "\x9f" for c in text)


def test_titles_do_not_steer_the_terminal(engrane, pendulum):
    text = (engrane.folder / pendulum).read_text()
    bad = "".join(ESCAPES[:2])
    deck = f'.TITRE "swing {bad}"\n' + text.replace("ATOL 1E-2", f'ATOL 1E-2 REF "{bad}"')
    deck = deck.replace(".CLM", f'.FCT\n I 1 NOM "{bad}" EXPR "1"\n.CLM')
    (engrane.folder / "bad.dat").write_text(deck)
    checked = engrane("check", "bad.dat")
    assert checked.returncode == 0
    assert "swing ?" in checked.stdout
    run = engrane("bad.dat", "--result", "NODE 1 UX")
    assert run.returncode == 0
    listing = (engrane.folder / "bad.lst").read_text()
    assert "swing ?" in listing
    shown = subprocess.run(
        [sys.executable, "-m", "engrane_post", "plot", "bad", "--list"],
        cwd=engrane.folder,
        env=os.environ | {"PYTHONPATH": str(ROOT / "post")},
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert "swing ?" in shown.stdout
    json = engrane("bad.dat", "--json", "-q")
    for text in (checked.stdout, run.stdout, run.stderr, listing, shown.stdout, json.stdout):
        assert is_plain(text), repr(text)


def test_formulas_do_not_steer_the_terminal(engrane):
    (engrane.folder / "bad.dat").write_bytes(
        b'.NOE\n I 1 X 0 0 0\n.FCT\n I 1 EXPR "\x1b[2J"\n I 2 EXPR "T + \xc2\x9b"\n.MCE\n I 1 WELD N 0 1\n'
    )
    done = engrane("check", "bad.dat")
    assert done.returncode == 1
    assert is_plain(done.stderr), repr(done.stderr)


LIBRARY = """
#include <stdio.h>
__attribute__((constructor)) static void leave_a_trace(void) {
  FILE* f = fopen("trace", "w");
  if (f) fclose(f);
}
void law(const int* version, const int* kind, const double* x, const double* p, const int* n_p, double* y,
         int* status) {
  y[0] = 2 * x[0]; y[1] = 2; y[2] = 0; y[3] = 0;
}
"""


@pytest.fixture
def library(engrane, pendulum):
    """A folder elsewhere with a library that leaves a trace as soon as it is loaded."""
    compiler = shutil.which("gcc") or shutil.which("cc")
    if not compiler:
        pytest.skip("no C compiler")
    elsewhere = engrane.folder / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "law.c").write_text(LIBRARY)
    subprocess.run([compiler, "-shared", "-fPIC", "law.c", "-o", "liblaw.so"], cwd=elsewhere, check=True)
    (engrane.folder / "mine").mkdir()
    text = (engrane.folder / pendulum).read_text()

    def deck(name: str) -> str:
        drive = f'.FCT\n I 1 USER "{name}" "law"\n.MCE\n I 7 TORQUE N 1 AXIS 0 1 0 V 1 NF 1\n.CLM'
        (engrane.folder / "mine/deck.dat").write_text(text.replace(".CLM", drive, 1))
        return "mine/deck.dat"

    return elsewhere / "liblaw.so", deck, engrane.folder / "trace"


def test_a_check_loads_nothing_from_elsewhere(engrane, library):
    file, deck, trace = library
    for name in (str(file), "../elsewhere/liblaw.so"):
        done = engrane("check", deck(name))
        assert done.returncode == 1
        assert "lies neither beside the deck nor in a folder of ENGRANE_USER_PATH" in done.stderr
        assert "--allow-user" in done.stderr
        assert not trace.exists()
    done = engrane("check", "--allow-user", deck(str(file)))
    assert done.returncode == 0, done.stderr
    assert f"user routines were loaded from {file}, and tried" in done.stdout
    assert trace.exists()


def test_a_link_beside_the_deck_leads_elsewhere(engrane, library):
    file, deck, trace = library
    (engrane.folder / "mine/liblaw.so").symlink_to(file)
    assert engrane("check", deck("liblaw.so")).returncode == 1
    assert not trace.exists()


def test_a_check_loads_what_lies_beside_the_deck(engrane, library):
    file, deck, trace = library
    shutil.copy(file, engrane.folder / "mine")
    done = engrane("check", deck("liblaw.so"))
    assert done.returncode == 0, done.stderr
    assert f"loaded from {engrane.folder}/mine/liblaw.so" in done.stdout
    trace.unlink()
    (engrane.folder / "mine/liblaw.so").unlink()
    named = os.environ | {"ENGRANE_USER_PATH": str(file.parent)}
    assert engrane("check", deck("liblaw.so"), env=named).returncode == 0, (
        "the user's own folders are trusted"
    )
    assert engrane("mine/deck.dat", "-q", env=named).returncode in (0, 4), "a run asks nobody"
