"""Fits ``WEIGHTS`` of segmentation/patches.py, and prints them and what they are worth.

``python -m training.calibrate_patches --data ../shared/data/train --test ../shared/data/eval``

On the photos that trained neither network; what ``--test`` holds judges. What refinement says of a
patch stands unless the odds against it are more than ``MARGIN``.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.segmentation import coarse_sky, patches, refine
from sunwidget.photo.photo import open_photo
from training.data import FOLDERS, held_out
from training.suns.calibrate import fit

MARGIN = 0.4  # log odds
KNOWN = 0.3  # of a patch


class Patch(NamedTuple):
    """A piece of a refined mask: its features, its share of the picture, and its true class."""

    features: np.ndarray
    area: float
    was_sky: bool
    is_sky: bool


def of_photo(image: Path, mask: Path) -> Iterator[Patch]:
    """Yield the patches of a photo of which most is known."""
    working = Working.of(open_photo(image))
    coarse = coarse_sky.network(working)
    found = refine.grabcut_mask(working, coarse).sky
    labels, was_sky = patches.find(found)
    if not was_sky.size:
        return
    features = patches.features(labels, found, was_sky, coarse, working)
    truth = cv2.imread(str(mask), cv2.IMREAD_GRAYSCALE)
    truth = cv2.resize(truth, found.shape[::-1], interpolation=cv2.INTER_NEAREST)
    for number, said in enumerate(was_sky):
        inside = truth[labels == number + 1]
        known = inside[(inside > 200) | (inside < 60)]
        if known.size >= KNOWN * inside.size:
            yield Patch(
                features[number], inside.size / truth.size, said, (known > 127).mean() > 0.5
            )


def of_folder(folder: Path, names: set[str] | None = None) -> list[Patch]:
    """Return the patches of the photos of a folder, or of those of these names."""
    found = []
    for image in sorted((folder / "images").iterdir()):
        mask = folder / "masks" / f"{image.stem}.png"
        if mask.exists() and (names is None or image.stem in names):
            found += of_photo(image, mask)
    return found


def report(name: str, known: list[Patch], weights: np.ndarray) -> None:
    """Print how many patches are wrong before and after, and what part of a picture they fill."""
    seen, area, was, true = (np.array(part) for part in zip(*known, strict=True))
    now = weights[0] + seen @ weights[1:] > 0
    print(
        f"{name}: {len(known)} patches; wrong {np.sum(was != true)} ({area[was != true].sum():.3f})"
        f" -> {np.sum(now != true)} ({area[now != true].sum():.3f})"
    )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    parser.add_argument("--test", type=Path, default=Path("../shared/data/eval"))
    options = parser.parse_args()
    known: list[Patch] = []
    for folder in FOLDERS:
        images = (options.data / folder / "images").iterdir()
        names = {path.stem for path in images if held_out(folder, path.stem)}
        known += of_folder(options.data / folder, names)
    weights = fit(np.array([p.features for p in known]), np.array([p.is_sky for p in known]))
    weights[0] -= MARGIN
    weights[3] += 2 * MARGIN
    print("weights", np.round(weights, 2), "now", patches.WEIGHTS)
    report("fitted on", known, weights)
    for folder in sorted(options.test.iterdir()):
        judging = of_folder(folder) if (folder / "masks").exists() else []
        if judging:
            report(folder.name, judging, weights)


if __name__ == "__main__":
    main()
