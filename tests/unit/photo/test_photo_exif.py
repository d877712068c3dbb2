import datetime as dt
import math

import numpy as np
import photo_corpus as corpus
import pytest
from PIL import Image
from PIL.TiffImagePlugin import IFDRational

from sunwidget.formats import exif
from sunwidget.photo.photo import open_photo

UTC = dt.UTC


def camera(size=(400, 300), **shot):
    """Open a photo whose EXIF holds these tags of the shot."""
    numbers = {
        "focal_length": 0x920A,
        "focal_35mm": 0xA405,
        "plane_resolution": 0xA20E,
        "plane_unit": 0xA210,
        "zoom": 0xA404,
        "width": 0xA002,
        "height": 0xA003,
    }
    orientation = shot.pop("orientation", None)
    block = corpus.exif_block(
        shot={numbers[name]: value for name, value in shot.items()}, orientation=orientation
    )
    stored = np.zeros((size[1], size[0], 3), np.uint8)
    return open_photo(corpus.png_file(stored, chunks=[(b"eXIf", block[6:])]))


def degrees(height, focal):
    return math.degrees(2 * math.atan(height / 2 / focal))


# --- field of view ---------------------------------------------------------------------


def test_a_photo_that_says_nothing_has_an_assumed_field_of_view():
    assert open_photo(corpus.ramp()).field_of_view == (50.0, "assumed")


def test_the_35_mm_focal_length_follows_the_diagonal():
    # 28 mm on 4:3: f = 28 · 500/43.267 = 323.6 px.
    view = camera(focal_35mm=28).field_of_view
    assert view.source == "exif"
    assert view.vertical == pytest.approx(degrees(300, 28 * 500 / 43.267))


def test_the_sensor_of_a_35_mm_camera_has_the_textbook_angle():
    # 50 mm on 36 × 24 mm: 2·atan(12/50) = 26.99°.
    assert camera((360, 240), focal_35mm=50).field_of_view.vertical == pytest.approx(
        26.99, abs=0.01
    )


@pytest.mark.parametrize("orientation", [5, 6, 7, 8])
def test_a_camera_held_upright_sees_its_long_side_vertically(orientation):
    photo = camera(focal_35mm=28, orientation=orientation)
    assert photo.size == (300, 400)
    assert photo.field_of_view.vertical == pytest.approx(degrees(400, 28 * 500 / 43.267))


@pytest.mark.parametrize(("unit", "per_mm"), [(2, 25.4), (3, 10.0), (4, 1.0)])
def test_the_focal_plane_comes_first_in_every_unit(unit, per_mm):
    # 10 px a millimetre, 35 mm: f = 350 px. The 35 mm equivalent says nearly the same.
    photo = camera(
        focal_length=35.0, plane_resolution=10.0 * per_mm, plane_unit=unit, focal_35mm=30
    )
    assert photo.field_of_view.vertical == pytest.approx(degrees(300, 350), abs=1e-3)


def test_a_focal_plane_left_stale_by_resizing_gives_way_to_the_35_mm_length():
    photo = camera(focal_length=35.0, plane_resolution=100.0, plane_unit=4, focal_35mm=30)
    assert photo.field_of_view.vertical == pytest.approx(degrees(300, 30 * 500 / 43.267))


def test_a_smaller_copy_has_the_field_of_view_of_its_original():
    shot = {"focal_length": 35.0, "plane_resolution": 100.0, "plane_unit": 4}
    original = camera((4000, 3000), **shot)
    copy = camera((400, 300), width=4000, height=3000, **shot)
    assert copy.field_of_view.vertical == pytest.approx(original.field_of_view.vertical)


def test_a_crop_sees_less():
    full = camera((400, 300), width=400, height=300, focal_35mm=28)
    crop = camera((400, 150), width=400, height=300, focal_35mm=28)
    assert crop.field_of_view.vertical == pytest.approx(degrees(150, 28 * 500 / 43.267))
    assert crop.field_of_view.vertical < full.field_of_view.vertical


def test_a_digital_zoom_narrows_the_view_of_the_focal_plane():
    shot = {"focal_length": 35.0, "plane_resolution": 10.0, "plane_unit": 4}
    assert camera(zoom=2.0, **shot).field_of_view.vertical == pytest.approx(degrees(300, 700))


@pytest.mark.parametrize(
    "shot",
    [
        {"focal_35mm": 0},
        {"focal_length": 0.0, "plane_resolution": 10.0},
        {"focal_length": 35.0, "plane_resolution": 0.0},
        {"focal_length": 35.0, "plane_resolution": 10.0, "plane_unit": 77},
        {"focal_35mm": 65535},
        {"focal_length": 35.0},
        {"focal_35mm": 28, "width": 0, "height": 300, "zoom": 0.0, "focal_length": 1e9},
    ],
)
def test_senseless_cameras_never_raise(shot):
    view = camera(**shot).field_of_view
    assert view.source in ("assumed", "exif")
    assert 0.5 <= view.vertical <= 150


# --- place and time --------------------------------------------------------------------


def located(gps, **tags):
    block = corpus.exif_block(tags=tags.get("tags"), shot=tags.get("shot"), gps=gps)
    return open_photo(corpus.jpeg_file(corpus.ramp(), exif=block))


def test_place_heading_and_utc_are_read():
    photo = located(
        {
            1: "S",
            2: (33.0, 51.0, 25.2),
            3: "E",
            4: (151.0, 12.0, 54.0),
            5: b"\x00",
            6: 12.5,
            7: (16.0, 41.0, 51.5),
            16: "T",
            17: 242.8,
            29: "2025:09:27",
        }
    )
    assert photo.latitude == pytest.approx(-33.857)
    assert photo.longitude == pytest.approx(151.215)
    assert photo.heading == pytest.approx(242.8)
    assert photo.facts.altitude == pytest.approx(12.5)
    assert photo.time == dt.datetime(2025, 9, 27, 16, 41, 51, 500_000, tzinfo=UTC)


def test_time_without_gps_takes_the_zone_of_the_file_or_none():
    shot = {0x9003: "2025:06:21 05:00:00"}
    assert located({}, shot=shot).time == dt.datetime(2025, 6, 21, 5)  # noqa: DTZ001 - naive, as the file
    zoned = located({}, shot={**shot, 0x9011: "+02:00"}).time
    assert zoned.astimezone(UTC) == dt.datetime(2025, 6, 21, 3, tzinfo=UTC)


@pytest.mark.parametrize(
    "gps",
    [
        {1: "N", 2: (95.0, 0.0, 0.0), 3: "E", 4: (400.0, 0.0, 0.0)},
        {1: "N", 2: (IFDRational(0, 0),) * 3, 3: "E", 4: (1.0,)},
        {7: (99.0, 99.0, 1e12), 29: "yesterday"},
        {17: 720.0, 6: IFDRational(1, 0)},
    ],
)
def test_senseless_places_never_raise(gps):
    photo = located(gps, shot={0x9003: "0000:00:00 00:00:00"})
    assert photo.latitude is None
    assert photo.heading is None
    assert photo.time is None


# --- what is carried on ----------------------------------------------------------------


def test_every_orientation_is_applied_and_then_forgotten():
    base, deep = corpus.ramp(), corpus.ramp16()
    for way, store in corpus.STORED.items():
        block = corpus.exif_block(tags={0x010F: "Maker"}, orientation=way)
        turned = np.ascontiguousarray(store(base))
        turned16 = np.ascontiguousarray(store(deep))
        tag = [(274, "H", 1, way, True)]
        light = (turned / 255).astype(np.float32)
        files = {
            "png": (corpus.png_file(turned, chunks=[(b"eXIf", block[6:])]), base),
            "png16": (corpus.png16_file(turned16, chunks=[(b"eXIf", block[6:])]), deep),
            "webp": (corpus.pillow_file(turned, "WEBP", lossless=True, exif=block), base),
            "jpeg": (corpus.jpeg_file(turned, exif=block), base),
            "tiff": (corpus.pillow_file(turned, "TIFF", tiffinfo={274: way}), base),
            "tiff_lzw": (
                corpus.pillow_file(turned, "TIFF", tiffinfo={274: way}, compression="tiff_lzw"),
                base,
            ),
            "tiff16": (corpus.tiff_file(turned16, extratags=tag), deep),
            "tiff_float": (corpus.tiff_file(light, photometric="rgb", extratags=tag), base / 255),
        }
        for name, (data, upright) in files.items():
            photo = open_photo(data)
            assert photo.encoded.shape == upright.shape, (name, way)
            error = np.abs(photo.encoded.astype(float) - upright).max()
            assert error <= (20 if name == "jpeg" else 1e-6), (name, way)
            assert photo.turned == (way >= 5), (name, way)
            if photo.exif:
                kept = Image.Exif()
                kept.load(photo.exif)
                assert kept.get(274, 1) == 1, (name, way)


def test_alpha_turns_with_the_picture():
    base = np.dstack([corpus.ramp(), corpus.ramp()[..., 1]])
    block = corpus.exif_block(orientation=6)
    stored = np.ascontiguousarray(corpus.STORED[6](base))
    photo = open_photo(corpus.png_file(stored, color_type=6, chunks=[(b"eXIf", block[6:])]))
    np.testing.assert_allclose(photo.alpha, base[..., 3] / 255, atol=1e-7)


def test_xmp_orientation_is_reset_too():
    xmp = b'<x:xmpmeta xmlns:x="adobe:ns:meta/"><a tiff:Orientation="6"/></x:xmpmeta>'
    chunk = (b"iTXt", b"XML:com.adobe.xmp\0\0\0\0\0" + xmp)
    photo = open_photo(corpus.png_file(corpus.ramp(), chunks=[chunk]))
    assert photo.xmp == xmp.replace(b'"6"', b'"1"')


def test_damaged_exif_costs_no_picture():
    rng = np.random.default_rng(7)
    good = corpus.exif_block(
        {0x010F: "Maker", 0x0110: "Model"},
        {0xA405: 28, 0x920A: 4.2},
        {1: "N", 2: (1.0, 2.0, 3.0)},
        6,
    )
    for _ in range(300):
        bad = np.frombuffer(good, np.uint8).copy()
        where = rng.integers(6, len(bad), rng.integers(1, 10))
        bad[where] = rng.integers(0, 256, len(where))
        photo = open_photo(corpus.jpeg_file(corpus.ramp(), exif=bad.tobytes()))
        assert set(photo.size) == {24, 32}
        assert 0.5 <= photo.field_of_view.vertical <= 150


def test_one_value_that_cannot_be_written_costs_no_other():
    read = exif.load(corpus.exif_block({0x010F: "Maker"}, {0xA405: 28, 0x927C: b"secret"}))
    read.get_ifd(0x8825).update({2: (float("nan"),) * 3, 17: 10.0})
    read[0x8825] = read.get_ifd(0x8825)
    with pytest.raises(ValueError, match="NaN"):
        read.tobytes()
    again = exif.load(exif.dump(read))
    assert again[0x010F] == "Maker"
    assert again.get_ifd(0x8769)[0xA405] == 28
    assert again.get_ifd(0x8769)[0x927C] == b"secret"
    assert dict(again.get_ifd(0x8825)) == {17: 10.0}


def test_a_recipe_survives_in_the_comment():
    recipe = {"version": 1, "sun_elevation": 3.5, "note": "ü \U0001f305 <script>"}
    block = exif.dump(None, (4, 4), recipe)
    assert exif.recipe(exif.load(block)) == recipe


@pytest.mark.parametrize("comment", [b"", b"ASCII\0\0\0{", b"ASCII\0\0\0[1]", b"ASCII\0\0\0{" * 9])
def test_another_comment_is_no_recipe(comment):
    block = corpus.exif_block(shot={0x9286: comment, 0xA405: 28})
    assert exif.recipe(exif.load(block)) is None
