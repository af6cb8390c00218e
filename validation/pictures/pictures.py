"""What all pictures of the validation share: colours, reading of tables, the finish."""

import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

# one thing, one colour, in all pictures
COLOURS = {
    "Euler": "#999999",
    "Heun": "#d1495b",
    "Runge-Kutta 4": "#edae49",
    "Dormand-Prince 5(4)": "#31688e",
    "Verner 6(5)": "#35b779",
}
OTHER = "#7b3294"
PUBLISHED = dict(color="black", marker="o", markersize=3.2, markerfacecolor="none", linestyle="none")
DENSITIES = {"example": "#00798c", "printed": "#b5651d"}
VOLTAGES = {"6": "#440154", "9": "#2a9d8f", "11": "#e76f51"}
CASES = {"case 1": "case 1: one bead", "case 2": "case 2: straight jet", "case 3": "case 3: PVP jet"}

written = []  # the pictures, in the order of their making


def exit_code(program, complaints):
    """Of a program that has done what could be done, once it has told what could not."""
    for complaint in complaints:
        print(f"{program}: {complaint}", file=sys.stderr)
    return 4 if complaints else 0


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text):
    return float(text) if text else np.nan


def column(rows, name):
    return np.array([number(row[name]) for row in rows])


def rows_of(rows, column):
    """{value: rows with it}, in the order of the rows."""
    found = {}
    for row in rows:
        found.setdefault(row[column], []).append(row)
    return found


def grid(count, width=3.4, height=3.1):
    columns = min(4, count)
    lines = -(-count // columns)
    figure, panels = plt.subplots(lines, columns, figsize=(width * columns, height * lines + 0.3), squeeze=False, layout="constrained")
    for panel in panels.flat[count:]:
        panel.set_visible(False)
    return figure, panels


def plain_ticks(axis):
    """An axis of powers of ten that spans few of them gets round numbers, and not too many."""
    if axis.get_scale() != "log" or axis.get_transform().base != 10:
        return
    low, high = axis.get_view_interval()
    decades = np.log10(high / low)
    if decades < 1.5:
        axis.set_major_locator(MaxNLocator(4) if decades < 0.7 else LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())


def finish(figure, panels, target):
    entries = {}
    for panel in panels:
        plain_ticks(panel.xaxis)
        plain_ticks(panel.yaxis)
        panel.grid(True, which="major", color="0.9", linewidth=0.6)
        panel.spines[["top", "right"]].set_visible(False)
        for handle, label in zip(*panel.get_legend_handles_labels()):
            entries.setdefault(label, handle)
    columns = max(1, int(figure.get_figwidth() / 2.4))
    room = 0.22 * -(-len(entries) // columns) / figure.get_figheight()
    figure.get_layout_engine().set(rect=(0, room, 1, 1 - room))
    figure.legend(entries.values(), entries.keys(), loc="lower center", ncol=columns, frameon=False, fontsize=8)
    figure.savefig(target, dpi=130)
    plt.close(figure)
    written.append(target)
