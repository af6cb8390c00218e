"""Steady means on series whose answers are known in closed form."""

import json
import math

import numpy as np
import pytest
from treejet.means import block_error, mser_start, steady_mean
from treejet.observables import Observables
from treejet.means import steady_means

SERIES = 200


def autoregressive(phi, count, seed):
    """x_k = phi x_{k-1} + noise, stationary with variance 1."""
    rng = np.random.default_rng(seed)
    noise = math.sqrt(1 - phi**2) * rng.standard_normal(count)
    x = np.empty(count)
    x[0] = rng.standard_normal()
    for k in range(1, count):
        x[k] = phi * x[k - 1] + noise[k]
    return x


def exact_error(phi, count):
    """Of the mean: variance (1 + 2 sum (1 - k/n) phi^k) / n."""
    k = np.arange(1, count)
    return math.sqrt((1 + 2 * ((1 - k / count) * phi**k).sum()) / count)


@pytest.mark.parametrize("phi", [0.0, 0.5, 0.9])
def test_block_averaging_finds_the_error_of_correlated_series(phi):
    count = 4000
    found = np.array([block_error(autoregressive(phi, count, seed))[0] for seed in range(SERIES)])
    assert np.isfinite(found).all()
    # bias of blocks of B: about correlation time / B, which the rule keeps below a tenth here (0.9: time 19, B near 100)
    assert math.sqrt((found**2).mean()) == pytest.approx(exact_error(phi, count), rel=0.1)


@pytest.mark.parametrize("phi", [0.0, 0.9])
def test_two_errors_cover_the_true_mean_as_often_as_they_should(phi):
    inside = 0
    for seed in range(SERIES):
        error = block_error(x := autoregressive(phi, 4000, 1000 + seed))[0]
        inside += abs(x.mean()) < 2 * error
    # 95.4 % of a normal distribution, less for errors known to a tenth; 200 tries scatter by 1.5 %
    assert 0.90 <= inside / SERIES <= 0.99


def test_a_series_too_short_for_independent_blocks_has_no_error():
    assert math.isnan(block_error(np.cumsum(np.ones(40)))[0])
    assert math.isnan(block_error(np.array([1.0, 2.0, 3.0]))[0])


def test_the_transient_is_cut_off_and_not_much_more():
    starts = []
    for seed in range(50):
        x = 0.01 * autoregressive(0.5, 1000, seed) + 5 * np.exp(-np.arange(1000) / 20)
        starts.append(start := mser_start(x))
        # what the transient leaves in the mean: 5 * 20 exp(-start / 20) / m, below the noise's own error 5e-4
        assert 5 * 20 * math.exp(-start / 20) / (1000 - start) < 5e-4
    assert np.median(starts) < 300


def test_a_stationary_series_is_kept_almost_whole():
    starts = [mser_start(autoregressive(0.5, 1000, seed)) for seed in range(50)]
    assert np.median(starts) <= 100


def test_a_drift_is_not_steady_and_noise_is():
    assert not steady_mean(np.linspace(0, 1, 400) + 0.01 * np.random.default_rng(3).standard_normal(400)).steady
    # 3 errors of the difference are exceeded in 0.3 % of cases, more with errors that are estimates
    assert sum(steady_mean(autoregressive(0.5, 1000, seed)).steady for seed in range(100)) >= 95


def test_windows_without_a_value_are_passed_over():
    x = 3 + 0.1 * autoregressive(0.0, 600, 7)
    x[:100] = np.nan
    x[::7] = np.nan
    m = steady_mean(x)
    # 5 errors of some 430 values
    assert m.mean == pytest.approx(3, abs=5 * 0.1 / math.sqrt(400)) and m.start >= 100 and m.steady
    nothing = steady_mean(np.full(50, np.nan))
    assert math.isnan(nothing.mean) and not nothing.steady


def test_constants_and_counts_that_alternate_are_steady_with_their_mean():
    constant = steady_mean(np.full(100, 0.1))
    assert constant.mean == pytest.approx(0.1, rel=1e-15) and constant.error < 1e-16 and constant.steady
    alternating = steady_mean(np.tile([148.0, 149.0], 50))
    assert alternating.mean == pytest.approx(148.5, abs=0.02) and alternating.steady


def test_means_leave_out_clocks_and_the_state_at_the_start():
    t = np.arange(101.0)
    table = Observables({"t": t, "x": np.r_[1e9, np.full(100, 2.0)], "cpu": t}, {"t": "s", "x": "cm", "cpu": "s"})
    assert steady_means(table).keys() == {"x"} and steady_means(table)["x"].mean == 2 and steady_means(table)["x"].start >= 1


def test_the_program_finds_the_means_that_this_package_finds_in_its_files(jet):
    record = json.loads((jet.directory / "run.json").read_text())
    ours = steady_means(jet.observables)
    time = jet.observables["t"]
    assert {"n", "vc", "curc", "x"} <= record["means"].keys() <= {k for k, m in ours.items() if m.values}
    for key, theirs in record["means"].items():
        m = ours[key]
        # a value that no longer changes: where rounding puts the least variance does not matter
        if key in ("vn", "vc", "rc", "rrr"):
            assert theirs["mean"] == pytest.approx(m.mean, rel=1e-9)
            continue
        assert (theirs["values"], theirs["block"], theirs["steady"], theirs["from"]) == (m.values, m.block, m.steady, time[m.start])
        # sums in another order: some 40 values
        assert theirs["mean"] == pytest.approx(m.mean, rel=1e-13)
        assert theirs["error"] is None and math.isnan(m.error) or theirs["error"] == pytest.approx(m.error, rel=1e-9)


def test_the_record_of_a_run_tells_its_effort_and_where_its_time_went(jet):
    record = json.loads((jet.directory / "run.json").read_text())
    effort, segment = record["effort"], record["segments"][-1]
    assert effort["inserted"] - effort["arrived"] + 1 == effort["beads"] == jet.observables["n"][-1]
    assert effort["evaluations"] > effort["steps"] > 100
    assert segment["gatherings"] == 0 and 0 < segment["compute"] <= segment["wall_seconds"]
    work = segment["work"]
    assert {"steps", "local", "evaluate", "exchange", "output"} < work.keys() and min(work.values()) >= 0
    assert work["steps"] > 0 and work["exchange"] == 0  # a rank that is alone sends nothing
    assert 0.5 * segment["compute"] < sum(work.values()) <= segment["compute"]


def test_a_value_that_is_tended_to_without_noise_is_steady_once_the_rest_is_a_millionth():
    t = np.arange(400)
    assert steady_mean(5 + np.exp(-t / 10)).steady
    assert not steady_mean(5 + np.exp(-t / 200)).steady
