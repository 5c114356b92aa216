# SPDX-License-Identifier: BSD-3-Clause
"""JEUA is what it says: wheels that come closer by it, with RUNNING, have just no play left. Loads of either
sign find their flanks across the play."""

from __future__ import annotations

from math import cos, radians, tan
from pathlib import Path

import pytest
from runs import run

CLOSING = 0.4
# the torque pushes one way up to time 1 and the other way from time 3 on
DECK = """
.NOE
 I 1 X 0 0 0
 I 2
.MCE
 I 1 GEAR N 1 2 {pair} MN 2 WIDTH 20 AXIS 0 0 1 PLACE 1 0 0 KM 4E8 JEUA {given} RUNNING
 I 2 HINGE N 0 1 AXIS 0 0 1
 I 3 PRISMATIC N 0 2 AXIS 1 0 0 DRIVE SLIDE NF 2
 I 4 TORQUE N 1 AXIS 0 0 1 V 100 NF 1
.FCT
 I 1 TABLE 0 1 1 1 3 -1 4 -1
 I 2 TABLE 0 {closer} 1 {closer}
.SAM TYPE STATIC
.SUB TF 4 H 0.1
.FIN 1
"""
# B's teeth come closer to A's when it moves along -x; inside the ring the centres then move apart
PAIRS = {"spur": "Z 23 47", "helical": "Z 23 47 HELIX -15 X 0.3 0.2", "ring": "Z 23 71 INTERNAL"}


def play(folder: Path, pair: str, given: float, closer: float) -> float:
    """How far the teeth move along the circumference when the torque changes sides."""
    error = run(DECK.format(pair=pair, given=given, closer=closer), folder)["1/TRANSMISSION_ERROR"]
    return float(abs(error[-1] - error[0]))


@pytest.mark.parametrize("kind", PAIRS)
def test_no_play_when_closer_by_jeua(tmp_path: Path, kind: str) -> None:
    pair = PAIRS[kind]
    full = play(tmp_path, pair, CLOSING, 0)
    assert full == pytest.approx(2 * CLOSING * tan(radians(20)), rel=0.15)
    # were the backlash that of wheels moved apart, 5 per cent of it would be left
    assert play(tmp_path, pair, CLOSING, -0.999 * CLOSING) == pytest.approx(0.001 * full, rel=0.1)
    assert play(tmp_path, pair, CLOSING, -1.001 * CLOSING) < 1e-6 * full


REVERSED = """
ABRE '/a' '{distance!r}'
.NOE
 I 1
 I 2 X /a
.MCE
 I 1 GEAR N 1 2 Z 18 27 MN 2 HELIX {helix} AXIS 0 0 1 WIDTH 20 KM 3E5 JEU 0.05 {option}
 I 2 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 3 BEARING N 0 2 AXIS 0 0 1 K 1E5 3E5 3E5 0 1E9 1E9
 I 4 TORQUE N 2 AXIS 0 0 1 V {torque} NF 2
.FCT
 I 1 TABLE 0 0 1 0.3
 I 2 TABLE 0 1 0.5 1 0.7 -1 1 -1
.SAM TYPE STATIC
.SUB TF 1 H 0.25
.FIN
"""


@pytest.mark.parametrize("option", ["", "RUNNING", "SLICES 2", "SLICES 7", "TIPRELA 0.008 2"])
@pytest.mark.parametrize("helix", [15, 20])
@pytest.mark.parametrize("torque", [2e4, -3e4])
def test_a_load_that_turns_round_finds_the_other_flank(
    tmp_path: Path, torque: float, helix: float, option: str
) -> None:
    """Flanks whose contact is no event, as with slices or relief, too."""
    beta = radians(helix)
    deck = REVERSED.format(distance=45 / cos(beta), helix=helix, option=option, torque=torque)
    result = run(deck, tmp_path)
    normal = torque / (27 / cos(beta)) / (cos(radians(20)) * cos(beta))
    # the bearing gives way, by which the lever arms change
    assert result["1/NORMAL_FORCE"][[0, -1]] == pytest.approx([normal, -normal], rel=2e-3)
