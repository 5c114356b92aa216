# SPDX-License-Identifier: BSD-3-Clause
"""What elimination would save, or cost, in place of the multipliers of RIGID_LINK and MEAN_LINK.

    apt-get install python3-petsc4py-real python3-scipy
    PYTHONPATH=tests /usr/bin/python3 tests/bench/link_elimination.py [--around 5 50 500] [--rounds 5]

A ring of plane cells of 8 nodes, held inside; all nodes of its rim are the group of a link, whose node has a
spring to the ground and a couple, as a wheel on an elastic shaft (--free: the couple only). Linear statics:
the stiffness matrix is assembled here, the constraints are those of docs/elements/structural, and both forms
of the system are factored by MUMPS with LDL^T, as by engrane. With multipliers: K and the constraints B.
Eliminated: T'KT, where T gives the unknowns of the nodes that follow (rigid), or of the one that follows
(mean). The turn of the node is the same.

Multipliers are factored twice: as MUMPS orders them by itself ("by itself"), and as engrane has it order
matrices with dense rows (src/solve/algebra/mumps_analysis.cpp). The matrix has the stored zeros of engrane's:
each node of the group, its multipliers and the node of the link form a full block.
"""

import argparse
import statistics
import time

import numpy as np
import scipy.sparse as sp
from petsc4py import PETSc
from plane_meshes import Sheet

INNER, OUTER, YOUNG, POISSON = 9.0, 10.0, 2e5, 0.3
SPRING, COUPLE = np.array([1e5, 1e5, 1e7]), 100.0


def ring(around: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Points and cells of two rows, nodes inside and on the rim; the nodes of the seam are one."""

    def place(u):
        radius, angle = INNER + (OUTER - INNER) * u[0], 2 * np.pi * u[1]
        return np.round(radius * np.array([np.cos(angle), np.sin(angle)]), 12)

    mesh = Sheet((2, around), 8, place, curved=True)
    points, same = np.unique(mesh.points, axis=0, return_inverse=True)
    same = same.ravel()
    sides = [np.unique(same[mesh.nodes(lambda u, at=at: u[0] == at)]) for at in (0.0, 1.0)]
    return points, same[np.array(mesh.cells)], *sides


def shape(s: float, t: float) -> np.ndarray:
    """Slopes of the 8 shape functions, a row for each direction: corners, then middles of sides."""
    rows = []
    for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        rows.append([a * (1 + b * t) * (2 * a * s + b * t) / 4, b * (1 + a * s) * (2 * b * t + a * s) / 4])
    for a, b in ((0, -1), (1, 0), (0, 1), (-1, 0)):
        rows.append(
            [-s * (1 + b * t), b * (1 - s * s) / 2] if a == 0 else [a * (1 - t * t) / 2, -t * (1 + a * s)]
        )
    return np.array(rows).T


def stiffness(points: np.ndarray, cells: np.ndarray) -> sp.csr_matrix:
    """Plane stress, 2 x 2 points, thickness 1."""
    moduli = (
        YOUNG / (1 - POISSON**2) * np.array([[1, POISSON, 0], [POISSON, 1, 0], [0, 0, (1 - POISSON) / 2]])
    )
    local = np.zeros((len(cells), 16, 16))
    for s, t in np.array(np.meshgrid([-1, 1], [-1, 1])).T.reshape(-1, 2) / np.sqrt(3):
        slopes = shape(s, t)
        jacobian = np.einsum("kn,enc->ekc", slopes, points[cells])
        gradient = np.einsum("eck,kn->ecn", np.linalg.inv(jacobian), slopes)
        b = np.zeros((len(cells), 3, 16))
        b[:, 0, 0::2], b[:, 1, 1::2] = gradient[:, 0], gradient[:, 1]
        b[:, 2, 0::2], b[:, 2, 1::2] = gradient[:, 1], gradient[:, 0]
        weights = np.abs(np.linalg.det(jacobian))
        local += np.einsum("eia,ij,ejb,e->eab", b, moduli, b, weights)
    slots = (2 * cells[:, :, None] + np.arange(2)).reshape(len(cells), 16)
    rows, columns = np.repeat(slots, 16, axis=1).ravel(), np.tile(slots, (1, 16)).ravel()
    size = 2 * len(points)
    return sp.coo_matrix((local.ravel(), (rows, columns)), (size, size)).tocsr()


def constraints(link: str, points: np.ndarray, rim: np.ndarray, size: int) -> sp.csr_matrix:
    """Of the unknowns of the mesh and three of the node at the origin: u_i - u_0 - theta x d_i, one by one
    for a rigid link, their means with 1 and J^-1 d_i x for a mean one."""
    x, y = points[rim].T
    n = len(rim)
    index = np.arange(n)
    one = np.ones(n)
    gaps = sp.coo_matrix(
        (
            np.concatenate([one, one, -one, -one, y, -x]),
            (
                np.concatenate(
                    [2 * index, 2 * index + 1, 2 * index, 2 * index + 1, 2 * index, 2 * index + 1]
                ),
                np.concatenate(
                    [
                        2 * rim,
                        2 * rim + 1,
                        0 * rim + size,
                        0 * rim + size + 1,
                        0 * rim + size + 2,
                        0 * rim + size + 2,
                    ]
                ),
            ),
        ),
        (2 * n, size + 3),
    ).tocsr()
    if link == "rigid":
        return gaps
    inertia = np.mean(x * x + y * y)
    means = np.zeros((3, 2 * n))
    means[0, 0::2], means[1, 1::2] = 1 / n, 1 / n
    means[2, 0::2], means[2, 1::2] = -y / n / inertia, x / n / inertia
    return sp.csr_matrix(sp.csr_matrix(means) @ gaps)


def with_zeros(matrix: sp.csr_matrix, blocks: np.ndarray) -> sp.csr_matrix:
    """The matrix with the zeros of full blocks stored; a row of `blocks` has the unknowns of one."""
    width = blocks.shape[1]
    rows, columns = np.repeat(blocks, width, axis=1).ravel(), np.tile(blocks, (1, width)).ravel()
    entries = matrix.tocoo()
    return sp.coo_matrix(
        (
            np.concatenate([entries.data, np.zeros(len(rows))]),
            (np.concatenate([entries.row, rows]), np.concatenate([entries.col, columns])),
        ),
        matrix.shape,
    ).tocsr()


def setup(a: PETSc.Mat, room: int, options: dict[int, int]) -> PETSc.PC:
    """Factors of a matrix, with these of MUMPS' ICNTL, which PETSc takes from its options only."""
    for index, value in options.items():
        PETSc.Options()[f"mat_mumps_icntl_{index}"] = value
    pc = PETSc.PC().create()
    pc.setOperators(a)
    pc.setType("cholesky")
    pc.setFactorSolverType("mumps")
    pc.setFactorSetUpSolverType()
    factor = pc.getFactorMatrix()
    factor.setMumpsIcntl(14, room)  # for pivots that are put off
    pc.setUp()
    for index in options:
        PETSc.Options().delValue(f"mat_mumps_icntl_{index}")
    return pc


def factor_again(a: PETSc.Mat, pc: PETSc.PC) -> float:
    """Seconds of a factorisation with the analysis made before."""
    a.setValue(0, 0, a.getValue(0, 0))
    a.assemble()
    start = time.process_time()
    pc.setUp()
    return time.process_time() - start


def as_engrane(matrix: sp.csr_matrix, a: PETSc.Mat) -> tuple[PETSc.PC, float]:
    """Factors in the order of analyse_for_mumps, and seconds spent on what engrane does not do: factors of an
    order of which it makes the analysis only."""
    lengths = np.diff(matrix.indptr).astype(float)
    dense = lengths[lengths > max(16, 10 * np.sqrt(len(lengths)))]
    work = np.sum(dense**2)
    if work < 1e6:
        return setup(a, 50, {}), 0.0
    room = int(50 * (1 + 3 * dense.max() / len(lengths)))
    pc = setup(a, room, {12: 1, 7: 6})
    if pc.getFactorMatrix().getMumpsRinfog(1) <= work / 30:
        return pc, 0.0
    start = time.process_time()
    once = factor_again(a, pc)
    unneeded = time.process_time() - start + once
    return setup(a, room, {12: 1}), unneeded


def factored(
    matrix: sp.csr_matrix, right: np.ndarray, by_itself: bool
) -> tuple[tuple[float, float], dict[str, float], np.ndarray]:
    """Seconds of processor time of analysis and factorisation, and of a factorisation with the same pattern,
    what MUMPS tells of them, and the solution."""
    rows = matrix.tocsr()
    rows.sort_indices()
    a = PETSc.Mat().createAIJ(
        rows.shape, csr=(rows.indptr.astype("i4"), rows.indices.astype("i4"), rows.data)
    )
    a.setOption(PETSc.Mat.Option.SYMMETRIC, True)
    start = time.process_time()
    pc, unneeded = (setup(a, 100, {}), 0.0) if by_itself else as_engrane(rows, a)
    seconds = time.process_time() - start - unneeded
    again = factor_again(a, pc)
    factor = pc.getFactorMatrix()
    if factor.getMumpsInfog(1) != 0:
        raise SystemExit(f"MUMPS: {factor.getMumpsInfog(1)}")
    b, x = a.createVecs()
    b.setArray(right)
    pc.apply(b, x)
    numbers = factor.getMumpsInfog(29)
    told = {"numbers": numbers if numbers > 0 else -1e6 * numbers, "delayed": factor.getMumpsInfog(13)}
    return (seconds, again), told, x.getArray().copy()


def systems(link: str, around: int, spring: np.ndarray):
    """Each form of the system: its name, whether MUMPS orders it by itself, matrix, right side, and the row
    that gives the turn of the node."""
    points, cells, hub, rim = ring(around)
    size = 2 * len(points)
    k = sp.block_diag([stiffness(points, cells), sp.diags(spring)]).tocsr()
    k.eliminate_zeros()
    load = np.zeros(size + 3)
    load[-1] = COUPLE
    held = np.zeros(size + 3, bool)
    held[2 * hub], held[2 * hub + 1] = True, True
    free = np.flatnonzero(~held)
    b = constraints(link, points, rim, size)[:, free].tocsc()
    k, load = k[free][:, free].tocsc(), load[free]
    scale = np.abs(k.diagonal()).max()  # as engrane has it, of the size of the stiffness
    turn = np.zeros(len(free))
    turn[-1] = 1
    slots = np.searchsorted(free, np.stack([2 * rim, 2 * rim + 1], axis=1).ravel())
    of_link = np.arange(3) + len(free)
    own = np.stack([2 * np.arange(len(rim)), 2 * np.arange(len(rim)) + 1], axis=1) + len(free)
    multipliers = own if link == "rigid" else np.tile(of_link, (len(rim), 1))
    leader = np.tile(of_link - 3, (len(rim), 1))
    whole = with_zeros(
        sp.bmat([[k, scale * b.T], [scale * b, None]]).tocsr(),
        np.hstack([leader, slots.reshape(-1, 2), multipliers]),
    )
    for name, by_itself in (("by itself", True), ("multipliers", False)):
        yield (
            name,
            by_itself,
            whole,
            np.concatenate([load, np.zeros(b.shape[0])]),
            np.concatenate([turn, np.zeros(b.shape[0])]),
        )
    follow = slots if link == "rigid" else np.arange(len(free) - 3, len(free))
    lead = np.setdiff1d(np.arange(len(free)), follow)
    # B_f u_f + B_l u_l = 0; B_f is 1 for a rigid link, of order 3 for a mean one
    rest = (
        -b[:, lead] if link == "rigid" else -sp.csr_matrix(np.linalg.inv(b[:, follow].toarray())) @ b[:, lead]
    )
    t = sp.coo_matrix((np.ones(len(lead)), (lead, np.arange(len(lead)))), (len(free), len(lead)))
    rest = rest.tocoo()
    t = (t + sp.coo_matrix((rest.data, (follow[rest.row], rest.col)), t.shape)).tocsr()
    yield "eliminated", True, sp.csr_matrix(t.T @ k @ t), t.T @ load, t.T @ turn


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--around", type=int, nargs="+", default=[5, 50, 500], help="cells round the ring")
    parser.add_argument("--links", nargs="+", default=["rigid", "mean"], choices=["rigid", "mean"])
    parser.add_argument("--free", action="store_true", help="no spring at the node")
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    print(
        "link   nodes  form         unknowns    numbers of K   of factors  delayed  seconds    again  "
        "turn of the node"
    )
    for link in options.links:
        for around in options.around:
            forms = list(systems(link, around, 0 * SPRING if options.free else SPRING))
            seconds = {name: [] for name, *_ in forms}
            again = {name: [] for name, *_ in forms}
            lines = {}
            for _ in range(options.rounds):
                for name, by_itself, matrix, right, turn in forms:
                    used, told, found = factored(matrix, right, by_itself)
                    seconds[name].append(used[0])
                    again[name].append(used[1])
                    lines[name] = (
                        f"{link:6} {2 * around:5}  {name:11} {matrix.shape[0]:9} {matrix.nnz:15} "
                        f"{told['numbers']:12.0f} {told['delayed']:8} ",
                        f"{turn @ found:.9e}",
                    )
            for name, (line, turn) in lines.items():
                first, second = statistics.median(seconds[name]), statistics.median(again[name])
                print(line, f"{first:8.4f} {second:8.4f}  {turn}")
            ratio = statistics.median(
                e / m for m, e in zip(seconds["multipliers"], seconds["eliminated"], strict=True)
            )
            print(f"       eliminated over multipliers: {ratio:.2f}")


if __name__ == "__main__":
    main()
