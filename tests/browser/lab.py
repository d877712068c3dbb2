"""A real JupyterLab or Notebook 7, and what a person does there."""

import contextlib
import json
import secrets
import sys

import nbformat
from chromium import PATIENCE, picture_of
from server import serving

_SETTINGS = {
    "@jupyterlab/apputils-extension:notification": {
        "fetchNews": "false",
        "checkForUpdates": False,
    },
}


@contextlib.contextmanager
def jupyterlab(folder, root, *, app="lab", theme="JupyterLab Light"):
    """Start JupyterLab over the files of ``folder``; yields ``url(path)``; ends its kernels too.

    ``app="notebook"`` starts Notebook 7, whose cells answer to the same names. ``url(path, name)``
    opens it in a workspace of that name: no other page's notebooks are open there.
    """
    home = folder / ".home"
    for name in ("labconfig", "nbconfig"):
        overrides = home / "config" / name / "default_setting_overrides.json"
        overrides.parent.mkdir(parents=True, exist_ok=True)
        themes = {"@jupyterlab/apputils-extension:themes": {"theme": theme}}
        overrides.write_text(json.dumps(_SETTINGS | themes))
    token = secrets.token_hex(16)
    module, tree = {"lab": ("jupyterlab", "lab/tree"), "notebook": ("notebook", "notebooks")}[app]

    def command(port):
        return [
            sys.executable,
            "-m",
            module,
            "--no-browser",
            "--allow-root",
            "--ip=127.0.0.1",
            f"--port={port}",
            "--ServerApp.port_retries=0",
            f"--IdentityProvider.token={token}",
            f"--ServerApp.root_dir={folder}",
            "--LabApp.extension_manager=readonly",
            "--LabApp.expose_app_in_browser=True",
        ]

    settings = {
        "JUPYTER_CONFIG_DIR": str(home / "config"),
        "JUPYTER_DATA_DIR": str(home / "data"),
        "JUPYTER_RUNTIME_DIR": str(home / "runtime"),
    }
    status = f"/api/status?token={token}"
    with serving(command, folder, root, status=status, settings=settings) as address:

        def url(path, workspace=None):
            place = f"lab/workspaces/{workspace}/tree" if workspace else tree
            return f"{address}/{place}/{path}?token={token}"

        yield url


def lab_page(context):
    """A page for JupyterLab that answers the questions Lab asks on a slow machine.

    A dialog lies over everything until it is answered: whether to keep waiting for a slow
    start, which kernel to take, that something failed. What was asked is printed.
    """
    page = context.new_page()
    page.set_default_timeout(PATIENCE)
    dialog = page.locator(".jp-Dialog").first

    def answer():
        print(f"JupyterLab asks: {dialog.inner_text()!r}")
        wait = dialog.get_by_role("button", name="Keep Waiting")
        (wait if wait.count() else dialog.locator("button.jp-mod-accept")).first.click()

    page.add_locator_handler(dialog, answer)
    return page


def write_notebook(path, cells):
    """Write a notebook that names its kernel: without one JupyterLab asks for it first."""
    written = nbformat.v4.new_notebook(
        cells=[nbformat.v4.new_code_cell(source) for source in cells],
        metadata={
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}
        },
    )
    nbformat.write(written, path)


@contextlib.contextmanager
def notebook_page(
    browser, folder, root, cells, *, failed, app="lab", url=None, script="", **context
):
    """Open a notebook of ``cells`` in a real JupyterLab, or Notebook 7, and run its first.

    Parameters
    ----------
    browser : Browser
        Playwright's.
    folder, root : Path
        Where the notebook is written, and the project.
    cells : list of str
        Their code.
    failed : Path
        Picture of the page to write when the test fails in it.
    app : {"lab", "notebook"}
    url : callable, optional
        Of a ``jupyterlab`` that runs already, over the folder that holds ``folder``.
    script : str
        JavaScript to run before the page's own.
    **context
        Options of the browser's context: viewport, permissions.

    Yields
    ------
    Page
    """
    write_notebook(folder / "cells.ipynb", cells)
    with contextlib.ExitStack() as stack:
        if url is None:
            address = stack.enter_context(jupyterlab(folder, root, app=app))("cells.ipynb")
        else:
            address = url(f"{folder.name}/cells.ipynb", folder.name)
        tab = browser.new_context(**context)
        tab.add_init_script(script)
        page = lab_page(tab)
        try:
            page.goto(address)
            page.locator(".jp-Notebook .jp-CodeCell").first.wait_for()
            run_cell(page, 0)
            yield page
        except BaseException:
            page.screenshot(path=failed)
            raise
        finally:
            tab.close()


def run_cell(page, number):
    """Run a cell; again if the kernel was not yet listening and the cell stays unnumbered."""
    cell = page.locator(".jp-Notebook .jp-CodeCell").nth(number)
    for _ in range(10):
        cell.locator(".cm-content").click()
        page.keyboard.press("Shift+Enter")
        for _ in range(20):
            if cell.locator(".jp-InputPrompt").first.text_content().strip() != "[ ]:":
                return
            page.wait_for_timeout(250)
    raise AssertionError(f"cell {number} did not start")


def run_cell_that_writes(page, number, file):
    """Run a cell and wait until it has written ``file``; returns its text."""
    run_cell(page, number)
    for _ in range(PATIENCE // 250):
        if file.is_file() and file.stat().st_size:
            return file.read_text()
        page.wait_for_timeout(250)
    raise AssertionError(f"the cell wrote no {file}")


def canvas_of(page):
    """What the first editor of the page shows, (H, W, 3) uint8."""
    return picture_of(
        page.evaluate(
            "document.querySelector('.sunwidget .sw-canvas').toDataURL('image/png').split(',')[1]"
        )
    )
