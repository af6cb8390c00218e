"""What three levels tell of an error, and what a wanted accuracy costs.

Of values x_0 (the deck's), x_1, x_2 with differences d_1 = x_1 - x_0, d_2 = x_2 - x_1 the order in step, tolerance or element is
p = log(d_1 / d_2) / log r, and the error of x_0 is d_1 / (1 - r^-p) (Richardson); of coarser levels, for which x_0 is the finest,
d_1 / (r^p - 1). A mean has a standard error, and so has a difference:

    exact      no difference
    noise      both below 2 of their standard errors: the error is at most the largest of the four
    falling    from level to level by r^p with p above the direction's least order: as above
    small      else, both below a twentieth of what is wanted: their sum, no order
    falling    without an order, where signs differ or the finer difference is below its noise: |d_2|, or its noise if
           that is larger, and of finer levels |d_1| with it
    growing    else there is no limit in sight: not converged
    failed     a run ended early, or has no such mean

total = time + force + space + statistical error.

Cheapest setting: errors go as r^-(p k), seconds as rho^k with the level k, p and rho as measured, p at most 4; where there is no order
no level is coarser than the deck's, and finer ones are taken for of order 1. The statistical error goes as the root of the time
averaged over. Of levels from -2 to 6 the cheapest that keeps what is wanted.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Optional

from .levels import Direction

HIGHEST_ORDER = 4.0
LEVELS = range(-2, 7)
SHARE = 20  #: of what is wanted, below which nobody asks for an order
SHORTEST = 0.25  #: of the time averaged over: less leaves no blocks to tell an error by


@dataclass(frozen=True)
class Part:
    """The error of one mean in one direction."""

    error: float  #: of the deck's own value; nan where it has no limit
    order: float  #: nan where none can be told
    kind: str
    limit: float = math.nan  #: what the levels tend to; nan where that cannot be told


@dataclass(frozen=True)
class Setting:
    """What would keep a wanted accuracy."""

    directives: "dict[str, str]"
    seconds: float
    error: float


def part(values: "Sequence[float]", errors: "Sequence[float]", way: Direction, wanted: float) -> Part:
    """The error of values[0], of values with standard errors at a direction's three levels; `wanted` is absolute.

    >>> way = Direction("space", 2, ({}, {}, {}))
    >>> found = part([1.5, 1.125, 1.03125], [0, 0, 0], way, 1e-9)
    >>> found.error, found.order, found.limit
    (0.5, 2.0, 1.0)
    >>> part([1, 2, 3], [0, 0, 0], way, 1e-9).kind, part([1, 2, 3], [2, 2, 2], way, 1e-9).kind
    ('growing', 'noise')
    """
    if not all(map(math.isfinite, values)):
        return Part(math.nan, math.nan, "failed")
    x, e = (list(v)[::-1] if way.coarser else list(v) for v in (values, errors))
    d1, d2 = x[1] - x[0], x[2] - x[1]
    n1, n2 = (math.hypot(*(s if math.isfinite(s) else 0.0 for s in pair)) for pair in (e[:2], e[1:]))
    if d1 == d2 == 0:
        return Part(0.0, math.nan, "exact", x[2])
    if abs(d1) <= 2 * n1 and abs(d2) <= 2 * n2:
        return Part(max(abs(d1), abs(d2), n1, n2), math.nan, "noise", x[2])
    order = math.log(abs(d1 / d2)) / math.log(way.ratio) if d1 and d2 else math.inf
    if d1 * d2 > 0 and abs(d2) > 2 * n2 and order >= way.least_order:
        order = min(order, HIGHEST_ORDER)
        beyond = d2 / (way.ratio**order - 1)
        return Part(abs(beyond) if way.coarser else abs(d1 + d2 + beyond), order, "falling", x[2] + beyond)
    if max(abs(d1), abs(d2)) <= wanted / SHARE:
        return Part(abs(d1) + abs(d2), math.nan, "small", x[2])
    if abs(d2) <= abs(d1) * way.ratio**-way.least_order + 2 * n2:
        return Part(max(abs(d2), n2) if way.coarser else abs(d1) + max(abs(d2), n2), math.nan, "falling", x[2])
    return Part(math.nan, math.nan, "growing")


def cheapest(ways: "Sequence[Direction]", parts: Mapping[str, Part], growth: Mapping[str, float], statistical: float,
             wanted: float, start: float, end: float, seconds: float) -> Optional[Setting]:
    """Of a run of so many seconds, averaged from start to end (s), whose cost grows by growth[direction] a level."""

    def order(way: Direction) -> float:
        p = parts[way.name].order
        return p if math.isfinite(p) else 1.0

    def levels_of(way: Direction) -> Iterable[int]:
        if len(way.levels) == 1:
            return (0,)
        return LEVELS if math.isfinite(parts[way.name].order) else LEVELS[LEVELS.index(0):]

    best = None
    for levels in itertools.product(*map(levels_of, ways)):
        if not all(map(_is_valid, ways, levels)):
            continue
        bias = sum(parts[way.name].error * way.ratio ** (-order(way) * k) for way, k in zip(ways, levels))
        if bias >= wanted:
            continue
        longer = max((statistical / (wanted - bias)) ** 2, SHORTEST)
        final = start + longer * (end - start)
        cost = seconds * final / end * math.prod(growth[way.name] ** k for way, k in zip(ways, levels))
        if best is None or cost < best.seconds:
            directives = {words: value for way, k in zip(ways, levels) for words, value in way.setting(k).items()}
            best = Setting({**directives, "final time": f"{final:.4g}"}, cost, bias + statistical / math.sqrt(longer))
    return best


def _is_valid(way: Direction, level: int) -> bool:
    """Whether a deck may have it: numbers of points are whole, accuracies below 1, tubes no shorter than tried."""
    setting = way.setting(level)
    if any(float(value) != round(float(value)) or float(value) < 1 for words, value in setting.items() if words == "points"):
        return False
    if any(not 1e-13 < float(value) < 1 for words, value in setting.items() if words.split()[-1] in ("tolerance", "accuracy")):
        return False
    return not (way.coarser and level > 0) and not (way.ratio < 2 and level > 2)
