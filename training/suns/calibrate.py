"""Fits ``WEIGHTS`` and ``RADIUS_SCALE`` of sunwidget/analysis/sun/search.py.

``python -m training.suns.calibrate --data ../shared/data/train`` fits them on every second of the
labelled photos that only judge, and measures them on the others: a network is too sure of photos
that it was trained on. A sun's glow is left out unless the likeliest place is off it, when there is
no sun.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.sun import look_for_sun
from sunwidget.analysis.sun.search import LEAST_CONFIDENCE, features_of, peak_of
from sunwidget.photo.photo import open_photo
from training.suns.labels import Photo, labels

RIDGE = 0.01
PARTS = {"fitted on": slice(0, None, 2), "judging": slice(1, None, 2)}


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


@dataclass
class Seen:
    """What the network says of one photo: features, and whether the likeliest place is right."""

    photo: Photo
    sun: np.ndarray
    near_sun: bool
    near_glow: bool  # of a glow, the likeliest sun
    size: float  # the label's radius over the network's


def look(photo: Photo, data: Path) -> Seen:
    """Look at one labelled photo."""
    folder, name = photo.file.split("/")
    working = Working.of(open_photo(data / folder / "images" / name))
    maps = look_for_sun(working)
    peak = peak_of(maps, working)
    off = miss(photo, peak.x, peak.y, working)
    is_glow = photo.kind == "glow"
    return Seen(
        photo,
        features_of(maps),
        near(photo, off),
        is_glow and off <= 0.06,
        photo.r / float(maps.radius.flat[maps.probability.argmax()]),
    )


def odds(weights: np.ndarray, features: np.ndarray) -> np.ndarray:
    """Log odds by the weights of a logistic regression."""
    return np.asarray(weights[0] + features @ weights[1:])


def fit_suns(photos: list[Seen]) -> None:
    """Print the weights of a sun's confidence and the scale of its radius, and what they find."""
    x, truth = np.array([p.sun for p in photos]), np.array([p.near_sun for p in photos])
    glow = np.array([p.near_glow for p in photos])
    disc = np.array([p.photo.kind == "disc" for p in photos])
    weights = fit(x[::2][~glow[::2]], truth[::2][~glow[::2]].astype(float))
    print("WEIGHTS =", tuple(float(w) for w in weights.round(3)))
    sizes = [p.size for p in photos[::2] if p.near_sun]
    print("RADIUS_SCALE =", round(float(np.median(sizes)), 3))
    for least in (0.3, LEAST_CONFIDENCE, 0.6):
        found = odds(weights, x) > np.log(least / (1 - least))
        for name, part in PARTS.items():
            said, right = found[part], (truth | glow)[part]
            recall = (said & truth[part])[disc[part]].mean()
            print(f"{least}, {name}: recall {recall:.3f}, precision {right[said].mean():.3f}")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    options = parser.parse_args()
    cv2.setNumThreads(1)
    photos = [look(p, options.data) for p in labels() if p.test and p.kind != "drop"]
    fit_suns(photos)


if __name__ == "__main__":
    main()
