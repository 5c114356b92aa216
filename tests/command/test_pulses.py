# SPDX-License-Identifier: BSD-3-Clause
"""Steps of a fixed length pass over pulses of functions that are shorter; a warning says so."""

import math

import numpy as np
import pytest
from engrane_post import Results

DECK = """.NOE
 I 1 X 1 0 0
.MCE
 I 1 INERTIA N 1 M 1 J 0.1 0.1 0.1
.CLM
 CHA NOEUD 1 C 1 V 1 NF 1
.FCT
 I 1 {function}
.SAM TYPE DYNAMIC {sam}
.SUB TF 1 H 0.01 {sub}
.FIN 1
"""
SMOOTH = "3*exp(-((T-0.3037)/0.0005)**2)"
PULSE = "0 0 0.302 0 0.303 5 0.304 5 0.305 0"


@pytest.mark.parametrize(
    ("function", "sam", "sub", "said"),
    [
        (f"TABLE {PULSE}", "", "", True),
        (f"TABLE {PULSE.replace('5', '-5').replace('30-5', '305')}", "", "", True),
        (f"TABLE {PULSE}", "", "TOL 1E-4", False),
        (f"TABLE {PULSE}", "ACCURACY FAST", "", False),
        ("TABLE 0 0 0.302 0 0.3021 5", "", "", False),  # a jump, which the next steps see
        ("TABLE 0 0 0.302 0 0.402 5 0.502 0", "", "", False),
        (f'EXPR "{SMOOTH}"', "", "", True),
        (f'EXPR "sin(9*T)+{SMOOTH}"', "", "", True),
        (f'EXPR "{SMOOTH}"', "", "TOL 1E-4", False),
        ('EXPR "3*sin(700*T)"', "", "", False),
    ],
)
def test_short_pulses(engrane, function, sam, sub, said):
    (engrane.folder / "x.dat").write_text(DECK.format(function=function, sam=sam, sub=sub), encoding="utf-8")
    done = engrane("check", "x.dat")
    assert done.returncode == 0, done.stderr
    assert ("the step from 0.3 to 0.31 passes over that" in done.stdout + done.stderr) == said


@pytest.mark.parametrize("level", ["FAST", "NORMAL", "FINE"])
@pytest.mark.parametrize("shape", ["", "0.1*sin(9*T)+"])
def test_steps_that_follow_their_error_do_not_miss_smooth_pulses(engrane, level, shape):
    """The run and its companion both stepped over it: no motion, and an error estimated at nothing. The body
    of mass 1 ends with the impulse as its velocity, the integral of the force."""
    deck = DECK.format(function=f'EXPR "{shape}{SMOOTH}"', sam=f"ACCURACY {level}", sub="")
    (engrane.folder / "x.dat").write_text(deck, encoding="utf-8")
    done = engrane("x.dat", "-q")
    assert done.returncode == 0, done.stderr
    impulse = 3 * 0.0005 * math.sqrt(math.pi)
    if shape:
        impulse += 0.1 * (1 - math.cos(9)) / 9
    with Results(engrane.folder / "x.h5") as results:
        assert results.history("node/1/VX")[1][-1] == pytest.approx(impulse, rel=1e-3)


def test_a_longest_step_beside_accuracy(engrane):
    """HMAX was refused: "there is no TOL", which ACCURACY chooses."""
    deck = DECK.format(function='EXPR "1"', sam="ACCURACY FAST", sub="HMAX 0.004")
    (engrane.folder / "x.dat").write_text(deck, encoding="utf-8")
    assert engrane("x.dat", "-q").returncode == 0
    with Results(engrane.folder / "x.h5") as results:
        assert np.max(results.history("run/STEP")[1]) <= 0.004


def test_a_smooth_pulse_out_of_the_plane_is_seen(engrane):
    """PLANE AUTO looks at the times when functions are largest."""
    deck = DECK.format(function=f'EXPR "{SMOOTH}"', sam="PLANE AUTO", sub="TOL 1E-4")
    (engrane.folder / "x.dat").write_text(deck.replace("NOEUD 1 C 1", "NOEUD 1 C 3"), encoding="utf-8")
    assert engrane("x.dat", "-q").returncode == 0
    with Results(engrane.folder / "x.h5") as results:
        assert abs(results.history("node/1/UZ")[1][-1]) > 1e-4


@pytest.mark.parametrize("width", [3e-3, 3e-5, 3e-7])
def test_steep_changes_of_a_formula(engrane, width):
    """A load that turns round seven times, each within a few samples of the run, or within far less than one.
    The run and its companion passed each in one step: acceleration off by 1.6e-3 of its range, energy of the
    spring by 1.5e-3, and the load itself, a function of time, by 1.1e-2 between steps."""
    deck = f""".NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
.FCT
 I 1 EXPR "TANH(SIN(21*T)/{width})"
.MCE
 I 1 INERTIA N 2 M 2 J 0.1 0.1 0.1
 I 2 SPRING N 1 2 K 800 C 4
.CLM
 FIX N 1 C 1 2 3 4 5 6
 CHA NOE 2 C 1 V 10 NF 1
.SAM TYPE DYNAMIC ACCURACY NORMAL SOLVER KLU
.SUB TF 1 H 0.01
.FIN 1
"""
    (engrane.folder / "x.dat").write_text(deck, encoding="utf-8")
    done = engrane("x.dat", "-q")
    assert done.returncode == 0, done.stderr
    with Results(engrane.folder / "x.h5") as results:
        t, load = results.history("element/3/FORCE_X")
        found = {
            name: results.history(name)[1] for name in ("node/2/UX", "node/2/AX", "element/2/SPRING_ENERGY")
        }

    # exactly, with loads of ±10 from each change to the next: the change has a width of `width`/21 only
    def force(time):
        return 10 * np.tanh(np.sin(21 * time) / width)

    x, v, last = np.zeros_like(t), np.zeros_like(t), 0.0
    state = np.zeros(2)
    decay, swing = 1.0, math.sqrt(800 / 2 - 1)
    for k in range(8):
        change = min((k + 1) * math.pi / 21, 1.0)
        rest = (-1) ** k * 10 / 800
        inside = (last <= t) & (t <= change)
        for times, keep in ((t[inside], True), (np.array([change]), False)):
            s = times - last
            a, b = state[0] - rest, (state[1] + decay * (state[0] - rest)) / swing
            at = rest + np.exp(-decay * s) * (a * np.cos(swing * s) + b * np.sin(swing * s))
            rate = np.exp(-decay * s) * (
                (swing * b - decay * a) * np.cos(swing * s) - (swing * a + decay * b) * np.sin(swing * s)
            )
            if keep:
                x[inside], v[inside] = at, rate
            else:
                state = np.array([at[0], rate[0]])
        last = change
    expected = {
        "node/2/UX": x,
        "node/2/AX": (force(t) - 800 * x - 4 * v) / 2,
        "element/2/SPRING_ENERGY": 400 * x**2,
    }
    assert load == pytest.approx(force(t), abs=1e-9)
    for name, values in found.items():
        error = np.sqrt(np.mean((values - expected[name]) ** 2)) / np.ptp(expected[name])
        assert error < 1e-3, (name, error)
