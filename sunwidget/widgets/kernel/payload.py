"""What travels to the browser: the preview and the maps as encoded pictures, the rest as JSON.

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
MAP_EDGE = 1024  # of an inspected map
THUMBNAIL_EDGE = 480
MAP_TRAITS = tuple(f"_{name}" for name in TEXTURES)
_SAVED_EDGE, _SAVED_QUALITY = 640, 85  # as js/src/editor/view/saved.js has them
# Above this many bytes a lossless preview costs more than it shows.
_LOSSLESS_BYTES = 4_000_000
_JPEG_QUALITY = 95
_thumbnails: weakref.WeakKeyDictionary[Photo, bytes] = weakref.WeakKeyDictionary()
_saved_photos: weakref.WeakKeyDictionary[Photo, bytes] = weakref.WeakKeyDictionary()


def encode_preview(photo: Photo) -> bytes:
    """Return the photo's preview, encoded as ``encode_picture`` does."""
    preview = photo.preview(PREVIEW_EDGE)
    # A cell's output holds both, and a person waits for it: the large photo is shrunk once.
    _thumbnails[photo] = encode_small_png(open_photo(preview).preview(THUMBNAIL_EDGE))
    return encode_picture(preview)


def encode_picture(image: NDArray[np.uint8]) -> bytes:
    """Return a picture (H, W, 3) as PNG, or JPEG (quality 95, 4:4:4) where PNG would be large."""
    import cv2

    data = encode_png(image)
    if len(data) <= _LOSSLESS_BYTES:
        return data
    full_colour = int(cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444)
    options = [
        cv2.IMWRITE_JPEG_QUALITY,
        _JPEG_QUALITY,
        cv2.IMWRITE_JPEG_SAMPLING_FACTOR,
        full_colour,
    ]
    return bytes(cv2.imencode(".jpg", image[..., ::-1], options)[1])


def thumbnail(photo: Photo) -> bytes:
    """Return a small PNG for viewers that run no widgets."""
    if photo not in _thumbnails:
        _thumbnails[photo] = encode_small_png(photo.preview(THUMBNAIL_EDGE))
    return _thumbnails[photo]


def saved_photo(photo: Photo) -> bytes:
    """Return the small JPEG that a notebook keeps in the preview's place."""
    if photo not in _saved_photos:
        _saved_photos[photo] = encode_jpeg(photo.preview(_SAVED_EDGE))
    return _saved_photos[photo]


def encode_jpeg(image: NDArray[np.uint8]) -> bytes:
    """Return a picture (H, W, 3) as a small JPEG, for what a notebook keeps."""
    import cv2

    options = [cv2.IMWRITE_JPEG_QUALITY, _SAVED_QUALITY]
    return bytes(cv2.imencode(".jpg", image[..., ::-1], options)[1])


def encode_maps(scene: Scene) -> dict[str, bytes]:
    """Return the scene textures but the photo, by trait name, as PNG at the preview's size."""
    size = scene.photo.size_within(PREVIEW_EDGE)
    # Side by side: a person waits for this after every stroke.
    with ThreadPoolExecutor(2) as pool:
        encoded = pool.map(lambda name: encode_png(texture(scene, name, size)), TEXTURES)
        return dict(zip(MAP_TRAITS, encoded, strict=True))


def encode_map(scene: Scene, name: str) -> bytes:
    """Return one map as an 8-bit grey PNG, long edge at most ``MAP_EDGE``.

    A level's value is ``SceneMap.value(level / 255)`` of the map's entry.

    Raises
    ------
    ValueError
        When there is no such map, or this photo has none.
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
    """Return what the browser's view of a scene needs beside the maps.

    ``revision`` differs from one scene to the next, so that the trait's change is seen.
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
    """Return what is known of the photo's own sun, and where it comes from.

    ``source`` is "found", "told", "outside" (somebody said that nothing in the picture is it) or
    "unseen"; ``at`` its place in fractions of the picture, None where it has none.
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
    """Return the presets with what each sets in this photo, as plain JSON types.

    One that lights windows is left out where the photo shows none.
    """
    return [
        {"label": p.label, "title": p.help, "values": presets.values(p.name, scene)}
        for p in presets.PRESETS
        if scene.lamps.any() or not p.parameters["window_lights"]
    ]


def whiteness(scene: Scene, bins: int = 64, reach: float = 1.6) -> dict[str, Any]:
    """Return how white the sky is, measured as the method that found the clouds does.

    The histogram of the editor's cloud section: m_min and m_max cut it. What is whiter than
    ``reach`` counts in the last bin; the sun's glare is left out. Un-mixing uses no thresholds,
    so there it is red over blue.

    Returns
    -------
    dict
        ``method``, ``reach``, and ``shares`` of the sky by bin: they sum to 1, or to 0 without
        sky.
    """
    method, small = scene.hints.method("clouds"), scene.working
    # Every other row and column tells as much: a person waits for it after every stroke.
    index = INDICES.get(method, INDICES["rb_ratio"])(small.encoded[::2, ::2])
    sky = resize(scene.sky, small.width, small.height)
    sky = (sky * (resize(scene.glare, small.width, small.height) < 0.5))[::2, ::2]
    inside = np.clip(index, 0, reach * (1 - 1e-6))
    counts, _ = np.histogram(inside, bins, (0, reach), weights=sky)
    shares = counts / max(float(counts.sum()), 1e-9)
    return {"method": method, "reach": reach, "shares": shares.round(5)}


def other_horizons(scene: Scene) -> dict[str, tuple[float, float]]:
    """Return where the methods that were not taken see the horizon.

    Not part of ``scene_json``: some look at the whole picture, and few people ask.

    Returns
    -------
    dict
        Rows at the left and the right edge in fractions of the height, by method's name;
        methods that see none, or fall back on another, are left out.
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
        # JSON has no NaN; a view must not die of one.
        return float(value) if math.isfinite(value) else 0.0
    if isinstance(value, np.integer):
        return int(value)
    return value
