"""Reading what the program writes, running it, its errors."""

import json
import os
import subprocess

import h5py
import numpy as np
import pytest
import treejet


def test_frames_are_those_of_the_file(jet):
    with h5py.File(jet.directory / "traj.h5") as file:
        ids = file["particles/jet/id/value"][...]
        assert len(jet.frames) == len(ids) == 21
        for k, frame in enumerate(jet.frames):
            assert len(frame) == (ids[k] >= 0).sum() and frame.id[-1] == 0
            for name in ("position", "velocity", "stress", "charge", "mass", "radius"):
                assert np.array_equal(getattr(frame, name), file[f"particles/jet/{name}/value"][k, : len(frame)])
    assert len({len(f) for f in jet.frames}) >= 3  # beads come, and go:
    assert jet.frames[-1].id[0] > 1


def test_both_trajectories_show_the_same_jet(jet):
    xyz = treejet.frames.XyzFrames(jet.directory / "traj.xyz")
    assert len(xyz) == len(jet.frames)
    for a, b in zip(xyz, jet.frames):
        # traj.xyz has 9 digits, of times 10
        assert np.allclose(a.position, b.position, rtol=1e-8, atol=1e-12)
        assert a.time == pytest.approx(b.time, rel=1e-9)


def test_beads_are_counted_as_the_table_counts_them(jet):
    t, n = jet.observables["t"], jet.observables["n"]
    held_beyond = jet.deck.held_beyond()
    held = 0
    for frame in jet.frames:
        row = int(np.abs(t - frame.time).argmin())
        assert frame.counted_beads(held_beyond) == n[row]
        held += frame.beads != n[row]
    assert 0 < held < len(jet.frames)


def test_observables_have_the_units_of_the_file(jet):
    table = jet.observables
    assert table.units["curn"] == "statC/s" and table.units["n"] == "1"
    # 1 statC/s is 1/2.99792458 nA by definition of the SI
    assert np.allclose(table.to("curn", "nA"), table["curn"] / 2.99792458, rtol=1e-14)
    assert treejet.convert(180, "degree", "rad") == pytest.approx(np.pi, rel=1e-15)
    assert np.array_equal(np.genfromtxt(jet.directory / "statdat.dat")[:, list(table).index("x")], table["x"])


def test_the_deck_of_a_run_has_its_overrides(jet):
    assert jet.deck["collector distance"] == "0.3" and jet.deck.number("collector distance", "mm") == pytest.approx(3)
    assert jet.deck.element() == 0.02 and jet.deck["perturb"] == "yes"
    assert jet.program.startswith("treejet ") and jet.finished


def test_a_table_becomes_a_data_frame(jet):
    pandas = pytest.importorskip("pandas")
    frame = jet.observables.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame["t[s]"]) == list(jet.observables["t"])


def test_the_same_run_again_differs_nowhere_and_another_one_does(jet, deck, tmp_path):
    from conftest import SHORT

    again = treejet.run(jet.deck, tmp_path / "again")
    assert all(d.largest == 0 and d.only == (0, 0) for d in treejet.compare(jet, again))
    other = treejet.run(deck, tmp_path / "other", **{**SHORT, "external_potential": 31})
    differences = treejet.compare(jet, other)
    assert differences[0].largest == 0  # before anything has moved
    assert differences[-1].largest > 1e-3


def test_errors_are_the_programs_own(deck, tmp_path):
    with pytest.raises(treejet.TreejetError, match="expected a value that is positive, found '-1'") as wrong:
        treejet.run(deck, tmp_path / "out", viscosity=-1)
    assert wrong.value.exit_code == 2 and not (tmp_path / "out").exists()
    with pytest.raises(treejet.TreejetError, match="nowhere.dat") as absent:
        treejet.run(tmp_path / "nowhere.dat", tmp_path / "out")
    assert absent.value.exit_code == 4
    treejet.run(deck, tmp_path / "out", final_time="1e-5", print_time="1e-6")
    with pytest.raises(treejet.TreejetError, match="--force") as there:
        treejet.run(deck, tmp_path / "out", final_time="1e-5", print_time="1e-6")
    assert there.value.exit_code == 4


def test_a_program_that_is_not_there_is_told(monkeypatch, tmp_path):
    monkeypatch.setenv("TREEJET", str(tmp_path / "treejet"))
    with pytest.raises(treejet.FileError, match="TREEJET names"):
        treejet.find()


def test_a_frame_cut_short_is_left_out_and_foreign_files_are_refused(jet, tmp_path):
    whole = (jet.directory / "traj.xyz").read_bytes()
    (tmp_path / "traj.xyz").write_bytes(whole[:-1])
    assert len(treejet.read(tmp_path).frames) == len(jet.frames) - 1
    (tmp_path / "traj.xyz").write_text("a jet\n")
    with pytest.raises(treejet.FileError, match="expected a number of lines"):
        treejet.read(tmp_path).frames
    (tmp_path / "traj.h5").write_text("no HDF5\n")
    with pytest.raises(treejet.FileError, match="cannot be read as a trajectory"):
        treejet.read(tmp_path).frames
    (tmp_path / "statdat.dat").write_text("# t[s] x[cm]\n 1 2\n 3\n")
    with pytest.raises(treejet.FileError, match="expected rows of 2 numbers"):
        treejet.read(tmp_path).observables


def test_the_spectrum_finds_the_circle_of_the_nozzle(jet):
    # the nozzle circles with 1e4 rad/s; frames every 4e-4 s would alias it, so along the axis: one made for it
    t = np.arange(512) * 2e-5
    circle = 1e-3 * np.exp(1e4j * t)
    found = treejet.spectrum(circle, 2e-5)
    # the centre of power over the window's five bins is exact to a part of a bin, 1 / 10.24 ms
    assert found.dominant == pytest.approx(1e4 / (2 * np.pi), abs=0.05 / t[-1])
    assert found.power.sum() == pytest.approx(1)
    # a pure circle has the spread of the Hann window, 1 / (sqrt(3) record); the rest is leakage of a broken period
    assert found.spread == pytest.approx(1 / (np.sqrt(3) * len(t) * 2e-5), rel=0.05)


def test_the_words_reach_python_through_the_front_door(jet, tmp_path):
    program = os.environ["TREEJET"]
    helps = subprocess.run([program, "view", "--help"], capture_output=True, text=True)
    assert helps.returncode == 0 and "usage: treejet view" in helps.stdout
    wrong = subprocess.run([program, "plot", str(tmp_path)], capture_output=True, text=True)
    assert wrong.returncode == 4 and wrong.stderr.startswith(f"treejet: {tmp_path}: neither run.json")


def test_a_python_without_the_modules_is_told_with_the_packages(tmp_path):
    bare = tmp_path / "python3"
    bare.write_text("#!/bin/sh\nexit 1\n")
    bare.chmod(0o755)
    # only where /usr/bin/python3, the second choice, lacks them can the error be seen; unshare hides it
    if os.geteuid() != 0 or subprocess.run(["unshare", "-m", "true"], capture_output=True).returncode:
        pytest.skip("needs root and unshare to hide /usr/bin/python3")
    hide = f"mount --bind {bare} /usr/bin/python3 && exec '{os.environ['TREEJET']}' view {tmp_path}"
    told = subprocess.run(["unshare", "-m", "sh", "-c", hide], capture_output=True, text=True,
                          env={**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"})
    assert told.returncode == 4
    assert "apt-get install python3-numpy python3-h5py python3-matplotlib" in told.stderr


def test_a_run_begins_with_the_jet_of_another_and_is_extended(deck, jet, tmp_path):
    began = treejet.run(deck, tmp_path / "next", begin_with=f"{jet.directory}@4ms", threads=1, print_time="2e-4", print_xyz="4e-4",
                        print_hdf5="4e-4", final_time="5e-3", collector_distance="0.3", external_potential="11 kV")
    assert began.observables["t"][0] == pytest.approx(4e-3) and began.observables["x"][0] == pytest.approx(
        jet.frames[10].position[0, 0], rel=1e-12)  # a few roundings
    longer = treejet.extend(tmp_path / "next", "6 ms")
    assert longer.observables["t"][-1] == pytest.approx(6e-3) and longer.finished
    with pytest.raises(treejet.TreejetError, match="no frame at t"):
        treejet.run(deck, tmp_path / "wrong", begin_with=f"{jet.directory}@4.1ms")


@pytest.mark.parametrize("line, unit", [
    ("collector distance 0.3 dm", "cm"), ("collector distance = 3000 µm", "cm"), ("collector distance 200.d", "cm"),
    ("elastic modulus 0.5 bar", "g/(cm s^2)"), ("elastic modulus 5 N/cm²", "g/(cm s^2)"), ("viscosity 20 poise", "g/(cm s)"),
    ("viscosity 2000 cP", "g/(cm s)"), ("perturb freq 1.5 kHz", "rad/s"), ("perturb freq 3000 rad/s", "rad/s"),
    ("density charge 44000 statC cm**-3", "statC/cm^3"), ("external potential 9 kV", "statV"),
])
def test_quantities_of_a_deck_are_those_that_the_program_reads(deck, line, unit):
    described = json.loads(treejet.program.call("check", str(deck), "--json", "--set", line))["directives"]
    name = max((name for name in described if line.startswith(name)), key=len)
    read = treejet.Deck(deck.read_text(), [line]).number(name, unit)
    assert read == pytest.approx(float(described[name].split()[0].replace("d", "e")), rel=1e-14)


def test_bare_numbers_of_real_units_are_volts_and_coulombs_a_litre():
    deck = treejet.Deck("units real\nexternal potential 9000\ndensity charge 1\nviscosity 20\nfinish")
    assert deck.number("external potential", "kV") == pytest.approx(9, rel=1e-14)
    assert deck.number("density charge", "C/m3") == pytest.approx(1000, rel=1e-14) and deck.number("viscosity", "P") == 20


def test_points_that_are_set_take_the_place_of_a_resolution():
    text = "initial length 0.02\nresolution 0.01\nfinish"
    assert treejet.Deck(text).element() == 0.01 and treejet.Deck(text, ["points 4"]).element() == 0.005


def test_a_rescaled_trajectory_is_read_in_centimetres_and_one_that_is_cut_off_says_so(deck, jet, tmp_path):
    few = treejet.run(deck, tmp_path / "few", threads=1, print_xyz_rescale=10, print_xyz_maxnum=4, print_xyz="8e-4",
                      final_time="8e-3", collector_distance="0.3")
    shown, whole = few.frames[-1], jet.frames[-1]
    assert shown.cut_off and shown.beads == shown.counted_beads(few.deck.held_beyond()) == 4
    assert np.allclose(shown.position, whole.position[:4], rtol=1e-8, atol=1e-12)


def test_with_a_given_flow_a_bead_is_always_held(deck, tmp_path):
    fed = treejet.run(deck, tmp_path / "fed", threads=1, model="slender", flow_rate="0.01736", final_time="2e-3", inserting="YES",
                      print_hdf5="1e-4", print_time="1e-4", printstat_list="t n", initial_length="0.02")
    n = fed.observables["n"]
    assert [frame.counted_beads(fed.deck.held_beyond()) for frame in fed.frames] == n.tolist() and n[-1] > 2
