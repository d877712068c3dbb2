"""The sky model fitted to photos that were drawn with a known one."""

import numpy as np
import pytest
from relight_scenes import known_photo

from sunwidget.analysis.fit.confidence import HEIGHTS, TURNS
from sunwidget.analysis.fit.fit import Response, fit_sky, view_angles
from sunwidget.analysis.images.working_copy import Working
from sunwidget.photo.photo import open_photo


def fitted(photo, *, sun="told", expected=None):
    working = Working.of(open_photo(photo.bytes))
    return fit_sky(
        working,
        photo.sky,
        photo.opacity,
        photo.camera,
        photo.sun if sun == "told" else None,
        expected,
    )


def model_error(photo, fit):
    """Median stops between the fitted clear sky and the true one, after the best level."""
    azimuth, elevation = view_angles(photo.camera, *photo.sky.shape[::-1])
    sky = (photo.sky > 0) & (elevation > 1)
    truth = known_model(photo, azimuth[sky], elevation[sky])
    stops = np.log2(fit.model(azimuth[sky], elevation[sky]) / truth)
    return float(np.median(np.abs(stops - np.median(stops))))


def known_model(photo, azimuth, elevation):
    from sunwidget.analysis.fit.fit import model_sky

    return model_sky(photo.atmosphere, azimuth, elevation, photo.sun) * photo.gain


@pytest.mark.parametrize("depth", [0.03, 0.12, 0.25])
def test_haze_is_recovered_within_a_step_of_the_search(depth):
    fit = fitted(known_photo(depth=depth, clouds=False))
    # Steps are a factor of two; aerosol and the response's contrast trade against each other.
    assert depth / 2.2 <= fit.atmosphere.aerosol_optical_depth <= depth * 2.2
    assert fit.atmosphere.residual < 0.02


@pytest.mark.parametrize("sun", [(8.0, 14.0), (-20.0, 35.0), (3.0, 4.0)])
def test_the_fitted_sky_is_the_true_one_within_a_tenth_of_a_stop(sun):
    photo = known_photo(sun=sun, clouds=False)
    assert model_error(photo, fitted(photo)) < 0.1


@pytest.mark.parametrize("tint", [(1.25, 1.0, 0.8), (0.85, 1.0, 1.2)])
def test_white_balance_is_recovered(tint):
    photo = known_photo(tint=tint, clouds=False)
    gain = np.array(fitted(photo).gain)
    found = gain / gain[1] / (photo.gain / photo.gain[1])
    assert np.abs(np.log2(found)).max() < 0.15


@pytest.mark.parametrize("level", [0.15, 0.35, 0.6])
def test_exposure_is_recovered(level):
    photo = known_photo(level=level, clouds=False)
    fit = fitted(photo)
    azimuth, elevation = view_angles(photo.camera, *photo.sky.shape[::-1])
    sky = (photo.sky > 0) & (elevation > 1)
    # In the picture: what the fitted model and response show is what the photo shows.
    shown = fit.response.display_light(fit.model(azimuth[sky], elevation[sky]))
    unclipped = photo.linear[sky].max(-1) < 0.9
    apart = np.abs(shown ** (1 / 2.2) - photo.linear[sky] ** (1 / 2.2))[unclipped]
    assert np.median(apart) < 0.02


@pytest.mark.parametrize("response", [Response(0.5, 1.0), Response(0.95, 0.85)])
def test_another_response_is_followed(response):
    photo = known_photo(response=response, clouds=False)
    fit = fitted(photo)
    assert fit.atmosphere.residual < 0.025
    assert abs(fit.response.contrast - response.contrast) <= 0.16


def test_noise_and_clouds_move_the_fit_little():
    calm = fitted(known_photo(clouds=False, noise=0.0))
    rough = fitted(known_photo(noise=0.02))
    ratio = rough.atmosphere.aerosol_optical_depth / calm.atmosphere.aerosol_optical_depth
    assert 1 / 2.2 < ratio < 2.2
    assert np.abs(np.log2(np.array(rough.gain) / calm.gain)).max() < 1


def test_the_same_photo_gives_the_same_fit():
    assert fitted(known_photo()) == fitted(known_photo())


@pytest.mark.parametrize("side", [-60.0, 60.0])
def test_an_unseen_sun_is_found_in_its_quadrant(side):
    photo = known_photo(sun=(side, 20.0), clouds=False)
    azimuth, elevation = fitted(photo, sun="unseen").sun
    assert np.sign(azimuth) == np.sign(side)
    assert 20 <= abs(azimuth) <= 130
    assert 2 <= elevation <= 60


def test_a_sun_behind_the_camera_is_not_put_before_it():
    photo = known_photo(sun=(170.0, 25.0), clouds=False)
    azimuth, _ = fitted(photo, sun="unseen", expected=around(150.0, 35.0)).sun
    assert abs(azimuth) > 90


def around(azimuth, elevation):
    """What is expected of a sun of which something else than the sky tells."""
    far = np.abs((TURNS - azimuth + 180) % 360 - 180) / 60
    high = np.abs(np.searchsorted(HEIGHTS, elevation) - np.arange(HEIGHTS.size))
    return np.exp(-(far**2) - high[:, None] ** 2)


@pytest.mark.parametrize("value", [0, 40, 255])
def test_a_photo_without_sky_has_finite_defaults(value):
    picture = np.full((40, 60, 3), value, np.uint8)
    photo = known_photo(size=(60, 40))
    working = Working.of(open_photo(picture))
    nothing = np.zeros((40, 60), np.float32)
    fit = fit_sky(working, nothing, nothing, photo.camera, None, around(30.0, 35.0))
    azimuth, elevation = fit.sun
    assert azimuth == 30.0
    assert 26.0 < elevation < 47.0  # half way to the heights beside 35° that are expected, too
    assert fit.atmosphere.residual is None
    assert np.isfinite(fit.gain).all()
    assert min(fit.gain) > 0
    assert np.isfinite(fit.model(np.array([0.0]), np.array([45.0]))).all()


def test_a_burnt_out_sky_has_finite_defaults():
    photo = known_photo(size=(60, 40))
    working = Working.of(open_photo(np.full((40, 60, 3), 255, np.uint8)))
    fit = fit_sky(working, np.ones((40, 60), np.float32), 0 * photo.opacity, photo.camera, None)
    assert np.isfinite(fit.gain).all()
    assert min(fit.gain) > 0


@pytest.mark.parametrize("response", [Response(), Response(0.5, 0.7), Response(0.99, 1.15)])
def test_the_response_and_its_inverse_agree_below_the_shoulders_end(response):
    display = np.linspace(0.001, 0.98, 200)
    assert np.allclose(response.display_light(response.scene_light(display)), display, rtol=1e-3)
    assert np.all(np.diff(response.scene_light(display)) > 0)


def test_a_fit_tells_how_far_it_is_and_ends_when_told_to():
    photo = known_photo(clouds=False)
    working = Working.of(open_photo(photo.bytes))
    arguments = working, photo.sky, photo.opacity, photo.camera, None, None
    told = []
    fit_sky(*arguments, told.append)
    assert told == sorted(told)
    assert told[-1] == 1
    # Fourteen rings of suns, then eighteen airs.
    assert max(np.diff([0.0, *told])) < 0.1

    def stop(share):
        told.append(share)
        raise InterruptedError

    told.clear()
    with pytest.raises(InterruptedError):
        fit_sky(*arguments, stop)
    assert len(told) == 1
