"""The photo without its sun: the light behind disc, halo, veil and rays, by the network.

The network gives the reduction of light at low resolution (networks/sun.py). Where it is small, the
photo's own detail stays and is darkened; where the glare hides the sky, the surrounding sky is
continued.
"""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.backdrop.rays import find_rays
from sunwidget.analysis.backdrop.sky_detail import sky_detail
from sunwidget.analysis.images.fill import fill_by_layers, fill_by_pyramid
from sunwidget.analysis.images.rings import all_round, interpolated
from sunwidget.analysis.images.working_copy import Working, encode, resize, smoothstep
from sunwidget.analysis.networks.sun import LIGHT_FLOOR, SunMaps
from sunwidget.analysis.sun.sun import SunObservation
from sunwidget.formats.color import LUMINANCE

# Natural logarithms of light by which the network's glare exceeds the sky.
_FELT = (0.03, 0.12)  # less does not count, more is removed completely
_COLOURS = (0.06, 0.3)  # less keeps the sky's color, more hides it
_WHITENS = (0.15, 0.6)  # less keeps clouds distinguishable from the sky, more does not
_HIDES = (0.3, 0.9)  # less keeps the sky's clouds, more hides them
_GAP = 0.03  # in longer sides: half of the widest gap in the glare
_WHITE, _LARGEST_RIM = 0.97, 0.03  # encoded; longer sides
_REACH, _REACH_OF_DISC = 0.2, 4.5  # widths, and radii: farther out the glow belongs to the sky
_RINGS = 16  # around the sun up to the reach
_RED_REACH = 1.5, 3.0  # of the reach: where a red glow on land ends
_GREEN = 0.1, 0.25  # over red, linear: less is glow alone, more has a color of its own
_LIT = 0.2, 0.35  # luminance: less is a silhouette, more is lit
_MOSTLY = 0.4, 0.6  # of the excess of light: less is no glow, more is nothing else
_DARKEST, _NOISE = 0.2, 0.002  # share of the land; linear light
_NEAREST = 0.25  # of the reach: how far beyond it the glow is compared


class Erased(NamedTuple):
    """A photo's small copy without its sun.

    Parameters
    ----------
    working : Working
        The copy; the photo's own if it shows no sun.
    mark : (h, w) float32
        Weight with which it replaces the photo when the sun has moved, [0, 1].
    on_land : (h, w) float32
        Share of the sun's glare in the land's light, [0, 1].
    hidden : (h, w) float32
        Where the copy's light is a guess and at most its detail is known, [0, 1].
    glow : (h, w) float32
        Where glare or air near the sun is too bright to detect clouds by whiteness, [0, 1].
    detail : (h', w', 3) float32
        Log of the sky's light over its local mean: its clouds (sky_detail.py).
    """

    working: Working
    mark: np.ndarray
    on_land: np.ndarray
    hidden: np.ndarray
    glow: np.ndarray
    detail: np.ndarray


def erase_nothing(working: Working) -> Erased:
    """Return the copy of a photo that shows no sun."""
    nowhere = np.zeros((working.height, working.width), np.float32)
    return Erased(working, nowhere, nowhere, nowhere, nowhere, np.zeros((1, 1, 3), np.float32))


def erase(working: Working, maps: SunMaps, sky: np.ndarray, light: SunObservation) -> Erased:
    """Remove the sun, its halo and its rays from a photo's small copy.

    Parameters
    ----------
    working : Working
    maps : SunMaps
    sky : (h, w) float32
        Sky matte at its size.
    light : SunObservation
        The sun or moon that the photo shows.
    """
    import cv2

    size = working.width, working.height
    rows, columns = maps.clean.shape[:2]
    small_sky = resize(sky, columns, rows)
    rays = find_rays(working, sky, light)
    there = np.log(working.linear + LIGHT_FLOOR) - rays
    seen = np.log(resize(np.exp(there), columns, rows))
    glare = _risen(maps, seen, small_sky, light)
    felt = _without_gaps(glare.max(-1))
    sun_mask = resize(light.blot, columns, rows)
    if float((sun_mask * felt).sum()) < _HIDES[0] * float(sun_mask.sum()):
        # The network does not erase a moon, or a sun that only the user sees.
        felt = np.maximum(felt, _round_about(sun_mask))
    # Nothing is known behind clipped pixels.
    white = resize((working.encoded.min(-1) > _WHITE).astype(np.float32), columns, rows)
    felt = np.maximum(felt, _round_about(sun_mask * white, _LARGEST_RIM))
    known = (1 - smoothstep(*_COLOURS, felt)) * smoothstep(0.8, 1.0, small_sky)
    behind = fill_by_layers(seen - glare, known.astype(np.float32))
    clouds = (seen - glare - behind) @ LUMINANCE * (1 - smoothstep(*_HIDES, felt))
    behind = behind + clouds[..., None]

    def enlarged(values: np.ndarray) -> np.ndarray:
        return cv2.resize(values.astype(np.float32), size, interpolation=cv2.INTER_LINEAR)

    # A rim is steeper than the network's map, so it is replaced by the sky behind, too.
    wide = cv2.dilate(felt.astype(np.float32), np.ones((3, 3), np.uint8))
    keep = enlarged(1 - smoothstep(*_HIDES, wide))[..., None]
    clean = np.exp(enlarged(behind) + keep * (there - enlarged(seen))) - LIGHT_FLOOR
    near_sky = cv2.dilate(small_sky, np.ones((3, 3), np.uint8))
    mark = enlarged(smoothstep(*_FELT, felt) * smoothstep(0.0, 0.5, near_sky))
    mark = np.maximum(mark, smoothstep(*_FELT, rays.max(-1)))
    linear = np.maximum(working.linear + mark[..., None] * (clean - working.linear), 0)
    linear = linear.astype(np.float32)
    copy = dataclasses.replace(working, linear=linear, encoded=encode(linear))
    away, reach = _distance(light, small_sky.shape)
    near = 1 - smoothstep(reach, 1.65 * reach, away)
    glow = near * smoothstep(*_WHITENS, np.maximum(felt, -maps.clean.min(-1)))
    hidden, whitened = enlarged(smoothstep(*_FELT, felt)), enlarged(glow)
    detail = sky_detail(there, sky, hidden, keep[..., 0])
    return Erased(
        copy, mark, find_glare_on_land(working, maps, sky, light), hidden, whitened, detail
    )


def _risen(maps: SunMaps, seen: np.ndarray, sky: np.ndarray, light: SunObservation) -> np.ndarray:
    """Return the excess of the glare over the glow farther out, (h, w, 3), log of light.

    A picture does not show how much of a wide glow belongs to the sky, and the fitted sky has one.
    The glare is limited to the picture's own excess (``seen``, log of light) over farther out.
    """
    near, beyond = _parts(light, sky)
    glare = np.maximum(fill_by_pyramid(maps.clean, beyond) - maps.clean, 0)
    excess = np.maximum(seen - fill_by_layers(seen, beyond), 0)
    brighter = excess @ LUMINANCE
    share = np.minimum(brighter / np.maximum(glare @ LUMINANCE, 1e-6), 1)
    # A halo is alike all round the sun; clouds are brighter.
    away, reach = _distance(light, sky.shape)
    rings = all_round(excess, (sky > 0.95) & (away < reach), away, reach / _RINGS)
    halo = interpolated(away, *rings)
    return np.asarray(np.maximum(glare * share[..., None], halo) * near[..., None])


def _without_gaps(felt: np.ndarray) -> np.ndarray:
    """Close gaps in the glare: where the camera clipped, the glare seems weaker."""
    import cv2

    side = 2 * round(_GAP * max(felt.shape)) + 1
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))
    return np.asarray(cv2.morphologyEx(felt.astype(np.float32), cv2.MORPH_CLOSE, kernel))


def find_glare_on_land(
    working: Working, maps: SunMaps, sky: np.ndarray, light: SunObservation
) -> np.ndarray:
    """Return the share of the sun's glare in the light of a small copy's land, (h, w).

    Land has no glow of its own: pixels as bright as land farther out have no glare.
    """
    import cv2

    rows, columns = maps.clean.shape[:2]
    land = smoothstep(0.9, 1.0, 1 - resize(sky, columns, rows))  # no skyline, which holds sky
    small = resize(working.linear, columns, rows)
    near, beyond = _parts(light, land)
    plain = np.maximum(fill_by_layers(small, beyond), 0)
    brighter = np.log(small + LIGHT_FLOOR) - np.log(plain + LIGHT_FLOOR)
    # An evening's glare is red: it shows in the channel with most of it.
    glare = np.maximum(np.minimum(-maps.clean * near[..., None], brighter), 0).max(-1)
    glare = np.maximum(glare, _red_glow(small, land, light))
    level = np.log(plain @ LUMINANCE + LIGHT_FLOOR)

    size = working.width, working.height
    glare, level = (
        cv2.resize(values.astype(np.float32), size, interpolation=cv2.INTER_LINEAR)
        for values in (glare, level)
    )
    # A clipped disc in front of land is removed completely.
    there = np.log(working.luminance + LIGHT_FLOOR)
    burnt = _round_about(light.blot) * np.maximum(there - level, 0)
    return np.asarray(1 - np.exp(-np.maximum(glare, burnt)), np.float32)


def _red_glow(linear: np.ndarray, land: np.ndarray, light: SunObservation) -> np.ndarray:
    """Return how far dark, purely red land exceeds the darkest, (h, w), log of light.

    In front of a red sunset lens and air add red light to silhouettes, farther from the sun than
    the network was trained for. Land that is lit reflects some green, too; in a picture where most
    of the brighter land does, nothing counts as glow.
    """
    away, reach = _distance(light, land.shape)
    seen = land > 0.9
    if not seen.any():
        return np.zeros(land.shape, np.float32)
    red, green, _ = np.moveaxis(linear, -1, 0)
    pure = 1 - smoothstep(*_GREEN, green / np.maximum(red, _NOISE))
    dark = 1 - smoothstep(*_LIT, linear @ LUMINANCE)
    near = 1 - smoothstep(*_RED_REACH, away / reach)
    excess = np.log((red + _NOISE) / (np.quantile(red[seen], _DARKEST) + _NOISE))
    excess = np.maximum(excess, 0) * near * land
    glow = excess * pure * dark
    # If more of what is brighter has a color of its own, the red part is no glow: it would be torn
    # out of a road or of hills.
    share = float(glow.sum()) / max(float(excess.sum()), 1e-6)
    return np.asarray(glow * smoothstep(*_MOSTLY, share), np.float32)


def _parts(light: SunObservation, part: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return weights (h, w) of pixels that the glare reaches, and of ``part`` beyond it."""
    away, reach = _distance(light, part.shape)
    beyond = smoothstep(0.6 * reach, reach, away) * np.maximum(part, 1e-3)
    beyond = beyond * np.exp(-np.maximum(away / reach - 1, 0) / _NEAREST)
    # The end is soft, or a glow that reaches farther would leave a ring.
    return 1 - smoothstep(0.4 * reach, reach, away), beyond.astype(np.float32)


def _distance(light: SunObservation, shape: tuple[int, ...]) -> tuple[np.ndarray, float]:
    """Return each pixel's distance from the sun on a map (h, w), and its glare's; in widths."""
    rows, columns = shape
    width, height = light.size
    away = np.hypot(
        (np.arange(columns) + 0.5) / columns - light.x / width,
        ((np.arange(rows)[:, None] + 0.5) / rows - light.y / height) * height / width,
    )
    return away, _REACH + _REACH_OF_DISC * light.radius_px / width


def _round_about(sun_mask: np.ndarray, largest: float = 1.0) -> np.ndarray:
    """Return a disc's pixels with its rim and glow, (h, w) float32 in [0, 1].

    They reach three radii; ``largest`` limits the radius, in longer sides.
    """
    import cv2

    radius = max(1.0, float(np.sqrt(sun_mask.sum() / np.pi)))
    radius = min(radius, largest * max(sun_mask.shape))
    if not sun_mask.any():
        return np.zeros(sun_mask.shape, np.float32)
    # On a small map a small disc may fill no pixel.
    outside = sun_mask < 0.5 * min(float(sun_mask.max()), 1.0)
    away = cv2.distanceTransform(outside.astype(np.uint8), cv2.DIST_L2, 5)
    return np.asarray(1 - smoothstep(0.5 * radius + 1, 2 * radius + 3, away), np.float32)
