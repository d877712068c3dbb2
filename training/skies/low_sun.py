"""Learn what photos of a low sun show beyond a clear sky's model (shaders/sky/low_sun.glsl).

    python -m training.skies.low_sun DATA [--photos 100]

compares photos of the training half whose sun is seen, by its height over the skyline, with
edits of photos without a sun in which ours stands as high. What is left between their median
colors by distance from the sun, in stops of linear light, is printed for each height, and a fit
``far + (near - far) exp(-(distance / reach)²)`` of it: what the shader's numbers, as they are,
still lack.
"""

from __future__ import annotations

import argparse
import random
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.formats.color import srgb_to_linear
from training.suns.labels import Photo, labels

WIDTH = 512
DISTANCES = (0.04, 0.08, 0.14, 0.22, 0.32, 0.45, 0.65)  # in widths of the picture
HEIGHTS = {0.7: (-0.03, 0.03), 3: (0.03, 0.07), 6: (0.07, 0.13), 10: (0.13, 0.2), 15: (0.2, 0.3)}
REACH = 0.3  # widths
FEWEST = 200  # pixels for a color estimate
LEAST_SKY = 0.2  # of the picture
SEED = 16


def arguments(description: str) -> argparse.Namespace:
    """The folder of the data and the number of photos to edit, from the command line."""
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("data", type=Path)
    parser.add_argument("--photos", type=int, default=100, metavar="N", help="photos to edit")
    return parser.parse_args()


def small(picture: np.ndarray, width: int = WIDTH) -> np.ndarray:
    """The picture or mask, ``width`` pixels wide."""
    height = round(picture.shape[0] * width / picture.shape[1])
    return cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA)


def profile(picture: np.ndarray, sky: np.ndarray, x: float, y: float) -> np.ndarray:
    """Median code values (6, 3) of the sky between ``DISTANCES``; NaN where there is none.

    ``sky`` is a matte, 0 to 255; ``x`` and ``y`` are fractions of width and height.
    """
    picture, sky = small(picture), small(sky)
    inside = cv2.erode((sky > 247).astype(np.uint8), np.ones((7, 7)), borderValue=1) > 0
    rows, columns = np.mgrid[: len(picture), :WIDTH] + 0.5
    away = np.hypot(columns / WIDTH - x, (rows - y * len(picture)) / WIDTH)
    found = np.full((len(DISTANCES) - 1, 3), np.nan)
    for i, (near, far) in enumerate(pairwise(DISTANCES)):
        here = inside & (away >= near) & (away < far)
        if here.sum() >= FEWEST:
            found[i] = np.median(picture[here], 0)
    return found


def photos(data: Path, suns: bool, most: int = 10**6) -> Iterator[tuple[Photo, Path]]:
    """Yield photos of the training half with or without a sun, in a drawn order."""
    chosen = [p for p in labels() if not p.test and p.kind == ("disc" if suns else "none")]
    random.Random(SEED).shuffle(chosen)
    for photo in chosen[:most]:
        folder, name = photo.file.split("/")
        yield photo, data / "train" / folder / "images" / name


def seen_suns(data: Path) -> Iterator[tuple[float, np.ndarray, np.ndarray, Photo]]:
    """Yield the sun's height over the skyline (widths), RGB picture, matte and label of photos."""
    for photo, path in photos(data, True):
        picture = cv2.imread(str(path))
        sky = cv2.imread(str(path.parents[1] / "masks" / f"{path.stem}.png"), 0)
        if picture is None or sky is None or (sky > 247).mean() < LEAST_SKY:
            continue
        rows = [np.flatnonzero(column > 247) for column in sky.T]
        skyline = np.median([row[-1] for row in rows if row.size]) / len(sky)
        height = (skyline - photo.y) * len(picture) / picture.shape[1]
        yield height, picture[..., ::-1], sky, photo


def real(data: Path) -> dict[float, list[np.ndarray]]:
    """Profiles of photos by the sun's height."""
    found: dict[float, list[np.ndarray]] = {height: [] for height in HEIGHTS}
    for height, picture, sky, photo in seen_suns(data):
        for name, (low, high) in HEIGHTS.items():
            if low <= height < high:
                found[name].append(profile(picture, sky, photo.x, photo.y))
    return found


def edited(scene: sw.Scene, sun: tuple[float, float]) -> np.ndarray:
    """The edit (RGB) with its sun at an azimuth and elevation, degrees."""
    edit = sw.Edit(sun_azimuth=sun[0], sun_elevation=sun[1])
    return np.ascontiguousarray(sw.render(scene, edit)[..., :3])


def edit_profile(scene: sw.Scene, sky: np.ndarray, sun: tuple[float, float]) -> np.ndarray:
    """``profile`` of the edit with its sun at an azimuth and elevation, degrees."""
    frame = edited(scene, sun)
    x, y = scene.camera.pixel(*sun)
    place = (x / scene.camera.width, y / scene.camera.height)
    return profile(frame, cv2.resize(sky, frame.shape[1::-1]), *place)


def ours(data: Path, most: int) -> dict[float, list[np.ndarray]]:
    """Profiles of edits by the sun's height."""
    found: dict[float, list[np.ndarray]] = {height: [] for height in HEIGHTS}
    for _, path in photos(data, False, most):
        scene = sw.analyze(sw.open(path))
        sky = np.uint8(255 * np.asarray(scene.sky))
        if (sky > 247).mean() < LEAST_SKY:
            continue
        for height in HEIGHTS:
            found[height].append(edit_profile(scene, sky, (8, height)))
    return found


def fitted(lacks: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Near and far, (3,) stops, of what is lacking by distance, (6, 3)."""
    middle = np.add(DISTANCES[1:], DISTANCES[:-1]) / 2
    near = np.exp(-((middle / REACH) ** 2))
    known = np.isfinite(lacks).all(1)
    at = np.stack([near, 1 - near], 1)[known]
    return tuple(np.linalg.lstsq(at, lacks[known], rcond=None)[0])


def main() -> None:
    """Print what is lacking."""
    asked = arguments(__doc__)
    cv2.setNumThreads(1)
    true, edited = real(asked.data), ours(asked.data, asked.photos)
    for height in HEIGHTS:
        medians = [np.nanmedian(each[height], 0) for each in (true, edited)]
        true_light, edited_light = (srgb_to_linear(each / 255) for each in medians)
        lacks = np.log2(true_light / edited_light)
        near, far = fitted(lacks)
        print(f"{height} degrees: {len(true[height])} photos, {len(edited[height])} edits")
        print(np.hstack([*medians, lacks]).round(2))
        print("near", near.round(2), "far", far.round(2), flush=True)


if __name__ == "__main__":
    main()
