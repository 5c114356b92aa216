# SPDX-License-Identifier: BSD-3-Clause
"""The diagram of `engrane study`: error over processor time."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from . import style
from .study_errors import Truth
from .study_report import Attempt, short

MOST_LABELS = 9  # of the runs of a line
LEAST = 1e-16  # what an error of 0 is drawn as
OWN, CHOSEN = "#222222", "#c8102e"  # colours of the deck as it is and of what is recommended


def draw(
    path: str,
    attempts: Sequence[Attempt],
    truth: Truth,
    step: float,
    target: float,
    chosen: Attempt | None,
    title: str,
) -> None:
    """Error over processor time: a line for each setting, hollow where the reference cannot tell."""
    lines: dict[tuple[str, str], list[Attempt]] = {}
    for a in attempts:
        # of the deck as it is the solver is the deck's own
        if a.tells and (a.ladder is not attempts[0].ladder or a is attempts[0]):
            lines.setdefault((a.ladder.title, a.solver), []).append(a)
    height = {id(a): max(a.error, truth.floor, LEAST) for line in lines.values() for a in line}
    solvers = {solver for _, solver in lines}
    colors: dict[str, str] = {}
    with style.plt.rc_context(style.RC):
        figure, axis = style.plt.subplots(figsize=(8.6, 5.8), layout="constrained")
        axis.set_xscale("log")
        axis.set_yscale("log")
        for k, ((name, solver), members) in enumerate(lines.items()):
            own = members[0] is attempts[0]
            color = OWN if own else colors.setdefault(name, style.COLORS[len(colors) % len(style.COLORS)])
            alone = len(members) == 1
            look = {"color": color, "marker": ("X" if own else "D") if alone else "o", "linestyle": ""}
            axis.plot([a.seconds for a in members], [height[id(a)] for a in members], color=color, zorder=3)
            label = name + (f", {solver}" if len(solvers) > 1 else "")
            for a in members:
                face = "white" if a.error < truth.floor else color
                axis.plot(a.seconds, height[id(a)], markersize=7, markerfacecolor=face, zorder=4, **look)
            axis.plot([], [], markersize=7, label=label, **look | {"linestyle": "" if alone else "-"})
            if not alone and len(members) <= MOST_LABELS:
                # right of the one line, left of the other: neighbours are often close
                above = k % 2 == 1
                place = {"xytext": (5, 4) if above else (-5, -4), "textcoords": "offset points"}
                align = {"ha": "left" if above else "right", "va": "bottom" if above else "top"}
                for a in members:
                    where = (a.seconds, height[id(a)])
                    axis.annotate(rung_label(a, step), where, fontsize=7.5, color=color, **place, **align)
        axis.axhline(target, color=CHOSEN, linewidth=0.9, linestyle=(0, (5, 3)), zorder=2)
        if chosen:
            axis.plot(
                chosen.seconds,
                height[id(chosen)],
                marker="o",
                markersize=16,
                markerfacecolor="none",
                markeredgecolor=CHOSEN,
                markeredgewidth=1.6,
                linestyle="",
                zorder=6,
                label=f"recommended for an error of {short(target)}",
            )
        shade_doubt(axis, truth, min(height.values()))
        axis.margins(x=0.08)
        plain_times(axis)
        axis.set_xlabel("processor time [s], without the start of the program")
        axis.set_ylabel("largest error, over the size of what is compared")
        figure.legend(
            loc="outside upper left", ncols=3, fontsize=8.5, title=title, title_fontsize=11, alignment="left"
        )
    style.save(figure, path)


def shade_doubt(axis: Axes, truth: Truth, least: float) -> None:
    """Shows below which error the reference tells nothing."""
    if truth.floor == 0 or least > 30 * truth.floor:
        return
    axis.set_ylim(bottom=truth.floor / 5)
    axis.axhspan(truth.floor / 5, truth.floor, color="#eeeeee", zorder=0)
    axis.text(
        0.99,
        truth.floor * 0.9,
        "below this the reference is not accurate enough",
        transform=axis.get_yaxis_transform(),
        fontsize=7.5,
        color="#777777",
        ha="right",
        va="top",
    )


def plain_times(axis: Axes) -> None:
    """Times as plain numbers, also where the axis spans less than a decade."""
    low, high = axis.get_xlim()
    narrow = high / low < 300
    axis.xaxis.set_major_locator(LogLocator(base=10, subs=(1, 2, 5) if narrow else (1,)))
    axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.xaxis.set_minor_formatter(NullFormatter())


def rung_label(a: Attempt, step: float) -> str:
    """`4H`, `H/2` or the tolerance."""
    if "TOL" in a.rung.sub:
        return a.rung.sub["TOL"]
    ratio = a.rung.size / step
    if ratio >= 1:
        return "H" if abs(ratio - 1) < 1e-6 else f"{ratio:g}H"
    return f"H/{1 / ratio:g}"
