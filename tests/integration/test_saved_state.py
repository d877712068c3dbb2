"""What a kernel tells of a widget where a program runs the notebook and stores what it hears."""

import numpy as np
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.formats.png import encode_png, encode_small_png
from sunwidget.photo.photo import open_photo
from sunwidget.widgets.kernel.payload import MAP_TRAITS, encode_maps
from sunwidget.widgets.page import saved_state


@pytest.fixture
def stored(monkeypatch):
    """Let a program run this cell."""
    monkeypatch.setattr(saved_state, "unattended", lambda: True)


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(sw.sample("coast").preview(768))


def heavy(state):
    """Bytes of a state's pictures and maps."""
    if isinstance(state, dict):
        return sum(map(heavy, state.values()))
    if isinstance(state, (list, tuple)):
        return sum(map(heavy, state))
    return len(state) if isinstance(state, bytes) else 0


def test_every_map_has_its_trait(scene):
    assert set(encode_maps(scene)) == set(MAP_TRAITS)


@pytest.mark.usefixtures("stored")
def test_of_an_editor_the_recipe_and_a_small_photo_are_stored(scene):
    editor = sw.SunEditor(scene, sun_elevation=3).wait()
    state = editor.get_state()
    assert state["sun_elevation"] == 3
    assert state["_saved"] == "photo"
    assert state["_scene"] == {}
    assert max(open_photo(state["_photo"]).size) == 640
    assert heavy(state) == len(state["_photo"]) < 100_000
    # A message about one trait is stored as well.
    assert editor.get_state("_layers") == {"_layers": b""}
    assert editor.get_state(["sun_elevation"]) == {"sun_elevation": 3}


@pytest.mark.usefixtures("stored")
def test_of_comparison_and_study_no_maps_and_pictures_are_stored(scene):
    compare = sw.Compare(scene, ["photo", "ratio"]).wait()
    assert compare.get_state()["_scenes"] == []
    assert [row["label"] for row in compare.get_state()["_variants"]] == ["photo", "ratio"]
    assert heavy(compare.get_state()) < 100_000
    study = sw.Study(compare.render(size=(96, 64)))
    study.set_state({"_answers": [{"rater": "anna"}]})
    state = study.get_state()
    assert (state["_pictures"], state["_answers"]) == ([], [{"rater": "anna"}])
    assert open_photo(state["_thumbnail"]).size == (2 * 96 + 4, 64 + 26)
    assert heavy(state) < 100_000


def test_a_page_made_there_is_whole(scene, monkeypatch):
    whole = sw.SunEditor(scene).wait().to_html()
    monkeypatch.setattr(saved_state, "unattended", lambda: True)
    stored = sw.SunEditor(scene).wait().to_html()
    assert len(stored) == pytest.approx(len(whole), rel=0.01)
    assert "_saved" not in stored[stored.index('id="content"') :].split("_esm")[0]


def test_a_person_is_told_everything(scene):
    state = sw.SunEditor(scene).wait().get_state()
    assert "_saved" not in state
    assert all(state[name] for name in MAP_TRAITS)
    assert max(open_photo(state["_photo"]).size) == 768


def test_a_picture_that_every_notebook_keeps_is_small_and_looks_the_same():
    few = np.zeros((64, 96, 3), np.uint8)
    few[:, 48:] = 200
    assert encode_small_png(few) == encode_png(few)
    photo = sw.sample("meadow").preview(480)
    small = encode_small_png(photo)
    assert len(small) < 0.5 * len(encode_png(photo))
    seen = open_photo(small).encoded
    assert seen.shape == photo.shape
    assert np.abs(seen.astype(float) - photo).mean() < 4  # 256 colors, dithered
    # Averages over 8 × 8 pixels, as seen from further away, are those of the photo.
    means = [np.asarray(Image.fromarray(each).reduce(8), float) for each in (seen, photo)]
    assert np.abs(means[0] - means[1]).mean() < 1.5
