"""Stills as light: OpenEXR, Radiance HDR and float TIFF, written, read by others, read again."""

import sys
from pathlib import Path

import cv2
import numpy as np
import photo_corpus as corpus
import pytest
import tifffile

from sunwidget.edit.table import Edit
from sunwidget.errors import PhotoError, PhotoWarning
from sunwidget.export.stills import save
from sunwidget.formats import exif, openexr, radiance
from sunwidget.formats.color import primaries_to_rec709
from sunwidget.photo.photo import open_photo

ENDINGS = (".exr", ".hdr", ".tif")
P3 = (0.68, 0.32, 0.265, 0.69, 0.15, 0.06, 0.3127, 0.329)


@pytest.fixture(autouse=True)
def _library():
    pytest.importorskip("OpenEXR", reason="the extra 'exr' is not installed")


def wide_light(height=40, width=60):
    """Light over twelve decades, with black and the mantissas' ends."""
    rng = np.random.default_rng(0)
    light = 10 ** rng.uniform(-6, 4, (height, width, 1)) * rng.random((height, width, 3))
    light[0, :4] = [[0, 0, 0], [1, 1, 1], [255.9 / 256, 0.5, 0], [0.5, 1e-7, 0]]
    return light.astype(np.float32)


def photo_with_facts():
    block = corpus.exif_block(
        {0x010F: "Maker", 0x0131: "Firmware 2", 0x8298: "Somebody"},
        {0xA405: 28, 0x920A: 4.25, 0x829A: 0.01, 0x829D: 8.0, 0x8827: 200},
        {1: "N", 2: (50.0, 3.0, 57.6), 3: "W", 4: (5.0, 42.0, 57.6), 17: 242.8},
    )
    chunks = [(b"eXIf", block[6:]), (b"pHYs", (11811).to_bytes(4, "big") * 2 + b"\1")]
    return open_photo(corpus.png_file(corpus.ramp(), 8, 2, chunks))


def saved(picture, path, **options):
    """Save as floats, whatever the ending."""
    if path.suffix == ".tif":
        options["bit_depth"] = 32
    return save(picture, path, **options)


@pytest.mark.parametrize(
    ("ending", "options", "error"),
    [
        (".exr", {}, 2**-11),
        (".exr", {"bit_depth": 32}, 0),
        (".tif", {}, 0),
        (".hdr", {}, 2**-8),
    ],
)
def test_linear_light_comes_back_from_the_file(tmp_path, ending, options, error):
    light = wide_light()
    again = open_photo(saved(light, tmp_path / f"out{ending}", **options)).pixels
    largest = light.max(axis=-1, keepdims=True)
    # Below 6e-5 half floats are denormal, in equal steps.
    assert (np.abs(again - light) <= error * largest + (6e-8 if ending == ".exr" else 0)).all()
    assert abs(float(((again - light) / np.maximum(largest, 1e-9)).mean())) < 1e-4  # no bias


def test_other_readers_see_the_same_light(tmp_path):
    import OpenEXR

    light = wide_light()
    found = OpenEXR.File(str(save(light, tmp_path / "out.exr", bit_depth=32))).channels()
    assert np.array_equal(found["RGB"].pixels, light)
    assert np.array_equal(tifffile.imread(saved(light, tmp_path / "out.tif")), light)
    theirs = cv2.imread(str(save(light, tmp_path / "out.hdr")), cv2.IMREAD_UNCHANGED)[..., ::-1]
    assert np.array_equal(theirs, open_photo(tmp_path / "out.hdr").pixels)


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_photo_keeps_its_facts_and_its_light(tmp_path, ending):
    photo = photo_with_facts()
    again = open_photo(saved(photo, tmp_path / f"out{ending}"))
    assert again.facts == photo.facts
    assert again.field_of_view == photo.field_of_view
    assert exif.load(again.exif)[0x010F] == "Maker"
    assert np.abs(again.pixels - photo.pixels).max() <= 2**-8
    if ending != ".hdr":
        assert again.dpi is None or again.dpi == pytest.approx((300, 300), abs=0.01)


def test_an_exr_tells_the_shot_by_the_standard_attributes(tmp_path):
    import OpenEXR

    header = OpenEXR.File(str(save(photo_with_facts(), tmp_path / "out.exr"))).header()
    assert header["expTime"] == pytest.approx(0.01)
    assert header["aperture"] == pytest.approx(8)
    assert header["isoSpeed"] == pytest.approx(200)
    assert header["latitude"] == pytest.approx(50.066, abs=1e-3)
    assert header["owner"] == "Somebody"
    assert header["chromaticities"] == pytest.approx(
        (0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329)
    )


def test_transparency_is_kept_by_exr_and_float_tiff(tmp_path):
    codes = np.dstack([corpus.ramp(), np.maximum(corpus.ramp()[..., 1], 30)])
    photo = open_photo(codes)
    for ending in (".exr", ".tif"):
        again = open_photo(saved(photo, tmp_path / f"out{ending}"))
        np.testing.assert_allclose(again.alpha, photo.alpha, atol=5e-4)
        np.testing.assert_allclose(again.pixels, photo.pixels, atol=2e-3)
    with pytest.warns(PhotoWarning, match="no transparency"):
        save(photo, tmp_path / "out.hdr")


def test_colours_outside_rec709_are_kept_by_exr_and_missed_in_hdr(tmp_path):
    data = corpus.png_file(corpus.ramp(), chunks=[corpus.icc_chunk(corpus.DISPLAY_P3)])
    photo = open_photo(data)
    again = open_photo(save(photo, tmp_path / "out.exr", bit_depth=32))
    assert np.array_equal(again.pixels, photo.pixels)
    assert again.icc is None
    with pytest.warns(PhotoWarning, match="outside Rec. 709"):
        save(photo, tmp_path / "out.hdr")


def test_files_of_other_primaries_become_rec709(tmp_path):
    import OpenEXR

    light = np.random.default_rng(1).uniform(0.2, 0.8, (6, 8, 3)).astype(np.float32)
    wanted = light @ primaries_to_rec709(P3).T
    path = tmp_path / "p3.exr"
    OpenEXR.File({"chromaticities": P3}, {"RGB": light}).write(str(path))
    np.testing.assert_allclose(open_photo(path).pixels, wanted, atol=1e-5)
    plain = radiance.pack(light, {})
    told = plain.replace(
        b"PRIMARIES=0.64 0.33 0.3 0.6 0.15", b"EXPOSURE=2\nPRIMARIES=0.68 0.32 0.265 0.69 0.15"
    )
    np.testing.assert_allclose(open_photo(told).pixels, wanted / 2, atol=0.01)
    assert primaries_to_rec709((0.3, 0.3) * 4) is None  # impossible ones are taken for Rec. 709


def test_grey_exr_and_one_without_colour(tmp_path):
    import OpenEXR

    grey = np.random.default_rng(1).random((6, 8)).astype(np.float32)
    OpenEXR.File({}, {"Y": grey}).write(str(tmp_path / "grey.exr"))
    assert np.array_equal(open_photo(tmp_path / "grey.exr").pixels[..., 2], grey)
    OpenEXR.File({}, {"Z": grey}).write(str(tmp_path / "depth.exr"))
    with pytest.raises(PhotoError, match="without the channels R, G, B or Y"):
        open_photo(tmp_path / "depth.exr")


def test_damaged_files_say_so(tmp_path, capfd):
    for ending in (".exr", ".hdr"):
        data = save(wide_light(), tmp_path / f"out{ending}").read_bytes()
        for share in (0.05, 0.5):
            with pytest.raises(PhotoError, match="damaged"):
                open_photo(data[: int(len(data) * share)])
    turned = radiance.pack(wide_light(), {}).replace(b"-Y 40 +X 60", b"+X 60 -Y 40")
    with pytest.raises(PhotoError, match="not stored from the top left"):
        open_photo(turned)
    big = radiance.pack(wide_light(), {}).replace(b"-Y 40 +X 60", b"-Y 90000 +X 90000")
    with pytest.raises(PhotoError, match="8100 million"):
        open_photo(big)


def test_without_the_extra_nothing_is_rendered_and_the_message_names_it(tmp_path, monkeypatch):
    data = save(wide_light(), tmp_path / "out.exr").read_bytes()
    monkeypatch.setitem(sys.modules, "OpenEXR", None)
    with pytest.raises(PhotoError, match=r"pip install 'sunwidget\[exr\]'"):
        save(object(), tmp_path / "no.exr")
    with pytest.raises(PhotoError, match=r"pip install 'sunwidget\[exr\]'"):
        open_photo(data)
    assert not (tmp_path / "no.exr").exists()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full on this system")
def test_a_full_disk_is_an_error_of_the_system():
    planes = {name: wide_light(200, 300)[..., i] for i, name in enumerate("RGB")}
    with pytest.raises(OSError, match=r"not written.*No space left"):
        openexr.write(Path("/dev/full"), planes, {}, {})


@pytest.mark.parametrize("ending", [".exr", ".hdr"])
def test_hostile_notes_are_only_text(tmp_path, ending):
    light, notes = wide_light(8, 8), {"recipe": "[" * 5000, "exif": "%%%", "xmp": "-"}
    path = tmp_path / f"out{ending}"
    if ending == ".hdr":
        path.write_bytes(radiance.pack(light, notes))
    else:
        planes = {name: light[..., i] for i, name in enumerate("RGB")}
        openexr.write(path, planes, {}, notes, bits=32)
    photo = open_photo(path)
    assert (photo.recipe, photo.exif, photo.xmp) == (None, None, None)


def test_depths_a_format_cannot_hold_are_refused(tmp_path):
    with pytest.raises(PhotoError, match=r"\.png holds 8 or 16 bits.*Save 32 bits as \.tif"):
        save(wide_light(), tmp_path / "out.png", bit_depth=32)
    with pytest.raises(PhotoError, match=r"\.exr holds 16 or 32 bits"):
        save(wide_light(), tmp_path / "out.exr", bit_depth=8)
    for wrong in (12, True, "16"):
        with pytest.raises(PhotoError, match="bit_depth must be"):
            save(wide_light(), tmp_path / "out.tif", bit_depth=wrong)


@pytest.fixture(scope="module")
def scene():
    import sunwidget as sw

    small = cv2.resize(sw.sample("coast").encoded, (96, 64), interpolation=cv2.INTER_AREA)
    return sw.analyze(small)


def rendered(scene, edit, **options):
    import sunwidget as sw

    try:
        return sw.render(scene, edit, **options)
    except sw.RendererError as error:
        pytest.skip(f"no GL on this machine: {error}")


@pytest.mark.parametrize("ending", ENDINGS)
def test_an_edit_is_saved_as_the_light_that_render_returns(tmp_path, scene, ending):
    edit = Edit(sun_elevation=3, sun_azimuth=10)
    light = rendered(scene, edit, dtype="float32")
    again = open_photo(saved((scene, edit), tmp_path / f"out{ending}"))
    largest = np.maximum(light.max(axis=-1, keepdims=True), 1e-3)
    assert (np.abs(again.pixels - light) <= 2**-8 * largest).all()
    assert again.recipe == edit


def test_an_unmoved_photo_keeps_its_light_to_the_bit(tmp_path, scene):
    rendered(scene, Edit())
    again = open_photo(save((scene, Edit()), tmp_path / "out.exr", bit_depth=32))
    assert np.array_equal(again.pixels, scene.photo.pixels)


def test_another_size_is_rendered_at_that_size(tmp_path, scene):
    edit = Edit(sun_elevation=3)
    wanted = rendered(scene, edit, size=(48, 32))
    again = open_photo(save((scene, edit), tmp_path / "out.png", size=(48, 32)))
    assert np.array_equal(again.encoded, wanted)
    with pytest.raises(PhotoError, match="size and layers apply to a rendered scene"):
        save(scene.photo, tmp_path / "no.png", size=(48, 32))
