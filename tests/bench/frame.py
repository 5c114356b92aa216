# SPDX-License-Identifier: BSD-3-Clause
"""A frame of slender beams in space by engrane and by CalculiX (Debian: calculix-ccx): displacements of its
joints against the stiffness method, processor time, memory, and what engrane spends its time on.

    ENGRANE=build/bin/engrane python tests/bench/frame.py [--bays 6 6 --storeys 23 --pieces 3]
        [--kinds B32R B31] [--no-calculix] [--deck FILE]

Columns and girders of 4 m and 0.1 x 0.1 m of steel, clamped at the foot, under their weight, and pushed
sideways at each joint. Every member has `pieces` pieces of three nodes. Statics are linear in CalculiX; in
engrane displacements are of any size, and loads are small enough to make no difference.

The stiffness method has the exact stiffness of a member of Timoshenko's beam: its joints are exact for small
displacements. CalculiX makes a solid of each beam and ties them to a rigid knot at each joint. B32 is a
hexahedron of 20 nodes, B32R the same with reduced integration, B31 one of 8 nodes with internal modes; there
are twice as many of B31.
"""

import argparse
import itertools
import os
import tempfile
from pathlib import Path

import h5py
import numpy as np
from calculix import measured
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

SPAN, WIDTH = 4.0, 0.1
YOUNG, POISSON, DENSITY, GRAVITY, PUSH = 2.1e11, 0.3, 7850.0, 9.81, 20.0
SCALE = 1e-3  # of all loads
AREA, BENDING, TORSION = WIDTH**2, WIDTH**4 / 12, 0.1405770 * WIDTH**4  # torsion: Timoshenko and Goodier
SHEAR = 10 * (1 + POISSON) / (12 + 11 * POISSON)  # Cowper 1966


class Frame:
    """Points, and members as rows of nodes counted from 0, with the axis that each runs along."""

    def __init__(self, bays: tuple[int, int], storeys: int, pieces: int):
        size = (bays[0] + 1, bays[1] + 1, storeys + 1)
        grid = {at: i for i, at in enumerate(itertools.product(*map(range, size)))}
        self.points = [SPAN * np.array(at) for at in grid]
        self.joints = len(grid)
        self.members: list[tuple[int, list[int]]] = []
        for at, axis in itertools.product(grid, range(3)):
            to = tuple(x + (k == axis) for k, x in enumerate(at))
            if to not in grid or (axis < 2 and at[2] == 0):
                continue
            ends = [self.points[grid[at]], self.points[grid[to]]]
            inner = range(len(self.points), len(self.points) + 2 * pieces - 1)
            for k in range(1, 2 * pieces):
                self.points.append(ends[0] + (ends[1] - ends[0]) * k / (2 * pieces))
            self.members.append((axis, [grid[at], *inner, grid[to]]))
        self.feet = [i for at, i in grid.items() if at[2] == 0]
        self.pushed = [i for at, i in grid.items() if at[2] > 0]

    def exact(self) -> np.ndarray:
        """Displacements of the joints by the stiffness method."""
        rigidity, bent, length = YOUNG / (2 * (1 + POISSON)), YOUNG * BENDING, SPAN
        tip = length / (SHEAR * rigidity * AREA) + length**3 / (3 * bent)
        twist = length / (rigidity * TORSION)
        flexibility = np.diag([length / (YOUNG * AREA), tip, tip, twist, length / bent, length / bent])
        flexibility[1, 5] = flexibility[5, 1] = length**2 / (2 * bent)
        flexibility[2, 4] = flexibility[4, 2] = -(length**2) / (2 * bent)
        carry = np.eye(6)  # forces on the end to forces on the foot
        carry[4, 2], carry[5, 1] = -length, length
        end = np.linalg.inv(flexibility)
        local = np.block([[carry @ end @ carry.T, -carry @ end], [-end @ carry.T, end]])
        weight = np.array([0, 0, -SCALE * GRAVITY * DENSITY * AREA * length])
        load = np.zeros(6 * self.joints)
        for i in self.pushed:
            load[6 * i] += SCALE * PUSH
        places, entries = [], []
        for axis, nodes in self.members:
            turn = np.kron(np.eye(4), np.roll(np.eye(3), axis, axis=1))
            slots = np.concatenate([6 * i + np.arange(6) for i in (nodes[0], nodes[-1])])
            moment = np.cross(length * np.eye(3)[axis], weight) / 12
            load[slots] += np.concatenate([weight / 2, moment, weight / 2, -moment])
            places.append(np.array(np.meshgrid(slots, slots, indexing="ij")).reshape(2, -1))
            entries.append((turn.T @ local @ turn).ravel())
        matrix = coo_array((np.concatenate(entries), np.hstack(places)), shape=(len(load),) * 2).tocsr()
        free = np.setdiff1d(np.arange(len(load)), [6 * i + c for i in self.feet for c in range(6)])
        found = np.zeros(len(load))
        found[free] = spsolve(matrix[free][:, free], load[free])
        return found.reshape(-1, 6)[:, :3]

    def deck(self) -> str:
        lines = [".NOE"]
        lines += [f" I {i} X {x:.16g} {y:.16g} {z:.16g}" for i, (x, y, z) in enumerate(self.points, 1)]
        lines += [f".BPR\n I 1 RECTANGLE {WIDTH} {WIDTH}\n.MAT"]
        lines += [f" I 1 YT {YOUNG!r} NT {POISSON} M {DENSITY}\n.MCE"]
        pieces = len(self.members[0][1]) // 2
        for m, (axis, nodes) in enumerate(self.members):
            names = "\n  ".join(rows(nodes))
            across = "1 0 0" if axis == 2 else "0 0 1"
            lines.append(f" I {m * pieces + 1} BEAM N {names} BPR 1 MAT 1 AXIS2 {across}")
        lines += [".CLM"]
        lines += [f" FIX NOEUD {row} C 1 2 3 4 5 6" for row in rows(self.feet)]
        lines += [f" CHA NOEUD {row} C 1 V {SCALE * PUSH!r} NF 1" for row in rows(self.pushed)]
        lines += [f" STRU ACC VAL 0 0 {-SCALE * GRAVITY!r} NF 1", ".FCT", " I 1 RAMP 0 0 1 1"]
        lines += [".SAM TYPE STATIC", ".SUB TF 1 H 1"]
        return "\n".join([*lines, ".FIN 1"]) + "\n"

    def calculix(self, kind: str) -> str:
        quadratic = kind.startswith("B32")
        lines = ["*NODE,NSET=ALL"]
        lines += [f"{i},{x:.13g},{y:.13g},{z:.13g}" for i, (x, y, z) in enumerate(self.points, 1)]
        number = itertools.count(1)
        for axis in range(3):
            lines.append(f"*ELEMENT,TYPE={kind},ELSET=E{axis}")
            step = 2 if quadratic else 1
            for _, nodes in (member for member in self.members if member[0] == axis):
                for k in range(0, len(nodes) - 1, step):
                    lines.append(f"{next(number)}," + ",".join(str(i + 1) for i in nodes[k : k + step + 1]))
        lines += ["*MATERIAL,NAME=M", "*ELASTIC", f"{YOUNG},{POISSON}", "*DENSITY", f"{DENSITY}"]
        for axis, across in enumerate(("0,0,1", "0,0,1", "1,0,0")):
            lines += [f"*BEAM SECTION,ELSET=E{axis},MATERIAL=M,SECTION=RECT", f"{WIDTH},{WIDTH}", across]
        lines += ["*NSET,NSET=FEET", *(f"{i + 1}," for i in self.feet)]
        lines += ["*NSET,NSET=PUSHED", *(f"{i + 1}," for i in self.pushed)]
        lines += ["*BOUNDARY", "FEET,1,6", "*STEP", "*STATIC", "*CLOAD", f"PUSHED,1,{SCALE * PUSH}"]
        lines += ["*DLOAD", *(f"E{axis},GRAV,{SCALE * GRAVITY},0,0,-1" for axis in range(3))]
        return "\n".join([*lines, "*NODE FILE,OUTPUT=2D", "U", "*END STEP"]) + "\n"


def rows(nodes: list[int]) -> list[str]:
    return [" ".join(str(i + 1) for i in nodes[k : k + 20]) for k in range(0, len(nodes), 20)]


def displacements(frd: Path, count: int) -> np.ndarray:
    """Of the nodes 1 to count, from a CalculiX result file."""
    found = np.zeros((count, 3))
    inside = False
    with frd.open() as lines:
        for line in lines:
            if line.startswith(" -4"):
                inside = line.split()[1] == "DISP"
            elif line.startswith(" -1") and inside and int(line[3:13]) <= count:
                found[int(line[3:13]) - 1] = [float(line[13 + 12 * c : 25 + 12 * c]) for c in range(3)]
    return found


def apart(found: np.ndarray, exact: np.ndarray) -> str:
    return f"joints off by {np.abs(found - exact).max() / np.abs(exact).max():.1e}"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--bays", type=int, nargs=2, default=(6, 6))
    parser.add_argument("--storeys", type=int, default=23)
    parser.add_argument("--pieces", type=int, default=3, help="of a member, of three nodes each")
    parser.add_argument("--kinds", nargs="+", default=["B32R", "B31"], choices=["B31", "B31R", "B32", "B32R"])
    parser.add_argument("--no-calculix", action="store_true")
    parser.add_argument("--deck", type=Path, help="writes the deck there and ends")
    options = parser.parse_args()
    frame = Frame(tuple(options.bays), options.storeys, options.pieces)
    if options.deck:
        options.deck.write_text(frame.deck())
        return
    engrane = str(Path(os.environ.get("ENGRANE", "build/bin/engrane")).resolve())
    free = 6 * (len(frame.points) - len(frame.feet))
    print(f"{len(frame.members)} members, {len(frame.points)} nodes, {free} unknowns of beams")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "deck.dat").write_text(frame.deck())
        seconds, megabytes = measured([engrane, "-q", "deck.dat", "-o", "deck"], folder)
        print(f"engrane: {seconds:.2f} s, {megabytes:.0f} MB")
        print((folder / "deck.lst").read_text().split("\n\n")[-1])
        with h5py.File(folder / "deck.h5") as file:
            frames = file["fields/displacement"]
            found = frames[sorted(frames)[-1]][: frame.joints]
        exact = frame.exact()
        print(f"largest displacement {np.abs(exact).max():.2e} m, of engrane {apart(found, exact)}")
        for kind in options.kinds if not options.no_calculix else []:
            (folder / "frame.inp").write_text(frame.calculix(kind))
            seconds, megabytes = measured(["ccx", "frame"], folder)
            expected = displacements(folder / "frame.frd", len(frame.points))[: frame.joints]
            print(f"{kind}: {seconds:.2f} s, {megabytes:.0f} MB; {apart(expected, exact)}")


if __name__ == "__main__":
    main()
