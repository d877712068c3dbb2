"""Our refinement against GrabCut on every pixel of the photo, from the same network's mask.

The peer is OpenCV's GrabCut at full resolution with our own trimap, five iterations as the thesis
has them: no matte, so a twig is sky or it is not. Ours decides at 384 pixels and at working size
and carries the decision to every pixel by a guided filter. How well both agree is the intersection
over union of their skies; where the true sky of a bundled sample is at hand (``$SUNWIDGET_SHARED``,
else ``../shared``) each is measured against that as well.
"""

from __future__ import annotations

import os
from pathlib import Path

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.segmentation import coarse_sky, matting, refine

from .effort import Effort
from .rows import Rows, of_times
from .timing import Times, clock

KEYS = ("GrabCut, full resolution",)
SHARED = Path(os.environ.get("SUNWIDGET_SHARED", Path(__file__).resolve().parents[3] / "shared"))
SIZE = (1024, 698)


def rows(effort: Effort) -> Rows:
    ours, theirs = Times([], []), Times([], [])
    agreement, right = [], []
    for name in effort.samples:
        photo = sw.open(sw.sample(name).preview(max(effort.frame)))
        working = Working.of(photo)
        probability = coarse_sky.network(working)
        with clock(ours):
            alpha = matting.matte(photo, working, refine.grabcut_mask(working, probability))
        coarse = resize(probability, *photo.size)
        with clock(theirs):
            cut = refine.cut(photo.encoded, refine.trimap(coarse), iterations=5)
        agreement.append(iou(alpha > 0.5, cut))
        truth = true_sky(name, photo.size)
        if truth is not None:
            right.append((iou(alpha > 0.5, truth), iou(cut, truth)))
    note = f"IoU of both {np.mean(agreement):.3f}"
    if right:
        mine, peer = np.mean(right, axis=0)
        note += f"; against the true sky ours {mine:.3f}, GrabCut {peer:.3f} ({len(right)} samples)"
    yield of_times(
        "GrabCut, full resolution",
        f"sky refined, {max(effort.frame)} px, beside GrabCut at full resolution",
        ours,
        "s",
        peer=theirs.median,
        ratio=sum(theirs.wall) / sum(ours.wall),
        note=note,
    )


def iou(one: np.ndarray, other: np.ndarray) -> float:
    """Intersection over union of two masks (H, W) bool."""
    return float((one & other).sum() / max(int((one | other).sum()), 1))


def true_sky(name: str, size: tuple[int, int]) -> np.ndarray | None:
    """Return the rendered sample's own sky (H, W) bool where it is at hand."""
    path = SHARED / "samples" / name / f"{name}_sky.png"
    if not path.is_file():
        return None
    return cv2.resize(cv2.imread(str(path), cv2.IMREAD_GRAYSCALE), size) > 127
