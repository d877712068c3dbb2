"""How well the network sees worlds of families that it never saw.

``python -m training.land.evaluate --worlds …`` runs the ONNX file that ships. Every world is
photographed twice by a seed.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np
import onnxruntime
import torch

from training.land.data import WATER, Worlds, outlined, sample, size_of
from training.land.export import AREA, OUT
from training.land.model import SUN_HEIGHTS, SUN_TURNS, openness, sun_basis


def measure(session: onnxruntime.InferenceSession, worlds: Worlds, area: int) -> dict[str, float]:
    """Return the figures of quality over all worlds of a folder."""
    random = np.random.default_rng(7)
    names = [output.name for output in session.get_outputs()]
    lit, wet, sky = np.zeros(2), np.zeros(2), np.zeros(2)
    rows: dict[str, list[float]] = {}
    for world in (worlds[i] for i in range(len(worlds)) for _ in range(2)):
        truth = sample(world, *size_of(world["depth"].shape, area), random)
        image = (truth["image"][None] / 255).astype(np.float32)
        found = dict(zip(names, (x[0] for x in session.run(None, {"image": image})), strict=True))
        land = truth["land"][0] > 0.5
        if truth["view"][3] > 0:
            lit += _overlap(found["sunlit"][0] > 0.5, truth["sunlit"][0] > 0.5, land)
        sky += _overlap(found["sky"][0] > 0.5, truth["sky"][0] > 0.5, np.ones_like(land))
        wet += _overlap(found["matter"].argmax(0) == WATER, truth["matter"] == WATER, True)
        solid = truth["solid"][0] & (truth["matter"] != WATER)
        if solid.sum() < 200:
            continue
        cosine = (found["normal"] * truth["normal"]).sum(0)[solid]
        level = (found["depth"] - truth["depth"])[0][solid]
        level = level - np.median(level)
        view = found["view"]
        open_ = openness(torch.from_numpy(found["transfer"])[None])[0, 0].numpy()
        one = {
            "normal, median degrees": float(
                np.degrees(np.arccos(np.clip(np.median(cosine), -1, 1)))
            ),
            "depth within 25 %": float((np.abs(level) < np.log2(1.25)).mean()),
            "openness, mean error": float(np.abs(open_ - truth["openness"][0])[solid].mean()),
            "light of other suns, squared error": _of_others(found["transfer"], truth, solid),
            "air, mean error": float(np.abs(found["air"] - truth["air"])[0][solid].mean()),
            "matter right": float((found["matter"].argmax(0) == truth["matter"])[solid].mean()),
            "horizon, rows of 1": float(abs(view[0] - truth["view"][0])),
            "focal length, log2": float(abs(view[2] - truth["view"][2])),
            "sunshine right": float((view[3] > 0) == (truth["view"][3] > 0)),
        }
        if truth["view"][3] > 0:
            one["sun, degrees"] = _angle(likeliest(found["sun"]), likeliest(truth["sun"]))
            one["sun, log share"] = float(truth["sun"] @ np.log(found["sun"] + 1e-9))
            faced = truth["faced"][0] > 0.5
            if faced.sum() > 100:
                one["facing, mean error"] = float(
                    np.abs(found["facing"] - truth["facing"])[0][faced].mean()
                )
        for name, value in one.items():
            rows.setdefault(name, []).append(value)
    figures = {
        name: float(np.nanmedian(v) if "right" not in name and "within" not in name else np.mean(v))
        for name, v in rows.items()
    }
    figures |= {
        "sunlit, IoU": lit[0] / lit[1],
        "water, IoU": wet[0] / max(wet[1], 1),
        "sky, IoU": sky[0] / sky[1],
    }
    return figures


def haze_errors(session: onnxruntime.InferenceSession, data: Path, area: int) -> dict[str, float]:
    """Return errors of the air's share in outlined photos that judge, means over the photos."""
    rows: dict[str, list[float]] = {}
    for picture, share, known in outlined(data, judging=True):
        high, wide = size_of(share.shape, area)
        image = cv2.resize(picture, (wide, high), interpolation=cv2.INTER_AREA)
        tensor = (image.transpose(2, 0, 1)[None] / 255).astype(np.float32)
        air = cv2.resize(session.run(["air"], {"image": tensor})[0][0, 0], share.shape[::-1])
        for kind, where in (("clear", share == 0), ("hazy", share > 0)):
            if (here := known & where).mean() > 0.02:
                key = f"air of {kind} land in photos"
                rows.setdefault(key, []).append(float(np.abs(air - share)[here].mean()))
    return {name: float(np.mean(values)) for name, values in rows.items()}


def _of_others(transfer: np.ndarray, truth: dict, solid: np.ndarray) -> float:
    errors = []
    for sun, light in zip(truth["suns"], truth["passed"], strict=True):
        if sun[3]:
            parts = sun_basis(torch.from_numpy(sun[:3])).numpy()
            predicted = np.clip(np.tensordot(parts, transfer, 1), 0, 1)
            errors.append(((predicted - light[0]) ** 2)[solid].mean())
    return float(np.mean(errors)) if errors else float("nan")


def likeliest(shares: np.ndarray) -> np.ndarray:
    """Return the mean direction (x right, y ahead, z up) of shares of suns, (72,)."""
    turns, heights = np.radians(SUN_TURNS.numpy()), np.radians(SUN_HEIGHTS.numpy())
    azimuth, elevation = np.meshgrid(turns, heights)
    flat = np.cos(elevation)
    ways = np.stack([flat * np.sin(azimuth), flat * np.cos(azimuth), np.sin(elevation)], -1)
    return shares @ ways.reshape(-1, 3)


def _angle(one: np.ndarray, other: np.ndarray) -> float:
    cosine = one @ other / max(np.linalg.norm(one) * np.linalg.norm(other), 1e-9)
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))


def _overlap(found: np.ndarray, truth: np.ndarray, where: np.ndarray | bool) -> np.ndarray:
    """Return the sizes of intersection and union."""
    return np.array([(found & truth & where).sum(), ((found | truth) & where).sum()], float)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--worlds", type=Path, required=True)
    parser.add_argument("--data", type=Path, help="photos of training/land/haze.csv")
    parser.add_argument("--network", type=Path, default=OUT)
    parser.add_argument("--area", type=int, default=AREA)
    options = parser.parse_args()
    session = onnxruntime.InferenceSession(options.network, providers=["CPUExecutionProvider"])
    figures = measure(session, Worlds(options.worlds), options.area)
    if options.data:
        figures |= haze_errors(session, options.data, options.area)
    for name, value in figures.items():
        print(f"{name:26} {value:.3f}")


if __name__ == "__main__":
    main()
