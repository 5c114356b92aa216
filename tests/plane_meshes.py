# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of plane cells for tests, and their decks."""

from collections.abc import Callable

import numpy as np


class PlaneMesh:
    """A patch of plane cells of so many nodes over a unit square cut into boxes, placed by `place`."""

    def __init__(self, boxes: int | tuple[int, int], nodes: int, place: Callable) -> None:
        across, up = (boxes, boxes) if isinstance(boxes, int) else boxes
        known: dict[tuple[float, float], int] = {}
        unit: list[tuple[float, float]] = []

        def node(x: tuple[float, float]) -> int:
            key = (round(x[0], 9), round(x[1], 9))
            if key not in known:
                known[key] = len(unit)
                unit.append(x)
            return known[key]

        self.cells: list[list[int]] = []
        self.corners = 3 if nodes in (3, 6) else 4
        for j in range(up):
            for i in range(across):
                box = [((i + a) / across, (j + b) / up) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                for cut in [(0, 1, 2), (0, 2, 3)] if self.corners == 3 else [(0, 1, 2, 3)]:
                    at = [box[c] for c in cut]
                    cell = [node(x) for x in at]
                    if nodes > self.corners:
                        cell += [
                            node(((a[0] + b[0]) / 2, (a[1] + b[1]) / 2))
                            for a, b in zip(at, at[1:] + at[:1], strict=True)
                        ]
                    self.cells.append(cell)
        self.unit = np.array(unit)
        self.points = np.array([place(*x) for x in unit])

    def deck(self, hypothesis: str, material: str = "YT 1000. NT 0.3") -> str:
        rows = [".NOE", *(f" I {i} X {x:.17g} Y {y:.17g}" for i, (x, y) in enumerate(self.points, 1)), ".MAI"]
        for e, cell in enumerate(self.cells, 1):
            n = [c + 1 for c in cell]
            corners, middles = n[: self.corners], [-m for m in n[self.corners :]]
            pairs = zip(corners, middles, strict=True) if middles else ((c,) for c in corners)
            rows.append(f" I {e} AT 1 0 N {' '.join(str(k) for pair in pairs for k in pair)}")
        rows.append(f'.SEL GROUP 1 NOM "all" MAILLE TOUT\n.HYP {hypothesis} GROUP "all"')
        rows.append(f'.MAT I 1 BEHA "ELASTIC" {material}\n.AEL GROUP "all" MAT 1')
        return "\n".join(rows)

    def nodes(self, where) -> str:
        return " ".join(str(i) for i, x in enumerate(self.unit, 1) if where(x))

    def edges(self, where) -> list[tuple[int, int]]:
        """Cell and edge, counted from 1, whose corners are so."""
        return [
            (e, k + 1)
            for e, cell in enumerate(self.cells, 1)
            for k in range(self.corners)
            if where(self.unit[cell[k]]) and where(self.unit[cell[(k + 1) % self.corners]])
        ]
