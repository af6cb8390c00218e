"""One of three ranks that hold a jet in subdomains is killed (SIGKILL) at random moments, from before MPI_Init on; every other
time not before there is a checkpoint.

Each time the launcher ends within ten seconds, always with one and the same code, not 0, and no rank is left; the run goes on
from its checkpoint, or from the start if there was none yet, and once it is left alone it ends with the bytes of a run that
nobody killed.

    kills.py TREEJET SOURCE_TREE MPIEXEC NUMPROC_FLAG --kills N [--seed S]
"""

import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

RANKS = 3
PATIENCE = 10  # s, for the launcher and the other ranks to end
HANGS = 240  # s, for a run that nobody kills: it takes one or two
FILES = ["statdat.dat", "traj.xyz", "traj.h5", "traj.xdmf"]
DECK = """tolerance 1.d-6
points 240
coulomb tree
coulomb accuracy 1.d-4
parallel distributed
checkpoint 0.02
finish
"""
# a container's root may start Open MPI, on more ranks than cores
ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMP_WAIT_POLICY": "passive",
    "ASAN_OPTIONS": "detect_leaks=0",
}


class Runs:
    def __init__(self, arguments, work):
        self.treejet, self.mpi = arguments.treejet, [arguments.mpiexec, arguments.flag, str(RANKS)]
        self.deck, self.pids, self.killed = work / "deck.dat", work / "pids", work / "killed"
        lines = (pathlib.Path(arguments.source) / "validation/decks/stream.dat").read_text().splitlines()
        words = [line.split()[0] for line in DECK.splitlines()]
        self.deck.write_text("\n".join(line for line in lines if line.split()[0] not in words) + "\n" + DECK)

    def start(self, directory):
        """A new run, or one that goes on; its ranks leave their process ids."""
        resumed = any((directory / name).exists() for name in ("checkpoint", "checkpoint.old"))
        what = ["--resume", directory] if resumed else [self.deck, "--out", directory, "--force"]
        shutil.rmtree(self.pids, ignore_errors=True)
        self.pids.mkdir()
        wrapped = ["sh", "-c", 'echo $$ >"$0/$$.new" && mv "$0/$$.new" "$0/$$" && exec "$@"', self.pids, self.treejet]
        command = [*self.mpi, *wrapped, "run", *what, "--quiet", "--threads", "1"]
        launcher = subprocess.Popen(
            [str(c) for c in command],
            env=os.environ | ENVIRONMENT,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        return launcher, resumed

    def ranks(self):
        return sorted(int(p.name) for p in self.pids.iterdir() if p.suffix == "")

    def alone(self, directory):
        """Nobody kills it: how long it takes, and whether it goes on from a checkpoint."""
        begin = time.monotonic()
        launcher, resumed = self.start(directory)
        messages = launcher.communicate(timeout=HANGS)[1]
        if launcher.returncode != 0:
            sys.exit(f"FAILED: a run that nobody kills ends with {launcher.returncode}: {messages}")
        return time.monotonic() - begin, resumed


def is_running(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


def wait_until(condition, seconds):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.001)
    return True


class Tally:
    def __init__(self):
        self.kills = self.before = self.resumed = self.completed = self.slowest = 0
        self.codes, self.failures = set(), []


def life(runs, tally, chance, longest):
    """One life of the run; whether it came to its end before its time."""
    launcher, resumed = runs.start(runs.killed)
    tally.resumed += resumed
    begun = wait_until(lambda: len(runs.ranks()) == RANKS or launcher.poll() is not None, HANGS)
    if not begun or launcher.poll() is not None:
        launcher.kill()
        tally.failures.append(f"no rank to kill: {launcher.communicate()[1]}")
        return True
    if tally.kills % 2 == 1:  # every other kill finds a checkpoint, however fast the machine starts ranks
        wait_until(lambda: (runs.killed / "checkpoint").exists() or launcher.poll() is not None, HANGS)
    if wait_until(lambda: launcher.poll() is not None, chance.uniform(0, longest)):
        if launcher.returncode != 0:
            tally.failures.append(f"ends by itself with {launcher.returncode}: {launcher.communicate()[1]}")
        return True
    ranks = runs.ranks()
    victim = chance.randrange(RANKS)
    try:
        os.kill(ranks[victim], signal.SIGKILL)
    except ProcessLookupError:  # has just come to its end
        launcher.wait(PATIENCE)
        return launcher.returncode == 0
    killed = time.monotonic()
    try:
        launcher.communicate(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        tally.failures.append(f"the launcher lives {PATIENCE} s after rank {victim} was killed")
        launcher.kill()
        launcher.communicate()
    if not wait_until(lambda: not any(map(is_running, ranks)), PATIENCE):
        tally.failures.append(f"ranks run on after rank {victim} was killed")
        for pid in filter(is_running, ranks):
            os.kill(pid, signal.SIGKILL)
    if launcher.returncode == 0:
        return True  # it had come to its end, which its files have to show
    tally.slowest = max(tally.slowest, time.monotonic() - killed)
    tally.codes.add(launcher.returncode)
    tally.kills += 1
    tally.before += not (runs.killed / "checkpoint").exists()
    return False


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--kills", type=int, required=True)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args(sys.argv[5:])  # the launcher's flag looks like one of ours
    arguments.treejet, arguments.source, arguments.mpiexec, arguments.flag = sys.argv[1:5]
    chance = random.Random(arguments.seed)
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        runs, tally = Runs(arguments, work), Tally()
        whole = work / "whole"
        longest = 0.8 * runs.alone(whole)[0]
        while tally.kills < arguments.kills and not tally.failures:
            shutil.rmtree(runs.killed, ignore_errors=True)
            ended = False
            while tally.kills < arguments.kills and not ended:
                ended = life(runs, tally, chance, longest)
            if not ended:
                tally.resumed += runs.alone(runs.killed)[1]
            tally.completed += 1
            for name in FILES:
                if (runs.killed / name).read_bytes() != (whole / name).read_bytes():
                    tally.failures.append(f"{name} differs from that of a run that nobody killed")
    if tally.resumed == 0:
        tally.failures.append("no run has gone on from a checkpoint")
    if len(tally.codes) != 1:
        tally.failures.append(f"codes differ: {tally.codes}")
    print(
        f"{tally.kills} kills of one of {RANKS} ranks (seed {arguments.seed}), {tally.before} before there was a checkpoint: "
        f"codes {sorted(tally.codes)}, the last process gone after {tally.slowest:.2f} s at the most; "
        f"{tally.resumed} times gone on from a checkpoint, {tally.completed} runs completed"
    )
    for failure in tally.failures:
        print("FAILED:", failure)
    sys.exit(bool(tally.failures))


if __name__ == "__main__":
    main()
