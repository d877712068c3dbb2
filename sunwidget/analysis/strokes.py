"""Strokes: a person says *sky* or *not sky*, and the map follows (thesis 3.1.1.2)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from sunwidget.analysis.refine import SIDE, Decision, cut, paint
from sunwidget.analysis.working import Working, resize, shrink
from sunwidget.edit import Stroke

TOLERANCE = 14.0  # of 8-bit Lab, beside the brush
REACH = 0.4  # of the longer side: no stroke acts farther than that


def apply_strokes(working: Working, decision: Decision, strokes: Sequence[Stroke]) -> Decision:
    """Replay strokes in order on a decision; deterministic.

    A stroke acts on what is like the pixels under it, connected to them, and wrongly labelled:
    everything else keeps its label.
    """
    if not strokes:
        return decision
    import cv2

    image = shrink(working.bytes, SIDE)
    height, width = image.shape[:2]
    before = resize(decision.sky, width, height) > 0.5
    sky = before.copy()
    lab = cv2.cvtColor(image, cv2.COLOR_RGB2LAB).astype(np.float32)
    fixed = np.full(sky.shape, -1, np.int8)
    for stroke in strokes:
        under = paint(stroke, width, height)
        if not under.any():
            continue
        wanted = stroke.label == "sky"
        fixed[under] = wanted
        region = _alike(lab, under, (sky != wanted) | under)
        labels = np.where(sky, cv2.GC_FGD, cv2.GC_BGD).astype(np.uint8)
        labels[region] = cv2.GC_PR_FGD if wanted else cv2.GC_PR_BGD
        labels[fixed == 1], labels[fixed == 0] = cv2.GC_FGD, cv2.GC_BGD
        # The colour models would give a wrongly labelled wall back to the sky it was learned
        # as; what is like the brush and touches it follows the brush.
        sky = np.where(region, wanted, sky)
        after = _cut_near(image, labels, region | under)
        rim = cv2.dilate(region.astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
        sky = np.where(rim & ~region & (after == wanted), wanted, sky)
        sky[fixed == 1], sky[fixed == 0] = True, False
    changed = (sky != before).astype(np.uint8)
    if not changed.any():
        return decision
    # The decision may be finer than this copy: put in only what changed.
    rows, columns = decision.sky.shape
    new = resize(sky.astype(np.float32), columns, rows)
    inside = resize(changed.astype(np.float32), columns, rows) > 0.5
    edge = cv2.morphologyEx(changed, cv2.MORPH_GRADIENT, np.ones((3, 3), np.uint8))
    unsure = resize(edge.astype(np.float32), columns, rows) > 0.25
    sureness = np.where(inside, 1, decision.sureness)
    sureness = np.where(unsure, np.minimum(sureness, 0.05), sureness)
    return Decision(
        np.where(inside, new, decision.sky).astype(np.float32), sureness.astype(np.float32)
    )


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
