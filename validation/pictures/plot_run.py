#!/usr/bin/python3
"""Draws what `treejet run` wrote: the jet of traj.xyz (jet.png) and the table of statdat.dat (history.png).

    validation/pictures/plot_run.py DIR [--out DIR] [--frame N]

Needs python3-matplotlib. A file that is absent is passed over. Exit codes: 0 drawn, 2 arguments, 4 nothing to draw or
a file that cannot be read as what it should be; whatever can be drawn is drawn all the same.
"""

import argparse
import re
import sys
from collections import deque
from itertools import islice
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Line3DCollection

from pictures import exit_code

COLOURS = plt.get_cmap("viridis")
INK = "0.25"
PANELS = {  # what a panel of history.png shows: axis, {key of the table: what it is}
    "velocity (cm/s)": {"vx": "farthest bead, along the axis", "vc": "arriving at the collector", "vn": "leaving the nozzle"},
    "length (cm)": {"lp": "path of the jet", "x": "farthest bead, along the axis", "yz": "farthest bead, off the axis"},
    "current (statC/s)": {"curn": "at the nozzle", "curc": "at the collector"},
}


class Unreadable(Exception):
    pass


# --- traj.xyz: frames of `count`, `t = <s>  beads = <real lines>`, then `C x y z` in cm from the collector to the nozzle


def frames(path):
    """Yields (time, lines of the real beads); ends quietly before a frame that is still being written."""
    with open(path, encoding="utf-8", errors="replace") as file:
        for count in file:
            where = f"{path}: frame {count.strip()[:40]!r}"
            if not count.strip().isdigit():
                raise Unreadable(f"{where}: expected the number of lines of a frame")
            comment, lines = next(file, ""), list(islice(file, int(count)))
            if len(lines) < int(count) or not lines[-1:] or not lines[-1].endswith("\n"):
                return
            time = re.search(r"\bt\s*=\s*(\S+)", comment)
            beads = re.search(r"\bbeads\s*=\s*(\d+)", comment)
            try:
                yield float(time[1]), lines[: int(beads[1])] if beads else lines
            except (TypeError, ValueError):
                raise Unreadable(f"{where}: expected `t = <seconds>` in {comment.strip()[:60]!r}") from None


def coordinates(lines):
    try:
        r = np.array([line.split()[1:4] for line in lines], dtype=float)
    except ValueError:
        raise Unreadable("traj.xyz: expected lines `C x y z`") from None
    if r.shape != (len(lines), 3) or not np.isfinite(r).all():
        raise Unreadable("traj.xyz: expected three finite coordinates a line")
    return r


def draw_trajectory(path, target, frame):
    last, straight, paths = deque(maxlen=1), True, []
    for k, (time, lines) in enumerate(frames(path)):
        last.append((time, lines))
        if straight:  # until a bead leaves the axis this may be a one-dimensional run
            r = coordinates(lines)
            straight = not r[:, 1:].any()
            paths.append((time, r[:, 0]))
        if k == frame:
            break
    if not last:
        raise Unreadable(f"{path}: holds no complete frame")
    if frame is not None and k < frame:
        raise Unreadable(f"{path}: has {k + 1} frames, no frame {frame}")
    if straight:
        draw_straight_jet(paths, target)
    else:
        time, lines = last[0]
        draw_jet(time, coordinates(lines), target)


def draw_straight_jet(paths, target):
    """Positions against time: each dot is a bead, the colour tells how far it is from the nozzle in beads."""
    paths = paths[:: max(1, len(paths) // 400)]
    scale, unit = time_unit(paths[-1][0])
    t = np.concatenate([np.full(len(x), time) for time, x in paths]) * scale
    x = np.concatenate([x for _, x in paths])
    age = np.concatenate([np.arange(len(x))[::-1] for _, x in paths])
    figure, axes = plt.subplots(figsize=(7, 4.2), constrained_layout=True)
    dots = axes.scatter(t, x, c=age, s=4, cmap=COLOURS, linewidths=0, rasterized=True)
    if age.max() > 1:
        figure.colorbar(dots, label="beads from the nozzle")
    axes.set(xlabel=f"t ({unit})", ylabel="x, distance from the nozzle (cm)", title="Straight jet: its beads")
    finish(figure, target)


def draw_jet(time, r, target):
    """Left the jet hanging from its nozzle, to scale; right the same seen along the axis."""
    steps = np.linalg.norm(np.diff(r, axis=0), axis=1)
    from_nozzle = np.append(np.cumsum(steps[::-1])[::-1], 0.0)
    along = (from_nozzle[:-1] + from_nozzle[1:]) / 2
    style = dict(array=along, cmap=COLOURS, linewidths=2, capstyle="round", norm=plt.Normalize(0, from_nozzle[0]))

    length = np.ptp(r[:, 0])
    off_axis = 1.08 * np.abs(r[:, 1:]).max()
    half = max(off_axis, 0.16 * length)
    bottom, top = r[:, 0].max() + 0.02 * length, min(0.0, r[:, 0].min())

    figure = plt.figure(figsize=(9.6, 5.6))
    space = figure.add_axes([0.01, 0.06, 0.46, 0.88], projection="3d")
    hanging = r[:, [1, 2, 0]]
    space.add_collection3d(Line3DCollection(np.stack([hanging[:-1], hanging[1:]], axis=1), **style))
    space.plot(*hanging[-1:].T, "v", color=INK, markersize=7)
    space.set(xlim=(-half, half), ylim=(-half, half), zlim=(bottom, top))
    space.set_box_aspect((2 * half, 2 * half, bottom - top), zoom=1.0)
    space.view_init(elev=14, azim=-60)
    space.set_xlabel("y (cm)", labelpad=-2)
    space.set_ylabel("z (cm)", labelpad=-2)
    space.set_zlabel("x (cm)", labelpad=6)
    space.tick_params(pad=0)
    space.zaxis.set_tick_params(pad=6)
    for axis, bins in ((space.xaxis, 3), (space.yaxis, 3), (space.zaxis, 6)):
        axis.set_major_locator(MaxNLocator(bins))
        axis.pane.set(facecolor="1.0", edgecolor="0.85")
    space.grid(False)

    plane = figure.add_axes([0.55, 0.12, 0.33, 0.76])
    across = r[:, 1:]
    jet = plane.add_collection(LineCollection(np.stack([across[:-1], across[1:]], axis=1), **style))
    plane.plot(*across[-1], "v", color=INK, markersize=7, label="nozzle")
    plane.set(xlim=(-off_axis, off_axis), ylim=(-off_axis, off_axis), aspect="equal", xlabel="y (cm)", ylabel="z (cm)")
    plane.legend(frameon=False, loc="upper right")
    box = plane.get_position()
    bar = figure.colorbar(jet, cax=figure.add_axes([0.91, box.y0 + 0.1 * box.height, 0.014, 0.8 * box.height]))
    bar.set_label("length along the jet from the nozzle (cm)")
    scale, unit = time_unit(time)
    figure.suptitle(f"t = {time * scale:.4g} {unit}, {len(r) - 1} beads, {from_nozzle[0]:.3g} cm of jet", y=0.97)
    finish(figure, target)


# --- statdat.dat: `# key[unit] ...`, then one row a print time, and remarks that begin with #


def draw_history(path, target):
    with open(path, encoding="utf-8", errors="replace") as file:
        header = file.readline()
        keys = [re.sub(r"\[.*", "", word) for word in re.findall(r"[^\s\[]+(?:\[[^\]]*\])?", header.lstrip("#"))]
        rows = [line.split() for line in file if line.strip() and not line.startswith("#") and line.endswith("\n")]
    if not header:
        raise Unreadable(f"{path}: is empty")
    if not header.startswith("#") or not keys:
        raise Unreadable(f"{path}: expected a first line `# t[s] key[unit] ...`")
    if not rows:
        raise Unreadable(f"{path}: holds no row")
    try:
        table = np.array(rows, dtype=float)
    except ValueError:
        table = np.empty((0, 0))
    if table.ndim != 2 or table.shape[1] != len(keys):
        raise Unreadable(f"{path}: expected rows of {len(keys)} numbers")
    column = dict(zip(keys, table.T))
    panels = {label: known for label, known in PANELS.items() if column.keys() & known.keys()}
    if "t" not in column or not panels:
        raise Unreadable(f"{path}: needs column t and one of {', '.join(k for known in PANELS.values() for k in known)}")

    scale, unit = time_unit(column["t"][-1])
    figure, axes = plt.subplots(len(panels), figsize=(7, 1 + 2.3 * len(panels)), sharex=True, squeeze=False,
                                constrained_layout=True)
    for panel, (label, known) in zip(axes[:, 0], panels.items()):
        for (key, meaning), colour in zip(known.items(), ("#31688e", "#d1495b", "#35b779")):
            if key in column:
                mark = "o-" if len(table) < 60 else "-"
                panel.plot(column["t"] * scale, column[key], mark, color=colour, ms=3, lw=1.4, label=f"{key}: {meaning}")
        panel.set_ylabel(label)
        panel.margins(x=0.01)
        panel.set_ylim(top=panel.get_ylim()[1] + 0.22 * np.ptp(panel.get_ylim()))
        panel.legend(frameon=False, ncol=3, fontsize=8, loc="upper left", columnspacing=1.2, handlelength=1.5)
        panel.spines[["top", "right"]].set_visible(False)
    axes[-1, 0].set_xlabel(f"t ({unit})")
    finish(figure, target)


def time_unit(end):
    return (1e3, "ms") if end < 0.2 else (1.0, "s")


def finish(figure, target):
    figure.savefig(target, dpi=130)
    plt.close(figure)
    print(f"wrote {target}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", metavar="DIR", type=Path, help="where traj.xyz and statdat.dat are")
    parser.add_argument("--out", metavar="DIR", type=Path, help="where the pictures go (default: beside the files)")
    parser.add_argument("--frame", metavar="N", type=int, help="frame of traj.xyz, counted from 0 (default: the last)")
    options = parser.parse_args()
    out = options.out or options.run

    drawn, complaints = 0, []
    for name, draw in (
        ("traj.xyz", lambda path: draw_trajectory(path, out / "jet.png", options.frame)),
        ("statdat.dat", lambda path: draw_history(path, out / "history.png")),
    ):
        if not (options.run / name).exists():
            continue
        try:
            out.mkdir(parents=True, exist_ok=True)
            draw(options.run / name)
            drawn += 1
        except (Unreadable, OSError) as problem:
            complaints.append(str(problem))
    if not drawn and not complaints:
        complaints.append(f"{options.run}: neither traj.xyz nor statdat.dat is here")
    return exit_code("plot_run", complaints)


if __name__ == "__main__":
    sys.exit(main())
