"""The table of observables of a run: columns by key, with units."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Optional

import numpy as np

from . import units
from .errors import FileError

if TYPE_CHECKING:
    import pandas

MEANINGS = {
    "t": "time", "ts": "scaled time", "x": "farthest bead, along the axis", "y": "farthest bead, across the axis (y)",
    "z": "farthest bead, across the axis (z)", "yz": "farthest bead, off the axis", "st": "stress at the farthest bead",
    "vx": "farthest bead, along the axis", "vy": "farthest bead, across the axis (y)",
    "vz": "farthest bead, across the axis (z)", "mass": "mass of the newest bead", "q": "charge of the newest bead",
    "cpu": "wall clock, this interval", "cpur": "wall clock, to the end", "cpue": "wall clock, since the start",
    "n": "beads", "f": "number of the farthest bead", "l": "number of the nozzle", "curn": "current at the nozzle",
    "curc": "current at the collector", "vn": "leaving the nozzle", "vc": "arriving at the collector",
    "svc": "strain rate at the collector", "mfn": "mass flux at the nozzle", "mfc": "mass flux at the collector",
    "rc": "radius at the collector", "rrr": "radius at the collector over that at the nozzle",
    "lp": "path of the jet", "rlp": "path over collector distance", "angl": "opening angle",
    "chn": "charge placed at the nozzle", "chc": "charge taken by the collector",
    "fcn": "current at the nozzle, smooth", "fcc": "current at the collector, smooth",
    "ferr": "error of the Coulomb field", "ferrmax": "its largest", "vol": "volume of the jet",
    "volr": "part of it that has evaporated", "visc": "viscosity at the collector", "gc": "elastic modulus at the collector",
    "evrc": "evaporated at the collector, a part", "emfc": "evaporated mass flux", "nref": "elements split",
    "nmrg": "elements merged",
}


class Observables(Mapping):
    """Columns by key, in the units of the file.

    >>> table = Observables({"t": np.array([0.0, 1e-3]), "x": np.array([0.02, 1.0])}, {"t": "s", "x": "cm"})
    >>> table["x"], table.units["x"], table.to("x", "mm")
    (array([0.02, 1.  ]), 'cm', array([ 0.2, 10. ]))
    """

    def __init__(self, columns: Mapping[str, np.ndarray], units_of: Mapping[str, str]) -> None:
        self._columns, self.units = dict(columns), dict(units_of)

    def __getitem__(self, key: str) -> np.ndarray:
        return self._columns[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        return "Observables(" + " ".join(f"{key}[{self.units[key]}]" for key in self) + ")"

    def to(self, key: str, unit: str) -> np.ndarray:
        """A column in another unit."""
        return units.convert(self[key], self.units[key], unit)

    def meaning(self, key: str) -> str:
        return MEANINGS.get(key, "scaled " + key[:-1] if key[:-1] in MEANINGS else key)

    def to_pandas(self) -> "pandas.DataFrame":
        """A DataFrame with columns `key[unit]`."""
        import pandas

        return pandas.DataFrame({f"{key}[{self.units[key]}]": self[key] for key in self})


def from_statistics_file(path: Path) -> Observables:
    """statdat.dat: `# key[unit] ...`, remarks that begin with #, a row a print time; one cut short is left out."""
    with open(path, encoding="utf-8", errors="replace") as file:
        header = file.readline()
        words = re.findall(r"([^\s\[]+)\[([^\]]*)\]", header)
        rows = [line.split() for line in file if line.strip() and not line.startswith("#") and line.endswith("\n")]
    if not header.startswith("#") or not words:
        raise FileError(f"{path}: expected a first line `# t[s] key[unit] ...`")
    try:
        table = np.array(rows, dtype=float).reshape(len(rows), -1) if rows else np.empty((0, len(words)))
    except ValueError:
        table = np.empty((0, 0))
    if table.shape[1] != len(words):
        raise FileError(f"{path}: expected rows of {len(words)} numbers")
    return Observables({key: table[:, k] for k, (key, _) in enumerate(words)}, dict(words))


def from_trajectory(path: Path) -> Optional[Observables]:
    """The `print list` in traj.h5; None if there is none."""
    import h5py

    with h5py.File(path, "r") as file:
        if "observables" not in file or not len(file["observables"]):
            return None
        group = file["observables"]
        listed = file["parameters/observables"][()] if "parameters/observables" in file else b""
        keys = [key for key in (listed.decode() if isinstance(listed, bytes) else "").split() if key in group]
        keys = keys or list(group)
        text = {key: group[key]["value"].attrs.get("unit", "1") for key in keys}
        return Observables({key: group[key]["value"][...] for key in keys},
                           {key: unit.decode() if isinstance(unit, bytes) else str(unit) for key, unit in text.items()})
