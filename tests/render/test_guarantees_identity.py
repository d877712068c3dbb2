"""An unmoved sun changes nothing; what is switched off changes nothing."""

import cv2
import numpy as np
import pytest
from house_scenes import house_scene
from relight_scenes import SAMPLES, known_photo, known_scene, sample_scene

import sunwidget as sw
from sunwidget.analysis import frame_inputs
from sunwidget.analysis.images.working_copy import smoothstep
from sunwidget.analysis.sun.camera_glare import angle_to_sun
from sunwidget.edit.table import NUMBERS, Edit
from sunwidget.formats.color import LUMINANCE
from sunwidget.renderer import render, render_pass

OFF = {"sky_strength": 0, "land_strength": 0, "auto_exposure": 0}
SUNS = [(0, 60), (-30, 8), (100, 0.3), (180, -6), (5, -12)]


def difference(picture, other):
    return int(np.abs(picture.astype(np.int64) - other).max())


@pytest.mark.parametrize("name", SAMPLES)
def test_an_unmoved_sun_changes_no_pixel_of_a_sample(name):
    scene = sample_scene(name)
    assert difference(render(scene), scene.photo.encoded) <= 1


@pytest.mark.parametrize("name", SAMPLES)
def test_naming_the_found_sun_is_the_same_as_not_moving_it(name):
    scene = sample_scene(name)
    found = {key: scene.automatic[key] for key in ("sun_azimuth", "sun_elevation")}
    assert np.array_equal(render(scene, Edit(**found)), render(scene))


def test_every_automatic_value_named_is_the_unmoved_picture():
    scene = known_scene()
    assert difference(render(scene, Edit(**scene.automatic)), scene.photo.encoded) == 0


@pytest.mark.shared
def test_an_unmoved_sun_changes_no_pixel_of_real_photos(shared):
    paths = sorted((shared / "data" / "photos").glob("*.jpg"))[::9]
    if len(paths) < 5:
        pytest.skip("no photos in the shared folder")
    for path in paths:
        photo = sw.open(path)
        small = cv2.resize(photo.encoded, (160, 108), interpolation=cv2.INTER_AREA)
        assert difference(render(sw.analyze(small)), small) <= 1, path.name


def test_sixteen_bits_stay_within_four_levels():
    known = known_photo()
    random = np.random.default_rng(2)
    # Below the 8-bit steps, so that all sixteen bits are used.
    fine = known.code * 65535 + random.uniform(-128, 128, known.code.shape)
    picture = np.clip(fine, 0, 65535).astype(np.uint16)
    same = render(known.analyze(picture), dtype="uint16")
    assert difference(same, picture) <= 4


def test_float_light_comes_back_to_the_bit_beyond_white_and_below_black_too():
    known = known_photo()
    light = known.linear.copy()
    light[:4, :9] = 7.5
    light[-4:, :9] = -0.02
    scene = known.analyze(light)
    assert np.array_equal(render(scene, dtype="float32"), light)


@pytest.mark.parametrize("color", [0, 1, 128, 254, 255])
def test_flat_pictures_stay_flat(color):
    picture = np.full((24, 36, 3), color, np.uint8)
    assert np.array_equal(render(sw.analyze(picture)), picture)


@pytest.mark.parametrize("sun", SUNS)
@pytest.mark.parametrize("name", ["coast", "meadow"])
def test_with_sky_and_land_off_no_sun_changes_anything(name, sun):
    scene = sample_scene(name)
    edit = Edit(sun_azimuth=sun[0], sun_elevation=sun[1], **OFF)
    assert np.array_equal(render(scene, edit), scene.photo.encoded)


def test_land_strength_zero_leaves_the_land_and_sky_strength_zero_the_sky():
    scene = known_scene()
    land, sky = scene.sky == 0, scene.sky == 1
    moved = {"sun_azimuth": -15, "sun_elevation": 3}
    without_land = render(scene, Edit(land_strength=0, **moved))
    without_sky = render(scene, Edit(sky_strength=0, **moved))
    assert np.array_equal(without_land[land], scene.photo.encoded[land])
    assert np.array_equal(without_sky[sky], scene.photo.encoded[sky])
    assert difference(without_land[sky], scene.photo.encoded[sky]) > 10
    assert difference(without_sky[land], scene.photo.encoded[land]) > 10


def test_cloud_strength_zero_relights_clouds_as_the_sky_behind_them():
    # Exactly off: the opacity has no part in the ratio any more, whatever the silver lining.
    scene = known_scene()
    moved = Edit(sun_azimuth=-15, sun_elevation=3, cloud_strength=0, auto_exposure=0, sun_size=0)
    moved = moved.replace(glow=0, light_shafts=0)
    bright = moved.replace(silver_lining=3)
    assert np.array_equal(render(scene, moved), render(scene, bright))
    light = render_pass(scene, moved, "scene_light")[..., :3]
    now, before = (render_pass(scene, moved, f"sky_{state}") for state in ("edit", "source"))
    ratio = now[..., :3] / before[..., :3]
    # Plain ratio in the sky, where the photo is trusted and the ratio not extreme, but for the
    # little colour that a cloud has beside the model (sky/tint.glsl).
    plain = (scene.sky == 1) & (frame_inputs.surface(scene)[..., 0] < 1e-4) & (scene.clouds > 0.2)
    plain &= np.abs(np.log2(ratio.mean(-1))) < 2
    assert plain.sum() > 30
    # Light that the sky has beside the model fades, too (GetFadedLight, sky/relit_sky.glsl).
    own, more = np.moveaxis(
        cv2.resize(render_pass(scene, moved, "own_sky")[..., :2], scene.sky.shape[::-1]), -1, 0
    )
    change = np.log(now[..., :3] @ LUMINANCE / (before[..., :3] @ LUMINANCE))
    share = change**2 / (change**2 + 1)
    turned = away_from(scene, -15, 3)[int(scene.sun.y), int(scene.sun.x)]
    gone = 1 - smoothstep(0.77, 0.99, np.cos(np.radians(turned)))
    faded = np.exp(
        -share * own / np.sqrt(1 + (own / 0.7) ** 2)
        - np.maximum(gone - share, 0) * more / np.sqrt(1 + (more / 1.2) ** 2)
    )
    # So does a low sun redden what lies about it (GetLowSunChange, sky/low_sun.glsl).
    near = np.exp((np.cos(np.radians(away_from(scene, -15, 3))) - 1) / 0.05)[..., None]
    far = np.array([0.38, -0.12, -0.17]) - 0.6
    low = 2 ** (0.3 * (far + near * (np.array([0.42, -0.08, -1.21]) - far)))
    expected = scene_to_display(scene, light * ratio * faded[..., None] * low)
    actual = render(scene, moved, dtype="float32")
    assert np.abs(actual - expected)[plain].max() < 0.03


def away_from(scene, azimuth, elevation):
    """Degrees between each pixel's direction and another."""
    return angle_to_sun(scene.camera, (scene.width, scene.height), (azimuth, elevation))


def scene_to_display(scene, light):
    w = frame_inputs.uniforms(scene)["response_shoulder"]
    return (1 - np.exp(-w * light ** frame_inputs.uniforms(scene)["response_contrast"])) / w


def test_silver_lining_shows_in_thin_cloud_only():
    scene = known_scene()
    moved = Edit(sun_azimuth=-12, sun_elevation=20, auto_exposure=0)
    without = render(scene, moved.replace(silver_lining=0), dtype="float32")
    lined = render(scene, moved.replace(silver_lining=3), dtype="float32")
    changed = np.abs(lined - without).max(-1) > 1e-6
    assert changed.any()
    clear = frame_inputs.layers(scene)[..., 1] < 1 / 512
    assert not changed[clear & (scene.sky == 1)].any()


# What a change of each parameter is shown with: a moved sun, and what the parameter needs.
SHOWN = {
    "sun_sky_ratio": {"method": "thesis"},
    "thesis_saturation": {"method": "thesis", "sun_elevation": -0.3},
    "cloud_ratio_min": {"method": "thesis"},
    "cloud_ratio_max": {"method": "thesis"},
    "blend_distance": {"method": "thesis"},
    "blend_power": {"method": "thesis"},
    "colourfulness": {"sun_elevation": -2},
    "auto_exposure": {"sun_elevation": 2},
    "shading": {"land_facing": 1},
    "cast_shadows": {"sun_azimuth": 20, "sun_elevation": 2},
    "cloud_shadows": {"sun_azimuth": -15, "sun_elevation": 25},  # behind the thickest cloud
    "light_shafts": {"aerosol_optical_depth": 0.5, "sun_azimuth": -20, "sun_elevation": 14},
    "grain": {"auto_exposure": 0},
    "window_lights": {"sun_elevation": -4},
    "window_temperature": {"sun_elevation": -4, "window_lights": 1},
    "added_cloud_size": {"added_clouds": 0.5},
    "added_cloud_height": {"added_clouds": 0.5},
    "cloud_pattern": {"added_clouds": 0.5},
    "wind_speed": {"added_clouds": 0.5, "wind_time": 30},
    "wind_direction": {"added_clouds": 0.5, "wind_time": 30},
    "wind_time": {"added_clouds": 0.5},
    "starburst": {"sun_elevation": 14},  # by day
}


# A bare plain under small clouds shades nothing, mirrors nothing and has no light to lose.
ON_SAMPLE = dict.fromkeys(("cast_shadows", "colourfulness", "water_strength", "glitter"), "coast")
ON_SAMPLE["cloud_shadows"] = "mountains"  # land so far off that their places differ


@pytest.mark.parametrize("parameter", NUMBERS, ids=lambda p: p.name)
def test_every_slider_changes_some_picture(parameter):
    sample = ON_SAMPLE.get(parameter.name)
    scene = sample_scene(sample) if sample else known_scene()
    if parameter.name.startswith("window"):
        scene = house_scene()
    if parameter.name == "starburst":  # only where the photo shows no sun
        scene = known_photo(tint=(0.4, 1.0, 2.0)).analyze(sun="outside")
    base = {"sun_azimuth": -12.0, "sun_elevation": 8.0, **SHOWN.get(parameter.name, {})}
    low, high = parameter.minimum, parameter.maximum
    values = [low + share * (high - low) for share in (0.1, 0.9)]
    pictures = [render(scene, Edit(**{**base, parameter.name: value})) for value in values]
    assert difference(*pictures) >= 2
