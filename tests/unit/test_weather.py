"""What photos show beyond a clear sky: low suns, evenings that end, clouds, no sky at all."""

import numpy as np
from relight_scenes import known_photo, known_scene

from sunwidget.edit import Edit
from sunwidget.renderer import render

LOW = Edit(sun_azimuth=60, sun_elevation=3)
DUSK = Edit(sun_azimuth=8, sun_elevation=-4)
HIGH = Edit(sun_azimuth=70, sun_elevation=40)


def balance(light):
    """Log2 of red over blue and of green over both."""
    red, green, blue = np.log2(np.maximum(light, 1e-6)).reshape(-1, 3).mean(0)
    return red - blue, green - (red + blue) / 2


def rendered(scene, edit):
    return render(scene, edit, dtype="float32")


def test_a_low_sun_reddens_clouds_more_than_clear_sky_and_greens_nothing():
    photo = known_photo(sun=(8.0, 40.0), size=(240, 160))
    scene = photo.analyze()
    frame = rendered(scene, LOW)
    cloud, clear = photo.opacity > 0.85, (photo.opacity == 0) & (photo.sky > 0)
    (cloud_red, cloud_green), (clear_red, clear_green) = (
        balance(frame[cloud]),
        balance(frame[clear]),
    )
    assert cloud_red > clear_red + 0.2
    assert cloud_red > 0.95
    assert cloud_green < 0.1
    assert clear_green < 0.02


def test_the_colours_of_an_evening_go_as_the_sun_rises():
    photo = known_photo(sun=(8.0, 4.0), tint=(2.0, 1.0, 0.5), size=(240, 160))
    scene = photo.analyze()
    sky = photo.sky > 0
    assert balance(photo.linear[sky])[0] > 2
    assert balance(rendered(scene, HIGH)[sky])[0] < -0.4


def test_clouds_in_a_deep_blue_sky_are_grey_at_dusk():
    photo = known_photo(sun=(8.0, 40.0), tint=(0.4, 1.0, 2.0), size=(240, 160))
    scene = photo.analyze()
    cloud = photo.opacity > 0.85
    assert -1.4 < balance(rendered(scene, DUSK)[cloud])[0] < -0.3


def test_a_clouds_shade_has_the_skys_colour():
    photo = known_photo(sun=(8.0, 40.0), size=(240, 160))
    picture = photo.linear.copy()
    cloud = photo.opacity > 0.85
    left = cloud & (np.arange(240) < 120)
    picture[left] *= 0.35
    scene = photo.analyze(np.uint8(255 * picture ** (1 / 2.2)))
    frame = rendered(scene, LOW)
    assert balance(frame[left])[0] < balance(frame[cloud & ~left])[0] + 0.15


def test_a_picture_without_sky_changes_as_one():
    photo = known_photo()
    scene = photo.analyze(sky=np.zeros_like(photo.sky), sun=None)
    land = photo.sky == 0
    before, now = rendered(scene, Edit()), rendered(scene, LOW)
    ratio = np.log2(now[land] / before[land])
    assert (ratio.std(0) < 0.05).all()
    assert np.abs(ratio.mean(0)).max() > 0.2


def test_land_that_darkens_does_not_drown_in_black():
    scene = known_scene()
    land = (scene.sky < 0.02) & (render(scene)[..., :3].max(-1) > 15)
    assert render(scene, Edit(sun_elevation=-4, exposure=-4))[..., :3].max(-1)[land].min() >= 8
