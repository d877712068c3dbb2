"""Stand-alone pages, written by an editor without a front end."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from sunwidget.analysis.scene import Scene
from sunwidget.edit.table import Edit
from sunwidget.files import target
from sunwidget.widgets.editor.sun_editor import SunEditor


class _Unseen(SunEditor):
    """An editor that opens no channel to a browser."""

    def open(self, source: Any = None, **_options: Any) -> None:
        """Do nothing."""


def to_html(
    scene: Scene,
    edit: Edit | dict[str, Any] | None = None,
    path: str | os.PathLike[str] | None = None,
    *,
    title: str | None = None,
    overwrite: bool = False,
) -> Path | str:
    """Write a page in which the sun of an analysed photo can be moved: one file, no kernel.

    Parameters
    ----------
    scene : Scene
        What ``analyze`` returned.
    edit : Edit or dict, optional
        What the page starts with. Its strokes and hints are applied, and stay as they are.
    path : path, optional
        Where to write it. Default: nowhere, and the page is returned as text.
    title : str, optional
        Of the page. Default: the photo's name.
    overwrite : bool
        Replace an existing file.

    Returns
    -------
    Path or str
        Where the page is, or the page. It holds the photo's preview (at most 2048 pixels a
        side), its maps and the front end: 2 to 8 MB. In it everything that a shader draws is
        live; strokes, hints and the full size are not there, and it says so.

    Raises
    ------
    FileExistsError
        When ``path`` exists and ``overwrite`` is false.
    AnalysisError
        When a hint of the edit cannot be used.
    OSError
        When the folder is missing or the disk full; no half-written file is left.

    Examples
    --------
    >>> sw.to_html(scene, sw.Edit(sun_elevation=3), "evening.html")
    """
    if path is not None:
        target(path, overwrite=overwrite)
    editor = _Unseen(scene, recipe=edit)
    try:
        return editor.to_html(path, title=title, overwrite=overwrite)
    finally:
        editor.layout.close()
