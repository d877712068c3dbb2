"""Measure hues and texture of photos of a low sun (sky/low_sun.glsl, sky/relit_sky.glsl).

    python -m training.skies.hues DATA [--photos 100]

prints, for photos of the training half whose sun is seen less than 0.13 widths above the skyline
and for edits of photos by day whose sun is moved to 3 and to 12 degrees: the median of log2 of red
over green by that of blue over green, in the sky and in the land; and how much the sky's
luminance, red over green and blue over green (log2) deviate from their surroundings.
"""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.formats.color import LUMINANCE, srgb_to_linear
from training.skies.dusk import HIGH
from training.skies.low_sun import arguments, edited, photos, seen_suns, small

WIDTH = 48
LOW = (-0.03, 0.13)  # widths above the skyline
BLUES = np.arange(-1.8, 1.3, 0.6)
REACH = 5  # pixels: a tenth of the width
FEWEST = 60  # pixels of a region
FLOOR = 2e-3
RANGE = (0.01, 0.9)  # luminance that is neither noise nor clipped
SUNS = {"3 degrees": (8.0, 3.0), "12 degrees": (-20.0, 12.0)}
NOTHING = np.empty((0, 3))


class Measures(NamedTuple):
    """Of one picture: colors of sky and of land, and the sky's deviations."""

    sky: np.ndarray  # (n, 3): red over green, blue over green (log2), weight
    land: np.ndarray
    deviations: np.ndarray  # (3,) of luminance, red and blue over green; NaN without sky


def measured(picture: np.ndarray, sky: np.ndarray) -> Measures:
    """Measure a picture (RGB) with the matte of its sky, 0 to 255."""
    light = srgb_to_linear(small(picture, WIDTH) / 255.0)
    sky = small(sky, WIDTH)
    level = light @ LUMINANCE
    red, green, blue = np.moveaxis(light + FLOOR, -1, 0)
    logs = np.log2(np.stack([level + FLOOR, red / green, blue / green], -1))
    known = (level > RANGE[0]) & (level < RANGE[1])
    above, below = known & (sky > 242), known & (sky < 5)
    deviations = texture(logs, above) if above.sum() >= FEWEST else np.full(3, np.nan)
    return Measures(colors(logs, above), colors(logs, below), deviations)


def colors(logs: np.ndarray, here: np.ndarray) -> np.ndarray:
    """Return colors with weights, (n, 3): every picture counts alike."""
    count = here.sum()
    return np.insert(logs[here][:, 1:], 2, 1 / count, axis=1) if count >= FEWEST else NOTHING


def texture(logs: np.ndarray, here: np.ndarray) -> np.ndarray:
    """Return deviations from the surroundings, (3,)."""
    weight = here.astype(float)
    blurred = cv2.GaussianBlur(logs * weight[..., None], (0, 0), REACH)
    around = blurred / np.maximum(cv2.GaussianBlur(weight, (0, 0), REACH), 1e-6)[..., None]
    return (logs - around)[here].std(0)


def middle(values: np.ndarray, weight: np.ndarray, here: np.ndarray) -> float:
    """Return the weighted median of some values."""
    if not here.any():
        return float("nan")
    order = np.argsort(values[here])
    summed = np.cumsum(weight[here][order])
    return round(float(values[here][order][np.searchsorted(summed, summed[-1] / 2)]), 2)


def show(name: str, found: list[Measures]) -> None:
    """Print the medians."""
    print(f"{name}, {len(found)}")
    deviations = np.nanmedian([each.deviations for each in found], 0)
    print("  deviations of luminance, red, blue", deviations.round(2))
    print("  blue over green", BLUES.round(1))
    for region in ("sky", "land"):
        red, blue, weight = np.concatenate([getattr(each, region) for each in found]).T
        row = [middle(red, weight, abs(blue - b) < 0.3) for b in BLUES]
        print(f"  red over green, {region:4}", np.array(row))


def main() -> None:
    """Print the measures of photos and of edits."""
    asked = arguments(__doc__)
    suns = seen_suns(asked.data)
    low = [measured(p, sky) for height, p, sky, _ in suns if LOW[0] <= height < LOW[1]]
    show("photos of a low sun", low)
    edits: dict[str, list[Measures]] = {name: [] for name in SUNS}
    for _, path in photos(asked.data, False, asked.photos):
        scene = sw.analyze(sw.open(path))
        if scene.automatic["sun_elevation"] <= HIGH:
            continue
        sky = np.uint8(255 * np.asarray(scene.sky))
        for name, sun in SUNS.items():
            edits[name].append(measured(edited(scene, sun), sky))
    for name, found in edits.items():
        show(f"edits, {name}", found)


if __name__ == "__main__":
    main()
