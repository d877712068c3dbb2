"""Any network for depth from one picture, in an ONNX file (MiDaS, Depth Anything, ZoeDepth …).

Most return inverse depth up to a scale and a shift (Ranftl et al., "Towards robust monocular depth
estimation", TPAMI 2022, equation 1). The photo's ground plane gives both.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from sunwidget.analysis.depth import flat_ground
from sunwidget.analysis.depth.field import DepthField
from sunwidget.analysis.depth.levels import fill_sky
from sunwidget.analysis.depth.view import View
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.onnx_file import Opened
from sunwidget.errors import AnalysisError

IMAGENET = ((0.485, 0.456, 0.406), (0.229, 0.224, 0.225))
_SIDES = (384, 518, 256)  # MiDaS and DPT, Depth Anything (a multiple of 14), MiDaS small
_ROUNDS = 8  # of reweighted least squares
_LEAST_GROUND = 50  # pixels


@dataclass(frozen=True)
class DepthNetwork:
    """A network that finds depth, for ``analyze(depth=…)``; options that are None are detected.

    Parameters
    ----------
    path : str or Path
        The .onnx file. It takes one picture and returns one map.
    kind : {"inverse", "depth"}, optional
        Whether the map grows towards the camera (inverse depth, up to scale and shift) or away
        from it (depth, up to scale). Default: the kind that agrees with the ground plane.
    mean, std : float or (r, g, b), optional
        The input is (value - mean) / std of encoded values in [0, 1]. Default: from the file's
        metadata, or ImageNet's, as MiDaS and Depth Anything expect.
    layout : {"nchw", "nhwc"}, optional
        Layout of the input; needed only if the file leaves every dimension open.
    size : int or (width, height), optional
        Size of the input, if the file leaves it open; by default 384, 518 and 256 are tried.
    """

    path: str | Path
    kind: Literal["inverse", "depth"] | None = None
    mean: Any = None
    std: Any = None
    layout: Literal["nchw", "nhwc"] | None = None
    size: int | tuple[int, int] | None = None

    def __post_init__(self) -> None:
        if self.kind not in (None, "inverse", "depth"):
            raise AnalysisError(f"kind must be 'inverse' or 'depth', not {self.kind!r:.80}.")
        if self.layout not in (None, "nchw", "nhwc"):
            raise AnalysisError(f"layout must be 'nchw' or 'nhwc', not {self.layout!r:.80}.")

    def __call__(self, view: View, working: Working) -> DepthField:
        """Run on a photo, and align with the ground plane of its view.

        Raises
        ------
        AnalysisError
            If the file is missing or not a network of one picture, or if it fails, or returns no
            map, NaN, or the same value everywhere.
        """
        found = self._run(working)
        height, width = view.shape
        return aligned(view, resize(found, width, height), found, self.kind)

    def _run(self, working: Working) -> np.ndarray:
        opened = Opened.of(self.path, self.layout, self.size, "depth")
        scale = opened.scale(self.mean, self.std, IMAGENET)
        failure: AnalysisError | None = None
        for side in (None,) if not opened.free or self.size is not None else _SIDES:
            try:
                values = opened.with_side(side).run(working.encoded, scale)
            except AnalysisError as error:  # many networks take only multiples of 14 or of 32
                failure = failure or error
                continue
            if values.ndim != 2:
                raise AnalysisError(
                    f"The depth network {self.path} returned {values.shape[-1]} maps; expected "
                    "one, (1, 1, h, w) or (1, h, w)."
                )
            if not np.isfinite(values).all() or np.ptp(values) <= 0:
                raise AnalysisError(
                    f"The depth network {self.path} returned NaN, infinite values or the same "
                    "value everywhere: its normalization is wrong or the file is damaged. Pass "
                    "depth=DepthNetwork(path, mean=…, std=…), another network, or an array."
                )
            return values.astype(np.float32)
        assert failure is not None
        raise failure


@dataclass(frozen=True, eq=False)
class SeenDepth:
    """A depth map from a phone: (h, w) ``values`` of a ``kind``."""

    values: np.ndarray
    kind: str

    def __call__(self, view: View, _working: Working) -> DepthField:
        """Align the map with the ground plane of a photo's view."""
        height, width = view.shape
        return aligned(view, resize(self.values, width, height), self.values, self.kind)


def aligned(
    view: View, small: np.ndarray, found: np.ndarray, kind: str | None = None
) -> DepthField:
    """Convert a network's output to metres, by the ground that is surely visible.

    For inverse depth, nearness = a · value + b by least squares; the weights make errors relative
    to the square root of the nearness and reduce outliers (Tukey), and the sky has nearness 0. For
    depth, ln depth = ln(value) + c, with the median as c.

    Parameters
    ----------
    small : (h, w) float32
        The network's values at the view's size.
    found : (h', w') float32
        The same at the network's size.
    kind : {"inverse", "depth"}, optional
        Default: by the sign of the correlation with the nearness of the ground.
    """
    camera, error = view.camera, view.horizon_error
    ground = flat_ground.log_depth(view.fall, error, camera.focal, camera.height)
    sure = view.land & (view.fall > 3 * error / camera.focal)
    if sure.sum() < _LEAST_GROUND:
        # No visible ground: rows replace it, since lower rows are usually nearer.
        sure = view.land.copy()
        rows = (np.arange(view.shape[0]) + 1) / view.shape[0]
        ground = np.broadcast_to(np.log(5.0 / rows)[:, None], view.shape).astype(np.float32)
    near, values = np.exp(-ground[sure]).astype(np.float64), small[sure].astype(np.float64)
    if kind is None:
        kind = "depth" if _correlation(values, near) < 0 and found.min() >= 0 else "inverse"
    share = error / view.shape[0]
    if kind == "depth":
        positive = np.maximum(found, 1e-6 * found.max())
        offset = np.median(ground[sure] - np.log(np.maximum(small[sure], 1e-6 * found.max())))
        log_depth = np.log(positive) + np.float32(offset)
    else:
        sky = small[view.sky > 0.98].astype(np.float64)
        slope, shift = _line(values, near, sky)
        nearness = np.maximum(slope * found + shift, 1 / flat_ground.FAR)
        log_depth = -np.log(nearness)
    log_depth = np.minimum(log_depth, np.log(flat_ground.FAR)).astype(np.float32)
    own = resize(log_depth, *view.shape[::-1])
    spread = 1.4826 * np.median(np.abs(own[sure] - ground[sure]))
    confidence = np.full(log_depth.shape, 1 / (1 + (2 * spread) ** 2), np.float32)
    land = resize(view.sky, *log_depth.shape[::-1]) < 0.5
    everywhere = np.ones(log_depth.shape, np.float32)
    filled = fill_sky(log_depth, land)
    return DepthField(everywhere, filled, confidence, view.camera, share, sharpen=False)


def _correlation(a: np.ndarray, b: np.ndarray) -> float:
    a, b = a - a.mean(), b - b.mean()
    return float((a * b).sum() / max(np.sqrt((a * a).sum() * (b * b).sum()), 1e-30))


def _line(values: np.ndarray, near: np.ndarray, sky: np.ndarray) -> tuple[float, float]:
    """Return slope ≥ 0 and shift of near = slope · values + shift; the sky is at 0.

    Some networks return arbitrary values in the sky: a sky that contradicts the ground is ignored.
    """
    if sky.size:
        # At most a quarter as many sky pixels as ground pixels, since they only fix the shift.
        sky = np.quantile(sky, np.linspace(0.05, 0.95, min(sky.size, near.size // 4 + 1)))
        slope, shift = _robust_line(np.append(values, sky), np.append(near, np.zeros(sky.size)))
        if slope > 0 and np.median(sky) < np.median(values):
            return slope, shift
    return _robust_line(values, near)


def _robust_line(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    weight = base = 1 / np.maximum(y, 0.05 * np.median(y[y > 0]))
    slope = shift = 0.0
    for _ in range(_ROUNDS):
        total = weight.sum()
        mean_x, mean_y = (weight @ x) / total, (weight @ y) / total
        spread = weight @ (x - mean_x) ** 2
        slope = max(float(weight @ ((x - mean_x) * (y - mean_y)) / max(spread, 1e-30)), 0.0)
        shift = float(mean_y - slope * mean_x)
        residual = np.abs(slope * x + shift - y) * np.sqrt(base)
        limit = 4.685 * 1.4826 * max(float(np.median(residual)), 1e-12)
        weight = base * np.clip(1 - (residual / limit) ** 2, 0, 1) ** 2 + 1e-12
    return slope, shift
