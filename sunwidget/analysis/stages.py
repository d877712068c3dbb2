"""The stages of the analysis after the decision sky or land, one function each.

Order: matte → sun → clouds (minus sun) → horizon → camera → atmosphere fit → depth → water. All
but the final matte work on a copy of at most 1024 px (``Working``).
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.analysis import clouds as cloud_stage
from sunwidget.analysis import depth as depth_stage
from sunwidget.analysis import horizon as horizon_stage
from sunwidget.analysis import refine
from sunwidget.analysis import sun as sun_stage
from sunwidget.analysis import water as water_stage
from sunwidget.analysis.backdrop import Backdrop, behind_sun, fill_by_pyramid
from sunwidget.analysis.clouds import Clouds
from sunwidget.analysis.errors import AnalysisError
from sunwidget.analysis.fit import SkyFit, fit_sky
from sunwidget.analysis.hints import Hints
from sunwidget.analysis.horizon import Horizon
from sunwidget.analysis.islands import fill_islands, grow_over_glow
from sunwidget.analysis.notices import NO_SKY, notices
from sunwidget.analysis.strokes import apply_strokes
from sunwidget.analysis.sun import Blot, SunObservation
from sunwidget.analysis.working import Working, resize
from sunwidget.camera import Camera, Point

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

Progress = Callable[[float, str], Any]
SURE_HORIZON = 0.6  # confidence from which nothing below the horizon can be sky

METHODS: dict[str, dict[str, Callable[..., Any]]] = {
    "refine": refine.METHODS,
    "clouds": cloud_stage.METHODS,
    "horizon": horizon_stage.METHODS,
    "sun": sun_stage.METHODS,
    "depth": depth_stage.METHODS,
    "water": water_stage.METHODS,
}


def check_method(stage: str, name: Any) -> None:
    """Raise AnalysisError unless ``stage`` has a method of this name."""
    methods = METHODS[stage]
    if not isinstance(name, str) or name not in methods:
        raise AnalysisError(
            f"{stage} knows no method {name!r:.80}; choose one of {', '.join(methods)}."
        )


class Steps:
    """Times the stages and tells the caller about them."""

    def __init__(self, progress: Progress | None) -> None:
        self.progress = progress
        self.timings: dict[str, float] = {}
        self._stage: str | None = None
        self._since = 0.0

    def __call__(self, stage: str | None, fraction: float, message: str) -> None:
        """End the running stage and begin another; None ends the last one."""
        now = time.perf_counter()
        if self._stage is not None:
            self.timings[self._stage] = now - self._since
        self._stage, self._since = stage, now
        if self.progress is not None:
            self.progress(fraction, message)


def complete(base: Scene, hints: Hints, step: Steps | None = None) -> Scene:
    """Run every stage after the decision sky or land, and return a new scene."""
    step = step or Steps(None)
    photo, working = base.photo, base.working
    zoom_x, zoom_y = working.zoom
    step("matte", 0.5, "Cutting out the sky")
    sky, matte = _cut_out(base, hints)
    kept = _kept(base, hints, matte)
    camera = Camera(*photo.size, hints.fov or photo.field_of_view.vertical)

    step("sun", 0.7, "Looking for the sun")
    seed = hints.sun and (hints.sun[0] / zoom_x, hints.sun[1] / zoom_y)
    blot = _sun_blot(working, sky, seed, camera.focal / zoom_y, hints.method("sun"), kept)
    if blot is not None:
        # A burnt disc looks like no sky to network and GrabCut, yet the sun is in the sky.
        disc = sun_stage.in_sky(blot, sky)
        sky = np.maximum(sky, disc)
        matte = np.maximum(matte, resize(disc, *photo.size))

    step("clouds", 0.75, "Finding clouds")
    cover = METHODS["clouds"][hints.method("clouds")](working, sky, *hints.cloud_ratios)
    if blot is not None:
        cover = cloud_stage.without(cover, blot.mask)

    step("horizon", 0.8, "Fitting the horizon")
    horizon = kept.horizon if kept is not None else _horizon(working, sky, hints, photo.width)
    camera = Camera.from_horizon(
        *photo.size, camera.fov_vertical_deg, horizon.row, roll=horizon.roll
    )
    if hints.horizon is not None or horizon.confidence >= SURE_HORIZON:
        # Water that mirrors the sky is not sky.
        sky = sky * horizon_stage.above(camera, *sky.shape[::-1])
        matte = matte * horizon_stage.above(camera, *photo.size)
        refine.set_strokes(matte, hints.strokes)
    sun = sun_stage.observe(seed, blot, sky, camera, working) if kept is None else kept.sun

    step("fit", 0.82, "Fitting the atmosphere")
    fitted, behind, cover = _atmosphere(working, sky, cover, camera, sun, hints, kept)

    step("depth", 0.9, "Estimating depth")
    depth = _depth(sky, camera, hints)
    step("water", 0.95, "Looking for water")
    water = METHODS["water"][hints.method("water")](working, sky, horizon.row / zoom_y)
    scene = dataclasses.replace(
        base,
        sky=matte,
        clouds=resize(cover.opacity, *photo.size),
        cloud_softness=resize(cover.softness, *photo.size),
        shade=cover.shade,
        sun=sun,
        horizon=horizon,
        camera=camera,
        atmosphere=fitted.atmosphere,
        depth=depth,
        water=resize(water, *photo.size),
        assumed_sun=fitted.sun,
        fitted=fitted,
        response={
            "response_shoulder": fitted.response.shoulder,
            "response_contrast": fitted.response.contrast,
            "sky_gain": fitted.gain,
            "glare_profile": fitted.glare,
        },
        warnings=notices(photo, sky, sun, blot, horizon, camera, hints, base.doubted),
        hints=hints,
        timings=step.timings,
        backdrop=behind.field,
        glare=behind.glare,
        _corrected={},
    )
    step(None, 1.0, "Analysed")
    return scene


def _cut_out(base: Scene, hints: Hints) -> tuple[np.ndarray, np.ndarray]:
    """Return the sky at working size and the matte at the photo's size."""
    photo, working = base.photo, base.working
    # Not from ``base.sky``: that one holds the sun that ``base`` saw, which a hint may move.
    decision = apply_strokes(working, base.decision, hints.strokes)
    matte = refine.matte(photo, working, decision, hints.strokes)
    sky = resize(matte, working.width, working.height)
    coarse = resize(base.sky_coarse, working.width, working.height)
    bound = fill_islands(sky, coarse, hints.strokes)
    glow = grow_over_glow(np.maximum(sky, bound), coarse, working.encoded, hints.strokes)
    bound = np.maximum(bound, glow)
    if bound.any():
        sky = np.maximum(sky, bound)
        matte = np.maximum(matte, resize(bound, *photo.size))
    return sky, matte


def _kept(base: Scene, hints: Hints, matte: np.ndarray) -> Scene | None:
    """Return the scene whose sun, horizon, camera and fit a few strokes need not change.

    None when anything but strokes is new, or when they change so much of the sky (5 % of the
    picture, or there was none) that it has to be looked at again.
    """
    if base.fitted is None or base.sky.shape != matte.shape:
        return None
    if dataclasses.replace(hints, strokes=base.hints.strokes) != base.hints:
        return None
    if base.horizon.confidence >= SURE_HORIZON:  # as a hint's is, too
        matte = matte * horizon_stage.above(base.camera, *base.photo.size)
    much = float(np.mean(np.abs(matte - base.sky))) > 0.05
    return None if much or float(np.mean(base.sky > 0.5)) < NO_SKY else base


def _sun_blot(
    working: Working,
    sky: np.ndarray,
    seed: Point | None,
    focal: float,
    method: str,
    kept: Scene | None,
) -> Blot | None:
    """Grow the blot of the hinted, kept or found sun; None when none is in the frame."""
    if kept is None:
        found = seed or sun_stage.find(working, sky, focal)
    else:
        zoom_x, zoom_y = working.zoom
        found = None if kept.sun is None else (kept.sun.x / zoom_x, kept.sun.y / zoom_y)
    if not found or not (0 <= found[0] < working.width and 0 <= found[1] < working.height):
        return None
    return sun_stage.METHODS[method](working, sky, found[0], found[1], focal)


def _horizon(working: Working, sky: np.ndarray, hints: Hints, width: int) -> Horizon:
    """Return the hinted or found horizon, in pixels of the photo."""
    if hints.horizon is not None:
        return horizon_stage.from_hint(hints.horizon, width)
    return horizon_stage.METHODS[hints.method("horizon")](sky).scaled(*working.zoom)


def _atmosphere(
    working: Working,
    sky: np.ndarray,
    cover: Clouds,
    camera: Camera,
    sun: SunObservation | None,
    hints: Hints,
    kept: Scene | None,
) -> tuple[SkyFit, Backdrop, Clouds]:
    """Fit the sky, look behind the sun, and un-mix the clouds from the fitted sky."""
    sun_angles = None if sun is None else (sun.azimuth, sun.elevation)
    visible = sun is not None and sun.visible
    unmixed = hints.method("clouds") == "unmix"
    if kept is not None and kept.fitted is not None:
        fitted = kept.fitted
    else:
        assumed = sun_angles or sun_stage.assume(working, sky, camera)
        fitted = fit_sky(working, sky, cover.opacity, camera, sun_angles, assumed)
        if unmixed:
            # The colour of the clear sky tells the clouds, and without them it is known better.
            opacity, _ = cloud_stage.veil(working, sky, camera, fitted, sun_seen=visible)
            fitted = fit_sky(working, sky, opacity, camera, fitted.sun, assumed)
    fitted, behind = behind_sun(working, sky, camera, fitted, visible=visible)
    if unmixed:
        cover = _unmixed(working, sky, camera, fitted, behind.glare, cover, sun_seen=visible)
    return fitted, behind, cover


def _unmixed(
    working: Working,
    sky: np.ndarray,
    camera: Camera,
    fitted: SkyFit,
    glare: np.ndarray,
    cover: Clouds,
    *,
    sun_seen: bool,
) -> Clouds:
    """Return ``cover`` with opacity and shade un-mixed from the fitted sky."""
    opacity, shade = cloud_stage.veil(working, sky, camera, fitted, sun_seen=sun_seen)
    # Round the sun whiteness tells nothing: continue the clouds from around it.
    trust = 1 - resize(glare, working.width, working.height)
    filled = fill_by_pyramid(np.dstack([opacity, shade]), trust)
    return Clouds(filled[..., 0], cover.softness, filled[..., 1])


def find_clouds_again(base: Scene, method: str, ratios: tuple[float, float]) -> Scene:
    """Return the scene with its clouds found by another method or other thresholds.

    All else stays as it is, the fit too.
    """
    working, sun = base.working, base.sun
    sky = resize(base.sky, working.width, working.height)
    cover = METHODS["clouds"][method](working, sky, *ratios)
    if sun is not None:
        mask = resize(sun.mask, working.width, working.height)
        cover = cloud_stage.without(cover, mask)
    if method == "unmix" and base.fitted is not None:
        seen = sun is not None and sun.visible
        cover = _unmixed(working, sky, base.camera, base.fitted, base.glare, cover, sun_seen=seen)
    methods = dict(base.hints.methods) | {"clouds": method}
    return dataclasses.replace(
        base,
        clouds=resize(cover.opacity, *base.photo.size),
        cloud_softness=resize(cover.softness, *base.photo.size),
        shade=cover.shade,
        hints=dataclasses.replace(base.hints, methods=tuple(methods.items()), cloud_ratios=ratios),
        _corrected={},
    )


def _depth(sky: np.ndarray, camera: Camera, hints: Hints) -> np.ndarray:
    """Return metres at the photo's size."""
    small = METHODS["depth"][hints.method("depth")](sky, camera.resized(*sky.shape[::-1]))
    # Interpolated as 1 / depth, which is finite in the sky and linear on the ground.
    nearness = resize(1 / small, camera.width, camera.height)
    with np.errstate(divide="ignore"):
        depth = np.where(nearness < 0.5 / depth_stage.FAR, np.inf, 1 / nearness)
    return depth.astype(np.float32)
