# SPDX-License-Identifier: BSD-3-Clause
"""Decks that several tests run."""

PENDULUM = """! A pendulum of length /L and mass /M.
.UNIT SI
ABRE '/L' '0.5' '/M' '2.'
.NOE
 I 1 X /L 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 0 AT 0 0 0
 I 2 INERTIA N 1 M /M J (/M*0.01)
.CLM STRU ACC VAL 0 0 -9.81
.SAM TYPE DYNAMIC
.SUB TF 0.2 H 0.01
.CHK
 RUN ENERGY_ERROR V 0 ATOL 1E-2
"""

# springs of 10 and {stiff} in a row, with masses of 1 behind each, pulled by 2
SPRINGS = """
.NOE
 I 1 X 0
 I 2 X 1
 I 3 X 2
.MCE
 I 1 SPRING N 1 2 K 10
 I 2 SPRING N 2 3 K {stiff!r}
 I 3 INERTIA N 2 M 1
 I 4 INERTIA N 3 M 1
 I 5 FORCE N 3 DIR 1 0 0 V 2
.CLM
 FIX NOEUD 1 C 1 2 3
 FIX NOEUD 2 3 C 2 3
.SAM TYPE {kind}
.SUB TF 1 H {h}
.FIN 1
"""

# two discs on the axes of their hinges, with a link between them: a spring, a belt
DISCS = """.NOE
 I 1 X 0 0 0
 I 2 X 0.5 0 0
.MCE
 I 1 HINGE N 0 1 AXIS {axis}
 I 2 HINGE N 0 2 AXIS {axis}
 I 3 INERTIA N 1 M 1 J 0.02
 I 4 INERTIA N 2 M 1 J 0.08
 I 5 {link}
 I 6 TORQUE N 1 AXIS {axis} V {torque}
{rest}.FIN 1
"""

# a mesh of one square of 1
SQUARE = """.NOE
 I 1 X 0 Y 0
 I 2 X 1 Y 0
 I 3 X 1 Y 1
 I 4 X 0 Y 1
.MAI
 I 1 N 1 2 3 4
"""

# a mesh of two squares of 10 in a row
SQUARES = """.NOE
 I 1 X 0 Y 0
 I 2 X 10 Y 0
 I 3 X 20 Y 0
 I 4 X 0 Y 10
 I 5 X 10 Y 10
 I 6 X 20 Y 10
.MAI
 I 1 AT 1 0 N 1 2 5 4
 I 2 AT 2 0 N 2 3 6 5
"""

# two wheels on hinges, of 30 and 60 teeth; the deck goes on from here
GEAR_PAIR = """.NOE
 I 1
 I 2 X 0.09
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 HINGE N 0 2 AXIS 0 0 1
 I 3 GEAR N 1 2 Z 30 60 MN 0.002 HELIX 0 AXIS 0 0 1
 I 4 INERTIA N 1 J 1D-3
 I 5 INERTIA N 2 J 1D-2
"""
