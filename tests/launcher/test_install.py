# SPDX-License-Identifier: BSD-3-Clause
"""What `cmake --install` and `cpack` make works without the source tree."""

import gzip
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
BUILD = ROOT / "build"


def run(*words, status=0, **options):
    done = subprocess.run(
        [str(w) for w in words], capture_output=True, text=True, stdin=subprocess.DEVNULL, **options
    )
    assert done.returncode == status, done.stdout + done.stderr
    return done


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    """An installation that has been moved since it was made."""
    folder = tmp_path_factory.mktemp("install")
    run("cmake", "--install", BUILD, "--prefix", folder / "made")
    return (folder / "made").rename(folder / "moved")


@pytest.fixture
def installed(prefix, tmp_path):
    """Runs `engrane ...` in an empty folder, with nothing in the environment that points to the source tree
    but a Python, which says where it was told to look for the Python side."""
    python = tmp_path / "python"
    python.write_text(
        f'#!/bin/sh\necho "looks in $PYTHONPATH, runs $ENGRANE" >&2\nexec {sys.executable} "$@"\n'
    )
    python.chmod(0o755)
    work = tmp_path / "work"
    work.mkdir()
    kept = {k: v for k, v in os.environ.items() if k.startswith(("OMP_", "OMPI_", "OPENBLAS_", "VTK_"))}
    settings = kept | {
        "PATH": f"{prefix}/bin:/usr/bin:/bin",
        "HOME": str(tmp_path / "home"),
        "ENGRANE_PYTHON": str(python),
    }

    def call(*words, status=0, **more):
        return run("engrane", *words, status=status, cwd=work, env=settings | more)

    call.folder, call.home = work, tmp_path / "home"
    return call


def test_a_spur_pair_runs_and_is_drawn(installed, prefix):
    deck = prefix / "share/engrane/decks/gears/spur.dat"
    installed(deck, "-o", "spur")
    drawn = installed("picture", "spur", "--size", "320x240", "-o", "spur.png")
    runs = f"{prefix}/libexec/engrane/engrane"  # for `sweep`
    assert drawn.stderr.strip() == f"looks in {prefix}/share/engrane/post, runs {runs}"
    assert (installed.folder / "spur.png").read_bytes()[:4] == b"\x89PNG"
    assert not (installed.home / ".cache/engrane").exists()  # nothing was built
    assert not list(prefix.rglob("__pycache__"))


def test_help_names_what_an_installation_can_do(installed):
    text = installed("--help").stdout
    assert "  engrane deck.dat" in text and "export" in text and "./engrane" not in text
    for word in ("figures", "gallery", "test", "--packages"):
        assert f"engrane {word}" not in text
        assert "needs the source tree" in installed(word, status=1).stderr


def test_an_environment_in_the_cache_is_used(installed, prefix):
    """As the launcher leaves it behind: made for these packages and this Python."""
    venv = installed.home / ".cache/engrane/venv"
    (venv / "bin").mkdir(parents=True)
    python = venv / "bin/python"
    python.write_text('#!/bin/sh\necho "$@"\n')
    python.chmod(0o755)
    packages = (prefix / "share/engrane/post/pyproject.toml").read_bytes()
    stamp = subprocess.run(["cksum"], input=packages, capture_output=True, check=True).stdout.decode().strip()
    (venv / ".ready").write_text(f"{stamp} {python.resolve()}\n")
    assert installed("plot", "x", ENGRANE_PYTHON="").stdout == "-m engrane_post plot x\n"


def test_manual_page_and_completions_are_in_place(prefix):
    page = gzip.decompress((prefix / "share/man/man1/engrane.1.gz").read_bytes()).decode()
    assert ".TH ENGRANE 1" in page and ".SS GEAR" in page
    script = prefix / "share/bash-completion/completions/engrane"
    asked = f"source {script}; COMP_WORDS=(engrane exp); COMP_CWORD=1; _engrane; echo ${{COMPREPLY[0]}}"
    assert run("bash", "-c", asked).stdout == "export\n"


@pytest.mark.skipif(
    not (shutil.which("dpkg-deb") and shutil.which("dpkg-shlibdeps")), reason="no dpkg-deb or dpkg-shlibdeps"
)
def test_debian_package(tmp_path):
    run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", tmp_path, cwd=tmp_path)
    (package,) = tmp_path.glob("*.deb")
    contents = [line.split()[5] for line in run("dpkg-deb", "-c", package).stdout.splitlines()]
    for path in (
        "./usr/bin/engrane",
        "./usr/libexec/engrane/engrane",
        "./usr/share/engrane/post/engrane_post/__main__.py",
        "./usr/share/engrane/decks/gears/spur.dat",
        "./usr/share/man/man1/engrane.1.gz",
        "./usr/share/bash-completion/completions/engrane",
        "./usr/share/doc/engrane/copyright",
    ):
        assert path in contents
    assert not [p for p in contents if "__pycache__" in p or "/tests/" in p]
    fields = run("dpkg-deb", "-f", package, "Depends", "Version", "Maintainer").stdout
    depends = {word.split()[0] for word in fields.split("Depends:")[1].splitlines()[0].split(",")}
    assert {"libc6", "libopenmpi3", "openmpi-bin", "python3-venv", "libosmesa6"} <= depends
    assert any(word.startswith("libpetsc-real") for word in depends)
    assert any(word.startswith("libhdf5-openmpi") for word in depends)
