# SPDX-License-Identifier: BSD-3-Clause
"""Holds every file to the house rules that a compiler does not see.

    layers.py [root]

Which layer may include which, and which foreign library, stands in src/CMakeLists.txt and nowhere else. The
rest: no code file over 600 lines, an SPDX line at the top of each, no path of somebody's machine, and no
layers that use each other in a circle.
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
    "PkgConfig::HDF5": re.compile(r"hdf5|H5"),
    "CLI11::CLI11": re.compile(r"CLI/"),
}
LAYER_LINE = re.compile(r"^engrane_layer\((\w+)([^)]*)\)", re.MULTILINE)
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


def main() -> int:
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    table = read_table((root / "src/CMakeLists.txt").read_text(encoding="utf-8"))
    faults = circular(table)
    for file in sorted((root / "src").rglob("*.[ch]pp")):
        faults += check_includes(file, root, table)
    for file in text_files(root):
        faults += check_text(file, root)
    print("\n".join(faults) or f"{len(table)} layers: every include, length and licence line is in order")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
