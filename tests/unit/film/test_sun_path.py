"""From what a person names to the edit of each frame."""

from types import SimpleNamespace

import numpy as np
import pytest

from sunwidget import presets
from sunwidget.edit.table import Edit, Stroke
from sunwidget.errors import EditError
from sunwidget.film import path
from sunwidget.film.path import EASINGS, between, film_edits

SCENE = SimpleNamespace(automatic={"sun_azimuth": 10.0, "sun_elevation": 20.0}, lit_by_moon=False)
CORRECTED = SimpleNamespace(
    automatic={"sun_azimuth": -5.0, "sun_elevation": 2.0}, lit_by_moon=False
)


@pytest.fixture(autouse=True)
def corrections(monkeypatch):
    """A hint at the sun makes another scene; nothing else corrects this one."""
    monkeypatch.setattr(path, "corrected", lambda s, edit: CORRECTED if edit.sun_hint else s)


ENDS = [Edit(sun_elevation=60), Edit(sun_elevation=0)]
CORNERS = [Edit(sun_elevation=10), Edit(sun_elevation=40), Edit(sun_elevation=0)]


def elevations(path, **options):
    return [edit.sun_elevation for edit in film_edits(SCENE, path, **options)]


def test_a_path_visits_every_edit_and_keeps_its_ends():
    assert elevations(CORNERS, frames=5) == [10, 25, 40, 20, 0]


def test_a_row_of_edits_is_one_frame_each():
    assert film_edits(SCENE, CORNERS) == CORNERS
    assert film_edits(SCENE, tuple(CORNERS)) == CORNERS
    assert len(film_edits(SCENE, CORNERS, seconds=2, fps=10)) == 20
    with pytest.raises(ValueError, match="one frame each"):
        film_edits(SCENE, CORNERS, easing="ease_in")


def test_two_edits_become_five_seconds():
    assert len(film_edits(SCENE, ENDS)) == 120
    assert len(film_edits(SCENE, ENDS, seconds=1.5, fps=30)) == 45


def test_recipes_files_and_presets_are_steps(tmp_path, monkeypatch):
    monkeypatch.setattr(presets, "azimuth", lambda preset, scene: 4.0)
    file = tmp_path / "low.json"
    file.write_text(Edit(sun_elevation=2, light_source="sun").to_json())
    path = [Edit(), {"version": 1, "sun_elevation": 30}, file, str(file), "sunset"]
    row = film_edits(SCENE, path, frames=5)
    assert [edit.sun_elevation for edit in row] == [None, 30, 2, 2, 0.8]
    assert row[4].exposure == presets.find("sunset").parameters["exposure"]
    # A row of names is a path of five seconds, never a film of so many frames.
    assert len(film_edits(SCENE, ["dawn", "noon", "sunset"])) == 120


def test_the_photos_own_light_by_any_name_joins_edits_and_presets():
    row = film_edits(SCENE, [Edit(), Edit(sun_elevation=3, light_source="sun")], frames=3)
    assert {edit.light_source for edit in row} == {"sun"}
    with pytest.raises(EditError, match='light_source, not "sun" and "moon"'):
        film_edits(SCENE, [Edit(), Edit(light_source="moon")], frames=3)


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ([Edit(), "sunst"], "neither a recipe file nor a preset"),
        ([Edit(), "none.json"], "no recipe file"),
        ([Edit(), {"sun_elevatoin": 3}], "Did you mean"),
        ([Edit(), 7], "A step of a path is"),
        ("sunset", "not one str"),
        (None, "not one NoneType"),
        ([(0, Edit()), Edit()], "Either every step"),
        ([(1, Edit()), (1, Edit(exposure=1))], "must increase"),
        ([(-1, Edit()), (1, Edit())], "must increase"),
        ([(0, Edit()), (float("nan"), Edit())], "must increase"),
        ([(0, Edit())], "two or more"),
    ],
)
def test_what_is_no_path_is_said(path, message):
    with pytest.raises(ValueError, match=message):
        film_edits(SCENE, path, frames=3)


def test_key_frames_are_reached_at_their_seconds_and_the_first_is_held():
    keys = [(1, Edit(sun_elevation=10)), (3, Edit(sun_elevation=30)), (4, Edit(sun_elevation=0))]
    row = elevations(keys, fps=10)
    assert len(row) == 40
    at = dict(zip(np.linspace(0, 4, 40).round(9), row, strict=True))
    wanted = np.interp(list(at), [0, 1, 3, 4], [10, 10, 30, 0])
    assert list(at.values()) == pytest.approx(wanted)
    assert elevations(keys, frames=5) == [10, 10, 20, 30, 0]
    assert len(elevations(keys, seconds=8, fps=10)) == 80


@pytest.mark.parametrize("easing", EASINGS)
def test_every_easing_begins_and_ends_exactly_and_never_turns_back(easing):
    row = elevations(ENDS, frames=101, easing=easing)
    assert (row[0], row[-1]) == (60, 0)
    assert (np.diff(row) < 0).all()


def test_easings_are_those_of_css():
    # cubic-bezier(0.42, 0, 1, 1), (0, 0, 0.58, 1) and (0.42, 0, 0.58, 1), solved for a quarter.
    assert EASINGS["ease_in"](0.25) == pytest.approx(0.0934, abs=2e-4)
    assert EASINGS["ease_out"](0.25) == pytest.approx(0.3781, abs=2e-4)
    assert EASINGS["ease_in_out"](0.25) == pytest.approx(0.1292, abs=2e-4)
    for share in (0.1, 0.5, 0.8):
        assert EASINGS["ease_in"](share) == pytest.approx(1 - EASINGS["ease_out"](1 - share))


def test_smooth_passes_key_frames_without_a_stop_and_never_beyond_them():
    corners = [Edit(sun_elevation=e) for e in (0, 10, 40, 40, 20)]
    row = np.array(elevations(corners, frames=81, easing="smooth"))
    assert row[::20] == pytest.approx([0, 10, 40, 40, 20])
    assert (np.diff(row[:41]) > 0).all()
    assert np.diff(row)[18:22].min() > 0.3  # it does not stop at the second
    assert row[40:61] == pytest.approx(40)
    eased = np.array(elevations(corners, frames=81, easing="ease_in_out"))
    assert np.diff(eased)[19:21].max() < 0.2  # as easing does


def test_an_automatic_end_stands_for_what_the_analysis_found():
    half = between(Edit(), Edit(sun_elevation=0), 0.5, SCENE)
    assert half.sun_elevation == 10
    assert half.sun_azimuth is None


def test_the_ends_are_the_edits_themselves():
    row = film_edits(SCENE, [Edit(), Edit(sun_elevation=0)], frames=3)
    assert row[0] == Edit()
    assert row[-1] == Edit(sun_elevation=0)


def test_azimuth_takes_the_shorter_way_round_all_along():
    half = between(Edit(sun_azimuth=170), Edit(sun_azimuth=-160), 0.5, SCENE)
    assert half.sun_azimuth == pytest.approx(-175)
    corners = [Edit(sun_azimuth=a) for a in (150, -170, -100, 60)]
    for easing in ("linear", "smooth"):
        row = [e.sun_azimuth for e in film_edits(SCENE, corners, frames=61, easing=easing)]
        steps = (np.diff(row) + 180) % 360 - 180
        assert np.abs(steps).max() < 16
        assert (steps > 0).all()


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"method": "thesis"}, 'same method, not "ratio" and "thesis"'),
        ({"strokes": (Stroke("sky", ((0.5, 0.5),)),)}, "same strokes"),
        ({"fov_hint": 40.0}, "same fov_hint"),
    ],
)
def test_ends_that_nothing_lies_between_are_refused(changes, message):
    with pytest.raises(EditError, match=message):
        between(Edit(), Edit(**changes), 0.5, SCENE)


def test_what_is_automatic_follows_the_hints_of_the_edits():
    hint = Edit(sun_hint=(0.4, 0.5))
    middle = between(hint, hint.replace(sun_elevation=10), 0.5, SCENE)
    assert middle.sun_elevation == pytest.approx(6.0)  # from 2, as the hint has it, not from 20
    assert middle.sun_azimuth is None
