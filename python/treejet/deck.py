"""The deck of a run as Python sees it: directives and their values, the overrides last.

>>> deck = Deck("collector distance 16.d0  # cm\\nexternal potential 9 kV\\nprint list t x\\nfinish", ["collector distance 20 mm"])
>>> deck["print list"], round(deck.number("external potential", "kV"), 6), deck.number("collector distance", "cm")
('t x', 9.0, 2.0)
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Optional

from . import units

LISTS = ("print list", "printstat list")


def directive(line: str) -> Optional[tuple[str, str]]:
    """Name and value of a line; None for comments, blank lines and `finish`.

    A value begins at the first number, else it is the last word.
    """
    words = re.split(r"[#!]", line)[0].lower().split()
    if len(words) < 2:
        return None
    for name in LISTS:
        if words[:2] == name.split():
            return name, " ".join(words[2:])
    original = re.split(r"[#!]", line)[0].split()
    at = next((k for k, word in enumerate(words) if k and re.match(r"[-+.]?\d", word)), len(words) - 1)
    return " ".join(words[:at]), " ".join(original[at:])


class Deck(Mapping):
    """Directives by name, in lower case; values as written. `text` is the deck itself, `overrides` the --set lines."""

    def __init__(self, text: str, overrides: Sequence[str] = (), name: str = "") -> None:
        self.text, self.overrides, self.name = text, list(overrides), name
        lines = [*text.splitlines(), *self.overrides]
        self._values = dict(found for found in map(directive, lines) if found)

    def __getitem__(self, name: str) -> str:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return f"Deck({self.name!r}, {len(self)} directives)"

    def number(self, name: str, unit: str, default: float = float("nan")) -> float:
        """A quantity in `unit`; a bare number is in CGS."""
        if name not in self:
            return default
        value, written = units.split(self[name])
        here = units.cgs(written)[0] if written else 1.0
        return value * here / units.cgs(unit)[0]

    def element(self) -> float:
        """Length of an element at the nozzle, cm."""
        points = self.number("points", "1")
        return self.number("resolution", "cm", self.number("initial length", "cm") / points)
