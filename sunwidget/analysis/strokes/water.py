"""Strokes that label pixels *water* or *not water*, replayed on a small copy after sky strokes.

They change only the water: the sky, and everything that depends on it, stays. The result depends
only on the scene's maps and the strokes.
"""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING

import numpy as np

from sunwidget.analysis.horizon import horizon
from sunwidget.analysis.images.working_copy import resize, shrink
from sunwidget.analysis.memory import Memory
from sunwidget.analysis.segmentation.refine import SIDE
from sunwidget.analysis.strokes.brush import paint, set_strokes
from sunwidget.analysis.water.water import soft_edged

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.edit.table import Stroke

LABELS = ("water", "not_water")
TOLERANCE = 12.0  # of 8-bit Lab around the colors under the brush
REACH = 0.25  # of the longer side: greatest distance at which a stroke acts


def with_water(base: Scene, scene: Scene, strokes: tuple[Stroke, ...]) -> Scene:
    """Return ``scene`` with the water strokes among ``strokes`` applied.

    Parameters
    ----------
    base : Scene
        The scene without strokes.
    scene : Scene
        The base with the sky strokes among ``strokes`` applied.
    strokes : tuple of Stroke
        All strokes in order.
    """
    ours = tuple(stroke for stroke in strokes if stroke.label in LABELS)
    width, height = scene.working.width, scene.working.height
    image = shrink(scene.working.bytes, SIDE)
    size = image.shape[1], image.shape[0]
    start = resize(scene.small_water, *size) > 0.5
    ground = (resize(scene.small_sky, *size) < 0.5) & horizon.below(scene.camera, *size)
    water = start.copy()
    said = np.full(start.shape, -1, np.int8)
    for stroke in ours:
        water, said = _stroked(image, ground, water, said, stroke)
    changed = resize((water != start).astype(np.float32), width, height)
    result = np.array(scene.water)
    if changed.any():
        fine = soft_edged(scene.working, scene.small_sky, water.astype(np.float32))
        near = _around(changed, scene.photo.size)
        result += near * (resize(fine, *scene.photo.size) - result)
    set_strokes(result, ours)
    return dataclasses.replace(
        scene,
        water_map=np.clip(np.minimum(result, 1 - scene.sky), 0, 1).astype(np.float32),
        hints=dataclasses.replace(scene.hints, strokes=strokes),
        unstroked=base,
        memory=Memory(),
    )


def _around(changed: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Extend a map at working size by the width of its soft edge, at the photo's size."""
    import cv2

    spread = cv2.dilate(changed, np.ones((15, 15), np.uint8))
    return np.clip(resize(cv2.blur(spread, (7, 7)), *size), 0, 1)


def _stroked(
    image: np.ndarray, ground: np.ndarray, water: np.ndarray, said: np.ndarray, stroke: Stroke
) -> tuple[np.ndarray, np.ndarray]:
    """Return water and labels after one more stroke on a picture (h, w, 3) uint8.

    A stroke affects pixels under it, and connected pixels of similar color with another label.
    Water grows along its streaks and only below the horizon.
    """
    import cv2

    height, width = water.shape
    under = paint(stroke, width, height)
    if not under.any():
        return water, said
    wanted = stroke.label == "water"
    said = np.where(under, np.int8(wanted), said)
    candidates = (water != wanted) & (said != 1 - wanted)
    candidates &= ground if wanted else True
    # Waves average out along rows; rocks and shores do not.
    lab = cv2.cvtColor(image, cv2.COLOR_RGB2LAB).astype(np.float32)
    lab = cv2.GaussianBlur(lab, (0, 0), 3.0, sigmaY=1.0)
    colors = lab[under]
    colors = colors[:: -(-len(colors) // 32)]
    squares = (lab**2).sum(axis=-1)[..., None] - 2 * lab @ colors.T + (colors**2).sum(axis=1)
    distance = np.sqrt(np.maximum(squares.min(axis=-1), 0))
    rows, columns = np.nonzero(under)
    extent = math.hypot(np.ptp(rows) + 1, np.ptp(columns) + 1)
    reach = min(3 * extent, REACH * max(width, height))
    away = cv2.distanceTransform((~under).astype(np.uint8), cv2.DIST_L2, 3)
    like = candidates & (distance < TOLERANCE * np.clip(1.5 - away / reach, 0, 1)) | under
    _, labels = cv2.connectedComponents(like.astype(np.uint8), connectivity=8)
    found = np.zeros(int(labels.max()) + 1, bool)
    found[labels[under]] = True
    region = found[labels] & like
    return np.where(region, wanted, water), said
