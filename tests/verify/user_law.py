# SPDX-License-Identifier: BSD-3-Clause
"""A deck with a user routine for a spring, for tests of routines that fail."""

DECK = """.NOE
 I 1 X 2 0 0
.FCT
 I 1 USER "{library}" "{routine}" PARAM {limit}
.MCE
 I 1 SPRING N 0 1 LAW USER 1
 I 2 INERTIA N 1 M 1
.CLM
 FIX NOEUD 1 C 2 3
.INI
 VIT NOEUD 1 C 1 V 1
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.01
.FIN 1
"""


def deck(library: str, routine: str, limit: float) -> str:
    """A mass at unit speed on a spring whose law is the routine. Its parameter is the elongation up to which
    the routine is good: 0.5 is reached at t = 0.52, and -1 before the run."""
    return DECK.format(library=library, routine=routine, limit=limit)
