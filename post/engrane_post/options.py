# SPDX-License-Identifier: BSD-3-Clause
"""Parts of the command line that several commands share."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from .errors import UserError
from .results import Channel, Results, find

SUFFIXES = (".h5", ".xdmf", ".dat", ".lst")


def subcommand(
    commands: argparse._SubParsersAction, name: str, short: str, text: str, examples: str
) -> argparse.ArgumentParser:
    """A command's parser whose help ends with examples."""
    return commands.add_parser(
        name,
        help=short,
        description=text,
        epilog="examples:\n" + examples,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def history_arguments(p: argparse.ArgumentParser) -> None:
    """Results and channels, time span, output."""
    p.add_argument(
        "what",
        nargs="+",
        metavar="result|channel",
        help="one or more results, then channels such as element/7/NORMAL_FORCE, 7.normal_force, node/4/UX, "
        "KINETIC_ENERGY, or a pattern 'element/*/NORMAL_FORCE'",
    )
    p.add_argument("--list", action="store_true", help="list all channels with their units and stop")
    p.add_argument("--from", dest="start", type=float, metavar="t", help="first time")
    p.add_argument("--to", dest="end", type=float, metavar="t", help="last time")
    p.add_argument("-o", "--output", metavar="file", help="picture to write (.png .pdf .svg)")


def split(words: list[str]) -> tuple[list[str], list[str]]:
    """Separates results from channel names; the first word is always a result."""
    files, channels = [words[0]], []
    for word in words[1:]:
        is_file = (
            word.endswith(SUFFIXES) or Path(word + ".h5").is_file() or Path(word + ".partial.h5").is_file()
        )
        (files if is_file else channels).append(word)
    for word in files:
        find(word)  # a missing file is reported before anything is read
    return files, channels


def chosen(results: list[Results], wanted: list[str]) -> list[Channel]:
    """Channels of the first result that the names mean; the others must have them too."""
    if not wanted:
        first = results[0]
        few = [n for n in first.channels if n.startswith("element/")][:3] or list(first.channels)[:3]
        hint = f", for instance {few[0]}" if few else ""
        raise UserError(f"Name a channel of {first.path}{hint}; --list shows all {len(first.channels)}.")
    out: dict[str, Channel] = {}
    for name in wanted:
        for channel in results[0].find_channels(name):
            out[channel.name] = channel
    for other in results[1:]:
        for name in out:
            other.find_channels(name)
    return list(out.values())


def print_list(result: Results) -> None:
    """The table of `--list`."""
    print(
        f"{result.path}: {result.title or 'untitled'} "
        f"({result.analysis or 'analysis unknown'}, {result.status})"
    )
    channels = result.channels
    if not channels:
        print("  no histories")
        return
    t = result.times()
    if len(t):
        print(
            f"  {len(t)} samples, t = {t[0]:g} to {t[-1]:g} {result.time_unit}; "
            f"{len(result.frame_times)} frames"
        )
    width = max(len(n) for n in channels)
    units = max(len(c.unit) for c in channels.values())
    owner = None
    for c in channels.values():
        if c.owner != owner:
            owner = c.owner
            print(f"  {owner}")
        print(f"    {c.name:<{width}}  {c.unit:<{units}}  {c.label}{c.remark}".rstrip())


def finite(
    result: Results, channel: Channel, t: np.ndarray, y: np.ndarray, need_all: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Drops samples that are not numbers, with a note, or refuses when all or (for a spectrum) any are."""
    bad = ~np.isfinite(y)
    if not bad.any():
        return t, y
    first = (
        f"{channel.name} of {result.path} is not a number from t = {t[bad][0]:g} on "
        f"({bad.sum()} of {len(y)} samples)"
    )
    if bad.all() or need_all:
        cure = f"; end before that with --to {t[bad][0]:g}" if not bad.all() and bad[-1] else ""
        raise UserError(first + cure + ".")
    print(f"note: {first}; those are left out.")
    return t[~bad], y[~bad]


def default_output(result: Results, words: list[str], suffix: str) -> str:
    """`run_element_7_NORMAL_FORCE.png` in the current folder."""
    stem = "_".join([result.name, *(re.sub(r"[^A-Za-z0-9]+", "_", w) for w in words)])
    return stem[:120] + suffix


@contextmanager
def named(path: Path) -> Iterator[None]:
    """While this file is written: errors of the system name it, and it goes away."""
    try:
        yield
    except OSError as error:
        error.filename = str(path)
        if not isinstance(error, PermissionError | FileNotFoundError | IsADirectoryError):
            path.unlink(missing_ok=True)
        raise


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A name beside `path` to write to: it takes the place of what is there once all is written."""
    part = path.with_name(f"{path.stem}.part{path.suffix}")
    try:
        yield part
        part.replace(path)
    except OSError as error:
        error.filename = str(path)
        raise
    finally:
        part.unlink(missing_ok=True)


def check_output(path: str, suffixes: tuple[str, ...]) -> str:
    """Refuses a file type that cannot be written."""
    if not path.lower().endswith(suffixes):
        raise UserError(f"Cannot write {path}: give a name that ends in {' or '.join(suffixes)}.")
    if not Path(path).resolve().parent.is_dir():
        raise UserError(f"Cannot write {path}: there is no folder {Path(path).parent}.")
    return path
