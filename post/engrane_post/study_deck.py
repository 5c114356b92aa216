# SPDX-License-Identifier: BSD-3-Clause
"""Cards of a deck with other schemes, steps and solvers, for `engrane study`.

What is changed are the cards as the program itself writes them out into its results (`/deck` of
docs/format.md): one spelling, numbers in the place of abbreviations. They are handed to the program by
`--card`; the deck's text is neither read nor changed here."""

from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass, field
from typing import Any

from .errors import UserError

#: keywords of .SAM that a setting speaks of, each with one value
SETTING = ("SCHEME", "RHO", "ALPHA", "TANGENT", "SOLVER")
#: keyword of .SAM by which the program chooses scheme, steps and solver; it goes where a setting is given
ACCURACY = "ACCURACY"
DAMPING = ("RHO", "ALPHA")
#: keywords of .SUB about steps that the program chooses; they go where steps are given
CHOSEN_STEPS = ("TOL", "HMAX")
#: what .SAI selects; the other keywords are about rates
SELECTION = ("ELEMENT", "TYPE", "NOEUD", "GROUP", "CHANNEL", "KEEP")
MOST_RUNGS = 40


@dataclass(frozen=True)
class Card:
    """A card as the program writes it out: its keywords, each with its values, in order."""

    name: str
    items: tuple[tuple[str, tuple[str, ...]], ...] = ()

    def get(self, keyword: str) -> str | None:
        """The first value of a keyword that was given."""
        return next((values[0] for word, values in self.items if word == keyword and values), None)

    def without(self, *keywords: str) -> Card:
        return Card(self.name, tuple(item for item in self.items if item[0] not in keywords))

    def only(self, *keywords: str) -> Card:
        return Card(self.name, tuple(item for item in self.items if item[0] in keywords))

    def replaced(self, **values: str) -> Card:
        """With other values: where the keyword stands, else at the end."""
        items = [(word, (values.pop(word),) if word in values else old) for word, old in self.items]
        return Card(self.name, (*items, *((word, (value,)) for word, value in values.items())))

    @property
    def text(self) -> str:
        return " ".join([self.name, *(w for word, values in self.items for w in (word, *values))])


#: what the program says of its cards: by card and keyword, as `engrane schema` prints it
Schema = dict[str, dict[str, dict[str, Any]]]


def schema_of(text: str) -> Schema:
    """The cards that a study changes, from what `engrane schema` prints."""
    cards = json.loads(text)["$defs"]
    return {
        name: {word: said for word, said in cards[name]["properties"].items() if word.isupper()}
        for name in (".SAM", ".SUB", ".SAI")
    }


def read_card(deck_text: str, name: str, schema: Schema) -> Card | None:
    """A card from the text that the program wrote, of all its records; None when the deck has none."""
    cards: list[str] = []
    inside = False
    for line in deck_text.splitlines():
        if line.startswith("."):
            inside = line.split(" ")[0] == name
            if inside:
                cards.append(line.removesuffix(" $"))
        elif inside and not line.lstrip().startswith("!"):
            cards[-1] += " " + line.removesuffix(" $")
    if not cards:
        return None
    items: dict[str, tuple[str, ...]] = {}
    for words in cards:
        for word, values in _items(words, schema[name]):
            known = items.get(word, ())
            items[word] = known if known == values else known + values
    return Card(name, tuple(items.items()))


def read_defaults(deck_text: str, name: str, schema: Schema) -> Card:
    """What the program chose where the card says nothing: the comments `! by default:` below it."""
    words: list[str] = [name]
    inside = listed = False
    for line in deck_text.splitlines():
        bare = line.lstrip()
        if line.startswith("."):
            inside, listed = line.split(" ")[0] == name, False
        elif inside and bare.startswith("!"):
            listed = listed or bare.startswith("! by default:")
            if listed:
                words.append(bare.removeprefix("!").strip().removeprefix("by default:"))
        else:
            listed = False
    return Card(name, tuple(_items(" ".join(words), schema[name])))


def _items(words: str, keywords: dict) -> list[tuple[str, tuple[str, ...]]]:
    """Keywords of a card with their values."""
    items: list[tuple[str, list[str]]] = []
    for word in re.findall(r'"[^"]*"|\S+', words)[1:]:
        # a keyword may be a value too: behind one that must have a value and has none yet
        waiting = bool(items) and not items[-1][1] and keywords[items[-1][0]].get("type") != "boolean"
        if word in keywords and not waiting:
            items.append((word, []))
        elif items:
            items[-1][1].append(word)
    return [(word, tuple(values)) for word, values in items]


@dataclass(frozen=True)
class Rung:
    """One run of a ladder: what stands in .SUB, and the number that gets smaller from rung to rung."""

    sub: dict[str, str]
    size: float

    @property
    def title(self) -> str:
        return " ".join(f"{word} {value}" for word, value in self.sub.items()) or "chosen"


@dataclass(frozen=True)
class Ladder:
    """A setting of .SAM and the steps or tolerances it is tried with, the coarsest first."""

    title: str
    sam: dict[str, str]
    rungs: list[Rung] = field(default_factory=list)

    @property
    def scheme(self) -> str:
        return self.sam["SCHEME"]


def steps_ladder(title: str, sam: dict[str, str], steps: list[float]) -> Ladder:
    """A ladder of steps H."""
    return Ladder(title, sam, [Rung({"H": number(h)}, h) for h in sorted(steps, reverse=True)])


def tolerances_ladder(title: str, sam: dict[str, str], sample: float, tolerances: list[float]) -> Ladder:
    """A ladder of tolerances of the local error: the program chooses its steps, and H is between samples."""
    rungs = [Rung({"H": number(sample), "TOL": number(t)}, t) for t in sorted(tolerances, reverse=True)]
    return Ladder(title, sam, rungs)


def number(value: float) -> str:
    """As short as it can be and still be the same number when it is read again."""
    text = f"{value:.12g}"
    return text if float(text) == value else repr(value)


def setting_of(text: str) -> dict[str, str]:
    """Keywords and values of `CHUNG TANGENT KEPT` or `SCHEME CHUNG TANGENT KEPT`."""
    words = text.upper().split()
    if words[:1] == ["SCHEME"]:
        words = words[1:]
    if not words or len(words) % 2 == 0:
        raise UserError(
            f"--schemes: `{text}` is not a scheme and keywords of .SAM, such as CHUNG TANGENT KEPT."
        )
    pairs = dict(zip(words[1::2], words[2::2], strict=True))
    wrong = [word for word in pairs if word in ("TYPE", "SOLVER", "SCHEME", ACCURACY, "EXACTITUDE")]
    if wrong:
        raise UserError(
            f"--schemes: {wrong[0]} is no part of a setting"
            + ("; name solvers by --solvers." if "SOLVER" in wrong else ".")
        )
    return {"SCHEME": words[0], **pairs}


def steps_of(text: str, step: float) -> list[float]:
    """Steps from `1e-4,5e-5`, `4H,2H,H,H/2` or `8H:H/4`, a range by halves. H is the deck's step."""
    out: list[float] = []
    for part in text.split(","):
        ends = [_one_step(word, text, step) for word in part.split(":")]
        if len(ends) > 2:
            raise UserError(f"--steps {text}: a range is from:to, the longest step and the shortest.")
        if len(ends) == 2:
            longest, shortest = max(ends), min(ends)
            count = int(math.log2(longest / shortest) + 1e-9) + 1
            ends = [longest / 2**i for i in range(count)]
        out += ends
    out = sorted(set(out), reverse=True)
    if len(out) > MOST_RUNGS:
        raise UserError(f"--steps {text} are {len(out)} steps; {MOST_RUNGS} are the most.")
    return out


def _one_step(word: str, text: str, step: float) -> float:
    found = re.fullmatch(r"\s*([0-9.]*(?:[eEdD][-+]?\d+)?)\s*\*?\s*(H(?:\s*/\s*([0-9.]+))?)?\s*", word, re.I)
    try:
        factor = float(re.sub("[dD]", "e", found[1])) if found[1] else 1.0
        size = factor * (step / float(found[3] or 1) if found[2] else 1.0)
    except (TypeError, ValueError, ZeroDivisionError):
        size = 0.0
    if found and not found[1] and not found[2]:
        size = 0.0
    if not 0 < size < math.inf:
        raise UserError(
            f"--steps {text}: `{word}` is not a step such as 1e-4, 4H or H/2, H that of the deck."
        )
    return size


def usual_steps(scheme: str, step: float, span: float) -> list[float]:
    """Steps around that of the deck, longer ones for Radau IIA; none above an eighth of the time span."""
    most, least = (6, 0) if scheme == "RADAU" else (3, -2)
    steps = [step * 2.0**k for k in range(most, least - 1, -1)]
    return [h for h in steps if h <= span / 8 * (1 + 1e-9)] or [steps[-1]]


def sample_interval(steps: list[float], span: float) -> float:
    """The shortest time that is a multiple of all steps: all runs have samples at the same instants."""
    longest = max(steps)
    for multiple in range(1, 1001):
        interval = multiple * longest
        if interval > span / 2 * (1 + 1e-9):
            break
        if all(abs(interval / h - round(interval / h)) < 1e-6 for h in steps):
            return interval
    raise UserError(
        "the runs would have no samples at the same instants: take steps that divide one another, "
        "each shorter than half of the time from TI to TF, such as --steps 8H:H/4."
    )


class Deck:
    """The cards of a deck that a study changes."""

    def __init__(self, text: str, schema: Schema) -> None:
        self.sam = read_card(text, ".SAM", schema) or Card(".SAM")
        self.chosen = read_defaults(text, ".SAM", schema)
        self.sub = read_card(text, ".SUB", schema) or Card(".SUB", (("TF", ("1",)), ("H", ("0.1",))))
        self.sai = read_card(text, ".SAI", schema) or Card(".SAI")

    @property
    def analysis(self) -> str:
        return self.sam.get("TYPE") or "STATIC"

    @property
    def scheme(self) -> str:
        return self.sam.get("SCHEME") or self.chosen.get("SCHEME") or "CHUNG"

    @property
    def solver(self) -> str:
        return self.sam.get("SOLVER") or self.chosen.get("SOLVER") or "MUMPS"

    @property
    def accuracy(self) -> str:
        """`ACCURACY NORMAL`; empty for a deck that sets its steps itself."""
        value = self.sam.get(ACCURACY)
        return f"{ACCURACY} {value}" if value else ""

    @property
    def step(self) -> float:
        return float(self.sub.get("H"))

    @property
    def start(self) -> float:
        return float(self.sub.get("TI") or 0)

    @property
    def end(self) -> float:
        return float(self.sub.get("TF"))

    @property
    def span(self) -> float:
        return self.end - self.start

    @property
    def setting(self) -> str:
        """The deck's scheme with its keywords, as --schemes takes them."""
        given = [(word, self.sam.get(word)) for word in SETTING[1:-1] if self.sam.get(word)]
        return " ".join([self.scheme, *(f"{word} {value}" for word, value in given)])

    @property
    def title(self) -> str:
        """What the deck itself says of scheme and accuracy."""
        if not self.accuracy:
            return self.setting
        says = any(self.sam.get(word) for word in SETTING[:-1])
        return f"{self.setting} {self.accuracy}" if says else self.accuracy

    def own(self) -> Ladder:
        """What the deck says, as a ladder of one run. With ACCURACY, H is no step."""
        words = ("TOL",) if self.accuracy else ("H", "TOL")
        rung = {word: self.sub.get(word) for word in words if self.sub.get(word)}
        return Ladder(f"the deck: {self.title}", {"SCHEME": self.scheme}, [Rung(rung, self.step)])

    def own_sam_card(self, solver: str) -> Card:
        """The deck's .SAM as it is, but for the solver."""
        return self.sam if solver == self.solver else self.sam.replaced(SOLVER=solver)

    def own_sai_card(self, sample: float, keep: str | None) -> Card:
        """Where the deck is run as it is. ACCURACY judges what is kept, at the instants where it is kept: it
        stays so as far as samples at these intervals allow."""
        if not self.accuracy:
            return self.sai_card(sample, keep)
        chosen = Card(".SAI", (("KEEP", (keep,)),)) if keep == "ALL" else self.sai.only(*SELECTION)
        history = self.sai.only("HISTORY")
        multiple = sample / self.step
        if keep != "NONE" and (history.items or abs(multiple - round(multiple)) > 1e-6 or multiple < 0.5):
            history = Card(".SAI", (("HISTORY", ("DT", number(sample))),))
        return Card(".SAI", (("FIELDS", ("DT", number(self.span))), *history.items, *chosen.items))

    def sam_card(self, setting: dict[str, str], solver: str) -> Card:
        """The deck's .SAM with another setting. Damping stays where the scheme does. ACCURACY goes, since
        with it H is no step; the plane that it chose stays, which changes costs and not errors."""
        kept = [
            w for w in DAMPING if setting["SCHEME"] == self.scheme and w not in setting and self.sam.get(w)
        ]
        words = {"SCHEME": setting["SCHEME"]} | {w: self.sam.get(w) for w in kept}
        words |= {w: v for w, v in setting.items() if not (w == "TANGENT" and v == "FULL")}
        if solver != "MUMPS" or self.sam.get("SOLVER"):
            words["SOLVER"] = solver
        plane = self.chosen.get("PLANE")
        if self.accuracy and plane and not self.sam.get("PLANE"):
            words.setdefault("PLANE", plane)
        rest = self.sam.without(*SETTING, ACCURACY, *words)
        first = [("TYPE", ("DYNAMIC",)), *((w, (v,)) for w, v in words.items())]
        return Card(".SAM", (*first, *rest.without("TYPE").items))

    def sub_card(self, rung: Rung) -> Card:
        """The deck's .SUB with other steps."""
        return self.sub.without(*(() if "TOL" in rung.sub else CHOSEN_STEPS)).replaced(**rung.sub)

    def sai_card(self, sample: float, keep: str | None) -> Card:
        """Samples at these intervals, of what the deck selects or, by KEEP, of all or nothing; no fields."""
        chosen = Card(".SAI", (("KEEP", (keep,)),)) if keep else self.sai.only(*SELECTION)
        rates = (("FIELDS", ("DT", number(self.span))), ("HISTORY", ("DT", number(sample))))
        return Card(".SAI", (*rates, *chosen.items))

    @property
    def selects_histories(self) -> bool:
        return bool(self.sai.only(*SELECTION).items)
