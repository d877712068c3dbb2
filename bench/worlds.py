"""Relighting on worlds made by ``training.worlds`` whose families no network was trained on.

    python bench/worlds.py FOLDER [--hints] [--count N] [--out SHEETS] [--off NAME ...]

The photo is a world under one sun, the truth the same under each other one: the shared scorer's
skill of sky and land (1 - squared error over that of the photo itself, after one gain for all),
mean ΔE00 against that of copying, PSNR in dB and SSIM of sRGB pictures, of all and of the land
alone.
"""

from __future__ import annotations

import argparse
import json
import zlib
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from ablation import load_score
from skimage.metrics import structural_similarity

import sunwidget as sw
from training.land.air import with_air

LUMINANCE = np.array([0.2126, 0.7152, 0.0722], np.float32)
KEY = 0.16  # geometric mean of the scene's light after exposure


def pictures(world: dict[str, np.ndarray], name: str) -> list[np.ndarray]:
    """Return a world's photos, uint8 sRGB: one camera, one air, exposed each for itself."""
    found = []
    # Of the suns after those that are photographed only the light on land is known.
    for sun in range(len(world["light"])):
        seen, _ = with_air(world, sun, np.random.default_rng(zlib.crc32(name.encode())))
        level = np.exp(np.log(np.maximum(seen @ LUMINANCE, 1e-6)).mean())
        linear = 1 - np.exp(-1.15 * KEY / level * seen)
        encoded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
        found.append(np.rint(np.clip(encoded, 0, 1) * 255).astype(np.uint8))
    return found


def place(camera: sw.Camera, true: sw.Camera, sun: np.ndarray) -> tuple[float, float]:
    """Return azimuth and elevation for the editor: where a person would drag the sun, or told."""
    azimuth, elevation = float(np.degrees(sun[0])), float(np.degrees(sun[1]))
    if abs(azimuth) < 75 and elevation < 60:
        azimuth, elevation = camera.angles(*true.pixel(azimuth, elevation))
    return float(azimuth), float(np.clip(elevation, -12, 90))


def likeness(out: np.ndarray, truth: np.ndarray, land: np.ndarray) -> dict[str, float]:
    """Return PSNR in dB and SSIM, exposures matched by one gain in linear light."""
    score = load_score()
    a, b = score.linear(out), score.linear(truth)
    gain = (a * b).sum() / max((a * a).sum(), 1e-9)
    a, b = score.srgb(a * gain), score.srgb(b)
    _, same = structural_similarity(a, b, channel_axis=2, data_range=1, full=True)
    square = (a - b) ** 2
    return {
        "psnr": float(-10 * np.log10(square.mean())),
        "psnr_land": float(-10 * np.log10(square[land].mean())),
        "ssim": float(same.mean()),
        "ssim_land": float(same[land].mean()),
    }


def measure(path: Path, options: argparse.Namespace) -> list[dict[str, Any]]:
    """Return a row of figures for each move of a world's sun."""
    score = load_score()
    with np.load(path) as file:
        world = dict(file)
    photos = pictures(world, path.stem)
    suns = world["suns"][: len(photos)]
    height, width = world["depth"].shape
    fov, pitch, roll, _ = (float(v) for v in world["camera"])
    true = sw.Camera(width, height, np.degrees(fov), np.degrees(pitch), np.degrees(roll))
    hints: dict[str, Any] = {}
    if options.hints:
        hints = {"fov": true.fov_vertical_deg, "horizon": float(true.horizon_row())}
        if abs(suns[0][0]) < 1.3:
            hints["sun"] = tuple(float(v) for v in true.pixel(*np.degrees(suns[0][:2])))
    scene = sw.analyze(photos[0], **hints)
    sky, land = world["matter"] == 0, world["matter"] != 0
    off = dict.fromkeys(options.off, 0)
    rows, sheet = [], [photos[0]]
    for truth, sun in zip(photos[1:], suns[1:], strict=True):
        azimuth, elevation = place(scene.camera, true, sun)
        out = sw.render(scene, sw.Edit(sun_azimuth=azimuth, sun_elevation=elevation, **off))
        found = score.compare(*(score.linear(p) for p in (out, truth, photos[0])), sky, land)
        rows.append({"world": path.stem, **found, **likeness(out, truth, land)})
        sheet += [out, truth]
    if options.out:
        options.out.mkdir(parents=True, exist_ok=True)
        cv2.imwrite(str(options.out / f"{path.stem}.png"), np.hstack(sheet)[..., ::-1])
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--hints", action="store_true")
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--off", nargs="*", default=[])
    parser.add_argument("--out", type=Path)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    rows = []
    for path in sorted(options.folder.glob("*.npz"))[: options.count]:
        with np.load(path) as file:
            lit = file["suns"][0]
        if lit[1] < 0.02 or lit[2]:  # photos of a sun that shines
            continue
        rows += (found := measure(path, options))
        skill = [r["fg_skill"] for r in found if "fg_skill" in r]
        print(path.stem, "land", np.round(skill, 2), flush=True)
    names = (
        "sky_skill",
        "fg_skill",
        "sky_dE",
        "sky_dE_copy",
        "fg_dE",
        "fg_dE_copy",
        "psnr",
        "psnr_land",
        "ssim",
        "ssim_land",
    )
    mean = {n: float(np.mean([r[n] for r in rows if n in r])) for n in names}
    median = float(np.median([r["fg_skill"] for r in rows if "fg_skill" in r]))
    print(
        "MEAN", " ".join(f"{n}={v:.3f}" for n, v in mean.items()), f"fg_skill_median={median:.3f}"
    )
    if options.json:
        options.json.write_text(json.dumps({"rows": rows, "mean": mean}))


if __name__ == "__main__":
    main()
