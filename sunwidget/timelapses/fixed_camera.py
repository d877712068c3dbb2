"""The scene shared by all frames of a fixed camera, found once from several frames.

The network's sky is the median over samples, which removes the clouds, sun or night of single
frames. Skyline, horizon, water and depth are found on the samples' median picture, without people,
cars and moving clouds. A frame is registered to that picture by its land alone (phase correlation:
Kuglin & Hines 1975), since clouds move.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from sunwidget.analysis.analyze import analyze
from sunwidget.analysis.correct import corrected
from sunwidget.analysis.depth.field import DepthField
from sunwidget.analysis.images.noise import noise_level
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.memory import Memory
from sunwidget.analysis.scene import Scene
from sunwidget.analysis.segmentation import coarse_sky
from sunwidget.edit.table import CORRECTIONS, Edit
from sunwidget.formats.color import LUMINANCE, SRGB, strips
from sunwidget.photo.photo import Photo

_DARK = 0.35  # share of the samples' median light; darker samples do not show the skyline
_SIDE = 512  # pixels on the longer side for registration
_SURE = 0.06  # least reliable response of a correlation, even with lamps at night
_STILL = 1.0  # of those pixels: moving shadows cause offsets of this size
MOST = 0.04  # of the longer side; a larger offset is another view


class Offset(NamedTuple):
    """Offset of a frame to the right of and below the shared maps, in shares of the longer side."""

    x: float
    y: float
    sure: bool

    @property
    def far(self) -> bool:
        """Whether the camera has moved, beyond shake."""
        return self.sure and max(abs(self.x), abs(self.y)) > MOST


@dataclass(frozen=True, eq=False)
class FixedCamera:
    """The scene that the frames of one camera share, without weather.

    Attributes
    ----------
    scene : Scene
        Scene of the samples' median picture. Its sky, horizon, camera, water and depth apply to
        all frames; its clouds, sun and air do not.
    lit : tuple of bool
        For each sample, whether it is bright enough to show the skyline.
    """

    scene: Scene
    lit: tuple[bool, ...]
    edges: np.ndarray
    weight: np.ndarray

    @classmethod
    def of(
        cls,
        small: Sequence[Working],
        photos: Sequence[Photo | None],
        corrections: Edit,
        hints: dict[str, Any],
        progress: Callable[[float, str], Any] | None = None,
    ) -> FixedCamera:
        """Analyze the shared scene of several frames.

        Parameters
        ----------
        small : sequence of Working
            Working copy of each frame.
        photos : sequence of Photo or None
            The same frames, all of one size; None for those left out to save memory.
        corrections : Edit
            Source of strokes and hints.
        hints : dict
            Arguments of ``analyze``.
        progress : callable, optional
            As for ``analyze``.
        """
        light = np.array([float(np.median(w.luminance)) for w in small])
        lit = light >= _DARK * float(np.median(light))
        kept = [photo for photo in photos if photo is not None]
        bright = [p for p, ok in zip(photos, lit, strict=True) if ok and p is not None]
        plate = _median_picture(bright or kept)
        hints = dict(hints)
        if hints.get("sky") is None:
            hints["sky"] = _common_sky([w for w, ok in zip(small, lit, strict=True) if ok])
        scene = analyze(plate, **hints, progress=progress)
        scene = corrected(
            scene, Edit().replace(**{name: getattr(corrections, name) for name in CORRECTIONS})
        )
        noise = [noise_level(photo, scene.sky) for photo in kept]
        # A median picture is less noisy than its frames.
        response = scene.response | {"noise_level": float(np.median(noise))}
        scene = dataclasses.replace(
            scene,
            response=response,
            known_depth=_depth_as_it_is(scene),
            known_land=scene.land,
            unstroked=None,
            memory=Memory(),
        )
        weight = _land_weight(scene)
        return cls(scene, tuple(map(bool, lit)), _edges(plate, weight), weight)

    @property
    def can_place(self) -> bool:
        """Whether there is enough land to register frames."""
        return float(self.weight.mean()) > 0.03

    def offset(self, photo: Photo) -> Offset:
        """Return the offset of ``photo`` from the median picture."""
        import cv2

        if not self.can_place:
            return Offset(0.0, 0.0, sure=False)
        (x, y), response = cv2.phaseCorrelate(self.edges, _edges(photo, self.weight))
        side = max(self.weight.shape)
        # phaseCorrelate returns the position of the second picture's content.
        if response < _SURE or max(abs(x), abs(y)) < _STILL:
            return Offset(0.0, 0.0, sure=bool(response >= _SURE))
        return Offset(x / side, y / side, sure=True)

    def shifted(self, offset: Offset) -> Scene:
        """Return the shared scene with its maps shifted to a shaken frame."""
        if offset.x == offset.y == 0:
            return self.scene
        known = self.scene.known_depth
        assert known is not None
        return dataclasses.replace(
            self.scene,
            sky=_shift(self.scene.sky, offset),
            coarse_map=_shift(self.scene.coarse_map, offset),
            water_map=_shift(self.scene.water_map, offset),
            known_depth=dataclasses.replace(
                known,
                log_depth=_shift(known.log_depth, offset),
                confidence=_shift(known.confidence, offset),
            ),
            memory=Memory(),
        )


def _median_picture(photos: Sequence[Photo]) -> Photo:
    """Return the median of the photos' code values, strip by strip."""
    first = photos[0]
    middle = np.empty_like(first.encoded)
    for rows in strips(first.encoded.shape):
        part = np.stack([photo.encoded[rows] for photo in photos])
        middle[rows] = np.median(part, axis=0)
    return dataclasses.replace(
        first, encoded=middle, name="median of frames", alpha=None, sun=None, recorded=None
    )


def _common_sky(small: list[Working]) -> np.ndarray:
    """Return the sky's probability in the median of the frames' maps, (h, w) float32."""
    coarse = np.median(np.stack([coarse_sky.network(w) for w in small]), axis=0)
    return resize(np.asarray(coarse, np.float32), small[0].width, small[0].height)


def _depth_as_it_is(scene: Scene) -> DepthField:
    """Return the scene's depth as a fixed map that does not depend on a frame's picture."""
    field = scene.depth_field
    size = scene.working.width, scene.working.height
    log_depth = field.log_metres(*size, scene.working)
    return DepthField(
        np.ones_like(log_depth),
        log_depth,
        np.asarray(resize(field.confidence, *size), np.float32),
        field.camera,
        field.horizon_error,
        sharpen=False,
    )


def _land_weight(scene: Scene) -> np.ndarray:
    """Return the weight of each pixel for registration: 1 well inside the land."""
    import cv2

    side = _SIDE / max(scene.width, scene.height)
    size = max(8, round(scene.width * side)), max(8, round(scene.height * side))
    land = (resize(scene.sky, *size) < 0.05) & (resize(scene.water_map, *size) < 0.5)
    # Land continues beyond the frame; treetops at the skyline move in the wind.
    inner = cv2.erode(land.astype(np.float32), np.ones((9, 9)))
    window = cv2.createHanningWindow(size, cv2.CV_32F) ** 0.25
    return np.asarray(cv2.GaussianBlur(inner, (0, 0), 3) * window, np.float32)


def _edges(photo: Photo, weight: np.ndarray) -> np.ndarray:
    """Return the land's contrast edges (h, w) float64, independent of its light."""
    import cv2

    small = SRGB.decode(photo.preview(max(weight.shape)))
    light = resize(small, weight.shape[1], weight.shape[0]) @ LUMINANCE
    log = np.log(np.maximum(cv2.GaussianBlur(light, (0, 0), 1.0), 1e-3))
    steep = np.hypot(cv2.Sobel(log, cv2.CV_32F, 1, 0), cv2.Sobel(log, cv2.CV_32F, 0, 1))
    inside = weight > 0.5
    if inside.any():
        steep = np.minimum(steep, np.quantile(steep[inside], 0.95))
    mean = float((steep * weight).sum()) / max(float(weight.sum()), 1e-6)
    return np.asarray((steep - mean) * weight, np.float64)


def _shift(image: np.ndarray, offset: Offset) -> np.ndarray:
    import cv2

    side = max(image.shape)
    matrix = np.array([[1, 0, offset.x * side], [0, 1, offset.y * side]])
    size = image.shape[1], image.shape[0]
    return np.asarray(cv2.warpAffine(image, matrix, size, borderMode=cv2.BORDER_REPLICATE))
