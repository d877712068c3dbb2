"""What is called water, by the analysis and by a person."""

from typing import NamedTuple

import cv2
import numpy as np
import pytest
from relight_scenes import sample_scene
from water_scenes import ROW, SIZE, SKY, scene, shore

import sunwidget as sw
from sunwidget.analysis import correct
from sunwidget.analysis.horizon.horizon import Horizon
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.sun import SunMaps
from sunwidget.analysis.water import water
from sunwidget.photo.photo import open_photo

DAB = sw.Stroke("water", ((0.3, 0.8), (0.7, 0.8)), 0.03)
ROCK = sw.Stroke("not_water", ((0.2, 0.75),), 0.05)


class Seen(NamedTuple):
    """What the other two networks say."""

    water: np.ndarray
    sky: np.ndarray


def found(probability, picture=None, sun_column=None, horizon=ROW, sky=None):
    """What becomes of the networks' probabilities (h, w) at a quarter of the size."""
    plain = np.zeros(probability.shape, np.float32)
    clean = np.zeros((*probability.shape, 3), np.float32)
    sun = plain.copy()
    if sun_column is not None:
        sun[ROW // 8, sun_column] = 0.9
    maps = SunMaps(sun, plain, plain, clean, probability)
    working = Working.of(open_photo(shore() if picture is None else picture))
    with pytest.MonkeyPatch.context() as patch:
        for look in ("look_at_sky", "look_at_land"):
            patch.setattr(water, look, lambda _: Seen(probability, plain if sky is None else sky))
        return water.METHODS["network"](working, SKY, Horizon(float(horizon)), maps)


@pytest.fixture
def sea():
    """The network is sure of the sea, and of a part of the sky."""
    probability = np.full((SIZE[1] // 4, SIZE[0] // 4), 0.9, np.float32)
    probability[: ROW // 8] = 0.05
    return probability


def test_the_sea_is_water_and_the_sky_is_not(sea):
    assert found(sea)[ROW + 3 :].mean() > 0.95
    assert found(sea)[: ROW - 2].max() == 0


def test_what_the_network_hardly_believes_and_specks_are_no_water(sea):
    assert found(np.where(sea > 0.5, np.float32(0.01), 0)).max() == 0
    speck = np.zeros_like(sea)
    speck[30, 20] = 1
    assert found(speck).max() == 0


def test_a_burnt_column_between_water_is_water_and_a_dark_pier_is_not(sea):
    sea[ROW // 4 :, 28:32] = 0.1
    for shade, wet in ((255, True), (10, False)):
        picture = shore().copy()
        picture[ROW:, 112:128] = shade
        middle = found(sea, picture)[ROW + 10 : -10, 116:124]
        assert (middle.mean() > 0.7) == wet


def test_a_wide_column_is_water_below_a_sun_only(sea):
    sea[ROW // 4 :, 23:37] = 0.005  # a quarter of the width
    middle = slice(ROW + 10, -10), slice(116, 124)
    assert found(sea, sun_column=30)[middle].mean() > 0.7
    assert found(sea)[middle].max() < 0.3
    assert found(sea, sun_column=2)[middle].max() < 0.3


def test_the_last_of_the_water_reaches_the_sky_and_a_dark_shore_does_not(sea):
    sea[: ROW // 4 + 2] = 0.05
    assert found(sea)[ROW + 1 : ROW + 5].mean() > 0.7
    far = shore().copy()
    far[ROW : ROW + 6] = 10
    assert found(sea, far)[ROW + 1 : ROW + 5].mean() < 0.3


def test_a_horizon_a_row_too_low_leaves_no_strip_of_land(sea):
    picture = shore().copy()
    picture[: ROW + 6] = 240  # sky and far water burnt alike
    assert found(sea, picture, horizon=ROW + 1)[ROW:].min() > 0.7


def test_a_bright_strip_above_a_guessed_horizon_is_water_where_no_network_sees_land(sea):
    strip = slice(ROW + 1, ROW + 5)
    hazy, dark = shore().copy(), shore().copy()
    hazy[ROW : ROW + 6], dark[ROW : ROW + 6] = 200, 10
    sea[: ROW // 4 + 2] = 0.05
    sky = np.where(sea < 0.5, np.float32(0.7), 0)
    assert found(sea, hazy, horizon=ROW + 8)[strip].mean() < 0.3
    assert found(sea, hazy, horizon=ROW + 8, sky=sky)[strip].mean() > 0.7
    assert found(sea, dark, horizon=ROW + 8, sky=sky)[strip].mean() < 0.3


def test_a_cleft_in_the_sky_is_no_water(sea, monkeypatch):
    cloud = SKY.copy()
    cloud[10:12, 20:60] = 0  # what the matte took for land
    monkeypatch.setitem(globals(), "SKY", cloud)
    assert found(sea)[:20].max() == 0


def test_a_dark_shore_below_a_bright_sky_stays_land():
    picture = shore().copy()
    picture[ROW : ROW + 8] = 0
    mask = np.zeros_like(SKY)
    mask[ROW + 6 :] = 1  # reaches two rows into the shore
    edge = water.soft_edged(Working.of(open_photo(picture)), SKY, mask)
    assert edge[ROW : ROW + 8].max() < 0.8
    assert edge[ROW + 20 :].min() > 0.9


def test_none_calls_nothing_water():
    assert scene(water="none").water.max() == 0


def test_a_given_map_is_taken_at_its_word_but_for_the_sky():
    given = np.zeros((SIZE[1], SIZE[0]), np.float32)
    given[ROW - 20 :, :100] = 1
    photo = shore("meadow")
    told = sw.analyze(photo, sky=SKY, refine="none", horizon=float(ROW), fov=40.0, water=given)
    assert np.array_equal(told.water, np.minimum(given, 1 - told.sky))


def test_the_coast_sample_has_water_and_the_meadow_has_none():
    assert sample_scene("coast").water.mean() > 0.1
    assert sample_scene("meadow").water.max() == 0


def test_a_water_stroke_takes_the_like_coloured_ground_near_it():
    base = scene("road")
    after = correct.corrected(base, sw.Edit(strokes=(DAB,)))
    assert after.water[128, 72:168].min() == 1
    assert 0.03 < after.water.mean() < 0.5
    assert after.water[:ROW].max() == 0


def test_a_not_water_stroke_takes_water_away_under_the_brush():
    after = correct.corrected(scene(), sw.Edit(strokes=(ROCK,)))
    assert after.water[120, 48] == 0
    assert after.water[ROW + 5, 200] > 0.9


def test_strokes_about_water_leave_the_sky_and_the_fit_alone():
    base = scene()
    after = correct.corrected(base, sw.Edit(strokes=(ROCK,)))
    for name in ("sky", "clouds", "backdrop", "glare"):
        assert getattr(after, name) is getattr(base, name)
    assert after.fitted is base.fitted


@pytest.mark.parametrize("way", [(1, 2, 3), (3,)])
def test_strokes_of_both_kinds_give_the_same_maps_whichever_way_they_were_drawn(way):
    sky = sw.Stroke("not_sky", ((0.1, 0.2), (0.3, 0.25)), 0.04)
    strokes = (DAB, sky, ROCK)
    base = scene("road", clouds="rb_ratio")
    base.memory.scenes.clear()
    base.memory.paintings.clear()
    for count in way:
        drawn = correct.corrected(base, sw.Edit(strokes=strokes[:count]))
    told = scene("road", clouds="rb_ratio", strokes=strokes)
    for name in ("sky", "water", "clouds", "backdrop"):
        assert np.array_equal(getattr(drawn, name), getattr(told, name)), name
    alone = correct.corrected(base, sw.Edit(strokes=(sky,)))
    assert np.array_equal(drawn.sky, alone.sky)


def test_undoing_the_strokes_gives_the_very_scene_back():
    base = scene()
    drawn = correct.corrected(base, sw.Edit(strokes=(ROCK,)))
    assert correct.corrected(drawn, sw.Edit()) is not base
    assert correct.corrected(base, sw.Edit()) is base


@pytest.mark.shared
def test_no_photo_of_land_has_water(shared):
    """By eye: meadows, roads, snow, sand, roofs, fog and night among the shared photos."""
    land = ("pmlodzia_clouds109", "pop-os_jared-evans-119758", "zero1777_death")
    sea = ("pmlodzia_shine107",)
    for name in land + sea:
        path = shared / "data" / "photos" / f"{name}.jpg"
        if not path.exists():
            pytest.skip("no photos in the shared folder")
        photo = sw.open(path).encoded
        scale = 320 / max(photo.shape[:2])
        small = cv2.resize(photo, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
        assert (sw.analyze(small).water.mean() > 0.1) == (name in sea), name
