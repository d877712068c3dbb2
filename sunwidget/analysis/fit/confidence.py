"""Confidence of a fit to the sky: probabilities, calibrated on known skies.

There are two questions. Will the fitted sky change with the sun as the photo's would? Is an unseen
sun at the position of the fit? Each answer is a logistic regression (as Platt 1999, "Probabilistic
outputs for support vector machines") on features of the fit; ``bench/confidence.py`` draws the
skies, fits the weights and prints the hit rates.

The misfits of all directions that were tried also give a posterior of an unseen sun, and with it
an angle of uncertainty; ``bench/unseen_sun.py`` fits its two weights to real photos.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from sunwidget.geometry.place import wrap_angle

GOOD_FIT = 0.3
"""Largest mean error, in stops, of the sky's change under other suns for a good fit."""

GOOD_SUN = 35.0
"""Largest error, in degrees, of a useful azimuth of an unseen sun."""

# Bias, then the weights of ``features_of_fit`` and of ``features_of_sun``.
FIT_WEIGHTS = (-0.78, -1.73, 0.49, -0.19, -0.33, 3.26)
SUN_WEIGHTS = (1.07, 2.26, 0.34, 0.05)
# E-folds by which a direction's odds fall per misfit of 0.01: where the sky is all that tells, and
# beside the land network, which knows the sky, too.
SUN_ODDS = 2.0
SUN_ODDS_BESIDE = 1.0
# Share of suns in directions that nothing in the picture suggests.
_ANYWHERE = 0.1
# Factor for a sun in plain view, which thick cloud may still hide.
_OVERLOOKED = 0.01
UNKNOWN = 90.0
"""Degrees of spread (``likeliest_sun``) from which the sun's position counts as unknown."""

TURNS = np.arange(-150.0, 181, 30)
HEIGHTS = np.array([-2.0, 2.0, 8.0, 18.0, 35.0, 60.0])
"""Azimuths and elevations of the search, in all combinations."""

_FINE_TURNS = np.arange(-170.0, 181, 10)
_FINE_HEIGHTS = np.array([-2.0, 0.0, 2.0, 5.0, 8.0, 13.0, 18.0, 26.0, 35.0, 47.0, 60.0])
_NEAR = 12.0  # degrees of height over which the azimuth's probabilities are averaged
_CLOSE = 0.15  # relative excess over the best error up to which an air is likely


Seen = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Evidence:
    """Evidence for a fit of the sky.

    Parameters
    ----------
    residual : float
        Mean absolute error of the encoded sky, [0, 1].
    share : float
        Share of the picture that is clear sky.
    spread : float
        Range of the clear sky's angles from the sun in degrees, between the deciles.
    doubt : float
        Standard deviation of log2 of the likely airs' optical depths.
    sun_confidence : float
        Confidence of the sun's position, [0, 1].
    """

    residual: float
    share: float
    spread: float
    doubt: float
    sun_confidence: float = 1.0


def spread_of_angles(azimuth: np.ndarray, elevation: np.ndarray, sun: tuple[float, float]) -> float:
    """Return the range of the sky's angles from the sun, in degrees between the deciles."""
    low, high = np.quantile(_angles(azimuth, elevation, sun), (0.1, 0.9))
    return float(high - low)


def doubt(errors: np.ndarray, levels: np.ndarray) -> float:
    """Return the standard deviation of the ``levels`` (n,) of the likely candidates.

    Candidates with almost the best error are likely: a sharp minimum has one, a flat one many.
    """
    likely = errors <= (1 + _CLOSE) * float(errors.min()) + 0.0005
    return float(np.std(levels[likely]))


def features_of_fit(evidence: Evidence) -> np.ndarray:
    """Return the features of a fit for the regression, (5,)."""
    return np.array(
        [
            np.log2(max(evidence.residual, 0.002) / 0.02),
            np.log2(max(evidence.share, 0.002) / 0.2),
            min(evidence.spread, 90.0) / 30,
            evidence.doubt,
            evidence.sun_confidence,
        ]
    )


def features_of_sun(
    best: tuple[float, float], errors: dict[tuple[float, float], float]
) -> np.ndarray:
    """Return the features of a search for the regression, (3,).

    They are the margin to the best sun elsewhere, the misfit of the best one, and its angle from
    the picture's middle: colors locate a sun in front better than one behind.
    """
    turns = np.array([_turn(sun[0], best[0]) for sun in errors])
    values = np.array(list(errors.values()))
    elsewhere = values[turns > GOOD_SUN]
    own = errors[min(errors, key=lambda sun: _turn(sun[0], best[0]) + abs(sun[1] - best[1]))]
    margin = float(elsewhere.min() / max(own, 1e-4) - 1) if elsewhere.size else 0.0
    return np.array([min(margin, 2.0), np.log2(max(own, 0.002) / 0.02), abs(best[0]) / 90])


def confidence_of_fit(evidence: Evidence) -> float:
    """Return the probability that the fit is good (``GOOD_FIT``), [0, 1]."""
    return probability(FIT_WEIGHTS, features_of_fit(evidence))


def confidence_of_sun(best: tuple[float, float], errors: dict[tuple[float, float], float]) -> float:
    """Return the probability that an unseen sun is near ``best`` (``GOOD_SUN``), [0, 1].

    Parameters
    ----------
    best : (azimuth, elevation)
        Degrees.
    errors : dict
        Misfit of each direction that was tried.
    """
    return probability(SUN_WEIGHTS, features_of_sun(best, errors))


def nowhere(azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
    """Return False for each direction (n,): a sun would be visible in none of them."""
    return np.zeros(azimuth.shape, bool)


def posterior_of_sun(
    errors: dict[tuple[float, float], float],
    expected: np.ndarray,
    seen: Seen = nowhere,
    odds: float = SUN_ODDS,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return azimuths, elevations and probabilities (n,) of an unseen sun.

    Parameters
    ----------
    errors : dict
        Misfit of each of ``TURNS`` and ``HEIGHTS``.
    expected : (6, 12) float
        Prior probability of each of ``HEIGHTS`` and ``TURNS``, without the sky's colors.
    seen : callable, optional
        Takes azimuths and elevations (n,) and returns where a sun would be visible, which
        excludes it there.
    odds : float
        E-folds by which a direction's odds fall per misfit of 0.01.
    """
    misfits = np.array([[errors[a, h] for a in TURNS] for h in HEIGHTS])
    before = (1 - _ANYWHERE) * expected / expected.sum() + _ANYWHERE / expected.size
    logs = _finer(np.log(before) - odds * (misfits - misfits.min()) / 0.01)
    azimuth, elevation = (part.ravel() for part in np.meshgrid(_FINE_TURNS, _FINE_HEIGHTS))
    likely = np.exp(logs - logs.max()).ravel() * np.where(seen(azimuth, elevation), _OVERLOOKED, 1)
    return azimuth, elevation, likely / likely.sum()


def _finer(grid: np.ndarray) -> np.ndarray:
    """Interpolate values of each of ``HEIGHTS`` and ``TURNS`` on a finer grid."""
    rows = [np.interp(_FINE_TURNS, TURNS, row, period=360) for row in grid]
    return np.array([np.interp(_FINE_HEIGHTS, HEIGHTS, column) for column in np.transpose(rows)]).T


def likeliest_sun(
    errors: dict[tuple[float, float], float],
    expected: np.ndarray,
    seen: Seen = nowhere,
    odds: float = SUN_ODDS,
) -> tuple[tuple[float, float], float]:
    """Return the likeliest direction of an unseen sun, and its error at 80 % probability.

    Its height is the posterior's median, which has the least error in any measure that grows with
    height, as light does; its azimuth is the mean within a step of ``TURNS`` around the likeliest
    near that height. If the picture shows that it is not there, it is the likeliest direction of
    all. Parameters as for ``posterior_of_sun``.
    """
    azimuth, elevation, likely = posterior_of_sun(errors, expected, seen, odds)
    of_heights = likely.reshape(_FINE_HEIGHTS.size, -1).sum(1)
    height = float(np.interp(0.5, np.cumsum(of_heights) - of_heights / 2, _FINE_HEIGHTS))
    near = likely * np.exp(-np.square((elevation - height) / _NEAR))
    of_turns = near.reshape(_FINE_HEIGHTS.size, -1).sum(0)
    middle = float(_FINE_TURNS[of_turns.argmax()])
    apart = np.array([wrap_angle(turn - middle) for turn in _FINE_TURNS])
    beside = of_turns * (np.abs(apart) <= TURNS[1] - TURNS[0])
    best = float(wrap_angle(middle + beside @ apart / beside.sum())), height
    if seen(*np.array(best)[:, None])[0]:  # between likely places is one where it is not
        likeliest = likely.argmax()
        best = float(azimuth[likeliest]), float(elevation[likeliest])
    angle = _angles(azimuth, elevation, best)
    order = np.argsort(angle)
    return best, float(np.interp(0.8, np.cumsum(likely[order]), angle[order]))


def _angles(azimuth: np.ndarray, elevation: np.ndarray, sun: tuple[float, float]) -> np.ndarray:
    az, el, height = np.radians(azimuth - sun[0]), np.radians(elevation), np.radians(sun[1])
    cosine = np.sin(el) * np.sin(height) + np.cos(el) * np.cos(height) * np.cos(az)
    return np.asarray(np.degrees(np.arccos(np.clip(cosine, -1, 1))))


def _turn(one: float, other: float) -> float:
    return abs(wrap_angle(one - other))


def probability(weights: tuple[float, ...], features: np.ndarray) -> float:
    """Return the logistic function of bias and weighted features."""
    score = weights[0] + float(features @ np.array(weights[1:]))
    return float(1 / (1 + np.exp(-np.clip(score, -30, 30))))
