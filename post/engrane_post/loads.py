# SPDX-License-Identifier: BSD-3-Clause
"""What acts on a model from outside: loads and their arrows at a frame, and nodes of a mesh that supports
hold."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import shapes
from .results import Element, Frame, Results

LOADS = ("FORCE", "TORQUE", "CHA")
MOST_SUPPORTS = 36  # that are marked
ROUNDING = 1e-9  # of the largest


@dataclass(frozen=True)
class Arrow:
    """How the arrow of an element moves: its centre with a node, its axis with the `holder` (0: fixed in
    space)."""

    element: Element
    center: np.ndarray
    axis: np.ndarray  # the sense of the load while its function of time is positive
    holder: int
    couple: bool = False
    gap: np.ndarray | None = None  # of a moment's arc: the direction that stays free also when it is reversed

    def pose(self, carrier: np.ndarray, turn: np.ndarray, sense: int) -> np.ndarray:
        """4 x 4 matrix for its reference surface, from those of node and holder. `sense`: 1 or -1; 0 shrinks
        it to its centre."""
        pose = np.eye(4)
        pose[:3, :3] = abs(sense) * turn[:3, :3] @ (self._reversal() if sense < 0 else np.eye(3))
        pose[:3, 3] = (carrier @ np.r_[self.center, 1.0])[:3] - pose[:3, :3] @ self.center
        return pose

    def _reversal(self) -> np.ndarray:
        """Half a turn about a direction across the axis."""
        axis = shapes.unit(self.axis)
        side = np.zeros(3) if self.gap is None else self.gap - axis * (axis @ self.gap)
        side = shapes.unit(side) if np.linalg.norm(side) > 0.1 else shapes.square_to(axis)[0]
        return 2 * np.outer(side, side) - np.eye(3)


class Loads:
    """The histories of loads, where a run keeps them."""

    def __init__(self, result: Results) -> None:
        self.times = result.times()
        self.columns: dict[int, dict[str, tuple[str, int]]] = {}
        types = {str(e.id): e.type.upper() for e in result.elements}
        for channel in result.channels.values():
            kind, _, rest = channel.name.partition("/")
            owner, _, name = rest.partition("/")
            if (
                kind == "element"
                and types.get(owner) in LOADS
                and name.startswith(("FORCE", "MOMENT", "TORQUE"))
            ):
                self.columns.setdefault(int(owner), {})[name] = (channel.table, channel.column)
        tables = {table for columns in self.columns.values() for table, _ in columns.values()}
        self.values = {t: result.dataset(f"history/{t}/values") for t in tables}
        self.largest = {t: np.abs(v).max(axis=0) for t, v in self.values.items()}

    def sense(self, arrow: Arrow, frame: Frame) -> int:
        """1 or -1: a load acts along its arrow or against it at a frame; 0: its function of time is zero. 1
        where that is not known."""
        columns = self.columns.get(arrow.element.id)
        if not columns or frame.index is None or frame.time is None or not len(self.times):
            return 1
        now, idle = {}, True
        for name, (table, column) in columns.items():
            now[name] = self._at(self.values[table][:, column], frame.time)
            idle = idle and abs(now[name]) <= ROUNDING * self.largest[table][column]
        if idle:
            return 0
        alone = now.get("FORCE", now.get("TORQUE"))
        if alone is not None:  # along the card's direction, which the drawing has reversed for V < 0
            along = alone * float(arrow.element.parameters.get("V") or 1)
        else:
            kind = "MOMENT" if arrow.couple else "FORCE"
            along = sum(now.get(f"{kind}_{c}", 0.0) * x for c, x in zip("XYZ", arrow.axis, strict=True))
        return -1 if along < 0 else 1

    def _at(self, values: np.ndarray, time: float) -> float:
        """A history at a time: frames may lie between its samples."""
        after = min(int(np.searchsorted(self.times, time)), len(values) - 1)
        before = max(after - 1, 0)
        span = self.times[after] - self.times[before]
        share = min(max((time - self.times[before]) / span, 0.0), 1.0) if span > 0 else 1.0
        return float((1 - share) * values[before] + share * values[after])


def supported(result: Results, rows: np.ndarray) -> list[int]:
    """Rows among these of the nodes with reactions in the last frame; some, spread over all, where they are
    many."""
    count = len(result.frame_times)
    size = np.zeros(len(result.points))
    for name in ("reaction_force", "reaction_torque"):
        field = result.field(name, count - 1) if count else None
        if field is not None:
            values = np.nan_to_num(np.linalg.norm(field, axis=1))
            size = np.maximum(size[: len(values)], values / (values.max(initial=0) or 1.0))
    held = [int(i) for i in rows if i < min(len(size), len(result.node_ids)) and size[i] > ROUNDING]
    if len(held) <= MOST_SUPPORTS:
        return held
    places = result.points[held]
    chosen = [int(np.argmax(np.linalg.norm(places - places.mean(axis=0), axis=1)))]
    away = np.linalg.norm(places - places[chosen[0]], axis=1)
    while len(chosen) < MOST_SUPPORTS:  # the farthest from those so far
        chosen.append(int(np.argmax(away)))
        away = np.minimum(away, np.linalg.norm(places - places[chosen[-1]], axis=1))
    return [held[i] for i in chosen]
