"""Colour profiles, judged by colour-science and LittleCMS, neither of which is ours."""

import io

import colour
import numpy as np
import photo_corpus as corpus
import pytest
from PIL import Image, ImageCms

from sunwidget.errors import PhotoWarning
from sunwidget.export.stills import encode_like
from sunwidget.formats.color import SRGB, linear_to_srgb, srgb_to_linear
from sunwidget.formats.icc import ProfileError, read_profile
from sunwidget.photo.photo import open_photo

CODE = np.arange(256) / 255
PROFILES = {
    "srgb": corpus.PLAIN_SRGB,
    "display_p3": corpus.DISPLAY_P3,
    "adobe_rgb": corpus.ADOBE_RGB,
    "table_curve": corpus.matrix_profile(
        corpus.P3_PRIMARIES, ("table", (np.arange(1024) / 1023) ** 1.8)
    ),
    "bt709_curve": corpus.matrix_profile(
        corpus.SRGB_PRIMARIES, ("para", 3, (1 / 0.45, 1 / 1.099, 0.099 / 1.099, 1 / 4.5, 0.081))
    ),
    "offset_curve": corpus.matrix_profile(
        corpus.ADOBE_PRIMARIES, ("para", 4, (2.2, 0.95, 0.05, 0.1, 0.02, 0.0, 0.0))
    ),
}
PRIMARIES = {"display_p3": "Display P3", "adobe_rgb": "Adobe RGB (1998)"}


def with_profile(codes, icc):
    chunks = [corpus.icc_chunk(icc)]
    if codes.dtype == np.uint16:
        return open_photo(corpus.png16_file(codes, chunks=chunks))
    return open_photo(corpus.png_file(codes, chunks=chunks))


def all_levels():
    """Every 8-bit level in each channel against far corners, and 20,000 random colors."""
    levels = np.arange(256)
    parts = [np.stack([levels, levels, levels], -1)]
    for channel in range(3):
        for rest in (0, 255):
            part = np.full((256, 3), rest)
            part[:, channel] = levels
            parts.append(part)
    parts.append(np.random.default_rng(0).integers(0, 256, (20_000, 3)))
    return np.concatenate(parts)[None].astype(np.uint8)


def all_deep_levels():
    levels = np.arange(65536)
    parts = [np.stack([levels, levels, levels], -1)]
    parts.append(np.stack([levels, levels * 0, 65535 - levels], -1))
    parts.append(np.random.default_rng(0).integers(0, 65536, (50_000, 3)))
    return np.concatenate(parts)[None].astype(np.uint16)


def test_srgb_agrees_with_the_standard():
    np.testing.assert_allclose(srgb_to_linear(CODE), colour.models.eotf_sRGB(CODE), atol=1e-6)
    np.testing.assert_allclose(
        linear_to_srgb(CODE), colour.models.eotf_inverse_sRGB(CODE), atol=2e-6
    )


@pytest.mark.parametrize("name", PRIMARIES)
def test_wide_gamut_photos_become_the_light_that_colour_science_says(name):
    codes = all_levels()
    photo = with_profile(codes, PROFILES[name])
    expected = colour.RGB_to_RGB(
        codes / 255, PRIMARIES[name], "sRGB", "Bradford", apply_cctf_decoding=True
    )
    # A profile stores primaries and exponents to 16 bits after the point or fewer.
    np.testing.assert_allclose(photo.pixels, expected, atol=3e-4)
    assert photo.pixels.min() < -0.05


@pytest.mark.parametrize("name", ["display_p3", "adobe_rgb", "table_curve", "bt709_curve"])
def test_previews_agree_with_littlecms(name):
    codes = corpus.ramp(64, 64)
    photo = with_profile(codes, PROFILES[name])
    theirs = ImageCms.profileToProfile(
        Image.fromarray(codes),
        ImageCms.ImageCmsProfile(io.BytesIO(PROFILES[name])),
        ImageCms.createProfile("sRGB"),
        renderingIntent=ImageCms.Intent.RELATIVE_COLORIMETRIC,
        flags=ImageCms.Flags.HIGHRESPRECALC,
    )
    difference = np.abs(photo.preview().astype(int) - np.asarray(theirs).astype(int))
    # LittleCMS works through an 8-bit table: a level here and there.
    assert difference.max() <= 2
    assert difference.mean() < 0.25


@pytest.mark.parametrize("name", PROFILES)
def test_every_8_bit_code_comes_back_through_linear_light(name):
    photo = with_profile(all_levels(), PROFILES[name])
    assert np.array_equal(photo.profile.encode(photo.pixels, np.uint8), photo.encoded)


@pytest.mark.parametrize("name", ["srgb", "display_p3"])
def test_every_16_bit_code_comes_back_through_linear_light(name):
    photo = with_profile(all_deep_levels(), PROFILES[name])
    back = photo.profile.encode(photo.pixels, np.uint16)
    assert np.abs(back.astype(int) - photo.encoded).max() <= 4


@pytest.mark.parametrize("name", PROFILES)
@pytest.mark.parametrize("levels", [all_levels, all_deep_levels])
def test_unmoved_light_keeps_its_code_values_exactly(name, levels):
    photo = with_profile(levels(), PROFILES[name])
    # The light went through a GPU: the same numbers in another array.
    assert np.array_equal(encode_like(photo, photo.pixels.copy()), photo.encoded)


def test_moved_pixels_leave_the_others_alone():
    photo = with_profile(corpus.ramp16(), PROFILES["adobe_rgb"])
    light = photo.pixels.copy()
    light[3:7, 5:9] *= 0.5
    codes = encode_like(photo, light)
    moved = np.zeros(codes.shape[:2], bool)
    moved[3:7, 5:9] = True
    assert np.array_equal(codes[~moved], photo.encoded[~moved])
    assert (codes[moved].astype(int) <= photo.encoded[moved]).all()
    expected = photo.profile.encode(light, np.uint16)
    assert np.array_equal(codes[moved], expected[moved])


def test_moved_8_bit_pixels_are_dithered_by_less_than_a_level_and_always_alike():
    light = np.repeat(np.linspace(0.2, 0.21, 4096, dtype=np.float32)[None, :, None], 64, 0)
    light = np.repeat(light, 3, -1)
    photo = open_photo(np.zeros(light.shape, np.uint8))
    codes = encode_like(photo, light)
    assert np.array_equal(codes, encode_like(photo, light))
    exact = linear_to_srgb(light) * 255
    assert np.abs(codes - exact).max() < 1.01
    # Averaged over a column, dithering shows what lies between two levels: no bands.
    assert np.abs(codes.mean(axis=(0, 2)) - exact.mean(axis=(0, 2))).max() < 0.25
    assert np.abs(codes.mean() - exact.mean()) < 0.01


def test_a_profile_that_only_says_srgb_is_srgb():
    photo = with_profile(corpus.ramp(), PROFILES["srgb"])
    assert photo.profile.is_srgb
    assert photo.icc == PROFILES["srgb"]
    littlecms = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    assert read_profile(littlecms).is_srgb


def test_grey_stays_grey_in_every_profile():
    grey = np.repeat(np.arange(256, dtype=np.uint8)[None, :, None], 3, -1)
    for icc in PROFILES.values():
        light = with_profile(grey, icc).pixels
        assert np.ptp(light, axis=-1).max() < 1e-5


def test_a_grey_profile_is_converted_to_srgb():
    grey = np.arange(256, dtype=np.uint8).reshape(16, 16)
    data = corpus.png_file(grey, color_type=0, chunks=[corpus.icc_chunk(corpus.grey_profile(1.8))])
    with pytest.warns(PhotoWarning, match="gray tone curve"):
        photo = open_photo(data)
    assert photo.icc is None
    expected = np.rint(255 * linear_to_srgb((grey / 255.0) ** 1.8))
    assert np.abs(photo.encoded[..., 0] - expected).max() <= 1


def test_cmyk_goes_through_its_own_profile():
    ink = np.zeros((2, 2, 4), np.uint8)
    ink[0, 1] = (255, 0, 0, 0)  # cyan alone
    ink[1, 0] = (0, 0, 0, 255)  # black alone
    data = corpus.pillow_file(Image.fromarray(ink, "CMYK"), "TIFF", icc_profile=corpus.CMYK_PROFILE)
    with pytest.warns(PhotoWarning, match="CMYK"):
        photo = open_photo(data)
    assert photo.encoded[0, 0].min() > 250
    # Lab (60, −35, −45), which the profile gives cyan, not Pillow's (0, 255, 255).
    lab = colour.XYZ_to_Lab(
        colour.RGB_to_XYZ(photo.encoded[0, 1] / 255, "sRGB", apply_cctf_decoding=True)
    )
    assert lab[0] == pytest.approx(60, abs=4)
    assert photo.encoded[0, 1, 1] < 200
    assert photo.encoded[1, 0].max() < 25
    assert photo.icc is None


def test_a_table_profile_is_converted_with_a_note():
    codes = np.zeros((2, 2, 3), np.uint8)
    codes[0, 0] = 255
    codes[1, 1] = (255, 0, 0)
    with pytest.warns(PhotoWarning, match="look-up table"):
        photo = with_profile(codes, corpus.LUT_RGB)
    assert photo.icc is None
    assert photo.encoded[0, 0].min() > 250
    assert photo.encoded[0, 1].max() < 5
    red, green, blue = photo.encoded[1, 1].astype(int)
    assert red > 100 + green
    assert red > 100 + blue


def adobe_by_exif(color_space=65535):
    block = corpus.exif_block(shot={0xA001: color_space, 0xA005: {1: "R03"}})
    return corpus.png_file(all_levels(), chunks=[(b"eXIf", block[6:])])


def test_adobe_rgb_named_by_exif_alone_is_converted_to_srgb():
    with pytest.warns(PhotoWarning, match="Adobe RGB according to its EXIF"):
        photo = open_photo(adobe_by_exif())
    profiled = with_profile(all_levels(), corpus.ADOBE_RGB)
    assert photo.profile.is_srgb
    assert np.abs(photo.encoded.astype(int) - profiled.preview(30_000)).max() <= 1


def test_an_srgb_mark_wins_over_the_adobe_one():
    assert np.array_equal(open_photo(adobe_by_exif(1)).encoded, all_levels())


@pytest.mark.parametrize("gamma", [1.0, 0.55, 0.3])
def test_a_png_with_another_gamma_is_converted_to_srgb(gamma):
    chunk = (b"gAMA", round(gamma * 100_000).to_bytes(4, "big"))
    with pytest.warns(PhotoWarning, match="has a gamma of"):
        photo = open_photo(corpus.png16_file(all_deep_levels(), chunks=[chunk]))
    expected = linear_to_srgb((all_deep_levels() / 65535) ** (1 / gamma))
    assert np.abs(photo.encoded / 65535 - expected).max() < 2e-5


@pytest.mark.parametrize("extra", [[], [(b"sRGB", b"\0")]])
def test_the_gamma_that_every_srgb_png_names_changes_nothing(extra):
    chunks = [*extra, (b"gAMA", (45455 if not extra else 100_000).to_bytes(4, "big"))]
    assert np.array_equal(
        open_photo(corpus.png_file(corpus.ramp(), chunks=chunks)).encoded, corpus.ramp()
    )


@pytest.mark.parametrize("length", [0, 100, 131, 132, 140, 200, 300, 400])
def test_a_profile_that_was_cut_is_left_out_with_a_note(length):
    with pytest.warns(PhotoWarning, match="profile"):
        photo = with_profile(corpus.ramp(), corpus.DISPLAY_P3[:length] or b"\0")
    assert photo.icc is None
    assert np.array_equal(photo.encoded, corpus.ramp())


@pytest.mark.parametrize(
    "icc",
    [
        corpus.matrix_profile(corpus.SRGB_PRIMARIES, ("gamma", 0.0)),
        corpus.matrix_profile(corpus.SRGB_PRIMARIES, ("gamma", 99.0)),
        corpus.matrix_profile(corpus.SRGB_PRIMARIES, ("table", np.full(16, 0.5))),
        corpus.matrix_profile(corpus.SRGB_PRIMARIES, ("para", 3, (2.4, -1, 1, 1, 0.5))),
        corpus.matrix_profile(corpus.SRGB_PRIMARIES, ("para", 9, (2.4,))),
        corpus.matrix_profile(((0.3, 0.3), (0.3, 0.3001), (0.15, 0.06))),
    ],
)
def test_a_senseless_profile_is_refused(icc):
    with pytest.raises(ProfileError):
        read_profile(icc)


def test_every_damaged_profile_is_read_or_refused():
    rng = np.random.default_rng(5)
    good = np.frombuffer(corpus.matrix_profile(corpus.P3_PRIMARIES), np.uint8)
    for _ in range(500):
        bad = good.copy()
        where = rng.integers(0, len(bad), rng.integers(1, 12))
        bad[where] = rng.integers(0, 256, len(where))
        try:
            profile = read_profile(bad.tobytes())
        except ProfileError:
            continue
        light = profile.decode(all_levels()[:, :300])
        assert np.isfinite(light).all()
        assert np.isfinite(profile.encode(light)).all()


def test_light_out_of_gamut_is_clamped_on_the_way_out():
    light = np.array([[[-0.2, 0.5, 1.7]]], np.float32)
    assert SRGB.encode(light).tolist() == [[[0, 188, 255]]]
