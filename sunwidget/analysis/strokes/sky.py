"""Strokes: a person says *sky* or *not sky*, and the map follows (thesis 3.1.1.2).

Strokes are replayed in order on a small copy. What they make of it depends on the map they begin
with and on the strokes alone, so a ``Painting`` may be kept and painted on.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from sunwidget.analysis.images.working_copy import Working, resize, shrink
from sunwidget.analysis.segmentation.refine import SIDE, Decision, cut
from sunwidget.analysis.strokes.brush import paint
from sunwidget.edit.table import Stroke

TOLERANCE = 14.0  # of 8-bit Lab, beside the brush where the network is in doubt
REACH = 0.4  # of the longer side: no stroke acts farther than that
ISLAND = 0.03  # of the picture: larger patches are not flipped as a whole
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
    network : (h, w) float32
        The network's probability of sky.
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
    network: np.ndarray
    looked_at: np.ndarray
    fits: int = 0
    count: int = 0

    @classmethod
    def begin(
        cls, sky: np.ndarray, working: Working, network: np.ndarray | None = None
    ) -> Painting:
        """Start from a map, with what the network says, both (h, w) of any size."""
        height, width = shrink(working.bytes, SIDE).shape[:2]
        start = resize(sky, width, height) > 0.5
        probability = resize(sky if network is None else network, width, height)
        nothing = np.full(start.shape, -1, np.int8)
        return cls(start, start, nothing, np.asarray(probability, np.float32), start)

    def stroke(self, stroke: Stroke, working: Working) -> Painting:
        """Return the painting after one more stroke; deterministic.

        A stroke acts on what is like the pixels under it, connected to them, and wrongly
        labelled: everything else keeps its label.
        """
        image = shrink(working.bytes, SIDE)
        sky, said = _stroked(image, self.sky, self.said, self.network, stroke)
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


def _stroked(
    image: np.ndarray, sky: np.ndarray, said: np.ndarray, network: np.ndarray, stroke: Stroke
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
    # How sure the network is of what the stroke contradicts.
    belief = 1 - network if wanted else network
    against = said == 1 - wanted
    candidates = ((sky != wanted) & ~against) | under
    region = _alike(lab, under, candidates, belief, against) | _island(candidates, under)
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


def _alike(
    lab: np.ndarray,
    under: np.ndarray,
    candidates: np.ndarray,
    belief: np.ndarray,
    against: np.ndarray,
) -> np.ndarray:
    """Return what is connected to the brush through candidates of like colour.

    Like is what is nearer in colour to the brush than to what stays: the candidates round about
    of which the network is surer than of what the brush covers, and what strokes said
    ``against`` this one. The surer it is, the nearer to the brush a pixel has to be. Where brush
    and surroundings have one colour, a tolerance decides that falls to nothing with the distance
    from the brush: a dab fixes a patch, a long stroke a house, and none on a grey wall leaks into
    all of a grey sky.
    """
    import cv2

    lab = cv2.GaussianBlur(lab, (0, 0), 0.6)
    # In a dark or hazy photo the same difference means more.
    tolerance = float(np.clip(0.25 * lab[..., 0].std(), 4, TOLERANCE))
    away = cv2.distanceTransform((~under).astype(np.uint8), cv2.DIST_L2, 3)
    rows, columns = np.nonzero(under)
    extent = math.hypot(np.ptp(rows) + 1, np.ptp(columns) + 1)
    breadth = rows.size / extent
    # A fine brush is for fine work, however long its stroke.
    reach = min(4 * extent, 8 * breadth, breadth**2 + 4, REACH * max(under.shape))
    near = candidates & (away < reach)
    to_brush = _nearest(lab, near, lab[under], 24)
    # Distance to the nearest of a few colours, so that a stroke over a brick wall takes bricks
    # and mortar.
    to_rest = _nearest(lab, near, lab[against & (away < reach)], 24)
    covered = max(float(np.median(belief[under])), 0.6)
    sure = np.zeros_like(belief)
    if covered < 0.97:  # else it is sure of what is wrong, and tells nothing
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
    """Return the patch of candidates under the brush when it is an island, whatever its colours.

    Small against the picture and not much larger than the brush; a neck of 2 px ties no island
    to the mainland.
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


def _nearest(lab: np.ndarray, where: np.ndarray, colours: np.ndarray, most: int) -> np.ndarray:
    """Distance (h, w) of each pixel of ``where`` to the nearest of at most ``most`` colours."""
    distance = np.full(where.shape, np.inf, np.float32)
    if len(colours):
        samples = colours[:: -(-len(colours) // most)]
        flat = lab[where]
        squares = (flat**2).sum(axis=1)[:, None] - 2 * flat @ samples.T + (samples**2).sum(axis=1)
        distance[where] = np.sqrt(np.maximum(squares.min(axis=1), 0))
    return distance
