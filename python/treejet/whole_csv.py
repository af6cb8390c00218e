"""CSV files that are whole or not there: a reader never meets half a table."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path


def write_csv(path: Path, header: "Sequence[object]", rows: "Iterable[Sequence[object]]") -> None:
    fresh = path.with_suffix(".csv.next")
    with open(fresh, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(header)
        table.writerows(rows)
    fresh.replace(path)
