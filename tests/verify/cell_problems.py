# SPDX-License-Identifier: BSD-3-Clause
"""Standard problems of plane and axisymmetric cells, as functions of the cell and of how many there are
along a side. `test_cell_benchmarks.py` asserts what they give, `tests/bench/cell_tables.py` prints it."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import h5py
import numpy as np
from plane_meshes import Sheet, line_shape, nodal_forces
from runs import run

PLANE = (3, 6, 4, 8)
# Displacement of Cook's membrane: 8-node cells that get smaller towards the corners of its wall give
# 23.967589, 23.967695 and 23.967734 with 32, 48 and 96 a side, an order of 3. The literature has 23.96.
COOK = 23.96774


def solve(deck: list[str], folder: Path, ranks: int = 1) -> np.ndarray:
    """Displacements of all nodes, of linear statics: a row of three components each."""
    result = run("\n".join([*deck, ".FIN 1\n"]), folder, ranks=ranks)
    with h5py.File(result.file) as file:
        frames = file["fields/displacement"]
        return frames[sorted(frames)[-1]][:]


def cook(nodes: int, boxes: int, folder: Path, graded: bool = False, ranks: int = 1) -> float:
    """Cook's membrane in plane stress, E = 1, nu = 1/3, thickness 1, a shear force of 1 spread evenly over
    its right edge: the displacement of the middle of that edge along the force. Cells have equal sides, or
    are `graded`: smaller towards the corners of the wall, where stresses have no bound."""

    def place(u):
        x, y = (u[0] ** 2, u[1] ** 2 / (u[1] ** 2 + (1 - u[1]) ** 2)) if graded else u
        return np.array([48 * x, 44 * (x + y) - 28 * x * y])

    mesh = Sheet((boxes, boxes), nodes, place)
    deck = [
        *mesh.model("stress", 1.0, 1 / 3),
        mesh.group(2, "wall", mesh.nodes(lambda u: u[0] == 0)),
        '.CLM\n GROUP "wall" FIX C 1 2',
        *nodal_forces(mesh.forces(lambda u: u[0] == 1, lambda x, n: np.array([0, 1 / 16]))),
    ]
    (middle,) = mesh.nodes(lambda u: tuple(u) == (1, 0.5))
    return float(solve(deck, folder, ranks)[middle, 1])


class Hole(NamedTuple):
    """A plate with a round hole of radius 1 under tension 1 along x (Kirsch 1898)."""

    hypothesis: str
    young: float = 1000.0
    poisson: float = 0.3
    exact = 3.0  # the greatest stress on the hole

    def moduli(self) -> tuple[float, float]:
        """Shear modulus, and Kolosov's constant."""
        nu = self.poisson
        kappa = 3 - 4 * nu if self.hypothesis == "strain" else (3 - nu) / (1 + nu)
        return self.young / (2 * (1 + nu)), kappa

    def displacement(self, x: np.ndarray) -> np.ndarray:
        """At points x, one a row. N. I. Muskhelishvili (1953), Some Basic Problems of the Mathematical Theory
        of Elasticity, articles 32 (displacements from potentials) and 56a (the potentials of this plate)."""
        shear, kappa = self.moduli()
        z = x[:, 0] + 1j * x[:, 1]
        # 2 G (u + i v) = kappa phi - z conj(phi') - conj(psi)
        phi, slope = (z + 2 / z) / 4, (1 - 2 / z**2) / 4
        psi = -(z + 1 / z - 1 / z**3) / 2
        u = (kappa * phi - z * slope.conj() - psi.conj()) / (2 * shear)
        return np.stack([u.real, u.imag], axis=1)

    def stress(self, x: np.ndarray) -> np.ndarray:
        """The tensor in the plane at one point; on the hole its greatest value is 3, at (0, 1)."""
        z = complex(*x)
        slope, bend = (1 - 2 / z**2) / 4, 1 / z**3
        other = -(1 - 1 / z**2 + 3 / z**4) / 2
        total = 4 * slope.real
        difference = 2 * (z.conjugate() * bend + other)  # (yy - xx) + 2 i xy
        xx, yy, xy = (total - difference.real) / 2, (total + difference.real) / 2, difference.imag / 2
        return np.array([[xx, xy], [xy, yy]])

    def solve(self, nodes: int, boxes: int, folder: Path) -> tuple[float, float]:
        """A quarter of the plate within the radius 4, with Kirsch's tractions on its outer edge: error of
        displacements (root of the mean square over nodes, of the largest one), and the greatest stress on the
        hole, from the stretch of its edge."""
        mesh = Sheet(
            (boxes, boxes),
            nodes,
            lambda u: 4 ** u[0] * np.array([np.cos(np.pi / 2 * u[1]), np.sin(np.pi / 2 * u[1])]),
            curved=True,
        )
        forces = mesh.forces(lambda u: u[0] == 1, lambda x, n: self.stress(x) @ n)
        deck = [
            *mesh.model(self.hypothesis, self.young, self.poisson),
            mesh.group(2, "x axis", mesh.nodes(lambda u: u[1] == 0)),
            mesh.group(3, "y axis", mesh.nodes(lambda u: u[1] == 1)),
            '.CLM\n GROUP "x axis" FIX C 2\n GROUP "y axis" FIX C 1',
            *nodal_forces(forces),
        ]
        found = solve(deck, folder)
        expected = self.displacement(mesh.points)
        error = np.sqrt(np.mean((found[:, :2] - expected) ** 2)) / np.abs(expected).max()
        return float(error), float(self.stress_at_top(mesh, found[:, :2]))

    def stress_at_top(self, mesh: Sheet, found: np.ndarray) -> float:
        """The hole is free of forces, so that its hoop stress is the stretch of its edge times E."""
        top = next(
            mesh.edge(cell, side)
            for cell, side in mesh.faces(lambda u: u[0] == 0)
            if any(mesh.unit[i][1] == 1 for i in mesh.edge(cell, side))
        )
        end = 1.0 if mesh.unit[top[1]][1] == 1 else -1.0
        _, slope = line_shape(end, len(top))
        tangent = slope @ mesh.points[top]
        stretch = tangent @ (slope @ found[top]) / (tangent @ tangent)
        return stretch * self.young / (1 - self.poisson**2 if self.hypothesis == "strain" else 1)


class Tube(NamedTuple):
    """A thick tube held along its axis under inner pressure (Lamé): a quarter of its section in plane strain,
    or a slice round the axis. `radii`: the ends of cells along the radius."""

    hypothesis: str
    radii: tuple[float, ...]
    young: float
    poisson: float
    pressure: float
    alternating: bool = True  # diagonals of triangles

    def displacement(self, radius: np.ndarray) -> np.ndarray:
        """Radial, of plane strain."""
        inner, outer, nu = self.radii[0], self.radii[-1], self.poisson
        factor = self.pressure * inner**2 / (outer**2 - inner**2) * (1 + nu) / self.young
        return factor * ((1 - 2 * nu) * radius + outer**2 / radius)

    def solve(self, nodes: int, rows: int, folder: Path) -> tuple[float, float]:
        """`rows` of cells round or along the axis. Error of radial displacements (root of the mean square
        over nodes, of the largest one), and the mean radial displacement of the bore over the exact one."""
        boxes = len(self.radii) - 1

        def place(u):
            radius = np.interp(u[0] * boxes, range(boxes + 1), self.radii)
            if self.hypothesis == "axis":
                return np.array([radius, u[1] * 0.5 * (self.radii[1] - self.radii[0])])
            return radius * np.array([np.cos(np.pi / 2 * u[1]), np.sin(np.pi / 2 * u[1])])

        mesh = Sheet((boxes, rows), nodes, place, curved=True, alternating=self.alternating)
        groups = [
            mesh.group(2, "low", mesh.nodes(lambda u: u[1] == 0)),
            mesh.group(3, "high", mesh.nodes(lambda u: u[1] == 1)),
            *mesh.group_of_faces(4, "bore", lambda u: u[0] == 0),
        ]
        held = '.CLM\n GROUP "low" FIX C 2\n GROUP "high" FIX C 2'
        if self.hypothesis == "strain":
            held = '.CLM\n GROUP "low" FIX C 2\n GROUP "high" FIX C 1'
        deck = [
            *mesh.model(self.hypothesis, self.young, self.poisson),
            *groups,
            held,
            f' GROUP "bore" PRE V {self.pressure}',
        ]
        found = solve(deck, folder)
        if self.hypothesis == "axis":
            radius, radial = mesh.points[:, 0], found[:, 0]
        else:
            radius = np.hypot(*mesh.points.T)
            radial = (found[:, :2] * mesh.points).sum(axis=1) / radius
        expected = self.displacement(radius)
        error = np.sqrt(np.mean((radial - expected) ** 2)) / expected.max()
        bore = mesh.nodes(lambda u: u[0] == 0)
        return float(error), float(np.mean(radial[bore] / expected[bore]))


def even_tube(hypothesis: str, boxes: int) -> Tube:
    """Radii 1 to 2, nu = 0.3."""
    return Tube(hypothesis, tuple(np.linspace(1, 2, boxes + 1)), 1000.0, 0.3, 100.0)


def stiff_tube(hypothesis: str, poisson: float, alternating: bool = True) -> Tube:
    """The thick-walled cylinder of MacNeal and Harder (1985), five cells from radius 3 to 9."""
    return Tube(hypothesis, (3.0, 3.5, 4.2, 5.2, 6.75, 9.0), 1000.0, poisson, 1.0, alternating)


class Disc(NamedTuple):
    """A disc with a hole that turns about its axis: a quarter in plane stress, free all round; or a long one
    held along its axis, as a quarter in plane strain or as a slice round the axis."""

    hypothesis: str = "stress"
    inner: float = 1.0
    outer: float = 2.0
    young: float = 1000.0
    poisson: float = 0.3
    density: float = 2.0
    speed: float = 3.0

    def displacement(self, radius: np.ndarray) -> np.ndarray:
        """Radial (S. P. Timoshenko and J. N. Goodier 1970, Theory of Elasticity, article 32); in plane strain
        with E/(1 - nu^2) and nu/(1 - nu) for E and nu (article 16)."""
        young, nu = self.young, self.poisson
        if self.hypothesis != "stress":
            young, nu = young / (1 - nu**2), nu / (1 - nu)
        scale = (3 + nu) / 8 * self.density * self.speed**2
        sum_, product = self.inner**2 + self.outer**2, (self.inner * self.outer) ** 2
        along = scale * (sum_ - product / radius**2 - radius**2)
        round_ = scale * (sum_ + product / radius**2 - (1 + 3 * nu) / (3 + nu) * radius**2)
        return radius / young * (round_ - nu * along)

    def error(self, points: np.ndarray, moved: np.ndarray, round_axis: bool = False) -> float:
        """Of radial displacements: root of the mean square over nodes, of the largest one."""
        radius = points[:, 0] if round_axis else np.hypot(points[:, 0], points[:, 1])
        radial = moved[:, 0] if round_axis else (moved[:, :2] * points[:, :2]).sum(axis=1) / radius
        expected = self.displacement(radius)
        return float(np.sqrt(np.mean((radial - expected) ** 2)) / expected.max())

    def place(self, u: np.ndarray) -> np.ndarray:
        """The quarter, of the unit square."""
        radius, angle = self.inner + (self.outer - self.inner) * u[0], np.pi / 2 * u[1]
        return radius * np.array([np.cos(angle), np.sin(angle)])

    def solve(self, nodes: int, boxes: int, folder: Path) -> float:
        """Its error with so many boxes along the radius, and as many round it; one along the axis."""
        slice_ = self.hypothesis == "axis"

        def place(u):
            return np.array([self.inner + (self.outer - self.inner) * u[0], u[1] / boxes])

        mesh = Sheet((boxes, 1 if slice_ else boxes), nodes, place if slice_ else self.place, curved=True)
        deck = [
            *mesh.model(self.hypothesis, self.young, self.poisson, 0.3, self.density),
            mesh.group(2, "low", mesh.nodes(lambda u: u[1] == 0)),
            mesh.group(3, "high", mesh.nodes(lambda u: u[1] == 1)),
            f'.CLM\n GROUP "low" FIX C 2\n GROUP "high" FIX C {2 if slice_ else 1}',
            f' GROUP "all" ROT VAL {self.speed} AXE {"0 1 0" if slice_ else "0 0 5"}',
        ]
        return self.error(mesh.points, solve(deck, folder), slice_)


def orders(errors: list[float]) -> list[float]:
    """Of errors on meshes each twice as fine as the one before."""
    return [float(np.log2(a / b)) for a, b in pairwise(errors)]
