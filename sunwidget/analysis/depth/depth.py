"""Depth: metres along the optical axis, up to one scale (the camera's height is a guess).

``METHODS`` maps a name to a function ``(View) -> DepthField``. ``analyze(depth=…)`` also takes an
array of metres (``check_depth``) or any network for depth from one picture (``network.py``).
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.analysis.depth import flat_ground
from sunwidget.analysis.depth.field import DepthField, guided
from sunwidget.analysis.depth.levels import fill_sky
from sunwidget.analysis.depth.network import DepthNetwork, SeenDepth
from sunwidget.analysis.depth.view import View
from sunwidget.analysis.images.working_copy import resize, smoothstep
from sunwidget.analysis.networks.land import look_at_land
from sunwidget.analysis.segmentation.coarse_sky import check_proportions, plain_numbers
from sunwidget.errors import AnalysisError
from sunwidget.photo.decode_heif import DepthMap

_LYING = 0.9, 0.99  # cosines of slopes, from no ground to ground
_LEAST_GROUND = 0.01  # of the picture: less ground gives no scale
_STANDS, _LIES = 0.25, 2.25  # of ln depth: distance from the plane at which a pixel is half ground
_SEEN_ERROR = 0.6  # of ln depth: median over worlds that the network never saw
_SMOOTH, _EPSILON = 0.02, 1e-2  # of the width; squared contrast that is an edge


DepthInput = np.ndarray | DepthNetwork | SeenDepth | None
"""A caller's depth after checks; None if a method was named."""


def ground_plane(view: View) -> DepthField:
    """Return flat ground below the horizon without objects; everything above is far."""
    nothing = np.zeros(view.shape)
    return _field(view, nothing, _ground(view), _ground_error(view))


def network(view: View) -> DepthField:
    """Return the land network's depth, and the ground plane where the two agree.

    The plane, which is exact at every pixel, gives the scale from ground that is surely visible.
    """
    maps, ground = look_at_land(view.photo), _ground(view)
    rows, columns = view.shape
    seen = resize(maps.log_depth, columns, rows)
    up = np.array(view.camera.up, np.float32) * (1, -1, -1)
    slope = resize(maps.normal @ up.astype(np.float32), columns, rows)
    lies = smoothstep(*_LYING, slope) * (view.fall > 0)
    far = view.fall < 3 * view.horizon_error / view.camera.focal
    sure = view.land & (slope > _LYING[0]) & ~far
    if sure.mean() > _LEAST_GROUND:
        seen = seen + np.median((ground - seen)[sure])
    seen = _smoothed(view, np.minimum(seen, np.log(flat_ground.FAR)), view.land)
    apart = ((seen - ground) / (_STANDS + lies * (_LIES - _STANDS))) ** 2
    share = apart / (1 + apart) * (1 - view.water * (view.fall > 0))
    error = _mixed_error(view, ground, share, seen)
    return _field(view, share, seen, error)


METHODS: dict[str, Callable[[View], DepthField]] = {
    "network": network,
    "ground_plane": ground_plane,
}


def check_depth(value: Any, size: tuple[int, int]) -> DepthInput:
    """Check a caller's depth and return it; None for the name of a method.

    Parameters
    ----------
    value : str, Path, DepthNetwork, DepthMap or array_like
        Name in ``METHODS``, a network or its path, a phone's map, or (H, W) metres above 0, inf for
        the sky. An array need not have the photo's size.
    size : (width, height)
        Size of the photo in pixels.

    Raises
    ------
    AnalysisError
        If it is none of them, or an array with NaN or values of 0 and less, inf everywhere, or
        with other proportions than the photo by more than rounding.
    """
    choices = (
        f"depth has no method {value!r:.80}; choose one of {', '.join(METHODS)}, or pass the "
        "path of an .onnx file, or an array (H, W) of metres."
    )
    if isinstance(value, DepthNetwork):
        return value
    if isinstance(value, DepthMap):
        return SeenDepth(value.values, value.kind)
    if isinstance(value, (str, Path)):
        if str(value).lower().endswith(".onnx"):
            return DepthNetwork(value)
        if str(value) in METHODS:
            return None
        raise AnalysisError(choices)
    try:
        array = plain_numbers(np.asarray(value))
    except (TypeError, ValueError) as error:
        raise AnalysisError(choices) from error
    if array.ndim == 0:
        raise AnalysisError(choices)
    if array.ndim != 2 or array.size == 0:
        raise AnalysisError(f"A depth map must have shape (height, width), not {array.shape}.")
    if np.isnan(array).any() or (array <= 0).any():
        raise AnalysisError(
            "The depth map has NaN, zero or negative values. It must have metres above 0, and inf "
            "in the sky."
        )
    if not np.isfinite(array).any():
        raise AnalysisError("The depth map is infinite everywhere. The land must have metres.")
    check_proportions("depth map", array.shape, size)
    return array


def field_from_metres(view: View, depth: np.ndarray) -> DepthField:
    """Return the field of a given map (h, w) in metres, inf for the sky."""
    land = np.isfinite(depth)
    log_depth = fill_sky(np.log(np.where(land, depth, 1)).astype(np.float32), land)
    everywhere = np.ones(depth.shape, np.float32)
    share = view.horizon_error / view.shape[0]
    return DepthField(everywhere, log_depth, everywhere, view.camera, share, sharpen=False)


def _ground(view: View) -> np.ndarray:
    camera = view.camera
    return flat_ground.log_depth(view.fall, view.horizon_error, camera.focal, camera.height)


def _ground_error(view: View) -> np.ndarray:
    return flat_ground.log_error(view.fall, view.horizon_error, view.camera.focal)


def _smoothed(view: View, log_depth: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Extend known values to all pixels, and smooth them between the picture's edges."""
    filled = fill_sky(log_depth.astype(np.float32), known)
    radius = max(2, round(_SMOOTH * view.shape[1]))
    return guided(view.working.encoded, filled, radius, _EPSILON)


def _mixed_error(
    view: View, ground: np.ndarray, share: np.ndarray, log_depth: np.ndarray
) -> np.ndarray:
    """Return the standard error of a mixture of the ground and deviations from it."""
    apart = share * (1 - share) * (log_depth - ground) ** 2
    squared = share * _SEEN_ERROR**2 + (1 - share) * _ground_error(view) ** 2 + apart
    return np.asarray(np.sqrt(squared))


def _field(view: View, share: np.ndarray, log_depth: np.ndarray, error: np.ndarray) -> DepthField:
    """Return the field, with the sky filled from the nearest land."""
    both = fill_sky(np.dstack([share, log_depth]).astype(np.float32), view.land)
    share, log_depth = both[..., 0].copy(), both[..., 1].copy()
    confidence = (1 / (1 + (2 * np.asarray(error)) ** 2)).astype(np.float32)
    horizon_error = view.horizon_error / view.shape[0]
    return DepthField(share, log_depth, confidence, view.camera, horizon_error)


def find_depth(view: View, given: DepthInput, method: str) -> DepthField:
    """Return the depth given as metres or by a network, else that of a method's name."""
    if isinstance(given, np.ndarray):
        return field_from_metres(view, given)
    if given is not None:
        return given(view, view.working)
    found: DepthField = METHODS[method](view)
    return found
