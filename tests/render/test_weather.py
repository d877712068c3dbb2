"""What photos show beyond a clear sky: low suns, evenings that end, clouds, no sky at all."""

import dataclasses

import cv2
import numpy as np
import pytest
from relight_scenes import known_photo, known_scene

from sunwidget.analysis import frame_inputs
from sunwidget.analysis.fit.fit import view_angles
from sunwidget.analysis.scene import Scene
from sunwidget.edit.table import Edit
from sunwidget.formats.color import LUMINANCE
from sunwidget.renderer import render

LOW = Edit(sun_azimuth=60, sun_elevation=3)
DUSK = Edit(sun_azimuth=8, sun_elevation=-4)
HIGH = Edit(sun_azimuth=70, sun_elevation=40)
AIRLESS = HIGH.replace(aerial_perspective=0)


def balance(light):
    """Log2 of red over blue and of green over both."""
    red, green, blue = np.log2(np.maximum(light, 1e-6)).reshape(-1, 3).mean(0)
    return red - blue, green - (red + blue) / 2


def rendered(scene, edit):
    return render(scene, edit, dtype="float32")


def test_a_low_sun_reddens_clouds_more_than_clear_sky_and_greens_nothing():
    photo = known_photo(sun=(8.0, 40.0), size=(240, 160))
    scene = photo.analyze()
    frame = rendered(scene, LOW.replace(cloud_strength=1))
    cloud, clear = photo.opacity > 0.85, (photo.opacity == 0) & (photo.sky > 0)
    (cloud_red, cloud_green), (clear_red, clear_green) = (
        balance(frame[cloud]),
        balance(frame[clear]),
    )
    assert cloud_red > clear_red + 0.2
    assert cloud_red > 0.95
    assert cloud_green < 0.1
    assert clear_green < 0.02


def test_a_greenish_sky_is_not_teal_under_a_low_sun():
    photo = known_photo(sun=(8.0, 40.0), tint=(0.5, 1.0, 1.1), size=(240, 160), clouds=False)
    sky = photo.sky > 0
    red, green, _ = np.median(np.log2(rendered(photo.analyze(), LOW)[sky]), 0)
    assert red - green > -0.4


def test_clouds_keep_their_texture_in_the_glow_of_a_new_sun():
    photo = known_photo(sun=(8.0, 40.0), size=(240, 160))
    noise = np.random.default_rng(3).standard_normal((160, 240))
    texture = cv2.GaussianBlur(noise, (0, 0), 3)
    texture *= 0.4 / texture.std()
    linear = photo.linear * np.exp2(texture * photo.opacity)[..., None].astype(np.float32)
    scene = dataclasses.replace(photo, linear=np.clip(linear, 0, 1)).analyze()
    # In the middle of the first cloud.
    x, y = 48, 40
    azimuth, elevation = (float(angle[y, x]) for angle in view_angles(photo.camera, 240, 160))
    frame = rendered(scene, Edit(sun_azimuth=azimuth, sun_elevation=elevation)) @ LUMINANCE
    rows, columns = np.mgrid[:160, :240]
    apart = np.hypot(rows - y, columns - x)
    around = (apart > 6) & (apart < 14) & (photo.opacity > 0.3) & (frame < 0.9)
    known = np.stack([texture[around], np.log(apart[around]), np.ones(around.sum())], 1)
    kept = np.linalg.lstsq(known, np.log2(frame[around]), rcond=None)[0][0]
    assert kept > 0.18


def test_the_colours_of_an_evening_go_as_the_sun_rises():
    photo = known_photo(sun=(8.0, 4.0), tint=(2.0, 1.0, 0.5), size=(240, 160))
    scene = photo.analyze()
    sky = photo.sky > 0
    assert balance(photo.linear[sky])[0] > 2
    assert balance(rendered(scene, HIGH)[sky])[0] < -0.3


def test_an_evening_of_one_channel_does_not_turn_violet_as_the_sun_rises():
    photo = known_photo(sun=(8.0, 4.0), tint=(6.0, 1.0, 0.05), size=(240, 160))
    red, green = balance(rendered(photo.analyze(), HIGH)[photo.sky > 0])
    assert -1.5 < red < 1.5
    assert green > -0.3


def test_a_dark_evening_is_exposed_as_a_day_when_its_sun_has_risen():
    scene = known_photo(sun=(8.0, 4.0)).analyze()
    told = frame_inputs.uniforms(scene)["photo_key"]
    dark = dataclasses.replace(scene, response=scene.response | {"photo_key": -4.2})

    def key(scene, edit):
        return np.log2(np.maximum(rendered(scene, edit), 2**-7)).mean()

    assert -3.5 < told < -1.5
    assert key(dark, HIGH) > key(scene, HIGH) + 0.25
    # Nor is it darkened at dusk; the brightness of others does not matter then.
    assert 0.2 < key(dark, DUSK) - key(scene, DUSK) < 0.5
    dim = dataclasses.replace(scene, response=scene.response | {"photo_key": -2.4})
    assert key(dim, DUSK) == key(scene, DUSK)


def test_a_dark_evenings_sky_is_lifted_and_its_land_is_not():
    scene = known_photo(sun=(8.0, 4.0)).analyze()
    dark = dataclasses.replace(scene, response=scene.response | {"photo_sky_key": -4.0})
    sky, land = scene.sky > 0.98, scene.sky < 0.02
    ratio = rendered(dark, AIRLESS) / rendered(scene, AIRLESS)
    assert np.median(ratio[sky]) > 1.1
    assert np.median(ratio[land]) < 1.05
    assert np.array_equal(rendered(dark, DUSK), rendered(scene, DUSK))


def test_bright_land_is_held_back_and_dark_land_is_not():
    scene = known_photo(sun=(8.0, 4.0)).analyze()
    land = scene.sky < 0.02

    def level(mean):
        told = {"photo_land_linear_mean": (mean, mean, mean)}
        changed = dataclasses.replace(scene, response=scene.response | told)
        return rendered(changed, HIGH)[land].mean()

    assert level(0.5) < 0.8 * level(0.1)
    assert level(0.02) > 0.9 * level(0.01)


def test_no_sky_turns_greener_than_it_was():
    photo = known_photo(sun=(8.0, 4.0), tint=(2.0, 1.2, 0.3), size=(240, 160))
    scene = photo.analyze()
    sky = scene.sky > 0.98
    red, green, blue = np.moveaxis(photo.linear, -1, 0)
    own = np.maximum(green / np.maximum(np.maximum(red, blue), 1e-3), 1.0)
    for edit in (DUSK, LOW, HIGH):
        red, green, blue = np.moveaxis(rendered(scene, edit), -1, 0)
        greener = green - own * np.maximum(red, blue)
        assert np.quantile(greener[sky], 0.99) < 0.02


def test_leaves_that_glowed_before_a_low_sun_are_not_red_by_day():
    photo = known_photo(sun=(8.0, 4.0))
    picture = photo.linear.copy()
    land = (photo.sky == 0) & (np.arange(120) > 60)
    picture[land] = (0.3, 0.03, 0.004)
    scene = photo.analyze(np.uint8(255 * picture ** (1 / 2.2)))
    red, green, _ = rendered(scene, HIGH)[land].mean(0)
    assert red / green < 3.5


def test_orange_land_of_an_evening_is_paler_by_day_than_orange_land_under_a_blue_sky():
    def redness(tint):
        photo = known_photo(sun=(8.0, 4.0), tint=tint, clouds=False)
        photo.linear[photo.sky == 0] = (0.3, 0.12, 0.03)
        return balance(rendered(photo.analyze(), AIRLESS)[photo.sky == 0])[0]

    evening, balanced, blue = (
        redness(tint) for tint in ((6.0, 1.0, 0.05), (1.0, 1.0, 1.0), (0.7, 1.0, 2.0))
    )
    assert max(evening, balanced) < blue - 0.4


def test_an_evening_leaves_no_orange_rim_along_a_soft_skyline_by_day():
    photo = known_photo(sun=(8.0, 4.0), tint=(2.0, 1.0, 0.5), clouds=False, size=(240, 160))
    picture = cv2.GaussianBlur(photo.linear, (0, 0), 2)
    sky = cv2.GaussianBlur(photo.sky.astype(np.float32), (0, 0), 2)
    frame = rendered(photo.analyze(np.uint8(255 * picture ** (1 / 2.2))), AIRLESS)
    rim, land = (sky > 0.05) & (sky < 0.4), sky < 1e-3
    assert balance(frame[rim])[0] < balance(frame[land])[0] + 0.1


def test_round_a_seen_low_sun_clouds_change_as_the_sky_does_and_by_day_as_clouds():
    def turned_by_clouds(height):
        scene = known_photo(sun=(8.0, height)).analyze()
        clear = dataclasses.replace(scene, cloud_map=np.zeros_like(scene.cloud_map))
        away = Edit(sun_azimuth=70, sun_elevation=20, glow=0, auto_exposure=0)
        sky = scene.sky > 0.98
        return np.abs(rendered(scene, away) - rendered(clear, away))[sky].mean()

    assert turned_by_clouds(3.0) < 0.2 * turned_by_clouds(30.0)


def test_white_land_glints_only_before_a_low_sun():
    photo = known_photo(sun=(8.0, 40.0))
    picture = photo.linear.copy()
    snow = (photo.sky == 0) & (np.arange(120) > 60)
    picture[snow] = 1.0
    code = np.uint8(255 * picture ** (1 / 2.2))
    seen = photo.analyze(code)
    behind = dataclasses.replace(seen, sun=None, assumed_sun=(170.0, 40.0))
    assert frame_inputs.surface(behind)[..., 2][snow].max() == 0
    assert frame_inputs.surface(seen)[..., 2][snow].max() > 0.5


def test_what_is_whiter_than_paint_without_a_sun_in_front_darkens_as_land_does():
    photo = known_photo(sun=(8.0, 40.0), clouds=False)
    picture, land = photo.linear.copy(), photo.sky == 0
    snow = land & (np.arange(120) > 60)
    picture[land] = 0.1
    picture[snow] = 1.0
    scene = photo.analyze(np.uint8(255 * picture ** (1 / 2.2)), water="none")
    light = {}
    for shown in (True, False):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(Scene, "shows_sun", property(lambda _, known=shown: known))
            light[shown] = rendered(dataclasses.replace(scene), DUSK) @ LUMINANCE
    dark = land & ~snow
    assert light[False][dark] == pytest.approx(light[True][dark], rel=0.1)
    assert light[False][snow].mean() < 0.8 * light[True][snow].mean()


def test_clouds_in_a_deep_blue_sky_are_grey_at_dusk():
    photo = known_photo(sun=(8.0, 40.0), tint=(0.4, 1.0, 2.0), size=(240, 160))
    scene = photo.analyze()
    cloud = photo.opacity > 0.85
    assert -1.4 < balance(rendered(scene, DUSK)[cloud])[0] < -0.3


def test_clouds_follow_the_model_halfway():
    photo = known_photo(sun=(8.0, 40.0), tint=(0.4, 1.0, 2.0), size=(240, 160))
    scene = photo.analyze()
    cloud, clear = photo.opacity > 0.85, (photo.opacity < 0.02) & (photo.sky > 0)

    columns, rows = np.meshgrid(np.arange(240) + 0.5, np.arange(160) + 0.5)
    height = scene.camera.angles(columns, rows)[1]
    bands = [(height >= low) & (height < low + 4) for low in range(0, 60, 4)]
    bands = [band for band in bands if min((cloud & band).sum(), (clear & band).sum()) > 50]
    assert len(bands) > 2

    def over_the_sky(edit):
        light = np.log2(rendered(scene, edit) @ LUMINANCE)
        return np.mean([light[cloud & band].mean() - light[clear & band].mean() for band in bands])

    alone, all_the_way = (over_the_sky(DUSK.replace(cloud_strength=x)) for x in (0, 1))
    assert all_the_way < -0.3  # the model's clouds of dusk are darker than the sky
    assert 0.2 < over_the_sky(DUSK) < alone - 0.3  # these stay brighter, as in the photo


def test_a_gray_evening_turns_blue_by_day_but_a_blue_sky_no_bluer():
    gray = known_photo(sun=(8.0, 4.0), tint=(2.0, 1.0, 0.5), clouds=False, size=(240, 160))
    blue = known_photo(sun=(8.0, 4.0), tint=(0.4, 1.0, 3.0), clouds=False, size=(240, 160))
    colors = []
    for photo in (gray, blue):
        scene = photo.analyze()
        sky = photo.sky > 0
        colors.append(
            [
                balance(rendered(scene, edit)[sky])[0]
                for edit in (HIGH, HIGH.replace(sun_elevation=11))
            ]
        )
    (gray_high, gray_low), (blue_high, blue_low) = colors
    assert gray_low > -0.1
    assert gray_high < -0.5
    assert abs(blue_high - blue_low) < 0.1


def test_gray_clouds_turn_less_blue_by_day_unless_an_evening_colors_the_sky():
    for tint, apart in (((0.75, 1.0, 1.4), 0.45), ((2.0, 1.0, 0.5), 0.0)):
        photo = known_photo(sun=(8.0, 4.0), tint=tint, clouds=False, size=(240, 160))
        scene = photo.analyze()
        clear, cloudy = (
            balance(rendered(dataclasses.replace(scene, cloud_map=map_), HIGH)[photo.sky > 0])[0]
            for map_ in (np.zeros_like(scene.cloud_map), np.ones_like(scene.cloud_map))
        )
        assert cloudy - clear == pytest.approx(apart, abs=0.1)


def test_what_is_brighter_in_an_evenings_sky_is_white_cloud_by_day():
    photo = known_photo(sun=(8.0, 4.0), tint=(2.0, 1.0, 0.5), clouds=False, size=(240, 160))
    streak = np.zeros((160, 240), np.float32)
    streak[30:36, 40:200] = 1
    linear = np.clip(photo.linear * (1 + 0.8 * streak[..., None]), 0, 1)
    scene = dataclasses.replace(photo, linear=linear).analyze()
    day = rendered(scene, HIGH)
    inside, beside = day[31:35, 60:180], day[20:26, 60:180]
    assert balance(inside)[0] > balance(beside)[0] + 0.4
    assert balance(beside)[0] < -0.5


def test_dusk_is_orange_below_and_blue_above_towards_the_sun_only():
    photo = known_photo(sun=(8.0, 14.0), clouds=False, size=(240, 160))
    scene = photo.analyze()
    columns, rows = np.meshgrid(np.arange(240) + 0.5, np.arange(160) + 0.5)
    height = scene.camera.angles(columns, rows)[1]
    low, high = ((photo.sky > 0) & (height > a) & (height < b) for a, b in ((1, 6), (20, 90)))
    dusk = rendered(scene, DUSK)
    (red_low, _), (red_high, green_high) = balance(dusk[low]), balance(dusk[high])
    assert 1 < red_low < 2.2
    assert red_high < -0.6
    assert -0.3 < green_high < -0.1
    light = dusk @ np.array([0.2126, 0.7152, 0.0722])
    assert 0.6 < np.log2(light[low].mean() / light[high].mean()) < 1.6
    behind = rendered(scene, DUSK.replace(sun_azimuth=-172))
    assert balance(behind[low])[0] < -1
    assert abs(balance(behind[low])[1]) < 0.15


def test_land_at_dusk_is_darker_towards_the_sun_and_less_blue_on_all_sides():
    photo = known_photo(sun=(8.0, 14.0), clouds=False, size=(240, 160))
    scene = photo.analyze()
    land = photo.sky == 0
    towards, away = (rendered(scene, DUSK.replace(sun_azimuth=az)) for az in (8, -172))
    for frame in (towards, away):
        assert balance(frame[land])[0] > -0.6
    level = [np.log2(frame[land].mean() / frame[photo.sky > 0].mean()) for frame in (towards, away)]
    assert level[0] < level[1] - 1.6


def test_blue_far_land_is_hardly_blue_when_its_light_has_changed_and_stays_as_long_as_it_has_not():
    photo = known_photo(sun=(8.0, 30.0), clouds=False, size=(240, 160))
    picture = photo.linear.copy()
    land = photo.sky == 0
    picture[land] *= (0.5, 1.0, 6.0)
    scene = photo.analyze(np.uint8(255 * np.clip(picture, 0, 1) ** (1 / 2.2)))

    def blueness(edit):
        red, green, blue = rendered(scene, edit)[land].mean(0)
        return np.log2(blue / max(red, green))

    assert blueness(Edit()) > 1.8
    assert blueness(DUSK) < 1.7
    assert blueness(Edit(sun_azimuth=8, sun_elevation=28)) > 1.7


def test_a_clouds_shade_has_the_skys_colour():
    photo = known_photo(sun=(8.0, 40.0), size=(240, 160))
    picture = photo.linear.copy()
    cloud = photo.opacity > 0.85
    left = cloud & (np.arange(240) < 120)
    picture[left] *= 0.35
    scene = photo.analyze(np.uint8(255 * picture ** (1 / 2.2)))
    frame = rendered(scene, LOW)
    assert balance(frame[left])[0] < balance(frame[cloud & ~left])[0] + 0.15


def test_a_picture_without_sky_changes_as_one_by_day():
    photo = known_photo()
    scene = photo.analyze(sky=np.zeros_like(photo.sky), sun=None)
    land = photo.sky == 0
    before = rendered(scene, Edit())
    day, dusk = (np.log2(rendered(scene, edit)[land] / before[land]) for edit in (HIGH, DUSK))
    assert (day.std(0) < 0.05).all()
    assert np.abs(day.mean(0)).max() > 0.2
    assert dusk.std(0).max() > 0.1


def test_land_that_darkens_does_not_drown_in_black():
    scene = known_scene()
    land = (scene.sky < 0.02) & (render(scene)[..., :3].max(-1) > 15)
    assert render(scene, Edit(sun_elevation=-4, exposure=-4))[..., :3].max(-1)[land].min() >= 8


def test_dusk_without_a_sky_is_dark():
    photo = known_photo()
    scene = photo.analyze(sky=np.zeros_like(photo.sky), sun=None)
    before = rendered(scene, Edit()).mean()
    assert 0.15 < rendered(scene, DUSK).mean() / before < 0.6
    assert rendered(scene, Edit(sun_elevation=8)).mean() / before > 0.6


def test_an_evening_without_a_sky_is_darker_and_has_contrast_and_warmth_where_it_is_bright():
    photo = known_photo(noise=0)
    random = np.random.default_rng(4)
    shade = np.exp2(random.uniform(-1, 1, photo.linear.shape[:2])).astype(np.float32)
    scene = dataclasses.replace(photo, linear=0.1 * shade[..., None] * np.ones(3, np.float32))
    scene = scene.analyze(sky=np.zeros_like(photo.sky), sun=photo.camera.pixel(60, 40))
    before, now = rendered(scene, Edit()), rendered(scene, LOW)
    change = np.log2(now / before)
    assert -0.6 < np.median(change @ LUMINANCE) < -0.05
    warmth = change[..., 0] - change[..., 2]
    dark, bright = shade < 0.6, shade > 1.6
    assert (change @ LUMINANCE)[bright].mean() > (change @ LUMINANCE)[dark].mean() + 0.3
    assert warmth[dark].mean() > 0.2
    assert warmth[bright].mean() > warmth[dark].mean() + 0.15


def test_an_evening_without_a_sky_darkens_without_a_bright_moment():
    photo = known_photo()
    scene = photo.analyze(sky=np.zeros_like(photo.sky), sun=photo.camera.pixel(60, 40))
    heights = (12, 8, 5, 3, 2, 1, 0, -1, -2, -3, -4, -6)
    light = [rendered(scene, Edit(sun_azimuth=8, sun_elevation=h)).mean() for h in heights]
    assert np.diff(np.log2(light)).max() < 0.03
