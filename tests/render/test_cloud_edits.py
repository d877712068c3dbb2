"""Clouds thinned, thickened, dissolved, added: neutral is the photo, removal leaves clear sky."""

from itertools import pairwise

import numpy as np
import pytest
from relight_scenes import known_photo, known_scene, sample_scene
from skimage.color import deltaE_ciede2000, rgb2lab

from sunwidget.edit.table import Edit
from sunwidget.renderer import render, render_pass, scene_textures

# The sun out of the frame, and skies as blue as cameras show them (analysis/fit/overcast.py).
SIDEWAYS = {"sun": (70.0, 30.0), "tint": (0.7, 1.0, 1.3), "depth": 0.06}


def retouched(scene, **changes):
    return render_pass(scene, Edit(**changes), "retouched")


@pytest.mark.parametrize("name", ["coast", "meadow"])
def test_neutral_parameters_leave_photo_and_opacity_to_the_bit(name):
    scene = sample_scene(name)
    textures = scene_textures(scene, (scene.width, scene.height))
    same = retouched(scene, wind_time=20, cloud_pattern=7, added_cloud_size=3)
    assert np.array_equal(same[..., :3], textures["photo"])
    assert np.abs(same[..., 3] - textures["layers"][..., 1] / 255).max() < 1e-6


def test_removed_clouds_leave_the_known_clear_sky():
    cloudy, clear = known_photo(**SIDEWAYS), known_photo(**SIDEWAYS, clouds=False)
    scene = cloudy.analyze()
    inside = (cloudy.opacity > 0.5) & (cloudy.sky > 0)
    assert inside.sum() > 100

    def error(picture):
        return deltaE_ciede2000(rgb2lab(picture), rgb2lab(clear.bytes))[inside]

    left = error(render(scene, Edit(cloud_opacity=0, land_strength=0)))
    assert error(cloudy.bytes).mean() > 8
    assert left.mean() < 2.5
    # No ghost: nor is any part far from the sky.
    assert np.percentile(left, 98) < 6


def test_what_shows_no_cloud_is_left_alone():
    scene = known_photo(**SIDEWAYS, clouds=False).analyze()
    change = np.abs(retouched(scene, cloud_opacity=0)[..., :3] - scene.photo.pixels).max(-1)
    assert np.median(change) == 0
    assert np.percentile(change, 99) < 0.02
    assert change[scene.sky == 0].max() == 0


def test_removal_keeps_grain():
    cloudy = known_photo(**SIDEWAYS, noise=0.01)
    removed = render(cloudy.analyze(), Edit(cloud_opacity=0), dtype="float32")
    thick = cloudy.opacity > 0.7

    def roughness(picture):
        level = np.log(picture[..., 1])
        return np.std(np.diff(level, axis=1)[thick[:, 1:] & thick[:, :-1]])

    assert roughness(removed) > 0.25 * roughness(cloudy.linear)


def test_opacity_follows_its_slider_without_steps():
    scene = known_scene()
    values = np.linspace(0, 2, 21)
    maps = [retouched(scene, cloud_opacity=float(v)) for v in values]
    opacity = np.array([m[..., 3] for m in maps])
    assert np.diff(opacity, axis=0).min() >= -1e-6
    assert opacity[0].max() < 1e-6
    thin = (opacity[10] > 0.2) & (opacity[10] < 0.6)
    assert (opacity[-1] > 1.25 * opacity[10])[thin].all()
    steps = [np.abs(b - a)[..., :3].max() for a, b in pairwise(maps)]
    assert max(steps) < 0.12


def test_softness_dissolves_edges_and_keeps_land():
    scene = known_scene()
    sharp, soft = retouched(scene), retouched(scene, cloud_softness=1)
    land = scene.sky == 0
    assert np.array_equal(soft[land, :3], sharp[land, :3])

    def steepest(opacity):
        return np.abs(np.diff(opacity, axis=1)).max()

    assert steepest(soft[..., 3]) < 0.8 * steepest(sharp[..., 3])
    near = np.abs(retouched(scene, cloud_softness=0.01) - sharp).max()
    assert 0 < near < 0.05


def test_more_added_clouds_cover_more_and_never_the_land():
    scene = known_photo(**SIDEWAYS, clouds=False).analyze()
    assert np.array_equal(retouched(scene, added_clouds=0.0)[..., :3], scene.photo.pixels)
    shares = (0.1, 0.3, 0.5, 0.7, 0.9, 1.0)
    layers = [
        render_pass(scene, Edit(added_clouds=c, added_cloud_size=0.3), "added_layer")[..., 3]
        for c in shares
    ]
    means = [float(layer.mean()) for layer in layers]
    assert all(b > a for a, b in pairwise(means))
    full = retouched(scene, added_clouds=1.0)
    assert np.array_equal(full[scene.sky == 0, :3], scene.photo.pixels[scene.sky == 0])
    high = slice(0, scene.height // 4)
    assert full[high, :, 3].min() > 0.6


def test_added_clouds_lie_in_perspective():
    scene = known_photo(**SIDEWAYS, clouds=False).analyze()
    edit = Edit(added_clouds=0.5, added_cloud_size=0.25, added_cloud_height=3)
    cover = render_pass(scene, edit, "added_layer", size=(480, 320))[..., 3] > 0.3

    def changes_per_row(rows):
        return np.abs(np.diff(cover[rows].astype(int), axis=1)).sum(1).mean()

    top, low = slice(0, 12), slice(55, 67)
    assert changes_per_row(low) > 1.2 * changes_per_row(top)


def test_wind_moves_the_added_clouds_and_only_with_time():
    scene = known_scene()
    base = {"added_clouds": 0.5}

    def layer(**changes):
        return render_pass(scene, Edit(**base, **changes), "added_layer")

    still = layer()
    assert np.array_equal(layer(wind_speed=12), still)
    assert np.array_equal(layer(wind_speed=0, wind_time=30), still)
    drifted = layer(wind_time=30)
    assert np.abs(drifted - still).max() > 0.1
    # As far with twice the wind in half the time, and back again.
    assert np.allclose(layer(wind_speed=10, wind_time=15), drifted, atol=2e-3)
    assert np.array_equal(layer(), still)


def test_added_clouds_before_the_sun_dim_the_land_but_let_light_through():
    scene = known_scene()
    visible = [
        render_pass(scene, Edit(added_clouds=c), "visibility_edit")[0, 0, 0] for c in (0, 0.5, 1)
    ]
    assert visible[0] > visible[2] > 0.2


def test_the_moved_sun_relights_added_clouds_and_returns():
    scene = known_scene()
    here = Edit(added_clouds=0.6)
    before = render(scene, here)
    evening = render(scene, here.replace(sun_elevation=0.5, sun_azimuth=-5))
    assert np.abs(evening.astype(int) - before).mean() > 5
    assert np.array_equal(render(scene, here), before)
