# SPDX-License-Identifier: BSD-3-Clause
"""Runs of 10^4 to 10^7 steps: energy, amplitude, closed constraints and memory must not drift.

    python tests/bench/long_runs.py build/bin/engrane [--steps 10000 1000000] [--models pendulum]

pendulum: a rigid body on a hinge, RHO 0.9, released from the horizontal, H = 0.01 (about 220 steps a
period); what RHO dissipates is seen, too. spring: a mass that circles on a spring, without damping (NEWMARK).
rod, damped_rod: a beam that is thrown and tumbles, RHO 1 and 0.8; its energy counts from the end of the push.
Prints a Markdown table: the energy at the end less the one at the start, over the largest kinetic energy; the
largest difference on the way;
the amplitude (the largest depth or length in the second half), over that of the first run, less 1; the
largest gap in the hinge; peak memory in MB.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "post"))
from engrane_post import Results  # noqa: E402

H = 0.01
PENDULUM = """.NOE
 I 1 X 1
.MCE
 I 1 HINGE N 0 1 AXIS 0 1 0 AT 0 0 0
 I 2 INERTIA N 1 M 2 J 0.1
.CLM STRU ACC VAL 0 0 -9.81
.SAM TYPE DYNAMIC RHO 0.9 SOLVER KLU
"""
SPRING = """.NOE
 I 1
 I 2 X 1
.MCE
 I 1 SPRING N 1 2 K 100
 I 2 INERTIA N 2 M 1
.CLM FIX NOEUD 1 C 1 2 3
.INI
 DEP NOEUD 2 C 1 V 0.3
 VIT NOEUD 2 C 2 V 5
.SAM TYPE DYNAMIC SCHEME NEWMARK SOLVER KLU
"""
ROD = """.NOE
 I 1 X 6
 I 2 X 4.5 2
 I 3 X 3 4
 I 4 X 1.5 6
 I 5 X 0 8
.BPR
 I 1 EA 1E4 GA 1E4 1E4 GJ 500 EI 500 500 M 1 J 10 10 10
.MCE
 I 1 BEAM N 1 2 3 4 5 BPR 1
.CLM
 CHA NOEUD 1 C 1 V 8 NF 1
 CHA NOEUD 1 C 5 V -40 NF 1
 CHA NOEUD 1 C 6 V -80 NF 1
.FCT
 I 1 TABLE 0 0 2.5 1 5 0 6 0
.SAM TYPE DYNAMIC SOLVER KLU RHO """
PUSHED = 5.0  # until then the rod is thrown
MODELS = {"pendulum": PENDULUM, "spring": SPRING, "rod": f"{ROD}1\n", "damped_rod": f"{ROD}0.8\n"}


def deck(model: str, steps: int) -> str:
    """Histories of 1000 instants along the run."""
    end = steps * H
    head = f"{MODELS[model]}.SUB TF {end!r} H {H!r}\n.SAI FIELDS DT {end / 2!r} HISTORY DT "
    return head + f"{end / 1000 * 1.0000001!r}\n.FIN 1\n"


def measure(program: Path, model: str, steps: int, folder: Path) -> dict[str, float]:
    name = f"{model}_{steps}"
    (folder / f"{name}.dat").write_text(deck(model, steps), encoding="utf-8")
    task = [program, "-q", f"{name}.dat", "-o", name]
    with subprocess.Popen(task, cwd=folder, stderr=subprocess.PIPE, text=True) as process:
        message = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(message)
    with Results(folder / name) as r:
        kinetic = r.history("run/KINETIC_ENERGY")[1]
        energy = kinetic + r.history("run/POTENTIAL_ENERGY")[1]
        free = r.times() > PUSHED if "rod" in model else slice(None)
        change = energy[free] - energy[free][0]
        found = {"memory": usage.ru_maxrss / 1024, "energy": change[-1] / kinetic.max()}
        found["most"] = np.abs(change).max() / kinetic.max()
        last = slice(-500, None)
        if model == "pendulum":
            x, z = r.history("node/1/UX")[1] + 1, r.history("node/1/UZ")[1]
            found["size"] = -z[last].min()
            found["gap"] = np.abs(np.hypot(x, z) - 1).max()
        elif "rod" in model:
            found["size"], found["gap"] = 1.0, 0.0
        else:
            found["size"] = r.history("element/1/LENGTH")[1][last].max()
            found["gap"] = 0.0
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description="runs of very many steps")
    parser.add_argument("program", type=Path)
    parser.add_argument("--steps", type=int, nargs="+", default=[10**4, 10**5, 10**6, 10**7])
    parser.add_argument("--models", nargs="+", choices=MODELS, default=list(MODELS))
    arguments = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    columns = ("model", "steps", "energy", "at most", "amplitude", "gap in the hinge", "memory, MB")
    print(f"| {' | '.join(columns)} |\n{'|---' * len(columns)}|")
    for model in arguments.models:
        first = None
        for steps in arguments.steps:
            with tempfile.TemporaryDirectory() as folder:
                found = measure(arguments.program.resolve(), model, steps, Path(folder))
            first = first or found
            print(
                f"| {model} | {steps:.0e} | {found['energy']:.1e} | {found['most']:.1e} "
                f"| {found['size'] / first['size'] - 1:.1e} "
                f"| {found['gap']:.1e} | {found['memory']:.1f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
