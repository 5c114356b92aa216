# SPDX-License-Identifier: BSD-3-Clause
"""A run that another solver would make clearly faster says so at its end, and others do not."""

import pytest

PENDULUM = """.NOE
 I 1 X 1 0 0
.MCE
 I 1 INERTIA N 1 M 1 J 0.1 0.1 0.1
 I 2 HINGE N 0 1 AXIS 0 1 0 AT 0 0 0
.CLM
 STRU ACC VAL 0 0 -9.81
.SAM TYPE DYNAMIC RHO 0.9 SOLVER {solver}
.SUB TF {steps} H 0.001
.SAI FIELDS DT {steps} HISTORY DT {steps}
.FIN 1
"""


# long enough to take more than two seconds where MUMPS' own overhead is a third of that of today's machines
@pytest.mark.parametrize(
    ("solver", "end", "said"),
    [("MUMPS", 40, True), ("MUMPS", 0.2, False), ("AUTO", 40, False), ("KLU", 40, False)],
)
def test_the_faster_package_is_named(engrane, solver, end, said):
    (engrane.folder / "x.dat").write_text(PENDULUM.format(solver=solver, steps=end), encoding="utf-8")
    done = engrane("x.dat")
    assert done.returncode == 0, done.stderr
    assert ("engrane: MUMPS takes" in done.stderr and ".SAM SOLVER KLU is expected" in done.stderr) == said
    assert (".SAM SOLVER" in done.stderr) == said
