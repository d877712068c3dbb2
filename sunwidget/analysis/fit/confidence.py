"""How far a fit to the sky can be believed: probabilities, calibrated on skies that are known.

Two questions. Will the fitted sky change with the sun as the photo's would? Is the sun, where the
photo does not show it, where the fit puts it? Each answer is a logistic regression (as Platt
1999, "Probabilistic outputs for support vector machines") on what the fit saw;
``bench/confidence.py`` draws the skies, fits the weights and prints how often it is right.

And within how many degrees of there does it lie? What every direction that was tried misses the
sky by gives a posterior; ``bench/unseen_sun.py`` fits its two weights to real photos.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

GOOD_FIT = 0.3
"""Mean stops by which the sky's change under other suns may be wrong and the fit still good."""

GOOD_SUN = 35.0
"""Degrees by which the found azimuth of an unseen sun may be wrong and it still serves."""

# Bias, then the weights of ``features_of_fit`` and of ``features_of_sun``.
FIT_WEIGHTS = (-0.78, -1.73, 0.49, -0.19, -0.33, 3.26)
SUN_WEIGHTS = (1.07, 2.26, 0.34, 0.05)
# By how many e-folds a direction's odds fall with a misfit of 0.01.
SUN_ODDS = 2.0
# Share of suns that stand where nothing in the picture lets expect them.
_ANYWHERE = 0.1
# By how much less likely a sun is where it would be seen: behind thick cloud it may not be.
_OVERLOOKED = 0.01
UNKNOWN = 90.0
"""Degrees of spread (``likeliest_sun``) from which the photo does not tell where the sun is."""

TURNS = np.arange(-150.0, 181, 30)
HEIGHTS = np.array([-2.0, 2.0, 8.0, 18.0, 35.0, 60.0])
"""Azimuths and elevations that the search tries: each with each."""

_FINE_TURNS = np.arange(-170.0, 181, 10)
_FINE_HEIGHTS = np.array([-2.0, 0.0, 2.0, 5.0, 8.0, 13.0, 18.0, 26.0, 35.0, 47.0, 60.0])
_NEAR = 12.0  # degrees of height within which a sun's azimuth is asked
_CLOSE = 0.15  # how much worse than the best an air may be and still be one of the likely ones


Seen = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Evidence:
    """What a fit of the sky rests on.

    Parameters
    ----------
    residual : float
        Mean absolute error of the encoded sky, [0, 1].
    share : float
        Share of the picture that is clear sky.
    spread : float
        Degrees from the nearest to the farthest of it from the sun (deciles).
    doubt : float
        log2 by which the optical depths of the likely airs differ (standard deviation).
    told : float
        How sure the sun's place is, [0, 1].
    """

    residual: float
    share: float
    spread: float
    doubt: float
    told: float = 1.0


def spread_of_angles(azimuth: np.ndarray, elevation: np.ndarray, sun: tuple[float, float]) -> float:
    """Return between which angles from the sun the sky is seen: degrees between the deciles."""
    low, high = np.quantile(_angles(azimuth, elevation, sun), (0.1, 0.9))
    return float(high - low)


def doubt(errors: np.ndarray, levels: np.ndarray) -> float:
    """Return how far the likely answers lie apart: deviation of their ``levels``, (n,) each.

    Likely is what is hardly worse than the best: a sharp minimum leaves one, a flat one many.
    """
    likely = errors <= (1 + _CLOSE) * float(errors.min()) + 0.0005
    return float(np.std(levels[likely]))


def features_of_fit(evidence: Evidence) -> np.ndarray:
    """Return what the regression sees of a fit, (5,)."""
    return np.array(
        [
            np.log2(max(evidence.residual, 0.002) / 0.02),
            np.log2(max(evidence.share, 0.002) / 0.2),
            min(evidence.spread, 90.0) / 30,
            evidence.doubt,
            evidence.told,
        ]
    )


def features_of_sun(
    best: tuple[float, float], errors: dict[tuple[float, float], float]
) -> np.ndarray:
    """Return what the regression sees of a search, (3,).

    How much worse the best sun of elsewhere is, how bad the best one is itself, and how near to
    the picture's middle it lies: its colours tell a sun in front better than one behind.
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
        The misfit of each direction that was tried.
    """
    return probability(SUN_WEIGHTS, features_of_sun(best, errors))


def nowhere(azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
    """Return that a sun would be seen in none of these directions, (n,)."""
    return np.zeros(azimuth.shape, bool)


def posterior_of_sun(
    errors: dict[tuple[float, float], float], expected: np.ndarray, seen: Seen = nowhere
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return azimuths, elevations and probabilities (n,) of where an unseen sun may be.

    Parameters
    ----------
    errors : dict
        The misfit of each of ``TURNS`` and ``HEIGHTS``.
    expected : (6, 12) float
        Probability of each of ``HEIGHTS`` and ``TURNS`` before the sky's colours are asked.
    seen : callable, optional
        Tells of azimuths and elevations (n,) where a sun would be seen: there it is not.
    """
    misfits = np.array([[errors[a, h] for a in TURNS] for h in HEIGHTS])
    before = (1 - _ANYWHERE) * expected / expected.sum() + _ANYWHERE / expected.size
    odds = _finer(np.log(before) - SUN_ODDS * (misfits - misfits.min()) / 0.01)
    azimuth, elevation = (part.ravel() for part in np.meshgrid(_FINE_TURNS, _FINE_HEIGHTS))
    likely = np.exp(odds - odds.max()).ravel() * np.where(seen(azimuth, elevation), _OVERLOOKED, 1)
    return azimuth, elevation, likely / likely.sum()


def _finer(grid: np.ndarray) -> np.ndarray:
    """Return values of each of ``HEIGHTS`` and ``TURNS`` on a finer grid."""
    rows = [np.interp(_FINE_TURNS, TURNS, row, period=360) for row in grid]
    return np.array([np.interp(_FINE_HEIGHTS, HEIGHTS, column) for column in np.transpose(rows)]).T


def likeliest_sun(
    errors: dict[tuple[float, float], float], expected: np.ndarray, seen: Seen = nowhere
) -> tuple[tuple[float, float], float]:
    """Return where an unseen sun is taken to be, and within how many degrees, 4 times of 5.

    Its height is the posterior's median, which errs least in every measure that grows with height,
    as its light does; its azimuth is the likeliest near that height. Takes what
    ``posterior_of_sun`` takes.
    """
    azimuth, elevation, likely = posterior_of_sun(errors, expected, seen)
    of_heights = likely.reshape(_FINE_HEIGHTS.size, -1).sum(1)
    height = float(np.interp(0.5, np.cumsum(of_heights) - of_heights / 2, _FINE_HEIGHTS))
    near = likely * np.exp(-np.square((elevation - height) / _NEAR))
    turn = near.reshape(_FINE_HEIGHTS.size, -1).sum(0).argmax()
    best = float(_FINE_TURNS[turn]), height
    angle = _angles(azimuth, elevation, best)
    order = np.argsort(angle)
    return best, float(np.interp(0.8, np.cumsum(likely[order]), angle[order]))


def _angles(azimuth: np.ndarray, elevation: np.ndarray, sun: tuple[float, float]) -> np.ndarray:
    az, el, height = np.radians(azimuth - sun[0]), np.radians(elevation), np.radians(sun[1])
    cosine = np.sin(el) * np.sin(height) + np.cos(el) * np.cos(height) * np.cos(az)
    return np.asarray(np.degrees(np.arccos(np.clip(cosine, -1, 1))))


def _turn(one: float, other: float) -> float:
    return abs((one - other + 180) % 360 - 180)


def probability(weights: tuple[float, ...], features: np.ndarray) -> float:
    """Return the logistic function of bias and weighted features."""
    score = weights[0] + float(features @ np.array(weights[1:]))
    return float(1 / (1 + np.exp(-np.clip(score, -30, 30))))
