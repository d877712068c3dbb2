"""Chromium on Mesa's software rasteriser, and the page that holds the built front end."""

import base64
import io
import json
import shutil
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from PIL import Image

from sunwidget.widgets.kernel.payload import MAP_TRAITS

HERE = Path(__file__).parent
STATIC = HERE.parents[1] / "sunwidget" / "static"
ORIGIN = "http://sunwidget.test"
ARGUMENTS = [
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=gl-egl",
    "--ignore-gpu-blocklist",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
PATIENCE = 120_000  # ms: two shared cores may take their time
VIEWPORT = {"width": 960, "height": 720}
# What a page runs so that its graphics context is lost in the next pass that it draws.
LOSE_ONCE = """(() => {
  const { prototype } = WebGL2RenderingContext;
  const { drawArrays } = prototype;
  prototype.drawArrays = function (...rest) {
    prototype.drawArrays = drawArrays;
    this.getExtension("WEBGL_lose_context").loseContext();
    return drawArrays.apply(this, rest);
  };
})()"""
# What a page runs to note every WebGL context that it makes from now on.
COUNT_CONTEXTS = """(() => {
  const counts = Boolean(window.contexts);
  window.contexts = [];
  if (counts) return;
  const original = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    const context = original.call(this, kind, ...rest);
    if (context && kind === "webgl2" && !contexts.includes(context)) contexts.push(context);
    return context;
  };
})()"""
_TYPES = {".js": "text/javascript", ".css": "text/css", ".html": "text/html"}


@contextmanager
def chromium():
    """A browser that ends with the block."""
    from playwright.sync_api import sync_playwright

    path = shutil.which("chromium") or shutil.which("chromium-browser")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, headless=True, args=ARGUMENTS)
        try:
            yield browser
        finally:
            browser.close()


def open_page(context, name="page.html"):
    """A test page, served from memory: no server, no port."""
    page = context.new_page()
    page.set_default_timeout(PATIENCE)
    page.errors = []
    page.answer = None  # what answers as the kernel, see ``connect``
    page.on("pageerror", lambda error: page.errors.append(str(error)))

    def serve(route):
        path = route.request.url.removeprefix(ORIGIN).lstrip("/").split("?")[0]
        for folder in (HERE, STATIC):
            file = folder / path
            if file.is_file():
                route.fulfill(body=file.read_bytes(), content_type=_TYPES[file.suffix])
                return
        route.fulfill(status=404, body="")

    page.route(f"{ORIGIN}/**", serve)
    page.goto(f"{ORIGIN}/{name}")
    page.wait_for_function("window.ready")
    return page


def start_anew(page):
    """Make a page that was used as good as new: no view, nothing kept, nothing held."""
    page.mouse.up()
    for key in ("Shift", "Control", " "):
        page.keyboard.up(key)
    page.mouse.move(1, 1)
    page.set_viewport_size(VIEWPORT)
    # What fades in would be waited for, a third of a second a test.
    page.emulate_media(color_scheme="light", reduced_motion="reduce")
    page.evaluate("startAnew()")
    page.errors.clear()


def at_rest(page):
    """Wait until nothing moves on the page by itself: what fades in is there, and is drawn."""
    page.wait_for_function(
        """() => document.getAnimations().every(({ effect, playState }) =>
             playState !== "running" || effect.getComputedTiming().endTime === Infinity)"""
    )
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => setTimeout(done)))")


def count_contexts(page):
    """From now on note every WebGL context that the page makes; see ``live_contexts``."""
    page.evaluate(COUNT_CONTEXTS)


def live_contexts(page):
    """How many of the noted contexts are not lost."""
    return page.evaluate("contexts.filter((gl) => !gl.isContextLost()).length")


def drag_sun(page, i=0, by=(-60, 20)):
    """Drag the sun of the page's ``i``-th editor and wait until its picture has followed."""
    editor = page.locator(".sunwidget").nth(i)
    ring = editor.locator(".sw-sun-ring")
    canvas = editor.locator(".sw-canvas")
    readout = editor.locator(".sw-readout")
    ring.scroll_into_view_if_needed()
    before = canvas.evaluate("canvas => canvas.toDataURL()")
    said = readout.text_content()
    # What loads last, notes and pictures, moves the page: nothing else comes before the press.
    box = None
    while box != (box := ring.bounding_box()):
        page.wait_for_timeout(60)
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + by[0], y + by[1], steps=3)
    page.mouse.up()
    for _ in range(PATIENCE // 100):
        # The next frame writes the one and draws the other.
        if readout.text_content() != said and canvas.evaluate("c => c.toDataURL()") != before:
            return
        page.wait_for_timeout(100)
    there = page.evaluate("at => document.elementFromPoint(...at)?.outerHTML", [x, y])
    raise AssertionError(
        f"pressed at {(x, y)} on {there!r:.200}; the ring was at {box}, "
        f"is at {ring.bounding_box()}; read out was {said!r}, is {readout.text_content()!r}"
    )


def widget_state(widget):
    """The widget's traits as the browser gets them, bytes as base64."""
    state = {}
    for name, value in widget.get_state().items():
        if name in ("_esm", "_css", "layout"):
            continue
        if isinstance(value, (bytes, memoryview)):
            value = base64.b64encode(value).decode("ascii")
        state[name] = value
    return json.loads(json.dumps(state))


def paste(page, text):
    """Paste a text as Ctrl+V does, into the view of an editor."""
    page.evaluate(
        """(text) => {
          const clipboardData = new DataTransfer();
          clipboardData.setData("text/plain", text);
          const options = { clipboardData, bubbles: true, cancelable: true };
          const event = new ClipboardEvent("paste", options);
          document.querySelector(".sw-sun").dispatchEvent(event);
        }""",
        text,
    )


def connect(page, widget):
    """Let a real widget answer what the page's editor sends; see ``showConnected``."""
    from sunwidget.widgets.kernel.requests import Requests

    actions = widget._actions()

    def answer(sent):
        if "changes" in sent:
            widget.set_state(sent["changes"])
            state = widget_state(widget.wait(120))
            return {n: state[n] for n in ("_scene", *MAP_TRAITS, "_status")}
        messages = []

        def send(content, buffers=()):
            messages.append([content, [base64.b64encode(b).decode("ascii") for b in buffers]])

        content = {**sent["content"], "buffers": [bytes(b) for b in sent["content"]["buffers"]]}
        Requests(send, actions)._answer(content)
        return messages

    def ask(sent):
        return page.answer(sent)  # a later test may have set another

    if page.answer is None:
        page.expose_function("toKernel", ask)
    page.answer = answer
    page.evaluate("(state) => showConnected(state)", widget_state(widget))
    page.locator(".sunwidget.sw-live").wait_for()


def picture_of(base64_png):
    """(H, W, 3) uint8 of a PNG that the page returned."""
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(base64_png))).convert("RGB"))
