"""What hides a sun or resembles one, drawn: twigs, pale clouds, lamps, lightning."""

from __future__ import annotations

import cv2
import numpy as np

from training.suns.light import LUMINANCE, Random, log_uniform


def twigs(scene: np.ndarray, sky: np.ndarray, random: Random) -> tuple[np.ndarray, np.ndarray]:
    """Hang dark branches, leaves and wires before the sky: the light, and the sky that is left."""
    height, width = sky.shape
    cover = np.zeros((height * 2, width * 2), np.uint8)
    start = random.uniform(0, 2, 2) * (width, height)
    turn = random.uniform(0, 2 * np.pi)
    for _ in range(int(random.integers(2, 40))):
        place, angle = start + random.normal(0, 0.15 * width, 2), turn + random.normal(0, 0.7)
        points = [place]
        for _ in range(int(random.integers(2, 7))):
            angle += random.normal(0, 0.35)
            step = log_uniform(random, 0.03, 0.2) * width
            points.append(points[-1] + step * np.array([np.cos(angle), np.sin(angle)]))
        line = np.array(points, np.int32)[:, None]
        cv2.polylines(cover, [line], False, 255, int(random.integers(1, 7)), cv2.LINE_AA)
        if random.random() < 0.3:
            for x, y in line[:, 0]:
                axes = (int(random.integers(2, 9)), int(random.integers(1, 5)))
                cv2.ellipse(cover, (int(x), int(y)), axes, np.degrees(angle), 0, 360, 255, -1)
    alpha = cv2.resize(cover, (width, height), interpolation=cv2.INTER_AREA) / np.float32(255)
    dark = (random.uniform(0.003, 0.06) * random.uniform(0.7, 1.3, 3)).astype(np.float32)
    return scene + alpha[..., None] * (dark - scene), sky * (1 - alpha)


def pale_shapes(scene: np.ndarray, sky: np.ndarray, random: Random) -> np.ndarray:
    """Put round pale clouds into a sky, as bright as its brightest and without any glare."""
    height, width = scene.shape[:2]
    columns, rows = np.arange(width) + 0.5, np.arange(height)[:, None] + 0.5
    white = np.float32(np.quantile(scene @ LUMINANCE, 0.98) * random.uniform(0.9, 1.6))
    for _ in range(int(random.integers(1, 5))):
        x, y = random.uniform(0, width), random.uniform(0, 0.8 * height)
        size = log_uniform(random, 0.01, 0.15) * width
        flat, soft = random.uniform(1, 3), log_uniform(random, 0.05, 1.0)
        d = np.hypot(columns - x, (rows - y) * flat) / size
        alpha = np.clip((1 - d) / soft + 0.5, 0, 1) * random.uniform(0.4, 1) * sky
        scene = scene + alpha[..., None].astype(np.float32) * (white - scene)
    return scene.astype(np.float32)


def night_lights(scene: np.ndarray, sky: np.ndarray, random: Random) -> np.ndarray:
    """A dark picture with a moon in its sky, or lamps below it: no suns."""
    height, width = sky.shape
    scene = scene * 2.0 ** random.uniform(-6, -2.5)
    columns = np.arange(width, dtype=np.float32)[None] + 0.5
    rows = np.arange(height, dtype=np.float32)[:, None] + 0.5
    moon = random.random() < 0.6 and (sky > 0.5).any()
    where = np.argwhere(sky > 0.5) if moon else np.argwhere(sky < 0.5)
    if not len(where):
        return scene
    for row, column in where[random.integers(0, len(where), 1 if moon else random.integers(1, 7))]:
        d = np.hypot(columns - column, rows - row) / width
        radius = log_uniform(random, 0.004, 0.05 if moon else 0.012)
        disc = np.clip((radius - d) * width + 0.5, 0, 1) * log_uniform(random, 0.6, 4)
        halo = log_uniform(random, 0.003, 0.5) * (1 + (d / (2 * radius)) ** 2) ** -1.5
        color = np.array([1, random.uniform(0.75, 1), random.uniform(0.4, 1)], np.float32)
        scene = scene + ((disc + halo)[..., None] * color).astype(np.float32)
    return scene


def lightning(scene: np.ndarray, sky: np.ndarray, random: Random) -> np.ndarray:
    """Draw bolts into a dark sky, with the cloud lit where they begin: no suns."""
    height, width = sky.shape
    inside = np.argwhere(sky > 0.5)
    if not len(inside):
        return scene
    scene = scene * 2.0 ** random.uniform(-4, -1)
    columns = np.arange(width, dtype=np.float32)[None] + 0.5
    rows = np.arange(height, dtype=np.float32)[:, None] + 0.5
    color = np.array([random.uniform(0.6, 1), random.uniform(0.6, 0.95), 1], np.float32)
    for _ in range(int(random.integers(1, 4))):
        row, column = inside[random.integers(len(inside))]
        line = bolt(row, column, sky.shape, random)
        spread = cv2.GaussianBlur(line, (0, 0), log_uniform(random, 0.01, 0.05) * width)
        light = log_uniform(random, 1, 20) * line + log_uniform(random, 0.5, 6) * spread
        wide = log_uniform(random, 0.01, 0.15)
        d = np.hypot(columns - column, (rows - row) * random.uniform(1, 2)) / width
        luminance = scene @ LUMINANCE
        clouds = luminance / max(float(np.median(luminance)), 1e-4)
        flash = log_uniform(random, 0.1, 6) * (1 + (d / wide) ** 2) ** -random.uniform(0.8, 2)
        light = light + flash * np.clip(clouds, 0.3, 2)
        scene = scene + (light * sky)[..., None] * color
    return scene.astype(np.float32)


def bolt(row: int, column: int, shape: tuple[int, int], random: Random) -> np.ndarray:
    """Draw a bolt downwards from a pixel, with branches: (height, width) in [0, 1]."""
    height = shape[0]
    drawn = np.zeros(shape, np.uint8)
    down = np.pi / 2 + random.normal(0, 0.3)
    tips = [(np.array([column, row], float), down, log_uniform(random, 0.2, 1.0) * height, 2)]
    while tips:
        place, turn, left, thick = tips.pop()
        while left > 0:
            step = log_uniform(random, 0.01, 0.06) * height
            angle = turn + random.normal(0, 0.6)
            end = place + step * np.array([np.cos(angle), np.sin(angle)])
            ends = [(int(p[0]), int(p[1])) for p in (place, end)]
            cv2.line(drawn, *ends, 255, thick, cv2.LINE_AA)
            if thick > 1 and random.random() < 0.2:
                tips.append((end, turn + random.normal(0, 0.8), 0.4 * left, 1))
            place, left = end, left - step
    return drawn.astype(np.float32) / 255
