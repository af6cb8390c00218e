"""The results of a run: treejet.read(directory)."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Optional, Union

from . import observables as tables
from .deck import Deck
from .errors import FileError
from .frames import Frames, H5Frames, XyzFrames
from .observables import Observables


@dataclass(frozen=True)
class Run:
    """What `treejet run` left in a directory. Everything is read when it is first asked for."""

    directory: Path
    record: "dict[str, Any]" = field(repr=False)  #: run.json

    @property
    def program(self) -> str:
        """Version, compiler and vectors of the program that ran."""
        return self.record.get("program", "")

    @property
    def finished(self) -> bool:
        """Whether the run came to its end."""
        segments = self.record.get("segments") or [{}]
        return segments[-1].get("outcome") == "completed"

    @cached_property
    def deck(self) -> Deck:
        about = self.record.get("deck") or {}
        return Deck(about.get("text", ""), about.get("overrides", ()), about.get("name", ""))

    @cached_property
    def frames(self) -> Frames:
        """Of traj.h5, else of traj.xyz; FileError if the deck asked for neither."""
        if (self.directory / "traj.h5").exists():
            return H5Frames(self.directory / "traj.h5")
        if (self.directory / "traj.xyz").exists():
            return XyzFrames(self.directory / "traj.xyz", self.deck.number("print xyz rescale", "1", 1.0))
        raise FileError(f"{self.directory}: holds no trajectory; let the deck say `print hdf5 f` with an interval in s")

    @cached_property
    def observables(self) -> Observables:
        """Of statdat.dat, else the `print list` in traj.h5; FileError if there is neither."""
        found: Optional[Observables] = None
        if (self.directory / "statdat.dat").exists():
            found = tables.from_statistics_file(self.directory / "statdat.dat")
        elif (self.directory / "traj.h5").exists():
            found = tables.from_trajectory(self.directory / "traj.h5")
        if found is None:
            raise FileError(f"{self.directory}: holds no observables; let the deck say `printstat list t x ...`")
        return found


def read(directory: Union[str, "os.PathLike[str]"]) -> Run:
    """The run in a directory; FileError if there is none.

    >>> read("/nowhere")
    Traceback (most recent call last):
    ...
    treejet.errors.FileError: /nowhere: neither run.json, traj.h5, traj.xyz nor statdat.dat is here
    """
    place = Path(directory)
    names = ("run.json", "traj.h5", "traj.xyz", "statdat.dat")
    if not any((place / name).exists() for name in names):
        raise FileError(f"{place}: neither {', '.join(names[:-1])} nor {names[-1]} is here")
    record: dict[str, Any] = {}
    if (place / "run.json").exists():
        try:
            record = json.loads((place / "run.json").read_text())
        except ValueError as problem:
            raise FileError(f"{place / 'run.json'}: no record of a run: {problem}") from None
        segments, deck = (record.get("segments", []), record.get("deck", {})) if isinstance(record, dict) else (None, None)
        if not isinstance(segments, list) or not isinstance(deck, dict) or not all(isinstance(s, dict) for s in segments):
            raise FileError(f"{place / 'run.json'}: no record of a run of treejet")
    return Run(place, record)
