# SPDX-License-Identifier: BSD-3-Clause
"""`engrane inertia`: mass, centre and inertia tensor of a meshed part, and the words for a deck."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

from . import options
from .errors import UserError
from .mass_properties import MassProperties, of_mesh, read

EXAMPLES = """  engrane inertia part.stl --density 7850
  engrane inertia part.stl --density 7850 --scale 0.001        drawn in millimetres, wanted in metres
  engrane inertia part.msh --density 2700 -o part_inertia.dat  for INPUT "part_inertia" within a RIGID record
  engrane inertia part.stl --mass 2.5                          the mass is known, not the density"""


def add(commands: argparse._SubParsersAction) -> None:
    """Declares the command."""
    p = options.subcommand(
        commands,
        "inertia",
        "mass, centre and inertia of a part from its mesh",
        "Reads a closed surface (STL, PLY, OBJ …) or solid cells (Gmsh, Abaqus, VTK …) and integrates "
        "over the volume. Prints mass, centre of mass, tensor and principal axes, then the keywords M, CG, J "
        "for RIGID. A mesh with solid cells is taken by these, its surface is left out. Faces count as flat, "
        "quadratic cells by their corners.",
        EXAMPLES,
    )
    p.add_argument("mesh", help="any mesh that meshio reads")
    p.add_argument("--density", type=float, metavar="rho", help="mass per volume, in the units of the deck")
    p.add_argument("--mass", type=float, metavar="m", help="instead of the density")
    p.add_argument(
        "--scale", type=float, default=1.0, metavar="f", help="a mesh unit in deck units (default 1)"
    )
    p.add_argument(
        "--move", type=float, nargs=3, default=[0, 0, 0], metavar=("x", "y", "z"), help="added after --scale"
    )
    p.add_argument("-o", "--output", metavar="file.dat", help="write the keywords to a file for INPUT")
    p.set_defaults(run=run)


def run(args: argparse.Namespace) -> None:
    """Prints, and writes the file asked for."""
    if (args.density is None) == (args.mass is None):
        raise UserError("Give the density of the part, --density 7850, or its mass, --mass 2.5.")
    for word, value in (("--density", args.density), ("--mass", args.mass), ("--scale", args.scale)):
        if value is not None and not (value > 0 and np.isfinite(value)):
            raise UserError(f"{word} must be above 0.")
    points, cells = read(args.mesh)
    body = of_mesh(points * args.scale + np.array(args.move), cells, args.density or 1.0)
    if args.mass is not None:
        body.tensor *= args.mass / body.mass
        body.mass = args.mass
    for warning in body.warnings:
        print(f"engrane inertia: warning: {warning}", file=sys.stderr)
    print(report(body))
    if args.output:
        Path(args.output).write_text(card(body, Path(args.mesh).name), encoding="utf-8")
        print(f"wrote {args.output}")


def row(values: np.ndarray) -> str:
    """Numbers as a deck takes them, without the rounding of zeros."""
    values = np.asarray(values, float)
    small = 1e-13 * np.abs(values).max(initial=0)
    return " ".join(f"{0.0 if abs(v) <= small else v:.12g}" for v in np.ravel(values))


def card(body: MassProperties, name: str) -> str:
    """The keywords of RIGID; `$` joins the lines."""
    j = body.tensor
    six = [j[0, 0], j[1, 1], j[2, 2], j[0, 1], j[1, 2], j[2, 0]]
    return (
        f"! {name}: volume {body.volume:.12g}\n M {body.mass:.12g}  CG {row(body.center)} $\n J {row(six)}\n"
    )


def report(body: MassProperties) -> str:
    """For reading, and the record to paste."""
    values, axes = body.principal()
    lines = [
        f"volume   {body.volume:.9g}",
        f"mass     {body.mass:.9g}",
        f"centre   {row(body.center)}",
        "tensor about the centre, in the axes of the mesh",
        *(
            "         " + "".join(f"{0.0 if abs(v) < 1e-13 * values[2] else v:16.9g}" for v in r)
            for r in body.tensor
        ),
        "principal moments, each with its axis",
        *(f"         {v:16.9g}      {row(axes[:, i])}" for i, v in enumerate(values)),
        "",
        "for a deck, the body's nodes behind N:",
        f" I 1 RIGID N …  {card(body, '').splitlines()[1].strip()}",
        f"  {card(body, '').splitlines()[2].strip()}",
    ]
    return "\n".join(lines)
