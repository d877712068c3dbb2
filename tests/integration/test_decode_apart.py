"""A file is decoded in a process of its own: the same photo, and one that dies costs one file."""

import sys
import time
import warnings
from pathlib import Path

import numpy as np
import photo_corpus as corpus
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.batches import develop
from sunwidget.errors import PhotoError, PhotoWarning
from sunwidget.photo import decode_apart
from sunwidget.photo.decode_apart import open_apart, release
from sunwidget.photo.photo import open_photo
from sunwidget.timelapses.frames import read_frame
from sunwidget.widgets.editor.uploads import Uploads

# A child whose decoder does what a file's name says.
STAND_IN = """
import os, sys, time
from sunwidget.photo import decode_child
decode = decode_child.decode_bytes

def as_named(data, name):
    if name.startswith("crash"):
        os.abort()
    if name.startswith("hang"):
        time.sleep(600)
    if name.startswith("spin"):
        while True:
            pass
    if name.startswith("hog"):
        kept = []
        while True:
            kept.append(bytearray(100_000_000))
    if name.startswith("chatter"):
        os.write(1, b"a library's own words")
    if name.startswith("fault"):
        raise ZeroDivisionError("the reader's own fault")
    return decode(data, name)

decode_child.decode_bytes = as_named
decode_child.serve(int(sys.argv[1]), int(sys.argv[2]))
"""


@pytest.fixture
def stand_in(tmp_path, monkeypatch):
    """The child is one whose decoder does what a file's name says."""
    script = tmp_path / "stand_in.py"
    script.write_text(STAND_IN)
    release()
    monkeypatch.setattr(decode_apart, "_COMMAND", (sys.executable, "-P", str(script)))
    yield
    release()


def write(folder, name):
    path = Path(folder, name)
    Image.fromarray(corpus.ramp()).save(path)
    return path


def what_opening_gives(opening, data):
    """The photo or the error's text, and the notes."""
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        try:
            photo = opening(data)
        except PhotoError as error:
            return str(error), []
    return photo, [str(w.message) for w in heard if w.category is PhotoWarning]


FILES = {f"good-{name}": file.data for name, file in corpus.readable().items()}
FILES |= {f"bad-{name}": data for name, (data, _) in corpus.unreadable().items()}
FILES |= corpus.with_metadata()


@pytest.mark.parametrize("name", FILES)
def test_a_file_is_the_same_photo_or_error_as_in_this_process(name):
    here, notes = what_opening_gives(open_photo, FILES[name])
    apart, notes_apart = what_opening_gives(open_apart, FILES[name])
    if isinstance(here, str):
        assert apart == here
        return
    assert notes_apart == notes
    for field in ("name", "format", "icc", "exif", "xmp", "dpi", "facts", "turned", "recorded"):
        assert getattr(apart, field) == getattr(here, field)
    np.testing.assert_array_equal(apart.encoded, here.encoded)
    assert apart.encoded.dtype == here.encoded.dtype
    np.testing.assert_array_equal(apart.pixels, here.pixels)  # by the profile that came along
    assert apart.profile.name == here.profile.name
    np.testing.assert_array_equal(apart.alpha, here.alpha)
    assert not apart.encoded.flags.writeable


def test_what_is_no_file_is_opened_in_this_process(stand_in):
    photo = open_photo(corpus.ramp())
    assert open_apart(photo) is photo
    np.testing.assert_array_equal(open_apart(corpus.ramp()).encoded, photo.encoded)
    assert open_apart(Image.fromarray(corpus.ramp())).size == photo.size
    assert not decode_apart._kept


def test_the_process_is_kept_and_a_dead_one_replaced(tmp_path, stand_in):
    good, bad = write(tmp_path, "good.png"), write(tmp_path, "crash.png")
    open_apart(good)
    (first,) = decode_apart._kept
    open_apart(good)
    assert decode_apart._kept == [first]
    with pytest.raises(PhotoError, match=r"crash\.png crashed the process that read it \(SIGABRT"):
        open_apart(bad)
    assert open_apart(good).size == (32, 24)
    assert decode_apart._kept != [first]


def test_one_that_hangs_is_given_up(tmp_path, stand_in, monkeypatch):
    monkeypatch.setattr(decode_apart, "SECONDS", 1.5)
    begin = time.monotonic()
    with pytest.raises(PhotoError, match=r"hang\.png was stopped: .* longer than 1\.5 s"):
        open_apart(write(tmp_path, "hang.png"))
    assert time.monotonic() - begin < 30  # and not the 600 s that it sleeps
    monkeypatch.setattr(decode_apart, "SECONDS", 60.0)
    assert open_apart(write(tmp_path, "good.png")).size == (32, 24)


@pytest.mark.skipif(sys.platform == "win32", reason="no limit of processor time")
def test_one_that_spins_meets_its_limit_of_processor_time(tmp_path, stand_in, monkeypatch):
    monkeypatch.setattr(decode_apart, "_PROCESSOR", 1)
    with pytest.raises(PhotoError, match=r"spin\.png was stopped"):
        open_apart(write(tmp_path, "spin.png"))


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="no limit of address space")
def test_one_that_takes_all_memory_meets_its_limit(tmp_path, stand_in, monkeypatch):
    monkeypatch.setattr(decode_apart, "MEMORY", 1 << 30)
    with pytest.raises(PhotoError, match=r"not enough memory to open hog\.png"):
        open_apart(write(tmp_path, "hog.png"))
    assert open_apart(write(tmp_path, "good.png")).size == (32, 24)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="no limit of address space")
def test_a_picture_larger_than_the_memory_allowed_is_refused_in_words(monkeypatch):
    release()
    monkeypatch.setattr(decode_apart, "MEMORY", 100_000_000)
    black = corpus.png_file(np.zeros((8000, 8000, 3), np.uint8))  # 192 MB, in 200 kB
    with pytest.raises(PhotoError, match="memory"):
        open_apart(black)
    release()
    monkeypatch.setattr(decode_apart, "MEMORY", 4 << 30)
    assert open_apart(black).size == (8000, 8000)
    release()


def test_words_of_a_library_do_not_come_between_the_answers(tmp_path, stand_in):
    assert open_apart(write(tmp_path, "chatter.png")).size == (32, 24)


def test_a_fault_of_the_reader_itself_costs_its_file_alone(tmp_path, stand_in):
    with pytest.raises(PhotoError, match=r"fault\.png cannot be read \(the reader's own fault\)"):
        open_apart(write(tmp_path, "fault.png"))
    assert open_apart(write(tmp_path, "good.png")).size == (32, 24)


def test_an_answer_that_is_no_photo_is_not_taken(tmp_path, monkeypatch):
    liar = tmp_path / "liar.py"
    liar.write_text(
        "import sys, json, struct\n"
        "head = json.dumps({'shape': [10**9, 10**9, 3], 'dtype': 'object'}).encode()\n"
        "sys.stdout.buffer.write(struct.pack('>Q', len(head)) + head)\n"
        "sys.stdout.buffer.flush()\n"
        "sys.stdin.buffer.read()\n"
    )
    release()
    monkeypatch.setattr(decode_apart, "_COMMAND", (sys.executable, "-P", str(liar)))
    with pytest.raises(PhotoError, match="crashed the process that read it"):
        open_apart(write(tmp_path, "good.png"))
    release()


def test_a_batch_goes_on_after_a_photo_that_crashes_its_decoder(tmp_path, stand_in, monkeypatch):
    folder = tmp_path / "photos"
    folder.mkdir()
    for name in ("a.png", "crash.png", "z.png"):
        write(folder, name)
    monkeypatch.setattr("sunwidget.export.stills.save", lambda *_, **__: None)
    real = develop._save
    monkeypatch.setattr(develop, "_save", lambda *given: made(real, *given))
    report = sw.batch(folder, sw.Edit(sun_elevation=3), tmp_path / "out", workers=0)
    assert [row.state for row in report] == ["done", "failed", "done"]
    assert "crashed the process that read it" in report.failed[0].error


def made(real, job, photo, path, progress):
    """Open a photo as a batch does, and write a file without the time that drawing takes."""
    try:
        notes = real(job, photo, path, progress)
    finally:
        if not photo.name.startswith("crash"):
            path.write_bytes(b"drawn")
    return notes


def test_a_frame_that_crashes_its_decoder_is_one_that_cannot_be_read(tmp_path, stand_in):
    with pytest.raises(PhotoError, match="crashed the process"):
        read_frame(write(tmp_path, "crash.png"), None)
    assert read_frame(write(tmp_path, "next.png"), None).size == (32, 24)


def test_an_upload_that_crashes_its_decoder_is_refused_in_words(tmp_path, stand_in):
    opened = []
    data = write(tmp_path, "good.png").read_bytes()

    def upload(name):
        content = {"upload": name, "name": name, "size": len(data), "offset": 0}
        Uploads(opened.append)(content | {"buffers": [data]}, lambda *_: None)

    with pytest.raises(PhotoError, match=r"crash\.png crashed the process"):
        upload("crash.png")
    assert opened == []
    upload("good.png")
    assert [photo.size for photo in opened] == [(32, 24)]
    assert not decode_apart._kept  # an editor stays open for days


def test_after_a_batch_no_process_stays(tmp_path, monkeypatch):
    folder = tmp_path / "photos"
    folder.mkdir()
    write(folder, "a.png")
    monkeypatch.setattr(develop, "_save", save_what_was_opened)
    report = sw.batch(folder, sw.Edit(), tmp_path / "out", workers=0)
    assert [row.state for row in report] == ["done"]
    assert not decode_apart._kept


def save_what_was_opened(job, photo, path, progress):
    assert open_apart(photo).size == (32, 24)
    path.write_bytes(b"drawn")
    assert decode_apart._kept
    return ()


def test_a_phones_depth_and_gain_map_come_along():
    pytest.importorskip("pillow_heif")
    from heif_files import APPLE_GAIN_MAP, DEPTH, heic

    rows, columns = np.mgrid[:48, :64]
    levels = (rows * 4 + columns).astype(np.uint8)[::2, ::2]
    picture = np.dstack([rows * 3, columns * 3, rows + columns]).astype(np.uint8)
    told = b'<x:xmpmeta xmlns:x="adobe:ns:meta/" HDRGainMapHeadroom="4.0"/>'
    data = heic(picture, [(DEPTH, levels), (APPLE_GAIN_MAP, levels)], xmp=told)
    here, apart = open_photo(data), open_apart(data)
    assert here.depth is not None
    assert here.gain_map is not None
    assert apart.depth.kind == here.depth.kind
    np.testing.assert_array_equal(apart.depth.values, here.depth.values)
    assert apart.gain_map == here.gain_map
