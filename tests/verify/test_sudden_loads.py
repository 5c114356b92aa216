# SPDX-License-Identifier: BSD-3-Clause
"""Loads that act in full from the start, on meshes whose cells vibrate many times in a step: what is too
fast for the steps begins near its equilibrium (docs/decisions/0039-sudden-loads.md), and what they resolve
moves as it should."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from plane_meshes import Sheet, nodal_forces
from runs import Run, run
from solid_meshes import Block

ROOT = Path(__file__).resolve().parents[2]
LENGTH, HEIGHT, YOUNG, DENSITY = 1.0, 0.1, 2.1e11, 7850.0
POISSON = 0.3
FORCE = 1e6  # on the free end, per metre of thickness
PLATE = YOUNG / (1 - POISSON**2)  # plane strain bends as a plate
# Euler and Bernoulli: cos β cosh β = −1, and 12/β⁴ of the deflection in each mode
BETA = np.array([1.8751040687, 4.6940911330, 7.8547574382])
FREQUENCY = BETA**2 * np.sqrt(PLATE * HEIGHT**2 / 12 / (DENSITY * LENGTH**4))
PERIOD = float(2 * np.pi / FREQUENCY[0])


def cantilever(boxes, nodes: int) -> tuple[Sheet, list[str], list[str]]:
    """Its mesh, its deck up to the loads, and the records of a shear force on its free end."""
    mesh = Sheet(boxes, nodes, lambda u: np.array([LENGTH * u[0], HEIGHT * u[1]]))
    force = mesh.forces(lambda u: u[0] == 1, lambda _point, _normal: np.array([0, -FORCE / HEIGHT]))
    deck = [
        *mesh.model("strain", YOUNG, POISSON, density=DENSITY),
        mesh.group(2, "wall", mesh.nodes(lambda u: u[0] == 0)),
    ]
    return mesh, deck, nodal_forces(force)


def dynamics(sam: str, sub: str, checks: list[str]) -> list[str]:
    return [f".SAM TYPE DYNAMIC {sam}", f".SUB {sub}", ".CHK", *checks, ".FIN 1", ""]


def tip(boxes, nodes: int, sam: str, folder, steps: int = 100) -> tuple[Run, np.ndarray]:
    """A run over one period, and the deflection of the end over the static one of a beam."""
    mesh, deck, force = cantilever(boxes, nodes)
    end = int(mesh.nodes(lambda u: u[0] == 1 and u[1] == 0)[0]) + 1
    check = [f" NODE {end} UY V 0 ATOL 1"]
    clamped = ['.CLM\n GROUP "wall" FIX C 1 2', *force]
    sub = f"TF {PERIOD!r} H {PERIOD / steps!r}"
    found = run("\n".join([*deck, *clamped, *dynamics(sam, sub, check)]), folder)
    return found, -found[f"node/{end}/UY"] / (FORCE * LENGTH**3 / (3 * PLATE * HEIGHT**3 / 12))


def effort(folder) -> tuple[int, int, int]:
    """Steps, iterations and failed attempts, from the listing."""
    text = (folder / "deck.lst").read_text(encoding="utf-8")
    return tuple(map(int, re.search(r"(\d+) steps, (\d+) Newton.*, (\d+) failed", text).groups()))


@pytest.mark.parametrize(("nodes", "boxes"), [(3, (40, 8)), (6, (20, 4)), (4, (40, 8)), (8, (20, 4))])
def test_cantilevers_of_cells_swing_as_beams(nodes, boxes, tmp_path):
    found, deflection = tip(boxes, nodes, "RHO 0.8", tmp_path)
    beam = np.sum(12 / BETA**4 * (1 - np.cos(np.outer(found.t, FREQUENCY))), axis=1)
    # triangles of 3 nodes lock; all cells shear, which is 0.8 % of the deflection, and lengthens the period
    allowed = 0.08 if nodes == 3 else 0.03
    off = np.sqrt(np.mean((deflection - beam) ** 2)) / np.ptp(beam)
    steps, iterations, failed = effort(tmp_path)
    print(nodes, off, steps, iterations)
    assert off < allowed
    assert (steps, failed) == (100, 0)
    assert iterations <= 4 * steps


def test_finer_meshes_change_nothing(tmp_path):
    swings = []
    for i, boxes in enumerate([(10, 2), (20, 4), (40, 8)]):  # cells vibrate 16 to 64 times in a step
        (folder := tmp_path / str(i)).mkdir()
        swings.append(tip(boxes, 8, "RHO 0.8", folder)[1])
        assert effort(folder)[2] == 0
    coarse, fine = (np.abs(swings[i] - swings[i + 1]).max() / np.ptp(swings[2]) for i in (0, 1))
    print(coarse, fine)
    assert fine < min(coarse / 2, 4e-3)


def test_other_integrators_agree(tmp_path):
    swings = {}
    for sam in ("RHO 0.8", "RHO 0.8 TANGENT KEPT", "SCHEME NEWMARK", "SCHEME RADAU"):
        (folder := tmp_path / sam.replace(" ", "_")).mkdir()
        swings[sam] = tip((20, 4), 8, sam, folder)[1]
        assert effort(folder)[2] == 0
    truth = swings.pop("SCHEME RADAU")
    off = {sam: np.sqrt(np.mean((swing - truth) ** 2)) / np.ptp(truth) for sam, swing in swings.items()}
    print(off)
    assert max(off.values()) < 4e-3


def test_the_estimate_of_the_dial_sees_waves_that_neither_run_resolves(tmp_path):
    """Of the velocity at the struck end: TOL asks for five times as many steps as its companion has."""
    mesh, deck, force = cantilever((8, 1), 8)
    end = int(mesh.nodes(lambda u: u[0] == 1 and u[1] == 0)[0]) + 1
    sub, check = f"TF {PERIOD / 2!r} H {PERIOD / 100!r}", [f" NODE {end} VY V 0 ATOL 1E9"]
    velocities = []
    for sam, tolerance in (("SCHEME RADAU", " TOL 1e-4"), ("ACCURACY FAST", "")):
        clamped = ['.CLM\n GROUP "wall" FIX C 1 2', *force, *dynamics(sam, sub + tolerance, check)]
        velocities.append(run("\n".join([*deck, *clamped]), tmp_path)[f"node/{end}/VY"])
    truth, found = velocities
    error = np.sqrt(np.mean((found - truth) ** 2)) / np.ptp(truth)
    listing = (tmp_path / "deck.lst").read_text(encoding="utf-8")
    estimate = float(re.search(r"estimated error\s+(\S+),", listing)[1])
    print(estimate, error)
    assert error < 1e-2
    assert error / 3 < estimate < 10 * error


def test_a_mesh_on_a_hinge_turns_as_a_rigid_body(tmp_path):
    torque, steps = -2e4, 50
    mesh, deck, _ = cantilever((20, 4), 8)
    polar = DENSITY * HEIGHT * LENGTH * (LENGTH**2 / 3 + HEIGHT**2 / 12)
    last = (2 * 0.3 / abs(torque / polar)) ** 0.5  # it turns by 0.3 radians
    count = len(mesh.points)
    nodes = [f".NOE\n I {count + 1} X 0 Y {HEIGHT / 2}"]
    parts = [
        f'.MCE\n I 90001 RIGID_LINK N {count + 1} GROUP "wall"',
        f" I 90002 HINGE N 0 {count + 1} AXIS 0 0 1",
        f" I 90003 TORQUE N {count + 1} AXIS 0 0 1 V {torque!r}",
    ]
    checks = [" ELEMENT 90002 ANGLE V 0 ATOL 1E9", " RUN ENERGY_ERROR V 0 ATOL (1E-3*0.3*2E4)"]
    sam = "RHO 0.8 PLANE XY"
    found = run(
        "\n".join([*nodes, *deck, *parts, *dynamics(sam, f"TF {last!r} H {last / steps!r}", checks)]),
        tmp_path,
    )
    rigid = torque / polar * found.t**2 / 2
    assert np.abs(found["90002/ANGLE"] - rigid).max() < 0.02 * 0.3
    assert effort(tmp_path)[2] == 0


@pytest.mark.parametrize("h", [1e-5, 1e-6])
def test_parts_that_waves_have_not_reached_hold_up_no_step(h, tmp_path):
    """The wall of a cantilever follows a node that a drive holds; next to nothing arrives there yet."""
    mesh, deck, force = cantilever((20, 4), 8)
    count = len(mesh.points)
    end = int(mesh.nodes(lambda u: u[0] == 1 and u[1] == 0)[0]) + 1
    wall = [
        f'.MCE\n I 90001 RIGID_LINK N {count + 1} GROUP "wall"',
        f" I 90002 HINGE N 0 {count + 1} AXIS 0 0 1 DRIVE ANGLE NF 1\n.FCT I 1 TABLE 0 0 1 0\n.CLM",
    ]
    node = f".NOE\n I {count + 1} X 0 Y {HEIGHT / 2}"
    run_of = dynamics("RHO 0.8 PLANE XY", f"TF {10 * h!r} H {h!r}", [f" NODE {end} UY V 0 ATOL 1"])
    run("\n".join([node, *deck, *wall, *force, *run_of]), tmp_path)
    steps, iterations, failed = effort(tmp_path)
    assert (steps, failed) == (10, 0)
    assert iterations <= 30
    assert "so stiff that the rounding" not in (tmp_path / "deck.lst").read_text(encoding="utf-8")


@pytest.mark.parametrize("omega", [4, 6])
def test_periods_between_one_and_two_steps_do_not_gain_energy(omega, tmp_path):
    """A force begins to act on a mass: with M a = f its speed would be 1.7 to 2.7 times as large."""
    stiffness = omega**2
    deck = [
        ".NOE\n I 1 X 1 Y 0 Z 0",
        f".MCE\n I 1 INERTIA N 1 M 1\n I 2 SPRING N 0 1 K {stiffness!r} 0 0",
        f".CLM\n NOEUD 1 CHA C 1 V {stiffness * 1e-3!r}",
    ]
    checks = [f" NODE 1 {c} V 0 ATOL 1E9" for c in ("UX", "VX")]
    found = run("\n".join([*deck, *dynamics("RHO 0.8", "TF 30 H 1", checks)]), tmp_path)
    assert np.abs(found["node/1/VX"]).max() < 2.1e-3
    assert np.abs(found["node/1/UX"][1:] / 1e-3 - 1).max() < 0.5


def test_a_mesh_that_strikes_a_stop(tmp_path):
    """Half way down: how hard does not depend on the mesh, whose nodes become lighter."""
    peaks = []
    for i, boxes in enumerate([(10, 2), (30, 6)]):
        (folder := tmp_path / str(i)).mkdir()
        mesh, deck, force = cantilever(boxes, 8)
        end = int(mesh.nodes(lambda u: u[0] == 1 and u[1] == 0)[0]) + 1
        stop = f".MCE\n I 90001 STOP N 0 {end} NORMAL 0 1 0 ON 0 -0.015 0 K 1E8"
        checks = [" ELEMENT 90001 FORCE V 0 ATOL 1E9", " RUN ENERGY_ERROR V 0 ATOL (0.01*1E6*0.03)"]
        run_of = dynamics("RHO 0.8 PLANE XY", f"TF {PERIOD / 2!r} H {PERIOD / 100!r}", checks)
        found = run("\n".join([*deck, stop, '.CLM\n GROUP "wall" FIX C 1 2', *force, *run_of]), folder)
        peaks.append(found["90001/FORCE"].max())
        assert effort(folder)[2] == 0
    print(peaks)
    assert min(peaks) > FORCE
    assert np.ptp(peaks) < 0.01 * max(peaks)


def test_a_cantilever_of_solids(tmp_path):
    mesh = Block((16, 1, 2), 8, True, lambda u: np.array([LENGTH * u[0], HEIGHT * u[1], HEIGHT * u[2]]))
    wall, end = mesh.nodes(lambda u: u[0] == 0), mesh.nodes(lambda u: u[0] == 1)
    force = np.zeros_like(mesh.points)
    force[end, 2] = -FORCE * HEIGHT / len(end)
    deck = [
        *mesh.deck(),
        f'.SEL\n GROUP 1 MAILLES NOM "all" TOUT\n{mesh.group(2, "wall", wall)}',
        f'.MAT I 1 BEHA "ELASTIC" YT {YOUNG!r} NT {POISSON!r} M {DENSITY!r}\n.AEL GROUP "all" MAT 1',
        '.CLM\n GROUP "wall" FIX C 1 2 3',
        *nodal_forces(force),
    ]
    check = [f" NODE {end[0] + 1} UZ V 0 ATOL 1"]
    period = PERIOD * (PLATE / YOUNG) ** 0.5
    found = run(
        "\n".join([*deck, *dynamics("RHO 0.8 SOLVER MUMPS", f"TF {period!r} H {period / 40!r}", check)]),
        tmp_path,
    )
    deflection = -found[f"node/{end[0] + 1}/UZ"] / (FORCE * LENGTH**3 / (3 * YOUNG * HEIGHT**3 / 12))
    beam = np.sum(12 / BETA**4 * (1 - np.cos(np.outer(found.t, FREQUENCY * np.sqrt(YOUNG / PLATE)))), axis=1)
    assert np.sqrt(np.mean((deflection - beam) ** 2)) < 0.03 * np.ptp(beam)
    assert effort(tmp_path)[2] == 0


def oscillators(steps: int, folder, sam: str = "RHO 0.8") -> Run:
    """Two masses on springs, of the periods 1 and 1e-4: a force begins to act on each."""
    stiff, soft = (2e4 * np.pi) ** 2, (2 * np.pi) ** 2
    deck = [
        ".NOE\n I 1 X 1 Y 0 Z 0\n I 2 X 1 Y 1 Z 0",
        ".MCE\n I 1 INERTIA N 1 M 1\n I 2 INERTIA N 2 M 1",
        f" I 3 SPRING N 0 1 K {stiff!r} 0 0\n I 4 SPRING N 0 2 K {soft!r} 0 0",
        f".CLM\n NOEUD 1 CHA C 1 V {stiff * 1e-3!r}\n NOEUD 2 CHA C 1 V {soft * 1e-3!r}",
    ]
    checks = [f" NODE {n} {c} V 0 ATOL 1E9" for n in (1, 2) for c in ("UX", "VX")]
    return run("\n".join([*deck, *dynamics(sam, f"TF 1.25 H {1.25 / steps!r}", checks)]), folder)


def test_what_is_too_fast_begins_in_its_equilibrium(tmp_path):
    found = oscillators(80, tmp_path)
    # with the acceleration of the first instant it would swing between 0.1 and 1.9 of this
    assert np.abs(found["node/1/UX"][1:] / 1e-3 - 1).max() < 1e-3
    # what it has jumped by in the first step fades with ρ∞ⁿ, times n
    speeds = np.abs(found["node/1/VX"])
    assert speeds.max() < 3 * 1e-3 / (1.25 / 80)
    assert speeds[60:].max() < 60 * 0.8**60 * speeds.max()


def test_what_is_resolved_beside_it_keeps_the_second_order(tmp_path):
    errors = []
    for steps in (50, 100, 200):
        (folder := tmp_path / str(steps)).mkdir()
        found = oscillators(steps, folder)
        errors.append(np.abs(found["node/2/UX"] / 1e-3 - 1 + np.cos(2 * np.pi * found.t)).max())
    orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    print(errors, orders)
    assert np.all(np.abs(orders - 2) < 0.1)


def test_what_steps_resolve_is_not_touched(tmp_path):
    """The start says when accelerations are softened: the slow mass alone has its own."""
    oscillators(80, tmp_path)
    listing = (tmp_path / "deck.lst").read_text(encoding="utf-8")
    assert "periods shorter than two steps" in listing
    slow = re.sub(r" NOEUD 1 CHA.*\n", "", (tmp_path / "deck.dat").read_text())
    found = run(slow, tmp_path, "slow")
    assert "periods shorter" not in (tmp_path / "slow.lst").read_text(encoding="utf-8")
    assert found["node/2/VX"][0] == 0


@pytest.mark.parametrize("step", [5e-3, 2e-3, 1.5e-3, 1e-3, 7e-4, 6e-4])
def test_teeth_that_bounce_do_not_shake_what_is_stiff(step: float, tmp_path: Path) -> None:
    """A gearbox whose bearings and shafts vibrate hundreds of times in a step, and whose teeth meet two or
    three events within a hundredth of one. With accelerations taken for constant from each to the next it
    ended with status 2 at these steps. RADAU gives the same speed with TOL 1e-4, 1e-5 and 1e-6 to 8e-8."""
    text = (ROOT / "decks/trains/shaft_gearbox.dat").read_text(encoding="utf-8").split(".SAM")[0]
    cards = dynamics("SCHEME CHUNG RHO 0.8 SOLVER KLU", f"TF 0.05 H {step}", [])
    cards.remove(".CHK")
    done = run(text + "\n".join(cards), tmp_path)
    assert done["run/ENERGY_ERROR"].max() < 0.2  # N·m, of 80 that pass through it: none is won
    if step < 2e-3:
        assert done["node/1/WZ"][-1] == pytest.approx(148.9998, rel=0.02)


def test_a_jump_of_a_force_behind_an_event_is_no_slope(tmp_path: Path) -> None:
    """The pin of a Geneva wheel in the mouth of a slot pushes now one flank, now the other. Where that fell
    into the hundredth of a step from which the scheme has its slope of accelerations, the wheel shot away:
    it won 7.8e-4 of energy, where the machine had 4.4e-4, and the run ended with status 2."""
    text = (ROOT / "decks/mechanisms/geneva_index.dat").read_text(encoding="utf-8").split(".SAM")[0]
    done = run(text + ".SAM TYPE DYNAMIC SCHEME HHT ALPHA 0.1\n.SUB TF 0.012 H 1e-4\n.FIN 1\n", tmp_path)
    assert abs(done["run/ENERGY_ERROR"]).max() < 5e-5  # 2.2e-5


def test_the_direction_of_a_model_does_not_decide_what_begins_near_its_equilibrium(tmp_path) -> None:
    """A mass that a force pushes, and one on a spring along another direction. Largest components of forces
    were compared: turned, the second began with 10 m/s2 for 60."""
    deck = """
.NOE
 I 1
 I 2 X {along}
.MCE
 I 10 INERTIA N 1 M 1
 I 20 FORCE N 1 DIR {across} V 100
 I 30 INERTIA N 2 M 1
 I 40 SPRING N 0 2 K 1E4 AT 0 0 0
 I 50 FORCE N 2 DIR {along} V 60
 I 60 POINT_LINE N 0 2 AXIS {along}
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.0447
.FIN
"""
    turned = run(deck.format(along="1 1 1", across="1 0 0"), tmp_path)
    axes = {"along": f"{3**0.5!r} 0 0", "across": f"{3**-0.5!r} {-(3**-0.5)!r} {-(3**-0.5)!r}"}
    lined_up = run(deck.format(**axes), tmp_path, name="lined_up")
    across = np.linalg.norm([turned[f"node/2/A{x}"][0] for x in "XYZ"])
    assert across == pytest.approx(abs(lined_up["node/2/AX"][0]))
    way = [turned[f"node/2/U{x}"] for x in "XYZ"]
    assert np.linalg.norm(way, axis=0) == pytest.approx(np.abs(lined_up["node/2/UX"]), abs=1e-9)
