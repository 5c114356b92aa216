# SPDX-License-Identifier: BSD-3-Clause
"""Decks on which earlier versions gave a wrong answer, failed or misled (tests/verify/defects): each has the
right number now, or the right message."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
from runs import Run, program, run
from scipy.optimize import brentq

DECKS = Path(__file__).parent / "defects"

REFUSED = {
    "check_names_velocity_in_static": (1, "node 1 has no output VX"),
    "controller_names_joint_without_node": (1, "node 2 of HINGE 4 does not exist"),
    "coupling_names_joint_without_node": (1, "node 2 of PRISMATIC 3 does not exist"),
    "hands_parallel_bearings": (1, "30 degrees away"),
    "large_initial_time": (1, "H is too short to be added to a time of 1e+15"),
    "kinematic_free": (2, "1 motion is free here, for example that of node 1 (y)"),
    "massless_gear": (2, "node 1 (rz) has no inertia, and no joint, spring or damper holds it"),
    "jammed_slider": (2, "The friction jams"),
}
SAID = {
    "initial_angle_of_a_hinge": "was given as 30 deg and is 25.2",
    "initial_turn_of_a_body": "was given as 5 deg and is 1.6",
    "initial_turn_no_redundancy": "was given as 5 deg and is 1.6",
}


def solve(name: str, folder: Path) -> Run:
    return run((DECKS / f"{name}.dat").read_text(), folder, name)


@pytest.mark.parametrize("name", [*REFUSED, *SAID])
def test_message(name: str, tmp_path: Path) -> None:
    done = subprocess.run(
        [program(), DECKS / f"{name}.dat", "-o", tmp_path / name], capture_output=True, text=True, timeout=120
    )
    status, words = REFUSED.get(name, (0, SAID.get(name, "")))
    assert done.returncode == status, done.stderr
    assert words in done.stderr


def test_springs_in_series(tmp_path: Path) -> None:
    result = solve("massless_node", tmp_path)
    w = np.sqrt(50)
    assert result["node/3/UX"] == pytest.approx(np.sin(w * result.t) / w, abs=1e-3)


def test_damped_without_mass(tmp_path: Path) -> None:
    result = solve("massless_damped", tmp_path)
    assert result["node/2/UX"][-1] == pytest.approx(0.03, rel=1e-9)


def test_a_drive_through_a_flat_parallelogram(tmp_path: Path) -> None:
    result = solve("parallelogram_flat", tmp_path)
    assert result["12/ANGLE"] == pytest.approx(result["11/ANGLE"], abs=1e-9)
    assert np.abs(result["11/DRIVE_TORQUE"]).max() < 1e3


def test_half_turns_cut_the_step(tmp_path: Path) -> None:
    assert solve("cuts_per_h", tmp_path)["1/ANGLE"][-1] == pytest.approx(200, rel=1e-9)


def test_an_interval_shorter_than_any_step(tmp_path: Path) -> None:
    assert solve("interval_below_time_resolution", tmp_path).t[-1] == 1


def test_imposed_in_small_units(tmp_path: Path) -> None:
    assert solve("imposed_small_units", tmp_path)["node/3/UX"][0] == pytest.approx(5e-4, rel=1e-6)


def test_nodes_nearly_in_one_place(tmp_path: Path) -> None:
    near = solve("nodes_nearly_in_one_place", tmp_path)
    text = (DECKS / "nodes_nearly_in_one_place.dat").read_text().replace("0.30000000000000004", "0.3")
    one = run(text, tmp_path, "one")
    assert near["4/ANGLE"] == pytest.approx(one["4/ANGLE"], abs=1e-9)


def test_friction_brings_a_rotor_to_rest(tmp_path: Path) -> None:
    """M = mu r N0 stops it after w0^2 J/(2 M); what creeps does so below VREG."""
    result = solve("stick_hinge_H1e-3", tmp_path)
    assert result["2/ANGLE"][-1] == pytest.approx(14**2 * 1e-3 / (2 * 0.2 * 0.02 * 500), rel=2e-3)
    assert np.abs(result["2/SPEED"][-1]) < 1e-4 / 0.02


def test_a_worm_holds_for_100_s(tmp_path: Path) -> None:
    result = solve("selflock_mu0_12", tmp_path)
    assert np.ptp(result["node/2/RZ"]) < 1e-12
    assert np.abs(result["3/SLIDING_SPEED"]).max() < 1e-12


def test_a_worm_creeps_below_vreg(tmp_path: Path) -> None:
    """The load asks for the friction of the speed s VREG, s (15 - 10 s^2 + 3 s^4)/8 = 0.082/0.12."""
    text = (DECKS / "selflock_mu0_12.dat").read_text()
    regularised = text.replace("FRICTION CONST 0.12", "FRICTION CONST 0.12 VREG 2D-5")
    assert regularised != text
    result = run(regularised, tmp_path)
    needed = np.cos(np.radians(20)) * np.tan(np.radians(5)) / 0.12
    s = brentq(lambda s: s * (15 - 10 * s**2 + 3 * s**4) / 8 - needed, 0, 1)
    sliding = result["3/SLIDING_SPEED"][len(result.t) // 2 :]
    assert sliding == pytest.approx(2e-5 * s, rel=1e-3)


def test_a_hoist_stops_and_is_held(tmp_path: Path) -> None:
    result = solve("hoist_mu0_12", tmp_path)
    held = result.t > 2.5
    assert np.ptp(result["node/2/RZ"][held]) < 1e-12
    assert np.abs(result["node/2/RZ"]).max() > 1


def test_a_light_load_on_teeth_with_backlash(tmp_path: Path) -> None:
    """Released in touch, the pair swings between nothing and twice F m_B/(m_A + m_B), F = T/r_A = 4."""
    result = solve("light_load_jeu_1e-4", tmp_path)
    crest = 2 * 4 * 8 / 12
    assert result["3/NORMAL_FORCE"].max() * np.cos(np.radians(20)) == pytest.approx(crest, rel=1e-4)
    assert result["3/U_M"].max() == pytest.approx(crest / 1e8, rel=1e-4)


def test_a_reversal_of_crossed_gears(tmp_path: Path) -> None:
    result = solve("dynamic_reversal", tmp_path)
    assert result.t[-1] == 0.5
    handled = result["run/KINETIC_ENERGY"].max() + result["run/DISSIPATED_ENERGY"].max()
    assert np.abs(result["run/ENERGY_ERROR"]).max() < 1e-2 * handled
