"""Analyze a photo into its Scene: ``sunwidget.analyze``."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any

from sunwidget.analysis.depth import depth as depth_stage
from sunwidget.analysis.hints import (
    Hints,
    check_fov,
    check_horizon,
    check_strokes,
    check_sun,
)
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.land import look_at_land
from sunwidget.analysis.pipeline import METHODS, Steps, check_method, complete
from sunwidget.analysis.scene import Scene, Segmentation
from sunwidget.analysis.segmentation import coarse_sky
from sunwidget.analysis.strokes.apply import apply_strokes
from sunwidget.edit.table import Stroke, SunHint
from sunwidget.errors import AnalysisError
from sunwidget.geometry.camera import Point
from sunwidget.photo.photo import open_photo
from sunwidget.progress import Progress


def analyze(
    photo: Any,
    *,
    sun: SunHint | None = None,
    horizon: float | tuple[Point, Point] | None = None,
    fov: float | None = None,
    sky: Any = None,
    sky_label: int | str | None = None,
    refine: str = "grabcut_mask",
    clouds: str = "unmix",
    horizon_method: str = "water_line",
    sun_method: str = "disc_fit",
    depth: Any = None,
    water: Any = "network",
    strokes: tuple[Stroke, ...] = (),
    progress: Progress | None = None,
) -> Scene:
    """Find sky, sun, clouds, horizon, camera, depth and water in a photo.

    Parameters
    ----------
    photo : Photo or anything that ``sunwidget.open`` takes
    sun : (x, y) or "outside", optional
        Position of the photo's own sun in pixels; it may lie outside the picture. "outside": the
        sun is not in the picture and its position is unknown. Default: ``Photo.sun`` if known,
        else detected.
    horizon : float or ((x0, y0), (x1, y1)), optional
        Row of the horizon at the picture's center, or two points of the horizon, in pixels.
    fov : float, optional
        Vertical field of view in degrees.
    sky : array, path, SkyNetwork or str, optional
        A mask, an ONNX network or its path, or a name of ``sky.METHODS``. Default: the bundled
        network.
    sky_label : int or str, optional
        The class "sky" of an ONNX network: index from 0, or name (``SkyNetwork.label``).
    refine, clouds, horizon_method, sun_method : str
        Name in the stage's ``METHODS``.
    depth : str, path, DepthNetwork, DepthMap or array, optional
        Name in ``depth.METHODS``; an ONNX network for depth from one picture, or its path; or
        metres along the optical axis (H, W), inf for the sky. Default: the phone's depth in the
        photo's file (``Photo.depth``), else "network".
    water : str or array
        Name in ``water.METHODS``, or a map (H, W), 1 = water.
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
        If a hint or method cannot be used, or a network is missing.
    PhotoError
        If the photo cannot be opened.
    """
    photo = open_photo(photo)
    sun = photo.sun if sun is None else sun
    if depth is None:
        depth = "network" if photo.depth is None else photo.depth
    methods = {
        "refine": refine,
        "clouds": clouds,
        "horizon": horizon_method,
        "sun": sun_method,
        "depth": depth if isinstance(depth, str) and depth in METHODS["depth"] else "network",
        "water": water if isinstance(water, str) else "none",
    }
    for stage, name in methods.items():
        check_method(stage, name)
    strokes = check_strokes(strokes)
    if progress is not None and not callable(progress):
        raise AnalysisError(f"progress must be a function, not {progress!r:.80}.")
    hints = Hints(
        check_sun(sun),
        check_horizon(horizon),
        check_fov(fov),
        methods=tuple(methods.items()),
        water=None if isinstance(water, str) else coarse_sky.mask_from(water, photo.size, "water"),
        depth=depth_stage.check_depth(depth, photo.size),
    )
    step = Steps(progress)
    step("prepare", 0.0, "Preparing the photo")
    working = Working.of(photo)
    step("sky", 0.1, "Finding the sky")
    with ThreadPoolExecutor(1) as beside:
        beside.submit(look_at_land, working)  # cached; later stages use it and raise its errors
        coarse = coarse_sky.coarse(working, sky, photo.size, sky_label)
        step("refine", 0.4, "Following the skyline")
        decision = METHODS["refine"][refine](working, coarse)
    segmentation = Segmentation(photo, working, coarse, decision)
    return apply_strokes(complete(segmentation, hints, step), strokes)
