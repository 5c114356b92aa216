# SPDX-License-Identifier: BSD-3-Clause
"""`engrane animate`: the mechanism in motion, as a GIF or a series of pictures."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from . import options
from .errors import UserError
from .picture import BAR, check_view, enlarged, pixels, view_arguments
from .results import Frame, Results

EXAMPLES = """  engrane animate run                              run.gif, at most 120 frames
  engrane animate run --from 0 --to 0.002 --fps 20
  engrane animate run --every 5 -o run_%04d.png    a series of pictures
  engrane animate run --field VON_MISES            stresses of a mesh, one scale of colours for all pictures
  engrane animate run --deformed 50                its displacements 50 times as large

Frames are those the deck archives (.SAI). A wheel that turns more than half a tooth between two frames seems
to turn wrongly; archive more often, or show a shorter span."""
MOST_FRAMES = 120


def add(commands: argparse._SubParsersAction) -> None:
    """Declares the command."""
    p = options.subcommand(
        commands,
        "animate",
        "the mechanism in motion (GIF)",
        "Draws the archived frames one after the other, seen from one place that holds the whole motion.",
        EXAMPLES,
    )
    view_arguments(p)
    p.add_argument("--from", dest="start", type=float, metavar="t", help="first time")
    p.add_argument("--to", dest="end", type=float, metavar="t", help="last time")
    p.add_argument(
        "--every",
        type=int,
        metavar="n",
        help=f"take every n-th frame (default: at most {MOST_FRAMES} in all)",
    )
    p.add_argument("--fps", type=float, default=20.0, help="pictures per second (default 20)")
    p.add_argument("-o", "--output", metavar="file", help="run.gif, or run_%%04d.png for a series")
    p.set_defaults(run=run)


def frame_numbers(
    times: np.ndarray, start: float | None, end: float | None, every: int | None, most: int = MOST_FRAMES
) -> list[int]:
    """Frames inside the span, thinned to every n-th or to no more than `most`."""
    if every is not None and every < 1:
        raise UserError("--every must be 1 or more.")
    low = -np.inf if start is None else start
    high = np.inf if end is None else end
    inside = np.flatnonzero((times >= low) & (times <= high))
    if len(inside) == 0:
        raise UserError(
            f"no frames between {low:g} and {high:g}; the frames cover {times[0]:g} to {times[-1]:g}."
        )
    step = every or max(1, -(-len(inside) // most))
    return [int(i) for i in inside[::step]]


def run(args: argparse.Namespace) -> None:
    """Draws all frames."""
    if not 0.1 <= args.fps <= 100:
        raise UserError("--fps must lie between 0.1 and 100.")
    check_view(args)
    with Results(args.result) as result:
        path = options.check_output(
            args.output or options.default_output(result, [], ".gif"), (".gif", ".png")
        )
        series = path.lower().endswith(".png")
        if series and "%" not in Path(path).name:
            path = str(Path(path).with_name(Path(path).stem + "_%04d.png"))
        if series:
            try:
                Path(path).name % 0
            except (TypeError, ValueError) as error:
                raise UserError(
                    f"{path} is not a pattern for a series; write for instance run_%04d.png."
                ) from error
        result.frame(0)  # no frames: say so before drawing anything
        numbers = frame_numbers(result.frame_times, args.start, args.end, args.every)
        if args.field:
            result.cell_field(args.field, numbers[0])  # says what there is when it is not
        draw(result, numbers, path, series, args)


def draw(result: Results, numbers: list[int], path: str, series: bool, args: argparse.Namespace) -> None:
    """Renders the frames into one file or many."""
    from . import view
    from .graphics import pv
    from .scene import Scene, Stage

    scene = Scene(result)
    plotter = pv.Plotter(off_screen=True, window_size=pixels(args.size, (900, 660)))

    def frames(every: int = 1) -> Iterator[Frame]:  # one after the other: all those of a mesh are too many
        return (enlarged(result.frame(i), args.deformed) for i in numbers[::every])

    stage = Stage(scene, plotter, field=args.field, limits=scene.limits(args.field, frames()))
    title = args.title if args.title is not None else (result.title or result.name)
    sample = list(frames(max(1, len(numbers) // 40)))
    view.aim(plotter, scene, sample, args.view, args.zoom, args.up, BAR if args.field else 0.0)
    plotter.enable_anti_aliasing("ssaa")
    images = []
    for k, frame in enumerate(frames()):
        stage.show(frame)
        if k == 0:
            view.dress(plotter, title, view.caption(result, frame))
        else:
            view.write_caption(plotter, view.caption(result, frame))
        plotter.render()
        if series:
            plotter.screenshot(str(Path(path).with_name(Path(path).name % k)))
        else:
            images.append(plotter.screenshot(return_img=True))
    plotter.close()
    if not series:
        write_gif(path, images, args.fps)
    print(f"wrote {len(numbers)} frames to {path}")


def write_gif(path: str, images: list[np.ndarray], fps: float) -> None:
    """Writes the pictures as one file, with one palette that some of them choose: what does not move does not
    flicker, and takes no room."""
    from PIL import Image

    # Roots of the numbers of pixels: the background would take most of the palette, and leave a few steps for
    # a bar of colours; with each colour once it would have steps itself.
    some = np.concatenate([image.reshape(-1, 3) for image in images[:: max(1, len(images) // 8)]])
    colours, counts = np.unique(some @ np.array([1 << 16, 1 << 8, 1]), return_counts=True)
    weighed = np.repeat(colours, np.sqrt(counts).astype(int))
    palette = Image.fromarray(
        np.stack([weighed >> 16, weighed >> 8, weighed], -1).astype(np.uint8)[None]
    ).quantize()
    first, *others = (
        Image.fromarray(image).quantize(palette=palette, dither=Image.Dither.NONE) for image in images
    )
    first.save(path, save_all=True, append_images=others, duration=1000 / fps, loop=0)
