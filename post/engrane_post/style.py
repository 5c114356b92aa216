# SPDX-License-Identifier: BSD-3-Clause
"""Look of the diagrams."""

from __future__ import annotations

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

COLORS = ("#1f5fa8", "#d1571b", "#2a8a4a", "#8b3fa0", "#b8860b", "#0f8b8d", "#a23b3b", "#555555")

RC = {
    "figure.dpi": 130,
    "font.size": 10,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#666666",
    "axes.labelcolor": "#222222",
    "axes.axisbelow": True,
    "axes.prop_cycle": matplotlib.cycler(color=COLORS),
    "legend.frameon": False,
    "lines.linewidth": 1.1,
    "axes.formatter.limits": (-4, 5),
    "axes.formatter.use_mathtext": True,
    "savefig.facecolor": "white",
    "agg.path.chunksize": 20000,
}


def panels(
    count: int, height: float = 2.6, width: float = 9.0, sharex: bool = True
) -> tuple[Figure, list[Axes]]:
    """A column of diagrams."""
    with plt.rc_context(RC):
        total = height * count + (1.6 if count == 1 else 0.8)
        figure, axes = plt.subplots(
            count, 1, figsize=(width, total), sharex=sharex, squeeze=False, layout="constrained"
        )
    return figure, [a for a in axes[:, 0]]


def save(figure: Figure, path: str) -> None:
    """Writes and closes a figure and says so."""
    with plt.rc_context(RC):
        figure.savefig(path)
    plt.close(figure)
    print(f"wrote {path}")
