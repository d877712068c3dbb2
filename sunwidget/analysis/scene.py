"""Scene: everything the analysis knows about a photo; ``analyze`` makes it.

Order of the stages: sky → sun → clouds (minus sun) → horizon → camera → atmosphere fit → depth →
water. All but the final matte work on a copy of at most 1024 px (``Working``).
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from sunwidget.analysis import clouds as cloud_stage
from sunwidget.analysis import depth as depth_stage
from sunwidget.analysis import horizon as horizon_stage
from sunwidget.analysis import match, refine
from sunwidget.analysis import sky as sky_stage
from sunwidget.analysis import sun as sun_stage
from sunwidget.analysis import water as water_stage
from sunwidget.analysis.backdrop import behind_sun, fill_by_pyramid
from sunwidget.analysis.errors import AnalysisError
from sunwidget.analysis.fit import SkyFit, fit_sky
from sunwidget.analysis.horizon import Horizon
from sunwidget.analysis.islands import fill_islands, grow_over_glow
from sunwidget.analysis.strokes import apply_strokes
from sunwidget.analysis.sun import SunObservation
from sunwidget.analysis.working import Working, resize
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.camera import Camera, Point
from sunwidget.edit import PARAMETERS, Edit, Stroke
from sunwidget.photo import Photo, open_photo

Progress = Callable[[float, str], Any]
SURE_HORIZON = 0.6  # confidence from which nothing below the horizon can be sky
NO_SKY = 0.005  # share of the picture below which the photo counts as without sky


@dataclass(frozen=True)
class Hints:
    """What a person says about the photo; a hint wins over detection.

    Points are pixels of the photo. ``methods`` names the method of each stage.
    """

    sun: Point | None = None
    horizon: float | tuple[Point, Point] | None = None
    fov: float | None = None
    strokes: tuple[Stroke, ...] = ()
    methods: tuple[tuple[str, str], ...] = ()

    def method(self, stage: str) -> str:
        """Name of the stage's method."""
        return dict(self.methods)[stage]


@dataclass(frozen=True, eq=False)
class Scene:
    """A photo and what was found in it. Made by ``analyze``; never changes.

    Attributes
    ----------
    photo : Photo
    sky : (H, W) float32
        Alpha matte, 1 = sky, clouds and sun included.
    sky_coarse : (H, W) float32
        The network's map before refinement.
    clouds, cloud_softness : (H, W) float32
        Opacity of the clouds, and the thesis' C^s.
    sun : SunObservation or None
        The photo's own sun; None when it shows none and no hint gave one.
    horizon : Horizon
    camera : Camera
    atmosphere : Atmosphere
    depth : (H, W) float32
        Metres along the optical axis, inf for the sky.
    water : (H, W) float32
    backdrop : (h, w, 3) float32
        The slow log residual of photo over model, encoded (analysis/backdrop.py).
    glare : (h, w) float32
        Where the backdrop replaces the photo once the sun has moved.
    assumed_sun : (azimuth, elevation)
        Degrees; where the sun is taken to be while ``sun`` is None.
    response : dict
        Further uniforms from the fit: camera response, gain and glare.
    warnings : tuple of str
        What a person should know; each says what to do.
    hints : Hints
        What it was analysed with.
    timings : dict
        Seconds of each stage.
    """

    photo: Photo = field(repr=False)
    sky: np.ndarray = field(repr=False)
    sky_coarse: np.ndarray = field(repr=False)
    clouds: np.ndarray = field(repr=False)
    cloud_softness: np.ndarray = field(repr=False)
    sun: SunObservation | None = field(repr=False)
    horizon: Horizon
    camera: Camera
    atmosphere: Atmosphere
    depth: np.ndarray = field(repr=False)
    water: np.ndarray = field(repr=False)
    backdrop: np.ndarray = field(repr=False)
    glare: np.ndarray = field(repr=False)
    assumed_sun: tuple[float, float]
    response: dict[str, Any]
    warnings: tuple[str, ...]
    hints: Hints
    timings: dict[str, float] = field(repr=False)
    working: Working = field(repr=False)
    decision: refine.Decision = field(repr=False)
    fitted: SkyFit | None = field(default=None, repr=False)
    _corrected: dict[Any, Scene] = field(default_factory=dict, repr=False)

    @property
    def width(self) -> int:
        """Columns of the photo."""
        return self.camera.width

    @property
    def height(self) -> int:
        """Rows of the photo."""
        return self.camera.height

    @property
    def automatic(self) -> dict[str, float]:
        """The value that each automatic parameter of ``Edit`` takes in this photo."""
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

    def uniforms(self) -> dict[str, Any]:
        """Values of the frame graph's scene uniforms: floats and tuples of floats."""
        return self._uniforms

    @cached_property
    def _uniforms(self) -> dict[str, Any]:
        small = self.working
        sky = resize(self.sky, small.width, small.height)
        blot = 0.0 if self.sun is None else float(self.sun.mask.sum())
        own = match.statistics(small.linear, sky)
        return {
            "camera_right": self.camera.right,
            "camera_up": self.camera.up,
            "camera_forward": self.camera.forward,
            "camera_focal": self.camera.focal / self.camera.height,
            "sun_visible": float(self.sun is not None and self.sun.visible),
            "sun_mask_share": min(1.0, blot / max(float(self.sky.sum()), 1.0)),
            "photo_sky_mean": own.mean,
            "photo_sky_deviation": own.deviation,
            "photo_sky_linear_mean": _weighted_mean(small.linear, sky),
            "photo_land_linear_mean": _weighted_mean(small.linear, 1 - sky),
            "response_shoulder": 0.0,
            "response_contrast": 1.0,
            "glare_profile": (0.0, 3.0, 2.0),
            "sky_gain": (1.0, 1.0, 1.0),
        } | self.response

    def layers(self) -> np.ndarray:
        """(H, W, 3) float32 in [0, 1]: sky matte, cloud opacity, cloud softness."""
        return np.stack([self.sky, self.clouds, self.cloud_softness], axis=-1)

    def surface(self) -> np.ndarray:
        """(H, W, 3) float32 in [0, 1]: glare, water, glitter.

        Glare is where the photo says nothing about the sky behind: the old sun's clipped core
        and its halo, fading outwards.
        """
        glare = resize(self.glare, self.width, self.height)
        small = self.working
        sky = resize(self.sky, small.width, small.height)
        glints = resize(water_stage.glitter(small, sky), self.width, self.height)
        return np.stack([glare, self.water, glints], axis=-1)

    def corrected(self, edit: Edit) -> Scene:
        """Return the scene with the edit's strokes and hints applied.

        The same edit always gives the same maps, to the bit; an edit that corrects nothing
        gives this very object.

        Raises
        ------
        AnalysisError
            When a hint cannot be used.
        """
        corrections = (edit.strokes, edit.sun_hint, edit.horizon_hint, edit.fov_hint)
        if corrections == ((), None, None, None):
            return self
        if corrections not in self._corrected:
            while len(self._corrected) >= 3:  # each holds full-size maps
                self._corrected.pop(next(iter(self._corrected)), None)
            # Strokes come last, on the scene with the hints: they leave its camera and fit alone.
            base = self.corrected(edit.replace(strokes=())) if edit.strokes else self
            self._corrected[corrections] = _complete(base, self._with_hints(edit), None)
        return self._corrected[corrections]

    def _with_hints(self, edit: Edit) -> Hints:
        def pixels(point: Point) -> Point:
            return point[0] * self.width, point[1] * self.height

        changes: dict[str, Any] = {"strokes": self.hints.strokes + edit.strokes}
        if edit.sun_hint is not None:
            changes["sun"] = pixels(edit.sun_hint)
        if edit.horizon_hint is not None:
            changes["horizon"] = (pixels(edit.horizon_hint[0]), pixels(edit.horizon_hint[1]))
        if edit.fov_hint is not None:
            changes["fov"] = edit.fov_hint
        return dataclasses.replace(self.hints, **changes)


def analyze(
    photo: Any,
    *,
    sun: Point | None = None,
    horizon: float | tuple[Point, Point] | None = None,
    fov: float | None = None,
    sky: Any = None,
    refine: str = "grabcut_mask",
    clouds: str = "unmix",
    horizon_method: str = "robust_line",
    sun_method: str = "disc_fit",
    depth: str = "ground_plane",
    water: str = "none",
    strokes: tuple[Stroke, ...] = (),
    progress: Progress | None = None,
) -> Scene:
    """Find sky, sun, clouds, horizon, camera, depth and water in a photo.

    Parameters
    ----------
    photo : Photo or anything that ``sunwidget.open`` takes
    sun : (x, y), optional
        Where the photo's own sun is, in pixels; may lie outside the picture.
    horizon : float or ((x0, y0), (x1, y1)), optional
        Row of the horizon at the picture's centre, or two of its points, in pixels.
    fov : float, optional
        Vertical field of view in degrees.
    sky : array, path or str, optional
        A mask, the path of an ONNX network, or a name of ``sky.METHODS``.
    refine, clouds, horizon_method, sun_method, depth, water : str
        Name in the stage's ``METHODS``.
    strokes : tuple of Stroke
        Corrections of the sky.
    progress : callable, optional
        Called with (fraction, message); raise in it to cancel.

    Returns
    -------
    Scene

    Raises
    ------
    AnalysisError
        For a hint or method that cannot be used, or a missing network.
    PhotoError
        When the photo cannot be opened.
    """
    photo = open_photo(photo)
    methods = {
        "refine": refine,
        "clouds": clouds,
        "horizon": horizon_method,
        "sun": sun_method,
        "depth": depth,
        "water": water,
    }
    for stage, name in methods.items():
        _check_method(stage, name)
    hints = Hints(
        _check_point("sun", sun),
        _check_horizon(horizon),
        _check_fov(fov),
        tuple(strokes),
        tuple(methods.items()),
    )
    step = _Steps(progress)
    step("prepare", 0.0, "Preparing the photo")
    working = Working.of(photo)
    step("sky", 0.1, "Finding the sky")
    coarse = sky_stage.coarse(working, sky, photo.size)
    step("refine", 0.4, "Following the skyline")
    decision = _REGISTRIES["refine"][refine](working, coarse)
    camera = Camera(photo.width, photo.height, hints.fov or photo.field_of_view.vertical)
    empty = np.zeros((1, 1), np.float32)
    start = Scene(
        photo=photo,
        sky=empty,
        sky_coarse=resize(coarse, *photo.size),
        clouds=empty,
        cloud_softness=empty,
        sun=None,
        horizon=Horizon(0.0),
        camera=camera,
        atmosphere=Atmosphere(),
        depth=empty,
        water=empty,
        backdrop=empty,
        glare=empty,
        assumed_sun=(0.0, 0.0),
        response={},
        warnings=(),
        hints=hints,
        timings=step.timings,
        working=working,
        decision=decision,
    )
    return _complete(start, hints, step)


_REGISTRIES: dict[str, dict[str, Callable[..., Any]]] = {
    "refine": refine.METHODS,
    "clouds": cloud_stage.METHODS,
    "horizon": horizon_stage.METHODS,
    "sun": sun_stage.METHODS,
    "depth": depth_stage.METHODS,
    "water": water_stage.METHODS,
}


class _Steps:
    """Times the stages and tells the caller about them."""

    def __init__(self, progress: Progress | None) -> None:
        self.progress = progress
        self.timings: dict[str, float] = {}
        self._stage: str | None = None
        self._since = 0.0

    def __call__(self, stage: str | None, fraction: float, message: str) -> None:
        now = time.perf_counter()
        if self._stage is not None:
            self.timings[self._stage] = now - self._since
        self._stage, self._since = stage, now
        if self.progress is not None:
            self.progress(fraction, message)


def _complete(base: Scene, hints: Hints, step: _Steps | None) -> Scene:
    """Run every stage after the decision sky or land, and return a new scene."""
    step = step or _Steps(None)
    photo, working = base.photo, base.working
    zoom_x, zoom_y = working.zoom
    step("matte", 0.5, "Cutting out the sky")
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
    kept = _kept(base, hints, matte)
    camera = Camera(*photo.size, hints.fov or photo.field_of_view.vertical)

    step("sun", 0.7, "Looking for the sun")
    focal = camera.focal / zoom_y
    seed = hints.sun and (hints.sun[0] / zoom_x, hints.sun[1] / zoom_y)
    if kept is None:
        found = seed or sun_stage.find(working, sky, focal)
    else:
        found = None if kept.sun is None else (kept.sun.x / zoom_x, kept.sun.y / zoom_y)
    blot = None
    if found and 0 <= found[0] < working.width and 0 <= found[1] < working.height:
        grow = sun_stage.METHODS[hints.method("sun")]
        blot = grow(working, sky, found[0], found[1], focal)
        # A burnt disc looks like no sky to network and GrabCut, yet the sun is in the sky.
        disc = sun_stage.in_sky(blot, sky)
        sky = np.maximum(sky, disc)
        matte = np.maximum(matte, resize(disc, *photo.size))

    step("clouds", 0.75, "Finding clouds")
    cover = cloud_stage.METHODS[hints.method("clouds")](working, sky)
    if blot is not None:
        cover = cloud_stage.without(cover, blot.mask)

    step("horizon", 0.8, "Fitting the horizon")
    if kept is not None:
        horizon = kept.horizon
    elif hints.horizon is not None:
        horizon = horizon_stage.from_hint(hints.horizon, photo.width)
    else:
        horizon = horizon_stage.METHODS[hints.method("horizon")](sky).scaled(zoom_x, zoom_y)
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
    sun_angles = None if sun is None else (sun.azimuth, sun.elevation)
    visible = sun is not None and sun.visible
    if kept is not None and kept.fitted is not None:
        fitted = kept.fitted
    else:
        assumed = sun_angles or sun_stage.assume(working, sky, camera)
        fitted = fit_sky(working, sky, cover.opacity, camera, sun_angles, assumed)
        if hints.method("clouds") == "unmix":
            # The colour of the clear sky tells the clouds, and without them it is known better.
            opacity = cloud_stage.veil(working, sky, camera, fitted)
            fitted = fit_sky(working, sky, opacity, camera, fitted.sun, assumed)
    fitted, behind = behind_sun(working, sky, camera, fitted, visible=visible)
    if hints.method("clouds") == "unmix":
        opacity = cloud_stage.veil(working, sky, camera, fitted)
        # Round the sun whiteness tells nothing: continue the clouds from around it.
        glare = resize(behind.glare, working.width, working.height)
        filled = fill_by_pyramid(opacity[..., None], 1 - glare)[..., 0]
        cover = cloud_stage.Clouds(filled, cover.softness)

    scene = dataclasses.replace(
        base,
        sky=matte,
        clouds=resize(cover.opacity, *photo.size),
        cloud_softness=resize(cover.softness, *photo.size),
        sun=sun,
        horizon=horizon,
        camera=camera,
        atmosphere=fitted.atmosphere,
        assumed_sun=fitted.sun,
        fitted=fitted,
        response={
            "response_shoulder": fitted.response.shoulder,
            "response_contrast": fitted.response.contrast,
            "sky_gain": fitted.gain,
            "glare_profile": fitted.glare,
        },
        warnings=_warnings(photo, sky, sun, blot, horizon, camera, hints),
        hints=hints,
        timings=step.timings,
        backdrop=behind.field,
        glare=behind.glare,
        _corrected={},
    )

    step("depth", 0.9, "Estimating depth")
    depth = depth_stage.METHODS[hints.method("depth")](sky, camera.resized(*sky.shape[::-1]))
    # Interpolated as 1 / depth, which is finite in the sky and linear on the ground.
    nearness = resize(1 / depth, *photo.size)
    with np.errstate(divide="ignore"):
        depth = np.where(nearness < 0.5 / depth_stage.FAR, np.inf, 1 / nearness)
    step("water", 0.95, "Looking for water")
    water = water_stage.METHODS[hints.method("water")](working, sky, horizon.row / zoom_y)
    scene = dataclasses.replace(
        scene, depth=depth.astype(np.float32), water=resize(water, *photo.size)
    )
    step(None, 1.0, "Analysed")
    return scene


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


def _warnings(
    photo: Photo,
    sky: np.ndarray,
    sun: SunObservation | None,
    blot: sun_stage.Blot | None,
    horizon: Horizon,
    camera: Camera,
    hints: Hints,
) -> tuple[str, ...]:
    notes = []
    share = float(np.mean(sky > 0.5))
    if share < NO_SKY:
        notes.append(
            f"No sky found in {photo.name} ({100 * share:.1f} % of pixels). "
            "Draw a sky stroke or pass sky=mask."
        )
    if sun is None:
        notes.append(
            f"No sun found in {photo.name}. Its place is assumed; click where it is, "
            "or pass sun=(x, y) in pixels (outside the picture is fine)."
        )
    elif blot is not None and sun.visible:
        true = camera.focal * np.tan(np.radians(sun_stage.RADIUS_DEG))
        area = float(sun.mask.sum())
        if area > 0.02 * sun.mask.size and area > 60 * np.pi * true**2:
            notes.append(
                f"The sun's mask covers {100 * area / sun.mask.size:.0f} % of {photo.name}, "
                "far more than a sun. Click on its centre, or pass sun_method='disc_fit'."
            )
    if horizon.confidence < 0.3:
        notes.append(
            f"The horizon of {photo.name} is a guess (row {horizon.row:.0f}). "
            "Drag it, or pass horizon=row."
        )
    if hints.fov is None and photo.field_of_view.source == "assumed":
        notes.append(
            f"{photo.name} names no focal length: {camera.fov_vertical_deg:.0f}° vertical field "
            "of view is assumed. Pass fov= in degrees."
        )
    return tuple(notes)


def _weighted_mean(linear: np.ndarray, weight: np.ndarray) -> tuple[float, float, float]:
    total = max(float(weight.sum()), 1e-6)
    mean = np.einsum("hwc,hw->c", linear, weight) / total
    return (float(mean[0]), float(mean[1]), float(mean[2]))


def _check_method(stage: str, name: Any) -> None:
    methods = _REGISTRIES[stage]
    if not isinstance(name, str) or name not in methods:
        raise AnalysisError(
            f"{stage} knows no method {name!r:.80}; choose one of {', '.join(methods)}."
        )


def _check_point(name: str, value: Any) -> Point | None:
    if value is None:
        return None
    try:
        x, y = (float(v) for v in value)
    except (TypeError, ValueError) as error:
        raise AnalysisError(
            f"{name} must be a pair (x, y) of pixels, not {value!r:.80}."
        ) from error
    if not (np.isfinite(x) and np.isfinite(y)):
        raise AnalysisError(f"{name} must be finite pixels, not {value!r:.80}.")
    return x, y


def _check_horizon(value: Any) -> float | tuple[Point, Point] | None:
    if value is None:
        return None
    if np.ndim(value) == 0:
        try:
            row = float(value)
        except (TypeError, ValueError):
            row = np.nan
        if not np.isfinite(row):
            raise AnalysisError(
                f"horizon must be a row in pixels or two points, not {value!r:.80}."
            )
        return row
    if len(value) != 2:
        raise AnalysisError(f"horizon must be a row in pixels or two points, not {value!r:.80}.")
    first, second = _check_point("horizon", value[0]), _check_point("horizon", value[1])
    assert first is not None
    assert second is not None
    if first[0] == second[0]:
        raise AnalysisError(f"The horizon needs two points with different x, not {value!r:.80}.")
    return first, second


def _check_fov(value: Any) -> float | None:
    if value is None:
        return None
    try:
        degrees = float(value)
    except (TypeError, ValueError):
        degrees = np.nan
    if not 5 <= degrees <= 150:
        raise AnalysisError(f"fov must be 5 to 150 degrees (vertical), not {value!r:.80}.")
    return degrees
