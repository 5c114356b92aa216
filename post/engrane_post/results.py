# SPDX-License-Identifier: BSD-3-Clause
"""Opens a result file (docs/format.md) and hands out its parts; works on partial files too."""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from types import TracebackType
from typing import Any, TypeVar

import h5py
import numpy as np

from .channels import resolve
from .errors import UserError
from .reading import GrowingFile, text

T = TypeVar("T")
AXIS_WIDTH = 36  # characters along the shortest diagram
LONG_LABEL = 2 * AXIS_WIDTH  # characters of a label that is cut to its first clause in diagrams


@dataclass(frozen=True)
class Channel:
    """One history: its full name (`element/7/NORMAL_FORCE`), a few words, its unit, the owner's type and
    name, whether its values are the only ones that balance the loads, and where they stand: the table below
    /history and its column."""

    name: str
    label: str
    unit: str
    owner: str = ""
    unique: bool = True
    table: str = ""
    column: int = 0

    @property
    def component(self) -> str:
        """The name without its owner: `NORMAL_FORCE`."""
        return self.name.rpartition("/")[2]

    @property
    def description(self) -> str:
        """`UX: displacement`, in a line of a diagram."""
        words = self.label
        if len(words) > LONG_LABEL:
            words = re.split("[,;] ", words)[0]
        return described(self.component, words)

    def axis_label(self, before: str = "", width: int = AXIS_WIDTH) -> str:
        """Text for a plot's axis: these words, name, label and unit in brackets, broken so that nothing is
        cut off."""
        text = f"{before} {self.description} {bracketed(self.unit)}{self.remark}".strip()
        return "\n".join(textwrap.wrap(text, width))

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
    factor: float = 1.0  # displacements are shown so many times as large


@dataclass(frozen=True)
class Field:
    """What is archived at every frame: over nodes, or over cells with the names of its components."""

    name: str
    of_cells: bool
    unit: str
    components: list[str]


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


def described(name: str, label: str) -> str:
    """A name with the label that explains it: `UX: displacement`, `DRIVE_TORQUE of the drive on B`."""
    if label.lower() in ("", name.lower().replace("_", " ")):
        return name
    continues = label.startswith(("of ", "to ", "about ", "from ", "along ", "on "))
    return f"{name} {label}" if continues else f"{name}: {label}"


def bracketed(unit: str) -> str:
    """`[N]`, `[force]`, or nothing for a plain number."""
    unit = unit.strip()
    if unit in ("", "-", "1"):
        return ""
    return unit if unit.startswith("[") else f"[{unit}]"


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
        self._file = GrowingFile(self.path)

    def __enter__(self) -> Results:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Closes the file; arrays already handed out stay valid."""
        self._file.close()

    def read(self, look: Callable[[h5py.File], T]) -> T:
        """What `look` finds in the HDF5 file, even while a run writes it: `look` may be called again."""
        return self._file.read(look)

    def dataset(self, name: str) -> np.ndarray | None:
        """All of a dataset, or None."""
        return self.read(lambda f: f[name][()] if name in f else None)

    def _attribute(self, name: str) -> str:
        return self.read(lambda f: text(f.attrs[name]) if name in f.attrs else "")

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
        """Elements of the model."""
        raw = self.dataset("model")
        if raw is None:
            return []
        try:
            data = json.loads(text(raw))
        except ValueError as error:
            raise UserError(f"{self.path}: /model is not valid JSON ({error}).") from error
        return [
            Element(
                int(e["id"]),
                e.get("type", "?"),
                [int(n) for n in e.get("nodes", [])],
                e.get("parameters") or {},
                e.get("drawing") or [],
                e.get("name") or "",
            )
            for e in data.get("elements", [])
        ]

    # Histories

    @cached_property
    def channels(self) -> dict[str, Channel]:
        """All histories by full name: elements, then nodes, in the order of their numbers, then the run."""
        titles = {e.id: e.title for e in self.elements}
        found: list[tuple[int, int, Channel]] = []
        for table in self.read(_tables):
            kind = table.path.split("/")[0]
            rank = {"element": 0, "node": 1}.get(kind, 2)
            width = len(table.names)
            for column, unique in enumerate(table.unique):
                k = column % width
                owner = table.ids[column // width] if table.ids else 0
                prefix = f"{kind}/{owner}" if table.ids else kind
                title = titles.get(owner, f"{table.type or 'element'} {owner}") if rank == 0 else prefix
                channel = Channel(
                    f"{prefix}/{table.names[k]}",
                    table.labels[k],
                    table.units[k],
                    title.replace("/", " "),
                    unique,
                    table.path,
                    column,
                )
                found.append((rank, owner, channel))
        found.sort(key=lambda entry: entry[:2])
        return {channel.name: channel for _, _, channel in found}

    def find_channels(self, wanted: str) -> list[Channel]:
        """Channels meant by a name as a user types it; a pattern such as `element/*/NORMAL_FORCE` may give
        several."""
        if not self.channels:
            raise UserError(f"{self.path} holds no histories{self._unfinished()}.")
        return [self.channels[n] for n in resolve(wanted, list(self.channels), str(self.path))]

    @cached_property
    def time_unit(self) -> str:
        def look(file: h5py.File) -> str:
            for name in ("history/time", "fields/time"):
                if name in file and "unit" in file[name].attrs:
                    return text(file[name].attrs["unit"])
            return ""

        return self.read(look)

    def times(self) -> np.ndarray:
        """Times of the samples."""
        t = self.dataset("history/time")
        return np.empty(0) if t is None else np.asarray(t, float)

    def history(
        self, channel: Channel | str, start: float | None = None, end: float | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Times and values (both of length s) of one channel between `start` and `end`, both included."""
        if isinstance(channel, str):
            found = self.find_channels(channel)
            if len(found) != 1:
                raise UserError(f"{channel} names {len(found)} channels; name one.")
            channel = found[0]
        where = channel

        def look(file: h5py.File) -> tuple[np.ndarray, np.ndarray]:
            values = file[f"history/{where.table}/values"]
            return np.asarray(file["history/time"][()], float), np.asarray(values[:, where.column], float)

        t, y = self.read(look)
        if len(t) == 0:
            raise UserError(f"{self.path}: {channel.name} has no samples yet{self._unfinished()}.")
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

    def samples(self, table: str, rows: np.ndarray) -> np.ndarray:
        """These samples (ascending, may repeat) of all histories in a table, see Channel."""
        unique, back = np.unique(rows, return_inverse=True)
        return self.read(lambda f: np.asarray(f[f"history/{table}/values"][unique], float))[back]

    def _unfinished(self) -> str:
        return "" if self.status == "complete" else f" (the run's status is {self.status})"

    @cached_property
    def node_ids(self) -> np.ndarray:
        return np.asarray(self._mesh("node_ids"), int)

    @cached_property
    def points(self) -> np.ndarray:
        """Reference positions, n x 3: of the nodes, then of those where several sections of cells meet, once
        more for each further section."""
        return np.asarray(self._mesh("points"), float).reshape(-1, 3)

    def _mesh(self, name: str) -> np.ndarray:
        data = self.dataset(f"mesh/{name}")
        if data is None:
            raise UserError(f"{self.path} holds no mesh (/mesh/{name} is missing){self._unfinished()}.")
        return data

    @cached_property
    def frame_times(self) -> np.ndarray:
        times = self.dataset("fields/time")
        return np.empty(0) if times is None else np.asarray(times, float)

    def has_fields(self, *names: str) -> bool:
        """Whether the run archives all these fields."""
        return self.read(lambda f: all(f"fields/{name}" in f for name in names))

    def field(self, name: str, index: int) -> np.ndarray | None:
        """One field (n x 3) of frame `index` >= 0, or None when the run did not archive it."""
        data = self.dataset(f"fields/{name}/{index:06d}")
        return None if data is None else np.asarray(data, float)

    @property
    def fields(self) -> dict[str, Field]:
        """All fields over nodes and over cells by name."""
        return self._fields("fields")

    @property
    def averages(self) -> dict[str, Field]:
        """Those averaged at nodes over the cells of a section, by name; some are over the cells too."""
        return self._fields("nodes")

    def _fields(self, folder: str) -> dict[str, Field]:
        def look(file: h5py.File) -> dict[str, Field]:
            return {
                key: Field(
                    key,
                    text(group.attrs.get("center", "")) == "Cell",
                    text(group.attrs.get("unit", "")),
                    text(group.attrs.get("components", "")).split(),
                )
                for key, group in file.get(folder, {}).items()
                if isinstance(group, h5py.Group)
            }

        return self.read(look)

    def cell_field(self, name: str, index: int) -> np.ndarray:
        """One field over the cells of frame `index` >= 0, a value for each: `VON_MISES`, or a component,
        `STRESS:XX`."""
        fields = {f.name: f.components for f in self.fields.values() if f.of_cells}
        names = _component_names(fields)
        if name not in names:
            raise UserError(
                f"{self.path} has no field {name} over its cells; "
                + (f"it has {', '.join(sorted(names))}." if names else "it has none at all.")
            )
        return self._component("fields", name, fields, index)

    def average(self, name: str, index: int) -> np.ndarray | None:
        """The same averaged at the nodes, a value for each of `points`; None where there is no such field."""
        fields = {f.name: f.components for f in self.averages.values()}
        return self._component("nodes", name, fields, index) if name in _component_names(fields) else None

    def _component(self, folder: str, name: str, fields: dict[str, list[str]], index: int) -> np.ndarray:
        field, _, component = name.partition(":")
        values = self.read(lambda f: np.asarray(f[f"{folder}/{field}/{index:06d}"], float))
        return values.reshape(len(values), -1)[:, fields[field].index(component) if component else 0]

    def cell_field_unit(self, name: str) -> str:
        """The unit of such a field, in brackets."""
        field = name.partition(":")[0]
        return self.read(lambda file: bracketed(text(file["fields"][field].attrs.get("unit", ""))))

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

    def mode(self, number: int) -> Frame:
        """A mode of linearised buckling, from 1: its largest displacement is a tenth of the model's size."""
        times = self.dataset("modes/load_time")
        count = 0 if times is None else len(times)
        if not 1 <= number <= count:
            raise UserError(
                f"{self.path} has modes 1 to {count}; there is no mode {number}."
                if count
                else f"{self.path} holds no modes; the deck asks for them with .BUCKLING."
            )
        u, r = self.dataset(f"modes/mode_{number}"), self.dataset(f"modes/rotation_{number}")
        size = float(np.linalg.norm(np.ptp(self.points, axis=0))) or 1.0
        return Frame(float(times[number - 1]), 0.1 * size * u, 0.1 * size * r)

    def frame_at(self, time: float) -> Frame:
        """The frame nearest to a time between the first and the last."""
        times = self.frame_times
        if len(times) == 0:
            return self.frame(0)
        rounding = 1e-9 * max(abs(times[0]), abs(times[-1]))
        if not times[0] - rounding <= time <= times[-1] + rounding:
            raise UserError(
                f"{self.path} has no frame at t = {time:g}: they are from {times[0]:g} to {times[-1]:g}."
            )
        return self.frame(int(np.argmin(np.abs(times - time))))


def _component_names(fields: dict[str, list[str]]) -> list[str]:
    """`STRESS:XX`, or a scalar's name."""
    return [f"{key}:{c}" for key, of in fields.items() for c in of] + [k for k in fields if not fields[k]]


@dataclass(frozen=True)
class _Table:
    """Histories of owners that have the same channels: a group below /history."""

    path: str
    type: str
    ids: list[int]
    names: list[str]
    units: list[str]
    labels: list[str]
    unique: list[bool]


def _tables(file: h5py.File) -> list[_Table]:
    found: list[_Table] = []

    def keep(path: str, group: h5py.Group | h5py.Dataset) -> None:
        if not isinstance(group, h5py.Group) or "values" not in group:
            return
        words = {k: [text(w) for w in group[k][()]] for k in ("channels", "units", "labels")}
        ids = [int(i) for i in group["ids"][()]] if "ids" in group else []
        count = group["values"].shape[1]
        unique = [bool(u) for u in group["unique"][()]] if "unique" in group else [True] * count
        kind = text(group.attrs["type"]) if "type" in group.attrs else ""
        found.append(_Table(path, kind, ids, words["channels"], words["units"], words["labels"], unique))

    if "history" in file:
        file["history"].visititems(keep)
    return found
