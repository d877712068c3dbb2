"""Scene textures arrive on the GPU to the bit, whatever their alpha says."""

import base64

import numpy as np
import pytest
from chromium import widget_state

from sunwidget.analysis import frame_inputs
from sunwidget.formats.png import encode_png
from sunwidget.widgets import SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

# Reads every picture back right after its upload: bytes of RGBA, row 0 first, by order of upload.
READ_BACK = """() => {
  window.uploads = [];
  const original = WebGL2RenderingContext.prototype.texImage2D;
  WebGL2RenderingContext.prototype.texImage2D = function (...values) {
    original.apply(this, values);
    const pixels = values.at(-1);
    if (!(pixels instanceof ImageBitmap)) return;
    const { width, height } = pixels;
    const texture = this.getParameter(this.TEXTURE_BINDING_2D);
    const bound = this.getParameter(this.FRAMEBUFFER_BINDING);
    const framebuffer = this.createFramebuffer();
    this.bindFramebuffer(this.FRAMEBUFFER, framebuffer);
    this.framebufferTexture2D(
      this.FRAMEBUFFER, this.COLOR_ATTACHMENT0, this.TEXTURE_2D, texture, 0);
    const read = new Uint8Array(4 * width * height);
    this.readPixels(0, 0, width, height, this.RGBA, this.UNSIGNED_BYTE, read);
    this.bindFramebuffer(this.FRAMEBUFFER, bound);
    this.deleteFramebuffer(framebuffer);
    let text = "";
    for (const byte of read) text += String.fromCharCode(byte);
    window.uploads.push({ width, height, data: btoa(text) });
  };
}"""


def uploads(page):
    return [
        np.frombuffer(base64.b64decode(u["data"]), np.uint8).reshape(u["height"], u["width"], 4)
        for u in page.evaluate("uploads")
    ]


def as_text(data):
    return base64.b64encode(data).decode("ascii")


def test_all_four_channels_of_surface_arrive_unpremultiplied(fresh_page, coast):
    state = widget_state(SunEditor(coast).wait(120))
    noise = np.random.default_rng(5).integers(0, 256, (512, 768, 4), dtype=np.uint8)
    # The ends of alpha are where premultiplying loses most.
    noise[:64, :, 3], noise[64:128, :, 3] = 0, 1
    backdrop = noise[:90, :160, :3]
    fresh_page.evaluate(READ_BACK)
    fresh_page.evaluate(
        "(state) => showEditor(state)",
        {
            **state,
            "_surface": as_text(encode_png(noise)),
            "_backdrop": as_text(encode_png(backdrop)),
        },
    )
    fresh_page.locator(".sunwidget.sw-live").wait_for()
    assert fresh_page.errors == []
    photo, layers, surface, small, *_ = uploads(fresh_page)
    assert np.array_equal(surface, noise)
    assert np.array_equal(small[..., :3], backdrop)
    assert (small[..., 3] == 255).all()
    assert np.array_equal(photo[..., :3], coast.photo.preview(768))
    assert np.abs(layers - 255 * frame_inputs.layers(coast, (768, 512))).max() <= 0.51


def test_surface_travels_with_the_depth_of_the_land_in_its_alpha(fresh_page, coast):
    widget = SunEditor(coast).wait(120)
    fresh_page.evaluate(READ_BACK)
    fresh_page.evaluate("(state) => showEditor(state)", widget_state(widget))
    fresh_page.locator(".sunwidget.sw-live").wait_for()
    surface = uploads(fresh_page)[2]
    levels = frame_inputs.surface(coast, (768, 512))
    assert np.abs(surface - 255 * levels).max() <= 0.51
    assert len(np.unique(surface[..., 3])) > 20
