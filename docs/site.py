#!/usr/bin/python3
"""Builds the documentation site with MkDocs: docs/site/*.md, the pages of docs/ that also stand alone, and what is taken
from the sources, so that it cannot differ from them:

    {{equations PATH}}   the opening comment of a header, where its equation stands
    {{file PATH}}        a file as it is
    {{reference}}        what `treejet reference` prints
    {{help COMMAND}}     what `treejet COMMAND --help` prints

    site.py TREEJET DIR      writes DIR/html/index.html; exit code 77 where MkDocs is not installed, 1 for any warning
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
ROOT = DOCS.parent
PICTURES = {"examples/pvp/jet.png": "jet.png"}


def opening(path: str) -> str:
    """The /// lines at the beginning of a header, as a block of plain text under the file's name."""
    lines = []
    for line in (ROOT / path).read_text().splitlines()[1:]:
        if not line.startswith("///"):
            break
        lines.append("    " + line[4:])
    if not lines:
        raise SystemExit(f"{path}: no opening comment")
    return f"`{path}`\n\n" + "\n".join(lines).rstrip()


def shown(path: str) -> str:
    return "\n".join("    " + line for line in (ROOT / path).read_text().splitlines())


def filled(text: str, treejet: str) -> str:
    said = lambda *words: subprocess.run([treejet, *words], check=True, capture_output=True, text=True).stdout  # noqa: E731
    text = re.sub(r"\{\{equations (\S+)\}\}", lambda m: opening(m[1]), text)
    text = re.sub(r"\{\{file (\S+)\}\}", lambda m: shown(m[1]), text)
    text = re.sub(r"\{\{help (\S+)\}\}", lambda m: "\n".join("    " + line for line in said(m[1], "--help").splitlines()), text)
    text = text.replace("{{reference}}", said("reference"))
    if left := re.search(r"\{\{.*?\}\}", text):
        raise SystemExit(f"{left[0]}: not known")
    return text


def main(treejet: str, where: str) -> int:
    if not shutil.which("mkdocs"):
        print("SKIPPED: no MkDocs; Debian package mkdocs")
        return 77
    site = Path(where).resolve()
    pages = site / "pages"
    shutil.rmtree(site, ignore_errors=True)
    pages.mkdir(parents=True)
    for page in sorted(DOCS.glob("site/*.md")):
        (pages / page.name).write_text(filled(page.read_text(), treejet))
    for page in sorted(DOCS.glob("*.md")):
        (pages / page.name).write_text(page.read_text().replace("](site/", "]("))
    shutil.copy(DOCS / "architecture.svg", pages)
    shutil.copy(DOCS / "site" / "site.css", pages)
    for picture in sorted(DOCS.glob("site/*.png")):
        shutil.copy(picture, pages)
    for picture, name in PICTURES.items():
        shutil.copy(ROOT / picture, pages / name)
    config = (DOCS / "site" / "mkdocs.yml").read_text()
    (site / "mkdocs.yml").write_text(config + f"docs_dir: {pages}\nsite_dir: {site / 'html'}\n")
    built = subprocess.run(["mkdocs", "build", "--strict", "--config-file", site / "mkdocs.yml"],
                           capture_output=True, text=True)
    if built.returncode or "WARNING" in built.stdout + built.stderr:
        print(built.stdout + built.stderr, end="")
        return 1
    print(f"{site / 'html' / 'index.html'}: {len(list(pages.glob('*.md')))} pages")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
