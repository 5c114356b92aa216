# SPDX-License-Identifier: BSD-3-Clause
"""Teeth with backlash under loads from a millionth to a thousand times that of a working gear, against closed
form, without a word about SMOOTH: the onset of contact has no width of its own."""

from __future__ import annotations

from math import atan, cos, pi, radians, sqrt
from pathlib import Path

import numpy as np
import pytest
from runs import run

DECKS = Path(__file__).resolve().parents[2] / "decks"
NOMINAL = 4000.0  # N along the circumference: the teeth give 0.04 mm
LOADS = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1000.0]
STIFFNESS, BACKLASH = 1e8, 1e-4
RADIUS_A, RADIUS_B = 0.05, 0.1
MASS_A, MASS_B = 0.01 / RADIUS_A**2, 0.08 / RADIUS_B**2  # of the wheels, on the pitch line
ALPHA = radians(20)
ROUNDING = (
    64 * np.finfo(float).eps * RADIUS_A
)  # of places on the pitch circle, within which nothing is resolved
HEAD = """.NOE
 I 1
 I 2 X 0.15
 I 3 Y -0.05
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 {drive}
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 4 INERTIA N 1 J 0.01
 I 5 INERTIA N 2 J 0.08
"""
GEAR = " I 3 GEAR N 1 {b} AXIS 0 0 1 Z 20 40 MN 0.005 KM 1E8 JEU 1E-4 {more}\n"


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("teeth", ["GEAR", "GEAR RUNNING", "RACK"])
def test_static_deflection(teeth: str, sense: int, load: float, tmp_path: Path) -> None:
    """A is held, the load presses the front or the back flank: u_m = F/k, or -(b + F/k)."""
    force = sense * load * NOMINAL
    text = HEAD.format(drive="DRIVE ANGLE NF 1")
    if teeth == "RACK":
        text = text.replace(" I 2 HINGE N 0 2 AXIS 0 0 1\n", "").replace(" I 2 X 0.15\n", "")
        text = text.replace(" I 5 INERTIA N 2 J 0.08\n", " I 5 INERTIA N 3 M 2 J 1\n")
        text += " I 3 RACK N 1 3 AXIS 0 0 1 DIR 1 0 0 Z 20 MN 0.005 KM 1E8 JEU 1E-4\n"
        text += f".CLM\n FIX NOEUD 3 C 2 3 4 5 6\n CHA NOEUD 3 C 1 V {-force!r}\n"
    else:
        text += GEAR.format(b=2, more=teeth[5:]) + f" I 6 TORQUE N 2 AXIS 0 0 1 V {RADIUS_B * force!r}\n"
        text = text.replace(" I 3 Y -0.05\n", "")
    text += '.FCT\n I 1 EXPR "0"\n.SAM TYPE STATIC PREC 1e-12\n.SUB TF 1 H 1\n.FIN 1\n'
    result = run(text, tmp_path)
    assert result["3/NORMAL_FORCE"][-1] == pytest.approx(
        force / cos(ALPHA), rel=1e-9, abs=STIFFNESS * ROUNDING
    )
    u = result["3/U_M"][-1]
    pressed = u if sense > 0 else -u - BACKLASH
    assert pressed == pytest.approx(abs(force) / STIFFNESS, rel=1e-9, abs=ROUNDING)


@pytest.mark.parametrize("load", LOADS)
def test_free_vibration_in_touch(load: float, tmp_path: Path) -> None:
    """Released in touch, the pair swings about its mean and just comes to touch again after each period, 200
    steps long."""
    force = load * NOMINAL
    mean = force * MASS_B / (MASS_A + MASS_B)
    period = 2 * pi / sqrt(STIFFNESS * (1 / MASS_A + 1 / MASS_B))
    text = HEAD.format(drive="").replace(" I 3 Y -0.05\n", "") + GEAR.format(b=2, more="")
    text += f" I 6 TORQUE N 1 AXIS 0 0 1 V {RADIUS_A * force!r}\n"
    text += f".SAM TYPE DYNAMIC RHO 0.9\n.SUB TF {2.5 * period!r} H {period / 200!r}\n.FIN 1\n"
    result = run(text, tmp_path)
    found = result["3/NORMAL_FORCE"] * cos(ALPHA)
    exact = mean * (1 - np.cos(2 * pi * result.t / period))
    assert found == pytest.approx(exact, rel=0, abs=2e-3 * mean)
    assert found.max() == pytest.approx(2 * mean, rel=1e-4)
    assert result["3/U_M"].max() == pytest.approx(2 * mean / STIFFNESS, rel=1e-4)


@pytest.mark.parametrize("load", LOADS)
def test_bounces(load: float, tmp_path: Path) -> None:
    """A flies onto a wheel that is held, from a distance s in the gap, and comes back there after
    both flights and the swing of the teeth between them."""
    force = load * NOMINAL
    distance = min(5 * force / STIFFNESS, 0.5 * BACKLASH)
    w, pull = sqrt(STIFFNESS / MASS_A), force / MASS_A
    speed = sqrt(2 * pull * distance)
    period = 2 * speed / pull + 2 / w * (pi - atan(speed * w / pull))
    text = HEAD.format(drive="").replace(" I 2 HINGE N 0 2 AXIS 0 0 1\n", "")
    text = text.replace(" I 5 INERTIA N 2 J 0.08\n", "").replace(" I 3 Y -0.05\n", "")
    text = (
        text.replace(" I 1\n I 2 X 0.15\n", " I 1 X 0.15\n")
        + GEAR.format(b=0, more="")
        + f" I 6 TORQUE N 1 AXIS 0 0 1 V {RADIUS_A * force!r}\n"
    )
    text += f".INI\n DEP NOEUD 1 C 6 V ({-distance / RADIUS_A!r}*180/PI) IMPOSED\n"
    text += f".SAM TYPE DYNAMIC RHO 0.9\n.SUB TF {3 * period!r} H {period / 400!r}\n.FIN 1\n"
    result = run(text, tmp_path)
    u = result["3/U_M"]
    assert u[[400, 800, 1200]] == pytest.approx(-distance, rel=1e-3)
    assert np.flatnonzero(np.diff(np.sign(np.diff(u))) > 0) == pytest.approx([399, 799], abs=1)
    deepest = force / STIFFNESS * (1 + sqrt(1 + (speed * w / pull) ** 2))
    assert u.max() == pytest.approx(deepest, rel=1e-3)
    assert np.abs(result["run/ENERGY_ERROR"]).max() < 1e-3 * force * (distance + deepest)


@pytest.mark.parametrize("step", ["2E-3", "2E-4", "2E-5", "2E-6"])
def test_start_without_load(step: str, tmp_path: Path) -> None:
    """Eight meshes of a gearbox just touch while its torques grow from nothing, so that at first rounding of
    places weighs more than the loads: no step fails, and the rotor gets the speed of its own inertia, 4e6, or
    of all of them, 4.87e6, as far as rounding of an angle over a step tells speeds apart."""
    deck = (DECKS / "trains/wind_turbine.dat").read_text()
    deck = deck[: deck.index(".SUB")].replace(" CM ", " JEU 1D-6 CM ")
    result = run(f"{deck}.SUB TF (60*{step}) H {step}\n.FIN 1\n", tmp_path, options=("-q",))
    end = result.t[-1]
    gained = 8e5 * (2.5 * end**4 - 3 * end**5 + end**6)  # integral of the torque
    noise = 64 * np.finfo(float).eps / float(step)
    assert gained / 4.87e6 * 0.99 - noise < result["1/SPEED"][-1] < gained / 4.0e6 * 1.01 + noise
