"""The picture of a sweep: steady means over what was varied."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Optional

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from . import units
from .ensemble import named
from .errors import TreejetError
from .sweep import Point

MOST_PANELS = 9
INKS = ("#31688e", "#d1495b", "#35b779", "#b8860b", "#6f4e9c", "#3c6e47", "#8c564b", "#7f7f7f")


def abscissa(points: "list[Point]", name: str) -> "tuple[list[float], str]":
    """Values of a directive as numbers in its own unit; words, mixed units and a deck's own value count from 0."""
    given = [point.values.get(name, "as in the deck") for point in points]
    try:
        split = [units.split(value) for value in given]
        unit = split[0][1]
        return [value if its == unit else float(units.convert(value, its, unit)) for value, its in split], unit
    except TreejetError:
        words = sorted(set(given))
        return [float(words.index(value)) for value in given], ", ".join(words)


def draw(points: "list[Point]", target: Path) -> Optional[Path]:
    """The first directive is the abscissa, the others tell the lines apart; open marks are not steady."""
    done = [point for point in points if point.means]
    keys = [key for key in (done[0].means if done else ())
            if all(key in p.means for p in done) and any(math.isfinite(p.means[key].mean) for p in done)]
    if not keys:
        return None
    name, *others = named(points)
    x, unit = abscissa(done, name)
    keys = keys[:MOST_PANELS]
    columns = min(3, len(keys))
    rows = -(-len(keys) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(4.3 * columns, 0.6 + 2.6 * rows), squeeze=False,
                                constrained_layout=True)
    lines: "dict[str, list[int]]" = {}
    for k, point in enumerate(done):
        lines.setdefault(", ".join(f"{other} {point.values[other]}" for other in others if other in point.values), []).append(k)
    for panel, key in zip(axes.flat, keys):
        means = [point.means[key] for point in done]
        largest = max((abs(m.mean) for m in means if math.isfinite(m.mean)), default=1.0)
        cgs = done[0].units[key]
        to = units.readable(cgs, largest)
        for (label, members), colour in zip(lines.items(), INKS * (1 + len(lines) // len(INKS))):
            members = sorted(members, key=lambda k: x[k])
            at = np.array([x[k] for k in members])
            mean, error = (np.array([getattr(means[k], part) for k in members]) for part in ("mean", "error"))
            if to != cgs:
                mean, error = units.convert(mean, cgs, to), units.convert(error, cgs, to)
            panel.errorbar(at, mean, np.nan_to_num(error), fmt="-", color=colour, lw=1.2, capsize=3)
            steady = np.array([means[k].steady for k in members])
            panel.plot(at[steady], mean[steady], "o", color=colour, ms=4.5, label=label or None)
            panel.plot(at[~steady], mean[~steady], "o", color=colour, mfc="white", ms=4.5)
        panel.set_ylabel(key + (f" ({units.printed(to)})" if to != "1" else ""))
        panel.set_xlabel(name + (f" ({unit})" if unit else ""))
        panel.spines[["top", "right"]].set_visible(False)
    for panel in axes.flat[len(keys):]:
        panel.set_visible(False)
    if others:
        axes[0, 0].legend(frameon=False, fontsize=8)
    figure.suptitle("steady means with standard errors; open marks: not steady", fontsize=9, color="0.35")
    figure.savefig(target, dpi=130)
    plt.close(figure)
    return target
