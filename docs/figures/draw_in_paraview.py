# SPDX-License-Identifier: BSD-3-Clause
"""Draws what `engrane export` wrote with ParaView 5.11: surfaces in their colours, forces as arrows.

    ./engrane decks/trains/planetary_load_sharing.dat -o run && ./engrane export run
    xvfb-run -a pvpython docs/figures/draw_in_paraview.py run docs/figures/paraview.png

It opens the series of steps; with `--whole` the file with all steps, for ParaView 5.12 or later."""

import argparse
import os

from paraview import simple


def opened(prefix: str, whole: bool):
    """The reader of a file, its step information read."""
    path = os.path.abspath(prefix) + (".vtkhdf" if whole else ".hdf.series")
    reader = simple.OpenDataFile(path)
    reader.UpdatePipelineInformation()
    return reader


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("prefix")
    words.add_argument("picture")
    words.add_argument("--whole", action="store_true")
    words.add_argument("--step", type=int, default=-1)
    words.add_argument("--vector", default="FORCE")
    words.add_argument("--eye", type=float, nargs=3, default=(0.35, 0.3, -1.0))
    words.add_argument("--opacity", type=float, default=0.5)
    words.add_argument("--zoom", type=float, default=1.4)
    words.add_argument("--arrow", type=float, default=0.35, help="the longest, as a part of the model's size")
    args = words.parse_args()

    surfaces = opened(args.prefix, args.whole)
    times = list(surfaces.TimestepValues)
    time = times[args.step]
    view = simple.CreateView("RenderView")
    view.ViewSize = [900, 700]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.ViewTime = time
    surfaces.UpdatePipeline(time)
    shown = simple.Show(surfaces, view)
    simple.ColorBy(shown, ("CELLS", "color"))
    shown.MapScalars = 0
    shown.Ambient = 0.3
    shown.Opacity = args.opacity
    low, high = (list(surfaces.GetDataInformation().GetBounds()[i::2]) for i in (0, 1))
    size = sum((high[i] - low[i]) ** 2 for i in range(3)) ** 0.5
    middle = [(low[i] + high[i]) / 2 for i in range(3)]

    forces = opened(args.prefix + "_forces", args.whole)
    forces.UpdatePipeline(time)
    largest = forces.PointData[args.vector].GetRange(-1)[1]
    arrows = simple.Glyph(Input=forces, GlyphType="Arrow")
    arrows.OrientationArray = ["POINTS", args.vector]
    arrows.ScaleArray = ["POINTS", args.vector]
    arrows.ScaleFactor = args.arrow * size / largest
    arrows.GlyphMode = "All Points"
    drawn = simple.Show(arrows, view)
    drawn.ColorArrayName = ["POINTS", ""]
    drawn.Ambient = 0.3
    drawn.DiffuseColor = [0.75, 0.1, 0.1]

    camera = view.GetActiveCamera()
    camera.SetFocalPoint(middle)
    camera.SetPosition([middle[i] + args.eye[i] * size for i in range(3)])
    camera.SetViewUp([0, 1, 0])
    view.OrientationAxesVisibility = 0
    simple.ResetCamera(view)
    camera.Dolly(args.zoom)
    simple.Render(view)
    simple.SaveScreenshot(args.picture, view)
    print(f"{len(times)} steps, t = {times[0]:g} to {times[-1]:g}; the largest {args.vector} is {largest:g}")


if __name__ == "__main__":
    main()
