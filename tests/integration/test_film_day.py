"""A real day as a film's path, contact sheets, and both on the command line."""

import numpy as np
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.analysis.heading import heading_by_sun
from sunwidget.cli import sweep
from sunwidget.cli.main import main
from sunwidget.film.path import film_edits
from sunwidget.geometry.place import Place, sun_at
from sunwidget.photo.place import from_photo

PRAGUE = Place(50.09, 14.42, "2024-03-20", 17.0, 262.5)


@pytest.fixture
def pvlib():
    return pytest.importorskip("pvlib")


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """A small copy of the coast with its EXIF, which tells place, time and heading."""
    photo = sw.sample("coast")
    path = tmp_path_factory.mktemp("photo") / "coast.png"
    Image.fromarray(photo.preview(160)).save(path, exif=photo.exif)
    return str(path)


@pytest.fixture(scope="module")
def scene(file):
    return sw.analyze(sw.open(file))


def test_the_hours_that_are_given_are_kept(pvlib, scene):
    row = film_edits(scene, sw.Day(PRAGUE, "15:00", 18.5), frames=8)
    assert [edit.place.time for edit in row] == [15, 15.5, 16, 16.5, 17, 17.5, 18, 18.5]
    for edit in row:
        sun = sun_at(edit.place)
        assert edit.sun_azimuth == pytest.approx(sun.azimuth, abs=1e-3)
        assert edit.sun_elevation == pytest.approx(sun.elevation, abs=1e-3)


def test_a_day_goes_from_civil_dawn_to_civil_dusk(pvlib, scene):
    for place in (PRAGUE, Place(-33.87, 151.21, "2024-06-21", 2.0, 0.0)):
        row = film_edits(scene, sw.Day(place), frames=31)
        heights = [edit.sun_elevation for edit in row]
        # Between the rows of five minutes, so to some hundredths of a degree.
        assert (heights[0], heights[-1]) == pytest.approx((-6, -6), abs=0.05)
        assert min(heights[1:-1]) > -6
        assert max(heights) > 30


def test_an_end_before_the_start_is_on_the_next_day(pvlib, scene):
    row = film_edits(scene, sw.Day(PRAGUE, start=22, end=2), frames=5)
    assert [(edit.place.date, edit.place.time) for edit in row] == [
        *(("2024-03-20", hour) for hour in (22, 23)),
        *(("2024-03-21", hour) for hour in (0, 1, 2)),
    ]


def test_the_photo_tells_place_and_heading(pvlib, scene):
    row = film_edits(scene, sw.Day(start=16, end=18), frames=3)
    place = row[0].place
    assert place.heading is not None
    assert place.heading == scene.photo.facts.heading


def test_without_a_heading_the_photos_own_sun_gives_it(pvlib, scene):
    bare = sw.analyze(scene.photo.preview(160))  # the same picture without its EXIF
    with pytest.raises(ValueError, match="Give the day its place"):
        film_edits(bare, sw.Day(), frames=3)
    told = from_photo(scene.photo).place
    place = told.replace(heading=None)
    found = film_edits(bare, sw.Day(place, 16, 18), frames=3)[0].place
    assert found.heading == heading_by_sun(bare, place).place.heading
    assert found.heading == pytest.approx(told.heading, abs=10)


def test_everything_but_the_sun_is_the_edits(pvlib, scene):
    start = sw.Edit(exposure=-1, cloud_opacity=1.5, sun_elevation=40)
    row = film_edits(scene, sw.Day(PRAGUE, 15, 17, start, start.replace(exposure=1)), frames=5)
    assert [edit.exposure for edit in row] == [-1, -0.5, 0, 0.5, 1]
    assert {edit.cloud_opacity for edit in row} == {1.5}
    assert row[0].sun_elevation == pytest.approx(
        sun_at(PRAGUE.replace(time=15)).elevation, abs=0.01
    )
    eased = film_edits(scene, sw.Day(PRAGUE, 15, 17), frames=5, easing="ease_in")
    assert eased[1].place.time < 15.4


def test_days_that_are_none_are_said(pvlib, scene):
    night = Place(80, 15, "2024-12-21", 11.0, 0.0)
    with pytest.raises(ValueError, match="6° below the horizon"):
        film_edits(scene, sw.Day(night), frames=3)
    assert film_edits(scene, sw.Day(night, 10, 14), frames=3)[1].sun_elevation == -12
    with pytest.raises(ValueError, match="same time"):
        film_edits(scene, sw.Day(PRAGUE, 12, "12:00"), frames=3)
    for wrong in ("noon", 25, -1, True, "12:99"):
        with pytest.raises(ValueError, match="time of day"):
            sw.Day(PRAGUE, start=wrong)
    with pytest.raises(ValueError, match=r"sunwidget\.Place"):
        sw.Day((50, 14))


def test_a_contact_sheet_shows_the_frames_of_the_film(scene, tmp_path):
    path = [sw.Edit(sun_elevation=20), sw.Edit(sun_elevation=-4)]
    out = tmp_path / "sheet.png"
    told = []
    whole = sw.contact_sheet(
        scene, path, out, frames=6, columns=3, progress=lambda *what: told.append(what)
    )
    assert np.array_equal(np.asarray(whole), np.asarray(Image.open(out).convert("RGB")))
    width, height = scene.camera.width, scene.camera.height
    assert whole.size[0] == pytest.approx(3 * width, abs=12)
    first = sw.render(scene, path[0], size=(width, height))
    assert np.array_equal(np.asarray(whole)[26 : 26 + height, :width], first)
    last = sw.render(scene, path[1], size=(width, height))
    assert np.array_equal(np.asarray(whole)[-height:, -width:], last)
    assert [fraction for fraction, _ in told] == pytest.approx([i / 6 for i in range(1, 7)])
    with pytest.raises(FileExistsError):
        sw.contact_sheet(scene, path, out)
    for wrong in ({"frames": 1}, {"frames": 10**6}, {"columns": 0}):
        with pytest.raises(ValueError, match="whole number"):
            sw.contact_sheet(scene, path, **wrong)


def frames_of(path):
    with Image.open(path) as film:
        return film.n_frames, film.size


@pytest.mark.parametrize(
    "flags",
    [
        ["--steps", "golden_hour", "sunset", "--seconds", "0.5", "--fps", "12"],
        ["--key-frame=0:sun_elevation=20", "--key-frame=0.5:sun-elevation=2", "--fps", "12"],
        ["--day", "--frames", "6"],
        ["--start-time", "15:00", "--end-time", "18:00", "--frames", "6"],
        ["--to-sun-elevation", "-4", "--frames", "4", "--loop", "there_and_back"],
    ],
)
def test_every_path_has_its_flags(request, scene, tmp_path, monkeypatch, flags):
    monkeypatch.setattr(sweep, "scene_to_draw", lambda _options: scene)
    if "--day" in flags or "--end-time" in flags:
        request.getfixturevalue("pvlib")
    film = tmp_path / "film.webp"
    assert main(["sweep", "x.png", "-o", str(film), "--size", "48x32", *flags]) == 0
    assert frames_of(film) == (6, (48, 32))


def test_a_sheet_and_frames_one_by_one(scene, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(sweep, "scene_to_draw", lambda _options: scene)
    ends = ["--to-sun-elevation", "-4", "--frames", "3", "--size", "48x32"]
    sheet, pattern = tmp_path / "sheet.png", tmp_path / "frames" / "%02d.png"
    assert main(["sweep", "x.png", "--sheet", str(sheet), "-o", str(pattern), *ends]) == 0
    assert sorted(p.name for p in pattern.parent.iterdir()) == ["01.png", "02.png", "03.png"]
    assert sheet.exists()
    said = capsys.readouterr().out
    assert str(pattern.parent) in said
    assert str(sheet) in said
    assert main(["sweep", "x.png", "-o", str(pattern), *ends]) == 2
    assert "exists already" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (["--steps", "dawn", "noon"], "Nothing to write"),
        (["-o", "x.avi", "--day"], "must end in .mp4"),
        (["-o", "x.gif", "--day", "--sun-elevation", "3"], "The clock moves the sun"),
        (["-o", "x.gif", "--steps", "dawn", "noon", "--to-exposure", "1"], "Leave one of them out"),
        (["-o", "x.gif", "--steps", "dawn", "--day"], "not allowed with"),
        (["-o", "x.gif", "--key-frame", "3"], "not of the form"),
        (["-o", "x.gif", "--key-frame", "x:sun_elevation=3"], "not of the form"),
        (["-o", "x.gif", "--key-frame", "1:sun_elevatoin=3"], "Did you mean 'sun_elevation'"),
        (["-o", "x.gif", "--key-frame", "1:method=thesis"], "is not a number"),
        (["-o", "x.gif", "--frames", "3", "--seconds", "2", "--day"], "not allowed with"),
    ],
)
def test_a_film_that_cannot_be_is_one_line(capsys, tmp_path, monkeypatch, flags, message):
    monkeypatch.chdir(tmp_path)
    try:
        status = main(["sweep", "no-such.jpg", *flags])
    except SystemExit as stop:
        status = stop.code
    said = capsys.readouterr().err
    assert status == 2
    assert message in said
    assert said.count("\n") == 1
