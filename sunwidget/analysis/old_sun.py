"""Where the old sun hides the sky: its burnt core, the halo round it, and its star's rays."""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.working import smoothstep

_LARGEST_HALO = 22.0  # degrees; what is wider is sky or cloud
_LEAST_HALO = 6.0  # degrees, round a sun that burnt nothing
_ANGLES = 256  # of the polar picture
_RAY_WIDTH = 0.1  # of the longer side, at most


def largest_halo(white: np.ndarray, sky: np.ndarray, angle: np.ndarray) -> float:
    """Degrees from the sun within which glare is looked for: the more, the more is burnt.

    Parameters
    ----------
    white : (h, w) float32
        Where the photo is burnt, [0, 1].
    sky : (h, w) float32
        Matte.
    angle : (h, w) float32
        Degrees from the sun.
    """
    burnt = 0.0
    for inner in np.arange(0.0, _LARGEST_HALO, 0.5):
        ring = (angle >= inner) & (angle < inner + 0.5) & (sky > 0.9)
        if ring.sum() < 8:
            continue
        if white[ring].mean() < 0.3:
            break
        burnt = inner + 0.5
    return float(min(_LARGEST_HALO, _LEAST_HALO + 5 * burnt))


def old_sun_mark(
    residual: np.ndarray, white: np.ndarray, sky: np.ndarray, angle: np.ndarray
) -> np.ndarray:
    """Weight of the old sun's burnt core and of the halo that the model does not explain.

    (h, w) float32 in [0, 1]; the arguments are those of ``largest_halo``, and ``residual``, the
    log light of photo over what is expected of the sky.
    """
    import cv2

    reach = largest_halo(white, sky, angle)
    rings = np.arange(0.0, min(reach, float(angle.max())) + 0.5, 0.5)
    which = np.clip((angle / 0.5).astype(int), 0, len(rings) - 1)
    usable = (sky > 0.9) & (white < 0.5)
    profile = np.full(len(rings), np.nan)
    burnt = np.zeros(len(rings))
    for index in range(len(rings)):
        inside = (which == index) & (sky > 0.9)
        if inside.sum() >= 8:
            burnt[index] = white[inside].mean()
            if (inside & usable).sum() >= 8:
                profile[index] = np.quantile(residual[inside & usable], 0.35)
    known = np.isfinite(profile)
    if known.sum() >= 4:
        level = np.nanmedian(profile[len(rings) // 3 :]) if known[len(rings) // 3 :].any() else 0.0
        excess = np.interp(rings, rings[known], profile[known]) - level
    else:
        excess = np.zeros(len(rings))
    # The halo ends where the excess first falls under a twelfth of a stop; the core is burnt.
    halo = np.maximum(smoothstep(0.06, 0.3, excess), smoothstep(0.05, 0.5, burnt))
    halo[:2] = 1.0
    ended = np.flatnonzero(halo < 0.02)
    if ended.size:
        halo[ended[0] :] = 0.0
    # Bloom reaches well past the burnt core, and a fill that starts inside it would keep a ghost.
    core = max(0.5 * np.count_nonzero(burnt > 0.3), 0.4)
    halo = np.maximum(halo, 1 - smoothstep(1.5 * core, 4.0 * core + 0.5, rings))
    halo *= 1 - smoothstep(0.6 * reach, reach, rings)
    radial = np.interp(angle, rings, halo).astype(np.float32)
    # Burnt pixels that touch the halo belong to it, whatever their shape.
    burnt_out = (white > 0.5) & (sky > 0.3)
    labels = cv2.connectedComponents(burnt_out.astype(np.uint8))[1]
    touched = np.unique(labels[burnt_out & (radial > 0.3)])
    mine = np.isin(labels, touched[touched > 0]).astype(np.float32)
    size = max(3, round(0.02 * max(sky.shape))) | 1
    mine = cv2.GaussianBlur(cv2.dilate(mine, np.ones((size, size), np.uint8)), (0, 0), size / 3)
    # A burnt cloud that reaches out of the halo is a cloud there.
    mine *= smoothstep(0.0, 0.3, radial)
    return np.clip(np.maximum(radial, mine), 0, 1).astype(np.float32)


def starburst(residual: np.ndarray, sky: np.ndarray, centre: tuple[float, float]) -> np.ndarray:
    """Weight of the rays that a lens' aperture draws round the sun, (h, w) float32 in [0, 1].

    Rays are narrow, start at the core and only fade outwards; a cloud begins somewhere. So, in
    polar coordinates: what rises over the sky on both sides, and its least value on the way out.

    Parameters
    ----------
    residual : (h, w) float32
        log luminance of photo over model.
    sky : (h, w) bool
        Where it means something.
    centre : (x, y)
        The sun's pixel.
    """
    import cv2
    from scipy.ndimage import percentile_filter

    height, width = residual.shape
    side = max(height, width)
    reach = round(0.5 * side)
    turn = (np.arange(_ANGLES) + 0.5) * (2 * np.pi / _ANGLES)
    radius = np.arange(1, reach + 1, dtype=np.float64)[:, None]
    x = (centre[0] + radius * np.cos(turn) - 0.5).astype(np.float32)
    y = (centre[1] + radius * np.sin(turn) - 0.5).astype(np.float32)

    def polar(image: np.ndarray) -> np.ndarray:
        return cv2.remap(
            image.astype(np.float32), x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT
        )

    seen = polar(sky)
    level = polar(residual * sky) / np.maximum(seen, 0.5)
    over = np.zeros_like(level)
    for row in range(reach):
        known = seen[row] > 0.5
        if not known.any():
            continue
        level[row, ~known] = np.median(level[row, known])
        # A window wider than a ray: its darker third is the sky beside it.
        window = min(
            _ANGLES // 2, round(2.5 * _RAY_WIDTH * side / (row + 1) / (2 * np.pi) * _ANGLES)
        )
        over[row] = level[row] - percentile_filter(level[row], 35, max(window, 3), mode="wrap")
    over = cv2.GaussianBlur(np.where(seen > 0.5, over, 0), (0, 0), sigmaX=1.0, sigmaY=2.0)
    core = seen[: max(3, reach // 3)] < 0.5  # burnt: no ray ends there
    over[: len(core)] = np.where(core, np.inf, over[: len(core)])
    outwards = np.minimum.accumulate(over, axis=0)
    # A ray is far brighter than the sky where it leaves the core; lanes between clouds are not.
    root = np.max(np.where(np.isfinite(outwards), outwards, 0), axis=0)
    outwards = np.where(np.isfinite(outwards), outwards, 1)
    strength = smoothstep(0.04, 0.2, outwards) * smoothstep(0.06, 0.2, root)
    columns, rows = np.arange(width) + 0.5 - centre[0], np.arange(height)[:, None] + 0.5 - centre[1]
    distance = np.hypot(columns, rows)
    angle = np.arctan2(rows, columns) / (2 * np.pi) * _ANGLES - 0.5
    # The first column again after the last: the circle is closed.
    closed = np.concatenate([strength[:, -1:], strength, strength[:, :1]], axis=1)
    found = cv2.remap(
        closed.astype(np.float32),
        (np.mod(angle, _ANGLES) + 1).astype(np.float32),
        np.broadcast_to(distance - 1, distance.shape).astype(np.float32),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_CONSTANT,
    )
    fade = 1 - smoothstep(0.75 * reach, 0.95 * reach, distance)
    return np.asarray(np.clip(found * fade * sky, 0, 1), np.float32)
