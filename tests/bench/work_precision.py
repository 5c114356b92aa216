# SPDX-License-Identifier: BSD-3-Clause
"""Work-precision diagrams of several models in one figure."""

from pathlib import Path

#: title of a model, label of a line, name of a point, seconds, error
Lines = dict[str, list[tuple[str, float, float]]]


def draw(
    drawn: dict[str, Lines],
    marks: dict[str, str],
    named: str,
    path: Path,
    left: tuple[str, ...] = (),
    one_scale: bool = False,
) -> None:
    """Error over processor time of each model, three in a row. `marks`: of Matplotlib, by label. The points
    of the line `named` bear their names, those in `left` on the left. `one_scale`: one range of errors."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.patheffects import withStroke
    from matplotlib.ticker import LogLocator, NullLocator

    columns = min(3, len(drawn))
    rows = -(-len(drawn) // columns)
    figure, axes = plt.subplots(rows, columns, sharey=one_scale, layout="constrained", squeeze=False)
    figure.set_size_inches(4.4 * columns, 4 * rows + 0.5)
    for axis, (title, lines) in zip(axes.flat, drawn.items(), strict=False):
        for label, mark in marks.items():
            _, seconds, errors = zip(*lines[label], strict=True)
            size = {"D": 7, "*": 11}.get(mark.strip("-:k"), 4)
            axis.loglog(seconds, errors, mark, label=label, markersize=size)
        # of the first two points, the faster one has its name on the left
        first, second = lines[named][:2]
        names_on_left = {*left, min(first, second, key=lambda point: point[1])[0]}
        for name, *place in lines[named]:
            side = -1 if name in names_on_left else 1
            words = {"textcoords": "offset points", "ha": "right" if side < 0 else "left", "fontsize": 8}
            text = axis.annotate(name, place, (7 * side, 3), zorder=9, **words)
            text.set_path_effects([withStroke(linewidth=2.5, foreground="white")])
        axis.set_title(title)
        axis.margins(x=0.1)
        axis.xaxis.set_major_locator(LogLocator(subs=(1, 3)))
        axis.xaxis.set_major_formatter("{x:g}")
        axis.xaxis.set_minor_locator(NullLocator())
        axis.yaxis.set_minor_locator(NullLocator())
        axis.grid(True, which="major", alpha=0.3)
    for axis in axes.flat[len(drawn) :]:
        axis.remove()
    figure.supxlabel("processor time (s)")
    figure.supylabel("error over range")
    handles, labels = axes[0][0].get_legend_handles_labels()
    ncols = len(marks) if columns == 3 else 2 * columns - 1
    figure.legend(handles, labels, ncols=ncols, loc="outside upper center")
    figure.savefig(path, dpi=100)
