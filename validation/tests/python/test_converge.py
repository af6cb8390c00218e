"""Error budgets: known answers are found, what has no limit is said to have none, and why."""

import csv
import json
import math
import subprocess

import pytest
import treejet
from treejet.budget import cheapest, part
from treejet.levels import Direction, directions

STRAIGHT = {"final_time": "0.3", "print_time": "2e-3", "collector_distance": "20"}


@pytest.fixture
def straight(deck):
    return deck.parents[1] / "straight-jet" / "input.dat"


def halving(coarser=False):
    return Direction("space", 2.0, ({"initial length": "0.1"}, {"initial length": "0.2" if coarser else "0.05"}, {}), coarser=coarser)


@pytest.mark.parametrize("order", [1.0, 2.0, 3.5])
def test_an_error_that_is_a_power_of_the_step_is_found_with_its_order(order):
    steps = [0.1, 0.05, 0.025]
    found = part([7 + 3 * h**order for h in steps], [0, 0, 0], halving(), 1e-9)
    # exact but for round-off of differences of 1e-4 and more of numbers near 10
    assert found.order == pytest.approx(order, abs=1e-9) and found.error == pytest.approx(3 * 0.1**order, rel=1e-9)
    assert found.limit == pytest.approx(7, rel=1e-12)
    coarser = part([7 + 3 * h**order for h in (0.1, 0.2, 0.4)], [0, 0, 0], halving(coarser=True), 1e-9)
    assert coarser.order == pytest.approx(order, abs=1e-9) and coarser.error == pytest.approx(3 * 0.1**order, rel=1e-9)


def test_what_has_no_limit_is_told_from_what_is_noise():
    logarithm = [math.log(1 / h) for h in (0.1, 0.05, 0.025)]
    assert part(logarithm, [0, 0, 0], halving(), 1e-3).kind == "growing"
    assert part(logarithm, [2, 2, 2], halving(), 1e-3).kind == "noise"
    assert math.isnan(part(logarithm, [0, 0, 0], halving(), 1e-3).error)
    # the same differences are nothing to one who wants 100
    assert part(logarithm, [0, 0, 0], halving(), 100).kind == "small"
    assert part([1, math.nan, 2], [0, 0, 0], halving(), 1).kind == "failed"


def test_the_cheapest_setting_is_the_coarsest_that_keeps_what_is_wanted():
    way = halving()
    parts = {"space": part([1 + h**2 for h in (0.1, 0.05, 0.025)], [0, 0, 0], way, 1e-9)}  # error 1e-2 at 0.1
    for wanted, level in ((1.1e-2, 0), (0.9e-2, 1), (0.2e-2, 2), (0.05, -1)):
        found = cheapest([way], parts, {"space": 8.0}, 0.0, wanted, 0.0, 1.0, 10.0)
        assert float(found.directives["initial length"]) == pytest.approx(0.1 / 2**level) and found.error <= wanted
        assert found.seconds == pytest.approx(10 * 8.0**level * 0.25)  # a quarter of the time will do without noise
    assert cheapest([way], parts, {"space": 8.0}, 0.0, 1e-9, 0.0, 1.0, 10.0) is None
    # of 0.06 elements of 0.2 take 0.04, and 25 times the time makes 0.02 of an error of the mean of 0.1: 10 / 8 * 25 s; with
    # elements of 0.1 four times the time would do, but for 40 s
    longer = cheapest([way], parts, {"space": 8.0}, 0.1, 0.06, 0.0, 1.0, 10.0)
    assert float(longer.directives["final time"]) == pytest.approx(25) and longer.seconds == pytest.approx(31.25)


def test_levels_are_those_of_the_deck_and_tubes_stay_longer_than_their_diameter():
    tubes = {"tolerance": "1e-06", "initial length": "0.1", "points": "1", "inserting": "yes", "self field": "slender",
             "nozzle cross": "0.015", "dynamic refinement": "yes", "dynamic refinement tolerance": "0.02", "coulomb": "auto",
             "coulomb accuracy": "0.0001"}
    time, force, space = directions(tubes)
    assert [level["tolerance"] for level in time.levels] == ["1e-06", "1e-07", "1e-08"]
    assert [level["coulomb accuracy"] for level in force.levels] == ["0.0001", "1e-05", "1e-06"]
    # 0.03 is twice the radius
    assert [float(level["initial length"]) for level in space.levels] == pytest.approx([0.1, math.sqrt(0.1 * 0.03), 0.03])
    assert float(space.levels[2]["dynamic refinement tolerance"]) == pytest.approx(0.02 * 0.3**2)
    short = directions({**tubes, "initial length": "0.03"})[2]
    assert short.coarser and float(short.levels[1]["initial length"]) == pytest.approx(0.06)
    thread = directions({**tubes, "inserting": "no", "points": "100"})[2]
    assert [level["points"] for level in thread.levels] == ["100", "200", "400"]


def test_a_jet_fed_by_a_pump_is_within_its_budget_of_what_is_known(straight, tmp_path):
    found = treejet.converge(straight, ["current", "velocity"], tmp_path / "fed", model="slender", flow_rate=0.0636, **STRAIGHT)
    current, velocity = found.budgets["fcc"], found.budgets["vc"]
    known = 3761.26389 * 0.0636  # charge density times flow
    assert current.verdict.startswith("within 0.01") and current.total < 0.01 * known
    assert abs(current.mean.mean - known) <= current.total
    assert velocity.converged and velocity.parts["time"].order > 0.3 and velocity.total < 0.01 * velocity.mean.mean
    # all at once is what each alone has said, to the terms that they share
    assert abs(velocity.together - velocity.mean.mean) <= velocity.total
    assert not found.chaotic
    runs = found.runs
    errors = [abs(runs[name].means["vc"].mean - velocity.parts["time"].limit) for name in ("base", "time 1", "time 2")]
    assert errors[0] > errors[1] > errors[2]


def test_tubes_by_the_papers_rule_are_not_converged_as_the_rate_has_no_limit(straight, tmp_path):
    found = treejet.converge(straight, ["current"], tmp_path / "pull", self_field="slender", initial_length=0.2, **STRAIGHT)
    budget = found.budgets["fcc"]
    assert not budget.converged and "not converged in space" in budget.verdict and budget.cheapest is None
    assert budget.parts["time"].error < 1e-3 * budget.mean.mean  # of time steps it is well converged


def test_a_chaotic_jet_is_called_one_what_takes_too_long_is_given_up_and_a_short_run_is_unsteady(deck, tmp_path):
    thin = {"nozzle_cross": "2e-3", "density_charge": "300000", "collector_distance": "6", "initial_length": "0.01",
            "print_time": "1e-4"}
    found = treejet.converge(deck, ["aperture"], tmp_path / "thin", final_time="0.008", jobs=2, patience=4, **thin)
    assert found.chaotic and "chaotic" in found.budgets["angl"].verdict
    # elements of a quarter take 80 times as long as those of the deck
    assert "given up" in found.budgets["angl"].verdict and not found.budgets["angl"].converged
    short = treejet.converge(deck, ["path"], tmp_path / "short", final_time="4e-4", print_time="1e-5")
    assert "no steady state" in short.budgets["lp"].verdict and not short.chaotic


def test_a_setting_that_fails_is_the_verdict_and_ends_nothing(straight, tmp_path):
    found = treejet.converge(straight, ["current"], tmp_path / "out", feed="flow", flow_rate=0.0636, **STRAIGHT)
    assert found.budgets["fcc"].converged
    with pytest.raises(treejet.TreejetError, match="positive"):
        treejet.converge(straight, ["current"], tmp_path / "bad", viscosity=-1)
    with pytest.raises(treejet.InputError, match="steady mean"):
        treejet.converge(straight, ["aperture"], tmp_path / "bad")
    with pytest.raises(treejet.InputError, match="round-off"):
        treejet.converge(straight, ["current"], tmp_path / "bad", tolerance="1e-12")


def test_the_command_writes_text_table_record_and_picture_and_goes_on(straight, tmp_path):
    words = [treejet.find(), "converge", straight, "--quantities", "velocity, current", "--out", tmp_path / "out",
             "--set", "model slender", "--set", "flow rate: 0.0636"]
    words += [w for name, value in STRAIGHT.items() for w in ("--set", f"{name.replace('_', ' ')} {value}")]
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "cheapest for 0.01" in done.stdout and "the direct sum has none" in done.stdout
    with open(tmp_path / "out" / "converge.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    record = json.loads((tmp_path / "out" / "converge.json").read_text())
    assert [row["quantity"] for row in rows] == ["vc", "fcc"] == list(record["quantities"])
    for row in rows:
        its = record["quantities"][row["quantity"]]
        assert float(row["value"]) == its["value"] and float(row["total"]) == its["total"]
        assert its["total"] == pytest.approx(its["statistical error"] + sum(e["error"] for e in its["errors"].values()), rel=1e-12)
    assert (tmp_path / "out" / "converge.png").read_bytes().startswith(b"\x89PNG")
    kept = {k: (tmp_path / "out" / k / "run.json").stat().st_mtime_ns for k in ("001", "006")}
    assert subprocess.run(words, capture_output=True).returncode == 0
    assert {k: (tmp_path / "out" / k / "run.json").stat().st_mtime_ns for k in kept} == kept


def test_check_tells_the_directives_in_force(deck):
    words = ["--set", "model slender", "--set", "flow rate 60 mL/h", "--set", "initial length 300 um"]
    values = json.loads(treejet.call("check", str(deck), "--json", *words))["directives"]
    assert values["self field"] == "slender" and values["feed"] == "flow" and values["integrator"] == "auto"
    assert float(values["initial length"]) == pytest.approx(0.03) and float(values["flow rate"]) == pytest.approx(1 / 60)
    assert "timestep" not in values
