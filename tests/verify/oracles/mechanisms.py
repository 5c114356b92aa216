# SPDX-License-Identifier: BSD-3-Clause
"""Driven mechanisms in closed form, written in other ways than in their decks: circles that meet, and rates
by the complex step. SI units; the data of decks/mechanisms."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np


def rate(f: Callable, x: np.ndarray) -> np.ndarray:
    """df/dx to rounding, by the complex step."""
    return np.imag(f(np.asarray(x) + 1e-200j)) / 1e-200


def circles(first: np.ndarray, r1: float, second: np.ndarray, r2: float, side: float) -> np.ndarray:
    """Where two circles meet (x and y in the last axis), on the left (side 1) or right of the line from the
    first centre to the second."""
    across = second - first
    d2 = across[0] ** 2 + across[1] ** 2
    along = (r1**2 - r2**2 + d2) / (2 * d2)
    away = side * np.sqrt(r1**2 / d2 - along**2)
    left = np.stack([-across[1], across[0]])
    return first + along * across + away * left


def four_bar(crank: np.ndarray, a=0.1, b=0.25, c=0.3, d=0.35) -> np.ndarray:
    """Angle of the rocker from the frame."""
    zero = 0 * crank
    pin = np.stack([a * np.cos(crank), a * np.sin(crank)])
    end = circles(pin, b, np.stack([d + zero, zero]), c, 1.0)
    x, y = end[0] - d, end[1]
    return np.pi / 2 - np.arctan(x / y)  # y > 0 all round


def grashof(a: float, b: float, c: float, d: float) -> bool:
    """Does the shortest link turn fully?"""
    shortest, p, q, longest = sorted((a, b, c, d))
    return shortest + longest < p + q


def slotted_arm(crank: np.ndarray, r=0.1, d=0.2) -> np.ndarray:
    """Angle of the arm of a quick return, crank and arm upright at zero."""
    return np.arctan(r * np.sin(crank) / (d + r * np.cos(crank)))


def ram(crank: np.ndarray, length=0.5, link=0.2, height=0.46) -> np.ndarray:
    """Place of the ram of the quick return."""
    arm = slotted_arm(crank)
    return -length * np.sin(arm) + np.sqrt(link**2 - (height - length * np.cos(arm)) ** 2)


def slider(crank: np.ndarray, r=0.2, rod=0.6, off=0.1) -> np.ndarray:
    """Place of the slider of a spatial slider-crank along its line, `off` beside the crank's plane."""
    return r * np.cos(crank) + np.sqrt(rod**2 - off**2 - (r * np.sin(crank)) ** 2)


def universal_pair(shaft: np.ndarray, first: float, second: float) -> np.ndarray:
    """Angle behind two universal joints in one plane, with the forks of the shaft between in one plane: the
    direction of each cross's pins, carried on (angles about each shaft's own axis)."""
    turned = np.exp(1j * shaft)
    middle = turned.real * np.cos(first) + 1j * turned.imag
    after = middle.real + 1j * middle.imag * np.cos(second)
    return np.unwrap(np.angle(after))
