"""Data for the browser: the preview and the maps as encoded pictures, the rest as JSON.

The kernel keeps the full resolution; a preview's long edge has at most ``PREVIEW_EDGE`` pixels.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget import presets
from sunwidget.analysis.clouds.clouds import INDICES
from sunwidget.analysis.frame_inputs import TEXTURES, texture, uniforms
from sunwidget.analysis.horizon import horizon
from sunwidget.analysis.images.working_copy import resize
from sunwidget.analysis.maps import MAPS, levels, scene_map, shares_of
from sunwidget.analysis.networks.sun import look_for_sun
from sunwidget.analysis.notices import Notice
from sunwidget.analysis.scene import Scene
from sunwidget.edit.table import PARAMETERS, Parameter
from sunwidget.formats.png import encode_png, encode_small_png
from sunwidget.photo.photo import Photo, open_photo
from sunwidget.renderer.shader_source import frame_graph

PREVIEW_EDGE = 2048
MAP_EDGE = 1024  # long edge of an inspected map
THUMBNAIL_EDGE = 480
MAP_TRAITS = tuple(f"_{name}" for name in TEXTURES)
_SAVED_EDGE, _SAVED_QUALITY = 640, 85  # as in js/src/editor/view/saved.js
# Above this many bytes a lossless preview is not worth its size.
_LOSSLESS_BYTES = 4_000_000
_JPEG_QUALITY = 95
_thumbnails: weakref.WeakKeyDictionary[Photo, bytes] = weakref.WeakKeyDictionary()
_saved_photos: weakref.WeakKeyDictionary[Photo, bytes] = weakref.WeakKeyDictionary()


def encode_preview(photo: Photo) -> bytes:
    """Return the photo's preview, encoded as ``encode_picture`` does."""
    preview = photo.preview(PREVIEW_EDGE)
    # A cell's output holds both, and the user waits for it, so the large photo is shrunk once.
    _thumbnails[photo] = encode_small_png(open_photo(preview).preview(THUMBNAIL_EDGE))
    return encode_picture(preview)


def encode_picture(image: NDArray[np.uint8]) -> bytes:
    """Return a picture (H, W, 3) as PNG, or JPEG (quality 95, 4:4:4) if PNG would be large."""
    import cv2

    data = encode_png(image)
    if len(data) <= _LOSSLESS_BYTES:
        return data
    full_color = int(cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444)
    options = [
        cv2.IMWRITE_JPEG_QUALITY,
        _JPEG_QUALITY,
        cv2.IMWRITE_JPEG_SAMPLING_FACTOR,
        full_color,
    ]
    return bytes(cv2.imencode(".jpg", image[..., ::-1], options)[1])


def thumbnail(photo: Photo) -> bytes:
    """Return a small PNG for viewers that run no widgets."""
    if photo not in _thumbnails:
        _thumbnails[photo] = encode_small_png(photo.preview(THUMBNAIL_EDGE))
    return _thumbnails[photo]


def saved_photo(photo: Photo) -> bytes:
    """Return the small JPEG that a notebook keeps instead of the preview."""
    if photo not in _saved_photos:
        _saved_photos[photo] = encode_jpeg(photo.preview(_SAVED_EDGE))
    return _saved_photos[photo]


def encode_jpeg(image: NDArray[np.uint8]) -> bytes:
    """Return a picture (H, W, 3) as a small JPEG, for a saved notebook."""
    import cv2

    options = [cv2.IMWRITE_JPEG_QUALITY, _SAVED_QUALITY]
    return bytes(cv2.imencode(".jpg", image[..., ::-1], options)[1])


def encode_maps(scene: Scene) -> dict[str, bytes]:
    """Return the scene textures except the photo, by trait name, as PNG at the preview's size."""
    size = scene.photo.size_within(PREVIEW_EDGE)
    # In parallel, since the user waits for this after every stroke.
    with ThreadPoolExecutor(2) as pool:
        encoded = pool.map(lambda name: encode_png(texture(scene, name, size)), TEXTURES)
        return dict(zip(MAP_TRAITS, encoded, strict=True))


def encode_map(scene: Scene, name: str) -> bytes:
    """Return one map as an 8-bit gray PNG with a long edge of at most ``MAP_EDGE``.

    A level stands for the value ``SceneMap.value(level / 255)`` of the map's entry.

    Raises
    ------
    ValueError
        If there is no such map, or this photo has none.
    """
    entry = scene_map(name)
    shares = shares_of(scene, entry, scene.photo.size_within(MAP_EDGE))
    if shares is None:
        raise ValueError(f"{entry.title}: this photo has none.")
    return encode_png(levels(shares))


def map_json() -> list[dict[str, Any]]:
    """Return the table of inspectable maps as plain JSON types."""
    table = [entry._asdict() for entry in MAPS]
    return [_plain({k: v for k, v in row.items() if k not in ("read", "bits")}) for row in table]


def scene_json(scene: Scene, revision: int) -> dict[str, Any]:
    """Return the browser's data of a scene other than the maps.

    ``revision`` must differ between scenes, so that the browser notices the change.
    """
    known = uniforms(scene)
    return _plain(
        {
            "revision": revision,
            "width": scene.width,
            "height": scene.height,
            "camera": {
                "fov_vertical_deg": scene.camera.fov_vertical_deg,
                "pitch": scene.camera.pitch,
                "roll": scene.camera.roll,
            },
            "automatic": scene.automatic,
            "uniforms": {name: known[name] for name in frame_graph()["scene_uniforms"]},
            "sun": _sun_json(scene),
            "horizon": {
                "row": scene.horizon.row / scene.height,
                "roll": scene.horizon.roll,
                "confidence": scene.horizon.confidence,
                "source": scene.horizon.source,
            },
            "sureness": scene.atmosphere.confidence,
            "whiteness": whiteness(scene),
            "presets": preset_json(scene),
            "notes": [_note_json(text) for text in scene.warnings],
        }
    )


def _sun_json(scene: Scene) -> dict[str, Any]:
    """Return the photo's own sun and the source of its position.

    ``source`` is "found", "told" (by a hint), "outside" (by a hint that it is not in the picture)
    or "unseen"; ``at`` is its position in fractions of the picture, or None if it has none.
    """
    sun = scene.sun
    source = "unseen"
    if sun is not None:
        source = "told" if sun.source == "hint" else "found"
    elif scene.hints.sun_outside:
        source = "outside"
    return {
        "source": source,
        "at": None if sun is None else (sun.x / scene.width, sun.y / scene.height),
        "visible": sun is not None and sun.visible,
        "azimuth": scene.automatic["sun_azimuth"],
        "elevation": scene.automatic["sun_elevation"],
        "confidence": scene.sun_confidence,
        "moon": scene.moon,
    }


def _note_json(text: str) -> dict[str, str]:
    if isinstance(text, Notice):
        return {"about": text.about, "text": text.plain}
    return {"about": "", "text": text}


def preset_json(scene: Scene) -> list[dict[str, Any]]:
    """Return the presets with their values for this photo, as plain JSON types.

    A preset that lights windows is omitted if the photo shows none.
    """
    return [
        {"label": p.label, "title": p.help, "values": presets.values(p.name, scene)}
        for p in presets.PRESETS
        if scene.lamps.any() or not p.parameters["window_lights"]
    ]


def whiteness(scene: Scene, bins: int = 64, reach: float = 1.6) -> dict[str, Any]:
    """Return the histogram of the sky's whiteness by the index of the cloud method.

    The editor's cloud section shows it; m_min and m_max are thresholds in it. Values above
    ``reach`` count in the last bin; the sun's glare is excluded. Un-mixing uses no thresholds; for
    it the index is red over blue.

    Returns
    -------
    dict
        ``method``, ``reach``, and ``shares`` of the sky by bin, whose sum is 1, or 0 without sky.
    """
    method, small = scene.hints.method("clouds"), scene.working
    # Every other row and column is enough; the user waits for this after every stroke.
    index = INDICES.get(method, INDICES["rb_ratio"])(small.encoded[::2, ::2])
    sky = resize(scene.sky, small.width, small.height)
    sky = (sky * (resize(scene.glare, small.width, small.height) < 0.5))[::2, ::2]
    inside = np.clip(index, 0, reach * (1 - 1e-6))
    counts, _ = np.histogram(inside, bins, (0, reach), weights=sky)
    shares = counts / max(float(counts.sum()), 1e-9)
    return {"method": method, "reach": reach, "shares": shares.round(5)}


def other_horizons(scene: Scene) -> dict[str, tuple[float, float]]:
    """Return the horizons of the methods that were not used.

    Not part of ``scene_json``: some methods are slow, and few users ask.

    Returns
    -------
    dict
        Rows at the left and right edges in fractions of the height, by name of the method.
        Methods that find none, or fall back on another, are omitted.
    """
    working = scene.working
    sky = resize(scene.sky, working.width, working.height)
    water = resize(look_for_sun(working).water, working.width, working.height)
    rows = {}
    for name, method in horizon.METHODS.items():
        found = method(sky, working.encoded, water).scaled(*working.zoom)
        if found.source != name or name == scene.horizon.source or found.confidence == 0:
            continue
        rise = math.tan(math.radians(found.roll)) * scene.width / 2
        rows[name] = ((found.row - rise) / scene.height, (found.row + rise) / scene.height)
    return rows


def parameter_json(rows: Iterable[Parameter] = PARAMETERS) -> list[dict[str, Any]]:
    """Return a table of parameters, the Edit's by default, as plain JSON types."""
    return [_plain(p._asdict()) for p in rows]


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _plain(item) for name, item in value.items()}
    if isinstance(value, (tuple, list, np.ndarray)):
        return [_plain(item) for item in value]
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    if isinstance(value, (float, np.floating)):
        # JSON has no NaN; a view must not fail because of one.
        return float(value) if math.isfinite(value) else 0.0
    if isinstance(value, np.integer):
        return int(value)
    return value
