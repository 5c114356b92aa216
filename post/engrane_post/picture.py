# SPDX-License-Identifier: BSD-3-Clause
"""`engrane picture`: the mechanism at one time, or before and after."""

from __future__ import annotations

import argparse
from dataclasses import replace

import numpy as np

from . import options
from .errors import UserError
from .results import Frame, Results

BAR = 0.15  # of the width, for the colours of a field
EXAMPLES = """  engrane picture run                          the last frame
  engrane picture run --time 0.01 -o run.png
  engrane picture run --both                   before and after, side by side
  engrane picture run --reference --view top   the model as the deck gives it, from above
  engrane picture run --field VON_MISES        stresses of a mesh
  engrane picture run --deformed 50            its displacements 50 times as large
  engrane picture run --mode 1                 the first buckling mode
  engrane picture run --view 1,0.5,2 --zoom 1.2"""


def add(commands: argparse._SubParsersAction) -> None:
    """Declares the command."""
    p = options.subcommand(
        commands,
        "picture",
        "the mechanism, before and after",
        "Draws the mechanism: wheels with their teeth, hinges, bodies, springs, loads. One tooth of every "
        "wheel is painted, to show its turn. Teeth are drawn for the eye, from radius, cone and helix.",
        EXAMPLES,
    )
    view_arguments(p)
    which = p.add_mutually_exclusive_group()
    which.add_argument(
        "--frame", type=int, metavar="n", help="frame number from 0, negative from the end (default -1)"
    )
    which.add_argument("--time", type=float, metavar="t", help="the frame nearest to this time")
    which.add_argument("--reference", action="store_true", help="the undeformed model")
    which.add_argument("--mode", type=int, metavar="n", help="a mode of linearised buckling, from 1")
    p.add_argument(
        "--both", action="store_true", help="reference and frame side by side, seen from the same place"
    )
    p.add_argument("-o", "--output", metavar="file", help="picture to write (.png .jpg)")
    p.set_defaults(run=run)


def view_arguments(p: argparse.ArgumentParser) -> None:
    """What pictures and animations share."""
    p.add_argument("result", help="result file, prefix or deck")
    p.add_argument(
        "--view",
        metavar="side|x,y,z",
        help="look from this side: front +z, back, right +x, left, top +y, bottom, or from the direction "
        "x,y,z (write --view=-1,0,1 when it starts with a minus; default: chosen to show the wheels)",
    )
    p.add_argument("--up", choices=("x", "y", "z"), help="this axis points up (default: chosen)")
    p.add_argument("--zoom", type=float, default=1.0, help="above 1 comes nearer")
    p.add_argument("--size", default=None, metavar="WxH", help="pixels, such as 1600x1000")
    p.add_argument("--title", help="text above (default: the deck's title)")
    p.add_argument(
        "--field",
        default="",
        metavar="NAME[:XX]",
        help="colour the cells of a mesh by a field, VON_MISES, STRESS:XX: averaged at nodes where it is "
        "known there, else its means over the cells",
    )
    p.add_argument(
        "--deformed", type=float, default=1.0, metavar="f", help="show displacements f times as large"
    )


def check_view(args: argparse.Namespace) -> None:
    """Refuses what no picture can show."""
    if not args.zoom > 0:
        raise UserError("--zoom must be above 0.")
    if not np.isfinite(args.deformed):
        raise UserError("--deformed must be a number.")


def pixels(text: str | None, default: tuple[int, int]) -> tuple[int, int]:
    """`1600x1000` as two numbers."""
    if text is None:
        return default
    parts = text.lower().split("x")
    if len(parts) != 2 or not all(p.isdigit() and 50 <= int(p) <= 8000 for p in parts):
        raise UserError(f"--size {text} is not a size; write for instance 1600x1000.")
    return int(parts[0]), int(parts[1])


def selected(result: Results, args: argparse.Namespace) -> Frame:
    """The frame asked for; a file without frames shows its reference when nothing else was asked."""
    if args.reference:
        return result.reference()
    if getattr(args, "mode", None) is not None:
        return result.mode(args.mode)
    if args.time is not None:
        return result.frame_at(args.time)
    return result.frame(-1 if args.frame is None else args.frame)


def enlarged(frame: Frame, factor: float) -> Frame:
    """The frame with displacements and rotations so many times as large."""
    return replace(
        frame, displacement=factor * frame.displacement, rotation=factor * frame.rotation, factor=factor
    )


def run(args: argparse.Namespace) -> None:
    """Draws one picture."""
    check_view(args)
    with Results(args.result) as result:
        path = options.check_output(
            args.output or options.default_output(result, ["picture"], ".png"), (".png", ".jpg", ".jpeg")
        )
        if args.both and args.reference:
            raise UserError("--both shows the reference anyway; leave out --reference or --both.")
        if not result.elements and len(result.points) == 0:
            raise UserError(f"{result.path} holds no nodes and no elements; there is nothing to draw.")
        frame = selected(result, args)
        if args.field:
            result.cell_field(args.field, max(0, frame.index or 0))  # says what there is when it is not
        frame = enlarged(frame, args.deformed)
        frames = [result.reference(), frame] if args.both else [frame]
        render(result, frames, path, args)
    print(f"wrote {path}")


def render(result: Results, frames: list[Frame], path: str, args: argparse.Namespace) -> None:
    """Draws the frames side by side, as the command line says."""
    title = args.title if args.title is not None else (result.title or result.name)
    picture(result, frames, path, args.size, args.view, args.zoom, title, upward=args.up, field=args.field)


def picture(
    result: Results,
    frames: list[Frame],
    path: str,
    size: str | None = None,
    view_from: str | None = None,
    zoom: float = 1.0,
    title: str = "",
    bare: bool = False,
    upward: str | None = None,
    field: str = "",
) -> None:
    """Draws the frames side by side; `bare` leaves the time out and the background white."""
    from . import view
    from .graphics import pv
    from .scene import Scene, Stage

    scene = Scene(result)
    limits = scene.limits(field, frames)  # views beside each other share the bar of the first
    pixel_size = pixels(size, (1800, 900) if len(frames) > 1 else (1400, 1000))
    plotter = pv.Plotter(off_screen=True, shape=(1, len(frames)), window_size=pixel_size, border=False)
    stages = []
    for i in range(len(frames)):  # first all: a bar of the same name changes the colours of those before
        plotter.subplot(0, i)
        stages.append(Stage(scene, plotter, field=field, limits=limits))
    for i, frame in enumerate(frames):
        plotter.subplot(0, i)
        stages[i].show(frame)
        view.dress(plotter, title if i == 0 else "", "" if bare else view.caption(result, frame))
        if bare:
            plotter.set_background("white")
        view.aim(plotter, scene, frames, view_from, zoom, upward, BAR if field else 0.0, not bare)
        plotter.enable_anti_aliasing("ssaa")
    plotter.screenshot(path)
    plotter.close()
