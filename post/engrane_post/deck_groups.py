# SPDX-License-Identifier: BSD-3-Clause
"""The groups of nodes and of cells of the deck that a result was computed from."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np

from .results import Results, text

WORD = re.compile(r'"[^"]*"|\'[^\']*\'|\S+')
#: keywords of .SEL in the uniform spelling of `/deck`, the word of ranges among its numbers, and the end of a
#: line that goes on
KEYWORDS = {"GROUP", "NOM", "KIND", "IDS", "TOUT", "UNION", "BOITE", "AT"}
RANGE, GOES_ON = "A", "$"


@dataclass
class _Group:
    """What the records of a group name so far, as masks over all nodes, or all cells, of the result."""

    members: np.ndarray
    names: set[str] = field(default_factory=set)
    name: str = ""


class Groups:
    """By name, or `group 3` where there is none, which of the nodes and cells belong to them. Groups without
    members, and those of faces, are left out."""

    def __init__(
        self, result: Results, node_ids: np.ndarray, points: np.ndarray, cell_ids: np.ndarray
    ) -> None:
        self._numbers = {"NODES": node_ids, "ELEMENTS": cell_ids}
        self._points = points
        self._found: dict[str, list[_Group]] = {"NODES": [], "ELEMENTS": []}
        stored = result.dataset("deck")
        self._deck = "" if stored is None else text(stored)
        for part in re.findall(r"^\.SEL\n(.*?)(?=^\.|\Z)", self._deck, re.MULTILINE | re.DOTALL):
            lines = [line for line in part.splitlines() if not line.startswith("  !")]
            words = [word for word in WORD.findall("\n".join(lines)) if word != GOES_ON]
            starts = [i for i, word in enumerate(words) if word == "GROUP"]
            for begin, end in zip(starts, [*starts[1:], len(words)], strict=True):
                self._add(words[begin:end])
        self.nodes = self._named("NODES")
        self.cells = self._named("ELEMENTS")

    def _named(self, kind: str) -> dict[str, np.ndarray]:
        return {g.name or f"group {min(g.names)}": g.members for g in self._found[kind] if g.members.any()}

    def _add(self, words: list[str]) -> None:
        given: dict[str, list[str]] = {}
        for word in words:
            if word in KEYWORDS and word not in given:
                values = given[word] = []
            else:
                values.append(word[1:-1] if word[0] in "\"'" else word)
        kind = given.get("KIND", ["NODES"])[0]
        if kind not in self._found:
            return
        number, name = given["GROUP"][0], given.get("NOM", [""])[0]
        known = self._find(kind, number) or (self._find(kind, name) if name else None)
        if known is None:
            known = _Group(np.zeros(len(self._numbers[kind]), bool))
            self._found[kind].append(known)
        known.names |= {number, name} - {""}
        known.name = known.name or name
        known.members = known.members | self._members(kind, given)

    def _find(self, kind: str, name: str) -> _Group | None:
        return next((g for g in self._found[kind] if name in g.names), None)

    def _members(self, kind: str, given: dict[str, list[str]]) -> np.ndarray:
        numbers = self._numbers[kind]
        members = np.full(len(numbers), "TOUT" in given)
        if "IDS" in given:
            members |= np.isin(numbers, _expanded(given["IDS"]))
        for other in given.get("UNION", ()):
            if found := self._find(kind, other):
                members |= found.members
        if "BOITE" in given and kind == "NODES":
            box = np.array(given["BOITE"], float).reshape(3, 2)
            members |= ((self._points >= box[:, 0]) & (self._points <= box[:, 1])).all(axis=1)
        if "AT" in given and kind == "ELEMENTS":
            rows = re.findall(rf"^ I (\d+) AT {int(given['AT'][0])}\b", self._deck, re.MULTILINE)
            members |= np.isin(numbers, np.array(rows, int))
        return members


def _expanded(words: list[str]) -> np.ndarray:
    """Numbers, and ranges such as `1 A 20`."""
    numbers: list[int] = []
    at = 0
    while at < len(words):
        if words[at] == RANGE and numbers and at + 1 < len(words):
            numbers.extend(range(numbers[-1] + 1, int(words[at + 1]) + 1))
            at += 2
        else:
            numbers.append(int(words[at]))
            at += 1
    return np.array(numbers, int)
