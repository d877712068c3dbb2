"""Compare and Study without a browser: what they take, what they say, what they hand on."""

import base64

import numpy as np
import pytest
from relight_scenes import sample_scene
from traitlets import TraitError

import sunwidget as sw
from sunwidget.edit.table import Edit
from sunwidget.errors import EditError
from sunwidget.study import StudyError
from sunwidget.widgets.compare.compare import Compare
from sunwidget.widgets.kernel.front_end import front_end
from sunwidget.widgets.study import Study

SMALL = (96, 64)


@pytest.fixture(scope="module")
def scene():
    return sample_scene("coast")


@pytest.fixture(scope="module")
def methods(scene):
    return Compare(scene, ["photo", "ratio", "thesis"], sun_elevation=4, glow=1).wait()


def test_methods_are_shown_under_the_one_sun(methods):
    assert methods.one_sun
    assert list(methods.edits) == ["photo", "ratio", "thesis"]
    assert methods.edits["photo"] == Edit()
    assert methods.edits["thesis"] == Edit(method="thesis", sun_elevation=4, glow=1)
    methods.sun_elevation = 10
    assert {e.sun_elevation for e in methods.edits.values()} == {None, 10}
    methods.sun_elevation = 4


def test_pictures_are_those_of_render(methods, scene):
    pictures = methods.render(size=SMALL)
    for label, edit in methods.edits.items():
        assert np.array_equal(pictures[label], sw.render(scene, edit, size=SMALL))
    assert np.abs(pictures["ratio"].astype(int) - pictures["photo"]).mean() > 3


def test_recipes_that_ask_for_different_suns_keep_them_until_one_is_moved(scene):
    compare = Compare(scene, {"a": {"sun_elevation": 2}, "b": sw.Edit(sun_elevation=30, glow=2)})
    assert not compare.wait().one_sun
    assert [e.sun_elevation for e in compare.edits.values()] == [2, 30]
    compare.set_state({"one_sun": True, "sun_azimuth": 5.0, "sun_elevation": 8.0})
    assert [e.sun_elevation for e in compare.edits.values()] == [8, 8]
    assert compare.edits["b"].glow == 2


def test_presets_are_those_of_this_photo(scene):
    compare = Compare(scene, ["sunset", "noon"], cloud_strength=0.5).wait()
    assert not compare.one_sun
    assert compare.edits["sunset"] == sw.preset("sunset", scene, Edit(cloud_strength=0.5))


def test_recipes_that_correct_the_photo_alike_share_their_maps(scene):
    hint = {"horizon_hint": ((0.0, 0.5), (1.0, 0.52))}
    compare = Compare(scene, {"a": {}, "b": {"glow": 1}, "c": hint, "d": {**hint, "glow": 1}})
    compare.wait()
    assert [row["scene"] for row in compare._variants] == [0, 0, 1, 1]
    cameras = [row["scene"]["camera"] for row in compare._scenes]
    assert len(cameras) == 2
    assert cameras[0] != cameras[1]
    maps = {"_layers", "_surface", "_backdrop", "_clear_sky", "_relief", "_transfer", "_lamps"}
    assert set(compare._scenes[0]) == {"scene", *maps}


def test_a_photo_that_is_analysed_already_is_not_analysed_again(monkeypatch):
    picture = sw.sample("meadow").preview(96)
    editor = sw.SunEditor(picture).wait()
    monkeypatch.setattr("sunwidget.widgets.kernel.analyst.analyze", None)
    assert Compare(picture.copy(), ["photo", "ratio"]).scene is editor.scene


@pytest.mark.parametrize(
    ("what", "says"),
    [
        (["ratio"], "2 to 9"),
        (["ratio"] * 10, "2 to 9"),
        (["ratio", "thesys"], "Did you mean 'thesis'"),
        (["ratio", "xyz"], "Choose one of ratio"),
        (["ratio", "ratio"], "same label"),
        ("ratio", "a list or a mapping"),
        (7, "a list or a mapping"),
        ([{"glow": 99}, "ratio"], "glow"),
        ([{"blow": 1}, "ratio"], "Did you mean"),
        ([3, "ratio"], "recipe"),
    ],
)
def test_what_cannot_be_compared_is_said_to_be(scene, what, says):
    with pytest.raises(EditError, match=says):
        Compare(scene, what)


def test_unknown_options_and_values_are_refused(scene, methods):
    with pytest.raises(TypeError, match="Did you mean 'sun_elevation'"):
        Compare(scene, ["photo", "ratio"], sun_elevatoin=3)
    with pytest.raises(TypeError, match="already analyzed"):
        Compare(scene, ["photo", "ratio"], clouds="unmix")
    with pytest.raises(TraitError, match="arrangement"):
        methods.arrangement = "heap"


def test_a_value_from_the_browser_that_is_refused_is_answered(methods, monkeypatch):
    sent = []
    monkeypatch.setattr(methods, "send", lambda content, buffers=None: sent.append(content))
    methods.set_state({"sun_elevation": float("nan")})
    assert sent[0]["type"] == "error"
    assert methods.sun_elevation == 4


def plain(level):
    return np.full((8, 12, 3), level, np.uint8)


def test_a_comparison_becomes_a_study(methods):
    study = Study({"coast": methods.render(size=SMALL), "grey": {"ratio": plain(9), "x": plain(8)}})
    assert study.methods == ("photo", "ratio", "thesis", "x")
    assert [len(group["methods"]) for group in study._groups] == [3, 2]
    # Every picture is there once, and is the one that was given.
    assert len(study._pictures) == 5
    assert np.array_equal(sw.open(study._pictures[4]).encoded, plain(8))


@pytest.mark.parametrize(
    ("pictures", "says"),
    [
        ([plain(0), plain(1)], "must be a mapping by method"),
        ({"a": plain(0)}, "at least two"),
        ({"coast": {"a": plain(0)}}, "coast has 1"),
        ({"a": plain(0), "coast": {"a": plain(0), "b": plain(1)}}, "are mixed"),
        ({1: plain(0), 2: plain(1)}, "must be strings"),
        ({}, "at least two"),
    ],
)
def test_pictures_that_are_no_study_are_refused(pictures, says):
    with pytest.raises(StudyError, match=says):
        Study(pictures)


def test_a_study_tells_its_strengths_and_writes_its_file(tmp_path):
    study = Study({"a": plain(0), "b": plain(1)}, rater="anna")
    with pytest.raises(StudyError, match="no answers yet"):
        study.results()
    row = {"rater": "anna", "trial": 1, "picture": "", "left": "b", "right": "a", "seconds": 1.25}
    row |= {"choice": "left", "timestamp": "2026-11-21T10:00:00.000Z"}
    study.set_state({"_answers": [row, row | {"trial": 2, "rater": "bert"}]})
    assert study.results().methods == ("b", "a")
    assert set(study.results_by_rater()) == {"anna", "bert"}
    assert Study.read_csv(study.to_csv(tmp_path / "answers.csv")) == study.answers


@pytest.mark.parametrize(
    ("row", "says"),
    [({"rater": "eve", "choice": "both"}, "is missing"), (7, "mapping of columns, not int")],
)
def test_answers_that_no_study_writes_are_refused(row, says):
    study = Study({"a": plain(0), "b": plain(1)})
    study.set_state({"_answers": [row]})
    with pytest.raises(StudyError, match=says):
        _ = study.answers


@pytest.mark.parametrize(("name", "most"), [("compare", 300_000), ("study", 120_000)])
def test_a_notebook_saves_little_more_than_the_state(name, most):
    script, style = front_end(name, name)
    assert len(script.encode()) + len(style.encode()) < most


def test_a_sheet_shows_all_pictures_under_their_labels(methods):
    picture = np.asarray(methods.sheet(96))
    shown = methods.render(size=(96, 64))
    # Three in a row, each below a band for its label.
    for i, expected in enumerate(shown.values()):
        x = i * (picture.shape[1] + 4) // 3
        assert np.array_equal(picture[-64:, x : x + 96], expected)
        assert picture[:-64, x : x + 96].max() > 150
    assert picture.shape == (64 + 26, 3 * 96 + 2 * 4, 3)


def test_viewers_without_widgets_see_the_sheet(methods):
    data, _ = methods._repr_mimebundle_()
    seen = sw.open(base64.b64decode(data["image/png"])).encoded.astype(float)
    # In 256 colors: what stands beside it in the notebook is kept for ever.
    assert np.abs(seen - np.asarray(methods.sheet(480))).mean() < 4


def test_comparison_and_study_print_what_they_show(methods):
    assert repr(methods) == "<Compare of 'array': photo, ratio, thesis>"
    pair = {"a": np.zeros((4, 4, 3), np.uint8), "b": np.full((4, 4, 3), 9, np.uint8)}
    assert repr(Study(pair)) == "<Study of a, b: 0 answers>"


def test_the_picture_of_many_is_no_larger_than_that_of_few(scene):
    photo = sw.sample("coast").preview(960)
    nine = Compare(photo, {str(i): Edit(sun_elevation=i) for i in range(9)})
    two = Compare(photo, ["photo", "ratio"])
    assert (two._small_edge(), nine._small_edge()) == (474, 223)


def test_a_study_shows_its_first_pair_to_viewers_without_widgets():
    pair = {"a": np.full((64, 96, 3), 40, np.uint8), "b": np.full((64, 90, 3), 220, np.uint8)}
    data, _ = Study(pair)._repr_mimebundle_()
    seen = sw.open(base64.b64decode(data["image/png"])).encoded
    assert seen.shape == (64 + 26, 2 * 90 + 4, 3)
    assert (seen[-1, 0, 0], seen[-1, -1, 0]) == (40, 220)


def test_pages_hold_what_they_show_and_no_text_of_a_person_as_html(scene, tmp_path):
    compare = Compare(scene, {"<script>alert(1)</script>": "ratio", "b": "thesis"}).wait()
    path = compare.to_html(tmp_path / "page.html")
    text = path.read_text("utf-8")
    assert "<script>alert" not in text
    assert text == compare.to_html()
    with pytest.raises(FileExistsError):
        compare.to_html(path)
    study = Study({"a": plain(0), "b": plain(1)}, question="<b>Which?</b>", rater="anna")
    study.set_state({"_answers": [{"rater": "anna"}]})
    page = study.to_html()
    assert "<b>Which" not in page
    # A page begins anew.
    assert "anna" not in page
