"""The tables that the C++ is compared with are those of the independent program beside them."""

import importlib.util
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
