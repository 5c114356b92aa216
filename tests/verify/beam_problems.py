# SPDX-License-Identifier: BSD-3-Clause
"""Decks of beams: a line of nodes along a curve, and what they carry."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from runs import Run


class Line:
    """Nodes along a curve, place(u) for u from 0 to 1; `nodes` of each piece, 2 or 3."""

    def __init__(
        self,
        place: Callable[[float], np.ndarray],
        pieces: int,
        nodes: int = 3,
        first: int = 1,
        element: int = 1,
    ) -> None:
        self.nodes, self.pieces, self.element = nodes, pieces, element
        count = (nodes - 1) * pieces + 1
        self.points = np.array([place(u) for u in np.linspace(0, 1, count)])
        self.ids = list(range(first, first + count))

    @property
    def last(self) -> int:
        return self.ids[-1]

    def text(self) -> str:
        """Records of `.NOE`."""
        rows = (
            f" I {i} X {x:.16g} {y:.16g} {z:.16g}" for i, (x, y, z) in zip(self.ids, self.points, strict=True)
        )
        return "\n".join(rows)

    def beam(self, rest: str = "BPR 1") -> str:
        """The record of `.MCE`."""
        names = [" ".join(map(str, self.ids[i : i + 20])) for i in range(0, len(self.ids), 20)]
        linear = " LINEAR" if self.nodes == 2 and len(self.ids) > 2 else ""
        return f" I {self.element} BEAM N " + "\n  ".join(names) + f" {rest}{linear}"


def straight(
    length: float, direction: tuple[float, float, float] = (1, 0, 0)
) -> Callable[[float], np.ndarray]:
    along = length * np.array(direction) / np.linalg.norm(direction)
    return lambda u: u * along


def deck(lines: list[Line], section: str, rest: str, beam: str = "BPR 1", joints: str = "") -> str:
    """`rest` is what follows the elements."""
    nodes = "\n".join(line.text() for line in lines)
    beams = "\n".join(line.beam(beam) for line in lines)
    return f".NOE\n{nodes}\n.BPR\n I 1 {section}\n.MCE\n{beams}\n{joints}\n{rest}\n.FIN 1\n"


def clamp(node: int) -> str:
    return f"FIX NOEUD {node} C 1 2 3 4 5 6"


def statics(loads: str, steps: int) -> str:
    return f".CLM\n{loads}\n.FCT\n I 1 RAMP 0 0 1 1\n.SAM TYPE STATIC\n.SUB TF 1 H {1 / steps!r}"


def tip(found: Run, line: Line, instant: int = -1) -> np.ndarray:
    """Where the last node is."""
    return line.points[-1] + [found[f"node/{line.last}/U{c}"][instant] for c in "XYZ"]


def orders(errors: list[float]) -> np.ndarray:
    """Of errors that belong to lengths which are halved from one to the next."""
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
