# SPDX-License-Identifier: BSD-3-Clause
"""The same meshes by engrane and by CalculiX (Debian: calculix-ccx): largest difference of displacements,
processor time, memory.

    ENGRANE=build/bin/engrane python tests/bench/calculix.py [--boxes 6 2 2] [--rounds 1] [--write FILE]

With several rounds the programs take turns; medians are printed, also that of the ratio of each round.

Formulations agree for tetrahedra of 4 and 10 nodes (C3D4, C3D10), wedges of 15 (C3D15), hexahedra of 20
(C3D20), plane strain of 3, 6 and 8 nodes (CPE3, CPE6, CPE8R) and round an axis of 6 and 8 (CAX6, CAX8R).
They do not for wedges of 6 (C3D6 has 2 points, engrane 6), hexahedra of 8 (C3D8I has other internal modes),
quadrilaterals of 4 (CPE4, CPS4, CAX4 have no internal modes) and triangles of 3 round an axis (CAX3 has
other points). CalculiX makes solids of plane cells: in plane stress (CPS6, CPS8R) with a strain across that
has no jumps between cells, so that results agree for thin cells as they get smaller; round an axis wedges
of 2 degrees, of whose nodes it prints the mean (ring_means).
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from plane_meshes import THIN, gravity_strip, ring_means
from solid_meshes import gravity_beam

SOLIDS = {
    "C3D4": (4, False),
    "C3D10": (4, True),
    "C3D6": (6, False),
    "C3D15": (6, True),
    "C3D8I": (8, False),
    "C3D20": (8, True),
}
PLANE = {
    "CPE3": (3, "strain"),
    "CPE6": (6, "strain"),
    "CPE4": (4, "strain"),
    "CPE8R": (8, "strain"),
    "CPS6": (6, "stress"),
    "CPS4": (4, "stress"),
    "CPS8R": (8, "stress"),
    "CAX3": (3, "axis"),
    "CAX6": (6, "axis"),
    "CAX4": (4, "axis"),
    "CAX8R": (8, "axis"),
}


FIELD = ".13g"  # CalculiX reads 20 characters of a number, and drops the end of an exponent behind them


def input_file(kind: str, mesh, forces: np.ndarray, gravity: np.ndarray) -> str:
    lines = ["*NODE,NSET=ALL"]
    lines += [f"{i}," + ",".join(f"{x:{FIELD}}" for x in point) for i, point in enumerate(mesh.points, 1)]
    lines += [f"*ELEMENT,TYPE={kind},ELSET=E"]
    for e, cell in enumerate(mesh.cells, 1):
        row = [str(e), *(str(v + 1) for v in (turned(mesh, cell) if kind in PLANE else cell))]
        lines.append(",\n".join(",".join(row[i : i + 14]) for i in range(0, len(row), 14)))
    lines += ["*NSET,NSET=WALL", *(f"{i + 1}," for i in mesh.nodes(lambda u: u[0] == 0))]
    lines += ["*MATERIAL,NAME=M", "*ELASTIC", "210000.,0.3", "*DENSITY", "7.8e-9"]
    lines += ["*SOLID SECTION,ELSET=E,MATERIAL=M"]
    if kind in PLANE and PLANE[kind][1] != "axis":
        lines.append(f"{THIN if PLANE[kind][1] == 'stress' else 1.0}")
    lines += ["*BOUNDARY", f"WALL,1,{mesh.points.shape[1]}", "*STEP", "*STATIC", "*CLOAD"]
    lines += [f"{i + 1},{c + 1},{forces[i, c]:{FIELD}}" for i, c in np.argwhere(forces)]
    size = np.linalg.norm(gravity)
    across = [*(gravity / size), 0.0][:3]
    lines += ["*DLOAD", f"E,GRAV,{size:{FIELD}}," + ",".join(f"{g:{FIELD}}" for g in across)]
    lines += ["*NODE PRINT,NSET=ALL", "U", "*END STEP"]
    return "\n".join(lines) + "\n"


def turned(mesh, cell: list[int]) -> list[int]:
    """Corners counterclockwise, as CalculiX wants them."""
    a, b, c = mesh.points[cell[:3]]
    if np.linalg.det([b - a, c - a]) > 0:
        return cell
    corners, middles = cell[: mesh.corners], cell[mesh.corners :]
    return [corners[0], *corners[:0:-1], *middles[::-1]]


def model(kind: str, boxes):
    """Mesh, deck, forces on nodes and gravity."""
    if kind in SOLIDS:
        block, deck, end = gravity_beam(boxes, *SOLIDS[kind])
        forces = np.zeros_like(block.points)
        forces[end] = np.array([50, 0, -100]) / len(end)
        return block, deck, forces, np.array([0, 0.6e8, -0.8e8])
    return gravity_strip(boxes[:2], *PLANE[kind])


def measured(command: list[str], folder: Path) -> tuple[float, float]:
    """Seconds of processor time, and the most memory in MB, of one thread."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    with (folder / "messages").open("w+") as messages:
        run = subprocess.Popen(command, cwd=folder, env=environment, stdout=messages, stderr=messages)
        _, status, used = os.wait4(run.pid, 0)
        if status != 0:
            messages.seek(0)
            raise SystemExit(f"{' '.join(command)}: status {status}\n{messages.read()[-2000:]}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    kinds = [*SOLIDS, *PLANE]
    parser.add_argument(
        "--boxes", type=int, nargs=3, default=(6, 2, 2), help="boxes along x, y, z; plane: x, y"
    )
    parser.add_argument("--kinds", nargs="+", default=kinds, choices=kinds)
    parser.add_argument("--rounds", type=int, default=1, help="runs of each program, in turn")
    parser.add_argument("--write", type=Path, help="keep the displacements of CalculiX there")
    options = parser.parse_args()
    engrane = str(Path(os.environ.get("ENGRANE", "build/bin/engrane")).resolve())
    kept = {}
    print("                                     engrane          CalculiX        ratio of")
    print("kind      nodes   cells  difference  seconds      MB   seconds      MB   seconds")
    for kind in options.kinds:
        mesh, deck, forces, gravity = model(kind, options.boxes)
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "deck.dat").write_text("\n".join(deck) + "\n")
            (folder / "beam.inp").write_text(input_file(kind, mesh, forces, gravity))
            commands = [[engrane, "-q", "deck.dat", "-o", "deck"], ["ccx", "beam"]]
            pairs = np.array([[measured(c, folder) for c in commands] for _ in range(options.rounds)])
            with h5py.File(folder / "deck.h5") as file:
                frames = file["fields/displacement"]
                found = frames[sorted(frames)[-1]][:]
            expected = np.zeros((len(mesh.points), 3))
            for line in (folder / "beam.dat").read_text().splitlines():
                words = line.split()
                if len(words) == 4 and words[0].isdigit():
                    expected[int(words[0]) - 1] = [float(w) for w in words[1:]]
        found *= ring_means(mesh, kind.startswith("CAX"))
        difference = np.abs(found - expected).max() / np.abs(expected).max()
        figures = " ".join(f"{seconds:9.2f} {memory:7.0f}" for seconds, memory in np.median(pairs, axis=0))
        ratio = np.median(pairs[:, 0, 0] / pairs[:, 1, 0])
        print(f"{kind:8} {len(mesh.points):6} {len(mesh.cells):7} {difference:11.1e} {figures} {ratio:9.2f}")
        kept[kind] = {"boxes": list(options.boxes), "displacement": expected.tolist()}
    if options.write:
        options.write.write_text(json.dumps(kept) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
