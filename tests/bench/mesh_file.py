# SPDX-License-Identifier: BSD-3-Clause
"""Reading a mesh as text and as a file of HDF5: processor time and memory of `engrane` up to the model, by
the number of nodes.

    ENGRANE=build/bin/engrane PYTHONPATH=post:tests build/venv/bin/python tests/bench/mesh_file.py [runs]
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from engrane_post import cell_mesh, cells, mesh_h5
from plane_meshes import Sheet

# ends with the model built: the wrong card is told only then
CARDS = '.MAT\n I 1 YT 1. NT 0.3\n.HYP DEFO PLAN\n.SEL\n GROUP 9 NOM "all" MAILLES TOUT\n'
LAST = '.AEL\n GROUP "all" MAT 1\n.CLM\n NOEUD 999999999 FIX C 1\n.FIN 1\n'


def cost(deck: Path) -> tuple[float, float]:
    """Seconds of processor and megabytes of a run that ends with the fault of its last card."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = ["time", "-f", "%M", os.environ["ENGRANE"], str(deck)]  # Debian's package time
    done = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert "node 999999999 does not exist" in done.stderr, done.stderr
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, int(done.stderr.split()[-1]) / 1024


def main() -> None:
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    print("nodes, text: s MB, file: s MB, bytes of text and file")
    for boxes in ((50, 20), (160, 64), (500, 200), (1000, 333)):
        mesh = Sheet(boxes, 8, lambda u: np.array([10 * u[0] + 0.1 * u[1], u[1]]))
        points = np.column_stack([mesh.points, np.zeros(len(mesh.points))])
        block = cell_mesh.Block(cells.BY_NAME["quad8"], 1, np.array(mesh.cells))
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "text.dat").write_text("\n".join(mesh.deck()) + "\n" + CARDS + LAST)
            mesh_h5.write(folder / "a.mesh.h5", cell_mesh.CellMesh(points, [block]), "a sheet")
            (folder / "file.dat").write_text('.MAI FILE "a.mesh.h5"\n' + CARDS + LAST)
            found: dict[str, list[tuple[float, float]]] = {"text": [], "file": []}
            for _ in range(runs):  # in turn
                for kind, costs in found.items():
                    costs.append(cost(folder / f"{kind}.dat"))
            row = [statistics.median(c[k] for c in costs) for costs in found.values() for k in (0, 1)]
            sizes = [(folder / f).stat().st_size for f in ("text.dat", "a.mesh.h5")]
            print(len(points), *(f"{value:.3g}" for value in row), *sizes)


if __name__ == "__main__":
    main()
