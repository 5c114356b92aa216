# SPDX-License-Identifier: BSD-3-Clause
"""Damping of cells after Kelvin and Voigt (DAMPING of .MAT): a vibration of w radians per time is damped by
w/2 times the damping time, as a part of critical damping; what cells dissipate is what they lose; and the
error that ACCURACY states for meshes is the true one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from plane_meshes import Sheet, nodal_forces
from runs import run
from small_decks import SQUARE
from solid_meshes import Block
from test_stated_errors import expect_honest, solve_by

LENGTH, HEIGHT, YOUNG, DENSITY = 1.0, 0.1, 2e8, 1000.0


def damped(deck: list[str], damping: float) -> str:
    material = f" M {DENSITY!r}"
    text = "\n".join(deck)
    assert text.count(material) == 1
    return text.replace(material, f"{material} DAMPING {damping!r}") + "\n"


def strip(nodes: int, boxes, poisson: float, damping: float, traction) -> tuple[Sheet, str]:
    """A cantilever in plane stress, with a traction on its free end from the start."""
    mesh = Sheet(boxes, nodes, lambda u: np.array([LENGTH * u[0], HEIGHT * u[1]]))
    deck = [
        *mesh.model("stress", YOUNG, poisson, density=DENSITY),
        mesh.group(2, "wall", mesh.nodes(lambda u: u[0] == 0)),
        '.CLM\n GROUP "wall" FIX C 1 2',
        *nodal_forces(mesh.forces(lambda u: u[0] == 1, lambda _point, _normal: np.array(traction))),
    ]
    return mesh, damped(deck, damping)


def end_of(mesh) -> int:
    return int(mesh.nodes(lambda u: u[0] == 1 and all(x == 0 for x in u[1:]))[0]) + 1


@pytest.mark.parametrize("nodes, boxes", [(3, 40), (6, 10), (4, 40), (8, 10)])
def test_a_rod_under_a_sudden_load(nodes: int, boxes: int, tmp_path: Path) -> None:
    """The sum of its modes, without lateral contraction. Those from the fourth on creep."""
    time = 3e-4
    mesh, deck = strip(nodes, (boxes, 1), 0.0, time, (1e4, 0.0))
    end = end_of(mesh)
    deck += ".SAM TYPE DYNAMIC SCHEME RADAU DISPLACEMENTS SMALL\n.SUB TF 0.008 H 4E-5\n"
    found = run(f"{deck}.CHK\n NODE {end} UX V 0 ATOL 1\n.FIN 1\n", tmp_path)
    k = 2 * np.arange(1, 200)[:, None] - 1
    w = k * np.pi / 2 / LENGTH * np.sqrt(YOUNG / DENSITY)
    root = np.sqrt((time * w**2 / 2) ** 2 - w**2 + 0j)
    a, b = -time * w**2 / 2 + root, -time * w**2 / 2 - root
    left = np.real((a * np.exp(b * found.t) - b * np.exp(a * found.t)) / (a - b))
    exact = 1e4 / YOUNG * LENGTH * (1 - np.sum(8 / (k * np.pi) ** 2 * left, axis=0))
    assert np.max(np.abs(found[f"node/{end}/UX"] - exact)) < 1e-3 * np.max(exact)


def decrement(t: np.ndarray, u: np.ndarray) -> tuple[float, float]:
    """Damping, as a part of critical damping, and frequency without it of a decaying vibration about zero."""
    peaks = np.flatnonzero((u[1:-1] > u[:-2]) & (u[1:-1] >= u[2:])) + 1
    times, sizes = [], []
    for p in peaks:  # by parabolas
        c2, c1, c0 = np.polyfit(t[p - 2 : p + 3] - t[p], u[p - 2 : p + 3], 2)
        times.append(t[p] - c1 / (2 * c2))
        sizes.append(c0 - c1**2 / (4 * c2))
    periods = len(peaks) - 3
    period, log = (times[-1] - times[2]) / periods, np.log(sizes[2] / sizes[-1]) / periods
    part = log / np.hypot(2 * np.pi, log)
    return part, 2 * np.pi / period / np.sqrt(1 - part**2)


@pytest.mark.parametrize("size", ["SMALL", "LARGE"])
@pytest.mark.parametrize("nodes", [4, 8, "hexahedra"])
def test_bending_is_damped_as_it_is_stiff(nodes: int | str, size: str, tmp_path: Path) -> None:
    """Also of cells with internal modes, which bend without shear: their rates have modes as well."""
    time, force = 1e-3, 100.0
    if nodes == "hexahedra":
        mesh = Block((12, 1, 1), 8, False, lambda u: np.array([u[0] * LENGTH, u[1] * HEIGHT, u[2] * HEIGHT]))
        share = mesh.spread(lambda u: u[0] == 1, (0, 1, 0))
        deck = [
            *mesh.deck(),
            ".SEL",
            mesh.group(1, "wall", mesh.nodes(lambda u: u[0] == 0)),
            f' GROUP 2 MAILLES NOM "all" TOUT\n.MAT\n I 1 YT {YOUNG!r} NT 0.3 M {DENSITY!r}',
            '.AEL\n GROUP "all" MAT 1\n.CLM\n GROUP "wall" FIX C 1 2 3',
            *[f" CHA NOEUD {i + 1} C 2 V {force * s[1]:.16g} NF 1" for i, s in enumerate(share) if s[1]],
        ]
        text = damped(deck, time)
    else:
        mesh, text = strip(nodes, (12, 1), 0.3, time, (0.0, 10 * force))
        text = "\n".join(f"{n} NF 1" if " CHA " in n else n for n in text.splitlines()) + "\n"
    end = end_of(mesh)
    text += ".FCT\n I 1 TABLE 0 1 1E-6 0 1 0\n"
    text += f".SAM TYPE DYNAMIC SCHEME RADAU DISPLACEMENTS {size} START STATIC\n.SUB TF 1.4 H 2E-3\n"
    found = run(f"{text}.CHK\n NODE {end} UY V 0 ATOL 1\n.FIN 1\n", tmp_path)
    part, frequency = decrement(found.t, found[f"node/{end}/UY"])
    assert part == pytest.approx(time * frequency / 2, rel=2e-3)


def test_what_is_lost_is_dissipated(tmp_path: Path) -> None:
    """A soft strip that falls and swings, with large strains: RADAU keeps the balance of energy."""
    mesh, text = strip(4, (6, 1), 0.3, 2e-2, (0.0, 0.0))
    end = end_of(mesh)
    text = text.replace(f"YT {YOUNG!r}", "YT 2e6")
    text += " STRU ACC VAL 0 -9.81 0\n.SAM TYPE DYNAMIC SCHEME RADAU\n.SUB TF 1 H 2E-3 TOL 1E-6\n"
    found = run(f"{text}.CHK\n NODE {end} UY V 0 ATOL 2\n.FIN 1\n", tmp_path)
    lost = found["run/DISSIPATED_ENERGY"]
    assert np.ptp(found[f"node/{end}/UY"]) > 0.5 * LENGTH and np.all(np.diff(lost) > 0)
    assert np.max(np.abs(found["run/ENERGY_ERROR"])) < 1e-4 * lost[-1]


@pytest.mark.parametrize("setting", ["FAST", "NORMAL"])
@pytest.mark.parametrize("nodes", [4, 8])
def test_the_error_of_a_mesh_is_the_one_stated(nodes: int, setting: str, tmp_path: Path) -> None:
    """A cantilever under a sudden load: the tip's velocity and acceleration, and the force of the wall."""
    mesh, text = strip(nodes, (6, 1), 0.3, 1e-3, (0.0, 1e3))
    end = end_of(mesh)
    text += ".SUB TF 0.1 H 1E-3\n"
    found, result = solve_by(text, f"ACCURACY {setting}", tmp_path)
    assert "DAMPING" not in found["said"]
    sharp = tmp_path / "sharp"
    sharp.mkdir()
    _, truth = solve_by(text.replace("H 1E-3", "H 1E-3 TOL 1E-8"), "SCHEME RADAU", sharp)
    channels = (f"node/{end}/UY", f"node/{end}/VY", "run/GROUND_FORCE_Y", found["accuracy"]["channel"])
    expect_honest(found, result, truth, channels)


BEAM = """.UNIT SI
.NOE
 I 1 X 0
 I 2 X 0.5
 I 3 X 1
.MAT
 I 1 YT 2E8 NT 0.3 M 1000{material}
.BPR
 I 1 RECTANGLE 0.1 0.1
{line}
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
 CHA NOEUD 3 C 2 V 10
.SAM TYPE DYNAMIC
.SUB TF 0.05 H 1E-3
.FIN 1
"""
CARD = ".MCE\n I 1 BEAM N 1 2 3 BPR 1 MAT 1 AXIS2 0 1 0"
CELL = """.MAI
 I 1 N 1 -2 3
.SEL
 GROUP 1 MAILLES NOM "line" TOUT
.HYP BEAM GROUP "line"
.AEL GROUP "line" MAT 1 BPR 1 AXIS2 0 1 0"""


def test_beams_have_the_damping_of_their_material(tmp_path: Path) -> None:
    cases = {"own": ("", f"{CARD} DAMPING 1E-3"), "material": (" DAMPING 1E-3", CARD)}
    cases |= {"other": (" DAMPING 5", f"{CARD} DAMPING 1E-3"), "cell": (" DAMPING 1E-3", CELL)}
    tips = {}
    for name, (material, line) in cases.items():
        tips[name] = run(BEAM.format(material=material, line=line), tmp_path, name)["node/3/UY"]
    undamped = run(BEAM.format(material="", line=CARD), tmp_path, "undamped")["node/3/UY"]
    assert np.ptp(tips["own"]) < 0.99 * np.ptp(undamped)
    assert all(np.array_equal(tips[name], tips["own"]) for name in ("material", "other", "cell"))


HEATED = (
    f".UNIT SI\n{SQUARE}"
    + """\
.SEL
 GROUP 1 MAILLES NOM "plate" TOUT
 GROUP 2 NOM "all" NOEUDS TOUT
.HYP MEMB BIDIM GROUP "plate"
.PHP GROUP "plate" THICK VAL 0.1
.MAT
 I 1 YT 1E6 NT 0.3 M 10 A 1E-3 DAMPING 0.1
.AEL
 GROUP "plate" MAT 1
.FCT
 I 1 TABLE 0 0 1 1
.CLM
 FIX NOEUD 1 C 1 2
 FIX NOEUD 2 C 2
 GROUP "all" TEMP V 10 NF 1
.SAM TYPE {analysis} DISPLACEMENTS SMALL
.SUB TF 1 H 0.02
.FIN 1
"""
)


@pytest.mark.parametrize("analysis, delay", [("STATIC", 0.0), ("DYNAMIC", 0.1)])
def test_a_body_that_is_heated_follows_its_free_expansion(
    analysis: str, delay: float, tmp_path: Path
) -> None:
    found = run(HEATED.format(analysis=analysis), tmp_path)
    exact = 1e-2 * (found.t - delay * (1 - np.exp(-found.t / delay)) if delay else found.t)
    assert np.allclose(found["node/2/UX"], exact, rtol=0, atol=2e-5)
