"""The sun taken away, set behind a ridge, and raised again: no disc left, no jump on the way."""

import dataclasses
import itertools

import numpy as np
import pytest
from relight_scenes import known_photo, known_scene, sample_scene

from sunwidget.analysis.sun.camera_glare import angle_to_sun
from sunwidget.edit.table import Edit
from sunwidget.renderer import render, render_pass

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
GLARE = {"glare_profile": (1.5, 4.0, 1.5)}


def with_glare(scene):
    return dataclasses.replace(scene, response=scene.response | GLARE)


def from_sun(scene, sun=None):
    sun = sun or (scene.automatic["sun_azimuth"], scene.automatic["sun_elevation"])
    return angle_to_sun(scene.camera, (scene.width, scene.height), sun)


@pytest.mark.parametrize("name", ["known", "mountains", "harbour"])
def test_a_sun_taken_away_leaves_the_sky_beside_it(name):
    scene = known_scene() if name == "known" else sample_scene(name)
    angle, sky = from_sun(scene), scene.sky > 0.99
    disc = angle < max(0.5, 40 / scene.width)
    beside = sky & (angle > 8) & (angle < 14) & (scene.clouds < 0.3)
    before = scene.photo.pixels @ LUMINANCE
    after = render(scene, Edit(sun_visibility=0, auto_exposure=0), dtype="float32") @ LUMINANCE
    assert before[disc].mean() > 1.5 * np.median(before[beside])
    assert after[disc].mean() < 1.35 * np.median(after[beside])


def test_no_direct_light_and_no_glare_of_the_camera_are_left():
    scene = with_glare(known_scene())
    edit = Edit(sun_azimuth=-10, sun_elevation=20, sun_visibility=0)
    assert render_pass(scene, edit, "visibility_edit")[0, 0, 0] == 0
    assert not render_pass(scene, edit, "composite_constants")[0, 13, :3].any()
    seen = render_pass(scene, edit.replace(sun_visibility=1), "sky_edit")[..., 3]
    assert seen.max() > 0.5


def test_the_aureole_goes_with_the_sun_and_the_rest_of_the_sky_stays():
    scene = known_scene()
    edit = Edit(sun_azimuth=-18, sun_elevation=12)
    hidden = render_pass(scene, edit.replace(sun_visibility=0), "sky_edit")[..., :3] @ LUMINANCE
    seen = render_pass(scene, edit, "sky_edit")[..., :3] @ LUMINANCE
    angle = from_sun(scene, (-18, 12))
    _, elevation = scene.camera.angles(
        *np.meshgrid(np.arange(scene.width) + 0.5, np.arange(scene.height) + 0.5)
    )
    sky = elevation > 1
    ratio = hidden / seen
    assert np.median(ratio[sky & (angle < 4)]) < 0.75
    assert abs(np.median(ratio[sky & (np.abs(angle - 45) < 3)]) - 1) < 0.05
    assert ratio[sky].max() < 1.3


def test_less_and_less_sun_changes_the_picture_little_by_little():
    scene = with_glare(known_scene())
    levels = np.linspace(0, 1, 26)
    frames = [
        render(scene, Edit(sun_visibility=float(v), auto_exposure=0), dtype="float32")
        for v in levels
    ]
    steps = [np.abs(b - a) for a, b in itertools.pairwise(frames)]
    whole = np.abs(frames[-1] - frames[0])
    assert max(step.mean() for step in steps) < 4 * whole.mean() / len(steps)
    assert np.array_equal(render(scene, Edit(sun_visibility=1.0)), known_scene().photo.encoded)


def test_a_moved_sun_that_is_taken_away_is_the_same_whatever_the_way():
    scene = known_scene()
    edit = Edit(sun_azimuth=-15, sun_elevation=6, sun_visibility=0.4)
    first = render(scene, edit)
    for detour in (Edit(), Edit(sun_visibility=0), Edit(sun_azimuth=40, sun_elevation=-3)):
        render(scene, detour)
        assert np.array_equal(render(scene, edit), first)


@pytest.fixture(scope="module")
def ridge():
    """A scene whose land rises to 6 degrees on the left."""
    photo = known_photo(clouds=False)
    columns, rows = np.meshgrid(np.arange(120) + 0.5, np.arange(80) + 0.5)
    azimuth, elevation = photo.camera.angles(columns, rows)
    sky = np.clip((elevation - np.where(azimuth < -3, 6, 0)) / 0.4 + 0.5, 0, 1)
    return photo.analyze(sky=sky.astype(np.float32))


def test_a_sun_that_sets_behind_a_ridge_goes_step_by_step_and_leaves_its_glow(ridge):
    ridge = with_glare(ridge)
    heights = np.arange(8.0, 4.5, -0.1)
    edits = [Edit(sun_azimuth=-12, sun_elevation=float(h), auto_exposure=0) for h in heights]
    seen = np.array([render_pass(ridge, edit, "visibility_edit")[0, 0, 0] for edit in edits])
    assert seen[0] > 0.99
    assert seen[-1] < 0.01
    assert np.all(np.diff(seen) <= 1e-6)
    assert np.abs(np.diff(seen)).max() < 0.35
    frames = [render(ridge, edit, dtype="float32") for edit in edits]
    for a, b, height in zip(frames, frames[1:], heights, strict=False):
        away = from_sun(ridge, (-12.0, float(height))) > 2.5
        assert np.abs(b - a)[away].max() < 0.2
        assert np.abs(b - a)[away].mean() < 0.02
    # Hidden, its disc shows nowhere, and the sky over the ridge is brighter there than elsewhere.
    sky, angle = ridge.sky > 0.99, from_sun(ridge, (-12.0, float(heights[-1])))
    light = render_pass(ridge, edits[-1], "sky_edit")[..., :3] @ LUMINANCE
    assert light[sky & (angle < 6)].mean() > 1.5 * light[sky & (angle > 20)].mean()


def test_raised_again_from_behind_the_ridge_it_is_where_it_was(ridge):
    up = Edit(sun_azimuth=-12, sun_elevation=9)
    first = render(ridge, up)
    for height in (6, 4, -5, 4, 6):
        render(ridge, up.replace(sun_elevation=height))
    assert np.array_equal(render(ridge, up), first)


@pytest.mark.parametrize("visibility", [0.0, 0.5])
def test_it_holds_for_the_thesis_too(visibility):
    scene = known_scene()
    edit = Edit(sun_azimuth=-10, sun_elevation=15, method="thesis")
    x, y = (int(v) for v in scene.camera.pixel(-10, 15))
    seen = render(scene, edit, dtype="float32")[y, x].max()
    veiled = render(scene, edit.replace(sun_visibility=visibility), dtype="float32")[y, x].max()
    assert veiled < seen - 0.02


def test_the_glow_of_a_sun_behind_clouds_shines_through_bright_ones_only():
    scene = known_scene()
    edit = Edit(sun_azimuth=-12, sun_elevation=15)
    overcast = dataclasses.replace(scene, cloud_map=np.ones_like(scene.cloud_map))
    dark = dataclasses.replace(overcast, backdrop=0.4 * overcast.backdrop)
    bright = dataclasses.replace(overcast, backdrop=np.ones_like(overcast.backdrop))
    clear, through, hidden = (
        render_pass(s, edit, "visibility_edit")[0, 0] for s in (scene, bright, dark)
    )
    assert clear[0] > 0.9
    assert through[0] == hidden[0] == 0
    assert 0.2 < through[1] < 0.5
    assert hidden[1] < 0.05


def test_water_mirrors_the_glow_of_a_hidden_sun_and_more_of_a_sun_that_is_seen():
    scene = known_scene()
    edit = Edit(sun_azimuth=-12, sun_elevation=15)
    overcast = dataclasses.replace(scene, cloud_map=np.ones_like(scene.cloud_map))
    bright = dataclasses.replace(overcast, backdrop=np.ones_like(overcast.backdrop))
    seen, mirrored = (
        render_pass(s, edit, "composite_constants")[0, 12, :3].sum() for s in (scene, bright)
    )
    assert 0.05 * seen < mirrored < 0.5 * seen
