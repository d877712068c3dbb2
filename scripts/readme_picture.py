"""Draw docs/drag.webp: the sun of a sample dragged across the sky and below the horizon.

usage: python scripts/readme_picture.py [picture]
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from scipy.interpolate import PchipInterpolator

import sunwidget as sw

PICTURE = Path(__file__).resolve().parents[1] / "docs" / "drag.webp"
SIZE = (720, 480)
FRAMES_A_SECOND = 12
SAMPLE = "meadow"
# Seconds, azimuth and elevation in degrees; the first is where the sample's own sun is.
WAY = (
    (0.0, -7.05, 11.84),
    (0.7, -7.05, 11.84),
    (2.6, 11.0, 7.0),
    (4.2, 5.0, 2.2),
    (5.4, 4.0, 0.2),
    (7.0, 3.5, -5.0),
)
REST = 1.2  # seconds at the end
RING = 13  # pixels, the handle that a person drags
QUALITY = 70


def suns() -> list[tuple[float, float]]:
    """Return azimuth and elevation of every frame."""
    seconds, azimuth, elevation = np.array(WAY).T
    at = np.arange(0, seconds[-1], 1 / FRAMES_A_SECOND)
    ways = (PchipInterpolator(seconds, way)(at) for way in (azimuth, elevation))
    return list(zip(*(way.tolist() for way in ways), strict=True))


def with_ring(frame: np.ndarray, place: tuple[float, float]) -> Image.Image:
    """Lay the editor's handle over a frame, smooth at its edges."""
    fine = 4
    layer = Image.new("L", (SIZE[0] * fine, SIZE[1] * fine))
    x, y = place[0] * fine, place[1] * fine
    box = (x - RING * fine, y - RING * fine, x + RING * fine, y + RING * fine)
    ImageDraw.Draw(layer).ellipse(box, outline=210, width=2 * fine)
    mask = layer.resize(SIZE, Image.Resampling.BOX)
    picture = Image.fromarray(frame)
    picture.paste((255, 255, 255), mask=mask)
    return picture


def film(path: Path) -> None:
    """Write the animation."""
    scene = sw.analyze(sw.sample(SAMPLE))
    scale = SIZE[0] / scene.width
    frames = []
    for index, (azimuth, elevation) in enumerate(suns()):
        edit = sw.Edit(sun_azimuth=azimuth, sun_elevation=elevation) if index else sw.Edit()
        x, y = scene.camera.pixel(azimuth, elevation)
        frames.append(with_ring(sw.render(scene, edit, size=SIZE), (x * scale, y * scale)))
    each = round(1000 / FRAMES_A_SECOND)
    durations = [each] * (len(frames) - 1) + [round(1000 * REST)]
    frames[0].save(
        path,
        save_all=True,
        append_images=frames[1:],
        duration=durations,
        loop=0,
        quality=QUALITY,
        method=6,
        kmax=1,  # whole frames: what changed alone leaves seams in a smooth sky
    )


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else PICTURE
    film(target)
    print(target, f"{target.stat().st_size / 1e6:.2f} MB")
