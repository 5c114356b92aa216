# SPDX-License-Identifier: BSD-3-Clause
"""KINEMATIC runs, and dynamic ones without unknowns: velocities, accelerations and the efforts that drives
need, against closed forms; and the balance of work and energy of kinematic and static runs."""

from __future__ import annotations

import numpy as np
import pytest
from runs import run

CRANK, ROD = 0.2, 0.6
M_ROD, J_ROD, M_SLIDER, J_CRANK, G = 2.0, 0.07, 3.0, 0.05, 9.81


def slider_crank(h: float) -> str:
    """In the plane; crank angle a = t + 0.75 t2, mass of the rod in its middle, gravity across the slide."""
    return f"""
.NOE
 I 1 X 0 0 0
 I 2 X {CRANK + ROD / 2} 0 0
 I 3 X {CRANK + ROD} 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 HINGE N 1 2 AXIS 0 0 1 AT {CRANK} 0 0
 I 3 POINT_LINE N 2 3 AXIS 0 0 1 AT {CRANK + ROD} 0 0
 I 4 PRISMATIC N 0 3 AXIS 1 0 0
 I 5 INERTIA N 1 M 1 J {J_CRANK}
 I 6 INERTIA N 2 M {M_ROD} J {J_ROD}
 I 7 INERTIA N 3 M {M_SLIDER} J 1
.FCT
 I 1 EXPR "T+0.75*T**2"
.CLM
 STRU ACC VAL 0 -{G} 0
.SAM TYPE KINEMATIC
.SUB TF 3 H {h}
"""


class SliderCrank:
    """Positions over the crank angle with two derivatives, and Lagrange's equation for the one freedom."""

    def __init__(self, t: np.ndarray) -> None:
        a, self.w, self.e = t + 0.75 * t**2, 1 + 1.5 * t, 1.5
        s, c, r, rod = np.sin(a), np.cos(a), CRANK, ROD
        # the rod leans by -b: sin b = r sin a / rod
        sin_b = r * s / rod
        cos_b = np.sqrt(1 - sin_b**2)
        b1 = r * c / rod / cos_b
        b2 = (-r * s / rod + sin_b * b1**2) / cos_b
        self.angle = a
        self.slider = [
            r * c + rod * cos_b,
            -r * s - rod * sin_b * b1,
            -r * c - rod * (cos_b * b1**2 + sin_b * b2),
        ]
        middle_1 = np.array([-r * s - rod / 2 * sin_b * b1, r * c / 2])
        middle_2 = np.array([-r * c - rod / 2 * (cos_b * b1**2 + sin_b * b2), -r * s / 2])
        x1, x2 = self.slider[1], self.slider[2]
        inertia = J_CRANK + M_SLIDER * x1**2 + M_ROD * (middle_1**2).sum(0) + J_ROD * b1**2
        half_slope = M_SLIDER * x1 * x2 + M_ROD * (middle_1 * middle_2).sum(0) + J_ROD * b1 * b2
        self.torque = inertia * self.e + half_slope * self.w**2 + M_ROD * G * middle_1[1]
        self.rod_speed, self.rod_acceleration = -b1 * self.w, -(b2 * self.w**2 + b1 * self.e)


def test_slider_crank(tmp_path):
    r = run(slider_crank(0.05), tmp_path)
    exact = SliderCrank(r.t)
    x, x1, x2 = exact.slider
    speed, acceleration = x1 * exact.w, x2 * exact.w**2 + x1 * exact.e
    for name, values in {
        "node/3/UX": x - CRANK - ROD,
        "node/3/VX": speed,
        "node/3/AX": acceleration,
        "node/2/WZ": exact.rod_speed,
        "node/2/EZ": exact.rod_acceleration,
        "element/1/ANGLE": exact.angle,
        "element/1/DRIVE_TORQUE": exact.torque,
    }.items():
        error = np.max(np.abs(r[name] - values)) / np.max(np.abs(values))
        print(f"{name}: {error:.2g}")
        assert error < 1e-11, name


def test_two_link_arm(tmp_path):
    """Torques of both motors, from the textbook's M(q) q'' + C(q, q') + g(q)."""
    l1, c1, c2, m1, m2, j1, j2 = 0.8, 0.3, 0.25, 4.0, 3.0, 0.2, 0.1
    r = run(
        f"""
.NOE
 I 1 X {c1} 0 0
 I 2 X {l1 + c2} 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0 DRIVE ANGLE NF 1
 I 2 HINGE N 1 2 AXIS 0 0 1 AT {l1} 0 0 DRIVE ANGLE NF 2
 I 3 INERTIA N 1 M {m1} J {j1}
 I 4 INERTIA N 2 M {m2} J {j2}
.FCT
 I 1 EXPR "0.5*sin(2*T)+T"
 I 2 EXPR "1.2*cos(3*T)-1.2"
.CLM
 STRU ACC VAL 0 -{G} 0
.SAM TYPE KINEMATIC
.SUB TF 2 H 0.02
""",
        tmp_path,
    )
    t = r.t
    q1, w1, e1 = 0.5 * np.sin(2 * t) + t, np.cos(2 * t) + 1, -2 * np.sin(2 * t)
    q2, w2, e2 = 1.2 * np.cos(3 * t) - 1.2, -3.6 * np.sin(3 * t), -10.8 * np.cos(3 * t)
    coupling = m2 * l1 * c2
    m22 = j2 + m2 * c2**2
    m12 = m22 + coupling * np.cos(q2)
    m11 = j1 + m1 * c1**2 + m2 * l1**2 + m22 + 2 * coupling * np.cos(q2)
    g2 = m2 * G * c2 * np.cos(q1 + q2)
    g1 = (m1 * c1 + m2 * l1) * G * np.cos(q1) + g2
    centrifugal = coupling * np.sin(q2)
    first = m11 * e1 + m12 * e2 - centrifugal * (2 * w1 * w2 + w2**2) + g1
    second = m12 * e1 + m22 * e2 + centrifugal * w1**2 + g2
    for name, values in {"1/DRIVE_TORQUE": first, "2/DRIVE_TORQUE": second}.items():
        error = np.max(np.abs(r[name] - values)) / np.max(np.abs(values))
        print(f"{name}: {error:.2g}")
        assert error < 1e-11


def test_work_of_a_kinematic_run(tmp_path):
    """The drive's work is the energy gained, but for the error of the trapezoidal rule: second order."""
    errors = []
    for h in (0.02, 0.01):
        r = run(slider_crank(h), tmp_path)
        errors.append(np.max(np.abs(r["run/ENERGY_ERROR"])))
        gained = r["run/KINETIC_ENERGY"] + r["run/POTENTIAL_ENERGY"]
        assert errors[-1] < 0.01 * np.max(np.abs(gained - gained[0]))
    print("work:", errors)
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2, abs=0.2)


@pytest.mark.parametrize("sub", ["SCHEME RADAU", "SCHEME RADAU / TOL 1E-7", "ACCURACY FINE", "SCHEME CHUNG"])
def test_nothing_but_prescribed_motion(sub, tmp_path):
    """No equation is left: RADAU took the empty matrix for a singular one."""
    sam, _, tolerance = sub.partition("/")
    r = run(
        f"""
.NOE
 I 1
 I 2 X 1
.MCE
 I 1 SPRING N 1 2 K 100 C 5
 I 2 INERTIA N 2 M 2
.FCT
 I 1 EXPR "0.1*T**2"
.CLM
 FIX NOEUD 1 C 1 2 3
 FIX NOEUD 2 C 2 3
 DEP NOEUD 2 C 1 V 1 NF 1
.SAM TYPE DYNAMIC {sam}
.SUB TF 1 H 0.01 {tolerance}
""",
        tmp_path,
    )
    assert r["node/2/VX"] == pytest.approx(0.2 * r.t, abs=1e-12)
    assert r["1/FORCE"] == pytest.approx(10 * r.t**2 + 5 * 0.2 * r.t, abs=1e-11)
    assert r["run/GROUND_FORCE_X"] == pytest.approx(2 * 0.2, rel=1e-9)


STATIC = """
.NOE
 I 1 X 1 0 0
 I 2 X 2 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0 K 40
 I 2 INERTIA N 1 M 2
 I 3 SPRING N 1 2 K 300
 I 4 FORCE N 1 DIR 0 1 0 V 60 NF 1
 I 5 HINGE N 0 2 AXIS 0 0 1 AT 2 1 0
.FCT
 I 1 EXPR "T"
.CLM
 STRU ACC VAL 0 -9.81 0
 CHA NOEUD 2 C 1 V 30 NF 1
.SAM TYPE STATIC
.SUB TF 1 H {h}
"""


def test_work_of_a_static_run(tmp_path):
    """Large displacements under forces in ramps: work and stored energy agree to second order in the step."""
    errors = []
    for h in (0.1, 0.05, 0.025):
        r = run(STATIC.format(h=h), tmp_path)
        errors.append(abs(r["run/ENERGY_ERROR"][-1]))
        assert r["run/EXTERNAL_WORK"][-1] > 10
    print("static work:", errors)
    assert errors[-1] < 1e-3 * r["run/EXTERNAL_WORK"][-1]
    assert np.log2(errors[1] / errors[2]) == pytest.approx(2, abs=0.2)


def test_work_of_a_drive_and_of_a_support_in_statics(tmp_path):
    r = run(
        """
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
 I 3 X 2 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 HINGE N 0 1 AXIS 0 0 1 K 50
 I 3 SPRING N 2 3 K 10
.FCT
 I 1 TABLE 0 0  0.5 0.1  1 0.5
.CLM
 FIX NOEUD 2 C 1 2 3
 DEP NOEUD 3 C 1 V 0.4 NF 1
 FIX NOEUD 3 C 2 3
.SAM TYPE STATIC
.SUB TF 1 H 0.1
""",
        tmp_path,
    )
    work = 0.5 * 50 * 0.5**2 + 0.5 * 10 * 0.2**2
    assert r["run/EXTERNAL_WORK"][-1] == pytest.approx(work, rel=1e-7)
    assert abs(r["run/ENERGY_ERROR"][-1]) < 1e-7 * work
