"""Fits ``WEIGHTS`` of sunwidget/analysis/water.py, and prints them and what they are worth.

``python -m training.land.calibrate_water --data ../shared/data/train``

On outlined photos that one of the two networks never saw, half of them by name; the rest judges.
Water that fills less than ``LEAST`` of a photo counts as none.
"""

from __future__ import annotations

import argparse
import hashlib
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.analysis import water
from sunwidget.analysis.land_network import look_at_land
from sunwidget.analysis.sun_network import look_for_sun
from sunwidget.analysis.working import Working, resize
from training.data import held_out
from training.suns.calibrate import fit
from training.suns.labels import labels
from training.suns.water import UNKNOWN, outlines, water_map

LEAST = 0.01
PIXELS = 200  # of a photo


class Case(NamedTuple):
    """A photo: what the networks say, what is known, and what the product finds."""

    seen: np.ndarray
    land: np.ndarray
    truth: np.ndarray
    found: np.ndarray
    judges: bool


def judges(file: str) -> bool:
    return hashlib.sha256(f"water {file}".encode()).digest()[0] % 2 == 1


def case(file: str, path: Path) -> Case:
    scene = sw.analyze(path)
    working: Working = scene.working
    seen = look_for_sun(working).water
    size = seen.shape[1], seen.shape[0]
    truth = water_map(file, np.rint(scene.small_sky * 255).astype(np.uint8))
    known = cv2.resize(truth, size, interpolation=cv2.INTER_NEAREST)
    known[resize(scene.small_sky, *size) > 0.5] = UNKNOWN
    land = resize(look_at_land(working).water, *size)
    found = resize(scene.water, *truth.shape[::-1]) > 0.5
    used = truth != UNKNOWN
    return Case(seen, land, known, np.stack([found & used, (truth == 255) & used]), judges(file))


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    options = parser.parse_args()
    tests = {photo.file for photo in labels() if photo.test}
    cases = []
    for file in sorted(outlines()):
        folder, name = file.split("/")
        path = options.data / folder / "images" / name
        if path.exists() and (file in tests or held_out(folder, path.stem)):
            cases.append(case(file, path))
    random = np.random.default_rng(1)
    features, truth = [], []
    for one in (c for c in cases if not c.judges):
        known = np.flatnonzero(one.truth != UNKNOWN)
        if known.size:
            at = random.choice(known, PIXELS)
            features.append(np.log([(p.flat[at] + 1e-3) / (1.001 - p.flat[at]) for p in one[:2]]).T)
            truth.append(one.truth.flat[at] == 255)
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
