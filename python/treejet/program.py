"""The program itself: where it is, and how it is run."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path
from typing import Optional, Union

from .deck import Deck
from .errors import FileError, TreejetError
from .read import Run, read

DeckLike = Union[str, "os.PathLike[str]", Deck]


def find() -> str:
    """The program: $TREEJET, else `treejet` on PATH, else build/release/treejet of the checkout this file is in."""
    named = os.environ.get("TREEJET")
    if named:
        if not (os.path.isfile(named) and os.access(named, os.X_OK)):
            raise FileError(f"TREEJET names {named}, which is no program")
        return named
    built = Path(__file__).resolve().parents[2] / "build" / "release" / "treejet"
    found = shutil.which("treejet") or (str(built) if built.exists() else None)
    if not found:
        raise FileError("the program treejet is neither in $TREEJET, nor on PATH, nor built in build/release")
    return found


def call(*arguments: str) -> str:
    """What the program prints, e.g. `call("reference")`; TreejetError with its own message if it fails."""
    done = subprocess.run([find(), *arguments], capture_output=True, text=True, errors="replace")
    if done.returncode:
        raise failure(done.stderr, done.returncode)
    return done.stdout


def failure(said: str, exit_code: int) -> TreejetError:
    """The error of a run, from what it said on its way out; of one that a signal has ended, 128 and the signal's number."""
    if exit_code < 0:
        name = signal.Signals(-exit_code).name
        why = "; out of memory?" if name == "SIGKILL" else ""
        return TreejetError(f"treejet was ended by {name}{why}" + (f": {said.strip()}" if said.strip() else ""), 128 - exit_code)
    return TreejetError(said.strip().removeprefix("treejet: ") or f"treejet ended with exit code {exit_code}", exit_code)


def override(name: str, value: object) -> str:
    """A line for --set.

    >>> override("external_potential", "6 kV"), override("gravity", True), override("viscosity", 20.0)
    ('external potential 6 kV', 'gravity yes', 'viscosity 20.0')
    """
    return f"{name.replace('_', ' ')} {word(value)}"


def word(value: object) -> str:
    """As a deck has it."""
    return {True: "yes", False: "no"}[value] if isinstance(value, bool) else str(value)


def run_arguments(deck: str, out: str, overrides: "list[str]", threads: Optional[int], force: bool) -> "list[str]":
    words = ["run", deck, "--out", out, "--quiet"]
    for line in overrides:
        words += ["--set", line]
    if threads:
        words += ["--threads", str(threads)]
    return words + ["--force"] * force


def run(deck: DeckLike, out: Union[str, "os.PathLike[str]"], threads: Optional[int] = None, force: bool = False,
        begin_with: Union[str, "os.PathLike[str]", None] = None, **overrides: object) -> Run:
    """Runs a deck and returns what came out.

    `deck` is a file, or a Deck (of another run, or made from text). Overrides are directives with _ for blanks, as
    strings with their unit, or bare numbers in CGS:

        treejet.run("input.dat", out="r12", external_potential="12 kV", final_time=0.1)

    `begin_with="other"`, or `"other@60ms"`, takes the jet of another run instead of the deck's initial one.

    TreejetError with the program's own message and exit code if it fails; the files are complete up to there.
    """
    lines = [override(name, value) for name, value in overrides.items()]
    source = ["--from", os.fspath(begin_with)] if begin_with is not None else []
    if not isinstance(deck, Deck):
        call(*run_arguments(os.fspath(deck), os.fspath(out), lines, threads, force), *source)
        return read(out)
    with tempfile.TemporaryDirectory() as directory:
        written = Path(directory) / (Path(deck.name).name or "deck.dat")
        written.write_text(deck.text)
        call(*run_arguments(str(written), os.fspath(out), deck.overrides + lines, threads, force), *source)
    return read(out)


def extend(run: Union[str, "os.PathLike[str]"], final_time: object) -> Run:
    """Takes the run in a directory to a later end, with the files of one that had it at once: `extend("r12", "0.2 s")`."""
    call("run", "--resume", os.fspath(run), "--quiet", "--set", override("final_time", final_time))
    return read(run)
