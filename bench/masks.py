"""Count skies and waters that the analysis gets wrong, on photos whose masks were corrected by eye.

usage: python bench/masks.py ../shared/data/train [--every 4] [--to NEW.json] [--from OLD.json]

The photos are those of ``training/sky_judged.csv`` and ``training/suns/water_judged.csv``, which
train no network of this repository from November 2026 on. Wrong places narrower than 1.5 % of the
width do not count: outlines drawn by eye are not more exact, and the eyes saw the masks of that
month. ``--from`` names the figures of another version, and lists the photos that differ.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import cv2
import numpy as np

import sunwidget as sw
from training.sky_corrections import JUDGED, corrected, corrections
from training.suns.water import JUDGED as JUDGED_WATER
from training.suns.water import outlines, water_map

WIDTH = 480  # pixels of the compared masks
NARROWEST = 7  # of them
DIFFERS = 0.002  # of the picture
WRONG = (0.003, 0.01)


def wrong_share(matte: np.ndarray, mask: np.ndarray) -> float:
    """Return the share of the picture that is wrong.

    Parameters
    ----------
    matte : (h, w) float32
        What is judged, 1 = sky or water.
    mask : (H, W) uint8
        What is true: 255 sky or water, 0 neither, 128 unknown.
    """
    size = WIDTH, max(1, round(WIDTH * mask.shape[0] / mask.shape[1]))
    mask = cv2.resize(mask, size, interpolation=cv2.INTER_NEAREST)
    found = cv2.resize(matte.astype(np.float32), size) > 0.5
    wrong = ((found & (mask < 64)) | (~found & (mask > 191))).astype(np.uint8)
    round_ = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (NARROWEST, NARROWEST))
    return float(cv2.morphologyEx(wrong, cv2.MORPH_OPEN, round_).mean())


def judge(root: Path, file: str) -> dict[str, float]:
    """Return wrong shares of a photo, ``folder/name.jpg`` below ``root``: what is known of two."""
    folder, name = file.split("/")
    path = root / folder / "masks" / f"{Path(name).stem}.png"
    mask = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
    if mask is None:
        raise SystemExit(f"{path} is missing.")
    scene, found = sw.analyze(root / folder / "images" / name), {}
    sky = corrected(file, mask)
    if file in corrections(JUDGED):
        found["sky"] = wrong_share(scene.small_sky, sky)
    if file in outlines(JUDGED_WATER):
        found["water"] = wrong_share(scene.small_water, water_map(file, sky, JUDGED_WATER))
    return found


def report(what: str, found: dict[str, float], old: dict[str, float]) -> None:
    """Print how many photos are wrong, and which differ from former figures."""
    shares = np.array(list(found.values()))
    counts = ", ".join(f"{(shares > least).sum()} by more than {least:.1%}" for least in WRONG)
    print(f"{what}, {len(shares)} photos: {shares.mean():.2%} of the pixels wrong; {counts}")
    for name, sign in (("better", -1), ("worse", 1)) if old else ():
        changed = [f for f in found if f in old and sign * (found[f] - old[f]) > DIFFERS]
        print(f"{len(changed)} {name}:", *changed, sep="\n  ")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("root", type=Path, help="folder that holds landscape-pseudo/ …")
    parser.add_argument("--every", type=int, default=1, help="judge every so many photos")
    parser.add_argument("--to", type=Path, help="write the figures (JSON)")
    parser.add_argument("--from", dest="old", type=Path, help="figures to compare with")
    options = parser.parse_args()
    files = sorted({*corrections(JUDGED), *outlines(JUDGED_WATER)})[:: options.every]
    found = {file: judge(options.root, file) for file in files}
    old = json.loads(options.old.read_text()) if options.old else {}
    for what in ("sky", "water"):
        now, then = ({f: v[what] for f, v in x.items() if what in v} for x in (found, old))
        report(what, now, then)
    if options.to:
        options.to.write_text(json.dumps(found))


if __name__ == "__main__":
    main()
