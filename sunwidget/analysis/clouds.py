"""Clouds: how opaque they are and how soft, by colour (thesis 3.1.4).

``METHODS`` maps a name to a function ``(Working, sky, minimum, maximum) -> Clouds``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.backdrop import matched_sky
from sunwidget.analysis.errors import AnalysisError
from sunwidget.analysis.fit import SkyFit
from sunwidget.analysis.unmix import cloud_white, unmix
from sunwidget.analysis.working import Working
from sunwidget.camera import Camera
from sunwidget.edit import parameter

MINIMUM: float = parameter("cloud_ratio_min").default
MAXIMUM: float = parameter("cloud_ratio_max").default


class Clouds(NamedTuple):
    """Opacity and the thesis' softness C^s, each (h, w) float32 in [0, 1]."""

    opacity: np.ndarray
    softness: np.ndarray


def rb_ratio(
    working: Working, sky: np.ndarray, minimum: float = MINIMUM, maximum: float = MAXIMUM
) -> Clouds:
    """Red over blue (Long et al. 2006; thesis equations 3.5 and 3.6), encoded values.

    The mask of equation 3.5 is softened over ± 0.05 of the ratio; softness is clamped to [0, 1].
    """
    red, blue = working.encoded[..., 0], working.encoded[..., 2]
    ratio = red / np.maximum(blue, 1 / 255)
    softness = np.clip((ratio - minimum) / max(maximum - minimum, 1e-3), 0, 1)
    opacity = np.clip((ratio - minimum) / 0.1 + 0.5, 0, 1)
    return Clouds((opacity * sky).astype(np.float32), (softness * sky).astype(np.float32))


def veil(working: Working, sky: np.ndarray, camera: Camera, fit: SkyFit) -> np.ndarray:
    """Opacity (h, w) float32 by un-mixing the photo from the fitted clear sky (unmix.py).

    A guided filter (He et al. 2010) ties it to the picture: compression blocks and noise in
    the colour differences would else show as soon as cloud and sky are lit apart.

    Raises
    ------
    AnalysisError
        When OpenCV was installed without its contrib modules.
    """
    import cv2

    if not hasattr(cv2, "ximgproc"):
        raise AnalysisError(
            "This OpenCV has no cv2.ximgproc, which follows the clouds' edges. Another package "
            "replaced it: pip uninstall opencv-python opencv-python-headless, then pip install "
            "--force-reinstall opencv-contrib-python-headless; or pass clouds='rb_ratio'."
        )

    clear = matched_sky(fit, camera, (working.width, working.height))
    light = fit.response.scene_light(working.linear)
    opacity = unmix(light, clear, cloud_white(fit), sky)[0]
    radius = max(2, round(0.004 * max(sky.shape)))
    smooth = cv2.ximgproc.guidedFilter(working.encoded, opacity, radius, 2e-4)
    return np.asarray(np.clip(smooth, 0, 1) * sky, np.float32)


# "unmix" needs the fitted sky, which needs a first idea of the clouds: that is r/b again, whose
# softness C^s stays; ``veil`` then gives the opacity.
METHODS: dict[str, Callable[..., Clouds]] = {"rb_ratio": rb_ratio, "unmix": rb_ratio}


def without(clouds: Clouds, mask: np.ndarray) -> Clouds:
    """Take the sun's pixels out: r/b calls them cloud (thesis 3.1.3)."""
    keep = 1 - mask
    return Clouds(clouds.opacity * keep, clouds.softness * keep)
