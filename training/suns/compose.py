"""Suns of every kind put into photos of real skies, in linear light, with the clean sky kept.

The sky's own light near a sun (aureole) is drawn as the lens' glare is: both leave with the sun.
Lengths are in widths of the picture.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from training.suns.decoys import lightning, night_lights, pale_shapes, twigs
from training.suns.light import LUMINANCE, Random, log_uniform, to_encoded, to_linear

WHITE = 1.3
"""Scene light that a camera shows as white."""


@dataclass
class Drawn:
    """A picture with its sun, the same without, and where the sun is."""

    image: np.ndarray  # (h, w, 3) float32 sRGB
    clean: np.ndarray  # (h, w, 3) float32 sRGB
    place: tuple[float, float] | None  # (x, y) in pixels
    radius: float  # of the bright core, in widths
    sharp: float  # 1 a limb, 0 a bloomed core
    seen: float  # share of the core that nothing hides
    water: int | None = None  # first row of the water put under it
    ground: int | None = None  # the same of dry ground


def sun_color(random: Random, around: np.ndarray) -> np.ndarray:
    """White to deep red; in a warm sky warm more often."""
    warm = float(np.clip(np.log(max(around[0], 1e-3) / max(around[2], 1e-3)) / 2, 0, 1))
    redness = np.clip(random.beta(1.2, 2.2) * 0.9 + 0.6 * warm * random.random(), 0, 1)
    return np.array([1.0, 1 - 0.75 * redness**1.2, 1 - 0.97 * redness**0.75], np.float32)


def place_of_sun(sky: np.ndarray, random: Random) -> tuple[float, float]:
    """A pixel for the sun: in the sky, often low in it, sometimes cut by the skyline or frame."""
    height, width = sky.shape
    rows, columns = np.nonzero(sky > 0.5)
    if random.random() < 0.45:  # just above or on the skyline of some column
        column = int(random.choice(columns))
        own = rows[columns == column]
        bottom = own.max()
        x, y = column + 0.5, bottom + 0.5 - height * abs(random.normal(0, 0.08)) + 0.01 * height
    else:
        i = int(random.integers(len(rows)))
        x, y = columns[i] + random.random(), rows[i] + random.random()
    if random.random() < 0.06:  # cut by the frame
        x = random.choice([0.0, width]) + random.normal(0, 0.015) * width
    return float(np.clip(x, 0.5, width - 0.5)), float(np.clip(y, 0.5, height - 0.5))


def starburst(dx: np.ndarray, dy: np.ndarray, d: np.ndarray, random: Random) -> np.ndarray:
    """Rays of an aperture, brightness relative to the glare's white."""
    blades = int(random.choice([6, 7, 8, 9, 10, 14, 16, 18, 22]))
    turn = np.arctan2(dy, dx) + random.uniform(0, 2 * np.pi)
    sharpness = log_uniform(random, 25, 500)
    wave = np.abs(np.cos(turn * blades / 2))
    if random.random() < 0.5:  # rays of uneven length
        wave = wave * (0.75 + 0.25 * np.cos(turn * random.integers(1, 4) + random.uniform(0, 6)))
    length = log_uniform(random, 0.02, 0.25)
    # A ray keeps its width on the way out: its angle narrows. Some end in a point, others fade.
    sharp = sharpness * np.maximum(d / length, 0.15)
    fade = np.exp(-((d / length) ** random.uniform(0.8, 2.5)))
    return log_uniform(random, 0.15, 3) * wave**sharp * fade


def ghosts(x: float, y: float, columns: np.ndarray, rows: np.ndarray, random: Random) -> np.ndarray:
    """Reflections between lenses on the line through the picture's centre: (h, w, 3)."""
    height, width = rows.shape[0], columns.shape[1]
    light = np.zeros((height, width, 3), np.float32)
    for _ in range(int(random.integers(1, 6))):
        at = random.uniform(-0.9, 1.6)
        cx, cy = x + at * (width / 2 - x) * 1.2, y + at * (height / 2 - y) * 1.2
        radius = log_uniform(random, 0.008, 0.08) * width
        d = np.hypot(columns - cx, rows - cy) / radius
        shape = np.clip((1 - d) * radius / 2 + 0.5, 0, 1) * (0.5 + 0.5 * np.minimum(d, 1) ** 2)
        color = random.dirichlet([1.5, 1.5, 1.5]).astype(np.float32) * 3
        light += log_uniform(random, 0.01, 0.12) * shape[..., None] * color
    return light


def sea(scene: np.ndarray, sky: np.ndarray, random: Random) -> tuple[np.ndarray, np.ndarray, int]:
    """Put water under a picture that is mostly sky: its mirror, dark and rippled."""
    height, width = sky.shape
    row = int(height * random.uniform(0.45, 0.8))
    mirrored = cv2.resize(scene[:row][::-1], (width, height - row))
    depth = np.linspace(0.02, 1, height - row, dtype=np.float32)[:, None]
    ripples = cv2.GaussianBlur(
        random.standard_normal((height - row, width)).astype(np.float32),
        (0, 0),
        sigmaX=log_uniform(random, 1.5, 6),
        sigmaY=log_uniform(random, 0.4, 1.2),
    )
    ripples *= random.uniform(0.1, 0.5) / max(float(ripples.std()), 1e-6) * np.sqrt(depth)
    shade = random.uniform(0.2, 0.8) * np.exp(ripples) * (1 - 0.4 * depth)
    blur = cv2.GaussianBlur(mirrored, (0, 0), sigmaX=width * 0.02, sigmaY=height * 0.03)
    out = scene.copy()
    out[row:] = blur * shade[..., None] * random.uniform(0.85, 1.1, 3).astype(np.float32)
    alpha = np.where(np.arange(height)[:, None] < row, np.float32(1), np.float32(0))
    return out, np.broadcast_to(alpha, sky.shape).copy(), row


def plain(scene: np.ndarray, sky: np.ndarray, random: Random) -> tuple[np.ndarray, np.ndarray, int]:
    """Put flat dry ground under a picture that is mostly sky: never as blue as water is."""
    height, width = sky.shape
    row = int(height * random.uniform(0.4, 0.8))
    below = np.arange(1, height - row + 1, dtype=np.float32)[:, None]
    away = height * log_uniform(random, 0.3, 3) / below  # in eye heights, or so
    across = (np.arange(width, dtype=np.float32)[None] - random.uniform(0, width)) / width * away
    texture = np.zeros((height - row, width), np.float32)
    noise = random.standard_normal((256, 256)).astype(np.float32)
    turn = random.uniform(0, np.pi)
    for scale in log_uniform(random, 4, 40) * 4.0 ** np.arange(4):
        u, v = scale * across, np.broadcast_to(scale * away, texture.shape)
        u, v = np.cos(turn) * u - np.sin(turn) * v, np.sin(turn) * u + np.cos(turn) * v
        # What is finer than a pixel averages out.
        fine = np.minimum(1, 0.5 * height / (scale * away * away)).astype(np.float32)
        texture += fine * cv2.remap(
            noise, (u % 255).astype(np.float32), (v % 255).astype(np.float32), cv2.INTER_LINEAR
        )
    texture *= random.uniform(0.0, 0.5) / max(float(texture.std()), 1e-6)
    if random.random() < 0.3:  # furrows, planks, ruts
        texture += random.uniform(0.1, 0.5) * np.sin(across * log_uniform(random, 5, 60))
    level = float(np.median(scene[:row] @ LUMINANCE)) * log_uniform(random, 0.08, 0.9)
    green, blue = random.uniform(0.7, 1.3), random.uniform(0.25, 0.85)
    albedo = np.array([1, green, min(green, 1) * blue], np.float32)
    off = across / away - random.uniform(-0.5, 0.5)
    glow = 1 + random.uniform(0, 2) * np.exp(-(off**2) / 0.1)
    ground = level * (np.exp(texture) * glow)[..., None] * albedo
    haze = np.exp(-below / height * log_uniform(random, 3, 60))[..., None]
    out = scene.copy()
    out[row:] = ground + haze * (scene[max(row - 3, 0) : row].mean((0, 1)) - ground)
    alpha = np.where(np.arange(height)[:, None] < row, np.float32(1), np.float32(0))
    return out.astype(np.float32), np.broadcast_to(alpha, sky.shape).copy(), row


def column_on_water(x: float, row: int, height: int, width: int, random: Random) -> np.ndarray:
    """Glints of the sun on water below ``row``: (height, width), brightness."""
    rows = np.arange(height, dtype=np.float32)[:, None]
    below = np.clip(rows - row, 0, None) / height
    wide = width * (log_uniform(random, 0.01, 0.06) + random.uniform(0.0, 0.5) * below)
    envelope = np.exp(-0.5 * ((np.arange(width) + 0.5 - x) / wide) ** 2) * (rows > row)
    noise = cv2.GaussianBlur(
        random.standard_normal((height, width)).astype(np.float32),
        (0, 0),
        sigmaX=log_uniform(random, 0.8, 3),
        sigmaY=0.5,
    )
    noise /= max(float(noise.std()), 1e-6)
    sparkle = np.clip(noise - random.uniform(-1.5, 1.0), 0, 3)
    smooth = random.random()
    return (envelope * (smooth + (1 - smooth) * sparkle)).astype(np.float32)


def add_sun(scene: np.ndarray, sky: np.ndarray, random: Random, water: int | None) -> tuple:
    """Return scene light with a sun, and its label: (light, place, radius, sharp, seen)."""
    height, width = sky.shape
    x, y = place_of_sun(sky, random)
    if water is not None and random.random() < 0.8:
        y = min(y, water - random.uniform(-0.01, 0.25) * height)
    columns = np.arange(width, dtype=np.float32)[None] + 0.5
    rows = np.arange(height, dtype=np.float32)[:, None] + 0.5
    dx, dy = (columns - x) / width, (rows - y) / width
    d = np.hypot(dx, dy).astype(np.float32)
    around = scene[max(int(y) - 6, 0) : int(y) + 7, max(int(x) - 6, 0) : int(x) + 7].mean((0, 1))
    color = sun_color(random, around)
    kind = random.choice(
        ["burnt", "limb", "veiled", "small", "hidden"], p=[0.41, 0.2, 0.12, 0.17, 0.1]
    )
    glare = np.zeros_like(d)
    disc = np.zeros((height, width, 3), np.float32)
    if kind == "small":  # a clear day's sun before a good lens, with hardly any glare
        radius, sharp = log_uniform(random, 0.004, 0.02), 0.0
        softness = random.uniform(0.3, 1.0) * radius
        rim = np.minimum((d - radius) / (0.3 * softness), 50)
        glare += log_uniform(random, 1.2, 12) / (1 + np.exp(rim))
        glare += log_uniform(random, 0.03, 0.6) * (1 + (d / (3 * radius)) ** 2) ** -1.5
    elif kind == "hidden":  # behind clouds: no more than a wide glow, mostly in them
        radius, sharp = log_uniform(random, 0.02, 0.1), 0.0
        flat = random.uniform(0.25, 1.0)
        spread = log_uniform(random, 0.05, 0.25)
        glow = (1 + (np.hypot(dx, dy / flat) / spread) ** 2) ** -random.uniform(0.8, 2)
        glare += log_uniform(random, 0.2, 2.5) * glow
    elif kind == "burnt":
        radius, sharp = log_uniform(random, 0.006, 0.085), 0.0
        b, c = log_uniform(random, 0.004, 0.06), random.uniform(0.7, 2.2)
        peak = (1 + (radius / b) ** 2) ** c
        glare += peak * (1 + (d / b) ** 2) ** -c
    else:
        radius, sharp = log_uniform(random, 0.006, 0.11), 1.0
        flat = random.uniform(0.72, 1.0) if random.random() < 0.35 else 1.0
        e = np.hypot(dx, dy / flat)
        blur = log_uniform(random, 0.5, 1.6 if kind == "limb" else 3.0)
        inside = np.clip((radius - e) * width / blur + 0.5, 0, 1)
        limb = np.sqrt(np.clip(1 - (e / radius) ** 2, 0.02, 1)) ** random.uniform(0.1, 0.7)
        level = log_uniform(random, 0.7, 20)
        low = np.clip(dy / radius, -1, 1)[..., None] * random.uniform(0, 0.5)
        shift = np.exp(-low * np.array([0.0, 0.6, 1.5], np.float32))
        disc = (level * inside * limb)[..., None] * color * shift
        if kind == "veiled":
            disc *= random.uniform(0.2, 0.8)
        b, c = radius * log_uniform(random, 0.6, 5), random.uniform(0.8, 2.5)
        glare += level * log_uniform(random, 0.005, 0.15) * (1 + (d / b) ** 2) ** -c
    # The wide part: the air's own light round the sun, and haze in the lens.
    # Measured on photos with a sun, light above the core's edge: .77 at 2 % of the width, .56 at
    # 5 %, .40 at 10 %, .27 at 20 %, .19 at 30 %.
    outside = np.maximum(d - radius, 0)
    glare += (
        random.beta(1.3, 1.3)
        * (0.3 if kind in ("small", "hidden") else 1.0)
        * (1 + (outside / log_uniform(random, 0.03, 0.3)) ** 2) ** -random.uniform(0.5, 1.6)
    )
    if kind != "hidden" and random.random() < 0.3:
        glare += starburst(dx, dy, d, random)
    tint = 1 - (1 - color) * random.uniform(0.4, 1.0)
    light = glare[..., None] * tint
    # Cloud and haze shine by the sun's light themselves: part of the glare follows what is there.
    luminance = scene @ LUMINANCE
    slow = cv2.GaussianBlur(luminance, (0, 0), 0.03 * width)
    detail = np.clip(luminance / np.maximum(slow, 1e-4), 0.25, 3)
    share = random.uniform(0, 1.0) if random.random() < 0.7 else 0.0
    if kind == "hidden":
        share, detail = random.uniform(0.6, 1.0), np.minimum(detail ** random.uniform(1, 4), 8)
    light *= (1 - share + share * detail)[..., None]
    if kind != "hidden" and random.random() < 0.18:
        light += ghosts(x, y, columns, rows, random)
    # Land hides the disc and keeps a part of the glare, which is made in the lens.
    veil = random.uniform(0.15, 0.7)
    total = scene + light * (veil + (1 - veil) * sky)[..., None] + disc * sky[..., None]
    core = d < radius
    seen = float(sky[core].mean()) if core.any() else float(sky[int(y), int(x)])
    area = np.pi * (radius * width) ** 2
    seen *= kind != "hidden"
    seen *= min(1.0, float(core.sum()) / max(area, 1.0)) if area > 12 else 1.0
    if water is not None:
        glints = column_on_water(x, water, height, width, random)
        total = total + (log_uniform(random, 0.1, 2.5) * glints)[..., None] * color
    return total.astype(np.float32), (x, y), radius, sharp, seen


def burnt_radius(
    image: np.ndarray, sky: np.ndarray, place: tuple[float, float], expected: float
) -> float:
    """Where the core's brightness ends, as a person would draw its rim; in widths."""
    height, width = sky.shape
    d = np.hypot(np.arange(width) + 0.5 - place[0], np.arange(height)[:, None] + 0.5 - place[1])
    luminance = image @ LUMINANCE
    inside = (sky > 0.5) & (d < 0.3 * width)
    ring = d[inside].astype(int)
    count = np.bincount(ring)
    mean = np.bincount(ring, luminance[inside]) / np.maximum(count, 1)
    known = np.flatnonzero(count > 0)
    if not len(known):
        return expected
    level = float(mean[known[0]]) - 0.05
    ended = known[mean[known] < level]
    return float(ended[0]) / width if len(ended) else expected


def camera(scene: np.ndarray, clean: np.ndarray, random: Random) -> tuple[np.ndarray, np.ndarray]:
    """One exposure, white balance and curve for both; sRGB."""
    burnt = log_uniform(random, 4e-4, 0.06)  # share of the picture that may burn
    level = float(np.quantile((scene @ LUMINANCE)[::2, ::2], 1 - burnt))
    stops = random.normal(0.1, 0.4)
    gain = 2.0**stops * min(1.0, WHITE / max(level, 1e-3))
    balance = np.exp(random.normal(0, 0.06, 3)).astype(np.float32)
    w = random.uniform(0.05, 1.6)
    contrast = random.uniform(0.8, 1.2)
    saturation = random.uniform(0.7, 1.5)
    mix = (saturation * np.eye(3) + (1 - saturation) * LUMINANCE[None]).astype(np.float32)

    def shot(light: np.ndarray) -> np.ndarray:
        r = cv2.pow(np.maximum(light * (gain * balance), 1e-6).astype(np.float32), contrast)
        shown = (1 - cv2.exp(r * np.float32(-w))) / (1 - np.exp(-w * WHITE))
        return to_encoded(cv2.transform(shown.astype(np.float32), mix))

    return shot(scene), shot(clean)


def spoil(image: np.ndarray, random: Random) -> np.ndarray:
    """Blur, noise, JPEG: uint8."""
    if random.random() < 0.15:
        image = cv2.GaussianBlur(image, (0, 0), random.uniform(0.4, 1.1))
    if random.random() < 0.4:
        image = image + random.standard_normal(image.shape, np.float32) * random.uniform(
            0.002, 0.02
        )
    out = np.clip(image * 255 + 0.5, 0, 255).astype(np.uint8)
    if random.random() < 0.6:
        quality = int(random.integers(35, 96))
        out = cv2.imdecode(cv2.imencode(".jpg", out, [cv2.IMWRITE_JPEG_QUALITY, quality])[1], 1)
    return out


def compose(rgb: np.ndarray, sky: np.ndarray, random: Random) -> Drawn:
    """Draw a sun (or a night's lights) into a photo (h, w, 3) uint8 whose sky (h, w) is known."""
    shown = to_linear(rgb.astype(np.float32) / 255)
    w = random.uniform(0.05, 0.95)
    scene = cv2.log(1 - np.float32(w) * np.minimum(shown, np.float32(0.985))) / np.float32(-w)
    water = ground = None
    if (sky > 0.5).mean() > 0.55:
        under = random.random()
        if under < 0.4:
            scene, sky, water = sea(scene, sky, random)
        elif under < 0.7:
            scene, sky, ground = plain(scene, sky, random)
    draw = random.random()
    if draw < 0.5:  # evening: warm towards the horizon, dim above
        inside = np.flatnonzero((sky > 0.5).any(1))
        last = inside[-1] if len(inside) else sky.shape[0] - 1
        rows = np.clip(1 - np.arange(sky.shape[0]) / max(last, 1), 0, 1)
        green = random.uniform(0.25, 0.9)
        warm = np.array([1.0, green, green * random.uniform(0.1, 0.85)], np.float32)
        fade = np.exp(-rows * log_uniform(random, 0.1, 5)).astype(np.float32)[:, None, None]
        level = (1 - random.uniform(0, 0.7) * (1 - fade)) * random.uniform(0.4, 1.3)
        scene = scene * (1 + fade * (warm - 1)) * level
    if draw > 0.35 and draw < 0.65:  # a grading
        scene = scene * np.exp(random.normal(0, 0.3, 3)).astype(np.float32)
    scene = (scene * 2.0 ** random.normal(-0.4, 0.6)).astype(np.float32)
    night = random.random() < 0.1
    if night:
        lights = lightning if random.random() < 0.3 else night_lights
        scene = lights(scene, sky, random)
    elif random.random() < 0.12:
        scene = pale_shapes(scene, sky, random)
    if not night and random.random() < 0.1:
        scene, sky = twigs(scene, sky, random)
    # Some have nothing more: not every pale shape is a sun.
    if night or (sky > 0.5).mean() < 0.04 or random.random() < 0.06:
        image, clean = camera(scene, scene, random)
        return Drawn(image, clean, None, 0.0, 0.0, 0.0, water, ground)
    total, place, radius, sharp, seen = add_sun(scene, sky, random, water)
    image, clean = camera(total, scene, random)
    if sharp < 0.5:
        radius = burnt_radius(image, sky, place, radius)
    return Drawn(image, clean, place, radius, sharp, seen, water, ground)
