"""Coarse sky: our network, foreign networks, masks, and clear errors."""

import numpy as np
import pytest

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.segmentation import coarse_sky
from sunwidget.errors import AnalysisError
from sunwidget.photo.photo import open_photo


def working(picture: np.ndarray) -> Working:
    return Working.of(open_photo(picture))


def landscape() -> np.ndarray:
    picture = np.empty((120, 160, 3), np.uint8)
    picture[:70] = np.linspace((80, 130, 210), (170, 200, 230), 70)[:, None]
    noise = np.random.default_rng(0).integers(-20, 20, (50, 160, 1))
    picture[70:] = np.clip(np.array((70, 90, 40)) + noise, 0, 255)
    return picture


def test_bundled_network_tells_blue_sky_from_grass():
    probability = coarse_sky.network(working(landscape()))
    rows = np.linspace(0, len(probability), 13).astype(int)
    assert probability[rows[1] : rows[6]].mean() > 0.9
    assert probability[rows[8] : rows[11]].mean() < 0.1


def test_network_answers_in_zero_to_one_at_its_own_size():
    probability = coarse_sky.network(working(landscape()))
    assert probability.shape == (384, 384)
    assert probability.dtype == np.float32
    assert 0 <= probability.min() <= probability.max() <= 1


def test_skyline_method_needs_no_network():
    mask = coarse_sky.skyline(working(landscape()))
    edge = round(70 / 120 * len(mask))
    assert mask[: edge - 3].mean() > 0.95
    assert mask[edge + 3 :].mean() < 0.05


def test_a_missing_network_says_where_it_was_looked_for(tmp_path):
    with pytest.raises(AnalysisError, match=r"No sky network at .*gone\.onnx"):
        coarse_sky.coarse(working(landscape()), tmp_path / "gone.onnx")


def test_a_broken_network_is_an_error_in_words(tmp_path):
    path = tmp_path / "broken.onnx"
    path.write_bytes(b"no network at all")
    with pytest.raises(AnalysisError, match="not an ONNX network"):
        coarse_sky.coarse(working(landscape()), path)


def test_an_unknown_method_names_the_known_ones():
    with pytest.raises(AnalysisError, match="network, skyline"):
        coarse_sky.coarse(working(landscape()), "netwrok")


@pytest.mark.parametrize(
    ("mask", "top"),
    [
        (np.ones((6, 8), bool), 1),
        (np.full((6, 8), 255, np.uint8), 1),
        (np.full((6, 8), 65535, np.uint16), 1),
        (np.full((6, 8), 0.5), 0.5),
        (np.full((6, 8, 3), 255, np.uint8), 1),
        (np.full((6, 8), 1, np.uint8), 1),
    ],
)
def test_masks_of_every_kind_come_out_in_zero_to_one(mask, top):
    assert coarse_sky.mask_from(mask).tolist() == np.full((6, 8), top).tolist()


@pytest.mark.parametrize(
    ("mask", "word"),
    [
        (np.ones(5), "shape"),
        (np.full((4, 4), np.nan), "NaN"),
        (object(), "mask array"),
        (np.ones((0, 4)), "shape"),
    ],
)
def test_what_is_no_mask_is_refused_in_words(mask, word):
    with pytest.raises(AnalysisError, match=word):
        coarse_sky.mask_from(mask)


def test_a_rotated_mask_is_refused():
    with pytest.raises(AnalysisError, match="rotated"):
        coarse_sky.mask_from(np.ones((160, 120)), (160, 120))


def test_a_mask_is_never_read_by_what_starts_a_program(tmp_path):
    # Pillow would hand this to Ghostscript, whatever its name.
    path = tmp_path / "mask.png"
    path.write_bytes(b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n%%EndComments\nshowpage\n")
    with pytest.raises(AnalysisError, match=r"sky mask cannot be read: mask.png is not a picture"):
        coarse_sky.coarse(Working.of(open_photo(np.zeros((9, 9, 3), np.uint8))), path, (9, 9))
