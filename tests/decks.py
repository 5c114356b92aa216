# SPDX-License-Identifier: BSD-3-Clause
"""Runs decks on 1, 2 and 3 ranks: each run must pass its own .CHK, and all must give the same results. On
3 ranks, more than machines for tests have cores, a long run ends with its 100th sample, and is compared with
as much of the whole run. Decks of one folder are one test and are solved by one process (on each number of
ranks), which saves starts.

A run on one rank that is interrupted at a third of the way and continued must give every bit of the whole
run. Every channel must be what version 0.3.0 gave: last value and root of the mean square, from
tests/verify/results_0.3.0.json. Decks of a law that was wrong then have no entry there: profile_friction,
whose friction came and went within the path of contact. Nor have the joints' decks with friction and a small
VREG (hinge, prismatic, cylindrical, screw, spherical): steps failed then, and were cut, where something comes
to rest. universal_drives ends at half a turn, whose rotation vector has the other sign now. mesh_stiffness
has backlash, whose corner was rounded then; whether the flanks of gear_pair_elastic touch at the start
(CONTACT) was decided by 1e-21. Drives stood still in the last sample where their TABLE ends with the
run: the file has today's values there, and those of 0.3.0 before it.

    decks.py --binary engrane --mpiexec mpiexec --work folder deck.dat [deck.dat ...]

A deck may say in a comment what its test is:

    ! test: ranks 1          only on these ranks (one or several numbers)
    ! test: tolerance 1e-4   results of two runs may differ by so much (default 1e-6), relative to the largest
                             number of the same unit: teeth that rattle enlarge the last digit's noise
    ! test: short TF 1 H 0.1 the whole deck on one rank only; all ranks are compared over this much of it
    ! test: elsewhere FILE   beside `short`: this test of tests/ runs the whole deck with its checks
    ! test: part             not run: other decks INPUT it
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "post"))

from engrane_post import Results
from ranks import on_ranks

REFERENCE = Path(__file__).parent / "verify" / "results_0.3.0.json"
# How many steps and iterations a run takes is its own affair.
NOT_COMPARED = re.compile(r"^(run/(STEP|ITERATIONS)|checks|deck|model|history/.*|restart/.*)$")

FRAME = re.compile(r"^(?:fields|nodes|points)/.*/(\d+)$")

LONG = 100  # samples of a run


def wishes(deck: Path) -> dict[str, list[str]]:
    text = deck.read_text(encoding="utf-8", errors="replace")
    lines = re.findall(r"^\s*!\s*test:\s*(\w+)(.*)$", text, re.MULTILINE)
    return {word: rest.split() for word, rest in lines}


def datasets(path: Path):
    """(name, h5py.h5d.DatasetID, numbers) of every dataset of a file; None for the numbers of one that holds
    texts. A long run has thousands: h5py's own objects would take twice as long."""
    with h5py.File(path, "r") as file:
        names = []
        h5py.h5o.visit(file.id, names.append)
        for name in names:
            data = h5py.h5o.open(file.id, name)
            if not isinstance(data, h5py.h5d.DatasetID):
                continue
            values = None
            if data.dtype.kind in "fiu":
                values = np.empty(data.shape, data.dtype)
                if values.size > 0:
                    data.read(h5py.h5s.ALL, h5py.h5s.ALL, values)
            yield name.decode(), data, values


def unit_of(data: h5py.h5d.DatasetID) -> str:
    if not h5py.h5a.exists(data, b"unit"):
        return ""
    unit = h5py.Dataset(data).attrs["unit"]
    return unit.decode() if isinstance(unit, bytes) else str(unit)


def text_of(data: h5py.h5d.DatasetID) -> bytes:
    return repr(h5py.Dataset(data)[()]).encode()


class Read:
    """What a file of results holds, read once."""

    def __init__(self, path: Path) -> None:
        self.fields: dict[str, tuple[str, np.ndarray]] = {}  # unit and numbers of what is no history
        self.bytes: dict[str, bytes] = {}  # of every dataset of histories and fields
        tables = {}
        for name, data, values in datasets(path):
            if name.startswith("history/"):
                tables[name] = values
            elif values is not None and not NOT_COMPARED.match(name):
                self.fields[name] = (unit_of(data), values)
            if name.startswith(("history/", "fields/")):
                self.bytes[name] = values.tobytes() if values is not None else text_of(data)
        self.channels = {}
        with Results(path) as results:
            for name, channel in results.channels.items():
                values = tables[f"history/{channel.table}/values"]
                self.channels[name] = (channel.unit, values[:, channel.column])
            self.unique = {name for name, channel in results.channels.items() if channel.unique}
            self.times, self.time_unit = results.times(), results.time_unit
            self.frames = results.frame_times
            self.extent = float(np.max(np.abs(results.points), initial=1.0))

    def results(self, until: float = np.inf) -> dict[str, tuple[str, np.ndarray]]:
        """Dataset or channel -> (unit, values): all numbers of mesh, fields and histories, of a run that
        ended then. Under "" stands the noise of accelerations, which are differences of positions over the
        square of the step: Newton's iteration ends where corrections are 1e-13 of the lengths
        (docs/theory.md). Under "POWER" that of powers: of speeds, differences of rounded positions over the
        step, times the largest force."""
        count, frames = int(np.sum(self.times <= until)), int(np.sum(self.frames <= until))
        found = {}
        for name, (unit, values) in self.fields.items():
            frame = FRAME.search(name)
            if name == "fields/time":
                found[name] = (unit, values[:frames])
            elif not frame or int(frame.group(1)) < frames:
                found[name] = (unit, values)
        for name, (unit, values) in self.channels.items():
            if not NOT_COMPARED.match(name):
                found[name] = (unit, values[:count])
        found["time"] = (self.time_unit, self.times[:count])
        shortest = float(np.min(self.channels["run/STEP"][1][1:count], initial=1.0))
        rounding = np.finfo(float).eps * self.extent
        forces = [np.max(np.abs(values), initial=0) for name, (_, values) in found.items() if "FORCE" in name]
        found[""] = ("", np.array(1e-13 * self.extent / shortest**2))
        found["POWER"] = ("", np.array(rounding / shortest * max(forces, default=0)))
        return found


def size(values: np.ndarray) -> float:
    """The largest number; fields have none where an element does not have the field."""
    values = np.abs(np.asarray(values, float))
    return float(np.max(values[~np.isnan(values)], initial=0))


def differences(one: dict, other: dict, tolerance: float) -> list[str]:
    faults = [f"only in one of the results: {name}" for name in sorted(one.keys() ^ other.keys())]
    noise, noise_of_power = (float(one[name][1]) for name in ("", "POWER"))
    one, other = (
        {name: data for name, data in results.items() if name not in ("", "POWER")}
        for results in (one, other)
    )
    # A lateral force that is noise about zero is measured against the largest force, not against itself.
    # If all forces are noise, the rounding of the largest number there is counts.
    largest = max((size(values) for _, values in one.values()), default=0.0)
    scale = {}
    for unit, values in one.values():
        floor = 1e-16 * largest / tolerance
        scale[unit] = max(scale.get(unit, floor), size(values))
    for name in sorted(one.keys() & other.keys()):
        unit, a = one[name]
        b = other[name][1]
        if a.shape != b.shape:
            faults.append(f"{name}: shape {a.shape} and {b.shape}")
            continue
        apart = np.abs(a.astype(float) - b.astype(float))
        if name.startswith(("fields/", "nodes/", "points/")):
            apart = np.where(np.isnan(a.astype(float)) & np.isnan(b.astype(float)), 0, apart)
        gap = float(np.max(apart, initial=0))
        allowed = tolerance * scale[unit]
        if re.search("(s|time)²", unit):
            allowed = max(allowed, noise)
        if name.endswith("POWER"):
            allowed = max(allowed, noise_of_power)
        if name == "run/EVENTS":  # two within rounding of each other, as of what breaks away and slides
            allowed = 1
        if not gap <= allowed:  # also catches NaN
            faults.append(f"{name}: differs by {gap:.3g} {unit}, allowed {allowed:.3g}")
    return faults


class Case:
    """A deck, and what its comments ask for."""

    def __init__(self, deck: Path, work: Path) -> None:
        wanted = wishes(deck)
        self.deck = deck
        self.ranks = [int(n) for n in wanted.get("ranks", ["1", "2", "3"])]
        self.tolerance = float(wanted.get("tolerance", ["1e-6"])[0])
        self.is_short = "short" in wanted
        self.elsewhere = wanted.get("elsewhere", [""])[0]
        self.solved = shortened(deck, work, wanted["short"]) if self.is_short else deck  # on all ranks
        if self.elsewhere and deck.name not in (Path(__file__).parent / self.elsewhere).read_text("utf-8"):
            sys.exit(f"{self.elsewhere} does not run {deck.name}")

    def results(self, work: Path, ranks: int) -> Path:
        """Where a run of `solved` leaves them; tests/verify reads those of whole decks on one rank."""
        return folder_of(work, ranks) / f"{self.solved.stem}.h5"


def folder_of(work: Path, ranks: int) -> Path:
    return work / f"np{ranks}" if ranks > 1 else work


def shortened(deck: Path, work: Path, stepping: list[str]) -> Path:
    """The deck with another `.SUB` and without checks, which it would not reach."""
    text = deck.read_text(encoding="utf-8", errors="replace")
    end = re.search(r"^\.FIN", text, re.MULTILINE)
    head = text[: end.start()] if end else text
    short = work / "short" / f"{deck.stem}_short.dat"
    short.parent.mkdir(exist_ok=True)
    short.write_text(f"{head}.DEL.CHK\n.DEL.SUB\n.SUB {' '.join(stepping)}\n.FIN 1\n", encoding="utf-8")
    return short


def interrupted(arguments, deck: Path, whole: Read) -> list[str]:
    """What a run that was interrupted and continued has otherwise than the whole one."""
    times = whole.times
    if len(times) == 1:  # one equilibrium
        return []
    prefix = arguments.work / f"{deck.stem}_interrupted"
    for old in arguments.work.glob(f"{prefix.name}.*"):
        old.unlink()
    command = [arguments.binary, "-q", str(deck), "-o", str(prefix)]
    cut = [*command, "--until", repr(float(times[len(times) // 3]))]
    print("+", " ".join(cut), flush=True)
    status = subprocess.run(cut, check=False, stderr=subprocess.DEVNULL).returncode
    if status != 2:
        return [f"interrupted: exit status {status}"]
    status = subprocess.run(
        [*command, "--restart", str(prefix)], check=False, stdout=subprocess.DEVNULL
    ).returncode
    if status != 0:
        return [f"continued: exit status {status}"]
    one, other = whole.bytes, Read(prefix.with_name(prefix.name + ".h5")).bytes
    faults = [
        f"interrupted and continued: {name} is only in one" for name in sorted(one.keys() ^ other.keys())
    ]
    return faults + [
        f"interrupted and continued: {name} has other bits"
        for name in sorted(one.keys() & other.keys())
        if one[name] != other[name]
    ]


def changed(deck: Path, unique: set[str], results: dict, tolerance: float) -> list[str]:
    """Channels that version 0.3.0 had otherwise, by more than the tolerance times the largest of the unit.
    What is not unique is left out: it depends on the length that moments are compared with forces by."""
    owners = json.loads(REFERENCE.read_text(encoding="utf-8")).get(deck.stem, {})
    reference = {
        f"{owner}/{channel}": values or (0.0, 0.0)
        for owner, channels in owners.items()
        for channel, values in channels.items()
        if f"{owner}/{channel}" in unique
    }
    scale = {}
    for name, (last, rms) in reference.items():
        if name in results:
            unit = results[name][0]
            scale[unit] = max(scale.get(unit, 0.0), abs(last), abs(rms))
    faults = []
    for name, (last, rms) in reference.items():
        if name not in results:
            continue
        unit, values = results[name]
        gap = max(abs(values[-1] - last), abs(np.sqrt(np.mean(np.square(values))) - rms))
        # what is zero is so to the rounding of the largest numbers
        allowed = max(tolerance * scale[unit], 1e-14 * max(scale.values()))
        if re.search("(s|time)²", unit):
            allowed = max(allowed, float(results[""][1]))
        if not gap <= allowed:
            faults.append(f"{name}: differs from 0.3.0 by {gap:.3g} {unit}, allowed {allowed:.3g}")
    return faults


def run(arguments, decks: list[Path], ranks: int, until: float | None = None) -> None:
    """Solves decks one after the other in one process on each rank."""
    if not decks:
        return
    folder = folder_of(arguments.work, ranks)
    for deck in decks:
        for old in folder.glob(f"{deck.stem}.*"):
            old.unlink()
    part = [] if until is None else ["--until", repr(until)]
    command = [arguments.binary, *map(str, decks), "-o", f"{folder}/", *part]
    command = on_ranks(ranks, command, arguments.mpiexec)
    print("+", " ".join(command), flush=True)
    status = subprocess.run(command, check=False).returncode
    if status != (2 if part else 0):
        sys.exit(f"{', '.join(deck.name for deck in decks)} on {ranks} ranks: exit status {status}")


def compare(arguments, case: Case) -> bool:
    """Compares the results of a deck; runs it on 3 ranks if it is long, and from a restart."""
    first_ranks = case.ranks[0]
    whole = Read(case.results(arguments.work, first_ranks))
    first = whole.results()
    faults = interrupted(arguments, case.solved, whole) if first_ranks == 1 else []
    faults += changed(case.deck, whole.unique, first, case.tolerance) if not case.is_short else []
    for n in case.ranks[1:]:
        until = last_of(whole) if n > 2 else None
        if until is not None:
            run(arguments, [case.solved], n, until)
        one = first if until is None else whole.results(until)
        other = Read(case.results(arguments.work, n)).results()
        found = differences(one, other, case.tolerance)
        faults += [f"{n} ranks against {first_ranks}: {fault}" for fault in found]
    print(
        "\n".join(f"{case.deck.name}: {fault}" for fault in faults)
        or f"{case.deck.name}: ranks {case.ranks} agree in {len(first)} datasets and channels",
        flush=True,
    )
    return not faults


def last_of(whole: Read) -> float | None:
    """The last sample that is compared on 3 ranks; None: all are."""
    return float(whole.times[LONG - 1]) if len(whole.times) > LONG else None


def is_long(arguments, case: Case) -> bool:
    with Results(case.results(arguments.work, case.ranks[0])) as results:
        return len(results.times()) > LONG


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--binary", required=True)
    parser.add_argument("--mpiexec", required=True)
    parser.add_argument("--work", required=True, type=Path)
    parser.add_argument("decks", type=Path, nargs="+")
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)

    cases = [Case(deck, arguments.work) for deck in arguments.decks]
    whole = [case.deck for case in cases if case.is_short and not case.elsewhere]
    run(arguments, whole + [case.solved for case in cases if 1 in case.ranks], 1)
    for n in sorted({n for case in cases for n in case.ranks} - {1}):
        these = [case for case in cases if n in case.ranks]
        run(arguments, [case.solved for case in these if n == 2 or not is_long(arguments, case)], n)
    agree = [compare(arguments, case) for case in cases]
    return 0 if all(agree) else 1


if __name__ == "__main__":
    sys.exit(main())
