"""`treejet plot`: the jet of a frame (jet.png) and the observables over time (history.png), with matplotlib.

`treejet movie`: the frames as mp4 where ffmpeg is, else as gif.
"""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Optional

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FFMpegWriter, PillowWriter
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Line3DCollection

from . import units
from .errors import FileError, InputError
from .frames import Frame, thinned
from .observables import Observables
from .pictures import panels_of
from .read import Run

COLOURS = plt.get_cmap("viridis")
INKS = ("#31688e", "#d1495b", "#35b779", "#b8860b", "#6f4e9c")
INK = "0.25"


def plot(run: Run, out: Optional[Path] = None, frame: Optional[int] = None) -> "list[Path]":
    """Draws what the run has; FileError if that is nothing. `frame` counts from 0, and from the end if negative."""
    place = out or run.directory
    place.mkdir(parents=True, exist_ok=True)
    drawn = []
    if any((run.directory / name).exists() for name in ("traj.h5", "traj.xyz")):
        drawn.append(_saved(jet_picture(run, frame), place / "jet.png"))
    elif frame is not None:
        raise FileError(f"{run.directory}: holds no trajectory")
    if (run.directory / "statdat.dat").exists() or not drawn:
        drawn.append(_saved(history_picture(run.observables), place / "history.png"))
    return drawn


def _saved(figure: Figure, target: Path) -> Path:
    try:
        figure.savefig(target, dpi=130)
    except OSError as problem:
        raise FileError(f"{target}: {problem.strerror}") from None
    finally:
        plt.close(figure)
    return target


def jet_picture(run: Run, frame: Optional[int] = None) -> Figure:
    """A frame, the last unless told; of a jet that is straight all the time, the positions of its beads over time."""
    frames = run.frames
    if not len(frames):
        raise FileError(f"{run.directory}: the trajectory holds no complete frame")
    k = len(frames) - 1 if frame is None else frame
    if not -len(frames) <= k < len(frames):
        raise InputError(f"{run.directory}: has {len(frames)} frames, no frame {frame}")
    shown = frames[k]
    if not shown.position[:, 1:].any() and len(frames) > 1:
        return straight_picture([frames[int(i)] for i in thinned(len(frames), 400)])
    figure = plt.figure(figsize=(9.6, 5.6))
    draw_jet(figure, shown, run.deck.held_beyond(), np.abs(shown.position[:, 1:]).max(), shown.position[:, 0])
    return figure


def straight_picture(frames: Sequence[Frame]) -> Figure:
    """Positions against time: each dot is a bead, the colour tells how far it is from the nozzle in beads."""
    unit = units.readable("s", frames[-1].time)
    t = units.convert(np.concatenate([np.full(len(f), f.time) for f in frames]), "s", unit)
    x = np.concatenate([f.position[:, 0] for f in frames])
    age = np.concatenate([np.arange(len(f))[::-1] for f in frames])
    figure, axes = plt.subplots(figsize=(7, 4.2), constrained_layout=True)
    dots = axes.scatter(t, x, c=age, s=4, cmap=COLOURS, linewidths=0, rasterized=True)
    if age.max() > 1:
        figure.colorbar(dots, label="beads from the nozzle")
    axes.set(xlabel=f"t ({units.printed(unit)})", ylabel="x, distance from the nozzle (cm)", title="Straight jet: its beads")
    return figure


def draw_jet(figure: Figure, frame: Frame, held_beyond: float, off_axis: float, along: np.ndarray) -> None:
    """Left the jet hanging from its nozzle, to scale; right the same seen along the axis.

    `off_axis` and `along` are what has to fit in, so that all frames of a movie have one scale.
    """
    r, from_nozzle = frame.position, frame.path()
    colour = (from_nozzle[:-1] + from_nozzle[1:]) / 2
    style = dict(array=colour, cmap=COLOURS, linewidths=2, capstyle="round", norm=plt.Normalize(0, from_nozzle[0]))
    off_axis, length = 1.08 * off_axis or 0.01, float(np.ptp(along)) or 0.01
    half = max(off_axis, 0.16 * length)
    bottom, top = along.max() + 0.02 * length, min(0.0, along.min())

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
    figure.suptitle(title(frame, held_beyond), y=0.97)


def title(frame: Frame, held_beyond: float) -> str:
    """Time, beads as the observable n counts them, and length.

    >>> points = np.array([[2.0, 0, 0], [1.0, 0, 0], [0, 0, 0]])
    >>> title(Frame(0.2, points), held_beyond=0.9)
    't = 200 ms, 3 beads, 2 cm of jet'
    >>> title(Frame(0.2, points[:2], cut_off=True), held_beyond=0.9)
    't = 200 ms, the 2 beads nearest to the collector, 1 cm of jet'
    """
    unit = units.readable("s", frame.time)
    beads = frame.counted_beads(held_beyond)
    which = f"the {beads} beads nearest to the collector" if frame.cut_off else f"{beads} bead{'s' * (beads != 1)}"
    return f"t = {units.convert(frame.time, 's', unit):.4g} {units.printed(unit)}, {which}, {frame.path()[0]:.3g} cm of jet"


def history_picture(table: Observables) -> Figure:
    """A panel for each kind of observable; where nothing arrived (nan) is a gap."""
    panels = panels_of(table)
    if "t" not in table or not panels:
        raise FileError("the table of observables needs column t and another one")
    if not len(table["t"]):
        raise FileError("the table of observables holds no row")
    columns = 1 if len(panels) <= 3 else 2
    rows = -(-len(panels) // columns)
    unit = units.readable("s", float(table["t"][-1]))
    figure, axes = plt.subplots(rows, columns, figsize=(6.6 * columns, 1 + 2.1 * rows), sharex=True, squeeze=False,
                                constrained_layout=True)
    for panel, kind in zip(axes.flat, panels):
        for key, colour in zip(kind.keys, INKS):
            mark = "o-" if len(table["t"]) < 60 else "-"
            panel.plot(table.to("t", unit), kind.values(table, key), mark, color=colour, ms=3, lw=1.4,
                       label=f"{key}: {table.meaning(key)}")
        panel.set_ylabel(kind.title + (f" ({units.printed(kind.unit)})" if kind.unit != "1" else ""))
        panel.margins(x=0.01)
        low, high = panel.get_ylim()
        panel.set_ylim(low, high + 0.12 * (1 + len(kind.keys)) * (high - low))
        panel.legend(frameon=False, fontsize=8, loc="upper left", handlelength=1.5)
        panel.spines[["top", "right"]].set_visible(False)
        panel.tick_params(labelbottom=True)
    for panel in axes.flat[len(panels):]:
        panel.set_visible(False)
    for panel in axes.flat[max(0, len(panels) - columns): len(panels)]:
        panel.set_xlabel(f"t ({units.printed(unit)})")
    return figure


def movie(run: Run, out: Optional[Path] = None, most_frames: int = 240, rate: int = 24) -> Path:
    """All frames, thinned to `most_frames`, at one scale: movie.mp4 where ffmpeg is installed, else movie.gif."""
    frames = run.frames
    if not len(frames):
        raise FileError(f"{run.directory}: the trajectory holds no complete frame")
    film = shutil.which("ffmpeg") is not None
    target = out or run.directory / ("movie.mp4" if film else "movie.gif")
    if target.suffix not in (".mp4", ".gif"):
        raise InputError(f"{target}: expected a name that ends in .mp4 or .gif")
    if target.suffix == ".mp4" and not film:
        raise FileError(f"{target}: needs ffmpeg, Debian package ffmpeg; a .gif needs none")
    writer = FFMpegWriter(fps=rate) if target.suffix == ".mp4" else PillowWriter(fps=rate)
    shown = thinned(len(frames), most_frames)
    extent = np.array([[f.position[:, 0].min(), f.position[:, 0].max(), np.abs(f.position[:, 1:]).max()]
                       for f in (frames[int(k)] for k in shown)])
    along, off_axis = np.array([extent[:, 0].min(), extent[:, 1].max()]), float(extent[:, 2].max())
    figure = plt.figure(figsize=(9.6, 5.6))
    try:
        with writer.saving(figure, str(target), dpi=100):
            for k in shown:
                figure.clear()
                draw_jet(figure, frames[int(k)], run.deck.held_beyond(), off_axis, along)
                writer.grab_frame()
    except OSError as problem:
        raise FileError(f"{target}: {problem}") from None
    finally:
        plt.close(figure)
    return target
