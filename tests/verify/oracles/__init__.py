# SPDX-License-Identifier: BSD-3-Clause
"""Reference solutions written without the solver: closed forms and ordinary differential equations."""
