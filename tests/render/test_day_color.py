"""Skies around a sun by day, as photos show them (sky/day_color, camera/bright_air)."""

import dataclasses

import numpy as np
import pytest
from relight_scenes import known_photo

from sunwidget.analysis.sun.camera_glare import angle_to_sun
from sunwidget.edit.table import Edit
from sunwidget.formats.color import LUMINANCE
from sunwidget.renderer import render

SIZE = (240, 160)
AZIMUTH = -15.0
BLUE, GRAY, VIOLET = (0.6, 1.0, 1.9), (1.3, 1.0, 0.7), (0.9, 0.7, 1.9)  # tints of the photo


def photo_of(tint):
    return known_photo(sun=(150.0, 40.0), size=SIZE, clouds=False, tint=tint)


@pytest.fixture(scope="module")
def day():
    return photo_of(BLUE).analyze(sun="outside")


def sky_of(scene, sun, edit):
    """Log2 of red and blue over green, and luminance, of an edit's sky; degrees from ``sun``."""
    light = np.maximum(render(scene, edit, dtype="float32"), 1e-5)
    sky = scene.sky > 0.99
    red, green, blue = np.log2(light[sky]).T
    colors = np.stack([red - green, blue - green, np.log2(light[sky] @ LUMINANCE)])
    return colors, angle_to_sun(scene.camera, SIZE, sun)[sky]


def seen(scene, elevation):
    sun = AZIMUTH, elevation
    return sky_of(scene, sun, Edit(sun_azimuth=AZIMUTH, sun_elevation=elevation))


def unmoved(scene):
    return sky_of(scene, (AZIMUTH, 12), Edit())


def between(colors, away, near, far):
    return np.median(colors[:, (away >= near) & (away < far)], axis=1)


def test_a_blue_sky_turns_white_beside_a_sun_by_day_and_is_blue_again_at_twice_that_distance(day):
    own, away = unmoved(day)
    colors, away = seen(day, 12)
    own_red, own_blue, _ = between(own, away, 18, 30)
    red, blue, _ = between(colors, away, 18, 30)
    assert blue > 0.65 * own_blue
    assert red < 0.6 * own_red
    red, blue, _ = between(colors, away, 3, 5)
    assert blue < 0.55 * own_blue
    assert red > 0.55 * own_red


def test_a_blue_sky_is_hardly_darker_far_from_a_sun_in_view(day):
    own, _ = unmoved(day)
    colors, away = seen(day, 12)
    fall = between(colors, away, 30, 60)[2] - between(own, away, 30, 60)[2]
    assert -1.0 < fall < 0.3


def test_a_gray_sky_and_one_of_a_low_sun_are_warm_beside_the_sun(day):
    gray = photo_of(GRAY).analyze(sun="outside")
    own, _ = unmoved(gray)
    colors, away = seen(gray, 12)
    assert between(colors, away, 9, 18)[0] > between(own, away, 9, 18)[0] + 0.03
    colors, away = seen(day, 3)
    red, blue, _ = between(colors, away, 5, 12)
    assert red > 0.1
    assert blue < -0.2


def test_a_violet_sky_keeps_its_red_under_a_sun_by_day():
    violet = photo_of(VIOLET).analyze(sun="outside")
    own, _ = unmoved(violet)
    colors, away = seen(violet, 12)
    red, blue, _ = between(colors, away, 18, 30)
    assert red > between(own, away, 18, 30)[0] - 0.1
    assert blue > 0.5 * between(own, away, 18, 30)[1]


def test_a_pale_sky_is_not_tan_far_from_a_sun_by_day():
    photo = photo_of((1.0, 1.0, 1.0))
    linear = photo.linear.copy()
    sky = photo.sky > 0.99
    gray = (linear[sky] @ LUMINANCE)[:, None]
    linear[sky] = 0.25 * (gray + linear[sky])
    pale = dataclasses.replace(photo, linear=linear).analyze(sun="outside")
    own, _ = unmoved(pale)
    # Haze counts as cloud; at half strength it also takes half of the clear sky's color.
    edit = Edit(sun_azimuth=AZIMUTH, sun_elevation=12, cloud_strength=1)
    colors, away = sky_of(pale, (AZIMUTH, 12), edit)
    own_red, own_blue, _ = between(own, away, 18, 30)
    red, blue, _ = between(colors, away, 18, 30)
    assert blue > 0.75 * own_blue
    assert red < 0.7 * own_red
    assert between(colors, away, 9, 18)[1] > 0.35 * own_blue
    red, blue, _ = between(colors, away, 2, 4)  # it stays warm beside the sun
    assert red > 0.1
    assert blue < -0.1


def test_an_evenings_violet_leaves_by_day():
    sun = 25.0, 3.0
    photo = known_photo(sun=sun, size=SIZE, clouds=False, tint=(1.6, 0.9, 1.9))
    scene = photo.analyze()
    own, away = unmoved(scene)
    colors, away = seen(scene, 12)
    assert between(colors, away, 9, 18)[1] < 0.3 * between(own, away, 9, 18)[1]


def test_a_day_after_an_evening_is_not_violet():
    scene = known_photo(sun=(25.0, 3.0), size=SIZE, clouds=False, tint=(0.6, 1.0, 3.0)).analyze()
    (red, blue, _), _ = seen(scene, 35)
    assert np.median(blue) > 0.35
    assert np.quantile(blue + red, 0.9) < 0.05  # what is bluer has less red


def test_the_color_follows_the_suns_height_without_a_step(day):
    course = []
    for height in np.arange(4, 15, 0.5):
        colors, away = seen(day, height)
        course.append(between(colors, away, 18, 30))
    assert np.abs(np.diff(course, axis=0)).max() < 0.3


def test_light_around_a_new_sun_falls_without_an_arc(day):
    edit = Edit(sun_azimuth=AZIMUTH, sun_elevation=12, starburst=0)  # a ray ends, too
    frame = render(day, edit, dtype="float32")
    x, y = (int(each) for each in day.camera.pixel(AZIMUTH, 12))
    row = np.log2(frame[y - 1 : y + 2, x:].mean(0) @ LUMINANCE)
    level = row[: len(row) // 6 * 6].reshape(-1, 6).mean(1)
    bends = np.abs(np.diff(level, n=2))[4:]  # beyond the sun's own glow
    assert bends.max() < 0.07


def test_whites_keep_the_hue_that_they_show():
    """JPEG gives almost white pixels odd hues, which the inverse response would magnify."""
    photo = photo_of((1.0, 1.0, 1.0))
    linear = photo.linear.copy()
    linear[10:40, 20:100] = np.array([0.93, 0.96, 1.0])
    linear[10:40, 140:220] = 0.96
    scene = dataclasses.replace(photo, linear=linear).analyze(sun="outside")
    steep = {"response_shoulder": 0.99, "response_contrast": 0.7}
    scene = dataclasses.replace(scene, response=scene.response | steep)
    edit = Edit(sun_azimuth=60, sun_elevation=40, exposure=-4, cloud_strength=1)
    frame = render(scene, edit, dtype="float32")
    odd, plain = frame[15:35, 30:90].mean((0, 1)), frame[15:35, 150:210].mean((0, 1))
    bluer = np.log2(odd[2] / odd[0]) - np.log2(plain[2] / plain[0])
    assert bluer < 0.5


def test_the_users_exposure_is_not_taken_for_a_dark_sky(day):
    edit = Edit(sun_azimuth=AZIMUTH, sun_elevation=12)
    sun = AZIMUTH, 12
    plain, away = sky_of(day, sun, edit)
    darker, _ = sky_of(day, sun, edit.replace(exposure=-1))
    change = between(darker, away, 25, 50)[2] - between(plain, away, 25, 50)[2]
    assert abs(change + 1) < 0.1


@pytest.mark.parametrize("sun", [(8.0, 40.0), (20.0, 18.0)])
def test_an_azure_sky_is_not_lilac_as_the_sun_moves(sun):
    photo = known_photo(sun=sun, tint=(0.5, 1.2, 3.0), clouds=False, size=SIZE)
    scene = photo.analyze()
    before, after = (
        np.median(render(scene, edit, dtype="float32")[photo.sky > 0], 0)
        for edit in (Edit(), Edit(sun_azimuth=80))
    )
    assert after[2] > 0.5  # where blue rolls off
    assert np.log2(after[0] / after[1]) < np.log2(before[0] / before[1]) - 0.2
