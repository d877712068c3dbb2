"""Water: what is called water, by the analysis and by a person, and how it is relit."""

import dataclasses
import functools

import cv2
import numpy as np
import pytest
from relight_scenes import sample_scene

import sunwidget as sw
from sunwidget.analysis import correct, frame_inputs
from sunwidget.analysis.horizon.horizon import Horizon
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.sun import SunMaps
from sunwidget.analysis.water import water
from sunwidget.geometry.camera import Camera
from sunwidget.photo.photo import open_photo

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


SKY = (np.arange(SIZE[1])[:, None] < ROW).astype(np.float32) * np.ones(SIZE[0], np.float32)
TOLD = {"sky": SKY, "water": 1 - SKY, "refine": "none", "horizon": float(ROW), "fov": 40.0}


@functools.cache
def scene(ground="sea", **hints):
    """The shore, analysed with its sky and its water told."""
    told = TOLD if ground == "sea" else TOLD | {"water": "none"}
    return sw.analyze(shore(ground), **(told | hints))


def found(probability, picture=None, sun_column=None, horizon=ROW):
    """What becomes of the network's probabilities (h, w) at a quarter of the size."""
    plain = np.zeros(probability.shape, np.float32)
    clean = np.zeros((*probability.shape, 3), np.float32)
    sun = plain.copy()
    if sun_column is not None:
        sun[ROW // 8, sun_column] = 0.9
    maps = SunMaps(sun, plain, plain, clean, probability)
    working = Working.of(open_photo(shore() if picture is None else picture))
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


def test_doubtful_ground_is_water_where_it_looks_like_the_water_beside_it(sea):
    sea[ROW // 4 :, :20] = 0.1  # a third of the width, to the edge
    part = slice(ROW + 10, -10), slice(8, 64)
    assert found(sea)[part].mean() > 0.9
    beach = shore().copy()
    beach[ROW:, :80] = shore("sand")[ROW:, :80]
    assert found(sea, beach)[part].mean() < 0.1


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


MOVES = [(25, 10), (8, 2), (-20, 30)]


@functools.cache
def glittering():
    """A sea with the sun over it and its glints, as ``shore`` else; the sun is told."""
    picture = shore().astype(np.float32)
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]]
    random = np.random.default_rng(8)
    waves = cv2.GaussianBlur(
        random.standard_normal(rows.shape).astype(np.float32), (0, 0), 3.0, sigmaY=0.7
    )
    path = np.exp(-0.5 * ((columns - 150) / 10.0) ** 2) * (rows > ROW)
    picture += (260 * path * (0.8 + waves / waves.std() * 0.2))[..., None]
    picture[np.hypot(rows - 40, columns - 150) < 4] = 255
    return np.round(np.clip(picture, 0, 255)).astype(np.uint8)


@functools.cache
def sunny():
    """``glittering``, analysed with sky, water, horizon and sun told."""
    return sw.analyze(glittering(), sun=(150, 40), **TOLD)


def column_light(picture, left, right):
    """Mean code value of the water between two columns."""
    return float(picture[ROW + 10 :, left:right].mean())


def test_an_unmoved_sun_leaves_water_to_the_bit():
    assert sunny().water.mean() > 0.3
    assert np.array_equal(sw.render(sunny()), glittering())


@pytest.mark.parametrize("move", MOVES)
def test_water_strength_zero_leaves_out_what_water_does(move):
    scene = sunny()
    edit = sw.Edit(sun_azimuth=move[0], sun_elevation=move[1], water_strength=0)
    off = sw.render(scene, edit)
    # The zone of glints is wider where water is known, and is read at a quarter of the size.
    dry = dataclasses.replace(scene, water_map=np.zeros_like(scene.water))
    other = frame_inputs.surface(scene)[..., 2] != frame_inputs.surface(dry)[..., 2]
    still = cv2.dilate(other.astype(np.uint8), np.ones((17, 17), np.uint8)) == 0
    assert still[ROW:].mean() > 0.3
    rough = sw.render(scene, edit.replace(glitter=3, wind_speed=9))
    assert np.array_equal(off[still], rough[still])
    on = sw.render(scene, edit.replace(water_strength=1)).astype(int)
    wet = cv2.resize(scene.water, off.shape[1::-1]) > 0.9
    assert np.abs(on - off)[wet].mean() > 2
    # As land: with the light that falls on it, and no picture of the sky.
    above = np.log2((sw.render(scene)[wet].mean(0) + 1) / (off[wet].mean(0) + 1))
    assert np.ptp(above) < 1


def test_the_old_glints_go_and_new_ones_come():
    scene = sunny()
    old = column_light(glittering(), 140, 160)
    azimuth, _ = scene.camera.angles(60, ROW)
    moved = sw.render(scene, sw.Edit(sun_azimuth=azimuth, auto_exposure=0))
    beside = column_light(moved, 190, 220)
    assert abs(column_light(moved, 140, 160) - beside) < 0.2 * (old - beside)
    assert column_light(moved, 50, 70) > beside + 40


def test_posts_beside_the_old_glints_neither_repeat_in_their_place_nor_darken_it():
    posts = glittering().copy()
    for left in (12, 33, 52, 71, 214, 229):
        posts[ROW + 6 :, left : left + 3] = 8
    away = sw.Edit(sun_azimuth=90, sun_elevation=35)
    plain, posted = (
        sw.render(each, away)[ROW + 12 :, 135:165].astype(float)
        for each in (sunny(), sw.analyze(posts, sun=(150, 40), **TOLD))
    )
    assert abs(posted.mean() - plain.mean()) < 3  # levels of 255
    assert posted.mean((0, 2)).std() < plain.mean((0, 2)).std() + 1


def test_water_under_a_wide_column_is_as_bright_as_beside_it():
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]]
    waves = cv2.GaussianBlur(
        np.random.default_rng(8).standard_normal(rows.shape), (0, 0), 3.0, sigmaY=0.7
    )
    away = np.hypot(columns - 150, rows - 75)
    picture = shore().astype(np.float64)
    picture[:ROW] += 150 * np.exp(-away / 25)[:ROW, :, None]
    path = np.exp(-0.5 * ((columns - 150) / 25) ** 2) * (rows > ROW)
    picture += (200 * path * (0.8 + 0.2 * waves / waves.std()))[..., None]
    picture[away < 4] = 255
    picture = np.round(np.clip(picture, 0, 255)).astype(np.uint8)
    scene = sw.analyze(picture, sun=(150, 75), **TOLD | {"fov": 60.0})
    moved = sw.render(scene, sw.Edit(sun_azimuth=90, sun_elevation=35))[ROW + 4 : ROW + 34]
    beside = (moved[:, 100:120].mean() + moved[:, 180:200].mean()) / 2
    # Its aureole leaves the mirrored sky once, not twice.
    assert moved[:, 140:160].mean() > 0.96 * beside


def test_a_dark_post_in_the_old_glints_stays_dark():
    post = glittering().copy()
    post[ROW + 20 : ROW + 50, 146:153] = 8
    moved = sw.render(
        sw.analyze(post, sun=(150, 40), **TOLD), sw.Edit(sun_azimuth=90, sun_elevation=35)
    )[ROW + 25 : ROW + 45]
    assert moved[:, 148:151].mean() < 0.4 * moved[:, 120:140].mean()


def test_glints_fade_as_the_sun_sets_and_follow_their_slider():
    scene = sunny()
    azimuth, _ = scene.camera.angles(60, ROW)
    light = [
        column_light(sw.render(scene, sw.Edit(sun_azimuth=azimuth, **change)), 50, 70)
        for change in (
            {"glitter": 0, "sun_elevation": 6},
            {"glitter": 1, "sun_elevation": 6},
            {"glitter": 3, "sun_elevation": 6},
        )
    ]
    assert light[0] + 20 < light[1] <= light[2]
    night = sw.Edit(sun_azimuth=azimuth, sun_elevation=-3)
    without = sw.render(scene, night.replace(glitter=0))
    assert np.array_equal(sw.render(scene, night), without)


def test_wind_widens_the_glints():
    scene = sunny()
    azimuth, _ = scene.camera.angles(60, ROW)
    edit = sw.Edit(sun_azimuth=azimuth, sun_elevation=10, auto_exposure=0)
    breadth = []
    for speed in (1, 15):
        bright = sw.render(scene, edit.replace(wind_speed=speed))[ROW + 10 :, :130].mean(
            axis=(0, 2)
        )
        breadth.append(int((bright > np.median(bright) + 25).sum()))
    assert breadth[0] > 3
    assert breadth[1] > 1.3 * breadth[0]


def test_glints_move_no_faster_than_the_sun():
    scene = sunny()
    # A tenth of a pixel here is a pixel of a photo ten times as wide.
    step = 0.1 * (scene.camera.angles(101, 60)[0] - scene.camera.angles(100, 60)[0])
    suns = [sw.Edit(sun_azimuth=-6 + k * step, sun_elevation=9) for k in (0, 1, 2)]
    codes = [np.clip(sw.render(scene, edit, dtype="float32"), 0, 1) ** (1 / 2.2) for edit in suns]
    steps = [np.abs(codes[k + 1] - codes[k])[ROW + 2 :] for k in (0, 1)]
    assert 0 < max(step.max() for step in steps) < 0.1
    assert max(step.mean() for step in steps) < 0.003


def test_water_is_rougher_where_it_glitters_wider():
    from sunwidget.analysis.water.glitter import roughness

    rough = []
    for width in (3.0, 12.0):
        linear = np.full((160, 240, 3), 0.05, np.float32)
        columns = np.arange(240)
        linear[90:] += np.exp(-0.5 * ((columns - 120) / width) ** 2)[:, None] * 30
        working = Working(np.minimum(linear, 1), linear, linear, (1, 1))
        water = (np.arange(160)[:, None] >= 90) * np.ones(240, np.float32)
        camera = Camera.from_horizon(240, 160, 40.0, 90.0)
        rough.append(roughness(working, water.astype(np.float32), camera, (0.0, 12.0)))
    assert rough[0] < 0.5 * rough[1]
    flat = Working(np.full((160, 240, 3), 0.2, np.float32), linear, linear, (1, 1))
    assert roughness(flat, water.astype(np.float32), camera, (0.0, 12.0)) == 1


def test_a_large_picture_has_the_water_of_its_preview():
    coast = sample_scene("coast")
    edit = sw.Edit(sun_azimuth=20, sun_elevation=25)
    small, large = (
        sw.render(coast, edit, size=size, dtype="float32") for size in ((300, 200), (1200, 800))
    )
    large = cv2.resize(large, (300, 200), interpolation=cv2.INTER_AREA)
    water = cv2.resize(coast.water.astype(np.float32), (300, 200)) > 0.9
    codes = [255 * np.clip(light[water], 0, 1) ** (1 / 2.2) for light in (small, large)]
    assert np.abs(codes[1] - codes[0]).mean() < 2.8  # of 255; the frayed rims of a column sparkle


def test_water_that_is_black_is_finite():
    picture = np.full((24, 32, 3), 120, np.uint8)
    picture[12:] = 0  # as bright as nothing: a share of it was once no number
    working = Working.of(open_photo(picture))
    sky, ground, wet = (np.zeros((24, 32), np.float32) for _ in range(3))
    sky[:12], ground[12:], wet[12:, 4:28] = 1, 1, 1
    empty = np.zeros((6, 8), np.float32)
    empty[2, 4] = 0.9
    shown = dict.fromkeys(SunMaps._fields, empty) | {"clean": np.zeros((6, 8, 3), np.float32)}
    with np.errstate(all="raise"):
        found = water._with_glints(working, sky, ground, wet, SunMaps(**shown))
    assert np.isfinite(found).all()
    np.testing.assert_array_equal(found[12:, 4:28], 1)
