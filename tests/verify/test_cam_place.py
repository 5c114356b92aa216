# SPDX-License-Identifier: BSD-3-Clause
"""Where a follower of MOTION belongs: AT and BASE of the warning put it on its profile at cam angle 0."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from runs import engrane, run

CARDS = {  # the follower and how it moves
    "roller": "FOLLOWER ROLLER 0.01 DIRECTION 0 1 0",
    "offset": "FOLLOWER KNIFE DIRECTION 1 2 0",
    "face": "FOLLOWER FLAT DIRECTION 1 2 0 NORMAL 0 1 0",
    "arm": "FOLLOWER ROLLER 0.01 PIVOT 0.06 0.05 0",
    "arm on the other side": "FOLLOWER ROLLER 0.01 PIVOT -0.06 0.05 0",
}
HINGE_OR_SLIDE = {"PIVOT": "HINGE N 0 2 AT {} 0 AXIS 0 0 1", "DIRECTION": "PRISMATIC N 0 2 AXIS {} 0"}


def model(kind: str, at: str, base: str) -> str:
    card = CARDS[kind]
    word, place = re.search(r"(PIVOT|DIRECTION) (\S+ \S+) 0", card).groups()
    lift = "8" if word == "PIVOT" else "0.01"
    return f""".NOE
 I 1 X 0 0 0
 I 2 X 0.004 0.043 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE ANGLE NF 1
 I 2 {HINGE_OR_SLIDE[word].format(place)}
 I 3 CAM N 1 2 AXIS 0 0 1 BASE {base} MOTION 90 {lift} 60 {lift} 90 0 120 0 PHASE -36 LAW POLY345 $
  AT {at} {card}
 I 9 INERTIA N 2 M 1 J 1E-3
.FCT
 I 1 TABLE 0 0 1 6.283185307179586
.SAM TYPE KINEMATIC
.SUB TF 0.1 H 0.01
.FIN 1
"""


def messages(text: str, folder: Path) -> str:
    done = engrane(text, folder, "check")
    assert done.returncode == 0, done.stderr
    return done.stderr


@pytest.mark.parametrize("kind", CARDS)
@pytest.mark.parametrize("cure", ["AT", "BASE"])
def test_the_place_that_agrees(tmp_path, kind, cure):
    """At the place of the message the follower need not move to the profile, and the lift is that of the law:
    s = h (10 t^3 - 15 t^4 + 6 t^5), t = 36/90."""
    at, base = "0.004 0.043 0", "0.025"
    said = messages(model(kind, at, base), tmp_path)
    assert "on the profile at cam angle 0" in said
    if cure == "AT":
        at = re.search(r"AT (\S+ \S+ \S+) agrees with BASE", said).group(1)
    else:
        base = re.search(r"so does BASE (\S+)", said).group(1)
    right = model(kind, at, base)
    assert "warning" not in messages(right, tmp_path)
    result = run(right, tmp_path)
    t = 0.4
    height = np.radians(8) if "arm" in kind else 0.01
    # six digits of the message
    assert abs(result["element/3/LIFT"][0] - height * (10 * t**3 - 15 * t**4 + 6 * t**5)) <= 3e-5 * height
    assert np.hypot(result["node/2/UX"][0], result["node/2/UY"][0]) <= 1e-7
