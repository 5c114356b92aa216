# SPDX-License-Identifier: BSD-3-Clause
"""`engrane gallery`: runs the decks of docs/gallery.md and draws their pictures anew."""

from __future__ import annotations

import argparse
import subprocess
from dataclasses import dataclass
from pathlib import Path

from . import options
from .errors import UserError
from .program import ROOT, find_program

SIZE = "900x640"
EXAMPLES = """  engrane gallery                        all pictures, into docs/figures/gallery
  engrane gallery worm_drive             one of them
  engrane gallery -o pictures"""


@dataclass(frozen=True)
class Shot:
    """One picture: its deck below decks/trains or another folder, from where to look, when (default: the
    end), and the field of cells that colours them."""

    deck: str
    view: str
    zoom: float = 1.0
    folder: str = "trains"
    up: str | None = None
    time: float | None = None
    field: str = ""
    deformed: float = 1.0  # displacements so many times as large


SHOTS = (
    Shot("idler", "0.45,0.4,1"),
    Shot("two_stage_reducer", "-0.75,0.75,0.9"),
    Shot("planetary_3_ring_held", "-0.5,0.35,-1"),
    Shot("planetary_4_carrier_held", "0.4,0.3,1"),
    Shot("planetary_5_sun_held", "0.4,0.3,1"),
    Shot("planetary_load_sharing", "-0.5,0.35,-1"),
    Shot("ravigneaux_first", "0.2,0.3,-1"),
    Shot("bevel_differential", "-1,0.8,0.5"),
    Shot("hypoid_axle", "-1,0.6,0.8"),
    Shot("worm_drive", "0.5,1,0.6"),
    Shot("rack_steering", "0.1,-0.6,1", 1.05),
    Shot("wind_turbine", "1,0.55,0.6", 1.1),
    Shot("run_up_elastic", "0.45,0.4,1"),
    Shot("four_bar", "0.25,0.15,1", 1.0, "mechanisms", "y", 0.3),
    Shot("quick_return", "0.3,0.2,1", 1.0, "mechanisms", "y", 0.2),
    Shot("slider_crank", "0.5,-0.7,1", 1.0, "mechanisms", "z", 0.1),
    Shot("andrews_squeezer", "0.25,0.15,1", 1.0, "mechanisms", "y", 0.01),
    Shot("stewart_platform", "1,-0.6,0.45", 1.0, "mechanisms", "z", 0.35),
    Shot("cable_robot", "0.6,-1,0.35", 1.0, "mechanisms", "z", 0.8),
    Shot("double_wishbone", "1,0.35,0.25", 1.0, "mechanisms", "z", 0.25),
    Shot("universal_differential", "0.4,1,0.6", 1.05, "mechanisms", "z", 0.6),
    Shot("meshed_gear", "0.2,0.3,1", 1.1, "mechanisms", "y", None, "VON_MISES", 300),
    Shot("geared_shafts", "1,0.6,0.7", 1.0, "mechanisms", "y", None, "", 1000),
    Shot("overhung_pinion", "-0.9,0.5,-0.3", 1.0, "mechanisms", "y", None, "", 200),
    Shot("mylar_balloon", "1,0.7,0.8", 1.0, "mechanisms", "z"),
    Shot("square_sail", "-0.8,1,0.25", 1.0, "mechanisms", "z"),
    Shot("falling_cloth", "-1,1.4,0.5", 1.0, "mechanisms", "z", 0.35, "TAUTNESS"),
    Shot("inflating_cushion", "1,0.7,0.5", 1.0, "mechanisms", "z", 0.5, "TAUTNESS"),
    Shot("lee_frame", "0.25,0.15,1", 1.0, "mechanisms", "y"),
    Shot("portal_frame", "0.25,0.15,1", 1.0, "mechanisms", "y"),
    Shot("turbine_shaft", "1,0.6,0.7", 1.0, "mechanisms", "y", None, "", 20),
)


def add(commands: argparse._SubParsersAction) -> None:
    """Declares the command."""
    p = options.subcommand(
        commands,
        "gallery",
        "pictures of gear trains and mechanisms",
        "Runs the decks of docs/gallery.md whose results are missing or older than deck or "
        "program, and draws them.",
        EXAMPLES,
    )
    p.add_argument("decks", nargs="*", metavar="deck", help="names without .dat (default: all)")
    p.add_argument(
        "--results", default=str(ROOT / "build" / "gallery"), metavar="folder", help="where runs go"
    )
    p.add_argument(
        "-o",
        "--output",
        default=str(ROOT / "docs" / "figures" / "gallery"),
        metavar="folder",
        help="where pictures go",
    )
    p.set_defaults(run=run)


def run(args: argparse.Namespace) -> None:
    """Runs what must be run and draws."""
    known = {s.deck: s for s in SHOTS}
    for name in args.decks:
        if name not in known:
            raise UserError(f"The gallery has no {name}; it has {', '.join(known)}.")
    results, output = Path(args.results), Path(args.output)
    results.mkdir(parents=True, exist_ok=True)
    output.mkdir(parents=True, exist_ok=True)
    for shot in [known[n] for n in args.decks] or SHOTS:
        draw(shot, result_of(shot, results), output / f"{shot.deck}.png")


def result_of(shot: Shot, folder: Path) -> Path:
    """The deck's result, computed anew when it is missing or old."""
    deck = ROOT / "decks" / shot.folder / f"{shot.deck}.dat"
    program = find_program()
    if not deck.is_file():
        raise UserError(f"The gallery needs engrane's source tree; there is no {deck}.")
    result = folder / f"{shot.deck}.h5"
    made = [p.stat().st_mtime for p in (program, *deck.parent.glob("*.dat"))]
    if not result.is_file() or result.stat().st_mtime < max(made):
        print(f"running {deck.name}", flush=True)
        done = subprocess.run([program, deck, "-o", result.with_suffix("")], capture_output=True, text=True)
        if done.returncode != 0:
            raise UserError(f"{deck.name} failed with status {done.returncode}:\n{done.stderr.strip()}")
    return result


def draw(shot: Shot, result: Path, path: Path) -> None:
    """Draws one result with few colours, which makes a small file."""
    from PIL import Image

    from .picture import enlarged, picture
    from .results import Results

    with Results(result) as r:
        frame = r.frame(-1) if shot.time is None else r.frame_at(shot.time)
        frames = [enlarged(frame, shot.deformed)]
        picture(
            r, frames, str(path), SIZE, shot.view, shot.zoom, "", bare=True, upward=shot.up, field=shot.field
        )
    with Image.open(path) as image:
        few = image.convert("RGB").quantize(
            256, method=Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE
        )
    few.save(path, optimize=True)
    print(f"wrote {path}")
