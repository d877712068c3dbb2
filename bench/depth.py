"""Measure the depth methods against rendered scenes of known depth.

    python bench/depth.py [folder with truth/ and samples/]

A row is a scene, with or without the hints in its JSON (field of view, horizon, sun): root mean
square error of ln depth up to one scale (RMSE), and the share of the land that is correct within
25 % after one median scale (δ).
"""

from __future__ import annotations

import dataclasses
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np

import sunwidget as sw
from sunwidget.analysis.depth import depth

FARTHEST = 50_000.0  # meters: beyond, the renders' depth is meaningless


def scenes(folder: Path) -> Iterator[tuple[str, Path, np.ndarray, dict[str, Any]]]:
    """Yield name, picture, known depth in meters and hints."""
    for path in sorted(folder.glob("truth/*.json")):
        facts = json.loads(path.read_text("utf-8"))
        known = np.load(path.with_name(f"{path.stem}_depth.npz"))["depth_m"]
        for frame in facts["frames"]:
            yield path.stem, path.with_name(frame["file"] + ".png"), known, hints(facts, frame)
    for path in sorted(folder.glob("samples/*/*.json")):
        facts = json.loads(path.read_text("utf-8"))
        code = cv2.imread(str(path.with_name(facts["depth"]["file"])), -1).astype(float)
        known = 0.5 * np.exp((code - 1) / 65533 * np.log(200_000))
        known[code >= 65535] = np.inf
        frame = next(f for f in facts["frames"] if not f.get("file_auto"))
        picture = facts.get("jpeg", frame["file"] + ".png")
        yield f"sample {path.stem}", path.with_name(picture), known, hints(facts, frame)


def hints(facts: dict[str, Any], frame: dict[str, Any]) -> dict[str, Any]:
    """Return the hints that a user could give."""
    sun = (frame["sun_x"], frame["sun_y"])
    return {"fov": facts["fov_v_deg"], "horizon": facts["horizon_row"], "sun": sun}


def by(scene: sw.Scene, method: str) -> sw.Scene:
    """Return the scene as if analyzed with another depth method."""
    methods = tuple((dict(scene.hints.methods) | {"depth": method}).items())
    return dataclasses.replace(scene, hints=dataclasses.replace(scene.hints, methods=methods))


def score(scene: sw.Scene, known: np.ndarray) -> tuple[float, float]:
    """Return RMSE and δ over the land where both have a depth."""
    both = np.isfinite(scene.depth) & np.isfinite(known) & (known < FARTHEST)
    error = np.log(scene.depth[both]) - np.log(known[both])
    right = np.abs(error - np.median(error)) < np.log(1.25)
    return float(error.std()), float(right.mean())


def main(folder: Path) -> None:
    """Print the table."""
    scores: dict[tuple[str, str], dict[str, list[tuple[float, float]]]] = {}
    for name, picture, known, told in scenes(folder):
        for way, options in (("found", {}), ("told", told)):
            row = scores.setdefault((name, way), {method: [] for method in depth.METHODS})
            scene = sw.analyze(picture, **options)
            for method in depth.METHODS:
                row[method].append(score(by(scene, method), known))
    print(f"{'scene':24}" + "".join(f"{method:>22}" for method in depth.METHODS))
    for (name, way), row in scores.items():
        cells = [np.mean(row[method], axis=0) for method in depth.METHODS]
        print(f"{name + ', ' + way:24}" + "".join(f"{e:12.2f}{100 * r:8.0f} %" for e, r in cells))


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[2] / "shared")
