"""The moon as the light: night and no dim day, and the same guarantees as with the sun."""

import dataclasses

import numpy as np
import pytest
from relight_scenes import known_photo, known_scene, sample_scene

import sunwidget as sw
from sunwidget.edit.table import METHODS, Edit
from sunwidget.renderer import render, render_pass

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
MOON = Edit(light_source="moon")


def lit_by_moon(scene):
    """The scene as if its own light were a moon, at the place of its sun."""
    own = scene.automatic["sun_azimuth"], scene.automatic["sun_elevation"]
    return dataclasses.replace(scene, sun=None, moon=(0.5, 0.5), assumed_sun=own)


@pytest.mark.parametrize("light", ["automatic", "sun"])
def test_the_photos_own_light_changes_nothing(light):
    scene = known_scene()
    assert np.array_equal(render(scene, Edit(light_source=light)), scene.photo.encoded)
    night = lit_by_moon(scene)
    name = light.replace("sun", "moon")
    assert np.array_equal(render(night, Edit(light_source=name)), scene.photo.encoded)


def test_a_moon_in_the_suns_place_is_another_light():
    scene = known_scene()
    day, night = render(scene, dtype="float32"), render(scene, MOON, dtype="float32")
    assert (night @ LUMINANCE).mean() < 0.25 * (day @ LUMINANCE).mean()
    land = scene.sky < 0.02
    blue_over_red = [picture[land, 2].mean() / picture[land, 0].mean() for picture in (day, night)]
    assert blue_over_red[0] < 1 < blue_over_red[1] - 0.2


def test_the_moon_is_a_four_hundred_thousandth_of_the_sun():
    scene = known_scene()
    sun, moon = (
        render_pass(
            scene,
            Edit(sun_elevation=40, light_source=light, auto_exposure=0),
            "composite_constants",
        )[0]
        for light in ("sun", "moon")
    )
    ratio = moon[12, :3] / sun[12, :3]  # of the direct light on water
    # Krisciunas & Schaefer 1991: 14 magnitudes, and B-V larger by 0.27.
    assert -2.5 * np.log10(ratio[1]) == pytest.approx(14.01, abs=0.01)
    assert -2.5 * np.log10(ratio[2] / ratio[1]) == pytest.approx(0.24, abs=0.05)


@pytest.mark.parametrize("name", ["coast", "meadow"])
def test_moonlight_reads_as_a_night_and_not_as_a_dim_day(name):
    scene = sample_scene(name)
    night = render(scene, MOON.replace(sun_elevation=25), dtype="float32")
    level = float(np.median(night @ LUMINANCE))
    assert 0.003 < level < 0.06  # encoded 0.04 to 0.27: dark, and no black hole
    red, _, blue = np.median(night[scene.sky < 0.02], axis=0)
    assert blue > red


def test_a_moon_that_sets_leaves_a_faint_floor():
    scene = known_scene()
    levels = [
        render(scene, MOON.replace(sun_elevation=e, auto_exposure=0), dtype="float32")
        for e in (40, 5, 0, -6, -12)
    ]
    assert all(np.isfinite(picture).all() for picture in levels)
    sky = [
        render_pass(scene, MOON.replace(sun_elevation=e), "mirror_edit")[..., :3].mean()
        for e in (40, 0, -6, -9, -12)
    ]
    assert sky == sorted(sky, reverse=True)
    assert sky[-1] > 0.8 * sky[-2] > 0
    set_ = render(scene, MOON.replace(sun_elevation=-12), dtype="float32")
    assert 0.001 < np.median(set_ @ LUMINANCE) < 0.03


def test_there_and_back_and_by_any_way():
    scene = sample_scene("coast")
    before = render(scene)
    end = MOON.replace(sun_azimuth=-10, sun_elevation=20)
    direct = render(scene, end)
    for edit in (MOON, Edit(sun_elevation=-5), MOON.replace(sun_elevation=-5), Edit()):
        render(scene, edit)
    assert np.array_equal(render(scene, end), direct)
    assert np.array_equal(render(scene), before)


def test_strengths_at_zero_keep_the_photo_by_moonlight_too():
    scene = known_scene()
    off = MOON.replace(sky_strength=0, land_strength=0, sun_elevation=30)
    assert np.array_equal(render(scene, off), scene.photo.encoded)


@pytest.mark.parametrize("method", METHODS[1:])
def test_the_thesis_methods_know_no_moon(method):
    scene = known_scene()
    sun = render(scene, Edit(sun_elevation=8, light_source="sun"), method=method)
    assert np.array_equal(render(scene, MOON.replace(sun_elevation=8), method=method), sun)


def test_the_disc_is_a_flat_moon_with_maria_and_no_burnt_hole():
    scene = known_photo(clouds=False).analyze()
    camera = scene.camera
    sun = camera.angles(0.3 * camera.width, 0.3 * camera.height)
    edit = MOON.replace(sun_azimuth=sun[0], sun_elevation=sun[1], sun_size=5)
    size = (480, 320)
    disc, plain = (
        render(scene, e, dtype="float32", size=size) @ LUMINANCE
        for e in (edit, edit.replace(sun_size=0))
    )
    inside = disc > plain + 0.3
    rows, columns = np.nonzero(inside)
    radius = np.sqrt(inside.sum() / np.pi)
    assert radius > 5
    away = np.hypot(columns - columns.mean(), rows - rows.mean()) / radius
    light = disc[inside]
    assert light.max() < 1.05
    assert np.ptp(light[away < 0.7]) > 0.08  # maria
    assert light[(away > 0.75) & (away < 0.9)].mean() > 0.9 * light[away < 0.5].mean()


def test_a_night_photos_own_moon_moves_like_a_sun():
    scene = lit_by_moon(known_scene())
    moved = Edit(sun_azimuth=-12, sun_elevation=20)
    asked = render(scene, moved.replace(light_source="moon"))
    assert np.array_equal(render(scene, moved), asked)
    # Moving one light is a ratio of one model: it does not ask which light it is.
    by_sun = render(known_scene(), moved)
    assert np.quantile(np.abs(by_sun.astype(int) - asked), 0.99) <= 3  # the rest is the disc
    day = render(scene, moved.replace(light_source="sun"), dtype="float32")
    assert day.mean() > asked.mean() / 255 * 0.5


def test_a_found_moon_is_where_the_light_comes_from():
    known = known_photo(sun=(-6.0, 12.0), clouds=False, level=0.02, noise=0.0, tint=(0.4, 0.7, 1.4))
    picture = np.round(known.code * 255).astype(np.uint8)
    scene = sw.analyze(picture, sky=known.sky, fov=known.camera.fov_vertical_deg,
                       horizon=known.camera.horizon_row())  # fmt: skip
    if scene.moon is None:
        pytest.fail(f"the disc was not taken for a moon: {scene.warnings}")
    assert scene.sun is None
    assert scene.lit_by_moon
    assert scene.automatic["sun_azimuth"] == pytest.approx(-6.0, abs=0.6)
    assert scene.automatic["sun_elevation"] == pytest.approx(12.0, abs=0.6)
    assert np.array_equal(render(scene), scene.photo.encoded)


def test_dusk_and_night_are_printed_darker_and_days_are_not():
    scene = known_scene()

    def stops(elevation, light="sun"):
        """EV by which the exposure stays behind the meter's."""
        edit = Edit(sun_elevation=elevation, light_source=light, auto_exposure=1)
        gain = render_pass(scene, edit, "composite_constants")[0, 0, 0]
        fall = (
            render_pass(scene, edit, "meter_source")[0, 0, 0]
            - render_pass(scene, edit, "meter_edit")[0, 0, 0]
        )
        return fall - np.log2(gain)

    # By day it is the bright sky round the sun that the camera spares, here and in the photo.
    assert abs(stops(40)) < 0.4
    assert abs(stops(2)) < 0.1
    dusk = [stops(e) for e in (-2, -4, -6, -8, -11)]
    assert dusk == sorted(dusk)
    night = stops(30, "moon")
    assert 0.8 < night < 1.61
    # Without a moon it is half a stop darker.
    assert night + 0.3 < dusk[-2] < dusk[-1] < night + 0.8
