"""Strokes: a person says *sky* or *not sky*, and the map follows (thesis 3.1.1.2).

Strokes are replayed in order on a small copy. What they make of it depends on the map they begin
with and on the strokes alone, so a ``Painting`` may be kept and painted on.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from sunwidget.analysis.refine import SIDE, Decision, cut, paint
from sunwidget.analysis.working import Working, resize, shrink
from sunwidget.edit import Stroke

TOLERANCE = 14.0  # of 8-bit Lab, beside the brush
REACH = 0.4  # of the longer side: no stroke acts farther than that
MUCH = 0.05  # of the picture: a sky that changed so much has to be looked at again


@dataclass(frozen=True, eq=False)
class Painting:
    """Sky or land on the small copy of at most 384 px, after some strokes.

    Parameters
    ----------
    start, sky : (h, w) bool
        The sky before the first stroke, and now.
    said : (h, w) int8
        What a person said: 1 sky, 0 not sky, -1 nothing.
    looked_at : (h, w) bool
        The sky when camera, sun and air were last fitted to it, after ``fits`` strokes.
    fits : int
        Number of strokes then.
    count : int
        Number of strokes so far.
    """

    start: np.ndarray
    sky: np.ndarray
    said: np.ndarray
    looked_at: np.ndarray
    fits: int = 0
    count: int = 0

    @classmethod
    def begin(cls, sky: np.ndarray, working: Working) -> Painting:
        """Start from a map (h, w) of any size."""
        height, width = shrink(working.bytes, SIDE).shape[:2]
        start = resize(sky, width, height) > 0.5
        return cls(start, start, np.full(start.shape, -1, np.int8), start)

    def stroke(self, stroke: Stroke, working: Working) -> Painting:
        """Return the painting after one more stroke; deterministic.

        A stroke acts on what is like the pixels under it, connected to them, and wrongly
        labelled: everything else keeps its label.
        """
        sky, said = _stroked(shrink(working.bytes, SIDE), self.sky, self.said, stroke)
        count = self.count + 1
        none = not self.looked_at.any() and sky.any()
        if none or np.mean(sky != self.looked_at) > MUCH:
            return replace(self, sky=sky, said=said, looked_at=sky, fits=count, count=count)
        return replace(self, sky=sky, said=said, count=count)

    def on(self, decision: Decision) -> Decision:
        """Put into a decision, which may be finer, what the strokes changed."""
        import cv2

        changed = (self.sky != self.start).astype(np.uint8)
        if not changed.any():
            return decision
        rows, columns = decision.sky.shape
        new = resize(self.sky.astype(np.float32), columns, rows)
        inside = resize(changed.astype(np.float32), columns, rows) > 0.5
        edge = cv2.morphologyEx(changed, cv2.MORPH_GRADIENT, np.ones((3, 3), np.uint8))
        unsure = resize(edge.astype(np.float32), columns, rows) > 0.25
        sureness = np.where(inside, 1, decision.sureness)
        sureness = np.where(unsure, np.minimum(sureness, 0.05), sureness)
        sky = np.where(inside, new, decision.sky)
        return decision._replace(sky=sky.astype(np.float32), sureness=sureness.astype(np.float32))


def apply_strokes(working: Working, decision: Decision, strokes: Sequence[Stroke]) -> Decision:
    """Replay strokes in order on a decision; without strokes it is the very same."""
    painting = Painting.begin(decision.sky, working)
    for stroke in strokes:
        painting = painting.stroke(stroke, working)
    return painting.on(decision)


def _stroked(
    image: np.ndarray, sky: np.ndarray, said: np.ndarray, stroke: Stroke
) -> tuple[np.ndarray, np.ndarray]:
    """Return the sky, and what was said, after a stroke on a picture (h, w, 3) uint8."""
    import cv2

    height, width = sky.shape
    under = paint(stroke, width, height)
    if not under.any():
        return sky, said
    wanted = stroke.label == "sky"
    said = np.where(under, np.int8(wanted), said)
    lab = cv2.cvtColor(image, cv2.COLOR_RGB2LAB).astype(np.float32)
    region = _alike(lab, under, (sky != wanted) | under)
    labels = np.where(sky, cv2.GC_FGD, cv2.GC_BGD).astype(np.uint8)
    labels[region] = cv2.GC_PR_FGD if wanted else cv2.GC_PR_BGD
    labels[said == 1], labels[said == 0] = cv2.GC_FGD, cv2.GC_BGD
    # The colour models would give a wrongly labelled wall back to the sky it was learned as;
    # what is like the brush and touches it follows the brush.
    sky = np.where(region, wanted, sky)
    after = _cut_near(image, labels, region | under)
    rim = cv2.dilate(region.astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    sky = np.where(rim & ~region & (after == wanted), wanted, sky)
    sky[said == 1], sky[said == 0] = True, False
    return sky, said


def _cut_near(image: np.ndarray, labels: np.ndarray, region: np.ndarray) -> np.ndarray:
    """GrabCut in the region's box and a margin; elsewhere the labels stand."""
    rows, columns = np.nonzero(region)
    margin = 24  # px of the small copy: enough of both sides for the colour models
    box = (
        slice(max(int(rows.min()) - margin, 0), int(rows.max()) + margin + 1),
        slice(max(int(columns.min()) - margin, 0), int(columns.max()) + margin + 1),
    )
    sky = (labels == 1) | (labels == 3)  # GC_FGD, GC_PR_FGD
    sky[box] = cut(np.ascontiguousarray(image[box]), labels[box], iterations=1)
    return sky


def _alike(lab: np.ndarray, under: np.ndarray, candidates: np.ndarray) -> np.ndarray:
    """Return what is connected to the brush through candidates of like colour.

    How like it must be grows with the distance from the brush, to identical at one and a half
    times the stroke's own extent: a dab fixes a patch, a long stroke a house, and none on a
    grey wall leaks into all of a grey sky.
    """
    import cv2

    # Distance to the nearest of a few colours under the brush, so that a stroke over a brick
    # wall takes bricks and mortar.
    samples = lab[under]
    samples = samples[:: -(-len(samples) // 24)]
    flat = lab.reshape(-1, 3)
    squares = (flat**2).sum(axis=1)[:, None] - 2 * flat @ samples.T + (samples**2).sum(axis=1)
    distance = np.sqrt(np.maximum(squares.min(axis=1), 0)).reshape(under.shape)
    away = cv2.distanceTransform((~under).astype(np.uint8), cv2.DIST_L2, 3)
    rows, columns = np.nonzero(under)
    extent = math.hypot(np.ptp(rows) + 1, np.ptp(columns) + 1)
    tolerance = TOLERANCE * np.clip(1 - away / min(1.5 * extent, REACH * max(under.shape)), 0, 1)
    like = ((distance < tolerance) & candidates) | under
    _, labels = cv2.connectedComponents(like.astype(np.uint8), connectivity=8)
    keep = np.unique(labels[under])
    return np.isin(labels, keep[keep > 0])


def set_strokes(matte: np.ndarray, strokes: Sequence[Stroke]) -> None:
    """Set a matte (H, W) under each brush, in place: what a person says wins over everything."""
    height, width = matte.shape
    for stroke in strokes:
        reach = stroke.radius * max(width, height) + 2
        xs = [x * width for x, _ in stroke.points]
        ys = [y * height for _, y in stroke.points]
        left, right = max(math.floor(min(xs) - reach), 0), min(math.ceil(max(xs) + reach), width)
        top, bottom = max(math.floor(min(ys) - reach), 0), min(math.ceil(max(ys) + reach), height)
        if left < right and top < bottom:
            # Painting only the stroke's box saves most of the time on a large photo.
            box = slice(top, bottom), slice(left, right)
            matte[box][paint(stroke, width, height, box)] = stroke.label == "sky"
