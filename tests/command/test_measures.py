# SPDX-License-Identifier: BSD-3-Clause
"""Checks of what lies between the ends of steps, and when histories and fields are due there."""

import json
import math

import h5py
import numpy as np
import pytest

OSCILLATOR = """.UNIT SI
.NOE
 I 1
.MCE
 I 1 INERTIA N 1 M 1 J 1
 I 2 BUSHING N 0 1 K 39.47841760435743 39.47841760435743 39.47841760435743 0 0 0
.CLM
 FIX NOEUD 1 C 2 3 4 5 6
.INI
 VIT NOEUD 1 C 1 V 6.283185307179586
.SAM TYPE DYNAMIC {sam}
.SUB TI 0.5 TF 3.21 {sub}
{more}
.FIN 1
"""
MEASURES = """.CHK
 NODE 1 UX MAX V 1 ATOL 1E-3
 NODE 1 UX MIN V -1 ATOL 1E-3
 NODE 1 UX AMPLITUDE V 1 ATOL 1E-3
 NODE 1 UX MEAN WINDOW 0.6123 1.6123 V 0 ATOL 1E-3
 NODE 1 UX RMS WINDOW 0.6123 1.6123 V 0.7071067811865475 ATOL 1E-3
 RUN KINETIC_ENERGY MEAN WINDOW 0.5 1.5 V 9.869604401089358 ATOL 1E-3
"""


def checks(engrane, deck: str) -> list[dict]:
    (engrane.folder / "x.dat").write_text(deck, encoding="utf-8")
    done = engrane("x.dat", "--json")
    found = json.loads(done.stdout)["runs"][0]["checks"]
    assert found, done.stderr
    return found


@pytest.mark.parametrize(
    ("sam", "sub", "off"),
    [  # 4e-3, 5.5e-4 and 8e-3 before, where the channel was straight between the ends of steps
        ("ACCURACY NORMAL", "H 0.3", 1e-4),
        ("ACCURACY FINE", "H 0.3", 1e-6),
        ("SCHEME RADAU", "H 0.05", 1e-3),
    ],
)
def test_extremes_and_means_are_as_accurate_as_the_motion(engrane, sam, sub, off):
    for check in checks(engrane, OSCILLATOR.format(sam=sam, sub=sub, more=MEASURES)):
        assert check["value"] == pytest.approx(check["expected"], rel=off, abs=off), check


def test_a_value_beside_an_event_is_not_interpolated_across_it(engrane):
    """A ball falls on a stiff stop and leaves it: the force just behind was 60 of a peak of 280, taken from a
    cubic through forces of the contact."""
    deck = """.NOE
 I 1
.MCE
 I 1 INERTIA N 1 M 1 J 1
 I 2 STOP N 0 1 NORMAL 0 0 1 AT 0 0 0 MIN -0.1 K 4E4
.CLM
 FIX NOEUD 1 C 1 2 4 5 6
 STRU ACC VAL 0 0 -10
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF 0.3 H 0.002
.CHK
{}
.FIN 1
"""
    times = np.linspace(0.1400, 0.1600, 81)
    lines = "\n".join(f" ELEMENT 2 FORCE T {t:.6f} V 0 ATOL 1" for t in times)
    found = np.array([check["value"] for check in checks(engrane, deck.format(lines))])
    # free fall, then half a swing about the place where the stop carries the weight
    fall, pace = math.sqrt(2 * 0.1 / 10), math.sqrt(4e4)
    speed, rest = 10 * fall, 10 / 4e4
    contact = (math.pi + 2 * math.atan(rest * pace / speed)) / pace
    s = times - fall
    depth = rest + speed / pace * np.sin(pace * s) - rest * np.cos(pace * s)
    force = np.where((s > 0) & (s < contact), 4e4 * depth, 0)
    assert fall < times[0] + 0.002
    assert found == pytest.approx(force, abs=0.02 * force.max())
    assert np.max(np.abs(found[s > contact])) < 1e-6 * force.max()


@pytest.mark.parametrize(
    ("archive", "samples", "frames"),
    [
        ("FIELDS DT 0.15", 0.1, 0.15),
        ("FIELDS DT 0.037", 0.1, 0.037),
        ("FIELDS DT 0.2 HISTORY DT 0.05", 0.05, 0.2),
        ("FIELDS DT 0.004 HISTORY DT 0", None, 0.004),
    ],
)
def test_histories_and_fields_are_due_at_their_own_intervals(engrane, archive, samples, frames):
    """With TOL both fell on the shorter of the two: fields 0.1 or 0.2 apart for 0.15, histories 0.111 or
    0.074 apart for 0.1, and fields at the ends of steps only."""
    deck = OSCILLATOR.format(sam="SCHEME RADAU", sub="H 0.1 TOL 1E-5", more=f".SAI {archive}")
    (engrane.folder / "x.dat").write_text(deck, encoding="utf-8")
    assert engrane("x.dat", "-q").returncode == 0
    with h5py.File(engrane.folder / "x.h5") as file:
        for times, interval in ((file["history/time"][()], samples), (file["fields/time"][()], frames)):
            assert times[-1] == 3.21
            if interval:
                even = 0.5 + interval * np.arange(len(times) - 1)
                assert times[:-1] == pytest.approx(even, abs=1e-12)
                assert times[-1] - even[-1] <= interval * (1 + 1e-9)
