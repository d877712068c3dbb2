"""What a training photo goes through: cropping, new skies, drawn things, light and camera.

Images are ``(S, S, 3)`` uint8 sRGB; targets ``(S, S)`` uint8, 255 = sky, soft at edges; validity
255 or 0; water 255, 0 or 128, which is unknown.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import cv2
import numpy as np

from training.buildings import street
from training.rooms import Rooms
from training.synthetic import draw_thin_things, gradient_sky, room

Random = np.random.Generator
Source = Callable[[], np.ndarray]
ROOMS, STREETS = 0.09, 0.10
"""Shares of the samples that are rooms and streets."""


@dataclass
class Sample:
    """One training example."""

    image: np.ndarray
    target: np.ndarray
    valid: np.ndarray
    water: np.ndarray


def crop(photo: np.ndarray, box: tuple[int, int, int, int], size: int) -> Sample:
    """The ``box`` (top, left, height, width) of an ``(H, W, 5)`` photo, squeezed to a square."""
    top, left, height, width = box
    part = np.ascontiguousarray(photo[top : top + height, left : left + width])
    shrinks = height * width > size * size
    rgb = cv2.resize(
        part[..., :3], (size, size), interpolation=cv2.INTER_AREA if shrinks else cv2.INTER_LINEAR
    )
    label = part[..., 3]
    known = cv2.resize(
        (label != 128).astype(np.uint8) * 255, (size, size), interpolation=cv2.INTER_AREA
    )
    sky = cv2.resize(
        (label > 191).astype(np.uint8) * 255, (size, size), interpolation=cv2.INTER_AREA
    )
    target = np.where(
        known == 255, sky, np.minimum(255.0 * sky / np.maximum(known, 1.0), 255)
    ).astype(np.uint8)
    valid = np.where(known > 150, 255, 0).astype(np.uint8)
    water = cv2.resize(part[..., 4], (size, size), interpolation=cv2.INTER_NEAREST)
    return Sample(rgb, target, valid, water)


def random_box(photo: np.ndarray, random: Random) -> tuple[int, int, int, int]:
    """The whole photo, a large part, or (rarely) a part that holds no sky at all."""
    height, width = photo.shape[:2]
    draw = random.random()
    if draw < 0.35:
        return 0, 0, height, width
    skyless = draw > 0.9
    for _ in range(8 if skyless else 1):
        area = random.uniform(0.12, 0.5) if skyless else random.uniform(0.25, 1.0)
        stretch = np.exp(random.uniform(-0.3, 0.3))
        h = int(np.clip(height * np.sqrt(area) * stretch, 48, height))
        w = int(np.clip(width * np.sqrt(area) / stretch, 48, width))
        top, left = int(random.integers(0, height - h + 1)), int(random.integers(0, width - w + 1))
        if skyless and (photo[top : top + h, left : left + w, 3] > 0).mean() < 0.005:
            break
    return top, left, h, w


def rotate(sample: Sample, random: Random) -> Sample:
    """A few degrees of roll, mirrored at the borders."""
    size = sample.image.shape[0]
    turn = cv2.getRotationMatrix2D(
        (size / 2, size / 2), random.normal(0, 5), random.uniform(1.0, 1.1)
    )

    def warp(map_: np.ndarray, interpolation: int) -> np.ndarray:
        return cv2.warpAffine(
            map_, turn, (size, size), flags=interpolation, borderMode=cv2.BORDER_REFLECT_101
        )

    return Sample(
        warp(sample.image, cv2.INTER_LINEAR),
        warp(sample.target, cv2.INTER_LINEAR),
        warp(sample.valid, cv2.INTER_NEAREST),
        warp(sample.water, cv2.INTER_NEAREST),
    )


def other_sky(size: int, random: Random, sky: Source, photo: Source) -> np.ndarray:
    """A sky for a foreground: all-sky photo, another photo's upper part, or a drawn one; uint8."""
    draw = random.random()
    if draw < 0.45:
        texture = sky()
    elif draw < 0.7:
        other = photo()
        rows = np.flatnonzero((other[..., 3] > 191).mean(1) > 0.97)
        count = len(rows) if len(rows) and rows[-1] == len(rows) - 1 else 0
        texture = other[:count, :, :3] if count > 40 else sky()
    else:
        return gradient_sky(size, random)
    height, width = texture.shape[:2]
    h = int(height * random.uniform(0.5, 1.0))
    top = int(random.integers(0, height - h + 1))
    texture = np.ascontiguousarray(texture[top : top + h])
    return cv2.resize(texture, (size, size), interpolation=cv2.INTER_AREA)


def replace_sky(sample: Sample, random: Random, sky: Source, photo: Source) -> Sample:
    """Another sky behind this foreground, whose light partly follows the new sky's colour."""
    image = sample.image.astype(np.float32)
    new = other_sky(image.shape[0], random, sky, photo).astype(np.float32)
    alpha = sample.target.astype(np.float32)[..., None] / 255.0
    old_mean = (image * alpha).sum((0, 1)) / max(alpha.sum(), 1.0)
    ratio = (new.mean((0, 1)) + 8.0) / (old_mean + 8.0)
    image *= np.clip(ratio, 0.15, 1.8) ** random.uniform(0.0, 1.0)
    mixed = np.clip(image * (1 - alpha) + new * alpha, 0, 255).astype(np.uint8)
    return replace(sample, image=mixed)


def relight(image: np.ndarray, target: np.ndarray, random: Random) -> np.ndarray:
    """Silhouette, night, haze, glow: light that the photos rarely show; float image in [0, 1]."""
    draw = random.random()
    alpha = target.astype(np.float32)[..., None] / 255.0 if draw < 0.17 else 0.0
    if draw < 0.08:  # back-light
        image = image * (alpha + (1 - alpha) * random.uniform(0.03, 0.35))
    elif draw < 0.17:  # night: everything dark and cool, some lamps below
        tint = np.array(
            [random.uniform(0.3, 1.0), random.uniform(0.4, 0.9), random.uniform(0.6, 1.2)],
            np.float32,
        )
        image = cv2.pow(image, random.uniform(1.0, 1.4)) * tint * random.uniform(0.2, 0.8)
        image = lamps(image * (alpha + (1 - alpha) * random.uniform(0.4, 1.3)), target, random)
    elif draw < 0.24:  # haze, thicker towards the horizon
        rows = np.linspace(0, 1, image.shape[0], dtype=np.float32)[:, None, None]
        thick = np.clip(
            random.uniform(0.3, 0.85) * (1 - np.abs(rows - random.uniform(0.3, 0.7))), 0, 1
        )
        veil = np.clip(random.uniform(0.45, 0.95) + random.normal(0, 0.06, 3), 0, 1).astype(
            np.float32
        )
        image = image * (1 - thick) + veil * thick
    elif draw < 0.27:  # snow under a deep sky
        white = random.uniform(0.7, 1.0) * np.array([0.97, 0.99, 1.0], np.float32)
        alpha = target.astype(np.float32)[..., None] / 255.0
        grey = image.mean(2, keepdims=True)
        plain = white * (1 - random.uniform(0.1, 0.5) * (1 - np.minimum(2 * grey, 1)))
        deep = image * np.array([0.35, 0.5, 0.8], np.float32) * random.uniform(0.5, 1.2)
        share = random.uniform(0.6, 1.0)
        image = alpha * deep + (1 - alpha) * (image + share * (plain - image))
    elif draw < 0.33:  # glow around a low sun
        down, across = (np.linspace(0, 1, side, dtype=np.float32) for side in image.shape[:2])
        distance = ((down - random.uniform(0.1, 0.7)) ** 2)[:, None] + (
            across - random.random()
        ) ** 2
        glow = np.exp(-distance / random.uniform(0.005, 0.12))[..., None] * random.uniform(0.3, 1.0)
        image = image + glow * np.array(
            [1.0, random.uniform(0.6, 1.0), random.uniform(0.3, 1.0)], np.float32
        )
    return image


def lamps(image: np.ndarray, target: np.ndarray, random: Random) -> np.ndarray:
    """Lit windows and street lamps with a glow, on the foreground only."""
    size = image.shape[0]
    rows, columns = np.nonzero(target < 20)
    if not len(rows):
        return image
    light = np.zeros_like(image)
    for i in random.integers(0, len(rows), int(random.integers(0, 60))):
        colour = np.array(
            [1.0, random.uniform(0.6, 1.0), random.uniform(0.2, 1.0)]
        ) * random.uniform(0.3, 1.0)
        r = int(random.integers(0, max(2, size // 64)))
        cv2.rectangle(
            light, (columns[i] - r, rows[i] - r), (columns[i] + r, rows[i] + r), colour.tolist(), -1
        )
    glow = cv2.GaussianBlur(light, (0, 0), size / 48)
    return image + light * (target < 128)[..., None] + glow


def photometric(image: np.ndarray, target: np.ndarray, random: Random) -> np.ndarray:
    """Exposure, gamma, contrast, white balance, saturation, blur, noise, JPEG; uint8 in and out."""
    x = relight(np.multiply(image, 1 / 255, dtype=np.float32), target, random)
    if random.random() < 0.8:
        saturation = random.uniform(0.4, 1.5)
        gain = 2.0 ** random.normal(-0.15, 0.5) * np.exp(random.normal(0, 0.12, (3, 1)))
        mix = (saturation * np.eye(3) + (1 - saturation) / 3) * gain
        x = cv2.transform(x, mix)
    out = np.clip(x * np.float32(255), 0, 255).astype(np.uint8)
    if random.random() < 0.8:
        tone = np.linspace(0, 1, 256) ** np.exp(random.normal(0, 0.25))
        tone = (tone - 0.5) * random.uniform(0.75, 1.25) + 0.5
        out = cv2.LUT(out, np.clip(tone * 255, 0, 255).astype(np.uint8))
    if random.random() < 0.06:
        out = cv2.transform(out, np.full((3, 3), 1 / 3))
    if random.random() < 0.12:
        out = cv2.GaussianBlur(out, (0, 0), random.uniform(0.4, 1.6))
    if random.random() < 0.25:
        noise = random.standard_normal(out.shape, np.float32) * np.float32(random.uniform(1, 15))
        out = np.clip(out + noise, 0, 255).astype(np.uint8)
    if random.random() < 0.25:
        _, data = cv2.imencode(
            ".jpg", out, [cv2.IMWRITE_JPEG_QUALITY, int(random.integers(25, 90))]
        )
        out = cv2.imdecode(data, cv2.IMREAD_COLOR)  # channel order survives the round trip
    return out


class Drawn:
    """Drawn pictures, ``(image, target)``, each used several times: drawing one is slow."""

    def __init__(self, draw: Callable[[], tuple[np.ndarray, np.ndarray]], uses: int = 4) -> None:
        self.draw, self.uses = draw, uses
        self.kept: list[tuple[np.ndarray, np.ndarray]] = []

    def take(self, random: Random) -> tuple[np.ndarray, np.ndarray]:
        """A new one or one of the last 32, mirrored by half."""
        if len(self.kept) < 2 or random.random() < 1 / self.uses:
            self.kept = [*self.kept[-31:], self.draw()]
        image, target = self.kept[int(random.integers(len(self.kept)))]
        return (image[:, ::-1], target[:, ::-1]) if random.random() < 0.5 else (image, target)


class Augment:
    """Turns photos ``(H, W, 5)`` uint8 into square training samples of one size.

    ``sky`` and ``photo`` return another photo's sky, and another photo.
    """

    def __init__(self, size: int, random: Random, sky: Source, photo: Source, rooms: Rooms) -> None:
        self.size, self.random, self.sky, self.photo, self.rooms = size, random, sky, photo, rooms
        dark = np.zeros((size, size), np.uint8)
        self.drawn_rooms = Drawn(lambda: (room(size, random, photo), dark))
        self.streets = Drawn(lambda: street(other_sky(size, random, sky, photo), random, photo))

    def __call__(self, photo: np.ndarray) -> Sample:
        """One sample: of this photo, or of a room or a street."""
        draw, random = self.random.random(), self.random
        if draw < ROOMS + STREETS:
            if draw > ROOMS:
                image, target = self.streets.take(random)
            elif self.rooms and random.random() < 0.75:
                image = self.rooms.view(self.size, random)
                target = np.zeros(image.shape[:2], np.uint8)
            else:
                image, target = self.drawn_rooms.take(random)
            image = photometric(np.ascontiguousarray(image), target, random)
            known = np.full_like(target, 255)
            return Sample(image, np.ascontiguousarray(target), known, np.zeros_like(target))
        sample = crop(photo, random_box(photo, random), self.size)
        if random.random() < 0.5:
            maps = sample.image, sample.target, sample.valid, sample.water
            sample = Sample(*(np.ascontiguousarray(m[:, ::-1]) for m in maps))
        if random.random() < 0.25:
            sample = rotate(sample, random)
        share = cv2.mean(sample.target)[0] / 255.0
        if share > 0.03 and random.random() < 0.25:
            sample = replace_sky(sample, random, self.sky, self.photo)
        if share > 0.1 and random.random() < 0.15:
            sample.image, sample.target = draw_thin_things(sample.image, sample.target, random)
        sample.image = photometric(sample.image, sample.target, random)
        return sample
