# SPDX-License-Identifier: BSD-3-Clause
"""Camera, background and labels of the pictures."""

from __future__ import annotations

import numpy as np

from .errors import UserError
from .graphics import pv
from .results import Frame, Results
from .scene import Scene

DIRECTIONS = {
    "front": (0, 0, 1),
    "back": (0, 0, -1),
    "right": (1, 0, 0),
    "left": (-1, 0, 0),
    "top": (0, 1, 0),
    "bottom": (0, -1, 0),
}
MARGIN = 1.12  # of the picture over the model
BELOW = 0.03  # of the height, under the caption
LINE = 26  # pixels: the height of a line of text
LETTER = 11  # pixels: at most the mean width of a letter


def direction(scene: Scene, frames: list[Frame]) -> tuple[np.ndarray, np.ndarray]:
    """From where to look (unit vector from the model to the eye) and what is up.

    Wheels are seen best nearly along their axles, so the eye stands about 35 degrees off the commonest axle;
    without wheels off the direction in which the model is thinnest. A plane mesh is seen from straight
    before it."""
    axes = np.array([w.frame[:, 0] * w.shape.radius for w in scene.wheels])
    crossed = flat = False
    if len(axes):
        values, vectors = np.linalg.eigh(axes.T @ axes)
        front = vectors[:, -1]
        crossed = values[-2] > 0.02 * values[-1]
    else:
        corners = scene.corners(frames)
        values, vectors = np.linalg.eigh(np.cov((corners - corners.mean(axis=0)).T))
        front = vectors[:, 0]
        flat = plane_mesh(scene)
        if flat:
            front = np.array([0, 0, 1.0])
    front = front * (1 if front[np.argmax(np.abs(front))] >= 0 else -1)
    candidates = [np.array([0, 0, 1.0]), np.array([0, 1.0, 0])]
    up = next((c for c in candidates if abs(c @ front) < 0.75), np.array([1.0, 0, 0]))
    if crossed and abs(front[1]) > 0.75:
        up = np.array([0, 1.0, 0])
        front = np.array([0.35, 0.0, 1.0]) if abs(front[2]) < 0.75 else front
        front = front / np.linalg.norm(front)
    up = up - front * (up @ front)
    up = up / np.linalg.norm(up)
    if flat:
        return front, up
    side = np.cross(up, front)
    eye = front + (0.62 if crossed else 0.5) * side + (0.55 if crossed else 0.38) * up
    return eye / np.linalg.norm(eye), up


def plane_mesh(scene: Scene) -> bool:
    """Whether there are cells, all in the plane XY, with nothing but loads and supports on them."""
    meshes = [item.mesh.points for item in scene.items if item.cells is not None]
    others = {item.kind for item in scene.items if item.cells is None}
    return (
        bool(meshes) and others <= {"load", "support"} and all(np.ptp(points[:, 2]) == 0 for points in meshes)
    )


def eye_of(view: str) -> np.ndarray:
    """Unit vector from the model to the eye, from a side's name or from `x,y,z`."""
    if view in DIRECTIONS:
        return np.asarray(DIRECTIONS[view], float)
    try:
        eye = np.array([float(v) for v in view.split(",")])
    except ValueError:
        eye = np.zeros(0)
    length = np.linalg.norm(eye)
    if len(eye) != 3 or not np.isfinite(length) or length == 0:
        raise UserError(
            f"--view {view} is no direction; write {', '.join(DIRECTIONS)} or x,y,z such as 1,0.5,2."
        )
    return eye / length


def aim(
    plotter: pv.Plotter,
    scene: Scene,
    frames: list[Frame],
    view: str | None,
    zoom: float = 1.0,
    upward: str | None = None,
    left: float = 0.0,
    written: bool = True,
) -> None:
    """Points the camera of the current view at everything the frames show; `upward` is x, y or z, `left` the
    part of the width that stays free for a colour bar. With `written`, so does the height of title and
    caption."""
    eye, up = direction(scene, frames)
    if view:
        eye = eye_of(view)
        up = np.array([0, 1.0, 0]) if abs(eye[1]) < 0.75 else np.array([0, 0, 1.0])
    if upward and abs(eye["xyz".index(upward)]) < 0.999:
        up = np.eye(3)["xyz".index(upward)]
    up = up - eye * (up @ eye)
    up = up / np.linalg.norm(up)
    corners = scene.corners(frames)
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    side = np.cross(up, eye)
    side = side / np.linalg.norm(side)
    vertical = np.cross(eye, side)
    flat = np.stack([(corners - middle) @ side, (corners - middle) @ vertical], axis=-1)
    middle = middle + np.mean([flat.min(axis=0), flat.max(axis=0)], axis=0) @ np.stack([side, vertical])
    # A long lens keeps circles round at the edge. The eye goes as far back as the point needs that is nearest
    # the rim of the view, perspective included.
    angle = 20.0
    slope = np.tan(np.radians(angle / 2))
    aspect = plotter.window_size[0] / plotter.shape[1] / plotter.window_size[1]
    offset = corners - middle
    lines = BELOW + LINE / plotter.window_size[1] if written else 0.0
    upright = max(MARGIN, 1 / max(0.5, 1 - 2 * lines))
    reach = (
        np.maximum(np.abs(offset @ vertical) * upright, np.abs(offset @ side) * MARGIN / aspect / (1 - left))
        / slope
        / zoom
    )
    distance = float((reach + offset @ eye).max())
    distance = max(distance, 0.1 * scene.size)
    middle = middle - side * left * slope * aspect * distance  # what is seen goes to the right
    camera = plotter.camera
    camera.view_angle = angle
    camera.focal_point = middle
    camera.position = middle + eye * distance
    camera.up = up
    plotter.reset_camera_clipping_range()


def dress(plotter: pv.Plotter, title: str, caption: str) -> None:
    """Background, lights, triad, title at the top, time at the bottom."""
    plotter.set_background("#c4d2df", top="white")
    plotter.add_axes(line_width=3, color="#222222", viewport=(0, 0, 0.15, 0.15))
    plotter.renderer.remove_all_lights()
    # Lights that go with the camera: from the upper left, a soft one from the right, a weak one from the eye.
    for place, strength in (((-0.8, 1.0, 1.2), 0.82), ((1.2, 0.2, 0.6), 0.34), ((0.0, 0.0, 1.0), 0.42)):
        plotter.add_light(
            pv.Light(position=place, light_type="camera light", intensity=strength), only_active=True
        )
    if title:
        write(plotter, title, (0.02, 0.945), "title")
    if caption:
        write_caption(plotter, caption)


def write(plotter: pv.Plotter, text: str, place: tuple[float, float], name: str) -> None:
    """Text at a place given in fractions of the view; a text of the same name is replaced."""
    plotter.add_text(
        text, position=place, viewport=True, font_size=11, color="#222222", name=name, render=False
    )


def write_caption(plotter: pv.Plotter, text: str) -> None:
    """Below on the right, instead of the one before."""
    width = plotter.window_size[0] / plotter.shape[1]  # of one view
    write(plotter, text, (max(0.02, min(0.78, 1 - LETTER * len(text) / width)), BELOW), "caption")


def caption(result: Results, frame: Frame) -> str:
    """`t = 0.0125 s`, or that this is the reference, and how much displacements are enlarged."""
    if frame.time is None:
        return "reference"
    unit = result.time_unit
    time = f"t = {frame.time:.6g} {'' if unit.startswith('[') else unit}".strip()
    return time if frame.factor == 1 else f"{time}, displacements x {frame.factor:g}"
