"""The contribution of each effect: the score against rendered truth with each effect off in turn.

usage: python bench/ablation.py [--truth FOLDER ...] [--hints] [--only NAME,NAME] [--width N]
                                [--json OUT]

The score is that of the shared tool ``score_relight.py``, means over all moves of all scenes: skill
and ΔE00 of sky and land, and the angle between the mean colors. A row "without X" is the default
edit with X at the value that switches it off; its deficit against "all" is the contribution of X.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from PIL import Image
from speed.effects import WITHOUT

import sunwidget as sw

SHARED = Path(__file__).resolve().parents[2] / "shared"
# The value that switches an effect off, if not 0.
OFF: dict[str, dict[str, float]] = {
    name: {name: 0.0} for name in (*WITHOUT, "colourfulness", "lens_flare", "cloud_strength")
}
OFF["land's slope and shadows"] = {
    "shading": 0,
    "gloss": 0,
    "cast_shadows": 0,
    "cloud_shadows": 0,
}
MEASURES = ("sky_skill", "fg_skill", "sky_dE", "fg_dE", "sky_angle", "fg_angle", "fg_ev")


class Move(NamedTuple):
    """One frame of the truth: its sun and its picture."""

    azimuth: float
    elevation: float
    truth: np.ndarray


class Subject(NamedTuple):
    """One scene: its analyzed photo, its masks, and the moves to predict."""

    name: str
    scene: sw.Scene
    photo: np.ndarray
    sky: np.ndarray
    land: np.ndarray
    moves: list[Move]


def load_score() -> Any:
    """Return the shared tool as a module, so that both compute the same score."""
    path = SHARED / "tools" / "score_relight.py"
    spec = importlib.util.spec_from_file_location("score_relight", path)
    if spec is None or spec.loader is None or not path.is_file():
        raise SystemExit(
            f"The score's tool is missing: {path}. Put the shared folder beside this one."
        )
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def subjects(folder: Path, *, hints: bool) -> Iterator[Subject]:
    """Analyze every scene of ``folder``; the photo is the frame at azimuth 0, elevation 12."""
    for path in sorted(folder.glob("*.json")):
        told = json.loads(path.read_text())
        if "frames" not in told:
            continue
        frames = told["frames"]
        own = next((f for f in frames if (f["az_deg"], f["el_deg"]) == (0, 12)), frames[0])

        def picture(frame: dict[str, Any]) -> np.ndarray:
            name = frame.get("file_auto") or frame["file"]
            return np.asarray(Image.open(folder / f"{name}.png").convert("RGB"))

        photo = picture(own)
        rest = [f for f in frames if f is not own]
        height, width = picture(rest[0]).shape[:2]
        zoom = photo.shape[1] / width
        matte = Image.open(folder / f"{told['scene']}_sky.png").convert("L")
        alpha = np.asarray(matte.resize((width, height), Image.Resampling.BOX))
        known = {
            "fov": told["fov_v_deg"],
            "horizon": told["horizon_row"],
            "sun": (own["sun_x"], own["sun_y"]),
        }
        scene = sw.analyze(photo, **(known if hints else {}))
        moves = [
            Move(*scene.camera.angles(f["sun_x"] * zoom, f["sun_y"] * zoom), picture(f))
            for f in rest
        ]
        yield Subject(told["scene"], scene, photo, alpha > 250, alpha < 5, moves)


def score_of(
    score: Any, subject: Subject, changes: dict[str, float], width: int | None
) -> list[dict[str, float]]:
    """Score each move of ``subject`` with these changed parameters, at this picture width."""
    rows = []
    rows_of, columns = subject.moves[0].truth.shape[:2]
    width = width or columns
    size = (width, round(rows_of * width / columns))
    box = Image.Resampling.BOX

    def small(image: np.ndarray) -> np.ndarray:
        return np.asarray(Image.fromarray(image).resize(size, box))

    sky, land = (
        small(subject.sky.astype(np.uint8) * 255),
        small(subject.land.astype(np.uint8) * 255),
    )
    for move in subject.moves:
        edit = sw.Edit(sun_azimuth=move.azimuth, sun_elevation=move.elevation, **changes)
        # At the truth's own size the photo may be larger: it is drawn whole and then averaged.
        whole = width == columns
        drawn = sw.render(subject.scene, edit, size=None if whole else size)
        pictures = (small(drawn), small(move.truth), small(subject.photo))
        light = [score.linear(image) for image in pictures]
        rows.append(score.compare(*light, sky > 250, land > 250))
    return rows


def mean(rows: list[dict[str, float]]) -> dict[str, float]:
    """Return the mean of each measure over the rows that have it."""
    return {m: float(np.mean([row[m] for row in rows if m in row])) for m in MEASURES}


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--truth", type=Path, nargs="+", default=[SHARED / "truth"])
    parser.add_argument("--hints", action="store_true", help="tell field of view, horizon and sun")
    parser.add_argument("--only", help="names of effects, separated by commas")
    parser.add_argument("--width", type=int, help="compare smaller pictures: quicker")
    parser.add_argument("--json", type=Path, help="write the means here, too")
    options = parser.parse_args()
    score = load_score()
    wanted = options.only.split(",") if options.only else list(OFF)
    edits: dict[str, dict[str, float]] = {"all": {}} | {f"without {n}": OFF[n] for n in wanted}
    rows: dict[str, list[dict[str, float]]] = {name: [] for name in edits}
    for folder in options.truth:
        for subject in subjects(folder, hints=options.hints):
            for name, changes in edits.items():
                rows[name] += score_of(score, subject, changes, options.width)
    means = {name: mean(found) for name, found in rows.items()}
    print("| " + " | ".join(["", *MEASURES]) + " |")
    print("|" + "---|" * (len(MEASURES) + 1))
    for name, values in means.items():
        print(f"| {name} | " + " | ".join(f"{values[m]:.3f}" for m in MEASURES) + " |", flush=True)
    if options.json:
        options.json.write_text(json.dumps(means, indent=1))


if __name__ == "__main__":
    main()
