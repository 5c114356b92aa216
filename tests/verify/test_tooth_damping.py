# SPDX-License-Identifier: BSD-3-Clause
"""Teeth with play, a transmission error and a damper, under a load so light that the damper of the paper,
which acts along u_m, would lift the flanks. DAMP CONTACT acts along their approach."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import run

TEETH, SPEED, ERROR, LOAD, INERTIA = 20, 4.0, 0.01, 20.0, 1.6
RADII = 20.0, 40.0  # millimetres
DECK = f"""
.NOE
 I 1
 I 2
.MCE
 I 1 GEAR N 1 2 KIND SPUR Z {TEETH} 40 MN 2 AXIS 0 0 1 PLACE 1 0 0 KM 1E5 {{damping}} JEU 0.05 ERR COS {ERROR}
 I 2 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 3 HINGE N 0 2 AXIS 0 0 1
 I 5 TORQUE N 2 AXIS 0 0 1 V {LOAD}
 I 6 INERTIA N 1 M 1 J 0.4
 I 7 INERTIA N 2 M 1 J {INERTIA}
.FCT
 I 1 STEP 0 0 0.2 {SPEED}
.SAM TYPE DYNAMIC {{scheme}}
.SUB TF 0.4 H 1E-4 {{control}}
.FIN
"""
FIXED = {"scheme": "SCHEME CHUNG RHO 0.8", "control": ""}
CONTROLLED = {"scheme": "SCHEME RADAU", "control": "TOL 1E-5"}


@pytest.mark.parametrize("steps", [FIXED, CONTROLLED], ids=["CHUNG", "RADAU"])
@pytest.mark.parametrize("damping", ["CM 0.3", "CM 5", "CM 25", "XI 0.1"])
def test_flanks_stay_in_contact_under_a_light_load(damping: str, steps: dict, tmp_path: Path) -> None:
    """At constant speed wheel B follows the error: F cos(alpha) = T/r_B + (J_B/r_B^2) X z^2 w^2 cos(z w t).
    The damper along u_m, c_m x_err' larger than the load, made flanks touch and part without end."""
    found = run(DECK.format(damping=damping, **steps), tmp_path)
    mean = LOAD / RADII[1]
    swing = INERTIA / RADII[1] ** 2 * ERROR * (TEETH * SPEED) ** 2
    late = found.t > 0.3
    force = found["1/NORMAL_FORCE"][late] * np.cos(np.radians(20))
    assert force.max() == pytest.approx(mean + swing, rel=5e-3)
    assert force.min() == pytest.approx(mean - swing, rel=5e-3)
    assert set(found["1/CONTACT"]) == {1}
    work = np.abs(found["run/EXTERNAL_WORK"]).max()
    assert np.abs(found["run/ENERGY_ERROR"]).max() < 1e-4 * work


def test_the_damper_of_the_paper_pulls(tmp_path: Path) -> None:
    """DAMP ALWAYS acts along u_m, also across the gap."""
    found = run(DECK.format(damping="CM 5 DAMP ALWAYS", **FIXED), tmp_path)
    assert found["1/NORMAL_FORCE"].min() < -1
