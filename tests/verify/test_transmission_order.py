# SPDX-License-Identifier: BSD-3-Clause
"""Order of convergence in time: cases A and B of the spur transmission against their differential equation.

With steps h, h/2, h/4, h/8 the errors of tooth force, u_m and amplitude must fall as
the square of h. The program is taken from the variable ENGRANE; `pytest -s` prints the table.
"""

from __future__ import annotations

from pathlib import Path

import pytest

np = pytest.importorskip("numpy")

from oracles import spur_transmission as oracle  # noqa: E402
from runs import run  # noqa: E402

DECKS = Path(__file__).resolve().parents[2] / "decks" / "paper"
END = 1e-3  # five tooth periods
STEPS = (4e-6, 2e-6, 1e-6, 5e-7)
CHANNELS = {"force": "NORMAL_FORCE", "u_m": "U_M"}


def short_run(case: str, step: float, folder: Path) -> dict[str, np.ndarray]:
    """Histories of a short run of the paper's deck with this step."""
    name = f"{case}_{step:g}"
    text = (DECKS / f"spur_transmission_{case.lower()}.dat").read_text()
    head = text[: text.rindex(".FIN")]
    stepping = f".DEL.CHK\n.DEL.SUB\n.SUB TF {END:g} H {step:g}\n.FIN 1\n"
    result = run(head + stepping, folder, name)
    out = {key: result[f"7/{channel}"] for key, channel in CHANNELS.items()}
    out["t"] = result.t
    assert len(out["t"]) == round(END / step) + 1
    return out


def errors(mine: dict[str, np.ndarray], exact: dict[str, np.ndarray], every: int) -> dict[str, float]:
    """Errors at the times of the coarsest run: relative to the amplitude of each quantity."""
    out = {}
    for key in CHANNELS:
        true = exact[key]
        size = np.ptp(true) / 2
        difference = (mine[key][::every] - true) / size
        out[f"{key}, largest"] = float(np.abs(difference).max())
        out[f"{key}, rms"] = float(np.sqrt(np.mean(difference**2)))
        out[f"{key}, amplitude"] = abs(float(np.ptp(mine[key][::every]) / 2 - size)) / size
    return out


@pytest.mark.parametrize("case", ["A", "B"])
def test_second_order(case: str, tmp_path: Path) -> None:
    times = np.linspace(0, END, round(END / STEPS[0]) + 1)
    record = oracle.simulate(case, "ALWAYS", END, 1e-11, times=times)
    exact = {"force": record["normal"], "u_m": record["u"]}
    found = []
    for step in STEPS:
        mine = short_run(case, step, tmp_path)
        every = round(STEPS[0] / step)
        assert np.allclose(mine["t"][::every], times, rtol=0, atol=1e-12)
        found.append(errors(mine, exact, every))
    print(f"\ncase {case}: errors relative to the amplitude for h = " + ", ".join(f"{h:g}" for h in STEPS))
    for key in found[0]:
        values = np.array([f[key] for f in found])
        slopes = np.log2(values[:-1] / values[1:])
        print(
            f"  {key:17s}",
            " ".join(f"{v:.3e}" for v in values),
            "  slopes",
            " ".join(f"{s:.3f}" for s in slopes),
        )
        assert slopes[1:] == pytest.approx([2, 2], abs=0.2), f"{key}: slopes {slopes}"
