import datetime as dt
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from sunwidget.errors import PhotoError
from sunwidget.photo.photo import open_photo
from sunwidget.timelapses.frames import Clock, frame_sources, read_frame

UTC = dt.UTC
NAIVE = dt.datetime(2024, 6, 21, 12)  # noqa: DTZ001 - what a person may pass: it is UTC


@pytest.fixture
def folder(tmp_path):
    for name in ("img10.jpg", "img2.jpg", "IMG1.JPG", ".hidden.jpg", "notes.txt"):
        (tmp_path / name).write_bytes(b"")
    return tmp_path


def test_a_folder_and_a_glob_are_in_natural_order_and_hold_pictures_alone(folder):
    order = ["IMG1.JPG", "img2.jpg", "img10.jpg"]
    assert [path.name for path in frame_sources(folder)] == order
    assert [path.name for path in frame_sources(str(folder / "*.[jJ]*"))] == order


def test_a_sequence_keeps_its_own_order(folder):
    row = [folder / "img10.jpg", folder / "img2.jpg"]
    assert frame_sources(row) == row


def test_what_is_no_time_lapse_says_what_is(folder):
    with pytest.raises(ValueError, match="is one picture.*folder or a glob"):
        frame_sources(folder / "img2.jpg")
    with pytest.raises(FileNotFoundError, match="names no picture"):
        frame_sources(str(folder / "*.png"))
    with pytest.raises(FileNotFoundError, match="names one picture"):
        frame_sources(str(folder / "img1?.jpg"))
    for nothing in (3, None, [], [np.zeros((2, 2, 3), np.uint8)]):
        with pytest.raises(ValueError, match="two or more frames"):
            frame_sources(nothing)


def test_a_frame_is_shrunk_in_linear_light_and_keeps_what_its_file_tells(tmp_path):
    # Stripes of black and white: their mean light is half, code value 188.
    stripes = np.zeros((40, 60, 3), np.uint8)
    stripes[:, ::2] = 255
    exif = Image.Exif()
    exif[0x010F] = "Maker"
    Image.fromarray(stripes).save(tmp_path / "a.png", exif=exif)
    small = read_frame(tmp_path / "a.png", 30)
    assert small.size == (30, 20)
    assert abs(int(small.encoded[10, 15, 0]) - 188) <= 1
    assert small.exif is not None
    whole = read_frame(tmp_path / "a.png", None)
    assert np.array_equal(whole.encoded, stripes)


def test_frames_of_the_same_proportions_get_one_size_and_others_are_refused():
    like = (30, 20)
    for size in ((60, 40), (30, 20), (15, 10)):
        photo = open_photo(np.full((size[1], size[0], 3), 90, np.uint8))
        frame = read_frame(photo, None, like)
        assert frame.size == like
        assert np.abs(frame.encoded.astype(int) - 90).max() <= 1
    turned = open_photo(np.zeros((60, 40, 3), np.uint8))
    with pytest.raises(PhotoError, match="40×60.*aspect ratio of 30×20"):
        read_frame(turned, None, like)


def test_sixteen_bits_stay_more_than_eight():
    deep = np.linspace(20000, 20500, 64 * 64 * 3).reshape(64, 64, 3).astype(np.uint16)
    small = read_frame(open_photo(deep), 32)
    assert small.encoded.dtype == np.float32
    assert len(np.unique(small.encoded)) > 100


def test_times_come_from_a_pattern_a_pair_a_list_or_the_file(tmp_path):
    photo = open_photo(np.zeros((4, 4, 3), np.uint8))
    noon = dt.datetime(2024, 6, 21, 12, tzinfo=UTC)
    named = Clock("%Y%m%d_%H%M%S", 2)
    assert named(0, Path("20240621_120000.jpg"), photo) == noon
    with pytest.raises(ValueError, match="does not match the pattern"):
        named(0, Path("img1.jpg"), photo)
    paced = Clock((NAIVE, 30.0), 3)
    assert paced(2, None, photo) == noon + dt.timedelta(minutes=1)
    zone = dt.timezone(dt.timedelta(hours=2))
    listed = Clock([dt.datetime(2024, 6, 21, 14, tzinfo=zone)] * 2, 2)
    assert listed(1, None, photo) == noon
    assert Clock(None, 2)(0, None, photo) is None
    exif = Image.Exif()
    exif.get_ifd(0x8769)[0x9003] = "2024:06:21 14:00:00"
    exif.get_ifd(0x8769)[0x9011] = "+02:00"
    Image.new("RGB", (8, 8)).save(tmp_path / "a.jpg", exif=exif)
    assert Clock(None, 2)(0, None, open_photo(tmp_path / "a.jpg")) == noon


@pytest.mark.parametrize("times", [[], [NAIVE], (NAIVE, -3), 5 * [NAIVE]])
def test_times_that_do_not_fit_are_refused(times):
    with pytest.raises(ValueError, match="times= takes"):
        Clock(times, 3)
