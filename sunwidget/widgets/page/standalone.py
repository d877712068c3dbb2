"""A widget as one HTML file: what a shader draws stays live, without kernel and network."""

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
# What places a widget in a notebook means nothing in a page.
_HOST = ("layout", "tabbable", "tooltip", "_anywidget_id", "_dom_classes")
_HOST_PREFIXES = ("_model_", "_view_")
_NOTES = (
    "Drag the sun, or the sliders: everything happens in this file, and nothing leaves it.",
    "Brushes, horizon and the full size need the notebook that it was made with.",
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
    """Return the page of an edit; ``scene``, ``session`` and ``kept`` as ``editor_state``."""
    from sunwidget.renderer.offscreen import render

    photo = scene.photo
    still = still_of(photo, functools.partial(render, scene, edit))
    embedded = embedded_state(editor_state(scene, edit, session=session, kept=kept))
    return page(embedded, still, title=photo.name if title is None else title, notes=_NOTES)


def explorer_page(widget: Any, *, title: str) -> str:
    """Return the page of a SkyExplorer as it stands."""
    from sunwidget.errors import RendererError

    still = None
    with contextlib.suppress(RendererError):
        picture = widget.render(_EXPLORER_STILL)
        still = Still(_jpeg(picture), _EXPLORER_STILL, "The sky as the page was made")
    return page(widget_state(widget), still, title=title, notes=_EXPLORER_NOTES)


def widget_state(widget: Any) -> dict[str, Any]:
    """Return what a page needs of a widget, as ``page`` takes it."""
    whole = widget.whole_state() if isinstance(widget, SavedLight) else widget.get_state()
    return embedded_state(
        {
            name: value
            for name, value in whole.items()
            if name not in _HOST and not name.startswith(_HOST_PREFIXES)
        }
    )


def embedded_state(traits: dict[str, Any]) -> dict[str, Any]:
    """Return traits as ``page`` takes them: the binary ones apart, as text."""
    buffers: list[dict[str, Any]] = []
    state = {name: _without_bytes(value, [name], buffers) for name, value in traits.items()}
    return {"state": state, "buffers": buffers}


def _without_bytes(value: Any, path: list[Any], buffers: list[dict[str, Any]]) -> Any:
    """Return ``value`` with None for its bytes, which are put into ``buffers``."""
    if isinstance(value, (bytes, bytearray, memoryview)):
        data = base64.b64encode(_packed(bytes(value))).decode("ascii")
        buffers.append({"path": path, "encoding": "base64", "data": data})
        return None
    if isinstance(value, dict):
        return {key: _without_bytes(item, [*path, key], buffers) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_without_bytes(item, [*path, i], buffers) for i, item in enumerate(value)]
    return value


def _packed(data: bytes) -> bytes:
    """Return a PNG with the same pixels in fewer bytes; anything else as it is.

    What travels to a notebook is packed for speed: here it takes a third off the maps.
    """
    import cv2

    if not data.startswith(b"\x89PNG"):
        return data
    pixels = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    options = [cv2.IMWRITE_PNG_COMPRESSION, _PNG_LEVEL]
    options += [cv2.IMWRITE_PNG_STRATEGY, cv2.IMWRITE_PNG_STRATEGY_DEFAULT]
    return min(data, bytes(cv2.imencode(".png", pixels, options)[1]), key=len)


def still_of(photo: Photo, render: Callable[..., np.ndarray]) -> Still:
    """Return the picture as ``render(size=(width, height))`` makes it, for a page.

    Where this machine cannot render it is the photo as it was taken.
    """
    from sunwidget.errors import RendererError

    try:
        picture = render(size=photo.size_within(_STILL_EDGE))
        text = f"{photo.name}, its sun moved as the page was made"
    except RendererError:
        picture, text = photo.preview(_STILL_EDGE), f"{photo.name} as it was taken"
    return Still(_jpeg(picture), (picture.shape[1], picture.shape[0]), text)


def write_page(
    make: Callable[[], str], path: str | os.PathLike[str] | None, *, overwrite: bool
) -> Path | str:
    """Return the page that ``make`` makes, or write it to ``path``, whole or not at all.

    Where it cannot go is said before it is made.
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
