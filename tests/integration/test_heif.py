"""HEIC photos: pixels, what is told of them, and what phones keep beside them."""

import importlib.util
import io
import struct
import sys
import warnings

import heif_files
import numpy as np
import photo_corpus as corpus
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.analysis.depth.depth import check_depth
from sunwidget.analysis.depth.network import SeenDepth
from sunwidget.errors import PhotoError, PhotoWarning
from sunwidget.export.gain_map_file import append_gain_map
from sunwidget.formats import apple_gain_map, exif
from sunwidget.formats.color import SRGB_CURVE
from sunwidget.formats.gain_map import GainMap
from sunwidget.photo.decode_heif import DepthMap, is_heif

needs_libheif = pytest.mark.skipif(
    importlib.util.find_spec("pillow_heif") is None,
    reason="pillow-heif is not installed: pip install 'sunwidget[heif]'",
)


def apple_note(high, gain):
    """A maker note with the two numbers that tell the headroom of the gain map."""
    entries = [(0x21, high), (0x30, gain)]
    body = b"Apple iOS\0\0\1MM" + struct.pack(">H", len(entries))
    place = len(body) + 12 * len(entries) + 4
    for number, (tag, _) in enumerate(entries):
        body += struct.pack(">HHII", tag, 10, 1, place + 8 * number)
    body += bytes(4)
    return body + b"".join(struct.pack(">ii", round(v * 1e6), 10**6) for _, v in entries)


def block(note=b"secret", way=1):
    return corpus.exif_block(
        {0x010F: "Maker", 0x0112: way},
        {0xA405: 28, 0x920A: 4.25, 0x927C: note},
        {1: "N", 2: (50.0, 3.0, 57.6), 3: "W", 4: (5.0, 42.0, 57.6), 17: 242.8},
    )


@needs_libheif
def test_a_heic_keeps_pixels_camera_place_and_profile(tmp_path):
    codes = corpus.ramp()
    path = tmp_path / "photo.heic"
    path.write_bytes(heif_files.heic(codes, exif=block(), icc_profile=corpus.DISPLAY_P3))
    photo = sw.open(path)
    assert (photo.format, photo.bit_depth, photo.turned) == ("HEIF", 8, False)
    assert np.array_equal(photo.encoded, codes)
    assert photo.facts.focal_35mm == 28
    assert photo.latitude == pytest.approx(50.066, abs=1e-3)
    assert photo.heading == pytest.approx(242.8)
    assert photo.icc == corpus.DISPLAY_P3
    assert photo.depth is None
    assert photo.gain_map is None
    again = sw.open(sw.save(photo, tmp_path / "photo.png"))
    assert np.array_equal(again.encoded, codes)
    assert again.facts == photo.facts


@needs_libheif
@pytest.mark.parametrize("way", [1, 3, 6, 8])
def test_a_turned_heic_comes_upright_as_pillow_heif_shows_it(way):
    data = heif_files.heic(corpus.ramp(), exif=block(way=way))
    photo = sw.open(data)
    import pillow_heif

    assert np.array_equal(photo.encoded, np.asarray(pillow_heif.open_heif(data)))
    assert photo.turned == (way >= 5)
    assert exif.orientation(exif.load(photo.exif)) == 1


@needs_libheif
def test_ten_bits_become_sixteen_with_white_at_the_top():
    codes = np.uint16(np.linspace(0, 65535, 64 * 48 * 3).reshape(48, 64, 3))
    codes[-1, -1] = 65535
    photo = sw.open(heif_files.heic(codes))
    assert photo.bit_depth == 16
    assert photo.encoded.max() == 65535
    assert np.abs(photo.encoded.astype(int) - codes).max() < 65535 / 1023


@needs_libheif
def test_other_primaries_without_a_profile_are_converted_and_told():
    codes = np.full((32, 32, 3), (0, 200, 0), np.uint8)
    with pytest.warns(PhotoWarning, match="primaries"):
        photo = sw.open(heif_files.heic(codes, color_primaries=12, transfer_characteristics=13))
    # Display P3's green is greener than any of sRGB's.
    assert photo.profile.is_srgb
    assert tuple(photo.encoded[0, 0]) == pytest.approx(
        (0, SRGB_CURVE.encode(1.042 * 0.5776) * 255, 0), abs=2
    )


@needs_libheif
@pytest.mark.parametrize(("transfer", "name"), [(16, "PQ"), (18, "HLG")])
def test_code_values_of_other_screens_are_refused_by_name(transfer, name):
    data = heif_files.heic(corpus.ramp(), transfer_characteristics=transfer)
    with pytest.raises(PhotoError, match=f"{name}.*Export it as JPEG"):
        sw.open(data)


@needs_libheif
def test_further_pictures_are_told_and_not_used():
    import pillow_heif

    file = pillow_heif.HeifFile()
    for level in (10, 200):
        file.add_frombytes("RGB", (64, 64), bytes([level]) * 64 * 64 * 3)
    out = io.BytesIO()
    file.save(out, primary_index=1)
    with pytest.warns(PhotoWarning, match="2 pictures"):
        photo = sw.open(out.getvalue())
    assert photo.encoded.mean() == pytest.approx(200, abs=2)


@needs_libheif
def test_an_iphones_gain_map_is_read_by_its_own_formula_and_saved_in_a_jpeg(tmp_path):
    levels = np.tile(np.linspace(0, 255, 16).astype(np.uint8), (12, 1))
    note = apple_note(1.0, 0.0)  # three stops
    data = heif_files.heic(corpus.ramp(), [(heif_files.APPLE_GAIN_MAP, levels)], exif=block(note))
    photo = sw.open(data)
    assert photo.gain_map.size == (16, 12)
    assert photo.gain_map.headroom == pytest.approx(3)
    grey = np.full((12, 16, 3), 0.5, np.float32)
    wanted = 0.5 * (1 + 7 * SRGB_CURVE.decode(levels / 255.0))
    error = np.abs(np.log2(photo.gain_map.applied(grey)[..., 0] / wanted))
    assert error.max() < 0.05
    again = sw.open(sw.save(photo, tmp_path / "photo.jpg"))
    assert again.gain_map.jpeg == photo.gain_map.jpeg


@pytest.mark.parametrize("in_xmp", [True, False])
def test_the_map_behind_an_iphones_jpeg_is_read_as_well(in_xmp):
    packet = (
        b'<x:xmpmeta xmlns:x="adobe:ns:meta/" xmlns:HDRGainMap="http://ns.apple.com/HDRGainMap/1.0/"'
        b' HDRGainMap:HDRGainMapVersion="131072"'
        + (b' HDRGainMap:HDRGainMapHeadroom="8.0"' if in_xmp else b"")
        + b"/>"
    )
    levels = np.tile(np.linspace(0, 255, 16).astype(np.uint8), (12, 1))
    behind = corpus.pillow_file(levels, "JPEG", quality=100, xmp=packet)
    note = b"" if in_xmp else apple_note(1.0, 0.0)
    picture = corpus.jpeg_file(corpus.ramp(), exif=block(note))
    photo = sw.open(append_gain_map(picture, GainMap(behind)))
    wanted = 1 + 7 * SRGB_CURVE.decode(levels / 255.0)
    found = photo.gain_map.applied(np.ones((12, 16, 3), np.float32))[..., 0]
    assert np.abs(np.log2(found / wanted)).max() < 0.1
    assert sw.open(picture).gain_map is None


@pytest.mark.parametrize(
    ("high", "gain", "stops"),
    [(0.5, 0.005, 1.7), (0.5, 0.5, 1.5505), (1.2, 0.001, 2.93), (1.2, 1.0, 2.0), (0.5, 30, 0.0)],
)
def test_the_maker_note_tells_the_headroom(high, gain, stops):
    found = apple_gain_map.headroom(exif.load(block(apple_note(high, gain))))
    assert np.log2(found) == pytest.approx(stops, abs=1e-4)


def test_other_maker_notes_tell_none():
    whole = apple_note(1.0, 0.0)
    for note in (b"secret", b"Apple iOS\0", whole[:30], whole[:20] + b"\xff" * 40):
        assert apple_gain_map.headroom(exif.load(block(note))) is None
    assert apple_gain_map.headroom(None) is None


def test_a_map_without_headroom_is_none():
    assert apple_gain_map.gain_map(np.zeros((4, 4), np.uint8), 1.0) is None


@pytest.fixture(scope="module")
def coast():
    """A sample with the depth that the plane below its horizon has, as a phone would keep it."""
    photo = sw.sample("coast")
    scene = sw.analyze(photo, depth="ground_plane")
    near = 1 / scene.depth[::8, ::8]
    levels = np.rint(255 * np.clip(near / np.percentile(near, 99), 0, 1)).astype(np.uint8)
    return photo.encoded[::2, ::2], levels, scene


@needs_libheif
def test_a_phones_depth_is_the_scenes_unless_another_is_asked_for(coast):
    codes, levels, wanted = coast
    photo = sw.open(heif_files.heic(codes, [(heif_files.DEPTH, levels)]))
    assert photo.depth.kind == "inverse"
    assert np.array_equal(photo.depth.values, levels)
    scene = sw.analyze(photo)
    assert isinstance(scene.hints.depth, SeenDepth)
    land = np.isfinite(scene.depth) & (wanted.depth[::2, ::2] < 30)
    error = np.log(scene.depth[land] / wanted.depth[::2, ::2][land])
    # Up to a scale: the ground plane tells it, by a horizon that is found in another picture.
    assert np.median(np.abs(error - np.median(error))) < 0.05
    assert np.abs(np.median(error)) < 0.3
    assert sw.analyze(photo, depth="ground_plane").hints.depth is None
    told = sw.analyze(photo, depth=np.full((8, 12), 5.0))
    assert np.median(told.depth[np.isfinite(told.depth)]) == pytest.approx(5, rel=0.01)


@needs_libheif
def test_maps_that_do_not_fit_or_make_no_sense_cost_no_picture():
    codes = corpus.ramp()
    square = np.tile(np.arange(64, dtype=np.uint8), (64, 1))
    flat = np.full((24, 32), 7, np.uint8)
    for kind, levels in ((heif_files.DEPTH, square), (heif_files.DEPTH, flat)):
        photo = sw.open(heif_files.heic(codes, [(kind, levels)]))
        assert photo.depth is None
        assert np.array_equal(photo.encoded, codes)
    without_headroom = [(heif_files.APPLE_GAIN_MAP, square[:48])]
    assert sw.open(heif_files.heic(codes, without_headroom)).gain_map is None


def test_a_depth_map_that_grows_away_from_the_camera_is_no_disparity():
    values = np.tile(np.linspace(1, 50, 32, dtype=np.float32)[:, None], (1, 48))
    assert check_depth(DepthMap(values, "depth"), (48, 32)).kind == "depth"


@needs_libheif
def test_damaged_heics_are_refused_or_opened_and_nothing_else():
    data = heif_files.heic(
        corpus.ramp(), [(heif_files.DEPTH, np.tile(np.arange(64, dtype=np.uint8), (48, 1)))]
    )
    rng = np.random.default_rng(3)
    for cut in (12, 40, 300, len(data) // 2):
        with pytest.raises(PhotoError, match="damaged"):
            sw.open(data[:cut])
    without_depth = sw.open(data[:-100])
    assert without_depth.depth is None
    assert np.array_equal(without_depth.encoded, corpus.ramp())
    for _ in range(100):
        noise = bytearray(data)
        for at in rng.integers(12, len(data), 6):
            noise[at] = rng.integers(256)
        try:
            with warnings.catch_warnings(action="ignore", category=PhotoWarning):
                photo = sw.open(bytes(noise))
        except PhotoError:
            continue
        assert photo.encoded.shape[2] == 3


def test_without_libheif_a_heic_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "pillow_heif", None)
    with pytest.raises(PhotoError, match=r"sunwidget\[heif\].*export it as JPEG"):
        sw.open(b"\0\0\0\x18ftypheic" + bytes(64))


def test_an_avif_is_no_heic():
    out = io.BytesIO()
    Image.fromarray(corpus.ramp()).save(out, "AVIF")
    assert not is_heif(out.getvalue())
    assert sw.open(out.getvalue()).format == "AVIF"
