# SPDX-License-Identifier: BSD-3-Clause
"""Beams that move, against closed forms and what their scheme conserves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from beam_problems import Line, clamp, deck, orders, straight
from oracles import flexible_crank as crank
from runs import run
from scipy.optimize import brentq, least_squares

ROD = "EA 1D4 GA 1D4 1D4 GJ 500 EI 500 500 M 1 J 10 10 10"  # Simo and Vu-Quoc 1988, the flying beam in space
ROD_FOOT, ROD_HEAD = np.array([6.0, 0, 0]), np.array([0.0, 8, 0])


def rod(u: float) -> np.ndarray:
    return ROD_FOOT + u * (ROD_HEAD - ROD_FOOT)


def thrown(line: Line, sam: str, end: float, step: float) -> str:
    """A rod thrown by a force and moments on its foot: largest at 2.5 s, after 5 s it is free."""
    return f""".CLM
 CHA NOEUD {line.ids[0]} C 1 V 8 NF 1
 CHA NOEUD {line.ids[0]} C 5 V -40 NF 1
 CHA NOEUD {line.ids[0]} C 6 V -80 NF 1
.FCT
 I 1 TABLE 0 0 2.5 1 5 0 {end + 5} 0
.SAM TYPE DYNAMIC {sam}
.SUB TF {end} H {step}
.SAI HISTORY {10 * step}"""


def test_thrown_rod(tmp_path: Path) -> None:
    """The centre of mass of a free rod that tumbles flies straight, with the momentum of the push."""
    line = Line(rod, 5)
    found = run(deck([line], ROD, thrown(line, "", 10, 0.02)), tmp_path)
    weights = np.zeros(len(line.ids))
    for piece in range(line.pieces):
        weights[2 * piece : 2 * piece + 3] += np.array([1, 4, 1]) / (6 * line.pieces)
    velocity = [
        sum(w * found[f"node/{i}/V{c}"] for w, i in zip(weights, line.ids, strict=True)) for c in "XYZ"
    ]
    velocity = np.array(velocity)
    free = found.t > 6
    assert np.ptp(found[f"node/{line.last}/UZ"]) > 1
    impulse, mass = 8 * 2.5, 10
    assert velocity[0][free] == pytest.approx(impulse / mass, rel=1e-6)
    assert np.ptp(velocity[:, free], axis=1).max() < 1e-10


def test_energy(tmp_path: Path) -> None:
    """Of the free rod: with RHO 1 kept for 8000 steps, with 0.8 lost, and never gained."""
    line = Line(rod, 2)
    for rho in (1, 0.8):
        found = run(deck([line], ROD, thrown(line, f"RHO {rho}", 165, 0.02)), tmp_path)
        energy = (found["run/KINETIC_ENERGY"] + found["run/POTENTIAL_ENERGY"])[found.t > 5.1]
        drift = energy / energy[0] - 1
        assert abs(drift).max() < 1.5e-5
        assert (drift[-1] < -3e-6) == (rho < 1)


def crank_deflection(pieces: int, folder: Path) -> np.ndarray:
    """Of the middle of the rod of decks/mechanisms/flexible_slider_crank.dat, for half a turn."""
    line = Line(lambda u: np.array([crank.CRANK + crank.LENGTH * u, 0, 0]), pieces, first=2)
    moved, speeds, spins = crank.start(np.linspace(0, 1, len(line.ids)))
    pin, middle, last, block = line.ids[0], line.ids[pieces], line.last, line.last + 1
    joints = f""" I 101 HINGE N 0 1 AXIS 0 0 1 DRIVE SPEED NF 1
 I 102 HINGE N 1 {pin} AXIS 0 0 1 AT {crank.CRANK} 0 0
 I 103 HINGE N {last} {block} AXIS 0 0 1
 I 104 PRISMATIC N 0 {block} AXIS 1 0 0
 I 105 INERTIA N {block} M {crank.BLOCK}
.MAT
 I 1 YT {crank.YOUNG} NT {crank.POISSON} M {crank.DENSITY}
.NOE
 I 1
 I {block} X {crank.CRANK + crank.LENGTH}"""
    start = "\n".join(
        f" DEP NOEUD {i} C 1 V {u:.16g}\n VIT NOEUD {i} C 2 6 V {v:.16g} {w:.16g}"
        for i, u, v, w in zip(line.ids, moved, speeds, spins, strict=True)
    )
    rest = f""".FCT
 I 1 EXPR "{crank.SPEED}"
.INI
 VIT NOEUD 1 C 6 V {crank.SPEED}
 DEP NOEUD {block} C 1 V {moved[-1]:.16g}
{start}
.SAM TYPE DYNAMIC SCHEME RADAU SOLVER KLU PLANE XY
.SUB TF {crank.TURN / 2!r} H {crank.TURN / 500!r}
.SAI HISTORY {crank.TURN / 20!r}"""
    section = f"RECTANGLE {crank.SIDE} {crank.SIDE}"
    found = run(deck([line], section, rest, "BPR 1 MAT 1 AXIS2 0 1 0", joints), folder)
    places = [
        np.array([line.points[i - 2, 0] + found[f"node/{i}/UX"], found[f"node/{i}/UY"]]).T
        for i in (pin, middle, last)
    ]
    return crank.deflection(*places)[1:]


def test_flexible_slider_crank(tmp_path: Path) -> None:
    """The middle of the rod bends by 1.5 mm as that of Reissner's rod by polynomials of its whole length."""
    exact = crank.DEFLECTIONS[:10]
    errors = [abs(crank_deflection(pieces, tmp_path) - exact).max() for pieces in (2, 4)]
    assert errors[0] < 1.2e-5
    assert errors[1] < 8e-7


def whirl(pieces: int, end: float, folder: Path) -> np.ndarray:
    """Forward and backward whirl of the first form of a simply supported spinning shaft, measured. Rayleigh's
    beam, without shear, has (rho A + rho I k2) w2 - 2 rho I k2 W w - EI k4 = 0."""
    diameter, young, density, speed = 0.05, 2.1e11, 7850.0, 5000.0
    area, moment = np.pi / 4 * diameter**2, np.pi / 64 * diameter**4
    line = Line(straight(1), pieces)
    ea, ei, m, j = young * area, young * moment, density * area, density * moment
    section = (
        f"EA {ea!r} GA {1e3 * ea!r} {1e3 * ea!r} GJ {ei!r} EI {ei!r} {ei!r} M {m!r} J {2 * j!r} {j!r} {j!r}"
    )
    form = np.sin(np.pi * line.points[:, 0])
    slope = np.pi * np.cos(np.pi * line.points[:, 0])
    start = "\n".join(
        f" VIT NOEUD {i} C 2 4 6 V {1e-3 * w:.16g} {speed!r} {1e-3 * s:.16g}"
        for i, w, s in zip(line.ids, form, slope, strict=True)
    )
    rest = f""".CLM
 FIX NOEUD {line.ids[0]} C 1 2 3
 FIX NOEUD {line.last} C 2 3
.INI
{start}
.SAM TYPE DYNAMIC SCHEME RADAU
.SUB TF {end} H 2e-5 TOL 1e-5
.SAI HISTORY 2e-4"""
    found = run(deck([line], section, rest), folder)
    middle = line.ids[len(line.ids) // 2]
    orbit = found[f"node/{middle}/UY"] + 1j * found[f"node/{middle}/UZ"]

    def rest_of(frequencies: np.ndarray) -> np.ndarray:
        waves = np.exp(1j * np.outer(found.t, frequencies))
        amplitudes = np.linalg.lstsq(waves, orbit, rcond=None)[0]
        gap = (waves @ amplitudes - orbit) / abs(orbit).max()
        return np.concatenate([gap.real, gap.imag])

    return least_squares(rest_of, [640, -635], x_scale=100, xtol=1e-14, ftol=1e-14, gtol=1e-14).x


def test_whirling_shaft(tmp_path: Path) -> None:
    """Errors of the forward and the backward whirl are those of bending, of order 4."""
    closed = np.array([645.34766881, -629.95015683])
    errors = [whirl(pieces, 0.02, tmp_path) / closed - 1 for pieces in (2, 4)]
    assert errors[0] == pytest.approx([1.156e-2, 1.122e-2], rel=0.02)
    assert errors[1] == pytest.approx([7.79e-4, 7.55e-4], rel=0.02)


def frequencies(signal: np.ndarray, step: float, count: int) -> np.ndarray:
    """Of so many undamped waves, Hz: the matrix pencil of Hua and Sarkar (1990)."""
    rows = np.lib.stride_tricks.sliding_window_view(signal, len(signal) // 2)
    right = np.linalg.svd(rows, full_matrices=False)[2][: 2 * count]
    turns = np.linalg.eigvals(np.linalg.pinv(right[:, :-1].T) @ right[:, 1:].T)
    found = np.sort(abs(np.angle(turns)) / (2 * np.pi * step))
    return found[::2]


def test_geared_shafts(tmp_path: Path) -> None:
    """Free vibration of geared shafts on bearings, about their equilibrium. As finite elements of
    Timoshenko's beam the same shafts, with bending and twist coupled by the teeth, have 571.748 and
    2523.572 Hz. Teeth that follow the running centre distance couple along the line of action."""
    deck = (Path(__file__).parents[2] / "decks/mechanisms/geared_shafts.dat").read_text()
    deck = deck[: deck.index(".CLM")].replace("WIDTH 0.03", "WIDTH 0.03 RUNNING JEU 1D-4")
    held, almost_free = "TSPRING N 0 19 AXIS 0 0 1 K 1D9", "TSPRING N 0 19 AXIS 0 0 1 K 1D-2"
    assert held in deck
    deck = deck.replace(held, almost_free)
    step = 2e-5
    deck += f""".CLM
 CHA NOEUD 1 19 C 6 V 100
.INI
 VIT NOEUD 5 C 6 V 0.01
.SAM TYPE DYNAMIC SCHEME RADAU START STATIC
.SUB TF 0.01 H {step} TOL 1e-4
.SAI HISTORY {step}
.FIN 1
"""
    twist = run(deck, tmp_path)["31/U_M"]
    assert frequencies(twist[1:], step, 4)[1:3] == pytest.approx([571.748, 2523.572], rel=5e-4)


def cantilever(pieces: int, roots: np.ndarray, folder: Path) -> np.ndarray:
    """First natural frequencies of a slender cantilever, L = EI = 1 and a mass of 1 per length, measured: it
    is thrown with its first forms, and its tip swings in as many waves."""
    line = Line(straight(1), pieces)
    x = line.points[:, 0]
    speed, spin = np.zeros_like(x), np.zeros_like(x)
    for b in roots:
        ratio = (np.cosh(b) + np.cos(b)) / (np.sinh(b) + np.sin(b))
        speed += 1e-4 * (np.cosh(b * x) - np.cos(b * x) - ratio * (np.sinh(b * x) - np.sin(b * x)))
        spin += 1e-4 * b * (np.sinh(b * x) + np.sin(b * x) - ratio * (np.cosh(b * x) - np.cos(b * x)))
    start = "\n".join(
        f" VIT NOEUD {i} C 2 6 V {v:.16g} {w:.16g}"
        for i, v, w in zip(line.ids[1:], speed[1:], spin[1:], strict=True)
    )
    step = 4e-3
    rest = f""".CLM
 {clamp(line.ids[0])}
.INI
{start}
.SAM TYPE DYNAMIC SCHEME RADAU SOLVER KLU PLANE XY
.SUB TF 1 H {step}
.SAI HISTORY {step}"""
    section = "EA 1 GA 1 1 GJ 1 EI 1 1 M 1 J 0 0 0"
    found = run(deck([line], section, rest, "BPR 1 AXIS2 0 1 0 INEXTENSIBLE UNSHEARABLE"), folder)
    return 2 * np.pi * frequencies(found[f"node/{line.last}/UY"][1:], step, len(roots))


def test_cantilever(tmp_path: Path) -> None:
    """(beta L)^2 = 3.51601526850, 22.03449156467, 61.69721441355 of Euler's beam: cos(b) cosh(b) = -1. Errors
    with 4, 8 and 16 pieces have order 4, and what is extrapolated from 8 and 16 has only what is left."""
    roots = np.array(
        [brentq(lambda b: np.cos(b) * np.cosh(b) + 1, low, low + 1.5, xtol=1e-14) for low in (1.5, 4.0, 7.0)]
    )
    exact = roots**2
    found = [cantilever(pieces, roots, tmp_path) for pieces in (4, 8, 16)]
    errors = [w / exact - 1 for w in found]
    assert errors[0] == pytest.approx([1.14e-4, 3.76e-3, 2.78e-2], rel=0.01)
    assert errors[2] == pytest.approx([3.95e-7, 1.538e-5, 1.197e-4], rel=0.01)
    assert orders(errors)[-1] == pytest.approx(4, abs=0.06)
    assert (16 * found[2] - found[1]) / 15 == pytest.approx(exact, rel=4e-6)
    assert ((16 * found[2] - found[1]) / 15)[0] == pytest.approx(3.51601526850, rel=3e-8)
