# SPDX-License-Identifier: BSD-3-Clause
"""What the listing counts up, against sums by hand and the results themselves."""

import json
import re

import h5py
import numpy as np
import pytest
from engrane_post import Results

TWO_BODIES = """.UNIT SI
.NOE
 I 1 X 1 0 0
 I 2 X 0 2 0
.MCE
 I 1 INERTIA N 1 M 2 J 0.1
 I 2 INERTIA N 2 M 3 J 0.2
 I 3 HINGE N 0 1 AXIS 0 1 0 AT 0 0 0
 I 4 SPRING N 0 2 K 40 AT 0 0 0
.CLM STRU ACC VAL 0 0 -9.81
.SAM TYPE DYNAMIC
.SUB TF 0.5 H 0.01
"""


def section(text: str, title: str) -> list[list[str]]:
    """Rows of a table of the listing, cells apart."""
    body = re.split(r"\n\n[A-Z][^\n]*\n=+\n", text.split(f"\n{title}\n", 1)[1])[0]
    return [re.split(r"\s{2,}", line.strip()) for line in body.splitlines()]


@pytest.fixture
def run(engrane):
    (engrane.folder / "two.dat").write_text(TWO_BODIES)
    done = engrane("two.dat")
    assert done.returncode == 0, done.stderr
    return done.stdout, (engrane.folder / "two.lst").read_text(), engrane.folder / "two.h5"


def test_masses(run, engrane):
    assert "all                5           0.4  1.2  0" in engrane("check", "two.dat").stdout
    rows = {row[0]: row[1:] for row in section(run[1], "Masses")}
    assert [float(x) for x in rows["INERTIA 1"]] == pytest.approx([2, 1, 0, 0, 0.1, 0.1, 0.1, 0, 0, 0])
    assert [float(x) for x in rows["INERTIA 2"]] == pytest.approx([3, 0, 2, 0, 0.2, 0.2, 0.2, 0, 0, 0])
    # two masses of 2 and 3 at the distance (-1, 2, 0): the reduced mass 6/5 turns with it
    expected = [5, 0.4, 1.2, 0, 0.3 + 1.2 * 4, 0.3 + 1.2, 0.3 + 1.2 * 5, 1.2 * 2, 0, 0]
    assert [float(x) for x in rows["all"]] == pytest.approx(expected)


def test_peaks(run):
    rows = section(run[1], "Peaks")
    owner, found = "", {}
    for row in rows:
        if re.fullmatch(r"[A-Z_]+ \d+|run", row[0]):
            owner, row = row[0], row[1:]
        if owner and len(row) >= 3:
            found[owner, row[0]] = (float(row[1]), float(row[-1]))
    with h5py.File(run[2]) as file:
        times = file["history/time"][()]
        values = file["history/element/HINGE/values"][()]
        names = [name.decode() for name in file["history/element/HINGE/channels"][()]]
    for name in ("SPEED", "FORCE_X", "FORCE_Z"):
        column = values[:, names.index(name)]
        at = np.argmax(np.abs(column))
        value, time = found["HINGE 3", name]
        # between samples cubics may rise a little above them
        assert abs(time - times[at]) <= times[1] - times[0]
        assert value == pytest.approx(column[at], rel=1e-3, abs=1e-12)
        assert abs(value) > abs(column[at]) * (1 - 1e-5)
    assert ("run", "GROUND_FORCE_Z") in found


def test_ground(run):
    rows = section(run[1], "Forces of the ground")
    assert [row[0] for row in rows if row[0].startswith(("at", "with"))] == [
        "at the end",
        "with the largest force",
        "with the largest moment",
    ]
    # what the ground exerts is what accelerates the masses, but for their weight
    with Results(run[2]) as results:

        def last(channel: str) -> float:
            return results.history(channel)[1][-1]

        for axis, weight in zip("XYZ", (0, 0, 5 * 9.81), strict=True):
            expected = 2 * last(f"node/1/A{axis}") + 3 * last(f"node/2/A{axis}") + weight
            assert last(f"run/GROUND_FORCE_{axis}") == pytest.approx(expected, abs=1e-6)


def test_a_restarted_run_lists_what_the_whole_run_does(run, engrane):
    assert engrane("two.dat", "-o", "cut", "--until", "0.2").returncode == 2
    assert engrane("two.dat", "-o", "cut", "--restart", "cut").returncode == 0
    rest = (engrane.folder / "cut.lst").read_text()
    for title in ("Energies", "Forces of the ground", "Peaks"):
        assert section(rest, title) == section(run[1], title), title


def test_the_terminal_names_files_and_commands(run, engrane):
    assert "results in two.h5, two.xdmf and two.lst" in run[0]
    assert "engrane plot two element/" in run[0]
    assert "engrane picture two" in run[0]
    assert engrane("-q", "two.dat").stdout == ""


# 1 N/m beside 1e8 N/m in a row, along x: the matrix is [[1 + k, -k], [-k, k]]
SPRINGS = """.NOE
 I 1 X 1 0 0
 I 2 X 2 0 0
.MCE
 I 1 SPRING N 0 1 K 1
 I 2 SPRING N 1 2 K 1E8
.CLM
 NOEUD 1 2 FIX C 2 3
 NOEUD 2 CHA C 1 V 1E-3
.SAM TYPE STATIC
.SUB TF 1 H 1
"""


@pytest.mark.parametrize("ranks", [1, 3])
def test_condition(ranks, engrane):
    (engrane.folder / "springs.dat").write_text(SPRINGS)
    done = engrane("springs.dat", "--condition", "--json", ranks=ranks)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)["runs"][0]["linear_system"]
    assert found["condition"] == pytest.approx(
        4e8, rel=1e-6
    )  # sums of columns: 2 k + 1, and 2 of the inverse
    assert found["backward_error"] < 1e-14
    assert found["error_bound"] == pytest.approx(4e8 * max(found["backward_error"], 2**-52), rel=1e-6)
    listing = (engrane.folder / "springs.lst").read_text()
    assert "condition         4.0e+08" in listing
    done = engrane("springs.dat", ranks=ranks)
    assert (
        "linear_system" not in done.stdout and "condition" not in (engrane.folder / "springs.lst").read_text()
    )


def test_times_are_of_one_run(engrane) -> None:
    """PETSc counts from the start of the program: what earlier decks of the call took is not of this one."""
    names = [f"{k}.dat" for k in range(8)]
    for name in names:
        (engrane.folder / name).write_text(TWO_BODIES)
    done = engrane(*names)
    assert done.returncode == 0, done.stderr
    rows = section((engrane.folder / "7.lst").read_text(), "Effort")
    shares = [float(row[2]) for row in rows if len(row) == 3 and re.fullmatch(r"[\d.]+", row[2])]
    assert len(shares) == 6
    assert sum(shares) == pytest.approx(100, abs=1)


PLATE = """.UNIT SI
.NOE
 I 1 X 0 Y 0
 I 2 X 2 Y 0
 I 3 X 2 Y 1
 I 4 X 0 Y 1
.MAI
 I 1 N 1 2 3 4
.SEL GROUP 1 MAILLES TOUT
.MAT
 I 1 YT 1000. NT 0. M 3.
.HYP MEMB BIDIM
.PHP GROUP 1 THICK VAL 1.
.AEL I 1 MAT 1
.CLM
 NOEUD 1 FIX C 1 2
 NOEUD 4 FIX C 1
 NOEUD 2 CHA C 1 V 5.
 NOEUD 3 CHA C 1 V 5.
 STRU ACC VAL 0 -10. 0
.FIN 1
"""


def test_loads_and_reactions(engrane) -> None:
    (engrane.folder / "plate.dat").write_text(PLATE)
    done = engrane("plate.dat")
    assert done.returncode == 0, done.stderr
    text = (engrane.folder / "plate.lst").read_text()
    table = {row[0]: row[1:] for row in section(text, "Loads and reactions at the end")}
    rows = {name: [float(x) for x in table[name]] for name in ("loads", "reactions")}
    # 10 along x at half the height, and a weight of 6 times 10 in the middle
    assert rows["loads"] == pytest.approx([10, -60, 0, 0, 0, -65], abs=1e-4)
    assert rows["reactions"] == pytest.approx([-10, 60, 0, 0, 0, 65], abs=1e-4)
    work = re.search(r"\(total potential energy\): (\S+) N·m", text)
    with Results(engrane.folder / "plate.h5") as result:
        assert float(work[1]) == pytest.approx(result.history("run/LOAD_WORK")[1][-1], rel=1e-5)
    # of a mechanism there is no such table
    (engrane.folder / "two.dat").write_text(TWO_BODIES)
    assert engrane("two.dat").returncode == 0
    assert "Loads and reactions" not in (engrane.folder / "two.lst").read_text()


BEAM = """.UNIT SI
.NOE
 I 1 X 0
 I 2 X 2
.HYP BEAM
.MAI I 1 N 1 2
.MAT I 1 YT 2.1E11 NT .3 M 7800
.BPR I 1 RECTANGLE .1 .1
.AEL I 1 MAT 1 BPR 1
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
 STRU ACC 0 0 -10
.FIN 1
"""

SAIL = """.UNIT SI
.NOE
 I 1 X 0 Y 0
 I 2 X 1 Y 0
 I 3 X 2 Y 0
 I 4 X 0 Y 1
 I 5 X 1 Y 1
 I 6 X 2 Y 1
 I 7 X 0 Y 2
 I 8 X 1 Y 2
 I 9 X 2 Y 2
.MAI
 I 1 N 1 2 5 4
 I 2 N 2 3 6 5
 I 3 N 4 5 8 7
 I 4 N 5 6 9 8
.SEL GROUP 1 MAILLES TOUT
.MAT I 1 YT 1E5 NT .3 M 3
.AEL GROUP 1 MAT 1
.HYP MEMBRANE GROUP 1 TENSION 100
.PHP GROUP 1 THICK .1
.CLM
 FIX NOEUD 1 2 3 4 6 7 8 9 C 1 2 3
 STRU ACC 0 0 -1
 GROUP 1 PRE V 0.5
.SAM TYPE STATIC
.SUB TF 1 H 1
.FIN 1
"""

# held from below by relations of one node, and pulled at its top; a force as an element pushes it down
BOX = """.UNIT SI
.NOE
 1 0 0 0
 2 1 0 0
 3 1 1 0
 4 0 1 0
 5 0 0 1
 6 1 0 1
 7 1 1 1
 8 0 1 1
.MAI I 1 N 1 2 3 4 0 5 6 7 8
.MAT I 1 YT 1000 NT 0
.AEL I 1 MAT 1
.MCE I 20 FORCE N 7 DIR 0 0 -1 V 3
.LIA
 I 11 NOEUD 1 C 3 A 1
 I 12 NOEUD 2 C 3 A 2
 I 13 NOEUD 3 C 3 A 1
 I 14 NOEUD 4 C 3 A 1
.CLM
 FIX NOEUD 1 C 1 2
 FIX NOEUD 2 C 2
 CHA NOEUD 5 6 7 8 C 3 V 1
.FIN 1
"""


@pytest.mark.parametrize(
    ("deck", "loads"),
    [
        (BEAM, [0, 0, -7800 * 0.01 * 2 * 10, 0, 1560, 0]),  # its weight, 1 from the support
        (SAIL, [0, 0, -3 * 0.1 * 4 + 0.5 * 4, None, None, 0]),
        (BOX, [0, 0, 4 - 3, 2 - 3, -2 + 3, 0]),
    ],
    ids=["weight of a beam", "weight of membranes", "supports by LIA"],
)
def test_loads_and_reactions_balance(deck: str, loads: list[float | None], engrane) -> None:
    (engrane.folder / "held.dat").write_text(deck)
    done = engrane("held.dat")
    assert done.returncode == 0, done.stderr
    text = (engrane.folder / "held.lst").read_text()
    table = {row[0]: row[1:] for row in section(text, "Loads and reactions at the end")}
    found, reactions = ([float(x) for x in table[name]] for name in ("loads", "reactions"))
    size = max(map(abs, found))
    assert reactions == pytest.approx([-x for x in found], abs=1e-4 * size)
    for value, expected in zip(found, loads, strict=True):
        assert expected is None or value == pytest.approx(expected, abs=1e-4 * size)
