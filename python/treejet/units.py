"""Units: from the CGS of files to those a person reads, and back.

Dimensions are powers of (cm, g, s, statC): charge has a dimension of its own, so that kV and statV are alike and
kV and cm are not. The units are those of decks (core/deck/units.cpp); as there a hertz is 2 pi rad/s.

>>> round(convert(30.02076857, "statV", "kV"), 4)
9.0
>>> round(convert(1, "g/(cm s^2)", "Pa"), 4), round(convert(1, "kHz", "rad/s"), 1), round(convert(1, "bar", "N/m²"))
(0.1, 6283.2, 100000)
>>> convert(2, "cm", "s")
Traceback (most recent call last):
...
treejet.errors.InputError: cannot convert cm to s: another dimension
"""

from __future__ import annotations

import math
import re
from typing import Union

import numpy as np

from .errors import InputError

Number = Union[float, np.ndarray]
Dimension = "tuple[float, float, float, float]"

STATC = 2.99792458e9  # statC in a coulomb

# value in CGS, powers of cm, g, s, statC
PLAIN = {
    "1": (1.0, (0, 0, 0, 0)), "degree": (math.pi / 180, (0, 0, 0, 0)), "rad": (1.0, (0, 0, 0, 0)),
    "min": (60.0, (0, 0, 1, 0)), "h": (3600.0, (0, 0, 1, 0)), "dyn": (1.0, (1, 1, -2, 0)), "dyne": (1.0, (1, 1, -2, 0)),
    "erg": (1.0, (2, 1, -2, 0)), "poise": (1.0, (-1, 1, -1, 0)), "statC": (1.0, (0, 0, 0, 1)),
    "statA": (1.0, (0, 0, -1, 1)), "statV": (1.0, (2, 1, -2, -1)),
}
WITH_PREFIX = {
    "m": (100.0, (1, 0, 0, 0)), "g": (1.0, (0, 1, 0, 0)), "s": (1.0, (0, 0, 1, 0)), "L": (1000.0, (3, 0, 0, 0)),
    "l": (1000.0, (3, 0, 0, 0)), "Hz": (2 * math.pi, (0, 0, -1, 0)), "N": (1e5, (1, 1, -2, 0)),
    "Pa": (10.0, (-1, 1, -2, 0)), "bar": (1e6, (-1, 1, -2, 0)), "P": (1.0, (-1, 1, -1, 0)), "J": (1e7, (2, 1, -2, 0)), "C": (STATC, (0, 0, 0, 1)), "A": (STATC, (0, 0, -1, 1)),
    "V": (1e7 / STATC, (2, 1, -2, -1)),
}
PREFIXES = {"": 1.0, "f": 1e-15, "p": 1e-12, "n": 1e-9, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "m": 1e-3, "c": 1e-2, "d": 0.1,
            "h": 100.0, "k": 1e3, "M": 1e6, "G": 1e9}

TOKEN = re.compile(r"\s*(?:([A-Za-zµμ]+|1)\s*(?:(?:\*\*|\^)?\s*(-?\d+)|([²³]))?|([*/()·]))")


def _named(word: str) -> tuple[float, tuple]:
    if word in PLAIN:
        return PLAIN[word]
    for name, (size, powers) in WITH_PREFIX.items():
        prefix = word[: -len(name)]
        if word.endswith(name) and prefix in PREFIXES:
            return PREFIXES[prefix] * size, powers
    raise InputError(f"unknown unit {word!r}")


def cgs(unit: str) -> tuple[float, tuple]:
    """Size of a unit in CGS, and its powers of cm, g, s and statC.

    >>> cgs("g/(cm s^2)"), cgs("mm")
    ((1.0, (-1, 1, -2, 0)), (0.1, (1, 0, 0, 0)))
    """
    size, powers, end = 1.0, (0, 0, 0, 0), 0
    signs, sign = [1], 1  # of the brackets around, and of the next factor
    while end < len(unit.rstrip()):
        token = TOKEN.match(unit, end)
        if not token:
            raise InputError(f"unknown unit {unit!r}")
        end = token.end()
        word, power, raised, mark = token.groups()
        if mark == "/":
            sign = -signs[-1]
        elif mark == "(":
            signs.append(sign)
        elif mark == ")":
            signs.pop()
            sign = signs[-1] if signs else 1
        elif word:
            factor, its = _named(word)
            exponent = sign * int(power or {"²": 2, "³": 3}.get(raised, 1))
            size *= factor**exponent
            powers = tuple(a + exponent * b for a, b in zip(powers, its))
            sign = signs[-1]
    return size, powers


def convert(value: Number, unit: str, to: str) -> Number:
    """The value in another unit of the same dimension."""
    (here, powers), (there, theirs) = cgs(unit), cgs(to)
    if powers != theirs:
        raise InputError(f"cannot convert {unit} to {to}: another dimension")
    return value * (here / there)


def split(text: str) -> tuple[float, str]:
    """Number and unit of a quantity as decks write it; Fortran's exponents are numbers, too.

    >>> split("9 kV"), split("1.d-3"), split("200.d"), split("3 dm")
    ((9.0, 'kV'), (0.001, ''), (200.0, ''), (3.0, 'dm'))
    """
    found = re.fullmatch(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[edED][-+]?\d+|[dD](?![A-Za-z]))?)\s*(.*?)\s*", text)
    if not found:
        raise InputError(f"expected a number and a unit, found {text.strip()!r}")
    return float(re.sub("[dD]", "e", found[1].rstrip("dD"))), found[2]


# what a person reads, smallest first
READABLE = {
    (1, 0, 0, 0): ("nm", "um", "mm", "cm"), (1, 0, -1, 0): ("mm/s", "m/s"), (0, 0, -1, 1): ("nA", "uA"),
    (-1, 1, -2, 0): ("Pa", "kPa", "MPa", "GPa"), (2, 1, -2, -1): ("V", "kV"), (0, 0, 0, 1): ("nC",),
    (0, 1, 0, 0): ("ng", "ug", "mg"), (0, 1, -1, 0): ("ug/s", "mg/s", "g/s"), (0, 0, 1, 0): ("us", "ms", "s"),
    (-1, 0, 0, 1): ("nC/m", "uC/m"),
}


def readable(unit: str, largest: float) -> str:
    """The unit in which a quantity, at most `largest` in `unit`, is pleasant to read.

    >>> readable("cm", 4e-4), readable("statC/s", 905), readable("s", 0.2), readable("1", 148)
    ('um', 'nA', 'ms', '1')
    """
    try:
        choices = READABLE.get(cgs(unit)[1], ())
    except InputError:
        return unit
    best = choices[0] if choices else unit
    for choice in choices:
        if abs(convert(largest, unit, choice)) >= (0.5 if choice in ("s", "cm") else 1) and math.isfinite(largest):
            best = choice
    return best


def printed(unit: str) -> str:
    """As pictures show it: um with its Greek letter.

    >>> printed("um"), printed("g/(cm s^2)")
    ('µm', 'g/(cm s^2)')
    """
    return "" if unit == "1" else re.sub(r"\bu(?=[mgsAC])", "µ", unit)
