"""Blind pairs: is a change of the frame better on photos that nobody tuned on?

    python bench/pairs.py draw FOLDERS... --changes changes.toml --out OUT [--seed 7 --photos 72]
    python bench/pairs.py count OUT

`changes.toml` has a table for each change, of parameters or of a shader's text:

    [less_glow]
    parameters = {glow = 0.5}
    suns = ["view3", "view12"]

    [brighter_air]
    shader = "camera/bright_air.glsl"
    old = "kAirRange = 0.5"
    new = "kAirRange = 0.75"

`draw` chooses photos by the seed, none of those that a file named in `--seen` lists (`photos.txt`
of an earlier OUT), analyses them once (`OUT/scenes`), and sets one sun into each, in turn, with and
without each change. Pairs that differ by less than `--least` levels are left out. `OUT/less_glow`
then holds the sheets and `task.txt` for a reader who knows nothing of the code and writes
`marks.txt` beside it; `count` compares these with `OUT/keys`. A result of one set of photos needs a
second one: of 75 changes, one was 15 to 8 on the first and 8 to 18 on the next.
"""

import argparse
import collections
import json
import pickle
import random
import re
import tomllib
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

import sunwidget as sw
from sunwidget.renderer import offscreen, shader_source
from sunwidget.renderer.gl_thread import on_gl_thread

SUNS = {
    "view3": ("3 degrees above the horizon, a little right of the center", (8, 3)),
    "view12": ("12 degrees above the horizon, at the left", (-20, 12)),
    "side": ("high up (35 degrees), far to the right, out of the picture", (70, 35)),
    "blue": ("below the horizon (dusk)", (None, -4)),
}
WIDTH = 640  # of each picture of a sheet
TASK = """You judge edited photographs as an ordinary, attentive person would.
Each sheet shows a photo and two edits of it, left and right, in which only the sun was moved:
%s
Look at every sheet carefully. Which edit looks more like a real photograph with such a sun? Say
SAME only if you see no difference or have no preference. Also mark both edits hard: 2 would pass as
a photograph; 1 has a visible flaw, is still usable; 0 an untrained person sees at once is wrong.
Write a line for each sheet to marks.txt, NUMBER LEFT|RIGHT|SAME MARK_LEFT MARK_RIGHT - a few words:
17 LEFT 1 0 - the right sky is green
"""
MARK = re.compile(r"\s*(\d+)\s+(LEFT|RIGHT|SAME)\s+([012])\s+([012])")


def shaders_of(row: dict[str, Any]) -> set[str]:
    """Names of the shaders that draw a pass."""
    parts = row.get("parts", {})
    return {row["shader"], *parts.get("shaders", []), *filter(None, [parts.get("by")])}


def shader_texts() -> dict[str, str]:
    """Text of each shader of the frame, that of its constants included."""
    texts: dict[str, str] = {}
    for row in shader_source.frame_graph()["passes"]:
        for shader in shaders_of(row):
            files = [shader, *filter(None, [row.get("constants")])]
            texts[shader] = "".join(shader_source.resolve_includes(f"{f}.glsl") for f in files)
    return texts


class Changes:
    """Draws scenes with a change; a changed shader is compiled once for all photos."""

    def __init__(self) -> None:
        self.compiled: dict[str, dict[str, dict[str, Any]]] = {}
        self.affected: dict[str, set[str]] = {}

    def render(self, scene: sw.Scene, edit: sw.Edit, name: str, change: dict[str, Any]) -> Any:
        """Return the picture with the change of this name; one without must be drawn before."""
        if "shader" not in change:
            return sw.render(scene, edit.replace(**change["parameters"]))
        read = shader_source.read_shader

        def changed(path: str) -> str:
            text = read(path)
            if path != change["shader"]:
                return text
            if change["old"] not in text:
                raise ValueError(f"{name}: {path} does not contain {change['old']!r}.")
            return text.replace(change["old"], change["new"])

        before = {} if name in self.affected else shader_texts()
        shader_source.read_shader = changed
        try:
            if name not in self.affected:
                after = shader_texts()
                self.affected[name] = {
                    shader for shader in before if before[shader] != after[shader]
                }
            on_gl_thread(partial(self._swap, name))
            try:
                return sw.render(scene, edit)
            finally:
                on_gl_thread(partial(self._swap, name))
        finally:
            shader_source.read_shader = read

    def _swap(self, name: str, context: Any) -> None:
        """Exchange the programs of the affected shaders for those of the change, or back."""
        affected = self.affected[name]
        renderer = offscreen._renderer(context)  # noqa: SLF001 - its programs are nobody else's
        kept = self.compiled.setdefault(name, {})
        for kind in ("programs", "arrays", "uniforms"):
            held = getattr(renderer.programs, kind)
            stored = kept.setdefault(kind, {})
            for shader in affected:
                now, then = held.pop(shader, None), stored.pop(shader, None)
                if now is not None:
                    stored[shader] = now
                if then is not None:
                    held[shader] = then
        for drawing in renderer.drawings.values():
            for row in drawing.graph.passes:
                if shaders_of(row) & affected and row["name"] in drawing.graph.targets:
                    target = drawing.graph.targets[row["name"]]
                    target.key = target.parts_key = None


def edit_of(sun: str) -> sw.Edit:
    azimuth, elevation = SUNS[sun][1]
    told = {} if azimuth is None else {"sun_azimuth": azimuth}
    return sw.Edit(sun_elevation=elevation, **told)


def chosen(folders: list[Path], seen: set[str], seed: int, count: int) -> list[Path]:
    """Photos of the folders that are not `seen`, in an order drawn by the seed."""
    found = sorted(p for f in folders for p in f.iterdir() if p.suffix.lower() in (".jpg", ".png"))
    left = [path for path in found if str(path) not in seen]
    return random.Random(seed).sample(left, min(count, len(left)))


def scene_of(photo: Path, cache: Path) -> sw.Scene:
    if cache.exists():
        return pickle.loads(cache.read_bytes())
    scene = sw.analyze(sw.open(photo))
    cache.write_bytes(pickle.dumps(scene))
    return scene


def sheet(pictures: list[np.ndarray]) -> Image.Image:
    """Photo, left and right edit beside each other."""
    images = [Image.fromarray(np.ascontiguousarray(p)) for p in pictures]
    scale = WIDTH / max(images[0].size)
    size = (round(images[0].width * scale), round(images[0].height * scale))
    whole = Image.new("RGB", (3 * size[0] + 8, size[1]), (40, 40, 40))
    for place, image in enumerate(images):
        whole.paste(image.resize(size, Image.Resampling.LANCZOS), (place * (size[0] + 4), 0))
    return whole


def draw(args: argparse.Namespace) -> None:
    changes = tomllib.loads(args.changes.read_text())
    seen = {line for file in args.seen for line in file.read_text().splitlines()}
    photos = chosen(args.folders, seen, args.seed, args.photos)
    for folder in ("scenes", "keys", *changes):
        (args.out / folder).mkdir(parents=True, exist_ok=True)
    (args.out / "photos.txt").write_text("".join(f"{photo}\n" for photo in photos))
    sides, drawer = random.Random(args.seed), Changes()
    keys: dict[str, dict[int, Any]] = {name: {} for name in changes}
    for number, path in enumerate(photos):
        file = path.resolve().as_posix().replace("/", "_")
        scene = scene_of(path, args.out / "scenes" / f"{file}.pickle")
        photo = sw.render(scene)
        olds: dict[str, np.ndarray] = {}
        for name, change in changes.items():
            suns = change.get("suns", list(SUNS))
            sun = suns[number % len(suns)]
            if sun not in olds:
                olds[sun] = sw.render(scene, edit_of(sun))
            old = olds[sun]
            new = drawer.render(scene, edit_of(sun), name, change)
            if np.abs(new.astype(int) - old).max(-1).mean() < args.least:
                continue
            left = sides.random() < 0.5
            pair = [new, old] if left else [old, new]
            sheet([photo, *pair]).save(args.out / name / f"{number}.png")
            key = {"photo": path.name, "sun": sun, "new": "LEFT" if left else "RIGHT"}
            keys[name][number] = key
        print(f"{number + 1} of {len(photos)}", end="\r", flush=True)
    for name, key in keys.items():
        (args.out / "keys" / f"{name}.json").write_text(json.dumps(key, indent=1))
        lines = [f"{number}.png: {SUNS[pair['sun']][0]}" for number, pair in key.items()]
        (args.out / name / "task.txt").write_text(TASK % "\n".join(lines))
        print(f"{name}: {len(key)} of {len(photos)} photos change")


def counted(key: dict[str, Any], marks: str) -> dict[str, Any]:
    """Preferences for new, old and neither, by sun, and how the marks change."""
    suns: dict[str, list[int]] = collections.defaultdict(lambda: [0, 0, 0])
    table = {"up": 0, "down": 0, "pass": [0, 0], "wrong": [0, 0]}
    for found in filter(None, map(MARK.match, marks.splitlines())):
        pair = key[found[1]]
        left, right = int(found[3]), int(found[4])
        new, old = (left, right) if pair["new"] == "LEFT" else (right, left)
        suns[pair["sun"]][2 if found[2] == "SAME" else found[2] != pair["new"]] += 1
        table["up"] += new > old
        table["down"] += new < old
        for mark, name in ((2, "pass"), (0, "wrong")):
            table[name] = [table[name][0] + (old == mark), table[name][1] + (new == mark)]
    return {"new, old, same": [sum(n) for n in zip(*suns.values(), strict=True)], **table, **suns}


def count(args: argparse.Namespace) -> None:
    for file in sorted((args.out / "keys").glob("*.json")):
        marks = args.out / file.stem / "marks.txt"
        if marks.exists():
            print(file.stem, counted(json.loads(file.read_text()), marks.read_text()))


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    commands = parser.add_subparsers(required=True)
    drawing = commands.add_parser("draw")
    drawing.add_argument("folders", type=Path, nargs="+")
    drawing.add_argument("--changes", type=Path, required=True)
    drawing.add_argument("--out", type=Path, required=True)
    drawing.add_argument("--seen", type=Path, nargs="*", default=[])
    drawing.add_argument("--seed", type=int, default=7)
    drawing.add_argument("--photos", type=int, default=72)
    drawing.add_argument("--least", type=float, default=0.7)
    drawing.set_defaults(run=draw)
    counting = commands.add_parser("count")
    counting.add_argument("out", type=Path)
    counting.set_defaults(run=count)
    args = parser.parse_args()
    args.run(args)


if __name__ == "__main__":
    main()
