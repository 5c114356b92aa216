# SPDX-License-Identifier: BSD-3-Clause
"""Runs that were interrupted, killed or ended continue from their results. That every deck gives the bits of
the run that was not interrupted is a test of tests/decks.py; here are the rest of the promises."""

import os
import random
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import h5py
import numpy as np
import pytest
from engrane_post import Results
from ranks import on_ranks
from runs import Run, program
from small_decks import SQUARE

ROOT = Path(__file__).resolve().parents[2]

DECK = """.TITRE "chain of two on a motor"
.NOE
 I 1 X 0.5 0 0
 I 2 X 1.5 0 0
.MCE
 I 1 HINGE N 0 1  AXIS 0 0 1
 I 2 HINGE N 1 2  AXIS 0 0 1  AT 1 0 0  K 20 C 0.1
 I 3 INERTIA N 1  M 1 J 0.1 0.1 0.1
 I 4 INERTIA N 2  M 1 J 0.2 0.2 0.2
.FCT
 I 1 SINUS 1 2 0 0
.CLM
 CHA NOEUD 2 C 2 V 3 NF 1
 STRU ACC VAL 0 -9.81 0
.SAM TYPE DYNAMIC SOLVER {solver} {sam}
.SUB TF {end} H 0.001
.SAI FIELDS DT {frames} {sai}
.FIN 1
"""


def deck(folder: Path, name: str, end=1.0, solver="KLU", sam="", sai="", frames=0.05) -> Path:
    path = folder / f"{name}.dat"
    path.write_text(DECK.format(end=end, solver=solver, sam=sam, sai=sai, frames=frames), encoding="utf-8")
    return path


def run(folder: Path, *words: str, ranks: int = 1, status: int = 0) -> str:
    command = on_ranks(ranks, [program(), "-q", *words])
    ended = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300, check=False)
    assert ended.returncode == status, ended.stderr
    return ended.stderr


def tables(path: Path) -> dict[str, bytes]:
    found = {}

    def keep(name, item):
        if isinstance(item, h5py.Dataset) and name.startswith(("history/", "fields/")):
            found[name] = item[()].tobytes() if item.dtype.kind in "fiu" else repr(item[()]).encode()

    with h5py.File(path, "r") as file:
        file.visititems(keep)
    return found


@pytest.mark.parametrize("solver", ["MUMPS", "KLU", "UMFPACK", "SUPERLU"])
def test_bits_of_the_whole_run(tmp_path, solver):
    run(tmp_path, str(deck(tmp_path, "whole", end=0.3, solver=solver)))
    first = str(deck(tmp_path, "first", end=0.3, solver=solver))
    run(tmp_path, first, "--until", "0.1", status=2)
    run(tmp_path, first, "--restart", "first", "-o", "second", "--until", "0.11", status=2)
    run(tmp_path, str(deck(tmp_path, "third", end=0.3, solver=solver, sam='RESTART "second"')))
    assert tables(tmp_path / "whole.h5") == tables(tmp_path / "third.h5")


@pytest.mark.parametrize("solver", ["MUMPS", "KLU"])
def test_kept_factors_go_on_turning_with_their_nodes(tmp_path, solver):
    """The factors of a wind turbine's train turn with its shafts. The first solution behind a restart forgot
    it, and left a tenth of the residual in place of a hundred millionth."""
    text = (ROOT / "decks/trains/wind_turbine.dat").read_text(encoding="utf-8").split(".CHK")[0]
    text = text.replace("TANGENT KEPT", f"TANGENT KEPT SOLVER {solver}").replace("TF 5 ", "TF 0.72 ")
    (tmp_path / "whole.dat").write_text(text + ".FIN 1\n", encoding="utf-8")
    run(tmp_path, "whole.dat")
    run(tmp_path, "whole.dat", "-o", "part", "--until", "0.7", status=2)
    run(tmp_path, "whole.dat", "-o", "part", "--restart", "part")
    assert tables(tmp_path / "whole.h5") == tables(tmp_path / "part.h5")


@pytest.mark.parametrize("sam", ["", "TANGENT KEPT", "SCHEME RADAU"])
@pytest.mark.parametrize("solver", ["MUMPS", "KLU"])
def test_bits_of_the_whole_run_on_several_ranks(tmp_path, solver, sam):
    """Too few equations for ranks to solve them together: the first one's factors go on."""
    path = str(deck(tmp_path, "whole", end=0.04, solver=solver, sam=sam, frames=0.008))
    run(tmp_path, path, ranks=2)
    run(tmp_path, path, "-o", "part", "--until", "0.018", ranks=2, status=2)
    run(tmp_path, path, "-o", "part", "--restart", "part", ranks=2)
    assert tables(tmp_path / "whole.h5") == tables(tmp_path / "part.h5")


def test_points_that_the_deck_asks_for(tmp_path):
    run(tmp_path, str(deck(tmp_path, "whole", sai="RESTART DT 0.25")))
    run(tmp_path, str(deck(tmp_path, "again", sam='RESTART "whole" T 0.6', sai="RESTART DT 0.25")))
    assert tables(tmp_path / "whole.h5") == tables(tmp_path / "again.h5")
    assert "restarted from whole.h5 at t = 0.5" in (tmp_path / "again.lst").read_text(encoding="utf-8")
    message = run(tmp_path, str(deck(tmp_path, "early", sam='RESTART "whole" T 0.1')), status=1)
    assert "0.25" in message and "0.5" in message, "the times there are"


def test_a_longer_run_under_another_load(tmp_path):
    run(tmp_path, str(deck(tmp_path, "begin", end=0.2)))
    longer = deck(tmp_path, "longer", end=0.4, sam='RHO 0.9 RESTART "begin"')
    longer.write_text(longer.read_text(encoding="utf-8").replace("V 3 NF 1", "V 5 NF 1"), encoding="utf-8")
    run(tmp_path, str(longer))
    with Results(tmp_path / "begin.h5") as begin, Results(tmp_path / "longer.h5") as after:
        count = len(begin.times())
        assert after.times()[-1] == pytest.approx(0.4)
        assert np.array_equal(after.history("node/2/UY")[1][:count], begin.history("node/2/UY")[1])


def test_motion_from_an_equilibrium(tmp_path):
    """A static run, then the motion that a load at rest does not start: the equilibrium stays."""
    text = """.NOE
 I 1 X 1 0 0
.MCE
 I 1 SPRING N 0 1  K 100
 I 2 INERTIA N 1  M 2 J 1 1 1
.CLM
 FIX NOEUD 1 C 2 3 4 5 6
 CHA NOEUD 1 C 1 V 5
.SAM TYPE {sam}
.SUB TF {end} H 0.1
.FIN 1
"""
    (tmp_path / "rest.dat").write_text(text.format(sam="STATIC", end=1), encoding="utf-8")
    run(tmp_path, "rest.dat")
    (tmp_path / "move.dat").write_text(text.format(sam='DYNAMIC RESTART "rest"', end=3), encoding="utf-8")
    run(tmp_path, "move.dat")
    result = Run(tmp_path / "move.h5")
    assert result.t[-1] == pytest.approx(3)
    assert np.allclose(result["node/1/UX"][-20:], 0.05, atol=1e-9)


def test_the_dial_goes_on_from_an_equilibrium_in_space(tmp_path):
    """ACCURACY solves in the plane that the motion stays in; what it continues was solved in space."""
    text = deck(tmp_path, "rest").read_text(encoding="utf-8").replace("V 3 NF 1", "V 3")
    text = text.replace("N 0 1  AXIS 0 0 1", "N 0 1  AXIS 0 0 1 K 100 C 0.1")
    rest = text.replace("TYPE DYNAMIC", "TYPE STATIC").replace("H 0.001", "H 0.5")
    moves = text.replace("TYPE DYNAMIC", 'TYPE DYNAMIC ACCURACY FAST RESTART "rest"').replace("V 3", "V 4")
    (tmp_path / "rest.dat").write_text(rest, encoding="utf-8")
    (tmp_path / "moves.dat").write_text(moves.replace("TF 1.0", "TF 3"), encoding="utf-8")
    run(tmp_path, "rest.dat")
    assert "fails" not in run(tmp_path, "moves.dat")
    listing = " ".join((tmp_path / "moves.lst").read_text(encoding="utf-8").split())
    assert "solved in space" in listing and "estimated from t = 1 on" in listing


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("K 20 C 0.1", "K 30 C 0.1", ["HINGE 2: K was", "20", "30"]),
        (" I 4 INERTIA N 2  M 1 J 0.2 0.2 0.2\n", "", ["INERTIA 4 was there"]),
        ("I 2 X 1.5 0 0", "I 2 X 1.5 0 0\n I 3 X 0 0 0", [".NOE 3 is new"]),
    ],
)
def test_another_model_is_refused(tmp_path, old, new, words):
    run(tmp_path, str(deck(tmp_path, "begin", end=0.1)))
    other = deck(tmp_path, "other", end=0.2, sam='RESTART "begin"')
    other.write_text(other.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    message = run(tmp_path, str(other), status=1)
    assert all(word in message for word in words), message
    assert not (tmp_path / "other.h5").exists()


CELL = (
    SQUARE
    + """\
.SEL
 GROUP 1 NOM "top" FACES
  I 1 3
.MAT
 I 1 YT 100. NT 0.3 A 1E-3
.HYP DEFO PLAN
.AEL
 I 1 MAT 1
.CLM
 NOEUD 1 FIX C 1 2
 NOEUD 4 FIX C 1
 ARETE I {face} PRE V {edge}
 GROUP "top" PRE V {top}
 TEMP NOEUD 1 2 3 4 V {warmth}
.SAM TYPE STATIC {sam}
.SUB TF {end} H 0.5
.FIN 1
"""
)


def test_pressures_and_temperatures_may_change(tmp_path):
    """The equilibrium at the end is that of a run that had them from the start."""
    before = {"face": "1 2", "edge": 2, "top": 1, "warmth": 30, "sam": "", "end": 1}
    after = before | {"edge": 2.5, "top": 0.5, "warmth": 80, "end": 2}
    again = after | {"sam": 'RESTART "first"'}
    for name, values in (("first", before), ("fresh", after), ("rest", again)):
        (tmp_path / f"{name}.dat").write_text(CELL.format(**values), encoding="utf-8")
        run(tmp_path, f"{name}.dat")
    fresh, rest = Run(tmp_path / "fresh.h5"), Run(tmp_path / "rest.h5")
    for channel in ("node/3/UX", "node/3/UY"):
        expected = fresh[channel][-1]
        assert abs(expected) > 1e-3
        assert rest[channel][-1] == pytest.approx(expected, rel=1e-10)
    wild = after | {"edge": 5, "top": -3}  # too far for Newton's iteration from the earlier equilibrium
    for name, sam in (("wild", 'RESTART "first"'), ("near", "")):
        (tmp_path / f"{name}.dat").write_text(CELL.format(**wild | {"sam": sam}), encoding="utf-8")
        run(tmp_path, f"{name}.dat")
    near, far = (Run(tmp_path / f"{name}.h5")["node/3/UY"][-1] for name in ("near", "wild"))
    assert far == pytest.approx(near, rel=1e-8)


def test_a_cell_that_is_pressed_flat(tmp_path):
    flat = CELL.format(face="1 2", edge=0, top=0, warmth=0, sam="", end=1)
    flat = flat.replace(".CLM\n", '.FCT\n I 1 EXPR "T"\n.CLM\n DEP NOEUD 3 4 C 2 V -1.2 NF 1\n')
    (tmp_path / "flat.dat").write_text(flat, encoding="utf-8")
    assert "cell 1 is turned inside out" in run(tmp_path, "flat.dat", status=2)


PENDULUM = """.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
.FCT
 I 1 EXPR "{drive}"
 I 2 EXPR "20*max(T-0.5,0)"
.MCE
 I 1 RIGID N 1 2  M 1 J 1 CG 0.5 0 0
 I 2 HINGE N 0 1  AXIS 0 0 1  {joint}
 I 3 FORCE N 2  DIR 0 -1 0  V 10
.CLM
 STRU ACC VAL 0 -10 0
{load}.SAM TYPE {sam}
.SUB TF {end} H 0.01 {tol}
.FIN 1
"""
SPRING, DRIVEN = "K 100 C 0.1", "DRIVE ANGLE NF 1"


def pendulum(
    folder: Path, name: str, sam: str, joint=SPRING, drive="sin(3*T)", load="", tol="", end=1.0
) -> str:
    text = PENDULUM.format(drive=drive, joint=joint, load=load, sam=sam, tol=tol, end=end)
    (folder / f"{name}.dat").write_text(text, encoding="utf-8")
    return f"{name}.dat"


def test_a_kinematic_run_does_not_take_over_free_motions(tmp_path):
    """Without RESTART the deck is refused. The motion went on, with status 0."""
    run(tmp_path, pendulum(tmp_path, "swings", "DYNAMIC"), "--until", "0.5", status=2)
    alone = run(tmp_path, pendulum(tmp_path, "alone", "KINEMATIC"), status=2)
    message = run(tmp_path, pendulum(tmp_path, "goes_on", 'KINEMATIC RESTART "swings"'), status=2)
    for text in (alone, message):
        assert "a KINEMATIC analysis needs drives that leave no freedom, but 1 motion is free" in text


@pytest.mark.parametrize("after", ["DYNAMIC", "KINEMATIC"])
@pytest.mark.parametrize("before", ["DYNAMIC", "KINEMATIC"])
def test_a_driven_motion_goes_on_in_another_analysis(tmp_path, before, after):
    run(tmp_path, pendulum(tmp_path, "whole", "KINEMATIC", DRIVEN))
    run(tmp_path, pendulum(tmp_path, "first", before, DRIVEN), "--until", "0.5", status=2)
    run(tmp_path, pendulum(tmp_path, "second", f'{after} RESTART "first"', DRIVEN))
    expected, found = (Run(tmp_path / f"{name}.h5")["2/ANGLE"] for name in ("whole", "second"))
    assert np.allclose(found, expected, atol=1e-9)


@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize(
    ("sam", "tol"), [("", ""), ("SCHEME RADAU", ""), ("TANGENT KEPT", ""), ("SCHEME RADAU", "TOL 1E-6")]
)
def test_loads_on_nodes_come_and_go(tmp_path, sam, tol, ranks):
    """The load is zero before the restart, so that the whole run has it from the start. Newton's memory was
    one of so many elements: "the restart point has another number of nodes". Fixed steps meet the restart
    point of the whole run; controlled ones need a run that ends there."""
    added = " CHA NOEUD 2 C 2 V 3 NF 2\n CHA NOEUD 1 C 1 V 1 NF 2\n"
    part = "_part" if tol else ""

    def make(name, load, restart="", end=0.7):
        restart = f' RESTART "{restart}{part}" T 0.5' if restart else ""
        path = tmp_path / pendulum(tmp_path, name, f"DYNAMIC {sam}{restart}", load=load, tol=tol, end=end)
        path.write_text(path.read_text(encoding="utf-8").replace(".FIN", ".SAI RESTART DT 0.5\n.FIN"))
        return path.name

    for load, name in (("", "free"), (added, "loaded")):
        run(tmp_path, make(name, load), ranks=ranks)
        if part:
            run(tmp_path, make(f"{name}{part}", load, end=0.5), ranks=ranks)
    run(tmp_path, make("put_on", added, "free"), ranks=ranks)
    run(tmp_path, make("taken_off", "", "loaded"), ranks=ranks)
    run(tmp_path, make("same", added, "loaded"), ranks=ranks)
    assert "at t = 0.5" in (tmp_path / "same.lst").read_text(encoding="utf-8")
    if not tol:  # the last of controlled steps is cut to the end of the first part
        assert tables(tmp_path / "same.h5") == tables(tmp_path / "loaded.h5")

    def last(name):
        return Run(tmp_path / f"{name}.h5")["2/ANGLE"][-1]

    assert abs(last("free") - last("loaded")) > 1e-3
    near = 1e-5 if tol else 1e-9
    assert last("put_on") == pytest.approx(last("loaded"), rel=near)
    assert last("taken_off") == pytest.approx(last("free"), rel=near)


SLIDER = """.NOE
 I 1 X 0 0 0
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 K 100 {law}
 I 2 INERTIA N 1 M 2 J 0.02
.CLM
 CHA NOEUD 1 C 1 V 5
 CHA NOEUD 1 C 1 V 30 NF 1
.FCT
 I 1 TABLE 0 0 1 0 1.5 1
.SAM TYPE {sam}
.SUB TF {end} H 0.01 {tol}
.FIN 1
"""


@pytest.mark.parametrize(
    ("law", "before", "end"),
    [
        ("MAX 0.2 KSTOP 1D5", "STATIC", 1),
        ("MAX 0.2 KSTOP 1D5", "DYNAMIC EVENTS NO", 0.5),
        ("FRICTION CONST 0.1 VREG 1D-3 PRELOAD 5", "DYNAMIC", 0.5),  # fixed steps take no notice of VREG
    ],
)
def test_events_behind_a_run_that_located_none(tmp_path, law, before, end):
    """It was a segmentation fault: the switches there had neither sides nor values. The first change behind
    the restart point is an event as any other."""
    (tmp_path / "before.dat").write_text(SLIDER.format(law=law, sam=before, end=end, tol=""))
    run(tmp_path, "before.dat")
    for scheme in ("CHUNG", "RADAU"):
        sam = f'DYNAMIC SCHEME {scheme} RESTART "before"'
        (tmp_path / "then.dat").write_text(SLIDER.format(law=law, sam=sam, end=2, tol="TOL 1E-5"))
        run(tmp_path, "then.dat")
        result = Run(tmp_path / "then.h5")
        assert result.t[-1] == 2
        assert max(result["run/EVENTS"]) >= 1


def test_events_that_the_listing_leaves_out(tmp_path):
    """Those listed before the restart point counted as listed behind it."""
    law = "MAX 0.01 MIN -0.01 KSTOP 1D5"
    text = SLIDER.format(law=law, sam="DYNAMIC SCHEME RADAU", end=2, tol="TOL 1E-4").replace("K 100", "K 0")
    (tmp_path / "stops.dat").write_text(
        text.replace("V 5", "V 0").replace(".SAM", ".INI\n VIT NOEUD 1 C 1 V 2\n.SAM")
    )
    run(tmp_path, "stops.dat", "--until", "0.9", status=2)
    run(tmp_path, "stops.dat", "--restart", "stops", "-o", "stops")
    section = (tmp_path / "stops.lst").read_text(encoding="utf-8").split("Events")[-1]
    total = int(re.search(r"(\d+) in all", section)[1])
    more = int(re.search(r"and (\d+) more", section)[1])
    assert total > 110
    assert section.count("  t = ") == total - more
    assert section.count("  t = ") > 10


@pytest.mark.parametrize("after", ["DYNAMIC", "DYNAMIC ACCURACY FAST", "KINEMATIC"])
def test_a_drive_that_jumps_is_refused_by_name(tmp_path, after):
    """It ended with "the energy balance is off by 994 … Take a smaller step H"; KINEMATIC with status 0."""
    run(tmp_path, pendulum(tmp_path, "first", "KINEMATIC", DRIVEN), "--until", "0.5", status=2)
    sam = f'{after} RESTART "first"'
    message = run(tmp_path, pendulum(tmp_path, "jumps", sam, DRIVEN, "sin(3*T)+0.2"), status=2)
    assert "HINGE 2 stands at 0.997495 rad and its drive asks for 1.19749 rad at t = 0.5" in message
    assert "energy" not in message and "again" not in message
    smooth = "sin(1.5)+3*cos(1.5)*(T-0.5)"
    run(tmp_path, pendulum(tmp_path, "smooth", sam.replace(" ACCURACY FAST", ""), DRIVEN, smooth))


def test_in_statics_a_jump_is_one_more_load_step(tmp_path):
    run(tmp_path, pendulum(tmp_path, "first", "STATIC", DRIVEN), "--until", "0.5", status=2)
    run(tmp_path, pendulum(tmp_path, "jumps", 'STATIC RESTART "first"', DRIVEN, "sin(3*T)+0.2"))
    assert Run(tmp_path / "jumps.h5")["2/ANGLE"][-1] == pytest.approx(np.sin(3) + 0.2, abs=1e-9)


CARRIAGE = """.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
 I 3 X 0 0 1
.FCT
 I 1 EXPR "{slide}"
 I 2 EXPR "{speed}"
 I 3 EXPR "{support}"
.MCE
 I 1 RIGID N 1 2  M 1 J 1 CG 0.5 0 0
 I 2 CYLINDRICAL N 0 1  AXIS 0 0 1  DRIVE SLIDE NF 1  TURN SPEED NFT 2
 I 3 INERTIA N 3  M 1 J 1 1 1
.CLM
 DEP NOEUD 3 C 1 V 1 NF 3
 FIX NOEUD 3 C 2 3 4 5 6
.SAM TYPE DYNAMIC {restart}
.SUB TF 1 H 0.01
.FIN 1
"""


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"slide": "T+0.3"}, "CYLINDRICAL 2 stands at 0.5 [length] and its drive asks for 0.8 [length]"),
        ({"speed": "30"}, "CYLINDRICAL 2 stands at 10 rad and its drive asks for 15 rad"),
        (
            {"support": "2*T"},
            "support of node 3 (x) stands at 0.5 [length] and its function asks for 1 [length]",
        ),
        ({"speed": "20+5*max(T-0.5,0)"}, ""),
    ],
)
def test_other_motions_that_jump(tmp_path, change, words):
    functions = {"slide": "T", "speed": "20", "support": "T"}
    (tmp_path / "first.dat").write_text(CARRIAGE.format(restart="", **functions), encoding="utf-8")
    run(tmp_path, "first.dat", "--until", "0.5", status=2)
    text = CARRIAGE.format(restart='RESTART "first"', **functions | change)
    (tmp_path / "then.dat").write_text(text, encoding="utf-8")
    assert words in run(tmp_path, "then.dat", status=2 if words else 0)


def test_elements_that_are_loads_belong_to_the_model(tmp_path):
    run(tmp_path, pendulum(tmp_path, "first", "DYNAMIC"), "--until", "0.5", status=2)
    then = tmp_path / pendulum(tmp_path, "then", 'DYNAMIC RESTART "first"')
    text = then.read_text(encoding="utf-8")
    then.write_text(text.replace(".CLM\n", " I 4 FORCE N 1  DIR 1 0 0  V 1\n.CLM\n", 1), encoding="utf-8")
    message = run(tmp_path, "then.dat", status=1)
    assert "FORCE 4 is new" in message and "only loads of .CLM may come and go" in message
    then.write_text(text.replace("DIR 0 -1 0  V 10", "DIR 0 -1 0  V 20"), encoding="utf-8")
    run(tmp_path, "then.dat")


def test_initial_values_beside_a_restart(tmp_path):
    """They were left out without a word, even those that must hold."""
    run(tmp_path, pendulum(tmp_path, "first", "DYNAMIC"), "--until", "0.5", status=2)
    for record, status, words in (
        (
            "VIT ELEMENT 2 V 3 IMPOSED",
            1,
            "error: the state comes from the restart point (.SAM RESTART), and .INI VIT cannot",
        ),
        (
            "VIT ELEMENT 2 V 3",
            0,
            "warning: the state comes from the restart point (.SAM RESTART), and .INI VIT has no",
        ),
        (
            "DEP NOEUD 2 C 1 V 0.1",
            0,
            "warning: the state comes from the restart point (.SAM RESTART), and .INI DEP has",
        ),
    ):
        deck_name = pendulum(tmp_path, "then", 'DYNAMIC RESTART "first"', load=f".INI\n {record}\n")
        assert f"then.dat:14:{20 if status else 2}: {words}" in run(tmp_path, deck_name, status=status)
    # the same deck goes on as it began
    same = pendulum(tmp_path, "same", "DYNAMIC", load=".INI\n VIT ELEMENT 2 V 3 IMPOSED\n")
    run(tmp_path, same, "--until", "0.5", status=2)
    assert run(tmp_path, same, "--restart", "same") == ""


def test_a_run_interrupted_beside_a_complete_result_goes_on(tmp_path):
    path = str(deck(tmp_path, "run", end=0.5))
    run(tmp_path, path)
    whole = tables(tmp_path / "run.h5")
    run(tmp_path, path, "--until", "0.2", status=2)
    message = run(tmp_path, path, "--restart", "run", status=1)
    assert "run.h5 would be continued from t = 0.5, but .SUB ends at TF = 0.5" in message
    assert "newer run.partial.h5" in message and "from t = 0.2: --restart run.partial" in message
    run(tmp_path, path, "--restart", "run.partial")
    assert tables(tmp_path / "run.h5") == whole
    assert not (tmp_path / "run.partial.h5").exists()


def test_a_file_of_another_version_is_refused(tmp_path):
    run(tmp_path, str(deck(tmp_path, "begin", end=0.1)))
    with h5py.File(tmp_path / "begin.h5", "r+") as file:
        file.attrs["format_version"] = 1
    message = run(tmp_path, str(deck(tmp_path, "other", end=0.2, sam='RESTART "begin"')), status=1)
    assert "version 1" in message
    assert "no" in run(tmp_path, str(deck(tmp_path, "none", sam='RESTART "nothing"')), status=1)


@pytest.mark.parametrize("solver", ["MUMPS", "KLU"])
def test_other_numbers_of_ranks(tmp_path, solver):
    whole = str(deck(tmp_path, "whole", end=0.3, solver=solver))
    run(tmp_path, whole)
    run(tmp_path, whole, "-o", "a", "--until", "0.1", status=2)
    run(tmp_path, whole, "-o", "b", "--restart", "a", "--until", "0.2", ranks=3, status=2)
    run(tmp_path, whole, "-o", "c", "--restart", "b", ranks=2)
    one, other = Run(tmp_path / "whole.h5"), Run(tmp_path / "c.h5")
    for channel in ("node/2/UX", "node/2/UY", "node/2/VX", "element/2/ANGLE"):
        a, b = one[channel], other[channel]
        assert np.max(np.abs(a - b)) <= 1e-10 * np.max(np.abs(a)), channel


def test_kills_lose_nothing(tmp_path):
    """ENGRANE_KILLS=100 for the whole of it: killed at a random instant, continued, killed again."""
    kills = int(os.environ.get("ENGRANE_KILLS", "6"))
    end = 1e5  # never reached
    path = str(deck(tmp_path, "killed", end=end, frames=1))
    dice = random.Random(7)
    reached = 0.0
    name = "run0"
    done = 0
    for kill in range(1, kills + 1):
        words = ["--restart", name] if kill > 1 else []
        name, before = f"run{kill}", name
        process = subprocess.Popen([program(), "-q", path, "-o", name, *words], cwd=tmp_path)
        time.sleep(dice.uniform(0.4, 2.0))
        process.send_signal(signal.SIGKILL)
        if process.wait() == 0:
            break
        done = kill
        file = tmp_path / f"{name}.h5"
        point = 0.0
        if file.exists():
            with h5py.File(file, "r") as results:
                if "restart/latest" in results:
                    point = float(results["restart/latest"].attrs["time"])
        assert point >= reached or point == 0.0
        if point == 0.0:  # killed before its first batch: the earlier results are still there
            if kill == 1:
                run(tmp_path, path, "-o", name, "--until", "0.001", status=2)
            else:
                shutil.copy(tmp_path / f"{before}.h5", file)
        reached = max(reached, point)
    assert done > 0
    last = reached + 0.5
    whole = str(deck(tmp_path, "whole", end=end, frames=1))
    run(tmp_path, whole, "--until", repr(last), status=2)
    run(tmp_path, path, "-o", "ended", "--restart", name, "--until", repr(last), status=2)
    assert tables(tmp_path / "whole.h5") == tables(tmp_path / "ended.h5")


def unbegun(path: Path) -> None:
    """The file as it is made before the first batch, which is what is left of a run that was killed then."""
    with h5py.File(path, "r+") as file:
        file.attrs["status"] = "running"
        for name in list(file["restart"]):
            del file[f"restart/{name}"]
        times = file["history/time"]
        times.resize((0, *times.shape[1:]))


def test_a_run_killed_before_its_first_restart_point_begins_again(tmp_path):
    """A chain of jobs says --restart when there is a file; all jobs after such a kill failed."""
    path = str(deck(tmp_path, "chain", end=0.2))
    run(tmp_path, path, "-o", "whole")
    for ranks in (1, 2):
        run(tmp_path, path, "-o", "chain", "--until", "0.05", status=2)
        unbegun(tmp_path / "chain.h5")
        said = run(tmp_path, path, "-o", "chain", "--restart", "chain", ranks=ranks)
        assert said == "engrane: chain.h5 holds no restart point yet: starting from the beginning\n"
        if ranks == 1:
            assert tables(tmp_path / "whole.h5") == tables(tmp_path / "chain.h5")
        (tmp_path / "chain.h5").unlink()


def test_a_continuation_killed_before_its_first_restart_point_begins_again(tmp_path):
    """The deck itself continues another result: so does the run that begins again."""
    run(tmp_path, str(deck(tmp_path, "first", end=0.1)))
    path = str(deck(tmp_path, "then", end=0.2, sam='RESTART "first"'))
    run(tmp_path, path)
    whole = tables(tmp_path / "then.h5")
    unbegun(tmp_path / "then.h5")
    said = run(tmp_path, path, "--restart", "then")
    assert "then.h5 holds no restart point yet: starting from first, as the deck says" in said
    assert tables(tmp_path / "then.h5") == whole


def test_only_a_run_of_the_same_deck_begins_again(tmp_path):
    """A result without restart points that another analysis was to continue is no reason to leave it out."""
    path = str(deck(tmp_path, "first", end=0.1))
    run(tmp_path, path)
    unbegun(tmp_path / "first.h5")
    longer = str(deck(tmp_path, "longer", end=0.2))
    advice = "it holds no restart point. Without --restart or RESTART the run starts from the beginning"
    assert advice in run(tmp_path, longer, "--restart", "first", status=1)
    assert advice in run(tmp_path, path, "-o", "next", "--restart", "first", "--restart-at", "0.05", status=1)
    assert advice in run(tmp_path, str(deck(tmp_path, "named", end=0.1, sam='RESTART "first"')), status=1)
    with h5py.File(tmp_path / "first.h5", "r+") as file:
        file.attrs["status"] = "failed"
    assert advice in run(tmp_path, path, "-o", "next", "--restart", "first", status=1)
