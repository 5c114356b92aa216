# SPDX-License-Identifier: BSD-3-Clause
"""Finds the channel a user means."""

from __future__ import annotations

import difflib
import fnmatch
import re

from .errors import UserError

LISTING_HINT = "--list shows all channels."


def resolve(wanted: str, names: list[str], where: str = "the result") -> list[str]:
    """Full names meant by `wanted`, any case: `element/7/NORMAL_FORCE`, `7/normal_force`, `7.NORMAL_FORCE`, a
    bare run channel such as `KINETIC_ENERGY`, or a pattern with `*`. Raises UserError with the nearest names
    when there is none."""
    key = normalise(wanted)
    by_key = {normalise(n): n for n in names}
    if key in by_key:
        return [by_key[key]]
    if any(c in key for c in "*?["):
        patterns = [key, f"ELEMENT/{key}", f"NODE/{key}"] if key.count("/") == 1 else [key]
        found = [n for k, n in by_key.items() if any(fnmatch.fnmatchcase(k, p) for p in patterns)]
        if found:
            return found
        raise UserError(f"No channel of {where} fits {wanted}. {LISTING_HINT}")
    found = [n for k, n in by_key.items() if k.endswith("/" + key) and _may_shorten(k, key)]
    if len(found) == 1:
        return found
    if len(found) > 1:
        raise UserError(f"{wanted} could be {_either(found)} in {where}; write the one you mean.")
    near = suggestions(key, names)
    hint = f" Did you mean {_either(near)}?" if near else ""
    raise UserError(f"{where} has no channel {wanted}.{hint} {LISTING_HINT}")


def normalise(wanted: str) -> str:
    """Upper case, slashes between the parts, no history/ in front."""
    key = re.sub(r"[.:\s]+", "/", wanted.strip()).upper().strip("/")
    return key.removeprefix("HISTORY/")


def suggestions(key: str, names: list[str]) -> list[str]:
    """At most three names near `key`: the same owner with a similar channel first, then the same channel
    elsewhere."""
    by_key = {n.upper(): n for n in names}
    tails: dict[str, list[str]] = {}
    for k in by_key:
        parts = k.split("/")
        tails.setdefault("/".join(parts[1:]) if len(parts) == 3 else parts[-1], []).append(k)
    full = difflib.get_close_matches(key, list(by_key), 3, 0.6)
    short = [k for t in difflib.get_close_matches(key, list(tails), 3, 0.6) for k in tails[t]]
    last = key.split("/")[-1]
    same = [k for k in by_key if k.split("/")[-1] == last]
    out = list(dict.fromkeys((full or []) + short + same))
    return [by_key[k] for k in out[:3]]


def _may_shorten(full: str, key: str) -> bool:
    """`7/X` may stand for element/7/X or node/7/X, `X` for run/X and for an X that only one owner has."""
    return full.count("/") - key.count("/") in (1, 2)


def _either(names: list[str]) -> str:
    names = names[:4] + (["..."] if len(names) > 4 else [])
    return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " or " + names[-1]
