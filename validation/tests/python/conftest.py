"""The package of the checkout and the program that was built; runs of the PVP jet that several tests read."""

import os
import sys
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(SOURCE / "python"))
os.environ.setdefault("TREEJET", str(SOURCE / "build" / "release" / "treejet"))
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

PVP = SOURCE / "examples" / "pvp" / "input.dat"
SHORT = {"print_time": "2e-4", "print_xyz": "4e-4", "print_hdf5": "4e-4", "final_time": "8e-3", "collector_distance": "0.3"}


@pytest.fixture(scope="session")
def deck():
    return PVP


@pytest.fixture(scope="session")
def jet(tmp_path_factory):
    """Long enough for beads to come and to go."""
    import treejet

    return treejet.run(PVP, tmp_path_factory.mktemp("runs") / "jet", threads=1, **SHORT)
