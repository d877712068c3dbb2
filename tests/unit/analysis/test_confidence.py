"""How sure a fit is: less with less evidence, and as often right as it says on known skies."""

import dataclasses

import numpy as np
import pytest
from relight_scenes import known_photo

import sunwidget as sw
from sunwidget.analysis.fit.confidence import (
    GOOD_SUN,
    HEIGHTS,
    TURNS,
    UNKNOWN,
    Evidence,
    confidence_of_fit,
    confidence_of_sun,
    doubt,
    likeliest_sun,
    posterior_of_sun,
    spread_of_angles,
)
from sunwidget.analysis.fit.fit import fit_sky, model_sky, view_angles
from sunwidget.analysis.images.working_copy import Working
from sunwidget.photo.photo import open_photo

CLEAR = Evidence(residual=0.008, share=0.5, spread=40.0, doubt=0.5)


def test_a_clear_sky_with_a_known_sun_is_sure():
    assert confidence_of_fit(CLEAR) > 0.8


@pytest.mark.parametrize(
    "worse",
    [{"residual": 0.06}, {"share": 0.004}, {"sun_confidence": 0.1}],
    ids=lambda worse: next(iter(worse)),
)
def test_less_evidence_is_less_sure(worse):
    assert confidence_of_fit(dataclasses.replace(CLEAR, **worse)) < confidence_of_fit(CLEAR) - 0.1


def test_a_sharp_minimum_leaves_one_answer_and_a_flat_one_many():
    levels = np.arange(-3.0, 4.0)
    assert doubt(0.01 + 0.01 * levels**2, levels) < 0.1
    assert doubt(np.full(7, 0.02), levels) == pytest.approx(2.0)


def test_the_spread_is_that_of_the_angles_from_the_sun():
    azimuth = np.linspace(-20, 20, 400)
    assert spread_of_angles(azimuth, 0 * azimuth, (-30.0, 0.0)) == pytest.approx(32, abs=0.5)
    assert spread_of_angles(azimuth[:1], azimuth[:1], (0.0, 0.0)) == 0


def test_a_sun_that_stands_out_is_surer_than_one_among_equals():
    suns = [(float(a), 20.0) for a in range(-150, 181, 30)]
    flat = dict.fromkeys(suns, 0.02)
    sharp = flat | {(30.0, 20.0): 0.004}
    assert confidence_of_sun((30.0, 20.0), sharp) > confidence_of_sun((30.0, 20.0), flat) + 0.1


ALIKE = np.ones((HEIGHTS.size, TURNS.size))


def misfits(best=None, least=0.004):
    """Misfits of all directions: equal but for that of ``best``."""
    errors = {(float(a), float(h)): 0.03 for h in HEIGHTS for a in TURNS}
    return errors | ({} if best is None else {best: least})


def test_the_posterior_is_a_probability_that_follows_the_misfits():
    azimuth, elevation, likely = posterior_of_sun(misfits((90.0, 18.0)), ALIKE)
    assert likely.sum() == pytest.approx(1)
    assert (azimuth[likely.argmax()], elevation[likely.argmax()]) == (90, 18)
    # What the sky does not tell, the rest of the picture does.
    expected = ALIKE.copy()
    expected[HEIGHTS == 35, TURNS == -60] = 5
    azimuth, elevation, likely = posterior_of_sun(misfits(), expected)
    assert (azimuth[likely.argmax()], elevation[likely.argmax()]) == (-60, 35)
    assert posterior_of_sun(misfits(), ALIKE)[2] == pytest.approx(1 / likely.size)


def test_the_spread_grows_as_the_misfits_level_out_and_at_last_the_photo_does_not_tell():
    best = (90.0, 18.0)
    spreads = [likeliest_sun(misfits(best, least), ALIKE)[1] for least in (1e-3, 0.02, 0.03)]
    assert 0 < spreads[0] < spreads[1] < spreads[2] <= 180
    assert spreads[0] < UNKNOWN <= spreads[2]


def test_between_two_steps_the_azimuth_is_their_mean():
    expected = 1e-6 * ALIKE
    expected[HEIGHTS == 18, (TURNS == 30) | (TURNS == 60)] = 1
    (azimuth, elevation), _ = likeliest_sun(misfits(), expected)
    assert azimuth == pytest.approx(45, abs=5)
    assert elevation == pytest.approx(18, abs=3)


def test_a_sun_between_likely_places_is_not_put_where_the_picture_shows_none():
    expected = 1e-6 * ALIKE
    expected[HEIGHTS == 2, TURNS == 0] = 1
    expected[HEIGHTS == 60, TURNS == 0] = 1

    def seen(azimuth, elevation):
        return (np.abs(azimuth) < 50) & (elevation > 10) & (elevation < 50)

    (azimuth, elevation), _ = likeliest_sun(misfits(), expected, seen)
    assert not seen(azimuth, elevation)


def test_beside_a_network_the_colors_count_less():
    expected = ALIKE.copy()
    expected[HEIGHTS == 18, TURNS == -90] = 20
    colors = misfits((90.0, 18.0), 0.005)
    alone, beside = (likeliest_sun(colors, expected, odds=odds)[0][0] for odds in (2.0, 0.5))
    assert alone == pytest.approx(90, abs=10)
    assert beside == pytest.approx(-90, abs=10)


def fitted(photo, *, told):
    working = Working.of(open_photo(photo.bytes))
    sun = photo.sun if told else None
    return fit_sky(working, photo.sky, photo.opacity, photo.camera, sun)


def wrong_stops(photo, fit):
    """Mean stops by which the fitted sky's change under two other suns is wrong."""
    azimuth, elevation = view_angles(photo.camera, *photo.sky.shape[::-1])
    above = elevation > 1
    where = azimuth[above][::9], elevation[above][::9]

    def change(air, sun, turn, height):
        now = model_sky(air, *where, (sun[0] + turn, height))
        return np.log2(now / model_sky(air, *where, sun))

    wrong = []
    for move in ((-60.0, 2.0), (25.0, 40.0)):
        apart = change(fit.atmosphere, fit.sun, *move) - change(photo.atmosphere, photo.sun, *move)
        wrong.append(np.abs(apart - np.median(apart)).mean())
    return float(np.mean(wrong))


def test_on_known_skies_the_surer_fits_are_the_better_ones():
    cases = [
        ({"sun": (8.0, 14.0)}, True),
        ({"sun": (-20.0, 35.0), "depth": 0.03}, True),
        ({"sun": (3.0, 4.0), "level": 0.2}, True),
        ({"sun": (40.0, 50.0), "tint": (1.25, 1.0, 0.8)}, True),
        ({"sun": (170.0, 8.0)}, False),
        ({"sun": (-120.0, 50.0), "noise": 0.02}, False),
        ({"sun": (90.0, 3.0), "depth": 0.25}, False),
        ({"sun": (140.0, 25.0), "level": 0.6}, False),
    ]
    sure, wrong = [], []
    for options, told in cases:
        photo = known_photo(clouds=False, **options)
        fit = fitted(photo, told=told)
        sure.append(fit.atmosphere.confidence)
        wrong.append(wrong_stops(photo, fit))
    sure, wrong = np.array(sure), np.array(wrong)
    assert np.all((sure >= 0) & (sure <= 1))
    # Those that it is sure of are good (0.3 stops), and better than those that it doubts.
    assert np.median(wrong[sure > 0.7]) < 0.3
    assert wrong[sure >= np.median(sure)].mean() < 0.6 * wrong[sure < np.median(sure)].mean()


def test_a_sun_that_is_told_is_sure_and_one_that_is_guessed_is_not():
    photo = known_photo(clouds=False)
    assert fitted(photo, told=True).sun_confidence == 1
    assert fitted(photo, told=True).sun_spread == 0
    guessed = fitted(photo, told=False)
    assert 0 < guessed.sun_confidence < 1
    assert 0 < guessed.sun_spread < 180
    assert GOOD_SUN < 90


def test_an_unseen_sun_stays_a_guess_when_the_sky_is_fitted_again_without_its_clouds():
    photo = known_photo(clouds=False)
    above = photo.bytes[: len(photo.bytes) // 4]  # the sun stands lower
    scene = sw.analyze(above, sky=np.ones(above.shape[:2], np.float32), refine="none")
    assert scene.sun is None
    assert 0 < scene.sun_confidence < 1
    assert scene.sun_spread > 0


def test_unseen_suns_of_known_skies_lie_within_the_spread_four_times_of_five():
    suns = [(-150, 20), (-100, 8), (-60, 45), (-35, 4), (50, 12), (80, 30), (130, 50), (170, 15)]
    inside = []
    for sun in suns:
        photo = known_photo(sun=sun, clouds=False)
        fit = fitted(photo, told=False)
        inside.append(angle_between(fit.sun, sun) <= fit.sun_spread)
    assert np.mean(inside) >= 0.7


def angle_between(one, other):
    """Degrees between two directions."""
    (a, h), (b, k) = np.radians(one), np.radians(other)
    return np.degrees(np.arccos(np.sin(h) * np.sin(k) + np.cos(h) * np.cos(k) * np.cos(a - b)))


def test_a_photo_without_sky_is_sure_of_nothing_and_says_what_to_do():
    land = np.full((60, 90, 3), 90, np.uint8)
    scene = sw.analyze(land, sky=np.zeros((60, 90), np.float32), refine="none")
    assert scene.atmosphere.confidence == 0
    assert scene.sun_confidence == 0
    assert scene.sun_spread == 180
    told = "does not show where it is. Its position is assumed; click"
    assert any(told in notice for notice in scene.warnings)


def test_a_doubtful_sky_is_told_with_what_to_do():
    random = np.random.default_rng(6)
    picture = random.integers(30, 220, (60, 90, 3)).astype(np.uint8)
    sky = np.zeros((60, 90), np.float32)
    sky[:20] = 1
    scene = sw.analyze(picture, sky=sky, refine="none")
    assert scene.atmosphere.confidence < 0.3
    assert any("changes with the sun is a guess" in notice for notice in scene.warnings)


def test_a_grey_sky_does_not_tell_where_the_sun_is_and_a_clear_one_does():
    random = np.random.default_rng(3)
    grey = np.clip(170 + random.normal(0, 4, (80, 120, 1)), 0, 255).repeat(3, 2).astype(np.uint8)
    clear = known_photo(sun=(60.0, 14.0), clouds=False).bytes
    sky = np.zeros((80, 120), np.float32)
    sky[:50] = 1
    night = (grey * 0.1).astype(np.uint8)
    for picture, untold in ((grey, True), (night, True), (clear, False)):
        scene = sw.analyze(picture, sky=sky, refine="none", sun="outside", horizon=53)
        assert (scene.sun_spread >= UNKNOWN) is untold
        assert any("does not show where it is" in text for text in scene.warnings) is untold
        assert any(f"within {scene.sun_spread:.0f}°" in text for text in scene.warnings) != untold
