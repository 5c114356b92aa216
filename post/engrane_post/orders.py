# SPDX-License-Identifier: BSD-3-Clause
"""`engrane orders`: amplitude against order of a wheel's turn, and against order and speed."""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import numpy as np
import scipy

from . import options
from .errors import UserError
from .lines import harmonic
from .order_spectra import OrderMap, OverAngle, order_map, order_spectrum, over_angle
from .results import Channel, Results, bracketed
from .spectra import WINDOWS, Spectrum, no_lines
from .tooth import ToothFrequency, tooth_frequencies

EXAMPLES = """  engrane orders run 7/NORMAL_FORCE                      over the turn of wheel A of the pair
  engrane orders run 7/NORMAL_FORCE --wheel element/9/PSI_A --max 100
  engrane orders run 7/NORMAL_FORCE --map                order against speed, of a run-up
  engrane orders run 7/NORMAL_FORCE --map --csv map.csv  the same as numbers

An order is a number of events in one turn of the wheel: 1 is unbalance, z the meeting of its z teeth.
What belongs to a gear keeps its order when the speed changes; a resonance keeps its frequency. A sine of
amplitude 1 shows 1, the mean is taken off. Spectra take the last whole turns of the span. Resolution is
2/(number of turns) with the hann window, 2.3/turns with blackman, 1.21/turns with none."""
STRETCHES = 16  # of the map, side by side, when nothing else is asked,
PERIODS = 3  # but at least so many periods of the strongest order in each,
FEWEST_STRETCHES = 3  # as far as so many stretches leave room


def add(commands: argparse._SubParsersAction) -> None:
    """Declares the command."""
    p = options.subcommand(
        commands,
        "orders",
        "amplitude against order of a wheel's turn; map of order and speed",
        "Resamples histories over the angle of a wheel and draws their amplitude against the order, the "
        "number of events in a turn. Prints the largest lines and marks the tooth orders of every GEAR.",
        EXAMPLES,
    )
    options.history_arguments(p)
    p.add_argument(
        "--wheel",
        metavar="channel",
        help="angle (or speed) of the wheel whose turns count, such as element/7/PSI_A, element/1/ANGLE, "
        "node/4/WZ (default: PSI_A of the GEAR whose channel is drawn)",
    )
    p.add_argument("--map", action="store_true", help="amplitude over order and speed")
    p.add_argument(
        "--turns",
        type=float,
        metavar="n",
        help="turns in one stretch of the map (default: a sixteenth; of a short run more, for "
        f"{PERIODS} periods of the strongest order)",
    )
    p.add_argument("--csv", metavar="file", help="write the numbers of the diagram, too")
    p.add_argument(
        "--window", choices=WINDOWS, default="hann", help="taper (default hann; none for whole turns)"
    )
    p.add_argument(
        "--harmonics", type=int, default=4, metavar="n", help="tooth harmonics marked (default 4; 0: none)"
    )
    p.add_argument("--max", dest="highest", type=float, metavar="order", help="highest order drawn")
    p.add_argument("--peaks", type=int, default=8, metavar="n", help="lines in the table (default 8)")
    p.add_argument("--log", action="store_true", help="logarithmic amplitudes")
    p.set_defaults(run=run)


def run(args: argparse.Namespace) -> None:
    """Computes, prints, writes and draws."""
    files, wanted = options.split(args.what)
    if len(files) > 1:
        raise UserError("Give one result; orders of several are drawn one by one.")
    with Results(files[0]) as result:
        if args.list:
            options.print_list(result)
            return
        channels = options.chosen([result], wanted)
        if args.map and len(channels) > 1:
            raise UserError(f"--map draws one channel; {len(channels)} were named.")
        name = options.default_output(
            result, [channels[0].name, "order_map" if args.map else "orders"], ".png"
        )
        path = options.check_output(args.output or name, (".png", ".pdf", ".svg"))
        table = options.check_output(args.csv, (".csv",)) if args.csv else None
        wheel = wheel_channel(result, channels[0], args.wheel)
        samples = {c.name: _resampled(result, c, wheel, args) for c in channels}
        first = samples[channels[0].name]
        spectra = {
            c.name: order_spectrum(_resampled(result, c, wheel, args, whole=True), args.window)
            for c in channels
        }
        marks = tooth_orders(result, first) if args.harmonics > 0 else []
        limit = args.highest or _limit(list(spectra.values()), marks, args.harmonics, first.highest)
        for channel in channels:
            _print(channel, wheel, samples[channel.name], spectra[channel.name], marks, args.peaks)
        if args.map:
            chart = _map(result, first, spectra[channels[0].name], limit, args)
            _draw_map(result, channels[0], wheel, chart, marks, args, path)
            if table:
                _write_map(table, result, chart)
        else:
            _draw(result, channels, wheel, spectra, marks, limit, args, path)
            if table:
                _write_spectra(table, channels, spectra, limit)


def wheel_channel(result: Results, channel: Channel, wanted: str | None) -> Channel:
    """The channel that counts the turns."""
    if wanted is None:
        parts = channel.name.split("/")
        own = f"{parts[0]}/{parts[1]}/PSI_A" if len(parts) == 3 else ""
        if own not in result.channels:
            near = [n for n in result.channels if n.endswith(("/PSI_A", "/ANGLE"))][:3]
            hint = f", for instance --wheel {near[0]}" if near else ""
            raise UserError(f"Say whose turns count{hint}.")
        return result.channels[own]
    found = result.find_channels(wanted)
    if len(found) != 1:
        raise UserError(f"--wheel {wanted} names {len(found)} channels; name one.")
    if not found[0].unit.lstrip("[").startswith("rad"):
        raise UserError(
            f"{found[0].name} is no angle: its unit is {found[0].unit or 'none'}. "
            "Take an angle in radians, such as PSI_A of a GEAR or ANGLE of a HINGE, or a speed such as "
            "WZ of a node."
        )
    return found[0]


def _resampled(
    result: Results, channel: Channel, wheel: Channel, args: argparse.Namespace, whole: bool = False
) -> OverAngle:
    t, y = options.finite(result, channel, *result.history(channel, args.start, args.end), need_all=True)
    _, angle = options.finite(result, wheel, *result.history(wheel, args.start, args.end), need_all=True)
    n = min(len(y), len(angle))
    t, y, angle = t[:n], y[:n], angle[:n]
    if len(np.unique(t)) < 8:
        raise UserError(f"{channel.name} has {len(t)} samples in this span; orders need 8.")
    if "/" in wheel.unit:  # a speed
        rising = np.r_[np.diff(t) > 0, True]
        angle = scipy.interpolate.CubicSpline(t[rising], angle[rising]).antiderivative()(t)
    return over_angle(t, y, angle, whole)


def tooth_orders(result: Results, samples: OverAngle) -> list[ToothFrequency]:
    """Tooth meetings of every GEAR in one turn of the wheel; pairs of a train that share theirs appear
    once."""
    start, end = float(samples.time[0]), float(samples.time[-1])
    out: list[ToothFrequency] = []
    for m in tooth_frequencies(result, start, end):
        order = m.frequency * (end - start) / samples.turns[-1]
        if not any(abs(order - o.frequency) < 1e-3 * order for o in out):
            out.append(ToothFrequency(m.title, order, m.source))
    return out


def _limit(spectra: list[Spectrum], marks: list[ToothFrequency], harmonics: int, highest: float) -> float:
    """Up to where the spectra hold 99.99 % of their power, and at least the second tooth harmonic; never
    past what the steps in time resolve."""
    need = max((m.frequency * min(2, harmonics) for m in marks), default=0.0)
    for s in spectra:
        power = np.cumsum(s.amplitude**2)
        if power[-1] > 0:
            need = max(need, s.frequency[int(np.searchsorted(power, 0.9999 * power[-1]))])
    return min(highest, 1.25 * need) if need > 0 else highest


def _print(
    channel: Channel, wheel: Channel, samples: OverAngle, s: Spectrum, marks: list[ToothFrequency], count: int
) -> None:
    unit = channel.unit or "-"
    turns = s.step * len(s.samples)
    cut = f" (the last of {samples.turns[-1]:.6g})" if samples.turns[-1] > 1.001 * turns else ""
    print(
        f"{channel.name} ({channel.owner}) over {turns:.6g} turns{cut} of {wheel.name}, "
        f"mean {s.mean:.6g} {unit}"
    )
    print(f"  resolution {s.resolution:.4g}, orders up to {samples.highest:.4g} at the highest speed")
    for m in marks:
        print(f"  tooth order of {m.title}: {m.frequency:.6g}")
    peaks, below = s.lines(count)
    peaks = [p for p in peaks if p[0] <= samples.highest]
    if below or not peaks:
        print(f"  {no_lines(s, below)}")
    if not peaks:
        return
    print(f"  {'order':>12}  {'amplitude ' + bracketed(unit):>20}  share  tooth order")
    for o, a in peaks:
        print(f"  {o:12.6g}  {a:20.6g}  {a / peaks[0][1]:5.3f}  {harmonic(o, marks, 1 / turns)}".rstrip())


def speed_unit(result: Results) -> tuple[float, str]:
    """Factor from turns per time, and unit: rpm where time is in seconds."""
    unit = result.time_unit.strip().strip("[]")
    return (60.0, "rpm") if unit == "s" else (1.0, f"turns/{unit or 'time'}")


def _strongest(s: Spectrum) -> float:
    """Order of the largest amplitude from 1 on: below there is the slow change of the run-up."""
    fast = s.frequency >= 1 - 0.5 * s.resolution
    return max(1.0, float(s.frequency[fast][np.argmax(s.amplitude[fast])])) if fast.any() else 1.0


def _map(
    result: Results, samples: OverAngle, whole: Spectrum, limit: float, args: argparse.Namespace
) -> OrderMap:
    total, strongest = samples.turns[-1], _strongest(whole)
    turns = args.turns or max(total / STRETCHES, min(PERIODS / strongest, total / FEWEST_STRETCHES))
    chart = order_map(samples, turns, limit, args.window)
    resolution = whole.resolution * whole.step * len(whole.samples) / chart.turns
    print(f"  map: stretches of {chart.turns:.4g} turns, resolution {resolution:.4g}")
    if resolution > strongest:
        print(
            f"  note: these stretches do not show order {strongest:.4g} as a line; "
            f"that takes {chart.turns * resolution / strongest:.3g} turns or more (--turns)"
        )
    if chart.speed[-1] < 1.02 * chart.speed[0]:
        factor, unit = speed_unit(result)
        raise UserError(
            f"The speed changes only from {factor * chart.speed[0]:.4g} to "
            f"{factor * chart.speed[-1]:.4g} {unit} in this span; a map needs a run-up. Leave out --map."
        )
    return chart


def _write_spectra(path: str, channels: list[Channel], spectra: dict[str, Spectrum], limit: float) -> None:
    first = spectra[channels[0].name]
    shown = np.flatnonzero(first.frequency <= limit)
    with Path(path).open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow(["order", *(f"{c.name} {bracketed(c.unit)}".strip() for c in channels)])
        for i in shown:
            out.writerow(
                [f"{first.frequency[i]:.9g}", *(f"{spectra[c.name].amplitude[i]:.9g}" for c in channels)]
            )
    print(f"wrote {path}")


def _write_map(path: str, result: Results, chart: OrderMap) -> None:
    """One row for each stretch: its speed, then the amplitudes; the first row holds the orders."""
    factor, unit = speed_unit(result)
    with Path(path).open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow([f"speed [{unit}] / order", *(f"{o:.9g}" for o in chart.order)])
        for speed, row in zip(chart.speed, chart.amplitude, strict=True):
            out.writerow([f"{factor * speed:.9g}", *(f"{a:.9g}" for a in row)])
    print(f"wrote {path}")


def _mark(axis, marks: list[ToothFrequency], harmonics: int, limit: float, color: str, line: str) -> None:
    """Dashed lines at the tooth orders with a word above the diagram, where nothing is drawn over."""
    used: list[float] = []
    for m in marks:
        for k in range(1, harmonics + 1):
            order = k * m.frequency
            if order > limit:
                break
            axis.axvline(order, color=line, linewidth=0.8, linestyle=(0, (4, 3)), zorder=2)
            # Words that would stand on each other are left out; the lines stay.
            if all(abs(order - o) > 0.035 * limit for o in used):
                used.append(order)
                axis.annotate(
                    m.title if k == 1 else f"{k}×",
                    (order, 1),
                    xycoords=("data", "axes fraction"),
                    xytext=(0, 3),
                    textcoords="offset points",
                    ha="center",
                    va="bottom",
                    fontsize=7,
                    color=color,
                    annotation_clip=False,
                )


def _draw(
    result: Results,
    channels: list[Channel],
    wheel: Channel,
    spectra: dict[str, Spectrum],
    marks: list[ToothFrequency],
    limit: float,
    args: argparse.Namespace,
    path: str,
) -> None:
    from . import style

    figure, axes = style.panels(len(channels), height=3.2)
    for axis, channel in zip(axes, channels, strict=True):
        s = spectra[channel.name]
        shown = s.frequency <= limit
        axis.plot(s.frequency[shown], s.amplitude[shown], color=style.COLORS[0])
        biggest = s.amplitude[shown].max()
        if args.log and biggest > 0:
            axis.set_yscale("log")
            axis.set_ylim(biggest * 1e-5, biggest * 4)
        else:
            axis.set_ylim(0, biggest * 1.1 or 1)
        _mark(axis, marks, args.harmonics, limit, "#666666", "#999999")
        axis.set_xlim(0, limit)
        axis.set_ylabel(channel.axis_label("amplitude of"))
        axis.set_title(channel.owner, fontsize=9, loc="left", color="#444444", pad=14)
    axes[-1].set_xlabel(f"order (per turn of {wheel.name})")
    if result.title:
        figure.suptitle(result.title, fontsize=11)
    style.save(figure, path)


def _draw_map(
    result: Results,
    channel: Channel,
    wheel: Channel,
    chart: OrderMap,
    marks: list[ToothFrequency],
    args: argparse.Namespace,
    path: str,
) -> None:
    import matplotlib.colors

    from . import style

    factor, unit = speed_unit(result)
    figure, axes = style.panels(1, height=4.6)
    axis = axes[0]
    biggest = float(chart.amplitude.max()) or 1.0
    norm = (
        matplotlib.colors.LogNorm(biggest * 1e-3, biggest)
        if args.log
        else matplotlib.colors.Normalize(0, biggest)
    )
    # Light where there is little, so that the marks stay readable; it also prints in grey.
    image = axis.pcolormesh(
        chart.order,
        factor * chart.speed,
        np.maximum(chart.amplitude, biggest * 1e-3) if args.log else chart.amplitude,
        cmap="YlGnBu",
        norm=norm,
        shading="gouraud",
        rasterized=True,
    )
    axis.grid(False)
    _mark(axis, marks, args.harmonics, float(chart.order[-1]), "#555555", "#b06a3b")
    axis.set_xlim(chart.order[0], chart.order[-1])
    axis.set_ylabel(f"mean speed of {wheel.name} [{unit}]")
    axis.set_xlabel(f"order (per turn of {wheel.name})")
    axis.set_title(channel.owner, fontsize=9, loc="left", color="#444444", pad=14)
    bar = figure.colorbar(image, ax=axis, pad=0.02, aspect=30)
    bar.set_label(channel.axis_label("amplitude of"))
    bar.outline.set_visible(False)
    if not args.log:
        bar.formatter.set_useMathText(True)
    if result.title:
        figure.suptitle(result.title, fontsize=11)
    style.save(figure, path)
