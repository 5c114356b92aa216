# SPDX-License-Identifier: BSD-3-Clause
"""`engrane inertia`: mass, centre and tensor of meshed parts against closed forms."""

from __future__ import annotations

from pathlib import Path

import meshio
import numpy as np
import pytest
from engrane_post.mass_properties import MassProperties, of_mesh, read

BOX = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], float)
BOX_QUADS = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
BOX_TRIANGLES = np.concatenate([BOX_QUADS[:, [0, 1, 2]], BOX_QUADS[:, [0, 2, 3]]])
SIDES, CORNER = np.array([2.0, 0.5, 1.25]), np.array([-7.0, 3.0, 11.0])


def box_tensor(mass: float, sides: np.ndarray) -> np.ndarray:
    return mass / 12 * np.diag([sides @ sides - s * s for s in sides])


def agree(
    body: MassProperties, mass: float, center: np.ndarray, tensor: np.ndarray, to: float = 1e-12
) -> None:
    assert body.mass == pytest.approx(mass, rel=to)
    assert np.abs(body.center - center).max() < to * max(1.0, np.abs(center).max())
    assert np.abs(body.tensor - tensor).max() < to * np.abs(tensor).max()


def turn() -> np.ndarray:
    """Some rotation."""
    q, _ = np.linalg.qr(np.array([[1.0, 2, 3], [-2, 1, 0.5], [0.3, -1, 2]]))
    return q * np.sign(np.linalg.det(q))


@pytest.mark.parametrize(
    "cells",
    [
        {"triangle": BOX_TRIANGLES},
        {"quad": BOX_QUADS},
        {"hexahedron": np.arange(8)[None, :]},
        {"wedge": np.array([[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]])},
        {"tetra": np.array([[0, 1, 3, 4], [1, 2, 3, 6], [1, 6, 4, 5], [3, 4, 6, 7], [1, 3, 4, 6]])},
        {"pyramid": np.array([[0, 1, 2, 3, 4], [1, 5, 6, 2, 4], [2, 6, 7, 3, 4]])},
    ],
    ids=lambda cells: next(iter(cells)),
)
def test_box(cells: dict[str, np.ndarray]) -> None:
    """m/12 (b2 + c2), turned and far from the origin; a skewed box by the second moments' transformation."""
    R = turn()
    density, mass = 7850.0, 7850 * SIDES.prod()
    body = of_mesh((BOX * SIDES) @ R.T + CORNER, cells, density)
    agree(body, mass, R @ (SIDES / 2) + CORNER, R @ box_tensor(mass, SIDES) @ R.T, 1e-11)
    assert not body.warnings
    A = np.array([[2, 0.3, -0.2], [0.1, 1.5, 0.4], [0, -0.6, 1.1]])
    second = np.linalg.det(A) / 12 * A @ A.T  # of x xT about the centre
    body = of_mesh(BOX @ A.T, cells, 1.0)
    agree(body, np.linalg.det(A), A @ np.full(3, 0.5), np.trace(second) * np.eye(3) - second)


def test_tetrahedron() -> None:
    """The standard simplex: integrals of x2 are 1/60 and of xy 1/120 about its corner."""
    corner = np.full((3, 3), 1 / 120) + np.eye(3) / 120
    center = np.full(3, 0.25)
    second = corner - np.outer(center, center) / 6
    expected = np.trace(second) * np.eye(3) - second
    points = np.r_[np.zeros((1, 3)), np.eye(3)]
    agree(of_mesh(points, {"tetra": np.array([[0, 1, 2, 3]])}, 1.0), 1 / 6, center, expected)
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    agree(of_mesh(points, {"triangle": faces}, 1.0), 1 / 6, center, expected)


def sphere(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Unit sphere by rings."""
    polar, around = np.pi * np.arange(1, n) / n, 2 * np.pi * np.arange(2 * n) / (2 * n)
    ring = np.stack([np.outer(np.sin(polar), f(around)) for f in (np.cos, np.sin)], axis=-1)
    points = np.concatenate([ring, np.broadcast_to(np.cos(polar)[:, None, None], (n - 1, 2 * n, 1))], axis=-1)
    points = np.r_[points.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]]
    m, top, bottom = 2 * n, (n - 1) * 2 * n, (n - 1) * 2 * n + 1
    faces = []
    for j in range(m):
        k = (j + 1) % m
        faces.append([top, j, k])
        faces.append([bottom, (n - 2) * m + k, (n - 2) * m + j])
        for i in range(n - 2):
            a, b = i * m, (i + 1) * m
            faces += [[a + j, b + j, b + k], [a + j, b + k, a + k]]
    return points, np.array(faces)


def test_sphere() -> None:
    """2/5 m r2, which inscribed facets approach with the square of their size."""
    error = []
    for n in (16, 32, 64):
        points, faces = sphere(n)
        body = of_mesh(points * 3 + np.array([1, 2, 3]), {"triangle": faces}, 2.0)
        assert not body.warnings
        mass = 2 * 4 / 3 * np.pi * 27
        error.append([1 - body.mass / mass, 1 - np.trace(body.tensor) / (3 * 0.4 * mass * 9)])
        assert np.abs(body.center - [1, 2, 3]).max() < 1e-12
    assert np.log2(np.array(error[:-1]) / error[1:]) == pytest.approx(np.full((2, 2), 2.0), abs=0.02)
    assert np.abs(error[-1]).max() < 5e-3


def test_offset_cylinder(tmp_path: Path) -> None:
    """A prism over a regular polygon of n sides: area n/2 r2 sin(2 PI/n), polar moment n/24 r4 sin(2 PI/n)
    (4 + 2 cos(2 PI/n)), half of it about each axis across. From an STL, whose triangles share no points."""
    n, r, h = 48, 0.3, 2.0
    a = 2 * np.pi * np.arange(n) / n
    rim = np.stack([r * np.cos(a), r * np.sin(a)], axis=-1)
    points = np.r_[np.c_[rim, np.zeros(n)], np.c_[rim, np.full(n, h)], [[0, 0, 0], [0, 0, h]]]
    faces = []
    for j in range(n):
        k = (j + 1) % n
        faces += [[2 * n, k, j], [2 * n + 1, n + j, n + k], [j, k, n + k], [j, n + k, n + j]]
    place = np.array([4.0, -2.0, 0.5])
    file = tmp_path / "cylinder.stl"
    meshio.write_points_cells(file, points + place, [("triangle", np.array(faces))])
    body = of_mesh(*read(file), 7850.0)
    area = n / 2 * r**2 * np.sin(2 * np.pi / n)
    polar = n / 24 * r**4 * np.sin(2 * np.pi / n) * (4 + 2 * np.cos(2 * np.pi / n))
    mass = 7850 * area * h
    across = 7850 * h * polar / 2 + mass * h**2 / 12
    expected = np.diag([across, across, 7850 * h * polar])
    assert not body.warnings
    agree(body, mass, place + np.array([0, 0, h / 2]), expected, 1e-6)  # STL: single precision


def test_warnings() -> None:
    opened = of_mesh(BOX, {"triangle": BOX_TRIANGLES[:-1]}, 1.0)
    assert "open: 3 edges" in opened.warnings[0]
    flipped = BOX_TRIANGLES.copy()
    flipped[3] = flipped[3, ::-1]
    assert (
        "3 edges join triangles that face opposite ways"
        in of_mesh(BOX, {"triangle": flipped}, 1.0).warnings[0]
    )
    inverted = of_mesh(BOX, {"triangle": BOX_TRIANGLES[:, ::-1]}, 1.0)
    assert "inside out" in inverted.warnings[0]
    agree(inverted, 1, np.full(3, 0.5), box_tensor(1, np.ones(3)))
    cell = of_mesh(BOX, {"hexahedron": np.array([[4, 5, 6, 7, 0, 1, 2, 3]])}, 1.0)
    assert "1 of 1 cells" in cell.warnings[0]
    agree(cell, 1, np.full(3, 0.5), box_tensor(1, np.ones(3)))


def test_hole() -> None:
    """A surface inside, seen from the hollow, takes its volume away."""
    inner = BOX * 0.5 + 0.1
    cells = {"triangle": np.r_[BOX_TRIANGLES, BOX_TRIANGLES[:, ::-1] + 8]}
    body = of_mesh(np.r_[BOX, inner], cells, 1.0)
    center = (np.full(3, 0.5) - 0.125 * np.full(3, 0.35)) / 0.875
    assert not body.warnings
    assert body.mass == pytest.approx(0.875)
    assert body.center == pytest.approx(center)


def test_command(tmp_path: Path, command) -> None:
    file = tmp_path / "part.stl"
    meshio.write_points_cells(file, BOX * np.array([200, 100, 50]), [("triangle", BOX_TRIANGLES)])
    status, out, err = command(
        "inertia", file, "--density", "2700", "--scale", "0.001", "-o", tmp_path / "p.dat"
    )
    assert (status, err) == (0, "")
    assert "mass     2.7" in out and "RIGID N" in out
    words = (tmp_path / "p.dat").read_text(encoding="utf-8").replace("$", "").split()
    numbers = [float(w) for w in words[words.index("M") :] if w not in ("M", "CG", "J")]
    tensor = box_tensor(2.7, np.array([0.2, 0.1, 0.05]))
    assert numbers == pytest.approx([2.7, 0.1, 0.05, 0.025, *np.diag(tensor), 0, 0, 0], rel=1e-7, abs=1e-12)
    status, out, _ = command("inertia", file, "--mass", "5", "--move", "1", "0", "0")
    assert status == 0 and "mass     5\n" in out and "centre   101 50 25" in out


def test_command_faults(tmp_path: Path, command) -> None:
    file = tmp_path / "part.stl"
    meshio.write_points_cells(file, BOX, [("triangle", BOX_TRIANGLES)])
    for words, message in (
        ((file,), "Give the density of the part"),
        ((file, "--density", "1", "--mass", "1"), "Give the density of the part"),
        ((file, "--density", "-1"), "--density must be above 0."),
        ((tmp_path / "none.stl", "--density", "1"), "There is no file"),
    ):
        status, _, err = command("inertia", *words)
        assert status == 1 and message in err
    (tmp_path / "text.stl").write_text("hello")
    assert command("inertia", tmp_path / "text.stl", "--density", "1")[0] == 1
    (tmp_path / "text.what").write_text("hello")
    assert command("inertia", tmp_path / "text.what", "--density", "1")[0] == 1
    meshio.write_points_cells(
        tmp_path / "flat.stl", BOX[:4], [("triangle", np.array([[0, 1, 2], [0, 2, 3]]))]
    )
    status, _, err = command("inertia", tmp_path / "flat.stl", "--density", "1")
    assert status == 1 and "encloses no volume" in err
