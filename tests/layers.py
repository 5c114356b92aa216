# SPDX-License-Identifier: BSD-3-Clause
"""Holds every file to the house rules that a compiler does not see.

    layers.py [root]
    layers.py --graph [root]    draws which room includes which, as a Mermaid graph (docs/adding.md)

Which layer and room may include which, and which foreign library, stands in src/CMakeLists.txt and nowhere
else. The rest: every file opens the namespace of its room, no room holds more than a fifth of the source, no
code file over 600 lines, an SPDX line at the top of each, no path of somebody's machine, and no circles.
"""

import re
import sys
from pathlib import Path

MOST_LINES = 600
CODE = {".cpp", ".hpp", ".h", ".py", ".cmake", ".f90", ".sh"}
TEXT = CODE | {".md", ".dat", ".txt", ".json", ".toml", ".yml", ""}
SKIPPED = {"build", ".git", "__pycache__"}
SPDX = "SPDX-License-Identifier: BSD-3-Clause"
MACHINE_PATH = re.compile(r"(?<![\w.$}>-])/(?:work|root|home)/")

# The headers of the foreign libraries that are confined to some layers, by the CMake target that brings them.
FOREIGN = {
    "PkgConfig::PETSC": re.compile(r"petsc|slepc"),
    "MPI::MPI_CXX": re.compile(r"mpi\.h$"),
    "KLU::KLU": re.compile(r"^klu\.h$"),
    "SPQR::SPQR": re.compile(r"^(SuiteSparseQR|cholmod)"),
    "PkgConfig::HDF5": re.compile(r"hdf5|H5"),
    "CLI11::CLI11": re.compile(r"CLI/"),
    "nlohmann_json::nlohmann_json": re.compile(r"nlohmann/"),
}
LAYER_LINE = re.compile(r"^engrane_layer\((\w+)([^)]*)\)", re.MULTILINE)
ROOM_LINE = re.compile(r"^engrane_room\((\w+)/(\w+)([^)]*)\)", re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]')


def read_table(cmake: str) -> dict[str, tuple[set[str], set[str]]]:
    """Layer -> (layers it may use, libraries it may use), from the engrane_layer() lines."""
    table = {}
    for name, arguments in LAYER_LINE.findall(cmake):
        lists = {"USES": set(), "WITH": set()}
        current = None
        for word in arguments.split():
            if word in lists:
                current = word
            else:
                lists[current].add(word)
        table[name] = (lists["USES"], lists["WITH"])
    return table


def read_rooms(cmake: str) -> dict[str, set[str]]:
    """Room, as layer/room -> rooms of its layer that it may include, from the engrane_room() lines."""
    return {
        f"{layer}/{room}": {f"{layer}/{word}" for word in words.split() if word != "USES"}
        for layer, room, words in ROOM_LINE.findall(cmake)
    }


def circular_rooms(rooms) -> list[str]:
    faults = []
    above = set()
    for name, uses in rooms.items():
        faults += [
            f"src/CMakeLists.txt: {name} uses {other}, which is not above it"
            for other in sorted(uses - above)
        ]
        above.add(name)
    return faults


def namespace_of(room: str) -> str:
    """base, math, model and assembly are the vocabulary of all others and share one namespace."""
    layer, _, folder = room.partition("/")
    if layer in {"base", "math", "model", "assembly"}:
        return "engrane"
    if layer == "elements" and folder != "common":
        return f"engrane::elements::{folder}"
    return f"engrane::{layer}"


def check_room(file: Path, root: Path, rooms) -> list[str]:
    """Directions between the rooms of a layer, and the namespace that a file opens."""
    name = file.relative_to(root)
    room = file.parent.relative_to(root / "src").as_posix()
    layer = room.split("/")[0]
    if any(other.startswith(f"{layer}/") for other in rooms) and room not in rooms:
        return [f"{name}: no room '{room}' in src/CMakeLists.txt; add an engrane_room line"]
    text = file.read_text(encoding="utf-8")
    faults = []
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        if not match or match.group(1) != '"':
            continue
        other = match.group(2).rsplit("/", 1)[0]
        if other != room and other in rooms and other.startswith(f"{layer}/") and other not in rooms[room]:
            faults.append(f"{name}:{number}: {room} may not include {match.group(2)}")
    opened = re.findall(r"^(?:inline )?namespace (engrane[\w:]*) \{", text, re.MULTILINE)
    expected = namespace_of(room)
    if opened and not all(o == expected or o.startswith(expected + "::") for o in opened):
        faults.append(f"{name}: opens namespace {opened[0]}; {room} is {expected}")
    return faults


def check_shares(root: Path) -> list[str]:
    """No room above a fifth of the source: then it is more than one room."""
    lines = {}
    for file in (root / "src").rglob("*"):
        if file.suffix in CODE:
            room = file.parent.relative_to(root / "src").as_posix()
            lines[room] = lines.get(room, 0) + len(file.read_text(encoding="utf-8").splitlines())
    total = sum(lines.values())
    return [
        f"src/{room} is {100 * n / total:.0f} % of the source; split it"
        for room, n in lines.items()
        if 5 * n > total
    ]


def circular(table) -> list[str]:
    """Each line of the table may name only layers that stand above it: so there is no circle."""
    faults = []
    above = set()
    for name, (uses, _) in table.items():
        faults += [
            f"src/CMakeLists.txt: {name} uses {other}, which is not above it"
            for other in sorted(uses - above)
        ]
        above.add(name)
    return faults


IMPORT = re.compile(r"^\s*from \.(\w*) import ([\w, ]+)|^\s*from engrane_post\.(\w+) import", re.MULTILINE)


def circular_modules(package: Path) -> list[str]:
    """Modules of a package that import each other in a circle, wherever in the file the import stands."""
    names = {file.stem for file in package.glob("*.py")}
    uses = {}
    for file in package.glob("*.py"):
        found = set()
        for module, words, absolute in IMPORT.findall(file.read_text(encoding="utf-8")):
            found |= {module or absolute} if module or absolute else {w.strip() for w in words.split(",")}
        uses[file.stem] = (found & names) - {file.stem}
    # take away what uses nothing that is left, until only circles are left
    while free := [name for name, others in uses.items() if not others]:
        for name in free:
            del uses[name]
        uses = {name: others - set(free) for name, others in uses.items()}
    return [
        f"{package.name}/{name}.py: in a circle of imports with {', '.join(sorted(others))}"
        for name, others in uses.items()
    ]


def check_includes(file: Path, root: Path, table) -> list[str]:
    layer = file.relative_to(root / "src").parts[0]
    if layer not in table:
        return [
            f"{file.relative_to(root)}: no layer '{layer}' in src/CMakeLists.txt; add an engrane_layer line"
        ]
    uses, libraries = table[layer]
    faults = []
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quote, header = match.groups()
        where = f"{file.relative_to(root)}:{number}"
        if quote == '"':
            other = header.split("/")[0]
            if not (root / "src" / header).is_file():
                faults.append(f'{where}: "{header}" is no file under src/; name it as "layer/file.hpp"')
            elif other != layer and other not in uses:
                may = " ".join(sorted(uses)) or "nothing"
                faults.append(f"{where}: {layer} may not include {header}; it may use: {may}")
        else:
            for target, pattern in FOREIGN.items():
                if pattern.match(header) and target not in libraries:
                    faults.append(f"{where}: {layer} may not include <{header}> ({target})")
    return faults


def check_text(file: Path, root: Path) -> list[str]:
    name = file.relative_to(root)
    try:
        lines = file.read_text(encoding="utf-8").splitlines()
    except UnicodeDecodeError:
        return []
    faults = [
        f"{name}:{n}: a path of one machine" for n, line in enumerate(lines, 1) if MACHINE_PATH.search(line)
    ]
    is_code = (
        file.suffix in CODE or file.name == "CMakeLists.txt" or bool(lines and lines[0].startswith("#!"))
    )
    if is_code and not any(SPDX in line for line in lines[:2]):
        faults.append(f"{name}:1: the file does not begin with '{SPDX}'")
    if is_code and len(lines) > MOST_LINES:
        faults.append(f"{name}: {len(lines)} lines; split it by physics before it passes {MOST_LINES}")
    return faults


def text_files(root: Path):
    for entry in sorted(root.iterdir()):
        if entry.name in SKIPPED or entry.name.endswith(".egg-info") or entry.name.endswith("_cache"):
            continue
        if entry.is_dir():
            yield from text_files(entry)
        elif entry.suffix in TEXT:
            yield entry


def graph(root: Path) -> str:
    """Rooms and their includes, without arrows that follow from others."""
    uses: dict[str, set[str]] = {}
    for file in sorted((root / "src").rglob("*.[ch]pp")):
        room = file.parent.relative_to(root / "src").as_posix()
        others = {
            m.group(2).rsplit("/", 1)[0]
            for m in map(INCLUDE.match, file.read_text(encoding="utf-8").splitlines())
            if m
        }
        uses.setdefault(room, set()).update(
            o for o in others if o != room and (root / "src" / o).is_dir() and o
        )

    def reached(room: str, seen: set[str]) -> set[str]:
        for other in uses.get(room, set()) - seen:
            seen.add(other)
            reached(other, seen)
        return seen

    lines = ["graph BT"]
    for room, direct in sorted(uses.items()):
        further = set().union(*(reached(other, set()) for other in direct)) if direct else set()
        lines += [
            f'  {room.replace("/", "_")}["{room}"] --> {other.replace("/", "_")}["{other}"]'
            for other in sorted(direct - further)
        ]
    return "\n".join(lines)


def main() -> int:
    if sys.argv[1:2] == ["--graph"]:
        print(graph(Path(sys.argv[2] if len(sys.argv) > 2 else Path(__file__).parent.parent).resolve()))
        return 0
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    cmake = (root / "src/CMakeLists.txt").read_text(encoding="utf-8")
    table, rooms = read_table(cmake), read_rooms(cmake)
    faults = circular(table) + circular_rooms(rooms) + check_shares(root)
    faults += circular_modules(root / "post/engrane_post")
    for file in sorted((root / "src").rglob("*.[ch]pp")):
        faults += check_includes(file, root, table) + check_room(file, root, rooms)
    for file in text_files(root):
        faults += check_text(file, root)
    print(
        "\n".join(faults)
        or f"{len(table)} layers, {len(rooms)} rooms: every include, length and licence line is in order"
    )
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
