# SPDX-License-Identifier: BSD-3-Clause
"""Wheels and their motion as geometry; pictures and animations as files."""

from __future__ import annotations

from pathlib import Path

import models
import numpy as np
import pytest
from engrane_post import Results
from engrane_post.cells import runs
from engrane_post.gear_mesh import WheelShape, teeth_mesh
from engrane_post.results import Element
from engrane_post.shapes import plate
from engrane_post.wheels import collect


def scene(path: Path):
    from engrane_post.scene import Scene

    return Scene(Results(path))


def test_models_far_from_the_origin_are_refused(two: Path, command, monkeypatch: pytest.MonkeyPatch) -> None:
    """Shapes have seven digits; beyond, a traceback told so."""
    monkeypatch.setattr("engrane_post.shapes.FARTHEST", 0.1)
    status, _, errors = command("picture", two, "-o", two.with_suffix(".png"))
    assert status == 1 and "times its size away from the origin" in errors


@pytest.mark.parametrize(
    ("cone", "low", "high"), [(0, 0.05 - 1.25 * 0.005, 0.055), (180, 0.045, 0.05 + 1.25 * 0.005)]
)
def test_teeth_stand_on_the_pitch_circle(cone: float, low: float, high: float) -> None:
    """Outside for a wheel, inside for a ring."""
    shape = WheelShape(0.05, 20, 0.005, np.radians(cone), 0.0, 0.02)
    points, quads, marked = teeth_mesh(shape)
    r = np.hypot(points[:, 1], points[:, 2])
    tips = r[: len(r) // 2]
    assert [tips.min(), tips.max()] == pytest.approx([low, high], rel=1e-9)
    assert quads.max() < len(points) and 0 < marked.sum() < len(marked) / 10
    edge = np.sort(np.concatenate([quads[:, [i, (i + 1) % 4]] for i in range(4)]), axis=1)
    _, count = np.unique(edge, axis=0, return_counts=True)
    assert (count == 2).all()  # a closed surface


def test_profile_shift() -> None:
    """Teeth reach from root to tip circle, as thick as the result says; a planet that meets sun and ring on
    different working pitch circles is one wheel."""
    drawn = {
        "shape": "wheel",
        "node": 3,
        "center": [1, 0, 0],
        "axis": [0, 0, 1],
        "toward": [1, 0, 0],
        "teeth": 12,
        "module": 0.003,
        "radius": 0.0188333,
        "addendum": 0.0035867,
        "dedendum": 0.0027833,
        "thickness": 0.0056,
        "pressure_angle": 26.09,
    }
    shape = WheelShape.from_drawing(drawn)
    points, _, _ = teeth_mesh(shape)
    outside = points[: len(points) // 2]
    r = np.hypot(outside[:, 1], outside[:, 2])
    assert [r.min(), r.max()] == pytest.approx([0.01605, 0.02242], rel=1e-9)
    assert 2 * shape.half_thickness(np.zeros(1))[0] == pytest.approx(0.95 * 0.0056)
    other = drawn | {"radius": 0.0185, "addendum": 0.00392, "toward": [-1, 0, 0]}
    elements = [Element(i, "GEAR", [3, 4], drawing=[d]) for i, d in enumerate((drawn, other))]
    assert len(collect(elements)) == 1
    assert len(collect([elements[0], Element(2, "GEAR", [3, 4], drawing=[other | {"teeth": 13}])])) == 2


def test_right_hand_helix() -> None:
    """A right-hand tooth turns about +axle as it goes along it, on wheels and rings alike."""
    for cone in (0.0, np.pi):
        shape = WheelShape(0.05, 20, 0.005, cone, np.radians(20), 0.02)
        low, high = shape.span()
        s = np.array([low, high])
        axial, _ = shape.place(s, np.zeros(2))
        turn = shape.twist(s)
        assert (turn[1] - turn[0]) / (axial[1] - axial[0]) == pytest.approx(np.tan(np.radians(20)) / 0.05)


@pytest.mark.parametrize("hand", [1, -1])
def test_worm(hand: int) -> None:
    """Two threads, lead angle 9.5 degrees: a closed surface between root and tip circle, no facet a large
    turn, and at any angle about the axle the crests follow each other by the axial pitch."""
    shape = WheelShape(0.0254, 2, 0.00418, 0.0, hand * np.radians(80.54), 0.03)
    points, quads, _ = teeth_mesh(shape)
    edge = np.sort(np.concatenate([quads[:, [i, (i + 1) % 4]] for i in range(4)]), axis=1)
    _, count = np.unique(edge, axis=0, return_counts=True)
    assert (count == 2).all()
    outside = points[: len(points) // 2]
    r = np.hypot(outside[:, 1], outside[:, 2])
    assert [r.min(), r.max()] == pytest.approx([0.0254 - 1.25 * 0.00418, 0.0254 + 0.00418], rel=1e-9)
    low, high = shape.span()
    s = np.array([low, high])
    lead = 2 * np.pi * (high - low) / (shape.twist(s)[1] - shape.twist(s)[0])
    assert lead / 2 == pytest.approx(hand * np.pi * 0.0254 * np.tan(np.radians(9.46)), rel=1e-3)
    assert high - low > 0.03  # beyond the wheel's width


def test_carrier(planetary: Path) -> None:
    """Arms and pins of the carrier turn with it and reach every planet."""
    s = scene(planetary)
    arms = [i for i in s.items if i.node == 3 and i.kind == "body" and not i.element]
    assert len(arms) == 3
    for item, k in zip(arms, range(3), strict=True):
        near = np.linalg.norm(item.mesh.points - s.points[10 + k], axis=1).min()
        assert near < 0.02 * s.size


def test_wheels_of_one_body_have_one_colour(tmp_path: Path) -> None:
    path = models.two_wheels(tmp_path / "two.h5")
    import json

    import h5py

    with h5py.File(path, "a") as f:
        model = json.loads(f["model"][()])
        model["elements"].append(dict(id=20, type="RIGID", nodes=[1, 2], parameters={}, drawing=[]))
        del f["model"]
        f["model"] = json.dumps(model)
    from engrane_post.scene import WHEEL_COLORS

    colors = {i.color for i in scene(path).items if i.kind == "wheel" and i.color in WHEEL_COLORS}
    assert len(colors) == 1


def _tooth_at(w, direction: np.ndarray) -> float:
    """Distance of the contact direction from the middle of a tooth, in tooth pitches, -0.5 to 0.5."""
    share = (w.angle_of(direction) - w.shape.phase) / w.shape.pitch_angle
    return (share + 0.5) % 1 - 0.5


def test_teeth_interlock(planetary: Path) -> None:
    s = scene(planetary)
    assert len(s.wheels) == 5  # the sun and the ring once, three planets
    sun, ring = (next(w for w in s.wheels if w.node == n) for n in (1, 2))
    for node in (10, 11, 12):
        planet = next(w for w in s.wheels if w.node == node)
        d = planet.center / np.linalg.norm(planet.center)
        assert abs(abs(_tooth_at(sun, d)) + abs(_tooth_at(planet, -d)) - 0.5) < 1e-9
        assert abs(abs(_tooth_at(planet, d)) + abs(_tooth_at(ring, d)) - 0.5) < 1e-9


def test_shapes_follow_their_nodes(two: Path) -> None:
    s = scene(two)
    frame = s.result.frame(4)
    t = s.transform(1, frame)
    angle = models.SPEED * frame.time
    assert t[:3, :3] @ [1, 0, 0] == pytest.approx([np.cos(angle), np.sin(angle), 0], abs=1e-12)
    assert s.transform(0, frame) == pytest.approx(np.eye(4))


def test_bevel_teeth_share_the_apex(bevel: Path) -> None:
    """The tooth lines of both wheels run to the point where their axles cross."""
    for w in scene(bevel).wheels:
        apex = np.array([0.0, 1.0, 0.0])
        s = np.array([0.0, 0.5])
        axial, radial = w.shape.place(s, np.zeros(2))
        p = w.center + np.outer(axial, w.frame[:, 0]) + np.outer(radial, w.frame[:, 1])
        assert np.linalg.norm(np.cross(apex - p[0], p[1] - p[0])) < 1e-9


def test_cam_plate() -> None:
    # an L of 3 squares, one thick: caps of the polygon's area, also across its notch, and a wall round it
    outline = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [1, 1, 0], [1, 2, 0], [0, 2, 0]], float)
    wall = plate(outline, np.array([0, 0, 2.0]), 0.5, hollow=True)
    whole = plate(outline, np.array([0, 0, 2.0]), 0.5, hollow=False)
    assert wall.area == pytest.approx(8 * 0.5)
    assert whole.area == pytest.approx(8 * 0.5 + 2 * 3)
    assert np.ptp(whole.points, axis=0) == pytest.approx([2, 2, 0.5])


def test_disc(tmp_path: Path) -> None:
    """A ring of the sizes that the result gives, which moves with its node."""
    drawn = dict(shape="disc", node=1, center=[1, 0, 0.5], axis=[0, 0, 2], outer=0.4, inner=0.1, width=0.06)
    elements = [dict(id=1, type="INERTIA", nodes=[1], parameters={}, drawing=[drawn])]
    path = models.write(
        tmp_path / "disc.h5", {1: (1.0, 0.0, 0.0)}, elements, np.zeros(1), np.zeros((1, 1, 3))
    )
    s = scene(path)
    ring, spots = s.items
    r = np.hypot(ring.mesh.points[:, 0] - 1, ring.mesh.points[:, 1])
    assert [r.min(), r.max()] == pytest.approx([0.05, 0.2])
    assert ring.mesh.bounds[4:] == pytest.approx([0.47, 0.53])
    assert ring.node == spots.node == 1 and ring.kind == spots.kind == "mass"


def test_topology() -> None:
    data = np.array([1, 1, 0, 2, 3, 0, 1, 2, 4, 0, 1, 2, 5, 0, 1, 2, 3, 36, 0, 1, 2, 3, 4, 5])

    def found(data: np.ndarray) -> list:
        return [(run.code, run.first, run.nodes.tolist()) for run in runs(data)]

    assert found(data) == [
        (1, 0, [[0]]),
        (2, 1, [[0, 1, 2]]),
        (4, 2, [[0, 1, 2]]),
        (5, 3, [[0, 1, 2, 3]]),
        (36, 4, [[0, 1, 2, 3, 4, 5]]),
    ]
    assert found(data[:5]) == [(1, 0, [[0]])]  # cut in the middle of a cell
    # many of a kind, whose points may look like codes, and lines of different length
    many = np.concatenate(
        [[4, 4, 4, 4]] * 50 + [[5, 4, 4, 4, 4]] * 3 + [[2, 2, 4, 5]] * 20 + [[2, 3, 2, 2, 2]]
    )
    assert [(r.code, r.first, r.nodes.shape) for r in runs(many)] == [
        (4, 0, (50, 3)),
        (5, 50, (3, 4)),
        (2, 53, (20, 2)),
        (2, 73, (1, 3)),
    ]


def test_picture(two: Path, bevel: Path, command, tmp_path: Path) -> None:
    out = tmp_path / "a.png"
    for words in (
        (two, "--both"),
        (two, "--reference", "--view", "back"),
        (two, "--view=-1,0.5,2"),
        (bevel, "--time", "0.4"),
    ):
        status, _, err = command("picture", *words, "--size", "320x240", "-o", out)
        assert (status, err) == (0, "")
        from PIL import Image

        image = np.asarray(Image.open(out).convert("RGB"))
        assert image.shape == (240, 320, 3)
        saturation = image.max(axis=-1).astype(int) - image.min(axis=-1)
        assert (saturation > 60).mean() > 0.01  # something coloured is there


@pytest.mark.parametrize("size", ["900x480", "600x300", "1400x1000"])
def test_the_caption_covers_no_model(tmp_path: Path, command, monkeypatch, size: str) -> None:
    """A plate as broad as the caption, which fills the height of the picture."""
    from engrane_post import view
    from PIL import Image

    points = {i + 1: p for i, p in enumerate([(0, 0, 0), (2, 0, 0), (2, 1.1, 0), (0, 1.1, 0)])}
    path = models.write(
        tmp_path / "m.h5",
        points,
        [dict(id=1, type="MEMBRANE", nodes=[1, 2, 3, 4])],
        np.array([0.0]),
        np.zeros((1, 4, 3)),
        cells=[(5, [0, 1, 2, 3], 1)],
    )

    def drawn() -> np.ndarray:
        words = ("--view", "front", "--deformed", "100", "--size", size, "-o", tmp_path / "m.png")
        assert command("picture", path, *words)[0] == 0
        return np.asarray(Image.open(tmp_path / "m.png").convert("RGB")).astype(int)

    with_text = drawn()
    monkeypatch.setattr(view, "caption", lambda *_: "")
    without = drawn()
    letters = np.abs(with_text - without).max(axis=-1) > 30
    assert letters.sum() > 100
    background = np.abs(without - without[:, :1]).max(axis=-1) <= 6
    assert background[letters].all()


def test_membrane_and_beam(tmp_path: Path, command) -> None:
    points = {i + 1: p for i, p in enumerate([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0.5)])}
    elements = [dict(id=1, type="MEMBRANE", nodes=[1, 2, 3, 4]), dict(id=2, type="BEAM", nodes=[2, 5])]
    path = models.write(
        tmp_path / "m.h5",
        points,
        elements,
        np.array([0.0]),
        np.zeros((1, 5, 3)),
        cells=[(5, [0, 1, 2, 3], 1), (2, [1, 4], 2)],
    )
    assert command("picture", path, "--size", "200x150", "-o", tmp_path / "m.png")[0] == 0


def test_animation(two: Path, command, tmp_path: Path) -> None:
    gif = tmp_path / "a.gif"
    status, out, err = command("animate", two, "--every", "4", "--size", "160x120", "--fps", "10", "-o", gif)
    assert (status, err) == (0, "")
    assert "wrote 3 frames" in out
    from PIL import Image

    with Image.open(gif) as image:
        assert image.n_frames == 3
    assert command("animate", two, "--every", "8", "--size", "100x80", "-o", tmp_path / "s_%02d.png")[0] == 0
    series = sorted(tmp_path.glob("s_*.png"))
    assert [p.name for p in series] == ["s_00.png", "s_01.png"]
    assert series[0].read_bytes() != series[1].read_bytes(), "each is a picture of its own time"


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("picture", "two", "--frame", "99"), "there is no frame 99"),
        (("picture", "two", "--size", "big"), "is not a size"),
        (("picture", "two", "--view", "sideways"), "is no direction"),
        (("picture", "two", "--view", "0,0,0"), "is no direction"),
        (("gallery", "no_such_deck"), "The gallery has no no_such_deck"),
        (("picture", "two", "-o", "a.pdf"), "Cannot write a.pdf"),
        (("animate", "two", "--from", "9"), "no frames between"),
        (("animate", "two", "--fps", "0"), "--fps"),
        (("animate", "none"), "no frames"),
        (("picture", "none"), "--reference"),
    ],
)
def test_picture_errors(two: Path, command, tmp_path: Path, monkeypatch, words, sentence) -> None:
    monkeypatch.chdir(tmp_path)
    models.write(tmp_path / "none.h5", {1: (0, 0, 0)}, [])
    status, _, err = command(*words)
    assert status == 1
    assert sentence in err and "Traceback" not in err


def test_gallery(command, tmp_path: Path, monkeypatch) -> None:
    """Every picture of docs/gallery.md has its deck, and is in the page."""
    from engrane_post import gallery

    page = (gallery.ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
    for shot in gallery.SHOTS:
        assert (gallery.ROOT / "decks" / shot.folder / f"{shot.deck}.dat").is_file()
        assert f"figures/gallery/{shot.deck}.png" in page and f"decks/{shot.folder}/{shot.deck}.dat" in page
        picture = gallery.ROOT / "docs" / "figures" / "gallery" / f"{shot.deck}.png"
        assert 5_000 < picture.stat().st_size < 150_000
    # Drawing itself, with a result that is newer than everything.
    models.two_wheels(tmp_path / "idler.h5")
    monkeypatch.setenv("ENGRANE", __file__)
    out = tmp_path / "pictures"
    status, text, err = command("gallery", "idler", "--results", tmp_path, "-o", out)
    assert (status, err) == (0, "") and "running" not in text
    assert (out / "idler.png").read_bytes()[:4] == b"\x89PNG"
    (tmp_path / "idler.h5").unlink()
    monkeypatch.setenv("ENGRANE", "/no/program")
    assert (
        "There is no program /no/program" in command("gallery", "idler", "--results", tmp_path, "-o", out)[2]
    )


@pytest.mark.parametrize("helix", [0.0, 15.0, -15.0])
def test_rack(tmp_path: Path, helix: float) -> None:
    """A bar as long as the pinion travels, with a gap where the pinion has a tooth, all along the
    contact line."""
    radius, module = 0.05, 0.005 * np.cos(np.radians(helix))
    elements = [
        dict(
            id=1,
            type="RACK",
            nodes=[1, 2],
            drawing=[
                models.wheel(1, (0, 0, 0), (0, 0, 1), (0, -1, 0), radius, 20, module, 0.03, 0, helix),
                dict(
                    shape="rack",
                    node=2,
                    center=[0, -radius, 0],
                    direction=[1, 0, 0],
                    toward=[0, 1, 0],
                    module=module,
                ),
            ],
        )
    ]
    shift = np.zeros((3, 2, 3))
    shift[:, 1, 0] = 0, -0.1, -0.3
    path = models.write(
        tmp_path / "rack.h5",
        {1: (0.0, 0.0, 0.0), 2: (0.0, -0.1, 0.0)},
        elements,
        np.linspace(0, 1, 3),
        shift,
        np.zeros((3, 2, 3)),
    )
    s = scene(path)
    (bar,) = [i.mesh for i in s.items if i.node == 2]
    assert (
        bar.bounds[0] < -0.05 and bar.bounds[1] > 0.35
    )  # where the contact has been, in the rack's place at the start
    (pinion,) = s.wheels
    tip = bar.points[bar.points[:, 1] > bar.bounds[3] - 1e-9]
    pitch = np.pi * 2 * radius / 20
    for z in (-0.015, 0.015):
        tooth = pinion.shape.phase + pinion.shape.twist(np.array([z]))[0]  # at the contact, turned about +z
        x = np.sort(tip[abs(tip[:, 2] - z) < 1e-9][:, 0])
        middles = (x[0::2] + x[1::2]) / 2
        gap = (middles - radius * tooth) / pitch % 1
        assert gap == pytest.approx(0.5, abs=1e-6)


def joints_model(path: Path) -> Path:
    """A crank with a ball joint, a rod, a block on a rail, a pin in a slot, a spring to the ground."""

    def joint(number: int, kind: str, nodes: list[int], drawing: list | None = None, **parameters) -> dict:
        return dict(id=number, type=kind, nodes=nodes, parameters=parameters, drawing=drawing or [])

    def axis(node: int, center: list, direction: list) -> list:
        return [dict(shape="axis", node=node, center=center, axis=direction)]

    elements = [
        joint(1, "HINGE", [0, 1], axis(1, [0, 0, 0], [0, 0, 1]), AXIS=[0, 0, 1]),
        joint(2, "SPHERICAL", [1, 2], AT=[0.2, 0, 0]),
        joint(3, "DISTANCE", [0, 2], FROM=[0.6, 0.5, 0], TO=[0.6, 0, 0]),
        joint(4, "PRISMATIC", [0, 3], axis(3, [1, 0, 0], [1, 0, 0]), AXIS=[1, 0, 0]),
        joint(5, "POINT_PLANE", [0, 2], axis(2, [0.2, 0, 0], [0, 1, 0]), AXIS=[0, 1, 0], AT=[0.2, 0, 0]),
        joint(6, "SPRING", [0, 3], [dict(shape="coil", points=[0, 3])], AT=[1.5, 0, 0.2]),
    ]
    times = np.linspace(0, 1, 3)
    shift, turn = np.zeros((3, 3, 3)), np.zeros((3, 3, 3))
    turn[:, 0, 2] = turn[:, 1, 2] = times  # the crank and node 2 turn about the origin
    shift[:, 1, 0] = 0.4 * (np.cos(times) - 1)
    shift[:, 1, 1] = 0.4 * np.sin(times)
    shift[:, 2, 0] = -0.3 * times
    places = {1: (0.0, 0.0, 0.0), 2: (0.4, 0.0, 0.0), 3: (1.0, 0.0, 0.0)}
    return models.write(path, places, elements, times, shift, turn)


def test_joints(tmp_path: Path) -> None:
    s = scene(joints_model(tmp_path / "joints.h5"))
    from engrane_post.scene import GROUND, SPRING

    def reach(item, x: list[float]) -> float:
        return float(np.linalg.norm(item.mesh.points - np.array(x), axis=1).min())

    # the crank reaches from its node to the ball joint, and so does node 2's body from the other side
    for node in (1, 2):
        assert min(reach(i, [0.2, 0, 0]) for i in s.items if i.node == node) < 0.02 * s.size
    # the rod is held at its own ends, not at the nodes, and follows the body that carries one of them
    frame = s.result.frame(2)
    (rod,) = [i for i in s.items if i.remake and i.color != SPRING]
    moved = rod.remake(s.positions(frame))
    end = np.array([0.6 * np.cos(1), 0.6 * np.sin(1), 0])
    for x in ([0.6, 0.5, 0], end):
        assert np.linalg.norm(moved.points - x, axis=1).min() < 0.01 * s.size
    # the rail is as long as the block travels
    rails = [i for i in s.items if i.color == GROUND and i.node == 0 and np.ptp(i.mesh.points[:, 0]) > 0.25]
    assert any(i.mesh.bounds[0] < 0.7 and i.mesh.bounds[1] > 1.0 for i in rails)
    # spring and rod stand on blocks
    for x in ([1.5, 0, 0.2], [0.6, 0.5, 0]):
        assert any(i.color == GROUND and np.linalg.norm(np.array(i.mesh.center) - x) < 1e-6 for i in s.items)
    # bodies have colours of their own
    assert len({i.color for i in s.items if i.node in (1, 2, 3)}) >= 3


def test_joints_picture(tmp_path: Path, command) -> None:
    path = joints_model(tmp_path / "joints.h5")
    status, _, err = command("picture", path, "--view", "1,1,1", "--up", "z", "-o", tmp_path / "a.png")
    assert (status, err) == (0, "")
    assert (tmp_path / "a.png").stat().st_size > 5000
