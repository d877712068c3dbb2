"""Glow, light shafts and lens flare: now minus before, exactly off at 0, where light goes."""

import dataclasses
import itertools

import numpy as np
import pytest
from relight_scenes import known_photo, known_scene, sample_scene

from sunwidget.edit.table import Edit
from sunwidget.renderer import render, render_pass

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
ALONE = {
    "glow": {"light_shafts": 0.0, "lens_flare": 0.0},
    "light_shafts": {"glow": 0.0, "lens_flare": 0.0},
    "lens_flare": {"glow": 0.0, "light_shafts": 0.0},
}
OFF = {"glow": 0.0, "light_shafts": 0.0, "lens_flare": 0.0}
LOW = Edit(sun_azimuth=-6, sun_elevation=7, light_shafts=1)


def veil(scene, edit):
    return render_pass(scene, edit, "veil")


def angles(scene, shape):
    """Azimuth and elevation of the texels of a pass."""
    rows, columns = np.mgrid[: shape[0], : shape[1]] + 0.5
    return scene.camera.angles(
        columns / shape[1] * scene.camera.width, rows / shape[0] * scene.camera.height
    )


def with_pillar(scene, columns):
    """The scene with land that rises to the top in some columns."""
    sky = scene.sky.copy()
    sky[:, columns] = 0
    return dataclasses.replace(scene, sky=sky, cloud_map=scene.clouds * sky)


@pytest.mark.parametrize("name", ["known", "coast"])
def test_an_unmoved_sun_has_no_veil_at_any_strength(name):
    scene = known_scene() if name == "known" else sample_scene(name)
    most = Edit(glow=3, light_shafts=1, lens_flare=1)
    assert not veil(scene, most)[..., :3].any()
    assert np.array_equal(render(scene, most), scene.photo.encoded)


@pytest.mark.parametrize("name", sorted(ALONE))
def test_each_is_exactly_off_at_zero_and_shows_when_it_is_on(name):
    scene = known_scene()
    edit = LOW.replace(aerosol_optical_depth=0.3, **{**OFF, name: 0.0})
    assert not veil(scene, edit)[..., :3].any()
    assert not render_pass(scene, edit, "composite_constants")[0, 13, :3].any()
    shown = edit.replace(**{name: 1.0})
    assert name == "glow" or np.abs(veil(scene, shown)[..., :3]).max() > 1e-3
    assert np.abs(render(scene, shown).astype(int) - render(scene, edit)).max() >= 1


def glow_of(scene, edit, strength=0.05):
    """What a little glow adds to the picture, display-linear, with a camera that is not known."""
    fit = dataclasses.replace(scene.fitted, glare=(0.0, 3.0, 1.3))
    scene = dataclasses.replace(scene, fitted=fit)
    some, none = (
        render(scene, edit.replace(glow=g, light_shafts=0), dtype="float32") for g in (strength, 0)
    )
    return some - none


def test_glow_falls_off_as_glare_does_and_has_the_suns_colour():
    scene = known_photo(clouds=False).analyze()
    light = glow_of(scene, LOW)
    azimuth, elevation = angles(scene, light.shape[:2])
    near = np.hypot(azimuth + 6, elevation - 7)
    old = np.hypot(azimuth - 8, elevation - 14)
    # From beyond the disc, which is as large as the photo's own.
    rings = [light[(near >= a) & (near < a + 2) & (old > 12)].mean(0) for a in (2.5, 5, 9)]
    level = [float(ring @ LUMINANCE) for ring in rings]
    assert level[0] > 1.5 * level[1] > 3 * level[2] > 0
    red, _, blue = render_pass(scene, LOW, "composite_constants")[0, 13, :3]
    assert red > 1.2 * blue


def test_glow_leaves_with_the_sun_that_is_hidden():
    open_scene = known_photo(clouds=False).analyze()
    hidden = with_pillar(open_scene, slice(20, 50))
    edit = LOW.replace(sun_azimuth=-8)
    lit, shaded = (glow_of(s, edit) @ LUMINANCE for s in (open_scene, hidden))
    assert lit.max() > 1e-3
    assert shaded.max() <= 1e-6


def test_glow_lies_before_land_and_sky_and_less_before_the_land():
    scene = known_photo(clouds=False).analyze()
    light = glow_of(scene, Edit(sun_azimuth=-6, sun_elevation=1.5))
    azimuth, elevation = angles(scene, light.shape[:2])
    ring = (np.hypot(azimuth + 6, elevation - 1.5) > 4) & (
        np.hypot(azimuth + 6, elevation - 1.5) < 7
    )
    sky, land = (
        float((light[ring & where] @ LUMINANCE).mean())
        for where in (scene.sky == 1, scene.sky == 0)
    )
    assert sky > land > 0


def test_clear_air_shows_no_shafts_and_haze_does():
    scene = known_scene()
    reach = [
        np.abs(
            render_pass(scene, LOW.replace(aerosol_optical_depth=a), "shafts_edit")[..., 0]
        ).max()
        for a in (0.0, 0.02, 0.1, 0.4)
    ]
    assert reach[0] == 0
    assert reach == sorted(reach)
    assert reach[3] > 3 * reach[1]


def test_a_pillar_throws_a_shadow_into_the_haze_and_the_gap_beside_it_a_beam():
    scene = with_pillar(known_photo(clouds=False).analyze(), slice(52, 62))
    edit = LOW.replace(sun_azimuth=-10, sun_elevation=9, aerosol_optical_depth=0.4)
    shafts = render_pass(scene, edit, "shafts_edit")[..., 0]
    azimuth, elevation = angles(scene, shafts.shape)
    far = (azimuth > 8) & (elevation > 0)
    behind = far & (np.abs(elevation - 9) < 3)
    above = far & (elevation > 16)
    assert shafts[behind].mean() < 0
    assert shafts[behind].mean() < shafts[above].mean()


def test_the_photos_own_shadows_in_the_haze_stay_and_new_ones_come_with_the_move():
    scene = with_pillar(known_photo(clouds=False).analyze(), slice(52, 62))
    away = Edit(sun_azimuth=180, sun_elevation=40, lens_flare=0)
    assert not veil(scene, away.replace(light_shafts=1))[..., :3].any()
    start = scene.automatic["sun_azimuth"]
    added = [
        np.abs(veil(scene, LOW.replace(sun_azimuth=start + by, sun_elevation=None))[..., :3]).max()
        for by in (0, 0.02, 2)
    ]
    assert added[0] == 0
    assert 0 < added[1] < added[2]


def test_round_a_sun_behind_something_the_air_is_as_beside_it():
    scene = known_photo(clouds=False).analyze()
    seen = Edit(sun_azimuth=5, sun_elevation=6, aerosol_optical_depth=0.3)
    lit, shaded = (
        render_pass(scene, edit, "air_edit")[0] @ np.array([*LUMINANCE, 0])
        for edit in (seen, seen.replace(sun_visibility=0))
    )
    assert lit.max() > 2 * lit.min()
    assert shaded.max() < 1.01 * shaded.min()
    assert (shaded <= 1.0001 * lit).all()


def test_an_open_sky_and_an_evenly_closed_one_have_no_shafts():
    scene = known_photo(clouds=False).analyze(sky=np.ones((80, 120), np.float32))
    scene = dataclasses.replace(scene, glare=np.zeros_like(scene.glare))
    for opacity in (0.0, 0.9):
        same = dataclasses.replace(scene, cloud_map=np.full_like(scene.clouds, opacity))
        shafts = render_pass(same, LOW.replace(aerosol_optical_depth=0.4), "shafts_edit")
        assert np.abs(shafts[..., 0]).max() < 1e-3, opacity


@pytest.mark.parametrize("azimuth", [-40, 60, 120, 180])
def test_suns_outside_the_picture_make_numbers_and_little_else(azimuth):
    scene = known_scene()
    edit = Edit(sun_azimuth=azimuth, sun_elevation=5, glow=3, light_shafts=1, lens_flare=1)
    edit = edit.replace(aerosol_optical_depth=0.3)
    light = veil(scene, edit)
    assert np.isfinite(light).all()
    if azimuth > 90:
        assert not render_pass(scene, edit, "shafts_edit")[..., 0].any()
        plain = veil(scene, edit.replace(lens_flare=0))
        assert np.array_equal(light[..., :3], plain[..., :3])


def test_ghosts_lie_on_the_line_through_the_centre():
    scene = known_photo(clouds=False).analyze()
    camera = scene.camera
    sun = camera.angles(0.25 * camera.width, 0.25 * camera.height)
    edit = Edit(sun_azimuth=sun[0], sun_elevation=sun[1], **ALONE["lens_flare"])
    light = render_pass(scene, edit.replace(lens_flare=1), "veil", size=(480, 320))[..., :3]
    height, width = light.shape[:2]
    rows, columns = (np.mgrid[:height, :width] + 0.5) / np.array([height, height])[:, None, None]
    x, y = columns - 0.5 * width / height, rows - 0.5
    line = np.array([0.25 * width / height, 0.25])
    line /= np.hypot(*line)
    bright = light.sum(-1) > 0.5 * light.sum(-1).max()
    assert bright.sum() > 5
    assert np.abs(x * line[1] - y * line[0])[bright].max() < 0.12


def test_a_drag_by_one_pixel_moves_no_light_by_a_jump():
    scene = with_pillar(known_scene(), slice(30, 36))
    camera = scene.camera
    base = Edit(aerosol_optical_depth=0.3, light_shafts=1, glow=1)
    x, y = camera.pixel(8.0, 6.0)
    pictures = []
    for k in range(6):
        azimuth, elevation = camera.angles(x + k * camera.width / 1024, y)
        edit = base.replace(sun_azimuth=azimuth, sun_elevation=elevation)
        pictures.append(render_pass(scene, edit, "shafts_edit")[..., 0])
    steps = [np.abs(b - a).max() for a, b in itertools.pairwise(pictures)]
    assert max(steps) < 0.12 * np.abs(pictures[0]).max()
    assert max(steps) < 4 * (np.median(steps) + 1e-6)
