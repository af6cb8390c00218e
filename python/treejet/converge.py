"""The error budget of a deck's steady means: statistics, time, force and space, and what less error would cost.

The deck runs at tightened settings (levels.py), each direction alone and one level of all together: a sweep (sweep.py), which
goes on where it was stopped. budget.py says what their means tell.

Chaos shows in the rows: those of two tolerances come apart however small both are. Then rows cannot be compared, but means
can, and are.
"""

from __future__ import annotations

import itertools
import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Callable, Optional, Union

import numpy as np

from . import program
from .budget import Part, Setting, cheapest, part
from .errors import InputError, TreejetError
from .levels import Direction, directions
from .means import NO_MEAN, SteadyMean
from .sweep import STOPPED, Point, sweep

SHORT = {"aperture": "angl", "path": "lp", "velocity": "vc", "current": "fcc", "radius": "rc", "beads": "n"}
GRACE = 10.0  #: s that any run may take
NO_LIMIT = {"space": "differences do not fall with the elements: the value is theirs",
            "time": "differences do not fall with the time step",
            "force": "differences do not fall with the accuracy of the field"}


@dataclass(frozen=True)
class Budget:
    """What is known of one mean."""

    key: str
    unit: str
    mean: SteadyMean
    parts: Mapping[str, Part]
    together: float  #: the value with all directions one level finer
    total: float
    verdict: str
    cheapest: Optional[Setting] = None

    @property
    def converged(self) -> bool:
        """Whether the value has a limit; how near it is, `total` tells."""
        return not self.verdict.startswith("not converged")


@dataclass(frozen=True)
class Convergence:
    """The budgets of a deck, by key, and the runs behind them: base, `time 1`, `time 2`, ..., together."""

    deck: str
    accuracy: float
    budgets: Mapping[str, Budget]
    directions: "tuple[Direction, ...]"
    runs: Mapping[str, Point] = field(repr=False)
    chaotic: bool = False


def converge(deck: Union[str, "os.PathLike[str]"], quantities: "Sequence[str]" = (),
             out: Union[str, "os.PathLike[str]"] = "converge", accuracy: float = 0.01, jobs: int = 1,
             told: Optional[Callable[[str], None]] = None, patience: float = 200, **overrides: object) -> Convergence:
    """Runs the deck at all settings, in folders of `out`, and weighs the means. `quantities` are keys of tables, or words of SHORT;
    by default those of the deck's printstat list. Overrides as for `run`. Costs are seconds of the clock: jobs=1 where they matter.
    A run that takes `patience` times as long as the deck's own, and ten seconds, is given up.
    """
    if not 0 < accuracy < 1:
        raise InputError("expected a relative accuracy between 0 and 1, as 0.01")
    given = {name.replace("_", " "): program.word(value) for name, value in overrides.items()}
    values = _directives(deck, given)
    keys = _keys(values, quantities)
    given["printstat list"] = " ".join(["t", *keys])
    if "timestep" in values and "print time" not in values:  # 1000 steps, whose length is about to change
        given["print time"] = f"{1000 * float(values['timestep']):.12g}"
    _directives(deck, given)  # refused before a run is begun
    ways = directions(values)
    settings = _settings(ways)
    vary = [{**given, **setting} for setting in settings.values()]
    base = sweep(deck, vary, out, only=1)[0]
    if base.exit_code not in (0, STOPPED):
        raise TreejetError(f"the deck's own run failed: {base.message}", base.exit_code)
    longest = GRACE + patience * seconds(base) if not base.exit_code else None
    runs = dict(zip(settings, sweep(deck, vary, out, jobs, told, walltime=longest)))
    chaotic = _is_chaotic(runs, keys)
    budgets = {key: _budget(key, runs, ways, accuracy, chaotic) for key in keys}
    return Convergence(os.fspath(deck), accuracy, budgets, ways, runs, chaotic)


def _directives(deck: Union[str, "os.PathLike[str]"], given: Mapping[str, str]) -> "dict[str, str]":
    """Those in force, as the program reads the deck."""
    lines = itertools.chain.from_iterable(("--set", program.override(*item)) for item in given.items())
    return json.loads(program.call("check", os.fspath(deck), "--json", *lines))["directives"]


def _keys(values: Mapping[str, str], quantities: "Sequence[str]") -> "list[str]":
    straight = values["system"] == "1"
    listed = values.get("printstat list", "").split() or ["angl", "lp", "vc", "fcc", "rc"]
    keys = dict.fromkeys(SHORT.get(word, word) for word in quantities or listed)
    flat = ("y", "z", "ys", "zs", "vy", "vz", "vys", "vzs", "yz", "yzs", "angl")
    kept = [key for key in keys if key not in NO_MEAN and not (straight and key in flat)]
    if not kept:
        raise InputError("none of these quantities has a steady mean: " + " ".join(keys))
    return kept


def _settings(ways: "Sequence[Direction]") -> "dict[str, dict[str, str]]":
    base = {words: value for way in ways for words, value in way.levels[0].items()}
    found = {"base": base}
    for way in ways:
        found.update({f"{way.name} {k}": {**base, **way.levels[k]} for k in range(1, len(way.levels))})
    finer = [way.levels[1] for way in ways if len(way.levels) > 1 and not way.coarser]
    found["together"] = {**base, **{words: value for level in finer for words, value in level.items()}}
    return found


def seconds(point: Point) -> float:
    """Wall clock of a run, all its segments."""
    return float(sum(s.get("wall_seconds", 0.0) for s in point.run.record.get("segments", [])))


def _is_chaotic(runs: Mapping[str, Point], keys: "Sequence[str]") -> bool:
    """Whether rows of the second half differ by as much from a tenth to a hundredth of the tolerance as from all of it to a
    tenth, and by no small share of how much they vary."""
    if any(runs[name].exit_code for name in ("base", "time 1", "time 2")):
        return False
    tables = [runs[name].run.observables for name in ("base", "time 1", "time 2")]
    for key in keys:
        a, b, c = (np.asarray(table[key][-min(len(t[key]) for t in tables) // 2:]) for table in tables)
        there = np.isfinite(a) & np.isfinite(b) & np.isfinite(c)
        if there.sum() < 4:
            continue
        first, second = (float(np.sqrt(np.mean((x - y)[there] ** 2))) for x, y in ((a, b), (b, c)))
        spread = float(np.std(c[there]))
        if second > 0.5 * first and second > 0.2 * spread > 2e-7 * abs(float(np.mean(c[there]))):
            return True
    return False


def _budget(key: str, runs: Mapping[str, Point], ways: "Sequence[Direction]", accuracy: float, chaotic: bool) -> Budget:
    base = runs["base"]
    nothing = SteadyMean(math.nan, math.nan, 0, 0, 0, False)
    means = {name: point.means.get(key, nothing) for name, point in runs.items()}
    mean, wanted = means["base"], accuracy * abs(means["base"].mean)
    parts = {}
    for way in ways:
        three = [means[name] for name in ("base", f"{way.name} 1", f"{way.name} 2") if name in means]
        parts[way.name] = Part(0.0, math.nan, "exact", mean.mean) if len(three) < 3 else \
            part([m.mean for m in three], [m.error for m in three], way, wanted)
    total = sum(p.error for p in parts.values()) + mean.error
    verdict = _verdict(runs, parts, mean, total, accuracy)
    setting = None
    if not verdict.startswith("not converged"):
        t = base.run.observables["t"]
        setting = cheapest(ways, parts, {way.name: _growth(way, runs) for way in ways}, mean.error, wanted,
                           float(t[mean.start]), float(t[-1]), seconds(base))
        verdict += "" if setting else "; no setting that one could try keeps it"
    if chaotic:
        verdict += "; chaotic: rows of two tolerances come apart, only means compare"
    return Budget(key, base.units.get(key, ""), mean, parts, means["together"].mean, total, verdict, setting)


def _growth(way: Direction, runs: Mapping[str, Point]) -> float:
    """Of the seconds, a level."""
    if len(way.levels) < 3:
        return 1.0
    apart = max(seconds(runs[f"{way.name} 2"]), 1e-3) / max(seconds(runs["base"]), 1e-3)
    return apart ** (-0.5 if way.coarser else 0.5)


def _why(point: Point) -> str:
    return "given up, it takes too long" if point.exit_code == STOPPED else " ".join(point.message.split())


def _verdict(runs: Mapping[str, Point], parts: Mapping[str, Part], mean: SteadyMean, total: float, accuracy: float) -> str:
    failed = [f"{name}: {_why(point)}" for name, point in runs.items() if point.exit_code]
    if runs["base"].exit_code:
        return f"not converged: a run failed, {failed[0]}"
    if mean.values == 0:
        return "not converged: no row has a value"
    if not mean.steady:
        return "not converged: no steady state, or a run too short to tell"
    for name, found in parts.items():
        if found.kind == "failed":
            return f"not converged in {name}: " + (f"a run failed, {failed[0]}" if failed else "a run has no such mean")
        if found.kind == "growing":
            return f"not converged in {name}: {NO_LIMIT[name]}"
    if total <= accuracy * abs(mean.mean):
        return f"within {accuracy:g}"
    errors = {**{name: p.error for name, p in parts.items()}, "statistics": mean.error}
    return f"has a limit, not yet within {accuracy:g} of it: most is {max(errors, key=lambda name: errors[name])}"
