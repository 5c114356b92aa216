# SPDX-License-Identifier: BSD-3-Clause
"""ACCURACY where steps are as long as they may be: motions that are known, with forces that change faster."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from runs import run


def deck(analysis: str, stepping: str) -> str:
    """Prescribed speeds: no step has an error of motion. Friction changes with each pair of teeth."""
    return f""".UNIT SI
.NOE
 I 1
 I 2
.MCE
 I 1 GEAR N 1 2 KIND SPUR Z 21 33 MN 3E-3 AXIS 0 0 1 PLACE 1 0 0 FRICTION CONST 0.06 SLIDING PROFILE
 I 11 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 12 HINGE N 0 2 AXIS 0 0 1
 I 41 TORQUE N 2 AXIS 0 0 1 V 10
 I 32 INERTIA N 2 M 1 J 1E-3
.FCT
 I 1 EXPR "10"
.SAM TYPE DYNAMIC {analysis}
.SUB TF 0.1 H 1E-3 {stepping}
"""


@pytest.mark.parametrize(("setting", "asked"), [("FAST", 1e-2), ("NORMAL", 1e-3), ("FINE", 1e-5)])
def test_friction_of_teeth(setting: str, asked: float, tmp_path: Path) -> None:
    """Steps of a fiftieth of the run, ten to a pitch, pass over the changes. A smaller TOL was no help; each
    sample has its own balance now, and no run is made again."""
    found = run(deck(f"ACCURACY {setting}", ""), tmp_path)
    fine = run(deck("SCHEME RADAU", "").replace("H 1E-3", "H 2.5E-5"), tmp_path, "fine")
    for channel in ("1/NORMAL_FORCE", "1/FRICTION_FORCE", "11/DRIVE_TORQUE"):
        right = np.interp(found.t, fine.t, fine[channel])
        off = found[channel] - right
        assert np.sqrt(np.mean(off**2)) < asked * np.ptp(right), channel
    listing = (tmp_path / "deck.lst").read_text()
    assert "chaotic" not in listing
    assert "  longest step  " not in listing


TOP = (
    f'INPUT "{Path(__file__).with_name("tumbling_top.dat")}"\n'
    + """.SAM TYPE DYNAMIC SCHEME RADAU {restart}
.SUB TF 0.3 H 0.007 TOL 0.1
.SAI HISTORY DT 0.001 RESTART DT 1E-6
"""
)


def test_values_within_them_behind_a_restart(tmp_path: Path) -> None:
    """Where every step needs a tangent for each stage, none leaves factors behind. Values within the first
    steps of a continuation were found without those that the whole run still had."""
    whole = run(TOP.format(restart=""), tmp_path, "whole")
    with h5py.File(whole.file) as file:
        points = [file[f"restart/{name}"] for name in file["restart"] if name != "latest"]
        due = [float(p.attrs["time"]) for p in points if p["radau/coupled"][2] > 0]
    assert len(due) > 10
    for time in due[:-3:6]:
        part = run(TOP.format(restart=f'RESTART "whole" T {time!r}'), tmp_path, "part")
        for channel in ("UX", "VX", "WX"):
            assert np.array_equal(whole[f"node/2/{channel}"], part[f"node/2/{channel}"]), (time, channel)
