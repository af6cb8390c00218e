"""Trajectories that somebody has tampered with: told of or refused, never followed, never a crash."""

import os
import shutil
import subprocess
import zlib

import h5py
import numpy as np
import pytest
import treejet

ID = "particles/jet/id/value"


def again(file, name, **dataset):
    del file[name]
    file.create_dataset(name, **dataset)


def text_that_is_a_table(file, _):
    again(file, "parameters/version", data=np.array([b"A" * 100] * 1000, dtype="S100"))


def text_of_any_length(file, _):
    again(file, "parameters/version", data="0.1.0", dtype=h5py.string_dtype())


def text_of_two_gigabytes(file, _):
    again(file, "parameters/version", shape=(), dtype="S2000000000")


def name_that_is_a_table(file, _):
    attributes = file["h5md/creator"].attrs
    del attributes["name"]
    attributes.create("name", np.array([b"treejet"] * 8000, dtype="S7"))


def more_points_than_any_memory(file, _):
    again(file, ID, shape=(file[ID].shape[0], 2**40), dtype="i8", chunks=(1, 256))


def identities_without_extent(file, _):
    again(file, ID, data=1)


def frames_without_end(file, _):
    again(file, ID, shape=(2**50, 0), maxshape=(None, None), dtype="i8", chunks=(1, 256))
    for part, kind in (("step", "i8"), ("time", "f8")):
        again(file, f"particles/jet/position/{part}", shape=(2**50,), dtype=kind, chunks=(1024,))


def deck_in_another_file(file, folder):
    with h5py.File(folder / "other.h5", "w") as other:
        other["text"] = np.bytes_(b"SECRET")
    del file["parameters/deck"]
    file["parameters/deck"] = h5py.ExternalLink(str(folder / "other.h5"), "/text")


def deck_in_raw_storage(file, folder):
    (folder / "raw").write_bytes(b"SECRET")
    del file["parameters/deck"]
    create = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    create.set_external(os.fsencode(folder / "raw"), 0, 6)
    kind = h5py.h5t.C_S1.copy()
    kind.set_size(6)
    h5py.h5d.create(file.id, b"/parameters/deck", kind, h5py.h5s.create_simple((1,)), create)


def identities_in_short_chunks(file, _):
    again(file, ID, data=file[ID][:], chunks=file[ID].chunks, compression="gzip")
    file[ID].id.write_direct_chunk((0, 0), zlib.compress(bytes(8)))


def identities_in_chunks_of_another_filter(file, _):
    again(file, ID, data=file[ID][:], chunks=file[ID].chunks, compression="lzf")


KINDS = [text_that_is_a_table, text_of_any_length, text_of_two_gigabytes, name_that_is_a_table, more_points_than_any_memory,
         identities_without_extent, frames_without_end, deck_in_another_file, deck_in_raw_storage,
         identities_in_short_chunks, identities_in_chunks_of_another_filter]


@pytest.mark.parametrize("tamper", KINDS, ids=lambda kind: kind.__name__)
def test_a_tampered_trajectory_is_refused_in_a_line(jet, tmp_path, tamper):
    victim = tmp_path / "traj.h5"
    shutil.copy(jet.directory / "traj.h5", victim)
    with h5py.File(victim, "r+") as file:
        tamper(file, tmp_path)
    for command in (["info", str(victim)], ["convert", str(victim), "--to", "csv", "--out", str(tmp_path / "out.csv")]):
        # a minute is far more than reading takes, far less than 2^50 frames would
        done = subprocess.run([os.environ["TREEJET"], *command], capture_output=True, timeout=60, text=True)
        assert done.returncode == 4, (command, done)
        assert done.stderr.count("\n") == 1 and "SECRET" not in done.stdout + done.stderr


def rewritten(source, target, **form):
    """All of a trajectory in a file of HDF5's newest form."""
    with h5py.File(source) as old, h5py.File(target, "w", libver="latest") as new:
        def take(name, thing):
            if isinstance(thing, h5py.Group):
                new.require_group(name)
            else:
                new.create_dataset(name, data=thing[()], **(form if thing.shape else {}))
            for key in thing.attrs:
                new[name].attrs.create(key, thing.attrs[key])
        for name in names_in(old):
            take(name, old[name])


def names_in(group, above=""):
    """All names, links to the same object among them."""
    for key, thing in group.items():
        yield above + key
        if isinstance(thing, h5py.Group):
            yield from names_in(thing, f"{above}{key}/")


def test_what_others_rewrite_in_one_piece_in_the_newest_form_is_read_as_before(jet, tmp_path):
    tables = []
    rewritten(jet.directory / "traj.h5", tmp_path / "traj.h5")
    for source in (jet.directory / "traj.h5", tmp_path / "traj.h5"):
        out = tmp_path / f"{len(tables)}.csv"
        subprocess.run([os.environ["TREEJET"], "convert", str(source), "--to", "csv", "--out", str(out)], check=True)
        tables.append(out.read_bytes())
    assert tables[0] == tables[1]


def test_chunks_of_the_newest_form_are_refused_with_what_rewrites_them(jet, tmp_path):
    rewritten(jet.directory / "traj.h5", tmp_path / "traj.h5", chunks=True)
    done = subprocess.run([os.environ["TREEJET"], "info", str(tmp_path / "traj.h5")], capture_output=True, text=True)
    assert done.returncode == 4 and "h5repack OLD NEW" in done.stderr


def test_damaged_records_and_endless_frames_are_failures_of_files(jet, tmp_path):
    for name, text in (("run.json", '{"segments": 3}'), ("run.json", '{"deck": "x"}'), ("run.json", "[1]"),
                       ("traj.xyz", "99999999999\nt = 0 s  beads = 2\nC 0 0 0\n")):
        place = tmp_path / f"{len(list(tmp_path.iterdir()))}"
        place.mkdir()
        (place / name).write_text(text)
        with pytest.raises(treejet.FileError):
            _ = treejet.read(place).frames[0] if name == "traj.xyz" and len(treejet.read(place).frames) else treejet.read(place).observables
