# SPDX-License-Identifier: BSD-3-Clause
"""Controllers against ordinary differential equations written apart from them (oracles/controlled.py):
accuracy, second order in the step, statics, drives. The program is taken from the variable ENGRANE."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from oracles import controlled as oracle
from runs import run

MASS = 2.0
FORCE = -15.0
END = 1.0


def reference(t: float) -> float:
    return oracle.quintic(t, 0.0, 0.0, 0.5, 0.3)


def deck(controller: str, step: float, more: str = "", analysis: str = "TYPE DYNAMIC RHO 0.8") -> str:
    """A mass on a slide under a constant force, with one controller."""
    return f""".NOE
 I 1 X 0 0 0
.MCE
 I 1 PRISMATIC N 0 1 AXIS 0 0 1
 I 2 INERTIA N 1 M {MASS} J 1 1 1
 I 3 CONTROLLER IN 1 OUT 1 {controller}
 I 4 FORCE N 1 DIR 0 0 1 V {FORCE}
{more}
.FCT
 I 1 STEP 0 0 0.5 0.3
 I 2 TABLE 0 1 1 1
.SAM {analysis}
.SUB TF {END} H {step}
.FIN 1
"""


def errors(
    controller: str, exact: np.ndarray, folder: Path, steps: tuple[int, ...], more: str = ""
) -> list[float]:
    """Largest error of the slide at ten times, for each number of steps."""
    found = []
    for count in steps:
        history = run(deck(controller, END / count, more), folder, f"steps_{count}")
        at = np.searchsorted(history.t, np.linspace(0.1, END, 10) - 1e-9)
        found.append(float(np.abs(history["1/SLIDE"][at] - exact).max()))
    return found


def order(errors: list[float]) -> float:
    """Over all halvings of the step."""
    return math.log2(errors[0] / errors[-1]) / (len(errors) - 1)


TIMES = np.linspace(0.1, END, 10)


@pytest.mark.parametrize(
    ("limits", "steps", "least"),
    [((-math.inf, math.inf), (500, 1000), 1.95), ((-5, 24), (700, 1400, 2800), 1.95)],
    ids=["free", "limited"],
)
def test_pid_has_second_order(
    limits: tuple[float, float], steps: tuple[int, ...], least: float, tmp_path: Path
) -> None:
    """Free: errors 5.5e-6, 1.4e-6. Limited, both limits are met and left, and steps end there: 6.5e-6,
    1.6e-6, 4.1e-7."""
    law = oracle.Pid(400, 900, 30, 0.02, *limits)
    exact = oracle.pid_mass(TIMES, law, reference, MASS, FORCE)
    keywords = "NF 1 KP 400 KI 900 KD 30 TF 0.02"
    if math.isfinite(limits[0]):
        keywords += f" LIMITS {limits[0]} {limits[1]}"
    found = errors(keywords, exact, tmp_path, steps)
    print(found)
    assert found[-1] < 2e-6
    assert order(found) > least


def test_transfer_function_has_second_order(tmp_path: Path) -> None:
    exact = oracle.lead_mass(TIMES, reference, MASS)
    more = f" I 5 FORCE N 1 DIR 0 0 1 V {-FORCE}"  # the lead alone
    found = errors("NF 1 NUM 800 2000 DEN 1 40", exact, tmp_path, (500, 1000), more)
    print(found)
    assert found[-1] < 2e-6
    assert order(found) > 1.95


def test_statics_find_the_steady_state(tmp_path: Path) -> None:
    """The integral takes the load and leaves no error; the derivative rests."""
    history = run(deck("REF 0.25 KP 400 KI 900 KD 30", 0.5, analysis="TYPE STATIC"), tmp_path)
    assert history["1/SLIDE"][-1] == pytest.approx(0.25, abs=1e-12)
    assert history["3/EFFORT"][-1] == pytest.approx(-FORCE, rel=1e-12)
    assert history["3/STATE_1"][-1] == pytest.approx(-FORCE, rel=1e-10)
    # without the integral the error holds the load: a transfer function of steady gain 50
    history = run(deck("REF 0.25 NUM 800 2000 DEN 1 40", 0.5, analysis="TYPE STATIC"), tmp_path)
    assert history["1/SLIDE"][-1] == pytest.approx(0.25 + FORCE / 50, rel=1e-12)


def test_start_static_stays(tmp_path: Path) -> None:
    """From the equilibrium that statics finds, nothing moves."""
    text = deck("REF 0.25 KP 400 KI 900 KD 30", 0.01, analysis="TYPE DYNAMIC RHO 0.8 START STATIC")
    history = run(text, tmp_path)
    assert np.abs(history["1/SLIDE"] - 0.25).max() < 1e-10
    assert np.abs(history["3/EFFORT"] + FORCE).max() < 1e-8


@pytest.mark.parametrize("kind", ["SPEED", "POSITION"])
def test_drives(kind: str, tmp_path: Path) -> None:
    """The load does not move a drive; its force is m a less the load. SPEED: tau x'' + x' = KP (r - x),
    both poles at -4. POSITION: (tau d/dt + 1)^2 x = 0.3 of a constant gain."""
    t = np.linspace(0.1, END, 10)
    if kind == "SPEED":
        rate, text = 4.0, deck("REF 0.3 KP 2 DRIVE SPEED TAU 0.125", 1e-3)
    else:
        # measured on a node that is held: the command does not come back to the reference
        held = " I 6 SENSOR N 7 DISPLACEMENT AXIS 1 0 0\n.NOE\n I 7 X 1 0 0\n.CLM\n FIX NOEUD 7 C 1 2 3"
        rate, text = (
            5.0,
            deck("REF 0.3 KP 1 DRIVE POSITION TAU 0.2", 1e-3, held).replace("IN 1 OUT", "IN 6 OUT"),
        )
    history = run(text, tmp_path)
    at = np.searchsorted(history.t, t - 1e-9)
    exact = 0.3 * (1 - (1 + rate * t) * np.exp(-rate * t))
    acceleration = 0.3 * rate**2 * (1 - rate * t) * np.exp(-rate * t)
    assert np.abs(history["1/SLIDE"][at] - exact).max() < 2e-6
    assert np.abs(history["3/EFFORT"][at] - (MASS * acceleration - FORCE)).max() < 1e-3


def test_initial_states(tmp_path: Path) -> None:
    """I0 and STATES start the law: an integral that carries the load from the first instant."""
    history = run(deck(f"REF 0 KP 400 KI 900 I0 {-FORCE}", 0.01), tmp_path)
    assert np.abs(history["1/SLIDE"]).max() < 1e-12
    history = run(deck(f"REF 0 NUM 900 DEN 1 0 STATES {-FORCE}", 0.01), tmp_path)
    assert np.abs(history["1/SLIDE"]).max() < 1e-12


def test_robot_arm(tmp_path: Path) -> None:
    """The deck of the arm with coarser steps, against Lagrange's equations: second order through the
    limits too."""
    text = (Path(__file__).parents[2] / "decks/mechanisms/robot_arm.dat").read_text()
    body = text[: text.index(".CHK")]
    t = np.linspace(0.1, 1.4, 14)
    exact = oracle.robot_arm(t)["angles"]
    found = []
    for step in ("0.004", "0.002", "0.001"):
        history = run(
            body.replace("H 0.001\n.", f"H {step}\n.").replace("TF 1.4 H 0.001", f"TF 1.4 H {step}"), tmp_path
        )
        at = np.searchsorted(history.t, t - 1e-9)
        angles = np.array([history[f"{joint}/ANGLE"][at] for joint in (1, 2, 3)])
        found.append(float(np.abs(angles - exact).max()))
    print(found)
    assert found[-1] < 5e-5
    assert order(found) > 1.7


@pytest.mark.parametrize("setting, error", [("FAST", 2e-4), ("NORMAL", 2e-5)])
def test_the_dial_knows_of_limits(setting: str, error: float, tmp_path: Path) -> None:
    """Steps end where the command reaches a limit and leaves it. Before, the error of the force was 0.03 of
    its range, and stated as 0.006. One sample lies in the short way across such an event, and had the value
    behind it: with FAST and NORMAL the error was 0.0018."""
    text = deck("NF 3 KP 200 KI 300 KD 4 TF 0.002 LIMITS -8 8", 0.005, analysis="{}")
    text = text.replace(f"V {FORCE}", "V 0").replace(f"M {MASS}", "M 0.02")
    text = text.replace(".SAM", " I 3 TABLE 0 0 0.05 0 0.25 2 0.45 2 0.5 -1 1 -1\n.SAM")
    exact = run(
        text.format("TYPE DYNAMIC SCHEME RADAU").replace("H 0.005", "H 0.005 TOL 1E-6"), tmp_path, "exact"
    )
    fast = run(text.format(f"TYPE DYNAMIC ACCURACY {setting}"), tmp_path, "fast")
    assert np.max(exact["3/LIMITED"]) == 8 and np.min(exact["3/LIMITED"]) == -8
    off = np.sqrt(np.mean((fast["3/EFFORT"] - exact["3/EFFORT"]) ** 2)) / 16
    listing = (tmp_path / "fast.lst").read_text(encoding="utf-8")
    stated = float(re.search(r"estimated error\D+([\d.]+(?:e-\d+)?)", listing)[1])
    assert off < error
    assert off / 4 < stated < 1e-2  # in this way both runs are the same


@pytest.mark.parametrize("factor", [1e-9, 1e6, 1e9])
def test_states_have_any_size(factor: float, tmp_path: Path) -> None:
    """The residual of a state, here a torque, was compared with forces on a node that carries none, and its
    correction with a radian: with large torques no iteration ended."""
    text = """.NOE
 I 1
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 INERTIA N 1 M {mass} J {inertia}
 I 3 CONTROLLER IN 1 QUANTITY SPEED REF 10 NUM {gain} DEN 0.2 1 OUT 1
.SAM TYPE DYNAMIC
.SUB TF 2 H 0.01
"""
    plain = run(text.format(mass=1, inertia=0.02, gain=0.5), tmp_path, "plain")
    other = run(text.format(mass=factor, inertia=0.02 * factor, gain=0.5 * factor), tmp_path, "other")
    assert other["3/COMMAND"] / factor == pytest.approx(plain["3/COMMAND"], abs=1e-9)
    assert "0 failed attempts" in (tmp_path / "other.lst").read_text(encoding="utf-8")
