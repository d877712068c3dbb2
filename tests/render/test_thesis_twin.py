"""The thesis' methods against straight NumPy, and each erratum of the printed equations."""

import dataclasses

import numpy as np
import pytest
from relight_scenes import known_photo, known_scene, sample_scene
from thesis_reference import (
    LUMINANCE,
    quantised,
    rendered_sky,
    thesis_frame,
    transfer,
    weighted_statistics,
)

from sunwidget.analysis import frame_inputs
from sunwidget.analysis.images.color_transfer import Statistics
from sunwidget.edit.table import Edit
from sunwidget.renderer import render, render_pass
from sunwidget.renderer.values import parameter_values

SUNS = [{}, {"sun_elevation": 30}, {"sun_azimuth": -10, "sun_elevation": 5}, {"sun_elevation": -2}]
BOTH = ["thesis", "thesis_literal"]
# All soft: r/b is far above m_max. All thick: r/b is below m_min.
ALL_SOFT = {"cloud_ratio_min": 0.0, "cloud_ratio_max": 0.001}
ALL_THICK = {"cloud_ratio_min": 2.0, "cloud_ratio_max": 3.0}


def scene_of(name):
    return known_scene() if name == "known" else sample_scene(name)


def land_gain(scene, edit):
    """Mean gain per channel of dark, unclipped land."""
    light = render(scene, edit, dtype="float32")
    land = (scene.sky < 1e-3) & (scene.photo.pixels.min(-1) > 0.02)
    return np.median(light[land] / scene.photo.pixels[land], axis=0)


@pytest.mark.parametrize("sun", SUNS, ids=str)
@pytest.mark.parametrize("name", ["known", "coast", "harbour"])
def test_the_frame_is_the_equations(name, sun):
    scene = scene_of(name)
    edit = Edit(method="thesis", **sun)
    apart = np.abs(thesis_frame(scene, edit, sky="passes").astype(int) - render(scene, edit))
    # A level of dither and rounding; up to two more because the shader takes the sky's mean and
    # deviation on a grid of 96 × 72 (mean: 32 × 24) points, the twin over every pixel.
    assert apart.mean() < 0.6
    assert apart.max() <= 3


@pytest.mark.parametrize("sun", SUNS, ids=str)
@pytest.mark.parametrize("name", ["known", "coast", "harbour"])
def test_the_literal_frame_is_the_equations_as_printed(name, sun):
    scene = scene_of(name)
    edit = Edit(method="thesis_literal", **sun)
    apart = np.abs(thesis_frame(scene, edit, sky="passes").astype(int) - render(scene, edit))
    # The printed cloud mask is binary and 1 - C^s grows without bound: where r/b meets m_min a
    # rounding decides, and 3.13 multiplies what the blur's 49 samples leave open.
    assert apart.mean() < 0.8
    assert np.percentile(apart, 99) <= 3


@pytest.mark.parametrize("sun", [SUNS[0], SUNS[2]], ids=str)
def test_the_whole_frame_from_the_model_in_numpy_is_the_shaders(sun):
    scene = known_photo(size=(60, 40)).analyze()
    edit = Edit(method="thesis", **sun)
    apart = np.abs(thesis_frame(scene, edit, sky="model").astype(int) - render(scene, edit))
    # The model itself differs by 1 % between the fast NumPy march and the shaders' tables.
    assert apart.mean() < 0.8
    assert apart.max() <= 6


def test_reinhards_transfer_gives_the_rendered_sky_the_photos_mean_and_deviation():
    scene = known_scene()
    sky = rendered_sky(scene, parameter_values(Edit(), scene.automatic), "passes", "source")
    weight = quantised(scene.sky)
    known = frame_inputs.uniforms(scene)
    target = Statistics(known["photo_sky_mean"], known["photo_sky_deviation"])
    moved = transfer(sky, weighted_statistics(sky, weight), target)
    got = weighted_statistics(moved, weight)
    assert np.abs(np.subtract(got.mean, target.mean)).max() < 1e-3
    # Deviations below 0.02 are not scaled up: a flat channel of the source stays flat.
    own = np.array(weighted_statistics(sky, weight).deviation)
    wide = own > 0.02
    assert wide.any()
    assert np.allclose(np.array(got.deviation)[wide], np.array(target.deviation)[wide], rtol=0.02)


@pytest.mark.parametrize("name", ["known", "coast", "meadow"])
def test_erratum_37_an_unmoved_sun_leaves_the_land_alone_and_as_printed_does_not(name):
    scene = scene_of(name)
    assert np.allclose(land_gain(scene, Edit(method="thesis")), 1, atol=1e-5)
    printed = land_gain(scene, Edit(method="thesis_literal", sun_sky_ratio=0))
    known = frame_inputs.uniforms(scene)
    sky, land = (np.array(known[f"photo_{part}_linear_mean"]) for part in ("sky", "land"))
    rendered = render_pass(scene, Edit(method="thesis"), "thesis_mean_edit")[0, 0, :3]
    # Q S̄ʳ / F̄ with Q = S̄ / F̄, where the matched sky has about the photo's mean: (S̄ / F̄)².
    assert np.allclose(printed, sky * rendered / land**2, rtol=2e-3)
    assert np.allclose(printed, (sky / land) ** 2, rtol=0.35)


def test_erratum_310_a_thick_cloud_under_an_unmoved_sun_keeps_its_colour():
    scene = known_scene()
    thick = (quantised(scene.clouds) > 0.5) & (scene.sky == 1)
    assert thick.sum() > 5
    edit = Edit(method="thesis", sun_size=0, **ALL_THICK)
    light = render(scene, edit, dtype="float32")
    sky = render(scene, edit.replace(cloud_ratio_min=2.0), dtype="float32")
    opacity = quantised(scene.clouds)[thick][:, None]
    # 3.15 mixes it with the matched sky by its opacity; what is left is the photo's own colour.
    first = light_of_sky(scene, edit)[thick]
    cloud = (light[thick] - (1 - opacity) * first) / opacity
    assert np.abs(cloud - scene.photo.pixels[thick]).max() < 0.01
    assert np.array_equal(light, sky)


def light_of_sky(scene, edit):
    """The matched sky S, from a copy of the scene without clouds."""
    clear = dataclasses.replace(scene, cloud_map=np.zeros_like(scene.clouds))
    return render(clear, edit, dtype="float32")


def test_erratum_313_soft_cloud_keeps_its_colour_and_as_printed_darkens_near_the_sun():
    scene = known_scene()
    opacity = quantised(scene.clouds)
    soft = (opacity > 0.5) & (scene.sky == 1)
    base = {"sun_size": 0, "blend_distance": 2.0, **ALL_SOFT}
    edit = Edit(method="thesis", **base)
    share = opacity[soft][:, None]
    first = light_of_sky(scene, edit)[soft]
    right = (render(scene, edit, dtype="float32")[soft] - (1 - share) * first) / share
    assert np.abs(right - scene.photo.pixels[soft]).max() < 0.02
    # C^s is not clamped in print, so soft and thick are told apart by m_max beyond reach of r/b.
    printed = render(
        scene, Edit(method="thesis_literal", sun_size=0, blend_distance=2.0), dtype="float32"
    )
    assert (printed[soft] @ LUMINANCE).mean() < 0.8 * (right @ LUMINANCE).mean()


def test_erratum_36_softness_is_clamped_and_as_printed_makes_negative_light():
    scene = known_scene()
    edit = Edit(cloud_ratio_min=0.3, cloud_ratio_max=0.5, sun_azimuth=-10, sun_elevation=3)
    printed = render(scene, edit, method="thesis_literal", dtype="float32")
    assert printed.min() < -0.05
    assert render(scene, edit, method="thesis", dtype="float32").min() >= 0


def test_erratum_311_the_new_sun_shines_through_thin_cloud_and_not_through_thick():
    scene = known_photo(clouds=False).analyze()
    height, width = scene.sky.shape
    row, column = int(0.25 * height), int(0.3 * width)
    azimuth, elevation = scene.camera.angles(column + 0.5, row + 0.5)
    levels = {}
    for opacity in (0.0, 0.5, 1.0):
        veiled = dataclasses.replace(scene, cloud_map=np.full_like(scene.clouds, opacity))
        edit = Edit(sun_azimuth=azimuth, sun_elevation=elevation, sun_size=5, **ALL_SOFT)
        light = render(veiled, edit, method="thesis", dtype="float32") @ LUMINANCE
        dark = render(veiled, edit.replace(sun_size=0), method="thesis", dtype="float32")
        levels[opacity] = light[row, column] - (dark @ LUMINANCE)[row, column]
    assert min(levels[0.0], levels[0.5]) > 0.02
    assert abs(levels[1.0]) < 1e-4


def test_erratum_fs_the_printed_weight_depends_on_the_masks_area_and_the_right_one_does_not():
    scene = known_scene()
    mask = np.zeros_like(scene.sun.blot)
    mask[:20, :20] = 1
    wide = dataclasses.replace(scene, sun=dataclasses.replace(scene.sun, blot=mask))
    edit = Edit(sun_azimuth=-10, sun_elevation=5)
    printed = [land_gain(s, edit.replace(method="thesis_literal")) for s in (scene, wide)]
    right = [land_gain(s, edit.replace(method="thesis")) for s in (scene, wide)]
    assert np.abs(printed[1] / printed[0] - 1).max() > 0.05
    assert np.allclose(right[0], right[1], rtol=1e-5)


def test_eq_38_takes_colour_and_leaves_luminance():
    scene = known_scene()
    hidden = Edit(method="thesis", sun_elevation=-0.6)
    assert render_pass(scene, hidden, "visibility_edit")[0, 0, 0] < 0.1
    land = scene.sky < 1e-3
    full = render(scene, hidden, dtype="float32")[land]
    pale = render(scene, hidden.replace(thesis_saturation=0.0), dtype="float32")[land]

    def saturation(light):
        return np.median((light.max(-1) - light.min(-1)) / np.maximum(light.max(-1), 1e-6))

    assert saturation(pale) < 0.2 * saturation(full)
    middle = render(scene, hidden.replace(thesis_saturation=0.5), dtype="float32")[land]
    assert saturation(pale) < saturation(middle) < saturation(full)


def test_lower_suns_darken_the_land_of_the_corrected_thesis():
    scene = known_scene()
    gains = [land_gain(scene, Edit(method="thesis", sun_elevation=e)) for e in (14, 6, 2, 0, -3)]
    levels = [float(gain @ LUMINANCE) for gain in gains]
    assert levels == sorted(levels, reverse=True)
    assert levels[-1] < 0.3
