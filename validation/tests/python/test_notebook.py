"""The notebook runs from its first cell to its last."""

import json

import conftest


def test_the_cells_of_the_notebook_run_one_after_the_other(tmp_path, monkeypatch):
    import matplotlib

    matplotlib.use("Agg")
    notebook = json.loads((conftest.SOURCE / "examples" / "notebook" / "jets.ipynb").read_text())
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TREEJET_EXAMPLES", str(conftest.SOURCE / "examples"))
    names = {}
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    for number, cell in enumerate(cells, 1):
        exec(compile(cell, f"jets.ipynb, code cell {number}", "exec"), names)
    assert len(cells) >= 5 and names["run"].finished and len(names["points"]) == 3
