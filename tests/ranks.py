# SPDX-License-Identifier: BSD-3-Clause
"""Commands on several MPI ranks."""

from __future__ import annotations


def on_ranks(ranks: int, command: list[str], mpiexec: str = "mpiexec") -> list[str]:
    """The command, on so many ranks. Tests run side by side: ranks that wait give way to others."""
    if ranks == 1:
        return command
    polite = ["--quiet", "--oversubscribe", "--mca", "mpi_yield_when_idle", "1", "--bind-to", "none"]
    return [mpiexec, "-np", str(ranks), *polite, *command]
