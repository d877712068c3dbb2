"""A photo that is opened again in a second editor is not analysed again."""

import gc
import weakref

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.widgets.kernel import analyst
from sunwidget.widgets.kernel.known_scenes import recall


@pytest.fixture(scope="module")
def pixels():
    return sw.sample("coast").preview(96)


def test_the_same_photo_again_has_the_same_scene(pixels, monkeypatch):
    first = sw.SunEditor(pixels.copy()).wait()

    def refuse(*args, **options):
        raise AssertionError("analysed again")

    monkeypatch.setattr(analyst, "analyze", refuse)
    again = sw.SunEditor(pixels.copy(), sun_elevation=3).wait()
    assert again.scene is first.scene
    assert again.edit.sun_elevation == 3
    assert first.edit.sun_elevation is None
    # What is corrected in one stays there.
    again.horizon_hint = [[0.0, 0.6], [1.0, 0.6]]
    again.wait()
    assert again.scene is not first.scene
    assert sw.SunEditor(pixels.copy()).wait().scene is first.scene


def test_other_pixels_or_options_are_analysed(pixels):
    first = sw.SunEditor(pixels).wait()
    other = pixels.copy()
    other[0, 0, 0] ^= 1
    assert sw.SunEditor(other).wait().scene is not first.scene
    assert sw.SunEditor(pixels, fov=40).wait().scene is not first.scene
    photo = first.photo
    assert recall(photo, {}) is first.scene
    assert recall(photo, {"fov": 40.0}) is None
    mask = np.ones(pixels.shape[:2], bool)
    assert recall(photo, {"sky": mask}) is None


def test_a_file_that_may_have_changed_is_never_the_same(pixels):
    scene = sw.SunEditor(pixels).wait().scene
    from sunwidget.widgets.kernel.known_scenes import remember

    remember(scene, {"sky": "my.onnx"})
    assert recall(scene.photo, {"sky": "my.onnx"}) is None


def test_a_scene_that_nobody_holds_is_forgotten(pixels):
    other = np.ascontiguousarray(pixels[:, ::-1])
    editor = sw.SunEditor(other).wait()
    photo, scene = editor.photo, weakref.ref(editor.scene)
    assert recall(photo, {}) is scene()
    editor.close()
    del editor
    gc.collect()
    assert recall(photo, {}) is None
    assert scene() is None
