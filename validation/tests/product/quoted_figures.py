"""The figures that documents quote are those of the report.

    quoted_figures.py REPORT

compares them with the tables in the folder REPORT, which `treejet-validate all --out REPORT` has written. An entry of
validation/quoted_figures.toml holds the words of a document, with {} for a figure that is compared and {_} for one
that is not, and the cells of a table where the figures come from, row by row. A figure agrees if its digits are those
of the cell, rounded; where `within` says so, up to that part of the cell. What a quick report does not have is left out.
Before that it tries itself: other digits and lost words must be found.
"""

import csv
import re
import sys
import tomllib
from pathlib import Path

root = Path(__file__).resolve().parents[3]
number = r"(?<![\w.,])[+-]?\d+(?:,\d{3})*(?:\.\d+)?(?:e[+-]?\d+)?"


def text_of(document):
    return (root / document).read_text()


def pattern(words):
    """Of the words, in whatever lines."""
    holes = {"{}": f"({number})", "{_}": number}
    parts = re.split(r"(\{_?\}|\s+)", words.strip())
    return "".join(holes.get(p) or (r"\s+" if p.isspace() else re.escape(p)) for p in parts)


def value_of(figure):
    return float(figure.replace(",", ""))


def rounded_off(figure):
    """Half a unit of its last digit."""
    mantissa, _, exponent = figure.replace(",", "").partition("e")
    return 0.5 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def same(cell, wanted):
    try:
        return abs(float(cell) - float(wanted)) <= 1e-6 * abs(float(wanted))
    except ValueError:
        return cell == str(wanted)


def cells(report, entry):
    """None for what this report does not have."""
    file = report / f"{entry['table']}.csv"
    table = list(csv.DictReader(file.open())) if file.exists() else []
    pairs = [(where, column) for where in entry["rows"] for column in entry["columns"]]
    if entry.get("column by column"):
        pairs.sort(key=lambda pair: entry["columns"].index(pair[1]))
    for where, column in pairs:
        found = [row for row in table if all(same(row[name], value) for name, value in where.items())]
        if len(found) > 1:
            raise SystemExit(f"{entry['table']}: {len(found)} rows with {where}")
        yield float(found[0][column]) if found else None


def check(report, entry, text):
    """What is wrong, and how many figures have been compared."""
    name = f"{entry['document']}: {entry['words']!r}"
    found = list(re.finditer(pattern(entry["words"]), text))
    if len(found) != 1:
        return [f"{name} is there {len(found)} times"], 0
    figures, values = found[0].groups(), list(cells(report, entry))
    if len(values) != len(figures):
        return [f"{name}: {len(figures)} figures, {len(values)} cells"], 0
    known = [(figure, value) for figure, value in zip(figures, values) if value is not None]
    wrong = []
    for figure, value in known:
        allowed = max(rounded_off(figure) * 1.000001, entry.get("within", 0) * abs(value))
        if abs(value_of(figure) - value) > allowed:
            wrong.append(f"{name}: {figure}, but {entry['table']}.csv has {value:.6g}")
    return wrong, len(known)


def try_itself(report, entry):
    found = re.search(pattern(entry["words"]), text_of(entry["document"]))
    if not found or next(cells(report, entry)) is None:
        return
    begin, end = found.span(1)
    other = re.sub(r"\d", lambda digit: str((int(digit[0]) + 5) % 10), found[1])
    text = found.string[:begin] + other + found.string[end:]
    assert check(report, entry, text)[0], f"{entry['words']!r} with {other} passes"
    assert check(report, entry, "no figure")[0]


def main():
    report = Path(sys.argv[1])
    entries = tomllib.loads(text_of("validation/quoted_figures.toml"))["quoted"]
    wrong, compared = [], 0
    for entry in entries:
        try_itself(report, entry)
        faults, figures = check(report, entry, text_of(entry["document"]))
        wrong += faults
        compared += figures
    print("\n".join(wrong))
    print(f"{compared} of {sum(e['words'].count('{}') for e in entries)} figures compared, {len(wrong)} wrong")
    sys.exit(1 if wrong or not compared else 0)


main()
