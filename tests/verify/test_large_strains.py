# SPDX-License-Identifier: BSD-3-Clause
"""A thick tube of neo-Hookean material, blown up to one and a half times its bore by a pressure that follows
it, or by a dead one, or warmed at its bore, against the ordinary differential equation of its section."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from cell_problems import orders, solve
from plane_meshes import Sheet
from scipy.integrate import solve_bvp

YOUNG, POISSON = 2.8, 0.4
INNER, OUTER = 1.0, 2.0
EXPANSION = 1e-3


class Load(NamedTuple):
    """Pressure on the bore, and rise of the temperature there, from which it falls evenly to none outside."""

    pressure: float
    dead: bool = False
    rise: float = 0.0

    def temperature(self, R: np.ndarray) -> np.ndarray:
        return self.rise * (OUTER - R) / (OUTER - INNER)


def exact_radius(load: Load):
    """r(R): nominal stresses along the radius and round the axis are in balance, P_r' = (P_t - P_r)/R. With
    the stretches r', t = r/R and 1, of which q = 1 + A T is free, P = q**2 (mu (a - 1/a) + lambda ln J/a),
    where a is r'/q or t/q, and J = r' t/q**3. The pressure acts on the bore as it is, P_r = -p t, or as it
    was, -p."""
    shear = YOUNG / (2 * (1 + POISSON))
    lam = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))

    def free(R):
        return 1 + EXPANSION * load.temperature(R)

    def nominal(slope, t, q, which):
        a = (slope, t)[which] / q
        return q**2 * (shear * (a - 1 / a) + lam * np.log(slope * t / q**3) / a)

    def slope_of(R, r, radial):
        """The stretch along the radius under its stress, by Newton's iteration."""
        t, q = r / R, free(R)
        slope = q**3 / t
        for _ in range(50):
            a = slope / q
            rate = q * (shear * (1 + 1 / a**2) + lam * (1 - np.log(slope * t / q**3)) / a**2)
            change = (radial - nominal(slope, t, q, 0)) / rate
            slope = slope + change
        return slope

    def rates(R, y):
        r, radial = y
        slope = slope_of(R, r, radial)
        return np.array([slope, (nominal(slope, r / R, free(R), 1) - radial) / R])

    def ends(a, b):
        return np.array([a[1] + load.pressure * (1 if load.dead else a[0] / INNER), b[1]])

    at = np.linspace(INNER, OUTER, 41)
    found = solve_bvp(rates, ends, at, np.array([at + 0.3 / at, 0 * at]), tol=1e-10, max_nodes=10**5)
    assert found.success
    return lambda R: found.sol(R)[0]


LOADS = {"following": Load(0.42), "dead": Load(0.55, dead=True), "warm": Load(0.1, rise=300.0)}
EXACT = {name: exact_radius(load) for name, load in LOADS.items()}


def tube(
    hypothesis: str, nodes: int, boxes: int, folder: Path, ranks: int = 1, load: str = "following"
) -> float:
    """Error of the radial displacements of all nodes, root of the mean square, of the largest one."""

    def place(u):
        radius = INNER + (OUTER - INNER) * u[0]
        if hypothesis == "axis":
            return np.array([radius, 0.5 * u[1] / boxes])
        return radius * np.array([np.cos(np.pi / 2 * u[1]), np.sin(np.pi / 2 * u[1])])

    axi = hypothesis == "axis"
    mesh = Sheet((boxes, 1 if axi else boxes), nodes, place, curved=True)
    radius = mesh.points[:, 0] if axi else np.hypot(*mesh.points.T)
    model = "\n".join(mesh.model(hypothesis, YOUNG, POISSON)).replace("ELASTIC", "NEO-HOOKEAN")
    warm = LOADS[load].temperature(radius) if LOADS[load].rise else []
    deck = [
        model.replace(f"NT {POISSON}", f"NT {POISSON} A {EXPANSION}"),
        mesh.group(2, "low", mesh.nodes(lambda u: u[1] == 0)),
        mesh.group(3, "high", mesh.nodes(lambda u: u[1] == 1)),
        *mesh.group_of_faces(4, "bore", lambda u: u[0] == 0),
        ".FCT\n I 1 RAMP 0 0 1 1",
        f'.CLM\n GROUP "low" FIX C 2\n GROUP "high" FIX C {2 if axi else 1}',
        f' GROUP "bore" PRE V {LOADS[load].pressure} {"DEAD" if LOADS[load].dead else ""} NF 1',
        *(f" NOEUD {i} TEMP V {float(rise)!r} NF 1" for i, rise in enumerate(warm, 1)),
        ".SAM TYPE STATIC\n.SUB TF 1. H 0.25",
    ]
    found = solve(deck, folder, ranks)[:, :2]
    places = mesh.points + found
    moved = places[:, 0] if axi else np.hypot(*places.T)
    expected = EXACT[load](radius) - radius
    return float(np.sqrt(np.mean((moved - radius - expected) ** 2)) / expected.max())


def test_bore() -> None:
    """Strains are large."""
    assert EXACT["following"](INNER) == pytest.approx(1.515, abs=0.001)
    assert EXACT["dead"](INNER) == pytest.approx(1.437, abs=0.001)
    assert EXACT["warm"](INNER) == pytest.approx(1.299, abs=0.001)


@pytest.mark.parametrize(
    ("hypothesis", "nodes", "order", "error"),
    [
        ("axis", 3, 2.00, 5.4e-4),
        ("axis", 6, 3.00, 8.1e-7),
        ("axis", 4, 2.00, 3.7e-4),
        ("axis", 8, 3.98, 5.3e-8),
        ("strain", 3, 1.98, 4.5e-3),
        ("strain", 6, 3.08, 1.6e-6),
        ("strain", 4, 2.00, 1.1e-3),
        ("strain", 8, 4.02, 2.7e-7),
    ],
)
def test_tube(hypothesis: str, nodes: int, order: float, error: float, tmp_path: Path) -> None:
    errors = [tube(hypothesis, nodes, boxes, tmp_path) for boxes in (8, 16)]
    assert errors[1] < error
    assert orders(errors)[0] > order


@pytest.mark.parametrize(
    ("load", "hypothesis", "errors"),
    [
        ("dead", "axis", {3: 3.7e-4, 6: 9.3e-7, 4: 2.4e-4, 8: 2.8e-8}),
        ("dead", "strain", {3: 2.7e-3, 6: 1.9e-6, 4: 6.4e-4, 8: 2.6e-7}),
        ("warm", "axis", {3: 1.2e-3, 6: 1.6e-6, 4: 4.9e-4, 8: 9.9e-8}),
        ("warm", "strain", {3: 5.0e-4, 6: 4.8e-6, 4: 4.1e-4, 8: 2.8e-7}),
    ],
)
@pytest.mark.parametrize(("nodes", "order"), [(3, 1.99), (6, 3.0), (4, 1.99), (8, 3.97)])
def test_other_loads(
    load: str, hypothesis: str, errors: dict[int, float], nodes: int, order: float, tmp_path: Path
) -> None:
    """A dead pressure keeps its resultant on the bore while that grows; warm rubber grows apart from what its
    stresses do."""
    found = [tube(hypothesis, nodes, boxes, tmp_path, load=load) for boxes in (8, 16)]
    assert found[1] < errors[nodes]
    assert orders(found)[0] > order


def test_ranks(tmp_path: Path) -> None:
    one = tube("strain", 8, 4, tmp_path)
    for ranks in (2, 3):
        assert tube("strain", 8, 4, tmp_path, ranks) == pytest.approx(one, rel=1e-7)
