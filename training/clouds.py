"""Regress cloud on colour: the weights of ``sunwidget.analysis.clouds.clouds.LEARNED``.

``python -m training.clouds``

The material is drawn, so its truth is exact: directions in clear skies of our own atmosphere
under a random sun, veiled by a white cloud of random opacity and self-shade, seen by cameras of
random exposure, white balance and response. No photo and no mask is used. A pixel counts as cloud
from half opacity; those nearly there weigh little. Prints the weights and the error on skies that
it was not fitted to.
"""

from __future__ import annotations

import argparse

import numpy as np

from sunwidget.analysis.clouds.clouds import features
from sunwidget.analysis.clouds.unmix import cloud_white
from sunwidget.analysis.fit.fit import Response, SkyFit, model_sky
from sunwidget.analysis.images.working_copy import encode
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.formats.color import LUMINANCE

_PIXELS = 300  # of each sky


def veiled_sky(random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Draw pixels of one photo's sky.

    Returns
    -------
    encoded : (n, 3) float32
        sRGB-encoded, [0, 1].
    opacity : (n,) float64
        0 in two fifths of the pixels, 1 in as many.
    """
    atmosphere = Atmosphere(
        aerosol_optical_depth=float(random.uniform(0.02, 0.2)),
        aerosol_asymmetry=float(random.uniform(0.6, 0.85)),
    )
    sun = (0.0, float(random.uniform(3, 70)))
    azimuth = random.uniform(-180, 180, _PIXELS)
    elevation = np.degrees(np.arcsin(random.uniform(0.05, 1, _PIXELS)))
    gain = np.exp(random.normal(0, 0.08, 3))
    clear = model_sky(atmosphere, azimuth, elevation, sun)
    gain *= 0.2 * np.exp(random.normal(0, 0.4)) / np.median(clear @ LUMINANCE)
    response = Response(float(random.uniform(0.5, 0.97)), float(random.uniform(0.8, 1.2)))
    white = cloud_white(SkyFit(atmosphere, response, tuple(gain), (0.0, 3.0, 2.0), sun))
    opacity = np.clip(random.uniform(-2, 3, _PIXELS), 0, 1)
    shade = np.clip(random.normal(0.65, 0.25, _PIXELS), 0.15, 1.2)
    # Cloud colors vary: bases see the ground, edges the sky around them.
    tint = np.exp(random.normal(0, 0.03, (_PIXELS, 3)))
    light = (1 - opacity[:, None]) * clear * gain
    light += (opacity * shade)[:, None] * white * tint
    # Cameras make colors stronger than they are.
    grey = (light @ LUMINANCE)[:, None]
    light = np.maximum(grey + random.uniform(1.0, 1.5) * (light - grey), 0)
    display = np.clip(response.display_light(light), 0, 1)
    return encode(display + random.normal(0, 0.004, display.shape)), opacity


def dataset(skies: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the features (n, 4) and opacities (n,) of many drawn skies."""
    random = np.random.default_rng(seed)
    drawn = [veiled_sky(random) for _ in range(skies)]
    encoded = np.concatenate([pixels for pixels, _ in drawn])
    opacity = np.concatenate([share for _, share in drawn])
    usable = encoded.max(-1) < 0.995  # burnt pixels say nothing
    return features(encoded[usable]).astype(np.float64), opacity[usable]


def regress(seen: np.ndarray, opacity: np.ndarray, ridge: float = 1e-3) -> np.ndarray:
    """Fit bias and weights (5,) of the logistic regression by Newton's method."""
    design = np.column_stack([np.ones(len(seen)), seen])
    weight = 2 * np.abs(opacity - 0.5)
    wanted = (opacity >= 0.5).astype(np.float64)
    weights = np.zeros(design.shape[1])
    penalty = ridge * len(seen) * np.diag([0, *np.ones(seen.shape[1])])
    for _ in range(50):
        probability = 1 / (1 + np.exp(-np.clip(design @ weights, -30, 30)))
        slope = design.T @ (weight * (probability - wanted)) + penalty @ weights
        curvature = (design.T * (weight * probability * (1 - probability))) @ design + penalty
        step = np.linalg.solve(curvature, slope)
        weights -= step
        if np.abs(step).max() < 1e-8:
            break
    return weights


def main() -> None:
    """Fit, measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--skies", type=int, default=300)
    options = parser.parse_args()
    weights = regress(*dataset(options.skies, seed=1))
    seen, opacity = dataset(max(10, options.skies // 5), seed=2)
    called = weights[0] + seen @ weights[1:] > 0
    sure = np.abs(opacity - 0.5) > 0.25
    right = (called == (opacity >= 0.5))[sure].mean()
    print("LEARNED =", tuple(round(float(w), 2) for w in weights))
    print(f"drawn skies not fitted to: {100 * right:.1f} % of the clear or cloudy pixels right")


if __name__ == "__main__":
    main()
