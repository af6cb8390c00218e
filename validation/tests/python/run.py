#!/usr/bin/python3
"""pytest on this folder; exit code 77, which ctest takes for skipped, where a module it needs is not installed."""

import importlib.util
import subprocess
import sys
from pathlib import Path

missing = [m for m in ("pytest", "numpy", "h5py", "matplotlib") if importlib.util.find_spec(m) is None]
if missing:
    print("SKIPPED: no", ", ".join(missing), "for", sys.executable)
    sys.exit(77)
here = Path(__file__).resolve().parent
sys.exit(subprocess.run([sys.executable, "-B", "-m", "pytest", "-q", "-rs", "-p", "no:cacheprovider", str(here)]).returncode)
