"""A donor's sky, looked up by direction.

Where the donor's camera sees sky, its own pixels are used. Over its land and outside its frame, the
*residual* of photo over fitted model (backdrop.py) is mirrored and added to the model of the
requested direction: clouds continue, gradients follow the air, and nothing is stretched. A mirrored
residual excludes the donor's sun, so that there is only one sun.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from sunwidget.analysis.backdrop.backdrop import matched_sky, to_light
from sunwidget.analysis.fit.fit import SkyFit, view_angles
from sunwidget.analysis.images.fill import fill_by_pyramid
from sunwidget.analysis.images.working_copy import resize
from sunwidget.errors import AnalysisError
from sunwidget.formats.pixels import size_within
from sunwidget.geometry.camera import Camera

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

_LONG_SIDE = 4096  # of the donor; skies hold no finer detail
_LEAST_SKY = 0.01  # share of the picture
_FEATHER = 0.015  # share of the long side over which real pixels blend into mirrored ones
_FURTHEST = 0.9  # natural log by which the model may change a mirrored sky


@dataclass(frozen=True, eq=False)
class DonorSky:
    """The whole sky of a donor, the result of ``donor_sky``.

    Attributes
    ----------
    logs : (h, w, 3) float32
        Log of the scene-linear light of the donor's frame with its land filled.
    sunless : (h, w, 3) float32
        The same without the sun and its glare.
    camera : Camera
        The donor's camera at the size of ``logs``.
    fitted : SkyFit
    """

    logs: np.ndarray
    sunless: np.ndarray
    camera: Camera
    fitted: SkyFit

    def look_up(self, azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
        """Return the sky in some directions, as rendered by the donor's camera.

        Parameters
        ----------
        azimuth, elevation : (h, w) float array
            Degrees; azimuth relative to the donor's heading.

        Returns
        -------
        (h, w, 3) float32
            Display-linear light.
        """
        import cv2

        folded_azimuth, folded_elevation, outside = self._fold_into_frame(azimuth, elevation)
        x, y = self.camera.pixel(folded_azimuth, folded_elevation)
        x, y = (np.asarray(v, np.float32) - np.float32(0.5) for v in (x, y))

        def sample(image: np.ndarray) -> np.ndarray:
            return np.asarray(cv2.remap(image, x, y, cv2.INTER_LINEAR, None, cv2.BORDER_REFLECT))

        seen = sample(self.logs)
        if outside.max() > 0:
            share = np.clip(outside / 2.0, 0, 1)[..., None].astype(np.float32)
            seen = seen + share * (sample(self.sunless) - seen)
            change = self._model(azimuth, elevation) - self._model(folded_azimuth, folded_elevation)
            seen = seen + share * _FURTHEST * np.tanh(change / _FURTHEST)
        return self.fitted.response.display_light(np.exp(seen))

    def _fold_into_frame(
        self, azimuth: np.ndarray, elevation: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Mirror directions at the edges of the donor's frame; also return the distance outside.

        The edges are taken at each direction's elevation, so that the sky is continuous there.
        """
        width, height = self.camera.width, self.camera.height
        down, along = np.linspace(0.5, height - 0.5, 64), np.linspace(0.5, width - 0.5, 64)
        left = _edge(*self.camera.angles(np.full(64, 0.5), down), elevation)
        right = _edge(*self.camera.angles(np.full(64, width - 0.5), down), elevation)
        azimuth_in = _fold(azimuth, left, right)
        top = _edge(*self.camera.angles(along, np.full(64, 0.5))[::-1], azimuth_in)
        bottom = _edge(*self.camera.angles(along, np.full(64, height - 0.5))[::-1], azimuth_in)
        elevation_in = _fold(elevation, bottom, top)
        beside = np.maximum(np.maximum(left - azimuth, azimuth - right), 0)
        above = np.maximum(np.maximum(bottom - elevation, elevation - top), 0)
        return azimuth_in, elevation_in, np.asarray(np.maximum(beside, above))

    def _model(self, azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
        """Return the log of the clear sky without glare (h, w, 3), from a coarse grid."""
        import cv2

        rows, columns = azimuth.shape
        coarse = (min(24, columns), min(24, rows))
        # The grid ends at the first and last directions, so that remapping is exact there.
        at = np.ix_(
            np.linspace(0, rows - 1, coarse[1]).round().astype(int),
            np.linspace(0, columns - 1, coarse[0]).round().astype(int),
        )
        logs = np.log(self.fitted.model(azimuth[at], np.maximum(elevation[at], 0.2)))
        x = np.linspace(0, coarse[0] - 1, columns, dtype=np.float32)
        y = np.linspace(0, coarse[1] - 1, rows, dtype=np.float32)
        grid = np.meshgrid(x, y)
        fine = cv2.remap(logs.astype(np.float32), *grid, cv2.INTER_LINEAR)
        return np.asarray(fine).reshape(rows, columns, 3)


def donor_sky(donor: Scene, focal: float) -> DonorSky:
    """Complete the sky of ``donor`` for a photo of focal length ``focal`` (pixels).

    Raises
    ------
    AnalysisError
        When the donor shows no sky.
    """
    if float(np.mean(donor.sky > 0.5)) < _LEAST_SKY:
        raise AnalysisError(
            f"No sky to take from {donor.photo.name} ({np.mean(donor.sky > 0.5):.1%} of its "
            "pixels). Choose another donor, or analyze it with sky=mask."
        )
    assert donor.fitted is not None
    scale = min(1.0, focal / donor.camera.focal, _LONG_SIDE / max(donor.width, donor.height))
    size = max(2, round(donor.width * scale)), max(2, round(donor.height * scale))
    camera = donor.camera.resized(*size)
    light = np.maximum(resize(donor.photo.pixels, *size), 0)
    sky = resize(donor.sky, *size)
    model = np.log(resize(matched_sky(donor.fitted, donor.camera, _small(size)), *size))
    residual = np.log(donor.fitted.response.scene_light(light)) - model
    slow = np.log(np.maximum(to_light(resize(donor.backdrop, *size)), 1e-6)) - model
    glare = resize(donor.glare, *size)[..., None]
    sunless = residual + glare * (slow - residual)
    return DonorSky(
        (_without_land(residual, sky) + model).astype(np.float32),
        (_without_land(sunless, sky) + model).astype(np.float32),
        camera,
        donor.fitted,
    )


def directions(
    camera: Camera, size: tuple[int, int], rows: slice, turn: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return azimuth from the donor's heading, and elevation, of rows of a picture of ``size``."""
    if size == (camera.width, camera.height):
        first, last, _ = rows.indices(size[1])
        y, x = np.mgrid[first:last, : size[0]] + 0.5
        azimuth, elevation = camera.angles(x, y)
    else:
        azimuth, elevation = (a[rows] for a in view_angles(camera, *size))
    return (azimuth + turn + 180) % 360 - 180, elevation


def _without_land(residual: np.ndarray, sky: np.ndarray) -> np.ndarray:
    """Replace land by the sky above it, mirrored at the skyline of its column."""
    import cv2

    height, width = sky.shape
    feather = max(2.0, _FEATHER * max(sky.shape))
    known = cv2.erode((sky > 0.97).astype(np.uint8), np.ones((5, 5), np.uint8))
    # No feather at the border of the picture, where the sky continues.
    padded = np.pad(known, 1, mode="edge")
    deep = np.clip(cv2.distanceTransform(padded, cv2.DIST_L2, 5)[1:-1, 1:-1] / feather, 0, 1)
    tops = np.where(known.min(0) > 0, height, known.argmin(0)).astype(np.float32)
    reach = 2 * int(feather) + 1
    tops = cv2.erode(tops[None], np.ones((1, reach), np.uint8))
    tops = cv2.GaussianBlur(tops, (0, 0), feather)
    rows = np.mgrid[:height, :width][0].astype(np.float32)
    columns = np.broadcast_to(np.arange(width, dtype=np.float32), sky.shape)
    period = np.maximum(2 * tops, 2)
    above = np.mod(rows, period)
    above = np.minimum(above, period - above)
    above = np.where(rows < tops, rows, above)
    weighted = np.dstack([residual * deep[..., None], deep]).astype(np.float32)
    mirrored = cv2.remap(
        weighted, columns.copy(), above, cv2.INTER_LINEAR, None, cv2.BORDER_REPLICATE
    )
    # A column with little sky has nothing to mirror.
    trust = np.clip(tops / (4 * feather) - 0.5, 0, 1) * (1 - deep)
    total = deep + trust * mirrored[..., -1]
    joined = weighted[..., :-1] + trust[..., None] * mirrored[..., :-1]
    values = joined / np.maximum(total, 1e-6)[..., None]
    return fill_by_pyramid(values.astype(np.float32), np.clip(total, 0, 1).astype(np.float32))


def _small(size: tuple[int, int]) -> tuple[int, int]:
    return size_within(size, 512)


def _edge(values: np.ndarray, places: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Interpolate an edge of the frame (``values`` at ``places``) at other places."""
    order = np.argsort(places)
    return np.asarray(np.interp(at, places[order], values[order]))


def _fold(value: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Fold into low … high by mirroring; values inside do not change."""
    span = np.maximum(high - low, 1e-3)
    turns = np.mod(value - low, 2 * span)
    return np.asarray(
        np.where((value >= low) & (value <= high), value, low + np.minimum(turns, 2 * span - turns))
    )
