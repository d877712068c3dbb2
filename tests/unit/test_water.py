"""Water: what is called water, by the analysis and by a person."""

import functools

import cv2
import numpy as np
import pytest
from relight_scenes import sample_scene

import sunwidget as sw

SIZE = (240, 160)
ROW = 90  # of the horizon
DAB = sw.Stroke("water", ((0.3, 0.8), (0.7, 0.8)), 0.03)
ROCK = sw.Stroke("not_water", ((0.2, 0.75),), 0.05)


@functools.cache
def shore(ground="sea"):
    """A hazy blue sky over the sea, or over a meadow, sand or a road, as 8-bit sRGB."""
    width, height = SIZE
    random = np.random.default_rng(3)
    rows = np.arange(height)[:, None, None] / height
    picture = np.array([0.35, 0.55, 0.85]) + rows * np.array([0.7, 0.45, 0.1])
    picture = np.broadcast_to(picture, (height, width, 3)).copy()
    noise = random.standard_normal((height, width)).astype(np.float32)
    color = {
        "sea": (0.13, 0.28, 0.40),
        "meadow": (0.25, 0.38, 0.12),
        "sand": (0.62, 0.52, 0.38),
        "road": (0.40, 0.39, 0.38),
    }[ground]
    spread = (9.0, 0.8) if ground == "sea" else (0.8, 0.8)
    noise = cv2.GaussianBlur(noise, (0, 0), spread[0], sigmaY=spread[1])
    noise /= noise.std()
    land = np.array(color) * (1 + 0.08 * noise[..., None])
    picture[ROW:] = land[ROW:]
    return np.round(np.clip(picture, 0, 1) * 255).astype(np.uint8)


@functools.cache
def scene(ground="sea", **hints):
    """The shore, analysed with its sky told, so that no network runs."""
    sky = (np.arange(SIZE[1])[:, None] < ROW).astype(np.float32) * np.ones(SIZE[0], np.float32)
    return sw.analyze(shore(ground), sky=sky, refine="none", horizon=float(ROW), fov=40.0, **hints)


def test_the_sea_is_water_and_the_sky_is_not():
    water = scene().water
    assert water[ROW + 3 :].mean() > 0.95
    assert water[: ROW - 2].max() == 0


@pytest.mark.parametrize("ground", ["meadow", "sand", "road"])
def test_land_is_no_water(ground):
    assert scene(ground).water.max() == 0


def test_none_calls_nothing_water():
    assert scene(water="none").water.max() == 0


def test_a_given_map_is_taken_at_its_word_but_for_the_sky():
    given = np.zeros((SIZE[1], SIZE[0]), np.float32)
    given[ROW - 20 :, :100] = 1
    sky = (np.arange(SIZE[1])[:, None] < ROW).astype(np.float32) * np.ones(SIZE[0], np.float32)
    photo = shore("meadow")
    found = sw.analyze(photo, sky=sky, refine="none", horizon=float(ROW), fov=40.0, water=given)
    assert np.array_equal(found.water, np.minimum(given, 1 - found.sky))


def test_the_coast_sample_has_water_and_the_meadow_has_none():
    assert sample_scene("coast").water.mean() > 0.1
    assert sample_scene("meadow").water.max() == 0


def test_a_water_stroke_takes_the_like_coloured_ground_near_it():
    base = scene("road")
    after = base.corrected(sw.Edit(strokes=(DAB,)))
    assert after.water[128, 72:168].min() == 1
    assert 0.03 < after.water.mean() < 0.5
    assert after.water[:ROW].max() == 0


def test_a_not_water_stroke_takes_water_away_under_the_brush():
    after = scene().corrected(sw.Edit(strokes=(ROCK,)))
    assert after.water[120, 48] == 0
    assert after.water[ROW + 5, 200] > 0.9


def test_strokes_about_water_leave_the_sky_and_the_fit_alone():
    base = scene()
    after = base.corrected(sw.Edit(strokes=(ROCK,)))
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
        drawn = base.corrected(sw.Edit(strokes=strokes[:count]))
    told = scene("road", clouds="rb_ratio", strokes=strokes)
    for name in ("sky", "water", "clouds", "backdrop"):
        assert np.array_equal(getattr(drawn, name), getattr(told, name)), name
    alone = base.corrected(sw.Edit(strokes=(sky,)))
    assert np.array_equal(drawn.sky, alone.sky)


def test_undoing_the_strokes_gives_the_very_scene_back():
    base = scene()
    assert base.corrected(sw.Edit(strokes=(ROCK,))).corrected(sw.Edit()) is not base
    assert base.corrected(sw.Edit()) is base


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
