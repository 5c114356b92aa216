# SPDX-License-Identifier: BSD-3-Clause
"""Slow sweeps of the clearance oscillator through both branches and both jumps, against its own equation.

The loss of contact at W = 0.8206, where the linear amplitude reaches F_m, starts the jump up; on the way down
the motion with impacts ends between W = 0.75 and 0.70 (0.71 and 0.705 by the oracle's steady states), but
needs time to die, so the sweep waits at 0.70. The program is taken from the variable ENGRANE.

    ENGRANE=build/bin/engrane python tests/verify/test_clearance_oscillator.py      draws docs/figures
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest

np = pytest.importorskip("numpy")

from oracles import clearance_oscillator as oracle  # noqa: E402
from runs import Run, engrane  # noqa: E402

RATE = 8e-5  # of the frequency, per unit of time: 0.0006 a period
STEP = 0.05
LOSS_OF_CONTACT = 0.8206
HALF_WAY = 0.13  # between the branches
WAIT = 600.0


def oscillator(title: str, force: str, start: tuple[float, float], end: float) -> str:
    """The deck: a pair of gears in the oscillator's units, whose wheel A swings between flanks of B."""
    return f""".TITRE "{title}"
.NOE
 I 1 X 2 0 0
.FCT
 I 1 EXPR "{force}"
.MCE
 I 1 HINGE   N 0 1 AXIS 0 0 1
 I 2 GEAR    N 1 0 AXIS 0 0 1 Z 20 20 MN 0.1 KM 1 CM 0.1 JEU 2 SMOOTH 0 DAMP ALWAYS
 I 3 INERTIA N 1 J 1
.CLM
 CHA NOEUD 1 C 6 V 1 NF 1
.INI
 DEP NOEUD 1 C 6 V ({start[0] - 1}*180/PI) IMPOSED
 VIT NOEUD 1 C 6 V {start[1]}
.SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.8 SOLVER KLU
.SUB TF {end} H {STEP}
.SAI FIELDS DT {end / 10} HISTORY DT {2 * STEP}
.FIN 1
"""


def swing(deck: str, folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Times and x of a run."""
    done = engrane(deck, folder, "-q", name="swing")
    assert done.returncode == 0, done.stderr
    result = Run(folder / "swing.h5")
    return result.t, 1 + result["2/U_M"]


def sweep(first: float, last: float, start: tuple[float, float], folder: Path) -> dict[str, np.ndarray]:
    """x by engrane and by the oracle, from W = first to last, and the phase of the force at the times."""
    rate = RATE if last > first else -RATE
    hold = (last - first) / rate
    end = hold + WAIT
    s = f"min(T, {hold})"
    size = f"0.05*({first} + ({rate})*{s})**2"
    force = f"0.1 + {size}*cos(({first} + ({rate / 2})*{s})*{s} + {last}*(T - {s}))"
    deck = oscillator(f"clearance oscillator, swept from {first} to {last}", force, start, end)
    t, x = swing(deck, folder)
    exact = oracle.simulate(start, first, t, rate, hold, rtol=1e-8)[0]
    swept = np.minimum(t, hold)
    phase = (first + rate / 2 * swept) * swept + last * (t - swept)
    return {"t": t, "engrane": x, "oracle": exact, "phase": phase, "W": first + rate * swept}


def branches(run: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Frequency, and rms of x less its mean by engrane and by the oracle, over every three periods."""
    number = np.floor(run["phase"] / (6 * np.pi)).astype(int)
    groups = [number == k for k in range(number[-1])]
    out = {"W": np.array([run["W"][g].mean() for g in groups])}
    for name in ("engrane", "oracle"):
        out[name] = np.array([run[name][g].std() for g in groups])
    return out


def jump(rms: np.ndarray, frequency: np.ndarray) -> float:
    """The first frequency on the other side of the gap between the branches."""
    side = rms > HALF_WAY
    return float(frequency[np.flatnonzero(side != side[0])[0]])


def both_sweeps(folder: Path) -> dict[str, dict[str, np.ndarray]]:
    down_start = oracle.steady((1.3, 0.3), 0.9)[2]
    return {
        "up": branches(sweep(0.7, 0.9, oracle.linear_start(0.7), folder)),
        "down": branches(sweep(0.9, 0.7, down_start, folder)),
    }


def test_sweeps(tmp_path: Path) -> None:
    found = both_sweeps(tmp_path)
    jumps = {}
    for name, run in found.items():
        mine, right = jump(run["engrane"], run["W"]), jump(run["oracle"], run["W"])
        jumps[name] = mine
        away = np.abs(run["W"] - right) > 0.01
        worst = np.abs(run["engrane"] - run["oracle"])[away].max()
        print(f"\n{name}: jump at W = {mine:.4f}, oracle {right:.4f}; rms elsewhere within {worst:.1e}")
        assert mine == pytest.approx(right, abs=0.004)  # two groups of three periods
        assert worst < 1e-3
    # a swept jump comes late, by the time that the new motion needs to grow
    assert LOSS_OF_CONTACT < jumps["up"] < LOSS_OF_CONTACT + 0.015
    down = found["down"]
    assert down["engrane"][down["W"] > 0.75].min() > HALF_WAY
    assert down["engrane"][-1] == pytest.approx(oracle.linear_rms(0.7), abs=1e-3)


@pytest.mark.parametrize("offset", [-0.0002, 0.0002])
def test_contact_is_lost_where_the_lower_branch_ends(offset: float, tmp_path: Path) -> None:
    """Held just below and just above 0.8206, from the motion without impacts: whether flanks part at all."""
    frequency = LOSS_OF_CONTACT + offset
    force = f"0.1 + {0.05 * frequency**2!r}*cos({frequency!r}*T)"
    t, x = swing(oscillator("held", force, oracle.linear_start(frequency), 600), tmp_path)
    events = Run(tmp_path / "swing.h5")["run/EVENTS"][-1]
    if offset < 0:
        assert events == 0
        assert x[t > 500].std() == pytest.approx(oracle.linear_rms(frequency), rel=2e-3)
    else:
        assert events > 50  # twice a period
        assert x.min() < 1


def draw() -> None:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    with tempfile.TemporaryDirectory() as folder:
        found = both_sweeps(Path(folder))
    figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
    for (name, run), color, marker in zip(found.items(), ("tab:blue", "tab:red"), ("^", "v"), strict=True):
        axes.plot(run["W"], run["oracle"], color="black", lw=0.8, label="oracle" if name == "up" else None)
        axes.plot(run["W"], run["engrane"], marker, color=color, ms=3.5, label=f"engrane, sweep {name}")
    axes.axvline(LOSS_OF_CONTACT, color="grey", lw=0.8, ls=":")
    axes.text(LOSS_OF_CONTACT + 0.002, 0.03, "loss of contact", color="grey", fontsize=9)
    axes.set(xlabel="frequency of the force W", ylabel="rms of x less its mean", ylim=(0, None))
    axes.legend(frameon=False)
    target = Path(__file__).resolve().parents[2] / "docs/figures/clearance_oscillator.png"
    figure.savefig(target, dpi=150)
    print(target)


if __name__ == "__main__":
    draw()
