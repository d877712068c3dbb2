"""Camera raw files: light in proportion, upright, with the camera's facts; or a clear sentence."""

import sys

import numpy as np
import pytest
import raw_files

from sunwidget.errors import PhotoError
from sunwidget.export.stills import save
from sunwidget.formats import exif
from sunwidget.photo.photo import open_photo

INSIDE = slice(4, -4)


@pytest.fixture(autouse=True)
def _libraw():
    pytest.importorskip("rawpy", reason="the extra 'raw' is not installed")


@pytest.mark.parametrize("top", [0.5, 0.85])
def test_a_raw_file_is_opened_as_linear_light(top):
    light = raw_files.ramp(top=top)
    photo = open_photo(raw_files.dng(light))
    assert (photo.format, photo.bit_depth, photo.profile.is_srgb) == ("RAW", 16, True)
    np.testing.assert_allclose(photo.pixels[INSIDE, INSIDE], light[INSIDE, INSIDE], atol=3e-4)


@pytest.mark.parametrize(("way", "turns"), [(1, 0), (3, 2), (6, 3), (8, 1)])
def test_a_turned_raw_file_is_upright_once(tmp_path, way, turns):
    light = raw_files.ramp()
    photo = open_photo(raw_files.dng(light, way))
    assert photo.turned == (way in (6, 8))
    upright = np.rot90(light, turns)
    np.testing.assert_allclose(photo.pixels[INSIDE, INSIDE], upright[INSIDE, INSIDE], atol=3e-4)
    again = open_photo(save(photo, tmp_path / "out.tif"))
    assert np.array_equal(again.encoded, photo.encoded)
    assert exif.load(again.exif).get(274, 1) == 1


def test_what_the_raw_file_tells_is_kept_and_how_it_stores_is_not(tmp_path):
    photo = open_photo(raw_files.dng(raw_files.ramp()))
    kept = dict(exif.load(open_photo(save(photo, tmp_path / "out.png")).exif))
    assert (kept[271], kept[272], kept[305]) == ("Maker", "Test camera", "Firmware 2")
    assert not {33421, 33422, 50706, 50721, 273} & set(kept)


def test_the_name_tells_a_raw_file_whose_bytes_look_like_a_tiff(tmp_path):
    path = tmp_path / "photo.NEF"
    path.write_bytes(raw_files.dng(raw_files.ramp()).replace(b"\x12\xc6\x01\0", b"\x13\xc6\x01\0"))
    assert open_photo(path).format == "RAW"


def test_a_damaged_raw_file_says_what_to_do():
    data = raw_files.dng(raw_files.ramp())
    with pytest.raises(PhotoError, match=r"LibRaw .* cannot read|damaged"):
        open_photo(data[: len(data) // 3])


def test_without_the_extra_the_message_names_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "rawpy", None)
    with pytest.raises(PhotoError, match=r"camera raw file.*pip install 'sunwidget\[raw\]'"):
        open_photo(raw_files.dng(raw_files.ramp()))
