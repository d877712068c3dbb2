"""Strokes that label pixels *sky* or *not sky* (thesis 3.1.1.2).

Strokes are replayed in order on a small copy. The result depends only on the initial map and on the
strokes, so a ``Painting`` can be cached and continued.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from sunwidget.analysis.images.working_copy import Working, resize, shrink
from sunwidget.analysis.segmentation.refine import SIDE, Decision, cut
from sunwidget.analysis.strokes.brush import paint
from sunwidget.edit.table import Stroke

TOLERANCE = 14.0  # of 8-bit Lab, beside the brush where the network is unsure
REACH = 0.4  # of the longer side: greatest distance at which a stroke acts
ISLAND = 0.03  # of the picture: larger patches are not flipped as a whole
MUCH = 0.05  # of the picture: a sky that changed this much needs a new fit


@dataclass(frozen=True, eq=False)
class Painting:
    """Sky or land on the small copy of at most 384 px, after some strokes.

    Parameters
    ----------
    start, sky : (h, w) bool
        The sky before the first stroke, and now.
    said : (h, w) int8
        Labels of the strokes: 1 sky, 0 not sky, -1 none.
    network : (h, w) float32
        The network's probability of sky.
    looked_at : (h, w) bool
        The sky to which camera, sun and air were last fitted.
    fits : int
        Number of strokes at that fit.
    count : int
        Number of strokes so far.
    """

    start: np.ndarray
    sky: np.ndarray
    said: np.ndarray
    network: np.ndarray
    looked_at: np.ndarray
    fits: int = 0
    count: int = 0

    @classmethod
    def begin(
        cls, sky: np.ndarray, working: Working, network: np.ndarray | None = None
    ) -> Painting:
        """Start from a map and the network's probability, both (h, w) of any size."""
        height, width = shrink(working.bytes, SIDE).shape[:2]
        start = resize(sky, width, height) > 0.5
        probability = resize(sky if network is None else network, width, height)
        nothing = np.full(start.shape, -1, np.int8)
        return cls(start, start, nothing, np.asarray(probability, np.float32), start)

    def stroke(self, stroke: Stroke, working: Working) -> Painting:
        """Return the painting after one more stroke; deterministic.

        A stroke acts on pixels that are similar to those under it, connected to them, and wrongly
        labeled. All other pixels keep their label.
        """
        image = shrink(working.bytes, SIDE)
        sky, said = _stroked(image, self.sky, self.said, self.network, stroke)
        count = self.count + 1
        none = not self.looked_at.any() and sky.any()
        if none or np.mean(sky != self.looked_at) > MUCH:
            return replace(self, sky=sky, said=said, looked_at=sky, fits=count, count=count)
        return replace(self, sky=sky, said=said, count=count)

    def on(self, decision: Decision) -> Decision:
        """Return a decision, which may be finer, with the changes of the strokes."""
        import cv2

        changed = (self.sky != self.start).astype(np.uint8)
        if not changed.any():
            return decision
        rows, columns = decision.sky.shape
        new = resize(self.sky.astype(np.float32), columns, rows)
        inside = resize(changed.astype(np.float32), columns, rows) > 0.5
        edge = cv2.morphologyEx(changed, cv2.MORPH_GRADIENT, np.ones((3, 3), np.uint8))
        unsure = resize(edge.astype(np.float32), columns, rows) > 0.25
        confidence = np.where(inside, 1, decision.confidence)
        confidence = np.where(unsure, np.minimum(confidence, 0.05), confidence)
        sky = np.where(inside, new, decision.sky)
        return decision._replace(
            sky=sky.astype(np.float32), confidence=confidence.astype(np.float32)
        )


def _stroked(
    image: np.ndarray, sky: np.ndarray, said: np.ndarray, network: np.ndarray, stroke: Stroke
) -> tuple[np.ndarray, np.ndarray]:
    """Return the sky and the labels after a stroke on a picture (h, w, 3) uint8."""
    import cv2

    height, width = sky.shape
    under = paint(stroke, width, height)
    if not under.any():
        return sky, said
    wanted = stroke.label == "sky"
    said = np.where(under, np.int8(wanted), said)
    lab = cv2.cvtColor(image, cv2.COLOR_RGB2LAB).astype(np.float32)
    # The network's confidence in the label that the stroke contradicts.
    belief = 1 - network if wanted else network
    against = said == 1 - wanted
    candidates = ((sky != wanted) & ~against) | under
    region = _alike(lab, under, candidates, belief, against) | _island(candidates, under)
    labels = np.where(sky, cv2.GC_FGD, cv2.GC_BGD).astype(np.uint8)
    labels[region] = cv2.GC_PR_FGD if wanted else cv2.GC_PR_BGD
    labels[said == 1], labels[said == 0] = cv2.GC_FGD, cv2.GC_BGD
    # The color models would return a wrongly labeled wall to the sky from which they learned it.
    # Therefore similar pixels that touch the brush follow it.
    sky = np.where(region, wanted, sky)
    after = _cut_near(image, labels, region | under)
    rim = cv2.dilate(region.astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    sky = np.where(rim & ~region & (after == wanted), wanted, sky)
    sky[said == 1], sky[said == 0] = True, False
    return sky, said


def _cut_near(image: np.ndarray, labels: np.ndarray, region: np.ndarray) -> np.ndarray:
    """Run GrabCut in the region's box with a margin; elsewhere the labels stay."""
    rows, columns = np.nonzero(region)
    margin = 24  # px of the small copy: enough of both sides for the color models
    box = (
        slice(max(int(rows.min()) - margin, 0), int(rows.max()) + margin + 1),
        slice(max(int(columns.min()) - margin, 0), int(columns.max()) + margin + 1),
    )
    sky = (labels == 1) | (labels == 3)  # GC_FGD, GC_PR_FGD
    sky[box] = cut(np.ascontiguousarray(image[box]), labels[box], iterations=1)
    return sky


def _alike(
    lab: np.ndarray,
    under: np.ndarray,
    candidates: np.ndarray,
    belief: np.ndarray,
    against: np.ndarray,
) -> np.ndarray:
    """Return the pixels that are connected to the brush through candidates of similar color.

    A pixel is similar if its color is nearer to the brush than to pixels that stay: surrounding
    candidates of which the network is surer than of those under the brush, and pixels that earlier
    strokes labeled ``against`` this one. The surer the network, the nearer a pixel must be. If
    brush and surroundings have the same color, a tolerance decides that falls to zero with the
    distance from the brush: a dab fixes a patch, a long stroke a house, and a stroke on a gray wall
    does not leak into a gray sky.
    """
    import cv2

    lab = cv2.GaussianBlur(lab, (0, 0), 0.6)
    # In a dark or hazy photo the same difference is more significant.
    tolerance = float(np.clip(0.25 * lab[..., 0].std(), 4, TOLERANCE))
    away = cv2.distanceTransform((~under).astype(np.uint8), cv2.DIST_L2, 3)
    rows, columns = np.nonzero(under)
    extent = math.hypot(np.ptp(rows) + 1, np.ptp(columns) + 1)
    breadth = rows.size / extent
    # A fine brush is for fine work, even with a long stroke.
    reach = min(4 * extent, 8 * breadth, breadth**2 + 4, REACH * max(under.shape))
    near = candidates & (away < reach)
    to_brush = _nearest(lab, near, lab[under], 24)
    # Distance to the nearest of a few colors, so that a stroke over a brick wall covers bricks
    # and mortar.
    to_rest = _nearest(lab, near, lab[against & (away < reach)], 24)
    covered = max(float(np.median(belief[under])), 0.6)
    sure = np.zeros_like(belief)
    if covered < 0.97:  # otherwise the network is sure of wrong labels, and no evidence
        stays = near & (belief > max(0.5 + 0.5 * covered, 0.9)) & (away > 3)
        to_rest = np.minimum(to_rest, _nearest(lab, near, lab[stays], 48))
        sure = np.clip(1.2 * (belief - covered) / (1 - covered), 0, 1)
    distinct = (to_brush * (0.9 + 2 * sure) < to_rest) & (to_brush < 2 * tolerance)
    distinct &= np.isfinite(to_rest)
    fade = np.clip(1 - away / min(1.5 * extent, reach), 0, 1)
    like = distinct | (to_brush < tolerance * fade * (1 - sure))
    like = (like & near) | under
    _, labels = cv2.connectedComponents(like.astype(np.uint8), connectivity=8)
    found = np.zeros(int(labels.max()) + 1, bool)
    found[labels[under]] = True
    return np.asarray(found[labels])


def _island(candidates: np.ndarray, under: np.ndarray) -> np.ndarray:
    """Return the patch of candidates under the brush if it is an island of any colors.

    An island is small relative to the picture and not much larger than the brush; a neck of 2 px
    does not connect it to the mainland.
    """
    import cv2

    kernel = np.ones((3, 3), np.uint8)
    firm = cv2.erode(candidates.astype(np.uint8), kernel, borderValue=1)
    count, labels = cv2.connectedComponents(firm, connectivity=4)
    covered = np.bincount(labels[under], minlength=count)
    area = np.bincount(labels.ravel(), minlength=count)
    small = area < np.minimum(ISLAND * under.size, 12 * covered)
    small[0] = False
    return (cv2.dilate(small[labels].astype(np.uint8), kernel) > 0) & candidates


def _nearest(lab: np.ndarray, where: np.ndarray, colors: np.ndarray, most: int) -> np.ndarray:
    """Return each ``where`` pixel's distance (h, w) to the nearest of at most ``most`` colors."""
    distance = np.full(where.shape, np.inf, np.float32)
    if len(colors):
        samples = colors[:: -(-len(colors) // most)]
        flat = lab[where]
        squares = (flat**2).sum(axis=1)[:, None] - 2 * flat @ samples.T + (samples**2).sum(axis=1)
        distance[where] = np.sqrt(np.maximum(squares.min(axis=1), 0))
    return distance
