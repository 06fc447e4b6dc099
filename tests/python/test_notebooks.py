"""The notebooks of docs/notebooks run, and their own assertions hold."""

import json

import pytest
from conftest import TOP

FOLDER = TOP / "docs" / "notebooks"


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", sorted(path.name for path in FOLDER.glob("*.ipynb")))
def test_notebook_runs(name, monkeypatch):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    monkeypatch.chdir(FOLDER)
    notebook = json.loads((FOLDER / name).read_text(encoding="utf-8"))
    names = {}
    for k, cell in enumerate(notebook["cells"]):
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), f"{name}, cell {k}", "exec"), names)
            plt.close("all")
