"""Sweeps: every point in its folder, none ends another, an interrupted one goes on."""

import csv
import json
import os
import signal
import statistics
import subprocess
import time

import pytest
import treejet
from treejet import sweep_plot
from treejet.sweep import from_csv, varied


@pytest.fixture
def quick(deck, tmp_path):
    """The PVP jet for 4 ms before a near collector."""
    text = deck.read_text().replace("final time 0.5d0", "final time 4.d-3").replace("print time 1.d-2", "print time 1.d-4")
    text = text.replace("collector distance 16.d0", "collector distance 0.2").replace("print xyz 1.d-4", "")
    (tmp_path / "quick.dat").write_text(text)
    return tmp_path / "quick.dat"


def table(out):
    with open(out / "sweep.csv", newline="") as file:
        return list(csv.DictReader(file))


def test_a_grid_gives_the_runs_one_would_make_by_hand(quick, tmp_path):
    points = treejet.sweep(quick, {"external potential": [20, 40], "viscosity": ["10", "20"]}, tmp_path / "grid", jobs=2)
    assert [p.values for p in points][1] == {"external potential": "20", "viscosity": "20"}
    alone = treejet.run(quick, tmp_path / "alone", external_potential=40, viscosity=10)
    assert (points[2].directory / "statdat.dat").read_bytes().split(b"circumstances")[1] == \
        (alone.directory / "statdat.dat").read_bytes().split(b"circumstances")[1]
    rows = table(tmp_path / "grid")
    assert [row["point"] for row in rows] == ["001", "002", "003", "004"] and all(row["exit code"] == "0" for row in rows)
    for row, point in zip(rows, points):
        assert float(row["vc[cm/s]"]) == point.means["vc"].mean
    # a stronger field draws a faster jet
    assert float(rows[2]["vc[cm/s]"]) > float(rows[0]["vc[cm/s]"])


def test_seeds_of_a_noisy_jet_give_a_mean_and_a_spread_and_without_noise_no_spread(quick, tmp_path):
    text = quick.read_text().replace("removing yes", "removing yes\nnoise yes\nnoise diffusivity 1.d4\nnoise variance 1.d2\nseed 1")
    noisy = tmp_path / "noisy.dat"
    noisy.write_text(text)
    points = treejet.sweep(noisy, {"viscosity": [10, 20], "seed": [1, 2, 3]}, tmp_path / "seeds", jobs=2)
    with open(tmp_path / "seeds" / "seeds.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["viscosity"] for row in rows] == ["10", "20"] and all(row["seeds"] == "3" for row in rows)
    of_seeds = [p.means["vc"].mean for p in points[:3]]
    assert float(rows[0]["vc[cm/s]"]) == pytest.approx(sum(of_seeds) / 3, rel=1e-14)
    assert float(rows[0]["spread of vc"]) == pytest.approx(statistics.stdev(of_seeds), rel=1e-10) and len(set(of_seeds)) == 3
    assert float(rows[0]["error of vc"]) == pytest.approx(float(rows[0]["spread of vc"]) / 3 ** 0.5, rel=1e-14)
    treejet.sweep(quick, {"seed": [1, 2]}, tmp_path / "calm")
    with open(tmp_path / "calm" / "seeds.csv", newline="") as file:
        assert float(list(csv.DictReader(file))[0]["spread of vc"]) == 0


def test_a_point_that_fails_ends_no_other_and_tells_why(quick, tmp_path):
    points = treejet.sweep(quick, {"viscosity": [10, -3, 20]}, tmp_path / "out", jobs=2)
    assert [p.exit_code for p in points] == [0, 2, 0] and "positive" in points[1].message
    rows = table(tmp_path / "out")
    assert rows[1]["exit code"] == "2" and rows[1]["vc[cm/s]"] == "nan" and "positive" in rows[1]["message"]


def test_finished_points_are_left_alone_and_stopped_ones_resumed(quick, tmp_path):
    vary, out = {"viscosity": [10, 20, 15]}, tmp_path / "out"
    whole = treejet.sweep(quick, vary, out)
    kept = (out / "001" / "run.json").stat().st_mtime_ns
    expected = [(p.directory / "statdat.dat").read_bytes() for p in whole]
    # the second point as a run that was stopped at once leaves it, the third as one that was killed before a checkpoint
    for name in ("002", "003"):
        for file in (out / name).iterdir():
            file.unlink()
    stopped = subprocess.run([treejet.find(), "run", quick, "--out", out / "002", "--quiet", "--walltime", "0.001",
                              "--set", "viscosity 20"], capture_output=True)
    assert stopped.returncode == 75 and (out / "002" / "checkpoint").exists()
    (out / "003" / "statdat.dat").write_text("# t[s] x[cm]\n")
    again = treejet.sweep(quick, vary, out)
    assert [p.exit_code for p in again] == [0, 0, 0]
    assert (out / "001" / "run.json").stat().st_mtime_ns == kept
    assert [(p.directory / "statdat.dat").read_bytes() for p in again] == expected
    assert len(json.loads((out / "002" / "run.json").read_text())["segments"]) == 2


def test_a_directory_of_another_sweep_or_of_anything_else_is_left_alone(quick, tmp_path):
    treejet.sweep(quick, {"viscosity": [10]}, tmp_path / "out")
    with pytest.raises(treejet.InputError, match="another deck or of other points"):
        treejet.sweep(quick, {"viscosity": [11]}, tmp_path / "out")
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.tex").touch()
    with pytest.raises(treejet.FileError, match="is not empty"):
        treejet.sweep(quick, {"viscosity": [11]}, tmp_path / "full")


def test_a_list_of_points_comes_from_a_table(tmp_path):
    (tmp_path / "points.csv").write_text("external potential,viscosity\n6 kV,10\n9 kV,20\n")
    assert from_csv(tmp_path / "points.csv") == [{"external potential": "6 kV", "viscosity": "10"},
                                                 {"external potential": "9 kV", "viscosity": "20"}]
    (tmp_path / "points.csv").write_text("external potential,viscosity\n6 kV\n")
    with pytest.raises(treejet.InputError, match="as many values"):
        from_csv(tmp_path / "points.csv")


@pytest.mark.parametrize("text", ["viscosity", "viscosity:", "viscosity: 1 .. 2", "viscosity: 1 .. 2 / 1",
                                  "viscosity: 0 .. 2 / 3 log", "viscosity: 1 kV .. 2 cm / 3", ": 1, 2"])
def test_malformed_variations_are_refused(text):
    with pytest.raises(treejet.InputError):
        varied(text)


def test_ends_in_different_units_are_one_quantity():
    assert varied("external potential: 900 V .. 3 kV / 3")[1] == ["900 V", "1950 V", "3000 V"]


def test_the_command_writes_table_and_picture(quick, tmp_path):
    done = subprocess.run([treejet.find(), "sweep", quick, "--vary", "external potential: 20 .. 40 / 3", "--out",
                           tmp_path / "out", "--jobs", "2"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert len(table(tmp_path / "out")) == 3
    assert (tmp_path / "out" / "sweep.png").read_bytes().startswith(b"\x89PNG")
    assert os.listdir(tmp_path / "out" / "002")


def test_tasks_of_a_job_array_make_the_points_and_the_sweep_finds_them_finished(quick, tmp_path):
    (tmp_path / "points.csv").write_text("viscosity\n10\n20\n15\n")
    words = [treejet.find(), "sweep", quick, "--list", tmp_path / "points.csv", "--out", tmp_path / "out"]
    tasks = [subprocess.Popen([*words, "--only", str(k)]) for k in (1, 2, 3)]
    assert [task.wait() for task in tasks] == [0, 0, 0]
    assert not (tmp_path / "out" / "sweep.csv").exists()
    written = {k: (tmp_path / "out" / k / "run.json").stat().st_mtime_ns for k in ("001", "002", "003")}
    points = treejet.sweep(quick, from_csv(tmp_path / "points.csv"), tmp_path / "out")
    assert [p.exit_code for p in points] == [0, 0, 0] and len(table(tmp_path / "out")) == 3
    assert {k: (tmp_path / "out" / k / "run.json").stat().st_mtime_ns for k in written} == written
    with pytest.raises(treejet.InputError, match="no point 4"):
        treejet.sweep(quick, from_csv(tmp_path / "points.csv"), tmp_path / "out", only=4)


def test_a_signal_ahead_of_the_end_stops_the_runs_with_checkpoints(quick, tmp_path):
    out, endless = tmp_path / "out", tmp_path / "endless.dat"
    endless.write_text(quick.read_text().replace("final time 4.d-3", "final time 100."))
    sweep = subprocess.Popen([treejet.find(), "sweep", endless, "--vary", "viscosity: 10, 20", "--jobs", "2", "--out", out])
    while not all((out / k / "run.json").exists() for k in ("001", "002")):
        time.sleep(0.02)
    sweep.send_signal(signal.SIGUSR1)
    assert sweep.wait() == 75
    assert all((out / k / "checkpoint").exists() for k in ("001", "002"))


def test_points_may_name_their_directives_in_any_order_and_not_all_the_same(quick, tmp_path):
    points = treejet.sweep(quick, [{"viscosity": "20", "external potential": "30"}, {"external potential": 31, "viscosity": 21},
                                   {"gravity": False}], tmp_path / "listed")
    rows = table(tmp_path / "listed")
    assert [(row["viscosity"], row["external potential"], row["gravity"]) for row in rows] == \
        [("20", "30", ""), ("21", "31", ""), ("", "", "no")]
    assert all(row["exit code"] == "0" for row in rows)
    assert sweep_plot.draw(points, tmp_path / "listed.png").stat().st_size > 10_000


@pytest.mark.parametrize("text", [b"viscosity\n20,30\n", b"viscosity,gravity\n20\n", b"viscosit\xe9\n20\n"])
def test_a_list_whose_rows_do_not_fit_its_header_or_that_is_no_text_is_refused(tmp_path, text):
    (tmp_path / "list.csv").write_bytes(text)
    with pytest.raises(treejet.InputError):
        from_csv(tmp_path / "list.csv")


@pytest.mark.parametrize("text", ["external potential: 6, 9, 12 kV", "surface tension: 40,5 mN/m, 50,5 mN/m", "viscosity: 1e400 .. 2 / 3",
                                  "viscosity: 1 .. 2 / 1000000000"])
def test_a_list_that_does_not_say_what_it_seems_to_is_refused(text):
    with pytest.raises(treejet.InputError):
        varied(text)


def test_a_string_is_no_list_of_values(quick, tmp_path):
    with pytest.raises(treejet.InputError, match="expected a list of values, found '10'"):
        treejet.sweep(quick, {"viscosity": "10"}, tmp_path / "word")


def test_a_table_from_a_spreadsheet_is_read_or_told_what_it_lacks(tmp_path):
    (tmp_path / "bom.csv").write_bytes(b"\xef\xbb\xbfviscosity,gravity\r\n3 Pa s,yes\r\n")
    assert from_csv(tmp_path / "bom.csv") == [{"viscosity": "3 Pa s", "gravity": "yes"}]
    (tmp_path / "semicolons.csv").write_text("viscosity;gravity\n3 Pa s;yes\n")
    with pytest.raises(treejet.InputError, match="semicolons"):
        from_csv(tmp_path / "semicolons.csv")


def test_what_no_point_could_do_is_refused_before_the_directory_is_claimed(quick, tmp_path):
    (tmp_path / "mute.dat").write_text("".join(line for line in quick.read_text().splitlines(True) if "printstat" not in line))
    with pytest.raises(treejet.InputError, match="printstat list"):
        treejet.sweep(tmp_path / "mute.dat", {"viscosity": [10, 20]}, tmp_path / "out")
    with pytest.raises(treejet.TreejetError, match="unknown directive"):
        treejet.sweep(quick, {"viscosty": [10, 20]}, tmp_path / "out")
    with pytest.raises(treejet.TreejetError) as refused:
        treejet.converge(quick, ["nonsense"], tmp_path / "out")
    assert refused.value.exit_code == 2 and not (tmp_path / "out" / "sweep.json").exists()


def test_a_run_that_a_signal_has_ended_has_the_code_of_a_shell(quick, tmp_path):
    found, words = [], [treejet.find(), "sweep", quick, "--vary", "final time: 100", "--out", tmp_path / "long"]
    whole = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    while not found and whole.poll() is None:
        time.sleep(0.05)
        found = subprocess.run(["pgrep", "-f", f"run .*{tmp_path / 'long' / '001'}"], capture_output=True, text=True).stdout.split()
    os.kill(int(found[0]), signal.SIGKILL)
    whole.communicate(timeout=60)
    assert whole.returncode == 128 + signal.SIGKILL
    row = table(tmp_path / "long")[0]
    assert row["exit code"] == "137" and "SIGKILL" in row["message"]


def test_who_has_stopped_listening_still_gets_the_table(quick, tmp_path):
    words = f"{treejet.find()} sweep {quick} --vary 'viscosity: 10 .. 30 / 3' --out {tmp_path / 'quiet'}; echo $? >{tmp_path / 'code'}"
    subprocess.run(f"({words}) | head -n 1", shell=True, check=True, stdout=subprocess.DEVNULL)
    assert (tmp_path / "code").read_text() == "0\n" and len(table(tmp_path / "quiet")) == 3


def test_a_sweep_is_run_by_one_process_without_mpirun(quick, tmp_path):
    words = [treejet.find(), "sweep", quick, "--vary", "viscosity: 10 .. 40 / 4", "--out", tmp_path / "one"]
    refused = subprocess.run(words, env={**os.environ, "OMPI_COMM_WORLD_SIZE": "2"}, capture_output=True, text=True)
    assert refused.returncode == 2 and "without mpirun" in refused.stderr
    both = [subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) for _ in range(2)]
    ended = [(run.communicate(timeout=120)[1], run.returncode) for run in both]
    assert sorted(code for _, code in ended) in ([0, 4], [0, 0])  # or the second began after the first had ended
    assert all("another sweep is running there" in said for said, code in ended if code == 4)
    assert [row["exit code"] for row in table(tmp_path / "one")] == ["0"] * 4
