"""How water is relit: what it mirrors, its glints, its color."""

import dataclasses
import functools

import cv2
import numpy as np
import pytest
from relight_scenes import known_photo, sample_scene
from water_scenes import ROW, SIZE, TOLD, shore

import sunwidget as sw
from sunwidget.analysis import frame_inputs
from sunwidget.analysis.fit.fit import Response
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.sun import SunMaps
from sunwidget.analysis.water import water
from sunwidget.analysis.water.glitter import mirrored, own_glints
from sunwidget.formats.color import srgb_to_linear
from sunwidget.geometry.camera import Camera
from sunwidget.photo.photo import open_photo
from sunwidget.renderer import render_pass

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


def test_a_pixel_of_the_skyline_has_the_water_below_it_with_its_glints():
    matte = TOLD["sky"].copy()
    matte[ROW] = 0.6
    told = TOLD | {"sky": matte, "water": np.where(matte > 0, 0, 1).astype(np.float32)}
    scene = sw.analyze(glittering(), sun=(150, 40), **told)
    marks = frame_inputs.surface(scene)[..., 1:3]
    assert marks[ROW, 150].min() > 0.9
    assert marks[ROW, 40] == pytest.approx(marks[ROW + 1, 40], abs=0.05)
    assert marks[: ROW - 1].max() == 0


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


def test_the_outline_of_a_rock_beside_the_old_glints_does_not_repeat_in_their_place():
    calm = glittering().astype(np.float32)
    calm[ROW + 1 :] = cv2.GaussianBlur(calm[ROW + 1 :], (0, 0), 6)
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]]
    distance = np.hypot((rows - ROW - 40) / 6, (columns - 45) / 12)  # 1 on the outline
    rock = (1 / (1 + np.exp(np.clip(25 * (distance - 1), -50, 50))))[..., None]
    away = sw.Edit(sun_azimuth=90, sun_elevation=35)
    plain, with_rock = (
        sw.render(sw.analyze(np.round(picture).astype(np.uint8), sun=(150, 40), **TOLD), away)
        for picture in (calm, calm + rock * (12 - calm))
    )
    apart = (with_rock.astype(float) - plain)[ROW + 12 :, 130:170].mean(-1)  # levels of 255
    assert (apart - cv2.GaussianBlur(apart, (0, 0), 5)).min() > -1


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


def test_orange_glints_leave_blue_water_not_green():
    glints = glittering().astype(int) - shore()
    photo = np.round(shore() + glints * (1.0, 0.55, -0.3)).clip(0, 255).astype(np.uint8)
    scene = sw.analyze(photo, sun=(150, 40), **TOLD)
    moved = srgb_to_linear(sw.render(scene, sw.Edit(sun_azimuth=90, sun_elevation=35)) / 255)
    column, beside = (moved[ROW + 10 :, a:b].mean((0, 1)) for a, b in ((144, 156), (90, 110)))
    assert column[2] / column[1] == pytest.approx(beside[2] / beside[1], rel=0.1)


def test_a_dark_post_in_the_old_glints_stays_dark():
    post = glittering().copy()
    post[ROW + 20 : ROW + 50, 146:153] = 8
    moved = sw.render(
        sw.analyze(post, sun=(150, 40), **TOLD), sw.Edit(sun_azimuth=90, sun_elevation=35)
    )[ROW + 25 : ROW + 45]
    assert moved[:, 148:151].mean() < 0.4 * moved[:, 120:140].mean()


def test_somebody_in_front_of_the_old_glints_does_not_fade_with_them():
    walker = glittering().copy()
    walker[ROW + 20 : ROW + 50, 146:153] = (30, 26, 22)
    scene = sw.analyze(walker, sun=(150, 40), **TOLD)
    away = sw.render(scene, sw.Edit(sun_azimuth=90, sun_elevation=35, auto_exposure=0))
    before, after = (p[ROW + 25 : ROW + 45, 148:151].mean() for p in (walker, away))
    assert after < before + 5  # levels of 255


@pytest.mark.parametrize("sun", [(150, 40), None])
def test_foam_away_from_the_suns_column_stays_white(sun):
    foam = glittering().copy()
    foam[ROW + 30 : ROW + 44, 20:60] = 245
    if sun is None:  # nor does the photo have glints
        foam[:, 110:190] = foam[:, 70:71]
    scene = sw.analyze(foam, sun=sun, **TOLD)
    moved = sw.render(scene, sw.Edit(sun_azimuth=90, sun_elevation=35))
    white, beside = moved[ROW + 33 : ROW + 41, 25:55], moved[ROW + 33 : ROW + 41, 65:85]
    assert white.mean() > beside.mean() + 80


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


def test_the_brightest_glints_are_almost_white():
    scene = sunny()
    azimuth, _ = scene.camera.angles(60, ROW)
    light = sw.render(scene, sw.Edit(sun_azimuth=azimuth, sun_elevation=6))[ROW + 10 :, 40:80]
    darkest = light.min(axis=-1)  # of the channels
    middle, brightest = np.percentile(darkest, (50, 97))
    assert brightest > 205
    assert middle < 0.7 * brightest


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


def lit_by(light, elevation, rough):
    """A photo of dark water below a sun of this light, and what ``own_glints`` takes."""
    camera = Camera.from_horizon(240, 160, 40.0, 80.0)
    sun = (0.0, elevation)
    linear = np.full((160, 240, 3), 0.02, np.float32)
    linear[80:] += light * mirrored(camera, sun, rough)[80:, :, None]
    linear = Response().display_light(linear).astype(np.float32)
    working = Working(linear, linear, linear, (1, 1))
    water = (np.arange(160)[:, None] >= 80) * np.ones(240, np.float32)
    return working, water.astype(np.float32), camera, sun, Response(), rough


@pytest.mark.parametrize("elevation", [0.5, 3.0, 9.0])
def test_the_photos_glints_tell_how_bright_their_sun_is(elevation):
    faint, bright = (own_glints(*lit_by(light, elevation, 0.3)) for light in (0.05, 0.15))
    assert 0.01 < faint < 0.05
    assert bright == pytest.approx(3 * faint, rel=0.05)


def test_without_water_below_the_sun_its_glints_are_unknown():
    working, water, *told = lit_by(0.5, 6.0, 0.3)
    water[:, 90:150] = 0
    assert own_glints(working, water, *told) == 0
    assert own_glints(working, np.zeros_like(water), *told) == 0


def test_kernel_and_shader_have_the_same_glints():
    scene = sunny()
    edit = sw.Edit(sun_azimuth=4.0, sun_elevation=8.0)
    drawn = render_pass(scene, edit, "mirror_edit")[..., 3]
    height, width = drawn.shape
    rough = frame_inputs.uniforms(scene)["water_roughness"]
    found = mirrored(scene.camera.resized(width, height), (4.0, 8.0), rough)
    below = slice(int(ROW * height / SIZE[1]) + 3, None)
    drawn, found = (drawn / (1 + drawn))[below], found[below]
    # The shader's waves are longer across the wind than along it, the kernel's alike.
    assert found.sum() == pytest.approx(drawn.sum(), rel=0.15)
    assert np.corrcoef(found.ravel(), drawn.ravel())[0, 1] > 0.97


def test_a_photos_column_stays_as_its_sun_sinks_in_haze(monkeypatch):
    scene = sunny()
    hazy = scene.fitted.atmosphere.replace(aerosol_optical_depth=0.5)
    edit = sw.Edit(sun_azimuth=scene.sun.azimuth - 12, sun_elevation=2)
    middle = scene.camera.pixel(edit.sun_azimuth, 0)[0]
    columns = int(middle) - 8, int(middle) + 8
    known = sw.render(dataclasses.replace(scene, atmosphere=hazy), edit)
    monkeypatch.setattr(frame_inputs, "own_glints", lambda *_: 0.0)
    unknown = sw.render(dataclasses.replace(scene, atmosphere=hazy), edit)
    assert column_light(known, *columns) > column_light(unknown, *columns) + 5


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
    no_land = np.ones((24, 32), bool)
    empty = np.zeros((6, 8), np.float32)
    empty[2, 4] = 0.9
    shown = dict.fromkeys(SunMaps._fields, empty) | {"clean": np.zeros((6, 8, 3), np.float32)}
    with np.errstate(all="raise"):
        found = water._with_glints(working, sky, ground, no_land, wet, SunMaps(**shown))
    assert np.isfinite(found).all()
    np.testing.assert_array_equal(found[12:, 4:28], 1)


def sky_and_sea(photo, color, azimuth, elevation, **hints):
    """Return the mean light above and below the horizon after a move; the sea is ``color``."""
    photo.linear[photo.sky == 0] = color
    scene = photo.analyze(water=1 - photo.sky, **hints)
    moved = sw.render(scene, sw.Edit(sun_azimuth=azimuth, sun_elevation=elevation))
    row = round(photo.camera.horizon_row())
    light = srgb_to_linear(moved / 255)
    return light[row - 8 : row - 3].mean((0, 1)), light[row + 5 : row + 20].mean((0, 1))


@pytest.mark.parametrize("elevation", [20, 35])
def test_red_water_of_an_evening_is_no_redder_than_the_sky_of_the_day(elevation):
    evening = known_photo(sun=(8.0, 2.0), tint=(1.8, 0.9, 0.5), clouds=False)
    sky, sea = sky_and_sea(evening, (0.3, 0.02, 0.03), -60, elevation)
    assert sea[0] / sea[1] < 1.3 * sky[0] / sky[1]
    assert sea[0] / sea[2] < 1.3 * sky[0] / sky[2]


def test_water_under_a_sky_bluer_than_any_air_is_not_green_in_the_evening():
    day = known_photo(sun=(150.0, 40.0), tint=(0.1, 1.3, 1.9), clouds=False)
    sky, sea = sky_and_sea(day, (0.03, 0.12, 0.2), -15, 4, sun=None)
    assert sea[1] / sea[0] < 1.1 * sky[1] / sky[0]


def test_blue_water_of_an_evening_stays_blue_by_day():
    evening = known_photo(sun=(8.0, 2.0), tint=(1.8, 0.9, 0.5), clouds=False)
    _, sea = sky_and_sea(evening, (0.002, 0.001, 0.12), -60, 35)
    assert sea[2] > 3 * sea[0]


def test_water_has_the_dusk_of_the_sky_that_it_mirrors():
    day = known_photo(sun=(8.0, 30.0), clouds=False)
    sea_color = (0.1, 0.16, 0.24)
    towards, away = (sky_and_sea(day, sea_color, azimuth, -4) for azimuth in (8, -172))
    # Orange near the horizon towards the sun, as the sky above it.
    assert np.log2(towards[0][0] / towards[0][2]) > 0.5
    assert np.log2(towards[1][0] / towards[1][2]) > np.log2(away[1][0] / away[1][2]) + 1
    assert np.log2(towards[1][0] / towards[1][2]) > -0.3
