"""A real marimo editor over one notebook file."""

import sys
from contextlib import contextmanager

from server import serving

# Cells run when the notebook is opened.
_SETTINGS = "[tool.marimo.runtime]\nauto_instantiate = true\n"


@contextmanager
def marimo(folder, root, name):
    """Start marimo on ``folder/name``; yields its address; ends its kernels too."""
    (folder / "pyproject.toml").write_text(_SETTINGS)

    def command(port):
        options = ["--headless", "--no-token", "--skip-update-check", "--no-sandbox"]
        return [sys.executable, "-m", "marimo", "edit", name, *options, f"--port={port}"]

    with serving(command, folder, root, status="/health") as address:
        yield address


def write_notebook(path, cells):
    """Write a marimo notebook; the names that cells share are those that they assign."""
    # marimo itself works out which cell needs what.
    bodies = [
        "@app.cell\ndef _():\n" + "".join(f"    {line}\n" for line in cell.splitlines())
        for cell in cells
    ]
    head = 'import marimo\n\napp = marimo.App(width="full")\n'
    path.write_text("\n\n".join([head, *bodies, 'if __name__ == "__main__":\n    app.run()\n']))
