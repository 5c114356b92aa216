# SPDX-License-Identifier: BSD-3-Clause
"""Beams, shafts and membranes that expand with the temperature of their nodes."""

from __future__ import annotations

from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest
from engrane_post import Results
from runs import engrane, run, said

ALPHA, YOUNG = 1.2e-5, 2.1e11
MATERIAL = f".MAT\n I 1 YT {YOUNG!r} NT 0.3 M 7850. A {ALPHA!r}\n"
SIZE = 0.02  # of a square section

#: five nodes along x, two pieces
BAR = f""".NOE
 I 1 X 0 0 0
 I 2 X 0.5 0 0
 I 3 X 1 0 0
 I 4 X 1.5 0 0
 I 5 X 2 0 0
{MATERIAL}.BPR
 I 1 RECTANGLE {SIZE} {SIZE}
"""
BEAM = ".MCE\n I 1 BEAM N 1 2 3 4 5 BPR 1 MAT 1 AXIS2 0 1 0\n"
RISES = {1: 100, 2: 50, 3: 80, 4: 20, 5: -40}
LINEAR_STATICS = ".SAM TYPE STATIC\n.SUB TF 1 H 1\n.FIN 1\n"


def temperatures(rises: dict[int, float], more: str = "") -> str:
    return "".join(f" NOEUD {node} TEMP V {rise!r}{more}\n" for node, rise in rises.items())


def even(rise: float, last: int = 5) -> dict[int, float]:
    return dict.fromkeys(range(1, last + 1), rise)


def growth(rises: dict[int, float]) -> float:
    """Of two pieces of three nodes a metre long: Simpson's rule is exact for their temperatures."""
    weights = np.array([1, 4, 2, 4, 1]) / 6
    return ALPHA * weights @ list(rises.values())


def test_grows_freely(tmp_path: Path) -> None:
    """Temperatures that change along a cantilever: the tip moves by their integral, without stress."""
    free = run(
        BAR + BEAM + ".CLM\n NOEUD 1 FIX C 1 2 3 4 5 6\n" + temperatures(RISES) + LINEAR_STATICS, tmp_path
    )
    assert free["node/5/UX"][-1] == pytest.approx(growth(RISES), rel=1e-10)
    assert abs(free["1/NORMAL_FORCE_A"][-1]) < 1e-8 * YOUNG * SIZE**2 * ALPHA * 100


@pytest.mark.parametrize("cells", [False, True])
def test_held(cells: bool, tmp_path: Path) -> None:
    """Between two walls the mean of the temperatures pushes; beams of .MCE and cells of .MAI."""
    line = BEAM
    if cells:
        line = (
            '.MAI\n I 1 N 1 -2 3\n I 2 N 3 -4 5\n.SEL GROUP 1 MAILLE NOM "bar"\n I 1 2\n'
            '.HYP BEAM GROUP "bar"\n.AEL\n GROUP "bar" MAT 1 BPR 1 AXIS2 0 1 0\n'
        )
    walls = ".CLM\n NOEUD 1 5 FIX C 1 2 3 4 5 6\n"
    held = run(BAR + line + walls + temperatures(RISES) + LINEAR_STATICS, tmp_path)
    push = YOUNG * SIZE**2 * growth(RISES) / 2
    for piece in (1, 2):
        assert held[f"{piece}/NORMAL_FORCE_A"][-1] == pytest.approx(-push, rel=1e-9)


def test_buckles(tmp_path: Path) -> None:
    """A clamped strut that is warmed buckles at the strain 4 pi**2 i**2/L**2, but for its shear."""
    nodes = 17
    text = ".NOE\n" + "".join(f" I {n} X {2 * (n - 1) / (nodes - 1)!r} 0 0\n" for n in range(1, nodes + 1))
    text += f"{MATERIAL}.BPR\n I 1 RECTANGLE {SIZE} {SIZE}\n.MCE\n I 1 BEAM N "
    text += " ".join(map(str, range(1, nodes + 1))) + " BPR 1 MAT 1 AXIS2 0 1 0\n"
    text += f".CLM\n NOEUD 1 {nodes} FIX C 1 2 3 4 5 6\n" + temperatures(even(1000, nodes), " NF 1")
    text += '.FCT\n I 1 EXPR "T"\n.SAM TYPE STATIC\n.SUB TF 1 H 0.05\n.BUCKLING MODES 2\n.FIN 1\n'
    found = run(text, tmp_path)
    strain = 4 * pi**2 * SIZE**2 / 12 / 4
    assert found["run/BUCKLING_TIME_1"][-1] * 1000 * ALPHA == pytest.approx(strain, rel=2e-3)


def test_warmed_in_motion(tmp_path: Path) -> None:
    """Heating does the work that the bar's energies hold, to the second order of the step."""
    errors = []
    for step in (2e-5, 1e-5):
        text = BAR + BEAM + '.FCT\n I 1 EXPR "SIN(6000*T)"\n.CLM\n NOEUD 1 FIX C 1 2 3 4 5 6\n'
        text += temperatures(even(100), " NF 1") + f".SAM TYPE DYNAMIC\n.SUB TF 2E-3 H {step!r}\n.FIN 1\n"
        moved = run(text, tmp_path)
        errors.append(np.abs(moved["run/ENERGY_ERROR"]).max() / np.abs(moved["run/EXTERNAL_WORK"]).max())
    assert errors[1] < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.3)


@pytest.mark.parametrize("rise", [even(70), {1: 100, 3: 40, 5: -20}])
def test_made_nodes_are_warm(rise: dict[int, float], tmp_path: Path) -> None:
    """Nodes that a shaft or a release makes have the temperatures of those of the deck around them."""
    shaft = ".MCE\n I 1 SHAFT N 1 3 5 D 0.02 MAT 1 PIECES 3\n"
    clamp = ".CLM\n NOEUD 1 FIX C 1 2 3 4 5 6\n" + temperatures(rise)
    grown = run(BAR + shaft + clamp + LINEAR_STATICS, tmp_path)
    length = ALPHA * (rise[1] + 2 * rise[3] + rise[5]) / 2
    assert grown["node/5/UX"][-1] == pytest.approx(length, rel=1e-9)
    if 2 not in rise:
        return
    pinned = BEAM.replace("AXIS2", "RELEASE_A 6 RELEASE_B 6 AXIS2")
    walls = ".CLM\n NOEUD 1 5 FIX C 1 2 3 4 5 6\n" + temperatures(rise)
    held = run(BAR + pinned + walls + LINEAR_STATICS, tmp_path)
    assert held["1/NORMAL_FORCE_A"][-1] == pytest.approx(-YOUNG * SIZE**2 * ALPHA * 70, rel=1e-9)


SHEET = f""".NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
 I 3 X 1 2 0
 I 4 X 0 2 0
{MATERIAL}.MCE
 I 1 MEMBRANE N 1 2 3 4 MAT 1 THICK 1E-3 TENSION 4E8
.CLM
 NOEUD 1 2 3 4 FIX C 1 2 3
"""


def test_membrane_slackens(tmp_path: Path) -> None:
    """A sheet in a frame loses E alpha T/(1 - nu) of its tension, and thickening lowers the stress."""
    held = run(SHEET + temperatures(even(100, 4)) + LINEAR_STATICS, tmp_path)
    with Results(held.file) as results:
        last = results.frame_times.size - 1
        stress = [results.cell_field(f"MEMBRANE_STRESS:{c}", last) for c in (1, 2)]
    thickening = sqrt(1 + 2 * ALPHA * 100 * 1.3 / 0.7)  # by expansion and by the lost tension
    assert np.ravel(stress) == pytest.approx((4e8 - YOUNG * ALPHA * 100 / 0.7) / thickening, rel=1e-9)


def test_what_cannot_expand(tmp_path: Path) -> None:
    """An inextensible beam is refused; a section without material is warned of."""
    clamp = ".CLM\n NOEUD 1 FIX C 1 2 3 4 5 6\n" + temperatures(even(50))
    stiff = BEAM.replace("MAT 1", "MAT 1 INEXTENSIBLE")
    refused = engrane(BAR + stiff + clamp + LINEAR_STATICS, tmp_path)
    assert refused.returncode == 1
    assert "does not stretch, and TEMP would expand it" in refused.stderr
    own = BAR.replace(f"RECTANGLE {SIZE} {SIZE}", "EA 1E6 GA 1E6 1E6 GJ 1E3 EI 1E3 1E3")
    assert "does not expand" in said(own + BEAM.replace("MAT 1 ", "") + clamp + LINEAR_STATICS, tmp_path)
