"""A sun set into a photo that had none: hue is kept, little burns, land does not turn black."""

import functools
import itertools

import numpy as np
import pytest
from relight_scenes import known_photo

import sunwidget as sw
from sunwidget.edit.table import Edit
from sunwidget.formats.color import srgb_to_linear
from sunwidget.renderer import render, render_pass

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


@functools.cache
def scene_without_sun(clouds=False, tint=(0.4, 0.9, 1.6)):
    """A sky bluer than any air, as phones draw it, whose sun stands behind the camera."""
    photo = known_photo(sun=(150.0, 40.0), depth=0.05, tint=tint, clouds=clouds)
    return photo.analyze(sun=None)


def seen(scene, edit):
    """Display-linear light, and degrees from the new sun (small angles)."""
    camera = scene.camera
    rows, columns = np.mgrid[: camera.height, : camera.width] + 0.5
    x, y = camera.pixel(edit.sun_azimuth, edit.sun_elevation)
    away = np.degrees(np.hypot(columns - x, rows - y) / camera.focal)
    return srgb_to_linear(render(scene, edit) / 255), away


@pytest.mark.parametrize("elevation", [4, 12, 22])
def test_little_of_the_sky_burns_and_light_falls_without_a_plate(elevation):
    scene = scene_without_sun()
    light, away = seen(scene, Edit(sun_azimuth=-8, sun_elevation=elevation))
    sky = scene.sky == 1
    assert (light.min(-1) >= srgb_to_linear(250 / 255))[sky].mean() < 0.034
    level = [
        float(np.median((light @ LUMINANCE)[sky & (away >= a) & (away < a + 1.5)]))
        for a in (0, 1.5, 3, 5, 8, 12, 17)
    ]
    assert level[0] > 0.75
    assert all(near > far for near, far in itertools.pairwise(level))
    assert level[2] < 0.95
    assert 0.2 < level[4] < 0.75


@pytest.mark.parametrize("elevation", [4, 12, 22])
def test_the_halo_in_a_blue_sky_is_not_cyan(elevation):
    scene = scene_without_sun()
    light, away = seen(scene, Edit(sun_azimuth=-8, sun_elevation=elevation))
    red, green, blue = np.moveaxis(light[(scene.sky == 1) & (away < 15)], -1, 0)
    assert ((green - red) < 0.85 * (blue - red).clip(0.05)).all()


def test_a_deep_blue_sky_turns_warm_around_a_low_sun_without_a_dome():
    fade = np.linspace(0, 1, 140)[:, None, None]
    photo = np.full((200, 300, 3), 25, np.uint8)
    photo[:140] = np.round((1 - fade) * (0, 60, 160) + fade * (10, 110, 215))
    scene = sw.analyze(photo, sun="outside", horizon=140)
    light = srgb_to_linear(render(scene, Edit(sun_azimuth=0, sun_elevation=3)) / 255)
    red, _, blue = np.maximum(light[5:80:12, 140:160], 2e-3).mean(1).T
    steps = np.diff(np.log2(red / blue))  # towards the sun, in row 128
    assert 0 < steps.max() < 2 * steps.min()


def test_the_sky_away_from_the_sun_keeps_its_tone():
    scene = scene_without_sun()
    light, away = seen(scene, Edit(sun_azimuth=-14, sun_elevation=12))
    before = srgb_to_linear(scene.photo.encoded / 255) @ LUMINANCE
    far = (scene.sky == 1) & (away > 22)
    assert 0.4 < np.median((light @ LUMINANCE)[far] / before[far]) < 1.6


def test_exposure_is_smooth_along_a_drag():
    scene = scene_without_sun()
    stops = [
        np.log2(
            render_pass(scene, Edit(sun_azimuth=a, sun_elevation=10), "composite_constants")[
                0, 0, 0
            ]
        )
        for a in range(-60, 61, 2)
    ]
    assert min(stops) < -0.3  # a sun in view is exposed for
    assert np.abs(np.diff(stops)).max() < 0.2
    assert np.abs(np.diff(stops, 2)).max() < 0.1


def test_only_a_sun_in_the_picture_lowers_the_exposure():
    scene = scene_without_sun()
    inside, behind = (
        render_pass(scene, Edit(sun_azimuth=azimuth, sun_elevation=12), "visibility_edit")[0, 0, 2]
        for azimuth in (-8, 170)
    )
    assert inside > 0.9
    assert behind == 0


@pytest.mark.parametrize("elevation", [6, 12, 18, 24])
def test_land_against_the_sun_or_under_a_cloud_is_dark_but_not_black(elevation):
    scene = scene_without_sun(clouds=True)
    before = srgb_to_linear(scene.photo.encoded / 255) @ LUMINANCE
    land = scene.sky == 0
    for azimuth in (-17, -8, 10):
        light = seen(scene, Edit(sun_azimuth=azimuth, sun_elevation=elevation))[0] @ LUMINANCE
        assert light[land].mean() > 0.12 * before[land].mean(), azimuth


def test_a_small_move_keeps_bright_clouds_as_bright():
    scene = scene_without_sun(clouds=True)
    own = scene.automatic
    moved = Edit(sun_azimuth=own["sun_azimuth"] + 0.5, sun_elevation=own["sun_elevation"])
    after = render(scene, moved).astype(int)
    assert np.abs(after - scene.photo.encoded)[scene.sky == 1].max() <= 6


@pytest.mark.parametrize("elevation", [3, 12])
def test_a_violet_photo_stays_violet_around_the_new_sun(elevation):
    scene = scene_without_sun(tint=(0.6, 0.3, 1.4))
    light, away = seen(scene, Edit(sun_azimuth=-8, sun_elevation=elevation))
    near = (scene.sky == 1) & (away < 25) & (light.max(-1) < 0.9)
    own = srgb_to_linear(scene.photo.encoded / 255)[scene.sky == 1]
    greenest = [np.quantile(sky[:, 1] / sky[:, 0], 0.98) for sky in (light[near], own)]
    assert greenest[0] < greenest[1] < 1
