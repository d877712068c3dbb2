"""Measure skies and land of dusk, and skies of day (sky/low_sun.glsl).

    python -m training.skies.dusk DATA [--photos 100]

prints log2 of luminance, of red over green and of blue over green: medians of the photos that
``dusk.txt`` lists (a reader without knowledge of the code chose them: the sun is a few degrees
below the horizon), of edits of other photos whose sun is moved to 4 degrees below it, and of those
of the other photos whose unseen sun is assumed to be high; the same of the brighter half of the
land, with its luminance relative to the sky's.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np

import sunwidget as sw
from sunwidget.analysis.fit.fit import view_angles
from sunwidget.formats.color import LUMINANCE, srgb_to_linear
from sunwidget.photo.photo import open_photo
from training.skies.low_sun import arguments, photos

PHOTOS = Path(__file__).with_name("dusk.txt")
HEIGHTS = (0, 3, 6, 10, 15, 22, 30, 45)  # degrees
SIDE = 384
FEWEST = 60  # pixels of a height
FLOOR = 1e-3
HIGH = 15  # degrees: a sun by day
AHEAD = 45  # degrees between the sun's azimuth and the camera's of an edit


def profile(picture: np.ndarray, scene: sw.Scene) -> np.ndarray:
    """Return luminance, red and blue over green (log2) by height, (heights, 3), NaN without sky."""
    elevation = view_angles(scene.camera, scene.width, scene.height)[1]
    sky = np.asarray(scene.sky) > 0.95
    found = np.full((len(HEIGHTS) - 1, 3), np.nan)
    for i, (low, high) in enumerate(pairwise(HEIGHTS)):
        here = sky & (elevation >= low) & (elevation < high)
        if here.sum() >= FEWEST:
            light = srgb_to_linear(np.median(picture[here], 0) / 255) + FLOOR
            found[i] = np.log2([light @ LUMINANCE, light[0] / light[1], light[2] / light[1]])
    return found


def of_land(picture: np.ndarray, scene: sw.Scene) -> np.ndarray:
    """Return the land's luminance over the sky's, red and blue over green (log2), (3,)."""
    light = srgb_to_linear(picture / 255) + FLOOR
    level = light @ LUMINANCE
    sky, land = np.asarray(scene.sky) > 0.95, np.asarray(scene.sky) < 0.02
    if min(sky.sum(), land.sum()) < FEWEST:
        return np.full(3, np.nan)
    bright = land & (level >= np.median(level[land]))
    red, green, blue = np.moveaxis(light[bright], -1, 0)
    fall = np.log2(np.median(level[land]) / np.median(level[sky]))
    return np.array([fall, np.median(np.log2(red / green)), np.median(np.log2(blue / green))])


def analyzed(path: Path) -> sw.Scene:
    """Return the scene of a photo's small copy."""
    return sw.analyze(open_photo(sw.open(path).preview(SIDE)))


def measured(scene: sw.Scene, edit: sw.Edit) -> tuple[np.ndarray, np.ndarray]:
    """Return ``profile`` and ``of_land`` of an edit."""
    picture = sw.render(scene, edit)[..., :3]
    return profile(picture, scene), of_land(picture, scene)


def show(name: str, found: list[tuple[np.ndarray, np.ndarray]]) -> None:
    """Print the medians."""
    profiles, lands = zip(*found, strict=True)
    print(f"{name}, {len(found)}")
    print("  land over sky, red/green, blue/green", np.nanmedian(lands, 0).round(2))
    for label, values in zip(
        ("luminance", "red/green", "blue/green"), np.nanmedian(profiles, 0).T, strict=True
    ):
        print(f"  {label:10}", np.round(values, 2))


def main() -> None:
    options = arguments(__doc__)
    real = []
    for name in PHOTOS.read_text("utf-8").split():
        folder, file = name.split("/")
        scene = analyzed(options.data / "train" / folder / "images" / file)
        real.append(measured(scene, sw.Edit()))
    show("photos of dusk", real)
    ours, day = [], []
    for _, path in photos(options.data, False, options.photos):
        scene = analyzed(path)
        if abs(scene.automatic["sun_azimuth"]) < AHEAD:
            ours.append(measured(scene, sw.Edit(sun_elevation=-4)))
        if scene.automatic["sun_elevation"] > HIGH:
            day.append(measured(scene, sw.Edit()))
    show("edits", ours)
    show("photos of day", day)


if __name__ == "__main__":
    main()
