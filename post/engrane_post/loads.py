# SPDX-License-Identifier: BSD-3-Clause
"""What acts on a model from outside: loads at a frame, and nodes of a mesh that supports hold."""

from __future__ import annotations

import numpy as np

from .results import Frame, Results

LOADS = ("FORCE", "TORQUE", "CHA")
MOST_SUPPORTS = 36  # that are marked
ROUNDING = 1e-9  # of the largest


class Loads:
    """The histories of loads, where a run keeps them."""

    def __init__(self, result: Results) -> None:
        self.times = result.times()
        self.columns: dict[int, list[tuple[str, int]]] = {}
        types = {str(e.id): e.type.upper() for e in result.elements}
        for channel in result.channels.values():
            kind, _, rest = channel.name.partition("/")
            owner, _, name = rest.partition("/")
            if (
                kind == "element"
                and types.get(owner) in LOADS
                and name.startswith(("FORCE", "MOMENT", "TORQUE"))
            ):
                self.columns.setdefault(int(owner), []).append((channel.table, channel.column))
        tables = {table for columns in self.columns.values() for table, _ in columns}
        self.values = {t: np.abs(result.dataset(f"history/{t}/values")) for t in tables}

    def idle(self, frame: Frame) -> set[int]:
        """Elements whose load is zero at a frame: their function of time has switched them off."""
        if frame.index is None or frame.time is None or not len(self.times):
            return set()
        at = int(np.argmin(np.abs(self.times - frame.time)))
        return {
            owner
            for owner, columns in self.columns.items()
            if all(self.values[t][at, c] <= ROUNDING * self.values[t][:, c].max() for t, c in columns)
        }


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
