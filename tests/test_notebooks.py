"""Every notebook runs from top to bottom, and lies in git without outputs."""

from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))
SHOWN = {
    "01_quickstart": {"application/vnd.jupyter.widget-view+json": 1, "image/png": 3},
    "02_scattering": {
        "application/vnd.jupyter.widget-view+json": 8,  # an explorer a chapter
        "image/png": 8,
        "text/html": 8,  # plots
        "text/markdown": 16,  # tables, and the answers to eight exercises
    },
    "03_validation": {"text/markdown": 9},  # one row of the table at least
}
"""How many outputs of each kind a notebook shows at least."""


def test_every_notebook_is_expected():
    assert [path.stem for path in NOTEBOOKS] == list(SHOWN)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_carries_no_outputs(path):
    for cell in nbformat.read(path, as_version=4).cells:
        assert not cell.get("outputs")
        assert cell.get("execution_count") is None


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_names_a_kernel(path):
    # Without one JupyterLab opens with a dialog instead of a notebook.
    assert nbformat.read(path, as_version=4).metadata.kernelspec.name == "python3"


@pytest.mark.timeout(600)  # 20 s each, but machines are shared
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_runs_from_top_to_bottom(path, tmp_path, monkeypatch):
    # As after a clean clone: no measured skies, no tables made before.
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv("SUNWIDGET_MEASUREMENTS", raising=False)
    outputs = run(path, tmp_path)
    for kind, count in SHOWN[path.stem].items():
        assert sum(kind in output for output in outputs) >= count, kind


@pytest.mark.shared
@pytest.mark.timeout(600)
@pytest.mark.parametrize("path", NOTEBOOKS[1:], ids=lambda path: path.stem)
def test_notebook_with_measured_skies_compares_with_them(path, tmp_path, shared, monkeypatch):
    folder = shared / "data" / "sky-reference"
    if not folder.is_dir():
        pytest.skip(f"no measured skies in {folder}")
    monkeypatch.setenv("SUNWIDGET_MEASUREMENTS", str(folder))
    texts = [output.get("text/markdown", "") for output in run(path, tmp_path)]
    assert not any("are not on this machine" in text for text in texts)


def run(path, folder):
    """Run a notebook in ``folder``; returns what its cells showed, by kind."""
    notebook = nbformat.read(path, as_version=4)
    NotebookClient(
        notebook, timeout=240, kernel_name="python3", resources={"metadata": {"path": folder}}
    ).execute()
    return [
        output.data
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if output.output_type in ("display_data", "execute_result")
    ]
