# SPDX-License-Identifier: BSD-3-Clause
"""Redundant constraints, and reactions that are not unique, depend on no part that theirs is not joined to.

A beam clamped at both ends that does not stretch has a motion of first order only. It has one constraint too
many while it is straight, and none when it is bent; what else there was decided for which it was taken.
"""

import re

import pytest
from engrane_post import Results
from runs import engrane

CLAMPED = "INEXTENSIBLE UNSHEARABLE"


def model(length: float, cantilever: str) -> str:
    """A beam between clamps, nodes 41 to 45, and apart from it a cantilever; 1 m is `length` units."""
    square = length * length
    nodes = "\n".join(f" I {i} X {(i - 1) / 4 * length!r} 0 0" for i in range(1, 6))
    clamped = "\n".join(f" I {i} X {(i - 41) / 4 * length!r} 0 {2 * length!r}" for i in range(41, 46))
    return f"""
.NOE
{nodes}
{clamped}
.BPR
 I 1 EA 1D7 GA 4D6 4D6 GJ {square!r} EI {square!r} {square!r}
.MCE
 I 1 BEAM N 1 2 3 4 5 BPR 1 AXIS2 0 1 0 {cantilever}
 I 21 BEAM N 41 42 43 44 45 BPR 1 AXIS2 0 1 0 {CLAMPED}
.CLM
 FIX NOEUD 1 41 45 C 1 2 3 4 5 6
 CHA NOEUD 5 C 2 V 1 NF 1
 CHA NOEUD 43 C 2 V 1D-3 NF 1
.FCT
 I 1 RAMP 0 0 1 1
.SAM TYPE STATIC
.SUB TF 1 H 0.5
.FIN 1
"""


def run(deck: str, folder) -> tuple[dict, str]:
    ended = engrane(deck, folder, "-q")
    assert ended.returncode == 0, ended.stderr
    with Results(folder / "deck.h5") as result:
        channels = {
            name: (result.history(name)[1][-1], channel.unique) for name, channel in result.channels.items()
        }
    return channels, (folder / "deck.lst").read_text(encoding="utf-8")


@pytest.mark.parametrize("length", [1.0, 1e3], ids=["m", "mm"])
@pytest.mark.parametrize("cantilever", [CLAMPED, "INEXTENSIBLE", "UNSHEARABLE", ""])
def test_a_clamped_beam_beside_a_cantilever(tmp_path, length, cantilever):
    channels, listing = run(model(length, cantilever), tmp_path)
    found = re.findall(r"(\d+) redundant constraint.* among (BEAM \d+)", listing)
    assert found == [("1", "BEAM 21")], listing
    assert channels["node/43/UY"][0] == pytest.approx(1e-3 / 192 * length, rel=1e-6)
    assert abs(channels["node/41/FX"][0]) < 1e-6


@pytest.mark.parametrize("length", [1.0, 1e3], ids=["m", "mm"])
def test_reactions_of_a_cantilever_beside_it_are_unique(tmp_path, length):
    channels, _ = run(model(length, CLAMPED), tmp_path)
    marked = {name for name, (_, unique) in channels.items() if not unique}
    assert {"node/41/FX", "node/45/FX"} <= marked
    assert {name for name in marked if name.startswith("node/")} == {"node/41/FX", "node/45/FX"}
    assert not [name for name in marked if name.startswith(("element/1/", "element/2/"))], marked


def bars(length: float) -> str:
    """A four-bar with its bars in line; three constraints are redundant as in any flat loop of hinges."""
    return f"""
 I 51 HINGE N 0 11 AXIS 0 0 1
 I 52 HINGE N 11 12 AXIS 0 0 1 AT {length!r} 0 0
 I 53 HINGE N 12 13 AXIS 0 0 1 AT {2 * length!r} 0 0
 I 54 HINGE N 0 13 AXIS 0 0 1 AT {length!r} 0 0
"""


@pytest.mark.parametrize("length", [1.0, 1e3], ids=["m", "mm"])
def test_bars_in_line_beside_a_clamped_beam(tmp_path, length):
    deck = model(length, "").replace(
        ".BPR", f" I 11 X 0 0 0\n I 12 X {length!r} 0 0\n I 13 X {length!r} 0 0\n.BPR"
    )
    ended = engrane(deck.replace(".CLM", bars(length) + ".CLM"), tmp_path, "check")
    assert ended.returncode == 0, ended.stderr
    assert "singular position: 1 more there alone" in ended.stdout
    assert re.findall(r"(\d+) redundant constraint.* among (\w+ \d+)", ended.stdout) == [
        ("1", "BEAM 21"),
        ("3", "HINGE 51"),
    ]


@pytest.mark.parametrize("length", [1.0, 1e3], ids=["m", "mm"])
@pytest.mark.parametrize("arm", [1.0, 1e-2])
def test_a_pendulum_on_a_clamped_beam(tmp_path, length, arm):
    """What moves far on it does not make the beam one that was bent."""
    deck = model(length, "").replace(".BPR", f" I 46 X {(0.5 + arm) * length!r} 0 {2 * length!r}\n.BPR")
    spring = f" I 31 HINGE N 43 46 AXIS 0 0 1 AT {0.5 * length!r} 0 {2 * length!r} K {length!r}\n"
    channels, listing = run(deck.replace(".CLM", spring + ".CLM"), tmp_path)
    assert re.findall(r"(\d+) redundant constraint.* among (BEAM \d+)", listing) == [("1", "BEAM 21")], (
        listing
    )
    assert channels["node/43/UY"][0] == pytest.approx(1e-3 / 192 * length, rel=1e-6)
