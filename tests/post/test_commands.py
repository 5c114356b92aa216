# SPDX-License-Identifier: BSD-3-Clause
"""plot and spectrum, from the command line."""

from __future__ import annotations

from pathlib import Path

import h5py
import models
import numpy as np
import pytest
from engrane_post import Results
from engrane_post.spectra import WINDOWS, spectrum
from engrane_post.tooth import tooth_frequencies


def is_picture(path: Path) -> bool:
    return path.read_bytes()[:4] == b"\x89PNG" and path.stat().st_size > 5000


def test_list(two: Path, command) -> None:
    status, out, _ = command("plot", two, "--list")
    assert status == 0
    assert "element/7/NORMAL_FORCE" in out and "rad/s" in out and "4001 samples" in out


def test_plot(two: Path, command, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    status, out, _ = command("plot", "two", "7.normal_force", "7.u_m", "--from", "0.001", "--to", "0.01")
    assert (status, out) == (0, "wrote two_element_7_NORMAL_FORCE_element_7_U_M.png\n")
    assert is_picture(tmp_path / "two_element_7_NORMAL_FORCE_element_7_U_M.png")
    other = models.two_wheels(tmp_path / "other.h5")
    for words in (
        ("7.u_m", "7.normal_force", "--together"),
        (other, "7.u_m"),
        (other, "*/7/*", "--together"),
    ):
        assert command("plot", two, *words, "-o", "a.png")[0] == 0
        assert is_picture(tmp_path / "a.png")


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("nothing.h5", "x"), "There is no result file"),
        (("two",), "Name a channel"),
        (("two", "7.normal"), "Did you mean"),
        (("two", "missing.h5", "7.u_m"), "There is no result file missing.h5"),
        (("two", "7.u_m", "-o", "a.xyz"), "Cannot write a.xyz"),
        (("two", "7.u_m", "-o", "no/such/a.png"), "there is no folder"),
        (
            ("two", "7.u_m", "--from", "5"),
            "no samples of element/7/U_M between 5 and inf; the run covers 0 to 0.04",
        ),
        (("two", "*", "--together"), "4 units"),
    ],
)
def test_plot_errors(two: Path, command, tmp_path: Path, monkeypatch, words, sentence) -> None:
    monkeypatch.chdir(tmp_path)
    status, _, err = command("plot", *words)
    assert status == 1
    assert sentence.lower() in err.lower()
    assert err.startswith("engrane plot: ") and "Traceback" not in err


def test_nan(tmp_path: Path, command, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    path = models.two_wheels(tmp_path / "n.h5")
    with h5py.File(path, "a") as f:
        f["history/element/GEAR/values"][3000:, 1] = np.nan
        for name, table in f["history/node"].items():
            if table["ids"][0] == 2:
                f[f"history/node/{name}/values"][:] = np.nan
    status, out, _ = command("plot", path, "7.u_m", "-o", "a.png")
    assert status == 0 and "not a number from t = 0.03 on" in out
    status, _, err = command("spectrum", path, "7.u_m")
    assert status == 1 and "end before that with --to 0.03" in err
    assert command("spectrum", path, "7.u_m", "--to", "0.0299", "-o", "a.png")[0] == 0
    assert command("plot", path, "2.ux")[0] == 1


def test_spectrum_command(two: Path, command, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    status, out, _ = command("spectrum", two, "7.normal_force")
    assert status == 0
    assert 'tooth frequency of GEAR 7 "pair": 636.62 Hz' in out
    rows = [line.split() for line in out.splitlines() if " x GEAR" in line]
    assert [float(rows[0][0]), float(rows[0][1])] == pytest.approx([636.6198, 80], rel=1e-4)
    assert [float(rows[1][0]), float(rows[1][1])] == pytest.approx([1273.2395, 20], rel=1e-4)
    assert rows[1][3] == "2"
    assert is_picture(tmp_path / "two_element_7_NORMAL_FORCE_spectrum.png")
    assert (
        command("spectrum", two, "7.u_m", "--mark", "1000", "--log", "--max", "2000", "-o", "a.png")[0] == 0
    )
    assert "no lines" in command("spectrum", two, "kinetic_energy", "-o", "a.png")[1]
    status, _, err = command("spectrum", two, "7.u_m", "--to", "5e-5")
    assert status == 1 and "needs 8" in err


@pytest.mark.parametrize("window", WINDOWS)
@pytest.mark.parametrize("frequency", [50.0, 50.37, 61.8])
def test_a_sine_of_one_shows_one(window: str, frequency: float) -> None:
    t = np.linspace(0, 2, 2001)
    s = spectrum(t, 7 + np.sin(2 * np.pi * frequency * t + 0.3), window)
    (f, a), *_ = s.peaks(3)
    # A plain cut of broken periods leaks: its error falls with the length of the record only.
    tolerance = 5e-4 if window != "none" else 5e-3
    assert a == pytest.approx(1, rel=tolerance)
    assert f == pytest.approx(frequency, abs=0.02)
    assert s.mean == pytest.approx(7, abs=0.02)


def test_uneven_steps() -> None:
    rng = np.random.default_rng(1)
    t = np.cumsum(rng.uniform(0.5e-3, 1.5e-3, 4000))
    t = np.insert(t, 2000, t[2000])
    s = spectrum(t, 2 * np.sin(2 * np.pi * 40 * t))
    assert s.resampled
    assert s.peaks(1)[0] == (pytest.approx(40, abs=0.01), pytest.approx(2, rel=2e-3))


def test_tooth_frequency_of_a_planetary_set(planetary: Path) -> None:
    """Relative to the turning carrier: z_s (w_s - w_c) = z_r w_c, the same for all six pairs."""
    with Results(planetary) as r:
        found = tooth_frequencies(r, 0, 2)
    assert len(found) == 6
    for f in found:
        assert f.frequency == pytest.approx(60 * 2 / 7 / (2 * np.pi), rel=1e-3)


def test_help(command, capsys) -> None:
    for words in (
        ["--help"],
        ["plot", "--help"],
        ["spectrum", "--help"],
        ["picture", "--help"],
        ["animate", "--help"],
    ):
        with pytest.raises(SystemExit) as e:
            command(*words)
        assert e.value.code == 0
        assert "examples:" in capsys.readouterr().out


def test_words_that_are_missing(command, tmp_path: Path) -> None:
    status, _, err = command("sweep", tmp_path / "deck.dat")
    assert status == 1
    assert "required: -D" in err


def test_figures_without_results(command, tmp_path: Path) -> None:
    status, _, err = command("figures", "--results", tmp_path)
    assert status == 2
    assert "run engrane on decks/paper" in err
