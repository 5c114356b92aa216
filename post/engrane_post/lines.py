# SPDX-License-Identifier: BSD-3-Clause
"""`engrane spectrum`: amplitude spectrum of histories with tooth frequencies marked."""

from __future__ import annotations

import argparse
from contextlib import ExitStack

import numpy as np

from . import options
from .errors import UserError
from .results import Channel, Results, bracketed
from .spectra import WINDOWS, Spectrum, no_lines, spectrum
from .tooth import ToothFrequency, tooth_frequencies

EXAMPLES = """  engrane spectrum run 7/NORMAL_FORCE
  engrane spectrum run 7/NORMAL_FORCE --from 0.02 --to 0.03 --max 40000
  engrane spectrum run 7/NORMAL_FORCE --mark 5000 --harmonics 4 --log
  engrane spectrum rigid.h5 flexible.h5 7/NORMAL_FORCE -o compare.png

The spectrum is single-sided and scaled so that a sine of amplitude 1 shows 1; the mean is taken off.
Leave the starting transient out with --from. Resolution is 2/(length of the span) with the hann window,
2.3/span with blackman, 1.21/span with none: closer lines show as one."""
FEWEST = 8


def add(commands: argparse._SubParsersAction) -> None:
    """Declares the command."""
    p = options.subcommand(
        commands,
        "spectrum",
        "amplitude spectrum of a history, with tooth frequencies",
        "Draws the amplitude spectrum of histories and prints their largest lines. The tooth frequency of "
        "every GEAR (its mean speed times its number of teeth) and its harmonics are marked. Uneven time "
        "steps are resampled.",
        EXAMPLES,
    )
    options.history_arguments(p)
    p.add_argument(
        "--window", choices=WINDOWS, default="hann", help="taper (default hann; none for whole periods)"
    )
    p.add_argument(
        "--mark", type=float, action="append", metavar="f", help="mark this frequency instead of the gears'"
    )
    p.add_argument(
        "--harmonics", type=int, default=5, metavar="n", help="harmonics marked (default 5; 0 for no marks)"
    )
    p.add_argument("--max", dest="highest", type=float, metavar="f", help="highest frequency drawn")
    p.add_argument("--peaks", type=int, default=8, metavar="n", help="lines in the table (default 8)")
    p.add_argument("--log", action="store_true", help="logarithmic amplitudes")
    p.set_defaults(run=run)


def run(args: argparse.Namespace) -> None:
    """Computes, prints and draws."""
    files, wanted = options.split(args.what)
    with ExitStack() as stack:
        results = [stack.enter_context(Results(f)) for f in files]
        if args.list:
            for r in results:
                options.print_list(r)
            return
        channels = options.chosen(results, wanted)
        name = options.default_output(results[0], [c.name for c in channels[:2]] + ["spectrum"], ".png")
        path = options.check_output(args.output or name, (".png", ".pdf", ".svg"))
        spectra = {}
        span = None
        for result in results:
            for channel in channels:
                t, y = options.finite(
                    result, channel, *result.history(channel, args.start, args.end), need_all=True
                )
                if len(t) < FEWEST or len(np.unique(t)) < FEWEST:
                    raise UserError(
                        f"{channel.name} has {len(t)} samples in this span; a spectrum needs {FEWEST}."
                    )
                span = span or (t[0], t[-1])
                spectra[result.name, channel.name] = spectrum(t, y, args.window)
        marks = [ToothFrequency(f"{f:g}", f, "given") for f in args.mark or []]
        if not marks and args.harmonics > 0:
            marks = tooth_frequencies(results[0], *span)
        for result in results:
            for channel in channels:
                _print(result, channel, spectra[result.name, channel.name], marks, args.peaks)
        _draw(results, channels, spectra, marks, args, path)


def harmonic(frequency: float, marks: list[ToothFrequency], bin_width: float) -> str:
    """`2 x GEAR 7` when a line lies on a harmonic within a bin."""
    for m in marks:
        order = round(frequency / m.frequency) if m.frequency > 0 else 0
        if order >= 1 and abs(frequency - order * m.frequency) <= max(bin_width, 2e-3 * frequency):
            return f"{order} x {m.title}"
    return ""


def _print(result: Results, channel: Channel, s: Spectrum, marks: list[ToothFrequency], count: int) -> None:
    unit = channel.unit or "-"
    duration = s.step * len(s.samples)
    rate = frequency_unit(result)
    steps = "resampled to even steps" if s.resampled else "even steps"
    print(f"{result.path}  {channel.name} ({channel.owner}), mean {s.mean:.6g} {unit}")
    print(f"  {len(s.samples)} samples, step {s.step:.4g}, {steps}, resolution {s.resolution:.4g} {rate}")
    for m in marks:
        print(
            f"  tooth frequency of {m.title}: {m.frequency:.6g} {rate} (from {m.source})"
            if m.source != "given"
            else f"  mark at {m.frequency:g} {rate}"
        )
    peaks, below = s.lines(count)
    if below or not peaks:
        print(f"  {no_lines(s, below)}")
    if not peaks:
        return
    print(f"  {'frequency ' + bracketed(rate):>20}  {'amplitude ' + bracketed(unit):>20}  share  order")
    for f, a in peaks:
        print(f"  {f:20.6g}  {a:20.6g}  {a / peaks[0][1]:5.3f}  {harmonic(f, marks, 1 / duration)}".rstrip())


def frequency_unit(result: Results) -> str:
    """Hz when time is in seconds or unnamed, otherwise the reciprocal of the time unit."""
    unit = result.time_unit.strip()
    return "Hz" if unit == "s" else f"1/{unit.strip('[]')}" if unit else "1/time"


def _limit(spectra: list[Spectrum], marks: list[ToothFrequency], harmonics: int) -> float:
    """Up to where all spectra hold 99.99 % of their power, and at least the second tooth harmonic; never past
    the data."""
    top = max(s.frequency[-1] for s in spectra)
    need = 0.0
    for s in spectra:
        power = np.cumsum(s.amplitude**2)
        if power[-1] > 0:
            need = max(need, s.frequency[int(np.searchsorted(power, 0.9999 * power[-1]))])
    shown = [m.frequency * min(2, harmonics) for m in marks]
    return min(top, 1.25 * max([need, *shown]) or top)


def _draw(
    results: list[Results],
    channels: list[Channel],
    spectra: dict[tuple[str, str], Spectrum],
    marks: list[ToothFrequency],
    args: argparse.Namespace,
    path: str,
) -> None:
    from . import style

    figure, axes = style.panels(len(channels), height=3.2)
    limit = args.highest or _limit(list(spectra.values()), marks, args.harmonics)
    for axis, channel in zip(axes, channels, strict=True):
        biggest = 0.0
        for j, result in enumerate(results):
            s = spectra[result.name, channel.name]
            shown = s.frequency <= limit
            axis.plot(
                s.frequency[shown],
                s.amplitude[shown],
                color=style.COLORS[j % len(style.COLORS)],
                linestyle="-" if j == 0 else (0, (5, 1.5)),
                label=result.name,
            )
            biggest = max(biggest, s.amplitude[shown].max())
        if args.log and biggest > 0:
            axis.set_yscale("log")
            axis.set_ylim(biggest * 1e-5, biggest * 8)
        else:
            axis.set_ylim(0, biggest * 1.3 or 1)
        frequencies = []
        for k, m in enumerate(marks):
            # Pairs of one train share their tooth frequency: one set of marks is enough.
            if any(abs(m.frequency - f) < 1e-3 * f for f in frequencies):
                continue
            frequencies.append(m.frequency)
            for order in range(1, args.harmonics + 1):
                if order * m.frequency > limit:
                    break
                axis.axvline(
                    order * m.frequency, color="#999999", linewidth=0.8, linestyle=(0, (4, 3)), zorder=0.5
                )
                text = m.title if order == 1 else f"{order}×"
                axis.annotate(
                    text,
                    (order * m.frequency, 1),
                    xycoords=("data", "axes fraction"),
                    rotation=90,
                    fontsize=7,
                    xytext=(-2, -3 - 34 * (k % 2)),
                    textcoords="offset points",
                    ha="right",
                    va="top",
                    color="#666666",
                )
        axis.set_xlim(0, limit)
        axis.set_ylabel(channel.axis_label("amplitude of"))
        axis.set_title(channel.owner, fontsize=9, loc="left", color="#444444")
        if len(results) > 1:
            axis.legend(fontsize=8)
    axes[-1].set_xlabel(f"frequency [{frequency_unit(results[0])}]")
    if results[0].title:
        figure.suptitle(results[0].title, fontsize=11)
    style.save(figure, path)
