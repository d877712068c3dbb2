"""Clouds: their opacity and softness, by color (thesis 3.1.4).

``METHODS`` maps a name to a function ``(Working, sky, minimum, maximum) -> Clouds``. The four
methods that use only color (``INDICES``) put whiteness on one scale, that of red over blue: 0 is
the deepest blue and 1 is white. So m_min and m_max mean the same for each method. A new method must
also be in ``CLOUD_METHODS`` of edit/table.py.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.backdrop.backdrop import expected_sky, matched_sky
from sunwidget.analysis.clouds.unmix import cloud_white, unmix
from sunwidget.analysis.depth.field import guided
from sunwidget.analysis.fit.fit import SkyFit
from sunwidget.analysis.fit.overcast import limit_balance, overcast
from sunwidget.analysis.images.rings import all_round, interpolated
from sunwidget.analysis.images.working_copy import LONG_SIDE, Working, saturation
from sunwidget.analysis.sun.sun import away_from
from sunwidget.edit.table import parameter
from sunwidget.errors import AnalysisError
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

MINIMUM: float = parameter("cloud_ratio_min").default
MAXIMUM: float = parameter("cloud_ratio_max").default

# Heinle's 30 of 255 levels between blue and red correspond to the ratio's default m_min.
_DIFFERENCE_SCALE = 30 / 255 / (1 - MINIMUM)

_REACH, _REACH_OF_SHADE = 0.015, 0.004  # longer sides: files store color more coarsely than light
LARGEST_RADIUS = round(_REACH * LONG_SIDE)
"""Largest result of ``smoothing_radius``."""
_SHOWS_GLOW = 1.5  # how much worse a sky without an assumed sun's glow fits a photo that shows it
_COARSE = 256  # px: longer side of the grid of pixels on which a glow is measured
_RING, _DARK = 0.02, 1e-3  # in the picture's widths; scene-linear light
_NO_EDGE = 1e-3  # squared contrast of the encoded picture

# Logistic regression on (red / blue, (B - R) / (B + R), saturation, blue), encoded values: bias
# and weights from training/clouds.py, which renders veiled skies with the atmosphere's model.
LEARNED = (-4.81, 6.3, -4.15, -4.98, 0.69)


class Clouds(NamedTuple):
    """Maps of the clouds, each (h, w) float32.

    ``opacity`` and the thesis' ``softness`` C^s are in [0, 1]. ``shade`` is the clouds' own light
    relative to a white cloud (self-shade k of unmix.py), 0 to 1.5; 1 where it is unknown.
    """

    opacity: np.ndarray
    softness: np.ndarray
    shade: np.ndarray


def ratio_index(encoded: np.ndarray) -> np.ndarray:
    """Return red over blue (Long et al. 2006, "Retrieving cloud …", threshold 0.6).

    Parameters
    ----------
    encoded : (h, w, 3) float32
        sRGB-encoded, [0, 1]; the same for the other indices.

    Returns
    -------
    (h, w) float32
    """
    return np.asarray(encoded[..., 0] / np.maximum(encoded[..., 2], 1 / 255))


def difference_index(encoded: np.ndarray) -> np.ndarray:
    """Return red minus blue (Heinle et al. 2010, "Automatic cloud classification …", 30 levels).

    It is more accurate than the ratio in dark skies, whose ratio is noise.
    """
    return np.asarray(1 + (encoded[..., 0] - encoded[..., 2]) / _DIFFERENCE_SCALE)


def saturation_index(encoded: np.ndarray) -> np.ndarray:
    """Return r/b from the saturation S of HSI (Souza-Echer et al. 2006, "A simple method …").

    A sky whose green is midway between red and blue has S = (1 - r/b) / (1 + r/b). Unlike the
    ratio, it does not make the red of a sunset the whitest color.
    """
    pure = saturation(encoded)
    return np.asarray((1 - pure) / (1 + pure))


def learned_index(encoded: np.ndarray) -> np.ndarray:
    """Return a regression on color channels (Dev et al. 2017, "Color-based segmentation of …").

    By their partial least squares, red over blue, the normalized difference and saturation carry
    most information. This is a logistic regression; its probability 0.5 is at the default m_min.
    """
    score = features(encoded) @ np.array(LEARNED[1:], np.float32) + np.float32(LEARNED[0])
    probability = 1 / (1 + np.exp(-np.clip(score, -30, 30)))
    return np.asarray(np.interp(probability, (0, 0.5, 1), (0, MINIMUM, 1)), np.float32)


def features(encoded: np.ndarray) -> np.ndarray:
    """Return the features of the regression, (…, 4): r/b, (b - r)/(b + r), saturation, blue."""
    red, blue = encoded[..., 0], encoded[..., 2]
    ratio = np.minimum(ratio_index(encoded), 2)
    difference = (blue - red) / np.maximum(blue + red, 1 / 255)
    return np.asarray(np.stack([ratio, difference, saturation(encoded), blue], -1), np.float32)


INDICES: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "rb_ratio": ratio_index,
    "rb_difference": difference_index,
    "saturation": saturation_index,
    "learned": learned_index,
}


def detect_by_threshold(
    name: str,
    working: Working,
    sky: np.ndarray,
    minimum: float = MINIMUM,
    maximum: float = MAXIMUM,
) -> Clouds:
    """Classify pixels whiter than m_min as cloud (thesis equations 3.5 and 3.6).

    Parameters
    ----------
    name : str
        Name in ``INDICES``.
    working : Working
    sky : (h, w) float32
        Sky matte.
    minimum, maximum : float
        m_min, around which the mask of equation 3.5 is softened by ± 0.05, and m_max, at which
        the softness of equation 3.6 reaches 1.
    """
    index = INDICES[name](working.encoded)
    softness = np.clip((index - minimum) / max(maximum - minimum, 1e-3), 0, 1)
    opacity = np.clip((index - minimum) / 0.1 + 0.5, 0, 1)
    return Clouds(
        (opacity * sky).astype(np.float32),
        (softness * sky).astype(np.float32),
        np.ones_like(sky, np.float32),
    )


# "unmix" needs the fitted sky, which needs a first estimate of the clouds: r/b, whose softness
# C^s stays. ``veil`` then gives the opacity.
METHODS: dict[str, Callable[..., Clouds]] = {
    **{name: partial(detect_by_threshold, name) for name in INDICES},
    "unmix": partial(detect_by_threshold, "rb_ratio"),
}


def veil(
    working: Working, sky: np.ndarray, camera: Camera, fit: SkyFit, *, sun_seen: bool
) -> tuple[Clouds, Clouds]:
    """Return the clouds of the sky, and of the whole picture, by un-mixing (unmix.py).

    The second treats the land as if it were sky, for sky strokes; it is not smoothed. Neither has
    the softness C^s: it is 0.

    A guided filter (He et al. 2010) aligns the opacity with the picture: otherwise compression
    blocks and color noise would show when cloud and sky are lit differently. Unless the sun is
    visible, a sky that is white everywhere is cloud (overcast.py).

    Raises
    ------
    AnalysisError
        If OpenCV lacks its contrib modules.
    """
    import cv2

    if not hasattr(cv2, "ximgproc"):
        raise AnalysisError(
            "This OpenCV has no cv2.ximgproc, which finds the clouds' edges: another package "
            "replaced OpenCV. Run pip uninstall opencv-python opencv-python-headless, then pip "
            "install --force-reinstall opencv-contrib-python-headless; or pass clouds='rb_ratio'."
        )

    blue = fit if sun_seen else limit_balance(fit, working, sky)
    size = (working.width, working.height)
    clear, expected = matched_sky(blue, camera, size), expected_sky(blue, camera, size)
    light = fit.response.scene_light(working.linear)
    if expected is not None:
        shown = _misfit(light, expected, sky) >= _SHOWS_GLOW * _misfit(light, clear, sky)
        clear = clear if shown else expected
    if sun_seen:
        clear = _with_glow(clear, light, sky, camera, fit)
    everywhere, shade = unmix(light, clear, cloud_white(blue), np.ones_like(sky))
    if not sun_seen:
        everywhere = np.maximum(everywhere, overcast(working, sky))
    opacity = everywhere * sky
    smooth = np.clip(smoothed(working.encoded, opacity, smoothing_radius(working)), 0, 1)
    # Shade is weighted by opacity: where there is almost no cloud it is noise.
    side = 2 * max(2, round(_REACH_OF_SHADE * max(working.width, working.height))) + 1
    weight = cv2.blur(opacity, (side, side)) + 1e-3
    level = cv2.blur(opacity * shade, (side, side)) + 1e-3
    none = np.zeros_like(sky)
    return (
        Clouds((smooth * sky).astype(np.float32), none, level / weight),
        Clouds(everywhere, none, shade),
    )


def _with_glow(
    clear: np.ndarray, light: np.ndarray, sky: np.ndarray, camera: Camera, fit: SkyFit
) -> np.ndarray:
    """Return the clear sky (h, w, 3), as bright as the photo's ``light`` is all round its sun.

    The model's glow is often too small or too weak, but clouds are not alike on all sides.
    """
    rows, columns = sky.shape
    away = away_from(sky.shape, *camera.resized(columns, rows).pixel(*fit.sun)) / columns
    step = max(1, round(max(rows, columns) / _COARSE))
    few = np.s_[::step, ::step]
    excess = np.log(np.maximum(light[few], _DARK)) - np.log(np.maximum(clear[few], _DARK))
    middles, profile = all_round(excess, sky[few] > 0.98, away[few], _RING)
    return clear * np.exp(np.maximum(interpolated(away, middles, profile), 0))


def _misfit(light: np.ndarray, model: np.ndarray, sky: np.ndarray) -> float:
    """Return the deviation of the log of luminance between photo and model in the sky."""
    apart = np.log(np.maximum(light @ LUMINANCE, 1e-4) / np.maximum(model @ LUMINANCE, 1e-6))
    return float(apart[sky > 0.98].std()) if (sky > 0.98).any() else 0.0


def smoothing_radius(working: Working) -> int:
    """Return the radius, in working pixels, of the filter that aligns opacity with the picture."""
    return max(3, round(_REACH * max(working.width, working.height)))


def smoothed(encoded: np.ndarray, opacity: np.ndarray, radius: int) -> np.ndarray:
    """Align an opacity (h, w) with the picture's edges (guided filter)."""
    return guided(encoded, opacity, radius, _NO_EDGE)


def within(clouds: Clouds, sky: np.ndarray) -> Clouds:
    """Return the clouds within the sky (h, w)."""
    return Clouds(
        (clouds.opacity * sky).astype(np.float32),
        (clouds.softness * sky).astype(np.float32),
        clouds.shade,
    )


def without(clouds: Clouds, mask: np.ndarray) -> Clouds:
    """Remove the sun's pixels, which r/b classifies as cloud (thesis 3.1.3)."""
    keep = 1 - mask
    return Clouds(clouds.opacity * keep, clouds.softness * keep, clouds.shade)
