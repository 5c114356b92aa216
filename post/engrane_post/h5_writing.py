# SPDX-License-Identifier: BSD-3-Clause
"""Writes HDF5 files on disks that may be full."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py


class _Disk(io.FileIO):
    """A file that keeps the first error and takes the rest for written: after a failed write the library
    can close no file any more, and ends the program by a segmentation fault."""

    error: OSError | None = None

    def write(self, data) -> int:
        size = memoryview(data).nbytes
        at = 0
        while self.error is None and at < size:
            try:
                at += super().write(memoryview(data).cast("B")[at:])
            except OSError as error:
                self.error = error
        return size

    def truncate(self, size: int | None = None) -> int:
        if self.error is None:
            try:
                return super().truncate(size)
            except OSError as error:
                self.error = error
        return size or 0


@contextmanager
def new_file(path: Path) -> Iterator[h5py.File]:
    """An empty file to write into; it is removed if it cannot be written whole."""
    disk = None
    try:
        with _Disk(path, "w+b") as disk:
            with h5py.File(disk, "w") as file:
                yield file
            if disk.error is None:
                disk.flush()
        if disk.error is not None:
            raise disk.error
    except BaseException as error:
        if disk is not None:
            path.unlink(missing_ok=True)
            if disk.error is not None and isinstance(error, Exception):
                raise OSError(disk.error.errno, disk.error.strerror, str(path)) from None
        raise
