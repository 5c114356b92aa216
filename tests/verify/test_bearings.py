# SPDX-License-Identifier: BSD-3-Clause
"""Bearings: equilibria of rolling elements against a second program, and a shaft that rattles in its play."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from bearings import ANGULAR, CYLINDRICAL, DEEP_GROOVE, TAPERED, Bearing, equilibrium
from runs import Run, run


def card(element: int, b: Bearing, unit: float) -> str:
    """The bearing's record, in a unit of length of so many metres."""
    what = (
        f"ROLLERS {b.count} L {b.length / unit:.12g}"
        if b.length
        else f"BALLS {b.count} FI {b.conformity[0]} FO {b.conformity[1]}"
    )
    rest = f" ALPHA {np.degrees(b.angle):.12g}" if b.angle else f" CLEARANCE {b.clearance / unit:.12g}"
    rest += f" PRELOAD {b.preload / unit}" if b.preload else ""
    return (
        f" I {element} BEARING N 0 1 AXIS {b.axis} 0 0 AXIS2 0 0 -1 AT {b.at / unit:.12g} 0 0 {what} "
        f"D {b.diameter / unit:.12g} DM {b.pitch / unit:.12g} MAT 1{rest}"
    )


def displaced(bearings: list[Bearing], load: list[float], fixed: str, unit: float, folder: Path) -> Run:
    """Node 1 under a force and moment; kg, s, and a unit of length of so many metres."""
    forces = "\n".join(
        f" CHA NOEUD 1 C {i + 1} V {value / unit ** (1 if i < 3 else 2):.12g} NF 1"
        for i, value in enumerate(load)
        if value
    )
    cards = "\n".join(card(i + 1, b, unit) for i, b in enumerate(bearings))
    return run(
        f""".NOE
 I 1 X 0 0 0
.MAT
 I 1 YT {206e9 * unit:.12g} NT 0.3
.MCE
{cards}
 I 9 TSPRING N 0 1 AXIS 1 0 0 K {1 / unit**2:.12g}
.CLM
 {fixed}
{forces}
.FCT
 I 1 RAMP 0 0 1 1
.SAM TYPE STATIC
.SUB TF 1 H 0.5
.FIN 1
""",
        folder,
    )


HELD = "FIX NOEUD 1 C 4 5 6"
TILTS = {
    "groove": ([DEEP_GROOVE], [2000, 0, -3000, 0, 5, 0]),
    "angular": ([ANGULAR], [17800, 3000, 4000, 0, 100, -60]),
    "tapered": (TAPERED, [0, 0, -9000, 0, 300, 0]),
}
EQUILIBRIA = {
    "groove, held": ([DEEP_GROOVE], [0, 0, -8900, 0, 0, 0], HELD, [0, 1, 2], 1.0),
    "angular, held": ([ANGULAR], [17800, 0, 0, 0, 0, 0], HELD, [0, 1, 2], 1.0),
    "cylindrical, held": ([CYLINDRICAL], [0, 0, -12000, 0, 0, 0], "FIX NOEUD 1 C 1 4 5 6", [1, 2], 1.0),
    "cylindrical": ([CYLINDRICAL], [0, 0, -12000, 0, 20, 0], "FIX NOEUD 1 C 1", [1, 2, 4, 5], 1.0),
    **{
        f"{name}, in {unit} m": (*case, "", [0, 1, 2, 4, 5], unit)
        for name, case in TILTS.items()
        for unit in (1.0, 1e-3)
    },
}


@pytest.mark.parametrize(("bearings", "load", "fixed", "free", "unit"), EQUILIBRIA.values(), ids=EQUILIBRIA)
def test_equilibria(
    bearings: list[Bearing], load: list[float], fixed: str, free: list[int], unit: float, tmp_path: Path
) -> None:
    r = displaced(bearings, load, fixed, unit, tmp_path)
    q = equilibrium(bearings, np.array(load, float), free)
    moved = np.array([r[f"node/1/U{c}"][-1] for c in "XYZ"]) * unit
    size = np.abs(q[:3]).max()
    assert moved == pytest.approx(q[:3], rel=1e-6, abs=1e-6 * size)
    for i, b in enumerate(bearings):
        assert r[f"{i + 1}/ELEMENT_LOAD"][-1] * unit == pytest.approx(b.loads(q).max(), rel=1e-5)
        assert r[f"{i + 1}/LOADED_ELEMENTS"][-1] == (b.loads(q) > 0).sum()
        assert r[f"{i + 1}/SPRING_ENERGY"][-1] * unit**2 == pytest.approx(b.energy(q), rel=1e-5)


RATTLE = """.UNIT SI
.NOE
 I 1 X 0 0 0
.MAT
 I 1 YT 2.06D11 NT 0.3
.MCE
 I 1 INERTIA N 1 M 2 J 0.002 0.001 0.001
 I 2 BEARING N 0 1 AXIS 1 0 0 AXIS2 0 0 -1  BALLS 9 D 12.7D-3 DM 65.D-3 CLEARANCE 40.D-6 MAT 1
.INI
 VIT NOEUD 1 C 2 V 0.03
 VIT NOEUD 1 C 3 V -0.05
 VIT NOEUD 1 C 4 V 300
.SAM TYPE DYNAMIC RHO {rho}
.SUB TF 0.01 H {h}
.FIN 1
"""


def test_rattle(tmp_path: Path) -> None:
    """A shaft that flies from side to side of its play loses nothing, and takes load and loses it at ends of
    steps: errors at the end, against far shorter steps, fall with order two."""
    ends = []
    for i, h in enumerate([2e-5, 1e-5, 5e-6, 1.25e-6]):
        r = run(RATTLE.format(rho=1, h=h), tmp_path, f"rattle{i}")
        ends.append(np.array([r[f"node/1/U{c}"][-1] for c in "YZ"]))
        energy = r["2/SPRING_ENERGY"] + r["run/KINETIC_ENERGY"]
        assert np.abs(energy / energy[0] - 1).max() < 0.02 * (h / 2e-5) ** 2
        loaded = r["2/ELEMENT_LOAD"] > 0
        assert 8 < np.abs(np.diff(loaded.astype(int))).sum() < 40
    errors = [np.linalg.norm(e - ends[-1]) for e in ends[:-1]]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx([2, 2], abs=0.3)
    assert errors[0] < 0.01 * 20e-6  # of the play to each side


def test_the_largest_load_between_steps(tmp_path: Path) -> None:
    """A rotor of 3 kg whirls in nine balls with play. Another ball becomes the most loaded within steps: the
    corner was interpolated, 4e-3 of the range off at NORMAL and 5e-4 at REFERENCE."""
    bearing = (
        "BEARING N 0 1 AXIS 1 0 0 AXIS2 0 1 0 AT {} 0 0 BALLS 9 D 10D-3 DM 50D-3 CLEARANCE 10D-6 MAT 1 "
        "C 400 400 400 0 0.05 0.05"
    )
    deck = f""".NOE
 I 1 X 0 0 0
.MAT
 I 1 YT 2.06D11 NT 0.3
.MCE
 I 1 INERTIA N 1 M 3 J 0.004 0.025 0.025 OFFSET 0 2D-5 0
 I 2 {bearing.format(-0.08)}
 I 3 {bearing.format(0.06)}
.FCT
 I 1 EXPR "150*SIN(300*T)"
.CLM
 CHA NOEUD 1 C 2 V 1 NF 1
 CHA NOEUD 1 C 3 V -400
.INI
 VIT NOEUD 1 C 4 V 500
.SUB TF 0.01 H 4D-5 {{tolerance}}
.SAM TYPE DYNAMIC SOLVER KLU {{by}}
.FIN
"""
    found = run(deck.format(tolerance="", by="ACCURACY NORMAL"), tmp_path)
    (tmp_path / "truth").mkdir()
    truth = run(deck.format(tolerance="TOL 1D-9", by="SCHEME RADAU"), tmp_path / "truth")
    for channel in ("2/ELEMENT_LOAD", "3/ELEMENT_LOAD", "2/CONTACT_PRESSURE"):
        exact = truth[channel]
        assert np.max(np.abs(found[channel] - exact)) < 2e-4 * np.ptp(exact), channel
