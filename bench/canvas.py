"""The canvas's frame time: the built front ends' frames in Chromium, without a notebook."""

from __future__ import annotations

import io
import json
import shutil
import statistics
from pathlib import Path
from typing import Any

from PIL import Image

from sunwidget.edit import PARAMETERS
from sunwidget.explorer.table import EXPLORER_PARAMETERS
from sunwidget.renderer.render import scene_textures

STATIC = Path(__file__).resolve().parents[1] / "sunwidget" / "static"
ADDRESS = "http://canvas.invalid/"
# Mesa's llvmpipe through ANGLE, the rasteriser that EGL uses here too.
FLAGS = ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist", "--no-sandbox"]
# Frames that are drawn in a row.
DRAG = 5
EDITOR = """
import { Frame } from "./sun_editor.js";
const { parameters, scene, pictures } = await (await fetch("./scene.json")).json();
const frame = new Frame(document.getElementById("canvas"), parameters);
for (const name of pictures) {
  const bytes = await (await fetch(`./${name}.png`)).blob();
  const options = { premultiplyAlpha: "none", colorSpaceConversion: "none" };
  frame.setPicture(name, await createImageBitmap(bytes, options));
}
frame.setScene(scene);
"""
EXPLORER = """
import { SkyFrame } from "./sky_explorer.js";
const { parameters } = await (await fetch("./scene.json")).json();
const frame = new SkyFrame(document.getElementById("canvas"), parameters);
"""
# Frames follow each other as in a drag, each waited for by reading a pixel where it is drawn. The
# visible canvas, a copy, is read once at the end: reading it each time would cost as much again.
TIME = """
window.time = (edits, size) => {
  const begin = performance.now();
  for (const edit of edits) {
    frame.draw(edit, size);
    const { gl } = frame.graph;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
  const [red] = frame.context.getImageData(size[0] / 2, size[1] / 2, 1, 1).data;
  return [(performance.now() - begin) / edits.length, red];
};
window.ready = true;
"""
HTML, SCRIPT = "text/html", "text/javascript"


def frame_times(scene: Any, edits: list[dict[str, Any]]) -> tuple[float, str]:
    """Return the median milliseconds of drawing ``edits`` in turn, and the GL renderer's name."""
    size = (scene.camera.width, scene.camera.height)
    return _drag(_page(EDITOR, "sun_editor.js") | _answers(scene, size), edits, size)


def sky_frame_times(edits: list[dict[str, Any]], size: tuple[int, int]) -> tuple[float, str]:
    """Return the same for SkyExplorer's picture; ``edits`` are values of its parameters."""
    facts = {"parameters": [p._asdict() for p in EXPLORER_PARAMETERS]}
    answers = {"scene.json": {"body": json.dumps(facts), "content_type": "application/json"}}
    return _drag(_page(EXPLORER, "sky_explorer.js") | answers, edits, size)


def _page(code: str, bundle: str) -> dict[str, dict[str, Any]]:
    html = (
        f'<!doctype html><canvas id="canvas"></canvas><script type="module">{code}{TIME}</script>'
    )
    return {
        "": {"body": html, "content_type": HTML},
        bundle: {"body": (STATIC / bundle).read_text("utf-8"), "content_type": SCRIPT},
        "favicon.ico": {"status": 404},
    }


def _drag(
    answers: dict[str, dict[str, Any]], edits: list[dict[str, Any]], size: tuple[int, int]
) -> tuple[float, str]:
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=FLAGS)
        page = browser.new_page()
        page.route(
            ADDRESS + "**",
            lambda route: route.fulfill(**answers[route.request.url.rsplit("/", 1)[1]]),
        )
        page.goto(ADDRESS)
        page.wait_for_function("window.ready === true", timeout=120_000)
        renderer = page.evaluate(
            """() => {
              const gl = document.createElement("canvas").getContext("webgl2");
              const info = gl.getExtension("WEBGL_debug_renderer_info");
              return gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
            }"""
        )
        drags = [edits[:1], *(edits[i : i + DRAG] for i in range(1, len(edits), DRAG))]
        drawn = [page.evaluate("([e, s]) => time(e, s)", [e, list(size)]) for e in drags]
        browser.close()
    if len({red for _, red in drawn}) == 1:
        raise RuntimeError("The canvas never changed: nothing was measured.")
    # The first frame compiles the shaders and, in the editor, computes the photo's own sky.
    return statistics.median(time for time, _ in drawn[1:]), str(renderer)


def _answers(scene: Any, size: tuple[int, int]) -> dict[str, dict[str, Any]]:
    textures = scene_textures(scene, size)
    textures["photo"] = scene.photo.preview(max(size))
    facts = {
        "parameters": [p._asdict() for p in PARAMETERS],
        "scene": {"automatic": scene.automatic, "uniforms": scene.uniforms()},
        "pictures": list(textures),
    }
    answers: dict[str, dict[str, Any]] = {
        "scene.json": {"body": json.dumps(facts, default=list), "content_type": "application/json"},
    }
    for name, pixels in textures.items():
        data = io.BytesIO()
        Image.fromarray(pixels).save(data, "PNG")
        answers[f"{name}.png"] = {"body": data.getvalue(), "content_type": "image/png"}
    return answers
