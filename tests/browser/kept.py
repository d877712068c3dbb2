"""A notebook of all widgets, saved by JupyterLab or by a program, and what is in its file."""

import contextlib
import json
import subprocess
import sys

from lab import notebook_page, run_cell, write_notebook

# The photo at its own size: what is kept of it must not grow with it. One cell a widget.
CELLS = {
    "SunEditor": """import sunwidget as sw
photo = sw.sample("coast")
editor = sw.SunEditor(photo, sun_elevation=-3)
editor""",
    "SkyExplorer": "sw.SkyExplorer(sun_elevation=5)",
    "Compare": 'sw.Compare(photo, ["photo", "ratio", "thesis"], sun_elevation=3)',
    "Study": 'sw.Study({"editor": editor.render(), "photo": photo})',
}
READY = {
    "SunEditor": ".sw-editor.sw-live[data-stage='ready']",
    "SkyExplorer": ".sw-explorer.sw-live",
    "Compare": ".sw-compare.sw-live",
    "Study": ".sw-study",
}
PLACE = (".sw-editor", ".sw-explorer", ".sw-compare", ".sw-study")
EXECUTE = [sys.executable, "-m", "nbconvert", "--to=notebook", "--execute", "--output=run.ipynb"]
_SAVE_STATE = "@jupyter-widgets/jupyterlab-manager:saveWidgetState"
_STATE = "application/vnd.jupyter.widget-state+json"


@contextlib.contextmanager
def page_of_widgets(browser, folder, root, *, failed, **context):
    """A JupyterLab in which all cells were run and each widget was seen at work."""
    with notebook_page(
        browser, folder, root, list(CELLS.values()), failed=failed, **context
    ) as page:
        page.wait_for_function("window.jupyterapp", timeout=20_000)
        for i, selector in enumerate(READY.values()):
            if i:
                run_cell(page, i)
            # Only what is in sight is drawn.
            page.locator(PLACE[i]).scroll_into_view_if_needed()
            page.locator(selector).wait_for()
            page.wait_for_timeout(500)
        yield page


def save(page):
    """Save the notebook with the state of its widgets."""
    for command in (_SAVE_STATE, "docmanager:save"):
        page.evaluate("(command) => jupyterapp.commands.execute(command)", command)
        page.wait_for_timeout(2000)


def run_by_nbclient(folder):
    """Run the notebook as ``jupyter nbconvert --execute`` does, which saves what it heard."""
    write_notebook(folder / "cells.ipynb", CELLS.values())
    command = [*EXECUTE, "cells.ipynb"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-4000:]
    return folder / "run.ipynb"


def states_of(notebook):
    """The saved models of a notebook's widgets, by class."""
    models = notebook["metadata"].get("widgets", {}).get(_STATE, {"state": {}})["state"].values()
    kinds = {str(m["state"].get("_anywidget_id", "")).rpartition(".")[2]: m for m in models}
    return {name: kinds[name] for name in CELLS}


def megabytes(path):
    """What the file holds of each widget: its cell's output, and its state with front end."""
    notebook = json.loads(path.read_text("utf-8"))
    states = states_of(notebook)
    return {
        name: sum(len(json.dumps(part)) for part in (cell["outputs"], states[name])) / 1e6
        for name, cell in zip(CELLS, notebook["cells"], strict=False)  # Lab adds an empty one
    }
