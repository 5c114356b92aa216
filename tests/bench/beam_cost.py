# SPDX-License-Identifier: BSD-3-Clause
"""The elbow cantilever, two legs of beams that swing through 20 (Simo and Vu-Quoc 1988), in this program and
in Exudyn: time for an error of the tip.

    python -m venv /tmp/exudyn && /tmp/exudyn/bin/pip install exudyn numpy h5py
    /tmp/exudyn/bin/python tests/bench/beam_cost.py build/bin/engrane

The error is the rms of the tip's displacement over 30 s, over its rms, against 12 pieces of three nodes of a
leg and RADAU with TOL 1E-5. Runs of both programs take turns; times are the least of the rounds, of the
solution alone in Exudyn, of the whole run with its results in this one."""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2] / "post"))

from engrane_post import Results

SPAN, INSTANTS = 30.0, 300
ONE_THREAD = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


def deck(pieces: int, nodes: int, analysis: str, run: str) -> str:
    """`pieces` of a leg, of so many nodes."""
    count = pieces * (nodes - 1)
    places = [(10 * i / count, 0) for i in range(count + 1)]
    places += [(10, 10 * i / count) for i in range(1, count + 1)]
    ids = range(1, len(places) + 1)
    rows = "\n".join(f" I {i} X {x:.16g} {y:.16g} 0" for i, (x, y) in zip(ids, places, strict=True))
    legs = [" ".join(map(str, ids[first : first + count + 1])) for first in (0, count)]
    linear = " LINEAR" if nodes == 2 else ""
    return f""".NOE
{rows}
.BPR
 I 1 EA 1D6 GA 1D6 1D6 GJ 1D3 EI 1D3 1D3 M 1 J 20 10 10
.MCE
 I 1 BEAM N {legs[0]} BPR 1{linear}
 I 1001 BEAM N {legs[1]} BPR 1{linear}
.CLM
 FIX NOEUD 1 C 1 2 3 4 5 6
 CHA NOEUD {count + 1} C 3 V 50 NF 1
.FCT
 I 1 TABLE 0 0 1 1 2 0 100 0
.SAM TYPE DYNAMIC {analysis}
.SUB TF {SPAN} {run}
.SAI NOEUD {ids[-1]} HISTORY {SPAN / INSTANTS} FIELDS {SPAN}
.FIN 1
"""


def engrane(program: str, folder: Path, text: str) -> tuple[float, np.ndarray]:
    (folder / "elbow.dat").write_text(text)
    command = [program, "elbow.dat", "-o", "elbow", "--json"]
    done = subprocess.run(command, cwd=folder, env=ONE_THREAD, capture_output=True, text=True, check=True)
    seconds = json.loads(done.stdout)["runs"][0]["seconds"]
    last = text.split(".BPR")[0].split("\n I ")[-1].split()[0]
    with Results(folder / "elbow.h5") as results:
        times = results.times()
        tip = np.array([results.history(f"node/{last}/{c}")[1] for c in ("UX", "UY", "UZ")]).T
    wanted = np.linspace(0, SPAN, INSTANTS + 1)
    return seconds, tip[[int(np.argmin(abs(times - t))) for t in wanted]]


def exudyn(elements: int, step: float, kept: bool) -> tuple[float, np.ndarray]:
    ask = {"elements": elements, "step": step, "span": SPAN, "instants": INSTANTS, "kept": kept}
    script = Path(__file__).with_name("exudyn_elbow.py")
    command = [sys.executable, str(script), json.dumps(ask)]
    done = subprocess.run(command, env=ONE_THREAD, capture_output=True, text=True, check=True)
    found = json.loads(done.stdout.split("RESULT")[1])
    return found["seconds"], np.array(found["tip"])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    program = str(Path(options.program).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def ours(pieces: int, nodes: int, analysis: str, run: str):
            return lambda: engrane(program, folder, deck(pieces, nodes, analysis, run))

        runs = {
            f"Exudyn, {e} elements of a leg, h {h}{', kept' if kept else ''}": lambda e=e, h=h, k=kept: (
                exudyn(e, h, k)
            )
            for kept in (False, True)
            for e, h in ((4, 0.1), (8, 0.1), (16, 0.05), (32, 0.05), (32, 0.025))
        }
        for pieces, h in (
            (2, 0.1),
            (2, 0.05),
            (4, 0.1),
            (4, 0.05),
            (4, 0.025),
            (8, 0.05),
            (8, 0.025),
            (8, 0.0125),
        ):
            for words in ("SOLVER KLU", "SOLVER KLU TANGENT KEPT"):
                runs[f"{pieces} pieces of 3 nodes, h {h}, {words}"] = ours(
                    pieces, 3, f"SCHEME CHUNG {words}", f"H {h}"
                )
        for pieces, tolerance in ((2, 1e-2), (4, 1e-3), (4, 1e-4), (8, 1e-4), (8, 1e-5)):
            words = f"H 0.1 TOL {tolerance}"
            runs[f"{pieces} pieces of 3 nodes, RADAU, {words}"] = ours(
                pieces, 3, "SCHEME RADAU SOLVER KLU", words
            )
        _, truth = engrane(program, folder, deck(12, 3, "SCHEME RADAU SOLVER KLU", "H 0.1 TOL 1E-5"))
        size = np.sqrt((truth**2).sum(axis=1).mean())
        best: dict[str, tuple[float, float]] = {}
        for _ in range(options.rounds):
            for title, go in runs.items():
                try:
                    seconds, tip = go()
                except subprocess.CalledProcessError as failed:
                    print(f"{title}: fails, {(failed.stderr or failed.stdout)[-200:]}")
                    continue
                error = np.sqrt(((tip - truth) ** 2).sum(axis=1).mean()) / size
                best[title] = (min(seconds, best.get(title, (np.inf, 0))[0]), error)
        for title, (seconds, error) in best.items():
            print(f"{error:9.2e} {seconds:8.3f} s  {title}")


if __name__ == "__main__":
    main()
