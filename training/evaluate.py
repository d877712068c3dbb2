"""Scores the bare network.

The photo is squeezed to 384 x 384, the output stretched back to the photo and cut at 0.5.

``python -m training.evaluate --data ../shared/data/eval``

Prints, per folder that holds images/ and masks/: pooled IoU, share of wrong pixels (MCR), 10th
percentile of the photos' IoU, and the median time of a run. These folders are for measuring;
nothing is trained or chosen on them.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass, field
from pathlib import Path

import cv2
import numpy as np
import onnxruntime


@dataclass
class Score:
    """Counts of pixels over the photos of one folder."""

    shared: int = 0
    union: int = 0
    wrong: int = 0
    total: int = 0
    ious: dict[str, float] = field(default_factory=dict)
    mistakes: dict[str, float] = field(default_factory=dict)

    def add(self, name: str, sky: np.ndarray, mask: np.ndarray) -> None:
        """``sky`` boolean ``(H, W)``; ``mask`` uint8 alike: 255 sky, 0 not, between unknown."""
        truth, known = mask > 191, (mask > 191) | (mask < 64)
        shared, union = int((sky & truth & known).sum()), int(((sky | truth) & known).sum())
        wrong, total = int(((sky != truth) & known).sum()), int(known.sum())
        self.shared, self.union = self.shared + shared, self.union + union
        self.wrong, self.total = self.wrong + wrong, self.total + total
        self.mistakes[name] = wrong / max(total, 1)
        if (truth & known).mean() > 0.01:
            self.ious[name] = shared / max(union, 1)

    def __str__(self) -> str:
        low = np.percentile(list(self.ious.values()), 10) if self.ious else np.nan
        iou = self.shared / max(self.union, 1)
        mcr = self.wrong / max(self.total, 1)
        return f"iou={iou:.4f} mcr={mcr:.4f} iou_p10={low:.4f} photos={len(self.mistakes)}"


def probability(session: onnxruntime.InferenceSession, rgb: np.ndarray, size: int) -> np.ndarray:
    """``(H, W, 3)`` uint8 sRGB -> ``(H, W)`` float32 in [0, 1]."""
    small = cv2.resize(rgb, (size, size), interpolation=cv2.INTER_AREA).astype(np.float32) / 255
    sky = session.run(None, {"image": np.ascontiguousarray(small.transpose(2, 0, 1)[None])})[0][
        0, 0
    ]
    return cv2.resize(sky, rgb.shape[1::-1], interpolation=cv2.INTER_LINEAR)


def overlay(rgb: np.ndarray, sky: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Photo, then missed sky in red and invented sky in yellow; ``(H, 2 W, 3)`` uint8."""
    shown = rgb.astype(np.float32) * 0.6
    shown[sky & (mask < 64)] += (110, 110, 0)
    shown[~sky & (mask > 191)] += (120, 0, 0)
    return np.hstack([rgb, np.clip(shown, 0, 255).astype(np.uint8)])


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--model", type=Path, default=Path("sunwidget/analysis/models/sky.onnx"))
    parser.add_argument("--size", type=int, default=384)
    parser.add_argument("--overlays", type=Path, help="write the worst photos of every folder here")
    options = parser.parse_args()
    settings = onnxruntime.SessionOptions()
    settings.intra_op_num_threads = 2
    session = onnxruntime.InferenceSession(
        options.model, settings, providers=["CPUExecutionProvider"]
    )
    for folder in sorted(p.parent for p in options.data.glob("*/images")):
        score, seconds, pictures = Score(), [], {}
        for path in sorted((folder / "images").iterdir()):
            rgb = cv2.cvtColor(cv2.imread(str(path), cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)
            mask = cv2.imread(str(folder / "masks" / f"{path.stem}.png"), cv2.IMREAD_GRAYSCALE)
            start = time.perf_counter()
            sky = probability(session, rgb, options.size)
            seconds.append(time.perf_counter() - start)
            sky = cv2.resize(sky, mask.shape[::-1]) > 0.5
            score.add(path.stem, sky, mask)
            pictures[path.stem] = overlay(cv2.resize(rgb, mask.shape[::-1]), sky, mask)
        print(f"{folder.name:12s} {score} ms={1000 * np.median(seconds):.0f}", flush=True)
        if options.overlays:
            options.overlays.mkdir(parents=True, exist_ok=True)
            worst = sorted(score.mistakes, key=lambda name: -score.mistakes[name])[:8]
            for rank, name in enumerate(worst):
                file = (
                    options.overlays / f"{folder.name}-{rank}-{score.mistakes[name]:.3f}-{name}.png"
                )
                cv2.imwrite(str(file), cv2.cvtColor(pictures[name], cv2.COLOR_RGB2BGR))


if __name__ == "__main__":
    main()
