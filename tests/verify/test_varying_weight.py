# SPDX-License-Identifier: BSD-3-Clause
"""Gravity by a function of time does work, as other loads do. Its potential was counted, and not what the
change of the function added to it: runs ended for their energy balance wherever the origin was far away, and
structures under a weight that grew "snapped to a distant equilibrium"."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from runs import run

# each carries the weight of its own mass; Z is the height of it all
MODELS = {
    "body": """
.NOE
 I 1 Z {z}
.MCE
 I 1 PRISMATIC N 0 1 AXIS 0 0 1 K 1000
 I 2 INERTIA N 1 M 10
""",
    "body with an arm": """
.NOE
 I 1 Z {z}
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 0 AT 0 0 {z} K 500
 I 2 RIGID N 1 M 10 J 0.1 CG 1 0 {z}
""",
    "beam": """
.NOE
 I 1 X 0 0 {z}
 I 2 X 0.5 0 {z}
 I 3 X 1 0 {z}
.MAT
 I 1 YT 2D9 NT 0.3 M 7800
.BPR
 I 1 CIRCLE 0.03
.MCE
 I 1 BEAM N 1 2 3 MAT 1 BPR 1
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
""",
    "bar": """
.NOE
 I 1 X 0 0 {z}
 I 2 X 1 0 {z}
.MCE
 I 1 BAR N 1 2 EA 1D4 M 5 TENSION 10
 I 2 SPRING N 0 2 K 500 L0 {length}
.CLM
 FIX NOEUD 1 C 1 2 3
 FIX NOEUD 2 C 1 2
""",
    "cable": """
.NOE
 I 1 X 0 0 {z}
 I 2 X 1 0 {z}
.MCE
 I 1 CABLE N 1 2 EA 1D4 M 2 TENSION 30
 I 2 PRISMATIC N 0 2 AXIS 1 0 0 K 200
.CLM
 FIX NOEUD 1 C 1 2 3
""",
    "membrane": """
.NOE
 I 1 X 0 0 {z}
 I 2 X 1 0 {z}
 I 3 X 1 1 {z}
 I 4 X 0 1 {z}
 I 5 X 0.5 0.5 {z}
.MAT
 I 1 YT 1000. NT 0.3 M 5.
.MCE
 I 1 MEMBRANE N 1 2 5 MAT 1 THICK 0.1 TENSION 20
 I 2 MEMBRANE N 2 3 5 MAT 1 THICK 0.1 TENSION 20
 I 3 MEMBRANE N 3 4 5 MAT 1 THICK 0.1 TENSION 20
 I 4 MEMBRANE N 4 1 5 MAT 1 THICK 0.1 TENSION 20
.CLM
 FIX NOEUD 1 2 3 4 C 1 2 3
""",
    "solid": """
.NOE
 I 1 X 0 0 {z}
 I 2 X 1 0 {z}
 I 3 X 1 1 {z}
 I 4 X 0 1 {z}
 I 5 X 0 0 {top}
 I 6 X 1 0 {top}
 I 7 X 1 1 {top}
 I 8 X 0 1 {top}
.MAI
 I 1 N 1 2 3 4 0 5 6 7 8
.MAT
 I 1 YT 1D6 NT 0.3 M 1000.
.AEL
 I 1 MAT 1
.CLM
 NOEUD 1 A 4 FIX C 1 2 3
""",
}
LOAD = """.CLM ADD STRU ACC VAL 0 0 -9.81 NF 1
.FCT
 I 1 EXPR "{formula}"
.SAM TYPE {sam}
.SUB TF 1 H {h}
.FIN 1
"""


def weighed(model: str, sam: str, h: float, folder: Path, height: float = 0, formula: str = "T"):
    z = {"z": height, "top": height + 1, "length": np.hypot(1, height)}
    return run(MODELS[model].format(**z) + LOAD.format(sam=sam, h=h, formula=formula), folder)


@pytest.mark.parametrize("height", [0, 1000])
@pytest.mark.parametrize("model", MODELS)
def test_a_weight_that_grows(model: str, height: float, tmp_path: Path) -> None:
    """The work is what springs store: to second order in the load steps, and wherever the origin is."""
    errors = []
    for h in (0.05, 0.025):
        r = weighed(model, "STATIC", h, tmp_path, height)
        work = abs(r["run/EXTERNAL_WORK"][-1])
        assert work > 0.01
        errors.append(abs(r["run/ENERGY_ERROR"][-1]) / work)
        assert "snapped" not in r.file.with_suffix(".lst").read_text(encoding="utf-8")
    assert errors[1] < 4e-3
    assert errors[0] < 1e-8 or errors[0] > 3 * errors[1]


@pytest.mark.parametrize("height", [0, 1000])
@pytest.mark.parametrize("model", MODELS)
def test_a_weight_that_grows_in_motion(model: str, height: float, tmp_path: Path) -> None:
    r = weighed(model, "DYNAMIC SCHEME RADAU", 0.002, tmp_path, height)
    passed = np.abs(np.diff(r["run/EXTERNAL_WORK"])).sum()
    assert passed > 1e-4
    assert np.abs(r["run/ENERGY_ERROR"]).max() < 1e-2 * passed


def test_the_work_of_a_weight(tmp_path: Path) -> None:
    """A mass on a spring: (m g)^2/2k in statics. In motion with g = 9.81 T, z'' + w^2 z = -9.81 T."""
    m, k = 10, 1000
    r = weighed("body", "STATIC", 0.1, tmp_path)
    assert r["run/EXTERNAL_WORK"][-1] == pytest.approx((m * 9.81) ** 2 / (2 * k), rel=1e-9)
    r = weighed("body", "DYNAMIC SCHEME RADAU", 0.005, tmp_path)
    w, t = np.sqrt(k / m), r.t
    z, v = -9.81 / w**2 * (t - np.sin(w * t) / w), -9.81 / w**2 * (1 - np.cos(w * t))
    assert r["run/POTENTIAL_ENERGY"] == pytest.approx(k / 2 * z**2, abs=1e-5)
    assert r["run/EXTERNAL_WORK"] == pytest.approx(k / 2 * z**2 + m / 2 * v**2, abs=1e-3)


def test_a_weight_that_jumps(tmp_path: Path) -> None:
    """What falls off a hook: its energy is that of the fall alone."""
    r = weighed("body", "DYNAMIC", 0.002, tmp_path, height=1000, formula="if(T < 0.5, 0, 1)")
    assert np.abs(r["run/ENERGY_ERROR"]).max() < 1e-3 * np.ptp(r["run/EXTERNAL_WORK"])
    assert np.abs(r["run/EXTERNAL_WORK"][r.t < 0.5]).max() == 0
