# SPDX-License-Identifier: BSD-3-Clause
"""Opening files, finding channels, and sentences for what is wrong."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import h5py
import models
import numpy as np
import pytest
from engrane_post import Results, UserError
from engrane_post.channels import resolve


def test_names_of_a_result(two: Path) -> None:
    for name in ("two.h5", "two", "two.xdmf", "two.dat", "two.lst"):
        with Results(two.with_name(name)) as r:
            assert r.path == two
            assert (r.title, r.status, r.analysis, r.time_unit) == ("two wheels", "complete", "DYNAMIC", "s")


def test_partial_file_stands_in(tmp_path: Path) -> None:
    models.two_wheels(tmp_path / "run.partial.h5", status="running")
    with Results(tmp_path / "run") as r:
        assert r.status == "running"
        assert r.name == "run.partial"


def test_channels(two: Path) -> None:
    with Results(two) as r:
        assert next(iter(r.channels)) == "element/7/NORMAL_FORCE"
        c = r.channels["element/7/NORMAL_FORCE"]
        assert (c.unit, c.axis_label(), c.owner) == ("N", "NORMAL_FORCE [N]", 'GEAR 7 "pair"')
        for name in (
            "element/7/NORMAL_FORCE",
            "ELEMENT/7/normal_force",
            "7.NORMAL_FORCE",
            "7/normal_force",
            "history/element/7/NORMAL_FORCE",
            "normal_force",
        ):
            assert r.find_channels(name) == [c]
        assert r.find_channels("kinetic_energy")[0].name == "run/KINETIC_ENERGY"
        assert [c.name for c in r.find_channels("*/7/*")] == ["element/7/NORMAL_FORCE", "element/7/U_M"]
        t, y = r.history("7.u_m", 0.01, 0.02)
        assert (t[0], t[-1], len(t), len(y)) == (pytest.approx(0.01), pytest.approx(0.02), 1001, 1001)


def test_channel_that_two_owners_have() -> None:
    names = ["element/7/RX", "node/7/RX", "node/8/RX"]
    with pytest.raises(UserError, match="element/7/RX or node/7/RX"):
        resolve("7/rx", names)
    assert resolve("8.rx", names) == ["node/8/RX"]


@pytest.mark.parametrize(
    ("wanted", "hint"),
    [
        ("element/7/NORMAL_FORC", "element/7/NORMAL_FORCE"),
        ("9/NORMAL_FORCE", "element/7/NORMAL_FORCE"),
        ("7.um", "element/7/U_M"),
        ("kinetic_enrgy", "run/KINETIC_ENERGY"),
    ],
)
def test_did_you_mean(two: Path, wanted: str, hint: str) -> None:
    with Results(two) as r, pytest.raises(UserError, match="Did you mean") as e:
        r.find_channels(wanted)
    assert hint in str(e.value)


def test_frames(two: Path) -> None:
    with Results(two) as r:
        assert len(r.frame_times) == 9
        assert r.frame(-1).index == 8
        assert r.frame_at(0.0).time == 0
        with pytest.raises(UserError, match="frames 0 to 8; there is no frame 9"):
            r.frame(9)
        with pytest.raises(UserError, match="no frame at t = 5: they are from 0 to"):
            r.frame_at(5)


def test_missing(tmp_path: Path) -> None:
    models.two_wheels(tmp_path / "other.h5")
    with pytest.raises(UserError, match=r"no result file .*run\.h5.*other\.h5"):
        Results(tmp_path / "run.h5")
    (tmp_path / "run.dat").write_text(".FIN 1\n")
    with pytest.raises(UserError, match="has not been run"):
        Results(tmp_path / "run.dat")
    with pytest.raises(UserError, match="folder"):
        Results(tmp_path)


def test_not_ours(tmp_path: Path) -> None:
    (tmp_path / "a.h5").write_text("hello")
    with pytest.raises(UserError, match="not an HDF5 file"):
        Results(tmp_path / "a.h5")
    (tmp_path / "empty.h5").write_bytes(b"")
    with pytest.raises(UserError, match="not an HDF5 file"):
        Results(tmp_path / "empty.h5")
    h5py.File(tmp_path / "b.h5", "w").close()
    with pytest.raises(UserError, match="not a result of engrane"):
        Results(tmp_path / "b.h5")
    for version in (1, 3):
        with h5py.File(tmp_path / "c.h5", "w") as f:
            f.attrs.update(format="engrane", format_version=version)
        with pytest.raises(UserError, match=f"format version {version}; this program reads version 2"):
            Results(tmp_path / "c.h5")


def test_empty_histories_and_frames(tmp_path: Path) -> None:
    path = models.write(
        tmp_path / "e.h5",
        {1: (0, 0, 0)},
        [],
        status="failed",
        history={"run/STEP": (np.empty(0), "s", "time step")},
        history_time=np.empty(0),
    )
    with Results(path) as r:
        with pytest.raises(UserError, match=r"no samples yet .*failed"):
            r.history("step")
        with pytest.raises(UserError, match="no frames"):
            r.frame(0)


def test_frame_with_nan(tmp_path: Path) -> None:
    path = models.two_wheels(tmp_path / "n.h5")
    with h5py.File(path, "a") as f:
        f["fields/displacement/000003"][2, 0] = np.nan
    with Results(path) as r:
        r.frame(2)
        with pytest.raises(UserError, match="frame 3: the displacement of node 3 is not a number"):
            r.frame(3)


def test_file_of_a_killed_run(tmp_path: Path) -> None:
    """A writer that is shot after flushing: what it wrote can be read."""
    path = tmp_path / "killed.h5"
    code = f"""
        import sys, time; sys.path.insert(0, {str(Path(__file__).parent)!r})
        import h5py, numpy as np, models
        models.two_wheels(__import__('pathlib').Path({str(path)!r}), status="running", samples=50)
        f = h5py.File({str(path)!r}, "a"); d = f.create_dataset("more", (0,), maxshape=(None,))
        d.resize((10,)); f.flush(); print("ready", flush=True); time.sleep(60)
    """
    environment = {**os.environ, "HDF5_USE_FILE_LOCKING": "FALSE"}
    p = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(code)], stdout=subprocess.PIPE, env=environment
    )
    assert p.stdout is not None
    assert p.stdout.readline().strip() == b"ready"
    with Results(path) as r:  # beside the living writer
        assert len(r.history("7/U_M")[0]) == 50
    p.send_signal(signal.SIGKILL)
    p.wait()
    time.sleep(0.05)
    with Results(path) as r:
        assert r.status == "running"
        assert len(r.history("7/U_M")[0]) == 50
