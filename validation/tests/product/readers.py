#!/usr/bin/python3
"""Other people's readers read our files, to the bit.

    readers.py make TREEJET DECK DIR   run the deck with print hdf5 and convert its trajectory
    readers.py READER DIR              h5py, h5dump, ase, vtk, xdmf, numpy, pandas; and of PyPI ovito, MDAnalysis, chemfiles,
                                       gsd, vtkhdf (VTK 9.3 on); exit code 77 where the reader is not installed

The readers of PyPI are looked for by this Python: `python3 -m venv V; V/bin/pip install h5py numpy ovito MDAnalysis
chemfiles gsd vtk ase pandas; V/bin/python readers.py ovito DIR`.
"""
import os
import subprocess
import sys

SKIPPED = 77


def skip(why):
    print("SKIPPED:", why)
    sys.exit(SKIPPED)


def make(treejet, deck, directory):
    """Long enough for beads to come and to go."""
    sets = ["final time 6.d-3", "print time 1.d-3", "print hdf5 2.d-4", "collector distance 0.3",
            "printstat list t x n st vc", "print list t x n st vc visc gc vol curc mfc svc"]
    words = [word for line in sets for word in ("--set", line)]
    subprocess.run([treejet, "run", deck, "--out", directory, "--quiet", "--force", *words], check=True)
    for kind in ("xyz", "extxyz", "csv", "vtp"):
        subprocess.run([treejet, "convert", directory + "/traj.h5", "--to", kind, "--out", directory + "/as-" + kind,
                        "--force"], check=True)


class Trajectory:
    """What traj.h5 holds, by h5py."""

    def __init__(self, directory):
        try:
            import h5py
        except ImportError as e:
            skip(e)
        self.file = h5py.File(directory + "/traj.h5", "r")
        self.jet = self.file["particles/jet"]
        self.id = self.jet["id/value"][...]
        self.points = (self.id >= 0).sum(axis=1)
        self.time = self.jet["position/time"][...]

    def of(self, frame, name):
        return self.jet[name + "/value"][frame, : self.points[frame]]


scalars = ("stress", "charge", "mass", "radius")


def h5py(directory):
    import numpy as np
    t = Trajectory(directory)
    units = {"position": "cm", "velocity": "cm s-1", "stress": "g cm-1 s-2", "charge": "statC", "mass": "g", "radius": "cm"}
    assert list(t.file["h5md"].attrs["version"]) == [1, 1]
    assert t.file["h5md/creator"].attrs["name"] == b"treejet"
    assert list(t.file["h5md/modules/units"].attrs["version"]) == [1, 0]
    assert list(t.jet["box"].attrs["boundary"]) == [b"none"] * 3 and t.jet["box"].attrs["dimension"] == 3
    for name, unit in units.items():
        value = t.jet[name + "/value"]
        assert value.attrs["unit"] == unit, name
        assert value.chunks and value.compression == "gzip" and value.shuffle
        for part in ("step", "time"):
            assert t.jet[name][part] == t.jet["position"][part], "not a hard link"
        assert np.isfinite(value[...][t.id >= 0]).all() and np.isnan(value[...][t.id < 0]).all()
    assert t.jet["id/value"].fillvalue == -1
    assert t.jet["position/time"].attrs["unit"] == "s"
    assert len(set(t.points)) >= 3, "the number of beads does not vary"
    assert (t.id[:, 0] > t.id[0, 0]).any(), "no bead has arrived"
    for k, n in enumerate(t.points):
        assert t.id[k, n - 1] == 0 and (np.diff(t.id[k, : n - 1]) == 1).all()
    assert b"elastic modulus" in t.file["parameters/deck"][()]
    assert b"print hdf5" in t.file["parameters/overrides"][()]
    x = t.file["observables/x"]
    assert x["value"].attrs["unit"] == "cm" and list(x["step"]) == list(range(len(x["value"])))
    words = {key: o["value"].attrs["unit"] for key, o in t.file["observables"].items() if "unit" in o["value"].attrs}
    assert not any(mark in unit for unit in words.values() for mark in "/()^"), words  # H5MD's are factors with powers
    assert any("-1" in unit for unit in words.values()), "no observable of this run has a unit with a negative power"
    rows = np.loadtxt(directory + "/statdat.dat")
    assert np.array_equal(rows[:, 0], x["time"]) and np.array_equal(rows[:, 1], x["value"])


def h5dump(directory):
    try:
        out = subprocess.run(["h5dump", "-d", "/particles/jet/id/value", directory + "/traj.h5"], check=True,
                             capture_output=True, text=True).stdout
    except FileNotFoundError as e:
        skip(e)
    assert "H5T_STD_I64LE" in out and "DATA" in out


# of extended XYZ: name there, name in traj.h5
renamed = {"velo": "velocity", "tension": "stress", "bead_charge": "charge", "bead_mass": "mass", "jet_radius": "radius", "id": "id"}


def ase(directory):
    import numpy as np
    try:
        import ase.io
    except ImportError as e:
        skip(e)
    t = Trajectory(directory)
    frames = ase.io.read(directory + "/as-extxyz", index=":", format="extxyz")
    assert len(frames) == len(t.time)
    for k, atoms in enumerate(frames):
        assert np.array_equal(atoms.positions, t.of(k, "position")), k
        assert atoms.info["Time"] == t.time[k]
        assert set(atoms.arrays) == {"numbers", "positions", *renamed}
        for there, here in renamed.items():
            assert np.array_equal(atoms.arrays[there], t.of(k, here)), (there, k)
    frames = ase.io.read(directory + "/as-xyz", index=":", format="xyz")
    assert {len(atoms) for atoms in frames} == {t.points.max()}
    for k, atoms in enumerate(frames):
        check_padded(atoms.positions, t, k, 0)


def check_padded(positions, t, k, tolerance):
    import numpy as np
    n = t.points[k]
    assert len(positions) == t.points.max() and not positions[n:].any(), k
    assert np.allclose(positions[:n], t.of(k, "position"), rtol=tolerance, atol=0), k


# OVITO and chemfiles read decimals by code of their own that misses the nearest double by some of its last bits
last_bits = 1e-15


def ovito(directory):
    import numpy as np
    try:
        from ovito.io import import_file
    except ImportError as e:
        skip(e)
    t = Trajectory(directory)
    for file in ("as-extxyz", "traj.gsd"):
        if not os.path.exists(directory + "/" + file):
            continue
        pipeline = import_file(directory + "/" + file)
        assert pipeline.source.num_frames == len(t.time), file
        for k in range(len(t.time)):
            found = pipeline.compute(k).particles
            assert found.count == t.points[k], (file, k)
            single = file == "traj.gsd"
            assert np.allclose(found.positions[...], t.of(k, "position"), rtol=2e-7 if single else last_bits, atol=0)
            if single:
                assert found.bonds.count == t.points[k] - 1
                continue
            assert not any(word in found for word in ("Radius", "Mass", "Charge", "Stress Tensor")), list(found)
            for there, here in renamed.items():
                name = {"velo": "Velocity", "id": "Particle Identifier"}.get(there, there)
                assert np.allclose(found[name][...], t.of(k, here), rtol=last_bits, atol=0), (there, k)


def MDAnalysis(directory):
    import numpy as np
    try:
        import MDAnalysis
    except ImportError as e:
        skip(e)
    t = Trajectory(directory)
    universe = MDAnalysis.Universe(directory + "/as-xyz", format="XYZ")
    assert len(universe.trajectory) == len(t.time) and len(universe.atoms) == t.points.max()
    for k, frame in enumerate(universe.trajectory):
        check_padded(frame.positions, t, k, 2e-7)  # single precision


def chemfiles(directory):
    import numpy as np
    try:
        import chemfiles
    except ImportError as e:
        skip(e)
    t = Trajectory(directory)
    with chemfiles.Trajectory(directory + "/as-extxyz", "r", "XYZ") as frames:
        assert frames.nsteps == len(t.time)
        for k in range(len(t.time)):
            frame = frames.read()
            assert np.allclose(frame.positions, t.of(k, "position"), rtol=last_bits, atol=0), k
            for there, here in renamed.items():
                found = np.array([atom[there] for atom in frame.atoms])
                assert np.allclose(found, t.of(k, here), rtol=last_bits, atol=0), (there, k)


def gsd(directory):
    import numpy as np
    try:
        import gsd.hoomd
    except ImportError as e:
        skip(e)
    t = Trajectory(directory)
    export(directory, "gsd")
    with gsd.hoomd.open(directory + "/traj.gsd") as frames:
        assert len(frames) == len(t.time)
        for k, frame in enumerate(frames):
            n = t.points[k]
            assert frame.particles.N == n and frame.bonds.N == n - 1 and frame.log["time"][0] == t.time[k]
            for there, here, factor in (("position", "position", 1), ("velocity", "velocity", 1), ("charge", "charge", 1),
                                        ("mass", "mass", 1), ("diameter", "radius", 2)):
                # single precision
                assert np.allclose(getattr(frame.particles, there), factor * t.of(k, here), rtol=2e-7, atol=0), (there, k)
            assert np.array_equal(frame.log["particles/stress"], t.of(k, "stress"))
            assert np.array_equal(frame.log["particles/id"], t.of(k, "id"))
            assert frame.bonds.group[:, 1].tolist() == list(range(1, n)) and frame.particles.typeid[-1] == 1


def export(directory, to):
    """By the package of the checkout, in this Python, which has the library."""
    from pathlib import Path
    sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "python"))
    import treejet
    from treejet.export import export as write
    write(treejet.read(directory), to, force=True)


def vtkhdf(directory):
    import numpy as np
    try:
        from vtkmodules.vtkIOHDF import vtkHDFReader
        from vtkmodules.vtkCommonCore import vtkVersion
        from vtkmodules.util.numpy_support import vtk_to_numpy
    except ImportError as e:
        skip(e)
    if (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) < (9, 3):
        skip("polylines over time need VTK 9.3, here is " + vtkVersion.GetVTKVersion())
    t = Trajectory(directory)
    export(directory, "vtkhdf")
    reader = vtkHDFReader()
    reader.SetFileName(directory + "/traj.vtkhdf")
    reader.UpdateInformation()
    assert reader.GetNumberOfSteps() == len(t.time)
    for k in range(len(t.time)):
        reader.SetStep(k)
        reader.Update()
        jet = reader.GetOutputDataObject(0)
        assert reader.GetTimeValue() == t.time[k]
        assert jet.GetNumberOfLines() == 1 and jet.GetNumberOfCells() == 1 and jet.GetCell(0).GetNumberOfPoints() == t.points[k]
        assert np.array_equal(vtk_to_numpy(jet.GetPoints().GetData()), t.of(k, "position"))
        check_point_data(jet.GetPointData(), t, k, lambda name: name)


def numpy(directory):
    """The table of statdat.dat by the two readers people use, with its header."""
    import numpy as np
    t = Trajectory(directory)
    rows = np.genfromtxt(directory + "/statdat.dat", names=True)
    assert len(rows.dtype.names) == 5 and [name[0] for name in rows.dtype.names] == list("txnsv")
    assert np.array_equal(rows[rows.dtype.names[1]], t.file["observables/x/value"])


def pandas(directory):
    try:
        import pandas
    except ImportError as e:
        skip(e)
    t = Trajectory(directory)
    with open(directory + "/statdat.dat") as file:
        names = file.readline().lstrip("#").split()
    table = pandas.read_csv(directory + "/statdat.dat", sep=r"\s+", comment="#", names=names)
    assert list(table) == ["t[s]", "x[cm]", "n[1]", "st[g/(cm*s^2)]", "vc[cm/s]"]
    assert list(table["x[cm]"]) == list(t.file["observables/x/value"])
    points = pandas.read_csv(directory + "/as-csv")
    assert list(points.groupby("frame").size()) == list(t.points)


def check_point_data(data, t, k, name_of):
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    found = {name_of(data.GetArrayName(i)): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    for name in (*scalars, "velocity", "id"):
        assert np.array_equal(found[name], t.of(k, name)), (name, k)


def vtk(directory):
    import xml.etree.ElementTree as xml
    import numpy as np
    try:
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
        from vtkmodules.util.numpy_support import vtk_to_numpy
    except ImportError as e:
        skip(e)
    t = Trajectory(directory)
    series = xml.parse(directory + "/as-vtp").getroot().findall("Collection/DataSet")
    assert [float(s.get("timestep")) for s in series] == list(t.time)
    for k, entry in enumerate(series):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(directory + "/" + entry.get("file"))
        reader.Update()
        jet = reader.GetOutput()
        assert jet.GetNumberOfLines() == 1 and jet.GetCell(0).GetNumberOfPoints() == t.points[k]
        assert np.array_equal(vtk_to_numpy(jet.GetPoints().GetData()), t.of(k, "position"))
        check_point_data(jet.GetPointData(), t, k, lambda name: name)


def xdmf(directory):
    import numpy as np
    try:
        from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
        from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
        from vtkmodules.util.numpy_support import vtk_to_numpy
    except ImportError as e:
        skip(e)
    t = Trajectory(directory)
    reader = vtkXdmfReader()
    reader.SetFileName(directory + "/traj.xdmf")
    reader.UpdateInformation()
    about = reader.GetOutputInformation(0)
    steps = Pipeline.TIME_STEPS()
    assert [about.Get(steps, i) for i in range(about.Length(steps))] == list(t.time)
    for k in range(len(t.time)):
        reader.UpdateTimeStep(t.time[k])
        jet = reader.GetOutputDataObject(0)
        while jet.IsA("vtkMultiBlockDataSet"):
            jet = jet.GetBlock(0)
        assert jet.GetNumberOfCells() == 1 and jet.GetCell(0).GetNumberOfPoints() == t.points[k]
        # this reader keeps points in single precision
        assert np.allclose(vtk_to_numpy(jet.GetPoints().GetData()), t.of(k, "position"), rtol=1e-6, atol=0)
        check_point_data(jet.GetPointData(), t, k, lambda name: name.split(" ")[0])


if __name__ == "__main__":
    os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
    if sys.argv[1] == "make":
        make(*sys.argv[2:])
    else:
        known = (h5py, h5dump, ase, vtk, xdmf, ovito, MDAnalysis, chemfiles, gsd, vtkhdf, numpy, pandas)
        {reader.__name__: reader for reader in known}[sys.argv[1]](sys.argv[2])
    print("read")
