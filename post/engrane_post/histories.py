# SPDX-License-Identifier: BSD-3-Clause
"""`engrane plot`: histories against time, or against one of them."""

from __future__ import annotations

import argparse
import textwrap
from contextlib import ExitStack

import numpy as np

from . import options
from .errors import UserError
from .results import AXIS_WIDTH, Channel, Results, bracketed, described

MOST_PANELS = 12
MOST_NAMES = 4  # of channels beside one axis
WIDE_ENTRY = 65  # characters of a legend's entry, of which two do not fit beside each other
EXAMPLES = """  engrane plot run --list
  engrane plot run element/7/NORMAL_FORCE
  engrane plot run 7.normal_force 7.u_m --from 0.01 --to 0.012
  engrane plot run 'element/*/NORMAL_FORCE' --together
  engrane plot rigid.h5 flexible.h5 7/NORMAL_FORCE -o compare.png
  engrane plot frame run/LOAD_TIME --against node/21/UY"""


def add(commands: argparse._SubParsersAction) -> None:
    """Declares the command."""
    p = options.subcommand(
        commands,
        "plot",
        "histories against time",
        "Draws histories against time, one diagram per channel, or all in one with --together. "
        "Several results are drawn over each other for comparison. Channel names may be written in any "
        "case and cut to 7/NORMAL_FORCE.",
        EXAMPLES,
    )
    options.history_arguments(p)
    p.add_argument("--together", action="store_true", help="all channels in one diagram; two units at most")
    p.add_argument("--against", metavar="channel", default="", help="this channel instead of time")
    p.add_argument("--title", help="text above the diagram (default: the deck's title)")
    p.set_defaults(run=run)


def run(args: argparse.Namespace) -> None:
    """Lists or draws."""
    files, wanted = options.split(args.what)
    with ExitStack() as stack:
        results = [stack.enter_context(Results(f)) for f in files]
        if args.list:
            for r in results:
                options.print_list(r)
            return
        channels = options.chosen(results, wanted)
        if len(channels) > MOST_PANELS and not args.together:
            raise UserError(
                f"{len(channels)} channels make too many diagrams (at most {MOST_PANELS}); add --together."
            )
        suffix = [c.name for c in channels[:2]]
        path = options.check_output(
            args.output or options.default_output(results[0], suffix, ".png"), (".png", ".pdf", ".svg")
        )
        draw(results, channels, args.start, args.end, args.together, args.title, path, args.against)


def legend_text(result: Results, channel: Channel, several_files: bool, several_channels: bool) -> str:
    """Only what tells the curves apart."""
    parts = [result.name] if several_files else []
    if several_channels:
        parts.append(f"{channel.owner} {channel.description}{channel.remark}".strip())
    return ", ".join(parts)


def shared_label(channels: list[Channel]) -> str:
    """Of an axis for channels of one unit: `UX, UY, UZ: displacement [m]`."""
    if len(channels) == 1:
        return channels[0].axis_label()
    names = list(dict.fromkeys(c.component for c in channels))
    labels = {c.label for c in channels}
    name = ", ".join(names[:MOST_NAMES]) + (" ..." if len(names) > MOST_NAMES else "")
    text = described(name, labels.pop()) if len(labels) == 1 else name
    return "\n".join(textwrap.wrap(f"{text} {bracketed(channels[0].unit)}".strip(), 2 * AXIS_WIDTH))


def draw(
    results: list[Results],
    channels: list[Channel],
    start: float | None,
    end: float | None,
    together: bool,
    title: str | None,
    path: str,
    against: str = "",
) -> None:
    """Reads, draws and writes one picture."""
    from . import style

    abscissa = options.chosen(results, [against])[0] if against else None

    units = list(dict.fromkeys(c.unit for c in channels))
    if together and len(units) > 2:
        raise UserError(
            f"One diagram has two axes at most, but the channels have {len(units)} units: {', '.join(units)}."
        )
    figure, axes = style.panels(1 if together else len(channels))
    shared = {units[0]: axes[0]}
    if together and len(units) == 2:
        with style.plt.rc_context(style.RC):
            shared[units[1]] = axes[0].twinx()
        shared[units[1]].spines["right"].set_visible(True)
        shared[units[1]].grid(False)
    color = 0
    for i, channel in enumerate(channels):
        axis = shared[channel.unit] if together else axes[i]
        for j, result in enumerate(results):
            t, y = options.finite(result, channel, *result.history(channel, start, end), need_all=False)
            if abscissa:
                t = np.interp(t, *result.history(abscissa, start, end))
            label = legend_text(result, channel, len(results) > 1, together and len(channels) > 1)
            pen = color if together else j
            axis.plot(
                t,
                y,
                label=label or None,
                color=style.COLORS[pen % len(style.COLORS)],
                linestyle="-" if j == 0 else (0, (5, 1.5)),
                marker="." if len(t) < 3 else None,
            )
            color += 1
        if not together:
            axis.set_ylabel(channel.axis_label())
            axis.set_title(channel.owner, fontsize=9, loc="left", color="#444444")
            if len(results) > 1:
                axis.legend(fontsize=8, loc="best")
    if together:
        for unit, axis in shared.items():
            axis.set_ylabel(shared_label([c for c in channels if c.unit == unit]))
        handles = [h for a in shared.values() for h in a.get_legend_handles_labels()[0]]
        if handles and (len(results) > 1 or len(channels) > 1):
            columns = 2 if max(len(h.get_label()) for h in handles) < WIDE_ENTRY else 1
            axes[0].legend(
                handles=handles, fontsize=8, loc="lower left", bbox_to_anchor=(0, 1.0), ncols=columns
            )
    time = f"time {bracketed(results[0].time_unit)}".strip()
    axes[-1].set_xlabel(f"{abscissa.owner} {abscissa.axis_label(width=80)}".strip() if abscissa else time)
    for axis in axes:
        axis.margins(x=0.01)
    text = title if title is not None else results[0].title
    state = "" if results[0].status == "complete" else f" ({results[0].status})"
    if text or state:
        figure.suptitle((text + state).strip(), fontsize=11)
    style.save(figure, path)
