"""Water: level surfaces below the horizon that mirror the sky.

``METHODS`` maps a name to a function ``(Working, sky, Horizon) -> (h, w) float32``; the horizon is
in working pixels. What a mirror of the sky looks like, pixel by pixel, is in ``water_look``.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sunwidget.analysis.horizon import Horizon
from sunwidget.analysis.water_look import Look
from sunwidget.analysis.working import Working, resize, smoothstep

_RADIUS = 5  # px of the working copy: how far the edge of the mask follows the picture
_EPSILON = 1e-4


def none(working: Working, sky: np.ndarray, horizon: Horizon) -> np.ndarray:
    """Call nothing water."""
    return np.zeros_like(sky)


def streaks(working: Working, sky: np.ndarray, horizon: Horizon) -> np.ndarray:
    """Find open water: streaked along the horizon, and coloured as the sky mirrored in it.

    All or nothing, since a meadow that glitters is worse than a sea that does not: the horizon
    has to be seen as a straight edge over what looks like water, wide enough, and the water must
    not be yellower than the sky it mirrors, as earth is (water's own light is blue and green).

    Parameters
    ----------
    working : Working
        The small photo.
    sky : (h, w) float32
        Sky matte at its size.
    horizon : Horizon
        In its pixels.

    Returns
    -------
    (h, w) float32
        Share of water in a pixel, [0, 1]; zero everywhere when there is none to be sure of.
    """
    nothing = np.zeros_like(sky)
    if min(sky.shape) < 24 or not 0.05 * sky.shape[0] < horizon.row < 0.97 * sky.shape[0]:
        return nothing
    look = Look.of(working, sky, horizon)
    if _belief(look, horizon) < 0.5:
        return nothing
    return soft_edged(working, sky, look.unrolled(_extent(look)))


METHODS: dict[str, Callable[[Working, np.ndarray, Horizon], np.ndarray]] = {
    "none": none,
    "streaks": streaks,
}


def _belief(look: Look, horizon: Horizon) -> float:
    """How sure it is that there is water at all, [0, 1]."""
    import cv2

    height = look.land.shape[0]
    sure = cv2.GaussianBlur(look.likeness, (0, 0), 1.5) > 0.5
    row = int(np.clip(round(look.row), 4, height - 4))
    first = min(row + int(0.03 * height) + 2, height - 2)
    columns = sure[first : first + max(2, int(0.04 * height))].mean(axis=0) > 0.5
    columns &= look.land[max(row - int(0.05 * height) - 2, 0) : row - 2].mean(axis=0) < 0.5
    near = sure.copy()
    near[row + int(0.15 * height) :] = False
    if not columns.any() or not near.any():
        return 0.0
    # A horizon that was only assumed has to prove itself by a clean edge; what glitters may
    # hide it, and what a person set need not show.
    doubt = float(1 - smoothstep(0.2, 0.45, horizon.confidence))
    glints = look.glints()
    given = float(horizon.source == "hint")
    edge = 0.755 + 0.06 * doubt - 0.12 * glints - 0.2 * given
    blue = -0.14 - 0.15 * glints - 0.1 * given
    width = 0.12 + 0.22 * doubt * (1 - glints)
    return float(
        smoothstep(edge, edge + 0.06, look.edge_strength(columns))
        * smoothstep(width, width + 0.08, columns.mean())
        * smoothstep(0.008, 0.02, sure.mean())
        * smoothstep(blue, blue + 0.08, float(np.median(look.tint[near])))
    )


def _extent(look: Look) -> np.ndarray:
    """Where the water is, in the look's pixels: (h, w) float32, 0 or 1.

    What looks like water, and what is connected to it without being a rock (rough, and darker
    than the water of its row), earth (yellower than the sky) or upright: so glints, foam and
    calm dark shallows are water too.
    """
    import cv2

    height, width = look.land.shape
    sure = cv2.GaussianBlur(look.likeness, (0, 0), 1.0) > 0.5
    light = cv2.GaussianBlur(look.light, (0, 0), 1.2)
    plain = look.glint_columns < 0.4  # away from the glints
    level = _level(light[:, plain], sure[:, plain]) if plain.any() else _level(light, sure)
    rock = smoothstep(0.5, 1.0, level[:, None] - light) * smoothstep(0.05, 0.1, look.roughness)
    # The horizon itself is an edge, too.
    rock *= np.clip((np.arange(height) - look.row) / 8, 0, 1)[:, None].astype(np.float32)
    # The trough of a wave is as dark and as sharp, but not as high.
    rock = cv2.morphologyEx(rock, cv2.MORPH_OPEN, np.ones((max(3, height // 20), 3), np.uint8))
    row = int(np.clip(round(look.row), 0, height - 2))
    first = sure[row : row + max(3, int(0.06 * height))]
    shade = np.median(look.earthiness[row : row + len(first)][first]) if first.any() else 0.0
    earth = smoothstep(0.1, 0.2, look.earthiness - max(float(shade), 0.0))
    # A red evening sky is mirrored redder still; what is brighter than the water then is no earth.
    evening = smoothstep(0.5, 1.2, look.redness_of_sky())
    earth = earth * (1 - evening * smoothstep(-0.9, -0.4, light - level[:, None]))
    open_water = (1 - rock) * (1 - earth) * look.streaks * look.land
    below = (np.arange(height) + 0.5 > look.row)[:, None]
    candidates = (sure | (open_water > 0.5)) & (rock < 0.5) & (earth < 0.5) & below
    candidates = cv2.morphologyEx(candidates.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((3, 7)))
    candidates = cv2.morphologyEx(candidates, cv2.MORPH_OPEN, np.ones((3, 5)))
    count, labels, stats, _ = cv2.connectedComponentsWithStats(candidates, connectivity=4)
    area = stats[:, cv2.CC_STAT_AREA]
    certain = np.bincount(labels[sure], minlength=count) / area
    kept = (area >= 0.01 * width * height) & (certain > 0.3)
    kept[0] = False
    return _by_neighbours(
        look,
        _without_holes(kept[labels], below, rock > 0.5, light > level[:, None]),
        below & (look.land > 0.5),
    )


def _by_neighbours(look: Look, water: np.ndarray, ground: np.ndarray) -> np.ndarray:
    """Redraw the border: texture is blurred over several pixels, colours are sharp.

    Near the border a pixel is what its colour is nearer to: the water's beside it or the other's.
    """
    import cv2

    core = np.ones((9, 9), np.uint8)  # what texture blurs over
    inside = cv2.erode(water, core)
    outside = cv2.erode(ground * (1 - water).astype(np.float32), core)
    lab = cv2.cvtColor(look.encoded, cv2.COLOR_RGB2LAB)

    def mean(weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        around = (31, 15)
        total = cv2.blur(weight, around)
        return cv2.blur(lab * weight[..., None], around) / np.maximum(total, 1e-4)[..., None], total

    of_water, near_water = mean(inside)
    of_other, near_other = mean(outside)
    nearer = np.linalg.norm(lab - of_water, axis=-1) < np.linalg.norm(lab - of_other, axis=-1)
    both = (near_water > 0.01) & (near_other > 0.01)
    unsure = ground & (inside < 0.5) & (outside < 0.5)
    result = np.where(unsure & both, nearer, water > 0.5).astype(np.uint8)
    return np.asarray(cv2.medianBlur(result, 3), np.float32)


def _without_holes(
    water: np.ndarray, below: np.ndarray, rock: np.ndarray, bright: np.ndarray
) -> np.ndarray:
    """Fill what water and the horizon surround: glints, foam, mirrored shores; no rocks.

    Of rocks only what is no larger than a wave.
    """
    import cv2

    holes = ~water & below
    count, labels, stats, _ = cv2.connectedComponentsWithStats(holes.astype(np.uint8))
    height, width = water.shape
    left, top = stats[:, cv2.CC_STAT_LEFT], stats[:, cv2.CC_STAT_TOP]
    right = left + stats[:, cv2.CC_STAT_WIDTH]
    bottom = top + stats[:, cv2.CC_STAT_HEIGHT]
    far = int(np.argmax(below.any(axis=1))) + 2  # rows that touch the horizon
    area = stats[:, cv2.CC_STAT_AREA]
    # Glints may lead from the horizon to the frame; a dark headland is none.
    shining = np.bincount(labels[bright], minlength=count) / area > 0.6
    inside = (left > 0) & (right < width)
    rocky = np.bincount(labels[rock], minlength=count) / area > np.where(bottom < height, 0.3, 0.15)
    filled = inside & (
        area < np.where(rocky, 0.005, np.where((top > far) | shining, 0.12, 0.03)) * water.size
    )
    filled[0] = False
    return np.asarray(water | filled[labels], np.float32)


def _level(light: np.ndarray, sure: np.ndarray) -> np.ndarray:
    """Log luminance of the water in each row: (h,).

    A high quantile: rocks, piers and boats are darker, and it is water's as long as some water
    is seen in the row.
    """
    import cv2

    height = len(light)
    rows = np.flatnonzero(sure.mean(axis=1) > 0.04)
    if not rows.size:
        return np.full(height, -np.inf, np.float32)
    known = [float(np.quantile(light[row][sure[row]], 0.75)) for row in rows]
    level = np.interp(np.arange(height), rows, known).astype(np.float32)
    # Water darkens slowly towards the viewer: a pier that fills most of a row does not count.
    fall = 0.9 * np.arange(height, dtype=np.float32) / (height - rows[0])
    level = np.maximum.accumulate(level + fall) - fall
    return cv2.GaussianBlur(level[:, None], (0, 0), 0.1, sigmaY=0.03 * height).ravel()


def soft_edged(working: Working, sky: np.ndarray, water: np.ndarray) -> np.ndarray:
    """Give a mask of any size edges that follow the picture (guided filter, He et al. 2013).

    Returns
    -------
    (h, w) float32
        At working size, [0, 1], nothing of it in the sky.
    """
    import cv2

    rough = resize(water, working.width, working.height).astype(np.float32)
    guide = np.sqrt(np.clip(working.luminance, 0, 1)).astype(np.float32)

    def mean(image: np.ndarray) -> np.ndarray:
        return cv2.blur(image, (2 * _RADIUS + 1, 2 * _RADIUS + 1), borderType=cv2.BORDER_REFLECT)

    middle, share = mean(guide), mean(rough)
    slope = (mean(guide * rough) - middle * share) / (mean(guide * guide) - middle**2 + _EPSILON)
    fine = mean(slope) * guide + mean(share - slope * middle)
    return np.clip(1.5 * (fine - 0.5) + 0.5, 0, 1).astype(np.float32) * (1 - sky)
