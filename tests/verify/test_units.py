# SPDX-License-Identifier: BSD-3-Clause
"""Twelve decks in random units of length, mass and time give the same numbers, in those units: no length,
mass, force or time of the program's own hides in a tolerance, a guess or a scale."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from engrane_post import Results
from runs import Run, run

# numbers are written <value|dimension>: powers of L, M and T
DECKS = {
    "pendulum": """
.NOE
 I 1 X <0.3|L>
.MCE
 I 1 RIGID N 1 M <2|M> J <0.1|ML2> <0.2|ML2> <0.25|ML2>
 I 2 HINGE N 0 1 AXIS 0 1 0 AT 0 0 0 C <0.02|ML2T-1>
.CLM STRU ACC VAL 0 0 <-9.81|LT-2>
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF <1|T> H <0.01|T>
""",
    "oscillator": """
.NOE
 I 1 X <1|L>
 I 2 X <2|L>
.MCE
 I 1 SPRING N 1 2 K <50|MT-2> C <0.4|MT-1> L0 <0.7|L>
 I 2 INERTIA N 2 M <3|M>
.CLM
 FIX NOEUD 1 C 1 2 3
 FIX NOEUD 2 C 2 3
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF <2|T> H <0.02|T>
""",
    "friction": """
.NOE
 I 1
.MCE
 I 1 HINGE N 0 1 AXIS 1 0 0 FRICTION STRIBECK 0.2 0.1 <0.02|LT-1> VREG <1D-4|LT-1> RADIUS <0.02|L>
 I 2 INERTIA N 1 M <2|M> J <0.1|ML2>
.CLM STRU ACC VAL 0 0 <-9.81|LT-2>
.INI VIT NOEUD 1 C 4 V <3|T-1>
.SAM TYPE DYNAMIC
.SUB TF <8|T> H <0.01|T>
""",
    "friction_at_rest": """
.NOE
 I 1
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 FRICTION CONST 0.2 0.25 STICK
 I 2 INERTIA N 1 M <2|M> J <0.1|ML2>
.CLM STRU ACC VAL <-3|LT-2> <-9|LT-2> 0
.INI VIT NOEUD 1 C 1 V <1|LT-1>
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF <1|T> H <0.013|T>
""",
    "elastic_teeth": """
.NOE
 I 1
 I 2 X <0.09|L>
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 2 HINGE N 0 2 AXIS 0 0 1 C <0.2|ML2T-1>
 I 3 GEAR N 1 2 Z 30 60 MN <0.002|L> HELIX 0 AXIS 0 0 1 KM <1D6|MT-2> XI 0.05 WIDTH <0.02|L>
 I 4 INERTIA N 1 J <1D-3|ML2>
 I 5 INERTIA N 2 J <1D-2|ML2>
.FCT
 I 1 EXPR "min(<20|T-1>, <2000|T-2>*T)"
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF <0.05|T> H <1D-4|T>
""",
    "worm": """
.NOE
 I 1
 I 2 Y <0.063100219993073609|L>
.MCE
 I 1 HINGE N 0 1 AXIS 1 0 0 C <0.02|ML2T-1>
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 KIND WORM STARTS 2 Z 40 MN <0.002|L> LAMBDA 5 AXIS 1 0 0 AXISB 0 0 1 $
   FRICTION CONST 0.05 VREG <1D-3|LT-1>
 I 4 INERTIA N 1 J <1D-5|ML2>
 I 5 INERTIA N 2 J <1D-3|ML2>
 I 6 TORQUE N 2 AXIS 0 0 1 V <20|ML2T-2>
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF <0.1|T> H <0.001|T>
""",
    "slider_crank": """
.NOE
 I 1 X <0.1|L>
 I 2 X <0.4|L>
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0 DRIVE SPEED NF 1
 I 2 DISTANCE N 1 2
 I 3 PRISMATIC N 0 2 AXIS 1 0 0
 I 4 INERTIA N 2 M <1|M> J <0.1|ML2>
 I 5 INERTIA N 1 M <0.5|M> J <0.01|ML2>
.FCT
 I 1 EXPR "<5|T-1> + <3|T-2>*T"
.SAM TYPE KINEMATIC
.SUB TF <1|T> H <0.01|T>
""",
    "net_at_rest": """
.NOE
 I 1 X 0
 I 2 X <1|L> Y <0.1|L>
 I 3 X <2|L>
.MCE
 I 1 SPRING N 1 2 K <100|MT-2>
 I 2 SPRING N 2 3 K <200|MT-2>
 I 3 FORCE N 2 DIR 0 -1 0 V <5|MLT-2>
.CLM
 FIX NOEUD 1 3 C 1 2 3
 FIX NOEUD 2 C 3
.SAM TYPE STATIC
.SUB TF <1|T> H <0.1|T>
""",
    "four_bar": """
.NOE
 I 1 X <0|L> Y <0.2|L>
 I 2 X <0.3|L> Y <0.3|L>
 I 3 X <0.6|L> Y <0.2|L>
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0
 I 2 HINGE N 1 2 AXIS 0 0 1 AT <0|L> <0.2|L> 0
 I 3 HINGE N 2 3 AXIS 0 0 1 AT <0.6|L> <0.4|L> 0
 I 4 HINGE N 0 3 AXIS 0 0 1 AT <0.6|L> 0 0
 I 5 INERTIA N 1 M <1|M> J <0.01|ML2>
 I 6 INERTIA N 2 M <2|M> J <0.05|ML2>
 I 7 INERTIA N 3 M <1.5|M> J <0.03|ML2>
.CLM STRU ACC VAL 0 <-9.81|LT-2> 0
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF <0.5|T> H <0.005|T>
""",
    "belt": """
.NOE
 I 1
 I 2 X <0.5|L>
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 HINGE N 0 2 AXIS 0 0 1 C <0.05|ML2T-1>
 I 3 BELT N 1 2 AXIS 0 0 1 R <0.05|L> <0.12|L> K <2D4|MT-2> PRELOAD <300|MLT-2> C <40|MT-1>
 I 4 INERTIA N 1 J <0.01|ML2>
 I 5 INERTIA N 2 J <0.1|ML2>
 I 6 TORQUE N 1 AXIS 0 0 1 V <2|ML2T-2>
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF <0.5|T> H <0.005|T>
""",
    "stop": """
.NOE
 I 1
.MCE
 I 1 PRISMATIC N 0 1 AXIS 0 0 1 MIN <-0.1|L> KSTOP <1D4|MT-2> DAMP LINEAR <20|MT-1>
 I 2 INERTIA N 1 M <1|M> J <0.1|ML2>
.CLM STRU ACC VAL 0 0 <-9.81|LT-2>
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF <0.6|T> H <0.001|T>
""",
    "massless_node": """
.NOE
 I 1
 I 2 X <1|L>
 I 3 X <2|L>
.MCE
 I 1 SPRING N 1 2 K <100|MT-2>
 I 2 SPRING N 2 3 K <100|MT-2>
 I 3 INERTIA N 3 M <1|M>
.CLM
 FIX NOEUD 1 C 1 2 3
 FIX NOEUD 2 3 C 2 3
.INI VIT NOEUD 3 C 1 V <1|LT-1>
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF <1|T> H <0.01|T>
""",
}


def power(dimension: str, unit: str) -> int:
    found = re.search(unit + r"(-?\d*)", dimension)
    return 0 if found is None else int(found.group(1) or 1)


def in_units(text: str, units: dict[str, float]) -> str:
    """The deck with each number in other units."""

    def scaled(match: re.Match) -> str:
        value = float(match.group(1).replace("D", "e"))
        for unit, size in units.items():
            value *= size ** power(match.group(2), unit)
        return repr(value)

    return re.sub(r"<([^|>]+)\|([^>]+)>", scaled, text) + ".FIN 1\n"


def size_of(unit: str, units: dict[str, float]) -> float:
    """What `[force·length/time]` is in other units."""
    length, mass, time = (units[u] for u in "LMT")
    known = {"length": length, "mass": mass, "time": time, "force": mass * length / time**2}
    size = 1.0
    over = False
    for word, exponent, slash in re.findall(r"([a-z]+)([²³⁴]?)|(/)", unit):
        if slash:
            over = True
        elif word in known:
            factor = known[word] ** {"": 1, "²": 2, "³": 3, "⁴": 4}[exponent]
            size = size / factor if over else size * factor
        else:
            assert word in ("rad", "none", "deg"), unit
    return size


def assert_alike(plain: Run, other: Run, units: dict[str, float], tolerance: float) -> None:
    """The same results at the end, each in its units."""
    with Results(plain.file) as a, Results(other.file) as b:
        largest: dict[str, float] = {}
        gaps: dict[str, tuple[float, str]] = {}
        for channel in a.channels.values():
            if channel.name == "run/STEP" or (channel.name.startswith("run/") and not channel.unit):
                continue
            size = size_of(channel.unit, units)
            x, y = a.history(channel.name)[1], b.history(channel.name)[1] / size
            largest[channel.unit] = max(largest.get(channel.unit, 0), np.abs(x).max())
            gap = np.abs(x[-1] - y[-1])
            gaps[channel.unit] = max(gaps.get(channel.unit, (0, "")), (gap, channel.name))
        assert len(largest) > 3
        for unit, (gap, path) in gaps.items():
            # what is zero but for rounding is compared with the deck's own sizes, all near 1; the
            # acceleration of a centre that a joint holds also with that of a rim
            rim = largest.get(unit.replace("length/", "rad/"), 0) * largest.get("[length]", 0)
            allowed = max(tolerance * largest[unit], tolerance * 0.1, 1e-8 * rim)
            assert gap <= allowed, (units, path, gap, largest[unit])


def any_units(random: np.random.Generator) -> dict[str, float]:
    return {u: float(10 ** random.uniform(-5, 5)) for u in "LMT"}


@pytest.mark.parametrize("name", DECKS)
def test_any_units(name: str, tmp_path: Path) -> None:
    random = np.random.default_rng(sum(map(ord, name)))
    plain = run(in_units(DECKS[name], {"L": 1, "M": 1, "T": 1}), tmp_path, "plain")
    for trial in range(2):
        units = any_units(random)
        assert_alike(plain, run(in_units(DECKS[name], units), tmp_path, f"trial{trial}"), units, 1e-8)


MEAN_TURN = """
.NOE
 I 1
 I 2 Y <0.1|L>
 I 3 X <0.5|L>
 I 4 X <0.5|L> Y <0.1|L>
 I 5 X <1|L>
 I 6 X <1|L> Y <0.1|L>
 I 10 X <1|L> Y <0.05|L>
.MAI
 I 1 N 1 3 4 2
 I 2 N 3 5 6 4
.SEL
 GROUP 1 NOM "all" MAILLES TOUT
.MAT
 I 1 YT <2.1D11|ML-1T-2> NT 0.3 M <7850|ML-3>
.HYP MEMB BIDIM GROUP "all"
.PHP
 GROUP "all" THICK <0.02|L>
.AEL
 GROUP "all" MAT 1
.MCE
 I 103 MEAN_LINK N 10 MEMBERS 5 6
 I 104 INERTIA N 10 M <1|M>
.CLM
 FIX NOEUD 1 C 1 2
 FIX NOEUD 10 C 3 4 5
 STRU ACC VAL 0 <-9.81|LT-2> 0
.SAM TYPE DYNAMIC DISPLACEMENTS LARGE
.SUB TF <0.01|T> H <0.0001|T>
"""


@pytest.mark.parametrize("length", [1e-5, 1e5])
def test_turns_without_inertia_at_any_size(length: float, tmp_path: Path) -> None:
    """What stands for the inertia of the mean turn was a part of the masses, whatever the square of the
    lengths: moments in a mesh of micrometres belonged to it."""
    plain = run(in_units(MEAN_TURN, {"L": 1, "M": 1, "T": 1}), tmp_path, "plain")
    units = {"L": length, "M": 1 / length, "T": 1}
    assert_alike(plain, run(in_units(MEAN_TURN, units), tmp_path, "other"), units, 1e-6)


CONTROLLED = [name for name, text in DECKS.items() if "DYNAMIC" in text]


@pytest.mark.parametrize(
    ("words", "tolerance"),
    [("SCHEME RADAU", "TOL 1D-6"), ("SCHEME CHUNG", "TOL 1D-4"), ("ACCURACY FINE", "")],
)
@pytest.mark.parametrize("name", CONTROLLED)
def test_steps_know_no_units(name: str, words: str, tolerance: str, tmp_path: Path) -> None:
    """Nor do the steps that a tolerance chooses, what the dial judges, and integrals of formulas."""
    text = re.sub(r"(?m)^\.SAM .*", f".SAM TYPE DYNAMIC {words}", DECKS[name])
    text = re.sub(r"(?m)^(\.SUB .*)", rf"\1 {tolerance}", text)
    random = np.random.default_rng(sum(map(ord, name)))
    plain = run(in_units(text, {"L": 1, "M": 1, "T": 1}), tmp_path, "plain")
    units = any_units(random)
    other = run(in_units(text, units), tmp_path, "other")
    # accelerations of what a joint holds still are rounding over h² with generalised-alpha
    assert_alike(plain, other, units, 1e-4 if "CHUNG" in words else 1e-8)
    steps = []
    for run_ in (plain, other):
        listing = run_.file.with_suffix(".lst").read_text(encoding="utf-8")
        steps.append(int(re.findall(r"\n  (\d+) steps,", listing)[0]))
    assert abs(steps[0] - steps[1]) <= 0.02 * steps[0] + 1


WATCH = """
 I 1 HINGE N 0 1 AXIS 1 0 0 FRICTION STRIBECK 0.2 0.1 2D-5 VREG 1D-8 RADIUS 2D-5
 I 2 INERTIA N 1 M 2D-6 J 1D-11
 I 3 FORCE N 1 DIR 0 0 1 V -2D-5
"""
PRESS = """
 I 11 RIGID N 11 M 2D6 J 1D7 2D7 3D7
 I 12 HINGE N 0 11 AXIS 0 1 0 AT 0 0 0
 I 13 FORCE N 11 DIR 0 0 1 V -2D7
"""


def test_a_watch_on_a_press(tmp_path: Path) -> None:
    """The small machine turns as it does alone, beside one with forces 10^12 times as large, and with a fixed
    node far away."""
    deck = """
.NOE
 I 1
{nodes}
.MCE
{elements}
{clamps}
.INI VIT NOEUD 1 C 4 V 3
.SAM TYPE DYNAMIC
.SUB TF 8 H 0.01
.FIN 1
"""
    alone = run(deck.format(nodes="", elements=WATCH, clamps=""), tmp_path, "alone")
    beside = run(deck.format(nodes=" I 11 X 3", elements=WATCH + PRESS, clamps=""), tmp_path, "beside")
    far = run(
        deck.format(
            nodes=" I 21 X 1D6\n I 22 X 1D6 Y 1",
            elements=WATCH + " I 21 SPRING N 21 22 K 1",
            clamps=".CLM FIX NOEUD 21 22 C 1 2 3",
        ),
        tmp_path,
        "far",
    )
    turned = np.abs(alone["1/ANGLE"]).max()
    for other in (beside, far):
        assert np.abs(other["1/ANGLE"] - alone["1/ANGLE"]).max() < 1e-8 * turned
