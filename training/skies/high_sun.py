"""Measure blue skies around suns by day, in photos and in edits (sky/day_color.glsl).

    python -m training.skies.high_sun DATA [--photos 100]

prints, by the angle from the sun: log2 of red and of blue over green as shares of those far away,
log2 of the luminance, and the same less that 11 degrees from the sun. Medians of photos of the
training half whose sun is seen in a blue sky, and of edits of photos with a blue sky in which our
sun stands at 12 degrees; the far color of these is that of their photos.
"""

from __future__ import annotations

from itertools import pairwise

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.analysis.sun.camera_glare import angle_to_sun
from sunwidget.formats.color import LUMINANCE, srgb_to_linear
from training.skies.low_sun import arguments, edited, photos, small

WIDTH = 48
ANGLES = (3, 6, 9, 13, 18, 25, 35, 50)  # degrees from the sun
BESIDE, FAR = 2, slice(4, None)  # of these ranges
BLUE = 0.8  # log2 of blue over red of the sky's mean
FAINTEST = 0.3  # log2 of a color that has shares
FEWEST = 8  # pixels
SEEN = (7.0, 45.0)  # degrees: heights of the suns in photos
SUN = (-20.0, 12.0)  # of the edits
FLOOR = 2e-3


def is_blue(picture: np.ndarray, sky: np.ndarray) -> bool:
    """Whether the sky of a picture (RGB) is blue on average; ``sky`` is a matte, 0 to 255."""
    inside = small(sky, WIDTH) > 242
    if not inside.any():
        return False
    mean = srgb_to_linear(small(picture, WIDTH)[inside] / 255.0).mean(0)
    return bool(np.log2((mean[2] + 1e-4) / (mean[0] + 1e-4)) > BLUE)


def profile(
    picture: np.ndarray, sky: np.ndarray, scene: sw.Scene, sun: tuple[float, float]
) -> np.ndarray:
    """Medians of log2 of red and blue over green and of luminance, (3, 7), by angle from a sun.

    ``sun`` is its azimuth and elevation in degrees; NaN where there is no sky.
    """
    picture, sky = small(picture, WIDTH), small(sky, WIDTH)
    light = srgb_to_linear(picture / 255.0) + FLOOR
    red, green, blue = np.moveaxis(light, -1, 0)
    logs = np.log2(np.stack([red / green, blue / green, light @ LUMINANCE]))
    away = angle_to_sun(scene.camera, (WIDTH, len(picture)), sun)
    found = np.full((3, len(ANGLES) - 1), np.nan)
    for i, (near, far) in enumerate(pairwise(ANGLES)):
        here = (sky > 242) & (away >= near) & (away < far)
        if here.sum() >= FEWEST:
            found[:, i] = np.median(logs[:, here], axis=1)
    return found


def show(name: str, found: list[np.ndarray], own: list[np.ndarray]) -> None:
    """Print the medians; the far colors are those of ``own``."""
    known = [
        (each, far)
        for each, photo in zip(found, own, strict=True)
        if np.isfinite(photo[0, FAR]).any()
        and -(far := np.nanmedian(photo[:2, FAR], axis=1))[0] > FAINTEST < far[1]
    ]
    profiles = np.array([each for each, _ in known])
    shares = profiles[:, :2] / np.array([far for _, far in known])[..., None]
    print(f"{name}: {len(known)}")
    print("  degrees       ", *(f"{low}-{high}" for low, high in pairwise(ANGLES)))
    beside = profiles[:, 2] - profiles[:, 2, BESIDE, None]
    rows = shares[:, 0], shares[:, 1], profiles[:, 2], beside
    for label, values in zip(("red", "blue", "luminance", "less that at 11"), rows, strict=True):
        print(f"  {label:15}", *np.nanmedian(values, axis=0).round(2))


def main() -> None:
    """Print both."""
    asked = arguments(__doc__)
    cv2.setNumThreads(1)
    real, edits, before = [], [], []
    for seen in (True, False):
        for _, path in photos(asked.data, seen, 10**6 if seen else asked.photos):
            scene = sw.analyze(sw.open(path))
            sky = np.uint8(255 * np.asarray(scene.sky))
            photo = np.ascontiguousarray(sw.render(scene, sw.Edit())[..., :3])
            if (scene.sun is not None) != seen or not is_blue(photo, sky):
                continue
            if scene.sun is None:
                edits.append(profile(edited(scene, SUN), sky, scene, SUN))
                before.append(profile(photo, sky, scene, SUN))
            elif SEEN[0] <= scene.sun.elevation < SEEN[1]:
                sun = (scene.sun.azimuth, scene.sun.elevation)
                real.append(profile(photo, sky, scene, sun))
    show("photos", real, real)
    show(f"edits, sun at {SUN[1]:.0f} degrees", edits, before)


if __name__ == "__main__":
    main()
