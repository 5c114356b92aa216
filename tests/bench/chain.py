# SPDX-License-Identifier: BSD-3-Clause
"""Spatial chains of rigid links against Exudyn (PyPI), same scheme, same step, in turn.

    python -m pip install exudyn
    python tests/bench/chain.py build/bin/engrane [--links 3 20 100] [--runs 5] [--steps 1000]

Bars of 1 m and 1 kg fall from rest, joined by hinges about y and (0, 0.6, 0.8) in turn; generalised-alpha
with rho = 0.8, one thread. Every run is a process of its own; engrane's start-up and closing are taken out by
the difference to a run of half as many steps. Prints a Markdown table: median microseconds per step, Newton
iterations per step, error of the chain's tip against the extrapolation of engrane's own runs with fine steps,
and the ratio of the times, run by run.
"""

import argparse
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

SOLVERS = ("MUMPS", "KLU")
INERTIA = (0.001, 0.084, 0.084)
GRAVITY = 9.81
ENVIRONMENT = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


def axis(link: int) -> tuple[float, float, float]:
    return (0, 1, 0) if link % 2 == 0 else (0, 0.6, 0.8)


def deck(links: int, steps: int, step: float, solver: str) -> str:
    end = steps * step
    lines = [".NOE", *(f" I {i + 1} X {i + 0.5}" for i in range(links)), ".MCE"]
    tensor = " ".join(map(str, INERTIA))
    lines += [f" I {i + 1} INERTIA N {i + 1} M 1 J {tensor}" for i in range(links)]
    for i in range(links):
        x, y, z = axis(i)
        lines.append(f" I {links + i + 1} HINGE N {i} {i + 1} AXIS {x} {y} {z} AT {i} 0 0")
    return "\n".join(
        [
            *lines,
            f".CLM\n STRU ACC VAL 0 0 {-GRAVITY}",
            f".SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.8 SOLVER {solver}",
            f".SUB TF {end!r} H {step!r}",
            f".SAI FIELDS DT {end!r} HISTORY DT {end!r}",
            ".FIN 1\n",
        ]
    )


def run_engrane(binary: Path, folder: Path, links: int, steps: int, step: float, solver: str) -> dict:
    """Seconds of the whole run, Newton iterations per step, place of the tip."""
    path = folder / f"chain_{solver}.dat"
    path.write_text(deck(links, steps, step, solver), encoding="utf-8")
    done = subprocess.run(
        [binary, "-q", path, "-o", path.with_suffix("")], env=ENVIRONMENT, capture_output=True, text=True
    )
    if done.returncode != 0:
        sys.exit(f"engrane failed: {done.stderr}")
    listing = path.with_suffix(".lst").read_text(encoding="utf-8")
    with h5py.File(path.with_suffix(".h5")) as file:
        displacement, rotation = (
            file[f"fields/{field}"][max(file[f"fields/{field}"])][-1]
            for field in ("displacement", "rotation")
        )
    return {
        "seconds": float(re.search(r"^  total\s+(\S+)", listing, re.MULTILINE)[1]),
        "iterations": float(re.search(r"\((\S+) per step\)", listing)[1]),
        "tip": np.array([links - 0.5, 0, 0]) + displacement + rotated(rotation, np.array([0.5, 0, 0])),
    }


def rotated(rotation: np.ndarray, arm: np.ndarray) -> np.ndarray:
    angle = np.linalg.norm(rotation)
    if angle == 0:
        return arm
    n = rotation / angle
    return arm * np.cos(angle) + np.cross(n, arm) * np.sin(angle) + n * (n @ arm) * (1 - np.cos(angle))


PEER = """
import json, sys, time
import numpy as np, exudyn as exu
from exudyn.utilities import *
links, steps, step = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3])
system = exu.SystemContainer()
mbs = system.AddSystem()
before = mbs.AddObject(ObjectGround())
for i in range(links):
    body = mbs.CreateRigidBody(
        inertia=RigidBodyInertia(mass=1, inertiaTensor=np.diag(%(inertia)s)),
        referencePosition=[i + 0.5, 0, 0], gravity=[0, 0, -%(gravity)s])
    mbs.CreateRevoluteJoint(bodyNumbers=[before, body], position=[i, 0, 0],
        axis=[0, 1, 0] if i %% 2 == 0 else [0, 0.6, 0.8], useGlobalFrame=True, show=False)
    before = body
tip = mbs.AddSensor(SensorBody(bodyNumber=before, localPosition=[0.5, 0, 0], writeToFile=False,
    outputVariableType=exu.OutputVariableType.Position))
mbs.Assemble()
s = exu.SimulationSettings()
s.timeIntegration.numberOfSteps, s.timeIntegration.endTime = steps, steps * step
s.timeIntegration.generalizedAlpha.spectralRadius = 0.8
s.timeIntegration.newton.useModifiedNewton = %(kept)s
s.timeIntegration.verboseMode = 0
s.solutionSettings.writeSolutionToFile = False
s.solutionSettings.sensorsWritePeriod = 1e9
s.parallel.numberOfThreads = 1
s.linearSolverType = exu.LinearSolverType.EigenSparse
begun = time.perf_counter()
mbs.SolveDynamic(s)
seconds = time.perf_counter() - begun
newton = mbs.sys["dynamicSolver"].it.newtonStepsCount
print("RESULT", json.dumps([seconds, list(mbs.GetSensorValues(tip)), newton]))
"""


def run_exudyn(folder: Path, links: int, steps: int, step: float, kept: bool) -> dict:
    """Kept: Exudyn's modified Newton, whose Jacobian serves many steps."""
    script = folder / "peer.py"
    script.write_text(PEER % {"inertia": list(INERTIA), "gravity": GRAVITY, "kept": kept}, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, script, str(links), str(steps), repr(step)],
        env=ENVIRONMENT,
        capture_output=True,
        text=True,
    )
    found = re.search(r"^RESULT \[([^,]+), \[(.*)\], (\d+)\]", done.stdout, re.MULTILINE)
    if not found:
        sys.exit(f"Exudyn failed: {done.stdout}{done.stderr}")
    return {
        "seconds": float(found[1]),
        "iterations": float(found[3]) / steps,
        "tip": np.array([float(v) for v in found[2].split(",")]),
    }


def reference(binary: Path, folder: Path, links: int, end: float, step: float) -> np.ndarray:
    """Extrapolated from steps of a quarter and an eighth, by the scheme's order 2."""
    coarse, fine = (
        run_engrane(binary, folder, links, round(end / h), h, "KLU")["tip"] for h in (step / 4, step / 8)
    )
    return fine + (fine - coarse) / 3


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("binary", type=Path)
    parser.add_argument("--links", type=int, nargs="+", default=[3, 20, 100])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--step", type=float, default=1e-3)
    a = parser.parse_args()
    binary = a.binary.resolve()
    print(f"Medians of {a.runs} runs of {a.steps} steps of {a.step:g} s.\n")
    print("| links | program | us per step | iterations per step | error of the tip, m | Exudyn over this |")
    print("|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for links in a.links:
            exact = reference(binary, folder, links, a.steps * a.step, a.step)
            rows: dict[str, list[tuple[float, dict]]] = {}
            for _ in range(a.runs):
                for kept in (False, True):
                    found = run_exudyn(folder, links, a.steps, a.step, kept)
                    title = "Exudyn, Jacobian kept" if kept else "Exudyn"
                    rows.setdefault(title, []).append((found["seconds"] / a.steps, found))
                for solver in SOLVERS:
                    short = run_engrane(binary, folder, links, a.steps // 2, a.step, solver)
                    whole = run_engrane(binary, folder, links, a.steps, a.step, solver)
                    each = (whole["seconds"] - short["seconds"]) / (a.steps - a.steps // 2)
                    rows.setdefault(f"engrane, {solver}", []).append((each, whole))
            for title, runs in rows.items():
                ratio = statistics.median(
                    peer[0] / mine[0] for peer, mine in zip(rows["Exudyn"], runs, strict=True)
                )
                error = np.linalg.norm(runs[0][1]["tip"] - exact)
                print(
                    f"| {links} | {title} | {1e6 * statistics.median(r[0] for r in runs):.0f} "
                    f"| {runs[0][1]['iterations']:.2f} | {error:.1e} | {ratio:.2f} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
