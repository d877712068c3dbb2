"""Where the matte is soft a pixel shows sky and land; each must follow its own light."""

import dataclasses

import numpy as np
import pytest
from relight_scenes import known_photo

import sunwidget as sw
from sunwidget.renderer import render_pass

MAST = 0.012  # linear light of a dark mast


@pytest.fixture(scope="module")
def mast():
    """A sky with a dark mast whose edges are soft, and the photo with nothing but its sky."""
    plain = known_photo(sun=(60.0, 14.0), noise=0.0, clouds=False)
    columns = np.arange(plain.sky.shape[1])
    alpha = np.clip((np.abs(columns - 60) - 4) / 6, 0, 1).astype(np.float32)
    above = plain.sky > 0.5
    sky = np.where(above, alpha, plain.sky).astype(np.float32)
    mixed = alpha[:, None] * plain.linear + (1 - alpha[:, None]) * MAST
    linear = np.where(above[..., None], mixed, plain.linear).astype(np.float32)
    return dataclasses.replace(plain, linear=linear, sky=sky)


@pytest.mark.parametrize("elevation", [40.0, 1.0, -4.0])
def test_a_soft_edge_stays_the_mix_of_its_two_sides(mast, elevation):
    scene = mast.analyze()
    edit = sw.Edit(sun_elevation=elevation)
    linear = np.asarray(sw.render(scene, edit, dtype="float32"), np.float64)
    rows = slice(8, 24)
    band = linear[rows].mean((0, 2))
    mixture = mast.sky[rows].mean(0)
    assert list(mixture[[46, 60, 74]]) == [1, 0, 1]
    sky = np.interp(np.arange(120), [46, 74], band[[46, 74]])  # behind the mast
    edge = np.flatnonzero((mixture > 0.2) & (mixture < 0.8))
    assert len(edge) >= 6
    expected = mixture[edge] * sky[edge] + (1 - mixture[edge]) * band[60]
    # The mast is darker than what an edge takes land to be at least (GetSkyShare, frame.glsl).
    assert band[edge] == pytest.approx(expected, rel=0.12)


def test_an_unmoved_sun_leaves_soft_edges_alone(mast):
    picture = mast.bytes
    scene = mast.analyze(picture)
    assert np.array_equal(sw.render(scene, sw.Edit()), picture)


def test_a_sun_behind_the_haze_before_land_shows_no_disc():
    photo = known_photo(sun=(60.0, 14.0), noise=0.0, clouds=False)
    column = photo.camera.pixel(0.0, 4.0)
    hazy = np.where(np.arange(80)[:, None] > column[1] - 12, np.float32(0.15), photo.sky)
    scene = photo.analyze(sky=np.where(photo.sky > 0.5, hazy, 0).astype(np.float32))
    edit = sw.Edit(sun_azimuth=0.0, sun_elevation=4.0)
    with_disc, without = (sw.render(scene, edit.replace(sun_size=size)).mean(-1) for size in (1, 0))
    row, x = int(column[1]), int(column[0])
    assert scene.sky[row, x] == np.float32(0.15)
    near = slice(row - 3, row + 4), slice(x - 3, x + 4)
    assert np.abs(with_disc[near] - without[near]).max() <= 1


@pytest.mark.parametrize("elevation", [14.0, -2.0])
def test_air_in_front_of_land_has_the_light_of_the_horizon(elevation):
    scene = known_photo(sun=(60.0, 14.0), noise=0.0, clouds=False).analyze()
    sky = render_pass(scene, sw.Edit(sun_azimuth=20.0, sun_elevation=elevation), "sky_edit")
    horizon = int(scene.horizon.row)
    below = sky[horizon + 2 :, :, :3]
    assert below == pytest.approx(np.broadcast_to(sky[horizon - 1, :, :3], below.shape), rel=0.4)
