# SPDX-License-Identifier: BSD-3-Clause
"""The prototypes of tests/bench/scheme_candidates.py: Jacobians of their models, orders of their schemes."""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.append(str(Path(__file__).parents[1] / "bench"))
from candidate_models import MODELS, truth
from scheme_candidates import run


@pytest.mark.parametrize("name", MODELS)
def test_derivatives(name):
    model = MODELS[name]()
    random, step = np.random.default_rng(1), 1e-6
    size = 1e-3 if name == "andrews" else 1e-2
    q = model.move(model.place, size * random.standard_normal(model.n))
    v, pull = model.speed + random.standard_normal(model.n), random.standard_normal(model.m)

    def slope(values) -> np.ndarray:
        sides = [[values(model.move(q, s * step * d)) for s in (1, -1)] for d in np.eye(model.n)]
        return np.array([(up - down) / (2 * step) for up, down in sides]).T

    pairs = [
        (model.jacobian(q), slope(model.closure)),
        (model.bent_jacobian(q, pull), slope(lambda p: model.jacobian(p).T @ pull)),
        (model.bent_rate(q, v), slope(lambda p: model.jacobian(p) @ v)),
        (model.bent_force(q, v)[0], slope(lambda p: model.force(p, v))),
    ]
    for found, expected in pairs:
        np.testing.assert_allclose(found, expected, atol=1e-7 * max(1, np.abs(expected).max()))
    np.testing.assert_allclose(model.bending(q, v), model.bent_rate(q, v) @ v, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    ("name", "steps", "schemes"),
    [
        ("gears", 80, {"alpha:0.8": 2, "alpha-ggl:0.8": 2, "rattle": 2, "bdf3": 3}),
        ("gears", 40, {"radau": 5}),
        ("top", 80, {"alpha:0.8": 2, "alpha-ggl:0.8": 2, "rattle": 2, "bdf3": 3}),
        ("top", 160, {"bdf4": 4, "bdf5-ggl": 5}),
        ("top", 40, {"radau": 5}),
    ],
)
def test_orders(name, steps, schemes):
    """In positions, velocities and forces; velocities fit where a scheme says so."""
    model = MODELS[name]()
    exact = truth(model, np.linspace(0, model.end, 11))
    for scheme, order in schemes.items():
        coarse, fine = (run(scheme, model, n, scheme == "radau", exact) for n in (steps, 2 * steps))
        found = [math.log2(a / b) for a, b in zip(coarse["errors"], fine["errors"], strict=True)]
        print(name, scheme, found)
        assert found == pytest.approx([order] * 3, abs=0.35), scheme
        if scheme == "rattle" or scheme == "radau" or "ggl" in scheme:
            assert fine["left"] < 1e-9
