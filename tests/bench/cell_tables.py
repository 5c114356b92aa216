# SPDX-License-Identifier: BSD-3-Clause
"""The tables of cells in docs/verification.md, measured by the functions of the tests.

ENGRANE=build/bin/engrane python tests/bench/cell_tables.py
"""

import sys
import tempfile
from itertools import product
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "verify"))

from cell_problems import COOK, PLANE, Disc, Hole, cook, even_tube, orders, stiff_tube
from macneal import LOADS, SHAPES, SOLIDS, orders_of_changes, plane_beam, solid_beam
from solid_problems import cantilever, rod_tip, tube_error


def row(*cells) -> None:
    print("| " + " | ".join(str(cell) for cell in cells) + " |")


def head(title: str, *cells) -> None:
    print(f"\n{title}\n")
    row(*cells)
    row(*("---" for _ in cells))


def numbers(values: list[float], form: str = ".2f") -> str:
    return " ".join(f"{value:{form}}" for value in values)


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sizes = (2, 4, 8, 16, 32)
        head("Cook's membrane", "nodes", *(f"{n} × {n}" for n in sizes), "orders")
        for nodes in PLANE:
            found = [cook(nodes, boxes, folder) for boxes in sizes]
            row(nodes, *(f"{v:.4f}" for v in found), numbers(orders([COOK - v for v in found])))
        graded = [cook(8, boxes, folder, graded=True) for boxes in (8, 16, 32)]
        row("8, graded", "", *(f"{v:.5f}" for v in graded), "", numbers(orders([COOK - v for v in graded])))

        sizes = (4, 8, 16)
        head(
            "Plate with a hole",
            "plane",
            "nodes",
            *sizes,
            "orders",
            *(f"{n}, stress" for n in sizes),
            "orders",
        )
        for hypothesis in ("stress", "strain"):
            for nodes in PLANE:
                pairs = [Hole(hypothesis).solve(nodes, boxes, folder) for boxes in sizes]
                errors, stresses = zip(*pairs, strict=True)
                row(
                    hypothesis,
                    nodes,
                    *(f"{e:.1e}" for e in errors),
                    numbers(orders(errors)),
                    *(f"{s:.4f}" for s in stresses),
                    numbers(orders([Hole.exact - s for s in stresses])),
                )

        head("Thick tube", "", "nodes", *sizes, "orders")
        for hypothesis in ("strain", "axis"):
            for nodes in PLANE:
                rows = [n if hypothesis == "strain" else 1 for n in sizes]
                errors = [
                    even_tube(hypothesis, n).solve(nodes, m, folder)[0]
                    for n, m in zip(sizes, rows, strict=True)
                ]
                row(hypothesis, nodes, *(f"{e:.1e}" for e in errors), numbers(orders(errors)))

        head("Rotating disc", "", "nodes", *sizes, "orders")
        for hypothesis in ("stress", "strain", "axis"):
            for nodes in PLANE:
                errors = [Disc(hypothesis).solve(nodes, n, folder) for n in sizes]
                row(hypothesis, nodes, *(f"{e:.1e}" for e in errors), numbers(orders(errors)))

        head("Thick tube of solids", "cell", 2, 4, 8, "orders")
        for kind, (corners, second) in {"T4": (4, False), **SOLIDS}.items():
            errors = [tube_error(corners, second, n, folder) for n in (2, 4, 8)]
            row(kind, *(f"{e:.1e}" for e in errors), numbers(orders(errors)))

        sizes, tip = (8, 16, 32, 64), rod_tip()
        head("Cantilever bent far", "cell", *sizes, "orders")
        for kind in ("T10", "W15", "H8", "H20"):
            found = [cantilever(*SOLIDS[kind], n, folder) for n in sizes]
            errors = [float(np.hypot(*(place - tip))) for place in found]
            row(kind, *(f"{e:.1e}" for e in errors), numbers(orders(errors)))

        ratios = (0.3, 0.49, 0.499, 0.4999)
        head("Thick tube, nearly incompressible", "", "nodes", *ratios)
        for hypothesis in ("strain", "axis"):
            rows = 9 if hypothesis == "strain" else 1
            kinds = [(nodes, True) for nodes in PLANE]
            if hypothesis == "strain":
                kinds += [(3, False), (6, False)]
            for nodes, alternating in kinds:
                shares = [
                    stiff_tube(hypothesis, nu, alternating).solve(nodes, rows, folder)[1] for nu in ratios
                ]
                name = f"{nodes}{'' if alternating else ', diagonals one way'}"
                row(hypothesis, name, *(f"{s:.4f}" for s in shares))

        head("Straight beam", "cell", *(f"{shape}: {', '.join(LOADS)}" for shape in SHAPES))
        for nodes in PLANE:
            shares = [
                [plane_beam("straight", nodes, load, folder, shape) for load in LOADS[:2]] for shape in SHAPES
            ]
            row(nodes, *(numbers(s, ".4f") for s in shares))
        for kind in SOLIDS:
            shares = [
                [solid_beam("straight", kind, load, folder, shape) for load in LOADS] for shape in SHAPES
            ]
            row(kind, *(numbers(s, ".4f") for s in shares))

        names = ("curved", "twisted")
        head("Curved and twisted beam", "cell", *(f"{n}, {load}" for n in names for load in LOADS[1:3]))
        for nodes in PLANE:
            row(nodes, f"{plane_beam('curved', nodes, 'in plane', folder):.4f}", "", "", "")
        for kind in SOLIDS:
            row(kind, *(f"{solid_beam(n, kind, load, folder):.4f}" for n in names for load in LOADS[1:3]))

        finer = (1, 2, 4, 8)
        head("Beams of finer meshes", "beam", "cell", *finer, "orders")
        for name in ("straight", "curved"):
            for nodes in PLANE:
                shares = [plane_beam(name, nodes, "in plane", folder, finer=k) for k in finer]
                row(
                    f"{name}, in plane",
                    nodes,
                    *(f"{s:.4f}" for s in shares),
                    numbers(orders_of_changes(shares)),
                )
        for name, load in product(("curved", "twisted"), LOADS[1:3]):
            for kind in SOLIDS:
                shares = [solid_beam(name, kind, load, folder, finer=k) for k in finer[:3]]
                figures = [f"{s:.4f}" for s in shares]
                row(f"{name}, {load}", kind, *figures, "", numbers(orders_of_changes(shares)))


if __name__ == "__main__":
    main()
