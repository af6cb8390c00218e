#!/usr/bin/python3
"""Makes the report of treejet-validate: draws its tables and writes report.html, which holds pictures, tables and verdicts
and needs no other file.

    validation/pictures/report.py DIR

DIR holds what treejet-validate wrote: sections.csv, tables.csv, checks.csv and the tables themselves. Needs
python3-matplotlib and python3-jinja2. A picture that cannot be drawn is told of in its section. Exit codes: 0 written,
2 arguments, 4 a file that cannot be read or written, or a picture that could not be drawn.
"""

import argparse
import base64
import re
import sys
from pathlib import Path

import jinja2

import draw_numerics
import draw_paper
import pictures

DRAWINGS = draw_paper.DRAWINGS | draw_numerics.DRAWINGS
OF_SECTION = {  # tables that have no title of their own: pictures only, each beside a table of its section
    "case2_bead": "case2_stationary",
    "case3_jets": "case3_steady",
    "whipping_frequencies": "whipping",
    "whipping_axis": "whipping",
}
MOST_ROWS = 12  # of a table that is shown unfolded
VERDICTS = ("holds", "differs, explained", "not judged", "FAILS")


def shown(text):
    """Six digits are enough for the eye; the CSV file has them all."""
    return f"{float(text):.6g}" if re.fullmatch(r"-?[0-9.]+(e[-+]?[0-9]+)?", text) else text


def draw(directory, complaints):
    """{table: its pictures}, also those of tables that it stands for."""
    found = {}
    for name, drawings in DRAWINGS.items():
        path = directory / f"{name}.csv"
        if not path.exists():
            continue
        for drawing in drawings:
            before = len(pictures.written)
            try:
                drawing(pictures.table(path), directory)
            except (OSError, ValueError, KeyError, IndexError) as problem:
                complaints.append(f"{path}: {type(problem).__name__}: {problem}")
            found.setdefault(OF_SECTION.get(name, name), []).extend(pictures.written[before:])
    return found


def sections(directory, drawn):
    tables = pictures.rows_of(pictures.table(directory / "tables.csv"), "section")
    checks = pictures.rows_of(pictures.table(directory / "checks.csv"), "section")
    for section in pictures.table(directory / "sections.csv"):
        title = section["section"]
        parts = []
        for entry in tables.get(title, []):
            rows = pictures.table(directory / f"{entry['table']}.csv")
            parts.append(dict(entry, rows=[[shown(field or "") for field in row.values()] for row in rows],
                              columns=list(rows[0]) if rows else [], folded=len(rows) > MOST_ROWS,
                              pictures=[(p.stem, base64.b64encode(p.read_bytes()).decode()) for p in drawn.get(entry["table"], [])]))
        claims = [{key: shown(value) for key, value in check.items()} for check in checks.get(title, [])]
        yield dict(title=title, asked=section["asked"], reproduce=section["reproduce"], parts=parts, claims=claims,
                   counts={verdict: sum(c["verdict"] == verdict for c in claims) for verdict in VERDICTS})


def provenance(directory):
    path = directory / "provenance.txt"
    return path.read_text(encoding="utf-8").splitlines() if path.exists() else []


def main():
    parser = argparse.ArgumentParser(description=" ".join(__doc__.split("\n\n")[0].split()))
    parser.add_argument("directory", metavar="DIR", type=Path, help="where treejet-validate wrote its tables")
    directory = parser.parse_args().directory
    complaints = []
    try:
        found = list(sections(directory, draw(directory, complaints)))
        environment = jinja2.Environment(loader=jinja2.FileSystemLoader(Path(__file__).parent), autoescape=True, trim_blocks=True,
                                         lstrip_blocks=True)
        page = environment.get_template("report.html").render(sections=found, verdicts=VERDICTS, provenance=provenance(directory),
                                                              complaints=complaints)
        (directory / "report.html").write_text(page, encoding="utf-8")
        print(f"wrote {directory / 'report.html'}")
    except (OSError, KeyError) as problem:
        complaints.append(f"{type(problem).__name__}: {problem}")
    return pictures.exit_code("report", complaints)


if __name__ == "__main__":
    sys.exit(main())
