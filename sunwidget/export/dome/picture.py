"""A photo's edited sky taken apart for a dome: what of the model it is, its clouds, what is known.

A pixel of the sky is (1 - a) c m + p: m the fitted model, c what the photo's clear sky is of it, a
the opacity of its clouds and p their light; kcd m⁻².

The sky has the photo's colours: its light over the fit's luminance gain, and the model times what
the gain is in each channel of that. The sun's own light keeps the model's colour: a fit to a blue
sky says what the camera made of blue, and not what it would make of the sun.
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
"""Mean opacity of the clouds from which a sky is taken to be closed."""

_NO_LENS = {"sun_size": 0.0, "glow": 0.0, "light_shafts": 0.0, "lens_flare": 0.0, "grain": 0.0}
_LOCKED = {"exposure": 0.0, "auto_exposure": 0.0}
_AUREOLE = (3.0, 7.0)  # degrees: nearer to the sun a photo shows its lens and its white
_GLOW = (7.0, 18.0)  # degrees: nearer to it nothing is mirrored, or a second sun would glow there
_SLOW = 1.5  # degrees over which the clear sky's ratio to the model is smoothed
_SKYLINE = 2  # pixels that the matte may err by
_RATIOS = (0.2, 5.0)  # the photo's clear sky over the model
_CLOUD = (0.02, 0.2)  # opacity from which on what differs from the clear sky is cloud
_LEAST_BLUE = 0.5  # of a cloud's luminance: more blue than that in shade is the sky's, seen through
_MODEL_WIDTH = 1024  # of the dome that the model in a picture is read from


@dataclass(frozen=True)
class Read:
    """What a picture holds in some directions."""

    light: Floats
    known: Floats
    ratio: Floats
    opacity: Floats
    clouds: Floats


@dataclass(frozen=True)
class Picture:
    """A photo's edited sky, taken apart, at the size of the dome's pixels; kcd m⁻².

    ``fields`` are by name (h, w, n): light, ratio (a logarithm), opacity, clouds, known.
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
        """Return what it holds at continuous pixels, beyond its border as at the border."""
        import cv2

        at = [np.nan_to_num(a - 0.5, nan=-1e4).astype(np.float32) for a in (x, y)]

        def sampled(name: str) -> Floats:
            way = cv2.INTER_LINEAR
            image = cv2.remap(self.fields[name], *at, way, borderMode=cv2.BORDER_REPLICATE)
            return np.asarray(image)

        return Read(*(sampled(name) for name in ("light", "known", "ratio", "opacity", "clouds")))

    def opacity_at(self, x: float, y: float) -> float | None:
        """Return the opacity of clouds at a pixel; None outside and where land hides the sky."""
        if not (0 <= x < self.width and 0 <= y < self.height):
            return None
        return float(self.fields["veil"][int(y), int(x)])


def picture_of(scene: Scene, edit: Edit, sun: tuple[float, float], width: int) -> Picture:
    """Return the edited sky of a scene taken apart, for a dome of ``width`` pixels.

    ``sun`` is the edit's, azimuth and elevation in degrees.
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
    # Two pixels for each of the dome.
    edge = 2 * width / 360 * np.degrees(max(camera.width, camera.height) / camera.focal)
    size = size_within(scene.photo.size, int(np.clip(edge, 64, 2048)))
    bare = edit.replace(**_NO_LENS, **_LOCKED)

    def drawn(wanted: Edit) -> Floats:
        display = render(scene, wanted, dtype="float32", size=size)
        return light_of(scene, display)

    light = drawn(bare)
    clear = drawn(bare.replace(cloud_opacity=0.0, added_clouds=0.0))
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
    if not moved:  # else the frame has filled the old sun's place
        known = known * (1 - resize(scene.glare, *size))
    known = np.asarray(known, np.float32)
    off_sun = np.asarray(smoothstep(*_GLOW, far), np.float32)
    told = known * off_sun if (known * off_sun).any() else known
    ratio = np.log(np.clip(clear / np.maximum(model, 1e-12), *_RATIOS)).astype(np.float32)
    pixel = float(np.degrees(1 / camera.focal) * camera.width / size[0])
    ratio, mean_ratio = _slow(ratio, told * (1 - own), pixel)
    smooth = np.exp(ratio) * model
    # As little cloud as gives the pixel, without light below black and bluer than its shade.
    blue, level = light[..., 2], light @ LUMINANCE
    sky_blue, sky_level = smooth[..., 2], np.maximum(smooth @ LUMINANCE, 1e-12)
    excess = np.maximum(sky_blue - _LEAST_BLUE * sky_level, 1e-12)
    least = 1 - np.minimum(level / sky_level, (blue - _LEAST_BLUE * level) / excess)
    is_cloud = smoothstep(*_CLOUD, own)
    opacity = np.clip(np.maximum(own, least), 0, 1) * is_cloud
    opacity = opacity.astype(np.float32)
    # What is no cloud is the clear sky's own detail.
    detail = np.log(np.clip(light / np.maximum(smooth, 1e-12), 0.5, 2))
    ratio = (ratio + ((1 - is_cloud) * known * off_sun)[..., None] * detail).astype(np.float32)
    clear = np.exp(ratio) * model
    clouds = light - (1 - opacity[..., None]) * clear
    clouds = (np.maximum(clouds, 0) * is_cloud[..., None]).astype(np.float32)
    # OpenCV resizes up to four channels at a time.
    veil = fill_by_pyramid(opacity[..., None], known)[..., 0]
    cover = float((known * opacity).sum()) / max(float(known.sum()), 1e-6)
    if cover < OVERCAST:
        # Rather no clouds than a smear of them, behind land and where the sun was.
        soft = cv2.GaussianBlur(known, (0, 0), 2 * _SLOW / pixel)
        kept = off_sun * known * smoothstep(0.55, 0.95, soft)
        opacity, clouds = opacity * kept, clouds * kept[..., None]
        told = np.ones_like(known)
    shown = scene.sun is not None and scene.sun.visible
    fields = {
        "ratio": ratio,
        "clouds": fill_by_pyramid(clouds, told),
        "opacity": fill_by_pyramid(opacity[..., None], told)[..., 0],
        "light": light,
        "known": known,
        "veil": np.zeros_like(matte) if shown and not moved else veil,
    }
    return Picture(
        {name: np.ascontiguousarray(field) for name, field in fields.items()},
        mean_ratio,
        cover,
        bool(0 <= (at := camera.pixel(*sun))[0] < camera.width and 0 <= at[1] < camera.height),
    )


def _slow(ratio: Floats, weight: Floats, pixel: float) -> tuple[Floats, NDArray[np.float64]]:
    """Return a smooth ``ratio`` (h, w, 3), also where it has no weight, and its mean (3,).

    ``pixel`` is in degrees. What is finer than that is the clouds'.
    """
    import cv2

    from sunwidget.analysis.images.fill import fill_by_pyramid

    if float(weight.sum()) < 1e-3 * weight.size:
        return np.zeros_like(ratio), np.zeros(3)
    blurred = [
        cv2.GaussianBlur(image, (0, 0), _SLOW / pixel)
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


def tinted(scene: Scene, model: Floats) -> Floats:
    """Return the model in the photo's colours, of the same luminance where it is grey."""
    if scene.fitted is None:
        return model
    gain = np.array(scene.fitted.gain)
    return np.asarray(model * (gain / (gain @ LUMINANCE)), np.float32)


def _model_in(
    scene: Scene, edit: Edit, azimuth: NDArray[np.float64], elevation: NDArray[np.float64]
) -> Floats:
    """Return the model (h, w, 3) in some directions: read from a small dome, it is smooth."""
    import cv2

    width = _MODEL_WIDTH
    small = tinted(scene, environment(scene, edit, (width, width // 2), sun=False))
    # The horizon's row below it would bring the ground in.
    small[width // 4 :] = small[width // 4 - 1]
    x = (azimuth / 360 + 0.5) * width - 0.5
    y = (0.5 - elevation / 180) * (width // 2) - 0.5
    at = x.astype(np.float32), y.astype(np.float32)
    return np.asarray(cv2.remap(small, *at, cv2.INTER_LINEAR, borderMode=cv2.BORDER_WRAP))
