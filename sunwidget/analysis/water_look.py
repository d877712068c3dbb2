"""What tells water, pixel by pixel: its colour beside the mirrored sky's, and its streaks."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sunwidget.analysis.horizon import Horizon
from sunwidget.analysis.working import LUMINANCE, Working, resize, smoothstep

SIDE = 256  # px: waves average out, and a hundredth of a second is enough
_SHARES = (0.15, 0.5, 1.0)  # of the way up to the exact reflection
_PARTS = 6
_DARK = 0.004  # linear light that counts as noise


@dataclass(frozen=True, eq=False)
class Look:
    """A small copy of a photo, sheared so that its horizon is a row.

    Parameters
    ----------
    encoded : (h, w, 3) float32
        Gamma-encoded colours.
    land : (h, w) float32
        What is not sky, [0, 1].
    light : (h, w) float32
        Logarithm of luminance.
    tint : (h, w) float32
        How much bluer it is than the sky of its exact reflection: log(blue/red) over the sky's.
    earthiness : (h, w) float32
        log(red/blue) over that of any part of the sky that waves may mirror there.
    likeness : (h, w) float32
        How much a pixel looks like water, [0, 1].
    roughness : (h, w) float32
        Mean change of log luminance from pixel to pixel.
    streaks : (h, w) float32
        How much the texture runs along rows, or is none, [0, 1].
    row : float
        The horizon.
    shear : (2, 3) float32
        From the copy to the photo's own upright (``cv2.warpAffine`` without inversion).
    """

    encoded: np.ndarray
    land: np.ndarray
    light: np.ndarray
    tint: np.ndarray
    earthiness: np.ndarray
    likeness: np.ndarray
    roughness: np.ndarray
    streaks: np.ndarray
    row: float
    shear: np.ndarray

    @classmethod
    def of(cls, working: Working, sky: np.ndarray, horizon: Horizon) -> Look:
        """Look at a photo with a horizon in its pixels."""
        import cv2

        scale = min(1.0, SIDE / max(working.width, working.height))
        linear = np.asarray(resize(working.linear, working.width * scale, working.height * scale))
        height, width = linear.shape[:2]
        slope = math.tan(math.radians(horizon.roll))
        shear = np.array([[1, 0, 0], [slope, 1, slope * (0.5 - width / 2)]])
        matte = np.asarray(resize(sky, width, height), np.float32)
        linear, matte = (_sheared(image, shear) for image in (linear, matte))
        row = horizon.row * height / working.height
        log = np.log(linear + _DARK)
        light = np.log(linear @ LUMINANCE + _DARK)
        colour = np.stack([log[..., 0] - log[..., 1], log[..., 2] - log[..., 1]], axis=-1)
        colour = cv2.GaussianBlur(colour, (0, 0), 1.2)
        # Waves mirror what lies anywhere between the horizon and the exact reflection.
        depth = np.arange(height) + 0.5 - row
        own = np.dstack([colour, light])
        clear = (matte > 0.9) & (linear.max(axis=-1) < 0.97)
        mirrors = [_mirrored(own, clear.astype(np.float32), row, share) for share in _SHARES]
        blurred = cv2.GaussianBlur(own, (0, 0), 0.04 * width, sigmaY=0.02 * height)
        mirrors.append(blurred[_rows(row - np.maximum(depth, 0), height)])
        differences = [own - mirror for mirror in mirrors]
        streaks, roughness = _texture(light)
        like = np.max([_like_mirror(each) for each in differences], axis=0) * streaks
        yellow = np.min([each[..., 0] - each[..., 1] for each in differences], axis=0)
        tint = differences[_SHARES.index(1.0)][..., :2]
        below = (depth > 0)[:, None]
        return cls(
            encoded=np.sqrt(np.clip(linear, 0, 1)),
            land=1 - matte,
            light=light.astype(np.float32),
            tint=tint[..., 1] - tint[..., 0],
            earthiness=yellow.astype(np.float32),
            likeness=(like * (1 - matte) * below).astype(np.float32),
            roughness=roughness,
            streaks=streaks,
            row=row,
            shear=shear,
        )

    def unrolled(self, image: np.ndarray) -> np.ndarray:
        """Shear a map (h, w) of the copy back to the photo's own upright."""
        import cv2

        size = image.shape[1], image.shape[0]
        return np.asarray(cv2.warpAffine(image, self.shear, size, borderMode=cv2.BORDER_REPLICATE))

    def edge_strength(self, columns: np.ndarray) -> float:
        """How straight and alike the change of colour across the horizon is, [0, 1].

        The mean over ``columns`` (w,) bool of the change as vectors shorter than 1, in the row
        where it is greatest (as ``straight_edges`` does for all rows); in parts of the width each
        for itself, as glints are brighter than the sky and the rest of the sea is darker.
        """
        import cv2

        height, width = self.land.shape
        row = int(np.clip(round(self.row), 3, height - 4))
        first = max(row - int(0.02 * height) - 1, 1)
        last = min(row + int(0.03 * height) + 2, height - 1)
        reach = max(2, round(0.012 * height))
        kernel = np.repeat([-1.0, 1.0], reach)[:, None].astype(np.float32) / reach
        change = cv2.filter2D(self.encoded, cv2.CV_32F, kernel, anchor=(0, reach))
        change = cv2.blur(change, (max(1, width // 60), 1))
        change /= np.linalg.norm(change, axis=-1, keepdims=True) + 0.05
        parts = np.array_split(np.flatnonzero(columns), _PARTS)
        means = [change[first:last, part].mean(axis=1) for part in parts if part.size]
        lengths = [np.linalg.norm(mean, axis=-1) for mean in means]
        return float(np.mean(lengths, axis=0).max())

    def redness_of_sky(self) -> float:
        """log(red/blue) of the sky over the horizon; 0 without any."""
        height = self.land.shape[0]
        row = int(np.clip(round(self.row), 1, height))
        band = slice(max(row - int(0.2 * height) - 1, 0), row)
        sky = self.encoded[band][self.land[band] < 0.1]
        if not sky.size:
            return 0.0
        red, _, blue = np.square(sky).mean(axis=0)
        return float(np.log((red + _DARK) / (blue + _DARK)))

    @cached_property
    def glint_columns(self) -> np.ndarray:
        """How far each column under the horizon is brighter than others, in log luminance: (w,)."""
        import cv2

        height, width = self.land.shape
        row = int(np.clip(round(self.row), 0, height - 2))
        band = self.light[row + 1 : row + 2 + int(0.2 * height)]
        excess = np.mean(band - np.median(band, axis=1, keepdims=True), axis=0)
        return np.asarray(cv2.blur(excess[None], (max(1, width // 30), 1))[0])

    def glints(self) -> float:
        """How much the land under the horizon looks like water with the sun in it, [0, 1].

        A narrow upright band, as bright as the sky, in the fifth of the picture below the horizon.
        """
        import cv2

        height, width = self.land.shape
        row = int(np.clip(round(self.row), 0, height - 2))
        band = self.light[row + 1 : row + 2 + int(0.2 * height)]
        level = float(np.max(cv2.blur(np.exp(band), (max(1, width // 60), 3))))
        excess = self.glint_columns
        narrow = float(np.mean(excess > 0.5 * excess.max())) < 0.3
        return float(smoothstep(0.4, 1.0, excess.max()) * smoothstep(0.4, 0.7, level)) * narrow


def _sheared(image: np.ndarray, shear: np.ndarray) -> np.ndarray:
    import cv2

    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    size = image.shape[1], image.shape[0]
    return np.asarray(
        cv2.warpAffine(image, shear, size, flags=flags, borderMode=cv2.BORDER_REPLICATE)
    )


def _rows(rows: np.ndarray, height: int) -> np.ndarray:
    return np.clip(np.round(rows - 0.5).astype(int), 0, height - 1)


def _mirrored(values: np.ndarray, sky: np.ndarray, row: float, share: float) -> np.ndarray:
    """Mean sky (h, 1, c) of the rows that mirror each row at the horizon.

    ``share`` of the way up from the horizon to the exact reflection; smooth, and continued where
    a row shows no sky.
    """
    import cv2

    height = len(values)
    sums = np.column_stack([np.einsum("hwc,hw->hc", values, sky), sky.sum(axis=1)])
    sums = cv2.GaussianBlur(sums[:, None].astype(np.float32), (0, 0), 0.1, sigmaY=0.03 * height)
    sums = sums.reshape(height, -1)
    known = np.flatnonzero(sums[:, -1] > 0.01 * values.shape[1])
    if not known.size:
        return np.asarray(values.mean(axis=(0, 1), keepdims=True))
    means = sums[known, :-1] / sums[known, -1:]
    at = row - share * np.maximum(np.arange(height) + 0.5 - row, 0)
    return np.stack([np.interp(at - 0.5, known, column) for column in means.T], axis=-1)[:, None]


def _like_mirror(difference: np.ndarray) -> np.ndarray:
    """How much a colour may be the mirrored sky's, dimmed by Fresnel and with water's own light.

    ``difference`` (h, w, 3): log(red/green), log(blue/green) and log luminance over the sky's.
    Blue and green of the depths are welcome; red, yellow and grass are not.
    """
    red, blue, light = np.moveaxis(difference, -1, 0)
    colour = 1 - smoothstep(0.3, 0.6, red)
    colour = colour * smoothstep(-0.75, -0.4, blue) * (1 - smoothstep(0.9, 1.5, blue))
    return colour * smoothstep(-3.6, -2.8, light) * (1 - smoothstep(0.5, 1.0, light))


def _texture(light: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How much the picture runs along rows, and how rough it is, both (h, w).

    Waves are foreshortened, grass and trees stand up. From the structure tensor of log luminance
    (Bigün & Granlund 1987); where it is nearly flat, as in a calm or a long exposure, anything
    counts as streaked.
    """
    import cv2

    soft = cv2.GaussianBlur(light, (0, 0), 0.7)
    across = np.clip(cv2.Sobel(soft, cv2.CV_32F, 1, 0, scale=1 / 8), -0.3, 0.3)
    down = np.clip(cv2.Sobel(soft, cv2.CV_32F, 0, 1, scale=1 / 8), -0.3, 0.3)
    across, down = (cv2.GaussianBlur(g * g, (0, 0), 5, sigmaY=3) for g in (across, down))
    lying = (down - across) / (down + across + 4e-5)
    upright = np.sqrt(across)
    calm = 1 - smoothstep(0.06, 0.12, upright)
    waves = smoothstep(0.1, 0.4, lying) * (1 - smoothstep(0.12, 0.25, upright))
    return np.maximum(calm, waves) * smoothstep(-0.2, 0.15, lying), np.sqrt(across + down)
