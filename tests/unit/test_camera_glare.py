"""The camera's own glare: measured in the photo, of the sun's colour, the same in the shader."""

import dataclasses

import numpy as np
import pytest
from relight_scenes import known_photo, known_scene

from sunwidget.analysis.camera_glare import (
    angle_to_sun,
    glare_profile,
    measured_glare,
    share_of_glare,
    sun_color,
    through_glare,
    with_glare,
)
from sunwidget.analysis.fit import Response, SkyFit
from sunwidget.analysis.working import LUMINANCE
from sunwidget.camera import Camera
from sunwidget.edit import Edit
from sunwidget.renderer import render_pass

ANGLE = np.linspace(0, 40, 12000).reshape(100, 120).astype(np.float32)


def exact_fit(photo, glare=(0.0, 3.0, 1.3)):
    return SkyFit(photo.atmosphere, photo.response, tuple(photo.gain), glare, photo.sun)


def drawn(fit, angle=ANGLE):
    """Luminance of the fit's glare round the photo's own sun."""
    camera = known_photo().camera
    clear = np.zeros((camera.height, camera.width, 3), np.float32)
    light = through_glare(clear, fit, camera) @ LUMINANCE
    at = angle_to_sun(camera, (camera.width, camera.height), fit.sun)
    order = np.argsort(at.ravel())
    return np.interp(angle, at.ravel()[order], light.ravel()[order])


@pytest.mark.parametrize("true", [(0.3, 2.0, 1.3), (0.2, 4.0, 1.3)])
@pytest.mark.parametrize("exposure", [0.7, 1.3])
def test_a_drawn_glare_is_measured_also_when_the_sky_is_off_by_a_gain(true, exposure):
    clear = 0.5 + 0.3 * np.cos(ANGLE / 30)
    fit = exact_fit(known_photo(), true)
    seen = exposure * clear + drawn(fit)
    found = with_glare(exact_fit(known_photo()), seen, clear, ANGLE, ANGLE > 0.5)
    x = np.linspace(1, 12, 50)
    assert np.abs(drawn(found, x) - drawn(fit, x)).max() < 0.25 * drawn(fit).max()


def test_clouds_over_half_of_each_ring_are_no_glare():
    clear = np.full_like(ANGLE, 0.5)
    random = np.random.default_rng(3)
    seen = np.where((random.random(ANGLE.shape) < 0.5) & (ANGLE < 20), 3.0, clear)
    found = with_glare(exact_fit(known_photo()), seen, clear, ANGLE, ANGLE > 0)
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


def test_glare_is_added_in_the_colour_of_the_sun():
    photo = known_photo(clouds=False)
    fit = exact_fit(photo, (2.0, 3.0, 1.3))
    clear = np.broadcast_to(np.array([0.05, 0.2, 0.6], np.float32), (80, 120, 3))
    veil = through_glare(clear, fit, photo.camera) - clear
    color = veil / (veil @ LUMINANCE)[..., None]
    assert np.allclose(color, sun_color(fit), rtol=0.01)
    assert sun_color(fit)[0] > sun_color(fit)[2]  # whiter than the sky, redder than white
    x, y = (int(v) for v in photo.camera.pixel(*photo.sun))
    share = share_of_glare(clear, through_glare(clear, fit, photo.camera))
    assert share[y, x] > 0.9
    assert share.min() < 0.2


def test_kernel_and_shader_draw_the_same_glare():
    scene = known_scene()
    fit = dataclasses.replace(scene.fitted, glare=(1.5, 4.0, 1.3))
    light = render_pass(scene, Edit(), "terms")[0, 13, :3]
    visible = render_pass(scene, Edit(), "visibility_edit")[0, 0, 1]
    expected = visible * drawn(fit, 0.0) / 1.5 * sun_color(fit)
    assert np.allclose(light, expected, rtol=0.03)
