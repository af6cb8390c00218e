"""treejet plot, movie, view and export without a browser."""

import json
import shutil

import numpy as np
import pytest
import treejet
from treejet.export import export
from treejet.observables import Observables
from treejet.pictures import panels_of
from treejet.plot import history_picture, movie, plot, title
from treejet.view import page, quantised, view


def copy_without(run, directory, *names):
    shutil.copytree(run.directory, directory, ignore=shutil.ignore_patterns(*names))
    return treejet.read(directory)


def data_of(text):
    return json.loads(text.split('type="application/json">')[1].split("</script>")[0])


def test_a_run_is_drawn_from_either_trajectory(jet, tmp_path):
    for absent in ("traj.h5", "traj.xyz"):
        run = copy_without(jet, tmp_path / absent, absent)
        assert [p.name for p in plot(run)] == ["jet.png", "history.png"]
        assert all(p.read_bytes().startswith(b"\x89PNG") for p in plot(run))


def test_picture_page_and_table_tell_the_same_number_of_beads(jet):
    held_beyond, n = jet.deck.held_beyond(), jet.observables["n"][-1]
    assert f" {n:.0f} beads" in title(jet.frames[-1], held_beyond)
    assert data_of(page(jet))["beads"][-1] == n


def test_every_key_has_a_panel_in_readable_units_and_nothing_arrived_is_a_gap():
    t = np.array([0.0, 1e-3, 2e-3])
    table = Observables({"t": t, "rc": np.array([np.nan, np.nan, 4e-4]), "curn": 900 + t, "strange": t, "st": 1e5 + t},
                        {"t": "s", "rc": "cm", "curn": "statC/s", "strange": "furlong", "st": "g/(cm*s^2)"})
    panels = panels_of(table)
    assert {key for panel in panels for key in panel.keys} == {"rc", "curn", "strange", "st"}
    assert {panel.title: panel.unit for panel in panels} == {"radius": "um", "current": "nA", "strange": "furlong", "stress": "kPa"}
    figure = history_picture(table)
    lines = {line.get_label().split(":")[0]: line.get_ydata() for axes in figure.axes for line in axes.lines}
    assert np.isnan(lines["rc"][:2]).all() and lines["rc"][2] == pytest.approx(4)
    assert lines["st"][0] == pytest.approx(10)


def test_a_movie_shows_all_frames_as_gif_without_ffmpeg(jet, tmp_path):
    image = pytest.importorskip("PIL.Image")
    with image.open(movie(jet, tmp_path / "jet.gif", most_frames=5)) as film:
        assert film.n_frames == 5
    with pytest.raises(treejet.InputError, match="mp4 or .gif"):
        movie(jet, tmp_path / "jet.avi")


def test_the_page_keeps_positions_to_half_a_step_of_16_bits(jet):
    data = data_of(page(jet))
    import base64

    kept = np.frombuffer(base64.b64decode(data["position"]), "<u2").reshape(-1, 3) / 65535
    low, high = np.array(data["low"]), np.array(data["high"])
    exact = np.concatenate([f.position for f in jet.frames])
    # half a step, and round-off
    assert (np.abs(low + kept * (high - low) - exact) <= 0.5001 * (high - low) / 65535).all()
    assert data["count"] == [len(f) for f in jet.frames] and data["collector"] == pytest.approx(0.3)
    assert [s["title"] for s in data["scalars"]] == ["velocity", "stress", "radius", "charge per length"]
    assert quantised(np.array([np.nan]), 0, 1)[0] == 0


def test_text_of_a_deck_cannot_leave_its_place_in_the_page(jet, tmp_path):
    run = copy_without(jet, tmp_path / "x<script>&", "traj.xyz")
    run.record["deck"]["text"] += "# </script><script>alert(1)</script>\n"
    text = page(run)
    assert "<script>alert" not in text and "alert(1)" in data_of(text)["deck"]
    assert "<title>x&lt;script&gt;&amp;" in text


def test_a_long_jet_is_thinned_below_five_megabytes(jet, tmp_path):
    import h5py

    run = copy_without(jet, tmp_path / "long", "traj.xyz")
    points, frames = 20000, 40
    with h5py.File(tmp_path / "long" / "traj.h5", "r+") as file:
        group = file["particles/jet"]
        rng = np.random.default_rng(1)
        for name in ("position", "velocity", "stress", "charge", "mass", "radius", "id"):
            shape = (frames, points, 3) if name in ("position", "velocity") else (frames, points)
            del group[f"{name}/value"]
            group[f"{name}/value"] = np.tile(np.arange(points)[::-1], (frames, 1)) if name == "id" else rng.random(shape)
        del group["position/time"]
        group["position/time"] = np.arange(frames) * 1e-3
    trajectory = tmp_path / "long" / "traj.h5"
    before = trajectory.read_bytes()
    with pytest.raises(treejet.TreejetError, match="is there already and no page"):
        view(treejet.read(tmp_path / "long"), trajectory)
    assert trajectory.read_bytes() == before
    view(treejet.read(tmp_path / "long"))
    target = view(treejet.read(tmp_path / "long"))  # a page takes the place of a page
    data = data_of(target.read_text())
    assert target.stat().st_size < 5e6 and data["thinned"]["points"] == points
    assert len(data["count"]) == frames and min(data["count"]) >= 1000


def test_an_export_replaces_nothing_unless_told(jet, tmp_path):
    (tmp_path / "a.vtkhdf").write_text("mine")
    with pytest.raises(treejet.FileError, match="--force"):
        export(jet, "vtkhdf", tmp_path / "a.vtkhdf")
    assert (tmp_path / "a.vtkhdf").read_text() == "mine"
    assert export(jet, "vtkhdf", tmp_path / "a.vtkhdf", force=True).stat().st_size > 1000
    assert [p.name for p in tmp_path.iterdir()] == ["a.vtkhdf"]
