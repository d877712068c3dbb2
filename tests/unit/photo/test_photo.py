import base64
import io
import os
import pickle
import warnings

import numpy as np
import photo_corpus as corpus
import pytest
from PIL import Image

from sunwidget.errors import PhotoError, PhotoWarning
from sunwidget.formats.color import linear_to_srgb, srgb_to_linear
from sunwidget.photo.photo import Photo, open_photo

READABLE = corpus.readable()
UNREADABLE = corpus.unreadable()


def opened_with_notes(source):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        photo = open_photo(source)
    return photo, [str(w.message) for w in caught if w.category is PhotoWarning]


# --- files -----------------------------------------------------------------------------


@pytest.mark.parametrize("name", READABLE)
def test_every_kind_of_good_file_opens_with_the_right_pixels(name):
    wanted = READABLE[name]
    photo, notes = opened_with_notes(wanted.data)
    assert photo.encoded.dtype == wanted.codes.dtype
    assert photo.encoded.shape == wanted.codes.shape
    difference = np.abs(photo.encoded.astype(float) - wanted.codes)
    assert difference.max() <= wanted.tolerance
    if wanted.alpha is None:
        assert photo.alpha is None
    else:
        assert photo.alpha.dtype == np.float32
        np.testing.assert_allclose(photo.alpha, wanted.alpha, atol=1e-7)
    if wanted.note is None:
        assert notes == []
    else:
        assert wanted.note in notes[0]
        assert photo.notes == tuple(notes)


@pytest.mark.parametrize("name", READABLE)
def test_every_good_file_has_finite_light_and_a_preview(name):
    photo, _ = opened_with_notes(READABLE[name].data)
    height, width = READABLE[name].codes.shape[:2]
    assert photo.size == (width, height)
    assert photo.pixels.shape == (height, width, 3)
    assert photo.pixels.dtype == np.float32
    assert np.isfinite(photo.pixels).all()
    preview = photo.preview(16)
    assert preview.dtype == np.uint8
    assert max(preview.shape[:2]) == min(16, max(height, width))
    assert min(preview.shape[:2]) >= 1


@pytest.mark.parametrize("name", UNREADABLE)
def test_every_kind_of_bad_file_says_what_is_wrong(name):
    data, message = UNREADABLE[name]
    with pytest.raises(PhotoError, match=message) as caught:
        open_photo(data)
    # A sentence that ends, and names the picture.
    assert str(caught.value).startswith("picture ")
    assert str(caught.value).endswith(".")


def test_a_wrong_extension_does_not_matter(tmp_path):
    path = tmp_path / "photo.jpg"
    path.write_bytes(READABLE["png_16"].data)
    photo = open_photo(path)
    assert photo.format == "PNG"
    assert photo.name == "photo.jpg"
    assert photo.bit_depth == 16


def test_an_error_names_the_file(tmp_path):
    path = tmp_path / "beach <1>.jpg"
    path.write_bytes(READABLE["jpeg"].data[:200])
    with pytest.raises(PhotoError, match="beach <1>.jpg is damaged"):
        open_photo(path)


def test_a_missing_file_suggests_the_nearest_name(tmp_path):
    (tmp_path / "beach.jpg").write_bytes(READABLE["jpeg"].data)
    with pytest.raises(PhotoError, match="Did you mean 'beach.jpg'"):
        open_photo(tmp_path / "beech.jpg")
    with pytest.raises(PhotoError, match="no file"):
        open_photo(str(tmp_path / "nowhere" / "x.jpg"))
    (tmp_path / "beach.json").write_text("{}")
    with pytest.raises(PhotoError, match="Did you mean 'beach.jpg'"):
        open_photo(tmp_path / "Beeach.JPG")


def test_a_missing_file_suggests_nothing_that_only_ends_alike(tmp_path):
    (tmp_path / "big12.jpg").write_bytes(b"")
    with pytest.raises(PhotoError, match="Looked in"):
        open_photo(tmp_path / "missing.jpg")


def test_a_folder_is_refused(tmp_path):
    with pytest.raises(PhotoError, match="is a folder"):
        open_photo(tmp_path)


def test_a_device_is_refused_before_it_is_read():
    with pytest.raises(PhotoError, match="device or pipe"):
        open_photo("/dev/zero")


def test_a_file_without_permission_says_so(tmp_path, monkeypatch):
    path = tmp_path / "secret.jpg"
    path.write_bytes(b"x")

    # Tests may run as root, whom no access right stops.
    def refuse(self):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("pathlib.Path.read_bytes", refuse)
    with pytest.raises(PhotoError, match="No permission to read"):
        open_photo(path)


class PathOf:
    """A path object of somebody else's, which gives whatever it was made with."""

    def __init__(self, path):
        self.path = path

    def __fspath__(self):
        if isinstance(self.path, Exception):
            raise self.path
        return self.path


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("", "path is empty"),
        ("\0", "contents as bytes"),
        (corpus.jpeg_file(corpus.ramp(4, 4)).decode("latin-1"), "contents as bytes"),
        ("x" * 5000, "Cannot read 'xxx"),
        ("~nobody-of-this-name/x.jpg", "home directory"),
        ("data:image/png;base64,iVBORw0KGgo=", "never downloads"),
        ("\ud800.jpg", "Cannot read"),
        (PathOf(3), "does not name a file"),
        (PathOf(RuntimeError("unplugged")), "does not name a file: unplugged"),
        (__file__.encode(), "is a path in bytes.*os.fsdecode"),
        (f"{__file__}/x.jpg", "Not a directory"),
    ],
)
def test_an_impossible_path_says_what_is_wrong(path, message):
    with pytest.raises(PhotoError, match=message) as caught:
        open_photo(path)
    assert len(str(caught.value)) < 500
    str(caught.value).encode()  # fails on half a character, which nothing can print


def test_a_link_to_nowhere_says_so(tmp_path):
    (tmp_path / "sun.jpg").symlink_to("gone.jpg")
    with pytest.raises(PhotoError, match="is a link to gone.jpg, which does not exist"):
        open_photo(tmp_path / "sun.jpg")


def test_a_pipe_is_refused_before_it_is_read(tmp_path):
    os.mkfifo(tmp_path / "pipe.jpg")
    with pytest.raises(PhotoError, match="device or pipe"):
        open_photo(tmp_path / "pipe.jpg")


def test_a_name_that_is_no_text_becomes_one(tmp_path):
    path = os.fsencode(tmp_path) + b"/\xff\xfe.png"
    with open(path, "wb") as file:  # noqa: PTH123 - bytes
        file.write(READABLE["png"].data)
    photo = open_photo(os.fsdecode(path))
    assert photo.name == "??.png"


def test_an_address_is_never_downloaded():
    with pytest.raises(PhotoError, match="never downloads"):
        open_photo("https://example.org/beach.jpg")


# --- other sources ---------------------------------------------------------------------


def test_bytes_paths_and_file_objects_open_alike(tmp_path):
    data = READABLE["png"].data
    path = tmp_path / "a.png"
    path.write_bytes(data)
    with path.open("rb") as file:
        photos = [open_photo(source) for source in (data, bytearray(data), str(path), path, file)]
    photos.append(open_photo(io.BytesIO(data)))
    for photo in photos:
        assert np.array_equal(photo.encoded, READABLE["png"].codes)
    assert photos[4].name == "a.png"


class StreamOf:
    """A file object of somebody else's, which gives whatever it was made with."""

    name = 3

    def __init__(self, data):
        self.data = data

    def read(self):
        if isinstance(self.data, Exception):
            raise self.data
        return self.data


def spent():
    file = io.BytesIO(READABLE["png"].data)
    file.read()
    return file


def closed():
    file = io.BytesIO(READABLE["png"].data)
    file.close()
    return file


@pytest.mark.parametrize(
    ("stream", "message"),
    [
        (io.StringIO("abc"), "opened as text.*mode 'rb'"),
        # Its bytes are no UTF-8, and to read them fails.
        (io.TextIOWrapper(io.BytesIO(READABLE["jpeg"].data), "utf-8"), "opened as text"),
        (StreamOf("abc"), "opened as text"),
        (StreamOf(None), "gave NoneType, not bytes"),
        (StreamOf(OSError("unplugged")), "Reading picture failed: unplugged"),
        (StreamOf(ValueError()), "Reading picture failed: ValueError"),
        (closed(), "closed file"),
        (spent(), "no bytes left to read.*Open it again"),
    ],
)
def test_a_file_object_that_gives_no_picture_says_why(stream, message):
    with pytest.raises(PhotoError, match=message):
        open_photo(stream)


def test_a_file_object_may_give_any_bytes():
    for kind in (bytes, bytearray, memoryview):
        assert open_photo(StreamOf(kind(READABLE["png"].data))).name == "picture"


def test_a_photo_is_returned_as_it_is():
    photo = open_photo(corpus.ramp())
    assert open_photo(photo) is photo


@pytest.mark.parametrize("mode", ["RGB", "RGBA", "L", "LA", "P", "1", "CMYK", "YCbCr", "HSV", "F"])
def test_pil_images_of_every_mode_open(mode):
    image = Image.fromarray(corpus.ramp()).convert(mode)
    photo, _ = opened_with_notes(image)
    assert photo.size == (32, 24)
    if mode in ("L", "LA", "1"):
        expected = np.asarray(image.convert("L"))
        assert np.array_equal(photo.encoded[..., 0], expected)
    elif mode not in ("F", "P", "CMYK", "HSV"):
        expected = np.asarray(image.convert("RGB"))
        assert np.array_equal(photo.encoded, expected)


def test_a_closed_pil_image_says_so():
    image = Image.fromarray(corpus.ramp())
    image.close()
    with pytest.raises(PhotoError, match=r"Pillow image.*closed image.*Pass its file"):
        open_photo(image)


def test_a_deep_pil_image_says_that_its_file_holds_more():
    image = Image.open(io.BytesIO(READABLE["png_16"].data))
    _, notes = opened_with_notes(image)
    assert "could only be read with 8 bits. Pass its file" in notes[0]


def test_opening_a_pil_image_leaves_it_usable():
    image = Image.open(io.BytesIO(READABLE["jpeg"].data))
    first = open_photo(image)
    second = open_photo(image)
    assert np.array_equal(first.encoded, second.encoded)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
@pytest.mark.parametrize("channels", [None, 1, 2, 3, 4])
def test_whole_number_arrays_are_srgb(dtype, channels):
    top = np.iinfo(dtype).max
    shape = (5, 7) if channels is None else (5, 7, channels)
    array = np.random.default_rng(0).integers(0, top + 1, shape).astype(dtype)
    photo = open_photo(array)
    color = array.reshape(5, 7, -1)
    color = color[..., :3] if color.shape[2] > 2 else np.repeat(color[..., :1], 3, -1)
    assert np.array_equal(photo.encoded, color)
    np.testing.assert_allclose(photo.pixels, srgb_to_linear(color / top), atol=1e-6)
    assert (photo.alpha is not None) == (channels in (2, 4))


@pytest.mark.parametrize("dtype", ["u1", "<u2", ">u2", "<f2", ">f4", "<f8", ">f8", "g"])
def test_arrays_of_any_byte_order_and_layout_are_the_same_picture(dtype):
    values = corpus.ramp(8, 10)
    array = values / 255 if np.dtype(dtype).kind == "f" else values
    wanted = open_photo(array.astype(np.dtype(dtype).newbyteorder("="))).encoded
    padded = np.repeat(array.astype(dtype), 2, axis=1)
    read_only = array.astype(dtype)
    read_only.flags.writeable = False
    for same in (np.asfortranarray(array.astype(dtype)), padded[:, ::2], read_only):
        assert np.array_equal(open_photo(same).encoded, wanted)
    assert np.array_equal(open_photo(read_only[::-1, ::-1]).encoded, wanted[::-1, ::-1])


def test_an_array_on_disk_and_a_foreign_one_are_pictures(tmp_path):
    corpus.ramp().tofile(tmp_path / "picture.raw")
    on_disk = np.memmap(tmp_path / "picture.raw", np.uint8, "r", shape=(24, 32, 3))
    for array in (on_disk, ArrayOf(corpus.ramp()), np.ma.masked_array(corpus.ramp())):
        assert np.array_equal(open_photo(array).encoded, corpus.ramp())


class ArrayOf:
    """An array of another library, such as a tensor."""

    def __init__(self, array):
        self.array = array

    def __array__(self, dtype=None, copy=None):
        if isinstance(self.array, Exception):
            raise self.array
        return self.array


def test_floats_that_look_like_code_values_are_light_with_a_note():
    photo, notes = opened_with_notes(corpus.ramp().astype(np.float32))
    assert photo.pixels.max() == 255
    assert "whole numbers up to 255" in notes[0]
    assert opened_with_notes(corpus.ramp() / 255)[1] == []
    assert opened_with_notes(np.eye(9))[1] == []


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64])
def test_float_arrays_are_linear_light(dtype):
    array = np.random.default_rng(0).random((5, 7, 3)).astype(dtype)
    photo = open_photo(array)
    assert photo.bit_depth == 32
    assert np.array_equal(photo.pixels, array.astype(np.float32))


def test_light_outside_the_gamut_and_above_white_is_kept():
    light = np.full((2, 2, 3), [1.5, 0.4, -0.04], np.float32)
    assert np.array_equal(open_photo(light).pixels, light)


def test_a_photo_does_not_change_with_the_array_it_was_made_of():
    array = corpus.ramp()
    photo = open_photo(array)
    array[:] = 7
    assert np.array_equal(photo.encoded, corpus.ramp())
    with pytest.raises(ValueError, match="read-only"):
        photo.encoded[0, 0] = 1
    with pytest.raises(ValueError, match="read-only"):
        photo.pixels[0, 0] = 1


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (np.full((4, 4, 3), np.nan), "48 values that are NaN or infinite"),
        (np.full((4, 4, 3), np.inf), "NaN or infinite"),
        (np.full((4, 4, 3), 1e300), "NaN or infinite"),
        (np.full((4, 4, 3), 1e19), r"light up to 1e\+19.*numpy.clip"),
        (np.full((4, 4, 3), -1.0), "negative light"),
        (np.ma.masked_greater(corpus.ramp(), 200), r"hides \d+ values behind its mask"),
        (ArrayOf(RuntimeError("it is on the graphics card")), "it is on the graphics card"),
        (np.zeros((4, 4, 3), object), "type object"),
        (np.zeros((4, 4), "datetime64[s]"), "type datetime64"),
        (np.zeros((4, 4, 3), np.int32), "type int32"),
        (np.zeros((4, 4, 3), bool), "type bool"),
        (np.zeros((4, 4, 3), complex), "type complex128"),
        (np.array([["a", "b"]]), "expected uint8"),
        (np.zeros((3, 40, 50), np.uint8), "channels come last"),
        (np.zeros((4, 4, 5), np.uint8), "shape"),
        (np.zeros(4, np.uint8), "shape"),
        (np.zeros((2, 4, 4, 3), np.uint8), "shape"),
        (np.zeros((0, 4, 3), np.uint8), "no pixels"),
        (np.zeros((4, 0, 3)), "no pixels"),
        (np.float32(3), "shape"),
        (np.broadcast_to(np.uint8(0), (20_000, 20_000, 3)), "400 million"),
        ([[1, 2], [3]], "array"),
    ],
)
def test_bad_arrays_say_what_is_wrong(array, message):
    with pytest.raises(PhotoError, match=message):
        open_photo(array)


@pytest.mark.parametrize("source", [None, 3, object(), {"a": 1}])
def test_other_things_are_refused_with_the_list_of_what_works(source):
    with pytest.raises(PhotoError, match="Pass a path, bytes"):
        open_photo(source)


# --- size and preview ------------------------------------------------------------------


def test_pillows_bomb_limit_is_as_before_after_opening():
    before = Image.MAX_IMAGE_PIXELS
    with pytest.raises(PhotoError, match="900 million"):
        open_photo(UNREADABLE["bomb"][0])
    assert before == Image.MAX_IMAGE_PIXELS


def test_150_million_pixels_open_and_shrink():
    # One bit a pixel: the file is small, the way through the reader the same.
    columns = np.arange(15_000) < 7_500
    data = corpus.png_file(np.broadcast_to(columns, (10_000, 15_000)), 1, 0)
    photo = open_photo(data)
    assert photo.size == (15_000, 10_000)
    preview = photo.preview(300)
    assert preview.shape == (200, 300, 3)
    assert (preview[:, :150] == 255).all()
    assert (preview[:, 150:] == 0).all()


def test_a_small_8_bit_preview_is_the_photo_itself():
    base = corpus.ramp()
    assert np.array_equal(open_photo(base).preview(), base)
    assert np.array_equal(open_photo(base).preview(32), base)


def test_the_preview_averages_light_not_code_values():
    checks = np.zeros((64, 64, 3), np.uint8)
    checks[::2, ::2] = checks[1::2, 1::2] = 255
    preview = open_photo(checks).preview(16)
    # Half the light is code value 188, not 128.
    assert (preview == np.rint(255 * linear_to_srgb(np.float32(0.5)))).all()


def test_the_preview_is_the_same_however_it_is_cut_into_strips(monkeypatch):
    photo = open_photo(corpus.ramp(301, 203))
    whole = photo.preview(97)
    monkeypatch.setattr("sunwidget.formats.color.strips.__defaults__", (203 * 17,))
    assert np.array_equal(photo.preview(97), whole)


def test_a_16_bit_preview_rounds_to_8_bits():
    deep = corpus.ramp16()
    preview = open_photo(deep).preview()
    assert np.abs(preview - deep / 257.0).max() <= 0.51


def test_a_photo_can_be_pickled_and_names_itself():
    photo = open_photo(READABLE["png_16_alpha"].data)
    again = pickle.loads(pickle.dumps(photo))
    assert isinstance(again, Photo)
    assert np.array_equal(again.pixels, photo.pixels)
    assert repr(photo) == "<Photo 'picture' 32×24, 16 bit, sRGB>"


def test_a_notebook_shows_a_photo_as_a_small_picture_and_its_text():
    photo = open_photo(np.full((300, 1200, 3), 70, np.uint8))
    data, about = photo._repr_mimebundle_()
    assert data["text/plain"] == repr(photo)
    shown = open_photo(base64.b64decode(data["image/png"]))
    assert shown.size == (480, 120)
    assert (shown.encoded == 70).all()
    assert about["image/png"] == {"width": 480, "height": 120, "alt": "array"}
