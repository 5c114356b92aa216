# SPDX-License-Identifier: BSD-3-Clause
"""The decks of decks/mechanisms against closed forms and integrations made elsewhere, over the whole motion;
and the numbers of their .CHK against the same."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from oracles import andrews, mechanisms, stewart, wishbone
from runs import Run, run

DECKS = Path(__file__).resolve().parents[2] / "decks" / "mechanisms"


def deck(name: str, stepping: str = "") -> str:
    """A deck, or it with another `.SUB` and without checks."""
    text = (DECKS / f"{name}.dat").read_text(encoding="utf-8")
    if not stepping:
        return text
    return f"{text[: text.index('.FIN')]}.DEL.CHK\n.DEL.SUB\n.SUB {stepping}\n.FIN 1\n"


def expected(name: str, quantity: str) -> float:
    """The number that a deck's check of a quantity at a time states."""
    found = re.search(rf"^ {quantity} V (\S+)", deck(name), re.MULTILINE)
    assert found, f"{name} has no check of {quantity}"
    return float(found[1])


def close(run: Run, channel: str, values: np.ndarray, tolerance: float) -> None:
    assert np.abs(run[channel] - values).max() < tolerance, channel


def test_andrews_published() -> None:
    """Hairer and Wanner's equations in one coordinate lead to the Test Set's solution: its digits are good to
    1e-8 and ours, at this accuracy, to 1e-7."""
    assert np.abs(andrews.closure(andrews.START)).max() < 1e-15
    reached = andrews.motion(np.linspace(0, 0.03, 121))[-1]
    assert reached == pytest.approx(andrews.PUBLISHED, abs=1e-6)


def test_andrews(tmp_path: Path) -> None:
    """All angles over the first turn of the crank; second order in the step."""
    hinge = [11, 12, 13, 16, 15, 19, 18]
    error = []
    for step in (8e-5, 4e-5, 2e-5):
        done = run(deck("andrews_squeezer", f"TF 0.012 H {step}"), tmp_path)
        if not error:
            times = np.arange(0, 0.012 + 4e-5, 8e-5)
            known = andrews.motion(times) - andrews.START
        each = np.rint(times / step).astype(int)
        found = np.stack([done[f"{h}/ANGLE"][each] for h in hinge], axis=-1)
        error.append(np.abs(found - known).max())
    order = np.log2(np.array(error[:-1]) / error[1:])
    assert error[-1] < 2e-3
    assert order == pytest.approx([2, 2], abs=0.2), error


def test_four_bar(tmp_path: Path) -> None:
    assert mechanisms.grashof(0.1, 0.25, 0.3, 0.35)
    done = run(deck("four_bar"), tmp_path)
    speed = np.radians(755)
    crank = np.radians(70) + speed * done.t
    rocker = mechanisms.four_bar(crank)
    ratio = mechanisms.rate(mechanisms.four_bar, crank)
    close(done, "14/ANGLE", rocker - rocker[0], 1e-12)
    close(done, "14/SPEED", ratio * speed, 1e-10)
    close(done, "11/DRIVE_TORQUE", 12 * ratio, 1e-10)


def test_quick_return(tmp_path: Path) -> None:
    done = run(deck("quick_return"), tmp_path)
    crank = 2 * np.pi * done.t
    arm, rate = mechanisms.slotted_arm(crank), mechanisms.rate(mechanisms.slotted_arm, crank)
    ram, ram_rate = mechanisms.ram(crank), mechanisms.rate(mechanisms.ram, crank)
    close(done, "12/ANGLE", arm, 1e-12)
    close(done, "12/SPEED", 2 * np.pi * rate, 1e-10)
    close(done, "15/SLIDE", ram - ram[0], 1e-12)
    close(done, "15/SLIDE_SPEED", 2 * np.pi * ram_rate, 1e-10)
    close(done, "11/DRIVE_TORQUE", 500 * ram_rate, 1e-8)
    # the arm's speed changes sign at 120 and 240 degrees: work in 2/3 of the turn, return in 1/3
    speed = done["12/SPEED"]
    returning = done.t[speed < -1e-9]
    work = 1 - (returning[-1] - returning[0]) - 2 / 300
    assert work / (1 - work) == pytest.approx(2, abs=1e-9)


def test_stewart_platform(tmp_path: Path) -> None:
    done = run(deck("stewart_platform"), tmp_path)
    places = np.array([stewart.path(t)[0] for t in done.t])
    for i, axis in enumerate("XYZ"):
        close(done, f"node/1/U{axis}", places[:, i] - [0, 0, 1.2][i], 1e-11)
    thrust = np.array([stewart.thrusts(t) for t in done.t])
    length = np.array([stewart.lengths(t) for t in done.t])
    for i in range(6):
        close(done, f"{11 + i}/LENGTH", length[:, i], 1e-12)
        close(done, f"{11 + i}/LENGTH_DRIVE", thrust[:, i], 1e-6)
        stated = expected("stewart_platform", rf"ELEMENT {11 + i} LENGTH_DRIVE T 0\.35")
        assert stated == pytest.approx(stewart.thrusts(0.35)[i], rel=1e-10)


def test_double_wishbone(tmp_path: Path) -> None:
    done = run(deck("double_wishbone"), tmp_path)
    known = [wishbone.state(0.08 * np.sin(2 * np.pi * t)) for t in done.t]
    for i, axis in enumerate("XYZ"):
        close(done, f"node/3/U{axis}", np.array([s["shift"][i] for s in known]), 1e-10)
        close(done, f"node/6/U{axis}", np.array([s["mark"][i] for s in known]), 1e-10)
    close(done, "16/FORCE", np.array([s["spring"] for s in known]), 1e-5)
    close(done, "node/3/FZ", np.array([s["wheel_force"] for s in known]), 1e-5)
    for t, travel in ((0.25, 0.08), (0.75, -0.08)):
        state = wishbone.state(travel)
        for quantity, value in (
            ("NODE 3 UY", state["shift"][1]),
            ("NODE 6 UX", state["mark"][0]),
            ("NODE 6 UZ", state["mark"][2]),
            ("ELEMENT 16 FORCE", state["spring"]),
            ("NODE 3 FZ", state["wheel_force"]),
        ):
            stated = expected("double_wishbone", rf"{quantity} T {t}")
            assert stated == pytest.approx(value, rel=1e-9, abs=2e-12), quantity


def test_wishbone_force_is_the_slope_of_the_energy() -> None:
    """Over the whole travel the work of the wheel's force is what the spring stores (Simpson's rule)."""
    travel = np.linspace(-0.08, 0.08, 41)
    force = np.array([wishbone.state(z)["wheel_force"] for z in travel])
    work = (
        (travel[1] - travel[0]) / 3 * (force[0] + 4 * force[1::2].sum() + 2 * force[2:-1:2].sum() + force[-1])
    )
    stretch = [wishbone.spring_length(z) - wishbone.NATURAL for z in (-0.08, 0.08)]
    stored = 0.5 * wishbone.STIFFNESS * (stretch[1] ** 2 - stretch[0] ** 2)
    assert work == pytest.approx(stored, rel=1e-7)


def test_universal_differential(tmp_path: Path) -> None:
    done = run(deck("universal_differential"), tmp_path)
    cage, wheel = 4 * done.t, 3 * done.t
    bend, other = np.radians(20), np.radians(15)
    # the gear's angle for the wheel's: the same joints from behind
    fine = np.linspace(0, 9.2, 40001)
    gear = np.interp(wheel, mechanisms.universal_pair(fine, bend, other), fine)
    close(done, "12/ANGLE", gear, 1e-7)  # interpolation: h2/8 times the curvature
    right = mechanisms.universal_pair(2 * cage - gear, bend, bend)
    close(done, "26/ANGLE", right, 1e-7)
    close(done, "13/ANGLE", 2 * cage - done["12/ANGLE"], 1e-11)
    k = np.cos(bend) / np.cos(other)
    ratio = k / (np.cos(wheel) ** 2 + k**2 * np.sin(wheel) ** 2)
    close(done, "12/SPEED", 3 * ratio, 1e-10)
    close(done, "25/ANGLE_DRIVE", -300 * ratio, 1e-7)
    close(done, "11/DRIVE_TORQUE", 600 + 0 * ratio, 1e-7)


def test_slider_crank(tmp_path: Path) -> None:
    done = run(deck("slider_crank"), tmp_path)
    crank = 10 * done.t
    place = mechanisms.slider(crank)
    rate = mechanisms.rate(mechanisms.slider, crank)
    close(done, "node/3/UX", place - place[0], 1e-7)
    close(done, "4/SLIDE_SPEED", 10 * rate, 2e-4)
    h = 1e-4
    bend = (mechanisms.rate(mechanisms.slider, crank + h) - mechanisms.rate(mechanisms.slider, crank - h)) / (
        2 * h
    )
    # the first steps show how the start settles
    settled = done.t > 0.02
    error = done["1/DRIVE_TORQUE"] - 3 * bend * 100 * rate
    assert np.abs(error[settled]).max() < 2e-2
