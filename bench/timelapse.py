"""Predict other frames of a time-lapse camera from one of its frames: a table on stdout.

usage: python bench/timelapse.py DIR [--camera 684] [--days N] [--width W] [--sheet FOLDER] [--look]
       python bench/timelapse.py DIR --heading

DIR holds a folder for each camera with frames named by their UTC time and sky_mask.png. On each
day the frame with the highest sun is the photo; it is analysed with its true sun, and every other
frame of the day is predicted by moving the sun to where it really stood. Foregrounds are compared
in linear light after one best gain (the cameras expose by themselves), mean CIEDE2000, pixels
clipped in the true frame left out. Beside the methods: `copy`, the photo itself; `gain`, the best
gain per channel knowing the true frame, which no one can know; with --look `look`, the change of
the same two hours of another day carried over (transfer_look). Clouds come and go between frames
and are not told to anyone. --heading scans the headings of the camera with a sky for the one
under which clear frames agree best with the model's sky.

Where the cameras stand was found from the frames themselves and from general knowledge: the skyline
of 684 is that of Roanoke, Virginia, and its first and last light agree with that place (the scan
prefers a heading of 210°, weakly, ±20°); the hotel's name and the flags of 10917 belong to
Saint-Ursanne, Jura, and the shadows of its fountain and trees give a heading of 38° ±15°.
"""

from __future__ import annotations

import argparse
import dataclasses
import datetime as dt
import itertools
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
from skimage.color import deltaE_ciede2000, rgb2lab

import sunwidget as sw
from sunwidget.analysis.fit.fit import model_sky, view_angles
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.formats.color import linear_to_srgb, srgb_to_linear
from sunwidget.geometry.camera import Camera
from sunwidget.geometry.solar import solar_position


class Place(NamedTuple):
    """Degrees north and east, heading from north, hours to local time, horizon in the picture."""

    latitude: float
    longitude: float
    heading: float
    hours: float
    horizon: float  # share of the height


PLACES = {
    "684": Place(37.272, -79.940, 210.0, -5, 0.74),
    "10917": Place(47.365, 7.154, 38.0, 1, 0.12),
}
METHODS = ("ratio", "thesis")


def time_of(path: Path) -> dt.datetime:
    """UTC time in a frame's name."""
    return dt.datetime.strptime(path.stem, "%Y%m%d_%H%M%S").replace(tzinfo=dt.UTC)


def sun_of(path: Path, place: Place) -> tuple[float, float]:
    """Azimuth from the heading and apparent elevation of the sun, degrees."""
    found = solar_position(time_of(path), place.latitude, place.longitude)
    azimuth = (found.azimuth - place.heading + 180) % 360 - 180
    return float(azimuth), float(found.apparent_elevation)


def days(folder: Path, place: Place) -> list[list[Path]]:
    """Frames by local day, the fullest days first; those of the night left out."""
    by_day = defaultdict(list)
    for path in sorted(folder.glob("2*.jpg")):
        if sun_of(path, place)[1] > -3:
            by_day[(time_of(path) + dt.timedelta(hours=place.hours)).date()].append(path)
    full = [frames for frames in by_day.values() if len(frames) > 1]
    return sorted(full, key=lambda frames: (-len(frames), frames[0].stem))


def frame(path: Path, width: int) -> np.ndarray:
    """sRGB codes of a frame, shrunk in linear light."""
    light = sw.open(path).pixels
    size = (width, round(width * light.shape[0] / light.shape[1]))
    return np.round(linear_to_srgb(cv2.resize(light, size, interpolation=cv2.INTER_AREA)) * 255)


def analysed(path: Path, mask: np.ndarray, place: Place, width: int) -> sw.Scene:
    """The scene of a frame with its true sun; a pixel can name only suns before the camera."""
    picture = frame(path, width).astype(np.uint8)
    height = picture.shape[0]
    sky = cv2.resize(mask, (width, height), interpolation=cv2.INTER_AREA).astype(np.float32) / 255
    sun = sun_of(path, place)
    horizon = place.horizon * height
    fov = sw.open(picture).field_of_view.vertical
    x, y = Camera.from_horizon(width, height, fov, horizon).pixel(*sun)
    hint = (x, y) if np.isfinite(x) and max(abs(x), abs(y)) < 20 * width else None
    scene = sw.analyze(picture, sky=sky, horizon=horizon, sun=hint)
    return scene if hint else dataclasses.replace(scene, sun=None, assumed_sun=sun)


def error(out: np.ndarray, true: np.ndarray, land: np.ndarray) -> float:
    """Mean CIEDE2000 over the land after one best gain; codes."""
    a, b = srgb_to_linear(out / 255), srgb_to_linear(true / 255)
    used = land & (b.max(-1) < 0.97)
    gain = float((a[used] * b[used]).sum() / max(float(np.square(a[used]).sum()), 1e-9))
    return float(
        deltaE_ciede2000(*(rgb2lab(linear_to_srgb(x[used])) for x in (gain * a, b))).mean()
    )


def best_gain(copy: np.ndarray, true: np.ndarray, land: np.ndarray) -> np.ndarray:
    """The photo with the gain per channel that suits the true frame best."""
    a, b = srgb_to_linear(copy / 255), srgb_to_linear(true / 255)
    used = land & (b.max(-1) < 0.97)
    gain = (a[used] * b[used]).sum(0) / np.maximum(np.square(a[used]).sum(0), 1e-9)
    return linear_to_srgb(a * gain) * 255


def score(folder: Path, options: argparse.Namespace) -> list[dict[str, float]]:
    """Print and return a row for each predicted frame."""
    place, width = PLACES[folder.name], options.width
    mask = cv2.imread(str(folder / "sky_mask.png"), cv2.IMREAD_GRAYSCALE)
    chosen = days(folder, place)[: options.days]
    rows = []
    for frames in chosen:
        source = max(frames, key=lambda path: sun_of(path, place)[1])
        scene = analysed(source, mask, place, width)
        photo = frame(source, width)
        land = cv2.resize(mask, photo.shape[1::-1], interpolation=cv2.INTER_AREA) < 5
        for target in frames:
            if target == source:
                continue
            true, sun = frame(target, width), sun_of(target, place)
            edit = sw.Edit(sun_azimuth=sun[0], sun_elevation=sun[1])
            # In float: a picture that came out dark is brightened below, and 8 bits would band.
            light = {m: sw.render(scene, edit, method=m, dtype="float32") for m in METHODS}
            made = {m: linear_to_srgb(x).astype(float) * 255 for m, x in light.items()}
            made |= {"copy": photo, "gain": best_gain(photo, true, land)}
            if options.look and (pair := _pair(chosen, frames, source, target, place)):
                first, second = (frame(p, width).astype(np.uint8) for p in pair)
                look = sw.transfer_look(photo.astype(np.uint8), first, second)
                made["look"] = look.encoded.astype(float)
            row = {name: error(picture, true, land) for name, picture in made.items()}
            rows.append(row)
            print(f"{source.stem} → {target.stem[9:]}  sun {sun[0]:5.0f} {sun[1]:4.0f}  ", end="")
            print("  ".join(f"{name} {value:5.2f}" for name, value in row.items()), flush=True)
            if options.sheet:
                sheet = np.hstack([photo, made["ratio"], made.get("look", photo), true])
                name = options.sheet / f"{folder.name}_{source.stem}_{target.stem[9:]}.png"
                cv2.imwrite(str(name), sheet[..., ::-1].astype(np.uint8))
    return rows


def _pair(
    chosen: list[list[Path]], own: list[Path], source: Path, target: Path, place: Place
) -> tuple[Path, Path] | None:
    """Two frames of another day whose suns stood as near as possible to the two asked ones."""

    def apart(a: Path, b: Path) -> float:
        (az, el), (az2, el2) = sun_of(a, place), sun_of(b, place)
        turned = np.cos(np.radians(el)) * abs((az - az2 + 180) % 360 - 180)
        return float(np.hypot(turned, el - el2))

    pairs = [p for day in chosen if day is not own for p in itertools.permutations(day, 2)]
    if not pairs:
        return None
    return min(pairs, key=lambda p: apart(p[0], source) + apart(p[1], target))


def scan_headings(folder: Path, place: Place) -> None:
    """Print how well frames agree with the model along the rows of the sky, by heading."""
    size, rows = (16, 9), 6
    air = Atmosphere(aerosol_optical_depth=0.12, angstrom_exponent=1.3, aerosol_albedo=0.9)
    camera = Camera.from_horizon(*size, 40, place.horizon * size[1])
    azimuth, elevation = (a[:rows] for a in view_angles(camera, *size))

    def along(light: np.ndarray) -> np.ndarray:
        log = np.log(np.maximum(light @ np.array([0.2126, 0.7152, 0.0722]), 1e-4))
        return log - log.mean(1, keepdims=True)

    seen = []
    for path in itertools.chain.from_iterable(days(folder, place)):
        small = cv2.resize(sw.open(path).pixels, size, interpolation=cv2.INTER_AREA)[:rows]
        rough = np.abs(np.diff(along(small), 2, axis=1)).mean()
        if rough < 0.06:  # clear, or evenly grey
            seen.append((path, along(small)))
    for heading in range(0, 360, 15):
        turned = place._replace(heading=float(heading))
        likeness = []
        for path, log in seen:
            sky = along(model_sky(air, azimuth, np.maximum(elevation, 0.3), sun_of(path, turned)))
            likeness.append((sky * log).sum() / np.sqrt((sky**2).sum() * (log**2).sum()))
        print(f"{heading:4d}°  {np.mean(likeness):6.3f}  ({len(seen)} frames)")


def main() -> None:
    """Print a row for each prediction and the means."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--camera", choices=PLACES, action="append")
    parser.add_argument("--days", type=int, help="at most so many of each camera, fullest first")
    parser.add_argument("--width", type=int, default=400)
    parser.add_argument("--sheet", type=Path, help="folder for photo | ratio | look | truth")
    parser.add_argument("--look", action="store_true", help="score transfer_look too")
    parser.add_argument("--heading", action="store_true", help="scan headings of 684 instead")
    options = parser.parse_args()
    if options.heading:
        return scan_headings(options.folder / "684", PLACES["684"])
    if options.sheet:
        options.sheet.mkdir(parents=True, exist_ok=True)
    for camera in options.camera or PLACES:
        rows = score(options.folder / camera, options)
        names = list(dict.fromkeys(name for row in rows for name in row))
        means = {n: np.mean([row[n] for row in rows if n in row]) for n in names}
        better = {n: np.mean([row[n] < row["copy"] for row in rows if n in row]) for n in names}
        print(f"{camera}: foreground ΔE00, mean of {len(rows)} frames (nearer than copy in)")
        for name in names:
            print(f"  {name:<7} {means[name]:6.2f}  {better[name]:5.0%}")
    return None


if __name__ == "__main__":
    main()
