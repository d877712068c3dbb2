"""Drawn training material: skies, trees, wires and masts with exact masks, rooms without sky."""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np

Random = np.random.Generator


def gradient_sky(size: int, random: Random) -> np.ndarray:
    """A sky from noon over sunset to night, at times stars or a moon; ``(S, S, 3)`` uint8 sRGB."""
    palettes = (
        ((60, 110, 190), (190, 215, 235)),  # noon
        ((40, 60, 120), (250, 170, 90)),  # sunset
        ((90, 70, 120), (245, 130, 110)),  # pink dusk
        ((10, 20, 55), (60, 90, 150)),  # blue hour
        ((4, 6, 14), (25, 25, 40)),  # night
        ((20, 15, 15), (120, 75, 40)),  # city glow
        ((170, 175, 180), (220, 222, 225)),  # overcast
    )
    top, bottom = (np.array(c, np.float32) for c in palettes[random.integers(len(palettes))])
    ramp = np.linspace(0, 1, size, dtype=np.float32)[:, None, None] ** np.float32(
        random.uniform(0.6, 2.0)
    )
    sky = np.repeat(top * (1 - ramp) + bottom * ramp, size, 1) * np.exp(
        random.normal(0, 0.07, 3)
    ).astype(np.float32)
    sideways = np.linspace(-1, 1, size, dtype=np.float32)[None, :, None] * np.float32(
        random.normal(0, 0.15)
    )
    sky = sky * (1 + sideways)
    if random.random() < 0.5:
        sky += clouds(size, random)[..., None] * random.uniform(-0.5, 0.8) * (40 + sky.mean())
    if sky.mean() < 70 and random.random() < 0.5:
        for _ in range(int(random.integers(5, 120))):
            sky[random.integers(size), random.integers(size)] += random.uniform(30, 200)
    if random.random() < 0.15:
        centre = (int(random.integers(size)), int(random.integers(size)))
        cv2.circle(
            sky,
            centre,
            int(random.integers(1, max(2, size // 20))),
            (250, 245, 230),
            -1,
            cv2.LINE_AA,
        )
    return np.clip(sky, 0, 255).astype(np.uint8)


def clouds(size: int, random: Random) -> np.ndarray:
    """Fractal noise in about [0, 1], ``(S, S)`` float32, stretched sideways as clouds are."""
    total = np.zeros((size, size), np.float32)
    for octave in range(2, 6):
        noise = random.random((2**octave + 1, 2 ** (octave - 1) + 1), np.float32)
        total += cv2.resize(noise, (size, size), interpolation=cv2.INTER_CUBIC) / 2 ** (octave - 2)
    return np.clip(total - random.uniform(0.6, 1.2), 0, 1)


def _branch(
    canvas: np.ndarray,
    at: np.ndarray,
    angle: float,
    length: float,
    width: float,
    depth: int,
    random: Random,
) -> None:
    """Draws a branch and its children, 16 sub-pixel steps per pixel."""
    end = at + length * np.array([np.cos(angle), -np.sin(angle)])
    pixels = max(1, round(width))
    ends = [tuple(int(v * 16) for v in p) for p in (at, end)]
    cv2.line(canvas, ends[0], ends[1], 255.0 * min(1.0, max(width, 0.25)), pixels, cv2.LINE_AA, 4)
    if depth == 0:
        return
    for _ in range(int(random.integers(2, 4))):
        turn = angle + random.normal(0, 0.5)
        _branch(
            canvas, end, turn, length * random.uniform(0.6, 0.85), width * 0.65, depth - 1, random
        )


def draw_thin_things(
    image: np.ndarray, target: np.ndarray, random: Random
) -> tuple[np.ndarray, np.ndarray]:
    """Bare trees, wires, a lattice mast or a wheel over image and mask; same shapes, uint8."""
    size = image.shape[0]
    cover = np.zeros((size, size), np.uint8)
    kind = random.random()
    if kind < 0.5:
        for _ in range(int(random.integers(1, 4))):
            at = np.array([random.uniform(0, size), random.uniform(0.6, 1.1) * size])
            length = size * random.uniform(0.1, 0.28)
            _branch(
                cover,
                at,
                np.pi / 2 + random.normal(0, 0.15),
                length,
                size / random.uniform(30, 90),
                6,
                random,
            )
    elif kind < 0.8:
        for _ in range(int(random.integers(1, 7))):
            y0, y1 = random.uniform(-0.1, 0.8, 2) * size
            t = np.linspace(0, 1, 24)
            y = y0 + (y1 - y0) * t + random.uniform(0, 0.1) * size * 4 * t * (1 - t)
            points = (np.stack([t * size, y], 1) * 16).astype(np.int32)
            cv2.polylines(
                cover,
                [points],
                False,
                float(random.uniform(120, 255)),
                int(random.integers(1, 3)),
                cv2.LINE_AA,
                4,
            )
    elif kind < 0.9:
        _mast(cover, random)
    else:
        _wheel(cover, random)
    dark = random.uniform(0, 90 if random.random() < 0.8 else 200) * np.exp(
        random.normal(0, 0.15, 3)
    )
    shade = (dark * (1 + 0.12 * random.standard_normal((size, size, 1)))).clip(0, 255)
    alpha = cover.astype(np.float32)[..., None] / 255.0
    drawn = image * (1 - alpha) + shade * alpha
    return drawn.astype(np.uint8), (target * (1 - alpha[..., 0])).astype(np.uint8)


def _mast(canvas: np.ndarray, random: Random) -> None:
    """A tapering lattice mast."""
    size = canvas.shape[0]
    x, foot, head = (
        random.uniform(0.1, 0.9) * size,
        random.uniform(0.5, 1.0) * size,
        random.uniform(0, 0.4) * size,
    )
    half, steps = size * random.uniform(0.02, 0.08), int(random.integers(4, 12))
    width = int(random.integers(1, 3))
    y = np.linspace(foot, head, steps)
    w = np.linspace(half, half * 0.2, steps)
    left, right = np.stack([x - w, y], 1), np.stack([x + w, y], 1)
    cross = np.empty((2 * steps, 2))
    cross[0::2], cross[1::2] = left, right
    other = np.empty((2 * steps, 2))
    other[0::2], other[1::2] = right, left
    for line in (left, right, cross, other):
        cv2.polylines(canvas, [(line * 16).astype(np.int32)], False, 255.0, width, cv2.LINE_AA, 4)


def _wheel(canvas: np.ndarray, random: Random) -> None:
    """A wheel of rims, spokes and cabins on a stand, more or less from the side."""
    size = canvas.shape[0]
    high = size * random.uniform(0.12, 0.4)
    radii = np.array([high * random.uniform(0.5, 1.0), high])
    hub = np.array([random.uniform(0.1, 0.9) * size, random.uniform(0.2, 0.8) * size])
    width, spokes = int(random.integers(1, 3)), int(random.integers(10, 40))
    around = np.linspace(0, 2 * np.pi, spokes, endpoint=False) + random.uniform(0, 1)
    tips = hub + radii * np.stack([np.cos(around), np.sin(around)], 1)
    feet = [hub + np.array([side * high * random.uniform(0.3, 0.7), size]) for side in (-1, 1)]

    def fixed(points: np.ndarray) -> np.ndarray:
        return np.round(points * 16).astype(np.int32)

    def line(start: np.ndarray, end: np.ndarray, level: float, wide: int) -> None:
        cv2.line(canvas, fixed(start), fixed(end), level, wide, cv2.LINE_AA, 4)

    level = float(random.uniform(100, 255))
    for tip in tips:
        line(hub, tip, level, 1)
    for share in (1.0, random.uniform(0.75, 0.95)):
        axes = fixed(radii * share)
        cv2.ellipse(canvas, fixed(hub), axes, 0, 0, 360, 255.0, width, cv2.LINE_AA, 4)
    for foot in feet:
        line(hub, foot, 255.0, width + 1)
    cabin = round(16 * high * random.uniform(0.0, 0.08))
    for tip in tips[:: int(random.integers(1, 3))]:
        cv2.circle(canvas, fixed(tip), cabin, 255.0, -1, cv2.LINE_AA, 4)


def surface(
    canvas: np.ndarray, corners: np.ndarray, random: Random, photo: Callable[[], np.ndarray]
) -> None:
    """Fills a polygon with a softly lit plain colour, or with foreground texture."""
    size = canvas.shape[0]
    if random.random() < 0.8:
        base = (random.uniform(60, 255) * np.exp(random.normal(0, 0.1, 3))).astype(np.float32)
        ramp = np.linspace(0, 1, size, dtype=np.float32)
        rows = (
            1
            - random.uniform(0, 0.6) * (ramp - random.random()) ** 2
            + random.normal(0, 0.2) * ramp
        )
        light = rows[:, None] - random.uniform(0, 0.6) * (ramp - random.random()) ** 2
        fill = base * light[..., None]
    else:
        source = photo()
        for _ in range(6):
            if (source[..., 3] > 0).mean() < 0.02:
                break
            source = photo()
        below = source[source.shape[0] // 2 :, :, :3]
        fill = cv2.resize(np.ascontiguousarray(below), (size, size)).astype(np.float32)
    inside = np.zeros((size, size), np.uint8)
    cv2.fillPoly(inside, [corners.astype(np.int32)], 255, cv2.LINE_AA)
    alpha = inside[..., None].astype(np.float32) / 255.0
    canvas[:] = canvas * (1 - alpha) + np.clip(fill, 0, 255) * alpha


def room(size: int, random: Random, photo: Callable[[], np.ndarray]) -> np.ndarray:
    """A box in perspective from inside, with lamps and furniture; ``(S, S, 3)`` uint8."""
    x0, x1 = np.sort(random.uniform(-0.2, 1.2, 2)) * size
    y0, y1 = random.uniform(-0.1, 0.4) * size, random.uniform(0.5, 1.1) * size
    far = 3.0 * size
    middle = np.array([(x0 + x1) / 2, (y0 + y1) / 2])
    back = np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])
    near = middle + (back - middle) / np.maximum(np.abs(back - middle), 1) * far
    canvas = np.zeros((size, size, 3), np.float32)
    for i in range(4):
        j = (i + 1) % 4
        surface(canvas, np.array([back[i], back[j], near[j], near[i]]), random, photo)
    surface(canvas, back, random, photo)
    for _ in range(
        int(random.integers(0, 4))
    ):  # lamps and bright windows high up, none of them sky
        x, y = random.uniform(0, size), random.uniform(0, 0.5 * size)
        w, h = random.uniform(0.01, 0.12, 2) * size
        colour = (255.0, random.uniform(220, 255), random.uniform(180, 255))
        cv2.ellipse(
            canvas, (int(x), int(y)), (int(w) + 1, int(h) + 1), 0, 0, 360, colour, -1, cv2.LINE_AA
        )
    for _ in range(int(random.integers(1, 9))):
        x, y = random.uniform(-0.1, 1.0) * size, random.uniform(0.2, 0.95) * size
        w, h = random.uniform(0.05, 0.5, 2) * size
        lean = random.normal(0, 0.1) * size
        surface(
            canvas,
            np.array([[x, y], [x + w, y + lean], [x + w, y + lean + h], [x, y + h]]),
            random,
            photo,
        )
    soft = cv2.GaussianBlur(canvas, (0, 0), random.uniform(0.4, 1.2))
    return np.clip(soft + random.normal(0, 2, (size, size, 1)), 0, 255).astype(np.uint8)
