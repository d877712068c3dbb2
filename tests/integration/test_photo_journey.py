"""Odd pictures on the whole way: opened, analysed, rendered, saved, opened again."""

import warnings

import numpy as np
import photo_corpus as corpus
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import sunwidget as sw
from sunwidget.errors import RendererError

READABLE = corpus.readable()
ODD = (
    "jpeg_cmyk",
    "png_grey",
    "png_palette_alpha",
    "png_16_alpha",
    "tiff_float",
    "one_pixel",
    "one_wide",
    "one_high",
)


def rendered(scene, edit, **options):
    try:
        return sw.render(scene, edit, **options)
    except RendererError as error:
        pytest.skip(f"no GL on this machine: {error}")


@pytest.fixture(scope="module", params=ODD)
def journey(request):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what each file warns of is tested with the reader
        photo = sw.open(READABLE[request.param].data)
        return photo, sw.analyze(photo)


def test_an_unmoved_sun_gives_the_picture_back(journey, tmp_path):
    photo, scene = journey
    out = rendered(scene, sw.Edit())
    assert np.abs(out.astype(int) - photo.preview(10_000)).max() <= 1
    saved = sw.open(sw.save((scene, sw.Edit()), tmp_path / "out.tif"))
    if photo.bit_depth == 32:
        np.testing.assert_allclose(saved.pixels, np.clip(photo.pixels, 0, 1), atol=4 / 65535)
    else:
        assert np.array_equal(saved.encoded, photo.encoded)
    assert (saved.alpha is None) == (photo.alpha is None)


def test_a_moved_sun_gives_a_picture_of_finite_light(journey):
    photo, scene = journey
    light = rendered(scene, sw.Edit(sun_elevation=2, sun_azimuth=5), dtype="float32")
    assert light.shape == photo.pixels.shape
    assert np.isfinite(light).all()


def test_a_picture_too_wide_for_a_texture_comes_back_as_it_was():
    scene = sw.analyze(READABLE["very_wide"].data)
    assert np.array_equal(rendered(scene, sw.Edit()), scene.photo.encoded)


# What float light can be: nothing, the least, dark, white, far above it, the most that is opened.
LIGHT = st.sampled_from([0.0, 1e-45, 1e-4, 0.2, 1.0, 65504.0, 1e18])
CODES = st.integers(0, 255)


@st.composite
def tiny_pictures(draw):
    """Arrays of 1 to 9 pixels a side, any type that is a picture, in few or many colors."""
    shape = (draw(st.integers(1, 9)), draw(st.integers(1, 9)), draw(st.integers(1, 4)))
    kind, values = draw(st.sampled_from([("u1", CODES), ("u2", CODES), ("f4", LIGHT)]))
    return draw(arrays.arrays(kind, shape, elements=values))


@given(tiny_pictures(), st.floats(-12, 90), st.floats(-180, 180))
@settings(
    # Each is a second's work: few, always the same.
    max_examples=4,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow],
)
def test_whatever_tiny_picture_comes_a_finite_one_leaves(picture, elevation, azimuth):
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # none of NumPy's either
        warnings.simplefilter("ignore", sw.PhotoWarning)
        photo = sw.open(picture)
        scene = sw.analyze(photo)
        unmoved = rendered(scene, sw.Edit())
        moved = rendered(
            scene, sw.Edit(sun_elevation=elevation, sun_azimuth=azimuth), dtype="float32"
        )
    assert np.array_equal(unmoved, photo.preview())
    assert moved.shape == photo.encoded.shape
    assert np.isfinite(moved).all()
