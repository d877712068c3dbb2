"""Sky replacement: the donor's sky by direction, and land relit to match it.

Source: Tsai et al., "Sky is Not the Limit: Semantic-Aware Sky Replacement" (2016). Instead of
warping the donor's picture, the sky is looked up by direction with both cameras known
(``donor_sky``), so that horizon, perspective and the size of the sun agree.
"""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.analysis.images.fill import fill_by_pyramid
from sunwidget.analysis.images.working_copy import resize
from sunwidget.errors import AnalysisError
from sunwidget.formats.color import LUMINANCE, strips
from sunwidget.transfer.donor_sky import DonorSky, directions, donor_sky
from sunwidget.transfer.encode import as_scene, check_strength, photo_like
from sunwidget.transfer.land import LandChange, land_change, mean_sky, rows_at

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.photo.photo import Photo
    from sunwidget.progress import Progress

_LEAST_SKY = 0.002  # share of the picture


def replace_sky(
    scene: Any,
    donor: Any,
    *,
    turn: float = 0.0,
    strength: float = 1.0,
    progress: Progress | None = None,
) -> Photo:
    """Put the sky of another photo into this one (``sunwidget.replace_sky``).

    Parameters
    ----------
    scene : Scene, or any source for ``analyze``
        The photo whose land is kept.
    donor : Scene, or any source for ``analyze``
        The photo that provides the sky.
    turn : float, default 0
        Rotation of the donor's sky: the direction this many degrees right of its heading is placed
        at the photo's heading.
    strength : float, default 1
        How far the land follows the new sky's light, from 0 (unchanged) to 1.
    progress : callable, optional
        Called with (fraction, message); raise in it to cancel.

    Returns
    -------
    Photo
        Size, depth, profile and metadata of the first photo; ``sun`` is the pixel of the donor's
        sun in it, so that ``analyze`` and the editor can move it.

    Raises
    ------
    AnalysisError
        When either photo shows no sky, or for an invalid turn or strength.
    PhotoError
        When a photo cannot be opened.
    """
    check_strength(strength)
    if not isinstance(turn, (int, float)) or not math.isfinite(turn):
        raise AnalysisError(f"turn must be a finite number of degrees, not {turn!r:.40}.")
    report = progress or (lambda _fraction, _message: None)
    report(0.0, "Analyzing both photos")
    scene, donor = as_scene(scene), as_scene(donor)
    if float(np.mean(scene.sky > 0.5)) < _LEAST_SKY:
        raise AnalysisError(
            f"No sky to replace in {scene.photo.name} ({np.mean(scene.sky > 0.5):.1%} of its "
            "pixels). Analyze it with sky=mask, or draw a sky stroke."
        )
    report(0.4, "Completing the donor's sky")
    sky = donor_sky(donor, scene.camera.focal)
    report(0.5, "Comparing the light")
    change = None
    if strength > 0:
        new, old = _mean_new_sky(scene, sky, turn), mean_sky(scene)
        change = land_change(scene, donor, new, old, float(strength))
    behind = _old_sky(scene)
    light = np.empty((scene.height, scene.width, 3), np.float32)
    for rows in strips(light.shape):
        light[rows] = _compose(scene, sky, change, behind, rows, turn)
        report(0.5 + 0.5 * (rows.stop or scene.height) / scene.height, "Inserting the sky")
    photo = photo_like(scene.photo, light)
    return dataclasses.replace(photo, sun=_new_sun(scene, donor, turn))


def _compose(
    scene: Scene,
    sky: DonorSky,
    change: LandChange | None,
    behind: np.ndarray,
    rows: slice,
    turn: float,
) -> np.ndarray:
    """Return rows of the result in display-linear light."""
    assert scene.fitted is not None
    response = scene.fitted.response
    size = (scene.width, scene.height)
    display = np.maximum(scene.photo.pixels[rows], 0)
    matte = scene.sky[rows][..., None]
    light = response.scene_light(display)
    share = _sky_share(matte, light, _part(behind, rows, size), _part(scene.glare, rows, size))
    front = light * (1 - share) / np.maximum(1 - matte, 1e-3)
    # Pixels of land alone keep their exact values.
    land = np.where(matte > 0, response.display_light(front), scene.photo.pixels[rows])
    if change is not None:
        changed = change.apply(front, rows, size)
        land = land + response.display_light(changed) - response.display_light(front)
    if not matte.any():
        return np.asarray(land, np.float32)
    new = sky.look_up(*directions(scene.camera, size, rows, turn))
    return np.asarray(matte * new + (1 - matte) * land, np.float32)


def _sky_share(
    matte: np.ndarray, light: np.ndarray, behind: np.ndarray, glare: np.ndarray
) -> np.ndarray:
    """Return the sky's share of each pixel's light, as GetSkyShare in frame/frame.glsl.

    Most light of twigs in front of a bright sky is sky. The sky behind them is known; the rest is
    their own light, without the old sky's tint.
    """
    sky = matte * behind
    excess = (sky @ LUMINANCE) / np.maximum(light @ LUMINANCE, 1e-6)
    inside = np.clip((matte[..., 0] - 0.85) / 0.15, 0, 1)
    wrong = np.clip((excess - 0.9) / 0.7, 0, 1)
    plain = np.maximum(np.maximum(_smooth(inside), _smooth(wrong)), glare[..., 0])[..., None]
    taken = np.minimum(sky / np.maximum(light, 1e-6), 1)
    return np.asarray(taken + plain * (matte - taken))


def _old_sky(scene: Scene) -> np.ndarray:
    """Return the photo's sky in scene-linear light, extended over soft edges, at working size."""
    assert scene.fitted is not None
    small = scene.working
    sky = resize(scene.sky, small.width, small.height)
    logs = np.log(scene.fitted.response.scene_light(small.linear))
    return np.exp(fill_by_pyramid(logs, (sky > 0.98).astype(np.float32)))


def _mean_new_sky(scene: Scene, sky: DonorSky, turn: float) -> np.ndarray:
    """Return the mean of the new sky over the photo's sky, in the donor's scene-linear light."""
    size = (min(scene.width, 192), min(scene.height, 192))
    weight = resize(scene.sky, *size).ravel()
    display = sky.look_up(*directions(scene.camera, size, slice(None), turn))
    light = sky.fitted.response.scene_light(display).reshape(-1, 3)
    return np.asarray(weight @ light / max(float(weight.sum()), 1e-6))


def _new_sun(scene: Scene, donor: Scene, turn: float) -> tuple[float, float] | None:
    """Return the pixel of the donor's sun in the photo; None if unknown or behind the camera."""
    if donor.sun is None:
        return None
    x, y = scene.camera.pixel(donor.sun.azimuth - turn, donor.sun.elevation)
    return (float(x), float(y)) if math.isfinite(x) and math.isfinite(y) else None


def _part(image: np.ndarray, rows: slice, size: tuple[int, int]) -> np.ndarray:
    """Return rows of a small map at the photo's size, (n, w, channels)."""
    part = rows_at(image, rows, size)
    return part if part.ndim == 3 else part[..., None]


def _smooth(t: np.ndarray) -> np.ndarray:
    return np.asarray(t * t * (3 - 2 * t))
