"""How well the shipped network finds suns: recall, precision, place and size.

``python -m training.suns.evaluate --data ../shared/data/train [--train]`` looks at the labelled
photos that only judge (``--train``: at the others), whole, without any other part of the analysis.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np

from sunwidget.analysis.sun_network import look_for_sun
from sunwidget.analysis.sun_search import peak_of
from sunwidget.analysis.working import Working
from sunwidget.photo import open_photo
from training.suns.labels import Photo, labels


def miss(photo: Photo, x: float, y: float, aspect: float) -> float:
    """Distance from the label in widths; ``aspect`` height over width."""
    return float(np.hypot(x - photo.x, (y - photo.y) * aspect))


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    parser.add_argument("--train", action="store_true", help="the photos that were trained on")
    parser.add_argument("--misses", action="store_true", help="name what went wrong")
    options = parser.parse_args()
    cv2.setNumThreads(1)
    rows = []
    for photo in labels():
        if photo.test == options.train or photo.kind == "drop":
            continue
        folder, name = photo.file.split("/")
        working = Working.of(open_photo(options.data / folder / "images" / name))
        found = peak_of(look_for_sun(working), working)
        off = miss(
            photo, found.x / working.width, found.y / working.height, working.height / working.width
        )
        rows.append((photo, found, off, found.radius / working.width))
    for limit in (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7):
        taken = [r for r in rows if r[1].confidence >= limit]
        suns = [r for r in rows if r[0].kind == "disc"]
        near = lambda r: r[2] <= max(1.5 * r[0].r, 0.02)  # noqa: E731
        hit = [r for r in suns if r[1].confidence >= limit and near(r)]
        right = [
            r for r in taken if (r[0].is_sun and near(r)) or (r[0].kind == "glow" and r[2] <= 0.06)
        ]
        print(
            f"{limit:.2f}: recall {len(hit) / len(suns):.3f} of {len(suns)}, "
            f"precision {len(right) / max(len(taken), 1):.3f} of {len(taken)}"
        )
    hit = [r for r in rows if r[0].kind == "disc" and r[2] <= max(1.5 * r[0].r, 0.02)]
    off = np.array([r[2] / r[0].r for r in hit])
    size = np.array([r[3] / r[0].r for r in hit])
    print(
        f"centre off, in radii: median {np.median(off):.2f}, within half {np.mean(off < 0.5):.2f}; "
        f"radius over label: {np.quantile(size, [0.1, 0.5, 0.9]).round(2)}, within 20 %: {np.mean(np.abs(np.log(size)) < np.log(1.2)):.2f}"
    )
    if options.misses:
        for photo, found, off_, _ in sorted(rows, key=lambda r: r[1].confidence):
            lost = photo.kind == "disc" and (
                found.confidence < 0.4 or off_ > max(1.5 * photo.r, 0.02)
            )
            false = (
                not photo.is_sun
                and found.confidence >= 0.4
                and not (photo.kind == "glow" and off_ <= 0.06)
            )
            if lost or false:
                print(
                    "lost " if lost else "false",
                    photo.file,
                    photo.kind,
                    f"{found.confidence:.2f} off {off_:.3f} r {photo.r}",
                )


if __name__ == "__main__":
    main()
