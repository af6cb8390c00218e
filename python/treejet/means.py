"""Means over the steady state, with their standard error: what one quotes of a run.

Start.    MSER: of all starts in the first half of the series, the one at which the estimated variance of the mean,
          s^2 / m of the m values from there on, is least (White, Simulation 69 (1997) 323). Block means of 5 values
          carry the search, as long as there are 50 values.
Error.    Block averaging: the standard error from means of blocks of B values grows with B until the blocks are
          independent (Flyvbjerg & Petersen, J. Chem. Phys. 91 (1989) 461). The smallest B is taken, of sizes that grow by a
          quarter, with B^3 > 2 m (e_B / e_1)^4, which weighs bias against noise (Lee et al., Phys. Rev. E 83 (2011)
          066706).
Steady    if the two halves of what is left agree: their means differ by at most 3 of the difference's standard errors,
          2 e, and what one value more or less moves them, and a millionth of them; and B leaves 4 blocks at least.
A window without a value (nan) is passed over.

>>> rng = np.random.default_rng(1)
>>> rise = 1 - np.exp(-np.arange(400) / 20)
>>> m = steady_mean(rise + 0.01 * rng.standard_normal(400))
>>> abs(m.mean - 1) < 4 * m.error, m.steady, 60 <= m.start <= 200
(True, True, True)
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from .observables import Observables

BATCH = 5
SAME = 1e-6  #: relative: a jet that tends to a fixed value without noise is steady once nobody would quote the difference
NO_MEAN = ("t", "ts", "cpu", "cpue", "cpur", "f", "l", "nref", "nmrg")


@dataclass(frozen=True)
class SteadyMean:
    mean: float
    error: float  #: standard error; nan where the series is too short to tell
    start: int  #: row from which on the mean is taken
    values: int  #: rows in it
    block: int  #: values in a block
    steady: bool


def mser_start(series: np.ndarray) -> int:
    """The start by MSER, at most half of the series."""
    batch = BATCH if len(series) >= 10 * BATCH else 1
    means = series[: len(series) // batch * batch].reshape(-1, batch).mean(axis=1)
    starts = range(len(means) // 2 + 1)
    return batch * min(starts, key=lambda k: means[k:].var() / (len(means) - k)) if len(means) else 0


def block_error(series: np.ndarray) -> "tuple[float, int]":
    """Standard error of the mean by block averaging, and the size of the blocks; nan if no size gives independent ones."""
    values, plain = len(series), None
    block = 1
    while values // block >= 4:
        means = series[values % block :].reshape(-1, block).mean(axis=1)  # the oldest values are left out
        error = means.std(ddof=1) / math.sqrt(len(means))
        plain = error if plain is None else plain
        if plain == 0 or block**3 > 2 * values * (error / plain) ** 4:
            return float(error), block
        block = block + 1 + block // 4
    return math.nan, block


def steady_mean(series: np.ndarray) -> SteadyMean:
    """Mean, error and start of a series taken at equal times."""
    series = np.asarray(series, dtype=float)
    there = np.flatnonzero(np.isfinite(series))
    if len(there) == 0:
        return SteadyMean(math.nan, math.nan, 0, 0, 0, False)
    kept = series[there]
    first = mser_start(kept)
    rest = kept[first:]
    error, block = block_error(rest)
    half = len(rest) // 2
    apart = abs(rest[:half].mean() - rest[half:].mean()) if half else math.inf
    one_value = np.ptp(rest) / half if half else 0.0
    steady = bool(math.isfinite(error) and apart <= 6 * error + one_value + SAME * abs(rest.mean()))
    return SteadyMean(float(rest.mean()), error, int(there[first]), len(rest), block, steady)


def steady_means(table: Observables) -> Mapping[str, SteadyMean]:
    """Of all keys but times, wall clocks and counters; the first row, the state at the start, is in no mean."""
    means = {key: steady_mean(table[key][1:]) for key in table if key not in NO_MEAN}
    return {key: replace(m, start=m.start + 1) for key, m in means.items()}
