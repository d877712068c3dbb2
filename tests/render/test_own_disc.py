"""A moved sun is as large as the photo's own: what burns to white is the camera's doing."""

import cv2
import numpy as np
import pytest

import sunwidget as sw
from sunwidget.analysis import frame_inputs
from sunwidget.analysis.sun.camera_glare import own_disc
from sunwidget.formats.color import LUMINANCE
from sunwidget.renderer import render_pass

HEIGHT, WIDTH, X, Y = 240, 360, 120, 110


def evening(radius, color=(1.0, 1.0, 1.0), dim=1.0):
    """A clear evening sky over dark land, with a round sun of ``radius`` pixels."""
    y, x = np.mgrid[:HEIGHT, :WIDTH] + 0.5
    up = np.clip(1 - y / 180, 0, 1)[..., None]
    sky = dim * (np.array([0.85, 0.5, 0.3]) * (1 - up) + np.array([0.35, 0.4, 0.55]) * up)
    photo = np.where(y[..., None] < 180, sky, 0.06)
    inside = np.clip(radius + 0.5 - np.hypot(x - X, y - Y), 0, 1)[..., None]
    return np.rint(255 * (photo + inside * (np.array(color) - photo))).astype(np.uint8)


def scene_of(photo):
    return sw.analyze(photo, sun=(X, Y), horizon=180)


def radius_at(picture, before, azimuth_px):
    """Radius of what has become much brighter than the photo beside the old sun's place."""
    new = (picture / 255 @ LUMINANCE) - (before / 255 @ LUMINANCE) > 0.25
    new[:, :azimuth_px] = False
    return float(np.sqrt(new[:170].sum() / np.pi))


@pytest.mark.parametrize("radius", [6, 11])
def test_a_moved_sun_is_as_large_as_the_photos_own(radius):
    photo = evening(radius)
    scene = scene_of(photo)
    moved = sw.render(scene, sw.Edit(sun_azimuth=scene.sun.azimuth + 20, glow=0))
    assert radius_at(moved, photo, 190) == pytest.approx(radius, rel=0.3)


def test_the_slider_of_its_size_still_scales_it():
    photo = evening(8)
    scene = scene_of(photo)
    edit = sw.Edit(sun_azimuth=scene.sun.azimuth + 20, glow=0)
    once, twice, none = (
        radius_at(sw.render(scene, edit.replace(sun_size=size)), photo, 190) for size in (1, 2, 0)
    )
    assert twice == pytest.approx(2 * once, rel=0.25)
    assert none < 1


def test_a_red_disc_that_did_not_burn_stays_red():
    photo = evening(10, color=(0.95, 0.3, 0.2), dim=0.35)
    scene = scene_of(photo)
    uniforms = frame_inputs.uniforms(scene)
    assert uniforms["own_disc_burnt"] == 0
    edit = sw.Edit(sun_azimuth=scene.sun.azimuth + 20, glow=0)
    x, y = scene.camera.pixel(edit.sun_azimuth, scene.sun.elevation)[:2]
    red, green, blue = sw.render(scene, edit)[int(y), int(x)].astype(int)
    assert red > green + 60 > blue


@pytest.mark.parametrize("elevation", [1.5, 8])
def test_a_white_disc_in_a_red_sky_turns_neither_violet_nor_blue(elevation):
    y, x = np.mgrid[:HEIGHT, :WIDTH] + 0.5
    sky = np.where(y[..., None] < 180, evening(0) * (1.1, 0.3, 0.05), evening(0)).clip(0, 255)
    inside = np.clip(10.5 - np.hypot(x - X, y - 165), 0, 1)[..., None]
    photo = np.rint(sky + inside * (255 - sky)).astype(np.uint8)
    scene = sw.analyze(photo, sun=(X, 165), horizon=180)
    edit = sw.Edit(sun_azimuth=8, sun_elevation=elevation)
    disc = render_pass(scene, edit, "composite_constants")[0, 14]
    assert disc[0] >= disc[1] >= disc[2]


@pytest.mark.parametrize(("color", "stays"), [((1.0, 0.98, 0.9), True), ((0.8, 0.7, 0.5), False)])
def test_a_clipped_disc_stays_white_as_it_sinks_and_another_reddens(color, stays):
    scene = scene_of(evening(10, color=color, dim=0.6))
    own = np.array(frame_inputs.uniforms(scene)["own_disc"])
    low = sw.Edit(sun_azimuth=scene.sun.azimuth + 20, sun_elevation=scene.sun.elevation - 8)
    disc = render_pass(scene, low, "composite_constants")[0, 14, :3]
    own = scene.fitted.response.scene_light(own)
    assert (disc[1] > 0.8 * own[1]) == stays
    assert disc[2] < 0.9 * own[2]


def test_a_blot_that_grew_into_the_sky_is_no_disc():
    scene = scene_of(evening(10, color=(0.95, 0.3, 0.2)))  # as bright as the sky beside it
    assert scene.sun.radius_px > 60
    assert frame_inputs.uniforms(scene)["own_disc_radius"] == 0


def test_a_white_disc_in_a_glow_as_bright_is_seen_in_blue():
    photo = evening(8, color=(1.0, 0.98, 0.9))
    y, x = np.mgrid[:HEIGHT, :WIDTH] + 0.5
    glow = np.exp(-(((np.hypot(x - X, y - Y)) / 160) ** 2))[..., None] * (y[..., None] < 180)
    photo = np.maximum(photo, np.rint(255 * glow * (1.0, 0.97, 0.2)).astype(np.uint8))
    found = frame_inputs.uniforms(scene_of(photo))
    assert found["own_disc_radius"] > 0
    assert found["own_disc"][2] > 0.5


def test_another_light_has_its_own_disc():
    photo = evening(11)
    scene = scene_of(photo)
    edit = sw.Edit(sun_azimuth=scene.sun.azimuth + 20, glow=0, light_source="moon")
    assert radius_at(sw.render(scene, edit), photo, 190) < 6


def test_a_soft_glow_stays_soft_and_a_sharp_disc_sharp():
    sharp = evening(8)
    soft = cv2.GaussianBlur(evening(11), (0, 0), 6)
    sharp_rim, soft_rim = (
        frame_inputs.uniforms(scene_of(p))["own_disc_rim"] for p in (sharp, soft)
    )
    # In radii of the sun mask, here a quarter less than the true one.
    assert sharp_rim < 1.4
    assert soft_rim > sharp_rim + 0.2


def test_a_photo_that_shows_no_sun_tells_nothing():
    scene = sw.analyze(sw.sample("meadow").preview(200), sun="outside")
    found = own_disc(None, scene.camera, scene.working)
    assert found["own_disc"] == (0, 0, 0)
    assert found["own_disc_radius"] == found["own_disc_burnt"] == 0
    assert frame_inputs.uniforms(scene)["own_disc_radius"] == 0
