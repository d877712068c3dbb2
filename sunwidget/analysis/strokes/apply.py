"""Strokes on an analyzed scene: only the areas that they touch are computed again.

The scene without strokes (the *base*) is kept. Matte and clouds are computed again in square tiles
of the working copy where the strokes changed the decision. A tile depends only on the base and on
the decision in and just around it, so tiles of an earlier stroke can be copied: the maps are the
same to the bit for any order of computation.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from sunwidget.analysis.backdrop.backdrop import behind_sun
from sunwidget.analysis.clouds import clouds as cloud_stage
from sunwidget.analysis.images.enlarge import Box, enlarged_part, pixels_of, resize_rows
from sunwidget.analysis.images.working_copy import resize
from sunwidget.analysis.memory import Memory
from sunwidget.analysis.notices import notices
from sunwidget.analysis.pipeline import Steps, complete
from sunwidget.analysis.segmentation.matting import (
    EPSILON,
    RADIUS,
    guided_coefficients,
    on_lines,
    stretched,
)
from sunwidget.analysis.segmentation.refine import MINIMUM_SIDE, Decision
from sunwidget.analysis.strokes.brush import set_strokes
from sunwidget.analysis.strokes.sky import Painting
from sunwidget.analysis.strokes.water import LABELS as WATER
from sunwidget.analysis.strokes.water import with_water
from sunwidget.progress import Progress

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.edit.table import Stroke

SIDE = 128  # working pixels of a tile
# Around a tile: the guided filters read two radii, interpolation one pixel.
MARGIN = 2 * max(RADIUS, cloud_stage.LARGEST_RADIUS) + 4


class _Tile(NamedTuple):
    """A tile in working pixels, without and with its margin, and in pixels of the photo."""

    inner: Box
    outer: Box
    full: Box


def apply_strokes(
    base: Scene, strokes: tuple[Stroke, ...], progress: Progress | None = None
) -> Scene:
    """Return the base scene with ``strokes`` applied; the same object without strokes."""
    of_sky = tuple(stroke for stroke in strokes if stroke.label not in WATER)
    scene = base if not of_sky else base.memory.scene(of_sky, lambda: _draw(base, of_sky, progress))
    if of_sky == strokes:
        return scene
    return base.memory.scene(strokes, lambda: with_water(base, scene, strokes))


def _draw(base: Scene, strokes: tuple[Stroke, ...], progress: Progress | None) -> Scene:
    step = Steps(progress)
    step("strokes", 0.1, "Following the strokes")
    painting = _painting(base, strokes, step)
    if painting.fits < len(strokes):
        source = apply_strokes(base, strokes[: painting.fits], progress)
        return _retouch(base, source, painting, strokes, base.memory.scenes.get(strokes[:-1]), step)
    decision = painting.on(base.shown)
    hints = dataclasses.replace(base.hints, strokes=strokes)
    scene = complete(base.segmentation, hints, step, _matte_after(base, decision, strokes))
    return dataclasses.replace(scene, decision=decision, unstroked=base)


def _painting(base: Scene, strokes: tuple[Stroke, ...], step: Steps) -> Painting:
    """Replay strokes on the small copy, starting from the longest cached painting."""
    memory = base.memory
    count = len(strokes)
    while count and strokes[:count] not in memory.paintings:
        count -= 1
    painting = memory.paintings.get(strokes[:count]) or Painting.begin(
        base.sky, base.working, base.coarse_map
    )
    for stroke in strokes[count:]:
        count += 1
        painting = painting.stroke(stroke, base.working)
        memory.painting(strokes[:count], painting)
        step.within(0.1 + 0.4 * count / len(strokes))
    return painting


def _retouch(
    base: Scene,
    source: Scene,
    painting: Painting,
    strokes: tuple[Stroke, ...],
    previous: Scene | None,
    step: Steps,
) -> Scene:
    """Return the scene after strokes.

    Parameters
    ----------
    base : Scene
        The scene without strokes.
    source : Scene
        The scene whose camera, sun and fit are kept: ``base``, or the scene after the stroke that
        caused a new fit.
    painting : Painting
        The base's sky after ``strokes``.
    strokes : tuple of Stroke
        All strokes on the base.
    previous : Scene, optional
        The scene after all strokes except the last, if cached; it only saves time.
    step : Steps
        Reports progress.
    """
    photo, working = base.photo, base.working
    step("matte", 0.5, "Cutting out the sky")
    decision = painting.on(base.shown)
    matte = _matte_after(base, decision, strokes, previous)
    sky = resize(matte, working.width, working.height)

    step("clouds", 0.7, "Finding clouds")
    same = previous is not None and previous.fitted is source.fitted
    maps = _clouds_after(source, matte, previous if same else None)

    step("fit", 0.8, "Looking behind the sun")
    sun, fitted = source.sun, source.fitted
    assert fitted is not None
    behind = behind_sun(working, source.without_sun, sky, source.camera, fitted)

    hints = dataclasses.replace(source.hints, strokes=strokes)
    scene = dataclasses.replace(
        source,
        sky=matte,
        cloud_map=maps[0],
        softness_map=maps[1],
        shade=maps[2],
        water_map=_water_after(source, matte),
        backdrop=behind.field,
        glare=behind.glare,
        decision=decision,
        hints=hints,
        warnings=notices(
            photo, sky, sun, source.horizon, source.camera, hints, source.moon, fitted
        ),
        unstroked=base,
        memory=Memory(),
    )
    step(None, 1.0, "Analysed")
    return dataclasses.replace(scene, timings=step.timings)


def _matte_after(
    base: Scene, decision: Decision, strokes: tuple[Stroke, ...], previous: Scene | None = None
) -> np.ndarray:
    """Return the matte (H, W) float32: the base's, except near a changed decision."""
    import cv2

    working, before = base.working, base.shown
    matte: np.ndarray = np.array(base.sky if previous is None else previous.sky)
    if min(working.width, working.height) >= MINIMUM_SIDE:
        reach = 2 * RADIUS + 1
        changed = _differ(decision, before).astype(np.uint8)
        near = cv2.dilate(changed, np.ones((2 * reach + 1, 2 * reach + 1), np.uint8)) > 0
        fresh = _differ(decision, before if previous is None else previous.decision)
        for tile in _tiles(base, fresh):
            matte[tile.full] = _matte_of(base, decision, near, tile)
    elif not np.array_equal(decision.sky, before.sky):
        matte = resize(decision.sky, *base.photo.size).astype(np.float32)
    set_strokes(matte, strokes)
    return matte


def _differ(a: Decision, b: Decision) -> np.ndarray:
    return np.asarray((a.sky != b.sky) | (a.confidence != b.confidence))


def _tiles(scene: Scene, fresh: np.ndarray) -> Iterator[_Tile]:
    """Yield the tiles in or near which the map ``fresh`` (h, w) at working size is true."""
    height, width = fresh.shape
    zoom_x, zoom_y = scene.working.zoom
    for top in range(0, height, SIDE):
        for left in range(0, width, SIDE):
            bottom, right = min(top + SIDE, height), min(left + SIDE, width)
            outer = (
                slice(max(top - MARGIN, 0), min(bottom + MARGIN, height)),
                slice(max(left - MARGIN, 0), min(right + MARGIN, width)),
            )
            if fresh[outer].any():
                yield _Tile(
                    (slice(top, bottom), slice(left, right)),
                    outer,
                    (pixels_of(top, bottom, zoom_y), pixels_of(left, right, zoom_x)),
                )


def _matte_of(base: Scene, decision: Decision, near: np.ndarray, tile: _Tile) -> np.ndarray:
    """Return the matte of a tile, in pixels of the photo."""
    guide = np.ascontiguousarray(base.working.guide[tile.outer])
    lines = guided_coefficients(
        guide,
        np.ascontiguousarray(decision.sky[tile.outer]),
        np.ascontiguousarray(decision.confidence[tile.outer]),
        RADIUS,
        EPSILON,
    )
    alpha = stretched(on_lines(_enlarged(base, np.dstack(lines), tile), base.photo, tile.full))
    here = _enlarged(base, near[tile.outer].astype(np.float32), tile) > 0
    return np.where(here, alpha, base.sky[tile.full])


def _enlarged(scene: Scene, small: np.ndarray, tile: _Tile) -> np.ndarray:
    """Interpolate a tile with margin, in working pixels, at the photo's pixels in the tile."""
    corner = tile.outer[0].start, tile.outer[1].start
    return enlarged_part(small, scene.working.zoom, tile.full, corner)


def _clouds_after(
    source: Scene, matte: np.ndarray, previous: Scene | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Return opacity and softness at the photo's size, and shade at working size.

    Where the sky shrinks, its clouds shrink too; where it grows, the source has the clouds that
    would be there if the land were sky.
    """
    start = source if previous is None else previous
    fresh = resize(np.abs(matte - start.sky), source.working.width, source.working.height) > 0
    everywhere = source.everywhere
    clouds = _writable(start.clouds, start.cloud_map)
    softness = _writable(start.cloud_softness, start.softness_map)
    size = source.photo.size
    shade = None if start.shade is None else start.shade.copy()
    for tile in _tiles(source, fresh):
        before, after = source.sky[tile.full], matte[tile.full]
        kept = np.where(before > 0, np.minimum(after / np.maximum(before, 1e-6), 1), 1)
        clouds[tile.full] = resize_rows(source.cloud_map, *size, *tile.full) * kept
        softness[tile.full] = resize_rows(source.softness_map, *size, *tile.full) * kept
        grown = np.maximum(after - before, 0)
        if everywhere is None or not grown.any():
            if shade is not None and source.shade is not None:
                shade[tile.inner] = source.shade[tile.inner]
            continue
        opacity = np.ascontiguousarray(everywhere.opacity[tile.outer])
        if source.fitted is not None and source.hints.method("clouds") == "unmix":
            encoded = np.ascontiguousarray(source.without_sun.working.encoded[tile.outer])
            reach = cloud_stage.smoothing_radius(source.working)
            opacity = np.clip(cloud_stage.smoothed(encoded, opacity, reach), 0, 1)
        clouds[tile.full] += _enlarged(source, opacity, tile) * grown
        soft = np.ascontiguousarray(everywhere.softness[tile.outer])
        softness[tile.full] += _enlarged(source, soft, tile) * grown
        if shade is not None and source.shade is not None:
            land = resize(source.sky[tile.full], *_size(tile.inner)) < 0.5
            shade[tile.inner] = np.where(
                land, everywhere.shade[tile.inner], source.shade[tile.inner]
            )
    return clouds, softness, shade


def _writable(image: np.ndarray, held: np.ndarray) -> np.ndarray:
    """Return a map that may be written to: a copy if the scene holds it."""
    return image.copy() if image is held else image


def _water_after(source: Scene, matte: np.ndarray) -> np.ndarray:
    """Return the water outside new sky; new land gets none."""
    if not source.water_map.any():
        return source.water_map
    if source.water_map.size <= source.small_sky.size:
        # No water where the sky was; the scene removes it from the new sky.
        return source.small_water
    water = source.water
    return np.where(matte > source.sky, np.minimum(water, 1 - matte), water)


def _size(box: Box) -> tuple[int, int]:
    return box[1].stop - box[1].start, box[0].stop - box[0].start
