"""The gain map of a rendered scene, from the saved picture to its light above white."""

from __future__ import annotations

import dataclasses
import io
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.edit.table import Edit
from sunwidget.export.dropped import warn_dropped
from sunwidget.export.formats import jpeg
from sunwidget.export.still import Still
from sunwidget.formats.color import LUMINANCE, ColorProfile
from sunwidget.formats.gain_map import GainMap, packed
from sunwidget.progress import Progress

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

Strips = Iterable[tuple[slice, NDArray[Any], NDArray[Any]]]

_OFFSET = 1 / 1024  # linear light: keeps the logarithm finite, and the map's steps small, at black
_INVISIBLE = 0.01  # stops: the eye sees no smaller difference
_DARKEST = -1.0  # stops: a color that gains saturation as it brightens loses light in a channel
_QUALITY = 98  # of a map as JPEG: glints are a pixel small


def gain_map_of(
    scene: Scene, edit: Edit, still: Still, headroom: float, progress: Progress | None = None
) -> GainMap | None:
    """Draw a scene with and without light above white; return the gain map between the two.

    Parameters
    ----------
    scene, edit
        Scene and edit of the picture.
    still : Still
        The picture, with its JPEG quality. At 100 the map also corrects the rounding of the
        JPEG's luminance.
    headroom : float
        Stops above white.
    progress : callable, optional
        Called from 0.5 to 1.

    Returns
    -------
    GainMap or None
        None, with a PhotoWarning, when no pixel is brighter than white.
    """
    from sunwidget.renderer.offscreen import strips_of

    height, width = still.codes.shape[:2]
    plain = strips_of(scene, edit, "float32", (width, height))
    brighter = strips_of(scene, edit, "float32", (width, height), headroom=headroom)

    def both() -> Strips:
        for (rows, light), (_, above) in zip(plain, brighter, strict=True):
            yield rows, light, above
            if progress is not None:
                progress(0.5 + 0.5 * rows.stop / height, "rendering light above white")

    read = _as_read(still) if still.quality == 100 else None
    found = map_between(both(), (width, height), scene.photo.profile, read)
    if found is None:
        warn_dropped("No pixel of this picture is brighter than white, so it has no gain map.")
    return found


def map_between(
    strips: Strips, size: tuple[int, int], profile: ColorProfile, read: NDArray[Any] | None = None
) -> GainMap | None:
    """Return the gain map from one picture to a brighter one.

    Parameters
    ----------
    strips : iterable of (rows, light, brighter)
        Rows of the picture and (h, W, 3) floats of each, linear Rec. 709, 1 = white.
    size : (width, height)
        Size of the picture and of the map.
    profile : ColorProfile
        The picture's profile; the gain multiplies its linear colors.
    read : (H, W, 3) uint8 array, optional
        Code values that readers decode from the first picture. With them the displayed luminance
        is exact. Without them, pixels that agree in both pictures have no gain, and the map is
        small.

    Returns
    -------
    GainMap or None
        Eight bits span the darkest to the brightest stop; one level is exactly no change. None
        when no pixel is brighter than white by a hundredth of a stop.
    """
    width, height = size
    stops = np.empty((height, width, 3), np.float16)
    luminance = LUMINANCE if profile.matrix is None else LUMINANCE @ profile.matrix
    offset = np.float32(_OFFSET)
    brightest = 0.0
    for rows, light, brighter in strips:
        base = np.clip(profile.linear(light), 0, 1) + offset
        other = np.maximum(profile.linear(brighter), 0) + offset
        gain = np.log2(other / base)
        brightest = max(brightest, float(other.max()))
        if read is not None:
            shown = (_decoded(read[rows], profile) + offset) * np.exp2(gain)
            wanted = other @ luminance
            gain += np.log2(wanted / np.maximum(shown @ luminance, offset / 8))[..., None]
        stops[rows] = gain
    if brightest < 2**_INVISIBLE:
        return None
    high = float(stops.max())
    low = min(max(float(stops.min()), _DARKEST), 0.0)
    # Align the range so that "no change" falls on a level.
    level = int(np.ceil(255 * -low / (high - low)))
    low = -high * level / (255 - level)
    levels = np.empty(stops.shape, np.uint8)
    for row, values in enumerate(stops):
        share = (values.astype(np.float32) - low) / (high - low)
        levels[row] = np.rint(255 * np.clip(share, 0, 1))
    gain_map = GainMap(
        b"",
        (low,) * 3,
        (high,) * 3,
        base_offset=(_OFFSET,) * 3,
        other_offset=(_OFFSET,) * 3,
        headroom=high,
    )
    return dataclasses.replace(gain_map, jpeg=packed(levels, gain_map, _QUALITY))


def _decoded(codes: NDArray[Any], profile: ColorProfile) -> NDArray[np.float32]:
    """Return the linear light of code values in the profile's own primaries."""
    return dataclasses.replace(profile, matrix=None).decode(codes)


def _as_read(still: Still) -> NDArray[np.uint8]:
    """Return the code values that readers decode from the JPEG."""
    from PIL import Image

    bare = Still(still.codes, quality=still.quality)
    with Image.open(io.BytesIO(jpeg(bare)), formats=("JPEG",)) as image:
        return np.asarray(image)
