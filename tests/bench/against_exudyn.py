# SPDX-License-Identifier: BSD-3-Clause
"""Work and precision against Exudyn (PyPI): the heavy top and a chain of rigid links, with the errors of
tests/bench/accuracy.py.

    python -m venv /tmp/exudyn && /tmp/exudyn/bin/pip install exudyn numpy h5py
    /tmp/exudyn/bin/python tests/bench/against_exudyn.py build/bin/engrane [--models top chain]
        [--links 20] [--runs 3]

Both programs have the same bodies, joints, start and span; error: root of the mean square over the
instants over the range, the worst of position and velocity of the last body. Truth: RADAU with TOL 1e-9;
what the finest run of Exudyn is off from it shows that both solve the same model. Exudyn (one thread, rho
0.8, sparse solver): generalised-alpha with full and with modified Newton (its default), trapezoidal rule
with index 2, with bodies in Euler parameters (its default) and in rotation vectors as a Lie group. Its
explicit schemes take no closed joints in Euler parameters, and it has no implicit scheme of a higher
order. Processor time of Exudyn: of its solution alone; of this program: of the process without that of a
run of one step. Least of --runs, in turn.
"""

import argparse
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "post")]
from engrane_post import Results  # noqa: E402

ENVIRONMENT = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
SPANS = {"top": 0.2, "chain": 1.0}
STEPS = {"top": (125, 250, 500, 1000, 2000, 4000, 8000), "chain": (250, 500, 1000, 2000, 4000, 8000)}
INTERVALS = {"top": 125, "chain": 250}


def chain(links: int) -> str:
    axes = ["0 1 0" if i % 2 == 0 else "0 0.6 0.8" for i in range(links)]
    return "\n".join(
        [
            ".NOE",
            *(f" I {i + 1} X {i + 0.5}" for i in range(links)),
            ".MCE",
            *(f" I {i + 1} INERTIA N {i + 1} M 1 J 0.001 0.084 0.084" for i in range(links)),
            *(f" I {links + i + 1} HINGE N {i} {i + 1} AXIS {axes[i]} AT {i} 0 0" for i in range(links)),
            ".CLM\n STRU ACC VAL 0 0 -9.81",
            ".SAM TYPE DYNAMIC RHO 0.8",
            ".SUB TF 1 H 0.001",
            ".FIN 1\n",
        ]
    )


class Own:
    def __init__(self, binary: Path, folder: Path, model: str, links: int) -> None:
        self.binary, self.folder, self.model = binary, folder, model
        self.text = (
            (ROOT / "decks/elements/bodies/rigid_body_top.dat").read_text(encoding="utf-8")
            if model == "top"
            else chain(links)
        )
        self.node = 2 if model == "top" else links

    def run(self, analysis: str, stepping: str, end: float | None = None) -> tuple[float, np.ndarray]:
        """Seconds, and positions and velocities (instants x 6)."""
        span = SPANS[self.model]
        text = re.sub(r"^\.CHK\n(?: .*\n)*", "", self.text, flags=re.M)
        text = re.sub(r"^\.SAM .*", f".SAM TYPE DYNAMIC {analysis} ENERGY 0", text, flags=re.M)
        names = ["UX", "UY", "UZ", "VX", "VY", "VZ"]
        asked = "\n".join(f" NODE {self.node} {name} V 0 ATOL 1e30" for name in names)
        interval = span / INTERVALS[self.model]
        archive = f".SAI FIELDS DT {span!r} HISTORY DT {interval!r}\n.CHK\n{asked}"
        text = re.sub(r"^\.SUB .*", f".SUB TF {end or span!r} {stepping}\n{archive}", text, flags=re.M)
        path = self.folder / "own.dat"
        path.write_text(text, encoding="utf-8")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(
            [self.binary, "-q", path, "-o", path.with_suffix("")],
            env=ENVIRONMENT,
            capture_output=True,
            text=True,
        )
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            raise RuntimeError(" ".join(done.stderr.split())[:150])
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        with Results(path.with_suffix(".h5")) as results:
            histories = [results.history(f"node/{self.node}/{name}") for name in names]
        places = histories[0][0] / interval
        even = np.abs(places - np.round(places)) < 1e-3
        return seconds, np.array([values[even] for _, values in histories]).T


PEER = """
import json, sys, time, warnings
warnings.simplefilter("ignore")
import numpy as np, exudyn as exu
from exudyn.utilities import *
model, links, steps, span, intervals, scheme, kept, lie = json.loads(sys.argv[1])
system = exu.SystemContainer()
mbs = system.AddSystem()
ground = mbs.AddObject(ObjectGround())
node = dict(nodeType=exu.NodeType.RotationRotationVector) if lie else {}
if model == "top":
    spin = [0, 150, -4.61538]
    body = mbs.CreateRigidBody(
        inertia=RigidBodyInertia(mass=15, inertiaTensor=np.diag([0.234375, 0.46875, 0.234375])),
        referencePosition=[0, 1, 0], gravity=[0, 0, -9.81], initialAngularVelocity=spin,
        initialVelocity=list(np.cross(spin, [0, 1, 0])), **node)
    mbs.CreateSphericalJoint(bodyNumbers=[ground, body], position=[0, 0, 0], show=False)
else:
    before = ground
    for i in range(links):
        body = mbs.CreateRigidBody(
            inertia=RigidBodyInertia(mass=1, inertiaTensor=np.diag([0.001, 0.084, 0.084])),
            referencePosition=[i + 0.5, 0, 0], gravity=[0, 0, -9.81], **node)
        mbs.CreateRevoluteJoint(bodyNumbers=[before, body], position=[i, 0, 0],
            axis=[0, 1, 0] if i % 2 == 0 else [0, 0.6, 0.8], useGlobalFrame=True, show=False)
        before = body
kinds = (exu.OutputVariableType.Displacement, exu.OutputVariableType.Velocity)
sensors = [
    mbs.AddSensor(SensorBody(bodyNumber=body, writeToFile=False, storeInternal=True, outputVariableType=kind))
    for kind in kinds]
mbs.Assemble()
s = exu.SimulationSettings()
s.timeIntegration.numberOfSteps, s.timeIntegration.endTime = steps, span
s.timeIntegration.generalizedAlpha.spectralRadius = 0.8
s.timeIntegration.newton.useModifiedNewton = kept
s.solutionSettings.writeSolutionToFile = False
s.solutionSettings.sensorsWritePeriod = span / intervals
s.parallel.numberOfThreads = 1
s.linearSolverType = exu.LinearSolverType.EigenSparse
begun = time.process_time()
mbs.SolveDynamic(s, solverType=getattr(exu.DynamicSolverType, scheme))
seconds = time.process_time() - begun
rows = np.hstack([mbs.GetSensorStoredData(sensor)[:, 1:] for sensor in sensors])
print("RESULT", json.dumps([seconds, rows.tolist()]))
"""


def run_exudyn(
    folder: Path, model: str, links: int, steps: int, scheme: str, kept: bool, lie: bool
) -> tuple[float, np.ndarray]:
    script = folder / "peer.py"
    script.write_text(PEER, encoding="utf-8")
    words = json.dumps([model, links, steps, SPANS[model], INTERVALS[model], scheme, kept, lie])
    done = subprocess.run([sys.executable, script, words], env=ENVIRONMENT, capture_output=True, text=True)
    found = re.search(r"^RESULT (.*)$", done.stdout, re.MULTILINE)
    if not found:
        raise RuntimeError(" ".join((done.stdout + done.stderr).split())[-150:])
    seconds, rows = json.loads(found[1])
    return seconds, np.array(rows)


def error(values: np.ndarray, truth: np.ndarray) -> float:
    ranges = np.ptp(truth, axis=0)
    for kind in (slice(0, 3), slice(3, 6)):  # what hardly moves tells of rounding
        ranges[kind] = np.where(ranges[kind] > 1e-6 * ranges[kind].max(), ranges[kind], np.inf)
    return float((np.sqrt(np.mean((values - truth) ** 2, axis=0)) / ranges).max())


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("binary", type=Path)
    parser.add_argument("--models", nargs="+", choices=SPANS, default=list(SPANS))
    parser.add_argument("--links", type=int, default=20)
    parser.add_argument("--runs", type=int, default=3)
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for model in a.models:
            own = Own(a.binary.resolve(), folder, model, a.links)
            span = SPANS[model]
            truth = own.run("SCHEME RADAU SOLVER KLU", f"H {span / 1000!r} TOL 1e-9")[1]
            jobs = {}
            for n in STEPS[model]:
                jobs[f"CHUNG RHO 0.8 KLU KEPT, {n} steps"] = (
                    "own",
                    "RHO 0.8 SOLVER KLU TANGENT KEPT",
                    f"H {span / n!r}",
                )
            for tolerance in ("1e-3", "1e-4", "1e-5", "1e-6", "1e-7"):
                jobs[f"RADAU KLU TOL {tolerance}"] = (
                    "own",
                    "SCHEME RADAU SOLVER KLU",
                    f"H {span / 1000!r} TOL {tolerance}",
                )
            for rung in ("FAST", "NORMAL", "FINE", "REFERENCE"):
                jobs[f"ACCURACY {rung}, with its estimate"] = (
                    "own",
                    f"ACCURACY {rung}",
                    f"H {span / 1000!r}",
                )
            variants = (
                ("GeneralizedAlpha", True, False, "generalised-alpha"),
                ("GeneralizedAlpha", False, False, "generalised-alpha, full Newton"),
                ("GeneralizedAlpha", True, True, "generalised-alpha, rotation vectors"),
                ("TrapezoidalIndex2", True, False, "trapezoidal, index 2"),
            )
            for scheme, kept, lie, title in variants:
                for n in STEPS[model]:
                    jobs[f"Exudyn {title}, {n} steps"] = ("peer", n, scheme, kept, lie)
            best: dict[str, float] = {}
            errors: dict[str, str] = {}
            start = min(own.run("SOLVER KLU", f"H {span / 1000!r}", span / 1000)[0] for _ in range(5))
            for _ in range(a.runs):
                for title, job in jobs.items():
                    if errors.get(title, "").startswith("failed"):
                        continue
                    try:
                        if job[0] == "own":
                            seconds, values = own.run(*job[1:])
                            seconds -= start
                        else:
                            seconds, values = run_exudyn(folder, model, a.links, *job[1:])
                    except RuntimeError as failure:
                        errors[title] = f"failed: {failure}"
                        continue
                    best[title] = min(best.get(title, np.inf), seconds)
                    errors[title] = f"{error(values, truth):.1e}"
            print(f"\n{model}\n\n| program and setting | s | error |\n|---|---|---|")
            for title in jobs:
                print(f"| {title} | {best.get(title, float('nan')):.3f} | {errors[title]} |", flush=True)


if __name__ == "__main__":
    main()
