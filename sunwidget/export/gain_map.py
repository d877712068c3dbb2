"""The gain map of a rendered scene: from the picture as it is saved to its light above white."""

from __future__ import annotations

import dataclasses
import io
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.edit.table import Edit
from sunwidget.export.formats import jpeg
from sunwidget.export.lost import warn_lost
from sunwidget.export.still import Still
from sunwidget.formats.color import LUMINANCE, ColorProfile
from sunwidget.formats.gain_map import GainMap, packed
from sunwidget.progress import Progress

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

Strips = Iterable[tuple[slice, NDArray[Any], NDArray[Any]]]

_OFFSET = 1 / 1024  # of light: keeps black out of the logarithm, and the map's steps small there
_NOTHING = 0.01  # stops: no eye sees less
_DARKEST = -1.0  # stops: a colour that is less pale when brighter has less of some channel
_EXACT, _PLAIN = 98, 95  # JPEG qualities of a map


def gain_map_of(
    scene: Scene, edit: Edit, still: Still, headroom: float, progress: Progress | None = None
) -> GainMap | None:
    """Draw a scene with and without light above white; return the map between the two.

    Parameters
    ----------
    scene, edit
        What was drawn.
    still : Still
        How it was, with the quality that it will have. At 100 the map also takes back what JPEG
        has rounded of its luminance.
    headroom : float
        Stops above white.
    progress : callable, optional
        Called from 0.5 to 1.

    Returns
    -------
    GainMap or None
        None, with a PhotoWarning, when nothing is brighter than white.
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
        warn_lost("Nothing in this picture is brighter than white, so it has no gain map.")
    return found


def map_between(
    strips: Strips, size: tuple[int, int], profile: ColorProfile, read: NDArray[Any] | None = None
) -> GainMap | None:
    """Return the map that leads from one picture to a brighter one.

    Parameters
    ----------
    strips : iterable of (rows, light, brighter)
        Rows of the picture and (h, W, 3) floats of each, linear Rec. 709, 1 = white.
    size : (width, height)
        Of the picture and of the map.
    profile : ColorProfile
        The picture's: its linear colours are multiplied.
    read : (H, W, 3) uint8 array, optional
        Code values that readers get of the first picture. With them the luminance of what they
        show is right; without, what is alike in both pictures stays, and the map is small.

    Returns
    -------
    GainMap or None
        Eight bits for all between its darkest and its brightest stop, one level of them no change
        at all; None when nothing is brighter than white by a hundredth of a stop.
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
    if brightest < 2**_NOTHING:
        return None
    high = float(stops.max())
    low = min(max(float(stops.min()), _DARKEST), 0.0)
    # So that no change is a level of its own.
    level = int(np.ceil(255 * -low / (high - low)))
    low = -high * level / (255 - level)
    levels = np.empty(stops.shape, np.uint8)
    for row, values in enumerate(stops):
        share = (values.astype(np.float32) - low) / (high - low)
        levels[row] = np.rint(255 * np.clip(share, 0, 1))
    told = GainMap(
        b"",
        (low,) * 3,
        (high,) * 3,
        base_offset=(_OFFSET,) * 3,
        other_offset=(_OFFSET,) * 3,
        headroom=high,
    )
    quality = _PLAIN if read is None else _EXACT
    return dataclasses.replace(told, jpeg=packed(levels, told, quality))


def _decoded(codes: NDArray[Any], profile: ColorProfile) -> NDArray[np.float32]:
    """Return the linear light of code values in the profile's own primaries."""
    return dataclasses.replace(profile, matrix=None).decode(codes)


def _as_read(still: Still) -> NDArray[np.uint8]:
    """Return the code values that readers of the JPEG get."""
    from PIL import Image

    bare = Still(still.codes, quality=still.quality)
    with Image.open(io.BytesIO(jpeg(bare)), formats=("JPEG",)) as image:
        return np.asarray(image)
