"""Score every cloud method against labeled skies: a table on stdout.

usage: python bench/clouds.py DIR [--limit N]

DIR holds images/ and masks/ (255 = cloud, 0 = clear, values between are ignored), like the HYTA set
of Li et al. 2011. Each photo is analyzed once, and each method then detects its clouds, as in the
editor; a pixel counts as cloud from opacity 0.5. Pooled over all photos.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.analysis import correct
from sunwidget.analysis.clouds.clouds import METHODS


def score(folder: Path, limit: int | None) -> dict[str, tuple[float, float, float]]:
    """Return the clouds' IoU, accuracy, and the share of detected sky in the photo, by method."""
    counts = {name: np.zeros(5) for name in METHODS}
    for path in sorted((folder / "images").iterdir())[:limit]:
        mask = cv2.imread(str(folder / "masks" / f"{path.stem}.png"), cv2.IMREAD_GRAYSCALE)
        cloud, known = mask > 191, (mask > 191) | (mask < 64)
        scene = sw.analyze(path)
        for name in METHODS:
            opacity = correct.corrected(scene, sw.Edit(cloud_method=name)).clouds
            found = cv2.resize(opacity, mask.shape[::-1], interpolation=cv2.INTER_LINEAR) > 0.5
            both, either = found & cloud & known, (found | cloud) & known
            wrong = (found != cloud) & known
            counts[name] += (both.sum(), either.sum(), wrong.sum(), known.sum(), scene.sky.mean())
    photos = len(list((folder / "images").iterdir())[:limit])
    return {
        name: (float(c[0] / c[1]), float(1 - c[2] / c[3]), float(c[4] / photos))
        for name, c in counts.items()
    }


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--limit", type=int)
    options = parser.parse_args()
    print(f"{'method':<14} {'IoU':>6} {'accuracy':>9} {'sky':>6}")
    for name, (iou, accuracy, sky) in score(options.folder, options.limit).items():
        print(f"{name:<14} {iou:6.3f} {accuracy:9.3f} {sky:6.3f}")


if __name__ == "__main__":
    main()
