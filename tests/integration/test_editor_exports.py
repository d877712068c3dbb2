"""What the editor exports: key frames, films, and the files that the browser's panel asks for."""

import io
import json
import threading
import time
import zipfile

import numpy as np
import pytest
import traitlets
from PIL import Image

import sunwidget as sw
from sunwidget.errors import EditError
from sunwidget.widgets import SunEditor
from sunwidget.widgets.editor.export_files import FILMS, STILLS
from sunwidget.widgets.editor.exports import _film_day
from sunwidget.widgets.kernel.requests import Cancelled

LOW = sw.Edit(sun_elevation=2, exposure=0.5)


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(sw.sample("coast").preview(192))


@pytest.fixture
def editor(scene, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # as a kernel runs in its notebook's folder
    return SunEditor(scene).wait()


def quiet(_fraction, _message):
    pass


def ask(editor, action, **content):
    """What the browser gets: the answer, and the file."""
    result, buffers = editor._actions()[action](content, quiet)
    json.dumps(result)
    return result, b"".join(buffers)


def film(editor, **content):
    content = {"name": "evening", "suffix": ".gif", "fps": 4, "seconds": 1.0} | content
    return ask(editor, "film", **content)


def test_key_frames_are_sorted_and_the_same_from_python_and_browser(editor):
    editor.key_frames = [(4, LOW), (0, {"sun_azimuth": 3})]
    assert editor.key_frames == ((0.0, sw.Edit(sun_azimuth=3)), (4.0, LOW))
    travels = json.loads(json.dumps(editor.get_state("key_frames")["key_frames"]))
    assert travels[1] == {"seconds": 4.0, "recipe": LOW.to_dict()}
    stroke = {"label": "sky", "points": [[0.5, 0.1], [0.6, 0.1]], "radius": 0.02}
    recipe = {"exposure": 1, "strokes": [stroke], "method": "thesis"}  # not all of it moves
    editor.set_state({"key_frames": [{"seconds": 2.5, "recipe": recipe}, *travels]})
    assert [seconds for seconds, _ in editor.key_frames] == [0.0, 2.5, 4.0]
    assert editor.key_frames[1][1] == sw.Edit(exposure=1)


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ([(0, sw.Edit()), (0, LOW)], "same time"),
        ([(-1, LOW)], "0 to 600"),
        ([(float("nan"), LOW)], "0 to 600"),
        ([("soon", LOW)], "a number"),
        ([(0, {"exposure": 99})], "exposure"),
        ([{"seconds": 1}], "pairs"),
        (7, "pairs"),
        ([(i, sw.Edit()) for i in range(101)], "at most 100"),
    ],
)
def test_key_frames_that_are_none_are_refused(editor, wrong, says):
    with pytest.raises(traitlets.TraitError, match=says):
        editor.key_frames = wrong
    assert editor.key_frames == ()


def test_key_frames_belong_to_their_photo(editor):
    editor.key_frames = [(0, sw.Edit()), (4, LOW)]
    other = sw.open(np.full((40, 60, 3), 90, np.uint8))
    first = editor.photo
    editor.open(other)
    assert editor.key_frames == ()
    editor.open(first)
    assert [edit for _, edit in editor.key_frames] == [sw.Edit(), LOW]
    editor.cancel()


def swept(monkeypatch):
    """Keep what a film would be made of, and make none."""
    asked = []
    monkeypatch.setattr(
        "sunwidget.film.sweep.sweep", lambda *given, **options: asked.append((given, options))
    )
    return asked


def test_a_film_goes_to_an_edit_a_preset_or_along_the_key_frames(editor, scene, monkeypatch):
    asked = swept(monkeypatch)
    editor.sun_elevation = 5
    editor.land_strength = 0.5
    start = editor.edit
    editor.sweep("a.mp4", to=LOW, fps=12)
    editor.sweep("a.mp4", to="sunset")
    editor.sweep("a.mp4")
    editor.key_frames = [(0, LOW), (3, sw.Edit(exposure=1))]
    editor.strokes = [{"label": "sky", "points": [[0.5, 0.1], [0.6, 0.1]], "radius": 0.02}]
    editor.sweep("a.mp4")
    (_, to_edit, _), options = asked[0]
    assert (to_edit, options) == ([start, LOW], {"fps": 12})
    assert asked[1][0][1] == [start, sw.preset("sunset", scene, start)]
    assert asked[2][0][1] == [sw.Edit(), start]
    along = asked[3][0][1]
    assert [seconds for seconds, _ in along] == [0.0, 3.0]
    # The stroke came after the key frames, and is in all of the film.
    assert along[0][1] == LOW.replace(strokes=editor.strokes)
    assert along[1][1] == sw.Edit(exposure=1, strokes=editor.strokes)
    with pytest.raises(EditError, match="either to= or key_frames="):
        editor.sweep("a.mp4", to=LOW, key_frames=[LOW, start])


def test_a_film_in_which_nothing_moves_is_refused(editor):
    with pytest.raises(EditError, match="Nothing moves"):
        editor.sweep("a.gif")


def test_the_panel_is_told_what_there_is(editor, tmp_path):
    told, _ = ask(editor, "exports")
    assert told["folder"] == str(tmp_path)
    assert told["size"] == list(editor.photo.size)
    tiff = next(kind for kind in told["stills"] if kind["suffix"] == ".tif")
    assert (tiff["bits"], tiff["layers"]) == ([8, 16, 32], True)
    assert {kind.suffix for kind in FILMS} == {".mp4", ".gif", ".webp", ".png"}
    assert len({kind.suffix for kind in STILLS}) == len(STILLS) == 6


def test_a_still_for_download_is_the_file_that_save_writes(editor, tmp_path):
    editor.edit = LOW
    answer, data = ask(editor, "still", name="low", suffix=".tif", bits=16, long_edge=96)
    picture = np.asarray(sw.open(data).encoded)
    assert answer == {
        "name": "low.tif", "type": "image/tiff", "bytes": len(data), "files": 1
    }  # fmt: skip
    expected = editor.save(tmp_path / "own.tif", bit_depth=16, size=editor.photo.size_within(96))
    assert np.array_equal(picture, sw.open(expected).encoded)
    assert max(picture.shape) == 96
    assert [path.name for path in tmp_path.iterdir()] == ["own.tif"]


def test_light_above_white_is_kept_where_the_format_holds_it(editor):
    editor.edit = LOW
    holds = {kind["suffix"]: kind["above_white"] for kind in ask(editor, "exports")[0]["stills"]}
    assert {suffix for suffix, held in holds.items() if held} == {".jpg", ".exr", ".hdr"}
    for suffix in (".jpg", ".png"):
        _, data = ask(editor, "still", name="a", suffix=suffix, above_white=True, long_edge=96)
        assert (sw.open(data).gain_map is not None) == holds[suffix]


def test_a_file_in_the_folder_is_never_replaced(editor, tmp_path):
    (tmp_path / "mine.png").write_bytes(b"mine")
    answer, data = ask(editor, "still", name="mine.png", suffix=".png", in_folder=True)
    assert (answer, data) == ({"taken": "mine.png", "free": "mine-2.png"}, b"")
    assert (tmp_path / "mine.png").read_bytes() == b"mine"
    answer, data = ask(editor, "still", name="mine-2.png", suffix=".png", in_folder=True)
    assert answer["path"] == str(tmp_path / "mine-2.png")
    assert data == b""
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mine-2.png", "mine.png"]
    assert Image.open(tmp_path / "mine-2.png").size == editor.photo.size


@pytest.mark.parametrize("name", ["", "../up", "a/b", "a\\b", ".", "nul\0", "%04d", "x" * 200, 7])
def test_names_that_lead_elsewhere_are_refused(editor, tmp_path, name):
    with pytest.raises(ValueError, match="cannot be a file's name"):
        ask(editor, "still", name=name, suffix=".png", in_folder=True)
    assert list(tmp_path.iterdir()) == []


def test_layers_and_frames_come_packed_or_lie_in_a_folder(editor, tmp_path):
    editor.edit = LOW
    answer, data = ask(editor, "still", name="low", suffix=".png", layers=True, long_edge=64)
    names = zipfile.ZipFile(io.BytesIO(data)).namelist()
    assert answer["name"] == "low.zip"
    assert answer["files"] == len(names) > 3
    assert {"low.png", "low.sky.png"} <= set(names)

    answer, data = film(editor, suffix=".png", in_folder=True, long_edge=64)
    assert (answer["files"], data) == (4, b"")
    frames = sorted((tmp_path / "evening").iterdir())
    assert [path.name for path in frames] == [f"{i:04d}.png" for i in range(1, 5)]
    again, _ = film(editor, suffix=".png", in_folder=True, long_edge=64)
    assert again == {"taken": "evening", "free": "evening-2"}
    assert [path.name for path in tmp_path.iterdir()] == ["evening"]


def test_a_film_is_sent_to_be_looked_at_also_from_the_folder(editor, tmp_path):
    editor.edit = LOW
    answer, data = film(editor, in_folder=True, long_edge=64, loop="there_and_back")
    assert data == (tmp_path / "evening.gif").read_bytes()
    assert Image.open(io.BytesIO(data)).n_frames == 6
    assert answer["bytes"] == len(data)


def test_a_film_of_the_places_day(editor):
    pytest.importorskip("pvlib")
    with pytest.raises(EditError, match="Set the photo's place"):
        film(editor, hours=[15.0, 18.0], long_edge=64)
    # Before midnight UTC, on a solar day that began the day before.
    editor.place = sw.Place(21.3, -157.9, "2024-06-22", 1.5, 270.0)
    # From 20:00 on the 21st to 04:00 on the 22nd, as the day's path counts it.
    day = _film_day(editor.edit, 20.0, 28.0)
    edits = day.edits(editor.scene, [0.0, 0.5, 1.0], lambda *_: None)
    assert [(edit.place.date, edit.place.time) for edit in edits] == [
        ("2024-06-21", 20.0),
        ("2024-06-22", 0.0),
        ("2024-06-22", 4.0),
    ]
    _, data = film(editor, hours=[20.0, 28.0], long_edge=64)
    assert Image.open(io.BytesIO(data)).n_frames == 4


@pytest.mark.parametrize("suffix", [".gif", ".png"])
def test_a_cancelled_film_leaves_nothing(editor, tmp_path, suffix):
    editor.edit = LOW

    def stop(fraction, _message):
        if fraction >= 0.5:
            raise Cancelled("Film was cancelled.")

    content = {"name": "a", "suffix": suffix, "fps": 4, "seconds": 1.0, "in_folder": True}
    with pytest.raises(Cancelled):
        editor._actions()["film"]({**content, "long_edge": 64}, stop)
    assert list(tmp_path.iterdir()) == []


def test_what_is_exported_is_what_the_browser_shows_though_its_traits_are_still_on_their_way(
    editor, monkeypatch
):
    asked = swept(monkeypatch)
    seen = sw.Edit(sun_elevation=3, exposure=0.37)
    about = {"recipe": seen.to_dict(), "photo": editor._source["fingerprint"]}
    kept = editor.edit
    _, data = ask(editor, "still", name="still", suffix=".png", **about)
    assert np.array_equal(np.asarray(Image.open(io.BytesIO(data))), editor._render(seen))
    _, page = ask(editor, "page", **about)
    assert b'"exposure":0.37' in page
    frames = [{"seconds": 0, "recipe": LOW.to_dict()}, {"seconds": 2, "recipe": {}}]
    film(editor, key_frames=frames, **about)
    assert asked[0][0][1] == [(0.0, LOW), (2.0, sw.Edit())]
    assert editor.edit == kept


def test_an_export_of_a_photo_that_is_no_longer_shown_is_refused(editor):
    with pytest.raises(ValueError, match="Another photo has been opened"):
        ask(editor, "still", name="still", suffix=".png", recipe={}, photo="another")


def test_a_closed_editor_ends_what_the_browser_asked_for_and_leaves_no_half_file(
    editor, tmp_path, monkeypatch
):
    began = threading.Event()

    def slow(_scene, _way, path, *, progress, **_options):
        path.write_bytes(b"half")
        began.set()
        for _ in range(600):
            progress(0.5, "Rendering …")
            time.sleep(0.01)

    monkeypatch.setattr("sunwidget.film.sweep.sweep", slow)
    editor.sun_elevation = 3
    threads = set(threading.enumerate())
    content = {"name": "evening", "suffix": ".gif", "in_folder": True}
    editor._requests(editor, {"type": "request", "id": "a", "action": "film"} | content, [])
    assert began.wait(60)
    editor.close()
    (thread,) = set(threading.enumerate()) - threads
    thread.join(60)
    assert not thread.is_alive()
    assert list(tmp_path.iterdir()) == []
