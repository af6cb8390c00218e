"""The deck of a run as Python sees it: directives and their values, the overrides last.

>>> deck = Deck("collector distance 16.d0  # cm\\nexternal potential 9 kV\\nprint list t x\\nfinish", ["collector distance 20 mm"])
>>> deck["print list"], round(deck.number("external potential", "kV"), 6), deck.number("collector distance", "cm")
('t x', 9.0, 2.0)
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Optional

from . import units

LISTS = ("print list", "printstat list")
#: of bare numbers under `units real`, where they are not those of CGS (core/deck/directives.cpp)
REAL_UNITS = {"density charge": "C/L", "external potential": "V"}
#: each says how long an element is: one that is set takes the place of the other
ELEMENTS = ("points", "resolution")


def directive(line: str) -> Optional[tuple[str, str]]:
    """Name and value of a line; None for comments, blank lines and `finish`.

    A value begins at the first number, else it is the last word.
    """
    original = re.split(r"[#!]", line)[0].replace("=", " ").split()
    words = [word.lower() for word in original]
    if len(words) < 2:
        return None
    for name in LISTS:
        if words[:2] == name.split():
            return name, " ".join(words[2:])
    at = next((k for k, word in enumerate(words) if k and re.match(r"[-+.]?\d", word)), len(words) - 1)
    return " ".join(words[:at]), " ".join(original[at:])


class Deck(Mapping):
    """Directives by name, in lower case; values as written. `text` is the deck itself, `overrides` the --set lines."""

    def __init__(self, text: str, overrides: Sequence[str] = (), name: str = "") -> None:
        self.text, self.overrides, self.name = text, list(overrides), name
        self._values = dict(found for found in map(directive, text.splitlines()) if found)
        for name, value in filter(None, map(directive, self.overrides)):
            if name in ELEMENTS:
                self._values.pop(ELEMENTS[1 - ELEMENTS.index(name)], None)
            self._values[name] = value

    def __getitem__(self, name: str) -> str:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return f"Deck({self.name!r}, {len(self)} directives)"

    def number(self, name: str, unit: str, default: float = float("nan")) -> float:
        """A quantity in `unit`; a bare number is in CGS, or in what `units real` makes of it."""
        if name not in self:
            return default
        value, written = units.split(self[name])
        if not written and self.get("units", "").lower() == "real":
            written = REAL_UNITS.get(name, "")
        here = units.cgs(written)[0] if written else 1.0
        return value * here / units.cgs(unit)[0]

    def says_yes(self, name: str) -> bool:
        return self.get(name, "").lower() == "yes"

    def element(self) -> float:
        """Length of an element at the nozzle, cm."""
        points = self.number("points", "1")
        return self.number("resolution", "cm", self.number("initial length", "cm") / points)

    def held_beyond(self) -> float:
        """A bead is held at the nozzle while the youngest one is this far from it or farther, cm."""
        if not self.says_yes("inserting"):
            return math.inf
        by_flow = self.get("feed", "flow" if self.get("model", "").lower() == "slender" else "pull").lower() == "flow"
        return 0.0 if by_flow else 1.5 * self.element()
