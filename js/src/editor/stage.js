/**
 * Where the picture stands: the photo at once, the canvas over it, handles above both.
 *
 * Places on the picture are fractions of its width and height, (0, 0) at the top left corner
 * and also outside 0–1. The overlay lies over the whole stage, margin included, in CSS pixels.
 */

import { element, shape } from "../controls/element.js";

/** @typedef {import("../types.js").Point} Point */

const MAXIMUM_ZOOM = 8;

export class Stage {
  /** @param {AbortSignal} signal */
  constructor(signal) {
    this.photo = element("img", { class: "sw-photo", alt: "The photo as it was taken" });
    this.canvas = element("canvas", {
      class: "sw-canvas",
      role: "img",
      "aria-label": "The photo with the sun moved",
    });
    this.mask = element("canvas", { class: "sw-mask", "aria-hidden": "true" });
    this.picture = element("div", { class: "sw-picture" }, this.photo, this.canvas, this.mask);
    this.overlay = shape("svg", { class: "sw-overlay" });
    this.bar = element("div", { class: "sw-progress-bar" });
    this.caption = element("span", { class: "sw-progress-text", role: "status" });
    this.progress = element("div", { class: "sw-progress" }, this.bar, this.caption);
    this.node = element(
      "div",
      { class: "sw-stage" },
      element("div", { class: "sw-window" }, this.picture),
      this.overlay,
      this.progress,
    );
    this.zoom = 1;
    /** @type {Point} shift of the zoomed picture in CSS pixels */
    this.shift = [0, 0];
    this.url = "";
    /** @type {() => void} called when the layout changed */
    this.onLayout = () => {};
    const observer = new ResizeObserver(() => this.onLayout());
    observer.observe(this.node);
    observer.observe(this.picture);
    signal.addEventListener("abort", () => {
      observer.disconnect();
      URL.revokeObjectURL(this.url);
    });
    this.node.addEventListener("wheel", (event) => this.onWheel(event), { passive: false, signal });
  }

  /**
   * Show the photo as it is.
   *
   * @param {ArrayBufferView} bytes PNG or JPEG
   */
  async setPhoto(bytes) {
    const url = URL.createObjectURL(new Blob([/** @type {BlobPart} */ (bytes)]));
    const image = new Image();
    image.src = url;
    await image.decode();
    URL.revokeObjectURL(this.url);
    this.url = url;
    this.photo.src = url;
    this.picture.style.setProperty("--sw-aspect", String(image.naturalWidth / image.naturalHeight));
    this.node.classList.add("sw-has-photo");
  }

  /** The picture's rectangle in the overlay, in CSS pixels. */
  rectangle() {
    const outer = this.node.getBoundingClientRect();
    const inner = this.picture.getBoundingClientRect();
    return {
      x: inner.left - outer.left,
      y: inner.top - outer.top,
      width: inner.width,
      height: inner.height,
      stageWidth: outer.width,
      stageHeight: outer.height,
    };
  }

  /**
   * Place on the picture of a pointer, also outside it.
   *
   * @param {{ clientX: number, clientY: number }} event
   * @returns {Point}
   */
  placeOf(event) {
    const box = this.picture.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  }

  /**
   * Where in the overlay a place of the picture is, in CSS pixels.
   *
   * @param {Point} place
   * @returns {Point}
   */
  onOverlay([x, y]) {
    const box = this.rectangle();
    return [box.x + x * box.width, box.y + y * box.height];
  }

  /**
   * Plain wheel scrolls the page; with Ctrl or Cmd it zooms about the pointer.
   *
   * @param {WheelEvent} event
   */
  onWheel(event) {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const before = this.placeOf(event);
    const zoom = this.zoom * Math.exp(-event.deltaY * 0.002);
    this.setZoom(zoom);
    const box = this.picture.getBoundingClientRect();
    this.pan(
      event.clientX - (box.left + before[0] * box.width),
      event.clientY - (box.top + before[1] * box.height),
    );
  }

  /** @param {number} zoom */
  setZoom(zoom) {
    this.zoom = Math.min(MAXIMUM_ZOOM, Math.max(1, zoom));
    this.pan(0, 0);
  }

  /**
   * Shift the zoomed picture, never past its own edge.
   *
   * @param {number} x CSS pixels
   * @param {number} y
   */
  pan(x, y) {
    const slackX = ((this.zoom - 1) * this.picture.offsetWidth) / 2;
    const slackY = ((this.zoom - 1) * this.picture.offsetHeight) / 2;
    this.shift = [
      Math.min(slackX, Math.max(-slackX, this.shift[0] + x)),
      Math.min(slackY, Math.max(-slackY, this.shift[1] + y)),
    ];
    this.picture.style.transform =
      this.zoom === 1
        ? ""
        : `translate(${this.shift[0]}px, ${this.shift[1]}px) scale(${this.zoom})`;
    this.node.classList.toggle("sw-zoomed", this.zoom > 1);
    this.onLayout();
  }

  /**
   * The line at the foot of the stage: `null` hides it.
   *
   * @param {number | null} fraction
   * @param {string} message
   */
  setProgress(fraction, message) {
    this.progress.classList.toggle("sw-shown", fraction !== null);
    if (fraction === null) return;
    this.bar.style.transform = `scaleX(${fraction})`;
    if (this.caption.textContent !== message) this.caption.textContent = message;
  }
}
