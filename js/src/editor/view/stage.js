/**
 * The picture's stage: the photo, the canvas over it, handles above both.
 *
 * The picture fits the window in the middle until it is zoomed; then it may cover the whole stage.
 */

import { Zoom } from "../../geometry/zoom.js";
import { element, setAttributes } from "../../ui/element.js";
import { PictureStage } from "../../ui/stage.js";

/** @typedef {import("../../host/types.js").Point} Point */

const STAGE = 0.74; // share of the visible height for the picture and its margin
const MARGIN = 24; // CSS pixels around the picture (stage.css)
const SMALLEST = 240; // CSS pixels
const NOTEBOOK = ".jp-WindowedPanel-outer"; // the scrolling element in JupyterLab and Notebook 7
const PIXELS_FROM = 2; // scale from which the preview's pixels are shown as squares

export class Stage extends PictureStage {
  /** @param {AbortSignal} signal */
  constructor(signal) {
    const photo = element("img", { class: "sw-photo", alt: "The original photo" });
    const original = element("canvas", {
      class: "sw-original",
      width: 0,
      height: 0,
      "aria-hidden": "true",
    });
    const canvas = element("canvas", {
      class: "sw-canvas",
      role: "img",
      "aria-label": "The photo with the sun moved",
    });
    const mask = element("canvas", { class: "sw-mask", "aria-hidden": "true" });
    const picture = element("div", { class: "sw-picture" }, photo, original, canvas, mask);
    const room = element("div", { class: "sw-window" }, picture);
    super(picture, { content: room, className: "sw-photo-stage", signal });
    setAttributes(this.node, {
      tabindex: 0,
      role: "application",
      "aria-label": "Picture: arrow keys move a cross, Enter uses the tool there, + and − zoom",
    });
    this.window = room;
    this.photo = photo;
    this.original = original;
    this.canvas = canvas;
    this.mask = mask;
    this.zoom = new Zoom();
    this.zoom.onChange = () => this.layOut();
    this.focusing = false; // while a pointer sets the focus
    this.full = true; // whether the canvas holds the frame at full size
    this.url = ""; // of the photo shown
    this.coming = ""; // of the photo being decoded
    signal.addEventListener("abort", () => {
      this.coming = "";
      URL.revokeObjectURL(this.url);
    });
    this.watchScreen(signal);
    this.limitHeight();
    window.addEventListener("resize", () => this.limitHeight(), { signal });
  }

  /**
   * Limit the picture's height so that toolbar and status bar are visible with it. In a frame, whose
   * height may follow its content, use the screen's height.
   */
  limitHeight() {
    const host = this.node.closest(NOTEBOOK)?.clientHeight || Infinity;
    const tallest =
      window === window.top
        ? STAGE * Math.min(window.innerHeight, host) - 2 * MARGIN
        : 0.72 * window.screen.availHeight;
    const height = Math.round(Math.min(900, Math.max(SMALLEST, tallest)));
    this.node.style.setProperty("--sw-tallest", `${height}px`);
  }

  /** Follow the window to a screen with another pixel density. @param {AbortSignal} signal */
  watchScreen(signal) {
    const same = window.matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`);
    const changed = () => {
      this.layOut();
      this.watchScreen(signal);
    };
    same.addEventListener("change", changed, { once: true, signal });
  }

  /**
   * Show a photo.
   *
   * @param {ArrayBufferView} bytes PNG or JPEG
   */
  async setPhoto(bytes) {
    const url = URL.createObjectURL(new Blob([/** @type {BlobPart} */ (bytes)]));
    const image = new Image();
    image.src = url;
    this.coming = url;
    try {
      await image.decode();
    } finally {
      // A small photo that arrived later may be decoded before a large one.
      if (this.coming !== url || !image.naturalWidth) URL.revokeObjectURL(url);
    }
    if (this.coming !== url) return;
    URL.revokeObjectURL(this.url);
    this.url = url;
    this.photo.src = url;
    const { naturalWidth: width, naturalHeight: height } = image;
    const another = width !== this.zoom.size[0] || height !== this.zoom.size[1];
    this.zoom.size = [width, height];
    this.node.style.setProperty("--sw-aspect", String(width / height));
    this.node.classList.add("sw-has-photo");
    this.redrawOriginal();
    if (another) this.zoom.fit();
    else this.layOut();
  }

  /** Redraw the original after the photo changed or its canvas was cleared. */
  redrawOriginal() {
    if (!this.original.width) return;
    this.setOriginal(false);
    this.setOriginal(true);
  }

  /**
   * Show the photo for comparison with the frame, also on a canvas: browsers scale images
   * differently, so one would look softer than the other.
   *
   * @param {boolean} on
   */
  setOriginal(on) {
    const { original, photo } = this;
    if (on === original.width > 0) return;
    original.width = on ? photo.naturalWidth : 0;
    original.height = on ? photo.naturalHeight : 0;
    original.getContext("2d", { alpha: false })?.drawImage(photo, 0, 0);
  }

  /** Focus the stage, so that keys reach the editor, without showing the keyboard's cross. */
  focus() {
    this.focusing = true;
    this.node.focus({ preventScroll: true });
    this.focusing = false;
  }

  resized() {
    this.limitHeight();
    this.layOut();
  }

  /** A drag may draw smaller frames, whose pixels are not the preview's. @param {boolean} full */
  setFull(full) {
    this.full = full;
    this.showPixels();
  }

  showPixels() {
    const squares = this.full && this.zoom.scale >= PIXELS_FROM;
    this.node.classList.toggle("sw-pixels", squares);
  }

  /** Place the picture according to the zoom. */
  layOut() {
    const { zoom } = this;
    const stage = this.node.getBoundingClientRect();
    const fit = this.window.getBoundingClientRect();
    if (!fit.width || !fit.height) return;
    const [x0, y0] = [fit.left - stage.left, fit.top - stage.top];
    const pixelRatio = window.devicePixelRatio || 1;
    zoom.setRoom({
      width: stage.width,
      height: stage.height,
      fit: { x: x0, y: y0, width: fit.width, height: fit.height },
      pixelRatio,
    });
    const { style } = this.picture;
    if (zoom.fits) style.width = style.height = style.transform = "";
    else {
      // Browsers snap boxes to whole pixels, at worst CSS pixels, but not transforms: one by whole
      // screen pixels keeps 100 % sharp.
      const { x, y, width } = zoom.box();
      const [left, top] = [x, y].map((at) => Math.round(at * pixelRatio) / pixelRatio);
      style.width = `${zoom.size[0]}px`;
      style.height = `${zoom.size[1]}px`;
      style.transform = `translate(${left}px, ${top}px) scale(${width / zoom.size[0]})`;
    }
    this.node.classList.toggle("sw-zoomed", !zoom.fits);
    this.showPixels();
    this.onLayout();
  }
}
