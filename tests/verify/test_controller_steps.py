# SPDX-License-Identifier: BSD-3-Clause
"""Controllers where statics begin beyond their limits, where their lags are much shorter than a step, and
where steps follow their states in any units. Exact values are closed form, or integrated by SciPy. The
program is taken from the variable ENGRANE."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from runs import run
from scipy.integrate import solve_ivp

# factors of lengths, times and masses beside metres, seconds and kilograms
UNITS = {"m s kg": (1.0, 1.0, 1.0), "um us g": (1e6, 1e6, 1e3)}


def number_of_steps(file: Path) -> int:
    return int(re.search(r"(\d+) steps", file.read_text(encoding="utf-8"))[1])


# a weight on a slide; the equilibrium is within the limits, but the command at the start is far beyond
SLIDE = """.NOE
 I 1 X 0 0 0
.MCE
 I 1 PRISMATIC N 0 1 AXIS 0 0 1
 I 2 INERTIA N 1 M {mass} J 1 1 1
 I 3 CONTROLLER IN 1 COORDINATE slide OUT 1 ALONG Slide REF {reference} {law}
 I 4 FORCE N 1 DIR 0 0 1 V {load}
{analysis}
.FIN 1
"""
STATIC = ".SAM TYPE STATIC\n.SUB TF {time} H {time}"
START = ".SAM TYPE DYNAMIC RHO 0.8 START STATIC\n.SUB TF {time} H {step}"


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("analysis", [STATIC, START], ids=["static", "start"])
@pytest.mark.parametrize(
    ("law", "slide"),
    [
        ("KP {k400} KI {k900} LIMITS -{f50} {f50}", 0.25),
        ("KP {k400} LIMITS -{f50} {f50}", 0.25 - 15 / 400),
        ("KP {k400} LIMITS -{f10} {f50}", 0.25 - 15 / 400),
        ("NUM {n800} {k2000} DEN {t1} 40 LIMITS -{f10} {f16}", 0.25 - 15 / 50),
        ("KP {s2} LIMITS -{v} {v} DRIVE SPEED TAU {t1}", 0.25),
    ],
    ids=["PI", "P", "P one side", "lead", "drive"],
)
def test_statics_begin_beyond_limits(
    law: str, slide: float, analysis: str, units: str, tmp_path: Path
) -> None:
    """At its limit a command resists nothing: statics found no equilibrium ("nothing resists a motion")."""
    length, time, mass = UNITS[units]
    force = mass * length / time**2
    values = {f"k{k}": k * force / length for k in (400, 900, 2000)} | {
        f"f{f}": f * force for f in (10, 16, 50)
    }
    if "KI" in law:
        values["k900"] /= time
    values |= {"n800": 800 * force / length * time, "t1": time, "s2": 2 / time, "v": 0.4 * length / time}
    text = SLIDE.format(
        mass=2 * mass,
        reference=0.25 * length,
        law=law.format(**values),
        load=-15 * force,
        analysis=analysis.format(time=0.1 * time, step=0.01 * time),
    )
    found = run(text, tmp_path)
    assert found["1/SLIDE"] / length == pytest.approx(slide, rel=1e-8)
    assert found["3/EFFORT"] / force == pytest.approx(15, rel=1e-7)


def test_statics_end_at_a_limit(tmp_path: Path) -> None:
    """A spring takes what the controller may not: the limit holds where the equilibrium is beyond it."""
    text = SLIDE.format(
        mass=2,
        reference=0.25,
        law="KP 400 KI 900 LIMITS -5 5",
        load=-15,
        analysis=STATIC.format(time=1),
    )
    found = run(text.replace("AXIS 0 0 1\n", "AXIS 0 0 1 K 100\n"), tmp_path)
    assert found["1/SLIDE"] == pytest.approx(-0.1, rel=1e-8)
    assert found["3/LIMITED"] == pytest.approx(5, rel=1e-12)


WHEEL = """.NOE
 I 1 X 0 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 INERTIA N 1 M {mass} J {inertia}
 I 9 CONTROLLER IN 1 OUT 1 NF 1 {law}
.FCT
 I 1 SINUS 1 {frequency}
.SAM TYPE DYNAMIC {scheme}
.SUB TF {end} H {step}
.FIN 1
"""


def wheel(law: str, scheme: str, step: float, units: str, folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Time and effort of a wheel of inertia 1 that a controller leads along sin 2πt, in s and N m."""
    length, time, mass = UNITS[units]
    text = WHEEL.format(
        mass=mass,
        inertia=mass * length**2,
        law=law,
        frequency=1 / time,
        scheme=scheme,
        end=time,
        step=step * time,
    )
    found = run(text, folder)
    return np.minimum(found.t / time, 1), found["9/EFFORT"] * (time / length) ** 2 / mass


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("scheme", ["RHO 0.8", "SCHEME HHT", "SCHEME BOSSAK"])
@pytest.mark.parametrize("tau", [1e-4, 1e-6, 1e-9])
def test_short_lags(tau: float, scheme: str, units: str, tmp_path: Path) -> None:
    """The rate of a state that follows at once overshot by the step over the lag: with 1e-6 s, the effort was
    off by 0.3 of its range, with 1e-7 s by 3. Now 9.5e-4 and 2.4e-4."""
    length, time, mass = UNITS[units]
    law = f"NUM {50 * mass * (length / time) ** 2} DEN {tau * time} 1"

    def rates(t: float, y: np.ndarray) -> list[float]:
        return [y[1], y[2], (50 * (np.sin(2 * np.pi * t) - y[0]) - y[2]) / tau]

    errors = []
    for step in (0.01, 0.005):
        t, effort = wheel(law, scheme, step, units, tmp_path)
        exact = solve_ivp(rates, (0, 1), [0, 0, 0], "Radau", t, rtol=1e-10, atol=1e-12).y[2]
        errors.append(np.abs(effort - exact).max() / np.ptp(exact))
    assert errors[0] < 1.2e-3
    assert errors[1] < errors[0] / 3.8


@pytest.mark.parametrize("scheme", ["RHO 0.8", "SCHEME HHT"])
def test_short_lags_behind_limits(scheme: str, tmp_path: Path) -> None:
    """The command reaches and leaves its limits. Placing states after their lags at the start is not enough:
    where their rates are not softened, they overshoot behind each event, until no step has a solution."""

    def command(t: float | np.ndarray, angle: float | np.ndarray) -> float | np.ndarray:  # the lag is past
        return np.clip(50 * (np.sin(2 * np.pi * t) - angle), -15, 15)

    t, effort = wheel("NUM 50 DEN 1E-6 1 LIMITS -15 15", scheme, 0.01, "m s kg", tmp_path)
    angle = solve_ivp(
        lambda t, y: [y[1], command(t, y[0])],
        (0, 1),
        [0, 0],
        "DOP853",
        t,
        rtol=1e-10,
        atol=1e-12,
        max_step=1e-3,
    ).y[0]
    exact = command(t, angle)
    assert np.ptp(exact) == 30
    assert np.abs(effort - exact).max() < 1e-3 * 30


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("scheme", ["RHO 0.8", "SCHEME HHT"])
def test_short_filters(scheme: str, units: str, tmp_path: Path) -> None:
    """The speed of the reference sets in with the run, and a filter of 1e-6 s takes it up at once. The effort
    was off by 11 times its range with a filter of 1e-4 s. It is now off by 3.9e-4 and 6.7e-5."""
    length, time, mass = UNITS[units]
    law = f"KD {5 * mass * length**2 / time} TF {1e-6 * time}"
    errors = []
    for step in (0.01, 0.005):
        t, effort = wheel(law, scheme, step, units, tmp_path)
        # the filter is past: KD (dr/dt - w), dw/dt = effort
        exact = solve_ivp(
            lambda t, w: 5 * (2 * np.pi * np.cos(2 * np.pi * t) - w), (0, 1), [0], "DOP853", t, rtol=1e-11
        ).y[0]
        exact = 5 * (2 * np.pi * np.cos(2 * np.pi * t) - exact)
        errors.append(np.abs(effort - exact).max() / np.ptp(exact))
    print(errors)
    assert errors[0] < 1e-3
    assert errors[1] < errors[0] / 3


# a lag of 4 ms and one of 20 ms follow a vibration of 20 Hz; the slide is held
LAGS = """.NOE
 I 1 X 0 0 0
 I 3 X 2 0 0
.MCE
 I 1 PRISMATIC N 0 1 AXIS 0 0 1 DRIVE SLIDE NF 2
 I 2 INERTIA N 1 M {mass} J 1 1 1
 I 3 CONTROLLER IN 1 OUT 1 NF 1 NUM {gain} DEN {second} {first} 1
{more}
.FCT
 I 1 EXPR "sin(40*PI*T/{time})*(1+T/{time})"
 I 2 EXPR "0.1*sin(3*T/{time})"
 I 3 SINUS 1 1
.SAM TYPE DYNAMIC {scheme}
.SUB TF {time} H {step} TOL 1E-4
.FIN 1
"""
LARGE = """ I 13 PRISMATIC N 0 3 AXIS 0 0 1
 I 12 INERTIA N 3 M 2E6 J 2E6 2E6 2E6
 I 15 SPRING N 0 3 K 0 0 3E9
 I 14 CONTROLLER IN 1 OUT 13 NF 3 NUM 1E9 DEN 0.1 1"""
CASES = {"alone": (1, 1, ""), "small": (1e-9, 1, ""), "short": (1, 1e-6, ""), "beside": (1, 1, LARGE)}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("scheme, error, most", [("RHO 0.8", 2e-4, 3500), ("SCHEME RADAU", 2e-6, 500)])
def test_states_are_judged_by_themselves(
    case: str, scheme: str, error: float, most: int, tmp_path: Path
) -> None:
    """Errors of states were compared with 1e-3 of the unit of force and of the largest state around. RHO
    0.8: the small one was off by 0.24 after 68 steps, the one beside a large one by 0.017 after 666."""
    force, time, more = CASES[case]
    text = LAGS.format(
        mass=2 * force,
        gain=200 * force,
        second=8e-5 * time**2,
        first=0.024 * time,
        time=time,
        step=0.005 * time,
        scheme=scheme,
        more=more,
    )
    found = run(text, tmp_path)
    t = np.minimum(found.t / time, 1)

    def rates(t: float, y: np.ndarray) -> list[float]:
        r = np.sin(40 * np.pi * t) * (1 + t) - 0.1 * np.sin(3 * t)
        return [y[1], (r - y[0] - 0.024 * y[1]) / 8e-5]

    exact = 200 * solve_ivp(rates, (0, 1), [0, 0], "DOP853", t, rtol=1e-11, atol=1e-13, max_step=1e-3).y[0]
    assert np.abs(found["3/EFFORT"] / force - exact).max() < error * np.ptp(exact)
    assert number_of_steps(tmp_path / "deck.lst") < most


@pytest.mark.parametrize("scheme", ["RHO 0.8", "SCHEME RADAU"])
def test_states_that_rest(scheme: str, tmp_path: Path) -> None:
    """What a controller makes of rounding has no accuracy: beside a swinging pendulum one holds a wheel at
    rest, whose axis is turned so that zeros are rounding."""
    text = """.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 1 2 3
 I 2 INERTIA N 1 M 1 J 1
 I 3 CONTROLLER IN 1 OUT 1 REF {angle} KP 50 KI 30 KD 5
 I 4 HINGE N 0 2 AXIS 0 0 1 AT 0 0 0
 I 5 INERTIA N 2 M 1 J 0.1
.CLM
 STRU ACC VAL 0 -9.81 0
.INI
 DEP ELEMENT 1 V {angle}
.SAM TYPE DYNAMIC {scheme}
.SUB TF 3 H 0.01 TOL 1E-4
.FIN 1
"""
    run(text.format(angle=20, scheme=scheme), tmp_path)
    alone = text.replace(" I 3 CONTROLLER IN 1 OUT 1 REF {angle} KP 50 KI 30 KD 5\n", "")
    run(alone.format(angle=20, scheme=scheme), tmp_path, "alone")
    steps = [number_of_steps(tmp_path / name) for name in ("deck.lst", "alone.lst")]
    assert steps[0] < 1.2 * steps[1]


@pytest.mark.parametrize("scheme", ["RHO 0.8", "SCHEME RADAU"])
def test_energies_of_a_first_step(scheme: str, tmp_path: Path) -> None:
    """A motor begins to turn: of the energy that the first step handles, 1e-7 of that in the end, it missed
    more than there was, and the run ended there."""
    text = """.NOE
 I 1 X 0 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 1 2 2 C 5E-5
 I 3 INERTIA N 1 M 1 J 0.00095
 I 9 CONTROLLER IN 1 QUANTITY SPEED REF 240 NF 1 NUM 0.01 DEN 0.0005 0.5 STATES 0 OUT 1
 I 10 TORQUE N 1 AXIS 1 2 2 V -0.075
.FCT
 I 1 STEP 0 0 0.01 1
.SAM TYPE DYNAMIC {}
.SUB TF 0.6 H 0.002
.FIN 1
"""
    found = run(text.format(scheme), tmp_path)

    def rates(t: float, y: np.ndarray) -> list[float]:
        s = min(t / 0.01, 1)
        reference = 240 * s**3 * (10 - 15 * s + 6 * s * s)
        return [(0.01 * (reference - y[1]) - 0.5 * y[0]) / 0.0005, (y[0] - 5e-5 * y[1] - 0.075) / 0.00095]

    exact = solve_ivp(rates, (0, 0.6), [0, 0], "DOP853", found.t, rtol=1e-11, atol=1e-13, max_step=1e-3)
    assert np.abs(found["1/SPEED"] - exact.y[1]).max() < 2e-3 * np.ptp(exact.y[1])
