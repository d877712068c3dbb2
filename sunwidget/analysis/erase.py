"""The photo without its sun: the light behind disc, halo, veil and rays, by the network.

The network says by how much light is to fall, at low resolution (sun_network.py). Where that is
little, the photo's own detail stays and is darkened; where the glare hides the sky, what the
network sees behind it stands alone.
"""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.fill import fill_by_pyramid
from sunwidget.analysis.sun import SunObservation
from sunwidget.analysis.sun_network import LIGHT_FLOOR, SunMaps
from sunwidget.analysis.working import Working, encode, resize, smoothstep

_FELT = (0.03, 0.12)  # natural log of light: less glare is none, more is taken away in full
_HIDES = (0.3, 0.9)  # glare under which the photo keeps all of its detail, and none


class Erased(NamedTuple):
    """A photo's small copy without its sun.

    Parameters
    ----------
    working : Working
        The copy; the photo's own where it shows no sun.
    mark : (h, w) float32
        Weight with which it replaces the photo once the sun has moved, [0, 1].
    """

    working: Working
    mark: np.ndarray


def unerased(working: Working) -> Erased:
    """Return the copy of a photo that shows no sun."""
    return Erased(working, np.zeros((working.height, working.width), np.float32))


def erase(working: Working, maps: SunMaps, light: SunObservation) -> Erased:
    """Take the sun, its halo and its rays out of a photo's small copy.

    A moon, and a sun that only a person sees, the network leaves where it is: what is round it
    is continued across ``light``, its pixels.
    """
    import cv2

    size = working.width, working.height
    small = resize(working.linear, *maps.clean.shape[1::-1])
    # What little glare leaves is sure; across much of it the sky goes on from around.
    sure = 1 - smoothstep(*_HIDES, -maps.clean.min(-1)).astype(np.float32)
    behind = fill_by_pyramid(np.log(small + LIGHT_FLOOR) + maps.clean, sure)
    glare = cv2.resize(-maps.clean, size, interpolation=cv2.INTER_LINEAR)
    felt = glare.max(-1)
    mark = smoothstep(*_FELT, felt).astype(np.float32)
    alone = np.exp(cv2.resize(behind, size, interpolation=cv2.INTER_CUBIC)) - LIGHT_FLOOR
    darkened = (working.linear + LIGHT_FLOOR) * np.exp(-glare) - LIGHT_FLOOR
    # A rim is steeper than the network's map: it is left to what lies behind, too.
    near = cv2.dilate(felt, np.ones((3, 3), np.uint8), iterations=max(1, size[0] // 160))
    keep = (1 - smoothstep(*_HIDES, near))[..., None]
    clean = np.maximum(alone + keep * (darkened - alone), 0)
    linear = working.linear + mark[..., None] * (clean - working.linear)
    blot = resize(light.blot, *size)
    if float((blot * mark).sum()) < 0.5 * float(blot.sum()):
        cover = _round_about(blot)
        filled = fill_by_pyramid(np.log(linear + LIGHT_FLOOR), 1 - np.sqrt(cover))
        linear += cover[..., None] * (np.exp(filled) - LIGHT_FLOOR - linear)
        mark = np.maximum(mark, cover)
    linear = np.maximum(linear, 0).astype(np.float32)
    return Erased(dataclasses.replace(working, linear=linear, encoded=encode(linear)), mark)


def _round_about(blot: np.ndarray) -> np.ndarray:
    """Return a disc's pixels with its rim and glow, (h, w) float32 in [0, 1]."""
    import cv2

    radius = max(1.0, float(np.sqrt(blot.sum() / np.pi)))
    away = cv2.distanceTransform((blot < 0.5).astype(np.uint8), cv2.DIST_L2, 5)
    return np.asarray(1 - smoothstep(0.5 * radius + 1, 2 * radius + 3, away), np.float32)
