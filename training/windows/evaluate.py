"""How well the shipped network sees windows: in streets, and on photos that show none.

``python -m training.windows.evaluate --data ../shared/data/train --facades ../facades``

Backgrounds, photos and photographed façades are those held out of the training. Figures are of what
the network sees and of the trapezia that are lit.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from sunwidget.analysis.networks.onnx_file import bundled_session
from sunwidget.analysis.windows import shapes as window_shapes
from sunwidget.analysis.windows.panes import BUNDLED, lamps, look
from sunwidget.photo.photo import open_photo
from training.windows.data import SIDE, Batches, held_out, natural, seen
from training.windows.draw import LAYERS, OPENING, OPENING_UNKNOWN, corners, light, set_up
from training.windows.facades import Facades, names

SEED = 20261124
View = tuple[np.ndarray, np.ndarray]


def drawn(batches: Batches, count: int) -> Iterator[View]:
    """Drawn streets, (S, S, 3) uint8, and what is known of them, (S, S, 4)."""
    random = np.random.default_rng(SEED)
    for _ in range(count):
        yield batches.sample(random)


def photographed(batches: Batches, real: Facades, count: int) -> Iterator[View]:
    """One or two photographed façades before nature, alike."""
    random = np.random.default_rng(SEED)
    for _ in range(count):
        canvas = batches.part(random).astype(np.float32)
        target = np.zeros((SIDE, SIDE, LAYERS), np.float32)
        for _ in range(int(random.integers(1, 3))):
            quad = corners(SIDE, random).astype(np.float32)
            picture, known, solid = real.wall(quad, random)
            wall = picture * light(random, picture.shape[:2]), known, solid
            set_up(canvas, target, wall, quad, random)
        yield seen(np.clip(canvas, 0, 255).astype(np.uint8), np.clip(target, 0, 1), random)


def overlaps(views: Iterator[View]) -> np.ndarray:
    """Pooled IoU, precision and recall of windows, of the network's pixels and of trapezia."""
    session = bundled_session(BUNDLED, "windows")
    counts = np.zeros((2, 4))
    for image, known in views:
        picture = (image / np.float32(255)).transpose(2, 0, 1)[None]
        out = session.run(["window"], {"image": np.ascontiguousarray(picture)})[0][0, 0]
        windows, wall = window_shapes.find(out)
        shapes = wall.astype(np.float32)
        for window in windows:
            quad = window_shapes.corners(window)
            shapes = np.maximum(shapes, window_shapes.filled(quad, wall.shape))
        sure, true = known[..., OPENING_UNKNOWN] < 0.1, known[..., OPENING] > 0.5
        for count, found in zip(counts, (out > 0.5, shapes > 0.5), strict=True):
            both, either = found & true & sure, (found | true) & sure
            count += [n.sum() for n in (both, either, found & sure, true & sure)]
    both, either, found, true = counts.T
    return np.stack([both / either, both / found, both / true], 1)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    parser.add_argument("--facades", type=Path)
    parser.add_argument("--streets", type=int, default=400)
    options = parser.parse_args()
    photos = [p for p in natural(options.data) if held_out(p)]
    batches = Batches(photos, 1, 0)
    views = {"drawn streets": drawn(batches, options.streets)}
    if options.facades is not None:
        real = Facades(options.facades, names(options.facades)[1])
        views["photographed façades"] = photographed(batches, real, options.streets)
    for name, some in views.items():
        for what, scores in zip(("network", "trapezia"), overlaps(some), strict=True):
            print(f"{name}, {what}: IoU %.3f, precision %.3f, recall %.3f" % tuple(scores))
    lit = np.array([(lamps(look(open_photo(p)))[..., 0] > 0).mean() for p in photos])
    print(
        f"{lit.size} photos of nature: {(lit > 0).sum()} with a lit place, "
        f"{(lit > 0.001).sum()} with more than a thousandth, {lit.mean():.5%} of all pixels"
    )
    for share, path in sorted(zip(lit, photos, strict=True), reverse=True)[:12]:
        print(f"  {share:.3%}  {path.name}")


if __name__ == "__main__":
    main()
