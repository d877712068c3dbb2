"""Corrections of an Edit: strokes and hints applied to a Scene, replayed to the bit."""

import numpy as np
import pytest
from analysis_pictures import seascape

import sunwidget as sw

MAPS = ("sky", "clouds", "cloud_softness", "depth", "water", "backdrop", "glare")
ROCK = sw.Stroke("not_sky", ((0.12, 0.12), (0.2, 0.14)), 0.02)


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(seascape(), fov=45.0)


@pytest.fixture(scope="module")
def brushed(scene):
    return scene.corrected(sw.Edit(strokes=(ROCK,)))


def test_an_edit_that_corrects_nothing_gives_the_very_same_scene(scene):
    assert scene.corrected(sw.Edit()) is scene
    assert scene.corrected(sw.Edit(sun_elevation=5.0, sun_azimuth=20.0)) is scene


def test_the_same_corrections_are_worked_out_once(scene, brushed):
    assert scene.corrected(sw.Edit(strokes=(ROCK,))) is brushed
    assert scene.corrected(sw.Edit(strokes=(ROCK,), exposure=1.0)) is brushed


def test_a_replayed_recipe_gives_the_same_maps_to_the_bit(scene, brushed):
    recipe = sw.Edit.from_json(sw.Edit(strokes=(ROCK,)).to_json())
    again = sw.analyze(seascape(), fov=45.0).corrected(recipe)
    for name in MAPS:
        assert np.array_equal(getattr(again, name), getattr(brushed, name)), name
    assert again.uniforms() == brushed.uniforms()
    assert again.camera == brushed.camera


def test_a_stroke_decides_the_pixels_under_it(brushed):
    height, width = brushed.sky.shape
    assert brushed.sky[round(0.13 * height), round(0.16 * width)] == 0


def test_a_stroke_leaves_far_away_areas_alone(scene, brushed):
    height, width = scene.sky.shape
    far = np.s_[round(0.3 * height) :, round(0.75 * width) :]
    assert np.array_equal(brushed.sky[far], scene.sky[far])


def test_a_sky_stroke_takes_back_a_not_sky_stroke(scene):
    undone = sw.Stroke("sky", ROCK.points, 0.03)
    back = scene.corrected(sw.Edit(strokes=(ROCK, undone)))
    height, width = scene.sky.shape
    under = np.s_[round(0.11 * height) : round(0.15 * height), round(0.13 * width) : width // 5]
    assert back.sky[under].min() == 1


def test_the_uncorrected_scene_stays_as_it_was(scene):
    before = scene.sky.copy()
    scene.corrected(sw.Edit(strokes=(sw.Stroke("sky", ((0.5, 0.9),), 0.05),)))
    assert np.array_equal(scene.sky, before)


def test_hints_of_an_edit_equal_the_same_hints_to_analyze(scene):
    height, width = scene.sky.shape
    edit = sw.Edit(sun_hint=(0.25, 0.2), horizon_hint=((0.1, 0.55), (0.9, 0.57)), fov_hint=30.0)
    corrected = scene.corrected(edit)
    told = sw.analyze(
        seascape(),
        sun=(0.25 * width, 0.2 * height),
        horizon=((0.1 * width, 0.55 * height), (0.9 * width, 0.57 * height)),
        fov=30.0,
    )
    assert corrected.camera == told.camera
    assert corrected.horizon == told.horizon
    assert (corrected.sun.azimuth, corrected.sun.elevation) == (
        told.sun.azimuth,
        told.sun.elevation,
    )
    assert corrected.uniforms() == told.uniforms()
    assert corrected.warnings == told.warnings
    for name in MAPS:
        assert np.array_equal(getattr(corrected, name), getattr(told, name)), name


def test_strokes_outside_the_picture_change_nothing(scene):
    outside = sw.Edit(strokes=(sw.Stroke("not_sky", ((3.0, 3.0), (4.0, 3.0)), 0.01),))
    assert np.array_equal(scene.corrected(outside).sky, scene.sky)
