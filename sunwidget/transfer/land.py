"""The land's change under a new sky, from label statistics and the light of two fitted skies.

After Tsai et al., "Sky is Not the Limit: Semantic-Aware Sky Replacement" (2016), section 5: each
label of the photo moves towards the same label of the donor. The labels need no further network:
level ground, upright things, green plants, water. Statistics compare different materials; the
ratio of two irradiances does not. Both are therefore combined, and limited so that the brightness
of land relative to sky stays within the range of the two photos.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from sunwidget.analysis.images.color_transfer import LMS_TO_LAB, RGB_TO_LMS
from sunwidget.analysis.images.working_copy import resize
from sunwidget.formats.color import LUMINANCE
from sunwidget.transfer.irradiance import is_night, land_light
from sunwidget.transfer.labels import LABELS, labels_of

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

_FLOOR = 1e-4  # of cone response; below one step of 8 bits
_STATISTICS = 0.5  # weight against the ratio of irradiances if both are reliable
_DARKEST, _BRIGHTEST = -3.2, 1.8  # natural log of the change of luminance
# Limits of α (yellow–blue) and β (red–green), log10, for the tint by the light and for the further
# tint by the statistics of different materials. No natural light is green.
_TINT_OF_LIGHT = np.array([[-0.20, -0.015], [0.20, 0.06]])
_TINT_OF_LAND = np.array([0.05, 0.015])
_SKY_IN_TINT = 0.3  # share of the visible sky in the land's tint
_WELL_EXPOSED = 0.22  # luminance of land that a camera would not brighten further
_MARGIN = 0.35  # natural log by which land over sky may leave the range of the two photos
_CONTRAST, _COLOR = (0.75, 1.2), (0.65, 1.25)
_FROM_LAB = np.linalg.inv(LMS_TO_LAB)
_FROM_LMS = np.linalg.inv(RGB_TO_LMS)


class Tones(NamedTuple):
    """Mean and deviation (3,) in lαβ (log10 of cone responses), and share of the picture."""

    mean: np.ndarray
    deviation: np.ndarray
    share: float


@dataclass(frozen=True, eq=False)
class LandChange:
    """The change of the land's light: lαβ → mean + gain (lαβ − mean) + shift, per pixel.

    Attributes
    ----------
    mean, gain, shift : (h, w, 3) float32
        At working size; smooth, so that they can be enlarged.
    """

    mean: np.ndarray
    gain: np.ndarray
    shift: np.ndarray

    def apply(self, light: np.ndarray, rows: slice, size: tuple[int, int]) -> np.ndarray:
        """Change scene-linear light (n, w, 3), the ``rows`` of a picture of ``size`` (w, h)."""
        lab = _lab(light)
        mean, gain, shift = (rows_at(m, rows, size) for m in (self.mean, self.gain, self.shift))
        cones = np.power(10.0, (mean + gain * (lab - mean) + shift) @ _FROM_LAB.T)
        return np.maximum(cones @ _FROM_LMS.T, 0).astype(np.float32)


def land_change(
    scene: Scene, donor: Scene, new_sky: np.ndarray, old_sky: np.ndarray, strength: float
) -> LandChange:
    """Return the change of the land of ``scene`` under the sky of ``donor``.

    Parameters
    ----------
    scene, donor : Scene
    new_sky, old_sky : (3,) float
        Mean scene-linear light of the photo's sky, replaced and original.
    strength : float
        0 (no change) to 1.
    """
    ours, theirs = labels_of(scene), labels_of(donor)
    own, other = _tones(scene, ours), _tones(donor, theirs)
    all_own, all_other = (_all(scene, ours), _all(donor, theirs))
    by_sky = _lab(new_sky) - _lab(old_sky)
    lit = _light_ratio(scene, donor, by_sky) | {"water": by_sky}  # water mirrors the sky
    lit["plants"] = 0.5 * (lit["ground"] + lit["upright"])
    bounds = _bound_change(scene, donor, all_own, all_other, new_sky, old_sky)
    mean, gain, shift, total = (np.zeros((*ours["ground"].shape, 3), np.float32) for _ in range(4))
    for label in LABELS:
        if own[label].share < 1e-4:
            continue
        wanted, ratio = _label_change(
            own[label], other[label], all_own, all_other, lit[label], by_sky, bounds
        )
        weight = ours[label][..., None]
        mean += weight * own[label].mean
        gain += weight * (1 + strength * (ratio - 1))
        shift += weight * strength * wanted
        total += weight
    here = np.maximum(total, 1e-4)
    # Pixels without land do not change: gain 1, shift 0.
    sure = np.clip(total / 0.02, 0, 1)
    return LandChange(mean / here, 1 + sure * (gain / here - 1), sure * shift / here)


def _light_ratio(scene: Scene, donor: Scene, by_sky: np.ndarray) -> dict[str, np.ndarray]:
    """Return the log ratio of the donor's to the photo's light, in lαβ, on ground and upright."""
    own, other = land_light(scene), land_light(donor)
    if is_night(scene) or is_night(donor):
        # At night the fit is meaningless, but the visible sky is the only light.
        return {
            "ground": by_sky
            + _by_sun(other.lying, other.lying_by_sky)
            - _by_sun(own.lying, own.lying_by_sky),
            "upright": by_sky
            + _by_sun(other.upright, other.upright_by_sky)
            - _by_sun(own.upright, own.upright_by_sky),
        }
    return {
        "ground": _lab(other.lying) - _lab(own.lying),
        "upright": _lab(other.upright) - _lab(own.upright),
    }


def _by_sun(light: np.ndarray, by_sky: np.ndarray) -> np.ndarray:
    return _lab(light) - _lab(by_sky)


def _label_change(
    own: Tones,
    other: Tones,
    all_own: Tones,
    all_other: Tones,
    lit: np.ndarray,
    by_sky: np.ndarray,
    bounds: tuple[float, float],
) -> tuple[np.ndarray, np.ndarray]:
    """Return the shift (3,) and gain (3,) in lαβ of one label."""
    sure = _trust(other.share)
    sure_of_all = _trust(all_other.share)
    like = all_other.mean - all_own.mean
    statistic = sure * (other.mean - own.mean) + (1 - sure) * like
    weight = _STATISTICS * max(sure, 0.5 * sure_of_all)
    # A fit in the dark or under cloud may be wrong; the visible sky is reliable.
    light = lit + _SKY_IN_TINT * (by_sky - lit)
    step = np.sqrt(3) * np.log10(math.e)
    light[0] = by_sky[0] + np.clip(lit[0] - by_sky[0], -step, step)
    if lit is by_sky:  # water mirrors any color of the sky
        light = lit.copy()
    else:
        light[1:] = np.clip(light[1:], *_TINT_OF_LIGHT)
    shift = light + weight * (statistic - light)
    shift[1:] = light[1:] + np.clip(shift[1:] - light[1:], -_TINT_OF_LAND, _TINT_OF_LAND)
    # l of lαβ is √3 times the mean log10 of the cones, close to that of the luminance.
    low, high = max(bounds[0], _DARKEST), min(bounds[1], _BRIGHTEST)
    shift[0] = np.clip(shift[0], step * low, step * max(high, low))
    spread = np.sqrt(np.maximum(other.deviation, 1e-3) / np.maximum(own.deviation, 1e-3))
    limits = np.array([_CONTRAST, _COLOR, _COLOR])
    gain = 1 + sure * (np.clip(spread, limits[:, 0], limits[:, 1]) - 1)
    return shift, gain


def _bound_change(
    scene: Scene,
    donor: Scene,
    own: Tones,
    other: Tones,
    new_sky: np.ndarray,
    old_sky: np.ndarray,
) -> tuple[float, float]:
    """Return bounds of the land's change (natural log), so that a darker sky darkens the land.

    The ratio of land to new sky lies between that in the photo and that in the donor. A darker sky
    never brightens the land, and a brighter one never darkens it much.
    """
    before, after = (_log_luminance(light) for light in (old_sky, new_sky))
    sky = after - before
    sure = _trust(other.share)
    in_photo = _luminance(own.mean) - before
    in_donor = _luminance(other.mean) - _log_luminance(mean_sky(donor))
    change = sure * (in_donor - in_photo)
    low = sky + min(change, 0.0) - _MARGIN
    high = sky + max(change, 0.0) + _MARGIN
    if is_night(donor) and sky < 0:
        high = min(high, 0.8 * sky)
    elif sky < 0:
        high = min(high, max(0.0, _MARGIN + 0.5 * sky))
    else:
        low = max(low, min(0.0, -_MARGIN - 0.25 * sky))
    room = max(0.0, float(np.log(_WELL_EXPOSED)) - _luminance(own.mean))
    low, high = min(low, room), min(high, room)
    return low, max(low, high)


def mean_sky(scene: Scene) -> np.ndarray:
    """Return the mean scene-linear light (3,) of a scene's sky."""
    assert scene.fitted is not None
    small = scene.working
    weight = resize(scene.sky, small.width, small.height).ravel()
    light = scene.fitted.response.scene_light(small.linear).reshape(-1, 3)
    return np.asarray(weight @ light / max(float(weight.sum()), 1e-6))


def _tones(scene: Scene, labels: dict[str, np.ndarray]) -> dict[str, Tones]:
    assert scene.fitted is not None
    lab = _lab(scene.fitted.response.scene_light(scene.working.linear)).reshape(-1, 3)
    return {name: _weighted(lab, weight) for name, weight in labels.items()}


def _all(scene: Scene, labels: dict[str, np.ndarray]) -> Tones:
    assert scene.fitted is not None
    lab = _lab(scene.fitted.response.scene_light(scene.working.linear)).reshape(-1, 3)
    return _weighted(lab, np.sum(list(labels.values()), axis=0))


def _weighted(lab: np.ndarray, weight: np.ndarray) -> Tones:
    share = weight.ravel().astype(np.float64)
    total = max(float(share.sum()), 1e-6)
    mean = share @ lab / total
    deviation = np.sqrt(np.maximum(share @ (lab - mean) ** 2 / total, 0))
    return Tones(mean, deviation, float(share.mean()))


def _trust(share: float) -> float:
    """Return the reliability of a label that covers this share of a picture."""
    return share / (share + 0.02)


def _luminance(lab: np.ndarray) -> float:
    """Return the natural log of the luminance of a color in lαβ."""
    rgb = np.power(10.0, lab @ _FROM_LAB.T) @ _FROM_LMS.T
    return _log_luminance(rgb)


def _log_luminance(light: np.ndarray) -> float:
    return float(np.log(max(float(light @ LUMINANCE), 1e-6)))


def _lab(light: np.ndarray) -> np.ndarray:
    """Convert scene-linear light (..., 3) to lαβ, float32."""
    cones = np.maximum(light @ RGB_TO_LMS.T.astype(np.float32), _FLOOR)
    return np.asarray(np.log10(cones) @ LMS_TO_LAB.T.astype(np.float32))


def rows_at(image: np.ndarray, rows: slice, size: tuple[int, int]) -> np.ndarray:
    """Return rows of a map resized to ``size`` (bilinear), without resizing all of it."""
    import cv2

    height, width = image.shape[:2]
    if (width, height) == size:
        return image[rows]
    y = (np.arange(size[1])[rows] + 0.5) * height / size[1] - 0.5
    x = (np.arange(size[0]) + 0.5) * width / size[0] - 0.5
    grid = np.meshgrid(x.astype(np.float32), y.astype(np.float32))
    found = cv2.remap(image, *grid, cv2.INTER_LINEAR, None, cv2.BORDER_REPLICATE)
    return np.asarray(found)
