"""An error budget for people and for programs: text, converge.csv, converge.json, converge.png."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from .converge import Budget, Convergence, seconds
from .levels import DIRECTIONS
from .sweep_plot import INKS

FORMAT = "treejet error budget 1"


def text(found: Convergence) -> str:
    """The budget as the terminal shows it."""

    def number(x: float) -> str:
        return f"{x:.2g}" if math.isfinite(x) else "-"

    lines = [f"{'':6}{'value':>12} {'':8}{'statistics':>11}" + "".join(f"{name:>10} {'order':>6}" for name in DIRECTIONS)
             + f"{'total':>10}"]
    for b in found.budgets.values():
        row = f"{b.key:6}{b.mean.mean:>12.6g} {'' if b.unit == '1' else b.unit:8}{number(b.mean.error):>11}"
        for name in DIRECTIONS:
            row += f"{number(b.parts[name].error):>10} {number(b.parts[name].order):>6}"
        lines += [row + f"{number(b.total):>10}", f"{'':6}{b.verdict}"]
        if b.cheapest:
            lines.append(f"{'':6}cheapest for {found.accuracy:g}, about {b.cheapest.seconds:.2g} s: {_setting(b)}")
    for way in found.directions:
        if way.why_none:
            lines.append(f"{way.name}: {way.why_none}")
    spent = ", ".join(f"{name} {seconds(p):.3g}" for name, p in found.runs.items() if not p.exit_code)
    return "\n".join([*lines, f"seconds: {spent}"])


def _setting(b: Budget) -> str:
    return ", ".join(f"{words} {value}" for words, value in b.cheapest.directives.items()) if b.cheapest else ""


def write(found: Convergence, place: Path) -> "list[Path]":
    """A row a quantity as CSV, all of it as JSON, and the picture."""
    header = ["quantity", "unit", "value", "statistical error"]
    for name in DIRECTIONS:
        header += [f"error in {name}", f"order in {name}", f"kind in {name}"]
    with open(place / "converge.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*header, "together", "total", "verdict", "cheapest setting", "its seconds"])
        for b in found.budgets.values():
            row: "list[object]" = [b.key, b.unit, b.mean.mean, b.mean.error]
            for name in DIRECTIONS:
                row += [b.parts[name].error, b.parts[name].order, b.parts[name].kind]
            table.writerow([*row, b.together, b.total, b.verdict, _setting(b), b.cheapest.seconds if b.cheapest else math.nan])
    (place / "converge.json").write_text(json.dumps(_known(record(found)), indent=1) + "\n", encoding="utf-8")
    drawn = draw(found, place / "converge.png")
    return [place / "converge.csv", place / "converge.json", *([drawn] if drawn else [])]


def record(found: Convergence) -> "dict[str, Any]":
    runs = {name: {"directory": p.directory.name, "directives": p.values, "exit code": p.exit_code, "message": p.message,
                   "seconds": math.nan if p.exit_code else seconds(p),
                   "evaluations": 0 if p.exit_code else p.run.record.get("effort", {}).get("evaluations", 0),
                   "means": {key: {"mean": m.mean, "error": m.error} for key, m in p.means.items()}}
            for name, p in found.runs.items()}
    quantities = {b.key: {"unit": b.unit, "value": b.mean.mean, "statistical error": b.mean.error,
                          "errors": {name: {"error": p.error, "order": p.order, "kind": p.kind} for name, p in b.parts.items()},
                          "together": b.together, "total": b.total, "verdict": b.verdict, "converged": b.converged,
                          "cheapest": vars(b.cheapest) if b.cheapest else None} for b in found.budgets.values()}
    return {"format": FORMAT, "deck": found.deck, "accuracy": found.accuracy, "chaotic": found.chaotic, "runs": runs,
            "quantities": quantities}


def _known(value: Any) -> Any:
    """JSON has no nan: null is what is not known."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return {key: _known(v) for key, v in value.items()} if isinstance(value, dict) else value


def draw(found: Convergence, target: Path) -> "Path | None":
    """Relative error of each mean against the seconds of the run, a line a direction, from its levels and their limit."""
    shown = [b for b in found.budgets.values() if b.mean.values and b.mean.mean]
    if not shown:
        return None
    columns = min(3, len(shown))
    rows = -(-len(shown) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(4.3 * columns, 0.8 + 2.8 * rows), squeeze=False, constrained_layout=True)
    for panel, b in zip(axes.flat, shown):
        for way, colour in zip(found.directions, INKS):
            names = [name for name in ("base", f"{way.name} 1", f"{way.name} 2") if b.key in found.runs.get(name, found.runs["base"]).means]
            limit = b.parts[way.name].limit
            known = [(seconds(found.runs[name]), abs(found.runs[name].means[b.key].mean - limit) / abs(b.mean.mean))
                     for name in names if name in found.runs]
            known = sorted((s, e) for s, e in known if math.isfinite(e) and e > 0)
            if len(way.levels) > 1 and known:
                panel.loglog(*zip(*known), "o-", color=colour, ms=4, lw=1.2, label=way.name)
        if math.isfinite(b.mean.error) and b.mean.error > 0:
            panel.axhline(b.mean.error / abs(b.mean.mean), color="0.6", lw=1, ls=":", label="statistics")
        panel.axhline(found.accuracy, color="0.3", lw=0.8, ls="--", label="wanted")
        panel.set_xscale("log")
        panel.set_yscale("log")
        panel.set_title(b.key + ("" if b.converged else ": not converged"), fontsize=9, color="0.2" if b.converged else "#b00020")
        panel.set_xlabel("seconds of the run")
        panel.set_ylabel("relative error")
        panel.spines[["top", "right"]].set_visible(False)
    for panel in axes.flat[len(shown):]:
        panel.set_visible(False)
    axes[0, 0].legend(frameon=False, fontsize=8)
    figure.savefig(target, dpi=130)
    plt.close(figure)
    return target
