"""The network that infers the land's shape and illumination (models/MODEL_CARD.md)."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.fit.confidence import HEIGHTS, TURNS
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.bundled import once, run_twice, strided

BUNDLED = Path(__file__).parents[1] / "models" / "land.onnx"
AREA = 92_000  # pixels of the network's input
_WATER = 1  # index of water in the output ``matter``
_MIRRORED = [1, 5, 8, 10]
"""Functions of ``sun_basis`` that change their sign in a mirror image: those odd in x."""


class LandMaps(NamedTuple):
    """The network's outputs; all but ``sky`` and ``sunlit`` at half the size of its input.

    Parameters
    ----------
    sky : (h, w) float32
        Probability of sky.
    sunlit : (h, w) float32
        Share of the sun's disc that the surface sees, [0, 1]; 0 without sunshine.
    log_depth : (h/2, w/2) float32
        ln(metres) along the optical axis, up to a constant.
    normal : (h/2, w/2, 3) float32
        Unit normals: to the camera's right, up, and towards it.
    facing : (h/2, w/2) float32
        Cosine between the normal and the direction to the photo's sun, [0, 1], in sunlit places.
    transfer : (h/2, w/2, 12) float32
        Weights of the functions of ``sun_basis``: their sum is the share of a sun's light that
        reaches the surface.
    water : (h/2, w/2) float32
        Probability of water.
    horizon : float
        Row of the horizon at the center column, as a share of the height; may lie outside [0, 1].
    sun : (6, 12) float32
        Probability of each sun position, by ``confidence.HEIGHTS`` and ``TURNS``.
    air : (h/2, w/2) float32
        Share of the air's light in that of a pixel of land, [0, 1].
    """

    sky: np.ndarray
    sunlit: np.ndarray
    log_depth: np.ndarray
    normal: np.ndarray
    facing: np.ndarray
    transfer: np.ndarray
    water: np.ndarray
    horizon: float
    sun: np.ndarray
    air: np.ndarray


def sun_basis(direction: np.ndarray) -> np.ndarray:
    """Return the basis functions of the sun's direction that describe the light on land.

    Parameters
    ----------
    direction : (..., 3)
        Unit vectors: to the right, up, and ahead along the camera's heading.

    Returns
    -------
    (..., 12)
        The same as in ``training/land/model.py`` and ``shaders/land/read_transfer.glsl``.
    """
    x, height, z = np.moveaxis(direction, -1, 0)
    height = np.maximum(height, 0)
    low = np.sqrt(height)
    along, across = x * x - z * z, 2 * x * z
    return np.stack(
        [
            *(np.ones_like(x), x, z, height),
            *(low, x * low, z * low, along),
            *(across, along * height, across * height, height * height),
        ],
        -1,
    )


@once
def look_at_land(working: Working) -> LandMaps:
    """Run the network on a photo's small copy, once per copy; 0.2 s on two cores.

    Strokes and hints create new scenes of the same copy.

    Raises
    ------
    AnalysisError
        If onnxruntime is missing.
    """
    size = working.width, working.height
    scale = (AREA / (working.width * working.height)) ** 0.5
    maps = ["sky", "sunlit", "depth", "normal", "facing", "transfer", "matter"]
    sky, sunlit, octaves, normal, facing, transfer, matter, view, sun, air = run_twice(
        BUNDLED,
        "land",
        [*maps, "view", "sun", "air"],
        working.encoded,
        strided(*size, scale),
        _exchange_sides,
    )
    normal /= np.linalg.norm(normal, axis=0)
    return LandMaps(
        sky[0],
        sunlit[0],
        octaves[0] * np.float32(np.log(2)),
        normal.transpose(1, 2, 0),
        facing[0],
        transfer.transpose(1, 2, 0),
        matter[_WATER],
        0.5 + float(view[0]),
        sun.reshape(HEIGHTS.size, TURNS.size),
        air[0],
    )


def _exchange_sides(found: dict[str, np.ndarray]) -> None:
    """Exchange left and right in the values of outputs by name, in place."""
    found["normal"][0] *= -1
    found["transfer"][_MIRRORED] *= -1
    turns = found["sun"].reshape(HEIGHTS.size, TURNS.size)
    turns[:, :-1] = turns[:, -2::-1].copy()  # the last, straight back, stays
