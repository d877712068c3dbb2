"""A drawn sea: what analyze finds in it, what a person may tell it, and what it refuses."""

import cv2
import numpy as np
import pytest
from analysis_pictures import seascape

import sunwidget as sw
from sunwidget.analysis import frame_inputs
from sunwidget.errors import AnalysisError

SIZE = (240, 160)


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(seascape(*SIZE), fov=45.0)


def test_layers_and_surface_are_stacks_in_range(scene):
    for stack, channels in ((frame_inputs.layers(scene), 4), (frame_inputs.surface(scene), 4)):
        assert stack.shape == (*SIZE[::-1], channels)
        assert stack.dtype == np.float32
        assert 0 <= stack.min() <= stack.max() <= 1


def test_sky_sun_and_horizon_of_a_drawn_sea_are_found(scene):
    assert scene.sky[:90].mean() > 0.97
    assert scene.sky[102:].mean() < 0.02
    assert scene.horizon.row == pytest.approx(96, abs=2)
    assert scene.sun is not None
    assert (scene.sun.x, scene.sun.y) == pytest.approx((168, 56), abs=3)


def test_the_suns_pixels_are_sky_and_not_cloud(scene):
    inside = scene.sun.mask > 0.5
    assert inside.any()
    assert scene.sky[inside].min() > 0.9
    assert scene.cloud_softness[inside].max() < 0.1


def test_the_suns_angles_lead_back_to_its_pixel(scene):
    pixel = scene.camera.pixel(scene.sun.azimuth, scene.sun.elevation)
    assert pixel == pytest.approx((scene.sun.x, scene.sun.y), abs=1e-6)


def test_uniforms_are_finite_numbers(scene):
    for name, value in frame_inputs.uniforms(scene).items():
        assert np.isfinite(np.ravel(value)).all(), name


def test_a_told_sun_horizon_field_of_view_and_sky_win_over_detection():
    mask = np.zeros(SIZE[::-1], bool)
    mask[:50] = True
    told = sw.analyze(
        seascape(*SIZE), sun=(30.0, 20.0), horizon=70.0, fov=25.0, sky=mask, refine="none"
    )
    assert (told.sun.x, told.sun.y, told.sun.source) == (30.0, 20.0, "hint")
    assert (told.horizon.row, told.horizon.source) == (70.0, "hint")
    assert told.camera.fov_vertical_deg == 25.0
    assert told.camera.horizon_row() == pytest.approx(70.0)
    # The matte follows the picture's edges within its window of 6 px, and decides nothing anew.
    assert told.sky[:43].min() > 0.99
    assert told.sky[57:].max() < 0.02


def test_nothing_below_a_told_horizon_is_sky():
    everything = np.ones(SIZE[::-1], np.float32)
    told = sw.analyze(seascape(*SIZE), sky=everything, refine="none", horizon=60.0, fov=45.0)
    assert told.sky[70:].max() == 0
    assert told.sky[:54].min() > 0.99


def test_the_path_of_a_mask_is_the_mask(tmp_path):
    mask = np.zeros(SIZE[::-1], np.uint8)
    mask[:64] = 255
    path = tmp_path / "mask.png"
    cv2.imwrite(str(path), mask)
    by_path = sw.analyze(seascape(*SIZE), sky=path, refine="none", fov=45.0)
    by_array = sw.analyze(seascape(*SIZE), sky=mask, refine="none", fov=45.0)
    assert np.array_equal(by_path.sky, by_array.sky)
    assert np.array_equal(by_path.sky_coarse > 0.5, mask > 0)


@pytest.mark.parametrize(
    ("hints", "words"),
    [
        ({"sun": "noon"}, r"sun must be a pair"),
        ({"sun": (1, 2, 3)}, r"sun must be a pair"),
        ({"sun": (np.nan, 2)}, r"finite"),
        ({"horizon": "sea"}, r"row in pixels or two points"),
        ({"horizon": np.inf}, r"row in pixels or two points"),
        ({"horizon": ((1, 2), (1, 3))}, r"different x"),
        ({"horizon": ((1, 2), (1, 3), (4, 5))}, r"two points"),
        ({"fov": 0}, r"1 to 150 degrees"),
        ({"fov": "wide"}, r"1 to 150 degrees"),
        ({"sky": "magic"}, r"network, skyline"),
        ({"sky": "/no/such/mask.png"}, r"sky mask cannot be read: There is no file"),
        ({"sky": "/no/such/net.onnx"}, r"No sky network at"),
        ({"sky": np.zeros((160, 30))}, r"shapes must agree"),
        ({"refine": "scissors"}, r"choose one of .*grabcut_mask"),
        ({"clouds": "dream"}, r"choose one of .*unmix"),
        ({"sun_method": "guess"}, r"choose one of .*disc_fit"),
        ({"horizon_method": "guess"}, r"choose one of .*robust_line"),
        ({"depth": "sonar"}, r"choose one of .*ground_plane"),
        ({"water": "moat"}, r"choose one of .*network"),
        ({"water": ["none"]}, r"water= takes a mask array"),
        ({"water": np.zeros((160, 30))}, r"shapes must agree"),
    ],
)
def test_a_hint_that_cannot_be_used_is_refused_with_what_to_do(hints, words):
    with pytest.raises(AnalysisError, match=words):
        sw.analyze(seascape(60, 40), **hints)


def test_a_file_that_is_no_picture_is_refused_as_a_mask(tmp_path):
    path = tmp_path / "mask.png"
    path.write_bytes(b"not a picture")
    with pytest.raises(AnalysisError, match="not a picture that sunwidget reads"):
        sw.analyze(seascape(60, 40), sky=path)


def test_opencv_without_contrib_is_explained(monkeypatch):
    monkeypatch.delattr(cv2, "ximgproc")
    with pytest.raises(AnalysisError, match=r"opencv-contrib-python-headless.*clouds='rb_ratio'"):
        sw.analyze(seascape(60, 40), fov=45.0)
    assert sw.analyze(seascape(60, 40), fov=45.0, clouds="rb_ratio").sky.shape == (40, 60)
