"""The notebooks run from the project's folder, from the first cell to the last."""
from pathlib import Path

import pytest

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("ipykernel")

PROJECT = Path(__file__).resolve().parents[3]


def run(name: str) -> str:
    """What the notebook's cells say, as one text."""
    notebook = nbformat.read(PROJECT / "scripts/python/notebooks" / f"{name}.ipynb", as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "notebooks are kept without outputs"
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(PROJECT)}}).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return "".join(output.get("text", "") + str(output.get("data", "")) for output in outputs)


def test_notebook_scene():
    said = run("scene")
    assert "image/svg+xml" in said and "left, the first after" in said


def test_notebook_views():
    pytest.importorskip("pandas")
    said = run("views")
    assert said.count("<iframe src=\"http://127.0.0.1:") == 2 and said.count("image/svg+xml") == 2 and "density [1/m2]" in said
    assert "went by while no cell ran" in said and " ± " in said and "'0.0'" in said  # nobody let it run: looking changes nothing


def test_notebook_study():
    assert "100 people:" in run("study")


def test_notebook_recording():
    assert "frames a second" in run("recording")
