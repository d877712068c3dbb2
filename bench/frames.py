"""Flicker and cost of a time-lapse: a table on stdout.

usage: python bench/frames.py [FRAMES] [--take N] [--width W] [--place LAT,LON,HEADING]
                              [--times PATTERN] [--elevation E] [--azimuth A] [--alone]
                              [--sheet FILE]

FRAMES is a folder or a glob; without it a sequence is made from the bundled coast: a sinking sun,
drifting clouds, an exposure that jitters by 6 % and noise of 1.2 levels. Each frame's sun is moved
to one place. Printed for sky and land:

    source   deviation of the second difference between frames of the mean log luminance
    moved    the same for the pictures with a moved sun
    change   the same for moved over source: the contribution of the edit itself
    mask     mean difference of the sky's matte between consecutive frames

With --alone also for frames that were analyzed separately.
"""

from __future__ import annotations

import argparse
import itertools
import resource
import time
from pathlib import Path

import numpy as np
from PIL import Image

import sunwidget as sw
from sunwidget.formats.color import linear_to_srgb, srgb_to_linear
from sunwidget.timelapses.frames import Clock, frame_sources, read_frame
from sunwidget.timelapses.scenes import FrameScenes

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def made_up(count: int, width: int) -> list[np.ndarray]:
    """Make a sequence of known frames: 8 bits, with a camera's jitter and noise."""
    scene = sw.analyze(sw.sample("coast"))
    own, random = scene.automatic, np.random.default_rng(1)
    frames = []
    for share in np.linspace(0, 1, count):
        edit = sw.Edit(
            sun_azimuth=own["sun_azimuth"] + 8 * share,
            sun_elevation=14 - 10 * share,
            added_clouds=0.45,
            wind_time=6 * share,
            wind_speed=8,
        )
        light = sw.render(scene, edit, size=(width, round(width * 2 / 3)), dtype="float32")
        code = linear_to_srgb(np.clip(light * np.exp(random.normal(0, 0.06)), 0, 1)) * 255
        code += random.normal(0, 1.2, code.shape)
        frames.append(np.clip(np.round(code), 0, 255).astype(np.uint8))
    return frames


def log_light(picture: np.ndarray, where: np.ndarray) -> float:
    """Mean log luminance of the pixels ``where``."""
    light = srgb_to_linear(picture[where] / 255.0) @ LUMINANCE
    return float(np.log(np.maximum(light, 2e-3)).mean())


def table(
    name: str, source: list[np.ndarray], moved: list[np.ndarray], skies: list[np.ndarray]
) -> None:
    """Print a row for sky and land each."""
    steady = np.median(np.stack(skies), axis=0)
    mask = float(np.mean([np.abs(b - a).mean() for a, b in itertools.pairwise(skies)]))
    for part, where in (("sky", steady > 0.98), ("land", steady < 0.02)):
        if where.mean() < 0.01:
            continue
        before = np.array([log_light(p, where) for p in source])
        after = np.array([log_light(p, where) for p in moved])
        rough = [np.diff(x, 2).std() for x in (before, after, after - before)]
        print(f"{name:<9} {part:<5}" + "".join(f"{x:9.4f}" for x in rough) + f"{mask:10.5f}")


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("frames", nargs="?")
    parser.add_argument("--take", type=int, default=16)
    parser.add_argument("--width", type=int, default=400)
    parser.add_argument("--place", help="LAT,LON,HEADING")
    parser.add_argument("--times", help="pattern of the names")
    parser.add_argument("--elevation", type=float, default=4.0)
    parser.add_argument("--azimuth", type=float, default=-8.0)
    parser.add_argument("--alone", action="store_true", help="also analyse each frame alone")
    parser.add_argument("--sheet", type=Path, help="PNG: sources above, moved below")
    options = parser.parse_args()
    edit = sw.Edit(sun_elevation=options.elevation, sun_azimuth=options.azimuth)
    place = None
    if options.place:
        latitude, longitude, heading = map(float, options.place.split(","))
        place = sw.Place(latitude, longitude, "2000-01-01", 0, heading)
    if options.frames:
        sources = frame_sources(options.frames)[: options.take]
    else:
        sources = made_up(options.take, options.width)
    begin = time.perf_counter()
    scenes = FrameScenes.of(
        sources,
        long_edge=options.width,
        corrections=sw.Edit(),
        place=place,
        clock=Clock(options.times, len(sources)),
        hints={},
        progress=lambda _fraction, _message: None,
    )
    looked = time.perf_counter()
    source, moved, skies = [], [], []
    for scene in scenes:
        if isinstance(scene, sw.Scene):
            source.append(scene.photo.encoded)
            moved.append(sw.render(scene, edit))
            skies.append(scene.sky)
    each = (time.perf_counter() - looked) / len(sources)
    width, height = scenes.size
    print(
        f"{len(sources)} frames of {width}×{height}, sun by {scenes.track.source}: looked at in "
        f"{looked - begin:.1f} s, {each:.2f} s a frame, peak memory "
        f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20:.2f} GiB"
    )
    print(f"{'':<9} {'':<5}{'source':>9}{'moved':>9}{'change':>9}{'mask':>10}")
    table("together", source, moved, skies)
    if options.alone:
        found = [sw.analyze(read_frame(s, options.width)) for s in sources]
        table("alone", source, [sw.render(s, edit) for s in found], [s.sky for s in found])
    if options.sheet:
        step = max(1, len(source) // 6)
        rows = [np.hstack(row[::step][:6]) for row in (source, moved)]
        Image.fromarray(np.vstack(rows)).save(options.sheet)


if __name__ == "__main__":
    main()
