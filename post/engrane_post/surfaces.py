# SPDX-License-Identifier: BSD-3-Clause
"""The scene of a picture as one mesh for other programs: cells that stay, points that move."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from .graphics import offsets_of, pv
from .mesh import Mesh, Step
from .results import Frame
from .scene import Item, Scene

# The numbers of the cell array `kind`; docs/post.md lists them.
KINDS = (
    "other",
    "wheel",
    "rack",
    "cam",
    "belt",
    "pulley",
    "body",
    "joint",
    "spring",
    "link",
    "mass",
    "load",
    "ground",
    "cell",
    "support",
)


class Surfaces:
    """All surfaces of a scene in one mesh, and where its points are at a frame."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.parts = [_Part(item, scene) for item in scene.items]
        self.parts = [p for p in self.parts if len(p.types)]
        starts = np.cumsum([0, *(len(p.points) for p in self.parts)])
        sizes = np.concatenate([p.sizes for p in self.parts]) if self.parts else np.zeros(0, int)
        count = [len(p.types) for p in self.parts]
        self.mesh = Mesh(
            types=np.concatenate([p.types for p in self.parts]) if self.parts else np.zeros(0, np.uint8),
            offsets=np.concatenate([[0], np.cumsum(sizes)]),
            connectivity=np.concatenate(
                [p.connectivity + s for p, s in zip(self.parts, starts[:-1], strict=True)]
                or [np.zeros(0, int)]
            ),
            cell_data={
                "element": np.repeat([p.item.element for p in self.parts], count).astype(np.int32),
                "kind": np.repeat([KINDS.index(p.item.kind) for p in self.parts], count).astype(np.int32),
                "node": np.repeat([p.item.node for p in self.parts], count).astype(np.int32),
                "part": np.repeat(np.arange(len(self.parts)), count).astype(np.int32),
                "color": np.repeat(
                    np.array([pv.Color(p.item.color).int_rgb for p in self.parts], np.uint8).reshape(-1, 3),
                    count,
                    axis=0,
                ),
            },
        )

    @cached_property
    def moves(self) -> bool:
        """Whether the run tells velocities."""
        return self.scene.result.has_fields("velocity", "angular_velocity")

    def step(self, frame: Frame) -> Step:
        """Points and, where the run tells them, velocities at a frame; four bytes are enough to be seen."""
        assert frame.time is not None
        points = self.at(frame)
        data = {"velocity": self.velocity(frame, points).astype(np.float32)} if self.moves else {}
        return Step(frame.time, points.astype(np.float32), data)

    def at(self, frame: Frame) -> np.ndarray:
        """Positions of all points (n x 3)."""
        positions = self.scene.positions(frame)
        return np.concatenate([p.at(frame, positions) for p in self.parts] or [np.zeros((0, 3))])

    def velocity(self, frame: Frame, points: np.ndarray) -> np.ndarray:
        """Velocities of all points (n x 3), which are at `points`. What is drawn anew in every frame moves as
        its drawing does."""
        rates = Rates(self.scene, frame)
        out, start = [], 0
        positions = self.scene.positions(frame)
        for p in self.parts:
            own = points[start : start + len(p.points)]
            start += len(own)
            out.append(p.velocity(frame, rates, positions, own))
        return np.concatenate(out or [np.zeros((0, 3))])


class Rates:
    """Velocities of nodes and of points that they carry."""

    def __init__(self, scene: Scene, frame: Frame) -> None:
        assert frame.index is not None
        self.scene = scene
        fields = [scene.result.field(name, frame.index) for name in ("velocity", "angular_velocity")]
        empty = np.zeros((len(scene.ids), 3))
        self.linear, self.angular = (empty if f is None else np.nan_to_num(f) for f in fields)
        self.where = scene.result.points + frame.displacement

    def of(self, node: int, points: np.ndarray) -> np.ndarray:
        """Of points (n x 3) fixed to a node; zero on the ground."""
        if node not in self.scene.row:
            return np.zeros_like(points)
        i = self.scene.row[node]
        return self.linear[i] + np.cross(self.angular[i], points - self.where[i])

    def of_arrow(self, item: Item, frame: Frame, points: np.ndarray) -> np.ndarray:
        """Of points of a load's arrow: its centre moves with a node, and it turns with its holder."""
        assert item.arrow is not None
        center = (self.scene.transform(item.node, frame) @ np.r_[item.arrow.center, 1.0])[:3]
        row = self.scene.row.get(item.arrow.holder)
        turning = np.zeros(3) if row is None else self.angular[row]
        return self.of(item.node, center[None, :]) + np.cross(turning, points - center)

    def named(self, positions: dict[int, np.ndarray]) -> dict[int, np.ndarray]:
        """Of the places that Scene.positions() gives."""
        carriers = {name: node for name, (node, _) in self.scene.carried.items()}
        return {n: self.of(carriers.get(n, n), x[None, :])[0] for n, x in positions.items()}


class _Part:
    """One item: its cells with points of their own, numbered from 0."""

    def __init__(self, item: Item, scene: Scene) -> None:
        self.item, self.scene = item, scene
        grid = item.mesh.cast_to_unstructured_grid()
        # a wheel's marked tooth comes with the points of the whole wheel
        self.used, self.connectivity = np.unique(grid.cell_connectivity, return_inverse=True)
        self.types = np.asarray(grid.celltypes, np.uint8)
        self.sizes = np.diff(offsets_of(grid))
        self.count = item.mesh.n_points
        self.points = self.last = np.asarray(item.mesh.points, float)[self.used]

    def at(self, frame: Frame, positions: dict[int, np.ndarray]) -> np.ndarray:
        if self.item.remake is None:
            t = self.scene.pose(self.item, frame)
            return self.points @ t[:3, :3].T + t[:3, 3]
        return self._remade(positions)

    def velocity(
        self, frame: Frame, rates: Rates, positions: dict[int, np.ndarray], points: np.ndarray
    ) -> np.ndarray:
        if self.item.arrow is not None:
            return rates.of_arrow(self.item, frame, points)
        if self.item.remake is None:
            return rates.of(self.item.node, points)
        rate = rates.named(positions)
        fastest = max((float(np.linalg.norm(v)) for v in rate.values()), default=0.0)
        if fastest == 0:
            return np.zeros_like(points)
        step = 1e-4 * self.scene.size / fastest
        ahead, behind = (
            self._remade({n: x + sign * step * rate[n] for n, x in positions.items()}) for sign in (1, -1)
        )
        return (ahead - behind) / (2 * step)

    def _remade(self, positions: dict[int, np.ndarray]) -> np.ndarray:
        assert self.item.remake is not None
        mesh = self.item.remake(positions)
        if mesh.n_points == self.count:
            self.last = np.asarray(mesh.points, float)[self.used]
        # a spring pressed to no length has no surface: it stays as it was
        return self.last
