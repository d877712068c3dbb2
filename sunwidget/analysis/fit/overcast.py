"""White skies: what a fit cannot tell from a clear one, because it takes the white for balance.

The fit scales the clear sky per channel, as a camera's white balance does. An overcast or veiled
sky can be fitted so as well, and un-mixed from itself it holds no cloud. Two facts help: no white
balance bleaches a blue sky entirely, and no clear sky is grey from end to end. Where the sun's
disc is seen neither is asked: such a sky is clear or hazy.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from sunwidget.analysis.fit.fit import SkyFit
from sunwidget.analysis.images.working_copy import Working, saturation
from sunwidget.formats.color import LUMINANCE

_BLUE_BALANCE = -0.6  # log(red gain / blue gain) of the fits to clear blue skies of 40 photos
_LOW_SUN = (3.0, 10.0)  # degrees; below, sky and sun are of any colour
_NIGHT = 0.15  # encoded luminance below which a sky's colour is noise and lamps
_GREY = (0.03, 0.07)  # HSI saturation of an overcast sky, and of one with some blue or red


def believable(fit: SkyFit, working: Working, sky: np.ndarray) -> SkyFit:
    """Return the fit with no whiter a balance than clear blue skies have.

    Parameters
    ----------
    fit : SkyFit
    working : Working
    sky : (h, w) float32
        Sky matte.

    Returns
    -------
    SkyFit
        Its clear sky keeps the luminance. The same fit at sunset and at night.
    """
    inside = sky > 0.9
    if not inside.any() or float(np.median((working.encoded @ LUMINANCE)[inside])) < _NIGHT:
        return fit
    red, green, blue = fit.gain
    low, high = _LOW_SUN
    high_sun = float(np.clip((fit.sun[1] - low) / (high - low), 0, 1))
    excess = high_sun * max(0.0, float(np.log(red / blue)) - _BLUE_BALANCE)
    gain = np.array([red * np.exp(-excess / 2), green, blue * np.exp(excess / 2)])
    gain *= float(np.array(fit.gain) @ LUMINANCE) / float(gain @ LUMINANCE)
    return dataclasses.replace(fit, gain=(float(gain[0]), float(gain[1]), float(gain[2])))


def overcast(working: Working, sky: np.ndarray) -> np.ndarray:
    """Opacity (h, w) float32 where a sky that is grey from end to end is grey; else 0.

    Of the land it says how opaque it would be if it were sky. A photo without any colour says
    nothing, nor does a burnt or a night sky.
    """
    encoded = working.encoded
    # Three planes, as NumPy's maximum over a last axis of three takes twenty times as long.
    red, green, blue = np.moveaxis(encoded, -1, 0)
    brightest = np.maximum(np.maximum(red, green), blue)
    spread = brightest - np.minimum(np.minimum(red, green), blue)
    seen = (sky > 0.9) & (brightest < 0.97)
    none = np.zeros_like(sky)
    if np.count_nonzero(seen) < 200 or float(np.quantile(spread, 0.99)) < 0.012:
        return none
    if float(np.median((encoded @ LUMINANCE)[seen])) < _NIGHT:
        return none
    pure = saturation(encoded)
    share = float(np.mean(pure[seen] < sum(_GREY) / 2))
    everywhere = np.clip((share - 0.75) / 0.15, 0, 1)
    grey = np.clip((_GREY[1] - pure) / (_GREY[1] - _GREY[0]), 0, 1)
    return np.asarray(everywhere * grey, np.float32)
