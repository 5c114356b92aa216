# SPDX-License-Identifier: BSD-3-Clause
"""Volume, centre and inertia tensor of a body of one density from its mesh: a closed surface, solid cells.

Everything is a sum over tetrahedra: those of the cells, or those that the triangles of a surface make with
one point (the divergence theorem), where a tetrahedron seen from inside counts negative. For a tetrahedron
with the corners p_0 … p_3, volume V and sum of corners s: the integral of x xᵀ is V/20 (s sᵀ + Σ p_i p_iᵀ).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .errors import UserError
from .mesh_files import open_mesh

#: solid cells as tetrahedra of their corners; quadratic cells by their corners, which keeps flat faces exact
HEXAHEDRON = ((0, 1, 3, 4), (1, 2, 3, 6), (1, 6, 4, 5), (3, 4, 6, 7), (1, 3, 4, 6))
SOLIDS = {
    "tetra": ((0, 1, 2, 3),),
    "pyramid": ((0, 1, 2, 4), (0, 2, 3, 4)),
    "wedge": ((0, 1, 2, 3), (1, 2, 3, 4), (2, 3, 4, 5)),
    "hexahedron": HEXAHEDRON,
}
SURFACES = {"triangle": ((0, 1, 2),), "quad": ((0, 1, 2), (0, 2, 3))}
LINEAR = {
    "tetra10": "tetra",
    "pyramid13": "pyramid",
    "wedge15": "wedge",
    "wedge18": "wedge",
    "hexahedron20": "hexahedron",
    "hexahedron27": "hexahedron",
    "triangle6": "triangle",
    "quad8": "quad",
    "quad9": "quad",
}


@dataclass
class MassProperties:
    """Of a body: the tensor about its centre, in the mesh's axes, with Jxy = -∫ xy dm off its diagonal."""

    mass: float
    center: np.ndarray
    tensor: np.ndarray
    volume: float
    warnings: list[str] = field(default_factory=list)

    def principal(self) -> tuple[np.ndarray, np.ndarray]:
        """Principal moments, and their axes as columns of a right-handed frame."""
        values, axes = np.linalg.eigh(self.tensor)
        axes[:, 2] *= np.sign(np.linalg.det(axes))
        return values, axes


def read(path: str | Path) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Points and cells by kind of any mesh that meshio reads; quadratic cells by their corners."""
    mesh = open_mesh(path)
    points = np.zeros((len(mesh.points), 3))
    points[:, : mesh.points.shape[1]] = mesh.points
    cells: dict[str, np.ndarray] = {}
    for block in mesh.cells:
        kind = LINEAR.get(block.type, block.type)
        if kind in SOLIDS or kind in SURFACES:
            corners = np.asarray(block.data)[:, : {"quad": 4, "triangle": 3}.get(kind, 8)]
            corners = corners[:, : {"tetra": 4, "pyramid": 5, "wedge": 6}.get(kind, 8)]
            cells[kind] = np.concatenate([cells[kind], corners]) if kind in cells else corners
    return points, cells


def of_mesh(points: np.ndarray, cells: dict[str, np.ndarray], density: float) -> MassProperties:
    """From solid cells when there are any, else from the surface."""
    if points.ndim != 2 or not len(points):
        raise UserError("The mesh has no nodes.")
    solids = {k: c for k, c in cells.items() if k in SOLIDS and len(c)}
    if solids:
        return of_solids(points, solids, density)
    faces = [c[:, list(t)] for k, c in cells.items() if k in SURFACES for t in SURFACES[k]]
    if not faces or not sum(len(f) for f in faces):
        raise UserError("The mesh has neither solid cells nor triangles or quadrilaterals of a surface.")
    return of_surface(points, np.concatenate(faces), density)


def of_solids(points: np.ndarray, cells: dict[str, np.ndarray], density: float) -> MassProperties:
    """A cell numbered the other way round counts as what it fills."""
    parts, turned, count = [], 0, 0
    for kind, corners in cells.items():
        pieces = np.stack([points[corners[:, list(t)]] for t in SOLIDS[kind]], axis=1)
        volume = signed_volumes(pieces)
        inside_out = volume.sum(axis=1) < 0
        turned += int(inside_out.sum())
        count += len(corners)
        parts.append((pieces.reshape(-1, 4, 3), (volume * np.where(inside_out, -1, 1)[:, None]).ravel()))
    warnings = []
    if turned:
        warnings.append(
            f"{turned} of {count} cells are numbered inside out; they are counted as they fill space."
        )
    return integrate(
        np.concatenate([p for p, _ in parts]), np.concatenate([v for _, v in parts]), density, warnings
    )


def of_surface(points: np.ndarray, triangles: np.ndarray, density: float) -> MassProperties:
    """By the divergence theorem, with warnings for what makes it wrong or doubtful."""
    triangles = weld(points, triangles)
    warnings = []
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    low, high = edges.min(axis=1), edges.max(axis=1)
    _, where = np.unique(np.stack([low, high], axis=-1), axis=0, return_inverse=True)
    where = np.ravel(where)
    met = np.bincount(where)
    ways = np.bincount(where, weights=np.where(edges[:, 0] < edges[:, 1], 1.0, -1.0))
    opened = int(np.sum(met % 2))
    if opened:
        warnings.append(
            f"the surface is open: {opened} edges have a triangle on one side only; the numbers depend on "
            "how the hole is closed."
        )
    crossed = int(np.sum((met % 2 == 0) & (ways != 0)))
    if crossed:
        warnings.append(
            f"{crossed} edges join triangles that face opposite ways: part of the surface is inside out, and "
            "the numbers are wrong."
        )
    corners = points[triangles]
    apex = 0.5 * (corners.min(axis=(0, 1)) + corners.max(axis=(0, 1)))  # near the body: least cancellation
    pieces = np.concatenate([np.broadcast_to(apex, (len(triangles), 1, 3)), corners], axis=1)
    volume = signed_volumes(pieces)
    if volume.sum() < 0:
        volume = -volume
        warnings.append("all of the surface is inside out; it is counted as what it encloses.")
    return integrate(pieces, volume, density, warnings)


def weld(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Triangles by points that are one (STL repeats them), without those that have shrunk to a line."""
    size = np.ptp(points[np.unique(triangles)], axis=0).max() or 1.0
    _, one = np.unique(np.rint(points / (1e-7 * size)), axis=0, return_inverse=True)
    out = np.ravel(one)[triangles]
    out = out[(out[:, 0] != out[:, 1]) & (out[:, 1] != out[:, 2]) & (out[:, 2] != out[:, 0])]
    first = np.zeros(np.max(one) + 1, int)
    first[np.ravel(one)] = np.arange(len(points))
    return first[out]


def signed_volumes(tetrahedra: np.ndarray) -> np.ndarray:
    """Of tetrahedra (… x 4 x 3)."""
    a, b, c = (tetrahedra[..., i, :] - tetrahedra[..., 0, :] for i in (1, 2, 3))
    return np.einsum("...i,...i", np.cross(a, b), c) / 6


def integrate(
    tetrahedra: np.ndarray, volume: np.ndarray, density: float, warnings: list[str]
) -> MassProperties:
    """Sums over tetrahedra (n x 4 x 3) of these volumes, about a point near the body first."""
    total = float(volume.sum())
    extent = float(np.ptp(tetrahedra.reshape(-1, 3), axis=0).max())
    if not total > 1e-12 * extent**3:
        raise UserError("The mesh encloses no volume; a body needs a closed surface or solid cells.")
    near = tetrahedra.reshape(-1, 3).mean(axis=0)
    corners = tetrahedra - near
    sums = corners.sum(axis=1)
    center = volume @ sums / (4 * total)
    second = np.einsum("n,ni,nj->ij", volume, sums, sums) + np.einsum(
        "n,nki,nkj->ij", volume, corners, corners
    )
    second = second / 20 - total * np.outer(center, center)
    tensor = density * (np.trace(second) * np.eye(3) - second)
    return MassProperties(density * total, near + center, tensor, total, warnings)
