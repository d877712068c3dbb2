"""Many photos with one recipe: what is done, what is skipped, what is refused, what is left."""

import csv
import json
import sys

import numpy as np
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.batches import develop, photos, record
from sunwidget.batches.report import BatchReport, BatchRow
from sunwidget.batches.request import Request
from sunwidget.cli.main import main

LOW = sw.Edit(sun_elevation=3)


@pytest.fixture
def folder(tmp_path):
    """Three small photos."""
    inside = tmp_path / "photos"
    inside.mkdir()
    for i in range(3):
        level = np.full((8, 12, 3), 60 * (i + 1), np.uint8)
        Image.fromarray(level).save(inside / f"{i}.png")
    return inside


@pytest.fixture
def quick(monkeypatch):
    """Pictures that tell their photo's bytes and recipe, made without analysis; the photos made."""
    made = []

    def save(job, photo, path, progress):
        made.append(photo.name)
        if progress:
            progress(0.5, "half")
        path.write_bytes(
            json.dumps([photo.read_bytes().hex(), job.request.edit.to_dict()]).encode()
        )
        return ("No sky found in it. Draw a stroke.",)

    monkeypatch.setattr(develop, "_save", save)
    return made


def run(folder, edit=LOW, out="out", **options):
    return sw.batch(folder, edit, folder.parent / out, workers=0, **options)


def left(folder, out="out"):
    return sorted(p.name for p in (folder.parent / out).iterdir())


def test_a_batch_makes_what_a_loop_makes(tmp_path):
    picture = sw.sample("coast").preview(96)
    Image.fromarray(picture).save(tmp_path / "coast.png")
    (tmp_path / "broken.png").write_bytes(b"nothing")
    report = sw.batch(tmp_path, LOW, tmp_path / "out", workers=0)
    plain = sw.save((sw.analyze(sw.open(tmp_path / "coast.png")), LOW), tmp_path / "plain.png")
    assert [row.state for row in report] == ["failed", "done"]
    assert "not a picture" in report.failed[0].error
    done = report.done[0].output
    np.testing.assert_array_equal(sw.open(done).encoded, sw.open(plain).encoded)
    assert sw.open(done).recipe == LOW
    # A preset looks at each photo, and a limit of the size keeps the recipe.
    report = sw.batch(tmp_path, "sunset", tmp_path / "small", workers=0, long_edge=48)
    assert sw.open(report.done[0].output).size[0] == 48
    assert sw.open(report.done[0].output).recipe.sun_elevation == pytest.approx(0.8)


def test_a_second_run_skips_what_is_there(folder, quick):
    assert [row.state for row in run(folder)] == ["done"] * 3
    again = run(folder)
    assert [row.state for row in again] == ["skipped"] * 3
    assert again.summary.startswith("3 photos: 0 done, 3 skipped, 0 failed in 0.")
    assert len(quick) == 3
    assert len(run(folder, resume=False).done) == 3


def test_a_lost_picture_a_changed_photo_and_a_changed_recipe_are_done_again(folder, quick):
    run(folder)
    (folder.parent / "out/0-sun.png").unlink()
    (folder / "1.png").write_bytes((folder / "2.png").read_bytes())
    quick.clear()
    assert [row.state for row in run(folder)] == ["done", "done", "skipped"]
    assert quick == ["0.png", "1.png"]
    assert len(run(folder, sw.Edit(sun_elevation=4)).done) == 3
    assert len(run(folder, sw.Edit(sun_elevation=4), analysis={"fov": 40}).done) == 3


def test_what_no_batch_wrote_is_kept_unless_asked(folder, quick):
    run(folder)
    touched = folder.parent / "out/1-sun.png"
    touched.write_bytes(b"retouched by hand")
    # By the same recipe it is done; by another one it would be lost.
    assert len(run(folder).skipped) == 3
    report = run(folder, sw.Edit(sun_elevation=5))
    assert [row.state for row in report] == ["done", "failed", "done"]
    assert "overwrite=True" in report.failed[0].error
    assert touched.read_bytes() == b"retouched by hand"
    assert len(run(folder, sw.Edit(sun_elevation=5), overwrite=True).done) == 1
    assert touched.read_bytes() != b"retouched by hand"


def test_a_failed_photo_does_not_stop_the_rest(folder, quick, monkeypatch):
    save = develop._save

    def fail(job, photo, path, progress):
        if photo.name == "1.png":
            raise sw.AnalysisError("The sun of 1.png\nis upside down. Turn it.")
        return save(job, photo, path, progress)

    monkeypatch.setattr(develop, "_save", fail)
    (folder / "2.png").unlink()
    report = run(folder)
    assert [row.state for row in report] == ["done", "failed"]
    assert report.failed[0].error == "The sun of 1.png is upside down. Turn it."
    assert report.failed[0].output is None
    # What failed is tried again, what is done is not.
    assert [row.state for row in run(folder)] == ["skipped", "failed"]


def test_a_machine_that_cannot_render_ends_the_batch(folder, quick, monkeypatch):
    def save(job, photo, path, progress):
        quick.append(photo.name)
        raise sw.RendererError("No EGL. Install it.")

    monkeypatch.setattr(develop, "_save", save)
    with pytest.raises(sw.RendererError, match="No EGL"):
        run(folder)
    assert quick == ["0.png"]


def test_a_worker_of_another_version_says_so(folder, quick):
    job = develop.Job(0, "0.png", "", "0-sun.png", Request(LOW), version="0.0.1")
    with pytest.raises(RuntimeError, match=r"the batch has 0\.0\.1"):
        develop.develop(job)


def test_a_missing_photo_is_a_row(folder, quick):
    report = sw.batch([folder / "0.png", folder / "no.png"], LOW, folder / "out", workers=0)
    assert [row.state for row in report] == ["done", "failed"]
    assert "no.png" in report.failed[0].error


@pytest.mark.parametrize("stop", [KeyboardInterrupt, RuntimeError])
def test_a_stopped_batch_leaves_whole_pictures_and_goes_on(folder, quick, stop):
    def progress(fraction, message):
        if fraction > 0.4:  # within the second photo
            raise stop

    with pytest.raises(stop):
        run(folder, progress=progress)
    assert left(folder) == [record.FILE_NAME, "0-sun.png"]
    assert [row.state for row in run(folder)] == ["skipped", "done", "done"]


def test_a_cut_record_costs_one_picture(folder, quick):
    run(folder)
    kept = folder.parent / "out" / record.FILE_NAME
    kept.write_bytes(kept.read_bytes()[:-20])
    report = run(folder)
    assert [row.state for row in report] == ["skipped", "skipped", "failed"]
    assert len(run(folder, overwrite=True).done) == 1
    assert len(run(folder).skipped) == 3


def test_pictures_beside_their_photos_are_no_photos(folder, quick):
    for states in (["done"] * 3, ["skipped"] * 3):
        report = sw.batch(str(folder / "*.png"), LOW, folder, workers=0)
        assert [row.state for row in report] == states


def test_a_photo_is_never_replaced(folder, quick):
    before = (folder / "0.png").read_bytes()
    report = sw.batch(folder, LOW, folder, name="{name}", overwrite=True, workers=0)
    assert len(report.failed) == 3
    assert "the photo itself" in report.failed[0].error
    assert (folder / "0.png").read_bytes() == before


def test_strokes_and_hints_stay_with_their_photo(folder, quick):
    edit = LOW.replace(strokes=(sw.Stroke("sky", ((0.5, 0.5),), 0.1),), fov_hint=40)
    run(folder, edit)
    told = json.loads((folder.parent / "out/0-sun.png").read_text())[1]
    assert told == LOW.to_dict()
    run(folder, edit, corrections=True)
    told = json.loads((folder.parent / "out/0-sun.png").read_text())[1]
    assert told == edit.to_dict()


def test_layers_come_along_with_the_picture(folder, quick, monkeypatch):
    def save(job, photo, path, progress):
        path.with_suffix(".sky.png").write_bytes(b"sky")
        path.write_bytes(b"all")
        return ()

    monkeypatch.setattr(develop, "_save", save)
    run(folder, layers=True)
    assert left(folder)[1:3] == ["0-sun.png", "0-sun.sky.png"]
    (folder.parent / "out/0-sun.sky.png").unlink()
    assert [row.state for row in run(folder, layers=True)] == ["done", "skipped", "skipped"]


def test_light_above_white_needs_a_format_that_holds_it(folder, quick):
    with pytest.raises(sw.PhotoError, match="light above white"):
        run(folder, headroom=3)
    with pytest.raises(sw.EditError, match="0 to 8"):
        run(folder, headroom=12, format="jpg")
    assert list(folder.parent.glob("out/*.*")) == []


def test_names_follow_the_template(tmp_path):
    found = [tmp_path / "a/beach.JPG", tmp_path / "b/beach.nef"]
    assert photos.names(found, "{folder}/{number:03}-{name}", None) == [
        "a/001-beach.jpg",
        "b/002-beach.tif",
    ]
    with pytest.raises(ValueError, match="would both be called beach-sun.png"):
        photos.names(found, "{name}-sun", "png")
    with pytest.raises(ValueError, match="unknown field {nam}. Known fields: {name}"):
        photos.names(found, "{nam}", None)
    with pytest.raises(ValueError, match="'gif' cannot be written"):
        photos.names(found, "{name}", "gif")
    for template in ("../{name}", "/{name}", "", "{folder}/"):
        with pytest.raises(ValueError, match="name"):
            photos.names(found, template, None)


def test_photos_are_found_once_each(folder, tmp_path, monkeypatch):
    odd = folder / "beach[1].png"
    odd.write_bytes((folder / "0.png").read_bytes())
    (folder / "notes.txt").write_text("no picture")
    monkeypatch.chdir(tmp_path)
    names = [p.name for p in photos.find(["photos/2.png", "photos", "photos/*.png", str(odd)])]
    assert names == ["2.png", "0.png", "1.png", "beach[1].png"]
    with pytest.raises(FileNotFoundError, match=r"No file matches photos/\*.tif"):
        photos.find("photos/*.tif")
    (tmp_path / "empty").mkdir()
    with pytest.raises(FileNotFoundError, match="no picture in the folder empty"):
        photos.find("empty")
    with pytest.raises(TypeError, match="takes paths"):
        photos.find([np.zeros((4, 4, 3))])


@pytest.mark.parametrize(
    ("arguments", "match"),
    [
        ({"qualty": 3}, "Did you mean 'quality'"),
        ({"analysis": {"fow": 3}}, "Did you mean 'fov'"),
        ({"workers": -1}, "workers must be a whole number"),
        ({"workers": 2, "scheduler": "tcp://127.0.0.1:1"}, "has its own"),
        ({"edit": "sunsett"}, "The presets are"),
        ({"edit": 3}, "not int"),
        ({"format": "jpg", "bit_depth": 16}, "16"),
    ],
)
def test_what_cannot_be_used_is_refused_before_any_work(folder, quick, arguments, match):
    given = {"edit": LOW, **arguments}
    with pytest.raises((TypeError, ValueError), match=match):
        sw.batch(folder, out=folder / "out", **given)
    assert not quick


def test_workers_without_dask_say_what_to_install(folder, quick, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ModuleNotFoundError, match=r"sunwidget\[batch\]"):
        sw.batch(folder, LOW, folder / "out", workers=2)
    report = sw.batch(folder, LOW, folder / "out")
    assert (len(report.done), report.where) == (3, "this process")


def test_a_report_tells_everything_and_executes_nothing(tmp_path):
    rows = (
        BatchRow(tmp_path / "<b>.png", tmp_path / "b.png", "done", 1.25, notes=("No sun. Do.",)),
        BatchRow(tmp_path / "c,d.png", None, "failed", error='It is "broken".'),
        *[BatchRow(tmp_path / f"{i}.png", tmp_path / f"{i}-sun.png", "skipped") for i in range(60)],
    )
    report = BatchReport(rows, 75.0, "2 worker processes")
    text = str(report)
    assert text.endswith("62 photos: 1 done, 60 skipped, 1 failed in 75.0 s (2 worker processes).")
    assert 'It is "broken".' in text
    assert "… and 22 more" in text
    page = report._repr_html_()
    assert "<td>&lt;b&gt;.png</td>" in page
    assert "<b>" not in page
    path = report.to_csv(tmp_path / "t.csv")
    with path.open(encoding="utf-8", newline="") as file:
        table = list(csv.DictReader(file))
    assert len(table) == 62
    assert (table[1]["error"], table[1]["photo"]) == (rows[1].error, str(rows[1].photo))
    assert table[0]["notes"] == "No sun. Do."
    with pytest.raises(FileExistsError):
        report.to_csv(path)


def test_the_command_goes_on_where_it_stopped(folder, quick, tmp_path, capsys):
    (tmp_path / "low.json").write_text(LOW.to_json())
    command = ["batch", str(folder / "*.png"), "--recipe", str(tmp_path / "low.json")]
    command += ["--exposure", "0.5", "-o", str(tmp_path / "out"), "--workers", "0"]
    command += ["--csv", str(tmp_path / "table.csv")]
    assert main(command) == 0
    told = json.loads((tmp_path / "out/0-sun.png").read_text())[1]
    assert told == LOW.to_dict()  # the flag wins when the photo is known
    assert "3 photos: 3 done, 0 failed" in capsys.readouterr().out
    (tmp_path / "out/2-sun.png").unlink()
    (folder / "1.png").write_bytes(b"changed")
    (tmp_path / "out/1-sun.png").write_bytes(b"changed")
    assert main(command) == 1
    out = capsys.readouterr().out
    assert "3 photos: 1 done, 1 skipped, 1 failed" in out
    assert main([*command, "--csv", str(folder / "0.png")]) == 2


def test_a_picture_that_cannot_be_recorded_is_failed_and_made_by_the_next_run(folder, quick):
    resource = pytest.importorskip("resource", reason="only Unix limits the size of files")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    room = 450  # bytes: each picture fits, the three lines of the record do not
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, hard))
    try:
        report = run(folder)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert list(report)[-1].state == "failed"
    assert "was not written: the file is too large" in report.failed[0].error
    assert len([name for name in left(folder) if name.endswith(".png")]) == len(report.done)
    again = run(folder)
    assert not again.failed
    assert len(again.skipped) == len(report.done)


def test_a_report_takes_names_that_no_terminal_should_obey(folder, quick):
    (folder / "0.png").rename(folder / "\x1b[2J\udcff.png")
    report = run(folder)
    assert "\x1b" not in str(report)
    path = report.to_csv(folder.parent / "report.csv")
    assert "\\udcff" in path.read_text("utf-8")
