# SPDX-License-Identifier: BSD-3-Clause
"""What results say of the arrows of loads: force or moment, its sense, and what it turns with."""

from engrane_post import Results

DECK = """.UNIT SI
.NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 DRIVE NF 1
 I 2 RIGID N 1 2
 I 3 INERTIA N 2 M 1 J 0.1
 I 4 FORCE N 2 DIR 0 1 0 V -3
 I 5 FORCE N 2 DIR 0 1 0 V 3 FOLLOW
 I 6 TORQUE N 2 AXIS 1 0 0 V 3
 I 7 TORQUE N 2 AXIS 1 0 0 V 3 FOLLOW
 I 8 TORQUE N 1 2 AXIS 1 0 0 V 3
 I 9 TORQUE N 1 0 AXIS 1 0 0 V 3
.CLM
 CHA NOEUD 2 C 2 6 V 4 -5
 CHA NOEUD 2 C 1 V 4
 CHA NOEUD 2 C 5 V 4
.FCT
 I 1 EXPR "T"
.SAM TYPE KINEMATIC
.SUB TF 1 H 0.5
.FIN 1
"""


def test_arrows(engrane):
    engrane.succeeds("loads", DECK, "-q")
    with Results(engrane.folder / "loads.h5") as result:
        arrows = [d for e in result.elements for d in e.drawing if d["shape"] == "arrow"]
    seen = [(d.get("couple", False), d["node"], d["axis"], d["holder"]) for d in arrows]
    assert seen == [
        (False, 2, [0, -1, 0], 0),
        (False, 2, [0, 1, 0], 2),
        (True, 2, [1, 0, 0], 0),
        (True, 2, [1, 0, 0], 2),
        (True, 2, [1, 0, 0], 1),  # between two nodes it follows the first
        (True, 1, [-1, 0, 0], 1),  # the ground bears V, node 1 the opposite
        (False, 2, [0, 1, 0], 0),
        (True, 2, [0, 0, -1], 0),
        (False, 2, [1, 0, 0], 0),
        (True, 2, [0, 1, 0], 0),
    ]
