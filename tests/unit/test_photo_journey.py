"""Odd pictures on the whole way: opened, analysed, rendered, saved, opened again."""

import warnings

import numpy as np
import photo_corpus as corpus
import pytest

import sunwidget as sw
from sunwidget.renderer.gl_thread import RendererError

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
