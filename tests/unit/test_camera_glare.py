"""The camera's own glare: measured in the photo, of the sun's colour, the same in the shader."""

import dataclasses

import numpy as np
import pytest
from relight_scenes import known_photo, known_scene

from sunwidget.analysis.camera_glare import (
    angle_to_sun,
    share_of_glare,
    sun_color,
    through_glare,
    with_glare,
)
from sunwidget.analysis.fit import SkyFit
from sunwidget.analysis.working import LUMINANCE
from sunwidget.edit import Edit
from sunwidget.renderer import render_pass

ANGLE = np.linspace(0, 40, 12000).reshape(100, 120).astype(np.float32)


def exact_fit(photo, glare=(0.0, 3.0, 2.0)):
    return SkyFit(photo.atmosphere, photo.response, tuple(photo.gain), glare, photo.sun)


def profile(glare, angle):
    return glare[0] * (1 + (angle / glare[1]) ** 2) ** -glare[2]


@pytest.mark.parametrize("true", [(3.0, 2.0, 1.5), (1.0, 4.0, 1.0)])
@pytest.mark.parametrize("exposure", [0.7, 1.3])
def test_a_drawn_glare_is_measured_also_when_the_sky_is_off_by_a_gain(true, exposure):
    clear = 0.5 + 0.3 * np.cos(ANGLE / 30)
    found = with_glare(
        exact_fit(known_photo()), exposure * clear + profile(true, ANGLE), clear, ANGLE, ANGLE > 0.5
    )
    x = np.linspace(1, 12, 50)
    assert np.abs(profile(found.glare, x) - profile(true, x)).max() < 0.25 * true[0]


def test_clouds_over_half_of_each_ring_are_no_glare():
    clear = np.full_like(ANGLE, 0.5)
    random = np.random.default_rng(3)
    seen = np.where((random.random(ANGLE.shape) < 0.5) & (ANGLE < 20), 3.0, clear)
    found = with_glare(exact_fit(known_photo()), seen, clear, ANGLE, ANGLE > 0).glare
    assert profile(found, 2.0) < 0.02


def test_an_even_sky_has_no_glare():
    clear = np.full_like(ANGLE, 0.5)
    fit = exact_fit(known_photo())
    assert with_glare(fit, 0.7 * clear, clear, ANGLE, ANGLE > 0).glare[0] == 0


def test_glare_is_added_in_the_colour_of_the_sun():
    photo = known_photo(clouds=False)
    fit = exact_fit(photo, (2.0, 3.0, 2.0))
    clear = np.broadcast_to(np.array([0.05, 0.2, 0.6], np.float32), (80, 120, 3))
    veil = through_glare(clear, fit, photo.camera) - clear
    color = veil / (veil @ LUMINANCE)[..., None]
    assert np.allclose(color, sun_color(fit), rtol=0.01)
    assert sun_color(fit)[0] > sun_color(fit)[2]  # whiter than the sky, redder than white
    x, y = (int(v) for v in photo.camera.pixel(*photo.sun))
    assert veil[y, x] @ LUMINANCE == pytest.approx(2, rel=0.05)
    share = share_of_glare(clear, through_glare(clear, fit, photo.camera))
    assert share[y, x] > 0.9
    assert share.min() < 0.1


def test_kernel_and_shader_draw_the_same_glare():
    known = known_scene()
    scene = dataclasses.replace(known, response=known.response | {"glare_profile": (1.5, 4.0, 1.5)})
    fit = dataclasses.replace(known.fitted, glare=(1.5, 4.0, 1.5))
    drawn = render_pass(scene, Edit(), "sky_source")
    visible = render_pass(scene, Edit(), "visibility_source")[0, 0, 0]
    angle = angle_to_sun(scene.camera, (scene.width, scene.height), fit.sun)
    assert np.abs(drawn[..., 3] / visible / profile(fit.glare, angle) - 1).max() < 0.02
    without = dataclasses.replace(
        known, response=known.response | {"glare_profile": (0.0, 4.0, 1.5)}
    )
    veil = drawn[..., :3] - render_pass(without, Edit(), "sky_source")[..., :3]
    expected = visible * profile(fit.glare, angle)[..., None] * sun_color(fit)
    near = angle < 15
    assert np.abs(veil / expected - 1)[near].max() < 0.03
