"""The sky behind the old sun as the frame reads it: photo without sun over model, mark, dither."""

import dataclasses

import numpy as np
import pytest
from relight_scenes import exact_fit, known_photo

import sunwidget as sw
from sunwidget.analysis.backdrop.backdrop import (
    LONG_SIDE,
    behind_sun,
    matched_sky,
    to_code,
    to_light,
)
from sunwidget.analysis.backdrop.erase import erase_nothing
from sunwidget.analysis.images.working_copy import Working
from sunwidget.edit.table import Edit
from sunwidget.photo.photo import open_photo
from sunwidget.renderer import render, render_pass


def behind(photo, mark=None):
    working = Working.of(open_photo(photo.bytes))
    erased = erase_nothing(working) if mark is None else erase_nothing(working)._replace(mark=mark)
    return behind_sun(working, erased, photo.sky, photo.camera, exact_fit(photo))


def log_of(photo, backdrop):
    light = np.maximum(to_light(backdrop.field), 1e-6)
    return np.log(light / matched_sky(exact_fit(photo), photo.camera, light.shape[1::-1]))


def test_without_a_visible_sun_nothing_is_replaced():
    backdrop = behind(known_photo(clouds=False))
    assert backdrop.glare.max() == 0
    assert max(backdrop.field.shape) <= LONG_SIDE


def test_the_sky_behind_is_the_photos_own():
    photo = known_photo(clouds=False)
    x, y = photo.camera.pixel(*photo.sun)
    rows, columns = np.mgrid[:80, :120]
    sky = (photo.sky > 0) & (rows < 40) & (np.hypot(columns - x, rows - y) > 12)
    # Drawn with this model: photo over model is one, but for noise and encoding.
    log = log_of(photo, behind(photo))
    assert np.abs(log[sky]).max() < 0.25
    assert np.abs(log[sky].mean(0)).max() < 0.06


def test_what_was_found_behind_the_sun_counts_although_it_is_bright():
    photo = known_photo(clouds=False)
    bright = photo.bytes.copy()
    bright[10:20, 10:30] = 255  # clipped: not believed
    white = Working.of(open_photo(bright))
    fit = exact_fit(photo)
    plain = behind_sun(white, erase_nothing(white), photo.sky, photo.camera, fit)
    mark = np.zeros(bright.shape[:2], np.float32)
    mark[8:22, 8:32] = 1
    erased = erase_nothing(white)._replace(mark=mark)
    found = behind_sun(white, erased, photo.sky, photo.camera, fit)
    assert found.field[15, 20].mean() > plain.field[15, 20].mean() + 0.02
    assert found.glare[15, 20] == pytest.approx(1)


def test_beside_the_glare_the_photos_own_light_counts():
    photo = known_photo(clouds=False)
    working = Working.of(open_photo(photo.bytes))
    rows, columns = np.mgrid[: working.height, : working.width]
    x, y = photo.camera.pixel(*photo.sun)
    away = np.hypot(columns - x, rows - y)
    hidden = np.clip((20 - away) / 5, 0, 1).astype(np.float32)
    # What was erased is darker by a tenth up to where the glare ends.
    darker = (working.linear * np.where(away < 20, 0.9, 1)[..., None]).astype(np.float32)
    erased = erase_nothing(dataclasses.replace(working, linear=darker))
    erased = erased._replace(mark=hidden, hidden=hidden)
    field = behind_sun(working, erased, photo.sky, photo.camera, exact_fit(photo))
    ring = (away > 17) & (away < 21) & (photo.sky > 0) & (rows < 40)
    assert abs(np.median(log_of(photo, field)[ring])) < 0.05


def test_dither_is_the_same_each_time_and_half_a_level_wide():
    photo = known_photo(clouds=False)
    first, second = behind(photo), behind(photo)
    assert np.array_equal(first.field, second.field)
    assert np.array_equal(first.glare, second.glare)
    # Encoded in eight bits, a slow field keeps its mean between the levels.
    levels = np.round(first.field[5:25, 5:25] * 255)
    assert np.unique(levels[..., 1]).size > 1


def test_the_field_is_small_and_in_range():
    photo = known_photo(size=(300, 60), clouds=False)
    backdrop = behind(photo)
    assert max(backdrop.field.shape) == LONG_SIDE
    assert backdrop.field.shape[:2] == backdrop.glare.shape
    assert backdrop.field.min() >= 0
    assert backdrop.field.max() <= 1


def test_the_matched_sky_has_the_size_asked_for():
    photo = known_photo(clouds=False)
    assert matched_sky(exact_fit(photo), photo.camera, (60, 40)).shape == (40, 60, 3)


def with_light(scene, factor):
    """Return the scene with another light in its backdrop."""
    code = to_code(to_light(scene.backdrop) * factor)
    return dataclasses.replace(scene, backdrop=code.astype(np.float32))


def test_light_brighter_than_white_survives_its_code():
    light = np.array([0, 0.01, 0.5, 1, 4.5, 15], np.float32)
    code = np.round(to_code(light) * 255) / 255
    assert to_light(code) == pytest.approx(light, rel=0.03, abs=1e-3)  # of eight bits
    assert to_code(np.float32([-1, 99])) == pytest.approx([0, 1])


def test_what_the_sky_is_brighter_than_the_model_is_told_and_leaves_with_its_light():
    scene = known_photo(clouds=False).analyze()
    half = np.arange(scene.backdrop.shape[1]) > scene.backdrop.shape[1] // 2
    other = with_light(scene, np.where(half, 0.58, 1.0)[None, :, None])
    own, lost = (render_pass(one, Edit(), "own_sky")[:28, :, 0] for one in (scene, other))
    assert np.abs(own).max() < 0.1
    assert np.abs(lost - own)[:, :24].max() < 0.01
    assert -0.7 < (lost - own)[:, 44:].mean() < -0.4  # log 0.58
    # The less the backdrop has the more is given back, where the model's light changes.
    moved = Edit(sun_elevation=-4, cloud_strength=0)  # the photo itself has not become darker
    gained = render(other, moved, dtype="float32") / render(scene, moved, dtype="float32")
    assert gained[2:20, 90:].mean() > 1.2
    assert np.array_equal(render(other), render(scene))


def test_a_glow_round_the_photos_sun_leaves_with_it():
    scene = known_photo(clouds=False).analyze()
    x, y = scene.camera.pixel(*known_photo().sun)
    rows, columns = np.mgrid[: scene.backdrop.shape[0], : scene.backdrop.shape[1]]
    zoom = scene.backdrop.shape[1] / scene.photo.width
    near = np.exp(
        -np.square(np.hypot(columns - x * zoom, rows - y * zoom) / (0.16 * rows.shape[1]))
    )
    other = with_light(scene, 1 + 1.5 * near[..., None])
    one, more = (render_pass(s, Edit(), "own_sky")[:28, :, 1] for s in (scene, other))
    column = round(64 * x / scene.photo.width)
    assert (more - one)[:, column].max() > 0.1
    assert np.abs(more - one)[:, [0, 63]].max() < 0.05
    away, close = Edit(sun_azimuth=90, sun_elevation=35), Edit(sun_azimuth=known_photo().sun[0] + 1)
    dimmed = [
        np.log(render(other, edit, dtype="float32") / render(scene, edit, dtype="float32")).min()
        for edit in (away, close)
    ]
    assert dimmed[0] < -0.1
    assert dimmed[1] > dimmed[0] / 2


def contrast(one, other, edit):
    """Log of the brightened and of the darkened bar over the scene without bars."""
    ratio = np.log(render(other, edit, dtype="float32") / render(one, edit, dtype="float32"))
    return ratio[11:13, 30:50].mean(), ratio[19:21, 30:50].mean()


# Under a fixed exposure dusk is so dark that the model stands in for the photo.
@pytest.mark.parametrize("auto_exposure", [0, 0.9])
def test_a_bright_rim_and_a_dark_one_fade_as_the_light_goes(auto_exposure):
    photo = known_photo(clouds=False)
    scene, rims = photo.analyze(), photo.bytes.copy()
    rims[10:14, 20:60] = np.clip(rims[10:14, 20:60] * 1.25, 0, 250).astype(rims.dtype)
    rims[18:22, 20:60] = (rims[18:22, 20:60] * 0.8).astype(rims.dtype)
    other = dataclasses.replace(scene, photo=open_photo(rims))
    before = contrast(scene, other, Edit())
    dusk = contrast(scene, other, Edit(sun_elevation=-4, auto_exposure=auto_exposure))
    assert 0 < dusk[0] < 0.7 * before[0]
    assert before[1] < dusk[1] < 0


def test_land_that_loses_no_light_with_the_glare_keeps_its_colour():
    photo = known_photo(clouds=False)
    roof = photo.bytes.copy()
    roof[60:75, 40:80] = (60, 20, 15)
    scene = dataclasses.replace(photo.analyze(), photo=open_photo(roof))
    mark = scene.glare.copy()
    mark[round(0.6 * len(mark)) :] = 0.9
    marked = dataclasses.replace(scene, glare=mark)
    edit = Edit(sun_azimuth=photo.sun[0] + 12)
    with_mark, without = (render(s, edit, dtype="float32")[62:72, 45:75] for s in (marked, scene))
    assert (with_mark <= 1.1 * without + 1e-3).all()


def with_a_hidden_sun(code):
    """A scene whose sun is assumed in the middle of its sky."""
    code = code.copy()
    code[160:] = 0.12
    picture = np.round(255 * code).astype(np.uint8)
    scene = sw.analyze(picture)
    assert scene.sun is None
    sun = scene.camera.angles(160, 99)
    fit = dataclasses.replace(scene.fitted, sun=sun, sun_spread=8.0)
    return picture, dataclasses.replace(scene, assumed_sun=sun, fitted=fit)


def test_clouds_stay_bright_where_a_sun_was_behind_them():
    columns = np.arange(320)
    light = 0.6 + 0.1 * np.exp(-(((columns - 160) / 90) ** 2))
    scene = with_a_hidden_sun(np.broadcast_to(light[None, :, None], (220, 320, 3)))[1]
    hazy = scene.atmosphere.replace(aerosol_optical_depth=0.3, aerosol_asymmetry=0.9)
    overcast = dataclasses.replace(scene, cloud_map=np.ones_like(scene.cloud_map), atmosphere=hazy)
    day = sw.render(overcast, sw.Edit(sun_azimuth=100, sun_elevation=35))[..., :3].astype(float)
    assert day[90:110, 150:170].mean() > 0.95 * day[90:110, 20:60].mean()


def test_a_sky_without_a_glow_does_not_darken_where_its_sun_was_assumed():
    code = np.linspace((0.35, 0.5, 0.72), (0.6, 0.7, 0.8), 220)[:, None].repeat(320, 1)
    picture, scene = with_a_hidden_sun(code)
    azimuth, elevation = scene.assumed_sun
    for away in (12, 16, 20, 30):
        edit = sw.Edit(sun_azimuth=azimuth + away, sun_elevation=elevation)
        level = sw.render(scene, edit)[90:110, 155:165, :3].mean()
        assert level > picture[90:110, 155:165].mean() - 1, away
