"""The land's relief as the frame reads it: how it lies, and what of sun and sky reaches it."""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.depth_field import guided
from sunwidget.analysis.depth_level import fill_sky
from sunwidget.analysis.land_network import LandMaps
from sunwidget.analysis.working import Working, resize
from sunwidget.camera import Camera

_EDGES, _NO_EDGE = 4, 4e-4  # pixels of the working copy; squared contrast that is no edge


def encoded(maps: LandMaps, working: Working, normal: np.ndarray | None = None) -> np.ndarray:
    """Return the texture ``relief`` at working size, (h, w, 4) float32 in [0, 1].

    The normal's right and up as (1 + n) / 2, what of the sun reaches the surface, and what of
    the sky does (shaders/lib/relief.glsl). The edges of shadows are the picture's. Of a depth that
    somebody told, ``normal`` (h, w, 3) is better known than the network's.
    """
    width, height = working.width, working.height
    normal = maps.normal if normal is None else normal
    slope = resize(np.ascontiguousarray(0.5 + 0.5 * normal[..., :2]), width, height)
    lit = guided(working.encoded, resize(maps.sunlit, width, height), _EDGES, _NO_EDGE)
    openness = resize(maps.openness, width, height)
    return np.clip(np.dstack([slope, lit, openness]), 0, 1).astype(np.float32)


def on_land(maps: LandMaps, sky: np.ndarray) -> LandMaps:
    """Return the maps with their values in the sky taken from the nearest land.

    The network says nothing of the sky; at the skyline it would show.
    """

    def filled(values: np.ndarray) -> np.ndarray:
        rows, columns = values.shape[:2]
        return fill_sky(np.ascontiguousarray(values), resize(sky, columns, rows) < 0.5)

    return maps._replace(
        sunlit=filled(maps.sunlit),
        normal=filled(maps.normal),
        rise=filled(maps.rise),
        openness=filled(maps.openness),
    )


def normals(log_depth: np.ndarray, camera: Camera) -> np.ndarray:
    """Return unit normals of a depth: to the camera's right, up, and towards it.

    Each side of a pixel that is more like it in depth tells the slope, so that edges stay.

    Parameters
    ----------
    log_depth : (h, w) float32
        ln(metres) along the optical axis.
    camera : Camera
        Of any size.

    Returns
    -------
    (h, w, 3) float32
    """
    import cv2

    height, width = log_depth.shape
    if min(height, width) < 2:  # no slope
        return np.broadcast_to(np.array([0, 0, 1], np.float32), (height, width, 3))
    focal = camera.focal * height / camera.height
    x = (np.arange(width) + 0.5 - width / 2) / focal
    y = (height / 2 - np.arange(height) - 0.5) / focal
    rays = np.dstack([*np.meshgrid(x, y), np.full((height, width), -1.0)])
    points = rays * np.exp(log_depth.astype(np.float64))[..., None]
    right, down = (_step(points, log_depth, axis) for axis in (1, 0))
    normal = np.cross(down, right)
    normal /= np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-30)
    normal = cv2.medianBlur(normal.astype(np.float32), 5)
    return normal / np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-6)


def _step(points: np.ndarray, log_depth: np.ndarray, axis: int) -> np.ndarray:
    """Return the way to the next pixel along an axis, (h, w, 3), or from the one before it."""
    step, jump = np.diff(points, axis=axis), np.abs(np.diff(log_depth, axis=axis))
    ends = [(0, 0)] * 2
    ends[axis] = (0, 1)
    after = np.pad(step, [*ends, (0, 0)], mode="edge")
    ahead = np.pad(jump, ends, constant_values=np.inf)
    ends[axis] = (1, 0)
    before = np.pad(step, [*ends, (0, 0)], mode="edge")
    behind = np.pad(jump, ends, constant_values=np.inf)
    return np.where((ahead <= behind)[..., None], after, before)


def encoded_rise(maps: LandMaps) -> np.ndarray:
    """Return the texture ``rise``, (2 h, w, 4) float32 in [0, 1]: (sine + 0.25) / 1.5.

    Bearings 0 to 3 lie above 4 to 7 (shaders/lib/rise.glsl).
    """
    code = np.clip((maps.rise + 0.25) / 1.5, 0, 1).astype(np.float32)
    return np.concatenate([code[..., :4], code[..., 4:]])
