"""Fits weights of networks for water, and prints them and what ``WEIGHTS`` are worth.

``WEIGHTS`` is in sunwidget/analysis/water/water.py.

``python -m training.land.calibrate_water --data ../shared/data/train --worlds build/valid``

On outlined photos whose water the sky network never saw, half of them by name; the rest judges.
Worlds that trained nothing have a say, or plain ground such as no photo shows would be taken for
water. ``WEIGHTS`` give the land network more than the fit does: renders of other make than our
worlds need it, and photos lose next to nothing. Water that fills less than ``LEAST`` of a photo
counts as none.
"""

from __future__ import annotations

import argparse
import hashlib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.analysis.images.working_copy import Working, log_odds, resize
from sunwidget.analysis.networks.land import look_at_land
from sunwidget.analysis.networks.sky import look_at_sky
from sunwidget.analysis.networks.sun import look_for_sun
from sunwidget.analysis.water import water
from sunwidget.photo.photo import open_photo
from training.data import held_out
from training.land.data import WATER, sample
from training.suns.calibrate import fit
from training.suns.labels import judging
from training.suns.water import UNKNOWN, outlines, water_map

LEAST = 0.01
PIXELS = 200  # of a photo
WORLDS_PIXELS = 60  # of a picture of a world


class Known(NamedTuple):
    """What the networks say of a picture (3, h, w), and what is known of it (h, w)."""

    seen: np.ndarray
    truth: np.ndarray


class Case(NamedTuple):
    """A photo, and what the product finds in it: found and true water (2, h, w) bool."""

    known: Known
    found: np.ndarray
    judges: bool


def judges(file: str) -> bool:
    return hashlib.sha256(f"water {file}".encode()).digest()[0] % 2 == 1


def look(working: Working) -> np.ndarray:
    """Return the water of the networks of suns, sky and land, at the size of the first."""
    seen = look_for_sun(working).water
    size = seen.shape[1], seen.shape[0]
    others = (resize(find(working).water, *size) for find in (look_at_sky, look_at_land))
    return np.stack([seen, *others])


def case(file: str, path: Path) -> Case:
    scene = sw.analyze(path)
    seen = look(scene.working)
    size = seen.shape[2], seen.shape[1]
    truth = water_map(file, np.rint(scene.small_sky * 255).astype(np.uint8))
    known = cv2.resize(truth, size, interpolation=cv2.INTER_NEAREST)
    known[resize(scene.small_sky, *size) > 0.5] = UNKNOWN
    found = resize(scene.water, *truth.shape[::-1]) > 0.5
    used = truth != UNKNOWN
    masks = np.stack([found & used, (truth == 255) & used])
    return Case(Known(seen, known), masks, judges(file))


def of_worlds(folder: Path) -> Iterator[Known]:
    """Yield two pictures of each world."""
    random = np.random.default_rng(3)
    for path in sorted(folder.glob("*.npz")):
        with np.load(path) as stored:
            world = dict(stored)
        for _ in range(2):
            rows, columns = (2 * side // 32 * 32 for side in world["depth"].shape)
            picture = sample(world, rows, columns, random)
            image = np.ascontiguousarray(picture["image"].transpose(1, 2, 0))
            seen = look(Working.of(open_photo(image)))
            size = seen.shape[2], seen.shape[1]
            matter = picture["matter"].astype(np.uint8)
            matter = cv2.resize(matter, size, interpolation=cv2.INTER_NEAREST)
            truth = np.where(matter == WATER, 255, np.where(matter == 0, UNKNOWN, 0))
            yield Known(seen, truth.astype(np.uint8))


def pixels(
    cases: Iterable[Known], count: int, random: np.random.Generator
) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Return log odds and truth of a number of known pixels of each case."""
    features, truth = [], []
    for one in cases:
        known = np.flatnonzero(one.truth != UNKNOWN)
        if known.size:
            at = random.choice(known, count)
            features.append(log_odds(one.seen.reshape(3, -1)[:, at]).T)
            truth.append(one.truth.flat[at] == 255)
    return features, truth


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    parser.add_argument("--worlds", type=Path, required=True)
    options = parser.parse_args()
    cases = []
    for file in sorted(outlines()):
        folder, name = file.split("/")
        path = options.data / folder / "images" / name
        if path.exists() and (file in judging() or held_out(folder, path.stem)):
            cases.append(case(file, path))
    random = np.random.default_rng(1)
    fitted = pixels((c.known for c in cases if not c.judges), PIXELS, random)
    drawn = pixels(of_worlds(options.worlds), WORLDS_PIXELS, random)
    features, truth = (one + other for one, other in zip(fitted, drawn, strict=True))
    print("weights", np.round(fit(np.concatenate(features), np.concatenate(truth)), 2))
    for name, part in (("fitted on", False), ("judging", True)):
        pairs = [c.found for c in cases if c.judges == part]
        wet = [(f & t).sum() / (f | t).sum() for f, t in pairs if t.mean() > LEAST]
        dry = [f.mean() > LEAST / 2 for f, t in pairs if t.mean() <= LEAST]
        lost, wrong = np.mean(np.array(wet) < 0.05), np.mean(dry)
        print(
            f"{name}: with water {len(wet)}, IoU {np.mean(wet):.3f}, missed {lost:.2f}; "
            f"without {len(dry)}, of which {wrong:.3f} get some"
        )
    print(f"now {water.WEIGHTS}")


if __name__ == "__main__":
    main()
