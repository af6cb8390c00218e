"""`treejet view`: a run as one HTML file that needs no other file and no network.

Positions and what colours the jet are kept in 16 bits over their range, so that 500 frames of 150 points take 1.5 MB.
Frames and points are thinned until the file is below 5 MB; the page tells so.
"""

from __future__ import annotations

import base64
import html
import json
import math
from importlib import resources
from pathlib import Path
from typing import Any, Optional

import numpy as np

from . import units
from .errors import FileError, TreejetError
from .frames import Frame, each, thinned
from .pictures import outcome_of, panels_of
from .read import Run

BUDGET = 3_200_000  # bytes before base64, which adds a third
LEAST_POINTS = 1000  # of a frame before frames are given up
ROWS = 2000
SCALARS = {  # of a frame: title, unit in the file, values
    "velocity": ("cm/s", lambda f: np.linalg.norm(f.velocity, axis=1)),
    "stress": ("g/(cm s^2)", lambda f: f.stress),
    "radius": ("cm", lambda f: f.radius),
    "charge per length": ("statC/cm", lambda f: line_charge(f)),
}


def line_charge(f: Frame) -> np.ndarray:
    """Charge of a bead over the length of its element."""
    lengths = f.elements()
    with np.errstate(divide="ignore"):
        return np.append(f.charge[:-1] / lengths, f.charge[-2] / lengths[-1]) if len(lengths) else np.zeros(len(f))


def quantised(values: np.ndarray, low: float, high: float) -> np.ndarray:
    """0 to 65535 from low to high.

    >>> quantised(np.array([0.0, 1.0, 3.0]), 0.0, 2.0)
    array([    0, 32768, 65535], dtype=uint16)
    """
    part = (values - low) / (high - low) if high > low else np.zeros_like(values)
    return np.rint(65535 * np.clip(np.nan_to_num(part), 0, 1)).astype("<u2")


def packed(values: np.ndarray) -> str:
    return base64.b64encode(values.tobytes()).decode()


def scalar(title: str, unit: str, values: np.ndarray) -> "dict[str, Any]":
    """One way to colour: readable unit, range without the outermost 0.2 %, logarithmic if most of
    it spans more than a factor of 6."""
    good = values[np.isfinite(values)]
    to = units.readable(unit, float(np.quantile(np.abs(good), 0.9)) if len(good) else 1)
    shown = units.convert(values, unit, to)
    good = shown[np.isfinite(shown)]
    low, high = (float(v) for v in np.quantile(good, (0.002, 0.998))) if len(good) else (0.0, 1.0)
    usual = np.quantile(good, (0.05, 0.95)) if len(good) else (0.0, 1.0)
    logarithmic = bool(low > 0 and usual[1] > 6 * usual[0])
    if high <= low:  # one value: in the middle of the scale
        low, high = low - (abs(low) or 1) / 2, high + (abs(high) or 1) / 2
    change = (lambda v: np.log(np.maximum(v, low))) if logarithmic else (lambda v: v)
    return {"title": title, "unit": units.printed(to), "low": low, "high": high, "log": logarithmic,
            "below": bool(len(good) and good.min() < low), "above": bool(len(good) and good.max() > high),
            "data": packed(quantised(change(shown), float(change(low)), float(change(high))))}


def contents(run: Run, most_frames: int) -> "dict[str, Any]":
    """All that the page knows."""
    frames = run.frames
    if not len(frames):
        raise FileError(f"{run.directory}: the trajectory holds no complete frame")
    rich = frames[0].velocity is not None
    bytes_a_point = 2 * (3 + (len(SCALARS) if rich else 0))
    longest = max(len(frames[int(k)]) for k in thinned(len(frames), 50))
    most_frames = max(1, min(most_frames, len(frames), BUDGET // (bytes_a_point * min(longest, LEAST_POINTS))))
    most_points = max(2, BUDGET // (bytes_a_point * most_frames))
    held_beyond = run.deck.held_beyond()
    positions, columns, about = [], {name: [] for name in SCALARS if rich}, []
    for f in each(frames, most_frames):
        kept = thinned(len(f), most_points)
        positions.append(f.position[kept])
        for name, column in columns.items():
            column.append(SCALARS[name][1](f)[kept])
        about.append((f.time, len(kept), f.counted_beads(held_beyond), float(f.path()[0])))
    points = np.concatenate(positions)
    low, high = points.min(axis=0), points.max(axis=0)
    time, count, beads, path = zip(*about)
    return {
        "name": run.directory.resolve().name, "program": run.program, "deck": run.deck.text,
        "overrides": run.deck.overrides, "outcome": outcome_of(run), "time": time, "count": count, "beads": beads,
        "path": [round(v, 5) for v in path], "low": low.tolist(), "high": high.tolist(),
        "position": packed(np.stack([quantised(points[:, k], low[k], high[k]) for k in range(3)], axis=1)),
        "scalars": [scalar(n, SCALARS[n][0], np.concatenate(c)) for n, c in columns.items()],
        "collector": _finite(run.deck.number("collector distance", "cm")),
        "nozzle": _finite(run.deck.number("nozzle cross", "cm")),
        "thinned": {"frames": len(frames), "points": longest if longest > most_points else 0}, "panels": _panels(run),
    }


def _finite(value: float) -> Optional[float]:
    return value if math.isfinite(value) else None


def _panels(run: Run) -> "list[dict[str, Any]]":
    """The observables as pictures.py groups them; numbers with 5 digits, nan as null."""
    try:
        table = run.observables
    except TreejetError:
        return []
    if "t" not in table or not len(table["t"]):
        return []
    rows = thinned(len(table["t"]), ROWS)

    def numbers(values: np.ndarray, digits: int = 5) -> "list[Optional[float]]":
        return [float(f"{v:.{digits}g}") if math.isfinite(v) else None for v in values[rows]]

    return [{"title": panel.title, "unit": units.printed(panel.unit), "time": numbers(table["t"], 10),
             "lines": [{"key": key, "meaning": table.meaning(key), "values": numbers(panel.values(table, key))}
                       for key in panel.keys]}
            for panel in panels_of(table)]


def page(run: Run, most_frames: int = 600) -> str:
    """The page as text."""
    about = contents(run, most_frames)
    data = json.dumps(about, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    part = {name: resources.files(__package__).joinpath(f"page/{name}").read_text(encoding="utf-8")
            for name in ("view.html", "view.css", "scene.js", "view.js")}
    return (part["view.html"].replace("{title}", html.escape(f"{about['name']} · treejet"))
            .replace("{style}", part["view.css"]).replace("{script}", part["scene.js"] + part["view.js"])
            .replace("{data}", data))


def _is_page(path: Path) -> bool:
    try:
        with open(path, "rb") as file:
            return file.read(15).lower() == b"<!doctype html>"
    except OSError as problem:
        raise FileError(f"{path}: {problem.strerror}") from None


def view(run: Run, out: Optional[Path] = None, most_frames: int = 600) -> Path:
    """Writes the page, beside the files unless `out` names another place; returns where."""
    target = out or run.directory / "view.html"
    if target.exists() and not _is_page(target):
        raise FileError(f"{target}: is there already and no page; choose another name with --out")
    text = page(run, most_frames)
    try:
        target.write_text(text, encoding="utf-8")
    except OSError as problem:
        raise FileError(f"{target}: {problem.strerror}") from None
    return target
