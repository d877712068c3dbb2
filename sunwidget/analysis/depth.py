"""Depth: metres along the optical axis, up to one scale (the eye's height is a guess).

``METHODS`` maps a name to a function ``(View) -> DepthField``. Besides a name,
``analyze(depth=…)`` takes an array of metres (``given``) or any network for depth from one picture
(``depth_network``).
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.analysis import depth_contact, depth_ground, depth_haze
from sunwidget.analysis.depth_contact import Contacts
from sunwidget.analysis.depth_field import DepthField, guided
from sunwidget.analysis.depth_ground import EYE_HEIGHT
from sunwidget.analysis.depth_level import fill_sky
from sunwidget.analysis.depth_network import DepthNetwork
from sunwidget.analysis.depth_view import View
from sunwidget.analysis.errors import AnalysisError
from sunwidget.analysis.sky import check_proportions, plain_numbers
from sunwidget.analysis.working import LUMINANCE

FAR_CONTACT = 3_000.0  # metres: what stands on the horizon itself is taken to be no farther
_GRAIN = 0.06  # of the width: texture is finer than this
_SMOOTH, _EPSILON = 0.02, 1e-2  # of the width; squared contrast that is an edge
_BEND = 30.0 / 320  # times the width: price of a fold in what stands upright
_VISTA_WINDOW = 0.08  # of the width
_AS_BRIGHT = 0.75  # luminance over airlight from which it is no haze: glare, snow, a white wall


def ground_plane(view: View) -> DepthField:
    """Flat ground below the horizon; what stands on it takes the depth of its contact row.

    Where the contact lies (``depth_contact``) is a probability: its mean ln depth is the column's,
    and how probably it lies below a pixel is how far that pixel stands upright.
    """
    stands, log_depth, error, _ = _upright(view)
    return _field(
        view, stands, log_depth, _mixed_error(view, _ground(view), stands, log_depth, error)
    )


def haze(view: View) -> DepthField:
    """Depth by haze alone, t = exp(−β d) with the fitted air's β (``depth_haze``)."""
    log_depth, error = depth_haze.log_depth(
        view, depth_haze.transmittance(view, depth_haze.airlight(view))
    )
    return _field(view, np.ones(view.shape), np.minimum(log_depth, np.log(depth_ground.FAR)), error)


def fused(view: View) -> DepthField:
    """Ground plane, contact rows and haze, weighted by their precision in ln depth.

    Haze is believed of what stands upright, and of ground only in a vista: below land that is
    hazy itself and where the ground is darker than the sky. Elsewhere a road in the sun's glare
    and the far sea, which are as pale as haze, would be mountains.
    """
    stands, contact, contact_error, contacts = _upright(view)
    air = depth_haze.airlight(view)
    through = _without_texture(view, depth_haze.transmittance(view, air))
    by_haze, haze_error = depth_haze.log_depth(view, through)
    by_haze = np.minimum(by_haze, np.log(depth_ground.FAR))
    dry = 1 - view.water
    weight = dry / haze_error**2
    precision = 1 / contact_error**2
    upright = (contact * precision + by_haze * weight) / (precision + weight)
    upright_error = 1 / np.sqrt(precision + weight)
    # In a vista the ground is not level with the one at one's feet: the more haze disagrees with
    # it, the less it counts (a Cauchy weight).
    ground = _ground(view)
    ground_error = _ground_error(view)
    vista = _vista(view, air, through, contacts) * dry
    apart = np.maximum(by_haze - ground, 0) / np.hypot(haze_error, ground_error)
    level = 1 / ground_error**2 / (1 + (vista * apart) ** 2)
    departs = vista * weight / (level + vista * weight)
    share = stands + (1 - stands) * departs
    own = stands * upright + (1 - stands) * departs * by_haze
    log_depth = np.where(share > 1e-3, own / np.maximum(share, 1e-3), upright)
    log_depth = _smoothed(view, log_depth, share > 0.3)
    return _field(
        view, share, log_depth, _mixed_error(view, ground, share, log_depth, upright_error)
    )


METHODS: dict[str, Callable[[View], DepthField]] = {
    "fused": fused,
    "ground_plane": ground_plane,
    "haze": haze,
}


def given(value: Any, size: tuple[int, int]) -> np.ndarray | DepthNetwork | None:
    """Check what a caller passes as depth; None for the name of a method.

    Parameters
    ----------
    value : str, Path, DepthNetwork or array_like
        Name in ``METHODS``, a network or its path, or (H, W) metres above 0, inf for the sky. An
        array need not have the photo's size.
    size : (width, height)
        The photo's.

    Raises
    ------
    AnalysisError
        When it is neither of them, or an array that holds NaN or values of 0 and less, is inf
        everywhere, or has another shape than the photo by more than rounding.
    """
    choices = (
        f"depth knows no method {value!r:.80}; choose one of {', '.join(METHODS)}, or pass the "
        "path of an .onnx file, or an array (H, W) of metres."
    )
    if isinstance(value, DepthNetwork):
        return value
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
        raise AnalysisError(f"A depth map has shape (height, width), not {array.shape}.")
    if np.isnan(array).any() or (array <= 0).any():
        raise AnalysisError(
            "The depth map holds NaN, zero or negative values; it must be metres above 0, inf "
            "where the sky is."
        )
    if not np.isfinite(array).any():
        raise AnalysisError("The depth map is infinite everywhere; give metres where land is.")
    check_proportions("depth map", array.shape, size)
    return array


def field_of(view: View, depth: np.ndarray) -> DepthField:
    """Return the field of a given map (h, w) in metres, inf for the sky."""
    land = np.isfinite(depth)
    log_depth = fill_sky(np.log(np.where(land, depth, 1)).astype(np.float32), land)
    everywhere = np.ones(depth.shape, np.float32)
    share = view.horizon_error / view.shape[0]
    return DepthField(everywhere, log_depth, everywhere, view.camera, share, sharpen=False)


def _ground(view: View) -> np.ndarray:
    camera = view.camera
    return depth_ground.log_depth(view.fall, view.horizon_error, camera.focal, camera.height)


def _ground_error(view: View) -> np.ndarray:
    return depth_ground.log_error(view.fall, view.horizon_error, view.camera.focal)


def _upright(view: View) -> tuple[np.ndarray, np.ndarray, np.ndarray, Contacts]:
    """Return how surely a pixel stands upright, its ln depth with standard error, the contacts.

    All (h, w); where hardly anything stands upright the depth is that of the horizon.
    """
    contacts = depth_contact.find(view)
    camera, drop = view.camera, contacts.drop
    fall = drop / camera.focal
    depth = depth_ground.log_depth(fall, view.horizon_error, camera.focal, camera.height)
    # A contact at the horizon, as far as one can tell, says only that the thing is at least so
    # far; then its likely size says more.
    finest = depth_contact.finest_drop(view)
    at_horizon = np.exp(-2 * (drop / finest) ** 2)[:, None]
    likely = EYE_HEIGHT * camera.focal / np.maximum(depth_contact.RATIO * contacts.rise, 1e-3)
    likely = np.clip(likely, 2 * EYE_HEIGHT * camera.focal / finest, FAR_CONTACT)
    depths = depth[:, None] + at_horizon * np.maximum(np.log(likely) - depth[:, None], 0)
    probability = contacts.probability
    mean = (depths * probability).sum(axis=0)
    doubt = depth_ground.log_error(fall, finest, camera.focal)
    spread = (depths**2 * probability).sum(axis=0) - mean**2
    spread = np.maximum(spread, 0) + doubt**2 @ probability
    mean = depth_contact.levelled(mean, 1 / spread, _BEND * view.shape[1])
    return (
        depth_contact.stands_at(contacts, view.shape[0]) * view.land,
        np.broadcast_to(mean, view.shape),
        np.broadcast_to(np.sqrt(spread), view.shape),
        contacts,
    )


def _vista(view: View, air: np.ndarray, through: np.ndarray, contacts: Contacts) -> np.ndarray:
    """Return how surely the ground is a valley seen through haze: (h, w), 0 to 1."""
    import cv2

    height, width = view.shape
    size = (int(_VISTA_WINDOW * width) | 1, 1)

    def around(columns: np.ndarray) -> np.ndarray:
        return cv2.blur(columns[None].astype(np.float32), size)[0]

    shine = cv2.blur(view.working.linear @ LUMINANCE, (5, 5)) / (air @ LUMINANCE)
    dim = np.clip((_AS_BRIGHT - shine) / 0.2, 0, 1)
    count = np.maximum(around(contacts.above.sum(axis=0)), 1e-3)
    hazy = 1 - around((through * contacts.above).sum(axis=0)) / count
    dark = around((dim * contacts.above).sum(axis=0)) / count
    high = around(contacts.rise) / height
    surely = np.clip(hazy / 0.15 - 0.5, 0, 1) * np.clip(high / 0.04 - 0.5, 0, 1)
    return np.asarray(surely * np.clip(2 * dark - 0.5, 0, 1) * dim)


def _without_texture(view: View, through: np.ndarray) -> np.ndarray:
    """Return a transmittance with steps between things, but none within them: by a median."""
    import cv2

    size = 2 * max(1, round(_GRAIN * view.shape[1] / 2)) + 1
    levels = cv2.medianBlur(np.round(through * 255).astype(np.uint8), size)
    return np.maximum(cv2.blur(levels.astype(np.float32), (5, 5)) / 255, 0.02)


def _smoothed(view: View, log_depth: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Spread what is known over the rest, and smooth it between the picture's edges."""
    filled = fill_sky(log_depth.astype(np.float32), known)
    radius = max(2, round(_SMOOTH * view.shape[1]))
    return guided(view.working.encoded, filled, radius, _EPSILON)


def _mixed_error(
    view: View, ground: np.ndarray, share: np.ndarray, log_depth: np.ndarray, error: np.ndarray
) -> np.ndarray:
    """Return the standard error of a mixture of the ground and what departs from it."""
    apart = share * (1 - share) * (log_depth - ground) ** 2
    squared = share * error**2 + (1 - share) * _ground_error(view) ** 2 + apart
    return np.asarray(np.sqrt(squared))


def _field(view: View, share: np.ndarray, log_depth: np.ndarray, error: np.ndarray) -> DepthField:
    """Return the field, its sky filled from the nearest land."""
    both = fill_sky(np.dstack([share, log_depth]).astype(np.float32), view.land)
    share, log_depth = both[..., 0].copy(), both[..., 1].copy()
    confidence = (1 / (1 + (2 * np.asarray(error)) ** 2)).astype(np.float32)
    horizon_error = view.horizon_error / view.shape[0]
    return DepthField(share, log_depth, confidence, view.camera, horizon_error)
