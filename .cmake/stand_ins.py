# SPDX-License-Identifier: BSD-3-Clause
"""Writes libraries that stand in for those that PETSc and HDF5 are linked with and engrane never calls.

    stand_ins.py --compiler cc --folder lib --users libpetsc.so libhdf5.so --names libHYPRE libcurl

Debian's PETSc and HDF5 load a hundred libraries, of which preconditioners, network and encryption are
never called; loading them takes a third of the time of a short run. A stand-in has the name and version of
the library and a function of each name that the users take from it, which ends the program with a message;
data that is zero at the start is zero. A library with other data that its users look at gets none. Prints
the paths of what it wrote."""

import argparse
import re
import subprocess
from pathlib import Path


def symbols(library: str, *options: str) -> list[tuple[str, str, int]]:
    """Name with version, kind and size of a library's dynamic symbols."""
    command = ["nm", "-D", "-P", *options, library]  # name, kind, value and size
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    words = [[*line.split(), "0", "0"] for line in lines if line.strip()]
    return [(w[0].replace("@@", "@"), w[1], int(w[3], 16)) for w in words]


def loaded(users: list[str]) -> dict[str, str]:
    """Path of each library that the users load, by its name."""
    found = {}
    for user in users:
        lines = subprocess.run(["ldd", user], capture_output=True, text=True, check=True).stdout
        found.update(re.findall(r"^\s*(\S+) => (\S+)", lines, re.MULTILINE))
    return found


def source(needed: dict[str, tuple[str, int]]) -> str:
    text = "void _exit(int);\nlong write(int, const void *, unsigned long);\n"
    for i, (name, (kind, size)) in enumerate(needed.items()):
        if kind in "BC":
            text += f'_Alignas(64) char stand_in_{i}[{max(size, 1)}] __asm__("{name}");\n'
            continue
        words = f"engrane: {name}() is of a library that engrane is built without (ENGRANE_STAND_INS)\\n"
        text += f'void stand_in_{i}(void) __asm__("{name}");\n'
        text += f'void stand_in_{i}(void) {{ write(2, "{words}", {len(words) - 1}); _exit(3); }}\n'
    return text


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--compiler", required=True)
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--users", nargs="+", required=True)
    parser.add_argument("--names", nargs="+", required=True)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    wanted = {name for user in options.users for name, *_ in symbols(user, "--undefined-only")}
    for name, path in sorted(loaded(options.users).items()):
        if not any(name.startswith(f"{stem}.so") or name.startswith(f"{stem}-") for stem in options.names):
            continue
        defined = {known: (kind, size) for known, kind, size in symbols(path, "--defined-only")}
        plain = {known.split("@")[0]: of for known, of in defined.items()}
        needed = sorted(w for w in wanted if w in defined or ("@" not in w and w in plain))
        if any(plain[n.split("@")[0]][0] not in "TWiBC" for n in needed):
            continue
        versions: dict[str, list[str]] = {}
        for symbol in needed:
            bare, _, version = symbol.partition("@")
            versions.setdefault(version, []).append(bare)
        code = options.folder / "stand_in.c"
        code.write_text(source({n.split("@")[0]: plain[n.split("@")[0]] for n in needed}))
        script = options.folder / "stand_in.map"
        script.write_text("".join(f"{v} {{ global: {'; '.join(n)}; }};\n" for v, n in versions.items() if v))
        command = [
            options.compiler,
            "-shared",
            "-fPIC",
            "-O1",
            "-w",
            "-x",
            "c",
            str(code),
            f"-Wl,-soname,{name}",
        ]
        if script.stat().st_size:
            command.append(f"-Wl,--version-script,{script}")
        subprocess.run([*command, "-o", str(options.folder / name)], check=True)
        print(options.folder / name)
    for rest in ("stand_in.c", "stand_in.map"):
        (options.folder / rest).unlink(missing_ok=True)


if __name__ == "__main__":
    main()
