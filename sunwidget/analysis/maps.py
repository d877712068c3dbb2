"""The maps of a scene that a user can inspect: one table for files and for the editor.

A new map is one entry of ``MAPS``. ``sunwidget analyze -o`` writes it, the overview shows it, and
the editor's inspector offers it with the colors and the legend given here.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from sunwidget.analysis.frame_inputs import surface
from sunwidget.formats.pixels import size_within

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

Ramp = tuple[tuple[float, str], ...]

# Stops (position 0–1, #rrggbbaa) with linear interpolation. Values that mean "nothing here" are
# transparent, so that the photo shows through.
MATTE: Ramp = (
    (0.0, "#ffb02000"),
    (0.08, "#ffb020c8"),
    (0.5, "#ff4fa3d8"),
    (0.92, "#4a78ffc8"),
    (1.0, "#2f8cffb8"),
)
HEAT: Ramp = (
    (0.0, "#1b0c4100"),
    (0.12, "#3b0f70b0"),
    (0.4, "#a52c7ad8"),
    (0.7, "#fb7d5ee8"),
    (1.0, "#fcfdbff0"),
)
DOUBT: Ramp = ((0.0, "#ff2f6df0"), (0.4, "#ffa52ce0"), (0.75, "#ffe66aa0"), (1.0, "#3fd0a040"))
SHADE: Ramp = ((0.0, "#10083ae8"), (0.4, "#5a4a9cc0"), (0.667, "#ffffff18"), (1.0, "#ffd23af0"))
PATCH: Ramp = ((0.0, "#ffe14a00"), (0.5, "#ffc21ad0"), (1.0, "#ff3b30f0"))
WATER: Ramp = ((0.0, "#00c2d100"), (0.5, "#00c2d1b0"), (1.0, "#006dffd8"))
ELEVATION: Ramp = (
    (0.0, "#5a2d0cd8"),
    (0.35, "#c9813ab0"),
    (0.496, "#f6e3c380"),
    (0.5, "#ffffffff"),
    (0.504, "#d5ecff80"),
    (0.65, "#4c9be8b0"),
    (1.0, "#0a2f7ad8"),
)
DISTANCE: Ramp = (
    (0.0, "#fde725d8"),
    (0.25, "#5ec962d8"),
    (0.5, "#21918cd8"),
    (0.75, "#3b528bd8"),
    (0.98, "#440154d8"),
    (1.0, "#44015400"),
)


class SceneMap(NamedTuple):
    """One inspectable map.

    Parameters
    ----------
    name : str
        Stem of its file, and its name in requests of the browser.
    title : str
    read : callable
        ``read(scene)`` returns an (H, W) array, or None if this scene has no such map; smaller
        arrays cover the whole picture too.
    help : str
        Meaning of high and low values.
    ramp : tuple of (position, "#rrggbbaa")
        Colors.
    low, high : float
        Values of the first and the last level; values outside are clamped.
    unit : str
    scale : {"linear", "log"}
        Spacing of the levels between them, see ``value``.
    bits : {8, 16}
        Bit depth of its file.
    """

    name: str
    title: str
    read: Callable[[Scene], np.ndarray | None]
    help: str
    ramp: Ramp
    low: float = 0.0
    high: float = 1.0
    unit: str = ""
    scale: str = "linear"
    bits: int = 8

    def share(self, values: np.ndarray) -> np.ndarray:
        """Return the positions of values between low (0) and high (1), (H, W) float32."""
        values = np.asarray(values, np.float32)
        if self.scale == "log":
            values = np.log(np.maximum(values, self.low) / self.low)
            span = float(np.log(self.high / self.low))
        else:
            values = values - np.float32(self.low)
            span = self.high - self.low
        return np.asarray(np.clip(values / np.float32(span), 0, 1), np.float32)

    def value(self, share: Any) -> np.ndarray:
        """Return the values of shares, level / (2**bits - 1): the inverse of ``share``."""
        share = np.asarray(share, np.float64)
        if self.scale == "log":
            return np.asarray(self.low * (self.high / self.low) ** share)
        return self.low + (self.high - self.low) * share

    def formula(self) -> str:
        """Return the formula that converts a file's level to a value."""
        top = 2**self.bits - 1
        if self.scale == "log":
            return f"{self.low:g} * {self.high / self.low:g} ** (level / {top}) {self.unit}".strip()
        span = self.high - self.low
        start = f"{self.low:g} + " if self.low else ""
        factor = f"{span:g} * " if span != 1 else ""
        return f"{start}{factor}level / {top} {self.unit}".strip()


def levels(shares: np.ndarray, bits: int = 8) -> np.ndarray:
    """Return shares as integer levels: uint8, or uint16 for 16 bits."""
    top = 2**bits - 1
    return np.round(shares * top).astype(np.uint8 if bits == 8 else np.uint16)


def shares_of(scene: Scene, entry: SceneMap, size: tuple[int, int]) -> np.ndarray | None:
    """Return a map's shares (see ``SceneMap.share``) at a size, (height, width) float32.

    Parameters
    ----------
    size : (width, height)

    Returns
    -------
    ndarray or None
        None if this scene has no such map.
    """
    import cv2

    values = entry.read(scene)
    if values is None or not values.size:
        return None
    shares = entry.share(values)
    if shares.shape[::-1] == size:
        return shares
    smaller = size[0] < shares.shape[1]
    method = cv2.INTER_AREA if smaller else cv2.INTER_LINEAR
    return np.asarray(cv2.resize(shares, size, interpolation=method))


def ramp_colors(ramp: Ramp, count: int = 256) -> np.ndarray:
    """Return a ramp as a table of colors, (count, 4) float32 in [0, 1], alpha last."""
    at = np.linspace(0, 1, count)
    positions = [position for position, _ in ramp]
    stops = np.array([list(bytes.fromhex(color[1:])) for _, color in ramp], np.float64) / 255
    channels = [np.interp(at, positions, stops[:, i]) for i in range(4)]
    return np.stack(channels, axis=-1).astype(np.float32)


def _elevation(scene: Scene) -> np.ndarray:
    # At the browser's resolution, which is enough for a smooth map.
    camera = scene.camera
    width, height = size_within((camera.width, camera.height), 1024)
    x = (np.arange(width) + 0.5) * camera.width / width
    y = (np.arange(height) + 0.5) * camera.height / height
    return np.asarray(camera.angles(x[None], y[:, None])[1], np.float32)


def _sun(scene: Scene) -> np.ndarray | None:
    if scene.sun is None or not scene.sun.visible:
        return None
    return scene.sun.mask


def _glitter(scene: Scene) -> np.ndarray | None:
    if not (scene.water_map > 0).any():
        return None
    small = scene.working
    return surface(scene, (small.width, small.height))[..., 2]


def _shade(scene: Scene) -> np.ndarray | None:
    if scene.shade is None:  # only un-mixing finds it
        return None
    # Where there is almost no cloud, its light is noise.
    return np.where(scene.clouds > 0.05, scene.cloud_shade, np.float32(1))


MAPS: tuple[SceneMap, ...] = (
    SceneMap(
        "sky_coarse",
        "Sky, network",
        lambda scene: scene.sky_coarse,
        "Probability of sky according to the network, before refinement.",
        MATTE,
    ),
    SceneMap(
        "sky",
        "Sky matte",
        lambda scene: scene.sky,
        "Share of sky in a pixel, clouds and sun included: 1 is sky, 0 is land.",
        MATTE,
    ),
    SceneMap(
        "sureness",
        "Sky confidence",
        lambda scene: scene.sureness,
        "Confidence of the decision sky or land. Where it is low, a brush stroke helps most.",
        DOUBT,
    ),
    SceneMap(
        "clouds",
        "Cloud opacity",
        lambda scene: scene.clouds,
        "Share of the clear sky that a cloud hides: 1 is opaque.",
        HEAT,
    ),
    SceneMap(
        "cloud_softness",
        "Cloud softness C^s",
        lambda scene: scene.cloud_softness,
        "The thesis' C^s: whiteness between m_min (0) and m_max (1).",
        HEAT,
    ),
    SceneMap(
        "cloud_shade",
        "Cloud self-shade",
        _shade,
        "Light of the cloud relative to a white cloud: low in its own shade, 1 without shade.",
        SHADE,
        high=1.5,
    ),
    SceneMap(
        "sun",
        "Sun mask",
        _sun,
        "Pixels that belong to the photo's own sun.",
        PATCH,
    ),
    SceneMap(
        "glare",
        "Old sun's glare",
        lambda scene: scene.glare,
        "Sky that the old sun's glare hides, and the share of glare in the land's light.",
        PATCH,
    ),
    SceneMap(
        "panes",
        "Windows",
        lambda scene: scene.panes,
        "Probability that a pixel belongs to a window, behind which lamps can be lit.",
        PATCH,
    ),
    SceneMap(
        "elevation",
        "Horizon",
        _elevation,
        "Elevation above the horizon by the camera; the white line is the horizon.",
        ELEVATION,
        low=-45,
        high=45,
        unit="°",
    ),
    SceneMap(
        "water",
        "Water",
        lambda scene: scene.water,
        "Share of water in a pixel.",
        WATER,
    ),
    SceneMap(
        "glitter",
        "Old sun's glitter",
        _glitter,
        "Glints of the photo's own sun on water: removed when the sun has moved.",
        PATCH,
    ),
    SceneMap(
        "depth",
        "Depth",
        lambda scene: scene.depth,
        "Distance along the optical axis; the last level is the sky, infinitely far.",
        DISTANCE,
        low=1,
        high=100_000,
        unit="m",
        scale="log",
        bits=16,
    ),
    SceneMap(
        "depth_confidence",
        "Depth confidence",
        lambda scene: scene.depth_confidence,
        "Confidence of the land's distance; low where it is only a guess.",
        DOUBT,
    ),
)


def scene_map(name: str) -> SceneMap:
    """Return the entry of ``MAPS`` with this name.

    Raises
    ------
    ValueError
        If there is none; the message lists the names.
    """
    for entry in MAPS:
        if entry.name == name:
            return entry
    names = ", ".join(entry.name for entry in MAPS)
    raise ValueError(f"There is no map {name!r:.40}; choose one of {names}.")
