"""A real JupyterLab on a free port of this machine, with a home of its own."""

import json
import os
import secrets
import signal
import socket
import subprocess
import sys
import time
import urllib.request
from contextlib import contextmanager

import nbformat
from chromium import PATIENCE

_PATIENCE = 120  # s


@contextmanager
def jupyterlab(folder, root):
    """Start JupyterLab over the files of ``folder``; yields ``url(path)``; ends its kernels too."""
    home = folder / ".home"
    overrides = home / "config" / "labconfig" / "default_setting_overrides.json"
    overrides.parent.mkdir(parents=True)
    overrides.write_text(
        json.dumps(
            {
                "@jupyterlab/apputils-extension:notification": {
                    "fetchNews": "false",
                    "checkForUpdates": False,
                },
            }
        )
    )
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    token = secrets.token_hex(16)
    environment = {
        **os.environ,
        "HOME": str(home),
        "JUPYTER_CONFIG_DIR": str(home / "config"),
        "JUPYTER_DATA_DIR": str(home / "data"),
        "JUPYTER_RUNTIME_DIR": str(home / "runtime"),
        "IPYTHONDIR": str(home / "ipython"),
        "PYTHONPATH": os.pathsep.join([str(root), os.environ.get("PYTHONPATH", "")]).rstrip(":"),
    }
    command = [
        sys.executable,
        "-m",
        "jupyterlab",
        "--no-browser",
        "--allow-root",
        "--ip=127.0.0.1",
        f"--port={port}",
        "--ServerApp.port_retries=0",
        f"--IdentityProvider.token={token}",
        f"--ServerApp.root_dir={folder}",
        "--LabApp.extension_manager=readonly",
    ]
    log = (folder / "lab.log").open("wb")
    # A session of its own, so that its kernels end with it.
    process = subprocess.Popen(
        command, cwd=folder, env=environment, stdout=log, stderr=log, start_new_session=True
    )
    address = f"http://127.0.0.1:{port}"
    try:
        _wait_until_up(process, f"{address}/api/status?token={token}", folder / "lab.log")
        yield lambda path: f"{address}/lab/tree/{path}?token={token}"
    finally:
        for ending in (signal.SIGTERM, signal.SIGKILL):
            try:
                os.killpg(process.pid, ending)
            except ProcessLookupError:
                break
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                continue
        process.wait(20)
        log.close()


def _wait_until_up(process, status, log):
    until = time.monotonic() + _PATIENCE
    while time.monotonic() < until:
        if process.poll() is not None:
            break
        try:
            with urllib.request.urlopen(status, timeout=5):
                return
        except OSError:
            time.sleep(0.5)
    raise RuntimeError(f"JupyterLab did not start:\n{log.read_text()[-4000:]}")


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
    notebook = nbformat.v4.new_notebook(
        cells=[nbformat.v4.new_code_cell(source) for source in cells],
        metadata={
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}
        },
    )
    nbformat.write(notebook, path)
