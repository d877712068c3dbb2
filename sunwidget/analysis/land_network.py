"""The network that sees how land lies and what light falls on it (models/MODEL_CARD.md)."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from sunwidget.analysis.onnx_file import bundled_session
from sunwidget.analysis.working import Working, resize

BUNDLED = Path(__file__).parent / "models" / "land.onnx"
AREA = 92_000  # pixels of the picture that the network sees
_STRIDE = 32


class LandMaps(NamedTuple):
    """What is used of its answers; all but ``sunlit`` at half of the size that the network sees.

    Parameters
    ----------
    sunlit : (h, w) float32
        Share of the sun's disc that the surface sees, [0, 1]; 0 without sunshine.
    normal : (h/2, w/2, 3) float32
        Unit normals: to the camera's right, up, and towards it.
    rise : (h/2, w/2, 8) float32
        Sine of the height from which a sun may be expected to reach the place, for bearings of 0,
        45 … 315 degrees clockwise from the camera's heading.
    openness : (h/2, w/2) float32
        Share of an even sky's light, weighed by the cosine, that reaches the surface, [0, 1].
    """

    sunlit: np.ndarray
    normal: np.ndarray
    rise: np.ndarray
    openness: np.ndarray


def look_at_land(working: Working) -> LandMaps:
    """Run the network on a photo's small copy; 0.1 s on two cores, once a copy.

    Raises
    ------
    AnalysisError
        When onnxruntime is missing.
    """
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
        ["sunlit", "normal", "rise", "openness"],
        {"image": np.ascontiguousarray(image, np.float32)},
    )
    sunlit, normal, rise, openness = (output[0] for output in found)
    return LandMaps(sunlit[0], normal.transpose(1, 2, 0), rise.transpose(1, 2, 0), openness[0])


# Strokes and hints make new scenes of the same small copy.
_seen: WeakKeyDictionary[Working, LandMaps] = WeakKeyDictionary()
