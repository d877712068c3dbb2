"""Clouds by un-mixing: known veils come back, a clear sky has none, more veil gives more."""

import numpy as np
import pytest
from relight_scenes import exact_fit, known_photo, known_scene

import sunwidget as sw
from sunwidget.analysis.clouds.unmix import cloud_white, unmix

CLEAR = np.array([0.25, 0.42, 0.8], np.float32)
WHITE = np.array([1.6, 1.65, 1.7], np.float32)


def veiled(alpha, shade=1.0, clear=CLEAR):
    return (1 - alpha) * clear + alpha * shade * WHITE


def opacity_of(light, clear=CLEAR, sky=1.0):
    light = np.asarray(light, np.float32).reshape(1, -1, 3)
    maps = unmix(light, np.broadcast_to(clear, light.shape), WHITE, np.full(light.shape[:2], sky))
    return maps[0][0], maps[1][0]


@pytest.mark.parametrize("shade", [0.4, 0.7, 1.0, 1.3])
@pytest.mark.parametrize("alpha", [0.4, 0.6, 0.8, 1.0])
def test_opacity_and_shade_of_a_blue_sky_come_back(alpha, shade):
    opacity, k = opacity_of(veiled(alpha, shade))
    # The ridge towards "no cloud" costs up to a seventh of the opacity; 0.15 and 0.18 measured.
    assert alpha - 0.17 < opacity[0] < alpha + 0.03
    assert abs(k[0] - shade) < 0.2


def test_a_clear_sky_has_no_cloud_at_any_brightness():
    # A fit that errs by a tenth either way is no cloud either.
    opacity, _ = opacity_of(CLEAR * np.array([[0.9], [1.0], [1.1]]))
    assert opacity.max() < 0.05
    assert opacity[1] == 0


def test_more_veil_is_never_less_opacity():
    opacity, _ = opacity_of([veiled(a) for a in np.linspace(0, 1, 201)])
    assert np.all(np.diff(opacity) >= -1e-6)
    assert opacity[0] == 0
    assert opacity[-1] > 0.8


def test_opacity_and_shade_stay_in_their_ranges_for_any_colour():
    light = np.random.default_rng(1).random((4000, 3)) ** 3 * 30
    opacity, shade = opacity_of(light)
    assert opacity.min() >= 0
    assert opacity.max() <= 1
    assert shade.min() >= 0
    assert shade.max() <= 1.5


def test_opacity_is_the_same_at_dusk_as_at_noon():
    light = np.array([veiled(a) for a in (0.2, 0.5, 0.9)])
    bright, _ = opacity_of(light)
    scale = np.float32(1e-3)
    dim = unmix(
        (light * scale).reshape(1, -1, 3).astype(np.float32),
        np.broadcast_to(CLEAR * scale, (1, 3, 3)),
        WHITE * scale,
        np.ones((1, 3)),
    )[0][0]
    assert np.allclose(bright, dim, atol=1e-3)


def test_outside_the_sky_there_is_no_cloud():
    opacity, _ = opacity_of(veiled(0.8), sky=0.0)
    assert opacity[0] == 0


def test_a_dark_base_and_a_bright_top_are_both_opaque_where_red_over_blue_differs():
    base, top = opacity_of([veiled(0.95, 0.35), veiled(0.95, 1.2)])[0]
    assert min(base, top) > 0.8


def around_sun(glow=0.0, cloud=0.0):
    """Return the opacity that is found in a clear sky with a wide glow, and with a cloud beside."""
    from sunwidget.analysis.backdrop.backdrop import matched_sky
    from sunwidget.analysis.clouds.clouds import veil
    from sunwidget.analysis.images.working_copy import Working

    photo = known_photo(clouds=False, noise=0)
    fit = exact_fit(photo)
    height, width = photo.sky.shape
    light = matched_sky(fit, photo.camera, (width, height))
    x, y = photo.camera.pixel(*photo.sun)
    rows, columns = np.mgrid[:height, :width] + 0.5
    away = np.hypot(columns - x, rows - y) / width
    light = light * np.exp(glow * np.exp(-np.square(away / 0.2)))[..., None]
    beside = (np.hypot(columns - x + 0.25 * width, rows - y) < 0.05 * width)[..., None]
    light = light + cloud * beside * (3 * light.mean() - light)
    linear = np.clip(photo.response.display_light(light), 0, 1).astype(np.float32)
    working = Working(linear, linear ** np.float32(1 / 2.2), linear, (width, height))
    found = veil(working, photo.sky, photo.camera, fit, sun_seen=True)[0].opacity
    return found, beside[..., 0] & (photo.sky > 0)


def test_a_glow_all_round_the_sun_that_the_model_lacks_is_no_cloud():
    assert around_sun(glow=1.0)[0].max() < 0.1


def test_a_cloud_on_one_side_of_the_sun_is_one_in_its_glow_too():
    found, beside = around_sun(glow=0.5, cloud=0.9)
    assert np.median(found[beside]) > 0.5
    assert np.quantile(found[~beside], 0.9) < 0.2


def test_the_clouds_white_is_nearly_white_by_day_and_follows_the_sky_at_dusk():
    by_day = cloud_white_of(known_photo(sun=(8.0, 40.0), clouds=False))
    assert by_day.max() / by_day.min() < 1.5


def cloud_white_of(photo):
    return cloud_white(exact_fit(photo))


def test_the_drawn_clouds_are_found_and_little_else():
    known, scene = known_photo(), known_scene()
    away = scene.without_sun.glow < 0.45  # nearer to the sun whiteness tells nothing
    thick = (known.opacity > 0.8) & away
    clear = (known.opacity == 0) & (known.sky > 0) & away
    assert thick.sum() > 12
    # Drawn opacity is 0.85; so hazy a sky is nearly as white as its clouds, and the un-mixing then
    # prefers to see no cloud (0.33 measured).
    assert np.median(scene.clouds[thick]) > 0.25
    assert np.percentile(scene.clouds[clear], 90) < 0.2
    assert (
        np.corrcoef(scene.clouds[away & (known.sky > 0)], known.opacity[away & (known.sky > 0)])[
            0, 1
        ]
        > 0.8
    )


def test_layers_of_an_evening_are_layers_of_cloud_though_the_model_has_a_glow_ahead():
    height, width, horizon = 160, 240, 100
    rows = np.linspace(0, 1, horizon)
    colors = [(70, 45, 130), (110, 60, 120), (230, 90, 60), (250, 130, 50), (255, 190, 110)]
    picture = np.full((height, width, 3), 12.0)
    for channel, values in enumerate(np.transpose(colors)):
        picture[:horizon, :, channel] = np.interp(rows, (0, 0.35, 0.5, 0.8, 1), values)[:, None]
    picture += np.random.default_rng(1).normal(0, 1.5, picture.shape)
    sky = (np.arange(height)[:, None] < horizon) * np.ones(width, np.float32)
    scene = sw.analyze(
        np.uint8(np.clip(picture, 0, 255)),
        sky=sky,
        water="none",
        refine="none",
        horizon=float(horizon),
        fov=45.0,
        sun=None,
    )
    assert abs(scene.automatic["sun_azimuth"]) < 3
    assert scene.clouds[:horizon].max() > 0.5
    assert scene.clouds[5 : horizon - 8, 10:-10].std(1).max() < 0.25
