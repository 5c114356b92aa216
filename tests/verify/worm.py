# SPDX-License-Identifier: BSD-3-Clause
"""Efficiency of a worm drive over lead angle and friction, driven from either side, against the closed
form.

Run it to make docs/figures/worm_efficiency.png: `python tests/verify/worm.py` with the program in
the variable ENGRANE."""

from __future__ import annotations

import tempfile
from math import cos, degrees, radians, tan
from pathlib import Path

from runs import Run, run

ALPHA = radians(14.5)
LEADS = (2.0, 5.0, 9.46232221, 15.0, 25.0, 40.0)
FRICTIONS = (0.0, 0.03, 0.1)


def closed_form(lead: float, mu: float, worm_drives: bool) -> float:
    """(cos a_n - mu tan L)/(cos a_n + mu cot L) where the worm drives; with the wheel driving friction
    changes side, and below zero the wheel cannot turn the worm."""
    c = cos(ALPHA)
    if worm_drives:
        return (c - mu * tan(lead)) / (c + mu / tan(lead))
    return (c - mu / tan(lead)) / (c + mu * tan(lead))


def deck(lead: float, mu: float, worm_drives: bool, analysis: str, more: str = "") -> str:
    """Two threads, 30 teeth, module 1 in the wheel's plane; a torque of 1000 on the wheel, which drives
    or resists."""
    radius = 1 / tan(lead)
    module = cos(lead)
    # for a positive turn of the worm the wheel turns in the negative sense about its axle
    torque = 1000 if worm_drives else -1000
    drive = "DRIVE SPEED NF 1" if analysis == "KINEMATIC" else ""
    stepping = ".SUB TF 0.01 H 0.01" if analysis == "KINEMATIC" else ".SUB TF 0.2 H 0.0005"
    return f""".NOE
 I 1 X 0 0 0
 I 2 X 0 0 {-(radius + 15)!r}
.MCE
 I 1 HINGE N 0 1 AXIS 1 0 0 {drive}
 I 2 HINGE N 0 2 AXIS 0 1 0
 I 3 GEAR N 1 2 AXIS 1 0 0 AXISB 0 1 0 Z 2 30 MN {module!r} ALPHA 14.5 $
     HELIX {90 - degrees(lead)!r} {degrees(lead)!r} FRICTION CONST {mu!r} VREG 0.01
 I 4 TORQUE N 2 AXIS 0 1 0 V {torque}
{more}.FCT
 I 1 EXPR "20"
.SAM TYPE {analysis}
{stepping}
.FIN 1
"""


def steady(lead: float, mu: float, worm_drives: bool, folder: Path) -> Run:
    """The worm turns at 20 rad/s, whatever torque that needs."""
    return run(deck(lead, mu, worm_drives, "KINEMATIC"), folder)


def locking_friction(lead: float) -> float:
    return cos(ALPHA) * tan(lead)


def released(lead: float, mu: float, folder: Path) -> Run:
    """Nothing holds the worm, and the torque pulls at the wheel; both have inertia."""
    inertia = " I 5 INERTIA N 1 M 1 J 5 1 1\n I 6 INERTIA N 2 M 1 J 1 50 1\n"
    return run(deck(lead, mu, False, "DYNAMIC", inertia), folder)


def main() -> None:
    import matplotlib.pyplot as plt
    import numpy as np
    from engrane_post import style

    plt.rcParams.update(style.RC)
    figure, axes = plt.subplots(1, 2, figsize=(10, 4), sharey=True)
    angles = np.radians(np.linspace(1, 45, 200))
    with tempfile.TemporaryDirectory() as folder:
        for axis, worm_drives in zip(axes, (True, False), strict=True):
            for i, mu in enumerate((0.02, 0.05, 0.1, 0.2)):
                line = [max(0.0, closed_form(a, mu, worm_drives)) for a in angles]
                axis.plot(np.degrees(angles), line, color=f"C{i}", label=f"friction {mu:g}")
                for lead in (2, 5, 10, 15, 20, 25, 30, 35, 40, 45):
                    found = steady(radians(lead), mu, worm_drives, Path(folder))["3/EFFICIENCY"][-1]
                    axis.plot(lead, found, "o", color=f"C{i}", markersize=4)
            axis.set_xlabel("lead angle, degrees")
            axis.set_title(
                "worm drives the wheel" if worm_drives else "wheel drives the worm: self-locking at 0"
            )
            axis.set_ylim(0, 1)
    axes[0].set_ylabel("efficiency")
    axes[0].legend(loc="lower right", title="lines: closed form, points: engrane")
    figure.tight_layout()
    figure.savefig(Path(__file__).resolve().parents[2] / "docs" / "figures" / "worm_efficiency.png", dpi=110)


if __name__ == "__main__":
    main()
