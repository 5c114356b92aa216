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
