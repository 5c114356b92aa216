# SPDX-License-Identifier: BSD-3-Clause
"""Forces and moments as vectors at points, for glyphs: what acts on whom, from histories and reactions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from . import coordinates, linkage, shapes
from .mesh import Mesh, Step
from .results import Element, Frame, Results
from .scene import Scene

# The numbers of the array `kind`; docs/post.md lists them.
KINDS = ("reaction", "tooth", "joint", "cam", "belt", "spring", "load", "body", "stop", "effort")
# Efforts along coordinates of joints: channel, keyword of the joint and which of several, keyword of the
# coordinate.
EFFORTS = {
    "MOTOR": [("EFFORT", "JOINT", 0, "COORDINATE")],
    "CONTROLLER": [("EFFORT", "OUT", 0, "ALONG")],
    "COUPLING": [("EFFORT_1", "JOINTS", 0, "FIRST"), ("EFFORT_2", "JOINTS", 1, "SECOND")],
}

Place = Callable[[Frame, int], np.ndarray]  # where the point is in a frame, which is the k-th of those chosen


@dataclass
class ForcePoint:
    """A point of `node` on which `element` (0: the support) acts, and with what (one row a frame)."""

    kind: str
    element: int
    node: int
    place: Place
    force: np.ndarray
    moment: np.ndarray


@dataclass
class BetweenSamples:
    """Where frames lie: between which samples of the histories (rows), and what part of the way."""

    before: np.ndarray
    after: np.ndarray
    part: np.ndarray

    @classmethod
    def at(cls, times: np.ndarray, wanted: np.ndarray) -> BetweenSamples:
        """Fields may be kept at other instants than histories, but none outside them."""
        after = np.minimum(np.searchsorted(times, wanted), len(times) - 1)
        before = np.maximum(after - 1, 0)
        gap = times[after] - times[before]
        part = np.where(gap > 0, (wanted - times[before]) / np.where(gap > 0, gap, 1), 1)
        return cls(before, after, np.clip(part, 0, 1))

    def values(self, result: Results, table: str) -> np.ndarray:
        """The histories of a table there, on straight lines: what acts may have corners between samples."""
        first, last = result.samples(table, self.before), result.samples(table, self.after)
        part = self.part[:, None]
        between = np.where(part > 0, first + part * (last - first), first)
        return np.where(part < 1, between, last)  # no value at one of the samples does not spoil the other


class Forces:
    """All points of a result at which forces are known, for these frames of it."""

    def __init__(self, scene: Scene, frames: list[Frame]) -> None:
        self.scene, self.frames = scene, frames
        self.points: list[ForcePoint] = []
        result = scene.result
        self._channels = {c.name: c for c in result.channels.values() if c.name.startswith("element/")}
        self._open = {tuple(c.name.split("/")[:2]) for c in result.channels.values() if not c.unique}
        times = result.times()
        if len(times):
            self._between_samples = BetweenSamples.at(times, np.array([f.time for f in frames], float))
            self._tables: dict[str, np.ndarray] = {}
            self._owners = {e.id: e for e in result.elements}
            for element in result.elements:
                self._element(element)
        self._reactions()

    def mesh(self) -> Mesh:
        """A vertex for each point."""
        columns = {
            "kind": [KINDS.index(p.kind) for p in self.points],
            "element": [p.element for p in self.points],
            "node": [p.node for p in self.points],
            "unique": [self._owner(p) not in self._open for p in self.points],
        }
        return Mesh.of_points(len(self.points), **{n: np.array(c, np.int32) for n, c in columns.items()})

    @staticmethod
    def _owner(point: ForcePoint) -> tuple[str, str]:
        """Whose histories tell what acts there."""
        return ("element", str(point.element)) if point.element else ("node", str(point.node))

    def step(self, frame: Frame, k: int) -> Step:
        """Where the points are in the k-th frame, and what acts there."""
        data = {
            "FORCE": np.array([p.force[k] for p in self.points]),
            "MOMENT": np.array([p.moment[k] for p in self.points]),
        }
        assert frame.time is not None
        return Step(frame.time, np.array([p.place(frame, k) for p in self.points]), data)

    # What the elements tell

    def _element(self, element: Element) -> None:
        kind = element.type.upper()
        if kind in ("GEAR", "RACK"):
            self._teeth(element)
        elif kind == "BELT":
            self._belt(element)
        elif kind == "RIGID":
            for node in element.nodes[1:]:
                both = (self._vector(element, f"{what}_{{}}_{node}") for what in ("FORCE", "MOMENT"))
                self._add("body", element, node, None, *both)
        elif kind in ("TORQUE", "TSPRING"):
            self._torque(element)
        elif kind == "CHA":
            load = (self._vector(element, f"{what}_{{}}") for what in ("FORCE", "MOMENT"))
            self._add("load", element, element.nodes[0], None, *load)
        elif kind in ("BUSHING", "BEARING"):
            self._bushing(element)
        elif kind == "STOP":
            self._stop(element)
        elif kind == "LIA":
            self._relation(element)
        elif kind in EFFORTS:
            for channel, *words in EFFORTS[kind]:
                self._effort(element, channel, *words)
        elif len(element.nodes) == 2 and (force := self._vector(element, "FORCE_{}")) is not None:
            self._on_second(element, force)
        elif kind in ("SPRING", "FORCE", "BAR"):
            self._line(element)
        elif kind == "CABLE":
            for node, side in zip(element.nodes, "AB", strict=True):
                if node:
                    self._add("spring", element, node, None, self._vector(element, f"FORCE_{side}{{}}"))

    def _teeth(self, element: Element) -> None:
        """Tooth forces at the contact point, their moments about the centre of each wheel there."""
        contact = self._vector(element, "CONTACT_{}")
        if contact is None:
            return
        wheels = [d for d in element.drawing if d.get("shape") == "wheel"]
        for i, side in enumerate("AB"):
            node = element.nodes[i]
            force, moment = (self._vector(element, f"{what}_{side}{{}}") for what in ("FORCE", "MOMENT"))
            self._add("tooth", element, node, lambda _, k: contact[k], force)
            center = np.asarray(wheels[i]["center"], float) if i < len(wheels) else None
            self._add("tooth", element, node, self._on(node, center), None, moment)

    def _on_second(self, element: Element, force: np.ndarray) -> None:
        """Joints and cams tell the force on their second node; a spring's pulls the first towards it."""
        a, b = element.nodes
        moment = self._vector(element, "MOMENT_{}")
        kind = element.type.upper()
        if kind == "SPRING":
            self._add("spring", element, a, None, force)
            self._add("spring", element, b, None, -force)
        elif kind == "CAM":
            roller = next((d for d in element.drawing if d.get("shape") == "roller"), {})
            point = roller.get("center") or element.parameters.get("AT")
            self._add("cam", element, b, self._on(b, point), force)
        else:
            joint = linkage.joint(self.scene, element)
            drawn = next((d for d in element.drawing if d.get("shape") == "axis"), {})
            point = joint.place_b if joint else drawn.get("center")
            place = self._on(b, point)
            if b:
                self._add("joint", element, b, place, force, moment)
            else:  # the ground needs no arrows, the body that it holds does
                self._add("joint", element, a, place, -force, None if moment is None else -moment)

    def _belt(self, element: Element) -> None:
        a, b = element.nodes
        force = self._vector(element, "FORCE_{}")
        torques = [self._scalar(element, f"TORQUE_{i}") for i in (1, 2)]
        if force is None or any(t is None for t in torques):
            return
        axis = self._axes(element, a)
        self._add("belt", element, a, None, -force, torques[0][:, None] * axis)
        self._add("belt", element, b, None, force, torques[1][:, None] * axis)

    def _torque(self, element: Element) -> None:
        size = self._scalar(element, "TORQUE")
        if size is None or len(element.nodes) != 2:
            return
        a, b = element.nodes
        given = element.parameters
        alone = len(np.ravel(given.get("N") or element.nodes)) == 1
        spring = element.type.upper() == "TSPRING"
        if spring:
            self._moments("spring", element, size[:, None] * self._turn(element))
            return
        fixed = bool(given.get("FIXED")) or (alone and not given.get("FOLLOW"))
        self._moments("load", element, size[:, None] * self._axes(element, 0 if fixed else b if alone else a))

    def _moments(self, kind: str, element: Element, moment: np.ndarray) -> None:
        """On the second node, and the opposite on the first; none on the ground."""
        for node, sign in zip(element.nodes, (-1, 1), strict=True):
            if node:
                self._add(kind, element, node, None, None, sign * moment)

    def _between(
        self,
        kind: str,
        element: Element,
        nodes: Sequence[int],
        place: Place,
        force: np.ndarray | None,
        moment: np.ndarray | None = None,
    ) -> None:
        """On the second node, and the opposite on the first at the same place; none on the ground."""
        for node, sign in zip(nodes, (-1, 1), strict=True):
            if node:
                both = (None if v is None else sign * v for v in (force, moment))
                self._add(kind, element, node, place, *both)

    def _bushing(self, element: Element) -> None:
        """Its channels are on b in axes that a holds; both sides act at b's point."""
        a, b = element.nodes
        given = element.parameters
        axes = coordinates.triad(given["AXIS"], given.get("AXIS2")) if given.get("AXIS") else np.eye(3)
        own = [self._vector(element, f"{what}_{{}}", "123") for what in ("FORCE", "MOMENT")]
        if own[0] is None or own[1] is None:
            return
        turned = np.array([self.scene.transform(a, f)[:3, :3] @ axes for f in self.frames])
        force, moment = (np.einsum("kij,kj->ki", turned, v) for v in own)
        drawn = next((d for d in element.drawing if d.get("shape") == "axis"), {})
        self._between("spring", element, element.nodes, self._on(b, drawn.get("center")), force, moment)

    def _stop(self, element: Element) -> None:
        """On a distance, a turn or the height of a point of b above a plane that a holds."""
        a, b = element.nodes
        given = element.parameters
        if given.get("AXIS"):
            size = self._scalar(element, "TORQUE")
            if size is not None:
                self._moments("stop", element, size[:, None] * self._turn(element))
        elif given.get("NORMAL"):
            size = self._scalar(element, "FORCE")
            if size is not None:
                force = size[:, None] * self._axes(element, a, "NORMAL")
                self._between("stop", element, element.nodes, self._on(b, given.get("AT")), force)
        else:
            self._line(element)

    def _effort(self, element: Element, channel: str, joint: str, which: int, name: str) -> None:
        """Along a coordinate of another element, at that one's place."""
        size = self._scalar(element, channel)
        named = np.ravel(element.parameters.get(joint) or [0])
        owner = self._owners.get(int(named[which]))
        if size is None or owner is None:
            return
        wanted = str(element.parameters.get(name) or "").upper()
        along = coordinates.direction(self.scene, owner, wanted, self.frames)
        if along is not None:
            force, moment = (size[:, None] * v for v in (along.force, along.moment))
            self._between(
                "effort", element, (along.a, along.b), self._on(along.b, along.place), force, moment
            )

    def _relation(self, element: Element) -> None:
        """A linear relation acts on each of its components with the reaction times the coefficient."""
        size = self._scalar(element, "REACTION")
        if size is None:
            return
        terms = [np.ravel(element.parameters.get(k) or []) for k in ("NOEUD", "C", "A")]
        sums: dict[int, np.ndarray] = {}
        for node, c, coefficient in zip(*terms, strict=True):
            axis, turns = np.eye(3)[(int(c) - 1) % 3], int(c) > 3
            along = coordinates.turn(self.scene, 0, int(node), axis, self.frames) if turns else axis
            both = sums.setdefault(int(node), np.zeros((2, len(self.frames), 3)))
            both[int(turns)] += coefficient * size[:, None] * along
        for node, (force, moment) in sums.items():
            self._add("effort", element, node, None, force, moment)

    def _line(self, element: Element) -> None:
        """Springs and forces between two nodes, along their line; a force on one node, along DIR."""
        size = self._scalar(element, "FORCE")
        if size is None:
            return
        given = element.parameters
        if len(element.nodes) == 1:
            node = element.nodes[0]
            along = self._axes(element, node if given.get("FOLLOW") else 0, "DIR")
            self._add("load", element, node, self._on(node, given.get("AT")), size[:, None] * along)
            return
        places = [self._on(n, given.get("AT") if n == 0 else None) for n in element.nodes]
        line = np.array([places[1](f, k) - places[0](f, k) for k, f in enumerate(self.frames)])
        pull = size[:, None] * line / np.maximum(np.linalg.norm(line, axis=1), 1e-300)[:, None]
        kind = {"SPRING": "spring", "BAR": "spring", "STOP": "stop"}.get(element.type.upper(), "load")
        for node, place, sign in zip(
            element.nodes, places, (1, -1) if kind == "spring" else (-1, 1), strict=True
        ):
            if node:
                self._add(kind, element, node, place, sign * pull)

    def _reactions(self) -> None:
        """On supported nodes, from the fields."""
        result, zero = self.scene.result, np.zeros((len(self.scene.ids), 3))
        both = []
        for name in ("reaction_force", "reaction_torque"):
            fields = [result.field(name, f.index) for f in self.frames]
            both.append(np.array([zero if f is None else np.nan_to_num(f) for f in fields]))
        force, moment = both
        for i in np.flatnonzero(np.abs(force).max(axis=(0, 2)) + np.abs(moment).max(axis=(0, 2))):
            node = self.scene.ids[i]
            self.points.append(ForcePoint("reaction", 0, node, self._on(node), force[:, i], moment[:, i]))

    def _add(
        self,
        kind: str,
        element: Element,
        node: int,
        place: Place | None,
        force: np.ndarray | None,
        moment: np.ndarray | None = None,
    ) -> None:
        if force is None and moment is None:
            return
        zero = np.zeros((len(self.frames), 3))
        vectors = (zero if v is None else v for v in (force, moment))
        self.points.append(ForcePoint(kind, element.id, node, place or self._on(node), *vectors))

    def _on(self, node: int, point: object = None) -> Place:
        """A point (in the reference; default the node itself) that moves with the node."""
        x = self.scene.points.get(node, np.zeros(3)) if point is None else np.asarray(point, float)
        return lambda frame, _: (self.scene.transform(node, frame) @ np.r_[x, 1.0])[:3]

    def _axes(self, element: Element, node: int, keyword: str = "AXIS") -> np.ndarray:
        """A direction of the card in every frame, turning with the node."""
        axis = shapes.unit(np.asarray(element.parameters.get(keyword) or [0, 0, 1], float))
        return np.array([self.scene.transform(node, f)[:3, :3] @ axis for f in self.frames])

    def _turn(self, element: Element) -> np.ndarray:
        """Moment on the second node per unit along its turn about AXIS."""
        a, b = element.nodes
        return coordinates.turn(self.scene, a, b, element.parameters.get("AXIS") or [0, 0, 1], self.frames)

    def _vector(self, element: Element, pattern: str, components: str = "XYZ") -> np.ndarray | None:
        parts = [self._scalar(element, pattern.format(c)) for c in components]
        return None if any(p is None for p in parts) else np.stack(parts, axis=1)

    def _scalar(self, element: Element, name: str) -> np.ndarray | None:
        channel = self._channels.get(f"element/{element.id}/{name}")
        if channel is None:
            return None
        if channel.table not in self._tables:
            self._tables[channel.table] = self._between_samples.values(self.scene.result, channel.table)
        return np.nan_to_num(self._tables[channel.table][:, channel.column])
