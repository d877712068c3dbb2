"""The network that finds the sun, the sky behind it, and water (models/MODEL_CARD.md)."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.bundled import run_twice, strided

BUNDLED = Path(__file__).parents[1] / "models" / "suns.onnx"
LONG_SIDE = 384  # of the network's input
LIGHT_FLOOR = 0.01  # added to display-linear light before its logarithm (training/suns/model.py)


class SunMaps(NamedTuple):
    """The network's outputs, at a quarter of the size of its input; ``clean`` at half.

    Parameters
    ----------
    probability : (h, w) float32
        Probability that the sun's center is there.
    radius : (h, w) float32
        Radius of the disc or clipped core centered there, in widths of the picture.
    sharpness : (h, w) float32
        Probability that it has a limb and is not a bloomed core.
    clean : (2 h, 2 w, 3) float32
        log(c + LIGHT_FLOOR) - log(x + LIGHT_FLOOR), x the photo in display-linear light and c the
        same without the sun, its halo and its lens artifacts; at most 0.
    water : (h, w) float32
        Probability of water, which may mirror the sun.
    """

    probability: np.ndarray
    radius: np.ndarray
    sharpness: np.ndarray
    clean: np.ndarray
    water: np.ndarray


def look_for_sun(working: Working) -> SunMaps:
    """Run the network on a photo's small copy; 60 ms on two cores.

    Raises
    ------
    AnalysisError
        If onnxruntime is missing.
    """
    size = working.width, working.height
    found, clean, water = run_twice(
        BUNDLED,
        "sun",
        ["sun", "clean", "water"],
        working.encoded,
        strided(*size, LONG_SIDE / max(size)),
    )
    probability, radius, sharpness = found
    log_ratio = np.minimum(clean, 0).transpose(1, 2, 0)
    return SunMaps(probability, radius, sharpness, log_ratio, water[0])
