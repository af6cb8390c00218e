"""Frames of a trajectory, read when they are asked for.

Points of a frame are the beads, oldest first, and then the nozzle. traj.h5 has everything; traj.xyz has positions
only, with the time, and of a jet of more points than it has room for those nearest to the collector. Quantities are in CGS.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Optional, Union

import numpy as np

from .errors import FileError

MOST_LINES = 10**12
COLUMNS = {"velocity": "cm/s", "stress": "g/(cm s^2)", "charge": "statC", "mass": "g", "radius": "cm"}


@dataclass(frozen=True)
class Frame:
    """The jet at one instant; beads 0 to -2, oldest first, the nozzle last, unless the frame is cut off before it."""

    time: float  #: s
    position: np.ndarray  #: (points, 3), cm
    id: Optional[np.ndarray] = None  #: of the beads from 1, of the nozzle 0
    velocity: Optional[np.ndarray] = None  #: (points, 3), cm/s
    stress: Optional[np.ndarray] = None  #: g/(cm s^2)
    charge: Optional[np.ndarray] = None  #: statC
    mass: Optional[np.ndarray] = None  #: g
    radius: Optional[np.ndarray] = None  #: cm
    added: dict[str, np.ndarray] = field(default_factory=dict)  #: columns that the scene adds, by name
    cut_off: bool = False  #: the last point is a bead, as those nearer to the nozzle are left out

    def __len__(self) -> int:
        return len(self.position)

    @property
    def beads(self) -> int:
        """Points but the nozzle; a held bead (core/jet/nozzle.hpp) is no point yet."""
        return len(self) - (not self.cut_off)

    def elements(self) -> np.ndarray:
        """Lengths from each point to the next one towards the nozzle, cm."""
        return np.linalg.norm(np.diff(self.position, axis=0), axis=1)

    def path(self) -> np.ndarray:
        """Length along the jet from the nozzle, or where the frame is cut off, to each point, cm."""
        return np.append(np.cumsum(self.elements()[::-1])[::-1], 0.0)

    def counted_beads(self, held_beyond: float) -> int:
        """Beads as the observable n counts them: with the one that is held (Deck.held_beyond), if the frame shows so much."""
        steps = self.elements()
        held = len(steps) > 0 and not self.cut_off and steps[-1] >= held_beyond
        return self.beads + int(held)


class H5Frames(Sequence):
    """Frames of traj.h5 (H5MD 1.1)."""

    def __init__(self, path: Path) -> None:
        try:
            import h5py
        except ImportError:
            raise FileError(f"{path}: needs h5py, Debian package python3-h5py") from None
        self.path = path
        try:
            self._file = h5py.File(path, "r")
            self._jet = self._file["particles/jet"]
            self.times: np.ndarray = self._jet["position/time"][...]
            #: of the columns that the scene adds, by name
            self.added_units: dict[str, str] = {}
            if "parameters/columns" in self._file:
                lines = self._file["parameters/columns"].asstr()[()].splitlines()
                self.added_units = {name: unit for name, _, unit in (line.partition(" ") for line in lines)}
        except (OSError, KeyError) as problem:
            raise FileError(f"{path}: cannot be read as a trajectory of treejet: {problem}") from None

    def __len__(self) -> int:
        return len(self.times)

    def __getitem__(self, k: Union[int, slice]) -> Union[Frame, list[Frame]]:
        if isinstance(k, slice):
            return [self[i] for i in range(*k.indices(len(self)))]
        k = range(len(self))[k]
        try:
            ids = self._jet["id/value"][k]
            points = int((ids >= 0).sum())
            columns, added = ({name: self._jet[f"{name}/value"][k, :points] for name in names}
                              for names in (("position", *COLUMNS), self.added_units))
        except (OSError, KeyError, ValueError) as problem:
            raise FileError(f"{self.path}: frame {k} cannot be read: {problem}") from None
        return Frame(time=float(self.times[k]), id=ids[:points], added=added, **columns)


class XyzFrames(Sequence):
    """Frames of traj.xyz, whose lengths are `rescale` times those of the jet; the file is passed through once to find where they
    begin. One that is cut short is left out.
    """

    def __init__(self, path: Path, rescale: float = 1.0) -> None:
        self.path, self.rescale = path, rescale
        self._begin, self._points, self._room, times = [], [], 0, []
        with open(path, "rb") as file:
            while count := file.readline():
                comment = file.readline().decode(errors="replace")
                time = re.search(r"\bt\s*=\s*(\S+)", comment)
                points = re.search(r"\bbeads\s*=\s*(\d+)", comment)
                begin = file.tell()
                if not count.strip().isdigit() or (comment.endswith("\n") and not time):
                    raise FileError(f"{path}: expected a number of lines, then `t = <seconds>`; found "
                                    f"{count.strip()[:40]!r}, {comment.strip()[:60]!r}")
                lines = list(itertools.islice(file, min(int(count), MOST_LINES)))
                if len(lines) < int(count) or not lines or not lines[-1].endswith(b"\n"):
                    break
                self._room = len(lines)  # constant
                self._begin.append(begin)
                self._points.append(int(points[1]) if points else len(lines))
                times.append(float(time[1]))
        self.times = np.array(times)

    def __len__(self) -> int:
        return len(self._begin)

    def __getitem__(self, k: Union[int, slice]) -> Union[Frame, list[Frame]]:
        if isinstance(k, slice):
            return [self[i] for i in range(*k.indices(len(self)))]
        k = range(len(self))[k]
        with open(self.path, "rb") as file:
            file.seek(self._begin[k])
            lines = [file.readline().split()[1:4] for _ in range(self._points[k])]
        try:
            position = np.array(lines, dtype=float).reshape(-1, 3)
        except ValueError:
            position = np.full((1, 3), np.nan)
        if len(position) != len(lines) or not np.isfinite(position).all():
            raise FileError(f"{self.path}: frame {k}: expected lines `C x y z` of three finite numbers")
        # the nozzle is at x = 0, where no bead is
        cut_off = self._points[k] == self._room and bool(position[-1, 0] != 0)
        return Frame(time=float(self.times[k]), position=position / self.rescale, cut_off=cut_off)


Frames = Union[H5Frames, XyzFrames]


def thinned(count: int, most: int) -> np.ndarray:
    """At most `most` of `count` frames or points, evenly spread, the first among them, and the last where there is more than one.

    >>> thinned(5, 3), thinned(2, 3), thinned(5, 1)
    (array([0, 2, 4]), array([0, 1]), array([0]))
    """
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


def each(frames: Sequence, most: Optional[int] = None) -> Iterator[Frame]:
    """The frames one by one, thinned."""
    for k in thinned(len(frames), most or len(frames)) if len(frames) else ():
        yield frames[int(k)]
