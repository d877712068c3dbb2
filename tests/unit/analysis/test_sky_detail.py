"""Clouds told from a sky's slow light, and what goes on where the glare hides them."""

import numpy as np
import pytest

from sunwidget.analysis.backdrop.sky_detail import DETAILED, sky_detail

ROWS, COLUMNS = np.mgrid[:200, :300]
SLOW = -1 - ROWS / 200
LAYERS = 0.2 * np.sin(ROWS / 2.0)
FAR = np.hypot(COLUMNS - 150, ROWS - 90)
HIDDEN = (FAR < 30).astype(np.float32)
EVERYWHERE = np.ones_like(HIDDEN)


def logs(values):
    return np.repeat(np.asarray(values, np.float32)[..., None], 3, -1)


def detail(values, hidden=HIDDEN, keep=1 - HIDDEN, sky=EVERYWHERE):
    return sky_detail(logs(values), sky, hidden, keep)


def test_clouds_are_told_from_slow_light():
    found = detail(SLOW + LAYERS, 0 * HIDDEN)[20:-20, 20:-20]
    assert np.abs(found - logs(LAYERS)[20:-20, 20:-20]).max() < 0.06


def test_what_is_hidden_has_the_clouds_beside_it_and_nothing_of_its_own():
    glare = HIDDEN * 3.0
    found = detail(SLOW + LAYERS + glare)
    inside = HIDDEN > 0
    assert np.corrcoef(found[inside].ravel(), logs(LAYERS)[inside].ravel())[0, 1] > 0.9
    assert np.allclose(found, detail(SLOW + LAYERS), atol=0.02)


def test_the_photos_own_detail_counts_where_glare_only_brightens_it():
    blobs = 0.2 * np.sin(COLUMNS / 2.0) * ((FAR < 30) | (ROWS > 140))  # low down as strong
    kept, lost = (detail(SLOW + blobs, keep=EVERYWHERE * share) for share in (1, 0))
    inside = FAR < 20
    assert np.corrcoef(kept[inside][:, 0], blobs[inside])[0, 1] > 0.95
    assert np.abs(lost[inside]).max() < 0.03


def test_the_rim_of_a_disc_stands_out_no_more_than_clouds_do():
    grain = 0.02 * np.random.default_rng(4).standard_normal(SLOW.shape)
    rim = 1.0 * (np.abs(FAR - 12) < 1)
    found = detail(SLOW + grain + rim, keep=EVERYWHERE)[..., 0]
    assert np.abs(found[FAR < 30]).max() < 0.1


@pytest.mark.parametrize("shape", [(200, 300), (900, 1200)])
def test_a_large_photo_has_a_small_map(shape):
    nothing = np.zeros(shape, np.float32)
    assert max(sky_detail(logs(nothing), nothing + 1, nothing, nothing + 1).shape) <= DETAILED


def test_a_skyline_is_not_borrowed():
    """Twigs left of the glare, low down, stay out of it."""
    twigs = (COLUMNS < 110) & (ROWS > 80)
    sky = np.where(twigs, 0, 1).astype(np.float32)
    found = detail(np.where(twigs, -5.0, SLOW), sky=sky)
    assert np.abs(found[HIDDEN > 0]).max() < 0.1


def test_what_the_mask_takes_for_sky_beside_the_skyline_is_not_borrowed():
    sky = np.where(ROWS < 120, 1, 0).astype(np.float32)
    twigs = (ROWS >= 118) & (ROWS < 120)
    found = detail(np.where(ROWS < 118, SLOW, -5.0), sky=sky)
    assert np.abs(found[twigs & (HIDDEN > 0)]).max() < 0.3
