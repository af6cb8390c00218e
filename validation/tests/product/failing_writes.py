#!/usr/bin/env python3
"""Every failing write of every format ends with exit code 4, one line that names the file, and files to go on with.

    failing_writes.py TREEJET SHIM DECK DIRECTORY

SHIM (failing_writes.c) lets the n-th write to a file go wrong, with a full disk, a file too large or a device that
fails in turn. A run that failed is resumed without it, and its files are those of a run left alone.
"""

import errno
import filecmp
import itertools
import os
import shutil
import subprocess
import sys
from pathlib import Path

program, shim, deck, work = (Path(a) for a in sys.argv[1:5])
errors = itertools.cycle([errno.ENOSPC, errno.EFBIG, errno.EIO])
failures = []
formats = [("xyz", "xyz"), ("extxyz", "xyz"), ("csv", "csv"), ("vtp", "vtp")]


def check(holds, what):
    if not holds:
        failures.append(what)
        print("FAILED:", what)


def call(arguments, file="", at=0, with_error=0, sync="", once=""):
    """The finished process, and how many writes to the file it made."""
    log = work / "writes"
    log.unlink(missing_ok=True)
    made = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, errors="replace",
                          env=dict(os.environ, LD_PRELOAD=str(shim), FAIL_FILE=file, FAIL_AT=str(at),
                                   FAIL_WITH=str(with_error), FAIL_SYNC=sync, FAIL_ONCE=once, FAIL_LOG=str(log)))
    return made, int(log.read_text().split()[0]) if log.exists() else 0


def run(out):
    """A run with all outputs, and a checkpoint before the first step and at each flush."""
    return ["run", deck, "--out", out, "--quiet", "--threads", 1, "--set", "final time 1.d-3", "--set", "print time 1.d-4",
            "--set", "print xyz 1.d-4", "--set", "print xyz maxnum 12", "--set", "print hdf5 1.d-4", "--set", "checkpoint 1"]


def some_of(count):
    """The first writes, one on the way, the last."""
    return sorted({n for n in (1, 2, count // 2, count) if 0 < n <= count})


def expect_right_end(made, what, name):
    lines = made.stderr.strip().splitlines()
    check(made.returncode == 4, f"{what}: exit code {made.returncode}, expected 4: {made.stderr}")
    check(len(lines) == 1, f"{what}: {len(lines)} lines of message, expected one: {lines}")
    check(name in made.stderr, f"{what}: the message does not name {name}: {lines}")


def same_files(a, b):
    """Of two directories, but for the record of where and when."""
    names = [sorted(p.name for p in d.iterdir()) for d in (a, b)]
    return names[0] == names[1] and all(filecmp.cmp(a / n, b / n, shallow=False) for n in names[0] if n not in ("run.json", "checkpoint.end"))  # both hold wall-clock times


def failing_runs(whole):
    # what a file is called while it is written, and what the message may call it
    for name, called in [("statdat.dat", "statdat.dat"), ("traj.xyz", "traj.xyz"), ("traj.h5.next", "traj.h5"),
                         ("traj.xdmf.next", "traj.xdmf"), ("checkpoint.new", "checkpoint"), ("run.json.next", "run.json")]:
        counted = work / "counted"
        shutil.rmtree(counted, ignore_errors=True)
        made, count = call(run(counted), name)
        check(made.returncode == 0 and count > 0, f"{name}: {count} writes, exit code {made.returncode}: {made.stderr}")
        for n in some_of(count):
            out = work / "failed"
            shutil.rmtree(out, ignore_errors=True)
            error = next(errors)
            what = f"write {n} of {count} to {name} with {errno.errorcode[error]}"
            made, _ = call(run(out), name, n, error)
            expect_right_end(made, what, called)
            # the twin of traj.h5 stays, as a killed run leaves it
            leftovers = [p.name for p in out.iterdir() if p.name.endswith((".next", ".new")) and p.name != "traj.h5.next"]
            check(not leftovers, f"{what}: leaves {leftovers}")
            if (out / "checkpoint").exists():
                made, _ = call(["run", "--resume", out, "--quiet"])
                check(made.returncode == 0, f"resuming after {what}: exit code {made.returncode}: {made.stderr}")
                check(same_files(out, whole), f"resumed after {what}: other files than of a run left alone")


def frames_of(run):
    """Those of its trajectory, as text."""
    table = work / "frames.csv"
    made, _ = call(["convert", run / "traj.h5", "--to", "csv", "--out", table, "--force"])
    check(made.returncode == 0, f"convert {run}: {made.stderr}")
    return table.read_text()


def runs_that_fail_once(whole):
    """A write that fails is told even if the next ones go through; what was in the trajectory before stays in it."""
    out, tried, frames = work / "once", 40, frames_of(whole)
    made, count = call(run(out), "traj.h5.next")
    for n in sorted({1 + k * count // tried for k in range(tried)}):
        shutil.rmtree(out, ignore_errors=True)
        what = f"write {n} of {count} to traj.h5.next alone"
        made, _ = call(run(out), "traj.h5.next", n, errno.ENOSPC, once="1")
        if made.returncode == 0:  # what has been written again, or was not needed any more
            check(same_files(out, whole), f"{what}: exit code 0, and other files than of a run left alone")
            continue
        expect_right_end(made, what, "traj.h5")
        if (out / "traj.h5").exists():
            check(frames.startswith(frames_of(out)), f"{what}: other frames than the first ones of a run left alone")
        if (out / "checkpoint").exists():
            made, _ = call(["run", "--resume", out, "--quiet"])
            check(made.returncode == 0, f"resuming after {what}: exit code {made.returncode}: {made.stderr}")
            check(same_files(out, whole), f"resumed after {what}: other files than of a run left alone")


def failing_conversions(whole):
    for to, ending in formats:
        target = work / f"converted.{to}"
        arguments = ["convert", whole / "traj.h5", "--to", to, "--out", target, "--force"]
        for file in [f".{to}", ".vtp", ".pvd"] if to == "vtp" else [f".{to}"]:
            made, count = call(arguments, file)
            check(made.returncode == 0, f"convert --to {to}: exit code {made.returncode}: {made.stderr}")
            for n in some_of(count):
                error = next(errors)
                made, _ = call(arguments, file, n, error)
                expect_right_end(made, f"convert --to {to}, write {n} of {count} to {file} with {errno.errorcode[error]}", "convert")


def failing_fields():
    points, out = work / "points.csv", work / "field.csv"
    points.write_text("x,y,z,q\n" + "".join(f"{k},{k % 7},0,1\n" for k in range(200)))
    arguments = ["field", points, "--out", out, "--force"]
    made, count = call(arguments, "field.csv")
    check(made.returncode == 0 and count > 0, f"field: {count} writes, exit code {made.returncode}: {made.stderr}")
    for n in some_of(count):
        error = next(errors)
        made, _ = call(arguments, "field.csv", n, error)
        expect_right_end(made, f"field, write {n} of {count} with {errno.errorcode[error]}", "field.csv")


def failing_to_reach_the_disk():
    """A checkpoint that may still be in memory must not take the place of one that is on the disk."""
    out = work / "not-on-disk"
    made, _ = call(run(out), "checkpoint.new", 0, errno.EIO, sync="1")
    expect_right_end(made, "a checkpoint that cannot be forced to disk", "checkpoint")
    check(not list(out.glob("checkpoint*")), f"a checkpoint that is not on the disk is in place: {list(out.iterdir())}")


shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
whole = work / "whole"
made, _ = call(run(whole))
check(made.returncode == 0, f"a run left alone: exit code {made.returncode}: {made.stderr}")
failing_runs(whole)
runs_that_fail_once(whole)
failing_conversions(whole)
failing_fields()
failing_to_reach_the_disk()
sys.exit(1 if failures else 0)
