"""Domes against skies that are known in all directions (docs/guide/dome.md).

``python -m training.skies.domes FOLDER 0 16`` makes the skies and needs bpy;
``python bench/dome.py FOLDER`` then evaluates the domes of their photos. A photo does not reveal
its exposure, so a dome is compared up to one factor: the mean logarithm of both over the picture.
"""

from __future__ import annotations

import json
import sys
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import sunwidget as sw
from sunwidget.dome.sphere import angles, distance, irradiance
from sunwidget.export.dome.light import dome_light
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

# x to the heading, y to the left, z up.
PLANES = {
    "up": (0, 0, 1),
    "ahead": (1, 0, 0),
    "right": (0, -1, 0),
    "behind": (-1, 0, 0),
    "left": (0, 1, 0),
}
_DEVELOPED = 8  # seeds below it were used during development
_SUN_ASIDE = 12.0  # degrees


@dataclass
class TrueSky:
    """A known sky: its dome (H, W, 3) without disc, and the irradiance (3,) by its veiled sun."""

    seed: int
    light: np.ndarray
    direct: np.ndarray
    direction: tuple[float, float]
    camera: Camera


def read(path: Path) -> tuple[TrueSky, np.ndarray]:
    """Return a sky and its photo, (H, W, 3) uint8."""
    with np.load(path) as found:
        width, height, fov, pitch = found["camera"].tolist()
        camera = Camera(int(width), int(height), fov, pitch)
        azimuth, elevation = found["direction"].tolist()
        sky = TrueSky(int(path.stem), found["light"], found["direct"], (azimuth, elevation), camera)
        return sky, found["photo"]


def judged(sky: TrueSky, photo: np.ndarray, *, told: bool) -> dict[str, Any]:
    """Return how far a photo's dome is from its sky, in stops, and its sun, in degrees.

    ``told``: the analysis gets field of view, horizon, and a sun ahead of the camera.
    """
    hints: dict[str, Any] = {}
    if told:
        hints = {"fov": sky.camera.fov_vertical_deg, "horizon": sky.camera.horizon_row()}
        point = sky.camera.pixel(*sky.direction)
        if np.isfinite(point).all():
            hints["sun"] = point
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scene = sw.analyze(photo, **hints)
    dome = dome_light(scene, sw.Edit(), sky.light.shape[1])
    azimuth, elevation = angles(sky.light.shape[1])
    x, y = sky.camera.pixel(azimuth, elevation)
    inside = (x > 0) & (x < sky.camera.width) & (y > 0) & (y < sky.camera.height)
    inside &= elevation > 6
    for sun in (sky.direction, dome.direction):
        inside &= distance(sun, azimuth, elevation) > _SUN_ASIDE
    ours, true = (np.log2((light @ LUMINANCE)[inside]).mean() for light in (dome.sky, sky.light))
    scale = 2.0 ** (true - ours)

    def stops(beam: float) -> list[float]:
        found = _planes(dome.sky * scale, beam * scale * dome.direct, dome.direction)
        wanted = _planes(sky.light, beam * sky.direct, sky.direction)
        return [float(n) for n in np.log2(found @ LUMINANCE) - np.log2(wanted @ LUMINANCE)]

    apart = distance(sky.direction, np.array(dome.direction[0]), np.array(dome.direction[1]))
    return {
        "seed": sky.seed,
        "sun_ahead": bool(np.isfinite(sky.camera.pixel(*sky.direction)).all()),
        "sun_hidden": bool(sky.direct @ LUMINANCE < 0.1 * (dome.direct @ LUMINANCE * scale)),
        "sun_off_deg": float(apart),
        "with_sun": stops(1.0),
        "sky": stops(0.0),
    }


def _planes(light: np.ndarray, direct: np.ndarray, sun: tuple[float, float]) -> np.ndarray:
    across, up = np.radians(sun)
    toward = np.array([np.cos(up) * np.cos(across), -np.cos(up) * np.sin(across), np.sin(up)])
    return np.array(
        [
            irradiance(light, n) + max(float(toward @ np.array(n)), 0) * direct
            for n in PLANES.values()
        ]
    )


def main() -> None:
    """Print the figures of ``docs/guide/dome.md`` and write them to build/dome.json."""
    paths = sorted(Path(sys.argv[1]).glob("*.npz"), key=lambda path: int(path.stem))
    rows = []
    for told in (True, False):
        for path in paths:
            rows.append(judged(*read(path), told=told) | {"told": told})
            print(rows[-1])
    for told in (True, False):
        for name, chosen in (
            ("developed on", lambda row: row["seed"] < _DEVELOPED),
            ("judged", lambda row: row["seed"] >= _DEVELOPED),
            ("judged, sun ahead", lambda row: row["seed"] >= _DEVELOPED and row["sun_ahead"]),
        ):
            some = [row for row in rows if row["told"] == told and chosen(row)]
            if not some:
                continue
            figures = [np.median(np.abs([row[key] for row in some])) for key in ("with_sun", "sky")]
            off = np.median([row["sun_off_deg"] for row in some])
            print(
                f"told={told} {name}: {len(some)} skies, median error with sun {figures[0]:.2f}, "
                f"sky alone {figures[1]:.2f} stops, sun off {off:.1f}°"
            )
    out = Path("build", "dome.json")
    out.parent.mkdir(exist_ok=True)
    out.write_text(json.dumps(rows, indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main()
