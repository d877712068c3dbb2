"""Widgets as single HTML files: everything that a shader draws stays live without a kernel."""

from __future__ import annotations

import base64
import contextlib
import functools
import os
import uuid
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.analysis.scene import Scene, checked_scene
from sunwidget.edit.recipe import edit_of
from sunwidget.edit.table import Edit
from sunwidget.files import complete_or_absent, target
from sunwidget.photo.photo import Photo
from sunwidget.widgets.editor.editor_state import editor_state
from sunwidget.widgets.page.html import Still, page
from sunwidget.widgets.page.saved_state import SavedLight

_STILL_EDGE = 1024
_STILL_QUALITY = 90
_PNG_LEVEL = 6
_EXPLORER_STILL = (960, 640)
_EXPLORER_NOTES = (
    "Everything happens in this file, and nothing leaves it.",
    "Bruneton's table, measured skies and other places and days need the notebook.",
)
# Traits that place a widget in a notebook have no meaning in a page.
_HOST = ("layout", "tabbable", "tooltip", "_anywidget_id", "_dom_classes")
_HOST_PREFIXES = ("_model_", "_view_")
_NOTES = (
    "Drag the sun, or the sliders: everything happens in this file, and nothing leaves it.",
    "Brushes, horizon and the full size need the notebook that created this page.",
)


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
        Initial edit of the page. Its strokes and hints are applied and cannot be changed there.
    path : path, optional
        Where to write the page. By default it is not written but returned as text.
    title : str, optional
        Title of the page. Default: the photo's name.
    overwrite : bool
        Replace an existing file.

    Returns
    -------
    Path or str
        The path of the page, or its text. The page holds the photo's preview (at most 2048 pixels
        per side), its maps and the front end: 2 to 8 MB. Everything that a shader draws is live;
        strokes, hints and the full size are unavailable, which the page states.

    Raises
    ------
    FileExistsError
        If ``path`` exists and ``overwrite`` is false.
    AnalysisError
        If a hint of the edit cannot be used.
    OSError
        If the folder is missing or the disk is full; no partial file is left.

    Examples
    --------
    >>> sw.to_html(scene, sw.Edit(sun_elevation=3), "evening.html")
    """
    start = edit_of(edit)
    return write_page(
        lambda: editor_page(checked_scene(scene), start, session=uuid.uuid4().hex, title=title),
        path,
        overwrite=overwrite,
    )


def editor_page(
    scene: Scene,
    edit: Edit,
    *,
    session: str,
    kept: Mapping[str, Any] | None = None,
    title: str | None = None,
) -> str:
    """Return the page of an edit; ``scene``, ``session`` and ``kept`` as in ``editor_state``."""
    from sunwidget.renderer.offscreen import render

    photo = scene.photo
    still = still_of(photo, functools.partial(render, scene, edit))
    embedded = embedded_state(editor_state(scene, edit, session=session, kept=kept))
    return page(embedded, still, title=photo.name if title is None else title, notes=_NOTES)


def explorer_page(widget: Any, *, title: str) -> str:
    """Return the page of a SkyExplorer in its present state."""
    from sunwidget.errors import RendererError

    still = None
    with contextlib.suppress(RendererError):
        picture = widget.render(_EXPLORER_STILL)
        still = Still(_jpeg(picture), _EXPLORER_STILL, "The sky at the time the page was created")
    return page(widget_state(widget), still, title=title, notes=_EXPLORER_NOTES)


def widget_state(widget: Any) -> dict[str, Any]:
    """Return a widget's state in the format of ``page``."""
    whole = widget.whole_state() if isinstance(widget, SavedLight) else widget.get_state()
    return embedded_state(
        {
            name: value
            for name, value in whole.items()
            if name not in _HOST and not name.startswith(_HOST_PREFIXES)
        }
    )


def embedded_state(traits: dict[str, Any]) -> dict[str, Any]:
    """Return traits in the format of ``page``, with the binary ones separate, as text."""
    buffers: list[dict[str, Any]] = []
    state = {name: _without_bytes(value, [name], buffers) for name, value in traits.items()}
    return {"state": state, "buffers": buffers}


def _without_bytes(value: Any, path: list[Any], buffers: list[dict[str, Any]]) -> Any:
    """Return ``value`` with None for its bytes, which are appended to ``buffers``."""
    if isinstance(value, (bytes, bytearray, memoryview)):
        data = base64.b64encode(_compress(bytes(value))).decode("ascii")
        buffers.append({"path": path, "encoding": "base64", "data": data})
        return None
    if isinstance(value, dict):
        return {key: _without_bytes(item, [*path, key], buffers) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_without_bytes(item, [*path, i], buffers) for i, item in enumerate(value)]
    return value


def _compress(data: bytes) -> bytes:
    """Return a PNG with the same pixels in fewer bytes; other data unchanged.

    Notebook traits are compressed for speed; stronger compression makes the maps a third smaller.
    """
    import cv2

    if not data.startswith(b"\x89PNG"):
        return data
    pixels = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    options = [cv2.IMWRITE_PNG_COMPRESSION, _PNG_LEVEL]
    options += [cv2.IMWRITE_PNG_STRATEGY, cv2.IMWRITE_PNG_STRATEGY_DEFAULT]
    return min(data, bytes(cv2.imencode(".png", pixels, options)[1]), key=len)


def still_of(photo: Photo, render: Callable[..., np.ndarray]) -> Still:
    """Return the picture from ``render(size=(width, height))`` for a page.

    If this machine cannot render, return the original photo.
    """
    from sunwidget.errors import RendererError

    try:
        picture = render(size=photo.size_within(_STILL_EDGE))
        text = f"{photo.name}, with its sun moved"
    except RendererError:
        picture, text = photo.preview(_STILL_EDGE), f"{photo.name} as it was taken"
    return Still(_jpeg(picture), (picture.shape[1], picture.shape[0]), text)


def write_page(
    make: Callable[[], str], path: str | os.PathLike[str] | None, *, overwrite: bool
) -> Path | str:
    """Return the page from ``make``, or write it to ``path`` completely or not at all.

    An invalid ``path`` raises before the page is made.
    """
    if path is None:
        return make()
    place = target(path, overwrite=overwrite)
    text = make()
    with complete_or_absent(place, overwrite=overwrite) as unfinished:
        unfinished.write_bytes(text.encode("utf-8"))
    return place


def _jpeg(picture: np.ndarray) -> bytes:
    import cv2

    options = [cv2.IMWRITE_JPEG_QUALITY, _STILL_QUALITY]
    return bytes(cv2.imencode(".jpg", picture[..., ::-1], options)[1])
