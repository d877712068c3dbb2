"""The camera's own glare: measured in the photo, of the sun's colour, the same in the shader."""

import dataclasses

import numpy as np
import pytest
from relight_scenes import known_photo, known_scene

from sunwidget.analysis.fit.fit import Response, SkyFit
from sunwidget.analysis.sun.camera_glare import (
    angle_to_sun,
    beam,
    glare_profile,
    measured_glare,
    strength,
)
from sunwidget.edit.table import Edit
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera
from sunwidget.renderer import render, render_pass

ANGLE = np.linspace(0, 40, 12000).reshape(100, 120).astype(np.float32)


def exact_fit(photo, glare=(0.0, 3.0, 1.3)):
    return SkyFit(photo.atmosphere, photo.response, tuple(photo.gain), glare, photo.sun)


def drawn(fit, angle=ANGLE):
    """Luminance of the fit's glare round the photo's own sun."""
    height, width, power = fit.glare
    return strength(fit) * height * (1 + (angle / width) ** 2) ** -power


def measured(fit, seen, clean, trusted):
    """The fit with the glare that ``seen`` has over ``clean``, luminances."""
    excess = np.asarray(seen - clean, np.float32)[..., None] * np.ones(3, np.float32)
    return dataclasses.replace(fit, glare=measured_glare(excess, ANGLE, trusted, fit))


@pytest.mark.parametrize("true", [(0.3, 2.0, 1.3), (0.2, 4.0, 1.3)])
def test_a_drawn_glare_is_measured(true):
    clean = 0.5 + 0.3 * np.cos(ANGLE / 30)
    fit = exact_fit(known_photo(), true)
    found = measured(exact_fit(known_photo()), clean + drawn(fit), clean, ANGLE > 0.5)
    x = np.linspace(1, 12, 50)
    assert np.abs(drawn(found, x) - drawn(fit, x)).max() < 0.25 * drawn(fit).max()


def test_clouds_over_half_of_each_ring_are_no_glare():
    clear = np.full_like(ANGLE, 0.5)
    random = np.random.default_rng(3)
    seen = np.where((random.random(ANGLE.shape) < 0.5) & (ANGLE < 20), 3.0, clear)
    found = measured(exact_fit(known_photo()), seen, clear, ANGLE > 0)
    assert drawn(found, 2.0) < 0.02


def test_a_sun_without_glare_leaves_little_and_one_that_is_not_seen_says_nothing():
    fit = exact_fit(known_photo())
    camera = known_photo().camera
    none = measured_glare(np.zeros((*ANGLE.shape, 3), np.float32), ANGLE, ANGLE > 0, fit)
    unseen = measured_glare(np.zeros((*ANGLE.shape, 3), np.float32), ANGLE, ANGLE < 0, fit)
    assert unseen[0] == 0
    usual = glare_profile(dataclasses.replace(fit, glare=unseen), camera)
    weak = glare_profile(dataclasses.replace(fit, glare=none), camera)
    far = [a * (1 + (15 / b) ** 2) ** -c for a, b, c in (weak, usual)]
    assert 0.05 * far[1] < far[0] < 0.5 * far[1]


def test_glare_is_as_wide_as_the_picture_and_no_narrower_than_the_disc():
    fit = exact_fit(known_photo())
    wide, narrow, tele = (glare_profile(fit, Camera(600, 400, fov))[1] for fov in (60.0, 30.0, 3.0))
    assert wide > 1.8 * narrow
    assert tele > 0.2665


def test_glare_is_as_bright_as_the_response_draws_white():
    fit = exact_fit(known_photo())
    camera = known_photo().camera
    flat, bent = (
        glare_profile(dataclasses.replace(fit, response=Response(w, 1.0)), camera)[0]
        for w in (0.2, 0.99)
    )
    assert bent > 1.1 * flat


def sun_color(fit):
    """The colour of the glare as frame/composite_constants.glsl has it, of luminance 1."""
    gain = np.array(fit.gain)
    color = np.sqrt(beam(fit) * (gain if gain[0] > gain[2] else 1.0))
    return color / (color @ LUMINANCE)


def test_kernel_and_shader_draw_the_same_glare():
    scene = known_scene()
    fit = dataclasses.replace(scene.fitted, glare=(1.5, 4.0, 1.3))
    light = render_pass(scene, Edit(), "composite_constants")[0, 13, :3]
    visible = render_pass(scene, Edit(), "visibility_edit")[0, 0, 1]
    expected = visible * drawn(fit, 0.0) / 1.5 * sun_color(fit)
    assert np.allclose(light, expected, rtol=0.03)


def test_the_glare_of_a_photos_own_sun_is_held_as_it_sinks():
    def fading(scene):
        heights = scene.fitted.sun[1], 2.0
        edits = [Edit(sun_azimuth=scene.fitted.sun[0], sun_elevation=h) for h in heights]
        seen = [
            (
                render_pass(scene, edit, "composite_constants")[0, 13, :3]
                @ LUMINANCE
                / render_pass(scene, edit, "visibility_edit")[0, 0, 1]
            )
            for edit in edits
        ]
        return seen[1] / seen[0]

    scene = known_scene()
    assert fading(scene) > 1.3 * fading(dataclasses.replace(scene, sun=None))


def uneven(scene, edit, low, high):
    """Range of the light (log2) in the ring from ``low`` to ``high`` degrees from the sun."""
    light = render(scene, edit, dtype="float32") @ LUMINANCE
    sun = edit.sun_azimuth, edit.sun_elevation
    away = angle_to_sun(scene.camera, light.shape[::-1], sun)
    ring = (scene.sky > 0.99) & (away > low) & (away < high)
    return np.ptp(np.percentile(np.log2(light[ring]), [5, 95]))


def test_a_new_sun_in_a_blue_sky_has_rays_which_fade_with_distance():
    photo = known_photo(sun=(150.0, 40.0), clouds=False, tint=(0.6, 1.0, 1.9))
    scene = photo.analyze(sun="outside")
    with_rays = Edit(sun_azimuth=-10, sun_elevation=14)
    without = with_rays.replace(starburst=0)
    near, far = [
        uneven(scene, with_rays, *ring) - uneven(scene, without, *ring)
        for ring in ((5, 5.5), (24, 24.5))
    ]
    assert near > 0.15
    assert abs(far) < 0.05


@pytest.mark.parametrize("why", ["gray", "evening", "hidden", "own"])
def test_a_sun_in_haze_at_evening_behind_cloud_or_in_the_photo_has_no_rays(why):
    tint = (1.3, 1.0, 0.7) if why == "gray" else (0.6, 1.0, 1.9)
    photo = known_photo(sun=(8.0, 20.0), clouds=False, tint=tint)
    scene = photo.analyze() if why == "own" else photo.analyze(sun="outside")
    edit = Edit(sun_azimuth=-10, sun_elevation=3 if why == "evening" else 14)
    if why == "hidden":
        edit = edit.replace(sun_visibility=0)
    assert np.array_equal(render(scene, edit), render(scene, edit.replace(starburst=0)))


def passing(why):
    """A row of the share of glare that passes a sky with a dark band in its middle, (w,)."""
    tint = (0.6, 1.0, 1.9) if why == "blue" else (1.1, 1.0, 0.9)
    photo = known_photo(sun=(8.0, 20.0), clouds=False, tint=tint)
    picture = photo.bytes.copy()
    picture[:50, 56:64] = (0.6 * picture[:50, 56:64]).astype(np.uint8)
    scene = photo.analyze(picture) if why == "own" else photo.analyze(picture, sun="outside")
    edit = Edit(sun_azimuth=-3, sun_elevation=3 if why == "evening" else 14)
    return render_pass(scene, edit, "veil")[3, :, 3]


def test_dark_gray_cloud_holds_back_the_glare_of_a_new_sun():
    row = passing("gray")
    middle = len(row) // 2
    assert row[middle] < 0.5
    assert 1.02 < row.max() < 2
    assert np.allclose(row[[5, -6]], 1, atol=0.15)


@pytest.mark.parametrize("why", ["blue", "evening", "own"])
def test_neither_blue_sky_nor_a_low_sun_nor_the_photos_own_is_held_back(why):
    assert np.array_equal(passing(why), np.ones(30))
