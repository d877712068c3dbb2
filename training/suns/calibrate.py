"""Fits ``WEIGHTS`` and ``RADIUS_SCALE`` of sunwidget/analysis/sun/search.py, and prints them.

``python -m training.suns.calibrate --data ../shared/data/train``

On the labelled photos that were trained on; those that only judge are not looked at. A glow is left
out unless the likeliest place is off it, when there is no sun.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.sun import look_for_sun
from sunwidget.analysis.sun.search import features_of, peak_of
from sunwidget.photo.photo import open_photo
from training.suns.labels import Photo, labels

RIDGE = 0.01
EVERY_NONE = 2  # of the many photos without a sun


def miss(photo: Photo, x: float, y: float, working: Working) -> float:
    """Distance of a place (working pixels) from the label, in widths."""
    aspect = working.height / working.width
    return float(np.hypot(x / working.width - photo.x, (y / working.height - photo.y) * aspect))


def near(photo: Photo, off: float) -> bool:
    """Whether a place counts as the labelled sun's."""
    return photo.is_sun and off <= max(1.5 * photo.r, 0.02)


def fit(features: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Weights of a logistic regression, the bias first (Newton's method)."""
    mean, deviation = features.mean(0), features.std(0)
    x = np.column_stack([np.ones(len(features)), (features - mean) / deviation])
    w = np.zeros(x.shape[1])
    for _ in range(50):
        q = 1 / (1 + np.exp(-x @ w))
        hessian = x.T @ (x * (q * (1 - q))[:, None]) + RIDGE * np.eye(len(w))
        w += np.linalg.solve(hessian, x.T @ (truth - q) - RIDGE * w)
    slopes = w[1:] / deviation
    return np.array([w[0] - slopes @ mean, *slopes])


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    options = parser.parse_args()
    cv2.setNumThreads(1)
    trained = [p for p in labels() if not p.test and p.kind != "drop"]
    nones = [p for p in trained if p.kind == "none"][::EVERY_NONE]
    features, truth, sizes = [], [], []
    for photo in [p for p in trained if p.kind != "none"] + nones:
        folder, name = photo.file.split("/")
        working = Working.of(open_photo(options.data / folder / "images" / name))
        maps = look_for_sun(working)
        peak = peak_of(maps, working)
        off = miss(photo, peak.x, peak.y, working)
        if photo.kind == "glow" and off <= 0.06:
            continue
        features.append(features_of(maps))
        truth.append(near(photo, off))
        if truth[-1]:
            row, column = np.unravel_index(int(maps.probability.argmax()), maps.probability.shape)
            sizes.append(photo.r / maps.radius[row, column])
    weights = fit(np.array(features), np.array(truth, float))
    print("WEIGHTS =", tuple(float(w) for w in weights.round(3)))
    print("RADIUS_SCALE =", round(float(np.median(sizes)), 3))


if __name__ == "__main__":
    main()
