"""Scene: the results of the analysis of a photo, as data.

``analyze.py`` runs the stages of ``pipeline.py``; ``correct.py`` applies strokes and hints.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from sunwidget.analysis.backdrop.erase import Erased, erase_nothing
from sunwidget.analysis.clouds.clouds import Clouds
from sunwidget.analysis.depth import levels, relief
from sunwidget.analysis.depth.depth import find_depth
from sunwidget.analysis.depth.field import DepthField
from sunwidget.analysis.depth.view import View
from sunwidget.analysis.fit.fit import SkyFit
from sunwidget.analysis.hints import Hints
from sunwidget.analysis.horizon.horizon import Horizon
from sunwidget.analysis.images.enlarge import resize_rows
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.memory import Memory
from sunwidget.analysis.networks.land import LandMaps, look_at_land
from sunwidget.analysis.segmentation import refine
from sunwidget.analysis.sun.sun import SunObservation
from sunwidget.analysis.windows import panes
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.edit.table import PARAMETERS
from sunwidget.errors import AnalysisError
from sunwidget.formats.pixels import size_within
from sunwidget.geometry.camera import Camera, Point
from sunwidget.photo.photo import Photo

_DEPTH_EDGE = 2048


class Segmentation(NamedTuple):
    """The decision which pixels are sky, from which the stages of ``pipeline.py`` start.

    Attributes
    ----------
    photo : Photo
    working : Working
        The small copy that the stages use.
    coarse_map : (h, w) float32
        The sky before refinement.
    decision : Decision
        Sky or land at working size.
    known_depth, known_land : DepthField, LandMaps or None
        Depth and relief of the view, if known from other pictures of it.
    """

    photo: Photo
    working: Working
    coarse_map: np.ndarray
    decision: refine.Decision
    known_depth: DepthField | None = None
    known_land: LandMaps | None = None


@dataclass(frozen=True, eq=False, repr=False)
class Scene:
    """A photo and its analysis. Made by ``analyze``; immutable.

    Attributes
    ----------
    photo : Photo
    sky : (H, W) float32
        Alpha matte, 1 = sky, clouds and sun included.
    coarse_map, cloud_map, softness_map, water_map : (h, w) float32
        Maps at any size; ``sky_coarse``, ``clouds``, ``cloud_softness`` and ``water`` are the
        same maps at the photo's size.
    sun : SunObservation or None
        The photo's own sun; None if it shows none and no hint gave one.
    horizon : Horizon
    camera : Camera
    atmosphere : Atmosphere
    backdrop : (h, w, 3) float32
        The photo without its sun, with the sky continued over the land (``backdrop.to_code``).
    glare : (h, w) float32
        Weight with which the backdrop replaces the photo when the sun has moved; on land the
        share of light that is removed then.
    assumed_sun : (azimuth, elevation)
        Degrees; position of the sun, or of the moon that lights a night, if ``sun`` is None.
    response : dict
        Further uniforms from the fit: camera response, gain and glare.
    warnings : tuple of str
        Notices for the user; each says what to do.
    hints : Hints
        Hints of the analysis.
    timings : dict
        Seconds of each stage.
    moon : (x, y) or None
        Position of a disc in a night sky that was detected as the moon, in fractions of the
        picture; it lights the picture instead of the sun (``Edit.light_source``).
    everywhere : Clouds
        The clouds at working size as if the whole picture were sky, for sky strokes.
    unstroked : Scene or None
        The scene before the strokes of ``hints``; None without strokes.
    erased : Erased or None
        The small photo without its sun; None before the sun was removed.
    known_depth : DepthField or None
        Depth of the same view from other pictures of it (timelapses/fixed_camera.py).
    known_land : LandMaps or None
        Relief of the same view, likewise.
    """

    photo: Photo
    sky: np.ndarray
    coarse_map: np.ndarray
    cloud_map: np.ndarray
    softness_map: np.ndarray
    sun: SunObservation | None
    horizon: Horizon
    camera: Camera
    atmosphere: Atmosphere
    water_map: np.ndarray
    backdrop: np.ndarray
    glare: np.ndarray
    assumed_sun: tuple[float, float]
    response: dict[str, Any]
    warnings: tuple[str, ...]
    hints: Hints
    timings: dict[str, float]
    working: Working
    decision: refine.Decision
    moon: Point | None = None
    shade: np.ndarray | None = None
    fitted: SkyFit | None = None
    everywhere: Clouds | None = None
    unstroked: Scene | None = None
    erased: Erased | None = None
    known_depth: DepthField | None = None
    known_land: LandMaps | None = None
    memory: Memory = field(default_factory=Memory)

    def __repr__(self) -> str:
        return _described(self)

    @property
    def segmentation(self) -> Segmentation:
        """The fields from which the stages after segmentation start."""
        return Segmentation(**{name: getattr(self, name) for name in Segmentation._fields})

    @property
    def width(self) -> int:
        """Width of the photo in pixels."""
        return self.camera.width

    @property
    def height(self) -> int:
        """Height of the photo in pixels."""
        return self.camera.height

    @property
    def sky_coarse(self) -> np.ndarray:
        """The network's map before refinement: (H, W) float32, computed on access."""
        return resize_rows(self.coarse_map, self.width, self.height)

    @property
    def clouds(self) -> np.ndarray:
        """Opacity of the clouds: (H, W) float32 in [0, 1], computed on access."""
        return resize_rows(self.cloud_map, self.width, self.height)

    @property
    def cloud_softness(self) -> np.ndarray:
        """The thesis' C^s: (H, W) float32 in [0, 1], computed on access."""
        return resize_rows(self.softness_map, self.width, self.height)

    @property
    def water(self) -> np.ndarray:
        """Share of water in a pixel, 0 in the sky: (H, W) float32, computed on access."""
        return self.water_at((self.width, self.height))

    def water_at(self, size: tuple[int, int], rows: slice = slice(None)) -> np.ndarray:
        """Return ``water`` at another ``size`` (width, height), or only some of its ``rows``."""
        sky = resize_rows(self.sky, *size, rows)
        return np.minimum(resize_rows(self.water_map, *size, rows), 1 - sky)

    @cached_property
    def small_sky(self) -> np.ndarray:
        """``sky`` at working size, (h, w) float32; cached, since many stages use it."""
        return resize(self.sky, self.working.width, self.working.height)

    @property
    def small_water(self) -> np.ndarray:
        """``water`` at working size, (h, w) float32."""
        small = resize(self.water_map, self.working.width, self.working.height)
        return np.minimum(small, 1 - self.small_sky)

    @property
    def without_sun(self) -> Erased:
        """The small photo without its sun, or the photo itself if it shows none."""
        return self.erased or erase_nothing(self.working)

    @property
    def shows_sun(self) -> bool:
        """Whether the photo shows its sun, or the moon that was hinted as the sun."""
        return self.sun is not None and self.sun.visible

    @property
    def lit_by_moon(self) -> bool:
        """Whether the moon lights the photo: a detected one, or one hinted as the sun."""
        return self.moon is not None or (self.sun is not None and self.sun.kind == "moon")

    @cached_property
    def sureness(self) -> np.ndarray:
        """Confidence of the decision sky or land in each pixel: (H, W) float32 in (0, 1]."""
        return resize(self.decision.confidence, self.width, self.height)

    @cached_property
    def land(self) -> LandMaps:
        """The network's maps of the land, computed on first access.

        With a given depth, the slopes follow that depth.
        """
        maps = look_at_land(self.working)
        if self.known_land is not None:
            # Sunlight comes from this photo; the relief is known better from the others.
            maps = self.known_land._replace(sunlit=maps.sunlit, facing=maps.facing)
        if self.hints.depth is not None:
            size = self.working.width, self.working.height
            given = self.depth_field.log_metres(*size, self.working)
            sun = self.automatic["sun_azimuth"], self.automatic["sun_elevation"]
            maps = relief.with_given_depth(maps, given, self.camera, sun)
        return relief.on_land(maps, self.small_sky)

    @property
    def relief(self) -> np.ndarray:
        """Normals of the land and the sunlight on it, (h, w, 4) float32 (depth/relief.py)."""
        return relief.encoded(self.land, self.working)

    @property
    def transfer(self) -> np.ndarray:
        """Transfer of any sun's light to the land, (3 h, w, 4) float32 (depth/relief.py)."""
        return relief.encoded_transfer(self.land)

    @cached_property
    def _windows(self) -> list[panes.View]:
        sizes = panes.look(self.photo)
        return [
            panes.View(*(image * (1 - resize(self.sky, *image.shape[::-1])) for image in view))
            for view in sizes
        ]

    @cached_property
    def panes(self) -> np.ndarray:
        """Probability of windows, (h, w) float32 in [0, 1] (analysis/windows/panes.py)."""
        return panes.probability(self._windows)

    @cached_property
    def lamps(self) -> np.ndarray:
        """Light behind window panes, (h, w, 4) float32 (analysis/windows/panes.py)."""
        return panes.lamps(self._windows)

    @cached_property
    def depth(self) -> np.ndarray:
        """Metres along the optical axis, inf for the sky: (H, W) float32; computed on access.

        Correct up to one scale at best: the camera is assumed 1.7 m above the ground.
        """
        metres = np.exp(self.log_depth(self.width, self.height))
        return np.where(self.sky > 0.5, np.float32(np.inf), metres)

    @cached_property
    def depth_confidence(self) -> np.ndarray:
        """Confidence of the depth, apart from its scale: (H, W) float32 in [0, 1], 1 in the sky.

        It is 1 / (1 + (2 σ)²) with the standard error σ of ln depth.
        """
        found = resize(self.depth_field.confidence, self.width, self.height)
        return np.where(self.sky > 0.5, np.float32(1), found)

    @cached_property
    def depth_field(self) -> DepthField:
        """The depth at any size (analysis/depth/field.py); computed on first access."""
        if self.known_depth is not None:
            return self.known_depth
        seen = self.working, self.small_sky, self.small_water
        view = View.of(*seen, self.camera, self.horizon, self.atmosphere)
        return find_depth(view, self.hints.depth, self.hints.method("depth"))

    def log_depth(self, width: int, height: int, rows: slice = slice(None)) -> np.ndarray:
        """Return ln(metres), (``height``, ``width``) or ``rows`` of it; sky as nearest land."""
        # Depth has no detail beyond the size of a preview.
        size = size_within((width, height), _DEPTH_EDGE)
        if size not in self._log_depths:
            metres = self.depth_field.log_metres(*size, self.working)
            land = resize(self.sky, *size) <= 0.5
            self._log_depths.clear()
            self._log_depths[size] = levels.fill_sky(metres, land)
        return resize_rows(self._log_depths[size], width, height, rows)

    @cached_property
    def _log_depths(self) -> dict[tuple[int, int], np.ndarray]:
        return {}  # the last map by its size: all strips of a large picture use it

    @cached_property
    def shown(self) -> refine.Decision:
        """Sky or land at working size according to the matte, from which strokes start."""
        width, height = self.working.width, self.working.height
        sky = self.small_sky > 0.5
        decided = resize(self.decision.sky, width, height) > 0.5
        # Where a later stage overruled the decision, its confidence is unknown.
        confidence = np.where(sky == decided, resize(self.decision.confidence, width, height), 0.5)
        return refine.Decision(sky.astype(np.float32), confidence.astype(np.float32))

    @property
    def cloud_shade(self) -> np.ndarray:
        """Light of the clouds relative to a white cloud: (H, W) float32, 0 to 1.5.

        Only the method "unmix" finds it; other methods give 1.
        """
        if self.shade is None:
            return np.ones((self.height, self.width), np.float32)
        return resize(self.shade, self.width, self.height)

    @property
    def sun_confidence(self) -> float:
        """Probability that the assumed position of the sun is right, [0, 1]; 1 for a hint."""
        if self.sun is not None:
            return self.sun.confidence
        return 1.0 if self.fitted is None else self.fitted.sun_confidence

    @property
    def sun_spread(self) -> float:
        """Angle in degrees between the true and the assumed unseen sun, with 80 % probability.

        0 for a sun that is visible or hinted.
        """
        return 0.0 if self.sun is not None or self.fitted is None else self.fitted.sun_spread

    @property
    def automatic(self) -> dict[str, float]:
        """The values of the automatic parameters of ``Edit`` in this photo."""
        azimuth, elevation = (
            self.assumed_sun if self.sun is None else (self.sun.azimuth, self.sun.elevation)
        )
        found = {"sun_azimuth": azimuth, "sun_elevation": elevation}
        found |= self.atmosphere.parameters()
        return {
            p.name: min(max(found[p.name], p.minimum), p.maximum)
            for p in PARAMETERS
            if p.kind == "number" and p.default is None
        }


def checked_scene(scene: Any) -> Scene:
    """Return ``scene`` if it is a Scene; raises AnalysisError for a photo, a path or others."""
    if not hasattr(scene, "automatic"):
        raise AnalysisError(
            f"Expected a Scene, not {type(scene).__name__}. Make one: scene = sw.analyze(photo)."
        )
    found: Scene = scene
    return found


def _described(scene: Scene) -> str:
    """Return a summary: photo, sun, horizon, camera, and the shares of sky, clouds and water."""
    return (
        f"<Scene of {scene.photo.name!r}, {scene.width}×{scene.height}\n"
        f" {_sun(scene)}; horizon in row {scene.horizon.row:.0f}; "
        f"field of view {scene.camera.fov_vertical_deg:.3g}°\n"
        f" {_shares(scene)}>"
    )


def _sun(scene: Scene) -> str:
    azimuth, elevation = scene.automatic["sun_azimuth"], scene.automatic["sun_elevation"]
    body = "moon" if scene.lit_by_moon else "sun"
    how = "assumed" if scene.sun is None and scene.moon is None else "seen"
    if scene.sun is not None and scene.sun.source == "hint":
        how = "hint"
    return f"{body} at azimuth {azimuth:.1f}°, elevation {elevation:.1f}° ({how})"


def _shares(scene: Scene) -> str:
    sky = scene.small_sky
    clouds = resize(scene.cloud_map, scene.working.width, scene.working.height) * sky
    parts = {"sky": sky, "clouds": clouds, "water": scene.small_water}
    return ", ".join(f"{name} {100 * float(np.mean(part)):.0f} %" for name, part in parts.items())
