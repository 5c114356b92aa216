# SPDX-License-Identifier: BSD-3-Clause
"""Stresses of cells at nodes, and the estimate of their error: Lamé's thick tube, constant stress, a jump of
material, and the same averages made here from the points that the results hold."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection
from pathlib import Path

import numpy as np
import pytest
from engrane_post import Results
from plane_meshes import Sheet
from runs import run
from test_cells import Shape

INNER, OUTER, PRESSURE, YOUNG, POISSON = 1.0, 2.0, 100.0, 1000.0, 0.3


def tube(boxes: int, nodes: int) -> tuple[Sheet, str]:
    """A quarter of a thick tube under inner pressure, plane strain."""

    def place(u: np.ndarray) -> np.ndarray:
        radius, angle = INNER + (OUTER - INNER) * u[0], np.pi / 2 * u[1]
        return radius * np.array([np.cos(angle), np.sin(angle)])

    mesh = Sheet((boxes, boxes), nodes, place, curved=True, alternating=False)
    bore = mesh.faces(lambda x: x[0] == 0)
    deck = mesh.text("DEFO PLAN")
    deck += f"\n.CLM\n NOEUD {mesh.names(lambda x: x[1] == 0)} FIX C 2"
    deck += f"\n NOEUD {mesh.names(lambda x: x[1] == 1)} FIX C 1\n"
    deck += "\n".join(f" ARETE I {e} {k} PRE V {PRESSURE}" for e, k in bore) + "\n.FIN 1\n"
    return mesh, deck


def lame(points: np.ndarray) -> np.ndarray:
    """Stresses xx, yy, xy of the tube (Timoshenko and Goodier 1970, Theory of Elasticity, art. 28)."""
    radius = np.hypot(points[:, 0], points[:, 1])
    c, s = points[:, 0] / radius, points[:, 1] / radius
    scale = PRESSURE * INNER**2 / (OUTER**2 - INNER**2)
    radial, round_ = scale * (1 - OUTER**2 / radius**2), scale * (1 + OUTER**2 / radius**2)
    return np.stack(
        [radial * c * c + round_ * s * s, radial * s * s + round_ * c * c, (radial - round_) * c * s], axis=1
    )


def energy_of_lame() -> float:
    """Strain energy of the quarter, half the work of the pressure on the bore."""
    constant = PRESSURE * INNER**2 / (OUTER**2 - INNER**2) * (1 + POISSON) / YOUNG
    moved = constant * ((1 - 2 * POISSON) * INNER + OUTER**2 / INNER)
    return 0.5 * PRESSURE * moved * np.pi / 2 * INNER


def solved(deck: str, folder: Path, ranks: int = 1) -> tuple[dict, Results]:
    """The first entry of the summary, and the results."""
    file = run(deck, folder, ranks=ranks, options=("--json",), output=folder / "summary.json").file
    return json.loads((folder / "summary.json").read_text())["runs"][0], Results(file)


def square_points(kind: int) -> list[tuple[float, float, float]]:
    """Four by four points of the reference cell; those of a triangle gather at a corner (Duffy 1982)."""
    rule = list(zip(*np.polynomial.legendre.leggauss(4), strict=True))
    points = [(x, y, v * w) for x, v in rule for y, w in rule]
    if kind in (4, 8):
        return points
    return [((1 + x) / 2, (1 + y) * (1 - x) / 4, w * (1 - x) / 8) for x, y, w in points]


ROOT = 1 / np.sqrt(3)
SQUARE = [(-ROOT, -ROOT), (ROOT, -ROOT), (-ROOT, ROOT), (ROOT, ROOT)]
# where cells hold stresses, in reference cells
POINTS = {3: [(1 / 3, 1 / 3)], 6: [(1 / 6, 1 / 6), (2 / 3, 1 / 6), (1 / 6, 2 / 3)], 4: SQUARE, 8: SQUARE}


def energy_of_difference(
    mesh: Sheet, kind: int, results: Results, wanted: Callable[[np.ndarray, np.ndarray], np.ndarray]
) -> float:
    """Half the square of the energy norm of `wanted` less the stresses of the cells, by their own shape
    functions from displacements; of four nodes, which have internal modes, by bilinear functions through the
    points of the results. `wanted` has values of shape functions and the numbers of the nodes of a cell."""
    shape = Shape(kind)
    moved = results.field("displacement", 0)
    at_points = results.dataset("points/STRESS/000000")
    compliance = (
        (1 + POISSON) / YOUNG * np.array([[1 - POISSON, -POISSON, 0], [-POISSON, 1 - POISSON, 0], [0, 0, 2]])
    )
    total = 0.0
    for e, cell in enumerate(mesh.cells):
        x, u = mesh.points[cell], moved[cell, :2]
        for xi, eta, weight in square_points(kind):
            jacobian = shape.slope(xi, eta) @ x
            gradient = np.linalg.solve(jacobian, shape.slope(xi, eta))
            if kind == 4:
                corners = [shape.value(xi / ROOT, eta / ROOT)[k] for k in (0, 1, 3, 2)]
                stress = np.array(corners) @ at_points[4 * e : 4 * e + 4][:, [0, 1, 3]]
            else:
                h = gradient @ u  # h[i, j] = du_j/dx_i
                stress = np.linalg.solve(compliance, [h[0, 0], h[1, 1], h[0, 1] + h[1, 0]])
            off = wanted(shape.value(xi, eta), cell) - stress
            total += weight * abs(np.linalg.det(jacobian)) * off @ compliance @ off / 2
    return total


def true_error(mesh: Sheet, kind: int, results: Results) -> float:
    """Half the square of the energy norm of the error."""
    return energy_of_difference(
        mesh, kind, results, lambda shape, cell: lame((shape @ mesh.points[cell])[None])[0]
    )


# Estimate over true error on 4 and 8 boxes along each side, as measured. Of quadratic cells the averages are
# of the same order as the stresses in the cells (what is quadratic there is extrapolated too low from both
# sides of a node), so that the estimate does not tend to the error but stays above it.
EFFECTIVITY = {3: (0.97, 1.00), 6: (2.23, 2.15), 4: (1.01, 1.01), 8: (2.90, 2.86)}


@pytest.mark.parametrize("kind", EFFECTIVITY)
def test_effectivity(kind: int, tmp_path: Path) -> None:
    """The estimate against the true error of the tube; both fall with the mesh, and stresses at nodes are
    better than in the cells."""
    found = []
    for boxes in (4, 8):
        mesh, deck = tube(boxes, kind)
        summary, results = solved(deck, tmp_path)
        with results:
            truth = true_error(mesh, kind, results)
            by_cells = results.cell_field("ERROR", 0)
            nodal = results.dataset("nodes/STRESS/000000")
            sizes = [len(results.points), len(mesh.points)]
        estimate = summary["stress_error"]
        assert sizes[0] == sizes[1]
        assert by_cells.sum() == pytest.approx(estimate["energy"], rel=1e-12)
        energy = estimate["strain_energy"] + estimate["energy"]
        assert estimate["relative"] == pytest.approx(np.sqrt(estimate["energy"] / energy), rel=1e-12)
        if boxes == 8:
            assert estimate["strain_energy"] == pytest.approx(energy_of_lame(), rel=0.03)
        off = np.abs(nodal[:, [0, 1, 3]] - lame(mesh.points))
        found.append((np.sqrt(estimate["energy"] / truth), estimate["relative"], off.max() / PRESSURE))
    assert np.array([f[0] for f in found]) == pytest.approx(np.array(EFFECTIVITY[kind]), abs=0.01)
    assert found[0][1] / found[1][1] > (1.8 if kind in (3, 4) else 3.2)
    assert found[1][2] < found[0][2]


def averaged(mesh: Sheet, kind: int, results: Results, part: Collection[int] | None = None) -> np.ndarray:
    """From the points of each cell to its nodes by least squares, then the mean over the cells at each: all
    cells, or those of a part, counted from 0; not a number where it has none."""
    powers = [(0, 0), (1, 0), (0, 1)] + ([(1, 1)] if mesh.corners == 4 else [])
    points = POINTS[kind]
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)] if mesh.corners == 4 else [(0, 0), (1, 0), (0, 1)]
    nodes = corners + [
        ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
        for a, b in zip(corners, corners[1:] + corners[:1], strict=True)
    ]
    if kind == 3:
        powers = powers[:1]
    at = np.array([[x**i * y**j for i, j in powers] for x, y in points])
    to = np.array([[x**i * y**j for i, j in powers] for x, y in nodes])
    one = len(points) == 1
    values = results.dataset("fields/STRESS/000000" if one else "points/STRESS/000000")
    values = values.reshape(len(mesh.cells), len(points), 4)
    total, count = np.zeros((len(mesh.points), 4)), np.zeros((len(mesh.points), 1))
    for e, (cell, own) in enumerate(zip(mesh.cells, values, strict=True)):
        if part is not None and e not in part:
            continue
        total[cell] += (to @ np.linalg.lstsq(at, own, rcond=None)[0])[: len(cell)]
        count[cell] += 1
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)


@pytest.mark.parametrize("kind", EFFECTIVITY)
def test_averages_are_those_of_the_points(kind: int, tmp_path: Path) -> None:
    mesh, deck = tube(3, kind)
    for ranks in (1, 2, 3):
        summary, results = solved(deck, tmp_path, ranks)
        with results:
            expected = averaged(mesh, kind, results)
            s = results.dataset("nodes/STRESS/000000")
            assert s == pytest.approx(expected, abs=1e-11 * np.abs(expected).max())
            xx, yy, zz, xy = s.T
            mises = np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2 + 3 * xy**2)
            assert results.average("VON_MISES", 0) == pytest.approx(mises, rel=1e-12)
            principal = [
                np.linalg.eigvalsh([[a, c], [c, b]])[::-1] for a, b, c in zip(xx, yy, xy, strict=True)
            ]
            shown = results.dataset("nodes/PRINCIPAL/000000")
            assert shown[:, :2] == pytest.approx(np.array(principal), abs=1e-11 * np.abs(s).max())
            assert shown[:, 2] == pytest.approx(zz)
            assert results.cell_field("ERROR", 0).sum() == pytest.approx(
                summary["stress_error"]["energy"], rel=1e-9
            )


def strips(kind: int, large: bool) -> tuple[Sheet, str]:
    """Two strips side by side, the upper one twice as stiff, both stretched by one per cent along x."""

    def bent(at: np.ndarray) -> np.ndarray:
        u, v = at
        return np.array([u + 0.2 * v * u * (1 - u) * (v - 0.5) * (1 - v), v])

    mesh = Sheet((2, 2), kind, bent, curved=True, alternating=False)
    upper = [e for e, cell in enumerate(mesh.cells, 1) if mesh.unit[cell][:, 1].mean() > 0.5]
    deck = mesh.text("CONT PLAN", "YT 1000. NT 0.")
    deck += '\n.PHP GROUP "all" THICK VAL 1.\n.MAT I 2 BEHA "ELASTIC" YT 2000. NT 0.\n.AEL\n'
    deck += "\n".join(f" I {e} MAT 2" for e in upper)
    deck += f"\n.CLM\n NOEUD {mesh.names(lambda x: x[0] == 0)} FIX C 1\n NOEUD 1 FIX C 2"
    deck += f"\n NOEUD {mesh.names(lambda x: x[0] == 1)} DEP C 1 V 0.01"
    deck += " NF 1\n.FCT I 1 RAMP 0 0 1 1\n.SAM TYPE STATIC\n.SUB TF 1 H 1" if large else ""
    return mesh, deck + "\n.FIN 1\n"


@pytest.mark.parametrize("large", [False, True])
@pytest.mark.parametrize("kind", EFFECTIVITY)
def test_jumps_of_the_material_stay(kind: int, large: bool, tmp_path: Path) -> None:
    """Where strips of two materials meet there are two points at each node, with a stress each; as each strip
    has a constant stress, no error is estimated."""
    mesh, deck = strips(kind, large)
    for ranks in (1, 2, 3) if large else (1, 3):
        summary, results = solved(deck, tmp_path, ranks)
        with results:
            last = len(results.frame_times) - 1
            stress, energy = results.average("STRESS:XX", last), summary["stress_error"]
            places, ids = results.points, results.node_ids
            doubled = np.flatnonzero(mesh.unit[:, 1] == 0.5)
            assert len(places) == len(mesh.points) + len(doubled)
            assert sorted(ids[len(mesh.points) :]) == sorted(doubled + 1)
            moved = results.field("displacement", last)
        for k in range(len(mesh.points), len(ids)):
            assert (places[k] == places[ids[k] - 1]).all()
            assert (moved[k] == moved[ids[k] - 1]).all()
        # E S with the strain of Green and Lagrange, and the stretch, NT 0: true stress F S F
        low = 1000 * (0.01 + 0.01**2 / 2) * 1.01 if large else 10.0
        assert stress[places[:, 1] < 0.4] == pytest.approx(low, rel=1e-9)
        assert stress[places[:, 1] > 0.6] == pytest.approx(2 * low, rel=1e-9)
        both = np.sort(np.reshape([stress[ids == i + 1] for i in doubled], (-1, 2)), axis=1)
        assert both == pytest.approx(np.tile([low, 2 * low], (len(doubled), 1)), rel=1e-9)
        assert energy["energy"] < 1e-18 * energy["strain_energy"]


@pytest.mark.parametrize("kind", EFFECTIVITY)
def test_groups_are_averaged_apart(kind: int, tmp_path: Path) -> None:
    """Cells of one section are of one part if they are in the same of the groups that give properties, which
    may overlap; groups that are there for other ends do not count."""
    mesh, deck = tube(4, kind)
    middles = [mesh.unit[cell].mean(axis=0) for cell in mesh.cells]
    groups = {
        "inner": {e for e, u in enumerate(middles) if u[0] < 0.5},
        "low": {e for e, u in enumerate(middles) if u[1] < 0.6},
        "heavy": {e for e, u in enumerate(middles) if u[0] > 0.3},
    }
    rows = [
        f'.SEL GROUP {k} NOM "{name}" MAILLES ' + " ".join(f"I {e + 1}" for e in sorted(cells))
        for k, (name, cells) in enumerate(groups.items(), 2)
    ]
    rows += [
        '.AEL GROUP "inner" MAT 1',
        '.HYP DEFO PLAN GROUP "low"',
        '.CLM ADD GROUP "heavy" ROT VAL 0. AXE 0 0 1',
    ]
    deck = deck.replace("\n.FIN 1", "\n" + "\n".join(rows) + "\n.FIN 1")
    parts: dict[tuple[bool, bool], set[int]] = {}
    for e in range(len(mesh.cells)):
        parts.setdefault((e in groups["inner"], e in groups["low"]), set()).add(e)
    assert len(parts) == 4
    for ranks in (1, 3):
        _, results = solved(deck, tmp_path, ranks)
        with results:
            expected = [averaged(mesh, kind, results, part) for part in parts.values()]
            stress, ids = results.dataset("nodes/STRESS/000000"), results.node_ids
        scale = np.abs(stress).max()
        for node in range(len(mesh.points)):
            own = np.array(sorted(tuple(s[node]) for s in expected if not np.isnan(s[node, 0])))
            found = np.array(sorted(tuple(row) for row in stress[ids == node + 1]))
            assert found == pytest.approx(own, abs=1e-9 * scale)
        assert len(ids) == sum(
            len(np.unique(np.concatenate([mesh.cells[e] for e in p]))) for p in parts.values()
        )


DECKS = Path(__file__).parents[2] / "decks" / "elements" / "structural"


@pytest.mark.parametrize(
    "name", ["tetrahedra_4", "tetrahedra_10", "wedges_6", "wedges_15", "hexahedra_8", "hexahedra_20"]
)
def test_constant_stress_of_solids_has_no_error(name: str, tmp_path: Path) -> None:
    summary, results = solved((DECKS / f"cell_{name}.dat").read_text(), tmp_path)
    with results:
        last = len(results.frame_times) - 1
        stress = results.dataset(f"nodes/STRESS/{last:06d}")
        means = results.dataset(f"fields/STRESS/{last:06d}")
    assert stress == pytest.approx(np.tile(means[0], (len(stress), 1)), abs=1e-9 * np.abs(means).max())
    assert summary["stress_error"]["energy"] < 1e-18 * summary["stress_error"]["strain_energy"]


# a solid pulled along x by its end, and apart from it a plate pulled likewise
SOLID = """ 1 0 0 0
 2 2 0 0
 3 2 1 0
 4 0 1 0
 5 0 0 1
 6 2 0 1
 7 2 1 1
 8 0 1 1
"""
PLATE = """ 11 5 0 0
 12 7 0 0
 13 7 1 0
 14 5 1 0
"""
SOLID_CELL, PLATE_CELL = " I 1 N 1 2 3 4 0 5 6 7 8\n", " I 2 N 11 12 13 14\n"
SOLID_LOADS = (
    " FIX NOEUD 1 4 5 8 C 1\n FIX NOEUD 1 2 5 6 C 2\n FIX NOEUD 1 2 3 4 C 3\n NOEUD 2 3 6 7 CHA C 1 V 5.\n"
)
PLATE_LOADS = (
    " FIX NOEUD 11 14 C 1\n FIX NOEUD 11 12 C 2\n NOEUD 12 13 CHA C 2 V 3.\n NOEUD 14 CHA C 2 V 6.\n"
)


def parts_deck(solid: bool, plate: bool) -> str:
    nodes = SOLID * solid + PLATE * plate
    cells = SOLID_CELL * solid + PLATE_CELL * plate
    loads = SOLID_LOADS * solid + PLATE_LOADS * plate
    form = ".SEL GROUP 1 MAILLES 2\n.HYP CONT PLAN GROUP 1\n.PHP GROUP 1 THICK 0.5\n" * plate
    assigned = ".SEL GROUP 2 MAILLES TOUT\n.MAT I 1 YT 1000. NT 0.3\n.AEL GROUP 2 MAT 1\n"
    return f".NOE\n{nodes}.MAI\n{cells}{form}{assigned}.CLM\n{loads}.FIN 1\n"


def with_values(rows: np.ndarray) -> np.ndarray:
    """Without the rows of elements that have no such field."""
    return rows[~np.isnan(rows.reshape(len(rows), -1)).any(axis=1)]


def test_plane_cells_and_solids_in_one_deck(tmp_path: Path) -> None:
    """Both have the stresses that they have alone, and the estimated errors add up."""
    decks = {
        "solid": parts_deck(True, False),
        "plate": parts_deck(False, True),
        "both": parts_deck(True, True),
    }
    fields, errors = {}, {}
    for name, deck in decks.items():
        folder = tmp_path / name
        folder.mkdir()
        summary, results = solved(deck, folder)
        errors[name] = summary["stress_error"]["energy"]
        with results:
            last = f"{len(results.frame_times) - 1:06d}"
            fields[name] = {
                (place, field): with_values(results.dataset(f"{place}/{field}/{last}"))
                for place in ("nodes", "fields")
                for field in ("STRESS", "STRAIN", "VON_MISES", "PRINCIPAL")
                if (place, field) != ("nodes", "STRAIN")
            }
    for key, both in fields["both"].items():
        solid, plate = (fields[name][key] for name in ("solid", "plate"))
        scale = np.abs(both).max()
        assert both[: len(solid)] == pytest.approx(solid, abs=1e-9 * scale), key
        if key[1] == "PRINCIPAL" and key[0] == "nodes":
            plate = -np.sort(-plate, axis=1)
        if key[1] != "PRINCIPAL" and both.ndim == 2:
            assert np.all(both[len(solid) :, 4:] == 0), key
            both = both[:, :4]
        if key != ("fields", "PRINCIPAL"):  # means of sorted values are not sorted means
            assert both[len(solid) :] == pytest.approx(plate, abs=1e-9 * scale), key
        else:
            assert both[len(solid) :].sum() == pytest.approx(plate.sum(), abs=1e-9 * scale)
            assert np.all(np.diff(both[len(solid) :], axis=1) <= 1e-9 * scale)
    assert errors["both"] == pytest.approx(errors["solid"] + errors["plate"], rel=1e-9)
    assert errors["plate"] > 0
