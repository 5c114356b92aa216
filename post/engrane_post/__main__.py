# SPDX-License-Identifier: BSD-3-Clause
"""`engrane plot | spectrum | orders | picture | animate | export | import | sweep | study ...`."""

from __future__ import annotations

import argparse
import errno
import os
import sys
from collections.abc import Sequence

from .errors import Terminated, UserError

CTRL_C, TERMINATED = 130, 143  # as the shell tells of commands that signals ended
DESCRIPTION = (
    "Shows the results of engrane. A result is named by its file (run.h5), prefix (run) or deck (run.dat)."
)
EPILOG = """examples:
  engrane plot run --list                          all channels with units
  engrane plot run element/7/NORMAL_FORCE          a history
  engrane spectrum run 7/NORMAL_FORCE              its spectrum, with the tooth frequencies marked
  engrane orders run 7/NORMAL_FORCE --map          order against speed, of a run-up
  engrane picture run --both -o run.png            the mechanism before and after
  engrane animate run --fps 20 -o run.gif          the mechanism in motion
  engrane export run                               moving surfaces and forces for ParaView
  engrane import wheel.msh                         a mesh of another program as a deck
  engrane sweep gear.dat -D KM=1E8:1E9:1E8         a deck for many values: table and diagram
  engrane study gear.dat                           which scheme and step reach an error in the least time
  engrane inertia part.stl --density 7850          mass, centre and tensor of a part for RIGID
  engrane figures                                  the founding paper's figures
  engrane gallery                                  pictures of gear trains and mechanisms

engrane <command> --help tells more."""


def parser() -> argparse.ArgumentParser:
    """The command line; each command's module adds its own words."""
    from . import (
        animate,
        export,
        figures,
        gallery,
        histories,
        import_mesh,
        inertia,
        lines,
        orders,
        picture,
        study,
        sweep,
    )

    top = argparse.ArgumentParser(
        prog="engrane",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = top.add_subparsers(dest="command", required=True, metavar="command")
    for module in (
        histories,
        lines,
        orders,
        picture,
        animate,
        export,
        import_mesh,
        sweep,
        study,
        inertia,
        figures,
        gallery,
    ):
        module.add(commands)
    return top


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs one command. Exit status 0, or 1 after a sentence on standard error, or as the shell
    has it after Ctrl-C and SIGTERM."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    try:
        args = parser().parse_args(words[:1] if words[:1] == ["figures"] else words)
    except SystemExit as end:
        if not end.code:  # --help
            raise
        return 1  # 2 is a run that fails
    try:
        if args.command == "figures":
            from . import figures

            return figures.main(words[1:])
        status = args.run(args)
        sys.stdout.flush()
        return status or 0
    except UserError as error:
        print(f"engrane {args.command}: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return CTRL_C
    except Terminated:
        return TERMINATED
    except BrokenPipeError:
        _drop_output()  # `engrane plot run --list | head`: the reader has seen enough
    except OSError as error:
        print(f"engrane {args.command}: {_sentence(error)}", file=sys.stderr)
        _drop_output()
        return 1
    return 0


def _sentence(error: OSError) -> str:
    """What the system refuses."""
    name = error.filename or "the output"
    if isinstance(error, PermissionError):
        return f"{name} may not be written or read."
    if isinstance(error, FileNotFoundError):
        return f"the folder of {name} does not exist."
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        return f"{name} cannot be written: the disk is full."
    return f"{name} cannot be written or read: {error.strerror or error}."


def _drop_output() -> None:
    """Points the standard output elsewhere if it takes no more, or Python complains at exit."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


if __name__ == "__main__":
    sys.exit(main())
