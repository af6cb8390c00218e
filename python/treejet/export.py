"""`treejet export`: the trajectory for OVITO (GSD) and for ParaView from 5.12 on (VTKHDF).

GSD     by the package gsd of PyPI. Positions in cm; type 0 is a bead, 1 the nozzle; a bond to the next point towards
        the nozzle makes the jet visible at once. Charge, mass and diameter are HOOMD's columns (statC, g, cm; single
        precision, as the format is), velocity too; stress and id are in the log (particles/stress, particles/id).
VTKHDF  by h5py, after the file format of VTK 9.3: PolyData with a polyline a frame, in double precision, all frames in
        one file. Quantities are point data with their units in the name of an attribute beside them.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, Optional

import numpy as np

from .errors import FileError
from .frames import COLUMNS, Frame, each
from .read import Run

EXTENSIONS = {"gsd": ".gsd", "vtkhdf": ".vtkhdf"}


def export(run: Run, to: str, out: Optional[Path] = None, force: bool = False) -> Path:
    """Writes traj.gsd or traj.vtkhdf beside traj.h5, unless `out` names another place; returns where."""
    if not (run.directory / "traj.h5").exists():
        raise FileError(f"{run.directory}: holds no traj.h5; let the deck say `print hdf5 f` with an interval in s")
    target = out or run.directory / f"traj{EXTENSIONS[to]}"
    if target.exists() and not force:
        raise FileError(f"{target}: exists already; --force replaces it, --out names another place")
    write = {"gsd": write_gsd, "vtkhdf": write_vtkhdf}[to]
    unfinished = target.with_name(target.name + ".next")
    try:
        write(run, unfinished)
        unfinished.replace(target)
    except OSError as problem:
        raise FileError(f"{target}: {problem}") from None
    finally:
        unfinished.unlink(missing_ok=True)
    return target


def write_gsd(run: Run, target: Path) -> None:
    try:
        import gsd.hoomd
    except ImportError:
        raise FileError("--to gsd needs the Python package gsd of PyPI: pip install gsd") from None
    frame_type = getattr(gsd.hoomd, "Frame", None) or gsd.hoomd.Snapshot
    reach = 2 * max(float(np.abs(f.position).max()) for f in each(run.frames, 100))
    with gsd.hoomd.open(name=str(target), mode="w") as file:
        for step, f in enumerate(each(run.frames)):
            file.append(_gsd_frame(frame_type(), f, step, reach))


def _gsd_frame(s: Any, f: Frame, step: int, reach: float) -> Any:
    n = len(f)
    s.configuration.step = step
    s.configuration.dimensions = 3
    s.configuration.box = [2 * max(reach, float(np.abs(f.position).max()))] * 3 + [0, 0, 0]
    s.particles.N = n
    s.particles.types = ["bead", "nozzle"]
    s.particles.typeid = (f.id == 0).astype(np.uint32)
    s.particles.position, s.particles.velocity = f.position, f.velocity
    s.particles.charge, s.particles.mass, s.particles.diameter = f.charge, f.mass, 2 * f.radius
    s.bonds.N = n - 1
    s.bonds.types = ["element"]
    s.bonds.typeid = np.zeros(n - 1, np.uint32)
    s.bonds.group = np.stack([np.arange(n - 1), np.arange(1, n)], axis=1)
    s.log = {"particles/stress": f.stress, "particles/id": f.id, "time": np.array([f.time])}
    return s


def write_vtkhdf(run: Run, target: Path) -> None:
    import h5py

    frames = run.frames
    counts = np.array([len(f) for f in each(frames)])
    begins = np.concatenate([[0], np.cumsum(counts)])
    steps, total = len(counts), int(begins[-1])
    with h5py.File(target, "w", libver="earliest") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = np.array([2, 0], dtype="i8")
        root.attrs.create("Type", b"PolyData", dtype=h5py.string_dtype("ascii", len("PolyData")))
        packed = dict(compression="gzip", shuffle=True, chunks=True)
        points = root.create_dataset("Points", (total, 3), "f8", **packed)
        points.attrs["unit"] = "cm"
        data = root.create_group("PointData")
        columns = {name: data.create_dataset(name, (total, 3) if name == "velocity" else (total,), "f8", **packed)
                   for name in COLUMNS}
        for name, unit in COLUMNS.items():
            columns[name].attrs["unit"] = unit
        ids = data.create_dataset("id", (total,), "i8", **packed)
        for k, f in enumerate(each(frames)):
            here = slice(int(begins[k]), int(begins[k + 1]))
            points[here], ids[here] = f.position, f.id
            for name in COLUMNS:
                columns[name][here] = getattr(f, name)
        root["NumberOfPoints"] = counts
        _cells(root, counts)
        _steps(root, frames.times, begins[:-1])


def _cells(root: Any, counts: np.ndarray) -> None:
    """A polyline a frame in Lines; the other kinds of cells are there and empty."""
    steps = len(counts)
    for kind in ("Vertices", "Lines", "Polygons", "Strips"):
        group = root.create_group(kind)
        lines = kind == "Lines"
        group["NumberOfCells"] = np.full(steps, int(lines))
        group["NumberOfConnectivityIds"] = counts if lines else np.zeros(steps, int)
        group["Connectivity"] = np.concatenate([np.arange(n) for n in counts]) if lines else np.zeros(0, int)
        group["Offsets"] = np.stack([np.zeros(steps, int), counts], axis=1).ravel() if lines else np.zeros(steps, int)


def _steps(root: Any, times: np.ndarray, begins: np.ndarray) -> None:
    """Where each frame's part begins in the arrays above."""
    steps = len(times)
    group = root.create_group("Steps")
    group.attrs["NSteps"] = steps
    group["Values"] = times
    group["Values"].attrs["unit"] = "s"
    each_frame, lines = np.arange(steps), np.array([0, 1, 0, 0])
    group["PartOffsets"], group["NumberOfParts"] = each_frame, np.ones(steps, int)
    group["PointOffsets"] = begins
    group["CellOffsets"] = np.outer(each_frame, lines)
    group["ConnectivityIdOffsets"] = np.outer(begins, lines)
    offsets = group.create_group("PointDataOffsets")
    for name in (*COLUMNS, "id"):
        offsets[name] = begins
