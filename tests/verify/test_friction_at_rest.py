# SPDX-License-Identifier: BSD-3-Clause
"""STICK: dry friction that comes to rest, holds exactly and gives way, against closed forms and an
event-driven integration by scipy."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from runs import run
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

SLOPE = """
.NOE
 I 1
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 FRICTION CONST {mu} STICK
 I 2 INERTIA N 1 M 2 J 0.1 0.1 0.1
.CLM STRU ACC VAL -3 -9 0
.INI VIT NOEUD 1 C 1 V 1
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF {end} H 0.013
.FIN 1
"""


def test_a_block_stops_on_a_slope_and_rests(tmp_path: Path) -> None:
    result = run(SLOPE.format(mu=0.5, end=1), tmp_path)
    deceleration = 3 + 0.5 * 9
    stop = 1 / deceleration
    t, x = result.t, result["node/1/UX"]
    expected = np.where(t < stop, t - deceleration * t**2 / 2, stop / 2)
    assert np.abs(x - expected).max() < 1e-10
    rest = t > stop + 1e-6
    assert np.ptp(x[rest]) < 1e-15
    assert np.abs(result["node/1/VX"][rest]).max() < 1e-15
    assert result["1/FRICTION_FORCE"][rest] == pytest.approx(2 * 3, rel=1e-12)
    assert result["1/FRICTION_FORCE"][t < stop - 1e-6] == pytest.approx(0.5 * 2 * 9, rel=1e-9)


def test_a_block_rests_for_many_steps(tmp_path: Path) -> None:
    deck = SLOPE.format(mu=0.5, end=100).replace("H 0.013", "H 1D-3").replace("RHO 0.8", "RHO 0.8 SOLVER KLU")
    result = run(deck.replace(".FIN", ".SAI HISTORY DT 1 FIELDS DT 50\n.FIN"), tmp_path)
    x = result["node/1/UX"][1:]
    assert len(x) == 100
    assert np.abs(x - 1 / (2 * 7.5)).max() < 1e-12
    assert np.ptp(x) == 0


def test_a_block_stops_on_a_slope_and_slides_back(tmp_path: Path) -> None:
    result = run(SLOPE.format(mu=0.2, end=1), tmp_path)
    up, down = 3 + 0.2 * 9, 3 - 0.2 * 9
    stop = 1 / up
    t = result.t
    expected = np.where(t < stop, t - up * t**2 / 2, stop / 2 - down * (t - stop) ** 2 / 2)
    # the instant of rest is found to 1e-6 of H
    assert np.abs(result["node/1/UX"] - expected).max() < 3e-8
    lost = 0.2 * 2 * 9 * (stop / 2 + down * (1 - stop) ** 2 / 2)
    assert result["run/DISSIPATED_ENERGY"][-1] == pytest.approx(lost, rel=1e-6)


BREAKING_AWAY = """
.NOE
 I 1
.FCT
 I 1 TABLE 0 0 1 20
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 FRICTION CONST 0.2 0.3 STICK K 300
 I 2 INERTIA N 1 M 2 J 0.1
 I 3 FORCE N 1 DIR 0 0 -1 V 20
 I 4 FORCE N 1 DIR 1 0 0 V 1 NF 1
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 1 H 0.01 TOL {tolerance}
.FIN 1
"""


@pytest.mark.parametrize("tolerance", [1e-6, 1e-9, 1e-12])
def test_every_change_is_an_event(tolerance: float, tmp_path: Path) -> None:
    """Also one that is met so sharply that its switch is at rounding level."""
    run(BREAKING_AWAY.format(tolerance=tolerance), tmp_path)
    events = re.findall(r"t = (\S+) +PRISMATIC 1: (.*)", (tmp_path / "deck.lst").read_text())
    assert [what for _, what in events] == ["breaks away", "comes to rest", "breaks away"]
    # from 20 t = 6 on, 2 x'' + 300 x = 2 + 20 (t - 0.3), until x' = 0; then 20 t - 300 x = 6
    w = np.sqrt(150)
    phase = 2 * (np.pi - np.arctan(w / 10))
    x = (2 + 20 * phase / w - 2 * np.cos(phase) - 20 / w * np.sin(phase)) / 300
    expected = [0.3, 0.3 + phase / w, (6 + 300 * x) / 20]
    assert [float(t) for t, _ in events] == pytest.approx(expected, rel=max(3e-9, tolerance))


@pytest.mark.parametrize("sample", [0.01, 0.0023])
def test_results_before_an_event_are_those_of_the_state_before(sample: float, tmp_path: Path) -> None:
    """The friction gives way within rounding behind a result. What balanced forces between the ends of the
    step had let go already: energies were off by more than there were."""
    deck = BREAKING_AWAY.format(tolerance=1e-12).replace(".FIN", f".SAI HISTORY DT {sample}\n.FIN")
    result = run(deck, tmp_path)
    resting = result.t < 0.3 + 1e-12
    assert np.abs(result["1/SLIDE_SPEED"][resting]).max() < 1e-20
    assert np.abs(result["run/ENERGY_ERROR"]).max() < 1e-9 * result["run/DISSIPATED_ENERGY"][-1]


def test_a_rotor_is_braked_to_rest(tmp_path: Path) -> None:
    deck = """
.NOE
 I 2
.MCE
 I 2 HINGE N 0 2 AXIS 0 0 1 FRICTION CONST 0.2 RADIUS 0.02 PRELOAD 500 STICK
 I 5 INERTIA N 2 J 1D-3
.INI
 VIT NOEUD 2 C 6 V 14
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF 0.5 H 1D-3
.FIN 1
"""
    result = run(deck, tmp_path)
    slowing = 0.2 * 0.02 * 500 / 1e-3
    t, stop = result.t, 14 / slowing
    expected = np.where(t < stop, 14 * t - slowing * t**2 / 2, 14 * stop / 2)
    assert np.abs(result["2/ANGLE"] - expected).max() < 1e-9
    assert np.abs(result["2/SPEED"][t > stop + 1e-6]).max() < 1e-12
    assert result["run/DISSIPATED_ENERGY"][-1] == pytest.approx(0.5e-3 * 14**2, rel=1e-6)


BELT = """
.NOE
 I 1
 I 2
 I 3 X -1
.FCT
 I 1 EXPR "0.1*T"
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 DRIVE SLIDE NF 1
 I 2 PRISMATIC N 1 2 AXIS 1 0 0 FRICTION STRIBECK 0.5 0.3 0.2 STICK
 I 3 SPRING N 3 2 K 10 L0 1
 I 4 INERTIA N 2 M 1 J 0.1 0.1 0.1
.CLM
 FIX NOEUD 3 C 1 2 3
 STRU ACC VAL 0 -10 0
.INI VIT NOEUD 2 C 1 V 0.1
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF {end} H {h}
.FIN 1
"""


def belt_and_mass(end: float) -> tuple[list[float], np.ndarray, np.ndarray]:
    """The mass on a running belt: sticks until the spring tears it off, slips back, is caught again. Returns
    the instants of these events and a dense solution."""
    speed, stiffness, press = 0.1, 10.0, 10.0

    def friction(slip: float) -> float:
        return 0.3 + 0.2 * np.exp(-((slip / 0.2) ** 2))

    events, t, x = [], 0.0, 0.0
    times, places = [0.0], [0.0]
    while t < end:
        tear = t + (0.5 * press / stiffness - x) / speed
        until = min(tear, end)
        times.append(until)
        places.append(x + speed * (until - t))
        if tear >= end:
            break
        events.append(tear)

        def slides(_, s):
            return [s[1], -stiffness * s[0] + press * friction(speed - s[1])]

        start = [places[-1], speed]
        caught = lambda _, s: s[1] - speed  # noqa: E731
        caught.terminal, caught.direction = True, 1
        done = solve_ivp(slides, (tear, end), start, events=caught, rtol=1e-12, atol=1e-14, dense_output=True)
        grid = np.linspace(tear, done.t[-1], 2000)[1:]
        times.extend(grid)
        places.extend(done.sol(grid)[0])
        t, x = done.t[-1], done.y[0, -1]
        if t < end:
            events.append(t)
    return events, np.array(times), np.array(places)


def test_a_mass_on_a_belt_tears_off_and_is_caught(tmp_path: Path) -> None:
    end = 14.0
    events, t, x = belt_and_mass(end)
    assert len(events) == 4
    errors = []
    for h in (0.01, 0.005):
        result = run(BELT.format(end=end, h=h), tmp_path)
        sticks = (result.t < events[0]) | ((result.t > events[1] + h) & (result.t < events[2] - h))
        assert np.abs(result["2/SLIDE_SPEED"][sticks]).max() < 1e-12
        errors.append(np.abs(result["node/2/UX"] - np.interp(result.t, t, x)).max())
    assert errors[1] < 2e-4
    assert np.log2(errors[0] / errors[1]) > 1.8


def test_a_belt_slips_and_holds_again(tmp_path: Path) -> None:
    """A motor torque of more than the belt holds, which falls to zero from t = 0.5 to 0.6."""
    deck = """
.NOE
 I 1
 I 2 X 0.5
.FCT
 I 1 EXPR "max(0, min(1, (0.6 - T)*10))"
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 BELT N 1 2 AXIS 0 0 1 R 0.05 0.12 PRELOAD 100 MU 0.3 STICK
 I 4 INERTIA N 1 J 0.01
 I 5 INERTIA N 2 J 0.2
 I 6 TORQUE N 1 AXIS 0 0 1 V 12 NF 1
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF 1.5 H 0.005
.FIN 1
"""
    result = run(deck, tmp_path)
    wrap = np.pi - 2 * np.arcsin(0.07 / 0.5)
    m = 1 - np.exp(-0.3 * wrap)
    pull = 100 * m / (1 - m / 2)
    t = result.t
    ramp = np.clip(t - 0.5, 0, 0.1)
    impulse = 12 * (np.minimum(t, 0.5) + ramp - 5 * ramp**2)
    held = 0.05 * 6.6 / 0.01 / (pull * (0.05**2 / 0.01 + 0.12**2 / 0.2))
    assert 0.7 < held < 1.4
    braked = pull * np.minimum(t, held)
    assert result["1/SPEED"] == pytest.approx((impulse - 0.05 * braked) / 0.01, rel=1e-6, abs=2e-3)
    assert result["2/SPEED"] == pytest.approx(0.12 * braked / 0.2, rel=1e-6, abs=2e-3)
    assert result["3/GRIP_USED"][(t > 0) & (t < held - 1e-3)] == pytest.approx(1, rel=1e-9)
    assert np.abs(result["3/TORQUE_1"][t > held + 1e-3]).max() < 1e-9


def test_a_drive_moves_what_friction_would_hold(tmp_path: Path) -> None:
    """A driven slide that reverses: the grip gives way to the drive, and the drive carries the friction."""
    deck = """
.NOE
 I 1
.FCT
 I 1 EXPR "0.1*sin(3*T)"
.MCE
 I 1 PRISMATIC N 0 1 AXIS 1 0 0 DRIVE SLIDE NF 1 FRICTION CONST 0.5 STICK
 I 2 INERTIA N 1 M 2 J 0.1 0.1 0.1
.CLM STRU ACC VAL 0 -9 0
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF 3 H 0.005
.FIN 1
"""
    result = run(deck, tmp_path)
    t = result.t
    speed = 0.3 * np.cos(3 * t)
    clear = np.abs(speed) > 0.01
    expected = -2 * 0.9 * np.sin(3 * t) + 0.5 * 2 * 9 * np.sign(speed)
    assert result["1/SLIDE_DRIVE"][clear] == pytest.approx(expected[clear], abs=0.1)


def sliding(rates, start: list[float], end: float, levers: np.ndarray):
    """Integrates q' = v, v' = rates(q, v, n) with n the unit vector of sliding levers·v until it stops;
    q as a function of time."""
    size = len(start) // 2

    def slides(_, s):
        u = levers * s[size:]
        return [*s[size:], *rates(s[:size], s[size:], u / np.linalg.norm(u))]

    slowest = lambda _, s: np.linalg.norm(levers * s[size:]) - 1e-9  # noqa: E731
    slowest.terminal, slowest.direction = True, -1
    done = solve_ivp(slides, (0, end), start, events=slowest, rtol=1e-12, atol=1e-14, dense_output=True)
    return done.t[-1], lambda t: np.array([done.sol(min(one, done.t[-1]))[:size] for one in np.atleast_1d(t)])


def order_of(
    deck: str, tmp_path: Path, channels: list[str], expected, stop: float, step: float
) -> list[float]:
    """Largest errors of the channels with two steps; that they are held where sliding has stopped."""
    errors = []
    for h in (step, step / 2):
        result = run(deck.format(h=h), tmp_path)
        found = np.stack([result[c] for c in channels], axis=1)
        errors.append(np.abs(found - expected(result.t)).max())
        assert np.ptp(found[result.t > stop + step], axis=0).max() < 1e-14
    return errors


PUCK = """
.NOE
 I 1
.MCE
 I 1 POINT_PLANE N 0 1 AXIS 0 0 1 DIR 1 0 0 FRICTION CONST 0.5 STICK
 I 2 INERTIA N 1 M 2 J 0.1 0.1 0.1
.CLM STRU ACC VAL 0 {slope} -9
.INI
 VIT NOEUD 1 C 1 V 1
 VIT NOEUD 1 C 2 V 0.7
.SAM TYPE DYNAMIC RHO 0.8
.SUB TF 0.5 H {h}
.FIN 1
"""


def test_a_puck_stops_on_a_plane(tmp_path: Path) -> None:
    """Its path is straight."""
    result = run(PUCK.format(slope=0, h=0.013), tmp_path)
    speed = np.hypot(1, 0.7)
    stop = speed / (0.5 * 9)
    t = np.minimum(result.t, stop)
    way = (speed * t - 0.5 * 9 * t**2 / 2) / speed
    assert np.abs(result["node/1/UX"] - way).max() < 1e-9  # the instant of rest is found to 1e-6 of H
    assert np.abs(result["node/1/UY"] - 0.7 * way).max() < 1e-9
    assert np.abs(result["node/1/VX"][result.t > stop + 1e-6]).max() < 1e-15
    assert result["run/DISSIPATED_ENERGY"][-1] == pytest.approx(0.5 * 2 * speed**2, rel=1e-6)


SHAFT = """
.NOE
 I 1
.MCE
 I 1 CYLINDRICAL N 0 1 AXIS 1 0 0 FRICTION CONST 0.5 STICK RADIUS 0.2
 I 2 INERTIA N 1 M 2 J 0.18 0.1 0.1
.CLM STRU ACC VAL 0 -9 0
.INI
 VIT NOEUD 1 C 1 V 1
 VIT NOEUD 1 C 4 V 4
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF 0.8 H {h}
.FIN 1
"""

DISC = """
.NOE
 I 1
.MCE
 I 1 PLANAR N 0 1 AXIS 0 0 1 DIR 1 0 0 FRICTION CONST 0.5 STICK RADIUS 0.1
 I 2 INERTIA N 1 M 2 J 0.1 0.1 0.01
.CLM STRU ACC VAL 0 -3 -9
.INI
 VIT NOEUD 1 C 1 V 0.5
 VIT NOEUD 1 C 2 V 0.7
 VIT NOEUD 1 C 6 V -4
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF 0.8 H {h}
.FIN 1
"""


@pytest.mark.parametrize(
    ("deck", "channels", "mass", "pull", "levers", "start", "step", "allowed"),
    [
        # thrown across a slope that holds it at rest: the direction of sliding turns until the puck stops
        (
            PUCK.replace("{slope}", "-3"),
            ["node/1/UX", "node/1/UY"],
            [2, 2],
            [0, -3],
            [1, 1],
            [1, 0.7],
            0.0065,
            1e-5,
        ),
        # slides and turns, with a radius of gyration 1.5 times the radius at which it rubs
        (SHAFT, ["1/SLIDE", "1/ANGLE"], [2, 0.18], [0, 0], [1, 0.2], [1, 4], 0.01, 1e-5),
        # slides and spins on a slope
        (
            DISC,
            ["node/1/UX", "node/1/UY", "node/1/RZ"],
            [2, 2, 0.01],
            [0, -3, 0],
            [1, 1, 0.1],
            [0.5, 0.7, -4],
            0.005,
            3e-5,
        ),
    ],
    ids=["a puck on a slope", "a shaft in its sleeve", "a disc on a slope"],
)
def test_sliding_along_several_coordinates_stops(
    deck, channels, mass, pull, levers, start, step, allowed, tmp_path: Path
) -> None:
    """Bodies of 2 kg pressed by 18 N with a coefficient of 0.5."""
    levers, pull = np.array(levers), np.array(pull)
    stop, expected = sliding(
        lambda q, v, n: -9 * n * levers / mass + pull, [0] * len(start) + start, 1, levers
    )
    errors = order_of(deck, tmp_path, channels, expected, stop, step)
    assert errors[1] < allowed
    assert np.log2(errors[0] / errors[1]) > 1.9


DRUM = """
.NOE
 I 1 X 0 0.4 0
.MCE
 I 1 POINT_CYLINDER N 0 1 AXIS 1 0 0 ON 0 0 0 FRICTION CONST 0.5 PRELOAD {preload}
 I 2 INERTIA N 1 M 2
.CLM STRU ACC VAL 0 {gravity} 0
.INI
 VIT NOEUD 1 C 1 V {along}
 VIT NOEUD 1 C 3 V {around}
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF 0.4 H {h}
.FIN 1
"""


def test_a_point_rests_on_top_of_a_drum(tmp_path: Path) -> None:
    """Its weight is along the normal, and is none of the friction's."""
    result = run(DRUM.format(preload=0, gravity=-9, along=0, around=0, h=0.01), tmp_path)
    assert result["1/NORMAL_FORCE"] == pytest.approx(18, rel=1e-12)
    assert np.abs(result["1/FRICTION_FORCE"]).max() < 1e-12
    assert np.abs([result["1/SLIDE"], result["1/ANGLE"]]).max() < 1e-15


def test_a_point_stops_on_a_drum(tmp_path: Path) -> None:
    """It slides along and around, pressed by 18 N and by the force that keeps it on its helix."""
    deck = DRUM.replace("{h}", "{{h}}").format(preload=18, gravity=0, along=1, around=0.8)
    levers, mass = np.array([1, 0.4]), np.array([2, 2 * 0.4**2])
    stop, expected = sliding(
        lambda _, v, n: -0.5 * (18 + 2 * 0.4 * v[1] ** 2) * n * levers / mass, [0, 0, 1, 2], 1, levers
    )
    errors = order_of(deck, tmp_path, ["1/SLIDE", "1/ANGLE"], expected, stop, 0.005)
    assert errors[1] < 1e-5
    assert np.log2(errors[0] / errors[1]) > 1.9


def test_a_body_tumbles_to_rest_in_its_socket(tmp_path: Path) -> None:
    """Euler's equations with the moment of a ball against the spin."""
    deck = """
.NOE
 I 1
.MCE
 I 1 SPHERICAL N 0 1 FRICTION CONST 0.4 STICK RADIUS 0.05 PRELOAD 100
 I 2 INERTIA N 1 M 2 J 0.3 0.2 0.1
.INI
 VIT NOEUD 1 C 4 V 5
 VIT NOEUD 1 C 5 V -3
 VIT NOEUD 1 C 6 V 4
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF 1.2 H {h}
.FIN 1
"""
    inertia = np.array([0.3, 0.2, 0.1])

    def tumbles(_, s):
        spin = s[:3]
        n = spin / np.linalg.norm(spin)
        return (np.cross(inertia * spin, spin) - 0.4 * 100 * 0.05 * n) / inertia

    slowest = lambda _, s: np.linalg.norm(s) - 1e-9  # noqa: E731
    slowest.terminal = True
    exact = solve_ivp(tumbles, (0, 2), [5, -3, 4], events=slowest, rtol=1e-12, atol=1e-14, dense_output=True)
    assert exact.t[-1] < 1
    errors = []
    for h in (0.004, 0.002):
        result = run(deck.format(h=h), tmp_path)
        spin = np.array([exact.sol(t) * (t < exact.t[-1]) for t in result.t])
        found = np.linalg.norm([result[f"node/1/W{axis}"] for axis in "XYZ"], axis=0)
        speeds = np.abs(found - np.linalg.norm(spin, axis=1)).max()
        energies = np.abs(result["2/KINETIC_ENERGY"] - 0.5 * spin**2 @ inertia).max()
        errors.append(max(speeds, energies))
        rest = result.t > exact.t[-1] + 0.004
        assert found[rest].max() < 1e-12
        assert np.ptp(result["node/1/RX"][rest]) < 1e-14
    assert errors[1] < 1e-4
    assert np.log2(errors[0] / errors[1]) > 1.9


def test_a_disc_breaks_away_in_the_direction_of_least_resistance(tmp_path: Path) -> None:
    """A force off the centre grows until a disc lets go, which then slides and spins: with less friction at
    once, so that the direction in which it begins differs from that of the friction that held it."""
    deck = """
.NOE
 I 1
.MCE
 I 1 PLANAR N 0 1 AXIS 0 0 1 DIR 1 0 0 FRICTION CONST 0.3 0.5 STICK RADIUS 0.1
 I 2 INERTIA N 1 M 2 J 0.1 0.1 0.04
 I 3 FORCE N 1 DIR 1 0 0 V 10 NF 1
 I 4 TORQUE N 1 AXIS 0 0 1 V 0.6 NF 1
.FCT I 1 EXPR "T"
.CLM STRU ACC VAL 0 0 -9
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF 1 H {h}
.FIN 1
"""
    levers, mass, load = np.array([1, 0.1]), np.array([2, 0.04]), np.array([10, 0.6])
    away = 0.5 * 18 / np.linalg.norm(load / levers)

    def accelerates(t, n):
        return (load * t - 0.3 * 18 * n * levers) / mass

    # the direction that accelerates into itself
    angle = brentq(
        lambda a: np.dot(
            levers * accelerates(away, np.array([np.cos(a), np.sin(a)])), [-np.sin(a), np.cos(a)]
        ),
        0.1,
        1.4,
        xtol=1e-15,
    )

    def slides(t, s):
        u = levers * s[2:]
        speed = np.linalg.norm(u)
        n = u / speed if t > away + 1e-6 else np.array([np.cos(angle), np.sin(angle)])
        return [*s[2:], *accelerates(t, n)]

    exact = solve_ivp(
        slides, (away, 1), [0, 0, 0, 0], rtol=1e-10, atol=1e-13, max_step=0.01, dense_output=True
    )
    errors = []
    for h in (0.0025, 0.00125):
        result = run(deck.format(h=h), tmp_path)
        expected = np.array([exact.sol(t)[:2] if t > away else [0, 0] for t in result.t])
        found = np.stack([result["node/1/UX"], result["node/1/RZ"]], axis=1)
        errors.append(np.abs(found - expected).max())
        assert np.abs(found[result.t < away]).max() < 1e-14
    assert errors[1] < 1e-6
    assert np.log2(errors[0] / errors[1]) > 1.9


SLAB = """
.NOE
 I 1
 I 2 X 1 0 0
 I 3 X -0.5 0.8 0
 I 4 X -0.5 -0.8 0
.MCE
 I 1 POINT_PLANE N 0 1 AXIS 0 0 1 AT 1 0 0 DIR 1 0 0 FRICTION CONST 0.5 STICK
 I 2 POINT_PLANE N 0 1 AXIS 0 0 1 AT -0.5 0.8 0 DIR 1 0 0 FRICTION CONST 0.5 STICK
 I 3 POINT_PLANE N 0 1 AXIS 0 0 1 AT -0.5 -0.8 0 DIR 1 0 0 FRICTION CONST 0.5 STICK
 I 4 INERTIA N 1 M 2 J 0.1 0.1 0.2
.CLM STRU ACC VAL {slope} 0 -9
.SAM TYPE DYNAMIC RHO 0.9
.SUB TF 0.5 H 0.01
.FIN 1
"""


def test_a_slab_on_three_feet(tmp_path: Path) -> None:
    """Three feet hold a slab in six directions of which three are redundant: the least forces."""
    rests = run(SLAB.format(slope=4), tmp_path)
    assert np.abs(rests["node/1/UX"]).max() < 1e-15
    for foot in (1, 2, 3):
        assert rests[f"{foot}/FRICTION_FORCE"][1:] == pytest.approx(8 / 3, rel=1e-9)
    slides = run(SLAB.format(slope=5), tmp_path)
    assert slides["node/1/UX"] == pytest.approx(0.5 * (5 - 4.5) * slides.t**2, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("ranks", [2, 3])
def test_ranks_and_restart_decide_alike(ranks: int, tmp_path: Path) -> None:
    text = SLOPE.format(mu=0.2, end=1)
    whole = run(text, tmp_path)["node/1/UX"]
    assert run(text, tmp_path, "parallel", ranks=ranks)["node/1/UX"] == pytest.approx(
        whole, rel=1e-10, abs=1e-14
    )
    run(text, tmp_path, "cut", options=("--until", "0.21"), status=2)
    rest = run(text, tmp_path, "cut", options=("--restart", "cut"))
    assert np.array_equal(rest["node/1/UX"], whole)
