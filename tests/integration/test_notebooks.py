"""Every notebook runs from top to bottom, and lies in git without outputs."""

import os
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

NOTEBOOKS = sorted((Path(__file__).parents[2] / "notebooks").glob("*.ipynb"))
SHOWN = {
    "01_quickstart": {"image/png": 3},
    "02_scattering": {
        "image/png": 8,  # an explorer a chapter
        "text/html": 8,  # plots
        "text/markdown": 16,  # tables, and the answers to eight exercises
    },
    "03_validation": {"text/markdown": 9},  # one row of the table at least
    "04_export": {"image/png": 3, "image/gif": 1, "text/html": 1},  # the batch's table
    "05_gallery": {"image/png": 11},
    "06_your_own_photo": {
        "image/png": 7,
        "text/html": 1,  # the batch's table
        "text/markdown": 1,  # how bright land and sky are
    },
}
"""How many outputs of each kind a notebook shows at least. Without a front end, as here, a widget
that has a picture is its picture alone; ``browser/test_nbconvert.py`` looks at the page."""
NBCONVERT = [sys.executable, "-m", "nbconvert", "--execute", "--to=notebook", "--output-dir=."]
IN_A_KERNEL = [path for path in NOTEBOOKS if path.stem != "04_export"]


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
@pytest.mark.parametrize("path", IN_A_KERNEL, ids=lambda path: path.stem)
def test_notebook_runs_from_top_to_bottom(path, tmp_path, monkeypatch, measured_skies):
    # As after a clean clone: no measured skies, no tables made before.
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv("SUNWIDGET_MEASUREMENTS", raising=False)
    with kernel(path, tmp_path) as run:
        outputs = run()
        for kind, count in SHOWN[path.stem].items():
            assert sum(kind in output for output in outputs) >= count, kind
        compared = run(with_measured_skies=measured_skies) if measured_skies else []
    if "are not on this machine" in str(outputs) and measured_skies:
        texts = [output.get("text/markdown", "") for output in compared]
        assert any("RMSE" in text for text in texts)
        assert not any("are not on this machine" in text for text in texts)


@pytest.mark.timeout(600)
def test_nbconvert_needs_no_display_and_no_browser(tmp_path):
    path = next(path for path in NOTEBOOKS if path.stem == "04_export")
    done = subprocess.run(
        [*NBCONVERT, path],
        # Nothing of a desktop, and of all programs only Python's own.
        env={
            **{name: value for name, value in os.environ.items() if "DISPLAY" not in name},
            "PATH": str(Path(sys.executable).parent),
            "HOME": str(tmp_path),
        },
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-4000:]
    outputs = list(shown(nbformat.read(tmp_path / path.name, as_version=4).cells))
    for kind, count in SHOWN[path.stem].items():
        assert sum(kind in output for output in outputs) >= count, kind


@pytest.fixture
def measured_skies(root):
    """The folder of measured skies, or None: the notebooks also run without."""
    shared = Path(os.environ.get("SUNWIDGET_SHARED", root.parent / "shared"))
    folder = shared / "data" / "sky-reference"
    return folder if folder.is_dir() else None


@contextmanager
def kernel(path, folder):
    """Yield a function that runs a notebook in ``folder`` and returns what its cells showed.

    ``run(with_measured_skies=...)`` runs only the cells that ask for them, once more.
    """
    notebook = nbformat.read(path, as_version=4)
    client = NotebookClient(
        notebook, timeout=240, kernel_name="python3", resources={"metadata": {"path": folder}}
    )

    def run(with_measured_skies=None):
        cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
        if with_measured_skies:
            folder = str(with_measured_skies)
            setting = f"import os; os.environ['SUNWIDGET_MEASUREMENTS'] = {folder!r}"
            client.execute_cell(nbformat.v4.new_code_cell(setting), 0)
            cells = [cell for cell in cells if "measurements" in cell.source.lower()]
        for cell in cells:
            client.execute_cell(cell, notebook.cells.index(cell))
        return list(shown(cells))

    client.reset_execution_trackers()
    with client.setup_kernel():
        yield run


def shown(cells):
    """Yield what cells display, by kind."""
    for cell in cells:
        for output in cell.get("outputs", []):
            if output.output_type in ("display_data", "execute_result"):
                yield output.data
