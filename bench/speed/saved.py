"""What a saved notebook holds of each widget: by JupyterLab with its state, and by nbclient."""

from __future__ import annotations

import tempfile
from pathlib import Path

from .effort import Effort
from .page import chromium
from .rows import Row, Rows

ROOT = Path(__file__).resolve().parents[2]
WIDGETS = ("SunEditor", "SkyExplorer", "Compare", "Study")
HOSTS = ("JupyterLab", "nbclient")
KEYS = tuple(f"saved by {host}, {name}" for host in HOSTS for name in WIDGETS)


def rows(_effort: Effort) -> Rows:
    from kept import megabytes, page_of_widgets, run_by_nbclient, save

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        failed = ROOT / "build" / "bench-saved-failed.png"
        with (
            chromium() as browser,
            page_of_widgets(browser, folder, ROOT, failed=failed) as page,
        ):
            save(page)
        yield from size_rows("JupyterLab", megabytes(folder / "cells.ipynb"))
        yield from size_rows("nbclient", megabytes(run_by_nbclient(folder)))


def size_rows(host: str, sizes: dict[str, float]) -> Rows:
    for name, size in sizes.items():
        yield Row(f"saved by {host}, {name}", f"a notebook saved by {host}: {name}", size, "MB")
