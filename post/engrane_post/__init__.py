# SPDX-License-Identifier: BSD-3-Clause
"""Reads and shows the results of engrane: histories, spectra, pictures, animations."""

from .errors import UserError
from .results import Results

__all__ = ["Results", "UserError"]
