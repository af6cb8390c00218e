"""Sweeps: a deck run for many values of some directives, side by side, each in a folder of its own.

A grid is the product of what is varied; a list comes from a CSV file whose header names directives. DIR/sweep.json
holds deck and points; DIR/001, 002, ... the runs; DIR/sweep.csv the steady means of each with their standard errors
(means.py), where `seed` is varied DIR/seeds.csv those over all seeds (ensemble.py); DIR/sweep.png draws them.
A sweep that was interrupted goes on: finished points are left alone, stopped ones resumed. A point that fails is in the
table with its exit code and message and ends no other.

>>> varied("external potential: 6 kV .. 14 kV / 5")
('external potential', ['6 kV', '8 kV', '10 kV', '12 kV', '14 kV'])
>>> varied("viscosity: 1 .. 100 / 3 log"), varied("gravity: yes, no")
(('viscosity', ['1', '10', '100']), ('gravity', ['yes', 'no']))
"""

from __future__ import annotations

import csv
import fcntl
import itertools
import json
import math
import os
import re
import signal
import subprocess
import threading
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable, Optional, Union

import numpy as np

from . import program, units
from .deck import Deck
from .ensemble import SEED, named, write_ensembles
from .errors import FileError, InputError, TreejetError
from .means import SteadyMean, steady_means
from .read import Run, read
from .whole_csv import write_csv

FORMAT = "treejet sweep 1"
STOPPED = 75
MOST_POINTS = 100_000


@dataclass
class Point:
    """A point of a sweep and what became of it."""

    number: int
    values: "dict[str, str]"
    directory: Path
    exit_code: int = 0
    message: str = ""
    means: Mapping[str, SteadyMean] = field(default_factory=dict, repr=False)
    units: Mapping[str, str] = field(default_factory=dict, repr=False)

    @property
    def run(self) -> Run:
        return read(self.directory)

    def overrides(self) -> "list[str]":
        return [program.override(name, value) for name, value in self.values.items()]


def varied(text: str) -> "tuple[str, list[str]]":
    """Name and values of `NAME: FROM .. TO / COUNT [log]` or of `NAME: A, B, C`."""
    name, colon, values = text.partition(":")
    if not colon or not name.strip() or not values.strip():
        raise InputError(f"--vary {text!r}: expected `directive: from .. to / count` or `directive: a, b, c`")
    span = re.fullmatch(r"(.*?)\.\.(?!\d*\.\.)(.*)/\s*(\d+)\s*(log)?\s*", values)
    if span is None:
        if ".." in values:
            raise InputError(f"--vary {text!r}: expected `from .. to / count`, e.g. `6 kV .. 14 kV / 9`")
        listed = [value.strip() for value in values.split(",")]
        _expect_units_alike(text, listed)
        return name.strip(), listed
    (low, unit), (high, other), count = units.split(span[1]), units.split(span[2]), int(span[3])
    if unit and other and unit != other:
        high = float(units.convert(high, other, unit))
    if count < 2:
        raise InputError(f"--vary {text!r}: expected 2 values at least")
    if not (math.isfinite(low) and math.isfinite(high)) or count > MOST_POINTS:
        raise InputError(f"--vary {text!r}: expected finite ends and at most {MOST_POINTS} values")
    if span[4] and not (low > 0 and high > 0):
        raise InputError(f"--vary {text!r}: log needs positive ends")
    numbers = np.geomspace(low, high, count) if span[4] else np.linspace(low, high, count)
    return name.strip(), [f"{number:.12g} {unit or other}".strip() for number in numbers]


def _expect_units_alike(text: str, listed: "list[str]") -> None:
    """Numbers with a unit beside numbers without one are no list that means what it says: 6, 9, 12 kV; 40,5 mN/m."""
    try:
        bare = [not units.split(value)[1] for value in listed]
    except InputError:
        return  # words
    if any(bare) and not all(bare):
        raise InputError(f"--vary {text!r}: expected a unit behind each number of the list, or behind none "
                         "(a decimal point, no comma)")


def from_csv(path: Path) -> "list[dict[str, str]]":
    """Points from a table with a header of directives, e.g. `external potential,viscosity`."""
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            found = list(csv.DictReader(file, restkey=""))
    except OSError as problem:
        raise FileError(f"{path}: {problem.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: is no text in UTF-8") from None
    # a row longer than the header has a list under no name
    rows = [{(k or "").strip(): v.strip() if isinstance(v, str) else "" for k, v in row.items()} for row in found]
    if rows and any(";" in name for name in rows[0]):
        raise InputError(f"{path}: expected commas between columns, found semicolons in the header")
    if not rows or any("" in row or "" in row.values() for row in rows):
        raise InputError(f"{path}: expected a header of directives and rows of as many values")
    return rows


def grid(vary: Mapping[str, Sequence[object]]) -> "list[dict[str, str]]":
    """All combinations, the last directive fastest.

    >>> grid({"viscosity": [10, 20], "gravity": [True]})
    [{'viscosity': '10', 'gravity': 'yes'}, {'viscosity': '20', 'gravity': 'yes'}]
    """
    names = [name.replace("_", " ") for name in vary]
    for name, values in vary.items():
        if isinstance(values, str):
            raise InputError(f"{name}: expected a list of values, found {values!r}")
    return [dict(zip(names, map(program.word, values))) for values in itertools.product(*vary.values())]


class Stop:
    """Once the user, or a batch system, has asked for an end no further point is begun, and those that run are told."""

    def __init__(self) -> None:
        self.asked = threading.Event()
        self._running: "set[subprocess.Popen[str]]" = set()
        self._lock = threading.Lock()

    def ask(self) -> None:
        with self._lock:
            self.asked.set()
            for run in self._running:
                run.send_signal(signal.SIGTERM)  # it writes its checkpoint

    def run(self, words: "list[str]") -> "Optional[tuple[int, str]]":
        """Exit code and messages of a command, or nothing if it is too late to begin."""
        with self._lock:
            if self.asked.is_set():
                return None
            run = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                   errors="replace")
            self._running.add(run)
        said = run.communicate()[1]
        with self._lock:
            self._running.discard(run)
        return run.returncode, said


def sweep(deck: Union[str, "os.PathLike[str]"],
          vary: Union[Mapping[str, Sequence[object]], Sequence[Mapping[str, object]]],
          out: Union[str, "os.PathLike[str]"] = "sweep", jobs: int = 1,
          told: Optional[Callable[[str], None]] = None, only: Optional[int] = None,
          walltime: Optional[float] = None) -> "list[Point]":
    """Runs the grid of `vary`, or the points of a list of dicts, `jobs` at a time; returns all points, or the one with the
    number `only`, counted from 1: then other processes run the others, and no table is made. A point that takes longer than
    `walltime` seconds is stopped, with a checkpoint, and has failed.

    InputError if `out` holds another sweep. KeyboardInterrupt leaves checkpoints behind, from which the same call goes on.
    """
    if jobs < 1:
        raise InputError("a sweep needs 1 job at least")
    settings = grid(vary) if isinstance(vary, Mapping) else [{k: program.word(v) for k, v in row.items()} for row in vary]
    place, source = Path(out), Path(deck)
    text = _deck_text(source)
    digits = max(3, len(str(len(settings))))
    points = [Point(k, values, place / f"{k:0{digits}d}") for k, values in enumerate(settings, 1)]
    if only is not None and not 1 <= only <= len(points):
        raise InputError(f"a sweep of {len(points)} points has no point {only}")
    if not (place / "sweep.json").exists():
        _expect_runnable(source, text, points)
    _claim(place, text, settings)
    points = points if only is None else [points[only - 1]]
    say = _unless_nobody_listens(told)
    threads = max(1, (len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1) // jobs)
    shared = set.intersection(*(set(setting.items()) for setting in settings)) if len(settings) > 1 else set()
    stop = Stop()
    with _locked(place / "sweep.json", alone=only is None), ThreadPoolExecutor(jobs) as pool:
        futures = [pool.submit(_finish, point, source, threads, stop, walltime) for point in points]
        try:
            for point, future in zip(points, futures):
                future.result()
                values = ", ".join(f"{name} {value}" for name, value in point.values.items() if (name, value) not in shared)
                say(f"{point.directory.name}  {values}: {point.message or 'done'}")
        except KeyboardInterrupt:
            stop.ask()
            raise
        if only is None:
            write_table(place / "sweep.csv", points)
            if SEED in named(points):
                write_ensembles(place / "seeds.csv", points)
    return points


def _expect_runnable(source: Path, text: str, points: "list[Point]") -> None:
    """Before a directory is claimed and hours are spent: all leave means behind, and the program knows what is varied."""
    for point in points:
        deck = Deck(text, point.overrides())
        if not deck.get("printstat list") and not (deck.get("print hdf5") and deck.get("print list")):
            raise InputError(f"{source}: a sweep takes its means from tables; let the deck say `printstat list t x ...`")
    lines = [word for line in points[0].overrides() for word in ("--set", line)] if points else []
    try:
        program.call("check", str(source), *lines)
    except TreejetError as problem:
        if "unknown directive" in str(problem):  # of all points; what is wrong with one alone ends no other
            raise


def _unless_nobody_listens(told: Optional[Callable[[str], None]]) -> Callable[[str], None]:
    """What has been closed, as by `| head`, ends no sweep."""

    def say(line: str) -> None:
        nonlocal told
        try:
            if told:
                told(line)
        except BrokenPipeError:
            told = None

    return say


@contextmanager
def _locked(record: Path, alone: bool) -> "Iterator[None]":
    """One process runs a whole sweep, or any number of them points of their own (`only`)."""
    with open(record) as file:
        try:
            fcntl.flock(file, (fcntl.LOCK_EX if alone else fcntl.LOCK_SH) | fcntl.LOCK_NB)
        except BlockingIOError:
            raise FileError(f"{record.parent}: another sweep is running there") from None
        except OSError:
            pass  # a file system without locks
        yield


def _deck_text(deck: Path) -> str:
    try:
        return deck.read_text(encoding="utf-8", errors="surrogateescape")
    except OSError as problem:
        raise FileError(f"{deck}: {problem.strerror}") from None


def _claim(place: Path, deck: str, settings: "list[dict[str, str]]") -> None:
    """The directory is this sweep's: new, empty, or left by the same one."""
    record = place / "sweep.json"
    mine = {"format": FORMAT, "deck": deck, "points": settings}
    try:
        place.mkdir(parents=True, exist_ok=True)
        if not record.exists():
            if any(not there.name.startswith(record.name) for there in place.iterdir()) and not record.exists():
                raise FileError(f"{place}: is not empty and holds no sweep; name another --out")
            fresh = place / f"{record.name}.{os.uname().nodename}-{os.getpid()}"
            fresh.write_text(json.dumps(mine, indent=1) + "\n")
            try:
                os.link(fresh, record)  # the first of several processes, and whole
            except FileExistsError:
                pass
            fresh.unlink()
        if json.loads(record.read_text()) != mine:
            raise InputError(f"{place}: holds a sweep of another deck or of other points; name another --out")
    except (OSError, ValueError) as problem:
        raise FileError(f"{record}: {problem}") from None


def _finish(point: Point, deck: Path, threads: int, stop: Stop, walltime: Optional[float]) -> None:
    """Runs a point, goes on with it, or leaves it alone; its failure is noted, not raised."""
    if not _is_finished(point):
        if (point.directory / "checkpoint").exists() or (point.directory / "checkpoint.old").exists():
            words = ["run", "--resume", str(point.directory), "--quiet", "--threads", str(threads)]
        else:
            # what an attempt without a checkpoint left is begun anew
            words = program.run_arguments(str(deck), str(point.directory), point.overrides(), threads, force=True)
        if walltime is not None:
            words += ["--walltime", f"{walltime:.0f}"]
        done = stop.run([program.find(), *words])
        if done is None:
            point.exit_code, point.message = STOPPED, "not begun"
            return
        if done[0]:
            failure = program.failure(done[1], done[0])
            point.exit_code, point.message = failure.exit_code, str(failure)
    try:
        table = point.run.observables
        point.units = table.units
        if point.exit_code == 0:
            point.means = steady_means(table)
    except TreejetError as problem:
        point.exit_code = point.exit_code or problem.exit_code
        point.message = point.message or str(problem)


def _is_finished(point: Point) -> bool:
    try:
        return point.run.finished
    except TreejetError:
        return False


def write_table(path: Path, points: "list[Point]") -> None:
    """A row a point: values, exit code, `key[unit]` with its standard error and whether it is steady, message."""
    unit_of = {key: point.units[key] for point in points for key in point.means}
    names = named(points)
    header = ["point", *names, "exit code"]
    for key, unit in unit_of.items():
        header += [f"{key}[{unit}]", f"error of {key}", f"{key} is steady"]
    rows = []
    for point in points:
        row = [point.directory.name, *(point.values.get(name, "") for name in names), point.exit_code]
        for key in unit_of:
            m = point.means.get(key)
            row += [repr(m.mean), repr(m.error), "yes" if m.steady else "no"] if m else [math.nan, math.nan, ""]
        rows.append([*row, " ".join(point.message.split())])
    write_csv(path, [*header, "message"], rows)
