"""Doubted skies are dropped, believed ones and small gaps stay; white skies count as cloud."""

import dataclasses

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.analysis import correct
from sunwidget.analysis.fit.fit import Response, SkyFit
from sunwidget.analysis.fit.overcast import limit_balance, overcast
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.segmentation.plausible import plausible
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.formats.color import LUMINANCE
from sunwidget.photo.photo import open_photo

SIZE = (120, 160)
UPPER = np.zeros(SIZE, np.float32)
UPPER[:45] = 1
FAINT = UPPER * np.where(np.arange(SIZE[1]) < 50, 0.97, 0.6).astype(np.float32)
"""Sure at one end only, as the network is of walls; refinement makes a clean mask of it."""


def flat(level=0.6, tint=(1.0, 1.0, 1.0)) -> Working:
    picture = np.clip(level * np.ones((*SIZE, 3)) * tint, 0, 1)
    picture[60:] *= (0.4, 0.6, 0.3)
    return Working.of(open_photo(np.round(255 * picture).astype(np.uint8)))


def test_a_faintly_believed_wall_is_dropped_and_a_believed_sky_is_kept():
    assert not plausible(UPPER, 0.65 * UPPER, flat())
    assert plausible(UPPER, 0.95 * UPPER, flat())


@pytest.mark.parametrize("level", [0.08, 1.0])
def test_night_and_burnt_skies_are_not_doubted(level):
    assert plausible(UPPER, 0.65 * UPPER, flat(level))


def test_a_given_mask_is_never_dropped_and_says_so_by_silence():
    scene = sw.analyze(flat().bytes, sky=FAINT)
    assert scene.doubted == 0
    assert scene.sky[:40].mean() > 0.9
    assert not any("No sky" in note for note in scene.warnings)


def test_a_dropped_sky_is_told_and_the_named_network_keeps_it(monkeypatch):
    from sunwidget.analysis.segmentation import coarse_sky

    monkeypatch.setattr(coarse_sky, "network", lambda working, *_: FAINT)
    monkeypatch.setitem(coarse_sky.METHODS, "network", lambda working: FAINT)
    doubted = sw.analyze(flat().bytes)
    assert doubted.sky.max() == 0
    assert doubted.doubted > 0.3
    assert any("No sky found" in note and "sky='network'" in note for note in doubted.warnings)
    named = sw.analyze(flat().bytes, sky="network")
    assert named.sky[:40].mean() > 0.9
    stroke = sw.Stroke("sky", ((0.1, 0.2), (0.9, 0.2)), 0.1)
    assert correct.corrected(doubted, sw.Edit(strokes=(stroke,))).sky[20:28, 30:130].min() == 1


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
