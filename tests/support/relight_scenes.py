"""Small scenes that several tests share: one drawn here with everything known, and the samples."""

import functools
from dataclasses import dataclass

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.analysis.fit.fit import Response, SkyFit, model_sky, view_angles
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.geometry.camera import Camera

# Where each sample's sun and horizon are, in fractions of its size: small copies need telling.
SAMPLES = {
    "coast": ((0.620, 0.302), 0.602),
    "mountains": ((0.590, 0.315), 0.577),
    "meadow": ((0.395, 0.338), 0.607),
    "harbour": ((0.303, 0.309), 0.520),
}
HAZE = {"angstrom_exponent": 1.3, "aerosol_asymmetry": 0.76, "aerosol_albedo": 0.9}


@dataclass(frozen=True)
class KnownPhoto:
    """A photo drawn from the model: linear light (h, w, 3), and what it was drawn with."""

    linear: np.ndarray
    sky: np.ndarray
    opacity: np.ndarray
    camera: Camera
    sun: tuple[float, float]
    atmosphere: Atmosphere
    response: Response
    gain: np.ndarray

    @property
    def code(self):
        """Encoded values, float in [0, 1]."""
        x = np.clip(self.linear, 0, 1)
        return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)

    @property
    def bytes(self):
        return np.round(self.code * 255).astype(np.uint8)

    def analyze(self, picture=None, **hints):
        """Analyze it with camera, sun, sky and water given, so that no network runs.

        An even plain up to a straight horizon would be taken for water.
        """
        known = {
            "fov": self.camera.fov_vertical_deg,
            "horizon": self.camera.horizon_row(),
            "sun": self.camera.pixel(*self.sun),
            "sky": self.sky,
            "water": "none",
            "refine": "none",
        }
        return sw.analyze(self.bytes if picture is None else picture, **{**known, **hints})


@functools.cache
def known_photo(
    sun=(8.0, 14.0),
    size=(120, 80),
    depth=0.12,
    response=Response(0.9, 1.0),  # noqa: B008 - frozen
    tint=(1.0, 1.0, 1.0),
    *,
    level=0.35,
    noise=0.004,
    clouds=True,
):
    """Draw a hazy sky with a sun and three soft clouds over textured ground.

    ``level`` is the median display-linear light of the sky, ``noise`` the deviation of the
    grain in encoded units.
    """
    width, height = size
    random = np.random.default_rng(5)
    camera = Camera.from_horizon(width, height, 45.0, 0.66 * height)
    azimuth, elevation = view_angles(camera, width, height)
    atmosphere = Atmosphere(aerosol_optical_depth=depth, **HAZE)
    light = model_sky(atmosphere, azimuth, np.maximum(elevation, 0.2), sun)
    sky = (elevation > 0).astype(np.float32)
    gain = np.array(tint) * (response.scene_light(np.array([level]))[0] / np.median(light[sky > 0]))
    scene = light * gain
    x, y = camera.pixel(*sun)
    rows, columns = np.mgrid[:height, :width] + 0.5
    opacity = np.zeros((height, width), np.float32)
    if clouds:
        for cx, cy, radius in ((0.2, 0.25, 0.1), (0.75, 0.15, 0.08), (0.85, 0.5, 0.07)):
            near = np.hypot(columns - cx * width, (rows - cy * height) * 2) / (radius * width)
            opacity = np.maximum(opacity, np.clip(1.3 - near, 0, 1) * 0.9 * sky)
    white = np.median(scene[sky > 0], axis=0).mean() * 2.2
    scene = scene + opacity[..., None] * (white - scene)
    ground = np.array([0.12, 0.11, 0.07]) * (0.6 + 0.8 * random.random((height, width, 1)))
    scene = np.where(sky[..., None] > 0, scene, cv2.GaussianBlur(ground, (0, 0), 0.7))
    scene[np.hypot(columns - x, rows - y) < 0.03 * width] = 50.0
    linear = np.clip(response.display_light(scene), 0, 1)
    code = linear ** (1 / 2.2) + noise * random.standard_normal(linear.shape)
    linear = np.clip(code, 0, 1).astype(np.float32) ** np.float32(2.2)
    return KnownPhoto(linear, sky, opacity, camera, sun, atmosphere, response, gain)


def exact_fit(photo, sun=None):
    """Return the fit that a photo was drawn with."""
    return SkyFit(
        photo.atmosphere,
        photo.response,
        tuple(photo.gain),
        (0.0, 3.0, 2.0),
        sun or photo.sun,
    )


@functools.cache
def known_scene():
    """The scene of ``known_photo()``."""
    return known_photo().analyze()


@functools.cache
def sample_scene(name, width=192):
    """A bundled sample, shrunk so that a frame takes milliseconds."""
    photo = sw.sample(name)
    size = (width, round(width * photo.height / photo.width))
    small = cv2.resize(photo.encoded, size, interpolation=cv2.INTER_AREA)
    (x, y), row = SAMPLES[name]
    return sw.analyze(
        small,
        fov=photo.field_of_view.vertical,
        sun=(x * size[0], y * size[1]),
        horizon=row * size[1],
    )
