# SPDX-License-Identifier: BSD-3-Clause
"""Opens a result file (docs/format.md, version 1) and hands out its parts; works on partial files too."""

from __future__ import annotations

import json
import os
import textwrap
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from types import TracebackType
from typing import Any

# Readers must not lock: the run may still be writing, and some file systems have no locks.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np

from .channels import resolve
from .errors import UserError

FORMAT_VERSION = 1
AXIS_WIDTH = 36  # characters along the shortest diagram


@dataclass(frozen=True)
class Channel:
    """One history: its full name (`element/7/NORMAL_FORCE`), a few words, its unit, the owner's type and
    name, and whether its values are the only ones that balance the loads."""

    name: str
    label: str
    unit: str
    owner: str = ""
    unique: bool = True

    @property
    def axis_label(self) -> str:
        """Text for a plot's axis: the label with the unit in brackets, broken so that neither is cut off."""
        text = f"{self.label or self.name} {bracketed(self.unit)}{self.remark}".strip()
        return "\n".join(textwrap.wrap(text, AXIS_WIDTH))

    @property
    def remark(self) -> str:
        """` (not unique)` for a reaction that redundant constraints leave undetermined."""
        return "" if self.unique else " (not unique)"


@dataclass(frozen=True)
class Frame:
    """Positions at one time: displacement and rotation vector of every node (n x 3 each; model units,
    radians)."""

    time: float | None
    displacement: np.ndarray
    rotation: np.ndarray
    index: int | None = None


@dataclass
class Element:
    """One element of the model: id, type, nodes (0 is the ground), the card's parameters and the shapes to
    draw."""

    id: int
    type: str
    nodes: list[int]
    parameters: dict[str, Any] = field(default_factory=dict)
    drawing: list[dict[str, Any]] = field(default_factory=list)
    name: str = ""

    @property
    def title(self) -> str:
        """`GEAR 7` or `GEAR 7 "output pair"`."""
        return f'{self.type} {self.id} "{self.name}"' if self.name else f"{self.type} {self.id}"


def bracketed(unit: str) -> str:
    """`[N]`, `[force]`, or nothing for a plain number."""
    unit = unit.strip()
    if unit in ("", "-", "1"):
        return ""
    return unit if unit.startswith("[") else f"[{unit}]"


def text(value: Any) -> str:
    """A string attribute or scalar dataset, however it was stored."""
    if isinstance(value, np.ndarray):
        value = value.item() if value.size == 1 else b"".join(value.ravel().tolist())
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def find(path: str | Path) -> Path:
    """The result file meant by a file, a prefix, a deck (`.dat`), an index (`.xdmf`) or a listing
    (`.lst`)."""
    given = Path(path)
    if given.is_dir():
        raise UserError(f"{given} is a folder; give a result file (.h5).")
    if given.suffix == ".h5" and given.exists():
        return given
    stem = given.with_suffix("") if given.suffix in (".h5", ".xdmf", ".dat", ".lst") else given
    for suffix in (".h5", ".partial.h5"):
        candidate = stem.with_name(stem.name + suffix)
        if candidate.exists():
            return candidate
    if given.exists() and given.suffix not in (".xdmf", ".dat", ".lst"):
        return given
    near = sorted(p.name for p in stem.parent.glob("*.h5"))[:6] if stem.parent.is_dir() else []
    hint = f" Results in that folder: {', '.join(near)}." if near else ""
    cause = " The deck has not been run yet." if given.suffix == ".dat" and given.exists() else ""
    raise UserError(f"There is no result file {stem.with_name(stem.name + '.h5')}.{cause}{hint}")


class Results:
    """An open result file. Use as a context manager; nothing is read before it is asked for."""

    def __init__(self, path: str | Path) -> None:
        self.path = find(path)
        self.file = self._open(self.path)
        self._check()

    def __enter__(self) -> Results:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Closes the file; arrays already handed out stay valid."""
        self.file.close()

    @staticmethod
    def _open(path: Path) -> h5py.File:
        try:
            return h5py.File(path, "r")
        except (OSError, RuntimeError) as first:
            # A killed writer can leave the mark "open for writing"; a reader beside the writer may still
            # look.
            try:
                return h5py.File(path, "r", swmr=True)
            except (OSError, RuntimeError):
                pass
            if not h5py.is_hdf5(path):
                raise UserError(f"{path} is not an HDF5 file, so it is not a result of engrane.") from first
            reason = str(first).strip().splitlines()[-1]
            raise UserError(f"{path} cannot be opened: {reason}") from first

    def _check(self) -> None:
        attributes = self.file.attrs
        if "format" not in attributes or text(attributes["format"]) != "engrane":
            raise UserError(
                f"{self.path} is an HDF5 file but not a result of engrane (no attribute format = engrane)."
            )
        version = int(attributes.get("format_version", 0))
        if version > FORMAT_VERSION:
            raise UserError(
                f"{self.path} has format version {version}; this program reads up to {FORMAT_VERSION}. "
                "Use the engrane that wrote it, or a newer one."
            )
        if version < 1:
            raise UserError(f"{self.path} has no valid format version.")

    def _attribute(self, name: str) -> str:
        return text(self.file.attrs[name]) if name in self.file.attrs else ""

    @property
    def title(self) -> str:
        return self._attribute("title")

    @property
    def status(self) -> str:
        """complete, running or failed; a file that is not complete holds the steps written so far."""
        return self._attribute("status") or "unknown"

    @property
    def analysis(self) -> str:
        return self._attribute("analysis")

    @property
    def name(self) -> str:
        """File name without `.h5`, for legends."""
        return self.path.name.removesuffix(".h5")

    @cached_property
    def elements(self) -> list[Element]:
        """Elements of the model; empty when the file was cut before the model was written."""
        if "model" not in self.file:
            return []
        raw = self.file["model"]
        try:
            data = json.loads(text(raw[()]))
        except ValueError as error:
            raise UserError(f"{self.path}: /model is not valid JSON ({error}).") from error
        out = []
        for e in data.get("elements", []):
            group = self.file.get(f"history/element/{e['id']}")
            name = (
                text(group.attrs["name"])
                if group is not None and "name" in group.attrs
                else e.get("name", "")
            )
            out.append(
                Element(
                    int(e["id"]),
                    e.get("type", "?"),
                    [int(n) for n in e.get("nodes", [])],
                    e.get("parameters") or {},
                    e.get("drawing") or [],
                    name or "",
                )
            )
        return out

    # Histories

    @cached_property
    def channels(self) -> dict[str, Channel]:
        """All histories by full name, elements first, in the order of their numbers."""
        history = self.file.get("history")
        if history is None:
            return {}
        out: dict[str, Channel] = {}
        types = {str(e.id): e for e in self.elements}
        for kind in ("element", "node"):
            groups = history.get(kind, {})
            for key in sorted(groups, key=lambda k: (0, int(k), k) if k.isdigit() else (1, 0, k)):
                owner = f"node {key}"
                if kind == "element":
                    kind_name = text(groups[key].attrs["type"]) if "type" in groups[key].attrs else ""
                    owner = types[key].title if key in types else f"{kind_name or 'element'} {key}"
                for channel in groups[key]:
                    self._add_channel(out, f"{kind}/{key}/{channel}", groups[key][channel], owner)
        for channel in history.get("run", {}):
            self._add_channel(out, f"run/{channel}", history["run"][channel], "run")
        return out

    @staticmethod
    def _add_channel(out: dict[str, Channel], name: str, data: h5py.Dataset, owner: str) -> None:
        if isinstance(data, h5py.Dataset) and data.ndim == 1:
            label = text(data.attrs["label"]) if "label" in data.attrs else ""
            unit = text(data.attrs["unit"]) if "unit" in data.attrs else ""
            out[name] = Channel(name, label, unit, owner, bool(data.attrs.get("unique", 1)))

    def find_channels(self, wanted: str) -> list[Channel]:
        """Channels meant by a name as a user types it; a pattern such as `element/*/NORMAL_FORCE` may give
        several."""
        if not self.channels:
            raise UserError(f"{self.path} holds no histories{self._unfinished()}.")
        return [self.channels[n] for n in resolve(wanted, list(self.channels), str(self.path))]

    @property
    def time_unit(self) -> str:
        for name in ("history/time", "fields/time"):
            if name in self.file and "unit" in self.file[name].attrs:
                return text(self.file[name].attrs["unit"])
        return ""

    def history(
        self, channel: Channel | str, start: float | None = None, end: float | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Times and values (both of length s) of one channel between `start` and `end`, both included."""
        if isinstance(channel, str):
            found = self.find_channels(channel)
            if len(found) != 1:
                raise UserError(f"{channel} names {len(found)} channels; name one.")
            channel = found[0]
        try:
            t = np.asarray(self.file["history/time"][()], float)
            y = np.asarray(self.file[f"history/{channel.name}"][()], float)
        except (OSError, KeyError) as error:
            raise UserError(f"{self.path}: {channel.name} cannot be read ({error}).") from error
        # A killed run may have written the time of a sample but not yet all its channels.
        n = min(len(t), len(y))
        if n == 0:
            raise UserError(f"{self.path}: {channel.name} has no samples yet{self._unfinished()}.")
        t, y = t[:n], y[:n]
        low = -np.inf if start is None else start
        high = np.inf if end is None else end
        # Times are sums of steps: an end given as a round number may lie a rounding past the last sample.
        slack = 1e-9 * max(abs(t[0]), abs(t[-1]), 1e-300)
        keep = (t >= low - slack) & (t <= high + slack)
        if not keep.any():
            raise UserError(
                f"{self.path}: no samples of {channel.name} between {low:g} and {high:g}; "
                f"the run covers {t[0]:g} to {t[-1]:g}."
            )
        return t[keep], y[keep]

    def _unfinished(self) -> str:
        return "" if self.status == "complete" else f" (the run's status is {self.status})"

    @cached_property
    def node_ids(self) -> np.ndarray:
        return np.asarray(self._mesh("node_ids"), int)

    @cached_property
    def points(self) -> np.ndarray:
        """Reference positions, n x 3."""
        return np.asarray(self._mesh("points"), float).reshape(-1, 3)

    def _mesh(self, name: str) -> np.ndarray:
        if f"mesh/{name}" not in self.file:
            raise UserError(f"{self.path} holds no mesh (/mesh/{name} is missing){self._unfinished()}.")
        return self.file[f"mesh/{name}"][()]

    @cached_property
    def frame_times(self) -> np.ndarray:
        fields = self.file.get("fields")
        if fields is None or "time" not in fields:
            return np.empty(0)
        n = [len(fields[k]) for k in ("displacement", "rotation") if k in fields]
        return np.asarray(fields["time"][()], float)[: min(n, default=0)]

    def field(self, name: str, index: int) -> np.ndarray | None:
        """One field (n x 3) of frame `index` >= 0, or None when the run did not archive it."""
        group = self.file.get(f"fields/{name}")
        key = f"{index:06d}"
        return np.asarray(group[key][()], float) if group is not None and key in group else None

    def reference(self) -> Frame:
        """The undeformed model."""
        zero = np.zeros_like(self.points)
        return Frame(None, zero, zero.copy())

    def frame(self, index: int) -> Frame:
        """Frame by number, negative from the end."""
        count = len(self.frame_times)
        if count == 0:
            raise UserError(
                f"{self.path} holds no frames{self._unfinished()}; "
                "ask for the undeformed model with --reference, or let the deck archive displacements (.SAI)."
            )
        if not -count <= index < count:
            raise UserError(f"{self.path} has frames 0 to {count - 1}; there is no frame {index}.")
        index %= count
        u, r = self.field("displacement", index), self.field("rotation", index)
        u = np.zeros_like(self.points) if u is None else u
        r = np.zeros_like(self.points) if r is None else r
        if not np.isfinite(u).all():
            bad = self.node_ids[~np.isfinite(u).all(axis=1)]
            raise UserError(
                f"{self.path}, frame {index}: the displacement of node {bad[0]} is not a number; "
                "the run went wrong at or before this frame."
            )
        # Nodes without a rotation may carry no number.
        return Frame(float(self.frame_times[index]), u, np.nan_to_num(r, nan=0.0), index)

    def frame_at(self, time: float) -> Frame:
        """The frame nearest to a time."""
        if len(self.frame_times) == 0:
            return self.frame(0)
        return self.frame(int(np.argmin(np.abs(self.frame_times - time))))
