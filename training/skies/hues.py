"""Measure hues and texture of photos of a low sun (sky/low_sun.glsl, sky/relit_sky.glsl).

    python -m training.skies.hues DATA [--photos 100]

prints, for photos of the training half whose sun is seen less than 0.13 widths above the skyline
and for edits of photos by day whose sun is moved to 3 and to 12 degrees: the median of log2 of red
over green by that of blue over green, in the sky and in the land; and how much the sky's
luminance, red over green and blue over green (log2) deviate from their surroundings.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.formats.color import LUMINANCE, srgb_to_linear
from training.skies.low_sun import photos, seen_suns

WIDTH = 48
SIDE = 384  # of what is analyzed
LOW = (-0.03, 0.13)  # widths above the skyline
HIGH = 15  # degrees: a sun by day
BLUES = np.arange(-1.8, 1.3, 0.6)
REACH = 5  # pixels: a tenth of the width
FEWEST = 60  # pixels of a region
FLOOR = 2e-3
RANGE = (0.01, 0.9)  # luminance that is neither noise nor clipped
SUNS = {"3 degrees": (8.0, 3.0), "12 degrees": (-20.0, 12.0)}


def logs(picture: np.ndarray, sky: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return log2 of luminance, red and blue over green, where it is known, and the matte."""
    size = (WIDTH, round(WIDTH * picture.shape[0] / picture.shape[1]))
    light = srgb_to_linear(cv2.resize(picture, size, interpolation=cv2.INTER_AREA) / 255.0)
    level = light @ LUMINANCE
    green = light[..., 1] + FLOOR
    found = np.stack(
        [level + FLOOR, (light[..., 0] + FLOOR) / green, (light[..., 2] + FLOOR) / green], -1
    )
    known = (level > RANGE[0]) & (level < RANGE[1])
    return np.log2(found), known, cv2.resize(sky, size, interpolation=cv2.INTER_AREA)


def texture(values: np.ndarray, here: np.ndarray) -> np.ndarray:
    """Return deviations from the surroundings, (3,)."""
    weight = here.astype(float)
    blurred = cv2.GaussianBlur(values * weight[..., None], (0, 0), REACH)
    around = blurred / np.maximum(cv2.GaussianBlur(weight, (0, 0), REACH), 1e-6)[..., None]
    return (values - around)[here].std(0)


def show(name: str, pictures: list[tuple[np.ndarray, np.ndarray]]) -> None:
    """Print the medians of pictures (RGB) with their mattes of the sky, 0 to 255."""
    print(f"{name}, {len(pictures)}")
    textures = []
    colors: dict[str, list[np.ndarray]] = {"sky": [], "land": []}
    for picture, matte in pictures:
        values, known, sky = logs(picture, matte)
        for region, here in (("sky", known & (sky > 242)), ("land", known & (sky < 5))):
            if here.sum() < FEWEST:
                continue
            # Every picture counts alike.
            colors[region].append(np.insert(values[here][:, 1:], 2, 1 / here.sum(), axis=1))
            if region == "sky":
                textures.append(texture(values, here))
    print("  deviations of luminance, red, blue", np.median(textures, 0).round(2))
    print("  blue over green", BLUES.round(1))
    for region, found in colors.items():
        red, blue, weight = np.concatenate(found).T
        print(
            f"  red over green, {region:4}",
            np.array([middle(red, weight, abs(blue - b) < 0.3) for b in BLUES]),
        )


def middle(values: np.ndarray, weight: np.ndarray, here: np.ndarray) -> float:
    """Return the weighted median of some values."""
    if not here.any():
        return float("nan")
    order = np.argsort(values[here])
    summed = np.cumsum(weight[here][order])
    return round(float(values[here][order][np.searchsorted(summed, summed[-1] / 2)]), 2)


def scenes(data: Path, most: int) -> Iterator[sw.Scene]:
    """Yield scenes of photos by day."""
    for _, path in photos(data, False, most):
        scene = sw.analyze(sw.open(path))
        if scene.automatic["sun_elevation"] > HIGH:
            yield scene


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("data", type=Path)
    parser.add_argument("--photos", type=int, default=100, metavar="N", help="photos to edit")
    options = parser.parse_args()
    low = [
        (picture, sky)
        for height, picture, sky, _ in seen_suns(options.data)
        if LOW[0] <= height < LOW[1]
    ]
    show("photos of a low sun", low)
    edits: dict[str, list[tuple[np.ndarray, np.ndarray]]] = {name: [] for name in SUNS}
    for scene in scenes(options.data, options.photos):
        sky = np.uint8(255 * np.asarray(scene.sky))
        for name, (azimuth, elevation) in SUNS.items():
            frame = sw.render(scene, sw.Edit(sun_azimuth=azimuth, sun_elevation=elevation))[..., :3]
            edits[name].append((np.ascontiguousarray(frame), cv2.resize(sky, frame.shape[1::-1])))
    for name, pictures in edits.items():
        show(f"edits, {name}", pictures)


if __name__ == "__main__":
    main()
