# SPDX-License-Identifier: BSD-3-Clause
"""Order tracking: signals whose orders are known, from the command line and in Python."""

from __future__ import annotations

import csv
from pathlib import Path

import models
import numpy as np
import pytest
from engrane_post.errors import UserError
from engrane_post.order_spectra import order_map, order_spectrum, over_angle


def run_up(end: float = 2.0, samples: int = 20001, start: float = 30.0, rate: float = 150.0):
    """Times and angle of a wheel whose speed rises evenly."""
    t = np.linspace(0, end, samples)
    return t, start * t + 0.5 * rate * t**2


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("order", [1.0, 2.5, 20.0, 47.3])
def test_an_order_of_one_shows_one(order: float, sense: int) -> None:
    t, angle = run_up()
    samples = over_angle(t, 5 + np.cos(order * angle + 0.4), sense * angle)
    s = order_spectrum(samples)
    (o, a), *_ = s.peaks(1)
    assert o == pytest.approx(order, abs=5e-3)
    assert order < samples.highest
    assert a == pytest.approx(1, rel=5e-3)
    assert s.mean == pytest.approx(5, abs=1e-3)


def test_uneven_steps_and_a_start_from_rest() -> None:
    rng = np.random.default_rng(2)
    t = np.cumsum(rng.uniform(0.5e-4, 1.5e-4, 20000))
    t = np.insert(t - t[0], 5000, t[4999] - t[0])  # a restart repeats a time
    angle = 60 * t**2
    s = order_spectrum(over_angle(t, 2 * np.sin(30 * angle), angle))
    assert s.peaks(1)[0] == (pytest.approx(30, abs=0.01), pytest.approx(2, rel=5e-3))


def test_what_keeps_its_frequency_does_not_fold_back() -> None:
    """A hum of 3 kHz is order 628 at the first speed and order 57 at the last: none of it may show below."""
    t, angle = run_up(samples=40001)
    samples = over_angle(t, np.sin(2 * np.pi * 3000 * t), angle)
    s = order_spectrum(samples)
    lowest = 3000 * 2 * np.pi / 330
    assert s.amplitude[s.frequency < 0.9 * lowest].max() < 1e-3
    assert samples.highest == pytest.approx(0.25 / (330 * (t[1] - t[0]) / 2 / np.pi), rel=1e-3)


def test_map() -> None:
    """The order stays and its amplitude, which rises with speed, is right at each."""
    t, angle = run_up()
    speed = 30 + 150 * t
    chart = order_map(over_angle(t, 1e-2 * speed * np.cos(12 * angle), angle), turns=5, highest=30)
    assert (np.diff(chart.speed) > 0).all()
    assert chart.order[chart.amplitude.argmax(axis=1)] == pytest.approx(12, abs=0.06)
    middle = slice(2, -2)
    expected = 1e-2 * 2 * np.pi * chart.speed
    assert chart.amplitude.max(axis=1)[middle] == pytest.approx(expected[middle], rel=1e-2)


def test_a_wheel_that_turns_back() -> None:
    t = np.linspace(0, 1, 1001)
    with pytest.raises(UserError, match="turns back at t = 0"):
        over_angle(t, t, np.sin(np.pi * t))
    with pytest.raises(UserError, match="does not turn"):
        over_angle(t, t, 0 * t)


@pytest.fixture
def rising(tmp_path: Path) -> Path:
    """Wheel A (20 teeth) of the pair runs up; the force has the first two tooth orders."""
    t = models.STEP * np.arange(4001)
    angle = 200 * t + 0.5 * 2e4 * t**2
    force = 500 + 80 * np.sin(20 * angle) + 20 * np.sin(40 * angle)
    return models.two_wheels(
        tmp_path / "rising.h5",
        history={
            "element/7/NORMAL_FORCE": (force, "N", "normal force"),
            "element/7/PSI_A": (angle, "rad", "turn of wheel A"),
            "node/1/WZ": (200 + 2e4 * t, "rad/s", "angular velocity z"),
        },
    )


def is_picture(path: Path) -> bool:
    return path.read_bytes()[:4] == b"\x89PNG" and path.stat().st_size > 5000


@pytest.mark.parametrize("wheel", [(), ("--wheel", "7/psi_a"), ("--wheel", "node/1/WZ")])
def test_command(rising: Path, command, tmp_path: Path, monkeypatch, wheel) -> None:
    monkeypatch.chdir(tmp_path)
    status, out, err = command("orders", rising, "7.normal_force", *wheel, "--csv", "a.csv")
    assert (status, err) == (0, "")
    assert 'tooth order of GEAR 7 "pair": 20' in out
    rows = [line.split() for line in out.splitlines() if " x GEAR" in line]
    assert [float(v) for v in rows[0][:2]] == pytest.approx([20, 80], rel=1e-2)
    assert [float(v) for v in rows[1][:2]] == pytest.approx([40, 20], rel=1e-2)
    assert rows[1][3] == "2"
    assert is_picture(tmp_path / "rising_element_7_NORMAL_FORCE_orders.png")
    table = list(csv.reader((tmp_path / "a.csv").open()))
    assert table[0] == ["order", "element/7/NORMAL_FORCE [N]"]
    assert max(float(r[1]) for r in table[1:]) == pytest.approx(80, rel=1e-2)


@pytest.mark.parametrize("words", [(), ("--log",), ("--turns", "0.5", "--max", "50")])
def test_map_command(rising: Path, command, tmp_path: Path, monkeypatch, words) -> None:
    monkeypatch.chdir(tmp_path)
    status, _, err = command("orders", rising, "7.normal_force", "--map", "--csv", "m.csv", *words)
    assert (status, err) == (0, "")
    assert is_picture(tmp_path / "rising_element_7_NORMAL_FORCE_order_map.png")
    table = list(csv.reader((tmp_path / "m.csv").open()))
    orders = np.array(table[0][1:], float)
    body = np.array(table[1:], float)
    assert table[0][0] == "speed [rpm] / order"
    assert 200 * 30 / np.pi < body[0, 0] < body[-1, 0] < 1000 * 30 / np.pi
    assert orders[body[:, 1:].argmax(axis=1)] == pytest.approx(20, abs=0.6)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("7.normal_force", "--wheel", "7.normal_force"), "is no angle"),
        (("kinetic_energy",), "Say whose turns count, for instance --wheel element/7/PSI_A"),
        (("7.normal_force", "7.u_m", "--map"), "draws one channel"),
        (("7.normal_force", "--map", "--turns", "1000"), "does not fit"),
        (("7.normal_force", "--csv", "a.txt"), "ends in .csv"),
        (("7.normal_force", "--to", "2e-5"), "orders need 8"),
        (("7.normal_force", "--map", "--from", "0.03", "--to", "0.0301"), "does not fit"),
    ],
)
def test_errors(rising: Path, command, tmp_path: Path, monkeypatch, words, sentence) -> None:
    monkeypatch.chdir(tmp_path)
    status, _, err = command("orders", rising, *words)
    assert status == 1
    assert sentence in err and "Traceback" not in err


def test_a_map_needs_a_run_up(two: Path, command, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    status, _, err = command("orders", two, "7.normal_force", "--map", "--wheel", "node/1/WZ")
    assert status == 1 and "needs a run-up" in err
    assert command("orders", two, "7.normal_force", "--wheel", "node/1/WZ")[0] == 0


def test_a_short_run_up_has_longer_stretches(command, tmp_path: Path, monkeypatch) -> None:
    """Unbalance over 8.8 turns: a sixteenth of them does not hold a period of it."""
    monkeypatch.chdir(tmp_path)
    t = models.STEP * np.arange(4001)
    angle = 2 * np.pi * (20 * t + 0.5 * 1e4 * t**2)
    models.two_wheels(
        tmp_path / "short.h5",
        history={
            "element/7/NORMAL_FORCE": (80 * np.sin(angle), "N", "normal force"),
            "element/7/PSI_A": (angle, "rad", "turn of wheel A"),
        },
    )
    words = ("orders", "short", "7.normal_force", "--map", "--csv", "m.csv", "--harmonics", "0")
    status, out, err = command(*words)
    assert (status, err) == (0, "")
    assert "map: stretches of 2.933 turns, resolution 0.6818" in out and "note" not in out
    table = list(csv.reader((tmp_path / "m.csv").open()))
    orders, body = np.array(table[0][1:], float), np.array(table[1:], float)
    assert orders[body[:, 1:].argmax(axis=1)] == pytest.approx(1, abs=0.1)
    assert body[:, 1:].max(axis=1) == pytest.approx(80, rel=0.1)
    out = command(*words, "--turns", "0.55")[1]
    assert "these stretches do not show order 1 as a line; that takes 2 turns or more" in out


def test_help(command, capsys) -> None:
    with pytest.raises(SystemExit) as e:
        command("orders", "--help")
    assert e.value.code == 0
    assert "examples:" in capsys.readouterr().out
