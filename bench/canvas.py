"""The canvas's frame time: the built front end's Frame in Chromium, without a notebook."""

from __future__ import annotations

import io
import json
import shutil
import statistics
from pathlib import Path
from typing import Any

from PIL import Image

from sunwidget.edit import PARAMETERS
from sunwidget.renderer.render import scene_textures

STATIC = Path(__file__).resolve().parents[1] / "sunwidget" / "static"
ADDRESS = "http://canvas.invalid/"
# Mesa's llvmpipe through ANGLE, the rasteriser that EGL uses here too.
FLAGS = ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist", "--no-sandbox"]
# Frames that are drawn in a row.
DRAG = 5
PAGE = """
<!doctype html><canvas id="canvas"></canvas>
<script type="module">
import { Frame } from "./sun_editor.js";
const { parameters, scene, pictures } = await (await fetch("./scene.json")).json();
const frame = new Frame(document.getElementById("canvas"), parameters);
for (const name of pictures) {
  const bytes = await (await fetch(`./${name}.png`)).blob();
  const options = { premultiplyAlpha: "none", colorSpaceConversion: "none" };
  frame.setPicture(name, await createImageBitmap(bytes, options));
}
frame.setScene(scene);
// Frames follow each other as in a drag, each waited for by reading a pixel where it is drawn. The
// visible canvas, a copy, is read once at the end: reading it each time would cost as much again.
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
</script>
"""


def frame_times(scene: Any, edits: list[dict[str, Any]]) -> tuple[float, str]:
    """Return the median milliseconds of drawing ``edits`` in turn, and the GL renderer's name."""
    from playwright.sync_api import sync_playwright

    width, height = scene.camera.width, scene.camera.height
    answers = _answers(scene, (width, height))
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
        drawn = [page.evaluate("([e, s]) => time(e, s)", [e, [width, height]]) for e in drags]
        browser.close()
    if len({red for _, red in drawn}) == 1:
        raise RuntimeError("The canvas never changed: nothing was measured.")
    # The first frame compiles the shaders and computes the photo's own sky.
    return statistics.median(time for time, _ in drawn[1:]), str(renderer)


def _answers(scene: Any, size: tuple[int, int]) -> dict[str, dict[str, Any]]:
    textures = scene_textures(scene, size)
    textures["photo"] = scene.photo.preview(max(size))
    facts = {
        "parameters": [p._asdict() for p in PARAMETERS],
        "scene": {"automatic": scene.automatic, "uniforms": scene.uniforms()},
        "pictures": list(textures),
    }
    answers = {
        "": {"body": PAGE, "content_type": "text/html"},
        "scene.json": {"body": json.dumps(facts, default=list), "content_type": "application/json"},
        "sun_editor.js": {
            "body": (STATIC / "sun_editor.js").read_text("utf-8"),
            "content_type": "text/javascript",
        },
        "favicon.ico": {"status": 404},
    }
    for name, pixels in textures.items():
        data = io.BytesIO()
        Image.fromarray(pixels).save(data, "PNG")
        answers[f"{name}.png"] = {"body": data.getvalue(), "content_type": "image/png"}
    return answers
