"""A photo's edited sky, separated for a dome into its ratio to the model, its clouds and a mask.

A sky pixel is (1 - a) c m + p, with the fitted model m, the ratio c of the photo's clear sky to it,
the opacity a of its clouds and their light p; kcd m⁻².

The sky has the photo's colors: the photo's light is divided by the luminance of the fit's gain, and
the model is multiplied by the gain of each channel relative to that luminance. The sun's own light
keeps the model's color: a fit to a blue sky shows how the camera rendered blue, not how it would
render the sun.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from sunwidget.dome.sphere import distance
from sunwidget.export.environment import MOON_OVER_SUN, environment
from sunwidget.formats.color import LUMINANCE
from sunwidget.formats.pixels import size_within

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.edit.table import Edit

Floats = NDArray[np.float32]

OVERCAST = 0.85
"""Mean cloud opacity from which a sky counts as overcast."""

_NO_LENS = {"sun_size": 0.0, "glow": 0.0, "light_shafts": 0.0, "lens_flare": 0.0, "grain": 0.0}
_LOCKED = {"exposure": 0.0, "auto_exposure": 0.0}
_AUREOLE = (3.0, 7.0)  # degrees: nearer to the sun a photo shows lens glare and clipped white
_GLOW = (7.0, 18.0)  # degrees: nearer to the sun nothing is mirrored, else a second sun would glow
_SMOOTH_DEG = 1.5  # degrees over which the clear sky's ratio to the model is smoothed
_SKYLINE = 2  # error of the matte in pixels
_RATIOS = (0.2, 5.0)  # the photo's clear sky over the model
_CLOUD = (0.02, 0.2)  # opacity over which a difference from the clear sky becomes cloud
_LEAST_BLUE = 0.5  # share of a cloud's luminance; more blue in its shade is sky seen through it
_MODEL_WIDTH = 1024  # width of the dome from which the model in a picture is sampled


@dataclass(frozen=True)
class Read:
    """A picture's values in some directions."""

    light: Floats
    known: Floats
    ratio: Floats
    opacity: Floats
    clouds: Floats


@dataclass(frozen=True)
class Picture:
    """A photo's edited sky, separated, at the resolution of the dome; kcd m⁻².

    ``fields`` by name, (h, w, n): light, ratio (a logarithm), opacity, clouds, known.
    """

    fields: dict[str, Floats]
    mean_ratio: NDArray[np.float64]
    mean_opacity: float
    holds_sun: bool

    @property
    def height(self) -> int:
        """Rows."""
        return self.fields["light"].shape[0]

    @property
    def width(self) -> int:
        """Columns."""
        return self.fields["light"].shape[1]

    def read(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> Read:
        """Return the values at continuous pixels; outside the border, those at the border."""
        import cv2

        at = [np.nan_to_num(a - 0.5, nan=-1e4).astype(np.float32) for a in (x, y)]

        def sample(name: str) -> Floats:
            linear, border = cv2.INTER_LINEAR, cv2.BORDER_REPLICATE
            return np.asarray(cv2.remap(self.fields[name], *at, linear, borderMode=border))

        return Read(*(sample(name) for name in ("light", "known", "ratio", "opacity", "clouds")))

    def opacity_at(self, x: float, y: float) -> float | None:
        """Return the opacity of clouds at a pixel; None outside and where land hides the sky."""
        if not (0 <= x < self.width and 0 <= y < self.height):
            return None
        return float(self.fields["veil"][int(y), int(x)])


def picture_of(scene: Scene, edit: Edit, sun: tuple[float, float], width: int) -> Picture:
    """Separate the edited sky of a scene, for a dome ``width`` pixels wide.

    ``sun`` is the edit's azimuth and elevation in degrees.
    """
    import cv2

    from sunwidget.analysis.fit.fit import view_angles
    from sunwidget.analysis.images.fill import fill_by_pyramid
    from sunwidget.analysis.images.working_copy import resize, smoothstep
    from sunwidget.export.layers import edited_opacity, own_opacity
    from sunwidget.renderer.offscreen import render

    fit = scene.fitted
    assert fit is not None
    camera = scene.camera
    # Two pixels per pixel of the dome.
    edge = 2 * width / 360 * np.degrees(max(camera.width, camera.height) / camera.focal)
    size = size_within(scene.photo.size, int(np.clip(edge, 64, 2048)))
    bare = edit.replace(**_NO_LENS, **_LOCKED)

    def draw(edit: Edit) -> Floats:
        return light_of(scene, render(scene, edit, dtype="float32", size=size))

    light = draw(bare)
    clear = draw(bare.replace(cloud_opacity=0.0, added_clouds=0.0))
    azimuth, elevation = view_angles(camera, *size)
    model = _model_in(scene, edit, azimuth, elevation)
    matte = resize(scene.sky, *size)
    own = edited_opacity(own_opacity(resize(scene.cloud_map, *size), matte), edit)
    far = distance(sun, azimuth, elevation)
    old = scene.automatic["sun_azimuth"], scene.automatic["sun_elevation"]
    moved = float(distance(old, np.array(sun[0]), np.array(sun[1]))) > _AUREOLE[0]
    inner = cv2.erode(matte, np.ones((2 * _SKYLINE + 1,) * 2, np.uint8))
    known = smoothstep(0.9, 1.0, inner) * (elevation > 0)
    known = known * smoothstep(*_AUREOLE, far)
    if not moved:  # otherwise the frame has filled in the old sun's position
        known = known * (1 - resize(scene.glare, *size))
    known = np.asarray(known, np.float32)
    off_sun = np.asarray(smoothstep(*_GLOW, far), np.float32)
    weight = known * off_sun if (known * off_sun).any() else known
    ratio = np.log(np.clip(clear / np.maximum(model, 1e-12), *_RATIOS)).astype(np.float32)
    pixel = float(np.degrees(1 / camera.focal) * camera.width / size[0])
    ratio, mean_ratio = _smooth_ratio(ratio, weight * (1 - own), pixel)
    smooth = np.exp(ratio) * model
    # The least opacity that explains the pixel without negative light and without blue shade.
    blue, level = light[..., 2], light @ LUMINANCE
    sky_blue, sky_level = smooth[..., 2], np.maximum(smooth @ LUMINANCE, 1e-12)
    excess = np.maximum(sky_blue - _LEAST_BLUE * sky_level, 1e-12)
    least = 1 - np.minimum(level / sky_level, (blue - _LEAST_BLUE * level) / excess)
    is_cloud = smoothstep(*_CLOUD, own)
    opacity = np.clip(np.maximum(own, least), 0, 1) * is_cloud
    opacity = opacity.astype(np.float32)
    # Detail outside clouds belongs to the clear sky.
    detail = np.log(np.clip(light / np.maximum(smooth, 1e-12), 0.5, 2))
    ratio = (ratio + ((1 - is_cloud) * known * off_sun)[..., None] * detail).astype(np.float32)
    clear = np.exp(ratio) * model
    clouds = light - (1 - opacity[..., None]) * clear
    clouds = (np.maximum(clouds, 0) * is_cloud[..., None]).astype(np.float32)
    # OpenCV resizes up to four channels at a time.
    veil = fill_by_pyramid(opacity[..., None], known)[..., 0]
    cover = float((known * opacity).sum()) / max(float(known.sum()), 1e-6)
    if cover < OVERCAST:
        # No clouds behind land and at the old sun: filled-in clouds would smear.
        soft = cv2.GaussianBlur(known, (0, 0), 2 * _SMOOTH_DEG / pixel)
        kept = off_sun * known * smoothstep(0.55, 0.95, soft)
        opacity, clouds = opacity * kept, clouds * kept[..., None]
        weight = np.ones_like(known)
    fields = {
        "ratio": ratio,
        "clouds": fill_by_pyramid(clouds, weight),
        "opacity": fill_by_pyramid(opacity[..., None], weight)[..., 0],
        "light": light,
        "known": known,
        "veil": np.zeros_like(matte) if scene.shows_sun and not moved else veil,
    }
    return Picture(
        {name: np.ascontiguousarray(field) for name, field in fields.items()},
        mean_ratio,
        cover,
        bool(0 <= (at := camera.pixel(*sun))[0] < camera.width and 0 <= at[1] < camera.height),
    )


def _smooth_ratio(
    ratio: Floats, weight: Floats, pixel: float
) -> tuple[Floats, NDArray[np.float64]]:
    """Return ``ratio`` (h, w, 3) smoothed and filled in where it has no weight, and its mean (3,).

    ``pixel`` is in degrees. Finer detail belongs to the clouds.
    """
    import cv2

    from sunwidget.analysis.images.fill import fill_by_pyramid

    if float(weight.sum()) < 1e-3 * weight.size:
        return np.zeros_like(ratio), np.zeros(3)
    blurred = [
        cv2.GaussianBlur(image, (0, 0), _SMOOTH_DEG / pixel)
        for image in (ratio * weight[..., None], weight)
    ]
    smooth = blurred[0] / np.maximum(blurred[1], 1e-6)[..., None]
    trust = np.clip(4 * blurred[1], 0, 1)
    mean = weight.ravel().astype(float) @ ratio.reshape(-1, 3) / float(weight.sum())
    filled = fill_by_pyramid(np.asarray(smooth, np.float32), trust)
    return filled, np.asarray(mean, np.float64)


def light_of(scene: Scene, display: Floats) -> Floats:
    """Return the radiance of display-linear light, kcd m⁻²."""
    fit = scene.fitted
    assert fit is not None
    light = fit.response.scene_light(display) / (np.array(fit.gain) @ LUMINANCE)
    return np.asarray(light * (MOON_OVER_SUN if scene.lit_by_moon else 1), np.float32)


def tint(scene: Scene, model: Floats) -> Floats:
    """Return the model in the photo's colors; gray keeps its luminance."""
    if scene.fitted is None:
        return model
    gain = np.array(scene.fitted.gain)
    return np.asarray(model * (gain / (gain @ LUMINANCE)), np.float32)


def _model_in(
    scene: Scene, edit: Edit, azimuth: NDArray[np.float64], elevation: NDArray[np.float64]
) -> Floats:
    """Return the model (h, w, 3) in some directions, sampled from a small dome: it is smooth."""
    import cv2

    width = _MODEL_WIDTH
    small = tint(scene, environment(scene, edit, (width, width // 2), sun=False))
    # Interpolation at the horizon must not include the ground.
    small[width // 4 :] = small[width // 4 - 1]
    x = (azimuth / 360 + 0.5) * width - 0.5
    y = (0.5 - elevation / 180) * (width // 2) - 0.5
    at = x.astype(np.float32), y.astype(np.float32)
    return np.asarray(cv2.remap(small, *at, cv2.INTER_LINEAR, borderMode=cv2.BORDER_WRAP))
