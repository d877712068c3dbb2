"""Undo, named versions and other photos in one SunEditor: nothing that was done is lost."""

import io

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.errors import EditError, PhotoError
from sunwidget.widgets import SunEditor
from sunwidget.widgets.editor.history import HISTORY_BYTES, HISTORY_LENGTH, newest
from sunwidget.widgets.editor.uploads import UPLOAD_BYTES, Uploads, fingerprint


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(sw.sample("coast").preview(256))


@pytest.fixture(scope="module")
def other():
    return sw.analyze(sw.sample("coast").preview(192))


@pytest.fixture
def editor(scene):
    return SunEditor(scene).wait(120)


def test_values_set_at_once_are_one_step(editor):
    with editor.hold_trait_notifications():
        editor.sun_elevation = 3
        editor.sun_azimuth = 4
    assert len(editor._history["past"]) == 1
    editor.undo()
    assert editor.edit == sw.Edit()


def test_the_history_is_bounded_in_steps_and_in_bytes(editor):
    for i in range(HISTORY_LENGTH + 5):
        editor.exposure = i / 100 + 0.01
    assert len(editor._history["past"]) == HISTORY_LENGTH
    stroke = {"label": "sky", "points": [[0.1234567, 0.7654321]] * 20_000, "radius": 0.01}
    kept = newest([{"strokes": [stroke], "exposure": i} for i in range(8)])
    assert 0 < len(kept) < 8
    assert kept[-1]["exposure"] == 7, "the last steps are kept, not the first"
    assert newest([{"strokes": [stroke] * 8}]), f"a step above {HISTORY_BYTES} bytes can be undone"


def test_a_version_is_kept_by_name_and_going_to_it_is_one_step(editor):
    editor.sun_elevation = 3
    editor.keep(" warm ")
    editor.reset()
    editor.exposure = 1
    editor.go_to("warm")
    assert editor.edit == sw.Edit(sun_elevation=3)
    assert editor.versions == {"warm": sw.Edit(sun_elevation=3)}
    editor.undo()
    assert editor.edit == sw.Edit(exposure=1)


def test_keeping_again_never_replaces_another_edit_unasked(editor):
    editor.keep("first")
    editor.keep("first")
    editor.exposure = 1
    with pytest.raises(EditError, match="Another edit is kept as 'first'"):
        editor.keep("first")
    assert editor.versions == {"first": sw.Edit()}
    editor.keep("first", overwrite=True)
    assert editor.versions == {"first": sw.Edit(exposure=1)}


@pytest.mark.parametrize("name", ["", "  ", "x" * 81, None, 3])
def test_a_name_is_a_short_text(editor, name):
    with pytest.raises(EditError, match="1 to 80 characters"):
        editor.keep(name)


def test_a_version_that_is_not_there_is_said_with_the_nearest(editor):
    with pytest.raises(EditError, match="keeps one"):
        editor.go_to("warm")
    editor.keep("warm")
    with pytest.raises(EditError, match="Did you mean 'warm'"):
        editor.go_to("warn")
    editor.forget("warm")
    assert editor.versions == {}
    with pytest.raises(EditError):
        editor.forget("warm")


def test_versions_of_the_browser_are_pythons(editor):
    recipe = {"sun_elevation": 4, "strokes": [{"label": "sky", "points": [[0, 0]], "radius": 0.01}]}
    editor.set_state({"_versions": [{"name": "noon", "recipe": recipe}]})
    assert editor.versions == {"noon": sw.Edit.from_dict(recipe)}
    editor.go_to("noon")
    assert editor.sun_elevation == 4


def test_another_photo_begins_anew_and_the_first_ones_edit_is_back_with_it(editor, scene, other):
    editor.sun_elevation = 3
    editor.exposure = 1
    editor.keep("warm")
    before = (editor.edit, editor._history)
    session = editor._source["session"]
    editor.open(other.photo, refine="none")
    assert editor.photo is other.photo
    assert (editor.edit, editor._history["past"], editor.versions) == (sw.Edit(), [], {})
    assert editor._scene == {} or editor.wait(120).scene.photo is other.photo
    assert editor.wait(120).scene.hints.method("refine") == "none"
    assert editor._source["session"] == session
    editor.sun_azimuth = 2
    editor.open(scene)
    assert (editor.edit, editor._history) == before
    assert list(editor.versions) == ["warm"]
    assert editor.wait(120).scene is scene
    editor.open(other, exposure=2)
    assert editor.edit == sw.Edit(exposure=2), "what is asked for wins over what was set aside"
    editor.undo()
    assert editor.edit == sw.Edit(sun_azimuth=2), "which is not lost"


def test_another_photo_that_cannot_be_opened_changes_nothing(editor, scene):
    editor.exposure = 1
    with pytest.raises(PhotoError):
        editor.open(b"no picture")
    with pytest.raises(TypeError, match="Did you mean 'exposure'"):
        editor.open(scene, exposur=1)
    assert editor.photo is scene.photo
    assert editor.edit == sw.Edit(exposure=1)


def test_an_analysis_under_way_does_not_reach_the_next_photo(editor, scene, other):
    old = editor._analyst
    editor.open(other)
    editor.wait(120)
    old._deliver(scene)
    old._report("error", 1.0, "too late")
    assert editor._status["stage"] == "ready"
    assert (editor._scene["width"], editor._scene["height"]) == (other.width, other.height)


def test_a_fingerprint_is_of_the_pixels(scene, other):
    photo = scene.photo
    again = sw.open(np.array(photo.encoded))
    assert fingerprint(again) == fingerprint(photo)
    assert fingerprint(other.photo) != fingerprint(photo)
    changed = np.array(photo.encoded)
    changed[0, 0, 0] ^= 1
    assert fingerprint(sw.open(changed)) != fingerprint(photo)


def pieces(data, size, key="a"):
    for offset in range(0, len(data), size):
        piece = memoryview(data)[offset : offset + size]
        common = {"upload": key, "name": "waves.png", "size": len(data), "offset": offset}
        yield {**common, "buffers": [piece]}


def silent(_fraction, _message):
    pass


@pytest.fixture(scope="module")
def file(scene):
    stream = io.BytesIO()
    from PIL import Image

    Image.fromarray(scene.photo.encoded).save(stream, "PNG")
    return stream.getvalue()


def test_an_upload_in_pieces_is_the_photo(file, scene):
    opened = []
    upload = Uploads(opened.append)
    for piece in pieces(file, 10_000):
        assert opened == []
        assert upload(piece, silent) == ({}, [])
    (photo,) = opened
    assert photo.name == "waves.png"
    assert np.array_equal(photo.encoded, scene.photo.encoded)


def test_an_upload_that_was_left_is_begun_anew_and_a_mixed_one_refused(file):
    opened = []
    upload = Uploads(opened.append)
    first = list(pieces(file, 10_000, "first"))
    second = list(pieces(file, 10_000, "second"))
    upload(first[0], silent)
    upload(second[0], silent)
    with pytest.raises(PhotoError, match="Another upload interrupted this one"):
        upload(first[1], silent)
    with pytest.raises(PhotoError, match="Another upload interrupted this one"):
        upload(second[2], silent)
    for piece in second[1:]:
        upload(piece, silent)
    assert len(opened) == 1


def test_an_upload_that_is_too_large_or_no_picture_says_so():
    upload = Uploads(lambda _: None)
    huge = {"upload": 1, "name": "x", "size": UPLOAD_BYTES + 1, "offset": 0, "buffers": [b""]}
    with pytest.raises(PhotoError, match=r"editor\.open"):
        upload(huge, silent)
    with pytest.raises(PhotoError):
        upload({**huge, "size": 4, "buffers": [b"\0\0\0\0"]}, silent)
    with pytest.raises(PhotoError, match="More bytes arrived"):
        upload({**huge, "size": 2, "buffers": [b"\0\0\0\0"]}, silent)
