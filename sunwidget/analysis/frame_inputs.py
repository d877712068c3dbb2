"""Uniforms and textures of a Scene, which the frame graph reads on both hosts.

docs/developer/frame-graph.md describes their names and contents.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from sunwidget.analysis.clear_sky import clear_sky
from sunwidget.analysis.depth import levels
from sunwidget.analysis.fit.fit import Response
from sunwidget.analysis.haze import air_share, cover_of_low_sky
from sunwidget.analysis.images import color_transfer
from sunwidget.analysis.images.enlarge import resize_rows
from sunwidget.analysis.images.noise import noise_level
from sunwidget.analysis.images.working_copy import resize, smoothstep
from sunwidget.analysis.scene import Scene
from sunwidget.analysis.segmentation.feather import softening
from sunwidget.analysis.sun.camera_glare import glare_profile, own_disc
from sunwidget.analysis.water.glitter import (
    azimuth_column,
    glints_on_land,
    glitter,
    own_glints,
    roughness,
)
from sunwidget.analysis.water.mirror import Mirror, find_mirror
from sunwidget.analysis.windows import panes

T = TypeVar("T")
Size = tuple[int, int]
Map = NDArray[np.float32]

_NO_SKY, _ALL_SKY = 0.02, 0.99  # a pixel between them is of the skyline
_SAME = 1 / 255  # a change of the matte below its 8-bit levels
_SHADOW = 2.0**-7  # display-linear luminance at which a picture's key stops falling


def _cache_per_scene(find: Callable[[Scene], T]) -> Callable[[Scene], T]:
    """Cache a result per scene, since all strips of a picture and all strokes use it."""
    results: WeakKeyDictionary[Scene, T] = WeakKeyDictionary()

    @functools.wraps(find)
    def find_once(scene: Scene) -> T:
        if scene not in results:
            results[scene] = find(scene)
        return results[scene]

    return find_once


@_cache_per_scene
def uniforms(scene: Scene) -> dict[str, Any]:
    """Return the frame graph's scene uniforms by name: floats and tuples of floats."""
    small, sky = scene.working, scene.small_sky
    sun_share = 0.0 if scene.sun is None else float(scene.sun.blot.mean())
    share = float(sky.mean())
    logs = np.log2(np.maximum(scene.without_sun.working.luminance, _SHADOW))
    own = color_transfer.statistics_of_lab(small.lab, sky)
    found: dict[str, Any] = {
        "camera_right": scene.camera.right,
        "camera_up": scene.camera.up,
        "camera_forward": scene.camera.forward,
        "camera_focal": scene.camera.focal / scene.camera.height,
        "sun_visible": float(scene.shows_sun),
        "sun_located": float(scene.shows_sun or scene.moon is not None),
        "sun_known": float(_sun_known(scene)),
        "depth_told": float(scene.hints.depth is not None),
        "photo_light": float(scene.lit_by_moon),
        "water_roughness": _water_roughness(scene),
        "sky_share": share,
        "photo_key": float(logs.mean()),
        "photo_sky_key": float((logs * sky).sum() / max(float(sky.sum()), 1e-6)),
        "sun_mask_share": min(1.0, sun_share / max(share, 1 / sky.size)),
        "photo_sky_mean": own.mean,
        "photo_sky_deviation": own.deviation,
        "photo_sky_linear_mean": _weighted_mean(small.linear, sky),
        "photo_land_linear_mean": _weighted_mean(small.linear, 1 - sky),
        "response_shoulder": 0.0,
        "response_contrast": 1.0,
        "glare_profile": (0.0, 3.0, 2.0),
        "own_glints": 0.0,
        "noise_level": noise_level(scene.photo, scene.sky),
        "photo_height": float(scene.height),
        "cover_of_low_sky": cover_of_low_sky(sky, scene.cloud_map),
        "lamp_scale": panes.BRIGHTEST,
        "sky_gain": (1.0, 1.0, 1.0),
    }
    found |= scene.response | own_disc(scene.sun, scene.camera, small)
    if scene.fitted is not None:
        found["glare_profile"] = glare_profile(scene.fitted, scene.camera)
        found["own_glints"] = _own_glints(scene, scene.fitted.response, found["water_roughness"])
    return found


def _sun_known(scene: Scene) -> bool:
    """Return whether the photo or the user tells where its sun, or how far its land, is."""
    return any(known is not None for known in (scene.sun, scene.moon, scene.hints.depth))


@_cache_per_scene
def _mirror(scene: Scene) -> Mirror:
    seen = scene.working, scene.small_sky, scene.small_water
    return find_mirror(*seen, scene.camera, glints=scene.shows_sun)


def _water_roughness(scene: Scene) -> float:
    if scene.sun is None or not scene.sun.visible:
        return _mirror(scene).roughness
    sun = scene.sun.azimuth, scene.sun.elevation
    return roughness(scene.working, scene.small_water, scene.camera, sun)


def _own_glints(scene: Scene, response: Response, rough: float) -> float:
    if scene.sun is None or not scene.sun.visible:
        return 0.0
    sun = scene.sun.azimuth, scene.sun.elevation
    return own_glints(scene.working, scene.small_water, scene.camera, sun, response, rough)


def _weighted_mean(linear: np.ndarray, weight: np.ndarray) -> tuple[float, float, float]:
    total = max(float(weight.sum()), 1e-6)
    mean = weight.ravel() @ linear.reshape(-1, 3) / total
    return (float(mean[0]), float(mean[1]), float(mean[2]))


def layers(scene: Scene, size: Size | None = None, rows: slice = slice(None)) -> np.ndarray:
    """Return sky matte, clouds, land mirrored by water, air: (H, W, 4) float32 in [0, 1].

    Matte and opacity are softened where the photo shows no edge (segmentation/feather.py); the air
    is its share of the land's light (haze.py). ``size`` (width, height) selects another size than
    the photo's, ``rows`` only some rows.
    """
    width, height = size or (scene.width, scene.height)
    maps = (scene.sky, scene.cloud_map, _mirror(scene).land, _air_share(scene))
    found = [resize_rows(image, width, height, rows) for image in maps]
    softer = _softening(scene)
    if softer is not None:
        first, end = _touched_rows((softer != (0, 0, 1)).any(axis=(1, 2)), height, rows)
        # Channel by channel: NumPy is several times slower where channels alternate.
        change = [resize_rows(softer[..., i], width, height, slice(first, end)) for i in range(3)]
        top = rows.indices(height)[0]
        for i in range(2):
            found[i] = np.array(found[i])  # it may be the scene's own
            part = found[i][first - top : end - top]
            part *= change[2]
            part += change[i]
            np.clip(part, 0, 1, out=part)
    return np.stack(found, axis=-1)


def _touched_rows(small: np.ndarray, height: int, rows: slice) -> tuple[int, int]:
    """Return first and end of ``rows`` that a small map's change (h,) touches; at least one row."""
    touched = np.flatnonzero(small)
    first, end, _ = rows.indices(height)
    # Interpolation spreads the values by a row.
    scale = height / small.size
    top = min(max(first, int((touched[0] - 1) * scale)), end - 1)
    return top, max(min(end, math.ceil((touched[-1] + 2) * scale)), top + 1)


@_cache_per_scene
def _air_share(scene: Scene) -> np.ndarray:
    return air_share(scene.working, scene.small_sky)


@_cache_per_scene
def _softening(scene: Scene) -> np.ndarray | None:
    # A given matte is not softened, and neither is what strokes changed.
    base = scene.unstroked
    if base is None:
        if scene.decision.final:
            return None
        softer = softening(scene.working, scene.small_sky, scene.cloud_map, scene.glare)
        return softer if softer[..., :2].any() else None
    found = _softening(base)
    if found is None:
        return None
    painted = np.abs(scene.small_sky - base.small_sky)
    height, width = found.shape[:2]
    kept = resize(painted, width, height) >= _SAME
    return np.where(kept[..., None], np.array([0, 0, 1], np.float32), found)


def surface(scene: Scene, size: Size | None = None, rows: slice = slice(None)) -> np.ndarray:
    """Return glare, water, glitter, log-depth of the land: (H, W, 4) float32 in [0, 1].

    Glare is where the old sun hides the sky behind it: its clipped core and its halo, fading
    outwards; on land its share of the light. The log-depth (depth/levels.py) is dithered; in the
    sky it is that of the nearest land. ``size`` and ``rows`` as for ``layers``.
    """
    width, height = size or (scene.width, scene.height)
    level = levels.to_level(scene.log_depth(width, height, rows))

    wet = [
        scene.water_at((width, height), rows),
        resize_rows(_glitter(scene), width, height, rows),
    ]
    below = _below_skyline(scene)
    if below is not None:
        first, end = _touched_rows(below.rows, height, rows)
        top = rows.indices(height)[0]
        sky = resize_rows(scene.sky, width, height, slice(first, end))
        at_skyline = smoothstep(0.0, 0.1, sky) * (sky < _ALL_SKY)
        for i, image in enumerate((below.water, below.glitter)):
            wet[i] = np.array(wet[i])  # it may be the scene's own
            part = wet[i][first - top : end - top]
            part += at_skyline * (resize_rows(image, width, height, slice(first, end)) - part)
    glare = resize_rows(scene.glare, width, height, rows)
    return np.stack([glare, *wet, levels.dithered(level, rows.indices(height)[0])], axis=-1)


class _Below(NamedTuple):
    """What lies below the skyline, and the rows (h,) bool where that differs from the maps."""

    water: np.ndarray
    glitter: np.ndarray
    rows: np.ndarray


@_cache_per_scene
def _below_skyline(scene: Scene) -> _Below | None:
    """Return water and glitter with those below the skyline in its pixels, None without any.

    What a pixel of the skyline holds beside sky is what lies below it. The maps are soft there, and
    a little of burnt glints would outshine the sea.
    """
    import cv2

    sky = scene.small_sky
    marks = np.dstack([scene.small_water, _glitter(scene)])
    land = sky < _NO_SKY
    near = cv2.dilate(land.astype(np.float32), np.ones((9, 9), np.uint8))
    below = levels.fill_sky(marks, land) * near[..., None]
    changed = (sky > 0) & (sky < 1) & (below != marks).any(-1)
    if not changed.any():
        return None
    water, glitter = (np.ascontiguousarray(below[..., i]) for i in range(2))
    return _Below(water, glitter, changed.any(axis=1))


@_cache_per_scene
def _glitter(scene: Scene) -> np.ndarray:
    # Below a sun that the photo does not show, bright water may as well be foam or a mirror image.
    column = None if scene.sun is None else azimuth_column(scene.camera, scene.sun.azimuth)
    zone = glitter(scene.working, scene.small_sky, scene.small_water, column)
    # Glare over water counts as glints; glare over land does not. White land without a sun in
    # front is snow.
    glare = resize(scene.glare, scene.working.width, scene.working.height) * (1 - scene.small_sky)
    wet = np.maximum(zone, glare)
    dry = np.zeros_like(zone)
    if column is not None:
        shiny = glints_on_land(scene.working, scene.small_sky, scene.small_water)
        dry = zone * (1 - glare) * shiny
    water = smoothstep(0.2, 0.8, scene.small_water)  # as in frame.glsl
    return (dry + water * (wet - dry)).astype(np.float32)


_READ: dict[str, Callable[[Scene, Size], np.ndarray]] = {
    "layers": layers,
    "surface": surface,
    "backdrop": lambda scene, _: scene.backdrop,
    "clear_sky": lambda scene, _: clear_sky(scene),
    "relief": lambda scene, _: scene.relief,
    "transfer": lambda scene, _: scene.transfer,
    "lamps": lambda scene, _: scene.lamps,
}

TEXTURES = tuple(_READ)
"""The scene textures that the analysis provides, in addition to the photo."""


def texture(scene: Scene, name: str, size: Size) -> NDArray[np.uint8]:
    """Return a scene texture in 8-bit levels for both hosts, (h, w, n) uint8.

    Parameters
    ----------
    scene : Scene
    name : str
        One of ``TEXTURES``.
    size : (width, height)
        Size of ``layers`` and ``surface``; the others have fixed sizes.
    """
    return quantise_map(_READ[name](scene, size))


def quantise_map(image: Map) -> NDArray[np.uint8]:
    """Return a map in [0, 1] as 8-bit levels for both hosts."""
    quantised = image * 255
    quantised += 0.5
    return np.clip(quantised, 0, 255, out=quantised).astype(np.uint8)
