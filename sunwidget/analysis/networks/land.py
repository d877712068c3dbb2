"""The network that sees how land lies and what light falls on it (models/MODEL_CARD.md)."""

from __future__ import annotations

from pathlib import Path
from threading import Lock
from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from sunwidget.analysis.fit.confidence import HEIGHTS, TURNS
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.onnx_file import bundled_session

BUNDLED = Path(__file__).parents[1] / "models" / "land.onnx"
AREA = 92_000  # pixels of the picture that the network sees
_STRIDE = 32
_WATER = 1  # of the kinds of matter


class LandMaps(NamedTuple):
    """Its answers; all but ``sky`` and ``sunlit`` at half of the size that the network sees.

    Parameters
    ----------
    sky : (h, w) float32
        Probability of sky.
    sunlit : (h, w) float32
        Share of the sun's disc that the surface sees, [0, 1]; 0 without sunshine.
    log_depth : (h/2, w/2) float32
        ln(metres) along the optical axis, but for a constant.
    normal : (h/2, w/2, 3) float32
        Unit normals: to the camera's right, up, and towards it.
    facing : (h/2, w/2) float32
        Cosine between the normal and the photo's sun, [0, 1], where that lights the surface.
    transfer : (h/2, w/2, 12) float32
        Shares of the functions of ``sun_basis``: what of any sun's light falls on the surface.
    water : (h/2, w/2) float32
        Probability of water.
    horizon : float
        Its row at the picture's centre column, of the height; may lie outside [0, 1].
    sun : (6, 12) float32
        Probability of where the photo's sun is, by ``confidence.HEIGHTS`` and ``TURNS``.
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


def sun_basis(direction: np.ndarray) -> np.ndarray:
    """Return the functions of suns' directions by which light on land is told.

    Parameters
    ----------
    direction : (..., 3)
        Unit vectors: to the right, up, and ahead along the camera's heading.

    Returns
    -------
    (..., 12)
        As ``training/land/model.py`` and ``shaders/land/read_transfer.glsl`` have them.
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


def look_at_land(working: Working) -> LandMaps:
    """Run the network on a photo's small copy; 0.1 s on two cores, once a copy.

    Raises
    ------
    AnalysisError
        When onnxruntime is missing.
    """
    with _looking:  # whoever comes while it is looked at waits for what the other sees
        if working not in _seen:
            _seen[working] = _look(working)
        return _seen[working]


def _look(working: Working) -> LandMaps:
    scale = (AREA / (working.width * working.height)) ** 0.5
    width, height = (
        max(2, round(side * scale / _STRIDE)) * _STRIDE for side in (working.width, working.height)
    )
    image = np.clip(resize(working.encoded, width, height), 0, 1).transpose(2, 0, 1)[None]
    found = bundled_session(BUNDLED, "land").run(
        ["sky", "sunlit", "depth", "normal", "facing", "transfer", "matter", "view", "sun"],
        {"image": np.ascontiguousarray(image, np.float32)},
    )
    sky, sunlit, octaves, normal, facing, transfer, matter, view, sun = (o[0] for o in found)
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
    )


# Strokes and hints make new scenes of the same small copy.
_seen: WeakKeyDictionary[Working, LandMaps] = WeakKeyDictionary()
_looking = Lock()
