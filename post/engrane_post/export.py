# SPDX-License-Identifier: BSD-3-Clause
"""`engrane export`: the mechanism as moving surfaces, and its forces as points with vectors, for ParaView."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from . import export_cells, options
from .animate import frame_numbers
from .errors import UserError
from .mesh import Mesh, Step
from .picture import selected
from .results import Frame, Results

MOST_FRAMES = 100
EXAMPLES = f"""\
  engrane export run                          {MOST_FRAMES} frames in run.vtkhdf and run_forces.vtkhdf
  engrane export run --frames 400 --from 0.1  more of them, from a later time on
  engrane export run --every 1                all frames that the deck archived (.SAI)
  engrane export run --vtu                    run.pvd and run_forces.pvd, a .vtu file for each frame
  engrane export run --mesh run.med           a mesh with the fields of the last frame (.vtu .msh ...)
  engrane export run --mesh run_cells.vtkhdf  those of all frames

In ParaView open run.vtkhdf (5.12 and later) or run.hdf.series (5.11), press Apply and play. For the
colours of `engrane picture` colour by `color` with Map Scalars off; for one kind of thing, Threshold on
`kind`. Open run_forces.vtkhdf beside it and add the filter Glyph with Orientation Array and Scale Array FORCE
or MOMENT. docs/post.md lists the arrays."""


def add(commands: argparse._SubParsersAction) -> None:
    """Declares the command."""
    p = options.subcommand(
        commands,
        "export",
        "moving surfaces and forces for ParaView",
        "Writes what `engrane picture` draws, wheels with their teeth, racks, cams, belts, joints, springs "
        "and bodies, as surfaces that move from frame to frame, and the forces and moments on nodes and at "
        "contacts as points with vectors for glyphs. Cells are written once; only points and vectors change.",
        EXAMPLES,
    )
    p.add_argument("result", help="result file, prefix or deck")
    p.add_argument("--vtkhdf", action="store_true", help="VTKHDF, one file for all frames (default)")
    p.add_argument("--vtu", action="store_true", help="VTK's XML files, one for each frame, and a .pvd list")
    p.add_argument("--from", dest="start", type=float, metavar="t", help="first time")
    p.add_argument("--to", dest="end", type=float, metavar="t", help="last time")
    thin = p.add_mutually_exclusive_group()
    thin.add_argument("--every", type=int, metavar="n", help="take every n-th frame")
    thin.add_argument(
        "--frames",
        type=int,
        metavar="n",
        help=f"take at most n frames, evenly spaced (default {MOST_FRAMES})",
    )
    p.add_argument(
        "--mesh",
        metavar="file",
        help="instead: the cells of a mesh with all fields that the format holds, at one frame "
        f"({' '.join(export_cells.FILES)}) or at all ({' '.join(export_cells.SERIES)})",
    )
    one = p.add_mutually_exclusive_group()
    one.add_argument(
        "--frame", type=int, metavar="n", help="with --mesh: frame number (default -1, the last)"
    )
    one.add_argument("--time", type=float, metavar="t", help="with --mesh: the frame nearest to this time")
    p.add_argument("--no-forces", action="store_true", help="only the surfaces")
    p.add_argument("-o", "--output", metavar="prefix", help="names of the files without their endings")
    p.set_defaults(run=run)


def run(args: argparse.Namespace) -> None:
    """Writes the files asked for."""
    if args.frames is not None and args.frames < 1:
        raise UserError("--frames must be 1 or more.")
    if args.mesh is None and (args.frame is not None or args.time is not None):
        raise UserError("--frame and --time go with --mesh; --from and --to choose the frames otherwise.")
    if args.mesh is not None:
        _mesh(args)
        return
    with Results(args.result) as result:
        result.frame(0)  # no frames: say so before anything is made
        most = args.frames or MOST_FRAMES
        numbers = frame_numbers(result.frame_times, args.start, args.end, args.every, most)
        prefix = Path(_without_ending(args.output or options.default_output(result, [], "")))
        if not prefix.resolve().parent.is_dir():
            raise UserError(f"Cannot write {prefix}: there is no folder {prefix.parent}.")
        export(
            result,
            [result.frame(i) for i in numbers],
            prefix,
            args.vtkhdf or not args.vtu,
            args.vtu,
            not args.no_forces,
        )


def _mesh(args: argparse.Namespace) -> None:
    """The cells as a file of another program."""
    path = Path(options.check_output(args.mesh, export_cells.FILES + export_cells.SERIES))
    with Results(args.result) as result:
        cells = export_cells.Cells.of(result)
        if path.suffix.lower() in export_cells.SERIES:
            result.frame(0)
            most = args.frames or MOST_FRAMES
            numbers = frame_numbers(result.frame_times, args.start, args.end, args.every, most)
            made = export_cells.write_series(cells, [result.frame(i) for i in numbers], path)
            print(f"wrote {len(cells.order)} cells at {len(numbers)} frames to {made}")
            return
        args.reference = not len(result.frame_times)
        with options.whole_file(path) as part:
            left = export_cells.write_frame(cells, selected(result, args), part)
    if left.fields:
        print(f"note: {path.suffix} files hold no fields; left out: {', '.join(left.fields)}.")
    if left.groups:
        names = ", ".join(f'"{name}"' for name in left.groups)
        held = export_cells.HELD_GROUPS[path.suffix.lower()]
        print(f"note: {path.suffix} files hold {held}; left out: {names}.")
    print(f"wrote {len(cells.order)} cells to {path}")


def _without_ending(name: str) -> str:
    for ending in (".vtkhdf", ".pvd", ".vtu"):
        name = name.removesuffix(ending)
    return name


def export(
    result: Results, frames: list[Frame], prefix: Path, vtkhdf: bool, vtu: bool, with_forces: bool = True
) -> None:
    """Writes surfaces and forces at these frames into files whose names begin with the prefix."""
    from .forces import Forces
    from .scene import Scene
    from .surfaces import Surfaces

    scene = Scene(result)
    surfaces = Surfaces(scene)
    if not len(surfaces.mesh.types):
        raise UserError(f"{result.path} holds nothing that is drawn; there is nothing to export.")

    def moved() -> Iterator[Step]:
        for frame in frames:
            yield surfaces.step(frame)

    _write(surfaces.mesh, frames, moved, prefix, vtkhdf, vtu)
    if not with_forces:
        return
    forces = Forces(scene, frames)
    if not forces.points:
        print("note: no histories of forces and no reactions in this result; no glyphs are written.")
        return

    def acting() -> Iterator[Step]:
        for k, frame in enumerate(frames):
            yield forces.step(frame, k)

    _write(forces.mesh(), frames, acting, prefix.with_name(prefix.name + "_forces"), vtkhdf, vtu)


def _write(
    mesh: Mesh,
    frames: list[Frame],
    steps: Callable[[], Iterator[Step]],
    prefix: Path,
    vtkhdf: bool,
    vtu: bool,
) -> None:
    from .vtkhdf import write, write_series
    from .vtu import write_collection

    times = np.array([f.time for f in frames], float)
    if vtkhdf:
        path = prefix.with_name(prefix.name + ".vtkhdf")
        write(path, mesh, times, steps())
        write_series(path)
        _say(path, frames, path.stat().st_size)
    if vtu:
        path, size = write_collection(prefix, mesh, steps())
        _say(path, frames, size)


def _say(path: Path, frames: list[Frame], size: int) -> None:
    print(f"wrote {len(frames)} frames to {path} ({size / 1e6:.3g} MB)")
