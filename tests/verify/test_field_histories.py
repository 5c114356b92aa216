# SPDX-License-Identifier: BSD-3-Clause
"""Histories and checks of fields: stresses of a cell, at its points and averaged at nodes, against the fields
in the same results."""

from __future__ import annotations

import json
from pathlib import Path

import h5py
import numpy as np
import pytest
from engrane_post import Results
from plane_meshes import Sheet
from runs import run

CELL, NODE = 3, 12
STEPS = ".SAM TYPE STATIC DISPLACEMENTS LARGE\n.SUB TF 1 H 0.25\n"


def strip(analysis: str, more: str) -> str:
    """A strip of 4 x 2 cells of eight nodes, held on one side, pulled and bent."""
    mesh = Sheet((4, 2), 8, lambda u: np.array([2 * u[0], u[1]]), curved=False, alternating=False)
    deck = mesh.text("DEFO PLAN", "YT 1000. NT 0.3 M 1.")
    deck += f"\n.CLM\n NOEUD {mesh.names(lambda x: x[0] == 0)} FIX C 1 2\n"
    deck += f" NOEUD {mesh.names(lambda x: x[0] == 1)} CHA C 1 2 V 3. -2. NF 1\n.FCT\n I 1 RAMP 0 0 1 1\n"
    return f"{deck}{analysis}.SAI FIELDS DT 0.25\n{more}.FIN 1\n"


def at_points(file: Path, name: str, frame: int) -> np.ndarray:
    """A field of CELL at its points (points x components)."""
    with h5py.File(file) as h5:
        group = h5[f"points/{name}"]
        values = group[f"{frame:06d}"][()]
        return values.reshape(len(values), -1)[group["elements"][()] == CELL]


def largest(values: np.ndarray) -> float:
    return values[np.abs(values).argmax()]


@pytest.mark.parametrize("ranks", [1, 2])
def test_histories_are_those_of_the_fields(ranks: int, tmp_path: Path) -> None:
    """Cells that .SAI named kept nothing, and nobody said so."""
    found = run(strip(STEPS, f".SAI ELEMENT {CELL}\n"), tmp_path, "all", ranks=ranks)
    stress, equivalent = at_points(found.file, "STRESS", 4), at_points(found.file, "VON_MISES", 4)
    assert len(stress) == 4 and np.abs(stress).min() > 0
    for k, component in enumerate(("XX", "YY", "ZZ", "XY")):
        history = found[f"{CELL}/STRESS:{component}"]
        assert len(history) == 5 and history[-1] == pytest.approx(largest(stress[:, k]), rel=1e-12)
    assert found[f"{CELL}/VON_MISES"][-1] == pytest.approx(equivalent.max(), rel=1e-12)

    channels = '"VON_MISES" "STRESS:XY" "STRESS:XY:2"'
    text = strip(STEPS, f".SAI ELEMENT {CELL} NOEUD {NODE} CHANNEL {channels}\n")
    found = run(text, tmp_path, "some", ranks=ranks)
    with Results(found.file) as results:
        names = [n for n in results.channels if not n.startswith("run/")]
        nodes = results.node_ids == NODE
        average = {n: results.average(n, 4)[nodes] for n in ("VON_MISES", "STRESS:XY")}
    assert sorted(names) == sorted(
        [f"element/{CELL}/{n}" for n in ("VON_MISES", "STRESS:XY", "STRESS:XY:2")]
        + [f"node/{NODE}/{n}" for n in average]
    )
    assert found[f"{CELL}/STRESS:XY:2"][-1] == pytest.approx(stress[1, 3], rel=1e-12)
    for name, value in average.items():
        assert found[f"node/{NODE}/{name}"][-1] == pytest.approx(value[0], rel=1e-12), name


def test_checks_and_results_of_fields(tmp_path: Path) -> None:
    """VON_MISES of an element was not known to .CHK, which offered an empty list."""
    wanted = (f"ELEMENT {CELL} VON_MISES MAX", f"ELEMENT {CELL} STRESS:XX:4", f"NODE {NODE} PRINCIPAL:1")
    words = [w for one in wanted for w in ("--result", one)]
    found = run(strip(STEPS, ""), tmp_path, options=("--json", *words), output=tmp_path / "out.json")
    values = [r["value"] for r in json.loads((tmp_path / "out.json").read_text())["runs"][0]["results"]]
    with Results(found.file) as results:
        principal = results.average("PRINCIPAL:1", 4)[results.node_ids == NODE][0]
    equivalent, stress = at_points(found.file, "VON_MISES", 4).max(), at_points(found.file, "STRESS", 4)[3, 0]
    assert values == pytest.approx([equivalent, stress, principal], rel=1e-12)
    checks = f".CHK\n ELEMENT {CELL} VON_MISES V {equivalent} RTOL 1E-9\n"
    checks += f" NODE {NODE} PRINCIPAL:1 V {{}} RTOL 1E-6\n"
    run(strip(STEPS, checks.format(principal)), tmp_path)
    run(strip(STEPS, checks.format(1.01 * principal)), tmp_path, status=4)


def test_checks_between_steps(tmp_path: Path) -> None:
    """Where steps follow their error, at an instant within one: the fields there are those in balance."""
    dynamic = ".SAM TYPE DYNAMIC DISPLACEMENTS LARGE SCHEME RADAU\n.SUB TF 1 H 0.05 TOL 1E-7\n"
    wanted = (f"ELEMENT {CELL} STRESS:XX:1 T 0.75", f"NODE {NODE} VON_MISES T 0.75")
    words = [w for one in wanted for w in ("--result", one)]
    found = run(strip(dynamic, ""), tmp_path, options=("--json", *words), output=tmp_path / "out.json")
    values = [r["value"] for r in json.loads((tmp_path / "out.json").read_text())["runs"][0]["results"]]
    with Results(found.file) as results:
        frame = int(np.argmin(np.abs(results.frame_times - 0.75)))
        assert results.frame_times[frame] == pytest.approx(0.75, rel=1e-12)
        average = results.average("VON_MISES", frame)[results.node_ids == NODE][0]
    expected = [at_points(found.file, "STRESS", frame)[0, 0], average]
    assert values == pytest.approx(expected, rel=1e-3)


def test_the_listing_has_the_largest_values(tmp_path: Path) -> None:
    found = run(strip(STEPS, ""), tmp_path)
    listing = (
        found.file.with_suffix(".lst").read_text(encoding="utf-8").split("Largest in the last fields")[1]
    )
    rows = [line.split() for line in listing.splitlines()]
    with Results(found.file) as results:
        moved = np.linalg.norm(results.frame(-1).displacement, axis=1)
        average = results.average("VON_MISES", 4)
        cells = results.cell_field("VON_MISES", 4)
        ids, points = results.node_ids, results.points
    for first, values in (("displacement", moved), ("averaged", average)):
        row = next(r for r in rows if first in r)
        node = int(np.nanargmax(values))
        assert row[row.index("node") + 1] == str(ids[node])
        assert [float(x) for x in row[-3:]] == pytest.approx(points[node].tolist(), rel=1e-5)
        assert any(x == f"{values[node]:.6g}" for x in row), row
    row = next(r for r in rows if "cells" in r)
    assert int(row[row.index("cell") + 1].rstrip(",")) == int(np.nanargmax(cells)) + 1
