"""Where and when a photo was taken, where the sun then stands, and which way the camera looked."""

import datetime as dt
import json

import numpy as np
import photo_corpus as corpus
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.analysis.heading import heading_by_sun, match
from sunwidget.analysis.place_resolver import resolve_place
from sunwidget.cli import sweep
from sunwidget.cli.main import _parser, main
from sunwidget.cli.place_options import place_of, place_sun
from sunwidget.errors import EditError
from sunwidget.film.path import film_edits
from sunwidget.geometry.place import Place, at_hours, day_table, hours_of_day, solar_day, sun_at
from sunwidget.photo.place import date_and_hours, from_photo, zone_name

ITHACA = Place(42.4434, -76.482, "2024-06-21", 16.0, 180.0)
PRAGUE = Place(50.09, 14.42, "2024-03-20", 17.0, 270.0)
WHEN = {"date": "2024-06-21", "time": 2.0, "heading": None}
SYDNEY = Place(-33.87, 151.21, "2024-06-21", 2.0, 0.0)


@pytest.fixture
def pvlib():
    return pytest.importorskip("pvlib")


@pytest.fixture(scope="module")
def scene():
    """The coast, whose own file tells place, time and heading; small, and without its EXIF."""
    photo = sw.sample("coast")
    return sw.analyze(photo.preview(384), fov=photo.field_of_view.vertical)


def taken(clock="2024:03:20 18:00:00", offset=None, gps=None, pixels=None, **tags):
    """Open a photo that was taken so; black where no pixels are given."""
    shot = {} if clock is None else {0x9003: clock}
    if offset is not None:
        shot[0x9011] = offset
    block = corpus.exif_block(tags=tags or None, shot=shot, gps=gps)
    stored = np.zeros((30, 40, 3), np.uint8) if pixels is None else pixels
    return sw.open(corpus.png_file(stored, chunks=[(b"eXIf", block[6:])]))


def fix(latitude=50.09, longitude=14.42, time=None, date="2024:03:20", heading=None, north="T"):
    """GPS tags: a position, and what else is asked for."""
    tags = {
        1: "N" if latitude >= 0 else "S",
        2: (abs(latitude), 0.0, 0.0),
        3: "E" if longitude >= 0 else "W",
        4: (abs(longitude), 0.0, 0.0),
    }
    if time is not None:
        tags |= {7: tuple(map(float, time)), 29: date}
    if heading is not None:
        tags |= {16: north, 17: heading}
    return tags


# --- the place in the edit ---------------------------------------------------------------


def test_a_place_is_kept_in_recipe_and_code():
    edit = sw.Edit(place=PRAGUE, sun_elevation=3)
    assert sw.Edit.from_json(edit.to_json()) == edit
    assert eval(edit.to_code(), {"sw": sw}) == edit
    assert json.loads(edit.to_json())["place"] == {
        "latitude": 50.09,
        "longitude": 14.42,
        "date": "2024-03-20",
        "time": 17.0,
        "heading": 270.0,
    }
    assert sw.Edit(place={"latitude": 1, "longitude": 2, "date": "2024-03-20", "time": 3}) == (
        sw.Edit(place=Place(1.0, 2.0, dt.date(2024, 3, 20), 3.0))
    )


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"latitude": 91}, "latitude must be a number from -90 to 90"),
        ({"longitude": float("nan")}, "longitude must be a number from -180 to 180"),
        ({"date": "21.6.2024"}, "YYYY-MM-DD"),
        ({"date": "0003-01-01"}, "YYYY-MM-DD"),
        ({"time": 24.5}, "time must be a number from 0 to 24"),
        ({"time": "17:30"}, "time must be a number"),
        ({"heading": 400}, "heading must be a number"),
        ({"zone": 2}, "place needs latitude, longitude, date, time"),
    ],
)
def test_what_is_no_place_is_refused_in_words(changes, said):
    values = {"latitude": 50, "longitude": 14, "date": "2024-03-20", "time": 17} | changes
    with pytest.raises(EditError, match=said):
        sw.Edit(place=values)


@pytest.mark.parametrize("value", ["Prague", 3, [50, 14], {}, {"latitude": 50, "longitude": 14}])
def test_a_place_needs_all_its_parts(value):
    with pytest.raises(EditError, match="place needs"):
        sw.Edit(place=value)


# --- the sun over a place ----------------------------------------------------------------


def test_the_sun_stands_where_nrels_example_has_it(pvlib):
    # Reda & Andreas 2004, appendix A.5: azimuth 194.340241°, elevation without the air's lift
    # 39.872046°, 17 October 2003 at 12:30:30, seven hours behind UTC. The path is straight
    # between rows five minutes apart.
    place = Place(39.742476, -105.1786, "2003-10-17", 19 + 30.5 / 60, 0.0)
    sun = sun_at(place)
    assert sun.azimuth % 360 == pytest.approx(194.340241, abs=2e-3)
    assert sun.true_elevation == pytest.approx(39.872046, abs=2e-3)
    assert 0.01 < sun.elevation - sun.true_elevation < 0.03  # lifted by the air
    looking = sun_at(place.replace(heading=194.340241))
    assert looking.azimuth == pytest.approx(0, abs=2e-3)


@pytest.mark.parametrize("longitude", [-180, -119, -76, 0, 14, 77, 151, 180])
@pytest.mark.parametrize("time", [0, 3.3, 11.9, 17.2, 24])
def test_a_day_goes_from_night_to_night_wherever_it_is(pvlib, longitude, time):
    place = Place(35, longitude, "2024-03-20", time)
    table, hours = day_table(place), hours_of_day(place)
    assert table.shape == (289, 4)
    assert table[0, 0] - 1e-6 <= hours <= table[-1, 0] + 1e-6
    assert max(table[0, 2], table[-1, 2]) < -40  # begins and ends around the sun's midnight
    assert at_hours(place, hours).moment == place.moment


def test_times_that_neighbour_across_a_date_are_neighbours_on_the_path(pvlib):
    before = sun_at(Place(-33.87, 151.21, "2024-06-20", 23.999, 0.0))
    after = sun_at(Place(-33.87, 151.21, "2024-06-21", 0.001, 0.0))
    assert before.azimuth == pytest.approx(after.azimuth, abs=0.05)
    assert before.elevation == pytest.approx(after.elevation, abs=0.05)
    assert after.elevation > 20  # while UTC changes its date, the sun is high in Sydney
    assert solar_day(SYDNEY) == "2024-06-21"
    assert at_hours(SYDNEY, -3).date == "2024-06-20"


def test_without_a_heading_the_azimuth_is_unknown(pvlib):
    assert sun_at(PRAGUE.replace(heading=None)).azimuth is None


# --- what the file tells -----------------------------------------------------------------


def test_the_offset_that_the_file_names_gives_utc():
    found = from_photo(taken(offset="+01:00", gps=fix(time=(16, 58, 0))))
    assert found.source == "offset"
    assert found.moment == dt.datetime(2024, 3, 20, 17, tzinfo=dt.UTC)
    assert found.notes == ()
    assert found.place == Place(50.09, 14.42, "2024-03-20", 17.0)


def test_a_clock_without_a_zone_takes_it_from_the_gps():
    # The last fix is two minutes old: the zone is what it shows, the clock says the minute.
    found = from_photo(taken(gps=fix(time=(16, 58, 0))))
    assert found.source == "gps"
    assert found.moment == dt.datetime(2024, 3, 20, 17, tzinfo=dt.UTC)
    # Half an hour and a quarter are zones too, also across midnight.
    nepal = from_photo(taken("2024:03:21 01:45:00", gps=fix(27.7, 85.3, time=(20, 0, 0))))
    assert nepal.moment == dt.datetime(2024, 3, 20, 20, tzinfo=dt.UTC)


def test_a_clock_that_fits_no_zone_leaves_the_time_to_the_gps():
    found = from_photo(taken("2024:03:20 18:08:00", gps=fix(time=(17, 0, 30))))
    assert found.source == "gps"
    assert found.moment == dt.datetime(2024, 3, 20, 17, 0, 30, tzinfo=dt.UTC)


def test_a_zone_by_the_longitude_is_said_to_be_a_guess():
    found = from_photo(taken(gps=fix()))
    assert found.source == "longitude"
    assert found.moment == dt.datetime(2024, 3, 20, 17, tzinfo=dt.UTC)
    assert "UTC+1 is guessed" in found.notes[0]
    # The same for a place that a person gives.
    guessed = from_photo(taken(), longitude=-76.5)
    assert guessed.moment == dt.datetime(2024, 3, 20, 23, tzinfo=dt.UTC)


def test_a_clock_alone_gives_no_moment():
    found = from_photo(taken())
    assert found.moment is None
    assert found.place is None
    assert found.clock.isoformat() == "2024-03-20T18:00:00"
    assert "no time zone" in found.notes[0]


def test_a_heading_from_magnetic_north_is_said_to_be_one():
    assert from_photo(taken(gps=fix(heading=270.0))).notes[1:] == ()
    found = from_photo(taken(offset="+01:00", gps=fix(heading=270.0, north="M")))
    assert found.heading == 270
    assert "magnetic" in found.notes[0]


def test_a_receiver_without_a_fix_is_no_place_in_the_gulf_of_guinea():
    found = from_photo(taken(gps=fix(0, 0)))
    assert found.latitude is None
    assert found.longitude is None


def test_a_photo_without_exif_tells_nothing():
    found = from_photo(sw.open(np.zeros((8, 8, 3), np.uint8)))
    assert found == (None, None, None, None, None, "", ())
    # As does a clock that was never set.
    assert from_photo(taken("0001:01:01 00:00:00", gps=fix())).moment is None


def test_moments_and_zones_in_words():
    moment = dt.datetime(2024, 3, 20, 18, 30, tzinfo=dt.timezone(dt.timedelta(hours=2)))
    assert date_and_hours(moment) == ("2024-03-20", 16.5)
    assert [zone_name(h) for h in (0, 2, -3.5, 5.75)] == [
        "UTC+0",
        "UTC+2",
        "UTC-3:30",
        "UTC+5:45",
    ]


# --- the heading by the photo's sun ------------------------------------------------------


@pytest.mark.parametrize("place", [ITHACA, PRAGUE, SYDNEY])
def test_a_match_undoes_the_path(pvlib, place):
    sun = sun_at(place)
    found = match(place.replace(heading=None), sun.azimuth, sun.elevation)
    assert found.place.heading == pytest.approx(place.heading, abs=1e-3)
    assert found.mismatch == pytest.approx(0, abs=1e-9)
    assert found.agrees
    assert "agree" in found.note


def test_a_wrong_zone_is_found_by_the_elevation(pvlib):
    truth = sun_at(PRAGUE)
    early = PRAGUE.replace(time=PRAGUE.time - 2)  # two hours of zone forgotten
    found = match(early, truth.azimuth, truth.elevation)
    assert not found.agrees
    assert found.mismatch < -10
    best = found.agreeing[0]
    assert best.time == pytest.approx(PRAGUE.time, abs=0.01)
    assert best.heading == pytest.approx(PRAGUE.heading, abs=0.05)
    assert "17:00 UTC (2 h later)" in found.note
    assert "zone" in found.note
    # The sun is as high once more, in the morning.
    assert len(found.agreeing) == 2
    assert found.agreeing[1].time < 12


def test_an_elevation_that_the_day_does_not_reach_doubts_the_date(pvlib):
    found = match(PRAGUE.replace(date="2024-12-21", time=11.0), 5.0, 60.0)
    assert found.agreeing == ()
    assert "never at 60.0°: check the date and place" in found.note


def test_the_samples_heading_is_found_by_its_sun(pvlib, scene):
    told = from_photo(sw.sample("coast"))
    found = heading_by_sun(scene, told.place.replace(heading=None))
    turn = (found.place.heading - told.heading + 180) % 360 - 180
    assert abs(turn) < 2
    assert found.agrees
    assert found.seen


# --- one rule for every caller -----------------------------------------------------------

NO_REMEDY = dict.fromkeys(("latitude", "longitude", "date", "time", "heading"), "it")


def test_each_field_is_the_first_that_is_known():
    photo = taken(gps=fix(time=(17, 0, 0), heading=262.5))
    assert resolve_place(photo, NO_REMEDY).place == PRAGUE.replace(heading=262.5)
    edited = SYDNEY.replace(heading=None)
    found = resolve_place(photo, NO_REMEDY, given={"latitude": -30, "time": None}, place=edited)
    assert found.place == Place(-30, 151.21, "2024-06-21", 2.0, 262.5)
    assert resolve_place(photo, NO_REMEDY, place=edited, moved_to={"time": 9}).place.time == 9


def test_the_moment_at_which_a_photo_was_taken_is_not_the_one_to_which_the_sun_moves():
    photo, late = taken(gps=fix(time=(17, 0, 0))), PRAGUE.replace(time=20)
    found = resolve_place(photo, NO_REMEDY, place=late, moved_to={"date": "2024-06-21"})
    assert found.place.moment.isoformat() == "2024-06-21T20:00:00+00:00"
    assert found.taken == late.replace(time=17)
    # Who gives a time corrects the camera's clock; without any, the edit's is the best guess.
    assert resolve_place(photo, NO_REMEDY, given={"time": 16}).taken.time == 16
    assert resolve_place(taken(clock=None), NO_REMEDY, place=late).taken == late


def test_a_clock_without_a_zone_is_read_by_the_longitude_that_holds():
    found = resolve_place(taken(), NO_REMEDY, given={"latitude": 50, "longitude": 14, "heading": 0})
    assert found.place == Place(50, 14, "2024-03-20", 17.0, 0)
    assert "guess" in found.notes[0]
    assert resolve_place(taken(), NO_REMEDY, place=SYDNEY).taken.time == 8


def test_what_is_missing_is_said_with_its_remedy():
    remedies = {**NO_REMEDY, "date": "a date", "time": "a time", "heading": "a heading"}
    bare = taken(clock=None)
    with pytest.raises(ValueError, match=r"longitude, date and time\. Give it, a date and"):
        resolve_place(bare, remedies, given={"latitude": 50})
    moved_to = {"date": "2024-06-21", "time": 12}
    with pytest.raises(ValueError, match=r"heading is found by .* Give a heading\."):
        resolve_place(bare, remedies, given={"latitude": 50, "longitude": 14}, moved_to=moved_to)


def test_editor_film_and_command_line_resolve_alike(pvlib, scene):
    told = from_photo(sw.sample("coast")).place
    position = fix(told.latitude, told.longitude)
    photo = taken("2025:09:27 17:41:51", "+01:00", position, scene.photo.encoded)
    again = sw.analyze(photo, fov=scene.camera.fov_vertical_deg)
    editor = editor_of(again)
    editor.set_place()
    assert editor.place.heading == pytest.approx(told.heading, abs=2.5)
    options = _parser().parse_args(["sweep", "x.png", "--day", "-o", "x.gif"])
    assert place_of(options, again, sw.Edit()) == editor.place
    by_film = film_edits(again, sw.Day(), frames=2)[0].place
    assert (by_film.heading, by_film.latitude) == (editor.place.heading, editor.place.latitude)


# --- in the editor -----------------------------------------------------------------------


def editor_of(scene, **options):
    return sw.SunEditor(scene, **options).wait()


def test_the_clock_moves_the_sun_and_the_place_in_one_step(pvlib, scene):
    editor = editor_of(scene, place=PRAGUE)
    picture = editor.render(size=(96, 64))
    editor.time = 16.0
    expected = sun_at(PRAGUE.replace(time=16.0))
    assert editor.place == PRAGUE.replace(time=16.0)
    assert editor.sun_azimuth == pytest.approx(expected.azimuth, abs=1e-4)
    assert editor.sun_elevation == pytest.approx(expected.elevation, abs=1e-4)
    assert editor.edit == sw.Edit(place=PRAGUE).at(editor.place)
    editor.undo()
    assert editor.edit == sw.Edit(place=PRAGUE)
    assert np.array_equal(editor.render(size=(96, 64)), picture)
    editor.redo()
    assert editor.time == 16.0


def test_a_place_alone_changes_no_pixel(scene):
    assert np.array_equal(
        sw.render(scene, sw.Edit(place=PRAGUE), size=(96, 64)),
        sw.render(scene, sw.Edit(), size=(96, 64)),
    )


def test_without_a_heading_the_clock_moves_the_elevation_alone(pvlib, scene):
    editor = editor_of(scene, place=PRAGUE.replace(heading=None))
    editor.time = 12.0
    assert editor.sun_azimuth is None
    assert editor.sun_elevation == pytest.approx(sun_at(PRAGUE.replace(time=12.0)).elevation)


def test_the_night_stays_within_what_an_edit_takes(pvlib):
    assert sw.Edit().at(PRAGUE.replace(time=0.0)).sun_elevation == -12


def test_the_browser_gets_the_day_of_the_place(pvlib, scene):
    editor = editor_of(scene)
    assert editor._day == {}
    editor.place = SYDNEY
    assert editor._day["key"] == [-33.87, 151.21, "2024-06-21"]
    assert editor._day["path"] == day_table(SYDNEY).tolist()
    # The clock alone, also over UTC's midnight, needs no other path.
    before = editor._day
    editor.time = 0.5
    editor.place = editor.place.replace(date="2024-06-20", time=23.0)
    assert editor._day is before
    editor.undo()
    editor.place = None
    assert editor._day == {}


def test_a_place_from_the_browser_is_answered_with_its_day(pvlib, scene, monkeypatch):
    editor = editor_of(scene)
    sent = []
    monkeypatch.setattr(editor, "send_state", lambda key=None: sent.append(key))
    editor.set_state({"place": {"latitude": -33.87, "longitude": 151.21, **WHEN}})
    assert editor.place == Place(-33.87, 151.21, "2024-06-21", 2.0)
    assert editor._day["path"] == day_table(SYDNEY).tolist()
    assert any("_day" in keys for keys in sent)
    # What is no place is answered, and the place stays.
    said = []
    monkeypatch.setattr(editor, "send", lambda content, buffers=None: said.append(content))
    editor.set_state({"place": {"latitude": 500, "longitude": 151.21, **WHEN}})
    assert "latitude must be a number" in said[0]["error"]
    assert editor.place.latitude == -33.87


def test_a_page_that_is_made_at_once_has_the_path(pvlib, scene):
    assert editor_of(scene, place=SYDNEY).get_state()["_day"]["path"] == day_table(SYDNEY).tolist()


def test_without_pvlib_there_is_a_place_but_no_clock(scene, monkeypatch):
    editor = editor_of(scene)
    monkeypatch.setitem(__import__("sys").modules, "pvlib", None)
    editor.place = PRAGUE.replace(latitude=12.3456)  # a path that is not remembered
    assert "pip install 'sunwidget[solar]'" in editor._day["error"]
    assert "path" not in editor._day
    with pytest.raises(ImportError, match="solar"):
        editor.time = 12
    assert editor.edit == sw.Edit(place=PRAGUE.replace(latitude=12.3456))


def test_a_place_is_completed_by_the_photos_file(pvlib):
    photo = taken(gps=fix(time=(17, 0, 0), heading=262.5))
    editor = sw.SunEditor(photo)
    assert editor._photo_place["heading"] == 262.5
    assert editor.place is None  # told, not set: an edit that names nothing moves nothing
    editor.set_place()
    assert editor.place == Place(50.09, 14.42, "2024-03-20", 17.0, 262.5)
    editor.set_place(heading=270)
    assert editor.place.heading == 270
    assert editor.place.time == 17.0
    editor.time = 17.5
    assert editor.sun_azimuth == pytest.approx(sun_at(editor.place).azimuth, abs=1e-4)


def test_what_neither_file_nor_person_says_is_asked_for(scene):
    editor = editor_of(scene)
    with pytest.raises(EditError, match="its latitude, longitude, date and time"):
        editor.set_place()
    with pytest.raises(EditError, match="date and time"):
        editor.set_place(50, 14)
    with pytest.raises(EditError, match="latitude must be a number"):
        editor.set_place(500, 14, "2024-03-20", 17, 0)
    editor.set_place(50, 14, "2024-03-20", 17, 0)
    with pytest.raises(EditError, match="time must be a number from 0 to 24"):
        editor.time = 25


def test_the_heading_that_is_missing_is_found_by_the_sun(pvlib, scene):
    editor = editor_of(scene)
    told = from_photo(sw.sample("coast")).place
    editor.set_place(told.latitude, told.longitude, told.date, told.time)
    assert editor.place.heading == pytest.approx(told.heading, abs=2.5)
    # The photo's own sun is where the clock puts it at the photo's own time.
    editor.time = told.time
    assert editor.sun_azimuth == pytest.approx(scene.automatic["sun_azimuth"], abs=1e-3)
    # An hour's error of the clock is found and can be mended.
    editor.set_place(time=told.time - 1, heading=0)
    found = editor.heading_by_sun()
    assert not found.agrees
    assert "1 h later" in found.note
    editor.place = found.agreeing[0]
    assert editor.place.heading == pytest.approx(told.heading, abs=3.5)


# --- on the command line -----------------------------------------------------------------


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """A small copy of the coast with its EXIF."""
    photo = sw.sample("coast")
    path = tmp_path_factory.mktemp("photo") / "coast.png"
    Image.fromarray(photo.preview(240)).save(path, exif=photo.exif)
    return path


def test_a_time_on_the_command_line_puts_the_sun_there(pvlib, file, tmp_path):
    output = tmp_path / "evening.png"
    assert main(["render", str(file), "--time", "17:45", "-o", str(output)]) == 0
    scene = sw.analyze(sw.open(file))
    place = from_photo(scene.photo).place.replace(time=17.75)
    expected = sw.render(scene, sw.Edit().at(place))
    assert np.array_equal(np.asarray(Image.open(output)), expected)
    assert sw.open(output).recipe.place.time == 17.75
    # Elsewhere the sun is elsewhere, at the photo's own time.
    flags = ["--place", "-33.9,18.4", "--date", "2024-12-21", "--heading", "200"]
    options = _parser().parse_args(["render", str(file), *flags, "-o", "x.png"])
    there = Place(-33.9, 18.4, "2024-12-21", 16.6975, 200.0)
    assert place_sun(options, scene, sw.Edit()) == sw.Edit().at(there)


def test_a_film_of_the_day_keeps_the_sun_on_its_path(pvlib, file):
    flags = ["--time", "15:00", "--to-time", "19:00", "--to-exposure", "1"]
    options = _parser().parse_args(["sweep", str(file), *flags, "-o", "x.gif"])
    scene = sw.analyze(sw.open(file))
    path = sweep._path(options, scene, place_sun(options, scene, sw.Edit()))
    edits = film_edits(scene, path, frames=5)
    assert [edit.place.time for edit in edits] == [15, 16, 17, 18, 19]
    assert [edit.exposure for edit in edits] == [0, 0.25, 0.5, 0.75, 1]
    for edit in edits:
        assert edit.sun_azimuth == pytest.approx(sun_at(edit.place).azimuth, abs=1e-4)


def test_the_command_line_says_what_is_missing(pvlib, tmp_path, capsys, scene):
    plain = tmp_path / "plain.png"
    Image.fromarray(scene.photo.preview(96)).save(plain)
    output = ["-o", str(tmp_path / "x.png")]
    assert main(["render", str(plain), "--time", "12:00", *output]) == 2
    said = capsys.readouterr().err
    assert "latitude, longitude and date. Give --place LAT,LON and --date YYYY-MM-DD." in said
    assert said.count("\n") == 1  # before the analysis, and so without what that warns of
    assert main(["render", str(plain), "--place", "50,14", *output]) == 2
    assert "Give --date YYYY-MM-DD and --time HH:MM." in capsys.readouterr().err
    known = ["--place", "50,14", "--date", "2024-06-21", "--time", "12:00"]
    assert main(["render", str(plain), *known, *output]) == 2
    assert "Give --heading" in capsys.readouterr().err
    assert not (tmp_path / "x.png").exists()
    for wrong in (["--time", "25:10"], ["--place", "95,3"], ["--heading", "x"], ["--date", "1.2."]):
        with pytest.raises(SystemExit):
            main(["render", str(plain), *wrong, *output])
        assert f"argument {wrong[0]}" in capsys.readouterr().err
