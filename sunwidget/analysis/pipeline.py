"""The stages of the analysis after the decision between sky and land, one function each.

Order: matte → sun → horizon → camera → clouds (minus sun) → atmosphere fit → water; depth is
computed on request. All but the final matte work on a copy of at most 1024 px (``Working``).
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from sunwidget.analysis.backdrop.backdrop import Backdrop, behind_sun
from sunwidget.analysis.backdrop.erase import Erased, erase, erase_nothing, find_glare_on_land
from sunwidget.analysis.clouds import clouds as cloud_stage
from sunwidget.analysis.clouds.clouds import Clouds
from sunwidget.analysis.clouds.cover import unmix_clouds
from sunwidget.analysis.clouds.unmix import cloud_gain
from sunwidget.analysis.depth import depth as depth_stage
from sunwidget.analysis.fit.fit import SkyFit, fit_sky
from sunwidget.analysis.hints import Hints
from sunwidget.analysis.horizon import horizon as horizon_stage
from sunwidget.analysis.horizon.horizon import Horizon
from sunwidget.analysis.images.enlarge import raise_to, take_from
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.memory import Memory
from sunwidget.analysis.networks.land import look_at_land
from sunwidget.analysis.networks.sky import look_at_sky
from sunwidget.analysis.networks.sun import SunMaps, look_for_sun
from sunwidget.analysis.notices import notices
from sunwidget.analysis.scene import Scene, Segmentation
from sunwidget.analysis.segmentation import matting, refine
from sunwidget.analysis.sun import sun as sun_stage
from sunwidget.analysis.sun.camera_glare import angle_to_sun, measured_glare
from sunwidget.analysis.sun.search import Peak, on_dark_land
from sunwidget.analysis.sun.sun import SunMask, SunObservation
from sunwidget.analysis.water import water as water_stage
from sunwidget.errors import AnalysisError
from sunwidget.formats.pixels import size_within
from sunwidget.geometry.camera import Camera, Point
from sunwidget.photo.photo import Photo
from sunwidget.progress import Progress

FIT_SIDE = 384
SURE_HORIZON = 0.68  # least confidence at which nothing below the horizon can be sky

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
            f"{stage} has no method {name!r:.80}; choose one of {', '.join(methods)}."
        )


class Steps:
    """Times the stages and reports them to the caller."""

    def __init__(self, progress: Progress | None) -> None:
        self.progress = progress
        self.timings: dict[str, float] = {}
        self._stage: str | None = None
        self._message = ""
        self._since = 0.0

    def __call__(self, stage: str | None, fraction: float, message: str) -> None:
        """End the running stage and begin another; None ends the last one."""
        now = time.perf_counter()
        if self._stage is not None:
            self.timings[self._stage] = now - self._since
        self._stage, self._message, self._since = stage, message, now
        if self.progress is not None:
            self.progress(fraction, message)

    def within(self, fraction: float) -> None:
        """Report the progress of a long stage; the caller can cancel it there."""
        if self.progress is not None:
            self.progress(fraction, self._message)

    def between(self, first: float, last: float) -> Callable[[float], None]:
        """Return a callback that maps a part's progress, 0 to 1, to the range first to last."""
        return lambda share: self.within(first + (last - first) * share)


def complete(
    base: Segmentation, hints: Hints, step: Steps | None = None, matte: np.ndarray | None = None
) -> Scene:
    """Run every stage after the decision between sky and land, and return the scene.

    A given ``matte`` (H, W), such as one edited by strokes, is not changed.
    """
    step = step or Steps(None)
    photo, working = base.photo, base.working
    zoom_x, zoom_y = working.zoom
    step("matte", 0.5, "Cutting out the sky")
    ours = matte is None
    if matte is None:
        sky, matte = _cut_out(base, step)
    else:
        sky = resize(matte, working.width, working.height)
    camera = Camera(*photo.size, hints.fov or photo.field_of_view.vertical)

    step("sun", 0.7, "Looking for the sun")
    hint = hints.sun_point
    seed = hint and (hint[0] / zoom_x, hint[1] / zoom_y)
    maps = look_for_sun(working)
    searched = seed is None and not hints.sun_outside
    peak = sun_stage.find(working, maps, sky) if searched else None
    sun_mask = grow_sun_mask(working, sky, seed or peak, camera.focal / zoom_y, hints.method("sun"))
    if sun_mask is not None and ours:
        # Network and GrabCut reject a clipped disc as sky, yet the sun is in the sky.
        least = 0.6 if peak is None else 0.25
        disc = sun_stage.in_sky(sun_mask, sky, working.encoded, least)
        sky = np.maximum(sky, disc)
        raise_to(matte, disc, working.zoom)
        sea = sun_stage.find_sea(sun_mask, sky, working.encoded)
        is_sky, no_sky = sea or (np.zeros_like(sky), sun_stage.find_land_glare(sun_mask, sky))
        sky = np.maximum(sky, is_sky) * (1 - no_sky)
        raise_to(matte, is_sky, working.zoom)
        take_from(matte, no_sky, working.zoom)

    if peak is not None and sun_mask is not None and _lens_unknown(photo, hints):
        lens = sun_stage.field_of_view_of(sun_mask, peak, working, camera.fov_vertical_deg)
        camera = Camera(*photo.size, lens or camera.fov_vertical_deg)

    step("horizon", 0.8, "Fitting the horizon")
    horizon = _horizon(working, sky, hints, photo.width, seed, sun_mask)
    camera = Camera.from_horizon(
        *photo.size, camera.fov_vertical_deg, horizon.row, roll=horizon.roll
    )
    # The thesis method's row may be that of a roof, with sky below it.
    seen = horizon.confidence >= SURE_HORIZON and horizon.source != "row_argmax"
    if ours and (hints.horizon is not None or seen):
        # Water that reflects the sky is not sky.
        sky = sky * horizon_stage.above(camera, *sky.shape[::-1])
        horizon_stage.cut_below(matte, camera)
    sun = sun_stage.observe(seed, sun_mask, sky, camera, working, peak)
    moon = None if sun is not None else sun_stage.find_moon(working, sky)
    light = sun
    if moon is not None:
        # At night the moon is the light source; the fit treats it as it treats the sun by day.
        seed = moon[0] * working.width, moon[1] * working.height
        sun_mask = grow_sun_mask(working, sky, seed, camera.focal / zoom_y, hints.method("sun"))
        light = sun_stage.observe(seed, sun_mask, sky, camera, working)

    erased = erased_for(working, maps, sky, light, sun_mask)

    step("clouds", 0.81, "Finding clouds")
    covers = clouds_by_color(erased.working, sky, hints, sun_mask and sun_mask.mask)

    step("fit", 0.82, "Fitting the atmosphere")
    small_horizon = horizon.scaled(1 / zoom_x, 1 / zoom_y)
    with ThreadPoolExecutor(1) as pool:  # the two are independent
        water_search = pool.submit(_water, working, sky, small_horizon, maps, hints)
        fitted, behind, (cover, everywhere) = fit_atmosphere(
            working, erased, sky, covers, camera, light, hints, step
        )
        step("water", 0.95, "Looking for water")
        water = water_search.result()
    scene = Scene(
        **base._asdict(),
        sky=matte,
        cloud_map=cover.opacity,
        softness_map=cover.softness,
        shade=cover.shade,
        everywhere=everywhere,
        sun=sun,
        moon=moon,
        horizon=horizon,
        camera=camera,
        atmosphere=fitted.atmosphere,
        water_map=water,
        assumed_sun=fitted.sun,
        fitted=fitted,
        response={
            "response_shoulder": fitted.response.shoulder,
            "response_contrast": fitted.response.contrast,
            "sky_gain": fitted.gain,
            "cloud_gain": cloud_gain(fitted),
            "glare_profile": fitted.glare,
        },
        warnings=notices(photo, sky, sun, horizon, camera, hints, moon, fitted),
        hints=hints,
        timings=step.timings,
        backdrop=behind.field,
        glare=behind.glare,
        erased=erased,
        memory=Memory(),
    )
    step(None, 1.0, "Analysed")
    return scene


def _cut_out(base: Segmentation, step: Steps) -> tuple[np.ndarray, np.ndarray]:
    """Return the sky at working size and the matte at the photo's size."""
    photo, working = base.photo, base.working
    matte = matting.matte(photo, working, base.decision)
    step.within(0.6)
    sky = resize(matte, working.width, working.height)
    return sky, matte


def grow_sun_mask(
    working: Working, sky: np.ndarray, seed: Point | Peak | None, focal: float, method: str
) -> SunMask | None:
    """Grow the mask of the hinted or detected sun; return None if it is outside the frame."""
    if seed is None or not (0 <= seed[0] < working.width and 0 <= seed[1] < working.height):
        return None
    sun_mask = sun_stage.METHODS[method](working, sky, seed[0], seed[1], focal)
    if method == "flood_fill":  # the thesis method stays unchanged
        return sun_mask
    if isinstance(seed, Peak):
        return sun_stage.limit_to_peak(sun_mask, seed)
    return sun_stage.limit_to_core(sun_mask, seed)


def _lens_unknown(photo: Photo, hints: Hints) -> bool:
    return hints.fov is None and photo.field_of_view.source == "assumed"


def erased_for(
    working: Working,
    maps: SunMaps,
    sky: np.ndarray,
    light: SunObservation | None,
    sun_mask: SunMask | None = None,
) -> Erased:
    """Return the photo without its visible sun or moon, or unchanged if it shows none.

    If the sun shines through trees, where the sky mask is empty, only its glare is removed.
    """
    if light is not None and light.visible:
        return erase(working, maps, sky, light)
    if light is None or sun_mask is None or not sun_mask.mask.any():
        return erase_nothing(working)
    radius = sun_mask.radius * working.zoom[1]
    through = dataclasses.replace(light, blot=sun_mask.mask, radius_px=radius)
    return erase_nothing(working)._replace(on_land=find_glare_on_land(working, maps, sky, through))


def _horizon(
    working: Working,
    sky: np.ndarray,
    hints: Hints,
    width: int,
    seed: Point | None,
    sun_mask: SunMask | None,
) -> Horizon:
    """Return the hinted horizon, or the detected one, below a visible sun; in photo pixels.

    A confident horizon takes precedence over a hinted sun (``seed``), and any over one that is
    hinted on dark land, where none can be seen.
    """
    if hints.horizon is not None:
        return horizon_stage.from_hint(hints.horizon, width)
    find = horizon_stage.METHODS[hints.method("horizon")]
    water = resize(look_at_sky(working).water, working.width, working.height)
    found: Horizon = find(sky, working.encoded, water)
    if found.source == "assumed":
        row = look_at_land(working).horizon * working.height
        found = horizon_stage.expected(found, sky, row, water)
    found = found.scaled(*working.zoom)
    if sun_mask is None:
        return found
    sure = found.confidence >= SURE_HORIZON
    if seed is not None and (sure or on_dark_land(working, sky, seed)):
        return found
    (x, y), (zoom_x, zoom_y) = seed or (sun_mask.x, sun_mask.y), working.zoom
    return horizon_stage.below_sun(found, x * zoom_x, y * zoom_y, sun_mask.radius * zoom_y, width)


def _water(
    working: Working, sky: np.ndarray, horizon: Horizon, maps: SunMaps, hints: Hints
) -> np.ndarray:
    """Return the given or detected water, (h, w) float32; a given map keeps its size."""
    if hints.water is not None:
        return hints.water
    found = METHODS["water"][hints.method("water")](working, sky, horizon, maps)
    return np.asarray(found, np.float32)


def clouds_by_color(
    working: Working, sky: np.ndarray, hints: Hints, sun_mask: np.ndarray | None
) -> tuple[Clouds, Clouds]:
    """Return the clouds of the sky, and of the whole picture as if it were sky, without the sun."""
    find = METHODS["clouds"][hints.method("clouds")]
    everywhere = find(working, np.ones_like(sky), *hints.cloud_ratios)
    if sun_mask is not None:
        everywhere = cloud_stage.without(everywhere, sun_mask)
    return cloud_stage.within(everywhere, sky), everywhere


def fit_atmosphere(
    working: Working,
    erased: Erased,
    sky: np.ndarray,
    covers: tuple[Clouds, Clouds],
    camera: Camera,
    sun: SunObservation | None,
    hints: Hints,
    step: Steps,
) -> tuple[SkyFit, Backdrop, tuple[Clouds, Clouds]]:
    """Fit the sky, reconstruct it behind the sun, and un-mix the clouds from the fitted sky.

    The clouds are returned twice: for the sky, and for the whole picture as if it were sky.
    """
    at = None if sun is None else (sun.azimuth, sun.elevation)
    visible = sun is not None and sun.visible
    unmixed = hints.method("clouds") == "unmix"
    # The fit uses a few hundred pixels, which are less noisy on a small copy.
    small = erased.working.shrunk(FIT_SIDE)
    small_sky = resize(sky, small.width, small.height)
    opacity = resize(covers[0].opacity, small.width, small.height)
    expected = look_at_land(working).sun if sun is None else None
    fitted = fit_sky(
        small,
        small_sky,
        opacity,
        camera,
        at,
        expected,
        done=step.between(0.82, 0.87),
    )
    if unmixed:
        # The clear sky's color reveals the clouds; without them the fit is more accurate.
        veil = cloud_stage.veil(small, small_sky, camera, fitted, sun_seen=visible)[0]
        fitted = fit_sky(
            *(small, small_sky, veil.opacity, camera, fitted.sun),
            done=step.between(0.88, 0.9),
            sure_of_sun=fitted.sun_confidence,
            spread=fitted.sun_spread,
        )
    if visible:
        fitted = _glare_of(fitted, working, erased, sky, camera)
    behind = behind_sun(working, erased, sky, camera, fitted)
    step.within(0.92)
    if unmixed:
        covers = unmix_clouds(erased, sky, camera, fitted, covers, sun_seen=visible)
    return fitted, behind, covers


def _glare_of(
    fit: SkyFit, working: Working, erased: Erased, sky: np.ndarray, camera: Camera
) -> SkyFit:
    """Return the fit with the camera's glare around the sun, measured from the erased light."""
    size = size_within((working.width, working.height), FIT_SIDE)
    display, clean = (resize(w.linear, *size) for w in (working, erased.working))
    trusted = (resize(sky, *size) > 0.95) & (display.max(-1) < 0.95)
    excess = fit.response.scene_light(display) - fit.response.scene_light(clean)
    angle = angle_to_sun(camera, size, fit.sun)
    return dataclasses.replace(fit, glare=measured_glare(excess, angle, trusted, fit))


def find_clouds_again(base: Scene, method: str, ratios: tuple[float, float]) -> Scene:
    """Return the scene with its clouds detected by another method or other thresholds.

    Everything else stays unchanged, including the fit.
    """
    working, sun = base.without_sun.working, base.sun
    sky = base.small_sky
    methods = dict(base.hints.methods) | {"clouds": method}
    hints = dataclasses.replace(base.hints, methods=tuple(methods.items()), cloud_ratios=ratios)
    mask = None if sun is None else resize(sun.blot, working.width, working.height)
    covers = clouds_by_color(working, sky, hints, mask)
    if method == "unmix" and base.fitted is not None:
        seen = sun is not None and sun.visible
        covers = unmix_clouds(
            base.without_sun, sky, base.camera, base.fitted, covers, sun_seen=seen
        )
    cover, everywhere = covers
    return dataclasses.replace(
        base,
        cloud_map=cover.opacity,
        softness_map=cover.softness,
        shade=cover.shade,
        everywhere=everywhere,
        hints=hints,
        memory=Memory(),
    )
