# SPDX-License-Identifier: BSD-3-Clause
"""Puts this folder on the path of all tests below it, which share its modules."""
