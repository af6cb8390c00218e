"""The tables that the C++ is compared with are those of the independent program beside them."""

import importlib.util
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

VALIDATION = Path(__file__).resolve().parents[2]
DECKS = {"case3": VALIDATION.parent / "examples/pvp/input.dat", "rich": VALIDATION / "decks/rich.dat"}


@pytest.fixture(scope="module")
def independent():
    spec = importlib.util.spec_from_file_location("independent_jet", VALIDATION / "reference/independent_jet.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("name", DECKS)
def test_the_slopes_of_a_table_are_those_of_its_states(independent, name):
    path = VALIDATION / f"reference/independent-{name}.csv"
    table = np.loadtxt(path, delimiter=",", skiprows=2)
    anew = np.array([[float(x) for x in row.split(",")] for row in independent.with_slopes(independent.read_deck(DECKS[name]), path)])
    assert np.array_equal(anew[:, :10], table[:, :10])
    # 13 digits of the states, of which differences of neighbours leave 11
    assert np.all(abs(anew - table).max(axis=0) <= 1e-11 * abs(table).max(axis=0))


def test_a_run_of_the_independent_program_gives_the_table(independent):
    pytest.importorskip("scipy")
    jet = independent.Jet(independent.read_deck(DECKS["rich"]))
    table = np.loadtxt(VALIDATION / "reference/independent-rich.csv", delimiter=",", skiprows=2)
    table = table[table[:, 0] == 1e-3]
    jet.to(1e-3)
    assert jet.number == list(table[:, 1])
    # another version of SciPy may round otherwise: its tolerance, 1e-11 a step, over a thousand steps
    assert abs(jet.r - table[:, 3:6]).max() < 1e-8


def test_the_error_that_a_second_run_tells_is_the_error_of_the_first(tmp_path):
    settings = ["tolerance 1e-6", "final time 0.02", "print time 0.005", "printstat list t x y z vx vy vz cpu"]
    command = [os.environ["TREEJET"], "run", DECKS["case3"], "--out", tmp_path, "--estimate-error"]
    run = subprocess.run(command + [word for s in settings for word in ("--set", s)], check=True, capture_output=True, text=True)
    found, told = (np.loadtxt(tmp_path / name) for name in ("statdat.dat", "statdat.error.dat"))
    assert told.shape[1] == found.shape[1] - 1  # without the wall clock
    table = np.loadtxt(VALIDATION / "reference/independent-case3.csv", delimiter=",", skiprows=2)
    for t in (0.005, 0.01, 0.02):
        oldest = table[table[:, 0] == t][0, 3:9]
        row = int(np.argmin(abs(found[:, 0] - t)))
        error, estimate = found[row, 1:7] - oldest, told[row, 1:7]
        # what is left is the error of the second run, by the tolerances a tenth
        assert abs(error - estimate)[:3].max() < 0.1 * abs(error)[:3].max()
        assert abs(error - estimate)[3:].max() < 0.1 * abs(error)[3:].max()
    recorded = json.loads((tmp_path / "run.json").read_text())["error_estimate"]
    assert recorded["observables"]["x[cm]"]["row"] == abs(told[:, 1]).max()
    of_x, summary = recorded["observables"]["x[cm]"], json.loads((tmp_path / "run.json").read_text())["means"]["x"]
    assert of_x["mean"] == summary["mean"]  # one rule for both
    assert of_x["steady"] == summary["steady"]
    label, of_a_row, mean, of_mean, *rest = next(line for line in run.stdout.splitlines() if line.strip().startswith("x[cm]")).split()
    assert (of_a_row, mean, of_mean) == (f"{of_x['row']:.2g}", f"{of_x['mean']:.8g}", f"{of_x['of_mean']:.2g}")
    assert ("steady" in rest) != of_x["steady"] and str(of_x["from_row"]) in rest
    rows = told[of_x["from_row"] :, 1]
    assert len(rows) == summary["values"]
    assert of_x["of_mean"] == pytest.approx(abs(rows.mean()), rel=1e-12)
    assert subprocess.run(command, capture_output=True).returncode == 4  # what is there stays
    # neither is that of a longer run
    extended = [os.environ["TREEJET"], "run", "--resume", tmp_path, "--quiet", "--set", "final time 0.0201"]
    subprocess.run(extended, check=True)
    assert not (tmp_path / "statdat.error.dat").exists()
    assert "error_estimate" not in json.loads((tmp_path / "run.json").read_text())
