# SPDX-License-Identifier: BSD-3-Clause
"""Quasi-static parts of dynamic models: motions without mass that springs, dampers, gears hold. Each model
against the ordinary differential equation that remains when the balance of the massless part is solved by
hand or by scipy: positions and velocities are of order 2, from the first step on.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from runs import run
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

SCHEMES = ("RHO 0.8", "RHO 0", "SCHEME HHT")


def integrate(rate: Callable, start: list[float], t: np.ndarray) -> np.ndarray:
    done = solve_ivp(rate, (0, t[-1]), start, method="DOP853", t_eval=t, rtol=1e-12, atol=1e-14)
    return done.y


def springs_in_series(scheme: str, h: float) -> str:
    return f"""
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
 I 3 X 2 0 0
.MCE
 I 1 SPRING N 1 2 K 100
 I 2 SPRING N 2 3 K 100
 I 3 INERTIA N 3 M 1
.CLM
 FIX NOEUD 1 C 1 2 3
 FIX NOEUD 2 3 C 2 3
.INI
 VIT NOEUD 3 C 1 V 1
.SAM TYPE DYNAMIC {scheme} PREC 1e-12
.SUB TF 1 H {h}
.FIN 1
"""


def expect_series(t: np.ndarray) -> dict[str, np.ndarray]:
    w = np.sqrt(50)
    return {
        "node/2/UX": np.sin(w * t) / w / 2,
        "node/2/VX": np.cos(w * t) / 2,
        "node/3/UX": np.sin(w * t) / w,
    }


def dashpot_slider(scheme: str, h: float) -> str:
    return f"""
.FCT
 I 1 EXPR "sin(7*T + 0.3)"
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
.MCE
 I 1 SPRING N 1 2 K 100 C 30
.CLM
 FIX NOEUD 1 C 1 2 3
 FIX NOEUD 2 C 2 3
 CHA NOEUD 2 C 1 V 3 NF 1
.SAM TYPE DYNAMIC {scheme} PREC 1e-12
.SUB TF 1 H {h}
.FIN 1
"""


def expect_slider(t: np.ndarray) -> dict[str, np.ndarray]:
    def rate(time, x):
        return (3 * np.sin(7 * time + 0.3) - 100 * x) / 30

    x = integrate(rate, [0.0], t)[0]
    return {"node/2/UX": x, "node/2/VX": rate(t, x)}


def maxwell(scheme: str, h: float) -> str:
    """A mass on a damper on a spring, the massless node between them on an oblique line."""
    return f"""
.NOE
 I 1 X 0 0 0
 I 2 X 0.6 0.8 0
 I 3 X 1.2 1.6 0
.MCE
 I 1 SPRING N 1 2 K 100
 I 2 SPRING N 2 3 C 20
 I 3 INERTIA N 3 M 1
 I 4 POINT_LINE N 0 2 AXIS 0.6 0.8 0
 I 5 POINT_LINE N 0 3 AXIS 0.6 0.8 0
.CLM
 FIX NOEUD 1 C 1 2 3
.INI
 VIT NOEUD 3 C 1 2 V 0.6 0.8
.SAM TYPE DYNAMIC {scheme} PREC 1e-12
.SUB TF 1 H {h}
.FIN 1
"""


def expect_maxwell(t: np.ndarray) -> dict[str, np.ndarray]:
    # y: the massless node, x: the mass; 100 y = 20 (x' − y')
    def rate(_, s):
        y, _, v = s
        return [v - 5 * y, v, -100 * y]

    y, x, v = integrate(rate, [0, 0, 1], t)
    return {"node/2/UX": 0.6 * y, "node/3/UY": 0.8 * x, "node/2/VY": 0.8 * (v - 5 * y)}


def gear_train(scheme: str, h: float) -> str:
    """A rotor drives a pinion without inertia by a shaft; its teeth are elastic, the wheel has inertia."""
    return f"""
.FCT
 I 1 EXPR "sin(20*T)"
.NOE
 I 1 X 0 0 -1
 I 2 X 0 0 0
 I 3 X 0.09 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 HINGE N 0 3 AXIS 0 0 1
 I 4 TSPRING N 1 2 AXIS 0 0 1 K 50
 I 5 GEAR N 2 3 AXIS 0 0 1 Z 20 40 MN 0.003 ALPHA 20 KM 5e5
 I 6 INERTIA N 1 M 1 J 0.01
 I 7 INERTIA N 3 M 1 J 0.02
 I 8 TORQUE N 1 AXIS 0 0 1 V 1 NF 1
.SAM TYPE DYNAMIC {scheme} PREC 1e-12
.SUB TF 0.2 H {h / 10}
.FIN 1
"""


def expect_gears(t: np.ndarray) -> dict[str, np.ndarray]:
    r1, r2, shaft = 0.03, 0.06, 50.0
    mesh = 5e5  # N/m along the circumference

    def pinion(a, b):  # shaft (a − p) = mesh (p r1 + b r2) r1
        return (shaft * a - mesh * r1 * r2 * b) / (shaft + mesh * r1 * r1)

    def rate(time, s):
        a, va, b, vb = s
        p = pinion(a, b)
        f = mesh * (p * r1 + b * r2)
        return [va, (np.sin(20 * time) - shaft * (a - p)) / 0.01, vb, -f * r2 / 0.02]

    a, va, b, vb = integrate(rate, [0, 0, 0, 0], t)
    return {"node/2/RZ": pinion(a, b), "node/2/WZ": pinion(va, vb), "node/3/RZ": b}


def lever(scheme: str, h: float) -> str:
    """A bell crank of massless bodies on a torsion spring, its end node held to it by RIGID; a mass hangs on
    a spring from the end and slides along y. It starts out of balance: the crank jumps."""
    return f"""
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
 I 3 X 1 -1 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 TSPRING N 0 1 AXIS 0 0 1 K 40
 I 3 RIGID N 1 2
 I 4 SPRING N 2 3 K 60 L0 0.7
 I 5 INERTIA N 3 M 1
.CLM
 FIX NOEUD 3 C 1 3
 STRU ACC VAL 0 -9.81 0
.SAM TYPE DYNAMIC {scheme} PREC 1e-12
.SUB TF 1 H {h}
.FIN 1
"""


def expect_lever(t: np.ndarray) -> dict[str, np.ndarray]:
    def pull(turn, y):
        end = np.array([np.cos(turn), np.sin(turn)])
        along = np.array([1.0, y]) - end
        length = np.hypot(*along)
        force = 60 * (length - 0.7) * along / length  # on the end of the crank
        return end[0] * force[1] - end[1] * force[0], force[1]

    def crank(y):
        return brentq(lambda turn: pull(turn, y)[0] - 40 * turn, -1.5, 1.0, xtol=1e-15, rtol=1e-15)

    y, v = integrate(lambda _, s: [s[1], -9.81 - pull(crank(s[0]), s[0])[1]], [-1, 0], t)
    turn = np.array([crank(place) for place in y])
    slope = np.array([(crank(p + 1e-5) - crank(p - 1e-5)) / 2e-5 for p in y])
    return {"node/3/UY": y + 1, "node/1/RZ": turn, "node/1/WZ": slope * v, "node/2/UY": np.sin(turn)}


MODELS = {
    "springs_in_series": (springs_in_series, expect_series),
    "dashpot_slider": (dashpot_slider, expect_slider),
    "maxwell": (maxwell, expect_maxwell),
    "gear_train": (gear_train, expect_gears),
    "lever": (lever, expect_lever),
}


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("model", MODELS)
def test_order(model: str, scheme: str, tmp_path: Path) -> None:
    deck, expect = MODELS[model]
    errors: dict[str, list[float]] = {}
    for h in (0.01, 0.005):
        result = run(deck(scheme, h), tmp_path)
        for name, expected in expect(result.t).items():
            size = np.abs(expected).max()
            errors.setdefault(name, []).append(np.abs(result[name] - expected).max() / size)
    for name, (coarse, fine) in errors.items():
        assert fine < 1e-2, (name, coarse, fine)
        assert np.log2(coarse / fine) > 1.8, (name, coarse, fine)


def test_a_slider_that_only_a_damper_slows(tmp_path: Path) -> None:
    """It gives way within a step, so that its accelerations are softened: they began at 0, and swung."""
    deck = dashpot_slider("", 2e-4).replace("C 30", "C 1").replace("sin(7*T + 0.3)", "1")
    result = run(deck.replace("TF 1", "TF 0.05"), tmp_path)
    assert result["node/2/AX"] == pytest.approx(-300 * np.exp(-100 * result.t), abs=2)
