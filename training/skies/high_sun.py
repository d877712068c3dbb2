"""Compare blue skies around high suns in photos and in edits (camera/white_balance.glsl).

    python -m training.skies.high_sun DATA [--photos 100]

prints, by distance from the sun, luminance (log2 of white) and log2 of red over blue: quartiles of
photos of the training half whose sun is seen in a blue sky, and of edits of photos with a blue sky
in which our sun stands at 12 and 20 degrees.
"""

from __future__ import annotations

import argparse
from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.formats.color import LUMINANCE, srgb_to_linear
from training.skies.low_sun import WIDTH, photos, profile

DISTANCES = (0.03, 0.06, 0.1, 0.14, 0.2, 0.28, 0.38, 0.5, 0.65)  # in widths of the picture
HIGH = 0.3  # widths above the skyline: a sun by day
BLUE = 20  # code values of blue over red, far from the sun or as the sky's median
LEAST_SKY = 0.2
HEIGHTS = (12, 20)  # degrees
AZIMUTH = -20


def is_blue(color: np.ndarray) -> bool:
    """Whether a color (3,), in code values, is a blue sky's."""
    return bool(color[2] > color[0] + BLUE)


def real(data: Path) -> list[np.ndarray]:
    """Profiles of photos of a high sun in a blue sky."""
    found = []
    for photo, path in photos(data, True):
        picture = cv2.imread(str(path))
        sky = cv2.imread(str(path.parents[1] / "masks" / f"{path.stem}.png"), 0)
        if picture is None or sky is None or (sky > 247).mean() < LEAST_SKY:
            continue
        skyline = np.median([np.flatnonzero(c > 247)[-1] for c in sky.T if (c > 247).any()])
        if (skyline / len(sky) - photo.y) * len(picture) / picture.shape[1] < HIGH:
            continue
        colors = profile(picture[..., ::-1], sky, photo.x, photo.y, DISTANCES)
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
        size = (WIDTH, round(WIDTH * scene.camera.height / scene.camera.width))
        before = sw.render(scene, sw.Edit(), size=size)[..., :3]
        inside = cv2.resize(sky, size) > 247
        if inside.mean() < LEAST_SKY or not is_blue(np.median(before[inside], 0)):
            continue
        for height in HEIGHTS:
            edit = sw.Edit(sun_azimuth=AZIMUTH, sun_elevation=height)
            frame = np.ascontiguousarray(sw.render(scene, edit, size=size)[..., :3])
            x, y = scene.camera.pixel(AZIMUTH, height)
            place = (x / scene.camera.width, y / scene.camera.height)
            found[height].append(profile(frame, cv2.resize(sky, size), *place, DISTANCES))
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
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", type=Path)
    parser.add_argument("--photos", type=int, default=100)
    asked = parser.parse_args()
    cv2.setNumThreads(1)
    show("photos", real(asked.data))
    for height, profiles in ours(asked.data, asked.photos).items():
        show(f"edits, sun at {height} degrees", profiles)


if __name__ == "__main__":
    main()
