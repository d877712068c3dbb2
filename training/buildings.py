"""Drawn streets: façades in perspective under a sky, the counterweight of the rooms.

Photos of nature hardly show walls. Without these, a network that has learned from rooms that plain
surfaces with straight edges are walls takes a clear sky above a façade for one too, and sunlit
plaster for sky.
"""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np

from training.synthetic import surface

Random = np.random.Generator
SIDE = 256
"""Pixels of a façade before it is set up in perspective."""


def colour(random: Random, low: float, high: float, spread: float) -> np.ndarray:
    """A brightness between ``low`` and ``high`` with a random tint, ``(3,)`` float32."""
    return (random.uniform(low, high) * np.exp(random.normal(0, spread, 3))).astype(np.float32)


def facade(random: Random) -> np.ndarray:
    """Plaster, brick, stone or glass with rows of windows, seen straight on; ``(S, S, 3)``."""
    wall = colour(random, 50, 245, 0.12)
    if random.random() < 0.3:
        wall = wall * np.array([1.0, random.uniform(0.6, 0.9), random.uniform(0.4, 0.8)])
    grain = cv2.resize(
        random.normal(0, random.uniform(0.01, 0.12), (int(random.integers(8, 128)),) * 2),
        (SIDE, SIDE),
        interpolation=cv2.INTER_LINEAR,
    )
    picture = wall * (1 + grain[..., None])
    storeys, bays = int(random.integers(2, 16)), int(random.integers(2, 14))
    height, width = SIDE / storeys, SIDE / bays
    share = random.uniform(0.25, 0.8, 2)
    glass = random.random() < 0.2  # towers that mirror the sky
    pane = colour(random, 120, 240, 0.1) if glass else colour(random, 8, 110, 0.15)
    frame = wall * random.uniform(0.7, 1.3)
    sill, ledge = random.random() < 0.5, random.random() < 0.6
    for storey in range(storeys):
        y = storey * height
        if ledge:
            picture[int(y) : int(y + max(1, 0.08 * height))] *= random.uniform(0.75, 1.15)
        for bay in range(bays):
            if random.random() < 0.06:
                continue
            x0 = round((bay + 0.5 - share[0] / 2) * width)
            x1 = round((bay + 0.5 + share[0] / 2) * width)
            y0, y1 = (
                round(y + 0.6 * (1 - share[1]) * height),
                round(y + (1 - 0.4 * (1 - share[1])) * height),
            )
            cv2.rectangle(picture, (x0 - 1, y0 - 1), (x1 + 1, y1 + 1), frame.tolist(), -1)
            tone = pane * random.uniform(0.7, 1.3)
            cv2.rectangle(picture, (x0, y0), (x1, y1), tone.tolist(), -1)
            if sill:
                cv2.line(picture, (x0 - 1, y1 + 1), (x1 + 1, y1 + 1), (wall * 0.6).tolist(), 1)
    # Sun from above or shade below: the upper storeys of a street are often burnt out.
    light = np.linspace(random.uniform(0.7, 1.8), random.uniform(0.3, 1.1), SIDE)[:, None, None]
    return np.clip(picture * light, 0, 255).astype(np.float32)


def corners(size: int, random: Random) -> np.ndarray:
    """A façade's corners ``(4, 2)`` in pixels, from top left clockwise: frontal or running away."""
    top, foot = random.uniform(-0.1, 0.6) * size, random.uniform(0.75, 1.1) * size
    left = random.uniform(-0.3, 0.8) * size
    right = left + random.uniform(0.12, 0.9) * size
    if random.random() < 0.4:
        lean = random.normal(0, 0.03) * size
        narrow = random.uniform(0, 0.12) * (right - left)  # a camera that looks up
        return np.array(
            [[left + narrow, top], [right - narrow, top + lean], [right, foot], [left, foot]]
        )
    eye = random.uniform(0.5, 0.9) * size  # everything runs towards the horizon
    near, far = random.uniform(-0.3, 0.1) * size, random.uniform(0.2, 0.6) * size
    scale = random.uniform(0.15, 0.7)
    above = eye - random.uniform(-0.5, 0.4) * size
    ends = np.array([eye - above, eye - scale * above, eye + scale * 0.4 * size, eye + 0.4 * size])
    quad = np.stack([np.array([near, far, far, near]), ends], 1)
    if random.random() < 0.5:
        quad[:, 0] = size - quad[:, 0]
        quad = quad[[1, 0, 3, 2]]
    return quad


def raise_facade(canvas: np.ndarray, target: np.ndarray, random: Random) -> None:
    """Sets one façade, at times with a gable, before ``canvas``, both in place."""
    size = canvas.shape[0]
    quad = corners(size, random).astype(np.float32)
    flat = np.array([[0, 0], [SIDE, 0], [SIDE, SIDE], [0, SIDE]], np.float32)
    turn = cv2.getPerspectiveTransform(flat, quad)
    picture = cv2.warpPerspective(
        facade(random), turn, (size, size), borderMode=cv2.BORDER_REPLICATE
    )
    shape = quad
    if random.random() < 0.35:  # a gable or a roof
        ridge = (quad[0] + quad[1]) / 2 - [0, random.uniform(0.02, 0.2) * size]
        shape = np.concatenate([quad[:1], ridge[None], quad[1:]]).astype(np.float32)
    cover = np.zeros((size, size), np.uint8)
    cv2.fillPoly(cover, [np.round(shape * 16).astype(np.int32)], 255, cv2.LINE_AA, 4)
    alpha = cover.astype(np.float32)[..., None] / 255
    canvas[:] = canvas * (1 - alpha) + picture * alpha
    target[:] = np.minimum(target, 255 - cover)


def street(
    sky: np.ndarray, random: Random, photo: Callable[[], np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Façades and ground before ``sky`` ``(S, S, 3)`` uint8; returns image and target, uint8."""
    size = sky.shape[0]
    canvas = sky.astype(np.float32)
    target = np.full((size, size), 255, np.uint8)
    if random.random() < 0.35:  # pale to burnt out, as streets in the shade have it
        canvas = canvas + (random.uniform(200, 255) - canvas) * random.uniform(0.4, 1.0)
    for _ in range(int(random.integers(1, 5))):
        raise_facade(canvas, target, random)
    horizon = random.uniform(0.7, 1.0) * size
    ground = np.array([[0, horizon], [size, horizon], [size, size], [0, size]])
    surface(canvas, ground, random, photo)
    cv2.fillPoly(target, [ground.astype(np.int32)], 0, cv2.LINE_AA)
    soft = cv2.GaussianBlur(canvas, (0, 0), random.uniform(0.4, 1.0))
    return np.clip(soft + random.normal(0, 2, (size, size, 1)), 0, 255).astype(np.uint8), target
