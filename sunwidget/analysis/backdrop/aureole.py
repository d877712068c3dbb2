"""The aureole of the photo's sun: what its sky has all round it beyond the fitted model.

Lens and haze brighten the sky farther out than the network erases, and by more than the model's
air does. When the sun moves away this would stay as a ring around the filled place.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.fill import fill_by_layers
from sunwidget.analysis.images.rings import all_round, interpolated
from sunwidget.analysis.images.working_copy import smoothstep
from sunwidget.analysis.sun.sun import away_from
from sunwidget.geometry.camera import Point

_INNER = 0.9  # share of the hidden pixels that are nearer to the sun than the aureole reaches in
_OUTER, _WIDEST, _LEAST = 2.0, 0.45, 1.2  # of the inner radius; widths; of the inner radius
_FADES = 0.6  # of the outer radius: from here on it fades
_BEYOND, _NEAREST = 0.75, 0.25  # of the outer radius: from where, and how far, the sky is compared
_RINGS = 24  # up to the outer radius


def find_aureole(
    excess: np.ndarray, known: np.ndarray, hidden: np.ndarray, sun: Point
) -> np.ndarray:
    """Return what the sky has all round the sun, (h, w, 3), log of light, at least 0.

    It is compared with the sky farther out in the same rows. Two in three pixels at the same
    distance have it, or it is a cloud; it fades outwards, and ends softly.

    Parameters
    ----------
    excess : (h, w, 3) float32
        Log of the photo's light over the model's.
    known : (h, w) float32
        Weight of the sky's pixels, [0, 1].
    hidden : (h, w) bool
        What the glare hides.
    sun : tuple
        Column and row, in pixels.
    """
    height, width = known.shape
    nothing = np.zeros_like(excess)
    if not hidden.any():
        return nothing
    away = away_from((height, width), *sun) / width
    inner = float(np.quantile(away[hidden], _INNER))
    outer = min(_OUTER * inner, max(_WIDEST, _LEAST * inner))
    beyond = known * smoothstep(_BEYOND * outer, outer, away)
    beyond = beyond * np.exp(-np.maximum(away / outer - 1, 0) / _NEAREST)
    more = excess - fill_by_layers(excess, beyond.astype(np.float32))
    middles, profile = all_round(more, (known > 0.5) & (away < outer), away, outer / _RINGS)
    if not len(middles):
        return nothing
    profile = np.maximum.accumulate(np.maximum(profile, 0)[::-1])[::-1]
    fading = 1 - smoothstep(_FADES * outer, outer, away)
    return np.asarray(interpolated(away, middles, profile) * fading[..., None], np.float32)
