"""Light on the land: slope, shadows, gleam, clouds' shadows, and the air before it."""

import dataclasses
import functools

import cv2
import numpy as np
import pytest
from relight_scenes import known_photo

from sunwidget.analysis import frame_inputs
from sunwidget.analysis.networks.land import sun_basis
from sunwidget.edit.table import Edit
from sunwidget.formats.color import srgb_to_linear
from sunwidget.geometry.camera import Camera
from sunwidget.renderer import render, render_pass

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
SIZE = (240, 160)
EFFECTS = ("shading", "gloss", "cast_shadows", "cloud_shadows", "aerial_perspective")
HIGH = 1.6  # metres of the camera over the plain
WALL = 20.0  # metres to the wall
RIDGE = 5000.0


@functools.cache
def street():
    """A plain with a wall across its right half, its depth told: the sun stands ahead."""
    known = known_photo(size=SIZE, clouds=False)
    camera: Camera = known.camera
    width, height = SIZE
    rows, columns = np.mgrid[:height, :width] + 0.5
    x, y = (columns - width / 2) / camera.focal, (rows - height / 2) / camera.focal
    fall = -(x * camera.up[0] + y * camera.up[1] + camera.up[2])
    plain = np.where(fall > 1e-4, HIGH / np.maximum(fall, 1e-4), np.inf)
    wall = (x > 0.05) & (-WALL * fall < 4.0)
    ridge = fall > -0.05  # hills along the horizon
    depth = np.where(wall & (plain > WALL), WALL, np.minimum(plain, RIDGE))
    sky = np.where(~ridge & ~wall, 1.0, 0.0).astype(np.float32)
    depth = np.where(sky > 0, np.inf, depth).astype(np.float32)
    # Dry, dull ground of one colour: nothing glitters, nothing is water.
    picture = np.where(sky[..., None] > 0, known.bytes, np.uint8((90, 84, 70)))
    scene = known.analyze(picture, sky=sky, depth=depth, water="none")
    return scene, depth


def maps(edit, name):
    return render_pass(street()[0], edit, name)


def places(test):
    """(h, w) bool at the size of the land's maps from a test of depth, row share, column share."""
    depth = street()[1][2::4, 2::4]
    rows, columns = np.mgrid[: depth.shape[0], : depth.shape[1]]
    return test(depth, (rows + 0.5) / depth.shape[0], (columns + 0.5) / depth.shape[1])


def test_normals_of_a_plain_and_of_a_wall():
    scene, depth = street()
    slope = 2 * scene.relief[..., :2] - 1
    rows, columns = ((np.arange(n) + 0.5) / n for n in depth.shape)
    y, x = np.meshgrid(rows, columns, indexing="ij")
    ground = (depth < 12) & (y < 0.95) & (x > 0.05) & (x < 0.95)
    wall = (depth == WALL) & (x > 0.65) & (x < 0.95) & (y < 0.68) & (y > 0.6)
    assert ground.sum() > 500
    assert wall.sum() > 50
    camera = scene.camera
    assert np.median(slope[ground], 0) == pytest.approx((camera.up[0], -camera.up[1]), abs=0.05)
    assert np.median(slope[wall], 0) == pytest.approx((0, 0), abs=0.15)


def test_the_light_of_any_sun_on_a_told_plain_and_wall_is_the_cosine_in_both_languages():
    scene, depth = street()
    height, width = depth.shape
    transfer = cv2.resize(scene.land.transfer, (width, height))
    wall = (
        (depth == WALL)
        & (np.mgrid[:width] > 0.7 * width)
        & (np.mgrid[:height] < 0.65 * height)[:, None]
    )
    for azimuth, elevation in ((0, 60), (150, 20), (-90, 5)):
        a, e = np.radians((azimuth, elevation))
        sun = np.array([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)])
        light = np.clip(transfer @ sun_basis(sun), 0, 1)
        assert np.median(light[depth < 8]) == pytest.approx(sun[1], abs=0.06)
        assert np.median(light[wall]) == pytest.approx(max(-sun[2], 0), abs=0.12)
        edit = Edit(sun_azimuth=azimuth, sun_elevation=elevation)
        past_land, _, drawn, _ = np.moveaxis(maps(edit, "shadow_edit"), -1, 0)
        expected = cv2.resize(light, drawn.shape[::-1])
        near = places(lambda z, y, x: z < 12)
        assert np.abs(drawn - expected * past_land)[near].max() < 0.04
    assert np.median(maps(Edit(), "shadow_edit")[..., 3][near]) == pytest.approx(1, abs=0.1)


def test_the_wall_shades_the_plain_on_its_side_of_the_sun_and_no_other():
    # Low and to the right, behind the wall as seen from the right of the plain; then to the left.
    right = maps(Edit(sun_azimuth=12, sun_elevation=5), "shadow_edit")[..., 0]
    left = maps(Edit(sun_azimuth=-14, sun_elevation=5), "shadow_edit")[..., 0]
    assert right[behind_the_wall()].mean() < 0.3
    assert left[in_the_open()].mean() > 0.9
    high = maps(Edit(sun_azimuth=12, sun_elevation=60), "shadow_edit")[..., 0]
    assert high[behind_the_wall()].mean() > 0.9


def test_land_that_leaves_the_old_shadow_brightens_and_loses_its_blue():
    # The photo's own sun, at 14 degrees, stands behind the wall.
    moved = Edit(sun_azimuth=12, sun_elevation=60, gloss=0)
    cast, even = (
        maps(moved.replace(cast_shadows=value), "land_shade")[behind_the_wall()][:, :3].mean(0)
        for value in (1, 0)
    )
    assert cast @ LUMINANCE > 1.2 * (even @ LUMINANCE)
    assert cast[2] / cast[0] < even[2] / even[0]


def behind_the_wall():
    return places(lambda z, y, x: (z < 15) & (z > 6) & (x > 0.7) & (x < 0.9))


def in_the_open():
    return places(lambda z, y, x: (z < 15) & (z > 6) & (x < 0.2))


def test_a_slope_towards_the_sun_gains_by_shading():
    # A sun behind the camera lights the wall; without shading what is below the horizon lies,
    # but for a little just below it (GetUprightness, land/land.glsl).
    moved = Edit(sun_azimuth=175, sun_elevation=10, gloss=0, cast_shadows=0)
    wall = places(lambda z, y, x: (z == WALL) & (x > 0.65) & (x < 0.95) & (y > 0.68))
    assert wall.any()
    slanted = (maps(moved, "land_shade")[wall][:, :3] @ LUMINANCE).mean()
    lying = (maps(moved.replace(shading=0), "land_shade")[wall][:, :3] @ LUMINANCE).mean()
    assert slanted > 1.1 * lying


def test_ground_gleams_below_the_sun():
    moved = Edit(sun_azimuth=-18, sun_elevation=6, cast_shadows=0)
    row = maps(moved, "land_shade")[-8, :, :3] @ LUMINANCE
    left, right = row[:8].mean(), row[-8:].mean()
    dull = maps(moved.replace(gloss=0), "land_shade")[-8, :, :3] @ LUMINANCE
    assert left > 1.2 * right
    assert dull[:8].mean() < 1.1 * dull[-8:].mean()


@pytest.mark.parametrize("name", EFFECTS)
def test_an_unmoved_sun_changes_nothing_at_any_strength(name):
    scene, _ = street()
    expected = render(scene, dtype="float32")
    for value in (0, 0.5, 1):
        assert np.array_equal(render(scene, Edit(**{name: value}), dtype="float32"), expected)


@pytest.mark.parametrize("name", ["shading", "gloss", "cast_shadows", "aerial_perspective"])
def test_each_effect_shows_in_a_moved_picture(name):
    scene, _ = street()
    moved = Edit(sun_azimuth=12, sun_elevation=5)
    off, on = (render(scene, moved.replace(**{name: value})).astype(int) for value in (0, 1))
    assert np.abs(off - on).max() >= 3


def foggy(share):
    """The picture of a photo whose air has these shares of the land's light, by the moved sun."""
    photo = known_photo(size=SIZE, clouds=False)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(frame_inputs, "air_share", lambda *_: share * np.ones_like(photo.sky))

        def frame(**edit):
            return render(photo.analyze(), Edit(**edit), dtype="float32")

        unmoved, low, dusk = (frame(sun_elevation=e) for e in (14, 2, -6))
        return unmoved, low, dusk, frame(sun_elevation=2, aerial_perspective=0)


def test_air_before_land_reddens_with_the_sky_by_its_share_and_by_day_alone():
    land = known_photo(size=SIZE, clouds=False).sky < 0.01
    clear, half, fog = (foggy(share) for share in (0.0, 0.5, 1.0))
    red = [np.log2(p[1][land].mean(0)[0] / p[1][land].mean(0)[2]) for p in (clear, half, fog)]
    assert red[0] < red[1] - 0.1 < red[2] - 0.2
    for unmoved, _, dusk, without in (half, fog):
        assert np.array_equal(unmoved, clear[0])
        assert np.abs(dusk - clear[2])[land].max() < 0.004
        assert np.array_equal(without, clear[3])


def test_water_mirrors_the_sky_whatever_air_is_before_it():
    photo = known_photo(size=SIZE, clouds=False)
    frames = []
    for share in (0.0, 1.0):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(
                frame_inputs, "air_share", lambda *_, s=share: s * np.ones_like(photo.sky)
            )
            scene = photo.analyze(water=np.where(photo.sky > 0, 0, 255).astype(np.uint8))
            frames.append(render(scene, Edit(sun_elevation=3), dtype="float32"))
    inside = scene.water > 0.99
    assert inside.any()
    assert np.abs(frames[1] - frames[0])[inside].max() < 0.004


def test_more_haze_veils_distant_land_and_never_darkens_below_zero():
    scene, depth = street()
    land = scene.sky < 0.01
    for optical_depth in (0, 0.1, 0.3, 0.6):
        light = render(scene, Edit(aerosol_optical_depth=optical_depth), dtype="float32")
        assert light[land].min() >= 0
    hazy, clear = (
        render(scene, Edit(aerosol_optical_depth=t, auto_exposure=0), dtype="float32") @ LUMINANCE
        for t in (0.5, 0.02)
    )
    near, far = depth < 10, (depth == RIDGE) & land
    assert (hazy[far] / clear[far]).mean() > (hazy[near] / clear[near]).mean()


def test_dark_land_that_a_new_sun_lights_loses_its_red_and_exposure_leaves_it():
    known = known_photo(sun=(8.0, 1.5), size=SIZE, clouds=False)
    land = known.sky < 0.01
    scene = known.analyze(np.where(land[..., None], np.uint8((24, 7, 5)), known.bytes))

    def redness(picture):
        light = picture[land].mean(0)
        return np.log(light[0] / light[1])

    seen = redness(scene.photo.light())
    behind = render(scene, Edit(sun_azimuth=170, sun_elevation=35), dtype="float32")
    assert redness(behind) < 0.7 * seen
    assert redness(render(scene, Edit(exposure=2), dtype="float32")) > 0.95 * seen


def test_colour_loss_by_luminance_and_by_power_keep_the_luminance_alike():
    scene, _ = street()
    land = scene.sky < 0.01
    # A sun that is gone: the land has lost its direct light.
    gone = Edit(sun_visibility=0, colourfulness=1, auto_exposure=0)
    pictures = {
        name: render(scene, gone.replace(colour_loss=name), dtype="float32")[land].mean(0)
        for name in ("luminance", "power")
    }
    kept = render(scene, gone.replace(colourfulness=0), dtype="float32")[land].mean(0)
    spread = {name: np.ptp(p) / p.mean() for name, p in pictures.items()}
    assert spread["luminance"] < np.ptp(kept) / kept.mean()
    assert spread["power"] < np.ptp(kept) / kept.mean()
    assert pictures["luminance"] @ LUMINANCE == pytest.approx(kept @ LUMINANCE, rel=0.02)


def test_land_that_glowed_before_a_low_sun_is_not_burnt_by_day():
    known = known_photo(sun=(8.0, 2.0), clouds=False)
    picture, land = known.bytes.copy(), known.sky < 0.5
    picture[land] = 220
    noon = Edit(sun_azimuth=70, sun_elevation=35, auto_exposure=0, glow=0, aerial_perspective=0)
    day = render(known.analyze(picture), noon, dtype="float32")[land]
    assert 0.8 < day.mean() < 0.95
    assert day.max() < 0.99


def test_orange_land_keeps_more_of_its_color_by_day_where_the_evenings_sun_is_only_assumed():
    known = known_photo(sun=(8.0, 3.0), clouds=False, size=SIZE)
    picture, land = known.bytes.copy(), known.sky < 0.5
    picture[land] = (200, 110, 40)
    noon = Edit(sun_azimuth=70, sun_elevation=35)
    red = {}
    for told in (True, False):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(frame_inputs, "_sun_known", lambda _, told=told: told)
            frame = render(known.analyze(picture), noon, dtype="float32")[land]
        red[told] = np.log2(frame[:, 0].mean() / frame[:, 2].mean())
    assert red[False] > red[True] + 0.3
    own = np.log2(srgb_to_linear(200 / 255) / srgb_to_linear(40 / 255))
    assert red[False] < own - 0.3  # the light was red, too


def test_places_differ_half_as_much_where_the_sun_is_only_assumed_but_lose_it_at_dusk():
    scene = street()[0]
    spread = {}
    for known in (True, False):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(frame_inputs, "_sun_known", lambda _, known=known: known)
            for elevation in (30, -5):
                moved = Edit(sun_azimuth=80, sun_elevation=elevation)
                ratio = render_pass(dataclasses.replace(scene), moved, "land_sunshine")[..., 1]
                spread[elevation, known] = ratio.std()
    assert spread[30, False] == pytest.approx(0.5 * spread[30, True], rel=1e-3)
    assert spread[-5, False] == pytest.approx(spread[-5, True], rel=1e-3)


def test_no_dark_line_is_left_along_bright_land_before_the_old_sun():
    photo = known_photo(sun=(8.0, 3.0), clouds=False, size=(240, 160))
    picture = photo.linear.copy()
    picture[photo.sky == 0] = (0.6, 0.45, 0.3)
    matte = cv2.GaussianBlur((photo.sky > 0).astype(np.float32), (0, 0), 1.2)
    code = np.uint8(np.clip(255 * picture ** (1 / 2.2), 0, 255))
    scene = photo.analyze(code, sky=np.uint8(np.round(255 * matte)))
    noon = Edit(sun_azimuth=70, sun_elevation=35, aerial_perspective=0)
    frame = render(scene, noon, dtype="float32") @ LUMINANCE
    column = round(photo.camera.pixel(*photo.sun)[0])
    skyline = int(np.argmax(photo.sky[:, column] == 0))
    near = frame[skyline - 6 : skyline + 7, column - 5 : column + 5]
    assert (near.min(0) > 0.9 * np.minimum(near[0], near[-1])).all()
