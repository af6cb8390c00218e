"""Ensembles: points of a sweep that differ by the `seed` of their noise alone, taken together.

Steady means of n seeds are n independent draws. Of them come their mean, their spread (standard deviation from one seed to
another, by n - 1) and the standard error of the mean, spread / sqrt(n); both are nan with one seed. Points that failed are
left out.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .whole_csv import write_csv

if TYPE_CHECKING:
    from .sweep import Point

SEED = "seed"


@dataclass(frozen=True)
class EnsembleMean:
    mean: float
    spread: float
    seeds: int

    @property
    def error(self) -> float:
        return self.spread / math.sqrt(self.seeds)


def ensemble_mean(values: "Sequence[float]") -> EnsembleMean:
    """
    >>> m = ensemble_mean([3.0, 5.0, 7.0, 9.0])
    >>> m.mean, m.seeds, round(m.spread ** 2, 12), round(m.error ** 2, 12)
    (6.0, 4, 6.666666666667, 1.666666666667)
    """
    spread = float(np.std(values, ddof=1)) if len(values) > 1 else math.nan
    return EnsembleMean(float(np.mean(values)), spread, len(values))


def ensembles(points: "list[Point]") -> "list[tuple[dict[str, str], dict[str, EnsembleMean]]]":
    """What is not the seed, and the means over the seeds, for each setting in the order of the points."""
    members: "dict[tuple[tuple[str, str], ...], list[Point]]" = {}
    for point in points:
        if point.means:
            members.setdefault(tuple(sorted((k, v) for k, v in point.values.items() if k != SEED)), []).append(point)
    return [(dict(setting), {key: ensemble_mean([point.means[key].mean for point in of_setting])
                             for key in of_setting[0].means if all(key in point.means for point in of_setting)})
            for setting, of_setting in members.items()]


def named(points: "list[Point]") -> "list[str]":
    """The directives that points set, each once: a point of a list may name others than its neighbour."""
    return list(dict.fromkeys(name for point in points for name in point.values))


def write_ensembles(path: Path, points: "list[Point]") -> None:
    """A row a setting: its values, the number of seeds, `key[unit]` with spread and standard error."""
    found = ensembles(points)
    units = {key: unit for point in points for key, unit in point.units.items()}
    names = [name for name in named(points) if name != SEED]
    keys = list(found[0][1]) if found else []
    header = [*names, "seeds"]
    for key in keys:
        header += [f"{key}[{units[key]}]", f"spread of {key}", f"error of {key}"]
    rows = []
    for setting, means in found:
        row: "list[object]" = [*(setting.get(name, "") for name in names), max((m.seeds for m in means.values()), default=0)]
        for key in keys:
            m = means.get(key)
            row += [repr(m.mean), repr(m.spread), repr(m.error)] if m else [math.nan] * 3
        rows.append(row)
    write_csv(path, header, rows)
