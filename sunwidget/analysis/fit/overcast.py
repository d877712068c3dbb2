"""White skies, which a fit confuses with clear ones because it treats white as white balance.

The fit scales the clear sky per channel, as a camera's white balance does. An overcast or veiled
sky fits that way, too, and un-mixed from itself it has no cloud. Two facts help: no white balance
bleaches a blue sky entirely, and no clear sky is gray everywhere. If the sun's disc is visible,
neither is checked: such a sky is clear or hazy.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from sunwidget.analysis.fit.fit import SkyFit
from sunwidget.analysis.images.working_copy import Working, saturation
from sunwidget.formats.color import LUMINANCE

_BLUE_BALANCE = -0.6  # log(red gain / blue gain) of the fits to clear blue skies of 40 photos
_LOW_SUN = (3.0, 10.0)  # degrees; below, sky and sun can have any color
_NIGHT = 0.15  # encoded luminance below which a sky's color is noise and lamps
_GREY = (0.03, 0.07)  # HSI saturation of an overcast sky, and of one with some blue or red


def limit_balance(fit: SkyFit, working: Working, sky: np.ndarray) -> SkyFit:
    """Return the fit with its white balance limited to that of clear blue skies.

    Parameters
    ----------
    fit : SkyFit
    working : Working
    sky : (h, w) float32
        Sky matte.

    Returns
    -------
    SkyFit
        Its clear sky keeps the luminance. At sunset and at night it is the same fit.
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
    """Return the opacity (h, w) float32 of the gray parts of an entirely gray sky; else 0.

    The land gets the opacity that it would have as sky. A photo without any color, a clipped sky
    and a night sky give 0.
    """
    encoded = working.encoded
    # Separate planes are twenty times as fast as NumPy's maximum over a last axis of three.
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
    gray = np.clip((_GREY[1] - pure) / (_GREY[1] - _GREY[0]), 0, 1)
    return np.asarray(everywhere * gray, np.float32)
