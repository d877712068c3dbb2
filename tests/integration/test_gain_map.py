"""Light above white: drawn by the frame, kept in a JPEG's gain map, read by other programs."""

import dataclasses
import io
import struct

import numpy as np
import photo_corpus as corpus
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.errors import EditError, PhotoError, PhotoWarning
from sunwidget.export.gain_map import map_between
from sunwidget.export.gain_map_file import append_gain_map, with_gain_map_xmp
from sunwidget.formats import gain_map as gain_maps
from sunwidget.formats import xmp
from sunwidget.formats.color import LUMINANCE
from sunwidget.formats.gain_map import GainMap, segments

SIZE = (768, 512)
EDIT = sw.Edit(sun_elevation=5)
STOPS = 3
DARK = 1 / 256  # of light: below it 8 bits alone are further off than what is asked for here


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(sw.sample("coast"))


@pytest.fixture(scope="module")
def light(scene):
    """The frame without and with light above white."""
    plain = sw.render(scene, EDIT, dtype="float32", size=SIZE)
    return plain, sw.render(scene, EDIT, dtype="float32", size=SIZE, headroom=STOPS)


@pytest.fixture(scope="module")
def saved(scene, tmp_path_factory):
    """The same frame as JPEG: ``plain``, with a ``map``, and with one at quality 100, ``exact``."""
    folder = tmp_path_factory.mktemp("gain_map")
    sw.save((scene, EDIT), folder / "plain.jpg", size=SIZE)
    sw.save((scene, EDIT), folder / "map.jpg", size=SIZE, headroom=STOPS)
    sw.save((scene, EDIT), folder / "exact.jpg", size=SIZE, headroom=STOPS, quality=100)
    return folder


def scan(data):
    """All of a JPEG but its APP segments and what follows its end."""
    gone = [(at, at + 4 + len(body)) for kind, at, body in segments(data) if 0xE0 <= kind <= 0xEF]
    kept, start = b"", 0
    for begin, end in gone:
        kept += data[start:begin]
        start = end
    return kept + data[start : data.index(b"\xff\xd9", start) + 2]


def elsewhere(path, boost=None):
    """What libultrahdr decodes: (H, W, 3) float32 linear light, all of the map applied.

    With a ``boost`` of 1 none of it is.
    """
    imagecodecs = pytest.importorskip("imagecodecs")
    read = imagecodecs.ultrahdr_decode(path.read_bytes(), dtype=np.float16, boost=boost)
    return read[..., :3].astype(np.float32)


def stops(light, other, dark=0.0):
    return np.log2((np.maximum(light, 0) + dark + 1e-9) / (other + dark + 1e-9))


def test_the_moved_sun_and_its_glitter_rise_above_white_and_nothing_else_does(scene, light):
    plain, bright = light
    assert plain.max() < 1.01
    assert 0.9 * 2**STOPS < bright.max() <= 2**STOPS
    camera = scene.camera.resized(*SIZE)
    x, y = camera.pixel(scene.automatic["sun_azimuth"], EDIT.sun_elevation)
    row, column = np.unravel_index(bright[..., 1].argmax(), bright.shape[:2])
    assert np.hypot(column - x, row - y) < 8
    ratio = stops(bright @ LUMINANCE, plain @ LUMINANCE, DARK)
    assert 0 < (ratio > 1).mean() < 0.001
    water = ratio[round(camera.horizon_row()) + 8 :]
    assert (water > 0.2).sum() > 200
    assert np.percentile(np.abs(ratio), 90) < 0.05


def test_an_unmoved_sun_has_no_light_above_white(scene):
    bright = sw.render(scene, dtype="float32", size=SIZE, headroom=STOPS)
    assert np.array_equal(bright, sw.render(scene, dtype="float32", size=SIZE))


@pytest.mark.parametrize("headroom", [-1, 9, float("nan"), "3", True, None])
def test_a_senseless_headroom_is_refused(scene, tmp_path, headroom):
    with pytest.raises(EditError, match="stops from 0 to 8"):
        sw.render(scene, EDIT, dtype="float32", headroom=headroom)
    with pytest.raises(EditError, match="stops from 0 to 8"):
        sw.save((scene, EDIT), tmp_path / "a.jpg", headroom=headroom)
    assert list(tmp_path.iterdir()) == []


def test_headroom_needs_a_picture_that_holds_light_above_white(scene, tmp_path):
    with pytest.raises(EditError, match="float32"):
        sw.render(scene, EDIT, headroom=1)
    for name, bits in (("a.png", None), ("a.webp", None), ("a.tif", 16)):
        with pytest.raises(PhotoError, match="light above white"):
            sw.save((scene, EDIT), tmp_path / name, headroom=1, bit_depth=bits)
    with pytest.raises(PhotoError, match="rendered scene"):
        sw.save(np.zeros((4, 4, 3), np.float32), tmp_path / "a.jpg", headroom=1)


def test_the_picture_itself_is_that_of_an_export_without_a_map(saved):
    plain, mapped = (saved / "plain.jpg").read_bytes(), (saved / "map.jpg").read_bytes()
    assert scan(mapped) == scan(plain)
    assert len(mapped) < 1.3 * len(plain)


def test_another_reader_finds_the_light_that_the_map_adds(saved, light):
    plain, bright = light
    added = stops(elsewhere(saved / "map.jpg"), sw.open(saved / "map.jpg").pixels, DARK)
    error = np.abs(added - stops(bright, plain, DARK)).max(axis=-1)
    assert (error < 0.05).mean() > 0.99


def test_at_quality_100_another_reader_finds_the_luminance_of_the_frame(saved, light):
    wanted = light[1] @ LUMINANCE
    error = np.abs(stops(elsewhere(saved / "exact.jpg") @ LUMINANCE, wanted))
    # In blacks one level of 8 bits is a tenth of a stop, and decoders round in their own ways.
    assert (error[wanted > DARK] < 0.05).mean() > 0.99
    assert (error < 0.05).mean() > 0.98


def test_we_read_our_own_map_as_the_other_reader_does(saved):
    photo = sw.open(saved / "map.jpg")
    assert photo.recipe == EDIT
    assert photo.gain_map.size == SIZE
    assert photo.gain_map.headroom == pytest.approx(STOPS, abs=0.1)
    ours, theirs = photo.gain_map.applied(photo.pixels), elsewhere(saved / "map.jpg")
    # Half floats and a table of 1024 gains there.
    on_theirs = photo.gain_map.applied(elsewhere(saved / "map.jpg", boost=1.0))
    assert np.abs(stops(on_theirs, theirs, DARK)).max() < 0.01
    # The first picture's blacks decoders round in their own ways.
    error = np.abs(stops(ours, theirs, DARK))
    assert np.percentile(error[photo.pixels @ LUMINANCE > 4 * DARK], 99) < 0.03
    assert np.percentile(error, 99.9) < 0.05


def test_a_screen_shows_as_much_of_the_map_as_it_can(saved):
    photo = sw.open(saved / "map.jpg")
    most = [float(photo.gain_map.applied(photo.pixels, stops).max()) for stops in (0, 1, 2, 9)]
    assert most == sorted(most)
    assert most[0] == pytest.approx(1, abs=0.01)
    assert most[1] == pytest.approx(2, rel=0.05)
    assert most[3] == float(photo.gain_map.applied(photo.pixels).max())


def test_a_place_that_no_light_is_added_to_keeps_its_light_to_the_bit():
    ramp = np.linspace(0, 1, 3 * 64 * 64, dtype=np.float32).reshape(64, 64, 3)
    bright = ramp.copy()
    bright[-8:, -8:] *= (6, 3, 0.8)
    found = map_between([(slice(0, 64), ramp, bright)], (64, 64), sw.open(np.zeros((1, 1))).profile)
    level = round(-255 * found.low[0] / (found.high[0] - found.low[0]))
    assert (found.levels[:-16, :-16] == level).all()
    assert np.allclose(found.applied(ramp)[:-16, :-16], ramp[:-16, :-16], rtol=1e-5, atol=1e-6)


def test_nothing_above_white_makes_no_map_and_says_so(scene, tmp_path):
    dark = sw.Edit(sun_elevation=-12)
    with pytest.warns(PhotoWarning, match="brighter than white"):
        path = sw.save((scene, dark), tmp_path / "a.jpg", size=(96, 64), headroom=STOPS)
    assert sw.open(path).gain_map is None


def test_exr_and_tiff_hold_the_light_itself(scene, tmp_path):
    pytest.importorskip("OpenEXR")
    wanted = sw.render(scene, EDIT, dtype="float32", size=(192, 128), headroom=STOPS)
    for name in ("a.exr", "a.tif", "a.hdr"):
        more = {"bit_depth": 32} if name == "a.tif" else {}
        path = sw.save((scene, EDIT), tmp_path / name, size=(192, 128), headroom=STOPS, **more)
        assert sw.open(path).pixels.max() == pytest.approx(wanted.max(), rel=0.005)


def test_a_wide_profile_is_multiplied_in_its_own_colours(scene, tmp_path):
    photo = sw.open(
        corpus.png_file(scene.photo.encoded[::8, ::8], 8, 2, [corpus.icc_chunk(corpus.DISPLAY_P3)])
    )
    small = sw.analyze(photo)
    path = sw.save((small, EDIT), tmp_path / "a.jpg", headroom=STOPS, quality=100)
    read = sw.open(path)
    linear = dataclasses.replace(read.profile, matrix=None).decode(read.encoded)
    ours = read.profile.to_light(read.profile._levels(np.clip(linear, 0, 1)))
    assert np.allclose(ours, read.pixels, atol=1e-4)
    wanted = sw.render(small, EDIT, dtype="float32", headroom=STOPS)
    shown = read.gain_map.applied(linear) @ np.float32(read.profile.matrix.T)
    error = np.abs(stops(shown @ LUMINANCE, wanted @ LUMINANCE, DARK))
    assert (error < 0.05).mean() > 0.99


def photo_with_map(**told):
    """Return a photo's JPEG with a small grey map of four levels, and the map."""
    given = GainMap(b"", (-0.5,) * 3, (2.5,) * 3, headroom=2.5, **told)
    levels = np.repeat(np.uint8([[0, 80], [160, 255]]), 8, 0).repeat(12, 1)[..., None]
    made = dataclasses.replace(given, jpeg=gain_maps.packed(levels, given))
    out = io.BytesIO()
    packet = with_gain_map_xmp(None, made, 65_500)
    Image.fromarray(corpus.ramp()).save(out, "JPEG", quality=95, xmp=packet)
    return append_gain_map(out.getvalue(), made), made


def test_the_map_that_a_photo_came_with_is_kept_to_the_bit_while_nothing_is_moved(tmp_path):
    data, made = photo_with_map()
    photo = sw.open(data)
    assert photo.gain_map.jpeg == made.jpeg
    again = sw.open(sw.save(photo, tmp_path / "photo.jpg"))
    assert again.gain_map.jpeg == made.jpeg
    unmoved = sw.open(sw.save(sw.analyze(photo), tmp_path / "scene.jpg", headroom=3))
    assert unmoved.gain_map.jpeg == made.jpeg
    assert unmoved.gain_map == dataclasses.replace(again.gain_map)
    moved = sw.save((sw.analyze(photo), sw.Edit(exposure=-1)), tmp_path / "moved.jpg")
    assert sw.open(moved).gain_map is None
    assert b"hdr-gain-map" not in moved.read_bytes()


def test_a_map_changes_nothing_of_the_picture_that_is_opened():
    data, _ = photo_with_map()
    end = data.index(b"\xff\xd9", data.index(b"\xff\xda")) + 2
    with Image.open(io.BytesIO(data[:end])) as image:
        assert np.array_equal(sw.open(data).encoded, np.asarray(image))


def test_a_map_is_found_without_word_of_it_in_the_pictures_xmp():
    _, made = photo_with_map()
    photo = sw.open(append_gain_map(corpus.jpeg_file(corpus.ramp()), made))
    assert (photo.format, photo.gain_map.jpeg) == ("JPEG", made.jpeg)
    assert photo.notes == ()


@pytest.mark.parametrize("way", [1, 3, 6, 8])
def test_a_turned_photo_turns_its_map(way):
    data, made = photo_with_map()
    with Image.open(io.BytesIO(data)) as image:
        exif = image.getexif()
    exif[0x0112] = way
    block = exif.tobytes()
    turned = data[:2] + gain_maps.segment(0xE1, block) + data[2:]
    # The index counts from its own beginning, so that what stands before it moves nothing.
    grown = len(block) + 4
    at = turned.index(b"MPF\0") + 4 + 50
    size = struct.unpack_from(">I", turned, at + 4)[0]
    turned = turned[: at + 4] + struct.pack(">I", size + grown) + turned[at + 8 :]
    photo = sw.open(turned)
    assert photo.turned == (way in {6, 8})
    from sunwidget.formats.pixels import upright

    wanted = upright(made.levels, way).astype(int)
    assert np.abs(photo.gain_map.levels.astype(int) - wanted).max() <= 3  # packed once more


def test_iso_and_xmp_tell_the_same_of_a_map(saved):
    whole = sw.open(saved / "map.jpg").gain_map
    iso = next(b for _, _, b in segments(whole.jpeg) if b.startswith(gain_maps.ISO_NAME))
    without = whole.jpeg.replace(gain_maps.segment(0xE2, iso), b"")
    told = gain_maps._read(without)
    for name in ("low", "high", "gamma", "base_offset", "other_offset", "headroom"):
        assert getattr(told, name) == pytest.approx(getattr(whole, name), abs=1e-5)


def test_one_denominator_for_all_numbers_is_read():
    numbers = [0, 300, -50, 300, 100, 1, 2]
    told = struct.pack(">HHBIIIiiIii", 0, 0, 0x48, 100, *numbers)
    found = gain_maps._from_iso(b"", told)
    assert (found.low[0], found.high[2], found.gamma[1]) == (-0.5, 3.0, 1.0)
    assert (found.headroom, found.base_offset[0], found.other_offset[0]) == (3.0, 0.01, 0.02)


def test_a_damaged_map_costs_no_picture():
    data, made = photo_with_map()
    picture = data[: -len(made.jpeg)]
    rng = np.random.default_rng(5)
    for _ in range(200):
        noise = bytearray(data)
        for at in rng.integers(20, 600, 4):
            noise[at] = rng.integers(256)
        for at in rng.integers(len(picture), len(picture) + 700, 8):
            noise[at] = rng.integers(256)
        try:
            photo = sw.open(bytes(noise))
        except PhotoError:
            continue  # the picture's own head was hit
        assert photo.gain_map is None or np.isfinite(photo.gain_map.applied(photo.pixels)).all()
    assert sw.open(picture).gain_map is None


def test_xmp_of_the_photo_stays_beside_word_of_the_map():
    packet = xmp.with_gain_map(xmp.record(None, {"sun_elevation": 3}, "sunwidget"), 1234)
    assert b'Item:Length="1234"' in packet
    assert xmp.recipe(packet) == {"sun_elevation": 3}
    again = xmp.without_gain_map(packet)
    assert b"hdr-gain-map" not in again
    assert b"Container:" not in again
    assert xmp.recipe(again) == {"sun_elevation": 3}
    assert xmp.with_gain_map(b"no xml", 5).count(b"GainMap") == 1


def test_the_command_line_writes_a_map(tmp_path, capsys):
    from sunwidget.cli.main import main

    out = tmp_path / "a.jpg"
    flags = ["--sun-elevation", "5", "--headroom", "3", "--size", "192x128", "-o", str(out)]
    assert main(["render", "sample:coast", *flags]) == 0
    assert sw.open(out).gain_map.size == (192, 128)
    assert main(["render", "sample:coast", "--headroom", "9", "-o", str(tmp_path / "b.jpg")]) != 0
    assert "0 to 8" in capsys.readouterr().err
