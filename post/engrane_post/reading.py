# SPDX-License-Identifier: BSD-3-Clause
"""Reads an HDF5 file that a run may be writing."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

# Readers must not lock: the run may still be writing, and some file systems have no locks.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np

from .errors import UserError

FORMAT_VERSION = 2
ATTEMPTS = 40
PAUSE = 0.1  # seconds between attempts
READING_ERRORS = (OSError, RuntimeError, KeyError, ValueError)

CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")

T = TypeVar("T")


def text(value: Any) -> str:
    """A string attribute or dataset of one string, however it was stored."""
    if isinstance(value, np.ndarray):
        value = value.item() if value.size == 1 else b"".join(value.ravel().tolist())
    # h5py hands out strings that are no UTF-8 with a surrogate for each byte it cannot read
    raw = value if isinstance(value, bytes) else str(value).encode("utf-8", "surrogateescape")
    try:
        words = raw.decode("utf-8")
    except UnicodeDecodeError:  # a deck written in an old editor
        words = raw.decode("latin-1")
    # a title must not steer the terminal that it is printed on
    return CONTROL.sub("?", words)


class GrowingFile:
    """A result file (docs/format.md), reopened as often as it takes to read something whole.

    A run keeps two files and writes only into the one that does not bear the name. So what was read is whole
    if the name stood for the same, unchanged file from before it was opened until after it was read."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._file: h5py.File | None = None
        self._stamp: tuple[int, int, int] | None = None
        self.read(self._check)

    def close(self) -> None:
        if self._file is not None:
            self._file.close()
        self._file = None

    def read(self, look: Callable[[h5py.File], T]) -> T:
        """What `look` finds in the file; it is called again when the run changed the file meanwhile."""
        error: Exception | None = None
        for attempt in range(ATTEMPTS):
            if attempt:
                time.sleep(PAUSE)
            try:
                if self._file is None:
                    self._stamp = self._stamp_now()
                    self._file = h5py.File(self.path, "r")
                found = look(self._file)
            except READING_ERRORS as e:
                error = e
            else:
                if self._stamp == self._stamp_now():
                    return found
            changed = self._stamp != self._stamp_now()
            self.close()
            # a file that nobody touches will not become better
            if not changed and error is not None and attempt > 1:
                break
        if error is None:
            raise UserError(f"{self.path} changes faster than it can be read.")
        if not h5py.is_hdf5(self.path):
            raise UserError(f"{self.path} is not an HDF5 file, so it is not a result of engrane.") from error
        reason = str(error).strip().splitlines()[-1]
        raise UserError(f"{self.path} cannot be read: {reason}") from error

    def _stamp_now(self) -> tuple[int, int, int]:
        status = self.path.stat()
        return status.st_ino, status.st_size, status.st_mtime_ns

    def _check(self, file: h5py.File) -> None:
        if "format" not in file.attrs or text(file.attrs["format"]) != "engrane":
            raise UserError(
                f"{self.path} is an HDF5 file but not a result of engrane (no attribute format = engrane)."
            )
        version = int(file.attrs.get("format_version", 0))
        if version != FORMAT_VERSION:
            raise UserError(
                f"{self.path} has format version {version}; this program reads version {FORMAT_VERSION}: "
                "use the engrane that wrote it, or run the deck again."
            )
