"""Drawn streets: plain façades under a sky, the counterpart of the drawn rooms.

Photos of nature hardly show walls. Without these, a network that has learned from drawn rooms that
plain surfaces with straight edges are walls takes a clear sky above a façade for one too.
"""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np

from training.synthetic import surface

Random = np.random.Generator


def outline(size: int, random: Random) -> np.ndarray:
    """A façade as a polygon ``(N, 2)`` in pixels: box, gable, tower, or a wall running away."""
    left = random.uniform(-0.3, 0.8) * size
    right = left + random.uniform(0.12, 0.9) * size
    top, foot = random.uniform(0.02, 0.65) * size, 1.1 * size
    kind = random.random()
    if kind < 0.35:
        return np.array([[left, top], [right, top], [right, foot], [left, foot]])
    if kind < 0.6:
        eaves = top + random.uniform(0.05, 0.2) * size
        ridge = random.uniform(0.3, 0.7) * (right - left) + left
        return np.array([[left, eaves], [ridge, top], [right, eaves], [right, foot], [left, foot]])
    far = random.uniform(0.4, 0.7) * size
    inner = random.uniform(0.15, 0.6) * size
    wall = np.array([[0, min(top, far) - 0.2 * size], [inner, far], [inner, foot], [0, foot]])
    if random.random() < 0.5:
        wall[:, 0] = size - wall[:, 0]
    return wall


def windows(canvas: np.ndarray, corners: np.ndarray, random: Random) -> None:
    """A grid of dark, lit or sky-coloured panes on a façade, in place."""
    inside = np.zeros(canvas.shape[:2], np.uint8)
    cv2.fillPoly(inside, [corners.astype(np.int32)], 255)
    step = random.uniform(0.05, 0.14, 2) * canvas.shape[0]
    share = random.uniform(0.3, 0.8, 2)
    colour = random.uniform(10, 120) * np.exp(random.normal(0, 0.15, 3))
    if random.random() < 0.25:
        colour = np.array([random.uniform(120, 200), random.uniform(160, 215), 235.0])
    rows, columns = (np.arange(canvas.shape[0]) % step[i] < share[i] * step[i] for i in (0, 1))
    panes = rows[:, None] & columns[None, :] & (inside > 0)
    canvas[panes] = colour * random.uniform(0.7, 1.2)


def street(
    sky: np.ndarray, random: Random, photo: Callable[[], np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Façades and ground before ``sky`` ``(S, S, 3)`` uint8; returns image and target, uint8."""
    size = sky.shape[0]
    canvas = sky.astype(np.float32)
    target = np.full((size, size), 255, np.uint8)
    shapes = [outline(size, random) for _ in range(int(random.integers(1, 5)))]
    horizon = random.uniform(0.7, 1.0) * size
    shapes.append(np.array([[0, horizon], [size, horizon], [size, size], [0, size]]))
    for i, shape in enumerate(shapes):
        surface(canvas, shape, random, photo)
        if i < len(shapes) - 1 and random.random() < 0.7:
            windows(canvas, shape, random)
        cv2.fillPoly(target, [shape.astype(np.int32)], 0, cv2.LINE_AA)
    soft = cv2.GaussianBlur(canvas, (0, 0), random.uniform(0.4, 1.0))
    return np.clip(soft + random.normal(0, 2, (size, size, 1)), 0, 255).astype(np.uint8), target
