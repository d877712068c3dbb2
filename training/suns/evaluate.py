"""How well the shipped network finds suns (recall, precision, place and size) and water.

``python -m training.suns.evaluate --data ../shared/data/train [--train] [--misses]`` looks at the
labelled photos that only judge (``--train``: at the others), without the rest of the analysis.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.sun import look_for_sun
from sunwidget.analysis.sun.search import LEAST_CONFIDENCE, Peak, peak_of
from sunwidget.photo.photo import open_photo
from training.suns.calibrate import miss, near
from training.suns.labels import Photo, labels
from training.suns.water import UNKNOWN, outlines, water_map

WET = 0.005  # of a picture's known pixels, from which it has water


@dataclass
class Result:
    """What the network says of one photo."""

    photo: Photo
    peak: Peak
    off: float  # widths
    size: float  # radius over the label's
    water: tuple[float, float, float] | None  # where it is outlined, see ``water_of``

    @property
    def right(self) -> bool:
        """Whether the likeliest place is the sun's, or near enough to a glow's."""
        return near(self.photo, self.off) or (self.photo.kind == "glow" and self.off <= 0.06)


def look(photo: Photo, data: Path) -> Result:
    """Look at one labelled photo."""
    folder, name = photo.file.split("/")
    working = Working.of(open_photo(data / folder / "images" / name))
    maps = look_for_sun(working)
    peak = peak_of(maps, working)
    off = miss(photo, peak.x, peak.y, working)
    size = peak.radius / working.width / photo.r
    mask = data / folder / "masks" / f"{Path(name).stem}.png"
    water = water_of(photo, maps.water, mask) if photo.file in outlines() else None
    return Result(photo, peak, off, size, water)


def water_of(photo: Photo, probability: np.ndarray, mask: Path) -> tuple[float, float, float]:
    """Shares of the known pixels: outlined water, water found, and both at once."""
    sky = cv2.imread(str(mask), cv2.IMREAD_GRAYSCALE)
    size = probability.shape[::-1]
    truth = cv2.resize(water_map(photo.file, sky), size, interpolation=cv2.INTER_NEAREST)
    known = truth != UNKNOWN
    land = cv2.resize(sky, size, interpolation=cv2.INTER_AREA) < 128
    wet, found = truth[known] == 255, ((probability > 0.5) & land)[known]
    return float(wet.mean()), float(found.mean()), float((wet & found).mean())


def tell_of_water(shares: np.ndarray) -> None:
    """Print how well outlined water is found; ``shares`` (n, 3) are those of ``water_of``."""
    outlined, found, both = shares.T
    wet = outlined > WET
    overlap = both[wet] / (outlined + found - both)[wet]
    print(
        f"water in {wet.sum()} photos: IoU {overlap.mean():.3f} (mean), {np.median(overlap):.3f} "
        f"(median), above .7 in {np.mean(overlap > 0.7):.0%}; "
        f"of {(~wet).sum()} without, {np.mean(found[~wet] > 0.01):.0%} have some"
    )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    parser.add_argument("--train", action="store_true", help="the photos that were trained on")
    parser.add_argument("--misses", action="store_true", help="name what went wrong")
    options = parser.parse_args()
    cv2.setNumThreads(1)
    judged = [p for p in labels() if p.test != options.train and p.kind != "drop"]
    results = [look(photo, options.data) for photo in judged]
    discs = [r for r in results if r.photo.kind == "disc"]
    for least in (0.3, LEAST_CONFIDENCE, 0.6, 0.7, 0.8):
        found = [r for r in results if r.peak.confidence >= least]
        recall = np.mean([r.right and r.peak.confidence >= least for r in discs])
        precision = np.mean([r.right for r in found]) if found else np.nan
        print(
            f"{least:.2f}: recall {recall:.3f} of {len(discs)} discs, "
            f"precision {precision:.3f} of {len(found)} found in {len(results)} photos"
        )
    hit = [r for r in discs if r.right]
    off = np.array([r.off / r.photo.r for r in hit])
    size = np.array([r.size for r in hit])
    print(
        f"centre off by {np.median(off):.2f} radii (median), {np.mean(off < 0.5):.0%} within half"
    )
    print(f"radius over label {np.quantile(size, [0.1, 0.5, 0.9]).round(2)} (deciles, median)")
    limb = np.array([r.peak.sharpness > 0.6 for r in hit])
    within = np.mean(np.abs(size[limb] - 1) < 0.2)
    print(f"of {limb.sum()} taken for discs with a limb {within:.0%} within a fifth")
    tell_of_water(np.array([r.water for r in results if r.water is not None]))
    if options.misses:
        for r in results:
            said = r.peak.confidence >= LEAST_CONFIDENCE
            if (r.photo.kind == "disc" and not (said and r.right)) or (said and not r.right):
                print(r.photo.file, r.photo.kind, f"{r.peak.confidence:.2f}, off by {r.off:.3f}")


if __name__ == "__main__":
    main()
