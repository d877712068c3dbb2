"""Glitter: the old sun's glints on water and other shiny surfaces."""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.fit.fit import Response
from sunwidget.analysis.images.working_copy import Working, resize, smoothstep
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

SIDE = 256  # px: waves average out
STANDARD_VARIANCE = 0.5 * (1e-3 + 3.16e-3 * 5 + 3e-3 + 1.92e-3 * 5)  # water/glint.glsl at 5 m/s
_FALL = 300.0
_WHITE_LAND = 0.3, 0.15  # median light of land that does not glint, and that may (display-linear)
_STEEP_SHARE, _STEEP_VARIANCE = 0.1, 6.0  # as in water/glint.glsl
_BELOW = 0.06  # widths: from the sun's column
_DRAWN = 0.5  # so that as much is drawn: the column's light over that beside it in 23 photos
_BRIGHTEST = 1.5  # scene-linear: beyond it, what is seen below the sun is not these waves' glints
_LOWEST = 0.5  # degrees: the photo's own sun on the horizon
_WIDTH = 0.3  # of the picture's width: greatest distance of glints from the sun's column


def glitter(
    working: Working,
    sky: np.ndarray,
    water: np.ndarray | None = None,
    sun_column: float | None = None,
) -> np.ndarray:
    """Return the zone of the old sun's glints.

    It surrounds clipped pixels on land, and on water those around the sun's column, together with
    water below the sun that is brighter than the rest of its row. Other white water is foam. It is
    a zone, since clipped and almost clipped pixels must be relit alike, or the brightest would
    become darker than their rim.

    Parameters
    ----------
    working : Working
        The small photo.
    sky, water : (h, w) float32
        Maps at its size; None means no water.
    sun_column : float, optional
        Column where the azimuth of the photo's sun meets the horizon, in fractions of the width;
        None if the photo does not show its sun.

    Returns
    -------
    (h, w) float32 in [0, 1]
    """
    import cv2

    red, green, blue = np.moveaxis(working.linear, -1, 0)
    white = np.minimum(np.minimum(red, green), blue)  # ten times as fast as min(-1)
    burnt = np.clip((white - 0.5) / 0.4, 0, 1).astype(np.float32) * (1 - sky)
    if water is not None:
        burnt = burnt * (1 - water * (1 - _near(water.shape[1], sun_column)))
    reach = 2 * max(2, round(0.012 * max(sky.shape))) + 1
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach))
    # In bytes: a fifth of the time, and as precise as the frame's texture.
    spread = cv2.dilate(np.round(burnt * 255).astype(np.uint8), kernel)
    zone = cv2.GaussianBlur(spread.astype(np.float32) / 255, (0, 0), reach / 3)
    if water is not None and sun_column is not None and water.any():
        zone = np.maximum(zone, _under_sun(working, water, sun_column))
    return np.clip(zone * (1 - sky), 0, 1).astype(np.float32)


def glints_on_land(working: Working, sky: np.ndarray, water: np.ndarray) -> float:
    """Return whether what is white on dry land may be glints, [0, 1].

    Wet streets and wet sand outshine the rest of the land by far. Land that is bright all over is
    snow or shingle, and would have dark holes where its brightest parts counted as a mirror image.
    Parameters as for ``glitter``.
    """
    dry = (sky < 0.5) & (water < 0.5)
    median = float(np.median(working.luminance[dry])) if dry.any() else 1.0
    return float(smoothstep(*_WHITE_LAND, median))


def azimuth_column(camera: Camera, azimuth: float) -> float | None:
    """Return the column of an azimuth in degrees at the horizon, in widths; None far aside."""
    if abs(azimuth) > 80:
        return None
    return float(camera.pixel(azimuth, 0.0)[0] / camera.width)


def _under_sun(working: Working, water: np.ndarray, column: float) -> np.ndarray:
    """Return water near the sun's column that is brighter than its row, (h, w) float32."""
    import cv2

    mask, excess = _excess(working, water, column)
    width = mask.shape[1]
    soft = cv2.GaussianBlur(excess * mask, (0, 0), 1.5) / np.maximum(
        cv2.GaussianBlur(mask, (0, 0), 1.5), 0.1
    )
    found = np.clip((soft - 0.15) / 0.35, 0, 1) * _near(width, column)
    found = cv2.GaussianBlur(cv2.dilate(found.astype(np.float32), np.ones((3, 5))), (0, 0), 2.0)
    return np.asarray(resize(found, working.width, working.height)) * (water > 0)


def roughness(
    working: Working, water: np.ndarray, camera: Camera, sun: tuple[float, float]
) -> float:
    """Return the slope variance of the photo's water relative to the standard wind's.

    It follows from the width of the old sun's glints: a facet that mirrors a sun of elevation s
    into the eye from e below the horizon and an azimuth a beside it has the slope
    a / (sin s + sin e) across (Cox & Munk 1954, eq. 2, for small a). At their visible edge, glints
    have fallen to about a 300th of their middle, which the photo clips.

    Parameters
    ----------
    working : Working
    water : (h, w) float32
        Water at its size.
    camera : Camera
        Camera for any size.
    sun : (azimuth, elevation)
        Visible sun in degrees.

    Returns
    -------
    float
        0.05 to 2 times the slope variance of the standard wind of 5 m/s; 1 without glints.
    """
    import cv2

    column = azimuth_column(camera, sun[0])
    if column is None or not water.any() or not 1 < sun[1] < 60:
        return 1.0
    mask, excess = _excess(working, water, column)
    height, width = mask.shape
    small = camera.resized(width, height)
    # Averages out single waves; the glow around the glints belongs to the mirrored sky.
    excess = cv2.GaussianBlur(excess * mask, (0, 0), 1.0, sigmaY=3.0)
    middle = int(np.clip(column * width, 0, width - 1))
    sides = [min(max(middle + step, 0), width - 1) for step in (-width // 5, width // 5)]
    around = slice(max(middle - width // 12, 0), middle + width // 12 + 1)
    slopes = []
    rows = [row for row in range(height) if mask[row, around].mean() > 0.6]
    for row in rows:
        depth = -small.angles(column * width, row + 0.5)[1]
        peak = around.start + int(np.argmax(excess[row, around]))
        beside = float(np.mean(excess[row, sides]))
        if depth < 0.5 or excess[row, peak] - beside < np.log(1.7):
            continue
        dark = excess[row] < beside + 0.75 * (excess[row, peak] - beside)
        left = peak - int(np.argmax(np.append(dark[peak::-1], True)))
        right = peak + int(np.argmax(np.append(dark[peak:], True)))
        across = small.angles(column * width + (right - left) / 2, row + 0.5)[0] - sun[0]
        rise = np.sin(np.radians(sun[1])) + np.sin(np.radians(depth))
        slopes.append(np.radians(across) / rise)
    if len(slopes) < max(4, 0.4 * len(rows)):
        return 1.0
    deviation = float(np.median(slopes)) / np.sqrt(2 * np.log(_FALL))
    return float(np.clip(deviation**2 / STANDARD_VARIANCE, 0.05, 2))


def own_glints(
    working: Working,
    water: np.ndarray,
    camera: Camera,
    sun: tuple[float, float],
    response: Response,
    rough: float,
) -> float:
    """Return how bright the sun is whose glints the photo shows on its water.

    The light of the water under the sun beyond that beside it, over what level water with these
    waves would mirror of a sun of light 1 (water/glint.glsl).

    Parameters
    ----------
    working, water, camera, sun
        As for ``roughness``.
    response : Response
        Of the photo's fit.
    rough : float
        From ``roughness``.

    Returns
    -------
    float
        Luminance of its light, scene-linear; 0 if no water lies below the sun.
    """
    column = azimuth_column(camera, sun[0])
    if column is None or not water.any():
        return 0.0
    linear, mask = small_copy(working, water)
    light = response.scene_light(linear) @ LUMINANCE
    height, width = mask.shape
    drawn = mirrored(camera.resized(width, height), (sun[0], max(sun[1], _LOWEST)), rough)
    away = np.abs((np.arange(width) + 0.5) / width - column)
    below, beside = away < _BELOW, (away > 2 * _BELOW) & (away < 5 * _BELOW)
    seen = mask > 0.6
    sums = np.zeros(2)
    rows = 0
    for row in range(height):
        under, side = seen[row] & below, seen[row] & beside
        if under.sum() < 0.6 * below.sum() or side.sum() < 8:
            continue
        for i, part in enumerate((light[row], drawn[row])):
            sums[i] += np.maximum(part[under] - np.quantile(part[side], 0.4), 0).sum()
        rows += 1
    found = _DRAWN * float(sums[0] / max(sums[1], 1e-9))
    return min(found, _BRIGHTEST) if rows >= 4 else 0.0


def mirrored(camera: Camera, sun: tuple[float, float], rough: float) -> np.ndarray:
    """Return the light (h, w) of glints everywhere, per light of the sun: ``GetGlint``'s twin."""
    rows, columns = np.mgrid[: camera.height, : camera.width] + 0.5
    azimuth, elevation = np.radians(camera.angles(columns, rows))
    view = _direction(azimuth, np.minimum(elevation, -0.002))
    to_sun = _direction(*np.radians(sun))
    facet = to_sun - view
    facet /= np.linalg.norm(facet, axis=-1, keepdims=True)
    rise = np.maximum(facet[..., 1], 1e-3)
    total = STANDARD_VARIANCE * rough
    variance = total / (1 + _STEEP_SHARE * (_STEEP_VARIANCE - 1))
    square = (facet[..., 0] ** 2 + facet[..., 2] ** 2) / rise**2 / variance
    steep = np.exp(-0.5 * square / _STEEP_VARIANCE) / _STEEP_VARIANCE
    density = (1 - _STEEP_SHARE) * np.exp(-0.5 * square) + _STEEP_SHARE * steep
    fresnel = 0.02 + 0.98 * (1 - np.clip(facet @ to_sun, 0, 1)) ** 5
    facing = np.sqrt(view[..., 1] ** 2 + total)
    shown = fresnel * density / (2 * np.pi * variance) / (4 * facing * rise**4)
    return np.asarray(shown / (1 + shown))


def _direction(azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
    level = np.cos(elevation)
    return np.stack([np.sin(azimuth) * level, np.sin(elevation), np.cos(azimuth) * level], -1)


def small_copy(working: Working, water: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return linear light (h, w, 3) and water (h, w) at most ``SIDE`` pixels long."""
    scale = min(1.0, SIDE / max(working.width, working.height))
    linear = np.asarray(resize(working.linear, working.width * scale, working.height * scale))
    return linear, np.asarray(resize(water, linear.shape[1], linear.shape[0]), np.float32)


def _near(width: int, column: float | None) -> np.ndarray:
    """Return how near each column is to the sun's, (width,) float32 in [0, 1]."""
    if column is None:
        return np.zeros(width, np.float32)
    return np.clip(2 - 2 * _away(width, column), 0, 1).astype(np.float32)


def _away(width: int, column: float) -> np.ndarray:
    return np.asarray(np.abs((np.arange(width) + 0.5) / width - column) / _WIDTH)


def _excess(working: Working, water: np.ndarray, column: float) -> tuple[np.ndarray, np.ndarray]:
    """Return water, and log luminance relative to the rest of the row, on a small copy."""
    linear, mask = small_copy(working, water)
    width = mask.shape[1]
    light = np.log(linear @ LUMINANCE + 0.004)
    away = _away(width, column)
    excess = np.zeros_like(light)
    seen = mask > 0.6
    for row in np.flatnonzero(seen.sum(axis=1) >= 8):
        # Glints may fill half a row; pixels beside them have the water's own light.
        beside = seen[row] & (away > 0.5) if (seen[row] & (away > 0.5)).sum() >= 8 else seen[row]
        excess[row] = light[row] - np.quantile(light[row][beside], 0.4)
    return mask, excess
