# SPDX-License-Identifier: BSD-3-Clause
"""The oracles against numbers known from elsewhere, so that a wrong oracle cannot hide a wrong solver."""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from oracles import flexible_crank, gear_statics, parametric_mesh, planetary, rigid_body, spur_transmission


def test_pendulum() -> None:
    xy = rigid_body.pendulum(np.array([0.0, 1.0, 10.0]))
    assert xy[0] == pytest.approx([-1, 0], abs=1e-15)
    assert xy[1] == pytest.approx([0.98629175113188, -0.16501085312554], abs=1e-12)
    assert xy[2] == pytest.approx([-0.27508746257612, -0.96141920509913], abs=1e-12)


def test_torque_free_body() -> None:
    w = rigid_body.torque_free_body(np.array([0.0, 10.0]))[-1]
    assert w == pytest.approx([-0.87457344, 0.48499619, 0.50500122], abs=1e-8)


def test_heavy_top() -> None:
    top = rigid_body.heavy_top(np.array([0.0, 0.5, 1.0]))
    assert top["com"][-1] == pytest.approx([0.17334396410, 0.64008859207, -0.74849079113], abs=1e-8)
    assert top["energy"] == pytest.approx(5435.6967908655, rel=1e-10)


def test_run_up() -> None:
    rigid = rigid_body.run_up(np.array([1.0]))
    assert rigid["alpha1"] == pytest.approx(1000 / 3)
    assert rigid["force"][0] == pytest.approx(400 / 3)
    flexible = rigid_body.run_up(np.linspace(0, 0.01, 11), stiffness=1e8)
    assert flexible["omega"] == pytest.approx(6123.724356957946)
    stretch = 0.05 * flexible["angle1"] - 0.1 * flexible["angle2"]
    assert 1e8 * stretch == pytest.approx(flexible["force"], rel=1e-7, abs=1e-6)


def test_flexible_crank() -> None:
    """The equations of the Test Set end where it says; the other rod bends as in its table."""
    end = flexible_crank.Modes().solve(np.array([0.1]), 1e-7)[:5, -1]
    assert end == pytest.approx(flexible_crank.PUBLISHED[:5], rel=2e-5)
    times = np.array([flexible_crank.TURN / 20])
    rod = flexible_crank.Rod(8)
    found = rod.deflection(times, rod.solve(times, 1e-6))
    assert found == pytest.approx(flexible_crank.DEFLECTIONS[:1], abs=3e-8)


def test_worm() -> None:
    w = gear_statics.worm_of_shigley()
    assert w["lead_degrees"] == pytest.approx(9.46232221, abs=1e-8)
    for name, value in {
        "W_x": 52.52113,
        "W": 278.25130,
        "W_y": 69.66856,
        "W_z": 264.35069,
        "efficiency": 0.83887090,
    }.items():
        assert w[name] == pytest.approx(value, rel=2e-7)


def test_worm_locks_itself() -> None:
    """The virtual work of the force components gives the efficiencies; at f = cos(a_n) tan(lead) the
    wheel's force on the worm passes through its axle."""
    alpha, lead = math.radians(14.5), math.radians(9.46232221)
    limit = gear_statics.worm(1.0, lead, alpha)["self_locking_friction"]
    assert limit == pytest.approx(math.cos(alpha) * math.tan(lead))
    for f in (0.0, 0.03, 0.1, 0.9 * limit, 1.5 * limit):
        w = gear_statics.worm(1.0, lead, alpha, f)
        # One turn of the worm moves the wheel's pitch circle by the lead, 2 pi r tan(lead).
        assert w["W_z"] * math.tan(lead) / w["W_x"] == pytest.approx(w["efficiency"])
        # With the wheel driving, friction points the other way.
        back = gear_statics.wheel_drives_worm(lead, alpha, f)
        x = math.cos(alpha) * math.sin(lead) - f * math.cos(lead)
        z = math.cos(alpha) * math.cos(lead) + f * math.sin(lead)
        assert back == pytest.approx(max(0.0, x / (z * math.tan(lead))))
        assert (back == 0) == (f >= limit)


def test_hypoid() -> None:
    h = gear_statics.hypoid(11, 43, math.radians(50), math.radians(31.5), 85.0)
    assert h["pinion_radius"] == pytest.approx(28.84306742)
    assert h["force_ratio"] == pytest.approx(0.75387911)
    assert h["torque_ratio"] == pytest.approx(3.90909091)


def test_bevel_of_the_paper() -> None:
    p = gear_statics.paper_bevel(1.0)
    assert p["normal"] == pytest.approx(1064.1777724759)
    s, c = math.sin(1), math.cos(1)
    expected = np.array([c, 0, -s]) * 1000 - 363.9702343 * np.array([0.1961161 * s, 0.9805807, 0.1961161 * c])
    assert p["force"] == pytest.approx(expected, rel=1e-6)
    # The components in shaft terms are the same force: radial and axial of wheel A, cone 78.69 degrees.
    b = gear_statics.bevel(5000.0, 5.0, math.radians(20), math.atan(5))
    assert b.normal == pytest.approx(p["normal"])
    assert [b.radial, b.axial] == pytest.approx([363.9702343 * 0.1961161, 363.9702343 * 0.9805807], rel=1e-6)


def test_components_make_up_the_normal_force() -> None:
    alpha = math.radians(20)
    pairs = [
        gear_statics.spur(10, 0.1, alpha),
        gear_statics.helical(10, 0.1, alpha, math.radians(25)),
        *gear_statics.internal(10, 0.1, alpha, math.radians(-12)),
        gear_statics.bevel(10, 0.1, alpha, math.radians(33), math.radians(35), -1),
        *gear_statics.crossed_helical(10, 12, 40, 2e-3, math.radians(50), math.radians(40), alpha),
    ]
    for w in pairs:
        assert math.hypot(w.tangential, w.radial, w.axial) == pytest.approx(w.normal)


def test_planetary() -> None:
    w = gear_statics.willis(24, 60)
    assert [w["carrier"], w["planet"]] == pytest.approx([2 / 7, -2 / 3])
    assert 1 + w["torque_ring"] + w["torque_carrier"] == pytest.approx(0)


def test_lin_and_parker() -> None:
    f = planetary.frequencies(planetary.Planetary())
    single = [0, 1475.7472, 1930.3466, 2658.3244, 7462.8034, 11775.2658]
    double = [743.1639, 1102.4193, 1896.0199, 2276.3801, 6986.2982, 9647.9132]
    assert len(f) == 18
    assert f[0] == pytest.approx(0, abs=1e-3)  # the root of a rounding error: all turn together
    assert f[1:] == pytest.approx(sorted(single[1:] + double + double), abs=6e-5)


def test_four_planets_have_modes_of_their_own() -> None:
    """With more than three planets, modes in which only planets move are N - 3 fold (Lin and Parker 1999)."""
    p = planetary.Planetary(planets=4)
    mass, stiffness = planetary.matrices(p)
    values, shapes = eigh(stiffness, mass)
    still = np.abs(shapes[:9]).max(axis=0) < 1e-6 * np.abs(shapes).max(axis=0)
    assert still.sum() == 3 * (p.planets - 3)
    assert values.min() > -1e-3


def test_load_sharing() -> None:
    places = 2 * np.pi * np.arange(3) / 3
    error, alpha = np.array([2e-5, 0, 0]), math.radians(20)
    for radial_closes in (True, False):

        def share(k: float, closes: bool = radial_closes) -> np.ndarray:
            return planetary.load_sharing(6000.0, error, places, 4e8, 5e8, k, alpha, closes)

        # A free sun finds its place between three planets; in a rigid bearing the springs of both teeth in
        # a row, over which the error is spread twice, make the difference.
        assert share(1e-3) == pytest.approx([2000, 2000, 2000], rel=1e-6)
        row = 4e8 * 5e8 / 9e8
        held = 2000 + row * 2 * math.cos(alpha) * (error.mean() - error)
        assert share(1e18) == pytest.approx(held, rel=1e-6)
        assert share(1e8).sum() == pytest.approx(6000)
        # A pin that stands ahead of the load's sense opens its teeth.
        assert share(1e8)[0] < 2000 < share(1e8)[1:].min()


def test_load_sharing_deck() -> None:
    """The numbers in decks/trains/planetary_load_sharing*.dat; k_m is measured along the circumference."""
    alpha = math.radians(20)
    c = math.cos(alpha)
    places = 2 * np.pi * np.arange(3) / 3
    for radial_closes, expected in (
        (False, [63.65289, 231.85794, 295.69904]),
        (True, [66.59017, 262.30985, 262.30985]),
    ):
        mesh = 4.2e8 / c**2
        found = planetary.load_sharing(
            20 / 0.036 / c, np.array([2e-6, 0, 0]), places, mesh, mesh, 1e8, alpha, radial_closes
        )
        assert found == pytest.approx(expected, abs=5e-5)


def test_parametric_mesh() -> None:
    assert parametric_mesh.first_instability(0.2) == pytest.approx((1.8988481105, 2.0986875606), abs=2e-10)
    assert np.linalg.det(parametric_mesh.monodromy(0.2, 1.7)) == pytest.approx(1, abs=1e-10)  # Liouville
    for rate, stable in ((1.89, True), (1.91, False), (2.09, False), (2.11, True)):
        assert (parametric_mesh.growth(0.2, rate) < 1 + 1e-9) == stable
    # Damping above epsilon/4 closes the region (first order of the perturbation in epsilon).
    assert parametric_mesh.growth(0.2, 2.0, 0.045) > 1 > parametric_mesh.growth(0.2, 2.0, 0.055)


def test_transmission_starts_in_equilibrium() -> None:
    for case in "ABCD":
        for torque in (945.8, -945.8):
            model = spur_transmission.build(case, torque=torque)
            mesh = model.mesh(0.0, model.start())
            assert mesh["F"] == pytest.approx(torque / model.r, rel=1e-9)
            assert mesh["flank"] == (1 if torque > 0 else -1)


def test_pair_leans_on_nothing() -> None:
    """Forces and moments of the tooth on the two wheels balance, with the supports displaced and the tooth
    tilted."""
    model = spur_transmission.build("D", ks=0.0, cs=0.0, ct1=0.0, kt1=0.0, ct2=0.0, kt2=0.0)
    y = np.zeros(14)
    y[:7] = 2e-3, 1e-3, 0, 0.01, -0.03, 0.02, 0.05
    f = model.forces(1e-5, y)
    moment = f[0] - f[1] + (y[3] * f[4] - y[4] * f[3]) + ((2 * model.r + y[5]) * f[6] - y[6] * f[5])
    assert [f[3] + f[5], f[4] + f[6]] == pytest.approx([0, 0], abs=1e-9)
    assert moment == pytest.approx(0, abs=1e-9 * abs(f[0]))


def test_energy_without_dampers() -> None:
    """Independent check of the force terms: without dampers and friction-like radial force the energy in the
    frame of disc 1 at rest (speed zero) is conserved."""
    model = spur_transmission.build("D", smooth=0.0, xi=0.0, cs=0.0, ct1=0.0, ct2=0.0, alpha=0.0)

    def energy(y: np.ndarray) -> float:
        mass = np.array([model.ia, model.ib, model.i2] + [model.m] * 4)
        kinetic = 0.5 * float(mass @ y[7:] ** 2)
        x = model.mesh(0.0, y)["x"]
        tooth = x if x >= 0 else min(x + model.b, 0.0)
        springs = model.kt1 * y[0] ** 2 + model.kt2 * (y[1] - y[2]) ** 2 + model.ks * float(y[3:7] @ y[3:7])
        return kinetic + 0.5 * springs + 0.5 * model.km * tooth**2 + model.torque * y[2]

    y = model.start()
    y[7:] = 3.0, -20.0, 10.0, 5.0, -8.0, 1.0, 30.0
    before = energy(y)
    # Time enters only through the turning of disc 1, so freeze it: integrate with t held at zero in small
    # spans.
    from scipy.integrate import solve_ivp

    sol = solve_ivp(
        lambda _t, q: model.rhs(0.0, q), (0, 1e-3), y, "DOP853", rtol=1e-11, atol=1e-14, max_step=1e-6
    )
    assert energy(sol.y[:, -1]) == pytest.approx(before, rel=1e-8)


def test_paper_ratio() -> None:
    a, b = spur_transmission.steady("A"), spur_transmission.steady("B")
    assert b["amplitude"] / a["amplitude"] == pytest.approx(1.40, abs=0.01)
    for s in (a, b):
        assert s["peaks"][0][0] == pytest.approx(5000, rel=1e-3)
        assert s["multiplier"] < 1
        assert s["mean"] == pytest.approx(945.8 / (3.937 / 2) / math.cos(math.radians(20)), rel=1e-6)
