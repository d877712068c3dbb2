"""A shore whose sky and water are known: for the tests of water."""

import functools

import cv2
import numpy as np

import sunwidget as sw

SIZE = (240, 160)
ROW = 90  # of the horizon


@functools.cache
def shore(ground="sea"):
    """A hazy blue sky over the sea, or over a meadow, sand or a road, as 8-bit sRGB."""
    width, height = SIZE
    random = np.random.default_rng(3)
    rows = np.arange(height)[:, None, None] / height
    picture = np.array([0.35, 0.55, 0.85]) + rows * np.array([0.7, 0.45, 0.1])
    picture = np.broadcast_to(picture, (height, width, 3)).copy()
    noise = random.standard_normal((height, width)).astype(np.float32)
    color = {
        "sea": (0.13, 0.28, 0.40),
        "meadow": (0.25, 0.38, 0.12),
        "sand": (0.62, 0.52, 0.38),
        "road": (0.40, 0.39, 0.38),
    }[ground]
    spread = (9.0, 0.8) if ground == "sea" else (0.8, 0.8)
    noise = cv2.GaussianBlur(noise, (0, 0), spread[0], sigmaY=spread[1])
    noise /= noise.std()
    land = np.array(color) * (1 + 0.08 * noise[..., None])
    picture[ROW:] = land[ROW:]
    return np.round(np.clip(picture, 0, 1) * 255).astype(np.uint8)


SKY = (np.arange(SIZE[1])[:, None] < ROW).astype(np.float32) * np.ones(SIZE[0], np.float32)
TOLD = {"sky": SKY, "water": 1 - SKY, "refine": "none", "horizon": float(ROW), "fov": 40.0}


@functools.cache
def scene(ground="sea", **hints):
    """Return the shore, analysed with its sky and its water told."""
    told = TOLD if ground == "sea" else TOLD | {"water": "none"}
    return sw.analyze(shore(ground), **(told | hints))
