# SPDX-License-Identifier: BSD-3-Clause
"""Steps from a hundredth to a billionth of a period: positions, speeds and reactions against closed form or
an integration by scipy (docs/extremes.md). Multipliers of a scheme with constraints at index 3 are second
differences of positions over the step; they keep their digits because constraints are closed by their change
(decision 21)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import Run, run
from scipy.integrate import solve_ivp
from small_decks import GEAR_PAIR

G = 9.81
ANY_STEP = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9]
SHORT = [1e-5, 1e-6, 1e-7, 1e-8, 1e-9]

PENDULUM = """
.NOE
 I 1 X {x} 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 0 AT {far} 0 0
 I 2 INERTIA N 1 M 2 J 0.1
.CLM STRU ACC VAL 0 0 -9.81
.INI VIT NOEUD 1 C 3 5 V {speed} -{speed}
.SAM TYPE DYNAMIC RHO {rho} SOLVER KLU
.SUB TF {end!r} H {h!r}
.SAI HISTORY DT {sample!r}
.FIN 1
"""
TURNING = 2 * 1 + 0.1  # about the hinge, of 2 kg at a distance of 1

CRANK = """
.NOE
 I 1 X {ax!r} Y {ay!r}
 I 2 X {bx!r}
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0 DRIVE ANGLE NF 1
 I 2 DISTANCE N 1 2
 I 3 PRISMATIC N 0 2 AXIS 1 0 0
 I 4 INERTIA N 2 M 1 J 0.1
 I 5 INERTIA N 1 M 0.5 J 0.01
.FCT
 I 1 EXPR "6*T + 0.5*T*T"
.SAM TYPE DYNAMIC RHO 0.8 SOLVER KLU
.SUB TF {end!r} H {h!r}
.SAI HISTORY DT 0
.FIN 1
"""


def pendulum(
    h: float, folder: Path, steps: int = 100, speed: float = 6, far: float = 0, rho: float = 0.8
) -> Run:
    text = PENDULUM.format(
        x=far + 1, far=far, speed=speed, rho=rho, h=h, end=steps * h, sample=h * max(1, steps // 1000)
    )
    return run(text, folder)


def exact_pendulum(t: np.ndarray, speed: float) -> tuple[np.ndarray, ...]:
    """Angle from x downwards (counted negative), its rate, and the hinge's force along x and z."""
    swings = solve_ivp(
        lambda _, s: [s[1], 2 * G * np.cos(s[0]) / TURNING],
        (0, t[-1]),
        [0, -speed],
        method="DOP853",
        rtol=1e-13,
        atol=1e-14 * max(speed, 1e-3) * t[-1],
        t_eval=t,
    )
    angle, rate = swings.y
    grows = 2 * G * np.cos(angle) / TURNING
    along = 2 * (-np.cos(angle) * rate**2 - np.sin(angle) * grows)
    up = 2 * (G - np.cos(angle) * grows + np.sin(angle) * rate**2)
    return angle, rate, along, up


def errors_of_pendulum(result: Run, speed: float) -> tuple[float, float, float]:
    """Of the angle and the rate over their largest, of the force over its largest."""
    angle, rate, along, up = exact_pendulum(result.t, speed)
    force = max(np.abs(along).max(), np.abs(up).max())
    off = max(
        np.abs(np.abs(result["1/FORCE_X"]) - np.abs(along)).max(),
        np.abs(np.abs(result["1/FORCE_Z"]) - np.abs(up)).max(),
    )
    return (
        np.abs(result["1/ANGLE"] - angle).max() / np.abs(angle).max(),
        np.abs(result["1/SPEED"] - rate).max() / np.abs(rate).max(),
        off / force,
    )


@pytest.mark.parametrize("h", ANY_STEP)
def test_pendulum(h: float, tmp_path: Path) -> None:
    angle, rate, force = errors_of_pendulum(pendulum(h, tmp_path), 6)
    assert angle < max(4 * h * h, 1e-14)
    assert rate < max(4 * h * h, 1e-14)
    assert force < max(5 * h * h, 3e-7)


@pytest.mark.parametrize("rho", [0, 0.5, 0.9])
def test_pendulum_with_more_or_less_damping(rho: float, tmp_path: Path) -> None:
    assert errors_of_pendulum(pendulum(1e-9, tmp_path, rho=rho), 6)[2] < 5e-7


def test_pendulum_for_many_short_steps(tmp_path: Path) -> None:
    """What is left open by the sums of changes does not grow, nor does the noise of the reaction."""
    result = pendulum(1e-8, tmp_path, steps=20000)
    angle, rate, force = errors_of_pendulum(result, 6)
    assert angle < 1e-12
    assert rate < 1e-12
    assert force < 5e-7
    assert np.abs(np.hypot(result["node/1/UX"] + 1, result["node/1/UZ"]) - 1).max() < 1e-15


@pytest.mark.parametrize("h", SHORT)
def test_increments_below_the_rounding_of_positions(h: float, tmp_path: Path) -> None:
    """From rest, one place 1 away from the origin moves by less than its rounding in each step: nothing of
    that is lost."""
    deck = f"""
.NOE
 I 1 X 1
.MCE
 I 1 INERTIA N 1 M 2
 I 2 FORCE N 1 DIR 1 0 0 V 6
.CLM FIX NOEUD 1 C 2 3
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF {100 * h!r} H {h!r}
.SAI HISTORY DT 0
.FIN 1
"""
    result = run(deck, tmp_path)
    assert result["node/1/UX"][1:] == pytest.approx(1.5 * result.t[1:] ** 2, rel=1e-12)
    result = pendulum(h, tmp_path, speed=0)
    grows = 2 * G / TURNING
    assert result["1/ANGLE"][1:] == pytest.approx(grows * result.t[1:] ** 2 / 2, rel=1e-9)
    assert np.abs(result["1/FORCE_Z"]) == pytest.approx(2 * (G - grows), rel=1e-8)


@pytest.mark.parametrize("far", [1e3, 1e6])
@pytest.mark.parametrize("h", [1e-2, 1e-3, 1e-4])
def test_pendulum_far_from_the_origin(h: float, far: float, tmp_path: Path) -> None:
    """The same angles and forces as at the origin: to 1e-9 and 1e-6 in a machine 1e3 lengths away."""
    here, there = pendulum(h, tmp_path), pendulum(h, tmp_path, far=far)
    assert np.abs(here["1/ANGLE"] - there["1/ANGLE"]).max() < 1e-15 * far
    for channel in ("FORCE_X", "FORCE_Z"):
        size = np.abs(here[f"1/{channel}"]).max()
        assert np.abs(here[f"1/{channel}"] - there[f"1/{channel}"]).max() < max(1e-6, 1e-11 * far) * size


@pytest.mark.parametrize("h", ANY_STEP)
def test_slider_crank(h: float, tmp_path: Path) -> None:
    """Crank 0.1, rod 0.3, driven from 40 degrees on: the slider, the rod's force on it and the torque."""
    r, rod, begin = 0.1, 0.3, np.radians(40)
    ax, ay = float(r * np.cos(begin)), float(r * np.sin(begin))
    bx = ax + float(np.sqrt(rod**2 - ay**2))
    text = CRANK.format(ax=ax, ay=ay, bx=bx, h=h, end=100 * h)
    result = run(text, tmp_path)
    t = result.t
    angle, rate, grows = begin + 6 * t + 0.5 * t * t, 6 + t, 1.0
    s, c = r * np.sin(angle), r * np.cos(angle)
    q = np.sqrt(rod**2 - s**2)
    slope = -s - s * c / q
    bend = -c - (c * c - s * s) / q - s * s * c * c / q**3
    pushes = 1 * (slope * grows + bend * rate**2)
    off = np.abs(np.abs(result["2/FORCE_X"]) - np.abs(pushes)).max() / np.abs(pushes).max()
    # velocities are rounded too, and accelerations are their differences over h
    tolerance = max(40 * h * h, 1e-6, 5e-15 / h)
    assert off < tolerance
    moved = c + q - bx
    assert np.abs(result["node/2/UX"] - moved).max() < 4e-16
    torque = (0.01 + 0.5 * r * r) * grows + pushes * slope
    assert np.abs(result["1/DRIVE_TORQUE"] - torque).max() < 4 * tolerance * np.abs(torque).max()


@pytest.mark.parametrize("h", ANY_STEP)
def test_gear_pair(h: float, tmp_path: Path) -> None:
    """Rigid teeth under a constant torque: the force on the flanks, wheels that turn since long."""
    deck = f"""{GEAR_PAIR}\
 I 6 TORQUE N 1 AXIS 0 0 1 V 5
.INI VIT ELEMENT 1 V 40
.SAM TYPE DYNAMIC RHO 0.8 SOLVER KLU
.SUB TF {100 * h!r} H {h!r}
.SAI HISTORY DT 0
.FIN 1
"""
    result = run(deck, tmp_path)
    t = result.t
    grows = 5 / (1e-3 + 1e-2 / 4)
    circumference = 1e-2 * grows / 2 / 0.06
    assert np.abs(result["1/ANGLE"] - (40 * t + grows * t * t / 2)).max() <= 1e-14 * max(1, 40 * t[-1])
    force = np.abs(result["3/NORMAL_FORCE"]) * np.cos(np.radians(20))
    assert np.abs(force / circumference - 1).max() < 1e-6


# crank and rod without mass, as in decks/mechanisms/slider_crank.dat
MASSLESS = """
.NOE
 I 1 X 0 0 0
 I 2 X (0.2 + sqrt(0.35)/2) 0 0.05
 I 3 X (0.2 + sqrt(0.35)) 0 0.1
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 2 SPHERICAL N 1 2 AT 0.2 0 0
 I 3 UNIVERSAL N 3 2 AXIS 0 1 0 AXIS2 -0.1 0 (sqrt(0.35)) AT (0.2 + sqrt(0.35)) 0 0.1
 I 4 PRISMATIC N 0 3 AXIS 1 0 0
 I 5 INERTIA N 3 M 3
.FCT
 I 1 EXPR "10"
.INI
 VIT NOEUD 1 C 6 V 10
.SAM TYPE DYNAMIC RHO {rho} SOLVER KLU
.SUB TF {end!r} H {h!r}
.FIN 1
"""


@pytest.mark.parametrize("rho", [0, 0.8, 0.9])
@pytest.mark.parametrize("h", [1e-4, 2e-5, 1e-6, 1e-8])
def test_massless_links(h: float, rho: float, tmp_path: Path) -> None:
    """m x'' of the slider, six digits: joints between massless parts had none of its mass, and the errors of
    several steps add up."""
    result = run(MASSLESS.format(rho=rho, h=h, end=500 * h), tmp_path)
    a = 10 * result.t
    root = np.sqrt(0.35 - 0.04 * np.sin(a) ** 2)
    curve = -0.2 * np.cos(a) - 0.04 * np.cos(2 * a) / root - (0.04 * np.sin(a) * np.cos(a)) ** 2 / root**3
    force = 3 * 100 * curve
    scheme = 3 * (10 * h) ** 2 if rho == 0 else 0.5 * (10 * h) ** 2
    off = result["2/FORCE_X"] - force
    assert np.sqrt(np.mean(off**2)) < (1e-6 + scheme) * np.abs(force).max()
