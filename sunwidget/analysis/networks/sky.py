"""The network that finds sky and water (models/MODEL_CARD.md)."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.bundled import once, run_twice
from sunwidget.analysis.networks.onnx_file import SIDE

BUNDLED = Path(__file__).parents[1] / "models" / "sky.onnx"


class SkyMaps(NamedTuple):
    """The network's outputs for the photo squeezed to 384 × 384, as in the thesis.

    Parameters
    ----------
    sky : (h, w) float32
        Probability of sky, clouds and sun included.
    water : (h, w) float32
        Probability of water.
    """

    sky: np.ndarray
    water: np.ndarray


@once
def look_at_sky(working: Working) -> SkyMaps:
    """Run the network on a photo's small copy, once per copy; 80 ms on two cores.

    Raises
    ------
    AnalysisError
        If onnxruntime is missing.
    """
    sky, water = run_twice(BUNDLED, "sky", ["sky", "water"], working.encoded, (SIDE, SIDE))
    return SkyMaps(sky[0], water[0])
