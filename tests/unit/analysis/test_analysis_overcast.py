"""White skies count as cloud, and no white balance bleaches a blue one."""

import dataclasses

import numpy as np
import pytest

from sunwidget.analysis.fit.fit import Response, SkyFit
from sunwidget.analysis.fit.overcast import limit_balance, overcast
from sunwidget.analysis.images.working_copy import Working
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.formats.color import LUMINANCE
from sunwidget.photo.photo import open_photo

SIZE = (120, 160)
UPPER = np.zeros(SIZE, np.float32)
UPPER[:45] = 1


def flat(level=0.6, tint=(1.0, 1.0, 1.0)) -> Working:
    picture = np.clip(level * np.ones((*SIZE, 3)) * tint, 0, 1)
    picture[60:] *= (0.4, 0.6, 0.3)
    return Working.of(open_photo(np.round(255 * picture).astype(np.uint8)))


def test_a_sky_grey_from_end_to_end_is_overcast():
    assert overcast(flat(), UPPER)[5:40].min() > 0.95


def test_blue_pink_and_night_skies_and_photos_without_colour_are_not_overcast():
    assert overcast(flat(tint=(0.7, 0.85, 1.1)), UPPER).max() == 0
    assert overcast(flat(tint=(1.15, 0.95, 1.0)), UPPER).max() == 0
    assert overcast(flat(0.06), UPPER).max() == 0
    grey = Working.of(open_photo(np.full((*SIZE, 3), 140, np.uint8)))
    assert overcast(grey, UPPER).max() == 0


def test_no_white_balance_bleaches_a_blue_sky():
    fit = SkyFit(Atmosphere(), Response(), (0.06, 0.05, 0.04), (0.0, 3.0, 2.0), (0.0, 50.0))
    clear = limit_balance(fit, flat(), UPPER)
    assert np.log(clear.gain[0] / clear.gain[2]) == pytest.approx(-0.6)
    assert np.array(clear.gain) @ LUMINANCE == pytest.approx(np.array(fit.gain) @ LUMINANCE)
    # A low sun reddens sky and light alike, and at night nothing is known.
    low = dataclasses.replace(fit, sun=(0.0, 2.0))
    assert limit_balance(low, flat(), UPPER).gain == pytest.approx(low.gain)
    assert limit_balance(fit, flat(0.06), UPPER) is fit
