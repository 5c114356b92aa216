# SPDX-License-Identifier: BSD-3-Clause
"""Steps of a fixed length pass over pulses of functions that are shorter; a warning says so."""

import pytest

DECK = """.NOE
 I 1 X 1 0 0
.MCE
 I 1 INERTIA N 1 M 1 J 0.1 0.1 0.1
.CLM
 CHA NOEUD 1 C 1 V 1 NF 1
.FCT
 I 1 TABLE {table}
.SAM TYPE DYNAMIC {sam}
.SUB TF 1 H 0.01 {sub}
.FIN 1
"""
PULSE = "0 0 0.302 0 0.303 5 0.304 5 0.305 0"


@pytest.mark.parametrize(
    ("table", "sam", "sub", "said"),
    [
        (PULSE, "", "", True),
        (PULSE.replace("5", "-5").replace("30-5", "305"), "", "", True),
        (PULSE, "", "TOL 1E-4", False),
        (PULSE, "ACCURACY FAST", "", False),
        ("0 0 0.302 0 0.3021 5", "", "", False),  # a jump, which the next steps see
        ("0 0 0.302 0 0.402 5 0.502 0", "", "", False),
    ],
)
def test_short_pulses(engrane, table, sam, sub, said):
    (engrane.folder / "x.dat").write_text(DECK.format(table=table, sam=sam, sub=sub), encoding="utf-8")
    done = engrane("check", "x.dat")
    assert done.returncode == 0, done.stderr
    assert ("the step from 0.3 to 0.31 passes over that" in done.stdout + done.stderr) == said
