"""Everything the analysis found, as pictures and one JSON file a person can look at."""

from __future__ import annotations

import dataclasses
import json
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from PIL import Image

    from sunwidget.analysis.scene import Scene

MAPS = ("sky", "sky_coarse", "clouds", "cloud_softness")
FACTS = ("camera", "horizon", "sun", "atmosphere", "automatic", "warnings")


def save_maps(
    scene: Scene, folder: str | os.PathLike[str], *, overwrite: bool = False
) -> list[Path]:
    """Write every map of ``scene`` as an 8-bit PNG, an overview, and ``scene.json``.

    Parameters
    ----------
    scene : Scene
        What ``analyze`` returned.
    folder : path
        Made when missing. Gets ``sky.png``, ``sky_coarse.png``, ``clouds.png``,
        ``cloud_softness.png``, ``sun.png`` when a sun was found, ``overview.png`` (the
        photo with horizon, sun and matte drawn in) and ``scene.json``.
    overwrite : bool
        Replace existing files.

    Returns
    -------
    list of Path
        What was written, in that order.

    Raises
    ------
    FileExistsError
        When one of the files exists and ``overwrite`` is false; nothing is written then.
    """
    from PIL import Image

    folder = Path(folder)
    pictures = {name: getattr(scene, name) for name in MAPS}
    if scene.sun is not None and scene.sun.mask is not None:
        pictures["sun"] = scene.sun.mask
    images = {name: Image.fromarray(_levels(m)) for name, m in pictures.items()}
    images["overview"] = overview(scene)
    paths = [folder / f"{name}.png" for name in images] + [folder / "scene.json"]
    for path in paths:
        if path.exists() and not overwrite:
            raise FileExistsError(f"{path} exists already. Pass overwrite to replace it.")
    folder.mkdir(parents=True, exist_ok=True)
    for path, image in zip(paths, images.values(), strict=False):
        image.save(path)
    paths[-1].write_text(json.dumps(facts(scene), indent=2, allow_nan=False) + "\n", "utf-8")
    return paths


def facts(scene: Scene) -> dict[str, Any]:
    """Return what the analysis found besides maps, as plain JSON types."""
    return {name: _plain(getattr(scene, name)) for name in FACTS}


def overview(scene: Scene) -> Image.Image:
    """Return the photo, at most 1536 pixels a side, with the findings drawn in.

    The sky's matte is tinted blue, the horizon is a red line, the sun a yellow ring.
    """
    from PIL import Image, ImageDraw

    photo = scene.photo.preview(long_edge=1536)
    height, width = photo.shape[:2]
    scale = width / scene.camera.width
    sky = Image.fromarray(_levels(scene.sky)).resize((width, height))
    weight = np.asarray(sky, np.float32)[..., None] / 255 * 0.35
    tinted = photo * (1 - weight) + np.array([40, 110, 255], np.float32) * weight
    image = Image.fromarray(tinted.astype(np.uint8))
    draw = ImageDraw.Draw(image)
    stroke = max(2, round(width / 500))
    if scene.horizon is not None:
        rise = math.tan(math.radians(scene.horizon.roll)) * width / 2
        row = scene.horizon.row * scale
        draw.line([(0, row - rise), (width, row + rise)], fill=(255, 60, 40), width=stroke)
    if scene.sun is not None:
        x, y = scene.sun.x * scale, scene.sun.y * scale
        ring = max(scene.sun.radius_px * scale * 1.5, width / 60)
        draw.ellipse((x - ring, y - ring, x + ring, y + ring), outline=(255, 220, 0), width=stroke)
    return image


def _levels(mask: np.ndarray) -> np.ndarray:
    """Return a map in [0, 1], or a mask of booleans, as 8-bit grey."""
    return (np.clip(np.asarray(mask, np.float32), 0, 1) * 255 + 0.5).astype(np.uint8)


def _plain(value: Any) -> Any:
    """Return ``value`` as JSON types; arrays are maps, which have their own files."""
    if dataclasses.is_dataclass(value):
        pairs = {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
        return {k: _plain(v) for k, v in pairs.items() if not isinstance(v, np.ndarray)}
    if hasattr(value, "_asdict"):
        pairs = value._asdict()
        return {k: _plain(v) for k, v in pairs.items() if not isinstance(v, np.ndarray)}
    if isinstance(value, dict):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float):
        return round(value, 6) if math.isfinite(value) else None
    if value is None or isinstance(value, (bool, int, str)):
        return value
    return str(value)
