"""A widget as one HTML file: what a shader draws stays live, without kernel and network."""

from __future__ import annotations

import base64
import contextlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.files import complete_or_absent, target
from sunwidget.photo.photo import Photo
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


def editor_page(
    embedded: dict[str, Any], still: Still, photo: Photo, *, title: str | None = None
) -> str:
    """Return the page of an editor from its ``embedded_state``."""
    state = embedded["state"] | {
        # The steps back are the maker's own, and a stroke taken back would need the kernel.
        "_history": {"past": [], "future": []},
        # Pages are passed on: where a photo was taken is in none that its maker did not put there.
        "_photo_place": {},
        # Notes tell the maker what to correct; in a page nothing can be.
        "_scene": embedded["state"]["_scene"] | {"notes": []},
    }
    name = photo.name if title is None else title
    return page({**embedded, "state": state}, still, title=name, notes=_NOTES)


def explorer_page(widget: Any, *, title: str) -> str:
    """Return the page of a SkyExplorer as it stands."""
    from sunwidget.errors import RendererError

    still = None
    with contextlib.suppress(RendererError):
        picture = widget.render(_EXPLORER_STILL)
        still = Still(_jpeg(picture), _EXPLORER_STILL, "The sky as the page was made")
    return page(embedded_state(widget), still, title=title, notes=_EXPLORER_NOTES)


def embedded_state(widget: Any) -> dict[str, Any]:
    """Return what a page needs of a widget, as ``page`` takes it."""
    buffers: list[dict[str, Any]] = []
    whole = widget.whole_state() if isinstance(widget, SavedLight) else widget.get_state()
    state = {
        name: _without_bytes(value, [name], buffers)
        for name, value in whole.items()
        if name not in _HOST and not name.startswith(_HOST_PREFIXES)
    }
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


def written_page(
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
