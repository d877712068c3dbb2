"""Errors of the estimated position of an unseen sun against known suns.

    PYTHONPATH=. python bench/unseen_sun.py DIR [--photos DIR] [--webcam DIR] [--limit N] [--fit]

DIR holds truth/ and samples/, rendered scenes; the photos are those of ``training/suns/labels.csv``
in whose sky a disc was marked. Frames that show their sun are seen again by a camera that turned
away from it (a rotation of the picture, so that angles stay exact). A render is judged twice: as a
stranger's picture, and with its field of view and horizon told. A photo's field of view is the
assumed one for truth and analysis alike, and its horizon is the whole photo's: the table of photos
is that of the search alone. Their suns all stand near the picture, as they were seen; those of the
fixed camera stand anywhere, but its heading is known within 20° only. ``--fit`` fits the
posterior's odds on the half of the photos that does not judge (``Photo.test``).
"""

from __future__ import annotations

import argparse
import hashlib
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np
from timelapse import PLACES, sun_of

import sunwidget as sw
from sunwidget.analysis.fit import confidence, fit
from sunwidget.analysis.hints import Hints
from sunwidget.analysis.horizon import horizon as horizon_stage
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.land import look_at_land
from sunwidget.analysis.pipeline import FIT_SIDE, clouds_by_color
from sunwidget.analysis.segmentation import coarse_sky
from sunwidget.geometry.camera import Camera
from sunwidget.photo.photo import open_photo
from training.suns.labels import labels

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


class Answer(NamedTuple):
    """The sun's true position, its estimate, and the estimate's spread."""

    sun: Direction
    found: Direction
    spread: float


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
        turned = ((sun[0] - heading + 180) % 360 - 180, sun[1])
        at = np.array(view.pixel(*turned)) / (view.width, view.height)
        border = MARGIN * np.array([1, view.width / view.height])
        if np.all((at > -border) & (at < 1 + border)):
            continue
        azimuth, elevation = fit.view_angles(view, view.width, view.height)
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


def rendered(folder: Path) -> Iterator[Case]:
    """Yield the rendered scenes, as they are where they show no sun, else turned away from it."""
    for path in sorted([*folder.glob("truth/*.json"), *folder.glob("samples/*/*.json")]):
        facts = json.loads(path.read_text("utf-8"))
        matte = path.with_name(f"{path.stem}_sky.png")
        for frame in facts["frames"] + facts.get("frames_behind", []):
            picture = read(path.parent / ((frame.get("file_auto") or frame["file"]) + ".png"))
            height, width = picture.shape[:2]
            camera = Camera(width, height, facts["fov_v_deg"], facts["pitch_deg"])
            sun = frame["az_deg"], frame["el_deg"]
            name = frame["file"]
            x, y = camera.pixel(*sun)
            shown = sun[1] > -0.3 and 0 <= x <= width and 0 <= y <= height
            if not shown:
                yield Case(name, picture, camera, sun)
                continue
            sky = cv2.resize(cv2.imread(str(matte), 0), (width, height)) / np.float32(255)
            case = turned_away(name, picture, sky, camera, sun)
            if case is not None:
                yield case


def photos(folder: Path, test: bool, limit: int | None) -> Iterator[Case]:
    """Yield the photos with a marked disc, turned away from it: those that judge, or the others."""
    known = [p for p in labels() if p.kind == "disc" and p.test == test]
    known.sort(key=lambda p: hashlib.sha256(p.file.encode()).digest())
    for photo in known[:limit]:
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
        case = turned_away(photo.file, picture, sky.astype(np.float32), camera, sun)
        if case is not None:
            yield case


def search(case: Case) -> fit.SkyFit:
    """Return the fit with a known camera, by the search of the analysis on a small copy."""
    working = Working.of(open_photo(case.picture))
    sky = resize(coarse_sky.coarse(working), working.width, working.height)
    sky = (sky > 0.5).astype(np.float32)
    small = working.shrunk(FIT_SIDE)
    hints = Hints(methods=(("clouds", "unmix"),))
    cover = clouds_by_color(working, sky, hints, None)[0].opacity
    size = small.width, small.height
    expected = look_at_land(working).sun
    return fit.fit_sky(small, resize(sky, *size), resize(cover, *size), case.camera, None, expected)


def apart(one: Any, other: Any) -> Any:
    """Return degrees between directions."""
    (a, h), (b, k) = np.radians(one), np.radians(other)
    cosine = np.sin(h) * np.sin(k) + np.cos(h) * np.cos(k) * np.cos(a - b)
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def report(name: str, answers: list[Answer]) -> None:
    """Print a row of the table."""
    if not answers:
        return
    true, found, spread = (np.array([a[k] for a in answers]) for k in range(3))
    angle = apart(true.T, found.T)
    turn = np.abs((found[:, 0] - true[:, 0] + 180) % 360 - 180)
    rise = np.abs(found[:, 1] - true[:, 1])
    shares = [np.mean(x) for x in (angle < 22, angle < 45, rise < 7, rise < 15, angle < spread)]
    print(
        f"| {name} | {len(answers)} | {np.median(angle):.0f}° | {np.median(turn):.0f}° "
        f"| {np.median(rise):.0f}° | "
        + " | ".join(f"{100 * share:.0f} %" for share in shares)
        + f" | {np.median(spread):.0f}° |"
    )


def stranger(case: Case) -> Answer:
    """Return the estimate of the whole analysis for a picture without hints."""
    scene = sw.analyze(case.picture)
    found = scene.automatic
    return Answer(case.sun, (found["sun_azimuth"], found["sun_elevation"]), scene.sun_spread)


def learn(cases: Iterator[Case]) -> float:
    """Return the steepest odds under which at least four of five suns lie within the spread."""
    searches: list[tuple[Direction, Any, np.ndarray]] = []
    likeliest, sun = fit.likeliest_sun, (0.0, 0.0)

    def note(errors: Any, expected: np.ndarray) -> tuple[Direction, float]:
        searches.append((sun, errors, expected))
        return likeliest(errors, expected)

    fit.likeliest_sun = note
    for case in cases:
        sun = case.sun
        search(case)
    fit.likeliest_sun = likeliest
    for odds in np.arange(8.0, 0.0, -0.5):
        confidence.SUN_ODDS = float(odds)
        found = [(s, likeliest(errors, expected)) for s, errors, expected in searches]
        if np.mean([apart(s, best) <= spread for s, (best, spread) in found]) >= 0.8:
            break
    return float(confidence.SUN_ODDS)


def webcam(folder: Path, count: int) -> Iterator[Case]:
    """Yield frames of the fixed camera whose place is known, where they do not show the sun."""
    place = PLACES["684"]
    frames = [f for f in sorted(folder.glob("2*.jpg")) if sun_of(f, place)[1] > -2]
    for frame in frames[:: max(1, len(frames) // count)]:
        picture, sun = read(frame), sun_of(frame, place)
        height, width = picture.shape[:2]
        field = open_photo(picture).field_of_view.vertical
        camera = Camera.from_horizon(width, height, field, place.horizon * height)
        x, y = camera.pixel(*sun)
        if not (0 <= x <= width and 0 <= y <= height):
            yield Case(frame.stem, picture, camera, sun)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path, help="holds truth/ and samples/")
    parser.add_argument("--photos", type=Path, help="holds a folder images/ of each set")
    parser.add_argument("--webcam", type=Path, help="frames of camera 684 (bench/timelapse.py)")
    parser.add_argument("--limit", type=int, help="photos of each half")
    parser.add_argument("--fit", action="store_true", help="fit the odds first")
    options = parser.parse_args()
    if options.fit:
        confidence.SUN_ODDS = learn(photos(options.photos, False, options.limit))
        print("SUN_ODDS =", confidence.SUN_ODDS)
    print(
        "| suns | n | angle | azimuth | elevation | < 22° | < 45° | elevation < 7° | < 15° "
        "| within the spread | spread |\n" + "|---" * 11 + "|"
    )
    report("renders, nothing told", [stranger(case) for case in rendered(options.folder)])
    groups = {"renders, camera told": rendered(options.folder)}
    if options.photos:
        groups["photos that fitted it"] = photos(options.photos, False, options.limit)
        groups["photos"] = photos(options.photos, True, options.limit)
    if options.webcam:
        groups["fixed camera"] = webcam(options.webcam, 60)
    for name, cases in groups.items():
        found = ((case.sun, search(case)) for case in cases)
        report(name, [Answer(sun, fitted.sun, fitted.sun_spread) for sun, fitted in found])


if __name__ == "__main__":
    main()
