"""The network that looks for the sun, the sky behind it, and water (models/MODEL_CARD.md)."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.onnx_file import bundled_session

BUNDLED = Path(__file__).parents[1] / "models" / "suns.onnx"
LONG_SIDE = 320  # of the picture that the network sees
LIGHT_FLOOR = 0.01  # added to display-linear light before its logarithm (training/suns/model.py)
_STRIDE = 32


class SunMaps(NamedTuple):
    """What the network says, at a quarter of the size at which it sees the photo.

    Parameters
    ----------
    probability : (h, w) float32
        That the sun's centre is there.
    radius : (h, w) float32
        Of the disc or burnt core centred there, in widths of the picture.
    sharpness : (h, w) float32
        Probability that it has a limb, and is no bloomed core.
    clean : (h, w, 3) float32
        log(c + LIGHT_FLOOR) - log(x + LIGHT_FLOOR), x the photo in display-linear light and c the
        same without the sun, its halo and what the lens made of it; at most 0.
    water : (h, w) float32
        Probability of water, which may mirror the sun.
    """

    probability: np.ndarray
    radius: np.ndarray
    sharpness: np.ndarray
    clean: np.ndarray
    water: np.ndarray


def look_for_sun(working: Working) -> SunMaps:
    """Run the network on a photo's small copy; 30 ms on two cores.

    Raises
    ------
    AnalysisError
        When onnxruntime is missing.
    """
    scale = LONG_SIDE / max(working.width, working.height)
    width, height = (
        max(2, round(side * scale / _STRIDE)) * _STRIDE for side in (working.width, working.height)
    )
    image = np.clip(resize(working.encoded, width, height), 0, 1).transpose(2, 0, 1)[None]
    found, clean, water = bundled_session(BUNDLED, "sun").run(
        None, {"image": np.ascontiguousarray(image, np.float32)}
    )
    probability, radius, sharpness = found[0]
    log_ratio = np.minimum(clean[0], 0).transpose(1, 2, 0)
    return SunMaps(probability, radius, sharpness, log_ratio, water[0, 0])
