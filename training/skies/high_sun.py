"""Compare blue skies around high suns in photos and in edits (sky/day_color.glsl).

    python -m training.skies.high_sun DATA [--photos 100]

prints, by distance from the sun, luminance (log2 of white) and log2 of red over blue: quartiles of
photos of the training half whose sun is seen in a blue sky, and of edits of photos with a blue sky
in which our sun stands at 12 and 20 degrees.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.formats.color import LUMINANCE, srgb_to_linear
from training.skies.low_sun import LEAST_SKY, arguments, edit_profile, photos, profile, seen_suns

DISTANCES = (0.03, 0.06, 0.1, 0.14, 0.2, 0.28, 0.38, 0.5, 0.65)  # in widths of the picture
HIGH = 0.3  # widths above the skyline: a sun by day
BLUE = 20  # code values of blue over red, far from the sun or as the sky's median
HEIGHTS = (12, 20)  # degrees
AZIMUTH = -20


def is_blue(color: np.ndarray) -> bool:
    """Whether a color (3,), in code values, is a blue sky's."""
    return bool(color[2] > color[0] + BLUE)


def real(data: Path) -> list[np.ndarray]:
    """Profiles of photos of a high sun in a blue sky."""
    found = []
    for height, picture, sky, photo in seen_suns(data):
        if height < HIGH:
            continue
        colors = profile(picture, sky, photo.x, photo.y, DISTANCES)
        known = colors[np.isfinite(colors).all(1)]
        if len(known) and is_blue(known[-1]):
            found.append(colors)
    return found


def ours(data: Path, most: int) -> dict[int, list[np.ndarray]]:
    """Profiles of edits of photos with a blue sky, by the sun's height."""
    found: dict[int, list[np.ndarray]] = {height: [] for height in HEIGHTS}
    for _, path in photos(data, False, most):
        scene = sw.analyze(sw.open(path))
        sky = np.uint8(255 * np.asarray(scene.sky))
        before = sw.render(scene, sw.Edit())[..., :3]
        inside = cv2.resize(sky, before.shape[1::-1]) > 247
        if inside.mean() < LEAST_SKY or not is_blue(np.median(before[inside], 0)):
            continue
        for height in HEIGHTS:
            found[height].append(edit_profile(scene, sky, (AZIMUTH, height), DISTANCES))
    return found


def show(name: str, profiles: list[np.ndarray]) -> None:
    """Print quartiles by distance."""
    light = srgb_to_linear(np.array(profiles) / 255)
    level = np.log2(np.maximum(light @ LUMINANCE, 1e-4))
    warmth = np.log2((light[..., 0] + 0.003) / (light[..., 2] + 0.003))
    print(f"{name}: {len(profiles)}")
    print("  widths     ", *(f"{low:.2f}-{high:.2f}" for low, high in pairwise(DISTANCES)))
    for label, values in (("luminance", level), ("red over blue", warmth)):
        for quarter in (25, 50, 75):
            row = np.nanpercentile(values, quarter, axis=0)
            print(f"  {label} {quarter} %", *row.round(1))


def main() -> None:
    """Print both."""
    asked = arguments(__doc__)
    cv2.setNumThreads(1)
    show("photos", real(asked.data))
    for height, profiles in ours(asked.data, asked.photos).items():
        show(f"edits, sun at {height} degrees", profiles)


if __name__ == "__main__":
    main()
