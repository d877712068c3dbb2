"""Sky from another photo: the donor's sky by direction, and land that follows its light.

Source: Tsai et al., "Sky is Not the Limit: Semantic-Aware Sky Replacement" (2016). Unlike there the
sky is not a warped picture but is looked up by direction with both cameras known
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
from sunwidget.transfer.encode import check_strength, photo_like, scene_of
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
    """Put the sky of another photo into this one. Public as ``sunwidget.replace_sky``.

    Parameters
    ----------
    scene : Scene, or anything that ``analyze`` takes
        The photo whose land is kept.
    donor : Scene, or anything that ``analyze`` takes
        The photo whose sky is taken.
    turn : float, default 0
        Degrees by which the donor's sky is turned: what stood this far right of its
        heading comes to stand at the photo's.
    strength : float, default 1
        How far the land follows the new sky's light, 0 (keeps its own) to 1.
    progress : callable, optional
        Called with (fraction, message); raise in it to cancel.

    Returns
    -------
    Photo
        Size, depth, profile and metadata of the first photo; ``sun`` is where the donor's
        sun stands in it now, so that ``analyze`` and the editor can move it.

    Raises
    ------
    AnalysisError
        When either photo shows no sky, or for a turn or strength that is no number in range.
    PhotoError
        When a photo cannot be opened.
    """
    check_strength(strength)
    if not isinstance(turn, (int, float)) or not math.isfinite(turn):
        raise AnalysisError(f"turn must be a finite number of degrees, not {turn!r:.40}.")
    tell = progress or (lambda _fraction, _message: None)
    tell(0.0, "Looking at both photos")
    scene, donor = scene_of(scene), scene_of(donor)
    if float(np.mean(scene.sky > 0.5)) < _LEAST_SKY:
        raise AnalysisError(
            f"No sky to replace in {scene.photo.name} ({np.mean(scene.sky > 0.5):.1%} of its "
            "pixels). Analyse it with sky=mask, or draw a sky stroke."
        )
    tell(0.4, "Completing the donor's sky")
    sky = donor_sky(donor, scene.camera.focal)
    tell(0.5, "Comparing the light")
    change = None
    if strength > 0:
        new, old = _mean_new_sky(scene, sky, turn), mean_sky(scene)
        change = land_change(scene, donor, new, old, float(strength))
    behind = _old_sky(scene)
    light = np.empty((scene.height, scene.width, 3), np.float32)
    for rows in strips(light.shape):
        light[rows] = _composed(scene, sky, change, behind, rows, turn)
        tell(0.5 + 0.5 * (rows.stop or scene.height) / scene.height, "Putting in the sky")
    photo = photo_like(scene.photo, light)
    return dataclasses.replace(photo, sun=_new_sun(scene, donor, turn))


def _composed(
    scene: Scene,
    sky: DonorSky,
    change: LandChange | None,
    behind: np.ndarray,
    rows: slice,
    turn: float,
) -> np.ndarray:
    """Rows of the result in display-linear light."""
    assert scene.fitted is not None
    response = scene.fitted.response
    size = (scene.width, scene.height)
    display = np.maximum(scene.photo.pixels[rows], 0)
    matte = scene.sky[rows][..., None]
    light = response.scene_light(display)
    share = _sky_share(matte, light, _part(behind, rows, size), _part(scene.glare, rows, size))
    front = light * (1 - share) / np.maximum(1 - matte, 1e-3)
    # Land alone is not taken apart, and so keeps its very values.
    land = np.where(matte > 0, response.display_light(front), scene.photo.pixels[rows])
    if change is not None:
        changed = change.apply(front, rows, size)
        land = land + response.display_light(changed) - response.display_light(front)
    if not matte.any():
        return np.asarray(land, np.float32)
    new = sky.towards(*directions(scene.camera, size, rows, turn))
    return np.asarray(matte * new + (1 - matte) * land, np.float32)


def _sky_share(
    matte: np.ndarray, light: np.ndarray, behind: np.ndarray, glare: np.ndarray
) -> np.ndarray:
    """Share of each pixel's light that is sky, as GetSkyShare in frame/frame.glsl.

    Twigs before a bright sky are mostly sky; the light behind is known, and the rest is their
    own, without the old sky's tint.
    """
    sky = matte * behind
    excess = (sky @ LUMINANCE) / np.maximum(light @ LUMINANCE, 1e-6)
    inside = np.clip((matte[..., 0] - 0.85) / 0.15, 0, 1)
    wrong = np.clip((excess - 0.9) / 0.7, 0, 1)
    plain = np.maximum(np.maximum(_smooth(inside), _smooth(wrong)), glare[..., 0])[..., None]
    taken = np.minimum(sky / np.maximum(light, 1e-6), 1)
    return np.asarray(taken + plain * (matte - taken))


def _old_sky(scene: Scene) -> np.ndarray:
    """Scene-linear light of the photo's sky, continued over its soft edges; working size."""
    assert scene.fitted is not None
    small = scene.working
    sky = resize(scene.sky, small.width, small.height)
    logs = np.log(scene.fitted.response.scene_light(small.linear))
    return np.exp(fill_by_pyramid(logs, (sky > 0.98).astype(np.float32)))


def _mean_new_sky(scene: Scene, sky: DonorSky, turn: float) -> np.ndarray:
    """Mean of the new sky over the photo's sky, in the donor's scene-linear light."""
    size = (min(scene.width, 192), min(scene.height, 192))
    weight = resize(scene.sky, *size).ravel()
    display = sky.towards(*directions(scene.camera, size, slice(None), turn))
    light = sky.fitted.response.scene_light(display).reshape(-1, 3)
    return np.asarray(weight @ light / max(float(weight.sum()), 1e-6))


def _new_sun(scene: Scene, donor: Scene, turn: float) -> tuple[float, float] | None:
    """Pixel of the donor's sun in the photo; None when it is unknown or behind the camera."""
    if donor.sun is None:
        return None
    x, y = scene.camera.pixel(donor.sun.azimuth - turn, donor.sun.elevation)
    return (float(x), float(y)) if math.isfinite(x) and math.isfinite(y) else None


def _part(image: np.ndarray, rows: slice, size: tuple[int, int]) -> np.ndarray:
    """Rows of a small map at the photo's size, (n, w, channels)."""
    part = rows_at(image, rows, size)
    return part if part.ndim == 3 else part[..., None]


def _smooth(t: np.ndarray) -> np.ndarray:
    return np.asarray(t * t * (3 - 2 * t))
