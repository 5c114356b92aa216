# SPDX-License-Identifier: BSD-3-Clause
"""Work and precision of the time integration schemes: error against steps, iterations and processor time.

    python tests/bench/schemes.py build/bin/engrane [--models top andrews crank spur valve bevel]
        [--schemes "SCHEME CHUNG RHO 0.8" "SCHEME RADAU"] [--runs 2] [--solver KLU]
        [--tolerances 1e-2 1e-3 1e-4 1e-5]

Each model runs with each scheme and each of its steps, then with each tolerance of error-controlled steps.
Errors are the largest of ten instants, over the largest value there, of some positions (q), velocities (v)
and forces (f) that MODELS names; the reference is RADAU with half the third shortest step and a precision of
1e-13, unless --reference names another scheme. Processor time is that of the process, the least of --runs,
without that of a run of a single step. Prints a Markdown table for each model.
"""

import argparse
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

BEVEL = """
.NOE
 I 1 X 0 0 0
 I 2 X 0 1 5
 I 4 X 0 1 0
.MCE
 I 1 GEAR N 1 2 AXIS 0 1 0 Z 50 10 MN 0.2 ALPHA 20 R 5 1 $
     CONE (-atan(5)*180/PI) (-atan(0.2)*180/PI) HELIX 0 0
 I 3 HINGE N 4 2 AXIS 0 0 -1 AT 0 1 5
 I 4 HINGE N 0 4 AXIS 0 1 0
 I 5 INERTIA N 2 M 2 J 0.6 0.6 1
 I 6 INERTIA N 4 M 1 J 3 2 1
 I 7 TSPRING N 0 4 AXIS 0 1 0 K 900
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
 STRU ACC VAL 0 0 -9.81
.INI
 VIT NOEUD 4 C 5 V 2
.SAM TYPE DYNAMIC
.SUB TF 1 H 0.1
.FIN 1
"""
#: deck, end, steps that divide a tenth of it, positions, velocities, forces
MODELS = {
    "top": (
        "decks/elements/bodies/rigid_body_top.dat",
        0.2,
        (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4, 1e-4, 2.5e-5),
        ("node/2/UX", "node/2/UY", "node/2/UZ"),
        ("node/2/VX", "node/2/VY", "node/2/VZ"),
        ("node/1/FX", "node/1/FY", "node/1/FZ"),
    ),
    "andrews": (
        "decks/mechanisms/andrews_squeezer.dat",
        0.03,
        (3e-4, 1.5e-4, 7.5e-5, 3e-5, 1.5e-5, 7.5e-6, 3e-6),
        ("element/11/ANGLE", "element/13/ANGLE", "element/15/ANGLE"),
        ("element/11/SPEED", "element/13/SPEED", "element/15/SPEED"),
        ("element/11/FORCE_X", "element/11/FORCE_Y"),
    ),
    "crank": (
        "decks/mechanisms/slider_crank.dat",
        0.5,
        (2.5e-2, 1e-2, 5e-3, 2.5e-3, 1e-3, 2.5e-4),
        ("element/4/SLIDE",),
        ("element/4/SLIDE_SPEED",),
        ("element/1/DRIVE_TORQUE",),
    ),
    "spur": (
        "decks/paper/spur_transmission_a.dat",
        0.002,
        (4e-5, 2e-5, 1e-5, 5e-6, 2e-6, 5e-7),
        ("node/2/RZ", "node/3/RZ"),
        ("node/2/WZ", "node/3/WZ"),
        ("element/7/NORMAL_FORCE",),
    ),
    "valve": (
        "decks/mechanisms/valve_train.dat",
        0.012,
        (1e-4, 4e-5, 2e-5, 1e-5, 4e-6, 1e-6),
        ("element/2/ANGLE", "element/3/SLIDE"),
        ("element/2/SPEED", "element/3/SLIDE_SPEED"),
        ("element/4/NORMAL_FORCE", "element/5/NORMAL_FORCE"),
    ),
    "bevel": (
        BEVEL,
        1.0,
        (5e-2, 2.5e-2, 1e-2, 5e-3, 2e-3, 5e-4),
        ("element/4/ANGLE", "element/3/ANGLE"),
        ("element/4/SPEED", "element/3/SPEED"),
        ("element/1/NORMAL_FORCE",),
    ),
}
SCHEMES = ("SCHEME CHUNG RHO 0.8", "SCHEME NEWMARK", "SCHEME RADAU")


def deck(
    model: str, scheme: str, step: float, end: float, solver: str, tolerance: float | None = None
) -> str:
    source = MODELS[model][0]
    text = source if source.startswith("\n") else (ROOT / source).read_text(encoding="utf-8")
    text = re.sub(r"^\.CHK\n(?: .*\n|!.*\n)*", "", text, flags=re.M)
    text = re.sub(r"^\.SAI.*\n", "", text, flags=re.M)
    keep = " START STATIC" if re.search(r"^\.SAM.*START STATIC", text, re.M) else ""
    text = re.sub(
        r"^\.SAM .*", f".SAM TYPE DYNAMIC {scheme} SOLVER {solver}{keep} ENERGY 0", text, flags=re.M
    )
    sample = MODELS[model][1] / 10
    control = f" TOL {tolerance!r}" if tolerance else ""
    return re.sub(
        r"^\.SUB .*",
        f".SUB TF {end!r} H {step!r}{control}\n.SAI FIELDS DT {end!r} HISTORY DT {sample!r}",
        text,
        flags=re.M,
    )


class Run:
    """Values at the sampled instants by kind, steps, iterations and processor time; None where it failed."""

    def __init__(
        self,
        binary: Path,
        folder: Path,
        model: str,
        scheme: str,
        step: float,
        options,
        tolerance: float | None = None,
    ) -> None:
        path = folder / "run.dat"
        self.seconds = float("inf")
        for end in [MODELS[model][1]] * options.runs + [step]:
            path.write_text(
                deck(model, scheme, step, end, options.solver, tolerance if end > step else None),
                encoding="utf-8",
            )
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            done = subprocess.run(
                [binary, "-q", path, "-o", path.with_suffix("")],
                env=ENVIRONMENT,
                capture_output=True,
                text=True,
            )
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            self.failure = done.stderr[-300:] if done.returncode != 0 else ""
            if self.failure:
                return
            seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            if end == step:
                self.seconds -= seconds
                return
            self.seconds = min(self.seconds, seconds)
            listing = path.with_suffix(".lst").read_text(encoding="utf-8")
            found = re.search(r"(\d+) steps?, (\d+) Newton", listing)
            self.steps, self.iterations = int(found.group(1)), int(found.group(2))
            with Results(path.with_suffix(".h5")) as results:
                self.values = [
                    [results.history(name)[1][1:] for name in names] for names in MODELS[model][3:]
                ]

    def errors(self, reference: "Run") -> list[float]:
        """Of positions, velocities and forces."""
        return [
            max(np.abs(a - b).max() / np.abs(b).max() for a, b in zip(mine, theirs, strict=True))
            for mine, theirs in zip(self.values, reference.values, strict=True)
        ]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("binary", type=Path)
    parser.add_argument("--models", nargs="+", choices=MODELS, default=list(MODELS))
    parser.add_argument("--schemes", nargs="+", default=SCHEMES)
    parser.add_argument("--reference", default="SCHEME RADAU PREC 1e-13")
    parser.add_argument("--runs", type=int, default=2)
    parser.add_argument("--solver", default="KLU")
    parser.add_argument("--steps", type=int, default=100, help="how many of the steps of a model to take")
    parser.add_argument("--tolerances", nargs="*", type=float, default=[], help="TOL of `.SUB`")
    options = parser.parse_args()
    binary = options.binary.resolve()
    with tempfile.TemporaryDirectory() as folder:
        for model in options.models:
            steps = MODELS[model][2]
            reference = Run(binary, Path(folder), model, options.reference, steps[-3] / 2, options)
            if reference.failure:
                sys.exit(f"{model}: {reference.failure}")
            print(f"\n{model}\n")
            print("| scheme | H | steps | iterations | error q | v | f | seconds |\n" + "|---" * 8 + "|")
            for scheme in options.schemes:
                tries = [(step, None) for step in steps[: options.steps]]
                for step, tolerance in tries + [(steps[0], one) for one in options.tolerances]:
                    run = Run(binary, Path(folder), model, scheme, step, options, tolerance)
                    said = f"TOL {tolerance:g}" if tolerance else f"{step:g}"
                    if run.failure:
                        why = " ".join(run.failure.split())[:100]
                        print(f"| {scheme} | {said} | failed: {why} |")
                        continue
                    errors = " | ".join(f"{e:.1e}" for e in run.errors(reference))
                    effort = f"{run.steps} | {run.iterations}"
                    print(f"| {scheme} | {said} | {effort} | {errors} | {run.seconds:.3f} |", flush=True)


if __name__ == "__main__":
    main()
