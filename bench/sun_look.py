"""Appearance of a new sun in photos, compared with cameras' pictures of real suns.

    python bench/sun_look.py FOLDER_OR_FILES... [--seed 15 --skip 30 --limit 30] [--sheets OUT]

Two suns in view, 3 and 12 degrees high, are set into each photo. `burnt` is the share of the sky
that burns to white and did not before, `frame` that of the picture that is burnt, `black` the share
of the land that turns black: percent; median, 75th and 90th percentile. `core` is the radius of the
bright core in percent of the width (10th percentile, median, 90th). Below it stand quartiles of the
display-linear luminance above the sun, so many percent of the width from its core, beside those of
94 photos that show their sun; 0.14 % of their frames are burnt (75th percentile 0.6, 90th 3.4).

`--density` is a table of real skies' CIELAB colors (`density`, `lo`, `hi`, `threshold`): `odd` is
then the share of pictures in which more than 1 % of the sky has none of them.
"""

import argparse
import random
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from PIL import Image

import sunwidget as sw
from sunwidget.formats.color import LUMINANCE, srgb_to_linear

SUNS = {"view3": (8, 3), "view12": (-20, 12)}
DISTANCES = (2, 5, 10, 20, 30)
REAL = (
    (0.55, 0.77, 0.87),
    (0.36, 0.56, 0.76),
    (0.30, 0.40, 0.57),
    (0.20, 0.27, 0.40),
    (0.13, 0.19, 0.37),
)
CORE = 0.85  # display-linear luminance of what belongs to the sun's bright core


def inside(mask: np.ndarray) -> np.ndarray:
    """Take the rim away, where photo and matte may disagree."""
    side = max(3, int(mask.shape[1] * 0.012))
    return cv2.erode(mask.astype(np.uint8), np.ones((side, side)), borderValue=1) > 0


def unnatural(picture: np.ndarray, sky: np.ndarray, density: dict[str, np.ndarray]) -> float:
    """Share of the sky's pixels whose colour real skies do not have."""
    smooth = cv2.GaussianBlur(picture, (0, 0), 1.2)[sky].astype(np.float32)[None] / 255
    lab = cv2.cvtColor(smooth, cv2.COLOR_RGB2LAB)[0]
    table = density["density"]
    cell = ((lab - density["lo"]) / (density["hi"] - density["lo"]) * table.shape).astype(int)
    found = table[tuple(np.clip(cell, 0, np.array(table.shape) - 1).T)]
    return float((found < density["threshold"]).mean())


def glare_above(picture: np.ndarray, sky: np.ndarray, x: float, y: float) -> list[float]:
    """Luminance above the sun's core, NaN where there is no sky; first the core's radius."""
    height, width = sky.shape
    light = cv2.GaussianBlur(
        (srgb_to_linear(picture / 255) @ LUMINANCE).astype(np.float32), (0, 0), 1
    )
    parts = cv2.connectedComponents((light > CORE).astype(np.uint8))[1]
    column, row = int(x), int(y)
    label = parts[row, column] if 0 <= column < width and 0 <= row < height else 0
    radius = np.sqrt((parts == label).sum() / np.pi) / width if label else 0.0
    found = [radius]
    for distance in DISTANCES:
        at = int(y - (radius + distance / 100) * width)
        beside = slice(max(int(x - 0.01 * width), 0), int(x + 0.01 * width) + 1)
        strip = light[at, beside][sky[at, beside]] if 0 <= at < height else np.zeros(0)
        found.append(float(np.median(strip)) if strip.size else np.nan)
    return found


def look(scene: Any, density: Any) -> tuple[dict[str, dict[str, Any]], list[np.ndarray]]:
    """Move the sun of one photo to each position and measure it."""
    before = render(scene, sw.Edit())
    mask = np.asarray(scene.sky)
    sky, land = inside(mask > 0.97), inside(mask < 0.03)
    rows, pictures = {}, [before]
    for name, (azimuth, elevation) in SUNS.items():
        after = render(scene, sw.Edit(sun_azimuth=azimuth, sun_elevation=elevation))
        pictures.append(after)
        row: dict[str, Any] = {}
        if sky.sum() > 500:
            new = (after.min(-1) >= 250) & (before.max(-1) < 235)
            row["burnt"] = float(new[sky].mean())
            row["frame"] = float((after.min(-1) >= 250).mean())
            x, y = scene.camera.pixel(azimuth, elevation)
            if 0 <= x < scene.width and 0 <= y < scene.height and mask[int(y), int(x)] > 0.9:
                row["glare"] = glare_above(after, sky, x, y)
            if density is not None:
                row["odd"] = unnatural(after, sky, density)
        if land.sum() > 500:
            row["black"] = float(((after.max(-1) < 5) & (before.max(-1) > 15))[land].mean())
        rows[name] = row
    return rows, pictures


def render(scene: Any, edit: Any) -> np.ndarray:
    """Return the picture as (h, w, 3) uint8."""
    return np.ascontiguousarray(sw.render(scene, edit)[..., :3])


def report(rows: list[dict[str, dict[str, Any]]]) -> None:
    """Print medians and percentiles of each sun."""
    for name in SUNS:
        found = [row[name] for row in rows]
        print(f"{name}: {len(found)} photos")
        for key in ("burnt", "frame", "black"):
            values = [100 * row[key] for row in found if key in row]
            if values:
                print(f"  {key:6}", *(f"{v:6.2f}" for v in np.quantile(values, (0.5, 0.75, 0.9))))
        odd = [row["odd"] > 0.01 for row in found if "odd" in row]
        if odd:
            print(f"  odd    {100 * np.mean(odd):6.1f} % of {len(odd)}")
        glare = np.array([row["glare"] for row in found if "glare" in row])
        if len(glare):
            print(
                "  core  ", *(f"{100 * v:6.2f}" for v in np.quantile(glare[:, 0], (0.1, 0.5, 0.9)))
            )
            for i, (distance, real) in enumerate(zip(DISTANCES, REAL, strict=True)):
                values = glare[:, i + 1][np.isfinite(glare[:, i + 1])]
                if values.size:
                    here = " ".join(f"{v:.2f}" for v in np.quantile(values, (0.25, 0.5, 0.75)))
                    those = " ".join(f"{v:.2f}" for v in real)
                    print(f"  +{distance:2} %   {here}   real {those}  ({values.size})")


def main() -> None:
    """Run over the photos asked for."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("paths", nargs="+", type=Path)
    parser.add_argument("--limit", type=int)
    parser.add_argument(
        "--skip", type=int, default=0, help="leave out the first of the seeded order"
    )
    parser.add_argument("--seed", type=int, help="shuffle the photos")
    parser.add_argument(
        "--sheets", type=Path, help="folder for a picture of each photo and its suns"
    )
    parser.add_argument("--density", type=Path)
    wish = parser.parse_args()
    files = [
        file
        for path in wish.paths
        for file in (
            sorted(p for p in path.iterdir() if p.suffix in (".jpg", ".jpeg", ".png"))
            if path.is_dir()
            else [path]
        )
    ]
    if wish.seed is not None:
        random.Random(wish.seed).shuffle(files)
    density = None if wish.density is None else dict(np.load(wish.density))
    rows = []
    for file in files[wish.skip :][: wish.limit]:
        scene = sw.analyze(sw.open(file))
        found, pictures = look(scene, density)
        shown = scene.sun is not None and scene.sun.visible
        print(
            file.name,
            *(f"black {100 * r.get('black', np.nan):.1f}" for r in found.values()),
            "sun" if shown else "",
            *(
                f"{k} {100 * r.get('burnt', np.nan):.2f}/{100 * r.get('odd', np.nan):.1f}"
                for k, r in found.items()
            ),
            flush=True,
        )
        rows.append(found)
        if wish.sheets:
            wish.sheets.mkdir(parents=True, exist_ok=True)
            Image.fromarray(np.hstack(pictures)).save(wish.sheets / f"{file.stem}.png")
    report(rows)


if __name__ == "__main__":
    main()
