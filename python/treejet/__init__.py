"""Treejet from Python: run decks, read what came out, sweep parameters, look at jets.

    import treejet
    run = treejet.run("input.dat", out="results", final_time=0.1)
    run.frames[-1].position          # cm; beads oldest first, the nozzle last
    run.observables.to("rc", "um")   # any unit
    treejet.sweep("input.dat", {"external potential": ["6 kV", "9 kV", "12 kV"]}, out="sweep", jobs=2)

The program is found in $TREEJET, on PATH or in build/release of the checkout. Its errors arrive as TreejetError with
the program's own message and exit code.
"""

from .compare import Difference, compare, difference
from .converge import Convergence, converge
from .deck import Deck
from .errors import FileError, InputError, TreejetError
from .frames import Frame
from .means import SteadyMean, steady_mean, steady_means
from .observables import Observables
from .program import call, extend, find, run
from .read import Run, read
from .spectrum import Spectrum, spectrum
from .sweep import Point, sweep
from .units import convert

__all__ = [
    "Convergence", "Deck", "Difference", "FileError", "Frame", "InputError", "Observables", "Point", "Run", "Spectrum", "SteadyMean",
    "TreejetError", "call", "compare", "converge", "convert", "difference", "extend", "find", "read", "run", "spectrum", "steady_mean",
    "steady_means", "sweep",
]
