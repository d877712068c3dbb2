"""The camera: the test vector of the model's description, its inverse, and the rendered scenes."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sunwidget.geometry.camera import Camera

VECTOR = Camera(1600, 1200, 50.0, pitch=8.0, roll=3.0)
cameras = st.builds(
    Camera,
    st.integers(1, 5000),
    st.integers(1, 5000),
    st.floats(10, 120),
    st.floats(-70, 70),
    st.floats(-40, 40),
)


def test_focal_length_and_up_vector_agree_with_the_worked_example():
    assert VECTOR.focal == pytest.approx(1286.704, abs=1e-3)
    assert VECTOR.up == pytest.approx((0.051827, -0.988911, 0.139173), abs=1e-6)


def test_horizon_of_the_worked_example_crosses_the_given_rows():
    assert VECTOR.horizon_row(np.array([0, 800, 1600])) == pytest.approx(
        [739.156, 781.083, 823.009], abs=1e-3
    )


def test_pixel_of_the_worked_example_has_the_given_direction():
    azimuth, elevation = VECTOR.angles(1200, 150)
    assert elevation == pytest.approx(26.9944, abs=1e-4)
    assert azimuth == pytest.approx(17.2751, abs=1e-4)


def test_horizon_points_give_pitch_and_roll_back():
    camera = Camera.from_horizon(1600, 1200, 50, ((0, 739.156), (1600, 823.009)))
    assert (camera.pitch, camera.roll) == pytest.approx((8, 3), abs=1e-4)
    camera = Camera.from_horizon(1600, 1200, 50, 781.083, roll=3)
    assert (camera.pitch, camera.roll) == pytest.approx((8, 3), abs=1e-4)


@given(cameras)
def test_camera_axes_are_orthonormal_and_right_handed(camera):
    axes = np.array([camera.right, camera.up, camera.forward])
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-9)
    assert np.cross(camera.forward, camera.up) == pytest.approx(np.array(camera.right), abs=1e-9)


@given(cameras, st.floats(-3, 4), st.floats(-3, 4))
def test_pixel_inverts_angles_inside_and_outside_the_picture(camera, u, v):
    x, y = u * camera.width, v * camera.height
    back = camera.pixel(*camera.angles(x, y))
    # A direction near 90° off the axis loses digits as the tangent: the tolerance follows it.
    reach = np.hypot(x - camera.width / 2, y - camera.height / 2) / camera.focal
    assert back == pytest.approx((x, y), abs=1e-6 * camera.focal * (1 + reach) ** 2)


@given(cameras, st.floats(-1, 2))
def test_every_point_of_the_horizon_has_elevation_zero(camera, u):
    x = u * camera.width
    assert camera.angles(x, camera.horizon_row(x))[1] == pytest.approx(0, abs=1e-6)


def test_a_direction_behind_the_camera_has_no_pixel():
    x, y = Camera(640, 480, 50).pixel(np.array([0, 120, 180, -120]), 10)
    assert np.isfinite(x).tolist() == [True, False, False, False]
    assert np.isfinite(y).tolist() == [True, False, False, False]


def test_scalars_give_floats_and_arrays_keep_their_shape():
    azimuth, elevation = VECTOR.angles(3, 4)
    assert type(azimuth) is float
    assert type(elevation) is float
    assert VECTOR.angles(np.zeros((2, 3)), np.zeros((2, 3)))[0].shape == (2, 3)
    assert VECTOR.pixel(np.zeros(5), 1.0)[1].shape == (5,)


def test_sun_pixels_of_the_rendered_scenes_are_found_from_their_angles(shared):
    files = sorted((shared / "truth").glob("*.json"))
    files += [shared / "samples" / s / f"{s}.json" for s in ("coast", "mountains")]
    assert len(files) == 5
    for path in files:
        scene = json.loads(path.read_text())
        camera = Camera.from_horizon(
            scene["width"], scene["height"], scene["fov_v_deg"], scene["horizon_row"]
        )
        assert camera.pitch == pytest.approx(scene["pitch_deg"], abs=1e-6)
        for frame in scene["frames"]:
            zoom = scene["width"] / frame.get("width", scene["width"])
            expected = (frame["sun_x"] * zoom, frame["sun_y"] * zoom)
            assert camera.pixel(frame["az_deg"], frame["el_deg"]) == pytest.approx(
                expected, abs=0.01
            )


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        ((0, 10, 50.0), "1 × 1"),
        ((10, 10, 0.0), "field of view"),
        ((10, 10, float("nan")), "field of view"),
        ((10, 10, 50.0, 90.0), "Pitch"),
        ((10, 10, 50.0, 0.0, float("inf")), "Roll"),
    ],
)
def test_impossible_cameras_are_refused_in_words(arguments, word):
    with pytest.raises(ValueError, match=word):
        Camera(*arguments)


def test_a_vertical_horizon_is_refused():
    with pytest.raises(ValueError, match="different x"):
        Camera.from_horizon(10, 10, 50, ((3, 1), (3, 5)))
