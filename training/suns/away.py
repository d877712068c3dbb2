"""Photos seen again by a camera that turned away from their labelled sun, which is then known.

A turn is a rotation of the picture, so that angles stay exact.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np

from sunwidget.analysis.fit.fit import view_angles
from sunwidget.analysis.horizon import horizon as horizon_stage
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.segmentation import coarse_sky
from sunwidget.geometry.camera import Camera
from sunwidget.geometry.place import wrap_angle
from sunwidget.photo.photo import open_photo
from training.suns.labels import Photo

Direction = tuple[float, float]
SIDE = 512
MARGIN = 0.06  # of the view's width between its edge and the sun
LEAST_SKY = 0.05


class Case(NamedTuple):
    """A picture without its sun, and what is known of it."""

    name: str
    picture: np.ndarray
    camera: Camera
    sun: Direction


def turned_away(
    name: str, picture: np.ndarray, sky: np.ndarray, camera: Camera, sun: Direction
) -> Case | None:
    """Return what a camera sees that turned until the sun left its picture; one of many at random.

    ``sky`` is the sky of ``picture``, of which the view must hold a little.
    """
    seed = int.from_bytes(hashlib.sha256(name.encode()).digest()[:4], "big")
    random = np.random.default_rng(seed)
    best = None
    for _ in range(400):
        share, aspect = random.uniform(0.4, 0.8), random.choice([0.75, 1.0, 1.4])
        x, y = random.uniform(0, camera.width), random.uniform(0, camera.height)
        heading, pitch = camera.angles(x, y)
        height = round(share * camera.height)
        field = 2 * np.degrees(np.arctan(height / 2 / camera.focal))
        view = Camera(max(32, round(height * aspect)), height, field, pitch)
        turned = wrap_angle(sun[0] - heading), sun[1]
        at = np.array(view.pixel(*turned)) / (view.width, view.height)
        border = MARGIN * np.array([1, view.width / view.height])
        if np.all((at > -border) & (at < 1 + border)):
            continue
        azimuth, elevation = view_angles(view, view.width, view.height)
        columns, rows = camera.pixel(azimuth + heading, elevation)
        edge = columns[[0, 0, -1, -1], [0, -1, 0, -1]], rows[[0, 0, -1, -1], [0, -1, 0, -1]]
        if not all(
            np.all((part >= 0.5) & (part <= limit - 0.5))
            for part, limit in zip(edge, (camera.width, camera.height), strict=True)
        ):
            continue
        maps = (columns - 0.5).astype(np.float32), (rows - 0.5).astype(np.float32)
        held = float(cv2.remap(sky, *maps, cv2.INTER_LINEAR).mean())
        if held < LEAST_SKY or (best is not None and view.width * height <= best[0]):
            continue
        seen = cv2.remap(picture, *maps, cv2.INTER_CUBIC)
        best = view.width * height, Case(name, seen, view, turned)
        if best[0] > 0.35 * camera.width * camera.height:
            break
    return best and best[1]


def read(path: Path) -> np.ndarray:
    """Return a picture of at most ``SIDE`` pixels, RGB."""
    picture = cv2.cvtColor(cv2.imread(str(path)), cv2.COLOR_BGR2RGB)
    scale = min(1.0, SIDE / max(picture.shape))
    return cv2.resize(picture, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)


def without_suns(folder: Path, known: Iterable[Photo], views: int = 1) -> Iterator[Case]:
    """Yield up to so many views of each photo without its sun; ``folder`` holds their folders.

    The field of view is the assumed one, the horizon the whole photo's.
    """
    for photo in known:
        part, name = photo.file.split("/")
        path = folder / part / "images" / name
        if not path.exists():
            continue
        picture = read(path)
        height, width = picture.shape[:2]
        opened = open_photo(picture)
        working = Working.of(opened)
        sky = resize(coarse_sky.coarse(working), width, height)
        horizon = horizon_stage.water_line(sky, working.encoded)
        camera = Camera.from_horizon(
            width, height, opened.field_of_view.vertical, horizon.row, horizon.roll
        )
        sun = camera.angles(photo.x * width, photo.y * height)
        if sun[1] < -1:
            continue  # the horizon is wrong
        for number in range(views):
            name = photo.file + (f"#{number}" if number else "")
            case = turned_away(name, picture, sky.astype(np.float32), camera, sun)
            if case is not None:
                yield case
