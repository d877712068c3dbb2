"""Domes with a moved sun, against the same weather under that sun (docs/guide/dome.md).

``python -m training.skies.domes FOLDER 0 24 moved`` makes the skies and needs bpy;
``python bench/dome_moved.py FOLDER`` then moves each sun to the other's position. No factor is
removed: one map gives the exposure of the other.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from dome import PLANES

import sunwidget as sw
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.dome.disc import disc_with_illuminance
from sunwidget.dome.sphere import angles, direction_of, distance, irradiance, solid_angles, toward
from sunwidget.export.dome.moved import move_sun
from sunwidget.formats.color import LUMINANCE

_DEVELOPED = 12  # seeds below it were looked at while the method was made


def planes(light: np.ndarray, direct: np.ndarray, sun: tuple[float, float]) -> np.ndarray:
    """Return the illuminance of the five planes."""
    beam = toward(*sun)
    found = [
        irradiance(light, normal) + max(float(beam @ np.array(normal)), 0) * direct
        for normal in PLANES.values()
    ]
    return np.asarray(np.array(found) @ LUMINANCE)


def judged(path: Path, first: int) -> dict[str, Any]:
    """Return how far a moved dome is from the truth, in stops, and its suns, in degrees."""
    with np.load(path) as found:
        light, direct = found["light"], found["direct"]
        suns = [(float(a), float(e)) for a, e in found["directions"]]
        true_sky = found["sky"]
    second = 1 - first
    disc = disc_with_illuminance(direct[first], Atmosphere(), suns[first], light.shape[2])
    dome = sw.analyze_dome(np.asarray(light[first] + disc, np.float32))
    edit = sw.Edit(sun_azimuth=suns[second][0], sun_elevation=suns[second][1])
    out = move_sun(dome, edit, light.shape[2])
    width = light.shape[2]
    azimuth, elevation = angles(width)
    drawn = direction_of(
        ((out.disc @ LUMINANCE * solid_angles(width))[..., None] * toward(azimuth, elevation)).sum(
            (0, 1)
        )
    )
    ours = planes(out.sky, out.direct, out.direction)
    above = elevation > 0
    agree = (dome.sky > 0.5) & above
    return {
        "seed": int(path.stem),
        "first": first,
        "kind": dome.sun_kind,
        "elevations": [suns[first][1], suns[second][1]],
        "own_sun_off_deg": float(distance(suns[first], *(np.array(a) for a in dome.sun))),
        "drawn_sun_off_deg": float(distance(suns[second], *(np.array(a) for a in drawn)))
        if out.disc.any()
        else None,
        "sky_iou": float((agree & true_sky).sum() / ((agree | true_sky) & above).sum()),
        "with_sun": _stops(ours, planes(light[second], direct[second], suns[second])),
        "sky": _stops(
            planes(out.sky, 0 * out.direct, out.direction),
            planes(light[second], 0 * direct[second], suns[second]),
        ),
        "unmoved": _stops(
            planes(light[first], direct[first], suns[first]),
            planes(light[second], direct[second], suns[second]),
        ),
    }


def _stops(found: np.ndarray, wanted: np.ndarray) -> list[float]:
    return [float(n) for n in np.log2(found / wanted)]


def main() -> None:
    """Print the figures of ``docs/guide/dome.md`` and write them to build/dome_moved.json."""
    paths = sorted(Path(sys.argv[1]).glob("*.npz"), key=lambda path: int(path.stem))
    wanted = range(*(int(n) for n in sys.argv[2:4])) if sys.argv[3:] else range(10**6)
    rows = []
    for path in paths:
        if int(path.stem) in wanted:
            for first in (0, 1):
                rows.append(judged(path, first))
                print(rows[-1], flush=True)
    seen = ("disc", "veiled", "clipped", "hidden")
    for name, chosen in (
        ("developed on", lambda row: row["seed"] < _DEVELOPED),
        ("judged", lambda row: row["seed"] >= _DEVELOPED),
        *(
            (
                f"judged, {kind}",
                lambda row, kind=kind: row["seed"] >= _DEVELOPED and row["kind"] == kind,
            )
            for kind in seen
        ),
    ):
        some = [row for row in rows if chosen(row)]
        if not some:
            continue
        sizes = {key: np.abs([row[key] for row in some]) for key in ("with_sun", "sky", "unmoved")}
        off = [row["own_sun_off_deg"] for row in some]
        print(
            f"{name}: {len(some)} moves; "
            + "; ".join(
                f"{key} median {np.median(size):.2f}, nine in ten {np.quantile(size, 0.9):.2f}"
                for key, size in sizes.items()
            )
            + f"; own sun off {np.median(off):.2f}°, at most {max(off):.1f}°"
            + f"; sky IoU {np.mean([row['sky_iou'] for row in some]):.3f}"
        )
    out = Path("build", "dome_moved.json")
    out.parent.mkdir(exist_ok=True)
    out.write_text(json.dumps(rows, indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main()
