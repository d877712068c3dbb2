import dataclasses
import errno
import importlib
import io
import os
import stat
import warnings
from pathlib import Path

import cv2
import numpy as np
import photo_corpus as corpus
import pytest
import tifffile
from PIL import Image, PngImagePlugin

from sunwidget.edit.table import Edit, Stroke
from sunwidget.errors import PhotoError, PhotoWarning
from sunwidget.export import stills
from sunwidget.export.stills import encode_like, save
from sunwidget.formats import exif, xmp
from sunwidget.formats.color import linear_to_srgb
from sunwidget.photo.photo import open_photo

LOSSLESS = (".png", ".tif", ".tiff")
ALL = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".webp")
XMP = (
    b'<x:xmpmeta xmlns:x="adobe:ns:meta/">'
    b'<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"/></x:xmpmeta>'
)


def rich_photo(deep=False, alpha=False):
    """Return a photo with a profile, camera, place, XMP and resolution."""
    block = corpus.exif_block(
        {0x010F: "Maker", 0x0110: "Größe", 0x013B: "Somebody"},
        {0xA405: 28, 0x920A: 4.25, 0xA002: 32, 0xA003: 24, 0x927C: b"secret"},
        {1: "N", 2: (50.0, 3.0, 57.6), 3: "W", 4: (5.0, 42.0, 57.6), 17: 242.8},
    )
    chunks = [
        corpus.icc_chunk(corpus.DISPLAY_P3),
        (b"eXIf", block[6:]),
        (b"iTXt", b"XML:com.adobe.xmp\0\0\0\0\0" + XMP),
        (b"pHYs", (11811).to_bytes(4, "big") * 2 + b"\1"),
    ]
    codes = corpus.ramp16() if deep else corpus.ramp()
    if alpha:
        codes = np.dstack([codes, codes[..., 1]])
    data = corpus.png_file(codes, 16 if deep else 8, 6 if alpha else 2, chunks)
    return open_photo(data)


class FakeScene:
    """What save() needs of a scene; the renderer is replaced beside it."""

    def __init__(self, photo):
        self.photo = photo


@pytest.fixture
def renderer(monkeypatch):
    """Stand in for the GL renderer: halves the light of the lower half, sRGB when asked."""
    # Not "import … as": the package's own attribute of this name is the function.
    module = importlib.import_module("sunwidget.renderer.offscreen")
    calls = []

    def render(scene, edit=None, *, dtype="uint8", headroom=0, progress=None):
        assert headroom == 0
        calls.append(dtype)
        light = scene.photo.pixels.copy()
        light[light.shape[0] // 2 :] *= 0.5 if edit is not None and edit.changed() else 1
        if progress is not None:
            progress(1.0, "rendering")
        if dtype == "float32":
            return light
        return np.rint(linear_to_srgb(light) * 255).astype(np.uint8)

    def strips_of(scene, edit=None, dtype="uint8", size=None, progress=None):
        picture = render(scene, edit, dtype=dtype, progress=progress)
        for rows in (slice(0, 7), slice(7, len(picture))):
            yield rows, picture[rows]

    monkeypatch.setattr(module, "render", render)
    monkeypatch.setattr(module, "strips_of", strips_of)
    return calls


# --- pixels ----------------------------------------------------------------------------


@pytest.mark.parametrize("ending", LOSSLESS)
@pytest.mark.parametrize("deep", [False, True])
@pytest.mark.parametrize("alpha", [False, True])
def test_an_opened_photo_is_saved_with_its_very_pixels(tmp_path, ending, deep, alpha):
    photo = rich_photo(deep, alpha)
    again = open_photo(save(photo, tmp_path / f"out{ending}"))
    assert again.bit_depth == (16 if deep else 8)
    assert np.array_equal(again.encoded, photo.encoded)
    if alpha:
        np.testing.assert_allclose(again.alpha, photo.alpha, atol=1e-7)
    else:
        assert again.alpha is None


@pytest.mark.parametrize("ending", LOSSLESS)
@pytest.mark.parametrize("deep", [False, True])
def test_other_readers_see_the_same_pixels(tmp_path, ending, deep):
    photo = rich_photo(deep)
    path = save(photo, tmp_path / f"out{ending}")
    theirs = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)[..., ::-1]
    assert np.array_equal(theirs, photo.encoded)
    if ending != ".png":
        assert np.array_equal(tifffile.imread(path), photo.encoded)
    if not deep:
        assert np.array_equal(np.asarray(Image.open(path)), photo.encoded)


@pytest.mark.parametrize("ending", [".jpg", ".webp"])
def test_lossy_formats_stay_close(tmp_path, ending):
    photo = rich_photo()
    again = open_photo(save(photo, tmp_path / f"out{ending}"))
    # The picture has noise and two extreme corners, which cost most.
    assert np.abs(again.encoded.astype(int) - photo.encoded).mean() < 4


def test_webp_at_quality_100_loses_nothing(tmp_path):
    photo = rich_photo(alpha=True)
    again = open_photo(save(photo, tmp_path / "out.webp", quality=100))
    assert np.array_equal(again.encoded, photo.encoded)
    np.testing.assert_allclose(again.alpha, photo.alpha, atol=1e-7)


def test_a_lower_quality_is_a_smaller_file(tmp_path):
    photo = open_photo(corpus.ramp(200, 200))
    for ending in (".jpg", ".webp"):
        sizes = [
            save(photo, tmp_path / f"{quality}{ending}", quality=quality).stat().st_size
            for quality in (30, 60, 95)
        ]
        assert sizes == sorted(sizes)
        assert sizes[0] < sizes[2] / 2


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_whole_number_arrays_are_saved_as_srgb_codes(tmp_path, dtype):
    codes = corpus.ramp() if dtype == np.uint8 else corpus.ramp16()
    again = open_photo(save(codes, tmp_path / "out.png"))
    assert np.array_equal(again.encoded, codes)
    assert again.icc is None


def test_float_arrays_are_light_and_become_16_bit_srgb(tmp_path):
    light = np.random.default_rng(0).random((9, 11, 3)).astype(np.float32)
    again = open_photo(save(light, tmp_path / "out.tif"))
    assert again.bit_depth == 16
    np.testing.assert_allclose(again.pixels, light, atol=3e-5)


def test_bit_depth_can_be_asked_for(tmp_path):
    eight, deep = corpus.ramp(), corpus.ramp16()
    wide = open_photo(save(eight, tmp_path / "wide.tif", bit_depth=16))
    assert np.array_equal(wide.encoded, eight * np.uint16(257))
    small = open_photo(save(deep, tmp_path / "small.png", bit_depth=8))
    assert small.bit_depth == 8
    assert np.abs(small.encoded - deep / 257.0).max() <= 0.5


def test_deep_pictures_go_into_jpeg_with_8_bits(tmp_path):
    again = open_photo(save(corpus.ramp16(), tmp_path / "out.jpg"))
    assert again.bit_depth == 8


@pytest.mark.parametrize("shape", [(1, 1), (1, 5000), (5000, 1), (100, 3000)])
@pytest.mark.parametrize("ending", ALL)
def test_pictures_of_odd_shapes_are_saved(tmp_path, shape, ending):
    codes = corpus.ramp(*shape)
    again = open_photo(save(codes, tmp_path / f"out{ending}", quality=100))
    assert again.encoded.shape == codes.shape


def test_pixels_of_many_tiff_strips_are_in_order(tmp_path):
    codes = corpus.ramp16(700, 900)
    path = save(codes, tmp_path / "out.tif")
    with tifffile.TiffFile(path) as file:
        assert len(file.pages[0].dataoffsets) > 2
    assert np.array_equal(open_photo(path).encoded, codes)


# --- metadata --------------------------------------------------------------------------


@pytest.mark.parametrize("ending", ALL)
@pytest.mark.parametrize("deep", [False, True])
def test_camera_place_profile_and_xmp_are_kept(tmp_path, ending, deep):
    photo = rich_photo(deep)
    again = open_photo(save(photo, tmp_path / f"out{ending}"))
    assert again.icc == photo.icc == corpus.DISPLAY_P3
    assert again.facts == photo.facts
    assert again.field_of_view == photo.field_of_view
    assert again.xmp == XMP
    read = exif.load(again.exif)
    assert read[0x010F] == "Maker"
    assert read[0x013B] == "Somebody"
    assert read.get_ifd(0x8769)[0x927C] == b"secret"
    if ending != ".webp":  # WebP has no place for it
        assert again.dpi == pytest.approx((300, 300), abs=0.01)


@pytest.mark.parametrize("ending", [*ALL, ".exr"])
def test_texts_that_are_no_ascii_are_kept_byte_by_byte(tmp_path, ending):
    if ending == ".exr":
        pytest.importorskip("OpenEXR")
    block = corpus.exif_block({0x8298: "CC A. Person"}, {0xA434: "OO 28 mm"})
    # Pillow writes "?" for them, so they are put in afterwards: UTF-8 and Latin-1.
    block = block.replace(b"CC A.", "© A.".encode()).replace(b"OO 28", b"\xd8\xf8 28")
    photo = open_photo(corpus.png_file(corpus.ramp(), chunks=[(b"eXIf", block[6:])]))
    again = open_photo(save(photo, tmp_path / f"out{ending}"))
    for told in (again.exif, open_photo(save(again, tmp_path / "again.tif")).exif):
        assert "© A. Person".encode() in told
        assert b"\xd8\xf8 28 mm" in told


def test_a_turned_photo_is_saved_upright_once(tmp_path):
    block = corpus.exif_block({0x010F: "Maker"}, {0xA002: 24, 0xA003: 32, 0xA405: 28}, None, 6)
    stored = np.ascontiguousarray(corpus.STORED[6](corpus.ramp()))
    photo = open_photo(corpus.png_file(stored, chunks=[(b"eXIf", block[6:])]))
    for ending in ALL:
        path = save(photo, tmp_path / f"out{ending}", quality=100)
        again = open_photo(path)
        assert again.size == (32, 24)
        assert not again.turned
        assert again.facts.stored_size == (32, 24)
        assert again.field_of_view.vertical == pytest.approx(photo.field_of_view.vertical)
        assert exif.load(again.exif).get(274, 1) == 1
        if ending in LOSSLESS:
            assert np.array_equal(again.encoded, corpus.ramp())


def test_storage_tags_of_a_tiff_do_not_travel(tmp_path):
    source = corpus.pillow_file(corpus.ramp(), "TIFF", compression="tiff_lzw", tiffinfo={315: "Me"})
    photo = open_photo(source)
    for ending in ALL:
        again = open_photo(save(photo, tmp_path / f"out{ending}"))
        kept = dict(exif.load(again.exif))
        assert kept[315] == "Me"
        assert not {259, 273, 279} & set(exif.load(photo.exif))


def test_an_array_can_borrow_profile_and_metadata(tmp_path):
    photo = rich_photo(deep=True)
    path = save(photo.pixels * np.float32(1.0), tmp_path / "out.tif", like=photo)
    again = open_photo(path)
    assert np.array_equal(again.encoded, photo.encoded)
    assert again.icc == photo.icc
    assert again.facts == photo.facts
    again = open_photo(save(corpus.ramp(), tmp_path / "codes.png", like=FakeScene(photo)))
    assert again.icc == photo.icc
    # sRGB codes turn into P3 codes of the same colour.
    np.testing.assert_allclose(again.pixels, open_photo(corpus.ramp()).pixels, atol=0.02)


def test_an_array_of_another_size_can_borrow_too(tmp_path):
    photo = rich_photo(alpha=True)
    again = open_photo(save(photo.pixels[:7, :5], tmp_path / "out.png", like=photo))
    assert again.size == (5, 7)
    assert again.alpha is None
    assert again.facts.stored_size == (5, 7)


def test_jpeg_leaves_out_what_does_not_fit_and_says_so(tmp_path):
    chunks = [(b"iTXt", b"XML:com.adobe.xmp\0\0\0\0\0" + XMP + b" " * 70_000)]
    photo = open_photo(corpus.png_file(corpus.ramp(), chunks=chunks))
    with pytest.warns(PhotoWarning, match="XMP metadata is too long"):
        path = save(photo, tmp_path / "out.jpg")
    assert open_photo(path).xmp is None


@pytest.mark.parametrize(
    ("note", "points", "missing"),
    [
        (60_000, 500, "maker's note"),
        (10, 4000, "comment with the recipe"),
        (70_000, 4000, "maker's note and the comment"),
    ],
)
def test_a_long_exif_loses_only_what_does_not_fit_into_jpeg(
    tmp_path, renderer, note, points, missing
):
    block = corpus.exif_block({0x010F: "Maker"}, {0xA405: 28, 0x927C: bytes(note)})
    photo = open_photo(corpus.png_file(corpus.ramp(), chunks=[(b"eXIf", block[6:])]))
    line = tuple((i / 7919, i / 7907) for i in range(points))
    edit = Edit(strokes=(Stroke("sky", line),))
    with pytest.warns(PhotoWarning, match=f"its {missing}"):
        again = open_photo(save((FakeScene(photo), edit), tmp_path / "out.jpg"))
    assert again.facts == photo.facts
    assert exif.load(again.exif)[0x010F] == "Maker"
    kept = open_photo(save((FakeScene(photo), edit), tmp_path / "out.png"))
    assert kept.recipe == edit


def test_a_recipe_may_stand_for_the_edit_and_other_tuples_are_refused(tmp_path, renderer):
    scene = FakeScene(rich_photo())
    again = open_photo(save((scene, {"exposure": 1}), tmp_path / "out.png"))
    assert again.recipe == Edit(exposure=1)
    for wrong in ((scene, 3), (scene,), (scene.photo, Edit()), (1, 2)):
        with pytest.raises(PhotoError, match=r"must be \(scene, edit\), not"):
            save(wrong, tmp_path / "no.png")


def test_transparency_is_left_out_of_jpeg_with_a_warning(tmp_path):
    with pytest.warns(PhotoWarning, match="no transparency"):
        save(rich_photo(alpha=True), tmp_path / "out.jpg")


# --- a scene and an edit ---------------------------------------------------------------


@pytest.mark.parametrize("deep", [False, True])
@pytest.mark.parametrize("ending", LOSSLESS)
def test_an_unmoved_scene_is_saved_with_the_very_pixels(tmp_path, renderer, deep, ending):
    photo = rich_photo(deep)
    again = open_photo(save((FakeScene(photo), Edit()), tmp_path / f"out{ending}"))
    assert np.array_equal(again.encoded, photo.encoded)
    assert again.icc == photo.icc
    assert renderer == ["float32"]


def test_an_edit_changes_its_pixels_only(tmp_path, renderer):
    photo = rich_photo(deep=True)
    again = open_photo(save((FakeScene(photo), Edit(exposure=-1)), tmp_path / "out.png"))
    assert np.array_equal(again.encoded[:12], photo.encoded[:12])
    np.testing.assert_allclose(
        again.pixels[12:], photo.profile.decode(photo.encoded)[12:] / 2, atol=2e-4
    )


def test_an_8_bit_srgb_photo_is_saved_as_the_frame_that_render_returns(tmp_path, renderer):
    photo = open_photo(corpus.ramp())
    save((FakeScene(photo), Edit(exposure=-1)), tmp_path / "out.png")
    assert renderer == ["uint8"]


@pytest.mark.parametrize("ending", ALL)
def test_the_recipe_travels_with_the_picture(tmp_path, renderer, ending):
    edit = Edit(sun_elevation=3.5, sun_azimuth=-4)
    again = open_photo(save((FakeScene(rich_photo()), edit), tmp_path / f"out{ending}"))
    assert again.recipe == edit


@pytest.mark.parametrize("ending", [*ALL, ".hdr"])
def test_the_edit_is_told_in_exif_and_xmp_beside_what_was_there(tmp_path, renderer, ending):
    edit = Edit(sun_elevation=3.5)
    pair, paths = (FakeScene(rich_photo()), edit), [tmp_path / f"{n}{ending}" for n in "ab"]
    if ending == ".hdr":  # the photo's colors are wider than it holds
        with pytest.warns(PhotoWarning, match="outside Rec. 709"):
            save(pair, paths[0])
        again = open_photo(paths[0])
    else:
        again = open_photo(save(pair, paths[0]))
        assert save(pair, paths[1]).read_bytes() == paths[0].read_bytes()  # no clock in it
    read = exif.load(again.exif)
    assert read[0x0131].startswith("sunwidget ")
    assert Edit.from_dict(xmp.recipe(again.xmp)) == edit
    assert b"softwareAgent" in again.xmp
    assert again.facts == rich_photo().facts
    twice = save((FakeScene(again), Edit(exposure=1)), tmp_path / "twice.png")
    assert open_photo(twice).recipe == Edit(exposure=1)


def test_a_scene_alone_is_the_unmoved_photo(tmp_path, renderer):
    photo = rich_photo()
    again = open_photo(save(FakeScene(photo), tmp_path / "out.png"))
    assert np.array_equal(again.encoded, photo.encoded)


def test_a_cancelled_render_leaves_no_file(tmp_path, renderer):
    def cancel(fraction, message):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        save((FakeScene(rich_photo()), Edit()), tmp_path / "out.png", progress=cancel)
    assert list(tmp_path.iterdir()) == []


# --- files -----------------------------------------------------------------------------


def test_an_existing_file_is_never_replaced_without_being_asked(tmp_path, renderer):
    path = tmp_path / "out.png"
    path.write_bytes(b"precious")
    with pytest.raises(FileExistsError, match="overwrite=True"):
        save((FakeScene(rich_photo()), Edit()), path)
    assert path.read_bytes() == b"precious"
    assert renderer == []  # noticed before any work was done
    save(corpus.ramp(), path, overwrite=True)
    assert np.array_equal(open_photo(path).encoded, corpus.ramp())


def test_overwriting_goes_through_a_link(tmp_path):
    real, link = tmp_path / "real.png", tmp_path / "link.png"
    real.write_bytes(b"old")
    link.symlink_to(real)
    save(corpus.ramp(), link, overwrite=True)
    assert link.is_symlink()
    assert np.array_equal(open_photo(real).encoded, corpus.ramp())


def test_a_full_disk_leaves_neither_half_a_file_nor_the_old_one_damaged(tmp_path, monkeypatch):
    path = tmp_path / "out.png"
    path.write_bytes(b"precious")

    def full(self, data):
        with open(self, "wb") as file:  # noqa: PTH123 - below the patched method
            file.write(data[: len(data) // 2])
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    with pytest.raises(OSError, match="disk is full") as caught:
        save(corpus.ramp(), path, overwrite=True)
    assert "out.png was not written" in str(caught.value)
    assert path.read_bytes() == b"precious"
    assert [entry.name for entry in tmp_path.iterdir()] == ["out.png"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full on this system")
def test_a_device_is_not_replaced(tmp_path):
    with pytest.raises(PhotoError, match="ends in 'nothing'"):
        save(corpus.ramp(), "/dev/full", overwrite=True)


def test_a_missing_folder_and_a_folder_are_named(tmp_path):
    with pytest.raises(FileNotFoundError, match="no folder"):
        save(corpus.ramp(), tmp_path / "nowhere" / "out.png")
    with pytest.raises(IsADirectoryError, match="is a folder"):
        save(corpus.ramp(), tmp_path, overwrite=True)


def test_a_saved_file_has_the_rights_of_any_new_file(tmp_path):
    fresh = tmp_path / "fresh"
    fresh.touch()
    saved = save(corpus.ramp(), tmp_path / "out.png")
    assert stat.S_IMODE(saved.stat().st_mode) == stat.S_IMODE(fresh.stat().st_mode)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("out", "'nothing'"),
        ("out.xcf", "expected one of .png"),
        ("out.pgn", "Did you mean '.png'"),
        ("out.jepg", "Did you mean '.jp"),
    ],
)
def test_an_unknown_ending_lists_the_known_ones(tmp_path, name, message):
    with pytest.raises(PhotoError, match=message):
        save(corpus.ramp(), tmp_path / name)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("quality", [0, 101, "high", 95.5, True, None])
def test_a_senseless_quality_is_refused(tmp_path, quality):
    with pytest.raises(PhotoError, match="quality must be"):
        save(corpus.ramp(), tmp_path / "out.jpg", quality=quality)


def test_senseless_arguments_are_refused(tmp_path):
    with pytest.raises(PhotoError, match="bit_depth must be"):
        save(corpus.ramp(), tmp_path / "out.png", bit_depth=12)
    with pytest.raises(PhotoError, match="8 bits per channel"):
        save(corpus.ramp(), tmp_path / "out.jpg", bit_depth=16)
    with pytest.raises(PhotoError, match="like must be"):
        save(corpus.ramp(), tmp_path / "out.png", like="photo")
    with pytest.raises(PhotoError, match="NaN"):
        save(np.full((4, 4, 3), np.nan), tmp_path / "out.png")
    with pytest.raises(PhotoError, match="shape"):
        save(np.zeros((4, 4, 9), np.uint8), tmp_path / "out.png")
    assert list(tmp_path.iterdir()) == []


def test_formats_say_when_a_picture_is_too_long_for_them(tmp_path):
    with pytest.raises(PhotoError, match="at most 16383"):
        save(corpus.ramp(1, 17_000), tmp_path / "out.webp")
    with pytest.raises(PhotoError, match="at most 65500"):
        save(corpus.ramp(1, 66_000), tmp_path / "out.jpg")


def test_hostile_names_are_only_names(tmp_path):
    name = "<img src=x onerror=alert(1)>'\";$(touch x).png"
    path = save(corpus.ramp(), tmp_path / name)
    assert path.name == name
    assert open_photo(path).name == name
    assert [entry.name for entry in tmp_path.iterdir()] == [name]


def test_png_chunks_are_well_formed(tmp_path):
    path = save(rich_photo(), tmp_path / "out.png")
    kinds = []
    chunks = PngImagePlugin.ChunkStream(io.BytesIO(path.read_bytes()[8:]))
    while True:
        kind, position, length = chunks.read()
        chunks.crc(kind, chunks.fp.read(length))
        kinds.append(kind)
        if kind == b"IEND":
            break
    # The profile and the resolution must come before the pixels (PNG 5.6).
    assert kinds.index(b"iCCP") < kinds.index(b"IDAT")
    assert kinds.index(b"pHYs") < kinds.index(b"IDAT")
    assert kinds.count(b"iCCP") == 1
    assert b"sRGB" not in kinds


def test_no_warning_for_an_ordinary_picture(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for ending in ALL:
            save(rich_photo(), tmp_path / f"out{ending}")


def test_encoding_like_a_photo_needs_no_photo_of_the_same_size():
    photo = rich_photo(deep=True)
    codes = encode_like(photo, photo.pixels[:3, :4])
    assert codes.dtype == np.uint16
    assert np.abs(codes.astype(int) - photo.encoded[:3, :4]).max() <= 4


def test_stills_needs_no_renderer_until_a_scene_is_saved():
    assert not hasattr(stills, "render")


@pytest.mark.parametrize("icc", [None, corpus.DISPLAY_P3, corpus.ADOBE_RGB])
@pytest.mark.parametrize("deep", [False, True])
def test_the_real_renderer_keeps_every_code_of_an_unmoved_photo(tmp_path, icc, deep):
    import sunwidget as sw
    from sunwidget.errors import RendererError

    codes = np.ascontiguousarray(sw.sample("coast").encoded[::8, ::8])
    if deep:
        low = np.random.default_rng(0).integers(0, 257, codes.shape)
        codes = np.minimum(codes.astype(np.int64) * 257 + low, 65535).astype(np.uint16)
    chunks = [corpus.icc_chunk(icc)] if icc else []
    photo = open_photo(corpus.png_file(codes, 16 if deep else 8, 2, chunks))
    scene = sw.analyze(photo)
    try:
        path = save((scene, Edit()), tmp_path / "out.tif")
    except RendererError as error:
        pytest.skip(f"no GL on this machine: {error}")
    assert np.array_equal(open_photo(path).encoded, photo.encoded)
    moved = open_photo(save((scene, Edit(sun_elevation=2)), tmp_path / "moved.tif"))
    assert moved.icc == photo.icc
    assert np.abs(moved.pixels - photo.pixels).mean() > 0.02


def test_a_recipe_of_a_newer_version_is_no_edit_and_is_written_again(tmp_path):
    newer = {"version": 99, "teleport": 1}
    photo = dataclasses.replace(rich_photo(), recorded=newer)
    assert photo.recipe is None
    assert open_photo(save(photo, tmp_path / "out.png")).recorded == newer
