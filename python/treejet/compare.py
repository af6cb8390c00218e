"""Two runs, bead by bead."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .errors import InputError
from .frames import Frame
from .read import Run


@dataclass(frozen=True)
class Difference:
    """Two frames of the same time; beads that both hold are compared."""

    time: float  #: s
    common: int  #: points that both hold
    only: "tuple[int, int]"  #: points that one alone holds
    largest: float  #: largest distance of a point here from the same there, cm
    rms: float  #: its root mean square, cm


def difference(a: Frame, b: Frame) -> Difference:
    """Points are matched by their id, or by their place from the nozzle where the files hold none."""
    ids = [np.arange(len(f))[::-1] if f.id is None else f.id for f in (a, b)]
    if a.id is None or b.id is None:
        ids = [np.arange(len(f))[::-1] for f in (a, b)]
    _, here, there = np.intersect1d(*ids, return_indices=True)
    apart = np.linalg.norm(a.position[here] - b.position[there], axis=1)
    return Difference(a.time, len(here), (len(a) - len(here), len(b) - len(there)),
                      float(apart.max(initial=0)), float(np.sqrt(np.mean(apart**2))) if len(apart) else 0.0)


def compare(a: Run, b: Run, rounding: float = 1e-9) -> "list[Difference]":
    """The frames that both runs have at the same time (to `rounding`, relative to the end), oldest first."""
    found = list(_pairs(a, b, rounding))
    if not found:
        raise InputError(f"{a.directory} and {b.directory} have no frame of the same time")
    return found


def _pairs(a: Run, b: Run, rounding: float) -> Iterator[Difference]:
    times = b.frames.times
    for k, time in enumerate(a.frames.times):
        if not len(times):
            return
        at = int(np.abs(times - time).argmin())
        if abs(times[at] - time) <= rounding * max(abs(times[-1]), abs(time)):
            yield difference(a.frames[k], b.frames[at])
