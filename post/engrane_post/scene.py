# SPDX-License-Identifier: BSD-3-Clause
"""Builds and moves the pictures of a model: every shape is a surface fixed to a node, or is drawn anew
between two nodes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from . import belts, cells, linkage, loads, shapes
from .graphics import pv
from .results import Element, Frame, Results
from .wheels import collect

WHEEL_COLORS = ("#6d8fb5", "#c58f4a", "#7aa06c", "#a97ba8", "#b5695c", "#5f9ea0")
MARK, DARK, STEEL, BODY = "#d1571b", "#3c4650", "#8d979f", "#5d6b78"
SPRING, ARROW, GROUND, CELL = "#2a8a4a", "#c02a2a", "#70665a", "#86a8c8"
BAND = "#2f3338"


# What a drawn thing is, from the `shape` that the result gives it.
KIND_OF = {
    "wheel": "wheel",
    "rack": "rack",
    "plate": "cam",
    "roller": "cam",
    "body": "body",
    "axis": "joint",
    "line": "link",
    "beam": "beam",
    "coil": "spring",
    "mass": "mass",
    "disc": "mass",
    "arrow": "load",
}


@dataclass
class Item:
    """A drawn thing: `node` moves it rigidly, or `remake` gives its surface from the nodes' positions, always
    with as many points. `element` is 0 for what belongs to no single one."""

    mesh: pv.PolyData
    color: str
    node: int = 0
    remake: Callable[[dict[int, np.ndarray]], pv.PolyData] | None = None
    smooth: bool = True
    opacity: float = 1.0
    edges: bool = False
    kind: str = ""
    element: int = 0
    cells: np.ndarray | None = None  # of the mesh: for each face the cell whose values colour it
    points: np.ndarray | None = None  # and the points that are seen
    arrow: loads.Arrow | None = None  # which `node` moves, but does not turn


class Scene:
    """All items of a result, and where its nodes are at a frame."""

    def __init__(self, result: Results) -> None:
        self.result = result
        self.loads = loads.Loads(result)
        self.ids = [int(i) for i in result.node_ids]
        self.row = {n: i for i, n in enumerate(self.ids)}
        self.points = {n: result.points[i] for n, i in self.row.items()}
        self.wheels = collect(result.elements)
        self.meshed = {e.nodes[0] for e in result.elements if e.type.upper() in ("MEAN_LINK", "RIGID_LINK")}
        self.items: list[Item] = []
        self.carried: dict[int, tuple[int, np.ndarray]] = {}
        joints = [j for j in (linkage.joint(self, e) for e in result.elements) if j]
        self.size = self._size([place for j in joints for _, place in j.ends()] + self._rims())
        shapes.refuse_far_places(result.path, result.points, self.size)
        self.link_slots: dict[int, int] = {}
        self.bodies: dict[int, int] = {}
        for element in result.elements:
            if element.type.upper() == "RIGID":
                first = self.bodies.get(element.nodes[0], element.nodes[0])
                self.bodies.update({n: first for n in element.nodes if n})
        self._wheels()
        drawn = {j.element.id for j in joints}
        own = {j.element.id for j in joints if j.kind != "pin"}
        for element in result.elements:
            if element.drawing:
                drawn.add(element.id)
            if element.type.upper() == "BELT" and self._belt(element):
                continue
            for d in element.drawing:
                if d.get("shape") != "wheel" and element.id not in own:
                    first = len(self.items)
                    self._shape(element, d)
                    self._name(first, KIND_OF.get(d.get("shape", ""), "other"), element.id)
        self._linkage(joints)
        self._cells(drawn)
        self._grounds()

    def corners(self, frames: list[Frame]) -> np.ndarray:
        """Points (k x 3) that hold the model at all the frames: nodes, rims of the wheels, boxes of the
        rest."""
        out = [self.result.points + f.displacement for f in frames]
        few = frames[:: max(1, len(frames) // 40)]
        for pose, points in self._outlines():
            for f in few:
                t = pose(f)
                out.append(points @ t[:3, :3].T + t[:3, 3])
        return np.concatenate(out) if out else np.zeros((1, 3))

    def limits(self, field: str, frames: Iterable[Frame]) -> tuple[float, float] | None:
        """Of the colours of a field, what all the frames share; nothing without a field."""
        if not field:
            return None
        drawn = [item for item in self.items if item.cells is not None]
        ends = [np.zeros(0)]
        for frame in frames:
            for item in drawn:
                seen = colours(self.result, field, frame, item)[1]
                seen = seen[np.isfinite(seen)]
                ends.append(np.array([seen.min(), seen.max()]) if len(seen) else seen)
        return limits_of(ends)

    def _outlines(self) -> Iterator[tuple[Callable[[Frame], np.ndarray], np.ndarray]]:
        """(pose, reference points) of everything that moves with a node."""
        turn = np.arange(0, 2 * np.pi, np.pi / 12)
        for w in self.wheels:
            reach = w.shape.radius + (3.2 if w.shape.ring else 1.0) * w.shape.module
            circle = reach * (np.outer(np.cos(turn), w.frame[:, 1]) + np.outer(np.sin(turn), w.frame[:, 2]))
            half = 0.5 * min(w.shape.width, w.shape.radius) * w.frame[:, 0]
            yield partial(self.transform, w.node), w.center + np.r_[circle - half, circle + half]
        for node, place in self.carried.values():
            yield partial(self.transform, node), place[None, :]
        for item in self.items:
            if item.remake is None and item.kind != "wheel":
                x = np.reshape(item.mesh.bounds, (3, 2))
                box = np.array([[a, b, c] for a in x[0] for b in x[1] for c in x[2]])
                yield partial(self.pose, item), box

    def _discs(self) -> list[dict[str, Any]]:
        return [d for e in self.result.elements for d in e.drawing if d.get("shape") == "disc"]

    def _rims(self) -> list[np.ndarray]:
        """Ends of two diameters of each disc."""
        out = []
        for d in self._discs():
            for side in shapes.square_to(np.asarray(d["axis"], float)):
                reach = 0.5 * float(d["outer"]) * side
                out += [np.asarray(d["center"], float) + reach, np.asarray(d["center"], float) - reach]
        return out

    def _size(self, places: list[np.ndarray]) -> float:
        corners = np.concatenate([self.corners([self.result.reference()]), np.reshape(places, (-1, 3))])
        size = float(np.linalg.norm(np.ptp(corners, axis=0)))
        return size if size > 0 else 1.0

    def transform(self, node: int, frame: Frame) -> np.ndarray:
        """4 x 4 matrix that carries reference positions fixed to a node to the frame; identity for the
        ground."""
        t = np.eye(4)
        if node in self.row:
            i = self.row[node]
            r = Rotation.from_rotvec(frame.rotation[i]).as_matrix()
            t[:3, :3] = r
            t[:3, 3] = self.points[node] + frame.displacement[i] - r @ self.points[node]
        return t

    def pose(self, item: Item, frame: Frame) -> np.ndarray:
        """The same for an item, without `remake`."""
        carrier = self.transform(item.node, frame)
        if item.arrow is None:
            return carrier
        turn = self.transform(item.arrow.holder, frame)
        return item.arrow.pose(carrier, turn, self.loads.sense(item.arrow, frame))

    def positions(self, frame: Frame) -> dict[int, np.ndarray]:
        """Where the nodes are, and the points that bodies carry."""
        out = {n: self.points[n] + frame.displacement[i] for n, i in self.row.items()}
        for name, (node, place) in self.carried.items():
            out[name] = (self.transform(node, frame) @ np.r_[place, 1.0])[:3]
        return out

    def _wheels(self) -> None:
        """Wheels of one body have one colour."""
        slots: dict[int, int] = {}
        for w in self.wheels:
            color = WHEEL_COLORS[
                slots.setdefault(self.bodies.get(w.node, w.node), len(slots)) % len(WHEEL_COLORS)
            ]
            for mesh, tint in shapes.wheel(w, color, MARK, DARK):
                self.items.append(Item(mesh, tint, w.node, smooth=False, kind="wheel", element=w.element.id))

    def _name(self, first: int, kind: str, element: int = 0) -> None:
        """Says what the items from `first` on are, where that has not been said."""
        for item in self.items[first:]:
            item.kind = item.kind or kind
            item.element = item.element or element

    def _belt(self, element: Element) -> bool:
        """Pulleys with the belt round them; False when the result does not say how large they are."""
        radii = [float(r) for r in element.parameters.get("R") or []]
        known = [n == 0 or n in self.row for n in element.nodes]
        if len(radii) != 2 or min(radii) <= 0 or len(known) != 2 or not all(known):
            return False
        axis = shapes.unit(np.asarray(element.parameters.get("AXIS") or [0, 0, 1], float))
        centers = [self.points.get(n, np.zeros(3)) for n in element.nodes]
        gap = centers[1] - centers[0]
        if np.linalg.norm(gap - axis * (axis @ gap)) <= 1e-9 * self.size:
            return False
        first = len(self.items)
        for node, center, radius in zip(element.nodes, centers, radii, strict=True):
            color = WHEEL_COLORS[self.bodies.get(node, node) % len(WHEEL_COLORS)]
            solid, spots = belts.pulley(center, axis, gap, radius, min(radii))
            self.items += [Item(mesh, color, node, smooth=False, kind="pulley") for mesh in solid]
            if spots is not None:
                self.items.append(Item(spots, DARK, node, smooth=False, kind="pulley"))
        # the axis turns with the first pulley
        a, b = (self._carried(n, c) for n, c in zip(element.nodes, centers, strict=True))
        tip = self._carried(element.nodes[0], centers[0] + axis)
        crossed = bool(element.parameters.get("CROSSED"))
        self._flexible(lambda p: belts.belt(p[a], p[b], p[tip] - p[a], (radii[0], radii[1]), crossed), BAND)
        self.items[-1].smooth = False
        self._name(first, "belt", element.id)
        return True

    def _shape(self, element: Element, d: dict[str, Any]) -> None:
        """One entry of `drawing`; a shape unknown to this version or without its nodes is left out."""
        kind, size = d.get("shape"), self.size
        nodes = [int(n) for n in (d.get("points") or d.get("nodes") or [])]
        node = int(d.get("node", 0))
        axis = np.asarray(d.get("axis", [0, 0, 1]), float)
        center = np.asarray(d["center"], float) if "center" in d else self.points.get(node, np.zeros(3))
        if kind in ("line", "coil") and len(nodes) >= 2:
            ends = self._ends(nodes[:2], element)
            if ends is None:
                return
            make = shapes.coil if kind == "coil" else shapes.tube
            radius = size * (0.016 if kind == "coil" else 0.0055)
            self._flexible(lambda p: make(ends(p), radius), SPRING if kind == "coil" else BODY)
        elif kind == "beam" and all(n in self.row for n in nodes):
            self._beam(nodes, d)
        elif kind == "body" and nodes:
            known = [n for n in nodes if n in self.row]
            if len(known) > 1:
                mesh = shapes.star([self.points[n] for n in known], size * 0.009)
                self.items.append(Item(mesh, self._link_color(known[0]), known[0]))
            elif known:
                self.items.append(
                    Item(shapes.box(self.points[known[0]], size * 0.03), BODY, known[0], smooth=False)
                )
        elif kind == "rack":
            self._rack(element, d)
        elif kind == "axis":
            length, radius = self.axle(node, element, center, axis)
            self.items.append(Item(shapes.axle(center, axis, length, radius), STEEL, node))
        elif kind == "plate":
            outline = np.asarray(d["outline"], float)
            thick = 0.2 * float(np.max(np.ptp(outline, axis=0)))
            mesh = shapes.plate(outline, axis, thick, bool(d.get("hollow")))
            self.items.append(Item(mesh, WHEEL_COLORS[node % len(WHEEL_COLORS)], node, smooth=False))
        elif kind == "roller":
            radius = float(d["radius"])
            self.items.append(Item(shapes.roller(center, axis, radius, 1.5 * radius), STEEL, node))
        elif kind == "disc":
            radii = 0.5 * float(d["inner"]), 0.5 * float(d["outer"])
            ring, spots = shapes.disc(center, axis, radii, float(d["width"]))
            color = WHEEL_COLORS[self.bodies.get(node, node) % len(WHEEL_COLORS)]
            self.items += [Item(mesh, c, node, smooth=False) for mesh, c in ((ring, color), (spots, DARK))]
        elif kind == "mass" and node in self.row:
            self.items.append(Item(shapes.ball(self.points[node], size * 0.016), DARK, node))
        elif kind == "arrow":
            holder, gap = int(d.get("holder", node)), None
            couple = bool(d.get("couple")) or element.type.upper() == "TORQUE"
            if couple:
                radius, gap = self._clear_of_wheels(center)
                mesh = shapes.turn_arrow(center, axis, radius, gap)
                # A moment between arm and wheel goes with the arm, so that its gap stays at the mesh.
                bare = [n for n in element.nodes if n in self.row and all(w.node != n for w in self.wheels)]
                if gap is not None and bare and holder:
                    node = holder = bare[0]
            else:
                mesh = shapes.arrow(center, axis, size * 0.14)
            arrow = loads.Arrow(element, center, axis, holder, couple, gap)
            self.items.append(Item(mesh, ARROW, node, arrow=arrow))

    def _clear_of_wheels(self, center: np.ndarray) -> tuple[float, np.ndarray | None]:
        """Radius of a torque's arrow, around the wheel that sits there unless that is a large one, and the
        direction in which the wheel meshes."""
        radius, gap = 0.06 * self.size, None
        for w in self.wheels:
            tip = 1.2 * (w.shape.radius + w.shape.module)
            if np.linalg.norm(w.center - center) < 1e-3 * w.shape.radius and tip < 0.15 * self.size:
                radius, gap = max(radius, tip), w.frame[:, 1]
        for d in self._discs():
            rim = 0.5 * float(d["outer"])
            if np.linalg.norm(np.asarray(d["center"]) - center) < 1e-3 * rim and rim < 0.2 * self.size:
                radius = max(radius, 1.25 * rim)
        return radius, gap

    def _flexible(self, remake: Callable[[dict[int, np.ndarray]], pv.PolyData], color: str) -> None:
        self.items.append(Item(remake(self.points), color, remake=remake))

    def _ends(
        self, nodes: list[int], element: Element
    ) -> Callable[[dict[int, np.ndarray]], np.ndarray] | None:
        """Both ends of a line or spring. A torsion spring joins nodes on one spot: it is drawn along its
        axis."""
        known = [n for n in nodes if n in self.row]
        if not known:
            return None
        if len(known) == 1 and "AT" in element.parameters:
            anchor = np.asarray(element.parameters["AT"], float)
            known.append(self._carried(0, anchor))
            self.items.append(Item(linkage.foot(self, anchor), GROUND, smooth=False, kind="ground"))
        axis = np.asarray(element.parameters.get("AXIS", [0, 0, 1]), float).ravel()[:3]
        axis = axis / (np.linalg.norm(axis) or 1.0) if len(axis) == 3 else np.array([0, 0, 1.0])
        if len(known) == 1:
            anchor = self.points[known[0]] - axis * 0.1 * self.size
            return lambda p: np.stack([anchor, p[known[0]]])
        a, b = known
        if np.linalg.norm(self.points[a] - self.points[b]) < 1e-6 * self.size:
            return lambda p: np.stack([p[a] - axis * 0.04 * self.size, p[b] + axis * 0.04 * self.size])
        return lambda p: np.stack([p[a], p[b]])

    def axle(self, node: int, element: Element, center: np.ndarray, axis: np.ndarray) -> tuple[float, float]:
        """Length and radius of a hinge's axis: through the wheel that sits on it, if any."""
        radius, length = 0.008 * self.size, (0.12 if self.wheels else 0.07) * self.size
        for w in self.wheels:
            near = np.linalg.norm(w.center - center) < 1e-3 * w.shape.radius
            if near and (w.node == node or w.node in element.nodes) and not w.shape.ring:
                radius = min(max(radius, 0.07 * w.shape.radius), 0.12 * w.shape.radius)
                length = max(length, 1.5 * min(w.shape.width, w.shape.radius))
        return length, radius

    def _rack(self, element: Element, d: dict[str, Any]) -> None:
        """A bar long enough for all that the pinion travels along it, with a gap where the pinion has a
        tooth."""
        wheels = [e for e in element.drawing if e.get("shape") == "wheel"]
        if not wheels:
            return
        pinion, center = int(wheels[0].get("node", 0)), np.asarray(d["center"], float)
        travel, normal = (shapes.unit(np.asarray(d[k], float)) for k in ("direction", "toward"))
        normal = shapes.unit(normal - travel * (normal @ travel))
        middle = np.asarray(wheels[0]["center"], float)
        normal = normal if normal @ (middle - center) >= 0 else -normal
        node, module = int(d.get("node", 0)), float(d["module"])
        places = []
        count = len(self.result.frame_times)
        for i in range(0, count, max(1, count // 200)):
            frame = self.result.frame(i)
            back = np.linalg.inv(self.transform(node, frame))
            now = self.transform(pinion, frame) @ np.r_[middle, 1.0]
            places.append(float(((back @ now)[:3] - middle) @ travel))
        radius = float(wheels[0]["radius"])
        span = (min([0.0, *places]) - radius, max([0.0, *places]) + radius)
        for w in self.wheels:
            if w.node == pinion and np.linalg.norm(w.center - middle) < 1e-6 * radius:
                axle, toward = w.frame[:, 0], shapes.unit(center - middle)
                rolled = float(
                    np.cross(axle, toward) @ travel
                )  # 1 or -1: the way a tooth goes at the contact
                slant = np.tan(w.shape.helix) * rolled * float(np.cross(travel, normal) @ axle)
                pitch = np.pi * module * np.hypot(1, slant)
                offset = (w.shape.phase - w.angle_of(toward)) / w.shape.pitch_angle
                shift = pitch * (0.5 + offset * rolled)
                mesh = shapes.rack(center, travel, normal, module, w.shape.width, span, shift, slant)
                color = WHEEL_COLORS[(len(self.wheels) + 1) % len(WHEEL_COLORS)]
                self.items.append(Item(mesh, color, node, smooth=False))
                return

    def _linkage(self, joints: list[linkage.Joint]) -> None:
        """Joints and the links between them. What lies on the ground is marked by its colour."""
        for node, mesh in linkage.links(self, joints):
            self.items.append(Item(mesh, self._link_color(node), node, smooth=False, kind="body"))
        for j in joints:
            first = len(self.items)
            own, other = (self._link_color(n) if n else GROUND for n in (j.a, j.b))
            if j.kind in ("rail", "plate"):
                base, rider = (linkage.rail if j.kind == "rail" else linkage.plate)(self, j)
                self.items.append(Item(base, own if j.a == 0 else STEEL, j.a, smooth=False))
                self.items.append(Item(rider, other, j.b, smooth=False))
            elif j.kind == "cross":
                for mesh, node in zip(linkage.cross(self, j), (j.a, j.b), strict=True):
                    self.items.append(Item(mesh, STEEL, node))
            elif j.kind == "ball":
                self.items.append(Item(shapes.ball(j.place_a, 0.016 * self.size), STEEL, j.a or j.b))
            elif j.kind == "rod":
                self._rod(j)
            if j.kind in ("ball", "cross", "rod", "weld"):
                for node, place in j.ends():
                    if node == 0:
                        self.items.append(
                            Item(linkage.foot(self, place), GROUND, smooth=False, kind="ground")
                        )
            self._name(first, "joint", j.element.id)

    def _rod(self, j: linkage.Joint) -> None:
        """A rod between points that its bodies carry, and balls at its ends."""
        ends = [self._carried(node, place) for node, place in j.ends()]
        self._flexible(lambda p: shapes.tube(np.stack([p[e] for e in ends]), 0.006 * self.size), STEEL)
        for node, place in j.ends():
            self.items.append(Item(shapes.ball(place, 0.011 * self.size), STEEL, node))

    def _beam(self, nodes: list[int], d: dict[str, Any]) -> None:
        """A piece of a beam: its section as nodes carry it, or a round bar where the deck tells no shape."""
        outline = np.asarray(d.get("outline", []), float).reshape(-1, 2)
        if not len(outline):
            line = [list(range(len(nodes)))]
            self._flexible(
                lambda p: shapes.tubes(np.array([p[n] for n in nodes]), line, 0.006 * self.size), BODY
            )
            return
        axes = np.asarray(d["axes"], float).reshape(len(nodes), 2, 3)
        rings = [
            [self._carried(n, self.points[n] + corner) for corner in outline @ across]
            for n, across in zip(nodes, axes, strict=True)
        ]
        lid = shapes.triangles(np.array([self.points[c] for c in rings[0]]))
        self._flexible(lambda p: shapes.loft(np.array([[p[c] for c in ring] for ring in rings]), lid), BODY)
        self.items[-1].smooth = False

    def _carried(self, node: int, place: np.ndarray) -> int:
        """A name, among those of nodes, for a point that a body or the ground carries."""
        name = -1 - len(self.carried)
        self.carried[name] = (node, np.asarray(place, float))
        self.points[name] = self.carried[name][1]
        return name

    def _link_color(self, node: int) -> str:
        """Links of one body have one colour, where no wheels take the colours."""
        if self.wheels:
            return BODY
        body = self.bodies.get(node, node)
        slot = self.link_slots.setdefault(body, len(self.link_slots))
        return linkage.LINK_COLORS[slot % len(linkage.LINK_COLORS)]

    def _cells(self, drawn: set[int]) -> None:
        """Cells of elements that bring no drawing (beams, membranes); surfaces and the outside of solids
        always."""
        topology = self.result.dataset("mesh/topology")
        if topology is None:
            return
        owner = self.result.dataset("mesh/cell_elements")
        found = cells.runs(topology)
        lines = []
        for run in (r for r in found if r.code in (2, 34)):
            for number, nodes in enumerate(
                (run.nodes[:, :2] if run.code == 34 else run.nodes).tolist(), run.first
            ):
                mine = owner is not None and number < len(owner) and int(owner[number]) in drawn
                if not mine and len(set(nodes)) > 1:
                    lines.append(nodes)
        faces = cells.outer_faces(found, np.array([self.row[n] for n in self.ids], int))
        order, first = self.ids, len(self.items)
        if lines:
            self._flexible(
                lambda p: shapes.tubes(np.array([p[n] for n in order]), lines, 0.006 * self.size), BODY
            )
        if faces:
            tables, owners = [f for f, _ in faces], [o for _, o in faces]
            self._flexible(lambda p: shapes.surface(np.array([p[n] for n in order]), tables), CELL)
            self.items[-1].edges = True
            self.items[-1].cells = np.concatenate(owners)
            self.items[-1].points = np.unique(np.concatenate([t.ravel() for t in tables]))
            self.items[-1].smooth = False
        self._name(first, "cell")
        if faces:
            for row in loads.supported(self.result, self.items[-1].points):
                mesh = shapes.box(self.result.points[row], 0.014 * self.size)
                self.items.append(Item(mesh, GROUND, self.ids[row], smooth=False, kind="support"))

    def _grounds(self) -> None:
        """A small stand where an element is tied to the ground."""
        done: list[np.ndarray] = []
        for element in self.result.elements:
            if 0 not in element.nodes:
                continue
            if linkage.KINDS.get(element.type.upper(), "pin") != "pin":
                continue
            for d in element.drawing:
                if d.get("shape") != "axis":
                    continue
                center, axis = np.asarray(d.get("center", [0, 0, 0]), float), np.asarray(d["axis"], float)
                if any(np.linalg.norm(center - c) < 1e-6 * self.size for c in done):
                    continue
                done.append(center)
                length, radius = self.axle(int(d.get("node", 0)), element, center, axis)
                unit = axis / (np.linalg.norm(axis) or 1.0)
                self.items.append(
                    Item(
                        shapes.bearing(center - unit * length * 0.5, axis, 2.3 * radius, 0.025 * self.size),
                        GROUND,
                        0,
                        kind="ground",
                        element=element.id,
                    )
                )


class Stage:
    """A scene put into one view of a plotter; `show` moves it to a frame. `limits`: of the colours of the
    field, those of what is shown unless given."""

    def __init__(
        self,
        scene: Scene,
        plotter: pv.Plotter,
        opacity: float = 1.0,
        field: str = "",
        limits: tuple[float, float] | None = None,
    ) -> None:
        self.scene = scene
        self.field = field
        self.limits = limits
        self.actors = []
        smooth = bool(field) and scene.result.average(field, 0) is not None
        # a drawn wheel would hide the stresses of its own mesh
        meshed = scene.meshed if field else set()
        for item in scene.items:
            if item.kind == "wheel" and item.node in meshed:
                continue
            mesh = item.mesh.copy()
            look = dict(
                color=item.color,
                smooth_shading=item.smooth,
                split_sharp_edges=item.smooth,
                specular=0.25,
                specular_power=18,
                ambient=0.22,
                diffuse=0.9,
                opacity=opacity * item.opacity,
                show_edges=item.edges,
                edge_color="#4a6a88",
            )
            if item.remake is not None:
                # Splitting edges would make a copy whose points no longer follow.
                look["split_sharp_edges"] = False
            if field and item.cells is not None:
                bar = dict(vertical=True, position_x=0.05, position_y=0.25, height=0.5, color="black")
                bar["title"] = f"{field}\n{scene.result.cell_field_unit(field)}".strip()
                del look["color"]
                (mesh.point_data if smooth else mesh.cell_data)[field] = np.zeros(
                    mesh.n_points if smooth else mesh.n_cells
                )
                # without lights colours are those of the bar
                look.update(scalars=field, cmap="viridis", scalar_bar_args=bar, lighting=False)
                look.update(ambient=0.0, diffuse=1.0, specular=0.0)
            self.actors.append((item, mesh, plotter.add_mesh(mesh, **look)))

    def show(self, frame: Frame) -> None:
        """Moves everything to a frame."""
        positions = self.scene.positions(frame)
        for item, mesh, actor in self.actors:
            if item.arrow is not None:
                actor.visibility = self.scene.loads.sense(item.arrow, frame) != 0
                if not actor.visibility:
                    continue
            if item.remake is not None:
                mesh.copy_from(item.remake(positions))
                if self.field and item.cells is not None:
                    self._colour(mesh, actor, item, frame)
                if item.smooth:
                    mesh.compute_normals(inplace=True, split_vertices=False)
            elif item.node:
                actor.user_matrix = self.scene.pose(item, frame)

    def _colour(self, mesh: pv.PolyData, actor: pv.Actor, item: Item, frame: Frame) -> None:
        values, seen = colours(self.scene.result, self.field, frame, item)
        at = "point" if values is not seen else "cell"
        (mesh.point_data if at == "point" else mesh.cell_data)[self.field] = values
        mesh.set_active_scalars(self.field, at)
        low, high = self.limits or limits_of([seen])
        actor.mapper.scalar_range = (low, high if high > low else low + 1.0)


def colours(result: Results, field: str, frame: Frame, item: Item) -> tuple[np.ndarray, np.ndarray]:
    """The field on an item of the mesh: its average at each point, or else its mean over the cell of each
    face; and those that are seen, for faces the same array. The undeformed model's are zero."""
    assert item.cells is not None
    nodal = result.average(field, frame.index or 0)
    if nodal is not None:
        values = nodal if frame.index is not None else np.zeros(len(nodal))
        return values, values[item.points]
    of_cells = result.cell_field(field, frame.index or 0)[item.cells]
    values = of_cells if frame.index is not None else np.zeros(len(of_cells))
    return values, values


def limits_of(values: list[np.ndarray]) -> tuple[float, float]:
    """Least and largest of all that are numbers; of a field that is constant but for rounding nothing and its
    value, so that it has one colour."""
    known = np.concatenate([v[np.isfinite(v)] for v in values])
    if not len(known):
        return 0.0, 0.0
    least, most = float(known.min()), float(known.max())
    if most - least <= 1e-6 * max(-least, most):
        return min(least, 0.0), max(most, 0.0)
    return least, most
