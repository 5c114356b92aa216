# SPDX-License-Identifier: BSD-3-Clause
"""Numbers that hold at the extremes (docs/extremes.md): ratios of stiffness and mass, very small and large
machines and backlash, fast spin, nearly singular positions, nothing at all, long runs. Short steps and places
far from the origin are in test_small_steps.py."""

from __future__ import annotations

import os
import re
import resource
from pathlib import Path

import numpy as np
import pytest
from engrane_post import Results
from runs import Run, engrane, run
from scipy.integrate import solve_ivp
from small_decks import GEAR_PAIR, SPRINGS

EPSILON = np.finfo(float).eps


def ends(text: str, folder: Path) -> tuple[int, str]:
    """Status and messages of a run that need not succeed."""
    done = engrane(text, folder, "-q")
    return done.returncode, done.stderr


@pytest.mark.parametrize("ratio", [1e3, 1e6, 1e9, 1e12, 1e15])
@pytest.mark.parametrize("kind", ["STATIC", "DYNAMIC RHO 0.8"])
def test_stiffness_ratio(kind: str, ratio: float, tmp_path: Path) -> None:
    """Motion and the force in the soft spring hold at any ratio. That in the stiff one follows from its
    change of length, which has the rounding of positions; a warning says so before it is seen."""
    h = 0.01 if kind == "STATIC" else 0.001
    status, words = ends(SPRINGS.format(stiff=10 * ratio, kind=kind, h=h), tmp_path)
    assert status == 0
    result = Run(tmp_path / "deck.h5")
    noise = 20 * ratio * EPSILON * 10
    if kind == "STATIC":
        assert result["1/FORCE"][-1] == pytest.approx(2, rel=1e-9)
        assert result["node/3/UX"][-1] == pytest.approx(0.2 * (1 + 1 / ratio), rel=1e-9)
        assert result["2/FORCE"][-1] == pytest.approx(2, rel=1e-9, abs=noise)
    elif ratio >= 1e6:  # as one mass of 2
        swings = 0.2 * (1 - np.cos(np.sqrt(5) * result.t))
        assert np.abs(result["node/3/UX"] - swings).max() < 1e-6
    assert ("SPRING 2 is so stiff" in words) == (noise > 0.02)


def test_stiff_teeth_beside_a_soft_coupling(tmp_path: Path) -> None:
    """Teeth have an unknown of their own for how far they give, so that 1e15 times the stiffness of a
    coupling costs no digit."""
    deck = """
.NOE
 I 1
 I 2 X 0.09
 I 3 X 0.09 Z 1
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 Z 30 60 MN 0.002 HELIX 0 AXIS 0 0 1 KM 1D15
 I 4 TSPRING N 2 3 AXIS 0 0 1 K 1
 I 5 HINGE N 0 3 AXIS 0 0 1
 I 6 TORQUE N 3 AXIS 0 0 1 V 0.3
.FCT
 I 1 EXPR "0.5*T"
.SAM TYPE STATIC
.SUB TF 1 H 0.1
.FIN 1
"""
    result = run(deck, tmp_path)
    assert np.abs(result["3/NORMAL_FORCE"]) * np.cos(np.radians(20)) * 0.06 == pytest.approx(0.3, rel=1e-9)
    assert result["3/U_M"][-1] == pytest.approx(0.3 / 0.06 / 1e15, rel=1e-9)
    assert result["node/3/RZ"][-1] == pytest.approx(0.3 - 0.25, rel=1e-9)


@pytest.mark.parametrize("ratio", [1e3, 1e6, 1e12])
def test_masses_on_a_spring(ratio: float, tmp_path: Path) -> None:
    """The light mass gives all its momentum to a heavy one that moves by less than the rounding of its place
    in a step."""
    deck = f"""
.NOE
 I 1 X 1
 I 2 X 2
.MCE
 I 1 SPRING N 1 2 K 100
 I 2 INERTIA N 1 M {ratio!r}
 I 3 INERTIA N 2 M 1
.CLM FIX NOEUD 1 2 C 2 3
.INI VIT NOEUD 2 C 1 V 1
.SAM TYPE DYNAMIC RHO 0.9 SOLVER KLU
.SUB TF 1 H 0.001
.FIN 1
"""
    result = run(deck, tmp_path)
    t = result.t
    w = np.sqrt(100 * (1 + 1 / ratio))
    stretch = np.sin(w * t) / w
    assert np.abs(ratio * result["node/1/VX"] + result["node/2/VX"] - 1).max() < 1e-13
    assert np.abs(result["1/FORCE"] - 100 * stretch).max() < 1e-4 * 10
    drifts = (t - stretch) / (1 + ratio)
    assert np.abs(result["node/1/UX"] - drifts).max() < 1e-5 * drifts[-1]


@pytest.mark.parametrize("ratio", [1e6, 1e12])
def test_a_light_pendulum_on_a_heavy_one(ratio: float, tmp_path: Path) -> None:
    deck = f"""
.NOE
 I 1 X 1
 I 2 X 2
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 0 AT 0 0 0
 I 2 HINGE N 1 2 AXIS 0 1 0 AT 1 0 0
 I 3 INERTIA N 1 M {ratio!r} J {0.1 * ratio!r}
 I 4 INERTIA N 2 M 1 J 0.1
.CLM STRU ACC VAL 0 0 -9.81
.SAM TYPE DYNAMIC RHO 0.9 SOLVER KLU
.SUB TF 1 H 0.001
.FIN 1
"""
    result = run(deck, tmp_path)

    def rates(_, s: np.ndarray) -> list[float]:
        p, q, dp, dq = s
        mass = [[1.1 * ratio + 1, np.cos(p - q)], [np.cos(p - q), 1.1]]
        loads = [
            -np.sin(p - q) * dq**2 + (ratio + 1) * 9.81 * np.cos(p),
            np.sin(p - q) * dp**2 + 9.81 * np.cos(q),
        ]
        return [dp, dq, *np.linalg.solve(mass, loads)]

    p, q, dp, dq = solve_ivp(rates, (0, 1), [0, 0, 0, 0], rtol=1e-11, atol=1e-12, t_eval=result.t).y
    assert np.abs(result["1/ANGLE"] - p).max() < 2e-5
    assert np.abs(result["2/ANGLE"] - (q - p)).max() < 1e-4
    growth = np.array([rates(0, s)[2:] for s in np.array([p, q, dp, dq]).T]).T
    rises = -np.cos(p) * growth[0] + np.sin(p) * dp**2 - np.cos(q) * growth[1] + np.sin(q) * dq**2
    carries = rises + 9.81  # the light one's hinge, of 1 kg
    assert np.abs(np.abs(result["2/FORCE_Z"]) - np.abs(carries)).max() < 1e-4 * np.abs(carries).max()


CRANK = """
.NOE
 I 1 X {r!r}
 I 2 X {x!r}
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0
 I 2 DISTANCE N 1 2
 I 3 PRISMATIC N 0 2 AXIS 1 0 0
 I 4 INERTIA N 2 M 1 J {j!r}
 I 5 INERTIA N 1 M 0.5 J {j!r}
.INI VIT ELEMENT 1 V 20
.CLM STRU ACC VAL 0 {g!r} 0
.SAM TYPE DYNAMIC RHO 0.8 SOLVER KLU
.SUB TF 1 H 0.002
.FIN 1
"""


@pytest.mark.parametrize("away", [300, 1e4, 1e6])
def test_mechanisms_far_from_the_origin(away: float, tmp_path: Path) -> None:
    """Places are rounded to their distance from the origin. Beyond 100 lengths a driven slider did "not close
    from where its parts are put"."""
    text = """
.NOE
 I 1 X {crank}
 I 2 X {pin}
 I 3 X {slider}
.MCE
 I 1 HINGE N 0 1 AXIS 0.2 0 0.92 AT {crank} DRIVE ANGLE NF 1
 I 2 HINGE N 1 2 AXIS 0.2 0 0.92 AT {pin}
 I 3 HINGE N 2 3 AXIS 0.2 0 0.92 AT {slider}
 I 4 PRISMATIC N 0 3 AXIS 0.92 0 -0.2
 I 5 SPRING N 0 3 K 100 100 100
.FCT
 I 1 EXPR "2*T"
.SAM TYPE KINEMATIC
.SUB TF 1 H 0.05
"""

    def crank(far: float) -> np.ndarray:
        crank = np.array([0.37, -1.21, 0.83]) * far
        pin, slider = crank + np.array([0, 0.2, 0]), crank + np.array([0.92, 0, -0.2])
        places = {"crank": crank, "pin": pin, "slider": slider}
        r = run(text.format(**{name: "{} {} {}".format(*at) for name, at in places.items()}), tmp_path)
        return np.array([r["node/3/UX"], r["node/3/UZ"], r["3/ANGLE"]])

    assert np.abs(crank(away) - crank(0)).max() < 1e-15 * 100 * away


def test_micrometres_and_kilometres(tmp_path: Path) -> None:
    """A crank of 0.1 um, 0.1 m or 0.1 Mm, with gravity to match, turns alike; forces are in proportion."""
    runs = {}
    for size in (1.0, 1e-6, 1e6):
        text = CRANK.format(r=0.1 * size, x=0.4 * size, j=0.01 * size**2, g=-9.81 * size)
        runs[size] = run(text, tmp_path, f"crank{size:g}")
    plain = runs.pop(1.0)
    for size, scaled in runs.items():
        assert np.abs(scaled["1/ANGLE"] - plain["1/ANGLE"]).max() < 1e-11
        assert np.abs(scaled["node/2/UX"] / size - plain["node/2/UX"]).max() < 1e-12
        largest = np.abs(plain["2/FORCE_X"]).max()
        assert np.abs(scaled["2/FORCE_X"] / size - plain["2/FORCE_X"]).max() < 1e-7 * largest


@pytest.mark.parametrize("speed", [1.0, 1e3, 1e6])
def test_spin(speed: float, tmp_path: Path) -> None:
    """A pair runs at up to 1e6 rad/s, a tenth of a radian in each step, for 1000 rad: no angle, energy or
    tooth is lost."""
    deck = f"""{GEAR_PAIR}\
.INI VIT ELEMENT 1 V {speed!r}
.SAM TYPE DYNAMIC RHO 0.8 SOLVER KLU
.SUB TF {1000 / speed!r} H {0.1 / speed!r}
.FIN 1
"""
    result = run(deck, tmp_path)
    assert result["1/ANGLE"][-1] == pytest.approx(1000, rel=1e-12)
    assert result["2/ANGLE"][-1] == pytest.approx(-500, rel=1e-12)
    kinetic = result["run/KINETIC_ENERGY"]
    assert np.ptp(kinetic) < 1e-12 * kinetic[0]
    load = 1e-3 * speed**2 / 0.03  # a force that is of the size of the energy
    assert np.abs(result["3/NORMAL_FORCE"]).max() < 1e-9 * load


@pytest.mark.parametrize("backlash", [1e-9, 1e-5, 1e-2, 0.1])
def test_backlash(backlash: float, tmp_path: Path) -> None:
    """In parts of the module. The load changes its sense: the teeth cross the gap and give the same on the
    other side."""
    gap = backlash * 0.002
    deck = f"""
.NOE
 I 1
 I 2 X 0.09
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 Z 30 60 MN 0.002 HELIX 0 AXIS 0 0 1 KM 1D8 JEU {gap!r}
 I 4 TORQUE N 2 AXIS 0 0 1 V 20 NF 2
.FCT
 I 1 EXPR "0*T"
 I 2 EXPR "if(T<0.55,1,-1)"
.SAM TYPE STATIC
.SUB TF 1 H 0.1
.FIN 1
"""
    result = run(deck, tmp_path)
    gives = 20 / 0.06 / 1e8
    assert result["3/U_M"][0] == pytest.approx(gives, rel=1e-9)
    assert result["3/U_M"][-1] == pytest.approx(-gives - gap, rel=1e-9, abs=64 * EPSILON * 0.06)
    assert result["3/NORMAL_FORCE"][-1] == pytest.approx(-20 / 0.06 / np.cos(np.radians(20)), rel=1e-9)


DRIVEN_SLIDER = """
.NOE
 I 1 X {ax!r} Y {ay!r}
 I 2 X {bx!r}
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0
 I 2 DISTANCE N 1 2
 I 3 PRISMATIC N 0 2 AXIS 1 0 0 DRIVE SLIDE NF 1
 I 4 INERTIA N 2 M 1 J 0.1
 I 5 INERTIA N 1 M 0.5 J 0.01
.FCT
 I 1 EXPR "sqrt(0.09-0.01*sin({end!r}+PI/4*(1-T))**2)+0.1*cos({end!r}+PI/4*(1-T))-{bx!r}"
.SAM TYPE KINEMATIC
.SUB TF 1 H 0.05
.FIN 1
"""


def driven_slider(end: float) -> str:
    begin = end + np.pi / 4
    ax, ay = float(0.1 * np.cos(begin)), float(0.1 * np.sin(begin))
    return DRIVEN_SLIDER.format(ax=ax, ay=ay, bx=ax + float(np.sqrt(0.09 - ay**2)), end=end)


def slider_force(angle: np.ndarray) -> np.ndarray:
    """Of the slider alone: the crank turns evenly."""
    s, c = 0.1 * np.sin(angle), 0.1 * np.cos(angle)
    q = np.sqrt(0.09 - s**2)
    return (-c - (c * c - s * s) / q - (s * c) ** 2 / q**3) * (np.pi / 4) ** 2


def test_a_slider_drives_its_crank_towards_the_dead_centre(tmp_path: Path) -> None:
    """The crank turns evenly until it is a hundredth of a radian away: the drive's force is that of the
    slider alone."""
    result = run(driven_slider(1e-2), tmp_path)
    angle = np.pi / 4 * (1 - result.t) + 1e-2
    assert np.abs(result["1/ANGLE"] - (angle - angle[0])).max() < 1e-12
    force = slider_force(angle)
    assert np.abs(result["3/SLIDE_DRIVE"] - force).max() < 1e-6 * np.abs(force).max()


@pytest.mark.parametrize("end", [1e-4, 1e-6, 1e-8, 0.0, -1e-4])
def test_a_slider_at_the_dead_centre_of_its_crank(end: float, tmp_path: Path) -> None:
    """Nearer the force is rounding of positions enlarged 1e16 times and more. The one given is the limit, to
    which the positions before lead: this slider slows down so that the crank goes on turning evenly."""
    result = run(driven_slider(end), tmp_path)
    angle = np.pi / 4 * (1 - result.t) + end
    assert np.abs(result["1/ANGLE"] - (angle - angle[0])).max() < 1e-12
    assert np.abs(result["3/SLIDE_DRIVE"] - slider_force(angle)).max() < 1e-6


def test_a_slider_is_not_driven_evenly_to_the_dead_centre(tmp_path: Path) -> None:
    """The crank's speed has no bound there."""
    even = re.sub(r'EXPR ".*"', 'EXPR "(0.4-sqrt(0.085)-sqrt(0.005))*T"', driven_slider(0.0))
    status, words = ends(even, tmp_path)
    assert status == 2
    assert "singular position" in words


@pytest.mark.parametrize("kind", ["KINEMATIC", "DYNAMIC RHO 0.8"])
def test_a_crank_through_both_dead_centres(kind: str, tmp_path: Path) -> None:
    deck = f"""
.NOE
 I 1 X 0.1
 I 2 X 0.4
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0 DRIVE ANGLE NF 1
 I 2 DISTANCE N 1 2
 I 3 PRISMATIC N 0 2 AXIS 1 0 0
 I 4 INERTIA N 2 M 1 J 0.1
 I 5 INERTIA N 1 M 0.5 J 0.01
.FCT
 I 1 EXPR "2*PI*T"
.SAM TYPE {kind}
.SUB TF 2 H 0.01
.FIN 1
"""
    result = run(deck, tmp_path)
    s, c = 0.1 * np.sin(2 * np.pi * result.t), 0.1 * np.cos(2 * np.pi * result.t)
    q = np.sqrt(0.09 - s**2)
    assert np.abs(result["node/2/UX"] - (c + q - 0.4)).max() < 1e-15
    force = (-c - (c * c - s * s) / q - (s * c) ** 2 / q**3) * (2 * np.pi) ** 2
    allowed = 1e-12 if kind == "KINEMATIC" else 3e-3
    assert np.abs(np.abs(result["2/FORCE_X"]) - np.abs(force)).max() < allowed * np.abs(force).max()


BODY = """.NOE
 I 1
.MCE
 I 1 INERTIA N 1 M 1 J 1
{loads}.SAM TYPE {kind}
.SUB TF {end} H {h}
.FIN 1
"""
WEIGHT = ".CLM STRU ACC VAL 0 0 -9.81\n"


@pytest.mark.parametrize(
    ("text", "status", "words"),
    [
        ("", 1, "is empty"),
        (".SAM TYPE DYNAMIC\n.SUB TF 1 H 0.1\n.FIN 1\n", 0, ""),
        (".NOE\n I 1\n.SAM TYPE DYNAMIC\n.SUB TF 1 H 0.1\n.FIN 1\n", 0, ""),
        (BODY.format(loads="", kind="STATIC", end=1, h=0.1), 0, ""),
        (BODY.format(loads=WEIGHT, kind="DYNAMIC", end=0, h=0.1), 1, "is not after the start"),
        (BODY.format(loads=WEIGHT, kind="DYNAMIC", end=1, h=0), 1, "H = 0 is out of range"),
        (BODY.format(loads=WEIGHT, kind="DYNAMIC", end=1, h=1e-20), 1, "H is too short to be added"),
        (
            BODY.replace("M 1 J 1", "M 0 J 0").format(loads="", kind="DYNAMIC", end=1, h=0.1),
            1,
            "does nothing",
        ),
    ],
    ids=["empty", "no node", "one node", "no load", "no time", "no step", "step below rounding", "no mass"],
)
def test_nothing(text: str, status: int, words: str, tmp_path: Path) -> None:
    found, said = ends(text, tmp_path)
    assert found == status, said
    assert words in said


@pytest.mark.parametrize(("loads", "falls"), [("", 0.0), (WEIGHT, -4.905)])
def test_one_body(loads: str, falls: float, tmp_path: Path) -> None:
    result = run(BODY.format(loads=loads, kind="DYNAMIC", end=1, h=0.1), tmp_path)
    assert result["node/1/UZ"][-1] == pytest.approx(falls, rel=1e-12, abs=0)


def test_many_steps(tmp_path: Path) -> None:
    """2e5 steps of a pendulum (ENGRANE_LONG: that many; tests/bench/long_runs.py goes to 1e7): no drift of
    energy beyond what RHO dissipates, of the hinge, or of memory beyond a run a twentieth as long."""
    steps = int(float(os.environ.get("ENGRANE_LONG", "2e5")))
    memory, energy = [], []
    for count in (steps // 20, steps):
        deck = f"""
.NOE
 I 1 X 1
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 0 AT 0 0 0
 I 2 INERTIA N 1 M 2 J 0.1
.CLM STRU ACC VAL 0 0 -9.81
.SAM TYPE DYNAMIC RHO 0.9 SOLVER KLU
.SUB TF {count * 0.01!r} H 0.01
.SAI FIELDS DT {count * 0.005!r} HISTORY DT {count * 1e-5!r}
.FIN 1
"""
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        result = run(deck, tmp_path, f"run{count}")
        memory.append(max(before, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss))
        with Results(result.file) as r:
            kinetic = r.history("run/KINETIC_ENERGY")[1]
            energy.append((kinetic + r.history("run/POTENTIAL_ENERGY")[1]) / kinetic.max())
        gap = np.hypot(result["node/1/UX"] + 1, result["node/1/UZ"]) - 1
        assert np.abs(gap).max() < 1e-15
    assert memory[1] < 1.02 * memory[0]
    # RHO dissipates 1e-9 of the energy in a step; the rest is the error of the scheme within a swing
    assert np.abs(energy[1]).max() < 1e-3 + 2e-9 * steps
