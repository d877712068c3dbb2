"""SunEditor without a browser: traits, history, analysis, requests."""

import base64
import dataclasses
import io
import json
import pickle
import threading

import numpy as np
import pytest
from PIL import Image
from traitlets import TraitError

import sunwidget as sw
from sunwidget import presets
from sunwidget.analysis import correct
from sunwidget.analysis.maps import MAPS, scene_map
from sunwidget.edit.table import PARAMETERS
from sunwidget.errors import EditError
from sunwidget.widgets import SunEditor
from sunwidget.widgets.editor import sun_editor as module
from sunwidget.widgets.kernel import analyst
from sunwidget.widgets.kernel.payload import PREVIEW_EDGE, scene_json, whiteness
from sunwidget.widgets.kernel.requests import Requests


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(sw.sample("coast").preview(384))


@pytest.fixture
def editor(scene):
    return SunEditor(scene).wait(120)


@pytest.fixture
def sent(editor, monkeypatch):
    """What the editor sends by itself, beside its state."""
    messages = []
    monkeypatch.setattr(
        editor, "send", lambda content, buffers=None: messages.append((content, buffers))
    )
    return messages


def test_every_row_of_the_table_is_a_synced_trait(editor):
    for p in PARAMETERS:
        assert getattr(editor, p.name) == p.default
        assert editor.trait_metadata(p.name, "sync")


def test_traits_are_the_edit_both_ways(editor):
    editor.sun_elevation = 3
    editor.strokes = [{"label": "sky", "points": [[0.1, 0.2]], "radius": 0.02}]
    assert editor.edit == sw.Edit(
        sun_elevation=3.0, strokes=(sw.Stroke("sky", ((0.1, 0.2),), 0.02),)
    )
    editor.edit = sw.Edit(exposure=1)
    assert (editor.sun_elevation, editor.exposure, editor.strokes) == (None, 1.0, ())


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("sun_elevation", 300),
        ("sun_elevation", float("nan")),
        ("sun_elevation", "high"),
        ("exposure", None),
        ("method", "magic"),
        ("strokes", [{"label": "sea", "points": [[0, 0]]}]),
        ("horizon_hint", [[0.5, 0.1], [0.5, 0.2]]),
    ],
)
def test_a_refused_value_says_why_and_changes_nothing(editor, name, value):
    before = editor.edit
    with pytest.raises(TraitError, match=name.removesuffix("s")):
        setattr(editor, name, value)
    assert editor.edit == before
    assert editor._history["past"] == []


def test_a_history_that_is_none_is_refused_and_undo_goes_on(editor):
    editor.exposure = 1
    with pytest.raises(TraitError, match="two lists of recipes"):
        editor._history = {"past": 3}
    editor.undo()
    assert editor.edit == sw.Edit()


def test_the_suns_place_can_be_read_while_it_is_automatic(editor, scene):
    found = scene.automatic["sun_azimuth"], scene.automatic["sun_elevation"]
    assert editor.sun == found
    editor.sun_elevation = 3
    assert editor.sun == (found[0], 3)
    editor.sun_azimuth = -4
    assert (editor.sun.azimuth, editor.sun.elevation) == (-4, 3)
    editor.reset()
    assert editor.sun == found


def test_an_unknown_keyword_gets_the_nearest_spelling(scene):
    with pytest.raises(TypeError, match="Did you mean 'sun_elevation'"):
        SunEditor(scene, sun_elevaton=3)


def test_a_recipe_is_the_start_and_keywords_win(scene):
    editor = SunEditor(scene, recipe={"version": 1, "exposure": 1, "ozone": 100}, exposure=2)
    assert editor.edit == sw.Edit(exposure=2, ozone=100)
    assert editor._history["past"] == []


def test_a_scene_is_analysed_already(scene):
    with pytest.raises(
        TypeError, match="takes sky= only with a photo; this scene is already analyzed"
    ):
        SunEditor(scene, sky=np.ones((4, 4)))


def test_options_of_the_analysis_reach_it_and_misspelt_ones_are_refused(scene):
    editor = SunEditor(scene.photo, refine="none", fov=38, exposure=1)
    assert editor.scene.hints.method("refine") == "none"
    assert editor.scene.camera.fov_vertical_deg == 38
    assert editor.edit == sw.Edit(exposure=1)
    with pytest.raises(TypeError, match="Did you mean 'refine'"):
        SunEditor(scene.photo, refin="none")


@pytest.mark.parametrize("name", [entry.name for entry in MAPS])
def test_the_browser_gets_a_map_when_it_asks(editor, scene, sent, name):
    content = {"type": "request", "id": "m", "action": "map", "name": name}
    Requests(editor.send, editor._actions())._answer(content)
    ((response, buffers),) = sent
    entry = next(row for row in editor._maps if row["name"] == name)
    values = scene_map(name).read(scene)
    if values is None:
        assert entry["title"] in response["error"]
        return
    assert response["error"] is None
    levels = np.asarray(Image.open(io.BytesIO(buffers[0])))
    assert levels.dtype == np.uint8
    if values.shape == levels.shape:
        assert np.abs(levels / 255 - scene_map(name).share(values)).max() <= 0.51 / 255


def test_the_browser_gets_the_other_methods_horizons(editor, scene, sent):
    content = {"type": "request", "id": "h", "action": "horizons"}
    Requests(editor.send, editor._actions())._answer(content)
    rows = sent[0][0]["result"]
    assert scene.horizon.source not in rows
    left, right = rows["row_argmax"]  # the thesis' row is level
    assert left == right
    sky = scene.sky > 0.5
    edges = np.count_nonzero(sky[1:] != sky[:-1], axis=1)
    assert left == pytest.approx((edges.argmax() + 1) / scene.height, abs=0.02)


def test_an_unknown_map_is_answered_with_the_names(editor, sent):
    content = {"type": "request", "id": "m", "action": "map", "name": "skyline"}
    Requests(editor.send, editor._actions())._answer(content)
    assert "choose one of sky_coarse" in sent[0][0]["error"]


def test_undo_redo_and_reset_are_exact(editor):
    editor.sun_elevation = 3.1234567
    editor.edit = editor.edit.replace(exposure=-0.35, sun_azimuth=2)
    last = editor.edit
    editor.undo()
    assert editor.edit == sw.Edit(sun_elevation=3.1234567)
    editor.undo()
    editor.undo()
    assert editor.edit == sw.Edit()
    editor.redo()
    editor.redo()
    assert editor.edit == last
    editor.reset()
    assert editor.edit == sw.Edit()
    editor.undo()
    assert editor.edit == last


def test_a_step_of_the_browser_is_undone_from_python(editor):
    editor.exposure = 1
    history = {"past": [*editor._history["past"], {"exposure": 1}], "future": []}
    editor.set_state({"sun_elevation": 4, "sun_azimuth": -3, "_history": history})
    assert editor.edit == sw.Edit(exposure=1, sun_elevation=4, sun_azimuth=-3)
    assert len(editor._history["past"]) == 2, "the browser's own step is not counted twice"
    editor.undo()
    assert editor.edit == sw.Edit(exposure=1)


def test_what_the_browser_must_not_set_is_answered_not_raised(editor, sent):
    editor.set_state({"sun_elevation": 1000})
    assert editor.sun_elevation is None
    ((message, _),) = sent
    assert message["type"] == "error"
    assert "sun_elevation = 1000 is outside" in message["error"]


def test_scene_arrives_as_json_and_pictures_of_one_size(editor, scene):
    described = json.loads(json.dumps(editor._scene, allow_nan=False))
    assert described["automatic"] == scene.automatic
    sizes = {
        Image.open(io.BytesIO(data)).size
        for data in (editor._photo, editor._layers, editor._surface)
    }
    assert sizes == {scene.photo.size}


def test_preview_of_a_small_photo_is_the_photo(editor, scene):
    preview = np.asarray(Image.open(io.BytesIO(editor._photo)))
    assert np.array_equal(preview, scene.photo.encoded)


@pytest.mark.parametrize("size", [(3000, 2001), (1, 5000), (4096, 7), (640, 480)])
def test_maps_are_sized_as_the_preview_is(size):
    photo = sw.open(np.zeros((size[1], size[0], 3), np.uint8))
    height, width, _ = photo.preview(PREVIEW_EDGE).shape
    assert photo.size_within(PREVIEW_EDGE) == (width, height)


def test_a_stroke_changes_the_maps_and_undo_brings_them_back(editor):
    layers = editor._layers
    points = [[0.1, 0.95], [0.9, 0.95]]
    editor.set_state({"strokes": [{"label": "sky", "points": points, "radius": 0.1}]})
    editor.wait(120)
    assert editor._layers != layers
    sky = np.asarray(Image.open(io.BytesIO(editor._layers)))[..., 0]
    assert sky[int(0.95 * sky.shape[0]), sky.shape[1] // 2] > 200
    editor.edit = sw.Edit()
    editor.wait(120)
    assert editor._layers == layers


def test_analysis_runs_behind_and_a_broken_one_is_said(monkeypatch):
    started, go_on = threading.Event(), threading.Event()

    def slow(photo, **options):
        started.set()
        go_on.wait(60)
        raise ValueError("No sky found in beach.jpg.")

    monkeypatch.setattr("sunwidget.widgets.kernel.analyst.analyze", slow)
    editor = SunEditor(np.zeros((8, 12, 3), np.uint8))
    assert started.wait(60)
    assert editor._photo
    assert editor._status["stage"] == "analysing"
    with pytest.raises(TimeoutError):
        editor.wait(0.01)
    go_on.set()
    with pytest.raises(ValueError, match="No sky found"):
        editor.wait(60)
    assert editor._status == {
        "stage": "error",
        "fraction": 1.0,
        "message": "No sky found in beach.jpg.",
    }


def test_strokes_made_while_one_is_worked_in_are_all_kept(editor, monkeypatch):
    started, go_on = threading.Event(), threading.Event()
    seen = []

    def slow(scene, edit, progress=None):
        seen.append(len(edit.strokes))
        started.set()
        assert go_on.wait(60)
        return correct.corrected(scene, edit, progress)

    monkeypatch.setattr(analyst, "corrected", slow)
    strokes = [
        {"label": "sky", "points": [[0.1, y], [0.9, y]], "radius": 0.02} for y in (0.9, 0.95, 0.99)
    ]
    editor.set_state({"strokes": strokes[:1]})
    assert started.wait(60)
    editor.set_state({"strokes": strokes[:2]})
    editor.set_state({"strokes": strokes})
    go_on.set()
    editor.wait(120)
    assert len(editor.edit.strokes) == 3
    assert seen == [1, 3]  # what was overtaken is not worked in by itself
    sky = np.asarray(Image.open(io.BytesIO(editor._layers)))[..., 0]
    rows = [int(y * sky.shape[0]) for y in (0.9, 0.95, 0.99)]
    assert sky[rows, sky.shape[1] // 2].min() > 200


def test_save_answers_with_the_full_size_file(editor, sent):
    editor.sun_elevation = 4
    request = {"type": "request", "id": "a", "action": "save"}
    Requests(editor.send, editor._actions())._answer(request)
    response, buffers = sent[-1]
    assert response["error"] is None
    assert response["result"]["name"].endswith("-sun.png")
    picture = np.asarray(Image.open(io.BytesIO(buffers[0])).convert("RGB"))
    assert picture.shape == editor.render().shape
    assert np.abs(picture.astype(int) - editor.render()).max() <= 2  # dithered differently


def test_every_request_is_answered_errors_included(editor, sent):
    requests = module.Requests(editor.send, {})
    requests._answer({"type": "request", "id": "b", "action": "explode"})
    ((response, _),) = sent
    assert response["id"] == "b"
    assert "no action 'explode'" in response["error"]


def test_a_preset_is_one_step_that_leaves_the_rest_alone(editor, scene):
    editor.land_strength = 0.5
    editor.apply_preset("sunset")
    assert editor.edit == presets.edit("sunset", scene, sw.Edit(land_strength=0.5))
    editor.apply_preset("moonlight")
    editor.undo()
    assert editor.edit == presets.edit("sunset", scene, sw.Edit(land_strength=0.5))
    editor.undo()
    assert editor.edit == sw.Edit(land_strength=0.5)
    with pytest.raises(EditError, match="sunset"):
        editor.apply_preset("sunrise")


def test_presets_travel_with_the_scene_as_plain_values(editor, scene):
    sent = json.loads(json.dumps(editor._scene["presets"]))
    offered = [preset for preset in presets.PRESETS if preset.name != "dusk_lights"]
    assert [row["label"] for row in sent] == [preset.label for preset in offered]
    for row, preset in zip(sent, offered, strict=True):
        assert sw.Edit(**row["values"]) == presets.edit(preset.name, scene)


def test_what_is_known_of_the_photos_sun_travels_with_the_scene(scene):
    found = scene_json(scene, 1)["sun"]
    assert (found["source"], found["visible"]) == ("found", True)
    assert found["confidence"] == scene.sun.confidence < 1
    width, height = scene.photo.size
    assert found["at"] == [scene.sun.x / width, scene.sun.y / height]
    unsure = dataclasses.replace(scene, sun=dataclasses.replace(scene.sun, confidence=0.62))
    assert scene_json(unsure, 1)["sun"]["confidence"] == unsure.sun_confidence == 0.62
    told = scene_json(correct.corrected(scene, sw.Edit(sun_hint=(0.25, -0.1))), 1)["sun"]
    assert (told["source"], told["at"]) == ("told", pytest.approx([0.25, -0.1]))


def test_of_a_sun_that_is_not_there_its_assumed_place_travels(scene):
    outside = correct.corrected(scene, sw.Edit(sun_hint="outside"))
    sent = scene_json(outside, 1)["sun"]
    assert (sent["source"], sent["at"], sent["visible"]) == ("outside", None, False)
    assert (sent["azimuth"], sent["elevation"]) == outside.assumed_sun
    assert sent["confidence"] == outside.fitted.sun_confidence < 1
    unseen = dataclasses.replace(scene, sun=None)
    assert scene_json(unseen, 1)["sun"]["source"] == "unseen"


def test_notes_of_the_editor_hold_no_code_and_name_what_they_are_about():
    dull = sw.analyze(np.full((48, 64, 3), 90, np.uint8), sky=np.zeros((48, 64)))
    notes = json.loads(json.dumps(scene_json(dull, 1)["notes"]))
    assert [note["about"] for note in notes] == ["sky", "unseen_sun", "horizon", "field_of_view"]
    # What is told of an unseen sun the editor says itself, in words for a direction.
    assert not any("=" in note["text"] for note in notes if note["about"] != "unseen_sun")
    assert all("=" in warning for warning in dull.warnings)
    assert pickle.loads(pickle.dumps(dull.warnings)) == dull.warnings


def test_python_from_the_browser_is_answered_with_its_recipe_or_what_is_wrong(editor):
    sent = []
    requests = Requests(lambda content, buffers=(): sent.append(content), editor._actions())
    for text in ("edit = sw.Edit(exposure=-0.5)", "sw.Edit(exposure=f(1))", None):
        requests._answer({"id": "1", "action": "recipe", "text": text})
    assert sent[0]["result"] == {"version": 1, "exposure": -0.5}
    assert [message["error"] for message in sent] == [
        None,
        "Line 1 of the recipe: 'f(1)' is not a plain value.",
        "There is no sw.Edit(…) in this Python.",
    ]


def test_static_viewers_get_a_picture(editor):
    data, _ = editor._repr_mimebundle_()
    picture = Image.open(io.BytesIO(base64.b64decode(data["image/png"])))
    assert max(picture.size) <= 480


def test_an_editor_prints_as_its_photo_and_edit(editor):
    editor.sun_elevation = 5
    assert repr(editor) == "<SunEditor of 'array': Edit(sun_elevation=5)>"
    assert editor._repr_mimebundle_()[0]["text/plain"] == repr(editor)


def test_render_is_the_editors_own_frame(editor, scene):
    editor.sun_elevation = 5
    assert np.array_equal(editor.render(), sw.render(scene, sw.Edit(sun_elevation=5)))


def test_whiteness_is_counted_as_the_clouds_method_measures_it(scene):
    measured = whiteness(scene)
    assert measured["method"] == "unmix"
    shares = np.array(measured["shares"])
    assert shares.sum() == pytest.approx(1, abs=1e-3)
    # The editor's three shares are those of the softness that the analysis found.
    by_ratio = correct.corrected(scene, sw.Edit(cloud_method="rb_ratio"))
    measured = whiteness(by_ratio)
    edges = np.linspace(0, measured["reach"], len(measured["shares"]) + 1)
    clear = np.array(measured["shares"])[edges[1:] <= 0.62].sum()
    none = by_ratio.cloud_softness < 1e-3 * np.maximum(by_ratio.sky, 1e-6)
    assert clear == pytest.approx(by_ratio.sky[none].sum() / by_ratio.sky.sum(), abs=0.06)
    by_difference = whiteness(correct.corrected(scene, sw.Edit(cloud_method="rb_difference")))
    assert by_difference["method"] == "rb_difference"
    assert not np.allclose(by_difference["shares"], measured["shares"])
