"""Frames of a made-up fixed camera: a blue sky with drifting clouds over textured land."""

from __future__ import annotations

import functools
from typing import NamedTuple

import cv2
import numpy as np

from sunwidget.analysis.scene import Scene
from sunwidget.edit.table import Edit
from sunwidget.timelapses import scenes as scene_maker
from sunwidget.timelapses.frames import Clock

WIDTH, HEIGHT, SKYLINE = 192, 128, 78


def _blobs(seed: int, scale: float, width: int) -> np.ndarray:
    noise = np.random.default_rng(seed).normal(size=(HEIGHT, width)).astype(np.float32)
    edge = round(4 * scale)  # it goes on round the cylinder
    smooth = cv2.GaussianBlur(np.pad(noise, edge, mode="wrap"), (0, 0), scale)
    smooth = smooth[edge:-edge, edge:-edge]
    return smooth / smooth.std()


def sky_mask() -> np.ndarray:
    """1 = sky, (HEIGHT, WIDTH) float32."""
    rows = np.arange(HEIGHT)[:, None]
    hills = SKYLINE + 6 * np.sin(np.arange(WIDTH) / 17)
    return (rows < hills).astype(np.float32)


def frame(number: int, *, exposure: float = 0.0, drift: float = 2.0, shift=(0, 0)) -> np.ndarray:
    """One frame, (HEIGHT, WIDTH, 3) uint8 sRGB; ``exposure`` in natural log of light."""
    height = np.linspace(1, 0, HEIGHT, dtype=np.float32)[:, None, None]
    low, high = np.array([0.55, 0.68, 0.80]), np.array([0.10, 0.24, 0.55])
    sky = low + (high - low) * height * np.ones((1, WIDTH, 1))
    cover = np.roll(_blobs(1, 7, 2 * WIDTH), round(drift * number), axis=1)[:, :WIDTH]
    cover = np.clip((cover - 0.6) / 0.6, 0, 1)[..., None]
    sky = sky + cover * (0.75 - sky)
    land = 0.12 + 0.05 * _blobs(2, 1.5, WIDTH)[..., None] * np.array([1.0, 0.8, 0.5])
    mask = sky_mask()[..., None]
    light = np.maximum(mask * sky + (1 - mask) * land, 0.004) * np.exp(exposure)
    code = 255 * np.clip(light, 0, 1) ** (1 / 2.2)
    code += np.random.default_rng(100 + number).normal(0, 0.7, code.shape)
    matrix = np.float32([[1, 0, shift[0]], [0, 1, shift[1]]])
    code = cv2.warpAffine(code, matrix, (WIDTH, HEIGHT), borderMode=cv2.BORDER_REPLICATE)
    return np.clip(np.round(code), 0, 255).astype(np.uint8)


EXPOSURES = (0.0, 0.08, -0.06, 0.1, -0.09, 0.03, -0.04)
SHAKEN, SHAKE = 5, (3, 1)  # the last but one, in pixels


class LookedAt(NamedTuple):
    """Frames, what was found in all of them, and the scene of each."""

    frames: list[np.ndarray]
    scenes: scene_maker.FrameScenes
    row: list[Scene]


@functools.cache
def film() -> LookedAt:
    """Seven frames whose exposure jitters; analysed once for all tests."""
    frames = [
        frame(i, exposure=exposure, shift=SHAKE if i == SHAKEN else (0, 0))
        for i, exposure in enumerate(EXPOSURES)
    ]
    wanted, scene_maker.SAMPLES = scene_maker.SAMPLES, 3
    try:
        scenes = scene_maker.FrameScenes.of(
            frames,
            long_edge=None,
            corrections=Edit(),
            place=None,
            clock=Clock(None, len(frames)),
            hints={"sky": sky_mask()},
            progress=lambda _fraction, _message: None,
        )
    finally:
        scene_maker.SAMPLES = wanted
    return LookedAt(frames, scenes, list(scenes))
