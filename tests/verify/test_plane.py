# SPDX-License-Identifier: BSD-3-Clause
"""Decks whose motion stays in a plane give the same results there (`.SAM PLANE`) as in space."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from engrane_post import Results
from runs import engrane, run

DECKS = Path(__file__).resolve().parents[2] / "decks"

# deck, with a shorter run where the whole one is long
PLANAR = {
    "mechanisms/andrews_squeezer": "TF 0.004 H 0.00002",
    "mechanisms/four_bar": "TF 0.2 H 0.002",
    "mechanisms/quick_return": "",
    "mechanisms/geneva_wheel": "",
    "mechanisms/geneva_index": "",
    "mechanisms/valve_train": "TF 0.005 H 1D-5",
    "mechanisms/plane_slider_crank": "",
    "gears/spur": "",
    "trains/planetary_3_carrier_held": "",
    "trains/planetary_3_ring_held": "",
    "gears/helical": "",
    "trains/two_stage_reducer": "",
}
SPATIAL = ["mechanisms/bricard", "mechanisms/slider_crank", "paper/bevel_pair", "trains/worm_drive"]


def solve(name: str, plane: str, solver: str, stepping: str, folder: Path) -> subprocess.CompletedProcess:
    """Solves a deck of the project with another plane and solver and a sharper `PREC`."""
    path = DECKS / f"{name}.dat"
    text = path.read_text(encoding="utf-8")
    text = re.sub(
        r'INPUT "([^"]+)"', lambda m: (path.parent / f"{m[1]}.dat").read_text(encoding="utf-8"), text
    )
    text = text.replace(" PLANE AUTO", "").replace(" SOLVER KLU", "")
    text = re.sub(r"^(\.SAM TYPE \w+)", rf"\1 PLANE {plane} SOLVER {solver}", text, flags=re.MULTILINE)
    text = re.sub(r"^(\.SAM (?!.*PREC).*?)( *!.*)?$", r"\1 PREC 1D-13", text, flags=re.MULTILINE)
    if stepping:
        text = text[: text.index(".FIN")] + f".DEL.CHK\n.DEL.SUB\n.SUB {stepping}\n.FIN 1\n"
    return engrane(text, folder, "-q", timeout=600)


@pytest.mark.parametrize("name", PLANAR)
def test_results_are_those_in_space(name: str, tmp_path: Path) -> None:
    """Every channel, over the whole run, to 1e-10 of the largest number of its unit. Accelerations and
    reactions are differences of rounded positions over the square of the step; what rounding does to them
    shows where the model in space is solved by another solver, which adds in another order."""
    found = {}
    for plane, solver in (("NO", "MUMPS"), ("NO", "KLU"), ("XY", "MUMPS")):
        done = solve(name, plane, solver, PLANAR[name], tmp_path)
        assert done.returncode == 0, done.stdout + done.stderr
        with Results(tmp_path / "deck.h5") as results:
            channels = {
                c: r
                for c, r in results.channels.items()
                if c not in ("run/ITERATIONS", "run/EVENTS", "run/STEP")
            }
            found[plane, solver] = {c: results.history(r)[1] for c, r in channels.items()}
            for channel, values in found[plane, solver].items():
                if channel.endswith("RADIUS_OF_CURVATURE"):  # grows without bound where a cam is straight
                    found[plane, solver][channel] = 1 / values
            units = {c: r.unit for c, r in channels.items()}
    space, other, plane = found.values()
    assert space.keys() == plane.keys()
    largest: dict[str, float] = {}
    noise: dict[str, float] = {}
    for channel, values in space.items():
        unit = units[channel]
        largest[unit] = max(largest.get(unit, 0.0), np.abs(values).max())
        noise[unit] = max(noise.get(unit, 0.0), np.abs(other[channel] - values).max())
    for channel, values in space.items():
        unit = units[channel]
        off = np.abs(plane[channel] - values).max()
        assert off <= 1e-10 * largest[unit] + 10 * noise[unit], (channel, off, largest[unit], noise[unit])


@pytest.mark.parametrize("name", SPATIAL)
def test_what_leads_out_of_the_plane_is_refused(name: str, tmp_path: Path) -> None:
    done = solve(name, "XY", "MUMPS", "", tmp_path)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "plane XY" in done.stderr


@pytest.mark.parametrize(("value", "channel"), [("VIT", "SPEED"), ("DEP", "ANGLE")])
def test_initial_coordinate_of_a_joint(value: str, channel: str, tmp_path: Path) -> None:
    """A rotor spins about an axis in the plane in which its frame turns. The initial value takes the model
    out of it: AUTO solves in space, and a plane that the deck asks for is refused."""
    text = f""".NOE
 I 1 X 1 2 3
 I 2 X 1 2 3
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 0 DRIVE ANGLE NF 1
 I 2 HINGE N 1 2 AXIS 1 0 0
 I 3 INERTIA N 2 M 1 J 0.02 0.01 0.01
.FCT
 I 1 EXPR "2*T"
.INI
 {value} ELEMENT 2 V 30
.SAM TYPE DYNAMIC SCHEME RADAU PLANE AUTO
.SUB TF 0.1 H 0.002
.FIN 1
"""
    found = run(text, tmp_path)
    start = 30 if value == "VIT" else np.radians(30)
    assert found[f"2/{channel}"][0] == pytest.approx(start, rel=1e-9)
    done = engrane(text.replace("PLANE AUTO", "PLANE ZX"), tmp_path, "-q")
    assert done.returncode == 1
    assert f"the initial {channel} of HINGE 2 leads out of the plane ZX" in done.stderr


SIDEWAYS = """.UNIT SI
.NOE
 I 1 X 0 -1 0
.MCE
 I 1 INERTIA N 1 M 2
 I 2 SPRING N 0 1 K 5000 AT 0 0 0
.FCT
 I 1 {function}
.CLM
 STRU ACC 0 -9.81 0
 NOEUD 1 CHA C 3 V 10 NF 1
.INI
 VIT NOEUD 1 C 1 V 1
.SAM TYPE DYNAMIC {sam}
.SUB TF 10 H 0.02
.FIN 1
"""
SHORT = [
    "TABLE 0 0 1 0 1.05 1 4.95 1 5 0",
    "TABLE 0 0 3 0 3.001 1 3.003 1 3.004 0",
    "TABLE 0 0 8 0 8.5 1 9 0",
    'EXPR "max(0, 0.1 - abs(T - 2.34))"',
]


@pytest.mark.parametrize("function", SHORT)
def test_a_load_that_leaves_the_plane_for_a_while(tmp_path: Path, function: str) -> None:
    """Whenever it acts: at the start and at the end there is none of it."""
    found = run(SIDEWAYS.format(function=function, sam="ACCURACY NORMAL"), tmp_path)
    assert np.abs(found["node/1/UZ"]).max() > 1e-3
    done = engrane(SIDEWAYS.format(function=function, sam="PLANE XY"), tmp_path, "-q")
    assert done.returncode == 1
    assert "CHA 3 is not of the plane XY" in done.stderr


PULLED = """.UNIT SI
.NOE
 I 1 X 0 0 0
.MCE
 I 2 POINT_PLANE N 0 1 AXIS 0 0 1 FRICTION CONST 0.1
 I 3 SPRING N 0 1 K 200 AT -0.3 {aside} 0 L0 0.25
 I 4 INERTIA N 1 M 2
.CLM STRU ACC VAL 0 0 -9.81
.SAM TYPE DYNAMIC RHO 0.9 PLANE {plane}
.SUB TF 0.4 H 0.001
.FIN 1
"""


@pytest.mark.parametrize("aside", [0, 0.1])
def test_friction_at_rest_holds_nothing_in_the_plane(tmp_path: Path, aside: float) -> None:
    """A spring pulls a block over a floor with friction, which gives way in every direction. The block swings
    along the spring, less far by what friction takes."""
    found = run(PULLED.format(aside=aside, plane="AUTO"), tmp_path)
    length = np.hypot(0.3, aside)
    way = 2 * (length - 0.25 - 0.1 * 2 * 9.81 / 200)
    assert found["node/1/UX"].min() == pytest.approx(-0.3 / length * way, rel=1e-5)
    assert found["node/1/UY"].max() == pytest.approx(aside / length * way, rel=1e-5, abs=1e-15)
    solved_in = re.search("solved in +(.*)", (tmp_path / "deck.lst").read_text(encoding="utf-8"))[1]
    assert ("the plane ZX" in solved_in) == (aside == 0)
    done = engrane(PULLED.format(aside=aside, plane="ZX"), tmp_path, "-q")
    assert done.returncode == (0 if aside == 0 else 1)
    if aside != 0:
        assert "SPRING 3 is not of the plane ZX" in done.stderr


@pytest.mark.parametrize(
    ("kind", "plane", "component", "axes"), [("DYNAMIC", "XY", 6, "0 1"), ("STATIC", "ZX", 5, "2 0")]
)
def test_one_rotation_is_enough_in_the_plane(
    kind: str, plane: str, component: int, axes: str, tmp_path: Path
) -> None:
    """A node that turns about the normal of the plane alone, by more than a right angle."""
    first, second = (int(i) for i in axes.split())
    place = " ".join("1" if i == first else "0" for i in range(3))
    found = run(
        f"""
.NOE
 I 1
 I 2 X {place}
.MCE
 I 1 INERTIA N 1 M 1 J 1
 I 2 INERTIA N 2 M 1 J 1
 I 3 RIGID N 1 2
.CLM
 NOEUD 1 FIX C {first + 1} {second + 1}
 NOEUD 1 DEP C {component} V 150 NF 1
.FCT I 1 TABLE 0 0 1 1
.SAM TYPE {kind} PLANE {plane}
.SUB TF 1 H 0.05
.FIN
""",
        tmp_path,
    )
    turn = np.radians(150)
    assert found[f"node/2/U{'XYZ'[first]}"][-1] == pytest.approx(np.cos(turn) - 1, abs=1e-9)
    assert found[f"node/2/U{'XYZ'[second]}"][-1] == pytest.approx(np.sin(turn), abs=1e-9)
