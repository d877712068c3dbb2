"""Let a simulated person correct skies: how many strokes until the mask is right.

usage: python bench/strokes.py FOLDER... [--photos 20] [--strokes 8] [--out SHEETS] [--json FILE]

A folder holds images/ and masks/ (white = sky, black = land, gray = ignored). The simulated person
takes the largest patch of wrong sky or land, chooses a brush that fits inside it and draws along
its length, never over correct parts, like a careful user. Photos whose automatic sky already has
an IoU of 0.98 are skipped.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import time
from pathlib import Path
from typing import Any

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.analysis.correct import corrected as corrected_scene
from sunwidget.analysis.strokes.brush import set_strokes

GOAL = 0.98
LONG_SIDE = 1024  # of the photos at most


def iou(sky: np.ndarray, truth: np.ndarray, judged: np.ndarray) -> float:
    """Intersection over union of two masks (H, W) bool where ``judged``."""
    union = np.count_nonzero((sky | truth) & judged)
    return np.count_nonzero(sky & truth & judged) / union if union else 1.0


def next_stroke(sky: np.ndarray, truth: np.ndarray, judged: np.ndarray) -> sw.Stroke | None:
    """Return the stroke through the largest wrong patch; None when there is none worth it."""
    best: tuple[int, str, np.ndarray] | None = None
    for label, wrong in (("sky", truth & ~sky & judged), ("not_sky", sky & ~truth & judged)):
        # A hair's breadth along the skyline is no patch: what a brush of 3 px fits in counts.
        core = cv2.morphologyEx(wrong.astype(np.uint8), cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
        count, labels, stats, _ = cv2.connectedComponentsWithStats(core, connectivity=8)
        if count < 2:
            continue
        patch = 1 + int(stats[1:, cv2.CC_STAT_AREA].argmax())
        area = int(stats[patch, cv2.CC_STAT_AREA])
        if best is None or area > best[0]:
            best = area, label, labels == patch
    if best is None or best[0] < 12:
        return None
    return _along(best[2], "sky" if best[1] == "sky" else "not_sky")


def _along(patch: np.ndarray, label: Any) -> sw.Stroke:
    """Draw along the patch's length, as wide as fits."""
    height, width = patch.shape
    depth = cv2.distanceTransform(np.pad(patch.astype(np.uint8), 1), cv2.DIST_L2, 5)[1:-1, 1:-1]
    deepest = float(depth.max())
    inside = (depth >= max(1.0, 0.35 * deepest)).astype(np.uint8)
    _, labels = cv2.connectedComponents(inside, connectivity=8)
    core = labels == labels[np.unravel_index(int(depth.argmax()), depth.shape)]
    rows, columns = np.nonzero(core)
    points = np.stack([columns, rows], -1).astype(np.float64)
    centre = points.mean(0)
    axis = np.linalg.svd(np.cov((points - centre).T) + 1e-9 * np.eye(2))[0][:, 0]
    along = (points - centre) @ axis
    bins = max(1, min(16, int(np.ptp(along) / max(0.8 * deepest, 4))))
    which = np.clip(
        ((along - along.min()) / max(np.ptp(along), 1e-9) * bins).astype(int), 0, bins - 1
    )
    way = [
        points[index[depth[rows[index], columns[index]].argmax()]]
        for index in (np.flatnonzero(which == k) for k in range(bins))
        if index.size
    ]
    # The longest run of the way whose brush stays inside the patch.
    best: tuple[float, sw.Stroke] | None = None
    for first in range(len(way)):
        for last in range(len(way), first, -1):
            part = way[first:last]
            depths = [depth[int(y), int(x)] for x, y in part]
            radius = min(max(0.6 * float(min(depths)), 0.5), 0.04 * max(width, height))
            stroke = sw.Stroke(
                label,
                tuple(((x + 0.5) / width, (y + 0.5) / height) for x, y in part),
                radius / max(width, height),
            )
            under = np.zeros(patch.shape, np.float32) + 0.5
            set_strokes(under, (stroke,))
            painted = under != 0.5
            length = float(np.count_nonzero(painted & patch))
            careful = np.count_nonzero(painted & ~patch) <= 0.02 * np.count_nonzero(painted)
            if (careful or len(part) == 1) and (best is None or length > best[0]):
                best = length, stroke
                break
    assert best is not None
    return best[1]


def correct(path: Path, mask: Path, most: int) -> dict[str, Any] | None:
    """Correct one photo; None when there is nothing to correct."""
    image = cv2.cvtColor(cv2.imread(str(path)), cv2.COLOR_BGR2RGB)
    scale = min(1.0, LONG_SIDE / max(image.shape[:2]))
    size = round(image.shape[1] * scale), round(image.shape[0] * scale)
    image = cv2.resize(image, size, interpolation=cv2.INTER_AREA)
    grey = cv2.imread(str(mask), cv2.IMREAD_GRAYSCALE)
    grey = cv2.resize(grey, size, interpolation=cv2.INTER_NEAREST)
    truth, judged = grey > 191, (grey < 64) | (grey > 191)
    scene = sw.analyze(image)
    start = sky = scene.sky > 0.5
    scores, seconds = [iou(sky, truth, judged)], []
    if scores[0] >= GOAL:
        return None
    strokes: tuple[sw.Stroke, ...] = ()
    while scores[-1] < GOAL and len(strokes) < most:
        stroke = next_stroke(sky, truth, judged)
        if stroke is None:
            break
        strokes += (stroke,)
        begin = time.perf_counter()
        corrected = corrected_scene(scene, sw.Edit(strokes=strokes))
        seconds.append(time.perf_counter() - begin)
        sky = corrected.sky > 0.5
        scores.append(iou(sky, truth, judged))
    return {
        "photo": f"{path.parent.parent.name}/{path.name}",
        "iou": [round(score, 4) for score in scores],
        "strokes": len(strokes) if scores[-1] >= GOAL else None,
        "seconds": [round(s, 3) for s in seconds],
        "sheet": _sheet(image, truth, start, sky, strokes),
    }


def _sheet(
    image: np.ndarray,
    truth: np.ndarray,
    start: np.ndarray,
    end: np.ndarray,
    strokes: tuple[sw.Stroke, ...],
) -> np.ndarray:
    """Truth, start and end beside each other: wrong land red, wrong sky blue, strokes drawn."""
    tiles = []
    height, width = truth.shape
    for k, sky in enumerate((truth, start, end)):
        tile = (0.5 * image + 90 * sky[..., None]).astype(np.uint8)
        tile[truth & ~sky] = (230, 40, 40)
        tile[sky & ~truth] = (40, 80, 255)
        for stroke in strokes if k else ():
            colour = (255, 255, 0) if stroke.label == "sky" else (255, 140, 0)
            line = np.array([[x * width, y * height] for x, y in stroke.points], np.int32)
            cv2.polylines(tile, [line.reshape(-1, 1, 2)], False, colour, 3)
            cv2.circle(tile, tuple(int(v) for v in line[0]), 5, colour, 2)
        tiles.append(cv2.resize(tile, (512, round(512 * height / width))))
    return np.hstack(tiles)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--photos", type=int, default=20, help="how many to correct")
    parser.add_argument("--strokes", type=int, default=8, help="most strokes a photo")
    parser.add_argument("--every", type=int, default=1, help="take every n-th photo")
    parser.add_argument("--out", type=Path, help="folder for a sheet of each photo")
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    results: list[dict[str, Any]] = []
    lists = [sorted((f / "images").iterdir())[:: arguments.every] for f in arguments.folders]
    for k in range(max(map(len, lists), default=0)):  # in turn from each folder
        for photos in lists:
            if k >= len(photos) or len(results) >= arguments.photos:
                continue
            path = photos[k]
            mask = path.parent.parent / "masks" / f"{path.stem}.png"
            result = correct(path, mask, arguments.strokes)
            if result is None:
                continue
            sheet = result.pop("sheet")
            if arguments.out is not None:
                arguments.out.mkdir(parents=True, exist_ok=True)
                name = result["photo"].replace("/", "_").rsplit(".", 1)[0]
                cv2.imwrite(str(arguments.out / f"{name}.jpg"), sheet[..., ::-1])
            results.append(result)
            print(
                result["photo"],
                *result["iou"],
                f"{1000 * statistics.median(result['seconds'] or [0]):.0f} ms",
                flush=True,
            )
    done = [r["strokes"] for r in results if r["strokes"] is not None]
    seconds = [s for r in results for s in r["seconds"]]
    if not results:
        print("No photo to correct.")
        return 1
    for count in range(4):
        scores = [r["iou"][min(count, len(r["iou"]) - 1)] for r in results]
        mean, least = statistics.mean(scores), min(scores)
        print(f"after {count} strokes: mean IoU {mean:.4f}, least {least:.4f}")
    print(
        f"{len(done)} of {len(results)} photos reach {GOAL}; "
        f"{sum(n <= 3 for n in done)} within three strokes"
    )
    if seconds:
        print(
            f"a stroke takes {1000 * statistics.median(seconds):.0f} ms (median), "
            f"{1000 * max(seconds):.0f} ms at most"
        )
    if arguments.json is not None:
        arguments.json.write_text(json.dumps(results, indent=1) + "\n", "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
