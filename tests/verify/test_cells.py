# SPDX-License-Identifier: BSD-3-Clause
"""The brackets of decks/elements/structural solved once more with shape functions from monomials, dense
matrices and quadrature of its own: displacements of all nodes, and stresses at three points."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import h5py
import numpy as np
import pytest
from engrane_post import Results
from engrane_post.errors import UserError
from engrane_post.scene import Scene
from engrane_post.view import direction
from runs import run

FOLDER = Path(__file__).parents[2] / "decks" / "elements" / "structural"

CORNERS = {"t": [(0, 0), (1, 0), (0, 1)], "q": [(-1, -1), (1, -1), (1, 1), (-1, 1)]}
POWERS = {
    3: [(0, 0), (1, 0), (0, 1)],
    6: [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)],
    4: [(0, 0), (1, 0), (0, 1), (1, 1)],
    8: [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (2, 1), (1, 2)],
}


def line_rule(points: int) -> list[tuple[float, float]]:
    return list(zip(*np.polynomial.legendre.leggauss(points), strict=True))


def square_rule(points: int) -> list[tuple[float, float, float]]:
    return [(x, y, v * w) for (y, v), (x, w) in itertools.product(line_rule(points), repeat=2)]


def triangle_rule() -> list[tuple[float, float, float]]:
    return [(1 / 6, 1 / 6, 1 / 6), (2 / 3, 1 / 6, 1 / 6), (1 / 6, 2 / 3, 1 / 6)]


class Shape:
    """Shape functions of a cell: the monomials that are one at a node and zero at the others."""

    def __init__(self, count: int) -> None:
        corners = [np.array(c, float) for c in CORNERS["t" if count in (3, 6) else "q"]]
        middles = [(a + b) / 2 for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
        self.powers = POWERS[count]
        nodes = corners + (middles if count > len(corners) else [])
        self.coefficients = np.linalg.inv([[x**i * y**j for i, j in self.powers] for x, y in nodes])
        self.stiffness = (
            [(1 / 3, 1 / 3, 0.5)] if count == 3 else triangle_rule() if count == 6 else square_rule(2)
        )
        self.load = triangle_rule() if count in (3, 6) else square_rule(3)

    def value(self, x: float, y: float) -> np.ndarray:
        return np.array([x**i * y**j for i, j in self.powers]) @ self.coefficients

    def slope(self, x: float, y: float) -> np.ndarray:
        along_x = [i * x ** max(i - 1, 0) * y**j for i, j in self.powers]
        along_y = [j * x**i * y ** max(j - 1, 0) for i, j in self.powers]
        return np.array([along_x, along_y]) @ self.coefficients


def strain_matrix(gradient: np.ndarray) -> np.ndarray:
    b = np.zeros((3, 2 * gradient.shape[1]))
    b[0, 0::2], b[1, 1::2] = gradient
    b[2, 0::2], b[2, 1::2] = gradient[1], gradient[0]
    return b


def strain_matrices(shape: Shape, places: np.ndarray) -> list[tuple[np.ndarray, float]]:
    """At each point of the stiffness: strains of displacements and, of four nodes, modes; its area."""
    found = []
    for x, y, weight in shape.stiffness:
        jacobian = shape.slope(x, y) @ places
        slope = shape.slope(x, y)
        if len(places) == 4:
            slope = np.hstack([slope, np.diag([-2 * x, -2 * y])])
        found.append((np.linalg.solve(jacobian, slope), weight * abs(np.linalg.det(jacobian))))
    if len(places) == 4:
        mean = sum(g[:, 4:] * area for g, area in found) / sum(area for _, area in found)
        for gradient, _ in found:
            gradient[:, 4:] -= mean
    return [(strain_matrix(g), area) for g, area in found]


class Bracket:
    """A deck of the translator, as far as the brackets go."""

    def __init__(self, text: str) -> None:
        number = r"(-?[\d.]+(?:e[+-]?\d+)?)"
        self.nodes = {
            int(i): (float(x), float(y)) for i, x, y in re.findall(rf" I (\d+) X {number} Y {number} Z", text)
        }
        self.index = {n: i for i, n in enumerate(self.nodes)}
        self.cells = {}
        for cell, row in re.findall(r" I (\d+) AT 1 0 N ([-\d ]+)", text):
            ids = [int(word) for word in row.split()]
            self.cells[int(cell)] = [n for n in ids if n > 0] + [-n for n in ids if n < 0]
        groups = {}
        for name, rows in re.findall(r'GROUP \d+ NOEUDS NOM "(.*?)"((?:\s+I \d+[^\n]*)+)', text):
            groups[name] = []
            for a, b, k in re.findall(r"I (\d+)(?: J (\d+) K (\d+))?", rows):
                groups[name] += range(int(a), int(b or a) + 1, int(k or 1))
        self.fixed = set()
        for name, components in re.findall(r'GROUP "(.*?)" FIX C ([\d ]+)', text):
            self.fixed |= {
                2 * self.index[n] + int(c) - 1 for n in groups[name] for c in components.split() if int(c) < 3
            }
        value = {key: float(re.search(rf"\n\s+{key} {number}", text)[1]) for key in ("YT", "NT", "M")}
        self.strain = "DEFO PLAN" in text
        self.thickness = 1.0 if self.strain else float(re.search(rf"THICK VAL {number}", text)[1])
        e, nu, self.density = value["YT"], value["NT"], value["M"]
        if self.strain:
            factor = e / ((1 + nu) * (1 - 2 * nu))
            self.law = factor * np.array([[1 - nu, nu, 0], [nu, 1 - nu, 0], [0, 0, (1 - 2 * nu) / 2]])
        else:
            self.law = e / (1 - nu**2) * np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]])
        self.gravity = np.array(
            [float(v) for v in re.search(rf"STRU ACC VAL {number} {number}", text).groups()]
        )
        self.pressures = [
            (int(c), int(k), float(p)) for c, k, p in re.findall(rf"ARETE I (\d+) (\d+) PRE V {number}", text)
        ]
        self.forces = [
            (int(n), int(c), float(v))
            for n, c, v in re.findall(rf"NOEUD (\d+) CHA\s+C (\d) V {number}", text)
        ]

    def condensed(self, shape: Shape, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Stiffness of the nodes, and the amplitudes of the modes that follow them."""
        full = sum(area * self.thickness * b.T @ self.law @ b for b, area in strain_matrices(shape, places))
        n = 2 * len(places)
        if full.shape[0] == n:
            return full, np.zeros((0, n))
        follow = -np.linalg.solve(full[n:, n:], full[n:, :n])
        return full[:n, :n] + full[:n, n:] @ follow, follow

    def solve(self) -> tuple[np.ndarray, dict[int, np.ndarray]]:
        """Displacements of all nodes, and of each cell the stresses at its points."""
        size = 2 * len(self.nodes)
        matrix, load = np.zeros((size, size)), np.zeros(size)
        shape = Shape(len(next(iter(self.cells.values()))))
        own = {}
        for cell, ids in self.cells.items():
            places = np.array([self.nodes[n] for n in ids])
            rows = np.array([2 * self.index[n] + c for n in ids for c in range(2)])
            stiffness, follow = self.condensed(shape, places)
            matrix[np.ix_(rows, rows)] += stiffness
            own[cell] = places, rows, follow
            for x, y, weight in shape.load:
                volume = weight * abs(np.linalg.det(shape.slope(x, y) @ places)) * self.thickness
                load[rows] += self.density * volume * np.outer(shape.value(x, y), self.gravity).ravel()
        for cell, side, pressure in self.pressures:
            self.add_pressure(own[cell], len(shape.powers), side, pressure, load)
        for node, component, value in self.forces:
            load[2 * self.index[node] + component - 1] += value
        free = np.array([i for i in range(size) if i not in self.fixed])
        u = np.zeros(size)
        u[free] = np.linalg.solve(matrix[np.ix_(free, free)], load[free])
        stresses = {}
        for cell, (places, rows, follow) in own.items():
            moves = np.concatenate([u[rows], follow @ u[rows]])
            stresses[cell] = np.array([self.law @ b @ moves for b, _ in strain_matrices(shape, places)])
        return u.reshape(-1, 2), stresses

    def add_pressure(self, own: tuple, count: int, side: int, pressure: float, load: np.ndarray) -> None:
        places, rows, _ = own
        corners = 3 if count in (3, 6) else 4
        members = [side - 1, side % corners] + ([corners + side - 1] if count > corners else [])
        local = [-1.0, 1.0, 0.0][: len(members)]
        for s, weight in line_rule(4):
            fits = [np.polyfit(local, np.eye(len(local))[i], len(local) - 1) for i in range(len(local))]
            value = np.array([np.polyval(f, s) for f in fits])
            tangent = np.array([np.polyval(np.polyder(f), s) for f in fits]) @ places[members]
            normal = np.array([tangent[1], -tangent[0]])
            if normal @ (places[members[:2]].mean(axis=0) - places[:corners].mean(axis=0)) < 0:
                normal = -normal
            for member, share in zip(members, value, strict=True):
                load[rows[2 * member : 2 * member + 2]] -= weight * pressure * self.thickness * share * normal


@pytest.mark.parametrize("kind", ["t3", "t6", "q4", "q8"])
@pytest.mark.parametrize("hypothesis", ["stress", "strain"])
def test_brackets(kind: str, hypothesis: str, tmp_path: Path) -> None:
    text = (FOLDER / f"cell_bracket_{kind}_{hypothesis}.dat").read_text()
    bracket = Bracket(text)
    displacements, stresses = bracket.solve()
    result = run(text, tmp_path)
    moments = result["run/LOAD_MOMENT_Z"][-1], result["run/GROUND_MOMENT_Z"][-1]
    assert abs(sum(moments)) < 1e-9 * abs(moments[0])
    with h5py.File(result.file) as file:
        assert not file["restart"].keys()  # linear statics cannot go on
        frame = sorted(file["fields/displacement"])[-1]
        found = file[f"fields/displacement/{frame}"][:, :2]
        # of one point in a cell the mean says all
        points = file[f"{'fields' if kind == 't3' else 'points'}/STRESS/{frame}"][:]
        elements = file["mesh/cell_elements" if kind == "t3" else "points/STRESS/elements"][:]
        types = {int(code) for code in file["mesh/topology"][:1]}
    assert np.abs(found - displacements).max() < 1e-9 * np.abs(displacements).max()
    scale = max(np.abs(s).max() for s in stresses.values())
    cells = list(stresses)
    for cell in (cells[0], cells[len(cells) // 2], cells[-1]):
        here = points[elements == cell]
        order = (
            np.argsort(here[:, 0]),
            np.argsort(stresses[cell][:, 0]),
        )  # the points have no order of their own
        assert np.abs(here[order[0]][:, [0, 1, 3]] - stresses[cell][order[1]]).max() < 1e-8 * scale
        across = 0.3 * (here[:, 0] + here[:, 1]) if hypothesis == "strain" else 0 * here[:, 0]
        assert np.abs(here[:, 2] - across).max() < 1e-12 * scale
    with Results(result.file) as results:
        means = results.cell_field("STRESS:XX", len(results.frame_times) - 1)
        with pytest.raises(UserError, match=r"it has .*VON_MISES"):
            results.cell_field("STRESS", 0)
        assert results.cell_field_unit("STRESS:XX") == "[mN/mm²]"
        eye, up = direction(Scene(results), [results.reference()])
        assert eye == pytest.approx([0, 0, 1]) and up == pytest.approx([0, 1, 0])  # straight before the plane
    expected = [stresses[cell][:, 0].mean() for cell in cells]
    assert np.abs(means[: len(cells)] - expected).max() < 1e-8 * scale
    assert types == {{"t3": 4, "q4": 5, "t6": 36, "q8": 37}[kind]}


# a bar of one cell
BAR = """.NOE
 I 1 X 0 Y 0
 I 2 X 100 Y 0
 I 3 X 100 Y 10
 I 4 X 0 Y 10
.MAI
 I 1 N 1 2 3 4
"""
WARMED = (
    BAR
    + """\
.SEL
 GROUP 1 MAILLES NOM "bar" TOUT
 GROUP 2 NOEUDS NOM "all" TOUT
.MAT
 I 1 BEHA "ELASTIC" YT 200000. NT 0.3 M 7.8E-9 A 1.2E-5
.HYP DEFO PLAN GROUP "bar"
.AEL
 GROUP "bar" MAT 1
.CLM
 NOEUD 1 4 FIX C 1
 NOEUD 1 FIX C 2
 GROUP "all" TEMP V 100. NF 1
.FCT
 I 1 STEP 0 0 1E-4 1
.SAM TYPE DYNAMIC
.SUB TF 2E-4 H {step}
"""
)


def test_warmth_does_work(tmp_path: Path) -> None:
    """A bar held at one end swings as it is warmed, in plane strain: the balance of energies closes to the
    second order of the step, and what is held along z, E (alpha T)**2/2, is most of the energy."""
    errors = []
    for step in (1e-6, 5e-7):
        result = run(WARMED.format(step=step), tmp_path)
        work = result["run/EXTERNAL_WORK"][-1]
        errors.append(abs(result["run/ENERGY_ERROR"][-1]) / work)
    assert errors[0] < 1e-4
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    assert work == pytest.approx(200000 * (1.2e-5 * 100) ** 2 / 2 * 1000, rel=0.1)


def tip_of_one_cell(load: float, folder: Path) -> float:
    """Over the load; the run must need no more than one correction behind the start."""
    deck = f"""{BAR}\
.SEL
 GROUP 1 MAILLES NOM "all" TOUT
.MAT
 I 1 BEHA "ELASTIC" YT 200000. NT 0.3
.HYP MEMB BIDIM GROUP "all"
.PHP GROUP "all" THICK VAL 1.
.AEL
 GROUP "all" MAT 1
.CLM
 NOEUD 1 4 FIX C 1 2
 NOEUD 2 CHA C 2 V {load}
.SAM DISPLACEMENTS SMALL
.SUB TF 1. H 1.
.FIN 1
"""
    solved = run(deck, folder)
    listing = solved.file.with_suffix(".lst").read_text(encoding="utf-8")
    assert re.search(r"1 steps, [01] Newton iterations", listing)
    with h5py.File(solved.file) as results:
        frames = results["fields/displacement"]
        return frames[sorted(frames)[-1]][1, 1] / load


def test_loads_of_any_size(tmp_path: Path) -> None:
    """Linear statics is linear, also where displacements are far larger than the model."""
    expected = tip_of_one_cell(1e4, tmp_path)
    for load in (1.0, 1e8):
        assert tip_of_one_cell(load, tmp_path) == pytest.approx(expected, rel=1e-11)


WARM = """
.NOE
 I 1 X 0 0
 I 2 X 0.1 0
 I 3 X 0.1 0.1
 I 4 X 0 0.1
.MAI
 I 1 N 1 2 3 4
.MAT
 I 1 BEHA "ELASTIC" YT 2.1E5 NT 0.3 M 7.85E-9 A 1.2E-5
.HYP MEMB BIDIM
.SEL
 GROUP 1 NOM "a" MAILLES TOUT
.PHP
 GROUP 1 THICK VAL 1.
.AEL
 I 1 MAT 1
.CLM
 FIX NOEUD 1 4 C 1 2
 TEMP NOEUD 1 A 4 V 80
.CHK
 RUN MASS V 7.85E-11 RTOL 1E-12
"""


def test_mass_of_a_warm_mesh(tmp_path: Path) -> None:
    """Masses are found from forces of inertia, beside thermal forces that are 1e11 times as large."""
    run(WARM, tmp_path)  # with its check
