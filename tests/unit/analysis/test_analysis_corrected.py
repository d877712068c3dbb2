"""Corrections of an Edit: strokes and hints applied to a Scene, replayed to the bit."""

import dataclasses

import numpy as np
import pytest
from analysis_pictures import seascape

import sunwidget as sw
from sunwidget.analysis import correct, frame_inputs
from sunwidget.analysis.memory import Memory
from sunwidget.analysis.strokes import brush

MAPS = ("sky", "clouds", "cloud_softness", "cloud_shade", "depth", "water", "backdrop", "glare")
ROCK = sw.Stroke("not_sky", ((0.12, 0.12), (0.2, 0.14)), 0.02)


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(seascape(), fov=45.0)


@pytest.fixture(scope="module")
def brushed(scene):
    return correct.corrected(scene, sw.Edit(strokes=(ROCK,)))


def test_an_edit_that_corrects_nothing_gives_the_very_same_scene(scene):
    assert correct.corrected(scene, sw.Edit()) is scene
    assert correct.corrected(scene, sw.Edit(sun_elevation=5.0, sun_azimuth=20.0)) is scene


def test_the_same_corrections_are_worked_out_once(scene, brushed):
    assert correct.corrected(scene, sw.Edit(strokes=(ROCK,))) is brushed
    assert correct.corrected(scene, sw.Edit(strokes=(ROCK,), exposure=1.0)) is brushed


def test_a_replayed_recipe_gives_the_same_maps_to_the_bit(scene, brushed):
    recipe = sw.Edit.from_json(sw.Edit(strokes=(ROCK,)).to_json())
    again = correct.corrected(sw.analyze(seascape(), fov=45.0), recipe)
    for name in MAPS:
        assert np.array_equal(getattr(again, name), getattr(brushed, name)), name
    assert frame_inputs.uniforms(again) == frame_inputs.uniforms(brushed)
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
    back = correct.corrected(scene, sw.Edit(strokes=(ROCK, undone)))
    height, width = scene.sky.shape
    under = np.s_[round(0.11 * height) : round(0.15 * height), round(0.13 * width) : width // 5]
    assert back.sky[under].min() == 1


def test_a_picture_has_its_strokes_worked_out_once():
    photo = sw.analyze(seascape(), fov=45.0)
    sw.render(photo, sw.Edit(strokes=(ROCK,)))
    assert list(photo.memory.scenes) == [(ROCK,)]


def test_the_uncorrected_scene_stays_as_it_was(scene):
    before = scene.sky.copy()
    correct.corrected(scene, sw.Edit(strokes=(sw.Stroke("sky", ((0.5, 0.9),), 0.05),)))
    assert np.array_equal(scene.sky, before)


def test_hints_of_an_edit_equal_the_same_hints_to_analyze(scene):
    height, width = scene.sky.shape
    edit = sw.Edit(sun_hint=(0.25, 0.2), horizon_hint=((0.1, 0.55), (0.9, 0.57)), fov_hint=30.0)
    corrected = correct.corrected(scene, edit)
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
    assert frame_inputs.uniforms(corrected) == frame_inputs.uniforms(told)
    assert corrected.warnings == told.warnings
    for name in MAPS:
        assert np.array_equal(getattr(corrected, name), getattr(told, name)), name


def test_a_person_may_say_that_nothing_in_the_picture_is_the_sun(scene):
    assert scene.sun is not None
    assert scene.sun.visible
    told = correct.corrected(scene, sw.Edit(sun_hint="outside"))
    assert told.sun is None
    assert frame_inputs.uniforms(told)["sun_visible"] == 0
    assert (told.automatic["sun_azimuth"], told.automatic["sun_elevation"]) == told.assumed_sun
    assert any("According to the hint, the sun is not in" in warning for warning in told.warnings)
    assert_same(told, sw.analyze(seascape(), fov=45.0, sun="outside"))


def test_a_hint_of_the_edit_wins_over_the_analysis_and_taken_back_leaves_it(scene):
    told = sw.analyze(seascape(), sun="outside")
    pointed = correct.corrected(told, sw.Edit(sun_hint=(0.7021, 0.3531)))
    assert pointed.sun is not None
    assert pointed.sun.visible
    assert correct.corrected(told, sw.Edit()).sun is None


def test_strokes_outside_the_picture_change_nothing(scene):
    outside = sw.Edit(strokes=(sw.Stroke("not_sky", ((3.0, 3.0), (4.0, 3.0)), 0.01),))
    assert np.array_equal(correct.corrected(scene, outside).sky, scene.sky)


def assert_same(one, other):
    for name in (*MAPS, "sureness"):
        assert np.array_equal(getattr(one, name), getattr(other, name)), name
    assert frame_inputs.uniforms(one) == frame_inputs.uniforms(other)
    assert one.camera == other.camera
    assert one.warnings == other.warnings


def forgetful(scene):
    """Return the same scene without anything that it remembers."""
    return dataclasses.replace(scene, memory=Memory())


STROKES = (
    ROCK,
    sw.Stroke("sky", ((0.6, 0.8), (0.7, 0.8)), 0.02),
    sw.Stroke("not_sky", ((0.05, 0.3), (0.5, 0.32)), 0.03),
    sw.Stroke("sky", ((0.1, 0.13), (0.3, 0.3)), 0.02),
    sw.Stroke("not_sky", ((0.62, 0.8), (0.62, 0.9)), 0.004),
)


def test_strokes_one_by_one_and_all_at_once_in_a_photo_larger_than_what_is_analysed():
    import cv2

    scene = sw.analyze(cv2.resize(seascape(), (1110, 740)), fov=45.0)
    one_by_one = forgetful(scene)
    for count in (1, 3):
        last = correct.corrected(one_by_one, sw.Edit(strokes=STROKES[:count]))
    assert_same(last, correct.corrected(forgetful(scene), sw.Edit(strokes=STROKES[:3])))


def test_strokes_one_by_one_and_all_at_once_give_the_same_maps_to_the_bit(scene):
    one_by_one = forgetful(scene)
    for count in range(1, len(STROKES) + 1):
        last = correct.corrected(one_by_one, sw.Edit(strokes=STROKES[:count]))
    assert_same(last, correct.corrected(forgetful(scene), sw.Edit(strokes=STROKES)))
    undone = correct.corrected(one_by_one, sw.Edit(strokes=STROKES[:3]))
    other_way = correct.corrected(one_by_one, sw.Edit(strokes=(*STROKES[:2], STROKES[4])))
    assert_same(undone, correct.corrected(forgetful(scene), sw.Edit(strokes=STROKES[:3])))
    assert_same(
        other_way, correct.corrected(forgetful(scene), sw.Edit(strokes=(*STROKES[:2], STROKES[4])))
    )


def test_strokes_of_analyze_and_of_an_edit_are_the_same_thing(scene):
    told = sw.analyze(seascape(), fov=45.0, strokes=STROKES[:2])
    assert_same(told, correct.corrected(scene, sw.Edit(strokes=STROKES[:2])))
    assert told.hints == correct.corrected(scene, sw.Edit(strokes=STROKES[:2])).hints
    more = correct.corrected(told, sw.Edit(strokes=STROKES[2:3]))
    assert_same(more, correct.corrected(scene, sw.Edit(strokes=STROKES[:3])))


def said(scene):
    """Return what STROKES say at the scene's size: 1 sky, 0 not sky, NaN nothing."""
    height, width = scene.sky.shape
    wanted = np.full((height, width), np.nan)
    for stroke in STROKES:
        wanted[brush.paint(stroke, width, height)] = stroke.label == "sky"
    return wanted


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"refine": "grabcut_rect"},
        {"refine": "none"},
        {"sky": "skyline"},
        {"clouds": "rb_ratio"},
        {"horizon": 250.0},
        {"sun": (60.0, 60.0), "sun_method": "flood_fill"},
    ],
)
def test_a_persons_mask_survives_another_analysis(options):
    scene = correct.corrected(sw.analyze(seascape(), **options), sw.Edit(strokes=STROKES))
    wanted = said(scene)
    assert np.array_equal(scene.sky[wanted == 1], np.ones(np.sum(wanted == 1)))
    assert scene.sky[wanted == 0].max() == 0


@pytest.mark.parametrize(
    "hint",
    [
        {"horizon_hint": ((0.0, 0.2), (1.0, 0.25))},
        {"sun_hint": (0.16, 0.13)},
        {"fov_hint": 30.0},
        {"cloud_method": "rb_ratio"},
    ],
)
def test_a_persons_mask_survives_later_hints(scene, hint):
    # The horizon cuts the painted sky, and the sun is put where the person said rock.
    hinted = correct.corrected(scene, sw.Edit(strokes=STROKES, **hint))
    wanted = said(hinted)
    assert hinted.sky[wanted == 1].min() == 1
    assert hinted.sky[wanted == 0].max() == 0


def test_a_few_strokes_keep_camera_sun_and_fit_and_many_do_not(scene):
    few = correct.corrected(scene, sw.Edit(strokes=(sw.Stroke("not_sky", ((0.1, 0.1),), 0.02),)))
    assert 0 < np.mean(few.sky != scene.sky) < 0.05
    assert few.fitted is scene.fitted
    assert few.sun is scene.sun
    wide = sw.Stroke("not_sky", ((0.0, 0.05), (1.0, 0.05)), 0.1)
    assert correct.corrected(scene, sw.Edit(strokes=(wide,))).fitted is not scene.fitted


def test_clouds_shrink_and_grow_with_the_sky(scene):
    dab = sw.Stroke("not_sky", ((0.1, 0.54),), 0.02)  # where the sky is pale
    less = correct.corrected(scene, sw.Edit(strokes=(dab,)))
    gone, unchanged = (less.sky == 0) & (scene.sky > 0), less.sky == scene.sky
    assert gone.any()
    assert scene.cloud_softness[gone].max() > 0
    assert less.clouds[gone].max() == less.cloud_softness[gone].max() == 0
    assert np.array_equal(less.clouds[unchanged], scene.clouds[unchanged])


def test_land_that_is_told_to_be_sky_brings_its_clouds():
    picture = seascape()
    picture[125:150, 20:80] = 220
    foam = sw.Stroke("sky", ((0.1, 0.86), (0.32, 0.86)), 0.02)
    scene = sw.analyze(picture, fov=45.0)
    told = correct.corrected(scene, sw.Edit(strokes=(foam,)))
    patch = np.s_[130:145, 25:75]
    assert scene.cloud_softness[patch].max() == 0
    assert told.sky[patch].min() > 0.9
    assert told.cloud_softness[patch].min() > 0.9


def test_sureness_is_full_where_a_stroke_decided(scene, brushed):
    height, width = scene.sky.shape
    under = brush.paint(sw.Stroke("sky", ROCK.points, 0.005), width, height)
    assert brushed.sureness[under].min() == 1


@pytest.mark.parametrize(
    "stroke",
    [
        *STROKES,
        sw.Stroke("sky", ((0.99, 0.99),), 0.05),
        sw.Stroke("sky", ((-0.5, 0.5), (1.5, 0.51), (0.2, 2.0)), 0.013),
        sw.Stroke("sky", ((0.5, 0.5),), 0.0001),
        sw.Stroke("sky", ((3.0, 3.0), (4.0, 3.0)), 0.01),
    ],
)
def test_setting_a_stroke_touches_the_pixels_under_it_and_no_others(stroke):
    matte = np.full((261, 384), 0.5, np.float32)
    brush.set_strokes(matte, (stroke,))
    under = brush.paint(stroke, 384, 261)
    assert np.array_equal(matte != 0.5, under)
    assert (matte[under] == (stroke.label == "sky")).all()
