#!/usr/bin/python3
"""Other people's readers read our files, to the bit.

    readers.py make TREEJET DECK DIR   run the deck with print hdf5 and convert its trajectory
    readers.py READER DIR              h5py, h5dump, ase, vtk, xdmf; exit code 77 where the reader is not installed
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
    sets = ["final time 6.d-3", "print time 1.d-3", "print hdf5 2.d-4", "collector distance 0.3"]
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
    rows = np.loadtxt(directory + "/statdat.dat")
    assert np.array_equal(rows[:, 0], x["time"]) and np.array_equal(rows[:, 1], x["value"])


def h5dump(directory):
    try:
        out = subprocess.run(["h5dump", "-d", "/particles/jet/id/value", directory + "/traj.h5"], check=True,
                             capture_output=True, text=True).stdout
    except FileNotFoundError as e:
        skip(e)
    assert "H5T_STD_I64LE" in out and "DATA" in out


def ase(directory):
    import numpy as np
    try:
        import ase.io
    except ImportError as e:
        skip(e)
    t = Trajectory(directory)
    for kind in ("extxyz", "xyz"):
        frames = ase.io.read(directory + "/as-" + kind, index=":", format="extxyz")
        assert len(frames) == len(t.time)
        for k, atoms in enumerate(frames):
            assert np.array_equal(atoms.positions, t.of(k, "position")), (kind, k)
            if kind == "extxyz":
                assert atoms.info["Time"] == t.time[k]
                assert np.array_equal(atoms.arrays["id"], t.of(k, "id"))
                assert np.array_equal(atoms.arrays["velocity"], t.of(k, "velocity"))
                assert np.array_equal(atoms.arrays["radius"], t.of(k, "radius"))


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
        {"h5py": h5py, "h5dump": h5dump, "ase": ase, "vtk": vtk, "xdmf": xdmf}[sys.argv[1]](sys.argv[2])
    print("read")
