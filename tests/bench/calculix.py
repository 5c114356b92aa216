# SPDX-License-Identifier: BSD-3-Clause
"""The same meshes by engrane and by CalculiX (Debian: calculix-ccx): largest difference of displacements,
processor time, memory.

    ENGRANE=build/bin/engrane python tests/bench/calculix.py [--boxes 6 2 2] [--write FILE]

Formulations agree for tetrahedra of 4 and 10 nodes (C3D4, C3D10), wedges of 15 (C3D15) and hexahedra of
20 (C3D20). They do not for wedges of 6 (C3D6 has 2 points, engrane 6) and hexahedra of 8 (C3D8I has other
internal modes).
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

from solid_meshes import gravity_beam

KINDS = {
    "C3D4": (4, False),
    "C3D10": (4, True),
    "C3D6": (6, False),
    "C3D15": (6, True),
    "C3D8I": (8, False),
    "C3D20": (8, True),
}


def input_file(kind: str, block, loaded) -> str:
    lines = ["*NODE,NSET=ALL"]
    lines += [f"{i},{x:.16g},{y:.16g},{z:.16g}" for i, (x, y, z) in enumerate(block.points, 1)]
    lines += [f"*ELEMENT,TYPE={kind},ELSET=E"]
    for e, cell in enumerate(block.cells, 1):
        row = [str(e), *(str(v + 1) for v in cell)]
        lines.append(",\n".join(",".join(row[i : i + 14]) for i in range(0, len(row), 14)))
    lines += ["*NSET,NSET=WALL", *(f"{i + 1}," for i in block.nodes(lambda u: u[0] == 0))]
    lines += ["*MATERIAL,NAME=M", "*ELASTIC", "210000.,0.3", "*DENSITY", "7.8e-9"]
    lines += ["*SOLID SECTION,ELSET=E,MATERIAL=M", "*BOUNDARY", "WALL,1,3", "*STEP", "*STATIC", "*CLOAD"]
    for i in loaded:
        lines += [f"{i + 1},1,{50 / len(loaded):.16g}", f"{i + 1},3,{-100 / len(loaded):.16g}"]
    lines += ["*DLOAD", "E,GRAV,1e8,0.,0.6,-0.8", "*NODE PRINT,NSET=ALL", "U", "*END STEP"]
    return "\n".join(lines) + "\n"


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
    parser.add_argument("--boxes", type=int, nargs=3, default=(6, 2, 2), help="boxes along x, y, z")
    parser.add_argument("--kinds", nargs="+", default=list(KINDS), choices=list(KINDS))
    parser.add_argument("--write", type=Path, help="keep the displacements of CalculiX there")
    options = parser.parse_args()
    engrane = str(Path(os.environ.get("ENGRANE", "build/bin/engrane")).resolve())
    kept = {}
    print("                                     engrane          CalculiX")
    print("kind      nodes   cells  difference  seconds      MB   seconds      MB")
    for kind in options.kinds:
        block, deck, loaded = gravity_beam(options.boxes, *KINDS[kind])
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "deck.dat").write_text("\n".join(deck) + "\n")
            (folder / "beam.inp").write_text(input_file(kind, block, loaded))
            ours = measured([engrane, "-q", "deck.dat", "-o", "deck"], folder)
            theirs = measured(["ccx", "beam"], folder)
            with h5py.File(folder / "deck.h5") as file:
                frames = file["fields/displacement"]
                found = frames[sorted(frames)[-1]][:]
            expected = np.zeros_like(block.points)
            for line in (folder / "beam.dat").read_text().splitlines():
                words = line.split()
                if len(words) == 4 and words[0].isdigit():
                    expected[int(words[0]) - 1] = [float(w) for w in words[1:]]
        difference = np.abs(found - expected).max() / np.abs(expected).max()
        figures = " ".join(f"{seconds:9.2f} {megabytes:7.0f}" for seconds, megabytes in (ours, theirs))
        print(f"{kind:8} {len(block.points):6} {len(block.cells):7} {difference:11.1e} {figures}")
        kept[kind] = {"boxes": list(options.boxes), "displacement": expected.tolist()}
    if options.write:
        options.write.write_text(json.dumps(kept) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
