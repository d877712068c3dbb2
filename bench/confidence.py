"""Reliability of the fit's confidence: draws known skies, fits them, and calibrates.

    python bench/confidence.py            # evaluate the shipped weights
    python bench/confidence.py --fit      # also fit those of sunwidget/analysis/fit/confidence.py

The skies are drawn by our own model under random sun, haze, camera and clouds, with grain and
with responses unknown to the search. The error is measured in what it affects: how the sky
changes when the sun moves, in stops, after the best gain.
"""

import argparse
from typing import Any

import cv2
import numpy as np

from sunwidget.analysis.fit import confidence as stage
from sunwidget.analysis.fit import fit
from sunwidget.analysis.images.working_copy import Working, encode
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.geometry.camera import Camera

Known = tuple[np.ndarray, np.ndarray]  # features (n, k) and outcomes (n,)
SIZE = (96, 64)
MOVES = ((-60.0, 2.0), (25.0, 12.0), (0.0, 40.0))


def draw(random: np.random.Generator) -> tuple[Any, ...]:
    """Return a small photo of a known sky: the inputs of ``fit_sky``, and the truth."""
    width, height = SIZE
    camera = Camera.from_horizon(
        width, height, random.uniform(20, 75), random.uniform(0.35, 1.05) * height
    )
    azimuth, elevation = fit.view_angles(camera, width, height)
    air = Atmosphere(
        aerosol_optical_depth=float(2 ** random.uniform(-6, -1)),
        aerosol_asymmetry=random.uniform(0.55, 0.9),
        angstrom_exponent=random.uniform(0.5, 1.8),
        aerosol_albedo=0.9,
    )
    sun = (random.uniform(-180, 180), float(2 ** random.uniform(0, 6)))
    response = fit.Response(random.uniform(0.3, 0.99), random.uniform(0.7, 1.3))
    light = fit.model_sky(air, azimuth, np.maximum(elevation, 0.2), sun)
    sky = (elevation > 0) & (elevation > random.uniform(-20, 25) * np.sin(azimuth / 9))
    tint = np.exp(random.normal(0, 0.1, 3))
    level = response.scene_light(np.array([random.uniform(0.15, 0.6)]))[0]
    gain = tint * level / max(float(np.median(light[sky])) if sky.any() else 1.0, 1e-6)
    clouds = cv2.GaussianBlur(random.standard_normal((height, width)), (0, 0), 5)
    cover = np.clip(
        (clouds - np.quantile(clouds, min(1 - random.uniform(-0.4, 0.9), 1.0))) * 20, 0, 1
    )
    white = (light * gain).mean() * random.uniform(1.2, 3)
    scene = light * gain + cover[..., None] * (white - light * gain)
    linear = np.clip(response.display_light(scene), 0, 1)
    code = encode(linear) + random.uniform(0.001, 0.02) * random.standard_normal(linear.shape)
    encoded = np.clip(code, 0, 1).astype(np.float32)
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    working = Working(linear.astype(np.float32), encoded, encoded, (1.0, 1.0))
    # Cloud maps are never exact.
    seen = np.clip(cover * random.uniform(0.7, 1) + random.uniform(0, 0.1), 0, 1)
    return working, sky.astype(np.float32), seen.astype(np.float32), camera, air, sun


def stops_wrong(
    found: fit.SkyFit, air: Atmosphere, sun: tuple[float, float], camera: Camera
) -> float:
    """Return the mean error, in stops, of the fitted sky's change over ``MOVES``."""
    azimuth, elevation = fit.view_angles(camera, *SIZE)
    above = elevation > 1
    where = azimuth[above][::7], elevation[above][::7]

    def change(air: Atmosphere, sun: tuple[float, float], turn: float, height: float) -> np.ndarray:
        now = fit.model_sky(air, *where, (sun[0] + turn, height))
        return np.asarray(np.log2(now / fit.model_sky(air, *where, sun)))

    wrong = []
    for turn, height in MOVES:
        apart = change(found.atmosphere, found.sun, turn, height) - change(air, sun, turn, height)
        wrong.append(np.abs(apart - np.median(apart)).mean())
    return float(np.mean(wrong))


def collect(count: int, seed: int) -> tuple[Known, Known]:
    """Fit ``count`` skies; return features and outcomes of the fits and of the sun searches."""
    random = np.random.default_rng(seed)
    fits, good, suns, near = [], [], [], []
    seen = {}
    of_fit, of_sun = fit.confidence_of_fit, fit.confidence_of_sun
    fit.confidence_of_fit = lambda evidence: seen.update(fit=evidence) or of_fit(evidence)
    fit.confidence_of_sun = lambda *search: seen.update(sun=search) or of_sun(*search)
    for k in range(count):
        working, sky, clouds, camera, air, sun = draw(random)
        told = k % 2 == 0
        seen.clear()
        found = fit.fit_sky(working, sky, clouds, camera, sun if told else None)
        if "fit" not in seen:
            continue
        fits.append(stage.features_of_fit(seen["fit"]))
        good.append(stops_wrong(found, air, sun, camera) < stage.GOOD_FIT)
        if not told:
            suns.append(stage.features_of_sun(*seen["sun"]))
            turn = abs((found.sun[0] - sun[0] + 180) % 360 - 180)
            near.append(turn < stage.GOOD_SUN)
    fit.confidence_of_fit, fit.confidence_of_sun = of_fit, of_sun
    return (np.array(fits), np.array(good)), (np.array(suns), np.array(near))


def logistic(features: np.ndarray, outcome: np.ndarray, ridge: float = 0.5) -> np.ndarray:
    """Return bias and weights of a logistic regression with a ridge, by Newton steps."""
    x = np.column_stack([np.ones(len(features)), features])
    weights = np.zeros(x.shape[1])
    for _ in range(50):
        p = 1 / (1 + np.exp(-x @ weights))
        slope = x.T @ (outcome - p) - ridge * weights
        bend = (x * (p * (1 - p))[:, None]).T @ x + ridge * np.eye(len(weights))
        weights += np.linalg.solve(bend, slope)
    return weights


def report(name: str, weights: Any, features: np.ndarray, outcome: np.ndarray) -> None:
    """Print predicted against observed frequencies."""
    p = np.array([stage.probability(tuple(weights), row) for row in features])
    base, brier = outcome.mean() * (1 - outcome.mean()), np.mean((p - outcome) ** 2)
    print(f"{name}: {len(p)} skies, {outcome.mean():.2f} good, Brier {brier:.3f} (base {base:.3f})")
    for low in (0, 0.2, 0.4, 0.6, 0.8):
        inside = (p >= low) & (p < low + 0.2 + 1e-9)
        if inside.any():
            print(
                f"  said {p[inside].mean():.2f}  was {outcome[inside].mean():.2f}  ({inside.sum()})"
            )


def main() -> None:
    """Fit on request, and evaluate on skies that the weights were not fitted to."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fit", action="store_true")
    parser.add_argument("--count", type=int, default=400)
    options = parser.parse_args()
    weights = [stage.FIT_WEIGHTS, stage.SUN_WEIGHTS]
    if options.fit:
        learned = collect(options.count, 1)
        weights = [logistic(*part) for part in learned]
        for name, part in zip(("FIT_WEIGHTS", "SUN_WEIGHTS"), weights, strict=True):
            print(name, "=", tuple(round(float(w), 2) for w in part))
    for name, part, known in zip(("fit", "sun"), weights, collect(options.count, 2), strict=True):
        report(name, part, *known)


if __name__ == "__main__":
    main()
