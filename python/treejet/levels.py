"""The settings at which an error budget (converge.py) runs a deck: three levels in each of three directions.

    time    tolerance / 10 and / 100, or timestep / 2 and / 4
    force   coulomb accuracy / 10 and / 100; none for the direct sum, which has no such error
    space   elements / r and / r^2, and with dynamic refinement its threshold / r and tolerance / r^2, what halves elements
            for r = 2. Slender tubes hold down to two nozzle radii: r = 2 where that leaves room, else less, and where there
            is none, elements are made longer instead.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from .errors import InputError

DIRECTIONS = ("time", "force", "space")
LITTLE_ROOM = 1.1  #: a smaller ratio of elements tells nothing


@dataclass(frozen=True)
class Direction:
    """One way to less error. Level 0 is the deck's own; the others are finer by `ratio` each, or coarser."""

    name: str
    ratio: float  #: of step, tolerance or element, above 1
    levels: "tuple[dict[str, str], ...]"  #: directives; a single level where there is no error
    least_order: float = 0.5  #: of step or element below which nothing converges that anybody could wait for
    coarser: bool = False
    why_none: str = ""

    def setting(self, level: int) -> "dict[str, str]":
        """Directives at any level, finer ones positive: the geometric series that the three begin."""
        if level == 0 or len(self.levels) < 2:
            return self.levels[0]
        power = -level if self.coarser else level
        return {words: f"{float(value) * (float(self.levels[1][words]) / float(value)) ** power:.6g}"
                for words, value in self.levels[0].items()}


def directions(values: Mapping[str, str]) -> "tuple[Direction, ...]":
    """Those of a deck whose directives in force are `values`, as `treejet check --json` tells them.

    >>> pull = {"tolerance": "1e-06", "initial length": "0.02", "points": "1", "inserting": "yes"}
    >>> [way.levels[-1] for way in directions(pull)]
    [{'tolerance': '1e-08'}, {}, {'initial length': '0.005'}]
    """
    return _time(values), _force(values), _space(values)


def _time(values: Mapping[str, str]) -> Direction:
    words, ratio, least = ("tolerance", 10.0, 0.3) if "tolerance" in values else ("timestep", 2.0, 0.5)
    here = float(values[words])
    if words == "tolerance" and here < 1e-11:
        raise InputError(f"tolerance {here:g} leaves no room for finer ones above round-off; a budget needs 1e-11 at least")
    return Direction("time", ratio, tuple({words: f"{here / ratio**k:.12g}"} for k in range(3)), least)


def _force(values: Mapping[str, str]) -> Direction:
    if "cutoff" in values:
        return Direction("force", 10.0, ({},), why_none="cutoff is taken for a part of the model")
    if values.get("coulomb", "direct") == "direct":
        return Direction("force", 10.0, ({},), why_none="the direct sum has none")
    here = float(values["coulomb accuracy"])
    return Direction("force", 10.0, tuple({"coulomb accuracy": f"{here / 10**k:.12g}"} for k in range(3)), 0.3)


def _space(values: Mapping[str, str]) -> Direction:
    length = float(values["initial length"])
    count = float(values["points"]) if "resolution" not in values else round(length / float(values["resolution"]))
    inserting, coarser, ratio = values["inserting"] == "yes", False, 2.0
    if inserting and values.get("self field") == "slender":
        room = length / count / (2 * float(values["nozzle cross"]))
        ratio = min(2.0, math.sqrt(max(room, 1.0)))
        coarser = ratio < LITTLE_ROOM
        ratio = 2.0 if coarser else ratio

    def level(k: int) -> "dict[str, str]":
        finer = ratio ** (-k if coarser else k)
        if not inserting:  # the jet keeps its length
            words = {"resolution": length / count / finer} if "resolution" in values else {"points": count * finer}
        else:  # and here its number of elements at the start, which a steady state does not remember
            words = {"resolution": length / count / finer} if "resolution" in values else {}
            words["initial length"] = length / finer
        if values.get("dynamic refinement") == "yes":
            for directive, power in (("dynamic refinement threshold", 1), ("dynamic refinement tolerance", 2)):
                if directive in values:
                    words[directive] = float(values[directive]) / finer**power
        return {name: f"{value:.12g}" for name, value in words.items()}

    return Direction("space", ratio, tuple(level(k) for k in range(3)), coarser=coarser)
