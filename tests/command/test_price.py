# SPDX-License-Identifier: BSD-3-Clause
"""`engrane check` tells the price of a run before it: what is counted must be right, what is estimated
near."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

import pytest
from engrane_post import Results

DECKS = Path(__file__).resolve().parents[2] / "decks"
PROGRAM = os.environ.get("ENGRANE", "")


def call(*words: str, folder: Path) -> str:
    if not Path(PROGRAM).is_file():
        pytest.skip("the variable ENGRANE names no program")
    done = subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def price(deck: Path, folder: Path) -> str:
    said = call("check", str(deck), folder=folder)
    return said[said.index("Expected cost") :]


@pytest.mark.parametrize(
    "name",
    [
        "mechanisms/plane_slider_crank",
        "mechanisms/four_bar",
        "gears/spur",
        "gears/clearance_oscillator_linear",
        "trains/planetary_5_ring_held",
        "elements/joints/hinge",
        "elements/structural/cell_ring",
    ],
)
def test_counts_and_file(name: str, tmp_path: Path) -> None:
    """Channels and samples are those of the results, and the file is what was foreseen to 15 per cent."""
    deck = DECKS / f"{name}.dat"
    said = price(deck, tmp_path)
    call(str(deck), "-q", "-o", "done", folder=tmp_path)
    channels, samples, _, size, unit = re.search(
        r"results: (\d+) channels, (\d+) samples, (\d+) frames: a file of about (\S+) (kB|MB)", said
    ).groups()
    with Results(tmp_path / "done.h5") as results:
        assert int(channels) == len(results.channels)
        assert abs(int(samples) - len(results.times())) <= 1
    foreseen = float(size) * {"kB": 1e3, "MB": 1e6}[unit]
    assert foreseen == pytest.approx((tmp_path / "done.h5").stat().st_size, rel=0.15)


def test_equations_and_shares(tmp_path: Path) -> None:
    """The slider-crank in its plane: three bodies with three unknowns each, two multipliers of each joint and
    the drive; the shares are of one whole."""
    said = price(DECKS / "mechanisms/plane_slider_crank.dat", tmp_path)
    equations = int(re.search(r"matrix: (\d+) equations", said)[1])
    assert equations == 3 * 3 + 3 * 2 + 2 + 1  # bodies; hinges, slide, drive
    shares = [int(share) for share in re.findall(r" (\d+)$", said[: said.index("matrix")], re.MULTILINE)]
    assert sum(shares) == pytest.approx(100, abs=len(shares))


def test_steps_are_those_of_the_deck(tmp_path: Path) -> None:
    """What is counted of the time; no clock is compared with another."""
    text = (DECKS / "gears/spur.dat").read_text(encoding="utf-8")
    for h, steps in (("0.1", 20), ("0.01", 200)):
        (tmp_path / "deck.dat").write_text(
            text.replace(".SUB TF 2 H 0.1", f".SUB TF 2 H {h}"), encoding="utf-8"
        )
        assert f"for {steps} steps" in price(tmp_path / "deck.dat", tmp_path)


def test_linear_statics_is_one_equilibrium(tmp_path: Path) -> None:
    said = price(DECKS / "elements/structural/cell_ring.dat", tmp_path)
    assert "for the one equilibrium" in said and "steps" not in said
    assert re.search(r"results: \d+ channels, 1 samples, 1 frames", said)
