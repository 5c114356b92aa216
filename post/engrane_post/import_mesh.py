# SPDX-License-Identifier: BSD-3-Clause
"""`engrane import`: a mesh of another program as a deck."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

from . import cell_mesh, deck_mesh, mesh_files, mesh_h5, options
from .errors import UserError

EXAMPLES = """  engrane import wheel.msh                       wheel.dat: nodes, cells, groups, other cards
  engrane import wheel.med --list                what the mesh has; writes nothing
  engrane import wheel.inp --scale 0.001         drawn in millimetres, wanted in metres
  engrane import wheel.msh --binary              wheel.mesh.h5, and wheel.dat, which names it
  engrane import wheel.msh -o wheel.mesh.h5      the mesh alone: a deck that names it stays as it is
  engrane import sail.msh --as membranes         a surface in space as a skin that does not bend
  engrane import parts.unv --merge 1e-6          nodes at one place become one"""


def add(commands: argparse._SubParsersAction) -> None:
    """Declares the command."""
    p = options.subcommand(
        commands,
        "import",
        "a mesh of another program as a deck",
        "Reads a mesh (Gmsh .msh, Abaqus .inp, MED .med, VTK .vtk .vtu, universal files .unv, Nastran .bdf, "
        "and whatever else meshio reads) and writes a deck with its nodes, cells and groups. Groups of "
        "faces of solids, or of edges of plane cells, become groups of FACES and of nodes. Below them stand, "
        "as comments, the cards that a mesh does not have: materials, supports, loads. Large meshes are read "
        'in less time from a file of HDF5, which the deck names: .MAI FILE "wheel.mesh.h5".',
        EXAMPLES,
    )
    p.add_argument("mesh", help="file of the mesh")
    p.add_argument(
        "-o",
        "--output",
        metavar="file",
        help="deck to write (default: name of the mesh, .dat), or with the ending .mesh.h5 the mesh alone",
    )
    p.add_argument(
        "--binary",
        action="store_true",
        help="put nodes, cells and groups into a .mesh.h5 beside the deck",
    )
    p.add_argument("--list", action="store_true", help="say what cells and groups there are, write nothing")
    p.add_argument(
        "--scale", type=float, default=1.0, metavar="f", help="a mesh unit in deck units (default 1)"
    )
    p.add_argument(
        "--merge",
        type=float,
        metavar="tol",
        help="nodes nearer to each other than this part of the mesh's size become one, such as 1e-6",
    )
    p.add_argument(
        "--as",
        dest="formulation",
        choices=("membranes",),
        help="what triangles and quadrilaterals without solids become, instead of plane cells",
    )
    p.add_argument("--force", action="store_true", help="write over a file that exists")
    p.set_defaults(run=run)


def run(args: argparse.Namespace) -> None:
    """Writes the deck."""
    if not (args.scale > 0 and np.isfinite(args.scale)):
        raise UserError("--scale must be above 0.")
    if args.merge is not None and not 0 < args.merge < 1:
        raise UserError("--merge must lie between 0 and 1; 1e-6 is a millionth of the mesh's size.")
    deck, binary = outputs(args)
    mesh = cell_mesh.of_file(mesh_files.read(args.mesh), args.scale, args.merge, bool(args.formulation))
    for note in mesh.notes:
        print(f"engrane import: warning: {args.mesh}: {note}", file=sys.stderr)
    found = deck_mesh.summary(mesh)
    title = Path(args.mesh).stem.replace('"', "'")
    source = f"mesh of {Path(args.mesh).name}"
    if binary:
        with options.whole_file(binary) as part:
            mesh_h5.write(part, mesh, source)
    if deck:
        with options.whole_file(deck) as part, part.open("w", encoding="utf-8") as file:
            deck_mesh.write(file, mesh, title, source, binary.name if binary else None)
    written = [str(path) for path in (deck, binary) if path]
    first = f"wrote {' and '.join(written)}" if written else f"{args.mesh}:"
    print("\n  ".join([first, *found]))


def outputs(args: argparse.Namespace) -> tuple[Path | None, Path | None]:
    """The deck and the file of HDF5 to write, None for neither; refuses what exists."""
    if args.list:
        return None, None
    name = options.check_output(args.output or Path(args.mesh).stem + ".dat", (".dat", mesh_h5.SUFFIX))
    deck, binary = Path(name), None
    if name.endswith(mesh_h5.SUFFIX):
        deck, binary = None, Path(name)
    elif args.binary:
        binary = Path(name.removesuffix(".dat") + mesh_h5.SUFFIX)
    for path in (deck, binary):
        if path and path.exists() and not args.force:
            raise UserError(f"{path} exists; --force writes over it, -o names another file.")
    return deck, binary
