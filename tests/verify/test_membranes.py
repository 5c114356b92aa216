# SPDX-License-Identifier: BSD-3-Clause
"""Membranes: a pressed disc, a balloon, a drum, a distorted patch, against closed forms."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from runs import run


class Mesh:
    """Triangles of 6 nodes on a fine lattice: rings of a disc, or of one face of an octahedron."""

    def __init__(self, rings: int, sectors: int, place) -> None:
        self.rings, self.sectors, self.place = rings, sectors, place
        self.ids: dict[tuple[int, int, int], int] = {}
        self.points: list[np.ndarray] = []
        self.cells = [
            cell
            for s in range(sectors)
            for k in range(rings)
            for i in range(k + 1)
            for cell in self._cells(s, k, i)
        ]

    def _cells(self, s: int, k: int, i: int):
        yield self._cell(s, (k, i), (k + 1, i), (k + 1, i + 1))
        if i < k:
            yield self._cell(s, (k, i), (k + 1, i + 1), (k, i + 1))

    def _cell(self, s: int, *corners: tuple[int, int]) -> list[int]:
        doubled = [2 * np.array(c) for c in corners]
        middles = [(doubled[j] + doubled[(j + 1) % 3]) // 2 for j in range(3)]
        return [self._node(s, *map(int, c)) for c in doubled + middles]

    def _node(self, s: int, k: int, i: int) -> int:
        if self.sectors > 1:  # the last of a sector is the first of the next
            s, i = (0, 0) if k == 0 else ((s + 1) % self.sectors, 0) if i == k else (s, i)
        key = (s, k, i)
        if key not in self.ids:
            self.ids[key] = len(self.points) + 1
            self.points.append(self.place(s, k / (2 * self.rings), i / k if k else 0.0))
        return self.ids[key]

    def text(self) -> str:
        rows = (f" I {n + 1} X {x:.16g} {y:.16g} {z:.16g}" for n, (x, y, z) in enumerate(self.points))
        return "\n".join(rows)

    def membranes(self, rest: str) -> str:
        rows = (f" I {e + 1} MEMBRANE N {' '.join(map(str, c))} {rest}" for e, c in enumerate(self.cells))
        return "\n".join(rows)


def disc(s: int, r: float, u: float) -> np.ndarray:
    angle = np.pi / 3 * (s + u)
    return np.array([r * np.cos(angle), r * np.sin(angle), 0])


def octant(_: int, r: float, u: float) -> np.ndarray:
    p = np.array([r * (1 - u), r * u, 1 - r])
    return p / np.linalg.norm(p)


def planes_held(mesh: Mesh) -> str:
    """What holds the nodes of an octant in its planes of symmetry."""
    return "\n".join(
        f" FIX NOEUD {n + 1} C {' '.join(str(c + 1) for c in range(3) if abs(p[c]) < 1e-12)}"
        for n, p in enumerate(mesh.points)
        if (abs(p) < 1e-12).any()
    )


def displacement(file: Path) -> np.ndarray:
    with h5py.File(file) as results:
        frames = results["fields/displacement"]
        return np.asarray(frames[sorted(frames)[-1]])


def pressed_disc(rings: int, folder: Path) -> tuple[float, float]:
    """Height of the middle over a (q a/E h)^(1/3), and stress there over (E q² a²/h²)^(1/3)."""
    mesh = Mesh(rings, 6, disc)
    load = 1e-7  # q a/E h: so flat that Hencky's small slopes hold to 1e-5
    size = load ** (1 / 3)
    rim = [n + 1 for n, p in enumerate(mesh.points) if p[0] ** 2 + p[1] ** 2 > 1 - 1e-9]
    inner = [n + 1 for n in range(len(mesh.points)) if n + 1 not in set(rim)]
    held = "\n".join(f" FIX NOEUD {n} C 1 2 3" for n in rim)
    domes = "\n".join(
        f" DEP NOEUD {n} C 3 V {0.65 * size * (1 - mesh.points[n - 1] @ mesh.points[n - 1]):.8g}"
        for n in inner
    )
    solved = run(
        f""".NOE
{mesh.text()}
.MAT
 I 1 YT 1. NT 0.3
.MCE
{mesh.membranes(f"MAT 1 THICK 1. PRESSURE {load}")}
.CLM
{held}
.INI
{domes}
.SAM TYPE STATIC
.SUB TF 1 H 1
.FIN 1
""",
        folder,
    )
    middle = mesh.ids[(0, 0, 0)]
    with h5py.File(solved.file) as results:
        frames = results["points/MEMBRANE_STRESS"]
        stress = np.asarray(frames[sorted(f for f in frames if f.isdigit())[-1]])
    # the first cell has a corner in the middle, and three points
    return displacement(solved.file)[middle - 1, 2] / size, float(stress[:3].mean() / load ** (2 / 3))


def test_hencky(tmp_path: Path) -> None:
    """The clamped disc of Hencky (1915), numbers for a Poisson's ratio of 0.3 from his series."""
    found = np.array([pressed_disc(rings, tmp_path) for rings in (4, 8, 16)])
    errors = abs(found - [0.653443344693, 0.43110101611])
    assert errors[:, 0] == pytest.approx([1.36e-3, 3.6e-4, 9.1e-5], rel=0.03)
    assert np.log2(errors[:-1] / errors[1:]) == pytest.approx(2, abs=0.15)
    limit = found[2] + (found[2] - found[1]) / 3
    assert limit == pytest.approx([0.653443344693, 0.43110101611], abs=2e-5)


def balloon(rings: int, folder: Path) -> np.ndarray:
    """Radii over the first of a balloon that is blown up to 1.5 times its size, all nodes of an octant."""
    mesh = Mesh(rings, 1, octant)
    stretch, young, poisson, thin = 1.5, 1.0, 0.3, 0.01
    pressure = thin * young * (stretch**2 - 1) / ((1 - poisson) * stretch)
    held = planes_held(mesh)
    solved = run(
        f""".NOE
{mesh.text()}
.MAT
 I 1 YT {young} NT {poisson}
.MCE
{mesh.membranes(f"MAT 1 THICK {thin} PRESSURE {pressure:.16g} NF 1")}
.CLM
{held}
.FCT
 I 1 RAMP 0 0 1 1
.SAM TYPE STATIC
.SUB TF 1 H 0.25
.FIN 1
""",
        folder,
    )
    return np.linalg.norm(np.array(mesh.points) + displacement(solved.file), axis=1)


def test_balloon(tmp_path: Path) -> None:
    """p = 2 S h/(R l) of a sphere, with S = E (l² - 1)/2(1 - v): the pressure follows the surface."""
    errors = [abs(balloon(rings, tmp_path) - 1.5).max() for rings in (2, 4, 8)]
    assert errors == pytest.approx([1.94e-2, 2.57e-3, 4.1e-4], rel=0.03)


def grid(cells: int, nodes: int) -> tuple[np.ndarray, list[list[int]]]:
    """Places in the unit square, distorted inside, and the nodes of cells of 3, 6, 4 or 8 nodes."""
    fine = 2 * cells
    places = np.array([[i / fine, j / fine] for j in range(fine + 1) for i in range(fine + 1)])
    u, v = places.T
    bump = 0.08 * np.sin(np.pi * u) * np.sin(np.pi * v)
    places += np.column_stack([bump * np.cos(5 * u + 3 * v), bump * np.sin(4 * v - u)])

    def at(i: int, j: int) -> int:
        return i + j * (fine + 1) + 1

    found = []
    for i in range(0, fine, 2):
        for j in range(0, fine, 2):
            c = [(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)]
            for corners in [c] if nodes in (4, 8) else [[c[0], c[1], c[2]], [c[0], c[2], c[3]]]:
                n = len(corners)
                sides = [(corners[k], corners[(k + 1) % n]) for k in range(n)]
                middles = [((a[0] + b[0]) // 2, (a[1] + b[1]) // 2) for a, b in sides]
                for (a, b), m in zip(sides, middles, strict=True):  # straight sides
                    places[at(*m) - 1] = (places[at(*a) - 1] + places[at(*b) - 1]) / 2
                found.append([at(*p) for p in corners + (middles if nodes in (6, 8) else [])])
    return places, found


@pytest.mark.parametrize("nodes", [3, 6, 4, 8])
def test_patch(nodes: int, tmp_path: Path) -> None:
    """Cells in a plane across space whose rim is stretched and sheared evenly: so is all inside."""
    places, cells = grid(2, nodes)
    used = sorted({n for c in cells for n in c})
    plane = np.linalg.qr(np.array([[1.0, 2, 3], [0.3, -1, 0.5]]).T)[0].T
    stretch = np.array([[1.2, 0.1], [0.05, 0.9]])
    reference, wanted = places @ plane, places @ stretch.T @ plane
    rim = [n for n in used if ((abs(places[n - 1]) < 1e-12) | (abs(places[n - 1] - 1) < 1e-12)).any()]
    across = np.cross(plane[0], plane[1])
    moves = "\n".join(
        f" DEP NOEUD {n} C {c + 1} V {(wanted - reference)[n - 1, c]:.16g} NF 1"
        for n in rim
        for c in range(3)
    )
    elements = "\n".join(
        f" I {e + 1} MEMBRANE N {' '.join(map(str, c))} MAT 1 THICK 0.1 TENSION 5"
        for e, c in enumerate(cells)
    )
    rows = "\n".join(f" I {n} X {' '.join(f'{x:.16g}' for x in reference[n - 1])}" for n in used)
    solved = run(
        f""".NOE
{rows}
.MAT
 I 1 YT 100. NT 0.3
.MCE
{elements}
.CLM
{moves}
.FCT
 I 1 RAMP 0 0 1 1
.SAM TYPE STATIC
.SUB TF 1 H 0.5
.FIN 1
""",
        tmp_path,
    )
    found = displacement(solved.file) - (wanted - reference)[np.array(used) - 1]
    assert abs(found).max() < 1e-11
    assert abs(found @ across).max() < 1e-11


def drum(cells: int, folder: Path) -> float:
    """What is left of the first form of a square skin under tension after a quarter of its period."""
    tension, density, height = 100.0, 1.0, 1e-5
    places, membranes = grid(cells, 8)
    used = sorted({n for c in membranes for n in c})
    quarter = float(1 / (2 * np.sqrt(2 * tension / density)))  # w = pi √(2 s/rho)
    form = height * np.sin(np.pi * places[:, 0]) * np.sin(np.pi * places[:, 1])
    rim = [n for n in used if form[n - 1] < 1e-12]
    rows = "\n".join(f" I {n} X {places[n - 1][0]:.16g} {places[n - 1][1]:.16g} 0" for n in used)
    elements = "\n".join(
        f" I {e + 1} MEMBRANE N {' '.join(map(str, c))} MAT 1 THICK 0.01 TENSION {tension}"
        for e, c in enumerate(membranes)
    )
    held = "\n".join(f" FIX NOEUD {n} C 1 2 3" for n in rim)
    begun = "\n".join(f" DEP NOEUD {n} C 3 V {form[n - 1]:.12g}" for n in used if n not in rim)
    solved = run(
        f""".NOE
{rows}
.MAT
 I 1 YT 1000. NT 0.3 M {density}
.MCE
{elements}
.CLM
{held}
.INI
{begun}
.SAM TYPE DYNAMIC SCHEME RADAU SOLVER KLU
.SUB TF {quarter!r} H {quarter / 20!r}
.FIN 1
""",
        folder,
    )
    shape = form[np.array(used) - 1]
    return float(displacement(solved.file)[:, 2] @ shape / (shape @ shape))


def test_drum(tmp_path: Path) -> None:
    """The form passes through zero where the frequency is that of the skin."""
    left = [abs(drum(cells, tmp_path)) for cells in (2, 4, 8)]
    assert left[0] < 0.02
    assert left[1] < 2e-3
    assert left[2] < 1e-4


PRESSURES = {
    "by number": (' GROUP 1 NOM "skin" MAILLES\n  I 1 2', ' PRE GROUP "skin" V 4.'),
    "of all": (' GROUP 1 NOM "skin" MAILLES TOUT', ' PRE GROUP "skin" V 4.'),
    "in a box": (' GROUP 1 NOM "skin" MAILLES BOITE 0 2 0 2 0 0.1', ' PRE GROUP "skin" V 4.'),
    "of a union": (
        ' GROUP 1 NOM "a" MAILLES\n  I 1\n GROUP 2 NOM "b" MAILLES\n  I 2\n'
        ' GROUP 3 NOM "skin" MAILLES UNION "a" "b"',
        ' PRE GROUP "skin" V 4.',
    ),
    "of faces": (' GROUP 1 NOM "skin" FACES\n  I 1 1\n  I 2 1', ' PRE GROUP "skin" V 4.'),
    "one by one": ("", " FACE I 1 1 PRE V 4.\n FACE I 2 1 PRE V 4."),
}


@pytest.mark.parametrize("way", PRESSURES)
def test_pressure_on_elements(way: str, tmp_path: Path) -> None:
    """A pressure by PRE on elements MEMBRANE is the same as their own."""
    group, load = PRESSURES[way]

    def sheet(own: str, loads: str, groups: str) -> np.ndarray:
        name = "a" if own else "b"
        solved = run(
            f""".NOE
 I 1 X 0 0 0
 I 2 X 1 0 0
 I 3 X 2 0 0
 I 4 X 0 1 0
 I 5 X 1 1.1 0
 I 6 X 2 1 0
.MAT
 I 1 YT 1E3 NT 0.3
.MCE
 I 1 MEMBRANE N 1 2 5 4 MAT 1 THICK 1 TENSION 10 {own}
 I 2 MEMBRANE N 2 3 6 5 MAT 1 THICK 1 TENSION 10 {own}
 I 7 SPRING N 2 5 K 2.
.SEL
{groups}
.CLM
 FIX NOEUD 1 3 4 6 C 1 2 3
{loads}
.SAM TYPE STATIC
.SUB TF 1 H 1
.FIN 1
""",
            tmp_path,
            name,
        )
        return displacement(solved.file)

    expected, found = sheet("PRESSURE 4.", "", ""), sheet("", load, group)
    assert expected[1, 2] > 0.01
    assert found == pytest.approx(expected, abs=1e-12)
