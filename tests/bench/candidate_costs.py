# SPDX-License-Identifier: BSD-3-Clause
"""What the counts of tests/bench/candidate_schemes.py cost this program, in instructions.

The unit costs are those of docs/decisions/0024-kept-factors.md, for chains of spatial links with hinges:
225 for each slot of a residual, 5.4 times that for a tangent, KLU 9 for each operation and 25 for each
entry of a factorisation and 9 for each entry of a solution, MUMPS 3.1e5 + 408 and 4.6e5 + 43 for each
entry. Operations and entries come from factorisations of the patterns here (SuperLU, minimum degree), for
three systems:

base     motion and multipliers, each element a dense block
ggl      each multiplier twice; what M^-1 G^T of one element adds to its neighbours is left out, which
         favours GGL
double   the complex pair of Radau IIA, as a real system of twice the size
"""

from collections import Counter
from functools import cache

import numpy as np
from scipy.sparse import coo_array, csc_array, kron
from scipy.sparse.linalg import splu

SLOTS = 23  #: of a link and its hinge: 6 and 17
HINGE = 17 / 23  #: the part of an evaluation that constraints alone take


@cache
def factors(links: int, kind: str) -> tuple[float, float]:
    """Operations and entries of the factors."""
    width = 6 + 5 * (2 if kind == "ggl" else 1)
    rows, columns = [], []
    for i in range(links):
        first = max(0, (i - 1) * width)
        block = np.r_[np.arange(first, first + 6) if i else [], np.arange(i * width, (i + 1) * width)]
        r, c = np.meshgrid(block, block)
        rows.append(r.ravel())
        columns.append(c.ravel())
    at = np.concatenate(rows).astype(int), np.concatenate(columns).astype(int)
    pattern = csc_array(coo_array((np.ones(at[0].size), at)))
    if kind == "double":
        pattern = csc_array(kron(pattern, np.ones((2, 2))))
    random = np.random.default_rng(1)
    pattern.data = random.uniform(-1, 1, pattern.nnz)
    size = pattern.shape[0]
    whole = csc_array(pattern + 1e3 * csc_array((np.ones(size), (range(size), range(size)))))
    lu = splu(whole, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0, options={"SymmetricMode": True})
    below = np.diff(csc_array(lu.L).indptr) - 1.0
    beside = np.bincount(csc_array(lu.U).indices, minlength=size) - 1.0
    return float(np.sum(below + 2 * below * beside)), float(lu.L.nnz + lu.U.nnz - size)


def units(links: int, package: str) -> dict[str, float]:
    residual = 225.0 * SLOTS * links
    out = {"residual": residual, "tangent": 5.4 * residual}
    out |= {"closure": HINGE * residual, "jacobian": HINGE * 5.4 * residual}
    for kind in ("base", "ggl", "double"):
        operations, entries = factors(links, kind)
        out["factor " + kind] = 9 * operations + 25 * entries if package == "KLU" else 3.1e5 + 408 * entries
        out["solve " + kind] = 9 * entries if package == "KLU" else 4.6e5 + 43 * entries
    return out


def cost(work: Counter, links: int, package: str) -> float:
    table = units(links, package)
    return sum(count * table[what] for what, count in work.items())
