# SPDX-License-Identifier: BSD-3-Clause
"""Load steps that follow their error (.SUB TOL of STATIC), and corners of functions of time."""

from pathlib import Path

import numpy as np
import pytest
from runs import Run, run
from scipy.optimize import brentq

LEVER = """
.NOE
 I 1 X 1 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0 K 30
 I 2 INERTIA N 1 M 2 J 0.1
 I 3 TORQUE N 1 AXIS 0 0 1 V 150 NF 1
.FCT
 I 1 {function}
.CLM
 STRU ACC VAL 0 {gravity} 0
.SAM TYPE STATIC SOLVER KLU
.SUB TF 1 H 0.002 {control}
.FIN 1
"""
CORNERS = ([0, 0.2137, 0.6, 0.9], [0, 1, -0.4, 0.7])
FUNCTIONS = {
    "smooth": ('EXPR "SIN(6*T)*T"', lambda t: np.sin(6 * t) * t),
    "corners": (
        "TABLE " + "  ".join(f"{x} {y}" for x, y in zip(*CORNERS, strict=True)),
        lambda t: np.interp(t, *CORNERS),
    ),
}


def lever(function: str, control: str, gravity: float = -9.81) -> str:
    return LEVER.format(function=FUNCTIONS[function][0], control=control, gravity=gravity)


def equilibria(function: str, times: np.ndarray) -> np.ndarray:
    """Angle of the lever: K angle + m g l cos(angle) = moment, which grows with the angle for K > m g l."""
    course = FUNCTIONS[function][1]

    def angle(t: float) -> float:
        return brentq(lambda a: 30 * a + 19.62 * np.cos(a) - 150 * course(t), -20, 20, xtol=1e-14)

    return np.array([angle(t) for t in times])


def error(result: Run, function: str) -> float:
    truth = equilibria(function, result.t)
    return max(
        np.abs(result["1/ANGLE"] - truth).max() / np.ptp(truth),
        np.abs(result["node/1/UX"] - (np.cos(truth) - 1)).max() / 2,
        np.abs(result["1/FORCE_Y"]).max() / 19.62 - 1,  # carries the weight, whatever the angle
    )


def steps(folder: Path) -> int:
    listing = (folder / "deck.lst").read_text(encoding="utf-8")
    return int(listing[: listing.rindex(" steps, ")].split()[-1])


@pytest.mark.parametrize("function", FUNCTIONS)
def test_results_between_equilibria_are_as_good_as_the_tolerance(function: str, tmp_path: Path) -> None:
    taken = []
    for tolerance in (1e-3, 1e-4, 1e-5):
        result = run(lever(function, f"TOL {tolerance}"), tmp_path)
        assert result.t == pytest.approx(np.arange(501) * 0.002, abs=1e-12)
        assert error(result, function) < tolerance
        taken.append(steps(tmp_path))
    assert taken[0] < 200  # of 500 fixed ones
    assert (
        taken[0] < taken[1] < taken[2] < 2.8 * taken[0]
    )  # errors go with the fourth power of the steps: 3.2
    assert error(run(lever(function, ""), tmp_path), function) < 1e-9


@pytest.mark.parametrize(("scheme", "accuracy"), [("CHUNG", 1e-2), ("RADAU", 1e-6)])
def test_a_short_pulse_is_met_by_a_body_at_rest(scheme: str, accuracy: float, tmp_path: Path) -> None:
    """A block of mass 2 gets an impulse of 3e-5 at t = 0.7131 while steps are as long as they may be."""
    deck = f"""
.NOE
 I 1
.MCE
 I 1 INERTIA N 1 M 2 J 1
 I 2 SPRING N 0 1 K 1E-9 AT 1 0 0
.FCT
 I 1 TABLE 0.7131 0  0.71311 3  0.71312 0
.CLM
 CHA NOEUD 1 C 1 V 1 NF 1
.SAM TYPE DYNAMIC SCHEME {scheme}
.SUB TF 1 H 0.1 TOL 1E-4 HMAX 0.5
.FIN 1
"""
    result = run(deck, tmp_path)
    assert result["node/1/VX"][-1] == pytest.approx(1.5e-5, rel=accuracy)
