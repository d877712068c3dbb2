"""The land's relief for the frame: its normals, and the light of sun and sky that reaches it."""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.depth.field import guided
from sunwidget.analysis.depth.levels import fill_sky
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.land import LandMaps, sun_basis
from sunwidget.geometry.camera import Camera

_EDGES, _NO_EDGE = 4, 4e-4  # pixels of the working copy; squared contrast below an edge
_LARGEST_SHARE = 2.0  # as in shaders/land/read_transfer.glsl


def encoded(maps: LandMaps, working: Working) -> np.ndarray:
    """Return the texture ``relief`` at working size, (h, w, 4) float32 in [0, 1].

    It has the normal's right and up as (1 + n) / 2, the share of the sun that reaches the surface,
    and the cosine between normal and sun (shaders/land/relief.glsl). Shadow edges follow the
    picture.
    """
    width, height = working.width, working.height
    slope = resize(np.ascontiguousarray(0.5 + 0.5 * maps.normal[..., :2]), width, height)
    lit = guided(working.encoded, resize(maps.sunlit, width, height), _EDGES, _NO_EDGE)
    facing = resize(maps.facing, width, height)
    return np.clip(np.dstack([slope, lit, facing]), 0, 1).astype(np.float32)


def encoded_transfer(maps: LandMaps) -> np.ndarray:
    """Return the texture ``transfer``, (3 h, w, 4) float32 in [0, 1].

    It has the shares' signed roots in three blocks of four (shaders/land/read_transfer.glsl).
    """
    root = np.sqrt(np.minimum(np.abs(maps.transfer) / _LARGEST_SHARE, 1))
    code = (0.5 + 0.5 * np.copysign(root, maps.transfer)).astype(np.float32)
    return np.concatenate(np.split(code, 3, axis=-1))


def with_given_depth(
    maps: LandMaps, log_depth: np.ndarray, camera: Camera, sun: tuple[float, float]
) -> LandMaps:
    """Return the maps for land with a given depth: its slopes, without shadows.

    Parameters
    ----------
    maps : LandMaps
    log_depth : (h, w) float32
        ln(metres) along the optical axis.
    camera : Camera
        Camera for any size.
    sun : (azimuth, elevation)
        The photo's sun in degrees.
    """
    rows, columns = maps.facing.shape
    normal = resize(normals(log_depth, camera), columns, rows)
    normal /= np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-6)
    axes = np.array([camera.right, camera.up, camera.forward])
    world = normal @ (axes * (1, -1, -1)).T.astype(np.float32)
    # Least squares of the cosine over a grid of the sky, in the basis functions of suns.
    azimuth, height = np.meshgrid(np.linspace(0, 2 * np.pi, 24, endpoint=False), _HEIGHTS)
    suns = _directions(azimuth, height).reshape(-1, 3)
    solve = np.linalg.pinv(sun_basis(suns)).T.astype(np.float32)
    transfer = np.maximum(world @ suns.T.astype(np.float32), 0) @ solve
    facing = np.maximum(world @ _directions(*np.radians(sun)).astype(np.float32), 0)
    return maps._replace(normal=normal, facing=facing, transfer=transfer)


def _directions(azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
    """Return unit vectors (..., 3): right, up, forward. Angles are in radians."""
    flat = np.cos(elevation)
    return np.stack([flat * np.sin(azimuth), np.sin(elevation), flat * np.cos(azimuth)], -1)


_HEIGHTS = np.arcsin((np.arange(8) + 0.5) / 8)


def on_land(maps: LandMaps, sky: np.ndarray) -> LandMaps:
    """Return the maps with the sky filled from the nearest land.

    The network has no values for the sky, which would show at the skyline.
    """

    def filled(values: np.ndarray) -> np.ndarray:
        rows, columns = values.shape[:2]
        return fill_sky(np.ascontiguousarray(values), resize(sky, columns, rows) < 0.5)

    return maps._replace(
        sunlit=filled(maps.sunlit),
        normal=filled(maps.normal),
        facing=filled(maps.facing),
        transfer=filled(maps.transfer),
    )


def normals(log_depth: np.ndarray, camera: Camera) -> np.ndarray:
    """Return unit normals of a depth: to the camera's right, up, and towards it.

    The slope is measured on the side of a pixel with the more similar depth, which keeps edges.

    Parameters
    ----------
    log_depth : (h, w) float32
        ln(metres) along the optical axis.
    camera : Camera
        Camera for any size.

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
    """Return the vector to the next pixel along an axis, (h, w, 3), or from the previous one."""
    step, jump = np.diff(points, axis=axis), np.abs(np.diff(log_depth, axis=axis))
    ends = [(0, 0)] * 2
    ends[axis] = (0, 1)
    after = np.pad(step, [*ends, (0, 0)], mode="edge")
    ahead = np.pad(jump, ends, constant_values=np.inf)
    ends[axis] = (1, 0)
    before = np.pad(step, [*ends, (0, 0)], mode="edge")
    behind = np.pad(jump, ends, constant_values=np.inf)
    return np.where((ahead <= behind)[..., None], after, before)
