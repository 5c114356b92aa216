# SPDX-License-Identifier: BSD-3-Clause
"""Rigid benchmarks of the IFToMM library and classics, at stated steps and with the order of convergence.

The numbers are the library's; those of the heavy top and of the free body are checked here once more by
integrating Euler's equations with scipy, which shares nothing with the program. docs/verification.md has them
in one table.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from runs import run
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation


def four_bars(n: int, h: float, end: float, x: float) -> str:
    """2 n + 1 slender links of 1 m and 1 kg in a plane: n + 1 arms on the ground, n bars between their ends.
    Pins in a plane are points on lines across it, and no constraint repeats another."""
    nodes, masses, joints, speeds = [], [], [], []
    for i in range(n + 1):
        nodes.append(f" I {1 + i} X {i} 0 0")
        masses.append(f" I {1 + i} INERTIA N {1 + i} M 1 J (1/12) (1/12) (1/12) OFFSET 0 0.5 0")
        joints.append(f" I {201 + i} POINT_LINE N 0 {1 + i} AXIS 0 0 1")
        speeds.append(f" VIT NOEUD {1 + i} C 6 V -1")
    for i in range(n):
        nodes.append(f" I {101 + i} X {i} 1 0")
        masses.append(f" I {101 + i} INERTIA N {101 + i} M 1 J (1/12) (1/12) (1/12) OFFSET 0.5 0 0")
        joints.append(f" I {301 + i} POINT_LINE N {1 + i} {101 + i} AXIS 0 0 1")
        joints.append(f" I {401 + i} POINT_LINE N {2 + i} {101 + i} AXIS 0 0 1 AT {i + 1} 1 0")
        speeds.append(f" VIT NOEUD {101 + i} C 1 V 1 IMPOSED")
    lines = [".NOE", *nodes, ".SEL", " GROUP 1 NOEUDS TOUT", ".MCE", *masses, *joints]
    lines += [".CLM", " STRU ACC VAL 0 -9.81 0", " FIX GROUP 1 C 3 4 5", ".INI", *speeds]
    lines += [
        ".SAM TYPE DYNAMIC RHO 0.9 SOLVER KLU",
        f".SUB TF {end} H {h}",
        ".CHK",  # which also asks for the histories of this node
        f" NODE 101 UX V {x} ATOL 0.01",
    ]
    return "\n".join(lines) + "\n"


def orders(errors: list[float]) -> list[float]:
    return [float(np.log2(a / b)) for a, b in pairwise(errors)]


# IFToMM A02: B0 at the end; each error a little above what is measured at the finer step.
@pytest.mark.parametrize(
    ("n", "end", "steps", "x", "y", "allowed"),
    [
        (2, 1, (0.004, 0.002), -0.195020301950, -0.980799205662, 8e-5),
        (2, 10, (0.004, 0.002), 0.328458111536, 0.944518538180, 1.5e-4),
        (40, 10, (0.008, 0.004), 0.180512226684, 0.983572740583, 5e-4),
    ],
)
def test_n_four_bar(tmp_path, n, end, steps, x, y, allowed):
    errors = []
    for h in steps:
        r = run(four_bars(n, h, end, x), tmp_path, timeout=600)
        errors.append(float(np.hypot(r["node/101/UX"][-1] - x, r["node/101/UY"][-1] + 1 - y)))
    print(f"N = {n}, t = {end}:", dict(zip(steps, errors, strict=True)), orders(errors))
    assert errors[-1] < allowed
    assert orders(errors)[0] == pytest.approx(2, abs=0.1)


def pendulum(h: float, end: float) -> str:
    return f"""
.NOE
 I 1 X -1 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0
 I 2 INERTIA N 1 M 1
.CLM
 STRU ACC VAL 0 -9.81 0
.SAM TYPE DYNAMIC RHO 0.9 SOLVER KLU
.SUB TF {end} H {h}
"""


@pytest.mark.parametrize(
    ("end", "x", "y", "allowed"),
    [
        (1, 0.98629175113188, -0.16501085312554, 1.5e-5),
        (10, -0.27508746257612, -0.96141920509913, 2e-4),
    ],
)
def test_pendulum(tmp_path, end, x, y, allowed):
    errors = []
    for h in (0.002, 0.001):
        r = run(pendulum(h, end), tmp_path)
        errors.append(float(np.hypot(r["node/1/UX"][-1] - 1 - x, r["node/1/UY"][-1] - y)))
    print(f"A01, t = {end}:", errors, orders(errors))
    assert errors[-1] < allowed and orders(errors)[0] == pytest.approx(2, abs=0.1)


MASS, G, ARM = 15.0, np.array([0, 0, -9.81]), np.array([0, 1.0, 0])
J_CENTRE = np.diag([0.234375, 0.46875, 0.234375])
J_TIP = J_CENTRE + MASS * (ARM @ ARM * np.eye(3) - np.outer(ARM, ARM))


def spin_up(inertia: np.ndarray, moment, w0, end: float):
    """Quaternion (x, y, z, w) and material angular velocity from Euler's equations."""

    def slope(_, y):
        q, w = y[:4], y[4:]
        turn = Rotation.from_quat(q)
        dq = 0.5 * np.append(q[3] * w + np.cross(q[:3], w), -q[:3] @ w)
        return np.concatenate([dq, np.linalg.solve(inertia, moment(turn) - np.cross(w, inertia @ w))])

    start = np.concatenate([[0, 0, 0, 1.0], w0])
    y = solve_ivp(slope, (0, end), start, method="DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    return Rotation.from_quat(y[:4]), y[4:], slope(0, y)[4:]


def test_heavy_top(tmp_path):
    """Order 2 in position, rotation, velocity, angular velocity and multiplier (force at the tip)."""
    w0 = np.array([0, 150, -4.61538])
    turn, w, dw = spin_up(J_TIP, lambda r: np.cross(ARM, MASS * r.inv().apply(G)), w0, 1.0)
    centre, spin = turn.apply(ARM), turn.apply(w)
    np.testing.assert_allclose(centre, [0.17334396410, 0.64008859207, -0.74849079113], atol=1e-9)
    acceleration = turn.apply(np.cross(dw, ARM) + np.cross(w, np.cross(w, ARM)))
    force = MASS * (acceleration - G)
    assert 0.5 * w0 @ J_TIP @ w0 == pytest.approx(5435.6967908655, rel=1e-12)

    errors = {name: [] for name in ("x", "R", "v", "W", "lambda")}
    for h in (2e-4, 1e-4):
        r = run(
            f"""
.NOE
 I 1 X 0 0 0
 I 2 X 0 1 0
.MCE
 I 1 RIGID N 1 2 M 15 J 0.234375 0.46875 0.234375 CG 0 1 0
 I 2 SPHERICAL N 0 1
.CLM
 STRU ACC VAL 0 0 -9.81
.INI
 VIT NOEUD 1 C 4 5 6 V 0 150 -4.61538
.SAM TYPE DYNAMIC RHO 0.8 SOLVER KLU
.SUB TF 1 H {h}
""",
            tmp_path,
        )

        def last(prefix: str, axes: str = "XYZ", owner: str = "node/2", r=r) -> np.ndarray:
            return np.array([r[f"{owner}/{prefix}{axis}"][-1] for axis in axes])

        errors["x"].append(np.linalg.norm(last("U") + ARM - centre))
        errors["R"].append((Rotation.from_rotvec(last("R", owner="node/1")) * turn.inv()).magnitude())
        errors["v"].append(np.linalg.norm(last("V") - np.cross(spin, centre)))
        errors["W"].append(np.linalg.norm(last("W", owner="node/1") - spin))
        errors["lambda"].append(np.linalg.norm(last("FORCE_", owner="element/2") - force))
        energy = r["run/KINETIC_ENERGY"][-1] + r["run/POTENTIAL_ENERGY"][-1]
        assert r["run/KINETIC_ENERGY"][0] == pytest.approx(5435.6967908655, rel=1e-10)
        print(f"h = {h}: energy lost {5435.6967908655 - energy:.3g}")
        assert energy == pytest.approx(5435.6967908655, rel=1e-5)
    for name, pair in errors.items():
        print(f"{name}: {pair[0]:.3g} {pair[1]:.3g}, order {orders(pair)[0]:.3f}")
    for name, pair in errors.items():
        assert orders(pair)[0] == pytest.approx(2, abs=0.15), name


def test_free_body(tmp_path):
    """Dzhanibekov's turning: about the middle axis."""
    w0 = np.array([0.01, 1, 0.01])
    _, w, _ = spin_up(np.diag([1.0, 2, 3]), lambda _: np.zeros(3), w0, 10.0)
    np.testing.assert_allclose(w, [-0.87457344, 0.48499619, 0.50500122], atol=1e-8)
    errors = []
    for h in (0.02, 0.01):
        r = run(
            f"""
.NOE
 I 1 X 0 0 0
.MCE
 I 1 INERTIA N 1 M 1 J 1 2 3
.INI
 VIT NOEUD 1 C 4 5 6 V 0.01 1 0.01
.SAM TYPE DYNAMIC RHO 0.9 SOLVER KLU
.SUB TF 10 H {h}
""",
            tmp_path,
        )
        turn = Rotation.from_rotvec([r[f"node/1/R{axis}"][-1] for axis in "XYZ"])
        spin = turn.inv().apply([r[f"node/1/W{axis}"][-1] for axis in "XYZ"])
        errors.append(np.linalg.norm(spin - w))
    print("free body:", errors, orders(errors))
    assert errors[-1] < 2e-3 and orders(errors)[0] == pytest.approx(2, abs=0.1)


def test_bricard_order(tmp_path):
    """A04, redundant: the deck of the collection at two coarser steps."""
    text = (Path(__file__).parents[2] / "decks/mechanisms/bricard.dat").read_text(encoding="utf-8")
    text = text[: text.index(".SUB")]
    p3 = np.array([0.510501461187, -1.649167599395, 0.140123114553])
    errors = []
    for h in (0.004, 0.002):
        r = run(text + f".SUB TF 1 H {h}\n", tmp_path)
        place = np.array([1, -1, 1]) + [r[f"node/3/U{axis}"][-1] for axis in "XYZ"]
        errors.append(np.linalg.norm(place - p3))
    print("A04:", errors, orders(errors))
    assert errors[-1] < 1e-5 and orders(errors)[0] == pytest.approx(2, abs=0.1)
