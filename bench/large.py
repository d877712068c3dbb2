"""Measure large stills: seconds, peak memory, seams and identity; a table on stdout.

usage: python bench/large.py [--megapixels 12 24 100]

The sample photo is enlarged, given noise and saved as a file of 8 and of 16 bits. Every size is
opened, analyzed and exported in a separate process. Peak memory is that of the whole process
(``ru_maxrss``), including interpreter and libraries. Seams: the picture drawn in strips
against the same picture drawn at once, if a texture can hold it. Identity: an unmoved sun.
"""

from __future__ import annotations

import argparse
import importlib
import json
import multiprocessing as mp
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import cv2
import numpy as np

import sunwidget as sw

MOVED = sw.Edit(sun_azimuth=14, sun_elevation=4)
WHOLE = 13_000_000  # pixels: a larger picture is not drawn at once for comparison


def enlarged(width: int, height: int, bits: int) -> np.ndarray:
    """Return the sample photo at a size, with a camera's noise: uint8 or uint16."""
    small = sw.open(sw.sample("coast")).encoded
    rng = np.random.default_rng(7)
    kind, scale = (np.uint8, 1) if bits == 8 else (np.uint16, 257)
    large = cv2.resize(small, (width, height), interpolation=cv2.INTER_CUBIC)
    out = np.empty(large.shape, kind)
    for top in range(0, height, 256):
        part = large[top : top + 256].astype(np.float32)
        part += 2 * rng.standard_normal(part.shape, np.float32)
        out[top : top + 256] = np.clip(np.rint(part * scale), 0, 255 * scale)
    return out


def file_of(folder: Path, megapixels: float, bits: int) -> Path:
    return folder / f"photo-{megapixels:g}-{bits}.png"


def made(folder: Path, megapixels: float, bits: int) -> None:
    """Write a photo of about this many pixels, with aspect ratio 3:2."""
    height = round((megapixels * 1e6 / 1.5) ** 0.5)
    path = file_of(folder, megapixels, bits)
    ending = cv2.cvtColor(enlarged(round(1.5 * height), height, bits), cv2.COLOR_RGB2BGR)
    cv2.imwrite(str(path), ending, [cv2.IMWRITE_PNG_COMPRESSION, 1])


def peak() -> float:
    """Return the peak memory of this process in GB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9


def exported(photo: Path, out: Path, moved: bool) -> dict[str, Any]:
    """Open, analyse and export one photo; seconds and peak memory after each step."""
    row: dict[str, Any] = {"begin_gb": peak()}
    begin = time.perf_counter()
    picture = sw.open(photo)
    row |= {"open_s": time.perf_counter() - begin, "open_gb": peak()}
    begin = time.perf_counter()
    scene = sw.analyze(picture)
    row |= {"analyse_s": time.perf_counter() - begin, "analyse_gb": peak()}
    module = importlib.import_module("sunwidget.renderer.offscreen")
    begin = time.perf_counter()
    edit = MOVED if moved else sw.Edit()
    changed = 0
    for rows, pixels in module.strips_of(scene, edit):
        if picture.bit_depth == 8:
            changed += int(np.count_nonzero(pixels != picture.encoded[rows]))
    row |= {"draw_s": time.perf_counter() - begin, "draw_gb": peak()}
    begin = time.perf_counter()
    sw.save((scene, edit), out)
    row |= {"save_s": time.perf_counter() - begin, "save_gb": peak()}
    if not moved:
        row["drawn_values_changed"] = changed
        saved = sw.open(out).encoded
        row["saved_values_changed"] = int(np.count_nonzero(saved != picture.encoded))
    elif picture.width * picture.height <= WHOLE:
        strips = sw.render(scene, edit)
        # Another value of the strip alone: all else of the way is the same.
        vars(module)["_BAND_PIXELS"] = vars(module)["STRIP_PIXELS"] = picture.width * picture.height
        row["seam"] = int(np.abs(sw.render(scene, edit).astype(int) - strips).max())
    return row


def in_another_process(*arguments: str) -> dict[str, Any]:
    # Not forked from a process that has held large pictures: ``ru_maxrss`` would be that one's.
    run = subprocess.run(
        [sys.executable, __file__, "--one", *arguments], check=True, stdout=subprocess.PIPE
    )
    found: dict[str, Any] = json.loads(run.stdout)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--megapixels", type=float, nargs="+", default=[12, 24, 100])
    parser.add_argument("--one", nargs=3, metavar=("PHOTO", "OUT", "MOVED"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one:
        photo, out, moved = options.one
        print(json.dumps(exported(Path(photo), Path(out), moved == "moved")))
        return
    print("MP bits edit        seconds: open analyse  draw  save   GB: open analyse  draw  save")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for megapixels in options.megapixels:
            for bits, ending, move in ((8, "jpg", "moved"), (8, "png", "not"), (16, "png", "not")):
                maker = mp.get_context("spawn").Process(
                    target=made, args=(folder, megapixels, bits)
                )
                maker.start()
                maker.join()
                photo = file_of(folder, megapixels, bits)
                row = in_another_process(str(photo), str(folder / f"out.{ending}"), move)
                (folder / f"out.{ending}").unlink()
                seconds = "".join(f"{row[k + '_s']:7.1f}" for k in STEPS)
                memory = "".join(f"{row[k + '_gb']:7.2f}" for k in STEPS)
                rest = {k: v for k, v in row.items() if not k.endswith(("_s", "_gb"))}
                print(f"{megapixels:g} {bits:3} {move:6} {ending} {seconds}  {memory}  {rest}")


STEPS = ("open", "analyse", "draw", "save")

if __name__ == "__main__":
    main()
