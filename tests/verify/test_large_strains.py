# SPDX-License-Identifier: BSD-3-Clause
"""A thick tube of neo-Hookean material, blown up by a pressure to one and a half times its bore, against the
ordinary differential equation of its section."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cell_problems import orders, solve
from plane_meshes import Sheet
from scipy.integrate import solve_bvp

YOUNG, POISSON, PRESSURE = 2.8, 0.4, 0.42
INNER, OUTER = 1.0, 2.0


def exact_radius():
    """r(R): nominal stresses P_r = mu (r' - 1/r') + lambda ln J/r' along the radius and P_t = mu (t - 1/t)
    + lambda ln J/t round the axis, with t = r/R and J = r' t, are in balance, P_r' = (P_t - P_r)/R. The
    pressure acts on the bore as it is, P_r = -p t."""
    shear = YOUNG / (2 * (1 + POISSON))
    lam = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))

    def radial(slope, hoop):
        return shear * (slope - 1 / slope) + lam * np.log(slope * hoop) / slope

    def rates(R, y):
        r, slope = y
        t = r / R
        log_j = np.log(slope * t)
        hoop = shear * (t - 1 / t) + lam * log_j / t
        by_slope = shear * (1 + 1 / slope**2) + lam * (1 - log_j) / slope**2
        by_hoop = lam / (slope * t)
        turning = (slope - t) / R  # t'
        return np.array([slope, ((hoop - radial(slope, t)) / R - by_hoop * turning) / by_slope])

    def ends(a, b):
        return np.array([radial(a[1], a[0] / INNER) + PRESSURE * a[0] / INNER, radial(b[1], b[0] / OUTER)])

    at = np.linspace(INNER, OUTER, 41)
    found = solve_bvp(rates, ends, at, np.array([at + 0.3 / at, 1 - 0.3 / at**2]), tol=1e-10, max_nodes=10**5)
    assert found.success
    return lambda R: found.sol(R)[0]


EXACT = exact_radius()


def tube(hypothesis: str, nodes: int, boxes: int, folder: Path, ranks: int = 1) -> float:
    """Error of the radial displacements of all nodes, root of the mean square, of the largest one."""

    def place(u):
        radius = INNER + (OUTER - INNER) * u[0]
        if hypothesis == "axis":
            return np.array([radius, 0.5 * u[1] / boxes])
        return radius * np.array([np.cos(np.pi / 2 * u[1]), np.sin(np.pi / 2 * u[1])])

    axi = hypothesis == "axis"
    mesh = Sheet((boxes, 1 if axi else boxes), nodes, place, curved=True)
    deck = [
        *(line.replace("ELASTIC", "NEO-HOOKEAN") for line in mesh.model(hypothesis, YOUNG, POISSON)),
        mesh.group(2, "low", mesh.nodes(lambda u: u[1] == 0)),
        mesh.group(3, "high", mesh.nodes(lambda u: u[1] == 1)),
        *mesh.group_of_faces(4, "bore", lambda u: u[0] == 0),
        ".FCT\n I 1 RAMP 0 0 1 1",
        f'.CLM\n GROUP "low" FIX C 2\n GROUP "high" FIX C {2 if axi else 1}',
        f' GROUP "bore" PRE V {PRESSURE} NF 1',
        ".SAM TYPE STATIC\n.SUB TF 1. H 0.25",
    ]
    found = solve(deck, folder, ranks)[:, :2]
    places = mesh.points + found
    radius = mesh.points[:, 0] if axi else np.hypot(*mesh.points.T)
    moved = places[:, 0] if axi else np.hypot(*places.T)
    expected = EXACT(radius) - radius
    return float(np.sqrt(np.mean((moved - radius - expected) ** 2)) / expected.max())


def test_bore() -> None:
    """Strains are large."""
    assert EXACT(INNER) / INNER == pytest.approx(1.515, abs=0.001)


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


def test_ranks(tmp_path: Path) -> None:
    one = tube("strain", 8, 4, tmp_path)
    for ranks in (2, 3):
        assert tube("strain", 8, 4, tmp_path, ranks) == pytest.approx(one, rel=1e-7)
