# SPDX-License-Identifier: BSD-3-Clause
"""`engrane plot` while the run goes on."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def plot(folder, *words):
    return subprocess.run(
        [sys.executable, "-m", "engrane_post", "plot", *words],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(ROOT / "post")},
        capture_output=True,
        text=True,
        timeout=120,
    )


def test_a_run_is_plotted_while_it_goes_on(engrane, pendulum):
    text = (engrane.folder / pendulum).read_text().replace("TF 0.2 H 0.01", "TF 1000 H 0.0002")
    (engrane.folder / "long.dat").write_text(text)
    program = os.environ["ENGRANE"]
    run = subprocess.Popen([program, "-q", "long.dat"], cwd=engrane.folder, stderr=subprocess.DEVNULL)
    try:
        deadline = time.monotonic() + 60
        # the first samples are written after about a second
        while plot(engrane.folder, "long", "node/1/UZ").returncode != 0 and time.monotonic() < deadline:
            time.sleep(0.05)
        first = None
        while True:  # what is plotted grows, about once a second
            done = plot(engrane.folder, "long", "node/1/UZ", "-o", "plot.png")
            assert done.returncode == 0, done.stdout + done.stderr
            assert (engrane.folder / "plot.png").read_bytes()[:4] == b"\x89PNG"
            listed = plot(engrane.folder, "long", "--list")
            assert ", running)" in listed.stdout, listed.stdout + listed.stderr
            end = float(listed.stdout.split(" to ")[1].split()[0])
            assert run.poll() is None, "the run was to be longer than its plots"
            if first is not None and end > first:
                break
            first = end if first is None else first
            assert time.monotonic() < deadline, f"no sample after {end}"
    finally:
        run.send_signal(signal.SIGTERM)
        run.wait(timeout=60)
