"""Errors of the estimated position of an unseen sun against known suns.

    PYTHONPATH=. python bench/unseen_sun.py DIR [--photos DIR] [--webcam DIR] [--limit N] [--fit]

DIR holds truth/ and samples/, rendered scenes; the photos are those of ``training/suns/labels.csv``
in whose sky a disc was marked and that train nothing. Frames that show their sun are seen again by
a camera that turned away from it (training/suns/away.py). A render is judged twice: as a stranger's
picture, and with its field of view and horizon told. A photo's field of view is the
assumed one for truth and analysis alike, and its horizon is the whole photo's: the table of photos
is that of the search alone. Their suns all stand near the picture, as they were seen; those of the
fixed camera stand anywhere, but its heading is known within 20° only. ``--fit`` fits the
posterior's odds on every second of the photos; the others judge.
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
from sunwidget.analysis.fit import fit
from sunwidget.analysis.hints import Hints
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.land import look_at_land
from sunwidget.analysis.pipeline import FIT_SIDE, clouds_by_color
from sunwidget.analysis.segmentation import coarse_sky
from sunwidget.geometry.camera import Camera
from sunwidget.photo.photo import open_photo
from training.suns.away import Case, Direction, read, turned_away, without_suns
from training.suns.labels import labels

FITTING, JUDGING = slice(0, None, 2), slice(1, None, 2)


class Answer(NamedTuple):
    """The sun's true position, its estimate, and the estimate's spread."""

    sun: Direction
    found: Direction
    spread: float


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


def photos(folder: Path, half: slice, limit: int | None) -> Iterator[Case]:
    """Return half of the photos with a marked disc that train nothing, turned away from it."""
    known = [p for p in labels() if p.kind == "disc" and p.test]
    known.sort(key=lambda p: hashlib.sha256(p.file.encode()).digest())
    return without_suns(folder, known[half][:limit])


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
    searches: list[tuple[Direction, Any]] = []
    likeliest, sun = fit.likeliest_sun, (0.0, 0.0)

    def note(*evidence: Any) -> tuple[Direction, float]:
        searches.append((sun, evidence))
        return likeliest(*evidence)

    fit.likeliest_sun = note
    for case in cases:
        sun = case.sun
        search(case)
    fit.likeliest_sun = likeliest
    for odds in np.arange(8.0, 0.0, -0.5):
        found = [(s, likeliest(*evidence[:3], float(odds))) for s, evidence in searches]
        if np.mean([apart(s, best) <= spread for s, (best, spread) in found]) >= 0.8:
            break
    return float(odds)


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
        fit.SUN_ODDS_BESIDE = learn(photos(options.photos, FITTING, options.limit))
        print("SUN_ODDS_BESIDE =", fit.SUN_ODDS_BESIDE)
    print(
        "| suns | n | angle | azimuth | elevation | < 22° | < 45° | elevation < 7° | < 15° "
        "| within the spread | spread |\n" + "|---" * 11 + "|"
    )
    report("renders, nothing told", [stranger(case) for case in rendered(options.folder)])
    groups = {"renders, camera told": rendered(options.folder)}
    if options.photos:
        groups["photos that fitted it"] = photos(options.photos, FITTING, options.limit)
        groups["photos"] = photos(options.photos, JUDGING, options.limit)
    if options.webcam:
        groups["fixed camera"] = webcam(options.webcam, 60)
    for name, cases in groups.items():
        found = ((case.sun, search(case)) for case in cases)
        report(name, [Answer(sun, fitted.sun, fitted.sun_spread) for sun, fitted in found])


if __name__ == "__main__":
    main()
