# SPDX-License-Identifier: BSD-3-Clause
"""Followers that touch a cam at several places: a detent, a flat face on two hills, a pin in a slot."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import run
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, minimize_scalar

DECKS = Path(__file__).parents[2] / "decks"
TURN = 2 * np.pi
K, ROLLER = 1e9, 0.012


def cut(deck: Path) -> str:
    """The deck without its checks and what follows them."""
    return deck.read_text().split(".CHK")[0]


def detent_profile() -> CubicSpline:
    text = (DECKS / "elements/cams/cam_detent.dat").read_text()
    polar = np.array(text.split("POLAR\n")[1].split("I 4")[0].split(), dtype=float).reshape(-1, 2)
    angle, radius = np.radians(polar[:, 0]), polar[:, 1]
    return CubicSpline(np.append(angle, TURN), np.append(radius, radius[0]), bc_type="periodic")


def pressed(profile: CubicSpline, x: float, turn: float) -> tuple[float, float]:
    """Force along the slide and torque on the wheel, which has turned, by the roller at x: every valley of
    its distance from the profile that is less than its radius presses."""

    def distance(s: float) -> float:
        return float(abs(profile(s % TURN) * np.exp(1j * (s + turn)) - x))

    s = np.linspace(-0.5, 0.5, 2001) - turn
    d = abs(profile(s % TURN) * np.exp(1j * (s + turn)) - x)
    force = torque = 0.0
    for k in np.flatnonzero((d[1:-1] < d[:-2]) & (d[1:-1] <= d[2:])) + 1:
        found = minimize_scalar(
            distance, bounds=(s[k - 1], s[k + 1]), method="bounded", options={"xatol": 1e-12}
        )
        push = K * max(ROLLER - found.fun, 0)
        place = profile(found.x % TURN) * np.exp(1j * (found.x + turn))
        normal = (x - place) / found.fun
        force += push * normal.real
        torque -= push * (np.conj(place) * normal).imag
    return force, torque


def test_detent_past_its_hill(tmp_path: Path) -> None:
    """The wheel is turned by a pitch: the roller leaves one flank at once, climbs the other and falls into
    the next notch, where both press again."""
    text = cut(DECKS / "elements/cams/cam_detent.dat")
    text = text.replace("I 1 HINGE N 0 1 AXIS 0 0 1\n", "I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE NF 1\n")
    text = text.split(" I 4 TORQUE")[0] + (
        ".FCT\n I 1 TABLE 0 0  1 (PI/4)\n.SAM TYPE STATIC\n.SUB TF 1 H 0.02\n.FIN 1\n"
    )
    done = run(text, tmp_path)
    profile = detent_profile()
    seat = 0.0401401884392817
    for t, slide, torque, second in zip(
        done.t, done["2/SLIDE"], done["1/DRIVE_TORQUE"], done["3/NORMAL_FORCE_2"], strict=True
    ):
        turn = np.pi / 4 * t

        def balance(x: float, turn: float = turn) -> float:
            return pressed(profile, x, turn)[0] - 5000 * (0.01 + x - seat)

        x = brentq(balance, seat - 1e-4, seat + 6e-3, xtol=1e-15)
        assert slide == pytest.approx(x - seat, abs=1e-9), t
        assert torque == pytest.approx(-pressed(profile, x, turn)[1], abs=1e-5), t
        assert (second > 0) == (t in (0, 1)), t
    assert done["3/NORMAL_FORCE_2"][-1] == pytest.approx(
        25 / np.cos(np.radians(17.949763873497346)), rel=1e-4
    )


FACE = """
.NOE
 I 1 X 0 0 0
 I 2 X 0 1.2 0
.MCE
 I 1 CAM N 0 2 AXIS 0 0 1 CENTER 0 0 0 ZERO 1 0 0 FOLLOWER FLAT NORMAL 0 1 0 K 1D7 POLAR
   {polar}
 I 2 INERTIA N 2 M 1 J 0.1
.CLM
 FIX NOEUD 2 C 1 3 4 5
 CHA NOEUD 2 C 2 V -100 NF 1
 CHA NOEUD 2 C 6 V {moment} NF 1
.FCT
 I 1 TABLE 0 1  1 1
.SAM TYPE STATIC
.SUB TF 1 H 1
.FIN 1
"""


@pytest.mark.parametrize("aside", [0.0, 0.1, -0.2])
def test_a_face_rests_on_two_hills(aside: float, tmp_path: Path) -> None:
    """By the balance of forces and moments on two springs, whose places the profile gives."""
    angle = np.arange(0, 360, 5)
    radius = 1 - 0.3 * np.cos(4 * np.radians(angle))  # hills at 45 degrees and so on
    polar = "\n   ".join(f"{a} {r:.15g}" for a, r in zip(angle, radius, strict=True))
    done = run(FACE.format(polar=polar, moment=-100 * aside), tmp_path)
    curve = CubicSpline(np.radians(np.append(angle, 360)), np.append(radius, radius[0]), bc_type="periodic")
    top = minimize_scalar(lambda s: -curve(s) * np.sin(s), bounds=(0.5, 1.2), method="bounded")
    lever = curve(top.x) * np.cos(top.x)
    forces = np.sort([50 * (1 + aside / lever), 50 * (1 - aside / lever)])[::-1]
    assert done["1/NORMAL_FORCE"][-1] == pytest.approx(forces[0], rel=1e-4)
    assert done["1/NORMAL_FORCE_2"][-1] == pytest.approx(forces[1], rel=1e-4)
    assert done["1/FORCE_Y"][-1] == pytest.approx(100, rel=1e-9)  # PREC


@pytest.mark.parametrize(
    ("step", "damping"), [("5D-4", "0.8"), ("1D-3", "0.8"), ("2D-3", "0.8"), ("1D-4", "0")]
)
def test_a_pin_between_the_walls_of_its_slot(step: str, damping: str, tmp_path: Path) -> None:
    """With the deepest contact alone the force jumped from wall to wall; these runs lost their energy balance
    from 0.5 ms on, and with RHO 0."""
    text = (DECKS / "mechanisms/geneva_index.dat").read_text()
    assert "H 1D-4" in text and "RHO 0.8" in text
    run(text.replace("H 1D-4", f"H {step}").replace("RHO 0.8", f"RHO {damping}"), tmp_path)  # with its checks
