#!/usr/bin/python3
"""The page of `treejet view` in a real browser: it loads without errors, shows a jet, and its controls move it.

    browser.py TREEJET DECK DIR       exit code 77 where Chromium or Pillow is not installed
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
FLAGS = ("--headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
         "--disable-component-update --disable-sync --hide-scrollbars --window-size=1240,860 --virtual-time-budget=2000").split()
# told before anything else runs; what is asked for happens after all else has run
WATCH = "<script>window.faults = []; addEventListener('error', e => faults.push(e.message));</script>"
TELL = "<script>{deed}; setTimeout(() => document.documentElement.dataset.faults = JSON.stringify(faults), 500);</script>"
SLIDER = "{{const s = document.getElementById('time'); s.value = {}; s.dispatchEvent(new Event('input'))}}"
COLOUR = "{{const s = document.getElementById('colour'); s.value = {}; s.dispatchEvent(new Event('change'))}}"


def skip(why):
    print("SKIPPED:", why)
    sys.exit(SKIPPED)


def browse(chromium, page, *words):
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run([chromium, *FLAGS, f"--user-data-dir={profile}", *words, page.as_uri()], check=True,
                              capture_output=True, text=True, timeout=120).stdout


def stage(chromium, html, deed, directory, name):
    """Loads the page, does the deed; returns the picture of the stage and what the page says, after it had no faults."""
    page = directory / f"{name}.html"
    page.write_text(html.replace("<head>", "<head>" + WATCH, 1).replace("</body>", TELL.format(deed=deed) + "</body>"))
    dom = browse(chromium, page, "--dump-dom")
    root = re.search(r"<html[^>]*>", dom)[0]
    assert 'data-faults="[]"' in root and 'data-ready="yes"' in root, f"{name}: faults: {root}"
    browse(chromium, page, f"--screenshot={directory / name}.png")
    from PIL import Image
    return Image.open(directory / f"{name}.png").convert("RGB").crop((60, 75, 960, 610)), dom


def bright(picture):
    """Pixels of the jet's colours: saturated and light, as nothing else on the stage is."""
    return sum(max(p) > 150 and max(p) - min(p) > 60 for p in picture.getdata())


def differing(a, b):
    return sum(p != q for p, q in zip(a.getdata(), b.getdata()))


def main(treejet, deck, where):
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not chromium:
        skip("no Chromium; Debian package chromium")
    try:
        import PIL  # noqa: F401
    except ImportError:
        skip("no Pillow; Debian package python3-pil")
    directory = Path(where).resolve()
    shutil.rmtree(directory, ignore_errors=True)
    sets = ["final time 0.1", "print time 1.d-3", "print hdf5 2.d-4"]
    subprocess.run([treejet, "run", deck, "--out", directory, "--quiet", *(w for s in sets for w in ("--set", s))], check=True)
    subprocess.run([treejet, "view", directory], check=True)
    page = directory / "view.html"
    assert page.stat().st_size < 5e6, f"{page.stat().st_size} bytes for 501 frames"
    html = page.read_text()
    assert not re.search(r"(src|href)=|https?://|url\(|import ", html.split('<script id="data"')[0]), "not self-contained"

    late, dom = stage(chromium, html, "0", directory, "late")
    assert bright(late) > 1500, f"no jet on the stage: {bright(late)} bright pixels"
    assert re.search(r'id="state">14[89] beads', dom), "the page does not tell the beads"
    again, _ = stage(chromium, html, "0", directory, "again")
    assert differing(late, again) == 0, "the same page looks different"
    early, dom = stage(chromium, html, SLIDER.format(20), directory, "early")
    assert 'id="clock">4' in dom, "the clock does not follow the slider"
    assert differing(late, early) > 3000, "the time slider does not move the jet"
    # at 4 ms the jet has not yet reached the collector
    assert 50 < bright(early) < bright(late)
    other, _ = stage(chromium, html, COLOUR.format(2), directory, "radius")
    assert differing(late, other) > 1000, "another colour changes nothing"
    print(f"seen: {bright(late)} bright pixels late, {bright(early)} early, {differing(late, early)} differ")


if __name__ == "__main__":
    main(*sys.argv[1:])
