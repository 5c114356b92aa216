# SPDX-License-Identifier: BSD-3-Clause
"""A gear wheel of solids under the force at one tooth: twist and shear of its web against closed forms."""

from __future__ import annotations

from pathlib import Path

import gear_meshes
import numpy as np
import pytest
from engrane_post import Results
from runs import run

SHEAR = gear_meshes.YOUNG / 2 / (1 + gear_meshes.POISSON)


def polar(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return np.hypot(points[:, 0], points[:, 1]), np.arctan2(points[:, 1], points[:, 0])


def round_mean(angle: np.ndarray, values: np.ndarray) -> float:
    """Mean over a circle of values at angles, by the trapezoidal rule; those at one angle are averaged."""
    marks, which = np.unique(np.round(angle % (2 * np.pi), 6), return_inverse=True)
    each = np.bincount(which, values) / np.bincount(which)
    step = np.diff(np.append(marks, marks[0] + 2 * np.pi))
    return float(np.sum(each * (step + np.roll(step, 1))) / (4 * np.pi))


def test_gear_wheel_of_solids(tmp_path: Path) -> None:
    """The mean of the shear stress over a circle of the web follows from equilibrium wherever the force
    enters, and so does the twist, whose mean over a circle sees no displacement of the wheel."""
    mesh = gear_meshes.Gear()
    solved = run(gear_meshes.deck(), tmp_path)
    with Results(solved.file) as results:
        place = {int(n): i for i, n in enumerate(results.node_ids)}
        moved = np.asarray(results.field("displacement", 1))[[place[i + 1] for i in range(len(mesh.points))]]
        xx, yy, xy = (results.cell_field(f"STRESS:{c}", 1)[: len(mesh.cells)] for c in ("XX", "YY", "XY"))
        centre = np.asarray(results.field("displacement", 1))[place[200001]]
    force = np.array([solved[f"900003/FORCE_{axis}"][-1] for axis in "XY"])
    # the centre of the teeth follows the flank, away from the hinge: the tooth force has another arm
    moment = centre[0] * force[1] - centre[1] * force[0]
    assert moment > 0.5
    assert solved["900001/DRIVE_TORQUE"][-1] == pytest.approx(gear_meshes.TORQUE - moment, rel=1e-8)
    assert np.hypot(*force) == pytest.approx(gear_meshes.TORQUE / (40 * np.cos(np.pi / 9)), rel=1e-7)

    radius, angle = polar(mesh.points)
    along = moved[:, 1] * np.cos(angle) - moved[:, 0] * np.sin(angle)

    def turned(r: float) -> float:
        on = np.abs(radius - r) < 1e-6
        return round_mean(angle[on], along[on] / r)

    def twist(inner: float, outer: float) -> float:
        return -gear_meshes.TORQUE / (4 * np.pi * SHEAR * gear_meshes.WEB) * (1 / inner**2 - 1 / outer**2)

    assert turned(28.8) - turned(19.2) == pytest.approx(twist(19.2, 28.8), rel=0.005)

    middles = np.array([mesh.points[cell].mean(axis=0) for cell in mesh.cells])
    radius, angle = polar(middles)
    c, s = np.cos(angle), np.sin(angle)
    shear = (yy - xx) * s * c + xy * (c * c - s * s)
    for low in (19.2, 22.4, 25.6):
        ring = (radius > low) & (radius < low + 3.2)
        r = low + 1.6
        expected = -gear_meshes.TORQUE / (2 * np.pi * r**2 * gear_meshes.WEB)
        assert round_mean(angle[ring], shear[ring]) == pytest.approx(expected, rel=0.005)


def test_a_pinion_swings_on_the_teeth_of_a_wheel_of_solids(tmp_path: Path) -> None:
    """Its torque acts from the start, and the wheel is a spring beside it: the angle swings between nothing
    and twice that of equilibrium, with the period of the pinion's inertia on the stiffness of the wheel."""
    torque, inertia = gear_meshes.TORQUE / 2, 10.0
    (tmp_path / "static").mkdir()
    wanted = ".CHK\n ELEMENT 900004 ANGLE V 0 ATOL 1E9\n ELEMENT 900005 NORMAL_FORCE V 0 ATOL 1E9\n"
    still = run(gear_meshes.deck().replace(".CHK\n", wanted), tmp_path / "static")["900004/ANGLE"][-1]
    half = float(np.pi * np.sqrt(inertia * still / torque))  # of the period
    deck = gear_meshes.deck().split(".SAM")[0]
    deck = deck.replace(".FCT", f" I 900007 INERTIA N 300001 M 1E-3 J {inertia} {inertia} {inertia}\n.FCT")
    swing = run(
        deck
        + f""".SAM TYPE DYNAMIC DISPLACEMENTS LARGE RHO 0.8
.SUB TF {7 * half / 6!r} H {half / 12!r}
{wanted}.FIN 1
""",
        tmp_path,
    )
    angle = swing["900004/ANGLE"]
    # a polynomial through the four results around the largest
    at = int(np.argmax(angle)) + np.arange(-2, 2)
    course = np.polynomial.Polynomial.fit(swing.t[at], angle[at], 3)
    summits = [t.real for t in course.deriv().roots() if abs(t.imag) < 1e-12 and course.deriv(2)(t.real) < 0]
    print(summits[0] / half, course(summits[0]) / still)
    assert course(summits[0]) == pytest.approx(2 * still, rel=0.01)
    assert summits[0] == pytest.approx(half, rel=0.01)
    force = swing["900005/NORMAL_FORCE"]
    assert force.max() == pytest.approx(2 * torque / (20 * np.cos(np.pi / 9)), rel=0.02)
