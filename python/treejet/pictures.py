"""What pictures and pages of a run have in common: which observables share a panel, in which unit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import units
from .observables import Observables
from .read import Run

KINDS = (  # title of a panel, keys in it
    ("velocity", ("vx", "vy", "vz", "vc", "vn")), ("length", ("lp", "x", "y", "z", "yz")),
    ("current", ("curn", "curc", "fcn", "fcc")), ("beads", ("n",)), ("radius", ("rc",)), ("radius ratio", ("rrr",)),
    ("opening angle", ("angl",)), ("stress", ("st",)), ("mass flux", ("mfn", "mfc")), ("charge", ("chn", "chc", "q")),
    ("strain rate", ("svc",)), ("mass", ("mass",)), ("scaled length", ("xs", "ys", "zs", "yzs", "rlp")),
    ("scaled velocity", ("vxs", "vys", "vzs")), ("scaled stress", ("sts",)), ("error of the field", ("ferr", "ferrmax")),
    ("beads since the start", ("f", "l")), ("wall clock", ("cpu",)), ("wall clock of the run", ("cpue", "cpur")),
    ("scaled time", ("ts",)),
)


@dataclass(frozen=True)
class Panel:
    title: str
    unit: str  #: in which the panel shows its keys
    keys: "tuple[str, ...]"

    def values(self, table: Observables, key: str) -> np.ndarray:
        if table.units[key] == self.unit:
            return table[key]
        return table.to(key, self.unit)


def panels_of(table: Observables) -> "list[Panel]":
    """Panels for all keys but the time; keys that nobody knows get one of their own."""
    known = {key for _, keys in KINDS for key in keys}
    kinds = [*KINDS, *((key, (key,)) for key in table if key not in known and key != "t")]
    found = []
    for title, keys in kinds:
        here = tuple(key for key in keys if key in table)
        if not here:
            continue
        unit = table.units[here[0]]
        values = np.concatenate([table[key] for key in here if table.units[key] == unit])
        good = np.abs(values[np.isfinite(values)])
        found.append(Panel(title, units.readable(unit, float(good.max())) if good.size else unit, here))
    return found


def outcome_of(run: Run) -> str:
    segments = run.record.get("segments") or [{}]
    return str(segments[-1].get("outcome", ""))
