# SPDX-License-Identifier: BSD-3-Clause
"""Bodies of a material whose axes follow a cylindrical or spherical frame, with closed forms: rings and tubes
under pressure and heat, a thick sphere. `test_curved_axes.py` asserts what they give."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import h5py
import numpy as np
from plane_meshes import Sheet
from runs import run
from solid_meshes import Block

# along the radius, round the axis, along the axis; NT: 12 23 13
YOUNG, POISSON, SHEAR, EXPANSION = (1000.0, 4000.0, 1500.0), (0.1, 0.2, 0.15), 600.0, (3e-3, 1e-3, 2e-3)
INNER, OUTER, PRESSURE, RISE = 1.0, 3.0, 10.0, 5.0
MATERIAL = (
    f"YT {YOUNG[0]} {YOUNG[1]} {YOUNG[2]} NT {POISSON[0]} {POISSON[1]} {POISSON[2]} "
    f"G {SHEAR} {SHEAR} {SHEAR} A {EXPANSION[0]} {EXPANSION[1]} {EXPANSION[2]}"
)
HYPOTHESES = {"stress": "CONT PLAN", "strain": "DEFO PLAN"}


class Ring(NamedTuple):
    """A ring of cylindrical orthotropy under inner pressure and an even rise of temperature, in plane stress
    or held along its axis. From the balance of stresses, sr' + (sr - st)/r = 0, with stresses Q e - b T in
    the plane, u = c1 r^k + c2 r^-k + c3 r, where k^2 = Qtt/Qrr (S. G. Lekhnitskii 1963, Theory of Elasticity
    of an Anisotropic Elastic Body, for tubes of cylindrical anisotropy)."""

    hypothesis: str

    def moduli(self) -> tuple[np.ndarray, np.ndarray]:
        """Of the plane, and the stresses b that hold back a rise of 1."""
        (e1, e2, e3), (n12, n23, n13) = YOUNG, POISSON
        compliance = np.array(
            [[1 / e1, -n12 / e1, -n13 / e1], [-n12 / e1, 1 / e2, -n23 / e2], [-n13 / e1, -n23 / e2, 1 / e3]]
        )
        if self.hypothesis == "stress":
            moduli = np.linalg.inv(compliance[:2, :2])
            return moduli, moduli @ EXPANSION[:2]
        moduli = np.linalg.inv(compliance)
        return moduli[:2, :2], moduli[:2] @ EXPANSION

    def exact(self, radius: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Radial displacements, and stresses along the radius and round the axis, a row for each radius."""
        (q, b), radii = self.moduli(), np.array([INNER, OUTER])
        k = np.sqrt(q[1, 1] / q[0, 0])
        even = RISE * (b[0] - b[1]) / (q[0, 0] - q[1, 1])

        def strains(n: float, r: np.ndarray) -> np.ndarray:
            return np.stack([n * r ** (n - 1), r ** (n - 1)])

        ends = np.stack([q[0] @ strains(n, radii) for n in (k, -k)], axis=1)
        rest = q[0] @ strains(1, radii) * even - b[0] * RISE
        factors = [*np.linalg.solve(ends, np.array([-PRESSURE, 0]) - rest), even]
        powers = (k, -k, 1.0)
        moved = sum(c * radius**n for c, n in zip(factors, powers, strict=True))
        stretch = sum(c * strains(n, radius) for c, n in zip(factors, powers, strict=True))
        return moved, (q @ stretch).T - b * RISE

    def errors(self, mesh: Sheet | Block, deck: list[str], folder: Path) -> tuple[float, float]:
        """Of radial displacements, and of stresses at nodes: roots of the mean square, of the largest one."""
        found, stress = solved(deck, folder)
        radius, direction = polar(mesh.points)
        moved, expected = self.exact(radius)
        radial = (found[:, :2] * direction).sum(axis=1)
        across = np.stack([-direction[:, 1], direction[:, 0]], axis=1)
        tensor = np.stack([stress[:, [0, 3]], stress[:, [3, 1]]], axis=1)
        along = [np.einsum("ni,nij,nj->n", d, tensor, d) for d in (direction, across)]
        return relative(radial, moved), relative(np.stack(along, axis=1), expected)

    def plane(self, nodes: int, boxes: int, folder: Path) -> tuple[float, float]:
        """Errors of a quarter of so many boxes along the radius and round the axis."""
        mesh = Sheet((boxes, boxes), nodes, lambda u: bent(u), curved=True)
        deck = [
            mesh.text(HYPOTHESES[self.hypothesis], MATERIAL),
            '.PHP GROUP "all" THICK VAL 0.5' if self.hypothesis == "stress" else "",
            *loads(mesh, "low FIX C 2", "high FIX C 1"),
        ]
        return self.errors(mesh, deck, folder)

    def solid(self, corners: int, second: bool, boxes: int, folder: Path) -> tuple[float, float]:
        """The same of solids, held along the axis."""
        mesh = Block((boxes, boxes, 1), corners, second, lambda u: [*bent(u), 0.5 * u[2]], curved=True)
        deck = [
            *mesh.deck(),
            f'.SEL GROUP 1 NOM "all" MAILLE TOUT\n.MAT I 1 {MATERIAL}\n.AEL GROUP "all" MAT 1',
            ".SEL",
            mesh.group(2, "ends", mesh.nodes(lambda u: u[2] in (0, 1))),
            *loads(mesh, "low FIX C 2", "high FIX C 1", "ends FIX C 3"),
        ]
        return self.errors(mesh, deck, folder)


def sphere(nodes: int, boxes: int, folder: Path) -> float:
    """Error of radial displacements of a thick sphere of spherical orthotropy, alike in all directions across
    the radius, under inner pressure: round an axis, from the equator to the pole. u = r^n with
    n (n + 1) = 2 (Ctt + Ctp - Crt)/Crr (the same, for spheres)."""
    radial, across, minor, contraction = 1000.0, 4000.0, 0.1, 0.25
    compliance = np.array(
        [
            [1 / radial, -minor / radial, -minor / radial],
            [-minor / radial, 1 / across, -contraction / across],
            [-minor / radial, -contraction / across, 1 / across],
        ]
    )
    c = np.linalg.inv(compliance)
    mesh = Sheet((boxes, boxes), nodes, bent, curved=True)
    shear = across / 2 / (1 + contraction)
    material = f"YT {radial} {across} {across} NT {minor} {contraction} {minor} G {SHEAR} {shear!r} {SHEAR}"
    # the third axis of the frame is y, and its first leads away from it
    frame = ".FRAME I 2 SPH V1 1 0 0 V2 0 0 -1"
    deck = [mesh.text("AXIS", material), *loads(mesh, "low FIX C 2", "high FIX C 1", frame=frame, rise=0)]
    found, _ = solved(deck, folder)
    product = 2 * (c[1, 1] + c[1, 2] - c[0, 1]) / c[0, 0]
    powers = np.roots([1, 1, -product])
    ends = np.array([[(c[0, 0] * n + 2 * c[0, 1]) * r ** (n - 1) for n in powers] for r in (INNER, OUTER)])
    factors = np.linalg.solve(ends, [-PRESSURE, 0])
    radius, direction = polar(mesh.points)
    expected = sum(a * radius**n for a, n in zip(factors, powers, strict=True))
    return relative((found[:, :2] * direction).sum(axis=1), expected)


def bent(u: np.ndarray) -> np.ndarray:
    """The quarter of a ring, of the unit square. Lines along the radius are bent, so that few cells lie in
    the axes of their material."""
    radius = INNER + (OUTER - INNER) * u[0]
    angle = np.pi / 2 * (u[1] + 0.1 * np.sin(np.pi * u[0]) * np.sin(np.pi * u[1]))
    return radius * np.array([np.cos(angle), np.sin(angle)])


def loads(mesh, *supports: str, frame: str = ".FRAME I 2 CYL", rise: float = RISE) -> list[str]:
    """Axes, supports, pressure in the bore, temperature. A support: the name of a group, and what it does."""
    return [
        frame,
        '.AEL GROUP "all" FRAME 2\n.SEL',
        mesh.group(3, "low", mesh.nodes(lambda u: u[1] == 0)),
        mesh.group(4, "high", mesh.nodes(lambda u: u[1] == 1)),
        mesh.group(6, "nodes", mesh.nodes(lambda u: True)),
        *mesh.group_of_faces(5, "bore", lambda u: u[0] == 0),
        ".CLM",
        *(' GROUP "{}" {} {} {}'.format(*support.split()) for support in supports),
        f' GROUP "bore" PRE V {PRESSURE}',
        f' GROUP "nodes" TEMP V {rise}' if rise else "",
    ]


def solved(deck: list[str], folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Displacements and stresses at nodes, of linear statics."""
    result = run("\n".join([*deck, ".FIN 1\n"]), folder)
    with h5py.File(result.file) as file:
        last = max(file["nodes/STRESS"])
        return file[f"fields/displacement/{last}"][:], file[f"nodes/STRESS/{last}"][:]


def polar(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Radius in the plane of x and y, and the direction away from the axis."""
    radius = np.hypot(points[:, 0], points[:, 1])
    return radius, points[:, :2] / radius[:, None]


def relative(found: np.ndarray, expected: np.ndarray) -> float:
    return float(np.sqrt(np.mean((found - expected) ** 2)) / np.abs(expected).max())
